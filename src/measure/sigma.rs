//! The σ of rows that state none, from what the measurements themselves tell of their noise.
//!
//! In this order: the scatter of a curve's points about what their neighbours lead one to expect ([`super::neighbours`]; of a value that has
//! no position, about those before and after it in the test's life); values of the same quantity measured again at the same place and time;
//! the σ that other rows of the quantity state. If none of these tells it, the row is refused.

use std::collections::BTreeMap;

use super::Observation;
use super::neighbours::{around, curves, points};
use super::quantity::Quantity;

/// Median of |x| of a standard normal number.
const MEDIAN: f64 = 0.674_490;
/// Points of a curve that give a scatter of their own; of shorter ones the middle of all curves of the quantity is taken.
const ENOUGH: usize = 15;
/// Values measured again that give a scatter.
const REPEATS: usize = 3;
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
}

impl Estimated {
    /// How many rows.
    pub(super) fn rows(self) -> usize {
        self.neighbours + self.others + self.repeats + self.stated
    }

    /// In words; None if every row stated its own.
    pub(super) fn said(self) -> Option<String> {
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
        } else {
            return Err(row);
        };
        *count += 1;
        observations[row].sigma = sigma;
    }
    Ok(estimated)
}

/// Of each row by the scatter of its curve, or of the quantity's middle curve; false where that is of other curves though its own has one.
fn of_neighbours(observations: &[Observation]) -> Vec<Option<(f64, bool)>> {
    let rows: Vec<&Observation> = observations.iter().collect();
    let along = (curves(&rows).into_iter()).map(|curve| (points(&rows, &curve), curve));
    let in_time = (series(&rows).into_iter()).map(|own| {
        let point = |&i: &usize| [rows[i].cycles, rows[i].value, 1.0];
        (own.iter().map(point).collect(), own)
    });
    let mut found = vec![None; rows.len()];
    let mut quantities: BTreeMap<Quantity, Vec<Curve>> = BTreeMap::new();
    let all: Vec<(Vec<[f64; 3]>, Vec<usize>)> = along.chain(in_time).collect();
    for (points, own) in all {
        if let Some([scatter, largest]) = scatter(&points) {
            let quantity = quantities.entry(rows[own[0]].quantity).or_default();
            quantity.push(Curve {
                rows: own,
                scatter,
                largest,
            });
        }
    }
    for (quantity, curves) in &quantities {
        let of =
            |f: &dyn Fn(&Curve) -> f64| median(&mut curves.iter().map(f).collect::<Vec<f64>>());
        let (middle, share) = (of(&|c| c.scatter), of(&|c| c.scatter / c.largest));
        for curve in curves.iter().filter(|curve| curve.rows.len() >= ENOUGH) {
            let others = middle.min(share * curve.largest);
            let own = curve.scatter >= FILTERED * others;
            let sigma = if own { curve.scatter } else { others };
            (curve.rows.iter()).for_each(|&row| found[row] = Some((sigma, own)));
        }
        for (row, found) in found.iter_mut().enumerate() {
            if rows[row].quantity == *quantity {
                *found = found.or(Some((middle, true)));
            }
        }
    }
    found
}

/// Rows of one curve, and how they scatter.
struct Curve {
    rows: Vec<usize>,
    scatter: f64,
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

/// Scatter of a curve's points about what their neighbours lead one to expect, no less than a thousandth of its largest value, and that value.
/// A point that stands far apart is left out: it is in the expectation of as many as it has neighbours, half a short curve.
fn scatter(points: &[[f64; 3]]) -> Option<[f64; 2]> {
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
    (largest > 0.0).then(|| [found.max(LEAST * largest), largest])
}

/// Scatter of the points that are not left out about what their neighbours lead one to expect, and the one that stands furthest apart.
fn middle_of_apart(even: &[[f64; 3]], left_out: &[bool]) -> Option<(f64, usize)> {
    let apart = (0..even.len())
        .filter(|&at| !left_out[at])
        .filter_map(|at| {
            let found = around(even, at, left_out)?;
            Some((at, (even[at][1] - found.expected).abs() / found.sigma))
        });
    let apart: Vec<(usize, f64)> = apart.collect();
    let furthest = apart.iter().max_by(|a, b| a.1.total_cmp(&b.1))?.0;
    let mut all: Vec<f64> = apart.into_iter().map(|(_, apart)| apart).collect();
    Some((median(&mut all) / MEDIAN, furthest))
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
        .map(|(quantity, mut all)| (quantity, median(&mut all)))
        .collect()
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
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
        let [of_clean, largest] = scatter(&clean).unwrap();
        let [of_slipped, same] = scatter(&slipped).unwrap();
        assert!((0.03..0.2).contains(&of_clean), "{of_clean}");
        assert!(
            (of_slipped / of_clean - 1.0).abs() < 0.5,
            "{of_slipped} {of_clean}"
        );
        assert_eq!(largest, same);
    }
}
