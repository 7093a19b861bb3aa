//! A single depth curve whose size stands apart from the growth of its series: another gain of the trace, a wrong label, a mean of other teeth.
//!
//! ```text
//! ln size ≈ a + b ln N       size: N times the scale that takes the model to a curve, its datum removed
//! ```
//! Sizes stand apart from that as weighings do from theirs: curves are off by a factor, the first as well as the last.

use std::collections::BTreeMap;

use super::super::residual_statistics::FittedRow;
use super::standing_apart::{Law, Series, farthest};
use super::{EXPLAINS, Scale, scale};
use crate::measure::{Quantity, Subject};
use crate::numeric::written;
use crate::study::Study;

/// Least part of its size that a curve is off: what the model lacks may be less.
const LEAST: f64 = 0.15;

/// How the sizes of curves grow, in logarithms.
const OF_SIZES: Law = Law {
    basis: |log_cycles| [1.0, log_cycles],
    is_off: |size, expected| (size - expected).abs() > LEAST,
};

/// A question about the curve that stands farthest apart.
pub(super) fn odd_curve(study: &Study, rows: &[FittedRow<'_>]) -> Option<String> {
    let mut curves: BTreeMap<(usize, Subject, u64), Vec<FittedRow<'_>>> = BTreeMap::new();
    let depths = rows
        .iter()
        .filter(|(o, _)| o.quantity == Quantity::WearDepth);
    for row in depths.filter(|(o, _)| o.cycles > 0.0) {
        let (o, _) = row;
        let own = curves.entry((o.test, o.member, o.cycles.to_bits()));
        own.or_default().push(*row);
    }
    let mut all: BTreeMap<(usize, Subject), Series> = BTreeMap::new();
    for ((test, member, cycles), own) in curves {
        let found = scale(&own, Quantity::WearDepth, Some(member));
        // a curve without a size of its own leaves a series without it
        let is_worn = |found: &Scale| found.explains > EXPLAINS && found.factor > 0.0;
        if let Some(found) = found.filter(is_worn) {
            let log = f64::from_bits(cycles).ln();
            let own = all.entry((test, member)).or_default();
            own.push([log, log + found.factor.ln()]);
        }
    }
    let (whose, series): (Vec<(usize, Subject)>, Vec<Series>) = all.into_iter().unzip();
    let odd = farthest(&series, &OF_SIZES)?;
    let ((test, member), [log_cycles, size]) = (whose[odd.series], series[odd.series][odd.at]);
    Some(format!(
        "wear_depth of the {} in test {} after {} cycles is {} times what its curves at other cycles lead to, {:.0} times as far off as curves scatter: look at \
         this curve first (the gain of its trace, the tooth and the checkpoint that it is of)",
        member.name(),
        study.tests[test].id,
        written::count(log_cycles.exp().round()),
        written::significant((size - odd.expected).exp(), 2),
        odd.scatters
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Dataset;

    /// What is asked where one curve of test A's pinion is `times` as large as wear that slows down.
    fn said(times: f64) -> Option<String> {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let mut text = "test,member,cycles,quantity,position,value,sigma\n".to_owned();
        let mut models = Vec::new();
        let mut noise = [0.3, -0.5, 0.1, 0.4, -0.2, -0.4, 0.2].into_iter().cycle();
        for (test, member) in [
            ("A", "pinion"),
            ("A", "gear"),
            ("B", "pinion"),
            ("B", "gear"),
        ] {
            for part in 1..5 {
                let cycles = 50_000 * part;
                let n = f64::from(part) / 4.0;
                let is_odd = test == "A" && member == "pinion" && part == 3;
                for (place, shape) in [2.0, 1.0, 0.2, 0.7, 1.5].into_iter().enumerate() {
                    let radius = if member == "pinion" { 26.2 } else { 51.7 } + 0.6 * place as f64;
                    let model = 6.0 * n * shape;
                    let size = if is_odd { times } else { 1.0 };
                    let value = size * model * (1.15 - 0.15 * n) + 0.1 * noise.next().unwrap();
                    text += &format!("{test},{member},{cycles},wear_depth,{radius},{value},0.1\n");
                    models.push(model);
                }
            }
        }
        let data = Dataset::parse(&text, "m.csv", &study.known()).unwrap();
        let fits = super::super::fits_of(&models);
        let rows: Vec<FittedRow<'_>> = data.observations.iter().zip(&fits).collect();
        odd_curve(&study, &rows)
    }

    #[test]
    fn a_curve_that_is_a_third_too_large_is_asked_about() {
        let said = said(1.33).unwrap();
        assert!(
            said.contains("of the pinion in test A after") && said.contains("is 1.3 times"),
            "{said}"
        );
    }

    #[test]
    fn curves_that_slow_down_alike_are_not() {
        assert_eq!(said(1.0), None);
        assert_eq!(said(1.1), None);
    }
}
