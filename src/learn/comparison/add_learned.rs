//! Adds a learned law: its size and length by the analytic model, then fitted by the study's own.

use super::compare::{CompareError, CompareStage, Compared, contact_of};
use crate::learn::fitting::measured::Measured;
use crate::learn::hypothesis::version::ModelVersion;
use crate::learn::inference::search::Effort;
use crate::learn::learned::law::{LearnError, TriedProcess, WantedLaw, deviations, fitted_law};
use crate::learn::noise::NoiseModel;
use crate::learn::prediction::bench::{Workshop, for_looks};
use crate::learn::prediction::fidelity::Fidelity;
use crate::measure::Dataset;
use crate::simulate::forward::ContactKind;
use crate::study::{LearnedLaw, Study, WEAR_COEFFICIENT};

/// Wear histories that looking for size and length takes, for each test, from experience.
const HISTORIES: usize = 250;

/// A learned law, fitted.
#[derive(Debug, Clone)]
pub struct LearnedAddition {
    /// The law with its values.
    pub law: LearnedLaw,
    /// Standard deviations of the values.
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

/// Learns a law beside what the study has, and judges it.
///
/// # Errors
/// [`AddLearnedError`]
pub fn add_learned(
    study: &Study,
    data: &Dataset,
    wanted: &WantedLaw,
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
    watch(CompareStage::Members);
    let workshop = measured.workshop(kind).map_err(failed)?;
    let bench = measured.bench(&workshop).map_err(failed)?;
    let without = measured
        .compare(&bench, &version, watch)
        .map_err(CompareError::from)?;
    let with = version.with(found.law.clone().spec());
    let compared = measured
        .compare(&bench, &with, watch)
        .map_err(CompareError::from)?;
    Ok(LearnedAddition {
        law: fitted_law(&found.law, &compared.fit),
        sigma: deviations(&found.law, &compared.fit),
        tried: found.tried,
        without,
        compared,
    })
}
