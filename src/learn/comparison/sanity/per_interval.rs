//! Losses of each interval, where those since the start are wanted.
//!
//! ```text
//! w_i of a member's checkpoints (masses, or s N of its depth curves) over N_i: r_i;  of w_1 + … + w_i: R_i
//! r falls by more than 2.5 times, R stays within 15 %:  the w_i are increments
//! ```
//! Wear by a constant k has R so. Wear by the root of the cycles makes R rise; wear that all but stopped before the first checkpoint looks the same,
//! and is left to whoever is asked.

use super::super::residual_statistics::FittedRow;
use super::falling::{Worn, series};
use crate::measure::Quantity;
use crate::study::Study;

/// Factor by which wear per cycle must fall as it stands, and within which it stays once added up.
const FALLS: f64 = 2.5;
const STAYS: f64 = 1.15;
/// Fewest checkpoints.
const FEWEST: usize = 4;

/// A question about the tests and members whose losses are those of intervals.
pub(super) fn per_interval(study: &Study, rows: &[FittedRow<'_>]) -> Option<String> {
    [Quantity::WearDepth, Quantity::MassLoss].into_iter().find_map(|quantity| {
        let of_intervals: Vec<String> = (series(rows, quantity).iter())
            .filter(|(_, series)| series.iter().any(|worn| are_increments(worn)))
            .map(|((test, member), _)| format!("{} in test {}", member.name(), study.tests[*test].id))
            .collect();
        (!of_intervals.is_empty()).then(|| {
            format!(
                "{} of the {} hardly grows from checkpoint to checkpoint, and added up it grows with the cycles: is each value the loss since the one \
                 before? Wanted is the loss since the start; gearwear import --per-interval {} adds them up. If each is, wear all but stopped before the first \
                 checkpoint",
                quantity.name(),
                of_intervals.join(", of the "),
                quantity.name()
            )
        })
    })
}

/// Whether what was worn at checkpoints, by rising cycles, is that since the one before.
fn are_increments(worn: &[Worn]) -> bool {
    let later = worn.windows(2).all(|two| two[0].cycles < two[1].cycles);
    if worn.len() < FEWEST || !later || worn.iter().any(|w| w.amount <= 0.0) {
        return false;
    }
    let rate = |amount: f64, w: &Worn| (amount / w.cycles).ln();
    let stands: Vec<f64> = worn.iter().map(|w| rate(w.amount, w)).collect();
    let mut sum = 0.0;
    let added = worn.iter().map(|w| {
        sum += w.amount;
        rate(sum, w)
    });
    let added: Vec<f64> = added.collect();
    let range = |all: &[f64]| {
        let high = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        high - all.iter().copied().fold(f64::INFINITY, f64::min)
    };
    stands[0] - stands[stands.len() - 1] > FALLS.ln() && range(&added) < STAYS.ln()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is said of amounts after a fifth, two fifths, … of a test.
    fn told(amounts: [f64; 5]) -> bool {
        let worn: Vec<Worn> = (amounts.into_iter().zip(1..))
            .map(|(amount, i)| Worn {
                cycles: 1e5 * f64::from(i),
                amount,
                sigma: 0.1,
            })
            .collect();
        are_increments(&worn)
    }

    #[test]
    fn losses_of_intervals_are_told_from_slowing_wear() {
        assert!(told([10.0, 10.5, 9.6, 10.2, 9.9]));
        // steady; by the root of the cycles; running-in that is over soon
        assert!(!told([10.0, 20.0, 30.0, 40.0, 50.0]));
        assert!(!told([10.0, 14.1, 17.3, 20.0, 22.4]));
        assert!(!told([10.0, 12.0, 13.0, 14.0, 15.0]));
    }
}
