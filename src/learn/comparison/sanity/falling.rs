//! Wear that falls with the cycles: checkpoints exchanged, a digit lost.
//!
//! ```text
//! y ≈ s f of each depth curve     f the fitted model, the curve's datum removed, least squares weighted by 1/σ²
//! s N of a later checkpoint far below that of an earlier one: what the model wears grows with N
//! ```
//! Only of curves that have the model's shape: where the pattern changes over life, s may fall although every point wears. Masses are compared
//! as they are.

use std::collections::BTreeMap;

use super::super::residual_statistics::FittedRow;
use crate::measure::{FacePlace, Quantity, Subject};
use crate::study::Study;

/// Standard deviations from which a fall is no noise, and how far it must go.
const SURE: f64 = 6.0;
const FALLS_TO: f64 = 0.8;
/// Fewest points of a curve, and the share of its squares that `s f` must explain.
const FEWEST: usize = 4;
const OF_ITS_SHAPE: f64 = 0.8;

/// How much was worn at a checkpoint, in any unit, and its standard deviation.
struct Worn {
    cycles: f64,
    amount: f64,
    sigma: f64,
}

/// Tests whose wear falls from one checkpoint to the next.
pub(super) fn falling(study: &Study, rows: &[FittedRow<'_>]) -> Vec<String> {
    let mut said = Vec::new();
    for quantity in [Quantity::WearDepth, Quantity::MassLoss] {
        for ((test, member), series) in series(rows, quantity) {
            let Some((from, to)) = series.iter().find_map(|worn| fall(worn)) else {
                continue;
            };
            said.push(format!(
                "in test {} {} of the {} is less after {to} cycles than after {from}: wear does not fall. Are the cycles of two checkpoints exchanged, or \
                 has one a digit more or less?",
                study.tests[test].id,
                quantity.name(),
                member.name()
            ));
        }
    }
    said
}

/// The checkpoints between which wear falls.
fn fall(worn: &[Worn]) -> Option<(f64, f64)> {
    worn.windows(2).find_map(|pair| {
        let [before, after] = [&pair[0], &pair[1]];
        let far = before.amount - after.amount > SURE * before.sigma.hypot(after.sigma);
        // traces of one checkpoint are no fall
        let far = far && before.cycles < after.cycles;
        (far && after.amount < FALLS_TO * before.amount).then_some((before.cycles, after.cycles))
    })
}

type Series = BTreeMap<(usize, Subject), Vec<Vec<Worn>>>;

/// What was worn at the checkpoints of each test and member, by rising cycles; a series for each place across the face and tooth.
fn series(rows: &[FittedRow<'_>], quantity: Quantity) -> Series {
    let mut curves: BTreeMap<_, Vec<&FittedRow<'_>>> = BTreeMap::new();
    for row in rows
        .iter()
        .filter(|(o, _)| o.quantity == quantity && o.cycles > 0.0)
    {
        let o = row.0;
        let cut = (o.face.map(FacePlace::key), o.tooth.as_deref());
        // positive numbers stand in the order of their bits
        let key = (o.test, o.member, cut, o.cycles.to_bits(), o.trace);
        curves.entry(key).or_default().push(row);
    }
    let mut all: BTreeMap<_, Vec<Worn>> = BTreeMap::new();
    for ((test, member, cut, ..), own) in curves {
        let worn = match quantity {
            Quantity::MassLoss => mass(&own),
            _ => depth(&own),
        };
        if let Some(worn) = worn {
            all.entry((test, member, cut)).or_default().push(worn);
        }
    }
    let mut series = Series::new();
    for ((test, member, _), worn) in all {
        series.entry((test, member)).or_default().push(worn);
    }
    series
}

fn mass(own: &[&FittedRow<'_>]) -> Option<Worn> {
    let (o, _) = own.first()?;
    Some(Worn {
        cycles: o.cycles,
        amount: o.value,
        sigma: o.sigma,
    })
}

fn depth(own: &[&FittedRow<'_>]) -> Option<Worn> {
    let sum = |f: &dyn Fn(f64, f64) -> f64| -> f64 {
        let term = |(o, row): &&FittedRow<'_>| o.sigma.powi(-2) * f(row.model, o.value);
        own.iter().map(term).sum()
    };
    let weight = sum(&|_, _| 1.0);
    let [f, y] = [sum(&|f, _| f) / weight, sum(&|_, y| y) / weight];
    let ff = sum(&|model, _| (model - f).powi(2));
    let yy = sum(&|_, value| (value - y).powi(2));
    let fy = sum(&|model, value| (model - f) * (value - y));
    let cycles = own.first()?.0.cycles;
    let of_its_shape = fy * fy > OF_ITS_SHAPE * ff * yy;
    (own.len() >= FEWEST && ff > 0.0 && of_its_shape).then(|| Worn {
        cycles,
        amount: cycles * fy / ff,
        sigma: cycles / ff.sqrt(),
    })
}
