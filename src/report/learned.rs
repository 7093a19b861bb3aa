//! A learned law as a picture.

use super::html::{Cell, Section, Table};
use super::plots::{Plot, Style};
use crate::learn::diagnose::{LearnedAnswer, plain_in_words};
use crate::numeric::written;

/// Standard deviations of the band.
const BAND: f64 = 2.0;
/// Other drivers that are listed.
const OTHERS: usize = 6;

/// The curve with its band, and the drivers that were looked at.
pub(super) fn section(learned: &LearnedAnswer) -> Section {
    let curve = |sigmas: f64| -> Vec<(f64, f64)> {
        let values = learned.values.iter().zip(&learned.sigma);
        let factors = values.map(|(value, sigma)| (value + sigmas * sigma).exp());
        learned.knots.iter().copied().zip(factors).collect()
    };
    let unit = match learned.unit.as_str() {
        "-" => String::new(),
        unit => format!(", {}", written::unit(unit)),
    };
    let on = match learned.member.as_str() {
        "both" => "both members".to_owned(),
        member => format!("the {member}"),
    };
    let plot = Plot::new(
        "learned_law",
        &format!("Factor on k of {on}, learned from the measurements"),
        &format!("{}{unit}", learned.driver),
        "factor on k",
    )
    .curve("learned", Style::Kind(0), curve(0.0))
    .curve("two standard deviations above", Style::Line(4), curve(BAND))
    .curve("and below", Style::Line(4), curve(-BAND));
    let plot = match &learned.plain {
        None => plot,
        Some(plain) => {
            let factors = plain.values.iter().map(|value| value.exp());
            let curve = learned.knots.iter().copied().zip(factors).collect();
            plot.curve(
                &format!("as the formula {}", plain.form.replace('_', " ")),
                Style::Kind(1),
                curve,
            )
        }
    }
    .logarithmic();
    let mut table = Table::new("", ["law", "ln evidence over the model without it", "by"]).row([
        Cell::text(learned.name.clone()),
        Cell::number(written::fixed(learned.evidence_gain, 1)),
        Cell::text(learned.decided_by.name()),
    ]);
    if let Some(plain) = &learned.plain {
        table = table.row([
            Cell::text(format!(
                "the same as the formula {}",
                plain.form.replace('_', " ")
            )),
            Cell::number(written::fixed(plain.evidence_gain, 1)),
            Cell::text(learned.decided_by.name()),
        ]);
    }
    for other in learned.others.iter().take(OTHERS) {
        table = table.row([
            Cell::text(other.name.clone()),
            Cell::number(written::fixed(other.evidence_gain, 1)),
            Cell::text(other.decided_by.name()),
        ]);
    }
    let section = Section::new("A law learned from the measurements")
        .paragraph(format!(
            "What nothing of the catalogue explains, as a smooth factor on k that follows one driver, fitted through the wear history; {} has the greatest \
             evidence. Drivers that go together explain each other's part: believe the one under which the held-out tests are predicted.",
            learned.driver
        ))
        .plots([plot])
        .table(table);
    let Some(plain) = &learned.plain else {
        return section;
    };
    let words = plain_in_words(plain, &learned.driver);
    let section = section.note(format!(
        "The plain formula nearest to it: {words}. As an entry of the study:"
    ));
    let lines = plain.entry.iter();
    lines.fold(section, |section, line| section.note(format!("`{line}`")))
}
