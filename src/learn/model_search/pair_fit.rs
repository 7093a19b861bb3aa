//! Fits of two effects together by the middle fidelity.

use rayon::prelude::*;

use super::context::Context;
use crate::learn::candidates::candidate_model::{AnchoredOn, model};
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::inference::quadratic::State;
use crate::learn::inference::search::{Effort, SearchEnd};
use crate::learn::prediction::fidelity::Fidelity;
use crate::learn::prediction::gear_model::GearModel;

/// Log evidence by which a pair must promise to beat the best single effect to be looked at.
pub(in crate::learn) const PROMISE: f64 = 6.0;
/// The first look at each pair.
pub(in crate::learn) const LOOK: Effort = Effort {
    iterations: 2,
    tolerance: 0.3,
    floor: 0.3,
    carry: 0.7,
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
#[derive(Clone)]
pub(in crate::learn) struct PairStart {
    pub(in crate::learn) candidate: Candidate,
    pub(in crate::learn) state: State,
    /// To be added to the middle fidelity, per test of the data set.
    pub(in crate::learn) offset: Vec<Vec<f64>>,
}

impl PairStart {
    /// Both single fits together: the stronger effect's gives the state, the other's parameters join it.
    pub(in crate::learn) fn of(base: &BaseFit, a: &FittedCandidate, b: &FittedCandidate) -> Self {
        let (first, second) = if a.square <= b.square { (a, b) } else { (b, a) };
        let candidate: Candidate = first.candidate.with(&second.candidate);
        let added = &second.found.state.theta[candidate.inherited..];
        let state = &first.found.state;
        // what is to be added moves with the centre distance
        let moves = |single: &FittedCandidate| single.candidate.moves_the_centres();
        let anchor = if moves(second) && !moves(first) {
            second
        } else {
            first
        };
        let offset = if anchor.offset.is_empty() {
            &base.fitted.offset
        } else {
            &anchor.offset
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
pub(in crate::learn) fn fit(
    context: &Context<'_>,
    base: &BaseFit,
    starts: Vec<PairStart>,
) -> Vec<FittedCandidate> {
    // one model for both fits of a pair: it keeps its histories
    let models: Vec<GearModel<'_>> = starts
        .iter()
        .map(|pair| model(context.middle, &pair.candidate))
        .collect();
    let searched = |place: usize, state: State, effort: &Effort| -> Option<SearchEnd> {
        let pair = &starts[place];
        let predictor = AnchoredOn::new(&models[place], pair.offset.clone());
        let parameters = &pair.candidate.parameters;
        let found = (context.likelihood).fit(&predictor, parameters, state, effort);
        context.stages.one_done();
        found.ok()
    };
    let mut looks: Vec<(usize, SearchEnd)> = (0..starts.len())
        .into_par_iter()
        .filter_map(|place| Some((place, searched(place, starts[place].state.clone(), &LOOK)?)))
        .collect();
    looks.sort_by(|a, b| a.1.objective.total_cmp(&b.1.objective));
    let best = looks.first().map_or(0.0, |look| look.1.objective);
    let gain = (base.fitted.found.objective - best).max(0.0);
    (looks.into_par_iter().enumerate())
        .map(|(rank, (place, mut found))| {
            let leads = rank < FOLLOWED || found.objective < best + NEAR * gain;
            if leads && !found.converged {
                let further = searched(place, found.state.clone(), &FURTHER);
                found = further.unwrap_or(found);
            }
            FittedCandidate::new(
                &context.likelihood,
                starts[place].candidate.clone(),
                found,
                starts[place].offset.clone(),
                Some(base),
                Fidelity::Middle,
            )
        })
        .collect()
}
