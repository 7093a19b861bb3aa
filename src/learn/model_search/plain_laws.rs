//! The curve of a learned law as a plain formula in its place.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::context::Context;
use super::law_fits::{chi2, screening_noise};
use crate::effects::Learned;
use crate::learn::candidates::fitted_candidate::FittedCandidate;
use crate::learn::fitting::fitted::Fit;
use crate::learn::learned::law::{LearnedFit, deviations};
use crate::learn::learned::plain::{self, PlainFit};
use crate::learn::learned::shape_parameter::ShapeParameter;
use crate::learn::learned::shapes::Shape;
use crate::learn::prediction::bench::Bench;
use crate::study::{Parameter, Role};

/// How many plain formulas of a curve are fitted by coarse elements.
const FORMS_CLOSELY: usize = 2;

/// A plain formula in the place of a learned law.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlainLaw {
    /// `step`, `band`, `step_in_approach`, `band_from_a_moment`: what `add --form` takes.
    pub form: String,
    /// Its parameters.
    pub parameters: Vec<PlainParameter>,
    /// ln factor on k at the law's knots, where and when it acts.
    pub values: Vec<f64>,
    /// Log evidence over the same model without it.
    pub evidence_gain: f64,
    /// χ² per point of the fit tests without it and with it.
    pub fit_chi2_per_point: [f64; 2],
    /// Of the held-out tests; None where none is held out.
    pub holdout_chi2_per_point: Option<[f64; 2]>,
    /// Whether its fit converged with no parameter on a bound.
    pub converged: bool,
    /// Its entry in a study, line by line.
    pub entry: Vec<String>,
}

/// A parameter of a plain formula.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlainParameter {
    /// Its name in the formula.
    pub name: String,
    /// Its fitted value.
    pub value: f64,
    /// Where it lies with 95 %; None on a bound.
    pub interval_95: Option<[f64; 2]>,
    /// Its unit.
    pub unit: String,
}

/// A law's curve as the plain formula, of the shapes that are meant, that has the most evidence of those near it, fitted by the model that has fitted
/// the law; of those by the analytic model the best few by coarse elements first.
pub(super) fn plain_law(
    bench: &Bench<'_>,
    context: &Context<'_>,
    known: &FittedCandidate,
    (without, best): (&Fit, &LearnedFit),
    is_meant: impl Fn(Shape) -> bool,
) -> Option<PlainLaw> {
    let noise = context.likelihood.noise;
    let (measured, version) = (context.likelihood.measured, &known.candidate.version);
    let law = &best.law.law;
    let sigma = deviations(&best.law, &best.fit);
    let curve = (law, &best.law.values[..], &sigma[..]);
    let near = plain::near(curve, measured.longest_test(), is_meant);
    let fitted = |bench, noise, form, starts: &[Vec<f64>]| {
        measured.fit_plain(bench, version, (without, noise), law, (form, starts))
    };
    let again = |bench, look: &PlainFit| {
        fitted(bench, noise, look.form, std::slice::from_ref(&look.values))
    };
    let evidence = |look: &PlainFit| look.fit.attained_evidence();
    let screening = screening_noise(context);
    let looks = near.par_iter();
    let looks = looks.filter_map(|(form, starts)| fitted(context.hertz, screening, *form, starts));
    let mut looks: Vec<PlainFit> = looks.collect();
    looks.sort_by(|a, b| evidence(b).total_cmp(&evidence(a)));
    looks.truncate(FORMS_CLOSELY);
    let looks = looks.par_iter();
    let looks: Vec<PlainFit> = looks
        .filter_map(|look| again(context.middle, look))
        .collect();
    let first = (looks.into_iter()).max_by(|a, b| evidence(a).total_cmp(&evidence(b)))?;
    let found = match std::ptr::eq(bench, context.middle) {
        true => first,
        false => again(bench, &first)?,
    };
    let change = |role| {
        Some([
            chi2(measured, without, role)?,
            chi2(measured, &found.fit, role)?,
        ])
    };
    Some(PlainLaw {
        form: found.form.name(),
        parameters: parameters(&found, law, measured.longest_test()),
        values: found.form.at_knots(law, &found.values),
        evidence_gain: found.fit.log_evidence - without.log_evidence,
        fit_chi2_per_point: change(Role::Fit)?,
        holdout_chi2_per_point: change(Role::Holdout),
        converged: found.fit.is_settled(),
        entry: std::iter::once("[[effect]]".to_owned())
            .chain(found.spec.formula_lines())
            .collect(),
    })
}

/// A shape's fitted parameters.
fn parameters(found: &PlainFit, law: &Learned, longest: f64) -> Vec<PlainParameter> {
    let of_form = found.form.parameters(law, longest);
    let all = found.spec.parameters.iter().zip(of_form);
    let own = |(p, shape): (&Parameter, ShapeParameter)| {
        let fitted = found.fit.parameters.iter().find(|own| own.name == p.name);
        PlainParameter {
            name: shape.name.to_owned(),
            value: p.value,
            interval_95: fitted.filter(|p| !p.at_bound).map(|p| p.interval),
            unit: match (shape.in_units, law.driver().name) {
                (true, "cycles") => "pinion cycles".to_owned(),
                _ if shape.name == "from" => "pinion cycles".to_owned(),
                (true, _) => law.driver().unit.to_owned(),
                (false, _) => "-".to_owned(),
            },
        }
    };
    all.map(own).collect()
}
