//! Units that only a file as a whole betrays.

use super::header::Columns;
use super::observation::Observation;
use super::quantity::Quantity;
use super::table::field_spans;
use crate::source_text::{Diagnostic, Fault, Source};

/// Sigmas are this much smaller than the values' limit where a unit slip is suspected: 1 nm against 50 nm of wear.
const SIGMA_PART: f64 = 0.02;

/// So many values of a quantity, all below this part of their sigma, are no noise of that size: one in 2500 would be at 8.
const FEWEST: usize = 8;
const NOISE_PART: f64 = 0.5;

/// Refuses a file whose values of one quantity are all too small for its unit, or for their sigmas.
pub(super) fn check(
    source: &Source,
    (columns, separator): (&Columns, u8),
    observations: &[Observation],
) -> Result<(), Box<Diagnostic>> {
    for quantity in Quantity::ALL {
        let limits = quantity.magnitude(f64::INFINITY);
        let own = || observations.iter().filter(|o| o.quantity == quantity);
        let small =
            |o: &Observation| o.value.abs() < limits.below && o.sigma < SIGMA_PART * limits.below;
        // values of exactly 0 say nothing of their unit
        let Some(largest) = own().max_by(|a, b| a.value.abs().total_cmp(&b.value.abs())) else {
            continue;
        };
        if largest.value == 0.0 {
            continue;
        }
        let (name, unit) = (quantity.name(), quantity.shown_unit());
        let silent = |o: &Observation| o.value.abs() < NOISE_PART * o.sigma;
        let (message, found, allowed, hint) = if own().count() >= FEWEST && own().all(silent) {
            let hint = match limits.smaller {
                "" => "the sigmas are far too large, or the values in a larger unit".to_owned(),
                smaller => format!("this looks like {smaller} beside sigmas in {unit}"),
            };
            let message =
                "is smaller than half its sigma: nothing was measured, or these are not its sigmas"
                    .to_owned();
            (
                message,
                format!(", with a sigma of {}", largest.sigma),
                format!("{name} and sigma in {unit}"),
                hint,
            )
        } else if own().all(small) {
            let message = format!("is smaller than {} {unit}", limits.below);
            (
                message,
                String::new(),
                format!("{name} in {unit}"),
                format!("this looks like {}", limits.smaller),
            )
        } else {
            continue;
        };
        let span = value_span(source, columns, separator, largest.line);
        let written = &source.text[span.clone()];
        let message = format!("every {name} {message}");
        return Err(Box::new(
            Diagnostic::new(Fault::BadValue, "value", message)
                .with_values(format!("`{written}`, the largest{found}"), allowed)
                .with_hint(hint)
                .with_span(span),
        ));
    }
    Ok(())
}

/// Where the value stands in the row that begins on `line`.
fn value_span(
    source: &Source,
    columns: &Columns,
    separator: u8,
    line: usize,
) -> std::ops::Range<usize> {
    let start: usize = source
        .text
        .split_inclusive('\n')
        .take(line - 1)
        .map(str::len)
        .sum();
    let row = source.text[start..].lines().next().unwrap_or_default();
    let spans = field_spans(&source.text, start..start + row.len(), separator);
    let column = columns.of("value").unwrap_or_default();
    spans
        .get(column)
        .cloned()
        .unwrap_or(start..start + row.len())
}
