//! The log posterior as a parabola about a point: bounded minimum, covariance, integral.
//!
//! ```text
//! unknowns   x = (ln k, θ, w_1 .. w_T)      ln k_t = ln k + ε_t,  ε_t = σ_k w_t,  w_t ~ N(0, 1)
//! Φ(x)       = |W (y − f)|²/2 − ln p(ln k) − ln p(θ) − ln p(w)
//! ∫ exp(−Φ)  ≈ exp(−Φ*) (2π)^(d/2) |H|^(−1/2) · (share of the normal that lies between the bounds)
//! ```
//! With w instead of ε nothing degenerates as σ_k → 0: the columns of w vanish, their prior stays, and the integral tends to
//! that without scatter. The Hessian is Gauss and Newton's.

use std::f64::consts::PI;

use nalgebra::{Cholesky, DMatrix, DVector};

use crate::learn::hypothesis::parameters::NaturalPrior;
use crate::numeric::truncated_normal::log_mass;

/// What is unknown.
#[derive(Debug, Clone)]
pub(in crate::learn) struct Layout {
    /// The prior of ln k; None if k is fixed.
    pub(in crate::learn) coefficient: Option<NaturalPrior>,
    /// The priors of θ.
    pub(in crate::learn) parameters: Vec<NaturalPrior>,
    /// Number of tests.
    pub(in crate::learn) tests: usize,
}

/// Where a fit stands, on natural scales.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::learn) struct State {
    /// ln k.
    pub(in crate::learn) log_k: f64,
    /// θ.
    pub(in crate::learn) theta: Vec<f64>,
    /// ε of each test.
    pub(in crate::learn) epsilon: Vec<f64>,
}

/// The whitened least squares of a linearised model in (θ, ln k_1 .. ln k_T).
#[derive(Debug, Clone)]
pub(in crate::learn) struct Normal {
    /// J̃ᵀJ̃.
    pub(in crate::learn) gram: DMatrix<f64>,
    /// J̃ᵀr̃ with r = measured − model.
    pub(in crate::learn) rhs: DVector<f64>,
    /// |r̃|².
    pub(in crate::learn) square: f64,
}

/// Φ about a point at a scatter.
#[derive(Debug)]
pub(in crate::learn) struct Quadratic {
    /// Φ there.
    pub(in crate::learn) value: f64,
    /// (θ, ln k_t) per x.
    map: DMatrix<f64>,
    gradient: DVector<f64>,
    hessian: DMatrix<f64>,
    /// Bounds of the step.
    lower: Vec<f64>,
    upper: Vec<f64>,
}

/// A step within bounds.
#[derive(Debug, Clone)]
pub(in crate::learn) struct Step {
    pub(in crate::learn) x: DVector<f64>,
    /// By how much Φ falls if it is the parabola.
    pub(in crate::learn) decrease: f64,
    /// Which unknowns are held by a bound.
    held: Vec<bool>,
}

impl Layout {
    /// Φ at a state whose whitened residuals have the squared length `square`.
    pub(in crate::learn) fn objective(&self, square: f64, state: &State, scatter: f64) -> f64 {
        let mut value = 0.5 * square;
        if let Some(prior) = &self.coefficient {
            value -= prior.log_density(state.log_k);
        }
        for (prior, &theta) in self.parameters.iter().zip(&state.theta) {
            value -= prior.log_density(theta);
        }
        if scatter > 0.0 {
            let w2: f64 = state.epsilon.iter().map(|e| (e / scatter).powi(2)).sum();
            value += 0.5 * w2 + 0.5 * self.tests as f64 * (2.0 * PI).ln();
        }
        value
    }

    /// The state after a step.
    pub(in crate::learn) fn moved(
        &self,
        state: &State,
        step: &DVector<f64>,
        scatter: f64,
    ) -> State {
        let mut next = state.clone();
        let mut at = 0;
        if let Some(prior) = &self.coefficient {
            next.log_k = (state.log_k + step[0]).clamp(prior.lower, prior.upper);
            at = 1;
        }
        for (prior, theta) in self.parameters.iter().zip(&mut next.theta) {
            *theta = prior.moved(*theta, step[at]);
            at += 1;
        }
        if scatter > 0.0 {
            for (test, epsilon) in next.epsilon.iter_mut().enumerate() {
                *epsilon += scatter * step[at + test];
            }
        }
        next
    }

    /// Number of unknowns before w.
    pub(in crate::learn) fn common(&self) -> usize {
        usize::from(self.coefficient.is_some()) + self.parameters.len()
    }
}

impl Quadratic {
    /// About `state`, at the scatter σ_k; at 0 there are no ε.
    pub(in crate::learn) fn new(
        layout: &Layout,
        normal: &Normal,
        state: &State,
        scatter: f64,
    ) -> Self {
        let params = layout.parameters.len();
        let k = usize::from(layout.coefficient.is_some());
        let common = layout.common();
        let d = common + if scatter > 0.0 { layout.tests } else { 0 };
        let mut map = DMatrix::zeros(params + layout.tests, d);
        let mut prior_gradient = DVector::zeros(d);
        let mut curvature = DVector::from_element(d, 1.0);
        let mut bounds = vec![[f64::NEG_INFINITY, f64::INFINITY]; d];
        let scale = layout.coefficient.iter().chain(&layout.parameters);
        let place = (k == 1).then_some(&state.log_k);
        for (at, (prior, &x)) in scale.zip(place.into_iter().chain(&state.theta)).enumerate() {
            prior_gradient[at] = prior.precision * (x - prior.mean);
            curvature[at] = prior.curvature();
            bounds[at] = prior.room(x);
        }
        for p in 0..params {
            map[(p, k + p)] = 1.0;
        }
        for test in 0..layout.tests {
            if k == 1 {
                map[(params + test, 0)] = 1.0;
            }
            if scatter > 0.0 {
                map[(params + test, common + test)] = scatter;
                prior_gradient[common + test] = state.epsilon[test] / scatter;
            }
        }
        let hessian = map.transpose() * &normal.gram * &map + DMatrix::from_diagonal(&curvature);
        Self {
            value: layout.objective(normal.square, state, scatter),
            gradient: prior_gradient - map.transpose() * &normal.rhs,
            map,
            hessian,
            lower: bounds.iter().map(|b| b[0]).collect(),
            upper: bounds.iter().map(|b| b[1]).collect(),
        }
    }

    /// The step to the least value between the bounds, the Hessian's diagonal times `1 + damping`.
    ///
    /// Active set: unknowns that leave their bounds are held there, held ones that pull inwards are let go.
    pub(in crate::learn) fn step(&self, damping: f64) -> Step {
        let d = self.gradient.len();
        let mut h = self.hessian.clone();
        for i in 0..d {
            h[(i, i)] *= 1.0 + damping;
        }
        let mut held: Vec<Option<f64>> = vec![None; d];
        let mut x = DVector::zeros(d);
        for _ in 0..3 * d + 2 {
            x = solve_held(&h, &self.gradient, &held);
            let mut left = false;
            for i in 0..d {
                if held[i].is_none() && !(self.lower[i]..=self.upper[i]).contains(&x[i]) {
                    held[i] = Some(x[i].clamp(self.lower[i], self.upper[i]));
                    left = true;
                }
            }
            if left {
                continue;
            }
            let slope = &self.gradient + &h * &x;
            let inward = |i: usize, bound: f64| {
                let pull = if bound <= self.lower[i] {
                    -slope[i]
                } else {
                    slope[i]
                };
                pull / h[(i, i)].sqrt()
            };
            let worst = (0..d)
                .filter_map(|i| held[i].map(|bound| (i, inward(i, bound))))
                .max_by(|a, b| a.1.total_cmp(&b.1));
            match worst {
                Some((i, pull)) if pull > 1e-9 => held[i] = None,
                _ => break,
            }
        }
        for i in 0..d {
            x[i] = x[i].clamp(self.lower[i], self.upper[i]);
        }
        let decrease = -(self.gradient.dot(&x) + 0.5 * (&self.hessian * &x).dot(&x));
        Step {
            x,
            decrease,
            held: held.iter().map(Option::is_some).collect(),
        }
    }

    /// ln ∫ exp(−Φ) over everything between its bounds.
    ///
    /// Unknowns held by a bound at the minimum contribute one-sided integrals; those near one the share of their normal
    /// within it, each by its own: exact for one bounded unknown, approximate where several correlated ones are cut.
    pub(in crate::learn) fn log_integral(&self, minimum: &Step) -> f64 {
        let d = self.gradient.len();
        if d == 0 {
            return -self.value;
        }
        let (free, held): (Vec<usize>, Vec<usize>) = (0..d).partition(|&i| !minimum.held[i]);
        let slope = &self.gradient + &self.hessian * &minimum.x;
        let mut sum = -(self.value - minimum.decrease);
        let inverse = match factor(&self.hessian.select_rows(&free).select_columns(&free)) {
            Some(factor) => {
                sum += 0.5 * free.len() as f64 * (2.0 * PI).ln();
                sum -= factor.l_dirty().diagonal().map(f64::ln).sum();
                factor.inverse()
            }
            None => DMatrix::zeros(0, 0),
        };
        for (a, &i) in free.iter().enumerate() {
            let sd = inverse[(a, a)].sqrt();
            let room = [self.lower[i], self.upper[i]].map(|bound| (bound - minimum.x[i]) / sd);
            sum += log_mass(room[0], room[1]);
        }
        for &i in &held {
            // Precision of the held unknown once the free ones follow it.
            let across = self.hessian.row(i).select_columns(&free);
            let follows = (&across * &inverse * across.transpose())[(0, 0)];
            let precision = (self.hessian[(i, i)] - follows).max(1e-12 * self.hessian[(i, i)]);
            let root = precision.sqrt();
            let g = slope[i].abs() / root;
            let width = (self.upper[i] - self.lower[i]) * root;
            // ∫ exp(−g t − t²/2) dt from 0 to the width.
            sum += 0.5 * g * g + 0.5 * (2.0 * PI).ln() + log_mass(g, g + width) - root.ln();
        }
        sum
    }

    /// The step of (ln k, θ) to the least value without bounds.
    pub(in crate::learn) fn least(&self, layout: &Layout) -> DVector<f64> {
        let step = solve_held(
            &self.hessian,
            &self.gradient,
            &vec![None; self.gradient.len()],
        );
        step.rows(0, layout.common()).into_owned()
    }

    /// The covariance of x without bounds, H⁻¹.
    pub(in crate::learn) fn covariance(&self) -> DMatrix<f64> {
        factor(&self.hessian).map_or_else(|| DMatrix::zeros(0, 0), |factor| factor.inverse())
    }

    /// The covariance of (θ, ln k_t).
    pub(in crate::learn) fn mapped_covariance(&self) -> DMatrix<f64> {
        if self.gradient.is_empty() {
            return DMatrix::zeros(self.map.nrows(), self.map.nrows());
        }
        &self.map * self.covariance() * self.map.transpose()
    }
}

/// The least value of the parabola with some unknowns held.
fn solve_held(h: &DMatrix<f64>, gradient: &DVector<f64>, held: &[Option<f64>]) -> DVector<f64> {
    let fixed = DVector::from_iterator(held.len(), held.iter().map(|held| held.unwrap_or(0.0)));
    let free: Vec<usize> = (0..held.len()).filter(|&i| held[i].is_none()).collect();
    let mut x = fixed.clone();
    let right = -(gradient + h * &fixed).select_rows(&free);
    if let Some(factor) = factor(&h.select_rows(&free).select_columns(&free)) {
        let found = factor.solve(&right);
        for (&i, found) in free.iter().zip(found.iter()) {
            x[i] = *found;
        }
    }
    x
}

/// Cholesky's factor of a symmetric matrix; one that rounding has made indefinite gets the least addition that helps. None
/// for an empty one.
fn factor(matrix: &DMatrix<f64>) -> Option<Cholesky<f64, nalgebra::Dyn>> {
    if matrix.is_empty() {
        return None;
    }
    let mut added = 0.0;
    for _ in 0..12 {
        let mut m = matrix.clone();
        for i in 0..m.nrows() {
            m[(i, i)] += added * matrix[(i, i)].abs();
        }
        if let Some(factor) = Cholesky::new(m) {
            return Some(factor);
        }
        added = f64::max(1e-14, 10.0 * added);
    }
    None
}
