//! Depth curves of one test that shrink with the cycles, whatever the model makes of them.
//!
//! ```text
//! y_c(r) ≈ a_c g(r)      g the shape that the curves of a test and member have in common, line through each removed: datum and tilt
//! a_c far below that of an earlier checkpoint c: wear does not fall
//! ```

use std::collections::BTreeMap;

use super::falling::{Fall, Worn, fall, shortened};
use super::flank_curves::{Curve, flank_curves};
use crate::measure::{Dataset, Quantity, Subject};
use crate::study::Study;

/// Fewest places that tell a shape, and the share of a curve's squares that the common shape must explain.
const FEWEST: usize = 6;
const OF_ITS_SHAPE: f64 = 0.8;
/// Standard deviations up to which a curve beside the common shape is noise.
const NO_SHAPE: f64 = 2.0;
/// How far the shape must shrink: the last two checkpoints of a test are often near to each other.
const SHRINKS_TO: f64 = 0.9;

/// A question about each test and member whose curves shrink.
pub(super) fn falling_shapes(study: &Study, data: &Dataset) -> Vec<String> {
    let mut said: BTreeMap<(usize, Subject), String> = BTreeMap::new();
    for ((test, member, _), curves) in flank_curves(data.observations.iter()) {
        if let Some(fall) = shrinks(&curves) {
            let of = format!(
                "in test {} wear_depth of the {}",
                study.tests[test].id,
                member.name()
            );
            said.entry((test, member))
                .or_insert_with(|| fall.in_words(&of, Quantity::WearDepth));
        }
    }
    shortened(said.into_values().collect())
}

/// The first two checkpoints between which the common shape shrinks.
fn shrinks(curves: &[Curve]) -> Option<Fall> {
    let places = places(curves)?;
    let shapes: Vec<Vec<f64>> = (curves.iter())
        .map(|curve| without_line(&places, &read(curve, &places)))
        .collect();
    let mut common = vec![0.0; places.len()];
    for shape in &shapes {
        let size = dot(shape, shape).sqrt();
        for (sum, y) in common.iter_mut().zip(shape).filter(|_| size > 0.0) {
            *sum += y / size;
        }
    }
    let size = dot(&common, &common).sqrt();
    let of_the_shape = |(curve, shape): (&Curve, &Vec<f64>)| {
        let amount = dot(shape, &common) / size;
        let (all, of_it) = (dot(shape, shape), amount * amount);
        let rest = ((all - of_it).max(0.0) / places.len() as f64).sqrt();
        // an unworn flank has no shape at all
        let explained = of_it > OF_ITS_SHAPE * all || rest < NO_SHAPE * curve.sigma;
        explained.then(|| Worn {
            cycles: curve.cycles,
            amount,
            sigma: curve.sigma,
            largest: curve.points.iter().map(|p| p[1].abs()).fold(0.0, f64::max),
        })
    };
    let worn: Vec<Worn> = curves
        .iter()
        .zip(&shapes)
        .filter_map(of_the_shape)
        .collect();
    // a curve of the other sign is another question
    let is_negative = |worn: &Worn| worn.amount < -NO_SHAPE * worn.sigma;
    (size > 0.0 && !worn.iter().any(is_negative))
        .then(|| fall(&worn, SHRINKS_TO))
        .flatten()
}

/// Where all curves can be read: places of the one with the fewest that all others reach.
fn places(curves: &[Curve]) -> Option<Vec<f64>> {
    let fewest = curves.iter().min_by_key(|curve| curve.points.len())?;
    let inside = |r: f64| {
        let reaches = |curve: &Curve| {
            let ends = curve.points.first().zip(curve.points.last());
            ends.is_some_and(|(first, last)| (first[0]..=last[0]).contains(&r))
        };
        curves.iter().all(reaches)
    };
    let places: Vec<f64> = (fewest.points.iter().map(|p| p[0]))
        .filter(|r| inside(*r))
        .collect();
    (curves.len() > 1 && places.len() >= FEWEST).then_some(places)
}

/// A curve at some places, straight between its points.
fn read(curve: &Curve, places: &[f64]) -> Vec<f64> {
    let at = |r: &f64| {
        let after = curve.points.partition_point(|p| p[0] < *r);
        let [x1, y1] = curve.points[after];
        match after.checked_sub(1).map(|before| curve.points[before]) {
            Some([x0, y0]) if x1 > x0 => y0 + (y1 - y0) * (r - x0) / (x1 - x0),
            _ => y1,
        }
    };
    places.iter().map(at).collect()
}

/// What is left without the line through them.
fn without_line(x: &[f64], y: &[f64]) -> Vec<f64> {
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let [x0, y0] = [mean(x), mean(y)];
    let xx: f64 = x.iter().map(|x| (x - x0).powi(2)).sum();
    let xy: f64 = x.iter().zip(y).map(|(x, y)| (x - x0) * (y - y0)).sum();
    let slope = if xx > 0.0 { xy / xx } else { 0.0 };
    let rest = |(x, y): (&f64, &f64)| y - y0 - slope * (x - x0);
    x.iter().zip(y).map(rest).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A valley like that at the pitch point, on a shifted and tilted trace.
    fn curve(cycles: f64, size: f64, datum: [f64; 2]) -> Curve {
        let at = |i: usize| {
            let r = 20.0 + 0.1 * i as f64;
            let depth = size * (r - 20.8).abs();
            [r, depth + datum[0] + datum[1] * (r - 20.0)]
        };
        Curve {
            cycles,
            points: (0..20).map(at).collect(),
            sigma: 0.02,
        }
    }

    fn said(sizes: [f64; 4]) -> Option<String> {
        let datums = [[0.0, 0.0], [1.0, -0.5], [-2.0, 0.3], [0.5, 0.1]];
        let curves: Vec<Curve> = (0..4)
            .map(|i| curve(1e5 * (i + 1) as f64, sizes[i], datums[i]))
            .collect();
        shrinks(&curves).map(|fall| fall.in_words("it", Quantity::WearDepth))
    }

    #[test]
    fn exchanged_checkpoints_are_asked_for_wherever_they_stand() {
        for sizes in [
            [2.0, 1.0, 3.0, 4.0],
            [1.0, 3.0, 2.0, 4.0],
            [1.0, 2.0, 4.0, 3.0],
        ] {
            assert!(said(sizes).unwrap().contains("wear does not fall"));
        }
        assert_eq!(said([1.0, 2.0, 3.0, 4.0]), None);
        // from here on nothing wears, within the noise
        assert_eq!(said([1.0, 2.0, 2.0, 1.99]), None);
    }

    #[test]
    fn a_checkpoint_in_millimetres_is_asked_for() {
        let curves: Vec<Curve> = [1.0, 2.0, 0.003, 4.0]
            .iter()
            .enumerate()
            .map(|(i, size)| Curve {
                sigma: 0.001 * size,
                ..curve(1e5 * (i + 1) as f64, *size, [0.0; 2])
            })
            .collect();
        let said = shrinks(&curves).map(|fall| fall.in_words("it", Quantity::WearDepth));
        assert!(said.unwrap().contains("was that checkpoint written in mm?"));
    }

    #[test]
    fn an_unworn_flank_among_worn_ones_is_asked_for() {
        let unworn = |noise: f64| {
            let mut curve = curve(3e5, 0.0, [0.3, 0.0]);
            for (i, point) in curve.points.iter_mut().enumerate() {
                point[1] += noise * [1.0, -0.7, 0.2, -0.9, 0.6][i % 5];
            }
            curve
        };
        for noise in [0.0, 0.02] {
            let curves = [
                curve(1e5, 1.0, [0.0; 2]),
                curve(2e5, 2.0, [0.0; 2]),
                unworn(noise),
                curve(4e5, 4.0, [0.0; 2]),
            ];
            let said = shrinks(&curves).map(|fall| fall.in_words("it", Quantity::WearDepth));
            assert!(
                said.unwrap().contains("after 300000 cycles beside"),
                "{noise}"
            );
        }
    }

    #[test]
    fn curves_at_other_places_are_read_between_their_points() {
        let fine = curve(1e5, 4.0, [0.0; 2]);
        let coarse = Curve {
            points: (0..9)
                .map(|i| 20.05 + 0.2 * f64::from(i))
                .map(|r| [r, 3.0 * (r - 20.8_f64).abs()])
                .collect(),
            ..curve(2e5, 3.0, [0.0; 2])
        };
        assert!(shrinks(&[fine, coarse]).is_some());
        let few = |cycles| Curve {
            points: (0..5)
                .map(|i| [20.0 + f64::from(i), f64::from(i % 2)])
                .collect(),
            ..curve(cycles, 1.0, [0.0; 2])
        };
        assert!(shrinks(&[few(1e5), few(2e5)]).is_none());
    }
}
