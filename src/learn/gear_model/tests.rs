//! Everything that is measured, differentiated: against central differences of histories along the same steps.

use std::path::Path;

use super::*;
use crate::effects::{CATALOGUE, find};
use crate::learn::measured::Measured;
use crate::measure::Dataset;
use crate::simulate::forward::ContactKind;
use crate::study::{EffectModel, EffectSpec, Study};

const ROWS: &str = "test,member,cycles,quantity,position,value,sigma\n\
    A,pinion,2e5,wear_depth,25.9,1,1\n\
    A,pinion,4e5,wear_depth,27.3,1,1\n\
    A,gear,4e5,wear_depth,52.4,1,1\n\
    A,pinion,4e5,mass_loss,,1,1\n\
    A,pair,4e5,mass_loss,,1,1\n\
    A,pair,4e5,transmission_error,0.1,1,1\n\
    A,pair,4e5,transmission_error,0.6,1,1\n\
    A,pinion,4e5,load_share,25.9,1,1\n\
    A,pinion,4e5,load_share,27.9,1,1\n\
    A,pinion,4e5,contact_pressure,27.0,1,1\n\
    A,pair,4e5,mesh_stiffness,0.3,1,1\n";

fn study() -> Study {
    let file = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("validation/challenges/running_in_L1/study.toml");
    let text = std::fs::read_to_string(file).unwrap();
    let coarse = "[numerics]\nelements_per_half_width = 3\npositions = 40\n";
    Study::parse(&format!("{text}\n{coarse}"), "study.toml").unwrap()
}

impl GearModel<'_> {
    /// What is measured at other parameters, along the steps of the history at `from`.
    fn along(&self, from: (f64, &[f64]), to: (f64, &[f64])) -> Vec<f64> {
        let run = self.run(0, from.0, from.1);
        let last = self.last(&run).unwrap();
        let mut forward = self
            .forward(0, run.worn_with, &run.bits, run.acting.as_ref())
            .unwrap();
        let history = self.history(&mut forward, run.key(), last, &[]).unwrap();
        let run = self.run(0, to.0, to.1);
        let mut forward = self
            .forward(0, run.worn_with, &run.bits, run.acting.as_ref())
            .unwrap();
        let history = history.along(&mut forward).unwrap();
        let read = |reading: &mut Reading<'_, '_>, o: &Observation| reading.of(o);
        self.read_off(&run, &mut forward, &history, &[], &read)
            .unwrap()
    }
}

/// Tolerances: 1e-4 of each kind's largest derivative by tangents; 2e-2 where the axes are moved, by 2 µm there and 0.5 µm here: between the
/// two a mesh cycle's own grids move.
fn check(kind: ContactKind, names: &[&str]) {
    let study = study();
    let data = Dataset::parse(ROWS, "m.csv", &study.known()).unwrap();
    let measured = Measured::new(&study, data);
    let workshop = measured.workshop(kind).unwrap();
    let bench = measured.bench(&workshop).unwrap();
    let k = 3.0 * study.wear.coefficient;
    let mut missed = Vec::new();
    for name in names {
        let card = find(name).unwrap();
        let effects = EffectModel::new(vec![EffectSpec::of_card(card, &[]).unwrap()]);
        let fitted: Vec<_> = (effects.parameters())
            .filter(|p| p.card.is_some_and(|card| card.fitted))
            .collect();
        let known: Vec<String> = fitted.iter().map(|p| p.name.clone()).collect();
        let values: Vec<f64> = fitted.iter().map(|p| p.value).collect();
        let build = |values: &[f64]| {
            effects.build(&|name| {
                let place = known.iter().position(|known| known == name)?;
                values.get(place).copied()
            })
        };
        let model = GearModel::new(&bench, Box::new(build)).stretching(effects.stretches_time());
        let moved = |place: usize, by: f64| {
            let mut values = values.clone();
            values[place] += by;
            values
        };
        let size = |place: usize| values[place].abs().max(1e-3);
        let moves: Vec<Move> = (0..values.len())
            .map(|place| Move {
                parameters: moved(place, 1e-7 * size(place)),
                step: 1e-7 * size(place),
            })
            .collect();
        let found = model.linearise(0, k, &values, &moves).unwrap().unwrap();
        assert_eq!(found.values, model.predict(0, k, &values).unwrap());
        let axes = card.hook == Hook::Operation;
        for column in 0..=values.len() {
            let (low, high, apart) = if column == values.len() {
                let h = 3e-7f64;
                let at = |h: f64| model.along((k, &values), (k * h.exp(), &values));
                (at(-h), at(h), 2.0 * h)
            } else {
                // 0.5 µm of centre distance for 0.1 mm or 0.01 µm/N
                let h = size(column) * if axes { 5e-3 } else { 3e-7 };
                let at = |h: f64| model.along((k, &values), (k, &moved(column, h)));
                (at(-h), at(h), 2.0 * h)
            };
            let tolerance = if axes && column < values.len() {
                2e-2
            } else {
                1e-4
            };
            // depths, masses, transmission errors, shares, the others
            for kind in [0..3, 3..5, 5..7, 7..9, 9..10, 10..11] {
                let slope = |row: usize| (high[row] - low[row]) / apart;
                let largest = kind.clone().map(|row| slope(row).abs()).fold(0.0, f64::max);
                let least = 1e-6 * found.values[kind.start].abs()
                    / size(column.min(values.len().max(1) - 1));
                for row in kind {
                    let off = (found.derivatives[(row, column)] - slope(row)).abs();
                    if off.is_nan() || off > tolerance * largest.max(least) {
                        missed.push(format!(
                            "{name} {column} row {row}: {} against {}, largest {largest}",
                            found.derivatives[(row, column)],
                            slope(row)
                        ));
                    }
                }
            }
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}

/// One law of every kind: with a clock and without, local and of the pair's load, added, displaced, of load, flexibility, profile, pitch, axes.
const KINDS: [&str; 10] = [
    "running_in",
    "severe_transition",
    "film_thickness",
    "debris_abrasion",
    "plastic_deformation",
    "dynamic_load",
    "extra_flexibility",
    "tip_relief",
    "pitch_error",
    "bearing_compliance",
];

#[test]
fn what_is_measured_is_differentiated_by_finite_elements() {
    check(ContactKind::Fem, &KINDS);
}

#[test]
fn what_is_measured_is_differentiated_by_the_analytic_model() {
    let all: Vec<&str> = CATALOGUE.iter().map(|card| card.name).collect();
    check(ContactKind::Hertz, &all);
}
