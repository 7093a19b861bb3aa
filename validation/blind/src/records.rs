//! What a diagnosis said of a set, and what counts of the answer: short enough to be kept where the data are not.

use std::fs;
use std::io::Result;
use std::path::Path;

use serde_json::{Value, json};

use crate::score::baselines;

/// Probabilities below this are not kept.
const LEAST: f64 = 1e-3;

/// One judged set.
pub struct Record {
    pub name: String,
    /// The counting part of `truth.json`.
    pub truth: Value,
    /// The counting part of `diagnosis.json`.
    pub found: Value,
    /// What simpler judges make of the same fits.
    pub simple: Vec<(String, Value)>,
    /// Model that decided, wall and processor seconds, program: `seconds.txt` beside the diagnosis.
    pub made: String,
}

impl Record {
    /// The sets of a folder that have a result, and the names of those without one.
    pub fn of_folders(data: &Path, results: &Path) -> Result<(Vec<Self>, Vec<String>)> {
        let mut paths: Vec<_> = fs::read_dir(data)?
            .filter_map(std::result::Result::ok)
            .map(|e| e.path())
            .filter(|p| p.join("truth.json").exists())
            .collect();
        paths.sort();
        let (mut list, mut missing) = (Vec::new(), Vec::new());
        for path in paths {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let answer = results.join(&*name);
            let Ok(text) = fs::read_to_string(answer.join("diagnosis.json")) else {
                missing.push(name.into_owned());
                continue;
            };
            let truth: Value = serde_json::from_str(&fs::read_to_string(path.join("truth.json"))?)?;
            let found: Value = serde_json::from_str(&text)?;
            // Where answers lie apart from the data, the values without noise are as many.
            let rows = match fs::read_to_string(path.join("measurements.csv")) {
                Ok(text) => text.lines().count(),
                Err(_) => truth["noise_free"].as_array().map_or(0, Vec::len),
            };
            let simple = baselines(&found, rows);
            let made = fs::read_to_string(answer.join("seconds.txt")).unwrap_or_default();
            list.push(Self {
                name: name.into_owned(),
                simple: simple.map(|(who, said)| (who.to_string(), said)).into(),
                truth: short_truth(&truth),
                found: short_found(&found),
                made: made.trim().to_string(),
            });
        }
        Ok((list, missing))
    }

    /// The records of a file written by [`write`].
    pub fn of_file(path: &Path) -> Result<Vec<Self>> {
        let text = fs::read_to_string(path)?;
        let line = |line: &str| -> Result<Self> {
            let v: Value = serde_json::from_str(line)?;
            let text = |key: &str| v[key].as_str().unwrap_or_default().to_string();
            let simple = v["simple"].as_object().into_iter().flatten();
            Ok(Self {
                name: text("name"),
                made: text("made"),
                simple: simple.map(|(k, v)| (k.clone(), v.clone())).collect(),
                truth: v["truth"].clone(),
                found: v["found"].clone(),
            })
        };
        text.lines().map(line).collect()
    }

    fn line(&self) -> String {
        let simple: serde_json::Map<String, Value> = self.simple.iter().cloned().collect();
        json!({"name": self.name, "made": self.made, "truth": self.truth, "found": self.found, "simple": simple})
            .to_string()
            + "\n"
    }
}

/// Writes records, a line each.
pub fn write(records: &[Record], path: &Path) -> Result<()> {
    fs::write(path, records.iter().map(Record::line).collect::<String>())
}

fn short_truth(truth: &Value) -> Value {
    let effects = truth["effects"].as_array().into_iter().flatten();
    let counting =
        |e: &Value| json!({"kind": e["kind"], "class": e["class"], "drivers": e["drivers"]});
    let mut out = json!({"effects": effects.map(counting).collect::<Vec<Value>>()});
    for key in ["class", "kinds", "noise", "gear", "d", "d_each"] {
        out[key] = truth[key].clone();
    }
    if let Some(rival) = truth["rivals"].get(0) {
        out["rivals"] = json!([{"left_chi2": rival["left_chi2"], "share": rival["share"]}]);
    }
    let forms = truth["effects"].as_array().into_iter().flatten();
    out["forms"] = forms.map(|e| e["form"].clone()).collect();
    out
}

fn short_found(found: &Value) -> Value {
    let mut out = json!({"driver": {"name": found["driver"]["name"]}});
    for key in ["verdict", "effect", "indistinguishable"] {
        out[key] = found[key].clone();
    }
    let probabilities = found["probabilities"].as_object().into_iter().flatten();
    let seen = probabilities.filter(|(_, p)| p.as_f64().is_some_and(|p| p >= LEAST));
    out["probabilities"] = Value::Object(seen.map(|(k, v)| (k.clone(), v.clone())).collect());
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::score;

    /// What is kept is judged as the whole was.
    #[test]
    fn a_kept_record_counts_as_the_whole() {
        let alone = json!({"class": "outside", "kinds": ["groove"], "noise": 0.05, "gear": "random", "d": 8.5, "d_each": [8.5], "seed": 3,
            "effects": [{"kind": "groove", "class": "outside", "form": "own", "drivers": ["position"], "parameters": {"a": 1.0}}],
            "rivals": [{"left_chi2": 12.0, "share": 0.7, "name": "x"}]});
        let unknown = json!({"verdict": "unknown", "effect": null, "indistinguishable": [], "driver": {"name": "position", "variance_share": 0.4},
            "probabilities": {"unknown": 0.9, "running_in": 0.0999, "nothing_missing": 0.0001}, "ranking": [1, 2]});
        let mut mixed = alone.clone();
        mixed["class"] = json!("mixed");
        mixed["kinds"] = json!(["coating", "groove"]);
        mixed["d_each"] = json!([8.5, 7.0]);
        mixed["effects"] =
            json!([{"kind": "coating", "class": "single", "form": "step"}, alone["effects"][0]]);
        let mut partial = unknown.clone();
        partial["verdict"] = json!("partial");
        partial["effect"] = json!("coating");
        assert_eq!(kept_and_judged(&alone, &unknown), "exact");
        assert_eq!(kept_and_judged(&mixed, &partial), "exact");
    }

    /// The result of a record that was written and read, checked to be that of the whole.
    fn kept_and_judged(truth: &Value, found: &Value) -> &'static str {
        let record = Record {
            name: "s1_0001".into(),
            truth: short_truth(truth),
            found: short_found(found),
            simple: vec![("nobody".into(), json!({"verdict": "unknown"}))],
            made: "full 10 8 abc".into(),
        };
        let path = std::env::temp_dir().join(format!(
            "blind_records_{}_{}.jsonl",
            std::process::id(),
            truth["class"]
        ));
        write(&[record], &path).unwrap();
        let back = Record::of_file(&path).unwrap();
        fs::remove_file(&path).unwrap();
        let kept = score::judge(&back[0].name, &back[0].truth, &back[0].found);
        let whole = score::judge("s1_0001", truth, found);
        assert_eq!(format!("{kept:?}"), format!("{whole:?}"));
        assert_eq!(
            (back[0].simple.len(), back[0].made.as_str()),
            (1, "full 10 8 abc")
        );
        kept.result
    }
}
