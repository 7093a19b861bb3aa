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
    // every feasible test with each of three quantities, but those that were made already
    let text = std::fs::read_to_string(&study).unwrap();
    let made = gearwear::study::Study::parse(&text, "study.toml")
        .unwrap()
        .tests;
    let depth_again = |row: &Value| {
        let near =
            |key: &str, other: f64| (row["test"][key].as_f64().unwrap() / other - 1.0).abs() < 0.01;
        row["quantity"] == "wear_depth"
            && row["test"]["reversed"] == false
            && made.iter().map(|test| &test.conditions).any(|c| {
                near("torque", 1e-3 * c.torque_nmm)
                    && near("speed", c.speed_rpm)
                    && near("cycles", c.cycles)
                    && row["test"]["misalignment"] == c.misalignment_mm
                    && row["test"]["bulk_temperature"].as_f64() == c.bulk_temperature_c
            })
    };
    assert!(!tests.iter().any(depth_again));
    assert!(
        (21 * 3 - 2 * made.len()..23 * 3).contains(&tests.len()),
        "{}",
        tests.len()
    );
    let chi2 = |row: &Value| row["expected_chi2"].as_f64().unwrap();
    let best = tests.iter().map(chi2).fold(0.0, f64::max);
    assert!(chi2(&tests[0]) >= 0.8 * best);
    assert!(!tests[0]["separates"].as_array().unwrap().is_empty());
}

/// A plan separates what the diagnosis of the same inputs left, whatever leads by the analytic model's own ranking; without one it says
/// whose leaders they are.
/// A rig bounds the tests of a campaign and of a table, and the bounds are no part of what a diagnosis was made from.
#[test]
fn only_tests_are_suggested_that_the_rig_can_run() {
    let folder = tempfile::tempdir().unwrap();
    let study = small(folder.path());
    let text = std::fs::read_to_string(&study).unwrap();
    let limits =
        "\n[rig]\ntorque_max = 110\nspeed_min = 1500\nmisalignment_max = 0.0\nreversible = false\n";
    std::fs::write(&study, text + limits).unwrap();
    let plan = planned(&study, &folder.path().join("plan"));
    let rows = plan["tests"].as_array().unwrap();
    assert!(rows.len() > 6, "{}", rows.len());
    for row in rows {
        let of = |key: &str| row["test"][key].as_f64().unwrap();
        assert!(
            of("torque") <= 110.0 && of("speed") >= 1500.0 && of("misalignment") <= 0.0,
            "{row}"
        );
        assert_eq!(row["test"]["reversed"], false, "{row}");
    }
}

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
    let single = |entry: &Value| {
        let name = entry["effect"].as_str().unwrap();
        !name.contains('+') && name != "nothing_missing"
    };
    let last = ranking.iter().rposition(single).unwrap();
    ranking.swap(0, last);
    for entry in ranking.iter_mut() {
        entry["probability"] = 0.0.into();
    }
    ranking[0]["probability"] = 0.9.into();
    ranking[1]["probability"] = 0.05.into();
    let names: Vec<String> = [&ranking[0], &ranking[1]]
        .map(|entry| entry["effect"].as_str().unwrap().to_owned())
        .into();
    // beside something unknown an effect leads as well
    ranking[0]["effect"] = format!("{}+unknown", names[0]).into();
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

/// A rival keeps the values that the diagnosis found: measurements that show nothing of it would take it away if the analytic model fitted it
/// anew, and no test would seem to be of use.
#[test]
fn a_rival_stays_at_the_values_of_the_diagnosis() {
    let folder = tempfile::tempdir().unwrap();
    let study = small(folder.path());
    let diagnosed = gearwear().arg("diagnose").arg(&study).output().unwrap();
    assert!(diagnosed.status.success());
    let file = folder.path().join("study.out/diagnose/diagnosis.json");
    let mut document: Value = serde_json::from_slice(&std::fs::read(&file).unwrap()).unwrap();
    let ranking = document["ranking"].as_array_mut().unwrap();
    let nothing = ranking.iter().find(|e| e["effect"] == "nothing_missing");
    let nothing = nothing.unwrap().clone();
    let mut rival = nothing.clone();
    rival["effect"] = "running_in".into();
    let value = |name: &str, value: f64| serde_json::json!({"name": name, "value": value, "sigma": 0.1 * value, "unit": "-", "at_bound": false});
    rival["parameters"] = vec![value("amplitude", 2.0), value("decay_cycles", 2e5)].into();
    rival["probability"] = 0.02.into();
    *ranking = vec![nothing, rival];
    ranking[0]["probability"] = 0.9.into();
    std::fs::write(&file, document.to_string()).unwrap();
    let plan = planned(&study, &folder.path().join("plan"));
    assert_eq!(plan["leaders"][1]["effect"], "running_in");
    let best = plan["tests"][0]["separates"][0]["chi2"].as_f64().unwrap();
    assert!(best > 20.0, "{best}");
    assert!(plan["repetition_chi2"].as_f64().unwrap() > 20.0, "{plan}");
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
    // every test has a reason, effects that none shows are named, and the study's temperature may be another
    for test in tests {
        assert!(!test["adds"].as_str().unwrap().is_empty(), "{test}");
    }
    let effects = plan["effects"].as_array().unwrap();
    let sentence = plan["sentence"].as_str().unwrap();
    for effect in effects.iter().filter(|e| e["detectable"] == false) {
        let name = effect["effect"].as_str().unwrap();
        let (_, unseen) = sentence.split_once("Not shown: ").unwrap();
        assert!(unseen.contains(name), "{name} in {sentence}");
    }
    let hours = |test: &Value| test["test"]["hours"].as_f64().unwrap();
    let chosen = plan["tests"].as_array().unwrap();
    let all = gearwear::numeric::written::significant(chosen.iter().map(hours).sum(), 3);
    assert!(
        sentence.contains(&format!("; {all} h on the rig)")),
        "{sentence}"
    );
    let alone = plan["alone"].as_array().unwrap();
    let at = |celsius: f64| {
        alone
            .iter()
            .any(|t| t["test"]["bulk_temperature"] == celsius)
    };
    assert!(at(40.0) && at(60.0) && at(80.0), "{plan}");
    let table = std::fs::read_to_string(folder.path().join("plan/plan.csv")).unwrap();
    let header = table.lines().next().unwrap();
    assert!(header.ends_with(",bulk_temperature,hours"), "{header}");
    for row in alone {
        let of = |key: &str| row["test"][key].as_f64().unwrap();
        assert!((60.0 * of("speed") * of("hours") / of("cycles") - 1.0).abs() < 1e-12);
    }
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
