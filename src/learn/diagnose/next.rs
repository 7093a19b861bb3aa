//! The next experiment: the feasible test in which two candidates, each as fitted, would differ most after refitting.
//!
//! ```text
//! D = vᵀ (S + C Cᵀ)⁻¹ v      v = f_a − f_b by the analytic model
//! S: noise of such a test, model error among it;  C: columns of what refitting can still move: both candidates'
//! parameters with their posterior covariance, k of the test with its scatter
//! ```
//! D is the expected difference of χ² between the two once the test is there.

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::anchored::model;
use super::judge::{Judge, Judged};
use super::verdict::{NextExperiment, NextTest};
use crate::learn::bench::{Bench, MeasuredTest, Workshop};
use crate::learn::noise::Covariance;
use crate::learn::predictor::{PredictError, Predictor};
use crate::measure::{Dataset, Observation, Quantity, Trace};
use crate::study::Operation;

/// Factors on torque and speed, misalignments added (mm), factor on the length.
const TORQUES: [f64; 3] = [1.0, 0.5, 2.0];
const SPEEDS: [f64; 3] = [1.0, 0.3, 3.0];
const MISALIGNMENTS: [f64; 3] = [0.0, 0.3, 0.6];
const LONGER: f64 = 3.0;
/// Expected χ² from which more is of no use: the two are then told apart for certain.
const ENOUGH: f64 = 60.0;
/// A simpler test is preferred to one that gives up to this much more.
const NEARLY: f64 = 0.8;
/// Least scatter of k assumed of a new test.
const LEAST_SCATTER: f64 = 0.05;

/// The most telling feasible test for two candidates.
pub(super) fn experiment(
    judge: &Judge<'_>,
    shop: &Workshop,
    a: &Judged,
    b: &Judged,
) -> Option<NextExperiment> {
    let mut tests: Vec<(usize, Operation)> = grid(judge);
    let existing: Vec<Operation> = judge
        .ground
        .tests
        .iter()
        .map(|&test| judge.ground.measured.study().tests[test].conditions)
        .collect();
    let count = tests.len();
    tests.extend(existing.into_iter().map(|operation| (0, operation)));
    let found: Vec<Option<Told>> = tests
        .par_iter()
        .map(|(_, operation)| told(judge, shop, operation, a, b))
        .collect();
    let repetition = found[count..]
        .iter()
        .flatten()
        .map(|t| t.chi2)
        .fold(0.0, f64::max);
    let best = found[..count]
        .iter()
        .flatten()
        .map(|t| t.chi2.min(ENOUGH))
        .fold(0.0, f64::max);
    let chosen = (0..count)
        .filter(|&i| {
            found[i]
                .as_ref()
                .is_some_and(|t| t.chi2.min(ENOUGH) >= NEARLY * best)
        })
        .min_by_key(|&i| tests[i].0)?;
    let (operation, told) = (&tests[chosen].1, found[chosen].as_ref()?);
    let names = [a.candidate.name(), b.candidate.name()];
    let test = NextTest {
        torque: 1e-3 * operation.torque_nmm,
        speed: operation.speed_rpm,
        misalignment: operation.misalignment_mm,
        cycles: operation.cycles,
        reversed: operation.reversed,
    };
    Some(NextExperiment {
        why: sentence(judge, &test, &names, told, repetition),
        separates: names.to_vec(),
        test,
        expected_chi2: told.chi2,
        repetition_chi2: repetition,
    })
}

/// Feasible tests with their number of changes against the study's operation, the plainest first.
fn grid(judge: &Judge<'_>) -> Vec<(usize, Operation)> {
    let study = judge.ground.measured.study();
    let longest = (judge.ground.tests.iter())
        .map(|&t| study.tests[t].conditions.cycles)
        .fold(0.0, f64::max);
    let plain = Operation {
        cycles: longest,
        ..study.operation
    };
    let mut all = Vec::new();
    for (t, torque) in TORQUES.into_iter().enumerate() {
        for (s, speed) in SPEEDS.into_iter().enumerate() {
            for (m, misalignment) in MISALIGNMENTS.into_iter().enumerate() {
                let changes = [t, s, m].into_iter().filter(|i| *i > 0).count();
                if changes > 2 {
                    continue;
                }
                let operation = Operation {
                    torque_nmm: plain.torque_nmm * torque,
                    speed_rpm: plain.speed_rpm * speed,
                    misalignment_mm: plain.misalignment_mm + misalignment,
                    ..plain
                };
                all.push((changes, operation));
            }
        }
    }
    all.push((
        1,
        Operation {
            cycles: LONGER * longest,
            ..plain
        },
    ));
    all.push((
        1,
        Operation {
            reversed: !plain.reversed,
            ..plain
        },
    ));
    all.sort_by_key(|(changes, _)| *changes);
    all
}

/// How two candidates differ in a test.
struct Told {
    chi2: f64,
    /// Largest difference of wear depths, µm, with the member and the cycles.
    largest: f64,
    member: &'static str,
    cycles: f64,
}

fn told(
    judge: &Judge<'_>,
    shop: &Workshop,
    operation: &Operation,
    a: &Judged,
    b: &Judged,
) -> Option<Told> {
    let measured = judge.ground.measured;
    let study = measured.study();
    let (mut observations, traces, relative) = layout(judge, operation.cycles)?;
    let test = MeasuredTest {
        id: "next".to_owned(),
        conditions: operation.simulated(&study.wear),
        surroundings: study.surroundings(operation),
        reversed: operation.reversed,
        observations: observations.clone(),
    };
    let bench = shop.bench(vec![test]).ok()?;
    let (fa, ca) = columns(&bench, a).ok()?;
    let (fb, cb) = columns(&bench, b).ok()?;
    for (i, o) in observations.iter_mut().enumerate() {
        o.value = 0.5 * (fa[i] + fb[i]);
    }
    noise_of(&mut observations, &relative);
    let data = Dataset {
        name: String::new(),
        tests: vec!["next".to_owned()],
        observations,
        traces,
    };
    let rows: Vec<usize> = (0..data.observations.len()).collect();
    let covariance = Covariance::new(&data, &rows, &judge.ground.noise);
    let v: Vec<f64> = fa.iter().zip(&fb).map(|(a, b)| a - b).collect();
    let white = DVector::from_vec(covariance.whiten(&v));
    let all = DMatrix::from_columns(
        &ca.iter()
            .chain(&cb)
            .map(|c| DVector::from_vec(covariance.whiten(c.as_slice())))
            .collect::<Vec<_>>(),
    );
    let along = all.tr_mul(&white);
    let inner = DMatrix::identity(all.ncols(), all.ncols()) + all.tr_mul(&all);
    let absorbed = inner
        .cholesky()
        .map_or(0.0, |f| along.dot(&f.solve(&along)));
    let depth = |i: &usize| data.observations[*i].quantity == Quantity::WearDepth;
    let largest = rows
        .iter()
        .copied()
        .filter(depth)
        .max_by(|&i, &j| v[i].abs().total_cmp(&v[j].abs()));
    let place = largest.map(|i| &data.observations[i]);
    Some(Told {
        chi2: (white.norm_squared() - absorbed).max(0.0),
        largest: largest.map_or(0.0, |i| v[i].abs()),
        member: place.map_or("pair", |o| o.member.name()),
        cycles: place.map_or(operation.cycles, |o| o.cycles),
    })
}

/// Predictions and the columns of what refitting can still move.
fn columns(
    bench: &Bench<'_>,
    judged: &Judged,
) -> Result<(Vec<f64>, Vec<DVector<f64>>), PredictError> {
    let predictor = model(bench, &judged.candidate);
    let parameters = &judged.candidate.parameters;
    let state = &judged.found.state;
    let values = |theta: &[f64]| -> Vec<f64> {
        parameters
            .iter()
            .zip(theta)
            .map(|(p, &x)| p.value(x))
            .collect()
    };
    let k = state.log_k.exp();
    let at = predictor.predict(0, k, &values(&state.theta))?;
    let mut jacobian = DMatrix::zeros(at.len(), parameters.len());
    for (p, parameter) in parameters.iter().enumerate() {
        let step = parameter.difference(state.theta[p]);
        let mut theta = state.theta.clone();
        theta[p] += step;
        let moved = predictor.predict(0, k, &values(&theta))?;
        for (i, (moved, at)) in moved.iter().zip(&at).enumerate() {
            jacobian[(i, p)] = (moved - at) / parameter.divisor(step);
        }
    }
    let mut columns: Vec<DVector<f64>> = Vec::new();
    if !parameters.is_empty() {
        let count = parameters.len();
        let first = judged.covariance.nrows() - count;
        let own = judged.covariance.view((first, first), (count, count));
        let eigen = own.into_owned().symmetric_eigen();
        columns.extend((0..count).map(|i| {
            &jacobian * eigen.eigenvectors.column(i) * eigen.eigenvalues[i].max(0.0).sqrt()
        }));
    }
    // Worn depths are nearly proportional to k.
    let scatter = judged.found.scatter.max(LEAST_SCATTER);
    columns.push(DVector::from_iterator(
        at.len(),
        at.iter().map(|f| f * scatter),
    ));
    Ok((at, columns))
}

/// The measurements of such a test: those of the fit test with most rows, its cycles stretched; and each row's sigma over the
/// largest value of its curve.
fn layout(judge: &Judge<'_>, cycles: f64) -> Option<(Vec<Observation>, Vec<Trace>, Vec<f64>)> {
    let data = &judge.ground.measured.data;
    let study = judge.ground.measured.study();
    let most = judge.ground.tests.iter().copied().max_by_key(|&t| {
        (
            data.observations.iter().filter(|o| o.test == t).count(),
            usize::MAX - t,
        )
    })?;
    let stretch = cycles / study.tests[most].conditions.cycles;
    let own: Vec<&Observation> = data
        .observations
        .iter()
        .filter(|o| o.test == most)
        .collect();
    let relative = own
        .iter()
        .map(|o| {
            let curve = own.iter().filter(|p| {
                (p.member, p.quantity, p.cycles.to_bits())
                    == (o.member, o.quantity, o.cycles.to_bits())
            });
            let largest = curve.map(|p| p.value.abs()).fold(0.0, f64::max);
            if largest > 0.0 {
                o.sigma / largest
            } else {
                1.0
            }
        })
        .collect();
    let observations = own
        .iter()
        .map(|o| Observation {
            test: 0,
            cycles: o.cycles * stretch,
            ..(*o).clone()
        })
        .collect();
    Some((observations, data.traces.clone(), relative))
}

/// Sets sigmas as large, relative to each curve, as in the measurements there are.
fn noise_of(observations: &mut [Observation], relative: &[f64]) {
    let key = |o: &Observation| (o.member, o.quantity, o.cycles.to_bits());
    let mut largest = std::collections::BTreeMap::new();
    for o in observations.iter() {
        let entry: &mut f64 = largest.entry(key(o)).or_insert(0.0);
        *entry = entry.max(o.value.abs());
    }
    for (o, relative) in observations.iter_mut().zip(relative) {
        o.sigma = (relative * largest[&key(o)]).max(1e-9);
    }
}

fn sentence(
    judge: &Judge<'_>,
    test: &NextTest,
    names: &[String; 2],
    told: &Told,
    repetition: f64,
) -> String {
    let study = judge.ground.measured.study();
    let plain = &study.operation;
    let mut changed = Vec::new();
    let differs = |a: f64, b: f64| (a - b).abs() > 1e-6 * b.abs().max(1e-6);
    if differs(test.torque, 1e-3 * plain.torque_nmm) {
        changed.push(format!("{} N·m", test.torque));
    }
    if differs(test.speed, plain.speed_rpm) {
        changed.push(format!("{} rpm", test.speed));
    }
    if differs(test.misalignment, plain.misalignment_mm) {
        changed.push(format!("misalignment {} mm", test.misalignment));
    }
    if test.reversed != plain.reversed {
        changed.push("the drive reversed".to_owned());
    }
    if changed.is_empty() {
        changed.push(format!(
            "{:.2e} cycles at the study's operation",
            test.cycles
        ));
    }
    let strength = if told.chi2 >= 20.0 {
        "enough to tell them apart"
    } else if told.chi2 >= 6.0 {
        "enough to favour one clearly"
    } else {
        "still little: other measurements are needed"
    };
    format!(
        "A test with {} separates {} from {}: after refitting they differ there by χ² {:.0}, {strength} (a repetition of a test made already: {:.0}); the largest difference, {:.2} µm, is on the {} after {:.2e} cycles.",
        changed.join(", "),
        names[0],
        names[1],
        told.chi2,
        repetition,
        told.largest,
        told.member,
        told.cycles
    )
}
