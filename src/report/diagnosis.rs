//! A diagnosis for people: the summary on the terminal and the page.

mod page;

use std::fmt::Write as _;
use std::path::Path;

pub use self::page::page;
use super::comparison::with_unit;
use crate::learn::diagnose::{CHECK_FIRST, Diagnosis, Fidelity, Hypothesis, Ranked, Verdict};
use crate::numeric::written::{probability, significant, uncertain};

/// Entries of the ranking shown on the terminal.
const SHOWN: usize = 6;
/// Probability from which the parameters of a rival are worth a line.
const RIVAL: f64 = 0.05;

/// Verdict, reasons, ranking, what to do next.
pub fn summary(title: &str, diagnosis: &Diagnosis, study: &str, folder: &Path) -> String {
    let mut text = String::new();
    if !title.is_empty() {
        let _ = writeln!(text, "{title}\n");
    }
    let _ = writeln!(text, "{}", diagnosis.sentence);
    for reason in &diagnosis.reasons {
        let _ = writeln!(text, "  {reason}");
    }
    text += &ranking(diagnosis);
    text += &values_of_rivals(diagnosis);
    for warning in &diagnosis.warnings {
        let _ = match warning.strip_prefix(CHECK_FIRST) {
            Some(question) => writeln!(text, "\n{CHECK_FIRST}{question}"),
            None => writeln!(text, "\nwarning: {warning}"),
        };
    }
    if let Some(next) = &diagnosis.next_experiment {
        let _ = writeln!(text, "\nnext experiment: {}", next.why);
    }
    let _ = writeln!(
        text,
        "\nnext: {}",
        diagnosis.next_step.replace("STUDY", study)
    );
    let _ = writeln!(text, "page:    {}", folder.join("report.html").display());
    let _ = writeln!(text, "figures: {}", folder.join("diagnosis.json").display());
    text
}

/// What the χ² of a diagnosis is measured by, beside that of other commands.
pub(crate) const NOISE_MODEL: &str = "χ²/point: in the rows' own sigmas, of fits that allow for a small error of the model itself beside the noise; compare, add and ladder fit without it, and their χ² \
     of the same model may be some per cent lower or higher, their intervals narrower";

/// The first lines of the ranking below a header, and what is unknown.
fn ranking(diagnosis: &Diagnosis) -> String {
    let mut text = String::new();
    let shown = || shown(&diagnosis.ranking).into_iter();
    let names = shown()
        .map(name)
        .chain([unknown_name(diagnosis).to_owned()]);
    let width = names.map(|n| n.chars().count()).max().unwrap_or(0).max(32) + 2;
    let common = common_means(&shown().collect::<Vec<_>>());
    let _ = writeln!(
        text,
        "\n  {:<width$}{:>12}{:>12}{:>10}{}",
        "",
        "probability",
        "χ²/point",
        "held out",
        if common == Some(Fidelity::Screening) {
            "   all by analytic contact, whose own error is in both columns"
        } else {
            ""
        }
    );
    for entry in shown() {
        let [fit, held] = figures(entry, 2);
        let _ = writeln!(
            text,
            "  {:<width$}{:>12}{:>12}{:>10}{}",
            name(entry),
            probability(entry.probability),
            fit,
            held,
            if common.is_some() {
                String::new()
            } else {
                format!("   by {}", means(entry.decided_by))
            }
        );
    }
    let unknown = diagnosis
        .probabilities
        .get("unknown")
        .copied()
        .unwrap_or(0.0);
    let _ = writeln!(
        text,
        "  {:<width$}{:>12}",
        unknown_name(diagnosis),
        probability(unknown)
    );
    if shown().any(has_figures) {
        let _ = writeln!(text, "  {NOISE_MODEL}");
    }
    if shown().any(|entry| is_beside_unknown(entry) && has_figures(entry)) {
        text += "  χ² of +unknown: of the effect alone, what is unknown beside it left out\n";
    }
    text
}

/// The first entries; the first rival without anything unknown beside it among them, for it is the one that the reasons speak of, and the base
/// model, which the others are to improve on.
fn shown(ranking: &[Ranked]) -> Vec<&Ranked> {
    let mut shown: Vec<&Ranked> = ranking.iter().take(SHOWN).collect();
    let is_rival = |entry: &&Ranked| matches!(entry.effect, Hypothesis::Effects(_));
    let has_rival = shown.iter().skip(1).any(is_rival);
    let later = ranking.iter().skip(SHOWN).find(is_rival);
    if let (false, Some(rival), Some(last)) = (has_rival, later, shown.last_mut()) {
        *last = rival;
    }
    let is_base = |entry: &&Ranked| entry.effect == Hypothesis::NothingMissing;
    if !shown.iter().any(is_base) {
        shown.extend(ranking.iter().find(is_base));
    }
    shown
}

/// The parameters of what the data cannot tell apart, a line each, where no sentence has them.
fn values_of_rivals(diagnosis: &Diagnosis) -> String {
    if diagnosis.verdict != Verdict::Ambiguous {
        return String::new();
    }
    let rivals = diagnosis.ranking.iter().take(SHOWN);
    let rivals = rivals.filter(|entry| entry.probability >= RIVAL && !entry.parameters.is_empty());
    let lines = rivals.map(|entry| format!("\n  {}: {}", name(entry), parameters(entry)));
    let lines: String = lines.collect();
    if lines.is_empty() {
        lines
    } else {
        format!("\n  with each, fitted alone:{lines}\n")
    }
}

fn is_beside_unknown(entry: &Ranked) -> bool {
    matches!(entry.effect, Hypothesis::EffectsAndUnknown(_))
}

/// Whether the χ² of a line may stand beside those of the others: an effect that has something unknown beside it is not fitted to take all that it
/// can, and by cheaper means the error of those adds to what it leaves.
fn has_figures(entry: &Ranked) -> bool {
    !is_beside_unknown(entry) || entry.decided_by == Fidelity::Full
}

/// χ² per point of a line for the fit tests and the held-out ones.
fn figures(entry: &Ranked, digits: usize) -> [String; 2] {
    [Some(entry.fit_chi2_per_point), entry.holdout_chi2_per_point].map(|chi2| {
        let chi2 = chi2.filter(|_| has_figures(entry));
        chi2.map_or("–".to_owned(), |chi2| format!("{chi2:.digits$}"))
    })
}

/// By what all lines were fitted; none where they were by different means, and each has to tell.
fn common_means(lines: &[&Ranked]) -> Option<Fidelity> {
    let first = lines.first()?.decided_by;
    lines
        .iter()
        .all(|entry| entry.decided_by == first)
        .then_some(first)
}

/// What a line was fitted by. Lines by different means have errors of their own: their χ² do not compare to the last digit.
fn means(fidelity: Fidelity) -> &'static str {
    match fidelity {
        Fidelity::Screening => "analytic contact",
        Fidelity::Middle => "coarse elements",
        Fidelity::Full => "finite elements",
    }
}

/// What holds the probability that no effect of the catalogue does.
fn unknown_name(diagnosis: &Diagnosis) -> &'static str {
    if diagnosis.undecided {
        "unknown, or the model's own error"
    } else {
        "unknown: none of the catalogue"
    }
}

fn name(entry: &Ranked) -> String {
    match (&entry.effect, &entry.form[..]) {
        (Hypothesis::NothingMissing, _) => "nothing missing: the base model".to_owned(),
        (effect, "") => effect.to_string(),
        (effect, form) => format!("{effect} ({form})"),
    }
}

fn parameters(entry: &Ranked) -> String {
    let all: Vec<String> = entry
        .parameters
        .iter()
        .map(|p| {
            let figure = match p.skewed_interval() {
                // no width that the fit does not support
                _ if !entry.converged => {
                    format!(
                        "about {} (not converged)",
                        with_unit(significant(p.value, 3), &p.unit)
                    )
                }
                // the fit has run to where the effect vanishes
                Some([low, high]) if p.value <= low => format!(
                    "{} (95 %: up to {})",
                    with_unit(significant(p.value, 3), &p.unit),
                    significant(high, 3)
                ),
                Some([low, high]) => format!(
                    "{} (95 %: {} to {})",
                    with_unit(significant(p.value, 3), &p.unit),
                    significant(low, 3),
                    significant(high, 3)
                ),
                None => with_unit(uncertain(p.value, p.sigma), &p.unit),
            };
            format!(
                "{} = {figure}{}",
                p.name,
                if p.at_bound { " (bound)" } else { "" }
            )
        })
        .collect();
    all.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::find;
    use crate::learn::diagnose::{EffectSet, ParameterValue};

    fn entry(effect: Hypothesis) -> Ranked {
        Ranked {
            effect,
            form: String::new(),
            probability: 0.1,
            evidence_gain: 0.0,
            parameters: Vec::new(),
            wear_coefficient: 1e-10,
            fit_chi2_per_point: 1.0,
            holdout_chi2_per_point: None,
            angle_to_leader: None,
            decided_by: Fidelity::Full,
            converged: true,
        }
    }

    #[test]
    fn a_header_speaks_for_lines_that_are_all_alike() {
        let by = |decided_by| Ranked {
            decided_by,
            ..entry(Hypothesis::Effects(EffectSet::new([
                find("coating").unwrap()
            ])))
        };
        let [cheap, fine] = [Fidelity::Screening, Fidelity::Full].map(by);
        assert_eq!(common_means(&[&cheap, &cheap]), Some(Fidelity::Screening));
        assert_eq!(common_means(&[&cheap, &fine]), None);
        assert_eq!(common_means(&[]), None);
    }

    #[test]
    fn a_rival_that_is_far_down_takes_the_last_line() {
        let set = |name| EffectSet::new([find(name).unwrap()]);
        let alone = |name| entry(Hypothesis::Effects(set(name)));
        let beside = |name| entry(Hypothesis::EffectsAndUnknown(set(name)));
        let names = [
            "coating",
            "tip_relief",
            "surface_layer",
            "lead_crowning",
            "oxidative",
            "running_in",
        ];
        let mut ranking = vec![alone("running_in")];
        ranking.extend(names.map(beside));
        ranking.push(alone("lubricant_ageing"));
        let last = |ranking: &[Ranked]| shown(ranking).last().unwrap().effect.to_string();
        assert_eq!(shown(&ranking).len(), SHOWN);
        assert_eq!(last(&ranking), "lubricant_ageing");
        ranking[1] = alone("coating");
        assert_eq!(last(&ranking), "oxidative+unknown");
    }

    #[test]
    fn an_interval_that_begins_at_the_value_is_a_bound() {
        let of = |low: f64| Ranked {
            parameters: vec![ParameterValue {
                name: "amount".to_owned(),
                value: 0.2,
                sigma: 4.0,
                interval_95: Some([low, 17.9]),
                unit: "um".to_owned(),
                at_bound: false,
            }],
            ..entry(Hypothesis::Effects(EffectSet::new([
                find("lead_crowning").unwrap()
            ])))
        };
        assert_eq!(parameters(&of(0.2)), "amount = 0.200 µm (95 %: up to 17.9)");
        assert!(parameters(&of(0.1)).ends_with("(95 %: 0.100 to 17.9)"));
    }

    #[test]
    fn the_base_model_stands_below_the_others_wherever_it_ranks() {
        let alone = |name| entry(Hypothesis::Effects(EffectSet::new([find(name).unwrap()])));
        let names = ["coating", "tip_relief", "surface_layer"];
        let names = names.into_iter().chain(["oxidative", "running_in"]);
        let mut ranking: Vec<Ranked> = names.map(alone).collect();
        ranking.push(alone("lubricant_ageing"));
        ranking.push(alone("film_thickness"));
        ranking.push(entry(Hypothesis::NothingMissing));
        let lines = shown(&ranking);
        assert_eq!(lines.len(), SHOWN + 1);
        assert_eq!(name(lines[SHOWN]), "nothing missing: the base model");
        // no second line of it
        let second = ranking.len() - 1;
        ranking.swap(1, second);
        assert_eq!(shown(&ranking).len(), SHOWN);
    }
}
