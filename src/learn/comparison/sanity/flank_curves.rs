//! The depth curves of a flank, one for each checkpoint and trace.

use std::collections::BTreeMap;

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
