//! Many cases of one kind in one line: the same quantity under other conditions, asked for with the same target and tolerance.
use super::{Case, closest, joint_verdict};
use crate::report::html::Verdict;

/// As many cases of a kind as are still shown one by one.
const ONE_BY_ONE: usize = 3;

/// One line of a family's table.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Line<'a> {
    /// A single case.
    One(&'a Case),
    /// All cases of one kind.
    Folded {
        /// What is measured, without the conditions.
        quantity: &'a str,
        /// The cases.
        cases: Vec<&'a Case>,
    },
}

impl<'a> Line<'a> {
    /// The case shown: of several the one closest to failing.
    pub(super) fn shown(&self) -> &'a Case {
        match self {
            Line::One(case) => case,
            Line::Folded { cases, .. } => {
                closest(cases.iter().copied()).expect("folded cases have run")
            }
        }
    }

    /// The verdict of all.
    pub(super) fn verdict(&self) -> Verdict {
        match self {
            Line::One(case) => case.verdict,
            Line::Folded { cases, .. } => joint_verdict(cases.iter().copied()),
        }
    }
}

/// The lines of some cases, in their order; a kind stands where its first case stood. A case that failed always has a line of its own.
pub(super) fn fold<'a>(cases: &[&'a Case]) -> Vec<Line<'a>> {
    let mut kinds: Vec<(&str, Vec<&'a Case>)> = Vec::new();
    for case in cases {
        let quantity = quantity(case);
        let same = |(name, members): &&mut (&str, Vec<&Case>)| {
            let first = members[0];
            *name == quantity
                && first.target == case.target
                && first.tolerance == case.tolerance
                && (first.verdict, case.verdict) == (Verdict::Pass, Verdict::Pass)
        };
        match kinds.iter_mut().find(same) {
            Some((_, members)) => members.push(case),
            None => kinds.push((quantity, vec![case])),
        }
    }
    let lines = kinds.into_iter().flat_map(|(quantity, members)| {
        if members.len() > ONE_BY_ONE {
            vec![Line::Folded {
                quantity,
                cases: members,
            }]
        } else {
            members.into_iter().map(Line::One).collect()
        }
    });
    lines.collect()
}

/// What a case measures: the words after its conditions, which end with a colon.
fn quantity(case: &Case) -> &str {
    let words = case.quantity.as_str();
    words.rsplit_once(": ").map_or(words, |(_, what)| what)
}

/// The conditions of a case; empty if it states none.
pub(super) fn conditions(case: &Case) -> &str {
    let words = case.quantity.as_str();
    words.rsplit_once(": ").map_or("", |(at, _)| at)
}
