//! A fit of `add`, in words and in its document.

use std::fmt::Write as _;
use std::path::Path;

use serde_json::{Value, json};

use super::Outcome;
use super::drafts::Draft;
use crate::learn::{Addition, Comparison, FormFit, ParameterRecord, Share};
use crate::numeric::written::significant;
use crate::report::comparison::{NO_INTERVAL, with_unit};

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
///
/// `besides`: what a diagnosis of the same inputs finds beside the effect, where it does not speak against it.
pub(super) fn fitted(drafts: &[Draft], addition: &Addition, besides: Option<&str>) -> Fitted {
    let (fit, comparison) = (&addition.compared.fit, &addition.compared.comparison);
    let tried: Vec<(&str, FormFit)> = (drafts.iter().zip(&addition.tried))
        .filter_map(|(draft, tried)| Some((draft.form(), (*tried)?)))
        .collect();
    let passed_over: Vec<&str> = (addition.passed_over.iter())
        .map(|&form| drafts[form].form())
        .collect();
    let chosen = drafts[addition.form].form();
    let parameters = comparison.parameters.iter();
    let betters_nothing = addition.compared.given_up.is_none() && addition.betters_nothing();
    let no_hold = betters_nothing && addition.makes_agree().is_none();
    let mut lines: Vec<String> = (parameters.map(|p| parameter(p, comparison, no_hold))).collect();
    lines.extend(no_end(addition, besides));
    lines.extend(ends_early(comparison));
    lines.extend(chi2_with_and_without(addition));
    lines.extend(measured_by(addition));
    if betters_nothing {
        lines.push(said_of_nothing(addition.makes_agree()));
    }
    if tried.len() > 1 {
        lines.push(form(chosen, &tried, addition.without_chi2_per_point));
    }
    if !passed_over.is_empty() {
        lines.push(format!(
            "forms not fitted, as a cheaper model shows little gain: {} (--form NAME fits one)",
            passed_over.join("; ")
        ));
    }
    let sanity = comparison.sanity.iter();
    lines.extend(sanity.map(|suspect| format!("check first: {suspect}")));
    if !comparison.warnings.is_empty() {
        // k of the tests, say, are those of the model with it
        lines.push("of the model with the effect:".to_owned());
    }
    let warnings = comparison.warnings.iter();
    lines.extend(warnings.map(|warning| format!("  warning: {warning}")));
    let forms = tried.iter().map(|(form, tried)| {
        json!({
            "form": form,
            "log_evidence": tried.log_evidence,
            "chi2_per_point": tried.chi2_per_point,
        })
    });
    let forms: Vec<Value> = forms.collect();
    Fitted {
        draft: addition.form,
        values: (fit.parameters.iter())
            .map(|p| (p.name.clone(), p.value))
            .collect(),
        json: json!({
            "form": chosen,
            "forms": forms,
            "forms_not_fitted": passed_over,
            "parameters": comparison.parameters,
            "fit": comparison.fit,
            "without_chi2_per_point": addition.without_chi2_per_point,
            "without_holdout_chi2_per_point": addition.without_holdout_chi2_per_point,
            "holdout": comparison.holdout,
            "converged": comparison.converged,
            "given_up_explaining": addition.compared.given_up,
            "warnings": comparison.warnings,
        }),
        text: lines.iter().map(|line| format!("  {line}\n")).collect(),
    }
}

/// What is said of an effect over which χ² does not fall; `agree`: the scatter of k without it and with it, where it makes the tests agree.
fn said_of_nothing(agree: Option<[f64; 2]>) -> String {
    match agree {
        None => "the effect betters nothing that noise would not: leave it out".to_owned(),
        Some([without, with]) => format!(
            "χ² falls by no more than noise makes it, but k of the tests scatters by {} % in place of {} %: so few tests may agree by chance; one at \
             another condition, or one made again, tells",
            significant(100.0 * with, 2),
            significant(100.0 * without, 2)
        ),
    }
}

/// A parameter with its value and what is known of it; `no_hold`: the effect betters nothing that noise would not.
fn parameter(p: &ParameterRecord, comparison: &Comparison, no_hold: bool) -> String {
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
        None if no_hold => "no interval: the measurements do not ask for the effect".to_owned(),
        None => NO_INTERVAL.to_owned(),
    };
    let value = with_unit(significant(p.value, 4), &p.unit);
    format!("{} = {value}   {known}{at_bound}", p.name)
}

/// Why a fit did not come to an end, where it did not.
fn no_end(addition: &Addition, besides: Option<&str>) -> Option<String> {
    let comparison = &addition.compared.comparison;
    if let Some(share) = addition.compared.given_up {
        return Some(format!(
            "given up early: the effect explains {:.0} % of what the model without it misses; {}",
            100.0 * share.max(0.0),
            besides.unwrap_or("it is hardly the one (gearwear diagnose ranks them all)")
        ));
    }
    if comparison.converged {
        return None;
    }
    let why = if comparison.fit.is_within_noise() {
        "it describes the fit tests within their noise, but these hardly tell its parameters apart; set one \
         that you know (--set), or measure where they differ"
    } else {
        "these are the values where it stopped, not what the measurements ask for; another effect, or a parameter that is set (--set), may be \
         the answer"
    };
    Some(format!("the fit did not converge: {why}"))
}

/// Where a fit ends as soon as what is left of it does not matter to whether the effect is the one, as `compare` and `ladder` do not.
fn ends_early(comparison: &Comparison) -> Option<String> {
    let told = comparison
        .parameters
        .iter()
        .any(|p| p.interval_95.is_some());
    (told && comparison.converged && !comparison.fit.is_within_noise()).then(|| {
        "compare and ladder fit the new study on, to the end and with finer wear steps where these matter: quote their values and intervals, which may \
         differ from these by some of the widths, for more than noise is left"
            .to_owned()
    })
}

/// χ² per point of the fit tests and of the held-out ones, beside those without the effect.
fn chi2_with_and_without(addition: &Addition) -> impl Iterator<Item = String> {
    let comparison = &addition.compared.comparison;
    let line = |tests: &str, share: &Share, without: Option<f64>| {
        let chi2 = share.chi2_per_point?;
        let without = without.map_or(String::new(), |chi2| format!(" (without it {chi2:.3})"));
        Some(format!(
            "chi2 per point of the {tests} tests: {chi2:.3}{without}"
        ))
    };
    [
        line("fit", &comparison.fit, addition.without_chi2_per_point),
        line(
            "held-out",
            &comparison.holdout,
            addition.without_holdout_chi2_per_point,
        ),
    ]
    .into_iter()
    .flatten()
}

/// In which sigmas and by which wear steps the two χ² are, and why those of other commands differ; nothing where none is told without the effect.
fn measured_by(addition: &Addition) -> Option<String> {
    addition.without_chi2_per_point.map(|_| {
        "(in the rows' own sigmas; compare may take finer wear steps (it does so without the effect), and diagnose allows for an error of the model itself: \
         their chi2 of the same model may be some per cent lower or higher)"
            .to_owned()
    })
}

/// The form that was chosen, and how those that were tried fit; `without`: χ² per point without the effect.
fn form(chosen: &str, tried: &[(&str, FormFit)], without: Option<f64>) -> String {
    let each = tried.iter().filter_map(|(form, tried)| {
        let chi2 = tried.chi2_per_point?;
        // the model without the effect is one of its own cases, but for what priors cost
        let astray = without.is_some_and(|without| chi2 > ASTRAY * without);
        let note = if astray { ", did not converge" } else { "" };
        Some(format!("{form} {chi2:.3}{note}"))
    });
    let each: Vec<String> = each.collect();
    // semicolons between forms: some names have commas of their own
    format!(
        "form of the law: {chosen} (chi2 per point by form: {})",
        each.join("; ")
    )
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

#[cfg(test)]
mod tests {
    use super::said_of_nothing;

    /// Three weighed tests, two at one speed: an effect of the speed leaves χ² where it was and takes the scatter of k from 34 to 7 %.
    #[test]
    fn an_effect_that_makes_the_tests_agree_is_not_to_be_left_out() {
        assert!(said_of_nothing(None).ends_with("leave it out"));
        let said = said_of_nothing(Some([0.342, 0.074]));
        assert!(
            said.contains("scatters by 7.4 % in place of 34 %"),
            "{said}"
        );
    }
}
