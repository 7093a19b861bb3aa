//! What would be measured in a test that has not been made: where, when, and with which noise.

use std::collections::BTreeMap;

use crate::learn::model_search::context::Context;
use crate::learn::prediction::bench::MeasuredTest;
use crate::learn::prediction::standard_test;
use crate::measure::{Dataset, Observation, Quantity, Subject, Trace};
use crate::study::{Operation, Study};

/// Smallest sigma, in any unit.
const LEAST: f64 = 1e-9;

/// Rows without values, and how large their noise is.
pub(in crate::learn) struct MeasurementDesign {
    pub(in crate::learn) observations: Vec<Observation>,
    traces: Vec<Trace>,
    /// Sigma over the largest magnitude of its curve (same member, quantity, cycles), per row.
    relative: Vec<f64>,
    /// What is added to that, in the row's unit.
    floor: Vec<f64>,
}

impl MeasurementDesign {
    /// As in the fit test with most rows, its cycles stretched; None without measurements.
    pub(in crate::learn) fn measured(context: &Context<'_>, cycles: f64) -> Option<Self> {
        let data = &context.likelihood.measured.data;
        let study = context.likelihood.measured.study();
        let rows = |t: usize| data.observations.iter().filter(move |o| o.test == t);
        let most = context.likelihood.tests.iter().copied();
        let most = most.max_by_key(|&t| (rows(t).count(), usize::MAX - t))?;
        let stretch = cycles / study.tests[most].conditions.cycles;
        let largest = largest(rows(most).map(|o| (curve(o), o.value)));
        let relative = rows(most)
            .map(|o| match largest[&curve(o)] {
                largest if largest > 0.0 => o.sigma / largest,
                _ => 1.0,
            })
            .collect();
        let observations: Vec<Observation> = rows(most)
            .map(|o| Observation {
                test: 0,
                cycles: o.cycles * stretch,
                ..o.clone()
            })
            .collect();
        Some(Self {
            floor: vec![0.0; observations.len()],
            traces: data.traces.clone(),
            relative,
            observations,
        })
    }

    /// The rows of a standard test, all with the relative noise `noise`; None if the gears do not run at that misalignment.
    pub(in crate::learn) fn standard(
        study: &Study,
        operation: &Operation,
        noise: f64,
    ) -> Option<Self> {
        let pair = study.gear_set().mount(operation.misalignment_mm).ok()?;
        let mut traces = Vec::new();
        let observations = standard_test::rows((0, "next"), &pair, operation.cycles, &mut traces);
        let floor = observations.iter();
        Some(Self {
            floor: floor
                .map(|o| standard_test::floor(o, study, &pair))
                .collect(),
            relative: vec![noise; observations.len()],
            traces,
            observations,
        })
    }

    /// With the rows of `other` whose quantity is not there yet.
    pub(in crate::learn) fn completed(mut self, other: Self) -> Self {
        let known: Vec<Quantity> = self.observations.iter().map(|o| o.quantity).collect();
        let shift = self.traces.len();
        self.traces.extend(other.traces);
        let rows = other.observations.into_iter().zip(other.relative);
        for ((mut o, relative), floor) in rows.zip(other.floor) {
            if !known.contains(&o.quantity) {
                o.trace = o.trace.map(|trace| trace + shift);
                self.push(o, relative, floor);
            }
        }
        self
    }

    /// The test as a bench takes it.
    pub(in crate::learn) fn test(&self, study: &Study, operation: &Operation) -> MeasuredTest {
        MeasuredTest {
            id: "next".to_owned(),
            conditions: operation.simulated(&study.wear_at(operation)),
            wear: (study.wear.coefficient, study.wear_at(operation).members),
            materials: study.elastic_at(operation),
            surroundings: study.surroundings(operation),
            reversed: operation.reversed,
            observations: self.observations.clone(),
        }
    }

    /// The rows with these values and sigmas in proportion.
    pub(in crate::learn) fn with(&self, values: &[f64]) -> Dataset {
        let mut observations = self.observations.clone();
        observations
            .iter_mut()
            .zip(values)
            .for_each(|(o, v)| o.value = *v);
        let largest = largest(observations.iter().map(|o| (curve(o), o.value)));
        let noise = self.relative.iter().zip(&self.floor);
        for (o, (relative, floor)) in observations.iter_mut().zip(noise) {
            o.sigma = (relative * largest[&curve(o)] + floor).max(LEAST);
        }
        Dataset {
            name: String::new(),
            tests: vec!["next".to_owned()],
            observations,
            traces: self.traces.clone(),
            reading: String::new(),
            outliers: Vec::new(),
            estimated_sigmas: 0,
        }
    }

    /// Rows of one quantity.
    pub(in crate::learn) fn rows(&self, quantity: Quantity) -> Vec<usize> {
        (0..self.observations.len())
            .filter(|&i| self.observations[i].quantity == quantity)
            .collect()
    }

    fn push(&mut self, observation: Observation, relative: f64, floor: f64) {
        self.observations.push(observation);
        self.relative.push(relative);
        self.floor.push(floor);
    }
}

type Curve = (Subject, Quantity, u64);

fn curve(o: &Observation) -> Curve {
    (o.member, o.quantity, o.cycles.to_bits())
}

fn largest(values: impl Iterator<Item = (Curve, f64)>) -> BTreeMap<Curve, f64> {
    let mut largest = BTreeMap::new();
    for (curve, value) in values {
        let entry: &mut f64 = largest.entry(curve).or_insert(0.0);
        *entry = entry.max(value.abs());
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn study() -> Study {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/validation/paper/study.toml");
        Study::load(std::path::Path::new(path)).unwrap()
    }

    #[test]
    fn the_standard_test_measures_both_flanks_and_its_noise_follows_the_curve() {
        let study = study();
        let design = MeasurementDesign::standard(&study, &study.operation, 0.02).unwrap();
        let depths = design.rows(Quantity::WearDepth);
        assert_eq!(depths.len(), 41 * 5 * 2);
        assert_eq!(design.rows(Quantity::MassLoss).len(), 10);
        let data = design.with(&vec![5.0; design.observations.len()]);
        assert!((data.observations[depths[0]].sigma - (0.02 * 5.0 + 0.02)).abs() < 1e-12);
        // the radii lie on the members' flanks
        let known = study.known();
        for &i in &depths {
            let o = &design.observations[i];
            let member = o.member.member().unwrap();
            assert!(known.on_flank(member, o.position.unwrap()));
        }
    }

    #[test]
    fn completing_adds_only_what_is_missing() {
        let study = study();
        let standard = || MeasurementDesign::standard(&study, &study.operation, 0.02).unwrap();
        let all = standard().observations.len();
        assert_eq!(standard().completed(standard()).observations.len(), all);
        let mut depths = standard();
        let rows = depths.rows(Quantity::WearDepth).len();
        depths
            .observations
            .retain(|o| o.quantity == Quantity::WearDepth);
        depths.relative.truncate(rows);
        depths.floor.truncate(rows);
        assert_eq!(depths.completed(standard()).observations.len(), all);
    }
}
