//! Where on a flank, and when in a test, an observation stands.

use std::collections::BTreeMap;

use crate::gear::{Member, Pair, Region};
use crate::measure::{Dataset, Observation, Place};
use crate::study::Study;

/// Most cycle intervals told apart in one test; more checkpoints share intervals.
const INTERVALS: usize = 8;

/// The geometry and checkpoints of the tests of a study.
#[derive(Debug)]
pub(in crate::learn) struct FlankRegions {
    pairs: Vec<Option<Pair>>,
    /// Ends of the cycle intervals of each test, ascending.
    ends: Vec<Vec<f64>>,
    /// Length of each test, pinion revolutions.
    lengths: Vec<f64>,
}

/// Thirds of a test's length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::learn) enum Stage {
    Early,
    Middle,
    Late,
}

impl FlankRegions {
    pub(in crate::learn) fn new(study: &Study, data: &Dataset) -> Self {
        let pair =
            |test: &crate::study::Test| study.gears.pair(test.conditions.misalignment_mm).ok();
        let mut cycles: Vec<BTreeMap<u64, f64>> = vec![BTreeMap::new(); data.tests.len()];
        for o in &data.observations {
            // Positive numbers order as their bits do.
            cycles[o.test].insert(o.cycles.to_bits(), o.cycles);
        }
        let ends = cycles.into_iter().map(|of_test| {
            let all: Vec<f64> = of_test.into_values().collect();
            let count = all.len().min(INTERVALS);
            (1..=count)
                .map(|i| all[i * all.len() / count - 1])
                .collect()
        });
        Self {
            pairs: study.tests.iter().map(pair).collect(),
            ends: ends.collect(),
            lengths: (study.tests.iter())
                .map(|test| test.conditions.cycles)
                .collect(),
        }
    }

    /// Tests of no geometry, by the ends of their intervals; the last one is that of the test.
    #[cfg(test)]
    pub(in crate::learn) fn of_ends(ends: Vec<Vec<f64>>) -> Self {
        Self {
            pairs: ends.iter().map(|_| None).collect(),
            lengths: (ends.iter())
                .map(|of_test| of_test.last().copied().unwrap_or_default())
                .collect(),
            ends,
        }
    }

    /// Signed distance along the path of contact from the pitch point, mm, of what stands at a radius.
    pub(in crate::learn) fn path(&self, o: &Observation) -> Option<f64> {
        let member = o.member.member()?;
        let radius = o.position.filter(|_| o.quantity.place() == Place::Flank)?;
        let pair = self.pairs.get(o.test)?.as_ref()?;
        // The third decimal of a stated radius may round beyond the tip.
        let gear = pair.member(member);
        pair.path_at_radius(member, radius.clamp(gear.base_radius, gear.tip_radius))
    }

    /// The region of the path of contact of what stands at a radius.
    pub(in crate::learn) fn region(&self, o: &Observation) -> Option<Region> {
        let path = self.path(o)?;
        Some(self.pairs[o.test].as_ref()?.region(path))
    }

    /// The number of the cycle interval in its test.
    pub(in crate::learn) fn interval(&self, o: &Observation) -> usize {
        let ends = &self.ends[o.test];
        ends.iter()
            .position(|&end| o.cycles <= end)
            .unwrap_or(ends.len().saturating_sub(1))
    }

    /// Bounds of a test's cycle interval, pinion revolutions.
    pub(in crate::learn) fn cycles(&self, test: usize, interval: usize) -> [f64; 2] {
        let ends = &self.ends[test];
        let start = if interval == 0 {
            0.0
        } else {
            ends[interval - 1]
        };
        [start, ends[interval]]
    }

    /// In which third of the test the middle of a cycle interval lies; of the test's length, however late its last row is.
    pub(in crate::learn) fn stage(&self, test: usize, interval: usize) -> Stage {
        let [from, to] = self.cycles(test, interval);
        let thirds = 3.0 * 0.5 * (from + to) / self.lengths[test].max(to);
        if thirds < 1.0 {
            Stage::Early
        } else if thirds > 2.0 {
            Stage::Late
        } else {
            Stage::Middle
        }
    }

    /// Number of cycle intervals of a test.
    pub(in crate::learn) fn intervals(&self, test: usize) -> usize {
        self.ends[test].len()
    }
}

/// A region of a member's flank in words: its root side is where the mate's tip works.
pub(in crate::learn) fn words(member: Member, region: Region) -> &'static str {
    match (member, region) {
        (Member::Pinion, Region::LowerDouble) | (Member::Gear, Region::UpperDouble) => "root",
        (Member::Pinion, Region::UpperDouble) | (Member::Gear, Region::LowerDouble) => "tip",
        (Member::Pinion, Region::SingleLower) | (Member::Gear, Region::SingleUpper) => {
            "flank just below the pitch point"
        }
        (Member::Pinion, Region::SingleUpper) | (Member::Gear, Region::SingleLower) => {
            "flank just above the pitch point"
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn early_and_late_go_by_the_length_of_the_test() {
        let mut map = FlankRegions::of_ends(vec![vec![1e5, 2.5e5, 3e5]]);
        let stages = |map: &FlankRegions| [0, 1, 2].map(|interval| map.stage(0, interval));
        assert_eq!(stages(&map), [Stage::Early, Stage::Middle, Stage::Late]);
        // measured in its first half only
        map.lengths = vec![6e5];
        assert_eq!(stages(&map), [Stage::Early, Stage::Early, Stage::Middle]);
    }
}
