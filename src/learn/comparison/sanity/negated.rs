//! Single depth curves of which the sign is the other one.
//!
//! ```text
//! y ≈ c + s f of a curve      f the fitted model; s < 0, most of y negative, where the flank's other curves have s > 0 and are not
//! ```
//! A zero of its own shifts a curve but does not turn it; a curve upside down is not negative.

use std::collections::BTreeMap;

use super::super::residual_statistics::FittedRow;
use super::{EXPLAINS, scale};
use crate::measure::{FacePlace, Quantity};
use crate::study::Study;

/// Standard deviations of s below 0, and of a value, from which the sign is doubted.
const SURE: f64 = 6.0;
const BEYOND_NOISE: f64 = 2.0;
/// Share of a curve's values that must be negative.
const MOST: f64 = 0.5;

/// A line for each curve that is negative where the others of its flank are not.
pub(super) fn negated(study: &Study, rows: &[FittedRow<'_>]) -> Vec<String> {
    let mut flanks: BTreeMap<_, BTreeMap<_, Vec<FittedRow<'_>>>> = BTreeMap::new();
    let depths = rows
        .iter()
        .filter(|(o, _)| o.quantity == Quantity::WearDepth && o.cycles > 0.0);
    for &(o, row) in depths {
        let curve = (
            o.cycles.to_bits(),
            o.trace,
            o.face.map(FacePlace::key),
            o.tooth.as_deref(),
        );
        let flank = flanks.entry((o.test, o.member)).or_default();
        flank.entry(curve).or_default().push((o, row));
    }
    let mut said = Vec::new();
    for ((test, member), curves) in flanks {
        let turned: Vec<&Vec<FittedRow<'_>>> = curves.values().filter(|c| is_turned(c)).collect();
        // more are the flank's, which is told of the whole
        if 2 * turned.len() >= curves.len() {
            continue;
        }
        for curve in turned {
            said.push(format!(
                "in test {} wear_depth of the {} after {} cycles has the other sign than the flank's other curves: lost material counts positive. Turn \
                 the sign of these values and compare again",
                study.tests[test].id,
                member.name(),
                curve[0].0.cycles
            ));
        }
    }
    said
}

/// Whether a curve is negative and runs against the computed one.
fn is_turned(curve: &[FittedRow<'_>]) -> bool {
    let negative = curve
        .iter()
        .filter(|(o, _)| o.value < -BEYOND_NOISE * o.sigma)
        .count();
    negative as f64 > MOST * curve.len() as f64
        && scale(curve, Quantity::WearDepth, None)
            .is_some_and(|s| s.sigmas < -SURE && s.explains > EXPLAINS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Dataset;

    /// What is said of three curves of a flank, each a factor times the model's and a zero of its own, the last one upside down if asked for.
    fn said(factors: [f64; 3], zero: f64, upside_down: bool) -> Vec<String> {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let shape = [8.0, 6.0, 4.0, 3.0, 2.0, 1.0];
        let mut text = "test,member,cycles,quantity,position,value,sigma,trace\n".to_owned();
        let mut models = Vec::new();
        for (i, factor) in factors.into_iter().enumerate() {
            for (at, model) in shape.into_iter().enumerate() {
                let place = 27.0 + 0.2 * at as f64;
                let shown = if upside_down && i == 2 {
                    shape[5 - at]
                } else {
                    model
                };
                let value = factor * shown + zero;
                text += &format!(
                    "A,pinion,{}00000,wear_depth,{place},{value},0.1,t{i}\n",
                    i + 1
                );
                models.push(model);
            }
        }
        let data = Dataset::parse(&text, "m.csv", &study.known()).unwrap();
        let fits = super::super::fits_of(&models);
        let rows: Vec<FittedRow<'_>> = data.observations.iter().zip(&fits).collect();
        negated(&study, &rows)
    }

    #[test]
    fn one_curve_of_the_other_sign_is_told() {
        let told = said([1.0, -1.0, 1.0], 0.3, false);
        assert_eq!(told.len(), 1);
        assert!(
            told[0].starts_with(
                "in test A wear_depth of the pinion after 200000 cycles has the other sign"
            ),
            "{told:?}"
        );
    }

    #[test]
    fn shifted_and_turned_curves_are_not() {
        assert!(said([1.0, 1.0, 1.0], 0.3, false).is_empty());
        assert!(said([1.0, 1.0, 1.0], -20.0, false).is_empty());
        assert!(said([1.0, 1.0, 1.0], 0.0, true).is_empty());
        assert!(said([-1.0, -1.0, -1.0], 0.0, false).is_empty());
    }
}
