//! Depths of one member that stand under each other's names in two tests.
//!
//! ```text
//! q = ln s_p/s_g of a test's depths, L = ln of the wear of test j per revolution over that of test i: the computed, by the common k, times what the mate's
//!     depths are of theirs, since each test may have a k of its own; wear is how far it ranges along the flank, as zeros of traces leave it (deep wear
//!     spreads: its range grows less than its mean), or of single places the depth itself
//! pinion's exchanged: q_i = q + L, q_j = q − L; gear's: q_i = q − L, q_j = q + L       q that of the other tests
//! the computed part of L above ln 1.3, |L| above half of that, both within a fifth of L, as the other tests are of each other; for one pair alone, and where either
//! member's would do, of the one that leaves the k of both tests more alike
//! ```

use super::super::residual_statistics::FittedRow;
use super::exchanged_depths::{factor, of_one_test, sizes};
use crate::measure::{Quantity, Subject};
use crate::numeric::median;
use crate::numeric::written::significant;
use crate::study::Study;

/// ln of the ratio of two tests' computed wear below which nothing is told, and that of the wear with their own k.
const APART: f64 = 0.26;
const APART_BY_OWN_K: f64 = 0.13;
/// How near to exchanged two tests must be, and how near each other the others, in parts of L.
const NEAR: f64 = 0.2;

/// The depths of a test: of both members, pinion first.
struct OfTest {
    test: usize,
    /// q.
    q: f64,
    /// ln of the computed wear per revolution.
    computed: [f64; 2],
    /// ln of how many times the model's they are.
    factor: [f64; 2],
}

impl OfTest {
    /// None of a test without depths of both members.
    fn new(rows: &[FittedRow<'_>], test: usize) -> Option<Self> {
        let [pinion, gear] =
            MEMBERS.map(|member| Some([level(rows, test, member)?, factor(rows, test, member)?]));
        let [pinion, gear] = [pinion?, gear?].map(|own| own.map(f64::ln));
        Some(Self {
            test,
            q: pinion[1] - gear[1],
            computed: [pinion[0], gear[0]],
            factor: [pinion[1], gear[1]],
        })
    }
}

/// Depths of one member that fit once exchanged between two tests.
struct Exchange<'t> {
    /// Its place in [`MEMBERS`].
    member: usize,
    tests: [&'t OfTest; 2],
    /// ln of how many times what they should be the member's depths of the first test are.
    by: f64,
    /// How much the k of both tests differ then, of ln k.
    unlike: f64,
}

const MEMBERS: [Subject; 2] = [Subject::Pinion, Subject::Gear];

/// A question about the two tests of which one member's depths fit once exchanged; none for fewer than three tests.
pub(super) fn exchanged_curves(study: &Study, rows: &[FittedRow<'_>]) -> Option<String> {
    let own = (0..study.tests.len()).filter_map(|test| OfTest::new(rows, test));
    let own: Vec<OfTest> = own.collect();
    let pairs = (0..own.len()).flat_map(|i| (i + 1..own.len()).map(move |j| [i, j]));
    let found: Vec<Exchange<'_>> = pairs
        .flat_map(|pair| [0, 1].map(|member| (pair, member)))
        .filter_map(|(pair, member)| exchange(&own, pair, member))
        .collect();
    let tests = |found: &Exchange<'_>| found.tests.map(|of| of.test);
    let of_one_pair = found.windows(2).all(|two| tests(&two[0]) == tests(&two[1]));
    // where either member's would do, the one that leaves the k of both tests more alike
    let best = found.iter().min_by(|a, b| a.unlike.total_cmp(&b.unlike));
    let best = best.filter(|_| of_one_pair)?;
    let [first, second] = tests(best).map(|test| &study.tests[test].id);
    let [member, mate] = [best.member, 1 - best.member].map(|place| MEMBERS[place].name());
    Some(format!(
        "are the {member}'s depths of tests {first} and {second} exchanged? Against the {mate}'s of the same tests they are {} times what they should be in {first} and {} \
         times in {second}, as they would be under each other's names: look at the files or sheets that they come from",
        significant(best.by.exp(), 2),
        significant((-best.by).exp(), 2),
    ))
}

/// Whether the depths of one member of two tests fit once exchanged.
fn exchange(own: &[OfTest], pair: [usize; 2], member: usize) -> Option<Exchange<'_>> {
    let [one, other] = pair.map(|at| &own[at]);
    let mate = 1 - member;
    let computed = other.computed[member] - one.computed[member];
    let of_own_k = other.factor[mate] - one.factor[mate];
    let by = computed + of_own_k;
    // q is the pinion's over the gear's
    let of_q = if member == 0 { by } else { -by };
    let others = (own.iter().enumerate()).filter(|(at, _)| !pair.contains(at));
    let others: Vec<f64> = others.map(|(_, of)| of.q).collect();
    let usual = median(others.clone())?;
    let near = |x: f64| x.abs() < NEAR * by.abs();
    let is_exchanged = computed.abs() > APART
        && by.abs() > APART_BY_OWN_K
        && near(one.q - usual - of_q)
        && near(other.q - usual + of_q)
        && others.iter().all(|q| near(q - usual));
    is_exchanged.then_some(Exchange {
        member,
        tests: [one, other],
        by,
        unlike: of_own_k.abs(),
    })
}

/// Computed wear of a member's rows per revolution.
fn level(rows: &[FittedRow<'_>], test: usize, member: Subject) -> Option<f64> {
    let own = of_one_test(rows, test).into_iter();
    let own = own.filter(|(o, _)| o.quantity == Quantity::WearDepth && o.member == member);
    let [depths, cycles, squares, count] = own.fold([0.0; 4], |sums, (o, row)| {
        let own = [row.model, o.cycles, o.cycles.powi(2), 1.0];
        std::array::from_fn(|i| sums[i] + own[i])
    });
    let range = sizes(rows, test, member).map_or(0.0, |(_, computed)| computed);
    let level = if range > 0.0 {
        range / (squares / count).sqrt()
    } else {
        depths / cycles
    };
    (depths > 0.0 && cycles > 0.0).then_some(level)
}

#[cfg(test)]
mod tests {
    use super::super::exchanged_depths::tests::said_of;
    use super::*;

    /// What is said where the second test wears so many times as much as the first.
    fn said(level: f64, factors: [[f64; 2]; 3]) -> Option<String> {
        said_of(
            exchanged_curves,
            [1.0, level, 1.5].map(|level| [level; 2]),
            factors,
        )
    }

    #[test]
    fn two_tests_whose_curves_of_one_member_are_exchanged_are_asked_about() {
        let pinion = said(2.0, [[2.05, 1.0], [0.49, 0.97], [1.02, 1.0]]).unwrap();
        assert!(
            pinion.starts_with("are the pinion's depths of tests A and B exchanged?")
                && pinion.contains("1.9 times what they should be in A"),
            "{pinion}"
        );
        let gear = said(2.0, [[1.0, 2.05], [1.0, 0.5], [1.0, 1.0]]).unwrap();
        assert!(
            gear.starts_with("are the gear's depths of tests A and B exchanged?"),
            "{gear}"
        );
        // the second test's k is 0.8 of the others': its gear tells that, and its pinion's depths under the name of the first
        let of_own_k = said(2.0, [[1.6, 1.0], [0.5, 0.8], [1.0, 1.0]]).unwrap();
        assert!(
            of_own_k.starts_with("are the pinion's depths of tests A and B exchanged?"),
            "{of_own_k}"
        );
        // all right; both members of two tests; one test alone; another factor; tests that wear alike
        let both = [[2.0, 2.0], [0.5, 0.5], [1.0, 1.0]];
        for (level, factors) in [
            (2.0, [[1.0; 2]; 3]),
            (2.0, both),
            (2.0, [[2.0, 1.0], [1.0, 1.0], [1.0, 1.0]]),
            (2.0, [[3.0, 1.0], [0.33, 1.0], [1.0, 1.0]]),
            (1.1, [[1.1, 1.0], [0.9, 1.0], [1.0, 1.0]]),
        ] {
            assert_eq!(said(level, factors), None, "{factors:?}");
        }
    }
}
