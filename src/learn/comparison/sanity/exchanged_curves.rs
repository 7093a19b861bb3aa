//! Depths of one member that stand under each other's names in two tests.
//!
//! ```text
//! q = ln s_p/s_g of a test's depths, L = ln of the wear of test j per revolution over that of test i: the computed, by the common k, times what the mate's
//!     depths are of theirs, since each test may have a k of its own; wear is how far it ranges along the flank, as zeros of traces leave it (deep wear
//!     spreads: its range grows less than its mean), or of single places the depth itself
//! pinion's exchanged: q_i = q + L, q_j = q − L; gear's: q_i = q − L, q_j = q + L       q that of the other tests
//! the computed part of L above ln 1.3, |L| above half of that, both within a fifth of L, as the other tests are of each other; for one pair and one member alone
//! ```

use super::super::residual_statistics::FittedRow;
use super::exchanged_depths::{factor, of_one_test, of_test, sizes};
use crate::measure::{Quantity, Subject};
use crate::numeric::median;
use crate::numeric::written::significant;
use crate::study::Study;

/// ln of the ratio of two tests' computed wear below which nothing is told, and that of the wear with their own k.
const APART: f64 = 0.26;
const APART_BY_OWN_K: f64 = 0.13;
/// How near to exchanged two tests must be, and how near each other the others, in parts of L.
const NEAR: f64 = 0.2;

/// A question about the two tests of which one member's depths fit once exchanged; none for fewer than three tests.
pub(super) fn exchanged_curves(study: &Study, rows: &[FittedRow<'_>]) -> Option<String> {
    let own = (0..study.tests.len()).filter_map(|test| Some((test, of_test(rows, test)?)));
    let own: Vec<(usize, f64)> = own.collect();
    let pairs = (0..own.len()).flat_map(|i| (i + 1..own.len()).map(move |j| (i, j)));
    let members = [(Subject::Pinion, 1.0), (Subject::Gear, -1.0)];
    let found = pairs
        .flat_map(|pair| members.map(|of| (pair, of)))
        .filter_map(|((i, j), (member, sign))| {
            let [one, other] = [own[i], own[j]];
            let of_mate = |test| factor(rows, test, mate_of(member));
            let computed = (level(rows, other.0, member)? / level(rows, one.0, member)?).ln();
            let of_own_k = (of_mate(other.0)? / of_mate(one.0)?).ln();
            let by = sign * (computed + of_own_k);
            let others = own.iter().filter(|q| q.0 != one.0 && q.0 != other.0);
            let others: Vec<f64> = others.map(|q| q.1).collect();
            let usual = median(others.clone())?;
            let near = |x: f64| x.abs() < NEAR * by.abs();
            let is_exchanged = computed.abs() > APART
                && by.abs() > APART_BY_OWN_K
                && others.iter().all(|q| near(q - usual))
                && near(one.1 - usual - by)
                && near(other.1 - usual + by);
            is_exchanged.then_some((member, one, other, sign * by, of_own_k.abs()))
        });
    let found: Vec<_> = found.collect();
    let of_one_pair = (found.windows(2)).all(|two| (two[0].1, two[0].2) == (two[1].1, two[1].2));
    // where either member's would do, the one that leaves the k of both tests more alike
    let best = found.into_iter().min_by(|a, b| a.4.total_cmp(&b.4));
    let (member, one, other, by, _) = best.filter(|_| of_one_pair)?;
    let mate = mate_of(member);
    let [first, second] = [one.0, other.0].map(|test| &study.tests[test].id);
    Some(format!(
        "are the {}'s depths of tests {first} and {second} exchanged? Against the {}'s of the same tests they are {} times what they should be in {first} and {} \
         times in {second}, as they would be under each other's names: look at the files or sheets that they come from",
        member.name(),
        mate.name(),
        significant(by.exp(), 2),
        significant((-by).exp(), 2),
    ))
}

/// The member that one runs against.
fn mate_of(member: Subject) -> Subject {
    match member {
        Subject::Pinion => Subject::Gear,
        _ => Subject::Pinion,
    }
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
