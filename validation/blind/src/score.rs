//! Compares a diagnosis with the answer and counts.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use crate::records::Record;

/// One data set's outcome.
#[derive(Clone, Debug)]
pub struct Outcome {
    pub class: String,
    pub kinds: Vec<String>,
    pub noise: f64,
    pub gear: String,
    pub d: f64,
    pub verdict: String,
    /// exact, group, half, wrong, ambiguous, unknown, nothing
    pub result: &'static str,
    pub driver_right: Option<bool>,
    /// Largest probability and whether that answer was right.
    pub top: f64,
    pub top_right: bool,
    /// Largest probability of a false claim (neither right, nor nothing, nor unknown).
    pub false_claim: f64,
    pub named: Vec<String>,
    pub name: String,
    /// chi^2 that the best rival of another name leaves, and the part that it explains, when known.
    pub rival: Option<(f64, f64)>,
}

/// The name that truths have for a cause that goes by several.
fn usual(name: &str) -> String {
    match name {
        "crowning" => "lead_crowning",
        "eccentricity" => "run_out",
        other => other,
    }
    .to_string()
}

/// Names of a set "a+b".
pub fn names(set: &str) -> Vec<String> {
    set.split('+').map(usual).collect()
}

pub fn judge(name: &str, truth: &Value, found: &Value) -> Outcome {
    let text = |v: &Value| v.as_str().unwrap_or_default().to_string();
    let words = |v: &Value| -> Vec<String> {
        match v {
            Value::String(s) => names(s),
            Value::Array(a) => a.iter().map(|v| usual(&text(v))).collect(),
            _ => Vec::new(),
        }
    };
    let class = text(&truth["class"]);
    let kinds = words(&truth["kinds"]);
    let sorted = |mut v: Vec<String>| {
        v.sort();
        v
    };
    let want = sorted(kinds.clone());
    let verdict = text(&found["verdict"]);
    let named = sorted(words(&found["effect"]));
    let groups: Vec<Vec<String>> = found["indistinguishable"]
        .as_array()
        .map(|a| a.iter().map(words).collect())
        .unwrap_or_default();
    // Groups hold names or sets "a+b".
    let raw: Vec<Vec<String>> = found["indistinguishable"]
        .as_array()
        .map(|a| {
            a.iter()
                .map(|g| {
                    g.as_array()
                        .map(|g| g.iter().map(|v| names(&text(v)).join("+")).collect())
                        .unwrap_or_default()
                })
                .collect()
        })
        .unwrap_or_default();
    let is_truth = |s: &str| sorted(names(s)) == want;
    let right_in = |g: &Vec<String>| match class.as_str() {
        "none" => g.iter().any(|s| s == "nothing_missing"),
        "outside" => g.iter().any(|s| s == "unknown"),
        _ => g.iter().any(|s| is_truth(s)),
    };
    // What of it the catalogue holds; beside it there may be something that it lacks.
    let known: Vec<String> = sorted(
        truth["effects"]
            .as_array()
            .into_iter()
            .flatten()
            .filter(|e| e["class"] != "outside")
            .map(|e| text(&e["kind"]))
            .collect(),
    );
    // Established beside something unknown: by name, or as a group of such names.
    let partial = || {
        let of = |s: &str| sorted(names(s.trim_end_matches("+unknown")));
        if !named.is_empty() {
            return match class.as_str() {
                "mixed" if named == known => "exact",
                "none" | "outside" | "mixed" => "wrong",
                _ if named.iter().all(|n| want.contains(n)) => "half",
                _ => "wrong",
            };
        }
        match class.as_str() {
            "mixed" if raw.iter().flatten().any(|s| of(s) == known) => "group",
            "none" | "outside" | "mixed" => "wrong",
            // Something unknown beside one of a group that holds the truth, where nothing else acts.
            _ if raw.iter().flatten().any(|s| of(s) == want) => "half",
            _ => "wrong",
        }
    };
    // Every true cause stands in a group with (or is) what was named.
    let covered = named.len() == want.len()
        && want.iter().all(|w| {
            named.contains(w)
                || groups
                    .iter()
                    .any(|g| g.contains(w) && named.iter().any(|n| g.contains(n)))
        });
    let result = match (class.as_str(), verdict.as_str()) {
        ("none", "nothing_missing") | ("outside", "unknown") => "exact",
        (_, "nothing_missing") => "nothing",
        (_, "unknown") => "unknown",
        (_, "ambiguous") => {
            if raw.iter().any(right_in) {
                "group"
            } else {
                "ambiguous"
            }
        }
        (_, "partial") => partial(),
        ("none" | "outside", _) => "wrong",
        // the rest is not acknowledged
        ("mixed", _) if named == known => "half",
        ("mixed", _) => "wrong",
        _ => {
            if named == want {
                "exact"
            } else if covered {
                "group"
            } else if ["pair", "three"].contains(&class.as_str())
                && named.iter().all(|n| want.contains(n))
            {
                "half"
            } else {
                "wrong"
            }
        }
    };
    let probability: BTreeMap<String, f64> = found["probabilities"]
        .as_object()
        .map(|o| {
            o.iter()
                .map(|(k, v)| (k.clone(), v.as_f64().unwrap_or(0.0)))
                .collect()
        })
        .unwrap_or_default();
    let right = |s: &str| match class.as_str() {
        "none" => s == "nothing_missing",
        "outside" => s == "unknown",
        _ => is_truth(s),
    };
    let best = probability.iter().max_by(|a, b| a.1.total_cmp(b.1));
    let false_claim = probability
        .iter()
        .filter(|(k, _)| !right(k) && *k != "nothing_missing" && *k != "unknown")
        .map(|(_, v)| *v)
        .fold(0.0, f64::max);
    let drivers: Vec<String> = truth["effects"][0]["drivers"]
        .as_array()
        .map(|a| a.iter().map(text).collect())
        .unwrap_or_default();
    let driver = found["driver"]["name"].as_str();
    let d = match truth["d_each"].as_array() {
        Some(a) if ["pair", "mixed", "three"].contains(&class.as_str()) => {
            a.iter().filter_map(Value::as_f64).fold(f64::MAX, f64::min)
        }
        _ => truth["d"].as_f64().unwrap_or(0.0),
    };
    Outcome {
        name: name.to_string(),
        rival: truth["rivals"][0]["left_chi2"]
            .as_f64()
            .zip(truth["rivals"][0]["share"].as_f64()),
        result,
        driver_right: (class == "outside")
            .then(|| driver.is_some_and(|n| drivers.iter().any(|x| x == n))),
        top: best.map_or(0.0, |b| *b.1),
        top_right: best.is_some_and(|b| right(b.0)),
        false_claim,
        noise: truth["noise"].as_f64().unwrap_or(0.0),
        gear: text(&truth["gear"]),
        class,
        kinds,
        d,
        verdict,
        named,
    }
}

/// 95 % interval of a rate.
pub fn wilson(hits: usize, of: usize) -> (f64, f64) {
    if of == 0 {
        return (0.0, 1.0);
    }
    let (n, z) = (of as f64, 1.959_964);
    let p = hits as f64 / n;
    let centre = (p + z * z / (2.0 * n)) / (1.0 + z * z / n);
    let half = z / (1.0 + z * z / n) * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
    ((centre - half).max(0.0), (centre + half).min(1.0))
}

/// Mean distance between stated and met probability over ten bins.
pub fn calibration(list: &[(f64, bool)]) -> f64 {
    let mut bins = vec![(0.0, 0.0, 0.0); 10];
    for (p, right) in list {
        let b = &mut bins[((p * 10.0) as usize).min(9)];
        b.0 += 1.0;
        b.1 += p;
        b.2 += f64::from(u8::from(*right));
    }
    bins.iter()
        .filter(|b| b.0 > 0.0)
        .map(|b| (b.1 - b.2).abs())
        .sum::<f64>()
        / list.len().max(1) as f64
}

fn band(d: f64) -> &'static str {
    if d < 3.0 {
        "<3"
    } else if d < 6.0 {
        "3-6"
    } else {
        ">=6"
    }
}

const CLASSES: [&str; 10] = [
    "none", "single", "foreign", "outside", "pair", "mixed", "three", "face", "teeth", "force",
];

const RESULTS: [&str; 7] = [
    "exact",
    "group",
    "half",
    "wrong",
    "ambiguous",
    "unknown",
    "nothing",
];

/// What simpler judges make of the same fits, put as a diagnosis so that it is counted alike.
///
/// `bic`: the least chi^2 + p ln(n) over the base model, single effects and the pairs that were fitted, whatever is left over.
/// `sparse regression`: the effects whose linear signatures are picked one after another, whatever is left over.
/// `discrepancy`: the base model with a Gaussian process; it tells that something is missing when its evidence is higher, never what.
pub fn baselines(found: &Value, rows: usize) -> [(&'static str, Value); 3] {
    let number = |v: &Value| v.as_f64().unwrap_or(0.0);
    let mut best = (0.0, None);
    for s in found["screened"].as_array().into_iter().flatten() {
        let count = s["values"].as_array().map_or(0, Vec::len) as f64;
        let gain = number(&s["chi2_drop"]) - count * (rows as f64).ln();
        if gain > best.0 {
            best = (gain, s["effect"].as_str());
        }
    }
    let claim = |names: Vec<&str>| match names.as_slice() {
        [] => json!({"verdict": "nothing_missing"}),
        [name] => json!({"verdict": "effect", "effect": name}),
        names => json!({"verdict": "effects", "effect": names}),
    };
    let bic = claim(best.1.map_or(Vec::new(), |name| name.split('+').collect()));
    let picked = found["sparse_regression"].as_array().into_iter().flatten();
    let sparse = claim(picked.filter_map(Value::as_str).collect());
    let missing = number(&found["unknown_evidence_gain"]) > 0.0;
    let verdict = if missing {
        "unknown"
    } else {
        "nothing_missing"
    };
    [
        ("bic over effects", bic),
        ("sparse regression", sparse),
        ("base and Gaussian process", json!({"verdict": verdict})),
    ]
}

/// Rows of sets with d >= 6 (or nothing hidden), right (exact or group) and wrong, by class.
fn counted(list: &[Outcome]) -> String {
    let mut cells = Vec::new();
    for class in CLASSES {
        let some: Vec<&Outcome> = (list.iter())
            .filter(|o| o.class == class && (class == "none" || o.d >= 6.0))
            .collect();
        let count = |results: &[&str]| some.iter().filter(|o| results.contains(&o.result)).count();
        let share = |hits: usize| 100.0 * hits as f64 / some.len().max(1) as f64;
        let (right, wrong) = (count(&["exact", "group"]), count(&["wrong", "half"]));
        cells.push(if some.is_empty() {
            "-".to_string()
        } else {
            format!("{:.0} / {:.0}", share(right), share(wrong))
        });
    }
    cells.join(" | ")
}

/// The page and the figures of judged sets; `missing`: names of those without a result.
pub fn score(records: &[Record], missing: &[String]) -> (String, Value) {
    let mut list = Vec::new();
    let mut simple: BTreeMap<&str, Vec<Outcome>> = BTreeMap::new();
    for record in records {
        for (who, answer) in &record.simple {
            let outcome = judge(&record.name, &record.truth, answer);
            simple.entry(who).or_default().push(outcome);
        }
        list.push(judge(&record.name, &record.truth, &record.found));
    }
    let mut text = format!(
        "{} data sets judged, {} without a result\n\n",
        list.len(),
        missing.len()
    );
    text.push_str("| class | noise | d | sets | exact | group | half | wrong | ambiguous | unknown | nothing | right (exact or group), 95 % | wrong, 95 % |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    let mut cells = Vec::new();
    for class in CLASSES {
        let mut keys: Vec<(String, String)> = Vec::new();
        let bands: &[&str] = if class == "none" {
            &["all"]
        } else {
            &["<3", "3-6", ">=6"]
        };
        for noise in ["all", "0.02", "0.05", "0.1"] {
            for b in bands {
                keys.push((noise.into(), (*b).into()));
            }
        }
        for (noise, b) in keys {
            let some: Vec<&Outcome> = list
                .iter()
                .filter(|o| {
                    o.class == class
                        && (noise == "all" || format!("{}", o.noise) == noise)
                        && (b == "all" || band(o.d) == b)
                })
                .collect();
            if some.is_empty() {
                continue;
            }
            let n = some.len();
            let count: Vec<usize> = RESULTS
                .iter()
                .map(|r| some.iter().filter(|o| o.result == *r).count())
                .collect();
            let right = count[0] + count[1];
            let (a, z) = wilson(right, n);
            let (wa, wz) = wilson(count[3], n);
            let pc = |v: f64| format!("{:.1}", 100.0 * v);
            text.push_str(&format!(
                "| {class} | {noise} | {b} | {n} | {} | {} ({}–{}) % | {} ({}–{}) % |\n",
                count
                    .iter()
                    .map(usize::to_string)
                    .collect::<Vec<_>>()
                    .join(" | "),
                pc(right as f64 / n as f64),
                pc(a),
                pc(z),
                pc(count[3] as f64 / n as f64),
                pc(wa),
                pc(wz)
            ));
            let counts: serde_json::Map<String, Value> = RESULTS
                .iter()
                .zip(&count)
                .map(|(r, c)| ((*r).to_string(), json!(c)))
                .collect();
            cells.push(json!({"class": class, "noise": noise, "d": b, "sets": n, "counts": counts,
                "right": right as f64 / n as f64, "right_95": [a, z], "wrong": count[3] as f64 / n as f64, "wrong_95": [wa, wz]}));
        }
    }
    text.push_str(&format!(
        "\n| right / wrong (or half), % of d >= 6 | {} |\n|{}\n",
        CLASSES.join(" | "),
        "---|".repeat(CLASSES.len() + 1)
    ));
    text.push_str(&format!("| gearwear | {} |\n", counted(&list)));
    for (who, outcomes) in &simple {
        text.push_str(&format!("| {who} | {} |\n", counted(outcomes)));
    }
    let none: Vec<&Outcome> = list.iter().filter(|o| o.class == "none").collect();
    let alarms = none.iter().filter(|o| o.result != "exact").count();
    let sure = none.iter().filter(|o| o.false_claim > 0.95).count();
    let (fa, fz) = wilson(alarms, none.len());
    let ece = calibration(
        &list
            .iter()
            .map(|o| (o.top, o.top_right))
            .collect::<Vec<_>>(),
    );
    let outside: Vec<&Outcome> = list.iter().filter(|o| o.class == "outside").collect();
    let driver = outside
        .iter()
        .filter(|o| o.driver_right == Some(true))
        .count();
    let strong: Vec<&&Outcome> = outside.iter().filter(|o| band(o.d) == ">=6").collect();
    let driver_strong = strong
        .iter()
        .filter(|o| o.driver_right == Some(true))
        .count();
    let bold = outside.iter().filter(|o| o.false_claim > 0.9).count();
    let over = list.iter().filter(|o| o.false_claim > 0.95).count();
    let worst: Vec<Value> = list
        .iter()
        .filter(|o| o.result == "wrong")
        .map(|o| json!({"name": o.name, "class": o.class, "truth": o.kinds, "named": o.named, "d": o.d, "noise": o.noise, "gear": o.gear, "false_claim": o.false_claim}))
        .collect();
    text.push_str(&format!(
        "\nfalse alarms on nothing: {alarms} of {} ({:.1}–{:.1} %), with probability > 0.95: {sure}\nouter causes: driver named {driver} of {}, {driver_strong} of the {} with d >= 6; a wrong name above 0.9: {bold}\nfalse names above 0.95 in all: {over}\nexpected calibration error of the largest probability: {ece:.3}\n",
        none.len(), 100.0 * fa, 100.0 * fz, outside.len(), strong.len()
    ));
    text.push_str("\n| among d >= 6, where rivals are known | sets | results |\n|---|---|---|\n");
    let known = |o: &&Outcome| o.class == "single" || o.class == "foreign";
    type Test<'a> = (&'a str, Box<dyn Fn(&&Outcome) -> bool>);
    let splits: [Test; 4] = [
        (
            "known, the best other cause leaves chi^2 >= 16 (separable)",
            Box::new(move |o| known(o) && o.rival.is_some_and(|r| r.0 >= 16.0)),
        ),
        (
            "known, it leaves less (look-alikes)",
            Box::new(move |o| known(o) && o.rival.is_some_and(|r| r.0 < 16.0)),
        ),
        (
            "outer, the best known cause explains < 65 %",
            Box::new(|o| o.class == "outside" && o.rival.is_some_and(|r| r.1 < 0.65)),
        ),
        (
            "outer, it explains more",
            Box::new(|o| o.class == "outside" && o.rival.is_some_and(|r| r.1 >= 0.65)),
        ),
    ];
    let mut rivals = Vec::new();
    for (name, test) in &splits {
        let some: Vec<&Outcome> = list.iter().filter(|o| o.d >= 6.0 && test(o)).collect();
        let row: Vec<String> = RESULTS
            .iter()
            .filter_map(|r| {
                Some((r, some.iter().filter(|o| o.result == *r).count())).filter(|c| c.1 > 0)
            })
            .map(|(r, c)| format!("{r} {c}"))
            .collect();
        text.push_str(&format!(
            "| {name} | {} | {} |\n",
            some.len(),
            row.join(", ")
        ));
        rivals.push(json!({"of": name, "sets": some.len(), "results": row}));
    }
    let mut by: BTreeMap<(String, &str), usize> = BTreeMap::new();
    for o in list
        .iter()
        .filter(|o| o.class != "none" && o.class != "pair" && o.d >= 6.0)
    {
        *by.entry((o.kinds.join("+"), o.result)).or_default() += 1;
    }
    text.push_str("\n| cause (d >= 6) | results |\n|---|---|\n");
    let mut kinds: Vec<&String> = by.keys().map(|k| &k.0).collect();
    kinds.dedup();
    for k in kinds {
        let row: Vec<String> = RESULTS
            .iter()
            .filter_map(|r| by.get(&(k.clone(), *r)).map(|c| format!("{r} {c}")))
            .collect();
        text.push_str(&format!("| {k} | {} |\n", row.join(", ")));
    }
    for w in &worst {
        text.push_str(&format!("\nwrong: {w}"));
    }
    text.push('\n');
    let json = json!({"sets": list.len(), "without_result": missing, "cells": cells,
        "false_alarms": {"sets": none.len(), "alarms": alarms, "interval": [fa, fz], "above_0.95": sure},
        "outside": {"sets": outside.len(), "driver_named": driver, "strong_sets": strong.len(), "strong_driver_named": driver_strong, "wrong_above_0.9": bold},
        "false_names_above_0.95": over, "calibration_error": ece, "rivals": rivals, "wrong": worst,
        "verdicts": list.iter().map(|o| json!({"name": o.name, "verdict": o.verdict, "result": o.result})).collect::<Vec<_>>()});
    (text, json)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Wilson's interval of 8 in 10, worked by hand from his formula: 0.490 to 0.943.
    #[test]
    fn interval() {
        let (a, b) = wilson(8, 10);
        assert!((a - 0.4902).abs() < 1e-3 && (b - 0.9433).abs() < 1e-3);
    }

    /// The base model has chi^2 100; a brings it to 60 with one parameter, b to 58 with four: by n = 100, a.
    #[test]
    fn information_criterion() {
        let screened = json!([
            {"effect": "a", "chi2_drop": 40.0, "values": [1.0]},
            {"effect": "b", "chi2_drop": 42.0, "values": [1.0, 2.0, 3.0, 4.0]},
        ]);
        let found = json!({"screened": screened, "unknown_evidence_gain": -1.0, "sparse_regression": ["b", "a"]});
        let [(_, bic), (_, sparse), (_, process)] = baselines(&found, 100);
        assert_eq!(bic["effect"], "a");
        assert_eq!(sparse["effect"], json!(["b", "a"]));
        assert_eq!(process["verdict"], "nothing_missing");
        let little = json!({"screened": [{"effect": "a", "chi2_drop": 4.0, "values": [1.0]}]});
        assert_eq!(baselines(&little, 100)[0].1["verdict"], "nothing_missing");
    }

    #[test]
    fn outcomes() {
        let truth = |class: &str, kinds: &[&str]| json!({"class": class, "kinds": kinds, "noise": 0.02, "d": 7.0, "effects": []});
        let found = |v: &str, e: Value, g: Value| json!({"verdict": v, "effect": e, "indistinguishable": g, "probabilities": {"a": 0.9, "b": 0.1}});
        let one = |t: &Value, f: &Value| judge("x", t, f).result;
        let t = truth("single", &["a"]);
        assert_eq!(one(&t, &found("effect", json!("a"), json!([]))), "exact");
        assert_eq!(
            one(&t, &found("effect", json!("b"), json!([["b", "a"]]))),
            "group"
        );
        assert_eq!(one(&t, &found("effect", json!("b"), json!([]))), "wrong");
        assert_eq!(
            one(&t, &found("ambiguous", Value::Null, json!([["a", "c"]]))),
            "group"
        );
        assert_eq!(
            one(&t, &found("ambiguous", Value::Null, json!([["b", "c"]]))),
            "ambiguous"
        );
        assert_eq!(
            one(&t, &found("nothing_missing", Value::Null, json!([]))),
            "nothing"
        );
        let beside = json!([["a+unknown", "c+unknown"]]);
        assert_eq!(one(&t, &found("partial", Value::Null, beside)), "half");
        let beside = json!([["b+unknown", "c+unknown"]]);
        assert_eq!(one(&t, &found("partial", Value::Null, beside)), "wrong");
        let mut t = truth("mixed", &["a", "own"]);
        t["effects"] =
            json!([{"kind": "a", "class": "single"}, {"kind": "own", "class": "outside"}]);
        assert_eq!(one(&t, &found("partial", json!("a"), json!([]))), "exact");
        let t = truth("pair", &["b", "a"]);
        assert_eq!(
            one(&t, &found("effects", json!(["a", "b"]), json!([]))),
            "exact"
        );
        assert_eq!(one(&t, &found("effect", json!("a"), json!([]))), "half");
        let t = truth("face", &["lead_crowning"]);
        assert_eq!(
            one(&t, &found("effect", json!("crowning"), json!([]))),
            "exact"
        );
        assert_eq!(
            one(
                &t,
                &found("ambiguous", Value::Null, json!([["crowning", "c"]]))
            ),
            "group"
        );
        assert_eq!(
            one(&truth("none", &[]), &found("effect", json!("a"), json!([]))),
            "wrong"
        );
        assert_eq!(
            one(
                &truth("outside", &["z"]),
                &found("unknown", Value::Null, json!([]))
            ),
            "exact"
        );
    }
}
