//! Judges what `gearwear climb` ended with: several causes found one after another.

use std::collections::BTreeMap;
use std::fs;
use std::io::Result;
use std::path::Path;

use serde_json::Value;

use crate::score;

/// What a climb's end is worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum End {
    /// All causes and nothing else.
    Exact,
    /// All causes, some of them in a group that the data cannot tell apart.
    Group,
    /// All but one of several causes (at least one), and it says that something remains.
    Half,
    /// Some of the causes, no false one, and it says that nothing remains, or more than one is lacking.
    Short,
    /// A name that is none of the causes nor stands in a group with one.
    Wrong,
}

/// `climb`: climb.json; `last`: the diagnosis of the last step.
pub fn judge(truth: &Value, climb: &Value, last: &Value) -> End {
    let list = |v: &Value| -> Vec<String> {
        let texts = v.as_array().into_iter().flatten().filter_map(Value::as_str);
        texts.flat_map(score::names).collect()
    };
    let (want, named) = (list(&truth["kinds"]), list(&climb["effects"]));
    let groups: Vec<Vec<String>> = [climb, last]
        .iter()
        .flat_map(|v| v["indistinguishable"].as_array().into_iter().flatten())
        .map(list)
        .collect();
    let together = |a: &String, b: &String| groups.iter().any(|g| g.contains(a) && g.contains(b));
    let stands =
        |n: &String| want.contains(n) || want.iter().any(|w| !named.contains(w) && together(n, w));
    if !named.iter().all(stands) {
        return End::Wrong;
    }
    let open = last["verdict"] == "ambiguous";
    let covered = |w: &String| {
        let left_open = open && groups.iter().any(|g| g.contains(w));
        named.contains(w) || named.iter().any(|n| together(n, w)) || left_open
    };
    let lacking = want.iter().filter(|w| !covered(w)).count();
    let rest = climb["verdict"].as_str() != Some("nothing_missing");
    match lacking {
        0 if want.iter().all(|w| named.contains(w)) => End::Exact,
        0 => End::Group,
        1 if rest && want.len() > 1 => End::Half,
        _ => End::Short,
    }
}

/// A table of the climbs of a folder (climb.json and diagnosis.json in a folder a set) against the sets' truths.
pub fn table(data: &Path, climbs: &Path) -> Result<String> {
    let read =
        |path: &Path| -> Result<Value> { Ok(serde_json::from_str(&fs::read_to_string(path)?)?) };
    let mut counts: BTreeMap<(String, End), usize> = BTreeMap::new();
    let mut lines = String::new();
    let mut paths: Vec<_> = fs::read_dir(climbs)?
        .filter_map(|e| Some(e.ok()?.path()))
        .collect();
    paths.sort();
    for path in paths.iter().filter(|p| p.join("climb.json").exists()) {
        let name = path.file_name().unwrap_or_default();
        let truth = read(&data.join(name).join("truth.json"))?;
        let climb = read(&path.join("climb.json"))?;
        let last = read(&path.join("diagnosis.json")).unwrap_or_default();
        let end = judge(&truth, &climb, &last);
        let class = truth["class"].as_str().unwrap_or_default().to_string();
        *counts.entry((class, end)).or_default() += 1;
        let name = name.to_string_lossy();
        lines += &format!(
            "{name}: {end:?}, truth {}, named {}\n",
            truth["kinds"], climb["effects"]
        );
    }
    let mut text = String::from(
        "| class | exact | group | half | short | wrong |\n|---|---|---|---|---|---|\n",
    );
    let classes: std::collections::BTreeSet<&String> = counts.keys().map(|k| &k.0).collect();
    for class in classes {
        let ends = [End::Exact, End::Group, End::Half, End::Short, End::Wrong];
        let cells = ends.map(|e| {
            counts
                .get(&(class.clone(), e))
                .copied()
                .unwrap_or(0)
                .to_string()
        });
        text += &format!("| {class} | {} |\n", cells.join(" | "));
    }
    Ok(text + "\n" + &lines)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn ends_of_climbs() {
        let truth = json!({"kinds": ["a", "b", "c"]});
        let end = |effects: Value, verdict: &str, last: Value| {
            judge(
                &truth,
                &json!({"effects": effects, "verdict": verdict}),
                &last,
            )
        };
        let done = "nothing_missing";
        assert_eq!(end(json!(["c", "a", "b"]), done, json!({})), End::Exact);
        let alike = json!({"indistinguishable": [["c", "d"]]});
        assert_eq!(end(json!(["a", "b", "d"]), done, alike.clone()), End::Group);
        assert_eq!(end(json!(["a", "b", "d"]), done, json!({})), End::Wrong);
        // A look-alike beside the cause itself is one name too many.
        assert_eq!(end(json!(["a", "b", "c", "d"]), done, alike), End::Wrong);
        assert_eq!(
            end(json!(["a", "b"]), "unknown", json!({"verdict": "unknown"})),
            End::Half
        );
        assert_eq!(
            end(json!(["a", "b"]), done, json!({"verdict": done})),
            End::Short
        );
        assert_eq!(
            end(json!(["a"]), "unknown", json!({"verdict": "unknown"})),
            End::Short
        );
        let open = json!({"verdict": "ambiguous", "indistinguishable": [["c", "d"]]});
        assert_eq!(end(json!(["a", "b"]), "ambiguous", open), End::Group);
    }
}
