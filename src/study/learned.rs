//! `kind = "learned"`: a law given by its values at knots of one driver, fitted as a sum of smooth functions.
//!
//! ```text
//! values = stated + Φ (z − z₀),    z₀ = the coefficients of the stated values in Φ
//! ```
//! Φ: the leading parts of a Gaussian process of the stated size and length at the knots ([`crate::numeric::smooth_functions`]), so that each z is
//! N(0, 1) before any measurement. At z₀ the values are the stated ones to the last bit. A factor of both members has no mean over its knots in Φ: that
//! is the wear coefficient's.

mod reading;

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

pub(super) use self::reading::read;
use super::effect_model::{EffectSpec, Law, Parameter};
use crate::effects::{Hook, Learned, Param, ParamRole, Prior};
use crate::gear::Member;
use crate::numeric::smooth_functions::leading;

/// The `kind` of a learned law.
pub(super) const KIND: &str = "learned";

pub(super) const KEYS: &[&str] = &[
    "kind", "name", "acts", "driver", "member", "knots", "values", "size", "length",
];

/// Most coefficients of one law.
const MOST: usize = 10;
/// Bounds of a coefficient, in prior standard deviations.
const REACH: f64 = 8.0;

/// What holds for each coefficient of a learned law.
static COEFFICIENT: Param = Param {
    name: "z",
    unit: "-",
    meaning: "coefficient of one smooth part of a learned law, in its prior standard deviations",
    default: 0.0,
    range: (-REACH, REACH),
    prior: Prior::Normal { mean: 0.0, sd: 1.0 },
    neutral: Some(0.0),
    fitted: true,
    role: ParamRole::SmoothPart,
};

/// A learned law with its values and what a fit takes them to be made of.
#[derive(Debug, Clone, PartialEq)]
pub struct LearnedLaw {
    /// The law.
    pub law: Learned,
    /// Values at its knots: ln factor, or µm.
    pub values: Vec<f64>,
    /// Prior standard deviation of the values, in their unit.
    pub size: f64,
    /// Distance over which the law changes, in the driver's unit.
    pub length: f64,
    parts: Arc<DMatrix<f64>>,
    start: Arc<[f64]>,
}

impl LearnedLaw {
    /// A law with its values at the knots, and the size and length of the process that a fit draws them from.
    ///
    /// # Panics
    /// If there are not as many values as knots.
    pub fn new(law: Learned, values: Vec<f64>, size: f64, length: f64) -> Self {
        assert_eq!(values.len(), law.knots().len(), "one value for each knot");
        let without_mean = law.hook() == Hook::WearFactor && law.member().is_none();
        let parts = match law.hook() {
            // depths below zero are none: no sum of parts stays clear of them
            Hook::AddedDepth => DMatrix::zeros(values.len(), 0),
            _ => leading(law.knots(), size, length, without_mean, MOST),
        };
        let start = coefficients(&parts, &values);
        Self {
            law,
            values,
            size,
            length,
            parts: Arc::new(parts),
            start: start.into(),
        }
    }

    /// The law nearest to these values that such a process can make.
    ///
    /// # Panics
    /// As [`LearnedLaw::new`].
    pub fn within(law: Learned, values: &[f64], size: f64, length: f64) -> Self {
        let near = Self::new(law.clone(), values.to_vec(), size, length);
        let bounded = near.start.iter().map(|z| z.clamp(-REACH, REACH));
        let start = DVector::from_iterator(near.start.len(), bounded);
        let made = near.parts.as_ref() * start;
        Self::new(law, made.as_slice().to_vec(), size, length)
    }

    /// Size of the process where nothing states it: a factor e, or 5 µm.
    pub fn usual_size(hook: Hook) -> f64 {
        match hook {
            Hook::Profile => 5.0,
            _ => 1.0,
        }
    }

    /// Length of the process where nothing states it: a quarter of the knots' span.
    pub fn usual_length(knots: &[f64]) -> f64 {
        match knots {
            [first, .., last] => 0.25 * (last - first),
            _ => 1.0,
        }
    }

    /// The values that belong to these coefficients, in the order of the effect's parameters.
    pub fn values_at(&self, coefficients: &[f64]) -> Vec<f64> {
        let mut values = self.values.clone();
        for (part, (z, start)) in
            (self.parts.column_iter()).zip(coefficients.iter().zip(self.start.iter()))
        {
            for (value, part) in values.iter_mut().zip(part.iter()) {
                *value += part * (z - start);
            }
        }
        values
    }

    /// Standard deviations of the values at the knots, where the coefficients have this covariance.
    pub fn deviations(&self, covariance: &DMatrix<f64>) -> Vec<f64> {
        let of_values = self.parts.as_ref() * covariance * self.parts.transpose();
        of_values
            .diagonal()
            .iter()
            .map(|v| v.max(0.0).sqrt())
            .collect()
    }

    /// As an effect of a study.
    pub fn spec(self) -> EffectSpec {
        let name = self.law.name();
        let parameters = (self.start.iter().enumerate())
            .map(|(n, &value)| Parameter {
                name: format!("{name}.{}{}", COEFFICIENT.name, n + 1),
                value,
                bounds: [None; 2],
                card: Some(&COEFFICIENT),
                stated: false,
            })
            .collect();
        EffectSpec {
            kind: KIND.to_owned(),
            name,
            law: Law::Learned(self),
            parameters,
            span: 0..0,
            freed: &[],
            idle: &[],
            even: &[],
        }
    }

    /// The lines of its entry in a study, without the header.
    pub fn lines(&self) -> Vec<String> {
        let member = self.law.member().map_or("both", Member::name);
        vec![
            format!("kind = \"{KIND}\""),
            format!("acts = \"{}\"", self.law.hook().name()),
            format!("driver = \"{}\"", self.law.driver().name),
            format!("member = \"{member}\""),
            format!("knots = {}", numbers(self.law.knots())),
            format!("values = {}", numbers(&self.values)),
            format!("size = {:?}", self.size),
            format!("length = {:?}", self.length),
        ]
    }
}

/// Numbers as TOML writes a list of them, six digits each.
pub(super) fn numbers(values: &[f64]) -> String {
    let each = values
        .iter()
        .map(|v| format!("{:?}", super::edit::rounded(*v)));
    format!("[{}]", each.collect::<Vec<_>>().join(", "))
}

/// Least squares in parts that are orthogonal to each other.
fn coefficients(parts: &DMatrix<f64>, values: &[f64]) -> Vec<f64> {
    let values = DVector::from_column_slice(values);
    parts
        .column_iter()
        .map(|part| part.dot(&values) / part.norm_squared())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law(member: Option<Member>) -> LearnedLaw {
        let knots: Vec<f64> = (0..20).map(f64::from).collect();
        let values = knots.iter().map(|x| (0.3 * x).sin() + 0.2).collect();
        let law = Learned::new(Hook::WearFactor, "depth", member, &knots).unwrap();
        LearnedLaw::new(law, values, 0.8, 4.0)
    }

    #[test]
    fn stated_values_stay_as_they_are_until_a_coefficient_moves() {
        for member in [None, Some(Member::Gear)] {
            let law = law(member);
            assert_eq!(law.values_at(&law.start), law.values);
            let mut moved = law.start.to_vec();
            moved[2] += 0.5;
            let values = law.values_at(&moved);
            // read back, they have the coefficients they were made of
            let again = LearnedLaw::new(law.law.clone(), values, 0.8, 4.0);
            for (now, wanted) in again.start.iter().zip(&moved) {
                assert!((now - wanted).abs() < 1e-9, "{now} {wanted}");
            }
        }
    }

    /// Var Σ_i z_i φ_i(x) = C(x, x) where all that matters of the process is in the parts.
    #[test]
    fn independent_coefficients_have_the_size_of_the_process() {
        let law = law(Some(Member::Pinion));
        let n = law.start.len();
        let deviations = law.deviations(&DMatrix::identity(n, n));
        for deviation in deviations {
            assert!((deviation - 0.8).abs() < 0.02, "{deviation}");
        }
    }
}
