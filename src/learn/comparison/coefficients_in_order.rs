//! Whether the tests' own k rise or fall in the order of a condition: with three or four tests a line through them shows nothing, their order may.

use super::own_coefficient::OwnK;
use crate::numeric::written::{plain, significant};
use crate::study::Operation;

/// Least number of different values of a condition.
const VALUES: usize = 3;
/// Most tests whose k are listed.
const LISTED: usize = 6;
/// Relative difference from which two conditions are two.
const DIFFERENT: f64 = 0.01;

/// A condition: its name, its value where a test has one, its unit.
type Condition = (&'static str, fn(&Operation) -> Option<f64>, &'static str);
const CONDITIONS: [Condition; 3] = [
    ("torque", |o| Some(1e-3 * o.torque_nmm), "N·m"),
    ("speed", |o| Some(o.speed_rpm), "rpm"),
    ("bulk temperature", |o| o.bulk_temperature_c, "°C"),
];

/// The conditions in whose order all of the tests' own k are, in words; None where they are in the order of none.
pub(super) fn in_order(tests: &[(&Operation, &OwnK<'_>)]) -> Option<String> {
    let found: Vec<String> = CONDITIONS
        .iter()
        .filter_map(|condition| along(condition, tests))
        .collect();
    let which = if found.len() > 1 {
        " (the tests change these together: it may be either)"
    } else {
        ""
    };
    (!found.is_empty()).then(|| format!("k {}{which}", found.join(" and ")))
}

fn along(condition: &Condition, tests: &[(&Operation, &OwnK<'_>)]) -> Option<String> {
    let (name, of, unit) = condition;
    let points = tests.iter().map(|(test, own)| Some((of(test)?, *own)));
    let mut points: Vec<(f64, &OwnK<'_>)> = points.collect::<Option<_>>()?;
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let differ = |a: f64, b: f64| (b - a).abs() > DIFFERENT * b.abs();
    let values = 1 + points.windows(2).filter(|w| differ(w[0].0, w[1].0)).count();
    let (first, last) = (points.first()?, points.last()?);
    if values < VALUES || !first.1.is_unlike(last.1) {
        return None;
    }
    let sign = (last.1.log - first.1.log).signum();
    let pairs = (points.iter().enumerate())
        .flat_map(|(i, one)| points[i + 1..].iter().map(move |other| (one, other)));
    // tests at one value whose k are unlike go by something else
    let mut pairs = pairs.map(|(one, other)| match differ(one.0, other.0) {
        true => sign * (other.1.log - one.1.log) > 0.0,
        false => !one.1.is_unlike(other.1),
    });
    if !pairs.all(|agrees| agrees) {
        return None;
    }
    let turn = if sign > 0.0 { "rises" } else { "falls" };
    let shown: Vec<&(f64, &OwnK<'_>)> = match points.len() {
        ..=LISTED => points.iter().collect(),
        _ => vec![first, last],
    };
    let between = if shown.len() < points.len() {
        " … "
    } else {
        ", "
    };
    let conditions: Vec<String> = shown.iter().map(|(value, _)| plain(*value)).collect();
    let k: Vec<f64> = shown.iter().map(|(_, own)| own.log.exp()).collect();
    Some(format!(
        "{turn} with the {name} ({} {unit}: {} mm²/N)",
        conditions.join(between),
        listed(&k, between)
    ))
}

/// Figures, a power of ten that all of them share written once.
fn listed(values: &[f64], between: &str) -> String {
    let all: Vec<String> = values.iter().map(|k| significant(*k, 3)).collect();
    let power = |figure: &str| figure.split_once('·').map(|(_, power)| power.to_owned());
    match power(&all[0]) {
        Some(shared) if all.iter().all(|one| power(one).as_ref() == Some(&shared)) => {
            let numbers = all.iter().filter_map(|one| one.split('·').next());
            format!("{}·{shared}", numbers.collect::<Vec<&str>>().join(between))
        }
        _ => all.join(between),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Torque in N·m, speed, k in 1e-10 mm²/N, its relative error.
    fn told(of: &[(f64, f64, f64, f64)]) -> Option<String> {
        let of = of.iter();
        let of: Vec<_> = of
            .map(|&(torque, speed, k, sigma)| (torque, speed, k, sigma, None))
            .collect();
        told_warm(&of)
    }

    /// The same with bulk temperatures in °C.
    fn told_warm(of: &[(f64, f64, f64, f64, Option<f64>)]) -> Option<String> {
        let operation = |torque: f64, speed: f64, warm: Option<f64>| Operation {
            bulk_temperature_c: warm,
            ..Operation::at(torque, speed)
        };
        let all: Vec<(Operation, OwnK<'_>)> = (of.iter())
            .map(|&(torque, speed, k, sigma, warm)| {
                let own = OwnK {
                    test: "A",
                    log: (1e-10 * k).ln(),
                    sigma,
                };
                (operation(torque, speed, warm), own)
            })
            .collect();
        let all: Vec<(&Operation, &OwnK<'_>)> = all.iter().map(|(o, own)| (o, own)).collect();
        in_order(&all)
    }

    #[test]
    fn three_k_in_the_order_of_the_torque_are_told_with_their_figures() {
        let said = told(&[
            (90.0, 1000.0, 1.28, 0.02),
            (60.0, 1000.0, 1.12, 0.02),
            (120.0, 1000.0, 1.52, 0.02),
        ]);
        assert_eq!(
            said.as_deref(),
            Some("k rises with the torque (60, 90, 120 N·m: 1.12, 1.28, 1.52·10⁻¹⁰ mm²/N)")
        );
        let both = told(&[
            (90.0, 1000.0, 1.28, 0.02),
            (60.0, 2000.0, 0.92, 0.02),
            (120.0, 500.0, 1.52, 0.02),
        ])
        .unwrap();
        assert!(both.contains("9.20·10⁻¹¹, 1.28·10⁻¹⁰"), "{both}");
        assert!(both.contains(" and falls with the speed (500, "), "{both}");
        assert!(both.ends_with("it may be either)"), "{both}");
    }

    /// Two tests at one speed tell that it is not the speed; the temperatures are in the order of all k.
    #[test]
    fn unlike_k_at_one_value_are_no_order_of_it() {
        let of = [
            (400.0, 1.74, 35.0),
            (1000.0, 1.75, 35.5),
            (1000.0, 3.31, 60.0),
            (1800.0, 3.74, 65.0),
        ];
        let said = told_warm(&of.map(|(speed, k, warm)| (20.0, speed, k, 0.02, Some(warm))));
        let said = said.unwrap();
        assert!(
            said.starts_with("k rises with the bulk temperature (35, 35.5, 60, 65 °C: 1.74"),
            "{said}"
        );
        assert!(!said.contains("speed"), "{said}");
        assert_eq!(
            told_warm(&of.map(|(speed, k, _)| (20.0, speed, k, 0.02, None))),
            None
        );
    }

    #[test]
    fn two_tests_two_values_chance_and_disorder_are_no_order() {
        for none in [
            &[(60.0, 1.0, 1.0, 0.01), (90.0, 1.0, 2.0, 0.01)][..],
            &[
                (60.0, 1.0, 1.0, 0.01),
                (60.0, 1.0, 1.1, 0.01),
                (90.0, 1.0, 2.0, 0.01),
            ],
            &[
                (60.0, 1.0, 1.0, 0.3),
                (90.0, 1.0, 1.2, 0.3),
                (120.0, 1.0, 1.5, 0.3),
            ],
            &[
                (60.0, 1.0, 1.0, 0.01),
                (90.0, 1.0, 1.6, 0.01),
                (120.0, 1.0, 1.5, 0.01),
            ],
        ] {
            assert_eq!(told(none), None);
        }
    }
}
