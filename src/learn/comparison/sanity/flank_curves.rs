//! The depth curves of a flank, one for each checkpoint and trace, alone and beside the model's.

use std::collections::BTreeMap;

use super::super::residual_statistics::FittedRow;
use crate::measure::{FacePlace, Observation, Quantity, Subject};

/// Depths along a flank after some cycles.
pub(super) struct Curve {
    pub(super) cycles: f64,
    /// Place and depth, by rising place.
    pub(super) points: Vec<[f64; 2]>,
    /// The mean of its values'.
    pub(super) sigma: f64,
}

/// A test, a member, and where across the face and on which tooth.
pub(super) type Flank<'d> = (usize, Subject, (Option<u64>, Option<&'d str>));

/// The curves of each flank by rising cycles, those of new flanks left out.
pub(super) fn flank_curves<'d>(
    all: impl Iterator<Item = &'d Observation>,
) -> BTreeMap<Flank<'d>, Vec<Curve>> {
    let mut rows: BTreeMap<_, Vec<&Observation>> = BTreeMap::new();
    for o in all.filter(|o| o.quantity == Quantity::WearDepth && o.cycles > 0.0) {
        let cut = (o.face.map(FacePlace::key), o.tooth.as_deref());
        // positive numbers stand in the order of their bits
        let key = ((o.test, o.member, cut), o.cycles.to_bits(), o.trace);
        rows.entry(key).or_default().push(o);
    }
    let mut curves: BTreeMap<_, Vec<Curve>> = BTreeMap::new();
    for ((flank, cycles, _), own) in rows {
        let mut points: Vec<[f64; 2]> = (own.iter())
            .filter_map(|o| Some([o.position?, o.value]))
            .collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let sigma = own.iter().map(|o| o.sigma).sum::<f64>() / own.len() as f64;
        curves.entry(flank).or_default().push(Curve {
            cycles: f64::from_bits(cycles),
            points,
            sigma,
        });
    }
    curves
}

/// Fewest points of a curve that is held against the model's.
pub(super) const FEWEST: usize = 6;

/// Place, measured depth, the model's and σ; by rising place.
pub(super) type Point = [f64; 4];

/// A member's curves of some length, by rising place.
pub(super) fn curves_of(rows: &[FittedRow<'_>], member: Subject) -> Vec<Vec<Point>> {
    let mut curves: BTreeMap<_, Vec<Point>> = BTreeMap::new();
    let own = rows
        .iter()
        .filter(|(o, _)| (o.quantity, o.member) == (Quantity::WearDepth, member));
    for (o, row) in own {
        let Some(place) = o.position else { continue };
        let face = o.face.map(FacePlace::key);
        let key = (
            o.test,
            o.cycles.to_bits(),
            o.trace,
            face,
            o.tooth.as_deref(),
        );
        curves
            .entry(key)
            .or_default()
            .push([place, o.value, row.model, o.sigma]);
    }
    let mut curves: Vec<Vec<Point>> = curves.into_values().filter(|c| c.len() >= FEWEST).collect();
    for curve in &mut curves {
        curve.sort_by(|a, b| a[0].total_cmp(&b[0]));
    }
    curves
}
