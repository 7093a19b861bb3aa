//! A learned law in words.

use super::diagnosis::Diagnosis;
use crate::effects::variables;
use crate::learn::model_search::learned_drivers::LearnedAnswer;
use crate::learn::prediction::fidelity::Fidelity;

impl Diagnosis {
    /// With a law learned from the measurements, said beside what else there is to say.
    pub(in crate::learn) fn with_learned(mut self, learned: Option<LearnedAnswer>) -> Self {
        if let Some(learned) = &learned {
            self.reasons.push(sentence(learned));
            let add = match carries_over(learned) {
                _ if !learned.worse_tests.is_empty() => None,
                Some(true) => Some("and see the held-out error fall"),
                None => Some("and hold a test out to see whether the law carries over"),
                // it describes the fitted tests and no others
                Some(false) => None,
            };
            if let Some(why) = add {
                self.next_step = format!(
                    "gearwear add STUDY {}, {why}; or: {}",
                    learned.name, self.next_step
                );
            }
        }
        self.learned = learned;
        self
    }
}

/// Whether the law carries over to the held-out tests; None where none is held out.
fn carries_over(learned: &LearnedAnswer) -> Option<bool> {
    let [before, after] = learned.holdout_chi2_per_point?;
    Some(after < before)
}

fn sentence(learned: &LearnedAnswer) -> String {
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
    let by = match learned.decided_by {
        Fidelity::Screening => "by the analytic model",
        Fidelity::Middle | Fidelity::Full => "by finite elements",
    };
    let not = if carries_over(learned) == Some(false) {
        " It does not carry over to the held-out tests: do not add it. What acts there differs from test to test, or depends on something else."
    } else {
        ""
    };
    let worse: Vec<String> = (learned.worse_tests.iter())
        .map(|(test, [before, after])| format!("of test {test} from {before:.2} to {after:.2}"))
        .collect();
    let worse = match worse.is_empty() {
        true => String::new(),
        false => format!(
            " It raises χ² per point {}: do not add it. What acts differs from test to test, or depends on something else.",
            worse.join(", ")
        ),
    };
    let stopped = if learned.converged {
        ""
    } else {
        " Its fit did not converge: the curve is where it stopped, and may still change."
    };
    let mut others = learned.others.iter();
    // gains of another model are no measure of this one's
    let other = others.find(|other| other.decided_by == learned.decided_by);
    let next = other.map_or(String::new(), |other| {
        format!(
            "; ln evidence of the next driver that was judged so, {}, is lower by {:.0}",
            other.name.trim_start_matches("learned:"),
            learned.evidence_gain - other.evidence_gain
        )
    });
    let variable = variables::find(&learned.driver);
    let meaning = variable.map_or(String::new(), |v| format!(" ({})", v.meaning));
    format!(
        "A learned law: k times {:.2} to {:.2}{on}, following {}{meaning}, takes χ² per point from {before:.2} to {after:.2}{held} ({by}){next}.{stopped}{not}{worse}",
        least.exp(),
        most.exp(),
        learned.driver
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answer(converged: Option<bool>) -> LearnedAnswer {
        let mut document = serde_json::json!({
            "name": "learned:cycles", "acts": "wear_factor", "driver": "cycles", "unit": "-", "member": "both", "evidence_gain": 40.0,
            "knots": [0.0, 1e6], "values": [0.5, -0.5], "sigma": [0.1, 0.1], "size": 1.0, "length": 3e5, "fit_chi2_per_point": [3.0, 1.1],
            "holdout_chi2_per_point": null, "decided_by": "fem", "others": []
        });
        if let Some(converged) = converged {
            document["converged"] = converged.into();
        }
        serde_json::from_value(document).unwrap()
    }

    /// Documents that do not say whether it converged were written before that was stated.
    #[test]
    fn a_curve_that_may_still_change_is_called_so() {
        let says = "Its fit did not converge";
        assert!(!sentence(&answer(None)).contains(says));
        assert!(!sentence(&answer(Some(true))).contains(says));
        let said = sentence(&answer(Some(false)));
        assert!(said.contains(says) && said.contains("1.65"), "{said}");
    }

    #[test]
    fn a_law_that_leaves_a_test_worse_is_not_to_be_added() {
        let said = sentence(&LearnedAnswer {
            worse_tests: vec![("R1".to_owned(), [0.93, 2.44])],
            ..answer(None)
        });
        let says = "It raises χ² per point of test R1 from 0.93 to 2.44: do not add it.";
        assert!(said.contains(says), "{said}");
    }
}
