//! Cycles of rows that count from the measurement before, and not from the start.
//!
//! ```text
//! c_1, c_2, … of a member's traces, or masses, in the order of the file
//! Σ c_i = the cycles that the study states, no c_i beyond three quarters of them
//! where c_i ≤ c_(i−1): the wear grew all the same
//! if that is nowhere so: four measurements or more, and wear over c_1 + … + c_i ranges less than half as far, in ln, as wear over c_i
//! ```

use super::SAME_CYCLES;
use crate::measure::{Dataset, FacePlace, Observation, Quantity, Subject};
use crate::study::Study;

/// Part of the stated cycles that none of the increments reaches.
const LARGEST: f64 = 0.75;
/// Factor by which wear must grow between rows of the same cycles to be no repetition.
const GROWS: f64 = 1.1;
/// Fewest increments that tell where each is larger than the one before, and part of the range of wear per cycle that may be left.
const SEVERAL: usize = 4;
const LEFT: f64 = 0.5;

/// Traces, or a mass, at one moment: its cycles and the mean of what was lost.
struct Measurement {
    cycles: f64,
    trace: Option<usize>,
    sum: f64,
    count: f64,
}

/// Tests of which the rows' cycles add up to what the study states.
pub(super) fn increments(study: &Study, data: &Dataset) -> Option<String> {
    let tests: Vec<&str> = (0..study.tests.len())
        .filter(|&test| adds_up(data, test, study.tests[test].conditions.cycles))
        .map(|test| study.tests[test].id.as_str())
        .collect();
    (!tests.is_empty()).then(|| {
        format!(
            "the cycles of the rows of test{} {} add up to those that the study states, and wear grows from row to row: are they counted from the \
             measurement before? They are wanted from the start of the test",
            if tests.len() > 1 { "s" } else { "" },
            tests.join(", ")
        )
    })
}

/// Whether those of the masses or of the depths of either member do.
fn adds_up(data: &Dataset, test: usize, stated: f64) -> bool {
    [Subject::Pinion, Subject::Gear].into_iter().any(|member| {
        [Quantity::MassLoss, Quantity::WearDepth]
            .into_iter()
            .any(|quantity| {
                let all = measurements(data, (test, member, quantity));
                are_increments(&all, stated)
            })
    })
}

/// What was measured after the first cycle, in the order of the file.
fn measurements(data: &Dataset, of: (usize, Subject, Quantity)) -> Vec<Measurement> {
    let mut all: Vec<Measurement> = Vec::new();
    let own = || {
        let all = data.observations.iter();
        all.filter(|o| (o.test, o.member, o.quantity) == of && o.cycles > 0.0)
    };
    // of one place across the face and one tooth: others may stand at the same cycles
    let place = |o: &Observation| (o.face.map(FacePlace::key), o.tooth.clone());
    let first = own().next().map(place);
    for o in own().filter(|o| Some(place(o)) == first) {
        let same = |m: &&mut Measurement| {
            o.quantity == Quantity::WearDepth && (m.cycles, m.trace) == (o.cycles, o.trace)
        };
        match all.last_mut().filter(same) {
            Some(last) => {
                last.sum += o.value;
                last.count += 1.0;
            }
            None => all.push(Measurement {
                cycles: o.cycles,
                trace: o.trace,
                sum: o.value,
                count: 1.0,
            }),
        }
    }
    all
}

fn are_increments(all: &[Measurement], stated: f64) -> bool {
    let sum: f64 = all.iter().map(|m| m.cycles).sum();
    let largest = all.iter().map(|m| m.cycles).fold(0.0, f64::max);
    if all.len() < 2 || (sum / stated - 1.0).abs() > SAME_CYCLES || largest > LARGEST * stated {
        return false;
    }
    let not_later = || all.windows(2).filter(|two| two[1].cycles <= two[0].cycles);
    let grows = |two: &[Measurement]| {
        let [before, after] = [&two[0], &two[1]].map(|m| m.sum / m.count);
        before > 0.0 && after > GROWS * before
    };
    match not_later().count() {
        0 => all.len() >= SEVERAL && grows_with_the_sum(all),
        _ => not_later().all(grows),
    }
}

/// Whether wear is nearer to being in proportion to the sum of the cycles than to the cycles themselves.
fn grows_with_the_sum(all: &[Measurement]) -> bool {
    let worn = |m: &Measurement| m.sum / m.count;
    if all.iter().any(|m| worn(m) <= 0.0) {
        return false;
    }
    let mut sum = 0.0;
    let rates = all.iter().map(|m| {
        sum += m.cycles;
        [worn(m) / m.cycles, worn(m) / sum].map(f64::ln)
    });
    let rates: Vec<[f64; 2]> = rates.collect();
    let [plain, added] = [0, 1].map(|i| {
        let of = || rates.iter().map(|rate| rate[i]);
        of().fold(f64::NEG_INFINITY, f64::max) - of().fold(f64::INFINITY, f64::min)
    });
    added < LEFT * plain
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is said of masses of one test of 400 000 cycles, by cycles in thousands.
    fn told(masses: &[(u32, f64)]) -> bool {
        let all: Vec<Measurement> = (masses.iter())
            .map(|&(thousands, sum)| Measurement {
                cycles: 1e3 * f64::from(thousands),
                trace: None,
                sum,
                count: 1.0,
            })
            .collect();
        are_increments(&all, 4e5)
    }

    #[test]
    fn cycles_since_the_last_measurement_add_up_to_the_test() {
        assert!(told(&[
            (40, 5.0),
            (60, 13.0),
            (100, 26.0),
            (100, 40.0),
            (100, 53.0)
        ]));
        assert!(told(&[(200, 26.0), (200, 53.0)]));
        assert!(told(&[(40, 5.0), (80, 15.0), (120, 31.0), (160, 53.0)]));
    }

    #[test]
    fn cycles_from_the_start_do_not() {
        assert!(!told(&[(40, 5.0), (100, 13.0), (200, 26.0), (400, 53.0)]));
        // a repetition half way; a quarter and three quarters; a sixth, a third and a half
        assert!(!told(&[(200, 26.0), (200, 26.5)]));
        assert!(!told(&[(100, 13.0), (300, 40.0)]));
        assert!(!told(&[(67, 9.0), (133, 18.0), (200, 26.0)]));
        assert!(!told(&[(400, 53.0)]));
        // a test that was stopped at 40 %, measured at every tenth
        assert!(!told(&[(40, 5.0), (80, 10.0), (120, 15.0), (160, 20.0)]));
    }
}
