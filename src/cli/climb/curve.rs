//! A learned law of a climb: its curve as it was learned, and as later fits have moved it.

use serde::{Deserialize, Serialize};

use super::CliError;
use crate::effects::{Hook, Learned};
use crate::learn::WantedLaw;
use crate::learn::diagnose::LearnedAnswer;
use crate::study::LearnedLaw;

/// Values of a factor on k at knots of its driver.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Curve {
    knots: Vec<f64>,
    /// Natural logarithms of the factor.
    values: Vec<f64>,
    /// Prior standard deviation of the values.
    size: f64,
    /// Over which distance of the driver they change.
    length: f64,
}

impl Curve {
    pub(super) fn of(learned: &LearnedAnswer) -> Self {
        Self {
            knots: learned.knots.clone(),
            values: learned.values.clone(),
            size: learned.size,
            length: learned.length,
        }
    }

    /// The law of this name, moved to the coefficients that are among the fitted values.
    pub(super) fn law(&self, name: &str, fitted: &[(String, f64)]) -> Result<LearnedLaw, CliError> {
        let unusable = |why: String| CliError::Unusable(format!("{name}: {why}"));
        let hook = Hook::WearFactor;
        let wanted = WantedLaw::of_name(name, hook).map_err(|error| unusable(error.to_string()))?;
        let law = Learned::new(hook, wanted.driver.name, wanted.member, &self.knots)
            .map_err(|error| unusable(error.to_string()))?;
        let as_learned = LearnedLaw::new(law.clone(), self.values.clone(), self.size, self.length);
        let parameters = as_learned.clone().spec().parameters;
        let value = |name: &str| {
            let own = fitted.iter().find(|(fitted, _)| fitted == name);
            own.map(|(_, value)| *value)
        };
        let coefficients: Option<Vec<f64>> = parameters.iter().map(|p| value(&p.name)).collect();
        Ok(match coefficients {
            Some(coefficients) => {
                let values = as_learned.values_at(&coefficients);
                LearnedLaw::new(law, values, self.size, self.length)
            }
            None => as_learned,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve() -> Curve {
        let knots: Vec<f64> = (0..9).map(|i| 1e5 * f64::from(i)).collect();
        Curve {
            values: knots.iter().map(|n| 0.4 * (n / 2e5).sin()).collect(),
            knots,
            size: 0.7,
            length: 2e5,
        }
    }

    /// What a fit found is the law from then on, and naming it once more changes nothing.
    #[test]
    fn a_law_follows_the_coefficients_that_were_fitted() {
        let curve = curve();
        let learned = curve.law("learned:cycles", &[]).unwrap();
        assert_eq!(learned.values, curve.values);
        let fitted: Vec<(String, f64)> = (learned.clone().spec().parameters.iter())
            .map(|p| (p.name.clone(), p.value + 0.3))
            .collect();
        let moved = curve.law("learned:cycles", &fitted).unwrap();
        let most = (moved.values.iter().zip(&curve.values))
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max);
        assert!(most > 0.05, "{most}");
        for (parameter, (_, value)) in moved.spec().parameters.iter().zip(&fitted) {
            assert!((parameter.value - value).abs() < 1e-9, "{}", parameter.name);
        }
        assert!(curve.law("learned:nothing", &[]).is_err());
    }
}
