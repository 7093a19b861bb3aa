//! The page of `ladder`: the error of each version, what each step gains, parameters.
use super::page::{Page, Section};
use super::table::{Cell, Table};
use crate::learn::Improvement;
use crate::numeric::written::significant;
use crate::report::comparison::{estimate, interval};
use crate::report::ladder::{Result, beside_diagnosis, conclusion, effects, factor};
use crate::report::plots;

/// The page of a ladder.
pub fn ladder(result: &Result<'_>) -> Page {
    Page {
        title: if result.title.is_empty() {
            "Versions of the model side by side".to_owned()
        } else {
            result.title.to_owned()
        },
        kicker: format!(
            "{} versions of the model, each fitted to its measurements",
            result.steps.len()
        ),
        conclusion: conclusion(result),
        sections: vec![errors(result), parameters(result), notes(result)],
        ..Page::default()
    }
}

fn errors(result: &Result<'_>) -> Section {
    let mut table = Table::new(
        "",
        [
            "",
            "study",
            "effects",
            "against",
            "χ² fit",
            "change",
            "χ² held out",
            "change",
            "rms, µm",
            "ln evidence",
            "fit",
        ],
    );
    let number =
        |value: Option<f64>| Cell::number(value.map_or("–".to_owned(), |v| significant(v, 3)));
    for (i, step) in result.steps.iter().enumerate() {
        let gain = |of: fn(&Improvement) -> Option<f64>| {
            Cell::number(factor(step.improvement.as_ref().and_then(of)))
        };
        let evidence = step.improvement.as_ref().and_then(|i| i.log_evidence);
        table = table.row([
            Cell::number((i + 1).to_string()),
            Cell::Code(step.study.clone()),
            Cell::text(effects(step)),
            step.against
                .as_ref()
                .map_or(Cell::text(""), |before| Cell::Code(before.clone())),
            number(step.fit_chi2_per_point),
            gain(|i| i.fit_factor),
            number(step.holdout_chi2_per_point),
            gain(|i| i.holdout_factor),
            number(step.rms_um),
            Cell::number(evidence.map_or(String::new(), |e| {
                format!("{}{}", if e > 0.0 { "+" } else { "" }, significant(e, 3))
            })),
            if step.sound {
                Cell::Badge("pass", "converged".to_owned())
            } else {
                Cell::Badge("theory", "doubtful".to_owned())
            },
        ]);
    }
    Section::new("Error").plots(plots::of_ladder(result)).table(table).note(
        "χ² per point is the mean of ((model − measured)/sigma)² with each trace's most probable datum and each test's most \
         probable wear coefficient; 1 is the noise floor. An effect more always fits the fit tests at least as well; whether it \
         is true shows in the held-out tests. Nothing is fitted to these but their datums and a k of their own within the scatter between tests: they \
         judge where and when teeth wear more than how much. ln evidence: gain of the logarithm of the \
         marginal likelihood, which counts the parameters' freedom against them.",
    )
}

fn parameters(result: &Result<'_>) -> Section {
    let mut table = Table::new("", ["", "parameter", "value", "95 % from", "to", ""]);
    for (i, step) in result.steps.iter().enumerate() {
        for parameter in &step.parameters {
            let [low, high] = interval(parameter);
            table = table.row([
                Cell::number((i + 1).to_string()),
                Cell::Code(parameter.name.clone()),
                Cell::number(estimate(parameter)),
                Cell::number(low),
                Cell::number(high),
                Cell::text(if parameter.at_bound {
                    "on its bound"
                } else {
                    ""
                }),
            ]);
        }
    }
    let section = Section::new("Parameters").table(table);
    match beside_diagnosis(result) {
        Some(said) => section.note(said),
        None => section,
    }
}

/// Where each version fails worst, and what is doubtful about it.
fn notes(result: &Result<'_>) -> Section {
    let mut section = Section::new("Where each version fails worst");
    for (step, comparison) in result.steps.iter().zip(&result.comparisons) {
        section = section.paragraph(format!("`{}`: {}", step.study, comparison.worst));
        for warning in &comparison.warnings {
            section = section.paragraph(format!("`{}`: warning: {warning}.", step.study));
        }
    }
    section
}
