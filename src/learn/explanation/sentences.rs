//! Sentences that a gear engineer can check.

use super::findings::Findings;
use super::laws_instead;
use super::outlook::Outlook;
use super::remainder::partial;
use super::rivals::ambiguous;
use super::scatter::{made_twice, of_scatter};
use super::warnings::other_forms;
use super::wording::{
    Explanation, added, before, chance, change, chi2, in_other_forms, of_attainable, percent,
    values,
};
use crate::effects::{Card, Form};
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::checks::scatter_trend::trend_of_scatter;
use crate::learn::checks::sufficiency::{few, measured_once};
use crate::learn::decision::judged_candidates::JudgedCandidates;
use crate::learn::decision::{Decision, SURE, Verdict};
use crate::learn::discrepancy::dependence::Driver;
use crate::learn::experiment::next::NextExperiment;
use crate::learn::hypothesis::{EffectSet, Hypothesis};
use crate::learn::model_search::context::Context;
use crate::learn::model_search::second_effects;
use crate::numeric::written::significant;

/// Scatter of k between tests from which it is worth a sentence.
const LARGE_SCATTER: f64 = 0.2;
/// Scatter that is worth a word where an effect takes it away, and what is then left of it at most.
const SOME_SCATTER: f64 = 0.01;
const LESS: f64 = 0.7;
/// Probability of nothing missing from which the next effect is not worth a sentence.
const CERTAIN: f64 = 0.95;
/// Share of the attainable fall of χ² below which no effect is worth naming.
const NEGLIGIBLE: f64 = 0.01;
/// Gain of ln evidence from which an effect comes nearer than one that does nothing.
const SOME_GAIN: f64 = 0.1;
/// Share of the attainable fall of χ² from which it has to be said why an effect is not named.
const NEARLY_ALL: f64 = 0.9;
/// Least fall of χ², over the leader's, of the effects that are told beside it as leaders.
const BESIDE_LEADER: f64 = 0.9;
/// Most leaders of an undecided diagnosis.
const TOLD: usize = 3;
/// Relative error that the analytic model may have against finite elements: `gearwear models` finds 1 to 2 % on the reference pair and 3 to 5 % by zone on
/// another one with shifted profiles.
const ANALYTIC_ERROR: f64 = 0.05;
/// χ² per point of wear with that error allowed for, below which nothing more than it is missed.
const WITHIN_ERROR: f64 = 1.5;
/// Ratio of probabilities below which they are about the same.
const CLEARLY: f64 = 1.5;
/// Log evidence to the runner-up below which what separates the two is told.
const CLOSE: f64 = 5.0;
/// Probability from which effects are worth a sentence where an unknown cause leads.
const POSSIBLE: f64 = 0.05;
/// Pairs of effects that are looked at for one that they have in common.
const BEST_PAIRS: usize = 3;

impl Explanation {
    /// Of what was found, the driver of the discrepancy and the proposed test among it.
    pub(super) fn new(
        findings: &Findings<'_>,
        driver: Option<&Driver>,
        next: Option<&NextExperiment>,
    ) -> Self {
        let decision = &findings.posterior.decision;
        let leader = findings.posterior.leader();
        let undecided = undecided(findings.context, findings.base, findings.posterior);
        let mut all = match (decision.verdict, leader) {
            _ if undecided => not_decided(findings),
            (Verdict::Effect | Verdict::Effects, Some(leader)) => named(findings, leader),
            (Verdict::Ambiguous, _) => ambiguous(findings, next),
            (Verdict::Partial, _) => partial(findings),
            (Verdict::Unknown, _) => unknown(findings),
            _ => nothing_missing(findings, next),
        };
        all.reasons.extend(laws_instead::instead(findings));
        if let Some(driver) = driver {
            let is_explained = matches!(decision.verdict, Verdict::Effect | Verdict::Effects);
            all.reasons.extend(depends_on(driver, is_explained));
        }
        if matches!(decision.verdict, Verdict::Effect | Verdict::Effects) {
            all.reasons.extend(why_not_the_runner_up(findings));
        }
        // what the tests' own k follow is a law of some cause, which no name explains yet; where nothing is missing it is said in place of their scatter
        let named = match decision.verdict {
            Verdict::NothingMissing => None,
            Verdict::Ambiguous | Verdict::Unknown => Some(&findings.base.fitted),
            Verdict::Effect | Verdict::Effects | Verdict::Partial => {
                findings.posterior.leading_fit(findings.base)
            }
        };
        if let Some(spoken_of) = named {
            let state = &spoken_of.found.state;
            let trend = trend_of_scatter(&findings.context.likelihood, state);
            let with = match &spoken_of.candidate.effects {
                none if none.is_empty() => String::new(),
                effects => format!("With {} in, ", effects.in_words()),
            };
            all.reasons
                .extend(trend.map(|trend| format!("{with}{trend}.")));
        }
        for missing in &findings.not_judged {
            all.reasons.push(format!(
                "Not judged: {}, which needs {} in the study.",
                missing.effect,
                missing.needs.join(", ")
            ));
        }
        all
    }
}

fn nothing_missing(findings: &Findings<'_>, next: Option<&NextExperiment>) -> Explanation {
    let likelihood = &findings.context.likelihood;
    let decision = &findings.posterior.decision;
    let chi2_before = before(findings);
    let nothing = decision.probability(&Hypothesis::NothingMissing);
    let shown = if nothing < SURE {
        "Undecided: most likely nothing is missing, but a weak effect may be"
    } else {
        "Nothing is missing that these data show"
    };
    let too_few = few(likelihood, findings.base);
    let sentence = if too_few {
        format!(
            "Too few measured values ({}) to tell whether anything is missing: the base model stands at χ² {chi2_before:.2} per point (1 is the noise).",
            likelihood.len()
        )
    } else {
        format!(
            "{shown}: the base model stands at χ² {chi2_before:.2} per point (1 is the noise), probability of nothing missing {}.",
            chance(nothing)
        )
    };
    let base = findings.base.fitted.log_evidence;
    let leader = findings.posterior.leader();
    // what gains nothing comes no nearer than any other
    let leader = leader.filter(|l| nothing < CERTAIN && l.log_evidence > base + SOME_GAIN);
    let nearest = leader.map(|leader| {
        format!(
            "Of single effects {} comes nearest ({}): it lowers χ² per point to {:.3}, too little, given how many candidates were tried.",
            leader.candidate.effects,
            chance(decision.probability_of(&leader.candidate.effects)),
            chi2(findings, leader)
        )
    });
    let scatter = findings.base.fitted.found.scatter;
    let scatters = (scatter > LARGE_SCATTER && likelihood.tests.len() > 1).then(|| {
        let twice = made_twice(likelihood, &findings.base.fitted.found.state.epsilon);
        let other_question = next.is_some_and(|next| next.repeats.is_none());
        of_scatter(scatter, twice.as_ref(), other_question)
    });
    // where they follow a condition it is hardly chance
    let trend = trend_of_scatter(likelihood, &findings.base.fitted.found.state);
    let followed = trend.is_some();
    let scatters = trend.or(scatters);
    let next_step = if followed {
        "look at what the tests' k follow before adding an effect: a law of it is an [[effect]] with kind = \"formula\" (guide/own-effect.md; of the temperature guide/plastics.md), fitted by \
         gearwear compare and held against this study by gearwear ladder"
    } else if too_few {
        "measure more before concluding anything: gearwear plan STUDY proposes tests"
    } else if measured_once(likelihood).len() == likelihood.tests.len() {
        "no effect need be added for what these data show; what changes over life they cannot show: measure at several numbers of cycles"
    } else if nothing < SURE {
        Outlook::of(next).of_a_weak_effect()
    } else {
        "no effect need be added; a weak effect could still hide below the noise"
    };
    Explanation {
        sentence,
        reasons: nearest.into_iter().chain(scatters).collect(),
        next_step: next_step.to_owned(),
    }
}

/// Whether the analytic model stands in for finite elements and cannot decide: it finds an outer cause, and its own error looks like one (the hidden
/// running-in of the example accounts for 87 % of the attainable by that model, and for all of it by finite elements), or all that is missed is within its error.
pub(super) fn undecided(
    context: &Context<'_>,
    base: &BaseFit,
    posterior: &JudgedCandidates,
) -> bool {
    context.approximate
        && match posterior.decision.verdict {
            Verdict::Unknown => true,
            Verdict::NothingMissing => false,
            _ => is_within_analytic_error(&context.likelihood, &base.fitted),
        }
}

/// Whether a fit by the analytic model misses no more than that model's own error.
pub(super) fn is_within_analytic_error(
    likelihood: &Likelihood<'_>,
    fitted: &FittedCandidate,
) -> bool {
    let model = &fitted.found.model;
    // of the stiffness of teeth, and so of their transmission error, it knows less than of wear
    let off: Vec<f64> = (likelihood.standardised(model).iter().zip(model).enumerate())
        .filter(|(row, _)| likelihood.observation(*row).quantity.is_wear())
        .map(|(row, (z, value))| {
            let own = ANALYTIC_ERROR * value / likelihood.observation(row).sigma;
            z * z / (1.0 + own * own)
        })
        .collect();
    off.iter().sum::<f64>() < WITHIN_ERROR * off.len() as f64
}

/// The answer where the analytic model cannot decide: its leaders, and what would.
fn not_decided(findings: &Findings<'_>) -> Explanation {
    let posterior = findings.posterior;
    let effects = posterior.decision.effects.iter();
    let fitted: Vec<&FittedCandidate> = effects.filter_map(|e| posterior.best_form(e)).collect();
    let square = findings.base.fitted.square;
    let leading = fitted.first().map_or(0.0, |leader| square - leader.square);
    let leaders = fitted.iter().enumerate();
    let leaders =
        leaders.filter(|(i, other)| *i == 0 || square - other.square > BESIDE_LEADER * leading);
    let told = |j: &FittedCandidate| format!("{} ({:.2})", j.candidate.effects, chi2(findings, j));
    let leaders: Vec<String> = leaders.take(TOLD).map(|(_, j)| told(j)).collect();
    Explanation {
        sentence: format!(
            "Undecided by the analytic model: it leaves χ² {:.2} per point, part or all of which may be its own error{}.",
            before(findings),
            match leaders.join(", ") {
                leaders if leaders.is_empty() => String::new(),
                leaders => format!(". Leaders, with χ² per point: {leaders}"),
            }
        ),
        reasons: best_of_catalogue(findings).into_iter().collect(),
        next_step: "repeat without --fast (or with --fidelity middle): finite elements decide between the leaders, a cause outside the catalogue and nothing at all".to_owned(),
    }
}

fn unknown(findings: &Findings<'_>) -> Explanation {
    let decision = &findings.posterior.decision;
    let possible = not_ruled_out(decision);
    let next_step = if findings.context.approximate {
        "repeat with --fidelity middle: what is left may be the analytic model's own error"
            .to_owned()
    } else {
        let by_hand =
            "write the suspected law as an [[effect]] with kind = \"formula\" and diagnose again";
        let or = (possible.as_ref()).map_or(String::new(), |(_, effects, _)| {
            let [first, ..] = effects.cards() else {
                return String::new();
            };
            format!("see what gearwear add STUDY {} leaves, or ", first.name)
        });
        format!("look at the measurements named in the warnings, if any; else {or}{by_hand}")
    };
    let possible = possible.map(|(hypothesis, _, probability)| {
        format!(
            "{} is not ruled out ({}).",
            hypothesis.in_words(),
            chance(probability)
        )
    });
    Explanation {
        sentence: format!(
            "Something is missing that the catalogue does not hold (probability {}): the base model stands at χ² {:.2} per point.",
            chance(decision.probability(&Hypothesis::Unknown)),
            before(findings)
        ),
        reasons: best_of_catalogue(findings)
            // what a free law replaces is told with that law, and would be the best
            .filter(|_| laws_instead::instead(findings).is_empty())
            .into_iter()
            .chain(possible)
            .collect(),
        next_step,
    }
}

/// The most probable effects beside an unknown cause, with or without something unknown beside them, if they are worth a sentence.
fn not_ruled_out(decision: &Decision) -> Option<(&Hypothesis, &EffectSet, f64)> {
    let all = decision.log_probabilities.iter();
    let of_effects = all.filter_map(|(hypothesis, log)| match hypothesis {
        Hypothesis::Effects(effects) | Hypothesis::EffectsAndUnknown(effects) => {
            Some((hypothesis, effects, log.exp()))
        }
        _ => None,
    });
    of_effects
        .max_by(|a, b| a.2.total_cmp(&b.2))
        .filter(|(_, _, probability)| *probability >= POSSIBLE)
}

/// How much of the discrepancy the best of the catalogue accounts for.
fn best_of_catalogue(findings: &Findings<'_>) -> Option<String> {
    let posterior = findings.posterior;
    let (leader, falls) = (posterior.decision.leader()?, posterior.falls_of_leader()?);
    let share = falls[0] / falls[1];
    if share < NEGLIGIBLE {
        return Some(format!(
            "No effect of the catalogue accounts for even {} of the attainable reduction of χ².",
            percent(NEGLIGIBLE)
        ));
    }
    let common = common_to_pairs(&posterior.decision.effects).map_or(String::new(), |card| {
        format!(" {} stands in all of the best pairs.", card.name)
    });
    let why_not = if share < NEARLY_ALL {
        String::new()
    } else {
        " It needs values, or leaves a pattern, for which something unknown is more probable."
            .to_owned()
    };
    Some(format!(
        "The best of the catalogue, {}, accounts for {}.{why_not}{common}",
        leader.in_words(),
        of_attainable(falls)
    ))
}

/// The effect that the most probable pairs have in common.
fn common_to_pairs(by_probability: &[EffectSet]) -> Option<&'static Card> {
    let pairs = by_probability.iter().filter(|effects| effects.len() > 1);
    let best: Vec<&EffectSet> = pairs.take(BEST_PAIRS).collect();
    let [first, others @ ..] = &best[..] else {
        return None;
    };
    let everywhere = |card: &&&'static Card| {
        let alone = EffectSet::new([**card]);
        others.iter().all(|pair| pair.contains(&alone))
    };
    let mut common = first.cards().iter().filter(everywhere);
    common.next().filter(|_| !others.is_empty()).copied()
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

fn named(findings: &Findings<'_>, leader: &FittedCandidate) -> Explanation {
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
    let name = leader.candidate.effects.in_words();
    Some(format!(
        "Something weaker may be missing beside it: {}, or another form of {name}, would take some {} more off χ².",
        effects.in_words(),
        significant(fall, 2)
    ))
}

/// What the discrepancy depends on; `is_explained`: by effects that are named, which then are the cause and not the traces.
fn depends_on(driver: &Driver, is_explained: bool) -> Vec<String> {
    let mut reasons = vec![format!(
        "The discrepancy depends most on {}: {} of its variance.",
        driver.in_words(),
        percent(driver.variance_share)
    )];
    if driver.name == "trace" && !is_explained {
        reasons.push("Each trace is shifted or tilted on its own, which wear of the same teeth would not do: look at centring, base radius, datum and temperature of the measuring machine, and whether they are of the same tooth. [noise] trace_tilt and trace_shift allow for it.".to_owned());
    }
    reasons
}

fn why_not_the_runner_up(findings: &Findings<'_>) -> Vec<String> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::find;

    #[test]
    fn what_the_best_pairs_have_in_common_is_said() {
        let set = |names: &[&str]| EffectSet::new(names.iter().map(|name| find(name).unwrap()));
        let pairs = [
            set(&["approach_recess"]),
            set(&["micropitting", "running_in"]),
            set(&["coating", "micropitting"]),
            set(&["micropitting", "tip_relief"]),
            set(&["coating", "tip_relief"]),
        ];
        assert_eq!(common_to_pairs(&pairs).unwrap().name, "micropitting");
        assert!(common_to_pairs(&pairs[..2]).is_none());
        assert!(common_to_pairs(&pairs[2..]).is_none());
    }

    #[test]
    fn beside_an_unknown_cause_the_most_probable_effect_is_said_unless_it_is_ruled_out() {
        let set = |name| EffectSet::new([find(name).unwrap()]);
        let of = |beside: f64| Decision {
            verdict: Verdict::Unknown,
            log_probabilities: [
                (Hypothesis::Unknown, 0.8_f64),
                (Hypothesis::Effects(set("coating")), 0.02),
                (Hypothesis::EffectsAndUnknown(set("oxidative")), beside),
            ]
            .map(|(hypothesis, p)| (hypothesis, p.ln()))
            .into(),
            effects: Vec::new(),
            group: Vec::new(),
        };
        let decision = of(0.18);
        let (hypothesis, effects, probability) = not_ruled_out(&decision).unwrap();
        assert_eq!(hypothesis.in_words(), "oxidative beside something unknown");
        assert_eq!(effects.cards()[0].name, "oxidative");
        assert!((probability - 0.18).abs() < 1e-12);
        assert!(not_ruled_out(&of(0.03)).is_none());
    }
}
