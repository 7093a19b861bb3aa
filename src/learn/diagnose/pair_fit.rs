//! Fits of two effects together by the middle fidelity.

use rayon::prelude::*;

use super::anchored::{Anchored, model};
use super::candidate::Candidate;
use super::fidelity::Fidelity;
use super::judge::{Base, Judge, Judged};
use crate::learn::quadratic::State;
use crate::learn::search::{Effort, Found};

/// The first look at each pair.
pub(super) const LOOK: Effort = Effort {
    iterations: 2,
    tolerance: 0.3,
    floor: 0.3,
    ..Effort::STAY
};
/// The further fit of those that lead after it: this many, and all within this share of the leader's gain.
const FURTHER: Effort = Effort {
    iterations: 5,
    ..LOOK
};
const FOLLOWED: usize = 2;
const NEAR: f64 = 0.05;

/// Where the fit of a pair begins.
pub(super) struct PairStart {
    pub(super) candidate: Candidate,
    pub(super) state: State,
    /// To be added to the middle fidelity, per test of the data set.
    pub(super) offset: Vec<Vec<f64>>,
}

impl PairStart {
    /// Both single fits together: the stronger effect's gives the state, the other's parameters join it.
    pub(super) fn of(base: &Base, a: &Judged, b: &Judged) -> Self {
        let (first, second) = if a.square <= b.square { (a, b) } else { (b, a) };
        let candidate: Candidate = first.candidate.with(&second.candidate);
        let added = &second.found.state.theta[candidate.inherited..];
        let state = &first.found.state;
        let offset = if first.offset.is_empty() {
            &base.judged.offset
        } else {
            &first.offset
        };
        Self {
            state: State {
                theta: state.theta.iter().chain(added).copied().collect(),
                ..state.clone()
            },
            offset: offset.clone(),
            candidate,
        }
    }
}

/// Fits all `starts`: a first look at each, then in full those that lead.
pub(super) fn fit(judge: &Judge<'_>, base: &Base, starts: Vec<PairStart>) -> Vec<Judged> {
    let searched = |pair: &PairStart, state: State, effort: &Effort| -> Option<Found> {
        let predictor = Anchored::new(model(judge.middle, &pair.candidate), pair.offset.clone());
        let parameters = &pair.candidate.parameters;
        judge.ground.fit(&predictor, parameters, state, effort).ok()
    };
    let mut looks: Vec<(PairStart, Found)> = (starts.into_par_iter())
        .filter_map(|pair| {
            let found = searched(&pair, pair.state.clone(), &LOOK)?;
            Some((pair, found))
        })
        .collect();
    looks.sort_by(|a, b| a.1.objective.total_cmp(&b.1.objective));
    let best = looks.first().map_or(0.0, |look| look.1.objective);
    let gain = (base.judged.found.objective - best).max(0.0);
    (looks.into_par_iter().enumerate())
        .map(|(place, (pair, mut found))| {
            let leads = place < FOLLOWED || found.objective < best + NEAR * gain;
            if leads && !found.converged {
                let further = searched(&pair, found.state.clone(), &FURTHER);
                found = further.unwrap_or(found);
            }
            judge.judged(
                pair.candidate,
                found,
                pair.offset,
                Some(base),
                Fidelity::Middle,
            )
        })
        .collect()
}
