//! Cycles of rows that are no revolutions but hours, minutes, thousands or millions.
//!
//! ```text
//! f_t = stated cycles/last row's     of each test whose last row stands before a 200th of what is stated
//! unit u(rpm): 60 rpm, rpm, 1e6, 1e3      possible where all f_t/u lie within 1/2 to 2, told by the range of ln f_t/u over the tests
//! ```
//! A time and a constant are told apart by tests of several speeds only.

use super::rounded;
use crate::measure::Dataset;
use crate::study::{Study, Test};

/// Part of the cycles that a study states before which no test is measured for the last time.
const EARLY: f64 = 0.005;
/// How far from a unit the factor of a test may lie: not every test is measured to its end.
const AMONG: f64 = 2.0;
/// How much farther apart the tests' factors must lie by one unit than by another for it to be given up, in ln.
const WIDER: f64 = 0.2;

/// What cycles may be, by the speed in rpm, with what they look like and what to do.
type Unit = (fn(f64) -> f64, &'static str, &'static str);
const UNITS: [Unit; 4] = [
    (
        |rpm| 60.0 * rpm,
        "hours of running",
        "multiply them by 60 times the speed in rpm, or read the table by gearwear import, which takes hours",
    ),
    (
        |rpm| rpm,
        "minutes of running",
        "multiply them by the speed in rpm",
    ),
    (|_| 1e6, "millions", "multiply them by 1e6"),
    (|_| 1e3, "thousands", "multiply them by 1000"),
];

/// A test whose rows end early: when, and how many times as many the study states.
struct Early<'s> {
    test: &'s Test,
    last: f64,
    times: f64,
}

/// Tests of which all rows stand so early in what the study states that their cycles are no revolutions but what they look like.
pub fn cycles_in_another_unit(study: &Study, data: &Dataset) -> Option<String> {
    let last = |test: usize| {
        let own = data.observations.iter().filter(|o| o.test == test);
        own.map(|o| o.cycles).fold(0.0, f64::max)
    };
    let early = (study.tests.iter().enumerate()).filter_map(|(number, test)| {
        let (last, stated) = (last(number), test.conditions.cycles);
        (last > 0.0 && last < EARLY * stated).then(|| Early {
            test,
            last,
            times: stated / last,
        })
    });
    let early: Vec<Early<'_>> = early.collect();
    let first = early.first()?;
    let looks = match units(&early).as_slice() {
        [] => return None,
        [(_, unit, advice)] => format!("they look like {unit}: {advice}"),
        several => {
            let each: Vec<String> = (several.iter())
                .map(|(_, unit, advice)| format!("like {unit} ({advice})"))
                .collect();
            format!("they look {}", each.join(" or "))
        }
    };
    let tests: Vec<&str> = early.iter().map(|early| early.test.id.as_str()).collect();
    Some(format!(
        "the rows of test{} {} end at {} cycles{} where the study states {}, {:.0} times as many: cycles are revolutions of the pinion; {looks}",
        if tests.len() > 1 { "s" } else { "" },
        tests.join(", "),
        rounded(first.last),
        if tests.len() > 1 {
            format!(" (test {})", first.test.id)
        } else {
            String::new()
        },
        first.test.conditions.cycles,
        first.times
    ))
}

/// The units that may be meant, the nearest first.
fn units(early: &[Early<'_>]) -> Vec<Unit> {
    let off = |unit: &Unit| -> Vec<f64> {
        let of = |early: &Early<'_>| (early.times / unit.0(early.test.conditions.speed_rpm)).ln();
        early.iter().map(of).collect()
    };
    let farthest = |off: &[f64]| off.iter().fold(0.0f64, |far, off| far.max(off.abs()));
    let range = |off: &[f64]| {
        let low = off.iter().copied().fold(f64::INFINITY, f64::min);
        off.iter().copied().fold(f64::NEG_INFINITY, f64::max) - low
    };
    let mut possible: Vec<(Unit, Vec<f64>)> = UNITS
        .into_iter()
        .map(|unit| (unit, off(&unit)))
        .filter(|(_, off)| farthest(off) <= AMONG.ln())
        .collect();
    let least = (possible.iter())
        .map(|(_, off)| range(off))
        .fold(f64::INFINITY, f64::min);
    possible.retain(|(_, off)| range(off) < least + WIDER);
    possible.sort_by(|(_, a), (_, b)| farthest(a).total_cmp(&farthest(b)));
    possible.into_iter().map(|(unit, _)| unit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is said of tests A and B at these speeds whose rows end at these cycles, where 500 000 are stated.
    fn said(tests: [(f64, f64); 2]) -> Option<String> {
        let text = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let mut study = Study::parse(text, "study.toml").unwrap();
        let mut rows = "test,member,cycles,quantity,position,value,sigma\n".to_owned();
        for (number, (rpm, last)) in tests.into_iter().enumerate() {
            let conditions = &mut study.tests[number].conditions;
            (conditions.speed_rpm, conditions.cycles) = (rpm, 5e5);
            rows += &format!(
                "{},pinion,{last},wear_depth,26.5,1,0.1\n",
                study.tests[number].id
            );
        }
        let data = Dataset::parse(&rows, "m.csv", &study.known()).unwrap();
        cycles_in_another_unit(&study, &data)
    }

    #[test]
    fn tests_of_several_speeds_tell_thousands_from_minutes() {
        let thousands = said([(1200.0, 500.0), (600.0, 500.0)]).unwrap();
        assert!(
            thousands.ends_with("they look like thousands: multiply them by 1000"),
            "{thousands}"
        );
        let minutes = said([(1500.0, 5e5 / 1500.0), (750.0, 5e5 / 750.0)]).unwrap();
        assert!(
            minutes
                .ends_with("they look like minutes of running: multiply them by the speed in rpm"),
            "{minutes}"
        );
    }

    #[test]
    fn tests_of_one_speed_may_be_either() {
        let either = said([(1200.0, 500.0), (1200.0, 500.0)]).unwrap();
        assert!(
            either.ends_with(
                "they look like thousands (multiply them by 1000) or like minutes of running (multiply them by the speed in rpm)"
            ),
            "{either}"
        );
        let hours = said([(1200.0, 7.0), (1200.0, 7.0)]).unwrap();
        assert!(
            hours.contains("they look like hours of running: multiply"),
            "{hours}"
        );
        assert_eq!(said([(1200.0, 4e5), (1200.0, 5e5)]), None);
    }
}
