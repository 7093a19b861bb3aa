//! Depths and masses that call for coefficients so far apart that one of them is in another unit, or not what it is called.

use super::super::residual_statistics::FittedRow;
use super::{EXPLAINS, FACTOR, NEAR, mass_balance, rounded, same_moments, scale};
use crate::measure::{Quantity, Subject};
use crate::study::Study;

/// Factor within which a ratio of a thousand or a million is one.
const NEAR_UNIT: f64 = 2.0;
/// Factor within which both members are off alike.
const ALIKE: f64 = 2.0;
/// How far from its number of teeth the factor of either member may be.
const NEAR_TEETH: f64 = 1.7;

/// Depths and masses of a member that call for different coefficients; `k`: the fitted one.
pub(super) fn depths_and_masses(study: &Study, rows: &[FittedRow<'_>], k: f64) -> Option<String> {
    let of = |member: Subject| {
        let depth = scale(rows, Quantity::WearDepth, Some(member))?;
        let mass = scale(rows, Quantity::MassLoss, Some(member))?;
        let sure = depth.explains.min(mass.explains) > EXPLAINS && mass.factor > 0.0;
        // a unit is that of all masses, not of the one that its sigma makes weigh most
        let of_all = total(rows, Quantity::MassLoss, member).filter(|total| *total > 0.0)?;
        let [one, all] = [mass.factor, of_all].map(|mass| depth.factor / mass);
        let together = same_moments::ratio_at_same_moments(rows, member).map(|log| (-log).exp());
        let nearer = [Some(one), Some(all), together].into_iter().flatten();
        let nearer = nearer.min_by(|a, b| a.ln().abs().total_cmp(&b.ln().abs()))?;
        // wear that is far from the model's wears another shape, of which the scale of depths says little
        let sure = sure && !mass_balance::balance(study, rows, member, FACTOR);
        let far = |scale: f64| (k * scale / study.wear.coefficient).ln().abs();
        let masses_first = far(mass.factor) >= far(depth.factor);
        (sure && (one > 1.0) == (all > 1.0)).then_some((nearer, masses_first))
    };
    let gears = &study.gears;
    let members = [
        (Subject::Pinion, gears.pinion.spec.teeth),
        (Subject::Gear, gears.gear.spec.teeth),
    ];
    let ratios: Vec<(Subject, f64, (f64, bool))> = members
        .into_iter()
        .filter_map(|(member, teeth)| Some((member, f64::from(teeth), of(member)?)))
        .collect();
    let (member, teeth, (ratio, masses_first)) =
        (ratios.iter().copied()).max_by(|a, b| a.2.0.ln().abs().total_cmp(&b.2.0.ln().abs()))?;
    if ratio.ln().abs() < FACTOR.ln() {
        return None;
    }
    // what else is missing may pull at one member, hardly at both alike
    let one_tooth = |(_, teeth, (ratio, _)): &(Subject, f64, (f64, bool))| {
        (ratio / teeth).ln().abs() < NEAR_TEETH.ln()
    };
    let of_one_tooth = ratios.len() > 1 && ratios.iter().all(one_tooth);
    // what is farther from the stated k is likelier to be off
    let known = [
        (
            1e3,
            if masses_first {
                "the masses look like g: they are wanted in mg (or the depths like nm, wanted in µm; or the depths' cycles count thousands)"
            } else {
                "the depths look like nm: they are wanted in µm (or the masses like g, wanted in mg; or the depths' cycles count thousands)"
            },
        ),
        (
            1e-3,
            if masses_first {
                "the masses look like µg, or like mg that were taken for g: they are wanted in mg (or the depths like mm, wanted in µm; or the masses' cycles count thousands)"
            } else {
                "the depths look like mm: they are wanted in µm (or the masses like µg, or like mg that were taken for g, wanted in mg; or the masses' cycles count thousands)"
            },
        ),
        (1e6, "the masses look like kg: they are wanted in mg"),
        (
            teeth,
            "the masses look like those of one tooth: the loss of all teeth is wanted",
        ),
    ];
    let hint = (known.iter())
        .find(|(factor, _)| {
            // no other slip is near a thousand, whatever the model lacks
            let is_power = *factor != teeth && (ratio / factor).ln().abs() < NEAR_UNIT.ln();
            let is_near = (ratio / factor - 1.0).abs() < NEAR;
            is_near || is_power || *factor == teeth && of_one_tooth
        })
        .map_or(
            "look at their units (µm and mg), at density and face_width, whether the mass is the whole member's and of no other, whether the traces \
             stand for the whole face and for all teeth, and whether all values count from the start (gearwear import --per-interval)",
            |(_, hint)| hint,
        );
    let (more, by) = if ratio > 1.0 {
        ("more", ratio)
    } else {
        ("less", ratio.recip())
    };
    // of both members alike it is not one member's
    let alike =
        |(_, _, (own, _)): &(Subject, f64, (f64, bool))| (own / ratio).ln().abs() < ALIKE.ln();
    let (whose, their) = match ratios.len() > 1 && ratios.iter().all(alike) {
        true => ("depths of both members".to_owned(), "their"),
        false => (format!("{}'s depths", member.name()), "its"),
    };
    Some(format!(
        "the {whose} say {} times {more} wear than {their} masses: {hint}",
        rounded(by)
    ))
}

/// Sum of a quantity of a member over that of the model.
fn total(rows: &[FittedRow<'_>], quantity: Quantity, member: Subject) -> Option<f64> {
    let own = rows
        .iter()
        .filter(|(o, _)| o.quantity == quantity && o.member == member);
    let (value, model) = own.fold((0.0, 0.0), |(value, model), (o, row)| {
        (value + o.value, model + row.model)
    });
    (model > 0.0).then(|| value / model)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Dataset;

    /// What is said of 10, 20 and 30 µm off the whole flanks of a pinion that weigh `mass` times 227.4 mg each (by hand, `mass_balance`), where the model
    /// has those depths and `model_mass` times the masses.
    fn said(mass: f64, model_mass: f64) -> Option<String> {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let mut text = "test,member,cycles,quantity,position,value,sigma\n".to_owned();
        let mut models = Vec::new();
        for i in 1..4 {
            let (cycles, i) = (100_000 * i, f64::from(i));
            for radius in [26.0, 26.5, 27.4, 28.2, 29.0] {
                let depth = 10.0 * i;
                text += &format!("A,pinion,{cycles},wear_depth,{radius},{depth},0.1\n");
                models.push(depth);
            }
            let lost = 227.4 * i;
            text += &format!("A,pinion,{cycles},mass_loss,,{},1\n", mass * lost);
            models.push(model_mass * lost);
        }
        let data = Dataset::parse(&text, "m.csv", &study.known()).unwrap();
        let fits = super::super::fits_of(&models);
        let rows: Vec<FittedRow<'_>> = data.observations.iter().zip(&fits).collect();
        depths_and_masses(&study, &rows, 1e-10)
    }

    #[test]
    fn masses_that_are_those_of_the_depths_are_not_asked_about_whatever_the_model_has() {
        assert_eq!(said(1.0, 1.0), None);
        assert_eq!(said(1.0, 0.2), None);
        let five = said(5.0, 1.0).unwrap();
        assert!(
            five.starts_with("the pinion's depths say 5.0 times less wear than its masses"),
            "{five}"
        );
    }
}
