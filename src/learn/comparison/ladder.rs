//! Versions of a model side by side: what `ladder.json` is written from.

use serde::{Deserialize, Serialize};

use super::add::{agree, betters_nothing};
use super::record::{Comparison, ParameterRecord};

/// One version of a model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LadderStep {
    /// The study.
    pub study: String,
    /// Its effects.
    pub effects: Vec<String>,
    /// χ² per point of the fit tests; None without any.
    pub fit_chi2_per_point: Option<f64>,
    /// χ² per point of the held-out tests; None without any.
    pub holdout_chi2_per_point: Option<f64>,
    /// Root mean square of model minus measured over wear depths, µm.
    pub rms_um: Option<f64>,
    /// What was free.
    pub parameters: Vec<ParameterRecord>,
    /// The earlier version that it is judged against: the one that it adds something to.
    #[serde(default)]
    pub against: Option<String>,
    /// Change from that; None for the first, and where the two cannot be judged against each other.
    pub improvement: Option<Improvement>,
    /// Whether the fit converged with no parameter on a bound.
    pub sound: bool,
}

/// What one step of the ladder gains over the version that it is judged against. Above 1, or above 0 for the evidence, is better.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Improvement {
    /// χ² per point of the fit tests before over after. It hardly ever falls: a free parameter more always fits better.
    pub fit_factor: Option<f64>,
    /// χ² per point of the held-out tests before over after: this one judges.
    pub holdout_factor: Option<f64>,
    /// Root mean square before over after.
    pub rms_factor: Option<f64>,
    /// Gain of the logarithm of the marginal likelihood; None if the two were fitted to different numbers of points.
    pub log_evidence: Option<f64>,
}

/// One version to be put on the ladder.
#[derive(Debug, Clone, Copy)]
pub struct Version<'a> {
    /// The study's name.
    pub study: &'a str,
    /// Its effects, in its order.
    pub effects: &'a [String],
    /// How it compares.
    pub comparison: &'a Comparison,
    /// Place of the earlier version that it is judged against; None for the first, and where the two have not the same measurements, tests,
    /// roles and noise.
    pub before: Option<usize>,
}

/// The earlier version that each adds something to: of those whose effects it has too the one with the most, the last of several; the one before
/// it where there is none.
pub fn precursors(effects: &[Vec<String>]) -> Vec<Option<usize>> {
    let of = |(place, own): (usize, &Vec<String>)| {
        let earlier = (0..place).filter(|&i| is_among(&effects[i], own));
        let most = earlier.max_by_key(|&i| (effects[i].len(), i));
        most.or_else(|| place.checked_sub(1))
    };
    effects.iter().enumerate().map(of).collect()
}

/// Whether all of these effects are among others.
pub fn is_among(effects: &[String], others: &[String]) -> bool {
    effects.iter().all(|name| others.contains(name))
}

/// The versions in the order given, each with what it gains over the one that it is judged against.
pub fn ladder(versions: &[Version<'_>]) -> Vec<LadderStep> {
    let step = |version: &Version<'_>| {
        let now = version.comparison;
        let before = version.before.map(|before| &versions[before]);
        LadderStep {
            study: version.study.to_owned(),
            effects: version.effects.to_vec(),
            fit_chi2_per_point: now.fit.chi2_per_point,
            holdout_chi2_per_point: now.holdout.chi2_per_point,
            rms_um: now.rms_um,
            parameters: parameters(
                now,
                (before.filter(|before| is_among(before.effects, version.effects)))
                    .map(|before| before.comparison),
            ),
            against: before.map(|before| before.study.to_owned()),
            improvement: before.map(|before| Improvement::between(before.comparison, now)),
            sound: now.converged && now.parameters.iter().all(|p| !p.at_bound),
        }
    };
    versions.iter().map(step).collect()
}

/// The parameters of a version; those that it has beyond the one `before` without intervals where they better nothing, as where they are added, and do not make
/// the tests agree either.
fn parameters(now: &Comparison, before: Option<&Comparison>) -> Vec<ParameterRecord> {
    let mut parameters = now.parameters.clone();
    let Some(before) = before else {
        return parameters;
    };
    let is_known =
        |own: &ParameterRecord| before.parameters.iter().any(|known| known.name == own.name);
    let gain = evidence_gained(before, now);
    let scatter = [before, now].map(|version| version.coefficient_scatter);
    if betters_nothing(before.fit.chi2_per_point, gain, &now.fit) && !agree(scatter) {
        for own in parameters.iter_mut().filter(|own| !is_known(own)) {
            own.interval_95 = None;
        }
    }
    parameters
}

/// Log evidence that a version gains over another of the same points; None of others.
fn evidence_gained(before: &Comparison, after: &Comparison) -> Option<f64> {
    let same = before.fit.points == after.fit.points;
    same.then_some(after.log_evidence - before.log_evidence)
}

impl Improvement {
    fn between(before: &Comparison, after: &Comparison) -> Self {
        let factor = |before: Option<f64>, after: Option<f64>| Some(before? / after?);
        Self {
            fit_factor: factor(before.fit.chi2_per_point, after.fit.chi2_per_point),
            holdout_factor: factor(before.holdout.chi2_per_point, after.holdout.chi2_per_point),
            rms_factor: factor(before.rms_um, after.rms_um),
            log_evidence: evidence_gained(before, after),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::precursors;

    #[test]
    fn rivals_are_judged_against_what_they_add_to() {
        let of = |effects: &[&str]| -> Vec<String> {
            effects.iter().map(|name| (*name).to_owned()).collect()
        };
        let versions = [
            of(&[]),
            of(&["a"]),
            of(&["b"]),
            of(&["a", "c"]),
            of(&["d"]),
            of(&["a", "c"]),
        ];
        let expected = [None, Some(0), Some(0), Some(1), Some(0), Some(3)];
        assert_eq!(precursors(&versions), expected);
        // nothing that either adds to
        assert_eq!(precursors(&[of(&["a"]), of(&["b"])]), [None, Some(0)]);
    }
}
