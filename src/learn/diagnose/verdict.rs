//! The answer: what `diagnosis.json` is written from.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::anchored::{Anchored, model, predictions};
use super::candidate::NotJudged;
use super::drivers::{self, ResidualDrivers};
use super::fidelity::Fidelity;
use super::flexible::{Driver, Flexible, MapPoint};
use super::ground::Ground;
use super::judge::{Base, Judge, Judged};
use super::rank::Ranking;
use super::{NOTHING, UNKNOWN};
use super::{next, words};
use crate::learn::bench::Workshop;
use crate::learn::search::Effort;
use crate::study::{Role, Scatter};

/// Probability from which a single effect or set is named.
const CLAIM: f64 = 0.9;
/// Probability of nothing missing from which an effect is not claimed, and above which it is the answer.
const DOUBT: f64 = 0.2;
/// Candidates this much less probable than the leader are no look-alikes.
const ALIKE: f64 = 0.03;
/// Log evidence between two candidates from which no experiment is needed to separate them.
const SETTLED: f64 = 10.0;
/// Entries of the ranking.
const LISTED: usize = 12;
/// Leaders whose held-out error is computed.
const JUDGED_ON_HOLDOUT: usize = 3;

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

/// One entry of the ranking.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Ranked {
    /// Effect, set, or `nothing_missing`.
    pub effect: String,
    /// The most probable of its accepted forms; empty for the card's own.
    pub form: String,
    /// Probability.
    pub probability: f64,
    /// Log evidence over the base model's.
    pub evidence_gain: f64,
    /// Fitted parameters.
    pub parameters: Vec<ParameterValue>,
    /// The wear coefficient common to the tests, mm²/N.
    pub wear_coefficient: f64,
    /// Mean squared standardised residual of the fit tests.
    pub fit_chi2_per_point: f64,
    /// Of the held-out tests; None without, and for candidates far behind.
    pub holdout_chi2_per_point: Option<f64>,
    /// Angle between what it and the leading effect change, deg, in the metric of the noise, after k is refitted; below some 10 they
    /// do the same. None for `nothing_missing`.
    pub angle_to_leader: Option<f64>,
    /// `fem`, `coarse_fem` or `hertz`: by what it was judged in the end.
    pub decided_by: Fidelity,
    /// Whether its fit converged.
    pub converged: bool,
}

/// A fitted parameter.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ParameterValue {
    /// Its name; with its effect's where there are several effects.
    pub name: String,
    /// Most probable value.
    pub value: f64,
    /// One standard deviation.
    pub sigma: f64,
    /// Unit.
    pub unit: String,
    /// Whether it lies on a bound.
    pub at_bound: bool,
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
    let mut warnings = warnings(ground, base, &ranking);
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
        if nothing >= DOUBT {
            group.push(NOTHING.to_owned());
        }
        Verdict::Ambiguous
    };
    if verdict == Verdict::Ambiguous && group.len() < 2 {
        // What keeps the leader from being named is then the unknown.
        group.push(UNKNOWN.to_owned());
    }
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
    let smooth = if flexible.is_real() {
        flexible.drivers(ground, &base.judged.found.model)
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
    next::experiment(judge, shop, a, b)
}

fn ranked(judge: &Judge<'_>, base: &Base, ranking: &Ranking) -> Vec<Ranked> {
    let mut names: Vec<(&str, f64)> = (ranking.probabilities.iter())
        .map(|(name, p)| (name.as_str(), *p))
        .filter(|(name, _)| *name != UNKNOWN)
        .collect();
    let evidence = |name: &str| {
        ranking
            .best_of(name)
            .map_or(base.judged.log_evidence, |i| ranking.judged[i].log_evidence)
    };
    names.sort_by(|a, b| {
        b.1.total_cmp(&a.1)
            .then(evidence(b.0).total_cmp(&evidence(a.0)))
    });
    let leader = ranking.effects().first().and_then(|e| ranking.best_of(e.0));
    let seen = |place: usize| judge.visible(base, &ranking.judged[place].change);
    let leading = leader.map(seen);
    let angle = |name: &str| {
        let (own, leading) = (seen(ranking.best_of(name)?), leading.as_ref()?);
        let lengths = own.norm() * leading.norm();
        (lengths > 0.0).then(|| {
            (own.dot(leading) / lengths)
                .clamp(-1.0, 1.0)
                .acos()
                .to_degrees()
        })
    };
    let held = Ground::new(judge.ground.measured, judge.ground.noise, Role::Holdout);
    let mut listed: Vec<(&str, f64)> = names.iter().copied().take(LISTED).collect();
    if !listed.iter().any(|l| l.0 == NOTHING) {
        listed.extend(names.iter().copied().filter(|n| n.0 == NOTHING));
    }
    listed
        .into_iter()
        .enumerate()
        .filter_map(|(i, (name, probability))| {
            let judged = match ranking.best_of(name) {
                Some(place) => &ranking.judged[place],
                None if name == NOTHING => &base.judged,
                None => return None,
            };
            let wanted = !held.tests.is_empty() && (i < JUDGED_ON_HOLDOUT || name == NOTHING);
            Some(Ranked {
                effect: name.to_owned(),
                form: form(judged),
                probability,
                evidence_gain: judged.log_evidence - base.judged.log_evidence,
                parameters: parameters(judged),
                wear_coefficient: judged.found.state.log_k.exp(),
                fit_chi2_per_point: judge.ground.chi2_per_point(&judged.found.model),
                holdout_chi2_per_point: if wanted {
                    held_out(judge, &held, judged)
                } else {
                    None
                },
                angle_to_leader: angle(name),
                decided_by: judged.fidelity,
                converged: judged.converged,
            })
        })
        .collect()
}

/// The other forms than the cards' own.
fn form(judged: &Judged) -> String {
    let forms = judged.candidate.forms.iter().copied();
    forms
        .filter(|f| !f.is_empty())
        .collect::<Vec<_>>()
        .join(", ")
}

/// Values and standard deviations of a candidate's own parameters.
pub(super) fn parameters(judged: &Judged) -> Vec<ParameterValue> {
    let candidate = &judged.candidate;
    let several = candidate.names.len() > 1;
    let first = judged.covariance.nrows() - candidate.parameters.len();
    (candidate.inherited..candidate.parameters.len())
        .map(|i| {
            let parameter = &candidate.parameters[i];
            let mode = judged.found.state.theta[i];
            let sd = judged.covariance[(first + i, first + i)].max(0.0).sqrt();
            let estimate = parameter.estimate(mode, mode, sd);
            let short = estimate.name.split_once('.').map_or("", |(_, short)| short);
            ParameterValue {
                name: if several {
                    estimate.name.clone()
                } else {
                    short.to_owned()
                },
                value: estimate.value,
                sigma: estimate.sigma,
                unit: estimate.unit,
                at_bound: estimate.at_bound,
            }
        })
        .collect()
}

/// χ² per point of the held-out tests, all that is common to tests as fitted, their own k free.
fn held_out(judge: &Judge<'_>, held: &Ground<'_>, judged: &Judged) -> Option<f64> {
    let candidate = &judged.candidate;
    let bench = judge.exact;
    let predictor = Anchored::new(model(bench, candidate), Vec::new());
    let state = crate::learn::quadratic::State {
        epsilon: vec![0.0; held.tests.len()],
        ..judged.found.state.clone()
    };
    if judge.ground.noise.scatter == Scatter::Relative(0.0) {
        let values = predictions(held, &predictor, candidate, &state).ok()?;
        return Some(held.chi2_per_point(&held.joined(&values)));
    }
    let found = held
        .fit_held(
            &predictor,
            candidate,
            state,
            judged.found.scatter,
            &Effort::default(),
        )
        .ok()?;
    Some(held.chi2_per_point(&found.model))
}

/// What keeps an answer from being trusted.
fn warnings(ground: &Ground<'_>, base: &Base, ranking: &Ranking) -> Vec<String> {
    let mut warnings = Vec::new();
    let data = &ground.measured.data;
    let mut alone = Vec::new();
    for &test in &ground.tests {
        let mut cycles: Vec<u64> = (0..ground.len())
            .map(|i| ground.observation(i))
            .filter(|o| o.test == test)
            .map(|o| o.cycles.to_bits())
            .collect();
        cycles.sort_unstable();
        cycles.dedup();
        if cycles.len() < 2 {
            alone.push(data.tests[test].as_str());
        }
    }
    if alone.len() == ground.tests.len() {
        warnings.push(
            "every test was measured at one number of cycles only: what changes over life (running-in, debris, ageing, polishing) cannot be told from a constant".to_owned(),
        );
    } else if !alone.is_empty() {
        warnings.push(format!(
            "measured at one number of cycles only: {}",
            alone.join(", ")
        ));
    }
    if ground.tests.len() == 1 {
        warnings.push(
            "there is one test only: what depends on torque, speed or misalignment cannot be told from what does not".to_owned(),
        );
    }
    let free = 1 + base.judged.candidate.parameters.len() + ground.tests.len();
    if ground.len() < 4 * (free + 2) {
        warnings.push(format!(
            "{} measured values are few for about {} unknowns: only strong effects can show",
            ground.len(),
            free + 2
        ));
    }
    if !base.judged.converged {
        warnings
            .push("the fit of the base model did not converge: probabilities are rough".to_owned());
    }
    if let Some(leader) = ranking.effects().first().and_then(|e| ranking.best_of(e.0)) {
        let leader = &ranking.judged[leader];
        if !leader.converged {
            warnings.push(format!(
                "the fit with {} did not converge: its parameters are rough",
                leader.candidate.name()
            ));
        }
        for p in parameters(leader).iter().filter(|p| p.at_bound) {
            warnings.push(format!(
                "{} of {} lies on its bound, {:e}",
                p.name,
                leader.candidate.name(),
                p.value
            ));
        }
    }
    warnings
}
