//! The points of a sweep: one study each, checked before anything runs.

use std::collections::BTreeMap;
use std::fs;

use super::design::Design;
use super::figures::{Figures, Outputs};
use super::{CliError, grid};
use crate::simulate::checkpoint::{Fingerprint, fingerprint};
use crate::source_text::Fault;
use crate::study::{self, KEYS, Study, nearest};

/// Tables whose keys change no run at the study's own operation.
const IDLE: [&str; 5] = ["", "fit", "noise", "test", "measurements"];

/// Tables inside others, no keys.
const MEMBERS: [&str; 2] = ["pinion", "gear"];

/// One point.
pub(super) struct Point {
    /// Its values, key by key.
    pub values: Vec<String>,
    /// What its figures depend on, as a hash.
    pub key: String,
    /// Its study, or why its values make none: gears that jam, a misalignment that pulls them apart.
    pub(super) study: std::result::Result<Study, String>,
    /// Points with equal bodies share meshes and compliance.
    pub(super) bodies: String,
}

impl Point {
    /// Whether its values make a pair that can run.
    pub(super) fn is_possible(&self) -> bool {
        self.study.is_ok()
    }
}

/// Figures of a point, or why there are none.
pub(super) type Result = std::result::Result<Figures, String>;

/// Every point of a design as a valid study or the reason why it is none.
///
/// # Errors
/// [`CliError`] for a key that does not exist, for values that it never takes, and if no point makes a valid study.
pub(super) fn prepare(
    study: &Study,
    design: &Design,
    outputs: &Outputs,
) -> std::result::Result<Vec<Point>, CliError> {
    for (i, key) in design.keys.iter().enumerate() {
        check_key(study, key, design.said)?;
        if design.keys[..i].contains(key) {
            let message = format!("{} {key}: the key is varied twice", design.said);
            return Err(CliError::Unusable(message));
        }
    }
    let rows = design.rows.iter();
    let mut points = rows
        .map(|values| point(study, design, values.clone()))
        .collect::<std::result::Result<Vec<_>, _>>()?;
    if points.iter().all(|point| !point.is_possible()) {
        let why = points.iter().find_map(|point| point.study.as_ref().err());
        return Err(CliError::Unusable(why.cloned().unwrap_or_default()));
    }
    // the mesh depends on all loads that it has to resolve, so these belong to each point's key
    let mut loads: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for point in &points {
        let Ok(study) = &point.study else { continue };
        let (torque, misalignment) = load(study);
        let all = loads.entry(point.bodies.clone()).or_default();
        all.push(format!("{torque:?} {misalignment:?}"));
    }
    for all in loads.values_mut() {
        all.sort_unstable();
        all.dedup();
    }
    let loads: BTreeMap<String, Fingerprint> = loads
        .into_iter()
        .map(|(bodies, loads)| {
            let told = fingerprint(&[loads.join(",").as_bytes()]);
            (bodies, told)
        })
        .collect();
    let outputs = outputs.told_apart();
    for point in &mut points {
        let Ok(study) = &point.study else { continue };
        let mut parts = vec![
            study.text().as_bytes(),
            point.bodies.as_bytes(),
            &loads[&point.bodies],
        ];
        parts.extend(outputs.as_deref().map(str::as_bytes));
        let hash = fingerprint(&parts);
        point.key = hash[..16].iter().map(|b| format!("{b:02x}")).collect();
    }
    Ok(points)
}

fn check_key(study: &Study, key: &str, said: &str) -> std::result::Result<(), CliError> {
    if key == "wear.coefficient" && study.wear.members != [1.0; 2] {
        return Err(CliError::Unusable(format!(
            "{said} {key}: members state their own; vary wear.pinion.coefficient or wear.gear.coefficient"
        )));
    }
    let mut of_tables = Vec::new();
    for (table, keys) in KEYS.iter().filter(|(table, _)| !IDLE.contains(table)) {
        // what is said of one member can be said of the other
        let homes: &[&str] = match *table {
            "gears.pinion" => &["gears.pinion", "gears.gear"],
            "wear.pinion" => &["wear.pinion", "wear.gear"],
            "face.pinion" => &["face.pinion", "face.gear"],
            "teeth.pinion" => &["teeth.pinion", "teeth.gear"],
            "material" => &["material", "material.pinion", "material.gear"],
            table => &[table],
        };
        let plain = keys.iter().filter(|key| !MEMBERS.contains(key));
        of_tables
            .extend(plain.flat_map(|key| homes.iter().map(move |home| format!("{home}.{key}"))));
    }
    let of_effects: Vec<&str> = study
        .effect_model()
        .parameters()
        .map(|parameter| parameter.name.as_str())
        .collect();
    let all = || {
        let names = of_tables.iter().map(String::as_str);
        names.chain(of_effects.iter().copied())
    };
    if all().any(|name| name == key) {
        return Ok(());
    }
    if let Some((kind, _)) = key.split_once('.')
        && crate::effects::CATALOGUE
            .iter()
            .any(|card| card.name == kind)
        && !of_effects
            .iter()
            .any(|name| name.starts_with(&format!("{kind}.")))
    {
        return Err(CliError::Unusable(format!(
            "{said} {key}: the study has no effect {kind}; put [[effect]] with kind = \"{kind}\" into it, or take the study that `gearwear add` \
             writes"
        )));
    }
    let last = key.rsplit('.').next().unwrap_or(key);
    let same_end = all().find(|name| !key.contains('.') && name.rsplit('.').next() == Some(last));
    let near = match same_end.or_else(|| nearest(key, all())) {
        Some(near) => format!("; the nearest valid key is `{near}`"),
        None => format!(
            "; valid are the keys of the tables [{}] and the parameters of the study's effects, such as operation.torque",
            KEYS.iter()
                .map(|(table, _)| *table)
                .filter(|table| !IDLE.contains(table) && *table != "effect")
                .collect::<Vec<_>>()
                .join("], [")
        ),
    };
    Err(CliError::Unusable(format!(
        "{said} {key}: no such key to vary{near}"
    )))
}

fn point(
    study: &Study,
    design: &Design,
    values: Vec<String>,
) -> std::result::Result<Point, CliError> {
    let shown: Vec<String> = (design.keys.iter().zip(&values))
        .map(|(key, value)| format!("{key}={value}"))
        .collect();
    let said = |why: &dyn std::fmt::Display| {
        let why = why.to_string();
        let why = why.strip_prefix("error: ").unwrap_or(&why);
        format!("{} {}: {why}", design.said, shown.join(" "))
    };
    let failed = |why: &dyn std::fmt::Display| CliError::Unusable(said(why));
    let mut edit = study.edit();
    for (key, value) in design.keys.iter().zip(&values) {
        let of_effect = study.effect_model().parameter(key).is_some();
        if of_effect {
            let number = value.parse::<f64>().ok().filter(|v| v.is_finite());
            let number = number.ok_or_else(|| failed(&"the value of a parameter is a number"))?;
            edit.set(key, number);
        } else if !edit.put(key, &grid::toml(value)) {
            let why = "the study states its table in a form that cannot be changed; write it with a header";
            return Err(failed(&why));
        }
    }
    // values that are right one by one and impossible together belong into the table
    let (study, bodies) = match edit.finish(&study.source().name) {
        Ok(study) => {
            let bodies = bodies(&study)?;
            (Ok(study), bodies)
        }
        Err(error) if error.diagnostic().fault == Fault::Inconsistent => {
            (Err(said(&error)), String::new())
        }
        Err(error) => return Err(failed(&error)),
    };
    Ok(Point {
        values,
        key: String::new(),
        study,
        bodies,
    })
}

/// All that meshes and compliance depend on but the loads; models without them have none.
fn bodies(study: &Study) -> std::result::Result<String, CliError> {
    if study.contact != study::ContactKind::Fem {
        return Ok(String::new());
    }
    let mut out = format!("{:?} {:?}", study.gear_set(), study.resolution());
    for (member, path) in study.own_meshes() {
        if let Some(path) = path {
            let bytes = fs::read(path).map_err(|error| {
                let message = format!("cannot read {}: {error}", path.display());
                super::super::mesh::refusal(study, member, &message)
            })?;
            out += &format!(" {:?}", fingerprint(&[&bytes]));
        }
    }
    Ok(out)
}

/// Torque, N·mm, and radial misalignment, mm.
pub(super) fn load(study: &Study) -> (f64, f64) {
    (study.operation.torque_nmm, study.operation.misalignment_mm)
}
