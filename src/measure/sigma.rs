//! The σ of rows that state none, from what the measurements themselves tell of their noise.
//!
//! In this order: the scatter of a curve's points about what their neighbours lead one to expect ([`super::curve_scatter`]; of a value that has
//! no position, about those before and after it in the test's life), pooled over the curves of its quantity ([`super::pooled_scatter`]); values of the same quantity measured again at the same place and time;
//! the σ that other rows of the quantity state; of values without a position the scatter of a few in a test's life ([`super::short_series`]). If none of these tells it, the row is refused.

use std::collections::BTreeMap;

use super::Observation;
use super::curve_scatter::{Along, ENOUGH, LEAST, of_alike, of_one};
use super::neighbours::{curves, points};
use super::pooled_scatter::{CurveScatter, ScatterLaw};
use super::quantity::{Quantity, Subject};
use super::short_series::{self, Series};
use crate::numeric::median;

/// Values measured again that give a scatter.
const REPEATS: usize = 3;
/// Degrees of freedom of all short series of a quantity together from which they tell a scatter.
const FREEDOM: usize = 6;
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
    let along: Vec<Along> = (curves(&rows).into_iter())
        .map(|own| Along::new(&rows, points(&rows, &own), own))
        .collect();
    let scatters = of_alike(&along);
    let along = (along.into_iter().zip(scatters)).map(|(curve, scatter)| Curve {
        scatter,
        largest: largest(&curve.points),
        rows: curve.rows,
    });
    let in_time = (series(&rows).into_iter()).map(|own| {
        let point = |&i: &usize| [rows[i].cycles, rows[i].value, 1.0];
        let points: Vec<[f64; 3]> = own.iter().map(point).collect();
        Curve {
            scatter: of_one(&points),
            largest: largest(&points),
            rows: own,
        }
    });
    let mut quantities: BTreeMap<Quantity, Vec<Curve>> = BTreeMap::new();
    for curve in along.chain(in_time) {
        let quantity = rows[curve.rows[0]].quantity;
        quantities.entry(quantity).or_default().push(curve);
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

/// The largest absolute value of some points.
fn largest(points: &[[f64; 3]]) -> f64 {
    points.iter().map(|p| p[1].abs()).fold(0.0, f64::max)
}

/// Of rows without a position by the scatter of the few in each test, all of their quantity together, since each test's own tells next to nothing; none where
/// all together tell little.
fn of_short_series(observations: &[Observation]) -> Vec<Option<f64>> {
    let rows: Vec<&Observation> = observations.iter().collect();
    let mut quantities: BTreeMap<Quantity, BTreeMap<Subject, Vec<Vec<usize>>>> = BTreeMap::new();
    for own in series(&rows) {
        let first = rows[own[0]];
        let members = quantities.entry(first.quantity).or_default();
        members.entry(first.member).or_default().push(own);
    }
    let point = |&i: &usize| [rows[i].cycles, rows[i].value];
    let mut found = vec![None; rows.len()];
    for members in quantities.values() {
        let scatters: Vec<(&Vec<usize>, Option<CurveScatter>)> = (members.values())
            .flat_map(|all| {
                let points = all.iter().map(|own| own.iter().map(point).collect());
                let points: Vec<Series> = points.collect();
                all.iter().zip(short_series::scatters(&points, LEAST))
            })
            .collect();
        let known: Vec<CurveScatter> = scatters.iter().filter_map(|s| s.1).collect();
        let freedom: usize = known.iter().map(|series| series.points - 2).sum();
        let Some(law) = ScatterLaw::through(&known).filter(|_| freedom >= FREEDOM) else {
            continue;
        };
        // noise of a scatter that so few values tell has the tails of Student's t: its standard deviation
        let freedom = freedom as f64;
        let wider = (freedom / (freedom - 2.0)).sqrt();
        for (own, _) in scatters {
            let largest = own.iter().map(|&i| rows[i].value.abs()).fold(0.0, f64::max);
            let sigma = wider * law.at(largest);
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
