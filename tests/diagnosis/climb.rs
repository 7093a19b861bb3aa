//! The command `climb`: what it finds, what it writes, how it goes on.

use std::path::{Path, PathBuf};

use gearwear::study::Study;
use serde_json::Value;

use super::command::gearwear;

/// Two effects, by the analytic contact, in a folder of its own; the last test is held out.
fn study(folder: &Path, hidden: &str) -> PathBuf {
    let data = crate::synthetic(hidden, 0.05, 0.02, 41);
    let mut csv = "test,member,cycles,quantity,position,value,sigma,trace\n".to_owned();
    for o in &data.observations {
        let position = o.position.map_or(String::new(), |p| p.to_string());
        let trace = o.trace.map_or(String::new(), |t| t.to_string());
        csv.push_str(&format!(
            "{},{},{},{},{position},{},{},{trace}\n",
            data.tests[o.test],
            o.member.name(),
            o.cycles,
            o.quantity.name(),
            o.value,
            o.sigma
        ));
    }
    std::fs::write(folder.join("measurements.csv"), csv).unwrap();
    let mut text = crate::study("").text().to_owned();
    let last = text.rfind("role = \"fit\"").unwrap();
    text.replace_range(last..last + 12, "role = \"holdout\"");
    let path = folder.join("study.toml");
    std::fs::write(&path, text).unwrap();
    path
}

const BOTH: &str = "[[effect]]\nkind = \"running_in\"\namplitude = 2.0\ndecay_cycles = 2e5\n\
     [[effect]]\nkind = \"pressure_exponent\"\nexponent = 1.4\n";

#[test]
fn it_finds_one_effect_after_the_other_and_ends_with_a_study_of_them() {
    let folder = tempfile::tempdir().unwrap();
    let path = study(folder.path(), BOTH);
    let output = gearwear()
        .args(["climb", "--json"])
        .arg(&path)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    assert!(!said.contains("finished diagnosis"), "{said}");
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    let mut effects: Vec<&str> = (document["effects"].as_array().unwrap().iter())
        .map(|effect| effect.as_str().unwrap())
        .collect();
    effects.sort_unstable();
    assert_eq!(effects, ["pressure_exponent", "running_in"], "{document:#}");
    assert_eq!(document["verdict"], "nothing_missing");
    // the error on tests that nothing was fitted to falls at every step that was kept
    let steps = document["steps"].as_array().unwrap();
    // of those that pay, the one that all measurements make the most likely
    let value = |step: &Value, key: &str| step[key].as_f64().unwrap();
    let alike = |step: &&&Value| {
        step["why"].as_str().unwrap()
            == format!("{name} does better by evidence and on the held-out tests")
    };
    for step in tried.iter().filter(|s| s["kept"] == false).filter(alike) {
        let better = value(kept[0], "holdout_chi2_per_point")
            <= value(step, "holdout_chi2_per_point")
            || value(kept[0], "log_evidence_gain") >= value(step, "log_evidence_gain");
        assert!(better, "{document:#}");
    }
    let page = made.join("study.out/climb/report.html");
    assert!(std::fs::read_to_string(page).unwrap().contains(choice));
}

#[test]
fn it_does_not_go_on_from_another_study_s_climb() {
    let folder = tempfile::tempdir().unwrap();
    let path = study(folder.path(), "");
    let out = folder.path().join("study.out");
    std::fs::create_dir_all(&out).unwrap();
    std::fs::write(out.join(".climb.checkpoint"), "{\"inputs_sha256\": \"0\"}").unwrap();
    let output = gearwear()
        .args(["climb", "--quiet", "--resume"])
        .arg(&path)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains(".climb.checkpoint"), "{said}");
    assert!(!out.join("climb").exists());
}
