//! Curves that fit far better with their places counted from the other end, or all moved by the same distance.
//!
//! ```text
//! X(p') = Σ over curves of min over c, s ≥ 0 of Σ ((y(p) − c − s f(p'))/σ)²      f the fitted model along the curve, between its points
//! p' = low + high − p: upside down;  p' = p − δ: moved by δ      asked where X(p) is large and X(p') below a third of it
//! ```
//! Of the shape alone: neither k nor zeros hide it. One curve upside down among others is told by these (`reversed`).

use super::super::residual_statistics::FittedRow;
use super::flank_curves::{FEWEST, Point, curves_of};
use crate::measure::Subject;
use crate::study::Study;

/// Fewest curves.
const CURVES: usize = 3;
/// χ² per point of the shape from which it is looked at, and the part that must be left.
const LARGE: f64 = 4.0;
const LEFT: f64 = 1.0 / 3.0;
/// Distances that are tried, in mm: so many steps to either side.
const STEP: f64 = 0.05;
const STEPS: i32 = 10;

/// A question for each member of which the places fit far better otherwise, or one for both; else for the tests of which those of a member fit far
/// better upside down.
pub(super) fn moved_places(study: &Study, rows: &[FittedRow<'_>]) -> Vec<String> {
    let [pinion, gear] = [Subject::Pinion, Subject::Gear].map(|member| of(rows, member));
    if pinion.or(gear).is_none() {
        return upside_down_in_some_tests(study, rows);
    }
    let both = pinion.is_some() && pinion == gear;
    let said = [("the pinion's", pinion), ("the gear's", gear)];
    let said = said
        .into_iter()
        .filter_map(|(whose, found)| Some((whose, found?)));
    let said = said.map(|(whose, found)| match both {
        true => ("all", found),
        false => (whose, found),
    });
    let lines = said.map(|(whose, found)| match found {
        Better::UpsideDown => format!(
            "{whose} depth curves fit far better upside down: do their places run from tip to root where root to tip is stated?"
        ),
        Better::Moved(steps) => format!(
            "{whose} depth curves fit far better at radii that are about {:.2} mm {}: look at the zero of the radii, at tip diameter, pressure angle and profile shift, and at centre distance and misalignment of the study; if \
             all are right, gearwear diagnose tells what else moves the contact along a flank",
            STEP * f64::from(steps.abs()),
            if steps > 0 { "smaller" } else { "larger" }
        ),
    });
    lines.take(if both { 1 } else { 2 }).collect()
}

fn upside_down_in_some_tests(study: &Study, rows: &[FittedRow<'_>]) -> Vec<String> {
    let mut said = Vec::new();
    for member in [Subject::Pinion, Subject::Gear] {
        let turned = (study.tests.iter().enumerate()).filter(|(test, _)| {
            let own = rows.iter().filter(|(o, _)| o.test == *test);
            let own: Vec<FittedRow<'_>> = own.copied().collect();
            of(&own, member) == Some(Better::UpsideDown)
        });
        let turned: Vec<&str> = turned.map(|(_, test)| test.id.as_str()).collect();
        if !turned.is_empty() {
            said.push(format!(
                "the {}'s depth curves of test{} {} fit far better upside down, those of the other tests do not: do their places run from tip to \
                 root where root to tip is stated?",
                member.name(),
                if turned.len() > 1 { "s" } else { "" },
                turned.join(", ")
            ));
        }
    }
    said
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Better {
    UpsideDown,
    Moved(i32),
}

fn of(rows: &[FittedRow<'_>], member: Subject) -> Option<Better> {
    let curves = curves_of(rows, member);
    if curves.len() < CURVES {
        return None;
    }
    // on the same points as they stand, for those that move beyond the curve's ends drop out
    let left = |to: &dyn Fn(&[Point], f64) -> f64| {
        let mut sums = [0.0; 3];
        for curve in &curves {
            for (sum, x) in sums.iter_mut().zip(misfit(curve, to)) {
                *sum += x;
            }
        }
        let [stands, moved, points] = sums;
        (stands > LARGE * points).then_some(moved / stands)
    };
    let mirrored = left(&|curve, place| curve[0][0] + curve[curve.len() - 1][0] - place);
    let mirrored = mirrored.map(|left| (Better::UpsideDown, left));
    let moved = (-STEPS..=STEPS)
        .filter(|steps| steps.abs() > 1)
        .filter_map(|steps| {
            let by = STEP * f64::from(steps);
            Some((Better::Moved(steps), left(&|_, place| place - by)?))
        });
    let best = mirrored
        .into_iter()
        .chain(moved)
        .min_by(|a, b| a.1.total_cmp(&b.1));
    best.filter(|(_, left)| *left < LEFT)
        .map(|(better, _)| better)
}

/// χ² of a curve's shape as it stands and with its places moved, and the number of points.
fn misfit(curve: &[Point], to: &dyn Fn(&[Point], f64) -> f64) -> [f64; 3] {
    let kept: Vec<(Point, f64)> = (curve.iter())
        .filter_map(|point| Some((*point, between(curve, to(curve, point[0]))?)))
        .collect();
    if kept.len() < FEWEST {
        return [0.0; 3];
    }
    let chi2 = |f: &dyn Fn(&(Point, f64)) -> f64| {
        let mean = |of: &dyn Fn(&(Point, f64)) -> f64| {
            let weight = |point: &(Point, f64)| point.0[3].powi(-2);
            let sum: f64 = kept.iter().map(|p| weight(p) * of(p)).sum();
            sum / kept.iter().map(weight).sum::<f64>()
        };
        let (of_f, of_y) = (mean(f), mean(&|p| p.0[1]));
        let [mut ff, mut fy, mut yy] = [0.0; 3];
        for point in &kept {
            let (f, y) = (
                (f(point) - of_f) / point.0[3],
                (point.0[1] - of_y) / point.0[3],
            );
            (ff, fy, yy) = (ff + f * f, fy + f * y, yy + y * y);
        }
        yy - fy.max(0.0).powi(2) / ff.max(f64::MIN_POSITIVE)
    };
    [chi2(&|p| p.0[2]), chi2(&|p| p.1), kept.len() as f64]
}

/// The model between two points of a curve; None beyond its ends.
fn between(curve: &[Point], place: f64) -> Option<f64> {
    let pair = curve.windows(2).find(|pair| {
        let slack = 1e-9 * place;
        pair[0][0] - slack <= place && place <= pair[1][0] + slack
    })?;
    let share = (place - pair[0][0]) / (pair[1][0] - pair[0][0]).max(f64::MIN_POSITIVE);
    Some(pair[0][2] + share * (pair[1][2] - pair[0][2]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Dataset;

    fn wear(place: f64) -> f64 {
        let x = place - 27.0;
        6.0 * (1.0 - 0.5 * x).abs() + 2.0 * (-x * x).exp()
    }

    /// What is said of three curves of the pinion of each test that wore as the model has it at other places.
    fn said(of_tests: &[(&str, &dyn Fn(f64) -> f64)]) -> Vec<String> {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let mut text = "test,member,cycles,quantity,position,value,sigma\n".to_owned();
        let mut models = Vec::new();
        for (test, true_place) in of_tests {
            for cycles in [1e5, 2e5, 3e5] {
                for at in 0..20 {
                    let place = 26.0 + 0.15 * f64::from(at);
                    let value = 1e-5 * cycles * wear(true_place(place)) + 0.4;
                    text += &format!("{test},pinion,{cycles},wear_depth,{place},{value},0.1\n");
                    models.push(0.5e-5 * cycles * wear(place));
                }
            }
        }
        let data = Dataset::parse(&text, "m.csv", &study.known()).unwrap();
        let fits = super::super::fits_of(&models);
        let rows: Vec<FittedRow<'_>> = data.observations.iter().zip(&fits).collect();
        moved_places(&study, &rows)
    }

    #[test]
    fn places_upside_down_or_moved_are_asked_about() {
        let right = |place: f64| place;
        let mirrored = |place: f64| 26.0 + 28.85 - place;
        let turned = said(&[("A", &mirrored)]);
        assert!(
            turned[0].starts_with("the pinion's depth curves fit far better upside down"),
            "{turned:?}"
        );
        let moved = said(&[("A", &|place| place - 0.3)]);
        assert!(
            moved[0].contains("at radii that are about 0.30 mm smaller"),
            "{moved:?}"
        );
        assert!(said(&[("A", &right)]).is_empty());
        let one_test = said(&[
            ("A", &right),
            ("B", &mirrored),
            ("C", &right),
            ("D", &right),
        ]);
        assert_eq!(one_test.len(), 1);
        assert!(
            one_test[0]
                .starts_with("the pinion's depth curves of test B fit far better upside down"),
            "{one_test:?}"
        );
        assert!(said(&[("A", &right), ("B", &right)]).is_empty());
    }
}
