//! What a finished diagnosis says beside the table of feasible tests, in sentences.

use super::candidate_tests::{changes, duration, strength};
use super::decided::Decided;
use super::plan::{RankedTest, Separated};
use super::wording::{grade, is_telling, tells_something};
use crate::learn::decision::{SURE, Verdict};
use crate::numeric::written::{probability, rounded_down};
use crate::study::{Operation, Role, Test};

/// What to do where nothing is found missing and no test tells what comes next from that: it has hardly any strength in these measurements.
pub(super) fn measure_more(decided: Option<&Decided>, best: &RankedTest) -> Option<&'static str> {
    let found_nothing = decided.is_some_and(|decided| decided.verdict == Verdict::NothingMissing);
    (found_nothing && !tells_something(best)).then_some(
        "What comes next has hardly any strength in these measurements, so that no test of the table tells it from nothing: more measurements would show \
         more. A copy of the study without [measurements] lets gearwear plan choose the tests, and what to measure in them, that show most effects of the \
         catalogue.",
    )
}

/// What follows from it that k of the tests follows a condition, `trend` in words.
pub(super) fn with_trend(trend: Option<&str>) -> String {
    trend.map_or(String::new(), |trend| {
        format!(
            "{trend}. Tests that differ in nothing else show whether it does; where there are none yet, the next should. "
        )
    })
}

/// Where a diagnosis sends to the table: how such a clause begins and ends, the study's name between.
const TO_THE_TABLE: [[&str; 2]; 2] = [
    [": gearwear plan ", " ranks others"],
    [" (gearwear plan ", " has the figures)"],
];

/// What the diagnosis says to do next, without the clauses that send to the table where this is read.
fn next_step(decided: &Decided) -> String {
    let mut said = decided.next_step.trim_end_matches('.').to_owned();
    for [begins, ends] in TO_THE_TABLE {
        let Some(from) = said.find(begins) else {
            continue;
        };
        if let Some(length) = said[from..].find(ends) {
            said.replace_range(from..from + length + ends.len(), "");
        }
    }
    said
}

/// Probability of something that the catalogue does not hold from which that is an open question.
const OPEN: f64 = 0.05;

/// What the diagnosis left open, or that it left nothing, where the table's best test would be taken for the answer to it; with the space behind it.
/// `best`: the table's first test; `holds_its_leaders`: the table separates the leaders of that diagnosis; `too_few`: it had too few values to find anything.
pub(super) fn left_open(
    decided: Option<&Decided>,
    best: &RankedTest,
    holds_its_leaders: bool,
    too_few: bool,
) -> String {
    let Some(decided) = decided else {
        return String::new();
    };
    let Some(first) = decided.ranking.first() else {
        return String::new();
    };
    let unknown = decided.probabilities.get("unknown");
    let unknown = unknown.copied().unwrap_or(0.0);
    match decided.verdict {
        Verdict::Ambiguous if unknown > OPEN => format!(
            "The diagnosis leaves open whether it is {} or something that the catalogue does not hold ({} %), of which this table cannot tell; next, by \
             the diagnosis: {}. ",
            first.effect,
            rounded_down(100.0 * unknown, 0),
            next_step(decided)
        ),
        Verdict::Unknown => format!(
            "The diagnosis finds a cause that the catalogue does not hold ({}), of which this table cannot tell; next, by the diagnosis: {}. What follows \
             would separate effects that are less probable. ",
            probability(unknown),
            next_step(decided)
        ),
        Verdict::Effects if !holds_its_leaders => format!(
            "The diagnosis has decided for {} ({} %), which this table does not judge: add them (gearwear add), then plan from the study with them. ",
            first.effect,
            rounded_down(100.0 * first.probability, 0)
        ),
        Verdict::Effect | Verdict::Effects => format!(
            "The diagnosis has decided for {} already ({}): no test is needed for that{}. What follows would only confirm it \
             against {}. ",
            first.effect,
            probability(first.probability),
            match next_step(decided) {
                step if step.is_empty() => step,
                step => format!("; next, by the diagnosis: {step}"),
            },
            match holds_its_leaders {
                true => "its nearest rivals",
                false => "effects that the analytic model ranks next",
            }
        ),
        Verdict::Partial if holds(decided, &first.effect) >= SETTLED => format!(
            "The diagnosis has settled already that {} is missing: no test is needed for that. What stands beside it this table cannot tell; next, by the \
             diagnosis: {}. What follows would only confirm the effect against its nearest rivals. ",
            first.effect.trim_end_matches("+unknown"),
            next_step(decided)
        ),
        Verdict::NothingMissing if too_few => {
            "The diagnosis has too few measured values to tell whether anything is missing. "
                .to_owned()
        }
        Verdict::NothingMissing => format!(
            "The diagnosis {} ({} %){}. ",
            match first.probability < SURE {
                true => "is undecided: most likely nothing is missing",
                false => "finds nothing missing",
            },
            rounded_down(100.0 * first.probability, 0),
            match best.separates.iter().find(|pair| is_telling(pair)) {
                Some(Separated {
                    pair: [_, other], ..
                }) => format!(
                    ": what follows would show whether {other} hides below the noise after all"
                ),
                None => String::new(),
            }
        ),
        _ => String::new(),
    }
}

/// Probability of an effect, whatever stands beside it, from which it is settled that it is missing.
const SETTLED: f64 = 0.85;

/// The probability of all that holds the effects of a hypothesis.
fn holds(decided: &Decided, hypothesis: &str) -> f64 {
    let own: Vec<&str> = hypothesis.trim_end_matches("+unknown").split('+').collect();
    let all = decided.probabilities.iter();
    let holding = all.filter(|(name, _)| own.iter().all(|own| name.split('+').any(|n| n == *own)));
    holding.map(|(_, p)| p).sum()
}

/// What a settled diagnosis needs more than another comparison of rivals: a test that nothing was fitted to.
pub(super) fn held_out(decided: Option<&Decided>, tests: &[Test]) -> &'static str {
    let settled =
        |decided: &Decided| !matches!(decided.verdict, Verdict::Ambiguous | Verdict::Unknown);
    let is_held_out = |test: &Test| test.role == Role::Holdout;
    if decided.is_some_and(settled) && !tests.iter().any(is_held_out) {
        " No test of this study is held out: mark the new one role = \"holdout\", and ladder shows whether the model predicts what it was not fitted to."
    } else {
        ""
    }
}

/// What the diagnosis proposed, with its own figure: where that is another test, or the same by which it expects another outcome.
pub(super) fn proposed(decided: Option<&Decided>, best: &RankedTest, plain: &Operation) -> String {
    let next = decided.and_then(|decided| decided.next_experiment.as_ref());
    let Some(next) = next else {
        return String::new();
    };
    let expects = format!(
        "χ² {:.1}, {}",
        next.expected_chi2,
        strength(next.expected_chi2)
    );
    if next.test != best.test {
        return format!(
            " The diagnosis proposed {} ({}), where {} differ most in the quantities measured so far, taken together ({expects}); here one \
             quantity is measured, also one that was not so far, all leaders count by their probability, and of tests that say as much the one of fewer hours comes first.",
            next.repeats.as_ref().map_or_else(
                || format!("a test with {}", changes(&next.test, plain)),
                |id| format!("to make test {id} once more")
            ),
            duration(&next.test),
            next.separates.join(" and ")
        );
    }
    let here = best
        .separates
        .first()
        .map_or(0.0, |likeliest| likeliest.chi2);
    if grade(here) == grade(next.expected_chi2) {
        return String::new();
    }
    format!(" In the quantities measured so far, taken together, the diagnosis expects {expects}.")
}

#[cfg(test)]
mod tests {
    use super::super::candidate_tests::tests::plain;
    use super::super::candidate_tests::{NextTest, shown};
    use super::super::wording::tests::{best, separated};
    use super::*;
    use crate::learn::experiment::decided::DecidedCandidate;
    use crate::learn::experiment::next::NextExperiment;
    use crate::study::Study;

    fn decided(verdict: Verdict, probability: f64, unknown: f64) -> Decided {
        Decided {
            verdict,
            ranking: vec![DecidedCandidate {
                effect: "dynamic_load".to_owned(),
                form: String::new(),
                probability,
                parameters: Vec::new(),
                wear_coefficient: None,
            }],
            next_experiment: None,
            probabilities: [("unknown".to_owned(), unknown)].into(),
            next_step: "tests at several speeds".to_owned(),
        }
    }

    fn left_open_by(verdict: Verdict, probability: f64, unknown: f64, holds: bool) -> String {
        let test = best(1, 50.0, vec![separated("b", 0.1), separated("c", 20.0)]);
        left_open(
            Some(&decided(verdict, probability, unknown)),
            &test,
            holds,
            false,
        )
    }

    #[test]
    fn what_the_table_cannot_tell_comes_first() {
        let open = left_open_by(Verdict::Ambiguous, 0.67, 0.33, true);
        assert!(
            open.contains("(33 %)") && open.contains("tests at several speeds"),
            "{open}"
        );
        let outside = left_open_by(Verdict::Unknown, 0.01, 0.985, true);
        assert!(
            outside.contains("does not hold (98.5 %)") && outside.contains("less probable"),
            "{outside}"
        );
        let done = left_open_by(Verdict::Effect, 0.99, 0.01, true);
        assert!(
            done.contains("has decided for dynamic_load already (99.0 %): no test is needed"),
            "{done}"
        );
        assert_eq!(left_open_by(Verdict::Ambiguous, 0.6, 0.01, true), "");
        let none = left_open_by(Verdict::NothingMissing, 0.93, 0.01, true);
        assert!(
            none.contains("nothing missing (93 %): what follows would show whether c hides"),
            "{none}"
        );
        let pair = left_open_by(Verdict::Effects, 0.95, 0.01, false);
        assert!(pair.contains("which this table does not judge"), "{pair}");
    }

    #[test]
    fn what_is_settled_and_what_cannot_be_told_is_said_so() {
        let test = best(1, 50.0, vec![separated("b", 20.0)]);
        assert_eq!(left_open(None, &test, false, false), "");
        let mut remains = decided(Verdict::Partial, 0.99, 0.01);
        // one of several
        assert_eq!(left_open(Some(&remains), &test, true, false), "");
        (remains.probabilities).insert("dynamic_load+unknown".to_owned(), 0.99);
        let partial = left_open(Some(&remains), &test, true, false);
        assert!(
            partial.contains("settled already that dynamic_load"),
            "{partial}"
        );
        let few = decided(Verdict::NothingMissing, 0.5, 0.2);
        assert_eq!(
            left_open(Some(&few), &test, true, true),
            "The diagnosis has too few measured values to tell whether anything is missing. "
        );
    }

    /// Where nothing is found missing and the best test tells nothing, and only there.
    #[test]
    fn what_has_no_strength_asks_for_more_measurements() {
        let nothing = decided(Verdict::NothingMissing, 0.5, 0.2);
        let little = best(1, 50.0, vec![separated("b", 0.1), separated("c", 0.0)]);
        let more = measure_more(Some(&nothing), &little).unwrap();
        assert!(more.contains("without [measurements]"), "{more}");
        let telling = best(1, 50.0, vec![separated("b", 0.1), separated("c", 20.0)]);
        assert_eq!(measure_more(Some(&nothing), &telling), None);
        let open = decided(Verdict::Ambiguous, 0.5, 0.2);
        assert_eq!(measure_more(Some(&open), &little), None);
        assert_eq!(measure_more(None, &little), None);
        assert_eq!(with_trend(None), "");
        assert!(with_trend(Some("k rises")).starts_with("k rises. Tests that differ"));
    }

    #[test]
    fn the_table_does_not_send_to_itself() {
        let told = |next: &str| {
            next_step(&Decided {
                next_step: next.to_owned(),
                ..decided(Verdict::Ambiguous, 0.6, 0.3)
            })
        };
        assert_eq!(
            told(
                "no test made like these tells them apart clearly: gearwear plan my gears.toml ranks others; or add each in turn"
            ),
            "no test made like these tells them apart clearly; or add each in turn"
        );
        assert_eq!(
            told("another quantity might (gearwear plan s.toml has the figures)."),
            "another quantity might"
        );
        assert_eq!(told("tests at several speeds."), "tests at several speeds");
    }

    #[test]
    fn a_settled_diagnosis_asks_for_a_test_that_is_held_out() {
        let study = include_str!("../../cli/examples/hidden-effect.toml");
        let mut tests = Study::parse(study, "study.toml").unwrap().tests;
        let settled = decided(Verdict::Effect, 0.99, 0.0);
        assert_eq!(held_out(Some(&settled), &tests), "");
        tests.retain(|test| test.role == Role::Fit);
        assert!(held_out(Some(&settled), &tests).contains("role = \"holdout\""));
        assert_eq!(held_out(None, &tests), "");
        let open = decided(Verdict::Ambiguous, 0.5, 0.3);
        assert_eq!(held_out(Some(&open), &tests), "");
    }

    #[test]
    fn what_the_diagnosis_expects_stands_beside_what_the_table_does() {
        let mut open = decided(Verdict::Ambiguous, 0.6, 0.0);
        let table = best(0, 100.0, vec![separated("b", 2.0)]);
        let mut next = |torque: f64, expected_chi2| {
            open.next_experiment = Some(NextExperiment {
                separates: vec!["a".to_owned(), "b".to_owned()],
                test: NextTest {
                    torque,
                    ..shown(&plain())
                },
                why: String::new(),
                expected_chi2,
                repeats: None,
                repetition_chi2: 0.0,
                further: Vec::new(),
                together_chi2: expected_chi2,
            });
            proposed(Some(&open), &table, &plain())
        };
        assert_eq!(next(100.0, 3.0), "");
        assert_eq!(
            next(100.0, 9.0),
            " In the quantities measured so far, taken together, the diagnosis expects χ² 9.0, enough to favour one clearly."
        );
        assert!(
            next(50.0, 3.0)
                .contains("taken together (χ² 3.0, still little: other measurements are needed)")
        );
    }
}
