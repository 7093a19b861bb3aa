//! Where the worn depth of each flank is kept.

use crate::gear::{Gear, Pair};

/// Where depths are kept: ascending arc coordinates of the pinion's and the gear's flank, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct Stations {
    /// Arc coordinates, pinion then gear.
    pub arc: [Vec<f64>; 2],
}

impl Stations {
    /// Evenly spaced stations, at most `spacing` (mm) apart, from the form circle to the tip.
    pub fn new(pair: &Pair, spacing: f64) -> Self {
        let count = |gear: &Gear| {
            let length = gear.arc(gear.rho_last) - gear.arc(gear.rho_form);
            (length / spacing).ceil().max(2.0) as usize
        };
        Self::even(pair, [count(&pair.pinion), count(&pair.gear)])
    }

    /// As many evenly spaced stations for the same gears at another mounting: one more would shift them all, which a fit of the
    /// mounting sees as a jump.
    pub fn like(&self, pair: &Pair) -> Self {
        Self::even(pair, [0, 1].map(|side| self.arc[side].len() - 1))
    }

    fn even(pair: &Pair, counts: [usize; 2]) -> Self {
        let even = |gear: &Gear, count: usize| {
            let (from, to) = (gear.arc(gear.rho_form), gear.arc(gear.rho_last));
            (0..=count)
                .map(|i| from + (to - from) * i as f64 / count as f64)
                .collect()
        };
        Self {
            arc: [even(&pair.pinion, counts[0]), even(&pair.gear, counts[1])],
        }
    }

    /// Number of stations on both flanks.
    pub fn count(&self) -> usize {
        self.arc[0].len() + self.arc[1].len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::frame::tests::reference;

    #[test]
    fn stations_at_another_mounting_are_as_many_and_end_at_its_flanks() {
        let pair = reference();
        let stations = Stations::new(&pair, 0.013);
        let moved = Pair::new(pair.pinion.clone(), pair.gear.clone(), 80.0, 0.7).unwrap();
        let like = stations.like(&moved);
        assert_eq!(like.count(), stations.count());
        for (arc, gear) in like.arc.iter().zip([&moved.pinion, &moved.gear]) {
            let ends = [gear.arc(gear.rho_form), gear.arc(gear.rho_tip)];
            let off = [arc[0] - ends[0], arc[arc.len() - 1] - ends[1]];
            assert!(off.iter().all(|off| off.abs() < 1e-12), "{off:?}");
            let step = (ends[1] - ends[0]) / (arc.len() - 1) as f64;
            assert!(step <= 0.013 + 1e-12);
            for two in arc.windows(2) {
                assert!((two[1] - two[0] - step).abs() < 1e-9);
            }
        }
    }
}
