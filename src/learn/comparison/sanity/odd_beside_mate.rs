//! A single depth curve whose size stands apart from that of the other member's curve of the same moment: what tells where series are too short for their
//! own growth ([`super::odd_curves`]).
//!
//! ```text
//! d = ln size_pinion − ln size_gear of each moment of each test;  s = 1.48 median |d − median d|
//! |d − median d| > max(8 s, ln 1.5) at one moment, < max(4.5 s, ln 1.15) at all others
//! ```

use std::collections::BTreeMap;

use super::standing_apart::{ALIKE, APART, Series};
use crate::measure::Subject;
use crate::numeric::{MEDIAN_OF_NORMAL, median, written};
use crate::study::Study;

/// Factor by which a curve must be off from what the other member's leads to, for a layer of one member may be worn through at one moment
/// only; the factor up to which the other curves are alike, and their fewest moments.
const LEAST_FACTOR: f64 = 1.5;
const ALIKE_FACTOR: f64 = 1.15;
const FEWEST_MOMENTS: usize = 6;
/// Part of the deviation that the curve which is not meant may be off from its own series.
const MUCH_LESS: f64 = 0.4;

/// ln cycles and ln size, by test and member.
type Sizes = BTreeMap<(usize, Subject), Series>;

/// A moment of a test at which both members were measured.
struct Moment {
    test: usize,
    log_cycles: f64,
    /// ln of the pinion's size over the gear's, less the median of all moments.
    apart: f64,
}

/// A question about the curve that stands apart.
pub(super) fn odd_beside_mate(study: &Study, all: &Sizes) -> Option<String> {
    let mut moments = moments(all)?;
    moments.sort_by(|a, b| b.apart.abs().total_cmp(&a.apart.abs()));
    let [odd, next, ..] = &moments[..] else {
        return None;
    };
    let magnitudes = moments.iter().map(|moment| moment.apart.abs());
    let scatter = median(magnitudes.collect())? / MEDIAN_OF_NORMAL;
    let is_apart = odd.apart.abs() > (APART * scatter).max(LEAST_FACTOR.ln());
    let are_alike = next.apart.abs() < (ALIKE * scatter).max(ALIKE_FACTOR.ln());
    if moments.len() < FEWEST_MOMENTS || !is_apart || !are_alike {
        return None;
    }
    let off = |member| off_its_series(&all[&(odd.test, member)], odd.log_cycles);
    let (of_pinion, of_gear) = (off(Subject::Pinion)?, off(Subject::Gear)?);
    let (whose, log_times) = if of_gear < MUCH_LESS * of_pinion {
        ("the pinion", odd.apart)
    } else if of_pinion < MUCH_LESS * of_gear {
        ("the gear", -odd.apart)
    } else {
        ("one of the members", odd.apart.abs())
    };
    Some(format!(
        "wear_depth of {whose} in test {} after {} cycles is {} times what the other member's curve of the same moment leads to, where all other curves of the \
         two members agree within {:.0} %: look at this curve first (the gain of its trace, the tooth and the checkpoint that it is of)",
        study.tests[odd.test].id,
        written::count(odd.log_cycles.exp().round()),
        written::significant(log_times.exp(), 2),
        (100.0 * (next.apart.abs().exp() - 1.0)).ceil()
    ))
}

/// All moments at which both members have a size; none without any.
fn moments(all: &Sizes) -> Option<Vec<Moment>> {
    let mut found = Vec::new();
    for ((test, member), pinion) in all {
        let gear = all.get(&(*test, Subject::Gear));
        let (Subject::Pinion, Some(gear)) = (member, gear) else {
            continue;
        };
        for &[log_cycles, size] in pinion {
            let mate = gear.iter().find(|[at, _]| *at == log_cycles);
            found.extend(mate.map(|[_, of_gear]| Moment {
                test: *test,
                log_cycles,
                apart: size - of_gear,
            }));
        }
    }
    let middle = median(found.iter().map(|moment| moment.apart).collect())?;
    for moment in &mut found {
        moment.apart -= middle;
    }
    Some(found)
}

/// How far the size at these cycles is, per cycle and in logarithms, from the series' other ones: two others lead to a line that is soon far off.
fn off_its_series(own: &Series, log_cycles: f64) -> Option<f64> {
    let (at, others): (Vec<[f64; 2]>, Vec<[f64; 2]>) =
        own.iter().partition(|[at, _]| *at == log_cycles);
    let rate = |[at, size]: &[f64; 2]| size - at;
    let others = median(others.iter().map(rate).collect())?;
    Some((rate(at.first()?) - others).abs())
}
