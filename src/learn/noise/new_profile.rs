//! The scatter of the new profile, from which every worn profile of a flank is taken off.
//!
//! ```text
//! h_i = w(r_i) − v_i(r_i)         w: the new profile as it was measured, v_i: a worn one; w scatters by τ, once and for all checkpoints
//! N_ij = τ² max(0, 1 − |r_i − r_j|/d)         i, j: depths of one flank, d: the usual distance between points of its finest curve
//! ```
//! At radii that all checkpoints share this is τ² for rows of one radius and 0 for others. Radii that differ a little from checkpoint to
//! checkpoint, among which a new profile was interpolated, share that much less.

use std::collections::BTreeMap;

use super::NoiseModel;
use crate::measure::neighbours::curves;
use crate::measure::{FacePlace, Observation, Quantity, Surface, surfaces};
use crate::numeric::median;

/// What the scatter of new profiles ties together among some rows.
pub(super) struct NewProfile {
    /// τ², µm².
    variance: f64,
    /// d of every row's flank, mm; 0 where a row takes no part.
    spacing: Vec<f64>,
}

impl NewProfile {
    /// None where no such scatter is expected.
    pub(super) fn of(picked: &[&Observation], model: &NoiseModel) -> Option<Self> {
        if model.new_profile_um <= 0.0 {
            return None;
        }
        let surfaces = surfaces(picked);
        let place = |i: usize| picked[i].position.unwrap_or(0.0);
        let mut least: BTreeMap<Surface, f64> = BTreeMap::new();
        for curve in curves(picked) {
            let own = least.entry(surfaces[curve[0]]).or_insert(f64::INFINITY);
            let apart = curve.windows(2).map(|two| place(two[1]) - place(two[0]));
            let apart: Vec<f64> = apart.filter(|apart| *apart > 0.0).collect();
            // the middle one, which a repeat a hair's breadth away does not change
            *own = median(apart).unwrap_or(f64::INFINITY).min(*own);
        }
        let spacing = (picked.iter().zip(&surfaces)).map(|(o, surface)| {
            let takes_part = o.quantity == Quantity::WearDepth && o.position.is_some();
            let least = least.get(surface).filter(|_| takes_part);
            // of curves of single points only the same place is the same
            least.map_or(0.0, |d| if d.is_finite() { *d } else { f64::MIN_POSITIVE })
        });
        Some(Self {
            variance: model.new_profile_um.powi(2),
            spacing: spacing.collect(),
        })
    }

    /// N of the rows `i` and `j`, which lie on one surface.
    pub(super) fn between(&self, picked: &[&Observation], i: usize, j: usize) -> f64 {
        let (a, b) = (picked[i], picked[j]);
        let (Some(at), Some(other)) = (a.position, b.position) else {
            return 0.0;
        };
        let apart = (at - other).abs();
        if self.spacing[i] == 0.0 || apart >= self.spacing[i] || flank(a) != flank(b) {
            return 0.0;
        }
        self.variance * (1.0 - apart / self.spacing[i])
    }
}

/// What tells the flanks of a surface apart: each line across the face and each tooth has a new profile of its own.
fn flank(o: &Observation) -> (Option<u64>, Option<&str>) {
    (o.face.map(FacePlace::key), o.tooth.as_deref())
}
