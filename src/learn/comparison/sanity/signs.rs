//! Quantities that run against the computed ones.
//!
//! ```text
//! s of a quantity's values y ≈ s·f + c_trace, f: computed      the other sign: s < 0, and s·f explains more than half of what is measured
//! ```
//! Where something else is missing s·f explains less in some tests; their depths are turned too if s is surely below 0 there and nowhere surely
//! above. Where most depths are positive they are not called turned: along another gear's flank, or at other places, right ones run against the computed.

use super::super::residual_statistics::FittedRow;
use super::single_tests::by_test;
use super::{EXPLAINS, scale};
use crate::measure::{Quantity, Subject};
use crate::study::Study;

/// Standard deviations by which a negative loss of mass is no noise.
const GAIN_SIGMAS: f64 = 2.0;
/// The same where a model's law may turn a curve round: what stands over a rotation.
pub(super) const EXPLAINS_OVER_A_ROTATION: f64 = 0.8;
/// Share of the depths from which positive ones say that lost material counts positive.
const POSITIVE: f64 = 0.7;
/// Standard deviations of s from 0 from which a single test's sign is sure.
const SURE: f64 = 6.0;

/// What has the other sign: in all tests, or in some of them.
pub(super) fn signs(study: &Study, rows: &[FittedRow<'_>]) -> Vec<String> {
    if all_depths_are_turned(study, rows) {
        return vec![other_sign_of_depths("wear_depth", rows, None)];
    }
    of_some_tests(study, rows).unwrap_or_else(|| of_all(rows))
}

/// Whether the depths of some test run against the computed ones, and none surely with them.
fn all_depths_are_turned(study: &Study, rows: &[FittedRow<'_>]) -> bool {
    let members = [Subject::Pinion, Subject::Gear];
    let scales = by_test(study, rows)
        .flat_map(|(_, own)| members.map(|member| scale(&own, Quantity::WearDepth, Some(member))));
    let scales: Vec<super::Scale> = scales.flatten().collect();
    let is_turned = |s: &super::Scale| s.sigmas < -SURE && s.explains > EXPLAINS;
    let turned = scales.iter().filter(|s| is_turned(s)).count();
    // several, so that none is turned by a bad test alone
    turned > 1
        && scales.iter().all(|s| s.sigmas < SURE)
        && 2 * scales.iter().filter(|s| s.sigmas < -SURE).count() > scales.len()
}

fn other_sign_of_depths(whose: &str, rows: &[FittedRow<'_>], member: Option<Subject>) -> String {
    if are_positive(rows, member) {
        return format!(
            "{whose} runs against the computed depths along the flank, though its values are positive, as lost material is: are number of teeth, \
             module and profile shift of the study those of the gears that were measured, and the places what the file says they are? Or are the values \
             heights of the flank, and not depths? k and all that follows mean nothing until then"
        );
    }
    format!(
        "{whose} has the other sign: lost material counts positive, here it counts negative. Turn the sign of these values and compare again; k and all \
         that follows mean nothing until then"
    )
}

/// Whether most of the depths, of one member or of both, are positive by more than their noise.
fn are_positive(rows: &[FittedRow<'_>], member: Option<Subject>) -> bool {
    let depths = (rows.iter().map(|(o, _)| o))
        .filter(|o| o.quantity == Quantity::WearDepth && member.is_none_or(|m| m == o.member));
    let (mut all, mut positive) = (0, 0);
    for o in depths {
        all += 1;
        positive += usize::from(o.value > GAIN_SIGMAS * o.sigma);
    }
    positive as f64 > POSITIVE * f64::from(all)
}

/// Quantities of some tests that run against the computed ones; None where that is so of none or of all.
fn of_some_tests(study: &Study, rows: &[FittedRow<'_>]) -> Option<Vec<String>> {
    let turned = |quantity, member| {
        let scales: Vec<_> = by_test(study, rows)
            .filter_map(|(id, own)| Some((id, scale(&own, quantity, member)?)))
            .collect();
        let turned: Vec<&str> = scales
            .iter()
            .filter(|(_, s)| s.sigmas < -SURE && s.explains > EXPLAINS)
            .map(|(id, _)| *id)
            .collect();
        if turned.len() < scales.len() {
            turned
        } else {
            Vec::new()
        }
    };
    let [pinion, gear] =
        [Subject::Pinion, Subject::Gear].map(|member| turned(Quantity::WearDepth, Some(member)));
    let mass = ("mass_loss", turned(Quantity::MassLoss, None));
    let kinds = if pinion == gear {
        vec![("wear_depth", pinion), mass]
    } else {
        vec![
            ("wear_depth of the pinion", pinion),
            ("wear_depth of the gear", gear),
            mass,
        ]
    };
    let said: Vec<String> = (kinds.into_iter())
        .filter(|(_, tests)| !tests.is_empty())
        .map(|(whose, tests)| {
            format!(
                "{whose} has the other sign in test {} than in the others: lost material counts positive. Turn the sign of these values and compare \
                 again; k and all that follows mean nothing until then",
                tests.join(", ")
            )
        })
        .collect();
    (!said.is_empty()).then_some(said)
}

/// Whether most of the masses have grown by more than their noise.
fn gains(rows: &[FittedRow<'_>]) -> bool {
    let masses = rows.iter().map(|(o, _)| o);
    let masses: Vec<_> = masses
        .filter(|o| o.quantity == Quantity::MassLoss)
        .collect();
    let grown = masses.iter().filter(|o| o.value < -GAIN_SIGMAS * o.sigma);
    2 * grown.count() > masses.len()
}

/// Quantities that run against the computed ones in all tests together.
fn of_all(rows: &[FittedRow<'_>]) -> Vec<String> {
    let turned = |quantity, member, explains: f64| {
        scale(rows, quantity, member).is_some_and(|s| s.factor < 0.0 && s.explains > explains)
    };
    let mut said = Vec::new();
    let [pinion, gear] = [Subject::Pinion, Subject::Gear]
        .map(|member| turned(Quantity::WearDepth, Some(member), EXPLAINS));
    let whose = match (pinion, gear) {
        (true, true) => Some(("wear_depth", None)),
        (true, false) => Some(("wear_depth of the pinion", Some(Subject::Pinion))),
        (false, true) => Some(("wear_depth of the gear", Some(Subject::Gear))),
        _ => None,
    };
    if let Some((whose, member)) = whose {
        said.push(other_sign_of_depths(whose, rows, member));
    }
    if turned(Quantity::MassLoss, None, EXPLAINS) || gains(rows) {
        said.push(
            "mass_loss has the other sign: lost mass counts positive. Turn the sign of these values and compare again".to_owned(),
        );
    }
    if turned(Quantity::TransmissionError, None, EXPLAINS_OVER_A_ROTATION) {
        said.push(
            "transmission_error runs against the computed one: a gear that lags counts negative, and rotations from the pitch point in the sense of \
             the pinion's turning. Turn the sign (or the sense of the positions) and compare again"
                .to_owned(),
        );
    }
    said
}
