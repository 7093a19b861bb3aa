//! A learned law in words.

use super::diagnosis::Diagnosis;
use super::laws_instead::short;
use crate::effects::variables;
use crate::learn::model_search::learned_drivers::LearnedAnswer;
use crate::learn::model_search::plain_laws::{PlainLaw, PlainParameter};
use crate::learn::prediction::fidelity::Fidelity;
use crate::numeric::written;

/// ln evidence by which a plain formula may be behind the curve to stand for it, or is ahead to be better.
const AS_GOOD: f64 = 3.0;

impl Diagnosis {
    /// With a law learned from the measurements, said beside what else there is to say.
    pub(in crate::learn) fn with_learned(mut self, learned: Option<LearnedAnswer>) -> Self {
        if let Some(learned) = &learned {
            self.reasons.push(sentence(learned));
            let plain = plain_in_its_place(learned);
            self.reasons
                .extend(plain.map(|plain| said_of_plain(learned, plain)));
            let add = match carries_over(learned) {
                _ if !learned.worse_tests.is_empty() => None,
                Some(true) => Some("and see the held-out error fall"),
                None => Some("and hold a test out to see whether the law carries over"),
                // it describes the fitted tests and no others
                Some(false) => None,
            };
            if let Some(why) = add {
                let form = plain.map_or(String::new(), |plain| format!(" --form {}", plain.form));
                self.next_step = format!(
                    "gearwear add STUDY {}{form}, {why}; or: {}",
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

/// The plain formula in a law's place where it does as well as the curve or better.
fn plain_in_its_place(learned: &LearnedAnswer) -> Option<&PlainLaw> {
    let plain = learned.plain.as_ref()?;
    let as_well = plain.evidence_gain > learned.evidence_gain - AS_GOOD && plain.converged;
    as_well.then_some(plain)
}

/// That a plain formula does as well as a law's curve, or better.
fn said_of_plain(learned: &LearnedAnswer, plain: &PlainLaw) -> String {
    let [_, after] = plain.fit_chi2_per_point;
    let held = (plain.holdout_chi2_per_point).map_or(String::new(), |[_, after]| {
        format!(", of the held-out tests {after:.2}")
    });
    let more = plain.evidence_gain - learned.evidence_gain;
    let than = match more > AS_GOOD {
        true => format!(
            "better ({more:.0} more of ln evidence; beside it the curve only rounds it off, and its band is too narrow)"
        ),
        false => "as well".to_owned(),
    };
    format!(
        "A plain formula does {than}: {}. χ² per point {after:.2}{held}.",
        plain_in_words(plain, &learned.driver)
    )
}

/// A parameter's value with its unit.
fn with_unit(parameter: &PlainParameter) -> String {
    let value = written::significant(parameter.value, 3);
    match parameter.unit.as_str() {
        "-" => value,
        unit => format!("{value} {}", written::unit(unit)),
    }
}

/// A plain formula with its values: what it is, over which values of `driver`.
pub(crate) fn plain_in_words(plain: &PlainLaw, driver: &str) -> String {
    let value = |name: &str| {
        let own = plain.parameters.iter().find(|p| p.name == name);
        own.map_or(String::new(), with_unit)
    };
    let (factor, unit) = (value("factor"), driver);
    let (shape, part) = match plain.form.split_once('_') {
        Some((shape, "in_approach")) => (shape, ", before the pitch point alone".to_owned()),
        Some((shape, "in_recess")) => (shape, ", behind the pitch point alone".to_owned()),
        Some((shape, "from_a_moment")) => (shape, format!(", from {} on", value("from"))),
        _ => (plain.form.as_str(), String::new()),
    };
    let side = match shape.starts_with("until") {
        true => "up to",
        false => "beyond",
    };
    let words = match shape {
        "step_spreading" | "until_spreading" => format!(
            "a step of {unit} that moves from {} at the start to {} at the end of the longest test, k times {factor} {side} it",
            value("at"),
            value("to")
        ),
        "band_spreading" => format!(
            "a band of {unit} about {} that widens from nothing to {} at the end of the longest test, k times {factor} in it",
            value("centre"),
            value("width")
        ),
        "step" | "until" => format!(
            "a step of {unit} at {}, k times {factor} {side} it",
            value("at")
        ),
        "band" => format!(
            "a band of {unit} about {}, {} wide, k times {factor} in it",
            value("centre"),
            value("width")
        ),
        "hump" => format!(
            "a bell of {unit} about {} with a standard deviation of {}, k times {factor} in its middle",
            value("centre"),
            value("width")
        ),
        "wave" => format!(
            "a wave of {unit} with a period of {}, k times {factor} at {} and once in every period",
            value("period"),
            value("crest")
        ),
        "decay" => format!(
            "an exponential decay of {unit}, k times {factor} at the start, falling to 1/e of the difference in {}",
            value("scale")
        ),
        "growth" => format!(
            "steady growth with {unit}, k times {factor} from one end of its range to the other"
        ),
        _ => format!("a power of {unit}, exponent {}", value("exponent")),
    };
    words + &part
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
    let meaning = variable.map_or(String::new(), |v| format!(" ({})", short(v.meaning)));
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

    /// A form whose edge moves is told with where it stands at either end of the longest test.
    #[test]
    fn a_formula_that_spreads_is_told_with_its_ends() {
        let law = |form: &str, names: &[&str]| PlainLaw {
            form: form.to_owned(),
            parameters: (names.iter().enumerate())
                .map(|(n, name)| PlainParameter {
                    name: (*name).to_owned(),
                    value: 1.5 + n as f64,
                    interval_95: None,
                    unit: "mm".to_owned(),
                })
                .collect(),
            values: Vec::new(),
            evidence_gain: 0.0,
            fit_chi2_per_point: [2.0, 1.0],
            holdout_chi2_per_point: None,
            converged: true,
            entry: Vec::new(),
        };
        let said = plain_in_words(&law("step_spreading", &["factor", "at", "to"]), "s");
        assert!(
            said.contains("from 2.50 mm at the start to 3.50 mm at the end"),
            "{said}"
        );
        let said = plain_in_words(&law("until", &["factor", "at"]), "s");
        assert!(
            said.contains("at 2.50 mm, k times 1.50 mm up to it"),
            "{said}"
        );
        let said = plain_in_words(&law("band_spreading", &["factor", "centre", "width"]), "s");
        assert!(
            said.contains("about 2.50 mm that widens from nothing to 3.50 mm"),
            "{said}"
        );
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
