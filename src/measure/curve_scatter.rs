//! How curves scatter about what their points' neighbours lead one to expect ([`super::neighbours`]).
//!
//! Wear bends within a few points where single contact begins and ends and at the pitch point, and no parabola follows. Curves of one flank at the same
//! places bend alike, in proportion to their depth; noise they do not share:
//!
//! ```text
//! r_ci: point i of curve c minus what its neighbours lead one to expect, over the standard deviation of that for noise of 1
//! b_i = Σ_c (d_c/s_c²) r_ci / Σ_c (d_c/s_c)²          d_c: the largest value, s_c: the noise expected of it
//! σ_c = median_i |r_ci − d_c b_i| / (0.674 √(1 − h_c))        h_c = (d_c/s_c)²/Σ (d/s)²
//! ```
//! s is the law of all such curves of the quantity ([`super::pooled_scatter`]), from one round to the next; in the first it is the same for all. Where that makes
//! curves of a flank scatter more on average, they do not bend alike, and each is taken by itself. A slip of the pen is left out once the bends are.

use std::collections::BTreeMap;

use super::neighbours::{SIDE, around, around_within};
use super::pooled_scatter::{CurveScatter, ScatterLaw};
use super::{FacePlace, Observation, Quantity, Subject};
use crate::numeric::{MEDIAN_OF_NORMAL, median};

/// Points of a curve of which it can be told whether it has been filtered.
pub(super) const ENOUGH: usize = 15;
/// Least σ over a curve's largest value: smoother ones have been filtered.
pub(super) const LEAST: f64 = 1e-3;
/// Of so many points of a curve one may be left out, where it stands so many times the scatter of the others from what they lead one to expect.
const MOST_APART: usize = 12;
const FAR_APART: f64 = 8.0;

/// Rounds after which the law of the noise stands.
const ROUNDS: usize = 4;
/// Places are the same up to this length, mm (or base pitches).
const SAME_PLACE: f64 = 1e-3;

/// A curve along a flank.
pub(super) struct Along {
    pub(super) rows: Vec<usize>,
    /// (position, value, σ) by ascending position.
    pub(super) points: Vec<[f64; 3]>,
    flank: Flank,
}

/// What curves have in common that bend alike.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
struct Flank {
    test: usize,
    member: Subject,
    quantity: Quantity,
    face: Option<u64>,
    /// Along the flank, in units of [`SAME_PLACE`].
    places: Vec<i64>,
}

impl Along {
    pub(super) fn new(rows: &[&Observation], points: Vec<[f64; 3]>, own: Vec<usize>) -> Self {
        let first = rows[own[0]];
        let places = points.iter().map(|p| (p[0] / SAME_PLACE).round() as i64);
        let face = first.face.map(FacePlace::key);
        Self {
            flank: Flank {
                test: first.test,
                member: first.member,
                quantity: first.quantity,
                face,
                places: places.collect(),
            },
            rows: own,
            points,
        }
    }
}

/// The scatter of each curve, with what curves of one flank have in common taken out.
pub(super) fn of_alike(curves: &[Along]) -> Vec<Option<CurveScatter>> {
    let mut found: Vec<Option<CurveScatter>> =
        curves.iter().map(|curve| of_one(&curve.points)).collect();
    let mut quantities: BTreeMap<Quantity, BTreeMap<&Flank, Vec<Alike>>> = BTreeMap::new();
    for (place, curve) in curves.iter().enumerate() {
        if let Some(own) = found[place] {
            let flanks = quantities.entry(curve.flank.quantity).or_default();
            let alike = Alike::new(place, own, even(&curve.points));
            flanks.entry(&curve.flank).or_default().push(alike);
        }
    }
    for flanks in quantities.into_values() {
        let several = flanks.into_values().filter(|flank| flank.len() > 1);
        for (place, scatter) in without_common_bends(several.collect()) {
            found[place] = Some(scatter);
        }
    }
    found
}

/// The scatter of a curve by itself.
pub(super) fn of_one(points: &[[f64; 3]]) -> Option<CurveScatter> {
    Apart::of(points)?.scatter()
}

/// A curve of a flank that others share.
struct Alike {
    /// Its number.
    place: usize,
    /// Its scatter by itself.
    own: CurveScatter,
    even: Vec<[f64; 3]>,
    /// How far its points are from what their neighbours lead one to expect.
    by_point: Vec<Option<f64>>,
}

impl Alike {
    fn new(place: usize, own: CurveScatter, even: Vec<[f64; 3]>) -> Self {
        Self {
            by_point: apart(&even, &vec![false; even.len()]),
            place,
            own,
            even,
        }
    }

    /// Leaves out a point that stands far from the others once the common bends are taken out, with `left` of each point.
    fn leave_out_a_slip(&mut self, left: &[Option<f64>]) {
        let Some((middle, furthest)) = middle(left).zip(furthest(left)) else {
            return;
        };
        if left[furthest].is_some_and(|left| left.abs() > FAR_APART * middle) {
            let mut left_out = vec![false; self.even.len()];
            left_out[furthest] = true;
            self.by_point = apart(&self.even, &left_out);
        }
    }
}

/// The scatters of the curves of some flanks about their neighbours and what each flank's have in common; without those of flanks whose curves do not bend
/// alike.
fn without_common_bends(mut flanks: Vec<Vec<Alike>>) -> Vec<(usize, CurveScatter)> {
    let first = settled(&flanks);
    for (flank, found) in flanks.iter_mut().zip(first) {
        for (curve, (_, left)) in flank.iter_mut().zip(found) {
            curve.leave_out_a_slip(&left);
        }
    }
    let found = settled(&flanks);
    let bend_alike = |(flank, found): &(&Vec<Alike>, Vec<Left>)| {
        let more = flank.iter().zip(found);
        let more = more.map(|(curve, (new, _))| (new.scatter / curve.own.scatter).ln());
        more.sum::<f64>() < 0.0
    };
    (flanks.iter().zip(found).filter(bend_alike))
        .flat_map(|(flank, found)| {
            let scatters = found.into_iter().map(|(scatter, _)| scatter);
            flank.iter().map(|curve| curve.place).zip(scatters)
        })
        .collect()
}

/// A scatter, and what is left of each point.
type Left = (CurveScatter, Vec<Option<f64>>);

/// The curves of all flanks by the law of the noise that they themselves lead to.
fn settled(flanks: &[Vec<Alike>]) -> Vec<Vec<Left>> {
    let by = |law: &Option<ScatterLaw>| -> Vec<Vec<Left>> {
        let sigma = |largest: f64| law.as_ref().map_or(1.0, |law| law.at(largest));
        flanks.iter().map(|flank| of_flank(flank, &sigma)).collect()
    };
    let mut found = by(&None);
    for _ in 1..ROUNDS {
        let all: Vec<CurveScatter> = found.iter().flatten().map(|left| left.0).collect();
        found = by(&ScatterLaw::through(&all));
    }
    found
}

/// The curves of one flank, whose noise is expected to be `sigma` of their largest values but for a factor.
fn of_flank(curves: &[Alike], sigma: &dyn Fn(f64) -> f64) -> Vec<Left> {
    let weights: Vec<f64> = (curves.iter())
        .map(|curve| (curve.own.largest / sigma(curve.own.largest)).powi(2))
        .collect();
    let all: f64 = weights.iter().sum();
    let bend = |i: usize| {
        let (mut sum, mut of) = (0.0, 0.0);
        for (curve, weight) in curves.iter().zip(&weights) {
            if let Some(r) = curve.by_point[i] {
                sum += weight * r / curve.own.largest;
                of += weight;
            }
        }
        sum / of
    };
    let count = curves.iter().map(|curve| curve.by_point.len());
    let bends: Vec<f64> = (0..count.min().unwrap_or(0)).map(bend).collect();
    (curves.iter().zip(&weights))
        .map(|(curve, weight)| {
            let own = curve.own;
            let free = 1.0 - weight / all;
            let left: Vec<Option<f64>> = (curve.by_point.iter().zip(&bends))
                .map(|(r, bend)| Some(((*r)? - own.largest * bend) / free.sqrt()))
                .collect();
            let scatter = CurveScatter {
                scatter: middle(&left)
                    .unwrap_or(own.scatter)
                    .max(LEAST * own.largest),
                variance: own.variance / free,
                ..own
            };
            (scatter, left)
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
        let even = even(points);
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

/// Points of which all are known equally well.
fn even(points: &[[f64; 3]]) -> Vec<[f64; 3]> {
    points.iter().map(|[x, y, _]| [*x, *y, 1.0]).collect()
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
    Some(median(all)? / MEDIAN_OF_NORMAL)
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
        let flank = || Flank {
            test: 0,
            member: Subject::Pinion,
            quantity: Quantity::WearDepth,
            face: None,
            places: Vec::new(),
        };
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
        // noise of a share of the depth, and noise that hides the bends
        for sigma in [&|depth: f64| 0.02 * depth, &|_| 3.0] as [&dyn Fn(f64) -> f64; 2] {
            let [alone, together] = over_noise(sigma);
            assert!((0.85..1.15).contains(&together), "{together} ({alone})");
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
