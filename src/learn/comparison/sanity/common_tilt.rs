//! Curves of a member that are all tilted alike, whether little or much is worn: the measuring machine's doing, for what is wrong with wear grows with it.
//!
//! ```text
//! y = c + s f + t x      per curve, least squares weighted by 1/σ²; f the fitted model, x from −½ (root side) to ½ (tip side)
//! t = a + b max f        over the curves of a test
//! |a| > 6 σ_a and |a| > 2 |b| max f of the least worn curve, a of every test within a quarter of their median
//! ```

use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

use super::super::residual_statistics::FittedRow;
use super::flank_curves::{Point, curves_of};
use super::rounded;
use crate::measure::Subject;
use crate::numeric::median;
use crate::study::Study;

/// Fewest curves of a test, and fewest tests.
const CURVES: usize = 3;
const TESTS: usize = 2;
/// Standard deviations from which a test's tilt is sure.
const SURE: f64 = 6.0;
/// How many times what grows with wear it must be in the least worn curve.
const OVER_GROWN: f64 = 2.0;
/// How far a test's may be from the usual one.
const NEAR: f64 = 0.25;
/// Factor between the least and the most worn curve of a test, by the model.
const WORN_APART: f64 = 3.0;

/// A question for each member of which the curves of all tests are tilted alike.
pub(super) fn common_tilt(study: &Study, rows: &[FittedRow<'_>]) -> Vec<String> {
    let usual = study.noise.tilt_um;
    let members = [Subject::Pinion, Subject::Gear].into_iter();
    let found = members.filter_map(|member| {
        let of_test = |test: usize| {
            let own = rows.iter().filter(|(o, _)| o.test == test);
            tilt_of_test(&curves_of(&own.copied().collect::<Vec<_>>(), member))
        };
        let tilts: Vec<Tilt> = (0..study.tests.len()).filter_map(of_test).collect();
        let tilt = alike(&tilts).filter(|tilt| tilt.abs() > usual)?;
        let (higher, lower) = if tilt > 0.0 {
            ("tip", "root")
        } else {
            ("root", "tip")
        };
        let size = rounded(tilt.abs());
        Some(format!(
            "the {}'s depth curves are tilted by the same {size} µm from end to end, more at the {higher} than at the {lower}, whether little or \
             much is worn, which no wear does: look at how the profiles were aligned (base circle, centring). Take the tilt off, or state [noise] \
             trace_tilt = {size} (µm), which allows for it",
            member.name(),
        ))
    });
    found.collect()
}

/// A test's tilt besides what grows with wear, µm from end to end, and whether it is beyond doubt.
struct Tilt {
    size: f64,
    is_sure: bool,
}

/// The middle one of tests' tilts where all are sure and alike: one that some have only may be a plastic deformation under their load.
fn alike(tilts: &[Tilt]) -> Option<f64> {
    let usual = median(tilts.iter().map(|tilt| tilt.size).collect())?;
    let fits = |tilt: &Tilt| tilt.is_sure && (tilt.size - usual).abs() < NEAR * usual.abs();
    (tilts.len() >= TESTS && tilts.iter().all(fits)).then_some(usual)
}

/// None where the curves are too few or worn too much alike.
fn tilt_of_test(curves: &[Vec<Point>]) -> Option<Tilt> {
    let worn: Vec<f64> = curves.iter().map(|curve| largest(curve)).collect();
    let least = worn.iter().copied().fold(f64::INFINITY, f64::min);
    let most = worn.iter().copied().fold(0.0, f64::max);
    if curves.len() < CURVES || most < WORN_APART * least {
        return None;
    }
    let tilts: Option<Vec<[f64; 2]>> = curves.iter().map(|curve| tilt_of(curve)).collect();
    let tilts = tilts?;
    let rows = || {
        let row = |([tilt, sigma], worn): (&[f64; 2], &f64)| {
            (Vector2::new(1.0, worn / most) / *sigma, tilt / sigma)
        };
        tilts.iter().zip(&worn).map(row)
    };
    let normal: Matrix2<f64> = rows().map(|(row, _)| row * row.transpose()).sum();
    let right: Vector2<f64> = rows().map(|(row, tilt)| row * tilt).sum();
    let covariance = normal.try_inverse()?;
    let found = covariance * right;
    let left: f64 = rows()
        .map(|(row, tilt)| (tilt - row.dot(&found)).powi(2))
        .sum();
    let scatter = (left / (tilts.len() - 2) as f64).max(1.0);
    let sigma = (scatter * covariance[(0, 0)]).sqrt();
    let grown = found[1].abs() * least / most;
    Some(Tilt {
        size: found[0],
        is_sure: found[0].abs() > (SURE * sigma).max(OVER_GROWN * grown),
    })
}

fn largest(curve: &[Point]) -> f64 {
    curve.iter().map(|p| p[2]).fold(0.0, f64::max)
}

/// A curve's tilt beside its constant and the model's shape, and the tilt's standard deviation by the scatter that is left.
fn tilt_of(curve: &[Point]) -> Option<[f64; 2]> {
    let (low, high) = (curve.first()?[0], curve.last()?[0]);
    let largest = largest(curve);
    let row = |p: &Point| {
        let x = (p[0] - low) / (high - low) - 0.5;
        Vector3::new(1.0, p[2] / largest, x) / p[3]
    };
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for point in curve {
        let row = row(point);
        normal += row * row.transpose();
        right += row * (point[1] / point[3]);
    }
    let covariance = normal.try_inverse()?;
    let found = covariance * right;
    let left = |p: &Point| (p[1] / p[3] - row(p).dot(&found)).powi(2);
    let freedom = curve.len().checked_sub(3).filter(|n| *n > 0)?;
    let scatter = curve.iter().map(left).sum::<f64>() / freedom as f64;
    Some([found[2], (scatter.max(1.0) * covariance[(2, 2)]).sqrt()])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Curves of growing wear, each with a tilt in µm.
    fn curves(tilts: &dyn Fn(f64) -> f64) -> Vec<Vec<Point>> {
        let curve = |i: i32| {
            let worn = f64::from(i);
            let point = |at: i32| {
                let x = f64::from(at) / 20.0 - 0.5;
                let model = worn * (1.0 + (6.0 * x).cos());
                let noise = 0.05 * (37.0 * f64::from(at) + worn).sin();
                let wear = 1.1 * model + 0.03 * worn * (11.0 * x).sin();
                [27.0 + x, wear + tilts(worn) * x + 0.4 + noise, model, 0.05]
            };
            (0..21).map(point).collect()
        };
        (1..=8).map(curve).collect()
    }

    #[test]
    fn a_tilt_that_does_not_grow_with_wear_is_asked_about() {
        let of = |tests: &[&dyn Fn(f64) -> f64]| {
            let tilts = tests.iter().map(|tilt| tilt_of_test(&curves(tilt)));
            alike(&tilts.collect::<Option<Vec<Tilt>>>().unwrap())
        };
        let both = |tilt: &dyn Fn(f64) -> f64| of(&[tilt, tilt]);
        let found = both(&|_| 1.5).unwrap();
        assert!((found - 1.5).abs() < 0.3, "{found}");
        // beside what is wrong with the wear
        let found = both(&|worn| 1.5 - 0.2 * worn).unwrap();
        assert!((found - 1.5).abs() < 0.3, "{found}");
        // wear off the model's shape grows; none
        assert_eq!(both(&|worn| 0.4 * worn), None);
        assert_eq!(both(&|_| 0.0), None);
        // each its own; one test, and one of two
        assert_eq!(both(&|worn| 1.5 * (2.0 * worn).sin()), None);
        assert_eq!(of(&[&|_| 1.5]), None);
        assert_eq!(of(&[&|_| 1.5, &|_| 0.7]), None);
        assert_eq!(of(&[&|_| 1.5, &|_| 0.0]), None);
        // all worn alike
        let alike_worn: Vec<Vec<Point>> = (curves(&|_| 1.5).into_iter().take(2).cycle())
            .take(8)
            .collect();
        assert!(tilt_of_test(&alike_worn).is_none());
    }

    /// More depth towards larger radii is more at the tip, of either member.
    #[test]
    fn the_higher_end_and_the_size_are_named() {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let said = |size: f64| {
            let mut text = "test,member,cycles,quantity,position,value,sigma,trace\n".to_owned();
            let mut models = Vec::new();
            for test in ["A", "B"] {
                for (i, curve) in curves(&|_| size).into_iter().enumerate() {
                    for [place, depth, model, sigma] in curve {
                        let place = place + 0.5;
                        let cycles = 10_000 * (i + 1);
                        text += &format!(
                            "{test},pinion,{cycles},wear_depth,{place},{depth},{sigma},{test}{i}\n"
                        );
                        models.push(model);
                    }
                }
            }
            let data = crate::measure::Dataset::parse(&text, "m.csv", &study.known()).unwrap();
            let fits = super::super::fits_of(&models);
            let rows: Vec<FittedRow<'_>> = data.observations.iter().zip(&fits).collect();
            common_tilt(&study, &rows)
        };
        let tip = said(2.0);
        assert_eq!(tip.len(), 1);
        assert!(
            tip[0].starts_with("the pinion's depth curves are tilted by the same 2.")
                && tip[0].contains("more at the tip than at the root"),
            "{tip:?}"
        );
        let root = said(-2.0);
        assert!(
            root[0].contains("more at the root than at the tip"),
            "{root:?}"
        );
        assert!(said(0.0).is_empty());
    }
}
