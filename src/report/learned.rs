//! A learned law as a picture.

use super::html::{Cell, Section, Table};
use super::plots::{Plot, Style};
use crate::learn::diagnose::LearnedAnswer;
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
    .curve("and below", Style::Line(4), curve(-BAND))
    .logarithmic();
    let mut table = Table::new("", ["law", "ln evidence over the model without it", "by"]).row([
        Cell::text(learned.name.clone()),
        Cell::number(written::fixed(learned.evidence_gain, 1)),
        Cell::text(learned.decided_by.name()),
    ]);
    for other in learned.others.iter().take(OTHERS) {
        table = table.row([
            Cell::text(other.name.clone()),
            Cell::number(written::fixed(other.evidence_gain, 1)),
            Cell::text(other.decided_by.name()),
        ]);
    }
    Section::new("A law learned from the measurements")
        .paragraph(format!(
            "What nothing of the catalogue explains, as a smooth factor on k that follows one driver, fitted through the wear history; {} has the greatest \
             evidence. Drivers that go together explain each other's part: believe the one under which the held-out tests are predicted.",
            learned.driver
        ))
        .plots([plot])
        .table(table)
}
