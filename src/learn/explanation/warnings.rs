//! What keeps an answer from being trusted.

use super::ranked::{form, parameters};
use super::wording::values;
use crate::effects::Card;
use crate::learn::candidates::fitted_candidate::{AS_WELL, BaseFit, FittedCandidate};
use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::checks::common_scatter;
use crate::learn::checks::noise_level;
use crate::learn::checks::one_part::{OddPart, one_part};
use crate::learn::checks::outlying_curves;
use crate::learn::checks::sufficiency::{few, measured_once, unknowns};
use crate::learn::decision::judged_candidates::JudgedCandidates;
use crate::learn::decision::{Decision, Verdict};
use crate::learn::fitting::collinear::act_together;
use crate::learn::fitting::quantity_misfit::carried_by;
use crate::learn::fitting::test_apart::test_apart;
use crate::learn::hypothesis::parameters::{Estimate, short};
use crate::learn::hypothesis::{EffectSet, Hypothesis};
use crate::learn::model_search::context::Context;
use crate::learn::noise::SigmaModel;
use crate::numeric::written::significant;

/// Share of a parameter's prior outside of which a value is told.
const UNHEARD_OF: f64 = 1e-3;

/// What keeps an answer from being trusted.
pub(in crate::learn) fn warnings(
    context: &Context<'_>,
    base: &BaseFit,
    posterior: &JudgedCandidates,
    not_fitted: &[Hypothesis],
) -> Vec<String> {
    let likelihood = &context.likelihood;
    let mut warnings = Vec::new();
    if context.approximate {
        warnings.push(
            "decided by the analytic contact model, whose curves differ from finite elements (in the mean depth by 4 and 7 % for the paper's pair, by more at deep wear; `gearwear models STUDY` \
             says by how much for this one) and may mask or mimic an effect: repeat with --fidelity middle before acting on this".to_owned(),
        );
    }
    warnings.extend(of_one_test(likelihood, base));
    warnings.extend(of_sigma(
        likelihood,
        base,
        spoken_of(base, posterior),
        context.approximate,
    ));
    warnings.extend(likelihood.measured.data.places_not_used());
    warnings.extend(of_scarcity(likelihood, base));
    warnings.extend(of_curves(likelihood, base, posterior));
    warnings.extend(of_fits(base, posterior));
    if !not_fitted.is_empty() {
        let names: Vec<String> = not_fitted.iter().map(Hypothesis::to_string).collect();
        warnings.push(format!(
            "not judged, since their fits failed: {}",
            names.join(", ")
        ));
    }
    warnings
}

/// The model that the verdict leaves: the study's own or, where effects lead, these. Without anything unknown beside them: what a fit beside it
/// leaves is not the misfit of any model.
fn spoken_of<'p>(base: &'p BaseFit, posterior: &'p JudgedCandidates) -> &'p FittedCandidate {
    let alone = leads_alone(&posterior.decision);
    let fitted = alone.and_then(|alone| posterior.fitted(base, &alone));
    fitted.unwrap_or(&base.fitted)
}

/// The effects that lead, by themselves; None where the study's own model is spoken of.
fn leads_alone(decision: &Decision) -> Option<Hypothesis> {
    match decision.verdict {
        Verdict::NothingMissing | Verdict::Unknown => None,
        _ => Some(Hypothesis::Effects(decision.leading_effects()?.clone())),
    }
}

/// A test whose k, by the study's own model, lies apart from those of the others.
fn of_one_test(likelihood: &Likelihood<'_>, base: &BaseFit) -> Option<String> {
    let apart = test_apart(&base.fitted.found.state.epsilon)?;
    let test = likelihood.tests[apart.test];
    Some(apart.in_words(&likelihood.measured.study().tests[test].id))
}

/// Where the scatter is not as stated, or a few rows carry the misfit.
fn of_sigma(
    likelihood: &Likelihood<'_>,
    base: &BaseFit,
    leading: &FittedCandidate,
    approximate: bool,
) -> Vec<String> {
    let mut warnings = Vec::new();
    let sigma = likelihood.noise.sigma;
    warnings.extend(noise_level::replaced(likelihood));
    let new_profile_um = likelihood.noise.new_profile_um;
    if new_profile_um > likelihood.measured.study().noise.new_profile_um {
        let model = &base.fitted.found.model;
        warnings.push(common_scatter::counted(likelihood, model, new_profile_um));
    }
    if sigma == SigmaModel::AS_STATED
        && let Some(smooth) = noise_level::too_smooth(likelihood, &base.fitted.found.model)
    {
        warnings.push(noise_level::smooth_in_words(smooth));
    }
    let standardised = likelihood.standardised(&leading.found.model);
    let rows = (0..likelihood.len()).map(|row| likelihood.observation(row));
    let with = match leading.candidate.effects.is_empty() {
        true => String::new(),
        false => format!(" with {}", leading.candidate.effects.in_words()),
    };
    let or = match approximate {
        true => ", or the analytic model is wrong there, which --fidelity middle would show",
        false => "",
    };
    warnings.extend(carried_by(rows.zip(standardised), &with, or));
    // rows stand apart by so many stated sigmas
    if matches!(sigma, SigmaModel::Stated { .. }) {
        warnings.extend(likelihood.measured.data.outliers_counted());
    }
    warnings
}

/// Where too little was measured to tell something.
fn of_scarcity(likelihood: &Likelihood<'_>, base: &BaseFit) -> Vec<String> {
    let mut warnings = Vec::new();
    let alone = measured_once(likelihood);
    if alone.len() == likelihood.tests.len() {
        warnings.push(
            "every test was measured at one number of cycles only: what changes over life (running-in, debris, ageing, polishing) cannot be told from a constant".to_owned(),
        );
    } else if !alone.is_empty() {
        warnings.push(format!(
            "measured at one number of cycles only: {}",
            alone.join(", ")
        ));
    }
    if likelihood.tests.len() == 1 {
        warnings.push(
            "there is one test only: what depends on torque, speed or misalignment cannot be told from what does not".to_owned(),
        );
    }
    let unknowns = unknowns(likelihood, base);
    if likelihood.len() <= unknowns {
        warnings.push(format!(
            "there are about {unknowns} unknowns and no more measured values ({}): no effect can show",
            likelihood.len()
        ));
    } else if few(likelihood, base) {
        warnings.push(format!(
            "{} measured values are few for about {unknowns} unknowns: only strong effects can show",
            likelihood.len()
        ));
    }
    warnings
}

/// The part of the measurements that carries the misfit, where no effect is named and no single curve is far from the others.
pub(super) fn odd_part(
    likelihood: &Likelihood<'_>,
    base: &BaseFit,
    posterior: &JudgedCandidates,
) -> Option<OddPart> {
    let model = &base.fitted.found.model;
    let is_named = matches!(
        posterior.decision.verdict,
        Verdict::Effect | Verdict::Effects
    );
    if is_named || !outlying_curves::suspects(likelihood, model).is_empty() {
        return None;
    }
    one_part(likelihood, model)
}

/// Curves that are far from the others, or a test or a quantity that carries the misfit.
fn of_curves(
    likelihood: &Likelihood<'_>,
    base: &BaseFit,
    posterior: &JudgedCandidates,
) -> Vec<String> {
    let suspects = outlying_curves::suspects(likelihood, &base.fitted.found.model);
    if let Some(part) = odd_part(likelihood, base, posterior) {
        vec![part.warning]
    } else if suspects.is_empty() {
        // what a fit that has not come to its end leaves speaks of the fit
        let leader = posterior.leader().filter(|leader| leader.converged);
        let mut models = std::iter::once(&base.fitted).chain(leader);
        let alone = models.find_map(|j| outlying_curves::alone(likelihood, base, &j.found.model));
        alone.into_iter().collect()
    } else {
        suspects
    }
}

/// Fits that did not converge, and parameters of a leader that is spoken of which are on a bound, known only together or of an unheard-of size.
fn of_fits(base: &BaseFit, posterior: &JudgedCandidates) -> Vec<String> {
    let mut warnings = Vec::new();
    if !base.fitted.converged {
        warnings
            .push("the fit of the base model did not converge: probabilities are rough".to_owned());
    }
    if let Some(leader) = posterior.leader() {
        let deciding = posterior.decision.group.first();
        let beside = deciding.filter(|first| matches!(first, Hypothesis::EffectsAndUnknown(_)));
        let beside = beside.and_then(|first| posterior.fitted(base, first));
        warnings.extend(not_converged(
            &leader.candidate.effects.in_words(),
            leader.converged,
            beside.map(|beside| beside.converged),
        ));
        if leads_alone(&posterior.decision).is_some() {
            for p in parameters(leader).iter().filter(|p| p.at_bound) {
                warnings.push(format!(
                    "{} of {} lies on its bound, {}",
                    p.name,
                    leader.candidate.hypothesis(),
                    short(p.value)
                ));
            }
            warnings.extend(together(leader));
        }
        warnings.extend(unsettled_form(posterior, leader));
        let decision = &posterior.decision;
        let probability = match decision.verdict {
            Verdict::Partial => decision.probability_in_all(&leader.candidate.effects),
            _ => decision.probability(&leader.candidate.hypothesis()),
        };
        if probability > 0.5 {
            warnings.extend(unheard_of(leader, ""));
        } else if decision.verdict == Verdict::Ambiguous {
            let rivals = decision.group.iter();
            let rivals = rivals.filter_map(|rival| Some((rival, posterior.fitted(base, rival)?)));
            // what is fitted to nothing may have any size
            let does_something = |(_, fitted): &(&Hypothesis, &FittedCandidate)| {
                base.fitted.square - fitted.square > 2.0 * AS_WELL
            };
            warnings.extend(
                rivals
                    .filter(does_something)
                    .flat_map(|(rival, fitted)| unheard_of(fitted, &format!("{rival}: "))),
            );
        }
    }
    warnings
}

/// That other forms of the leading effects explain as much, or were not fitted: the parameters are those of one form.
fn unsettled_form(posterior: &JudgedCandidates, leader: &FittedCandidate) -> Option<String> {
    if !matches!(
        posterior.decision.verdict,
        Verdict::Effect | Verdict::Effects | Verdict::Partial
    ) {
        return None;
    }
    let effects = &leader.candidate.effects;
    if let Some(beside) = beside_in_other_form(posterior, leader) {
        let all: Vec<(usize, &'static Card)> =
            effects.cards().iter().copied().enumerate().collect();
        let [beside, alone] = [beside, leader].map(|fitted| form_in_words(fitted, &all));
        return Some(of_other_form(
            &effects.in_words(),
            [&beside, &alone],
            &values(leader),
        ));
    }
    let (others, as_good) = other_forms(posterior, leader);
    // an effect that all of them have in one form has that for sure
    let cards = effects.cards().iter().copied();
    let differs = |n: usize| {
        let of = |fitted: &FittedCandidate| fitted.candidate.forms[n].map(|form| form.name);
        as_good.iter().any(|other| of(other) != of(leader))
    };
    let is_untried = |n: usize, card: &Card| {
        let of = |fitted: &FittedCandidate| fitted.candidate.forms[n].map(|form| form.name);
        !card.forms.is_empty() && others.iter().all(|other| of(other) == of(leader))
    };
    let open: Vec<(usize, &'static Card)> = (cards.enumerate())
        .filter(|&(n, card)| differs(n) || as_good.is_empty() && is_untried(n, card))
        .collect();
    let as_good: Vec<String> = (as_good.iter())
        .map(|other| form_in_words(other, &open))
        .collect();
    let of_open = EffectSet::new(open.iter().map(|(_, card)| *card));
    let one_alone = effects.len() > 1 && as_good.is_empty() && !open.is_empty();
    form_warning(
        &of_open.in_words(),
        &form_in_words(leader, &open),
        &as_good,
        one_alone,
    )
}

/// The leading effects' fit beside something unknown, where that is in another form than what leads by itself.
fn beside_in_other_form<'p>(
    posterior: &'p JudgedCandidates,
    leader: &FittedCandidate,
) -> Option<&'p FittedCandidate> {
    let Some(Hypothesis::EffectsAndUnknown(effects)) = posterior.decision.group.first() else {
        return None;
    };
    let mut all = posterior.beside_unknown.iter().map(|beside| &beside.fitted);
    let own = all.find(|fitted| fitted.candidate.effects == *effects)?;
    (*effects == leader.candidate.effects && form(own) != form(leader)).then_some(own)
}

/// `forms`: beside something unknown, and alone with these `values`.
fn of_other_form(effects: &str, [beside, alone]: [&str; 2], values: &str) -> String {
    format!(
        "the parameters of {effects} beside what is left are those of its form {beside}; by itself its form {alone} explains most ({values}). With what is left in the model too they may \
         change: gearwear add takes either form, with --form"
    )
}

/// Fits of the leading effects in other forms, and those of them that explain as much.
pub(super) fn other_forms<'p>(
    posterior: &'p JudgedCandidates,
    leader: &FittedCandidate,
) -> (Vec<&'p FittedCandidate>, Vec<&'p FittedCandidate>) {
    let effects = &leader.candidate.effects;
    let own = posterior.candidates.iter();
    let others: Vec<&FittedCandidate> = own
        .filter(|other| other.candidate.effects == *effects && form(other) != form(leader))
        .collect();
    let is_as_good = |other: &&FittedCandidate| other.does_as_well_as(leader);
    let as_good = others.iter().copied().filter(is_as_good).collect();
    (others, as_good)
}

/// The forms of some of a fit's effects, told by their places in it, the cards' own ones too.
fn form_in_words(fitted: &FittedCandidate, of: &[(usize, &'static Card)]) -> String {
    let names = of.iter().map(|&(n, card)| {
        let name = fitted.candidate.forms[n].map_or("own", |form| form.name);
        match of.len() {
            1 => format!("\"{name}\""),
            _ => format!("{} \"{name}\"", card.name),
        }
    });
    names.collect::<Vec<_>>().join(" with ")
}

/// `others`: the forms that are as good; `one_alone`: no other one was fitted.
fn form_warning(effects: &str, form: &str, others: &[String], one_alone: bool) -> Option<String> {
    let why = match others {
        [] if !one_alone => return None,
        [] => "no other was fitted, and one may explain the data as well".to_owned(),
        [one] => format!("{one} explains the data as well"),
        others => format!("{} explain the data as well", others.join(" and ")),
    };
    Some(format!(
        "the parameters of {effects} and their intervals hold for one form of the law ({form}): {why}, with other values. gearwear add fits this form and the effect's own, and any other with --form"
    ))
}

/// Which fits with `effects` did not converge: that with them alone, and the one beside something unknown where the verdict rests on that.
fn not_converged(effects: &str, alone: bool, beside: Option<bool>) -> Option<String> {
    match (alone, beside) {
        (true, None | Some(true)) => None,
        (false, None) => Some(format!(
            "the fit with {effects} did not converge: its parameters are rough"
        )),
        (false, Some(true)) => Some(format!(
            "the fit with {effects} alone did not converge: its χ² and what it leaves are rough; the one beside something unknown, on which the verdict rests, did"
        )),
        (_, Some(false)) => Some(format!(
            "the fit with {effects} beside something unknown, on which the verdict rests, did not converge: the verdict and its parameters are rough"
        )),
    }
}

/// Which of its effects' parameters the data know only together.
fn together(fitted: &FittedCandidate) -> Vec<String> {
    let candidate = &fitted.candidate;
    let c = &fitted.covariance;
    let first = c.nrows() - candidate.parameters.len();
    let own: Vec<usize> = (candidate.inherited..candidate.parameters.len()).collect();
    let sd = |i: usize| c[(first + i, first + i)].max(f64::MIN_POSITIVE).sqrt();
    let estimate = |&i: &usize| {
        let mode = fitted.found.state.theta[i];
        candidate.parameters[i].estimate(mode, mode, sd(i))
    };
    let estimates: Vec<Estimate> = own.iter().map(estimate).collect();
    let row = |&i: &usize| -> Vec<f64> {
        let all = own.iter();
        all.map(|&j| c[(first + i, first + j)] / (sd(i) * sd(j)))
            .collect()
    };
    act_together(&estimates, &own.iter().map(row).collect::<Vec<_>>())
}

/// Parameters of the added effects that lie outside nearly all of what the catalogue holds for possible; `whose`: with which words each begins.
fn unheard_of(fitted: &FittedCandidate, whose: &str) -> Vec<String> {
    let candidate = &fitted.candidate;
    let added =
        (candidate.parameters.iter().zip(&fitted.found.state.theta)).skip(candidate.inherited);
    let outside = added.filter_map(|(parameter, &natural)| {
        let value = parameter.value(natural);
        let [low, high] = [0.5 * UNHEARD_OF, 1.0 - 0.5 * UNHEARD_OF].map(|p| parameter.quantile(p));
        let is_outside = value < low || value > high;
        let looks_inside = [low, high].map(|end| significant(end, 2)).contains(&significant(value, 2));
        (is_outside && !looks_inside).then(|| {
            format!(
                "{whose}{} would be {}, where nearly all of the catalogue's prior lies between {} and {}: the name holds only if such a size makes sense here",
                parameter.name,
                short(value),
                significant(low, 2),
                significant(high, 2)
            )
        })
    });
    outside.collect()
}

#[cfg(test)]
mod tests {
    use super::{form_warning, leads_alone, not_converged, of_other_form};
    use crate::effects::find;
    use crate::learn::decision::{Decision, Verdict};
    use crate::learn::hypothesis::{EffectSet, Hypothesis};

    /// What a fit beside something unknown leaves is no model's misfit: that of the effect alone is told, as `add` and `compare` would find it.
    #[test]
    fn the_misfit_told_is_that_of_the_effects_by_themselves() {
        let set = EffectSet::new([find("tip_relief").unwrap()]);
        let told = |verdict| {
            leads_alone(&Decision {
                verdict,
                log_probabilities: [].into(),
                effects: vec![set.clone()],
                group: vec![Hypothesis::EffectsAndUnknown(set.clone())],
            })
        };
        assert_eq!(
            told(Verdict::Partial),
            Some(Hypothesis::Effects(set.clone()))
        );
        assert_eq!(told(Verdict::Unknown), None);
        assert_eq!(told(Verdict::NothingMissing), None);
    }

    #[test]
    fn a_form_beside_what_is_left_that_is_not_the_one_alone_is_told() {
        let forms = ["\"hyperbolic\"", "\"own\""];
        let said = of_other_form("running_in", forms, "amplitude 2.50 ± 0.09");
        assert!(
            said.contains("its form \"own\" explains most (amplitude 2.50 ± 0.09)"),
            "{said}"
        );
    }

    #[test]
    fn values_of_one_form_among_several_are_told_as_such() {
        let two = ["\"own\"".to_owned(), "\"hyperbolic\"".to_owned()];
        let said = form_warning("running_in", "\"steep hyperbolic\"", &two, false).unwrap();
        assert!(
            said.contains(
                "one form of the law (\"steep hyperbolic\"): \"own\" and \"hyperbolic\" explain the data as well"
            ),
            "{said}"
        );
        let one = form_warning("running_in", "\"own\"", &two[1..], false).unwrap();
        assert!(one.contains("\"hyperbolic\" explains the data"), "{one}");
        assert!(form_warning("running_in", "own", &[], false).is_none());
        let pair = form_warning("running_in and tip_relief", "own and own", &[], true).unwrap();
        assert!(pair.contains("no other was fitted"), "{pair}");
    }

    #[test]
    fn it_is_said_which_fit_did_not_converge() {
        let said = |alone, beside| not_converged("tip_relief", alone, beside);
        assert!(said(true, None).is_none() && said(true, Some(true)).is_none());
        let alone = said(false, Some(true)).unwrap();
        assert!(
            alone.starts_with("the fit with tip_relief alone did not"),
            "{alone}"
        );
        assert!(alone.contains("on which the verdict rests, did"), "{alone}");
        let deciding = said(true, Some(false)).unwrap();
        assert!(
            deciding.contains("on which the verdict rests, did not"),
            "{deciding}"
        );
        let plain = said(false, None).unwrap();
        assert!(plain.contains("tip_relief did not converge"), "{plain}");
    }
}
