//! The challenges' files.

use std::collections::BTreeMap;

use crate::measure::{Dataset, Known};
use crate::simulate::forward::ForwardError;
use crate::source_text::TextError;
use crate::study::Study;

/// One challenge with its answer.
#[derive(Debug)]
pub struct Challenge {
    /// Its name.
    pub name: &'static str,
    /// The study with the sealed test after its own.
    pub study: Study,
    /// The measurements, then those of the sealed test.
    pub data: Dataset,
    /// Noise-free values of `data`, in its units.
    pub noise_free: Vec<f64>,
    /// True wear coefficient, mm²/N.
    pub coefficient: f64,
    effects: Vec<Applied>,
}

/// The answer beside the data.
#[derive(Debug, serde::Deserialize)]
struct Answer {
    k_true: f64,
    effects: Vec<Applied>,
    noise_free: Vec<f64>,
}

#[derive(Debug, serde::Deserialize)]
struct Applied {
    kind: String,
    parameters: BTreeMap<String, f64>,
}

/// The files of a challenge.
struct Files {
    name: &'static str,
    study: &'static str,
    measurements: &'static str,
    sealed_test: &'static str,
    sealed: &'static str,
    truth: &'static str,
}

macro_rules! files {
    ($name:literal) => {
        Files {
            name: $name,
            study: include_str!(concat!(
                "../../../validation/challenges/",
                $name,
                "/study.toml"
            )),
            measurements: include_str!(concat!(
                "../../../validation/challenges/",
                $name,
                "/measurements.csv"
            )),
            sealed_test: include_str!(concat!(
                "../../../validation/challenges/",
                $name,
                "/sealed.toml"
            )),
            sealed: include_str!(concat!(
                "../../../validation/challenges/",
                $name,
                "/sealed.csv"
            )),
            truth: include_str!(concat!(
                "../../../validation/challenges/",
                $name,
                "/truth.json"
            )),
        }
    };
}

const FILES: [Files; 2] = [files!("none_L2"), files!("running_in_L1")];

/// Why a challenge could not be compared.
#[derive(Debug, thiserror::Error)]
pub enum ChallengeError {
    /// Its study or measurements are not valid.
    #[error(transparent)]
    Text(#[from] TextError),
    /// Its answer is not.
    #[error("the answer of {name}: {source}")]
    Answer {
        /// The challenge.
        name: &'static str,
        /// Why not.
        source: serde_json::Error,
    },
    /// The answer has not one value for each measurement.
    #[error("{name} has {rows} measurements and {values} noise-free values")]
    Uneven {
        /// The challenge.
        name: &'static str,
        /// Rows.
        rows: usize,
        /// Values.
        values: usize,
    },
    /// It needs what is not compared here.
    #[error("{name}: {what} is not compared here")]
    NotCompared {
        /// The challenge.
        name: &'static str,
        /// The effect or quantity.
        what: String,
    },
    /// The model could not be run.
    #[error(transparent)]
    Forward(#[from] ForwardError),
}

impl Challenge {
    /// Every challenge of the repository.
    ///
    /// # Errors
    /// [`ChallengeError`] if its files do not fit together.
    pub fn all() -> Result<Vec<Self>, ChallengeError> {
        FILES.iter().map(Self::read).collect()
    }

    fn read(files: &Files) -> Result<Self, ChallengeError> {
        let name = files.name;
        let study = Study::parse(
            &format!("{}\n{}", files.study, files.sealed_test),
            &format!("{name}/study.toml"),
        )?;
        let known = Known::new(
            study
                .tests
                .iter()
                .map(|t| (t.id.as_str(), t.conditions.cycles)),
            [&study.gears.pinion, &study.gears.gear],
            study.gears.face_width,
        );
        let mut data = Dataset::parse(
            files.measurements,
            &format!("{name}/measurements.csv"),
            &known,
        )?;
        let Answer {
            k_true,
            effects,
            mut noise_free,
        } = serde_json::from_str(files.truth)
            .map_err(|source| ChallengeError::Answer { name, source })?;
        if noise_free.len() != data.observations.len() {
            return Err(ChallengeError::Uneven {
                name,
                rows: data.observations.len(),
                values: noise_free.len(),
            });
        }
        // the sealed test's file is noise-free itself
        let sealed = Dataset::parse(files.sealed, &format!("{name}/sealed.csv"), &known)?;
        noise_free.extend(sealed.observations.iter().map(|o| o.value));
        data.observations.extend(sealed.observations);
        Ok(Self {
            name,
            study,
            data,
            noise_free,
            coefficient: k_true,
            effects,
        })
    }

    /// The cycles of the base model that wear as much as `cycles` with the challenge's effect.
    ///
    /// # Errors
    /// [`ChallengeError::NotCompared`] for an effect other than running-in.
    pub fn base_cycles(&self, cycles: f64) -> Result<f64, ChallengeError> {
        self.effects.iter().try_fold(cycles, |sum, effect| {
            let parameter = |key: &str| effect.parameters.get(key).copied();
            match (effect.kind.as_str(), parameter("A"), parameter("n0")) {
                ("running_in", Some(a), Some(n0)) => {
                    Ok(sum + a * n0 * (1.0 - (-cycles / n0).exp()))
                }
                _ => Err(ChallengeError::NotCompared {
                    name: self.name,
                    what: format!("the effect {}", effect.kind),
                }),
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_with_a_value_too_few_is_refused() {
        let whole = &FILES[0];
        let mut truth: serde_json::Value = serde_json::from_str(whole.truth).unwrap();
        truth["noise_free"].as_array_mut().unwrap().pop();
        let text: &'static str = truth.to_string().leak();
        let short = Files {
            truth: text,
            ..*whole
        };
        let error = Challenge::read(&short).unwrap_err();
        assert!(matches!(error, ChallengeError::Uneven { rows, values, .. } if values + 1 == rows));
        assert!(Challenge::read(whole).is_ok());
    }
}
