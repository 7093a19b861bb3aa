//! Claim: fits, their uncertainty and their evidence are those of the stated probability model.
//!
//! Source: closed forms of linear Gaussian models (Rasmussen and Williams 2006, Section 2.1; Bishop 2006, Eqs. 2.113 to 2.117),
//! brute-force integrals, and repeated draws of known truth. The models predicted with are formulas, no solver takes part.
//! Tolerances: rounding (1e-6 or less) where the linear form is exact; 1 to 2 % where a forward difference, a parabola in place of a
//! posterior or a finite number of draws stands in between; each is given where it is used.

use std::collections::HashSet;
use std::f64::consts::PI;
use std::sync::Mutex;

use gearwear::effects::Prior;
use gearwear::learn::{
    Coefficient, Effort, Fit, Linearised, ModelError, Move, NoiseModel, Parameter, PredictError,
    Predictor, Problem, SigmaModel,
};
use gearwear::measure::{Dataset, Observation, Quantity, Subject, Trace};
use gearwear::study::{Role, Scatter};
use nalgebra::{DMatrix, DVector};

mod coverage;
mod exact;
mod search;
mod story;

/// A predictor by a function of (observations of the test, coefficient, parameters).
struct Formula<F> {
    data: Dataset,
    formula: F,
}

impl<F> Predictor for Formula<F>
where
    F: Fn(&Observation, f64, &[f64]) -> f64 + Sync,
{
    fn predict(
        &self,
        test: usize,
        coefficient: f64,
        parameters: &[f64],
    ) -> Result<Vec<f64>, PredictError> {
        let rows = self.data.observations.iter().filter(|o| o.test == test);
        Ok(rows
            .map(|o| (self.formula)(o, coefficient, parameters))
            .collect())
    }
}

/// A predictor that remembers what it was asked.
struct Counting<P> {
    inner: P,
    asked: Mutex<Vec<Vec<u64>>>,
}

impl<P: Predictor> Predictor for Counting<P> {
    fn predict(
        &self,
        test: usize,
        coefficient: f64,
        parameters: &[f64],
    ) -> Result<Vec<f64>, PredictError> {
        let mut key = vec![test as u64, coefficient.to_bits()];
        key.extend(parameters.iter().map(|p| p.to_bits()));
        self.asked.lock().unwrap().push(key);
        self.inner.predict(test, coefficient, parameters)
    }

    fn has_derivatives(&self) -> bool {
        self.inner.has_derivatives()
    }

    fn linearise(
        &self,
        test: usize,
        coefficient: f64,
        parameters: &[f64],
        moves: &[Move],
    ) -> Option<Result<Linearised, PredictError>> {
        self.inner.linearise(test, coefficient, parameters, moves)
    }
}

/// Random numbers: splitmix64 (Steele, Lea and Flood 2014) and Box and Muller's transform.
struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        let (u, v) = (1.0 - self.uniform(), self.uniform());
        (-2.0 * u.ln()).sqrt() * (2.0 * PI * v).cos()
    }
}

/// Depths on pinion and gear of each test at five checkpoints, one trace each if wanted; the values are still to be set.
fn wear_data(tests: &[(&str, f64)], points: usize, traces: bool) -> Dataset {
    let mut data = Dataset {
        name: "measurements.csv".to_owned(),
        tests: tests.iter().map(|(id, _)| (*id).to_owned()).collect(),
        observations: Vec::new(),
        traces: Vec::new(),
        reading: String::new(),
        outliers: Vec::new(),
        estimated_sigmas: 0,
    };
    for (test, (id, cycles)) in tests.iter().enumerate() {
        for (member, low) in [(Subject::Pinion, 26.0), (Subject::Gear, 52.0)] {
            for checkpoint in 1..=5 {
                let trace = data.traces.len();
                let line = data.observations.len() + 2;
                if traces {
                    data.traces.push(Trace {
                        name: format!("{id}-{}-{checkpoint}", member.name()),
                        quantity: Quantity::WearDepth,
                        line,
                    });
                }
                for point in 0..points {
                    data.observations.push(Observation {
                        test,
                        member,
                        cycles: cycles * f64::from(checkpoint) / 5.0,
                        quantity: Quantity::WearDepth,
                        position: Some(low + 3.0 * point as f64 / (points - 1) as f64),
                        value: 0.0,
                        sigma: 0.1,
                        trace: traces.then_some(trace),
                        face: None,
                        tooth: None,
                        line: line + point,
                    });
                }
            }
        }
    }
    data
}

/// A shape of the wear along the flank, least in the middle.
fn shape(o: &Observation) -> f64 {
    let at = o.position.unwrap();
    let s = if at < 40.0 {
        (at - 27.4) / 1.5
    } else {
        (at - 53.4) / 1.5
    };
    0.3 + s * s
}

/// Steady wear, µm: 4 µm where the shape is 1 after 1e6 cycles at 1e-10 mm²/N.
fn steady(o: &Observation, k: f64, _: &[f64]) -> f64 {
    4.0 * (k / 1e-10) * (o.cycles / 1e6) * shape(o)
}

/// Running-in (Queener, Smith and Mitchell 1965): the integral of k (1 + A exp(−n/N)).
fn running_in(o: &Observation, k: f64, p: &[f64]) -> f64 {
    let excess = p[0] * p[1] * (1.0 - (-o.cycles / p[1]).exp());
    4.0 * (k / 1e-10) * ((o.cycles + excess) / 1e6) * shape(o)
}

fn running_in_parameters() -> Vec<Parameter> {
    let amplitude = Parameter {
        name: "running_in.amplitude".to_owned(),
        unit: "-".to_owned(),
        start: 3.0,
        lower: 0.0,
        upper: 50.0,
        prior: Prior::LogNormal {
            median: 2.0,
            spread: 3.0,
        },
    };
    let decay = Parameter {
        name: "running_in.decay_cycles".to_owned(),
        unit: "cycles".to_owned(),
        start: 2e5,
        lower: 1e3,
        upper: 1e8,
        prior: Prior::LogNormal {
            median: 2e5,
            spread: 3.0,
        },
    };
    vec![amplitude, decay]
}

fn noise(scatter: Scatter) -> NoiseModel {
    NoiseModel {
        datum_um: 0.5,
        tilt_um: 0.0,
        shift_mm: 0.0,
        new_profile_um: 0.0,
        sigma: SigmaModel::AS_STATED,
        scatter,
        model_error: None,
    }
}

/// Values of a formula with each test's coefficient, noise of `relative` of the largest depth of each member and checkpoint
/// plus 0.02 µm (also its sigma), and datums of `datum` µm.
fn measured<F>(
    data: &Dataset,
    formula: F,
    ks: &[f64],
    p: &[f64],
    relative: f64,
    datum: f64,
    random: &mut Random,
) -> Dataset
where
    F: Fn(&Observation, f64, &[f64]) -> f64,
{
    let mut data = data.clone();
    let exact: Vec<f64> = data
        .observations
        .iter()
        .map(|o| formula(o, ks[o.test], p))
        .collect();
    let offsets: Vec<f64> = data
        .traces
        .iter()
        .map(|_| datum * random.normal())
        .collect();
    let curves: Vec<_> = data
        .observations
        .iter()
        .map(|o| (o.test, o.member, o.cycles.to_bits()))
        .collect();
    for (i, o) in data.observations.iter_mut().enumerate() {
        let own = exact
            .iter()
            .zip(&curves)
            .filter(|(_, curve)| **curve == curves[i]);
        o.sigma = 0.02 + relative * own.map(|(value, _)| value.abs()).fold(0.0, f64::max);
        o.value = exact[i] + o.trace.map_or(0.0, |t| offsets[t]) + o.sigma * random.normal();
    }
    data
}

/// Chi square per point of the tests with a role.
fn chi2(fit: &Fit, data: &Dataset, roles: &[Role], role: Role) -> f64 {
    let z: Vec<f64> = data
        .observations
        .iter()
        .zip(&fit.rows)
        .filter(|(o, _)| roles[o.test] == role)
        .map(|(_, row)| row.standardised.powi(2))
        .collect();
    z.iter().sum::<f64>() / z.len() as f64
}

/// Derivatives, tolerance and all to the last digit.
fn fine() -> Effort {
    Effort {
        tolerance: 1e-12,
        floor: 1e-10,
        ..Effort::default()
    }
}
