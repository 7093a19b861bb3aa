//! Linear Gaussian models: everything in closed form.

use super::*;

/// f = θ_1 b_1 + θ_2 b_2 with normal priors, no k.
fn linear(o: &Observation, _: f64, p: &[f64]) -> f64 {
    p[0] * shape(o) + p[1] * (o.cycles / 1e6)
}

fn normal_parameter(name: &str, mean: f64, sd: f64) -> Parameter {
    Parameter {
        name: name.to_owned(),
        unit: "um".to_owned(),
        start: 0.0,
        lower: -1e6,
        upper: 1e6,
        prior: Prior::Normal { mean, sd },
    }
}

/// The covariance of the measurements at given parameters, row by row from its definition.
fn covariance(data: &Dataset, noise: &NoiseModel) -> DMatrix<f64> {
    let n = data.observations.len();
    let curve_top = |o: &Observation| {
        let same = |p: &&Observation| (p.test, p.member, p.cycles) == (o.test, o.member, o.cycles);
        data.observations
            .iter()
            .filter(same)
            .map(|p| p.value.abs())
            .fold(0.0, f64::max)
    };
    DMatrix::from_fn(n, n, |i, j| {
        let (o, p) = (&data.observations[i], &data.observations[j]);
        let mut c = if i == j { o.sigma.powi(2) } else { 0.0 };
        if o.trace.is_some() && o.trace == p.trace {
            c += noise.datum_um.powi(2);
        }
        if let Some(error) = noise.model_error
            && (o.test, o.member) == (p.test, p.member)
        {
            // Positions reach over 3 mm on each member.
            let s = (o.position.unwrap() - p.position.unwrap()) / 3.0 / error.along;
            let g = (o.cycles / p.cycles).ln() / error.over_cycles;
            let size = error.relative.powi(2) * curve_top(o) * curve_top(p);
            c += size * (-0.5 * s * s - 0.5 * g * g).exp();
        }
        c
    })
}

/// ln N(y; mean, c).
fn log_normal_density(y: &DVector<f64>, c: &DMatrix<f64>) -> f64 {
    let factor = c.clone().cholesky().unwrap();
    let log_det: f64 = 2.0 * factor.l().diagonal().map(f64::ln).sum();
    -0.5 * (y.dot(&factor.solve(y)) + log_det + y.len() as f64 * (2.0 * PI).ln())
}

fn linear_problem(model_error: Option<ModelError>) {
    let mut random = Random(7);
    let empty = wear_data(&[("A", 1e6), ("B", 8e5)], 9, true);
    let data = measured(
        &empty,
        linear,
        &[1.0; 2],
        &[3.0, 2.0],
        0.02,
        0.5,
        &mut random,
    );
    let noise = NoiseModel {
        model_error,
        ..noise(Scatter::Relative(0.0))
    };
    let predictor = Formula {
        data: data.clone(),
        formula: linear,
    };
    let priors = [(1.0, 2.0), (0.0, 3.0)];
    let fit = Problem {
        data: &data,
        roles: &[Role::Fit; 2],
        predictor: &predictor,
        coefficient: Coefficient::Fixed(1e-10),
        parameters: vec![
            normal_parameter("a.shape", priors[0].0, priors[0].1),
            normal_parameter("a.rate", priors[1].0, priors[1].1),
        ],
        noise,
    }
    .fit(&fine())
    .unwrap();
    assert!(fit.converged);

    let s = covariance(&data, &noise);
    let b = DMatrix::from_fn(data.observations.len(), 2, |i, j| {
        linear(
            &data.observations[i],
            0.0,
            &[f64::from(j == 0), f64::from(j == 1)],
        )
    });
    let y = DVector::from_iterator(
        data.observations.len(),
        data.observations.iter().map(|o| o.value),
    );
    let mean = DVector::from_iterator(2, priors.iter().map(|p| p.0));
    let precision = DMatrix::from_diagonal(&DVector::from_iterator(
        2,
        priors.iter().map(|p| p.1.powi(-2)),
    ));
    let inverse = s.clone().try_inverse().unwrap();
    let cov = (b.transpose() * &inverse * &b + &precision)
        .try_inverse()
        .unwrap();
    let map = &cov * (b.transpose() * &inverse * &y + &precision * &mean);
    for i in 0..2 {
        let found = &fit.parameters[i];
        assert!(
            (found.value - map[i]).abs() < 1e-8 * map[i].abs(),
            "{} {}",
            found.value,
            map[i]
        );
        assert!((found.sigma / cov[(i, i)].sqrt() - 1.0).abs() < 1e-8);
        let half = 1.959_963_984_540_054 * cov[(i, i)].sqrt();
        assert!((found.interval[0] - (map[i] - half)).abs() < 1e-6 * half);
        assert!((found.interval[1] - (map[i] + half)).abs() < 1e-6 * half);
        assert!(!found.at_bound);
    }
    assert!((fit.covariance[(0, 1)] / cov[(0, 1)] - 1.0).abs() < 1e-7);

    let prior_cov = precision.try_inverse().unwrap();
    let evidence = log_normal_density(&(&y - &b * &mean), &(&s + &b * prior_cov * b.transpose()));
    assert!(
        (fit.log_evidence - evidence).abs() < 1e-6,
        "{} {evidence}",
        fit.log_evidence
    );

    // Datums: the mean of N(0, τ²) given the residuals with independent noise.
    let residual = &y - &b * &map;
    for datum in &fit.datums {
        let rows = data
            .observations
            .iter()
            .enumerate()
            .filter(|(_, o)| o.trace == Some(datum.trace));
        let (mut weight, mut sum) = (0.25f64.recip(), 0.0);
        for (i, o) in rows {
            weight += o.sigma.powi(-2);
            sum += residual[i] * o.sigma.powi(-2);
        }
        assert!((datum.value - sum / weight).abs() < 1e-8);
        assert!((datum.sigma - weight.sqrt().recip()).abs() < 1e-12);
    }
    assert_eq!(fit.datums.len(), 20);
}

#[test]
fn a_linear_model_is_fitted_exactly() {
    linear_problem(None);
}

#[test]
fn a_linear_model_with_a_correlated_model_error_is_fitted_exactly() {
    linear_problem(Some(ModelError {
        relative: 0.01,
        ..ModelError::default()
    }));
}

#[test]
fn without_its_size_the_model_error_changes_nothing() {
    let mut random = Random(3);
    let empty = wear_data(&[("A", 1e6)], 12, true);
    let data = measured(&empty, linear, &[1.0], &[3.0, 2.0], 0.02, 0.5, &mut random);
    let predictor = Formula {
        data: data.clone(),
        formula: linear,
    };
    let evidence = |model_error| {
        let problem = Problem {
            data: &data,
            roles: &[Role::Fit],
            predictor: &predictor,
            coefficient: Coefficient::Fixed(1e-10),
            parameters: vec![
                normal_parameter("a.shape", 0.0, 2.0),
                normal_parameter("a.rate", 0.0, 2.0),
            ],
            noise: NoiseModel {
                model_error,
                ..noise(Scatter::Relative(0.0))
            },
        };
        problem.fit(&fine()).unwrap().log_evidence
    };
    let dense = evidence(Some(ModelError {
        relative: 0.0,
        ..ModelError::default()
    }));
    assert!((dense - evidence(None)).abs() < 1e-8, "{dense}");
}

/// A half-normal amplitude whose data pull it below 0: the mode is the bound, the evidence a one-sided integral.
#[test]
fn at_a_bound_the_evidence_is_the_one_sided_integral() {
    for truth in [-0.2, -0.02, -0.005, 0.005, 0.02] {
        let one = |o: &Observation, _: f64, p: &[f64]| p[0] * shape(o);
        let mut random = Random(11);
        let empty = wear_data(&[("A", 1e6)], 9, false);
        let data = measured(&empty, one, &[1.0], &[truth], 0.02, 0.0, &mut random);
        let predictor = Formula {
            data: data.clone(),
            formula: one,
        };
        let tau = 2.0;
        let fit = Problem {
            data: &data,
            roles: &[Role::Fit],
            predictor: &predictor,
            coefficient: Coefficient::Fixed(1e-10),
            parameters: vec![Parameter {
                name: "a.amplitude".to_owned(),
                unit: "um".to_owned(),
                start: 1.0,
                lower: 0.0,
                upper: 1e3,
                prior: Prior::HalfNormal { sd: tau },
            }],
            noise: noise(Scatter::Relative(0.0)),
        }
        .fit(&fine())
        .unwrap();
        // ∫ 2 N(a; 0, τ) Π N(y; a b, σ) da over a > 0, by the trapezium rule.
        let log_likelihood = |a: f64| -> f64 {
            data.observations
                .iter()
                .map(|o| {
                    -0.5 * ((o.value - a * shape(o)) / o.sigma).powi(2)
                        - (o.sigma * (2.0 * PI).sqrt()).ln()
                })
                .sum()
        };
        let top = log_likelihood(truth.max(0.0));
        let steps = 200_000;
        let width = 0.1 / f64::from(steps);
        let sum: f64 = (0..=steps)
            .map(|i| {
                let a = width * f64::from(i);
                let end = if i == 0 || i == steps { 0.5 } else { 1.0 };
                let prior = 2.0 * (-0.5 * (a / tau).powi(2)).exp() / (tau * (2.0 * PI).sqrt());
                end * prior * (log_likelihood(a) - top).exp()
            })
            .sum();
        let evidence = top + (sum * width).ln();
        assert!(
            (fit.log_evidence - evidence).abs() < 1e-5,
            "{truth}: {} {evidence}",
            fit.log_evidence
        );
        assert_eq!(fit.parameters[0].at_bound, fit.parameters[0].value == 0.0);
        assert!(
            fit.parameters[0].interval[0] >= 0.0
                && fit.parameters[0].interval[1] > fit.parameters[0].interval[0]
        );
        if truth.abs() >= 0.02 {
            assert_eq!(fit.parameters[0].at_bound, truth < 0.0);
        }
    }
}

/// k, ε of two tests and σ_k: the integral over all of them by brute force. The parabola in ln k_t is off by about the cube of
/// the relative width (0.3 % here), the trapezium in ln σ_k by less: 0.02 in ln evidence.
#[test]
fn the_evidence_integrates_the_scatter_of_k() {
    let ks = [1.0e-10, 1.3e-10];
    let mut random = Random(5);
    let empty = wear_data(&[("A", 1e6), ("B", 1e6)], 9, false);
    let data = measured(&empty, steady, &ks, &[], 0.02, 0.0, &mut random);
    let predictor = Formula {
        data: data.clone(),
        formula: steady,
    };
    let start = 1.2e-10;
    let fit = Problem {
        data: &data,
        roles: &[Role::Fit; 2],
        predictor: &predictor,
        coefficient: Coefficient::Free(Parameter::coefficient(start)),
        parameters: Vec::new(),
        noise: noise(Scatter::Estimate),
    }
    .fit(&fine())
    .unwrap();
    // Per test the likelihood of ln k_t on a grid; the prior of (ln k_1, ln k_2) given σ is normal, with ln k integrated out.
    let log_likelihood = |test: usize, eta: f64| -> f64 {
        let rows = data.observations.iter().filter(|o| o.test == test);
        rows.map(|o| {
            let z = (o.value - steady(o, eta.exp(), &[])) / o.sigma;
            -0.5 * z * z - (o.sigma * (2.0 * PI).sqrt()).ln()
        })
        .sum()
    };
    let steps = 160;
    let (half, spread) = (0.03, 18f64.ln());
    let width = 2.0 * half / f64::from(steps);
    let grid = |test: usize| -> Vec<(f64, f64)> {
        (0..=steps)
            .map(|i| ks[test].ln() - half + width * f64::from(i))
            .map(|eta| (eta - 3.2e-10f64.ln(), log_likelihood(test, eta)))
            .collect()
    };
    let (first, second) = (grid(0), grid(1));
    let top = |grid: &[(f64, f64)]| grid.iter().map(|g| g.1).fold(f64::NEG_INFINITY, f64::max);
    let best = top(&first) + top(&second);
    let mut total = 0.0;
    let (low, high, n) = (1e-4f64.ln(), 2f64.ln(), 400);
    let step = (high - low) / f64::from(n);
    for i in 0..=n {
        let sigma = (low + step * f64::from(i)).exp();
        let p_sigma = 2.0 * (-0.5 * (sigma / 0.25).powi(2)).exp() / (0.25 * (2.0 * PI).sqrt());
        let (v, c) = (spread * spread + sigma * sigma, spread * spread);
        let det = v * v - c * c;
        let mut sum = 0.0;
        for (x, a) in &first {
            for (y, b) in &second {
                let q = (v * (x * x + y * y) - 2.0 * c * x * y) / det;
                sum += (a + b - best - 0.5 * q).exp() / (2.0 * PI * det.sqrt());
            }
        }
        total += sum * width * width * p_sigma * sigma * step;
    }
    let evidence = best + total.ln();
    assert!(
        (fit.log_evidence - evidence).abs() < 0.02,
        "{} {evidence}",
        fit.log_evidence
    );
}
