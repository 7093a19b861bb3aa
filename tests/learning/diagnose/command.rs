//! The command: its files, its document, its refusals.

use std::path::{Path, PathBuf};

use assert_cmd::Command;
use serde_json::Value;

/// A small study (one test, two times, analytic contact) in a folder of its own; the values are 5e-10 mm²/N's to 5 %.
pub(crate) fn small(folder: &Path) -> PathBuf {
    let data = super::synthetic("", 0.0, 0.05, 11);
    let mut csv = "test,member,cycles,quantity,position,value,sigma,trace\n".to_owned();
    for o in data.observations.iter().filter(|o| o.test == 0) {
        let position = o.position.map_or(String::new(), |p| p.to_string());
        let trace = o.trace.map_or(String::new(), |t| t.to_string());
        csv.push_str(&format!(
            "A,{},{},{},{position},{},{},{trace}\n",
            o.member.name(),
            o.cycles,
            o.quantity.name(),
            o.value,
            o.sigma
        ));
    }
    std::fs::write(folder.join("measurements.csv"), csv).unwrap();
    let source = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join(super::LAYOUT)
        .join("study.toml");
    let text = std::fs::read_to_string(source)
        .unwrap()
        .replace("\"fem\"", "\"hertz\"");
    let path = folder.join("study.toml");
    std::fs::write(&path, text).unwrap();
    path
}

pub(crate) fn gearwear() -> Command {
    Command::new(env!("CARGO_BIN_EXE_gearwear"))
}

#[test]
fn it_writes_what_it_prints_and_threads_change_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let study = small(folder.path());
    let run = |threads: &str| {
        let output = gearwear()
            .args(["diagnose", "--json", "--quiet", "--threads", threads])
            .arg(&study)
            .output()
            .unwrap();
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        output.stdout
    };
    let (one, two) = (run("1"), run("2"));
    assert_eq!(one, two, "the same bits for any number of threads");
    let document: Value = serde_json::from_slice(&one).unwrap();
    let target = folder.path().join("study.out/diagnose");
    let written: Value =
        serde_json::from_slice(&std::fs::read(target.join("diagnosis.json")).unwrap()).unwrap();
    assert_eq!(document, written);
    let next = document["next_step"].as_str().unwrap();
    let named = study.display().to_string();
    assert!(!next.contains("STUDY"), "{next}");
    assert!(
        !next.contains("gearwear ") || next.contains(&named),
        "{next}"
    );
    let page = std::fs::read_to_string(target.join("report.html")).unwrap();
    let measured_by = "compare, add and ladder fit without it, and their χ² of the same model may be some per cent lower or higher";
    assert!(page.contains(measured_by));
    let map = std::fs::read_to_string(target.join("discrepancy.csv")).unwrap();
    assert!(
        map.starts_with("test,member,quantity,cycles,position,value,measured_minus_model,unit\n")
    );
    let bins = std::fs::read_to_string(target.join("residual_drivers.csv")).unwrap();
    assert!(bins.starts_with("driver,unit,from,to,centre,points,before,before_error,after"));
    let rows = std::fs::read_to_string(target.join("residual_rows.csv")).unwrap();
    let drivers = document["residual_drivers"]["drivers"].as_array().unwrap();
    assert!(drivers.iter().any(|d| d["name"] == "contact_pressure"));
    let binned = drivers.iter().map(|d| d["bins"].as_array().unwrap().len());
    assert_eq!(bins.lines().count(), 1 + binned.sum::<usize>());
    assert_eq!(
        rows.lines().count(),
        map.lines().count(),
        "every fitted row"
    );
    for key in [
        "verdict",
        "effect",
        "probabilities",
        "ranking",
        "indistinguishable",
        "driver",
        "next_experiment",
    ] {
        assert!(document.get(key).is_some(), "{key}");
    }
    let total: f64 = document["probabilities"]
        .as_object()
        .unwrap()
        .values()
        .map(|p| p.as_f64().unwrap())
        .sum();
    assert!((total - 1.0).abs() < 1e-9);
    assert!(document["effect"].is_null() || document["verdict"] == "effect");
}

#[test]
fn without_measurements_there_is_nothing_to_diagnose() {
    let folder = tempfile::tempdir().unwrap();
    let study = small(folder.path());
    let text = std::fs::read_to_string(&study).unwrap();
    let without = text.split("[measurements]").next().unwrap().to_owned();
    std::fs::write(&study, without).unwrap();
    let output = gearwear().arg("diagnose").arg(&study).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(
        !folder.path().join("study.out").exists(),
        "nothing is written"
    );
}
