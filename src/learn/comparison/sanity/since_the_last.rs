//! Depths and masses of a test that all count from the measurement before.
//!
//! ```text
//! W_i of a member: s·l of the traces at one moment, or the mass; l_i: the model's largest depth, or mass       (s: measured over model)
//! χ² of W = a·l and of W = b·(l_i − l_(i−1)), with σ of W and 5 % for what the model lacks, over all of a test
//! asked: the first above 10 per degree of freedom and six times the second, that below 2.5, and less for each member and quantity
//! ```
//! Where one of both quantities counts so, [`super::same_moments`] finds it by the other.

use super::super::residual_statistics::FittedRow;
use super::single_tests::by_test;
use super::{EXPLAINS, SAME_CYCLES, scale};
use crate::measure::{Quantity, Subject};
use crate::study::Study;

/// Standard deviations from which the scale of a trace, or a mass, is no noise.
const SURE: f64 = 4.0;
/// Fewest moments of a member that tell.
const SEVERAL: usize = 3;
/// Fewest members and quantities of a test that must agree.
const TWICE: usize = 2;
/// Part of what is lost by which laws that the model lacks may shift it.
const LACKING: f64 = 0.05;
/// χ² per degree of freedom from which losses do not follow the totals, up to which they follow the intervals, and the least ratio of both.
const OFF: f64 = 10.0;
const FOLLOWS: f64 = 2.5;
const RATIO: f64 = 6.0;

/// What a member has lost at one moment.
struct Loss {
    measured: f64,
    sigma: f64,
    model: f64,
}

/// A question about the tests of which all wear is in proportion to the intervals between measurements.
pub(super) fn since_the_last(study: &Study, rows: &[FittedRow<'_>]) -> Option<String> {
    let tests = by_test(study, rows).filter(|(_, own)| {
        let parts = [Subject::Pinion, Subject::Gear]
            .into_iter()
            .flat_map(|member| {
                [Quantity::WearDepth, Quantity::MassLoss]
                    .map(|quantity| losses(own, member, quantity))
            });
        let parts: Vec<Vec<Loss>> = parts.filter(|part| part.len() >= SEVERAL).collect();
        follow_intervals(&parts)
    });
    let tests: Vec<&str> = tests.map(|(id, _)| id).collect();
    // one among others may have worn so by a cause of its own
    if tests.len() == 1 && by_test(study, rows).count() > 1 {
        return None;
    }
    (!tests.is_empty()).then(|| {
        format!(
            "what was lost in test{} {} grows with the interval between two measurements, not with the cycles since the start: does it count from the \
             measurement before? Losses since the start of the test are wanted (gearwear import --per-interval adds them up)",
            if tests.len() > 1 { "s" } else { "" },
            tests.join(", ")
        )
    })
}

/// Whether the losses of a test, by rising cycles for each member and quantity, follow the intervals.
fn follow_intervals(parts: &[Vec<Loss>]) -> bool {
    let known = |part: &Vec<Loss>| part.iter().filter(|loss| loss.sigma.is_finite()).count();
    let freedom: usize = parts.iter().map(|part| known(part) - 1).sum();
    let chi2 = |part: &Vec<Loss>| {
        let totals: Vec<f64> = part.iter().map(|loss| loss.model).collect();
        let before = std::iter::once(0.0).chain(totals.iter().copied());
        let intervals: Vec<f64> = totals.iter().zip(before).map(|(n, b)| n - b).collect();
        [misfit(part, &totals), misfit(part, &intervals)]
    };
    let each: Vec<[f64; 2]> = parts.iter().map(chi2).collect();
    let [totals, intervals] = [0, 1].map(|i| each.iter().map(|of| of[i]).sum::<f64>());
    parts.len() >= TWICE
        && each.iter().all(|[totals, intervals]| intervals < totals)
        && totals > OFF * freedom as f64
        && intervals < FOLLOWS * freedom as f64
        && totals > RATIO * intervals
}

/// χ² of losses in proportion to these.
fn misfit(part: &[Loss], expected: &[f64]) -> f64 {
    let weight = |loss: &Loss| (loss.sigma.powi(2) + (LACKING * loss.measured).powi(2)).recip();
    let pairs = || part.iter().zip(expected);
    let (mut ff, mut fy) = (0.0, 0.0);
    for (loss, f) in pairs() {
        ff += weight(loss) * f * f;
        fy += weight(loss) * f * loss.measured;
    }
    let factor = fy / ff;
    pairs()
        .map(|(loss, f)| weight(loss) * (loss.measured - factor * f).powi(2))
        .sum()
}

/// A member's losses by one quantity, by rising cycles; none where fewer than [`SEVERAL`] of them are sure. What a trace does not show counts with an
/// infinite σ: the interval after it begins there all the same.
fn losses(rows: &[FittedRow<'_>], member: Subject, quantity: Quantity) -> Vec<Loss> {
    let own = rows
        .iter()
        .filter(|(o, _)| (o.member, o.quantity) == (member, quantity) && o.cycles > 0.0);
    let mut own: Vec<FittedRow<'_>> = own.copied().collect();
    own.sort_by(|a, b| a.0.cycles.total_cmp(&b.0.cycles));
    let moments = own.chunk_by(|a, b| b.0.cycles - a.0.cycles < SAME_CYCLES * b.0.cycles);
    let loss = |moment: &[FittedRow<'_>]| match quantity {
        Quantity::WearDepth => {
            let model = moment.iter().map(|(_, row)| row.model).fold(0.0, f64::max);
            let shown = scale(moment, quantity, Some(member)).filter(|s| s.explains > EXPLAINS);
            let [measured, sigma] = shown.map_or([0.0, f64::INFINITY], |s| {
                let measured = s.factor * model;
                [measured, measured / s.sigmas]
            });
            Some(Loss {
                measured,
                sigma,
                model,
            })
        }
        _ => {
            let (o, row) = moment.first()?;
            (o.value > SURE * o.sigma && row.model > 0.0).then_some(Loss {
                measured: o.value,
                sigma: o.sigma,
                model: row.model,
            })
        }
    };
    let all = moments.map(loss).collect::<Option<Vec<Loss>>>();
    let is_sure = |loss: &&Loss| loss.measured > SURE * loss.sigma;
    all.filter(|all| all.iter().filter(is_sure).count() >= SEVERAL)
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Intervals of 80, 320 and 400 thousand cycles, 2 % of noise, on both members: by increments, by totals, and by totals of wear that runs in.
    #[test]
    fn losses_that_follow_the_intervals_are_told_from_totals() {
        let of = |worn: [f64; 3]| {
            let part = || {
                let models = [0.8, 4.0, 8.0].into_iter();
                let losses = models.zip(worn).map(|(model, measured)| Loss {
                    measured,
                    sigma: 0.02 * measured,
                    model,
                });
                losses.collect::<Vec<Loss>>()
            };
            follow_intervals(&[part(), part()])
        };
        assert!(of([0.82, 3.15, 4.05]));
        assert!(!of([0.82, 3.95, 8.1]));
        // 1 + 2.5 exp(−n/120 000)
        assert!(!of([2.26, 6.89, 11.0]));
        // a layer that is gone after the first 80 000
        assert!(!of([4.0, 7.2, 11.2]));
    }

    /// A moment whose traces show nothing counts nothing, but ends an interval: what is lost after it is that of the last 160 thousand cycles.
    #[test]
    fn a_moment_that_is_not_seen_still_ends_an_interval() {
        let of = |worn: [f64; 3]| {
            let part = || {
                let seen = |model: f64, measured: f64| Loss {
                    measured,
                    sigma: 0.02 * measured,
                    model,
                };
                let unseen = Loss {
                    measured: 0.0,
                    sigma: f64::INFINITY,
                    model: 2.4,
                };
                vec![
                    seen(0.8, worn[0]),
                    unseen,
                    seen(4.0, worn[1]),
                    seen(8.0, worn[2]),
                ]
            };
            follow_intervals(&[part(), part()])
        };
        assert!(of([0.82, 1.58, 4.05]));
        assert!(!of([0.82, 3.15, 4.05]));
        assert!(!of([0.82, 3.95, 8.1]));
    }
}
