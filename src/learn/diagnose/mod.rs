//! Which physical effect a model lacks: ranking by evidence, with doubt stated.
//!
//! ```text
//! base fit (fem) -> every effect and form screened: fem(base) + [hertz(effect) − hertz(base)], refitted
//!                -> leaders and laws sharp in pressure refitted by coarse fem anchored at fem(base)
//!                -> leaders refitted by fem -> pairs -> nothing | effect | effects | ambiguous | unknown -> next experiment
//! ```
//! A candidate is compared fully refitted: k, k per test, datums and its own parameters are free in each. Evidence is the
//! marginal likelihood with the noise of [`NoiseModel`], a correlated model error among it, and for each effect a tolerance for
//! its own form (`OWN_FORM` in `ground`). Priors: nothing missing 0.5, unknown 0.1, single effects share 0.35, pairs 0.05.

mod anchored;
mod basis;
mod binned;
mod campaign;
mod candidate;
mod deciding;
mod dependence;
mod drivers;
mod feasible;
mod fidelity;
mod flexible;
mod ground;
mod grown;
mod judge;
mod layout;
mod next;
mod noise_level;
mod pair_fit;
mod pairs;
mod partners;
mod plan;
mod rank;
mod ranked;
mod refining;
mod screening;
mod sparse;
mod strength;
mod suspects;
mod table;
mod telling;
mod unknown;
mod untold;
mod verdict;
mod warnings;
mod words;

use crate::learn::bench::Workshop;
use crate::learn::measured::Measured;
use crate::learn::noise::{ModelError, NoiseModel};
use crate::learn::predictor::PredictError;
use crate::simulate::forward::{ContactKind, ForwardError};
use crate::study::{ContactKind as StudiedContact, Role};

pub use binned::{BinMean, Explained};
pub use candidate::NotJudged;
pub use dependence::Driver;
pub use drivers::{
    DRIVER_KINDS, DRIVERS, DriverBin, DriverKind, DriverRow, ResidualDriver, ResidualDrivers,
};
pub use fidelity::Fidelity;
pub use flexible::MapPoint;
pub use plan::{
    AloneTest, Campaign, ChosenTest, Leader, NextTests, Plan, RankedTest, Separated, Shown,
    plan_after, plan_first,
};
pub use ranked::{ParameterValue, Ranked};
pub use verdict::{Diagnosis, Named, NextExperiment, NextTest, Screened, Verdict};

use candidate::Candidate;
use flexible::Flexible;
use ground::Ground;
use judge::{Base, Judge, Judged};
use rank::Ranking;

/// Name of the base model among the probabilities.
pub const NOTHING: &str = "nothing_missing";
/// Name of what the catalogue does not hold.
pub const UNKNOWN: &str = "unknown";

/// Why there is no diagnosis.
#[derive(Debug, thiserror::Error)]
pub enum DiagnoseError {
    /// No test with role fit has a measurement.
    #[error("no test with role \"fit\" has a measurement")]
    NoObservations,
    /// The gears cannot run.
    #[error(transparent)]
    Forward(#[from] ForwardError),
    /// The base model has no answer.
    #[error("the base model cannot be fitted: {0}")]
    Base(#[from] PredictError),
}

/// What is told while a diagnosis runs: the share done, 0 to 1, and what is going on.
pub type Watch<'w> = &'w (dyn Fn(f64, String) + Sync);

/// Log evidence behind the leader within which candidates are decided by finite elements.
const WITHIN: f64 = 10.0;
/// The same as a share of the leader's gain, for the middle fidelity's own error.
const WITHIN_SHARE: f64 = 0.02;
/// Least and most single candidates decided by finite elements.
const DECIDED: [usize; 2] = [3, 7];
/// Gain of log evidence without which only the first of them is: the prior odds of one effect against nothing missing ask for 3.7.
const GAIN: f64 = 0.0;

/// Diagnoses a study's measurements: screened by the analytic model, decided by `fidelity`.
///
/// # Errors
/// [`DiagnoseError`]
pub fn diagnose(
    measured: &Measured<'_>,
    fidelity: Fidelity,
    watch: Watch<'_>,
) -> Result<Diagnosis, DiagnoseError> {
    watch(0.0, "preparing the gears".to_owned());
    // a study whose own model is the analytic one is decided by it at the study's own resolution
    let own = fidelity == Fidelity::Screening && measured.study().contact == StudiedContact::Hertz;
    let approximate = fidelity == Fidelity::Screening && !own;
    let error = if own {
        ModelError::default()
    } else {
        fidelity.model_error()
    };
    let noise = NoiseModel {
        model_error: Some(error),
        ..NoiseModel::of(&measured.study().noise)
    };
    let ground = Ground::new(measured, noise, Role::Fit);
    if ground.tests.is_empty() {
        return Err(DiagnoseError::NoObservations);
    }
    let fine = measured.study().resolution();
    let workshop = |kind, fidelity: Fidelity| {
        let set = measured.study().gear_set().clone();
        Workshop::new(set, fidelity.resolution(fine), kind, measured.tests())
    };
    let analytic = workshop(ContactKind::Hertz, Fidelity::Screening)?;
    let hertz = measured.bench(&analytic)?;
    let deciding = if own {
        ContactKind::Hertz
    } else {
        ContactKind::Fem
    };
    let finer = if approximate {
        None
    } else {
        Some((
            workshop(deciding, Fidelity::Middle)?,
            measured.workshop(deciding)?,
        ))
    };
    let benches = match &finer {
        Some((middle, fine)) => Some((measured.bench(middle)?, measured.bench(fine)?)),
        None => None,
    };
    let (middle, exact) = match &benches {
        Some((middle, fine)) => (middle, fine),
        None => (&hertz, &hertz),
    };
    let mut judge = Judge {
        ground,
        hertz: &hertz,
        middle,
        exact,
        fidelity,
        approximate,
    };
    watch(0.08, "fitting the base model".to_owned());
    let mut base = judge.base(Candidate::base(measured.study()))?;
    let sigma_factor = noise_level::sigma_factor(&judge.ground, &base.judged.found.model);
    if sigma_factor > 1.0 {
        let noise = NoiseModel {
            sigma_factor,
            ..noise
        };
        judge.ground = Ground::new(measured, noise, Role::Fit);
        base = judge.base(Candidate::base(measured.study()))?;
    }
    with(&judge, base, &analytic, watch)
}

/// The diagnosis from the base model's fit on.
fn with(
    judge: &Judge<'_>,
    base: Base,
    shop: &Workshop,
    watch: Watch<'_>,
) -> Result<Diagnosis, DiagnoseError> {
    let study = judge.ground.measured.study();
    let (singles, not_judged) = Candidate::singles(study);
    watch(0.2, format!("screening {} effects", singles.len()));
    let screened = judge.screen(&base, &singles);
    let unknown = unknown::log_evidence(judge, &base);
    let flexible = Flexible::of(&judge.ground, &base.judged.found.model)
        .gaining(unknown - base.judged.log_evidence);
    let sparse = sparse::selection(judge, &base, &screened);
    let grown = grown::of(judge, &base, &screened, &flexible);
    let screened: Vec<Judged> = screened.into_iter().chain(grown).collect();
    let screened = match judge.fidelity {
        Fidelity::Screening => screened,
        Fidelity::Middle | Fidelity::Full => {
            watch(0.35, "the leaders by coarse finite elements".to_owned());
            let refined = judge.refine(&base, screened, flexible.is_real());
            judge.with_unseen(&base, refined, &flexible)
        }
    };
    let judged = match judge.fidelity {
        Fidelity::Middle => screened,
        Fidelity::Screening | Fidelity::Full => {
            decide_leaders(judge, &base, screened, &|done, what| {
                watch(0.5 + 0.3 * done, what);
            })
        }
    };
    let pairs = if judge.approximate {
        // second effects would mend the analytic model's own error
        Vec::new()
    } else {
        watch(0.8, "looking at pairs".to_owned());
        pairs::pairs(judge, &base, &judged)
    };
    let failed = not_fitted(&singles, &judged);
    watch(0.93, "weighing".to_owned());
    let ranking = Ranking::new(judge, &base, judged, pairs, &flexible, unknown);
    watch(0.95, "held-out tests and the next experiment".to_owned());
    let mut diagnosis =
        verdict::diagnosis(judge, shop, &base, ranking, &flexible, not_judged, failed);
    diagnosis.sparse_regression = sparse;
    watch(1.0, "done".to_owned());
    Ok(diagnosis)
}

/// Finite elements for the leaders of the screening; the others stay as screened.
fn decide_leaders(
    judge: &Judge<'_>,
    base: &Base,
    mut screened: Vec<Judged>,
    watch: &dyn Fn(f64, String),
) -> Vec<Judged> {
    screened.sort_by(|a, b| b.log_evidence.total_cmp(&a.log_evidence));
    let before = base.judged.log_evidence;
    let leader = screened
        .first()
        .map_or(before, |j| j.log_evidence.max(before));
    let within = WITHIN + WITHIN_SHARE * (leader - before).max(0.0);
    let chosen = screened
        .iter()
        .enumerate()
        .take_while(|(i, j)| {
            let near = *i < DECIDED[0] || j.log_evidence > leader - within;
            *i == 0 || *i < DECIDED[1] && near && j.log_evidence > before + GAIN
        })
        .count();
    let rest = screened.split_off(chosen);
    let mut judged: Vec<Judged> = Vec::with_capacity(screened.len() + rest.len());
    let mut least = base.judged.found.objective;
    for (i, candidate) in screened.into_iter().enumerate() {
        watch(
            i as f64 / chosen as f64,
            format!("deciding: {}", candidate.candidate.name()),
        );
        let start = candidate.found.state.clone();
        let decided = judge.decide(&candidate.candidate, start, Some(base), least);
        let decided = decided.unwrap_or(candidate);
        least = least.min(decided.found.objective);
        judged.push(decided);
    }
    judged.sort_by(|a, b| b.log_evidence.total_cmp(&a.log_evidence));
    if let Some(leader) = judged.first_mut().filter(|j| !j.converged) {
        watch(1.0, format!("polishing: {}", leader.candidate.name()));
        if let Some(better) = judge.polish(base, leader) {
            *leader = better;
        }
    }
    judged.extend(rest);
    judged
}

/// Names of the effects of which no form could be fitted.
fn not_fitted(candidates: &[Candidate], judged: &[Judged]) -> Vec<String> {
    let mut names: Vec<String> = candidates
        .iter()
        .filter(|c| judged.iter().all(|j| j.candidate.names != c.names))
        .map(Candidate::name)
        .collect();
    names.dedup();
    names
}
