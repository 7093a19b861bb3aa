//! Several contacts that close by the same approach and carry one load between them: the slices of a face.
//!
//! ```text
//! r_i = g_i + W λ_i − φ a ≥ 0,   λ_i ≥ 0,   λ_i·r_i = 0,   Σ w_i b·λ_i = load
//! ```
//! One contact problem with a block-diagonal compliance, so the method is that of [`super::solve`]: primal-dual active set on all slices
//! at once. Slices whose set stands are not solved again, and slices with the same set share its factor. Where the sets do not settle,
//! Newton's method within a bracket on the load, which is continuous, monotone and piecewise linear in φ, with each slice solved at the
//! given approach.

mod linearised;

use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

use super::factor::{Factor, ridged};
use super::trial::{CLOSED, Trial};
use super::{Drive, Problem, UnilateralError};

pub use linearised::{JointLinearised, SliceSensitivity};

/// A section as its contact grid sees it; several slices may stand at the same.
#[derive(Debug, Clone, Copy)]
pub struct Section<'a> {
    /// Weighted compliance, as in [`Problem`].
    pub w: &'a DMatrix<f64>,
    /// As in [`Problem`].
    pub arm: &'a [f64],
    /// As in [`Problem`].
    pub lever: &'a [f64],
}

/// Contacts of slices that close by one approach.
#[derive(Debug, Clone, Copy)]
pub struct JointProblem<'a> {
    /// The sections at which slices stand.
    pub sections: &'a [Section<'a>],
    /// Number of the section of each slice.
    pub at: &'a [usize],
    /// Weighted initial gaps by slice.
    pub gaps: &'a [Vec<f64>],
    /// Share of each slice in the load.
    pub weights: &'a [f64],
    /// Mean of the slices' loads, weighted.
    pub load: f64,
    /// As in [`Problem`].
    pub symmetric: bool,
}

/// Solution of a [`JointProblem`].
#[derive(Debug, Clone, PartialEq)]
pub struct JointSolution {
    /// Pressures by slice, zero outside the active sets.
    pub pressure: Vec<Vec<f64>>,
    /// The common approach φ.
    pub approach: f64,
    /// Indices in contact by slice, ascending; empty where a slice carries nothing.
    pub active: Vec<Vec<usize>>,
    /// Rounds used.
    pub iterations: usize,
    /// As in [`super::Solution`], the worst slice's.
    pub penetration: f64,
}

/// Rounds of the active-set method.
const MOST_ROUNDS: usize = 40;

/// Pieces of the load over the approach that may be tried.
const MOST_PIECES: usize = 200;

/// Solves `problem` from the sets `start` by slice (none: from the points nearest to touching).
///
/// # Errors
/// See [`UnilateralError`]; an iterate that did not converge is never returned.
pub fn solve_joint(
    problem: &JointProblem,
    start: &[Vec<usize>],
) -> Result<JointSolution, UnilateralError> {
    let finite = |values: &[f64]| values.iter().all(|x| x.is_finite());
    let sound = problem.load.is_finite() && problem.load > 0.0;
    let arms = problem.sections.iter().all(|section| finite(section.arm));
    if !sound || !arms || !problem.gaps.iter().all(|gap| finite(gap)) {
        return Err(UnilateralError::BadLoad { load: problem.load });
    }
    match settle(problem, start) {
        Err(UnilateralError::Singular { .. } | UnilateralError::NotSettled { .. }) => {
            let stiffened = RidgedSections::of(problem);
            let sections = stiffened.sections(problem);
            let ridged = JointProblem {
                sections: &sections,
                ..*problem
            };
            settle(&ridged, &[]).or_else(|_| bracketed(&ridged))
        }
        settled => settled,
    }
}

/// The sections with what makes their compliance regular.
struct RidgedSections(Vec<DMatrix<f64>>);

impl RidgedSections {
    fn of(problem: &JointProblem) -> Self {
        Self(problem.sections.iter().map(|s| ridged(s.w)).collect())
    }

    fn sections<'b>(&'b self, problem: &JointProblem<'b>) -> Vec<Section<'b>> {
        let both = problem.sections.iter().zip(&self.0);
        both.map(|(section, w)| Section { w, ..*section }).collect()
    }
}

fn settle(problem: &JointProblem, start: &[Vec<usize>]) -> Result<JointSolution, UnilateralError> {
    let mut sets = if problem.fits(start) {
        start.to_vec()
    } else {
        first_sets(problem)
    };
    let mut factors = Factors::default();
    let mut on: Vec<Option<OnSet>> = (0..sets.len()).map(|_| None).collect();
    let mut been: Vec<Vec<Vec<usize>>> = Vec::new();
    for round in 1..=MOST_ROUNDS {
        for (i, on) in on.iter_mut().enumerate() {
            if on.as_ref().is_none_or(|on| *on.active != sets[i]) {
                *on = Some(OnSet::new(problem, i, factors.of(problem, i, &sets[i])?));
            }
        }
        let solved: Vec<&OnSet> = on.iter().flatten().collect();
        let Some(approach) = common_approach(problem, &solved) else {
            sets = first_sets(problem);
            continue;
        };
        let trials: Vec<Trial> = (solved.iter().enumerate())
            .map(|(i, on)| on.trial(&problem.slice(i, approach), approach))
            .collect();
        let next: Vec<Vec<usize>> = (trials.iter().enumerate())
            .map(|(i, trial)| trial.primal_dual_set(&problem.slice(i, approach)))
            .collect();
        if next == sets {
            return Ok(joined(problem, trials, approach, round));
        }
        been.push(sets);
        sets = next;
        if been.contains(&sets) {
            break;
        }
    }
    bracketed(problem)
}

/// Newton's method within a bracket on the load over the approach.
fn bracketed(problem: &JointProblem) -> Result<JointSolution, UnilateralError> {
    let least = least_gap(problem);
    let (mut below, mut above) = (least, f64::INFINITY);
    let mut sets = first_sets(problem);
    let mut factors = Factors::default();
    let solved = on_sets(problem, &mut factors, &sets)?;
    let mut approach =
        common_approach(problem, &solved.iter().collect::<Vec<_>>()).unwrap_or(f64::NAN);
    let mut reach = (approach - least).abs().max(f64::MIN_POSITIVE);
    let mut spent = 0;
    for _ in 0..MOST_PIECES {
        if !(below < approach && approach < above && approach.is_finite()) {
            approach = if above.is_finite() {
                0.5 * (below + above)
            } else {
                below + reach
            };
            reach *= 2.0;
        }
        for (i, set) in sets.iter_mut().enumerate() {
            let slice = problem.slice(i, approach);
            *set = match super::solve(&slice, set) {
                Ok(solution) => {
                    spent += solution.iterations;
                    solution.active
                }
                Err(UnilateralError::Separated { .. }) => Vec::new(),
                Err(error) => return Err(error),
            };
        }
        let solved = on_sets(problem, &mut factors, &sets)?;
        let solved: Vec<&OnSet> = solved.iter().collect();
        let Some(next) = common_approach(problem, &solved) else {
            below = approach;
            continue;
        };
        let moved = next - approach;
        let trials: Vec<Trial> = (solved.iter().enumerate())
            .map(|(i, on)| on.trial(&problem.slice(i, next), next))
            .collect();
        let settled = trials
            .iter()
            .enumerate()
            .all(|(i, trial)| trial.wrong(&problem.slice(i, next)).is_empty());
        if settled || moved.abs() <= CLOSED * (approach - least) {
            return Ok(joined(problem, trials, next, spent));
        }
        if moved > 0.0 {
            below = approach;
        } else {
            above = approach;
        }
        approach = next;
    }
    Err(UnilateralError::NotSettled {
        iterations: spent,
        flipping: Vec::new(),
    })
}

impl JointProblem<'_> {
    /// Whether sets of active points can be those of a start.
    pub(super) fn fits(&self, start: &[Vec<usize>]) -> bool {
        let within = |(set, gap): (&Vec<usize>, &Vec<f64>)| set.iter().all(|&k| k < gap.len());
        start.len() == self.gaps.len()
            && start.iter().any(|set| !set.is_empty())
            && start.iter().zip(self.gaps).all(within)
    }

    /// The section of slice `i`.
    fn section(&self, i: usize) -> &Section<'_> {
        &self.sections[self.at[i]]
    }

    /// The contact of slice `i` at a given approach.
    fn slice(&self, i: usize, approach: f64) -> Problem<'_> {
        let section = self.section(i);
        Problem {
            w: section.w,
            gap: &self.gaps[i],
            arm: section.arm,
            lever: section.lever,
            drive: Drive::Approach(approach),
            symmetric: self.symmetric,
        }
    }
}

/// The least approach at which anything touches.
fn least_gap(problem: &JointProblem) -> f64 {
    let of_slice = |(i, gap): (usize, &Vec<f64>)| {
        let reduced = gap.iter().zip(problem.section(i).arm).map(|(g, a)| g / a);
        reduced.fold(f64::INFINITY, f64::min)
    };
    (problem.gaps.iter().enumerate())
        .map(of_slice)
        .fold(f64::INFINITY, f64::min)
}

/// The points that touch where the nearest one alone would carry half the load.
fn first_sets(problem: &JointProblem) -> Vec<Vec<usize>> {
    let reduced: Vec<Vec<f64>> = (problem.gaps.iter().enumerate())
        .map(|(i, gap)| {
            let arm = problem.section(i).arm;
            gap.iter().zip(arm).map(|(g, a)| g / a).collect()
        })
        .collect();
    let mut nearest = (0, 0, f64::INFINITY);
    for (i, gaps) in reduced.iter().enumerate() {
        for (k, gap) in gaps.iter().enumerate() {
            if *gap < nearest.2 {
                nearest = (i, k, *gap);
            }
        }
    }
    let (i, k, least) = nearest;
    let section = problem.section(i);
    let alone = section.w[(k, k)] * problem.load / (section.arm[k] * section.lever[k]);
    let touching = |gaps: &Vec<f64>| {
        (0..gaps.len())
            .filter(|&k| gaps[k] <= least + 0.5 * alone)
            .collect()
    };
    reduced.iter().map(touching).collect()
}

/// W⁻¹ on one set, and W⁻¹ a.
pub(super) struct SetFactor {
    active: Arc<Vec<usize>>,
    factor: Option<Factor>,
    of_arm: DVector<f64>,
    lever: DVector<f64>,
}

impl SetFactor {
    fn new(problem: &Problem, active: &[usize]) -> Result<Self, UnilateralError> {
        let m = active.len();
        let mut of_arm = DMatrix::from_fn(m, 1, |i, _| problem.arm[active[i]]);
        let factor = match m {
            0 => None,
            _ => Some(Factor::of(problem, active)?),
        };
        if let Some(factor) = &factor {
            factor.solve(&mut of_arm);
        }
        Ok(Self {
            active: Arc::new(active.to_vec()),
            factor,
            of_arm: of_arm.column(0).into_owned(),
            lever: DVector::from_fn(m, |i, _| problem.lever[active[i]]),
        })
    }

    fn solve(&self, right: DVector<f64>) -> DVector<f64> {
        let columns = DMatrix::from_column_slice(right.len(), 1, right.as_slice());
        self.solved(columns).column(0).into_owned()
    }

    /// W⁻¹ of columns.
    pub(super) fn solved(&self, mut columns: DMatrix<f64>) -> DMatrix<f64> {
        if let Some(factor) = &self.factor {
            factor.solve(&mut columns);
        }
        columns
    }

    /// The set.
    pub(super) fn active(&self) -> &[usize] {
        &self.active
    }

    /// W⁻¹ a.
    pub(super) fn of_arm(&self) -> &DVector<f64> {
        &self.of_arm
    }

    /// b on the set.
    pub(super) fn lever(&self) -> &DVector<f64> {
        &self.lever
    }
}

/// Factors of the sets met so far, with the numbers of their sections.
#[derive(Default)]
pub(super) struct Factors(Vec<(usize, Arc<SetFactor>)>);

impl Factors {
    /// Of the section of slice `i`.
    fn of(
        &mut self,
        problem: &JointProblem,
        i: usize,
        active: &[usize],
    ) -> Result<Arc<SetFactor>, UnilateralError> {
        let section = problem.at[i];
        let same =
            |known: &&(usize, Arc<SetFactor>)| known.0 == section && *known.1.active == active;
        if let Some((_, known)) = self.0.iter().rev().find(same) {
            return Ok(Arc::clone(known));
        }
        let new = Arc::new(SetFactor::new(&problem.slice(i, 0.0), active)?);
        self.0.push((section, Arc::clone(&new)));
        Ok(new)
    }
}

/// One slice on a set.
pub(super) struct OnSet {
    active: Arc<Vec<usize>>,
    factor: Arc<SetFactor>,
    /// W⁻¹ g.
    of_gap: DVector<f64>,
}

impl OnSet {
    fn new(problem: &JointProblem, i: usize, factor: Arc<SetFactor>) -> Self {
        let gap = &problem.gaps[i];
        let active = Arc::clone(&factor.active);
        let right = DVector::from_fn(active.len(), |j, _| gap[active[j]]);
        Self {
            of_gap: factor.solve(right),
            active,
            factor,
        }
    }

    /// Its factor.
    pub(super) fn factor(&self) -> &SetFactor {
        &self.factor
    }

    /// W⁻¹ g.
    pub(super) fn of_gap(&self) -> &DVector<f64> {
        &self.of_gap
    }

    /// At the approach of the slice's own problem.
    fn trial(&self, slice: &Problem, approach: f64) -> Trial {
        let pressure = &self.factor.of_arm * approach - &self.of_gap;
        Trial::with(slice, self.active.to_vec(), pressure, approach)
    }
}

pub(super) fn on_sets(
    problem: &JointProblem,
    factors: &mut Factors,
    sets: &[Vec<usize>],
) -> Result<Vec<OnSet>, UnilateralError> {
    let of_slice =
        |(i, set): (usize, &Vec<usize>)| Ok(OnSet::new(problem, i, factors.of(problem, i, set)?));
    sets.iter().enumerate().map(of_slice).collect()
}

/// The approach at which the sets carry the load; none if they are all empty.
fn common_approach(problem: &JointProblem, solved: &[&OnSet]) -> Option<f64> {
    let (mut load, mut stiffness) = (problem.load, 0.0);
    for (on, weight) in solved.iter().zip(problem.weights) {
        load += weight * on.factor.lever.dot(&on.of_gap);
        stiffness += weight * on.factor.lever.dot(&on.factor.of_arm);
    }
    (stiffness != 0.0).then(|| load / stiffness)
}

fn joined(
    problem: &JointProblem,
    trials: Vec<Trial>,
    approach: f64,
    iterations: usize,
) -> JointSolution {
    let mut out = JointSolution {
        pressure: Vec::with_capacity(trials.len()),
        approach,
        active: Vec::with_capacity(trials.len()),
        iterations,
        penetration: 0.0,
    };
    // relative to the largest approach: a slice that only just touches has none of its own
    let least = least_gap(problem);
    let scale = (approach - least).abs().max(f64::MIN_POSITIVE);
    for (i, trial) in trials.into_iter().enumerate() {
        let slice = problem.slice(i, approach);
        let own = trial.scale(&slice);
        let solution = trial.into_solution(&slice, iterations);
        out.penetration = out.penetration.max(solution.penetration * own / scale);
        out.pressure.push(solution.pressure);
        out.active.push(solution.active);
    }
    out
}
