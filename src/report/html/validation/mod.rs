//! The pages and the document of `validate`: a summary with one line per family, and a page for each family.
mod family;
mod fold;
mod summary;

use serde::Serialize;

use crate::numeric::written::significant;

pub use family::{FamilyPage, family_pages};
pub use summary::summary;

/// One verification or validation case with its outcome.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Case {
    /// Id, as `gearwear validate CASE` takes it.
    pub id: String,
    /// Heading under which it is listed, for example `Contact`.
    pub group: String,
    /// The family of cases that it belongs to, as `gearwear validate FAMILY` takes it.
    pub family: String,
    /// What the family asks.
    #[serde(skip)]
    pub question: String,
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

impl Case {
    /// An error or a tolerance in the measure of the case, with its unit.
    fn measured(&self, value: f64) -> String {
        match self.measure.as_str() {
            "relative" => format!("{} %", significant(100.0 * value, 2)),
            "absolute" => significant(value, 2),
            unit => format!("{} {unit}", significant(value, 2)),
        }
    }

    /// Error over tolerance: how close the case is to failing. A case without either is as far as can be; one that allows nothing and
    /// misses, or whose error is no number, is worst.
    fn used(&self) -> f64 {
        match (self.error, self.tolerance) {
            (Some(error), Some(tolerance)) if tolerance > 0.0 && error.is_finite() => {
                error / tolerance
            }
            (Some(0.0), Some(_)) => 0.0,
            (Some(_), Some(_)) => f64::INFINITY,
            _ => f64::NEG_INFINITY,
        }
    }
}

/// The cases of each family, in the order in which families first occur.
fn families(cases: &[Case]) -> Vec<(&str, Vec<&Case>)> {
    let mut out: Vec<(&str, Vec<&Case>)> = Vec::new();
    for case in cases {
        match out.iter_mut().find(|(name, _)| *name == case.family) {
            Some((_, members)) => members.push(case),
            None => out.push((&case.family, vec![case])),
        }
    }
    out
}

/// The verdict of several cases: a failure outweighs all else, a pass outweighs what was not run.
fn joint_verdict<'a>(cases: impl IntoIterator<Item = &'a Case>) -> Verdict {
    let order = |verdict: Verdict| match verdict {
        Verdict::Fail => 0,
        Verdict::Pass => 1,
        Verdict::ContradictsTheory => 2,
        Verdict::Skipped => 3,
    };
    let verdicts = cases.into_iter().map(|case| case.verdict);
    verdicts
        .min_by_key(|v| order(*v))
        .unwrap_or(Verdict::Skipped)
}

/// The case that is closest to failing, or beyond.
fn closest<'a>(cases: impl IntoIterator<Item = &'a Case>) -> Option<&'a Case> {
    let ran = cases.into_iter().filter(|case| case.error.is_some());
    ran.max_by(|a, b| a.used().total_cmp(&b.used()))
}
