//! Measured points against the fitted model, residuals below.
use std::collections::BTreeMap;

use super::{Plot, Style};
use crate::gear::Pair;
use crate::learn::{Curve, curves};
use crate::measure::{Place, Quantity, Subject};
use crate::numeric::written::count;
use crate::report::comparison::Result;

/// The plots of each test of the study, by its number: each member's and the pair's quantities, cycles apart by colour.
pub fn of_comparison(result: &Result<'_>) -> Vec<Vec<Plot>> {
    let all = curves(result.study, result.data, result.fit);
    let mut plots: Vec<Vec<Plot>> = vec![Vec::new(); result.study.tests.len()];
    let mut groups: BTreeMap<(usize, Quantity, Option<Subject>), Vec<&Curve>> = BTreeMap::new();
    for curve in &all {
        let whole = matches!(curve.quantity.place(), Place::Whole | Place::Span);
        let member = (!whole).then_some(curve.member);
        groups
            .entry((curve.test, curve.quantity, member))
            .or_default()
            .push(curve);
    }
    for ((test, quantity, member), curves) in groups {
        let id = &result.study.tests[test].id;
        let plot = match member {
            Some(member) => {
                let misalignment = result.study.tests[test].conditions.misalignment_mm;
                let pair = result.study.gears.pair(misalignment).ok();
                by_position(id, quantity, member, &curves, pair.as_ref())
            }
            None => over_cycles(id, quantity, &curves),
        };
        if !plot.is_empty() {
            plots[test].push(plot);
        }
    }
    plots
}

/// Errors of all tests over the path of contact in units of their sigmas, one plot for each member and quantity on a flank.
pub fn errors_by_place(result: &Result<'_>) -> Vec<Plot> {
    let all = curves(result.study, result.data, result.fit);
    type ByTest = BTreeMap<usize, Vec<(f64, f64)>>;
    let mut groups: BTreeMap<(Quantity, Subject), ByTest> = BTreeMap::new();
    for curve in &all {
        let points = curve.points.iter();
        let placed = points.filter_map(|p| Some((p.path?, p.residual / p.sigma)));
        groups
            .entry((curve.quantity, curve.member))
            .or_default()
            .entry(curve.test)
            .or_default()
            .extend(placed);
    }
    let mut plots = Vec::new();
    for ((quantity, member), tests) in groups {
        let (name, _) = words(quantity);
        let mut plot = Plot::new(
            &format!("errors_{}_{}", quantity.name(), member.name()),
            &format!("All tests, {}: error of the {name}", member.name()),
            FLANK,
            "(model − measured) / sigma",
        );
        plot.residuals = true;
        let letters = tests.keys().next().and_then(|&test| marks(result, test));
        plot = plot.with_marks(letters.into_iter().flatten());
        for (kind, (test, mut points)) in tests.into_iter().enumerate() {
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            let label = format!("test {}", result.study.tests[test].id);
            plot = plot.curve(&label, Style::Measured(kind), points);
        }
        plots.push(plot);
    }
    plots.retain(|plot| !plot.is_empty());
    plots
}

const FLANK: &str = "distance along the path of contact from the pitch point, mm";

/// A to E of a test's pair.
fn marks(result: &Result<'_>, test: usize) -> Option<[(f64, String); 5]> {
    let misalignment = result.study.tests[test].conditions.misalignment_mm;
    let points = result.study.gears.pair(misalignment).ok()?.path_points();
    let letters = ["A", "B", "C", "D", "E"];
    Some(std::array::from_fn(|i| (points[i], letters[i].to_owned())))
}

/// A quantity's name and unit.
fn words(quantity: Quantity) -> (&'static str, &'static str) {
    match quantity {
        Quantity::WearDepth => ("worn depth", "µm"),
        Quantity::TransmissionError => ("transmission error of the gear", "µrad"),
        Quantity::MassLoss => ("mass loss", "mg"),
        Quantity::LoadShare => ("load share", "-"),
        Quantity::ContactPressure => ("contact pressure", "MPa"),
        Quantity::MeshStiffness => ("mesh stiffness", "N/(mm µm)"),
        Quantity::MeanLag => ("mean lag", "µrad"),
        Quantity::SpanLoss => ("loss of span", "µm"),
        Quantity::ChordalLoss => ("loss of chordal thickness", "µm"),
    }
}

fn empty(id: &str, quantity: Quantity, member: &str, x_label: &str) -> (Plot, Plot) {
    let (name, unit) = words(quantity);
    // file names take what is no letter or digit badly
    let safe: String = id
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() { c } else { '_' })
        .collect();
    let stem = format!("{}_{safe}_{member}", quantity.name());
    let title = format!("Test {id}, {member}: {name}, measured (points) and model (lines)");
    let upper = Plot::new(&stem, &title, x_label, &format!("{name}, {unit}"));
    let lower = Plot::new("", "", x_label, &format!("error, {unit}"));
    (upper, lower)
}

/// Along the flank or over the rotation: one colour for each number of cycles.
fn by_position(
    id: &str,
    quantity: Quantity,
    member: Subject,
    curves: &[&Curve],
    pair: Option<&Pair>,
) -> Plot {
    let flank = quantity.place() == Place::Flank;
    let x_label = if flank {
        FLANK
    } else {
        "pinion rotation from the pitch point, base pitches"
    };
    let (mut upper, mut lower) = empty(id, quantity, member.name(), x_label);
    if let Some(pair) = pair.filter(|_| flank) {
        let points = pair.path_points();
        let letters = ["A", "B", "C", "D", "E"];
        upper = upper.with_marks(points.into_iter().zip(letters.map(str::to_owned)));
        lower = lower.with_marks(points.map(|at| (at, String::new())));
    }
    let mut times: Vec<f64> = curves.iter().map(|curve| curve.cycles).collect();
    times.dedup();
    for (index, &cycles) in times.iter().enumerate() {
        let count_of = times.len();
        let mut points: Vec<_> = curves
            .iter()
            .filter(|curve| curve.cycles == cycles)
            .flat_map(|curve| &curve.points)
            .map(|p| (if flank { p.path } else { Some(p.position) }, p))
            .filter_map(|(at, p)| Some((at?, p)))
            .collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let label = format!("{} cycles", count(cycles));
        let measured = Style::TimeMeasured {
            index,
            count: count_of,
        };
        let line = Style::TimeLine {
            index,
            count: count_of,
        };
        upper = upper
            .curve(
                "",
                line,
                points.iter().map(|(at, p)| (*at, p.model)).collect(),
            )
            .with_errors(
                &label,
                measured,
                points.iter().map(|(at, p)| (*at, p.measured)).collect(),
                points.iter().map(|(_, p)| p.sigma).collect(),
            );
        let residuals = points.iter().map(|(at, p)| (*at, p.residual)).collect();
        lower = lower.curve("", measured, residuals);
    }
    upper.above(lower)
}

/// Of whole members: both over the cycles.
fn over_cycles(id: &str, quantity: Quantity, curves: &[&Curve]) -> Plot {
    let (mut upper, mut lower) = empty(id, quantity, "members", "pinion revolutions");
    let mut members: Vec<Subject> = curves.iter().map(|curve| curve.member).collect();
    members.sort();
    members.dedup();
    for (kind, member) in members.into_iter().enumerate() {
        let own = curves.iter().filter(|curve| curve.member == member);
        let points: Vec<_> = own
            .flat_map(|curve| curve.points.iter().map(|p| (curve.cycles, p)))
            .collect();
        upper = upper
            .curve(
                "",
                Style::Line(kind),
                points.iter().map(|(at, p)| (*at, p.model)).collect(),
            )
            .with_errors(
                member.name(),
                Style::Measured(kind),
                points.iter().map(|(at, p)| (*at, p.measured)).collect(),
                points.iter().map(|(_, p)| p.sigma).collect(),
            );
        let residuals = points.iter().map(|(at, p)| (*at, p.residual)).collect();
        lower = lower.curve("", Style::Measured(kind), residuals);
    }
    upper.starting_at_zero().above(lower)
}
