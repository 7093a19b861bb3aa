//! Claim: a sweep in parts is the sweep: byte for byte the files that one machine writes, for 1, 7 and 100 parts, by shards and by lines;
//! doubles agree or are named; missing points are listed with exit code 3; a part that was killed has lost no finished point. Designs fill
//! their ranges, the same for the same seed.
//!
//! Source: the whole sweep of the same program. Tolerance: none.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use tempfile::TempDir;

use crate::common::{gears, line, succeed};

const STUDY: &str = concat!(
    "title = \"parts\"\n",
    gears!("centre_distance = 80.0\n"),
    "\
[operation]
torque = 100.0
speed = 2000.0
[wear]
coefficient = 6e-10
cycles = 20000
[model]
contact = \"hertz\"
[numerics]
elements_per_half_width = 2
positions = 20
stored_states = 1
fields = 0
"
);

/// By elements: meshes depend on the loads of all points, of which a part computes some.
const FEM: &str = concat!(
    "title = \"parts\"\n",
    gears!("centre_distance = 80.0\n"),
    "\
[operation]
torque = 100.0
speed = 2000.0
[wear]
coefficient = 6e-10
cycles = 5000
[numerics]
elements_per_half_width = 2
positions = 12
stored_states = 1
fields = 0
"
);

/// 112 points, of which those with the largest misalignment are no pair that runs.
const GRID: &str =
    "--vary operation.torque=50..200:16 --vary operation.misalignment=0,0.1,0.2,0.3,0.5,0.7,30";

fn home(study: &str) -> TempDir {
    let home = tempfile::tempdir().unwrap();
    fs::write(home.path().join("study.toml"), study).unwrap();
    home
}

/// What a sweep wrote.
fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let names = ["sweep.csv", "sweep.json", "sweep.svg"];
    names
        .map(|name| (name.to_owned(), fs::read(folder.join(name)).unwrap()))
        .into()
}

fn points_in(folder: &Path) -> usize {
    fs::read_dir(folder).unwrap().count()
}

#[test]
fn shards_make_the_whole_byte_for_byte() {
    let home = home(STUDY);
    succeed(&home, &format!("sweep study.toml {GRID} -o whole"));
    let whole = files(&home.path().join("whole"));
    for of in [1, 7, 100] {
        for i in 1..=of {
            let out = format!("parts{of}/{}", i % 3);
            succeed(
                &home,
                &format!("sweep study.toml {GRID} --shard {i}/{of} -o {out}"),
            );
        }
        let folders: Vec<String> = (0..of.min(3))
            .map(|i| format!("parts{of}/{}", (i + 1) % 3))
            .collect();
        let told = succeed(
            &home,
            &format!(
                "sweep study.toml {GRID} --merge {} -o merged{of}",
                folders.join(" ")
            ),
        );
        assert!(told.contains("no pair that runs"), "{told}");
        assert_eq!(
            files(&home.path().join(format!("merged{of}"))),
            whole,
            "{of} parts"
        );
    }
}

#[test]
fn shards_of_elements_and_lines_make_the_whole_byte_for_byte() {
    let home = home(FEM);
    let vary = "--vary operation.torque=60,100,160 --vary operation.misalignment=0,0.2";
    succeed(&home, &format!("sweep study.toml {vary} -o whole"));
    let whole = files(&home.path().join("whole"));
    for i in 1..=3 {
        succeed(&home, &format!("sweep study.toml {vary} --shard {i}/3"));
    }
    succeed(
        &home,
        &format!("sweep study.toml {vary} --merge study.out/sweep-points -o merged"),
    );
    assert_eq!(files(&home.path().join("merged")), whole);
    // lines: by HQ_ENTRY, by standard input, as an argument
    succeed(
        &home,
        &format!("sweep study.toml {vary} --emit points.jsonl --per-line 2"),
    );
    let lines = fs::read_to_string(home.path().join("points.jsonl")).unwrap();
    let lines: Vec<&str> = lines.lines().collect();
    assert_eq!(lines.len(), 3);
    let command = |line: &str| {
        let mut command = Command::cargo_bin("gearwear").unwrap();
        command.current_dir(&home).args(["sweep", "study.toml"]);
        command
            .args(vary.split_whitespace())
            .args(["--point", line, "-o", "tasks"]);
        command
    };
    command("-").env("HQ_ENTRY", lines[0]).assert().success();
    command("-").write_stdin(lines[1]).assert().success();
    command(lines[2]).assert().success();
    succeed(
        &home,
        &format!("sweep study.toml {vary} --merge tasks -o farmed"),
    );
    assert_eq!(files(&home.path().join("farmed")), whole);
    // a line of another sweep, and what is no line
    for (wrong, says) in [
        (
            lines[0].replace("\"design\":\"", "\"design\":\"0"),
            "another sweep",
        ),
        (lines[0].replace("[0,1]", "[0,99]"), "there is no point 99"),
        ("3".to_owned(), "no line of --emit"),
    ] {
        let refused = command(&wrong).output().unwrap();
        let err = String::from_utf8(refused.stderr).unwrap();
        assert_eq!(refused.status.code(), Some(2), "{wrong}: {err}");
        assert!(err.contains(says), "{wrong}: {err}");
    }
}

#[test]
fn what_is_missing_double_or_foreign_is_told() {
    let home = home(STUDY);
    let vary = "--vary operation.torque=50..200:6";
    succeed(&home, &format!("sweep study.toml {vary} -o whole"));
    for i in [1, 3] {
        succeed(
            &home,
            &format!("sweep study.toml {vary} --shard {i}/3 -o parts"),
        );
    }
    let merge = format!("sweep study.toml {vary} --merge parts -o merged");
    let (code, _, err) = line(&home, &merge);
    assert_eq!(code, Some(3), "{err}");
    assert!(err.contains("2 of 6 points are missing"), "{err}");
    assert!(
        err.contains("point 2 (operation.torque=80)") && err.contains("point 5"),
        "{err}"
    );
    assert!(!home.path().join("merged").exists());
    // a killed part: of its points one is there, and cut off on its way another; started again it computes what is not
    succeed(
        &home,
        &format!("sweep study.toml {vary} --shard 2/3 -o again"),
    );
    let mut names: Vec<_> = fs::read_dir(home.path().join("again"))
        .unwrap()
        .map(|e| e.unwrap().path())
        .collect();
    names.sort();
    let before = fs::read(&names[0]).unwrap();
    fs::write(&names[1], &before[..before.len() / 2]).unwrap();
    let (code, _, err) = line(
        &home,
        &format!("sweep study.toml {vary} --merge parts again -o merged"),
    );
    assert_eq!(code, Some(3), "{err}");
    assert!(err.contains("1 of 6"), "{err}");
    let told = succeed(
        &home,
        &format!("sweep study.toml {vary} --shard 2/3 -o again"),
    );
    assert!(told.contains("1 were before"), "{told}");
    succeed(
        &home,
        &format!("sweep study.toml {vary} --merge parts again -o merged"),
    );
    assert_eq!(
        files(&home.path().join("merged")),
        files(&home.path().join("whole"))
    );
    // doubles that agree do; those that do not are named
    succeed(
        &home,
        &format!("sweep study.toml {vary} --shard 1/1 -o all"),
    );
    succeed(
        &home,
        &format!("sweep study.toml {vary} --merge all parts again -o merged"),
    );
    assert_eq!(points_in(&home.path().join("all")), 6);
    let other = home.path().join("all").join(names[0].file_name().unwrap());
    let text = fs::read_to_string(&other).unwrap();
    let changed = text.replacen("\"max_depth_gear_um\": ", "\"max_depth_gear_um\": 1", 1);
    assert_ne!(changed, text);
    fs::write(&other, changed).unwrap();
    let (code, _, err) = line(
        &home,
        &format!("sweep study.toml {vary} --merge all parts again -o merged"),
    );
    assert_eq!(code, Some(2), "{err}");
    assert!(
        err.contains("different figures") && err.contains("all and again"),
        "{err}"
    );
    // a changed study has other points
    fs::write(
        home.path().join("study.toml"),
        STUDY.replace("6e-10", "5e-10"),
    )
    .unwrap();
    let (code, _, err) = line(&home, &merge);
    assert_eq!(code, Some(3), "{err}");
    assert!(err.contains("6 of 6"), "{err}");
    // folders that hold other things, wrong numbers, what excludes each other
    for (arguments, says) in [
        ("--shard 1/3 -o whole", "no folder of a sweep's points"),
        ("--shard 4/3", "i from 1 to n"),
        ("--shard 0/3", "i from 1 to n"),
        ("--merge nowhere", "no such folder"),
        ("--shard 1/3 --merge parts", "cannot be used with"),
        ("--emit a --point -", "cannot be used with"),
    ] {
        let (code, _, err) = line(&home, &format!("sweep study.toml {vary} {arguments}"));
        assert_eq!(code, Some(2), "{arguments}: {err}");
        assert!(err.contains(says), "{arguments}: {err}");
    }
}

#[test]
fn designs_and_tables_of_points_are_swept() {
    let home = home(STUDY);
    let vary = "--vary operation.torque=50..200 --vary wear.coefficient=1e-10..1e-9:log";
    for design in ["lhs:12", "sobol:16"] {
        succeed(
            &home,
            &format!("sweep study.toml --design {design} {vary} --seed 5 -o a"),
        );
        succeed(
            &home,
            &format!("sweep study.toml --design {design} {vary} --seed 5 -o b"),
        );
        succeed(
            &home,
            &format!("sweep study.toml --design {design} {vary} --seed 6 -o c"),
        );
        let [a, b, c] = ["a", "b", "c"].map(|name| files(&home.path().join(name)));
        assert_eq!(a, b);
        assert_ne!(a[0], c[0]);
        let document: serde_json::Value = serde_json::from_slice(&a[1].1).unwrap();
        assert_eq!(document["design"]["seed"], 5);
        assert_eq!(document["vary"][1]["log"], true);
        let svg = String::from_utf8(a[2].1.clone()).unwrap();
        assert!(svg.starts_with("<svg") && svg.contains("operation.torque"));
        // depth grows with torque times coefficient; the designs' own points, as a table, are the same runs
        let table = String::from_utf8(a[0].1.clone()).unwrap();
        let points: Vec<String> = table
            .lines()
            .map(|line| line.split(',').take(2).collect::<Vec<_>>().join(","))
            .collect();
        fs::write(home.path().join("points.csv"), points.join("\n")).unwrap();
        succeed(&home, "sweep study.toml --points points.csv -o listed");
        assert_eq!(files(&home.path().join("listed"))[0], a[0]);
    }
    for (arguments, says) in [
        ("--vary operation.torque=50..200", "FROM..TO:COUNT"),
        (
            "--design lhs:1 --vary operation.torque=50..200",
            "lhs:N or sobol:N",
        ),
        (
            "--design sobol:100000 --vary operation.torque=50..200",
            "65536",
        ),
        ("--seed 3 --vary operation.torque=50,200", "--design"),
        ("--points nowhere.csv", "nowhere.csv"),
        (
            "--points points.csv --vary operation.torque=50,200",
            "cannot be used with",
        ),
        ("", "--vary"),
    ] {
        let (code, _, err) = line(&home, &format!("sweep study.toml {arguments}"));
        assert_eq!(code, Some(2), "{arguments}: {err}");
        assert!(err.contains(says), "{arguments}: {err}");
    }
    for (table, says) in [
        (
            "operation.torqe\n100\n",
            "the nearest valid key is `operation.torque`",
        ),
        ("operation.torque,wear.cycles\n100\n", "points.csv:2"),
        (
            "operation.torque,wear.cycles\n100,\n",
            "points.csv:2: no value for wear.cycles",
        ),
        ("operation.torque\n", "no points"),
        ("operation.torque\n-5\n", "--points operation.torque=-5"),
    ] {
        fs::write(home.path().join("points.csv"), table).unwrap();
        let (code, _, err) = line(&home, "sweep study.toml --points points.csv");
        assert_eq!(code, Some(2), "{table}: {err}");
        assert!(err.contains(says), "{table}: {err}");
    }
}

/// Depth is the law's own product of load, coefficient and cycles: on logarithmic ranges the logarithm of the depth is a sum, nearly, and a
/// speed that the law does not know has no share. A part of the design makes the same files.
#[test]
fn a_saltelli_design_tells_the_share_of_every_key() {
    let home = home(STUDY);
    let sweep = "sweep study.toml --design saltelli:64 --vary wear.coefficient=2e-10..6e-10 --vary wear.cycles=15000..25000 \
                 --vary operation.speed=500..3000 --outputs max_depth_gear_um,wear_profile_gear";
    let told = succeed(&home, &format!("{sweep} -o whole"));
    assert!(told.contains("of 64 rows"), "{told}");
    let read = |name: &str| fs::read_to_string(home.path().join("whole").join(name)).unwrap();
    let document: serde_json::Value = serde_json::from_str(&read("sweep.json")).unwrap();
    assert_eq!(document["design"]["rows"], 64);
    assert_eq!(document["points"].as_array().unwrap().len(), 64 * 5);
    let outputs = document["sensitivity"]["outputs"].as_array().unwrap();
    // depth = c k n with k and n uniform: in closed form, with the squares of their coefficients of variation
    let cv2 = |low: f64, high: f64| ((high - low) / (high + low)).powi(2) / 3.0;
    let (k, n) = (cv2(2e-10, 6e-10), cv2(15000.0, 25000.0));
    let all = (1.0 + k) * (1.0 + n) - 1.0;
    let exact = [
        [k / all, k * (1.0 + n) / all],
        [n / all, n * (1.0 + k) / all],
        [0.0, 0.0],
    ];
    assert!(outputs.len() > 20, "a figure and a profile");
    for output in outputs {
        for (index, exact) in output["keys"].as_array().unwrap().iter().zip(exact) {
            for (name, exact) in ["first", "total"].iter().zip(exact) {
                let value = index[*name].as_f64().unwrap();
                let half = index[format!("{name}_half_width")].as_f64().unwrap();
                // the depth is not quite linear in the cycles
                assert!(
                    (value - exact).abs() < 1.5 * half + 0.03,
                    "{name} {exact}: {output}"
                );
            }
        }
    }
    // no share at all, not a small one
    assert_eq!(outputs[0]["keys"][2]["total"], 0.0);
    assert!(read("sensitivity.csv").contains("wear_profile_gear,"));
    assert!(read("sensitivity.svg").starts_with("<svg"));
    let head = read("sweep.csv").lines().next().unwrap().to_owned();
    assert_eq!(
        head,
        "wear.coefficient,wear.cycles,operation.speed,max_depth_gear_um,error"
    );
    // the largest depth of each point's profile is its figure
    let profiles = read("wear_profiles.csv");
    let deepest = (profiles.lines())
        .filter_map(|line| line.strip_prefix("1,gear,"))
        .map(|line| line.split(',').nth(1).unwrap().parse::<f64>().unwrap())
        .fold(0.0, f64::max);
    assert_eq!(
        document["points"][0]["figures"]["max_depth_gear_um"],
        deepest
    );
    for i in 1..=2 {
        succeed(&home, &format!("{sweep} --shard {i}/2"));
    }
    succeed(
        &home,
        &format!("{sweep} --merge study.out/sweep-points -o merged"),
    );
    for name in [
        "sweep.csv",
        "sweep.json",
        "wear_profiles.csv",
        "sensitivity.csv",
        "sensitivity.svg",
    ] {
        let merged = fs::read_to_string(home.path().join("merged").join(name)).unwrap();
        assert!(merged == read(name), "{name}");
    }
    // other outputs are other points: nothing of these is taken for them
    let usual = sweep.split(" --outputs").next().unwrap();
    let (code, _, err) = line(
        &home,
        &format!("{usual} --merge study.out/sweep-points -o usual"),
    );
    assert_eq!(code, Some(3), "{err}");
    let (code, _, err) = line(
        &home,
        "sweep study.toml --vary wear.cycles=1,2 --outputs max_depth_gaer_um",
    );
    assert_eq!(code, Some(2), "{err}");
    assert!(err.contains("nearest is max_depth_gear_um"), "{err}");
}

/// A point is the run of the study with its values, by the analytic model too: gears that differ between the points are each point's own.
#[test]
fn points_of_the_analytic_model_have_their_own_gears() {
    let home = home(STUDY);
    assert!(
        STUDY.contains("contact = \"hertz\""),
        "by the analytic model"
    );
    succeed(
        &home,
        "sweep study.toml --vary gears.face_width=20,33 -o sweep",
    );
    let table = fs::read_to_string(home.path().join("sweep/sweep.csv")).unwrap();
    let rows: Vec<Vec<&str>> = (table.lines().skip(1))
        .map(|line| line.split(',').collect())
        .collect();
    assert_eq!(rows.len(), 2, "{table}");
    let header: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    let column = |starts: &str| header.iter().position(|name| name.starts_with(starts));
    let place = column("max_depth_pinion").expect(&table);
    // the line load, and with it the depth, goes as one over the width
    let depth = |row: &Vec<&str>| row[place].parse::<f64>().unwrap();
    let ratio = depth(&rows[0]) / depth(&rows[1]);
    assert!((ratio / 1.65 - 1.0).abs() < 0.05, "{ratio}: {table}");
}
