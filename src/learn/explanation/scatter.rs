//! The scatter of k between tests in words: what it may be, and what tests made twice say of it.

use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::experiment::candidate_tests::shown;
use crate::learn::experiment::made_tests::alike;

/// Difference of ln k between tests made alike, as a share of the scatter between all, below which these hardly scatter by chance.
const AGREE: f64 = 0.5;

/// Two tests made under the same conditions.
#[derive(Debug, PartialEq)]
pub(super) struct MadeTwice {
    ids: [String; 2],
    /// Difference of their ln k, not negative.
    difference: f64,
}

/// Of the fitted tests made under the same conditions the two whose k differ most; `epsilon`: ln of each one's k over the common one.
pub(super) fn made_twice(likelihood: &Likelihood<'_>, epsilon: &[f64]) -> Option<MadeTwice> {
    let tests = &likelihood.measured.study().tests;
    let own = |i: usize| &tests[likelihood.tests[i]];
    let pairs = (0..epsilon.len()).flat_map(|i| (0..i).map(move |j| (j, i)));
    let same = pairs.filter(|&(i, j)| {
        let [a, b] = [i, j].map(|i| shown(&own(i).conditions));
        alike(&a, &b)
    });
    let difference = |&(i, j): &(usize, usize)| (epsilon[i] - epsilon[j]).abs();
    let (i, j) = same.max_by(|a, b| difference(a).total_cmp(&difference(b)))?;
    Some(MadeTwice {
        ids: [i, j].map(|i| own(i).id.clone()),
        difference: difference(&(i, j)),
    })
}

/// A scatter that is worth a sentence; `other_question`: whether a test is proposed that repeats none.
pub(super) fn of_scatter(
    scatter: f64,
    made_twice: Option<&MadeTwice>,
    other_question: bool,
) -> String {
    let what = match made_twice {
        None if other_question => "how much of it is chance a test made twice would show, which is another question than the one that the next experiment answers".to_owned(),
        None => "how much of it is chance a test made twice would show".to_owned(),
        Some(MadeTwice { ids: [a, b], difference }) => format!(
            "{a} and {b}, made under the same conditions, differ in k by {:.0} %: {}{}",
            100.0 * difference.exp_m1(),
            if *difference < AGREE * scatter {
                "less than the others, so the conditions may be at work in these, and more repetitions would not show how"
            } else {
                "so much comes from no difference of conditions, and how much of it is chance more repetitions would show"
            },
            if *difference >= AGREE * scatter && other_question {
                "; the next experiment answers another question"
            } else {
                ""
            }
        ),
    };
    format!(
        "k scatters by {:.0} % from test to test, which is taken as chance: a cause that acts alike on all of a test (its oil, its batch, its \
         temperature) would look the same; {what}.",
        100.0 * scatter
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is said to do about the scatter does not contradict the test that is proposed.
    #[test]
    fn a_test_made_twice_already_is_not_asked_for_again() {
        let twice = |difference| MadeTwice {
            ids: ["A1".to_owned(), "A2".to_owned()],
            difference,
        };
        assert!(of_scatter(0.3, None, false).ends_with("a test made twice would show."));
        let other = of_scatter(0.3, None, true);
        assert!(other.contains("another question than"), "{other}");
        let chance = of_scatter(0.3, Some(&twice(0.28)), true);
        assert!(
            chance.contains("A1 and A2, made under the same conditions, differ in k by 32 %: so much comes from no"),
            "{chance}"
        );
        let agree = of_scatter(0.3, Some(&twice(0.05)), true);
        assert!(agree.contains("the conditions may be at work"), "{agree}");
        for said in [&chance, &agree] {
            assert!(!said.contains("a test made twice"), "{said}");
        }
    }
}
