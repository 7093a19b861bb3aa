//! Claim: `compare --each FOLDER` makes one table of a folder's studies: the numbers are those of single comparisons, a study that cannot be
//! compared is a row with its reason, and the exit code is then 1.
//!
//! Source: the program's single comparisons. Tolerance: none.

use std::fs;

use serde_json::Value;

use crate::common::{gears, line, succeed};

const STUDY: &str = concat!(
    "title = \"each\"\n",
    gears!("centre_distance = 80.0\n"),
    "\
[operation]
torque = 100.0
speed = 2000.0
[wear]
coefficient = 3e-10
cycles = 400000
[model]
contact = \"hertz\"
[numerics]
elements_per_half_width = 2
positions = 24
[[test]]
id = \"A\"
"
);

#[test]
fn one_table_of_all() {
    let home = tempfile::tempdir().unwrap();
    fs::write(home.path().join("study.toml"), STUDY).unwrap();
    for (name, seed) in [("b", 1), ("a", 2)] {
        succeed(
            &home,
            &format!("synthesize study.toml -o archive/{name} --seed {seed}"),
        );
    }
    succeed(&home, "compare archive/a/study.toml -o alone");
    let alone = fs::read_to_string(home.path().join("alone/comparison.json")).unwrap();
    let alone: Value = serde_json::from_str(&alone).unwrap();
    let out = succeed(&home, "compare --each archive");
    assert!(out.contains("each.csv"), "{out}");
    let table = fs::read_to_string(home.path().join("archive.out/compare-each/each.csv")).unwrap();
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!(rows.len(), 3);
    assert!(
        rows[0].starts_with("study,points,chi2_per_point,"),
        "{table}"
    );
    let a: Vec<&str> = rows[1].split(',').collect();
    assert_eq!(a[0], "a/study.toml");
    assert_eq!(
        a[2].parse::<f64>().unwrap(),
        alone["chi2_per_point"].as_f64().unwrap()
    );
    assert!(rows[1].contains("wear.coefficient = "), "{table}");
    assert!(
        home.path()
            .join("archive/b/study.out/compare/comparison.json")
            .is_file()
    );
    // a study without measurements, and one that is none
    fs::write(home.path().join("archive/c.toml"), STUDY).unwrap();
    fs::write(home.path().join("archive/d.toml"), "[gears]\nmodule = -1\n").unwrap();
    for command in ["compare", "diagnose --fast"] {
        let folder = if command == "compare" {
            "archive"
        } else {
            "broken"
        };
        if folder == "broken" {
            fs::create_dir(home.path().join(folder)).unwrap();
            fs::copy(
                home.path().join("archive/c.toml"),
                home.path().join("broken/c.toml"),
            )
            .unwrap();
        }
        let (code, out, err) = line(&home, &format!("{command} --each {folder} -o table --json"));
        assert_eq!(code, Some(1), "{err}");
        let rows: Value = serde_json::from_str(&out).unwrap();
        let of = |name: &str| {
            let row = rows
                .as_array()
                .unwrap()
                .iter()
                .find(|row| row["study"] == name);
            row.unwrap_or_else(|| panic!("{rows}"))["error"].clone()
        };
        assert!(
            of("c.toml")
                .as_str()
                .unwrap()
                .contains("names no measurements")
        );
        if folder == "archive" {
            assert!(of("d.toml").as_str().unwrap().contains("module"));
            assert!(of("a/study.toml").is_null());
        }
    }
    for wrong in ["nowhere", "table"] {
        let (code, _, err) = line(&home, &format!("compare --each {wrong}"));
        assert_eq!(code, Some(2), "{err}");
        assert!(err.contains("--each"), "{err}");
    }
}
