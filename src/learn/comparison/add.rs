//! Adds an effect: fitted in its own form, and in its other accepted ones if that leaves more than noise.
//!
//! Nature does not use our formulas. A running-in that decays as a hyperbola is a running-in, but fitted by an exponential it leaves
//! a misfit behind, in which the next effect would be looked for in vain.

use std::cell::OnceCell;

use super::compare::{CompareError, CompareStage, Compared, FAR_SHARE, contact_of};
use super::missed::BaselineMisfit;
use super::residual_statistics::Share;
use crate::learn::fitting::fitted::Fit;
use crate::learn::fitting::measured::{Measured, Misfit};
use crate::learn::hypothesis::version::ModelVersion;
use crate::measure::Dataset;
use crate::study::{EffectModel, Study, WEAR_COEFFICIENT};

/// χ² per point beyond 1, in standard deviations of noise, with which another form is tried.
const LEFT: f64 = 2.0;
/// Gain of log evidence for which another form is preferred to the effect's own.
const BETTER: f64 = 3.0;

/// Fall of χ² up to which an effect's parameters may have followed noise: 1 % of χ² with three degrees of freedom.
const CHANCE: f64 = 11.3;

/// Gain of log evidence with which parameters have a hold on the measurements although χ² does not fall: where each test has a k of its own, that
/// takes up what they explain, and they bring the k of the tests together instead.
const HOLD: f64 = 3.0;

/// Scatter of k between tests, relative, from which an effect that takes half of it is worth a word.
const UNLIKE: f64 = 0.15;

/// Share of the least misfit beyond noise, of the forms so far or without the effect, that a cheaper model may leave of another form where that
/// misfit is large: fine elements are not asked about forms that leave more.
const PROMISING: f64 = 0.8;

/// A base model with an effect more, in one of its forms.
#[derive(Debug, Clone)]
pub struct AddedForm {
    /// The model.
    pub version: ModelVersion,
    /// Values of its last parameters, each a place to begin from beside what the own form was fitted to; none: it begins from its own
    /// values, or from what the own form was fitted to where that is nearer.
    pub grown: &'static [&'static [f64]],
    /// Whether a diagnosis of the same measurements has the effect in this form: it is fitted whatever the own one leaves.
    pub named: bool,
}

/// What fitting an added effect found.
#[derive(Debug, Clone)]
pub struct Addition {
    /// Which of the forms is preferred.
    pub form: usize,
    /// Its fit.
    pub compared: Compared,
    /// χ² per point of the fit tests without the effect, what else is free fitted anew; None where that cannot be computed.
    pub without_chi2_per_point: Option<f64>,
    /// The same of the held-out tests.
    pub without_holdout_chi2_per_point: Option<f64>,
    /// Log evidence without the effect.
    pub without_log_evidence: Option<f64>,
    /// Scatter of k between the tests without the effect, relative.
    pub without_scatter: Option<f64>,
    /// Fits of the forms in their order; None for those not tried, or that could not be fitted.
    pub tried: Vec<Option<FormFit>>,
    /// Forms not tried for a cheaper model promises little of them, and all that were tried leave far more than noise.
    pub passed_over: Vec<usize>,
}

impl Addition {
    /// Whether the effect betters nothing that noise would not.
    pub fn betters_nothing(&self) -> bool {
        let gain =
            (self.without_log_evidence).map(|without| self.compared.fit.log_evidence - without);
        betters_nothing(
            self.without_chi2_per_point,
            gain,
            &self.compared.comparison.fit,
        )
    }

    /// The scatter of k between the tests without the effect and with it, where it makes them agree: by half, where they differed by more than k of like tests do.
    pub fn makes_agree(&self) -> Option<[f64; 2]> {
        let both = [self.without_scatter?, self.compared.fit.scatter];
        agree(both).then_some(both)
    }
}

/// Whether tests agree in k, by its scatter between them without an effect and with it.
pub(super) fn agree([without, with]: [f64; 2]) -> bool {
    without > UNLIKE && with < 0.5 * without
}

/// Whether a fit betters nothing over one of this χ² per point that noise would not, over which it gains so much log evidence: its new parameters
/// have no hold on the measurements then.
pub(super) fn betters_nothing(without: Option<f64>, gain: Option<f64>, fit: &Share) -> bool {
    let fall = without.zip(fit.chi2_per_point);
    gain.is_none_or(|gain| gain < HOLD)
        && fall.is_some_and(|(without, with)| with > without - CHANCE / fit.points.max(1) as f64)
}

/// One form's fit in short.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FormFit {
    /// Logarithm of its marginal likelihood.
    pub log_evidence: f64,
    /// χ² per point of the fit tests.
    pub chi2_per_point: Option<f64>,
}

/// Fits a study's measurements with an effect in its own form (the first one), in those that are named, and in the others if that leaves more than noise.
/// `watch` is told the number of the form.
///
/// # Errors
/// [`CompareError`] if the first form cannot be fitted.
pub fn add(
    study: &Study,
    data: &Dataset,
    forms: &[AddedForm],
    watch: &(dyn Fn(CompareStage, usize) + Sync),
) -> Result<Addition, CompareError> {
    let kind = contact_of(study)?;
    let measured = Measured::new(study, data.clone());
    watch(CompareStage::Members, 0);
    let workshop = measured.workshop(kind)?;
    watch(CompareStage::Tests, 0);
    let bench = measured.bench(&workshop)?;
    let (own, others) = forms
        .split_first()
        .expect("an effect has a form of its own");
    let without = without_last(&forms[0].version);
    let without = (without.as_ref()).map(|without| BaselineMisfit::by(without, &bench));
    // where others are fitted along, how much of them the effect takes over shows at the end of the fit only
    let alone = is_free_alone(&forms[0].version);
    let missed = without.as_ref().filter(|_| alone);
    let first = |doing| watch(doing, 0);
    let own = measured.compare_from(&bench, &own.version, Vec::new(), missed, &first)?;
    let mut tried = vec![Some(in_short(&own))];
    let mut passed_over = Vec::new();
    let promising = Promising {
        measured: &measured,
        missed,
        own: own
            .promised
            .map_or_else(OnceCell::new, |own| OnceCell::from(Some(own))),
        version: &forms[0].version,
    };
    let mut best = (0, own.clone());
    for (i, form) in others.iter().enumerate() {
        let places = places(form, &own.fit);
        let left = measured.misfit(&best.1.fit);
        if !form.named && !leaves_something(&own) {
            tried.push(None);
            continue;
        }
        if !form.named && left.is_far() && !promising.is(&form.version, left, places.clone()) {
            tried.push(None);
            passed_over.push(i + 1);
            continue;
        }
        let other = |doing| watch(doing, i + 1);
        let fitted = measured.compare_from(&bench, &form.version, places, missed, &other);
        // a form that cannot be fitted is no reason against the others
        let fitted = fitted.ok();
        tried.push(fitted.as_ref().map(in_short));
        if let Some(fitted) = fitted {
            let margin = if best.0 == 0 { BETTER } else { 0.0 };
            // fits that stay far from the measurements are made no more finely
            let rough = if left.is_far() {
                FAR_SHARE * left.beyond_noise()
            } else {
                0.0
            };
            let margin = margin + rough;
            if fitted.fit.log_evidence > best.1.fit.log_evidence + margin {
                best = (i + 1, fitted);
            }
        }
    }
    let (form, compared) = best;
    let held_out = (without.as_ref()).and_then(|without| without.held_out(&measured));
    let log_evidence = (without.as_ref()).and_then(|without| without.log_evidence(&measured));
    let scatter = (without.as_ref()).and_then(|without| without.scatter(&measured));
    let without = (without.as_ref()).and_then(|without| without.base(&measured));
    let points = measured.fitted_points() as f64;
    let mut addition = Addition {
        form,
        compared,
        without_chi2_per_point: without.map(|without| without.square / points),
        without_holdout_chi2_per_point: held_out,
        without_log_evidence: log_evidence,
        without_scatter: scatter,
        tried,
        passed_over,
    };
    if addition.betters_nothing() && addition.makes_agree().is_none() {
        addition.compared = addition.compared.without_intervals();
    }
    Ok(addition)
}

/// Which forms are worth the price of fine elements where all so far leave far more than noise.
struct Promising<'p> {
    measured: &'p Measured<'p>,
    missed: Option<&'p BaselineMisfit<'p>>,
    /// The effect's own form, and χ² that a cheaper model promises of it.
    version: &'p ModelVersion,
    own: OnceCell<Option<f64>>,
}

impl Promising<'_> {
    /// Whether a cheaper model promises that a form leaves much less than the model without the effect does, and than is `left` so far or it
    /// promises of the effect's own form; also where it promises nothing.
    fn is(&self, version: &ModelVersion, left: Misfit, places: Vec<Vec<f64>>) -> bool {
        let Some(base) = self.missed.and_then(|missed| missed.base(self.measured)) else {
            return true;
        };
        let Some(promised) = self.measured.promised(version, base, places) else {
            return true;
        };
        let is_much_less = |than: f64| {
            let beyond = |square: f64| Misfit { square, ..left }.beyond_noise();
            beyond(promised) < PROMISING * beyond(than)
        };
        let own = || self.measured.promised(self.version, base, Vec::new());
        is_much_less(base.square)
            && (is_much_less(left.square) || (self.own.get_or_init(own)).is_none_or(is_much_less))
    }
}

/// The version without the effect that joined last; what is free of the others stays free.
fn without_last(version: &ModelVersion) -> Option<ModelVersion> {
    let (last, before) = version.effects.specs().split_last()?;
    let own = format!("{}.", last.name);
    let others = (version.free.iter()).filter(|free| !free.name.starts_with(&own));
    Some(ModelVersion {
        effects: EffectModel::new(before.to_vec()),
        free: others.cloned().collect(),
    })
}

/// Whether nothing is free but k and the effect that joined last.
fn is_free_alone(version: &ModelVersion) -> bool {
    version.free_of_effects().count() == version.of_last().count()
}

/// Whether χ² per point of the fit tests is beyond that of noise.
fn leaves_something(own: &Compared) -> bool {
    let fit = &own.comparison.fit;
    let noise = (2.0 / fit.points.max(1) as f64).sqrt();
    fit.chi2_per_point
        .is_some_and(|chi2| chi2 > 1.0 + LEFT * noise)
}

fn in_short(compared: &Compared) -> FormFit {
    FormFit {
        log_evidence: compared.fit.log_evidence,
        chi2_per_point: compared.comparison.fit.chi2_per_point,
    }
}

/// Values of a form's parameters to begin from, those that the own form has taken from its fit.
fn places(form: &AddedForm, own: &Fit) -> Vec<Vec<f64>> {
    let free = form.version.free.iter();
    let names = free.filter(|free| free.name != WEAR_COEFFICIENT);
    let fitted: Vec<f64> = names
        .map(|free| {
            let known = own.parameters.iter().find(|p| p.name == free.name);
            known.map_or(free.value, |p| p.value.clamp(free.lower, free.upper))
        })
        .collect();
    if form.grown.is_empty() {
        return vec![fitted];
    }
    let grown = form.grown.iter();
    grown
        .map(|place| {
            let mut values = fitted.clone();
            let first = values.len() - place.len();
            values[first..].copy_from_slice(place);
            values
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On 100 points: χ² has to fall by 0.113 per point, or the evidence to rise where each test's own k takes up what it could fall by.
    #[test]
    fn what_brings_the_tests_together_betters_something() {
        let fit = Share {
            points: 100,
            chi2_per_point: Some(1.0),
            rms_um: None,
        };
        assert!(betters_nothing(Some(1.1), None, &fit));
        assert!(betters_nothing(Some(1.1), Some(2.0), &fit));
        assert!(!betters_nothing(Some(1.1), Some(4.0), &fit));
        assert!(!betters_nothing(Some(1.12), Some(-4.0), &fit));
    }
}
