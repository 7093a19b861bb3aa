//! Single rows that make most of what a cell misses: its root mean square is then no picture of the region.

use std::collections::BTreeMap;

use super::residual_statistics::{CellKey, FittedRow};
use crate::learn::fitting::region::FlankRegions;
use crate::measure::Dataset;

/// Least rows of a cell of which one may be called alone.
const ROWS: usize = 3;
/// Share of a cell's χ² from which one row makes most of it.
const MOST: f64 = 0.5;

/// One row that makes most of its cell's χ².
#[derive(Debug, Clone, PartialEq)]
pub(super) struct LoneRow {
    /// File and line.
    pub(super) place: String,
    /// Model minus measured in standard deviations.
    pub(super) standardised: f64,
}

impl LoneRow {
    /// In words, after a root mean square.
    pub(super) fn in_words(&self) -> String {
        let sign = if self.standardised < 0.0 { "−" } else { "+" };
        format!(
            "one row alone, {} with {sign}{:.1} sigma, makes most of it",
            self.place,
            self.standardised.abs()
        )
    }
}

/// The cells of which one row makes most.
pub(super) fn lone_rows(
    data: &Dataset,
    rows: &[FittedRow<'_>],
    map: &FlankRegions,
) -> BTreeMap<CellKey, LoneRow> {
    let mut cells: BTreeMap<CellKey, Vec<(usize, f64)>> = BTreeMap::new();
    for (o, row) in rows {
        let key = (o.test, o.member, o.quantity, map.region(o), map.interval(o));
        let own = cells.entry(key).or_default();
        own.push((o.line, row.standardised));
    }
    let lone = cells.into_iter().filter_map(|(key, own)| {
        let (line, standardised) = alone(&own)?;
        let place = format!("{}:{line}", data.name);
        Some((
            key,
            LoneRow {
                place,
                standardised,
            },
        ))
    });
    lone.collect()
}

/// Of lines with their standardised residuals the one that makes most of χ².
fn alone(rows: &[(usize, f64)]) -> Option<(usize, f64)> {
    let all: f64 = rows.iter().map(|(_, z)| z * z).sum();
    let largest = (rows.iter()).max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
    (rows.len() >= ROWS && largest.1 * largest.1 > MOST * all).then_some(*largest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_is_alone_where_it_makes_more_than_half() {
        let rows = [(34, 1.0), (35, 23.8), (36, -2.0)];
        assert_eq!(alone(&rows), Some((35, 23.8)));
        assert_eq!(alone(&[(34, 10.0), (35, 11.0), (36, -9.0)]), None);
        assert_eq!(alone(&rows[1..]), None);
        assert_eq!(alone(&[]), None);
        let row = LoneRow {
            place: "m.csv:35".to_owned(),
            standardised: 23.8,
        };
        assert_eq!(
            row.in_words(),
            "one row alone, m.csv:35 with +23.8 sigma, makes most of it"
        );
    }
}
