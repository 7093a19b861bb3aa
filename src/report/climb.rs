//! A climb for people: document, summary on the terminal, page.

use std::fmt::Write as _;
use std::path::Path;

use serde_json::{Value, json};

use super::html::{Cell, Page, Section, Table};
use super::{html, ladder};
use crate::learn::climb::ClimbStep;
use crate::learn::diagnose::{Diagnosis, Fidelity};
use crate::learn::{self, Comparison, Share, Version};
use crate::numeric::written::{capitalised, significant};

/// All that `climb` shows.
#[derive(Debug, Clone)]
pub struct Result<'a> {
    /// The study's title.
    pub title: &'a str,
    /// Everything tried, the study as it stands first.
    pub steps: &'a [ClimbStep],
    /// What was kept, each with its effects.
    pub versions: &'a [(Vec<String>, Comparison)],
    /// The effects found.
    pub effects: Vec<&'a str>,
    /// The diagnosis of the last version.
    pub diagnosis: &'a Diagnosis,
    /// Why the climb ended.
    pub stopped: &'a str,
}

/// `climb.json`.
pub fn document(result: &Result<'_>) -> Value {
    json!({
        "steps": result.steps,
        "effects": result.effects,
        "parameters": result.versions.last().map(|(_, last)| &last.parameters),
        "verdict": result.diagnosis.verdict,
        "remainder": result.diagnosis.remainder,
        "next_experiment": result.diagnosis.next_experiment,
        "stopped": result.stopped,
    })
}

/// Steps, what was found, what remains, what to do next; `study` is where the climbed study stands.
pub fn summary(result: &Result<'_>, study: &str, folder: &Path) -> String {
    let mut text = String::new();
    if !result.title.is_empty() {
        let _ = writeln!(text, "{}\n", result.title);
    }
    let _ = writeln!(text, "{}\n", conclusion(result));
    let names: Vec<String> = result.steps.iter().map(name).collect();
    let longest = names.iter().map(|name| name.chars().count()).max();
    let width = longest.unwrap_or(0).max(6);
    let _ = writeln!(
        text,
        "  {:<width$}{:>11}{:>11}{:>13}",
        "step",
        "fit chi2",
        error_name(result),
        "ln evidence"
    );
    for (name, step) in names.iter().zip(result.steps) {
        let _ = writeln!(
            text,
            "  {name:<width$}{:>11}{:>11}{:>13}{}",
            number(step.fit_chi2_per_point),
            number(step.holdout_chi2_per_point.or(step.left_out_chi2_per_point)),
            gain(step),
            match (&step.why, &step.choice) {
                (Some(why), _) => format!("  not kept: {why}"),
                (None, Some(choice)) => format!("  kept: {choice}"),
                (None, None) => String::new(),
            }
        );
    }
    let _ = writeln!(
        text,
        "  ln evidence: gained over the last version above that was kept"
    );
    let _ = writeln!(text, "\nstopped: {}", result.stopped);
    if let Some((_, last)) = result.versions.last() {
        for parameter in &last.parameters {
            let _ = writeln!(
                text,
                "  {} = {}",
                parameter.name,
                super::comparison::estimate(parameter)
            );
        }
    }
    let by = match result
        .diagnosis
        .ranking
        .first()
        .map(|entry| entry.decided_by)
    {
        Some(Fidelity::Screening) => " (by analytic contact)",
        Some(Fidelity::Middle) => " (by coarse elements; gearwear diagnose decides by fine ones)",
        _ => "",
    };
    let _ = writeln!(text, "\nof what is left{by}: {}", result.diagnosis.sentence);
    if let Some(next) = &result.diagnosis.next_experiment {
        let _ = writeln!(text, "next experiment: {}", next.why);
    }
    let _ = writeln!(
        text,
        "\nnext: {}",
        result.diagnosis.next_step.replace("STUDY", study)
    );
    let _ = writeln!(text, "study:   {study}");
    let _ = writeln!(text, "page:    {}", folder.join("report.html").display());
    let _ = writeln!(text, "figures: {}", folder.join("climb.json").display());
    text
}

/// The ladder's page with every step that was tried, and what remains; `study` is where the climbed study stands.
pub fn page(result: &Result<'_>, study: &str) -> Page {
    let names: Vec<String> = (result.versions.iter())
        .map(|(effects, _)| match &effects[..] {
            [] => "the study".to_owned(),
            effects => effects.join(" + "),
        })
        .collect();
    let versions: Vec<Version<'_>> = (result.versions.iter().zip(&names).enumerate())
        .map(|(i, ((effects, comparison), name))| Version {
            study: name,
            effects,
            comparison,
            before: i.checked_sub(1),
        })
        .collect();
    let rungs = ladder::Result {
        title: result.title,
        steps: learn::ladder(&versions),
        comparisons: versions.iter().map(|v| v.comparison).collect(),
        diagnosed: None,
        notes: vec![Vec::new(); versions.len()],
    };
    let mut page = html::ladder(&rungs);
    page.kicker = "one effect after the other, each kept only if it pays".to_owned();
    page.conclusion = conclusion(result);
    let mut table = Table::new(
        "",
        ["step", "χ² fit", "χ² not fitted to", "ln evidence", "kept"],
    );
    for step in result.steps {
        let kept = match (&step.why, &step.choice) {
            (Some(why), _) => format!("no: {why}"),
            (None, Some(choice)) => format!("yes: {choice}"),
            (None, None) => "yes".to_owned(),
        };
        table = table.row([
            Cell::text(name(step)),
            Cell::number(number(step.fit_chi2_per_point)),
            Cell::number(number(
                step.holdout_chi2_per_point.or(step.left_out_chi2_per_point),
            )),
            Cell::number(gain(step)),
            Cell::text(kept),
        ]);
    }
    let tried = Section::new("Steps").table(table).note(
        "χ² not fitted to: per point of the held-out tests or, where none is held out, of each fit test left out of the fit in turn. \
         An effect is kept if the evidence outweighs the prior odds against one more effect and this error does not rise beyond its \
         standard error, or the whole χ² by no more than 4. Effects that the diagnosis cannot tell apart are all fitted, and of those that pay the one with the least such \
         error is kept. After each step, effects that are no longer needed are taken out.",
    );
    let mut rest = Section::new("What remains")
        .paragraph(format!("The climb ended: {}.", result.stopped))
        .paragraph(result.diagnosis.sentence.clone());
    for reason in &result.diagnosis.reasons {
        rest = rest.paragraph(reason.clone());
    }
    if let Some(next) = &result.diagnosis.next_experiment {
        rest = rest.paragraph(next.why.clone());
    }
    rest = rest.paragraph(format!(
        "Next: {}",
        result.diagnosis.next_step.replace("STUDY", study)
    ));
    page.sections.insert(0, tried);
    page.sections.push(rest);
    page
}

/// What was found and what it is worth.
fn conclusion(result: &Result<'_>) -> String {
    let error = |comparison: &Comparison| {
        let of = |share: &Share, of| Some((share.chi2_per_point?, share.points, of));
        of(&comparison.holdout, "held-out tests").or(of(&comparison.fit, "the fit tests"))
    };
    let ends = [result.versions.first(), result.versions.last()];
    let [first, last] = ends.map(|end| end.and_then(|(_, comparison)| error(comparison)));
    let mut found = match &result.effects[..] {
        [] => "No effect was added.".to_owned(),
        [one] => format!("Added: {one}."),
        several => format!("Added: {}.", several.join(", ")),
    };
    for choice in result.steps.iter().filter_map(|s| s.choice.as_deref()) {
        found += &format!(" {}.", capitalised(choice));
    }
    let found = match (first, last) {
        (Some((before, points, of)), Some((after, ..))) if !result.effects.is_empty() => format!(
            "{found} χ² per point of {of} {}; 1 is the noise floor.",
            change([before, after], points)
        ),
        _ => return found,
    };
    // what chose is no longer independent
    let chose = result.steps.iter().any(|step| {
        let choice = step.choice.as_deref().unwrap_or_default();
        step.holdout_chi2_per_point.is_some()
            && choice.contains(" does best by evidence and held-out error ")
    });
    if chose {
        found
            + " The held-out tests chose between effects that look alike, so their error is no independent proof: a further test is, and gearwear plan ranks such tests for the study without the effect."
    } else {
        found
    }
}

/// How χ² per point of so many values changed, in words.
fn change([before, after]: [f64; 2], points: usize) -> String {
    let [from, to] = [before, after].map(|chi2| significant(chi2, 3));
    match (from == to, after < before) {
        (true, _) => format!("stays at {to}"),
        (_, true) => format!("falls from {from} to {to}"),
        (_, false) => {
            format!("rises from {from} to {to}, no more than {points} values do by chance")
        }
    }
}

/// A step in a line, as it is made.
pub fn step_in_words(step: &ClimbStep) -> String {
    let error = step.holdout_chi2_per_point.or(step.left_out_chi2_per_point);
    format!(
        "{}: chi2 per point {} of the fit tests, {} of tests that it was not fitted to",
        match &step.effects[..] {
            [] => "the study".to_owned(),
            effects => format!("with {}", effects.join(" + ")),
        },
        number(step.fit_chi2_per_point),
        number(error)
    )
}

fn name(step: &ClimbStep) -> String {
    match (&step.added, &step.removed) {
        (Some(added), _) => format!("with {added}"),
        (_, Some(removed)) => format!("without {removed}"),
        _ => "the study".to_owned(),
    }
}

fn error_name(result: &Result<'_>) -> &'static str {
    let left_out = result
        .steps
        .iter()
        .any(|s| s.left_out_chi2_per_point.is_some());
    if left_out { "left out" } else { "held out" }
}

fn number(value: Option<f64>) -> String {
    value.map_or("–".to_owned(), |value| significant(value, 3))
}

fn gain(step: &ClimbStep) -> String {
    step.log_evidence_gain
        .map_or("–".to_owned(), |gain| format!("{gain:+.1}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_that_rises_is_not_said_to_fall() {
        assert_eq!(change([30.9, 1.13], 200), "falls from 30.9 to 1.13");
        assert_eq!(change([1.0, 1.001], 5), "stays at 1.00");
        assert_eq!(
            change([1.0, 1.691], 5),
            "rises from 1.00 to 1.69, no more than 5 values do by chance"
        );
    }
}
