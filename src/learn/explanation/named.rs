//! What is said where effects are named: how they show, and why not the runner-up.

use super::findings::Findings;
use super::warnings::other_forms;
use super::wording::{
    Explanation, added, before, chance, change, chi2, in_other_forms, percent, values,
};
use crate::effects::{Card, Form};
use crate::learn::candidates::fitted_candidate::FittedCandidate;
use crate::learn::hypothesis::{EffectSet, Hypothesis};
use crate::learn::model_search::second_effects;
use crate::numeric::written::significant;

/// Scatter that is worth a word where an effect takes it away, and what is then left of it at most.
const SOME_SCATTER: f64 = 0.01;
const LESS: f64 = 0.7;
/// Ratio of probabilities below which they are about the same.
const CLEARLY: f64 = 1.5;
/// Log evidence to the runner-up below which what separates the two is told.
const CLOSE: f64 = 5.0;

pub(super) fn named(findings: &Findings<'_>, leader: &FittedCandidate) -> Explanation {
    let candidate = &leader.candidate;
    let several = candidate.effects.len() > 1;
    let shows = |(card, form): (&'static Card, Option<&'static Form>)| {
        let own = form.map_or("", |form| form.signature);
        let signature = if own.is_empty() { card.signature } else { own };
        format!("How {} shows: {signature}.", card.name)
    };
    let weaker = weaker_beside(findings, leader);
    let is_settled = other_forms(findings.posterior, leader).1.is_empty();
    let mut next_step = match (candidate.effects.cards(), is_settled) {
        // every form is fitted
        ([card], false) => format!("gearwear add STUDY {}", card.name),
        _ => added(candidate),
    };
    if weaker.is_some() {
        next_step += ", then diagnose the new study: something weaker may be left";
    }
    Explanation {
        sentence: format!(
            "{} missing: {} (probability {}). With {}{} χ² per point {}{}; {}.",
            missing(several, leader.converged),
            candidate.effects.in_words(),
            chance((findings.posterior.decision).probability_of(&candidate.effects)),
            if several { "them" } else { "it" },
            in_other_forms(candidate),
            change(before(findings), chi2(findings, leader)),
            of_less_scatter(findings.base.fitted.found.scatter, leader.found.scatter),
            values(leader)
        ),
        reasons: (candidate.added_forms().map(shows)).chain(weaker).collect(),
        next_step,
    }
}

/// How what is named begins; a fit that did not converge makes it likely and no more.
fn missing(several: bool, converged: bool) -> &'static str {
    match (several, converged) {
        (false, true) => "One effect is",
        (true, true) => "These effects are",
        (false, false) => "Most likely, by a fit that did not converge, one effect is",
        (true, false) => "Most likely, by a fit that did not converge, these effects are",
    }
}

/// That k scatters less between tests with an effect, where it does: of what acts on whole tests their rows say little.
fn of_less_scatter(without: f64, with: f64) -> String {
    if without < SOME_SCATTER || with > LESS * without {
        return String::new();
    }
    let [without, with] = [without, with].map(percent);
    format!(", the scatter of k between tests falls from {without} to {with}")
}

/// What may be missing beside the leader: an effect too weak beside it to be told from another form of the leader itself.
fn weaker_beside(findings: &Findings<'_>, leader: &FittedCandidate) -> Option<String> {
    let Findings {
        context,
        base,
        posterior,
        ..
    } = findings;
    if context.approximate {
        // what is left may be that model's own error
        return None;
    }
    let (effects, fall) = second_effects::next(context, base, &posterior.candidates, leader)?;
    let names: Vec<String> = effects.iter().map(EffectSet::in_words).collect();
    let name = leader.candidate.effects.in_words();
    Some(format!(
        "Something weaker may be missing beside it: {}, or another form of {name}, would take some {} more off χ².",
        names.join(" or "),
        significant(fall, 2)
    ))
}

pub(super) fn why_not_the_runner_up(findings: &Findings<'_>) -> Vec<String> {
    let posterior = findings.posterior;
    let runner_up = posterior.decision.effects.get(1);
    let runner_up = runner_up.and_then(|effects| posterior.best_form(effects));
    let (Some(leader), Some(other)) = (posterior.leader(), runner_up) else {
        return Vec::new();
    };
    let behind = leader.log_evidence - other.log_evidence;
    let [of_leader, of_other] = [leader, other].map(|fitted| {
        let alone = Hypothesis::Effects(fitted.candidate.effects.clone());
        posterior.decision.log_probabilities[&alone]
    });
    let fitted = match other.converged {
        true => "fitted as well as it can be",
        false => "as far as it was fitted",
    };
    let base = findings.base.fitted.square;
    let [scatter, of_other_k] = [leader, other].map(|fitted| fitted.found.scatter);
    let whole = if chi2(findings, other) > chi2(findings, leader) {
        String::new()
    } else if leader.square < other.square {
        // per point, rows do not count with what they have in common
        format!(
            " (of all rows together, with their covariance, it takes {} off χ², {} takes {})",
            significant(base - other.square, 4),
            leader.candidate.effects,
            significant(base - leader.square, 4)
        )
    } else if LESS * of_other_k > scatter {
        format!(
            " and a scatter of k between tests of {}, {} one of {}",
            percent(of_other_k),
            leader.candidate.effects,
            percent(scatter)
        )
    } else {
        String::new()
    };
    let mut reasons = vec![format!(
        "Why not {}: {fitted} it leaves χ² {:.2} per point{whole}, {}.",
        other.candidate.effects,
        chi2(findings, other),
        against(of_leader - of_other)
    )];
    if let Some(card) = (other.candidate.effects.cards().first()).filter(|_| behind < CLOSE) {
        reasons.push(format!(
            "What tells {} from its look-alikes: {}.",
            card.name, card.separated_by
        ));
    }
    reasons
}

fn against(log: f64) -> String {
    if log > 14.0 {
        "more than a million times less probable".to_owned()
    } else if log < CLEARLY.ln() {
        "about as probable".to_owned()
    } else {
        format!("about {:.0} times less probable", log.exp())
    }
}
