//! Single rows that make most of what a cell misses: its root mean square is then no picture of the region.

use std::collections::{BTreeMap, BTreeSet};

use super::residual_statistics::{CellKey, FittedRow};
use crate::learn::fitting::region::FlankRegions;
use crate::measure::Dataset;

/// Least rows of a cell of which one may be called alone.
const ROWS: usize = 3;
/// Share of a cell's χ² from which one row makes most of it.
const MOST: f64 = 0.5;

/// Part of a row's residual that a neighbour of it on its curve may have: a misfit of the model goes on from place to place.
const NEIGHBOUR: f64 = 0.25;

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
    let goes_on = lines_that_go_on(rows);
    for (o, row) in rows {
        let key = (o.test, o.member, o.quantity, map.region(o), map.interval(o));
        let own = cells.entry(key).or_default();
        own.push((o.line, row.standardised));
    }
    let lone = cells.into_iter().filter_map(|(key, own)| {
        let (line, standardised) = alone(&own).filter(|(line, _)| !goes_on.contains(line))?;
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

/// The lines whose residuals a neighbour on their curve follows.
fn lines_that_go_on(rows: &[FittedRow<'_>]) -> BTreeSet<usize> {
    let mut curves: BTreeMap<_, Vec<(f64, usize, f64)>> = BTreeMap::new();
    for (o, row) in rows {
        if let Some(place) = o.position {
            let key = (o.test, o.member, o.quantity, o.cycles.to_bits(), o.trace);
            let own = curves.entry(key).or_default();
            own.push((place, o.line, row.standardised));
        }
    }
    let mut found = BTreeSet::new();
    for curve in curves.values_mut() {
        curve.sort_by(|a, b| a.0.total_cmp(&b.0));
        for pair in curve.windows(2) {
            let [(_, one, a), (_, other, b)] = [pair[0], pair[1]];
            if a * b > 0.0 {
                found.extend((b.abs() > NEIGHBOUR * a.abs()).then_some(one));
                found.extend((a.abs() > NEIGHBOUR * b.abs()).then_some(other));
            }
        }
    }
    found
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
    use crate::study::Study;

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

    /// Two curves of which the first cell's largest residual falls off from place to place, as a relief that the model lacks, and the second's does not.
    #[test]
    fn a_residual_that_goes_on_along_its_curve_is_of_no_lone_row() {
        let study = include_str!("../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let mut text = "test,member,cycles,quantity,position,value,sigma,trace\n".to_owned();
        for trace in ["a", "b"] {
            for place in 0..5 {
                let place = 27.0 + 0.1 * f64::from(place);
                text += &format!("A,pinion,200000,wear_depth,{place},3,1,{trace}\n");
            }
        }
        let data = Dataset::parse(&text, "m.csv", &study.known()).unwrap();
        let mut fits = super::super::sanity::fits_of(&[3.0; 10]);
        let off = [22.3, 13.0, 6.0, 2.0, -1.0, 22.3, 2.0, -1.0, 0.5, 1.0];
        for (fit, standardised) in fits.iter_mut().zip(off) {
            fit.standardised = standardised;
        }
        let rows: Vec<FittedRow<'_>> = data.observations.iter().zip(&fits).collect();
        let goes_on = lines_that_go_on(&rows);
        assert!(goes_on.contains(&2) && !goes_on.contains(&7), "{goes_on:?}");
    }
}
