//! How passages share teeth, in what a state holds and in what its rates are.

use std::ops::Range;

use super::Mix;

/// How passages share teeth: a state holds the depths of both members for each passage, and a tooth that is in several stands in each.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sharing {
    /// What a class wears by: passages and their weights, by member and class.
    pub feeds: [Vec<Mix>; 2],
    /// Classes in a passage with their weights, by member and passage.
    pub mixes: [Vec<Mix>; 2],
    /// The passage that holds the depths of a class, by member and class.
    pub homes: [Vec<usize>; 2],
    /// Stations of pinion and gear.
    pub(super) stations: [usize; 2],
}

impl Sharing {
    /// Where the depths of member `m` in a passage stand in a state.
    pub(super) fn part(&self, passage: usize, m: usize) -> Range<usize> {
        let [pinion, gear] = self.stations;
        let first = passage * (pinion + gear) + m * pinion;
        first..first + self.stations[m]
    }

    /// Where the depths of a class stand among those of all classes, the pinion's first.
    pub fn class_part(&self, m: usize, class: usize) -> Range<usize> {
        let first = m * self.homes[0].len() * self.stations[0] + class * self.stations[m];
        first..first + self.stations[m]
    }

    /// Number of depths of all classes.
    pub fn size(&self) -> usize {
        (0..2).map(|m| self.homes[m].len() * self.stations[m]).sum()
    }

    /// Turns what each passage by itself wears into what it wears with the teeth that are shared: a class by the mean of its passages, a
    /// mean mate by that of the classes in it.
    pub fn share(&self, rates: &mut [f64]) {
        let mut classes = vec![0.0; self.size()];
        for m in 0..2 {
            for (class, feeds) in self.feeds[m].iter().enumerate() {
                let mean = &mut classes[self.class_part(m, class)];
                for &(passage, weight) in feeds {
                    add(mean, weight, &rates[self.part(passage, m)]);
                }
            }
        }
        self.spread(&classes, rates);
    }

    /// The depths of all classes in a state.
    pub fn gather(&self, u: &[f64]) -> Vec<f64> {
        let mut classes = vec![0.0; self.size()];
        for m in 0..2 {
            for (class, home) in self.homes[m].iter().enumerate() {
                classes[self.class_part(m, class)].copy_from_slice(&u[self.part(*home, m)]);
            }
        }
        classes
    }

    /// The state with these depths of all classes.
    pub fn spread(&self, classes: &[f64], u: &mut [f64]) {
        for m in 0..2 {
            for (passage, mix) in self.mixes[m].iter().enumerate() {
                let own = &mut u[self.part(passage, m)];
                own.fill(0.0);
                for &(class, weight) in mix {
                    add(own, weight, &classes[self.class_part(m, class)]);
                }
            }
        }
    }
}

/// Adds values with a weight.
pub(super) fn add(to: &mut [f64], weight: f64, values: &[f64]) {
    to.iter_mut()
        .zip(values)
        .for_each(|(to, v)| *to += weight * v);
}
