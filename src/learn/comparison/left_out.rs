//! How well a model predicts each test that it is not fitted to: one after the other left out of the fit.

use super::compare::{CompareError, CompareStage, contact_of};
use crate::learn::fitting::measured::Measured;
use crate::learn::hypothesis::version::ModelVersion;
use crate::measure::Dataset;
use crate::study::{Role, Study};

/// The error of tests that the model was not fitted to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeftOut {
    /// Number of observations.
    pub points: usize,
    /// Mean squared standardised residual, with each test's own most probable wear coefficient and datums.
    pub chi2_per_point: f64,
}

/// Fits the study to all of its fit tests but one, for each of them, and takes the error on the one that was left out. None with fewer
/// than two fit tests.
///
/// # Errors
/// [`CompareError`] if one of the fits fails.
pub fn left_out(
    study: &Study,
    data: &Dataset,
    watch: &(dyn Fn(CompareStage) + Sync),
) -> Result<Option<LeftOut>, CompareError> {
    let kind = contact_of(study)?;
    let mut measured = Measured::new(study, data.clone());
    let roles = measured.roles.clone();
    let is_measured = |test: &usize| data.observations.iter().any(|o| o.test == *test);
    let fitted: Vec<usize> = (0..roles.len())
        .filter(|test| roles[*test] == Role::Fit)
        .filter(is_measured)
        .collect();
    if fitted.len() < 2 {
        return Ok(None);
    }
    let workshop = measured.workshop(kind)?;
    let bench = measured.bench(&workshop)?;
    let version = ModelVersion::of(study);
    let (mut points, mut square) = (0, 0.0);
    for &test in &fitted {
        measured.roles.clone_from(&roles);
        measured.roles[test] = Role::Holdout;
        let fit = measured.compare(&bench, &version, watch)?.fit;
        for (row, observation) in fit.rows.iter().zip(&data.observations) {
            if observation.test == test {
                points += 1;
                square += row.standardised.powi(2);
            }
        }
    }
    Ok(Some(LeftOut {
        points,
        chi2_per_point: square / points as f64,
    }))
}
