//! The sentences of a verdict, that a gear engineer can check.

use super::findings::Findings;
use super::laws_instead;
use super::named::{named, why_not_the_runner_up};
use super::nothing_missing::nothing_missing;
use super::remainder::partial;
use super::rivals::ambiguous;
use super::undecided::{not_decided, undecided};
use super::unknown::unknown;
use super::warnings::odd_part;
use super::wording::{Explanation, percent};
use crate::learn::checks::scatter_trend::trend_of_scatter;
use crate::learn::decision::Verdict;
use crate::learn::discrepancy::dependence::Driver;
use crate::learn::experiment::next::NextExperiment;

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
            (Verdict::Partial, _) => partial(findings, next),
            (Verdict::Unknown, _) => unknown(findings),
            _ => nothing_missing(findings, next),
        };
        let likelihood = &findings.context.likelihood;
        if decision.verdict != Verdict::NothingMissing
            && let Some(odd) = odd_part(likelihood, findings.base, findings.posterior)
        {
            all.next_step = format!(
                "{}; if nothing is wrong there, {}",
                odd.first, all.next_step
            );
        }
        all.reasons.extend(laws_instead::instead(findings));
        all.reasons.extend(laws_instead::beside(findings));
        if let Some(driver) = driver {
            let is_explained = matches!(decision.verdict, Verdict::Effect | Verdict::Effects);
            let each = likelihood.tests.len() > 1;
            all.reasons.extend(depends_on(driver, each, is_explained));
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

/// What the discrepancy depends on; `each`: each of several tests has a k of its own, which takes up what differs between them alone;
/// `is_explained`: by effects that are named, which then are the cause and not the traces.
fn depends_on(driver: &Driver, each: bool, is_explained: bool) -> Vec<String> {
    let discrepancy = match each {
        true => "With a k of its own for each test the discrepancy",
        false => "The discrepancy",
    };
    let mut reasons = vec![format!(
        "{discrepancy} depends most on {}: {} of its variance.",
        driver.in_words(),
        percent(driver.variance_share)
    )];
    if driver.name == "trace" && !is_explained {
        reasons.push("Each trace is shifted or tilted on its own, which wear of the same teeth would not do: look at centring, base radius, datum and temperature of the measuring machine, and whether they are of the same tooth. [noise] trace_tilt and trace_shift allow for it.".to_owned());
    }
    reasons
}
