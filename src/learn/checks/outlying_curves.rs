//! Measured curves that may be at fault themselves, before any physics is blamed.

use std::collections::BTreeMap;

use nalgebra::DVector;

use crate::learn::candidates::fitted_candidate::BaseFit;
use crate::learn::candidates::likelihood::Likelihood;

/// Misfit beyond the noise, in its standard deviations, from which curves are looked at.
const REAL: f64 = 5.0;
/// Share of the misfit that one curve alone must carry, and that constants must explain, to be suspected.
const ONE: f64 = 0.5;
const CONSTANTS: f64 = 0.85;
/// Among fewer curves one says nothing.
const CURVES: usize = 6;
/// χ² that an offset and a tilt of its own must explain of one curve, and how often what they explain of any other.
const OWN: f64 = 30.0;
const OFTEN: f64 = 3.0;
/// A tilt of which less than this share is left beside the shift is rounding.
const ROUNDING: f64 = 1e-12;

/// Rows of one test, member, quantity and number of cycles: their number, Σ z², Σ z, and whether they have a datum.
#[derive(Default)]
struct Curve {
    name: String,
    count: f64,
    square: f64,
    sum: f64,
    has_datum: bool,
}

/// What looks wrong about the measurements where the base model leaves more than noise.
pub(in crate::learn) fn suspects(likelihood: &Likelihood<'_>, model: &[f64]) -> Vec<String> {
    let mut curves: BTreeMap<_, Curve> = BTreeMap::new();
    for (row, z) in likelihood.standardised(model).into_iter().enumerate() {
        let o = likelihood.observation(row);
        let key = (o.test, o.member, o.quantity, o.cycles.to_bits());
        let curve = curves.entry(key).or_default();
        if curve.count == 0.0 {
            curve.name = name(likelihood, row);
        }
        curve.count += 1.0;
        curve.square += z * z;
        curve.sum += z;
        curve.has_datum |= o.trace.is_some();
    }
    let curves: Vec<Curve> = curves.into_values().collect();
    let (count, square) = (curves.iter()).fold((0.0, 0.0), |(n, s), c| (n + c.count, s + c.square));
    let excess = square - count;
    if excess < REAL * (2.0 * count).sqrt() {
        return Vec::new();
    }
    let mut found = Vec::new();
    let own = |c: &Curve| (c.square - c.count) / excess;
    if let Some(worst) = curves.iter().max_by(|a, b| own(a).total_cmp(&own(b)))
        && curves.len() >= CURVES
        && own(worst) > ONE
    {
        found.push(format!(
            "one curve carries {:.0} % of what the base model leaves ({}): look at that measurement before any physics",
            100.0 * own(worst).min(1.0),
            worst.name
        ));
    }
    let loose = curves.iter().filter(|c| !c.has_datum && c.count > 2.0);
    let by_constants: f64 = loose.map(|c| c.sum * c.sum / c.count - 1.0).sum();
    if by_constants > CONSTANTS * excess {
        found.push(
            "a constant for each curve explains nearly all that the base model leaves: if the instrument's zero changes between traces, name these in the column trace, and a datum is fitted to each".to_owned(),
        );
    }
    found
}

/// The curve that departs by itself from `model`: shifted or tilted, as no law of wear would one alone.
pub(in crate::learn) fn alone(
    likelihood: &Likelihood<'_>,
    base: &BaseFit,
    model: &[f64],
) -> Option<String> {
    let mut curves: BTreeMap<_, Vec<(usize, f64)>> = BTreeMap::new();
    for row in 0..likelihood.len() {
        let o = likelihood.observation(row);
        if let Some(position) = o.position {
            let key = (o.test, o.member, o.quantity, o.cycles.to_bits());
            curves.entry(key).or_default().push((row, position));
        }
    }
    let residual = base.visible(likelihood, &likelihood.residual(model));
    let mut gains: Vec<(f64, usize)> = (curves.values())
        .filter(|rows| rows.len() > 2)
        .map(|rows| (of_line(likelihood, base, rows, &residual), rows[0].0))
        .collect();
    gains.sort_by(|a, b| b.0.total_cmp(&a.0));
    let [(worst, row), (next, _), ..] = gains[..] else {
        return None;
    };
    (gains.len() >= CURVES && worst > OWN && worst > OFTEN * next).then(|| {
        format!(
            "one curve departs by itself, shifted or tilted ({}: χ² {worst:.0} of its own, {next:.0} the next): look at that measurement before any physics, and diagnose again without its rows",
            name(likelihood, row)
        )
    })
}

/// Fall of χ² by a straight line over the position on some rows alone.
fn of_line(
    likelihood: &Likelihood<'_>,
    base: &BaseFit,
    rows: &[(usize, f64)],
    residual: &DVector<f64>,
) -> f64 {
    let mean = rows.iter().map(|(_, x)| x).sum::<f64>() / rows.len() as f64;
    let seen = |f: &dyn Fn(f64) -> f64| {
        let mut change = vec![0.0; likelihood.len()];
        for &(row, x) in rows {
            change[row] = f(x - mean);
        }
        base.visible(likelihood, &change)
    };
    let fall = |v: &DVector<f64>| v.dot(residual).powi(2) / v.norm_squared();
    let (shift, tilt) = (seen(&|_| 1.0), seen(&|x| x));
    if shift.norm_squared() == 0.0 {
        return 0.0;
    }
    let own = &tilt - &shift * (shift.dot(&tilt) / shift.norm_squared());
    let seen_apart = own.norm_squared() > ROUNDING * tilt.norm_squared();
    fall(&shift) + if seen_apart { fall(&own) } else { 0.0 }
}

/// A curve by one of its rows.
fn name(likelihood: &Likelihood<'_>, row: usize) -> String {
    let o = likelihood.observation(row);
    format!(
        "{} of test {}, {}, after {:.4e} cycles",
        o.quantity.name(),
        likelihood.measured.data.tests[o.test],
        o.member.name(),
        o.cycles
    )
}
