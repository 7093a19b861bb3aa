//! Which physical effect a model lacks: the stages of a diagnosis in their order.
//!
//! ```text
//! hypothesis    the base model, every effect in every accepted form, nothing, the unknown
//! fit           base model by finite elements; likelihood, evidence
//! discrepancy   what anything smooth could bring, a Gaussian process of unknown cause
//! data checks   is the stated noise right, is one curve at fault, is there enough
//! model search  all by the analytic model, leaders by coarse and by fine finite elements, pairs
//! beside        every effect fitted together with a smooth discrepancy, where something smooth is missed
//! decision      nothing | effect | effects | partial | ambiguous | unknown: one function of the evidence
//! experiment    the test that would separate what is left
//! explanation   the document and its sentences
//! ```
//! A candidate is compared fully refitted: k, k per test, datums and its own parameters are free in each. Evidence is the
//! marginal likelihood with the noise of [`NoiseModel`], a correlated model error among it, and for each effect a tolerance for
//! its own form (`OWN_FORM` in `likelihood`).

pub use crate::learn::decision::{
    CandidateEvidence, Decision, DecisionRule, Evidence, LawAloneEvidence, LawBesideEvidence,
    LawInsteadEvidence, RemainderEvidence, Verdict, decide,
};
pub use crate::learn::discrepancy::{
    BinMean, DRIVER_KINDS, DRIVERS, Driver, DriverBin, DriverKind, DriverRow, Explained, MapPoint,
    ResidualDriver, ResidualDrivers,
};
pub use crate::learn::experiment::{
    AloneTest, Campaign, ChosenTest, Decided, ENOUGH, EffectVisibility, Leader, NextExperiment,
    NextTest, NextTests, Plan, RankedTest, SETTLES, Separated, made_up_chi2, plan_after,
    plan_first,
};
pub(crate) use crate::learn::explanation::plain_in_words;
pub use crate::learn::explanation::{
    CHECK_FIRST, Diagnosis, Named, ParameterValue, Ranked, Remainder, Screened,
};
pub use crate::learn::hypothesis::candidate::NotJudged;
pub use crate::learn::hypothesis::{EffectSet, Hypothesis};
pub use crate::learn::model_search::context::DiagnoseError;
pub use crate::learn::model_search::learned_drivers::{LearnedAnswer, OtherDriver};
pub use crate::learn::model_search::plain_laws::{PlainLaw, PlainParameter};
pub use crate::learn::model_search::stages::Watch;
pub use crate::learn::prediction::fidelity::Fidelity;

use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::decision::judged_candidates::JudgedCandidates;
use crate::learn::discrepancy::gaussian_process;
use crate::learn::discrepancy::smooth::SmoothDiscrepancy;
use crate::learn::explanation::findings::Findings;
use crate::learn::fitting::measured::Measured;
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::model_search::beside_unknown::WithDiscrepancy;
use crate::learn::model_search::context::Context;
use crate::learn::model_search::high_fidelity::decide_leaders;
use crate::learn::model_search::stages::Stages;
use crate::learn::model_search::{
    laws_beside, learned_drivers, matching_pursuit, nested_forms, pair_laws, pairs, place_laws,
    time_laws,
};
use crate::learn::noise::{ModelError, NoiseModel};
use crate::learn::prediction::bench::Workshop;
use crate::simulate::forward::ContactKind;
use crate::study::{ContactKind as StudiedContact, Role};

/// Shares of a whole diagnosis at which its stages begin, by their times on data with much that is missed (pairs and effects beside something unknown
/// are most of it there) and on data that one effect explains.
const BASE: f64 = 0.04;
const SCREENING: f64 = 0.08;
const MEDIUM: f64 = 0.20;
const DECIDING: f64 = 0.40;
const PAIRS: f64 = 0.50;
const BESIDE: f64 = 0.72;
const EXPERIMENT: f64 = 0.87;
const LAWS: f64 = 0.90;
/// Steps of the screening for each effect: its starts, and a look at it.
const PER_SCREENED: usize = 2;
/// About how many fits by coarse elements the leaders take, and how many the pairs.
const COARSE_FITS: usize = 40;
const PAIR_FITS: usize = 20;

/// Diagnoses a study's measurements: screened by the analytic model, decided by `fidelity`.
///
/// # Errors
/// [`DiagnoseError`]
pub fn diagnose(
    measured: &Measured<'_>,
    fidelity: Fidelity,
    watch: Watch<'_>,
) -> Result<Diagnosis, DiagnoseError> {
    let stages = Stages::new(watch);
    stages.begin([0.0, BASE], "preparing the gears".to_owned(), 1);
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
    let likelihood = Likelihood::new(measured, noise, Role::Fit);
    if likelihood.tests.is_empty() {
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
            workshop(deciding, Fidelity::Full)?,
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
    let mut context = Context {
        likelihood,
        hertz: &hertz,
        middle,
        exact,
        stages: &stages,
        fidelity,
        approximate,
    };
    stages.begin([BASE, SCREENING], "fitting the base model".to_owned(), 4);
    let base = context.base_by_scatter()?;
    Ok(search(&context, &base, &analytic))
}

/// The diagnosis from the base model's fit on.
fn search(context: &Context<'_>, base: &BaseFit, workshop: &Workshop) -> Diagnosis {
    let (likelihood, stages) = (&context.likelihood, context.stages);
    let measured = likelihood.measured;
    let (singles, not_judged) = Candidate::singles_for(measured.study(), &measured.data);
    let screening = format!("screening {} effects", singles.len());
    let foreseen = PER_SCREENED * singles.len();
    stages.begin([SCREENING, MEDIUM], screening, foreseen);
    let mut fitted = context.screen(base, &singles);
    let unknown = gaussian_process::log_evidence(
        likelihood,
        &base.fitted.found,
        &base.fitted.candidate.parameters,
        None,
    );
    let smooth = SmoothDiscrepancy::of(likelihood, &base.fitted.found.model)
        .gaining(unknown - base.fitted.log_evidence);
    let sparse_regression = matching_pursuit::selection(context, base, &fitted);
    fitted.extend(nested_forms::of(context, base, &fitted, &smooth));
    if context.fidelity != Fidelity::Screening {
        let doing = "the leaders by coarse finite elements".to_owned();
        stages.begin([MEDIUM, DECIDING], doing, COARSE_FITS);
        fitted = context.refine(base, fitted, smooth.is_real(), smooth.drop);
        fitted = context.with_other_valleys(base, fitted);
        fitted = context.with_moved_centres(base, fitted, smooth.drop);
        fitted = context.with_unseen(base, fitted, &smooth);
        fitted = nested_forms::of_waves_by_elements(context, base, fitted, &smooth);
    }
    if context.fidelity != Fidelity::Middle {
        fitted = decide_leaders(context, base, fitted, smooth.drop, [DECIDING, PAIRS]);
    }
    let not_fitted = not_fitted(&singles, &fitted);
    if !context.approximate {
        // by the analytic model second effects would mend its own error
        stages.begin([PAIRS, BESIDE], "looking at pairs".to_owned(), PAIR_FITS);
        fitted.extend(pairs::pairs(context, base, &fitted));
    }
    let rule = if context.approximate {
        DecisionRule::of_analytic_model()
    } else {
        DecisionRule::default()
    };
    fitted.sort_by(|a, b| b.log_evidence.total_cmp(&a.log_evidence));
    // by the analytic model what remains would be its own error
    let discrepancy = if smooth.is_real() && !context.approximate {
        let doing = "effects beside something unknown".to_owned();
        let foreseen = PER_SCREENED * singles.len() + COARSE_FITS;
        stages.begin([BESIDE, EXPERIMENT], doing, foreseen);
        context.beside_unknown(base, unknown, &singles, &fitted)
    } else {
        WithDiscrepancy {
            alone: unknown,
            effects: Vec::new(),
        }
    };
    // a law that gains enough to be asked for may stand instead of a leader that does, though no smooth discrepancy is beyond doubt
    let leads =
        (fitted.first()).is_some_and(|first| learned_drivers::is_ahead_of(first, &base.fitted));
    let laws = if (smooth.is_real() || leads) && !context.approximate {
        let of_time = time_laws::instead_of_slow_change(context, base, &fitted, &discrepancy);
        let [mut of_places, mut of_times] = pair_laws::instead_of_one(context, &fitted);
        of_places.extend(place_laws::instead_of_leader(context, base, &fitted));
        of_times.extend(of_time);
        [of_places, of_times]
    } else {
        Default::default()
    };
    let posterior =
        JudgedCandidates::new(likelihood, base, fitted, discrepancy, laws, &smooth, rule);
    let mut laws = laws_beside::of(context, &posterior.undecided_beside_unknown());
    let hidden = posterior.hidden_by_unknown();
    let asked = posterior.is_beside_unknown() || !hidden.is_empty();
    let alone = asked.then(|| laws_beside::alone(context, base)).flatten();
    // what is ahead of an effect and a discrepancy may be behind the effect and a law
    if let Some(rival) = alone.as_ref().filter(|_| laws.is_empty()) {
        laws = laws_beside::of(context, &posterior.behind(rival));
    }
    if laws.is_empty() && alone.is_some() {
        laws = laws_beside::of(context, &hidden);
    }
    let posterior = posterior.with_laws_beside(laws, alone);
    let doing = "held-out tests and the next experiment".to_owned();
    stages.begin([EXPERIMENT, LAWS], doing, 1);
    let diagnosis = Diagnosis::new(Findings {
        context,
        workshop,
        base,
        smooth: &smooth,
        posterior: &posterior,
        sparse_regression,
        not_judged,
        not_fitted,
    });
    // beside an established effect that comes first: with it in, the next diagnosis learns what is left; and by the analytic model a law would
    // learn that one's own error
    let learned = if posterior.decision.verdict == Verdict::Unknown && !context.approximate {
        let doing = "laws of one driver for what the catalogue does not explain".to_owned();
        stages.begin([LAWS, 1.0], doing, 1);
        learned_drivers::learned_driver(context, &base.fitted, diagnosis.driver.as_ref())
    } else {
        None
    };
    stages.begin([1.0; 2], "done".to_owned(), 1);
    diagnosis.with_learned(learned)
}

/// The effects of which no form could be fitted.
fn not_fitted(candidates: &[Candidate], fitted: &[FittedCandidate]) -> Vec<Hypothesis> {
    let missing = |c: &&Candidate| fitted.iter().all(|j| j.candidate.effects != c.effects);
    let mut names: Vec<Hypothesis> = (candidates.iter().filter(missing))
        .map(Candidate::hypothesis)
        .collect();
    names.dedup();
    names
}
