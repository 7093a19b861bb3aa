//! Kinks of the flanks as made, such as the start of a linear tip relief.
//!
//! Where a flank bends outwards by a finite angle an elastic pressure has no bound (it grows with the logarithm of the distance): its largest value
//! on a grid says as much about the grid as about the teeth until wear has rounded the kink off. Results mark it, and say what there is elsewhere.

use crate::contact::cycle::PairContact;
use crate::gear::Member;
use crate::simulate::forward::{ContactKind, Forward};

/// Least angle of a kink, rad: 1 µm over 1 mm. Of less the pressure of steel (E* 115 GPa) gains 25 MPa each time the grid is halved, E* φ ln 2/π.
const LEAST_ANGLE: f64 = 1e-3;

/// How many times as much as next to it a flank bends at a kink; at the start of a relief that grows with the power 1.5 it is twice.
const STANDS_OUT: f64 = 3.0;

/// Arc coordinates of the kinks of pinion and gear, mm; none where contacts are not solved on a grid.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Kinks([Vec<f64>; 2]);

impl Kinks {
    /// Those of the flanks of `forward`: as stated, as measured, and by its effects.
    pub(super) fn of(kind: ContactKind, forward: &Forward) -> Self {
        if kind == ContactKind::Hertz {
            return Self::default();
        }
        let cycle = forward.cycle();
        let made = forward.profile_by_effects();
        Self(Member::BOTH.map(|member| {
            let side = usize::from(member == Member::Gear);
            let gear = cycle.pair.member(member);
            // a rounding of the tip is no kink: it leaves the involute along its tangent
            let end = gear.arc(gear.rho_end);
            let stations = cycle.stations.arc[side].iter().enumerate();
            let (arcs, missing): (Vec<f64>, Vec<f64>) = stations
                .take_while(|(_, arc)| **arc <= end)
                .map(|(i, &arc)| {
                    let by_effects = made.map_or(0.0, |made| made[side][i]);
                    (arc, gear.relief(gear.rho_at_arc(arc)) + by_effects)
                })
                .unzip();
            kinks(&arcs, &missing)
        }))
    }

    /// Whether one lies under the pressures (MPa) at the unknowns of `pair`.
    pub(super) fn under(&self, pair: &PairContact, pressure: &[f64]) -> bool {
        let loaded = |k: &usize| pressure[*k] > 0.0;
        let ends = ((0..pressure.len()).find(loaded)).zip((0..pressure.len()).rev().find(loaded));
        let Some((first, last)) = ends else {
            return false;
        };
        // pressure ends somewhere between the last node that has some and the next
        let (first, last) = (first.saturating_sub(1), (last + 1).min(pressure.len() - 1));
        (self.0.iter().zip(&pair.arc)).any(|(kinks, arc)| {
            let (low, high) = (arc[first].min(arc[last]), arc[first].max(arc[last]));
            kinks.iter().any(|kink| (low..=high).contains(kink))
        })
    }
}

/// Where the straight lines through `missing` (mm) at evenly spaced `arcs` (mm) bend outwards at one place, mm.
fn kinks(arcs: &[f64], missing: &[f64]) -> Vec<f64> {
    let slopes: Vec<f64> = (arcs.windows(2).zip(missing.windows(2)))
        .map(|(arc, missing)| (missing[1] - missing[0]) / (arc[1] - arc[0]))
        .collect();
    // from before to behind an interval, in which a kink may lie anywhere
    let bend = |i: usize| -> f64 {
        match (
            i.checked_sub(1).and_then(|before| slopes.get(before)),
            slopes.get(i + 1),
        ) {
            (Some(before), Some(behind)) => behind - before,
            _ => 0.0,
        }
    };
    (1..slopes.len())
        .filter(|&i| {
            let beside = i
                .checked_sub(2)
                .map_or(0.0, bend)
                .abs()
                .max(bend(i + 2).abs());
            bend(i) > LEAST_ANGLE && bend(i) > STANDS_OUT * beside
        })
        .map(|i| 0.5 * (arcs[i] + arcs[i + 1]))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A relief of 30 µm over 1.5 mm from s = 3 mm, growing with a power.
    fn relief(exponent: f64) -> (Vec<f64>, Vec<f64>) {
        let arcs: Vec<f64> = (0..=250).map(|i| 0.018 * f64::from(i)).collect();
        let missing = arcs
            .iter()
            .map(|s| 0.03 * ((s - 3.0) / 1.5).max(0.0).powf(exponent));
        let missing = missing.collect();
        (arcs, missing)
    }

    #[test]
    fn the_start_of_a_linear_relief_is_a_kink_and_that_of_a_rounded_one_is_not() {
        let (arcs, missing) = relief(1.0);
        let found = kinks(&arcs, &missing);
        assert!(!found.is_empty());
        assert!(
            found.iter().all(|s| (s - 3.0).abs() < 2.0 * 0.018),
            "{found:?}"
        );
        for exponent in [1.5, 2.0] {
            let (arcs, missing) = relief(exponent);
            assert!(kinks(&arcs, &missing).is_empty(), "{exponent}");
        }
    }

    /// An edge that faces inwards carries no load, and a bend of 0.5 µm over 1 mm is none.
    #[test]
    fn hollows_and_slight_bends_are_no_kinks() {
        let (arcs, missing) = relief(1.0);
        let hollow: Vec<f64> = missing.iter().map(|m| -m).collect();
        let slight: Vec<f64> = missing.iter().map(|m| m / 50.0).collect();
        assert!(kinks(&arcs, &hollow).is_empty());
        assert!(kinks(&arcs, &slight).is_empty());
    }
}
