//! The page and the document of `validate`.
use serde::Serialize;

use super::page::{Page, Section};
use super::table::{Cell, Table};
use crate::report::format::{plain, significant};

/// One verification or validation case with its outcome.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Case {
    /// Id, as `gearwear validate CASE` takes it.
    pub id: String,
    /// Heading under which it is listed, for example `Contact`.
    pub group: String,
    /// What is compared, in words, unit included.
    pub quantity: String,
    /// The value to be met; none where the case is a property that holds or not.
    pub target: Option<f64>,
    /// Where the target comes from.
    pub source: String,
    /// The value found; none if skipped.
    pub value: Option<f64>,
    /// Distance between value and target in the measure of `tolerance`; none if skipped.
    pub error: Option<f64>,
    /// Largest error that passes; none if skipped.
    pub tolerance: Option<f64>,
    /// What error and tolerance are: `relative` to the target, `absolute` in the unit of the quantity, or a unit.
    pub measure: String,
    /// The outcome.
    pub verdict: Verdict,
    /// Why it was skipped, why theory contradicts the target, why the tolerance is what it is; may be empty.
    pub reason: String,
    /// Time that the family of the case took, s.
    pub seconds: f64,
    /// What of the reason a reader of the page should know; may be empty.
    #[serde(skip)]
    pub note: String,
}

/// Outcome of a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Within the tolerance.
    Pass,
    /// Outside the tolerance.
    Fail,
    /// Not run.
    Skipped,
    /// The target contradicts theory: shown, but not something to be met.
    ContradictsTheory,
}

impl Verdict {
    /// The word shown.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Pass => "pass",
            Verdict::Fail => "fail",
            Verdict::Skipped => "skipped",
            Verdict::ContradictsTheory => "contradicts theory",
        }
    }

    fn class(self) -> &'static str {
        match self {
            Verdict::Pass => "pass",
            Verdict::Fail => "fail",
            Verdict::Skipped => "skipped",
            Verdict::ContradictsTheory => "theory",
        }
    }
}

/// The page; its Markdown is the text for a repository. Groups in the order in which they first occur.
pub fn validation(cases: &[Case]) -> Page {
    let number = |verdict: Verdict| cases.iter().filter(|case| case.verdict == verdict).count();
    let mut said = vec![format!(
        "{} of {} cases pass",
        number(Verdict::Pass),
        cases.len()
    )];
    for (verdict, words) in [
        (Verdict::Fail, "fail"),
        (Verdict::Skipped, "were skipped"),
        (
            Verdict::ContradictsTheory,
            "are published values that contradict theory and are not met on purpose",
        ),
    ] {
        if number(verdict) > 0 {
            said.push(format!("{} {words}", number(verdict)));
        }
    }
    let mut groups: Vec<&str> = Vec::new();
    for case in cases {
        if !groups.contains(&case.group.as_str()) {
            groups.push(&case.group);
        }
    }
    let sections = groups
        .into_iter()
        .map(|name| group(name, cases.iter().filter(|case| case.group == name)));
    Page {
        title: "Verification and validation".to_owned(),
        kicker: "Written by `gearwear validate`".to_owned(),
        conclusion: format!("{}.", said.join(", ")),
        sections: sections.collect(),
        ..Page::default()
    }
}

fn group<'a>(name: &str, cases: impl Iterator<Item = &'a Case>) -> Section {
    let head = [
        "case", "what", "target", "found", "error", "allowed", "verdict", "source",
    ];
    let mut table = Table::new("", head);
    let mut notes = Vec::new();
    for case in cases {
        let relative = case.measure == "relative";
        let shown = |value: f64| {
            if relative {
                format!("{} %", significant(100.0 * value, 2))
            } else {
                let unit = if case.measure == "absolute" {
                    ""
                } else {
                    &case.measure
                };
                format!("{} {unit}", significant(value, 2))
                    .trim_end()
                    .to_owned()
            }
        };
        let or_dash = |value: Option<f64>| value.map_or("–".to_owned(), plain);
        table = table.row([
            Cell::Code(case.id.clone()),
            Cell::text(case.quantity.clone()),
            Cell::number(or_dash(case.target)),
            Cell::number(or_dash(case.value)),
            Cell::number(case.error.map_or("–".to_owned(), shown)),
            Cell::number(case.tolerance.map_or("–".to_owned(), shown)),
            Cell::Badge(case.verdict.class(), case.verdict.word().to_owned()),
            Cell::text(case.source.clone()),
        ]);
        if !case.note.is_empty() {
            notes.push(format!("`{}`: {}", case.id, case.note));
        }
    }
    let section = Section::new(name).table(table);
    notes.into_iter().fold(section, Section::note)
}
