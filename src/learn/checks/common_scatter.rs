//! Whether the scatter along a flank is the same at all checkpoints, as that of one new profile is from which all worn ones were taken off.
//!
//! ```text
//! d: second differences of measured minus model, each over the length of its weights ([`second_differences`](super::second_differences))
//! T = median(d²)/0.4549 = σ² + τ²      W = median((d − d')²/2)/0.4549 = σ²      d': the same three places at the next checkpoint
//! τ² = T − W
//! ```
//! σ: scatter of each profile; τ: of what they share. A misfit is shared too, but it is smooth along the flank, and neighbouring d have one sign
//! then: those of scatter are correlated by −2/3, and 73 % of neighbours differ in sign. Where places lie so far apart that a misfit is not smooth
//! among them, it still is alike in tests that were measured at the same places; new profiles are not.

use std::collections::BTreeMap;

use super::second_differences::differences as second_differences;
use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::fitting::fitted::Fit;
use crate::measure::{Dataset, FacePlace, Observation, Quantity, Surface, surfaces};
use crate::numeric::median;
use crate::study::{Role, Study};

/// Places with two checkpoints and more that are needed for an estimate.
const LEAST: usize = 100;
/// Median of χ² with one degree of freedom.
const MEDIAN: f64 = 0.454_936;
/// Share of τ² in σ² + τ² from which the scatter is called shared: three standard errors of a hundred places.
const SHARED: f64 = 0.35;
/// Share of neighbouring differences of opposite sign from which they are scatter, not something smooth.
const ROUGH: f64 = 0.62;

/// Correlation of two tests' differences at the same places, and its standard deviations under chance, from which what they share is no scatter.
const ALIKE: f64 = 0.3;
const ALIKE_SIGMAS: f64 = 3.0;

/// Standard deviation of the scatter that all checkpoints share, µm; None where too little was measured to tell, or there is none.
pub(in crate::learn) fn shared_scatter(likelihood: &Likelihood<'_>, model: &[f64]) -> Option<f64> {
    let rows = likelihood.observations();
    shared_of(&rows, &likelihood.residual(model))
}

/// The same in words, of the base `model`.
pub(in crate::learn) fn counted(likelihood: &Likelihood<'_>, model: &[f64], um: f64) -> String {
    let rows = likelihood.observations();
    if are_alike(&rows, &likelihood.residual(model)) {
        return format!(
            "neighbouring points scatter by {} µm in the same way at all checkpoints of a flank, and alike in all tests: so does what the model misses \
             where it bends between points that lie far apart. It was counted as noise here; a finer trace would tell",
            digits(um)
        );
    }
    format!(
        "{}. It was counted so here; `[noise] new_profile` makes every command do so",
        in_words(um)
    )
}

/// The same about a fit, in words, where the study expects less and tests do not have it alike.
pub fn scatter_of_new_profile(study: &Study, data: &Dataset, fit: &Fit) -> Option<String> {
    let fitted = |row: &usize| study.tests[data.observations[*row].test].role == Role::Fit;
    let of_fit: Vec<usize> = (0..data.observations.len()).filter(fitted).collect();
    let rows: Vec<&Observation> = of_fit.iter().map(|&row| &data.observations[row]).collect();
    let residual = (of_fit.iter().zip(&rows)).map(|(&row, o)| fit.rows[row].standardised * o.sigma);
    let residual = residual.collect::<Vec<f64>>();
    let found = shared_of(&rows, &residual)?;
    (study.noise.new_profile_um == 0.0 && !are_alike(&rows, &residual)).then(|| {
        format!(
            "{}; `[noise] new_profile = {}` counts it so for every command, beside the sigma of each worn profile",
            in_words(found),
            digits(found)
        )
    })
}

/// A shared scatter in words.
fn in_words(um: f64) -> String {
    format!(
        "neighbouring points scatter by {} µm in the same way at all checkpoints of a flank, as they do where one new profile was taken off all worn \
         ones: that is no wear, and no column sigma tells it",
        digits(um)
    )
}

/// With two digits.
fn digits(um: f64) -> String {
    let decimals = (1.0 - um.log10().floor()).max(0.0) as usize;
    format!("{um:.decimals$}")
}

/// Share of a row's variance that is left without the mean of its place, at least: a row much more exact than the others is nearly that mean.
const LEAST_SHARE: f64 = 0.05;

/// Differences of one flank's three places at all checkpoints, with the standard deviation that the rows' sigmas give each.
type AtThree = BTreeMap<u64, (f64, f64)>;
/// A surface, line across the face and tooth, which have a new profile of their own.
type Flank = (Surface, Option<u64>, Option<String>);
/// The differences of every flank by the places, nm.
type Flanks = BTreeMap<Flank, BTreeMap<[i64; 3], AtThree>>;

/// The same of a residual.
pub(super) fn shared_of(rows: &[&Observation], residual: &[f64]) -> Option<f64> {
    let flanks = differences(rows, residual);
    let (mut single, mut between) = (Vec::new(), Vec::new());
    let (mut opposite, mut neighbours, mut places) = (0usize, 0usize, 0usize);
    for flank in flanks.values() {
        let mut before: Option<f64> = None;
        for at_three in flank.values() {
            let values: Vec<f64> = at_three.values().map(|d| d.0).collect();
            if values.len() < 2 {
                before = None;
                continue;
            }
            places += 1;
            single.extend(values.iter().map(|d| d * d));
            between.extend(values.windows(2).map(|two| 0.5 * (two[0] - two[1]).powi(2)));
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            if let Some(before) = before {
                neighbours += 1;
                opposite += usize::from(before * mean < 0.0);
            }
            before = Some(mean);
        }
    }
    if places < LEAST || neighbours == 0 || (opposite as f64) < ROUGH * (neighbours as f64) {
        return None;
    }
    let (total, own) = (median(single)? / MEDIAN, median(between)? / MEDIAN);
    (total - own > SHARED * total).then(|| (total - own).sqrt())
}

/// Whether tests have correlated differences of a residual at the same places.
fn are_alike(rows: &[&Observation], residual: &[f64]) -> bool {
    let flanks = differences(rows, residual);
    let mut places: BTreeMap<_, Vec<f64>> = BTreeMap::new();
    for (((_, member, ..), line, tooth), flank) in &flanks {
        for (three, at_three) in flank {
            let in_sigmas = at_three.values().map(|(d, sigma)| d / sigma).sum::<f64>();
            let tests = places.entry((member, line, tooth, three)).or_default();
            tests.push(in_sigmas / at_three.len() as f64);
        }
    }
    let (mut both, mut first, mut second, mut pairs) = (0.0, 0.0, 0.0, 0usize);
    for tests in places.values() {
        for (i, one) in tests.iter().enumerate() {
            for other in &tests[..i] {
                both += one * other;
                first += one.powi(2);
                second += other.powi(2);
                pairs += 1;
            }
        }
    }
    let correlation = both / (first * second).sqrt();
    correlation > ALIKE.max(ALIKE_SIGMAS / (pairs as f64).sqrt())
}

/// Of all flanks; where a checkpoint has several curves at the same places, the last.
fn differences(rows: &[&Observation], residual: &[f64]) -> Flanks {
    let surfaces = surfaces(rows);
    let mut flanks = Flanks::new();
    for difference in second_differences(rows, residual) {
        let first = rows[difference.rows[0]];
        if first.quantity != Quantity::WearDepth {
            continue;
        }
        let flank = flank(surfaces[difference.rows[0]], first);
        // the same places to a nanometre
        let places = difference.rows.map(|row| nanometres(rows[row]));
        let at_three = flanks.entry(flank).or_default().entry(places).or_default();
        let length = difference.weights.iter().map(|w| w * w).sum::<f64>().sqrt();
        let own = (difference.weights.iter().zip(&difference.rows))
            .map(|(w, &row)| (w * rows[row].sigma).powi(2));
        let sigma = own.sum::<f64>().sqrt();
        at_three.insert(
            first.cycles.to_bits(),
            (difference.value / length, sigma / length),
        );
    }
    flanks
}

fn flank(surface: Surface, o: &Observation) -> Flank {
    (surface, o.face.map(FacePlace::key), o.tooth.clone())
}

fn nanometres(o: &Observation) -> i64 {
    (o.position.unwrap_or(0.0) * 1e6).round() as i64
}

/// A residual without what all checkpoints of a place share, a scatter of so many µm, scaled so that independent scatter of the stated σ keeps its size.
///
/// ```text
/// r_i − Σ w r/Σ w      w = 1/σ²      variance σ_i² − 1/Σ w
/// r_i                  of a row alone at its place, variance σ_i² + τ²
/// ```
pub(in crate::learn) fn without_shared(
    rows: &[&Observation],
    residual: &[f64],
    shared_um: f64,
) -> Vec<f64> {
    let mut places: BTreeMap<_, Vec<usize>> = BTreeMap::new();
    for (i, (surface, o)) in surfaces(rows).into_iter().zip(rows).enumerate() {
        if o.quantity == Quantity::WearDepth && o.position.is_some() {
            let place = (flank(surface, o), nanometres(o));
            places.entry(place).or_default().push(i);
        }
    }
    let mut left = residual.to_vec();
    for at in places.values() {
        if let [alone] = at[..] {
            let sigma = rows[alone].sigma;
            left[alone] *= sigma / sigma.hypot(shared_um);
            continue;
        }
        let weight = |i: usize| rows[i].sigma.powi(-2);
        let weights: f64 = at.iter().map(|&i| weight(i)).sum();
        let mean = at.iter().map(|&i| weight(i) * residual[i]).sum::<f64>() / weights;
        for &i in at {
            let share = (1.0 - weight(i) / weights).max(LEAST_SHARE);
            left[i] = (residual[i] - mean) / share.sqrt();
        }
    }
    left
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::{Rng, SeedableRng};

    use super::*;
    use crate::measure::Subject;

    /// Four checkpoints of two flanks of 70 points each: scatter of 0.1 of their own, `shared` of the new profile, and a smooth misfit of this size.
    fn flanks(shared: f64, misfit: f64) -> (Vec<Observation>, Vec<f64>) {
        let mut random = ChaCha8Rng::seed_from_u64(11);
        let mut uniform = || 1.0 - (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        let mut normal = || (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        let (mut rows, mut residual) = (Vec::new(), Vec::new());
        for member in [Subject::Pinion, Subject::Gear] {
            let new: Vec<f64> = (0..70).map(|_| shared * normal()).collect();
            for (checkpoint, trace) in [1e5, 2e5, 4e5, 8e5].into_iter().enumerate() {
                for (i, new) in new.iter().enumerate() {
                    let s = i as f64 / 70.0;
                    let smooth = misfit * (checkpoint as f64 + 1.0) * (9.0 * s).sin();
                    residual.push(smooth + new + 0.1 * normal());
                    rows.push(Observation {
                        test: 0,
                        member,
                        cycles: trace,
                        quantity: Quantity::WearDepth,
                        position: Some(24.0 + s),
                        value: 1.0,
                        sigma: 0.1,
                        trace: Some(2 * checkpoint + usize::from(member == Subject::Gear)),
                        line: 0,
                        face: None,
                        tooth: None,
                    });
                }
            }
        }
        (rows, residual)
    }

    /// Two tests at the same places: what they have alike is no scatter of their new profiles, one that is the pinion's here and the gear's there is.
    #[test]
    fn what_all_tests_share_is_told_from_scatter() {
        let (rows, residual) = flanks(0.2, 0.0);
        let (_, others) = flanks(0.2, 1.0);
        let half = rows.len() / 2;
        let with = |second: &[f64]| {
            let moved = rows.iter().cloned().map(|o| Observation { test: 1, ..o });
            let all: Vec<Observation> = rows.iter().cloned().chain(moved).collect();
            let residual = [&residual[..], second].concat();
            are_alike(&all.iter().collect::<Vec<_>>(), &residual)
        };
        assert!(with(&others));
        let exchanged = [&others[half..], &others[..half]].concat();
        assert!(!with(&exchanged));
    }

    fn found(shared: f64, misfit: f64) -> Option<f64> {
        let (rows, residual) = flanks(shared, misfit);
        shared_of(&rows.iter().collect::<Vec<_>>(), &residual)
    }

    #[test]
    fn scatter_that_checkpoints_share_is_found_by_its_size() {
        for shared in [0.1, 0.2] {
            for misfit in [0.0, 1.0] {
                let found = found(shared, misfit).unwrap();
                assert!((found / shared - 1.0).abs() < 0.25, "{found} of {shared}");
            }
        }
    }

    /// Scatter of each profile alone, and a smooth misfit far larger than it, are no scatter of the new profile.
    #[test]
    fn what_is_smooth_or_each_profiles_own_is_not() {
        for misfit in [0.0, 1.0, 10.0, 300.0] {
            assert_eq!(found(0.0, misfit), None, "misfit {misfit}");
        }
    }

    /// What is left without the shared part scatters as each profile does.
    #[test]
    fn without_the_shared_part_the_own_scatter_is_left() {
        let (rows, residual) = flanks(0.3, 0.0);
        let left = without_shared(&rows.iter().collect::<Vec<_>>(), &residual, 0.3);
        let square = left.iter().map(|r| r * r).sum::<f64>() / left.len() as f64;
        assert!((square.sqrt() / 0.1 - 1.0).abs() < 0.1, "{}", square.sqrt());
    }

    /// Scatter that grows over the checkpoints: each keeps its own size.
    #[test]
    fn without_the_shared_part_each_checkpoint_keeps_its_scatter() {
        let (mut rows, mut residual) = flanks(0.0, 0.0);
        let (_, with) = flanks(0.3, 0.0);
        for ((o, r), with) in rows.iter_mut().zip(&mut residual).zip(with) {
            let shared = with - *r;
            let grown = (o.cycles / 1e5).sqrt();
            o.sigma = 0.1 * grown;
            *r = shared + grown * *r;
        }
        let left = without_shared(&rows.iter().collect::<Vec<_>>(), &residual, 0.3);
        for cycles in [1e5, 2e5, 4e5, 8e5] {
            let own = || (rows.iter().zip(&left)).filter(|(o, _)| o.cycles == cycles);
            let square = own().map(|(o, r)| (r / o.sigma).powi(2)).sum::<f64>();
            let size = (square / own().count() as f64).sqrt();
            assert!((size - 1.0).abs() < 0.15, "{size} after {cycles}");
        }
    }

    /// One checkpoint alone: nothing to take off, but less is the profile's own.
    #[test]
    fn a_row_alone_at_its_place_keeps_its_own_part() {
        let (rows, residual) = flanks(0.3, 0.0);
        let first: Vec<usize> = (0..rows.len()).filter(|&i| rows[i].cycles == 1e5).collect();
        let own: Vec<&Observation> = first.iter().map(|&i| &rows[i]).collect();
        let of_own: Vec<f64> = first.iter().map(|&i| residual[i]).collect();
        let left = without_shared(&own, &of_own, 0.3);
        let square = left.iter().map(|r| r * r).sum::<f64>() / left.len() as f64;
        assert!(
            (square.sqrt() / 0.1 - 1.0).abs() < 0.15,
            "{}",
            square.sqrt()
        );
    }

    #[test]
    fn a_size_is_shown_with_two_digits() {
        assert_eq!(digits(0.314_15), "0.31");
        assert_eq!(digits(0.031_4), "0.031");
        assert_eq!(digits(31.4), "31");
    }
}
