//! Rows that stand apart from their neighbours along a curve: dust, burrs, slipped decimal points.
//!
//! One row after the other, the one that stands farthest apart first, until none does (its own value would draw the others along). Two rows side by
//! side hide each other, and make a right one beside them stand apart, and so does one at the end of a curve: where rows nearby still do once that one is
//! passed over, and none does without another, or without two neighbours, it is these. A place where several curves of a member do alike, or that the other
//! profiles of a coarse curve lead up to, is a feature of the flank and no outlier, and neither is a value
//! between those beside it, the edge of what is worn, or one that both sides lead up to.

mod curve;
mod in_words;
mod profiles;

use std::collections::BTreeMap;

use self::curve::{Curve, Standing};
use self::profiles::OtherProfiles;
use super::neighbours::{curves, points};
use super::quantity::Quantity;
use super::{Dataset, Observation};
use crate::numeric::{MEDIAN_OF_NORMAL, median};

/// Standard deviations from what the neighbours say from which a row stands apart: one of 150 000 Gaussian ones.
const APART: f64 = 4.5;
/// The same of a slip in writing: a digit, a decimal place.
const SLIP: f64 = 20.0;
/// Standard deviations from which another curve does alike at the same place, and share of the curves there that must.
const ALIKE: f64 = 2.5;
const FEATURE: f64 = 0.3;
/// Standard deviations from which all curves together do alike, and how many of them have to: one bad row is no feature.
const SURE: f64 = 3.0;
const SEVERAL: usize = 2;
/// A curve's own scatter counts for so much of it beside that of all curves: of few points it is uncertain.
const OWN: f64 = 0.8;
/// Least scatter over the stated one that is believed: values without noise have corners that no sigma stands for.
const LEAST: f64 = 0.5;

/// A row that stands apart from its neighbours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outlier {
    /// Its place in [`Dataset::observations`].
    pub row: usize,
    /// The value that its neighbours lead one to expect.
    pub expected: f64,
    /// Standard deviations that it stands apart.
    pub apart: f64,
    /// σ as the file states it.
    pub stated_sigma: f64,
    /// What the value reads with its decimal point put right, where it looks like a slip.
    pub meant: Option<f64>,
}

/// Standard deviation of numbers about 0 by the median of their magnitudes, in which a few large ones do not show.
fn scatter(magnitudes: Vec<f64>) -> f64 {
    median(magnitudes).map_or(1.0, |middle| {
        (middle / MEDIAN_OF_NORMAL).max(f64::MIN_POSITIVE)
    })
}

/// All rows that stand apart from their neighbours.
pub fn outliers(observations: &[Observation]) -> Vec<Outlier> {
    let rows: Vec<&Observation> = observations.iter().collect();
    let curves = curves(&rows);
    let profiles = OtherProfiles::new(&rows, &curves);
    let slips: Vec<Outlier> = (rows.iter().enumerate())
        .filter_map(|(row, o)| {
            let slip = profiles.slip(row, o.value)?;
            Some(Outlier {
                row,
                expected: slip.expected,
                apart: slip.apart,
                stated_sigma: o.sigma,
                meant: slip.meant,
            })
        })
        .collect();
    let has_slipped = |row: &usize| slips.iter().any(|slip| slip.row == *row);
    let mut all: Vec<Curve> = (curves.into_iter())
        .map(|own| {
            let points = points(&rows, &own);
            let mut curve = Curve {
                passed_over: own.iter().map(has_slipped).collect(),
                rows: own,
                points,
                scale: 1.0,
            };
            let apart = curve.all_apart();
            curve.scale = scatter(apart);
            curve
        })
        .collect();
    // σ may be misjudged, by all curves of a quantity alike, or by those of a test: the middle one of tests knows nothing of one that is
    let mut of_tests: BTreeMap<(Quantity, usize), Vec<f64>> = BTreeMap::new();
    for curve in &all {
        let o = rows[curve.rows[0]];
        let apart = curve.all_apart().into_iter().map(|z| z * curve.scale);
        of_tests
            .entry((o.quantity, o.test))
            .or_default()
            .extend(apart);
    }
    let of_tests: BTreeMap<(Quantity, usize), f64> = (of_tests.into_iter())
        .map(|(of, apart)| (of, scatter(apart)))
        .collect();
    let mut together: BTreeMap<Quantity, Vec<f64>> = BTreeMap::new();
    for ((quantity, _), own) in &of_tests {
        together.entry(*quantity).or_default().push(*own);
    }
    let together: BTreeMap<Quantity, f64> = (together.into_iter())
        .map(|(quantity, of_tests)| (quantity, median(of_tests).unwrap_or(1.0)))
        .collect();
    let common: BTreeMap<(Quantity, usize), f64> = (of_tests.iter())
        .map(|(&(quantity, test), own)| ((quantity, test), own.max(together[&quantity])))
        .collect();
    for curve in &mut all {
        let o = rows[curve.rows[0]];
        let common = common[&(o.quantity, o.test)];
        curve.scale = common.max(OWN * curve.scale).max(LEAST);
    }
    let mut found = Vec::new();
    for number in 0..all.len() {
        let mut kept = vec![false; all[number].points.len()];
        loop {
            let curve = &all[number];
            let worst = (0..curve.points.len())
                .filter(|&at| !curve.passed_over[at] && !kept[at])
                .filter_map(|at| Some((at, curve.apart(at)?.0.abs())))
                .max_by(|a, b| a.1.total_cmp(&b.1));
            let worst = worst.filter(|worst| worst.1 > APART);
            let Some(worst) = worst.and_then(|worst| curve.standing(worst.0)) else {
                break;
            };
            let at = worst.at;
            let others = all[number].others_instead_of(at, &kept);
            let standing = others.unwrap_or_else(|| vec![worst]);
            let is_feature = |one: &Standing| {
                let row = all[number].rows[one.at];
                one.is_a_corner
                    || profiles.lead_to(row, rows[row].value, one.expected)
                    || is_shared(&all, &rows, number, one)
            };
            if standing.iter().any(is_feature) {
                kept[at] = true;
                continue;
            }
            for one in standing {
                let row = all[number].rows[one.at];
                found.push(Outlier {
                    row,
                    expected: one.expected,
                    apart: one.apart.abs(),
                    stated_sigma: rows[row].sigma,
                    meant: None,
                });
                all[number].passed_over[one.at] = true;
            }
        }
    }
    found.extend(slips);
    found.sort_by_key(|outlier| outlier.row);
    found
}

/// Whether a share of the other curves of the member does alike at the place of a point, or all of them together do in proportion to their depths, as wear
/// bends:
///
/// ```text
/// z_c: standard deviations that curve c stands apart there;  p_c = |z| d_c/d: what it would in proportion
/// b = Σ z p/Σ p² ≥ 0.3,  b √Σ p² ≥ 3             z counts up to p; of two curves or more
/// ```
fn is_shared(all: &[Curve], rows: &[&Observation], number: usize, one: &Standing) -> bool {
    let curve = &all[number];
    let of = |curve: &Curve| {
        let o = rows[curve.rows[0]];
        (o.member, o.quantity)
    };
    let others: Vec<(f64, f64)> = (all.iter().enumerate())
        .filter(|(i, other)| *i != number && of(other) == of(curve))
        .filter_map(|(_, other)| {
            let apart = other.near(curve.points[one.at][0])?;
            let in_proportion = one.apart.abs() * other.depth() / curve.depth();
            Some((apart * one.apart.signum(), in_proportion))
        })
        .collect();
    let same = others.iter().filter(|other| other.0 > ALIKE).count();
    let along: f64 = (others.iter()).map(|(z, p)| z.min(*p) * p).sum();
    let square: f64 = others.iter().map(|(_, p)| p * p).sum();
    let together = along >= FEATURE * square && along >= SURE * square.sqrt();
    let takes_part = |(z, p): &&(f64, f64)| *p > ALIKE && *z >= FEATURE * p;
    let in_proportion = together && others.iter().filter(takes_part).count() >= SEVERAL;
    same > 0 && (same as f64 >= FEATURE * others.len() as f64 || in_proportion)
}

impl Dataset {
    /// Whether rows stand so far apart from their neighbours that nothing should be made of them before they are put right: a slip in writing. None
    /// does where they count with a σ that allows for it.
    pub fn has_slips(&self) -> bool {
        let is_slip = |outlier: &Outlier| {
            let counts_fully = self.observations[outlier.row].sigma <= outlier.stated_sigma;
            counts_fully && (outlier.meant.is_some() || outlier.apart.abs() > SLIP)
        };
        self.outliers.iter().any(is_slip)
    }

    /// Finds the rows that stand apart from their neighbours; if `robust`, they count with a σ as large as they stand apart.
    pub(crate) fn find_outliers(&mut self, robust: bool) {
        self.outliers = outliers(&self.observations);
        if robust {
            for outlier in &self.outliers {
                let o = &mut self.observations[outlier.row];
                o.sigma = o.sigma.hypot(o.value - outlier.expected);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Subject;

    /// Places of the rows found on a curve of 41 points, a bump of 10 µm with a little noise, of which some have other values.
    fn found(other: &[(usize, f64)]) -> Vec<usize> {
        let rows = (0..41).map(|i| {
            let x = (f64::from(i) - 20.0) / 20.0;
            // no two neighbours alike, and the same at every run
            let noise = 0.1 * (f64::from(i) * 2.4).sin();
            let at = usize::try_from(i).unwrap();
            let bad = other.iter().find(|(place, _)| *place == at);
            Observation {
                test: 0,
                member: Subject::Pinion,
                cycles: 1e5,
                quantity: Quantity::WearDepth,
                position: Some(22.0 + 0.1 * f64::from(i)),
                value: bad.map_or(10.0 * (1.0 - x * x) + noise, |(_, value)| *value),
                sigma: 0.1,
                trace: None,
                face: None,
                tooth: None,
                line: 2 + at,
            }
        });
        let rows: Vec<Observation> = rows.collect();
        outliers(&rows).iter().map(|outlier| outlier.row).collect()
    }

    #[test]
    fn two_bad_rows_side_by_side_are_found_and_not_the_right_one_beside_them() {
        assert_eq!(found(&[]), [0; 0]);
        assert_eq!(found(&[(17, -999.0)]), [17]);
        assert_eq!(found(&[(17, -999.0), (18, -999.0)]), [17, 18]);
        assert_eq!(found(&[(17, 0.0), (18, 0.0)]), [17, 18]);
        assert_eq!(found(&[(17, 99.0), (18, 99.0)]), [17, 18]);
        assert_eq!(found(&[(17, 99.0), (18, -99.0)]), [17, 18]);
        // the dip at the pitch point is led up to from either side
        let dip = [(15, 6.5), (16, 4.0), (17, 1.2), (18, 4.1), (19, 6.6)];
        assert_eq!(found(&dip), [0; 0]);
        // so is what bends at an end more than a parabola follows; a burr there is not
        assert_eq!(found(&[(38, 2.1), (39, 3.0), (40, 5.6)]), [0; 0]);
        assert_eq!(found(&[(40, 8.0)]), [40]);
        // apart from one another each is found by itself
        assert_eq!(found(&[(10, 99.0), (30, -99.0)]), [10, 30]);
    }

    /// Curves of 30 points (too many for [`OtherProfiles`]) below the tip of a gear, these deep in the end, with noise of 0.15 µm: below the tip a dip of 35 %
    /// at one point, and a rise behind it; or smooth.
    fn below_the_tip(depths: &[f64], smooth: bool) -> Vec<Observation> {
        let rows = (0..30 * depths.len()).map(|i| {
            let (curve, at) = (i / 30, i % 30);
            let shape = match at {
                28 if !smooth => 0.5,
                29 if !smooth => 1.0,
                at => 0.2 + 0.55 * (at as f64 / 27.0),
            };
            let noise = 0.15 * (1.7 * i as f64).sin() * 1.4;
            Observation {
                test: curve / 3,
                member: Subject::Gear,
                cycles: 1e5 * (1 + curve % 3) as f64,
                quantity: Quantity::WearDepth,
                position: Some(104.0 + 0.22 * at as f64),
                value: depths[curve] * shape + noise,
                sigma: 0.15,
                trace: None,
                face: None,
                tooth: None,
                line: 2 + i,
            }
        });
        rows.collect()
    }

    /// Shallow curves cannot show what a deep one does: the deep ones say whether it is the flank's.
    #[test]
    fn what_the_deep_curves_share_is_the_flank_s() {
        let depths = [0.7, 1.2, 3.0, 1.0, 2.8, 7.5, 1.1, 1.9, 5.2, 0.4, 1.7, 5.6];
        assert_eq!(outliers(&below_the_tip(&depths, false)).len(), 0);
        // in one curve alone it is a bad row, and a second one at the same place does not make it right
        let mut rows = below_the_tip(&depths, true);
        let found = |rows: &[Observation]| -> Vec<usize> {
            outliers(rows).iter().map(|outlier| outlier.row).collect()
        };
        assert_eq!(found(&rows), [0; 0]);
        let [first, second] = [5, 8].map(|curve| 30 * curve + 28);
        rows[first].value = 0.5 * depths[5];
        assert_eq!(found(&rows), [first]);
        rows[second].value = 0.5;
        assert_eq!(found(&rows), [first, second]);
    }

    const HEIGHTS: [f64; 6] = [1.0, 1.6, 2.2, 2.8, 3.4, 4.0];

    /// Profiles of ten radii at these heights, alike but for 2 %, of which one row is multiplied.
    fn coarse(heights: &[f64], shape: [f64; 10], row: usize, times: f64) -> Vec<Observation> {
        let rows = (0..10 * heights.len()).map(|i| {
            let (profile, at) = (i / 10, i % 10);
            let height = heights[profile];
            let noise = 1.0 + 0.02 * (2.4 * i as f64).sin();
            let value = height * shape[at] * noise;
            Observation {
                test: profile / 3,
                member: Subject::Gear,
                cycles: 1e5 * (1 + profile % 3) as f64,
                quantity: Quantity::WearDepth,
                position: Some(40.0 + 0.4 * at as f64),
                value: if i == row { times * value } else { value },
                sigma: 0.4,
                trace: None,
                face: None,
                tooth: None,
                line: 2 + i,
            }
        });
        rows.collect()
    }

    fn of_coarse(heights: &[f64], shape: [f64; 10], row: usize, times: f64) -> Vec<Outlier> {
        outliers(&coarse(heights, shape, row, times))
    }

    #[test]
    fn a_slipped_decimal_point_in_a_coarse_curve_is_found_by_the_other_profiles() {
        let shape = [3.0, 6.2, 5.9, 4.0, 1.5, 0.4, 1.6, 3.9, 5.0, 4.8];
        assert_eq!(of_coarse(&HEIGHTS, shape, 0, 1.0), []);
        for (row, times) in [(8, 10.0), (13, 0.1), (20, 10.0), (37, 0.01), (59, 0.1)] {
            let found = of_coarse(&HEIGHTS, shape, row, times);
            assert_eq!(found.len(), 1, "{row}: {found:?}");
            assert_eq!(found[0].row, row);
            let (meant, expected) = (found[0].meant.unwrap(), found[0].expected);
            assert!((meant / expected - 1.0).abs() < 0.1, "{row}: {found:?}");
        }
        // twice as much is no slip, and of two profiles nobody knows which is right
        assert!(
            of_coarse(&HEIGHTS, shape, 13, 2.0)
                .iter()
                .all(|o| o.meant.is_none())
        );
        assert!(
            of_coarse(&HEIGHTS[..2], shape, 13, 0.1)
                .iter()
                .all(|o| o.meant.is_none())
        );
    }

    /// A table that has 0 in place of every negative reading says nothing about a small one.
    #[test]
    fn zeros_in_other_profiles_make_no_slip_of_a_small_value() {
        let shape = [3.0, 6.2, 5.9, 4.0, 1.5, 0.4, 1.6, 3.9, 5.0, 4.8];
        let mut rows = coarse(&HEIGHTS, shape, 0, 1.0);
        for (i, row) in rows.iter_mut().enumerate() {
            if i % 10 == 5 && i != 25 {
                row.value = 0.0;
            }
        }
        assert_eq!(outliers(&rows), []);
    }

    #[test]
    fn what_all_profiles_of_a_member_do_is_no_outlier() {
        let steep = [9.0, 1.2, 1.1, 1.0, 0.9, 0.8, 0.9, 1.0, 1.1, 1.2];
        let bare = [1.3, 1.2, 1.1, 1.0, 0.9, 0.8, 0.9, 1.0, 1.1, 1.2];
        assert_eq!(of_coarse(&HEIGHTS, steep, 0, 1.0), []);
        // the same row in one of them is
        assert_eq!(of_coarse(&HEIGHTS, bare, 10, 7.0).first().unwrap().row, 10);
    }

    /// What neighbours do not expect, a value of 9 where they have about 1, is right where the other profiles are as steep, and wrong where they are not.
    #[test]
    fn other_profiles_lead_to_what_they_have_themselves() {
        let steep = [9.0, 1.2, 1.1, 1.0, 0.9, 0.8, 0.9, 1.0, 1.1, 1.2];
        let bare = [1.3, 1.2, 1.1, 1.0, 0.9, 0.8, 0.9, 1.0, 1.1, 1.2];
        for (shape, leads) in [(steep, true), (bare, false)] {
            let own = coarse(&HEIGHTS, shape, usize::MAX, 1.0);
            let rows: Vec<&Observation> = own.iter().collect();
            let profiles = OtherProfiles::new(&rows, &curves(&rows));
            assert_eq!(profiles.lead_to(0, 9.0, 1.3), leads);
        }
    }
}
