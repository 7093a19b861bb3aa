//! The command `plan`: a table after measurements, a campaign before, refusals.
//!
//! Claim: both are made and hold what they promise; a campaign never loses an effect by a test more (a set of tests says at least what
//! its parts say). Tolerance: none.

use std::path::Path;

use serde_json::Value;

use super::command::{gearwear, small};

fn planned(study: &Path, target: &Path) -> Value {
    let output = gearwear()
        .args(["plan", "--json", "--quiet", "-o"])
        .arg(target)
        .arg(study)
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    for name in ["plan.json", "plan.csv", "report.html"] {
        assert!(target.join(name).is_file(), "{name}");
    }
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn after_measurements_all_feasible_tests_are_ranked() {
    let folder = tempfile::tempdir().unwrap();
    let study = small(folder.path());
    let plan = planned(&study, &folder.path().join("plan"));
    assert_eq!(plan["kind"], "next_tests");
    let tests = plan["tests"].as_array().unwrap();
    // every feasible test with each of three quantities
    assert_eq!(tests.len(), 21 * 3);
    let chi2 = |row: &Value| row["expected_chi2"].as_f64().unwrap();
    let best = tests.iter().map(chi2).fold(0.0, f64::max);
    assert!(chi2(&tests[0]) >= 0.8 * best);
    assert!(!tests[0]["separates"].as_array().unwrap().is_empty());
}

#[test]
fn before_measurements_a_campaign_is_chosen() {
    let folder = tempfile::tempdir().unwrap();
    let study = small(folder.path());
    let text = std::fs::read_to_string(&study).unwrap();
    let without = text.split("[measurements]").next().unwrap().to_owned();
    std::fs::write(&study, without).unwrap();
    let plan = planned(&study, &folder.path().join("plan"));
    assert_eq!(plan["kind"], "campaign");
    let tests = plan["tests"].as_array().unwrap();
    assert!((1..=4).contains(&tests.len()));
    for pair in tests.windows(2) {
        assert!(pair[0]["detectable"].as_u64() <= pair[1]["detectable"].as_u64());
        assert!(pair[0]["told_apart"].as_u64() <= pair[1]["told_apart"].as_u64());
    }
}

#[test]
fn unusable_input_is_refused_and_nothing_written() {
    let folder = tempfile::tempdir().unwrap();
    let study = small(folder.path());
    std::fs::remove_file(folder.path().join("measurements.csv")).unwrap();
    let output = gearwear().arg("plan").arg(&study).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(!folder.path().join("study.out").exists());
}
