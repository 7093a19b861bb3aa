//! `kind = "learned"`: a law given by its values at knots of one driver, fitted as a sum of smooth functions.
//!
//! ```text
//! values = stated + Φ (z − z₀),    z₀ = the coefficients of the stated values in Φ
//! ```
//! Φ: the leading parts of a Gaussian process of the stated size and length at the knots ([`crate::numeric::smooth_functions`]), so that each z is
//! N(0, 1) before any measurement. At z₀ the values are the stated ones to the last bit. A factor of both members has no mean over its knots in Φ: that
//! is the wear coefficient's.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use toml::de::DeValue;

use super::effect::Result;
use super::effect_model::{EffectSpec, Law, Parameter};
use super::quantity as q;
use super::reader::Table;
use super::values::plain_number;
use crate::effects::{Hook, LARGEST_LOGARITHM, Learned, LearnedError, Param, ParamRole, Prior};
use crate::gear::Member;
use crate::numeric::smooth_functions::leading;
use crate::source_text::list;

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

/// An `[[effect]]` of this kind.
pub(super) fn read(table: &Table<'_>) -> Result<EffectSpec> {
    table.check_known(KEYS)?;
    table.name(
        "name",
        "a title of your own; results name a learned law by its driver",
    )?;
    let hooks = Learned::HOOKS.map(|hook| (hook.name(), hook));
    let Some(hook) = table.choice("acts", &hooks)? else {
        return Err(Box::new(
            table.missing("acts", &list(hooks.map(|(name, _)| name))),
        ));
    };
    let drivers = || list(Learned::drivers(hook));
    let Some(driver) = table.name("driver", "the variable that the law follows")? else {
        return Err(Box::new(table.missing("driver", &drivers())));
    };
    let members = [
        ("both", None),
        ("pinion", Some(Member::Pinion)),
        ("gear", Some(Member::Gear)),
    ];
    let member = table.choice("member", &members)?.flatten();
    let [knots, values] = [
        required(table, "knots", "numbers in the driver's unit, ascending")?,
        required(table, "values", "one number for each knot")?,
    ];
    let law = Learned::new(hook, driver, member, &knots).map_err(|error| {
        Box::new(match error {
            LearnedError::Driver { nearest, .. } => table
                .refuse(
                    "driver",
                    &format!("is nothing that {} can follow", hook.name()),
                    drivers(),
                )
                .with_hint(format!("the nearest is \"{nearest}\"")),
            LearnedError::Knots(message) => {
                let mut refusal = table.refuse(
                    "knots",
                    "",
                    "at least 2 numbers, each above the one before it",
                );
                refusal.message = format!("{}: {message}", refusal.key);
                refusal
            }
            LearnedError::Hook { .. } => table.refuse("acts", "is none of a learned law", ""),
        })
    })?;
    if values.len() != knots.len() {
        let mut refusal = table.refuse("values", "", "one value for each knot");
        refusal.message = format!(
            "{} has {} values for {} knots",
            refusal.key,
            values.len(),
            knots.len()
        );
        return Err(Box::new(refusal));
    }
    let (least, most, why) = match hook {
        Hook::WearFactor => (
            -LARGEST_LOGARITHM,
            LARGEST_LOGARITHM,
            "values are natural logarithms of the factor: 0 leaves the wear as it is",
        ),
        Hook::AddedDepth => (0.0, f64::MAX, "um per contact of that member"),
        _ => (
            f64::MIN,
            f64::MAX,
            "um of material removed before the start",
        ),
    };
    if let Some(n) = values.iter().position(|v| !(least..=most).contains(v)) {
        let mut refusal = table
            .refuse(
                "values",
                "",
                format!("{} to {}", q::Short(least), q::Short(most)),
            )
            .with_hint(why);
        refusal.message = format!("{}: value {} is {}", refusal.key, n + 1, values[n]);
        return Err(Box::new(refusal));
    }
    let positive = |key: &str, usual: f64| -> Result<f64> {
        match table.number(key, &q::ANY)? {
            Some(number) if number > 0.0 && number.is_finite() => Ok(number),
            Some(_) => Err(Box::new(table.refuse(key, "is not above 0", "above 0"))),
            None => Ok(usual),
        }
    };
    let size = positive("size", LearnedLaw::usual_size(hook))?;
    let length = positive("length", LearnedLaw::usual_length(&knots))?;
    Ok(EffectSpec {
        span: table.header(),
        ..LearnedLaw::new(law, values, size, length).spec()
    })
}

/// A list of numbers that must be there.
fn required(table: &Table<'_>, key: &str, wanted: &str) -> Result<Vec<f64>> {
    let Some((value, span)) = table.get(key) else {
        return Err(Box::new(table.missing(key, wanted)));
    };
    let wanted = format!("a list of {wanted}");
    let DeValue::Array(items) = value else {
        return Err(table.wrong_type(key, value, span, &wanted).into());
    };
    let read = |item: &toml::Spanned<DeValue<'_>>| match plain_number(item.get_ref()) {
        Some(number) if number.is_finite() => Ok(number),
        _ => Err(Box::from(table.wrong_type(
            key,
            item.get_ref(),
            item.span(),
            &wanted,
        ))),
    };
    items.iter().map(read).collect()
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
