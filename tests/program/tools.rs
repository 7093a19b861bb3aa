//! Claim: the tools around a run keep their word. A measured profile that is a linear tip relief gives what the relief's own keys
//! give; numbers with units give what plain numbers give; a sweep's points are runs, an interrupted sweep goes on where it
//! stopped; an exported deck is the position that gearwear solves, and CalculiX agrees with it; mistakes end with exit code 2
//! and nothing written.
//!
//! Sources: the program's own other ways to the same result, the units' definitions, CalculiX where it is installed. Tolerances:
//! none for units (same numbers, same bits); 1e-6 relative for the profile (a line over the curvature radius through rows that
//! hold the relief exactly; radii are written to 1e-9 mm); 2 % turn and 5 % peak pressure for CalculiX (penalty contact).

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use gearwear::gear::{BasicRack, Gear, ToothSpec};
use gearwear::verify::calculix::{self, CalculixError};
use serde_json::Value;
use tempfile::TempDir;

use crate::common::gears;

/// A coarse study of about a second; one line per key, so that tests can replace lines.
const STUDY: &str = concat!(
    "title = \"coarse\"\n",
    gears!("centre_distance = 80.0\n"),
    "\
[operation]
torque = 100.0
speed = 2000.0
[wear]
coefficient = 6e-10
cycles = 50000
[numerics]
elements_per_half_width = 2
positions = 20
stored_states = 1
fields = 0
"
);

struct Home(TempDir);

impl Home {
    fn with(study: &str) -> Self {
        let home = Home(tempfile::tempdir().unwrap());
        home.write("study.toml", study);
        home
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path().join(name), text).unwrap();
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path().join(name)).unwrap()
    }

    fn json(&self, name: &str) -> Value {
        serde_json::from_str(&self.read(name)).unwrap()
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::cargo_bin("gearwear").unwrap();
        command.current_dir(self.path()).args(arguments);
        command
    }

    fn gearwear(&self, arguments: &[&str]) -> (Option<i32>, String, String) {
        crate::common::gearwear(self.path(), arguments)
    }

    fn ok(&self, arguments: &[&str]) -> String {
        let (code, out, err) = self.gearwear(arguments);
        assert_eq!(code, Some(0), "{arguments:?}: {err}");
        out
    }

    /// The message of a refusal; nothing may be written.
    fn refused(&self, arguments: &[&str]) -> String {
        let before = fs::read_dir(self.path()).unwrap().count();
        let (code, out, err) = self.gearwear(arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {out}{err}");
        let after = fs::read_dir(self.path()).unwrap().count();
        assert_eq!(before, after, "something was written");
        err
    }
}

/// The figures of a run that cost and title leave alone.
fn figures(summary: &Value) -> [f64; 4] {
    [
        &summary["contact"]["peak_pressure"],
        &summary["contact"]["te_peak_to_peak_urad"],
        &summary["wear"]["pinion"]["max_depth_um"],
        &summary["wear"]["gear"]["mass_loss_mg"],
    ]
    .map(|value| value.as_f64().unwrap())
}

#[test]
fn numbers_with_units_are_the_same_study() {
    let plain = Home::with(STUDY);
    let with_units = STUDY
        .replace("module = 2.0", "module = \"2 mm\"")
        .replace("pressure_angle = 20.0", "pressure_angle = \"20 deg\"")
        .replace("face_width = 33.0", "face_width = \"3.3 cm\"")
        .replace("youngs_modulus = 2.1e5", "youngs_modulus = \"210 GPa\"")
        .replace("density = 7850.0", "density = \"7850 kg/m³\"")
        .replace("torque = 100.0", "torque = \"100 N·m\"")
        .replace("speed = 2000.0", "speed = \"2000 1/min\"");
    let units = Home::with(&with_units);
    for home in [&plain, &units] {
        home.ok(&["run", "study.toml", "-o", "out"]);
    }
    assert_eq!(plain.read("out/wear.csv"), units.read("out/wear.csv"));
    assert_eq!(plain.read("out/contact.csv"), units.read("out/contact.csv"));
}

#[test]
fn a_wrong_unit_is_refused_with_its_place() {
    let wrong = Home::with(&STUDY.replace("pressure_angle = 20.0", "pressure_angle = \"20 mm\""));
    let message = wrong.refused(&["run", "study.toml"]);
    for part in [
        "study.toml:4:18",
        "gears.pressure_angle",
        "a length, where an angle is asked for",
        "found the unit `mm`",
        "deg, rad",
    ] {
        assert!(message.contains(part), "{part}: {message}");
    }
}

/// Linear tip relief of 20 µm over 2 mm of the path of contact, by its keys and as a measured profile.
#[test]
fn a_profile_equal_to_tip_relief_gives_its_result() {
    let stated = STUDY.replace(
        "bore_diameter = 25.0",
        "bore_diameter = 25.0\ntip_relief_amount = 20.0\ntip_relief_length = 2.0",
    );
    let measured = STUDY.replace(
        "bore_diameter = 25.0",
        "bore_diameter = 25.0\nprofile_file = \"flank.csv\"",
    );
    let gear = Gear::new(BasicRack::iso53_a(2.0), ToothSpec::plain(27, 25.0)).unwrap();
    let start = gear.rho_tip - 2.0;
    let rows = [
        (gear.rho_form, 0.0),
        (start, 0.0),
        (start + 1.0, 10.0),
        (gear.rho_tip, 20.0),
    ];
    let mut table = "# made from the formula\nradius, deviation\n".to_owned();
    for (rho, deviation) in rows {
        table += &format!("{:.9}, {deviation}\n", gear.radius_at_rho(rho));
    }
    let (one, two) = (Home::with(&stated), Home::with(&measured));
    two.write("flank.csv", &table);
    let plain = Home::with(STUDY);
    let [one, two, plain] = [&one, &two, &plain].map(|home| {
        home.ok(&["run", "study.toml", "-o", "out"]);
        figures(&home.json("out/summary.json"))
    });
    for (a, b) in one.iter().zip(&two) {
        assert!((a / b - 1.0).abs() < 1e-6, "{one:?} {two:?}");
    }
    let moved = (one[2] / plain[2] - 1.0).abs();
    assert!(moved > 0.01, "the relief changes the wear: {moved}");
}

#[test]
fn faulty_profiles_are_refused_with_file_and_line() {
    let study = STUDY.replace(
        "bore_diameter = 40.0",
        "bore_diameter = 40.0\nprofile_file = \"flank.csv\"",
    );
    let cases = [
        ("", "the file is empty", "flank.csv"),
        ("radius,deviation\n52,1\n", "1 rows", "at least two rows"),
        ("radius,deviaton\n52,1\n", "unknown column", "`deviation`"),
        ("radius\n52\n", "deviation is missing", "flank.csv:1:1"),
        (
            "radius,deviation\n52,1\n53,nan\n",
            "not a finite number",
            "flank.csv:3:4",
        ),
        (
            "radius,deviation\n52,1\n60,1\n",
            "off the flank",
            "flank.csv:3:1",
        ),
        (
            "radius,deviation\n0.052,1\n0.053,1\n",
            "off the flank",
            "metres",
        ),
        (
            "radius,deviation\n104,1\n106,1\n",
            "off the flank",
            "diameter",
        ),
        (
            "radius,deviation\n53,1\n52,1\n",
            "52 mm after 53 mm",
            "flank.csv:3:1",
        ),
        ("radius,deviation\n52,1\n53,900\n", "out of range", "200 µm"),
        (
            "radius,deviation\n52,0.002\n53,0.02\n",
            "look like millimetres",
            "micrometres",
        ),
        (
            "radius,deviation\n52,1,2\n53,1\n",
            "3 cells",
            "flank.csv:2:1",
        ),
    ];
    for (table, says, place) in cases {
        let home = Home::with(&study);
        home.write("flank.csv", table);
        let message = home.refused(&["run", "study.toml"]);
        assert!(
            message.contains(says) && message.contains(place),
            "{table}: {message}"
        );
    }
    let message = Home::with(&study).refused(&["run", "study.toml"]);
    assert!(
        message.contains("there is no file") && message.contains("gears.gear.profile_file"),
        "{message}"
    );
}

#[test]
fn a_sweep_is_a_table_of_runs_and_goes_on_after_an_interruption() {
    let home = Home::with(STUDY);
    let grid = [
        "sweep",
        "study.toml",
        "--vary",
        "operation.misalignment=0,0.5 mm",
        "--vary",
        "wear.cycles=20000..40000:2",
        "-o",
        "out",
    ];
    let text = home.ok(&grid);
    assert!(
        text.contains("peak MPa") && text.lines().count() >= 6,
        "{text}"
    );
    let document = home.json("out/sweep.json");
    let points = document["points"].as_array().unwrap().clone();
    assert_eq!(points.len(), 4);
    assert_eq!(points[1]["values"]["wear.cycles"], 40000.0);
    assert!(home.read("out/sweep.svg").starts_with("<svg"));
    let table = home.read("out/sweep.csv");
    assert!(table.starts_with("operation.misalignment,wear.cycles,peak_pressure,te_peak"));
    assert_eq!(table.lines().count(), 5);

    // the first point is the run of that study, but for the mesh, which all points share
    let alone = Home::with(&STUDY.replace("cycles = 50000", "cycles = 20000"));
    alone.ok(&["run", "study.toml", "-o", "out"]);
    let run = figures(&alone.json("out/summary.json"));
    let swept = [
        "peak_pressure",
        "te_peak_to_peak_urad",
        "max_depth_pinion_um",
        "mass_loss_gear_mg",
    ]
    .map(|name| points[0]["figures"][name].as_f64().unwrap());
    for ((a, b), allowed) in run.iter().zip(&swept).zip([0.2, 0.02, 0.02, 0.02]) {
        assert!((a / b - 1.0).abs() < allowed, "{run:?} {swept:?}");
    }

    // an interrupted sweep: two points done, no result yet
    fs::remove_dir_all(home.path().join("out")).unwrap();
    let done = home.path().join(".out.points");
    fs::create_dir(&done).unwrap();
    for point in &points[..2] {
        let mut figures = point["figures"].clone();
        if point["values"]["wear.cycles"] == 40000.0 {
            figures["contact_ratio"] = 9.0.into(); // to be recognised: it is not computed again
        }
        let name = format!("{}.json", point["key"].as_str().unwrap());
        fs::write(done.join(name), figures.to_string()).unwrap();
    }
    let mut resumed = grid.to_vec();
    resumed.push("--resume");
    let text = home.ok(&resumed);
    assert!(text.contains("2 of 4 points were done already"), "{text}");
    let again = home.json("out/sweep.json")["points"].clone();
    assert_eq!(again[1]["figures"]["contact_ratio"], 9.0);
    assert_eq!(again[0], points[0]);
    assert_eq!(again[2], points[2], "computed again: the same bits");
    assert_eq!(again[3], points[3]);
    assert!(!done.exists());
    assert!(
        home.ok(&resumed)
            .contains("4 of 4 points were done already")
    );
    // a changed study is another sweep
    home.write("study.toml", &STUDY.replace("6e-10", "7e-10"));
    assert!(!home.ok(&resumed).contains("done already"));
}

/// Members' own coefficients are those of the effect that shares one k out between members.
#[test]
fn each_member_wears_by_its_own_coefficient() {
    let home = Home::with(STUDY);
    let ratio = 4.0f64;
    // k1 = k sqrt(ratio), k2 = k/sqrt(ratio)
    let own = format!(
        "[wear.pinion]\ncoefficient = {:e}\n[wear.gear]\ncoefficient = {:e}\n",
        6e-10 * ratio.sqrt(),
        6e-10 / ratio.sqrt()
    );
    let effect = format!(
        "[[effect]]\nkind = \"member_hardness\"\nlog_ratio = {:?}\n",
        ratio.ln()
    );
    home.write("own.toml", &format!("{STUDY}{own}"));
    home.write("effect.toml", &format!("{STUDY}{effect}"));
    for name in ["own", "effect", "study"] {
        home.ok(&["run", &format!("{name}.toml"), "-o", name]);
    }
    let wear = |name: &str, member: &str| {
        let summary = home.json(&format!("{name}/summary.json"));
        summary["wear"][member]["worn_area_mm2"].as_f64().unwrap()
    };
    for member in ["pinion", "gear"] {
        let (own, effect) = (wear("own", member), wear("effect", member));
        assert!(
            (own / effect - 1.0).abs() < 1e-9,
            "{member}: {own} {effect}"
        );
    }
    let pinion = wear("own", "pinion") / wear("study", "pinion");
    // twice the coefficient; where a flank is worn deeper it bears a little less
    assert!((1.9..2.0).contains(&pinion), "{pinion}");
    let conditions = home.json("own/summary.json")["conditions"].clone();
    assert_eq!(conditions["coefficient_gear"], 3e-10, "{conditions}");
    let page = home.read("own/report.html");
    assert!(page.contains("mm²/N pinion, "), "both stand in the report");
    let message = {
        home.write(
            "none.toml",
            &format!("{STUDY}[wear.gear]\ncoefficient = 1\n"),
        );
        home.refused(&["run", "none.toml"])
    };
    assert!(message.contains("wear.gear.coefficient"), "{message}");
}

/// A crown so high that one slice carries all is computed, and said to be too much for the slices.
#[test]
fn a_contact_narrower_than_a_slice_is_warned_of() {
    let warned = |crowning: f64| {
        let face = format!("[face]\nslices = 5\n[face.gear]\ncrowning = {crowning}\n");
        let home = Home::with(&format!("{STUDY}{face}"));
        home.ok(&["run", "study.toml", "-o", "out"])
            .contains("one of the 5 slices carries 100 % of the load")
    };
    assert!(warned(500.0));
    assert!(!warned(5.0));
}

/// What stands in the table of one member can be varied for the other.
#[test]
fn a_sweep_varies_keys_of_either_member() {
    let home = Home::with(&format!(
        "{STUDY}[face]\nslices = 3\ncoupling = \"none\"\n[face.gear]\ncrowning = 1.0\n"
    ));
    let text = home.ok(&[
        "sweep",
        "study.toml",
        "--vary",
        "face.gear.crowning=0,4",
        "-o",
        "out",
    ]);
    assert!(text.contains("crowning, µm"), "{text}");
    let table = home.read("out/sweep.csv");
    assert_eq!(table.lines().count(), 3, "{table}");
}

/// Points whose values are right one by one and no pair that runs together are rows with their reason.
#[test]
fn a_sweep_tells_the_points_that_are_no_pair() {
    let home = Home::with(STUDY);
    let vary = "gears.pinion.profile_shift=-0.1,0.3";
    let text = home.ok(&["sweep", "study.toml", "--vary", vary, "-o", "out"]);
    assert!(
        text.contains("1 of 2 points are no pair that runs"),
        "{text}"
    );
    let table = home.read("out/sweep.csv");
    let rows: Vec<&str> = table.lines().collect();
    assert!(
        rows[1].starts_with("-0.1,") && rows[1].ends_with(','),
        "{table}"
    );
    assert!(
        rows[2].starts_with("0.3,,,,,,,,,") && rows[2].contains("the teeth jam"),
        "{table}"
    );
    let points = home.json("out/sweep.json")["points"].clone();
    assert!(
        points[0]["figures"].is_object() && points[1].get("figures").is_none(),
        "{points}"
    );
    // none that runs is no sweep
    let vary = "gears.pinion.profile_shift=0.3,0.4";
    let message = home.refused(&["sweep", "study.toml", "--vary", vary]);
    assert!(message.contains("the teeth jam"), "{message}");
    assert_eq!(message.matches("error: ").count(), 1, "{message}");
}

#[test]
fn a_sweep_refuses_what_it_cannot_vary() {
    let home = Home::with(STUDY);
    let refused = |vary: &[&str]| {
        let mut arguments = vec!["sweep", "study.toml"];
        for v in vary {
            arguments.extend(["--vary", v]);
        }
        home.refused(&arguments)
    };
    for (vary, says) in [
        ("gears.gear.teeth=3", "5 to 1000"),
        ("gears.pinion=1", "no such key"),
        (
            "operation.torqe=1,2",
            "the nearest valid key is `operation.torque`",
        ),
        ("torque=1,2", "operation.torque"),
        ("operation.torque=abc", "number"),
        ("operation.torque=-5,100", "out of range"),
        ("operation.torque=\"5 mm\"", "operation.torque"),
        ("operation.torque=5 mm", "where a torque is asked for"),
        ("gears.pinion.teeth=20.5", "a whole number"),
        ("operation.torque=1..2", "FROM..TO:COUNT"),
        ("operation.torque", "KEY=VALUE"),
        ("operation.misalignment=25,30", "misalignment"),
        (
            "running_in.amplitude=1,2",
            "the study has no effect running_in",
        ),
        ("test.torque=1,2", "no such key"),
        ("fit.free=1,2", "no such key"),
    ] {
        let message = refused(&[vary]);
        assert!(message.contains(says), "{vary}: {message}");
    }
    let message = refused(&["wear.cycles=1,2", "wear.cycles=3"]);
    assert!(message.contains("varied twice"), "{message}");
}

#[test]
fn an_exported_deck_holds_the_position_and_calculix_agrees() {
    let home = Home::with(STUDY);
    let text = home.ok(&["export", "study.toml", "--position", "0", "-o", "deck"]);
    assert!(text.contains("ccx position_0.0000"), "{text}");
    let expected = home.json("deck/expected.json");
    let deck = home.read("deck/position_0.0000.inp");
    for keyword in [
        "*ELEMENT, TYPE=CPE6, ELSET=PINION",
        "*ELEMENT, TYPE=CPE6, ELSET=GEAR",
        "*CONTACT PAIR, INTERACTION=FLANKS, TYPE=SURFACE TO SURFACE",
        "*EQUATION",
        "*CLOAD",
    ] {
        assert!(deck.contains(keyword), "{keyword}");
    }
    // CalculiX reads no more than 20 characters of a number, and 132 of a line
    let longest = deck
        .lines()
        .filter(|line| !line.starts_with("**"))
        .flat_map(|line| line.split(", "))
        .filter(|cell| cell.parse::<f64>().is_ok())
        .map(str::len)
        .max();
    assert!(longest <= Some(20), "{longest:?}");
    let answer = match calculix::solve(&deck) {
        Err(CalculixError::Absent) => return,
        answer => answer.unwrap(),
    };
    let ours = expected["angle_urad"].as_f64().unwrap();
    let theirs = 1e6 * answer.turn;
    assert!((ours / theirs - 1.0).abs() < 0.02, "{ours} {theirs} µrad");
    // two edges per half width resolve no peak; the validation's X1 compares it on finer meshes
    assert!(answer.peak_pressure > 0.0);
}

#[test]
fn an_export_outside_the_base_pitch_or_with_friction_is_refused() {
    let home = Home::with(STUDY);
    home.refused(&["export", "study.toml", "--position", "1.5"]);
    let slope = format!("{STUDY}[[effect]]\nkind = \"tip_relief\"\namount = 5.0\nlength = 1.0\n");
    let message = Home::with(&slope).refused(&["export", "study.toml"]);
    assert!(message.contains("changes the contact itself"), "{message}");
}

#[test]
fn every_shell_gets_its_completions() {
    let home = Home::with(STUDY);
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = home.ok(&["completions", shell]);
        assert!(
            script.contains("gearwear") && script.contains("diagnose"),
            "{shell}"
        );
        assert_eq!(
            home.ok(&["completions", shell, "--quiet"]),
            script,
            "{shell}"
        );
    }
    home.refused(&["completions", "tcsh"]);
}

/// Nothing but the text goes down a pipe, and `--quiet` silences summaries but no errors.
#[test]
fn pipes_and_quiet_runs_carry_no_colour_and_no_progress() {
    let home = Home::with(STUDY);
    let (code, out, err) = home.gearwear(&["mesh", "study.toml", "-o", "a"]);
    assert_eq!(code, Some(0));
    assert!(!out.contains('\u{1b}') && err.is_empty(), "{out}{err}");
    assert_eq!(home.ok(&["mesh", "study.toml", "-o", "a", "--quiet"]), "");
    for no_colour in ["", "1"] {
        let mut command = home.command(&["run", "missing.toml", "--quiet"]);
        let output = command.env("NO_COLOR", no_colour).output().unwrap();
        let err = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2));
        assert!(
            err.contains("missing.toml") && !err.contains('\u{1b}'),
            "{err}"
        );
    }
}
