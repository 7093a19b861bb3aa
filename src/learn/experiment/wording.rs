//! The table of feasible tests in sentences.

use super::candidate_tests::{
    APART, CLEAR, ENOUGH, NEARLY, NextTest, changes, duration, purpose, shown, strength,
};
use super::decided::Decided;
use super::order::settles;
use super::plan::{RankedTest, Separated};
use crate::learn::decision::Verdict;
use crate::numeric::written::{probability, rounded_down};
use crate::study::{Operation, Role, Test};

/// Relative difference up to which two conditions are the same.
const SAME: f64 = 1e-3;

/// A test made already, made once more.
pub(super) struct Repetition {
    /// Its id.
    pub(super) test: String,
    /// Mean expected χ², counted as that of the feasible tests.
    pub(super) chi2: f64,
}

/// The first line of the table, and whether making a test once more is better.
pub(super) fn sentence(
    best: &RankedTest,
    plain: &Operation,
    repetition: Option<&Repetition>,
) -> String {
    let purpose = match best.changes {
        0 => String::new(),
        _ => format!(": {}", purpose(&best.test, plain)),
    };
    // what tells nothing is no advice
    let begin = match tells_something(best) {
        true => "Next: measure",
        false => "No test in reach tells apart what is left; the best would be to measure",
    };
    format!(
        "{begin} the {} in a test with {} ({} on the rig){purpose}. {}{}",
        best.quantity.replace('_', " "),
        changes(&best.test, plain),
        duration(&best.test),
        pairs(&best.separates),
        repeated(best, repetition)
    )
}

/// Whether a test tells the leader from any of its rivals.
fn tells_something(test: &RankedTest) -> bool {
    test.separates.iter().any(is_telling)
}

fn is_telling(separated: &Separated) -> bool {
    grade(separated.chi2) != Grade::Little
}

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
            "{trend}. A test that differs from one made already in nothing else would show whether it does. "
        )
    })
}

/// What a test is for, as a sentence with the space behind it.
pub(super) fn purpose_of(test: &NextTest, plain: &Operation) -> String {
    let purpose = purpose(test, plain);
    let mut letters = purpose.chars();
    let first = letters
        .next()
        .map(|letter| letter.to_uppercase().to_string());
    format!("{}{}. ", first.unwrap_or_default(), letters.as_str())
}

/// What a test says of the two likeliest, and of the pair that is hardest to tell apart.
pub(super) fn pairs(separates: &[Separated]) -> String {
    let hardest = separates.iter().min_by(|a, b| a.chi2.total_cmp(&b.chi2));
    let (Some(likeliest), Some(hardest)) = (separates.first(), hardest) else {
        return String::new();
    };
    let first = format!("It {}", outcome(likeliest));
    if hardest.pair == likeliest.pair {
        return format!("{first}.");
    }
    let joined = if grade(hardest.chi2) == grade(likeliest.chi2) {
        "and"
    } else {
        "but"
    };
    format!("{first}, {joined} {}, the hardest pair.", outcome(hardest))
}

/// What a test does to two candidates that differ in it by some χ².
fn outcome(separated: &Separated) -> String {
    let [one, other] = separated.pair.each_ref().map(|name| match name.as_str() {
        "nothing_missing" => "nothing missing",
        effect => effect,
    });
    let chi2 = separated.chi2;
    match grade(chi2) {
        Grade::Apart => format!("tells {one} from {other} (χ² {chi2:.0})"),
        Grade::Clear => format!("favours {one} or {other} clearly (χ² {chi2:.0})"),
        Grade::Little => format!("hardly tells {one} from {other} (χ² {chi2:.1})"),
    }
}

#[derive(PartialEq)]
enum Grade {
    Apart,
    Clear,
    Little,
}

fn grade(chi2: f64) -> Grade {
    if chi2 >= APART {
        Grade::Apart
    } else if chi2 >= CLEAR {
        Grade::Clear
    } else {
        Grade::Little
    }
}

/// Says so where making a test once more is better than the best of the table, which does not settle it.
fn repeated(best: &RankedTest, repetition: Option<&Repetition>) -> String {
    // a few per cent are no reason, and neither is a test that tells nothing
    let better =
        repetition.filter(|again| again.chi2 >= CLEAR && NEARLY * again.chi2 > best.expected_chi2);
    let better = better.filter(|_| !settles(best));
    better.map_or(String::new(), |again| {
        let most = if again.chi2 < ENOUGH {
            format!("{:.1}", again.chi2)
        } else {
            format!("≥ {ENOUGH}")
        };
        format!(
            " Repeating test {} with all its measurements does better (mean χ² {most} against {:.1}): make that first, where all of them can be made once \
             more.",
            again.test, best.expected_chi2
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
            "The diagnosis finds nothing missing ({} %){}. ",
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

/// Says so where the best test of the table is one that was made already.
pub(super) fn made_already(best: &RankedTest, tests: &[Test]) -> String {
    let same = |a: f64, b: f64| (a - b).abs() <= SAME * a.abs().max(b.abs());
    let is_best = |test: &&Test| {
        let (own, best) = (shown(&test.conditions), &best.test);
        same(own.torque, best.torque)
            && same(own.speed, best.speed)
            && same(own.misalignment, best.misalignment)
            && same(own.cycles, best.cycles)
            && own.reversed == best.reversed
            && own.bulk_temperature == best.bulk_temperature
    };
    tests.iter().find(is_best).map_or(String::new(), |test| {
        format!(" These are the conditions of test {}.", test.id)
    })
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
            " The diagnosis proposed {} ({}), where {} differ most with everything measured at once ({expects}); here one quantity is \
             measured, all leaders count by their probability, and of tests that say as much the one of fewer hours comes first.",
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
    format!(" With everything measured in it at once the diagnosis expects {expects}.")
}

#[cfg(test)]
mod tests {
    use super::super::candidate_tests::tests::plain;
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

    #[test]
    fn what_the_table_cannot_tell_comes_first() {
        let test = best(1, 50.0, vec![separated("b", 0.1), separated("c", 20.0)]);
        let open = left_open(
            Some(&decided(Verdict::Ambiguous, 0.67, 0.33)),
            &test,
            true,
            false,
        );
        assert!(
            open.contains("(33 %)") && open.contains("tests at several speeds"),
            "{open}"
        );
        let outside = left_open(
            Some(&decided(Verdict::Unknown, 0.01, 0.985)),
            &test,
            true,
            false,
        );
        assert!(
            outside.contains("does not hold (98.5 %)") && outside.contains("less probable"),
            "{outside}"
        );
        let done = left_open(
            Some(&decided(Verdict::Effect, 0.99, 0.01)),
            &test,
            true,
            false,
        );
        assert!(
            done.contains("has decided for dynamic_load already (99.0 %): no test is needed"),
            "{done}"
        );
        let mut remains = decided(Verdict::Partial, 0.99, 0.01);
        // one of several
        assert_eq!(left_open(Some(&remains), &test, true, false), "");
        (remains.probabilities).insert("dynamic_load+unknown".to_owned(), 0.99);
        let partial = left_open(Some(&remains), &test, true, false);
        assert!(
            partial.contains("settled already that dynamic_load"),
            "{partial}"
        );
        assert!(
            left_open(
                Some(&decided(Verdict::Ambiguous, 0.6, 0.01)),
                &test,
                true,
                false
            )
            .is_empty()
        );
        assert!(left_open(None, &test, false, false).is_empty());
        let none = left_open(
            Some(&decided(Verdict::NothingMissing, 0.93, 0.01)),
            &test,
            true,
            false,
        );
        assert!(
            none.contains("nothing missing (93 %): what follows would show whether c hides"),
            "{none}"
        );
        let few = decided(Verdict::NothingMissing, 0.5, 0.2);
        assert_eq!(
            left_open(Some(&few), &test, true, true),
            "The diagnosis has too few measured values to tell whether anything is missing. "
        );
        let pair = left_open(
            Some(&decided(Verdict::Effects, 0.95, 0.01)),
            &test,
            false,
            false,
        );
        assert!(pair.contains("which this table does not judge"), "{pair}");
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
        assert!(with_trend(Some("k rises")).starts_with("k rises. A test that differs"));
    }

    /// What settles it needs no repetition, whatever that says.
    #[test]
    fn a_repetition_is_asked_for_only_where_nothing_settles_it() {
        let again = Repetition {
            test: "V1".to_owned(),
            chi2: 61.0,
        };
        let mut test = best(1, 50.0, vec![separated("b", 46.0)]);
        test.expected_chi2 = 46.0;
        assert_eq!(repeated(&test, Some(&again)), "");
        test.separates[0].chi2 = 40.0;
        test.expected_chi2 = 40.0;
        let said = repeated(&test, Some(&again));
        assert!(said.contains("(mean χ² ≥ 60 against 40.0)"), "{said}");
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

    fn separated(other: &str, chi2: f64) -> Separated {
        Separated {
            pair: ["a".to_owned(), other.to_owned()],
            chi2,
        }
    }

    fn best(changes: usize, torque: f64, separates: Vec<Separated>) -> RankedTest {
        RankedTest {
            test: NextTest {
                torque,
                ..shown(&plain())
            },
            quantity: "transmission_error".to_owned(),
            changes,
            expected_chi2: 50.0,
            separates,
            why: String::new(),
        }
    }

    #[test]
    fn the_first_line_is_a_few_short_sentences() {
        let plainest = best(0, 100.0, vec![separated("b", 87.0), separated("c", 45.0)]);
        assert_eq!(
            sentence(&plainest, &plain(), None),
            "Next: measure the transmission error in a test with 1\u{202f}000\u{202f}000 cycles at the study's operation (8.33 h on the rig). It tells a from b (χ² 87), and \
             tells a from c (χ² 45), the hardest pair."
        );
        let other = best(1, 50.0, vec![separated("b", 87.0), separated("c", 2.0)]);
        let said = sentence(&other, &plain(), None);
        assert!(
            said.contains(
                "50 N·m (8.33 h on the rig): another pressure at the same sliding. It tells"
            ),
            "{said}"
        );
        assert!(
            said.ends_with("but hardly tells a from c (χ² 2.0), the hardest pair."),
            "{said}"
        );
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
            " With everything measured in it at once the diagnosis expects χ² 9.0, enough to favour one clearly."
        );
        assert!(
            next(50.0, 3.0)
                .contains("at once (χ² 3.0, still little: other measurements are needed)")
        );
    }

    #[test]
    fn a_repetition_is_said_to_be_better_only_where_it_is() {
        let best = RankedTest {
            expected_chi2: 40.0,
            ..best(0, 100.0, vec![separated("b", 40.0)])
        };
        let again = |chi2| {
            let again = Repetition {
                test: "B".to_owned(),
                chi2,
            };
            sentence(&best, &plain(), Some(&again))
        };
        assert!(again(57.7).ends_with(
            "Repeating test B with all its measurements does better (mean χ² 57.7 against 40.0): make that first, where all of them can be made once more."
        ));
        assert!(!again(39.0).contains("Repeating"));
        // by a few per cent
        assert!(!again(41.6).contains("Repeating"));
    }
}
