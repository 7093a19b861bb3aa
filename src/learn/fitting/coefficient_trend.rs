//! Whether the tests' own k follow a condition, or their length: what is taken for scatter between tests is then a law that the model lacks.
//!
//! ```text
//! ln k_i = a + b x_i + e_i        x = ln of torque, speed or last cycles measured, or the bulk temperature/(10 K); least squares over all tests
//!                                 told where |b| > t_{0.995}(n − 2) s_b
//! ```
//! Quantiles of Student's t distribution: ISO 2602 and any table of it.

use crate::learn::fitting::fitted::Fit;
use crate::measure::Dataset;
use crate::study::{Operation, Study};

/// t_{0.995} for 2, 3, … degrees of freedom; the last one from there on.
const STUDENT: [f64; 9] = [
    9.925, 5.841, 4.604, 4.032, 3.707, 3.499, 3.355, 3.250, 3.169,
];
/// Factor of k over the range of the condition from which it is worth telling.
const FACTOR: f64 = 1.25;
/// Range of x over which a law can show: a factor of 1.2 of torque or speed, 5 K.
const RANGE: f64 = 0.182;
const RANGE_OF_TEMPERATURE: f64 = 0.5;

/// So many times the square that the surest condition leaves of ln k, and another does not stand beside it: F of 3 and 3 degrees of freedom at 99 %.
const WORSE: f64 = 29.5;
/// Least square left of ln k that is counted: no test's k is known to better than a per cent.
const LEAST_LEFT: f64 = 1e-4;

/// Leverage of a single test from which the slope is that of this test against all others, which may be off for another reason.
const LEVERAGE: f64 = 0.98;

/// A condition of tests, with its name, x of an operation and the last cycles measured, and the least range of that; None where a test does not state it.
type Condition = (&'static str, fn(&Operation, f64) -> Option<f64>, f64);
const TEMPERATURE: &str = "bulk temperature";
const CYCLES: &str = "number of cycles";
const CONDITIONS: [Condition; 4] = [
    ("torque", |o, _| Some(o.torque_nmm.ln()), RANGE),
    ("speed", |o, _| Some(o.speed_rpm.ln()), RANGE),
    (
        TEMPERATURE,
        |o, _| Some(0.1 * o.bulk_temperature_c?),
        RANGE_OF_TEMPERATURE,
    ),
    (CYCLES, |_, cycles| Some(cycles.ln()), RANGE),
];

/// What k follows: the condition's name, b, its standard error, and the square left.
type Trend = (&'static str, f64, f64, f64);

/// The tests with rows, and ln of their own k.
pub(in crate::learn) fn own_coefficients(data: &Dataset, fit: &Fit) -> Vec<(usize, f64)> {
    let measured = |test: usize| data.observations.iter().any(|o| o.test == test);
    let known = fit.tests.iter();
    let known = known.filter(|test| test.coefficient > 0.0 && measured(test.test));
    known
        .map(|test| (test.test, test.coefficient.ln()))
        .collect()
}

/// The conditions that the `own` ln k of tests follow, the surest first, in words; None if they follow none.
pub(in crate::learn) fn trend_of_coefficients(
    study: &Study,
    data: &Dataset,
    own: &[(usize, f64)],
) -> Option<String> {
    let last_cycles = |test: usize| {
        let rows = data.observations.iter().filter(|o| o.test == test);
        rows.map(|o| o.cycles).fold(0.0, f64::max)
    };
    let tests: Vec<(&Operation, f64, f64)> = (own.iter())
        .map(|&(test, k)| (&study.tests[test].conditions, last_cycles(test), k))
        .collect();
    let mut found: Vec<Trend> = CONDITIONS
        .iter()
        .filter_map(|(name, of, least)| {
            let points = (tests.iter()).map(|(o, cycles, k)| Some((of(o, *cycles)?, *k)));
            let (slope, error, left) = line(&points.collect::<Option<Vec<_>>>()?, *least)?;
            Some((*name, slope, error, left))
        })
        .collect();
    found.sort_by(|a, b| a.3.total_cmp(&b.3));
    if let Some(surest) = found.first().map(|first| first.3) {
        found.retain(|trend| trend.3 <= WORSE * surest.max(LEAST_LEFT));
    }
    in_words(&found)
}

/// A slope with its error in two decimals, three where the error has none in two.
fn with_error(slope: f64, error: f64) -> String {
    if error < 0.005 {
        format!("{slope:.3} ± {error:.3}")
    } else {
        format!("{slope:.2} ± {error:.2}")
    }
}

/// The sentence on what k follows; None without any.
fn in_words(found: &[Trend]) -> Option<String> {
    let each = found.iter().map(|(name, slope, error, _)| {
        let turn = if *slope > 0.0 { "rises" } else { "falls" };
        let how = match *name {
            TEMPERATURE => format!("ln k by {} in 10 K", with_error(*slope, *error)),
            CYCLES => format!("as cycles to the power of {}", with_error(*slope, *error)),
            _ => format!("as {name} to the power of {}", with_error(*slope, *error)),
        };
        format!("{turn} with their {name} ({how})")
    });
    let each: Vec<String> = each.collect();
    let which = match found {
        [] => return None,
        [_] => "",
        [_, _] => "; these tests change them together, so it may be either",
        _ => "; these tests change them together, so it may be any of them",
    };
    Some(format!(
        "k of the tests {}{which}: what is taken for scatter between tests may be a law that the model lacks",
        each.join(" and ")
    ))
}

/// Slope, its standard error and the square left, where the slope is beyond chance and makes a difference.
fn line(points: &[(f64, f64)], least_range: f64) -> Option<(f64, f64, f64)> {
    let n = points.len() as f64;
    let student = STUDENT
        .get(points.len().checked_sub(4)?)
        .unwrap_or(&STUDENT[STUDENT.len() - 1]);
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let sum =
        |of: &dyn Fn(f64, f64) -> f64| points.iter().map(|p| of(p.0 - x, p.1 - y)).sum::<f64>();
    let (xx, xy) = (sum(&|x, _| x * x), sum(&|x, y| x * y));
    let lowest = points.iter().map(|p| p.0).fold(f64::INFINITY, f64::min);
    let highest = points.iter().map(|p| p.0).fold(f64::NEG_INFINITY, f64::max);
    let range = highest - lowest;
    if range < least_range {
        return None;
    }
    if points
        .iter()
        .any(|p| n.recip() + (p.0 - x).powi(2) / xx > LEVERAGE)
    {
        return None;
    }
    let slope = xy / xx;
    let left = sum(&|x, y| (y - slope * x).powi(2));
    let error = (left / (n - 2.0) / xx).sqrt();
    (slope.abs() > student * error && slope.abs() * range > FACTOR.ln())
        .then_some((slope, error, left))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Exact laws of each condition: T^0.7, n^-0.4 and exp(0.025 (θ - 40 °C)).
    #[test]
    fn the_slope_of_a_condition_is_in_its_own_unit() {
        let at = |torque: f64, speed: f64, warm: Option<f64>| Operation {
            bulk_temperature_c: warm,
            ..Operation::at(torque, speed)
        };
        let slope = |number: usize, tests: [(Operation, f64); 4]| {
            let (name, x, least) = CONDITIONS[number];
            let points = tests.map(|(o, k): (Operation, f64)| (x(&o, 1e6).unwrap(), k.ln()));
            (name, line(&points, least).unwrap().0)
        };
        let of = |values: [f64; 4], at: &dyn Fn(f64) -> (Operation, f64)| values.map(at);
        let torques = of([50.0, 80.0, 120.0, 200.0], &|t| {
            (at(t, 1e3, None), t.powf(0.7))
        });
        let (name, found) = slope(0, torques);
        assert!(name == "torque" && (found - 0.7).abs() < 1e-9, "{found}");
        let speeds = of([300.0, 800.0, 1e3, 2e3], &|n| {
            (at(90.0, n, None), n.powf(-0.4))
        });
        let (name, found) = slope(1, speeds);
        assert!(name == "speed" && (found + 0.4).abs() < 1e-9, "{found}");
        let law = |warm: f64| (0.025 * (warm - 40.0)).exp();
        let warm = of([35.0, 40.0, 60.0, 65.0], &|warm| {
            (at(90.0, 1e3, Some(warm)), law(warm))
        });
        let (name, found) = slope(2, warm);
        assert!(
            name == TEMPERATURE && (found - 0.25).abs() < 1e-9,
            "{found}"
        );
    }

    /// By hand, five points: Σxx = 10, Σxy = 4.99, residual square 7.9e-4 on 3 degrees of freedom.
    #[test]
    fn a_slope_is_told_with_its_error_where_it_is_beyond_chance() {
        let scattered = [(-1.0, 0.1), (0.0, 0.0), (1.0, 1.1), (2.0, 2.0)];
        assert_eq!(line(&scattered, RANGE), None);
        let five = [
            (-1.0, -0.51),
            (0.0, 0.02),
            (1.0, 0.49),
            (2.0, 1.01),
            (3.0, 1.49),
        ];
        let (slope, error, left) = line(&five, RANGE).unwrap();
        assert!((slope - 0.499).abs() < 1e-12, "{slope}");
        assert!((error - 0.005_131_601).abs() < 1e-8, "{error}");
        assert!((left - 7.9e-4).abs() < 1e-5, "{left}");
        // two conditions at once are both named
        assert_eq!(in_words(&[]), None);
        let both = in_words(&[("speed", 0.5, 0.01, 0.1), ("torque", -0.3, 0.02, 0.2)]).unwrap();
        assert!(
            both.starts_with("k of the tests rises with their speed (as speed to the power of 0.50 ± 0.01) and falls with their torque"),
            "{both}"
        );
        assert!(both.contains("it may be either"), "{both}");
        let warm = in_words(&[(TEMPERATURE, 0.25, 0.01, 0.1)]).unwrap();
        assert!(
            warm.contains("rises with their bulk temperature (ln k by 0.25 ± 0.01 in 10 K)"),
            "{warm}"
        );
        // a load that rises where the tests are shorter
        let shorter = in_words(&[("torque", 0.5, 0.01, 0.1), (CYCLES, -0.3, 0.02, 0.2)]).unwrap();
        assert!(
            shorter
                .contains("and falls with their number of cycles (as cycles to the power of -0.30"),
            "{shorter}"
        );
        // one test against all others
        let against = |last: f64| [(0.0, 0.01), (0.02, -0.01), (0.01, 0.0), (last, 1.0)];
        assert_eq!(line(&against(1.0), RANGE), None);
        // too few, or one condition for all
        assert_eq!(line(&five[..3], RANGE), None);
        assert_eq!(
            line(&[(1.0, 0.0), (1.0, 1.0), (1.0, 2.0), (1.0, 3.0)], RANGE),
            None
        );
    }
}
