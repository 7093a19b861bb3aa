//! Claim: what rows state of their place across the face is used, or it is said that it is not: a model of one section with an effect
//! across the face is not compared with rows at another place; stated slices are kept, unstated ones follow from the effects.
//!
//! Source: the format's description in the guide (`face.md`, `measurements.md`). Tolerance: none.

use std::collections::BTreeSet;
use std::fs;

use tempfile::TempDir;

use crate::common::{gears, line, succeed};

const BASE: &str = concat!(
    gears!("centre_distance = 80.0\n"),
    r#"[operation]
torque = 100.0
speed = 2000.0
[wear]
coefficient = 2e-10
cycles = 1e6
[numerics]
positions = 40
[noise]
coefficient_scatter = 0.0
[[test]]
id = "A"
[measurements]
file = "rows.csv"
"#
);
const HERTZ: &str = "[model]\ncontact = \"hertz\"\n";
/// Traces whose row says nothing are at the end of the face, 16.5 mm from its middle.
const WEDGE: &str = "[[effect]]\nkind = \"lead_misalignment\"\nslope = 4.0\n";

/// A folder with the study and rows at the places `faces` across the face, beside one of transmission error at the first of them.
fn home(study: &str, faces: &[&str]) -> TempDir {
    let home = tempfile::tempdir().unwrap();
    let mut rows = "test,member,cycles,quantity,position,value,sigma,face\n".to_owned();
    for face in faces {
        for radius in ["26.0", "26.4", "27.6", "28.2"] {
            rows += &format!("A,pinion,1e6,wear_depth,{radius},4.0,0.4,{face}\n");
        }
    }
    rows += &format!(
        "A,pair,1e6,transmission_error,0.25,-14.2,0.5,{}\n",
        faces[0]
    );
    fs::write(home.path().join("study.toml"), study).unwrap();
    fs::write(home.path().join("rows.csv"), rows).unwrap();
    home
}

fn refusal(home: &TempDir) -> String {
    let (code, _, message) = line(home, "compare study.toml");
    assert_eq!(code, Some(2), "{message}");
    assert!(
        !home.path().join("study.out").exists(),
        "nothing is written"
    );
    message
}

#[test]
fn rows_where_one_section_is_not_are_refused() {
    for faces in [&["0"][..], &["16.5", "-16.5"], &["mean"]] {
        let message = refusal(&home(&format!("{BASE}{HERTZ}{WEDGE}"), faces));
        for part in [
            "model.contact",
            "rows.csv:",
            "one section",
            "\"fem\"",
            "face_position",
        ] {
            assert!(message.contains(part), "no `{part}` in:\n{message}");
        }
    }
    let one = format!("{BASE}{WEDGE}[face]\nslices = 1\n");
    assert!(refusal(&home(&one, &["0"])).contains("face.slices"));
}

#[test]
fn rows_at_the_place_of_the_effect_are_compared() {
    for (wedge, face) in [
        (WEDGE.to_owned(), "16.5"),
        (WEDGE.to_owned(), ""),
        (format!("{WEDGE}face_position = -0.5\n"), "-8.25"),
        (format!("{WEDGE}face_mean = 1\n"), "mean"),
    ] {
        let home = home(&format!("{BASE}{HERTZ}{wedge}"), &[face]);
        let text = succeed(&home, "compare study.toml");
        assert!(!text.contains("across the face"), "{text}");
    }
}

#[test]
fn places_that_are_not_used_are_named() {
    let home = home(&format!("{BASE}{HERTZ}"), &["16.5", "-16.5"]);
    let text = succeed(&home, "compare study.toml");
    assert!(
        text.contains(
            "rows state 2 places across the face, and the model is the same at all of them"
        ),
        "{text}"
    );
    assert!(
        text.contains("1 row of what is of the whole face"),
        "{text}"
    );
    assert!(text.contains("rows.csv:10 (transmission_error)"), "{text}");
    // a diagnosis by the analytic model cannot judge what differs across the face
    let text = succeed(&home, "diagnose study.toml --fast");
    let needs = "Not judged: lead_misalignment, which needs model.contact = \"fem\" in the study";
    assert!(text.contains(needs), "{text}");
    assert!(!text.contains("\n  lead_misalignment "), "{text}");
}

/// No study is written whose own measurements are refused with it: forms at another place are left, and where none is left `add` says why.
#[test]
fn what_add_writes_can_be_compared() {
    let mid = home(&format!("{BASE}{HERTZ}"), &["0"]);
    succeed(&mid, "add study.toml lead_misalignment -o new.toml");
    let text = fs::read_to_string(mid.path().join("new.toml")).unwrap();
    assert!(text.contains("face_position = 0"), "{text}");
    succeed(&mid, "compare new.toml");
    let ends = home(&format!("{BASE}{HERTZ}"), &["16.5", "-16.5"]);
    let (code, _, message) = line(&ends, "add study.toml lead_misalignment -o new.toml");
    assert_eq!(code, Some(2), "{message}");
    assert!(message.contains("one section"), "{message}");
    assert!(!ends.path().join("new.toml").exists());
}

#[test]
fn stated_slices_are_kept_and_unstated_ones_follow_from_the_effects() {
    let coarse = "positions = 40\nelements_per_half_width = 1\nstored_states = 1\nfields = 0\n";
    let base = BASE.replace("positions = 40\n", coarse);
    for (face, slices) in [
        ("", 7),
        ("[face]\nslices = 1\n", 1),
        ("[face]\nslices = 3\n", 3),
    ] {
        let home = home(&format!("{base}{WEDGE}{face}"), &[""]);
        succeed(&home, "run study.toml -o out");
        let table = fs::read_to_string(home.path().join("out/wear.csv")).unwrap();
        let (header, rows) = table.split_once('\n').unwrap();
        let column = header.split(',').position(|name| name == "face");
        let place = |row: &str| column.map(|c| row.split(',').nth(c).unwrap().to_owned());
        let places: BTreeSet<_> = rows.lines().map(place).collect();
        assert_eq!(places.len(), slices, "{face}");
    }
}
