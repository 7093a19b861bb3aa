//! Adds a learned law, as the curve or as a plain formula near it: its size and length by the analytic model, then fitted by the study's own.

use super::compare::{CompareError, CompareStage, Compared, contact_of};
use crate::learn::fitting::measured::Measured;
use crate::learn::hypothesis::version::ModelVersion;
use crate::learn::inference::search::Effort;
use crate::learn::learned::law::{LearnError, TriedProcess, WantedLaw, deviations, fitted_law};
use crate::learn::learned::plain;
use crate::learn::learned::plain_form::PlainForm;
use crate::learn::noise::NoiseModel;
use crate::learn::prediction::bench::{Workshop, for_looks};
use crate::learn::prediction::fidelity::Fidelity;
use crate::measure::Dataset;
use crate::simulate::forward::ContactKind;
use crate::study::{EffectSpec, LearnedLaw, Study, WEAR_COEFFICIENT};

/// Wear histories that looking for size and length takes, for each test, from experience.
const HISTORIES: usize = 250;

/// A learned law, fitted.
#[derive(Debug, Clone)]
pub struct LearnedAddition {
    /// The law with its values; those of the analytic model where a formula stands in its place.
    pub law: LearnedLaw,
    /// The formula in its place, with its values.
    pub plain: Option<EffectSpec>,
    /// Standard deviations of the curve's values.
    pub sigma: Vec<f64>,
    /// Sizes and lengths that the analytic model was fitted with.
    pub tried: Vec<TriedProcess>,
    /// The study's model without it.
    pub without: Compared,
    /// With it.
    pub compared: Compared,
}

/// Why no law was added.
#[derive(Debug, thiserror::Error)]
pub enum AddLearnedError {
    /// The study cannot be compared.
    #[error(transparent)]
    Compare(#[from] CompareError),
    /// The law cannot be learned.
    #[error(transparent)]
    Learn(#[from] LearnError),
}

/// Learns a law beside what the study has, and judges it; `form`: as the plain formula of this form that comes nearest to the curve.
///
/// # Errors
/// [`AddLearnedError`]
pub fn add_learned(
    study: &Study,
    data: &Dataset,
    (wanted, form): (&WantedLaw, Option<PlainForm>),
    watch: &(dyn Fn(CompareStage) + Sync),
) -> Result<LearnedAddition, AddLearnedError> {
    let kind = contact_of(study).map_err(CompareError::from)?;
    let measured = Measured::new(study, data.clone());
    let version = ModelVersion::of(study);
    let expected = HISTORIES * measured.roles.len();
    let told = |histories| {
        watch(CompareStage::Fitting {
            histories,
            expected,
        });
    };
    watch(CompareStage::Tests);
    let own = NoiseModel::of(&study.noise);
    let (numerics, noise) = match kind {
        ContactKind::Hertz => (study.resolution(), own),
        // what finite elements make else is not to be learned as a law
        ContactKind::Fem => (
            for_looks(study.resolution()),
            NoiseModel {
                model_error: Some(Fidelity::Screening.model_error()),
                ..own
            },
        ),
    };
    let failed = CompareError::from;
    let set = study.gear_set();
    let analytic =
        Workshop::new(set, numerics, ContactKind::Hertz, measured.tests()).map_err(failed)?;
    let bench = measured.bench(&analytic).map_err(failed)?;
    let start: Vec<f64> = (version.free.iter())
        .filter(|free| free.name != WEAR_COEFFICIENT)
        .map(|free| free.value)
        .collect();
    let effort = Effort::for_simulations();
    let without = measured
        .fit(&bench, &version, noise, &[start], &effort, &told)
        .map_err(CompareError::from)?;
    let found = measured.learn(&bench, &version, &without, wanted, noise, &told)?;
    let curve = &found.law;
    let sigma = deviations(curve, &found.fit);
    let plain = match form {
        None => None,
        Some(form) => Some(
            plain::nearest(
                (&curve.law, &curve.values, &sigma),
                measured.longest_test(),
                form,
            )
            .map_err(|why| LearnError::Shape(format!("{}: {why}", wanted.name())))?,
        ),
    };
    watch(CompareStage::Members);
    let workshop = measured.workshop(kind).map_err(failed)?;
    let bench = measured.bench(&workshop).map_err(failed)?;
    let without = measured
        .compare(&bench, &version, watch)
        .map_err(CompareError::from)?;
    let added = plain.clone().unwrap_or_else(|| curve.clone().spec());
    let compared = measured
        .compare(&bench, &version.with(added), watch)
        .map_err(CompareError::from)?;
    let (law, sigma) = match plain {
        Some(_) => (curve.clone(), sigma),
        None => (
            fitted_law(curve, &compared.fit),
            deviations(curve, &compared.fit),
        ),
    };
    Ok(LearnedAddition {
        law,
        sigma,
        plain: plain.map(|spec| plain::fitted(spec, &compared.fit)),
        tried: found.tried,
        without,
        compared,
    })
}
