//! `gearwear effects`: what it prints.

use assert_cmd::Command;
use gearwear::effects::CATALOGUE;
use serde_json::Value;

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

#[test]
fn the_list_has_a_line_for_each() {
    let (code, out, err) = gearwear(&["effects"]);
    assert_eq!((code, err.as_str()), (Some(0), ""));
    for card in CATALOGUE {
        let line = out
            .lines()
            .find(|line| line.split(' ').next() == Some(card.name))
            .unwrap();
        assert!(
            line.chars().count() <= 100 && line.len() > card.name.len() + 20,
            "{line}"
        );
    }
}

#[test]
fn one_effect_in_detail() {
    for card in CATALOGUE {
        let (code, out, _) = gearwear(&["effects", card.name]);
        assert_eq!(code, Some(0));
        assert!(out.lines().all(|line| line.chars().count() <= 100), "{out}");
        let flat = out.split_whitespace().collect::<Vec<_>>().join(" ");
        for text in [card.formula, card.source, card.signature, card.separated_by] {
            assert!(flat.contains(text), "{}: {text}\n{flat}", card.name);
        }
        for param in card.params {
            // as people write it
            let unit = param.unit.replace("mm um", "mm·um").replace("um", "µm");
            let text = format!("{} ({unit}): {}", param.name, param.meaning);
            assert!(flat.contains(&text), "{text}\n{flat}");
        }
        for other in card.confounded_with {
            assert!(flat.contains(other));
        }
    }
}

#[test]
fn json_is_a_list() {
    let (code, out, _) = gearwear(&["effects", "--json"]);
    assert_eq!(code, Some(0));
    let list: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(list.as_array().unwrap().len(), CATALOGUE.len());
    for (entry, card) in list.as_array().unwrap().iter().zip(CATALOGUE) {
        assert_eq!(entry["name"], card.name);
        assert_eq!(entry["formula"], card.formula);
        assert_eq!(entry["source"], card.source);
        let parameters = entry["parameters"].as_array().unwrap();
        assert_eq!(parameters.len(), card.params.len());
        for (parameter, param) in parameters.iter().zip(card.params) {
            assert_eq!(parameter["name"], param.name);
            assert_eq!(parameter["unit"], param.unit);
            let value = if param.default.is_infinite() {
                "inf".into()
            } else {
                Value::from(param.default)
            };
            assert_eq!(parameter["default"], value);
        }
    }
    let (_, out, _) = gearwear(&["effects", "micropitting", "--json"]);
    let one: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(one.as_array().unwrap().len(), 1);
}

#[test]
fn an_unknown_name_is_unusable_input() {
    let (code, out, err) = gearwear(&["effects", "micropiting"]);
    assert_eq!((code, out.as_str()), (Some(2), ""));
    assert_eq!(
        err.trim(),
        "error: there is no effect `micropiting`; the nearest is `micropitting`"
    );
}
