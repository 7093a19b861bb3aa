//! `kind = "formula"`: the user's own expression, with faults shown inside it.

use std::ops::Range;

use super::edit::rounded;
use super::effect::{Result, stated};
use super::effect_model::{EffectSpec, Law, Parameter};
use super::reader::Table;
use crate::effects::formula::{FUNCTIONS, Formula, FormulaError};
use crate::effects::variables::VARIABLES;
use crate::effects::{Hook, find};
use crate::source_text::{Diagnostic, Fault, list, nearest};

/// The `kind` of a formula.
pub(super) const KIND: &str = "formula";

pub(super) const KEYS: &[&str] = &[
    "kind",
    "name",
    "wear_factor",
    "added_depth",
    "load_factor",
    "profile",
    "parameters",
];

const HOOKS: [Hook; 4] = [
    Hook::WearFactor,
    Hook::AddedDepth,
    Hook::LoadFactor,
    Hook::Profile,
];

/// An `[[effect]]` of this kind.
pub(super) fn read(table: &Table<'_>) -> Result<EffectSpec> {
    check_keys(table)?;
    let name = name(table)?;
    let hook = hook(table)?;
    let expression = table.text(hook.name())?.unwrap_or_default();
    let inner = table.free_table("parameters")?;
    let mut parameters = Vec::new();
    for short in inner.iter().flat_map(Table::present) {
        let Some(inner) = &inner else { continue };
        let (value, bounds) = stated(inner, short, None)?;
        parameters.push(Parameter {
            name: format!("{name}.{short}"),
            value,
            bounds,
            card: None,
            stated: true,
        });
    }
    let names: Vec<&str> = parameters.iter().map(Parameter::short).collect();
    let formula = Formula::new(hook, expression, &names)
        .map_err(|error| fault(table, inner.as_ref(), hook, &error))?;
    let values: Vec<f64> = parameters.iter().map(|p| p.value).collect();
    if let Some(message) = formula.constant_fault(&values) {
        let mut diagnostic = table.refuse(hook.name(), "", "");
        diagnostic.message = format!("effect.{message}");
        diagnostic.found = String::new();
        diagnostic.span = diagnostic.span.map(|span| {
            let inside = inside_text(table.raw(&span), 0, expression.chars().count());
            span.start + inside.start..span.start + inside.end
        });
        return Err(Box::new(diagnostic));
    }
    Ok(EffectSpec {
        kind: KIND.to_owned(),
        name: name.to_owned(),
        law: Law::Formula {
            formula,
            expression: expression.to_owned(),
        },
        parameters,
        span: table.header(),
        freed: &[],
        idle: &[],
        even: &[],
    })
}

impl EffectSpec {
    /// A formula that stands in no study yet: its name, what it gives, the expression, and each parameter's name, value and bounds.
    ///
    /// # Errors
    /// [`FormulaError`]
    pub fn of_formula(
        name: &str,
        hook: Hook,
        expression: &str,
        parameters: &[(&str, f64, [f64; 2])],
    ) -> std::result::Result<Self, FormulaError> {
        let names: Vec<&str> = parameters.iter().map(|(name, ..)| *name).collect();
        let formula = Formula::new(hook, expression, &names)?;
        let own = |&(short, value, bounds): &(&str, f64, [f64; 2])| Parameter {
            name: format!("{name}.{short}"),
            value,
            bounds: bounds.map(Some),
            card: None,
            stated: false,
        };
        Ok(Self {
            kind: KIND.to_owned(),
            name: name.to_owned(),
            law: Law::Formula {
                formula,
                expression: expression.to_owned(),
            },
            parameters: parameters.iter().map(own).collect(),
            span: 0..0,
            freed: &[],
            idle: &[],
            even: &[],
        })
    }

    /// A formula's expression as written; nothing of another effect.
    pub fn expression(&self) -> &str {
        match &self.law {
            Law::Formula { expression, .. } => expression,
            Law::Card(_) | Law::Learned(_) => "",
        }
    }

    /// The lines of a formula's entry in a study, without the header; none of another effect.
    pub fn formula_lines(&self) -> Vec<String> {
        let Law::Formula {
            formula,
            expression,
        } = &self.law
        else {
            return Vec::new();
        };
        let parameter = |p: &Parameter| {
            let ends = ["lower", "upper"].into_iter().zip(p.bounds);
            let bounds: String = ends
                .filter_map(|(end, bound)| Some(format!(", {end} = {:?}", bound?)))
                .collect();
            format!(
                "{} = {{ value = {:?}{bounds} }}",
                p.short(),
                rounded(p.value)
            )
        };
        let parameters: Vec<String> = self.parameters.iter().map(parameter).collect();
        vec![
            format!("kind = \"{KIND}\""),
            format!("name = \"{}\"", self.name),
            format!("{} = \"{expression}\"", formula.hook().name()),
            format!("parameters = {{ {} }}", parameters.join(", ")),
        ]
    }
}

fn check_keys(table: &Table<'_>) -> Result<()> {
    let unknown = |key: &&str| !KEYS.contains(key);
    let Some(key) = table.present().into_iter().find(unknown) else {
        return Ok(());
    };
    let near = nearest(key, KEYS.iter().copied()).unwrap_or_default();
    let mut diagnostic = table
        .refuse(key, "is no key of a formula", list(KEYS.iter().copied()))
        .with_hint(format!(
            "the nearest valid key is `{near}`; parameters stand in [effect.parameters]"
        ));
    diagnostic.fault = Fault::UnknownKey;
    Err(Box::new(diagnostic))
}

fn name<'a>(table: &Table<'a>) -> Result<&'a str> {
    let what = "the name in `fit.free` and in results";
    let Some(name) = table.name("name", what)? else {
        return Err(Box::new(
            table
                .missing("name", "a text, the formula's name")
                .with_hint(what),
        ));
    };
    let reserved = ["wear", KIND, super::learned::KIND].contains(&name) || find(name).is_ok();
    if reserved || name.contains(['.', '+', ',', '"', ':']) {
        return Err(Box::new(
            table
                .refuse(
                    "name",
                    "cannot be a formula's name",
                    "a text without . + , : and \", other than \"wear\", \"formula\", \"learned\" and the catalogue's effects",
                )
                .with_hint(what),
        ));
    }
    Ok(name)
}

/// The one hook that the entry states.
fn hook(table: &Table<'_>) -> Result<Hook> {
    let stated: Vec<Hook> = HOOKS
        .into_iter()
        .filter(|hook| table.has(hook.name()))
        .collect();
    let allowed = format!("one of {}", list(HOOKS.map(Hook::name)));
    match stated[..] {
        [only] => Ok(only),
        [] => Err(Box::new(table.missing("wear_factor", &allowed))),
        [_, second, ..] => Err(Box::new(table.refuse(
            second.name(),
            "is a second expression",
            allowed,
        ))),
    }
}

/// The message about a formula, at the place inside the expression or at the parameter.
fn fault(
    table: &Table<'_>,
    parameters: Option<&Table<'_>>,
    hook: Hook,
    error: &FormulaError,
) -> Box<Diagnostic> {
    let base = |message: &str| {
        let mut diagnostic = table.refuse(hook.name(), "", "");
        diagnostic.message = format!("{}: {message}", diagnostic.key);
        diagnostic
    };
    match error {
        FormulaError::Expression(inside) => {
            let mut diagnostic = base(&inside.message);
            diagnostic.found = String::new();
            if let Some(span) = &diagnostic.span {
                let raw = table.raw(span);
                let place = inside_text(raw, inside.column, inside.length);
                diagnostic.span = Some(span.start + place.start..span.start + place.end);
            }
            let variables = VARIABLES.iter().filter(|v| v.available(hook));
            let variables = list(variables.map(|variable| variable.name));
            let functions = list(FUNCTIONS.iter().map(|(name, ..)| *name));
            Box::new(
                diagnostic
                    .with_hint(format!("variables of {}: {variables}", hook.name()))
                    .with_hint(format!("functions: {functions}; constant: pi")),
            )
        }
        FormulaError::Name { name, .. } | FormulaError::Unused { name } => {
            let mut diagnostic = base(&error.to_string());
            diagnostic.found = format!("`{name}`");
            if let Some(span) = parameters.and_then(|inner| inner.key_span(name)) {
                diagnostic.span = Some(span);
            }
            diagnostic.key = format!("effect.parameters.{name}");
            Box::new(diagnostic)
        }
        FormulaError::Hook { .. } | FormulaError::TooMany { .. } => {
            Box::new(base(&error.to_string()))
        }
    }
}

/// Where characters `column .. column + length` of a TOML text stand in `raw`, the text as written with its quotes.
fn inside_text(raw: &str, column: usize, length: usize) -> Range<usize> {
    let quote = if raw.starts_with("\"\"\"") || raw.starts_with("'''") {
        3
    } else {
        1
    };
    let literal = raw.starts_with('\'');
    let end = raw.len().saturating_sub(quote);
    let mut at = quote.min(end);
    if quote == 3 {
        // the first line break is not part of the text
        at += ["\r\n", "\n"]
            .into_iter()
            .find(|ending| raw[at..end].starts_with(ending))
            .map_or(0, str::len);
    }
    // places[n]: where character n begins
    let mut places = Vec::new();
    while at < end {
        let rest = &raw[at..end];
        if !literal && rest.starts_with('\\') {
            let continued = rest[1..].trim_start_matches([' ', '\t']);
            if continued.starts_with(['\n', '\r']) {
                at += rest.len() - continued.trim_start().len();
                continue;
            }
            places.push(at);
            let digits = match rest.as_bytes().get(1) {
                Some(b'x') => 2,
                Some(b'u') => 4,
                Some(b'U') => 8,
                _ => 0,
            };
            at = (at + 2 + digits).min(end);
        } else {
            places.push(at);
            at += rest.chars().next().map_or(1, char::len_utf8);
        }
    }
    let place = |n: usize| places.get(n).copied().unwrap_or(end);
    let start = place(column);
    start..place(column + length).max(start + 1).min(raw.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_inside_a_text_follow_its_escapes() {
        let cases = [
            (r#""1 + ab""#, 4, 2, "ab"),
            (r#"'1 + ab'"#, 4, 2, "ab"),
            (r#""\t1 + \u0061b""#, 5, 2, r"\u0061b"),
            ("\"\"\"\n1 + ab\"\"\"", 4, 2, "ab"),
            ("\"\"\"\r\n1 \\\r\n   + ab\"\"\"", 4, 2, "ab"),
            (r#""µ + ab""#, 4, 2, "ab"),
            (r#""1 +""#, 3, 1, "\""),
        ];
        for (raw, column, length, expected) in cases {
            assert_eq!(&raw[inside_text(raw, column, length)], expected, "{raw}");
        }
    }
}
