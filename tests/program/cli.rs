//! Claim: the program keeps its word on exit codes and streams: 0 with the result on standard output, 2 for unusable input
//! with nothing written, errors on standard error whatever the options.
//!
//! Source: the command table in the README. Tolerance: none; the whole program is started and its streams and files are read.

use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::common::gearwear;

/// A folder with the `paper` example in it.
fn home() -> TempDir {
    let home = tempfile::tempdir().unwrap();
    assert_eq!(gearwear(&home, &["init"]).0, Some(0));
    home
}

/// All files and folders below, relative, sorted.
fn tree(folder: &Path) -> Vec<PathBuf> {
    fn walk(folder: &Path, root: &Path, found: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            found.push(path.strip_prefix(root).unwrap().to_owned());
            if path.is_dir() {
                walk(&path, root, found);
            }
        }
    }
    let mut found = Vec::new();
    walk(folder, folder, &mut found);
    found.sort();
    found
}

#[test]
fn help_and_version_go_to_standard_output() {
    let home = tempfile::tempdir().unwrap();
    for arguments in [
        &["--help"][..],
        &["help", "run"],
        &["init", "--help"],
        &["validate", "-h"],
        &["--version"],
    ] {
        let (code, out, err) = gearwear(&home, arguments);
        assert_eq!((code, err.as_str()), (Some(0), ""), "{arguments:?}");
        assert!(out.contains("gearwear"), "{arguments:?}: {out}");
    }
    for command in ["init", "run", "models", "mesh", "validate"] {
        let (_, out, _) = gearwear(&home, &[command, "--help"]);
        assert!(
            out.contains("Examples:") && out.contains(&format!("gearwear {command}")),
            "{out}"
        );
    }
}

#[test]
fn wrong_usage_is_unusable_input() {
    let home = tempfile::tempdir().unwrap();
    let wrong: [&[&str]; 6] = [
        &[],
        &["rum"],
        &["run"],
        &["run", "s.toml", "--frobnicate"],
        &["--threads", "0", "validate"],
        &["init", "--example", "rust"],
    ];
    for arguments in wrong {
        let (code, out, err) = gearwear(&home, arguments);
        assert_eq!((code, out.as_str()), (Some(2), ""), "{arguments:?}");
        assert!(!err.is_empty(), "{arguments:?}");
    }
    assert!(tree(home.path()).is_empty());
}

#[test]
fn init_writes_a_study_and_measurements() {
    let home = tempfile::tempdir().unwrap();
    for example in ["paper", "fzg-c", "plastic-steel"] {
        let (code, out, err) = gearwear(&home, &["init", "--example", example, example]);
        assert_eq!((code, err.as_str()), (Some(0), ""));
        assert!(
            out.contains(&format!("gearwear run {example}/study.toml")),
            "{out}"
        );
        let text = fs::read_to_string(home.path().join(example).join("study.toml")).unwrap();
        gearwear::study::Study::parse(&text, "study.toml").unwrap();
        assert!(home.path().join(example).join("measurements.csv").is_file());
    }
}

#[test]
fn init_answers_in_json() {
    let home = tempfile::tempdir().unwrap();
    let (code, out, _) = gearwear(&home, &["init", "a/b", "--json"]);
    let document: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!(code, Some(0));
    assert_eq!(
        document,
        serde_json::json!({ "written": ["a/b/study.toml", "a/b/measurements.csv", "a/b/template.csv"] })
    );
}

#[test]
fn init_overwrites_only_by_force() {
    let home = tempfile::tempdir().unwrap();
    let study = home.path().join("study.toml");
    fs::write(&study, "mine").unwrap();
    let (code, out, err) = gearwear(&home, &["init", "--quiet"]);
    assert_eq!((code, out.as_str()), (Some(2), ""));
    assert!(
        err.contains("study.toml is there already") && err.contains("--force"),
        "{err}"
    );
    assert_eq!(fs::read_to_string(&study).unwrap(), "mine");
    assert_eq!(
        tree(home.path()),
        [PathBuf::from("study.toml")],
        "nothing written"
    );
    let (code, out, err) = gearwear(&home, &["init", "--quiet", "--force"]);
    assert_eq!((code, out.as_str(), err.as_str()), (Some(0), "", ""));
    assert!(fs::read_to_string(&study).unwrap().contains("[gears]"));
    let (code, _, err) = gearwear(&home, &["init", "study.toml"]);
    assert_eq!(code, Some(2));
    assert!(err.contains("study.toml is a file"), "{err}");
}

#[test]
fn a_bad_study_is_refused_with_its_place_and_nothing_is_written() {
    let home = home();
    let study = home.path().join("study.toml");
    let good = fs::read_to_string(&study).unwrap();
    fs::write(&study, good.replace("module = 2.0 ", "modul = 2.0 ")).unwrap();
    let before = tree(home.path());
    for command in ["run", "models", "mesh"] {
        for options in [&[][..], &["--quiet"], &["--json"], &["-o", "results"]] {
            let (code, out, err) =
                gearwear(&home, &[&[command, "study.toml"][..], options].concat());
            assert_eq!(
                (code, out.as_str()),
                (Some(2), ""),
                "{command} {options:?}: {err}"
            );
            for part in [
                "error: unknown key `gears.modul`",
                "study.toml:9:1",
                "found `modul`",
                "allowed: module",
                "^^^^^",
                "nearest",
            ] {
                assert!(
                    err.contains(part),
                    "{command} {options:?}: no `{part}` in:\n{err}"
                );
            }
            assert!(!err.contains('\u{1b}'), "colour on no terminal");
        }
    }
    assert_eq!(tree(home.path()), before);
}

#[test]
fn a_missing_study_and_a_missing_test_are_refused() {
    let home = home();
    let before = tree(home.path());
    let (code, _, err) = gearwear(&home, &["run", "nothing.toml"]);
    assert_eq!(code, Some(2));
    assert!(
        err.contains("nothing.toml") && err.contains("study.toml"),
        "{err}"
    );
    let (code, _, err) = gearwear(&home, &["run", "study.toml", "--test", "C"]);
    assert_eq!(code, Some(2));
    assert!(
        err.contains("\"C\"") && err.contains("\"A\", \"B\""),
        "{err}"
    );
    assert_eq!(tree(home.path()), before);
}

#[test]
fn a_foreign_result_folder_is_refused_and_left_alone() {
    let home = home();
    fs::create_dir_all(home.path().join("study.out/run")).unwrap();
    fs::write(home.path().join("study.out/run/thesis.txt"), "precious").unwrap();
    fs::create_dir(home.path().join("mine")).unwrap();
    fs::write(home.path().join("mine/thesis.txt"), "precious").unwrap();
    let before = tree(home.path());
    let foreign: [&[&str]; 5] = [
        &["run", "study.toml"],
        &["run", "study.toml", "-o", "mine"],
        &["run", "study.toml", "--output", "mine/thesis.txt"],
        &["models", "study.toml", "-o", "mine"],
        &["validate", "-o", "mine"],
    ];
    for arguments in foreign {
        let (code, out, err) = gearwear(&home, arguments);
        assert_eq!((code, out.as_str()), (Some(2), ""), "{arguments:?}");
        assert!(err.contains("-o"), "{err}");
    }
    assert_eq!(tree(home.path()), before);
}

#[test]
fn a_closed_pipe_is_no_error() {
    let mut child = std::process::Command::new(assert_cmd::cargo::cargo_bin!("gearwear"))
        .args(["init", "--help"])
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    assert!(output.stderr.is_empty());
}

#[test]
fn a_mistyped_command_is_told() {
    let home = tempfile::tempdir().unwrap();
    let (code, _, message) = gearwear(&home, &["rnu", "study.toml"]);
    assert_eq!(code, Some(2));
    assert!(
        message.contains("did you mean `gearwear run`?"),
        "{message}"
    );
    let (_, _, message) = gearwear(&home, &["frobnicate"]);
    assert!(!message.contains("did you mean"), "{message}");
}
