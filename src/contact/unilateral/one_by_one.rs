//! The method that cannot cycle, for sets that do not settle.

use super::trial::{CLOSED, Trial};
use super::{Drive, PRIMAL_DUAL_LIMIT, Problem, Solution, UnilateralError, nearest};

/// Primal active-set method, one change per iteration.
pub(super) fn one_by_one(problem: &Problem) -> Result<Solution, UnilateralError> {
    let n = problem.gap.len();
    let limit = 50 * n + 100;
    let (start, _) = nearest(problem)?;
    let mut feasible = vec![0.0; n];
    let mut active = vec![start];
    if let Drive::Load(load) = problem.drive {
        feasible[start] = load / problem.lever[start];
    }
    let mut last = Vec::new();
    // points that were taken in and had to go at once, without a step between: rounding, not contact
    let mut barred = vec![false; n];
    for iteration in 1..=limit {
        let trial = Trial::on(problem, active.clone())?;
        // largest step towards the trial that keeps every pressure ≥ 0
        let mut step = 1.0;
        let mut blocking = None;
        for (&k, &p) in trial.active.iter().zip(trial.pressure.iter()) {
            if p < 0.0 {
                let t = feasible[k] / (feasible[k] - p);
                if t < step {
                    step = t;
                    blocking = Some(k);
                }
            }
        }
        for (&k, &p) in trial.active.iter().zip(trial.pressure.iter()) {
            feasible[k] += step * (p - feasible[k]);
        }
        if let Some(k) = blocking {
            feasible[k] = 0.0;
            active.retain(|&a| a != k);
            barred[k] |= step == 0.0 && last == [k];
            last = vec![k];
            if active.is_empty() {
                return Err(UnilateralError::Separated {
                    gap: 0.0,
                    approach: trial.approach,
                });
            }
            continue;
        }
        let scale = trial.scale(problem);
        let worst = (0..n)
            .filter(|k| !barred[*k] && trial.active.binary_search(k).is_err())
            .map(|k| (k, trial.residual[k] / problem.arm[k].abs()))
            .min_by(|a, b| a.1.total_cmp(&b.1));
        match worst {
            Some((k, violation)) if violation < -CLOSED * scale => {
                active.push(k);
                last = vec![k];
            }
            _ => return Ok(trial.into_solution(problem, PRIMAL_DUAL_LIMIT + iteration)),
        }
    }
    Err(UnilateralError::NotSettled {
        iterations: limit,
        flipping: last,
    })
}
