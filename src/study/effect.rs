//! `[[effect]]`: read as written, whatever its kind; [`resolve`] then asks whether such an effect exists.

use std::ops::Range;

use toml::de::DeValue;

use super::quantity as q;
use super::reader::Table;
use crate::source_text::{Diagnostic, Fault, list, nearest};

/// Keys of an entry that are not parameters.
const FORMULA_KEYS: &[&str] = &[
    "kind",
    "name",
    "wear_factor",
    "added_depth",
    "load_factor",
    "profile",
    "parameters",
];
const VALUE_KEYS: &[&str] = &["value", "lower", "upper"];

/// One `[[effect]]` as the study states it.
#[derive(Debug, Clone, PartialEq)]
pub struct EffectSpec {
    /// Name in the catalogue, or `formula`.
    pub kind: String,
    /// The parameters in the order of the file.
    pub parameters: Vec<(String, ParamValue)>,
    /// The user's own expression, if `kind` is `formula`.
    pub formula: Option<Formula>,
    /// Where the entry stands, bytes of the study's text.
    pub span: Range<usize>,
}

impl EffectSpec {
    /// The name before the point in `fit.free`: the kind, or a formula's own name.
    pub fn name(&self) -> &str {
        self.formula
            .as_ref()
            .map_or(&self.kind, |formula| &formula.name)
    }
}

/// A parameter's value and the bounds the user sets for fitting it, in the parameter's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParamValue {
    /// The value, also where a fit starts.
    pub value: f64,
    /// Smallest value a fit may try.
    pub lower: Option<f64>,
    /// Largest value a fit may try.
    pub upper: Option<f64>,
}

/// A user's own effect.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Formula {
    /// Name of the user's choice.
    pub name: String,
    /// What the expression stands for.
    pub hook: Hook,
    /// The expression, not yet parsed.
    pub expression: String,
}

/// What a formula gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hook {
    /// Factor on the wear coefficient.
    WearFactor,
    /// Depth per contact of that member, µm.
    AddedDepth,
    /// Factor on the tooth load.
    LoadFactor,
    /// Material removed before the start, µm.
    Profile,
}

const HOOKS: [(&str, Hook); 4] = [
    ("wear_factor", Hook::WearFactor),
    ("added_depth", Hook::AddedDepth),
    ("load_factor", Hook::LoadFactor),
    ("profile", Hook::Profile),
];

type Result<T> = std::result::Result<T, Box<Diagnostic>>;

/// All `[[effect]]` entries, each checked by [`resolve`].
pub(super) fn read(root: &Table<'_>) -> Result<Vec<EffectSpec>> {
    root.tables("effect", None)?
        .iter()
        .map(|table| {
            let spec = entry(table)?;
            resolve(&spec, table)?;
            Ok(spec)
        })
        .collect()
}

/// Asks the catalogue for the effect. There is none yet, so every entry is refused; a registry's lookup by `spec.kind` and
/// its check of the parameters' names and ranges come here.
fn resolve(spec: &EffectSpec, table: &Table<'_>) -> Result<()> {
    let mut diagnostic = table
        .refuse("kind", "cannot be used", "no [[effect]]")
        .with_hint("effects are not available in this version: remove the entry");
    diagnostic.fault = Fault::NotAvailable;
    diagnostic.message = format!(
        "effect.kind = \"{}\": effects are not available in this version",
        spec.kind
    );
    Err(Box::new(diagnostic))
}

fn entry(table: &Table<'_>) -> Result<EffectSpec> {
    let Some(kind) = table.name("kind", "the effect's name in the catalogue")? else {
        return Err(Box::new(
            table.missing("kind", "a text, the effect's name in the catalogue"),
        ));
    };
    if kind == "formula" {
        return formula(table);
    }
    let parameters = parameters(table, &["kind"])?;
    Ok(EffectSpec {
        kind: kind.to_owned(),
        parameters,
        formula: None,
        span: table.header(),
    })
}

fn formula(table: &Table<'_>) -> Result<EffectSpec> {
    if let Some(key) = table
        .present()
        .into_iter()
        .find(|key| !FORMULA_KEYS.contains(key))
    {
        let near = nearest(key, FORMULA_KEYS.iter().copied()).unwrap_or_default();
        let mut diagnostic = table
            .refuse(
                key,
                "is no key of a formula",
                list(FORMULA_KEYS.iter().copied()),
            )
            .with_hint(format!(
                "the nearest valid key is `{near}`; parameters stand in [effect.parameters]"
            ));
        diagnostic.fault = Fault::UnknownKey;
        return Err(Box::new(diagnostic));
    }
    let what = "the name in `fit.free` and in results";
    let name = table.name("name", what)?.ok_or_else(|| {
        table
            .missing("name", "a text, the formula's name")
            .with_hint(what)
    })?;
    let stated: Vec<_> = HOOKS.iter().filter(|(key, _)| table.has(key)).collect();
    let allowed = "one of wear_factor, added_depth, load_factor, profile";
    let (key, hook) = match stated[..] {
        [only] => *only,
        [] => return Err(Box::new(table.missing("wear_factor", allowed))),
        [_, second, ..] => {
            return Err(Box::new(table.refuse(
                second.0,
                "is a second expression",
                allowed,
            )));
        }
    };
    let expression = table
        .name(key, "an expression in named variables")?
        .unwrap_or_default()
        .to_owned();
    let parameters = table
        .free_table("parameters")?
        .map_or(Ok(Vec::new()), |inner| parameters(&inner, &[]))?;
    Ok(EffectSpec {
        kind: "formula".to_owned(),
        parameters,
        formula: Some(Formula {
            name: name.to_owned(),
            hook,
            expression,
        }),
        span: table.header(),
    })
}

fn parameters(table: &Table<'_>, others: &[&str]) -> Result<Vec<(String, ParamValue)>> {
    let names = table
        .present()
        .into_iter()
        .filter(|key| !others.contains(key));
    names
        .map(|name| Ok((name.to_owned(), parameter(table, name)?)))
        .collect()
}

/// `name = 1.0` or `name = { value = 1.0, lower = 0.0, upper = 2.0 }`.
fn parameter(table: &Table<'_>, name: &str) -> Result<ParamValue> {
    let Some((DeValue::Table(_), _)) = table.get(name) else {
        return Ok(ParamValue {
            value: table.required_number(name, &q::ANY)?,
            lower: None,
            upper: None,
        });
    };
    let inner = table.required_table(name, VALUE_KEYS)?;
    let value = inner.required_number("value", &q::ANY)?;
    let (lower, upper) = (
        inner.number("lower", &q::ANY)?,
        inner.number("upper", &q::ANY)?,
    );
    let (least, most) = (lower.unwrap_or(f64::MIN), upper.unwrap_or(f64::MAX));
    if least >= most {
        return Err(Box::new(inner.refuse(
            "upper",
            "is not above lower",
            format!("above {least}"),
        )));
    }
    if value < least || value > most {
        return Err(Box::new(inner.refuse(
            "value",
            "is outside its own bounds",
            format!("{least} to {most}"),
        )));
    }
    Ok(ParamValue {
        value,
        lower,
        upper,
    })
}
