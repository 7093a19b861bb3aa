//! Depths of one test at the places of the other tests and a constant: a radius that was set up wrongly.
//!
//! ```text
//! r_i = R_i + c for all places i of all curves of a member, |c| > 0.2 mm, R the places of most of its curves in other tests
//! ```

use std::collections::BTreeMap;

use crate::measure::neighbours::curves;
use crate::measure::{Dataset, Observation, Quantity, Subject};

/// Shift from which places are told, and how far single ones may be off it, mm.
const SHIFT: f64 = 0.2;
const ALIKE: f64 = 0.01;
/// Fewest places of a curve.
const FEWEST: usize = 4;

/// The places of a curve, mm.
type Places = Vec<f64>;

/// A question for each member of a test of which all curves are shifted alike.
pub(super) fn shifted_places(data: &Dataset) -> Vec<String> {
    let depths = |o: &&Observation| o.quantity == Quantity::WearDepth;
    let depths: Vec<&Observation> = data.observations.iter().filter(depths).collect();
    let mut of_members: BTreeMap<Subject, BTreeMap<usize, Vec<Places>>> = BTreeMap::new();
    for curve in curves(&depths) {
        let first = depths[curve[0]];
        let places = curve.iter().filter_map(|&i| depths[i].position).collect();
        let tests = of_members.entry(first.member).or_default();
        tests.entry(first.test).or_default().push(places);
    }
    let mut said = Vec::new();
    for (member, tests) in of_members {
        let Some(usual) = usual(&tests) else { continue };
        for (test, own) in &tests {
            let shifts: Option<Vec<f64>> = own.iter().map(|one| shift(one, &usual)).collect();
            let Some(shifts) = shifts else { continue };
            let by = shifts[0];
            if by.abs() > SHIFT && shifts.iter().all(|shift| (shift - by).abs() < ALIKE) {
                said.push(format!(
                    "in test {} all {} places of the {}'s depths lie {:.2} mm further {} than those of the other tests: were they measured there, \
                     or is the radius off?",
                    data.tests[*test],
                    usual.len(),
                    member.name(),
                    by.abs(),
                    if by > 0.0 { "out" } else { "in" },
                ));
            }
        }
    }
    said
}

/// The places of more than half of the curves' tests, of two tests or more: of two that differ nobody knows which is shifted.
fn usual(tests: &BTreeMap<usize, Vec<Places>>) -> Option<Places> {
    let is_usual = |places: &&Places| {
        let same = |one: &Places| shift(one, places).is_some_and(|shift| shift.abs() < ALIKE);
        let at_it = tests.values().filter(|own| own.iter().all(same)).count();
        at_it > 1 && 2 * at_it > tests.len()
    };
    tests.values().flatten().find(is_usual).cloned()
}

/// By how much places lie further out than others, if all do by the same.
fn shift(one: &[f64], other: &[f64]) -> Option<f64> {
    if one.len() != other.len() || one.len() < FEWEST {
        return None;
    }
    let by = one[0] - other[0];
    let alike = |(a, b): (&f64, &f64)| (a - b - by).abs() < ALIKE;
    one.iter().zip(other).all(alike).then_some(by)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Study;

    fn said(radii: [[f64; 4]; 3]) -> Vec<String> {
        let study = include_str!("../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let mut text = "test,member,cycles,quantity,position,value,sigma\n".to_owned();
        let tests = study.tests.iter().map(|test| &test.id);
        for (test, radii) in tests.zip(radii) {
            for cycles in [100_000, 200_000] {
                for radius in radii {
                    text += &format!("{test},pinion,{cycles},wear_depth,{radius},1,0.1\n");
                }
            }
        }
        shifted_places(&Dataset::parse(&text, "m.csv", &study.known()).unwrap())
    }

    #[test]
    fn a_test_with_shifted_radii_is_asked_about() {
        let usual = [26.0, 26.7, 27.5, 28.1];
        let shifted = usual.map(|r| r + 0.4);
        let asked = said([usual, shifted, usual]);
        assert_eq!(asked.len(), 1, "{asked:?}");
        assert!(
            asked[0].contains("all 4 places of the pinion's depths lie 0.40 mm further out"),
            "{asked:?}"
        );
        // other places, a shift that may be rounding, and one of two
        for other in [[26.0, 26.9, 27.5, 28.3], usual.map(|r| r + 0.1)] {
            assert!(said([usual, other, usual]).is_empty(), "{other:?}");
        }
        let third = usual.map(|r| 1.01 * r);
        assert!(said([usual, shifted, third]).is_empty());
    }
}
