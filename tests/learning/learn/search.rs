//! The search: bounds, failures, economy, determinism.

use super::*;
use gearwear::learn::FitError;

fn running_in_data(seed: u64) -> Dataset {
    let empty = wear_data(&[("A", 1e6), ("B", 6e5)], 11, true);
    let mut random = Random(seed);
    measured(
        &empty,
        running_in,
        &[1.2e-10, 1.4e-10],
        &[2.5, 1.5e5],
        0.02,
        0.5,
        &mut random,
    )
}

fn problem<'a>(data: &'a Dataset, predictor: &'a dyn Predictor) -> Problem<'a> {
    Problem {
        data,
        roles: &[Role::Fit, Role::Fit],
        predictor,
        coefficient: Coefficient::Free(Parameter::coefficient(3e-10)),
        parameters: running_in_parameters(),
        noise: noise(Scatter::Estimate),
    }
}

/// The most probable state is a minimum: −ln posterior, written out here again, rises on every side of it.
#[test]
fn the_state_found_is_the_most_probable() {
    let data = running_in_data(1);
    let predictor = Formula {
        data: data.clone(),
        formula: running_in,
    };
    let mut problem = problem(&data, &predictor);
    problem.noise = noise(Scatter::Relative(0.1));
    let fit = problem
        .fit(&Effort {
            tolerance: 1e-10,
            carry: 0.0,
            ..Effort::default()
        })
        .unwrap();
    let objective = |x: &[f64]| -> f64 {
        let mut sum = 0.0;
        let residual = |o: &Observation| {
            let k = (x[0] + x[3 + o.test]).exp();
            o.value - running_in(o, k, &[x[1].exp(), x[2].exp()])
        };
        for trace in 0..data.traces.len() {
            // χ² with the datum integrated out: Σ z² − τ² (Σ r/σ²)²/(1 + τ² Σ 1/σ²).
            let rows = data.observations.iter().filter(|o| o.trace == Some(trace));
            let (mut z2, mut rw, mut w) = (0.0, 0.0, 0.0);
            for o in rows {
                let weight = o.sigma.powi(-2);
                z2 += residual(o).powi(2) * weight;
                rw += residual(o) * weight;
                w += weight;
            }
            sum += 0.5 * (z2 - 0.25 * rw * rw / (1.0 + 0.25 * w));
        }
        let priors = [
            ((x[0] - 3.2e-10f64.ln()) / 18f64.ln()),
            (x[1] - 2f64.ln()) / 3f64.ln(),
            (x[2] - 2e5f64.ln()) / 3f64.ln(),
        ];
        sum += 0.5 * priors.iter().map(|z| z * z).sum::<f64>();
        sum + 0.5 * x[3..].iter().map(|e| (e / 0.1).powi(2)).sum::<f64>()
    };
    let mut x = vec![
        fit.coefficient.ln(),
        fit.parameters[1].value.ln(),
        fit.parameters[2].value.ln(),
    ];
    x.extend(fit.tests.iter().map(|test| test.deviation));
    let least = objective(&x);
    // Forward differences of a 2 % step put the state up to some hundredths of a standard deviation off.
    for i in 0..x.len() {
        let sd = if i < 3 {
            fit.covariance[(i, i)].sqrt()
        } else {
            fit.tests[i - 3].sigma
        };
        for side in [-0.2, 0.2] {
            let mut y = x.clone();
            y[i] += side * sd;
            assert!(
                objective(&y) > least,
                "{i} {side}: {} {least}",
                objective(&y)
            );
        }
    }
}

#[test]
fn every_prediction_is_asked_for_once_and_counted() {
    let data = running_in_data(2);
    let predictor = Counting {
        inner: Formula {
            data: data.clone(),
            formula: running_in,
        },
        asked: Mutex::new(Vec::new()),
    };
    let fit = problem(&data, &predictor).fit(&Effort::default()).unwrap();
    let asked = predictor.asked.into_inner().unwrap();
    let different: HashSet<_> = asked.iter().cloned().collect();
    assert_eq!(asked.len(), different.len());
    assert_eq!(asked.len(), fit.evaluations);
    // Two tests, two parameters: at most five rounds of derivatives and twelve of values.
    assert!(fit.evaluations <= 2 * (5 * 3 + 12), "{}", fit.evaluations);
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let data = running_in_data(3);
    let predictor = Formula {
        data: data.clone(),
        formula: running_in,
    };
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| problem(&data, &predictor).fit(&Effort::default()).unwrap())
    };
    assert_eq!(with(1), with(4));
}

#[test]
fn a_fit_that_runs_into_a_bound_says_so() {
    let data = running_in_data(4);
    let predictor = Formula {
        data: data.clone(),
        formula: running_in,
    };
    let mut problem = problem(&data, &predictor);
    problem.parameters[0] = problem.parameters[0]
        .clone()
        .within(None, Some(1.5))
        .starting_at(1.0);
    let fit = problem.fit(&Effort::default()).unwrap();
    let amplitude = &fit.parameters[1];
    assert!(
        amplitude.at_bound && amplitude.value == 1.5,
        "{amplitude:?}"
    );
    assert!(amplitude.interval[1] <= 1.5 && amplitude.interval[0] < 1.5);
    assert!(fit.converged);
    assert!(!fit.parameters[2].at_bound);
}

#[test]
fn a_fit_cut_short_has_not_converged() {
    let data = running_in_data(5);
    let predictor = Formula {
        data: data.clone(),
        formula: running_in,
    };
    let fit = problem(&data, &predictor)
        .fit(&Effort {
            iterations: 1,
            ..Effort::default()
        })
        .unwrap();
    assert!(!fit.converged);
    assert_eq!(fit.iterations, 1);
}

/// A predictor without an answer for small decays, as a contact that cannot be solved: the fit goes around.
struct Fragile<P>(P, f64);

impl<P: Predictor> Predictor for Fragile<P> {
    fn predict(
        &self,
        test: usize,
        coefficient: f64,
        parameters: &[f64],
    ) -> Result<Vec<f64>, PredictError> {
        if coefficient > self.1 {
            return Err(PredictError {
                test: "A".to_owned(),
                reason: "no contact".to_owned(),
            });
        }
        self.0.predict(test, coefficient, parameters)
    }
}

#[test]
fn failing_predictions_are_stepped_around_or_reported() {
    let data = running_in_data(6);
    let formula = || Formula {
        data: data.clone(),
        formula: running_in,
    };
    let around = Fragile(formula(), 3.02e-10);
    let fit = problem(&data, &around).fit(&Effort::default()).unwrap();
    let plain = formula();
    let whole = problem(&data, &plain).fit(&Effort::default()).unwrap();
    assert!(fit.converged);
    assert!((fit.coefficient / whole.coefficient - 1.0).abs() < 1e-3);
    // where the first guess of k is too large for any answer, a smaller one is taken
    let below = Fragile(formula(), 2e-10);
    let fit = problem(&data, &below).fit(&Effort::default()).unwrap();
    assert!(fit.converged);
    assert!((fit.coefficient / whole.coefficient - 1.0).abs() < 1e-3);
    let nowhere = Fragile(formula(), 0.0);
    let error = problem(&data, &nowhere)
        .fit(&Effort::default())
        .unwrap_err();
    assert_eq!(
        error.to_string(),
        "the model cannot be fitted: test A: no contact"
    );
}

#[test]
fn values_of_the_wrong_number_or_not_finite_are_refused() {
    struct Short;
    impl Predictor for Short {
        fn predict(&self, _: usize, _: f64, _: &[f64]) -> Result<Vec<f64>, PredictError> {
            Ok(vec![1.0])
        }
    }
    let data = running_in_data(7);
    let error = problem(&data, &Short).fit(&Effort::default()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the model cannot be fitted: test A: 1 values predicted for 110 observations"
    );
    let nan = Formula {
        data: data.clone(),
        formula: |_: &Observation, _: f64, _: &[f64]| f64::NAN,
    };
    let error = problem(&data, &nan)
        .fit(&Effort::default())
        .unwrap_err()
        .to_string();
    assert!(
        error.ends_with("the prediction of its observation 1 is not finite"),
        "{error}"
    );
    let formula = Formula {
        data: data.clone(),
        formula: running_in,
    };
    let mut none = problem(&data, &formula);
    none.roles = &[Role::Holdout, Role::Holdout];
    assert_eq!(
        none.fit(&Effort::default()).unwrap_err(),
        FitError::NoObservations
    );
}

/// 1 + p n/1e5, with answers below 0.05 only.
fn sloped(o: &Observation, k: f64, p: &[f64]) -> f64 {
    let factor = if p[0].abs() < 0.05 {
        1.0 + p[0] * o.cycles / 1e5
    } else {
        f64::NAN
    };
    factor * steady(o, k, &[])
}

/// Differences as wide as its prior suggests leave the narrow domain of a law on both sides; from the lower bound on, on the one, and on the other lies
/// nothing.
#[test]
fn a_law_with_a_narrow_domain_is_fitted_within_it() {
    let empty = wear_data(&[("A", 1e6), ("B", 6e5)], 11, true);
    let truth = [0.03];
    let data = measured(
        &empty,
        sloped,
        &[1.2e-10, 1.4e-10],
        &truth,
        0.02,
        0.5,
        &mut Random(9),
    );
    let predictor = Formula {
        data: data.clone(),
        formula: sloped,
    };
    for lower in [-10.0, 0.0] {
        let mut problem = problem(&data, &predictor);
        problem.parameters = vec![Parameter {
            name: "a".to_owned(),
            unit: "-".to_owned(),
            start: 0.0,
            lower,
            upper: 10.0,
            prior: gearwear::effects::Prior::Normal { mean: 0.0, sd: 5.0 },
        }];
        let fit = problem.fit(&Effort::default()).unwrap();
        let a = &fit.parameters[1];
        assert!(
            fit.converged && (a.value - truth[0]).abs() < 4.0 * a.sigma && a.sigma < 0.01,
            "{a:?}"
        );
    }
}

/// Wear that waves with the cycles.
fn waved(o: &Observation, k: f64, p: &[f64]) -> f64 {
    (1.0 + 0.5 * (o.cycles / 2e5 + p[0]).cos()) * steady(o, k, &[])
}

/// An angle has no end: from the other side of ±π a fit reaches the same place, with the same evidence, as from near by.
#[test]
fn a_phase_is_found_across_the_end_of_its_turn() {
    let empty = wear_data(&[("A", 1e6), ("B", 6e5)], 11, true);
    for truth in [3.0, -3.0] {
        let data = measured(
            &empty,
            waved,
            &[1.2e-10, 1.4e-10],
            &[truth],
            0.02,
            0.5,
            &mut Random(4),
        );
        let predictor = Formula {
            data: data.clone(),
            formula: waved,
        };
        let ends = [truth * 0.8, -truth * 0.8].map(|start| {
            let mut problem = problem(&data, &predictor);
            problem.parameters = vec![Parameter::uniform("phase", "rad", start, -PI, PI)];
            let fit = problem
                .fit(&Effort {
                    tolerance: 1e-8,
                    carry: 0.0,
                    ..Effort::default()
                })
                .unwrap();
            let phase = fit.parameters[1].clone();
            assert!(fit.converged && !phase.at_bound, "{phase:?}");
            assert!((phase.value - truth).abs() < 4.0 * phase.sigma, "{phase:?}");
            (phase.value, fit.log_evidence)
        });
        assert!((ends[0].0 - ends[1].0).abs() < 1e-3, "{ends:?}");
        assert!((ends[0].1 - ends[1].1).abs() < 1e-2, "{ends:?}");
    }
}

/// One test says nothing of scatter: its own k is known as well as ever, the common one only within the scatter's prior.
#[test]
fn one_test_leaves_the_common_k_within_the_scatter() {
    let empty = wear_data(&[("A", 1e6)], 11, true);
    let data = measured(&empty, steady, &[1.2e-10], &[], 0.02, 0.5, &mut Random(8));
    let predictor = Formula {
        data: data.clone(),
        formula: steady,
    };
    let fit = Problem {
        data: &data,
        roles: &[Role::Fit],
        predictor: &predictor,
        coefficient: Coefficient::Free(Parameter::coefficient(1e-10)),
        parameters: Vec::new(),
        noise: noise(Scatter::Estimate),
    }
    .fit(&Effort::default())
    .unwrap();
    assert!(fit.converged);
    let own = &fit.tests[0];
    assert!((own.coefficient / 1.2e-10).ln().abs() < 3.0 * own.sigma);
    assert!(fit.tests[0].sigma < 0.01, "{}", fit.tests[0].sigma);
    // The posterior of σ_k is its prior; var(ln k) = E[σ_k²] = 0.25².
    let sd = fit.covariance[(0, 0)].sqrt();
    assert!((sd - 0.25).abs() < 0.02, "{sd}");
    assert!((fit.scatter - 0.25).abs() < 0.01, "{}", fit.scatter);
}

/// A second start finds what the first cannot leave.
#[test]
fn the_best_of_several_starts_is_kept() {
    let two_hills = |o: &Observation, _: f64, p: &[f64]| {
        shape(o) * (-((p[0] - 3.0) / 0.5).powi(2)).exp()
            + 0.3 * shape(o) * (-((p[0] + 3.0) / 0.5).powi(2)).exp()
    };
    let empty = wear_data(&[("A", 1e6)], 11, false);
    let data = measured(&empty, two_hills, &[1.0], &[3.0], 0.02, 0.0, &mut Random(9));
    let predictor = Formula {
        data: data.clone(),
        formula: two_hills,
    };
    let problem = Problem {
        data: &data,
        roles: &[Role::Fit],
        predictor: &predictor,
        coefficient: Coefficient::Fixed(1e-10),
        parameters: vec![Parameter::uniform("a.place", "mm", -3.2, -10.0, 10.0)],
        noise: noise(Scatter::Relative(0.0)),
    };
    let one = problem.fit(&Effort::default()).unwrap();
    assert!(
        (one.parameters[0].value + 3.0).abs() < 0.5,
        "{:?}",
        one.parameters
    );
    let best = problem
        .fit_from(&[vec![-3.2], vec![2.6]], &Effort::default())
        .unwrap();
    assert!(
        (best.parameters[0].value - 3.0).abs() < 0.1,
        "{:?}",
        best.parameters
    );
}

/// Of two places, one where the tests differ by a law and one where each needs a k of its own, the law is taken though the other comes a little
/// nearer to the measurements: only the evidence counts what a scatter of k costs.
#[test]
fn a_law_is_taken_before_a_scatter_of_k() {
    let near = |x: f64| (-(x / 0.5).powi(2)).exp();
    let wave = |o: &Observation| 0.006 * (3.0 * o.position.unwrap_or(0.0)).sin();
    let by_law = |o: &Observation, k: f64| steady(o, k, &[]) * [0.6, 1.6, 0.7, 1.8][o.test];
    let model = move |o: &Observation, k: f64, p: &[f64]| {
        let own = [0.6f64, 1.6, 0.7, 1.8][o.test].ln();
        steady(o, k, &[]) * (near(p[0] - 3.0) * own).exp() * (1.0 + near(p[0] + 3.0) * wave(o))
    };
    let empty = wear_data(&[("A", 1e6), ("B", 6e5), ("C", 1e6), ("D", 6e5)], 11, true);
    let data = measured(
        &empty,
        |o, k, _| by_law(o, k) * (1.0 + wave(o)),
        &[1.2e-10; 4],
        &[],
        0.02,
        0.5,
        &mut Random(10),
    );
    let predictor = Formula {
        data: data.clone(),
        formula: model,
    };
    let problem = Problem {
        data: &data,
        roles: &[Role::Fit; 4],
        predictor: &predictor,
        coefficient: Coefficient::Free(Parameter::coefficient(1e-10)),
        parameters: vec![Parameter::uniform("a.place", "mm", -3.0, -10.0, 10.0)],
        noise: noise(Scatter::Estimate),
    };
    let fit = |starts: &[f64]| {
        let starts: Vec<Vec<f64>> = starts.iter().map(|&start| vec![start]).collect();
        problem.fit_from(&starts, &Effort::default()).unwrap()
    };
    let [scattered, lawful] = [-3.0, 2.8].map(|start| fit(&[start]));
    assert!(scattered.scatter > 0.2, "{}", scattered.scatter);
    assert!(scattered.log_posterior > lawful.log_posterior + 1.0);
    for starts in [[-3.0, 2.8], [2.8, -3.0]] {
        let best = fit(&starts);
        assert!((best.parameters[1].value - 3.0).abs() < 0.2);
        assert!(best.scatter < 0.1, "{}", best.scatter);
    }
}

/// A parameter without influence keeps its prior.
#[test]
fn what_the_data_do_not_touch_stays_as_uncertain_as_before() {
    let data = running_in_data(10);
    let idle = |o: &Observation, k: f64, _: &[f64]| running_in(o, k, &[2.5, 1.5e5]);
    let predictor = Formula {
        data: data.clone(),
        formula: idle,
    };
    let mut problem = problem(&data, &predictor);
    problem.parameters[1] = Parameter::uniform("a.idle", "-", 0.5, 0.0, 1.0);
    let exact = Effort {
        carry: 0.0,
        ..fine()
    };
    let with = problem.fit(&exact).unwrap();
    assert!((with.parameters[1].interval[0] / (2.0 * 3f64.powf(-1.96)) - 1.0).abs() < 0.01);
    assert!(
        (with.parameters[2].interval[0] - 0.025).abs() < 1e-3
            && (with.parameters[2].interval[1] - 0.975).abs() < 1e-3
    );
    assert!((with.parameters[2].sigma - 12f64.sqrt().recip()).abs() < 1e-9);
    problem.parameters.clear();
    let without = problem.fit(&exact).unwrap();
    assert!(
        (with.log_evidence - without.log_evidence).abs() < 1e-3,
        "{} {}",
        with.log_evidence,
        without.log_evidence
    );
}

/// Where a model is far from its measurements a fit stops earlier, with no more of the posterior lost than that share of the misfit beyond
/// noise; where it is near, nothing changes.
#[test]
fn a_model_far_from_its_measurements_is_not_fitted_to_the_last_decimal() {
    let near = running_in_data(1);
    let mut far = near.clone();
    for (i, o) in far.observations.iter_mut().enumerate() {
        o.value += 20.0 * o.sigma * (2.0 * i as f64).sin();
    }
    let fitted = |data: &Dataset, share: f64| {
        let predictor = Formula {
            data: data.clone(),
            formula: running_in,
        };
        let effort = Effort {
            share,
            ..Effort::default()
        };
        problem(data, &predictor).fit(&effort).unwrap()
    };
    let share = 3e-3;
    let (whole, early) = (fitted(&far, 0.0), fitted(&far, share));
    assert!(early.evaluations < whole.evaluations);
    let square: f64 = (whole.rows.iter())
        .map(|row| row.standardised.powi(2))
        .sum();
    let beyond = 0.5 * (square - whole.rows.len() as f64);
    let lost = whole.log_posterior - early.log_posterior;
    assert!(
        beyond > 1000.0 && lost < share * beyond,
        "{lost} of {beyond}"
    );
    let (whole, early) = (fitted(&near, 0.0), fitted(&near, share));
    assert!((whole.log_posterior - early.log_posterior).abs() < 0.1);
}

/// Near the most probable state a fit asks for no further prediction, and ends where one that asks for many does.
#[test]
fn short_last_steps_go_along_the_derivatives() {
    // so many points that two standard deviations are less than a forward difference
    let empty = wear_data(&[("A", 1e6), ("B", 6e5)], 201, false);
    let (k, theta) = ([1.2e-10; 2], [2.5, 1.5e5]);
    let data = measured(&empty, running_in, &k, &theta, 0.01, 0.0, &mut Random(6));
    let predictor = Counting {
        inner: Differentiated(Formula {
            data: data.clone(),
            formula: running_in,
        }),
        asked: Mutex::new(Vec::new()),
    };
    let mut near = problem(&data, &predictor);
    near.noise = noise(Scatter::Relative(0.0));
    let exact = near
        .fit(&Effort {
            tolerance: 1e-12,
            carry: 0.0,
            ..Effort::default()
        })
        .unwrap();
    // opposite ways, for what is known best is their sum
    let off = [0.3, -0.3];
    near.coefficient = Coefficient::Free(Parameter::coefficient(exact.coefficient));
    for (i, parameter) in near.parameters.iter_mut().enumerate() {
        let sd = exact.covariance[(i + 1, i + 1)].sqrt();
        parameter.start = exact.parameters[i + 1].value * (off[i] * sd).exp();
    }
    predictor.asked.lock().unwrap().clear();
    let fit = near.fit(&Effort::for_simulations()).unwrap();
    assert!(fit.converged && fit.iterations > 0);
    assert!(predictor.asked.lock().unwrap().is_empty());
    for i in 0..2 {
        let sd = exact.covariance[(i + 1, i + 1)].sqrt();
        let [found, wanted] = [&fit, &exact].map(|f| f.parameters[i + 1].value.ln());
        assert!(
            ((found - wanted) / sd).abs() < 0.05,
            "{i}: {found} {wanted} {sd}"
        );
    }
    let theta: Vec<f64> = fit.parameters[1..].iter().map(|p| p.value).collect();
    for (o, row) in data.observations.iter().zip(&fit.rows) {
        let own = running_in(o, fit.coefficient, &theta);
        assert!(
            (row.model - own).abs() < 0.02 * o.sigma,
            "{} {own}",
            row.model
        );
    }
}

/// A model with derivatives of its own.
struct Differentiated<P>(P);

impl<P: Predictor> Predictor for Differentiated<P> {
    fn predict(&self, test: usize, k: f64, parameters: &[f64]) -> Result<Vec<f64>, PredictError> {
        self.0.predict(test, k, parameters)
    }

    fn has_derivatives(&self) -> bool {
        true
    }

    fn linearise(
        &self,
        test: usize,
        k: f64,
        parameters: &[f64],
        moves: &[Move],
    ) -> Option<Result<Linearised, PredictError>> {
        const STEP: f64 = 1e-6;
        let at = |k: f64, parameters: &[f64]| self.0.predict(test, k, parameters).unwrap();
        let values = at(k, parameters);
        let mut columns: Vec<DVector<f64>> = Vec::new();
        for a_move in moves {
            let moved = at(k, &a_move.parameters);
            let each = moved
                .iter()
                .zip(&values)
                .map(|(a, b)| (a - b) / a_move.step);
            columns.push(DVector::from_iterator(values.len(), each));
        }
        let sides = at(k * STEP.exp(), parameters)
            .into_iter()
            .zip(at(k * (-STEP).exp(), parameters));
        let by_k = sides.map(|(a, b)| (a - b) / (2.0 * STEP));
        columns.push(DVector::from_iterator(values.len(), by_k));
        Some(Ok(Linearised {
            derivatives: DMatrix::from_columns(&columns),
            values,
        }))
    }
}
