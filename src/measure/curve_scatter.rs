//! How curves scatter about what their points' neighbours lead one to expect ([`super::neighbours`]).
//!
//! Wear bends within a few points where single contact begins and ends and at the pitch point, and no parabola follows. Curves of one flank at the same
//! places bend alike, in proportion to their depth; noise they do not share:
//!
//! ```text
//! r_ci: point i of curve c minus what its neighbours lead one to expect, over the standard deviation of that for noise of 1
//! b_i = Σ_c (d_c/s_c²) r_ci / Σ_c (d_c/s_c)²          d_c: the largest value, s_c: the scatter of r_c by itself
//! σ_c = median_i |r_ci − d_c b_i| / (0.674 √(1 − h_c))        h_c = (d_c/s_c)²/Σ (d/s)²
//! ```
//! Where that makes curves of a flank scatter more on average, they do not bend alike, and each is taken by itself.

use std::collections::BTreeMap;

use super::neighbours::{SIDE, around, around_within};
use super::pooled_scatter::CurveScatter;
use super::{FacePlace, Observation, Quantity, Subject};
use crate::numeric::median;

/// Points of a curve of which it can be told whether it has been filtered.
pub(super) const ENOUGH: usize = 15;
/// Least σ over a curve's largest value: smoother ones have been filtered.
pub(super) const LEAST: f64 = 1e-3;
/// Median of |x| of a standard normal number.
const MEDIAN: f64 = 0.674_490;
/// Of so many points of a curve one may be left out, where it stands so many times the scatter of the others from what they lead one to expect.
const MOST_APART: usize = 12;
const FAR_APART: f64 = 8.0;

/// Places are the same up to this length, mm (or base pitches).
const SAME_PLACE: f64 = 1e-3;

/// A curve along a flank.
pub(super) struct Along {
    pub(super) rows: Vec<usize>,
    /// (position, value, σ) by ascending position.
    pub(super) points: Vec<[f64; 3]>,
    flank: Flank,
}

/// What curves have in common that bend alike: test, member, quantity, place across the face and places along the flank.
type Flank = (usize, Subject, Quantity, Option<u64>, Vec<i64>);

impl Along {
    pub(super) fn new(rows: &[&Observation], points: Vec<[f64; 3]>, own: Vec<usize>) -> Self {
        let first = rows[own[0]];
        let places = points.iter().map(|p| (p[0] / SAME_PLACE).round() as i64);
        let face = first.face.map(FacePlace::key);
        Self {
            flank: (
                first.test,
                first.member,
                first.quantity,
                face,
                places.collect(),
            ),
            rows: own,
            points,
        }
    }
}

/// The scatter of each curve, with what curves of one flank have in common taken out.
pub(super) fn of_alike(curves: &[Along]) -> Vec<Option<CurveScatter>> {
    let apart: Vec<Option<Apart>> = curves.iter().map(|c| Apart::of(&c.points)).collect();
    let mut found: Vec<Option<CurveScatter>> = (apart.iter())
        .map(|apart| apart.as_ref()?.scatter())
        .collect();
    let mut flanks: BTreeMap<&Flank, Vec<usize>> = BTreeMap::new();
    for (place, curve) in curves.iter().enumerate() {
        if found[place].is_some() {
            flanks.entry(&curve.flank).or_default().push(place);
        }
    }
    for places in flanks.into_values().filter(|places| places.len() > 1) {
        let known: Vec<(&Apart, CurveScatter)> = (places.iter())
            .filter_map(|&place| Some((apart[place].as_ref()?, found[place]?)))
            .collect();
        let common = without_common_bends(&known);
        let more =
            (common.iter().zip(&known)).map(|(new, (_, own))| (new.scatter / own.scatter).ln());
        if more.sum::<f64>() < 0.0 {
            (places.iter().zip(common)).for_each(|(&place, new)| found[place] = Some(new));
        }
    }
    found
}

/// The scatter of a curve by itself.
pub(super) fn of_one(points: &[[f64; 3]]) -> Option<CurveScatter> {
    Apart::of(points)?.scatter()
}

/// The scatters of curves of one flank about their neighbours and what they have in common.
fn without_common_bends(curves: &[(&Apart, CurveScatter)]) -> Vec<CurveScatter> {
    let count = curves.iter().map(|(apart, _)| apart.by_point.len());
    let count = count.max().unwrap_or(0);
    let known = |i: usize| {
        let all = curves.iter();
        all.filter_map(move |(apart, own)| Some(((*apart.by_point.get(i)?)?, own)))
    };
    let weight = |own: &CurveScatter| (own.largest / own.scatter).powi(2);
    let all: f64 = curves.iter().map(|(_, own)| weight(own)).sum();
    let bend = |i: usize| {
        let sum: f64 = known(i)
            .map(|(r, own)| own.largest * r / own.scatter.powi(2))
            .sum();
        sum / known(i).map(|(_, own)| weight(own)).sum::<f64>()
    };
    let bends: Vec<f64> = (0..count).map(bend).collect();
    (curves.iter())
        .map(|(apart, own)| {
            let free = 1.0 - weight(own) / all;
            let left = (apart.by_point.iter().zip(&bends))
                .filter_map(|(r, bend)| Some((((*r)? - own.largest * bend) / free.sqrt()).abs()));
            let scatter = median(left.collect()).map_or(own.scatter, |middle| middle / MEDIAN);
            CurveScatter {
                scatter: scatter.max(LEAST * own.largest),
                variance: own.variance / free,
                ..*own
            }
        })
        .collect()
}

/// How far each point of a curve is from what its neighbours lead one to expect, in standard deviations of that for noise of 1.
struct Apart {
    /// None of a point that is left out or has too few neighbours.
    by_point: Vec<Option<f64>>,
    largest: f64,
}

impl Apart {
    /// A point that stands far apart is left out: it is in the expectation of as many as it has neighbours, half a short curve.
    fn of(points: &[[f64; 3]]) -> Option<Self> {
        let even: Vec<[f64; 3]> = points.iter().map(|[x, y, _]| [*x, *y, 1.0]).collect();
        let mut left_out = vec![false; even.len()];
        let mut by_point = apart(&even, &left_out);
        let mut found = middle(&by_point)?;
        for _ in 0..even.len() / MOST_APART {
            let furthest = furthest(&by_point)?;
            left_out[furthest] = true;
            let without = apart(&even, &left_out);
            let alone = around(&even, furthest, &left_out).map_or(0.0, |near| {
                (even[furthest][1] - near.expected).abs() / near.sigma
            });
            // by noise alone no point stands as far from what the others say of it
            match middle(&without) {
                Some(less) if alone > FAR_APART * less => (found, by_point) = (less, without),
                _ => {
                    left_out[furthest] = false;
                    break;
                }
            }
        }
        let kept = even.iter().zip(&left_out).filter(|(_, out)| !**out);
        let largest = kept.map(|(p, _)| p[1].abs()).fold(0.0, f64::max);
        (largest > 0.0 && found.is_finite()).then_some(Self { by_point, largest })
    }

    fn scatter(&self) -> Option<CurveScatter> {
        let points = self.by_point.len();
        Some(CurveScatter {
            scatter: middle(&self.by_point)?.max(LEAST * self.largest),
            largest: self.largest,
            points,
            variance: variance(points),
        })
    }
}

/// [`Apart::by_point`] with these points left out.
fn apart(even: &[[f64; 3]], left_out: &[bool]) -> Vec<Option<f64>> {
    let of = |at: usize| {
        let found = around_within(even, at, left_out, side(even.len()))?;
        (!left_out[at]).then(|| (even[at][1] - found.expected) / found.sigma)
    };
    (0..even.len()).map(of).collect()
}

/// The standard deviation that the middle one of so many says.
fn middle(apart: &[Option<f64>]) -> Option<f64> {
    let all = apart.iter().flatten().map(|apart| apart.abs()).collect();
    Some(median(all)? / MEDIAN)
}

fn furthest(apart: &[Option<f64>]) -> Option<usize> {
    let known = apart.iter().enumerate();
    let known = known.filter_map(|(at, apart)| Some((at, apart.as_ref()?.abs())));
    Some(known.max_by(|a, b| a.1.total_cmp(&b.1))?.0)
}

/// Points on each side that lead one to expect a value: a tenth of the curve's, since wear bends within a few of twenty points (with four on each
/// side the scatter of such a curve comes out up to a half too large). Of a short curve all that there are.
fn side(points: usize) -> usize {
    if points < ENOUGH {
        SIDE
    } else {
        (points / 10).clamp(2, SIDE)
    }
}

/// Variance of the logarithm of such a scatter of independent normal points (2,000 draws each of 15 to 80 points: 2.65, 2.1 and 1.7 over their number
/// with two, three and four on each side).
fn variance(points: usize) -> f64 {
    (0.75 + 3.8 / side(points) as f64) / points as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Standard normal numbers: splitmix64 (Steele, Lea and Flood 2014) and Box and Muller's transform.
    fn normal(state: &mut u64) -> f64 {
        let mut uniform = || {
            *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
            let z = (*state ^ (*state >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
        };
        let (u, v) = (1.0 - uniform(), uniform());
        (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
    }

    /// Three curves of 24 points of a worn flank, with the noise `sigma(depth)`: the mean of the scatters found of each over its noise, by itself and
    /// with the others.
    fn over_noise(sigma: &dyn Fn(f64) -> f64) -> [f64; 2] {
        // sliding is zero at the pitch point, and one pair carries all between 8 and 15
        let shape = |i: usize| {
            let x = i as f64;
            (x - 10.5).abs() / 10.5 * if (8..15).contains(&i) { 1.0 } else { 0.55 }
        };
        let depths = [5.0, 12.0, 25.0];
        let flank = || (0, Subject::Pinion, Quantity::WearDepth, None, Vec::new());
        let mut state = 1;
        let (mut alone, mut together) = (0.0, 0.0);
        let draws = 200;
        for _ in 0..draws {
            let curve = |depth: f64| {
                let mut point = |i: usize| depth * shape(i) + sigma(depth) * normal(&mut state);
                Along {
                    rows: Vec::new(),
                    points: (0..24).map(|i| [i as f64, point(i), 1.0]).collect(),
                    flank: flank(),
                }
            };
            let curves: Vec<Along> = depths.map(curve).into();
            let found = of_alike(&curves);
            for ((curve, found), depth) in curves.iter().zip(found).zip(depths) {
                let share = 1.0 / (3.0 * f64::from(draws) * sigma(depth));
                alone += share * of_one(&curve.points).unwrap().scatter;
                together += share * found.unwrap().scatter;
            }
        }
        [alone, together]
    }

    #[test]
    fn bends_that_curves_share_are_no_noise() {
        let [alone, together] = over_noise(&|_| 0.1);
        assert!(alone > 1.3, "{alone}");
        assert!((0.9..1.15).contains(&together), "{together}");
        // noise that hides them, and noise of a share
        for sigma in [&|_| 3.0, &|depth: f64| 0.2 * depth] as [&dyn Fn(f64) -> f64; 2] {
            let [alone, together] = over_noise(sigma);
            assert!((0.85..1.1).contains(&alone), "{alone}");
            assert!((0.85..1.1).contains(&together), "{together}");
        }
    }

    /// Sixteen points of a parabola with a noise of ±0.1, and one of them with a decimal point at the wrong place.
    #[test]
    fn a_slip_of_the_pen_does_not_make_a_curve_scatter() {
        let noise = |i: usize| 0.1 * (7.3 * (i * i) as f64 + 1.0).sin();
        let value = |i: usize| 0.5 + 0.05 * (i as f64 - 6.0).powi(2) + noise(i);
        let clean: Vec<[f64; 3]> = (0..16).map(|i| [i as f64, value(i), 1.0]).collect();
        let mut slipped = clean.clone();
        slipped[7][1] *= 10.0;
        let [of_clean, of_slipped] = [&clean, &slipped].map(|points| of_one(points).unwrap());
        let (largest, same) = (of_clean.largest, of_slipped.largest);
        let (of_clean, of_slipped) = (of_clean.scatter, of_slipped.scatter);
        assert!((0.03..0.2).contains(&of_clean), "{of_clean}");
        assert!(
            (of_slipped / of_clean - 1.0).abs() < 0.5,
            "{of_slipped} {of_clean}"
        );
        assert_eq!(largest, same);
    }
}
