//! A learned law in words.

use super::diagnosis::Diagnosis;
use crate::learn::model_search::learned_drivers::LearnedAnswer;

impl Diagnosis {
    /// With a law learned from the measurements, said beside what else there is to say; `base` is χ² per point of the fit tests without it by the
    /// model that decides.
    pub(in crate::learn) fn with_learned(
        mut self,
        learned: Option<LearnedAnswer>,
        base: f64,
    ) -> Self {
        if let Some(learned) = &learned {
            self.reasons.push(said(learned, base));
            self.next_step = format!(
                "gearwear add STUDY {}, and see whether the held-out error falls; or: {}",
                learned.name, self.next_step
            );
        }
        self.learned = learned;
        self
    }
}

/// χ² per point of the deciding model, as a share of the analytic one's, below which the latter's own error is a part of what a law takes away.
const OWN_ERROR: f64 = 0.9;

fn said(learned: &LearnedAnswer, base: f64) -> String {
    let least = learned.values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = learned
        .values
        .iter()
        .copied()
        .fold(f64::NEG_INFINITY, f64::max);
    let on = match learned.member.as_str() {
        "both" => String::new(),
        member => format!(" on the {member}"),
    };
    let [before, after] = learned.fit_chi2_per_point;
    let held = match learned.holdout_chi2_per_point {
        Some([before, after]) => format!(", of the held-out tests from {before:.2} to {after:.2}"),
        None => String::new(),
    };
    let by = if base < OWN_ERROR * before {
        format!(
            "by the analytic model, whose own error is part of these figures: by finite elements χ² is {base:.2} without the law"
        )
    } else {
        "by the analytic model".to_owned()
    };
    let next = learned.others.first().map_or(String::new(), |other| {
        format!(
            "; the next driver, {}, has {:.0} less of ln evidence",
            other.name.trim_start_matches("learned:"),
            learned.evidence_gain - other.evidence_gain
        )
    });
    format!(
        "A learned law: k times {:.2} to {:.2}{on}, following {}, takes χ² per point from {before:.2} to {after:.2}{held} ({by}){next}.",
        least.exp(),
        most.exp(),
        learned.driver
    )
}
