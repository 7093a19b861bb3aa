//! A learned law in words.

use super::diagnosis::Diagnosis;
use super::wording::percent;
use crate::learn::decision::Verdict;
use crate::learn::model_search::learned_drivers::{BesideLaw, LearnedAnswer};

impl Diagnosis {
    /// With a law learned from the measurements, said beside what else there is to say.
    pub(in crate::learn) fn with_learned(mut self, learned: Option<LearnedAnswer>) -> Self {
        if let Some(learned) = &learned {
            self.reasons.push(said(learned));
            self.reasons
                .extend(learned.beside.iter().map(|own| held_against(own, learned)));
            // beside an established effect that comes first: with it in, the next diagnosis learns what is left
            if self.verdict == Verdict::Unknown {
                self.next_step = format!(
                    "gearwear add STUDY {}, and see whether the held-out error falls; or: {}",
                    learned.name, self.next_step
                );
            }
        }
        self.learned = learned;
        self
    }
}

/// An effect beside the law.
fn held_against(own: &BesideLaw, learned: &LearnedAnswer) -> String {
    format!(
        "{} alone brings {} of the fall of χ² that the law brings; once the law is in, it {} ln evidence by {:.1}.",
        own.effects.in_words(),
        percent(own.chi2_drop.max(0.0) / learned.chi2_drop),
        if own.gain_over_law > 0.0 {
            "raises"
        } else {
            "lowers"
        },
        own.gain_over_law.abs()
    )
}

fn said(learned: &LearnedAnswer) -> String {
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
        Some([before, after]) => format!(
            ", of the held-out tests from {before:.2} to {after:.2} (by the analytic model)"
        ),
        None => String::new(),
    };
    let next = learned.others.first().map_or(String::new(), |other| {
        format!(
            "; the next driver, {}, has {:.0} less of ln evidence (by the analytic model)",
            other.name.trim_start_matches("learned:"),
            learned.evidence_gain - other.evidence_gain
        )
    });
    format!(
        "A learned law: k times {:.2} to {:.2}{on}, following {}, takes χ² per point from {before:.2} to {after:.2}{held}{next}.",
        least.exp(),
        most.exp(),
        learned.driver
    )
}
