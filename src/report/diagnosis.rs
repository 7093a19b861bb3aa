//! A diagnosis for people: the summary on the terminal and the page.

use std::fmt::Write as _;
use std::path::Path;

use super::comparison::with_unit;
use super::drivers;
use super::format::{count, plain, probability, significant, uncertain};
use super::html::{Cell, Page, Section, Table};
use super::learned;
use super::measured_curves;
use crate::learn::diagnose::{
    Diagnosis, Fidelity, Hypothesis, NextExperiment, NextTest, Ranked, Screened, Verdict,
};

/// Entries of the ranking shown on the terminal.
const SHOWN: usize = 6;
/// Probability from which the parameters of a rival are worth a line.
const RIVAL: f64 = 0.05;
/// Fits listed on the page.
const FITTED: usize = 20;

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
    let shown = || shown(&diagnosis.ranking).into_iter();
    let names = shown()
        .map(name)
        .chain([unknown_name(diagnosis).to_owned()]);
    let width = names.map(|n| n.chars().count()).max().unwrap_or(0).max(32) + 2;
    let decisive = diagnosis.ranking.first().map(|entry| entry.decided_by);
    let _ = writeln!(
        text,
        "\n  {:<width$}{:>12}{:>12}{:>10}{}",
        "",
        "probability",
        "χ²/point",
        "held out",
        if decisive == Some(Fidelity::Screening) {
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
            if Some(entry.decided_by) == decisive {
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
    if shown().any(|entry| is_beside_unknown(entry) && has_figures(entry)) {
        text += "  χ² of +unknown: of the effect alone, what is unknown beside it left out\n";
    }
    text += &values_of_rivals(diagnosis);
    for warning in &diagnosis.warnings {
        let _ = writeln!(text, "\nwarning: {warning}");
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

/// The first entries; the first rival without anything unknown beside it among them, for it is the one that the reasons speak of.
fn shown(ranking: &[Ranked]) -> Vec<&Ranked> {
    let mut shown: Vec<&Ranked> = ranking.iter().take(SHOWN).collect();
    let is_rival = |entry: &&Ranked| matches!(entry.effect, Hypothesis::Effects(_));
    let has_rival = shown.iter().skip(1).any(is_rival);
    let later = ranking.iter().skip(SHOWN).find(is_rival);
    if let (false, Some(rival), Some(last)) = (has_rival, later, shown.last_mut()) {
        *last = rival;
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

/// What a line was fitted by. Lines by different means have errors of their own: their χ² do not compare to the last digit.
fn means(fidelity: Fidelity) -> &'static str {
    match fidelity {
        Fidelity::Screening => "analytic contact",
        Fidelity::Middle => "coarse elements",
        Fidelity::Full => "finite elements",
    }
}

/// The same as a page, with the whole ranking; `study` is how the commands to come name the study file.
pub fn page(title: &str, diagnosis: &Diagnosis, study: &str) -> Page {
    let mut why = Section::new("Why");
    for reason in &diagnosis.reasons {
        why = why.paragraph(reason);
    }
    for warning in &diagnosis.warnings {
        why = why.note(format!("Warning: {warning}."));
    }
    let beside = !diagnosis.beside_unknown.is_empty();
    let over_unknown = |cell: Cell| beside.then_some(cell);
    let head = ["effect", "probability", "ln evidence over the base"]
        .into_iter()
        .chain(beside.then_some("over unknown"))
        .chain([
            "χ² per point",
            "held out",
            "angle",
            "parameters",
            "decided by",
        ]);
    let mut table = Table::new("", head);
    for entry in &diagnosis.ranking {
        let [fit, _] = figures(entry, 3);
        let [_, held] = figures(entry, 2);
        let angle = entry
            .angle_to_leader
            .map_or("–".to_owned(), |a| format!("{a:.0}°"));
        let gain = gain_over_unknown(diagnosis, entry).map_or("–".to_owned(), |gain| {
            // no minus before a zero
            format!("{:.1}", (10.0 * gain).round() / 10.0 + 0.0)
        });
        let first = [
            Cell::text(name(entry)),
            Cell::Bar(entry.probability, probability(entry.probability)),
            Cell::number(format!("{:.1}", entry.evidence_gain)),
        ];
        let last = [
            Cell::number(fit),
            Cell::number(held),
            Cell::number(angle),
            Cell::text(parameters(entry)),
            Cell::text(means(entry.decided_by)),
        ];
        let gain = over_unknown(Cell::number(gain));
        table = table.row(first.into_iter().chain(gain).chain(last));
    }
    if let Some(&unknown) = diagnosis.probabilities.get("unknown") {
        let dash = || Cell::number("–");
        let none = [
            dash(),
            dash(),
            dash(),
            dash(),
            Cell::text(""),
            Cell::text(""),
        ];
        let first = [
            Cell::text(unknown_name(diagnosis)),
            Cell::Bar(unknown, probability(unknown)),
        ];
        table = table.row(first.into_iter().chain(over_unknown(dash())).chain(none));
    }
    let of_unknown = if beside {
        " over unknown: ln evidence of an effect with something unknown beside it over something unknown alone; the probability of \
         these lines follows this figure, for something unknown may account for what an effect gains over the base."
    } else {
        ""
    };
    let ranking = Section::new("Ranking").table(table).note(format!(
        "χ² per point: 1 is the noise floor. ln evidence over the base: how much more probable the data are with the effect, \
         its free parameters counted against it.{of_unknown} angle: between what a line and the leading one change in these measurements, \
         k refitted; at 90° they have nothing in common, below some 10° they do the same, towards 180° the opposite. χ² of lines that were decided by other means than the first holds the \
         error of those means too.",
    ));
    let mut sections = vec![why];
    let is_established = !matches!(
        diagnosis.verdict,
        Verdict::NothingMissing | Verdict::Unknown
    );
    sections.extend(measured_curves::section(
        &diagnosis.residual_drivers,
        is_established,
    ));
    sections.extend(diagnosis.learned.as_ref().map(learned::section));
    sections.push(ranking);
    sections.extend(fitted(diagnosis));
    sections.extend(drivers::sections(diagnosis));
    let mut next =
        Section::new("What to do next").paragraph(diagnosis.next_step.replace("STUDY", study));
    if let Some(experiment) = &diagnosis.next_experiment {
        next = next
            .paragraph(experiment.why.clone())
            .table(conditions(experiment));
    }
    sections.push(next);
    Page {
        title: if title.is_empty() {
            "Diagnosis".to_owned()
        } else {
            format!("Diagnosis: {title}")
        },
        kicker: String::new(),
        conclusion: diagnosis.sentence.clone(),
        sections,
        ..Page::default()
    }
}

/// Everything that was fitted, as bars of what each explains.
fn fitted(diagnosis: &Diagnosis) -> Option<Section> {
    let attainable = diagnosis.attainable_drop;
    if diagnosis.screened.is_empty() || attainable <= 0.0 {
        return None;
    }
    let head = ["effect", "fall of χ²", "ln evidence over the base", "by"];
    let mut table = Table::new("", head);
    let drops = diagnosis.screened.iter().map(|entry| entry.chi2_drop);
    let largest = drops.fold(attainable, f64::max);
    let better = |entry: &&Screened| entry.chi2_drop > 0.0;
    let shown: Vec<&Screened> = (diagnosis.screened.iter().filter(better))
        .take(FITTED)
        .collect();
    let count = shown.len();
    for entry in shown {
        let named = if entry.form.is_empty() {
            entry.effect.to_string()
        } else {
            format!("{} ({})", entry.effect, entry.form)
        };
        table = table.row([
            Cell::text(named),
            Cell::Bar(entry.chi2_drop / largest, format!("{:.0}", entry.chi2_drop)),
            Cell::number(format!("{:.1}", entry.evidence_gain)),
            Cell::text(if entry.decided {
                "the deciding model"
            } else {
                "screening"
            }),
        ]);
    }
    let text = format!(
        "Anything smooth could bring χ² down by about {attainable:.0}. The {count} best of {} candidates; those that showed nothing in \
         the screening are left out.",
        diagnosis.screened.len()
    );
    Some(
        Section::new("What each effect explains")
            .paragraph(text)
            .table(table),
    )
}

/// The next test as a person would set it up, and those beside it.
fn conditions(experiment: &NextExperiment) -> Table {
    let direction = |test: &NextTest| {
        if test.reversed {
            "reversed"
        } else {
            "as before"
        }
    };
    let test = &experiment.test;
    let beside = experiment.further.iter().map(|test| {
        let conditions = format!(
            "{} N·m, {} rpm, misalignment {} mm, {} pinion revolutions, direction {}",
            plain(test.torque),
            plain(test.speed),
            plain(test.misalignment),
            count(test.cycles),
            direction(test)
        );
        ("to be made as well", conditions)
    });
    let together = (!experiment.further.is_empty()).then(|| {
        let chi2 = significant(experiment.together_chi2, 3);
        ("expected difference after all", chi2)
    });
    Table::of_values(
        "Conditions of the next test",
        [
            ("separates", experiment.separates.join(", ")),
            ("torque", format!("{} N·m", plain(test.torque))),
            ("speed", format!("{} rpm", plain(test.speed))),
            ("misalignment", format!("{} mm", plain(test.misalignment))),
            ("pinion revolutions", count(test.cycles)),
            ("direction", direction(test).to_owned()),
            (
                "expected difference in χ²",
                format!(
                    "{} (a repetition of the best test so far: {})",
                    significant(experiment.expected_chi2, 3),
                    significant(experiment.repetition_chi2, 3)
                ),
            ),
        ]
        .into_iter()
        .chain(beside)
        .chain(together),
    )
}

/// ln evidence of an effect beside something unknown over something unknown alone; None of what is by itself.
fn gain_over_unknown(diagnosis: &Diagnosis, entry: &Ranked) -> Option<f64> {
    let Hypothesis::EffectsAndUnknown(effects) = &entry.effect else {
        return None;
    };
    let mut all = diagnosis.beside_unknown.iter();
    all.find(|beside| beside.effects == *effects)
        .map(|beside| beside.gain_over_unknown)
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
    if entry.form.is_empty() {
        entry.effect.to_string()
    } else {
        format!("{} ({})", entry.effect, entry.form)
    }
}

fn parameters(entry: &Ranked) -> String {
    let all: Vec<String> = entry
        .parameters
        .iter()
        .map(|p| {
            let figure = match p.skewed_interval() {
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
    use crate::learn::diagnose::EffectSet;

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
}
