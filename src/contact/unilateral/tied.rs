//! Slices that are tied besides their common approach: each group of a slice's points gives way by what all groups carry.
//!
//! ```text
//! r_i = g_i + Σ_s l_s v_is + W λ_i − φ a ≥ 0,   v = E f,   f_js = l_s·λ_j        l_s: the lengths of group s, else 0
//! ```
//! On sets that are given this is linear in v and φ; the sets follow from the problem with gaps shifted by v ([`super::joint`]). The two in turn are Newton's
//! method on a piecewise linear equation for v, and end where the sets come back. Should they go round, v is iterated alone: W + L E Lᵀ is positive
//! and E is not, so that E ∂f/∂v lies between 0 and 1.

use std::ops::Range;

use nalgebra::{DMatrix, DVector, Dyn, LU};

use super::UnilateralError;
use super::joint::{Factors, JointProblem, JointSolution, OnSet, SetFactor, on_sets, solve_joint};

/// What ties the slices of a [`JointProblem`].
#[derive(Debug, Clone, Copy)]
pub struct Ties<'a> {
    /// E: rows and columns are the groups of the first slice, then those of the second, and so on.
    pub change: &'a DMatrix<f64>,
    /// By section of the problem.
    pub sections: &'a [TiedSection<'a>],
}

/// The groups of a section's unknowns that are tied.
#[derive(Debug, Clone, Copy)]
pub struct TiedSection<'a> {
    /// The unknowns of each group.
    pub groups: &'a [Range<usize>],
    /// Length of every unknown.
    pub length: &'a [f64],
}

impl Ties<'_> {
    /// First row of each slice, and the end of the last, for slices at the sections `at`.
    fn rows(&self, at: &[usize]) -> Vec<usize> {
        let mut rows = vec![0];
        for &section in at {
            rows.push(rows[rows.len() - 1] + self.sections[section].groups.len());
        }
        rows
    }
}

/// Rounds of sets and shifts.
const MOST_ROUNDS: usize = 30;

/// Rounds of shifts alone, and their change over the approach that ends them.
const MOST_STEPS: usize = 400;
const SETTLED: f64 = 1e-12;

/// Solves `problem` with its slices tied, from the sets `start`; also the gaps by slice as the ties leave them.
///
/// # Errors
/// [`UnilateralError`].
pub fn solve_tied(
    problem: &JointProblem,
    ties: &Ties,
    start: &[Vec<usize>],
) -> Result<(JointSolution, Vec<Vec<f64>>), UnilateralError> {
    let mut sets = match problem.fits(start) {
        true => start.to_vec(),
        false => solve_joint(problem, &[])?.active,
    };
    for _ in 0..MOST_ROUNDS {
        let shifts = shifts_on(problem, ties, &sets)?;
        let gaps = shifted(problem, ties, &shifts);
        let problem = JointProblem {
            gaps: &gaps,
            ..*problem
        };
        let solution = solve_joint(&problem, &sets)?;
        if solution.active == sets {
            return Ok((solution, gaps));
        }
        sets = solution.active;
    }
    let mut shifts = DVector::zeros(ties.change.nrows());
    for _ in 0..MOST_STEPS {
        let gaps = shifted(problem, ties, &shifts);
        let solution = solve_joint(
            &JointProblem {
                gaps: &gaps,
                ..*problem
            },
            &sets,
        )?;
        let next = ties.change * loads(problem, ties, &solution.pressure);
        let moved = (&next - &shifts).amax();
        if moved <= SETTLED * next.amax() {
            return Ok((solution, gaps));
        }
        (shifts, sets) = (next, solution.active);
    }
    Err(UnilateralError::NotSettled {
        iterations: MOST_ROUNDS + MOST_STEPS,
        flipping: Vec::new(),
    })
}

/// f: the loads of all groups.
fn loads(problem: &JointProblem, ties: &Ties, pressure: &[Vec<f64>]) -> DVector<f64> {
    let slices = pressure.iter().zip(problem.at);
    let all = slices.flat_map(|(pressure, &section)| {
        let TiedSection { groups, length } = ties.sections[section];
        let of_group = move |group: &Range<usize>| -> f64 {
            group.clone().map(|k| length[k] * pressure[k]).sum()
        };
        groups.iter().map(of_group)
    });
    DVector::from_iterator(ties.change.nrows(), all)
}

/// The gaps with every group of every slice shifted.
fn shifted(problem: &JointProblem, ties: &Ties, shifts: &DVector<f64>) -> Vec<Vec<f64>> {
    let mut gaps = problem.gaps.to_vec();
    let mut shifts = shifts.iter();
    for (gap, &section) in gaps.iter_mut().zip(problem.at) {
        let TiedSection { groups, length } = ties.sections[section];
        for (group, shift) in groups.iter().zip(&mut shifts) {
            for k in group.clone() {
                gap[k] += shift * length[k];
            }
        }
    }
    gaps
}

/// The shifts on given sets.
fn shifts_on(
    problem: &JointProblem,
    ties: &Ties,
    sets: &[Vec<usize>],
) -> Result<DVector<f64>, UnilateralError> {
    let on = on_sets(problem, &mut Factors::default(), sets)?;
    let factors: Vec<&SetFactor> = on.iter().map(OnSet::factor).collect();
    let system = TiedSystem::new(&factors, problem, ties)?;
    let gaps: Vec<DVector<f64>> = on.iter().map(|on| -on.of_gap()).collect();
    Ok(system
        .shifts(&factors, problem.weights, &gaps, problem.load)
        .0)
}

/// The linear equations for shifts and approach on given sets.
pub(super) struct TiedSystem {
    change: DMatrix<f64>,
    /// By slice: lengths of each group (columns) on its set.
    lengths: Vec<DMatrix<f64>>,
    equations: LU<f64, Dyn, Dyn>,
    /// First shift of each slice, and the end of the last.
    rows: Vec<usize>,
}

impl TiedSystem {
    /// For the slices of `problem` on the sets of `factors`.
    pub(super) fn new(
        factors: &[&SetFactor],
        problem: &JointProblem,
        ties: &Ties,
    ) -> Result<Self, UnilateralError> {
        let rows = ties.rows(problem.at);
        let size = ties.change.nrows();
        let lengths: Vec<DMatrix<f64>> = (factors.iter().zip(problem.at))
            .map(|(factor, &section)| {
                let TiedSection { groups, length } = ties.sections[section];
                DMatrix::from_fn(factor.active().len(), groups.len(), |i, s| {
                    let k = factor.active()[i];
                    let own = groups[s].contains(&k);
                    if own { length[k] } else { 0.0 }
                })
            })
            .collect();
        // (I + E M) v − E d φ = E c;   Σ w b·(W⁻¹ a) φ − Σ w b·(W⁻¹ L) v = load − Σ w b·W⁻¹ r
        let mut stiffness = DMatrix::zeros(size, size);
        let mut driven = DVector::zeros(size);
        let mut equations = DMatrix::zeros(size + 1, size + 1);
        for (i, (factor, length)) in factors.iter().zip(&lengths).enumerate() {
            let columns = factor.solved(length.clone());
            let own = length.tr_mul(&columns);
            let (first, groups) = (rows[i], length.ncols());
            stiffness
                .view_mut((first, first), (groups, groups))
                .copy_from(&own);
            driven
                .rows_mut(first, groups)
                .copy_from(&length.tr_mul(factor.of_arm()));
            let carried = columns.tr_mul(factor.lever()) * -problem.weights[i];
            for s in 0..groups {
                equations[(size, first + s)] = carried[s];
            }
            equations[(size, size)] += problem.weights[i] * factor.lever().dot(factor.of_arm());
        }
        let mut shifts = ties.change * stiffness;
        for i in 0..size {
            shifts[(i, i)] += 1.0;
        }
        equations.view_mut((0, 0), (size, size)).copy_from(&shifts);
        let drive = ties.change * driven;
        for i in 0..size {
            equations[(i, size)] = -drive[i];
        }
        let equations = equations.lu();
        if !equations.is_invertible() {
            return Err(UnilateralError::NotSettled {
                iterations: 0,
                flipping: Vec::new(),
            });
        }
        Ok(Self {
            change: ties.change.clone(),
            lengths,
            equations,
            rows,
        })
    }

    /// v and φ, where W λ − φ a + L v = r on the sets, W⁻¹ r is `solved` by slice, and Σ w b·λ = `load`.
    pub(super) fn shifts(
        &self,
        factors: &[&SetFactor],
        weights: &[f64],
        solved: &[DVector<f64>],
        load: f64,
    ) -> (DVector<f64>, f64) {
        let size = self.change.nrows();
        let mut carried = DVector::zeros(size);
        let mut rest = load;
        for (i, (factor, own)) in factors.iter().zip(solved).enumerate() {
            carried
                .rows_mut(self.rows[i], self.lengths[i].ncols())
                .copy_from(&self.lengths[i].tr_mul(own));
            rest -= weights[i] * factor.lever().dot(own);
        }
        let mut right = DVector::zeros(size + 1);
        right.rows_mut(0, size).copy_from(&(&self.change * carried));
        right[size] = rest;
        let solution = (self.equations.solve(&right)).expect("found invertible");
        (solution.rows(0, size).into_owned(), solution[size])
    }

    /// L v in slice `i`.
    pub(super) fn shift(&self, i: usize, shifts: &DVector<f64>) -> DVector<f64> {
        &self.lengths[i] * shifts.rows(self.rows[i], self.lengths[i].ncols())
    }
}
