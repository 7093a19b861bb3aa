//! The command `climb`: what it finds, what it writes, how it goes on.

use std::path::{Path, PathBuf};

use gearwear::study::Study;
use serde_json::Value;

use super::command::gearwear;

/// Two effects, by the analytic contact, in a folder of its own; the last test is held out.
fn study(folder: &Path, hidden: &str) -> PathBuf {
    let data = super::synthetic(hidden, 0.05, 0.02, 41);
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
    let mut text = super::study("").text().to_owned();
    let last = text.rfind("role = \"fit\"").unwrap();
    text.replace_range(last..last + 12, "role = \"holdout\"");
    let path = folder.join("study.toml");
    std::fs::write(&path, text).unwrap();
    path
}

/// One effect.
const RUNNING_IN: &str = "[[effect]]\nkind = \"running_in\"\namplitude = 2.0\ndecay_cycles = 2e5\n";

/// Two.
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
    let error = |step: &Value| step["holdout_chi2_per_point"].as_f64().unwrap();
    let kept: Vec<f64> = (steps.iter().filter(|step| step["kept"] == true))
        .map(error)
        .collect();
    assert!(
        kept.len() >= 3 && kept.windows(2).all(|w| w[1] < w[0]),
        "{kept:?}"
    );
    let target = folder.path().join("study.out/climb");
    for file in [
        "climb.json",
        "climbed.toml",
        "diagnosis.json",
        "report.html",
    ] {
        assert!(target.join(file).is_file(), "{file}");
    }
    let climbed = Study::load(&target.join("climbed.toml")).unwrap();
    assert_eq!(climbed.effects().len(), 2);
    assert!(
        climbed.dataset_to_fit().is_ok(),
        "its measurements are found from its own folder"
    );
    assert!(!folder.path().join("study.out/.climb.checkpoint").exists());
    // a plan goes on from the diagnosis that the climb ended with
    let output = gearwear()
        .args(["plan", "--json", "--quiet"])
        .arg(target.join("climbed.toml"))
        .output()
        .unwrap();
    let plan: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(plan["diagnosed"], true, "{plan:#}");
}

/// A climb begins with the finished diagnosis of its study, and takes the same step by it.
#[test]
fn it_begins_with_the_finished_diagnosis() {
    let folder = tempfile::tempdir().unwrap();
    let path = study(folder.path(), RUNNING_IN);
    let run = |arguments: &[&str]| {
        let output = gearwear().args(arguments).arg(&path).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success(), "{said}");
        (
            serde_json::from_slice::<Value>(&output.stdout).unwrap(),
            said,
        )
    };
    let (diagnosis, _) = run(&["diagnose", "--json", "--quiet"]);
    let (after, said) = run(&["climb", "--json", "--most", "1"]);
    assert!(
        said.contains("note: the first step goes by the finished diagnosis"),
        "{said}"
    );
    let first = after["effects"][0].as_str().unwrap();
    let probabilities = diagnosis["probabilities"].as_object().unwrap();
    let likeliest = (probabilities.iter())
        .max_by(|a, b| a.1.as_f64().unwrap().total_cmp(&b.1.as_f64().unwrap()))
        .unwrap();
    assert!(likeliest.0.contains(first), "{likeliest:?} {after:#}");
    // where the study is another one, that diagnosis is none of it
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, format!("{text}\n# changed\n")).unwrap();
    let (plan, _) = run(&["plan", "--json", "--quiet"]);
    assert_eq!(plan["diagnosed"], false, "{plan:#}");
}

/// One section of a face that leans by 10 µm: lead slopes and crowning are alike there. All that the diagnosis cannot tell apart are fitted, and
/// the one with the least error on the held-out test is kept, with a word on it.
#[test]
fn of_what_looks_alike_the_best_on_held_out_tests_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let hidden = "\n[[effect]]\nkind = \"lead_misalignment\"\nslope = 10.0\n";
    let truth = folder.path().join("truth.toml");
    std::fs::write(&truth, super::study("").text().to_owned() + hidden).unwrap();
    let made = folder.path().join("made");
    let output = gearwear()
        .args(["synthesize", "--quiet", "--noise", "0.04", "-o"])
        .args([&made, &truth])
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
    let path = made.join("study.toml");
    let text = std::fs::read_to_string(&path).unwrap();
    let mut text = text.split("[[effect]]").next().unwrap().to_owned();
    let last = text.rfind("role = \"fit\"").unwrap();
    text.replace_range(last..last + 12, "role = \"holdout\"");
    std::fs::write(&path, text).unwrap();
    let output = gearwear()
        .args(["climb", "--json", "--quiet", "--most", "1"])
        .arg(&path)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    let steps = document["steps"].as_array().unwrap();
    let tried: Vec<&Value> = steps.iter().filter(|s| s["added"].is_string()).collect();
    assert!(tried.len() > 1, "{document:#}");
    let kept: Vec<&&Value> = tried.iter().filter(|s| s["kept"] == true).collect();
    assert_eq!(kept.len(), 1, "{document:#}");
    let choice = kept[0]["choice"].as_str().unwrap();
    let name = kept[0]["added"].as_str().unwrap();
    assert!(
        choice.contains(&format!(
            "{name} does best by evidence and held-out error combined"
        )),
        "{choice}"
    );
    // of those that pay, the one that all measurements make the most likely
    let value = |step: &Value, key: &str| step[key].as_f64().unwrap();
    let [error, gain] = ["holdout_chi2_per_point", "log_evidence_gain"];
    for step in tried.iter().filter(|s| s["kept"] == false) {
        let by_all = format!("{name} does better by evidence and held-out error combined");
        let better = value(kept[0], error) <= value(step, error)
            || value(kept[0], gain) >= value(step, gain);
        assert!(
            step["why"].as_str().unwrap() != by_all || better,
            "{document:#}"
        );
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
