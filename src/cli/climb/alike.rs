//! A step up by one of several effects that the data cannot tell apart.

use super::CliError;
use super::kept::State;
use super::steps::{drop_needless, names, refused};
use super::version::{Fitted, Fitter};
use crate::learn::climb::{Answer, Standing, choose};

/// Fits each of the effects and goes on from the one that does best by evidence and the error on tests that it was not fitted to combined; false if none pays.
pub(super) fn best_of(
    effects: &[String],
    state: &mut State,
    fitter: &Fitter<'_>,
    answer: &Answer,
    watch: &(dyn Fn(String) + Sync),
) -> Result<bool, CliError> {
    let before = state.standing;
    let fit =
        |effect: &String| fitter.with_effect(&state.rungs, &state.values, effect, answer, watch);
    let fitted: Vec<Fitted> = effects.iter().map(fit).collect::<Result<_, _>>()?;
    let paid: Vec<_> = (fitted.iter())
        .map(|fitted| fitted.standing.pays_over(&before))
        .collect();
    let standing: Vec<(&str, Standing, bool)> = (effects.iter().zip(&fitted).zip(&paid))
        .map(|((effect, fitted), paid)| (effect.as_str(), fitted.standing, paid.is_ok()))
        .collect();
    let choice = choose(&standing);
    let chosen = choice.as_ref().map(|choice| choice.place);
    for (place, ((effect, fitted), paid)) in effects.iter().zip(&fitted).zip(paid).enumerate() {
        let mut step = fitted.standing.step(Some(&before), names(&fitted.rungs));
        step.added = Some(effect.clone());
        refused(&mut step, paid);
        if let Some(choice) = &choice {
            if choice.place == place {
                step.choice = Some(choice.why.clone());
            } else if step.kept {
                step.kept = false;
                step.why = Some(choice.why_not.clone());
            }
        }
        state.steps.push(step);
    }
    let Some(best) = chosen.and_then(|place| fitted.into_iter().nth(place)) else {
        return Ok(false);
    };
    state.go_on(best);
    drop_needless(state, fitter, watch)?;
    Ok(true)
}
