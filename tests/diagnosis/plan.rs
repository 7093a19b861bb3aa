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

/// A plan separates what the diagnosis of the same inputs left, whatever leads by the analytic model's own ranking; without one it says
/// whose leaders they are.
#[test]
fn a_plan_starts_from_the_diagnosis_of_the_same_inputs() {
    let folder = tempfile::tempdir().unwrap();
    let study = small(folder.path());
    let diagnosed = gearwear().arg("diagnose").arg(&study).output().unwrap();
    assert!(diagnosed.status.success());
    let file = folder.path().join("study.out/diagnose/diagnosis.json");
    let mut document: Value = serde_json::from_slice(&std::fs::read(&file).unwrap()).unwrap();
    // what the analytic model alone would hardly put first
    let ranking = document["ranking"].as_array_mut().unwrap();
    let last = ranking.len() - 1;
    ranking.swap(0, last);
    ranking[0]["probability"] = 0.9.into();
    ranking[1]["probability"] = 0.05.into();
    let names: Vec<String> = [&ranking[0], &ranking[1]]
        .map(|entry| entry["effect"].as_str().unwrap().to_owned())
        .into();
    std::fs::write(&file, document.to_string()).unwrap();
    let plan = planned(&study, &folder.path().join("plan"));
    assert_eq!(plan["diagnosed"], true);
    let leaders = plan["leaders"].as_array().unwrap();
    for (leader, name) in leaders.iter().zip(&names) {
        assert_eq!(leader["effect"], name.as_str());
    }
    assert_eq!(leaders[0]["probability"], 0.9);
    // another study than the diagnosed one
    let text = std::fs::read_to_string(&study).unwrap();
    std::fs::write(&study, format!("{text}\n# changed\n")).unwrap();
    let plan = planned(&study, &folder.path().join("plan"));
    assert_eq!(plan["diagnosed"], false);
    assert!(
        plan["basis"]
            .as_str()
            .unwrap()
            .contains("analytic model alone")
    );
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
