//! A learned law as a plain formula, fitted through the wear history in its place.
//!
//! The shapes that come nearest to the curve start there; which of them is right is judged by the evidence of their own fits, against that of the curve.

use super::law::starting_at;
use super::nearest_shape::NearShape;
use super::plain_form::{PlainForm, Within};
use super::shapes::Shape;
use crate::effects::Learned;
use crate::learn::fitting::fitted::Fit;
use crate::learn::fitting::measured::Measured;
use crate::learn::hypothesis::version::ModelVersion;
use crate::learn::inference::search::Effort;
use crate::learn::noise::NoiseModel;
use crate::learn::prediction::bench::Bench;
use crate::study::{EffectSpec, WEAR_COEFFICIENT};

/// Share of the curve's weighted sum of squares that a shape may leave to be fitted.
const LEFT: f64 = 0.6;
/// Shapes that are fitted, and of these those that are fitted in a part of the flank or of the time too.
const FITTED: usize = 3;
const IN_PARTS: usize = 2;

/// A form with the values that a fit found.
#[derive(Debug, Clone)]
pub(in crate::learn) struct PlainFit {
    /// The form.
    pub(in crate::learn) form: PlainForm,
    /// Values of its parameters, in the order of [`PlainForm::parameters`].
    pub(in crate::learn) values: Vec<f64>,
    /// The effect with its values.
    pub(in crate::learn) spec: EffectSpec,
    /// The fit.
    pub(in crate::learn) fit: Fit,
}

/// The forms whose shapes come near to a curve and `is_meant`, the nearest first, each with the values from which its fits begin.
pub(in crate::learn) fn near(
    (law, curve, sigma): (&Learned, &[f64], &[f64]),
    longest: f64,
    is_meant: impl Fn(Shape) -> bool,
) -> Vec<(PlainForm, Vec<Vec<f64>>)> {
    let shapes = Shape::ALL.into_iter();
    let shapes = shapes.filter(|&shape| PlainForm::everywhere(shape).suits(law) && is_meant(shape));
    let nearest = shapes.map(|shape| shape.nearest(law, curve, sigma));
    let mut near: Vec<NearShape> = nearest.filter(|near| near.left < LEFT).collect();
    near.sort_by(|a, b| a.left.total_cmp(&b.left));
    near.truncate(FITTED);
    let parts = |(place, near): (usize, &NearShape)| -> Vec<(PlainForm, Vec<Vec<f64>>)> {
        let own = PlainForm::all().filter(|form| form.shape == near.shape && form.suits(law));
        let own = own.filter(|form| place < IN_PARTS || form.within == Within::Everywhere);
        own.map(|form| (form, form.starts(law, near, longest)))
            .collect()
    };
    near.iter().enumerate().flat_map(parts).collect()
}

/// The formula of a form that comes nearest to a curve.
///
/// # Errors
/// Why it cannot have that form, with those that it can have.
pub(in crate::learn) fn nearest(
    (law, curve, sigma): (&Learned, &[f64], &[f64]),
    longest: f64,
    form: PlainForm,
) -> Result<EffectSpec, String> {
    let formula = form.suits(law).then(|| {
        let near = form.shape.nearest(law, curve, sigma);
        effect(
            law,
            form,
            longest,
            form.starts(law, &near, longest).first()?,
        )
    });
    formula.flatten().ok_or_else(|| {
        let allowed = PlainForm::all().filter(|form| form.suits(law));
        let allowed: Vec<String> = allowed.map(PlainForm::name).collect();
        format!(
            "its curve cannot have the form {}, allowed: {}",
            form.name(),
            allowed.join(", ")
        )
    })
}

/// A formula with the values that a fit found.
pub(in crate::learn) fn fitted(mut formula: EffectSpec, fit: &Fit) -> EffectSpec {
    for parameter in &mut formula.parameters {
        if let Some(found) = fit.parameters.iter().find(|p| p.name == parameter.name) {
            parameter.value = found.value;
        }
    }
    formula
}

/// A form as an effect of a study: a formula of its own name.
fn effect(law: &Learned, form: PlainForm, longest: f64, values: &[f64]) -> Option<EffectSpec> {
    let parameters = form.parameters(law, longest);
    let all: Vec<(&str, f64, [f64; 2])> = (parameters.iter().zip(values))
        .map(|(p, &value)| (p.name, value, [p.lower, p.upper]))
        .collect();
    let of = match law.member() {
        None => law.driver().name.to_owned(),
        Some(member) => format!("{}_{}", law.driver().name, member.name()),
    };
    let name = format!("{}_of_{of}", form.shape.name());
    EffectSpec::of_formula(&name, law.hook(), &form.formula(law, longest), &all).ok()
}

impl Measured<'_> {
    /// Cycles of the longest test.
    pub(in crate::learn) fn longest_test(&self) -> f64 {
        let cycles = self.study().tests.iter().map(|test| test.conditions.cycles);
        cycles.fold(0.0, f64::max)
    }

    /// A form fitted on a bench in the place of a learned law, beside what `without`, a fit of `version`, has. None where it cannot be fitted.
    pub(in crate::learn) fn fit_plain(
        &self,
        bench: &Bench<'_>,
        version: &ModelVersion,
        (without, noise): (&Fit, NoiseModel),
        law: &Learned,
        (form, starts): (PlainForm, &[Vec<f64>]),
    ) -> Option<PlainFit> {
        let spec = effect(law, form, self.longest_test(), starts.first()?)?;
        let version = starting_at(version, without).with(spec.clone());
        let free = version.free.iter();
        let free = free.filter(|free| free.name != WEAR_COEFFICIENT);
        let known: Vec<f64> = free.map(|free| free.value).collect();
        let known = &known[..known.len() - spec.parameters.len()];
        let starts: Vec<Vec<f64>> = starts.iter().map(|own| [known, own].concat()).collect();
        let effort = Effort {
            settle: 0,
            ..Effort::for_simulations()
        };
        let fit = (self.fit(bench, &version, noise, &starts, &effort, &|_| {})).ok()?;
        let spec = fitted(spec, &fit);
        Some(PlainFit {
            form,
            values: spec.parameters.iter().map(|p| p.value).collect(),
            spec,
            fit,
        })
    }
}
