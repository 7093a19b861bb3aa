//! What a fit may adjust: a value, its bounds, its prior and the scale on which it moves.

use super::effect_model::Parameter;
use super::quantity;
use super::settings::Wear;
use crate::effects::{Param, ParamRole, Prior};

/// The name of the wear coefficient among the free parameters.
pub const WEAR_COEFFICIENT: &str = "wear.coefficient";

/// Prior of the wear coefficient, mm²/N: two standard deviations reach from 1e-12 to 1e-7, mild wear of metals.
pub const COEFFICIENT_PRIOR: Prior = Prior::LogNormal {
    median: 3.2e-10,
    spread: 18.0,
};

/// Bounds of the wear coefficient in fits, mm²/N.
pub const COEFFICIENT_BOUNDS: [f64; 2] = [1e-16, 1e-4];

/// One standard deviation of a formula's parameter of which nothing but a positive value is known, as a factor.
const FORMULA_SPREAD: f64 = 5.0;

/// Bounds that nobody states stand this many standard deviations from the prior's middle.
const REACH: i32 = 6;

/// Bounds of a positive parameter this far apart make its prior even in the logarithm.
const DECADES: f64 = 100.0;

/// A parameter that a fit may adjust. The bounds are finite, and the value lies between them.
#[derive(Debug, Clone, PartialEq)]
pub struct FreeParameter {
    /// `wear.coefficient`, `kind.parameter`, or `name.parameter` of a formula.
    pub name: String,
    /// Its unit, `-` if it has none.
    pub unit: &'static str,
    /// Where a fit starts: the study's value, moved inside the bounds.
    pub value: f64,
    /// Smallest value a fit may try; above 0 on the logarithmic scale.
    pub lower: f64,
    /// Largest value a fit may try.
    pub upper: f64,
    /// Its prior.
    pub prior: Prior,
    /// The value at which its effect does nothing; it may lie outside the bounds.
    pub neutral: Option<f64>,
    /// Whether a fit moves its logarithm.
    pub log_scale: bool,
    /// What else a fit has to know of it.
    pub role: ParamRole,
}

/// What is wrong with a wear coefficient (mm²/N) that does not come from a study file: what is allowed and why, in one line.
pub fn wear_coefficient_fault(value: f64) -> Option<String> {
    let known = &quantity::WEAR_COEFFICIENT;
    (!known.allows(value)).then(|| {
        let why = known.slip(value).unwrap_or(known.reason);
        format!("out of range, allowed: {known} ({why})")
    })
}

impl FreeParameter {
    /// The wear coefficient, mm²/N.
    pub fn wear_coefficient(wear: &Wear) -> Self {
        Self {
            name: WEAR_COEFFICIENT.to_owned(),
            unit: "mm2/N",
            value: (wear.coefficient).clamp(COEFFICIENT_BOUNDS[0], COEFFICIENT_BOUNDS[1]),
            lower: COEFFICIENT_BOUNDS[0],
            upper: COEFFICIENT_BOUNDS[1],
            prior: wear.prior(),
            neutral: None,
            log_scale: true,
            role: ParamRole::Plain,
        }
    }

    /// A parameter of the catalogue: its card's range and prior, narrowed by the study's bounds. A uniform prior gives way to
    /// stated bounds and is widened to a stated value.
    pub(super) fn of_card(parameter: &Parameter, param: &Param) -> Self {
        let [lower, upper] = parameter.bounds;
        let prior = match param.prior {
            Prior::Uniform { low, high } => Prior::Uniform {
                low: lower.unwrap_or(low.min(parameter.value)).max(param.range.0),
                high: upper
                    .unwrap_or(high.max(parameter.value))
                    .min(param.range.1),
            },
            other => other,
        };
        let bounds = match prior {
            Prior::Uniform { low, high } => [low, high],
            _ => [
                lower.unwrap_or(param.range.0),
                upper.unwrap_or(param.range.1),
            ],
        };
        Self {
            neutral: param.neutral,
            role: param.role,
            ..Self::new(parameter, param.unit, bounds, prior)
        }
    }

    /// A parameter of a user's formula.
    ///
    /// ```text
    /// two bounds          uniform between them; positive and two decades apart: log-normal, bounds at two deviations
    /// value > 0           log-normal about the value, factor 5 (a lower bound below 0 makes it normal)
    /// else                normal about the value, deviation the larger of 1 and twice the value
    /// ```
    /// A bound that is not stated stands six deviations away.
    pub(super) fn of_formula(parameter: &Parameter) -> Self {
        let value = parameter.value;
        let prior = match parameter.bounds {
            [Some(low), Some(high)] if low > 0.0 && high / low >= DECADES => Prior::LogNormal {
                median: (low * high).sqrt(),
                spread: (high / low).powf(0.25),
            },
            [Some(low), Some(high)] => Prior::Uniform { low, high },
            [lower, _] if value > 0.0 && lower.is_none_or(|lower| lower >= 0.0) => {
                Prior::LogNormal {
                    median: value,
                    spread: FORMULA_SPREAD,
                }
            }
            _ => Prior::Normal {
                mean: value,
                sd: (2.0 * value.abs()).max(1.0),
            },
        };
        let [lower, upper] = parameter.bounds;
        let bounds = [
            lower.unwrap_or(f64::NEG_INFINITY),
            upper.unwrap_or(f64::INFINITY),
        ];
        Self::new(parameter, "-", bounds, prior)
    }

    /// With bounds that are finite, and positive on the logarithmic scale.
    fn new(
        parameter: &Parameter,
        unit: &'static str,
        [lower, upper]: [f64; 2],
        prior: Prior,
    ) -> Self {
        let log_scale = matches!(prior, Prior::LogNormal { .. });
        let (least, most) = reach(&prior);
        let upper = if upper.is_finite() {
            upper
        } else {
            most.max(parameter.value.min(f64::MAX))
        };
        let lower = if log_scale && lower <= 0.0 {
            least.min(1e-3 * upper)
        } else if lower.is_finite() {
            lower
        } else {
            least.min(upper)
        };
        Self {
            name: parameter.name.clone(),
            unit,
            value: parameter.value.clamp(lower, upper),
            lower,
            upper,
            prior,
            neutral: None,
            log_scale,
            role: ParamRole::Plain,
        }
    }
}

/// Where a prior as good as ends.
fn reach(prior: &Prior) -> (f64, f64) {
    let far = f64::from(REACH);
    match *prior {
        Prior::LogNormal { median, spread } => {
            (median * spread.powi(-REACH), median * spread.powi(REACH))
        }
        Prior::Normal { mean, sd } => (mean - far * sd, mean + far * sd),
        Prior::HalfNormal { sd } => (0.0, far * sd),
        Prior::Uniform { low, high } => (low, high),
    }
}

#[cfg(test)]
mod tests {
    use super::super::effect_model::EffectSpec;
    use super::*;
    use crate::effects::CATALOGUE;

    fn formula(value: f64, bounds: [Option<f64>; 2]) -> FreeParameter {
        let parameter = Parameter {
            name: "x.a".into(),
            value,
            bounds,
            card: None,
            stated: true,
        };
        parameter.free()
    }

    #[test]
    fn every_fitted_parameter_of_the_catalogue_starts_inside_finite_bounds_with_a_prior() {
        for card in CATALOGUE {
            let free = EffectSpec::of_card(card, &[]).unwrap().fitted();
            assert!(!free.is_empty(), "{}", card.name);
            for p in free {
                assert!(
                    p.lower < p.upper && p.lower.is_finite() && p.upper.is_finite(),
                    "{p:?}"
                );
                assert!((p.lower..=p.upper).contains(&p.value), "{p:?}");
                assert!(!p.log_scale || p.lower > 0.0, "{p:?}");
                assert!(p.prior.log_density(p.value).is_finite(), "{p:?}");
            }
        }
    }

    #[test]
    fn the_unfitted_parameters_have_finite_bounds_too() {
        for card in CATALOGUE {
            for p in EffectSpec::of_card(card, &[]).unwrap().parameters {
                let p = p.free();
                assert!(
                    p.lower.is_finite() && p.upper.is_finite() && p.lower < p.upper,
                    "{p:?}"
                );
            }
        }
    }

    #[test]
    fn formula_parameters_have_weak_documented_priors() {
        let two = formula(1.0, [Some(0.0), Some(10.0)]);
        assert_eq!(
            two.prior,
            Prior::Uniform {
                low: 0.0,
                high: 10.0
            }
        );
        assert_eq!((two.lower, two.upper, two.log_scale), (0.0, 10.0, false));
        let wide = formula(1.0, [Some(1e-2), Some(1e2)]);
        assert_eq!(
            wide.prior,
            Prior::LogNormal {
                median: 1.0,
                spread: 10.0
            }
        );
        let bare = formula(0.2, [None, None]);
        assert_eq!(
            bare.prior,
            Prior::LogNormal {
                median: 0.2,
                spread: 5.0
            }
        );
        assert!(bare.log_scale && bare.upper == 0.2 * 15625.0, "{bare:?}");
        let zero = formula(0.0, [None, None]);
        assert_eq!((zero.lower, zero.upper, zero.log_scale), (-6.0, 6.0, false));
        let negative = formula(-3.0, [None, Some(0.0)]);
        assert_eq!(
            negative.prior,
            Prior::Normal {
                mean: -3.0,
                sd: 6.0
            }
        );
        assert_eq!((negative.lower, negative.upper), (-39.0, 0.0));
    }

    #[test]
    fn a_pair_of_materials_is_the_prior_of_k() {
        const PLASTIC: &str = include_str!("../cli/examples/plastic-steel.toml");
        let with = |new: &str| {
            let text = PLASTIC.replacen("coefficient = 2e-9 ", new, 1);
            super::super::Study::parse(&text, "study.toml")
        };
        let named = with("material = \"pom-pa66\" ").unwrap();
        let pair = crate::material::wear_pair("pom-pa66").unwrap();
        assert_eq!(named.wear.coefficient, pair.coefficient);
        let prior = Prior::LogNormal {
            median: pair.coefficient,
            spread: pair.spread,
        };
        assert_eq!(named.free()[0].prior, prior);
        // what a fit writes stands beside it and leaves the prior
        let fitted = with("coefficient = 3e-10\nmaterial = \"pom-pa66\" ").unwrap();
        assert_eq!(
            (fitted.wear.coefficient, fitted.free()[0].prior),
            (3e-10, prior)
        );
        let mut edit = named.edit();
        edit.set(WEAR_COEFFICIENT, 5e-10);
        let written = edit.finish("fitted.toml").unwrap();
        assert_eq!(
            (written.wear.coefficient, written.free()[0].prior),
            (5e-10, prior)
        );
        let plain = with("coefficient = 3e-10 ").unwrap();
        assert_eq!(plain.free()[0].prior, COEFFICIENT_PRIOR);
        let wrong = with("material = \"pom-pa6\" ").unwrap_err().to_string();
        assert!(wrong.contains("the nearest is \"pom-pa66\""), "{wrong}");
    }
}
