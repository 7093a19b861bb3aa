//! Masses without depths that look like those of one tooth: between the members they are off by the numbers of teeth.
//!
//! ```text
//! s_pinion/s_gear = z₂/z₁      both members' masses are those of one tooth, and k is far below the stated one
//!                 = z₂, 1/z₁   those of the gear, of the pinion alone
//! ```
//! Another hardness of one member may give the first ratio too, but not a small k with it; the others are beyond any hardness of one material. Of two
//! materials, steel on plastic, any ratio may be right.

use super::super::residual_statistics::FittedRow;
use super::{CLEAR_RATIO, EXPLAINS, scale};
use crate::gear::Member;
use crate::measure::{Quantity, Subject};
use crate::numeric::written;
use crate::study::Study;

/// Factor between the moduli of elasticity from which the members are of two materials.
const ALIKE: f64 = 1.5;
/// How far the ratio of both members may be from that of the numbers of teeth, and of one member from its number.
const NEAR_RATIO: f64 = 0.1;
const NEAR_NUMBER: f64 = 0.25;
/// Factor below the stated k from which masses of one tooth are the likelier reason: a stated one is rarely off by so much, teeth are more.
const FAR_BELOW: f64 = 5.0;

/// The question; `k`: the fitted one.
pub(super) fn masses_of_one_tooth(study: &Study, rows: &[FittedRow<'_>], k: f64) -> Option<String> {
    let members = [Subject::Pinion, Subject::Gear];
    let [pinion, gear] =
        Member::BOTH.map(|member| study.materials.of(member).elastic.youngs_modulus);
    let are_alike = (pinion / gear).ln().abs() < ALIKE.ln();
    // beside depths these tell
    let has_depths = (rows.iter()).any(|(o, _)| o.quantity == Quantity::WearDepth);
    if has_depths || !are_alike {
        return None;
    }
    let [pinion, gear] = members.map(|member| {
        let mass = scale(rows, Quantity::MassLoss, Some(member))?;
        (mass.explains > EXPLAINS && mass.factor > 0.0).then_some(mass.factor)
    });
    let ratio = pinion? / gear?;
    let [z1, z2] = [&study.gears.pinion, &study.gears.gear].map(|g| f64::from(g.spec.teeth));
    let off = |wanted: f64| (ratio / wanted).ln().abs();
    let is_low = k * pinion?.max(gear?) * FAR_BELOW < study.wear.coefficient;
    let can_tell = (z2 / z1).ln().abs() > CLEAR_RATIO.ln();
    let (whose, teeth) = if can_tell && is_low && off(z2 / z1) < NEAR_RATIO {
        (
            "masses look like those of one tooth of either member",
            "the numbers of teeth",
        )
    } else if off(z2) < NEAR_NUMBER {
        (
            "gear's masses look like those of one tooth",
            "the gear's number of teeth",
        )
    } else if off(z1.recip()) < NEAR_NUMBER {
        (
            "pinion's masses look like those of one tooth",
            "the pinion's number of teeth",
        )
    } else {
        return None;
    };
    Some(format!(
        "the {whose}: by its masses the pinion wears with {} times the gear's coefficient, which is what {teeth} would make of equal ones; the loss of all \
         teeth is wanted",
        written::significant(ratio, 2)
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Dataset;

    /// What is asked of weighings of 27 and 53 teeth, as many times the model's.
    fn said(times: [f64; 2]) -> Option<String> {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        said_in(&Study::parse(study, "study.toml").unwrap(), times)
    }

    fn said_in(study: &Study, times: [f64; 2]) -> Option<String> {
        let mut text = "test,member,cycles,quantity,position,value,sigma\n".to_owned();
        let mut models = Vec::new();
        for (member, times) in ["pinion", "gear"].into_iter().zip(times) {
            for i in 1..6 {
                let (cycles, model) = (100_000 * i, 50.0 * f64::from(i));
                // as weighed
                let value = times * model * (1.0 + 0.02 * f64::from(i % 2));
                text += &format!("A,{member},{cycles},mass_loss,,{value},{}\n", 0.02 * value);
                models.push(model);
            }
        }
        let data = Dataset::parse(&text, "m.csv", &study.known()).unwrap();
        let fits = super::super::fits_of(&models);
        let rows: Vec<FittedRow<'_>> = data.observations.iter().zip(&fits).collect();
        masses_of_one_tooth(study, &rows, study.wear.coefficient)
    }

    #[test]
    fn masses_of_one_tooth_are_told_by_the_numbers_of_teeth() {
        let both = said([1.0 / 27.0, 1.0 / 53.0]).unwrap();
        assert!(both.starts_with("the masses look like those of one tooth of either member"));
        assert!(both.contains("2.0 times the gear's"), "{both}");
        let gear = said([1.0, 1.0 / 53.0]).unwrap();
        assert!(gear.starts_with("the gear's masses look like those of one tooth"));
        let pinion = said([1.0 / 27.0, 1.0]).unwrap();
        assert!(pinion.starts_with("the pinion's masses look like those of one tooth"));
    }

    #[test]
    fn other_ratios_are_not_asked_about() {
        assert_eq!(said([1.0, 1.0]), None);
        // a small k, of both alike
        assert_eq!(said([0.02, 0.02]), None);
        // a softer pinion, with a k as stated
        assert_eq!(said([1.0, 27.0 / 53.0]), None);
        assert_eq!(said([0.1, 0.02]), None);
        // of plastic on steel
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let mut study = Study::parse(study, "study.toml").unwrap();
        assert!(said_in(&study, [1.0, 1.0 / 53.0]).is_some());
        study.materials.pinion.elastic.youngs_modulus = 2800.0;
        assert_eq!(said_in(&study, [1.0, 1.0 / 53.0]), None);
    }
}
