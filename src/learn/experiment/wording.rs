//! The best of the feasible tests in sentences.

use super::candidate_tests::{
    APART, CLEAR, ENOUGH, NEARLY, NextTest, changes, duration, purpose, shown,
};
use super::order::settles;
use super::plan::{RankedTest, Separated};
use crate::study::{Operation, Test};

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
pub(super) fn tells_something(test: &RankedTest) -> bool {
    test.separates.iter().any(is_telling)
}

pub(super) fn is_telling(separated: &Separated) -> bool {
    grade(separated.chi2) != Grade::Little
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
pub(super) enum Grade {
    Apart,
    Clear,
    Little,
}

pub(super) fn grade(chi2: f64) -> Grade {
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

#[cfg(test)]
pub(super) mod tests {
    use super::super::candidate_tests::tests::plain;
    use super::*;

    pub(in crate::learn::experiment) fn separated(other: &str, chi2: f64) -> Separated {
        Separated {
            pair: ["a".to_owned(), other.to_owned()],
            chi2,
        }
    }

    pub(in crate::learn::experiment) fn best(
        changes: usize,
        torque: f64,
        separates: Vec<Separated>,
    ) -> RankedTest {
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

    /// By more than a few per cent, and where the best test does not settle it.
    #[test]
    fn a_repetition_is_said_to_be_better_only_where_it_is() {
        let said = |of_best, of_repetition| {
            let best = RankedTest {
                expected_chi2: of_best,
                ..best(0, 100.0, vec![separated("b", of_best)])
            };
            let again = Repetition {
                test: "B".to_owned(),
                chi2: of_repetition,
            };
            sentence(&best, &plain(), Some(&again))
        };
        assert!(said(40.0, 57.7).ends_with(
            "Repeating test B with all its measurements does better (mean χ² 57.7 against 40.0): make that first, where all of them can be made once more."
        ));
        assert!(said(40.0, 61.0).contains("(mean χ² ≥ 60 against 40.0)"));
        assert!(!said(40.0, 39.0).contains("Repeating"));
        assert!(!said(40.0, 41.6).contains("Repeating"));
        assert!(!said(46.0, 61.0).contains("Repeating"));
    }
}
