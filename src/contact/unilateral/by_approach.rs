//! The safe method where there is no energy to descend: friction makes the compliance unsymmetric, or the lever of the load is not
//! that of the motion.
//!
//! At a given approach the contact is a linear complementarity problem with a P-matrix (unless friction is extreme), which has
//! one solution. Block principal pivoting exchanges all points that are on the wrong side at once, and as soon as that no longer makes
//! them fewer, Murty's rule exchanges the last of them alone, which cannot cycle on a P-matrix: Murty, Linear Algebra Appl. 7
//! (1974); Júdice & Pires, Comput. Oper. Res. 21 (1994). The load is a continuous, piecewise linear function of the
//! approach, so Newton's method within a bracket ends on the right piece.

use super::trial::{CLOSED, Trial};
use super::{Drive, Problem, Solution, UnilateralError, alone, nearest, symmetric_difference};

/// Exchanges of all wrong points at once that may pass without making them fewer.
const PATIENCE: usize = 10;

/// Pieces of the load over the approach that may be tried.
const MOST_PIECES: usize = 200;

/// The contact under a given load, by contacts at given approaches.
pub(super) fn by_approach(problem: &Problem, start: &[usize]) -> Result<Solution, UnilateralError> {
    let mut spent = 0;
    let load = match problem.drive {
        Drive::Load(load) => load,
        Drive::Approach(phi) => {
            let set = at_approach(problem, phi, start, &mut spent)?;
            return Ok(Trial::on(problem, set)?.into_solution(problem, spent));
        }
    };
    let mut set = start.to_vec();
    let mut phi = Trial::on(problem, set.clone())?.approach;
    // nothing touches at the least gap; doubled steps up from there end where the load is too large
    let (nearest, least) = nearest(problem)?;
    let (mut below, mut above) = (least, f64::INFINITY);
    let mut reach = alone(problem, nearest, load);
    let mut changed = Vec::new();
    for _ in 0..MOST_PIECES {
        if !(below < phi && phi < above && phi.is_finite()) {
            phi = if above.is_finite() {
                0.5 * (below + above)
            } else {
                below + reach
            };
            reach *= 2.0;
        }
        let next = at_approach(problem, phi, &set, &mut spent)?;
        if next.is_empty() {
            below = phi;
            continue;
        }
        // the approach at which the points that touch here carry the load
        let trial = Trial::on(problem, next.clone())?;
        let moved = trial.approach - phi;
        if trial.wrong(problem).is_empty() || moved.abs() <= CLOSED * (phi - least) {
            return Ok(trial.into_solution(problem, spent));
        }
        if moved > 0.0 {
            below = phi;
        } else {
            above = phi;
        }
        phi = trial.approach;
        changed = symmetric_difference(&next, &set);
        set = next;
    }
    Err(UnilateralError::NotSettled {
        iterations: spent,
        flipping: changed,
    })
}

/// The points that touch at the approach `phi`, ascending.
fn at_approach(
    problem: &Problem,
    phi: f64,
    start: &[usize],
    spent: &mut usize,
) -> Result<Vec<usize>, UnilateralError> {
    let problem = &Problem {
        drive: Drive::Approach(phi),
        ..*problem
    };
    let n = problem.gap.len();
    let mut set = start.to_vec();
    let (mut fewest, mut patience) = (n + 1, PATIENCE);
    let limit = 50 * n + 100;
    let mut flipping = Vec::new();
    for _ in 0..limit {
        *spent += 1;
        let trial = Trial::on(problem, set)?;
        let wrong = trial.wrong(problem);
        let Some(&last) = wrong.last() else {
            return Ok(trial.active);
        };
        let exchanged = if wrong.len() < fewest {
            (fewest, patience) = (wrong.len(), PATIENCE);
            &wrong[..]
        } else if patience > 0 {
            patience -= 1;
            &wrong[..]
        } else {
            &[last][..]
        };
        set = symmetric_difference(&trial.active, exchanged);
        flipping = exchanged.to_vec();
    }
    Err(UnilateralError::NotSettled {
        iterations: limit,
        flipping,
    })
}
