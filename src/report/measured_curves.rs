//! Measured curves with what the fitted base model says of them, and what it says with the leading effect.

use std::collections::BTreeMap;

use super::html::Section;
use super::plots::{Plot, Style};
use crate::learn::diagnose::{DRIVER_KINDS, DriverRow, Hypothesis, ResidualDrivers};
use crate::measure::Quantity;
use crate::numeric::written::{self, count};

/// Curves that are shown.
const SHOWN: usize = 6;
/// Points that make a curve.
const POINTS: usize = 4;

/// Test, member, quantity, and cycles as bits (they are never negative, so these ascend alike).
type Key<'r> = (&'r str, &'static str, &'static str, u64);

/// The curves that the base model misses by most, each in one picture with both models; none where nothing was measured along a flank
/// or over a mesh cycle. An effect that leads without being established is said to do so.
pub(super) fn section(left: &ResidualDrivers, is_established: bool) -> Option<Section> {
    let plots = plots(left);
    if plots.is_empty() {
        return None;
    }
    let with = left.after.as_ref().map(Hypothesis::in_words);
    let text = match &with {
        Some(effect) => format!(
            "The {} measured curves that the base model misses by most, with the fitted base model and the model with {effect}{}.",
            plots.len(),
            if is_established {
                ""
            } else {
                ", the most probable of the catalogue, which is not established"
            }
        ),
        None => format!(
            "The {} measured curves that the fitted base model misses by most.",
            plots.len()
        ),
    };
    let section = Section::new("Measured and computed")
        .paragraph(text)
        .plots(plots);
    Some(section.note("Bars: one stated standard deviation. To each computed curve its trace's most probable constant is added."))
}

fn plots(left: &ResidualDrivers) -> Vec<Plot> {
    let number = DRIVER_KINDS.iter().position(|kind| kind.name == "cycles");
    let cycles = |row: &DriverRow| number.and_then(|i| row.values[i]).unwrap_or(0.0);
    let mut curves: BTreeMap<Key<'_>, Vec<(f64, &DriverRow)>> = BTreeMap::new();
    for row in &left.rows {
        if let Some(at) = row.position {
            let key = (
                row.test.as_str(),
                row.member,
                row.quantity,
                cycles(row).to_bits(),
            );
            curves.entry(key).or_default().push((at, row));
        }
    }
    let mut curves: Vec<_> = curves.into_iter().filter(|c| c.1.len() >= POINTS).collect();
    let missed = |rows: &[(f64, &DriverRow)]| -> f64 {
        rows.iter().map(|(_, row)| row.before * row.before).sum()
    };
    curves.sort_by(|a, b| missed(&b.1).total_cmp(&missed(&a.1)));
    // one checkpoint of each test and member, so that the pictures tell different things
    let mut seen = Vec::new();
    curves.retain(|((test, member, quantity, _), _)| {
        let curve = (*test, *member, *quantity);
        !seen.contains(&curve) && {
            seen.push(curve);
            true
        }
    });
    curves.truncate(SHOWN);
    curves
        .into_iter()
        .enumerate()
        .map(|(i, (key, rows))| plot(i, key, rows, left.after.as_ref()))
        .collect()
}

fn plot(
    number: usize,
    (test, member, quantity, cycles): Key<'_>,
    mut rows: Vec<(f64, &DriverRow)>,
    after: Option<&Hypothesis>,
) -> Plot {
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    let unit = Quantity::ALL.into_iter().find(|q| q.name() == quantity);
    let unit = written::unit(unit.map_or("-", Quantity::unit));
    let what = quantity.replace('_', " ");
    let flank = member != "pair";
    let x = if flank {
        "radius, mm"
    } else {
        "pinion rotation from the pitch point, base pitches"
    };
    let of = if flank {
        format!(", {member}")
    } else {
        String::new()
    };
    let title = format!(
        "Test {test}{of}, {} cycles: {what}",
        count(f64::from_bits(cycles))
    );
    let name = format!("measured_{number}_{test}_{member}");
    let name: String = name
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() { c } else { '_' })
        .collect();
    let mut plot = Plot::new(&name, &title, x, &format!("{what}, {unit}"));
    let (points, errors) = rows
        .iter()
        .map(|(x, row)| ((*x, row.measured), row.sigma))
        .unzip();
    plot = plot.with_errors("measured", Style::Measured(2), points, errors);
    // residual = (measured - model - datum)/sigma
    let model = |left: &dyn Fn(&DriverRow) -> Option<f64>| -> Vec<(f64, f64)> {
        let known = rows
            .iter()
            .filter_map(|(x, row)| Some((x, row, left(row)?)));
        known
            .map(|(x, row, left)| (*x, row.measured - left * row.sigma))
            .collect()
    };
    plot = plot.curve("base model", Style::Line(1), model(&|row| Some(row.before)));
    if let Some(effect) = after {
        let label = format!("with {}", effect.in_words());
        plot = plot.curve(&label, Style::Line(0), model(&|row| row.after));
    }
    plot
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two curves of a flank, the second missed by more; `before` and `after` in sigmas of 0.1.
    fn rows(before: [f64; 2], after: Option<f64>) -> Vec<DriverRow> {
        let row = |cycles: f64, before: f64, i: u32| {
            let mut values = [None; DRIVER_KINDS.len()];
            values[DRIVER_KINDS
                .iter()
                .position(|k| k.name == "cycles")
                .unwrap()] = Some(cycles);
            DriverRow {
                test: "A".to_owned(),
                member: if cycles < 2e5 { "pinion" } else { "gear" },
                quantity: "wear_depth",
                position: Some(30.0 - f64::from(i)),
                values,
                measured: 2.0,
                sigma: 0.1,
                before,
                after,
            }
        };
        let curve = |cycles: f64, before: f64| (0..5).map(move |i| row(cycles, before, i));
        curve(1e5, before[0]).chain(curve(3e5, before[1])).collect()
    }

    fn left(rows: Vec<DriverRow>, after: Option<Hypothesis>) -> ResidualDrivers {
        ResidualDrivers {
            after,
            drivers: Vec::new(),
            constant: Vec::new(),
            rows,
        }
    }

    #[test]
    fn computed_curves_are_measured_less_what_is_left_and_the_worst_comes_first() {
        let found = plots(&left(
            rows([1.0, -5.0], Some(0.5)),
            Some(Hypothesis::Unknown),
        ));
        assert_eq!(found.len(), 2);
        assert!(found[0].title.contains("gear, 300"), "{}", found[0].title);
        let [measured, base, with] = &found[0].curves[..] else {
            panic!("{:?}", found[0].curves);
        };
        // by ascending radius
        assert_eq!(measured.points[0], (26.0, 2.0));
        assert!(base.points.iter().all(|p| (p.1 - 2.5).abs() < 1e-12));
        assert!(with.points.iter().all(|p| (p.1 - 1.95).abs() < 1e-12));
        assert!(section(&left(rows([1.0, 1.0], None), None), true).is_some());
        assert!(section(&left(rows([1.0, 1.0], None).split_off(8), None), true).is_none());
    }
}
