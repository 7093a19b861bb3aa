//! Curves of one flank that run opposite ways: places upside down at one checkpoint, in one test or in all.
//!
//! ```text
//! r(a, b) = Σ a_i b_i/√(Σ a_i² Σ b_i²)      of two curves' depths at the same places, each less its mean; between measured places by straight lines
//! r(a, b) < 0.5 and r(a, b reversed) > 0.9: wear that goes on in between keeps its pattern, in another test too
//! ```
//! Two checkpoints are held against each other, then the last ones of tests, then those against the model's.

use std::collections::BTreeMap;

use super::super::residual_statistics::FittedRow;
use super::flank_curves::{Curve, Flank, flank_curves};
use crate::measure::{Observation, Subject};
use crate::numeric::interpolate;
use crate::study::Study;

/// Fewest points of a curve.
const FEWEST: usize = 6;
/// Correlation below which two curves do not run alike, and from which one runs as the other does upside down.
const UNLIKE: f64 = 0.5;
const ALIKE: f64 = 0.9;
/// Standard deviation of a curve's values over their sigma from which it has a pattern.
const PATTERN: f64 = 5.0;
/// Part of its length by which the ends of a curve may differ from another's.
const SAME_ENDS: f64 = 0.1;

/// What runs opposite ways along one member's flanks: one checkpoint and the next, or one test and the others. Where both members of a test do, their
/// depths may stand under each other's names.
pub(super) fn one_member_reversed(study: &Study, rows: &[FittedRow<'_>]) -> Vec<String> {
    let measured = flank_curves(rows.iter().map(|(o, _)| *o));
    let said = within_tests(study, &measured);
    if !said.is_empty() {
        return said;
    }
    let odd = odd_tests(&last_curves(&measured));
    let of_one_member = |(test, member, _): &Odd| {
        let others = odd.iter().filter(|(t, ..)| t == test);
        others.into_iter().all(|(_, m, _)| m == member)
    };
    let of_one_member = odd.iter().filter(|odd| of_one_member(odd));
    of_one_member.map(|odd| one_test(study, odd)).collect()
}

/// What runs opposite ways along a flank: one test and the others, or the measured curves and the model's.
pub(super) fn reversed(study: &Study, rows: &[FittedRow<'_>]) -> Vec<String> {
    let measured = flank_curves(rows.iter().map(|(o, _)| *o));
    let last = last_curves(&measured);
    let odd = odd_tests(&last);
    if !odd.is_empty() {
        return odd.iter().map(|odd| one_test(study, odd)).collect();
    }
    let modelled: Vec<Observation> = (rows.iter())
        .map(|(o, row)| Observation {
            value: row.model,
            ..(*o).clone()
        })
        .collect();
    let modelled = flank_curves(modelled.iter());
    let modelled = last_curves(&modelled);
    (last.iter())
        .zip(modelled.values())
        .filter(|((_, measured), modelled)| {
            let mut pairs = measured.iter().zip(*modelled);
            pairs.all(|(measured, modelled)| opposite(modelled.1, measured.1))
        })
        .map(|((_, measured), _)| unlike_the_model(study, measured))
        .collect()
}

/// Tests in which two checkpoints that follow each other run opposite ways.
fn within_tests(study: &Study, measured: &BTreeMap<Flank<'_>, Vec<Curve>>) -> Vec<String> {
    let pairs = measured.iter().filter_map(|((test, member, _), of_flank)| {
        let pair = of_flank.windows(2);
        let pair = pair.into_iter().find(|pair| opposite(&pair[0], &pair[1]))?;
        Some(format!(
            "in test {} wear_depth of the {} runs the other way along the flank after {} cycles than after {}: are the places of one of these \
             curves upside down?",
            study.tests[*test].id,
            member.name(),
            pair[1].cycles,
            pair[0].cycles
        ))
    });
    pairs.collect()
}

/// The last curve of each test, of flanks of one member at one place across the face; the tests in order.
type LastCurves<'c, 'd> = BTreeMap<FlankOfAny<'d>, Vec<(Flank<'d>, &'c Curve)>>;
/// A member, and where across the face and on which tooth.
type FlankOfAny<'d> = (Subject, (Option<u64>, Option<&'d str>));

fn last_curves<'c, 'd>(all: &'c BTreeMap<Flank<'d>, Vec<Curve>>) -> LastCurves<'c, 'd> {
    let mut last = LastCurves::new();
    for (flank, curves) in all {
        if let Some(curve) = curves.last() {
            let of_any = (flank.1, flank.2);
            last.entry(of_any).or_default().push((*flank, curve));
        }
    }
    last
}

/// The one of several that stands `against` all others, while none of these stands against another; the first of two.
fn among<T>(all: &[(T, &Curve)], against: impl Fn(&Curve, &Curve) -> bool) -> Option<usize> {
    let is_odd = |one: &usize| {
        let others: Vec<usize> = (0..all.len()).filter(|i| i != one).collect();
        let mut pairs = (others.iter())
            .flat_map(|&i| others.iter().map(move |&j| (i, j)).filter(|(i, j)| i < j));
        !others.is_empty()
            && others
                .iter()
                .all(|&other| against(all[other].1, all[*one].1))
            && !pairs.any(|(i, j)| against(all[i].1, all[j].1))
    };
    (0..all.len()).find(is_odd)
}

/// A test, the member of it whose curve runs the other way, and the other tests.
type Odd = (usize, Subject, Vec<usize>);

/// The tests of which a member's last curve runs the other way than those of all others.
fn odd_tests(last: &LastCurves<'_, '_>) -> Vec<Odd> {
    let found = last.values().filter_map(|of_tests| {
        let odd = among(of_tests, opposite)?;
        let (test, member, _) = of_tests[odd].0;
        let others = (of_tests.iter().enumerate()).filter(|(i, _)| *i != odd);
        Some((
            test,
            member,
            others.map(|(_, (flank, _))| flank.0).collect(),
        ))
    });
    found.collect()
}

fn one_test(study: &Study, (test, member, others): &Odd) -> String {
    let id = |test: &usize| study.tests[*test].id.as_str();
    let others: Vec<&str> = others.iter().map(id).collect();
    let which = if others.len() == 1 {
        "of one of them"
    } else {
        "of its curves"
    };
    format!(
        "wear_depth of the {} runs the other way along the flank in test {} than in {}: are the places {which} upside down?",
        member.name(),
        id(test),
        others.join(", ")
    )
}

fn unlike_the_model(study: &Study, measured: &[(Flank<'_>, &Curve)]) -> String {
    let ids: Vec<&str> = (measured.iter())
        .map(|(flank, _)| study.tests[flank.0].id.as_str())
        .collect();
    format!(
        "wear_depth of the {} runs the other way along the flank than the model's in {}: are its places upside down?",
        measured[0].0.1.name(),
        if ids.len() == 1 {
            format!("test {}", ids[0])
        } else {
            "all tests".to_owned()
        }
    )
}

/// Whether two curves over the same stretch of the flank, both with a pattern, are alike only with the other upside down.
fn opposite(one: &Curve, other: &Curve) -> bool {
    if one.points.len().min(other.points.len()) < FEWEST {
        return false;
    }
    let ends = |curve: &Curve| [curve.points[0][0], curve.points[curve.points.len() - 1][0]];
    let [[low, high], other_ends] = [ends(one), ends(other)];
    let tolerance = SAME_ENDS * (high - low);
    if (other_ends[0] - low).abs() > tolerance || (other_ends[1] - high).abs() > tolerance {
        return false;
    }
    let places: Vec<f64> = other.points.iter().map(|p| p[0]).collect();
    let values: Vec<f64> = other.points.iter().map(|p| p[1]).collect();
    let of_other = |place: &dyn Fn(f64) -> f64| -> Vec<f64> {
        let at = (one.points.iter()).map(|p| interpolate(&places, &values, place(p[0])));
        centred(at.collect())
    };
    let a = centred(one.points.iter().map(|p| p[1]).collect());
    let b = of_other(&|place| place);
    // upside down on the flank, or in the order of the rows, which need not be evenly spaced
    let turned = of_other(&|place| {
        other_ends[1] - (place - low) / (high - low) * (other_ends[1] - other_ends[0])
    });
    let mut rows = values.clone();
    rows.reverse();
    let in_rows = rows.len() == one.points.len() && correlation(&a, &centred(rows)) > ALIKE;
    // a curve of the other sign is no curve upside down, though it may look like one
    let mean = |curve: &Curve| curve.points.iter().map(|p| p[1]).sum::<f64>();
    mean(one) * mean(other) > 0.0
        && has_pattern(&a, one.sigma)
        && has_pattern(&b, other.sigma)
        && correlation(&a, &b) < UNLIKE
        && (in_rows || correlation(&a, &turned) > ALIKE)
}

fn has_pattern(centred: &[f64], sigma: f64) -> bool {
    let mean_square = centred.iter().map(|v| v * v).sum::<f64>() / centred.len() as f64;
    mean_square.sqrt() > PATTERN * sigma
}

fn centred(values: Vec<f64>) -> Vec<f64> {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    values.into_iter().map(|value| value - mean).collect()
}

fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    dot(a, b) / (dot(a, a) * dot(b, b)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    const VALUES: [f64; 7] = [6.0, 4.5, 3.0, 1.5, 0.2, 1.0, 2.0];

    fn curve(from: f64, values: [f64; 7]) -> Curve {
        Curve {
            cycles: 1e5,
            points: (values.iter().enumerate())
                .map(|(i, v)| [from + 0.3 * i as f64, *v])
                .collect(),
            sigma: 0.1,
        }
    }

    fn turned(mut values: [f64; 7]) -> [f64; 7] {
        values.reverse();
        values
    }

    #[test]
    fn a_curve_upside_down_runs_the_other_way() {
        let later = VALUES.map(|v| 1.8 * v + 0.3);
        let opposite = |from, values| opposite(&curve(26.0, VALUES), &curve(from, values));
        assert!(opposite(26.0, turned(later)));
        assert!(!opposite(26.0, later));
        // unevenly spaced rows in the other order
        let uneven = |values: [f64; 7]| {
            let mut curve = curve(26.0, values);
            let places = [26.0, 26.1, 26.25, 26.5, 26.9, 27.3, 27.8];
            for (point, place) in curve.points.iter_mut().zip(places) {
                point[0] = place;
            }
            curve
        };
        assert!(super::opposite(&uneven(VALUES), &uneven(turned(later))));
        // at other places of the same stretch, and of another stretch
        assert!(opposite(26.05, turned(later)));
        assert!(opposite(26.15, turned(later)));
        assert!(!opposite(26.3, turned(later)));
        // noise has no pattern
        assert!(!opposite(26.0, [0.05, 0.0, 0.1, 0.0, 0.05, 0.1, 0.0]));
    }

    #[test]
    fn the_odd_one_of_several_tests_is_found() {
        let (plain, odd) = (curve(26.0, VALUES), curve(26.0, turned(VALUES)));
        let of = |curves: &[&Curve]| {
            let all: Vec<((), &Curve)> = curves.iter().map(|curve| ((), *curve)).collect();
            among(&all, opposite)
        };
        assert_eq!(of(&[&plain, &plain, &odd, &plain]), Some(2));
        assert_eq!(of(&[&plain, &odd]), Some(0));
        assert_eq!(of(&[&plain, &plain, &plain]), None);
        assert_eq!(of(&[&plain, &odd, &plain, &odd]), None);
        assert_eq!(of(&[&plain]), None);
    }
}
