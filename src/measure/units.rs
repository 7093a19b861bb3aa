//! Units that only a file as a whole betrays.

use super::header::Columns;
use super::observation::Observation;
use super::quantity::Quantity;
use super::table::field_spans;
use crate::source_text::{Diagnostic, Fault, Source};

/// Sigmas are this much smaller than the values' limit where a unit slip is suspected: 1 nm against 50 nm of wear.
const SIGMA_PART: f64 = 0.02;

/// Refuses a file whose values of one quantity are all too small for its unit, noise included.
pub(super) fn check(
    source: &Source,
    columns: &Columns,
    observations: &[Observation],
) -> Result<(), Box<Diagnostic>> {
    for quantity in Quantity::ALL {
        let limits = quantity.magnitude(f64::INFINITY);
        let own = || observations.iter().filter(|o| o.quantity == quantity);
        let small =
            |o: &Observation| o.value.abs() < limits.below && o.sigma < SIGMA_PART * limits.below;
        // values of exactly 0 say nothing of their unit
        if let Some(largest) = own().max_by(|a, b| a.value.abs().total_cmp(&b.value.abs()))
            && largest.value != 0.0
            && own().all(small)
        {
            let (name, unit) = (quantity.name(), quantity.unit());
            let span = value_span(source, columns, largest.line);
            let written = source.text[span.clone()].to_owned();
            return Err(Box::new(
                Diagnostic::new(
                    Fault::BadValue,
                    "value",
                    format!("every {name} is smaller than {} {unit}", limits.below),
                )
                .with_values(
                    format!("`{written}`, the largest"),
                    format!("{name} in {unit}"),
                )
                .with_hint(format!("this looks like {}", limits.smaller))
                .with_span(span),
            ));
        }
    }
    Ok(())
}

/// Where the value stands in the row that begins on `line`.
fn value_span(source: &Source, columns: &Columns, line: usize) -> std::ops::Range<usize> {
    let start: usize = source
        .text
        .split_inclusive('\n')
        .take(line - 1)
        .map(str::len)
        .sum();
    let row = source.text[start..].lines().next().unwrap_or_default();
    let spans = field_spans(&source.text, start..start + row.len());
    let column = columns.of("value").unwrap_or_default();
    spans
        .get(column)
        .cloned()
        .unwrap_or(start..start + row.len())
}
