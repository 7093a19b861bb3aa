//! Claim: `validate` knows every case of the benchmark list, refuses others, and judges what it measured.
//!
//! Source: the list of benchmarks by id, repeated here as [`BENCHMARKS`]; the document's keys as in the README. Tolerance:
//! none, counts and words are compared.

use std::collections::BTreeSet;

use assert_cmd::Command;
use gearwear::paper::reference;
use gearwear::verify::contact_and_wear::Effort;
use gearwear::verify::registry::{self, Entry, GROUPS, Work};
use gearwear::verify::runner::{self, Row, Verdict};
use gearwear::verify::{CaseError, Measured, paper_rows};
use serde_json::Value;

/// Ids of the benchmark list that concern elements, contact, gears and wear.
const BENCHMARKS: [&str; 37] = [
    "A1", "A2", "A3", "A4", "A5", "A6", "A7", "A8", "A9", "B1", "B2", "B3", "B4", "B5", "B6", "B7",
    "B8", "C", "D1", "D2", "D3", "D4", "D5", "D6", "E1", "E2", "E3", "E4", "F1", "F2", "F3", "F4",
    "F5", "F6", "F7", "F8", "F9",
];

fn gearwear(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::cargo_bin("gearwear")
        .unwrap()
        .args(arguments)
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

fn doctored(id: &str, run: fn(Effort) -> Result<Vec<Measured>, CaseError>) -> Entry {
    Entry {
        ids: vec![id.to_owned()],
        group: GROUPS[0],
        title: "doctored",
        source: "none",
        reason: "",
        work: Work::Family(run),
    }
}

fn run(entries: &[Entry], names: &[&str]) -> Vec<Row> {
    let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
    runner::run(entries, &names, Effort::Quick, &mut |_, _| {})
}

#[test]
fn every_benchmark_is_run_or_skipped_with_a_reason() {
    let known = runner::known_ids();
    let missing: Vec<&&str> = BENCHMARKS
        .iter()
        .filter(|id| {
            let figures = format!("{id}.");
            !known.iter().any(|k| k == **id || k.starts_with(&figures))
        })
        .collect();
    assert!(missing.is_empty(), "neither run nor skipped: {missing:?}");
    assert!(registry::skipped().iter().all(|s| !s.reason.is_empty()));
    for entry in registry::entries() {
        assert!(GROUPS.contains(&entry.group), "{}", entry.title);
        assert!(!entry.source.is_empty(), "{} has no source", entry.title);
    }
}

#[test]
fn an_unknown_case_is_refused_with_the_known_ones() {
    for name in ["Z9", "A1x", "a1", ""] {
        let (code, out, err) = gearwear(&["validate", name, "--json"]);
        assert_eq!((code, out.as_str()), (Some(2), ""), "{name}");
        assert!(err.contains("A1, A2") && err.contains("paper"), "{err}");
    }
}

#[test]
fn the_document_has_the_promised_keys() {
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("results");
    let (code, out, err) = gearwear(&[
        "validate",
        "A1",
        "paper.T2.2",
        "--json",
        "-o",
        target.to_str().unwrap(),
    ]);
    assert_eq!((code, err.as_str()), (Some(0), ""));
    let document: Value = serde_json::from_str(&out).unwrap();
    let cases = document["cases"].as_array().unwrap();
    assert!(cases.iter().filter(|c| c["id"] == "paper.T2.2.s").count() == 1);
    let mut ids = BTreeSet::new();
    for case in cases {
        let id = case["id"].as_str().unwrap();
        assert!(
            id.starts_with("A1.") || id.starts_with("paper.T2.2."),
            "{id}"
        );
        assert!(ids.insert(id), "{id} twice");
        for key in ["target", "value", "error", "tolerance", "seconds"] {
            assert!(case[key].is_number(), "{key} of {id}");
        }
        for key in ["source", "quantity", "reason"] {
            assert!(case[key].is_string(), "{key} of {id}");
        }
        let expected = match id {
            "paper.T2.2.s" => "contradicts_theory",
            _ => "pass",
        };
        assert_eq!(case["verdict"], expected, "{id}");
    }
    let file = std::fs::read_to_string(target.join("validation.json")).unwrap();
    assert_eq!(serde_json::from_str::<Value>(&file).unwrap(), document);
    for extension in ["md", "html"] {
        let read = |name: &str| std::fs::read_to_string(target.join(name)).unwrap();
        assert!(read(&format!("cases/A1.{extension}")).contains("A1.1"));
        assert!(read(&format!("cases/paper.{extension}")).contains("1.961"));
    }
    for (name, link) in [
        ("RESULTS.md", "(cases/A1.md)"),
        ("report.html", "\"cases/A1.html\""),
    ] {
        let text = std::fs::read_to_string(target.join(name)).unwrap();
        assert!(text.contains(link), "{name} does not lead to the family");
        assert!(
            text.contains("paper.T2.2.s"),
            "{name} hides what is not met"
        );
    }
}

#[test]
fn a_miss_and_a_breakdown_are_failures() {
    let miss = |_: Effort| Ok(vec![Measured::relative("A1", "two for one", 2.0, 1.0, 0.1)]);
    let lost = |_: Effort| Ok(vec![Measured::bound("A1", "not a number", f64::NAN, 0.1)]);
    let broken = |_: Effort| Err(CaseError::Rigid { side: 1 });
    let nothing = |_: Effort| Ok(Vec::new());
    for (case, word) in [
        (doctored("A1", miss), ""),
        (doctored("A1", lost), ""),
        (doctored("A1", broken), "body 1 is rigid"),
        (doctored("A1", nothing), "nothing was measured"),
    ] {
        let rows = run(&[case], &["A1"]);
        assert_eq!(rows.len(), 1);
        assert_eq!(rows[0].verdict, Verdict::Fail);
        assert!(rows[0].reason.contains(word), "{}", rows[0].reason);
        assert!(!runner::passed(&rows));
    }
    let hit = |_: Effort| Ok(vec![Measured::relative("A1", "one", 1.05, 1.0, 0.1)]);
    let rows = run(&[doctored("A1", hit), doctored("A2", miss)], &["A1"]);
    assert!(runner::passed(&rows) && rows.len() == 1);
    let rows = run(&[doctored("A1", hit), doctored("A2", miss)], &["A"]);
    assert!(!runner::passed(&rows) && rows.len() == 2);
}

#[test]
fn ids_are_unique_and_belong_to_their_family() {
    // families that take long run in `gearwear validate` only; these hold every way in which ids are made
    let entries = registry::entries();
    let quick: Vec<Entry> = entries
        .into_iter()
        .filter(|e| {
            e.ids.iter().any(|id| {
                ["A1", "B1", "B6", "F2", "F3", "F4", "F6", "C", "E1", "paper"]
                    .contains(&id.as_str())
            })
        })
        .collect();
    let rows = run(&quick, &[]);
    let ids: BTreeSet<&str> = rows.iter().map(|row| row.id.as_str()).collect();
    assert_eq!(ids.len(), rows.len());
    for row in rows.iter().filter(|row| row.verdict != Verdict::Skipped) {
        let known = |id: &String| {
            row.id == *id
                || row
                    .id
                    .strip_prefix(id.as_str())
                    .is_some_and(|rest| rest.starts_with('.'))
        };
        assert!(
            quick.iter().any(|entry| entry.ids.iter().any(known)),
            "{} belongs to no family",
            row.id
        );
    }
    assert!(rows.iter().any(|row| row.verdict == Verdict::Skipped));
}

#[test]
fn printed_numbers_are_shown_for_what_they_are() {
    let rows = paper_rows::all().unwrap();
    let of = |id: &str| rows.iter().find(|row| row.id == id).unwrap();
    for id in ["paper.T2.2.s", "paper.T2.3.s", "paper.R3"] {
        assert_eq!(of(id).verdict, Verdict::ContradictsTheory, "{id}");
        assert!(!of(id).reason.is_empty(), "{id}");
    }
    for id in ["paper.B1", "paper.A1", "paper.R2"] {
        let row = of(id);
        assert_eq!(row.verdict, Verdict::Pass, "{id}");
        assert!(
            row.quantity.contains("(not reproduced)"),
            "{}",
            row.quantity
        );
        assert!(row.source.contains("reconstruction"), "{}", row.source);
    }
    assert_eq!(rows.len(), 49);
    // another verdict than the reconstruction's, or another value, fails
    for mut printed in reference::rows().unwrap() {
        if printed.id == "A1" {
            printed.ours = printed.ours.map(|value| 1.001 * value);
            assert_eq!(paper_rows::row(&printed).verdict, Verdict::Fail);
        }
        if printed.id == "R3" {
            printed.verdict = reference::Verdict::Reproduced;
            assert_eq!(paper_rows::row(&printed).verdict, Verdict::Fail);
        }
    }
}
