//! A fit of `add`, in words and in its document.

use std::fmt::Write as _;
use std::path::Path;

use serde_json::{Value, json};

use super::Outcome;
use super::drafts::Draft;
use crate::learn::{Addition, Share};
use crate::report::comparison::{NO_INTERVAL, with_unit};
use crate::report::format::significant;

/// What a fit found: a value for each parameter that it was asked for, and what else it has to say.
#[derive(Debug)]
pub(super) struct Fitted {
    /// Which of the drafts.
    pub(super) draft: usize,
    /// Names and values.
    pub(super) values: Vec<(String, f64)>,
    /// Joins the command's document under `fit`.
    pub(super) json: Value,
    /// Joins the command's text; lines, the last one ended.
    pub(super) text: String,
}

/// χ² of a form over that without the effect from which its fit has not found its end.
const ASTRAY: f64 = 1.02;

/// A fit in words and in the command's document.
pub(super) fn fitted(drafts: &[Draft], addition: &Addition) -> Fitted {
    let (fit, comparison) = (&addition.compared.fit, &addition.compared.comparison);
    let chosen = drafts[addition.form].form();
    let mut text = String::new();
    for p in &comparison.parameters {
        let at_bound = if p.at_bound { ", at a bound" } else { "" };
        let known = match p.interval_95 {
            Some(ends) => {
                let [low, high] = ends.map(|end| with_unit(significant(end, 4), &p.unit));
                format!("95 % between {low} and {high}")
            }
            None if !comparison.converged => "no interval: the fit did not converge".to_owned(),
            None if comparison.fit.is_far() => {
                "no interval: the model with it is still far from the measurements".to_owned()
            }
            None => NO_INTERVAL.to_owned(),
        };
        let value = with_unit(significant(p.value, 4), &p.unit);
        let _ = writeln!(text, "  {} = {value}   {known}{at_bound}", p.name);
    }
    if let Some(share) = addition.compared.given_up {
        let _ = writeln!(
            text,
            "  given up early: the effect explains {:.0} % of what the model without it misses; it is hardly the one \
             (gearwear diagnose ranks them all)",
            100.0 * share.max(0.0)
        );
    } else if !comparison.converged {
        let why = if comparison.fit.is_within_noise() {
            "it describes the fit tests within their noise, but these hardly tell its parameters apart; set one \
             that you know (--set), or measure where they differ"
        } else {
            "these are the values where it stopped, not what the measurements ask for; another effect, or a parameter that is set (--set), may be \
             the answer"
        };
        let _ = writeln!(text, "  the fit did not converge: {why}");
    }
    let chi2 = |share: &Share| share.chi2_per_point.map(|chi2| format!("{chi2:.3}"));
    let without = addition.without_chi2_per_point;
    let without_it =
        |chi2: Option<f64>| chi2.map_or(String::new(), |chi2| format!(" (without it {chi2:.3})"));
    if let Some(chi2) = chi2(&comparison.fit) {
        let without = without_it(without);
        let _ = writeln!(text, "  chi2 per point of the fit tests: {chi2}{without}");
    }
    if let Some(chi2) = chi2(&comparison.holdout) {
        let without = without_it(addition.without_holdout_chi2_per_point);
        let _ = writeln!(
            text,
            "  chi2 per point of the held-out tests: {chi2}{without}"
        );
    }
    if addition.compared.given_up.is_none() && addition.betters_nothing() {
        let _ = writeln!(
            text,
            "  the effect betters nothing that noise would not: leave it out"
        );
    }
    // semicolons between forms: some names have commas of their own
    let tried: Vec<Value> = (drafts.iter().zip(&addition.tried))
        .filter_map(|(draft, tried)| {
            let tried = (*tried)?;
            Some(json!({
                "form": draft.form(),
                "log_evidence": tried.log_evidence,
                "chi2_per_point": tried.chi2_per_point,
            }))
        })
        .collect();
    if tried.len() > 1 {
        let each = drafts
            .iter()
            .zip(&addition.tried)
            .filter_map(|(draft, tried)| {
                let chi2 = (*tried)?.chi2_per_point?;
                // the model without the effect is one of its own cases, but for what priors cost
                let astray = without.is_some_and(|without| chi2 > ASTRAY * without);
                let note = if astray { ", did not converge" } else { "" };
                Some(format!("{} {chi2:.3}{note}", draft.form()))
            });
        let each: Vec<String> = each.collect();
        let _ = writeln!(
            text,
            "  form of the law: {chosen} (chi2 per point by form: {})",
            each.join("; ")
        );
    }
    let passed_over: Vec<&str> = (addition.passed_over.iter())
        .map(|&form| drafts[form].form())
        .collect();
    if !passed_over.is_empty() {
        let _ = writeln!(
            text,
            "  forms not fitted, as a cheaper model shows little gain: {} (--form NAME fits one)",
            passed_over.join("; ")
        );
    }
    for suspect in &comparison.sanity {
        let _ = writeln!(text, "  check first: {suspect}");
    }
    for warning in &comparison.warnings {
        let _ = writeln!(text, "  warning: {warning}");
    }
    Fitted {
        draft: addition.form,
        values: (fit.parameters.iter())
            .map(|p| (p.name.clone(), p.value))
            .collect(),
        json: json!({
            "form": chosen,
            "forms": tried,
            "forms_not_fitted": passed_over,
            "parameters": comparison.parameters,
            "fit": comparison.fit,
            "without_chi2_per_point": without,
            "without_holdout_chi2_per_point": addition.without_holdout_chi2_per_point,
            "holdout": comparison.holdout,
            "converged": comparison.converged,
            "given_up_explaining": addition.compared.given_up,
            "warnings": comparison.warnings,
        }),
        text,
    }
}

/// What the command tells.
pub(super) struct Report {
    /// Values that were set, then those fitted.
    pub(super) values: Vec<(String, f64)>,
    /// How many were set.
    pub(super) set: usize,
    pub(super) fit: Option<Value>,
    pub(super) text: String,
}

impl Report {
    pub(super) fn outcome(self, target: &Path) -> Outcome {
        let shown = target.display().to_string();
        let mut text = format!("wrote {shown}\n");
        for (name, value) in &self.values[..self.set] {
            let _ = writeln!(text, "  {name} = {value:?}");
        }
        text.push_str(&self.text);
        let _ = writeln!(text, "next: gearwear compare {shown}");
        let values: Vec<Value> = self
            .values
            .iter()
            .map(|(name, value)| json!({"name": name, "value": value}))
            .collect();
        let mut document = json!({"written": [shown], "parameters": values});
        if let Some(fit) = self.fit {
            document["fit"] = fit;
        }
        Outcome {
            json: document,
            text,
            success: true,
        }
    }
}
