//! The scatter σ_k of the wear coefficient between tests: its posterior, everything else integrated out.
//!
//! ```text
//! ln k_t = ln k + ε_t,  ε_t ~ N(0, σ_k),  σ_k half-normal(0.25)
//! L(σ_k) = p(σ_k) ∫ p(y | ln k, θ, ε) p(ln k) p(θ) p(ε | σ_k) d(ln k, θ, ε)       by the parabola of the linearised model
//! ```
//! The joint mode in (ε, σ_k) is degenerate: its density grows without limit as σ_k and all ε go to 0. L is not. The value
//! used is the mode of L as a density in ln σ_k, the natural scale of a positive quantity as for every other parameter: with
//! one test, which says nothing of scatter, it is the prior's 0.25 and not 0, so that a held-out test keeps its freedom.
//! Evidence and the covariance of the parameters are integrals over σ_k, not values at the mode.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};

use crate::learn::inference::quadratic::{Layout, Normal, Quadratic, State};
use crate::numeric::golden_section::place_of_largest;
use crate::study;

/// Standard deviation of the half-normal prior.
pub(in crate::learn) const SCATTER_SD: f64 = 0.25;
/// Least and largest scatter looked at. Below, tests differ by less than the model's own numerical error.
const RANGE: [f64; 2] = [1e-4, 1.5];
/// Points of the integral over ln σ_k.
const POINTS: usize = 65;
/// How closely its most probable logarithm is found.
const CLOSE: f64 = 1e-4;

/// The posterior of everything common to the tests.
#[derive(Debug)]
pub(in crate::learn) struct Marginal {
    /// ln of the integral over everything, without the likelihood's constant.
    pub(in crate::learn) log_integral: f64,
    /// Covariance of (ln k, θ).
    pub(in crate::learn) covariance: DMatrix<f64>,
    /// Where 16 and 84 % of the scatter's posterior lie.
    pub(in crate::learn) interval: [f64; 2],
}

/// The scatter to use in the linearised model about `state`.
pub(in crate::learn) fn most_probable(
    setting: study::Scatter,
    layout: &Layout,
    normal: &Normal,
    state: &State,
) -> f64 {
    if let study::Scatter::Relative(fixed) = setting {
        return fixed;
    }
    let density = |t: f64| log_density(layout, normal, state, t.exp()).0 + t;
    let (low, high) = (RANGE[0].ln(), RANGE[1].ln());
    let step = (high - low) / 32.0;
    let best = (0..=32)
        .map(|i| low + step * f64::from(i))
        .map(|t| (t, density(t)))
        .fold((low, f64::NEG_INFINITY), |best, at| {
            if at.1 > best.1 { at } else { best }
        });
    let about = [(best.0 - step).max(low), (best.0 + step).min(high)];
    place_of_largest(density, about, CLOSE).exp()
}

/// The integral over everything, the scatter included.
pub(in crate::learn) fn marginal(
    setting: study::Scatter,
    layout: &Layout,
    normal: &Normal,
    state: &State,
) -> Marginal {
    if let study::Scatter::Relative(fixed) = setting {
        let quadratic = Quadratic::new(layout, normal, state, fixed);
        let common = layout.common();
        return Marginal {
            log_integral: quadratic.log_integral(&quadratic.step(0.0)),
            covariance: corner(&quadratic.covariance(), common),
            interval: [fixed; 2],
        };
    }
    let (low, high) = (RANGE[0].ln(), RANGE[1].ln());
    let step = (high - low) / (POINTS - 1) as f64;
    let common = layout.common();
    let mut places = Vec::with_capacity(POINTS);
    for i in 0..POINTS {
        let sigma = (low + step * i as f64).exp();
        let (log, quadratic) = log_density(layout, normal, state, sigma);
        // Trapezium in ln σ_k; what lies below the least one is as likely as there, per σ_k.
        let end = if i == 0 || i == POINTS - 1 { 0.5 } else { 1.0 };
        let width = end * step * sigma + if i == 0 { sigma } else { 0.0 };
        let moved = quadratic.step(0.0).x.rows(0, common).into_owned();
        places.push((
            sigma,
            log + width.ln(),
            moved,
            corner(&quadratic.covariance(), common),
        ));
    }
    let top = places.iter().map(|p| p.1).fold(f64::NEG_INFINITY, f64::max);
    let total: f64 = places.iter().map(|p| (p.1 - top).exp()).sum();
    let weight = |log: f64| (log - top).exp() / total;
    let mean = places
        .iter()
        .fold(DVector::zeros(common), |sum, p| sum + &p.2 * weight(p.1));
    let covariance = places
        .iter()
        .fold(DMatrix::zeros(common, common), |sum, p| {
            let off = &p.2 - &mean;
            sum + (&p.3 + &off * off.transpose()) * weight(p.1)
        });
    let share = |wanted: f64| {
        let mut below = 0.0;
        for (sigma, log, ..) in &places {
            below += weight(*log);
            if below >= wanted {
                return *sigma;
            }
        }
        RANGE[1]
    };
    Marginal {
        log_integral: top + total.ln(),
        covariance,
        interval: [share(0.16), share(0.84)],
    }
}

/// ln L(σ_k) with respect to σ_k, and the parabola at it.
fn log_density(layout: &Layout, normal: &Normal, state: &State, sigma: f64) -> (f64, Quadratic) {
    let quadratic = Quadratic::new(layout, normal, state, sigma);
    let integral = quadratic.log_integral(&quadratic.step(0.0));
    let z = sigma / SCATTER_SD;
    let prior = (2.0 / (SCATTER_SD * (2.0 * PI).sqrt())).ln() - 0.5 * z * z;
    (integral + prior, quadratic)
}

fn corner(matrix: &DMatrix<f64>, n: usize) -> DMatrix<f64> {
    if n == 0 {
        DMatrix::zeros(0, 0)
    } else {
        matrix.view((0, 0), (n, n)).into_owned()
    }
}
