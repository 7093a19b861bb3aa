//! The answer: what `diagnosis.json` is written from.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::candidate::NotJudged;
use super::dependence::{self, Driver};
use super::drivers::{self, ResidualDrivers};
use super::flexible::{Flexible, MapPoint};
use super::judge::{Base, Judge};
use super::rank::Ranking;
use super::ranked::{Ranked, form, parameters, ranked};
use super::warnings::{few, warnings};
use super::{NOTHING, UNKNOWN};
use super::{next, words};
use crate::learn::bench::Workshop;

/// Probability from which a single effect or set is named.
const CLAIM: f64 = 0.85;
/// Probability of nothing missing from which an effect is not claimed; of that or of the unknown, from which a group holds it.
const DOUBT: f64 = 0.2;
/// Candidates this much less probable than the leader are no look-alikes.
const ALIKE: f64 = 0.03;
/// Log evidence between two candidates from which no experiment is needed to separate them.
const SETTLED: f64 = 10.0;

/// χ² between two candidates below which a test is not worth proposing.
const WORTH_MAKING: f64 = 1.0;

/// What is missing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Nothing that these data show.
    NothingMissing,
    /// One effect.
    Effect,
    /// Several at once.
    Effects,
    /// Two or more that the data cannot tell apart.
    Ambiguous,
    /// Something that the catalogue does not hold.
    Unknown,
}

/// One effect, or several.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Named {
    /// One.
    One(String),
    /// Several.
    Several(Vec<String>),
}

/// A diagnosis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Diagnosis {
    /// What is missing.
    pub verdict: Verdict,
    /// The named effect or effects; None unless the verdict names some.
    pub effect: Option<Named>,
    /// The verdict in a sentence, and why.
    pub sentence: String,
    /// Further sentences: why not the runner-up, what cannot be concluded.
    pub reasons: Vec<String>,
    /// What to do next.
    pub next_step: String,
    /// Sum to 1 over effects, sets, `nothing_missing` and `unknown`.
    pub probabilities: BTreeMap<String, f64>,
    /// The most probable first.
    pub ranking: Vec<Ranked>,
    /// Groups that the data cannot tell apart.
    pub indistinguishable: Vec<Vec<String>>,
    /// What the discrepancy depends on most; None without a discrepancy.
    pub driver: Option<Driver>,
    /// All drivers.
    pub drivers: Vec<Driver>,
    /// The smooth discrepancy at every fitted row; not part of the document, but a table of its own.
    #[serde(skip)]
    pub discrepancy: Vec<MapPoint>,
    /// What the base model and the leading one leave, against each physical driver.
    pub residual_drivers: ResidualDrivers,
    /// Share of what anything smooth could explain that the leading effect explains; None without a discrepancy.
    pub explained_share: Option<f64>,
    /// Fall of χ² that anything smooth could bring.
    pub attainable_drop: f64,
    /// Standard deviation of that on noise alone.
    pub attainable_spread: f64,
    /// Log evidence of a smooth discrepancy of unknown cause over the base model.
    pub unknown_evidence_gain: f64,
    /// What a sparse regression on the effects' linear signatures picks, the strongest first: a second opinion that refits nothing.
    pub sparse_regression: Vec<String>,
    /// The test that would best separate what is left.
    pub next_experiment: Option<NextExperiment>,
    /// Everything fitted, by falling evidence.
    pub screened: Vec<Screened>,
    /// Effects that could not be judged.
    pub not_judged: Vec<NotJudged>,
    /// What is doubtful.
    pub warnings: Vec<String>,
}

/// One form of one effect or set as fitted.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Screened {
    /// Effect or set.
    pub effect: String,
    /// Forms.
    pub form: String,
    /// Log evidence over the base model's.
    pub evidence_gain: f64,
    /// Fall of the whole χ² against the base model.
    pub chi2_drop: f64,
    /// Whether the deciding model was used.
    pub decided: bool,
    /// Fitted values in the order of its parameters.
    pub values: Vec<f64>,
}

/// A test that would separate what is left.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NextExperiment {
    /// What it separates.
    pub separates: Vec<String>,
    /// Its conditions.
    pub test: NextTest,
    /// Why it does.
    pub why: String,
    /// Expected difference of the two in χ² after refitting.
    pub expected_chi2: f64,
    /// The same for a repetition of the most telling test that is there already.
    pub repetition_chi2: f64,
    /// Tests to be made as well where that one is not enough.
    pub further: Vec<NextTest>,
    /// Expected difference of the two in χ² after all of them.
    pub together_chi2: f64,
}

/// Conditions of a test, in the study's units.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NextTest {
    /// N·m.
    pub torque: f64,
    /// rpm.
    pub speed: f64,
    /// mm.
    pub misalignment: f64,
    /// Pinion revolutions.
    pub cycles: f64,
    /// Whether the drive direction is the other one.
    pub reversed: bool,
}

/// Puts the answer together.
pub(super) fn diagnosis(
    judge: &Judge<'_>,
    shop: &Workshop,
    base: &Base,
    ranking: Ranking,
    flexible: &Flexible,
    not_judged: Vec<NotJudged>,
    failed: Vec<String>,
) -> Diagnosis {
    let ground = &judge.ground;
    let mut warnings = warnings(judge, base, &ranking);
    if !failed.is_empty() {
        warnings.push(format!(
            "could not be fitted and are not judged: {}",
            failed.join(", ")
        ));
    }
    let probability = |name: &str| ranking.probabilities.get(name).copied().unwrap_or(0.0);
    let effects = ranking.effects();
    let (nothing, unknown) = (probability(NOTHING), probability(UNKNOWN));
    let all: f64 = effects.iter().map(|e| e.1).sum();
    let leader = effects.first().copied().unwrap_or((UNKNOWN, 0.0));
    let mut group: Vec<String> = effects
        .iter()
        .filter(|e| e.1 > ALIKE * leader.1)
        .map(|e| e.0.to_owned())
        .collect();
    let verdict = if nothing >= unknown && nothing >= all
        || nothing >= DOUBT && unknown < all && nothing > leader.1
    {
        Verdict::NothingMissing
    } else if unknown >= all && unknown >= nothing {
        Verdict::Unknown
    } else if nothing < DOUBT && leader.1 >= CLAIM * (all + nothing + unknown) {
        if leader.0.contains('+') {
            Verdict::Effects
        } else {
            Verdict::Effect
        }
    } else {
        let others = [(NOTHING, nothing), (UNKNOWN, unknown)];
        let doubted = others.iter().filter(|other| other.1 >= DOUBT);
        group.extend(doubted.map(|other| other.0.to_owned()));
        if group.len() < 2 {
            // What keeps the leader from being named is then the more probable of these.
            let most = if nothing > unknown { NOTHING } else { UNKNOWN };
            group.push(most.to_owned());
        }
        Verdict::Ambiguous
    };
    let effect = match verdict {
        Verdict::Effect => Some(Named::One(leader.0.to_owned())),
        Verdict::Effects => Some(Named::Several(
            leader.0.split('+').map(str::to_owned).collect(),
        )),
        _ => None,
    };
    let indistinguishable = match verdict {
        Verdict::Ambiguous => vec![group],
        Verdict::Effect | Verdict::Effects if group.len() > 1 => vec![group],
        _ => Vec::new(),
    };
    let discrepant = flexible.is_real() || verdict != Verdict::NothingMissing;
    let follows = discrepant && !few(ground, base);
    let smooth = if follows {
        dependence::drivers(ground, &base.judged.found.model, flexible.drop)
    } else {
        Vec::new()
    };
    let best = ranking.best_of(leader.0);
    let mut diagnosis = Diagnosis {
        verdict,
        effect,
        sentence: String::new(),
        reasons: Vec::new(),
        next_step: String::new(),
        ranking: ranked(judge, base, &ranking),
        indistinguishable,
        driver: smooth.first().cloned(),
        drivers: smooth,
        discrepancy: flexible.map(ground),
        residual_drivers: drivers::of(
            judge,
            &base.judged,
            best.filter(|_| verdict != Verdict::NothingMissing)
                .map(|i| &ranking.judged[i]),
        ),
        explained_share: best
            .filter(|_| flexible.is_real())
            .map(|i| ranking.shares[i]),
        attainable_drop: flexible.drop.max(0.0),
        attainable_spread: flexible.spread(),
        unknown_evidence_gain: ranking.unknown - base.judged.log_evidence,
        sparse_regression: Vec::new(),
        next_experiment: None,
        screened: ranking
            .judged
            .iter()
            .map(|j| Screened {
                effect: j.candidate.name(),
                form: form(j),
                evidence_gain: j.log_evidence - base.judged.log_evidence,
                chi2_drop: base.judged.square - j.square,
                decided: j.fidelity == judge.fidelity,
                values: parameters(j).iter().map(|p| p.value).collect(),
            })
            .collect(),
        not_judged,
        warnings,
        probabilities: ranking.probabilities.clone(),
    };
    diagnosis.next_experiment = next_experiment(judge, shop, base, &ranking, &diagnosis);
    words::explain(&mut diagnosis, judge, base, &ranking);
    diagnosis
}

/// The test that separates the two most probable of what is left; none where nothing is in doubt.
fn next_experiment(
    judge: &Judge<'_>,
    shop: &Workshop,
    base: &Base,
    ranking: &Ranking,
    diagnosis: &Diagnosis,
) -> Option<NextExperiment> {
    let of = |name: &str| match ranking.best_of(name) {
        Some(place) => Some(&ranking.judged[place]),
        None => (name == NOTHING).then_some(&base.judged),
    };
    let effects = ranking.effects();
    let names: Vec<&str> = match diagnosis.verdict {
        Verdict::Ambiguous => diagnosis
            .indistinguishable
            .iter()
            .flatten()
            .map(String::as_str)
            .collect(),
        Verdict::Effect | Verdict::Effects => effects.iter().take(2).map(|e| e.0).collect(),
        Verdict::NothingMissing => std::iter::once(NOTHING)
            .chain(effects.first().map(|e| e.0))
            .collect(),
        Verdict::Unknown => return None,
    };
    let mut left = names.into_iter().filter_map(of);
    let (a, b) = (left.next()?, left.next()?);
    let settled = (a.log_evidence - b.log_evidence).abs() > SETTLED;
    if settled && diagnosis.verdict != Verdict::Ambiguous {
        return None;
    }
    next::experiment(judge, shop, a, b).filter(|told| told.together_chi2 >= WORTH_MAKING)
}
