//! Small changes of a joint contact, on the active sets of a solution.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::super::UnilateralError;
use super::super::tied::{TiedSystem, Ties};
use super::{Factors, JointProblem, RidgedSections, SetFactor};

/// A joint contact linearised on its active sets: small changes cost one back-substitution for each slice.
///
/// ```text
/// W x_i + L v_i − a ψ = r_i,   Σ w_i b·x_i = s          v = E Lᵀx where slices are tied, else 0
/// ```
pub struct JointLinearised {
    slices: Vec<Arc<SetFactor>>,
    weights: Vec<f64>,
    /// Σ w_i b·W⁻¹a.
    stiffness: f64,
    tied: Option<TiedSystem>,
}

impl JointLinearised {
    /// On `active`, the sets of a solution.
    ///
    /// # Errors
    /// [`UnilateralError::Singular`] if a set's compliance cannot be inverted.
    pub fn new(
        problem: &JointProblem,
        ties: Option<&Ties>,
        active: &[&[usize]],
    ) -> Result<Self, UnilateralError> {
        let mut factors = Factors::default();
        let build = |factors: &mut Factors, problem: &JointProblem| {
            let all = active.iter().enumerate();
            let each = all.map(|(i, set)| factors.of(problem, i, set));
            each.collect::<Result<Vec<_>, _>>()
        };
        let slices = build(&mut factors, problem).or_else(|_| {
            let stiffened = RidgedSections::of(problem);
            let sections = stiffened.sections(problem);
            let ridged = JointProblem {
                sections: &sections,
                ..*problem
            };
            build(&mut Factors::default(), &ridged)
        })?;
        let stiffness = (slices.iter().zip(problem.weights))
            .map(|(slice, weight)| weight * slice.lever.dot(&slice.of_arm))
            .sum();
        let factors: Vec<&SetFactor> = slices.iter().map(Arc::as_ref).collect();
        let tied = ties
            .filter(|_| active.iter().any(|set| !set.is_empty()))
            .map(|ties| TiedSystem::new(&factors, problem, ties))
            .transpose()?;
        Ok(Self {
            slices,
            weights: problem.weights.to_vec(),
            stiffness,
            tied,
        })
    }

    /// x by slice and ψ for `right` by slice and `load`.
    pub fn solve(&self, right: Vec<DVector<f64>>, load: f64) -> (Vec<DVector<f64>>, f64) {
        let Some(tied) = &self.tied else {
            return self.solve_untied(right, load);
        };
        let factors: Vec<&SetFactor> = self.slices.iter().map(Arc::as_ref).collect();
        let mut x = self.each_solved(right);
        let (shifts, psi) = tied.shifts(&factors, &self.weights, &x, load);
        for (i, (x, slice)) in x.iter_mut().zip(&self.slices).enumerate() {
            *x -= slice.solve(tied.shift(i, &shifts));
            x.axpy(psi, &slice.of_arm, 1.0);
        }
        (x, psi)
    }

    fn each_solved(&self, right: Vec<DVector<f64>>) -> Vec<DVector<f64>> {
        let all = self.slices.iter().zip(right);
        all.map(|(slice, right)| slice.solve(right)).collect()
    }

    /// The same without ties, as [`JointLinearised::sensitivities`] has it.
    pub fn solve_untied(&self, right: Vec<DVector<f64>>, load: f64) -> (Vec<DVector<f64>>, f64) {
        let mut x = self.each_solved(right);
        let carried: f64 = (self.slices.iter().zip(&x).zip(&self.weights))
            .map(|((slice, x), weight)| weight * slice.lever.dot(x))
            .sum();
        let psi = (load - carried) / self.stiffness;
        for (x, slice) in x.iter_mut().zip(&self.slices) {
            x.axpy(psi, &slice.of_arm, 1.0);
        }
        (x, psi)
    }

    /// How the pressures of each slice follow its own gaps at a fixed approach and the approach that is common:
    /// dλ_i = −S dg_i + x dφ, dφ = Σ_j f_j·dg_j, as if slices were not tied. Slices with the same set share one.
    pub fn sensitivities(&self) -> Vec<Arc<SliceSensitivity>> {
        let mut known: Vec<(Arc<SetFactor>, Arc<SliceSensitivity>)> = Vec::new();
        let of_slice = |slice: &Arc<SetFactor>| {
            if let Some((_, found)) = known.iter().find(|(set, _)| Arc::ptr_eq(set, slice)) {
                return Arc::clone(found);
            }
            let m = slice.active.len();
            let inverse = match &slice.factor {
                Some(factor) => factor.inverse(m),
                None => DMatrix::zeros(0, 0),
            };
            let found = Arc::new(SliceSensitivity {
                follow: inverse.tr_mul(&slice.lever) / self.stiffness,
                drive: slice.of_arm.clone(),
                fixed: inverse,
            });
            known.push((Arc::clone(slice), Arc::clone(&found)));
            found
        };
        self.slices.iter().map(of_slice).collect()
    }
}

/// How one slice's pressures follow gaps; see [`JointLinearised::sensitivities`].
pub struct SliceSensitivity {
    /// S on the active set, MPa per mm² at a fixed approach.
    pub fixed: DMatrix<f64>,
    /// x: pressures per approach.
    pub drive: DVector<f64>,
    /// f, but for the slice's weight: approach per weighted gap.
    pub follow: DVector<f64>,
}
