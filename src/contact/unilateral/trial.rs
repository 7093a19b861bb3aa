//! The contact problem with one set of points taken to touch: a linear one.

use nalgebra::{DMatrix, DVector};

use super::factor::Factor;
use super::{Drive, Problem, Solution, UnilateralError, symmetric_difference};

/// Gaps smaller than this against the approach are closed, in either direction: rounding.
pub(super) const CLOSED: f64 = 1e-12;

/// Equality-constrained solution on one set.
pub(super) struct Trial {
    /// Ascending.
    pub(super) active: Vec<usize>,
    /// In that order; may be negative.
    pub(super) pressure: DVector<f64>,
    pub(super) approach: f64,
    /// What is left of the gap at every point.
    pub(super) residual: Vec<f64>,
}

impl Trial {
    pub(super) fn on(problem: &Problem, mut active: Vec<usize>) -> Result<Self, UnilateralError> {
        active.sort_unstable();
        if let (true, Drive::Approach(approach)) = (active.is_empty(), problem.drive) {
            return Ok(Self::with(problem, active, DVector::zeros(0), approach));
        }
        let reduced = Reduced::new(problem, &active)?;
        let approach = match problem.drive {
            Drive::Load(load) => {
                (load + reduced.lever.dot(&reduced.y)) / reduced.lever.dot(&reduced.x)
            }
            Drive::Approach(phi) => phi,
        };
        let pressure = &reduced.x * approach - &reduced.y;
        Ok(Self::with(problem, active, pressure, approach))
    }

    /// Pressures on a set, at an approach.
    pub(super) fn with(
        problem: &Problem,
        active: Vec<usize>,
        pressure: DVector<f64>,
        approach: f64,
    ) -> Self {
        let mut residual: Vec<f64> = (problem.gap.iter().zip(problem.arm))
            .map(|(g, a)| g - approach * a)
            .collect();
        for (&l, &p) in active.iter().zip(pressure.iter()) {
            for (rk, w) in residual.iter_mut().zip(problem.w.column(l).iter()) {
                *rk += w * p;
            }
        }
        Self {
            active,
            pressure,
            approach,
            residual,
        }
    }

    pub(super) fn primal_dual_set(&self, problem: &Problem) -> Vec<usize> {
        let mut keep = vec![false; problem.gap.len()];
        let scale = self.scale(problem);
        for (k, flag) in keep.iter_mut().enumerate() {
            *flag = self.residual[k] < -CLOSED * scale * problem.arm[k].abs();
        }
        for (&k, &p) in self.active.iter().zip(self.pressure.iter()) {
            keep[k] = p > 0.0;
        }
        (0..keep.len()).filter(|&k| keep[k]).collect()
    }

    /// Points on the wrong side, ascending: pressures below 0 and gaps closed further than rounding explains.
    pub(super) fn wrong(&self, problem: &Problem) -> Vec<usize> {
        symmetric_difference(&self.primal_dual_set(problem), &self.active)
    }

    /// A length typical of the approach, for tolerances relative to it.
    pub(super) fn scale(&self, problem: &Problem) -> f64 {
        let least = problem
            .gap
            .iter()
            .zip(problem.arm)
            .map(|(g, a)| g / a)
            .fold(f64::INFINITY, f64::min);
        (self.approach - least).abs().max(f64::MIN_POSITIVE)
    }

    pub(super) fn into_solution(self, problem: &Problem, iterations: usize) -> Solution {
        let scale = self.scale(problem);
        let penetration = self
            .residual
            .iter()
            .zip(problem.arm)
            .map(|(r, a)| -r / (a.abs() * scale))
            .fold(0.0, f64::max);
        let mut pressure = vec![0.0; problem.gap.len()];
        for (&k, &p) in self.active.iter().zip(self.pressure.iter()) {
            // what is below 0 here is rounding
            pressure[k] = p.max(0.0);
        }
        Solution {
            pressure,
            approach: self.approach,
            active: self.active,
            iterations,
            penetration,
        }
    }
}

/// The two solves on a set: x = W⁻¹ a, y = W⁻¹ g.
struct Reduced {
    lever: DVector<f64>,
    x: DVector<f64>,
    y: DVector<f64>,
}

impl Reduced {
    fn new(problem: &Problem, active: &[usize]) -> Result<Self, UnilateralError> {
        let m = active.len();
        let mut rhs = DMatrix::from_fn(m, 2, |i, c| [problem.arm, problem.gap][c][active[i]]);
        Factor::of(problem, active)?.solve(&mut rhs);
        let lever = DVector::from_fn(m, |i, _| problem.lever[active[i]]);
        Ok(Self {
            lever,
            x: rhs.column(0).into(),
            y: rhs.column(1).into(),
        })
    }
}
