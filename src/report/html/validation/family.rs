//! A page for each family of cases: what it asks, against what, and every figure.
use super::fold::{Line, conditions, fold};
use super::{Case, families};
use crate::numeric::written::plain;
use crate::report::html::{Cell, Page, Section, Table, Verdict};

/// The page of one family.
#[derive(Debug, Clone, PartialEq)]
pub struct FamilyPage {
    /// Its files, relative to the summary and without extension: `cases/B1`.
    pub file: String,
    /// What is on it.
    pub page: Page,
}

/// The pages of all families, in the order in which families first occur.
pub fn family_pages(cases: &[Case]) -> Vec<FamilyPage> {
    let pages = families(cases)
        .into_iter()
        .map(|(name, members)| FamilyPage {
            file: file(name),
            page: page(name, &members),
        });
    pages.collect()
}

/// The files of a family's page, relative to the summary and without extension.
pub(super) fn file(family: &str) -> String {
    format!("cases/{}", family.replace('/', "-"))
}

fn page(name: &str, cases: &[&Case]) -> Page {
    let passed = cases.iter().filter(|case| case.verdict == Verdict::Pass);
    Page {
        title: name.to_owned(),
        kicker: cases.first().map_or(String::new(), |c| c.question.clone()),
        conclusion: format!(
            "{} of {} figures pass. Repeat with `gearwear validate {name}`.",
            passed.count(),
            cases.len()
        ),
        sections: vec![references(cases), figures(cases)],
        ..Page::default()
    }
}

/// Where the targets and the tolerances come from.
fn references(cases: &[&Case]) -> Section {
    let mut table = Table::new("", ["targets from", "what the tolerance allows for"]);
    let mut seen: Vec<(&str, &str)> = Vec::new();
    for case in cases {
        // the reason of a case that was not run says why, not what is allowed
        let reason = if case.tolerance.is_some() {
            case.reason.as_str()
        } else {
            ""
        };
        if !seen.contains(&(&case.source, reason)) {
            seen.push((&case.source, reason));
            let reason = if reason.is_empty() { "–" } else { reason };
            table = table.row([Cell::text(case.source.clone()), Cell::text(reason)]);
        }
    }
    Section::new("Reference").table(table)
}

fn figures(cases: &[&Case]) -> Section {
    let head = [
        "case", "what", "target", "found", "error", "allowed", "verdict",
    ];
    let lines = fold(cases);
    let mut section = Section::new("Figures");
    if lines.iter().any(|l| matches!(l, Line::Folded { .. })) {
        section = section.paragraph(
            "Where a line stands for several cases, it shows the one closest to its limit; `validation.json` holds all of them.",
        );
    }
    let table = lines
        .iter()
        .fold(Table::new("", head), |table, line| table.row(cells(line)));
    let notes = cases.iter().filter(|case| !case.note.is_empty());
    notes.fold(section.table(table), |section, case| {
        section.note(format!("`{}`: {}", case.id, case.note))
    })
}

fn cells(line: &Line) -> [Cell; 7] {
    let case = line.shown();
    let what = match line {
        Line::One(case) => case.quantity.clone(),
        Line::Folded { quantity, cases } => {
            let at = conditions(case);
            let at = if at.is_empty() {
                String::new()
            } else {
                format!(" (shown: {at})")
            };
            format!("{quantity}, {} cases{at}", cases.len())
        }
    };
    let id = match line {
        Line::One(case) => case.id.clone(),
        Line::Folded { .. } => format!("{} …", case.id),
    };
    let or_dash = |value: Option<f64>| value.map_or("–".to_owned(), plain);
    let measured = |value: Option<f64>| value.map_or("–".to_owned(), |v| case.measured(v));
    let verdict = line.verdict();
    [
        Cell::Code(id),
        Cell::text(what),
        Cell::number(or_dash(case.target)),
        Cell::number(or_dash(case.value)),
        Cell::number(measured(case.error)),
        Cell::number(measured(case.tolerance)),
        Cell::Badge(verdict.class(), verdict.word().to_owned()),
    ]
}
