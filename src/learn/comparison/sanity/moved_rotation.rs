//! Transmission errors whose positions count from another rotation than the pitch point's.
//!
//! ```text
//! S(δ) = Σ ((y − ȳ) − (f(p + δ) − f̄))²/σ²      f the computed curve, periodic over a base pitch, linear between the places of the curve
//! moved by δ: S(δ) ≤ S(0)/4, S(δ) ≤ Σ ((y − ȳ)/σ)²/10, and turned round it fits less well
//! ```

use std::collections::BTreeMap;

use super::super::residual_statistics::FittedRow;
use super::single_tests::tests_in_words;
use crate::measure::Quantity;
use crate::study::Study;

/// Fewest places of a curve.
const FEWEST: usize = 8;
/// Rotations that are tried in a base pitch.
const TRIED: usize = 50;
/// Least rotation that is asked about, base pitches, and how far apart those of several curves may be to be one.
const LEAST: f64 = 0.1;
const SAME: f64 = 0.06;
/// Parts of the squares at no rotation and of all squares that may be left, and mean square at no rotation from which it is no noise.
const LEFT: f64 = 0.25;
const LEFT_OF_ALL: f64 = 0.1;
const BEYOND_NOISE: f64 = 4.0;

/// A curve over the rotation: place, computed, measured, sigma.
type Curve = Vec<[f64; 4]>;

/// Tests whose transmission errors run as the computed ones do at other rotations, as a question; None where there are none.
pub(super) fn moved_rotation(study: &Study, rows: &[FittedRow<'_>]) -> Option<String> {
    let mut curves: BTreeMap<_, Curve> = BTreeMap::new();
    for (o, row) in rows {
        let place = o
            .position
            .filter(|_| o.quantity == Quantity::TransmissionError);
        if let Some(place) = place {
            let curve = curves.entry((o.test, o.cycles.to_bits(), o.trace));
            curve
                .or_default()
                .push([place, row.model, o.value, o.sigma]);
        }
    }
    let of_curves: Vec<(usize, Option<f64>)> = (curves.into_iter())
        .filter(|(_, curve)| curve.len() >= FEWEST)
        .map(|((test, ..), mut curve)| {
            curve.sort_by(|a, b| a[0].total_cmp(&b[0]));
            (test, moved_by(&curve))
        })
        .collect();
    let first = of_curves.iter().find_map(|(_, by)| *by)?;
    let is_one = |by: &Option<f64>| by.is_some_and(|by| around(by - first).abs() <= SAME);
    let of = |test: usize| of_curves.iter().filter(move |(other, _)| *other == test);
    let mut tests: Vec<usize> = of_curves.iter().map(|(test, _)| *test).collect();
    tests.dedup();
    let is_moved = |test: &usize| of(*test).all(|(_, by)| is_one(by));
    let (moved, others): (Vec<usize>, Vec<usize>) = tests.iter().partition(|test| is_moved(test));
    // where some curves are moved by something else, they are not moved
    let is_plain = others
        .iter()
        .all(|test| of(*test).all(|(_, by)| by.is_none()));
    if moved.is_empty() || !is_plain {
        return None;
    }
    let ids: Vec<&str> = moved.iter().map(|t| study.tests[*t].id.as_str()).collect();
    let whose = match others.is_empty() {
        true => "transmission_error runs".to_owned(),
        false => format!("transmission_error of {} runs", tests_in_words(&ids)),
    };
    let (by, turn, when) = match first > 0.0 {
        true => (first, "add", "later"),
        false => (-first, "take off", "earlier"),
    };
    Some(format!(
        "{whose} as computed {by:.2} base pitches {when}: do its positions count from another rotation? They are fractions of a base pitch, 0 where the \
         contact is at the pitch point; {turn} {by:.2}, keep the part behind the point and check again"
    ))
}

/// A rotation within half a pitch either way.
fn around(rotation: f64) -> f64 {
    rotation - rotation.round()
}

/// By how much a curve's places have to grow to fit; None where it fits as it stands, or no better elsewhere.
fn moved_by(curve: &Curve) -> Option<f64> {
    let whole: f64 = squares(curve, |_| 0.0);
    let stays = squares(curve, |place| computed(curve, place));
    let turned = squares(curve, |place| -computed(curve, place));
    let tried = (0..TRIED).map(|n| around(n as f64 / TRIED as f64));
    let of = |by: f64| (squares(curve, |place| computed(curve, place + by)), by);
    let (least, by) = tried.map(of).min_by(|a, b| a.0.total_cmp(&b.0))?;
    let is_moved = by.abs() >= LEAST
        && stays > BEYOND_NOISE * curve.len() as f64
        && least < LEFT * stays
        && least < LEFT_OF_ALL * whole
        && least < turned;
    is_moved.then_some(by)
}

/// The weighted squares of what is measured less what a function says of its place, without the mean.
fn squares(curve: &Curve, says: impl Fn(f64) -> f64) -> f64 {
    let left: Vec<[f64; 2]> = (curve.iter())
        .map(|[place, _, measured, sigma]| [measured - says(*place), sigma.powi(-2)])
        .collect();
    let weight: f64 = left.iter().map(|[_, w]| w).sum();
    let mean = left.iter().map(|[x, w]| w * x).sum::<f64>() / weight;
    left.iter().map(|[x, w]| w * (x - mean).powi(2)).sum()
}

/// The computed curve at a rotation, linear between its places.
fn computed(curve: &Curve, place: f64) -> f64 {
    let place = place - place.floor();
    let last = curve.len() - 1;
    let next = curve.iter().position(|point| point[0] >= place);
    // from the last place over the end of the pitch to the first
    let ([a, fa, ..], [b, fb, ..]) = match next {
        Some(0) => (shifted(curve[last], -1.0), curve[0]),
        Some(next) => (curve[next - 1], curve[next]),
        None => (curve[last], shifted(curve[0], 1.0)),
    };
    match b > a {
        true => fa + (fb - fa) * (place - a) / (b - a),
        false => fa,
    }
}

fn shifted([place, computed, measured, sigma]: [f64; 4], by: f64) -> [f64; 4] {
    [place + by, computed, measured, sigma]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Dataset;

    /// A rotation with two pairs in contact over the first part and one over the rest, `by` later, in µrad.
    fn curve(by: f64, scale: f64) -> Curve {
        let wave = |place: f64| {
            let place = place - place.floor();
            if place < 0.6 { 10.0 * place } else { 40.0 }
        };
        let of = |n: usize| {
            let place = n as f64 / 24.0;
            let noise = [0.3, -0.2, 0.1][n % 3];
            [
                place,
                wave(place),
                scale * wave(place + by) + 5.0 + noise,
                0.3,
            ]
        };
        (0..24).map(of).collect()
    }

    /// y(p) = f(p + 0.25) in one test of two: 0.25 is to be added to its places.
    #[test]
    fn the_test_and_the_way_are_said() {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let mut text = "test,member,cycles,quantity,position,value,sigma\n".to_owned();
        let mut models = Vec::new();
        for (test, by) in [("A", 0.0), ("B", 0.25)] {
            for [place, model, value, sigma] in curve(by, 1.0) {
                text += &format!("{test},pair,200000,transmission_error,{place},{value},{sigma}\n");
                models.push(model);
            }
        }
        let data = Dataset::parse(&text, "m.csv", &study.known()).unwrap();
        let fits = super::super::fits_of(&models);
        let rows: Vec<FittedRow<'_>> = data.observations.iter().zip(&fits).collect();
        let said = moved_rotation(&study, &rows).unwrap();
        assert!(
            said.starts_with("transmission_error of test B runs as computed 0.2")
                && said.contains("; add 0.2"),
            "{said}"
        );
        assert_eq!(moved_rotation(&study, &rows[..24]), None);
    }

    #[test]
    fn curves_that_count_from_elsewhere_are_told_and_others_not() {
        for by in [0.5, 0.25, -0.25] {
            let found = moved_by(&curve(by, 1.0)).unwrap();
            assert!(around(found - by).abs() < 0.03, "{by}: {found}");
        }
        for (by, scale) in [(0.0, 1.0), (0.0, -1.0), (0.0, 2.0), (0.04, 1.0)] {
            assert_eq!(moved_by(&curve(by, scale)), None, "{by} {scale}");
        }
    }
}
