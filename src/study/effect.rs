//! `[[effect]]`: entries of the catalogue and the user's own formulas, with their values and bounds.

use super::effect_model::{EffectModel, EffectSpec, Law, Parameter};
use super::formula;
use super::learned;
use super::materials::{Lubricant, Thermal};
use super::quantity::{self as q, Short};
use super::reader::Table;
use crate::effects::{CATALOGUE, Card, Param};
use crate::source_text::{Diagnostic, Fault, list, nearest};

const VALUE_KEYS: &[&str] = &["value", "lower", "upper"];

/// Parameters that effects had once, with what holds instead.
const REMOVED: [(&str, &str, &str); 1] = [(
    "shaft_deflection",
    "face_width",
    "leave it out: the face width is that of [gears]",
)];

pub(super) type Result<T> = std::result::Result<T, Box<Diagnostic>>;

/// All `[[effect]]` entries.
pub(super) fn read(
    root: &Table<'_>,
    lubricant: Option<Lubricant>,
    thermal: Option<Thermal>,
) -> Result<EffectModel> {
    let mut specs: Vec<EffectSpec> = Vec::new();
    for table in root.tables("effect", None)? {
        let spec = entry(&table)?;
        if specs.iter().any(|above| above.name == spec.name) {
            let (key, hint) = match spec.kind.as_str() {
                formula::KIND => ("name", "formulas may stand together under different names"),
                learned::KIND => ("driver", "one learned law for each driver and member"),
                _ => ("kind", "formulas may stand together under different names"),
            };
            return Err(Box::new(
                table
                    .refuse(key, "stands there twice", "each effect once")
                    .with_hint(hint),
            ));
        }
        check_needs(&table, &spec, lubricant, thermal)?;
        specs.push(spec);
    }
    Ok(EffectModel::new(specs))
}

fn entry(table: &Table<'_>) -> Result<EffectSpec> {
    let what = "the effect's name in the catalogue, \"formula\" or \"learned\"";
    let Some(kind) = table.name("kind", what)? else {
        return Err(Box::new(
            table
                .missing("kind", "a text, the effect's name in the catalogue")
                .with_hint("`gearwear effects` lists the catalogue"),
        ));
    };
    if kind == formula::KIND {
        return formula::read(table);
    }
    if kind == learned::KIND {
        return learned::read(table);
    }
    match CATALOGUE.iter().find(|card| card.name == kind) {
        Some(card) => of_card(card, table),
        None => {
            let names = CATALOGUE.iter().map(|card| card.name);
            let near =
                nearest(kind, names.chain([formula::KIND, learned::KIND])).unwrap_or_default();
            Err(Box::new(
                table
                    .refuse(
                        "kind",
                        "is not in the catalogue",
                        "an effect of the catalogue, \"formula\" or \"learned\"",
                    )
                    .with_hint(format!("the nearest is \"{near}\""))
                    .with_hint("`gearwear effects` lists the catalogue"),
            ))
        }
    }
}

fn of_card(card: &'static Card, table: &Table<'_>) -> Result<EffectSpec> {
    let names = || card.params.iter().map(|param| param.name);
    let known = |key: &&str| *key != "kind" && !names().any(|name| name == *key);
    if let Some(key) = table.present().into_iter().find(known) {
        let mut diagnostic = table.refuse(key, "", list(names()));
        diagnostic = match REMOVED
            .iter()
            .find(|removed| (removed.0, removed.1) == (card.name, key))
        {
            Some((_, _, instead)) => diagnostic.with_hint(*instead),
            None => {
                let near = nearest(key, names()).unwrap_or_default();
                diagnostic.with_hint(format!("the nearest is `{near}`"))
            }
        };
        diagnostic =
            diagnostic.with_hint(format!("`gearwear effects {}` explains them", card.name));
        diagnostic.fault = Fault::UnknownKey;
        diagnostic.message = format!("{} has no parameter `{key}`", card.name);
        diagnostic.found = format!("`{key}`");
        diagnostic.span = table.key_span(key);
        return Err(Box::new(diagnostic));
    }
    let parameters = card
        .params
        .iter()
        .map(|param| {
            let name = format!("{}.{}", card.name, param.name);
            let (value, bounds) = if table.has(param.name) {
                stated(table, param.name, Some(param))?
            } else {
                (param.default, [None; 2])
            };
            Ok(Parameter {
                name,
                value,
                bounds,
                card: Some(param),
                stated: table.has(param.name),
            })
        })
        .collect::<Result<Vec<_>>>()?;
    let values: Vec<f64> = parameters.iter().map(|parameter| parameter.value).collect();
    if let Some(impossible) = (card.build)(&values).impossible() {
        let mut refusal = table
            .refuse(impossible.parameter, impossible.why, impossible.allowed)
            .with_hint(impossible.hint);
        refusal.fault = Fault::Inconsistent;
        return Err(Box::new(refusal));
    }
    Ok(EffectSpec {
        kind: card.name.to_owned(),
        name: card.name.to_owned(),
        law: Law::Card(card),
        parameters,
        span: table.header(),
        freed: &[],
        idle: &[],
        even: &[],
    })
}

/// `name = 1.0` or `name = { value = 1.0, lower = 0.0, upper = 2.0 }`: the value and the bounds.
pub(super) fn stated(
    table: &Table<'_>,
    name: &str,
    param: Option<&Param>,
) -> Result<(f64, [Option<f64>; 2])> {
    let any = "a number";
    let unit = param.map_or("-", |param| param.unit);
    if !table.holds_table(name) {
        let value = table.required_any(name, any, unit)?;
        check_value(table, name, value, param)?;
        return Ok((value, [None; 2]));
    }
    let inner = table.required_table(name, VALUE_KEYS)?;
    let value = inner.required_any("value", any, unit)?;
    check_value(&inner, "value", value, param)?;
    let (lower, upper) = (
        inner.number("lower", &q::Quantity { unit, ..q::ANY })?,
        inner.number("upper", &q::Quantity { unit, ..q::ANY })?,
    );
    for (key, bound) in [("lower", lower), ("upper", upper)] {
        let (Some(bound), Some(param)) = (bound, param) else {
            continue;
        };
        if !(param.range.0..=param.range.1).contains(&bound) {
            let says = "is outside the parameter's range";
            return Err(Box::new(inner.refuse(key, says, range(param))));
        }
    }
    let (least, most) = (lower.unwrap_or(f64::MIN), upper.unwrap_or(f64::INFINITY));
    if least >= most {
        let allowed = format!("above {least}");
        return Err(Box::new(inner.refuse(
            "upper",
            "is not above lower",
            allowed,
        )));
    }
    if value < least || value > most {
        let allowed = match (lower, upper) {
            (Some(lower), Some(upper)) => format!("{lower} to {upper}"),
            (Some(lower), None) => format!("{lower} or more"),
            _ => format!("up to {most}"),
        };
        return Err(Box::new(inner.refuse(
            "value",
            "is outside its own bounds",
            allowed,
        )));
    }
    Ok((value, [lower, upper]))
}

fn check_value(table: &Table<'_>, key: &str, value: f64, param: Option<&Param>) -> Result<()> {
    let refusal = match param {
        Some(param) if !param.accepts(value) => table
            .refuse(key, "is out of range", range(param))
            .with_hint(format!("{}: {}", param.name, param.meaning)),
        None if value.is_infinite() => table.refuse(key, "is not finite", "a finite number"),
        _ => return Ok(()),
    };
    Err(Box::new(refusal))
}

/// `0 to 50`, with the unit and the neutral value if it lies outside.
fn range(param: &Param) -> String {
    let (least, most) = param.range;
    let mut text = format!("{} to {}", Short(least), Short(most));
    if param.unit != "-" {
        text = format!("{text} {}", param.unit);
    }
    match param.neutral {
        Some(neutral) if !(least..=most).contains(&neutral) => {
            format!("{text}, or {neutral} for no effect")
        }
        _ => text,
    }
}

/// Refuses an effect that lacks what it follows from.
fn check_needs(
    table: &Table<'_>,
    spec: &EffectSpec,
    lubricant: Option<Lubricant>,
    thermal: Option<Thermal>,
) -> Result<()> {
    let Some(key) = spec
        .needs()
        .into_iter()
        .find(|key| !is_stated(key, lubricant, thermal))
    else {
        return Ok(());
    };
    let (home, short) = key.split_once('.').unwrap_or(("", key));
    let mut diagnostic = table
        .refuse("kind", "", format!("a study that states {key}"))
        .with_hint(format!("write `{short} = ...` in [{home}]"));
    diagnostic.fault = Fault::MissingKey;
    diagnostic.key = key.to_owned();
    diagnostic.message = format!("{} needs {key}, which the study does not state", spec.name);
    Err(Box::new(diagnostic))
}

/// Whether the study states an optional key that effects may need.
pub(super) fn is_stated(key: &str, lubricant: Option<Lubricant>, thermal: Option<Thermal>) -> bool {
    let lubricant = lubricant.unwrap_or_default();
    let thermal = thermal.unwrap_or_default();
    let value = match key {
        "lubricant.viscosity" => lubricant.viscosity_pa_s,
        "lubricant.pressure_viscosity" => lubricant.pressure_viscosity_per_gpa,
        "lubricant.roughness" => lubricant.roughness_um,
        "lubricant.friction_coefficient" => lubricant.friction_coefficient,
        "thermal.bulk_temperature" if thermal.warm => Some(thermal.ambient_c),
        "thermal.bulk_temperature" => thermal.bulk_temperature_c,
        "thermal.conductivity" => thermal.conductivity_w_mk,
        "thermal.specific_heat" => thermal.specific_heat_j_kgk,
        _ => None,
    };
    value.is_some()
}

#[cfg(test)]
mod tests {
    use super::super::{MATERIAL_AND_HEAT, Study};
    use super::*;
    use crate::effects::variables::VARIABLES;

    #[test]
    fn every_key_that_effects_need_is_one_of_the_study() {
        let all = CATALOGUE
            .iter()
            .flat_map(|card| card.needs)
            .chain(VARIABLES.iter().flat_map(|variable| variable.needs));
        let study = Study::parse(MATERIAL_AND_HEAT, "s.toml").unwrap();
        for key in all {
            assert!(is_stated(key, study.lubricant, study.thermal), "{key}");
            assert!(!is_stated(key, None, None), "{key}");
        }
    }

    /// Two cards do without: micropitting needs the film below a finite `lambda_c` only, and thermal expansion takes the
    /// reference temperature where the study states none.
    #[test]
    fn cards_need_what_their_formulas_need() {
        for card in CATALOGUE {
            let (formula, _) = card.compiled().unwrap();
            for key in formula.needs() {
                let without = match card.name {
                    "micropitting" => key.starts_with("lubricant."),
                    "thermal_expansion" => key == "thermal.bulk_temperature",
                    _ => false,
                };
                assert!(card.needs.contains(&key) || without, "{}: {key}", card.name);
            }
        }
    }
}
