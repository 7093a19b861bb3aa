//! Cycles of the gear's rows that are the gear's own.

use std::collections::BTreeSet;

use super::SAME_CYCLES;
use crate::measure::{Dataset, Quantity, Subject};
use crate::study::Study;

/// Tests of which the gear's rows stand at the pinion's cycles over the gear ratio.
pub(super) fn gear_revolutions(study: &Study, data: &Dataset) -> Option<String> {
    let [pinion, gear] = [&study.gears.pinion, &study.gears.gear].map(|g| g.spec.teeth);
    let ratio = f64::from(pinion) / f64::from(gear);
    // masses may have been weighed at other times
    let cycles = |test: usize, member: Subject, quantity: Quantity| {
        let own = data.observations.iter();
        let own = own.filter(|o| o.test == test && o.member == member && o.quantity == quantity);
        let own = own.filter(|o| o.cycles > 0.0);
        let bits: BTreeSet<u64> = own.map(|o| o.cycles.to_bits()).collect();
        bits.into_iter().map(f64::from_bits).collect::<Vec<f64>>()
    };
    let turned_of = |test: usize, quantity: Quantity| {
        let [of_pinion, of_gear] =
            [Subject::Pinion, Subject::Gear].map(|member| cycles(test, member, quantity));
        let pairs = || of_pinion.iter().zip(&of_gear);
        !of_pinion.is_empty()
            && of_pinion.len() == of_gear.len()
            && pairs().all(|(p, g)| (g / (ratio * p) - 1.0).abs() < SAME_CYCLES)
    };
    let turned = |test: &usize| {
        let kinds = [Quantity::WearDepth, Quantity::MassLoss];
        kinds.into_iter().any(|quantity| turned_of(*test, quantity))
    };
    let tests: Vec<&str> = (0..data.tests.len())
        .filter(|test| (ratio - 1.0).abs() > 2.0 * SAME_CYCLES && turned(test))
        .map(|test| data.tests[test].as_str())
        .collect();
    (!tests.is_empty()).then(|| {
        format!(
            "in {} the gear's rows stand at {pinion}/{gear} of the pinion's cycles: cycles are revolutions of the pinion for both members; if these \
             are the gear's own, multiply them by {gear}/{pinion}",
            tests.join(", ")
        )
    })
}
