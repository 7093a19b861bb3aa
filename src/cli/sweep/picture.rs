//! The picture of a sweep: curves over the first axis of a grid; of other designs the main effect of every key.

use super::design::{Design, Kind};
use super::figures::{Column, Outputs};
use super::grid::{self, Axis};
use super::points::{Point, Result};
use super::tables::with_unit;
use crate::numeric::written::significant;
use crate::report::OutputError;
use crate::report::plots::sweep_picture;

/// What the picture's panels show.
type Shown = Vec<Option<f64>>;
/// A curve with its label.
type Curve = (String, Vec<(f64, Shown)>);

/// Parts of a key's range over which a main effect is averaged, at most.
const PARTS: usize = 8;
/// Points a part holds at least.
const POINTS_A_PART: usize = 4;

/// The picture as SVG; none where there is nothing to draw.
///
/// # Errors
/// [`OutputError`] if a panel cannot be drawn.
pub(super) fn picture(
    title: &str,
    design: &Design,
    outputs: &Outputs,
    points: &[Point],
    results: &[Result],
) -> std::result::Result<Option<String>, OutputError> {
    let columns = outputs.shown();
    let panels: Vec<(&str, &str)> = columns.iter().map(|c| (c.title, c.unit)).collect();
    match &design.kind {
        Kind::Grid(axes) => {
            let curves = over_first(axes, &columns, points, results);
            sweep_picture(title, &with_unit(&axes[0].key), &panels, &curves)
        }
        Kind::Filling(..) | Kind::Table => {
            let curves: Vec<Curve> = (0..design.keys.len())
                .map(|key| {
                    (
                        named(design, key),
                        main_effect(design, key, &columns, results),
                    )
                })
                .collect();
            let over = "place in the key's range; means over all other keys";
            sweep_picture(title, over, &panels, &curves)
        }
    }
}

/// A key with the least and the largest of its numbers, between which the picture tells places.
fn named(design: &Design, key: usize) -> String {
    let name = &design.keys[key];
    let numbers = design
        .rows
        .iter()
        .map(|row| grid::leading_number(&row[key]));
    let Some(numbers) = numbers.collect::<Option<Vec<f64>>>() else {
        return name.clone();
    };
    let least = numbers.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = numbers.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let unit = match crate::study::unit_of(name) {
        None | Some("" | "-" | "1") => String::new(),
        Some(unit) => format!(" {unit}"),
    };
    format!(
        "{name}: {} to {}{unit}",
        significant(least, 3),
        significant(largest, 3)
    )
}

fn shown(result: &Result, columns: &[&Column]) -> Option<Shown> {
    let figures = result.as_ref().ok()?;
    Some(columns.iter().map(|column| figures.value(column)).collect())
}

/// Means over equal parts of a key's range, whatever the others are.
fn main_effect(
    design: &Design,
    key: usize,
    columns: &[&Column],
    results: &[Result],
) -> Vec<(f64, Shown)> {
    let places = design.places(key);
    let parts = (results.len() / POINTS_A_PART).clamp(1, PARTS);
    let mut sums = vec![(0.0, vec![(0.0, 0.0); columns.len()], 0.0); parts];
    for (place, result) in places.iter().zip(results) {
        let Some(figures) = shown(result, columns) else {
            continue;
        };
        let part = ((place * parts as f64) as usize).min(parts - 1);
        let (at, values, count) = &mut sums[part];
        *at += place;
        *count += 1.0;
        for (sum, value) in values.iter_mut().zip(figures) {
            if let Some(value) = value {
                *sum = (sum.0 + value, sum.1 + 1.0);
            }
        }
    }
    let filled = sums.into_iter().filter(|(_, _, count)| *count > 0.0);
    filled
        .map(|(at, values, count)| {
            let mean = |(sum, count): (f64, f64)| (count > 0.0).then(|| sum / count);
            (at / count, values.into_iter().map(mean).collect())
        })
        .collect()
}

/// Curves over the first axis: for every combination of the others, the points that are numbers.
fn over_first(
    axes: &[Axis],
    columns: &[&Column],
    points: &[Point],
    results: &[Result],
) -> Vec<Curve> {
    let mut curves: Vec<Curve> = Vec::new();
    for (point, result) in points.iter().zip(results) {
        let Some(shown) = shown(result, columns) else {
            continue;
        };
        let first = &point.values[0];
        let place = axes[0].values.iter().position(|value| value == first);
        let x = grid::leading_number(first)
            .filter(|_| axes[0].numbers())
            .unwrap_or(place.unwrap_or(0) as f64 + 1.0);
        let others = axes.iter().zip(&point.values).skip(1);
        let label: Vec<String> = others
            .map(|(axis, value)| {
                let key = axis.key.rsplit('.').next().unwrap_or(&axis.key);
                format!("{key} {value}")
            })
            .collect();
        let label = label.join(", ");
        match curves.iter_mut().find(|(known, _)| *known == label) {
            Some((_, curve)) => curve.push((x, shown)),
            None => curves.push((label, vec![(x, shown)])),
        }
    }
    for (_, curve) in &mut curves {
        curve.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    curves
}
