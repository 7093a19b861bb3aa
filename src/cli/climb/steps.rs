//! One step of a climb: an effect more if one pays, and what is no longer needed taken out.

use super::kept::State;
use super::version::{Fitter, Rung};
use super::{CliError, alike};
use crate::learn::climb::{Answer, ClimbStep, DoesNotPay, Proposal, proposal};
use crate::learn::diagnose::Verdict;

/// One step up if one pays; else why there is none. `is_sure`: a verdict that nothing is missing is no mere guess.
pub(super) fn step(
    state: &mut State,
    fitter: &Fitter<'_>,
    answer: &Answer,
    is_sure: bool,
    most: usize,
    watch: &(dyn Fn(String) + Sync),
) -> Result<Option<String>, CliError> {
    if let Some(ended) = ended(answer.verdict, is_sure) {
        return Ok(Some(ended.to_owned()));
    }
    if state.rungs.len() >= most {
        let stopped = format!("--most {most} allows no more; something is still missing");
        return Ok(Some(stopped));
    }
    let (mut effects, alike) = match proposal(answer) {
        Proposal::InTurn(effects) => (effects, false),
        Proposal::BestOf(effects) => (effects, true),
    };
    effects.retain(|effect| !state.has(effect));
    // without a test that it is not fitted to, the most probable goes first
    let is_choice = alike && effects.len() > 1 && state.standing.error().is_some();
    let pays = if is_choice {
        alike::best_of(&effects, state, fitter, answer, watch)?
    } else {
        first_that_pays(effects, state, fitter, answer, watch)?
    };
    let none = || "no effect that the diagnosis proposes pays".to_owned();
    Ok((!pays).then(none))
}

/// Why a verdict ends a climb, if it does.
fn ended(verdict: Verdict, is_sure: bool) -> Option<&'static str> {
    match verdict {
        Verdict::NothingMissing if is_sure => Some("nothing more is missing"),
        Verdict::NothingMissing => Some("no further effect is established"),
        Verdict::Unknown => Some("what remains is nothing that the catalogue holds"),
        Verdict::Effect | Verdict::Effects | Verdict::Partial | Verdict::Ambiguous => None,
    }
}

/// Fits one of the effects after the other and goes on from the first that pays; false if none does.
fn first_that_pays(
    effects: Vec<String>,
    state: &mut State,
    fitter: &Fitter<'_>,
    answer: &Answer,
    watch: &(dyn Fn(String) + Sync),
) -> Result<bool, CliError> {
    for effect in effects {
        let added = fitter.with_effect(&state.rungs, &state.values, &effect, answer, watch)?;
        let paid = added.standing.pays_over(&state.standing);
        let mut step = added
            .standing
            .step(Some(&state.standing), names(&added.rungs));
        step.added = Some(effect);
        refused(&mut step, paid);
        let kept = step.kept;
        state.steps.push(step);
        if kept {
            state.go_on(added);
            drop_needless(state, fitter, watch)?;
            return Ok(true);
        }
    }
    Ok(false)
}

/// Takes out effects, the newest excepted, without which the version stands as well.
pub(super) fn drop_needless(
    state: &mut State,
    fitter: &Fitter<'_>,
    watch: &(dyn Fn(String) + Sync),
) -> Result<(), CliError> {
    let mut place = 0;
    while place + 1 < state.rungs.len() {
        let mut rungs = state.rungs.clone();
        let removed = rungs.remove(place);
        let without = fitter.fit(rungs, &state.values, &|doing| {
            watch(format!("without {}: {doing}", removed.effect));
        })?;
        if state.standing.pays_over(&without.standing).is_ok() {
            place += 1;
            continue;
        }
        let mut step = (without.standing).step(Some(&state.standing), names(&without.rungs));
        step.removed = Some(removed.effect);
        state.steps.push(step);
        state.go_on(without);
    }
    Ok(())
}

pub(super) fn refused(step: &mut ClimbStep, paid: Result<(), DoesNotPay>) {
    if let Err(why) = paid {
        step.kept = false;
        step.why = Some(why.to_string());
    }
}

pub(super) fn names(rungs: &[Rung]) -> Vec<String> {
    rungs.iter().map(|rung| rung.effect.clone()).collect()
}
