//! The σ of rows that state none, from what the measurements themselves tell of their noise.
//!
//! In this order: the scatter of a curve's points about what their neighbours lead one to expect ([`super::neighbours`]; of a value that has
//! no position, about those before and after it in the test's life), pooled over the curves of its quantity ([`super::pooled_scatter`]); values of the same quantity measured again at the same place and time;
//! the σ that other rows of the quantity state; of values without a position the scatter of a few in a test's life ([`super::short_series`]). If none of these tells it, the row is refused.

use std::collections::BTreeMap;

use super::Observation;
use super::neighbours::{SIDE, around, around_within, curves, points};
use super::pooled_scatter::{CurveScatter, ScatterLaw};
use super::quantity::Quantity;
use super::short_series;
use crate::numeric::median;

/// Median of |x| of a standard normal number.
const MEDIAN: f64 = 0.674_490;
/// Points of a curve of which it can be told whether it has been filtered.
const ENOUGH: usize = 15;
/// Values measured again that give a scatter.
const REPEATS: usize = 3;
/// Degrees of freedom of all short series of a quantity together from which they tell a scatter.
const FREEDOM: usize = 6;
/// Least σ over a curve's largest value: smoother ones have been filtered.
const LEAST: f64 = 1e-3;
/// Of so many points of a curve one may be left out, where it stands so many times the scatter of the others from what they lead one to expect.
const MOST_APART: usize = 12;
const FAR_APART: f64 = 8.0;
/// Scatter of a curve, as a part of that of the middle one of its quantity, both as it is and over the largest value, below which it has been filtered.
const FILTERED: f64 = 0.2;

/// How many rows got their σ from what.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Estimated {
    neighbours: usize,
    others: usize,
    repeats: usize,
    stated: usize,
    series: usize,
}

impl Estimated {
    /// How many rows.
    pub(super) fn rows(self) -> usize {
        self.neighbours + self.others + self.repeats + self.stated + self.series
    }

    /// In words; None if every row stated its own.
    pub(super) fn in_words(self) -> Option<String> {
        let of = |rows: usize, from: &str| match rows {
            0 => None,
            1 => Some(format!("1 from {from}")),
            n => Some(format!("{n} from {from}")),
        };
        let parts: Vec<String> = [
            of(self.neighbours, "the scatter about their neighbours"),
            of(
                self.others,
                "the scatter of other curves (these are far smoother than they: filtered, or computed?)",
            ),
            of(self.repeats, "repeated measurements"),
            of(self.stated, "the sigma of other rows"),
            of(
                self.series,
                "the scatter of a few times of a test about a smooth growth",
            ),
        ]
        .into_iter()
        .flatten()
        .collect();
        let rows = self.rows();
        let rows = if rows == 1 {
            "1 row".to_owned()
        } else {
            format!("{rows} rows")
        };
        (!parts.is_empty()).then(|| format!("sigma of {rows} estimated: {}", parts.join(", ")))
    }
}

/// Gives every row that states no σ (it is not a number) one.
///
/// # Errors
/// The first row of which nothing tells it.
pub(super) fn estimate(observations: &mut [Observation]) -> Result<Estimated, usize> {
    let mut estimated = Estimated::default();
    let unknown: Vec<usize> = (0..observations.len())
        .filter(|&row| observations[row].sigma.is_nan())
        .collect();
    if unknown.is_empty() {
        return Ok(estimated);
    }
    let neighbours = of_neighbours(observations);
    let repeats = of_repeats(observations);
    let stated = of_stated(observations);
    let short = of_short_series(observations);
    for row in unknown {
        let o = &observations[row];
        let (count, sigma) = if let Some((sigma, own)) = neighbours[row] {
            match own {
                true => (&mut estimated.neighbours, sigma),
                false => (&mut estimated.others, sigma),
            }
        } else if let Some(sigma) = repeats.get(&o.quantity) {
            (&mut estimated.repeats, *sigma)
        } else if let Some(sigma) = stated.get(&o.quantity) {
            (&mut estimated.stated, *sigma)
        } else if let Some(sigma) = short[row] {
            (&mut estimated.series, sigma)
        } else {
            return Err(row);
        };
        *count += 1;
        observations[row].sigma = sigma;
    }
    Ok(estimated)
}

/// Of each row by the scatter of its curve and of the others of its quantity; false where it is of the others although its own has one.
fn of_neighbours(observations: &[Observation]) -> Vec<Option<(f64, bool)>> {
    let rows: Vec<&Observation> = observations.iter().collect();
    let along = (curves(&rows).into_iter()).map(|curve| (points(&rows, &curve), curve));
    let in_time = (series(&rows).into_iter()).map(|own| {
        let point = |&i: &usize| [rows[i].cycles, rows[i].value, 1.0];
        (own.iter().map(point).collect(), own)
    });
    let mut quantities: BTreeMap<Quantity, Vec<Curve>> = BTreeMap::new();
    let all: Vec<(Vec<[f64; 3]>, Vec<usize>)> = along.chain(in_time).collect();
    for (points, own) in all {
        let quantity = quantities.entry(rows[own[0]].quantity).or_default();
        quantity.push(Curve {
            scatter: scatter(&points),
            largest: (points.iter()).fold(0.0, |most, point| most.max(point[1].abs())),
            rows: own,
        });
    }
    let mut found = vec![None; rows.len()];
    for curves in quantities.values() {
        let all: Vec<CurveScatter> = curves.iter().filter_map(|curve| curve.scatter).collect();
        let of = |f: &dyn Fn(&CurveScatter) -> f64| median(all.iter().map(f).collect());
        let (Some(middle), Some(share)) = (of(&|c| c.scatter), of(&|c| c.scatter / c.largest))
        else {
            continue;
        };
        let filtered = |c: &CurveScatter| {
            c.points >= ENOUGH && c.scatter < FILTERED * middle.min(share * c.largest)
        };
        let raw: Vec<CurveScatter> = all.iter().filter(|c| !filtered(c)).copied().collect();
        let Some(law) = ScatterLaw::through(&raw) else {
            continue;
        };
        for curve in curves {
            let sigma = match curve.scatter {
                Some(scatter) if !filtered(&scatter) => (law.of(&scatter), true),
                scatter => (law.at(curve.largest), scatter.is_none()),
            };
            curve.rows.iter().for_each(|&row| found[row] = Some(sigma));
        }
    }
    found
}

/// Of rows without a position by the scatter of their test's few, and of the others of their quantity; none where all together tell little.
fn of_short_series(observations: &[Observation]) -> Vec<Option<f64>> {
    let rows: Vec<&Observation> = observations.iter().collect();
    let mut quantities: BTreeMap<Quantity, Vec<Vec<usize>>> = BTreeMap::new();
    for own in series(&rows) {
        let all = quantities.entry(rows[own[0]].quantity).or_default();
        all.push(own);
    }
    let mut found = vec![None; rows.len()];
    for all in quantities.values() {
        let of = |own: &Vec<usize>| {
            let points: Vec<[f64; 2]> = (own.iter())
                .map(|&i| [rows[i].cycles, rows[i].value])
                .collect();
            short_series::scatter(&points, LEAST)
        };
        let scatters: Vec<Option<CurveScatter>> = all.iter().map(of).collect();
        let known: Vec<CurveScatter> = scatters.iter().flatten().copied().collect();
        let freedom: usize = known.iter().map(|series| series.points - 2).sum();
        let Some(law) = ScatterLaw::through(&known).filter(|_| freedom >= FREEDOM) else {
            continue;
        };
        for (own, scatter) in all.iter().zip(&scatters) {
            let largest = own.iter().map(|&i| rows[i].value.abs()).fold(0.0, f64::max);
            let sigma = match scatter {
                Some(scatter) => law.of(scatter),
                None => law.at(largest),
            };
            own.iter().for_each(|&row| found[row] = Some(sigma));
        }
    }
    found
}

/// Rows of one curve.
struct Curve {
    rows: Vec<usize>,
    /// None where it has too few points to tell.
    scatter: Option<CurveScatter>,
    /// Its largest absolute value.
    largest: f64,
}

/// Rows without a position by test, member and quantity, in the order of their cycles.
fn series(rows: &[&Observation]) -> Vec<Vec<usize>> {
    let mut series: BTreeMap<_, Vec<usize>> = BTreeMap::new();
    for (i, o) in rows.iter().enumerate() {
        if o.position.is_none() {
            let key = (o.test, o.member, o.quantity, o.trace);
            series.entry(key).or_default().push(i);
        }
    }
    let mut series: Vec<Vec<usize>> = series.into_values().collect();
    for own in &mut series {
        own.sort_by(|&a, &b| rows[a].cycles.total_cmp(&rows[b].cycles));
    }
    series
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

/// Scatter of a curve's points about what their neighbours lead one to expect, no less than a thousandth of its largest value.
/// A point that stands far apart is left out: it is in the expectation of as many as it has neighbours, half a short curve.
fn scatter(points: &[[f64; 3]]) -> Option<CurveScatter> {
    let even: Vec<[f64; 3]> = points.iter().map(|[x, y, _]| [*x, *y, 1.0]).collect();
    let mut left_out = vec![false; even.len()];
    let (mut found, mut furthest) = middle_of_apart(&even, &left_out)?;
    for _ in 0..even.len() / MOST_APART {
        left_out[furthest] = true;
        let without = middle_of_apart(&even, &left_out);
        let apart = around(&even, furthest, &left_out).map_or(0.0, |near| {
            (even[furthest][1] - near.expected).abs() / near.sigma
        });
        // by noise alone no point stands as far from what the others say of it
        match without {
            Some((less, next)) if apart > FAR_APART * less => (found, furthest) = (less, next),
            _ => {
                left_out[furthest] = false;
                break;
            }
        }
    }
    let kept = even.iter().zip(&left_out).filter(|(_, out)| !**out);
    let largest = kept.map(|(p, _)| p[1].abs()).fold(0.0, f64::max);
    (largest > 0.0).then(|| CurveScatter {
        scatter: found.max(LEAST * largest),
        largest,
        points: even.len(),
        variance: variance(even.len()),
    })
}

/// Scatter of the points that are not left out about what their neighbours lead one to expect, and the one that stands furthest apart.
fn middle_of_apart(even: &[[f64; 3]], left_out: &[bool]) -> Option<(f64, usize)> {
    let apart = (0..even.len())
        .filter(|&at| !left_out[at])
        .filter_map(|at| {
            let found = around_within(even, at, left_out, side(even.len()))?;
            Some((at, (even[at][1] - found.expected).abs() / found.sigma))
        });
    let apart: Vec<(usize, f64)> = apart.collect();
    let furthest = apart.iter().max_by(|a, b| a.1.total_cmp(&b.1))?.0;
    let all = apart.into_iter().map(|(_, apart)| apart).collect();
    Some((median(all)? / MEDIAN, furthest))
}

/// Of each quantity by values of the same place and time.
fn of_repeats(observations: &[Observation]) -> BTreeMap<Quantity, f64> {
    let mut places: BTreeMap<_, Vec<f64>> = BTreeMap::new();
    for o in observations {
        let at = (o.cycles.to_bits(), o.position.map(f64::to_bits));
        let place = (o.quantity, o.test, o.member, at);
        places.entry(place).or_default().push(o.value);
    }
    let mut sums: BTreeMap<Quantity, (f64, usize)> = BTreeMap::new();
    for ((quantity, ..), values) in places {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let sum = sums.entry(quantity).or_default();
        sum.0 += values.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
        sum.1 += values.len() - 1;
    }
    let told = |(sum, freedom): &(f64, usize)| *freedom >= REPEATS && *sum > 0.0;
    (sums.into_iter())
        .filter(|(_, sum)| told(sum))
        .map(|(quantity, (sum, freedom))| (quantity, (sum / freedom as f64).sqrt()))
        .collect()
}

/// The middle of what the rows of each quantity state.
fn of_stated(observations: &[Observation]) -> BTreeMap<Quantity, f64> {
    let mut stated: BTreeMap<Quantity, Vec<f64>> = BTreeMap::new();
    for o in observations.iter().filter(|o| !o.sigma.is_nan()) {
        stated.entry(o.quantity).or_default().push(o.sigma);
    }
    (stated.into_iter())
        .filter_map(|(quantity, all)| Some((quantity, median(all)?)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sixteen points of a parabola with a noise of ±0.1, and one of them with a decimal point at the wrong place.
    #[test]
    fn a_slip_of_the_pen_does_not_make_a_curve_scatter() {
        let noise = |i: usize| 0.1 * (7.3 * (i * i) as f64 + 1.0).sin();
        let value = |i: usize| 0.5 + 0.05 * (i as f64 - 6.0).powi(2) + noise(i);
        let clean: Vec<[f64; 3]> = (0..16).map(|i| [i as f64, value(i), 1.0]).collect();
        let mut slipped = clean.clone();
        slipped[7][1] *= 10.0;
        let [of_clean, of_slipped] = [&clean, &slipped].map(|points| scatter(points).unwrap());
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
