//! The program on teeth that differ: its files, traces that name a tooth, what it refuses.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::common::{gears, line, succeed};

const STUDY: &str = concat!(
    gears!("centre_distance = 80.0\n"),
    r#"[operation]
torque = 100.0
speed = 2000.0
[wear]
coefficient = 6e-10
cycles = 1e6
[model]
contact = "hertz"
[numerics]
positions = 40
stored_states = 2
"#
);
/// The first tooth of nine stands proud.
const TEETH: &str = "[teeth.pinion]\npitch_pattern = [-6, 0, 0, 0, 0, 0, 0, 0, 0]\n";

fn read(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// Columns of a table, by row.
fn rows(table: &str) -> Vec<Vec<&str>> {
    let rows = table.lines().skip(1);
    rows.map(|row| row.split(',').collect()).collect()
}

#[test]
fn files_tell_teeth_apart_where_they_differ_only() {
    let home = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(home.path().join(name), text).unwrap();
    write("alike.toml", STUDY);
    write("differ.toml", &format!("{STUDY}{TEETH}"));
    succeed(home.path(), "run alike.toml -o alike");
    let said = succeed(home.path(), "run differ.toml -o differ");
    let (alike, differ) = (home.path().join("alike"), home.path().join("differ"));
    let header = |folder: &Path| read(folder, "wear.csv").lines().next().unwrap().to_owned();
    assert_eq!(header(&alike), "cycles,member,radius,path,depth");
    assert_eq!(header(&differ), "cycles,member,radius,path,depth,tooth");
    for name in [
        "transmission_error_turn.csv",
        "plots/wear_around_pinion.svg",
    ] {
        assert!(
            !alike.join(name).exists() && differ.join(name).exists(),
            "{name}"
        );
    }
    for name in ["contact.csv", "transmission_error.csv"] {
        let header = |folder: &Path| read(folder, name).lines().next().unwrap().to_owned();
        assert_eq!(header(&alike), header(&differ), "{name}");
    }
    // the deepest of the proud tooth, in the table, the summary and the words
    let table = read(&differ, "wear.csv");
    let proud = rows(&table)
        .into_iter()
        .filter(|r| r[1] == "pinion" && r[5] == "1");
    let depth = proud
        .map(|r| r[4].parse::<f64>().unwrap())
        .fold(0.0, f64::max);
    let summary: Value = serde_json::from_str(&read(&differ, "summary.json")).unwrap();
    let classes = summary["teeth"]["classes"].as_array().unwrap();
    let first = &classes[0];
    assert_eq!(first["teeth"], serde_json::json!([1, 10, 19]));
    assert_eq!(first["max_depth_um"].as_f64(), Some(depth));
    assert!(summary["wear"]["pinion"]["max_depth_um"].as_f64().unwrap() < depth);
    assert!(
        said.contains("worst pinion tooth") && said.contains("tooth 1;"),
        "{said}"
    );
    // every tooth of a member is in one class
    let mut teeth: Vec<u64> = classes
        .iter()
        .filter(|class| class["member"] == "pinion")
        .flat_map(|class| class["teeth"].as_array().unwrap())
        .map(|tooth| tooth.as_u64().unwrap())
        .collect();
    teeth.sort_unstable();
    assert_eq!(teeth, (1..=27).collect::<Vec<u64>>());
    let turn = read(&differ, "transmission_error_turn.csv");
    let last = rows(&turn).last().unwrap()[1].parse::<f64>().unwrap();
    assert!(last > 52.0 && last < 53.0, "{last}");
}

/// Depths of the proud tooth and of one far from it as measured rows: each is predicted for the tooth it names, and not for the other.
#[test]
fn rows_are_predicted_for_the_tooth_they_name() {
    let home = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(home.path().join(name), text).unwrap();
    let study = format!("{STUDY}{TEETH}");
    write("run.toml", &study);
    succeed(home.path(), "run run.toml -o run");
    let table = read(&home.path().join("run"), "wear.csv");
    let last = rows(&table).last().unwrap()[0].to_owned();
    let measured = |label: &dyn Fn(&str) -> &'static str| {
        let mut text = "test,member,cycles,quantity,position,value,sigma,trace,tooth\n".to_owned();
        for row in rows(&table) {
            let tooth = row[5];
            if row[0] != last || row[1] != "pinion" || !["1", "4"].contains(&tooth) {
                continue;
            }
            text += &format!(
                "A,pinion,{last},wear_depth,{},{},0.05,{tooth},{}\n",
                row[2],
                row[4],
                label(tooth)
            );
        }
        text
    };
    let compared = |measurements: &str, study: &str, effect: &str| -> Value {
        write("measurements.csv", measurements);
        write(
            "study.toml",
            &format!(
                "{study}{effect}[noise]\ncoefficient_scatter = 0.0\ndatum = 1e-6\n[[test]]\nid = \"A\"\ncycles = 1e6\n[measurements]\nfile = \"measurements.csv\"\n"
            ),
        );
        serde_json::from_str(&succeed(home.path(), "compare study.toml --json")).unwrap()
    };
    let chi2_with = |measurements: &str, effect: &str| {
        let json = compared(measurements, &study, effect);
        json["chi2_per_point"].as_f64().unwrap()
    };
    let chi2 = |measurements: &str| chi2_with(measurements, "");
    let right = chi2(&measured(&|tooth| if tooth == "1" { "1" } else { "4" }));
    let swapped = chi2(&measured(&|tooth| if tooth == "1" { "4" } else { "1" }));
    assert!(right < 0.05, "{right}");
    assert!(swapped > 10.0, "{swapped}");
    // rows without a label stay those of the mean tooth beside an effect that moves a tooth by next to nothing
    let nothing = "[[effect]]\nkind = \"pitch_error\"\ndeviation = 1e-4\n";
    let unlabelled = measured(&|_| "");
    let [without, with] = ["", nothing].map(|effect| chi2_with(&unlabelled, effect));
    assert!((with / without - 1.0).abs() < 0.01, "{without} {with}");
    // a model whose teeth are all alike says that it predicts the same for both
    let labelled = measured(&|tooth| if tooth == "1" { "1" } else { "4" });
    let warned = |study: &str, effect: &str| {
        let warnings = compared(&labelled, study, effect)["warnings"].to_string();
        warnings.contains("rows name 2 teeth of the pinion")
    };
    assert!(warned(STUDY, ""));
    assert!(!warned(&study, ""));
    assert!(!warned(STUDY, nothing));
}

#[test]
fn a_tooth_that_is_not_there_is_refused() {
    let home = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(home.path().join(name), text).unwrap();
    let test = "[[test]]\nid = \"A\"\ncycles = 1e6\n[measurements]\nfile = \"m.csv\"\n";
    write("study.toml", &format!("{STUDY}{TEETH}{test}"));
    let check = |tooth: &str| {
        let row = format!("A,pinion,1e6,wear_depth,27.0,3.0,0.1,p,{tooth}\n");
        let header = "test,member,cycles,quantity,position,value,sigma,trace,tooth\n";
        write("m.csv", &format!("{header}{row}"));
        line(home.path(), "check study.toml")
    };
    for tooth in ["1", "27", "left"] {
        let (code, _, error) = check(tooth);
        assert_eq!(code, Some(0), "{tooth}: {error}");
    }
    for tooth in ["0", "28", "-1"] {
        let (code, _, error) = check(tooth);
        assert_eq!(code, Some(2), "{tooth}: {error}");
        let says = format!("m.csv:2 names tooth {tooth} of the pinion, which has 27");
        assert!(
            error.contains(&says) && error.contains("1 to 27"),
            "{error}"
        );
    }
}

/// An axis that lies off moves all pairs in mesh alike: wear stays as it is to the byte, and the lag swings by e over the pinion's base
/// radius, 27 cos 20° mm, once per turn of the gear.
#[test]
fn an_eccentric_gear_swings_the_lag_and_nothing_else() {
    let home = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(home.path().join(name), text).unwrap();
    let run_out = "[teeth.gear]\neccentricity = 20\neccentricity_phase = 40\n";
    write("centred.toml", STUDY);
    write("off.toml", &format!("{STUDY}{run_out}"));
    for name in ["centred", "off"] {
        succeed(home.path(), &format!("run {name}.toml -o {name}"));
    }
    let file = |folder: &str, name: &str| read(&home.path().join(folder), name);
    for name in ["wear.csv", "contact.csv", "transmission_error.csv"] {
        assert_eq!(file("centred", name), file("off", name), "{name}");
    }
    let table = file("off", "transmission_error_turn.csv");
    let fresh: Vec<[f64; 2]> = rows(&table)
        .into_iter()
        .filter(|row| row[0] == "0")
        .map(|row| [1, 2].map(|i| row[i].parse().unwrap()))
        .collect();
    let (mut cosine, mut sine) = (0.0, 0.0);
    for [rotation, angle] in &fresh {
        let phase = std::f64::consts::TAU * rotation / 53.0;
        cosine += 2.0 * angle * phase.cos() / fresh.len() as f64;
        sine -= 2.0 * angle * phase.sin() / fresh.len() as f64;
    }
    let amplitude = 20e3 / (27.0 * 20f64.to_radians().cos());
    let off = cosine.hypot(sine) / amplitude - 1.0;
    assert!(off.abs() < 1e-9, "{off:e}");
    let phase = sine.atan2(cosine).to_degrees();
    assert!((phase - 40.0).abs() < 1e-6, "{phase}");
}

#[test]
fn unusable_teeth_end_with_code_2_and_nothing_written() {
    for (table, says) in [
        (
            "[teeth.pinion]\npitch_deviations = [1, 2, 3]\n",
            "3 deviations for 27 teeth",
        ),
        ("[teeth.pinion]\npitch_file = \"p.csv\"\n", "p.csv"),
        (
            "[teeth.gear]\npitch_pattern = [5, 0]\n[face]\nslices = 3\n",
            "face.slices",
        ),
        (
            "[[effect]]\nkind = \"run_out\"\n[face]\nslices = 3\n",
            "face.slices",
        ),
    ] {
        let home = tempfile::tempdir().unwrap();
        let fem = STUDY.replace("\"hertz\"", "\"fem\"");
        fs::write(home.path().join("study.toml"), format!("{fem}{table}")).unwrap();
        let (code, out, error) = line(home.path(), "run study.toml -o out");
        assert_eq!((code, out.as_str()), (Some(2), ""), "{table}: {error}");
        assert!(
            error.contains(says) && error.contains("study.toml:"),
            "{table}: {error}"
        );
        assert_eq!(fs::read_dir(home.path()).unwrap().count(), 1);
    }
    let home = tempfile::tempdir().unwrap();
    let paper = STUDY.replace("\"hertz\"", "\"paper\"");
    fs::write(home.path().join("study.toml"), format!("{paper}{TEETH}")).unwrap();
    let (code, _, error) = line(home.path(), "run study.toml -o out");
    assert_eq!(code, Some(2));
    assert!(
        error.contains("teeth of a member alike") && error.contains("study.toml:"),
        "{error}"
    );
}
