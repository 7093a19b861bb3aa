//! Rows that stand apart from their neighbours along a curve: dust, burrs, slipped decimal points.
//!
//! One row after the other, the one that stands farthest apart first, until none does (its own value would draw the others along). A place
//! where several curves of a member do alike is a feature of the flank and no outlier, and neither is a value between those beside it: the edge of
//! what is worn.

use std::collections::BTreeMap;

use super::neighbours::{around, curves, points};
use super::quantity::Quantity;
use super::{Dataset, Observation};
use crate::numeric::median;

/// Standard deviations from what the neighbours say from which a row stands apart: one of 150 000 Gaussian ones.
const APART: f64 = 4.5;
/// Standard deviations from which another curve does alike at the same place, and share of the curves there that must.
const ALIKE: f64 = 2.5;
const FEATURE: f64 = 0.3;
/// A curve's own scatter counts for so much of it beside that of all curves: of few points it is uncertain.
const OWN: f64 = 0.8;
/// Least scatter over the stated one that is believed: values without noise have corners that no sigma stands for.
const LEAST: f64 = 0.5;
/// Median of |x| of a standard normal number.
const MEDIAN: f64 = 0.674_490;

/// A row that stands apart from its neighbours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outlier {
    /// Its place in [`Dataset::observations`].
    pub row: usize,
    /// The value that its neighbours lead one to expect.
    pub expected: f64,
    /// Standard deviations that it stands apart.
    pub apart: f64,
    /// σ as the file states it.
    pub stated_sigma: f64,
}

/// What is known of one curve.
struct Curve {
    rows: Vec<usize>,
    points: Vec<[f64; 3]>,
    passed_over: Vec<bool>,
    /// Scatter of the points about their neighbours over the stated one.
    scale: f64,
}

impl Curve {
    /// Standard deviations that a point stands apart, and the value expected.
    fn apart(&self, at: usize) -> Option<(f64, f64)> {
        let found = around(&self.points, at, &self.passed_over)?;
        let apart = (self.points[at][1] - found.expected) / (found.sigma * self.scale);
        Some((apart, found.expected))
    }

    /// How far all points stand apart, without sign.
    fn all_apart(&self) -> Vec<f64> {
        let each = (0..self.points.len()).filter_map(|at| self.apart(at));
        each.map(|(apart, _)| apart.abs()).collect()
    }

    /// Whether a point's value lies between those of its neighbours, one on each side or two at an end, or outside by no more than noise: then the
    /// curve bends there, as at the edge of what is worn, and what its neighbours lead one to expect is not to be expected.
    fn is_a_corner(&self, at: usize) -> bool {
        let asked = |i: &usize| !self.passed_over[*i];
        let before: Vec<usize> = (0..at).rev().filter(asked).take(2).collect();
        let after: Vec<usize> = (at + 1..self.points.len()).filter(asked).take(2).collect();
        let near = match (&before[..], &after[..]) {
            ([left, ..], [right, ..]) => vec![*left, *right],
            (one, []) | ([], one) => one.to_vec(),
        };
        let values = near.iter().map(|&i| self.points[i][1]);
        let (low, high) = (
            values.clone().fold(f64::INFINITY, f64::min),
            values.fold(f64::NEG_INFINITY, f64::max),
        );
        let [_, value, sigma] = self.points[at];
        let outside = (low - value).max(value - high).max(0.0);
        outside < ALIKE * sigma * self.scale
    }

    /// Standard deviations at the point nearest to a place, if the curve has one within half the distance of its points.
    fn near(&self, place: f64) -> Option<f64> {
        let distance = |at: &usize| (self.points[*at][0] - place).abs();
        let nearest = (0..self.points.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        let [first, last] = [self.points.first()?[0], self.points.last()?[0]];
        let reach = 0.75 * (last - first) / (self.points.len() - 1) as f64;
        (distance(&nearest) <= reach).then(|| self.apart(nearest).map(|found| found.0))?
    }
}

/// Standard deviation of numbers about 0 by the median of their magnitudes, in which a few large ones do not show.
fn scatter(magnitudes: Vec<f64>) -> f64 {
    median(magnitudes).map_or(1.0, |middle| (middle / MEDIAN).max(f64::MIN_POSITIVE))
}

/// All rows that stand apart from their neighbours.
pub fn outliers(observations: &[Observation]) -> Vec<Outlier> {
    let rows: Vec<&Observation> = observations.iter().collect();
    let mut all: Vec<Curve> = (curves(&rows).into_iter())
        .map(|own| {
            let points = points(&rows, &own);
            let mut curve = Curve {
                passed_over: vec![false; points.len()],
                rows: own,
                points,
                scale: 1.0,
            };
            let apart = curve.all_apart();
            curve.scale = scatter(apart);
            curve
        })
        .collect();
    // σ may be misjudged, by all curves of a quantity alike
    let mut together: BTreeMap<Quantity, Vec<f64>> = BTreeMap::new();
    for curve in &all {
        let quantity = rows[curve.rows[0]].quantity;
        let apart = curve.all_apart().into_iter().map(|z| z * curve.scale);
        together.entry(quantity).or_default().extend(apart);
    }
    let together: BTreeMap<Quantity, f64> = (together.into_iter())
        .map(|(quantity, apart)| (quantity, scatter(apart)))
        .collect();
    for curve in &mut all {
        let common = together[&rows[curve.rows[0]].quantity];
        curve.scale = common.max(OWN * curve.scale).max(LEAST);
    }
    let mut found = Vec::new();
    for number in 0..all.len() {
        let mut kept = vec![false; all[number].points.len()];
        loop {
            let curve = &all[number];
            let worst = (0..curve.points.len())
                .filter(|&at| !curve.passed_over[at] && !kept[at])
                .filter_map(|at| {
                    curve
                        .apart(at)
                        .map(|(apart, expected)| (at, apart, expected))
                })
                .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
            let Some((at, apart, expected)) = worst.filter(|worst| worst.1.abs() > APART) else {
                break;
            };
            let o = rows[curve.rows[at]];
            let alike = |other: &Curve| {
                let like = rows[other.rows[0]];
                ((like.member, like.quantity) == (o.member, o.quantity))
                    .then(|| other.near(curve.points[at][0]))?
            };
            let others: Vec<f64> = (all.iter().enumerate())
                .filter(|(i, _)| *i != number)
                .filter_map(|(_, other)| alike(other))
                .collect();
            let same = others
                .iter()
                .filter(|z| **z * apart.signum() > ALIKE)
                .count();
            let is_shared = same > 0 && same as f64 >= FEATURE * others.len() as f64;
            if is_shared || curve.is_a_corner(at) {
                kept[at] = true;
                continue;
            }
            found.push(Outlier {
                row: curve.rows[at],
                expected,
                apart: apart.abs(),
                stated_sigma: o.sigma,
            });
            all[number].passed_over[at] = true;
        }
    }
    found.sort_by_key(|outlier| outlier.row);
    found
}

impl Dataset {
    /// How many rows stand apart from their neighbours, and where they are listed, in a sentence; None where none does.
    pub fn outliers_counted(&self) -> Option<String> {
        let rows = self.rows_apart()?;
        Some(format!("{rows}; gearwear check lists them"))
    }

    /// How many rows stand apart from their neighbours, and how they count.
    fn rows_apart(&self) -> Option<String> {
        let first = self.outliers.first()?;
        let rows = match self.outliers.len() {
            1 => "1 row stands".to_owned(),
            n => format!("{n} rows stand"),
        };
        let counted = if self.observations[first.row].sigma > first.stated_sigma {
            "counted with a sigma as large as they stand apart"
        } else {
            "counted as they are: correct them, or state [noise] outliers = \"robust\""
        };
        Some(format!(
            "{rows} apart from the neighbours along the trace, {counted}"
        ))
    }

    /// All rows that stand apart from their neighbours, in a sentence; None where none does.
    pub fn outliers_in_words(&self) -> Option<String> {
        let rows = self.rows_apart()?;
        let one = |outlier: &Outlier| {
            let o = &self.observations[outlier.row];
            let (value, expected) = (o.value, outlier.expected);
            let unit = o.quantity.shown_unit();
            format!(
                "{} ({value:.4} {unit} where {expected:.4} is expected, {:.0} standard deviations)",
                self.place(o),
                outlier.apart
            )
        };
        let all: Vec<String> = self.outliers.iter().map(one).collect();
        Some(format!("{rows}: {}", all.join(", ")))
    }

    /// Finds the rows that stand apart from their neighbours; if `robust`, they count with a σ as large as they stand apart.
    pub(crate) fn find_outliers(&mut self, robust: bool) {
        self.outliers = outliers(&self.observations);
        if robust {
            for outlier in &self.outliers {
                let o = &mut self.observations[outlier.row];
                o.sigma = o.sigma.hypot(o.value - outlier.expected);
            }
        }
    }
}
