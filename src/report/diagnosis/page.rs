//! The page of a diagnosis.

use super::{NOISE_MODEL, figures, means, name, parameters, unknown_name};
use crate::learn::diagnose::{
    CHECK_FIRST, Diagnosis, Hypothesis, LawAloneEvidence, LawBesideEvidence, NextExperiment,
    NextTest, Ranked, Screened, Verdict,
};
use crate::numeric::written::{count, ended, fixed, plain, probability, significant};
use crate::report::html::{Cell, Page, Section, Table};
use crate::report::{drivers, learned, measured_curves};

/// Fits listed on the page.
const FITTED: usize = 20;

/// The diagnosis as a page, with the whole ranking; `study` is how the commands to come name the study file.
pub fn page(title: &str, diagnosis: &Diagnosis, study: &str) -> Page {
    let mut sections = vec![why(diagnosis)];
    let is_established = !matches!(
        diagnosis.verdict,
        Verdict::NothingMissing | Verdict::Unknown
    );
    sections.extend(measured_curves::section(
        &diagnosis.residual_drivers,
        is_established,
    ));
    sections.extend(diagnosis.learned.as_ref().map(learned::section));
    sections.push(ranking(diagnosis));
    sections.extend(fitted(diagnosis));
    sections.extend(drivers::sections(diagnosis));
    sections.push(next(diagnosis, study));
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

/// The reasons and the warnings.
fn why(diagnosis: &Diagnosis) -> Section {
    let mut why = Section::new("Why");
    for reason in &diagnosis.reasons {
        why = why.paragraph(reason);
    }
    for warning in &diagnosis.warnings {
        why = why.note(match warning.strip_prefix(CHECK_FIRST) {
            Some(request) => format!("Check first: {}", ended(request)),
            None => format!("Warning: {}", ended(warning)),
        });
    }
    why
}

/// All lines of the ranking with what is unknown last, and what the columns say.
fn ranking(diagnosis: &Diagnosis) -> Section {
    let head = ["effect", "probability", "ln evidence over the base"]
        .into_iter()
        .chain(over_unknown(diagnosis, "over unknown"))
        .chain([
            "χ² per point",
            "held out",
            "angle",
            "parameters",
            "decided by",
        ]);
    let entries = diagnosis.ranking.iter();
    let unknown = diagnosis.probabilities.get("unknown");
    let table = entries
        .map(|entry| ranked(diagnosis, entry))
        .chain(unknown.map(|&probability| unknown_row(diagnosis, probability)))
        .fold(Table::new("", head), Table::row);
    let of_unknown = over_unknown(
        diagnosis,
        " over unknown: ln evidence of an effect with something unknown beside it over something unknown alone; the probability of \
         these lines follows this figure, for something unknown may account for what an effect gains over the base.",
    );
    let of_pairs = (diagnosis.beside_unknown.iter())
        .filter(|beside| beside.effects.len() > 1)
        .map(|beside| {
            format!(
                " With something unknown, {} together gain {}: each has a half of what that weighs, for the other may merely follow the unknown.",
                beside.effects.in_words(),
                fixed(beside.gain_over_unknown, 1)
            )
        });
    let of_unknown = of_unknown.map_or_else(String::new, |text| {
        text.to_owned()
            + &of_pairs.collect::<String>()
            + &of_laws(&diagnosis.laws_beside)
            + &of_law_alone(diagnosis.law_alone.as_ref())
    });
    Section::new("Ranking").table(table).note(format!(
        "χ² per point: 1 is the noise floor. ln evidence over the base: how much more probable the data are with the effect, \
         its free parameters counted against it.{of_unknown} angle: between what a line and the leading one change in these measurements, \
         k refitted; at 90° they have nothing in common, below some 10° they do the same, towards 180° the opposite. χ² of lines that were decided by other means than the first holds the \
         error of those means too. {NOISE_MODEL}.",
    ))
}

/// What laws beside several effects say of them, where such were fitted.
fn of_laws(laws: &[LawBesideEvidence]) -> String {
    let each: Vec<String> = (laws.iter())
        .map(|law| {
            format!(
                "beside {} ({}) {}",
                law.effects.in_words(),
                law.law.replace('_', " "),
                fixed(law.evidence_gain, 0)
            )
        })
        .collect();
    if each.len() < 2 {
        return String::new();
    }
    format!(
        " ln evidence of the best free factor on k, over the least of these: {}; where such a factor does at least half of what something unknown does, this decides \
         between these effects, and not the figure over unknown.",
        each.join(", ")
    )
}

/// What the best law alone gains, where one was fitted.
fn of_law_alone(law: Option<&LawAloneEvidence>) -> String {
    law.map_or_else(String::new, |law| {
        format!(
            " The best factor on k alone ({}) has {} over the base: where that is more than an effect with something unknown beside it, something unknown alone takes its place.",
            law.law.replace('_', " "),
            fixed(law.evidence_gain, 0)
        )
    })
}

/// What belongs to the column over something unknown alone, where there is one: effects were tried with something unknown beside them.
fn over_unknown<T>(diagnosis: &Diagnosis, of_column: T) -> Option<T> {
    (!diagnosis.beside_unknown.is_empty()).then_some(of_column)
}

/// A line of the ranking.
fn ranked(diagnosis: &Diagnosis, entry: &Ranked) -> Vec<Cell> {
    let [fit, _] = figures(entry, 3);
    let [_, held] = figures(entry, 2);
    let angle = entry
        .angle_to_leader
        .map_or("–".to_owned(), |a| format!("{a:.0}°"));
    let gain = gain_over_unknown(diagnosis, entry).map_or("–".to_owned(), |gain| fixed(gain, 1));
    let first = [
        Cell::text(name(entry)),
        Cell::Bar(entry.probability, probability(entry.probability)),
        Cell::number(fixed(entry.evidence_gain, 1)),
    ];
    let last = [
        Cell::number(fit),
        Cell::number(held),
        Cell::number(angle),
        Cell::text(parameters(entry)),
        Cell::text(means(entry.decided_by)),
    ];
    let gain = over_unknown(diagnosis, Cell::number(gain));
    first.into_iter().chain(gain).chain(last).collect()
}

/// The line of what no effect of the catalogue does, with its probability.
fn unknown_row(diagnosis: &Diagnosis, unknown: f64) -> Vec<Cell> {
    let dash = || Cell::number("–");
    let first = [
        Cell::text(unknown_name(diagnosis)),
        Cell::Bar(unknown, probability(unknown)),
    ];
    let none = [
        dash(),
        dash(),
        dash(),
        dash(),
        Cell::text(""),
        Cell::text(""),
    ];
    let gain = over_unknown(diagnosis, dash());
    first.into_iter().chain(gain).chain(none).collect()
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

/// Everything that was fitted, as bars of what each explains.
fn fitted(diagnosis: &Diagnosis) -> Option<Section> {
    let attainable = diagnosis.attainable_drop;
    if diagnosis.screened.is_empty() || attainable <= 0.0 {
        return None;
    }
    let head = [
        "effect",
        "fall of the whole χ²",
        "ln evidence over the base",
        "by",
    ];
    let mut table = Table::new("", head);
    let drops = diagnosis.screened.iter().map(|entry| entry.attained_drop);
    let largest = drops.fold(attainable, f64::max);
    let better = |entry: &&Screened| entry.attained_drop > 0.0;
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
            Cell::Bar(
                entry.attained_drop / largest,
                format!("{:.0}", entry.attained_drop),
            ),
            Cell::number(fixed(entry.evidence_gain, 1)),
            Cell::text(match (entry.decided, entry.converged) {
                (true, true) => "the deciding model",
                (false, true) => "screening",
                (_, false) => "a first look",
            }),
        ]);
    }
    let text = format!(
        "The whole χ² is another measure than χ² per point: that of all rows together, by their whole covariance (noise, datums, the model's own error), \
         with priors left out; divided by the rows it does not give the figures of the ranking. Anything smooth could bring it down by about {attainable:.0}. The {count} best of {} candidates; those that showed nothing in \
         the screening are left out. A first look that leaves a candidate far behind is not followed to its best fit.{}",
        diagnosis.screened.len(),
        match diagnosis.attainable_by_evidence {
            true =>
                " Most of what there is to explain is that the tests differ in k: how far an effect makes them agree counts in these falls.",
            false => "",
        }
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
            "{} N·m, {} rpm, misalignment {} mm{}, {} pinion revolutions, direction {}",
            plain(test.torque),
            plain(test.speed),
            plain(test.misalignment),
            test.bulk_temperature
                .map_or(String::new(), |c| format!(", {} °C", plain(c))),
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
            (
                "conditions",
                (experiment.repeats.as_ref()).map_or("new".to_owned(), |id| {
                    format!("those of test {id}, made once more")
                }),
            ),
            ("torque", format!("{} N·m", plain(test.torque))),
            ("speed", format!("{} rpm", plain(test.speed))),
            ("misalignment", format!("{} mm", plain(test.misalignment))),
            (
                "bulk temperature",
                test.bulk_temperature
                    .map_or("not stated".to_owned(), |c| format!("{} °C", plain(c))),
            ),
            ("pinion revolutions", count(test.cycles)),
            ("on the rig", format!("{} h", significant(test.hours(), 3))),
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

fn next(diagnosis: &Diagnosis, study: &str) -> Section {
    let next =
        Section::new("What to do next").paragraph(diagnosis.next_step.replace("STUDY", study));
    match &diagnosis.next_experiment {
        Some(experiment) => next
            .paragraph(experiment.why.clone())
            .table(conditions(experiment)),
        None => next,
    }
}
