//! What is said where the analytic model cannot decide.

use super::findings::Findings;
use super::unknown::best_of_catalogue;
use super::wording::{Explanation, before, chi2};
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::decision::Verdict;
use crate::learn::decision::judged_candidates::JudgedCandidates;
use crate::learn::model_search::context::Context;

/// Least fall of χ², over the leader's, of the effects that are told beside it as leaders.
const BESIDE_LEADER: f64 = 0.9;
/// Most leaders of an undecided diagnosis.
const TOLD: usize = 3;
/// Relative error that the analytic model may have against finite elements: `gearwear models` finds 1 to 2 % on the reference pair and 3 to 5 % by zone on
/// another one with shifted profiles.
const ANALYTIC_ERROR: f64 = 0.05;
/// χ² per point of wear with that error allowed for, below which nothing more than it is missed.
const WITHIN_ERROR: f64 = 1.5;

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
pub(super) fn not_decided(findings: &Findings<'_>) -> Explanation {
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
