//! Masses held against the depths of the same member, test and time, without a model of wear.
//!
//! ```text
//! m = ρ b z ∫ max(h, 0) ds,   ds = r dr/r_b        of an involute; h the depth of the mean curve
//! ```
//! A curve may cover a part of the flank and its zero may be off, so that only factors as between units are told.

use std::collections::BTreeMap;

use super::super::residual_statistics::FittedRow;
use super::{SAME_CYCLES, rounded};
use crate::gear::Gear;
use crate::measure::neighbours::curves;
use crate::measure::{Dataset, Observation, Quantity, Subject};
use crate::numeric::median;
use crate::study::Study;

/// Factor between a mass and that of the depths from which it is a unit's.
const FACTOR: f64 = 200.0;
/// How far from a known factor it is told by name.
const NEAR: f64 = 3.0;
/// Standard deviations from which a depth, or a mass that is too large, is no noise.
const SURE: f64 = 5.0;

/// Tests of which the masses are hundreds of times more or less than the depths make up.
pub(super) fn masses_and_depths(study: &Study, data: &Dataset) -> Option<String> {
    let mut of_tests: BTreeMap<usize, Vec<f64>> = BTreeMap::new();
    for ((test, _), logs) in ratios(study, data.observations.iter()) {
        of_tests.entry(test).or_default().extend(logs);
    }
    let all: Vec<(usize, f64)> = (of_tests.into_iter())
        .filter_map(|(test, logs)| Some((test, median(logs)?)))
        .collect();
    let far = |(_, log): &&(usize, f64)| log.abs() > FACTOR.ln();
    let (_, first) = *all.iter().find(far)?;
    let alike = |found: &&(usize, f64)| far(found) && (found.1 > 0.0) == (first > 0.0);
    let off: Vec<&str> = (all.iter().filter(alike))
        .map(|(test, _)| study.tests[*test].id.as_str())
        .collect();
    let near = |factor: f64| (first.abs() - factor.ln()).abs() < NEAR.ln();
    let hint = match first > 0.0 {
        true if near(1e3) => {
            "the masses look like µg, or like mg that were taken for g: they are wanted in mg (or the depths like mm, wanted in µm)"
        }
        false if near(1e3) => {
            "the masses look like g: they are wanted in mg (or the depths like nm, wanted in µm)"
        }
        false if near(1e6) => "the masses look like kg: they are wanted in mg",
        _ => "look at their units (mg and µm), at density and face_width",
    };
    Some(format!(
        "the masses of test{} {} are about {} times {} than what the depths there make up: {hint}",
        if off.len() > 1 { "s" } else { "" },
        off.join(", "),
        rounded(first.abs().exp()),
        if first > 0.0 { "more" } else { "less" }
    ))
}

/// Whether a member's masses are what its depths make up, but for less than a factor.
pub(super) fn balance(study: &Study, rows: &[FittedRow<'_>], member: Subject, factor: f64) -> bool {
    let own = rows.iter().map(|(o, _)| *o).filter(|o| o.member == member);
    let logs: Vec<f64> = ratios(study, own).into_values().flatten().collect();
    median(logs).is_some_and(|log| log.abs() < factor.ln())
}

/// ln of mass over that of the depths by test and member, wherever both were measured.
fn ratios<'d>(
    study: &Study,
    all: impl Iterator<Item = &'d Observation> + Clone,
) -> BTreeMap<(usize, Subject), Vec<f64>> {
    let mut areas: BTreeMap<(usize, Subject, u64), Vec<f64>> = BTreeMap::new();
    let depths = |o: &&Observation| o.quantity == Quantity::WearDepth;
    let depths: Vec<&Observation> = all.clone().filter(depths).collect();
    for curve in curves(&depths) {
        let first = depths[curve[0]];
        let curve: Vec<&Observation> = curve.into_iter().map(|i| depths[i]).collect();
        if let Some(area) = area(study, &curve) {
            let key = (first.test, first.member, first.cycles.to_bits());
            areas.entry(key).or_default().push(area);
        }
    }
    let mut ratios: BTreeMap<_, Vec<f64>> = BTreeMap::new();
    let lost = |o: &&Observation| o.quantity == Quantity::MassLoss && o.value > 0.0;
    for o in all.filter(lost) {
        let same = |(test, member, cycles): &(usize, Subject, u64)| {
            (*test, *member) == (o.test, o.member)
                && (f64::from_bits(*cycles) / o.cycles - 1.0).abs() < SAME_CYCLES
        };
        let Some((_, areas)) = areas.iter().find(|(key, _)| same(key)) else {
            continue;
        };
        let mean = areas.iter().sum::<f64>() / areas.len() as f64;
        let Some((gear, density)) = member(study, o.member) else {
            continue;
        };
        let volume = 1e-3 * mean * study.gears.face_width * f64::from(gear.spec.teeth);
        let ratio = (o.value / (1e-3 * density * volume)).ln();
        // a noisy mass is more than a small one by chance, never hundreds of times less than a large one
        if ratio < 0.0 || o.value > SURE * o.sigma {
            ratios.entry((o.test, o.member)).or_default().push(ratio);
        }
    }
    ratios
}

/// A member and its density, kg/m³; None of the pair.
fn member(study: &Study, subject: Subject) -> Option<(&Gear, f64)> {
    let (gears, materials) = (&study.gears, &study.materials);
    match subject {
        Subject::Pinion => Some((&gears.pinion, materials.pinion.density_kg_m3)),
        Subject::Gear => Some((&gears.gear, materials.gear.density_kg_m3)),
        Subject::Pair => None,
    }
}

/// Worn area of a depth curve, µm mm along the flank; None where it is no more than noise.
fn area(study: &Study, curve: &[&Observation]) -> Option<f64> {
    let base = member(study, curve.first()?.member)?.0.base_radius;
    let is_sure = |o: &&Observation| o.value > SURE * o.sigma;
    let place = |o: &Observation| o.position.map(|r| r * r / (2.0 * base));
    let area = curve.windows(2).filter_map(|pair| {
        let [a, b] = [pair[0], pair[1]];
        Some(0.5 * (a.value.max(0.0) + b.value.max(0.0)) * (place(b)? - place(a)?))
    });
    let area: f64 = area.sum();
    (curve.iter().any(is_sure) && area > 0.0).then_some(area)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 10 µm off the whole flank of all teeth: the area is the depth times the involute's length (r₂² − r₁²)/(2 r_b), the mass 7.85 mg/mm³ of
    /// that by 33 mm and the teeth. By hand for the pinion: 27 teeth of module 2, r_b = 27 cos 20° = 25.3717 mm, 26 to 29 mm: 3.2517 mm, 227.4 mg.
    #[test]
    fn an_even_depth_weighs_what_its_volume_does() {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let of = |mass: f64| {
            let mut text = "test,member,cycles,quantity,position,value,sigma\n".to_owned();
            for radius in [26.0, 26.5, 27.4, 28.2, 29.0] {
                text += &format!("A,pinion,100000,wear_depth,{radius},10,0.1\n");
            }
            text += &format!("A,pinion,100000,mass_loss,,{mass},1\n");
            Dataset::parse(&text, "m.csv", &study.known()).unwrap()
        };
        let by_hand = 227.432;
        let ratio_of = |mass| {
            let data = of(mass);
            ratios(&study, data.observations.iter())[&(0, Subject::Pinion)][0]
        };
        let ratio = ratio_of(by_hand);
        assert!(ratio.abs() < 1e-3, "{ratio}");
        assert!((ratio_of(2.0 * by_hand) - 2f64.ln()).abs() < 1e-3);
        // within a factor, of the member that was weighed
        let balances = |mass, member| {
            let data = of(mass);
            let fits = super::super::fits_of(&[1.0; 6]);
            let rows: Vec<FittedRow<'_>> = data.observations.iter().zip(&fits).collect();
            balance(&study, &rows, member, 2.5)
        };
        assert!(balances(2.0 * by_hand, Subject::Pinion));
        assert!(!balances(3.0 * by_hand, Subject::Pinion));
        assert!(!balances(by_hand, Subject::Gear));
        assert_eq!(masses_and_depths(&study, &of(by_hand)), None);
        let said = |mass| masses_and_depths(&study, &of(mass)).unwrap();
        assert!(
            said(1e-3 * by_hand).contains("1000 times less")
                && said(1e-3 * by_hand).contains("look like g")
        );
        assert!(said(1e3 * by_hand).contains("1000 times more"));
    }
}
