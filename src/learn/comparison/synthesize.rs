//! Measurements of a study's own model: what instruments would read if the model were the truth, with stated noise.
//!
//! ```text
//! value = model(k_t, effects) + datum of the trace + scatter of the new profile + sigma · N(0, 1)
//! sigma = noise · largest magnitude of the trace + 0.02 µm          k_t = k exp(scatter · N(0, 1))
//! ```
//! The 0.02 µm become a mass by the worn flanks' area and an angle by the gear's base radius.

use std::collections::BTreeMap;

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::gear::Pair;
use crate::learn::comparison::{CompareError, CompareStage, Watch, contact_of};
use crate::learn::fitting::fit::FitError;
use crate::learn::fitting::measured::Measured;
use crate::learn::prediction::gear_model::GearModel;
use crate::learn::prediction::predictor::Predictor;
use crate::learn::prediction::standard_test::{self, floor};
use crate::measure::{Dataset, FacePlace, Observation, Quantity};
use crate::study::{Scatter, Study, Test};

/// Measurements made up, with what is true of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Synthetic {
    /// The measurements.
    pub data: Dataset,
    /// Wear coefficient of each test, mm²/N.
    pub coefficients: Vec<f64>,
    /// Datum of each trace, µm.
    pub datums: Vec<f64>,
}

/// Measures the study's own model, its effects included, in each of its tests; the same for the same seed.
///
/// # Errors
/// [`CompareError`] if a test cannot run.
pub fn synthesize(
    study: &Study,
    noise: f64,
    seed: u64,
    watch: Watch<'_>,
) -> Result<Synthetic, CompareError> {
    let kind = contact_of(study)?;
    let data = places(study)?;
    let measured = Measured::new(study, data.clone());
    watch(CompareStage::Members);
    let workshop = measured.workshop(kind)?;
    watch(CompareStage::Tests);
    let bench = measured.finest_bench(&workshop)?;
    let model = GearModel::new(&bench, Box::new(|_| study.effect_model().stated()))
        .stretching(study.effect_model().stretches_time());
    let mut synthetic = Synthetic {
        datums: vec![0.0; data.traces.len()],
        data,
        coefficients: Vec::new(),
    };
    for (test, conditions) in study.tests.iter().enumerate() {
        watch(CompareStage::Fitting {
            histories: test,
            expected: study.tests.len(),
        });
        let mut draw = Draw::new(seed, test);
        let k = study.wear.coefficient
            * match study.noise.coefficient_scatter {
                Scatter::Relative(scatter) => libm::exp(scatter * draw.normal()),
                Scatter::Estimate => 1.0,
            };
        synthetic.coefficients.push(k);
        let exact = model.predict(test, k, &[]).map_err(FitError::from)?;
        let pair = pair(study, conditions)?;
        synthetic.disturb(test, &exact, study, &pair, noise, &mut draw);
    }
    Ok(synthetic)
}

impl Synthetic {
    /// Sets values and sigmas of one test's rows from what the model says.
    fn disturb(
        &mut self,
        test: usize,
        exact: &[f64],
        study: &Study,
        pair: &Pair,
        noise: f64,
        draw: &mut Draw,
    ) {
        let rows: Vec<usize> = (0..self.data.observations.len())
            .filter(|&row| self.data.observations[row].test == test)
            .collect();
        let new_profile = self.new_profiles(&rows, study.noise.new_profile_um, draw);
        let curve = |o: &Observation| (o.member, o.quantity, o.cycles.to_bits());
        let mut start = 0;
        while start < rows.len() {
            let all = &self.data.observations;
            let key = curve(&all[rows[start]]);
            let end = (start..rows.len())
                .find(|&i| curve(&all[rows[i]]) != key)
                .unwrap_or(rows.len());
            let largest = exact[start..end]
                .iter()
                .fold(0.0, |m: f64, v| m.max(v.abs()));
            let first = &all[rows[start]];
            let sigma = noise * largest + floor(first, study, pair);
            let datum = first.trace.map_or(0.0, |trace| {
                self.datums[trace] = study.noise.datum_um * draw.normal();
                self.datums[trace]
            });
            let of_machine = if first.quantity == Quantity::WearDepth {
                let places: Vec<f64> = (rows[start..end].iter())
                    .map(|&i| all[i].position.unwrap_or(0.0))
                    .collect();
                // nothing is drawn for what is not there, or the same seed would make other noise than before
                let mut of_size = |size: f64| {
                    if size > 0.0 {
                        size * draw.normal()
                    } else {
                        0.0
                    }
                };
                let (tilt, shift) = (of_size(study.noise.tilt_um), of_size(study.noise.shift_mm));
                tilted_and_shifted(&places, &exact[start..end], tilt, shift)
            } else {
                exact[start..end].to_vec()
            };
            for (i, value) in (start..end).zip(of_machine) {
                let o = &mut self.data.observations[rows[i]];
                o.sigma = sigma;
                o.value = value + datum + new_profile[i] + sigma * draw.normal();
            }
            start = end;
        }
    }

    /// What the scatter of the new profiles makes at each of some rows: the same at every checkpoint. Nothing is drawn for what is not there.
    fn new_profiles(&self, rows: &[usize], um: f64, draw: &mut Draw) -> Vec<f64> {
        let mut drawn: BTreeMap<_, f64> = BTreeMap::new();
        let mut at = |&row: &usize| {
            let o = &self.data.observations[row];
            if um == 0.0 || o.quantity != Quantity::WearDepth {
                return 0.0;
            }
            let face = o.face.map(FacePlace::key);
            let place = (
                o.member,
                face,
                o.tooth.clone(),
                o.position.map(f64::to_bits),
            );
            *drawn.entry(place).or_insert_with(|| um * draw.normal())
        };
        rows.iter().map(&mut at).collect()
    }
}

/// A curve as a machine sees it that tilts it by `tilt` from end to end and takes every radius for one larger by `shift`.
fn tilted_and_shifted(places: &[f64], values: &[f64], tilt: f64, shift: f64) -> Vec<f64> {
    let low = places.iter().copied().fold(f64::INFINITY, f64::min);
    let high = places.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by(|&a, &b| places[a].total_cmp(&places[b]));
    let at = |place: f64| {
        let after = order.partition_point(|&i| places[i] < place);
        let last = order.len() - 1;
        let [a, b] = [order[after.saturating_sub(1)], order[after.min(last)]];
        let width = places[b] - places[a];
        if width > 0.0 {
            values[a] + (values[b] - values[a]) * (place - places[a]) / width
        } else {
            values[a]
        }
    };
    let width = if high > low { high - low } else { 1.0 };
    (places.iter())
        .map(|&place| at(place - shift) + tilt * ((place - low) / width - 0.5))
        .collect()
}

/// Every row that is measured, without values.
fn places(study: &Study) -> Result<Dataset, CompareError> {
    let mut data = Dataset {
        name: "measurements.csv".to_owned(),
        tests: study.tests.iter().map(|test| test.id.clone()).collect(),
        observations: Vec::new(),
        traces: Vec::new(),
        reading: String::new(),
        outliers: Vec::new(),
        estimated_sigmas: 0,
    };
    for (number, test) in study.tests.iter().enumerate() {
        let pair = pair(study, test)?;
        let cycles = test.conditions.cycles;
        let rows = standard_test::rows((number, &test.id), &pair, cycles, &mut data.traces);
        data.observations.extend(rows);
    }
    Ok(data)
}

fn pair(study: &Study, test: &Test) -> Result<Pair, CompareError> {
    let mounted = study.gear_set().mount(test.conditions.misalignment_mm);
    Ok(mounted.map_err(crate::simulate::forward::ForwardError::from)?)
}

/// Random numbers of one test.
struct Draw(ChaCha8Rng);

impl Draw {
    /// Every test has a stream of its own, so that a test more or less changes no other.
    fn new(seed: u64, test: usize) -> Self {
        let mut source = ChaCha8Rng::seed_from_u64(seed);
        source.set_stream(test as u64);
        Self(source)
    }

    /// Uniform in (0, 1].
    fn uniform(&mut self) -> f64 {
        1.0 - (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Standard normal (Box and Muller 1958), by functions that give the same bits everywhere.
    fn normal(&mut self) -> f64 {
        let (u, v) = (self.uniform(), self.uniform());
        (-2.0 * libm::log(u)).sqrt() * libm::cos(2.0 * std::f64::consts::PI * v)
    }
}
