//! What the decision rule says of kept diagnoses: by the rule they were decided with, and with thresholds changed.
//!
//! ```sh
//! cargo run --release --example decision_rule -- RULES.json DIAGNOSIS.json...
//! ```
//! RULES.json is a list of objects with thresholds to change, `[{}, {"temper": 1.0}]`; their names are in the `rule` of a diagnosis.
//! Prints one JSON document for each diagnosis and line: a list with verdict, leading effects and group for each rule. Nothing is refitted.

use std::error::Error;
use std::fs;

use gearwear::learn::diagnose::{Evidence, Hypothesis, decide};
use serde_json::{Map, Value, json};

#[expect(clippy::print_stdout, reason = "an example shows what it found")]
fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let rules = arguments
        .next()
        .ok_or("RULES.json DIAGNOSIS.json... are needed")?;
    let changes: Vec<Map<String, Value>> = serde_json::from_str(&fs::read_to_string(rules)?)?;
    for path in arguments {
        let document: Value = serde_json::from_str(&fs::read_to_string(&path)?)?;
        let evidence: Evidence = serde_json::from_value(document.clone())?;
        let mut said = Vec::new();
        for change in &changes {
            let mut rule = document["rule"].clone();
            for (name, value) in change {
                rule[name] = value.clone();
            }
            let decision = decide(&evidence, &serde_json::from_value(rule)?);
            said.push(json!({
                "verdict": decision.verdict,
                "effects": decision.leader(),
                "group": (decision.group.iter()).map(named).collect::<Vec<_>>(),
            }));
        }
        println!("{}", Value::from(said));
    }
    Ok(())
}

/// The effects as a list, nothing and the unknown by their names.
fn named(hypothesis: &Hypothesis) -> Value {
    match hypothesis.effects() {
        Some(effects) => json!(effects),
        None => json!(hypothesis),
    }
}
