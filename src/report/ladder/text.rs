//! The ladder in words: the sentence at the top of its page, and the table for the terminal.
use std::path::Path;

use super::super::comparison::estimate;
use super::{Result, effects, factor};
use crate::learn::diagnose::Fidelity;
use crate::learn::{LadderStep, is_among};
use crate::numeric::written::significant;

/// The error by which a version is judged: that of the held-out tests, without any that of the fit tests.
fn judge(step: &LadderStep) -> Option<f64> {
    step.holdout_chi2_per_point.or(step.fit_chi2_per_point)
}

/// An error that falls to no less than this share of what it was has not fallen.
const NO_BETTER: f64 = 0.98;

/// χ² per point up to which held-out tests stand near the noise floor: they cannot show what an effect more would better.
const NEAR_NOISE: f64 = 1.25;

/// Gain of ln evidence from which the fit tests speak for an effect.
const CLEAR: f64 = 5.0;
/// The same from which a step whose scatter of k is smaller is not called needless.
const SOME: f64 = 1.0;

/// Share of the scatter of k between tests to which a step must bring it down to have accounted for it.
const STEADIER: f64 = 0.5;

/// What a step is that the fit tests speak for, while the held-out ones were near the noise floor before it; None of others.
fn not_judged(before: &LadderStep, after: &LadderStep) -> Option<String> {
    let evidence = after.improvement.as_ref()?.log_evidence?;
    let (fit, fit_before) = (after.fit_chi2_per_point?, before.fit_chi2_per_point?);
    let [held, held_before] = [after, before].map(|step| step.holdout_chi2_per_point);
    let (held, held_before) = (held?, held_before?);
    (evidence > CLEAR && held_before < NEAR_NOISE && held < NEAR_NOISE).then(|| {
        format!(
            "From {} to {} the error on the fit tests falls from {} to {} (ln evidence +{}), but the held-out tests were near the noise floor before ({} to {}) \
             and cannot judge that step: hold out a test in which the effect shows.",
            before.study,
            after.study,
            significant(fit_before, 3),
            significant(fit, 3),
            significant(evidence, 3),
            significant(held_before, 3),
            significant(held, 3)
        )
    })
}

/// Which version predicts best, and which steps do not help: of the versions that can be judged against the first.
pub fn conclusion(result: &Result<'_>) -> String {
    let with = result.steps.iter().zip(&result.notes);
    let steps: Vec<&LadderStep> = with
        .filter(|(_, notes)| notes.is_empty())
        .map(|(step, _)| step)
        .collect();
    let held_out = steps.iter().all(|s| s.holdout_chi2_per_point.is_some());
    let of = if held_out {
        "held-out tests"
    } else {
        "the tests it is fitted to (none is held out, so nothing here guards against fitting noise)"
    };
    let mut sentences = Vec::new();
    let alone = steps.len() < 2 && result.steps.len() > 1;
    if result.steps.len() == 1 {
        sentences.push(
            "This is one version: list the ones to compare it with after it, such as the studies that `gearwear add` wrote.".to_owned(),
        );
    }
    if !alone {
        sentences.extend(best(&steps, of));
    }
    sentences.extend(
        result
            .steps
            .iter()
            .filter_map(|after| needless(result, after)),
    );
    sentences.extend(notes(result));
    sentences.join(" ")
}

/// Which version does best on the tests that are named `of`, if one does noticeably better than the first.
fn best(steps: &[&LadderStep], of: &str) -> Option<String> {
    let first = judge(steps.first()?)?;
    let (best, least) = steps
        .iter()
        .filter_map(|step| Some((*step, judge(step)?)))
        .min_by(|a, b| a.1.total_cmp(&b.1))?;
    let with = format!("{} (effects: {})", best.study, effects(best));
    let change = if best == steps[0] {
        format!("χ² per point {}", significant(least, 3))
    } else {
        format!(
            "χ² per point {} against {} of the first version",
            significant(least, 3),
            significant(first, 3)
        )
    };
    Some(if best != steps[0] && least > NO_BETTER * first {
        format!(
            "No version does noticeably better on {of} than {}, χ² per point {}; 1 is the noise floor.",
            steps[0].study,
            significant(first, 3)
        )
    } else {
        format!("Least error on {of}: {with}, {change}; 1 is the noise floor.")
    })
}

/// That a step explains nothing new, or cannot be judged, where it is so.
fn needless(result: &Result<'_>, after: &LadderStep) -> Option<String> {
    let named = |name: &String| result.steps.iter().find(|step| step.study == *name);
    let before = after.against.as_ref().and_then(named)?;
    let (a, b) = (judge(before)?, judge(after)?);
    let falls_too_little = b > NO_BETTER * a;
    if !falls_too_little {
        return None;
    }
    if let Some(steadier) = steadier_coefficient(result, before, after) {
        return Some(steadier);
    }
    not_judged(before, after).or_else(|| {
        Some(format!(
            "From {} to {} the error on {} {} ({} to {}): {}.",
            before.study,
            after.study,
            if after.holdout_chi2_per_point.is_some() {
                "held-out tests"
            } else {
                "the fit tests"
            },
            if b < a {
                "falls by too little to count"
            } else {
                "does not fall"
            },
            significant(a, 3),
            significant(b, 3),
            match is_among(&before.effects, &after.effects) {
                true => "that step explains nothing new",
                // neither holds the other
                false => "the one explains no more than the other",
            }
        ))
    })
}

/// That a step lowers the scatter of k between tests, which each test's own k takes up before its error shows; None if it does not.
fn steadier_coefficient(
    result: &Result<'_>,
    before: &LadderStep,
    after: &LadderStep,
) -> Option<String> {
    let scatter = |of: &LadderStep| {
        let mut all = result.steps.iter().zip(&result.comparisons);
        let (_, comparison) = all.find(|(step, _)| step.study == of.study)?;
        // of one test it is the prior's
        let fitted = comparison.tests.iter().filter(|test| test.role == "fit");
        (fitted.count() > 1).then_some(comparison.coefficient_scatter)
    };
    let evidence = after.improvement.as_ref()?.log_evidence?;
    let scatters = [scatter(before)?, scatter(after)?];
    steadier_in_words([&before.study, &after.study], evidence, scatters)
}

/// The same, from the gain of ln evidence and the scatter of k in one version and the next.
fn steadier_in_words(
    [before, after]: [&str; 2],
    evidence: f64,
    [was, is]: [f64; 2],
) -> Option<String> {
    (evidence > SOME && is < STEADIER * was).then(|| {
        let so = if evidence > CLEAR {
            "the step accounts for what made them differ".to_owned()
        } else {
            format!(
                "that speaks for the step (ln evidence +{}), but so few tests may agree by chance: one more, in which the effect is stronger or weaker, would confirm it",
                significant(evidence, 2)
            )
        };
        format!(
            "From {before} to {after} the error hardly falls, since each test has a k of its own; the scatter of k between the tests falls, from {} % to {} %: {so}.",
            significant(100.0 * was, 2),
            significant(100.0 * is, 2)
        )
    })
}

/// What keeps versions from being judged against the first.
fn notes(result: &Result<'_>) -> Vec<String> {
    let first = result.steps.first().map_or("", |step| step.study.as_str());
    let with = result.steps.iter().zip(&result.notes);
    with.filter(|(_, notes)| !notes.is_empty())
        .map(|(step, notes)| {
            format!(
                "{} cannot be judged against {first} by its χ²: {}.",
                step.study,
                notes.join(", ")
            )
        })
        .collect()
}

/// Whether a version is judged against another than the line above it.
fn against_another_line(result: &Result<'_>) -> bool {
    let pairs = result.steps.windows(2);
    let other =
        |pair: &[LadderStep]| (pair[1].against.as_ref()).is_some_and(|a| *a != pair[0].study);
    pairs.into_iter().any(other)
}

/// Why its figures are not those of a diagnosis that has been made; None without one.
pub fn beside_diagnosis(result: &Result<'_>) -> Option<String> {
    let (study, fidelity) = result.diagnosed?;
    let (by, size) = match fidelity {
        Fidelity::Screening => (
            "the analytic contact model",
            "some per cent, more where a law is sharp in pressure or the teeth bend",
        ),
        Fidelity::Middle => (
            "coarse finite elements",
            "some per cent, more where a law is sharp in pressure",
        ),
        Fidelity::Full => ("finite elements like these", "some per cent"),
    };
    Some(format!(
        "The diagnosis of {study} fitted by {by} and allowed for a small error of the model itself beside the noise; here each version is fitted by its \
         study's own contact model and resolution, without that: χ² and values of the same effect that differ by {size}, and narrower intervals, are expected."
    ))
}

/// A table for the terminal, the conclusion, where the files are.
pub fn summary(result: &Result<'_>, folder: &Path) -> String {
    let mut lines = Vec::new();
    if !result.title.is_empty() {
        lines.push(result.title.to_owned());
    }
    let longest = result.steps.iter().map(|s| s.study.chars().count()).max();
    let width = longest.unwrap_or(0).max(5);
    lines.push(format!(
        "  {:<width$}{:>11}{:>9}{:>11}{:>9}{:>10}  {}",
        "study", "fit chi2", "", "held out", "", "rms µm", "effects"
    ));
    let rivals = against_another_line(result);
    let number = |value: Option<f64>| value.map_or("–".to_owned(), |v| significant(v, 3));
    for step in &result.steps {
        let gain = |of: fn(&crate::learn::Improvement) -> Option<f64>| {
            factor(step.improvement.as_ref().and_then(of))
        };
        lines.push(format!(
            "  {:<width$}{:>11}{:>9}{:>11}{:>9}{:>10}  {}{}{}",
            step.study,
            number(step.fit_chi2_per_point),
            gain(|i| i.fit_factor),
            number(step.holdout_chi2_per_point),
            gain(|i| i.holdout_factor),
            number(step.rms_um),
            effects(step),
            if step.sound { "" } else { "   (fit doubtful)" },
            match &step.against {
                Some(before) if rivals => format!("   (against {before})"),
                _ => String::new(),
            }
        ));
    }
    lines.push(String::new());
    for step in &result.steps {
        let values: Vec<String> = step
            .parameters
            .iter()
            .map(|p| format!("{} = {}", p.name, estimate(p)))
            .collect();
        lines.push(format!("  {}: {}", step.study, values.join(", ")));
    }
    lines.push(String::new());
    lines.push(conclusion(result));
    lines.extend(beside_diagnosis(result));
    for (step, comparison) in result.steps.iter().zip(&result.comparisons) {
        for warning in &comparison.warnings {
            lines.push(format!("warning: {}: {warning}", step.study));
        }
    }
    lines.push(String::new());
    lines.push(format!("page:    {}", folder.join("report.html").display()));
    lines.push(format!("figures: {}", folder.join("ladder.json").display()));
    lines.push(String::new());
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::super::Result;
    use super::{beside_diagnosis, not_judged, steadier_in_words};
    use crate::learn::diagnose::Fidelity;
    use crate::learn::{Improvement, LadderStep};

    fn step(fit: f64, held: f64, evidence: Option<f64>) -> LadderStep {
        LadderStep {
            study: "study.toml".to_owned(),
            effects: Vec::new(),
            fit_chi2_per_point: Some(fit),
            holdout_chi2_per_point: Some(held),
            rms_um: None,
            parameters: Vec::new(),
            against: None,
            improvement: evidence.map(|log_evidence| Improvement {
                fit_factor: None,
                holdout_factor: None,
                rms_factor: None,
                log_evidence: Some(log_evidence),
            }),
            sound: true,
        }
    }

    /// Whoever has a diagnosis beside the ladder reads why its figures are others.
    #[test]
    fn figures_of_a_diagnosis_may_be_others() {
        let result = |diagnosed| Result {
            title: "",
            steps: Vec::new(),
            comparisons: Vec::new(),
            diagnosed,
            notes: Vec::new(),
        };
        assert!(beside_diagnosis(&result(None)).is_none());
        let said = |by| beside_diagnosis(&result(Some(("study.toml", by)))).unwrap();
        let coarse = said(Fidelity::Middle);
        assert!(
            coarse.starts_with("The diagnosis of study.toml fitted by coarse finite elements and"),
            "{coarse}"
        );
        assert!(
            coarse.contains("more where a law is sharp in pressure"),
            "{coarse}"
        );
        assert!(!said(Fidelity::Full).contains("sharp in pressure"));
    }

    #[test]
    fn a_step_that_explains_why_k_differs_is_not_called_needless() {
        let said =
            |evidence, scatters| steadier_in_words(["base", "base+ageing"], evidence, scatters);
        let words = said(9.0, [0.35, 0.012]).unwrap();
        assert!(words.contains("from 35 % to 1.2 %"), "{words}");
        assert_eq!(said(9.0, [0.35, 0.3]), None);
        let few = said(3.4, [0.34, 0.056]).unwrap();
        assert!(
            few.contains("from 34 % to 5.6 %") && few.contains("by chance"),
            "{few}"
        );
        assert_eq!(said(1.0, [0.35, 0.012]), None);
    }

    #[test]
    fn a_held_out_test_at_the_noise_floor_judges_no_step() {
        let before = step(3.13, 1.12, None);
        let said = not_judged(&before, &step(0.95, 1.10, Some(871.0))).unwrap();
        assert!(said.contains("cannot judge that step"), "{said}");
        // a held-out error that was there and does not fall speaks against the step, as do fit tests that hardly gain
        assert!(not_judged(&step(3.13, 2.4, None), &step(0.95, 2.4, Some(871.0))).is_none());
        assert!(not_judged(&before, &step(3.12, 1.12, Some(1.0))).is_none());
    }
}
