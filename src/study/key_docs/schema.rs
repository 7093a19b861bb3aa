//! The JSON schema of study files, from the same table as the guide: editors complete keys by it and mark mistakes while they are typed.
//!
//! It knows keys, types, bounds and what is needed. What only the reader knows (gears that cannot run, names of parameters) it lets pass.

use serde_json::{Map, Value as Json, json};

use super::super::quantity::{Bound, Quantity};
use super::{KEY_DOCS, KeyDoc, Value, Without};
use crate::effects::CATALOGUE;

/// Tables that stand several times.
const LISTS: [&str; 2] = ["effect", "test"];
/// The schema that a document follows.
const DRAFT: &str = "http://json-schema.org/draft-07/schema#";

/// The schema (draft 7) of a study.
pub fn schema() -> Json {
    let mut tables: Vec<&str> = Vec::new();
    for doc in KEY_DOCS {
        if !tables.contains(&doc.table) {
            tables.push(doc.table);
        }
    }
    let mut root = table_of("");
    for table in tables.iter().filter(|table| !table.is_empty()) {
        let own = match *table {
            "effect" => effect(),
            "material" => material(),
            "wear" | "wear.pinion" => wear(table),
            table => table_of(table),
        };
        match table.split_once('.') {
            // what is said of one member can be said of the other
            Some((parent, "pinion")) => {
                let parent = entry(&mut root, parent);
                for member in ["pinion", "gear"] {
                    parent["properties"][member] = own.clone();
                }
                if parent.get("required").is_some()
                    && own.get("required").is_some()
                    && table.starts_with("gears")
                {
                    need(parent, "pinion");
                    need(parent, "gear");
                }
            }
            _ => {
                let needed = ["gears", "material", "operation", "wear"].contains(table);
                root["properties"][*table] = if LISTS.contains(table) {
                    json!({"type": "array", "items": own})
                } else {
                    own
                };
                if needed {
                    need(&mut root, table);
                }
            }
        }
    }
    root["$schema"] = json!(DRAFT);
    root["title"] = json!("gearwear study");
    root
}

/// The parent of a member's table; made if it has no keys of its own.
fn entry<'r>(root: &'r mut Json, name: &str) -> &'r mut Json {
    let known = &mut root["properties"][name];
    if known.is_null() {
        *known = json!({"type": "object", "properties": {}, "additionalProperties": false});
    }
    known
}

fn need(table: &mut Json, key: &str) {
    match table["required"].as_array_mut() {
        Some(keys) => keys.push(json!(key)),
        None => table["required"] = json!([key]),
    }
}

/// A table with its keys.
fn table_of(table: &str) -> Json {
    let docs = || KEY_DOCS.iter().filter(|doc| doc.table == table);
    let properties: Map<String, Json> = docs()
        .map(|doc| (doc.key.to_owned(), doc.schema()))
        .collect();
    let needed: Vec<&str> = docs()
        .filter(|doc| doc.without == Without::Refused)
        .map(|doc| doc.key)
        .collect();
    let mut object =
        json!({"type": "object", "properties": properties, "additionalProperties": false});
    if !needed.is_empty() {
        object["required"] = json!(needed);
    }
    object
}

/// Of both members, or one table for each.
fn material() -> Json {
    let own = table_of("material");
    let each = json!({
        "type": "object",
        "properties": {"pinion": own, "gear": own},
        "required": ["pinion", "gear"],
        "additionalProperties": false,
    });
    json!({"anyOf": [own, each]})
}

/// A coefficient, or a pair of materials in its place.
fn wear(table: &str) -> Json {
    let mut own = table_of(table);
    // indexing would put a null in place of what is not there
    if let Some(needed) = own.get_mut("required").and_then(Json::as_array_mut) {
        needed.retain(|key| key != "coefficient");
    }
    own["oneOf"] = json!([
        {"required": ["coefficient"]},
        {"required": ["material"], "not": {"required": ["coefficient"]}},
    ]);
    own
}

/// An effect of the catalogue, a formula or a learned law: a parameter's name depends on the kind.
fn effect() -> Json {
    let mut object = table_of("effect");
    let kinds = CATALOGUE.iter().map(|card| card.name);
    let kinds: Vec<&str> = kinds.chain(["formula", "learned"]).collect();
    object["properties"]["kind"]["enum"] = json!(kinds);
    object["required"] = json!(["kind"]);
    for card in CATALOGUE {
        for param in card.params {
            let known = &mut object["properties"][param.name];
            if known.is_null() {
                // the same name may stand in several cards, with other units
                *known = json!({"description": format!("a parameter of {}: see `gearwear effects`", card.name)});
            }
        }
    }
    object["additionalProperties"] = json!(true);
    object
}

impl KeyDoc {
    /// The schema of the key's value.
    fn schema(&self) -> Json {
        let mut value = match self.value {
            Value::Number(quantity) => with_unit(number(quantity)),
            Value::Count(least, most) => {
                json!({"type": "integer", "minimum": least, "maximum": most})
            }
            Value::Flag => json!({"type": "boolean"}),
            Value::Text => json!({"type": "string"}),
            Value::Texts => json!({"type": "array", "items": {"type": "string"}}),
            Value::Numbers => json!({"type": "array", "items": {"type": "number"}}),
            Value::Word(words) => json!({"enum": words}),
            Value::WordOr(word, quantity) => json!({"anyOf": [{"const": word}, number(quantity)]}),
            Value::Table => json!({"type": "object"}),
        };
        let unit = match self.value {
            Value::Number(quantity) | Value::WordOr(_, quantity) if quantity.unit != "-" => {
                format!(" [{}]", quantity.unit)
            }
            _ => String::new(),
        };
        let without = match self.without {
            Without::Refused => String::new(),
            Without::Default(value) => format!("; default {value}"),
            Without::Words(words) => format!("; without: {words}"),
        };
        value["description"] = json!(format!("{}{unit}{without}", self.meaning));
        value
    }
}

fn number(quantity: &Quantity) -> Json {
    let mut number = json!({"type": "number"});
    match quantity.least {
        Bound::From(least) if least.is_finite() => number["minimum"] = json!(least),
        Bound::Above(least) if least.is_finite() => number["exclusiveMinimum"] = json!(least),
        _ => {}
    }
    if quantity.most.is_finite() {
        number["maximum"] = json!(quantity.most);
    }
    number
}

/// A number may be a text with its unit.
fn with_unit(number: Json) -> Json {
    json!({"anyOf": [number, {"type": "string", "pattern": "^\\s*[-+.0-9]"}]})
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A null where an editor expects a list makes it drop the whole schema.
    #[test]
    fn it_holds_no_nulls() {
        fn nulls(at: &Json, path: &str, found: &mut Vec<String>) {
            match at {
                Json::Null => found.push(path.to_owned()),
                Json::Array(list) => list.iter().for_each(|one| nulls(one, path, found)),
                Json::Object(map) => map
                    .iter()
                    .for_each(|(key, one)| nulls(one, &format!("{path}.{key}"), found)),
                _ => {}
            }
        }
        let mut found = Vec::new();
        nulls(&schema(), "", &mut found);
        assert_eq!(found, Vec::<String>::new());
    }

    #[test]
    fn every_key_stands_in_its_table() {
        let schema = schema();
        for doc in KEY_DOCS {
            let mut at = &schema;
            for part in doc.table.split('.').filter(|part| !part.is_empty()) {
                at = &at["properties"][part];
                at = at.get("items").unwrap_or(at);
                at = at.get("anyOf").map_or(at, |forms| &forms[0]);
            }
            let found = &at["properties"][doc.key];
            let told = found["description"].as_str();
            assert!(
                told.is_some_and(|t| t.starts_with(doc.meaning)),
                "{doc:?}: {found}"
            );
        }
        assert_eq!(
            schema["required"],
            json!(["gears", "material", "operation", "wear"])
        );
        let torque = &schema["properties"]["operation"]["properties"]["torque"]["anyOf"][0];
        assert_eq!(torque["type"], "number");
        assert_eq!(
            schema["properties"]["gears"]["properties"]["gear"]["required"],
            json!(["teeth", "bore_diameter"])
        );
    }
}
