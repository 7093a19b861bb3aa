//! What is said of a study without measurements: how to come by the file, and which files beside the study are such.

use std::fs;

use super::{home, line};

#[test]
fn a_study_without_measurements_is_told_where_they_come_from() {
    let home = home();
    let write = |name: &str, text: &str| fs::write(home.path().join(name), text).unwrap();
    let study = fs::read_to_string(home.path().join("study.toml")).unwrap();
    let (bare, _) = study.split_once("[measurements]").unwrap_or((&study, ""));
    write("bare.toml", bare);
    let (code, _, message) = line(&home, "check bare.toml");
    assert_eq!(code, Some(2));
    for part in [
        "names no measurements",
        "gearwear import TABLE --study STUDY -o measurements.csv",
        "gearwear plan STUDY",
    ] {
        assert!(message.contains(part), "no `{part}` in {message}");
    }
    // a file that is not there: of the tables beside it only those with measurements are named
    write(
        "named.toml",
        &format!("{bare}\n[measurements]\nfile = \"none.csv\"\n"),
    );
    write("tests.csv", "id,torque\nZ,100\n");
    write("lab.csv", "Radius [mm];0,25\n26,5;1\n");
    write(
        "mine.csv",
        "# of May\ntest,member,cycles,quantity,position,value,sigma,trace\n",
    );
    let (code, _, message) = line(&home, "check named.toml");
    assert_eq!(code, Some(2));
    assert!(
        message.contains("measurement files here: mine.csv\n"),
        "{message}"
    );
    assert!(message.contains("gearwear import FILE"), "{message}");
}
