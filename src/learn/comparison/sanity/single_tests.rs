//! What is wrong with the measurements of one test, where those of the others are right.

use std::collections::BTreeSet;

use super::super::residual_statistics::FittedRow;
use super::coefficient::FAR_FROM_STATED;
use super::depths_and_masses::depths_and_masses;
use super::{CLEAR_RATIO, EXPLAINS, SAME_CYCLES, rounded, scale};
use crate::learn::fitting::coefficient_trend::own_coefficients;
use crate::learn::fitting::fitted::Fit;
use crate::learn::fitting::test_apart::test_apart;
use crate::measure::{Dataset, Quantity};
use crate::study::{Operation, Study};

/// Standard deviations of s below 0 from which a single test's sign is doubted.
const SURE: f64 = 6.0;
/// Share of a transmission error that the computed one turned round must explain, where wear that was fitted to it has spoiled the rest.
const EXPLAINS_A_TURN: f64 = 0.2;
/// The same of that of the pinion, in all tests.
const NEARLY_ALL: f64 = 0.9;
/// How far the factor of the other tests may be from 1 or, where all are the pinion's, from the ratio, as a share.
const OF_OTHERS: f64 = 0.3;
/// Mean square of what a trace from before the first cycle shows beyond its datum, in noise, from which it is no noise.
const WORN: f64 = 4.0;
/// Prior standard deviations of the datum from which a trace before the first cycle is too far from zero.
const DATUMS: f64 = 3.0;
/// How near the ratio a test's k must be, and how near each other those of the other tests, in ln of the ratio.
const NEAR_RATIO: f64 = 0.1;
const ALIKE: f64 = 0.3;
/// The first of these for a test whose speed or temperature, K, lies beyond those of the others by so much.
const NEAR_RATIO_AT_ANOTHER_SPEED: f64 = 0.03;
const ANOTHER_SPEED: f64 = 1.3;
const ANOTHER_TEMPERATURE: f64 = 8.0;
/// Deviation up to which a torque is another one times the ratio, and the part of ln of the ratio by which k must then be lower.
const SAME_TORQUE: f64 = 0.002;
const HALF: f64 = 0.5;
/// How far outside the other tests' torques or cycles a corrected one may lie.
const AMONG: f64 = 2.0;
/// Into how many parts a test is usually divided.
const USUAL_PARTS: [u32; 6] = [2, 3, 4, 5, 8, 10];

/// Each test that has rows, with these.
pub(super) fn by_test<'r, 'd>(
    study: &'r Study,
    rows: &'r [FittedRow<'d>],
) -> impl Iterator<Item = (&'r str, Vec<FittedRow<'d>>)> {
    let of = move |test: usize| {
        let own: Vec<FittedRow<'d>> = rows
            .iter()
            .filter(|(o, _)| o.test == test)
            .copied()
            .collect();
        (study.tests[test].id.as_str(), own)
    };
    (0..study.tests.len())
        .map(of)
        .filter(|(_, own)| !own.is_empty())
}

/// Tests of which the transmission error runs against the computed one, as a question; None where there is none.
pub(super) fn turned_rotation(study: &Study, rows: &[FittedRow<'_>]) -> Option<String> {
    let is_turned = |own: &[FittedRow<'_>]| {
        scale(own, Quantity::TransmissionError, None)
            .is_some_and(|s| s.sigmas < -SURE && s.explains > EXPLAINS_A_TURN)
    };
    let turned = by_test(study, rows).filter(|(_, own)| is_turned(own));
    let turned: Vec<&str> = turned.map(|(id, _)| id).collect();
    (!turned.is_empty()).then(|| {
        format!(
            "transmission_error of test{} {} runs against the computed one, and k of the tests do not agree: has it the other sign, or do its positions run \
             the other way? A gear that lags counts negative, and rotations from the pitch point in the sense of the pinion's turning. Turn it and check again",
            if turned.len() > 1 { "s" } else { "" },
            turned.join(", ")
        )
    })
}

/// The same of some tests where those of the others run as computed; or tests of which it is larger by the ratio of the numbers of teeth, as the
/// pinion's rotations are.
pub(super) fn rotation_of_some_tests(study: &Study, rows: &[FittedRow<'_>]) -> Option<String> {
    let of = |(id, own): (&'_ str, Vec<FittedRow<'_>>)| {
        let scale = scale(&own, Quantity::TransmissionError, None)?;
        Some((id.to_owned(), scale))
    };
    let scales: Vec<_> = by_test(study, rows).filter_map(of).collect();
    let named = |is: &dyn Fn(f64) -> bool| {
        let found = (scales.iter())
            .filter(|(_, s)| s.sigmas.abs() > SURE && s.explains > EXPLAINS && is(s.factor));
        found.map(|(id, _)| id.as_str()).collect::<Vec<&str>>()
    };
    let turned = named(&|factor| factor < 0.0);
    if !turned.is_empty() && turned.len() < scales.len() {
        return Some(format!(
            "transmission_error of {} runs against the computed one, that of the other tests does not: has it the other sign, or do its positions run the \
             other way there?",
            tests_in_words(&turned)
        ));
    }
    let [pinion, gear] = [&study.gears.pinion, &study.gears.gear].map(|g| g.spec.teeth);
    let ratio = f64::from(gear) / f64::from(pinion);
    let of_pinion = named(&|factor| factor > 0.0 && (factor / ratio).ln().abs() < NEAR_RATIO);
    let others = || {
        scales
            .iter()
            .filter(|(id, _)| !of_pinion.contains(&id.as_str()))
    };
    let are_near = |factor: f64| others().all(|(_, s)| (s.factor / factor - 1.0).abs() < OF_OTHERS);
    // a flexibility that the model lacks makes it larger in all tests, and changes its shape
    let is_shape = (scales.iter())
        .filter(|(id, _)| of_pinion.contains(&id.as_str()))
        .all(|(_, s)| s.explains > NEARLY_ALL);
    let in_all = are_near(ratio);
    let is_sure = in_all && is_shape || !in_all && are_near(1.0);
    (ratio > CLEAR_RATIO && !of_pinion.is_empty() && is_sure).then(|| {
        format!(
            "transmission_error of {} is about {gear}/{pinion} times the computed one: is it that of the pinion? That of the gear is wanted: divide it by \
             {gear}/{pinion}",
            tests_in_words(&of_pinion)
        )
    })
}

pub(super) fn tests_in_words(ids: &[&str]) -> String {
    format!(
        "test{} {}",
        if ids.len() > 1 { "s" } else { "" },
        ids.join(", ")
    )
}

/// Depths and masses of some tests that call for different coefficients; None where that is so of none, or of all that have both.
pub(super) fn depths_and_masses_of_tests(
    study: &Study,
    rows: &[FittedRow<'_>],
    k: f64,
) -> Option<Vec<String>> {
    let both = |own: &[FittedRow<'_>]| {
        let has = |quantity| own.iter().any(|(o, _)| o.quantity == quantity);
        has(Quantity::WearDepth) && has(Quantity::MassLoss)
    };
    let tests: Vec<_> = by_test(study, rows).filter(|(_, own)| both(own)).collect();
    let said: Vec<String> = tests
        .iter()
        .filter_map(|(id, own)| {
            Some(format!(
                "in test {id} {}",
                depths_and_masses(study, own, k)?
            ))
        })
        .collect();
    (!said.is_empty() && said.len() < tests.len()).then_some(said)
}

/// A test whose own k lies hundreds of times from those of the others, or several times, where these agree.
pub(super) fn coefficients(study: &Study, data: &Dataset, fit: &Fit) -> Vec<String> {
    let own = own_coefficients(data, fit);
    let far = own.iter().filter_map(|one| far_off(study, &own, *one));
    let far: Vec<String> = far.collect();
    if !far.is_empty() {
        return far;
    }
    let logs: Vec<f64> = own.iter().map(|one| one.1).collect();
    let apart = test_apart(&logs).map(|apart| apart.in_words(&study.tests[own[apart.test].0].id));
    apart.into_iter().collect()
}

/// A test whose ln k lies hundreds of times from those of the others.
fn far_off(study: &Study, own: &[(usize, f64)], (test, k): (usize, f64)) -> Option<String> {
    let mut others: Vec<f64> = own.iter().filter(|o| o.0 != test).map(|o| o.1).collect();
    others.sort_by(f64::total_cmp);
    let middle = *others.get(others.len() / 2)?;
    // of two tests nobody knows which is off
    (others.len() > 1 && (k - middle).abs() > FAR_FROM_STATED.ln()).then(|| {
            let (word, by) = if k > middle { ("above", k - middle) } else { ("below", middle - k) };
            format!(
                "test {} wears with a k {} times {word} that of the others: look at the units of its values (mm for µm, g for mg), of its cycles \
                 and of its torque",
                study.tests[test].id,
                rounded(by.exp())
            )
        })
}

/// A test whose own k lies off those of the others, which agree, by the ratio of the numbers of teeth: its torque may be the gear's (too
/// little wear for what is stated) or its cycles (too much); from a `least_ratio` on. Only where what the correction makes of it lies among the other tests'.
pub(super) fn of_the_other_member(
    study: &Study,
    data: &Dataset,
    fit: &Fit,
    least_ratio: f64,
) -> Vec<String> {
    let [pinion, gear] = [&study.gears.pinion, &study.gears.gear].map(|g| g.spec.teeth);
    let ratio = f64::from(gear) / f64::from(pinion);
    if ratio < least_ratio {
        return Vec::new();
    }
    let own = own_coefficients(data, fit);
    let torque = |test: usize| study.tests[test].conditions.torque_nmm / 1e3;
    let cycles = |test: usize| study.tests[test].conditions.cycles;
    let off = |&(test, k): &(usize, f64)| {
        let others: Vec<(usize, f64)> = own.iter().filter(|o| o.0 != test).copied().collect();
        if others.len() < 2 {
            return None;
        }
        let mean = others.iter().map(|o| o.1).sum::<f64>() / others.len() as f64;
        let agree = others
            .iter()
            .all(|o| (o.1 - mean).abs() < ALIKE * ratio.ln());
        let by = (k - mean) / ratio.ln();
        let among = |corrected: f64, stated: &dyn Fn(usize) -> f64| {
            let of_others = others.iter().map(|o| stated(o.0));
            let low = of_others.clone().fold(f64::INFINITY, f64::min);
            let high = of_others.fold(0.0, f64::max);
            corrected > low / AMONG && corrected < high * AMONG
        };
        // at another speed k may be another one
        let near = match runs_apart(study, test, &others) {
            true => NEAR_RATIO_AT_ANOTHER_SPEED,
            false => NEAR_RATIO,
        };
        let off_by_ratio = agree && (by.abs() - 1.0).abs() < near;
        // a test of that torque shows it even where the others scatter
        let twin = others.iter().find(|o| {
            (torque(test) / (ratio * torque(o.0)) - 1.0).abs() < SAME_TORQUE && !is_simple(ratio)
        });
        let said = |what: String, turn: &str| {
            format!(
                "test {} {what}: if that is the gear's, {turn} by {gear}/{pinion}",
                study.tests[test].id
            )
        };
        if let Some((other, of_other)) = twin.filter(|o| k - o.1 < -HALF * ratio.ln()) {
            let what = format!(
                "has {gear}/{pinion} times the torque of test {} ({} and {} N m) and wears with a k {} times that test's",
                study.tests[*other].id,
                torque(test),
                torque(*other),
                two_digits((k - of_other).exp())
            );
            Some(said(what, "divide its torque"))
        } else if off_by_ratio && by < 0.0 && among(torque(test) / ratio, &torque) {
            let what = format!(
                "wears with a k {} times that of the others, near {pinion}/{gear}, and they agree; its torque is stated as {} N m",
                two_digits((k - mean).exp()),
                torque(test)
            );
            let asked = said(what, "divide its torque");
            Some(format!(
                "{asked}; or is it, or are the cycles, stated too high?"
            ))
        } else if off_by_ratio && by > 0.0 && among(cycles(test) * ratio, &cycles) {
            let what = format!(
                "wears with a k {} times that of the others, near {gear}/{pinion}, and they agree; the study says that it lasts {} revolutions at {} N m",
                two_digits((k - mean).exp()),
                cycles(test),
                torque(test)
            );
            let asked = said(what, "multiply its cycles, and those of its rows,");
            // wear goes with load times cycles: the figures alone do not tell which is wrong
            Some(format!("{asked}; or is the torque stated too low?"))
        } else {
            None
        }
    };
    own.iter().filter_map(off).collect()
}

/// Whether a test runs faster or slower than all `others`, or warmer or cooler.
fn runs_apart(study: &Study, test: usize, others: &[(usize, f64)]) -> bool {
    let is_beyond = |of: &dyn Fn(&Operation) -> Option<f64>, by: f64| {
        let own = of(&study.tests[test].conditions);
        let all = others.iter().map(|o| of(&study.tests[o.0].conditions));
        own.zip(all.collect::<Option<Vec<f64>>>())
            .is_some_and(|(own, all)| {
                all.iter().all(|other| own > other + by) || all.iter().all(|other| own < other - by)
            })
    };
    is_beyond(&|o| Some(o.speed_rpm.ln()), ANOTHER_SPEED.ln())
        || is_beyond(&|o| o.bulk_temperature_c, ANOTHER_TEMPERATURE)
}

/// Whether a ratio is one that tests are chosen by, such as 2 or 3/2.
fn is_simple(ratio: f64) -> bool {
    (1..=4).any(|parts| {
        let part = ratio * f64::from(parts);
        (part - part.round()).abs() < SAME_TORQUE * part
    })
}

/// Two digits of a factor, below 1 too.
fn two_digits(factor: f64) -> String {
    if factor < 1.0 {
        format!("{factor:.2}")
    } else {
        rounded(factor)
    }
}

/// Traces from before the first cycle that are not flat, or farther from zero than the stated datum has it.
pub(super) fn worn_before_the_first_cycle(study: &Study, rows: &[FittedRow<'_>]) -> Vec<String> {
    let first = |(o, _): &&FittedRow<'_>| o.quantity == Quantity::WearDepth && o.cycles == 0.0;
    let before: Vec<FittedRow<'_>> = rows.iter().filter(first).copied().collect();
    let worn = |(id, own): (&str, Vec<FittedRow<'_>>)| {
        let square: f64 = own.iter().map(|(_, row)| row.standardised.powi(2)).sum();
        let largest = own
            .iter()
            .map(|(_, row)| row.residual.abs())
            .fold(0.0, f64::max);
        if square > WORN * own.len() as f64 {
            return Some(format!(
                "a trace of test {id} at 0 cycles is up to {} µm off, though nothing is worn there: look at its cycles, or leave it out",
                rounded(largest)
            ));
        }
        let count = own.len() as f64;
        let mean = own.iter().map(|(o, row)| o.value - row.model).sum::<f64>() / count;
        let noise = own.iter().map(|(o, _)| o.sigma.powi(2)).sum::<f64>().sqrt() / count;
        let usual = study.noise.datum_um;
        (mean.abs() > DATUMS * usual.max(noise)).then(|| {
            format!(
                "the traces of test {id} at 0 cycles are {} µm off as a whole, where [noise] datum = {usual} is usual: if all traces of the test are, \
                 take it off them; else state a datum that allows for it",
                rounded(mean)
            )
        })
    };
    by_test(study, &before).filter_map(worn).collect()
}

/// Tests whose last rows stand at the pinion's teeth over the gear's of the cycles that the study states: those are the gear's revolutions. A
/// usual part of a test, half or a third, tells only where all other tests were measured to their end. A tenth is asked about as a slip.
pub(super) fn short_of_their_cycles(study: &Study, data: &Dataset) -> Option<String> {
    let [pinion, gear] = [&study.gears.pinion, &study.gears.gear].map(|g| g.spec.teeth);
    let ratio = f64::from(pinion) / f64::from(gear);
    let is_usual = |parts: &u32| {
        let part = ratio * f64::from(*parts);
        (part - part.round()).abs() < 2.0 * SAME_CYCLES * part
    };
    let tests: BTreeSet<usize> = data.observations.iter().map(|o| o.test).collect();
    let ends_at = |part: f64| {
        move |test: &&usize| {
            let own = data.observations.iter().filter(|o| o.test == **test);
            let last = own.map(|o| o.cycles).fold(0.0, f64::max);
            let stated = study.tests[**test].conditions.cycles;
            (last / (part * stated) - 1.0).abs() < SAME_CYCLES
        }
    };
    let named = |tests: &[&usize]| {
        let ids = tests.iter().map(|test| study.tests[**test].id.as_str());
        let s = if tests.len() > 1 { "s" } else { "" };
        format!("test{s} {}", ids.collect::<Vec<_>>().join(", "))
    };
    let whole = tests.iter().filter(ends_at(1.0)).count();
    for (places, word) in [(1, "tenth"), (2, "hundredth"), (3, "thousandth")] {
        let off: Vec<&usize> = tests.iter().filter(ends_at(0.1_f64.powi(places))).collect();
        let of_gear = (ratio * 10f64.powi(places) - 1.0).abs() < 2.0 * SAME_CYCLES;
        if !of_gear && !off.is_empty() && whole > 0 && whole + off.len() == tests.len() {
            return Some(format!(
                "the last rows of {} stand at a {word} of the cycles that the study states, those of the other tests at all of them: is the one or the \
                 other off by a decimal place?",
                named(&off)
            ));
        }
    }
    let short: Vec<&usize> = tests.iter().filter(ends_at(ratio)).collect();
    // both members turn alike
    let alike = (ratio - 1.0).abs() < 2.0 * SAME_CYCLES;
    let usual = USUAL_PARTS.iter().any(is_usual);
    if alike || usual && (whole == 0 || short.len() + whole < tests.len()) {
        return None;
    }
    (!short.is_empty()).then(|| {
        format!(
            "the last rows of {} stand at {pinion}/{gear} of the cycles that the study states: cycles are revolutions of the pinion for both members; if \
             these are the gear's own, multiply them by {gear}/{pinion}",
            named(&short)
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A test beyond the speeds or temperatures of the others, and not one among them.
    #[test]
    fn a_test_at_another_speed_or_temperature_runs_apart() {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let mut study = Study::parse(study, "study.toml").unwrap();
        let mut apart = |speeds: [f64; 3], warm: [f64; 3]| {
            let tests = study.tests.iter_mut().zip(speeds.into_iter().zip(warm));
            for (test, (speed, celsius)) in tests {
                test.conditions.speed_rpm = speed;
                test.conditions.bulk_temperature_c = Some(celsius);
            }
            runs_apart(&study, 2, &[(0, 0.0), (1, 0.0)])
        };
        assert!(!apart([1500.0, 1000.0, 1200.0], [60.0; 3]));
        assert!(!apart([1500.0, 1000.0, 1600.0], [60.0; 3]));
        assert!(apart([1500.0, 1500.0, 3000.0], [60.0; 3]));
        assert!(apart([1500.0, 1500.0, 800.0], [60.0; 3]));
        assert!(apart([1500.0; 3], [60.0, 65.0, 80.0]));
        assert!(!apart([1500.0; 3], [60.0, 80.0, 70.0]));
    }

    /// What `question` says of a transmission error that is `factor` times the computed one and has something `else_besides` (12 as it usually is), in
    /// test B alone or in both.
    fn asked(
        factor: f64,
        both: bool,
        else_besides: f64,
        question: fn(&Study, &[FittedRow<'_>]) -> Option<String>,
    ) -> Option<String> {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let mut text = "test,member,cycles,quantity,position,value,sigma,trace\n".to_owned();
        let mut models = Vec::new();
        for test in ["A", "B"] {
            for at in 0..12 {
                let place = f64::from(at) / 12.0;
                let turn = 2.0 * std::f64::consts::PI * place;
                let own = if both || test == "B" { factor } else { 1.0 };
                let value = own * 10.0 * turn.sin() + else_besides * (2.0 * turn).cos() - 5.0;
                text +=
                    &format!("{test},pair,100000,transmission_error,{place},{value},0.5,{test}\n");
                models.push(10.0 * turn.sin());
            }
        }
        let data = Dataset::parse(&text, "m.csv", &study.known()).unwrap();
        let fits = super::super::fits_of(&models);
        let rows: Vec<FittedRow<'_>> = data.observations.iter().zip(&fits).collect();
        question(&study, &rows)
    }

    fn said(factor: f64, both: bool) -> Option<String> {
        asked(factor, both, 12.0, turned_rotation)
    }

    #[test]
    fn a_transmission_error_of_some_tests_is_held_against_that_of_the_others() {
        let said = |factor, both| asked(factor, both, 3.0, rotation_of_some_tests);
        let turned = said(-0.9, false).unwrap();
        assert!(
            turned.starts_with("transmission_error of test B runs against"),
            "{turned}"
        );
        // of all it is asked elsewhere
        assert_eq!(said(-0.9, true), None);
        // 27 and 53 teeth
        let of_pinion = said(1.95, false).unwrap();
        assert!(
            of_pinion.starts_with("transmission_error of test B is about 53/27 times"),
            "{of_pinion}"
        );
        assert!(said(1.95, true).unwrap().contains("of tests A, B is about"));
        // with a shape that is not the computed one
        assert_eq!(asked(1.95, true, 12.0, rotation_of_some_tests), None);
        assert_eq!(said(1.3, false), None);
        assert_eq!(said(1.0, false), None);
    }

    /// A third of it is the computed one turned round, which is too little where nothing else is wrong.
    #[test]
    fn a_transmission_error_that_runs_the_other_way_is_named_with_its_tests() {
        assert_eq!(said(1.0, true), None);
        let one = said(-0.9, false).unwrap();
        assert!(
            one.starts_with("transmission_error of test B runs against"),
            "{one}"
        );
        let both = said(-0.9, true).unwrap();
        assert!(
            both.starts_with("transmission_error of tests A, B runs against"),
            "{both}"
        );
        assert_eq!(said(-0.3, true), None);
    }
}
