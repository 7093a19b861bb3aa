//! A value that stands apart from the growth of its series.
//!
//! ```text
//! y ≈ a u(x) + b v(x) of each series, by least squares;  h_i: leverage
//! t_i = r_i √(1 − h_i),  r_i: y_i less what the others lead to                (of one standard deviation: that of the values)
//! s = 1.48 median |t| of all series;  |t_i| > 8 s, the largest of its series, and none of the others apart without it
//! ```

use crate::numeric::{MEDIAN_OF_NORMAL, median};

/// Fewest values of a series, and of all together.
const FEWEST: usize = 4;
const SEVERAL: usize = 12;
/// Scatters from which a value stands apart, and up to which the others do not without it.
pub(super) const APART: f64 = 8.0;
pub(super) const ALIKE: f64 = 4.5;

/// Values by cycles, or functions of both.
pub(super) type Series = Vec<[f64; 2]>;

/// A value that stands apart.
#[derive(Debug, PartialEq)]
pub(super) struct Odd {
    /// Which series.
    pub(super) series: usize,
    /// Its place in it.
    pub(super) at: usize,
    /// What the others lead to.
    pub(super) expected: f64,
    /// By how many scatters it stands apart.
    pub(super) scatters: f64,
}

/// How series grow.
pub(super) struct Law {
    /// The two functions whose sum a series is.
    pub(super) basis: fn(f64) -> [f64; 2],
    /// Whether a value is off by enough to be asked about from what the others lead to.
    pub(super) is_off: fn(f64, f64) -> bool,
}

/// The value that stands farthest apart from the growth of its series, if one does.
pub(super) fn farthest(all: &[Series], law: &Law) -> Option<Odd> {
    let long = |own: &Series| (own.len() >= FEWEST).then(|| standing(own, law))?;
    let standing_of: Vec<Option<Vec<f64>>> = all.iter().map(long).collect();
    let magnitudes: Vec<f64> = standing_of
        .iter()
        .flatten()
        .flatten()
        .map(|t| t.abs())
        .collect();
    if magnitudes.len() < SEVERAL {
        return None;
    }
    let scatter = median(magnitudes)? / MEDIAN_OF_NORMAL;
    let each = standing_of.iter().enumerate().flat_map(|(series, own)| {
        let own = own.iter().flatten().enumerate();
        own.map(move |(at, t)| (series, at, *t))
    });
    let (series, at, t) = each.max_by(|a, b| a.2.abs().total_cmp(&b.2.abs()))?;
    let mut others = all[series].clone();
    let [cycles, value] = others.remove(at);
    let expected = growth(&others, law)?.at(cycles);
    let are_alike = standing(&others, law)?
        .iter()
        .all(|other| other.abs() < ALIKE * scatter);
    let is_apart = t.abs() > APART * scatter && (law.is_off)(value, expected);
    (is_apart && are_alike).then(|| Odd {
        series,
        at,
        expected,
        scatters: t.abs() / scatter,
    })
}

/// t of each value of a series.
fn standing(own: &Series, law: &Law) -> Option<Vec<f64>> {
    let growth = growth(own, law)?;
    let of = |&[cycles, value]: &[f64; 2]| {
        let free = (1.0 - growth.leverage(cycles)).max(f64::EPSILON);
        (value - growth.at(cycles)) / free.sqrt()
    };
    Some(own.iter().map(of).collect())
}

/// a u + b v of a law's two functions by least squares.
pub(super) struct Growth {
    basis: fn(f64) -> [f64; 2],
    a: f64,
    b: f64,
    /// Inverse of the normal matrix: its diagonal, and what stands beside it.
    inverse: [f64; 3],
}

impl Growth {
    /// Its value.
    pub(super) fn at(&self, cycles: f64) -> f64 {
        let [u, v] = (self.basis)(cycles);
        self.a * u + self.b * v
    }

    /// h of a value at these cycles.
    pub(super) fn leverage(&self, cycles: f64) -> f64 {
        let [u, v] = (self.basis)(cycles);
        let [uu, vv, uv] = self.inverse;
        u * u * uu + 2.0 * uv * u * v + v * v * vv
    }
}

/// The growth of a series; none of fewer than three different cycles.
pub(super) fn growth(own: &Series, law: &Law) -> Option<Growth> {
    let sum = |f: &dyn Fn(f64, f64, f64) -> f64| -> f64 {
        let values = own.iter().map(|&[cycles, value]| {
            let [u, v] = (law.basis)(cycles);
            f(u, v, value)
        });
        values.sum()
    };
    let (uu, uv, vv) = (
        sum(&|u, _, _| u * u),
        sum(&|u, v, _| u * v),
        sum(&|_, v, _| v * v),
    );
    let (uy, vy) = (sum(&|u, _, y| u * y), sum(&|_, v, y| v * y));
    let determinant = uu * vv - uv * uv;
    let is_known = own.len() >= 3 && determinant > 1e-9 * uu * vv;
    is_known.then(|| Growth {
        basis: law.basis,
        a: (uy * vv - vy * uv) / determinant,
        b: (vy * uu - uy * uv) / determinant,
        inverse: [vv / determinant, uu / determinant, -uv / determinant],
    })
}
