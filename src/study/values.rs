//! Values of one table's keys: numbers with their bounds, counts, flags, texts, choices.

use std::ops::{Range, RangeInclusive};

use toml::Spanned;
use toml::de::DeValue;

use super::quantity::{ANY, Quantity, Short};
use super::reader::{Result, Table, shown};
use super::units::{self, UnitFault};
use crate::source_text::{Diagnostic, Fault, is_misspelt, nearest};

/// A text and where it stands.
type Placed<'a> = (&'a str, Range<usize>);

/// A number that is written as one.
pub(super) fn plain_number(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Float(float) => float.as_str().parse().ok(),
        DeValue::Integer(integer) => i128::from_str_radix(integer.as_str(), integer.radix())
            .ok()
            .map(|i| i as f64),
        _ => None,
    }
}

/// How a number with a decimal comma is written.
fn point_hint(value: &DeValue<'_>, quantity: &Quantity) -> String {
    let says = "decimals are written with a point";
    let DeValue::String(text) = value else {
        return says.to_owned();
    };
    let point = text.trim().replace(',', ".");
    if point.parse::<f64>().is_ok() {
        format!("{says}: {point}, without quotes")
    } else if units::value(&point, quantity).is_ok() {
        format!("{says}: \"{point}\"")
    } else {
        says.to_owned()
    }
}

impl<'a> Table<'a> {
    /// A number that may be absent.
    pub(super) fn number(&self, key: &str, quantity: &Quantity) -> Result<Option<f64>> {
        let Some((value, span)) = self.get(key) else {
            return Ok(None);
        };
        let number = match value {
            DeValue::Float(_) | DeValue::Integer(_) => plain_number(value),
            DeValue::String(text) if text.trim().parse::<f64>().is_err() => {
                match units::value(text, quantity) {
                    Ok(number) => Some(number),
                    Err(fault) => return Err(self.wrong_unit(key, value, span, quantity, fault)),
                }
            }
            _ => {
                return Err(self
                    .wrong_type(key, value, span, &format!("a number, {quantity}"))
                    .into());
            }
        };
        match number {
            Some(number) if quantity.allows(number) => Ok(Some(number)),
            _ => {
                let number = number.unwrap_or(f64::NAN);
                let unit = if quantity.unit == "-" {
                    String::new()
                } else {
                    format!(" {}", quantity.unit)
                };
                let written = self.written(&span);
                let with_unit = matches!(value, DeValue::String(_));
                let (unit, found) = if with_unit {
                    (String::new(), format!("{written}, {}{unit}", Short(number)))
                } else {
                    (unit, written.clone())
                };
                let why = if number.is_finite() {
                    "is out of range"
                } else {
                    "is not a finite number"
                };
                let message = format!("{} = {written}{unit} {why}", shown(&self.path_of(key)));
                Err(
                    Diagnostic::new(Fault::BadValue, shown(&self.path_of(key)), message)
                        .with_values(found, quantity.to_string())
                        .with_hint(match quantity.slip(number) {
                            Some(slip) if !with_unit => slip,
                            _ => "",
                        })
                        .with_hint(quantity.reason)
                        .with_span(span)
                        .into(),
                )
            }
        }
    }

    /// Refuses a text that is no number with a fitting unit.
    fn wrong_unit(
        &self,
        key: &str,
        value: &DeValue<'_>,
        span: Range<usize>,
        quantity: &Quantity,
        fault: UnitFault,
    ) -> Box<Diagnostic> {
        let path = shown(&self.path_of(key));
        let written = self.written(&span);
        let units: Vec<&str> = units::known(quantity).collect();
        let allowed = match units[..] {
            [] => format!("a number without unit, {quantity}"),
            [only] => format!("{quantity}; a plain number, or a text with the unit {only}"),
            _ => format!(
                "{quantity}; a plain number, or a text with one of the units {}",
                units.join(", ")
            ),
        };
        let (message, found, hint) = match fault {
            UnitFault::NoUnit => {
                return self
                    .wrong_type(key, value, span, &format!("a number, {quantity}"))
                    .into();
            }
            UnitFault::Marks { mark: ',' } => (
                format!("{path} = {written} has a decimal comma"),
                written,
                point_hint(value, quantity),
            ),
            UnitFault::Marks { .. } => (
                format!("{path} = {written} has several decimal points"),
                written,
                "marks between thousands are not read: write 1000000, not 1.000.000".to_owned(),
            ),
            UnitFault::Foreign { says, hint } => (
                format!("{path} = {written} {says}"),
                written,
                hint.to_owned(),
            ),
            UnitFault::Unknown {
                written: unit,
                near,
            } => (
                format!("{path} = {written} has a unit that is not known"),
                format!("the unit `{unit}`"),
                if near.is_empty() {
                    near
                } else {
                    format!("the nearest unit is `{near}`")
                },
            ),
            UnitFault::Other {
                written: unit,
                says,
            } => (
                format!("{path} = {written} {says}"),
                format!("the unit `{unit}`"),
                String::new(),
            ),
        };
        Diagnostic::new(Fault::BadValue, path, message)
            .with_values(found, allowed)
            .with_hint(hint)
            .with_span(span)
            .into()
    }

    /// Any number but NaN that must be there; `inf` is one. `unit` is what a text with a unit is converted to.
    pub(super) fn required_any(&self, key: &str, allowed: &str, unit: &'static str) -> Result<f64> {
        let Some((value, span)) = self.get(key) else {
            return Err(self.missing(key, allowed).into());
        };
        match value {
            DeValue::Float(float) if float.as_str().parse().is_ok_and(f64::is_infinite) => {
                // a power of ten too many is no infinity
                let word = float.as_str().trim_start_matches(['+', '-']);
                if word != "inf" {
                    return Err(self
                        .refuse(key, "is too large", allowed)
                        .with_span(span)
                        .into());
                }
                Ok(if float.as_str().starts_with('-') {
                    f64::NEG_INFINITY
                } else {
                    f64::INFINITY
                })
            }
            _ => self.required_number(key, &Quantity { unit, ..ANY }),
        }
    }

    /// A number that must be there.
    pub(super) fn required_number(&self, key: &str, quantity: &Quantity) -> Result<f64> {
        match self.number(key, quantity)? {
            Some(number) => Ok(number),
            None => Err(self
                .missing(key, &format!("a number, {quantity}"))
                .with_hint(quantity.reason)
                .into()),
        }
    }

    /// A whole number within `range` that may be absent.
    pub(super) fn count(
        &self,
        key: &str,
        range: RangeInclusive<usize>,
        reason: &str,
    ) -> Result<Option<usize>> {
        let Some((value, span)) = self.get(key) else {
            return Ok(None);
        };
        let allowed = format!("a whole number, {} to {}", range.start(), range.end());
        let DeValue::Integer(integer) = value else {
            let hint = match value {
                DeValue::Float(_) => "write it without a decimal point",
                _ => "",
            };
            return Err(self
                .wrong_type(key, value, span, &allowed)
                .with_hint(hint)
                .into());
        };
        match usize::from_str_radix(integer.as_str(), integer.radix()) {
            Ok(count) if range.contains(&count) => Ok(Some(count)),
            _ => Err(self
                .refuse(key, "is out of range", allowed)
                .with_hint(reason)
                .into()),
        }
    }

    /// A whole number that must be there.
    pub(super) fn required_count(
        &self,
        key: &str,
        range: RangeInclusive<usize>,
        reason: &str,
    ) -> Result<usize> {
        let allowed = format!("a whole number, {} to {}", range.start(), range.end());
        self.count(key, range, reason)?
            .ok_or_else(|| self.missing(key, &allowed).into())
    }

    /// `true` or `false`, if present.
    pub(super) fn flag(&self, key: &str) -> Result<Option<bool>> {
        match self.get(key) {
            None => Ok(None),
            Some((DeValue::Boolean(flag), _)) => Ok(Some(*flag)),
            Some((value, span)) => Err(self.wrong_type(key, value, span, "true or false").into()),
        }
    }

    /// A list of numbers, if present.
    pub(super) fn numbers(&self, key: &str) -> Result<Option<Vec<f64>>> {
        const WANTED: &str = "a list of numbers, [...]";
        let Some((value, span)) = self.get(key) else {
            return Ok(None);
        };
        let DeValue::Array(items) = value else {
            return Err(self.wrong_type(key, value, span, WANTED).into());
        };
        let read = |item: &toml::Spanned<DeValue<'_>>| match plain_number(item.get_ref()) {
            Some(number) if number.is_finite() => Ok(number),
            Some(number) => {
                let says = format!("holds {number}");
                Err(Box::from(self.refuse(key, &says, "finite numbers")))
            }
            None => Err(Box::from(self.wrong_type(
                key,
                item.get_ref(),
                item.span(),
                WANTED,
            ))),
        };
        items.iter().map(read).collect::<Result<_>>().map(Some)
    }

    /// A text, if present.
    pub(super) fn text(&self, key: &str) -> Result<Option<&'a str>> {
        match self.get(key) {
            None => Ok(None),
            Some((DeValue::String(text), _)) => Ok(Some(text.as_ref())),
            Some((value, span)) => {
                Err(self.wrong_type(key, value, span, "a text in quotes").into())
            }
        }
    }

    /// A text that is not blank, if present.
    pub(super) fn name(&self, key: &str, reason: &str) -> Result<Option<&'a str>> {
        match self.text(key)? {
            Some(text)
                if text.trim().is_empty()
                    || text.chars().any(char::is_control)
                    || text.trim() != text =>
            {
                Err(self
                    .refuse(
                        key,
                        "is not usable",
                        "a text that is not blank, without line breaks and outer spaces",
                    )
                    .with_hint(reason)
                    .into())
            }
            other => Ok(other),
        }
    }

    /// One of a few words, if present.
    pub(super) fn choice<T: Copy>(&self, key: &str, choices: &[(&str, T)]) -> Result<Option<T>> {
        let Some(text) = self.text(key)? else {
            return Ok(None);
        };
        if let Some((_, value)) = choices.iter().find(|(word, _)| *word == text) {
            return Ok(Some(*value));
        }
        let words = choices.iter().map(|(word, _)| *word);
        // `validation` has more letters of `fit` than of `holdout`, and means the other
        let hint = nearest(text, words.clone())
            .filter(|near| is_misspelt(text, near))
            .map_or(String::new(), |near| format!("the nearest is \"{near}\""));
        let quoted: Vec<String> = words.map(|word| format!("\"{word}\"")).collect();
        Err(self
            .refuse(key, "is not known", quoted.join(" or "))
            .with_hint(hint)
            .into())
    }

    /// A list of texts with their places, if present.
    pub(super) fn texts(&self, key: &str) -> Result<Option<Vec<Placed<'a>>>> {
        let Some((value, span)) = self.get(key) else {
            return Ok(None);
        };
        let DeValue::Array(items) = value else {
            return Err(self
                .wrong_type(key, value, span, "a list of texts, [\"...\"]")
                .into());
        };
        let read = |item: &'a Spanned<DeValue<'a>>| match item.get_ref() {
            DeValue::String(text) => Ok((text.as_ref(), item.span())),
            other => Err(self
                .wrong_type(key, other, item.span(), "a text in quotes")
                .into()),
        };
        let texts = items.iter().map(read).collect::<Result<Vec<_>>>()?;
        for (n, (_, span)) in texts.iter().enumerate() {
            self.place(&format!("{key}[{n}]"), span.clone());
        }
        Ok(Some(texts))
    }
}
