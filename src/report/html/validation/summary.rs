//! What a sceptic reads in two minutes: how much was compared with what, what is not met, and one line per family.
use super::family::file;
use super::{Case, Verdict, closest, families, joint_verdict};
use crate::report::html::{Cell, Page, Section, Table};

/// The summary; its Markdown is the text for a repository. Families under their headings, in the order in which they first occur.
pub fn summary(cases: &[Case]) -> Page {
    let mut sections = vec![kinds(cases)];
    sections.extend(unmet(cases));
    let mut groups: Vec<&str> = Vec::new();
    for case in cases {
        if !groups.contains(&case.group.as_str()) {
            groups.push(&case.group);
        }
    }
    let of = |name: &str| -> Vec<Case> {
        let members = cases.iter().filter(|case| case.group == name);
        members.cloned().collect()
    };
    sections.extend(groups.into_iter().map(|name| group(name, &of(name))));
    Page {
        title: "Verification and validation".to_owned(),
        kicker: "Written by `gearwear validate`".to_owned(),
        conclusion: conclusion(cases),
        sections,
        ..Page::default()
    }
}

fn conclusion(cases: &[Case]) -> String {
    let number = |verdict: Verdict| cases.iter().filter(|case| case.verdict == verdict).count();
    let mut parts = vec![format!(
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
            parts.push(format!("{} {words}", number(verdict)));
        }
    }
    format!("{}.", parts.join(", "))
}

/// How many figures are held against which kind of reference.
fn kinds(cases: &[Case]) -> Section {
    let mut kinds: Vec<(&str, usize, usize)> = Vec::new();
    for case in cases.iter().filter(|case| case.error.is_some()) {
        let kind = case.source.split(':').next().unwrap_or_default();
        let passed = usize::from(case.verdict == Verdict::Pass);
        match kinds.iter_mut().find(|(name, ..)| *name == kind) {
            Some((_, all, pass)) => {
                *all += 1;
                *pass += passed;
            }
            None => kinds.push((kind, 1, passed)),
        }
    }
    kinds.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(b.0)));
    let mut table = Table::new("", ["compared with", "figures", "of them pass"]);
    for (kind, all, passed) in kinds {
        table = table.row([
            Cell::text(kind),
            Cell::number(all.to_string()),
            Cell::number(passed.to_string()),
        ]);
    }
    Section::new("What the figures are compared with").table(table)
}

/// Everything that is not met or was not run, each with its reason.
fn unmet(cases: &[Case]) -> Option<Section> {
    let unmet: Vec<&Case> = (cases.iter())
        .filter(|case| case.verdict != Verdict::Pass)
        .collect();
    if unmet.is_empty() {
        return None;
    }
    let mut table = Table::new("", ["case", "what", "verdict", "why"]);
    for case in unmet {
        table = table.row([
            Cell::Code(case.id.clone()),
            Cell::text(case.quantity.clone()),
            Cell::Badge(case.verdict.class(), case.verdict.word().to_owned()),
            Cell::text(case.note.clone()),
        ]);
    }
    Some(Section::new("Not met, or not run").table(table))
}

fn group(name: &str, cases: &[Case]) -> Section {
    let head = [
        "cases",
        "question",
        "reference",
        "figures",
        "closest to its limit",
        "verdict",
    ];
    let mut table = Table::new("", head);
    for (family, members) in families(cases) {
        let mut sources: Vec<&str> = members.iter().map(|case| case.source.as_str()).collect();
        sources.dedup();
        let closest = closest(members.iter().copied());
        let limit = closest.map_or("–".to_owned(), |case| {
            let shown = |value: Option<f64>| value.map_or("–".to_owned(), |v| case.measured(v));
            format!("{} of {}", shown(case.error), shown(case.tolerance))
        });
        let verdict = joint_verdict(members.iter().copied());
        table = table.row([
            Cell::Page(family.to_owned(), file(family)),
            Cell::text(members[0].question.clone()),
            Cell::text(sources.join("; ")),
            Cell::number(members.len().to_string()),
            Cell::text(limit),
            Cell::Badge(verdict.class(), verdict.word().to_owned()),
        ]);
    }
    Section::new(name).table(table)
}
