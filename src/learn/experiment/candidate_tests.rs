//! Tests that could be made: the study's operation with torque, speed, misalignment, bulk temperature, length or drive direction changed.

use std::cmp::Ordering;

use serde::{Deserialize, Serialize, Serializer};

use crate::numeric::written::{count, significant};
use crate::study::{Operation, Rig, Study};

/// Conditions of a test, in the study's units.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NextTest {
    /// N·m.
    pub torque: f64,
    /// rpm.
    pub speed: f64,
    /// mm.
    pub misalignment: f64,
    /// Pinion revolutions.
    pub cycles: f64,
    /// Whether the drive direction is the other one.
    pub reversed: bool,
    /// °C; None where the study states none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bulk_temperature: Option<f64>,
}

impl NextTest {
    /// Hours on the rig: what a test costs.
    pub fn hours(&self) -> f64 {
        self.cycles / (60.0 * self.speed)
    }
}

/// A test in a document, with its hours.
pub(super) fn with_hours<S: Serializer>(test: &NextTest, to: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct WithHours<'t> {
        #[serde(flatten)]
        test: &'t NextTest,
        hours: f64,
    }
    let hours = test.hours();
    WithHours { test, hours }.serialize(to)
}

/// Factors on torque and speed, misalignments (mm) and temperatures (K) added, factor on the length.
const TORQUES: [f64; 3] = [1.0, 0.5, 2.0];
const SPEEDS: [f64; 3] = [1.0, 0.3, 3.0];
const MISALIGNMENTS: [f64; 3] = [0.0, 0.3, 0.6];
const TEMPERATURES: [f64; 2] = [-20.0, 20.0];
const LONGER: f64 = 3.0;
/// Factor of torque, speed or length, misalignment (mm) and temperature (K) from which two tests are not the same.
const ANOTHER: f64 = 1.2;
const OTHER_PLACE: f64 = 0.1;
const WARMER: f64 = 5.0;
/// A simpler test is preferred to one that gives up to this much more.
pub(in crate::learn) const NEARLY: f64 = 0.8;
/// Expected χ² from which more is of no use: the two are then told apart for certain. A mean counts no pair higher.
pub const ENOUGH: f64 = 60.0;
/// Expected χ² from which two are told apart.
pub(in crate::learn) const APART: f64 = 20.0;
/// Expected χ² from which one of two is clearly favoured.
pub(in crate::learn) const CLEAR: f64 = 6.0;

/// Largest χ² of a first campaign that is written as a figure: of what is made up nothing is known to more than this.
const MOST_TOLD: f64 = 1000.0;

/// χ² of an effect of the catalogue; of huge ones nobody asks how huge.
pub fn made_up_chi2(chi2: f64, digits: usize) -> String {
    if chi2 > MOST_TOLD {
        format!("> {MOST_TOLD}")
    } else {
        significant(chi2, digits)
    }
}

/// Feasible tests with their number of changes against `plain`, the plainest first; at other temperatures where it states one. What the rig
/// cannot run is replaced by the nearest that it can, where that still differs enough from the tests before it.
fn grid(plain: &Operation, rig: &Rig) -> Vec<(usize, Operation)> {
    let mut all = Vec::new();
    for (t, torque) in TORQUES.into_iter().enumerate() {
        for (s, speed) in SPEEDS.into_iter().enumerate() {
            for (m, misalignment) in MISALIGNMENTS.into_iter().enumerate() {
                let changes = [t, s, m].into_iter().filter(|i| *i > 0).count();
                if changes > 2 {
                    continue;
                }
                let operation = Operation {
                    torque_nmm: plain.torque_nmm * torque,
                    speed_rpm: plain.speed_rpm * speed,
                    misalignment_mm: plain.misalignment_mm + misalignment,
                    ..*plain
                };
                all.push((changes, operation));
            }
        }
    }
    let longer = Operation {
        cycles: LONGER * plain.cycles,
        ..*plain
    };
    all.push((1, longer));
    if rig.reversible {
        let reversed = Operation {
            reversed: !plain.reversed,
            ..*plain
        };
        all.push((1, reversed));
    }
    let stated = plain.stated_temperature_c().into_iter();
    let others = stated.flat_map(|celsius| TEMPERATURES.map(|more| celsius + more));
    all.extend(others.map(|celsius| (1, plain.at_temperature(celsius))));
    all.sort_by_key(|(changes, _)| *changes);
    let mut run: Vec<(usize, Operation)> = Vec::with_capacity(all.len());
    for (changes, wanted) in all {
        let own = rig.nearest(&wanted);
        if run.iter().all(|(_, before)| is_another(&own, before)) {
            run.push((changes, own));
        }
    }
    run
}

/// Whether two conditions differ by enough to make both of use.
fn is_another(a: &Operation, b: &Operation) -> bool {
    let apart = |a: f64, b: f64| a.max(b) >= ANOTHER * a.min(b);
    let celsius = [a, b].map(|o| o.stated_temperature_c().unwrap_or(0.0));
    apart(a.torque_nmm, b.torque_nmm)
        || apart(a.speed_rpm, b.speed_rpm)
        || apart(a.cycles, b.cycles)
        || (a.misalignment_mm - b.misalignment_mm).abs() >= OTHER_PLACE
        || (celsius[0] - celsius[1]).abs() >= WARMER
        || a.reversed != b.reversed
}

/// The tests of the grid that the study's rig can run, at whose temperature its tables say something.
pub(in crate::learn) fn feasible(study: &Study, plain: &Operation) -> Vec<(usize, Operation)> {
    let holds = |(_, operation): &(usize, Operation)| {
        let celsius = operation.stated_temperature_c();
        celsius.is_none_or(|celsius| study.holds_temperature(celsius))
    };
    grid(plain, &study.rig).into_iter().filter(holds).collect()
}

/// The order of scores, the largest first; among those nearly as large as the largest left, the one of the least cost first: its number of
/// changes or its hours on the rig, or one of these and then the other.
pub(in crate::learn) fn ranked<C: PartialOrd>(scores: &[(f64, C)]) -> Vec<usize> {
    let mut left: Vec<usize> = (0..scores.len()).collect();
    left.sort_by(|&a, &b| scores[b].0.total_cmp(&scores[a].0).then(a.cmp(&b)));
    let mut order = Vec::with_capacity(left.len());
    while let Some(&best) = left.first() {
        let bar = NEARLY * scores[best].0;
        let near = left
            .iter()
            .enumerate()
            .filter(|(_, i)| scores[**i].0 >= bar);
        let place = near.min_by(|(_, a), (_, b)| {
            let costs = scores[**a].1.partial_cmp(&scores[**b].1);
            costs.unwrap_or(Ordering::Equal)
        });
        order.push(left.remove(place.map_or(0, |(place, _)| place)));
    }
    order
}

/// An operation in the study's units.
pub(in crate::learn) fn shown(operation: &Operation) -> NextTest {
    NextTest {
        torque: 1e-3 * operation.torque_nmm,
        speed: operation.speed_rpm,
        misalignment: operation.misalignment_mm,
        cycles: operation.cycles,
        reversed: operation.reversed,
        bulk_temperature: operation.stated_temperature_c(),
    }
}

/// What a test changes against `plain`, in words; the cycles only where nothing else differs.
pub(in crate::learn) fn changes(test: &NextTest, plain: &Operation) -> String {
    let mut changed = Vec::new();
    if differs(test.torque, 1e-3 * plain.torque_nmm) {
        changed.push(format!("{} N·m", test.torque));
    }
    if differs(test.speed, plain.speed_rpm) {
        changed.push(format!("{} rpm", test.speed));
    }
    if differs(test.misalignment, plain.misalignment_mm) {
        changed.push(format!("misalignment {} mm", test.misalignment));
    }
    if let Some(celsius) = other_temperature(test, plain) {
        changed.push(format!("{celsius} °C"));
    }
    if test.reversed != plain.reversed {
        changed.push("the drive reversed".to_owned());
    }
    if changed.is_empty() {
        changed.push(format!(
            "{} cycles at the study's operation",
            count(test.cycles)
        ));
    }
    changed.join(", ")
}

/// A test's time on the rig, in words.
pub(in crate::learn) fn duration(test: &NextTest) -> String {
    format!("{} h", significant(test.hours(), 3))
}

/// What a test's changes do, in plain words.
pub(in crate::learn) fn purpose(test: &NextTest, plain: &Operation) -> String {
    let mut says = Vec::new();
    if differs(test.torque, 1e-3 * plain.torque_nmm) {
        says.push("another pressure at the same sliding");
    }
    if differs(test.speed, plain.speed_rpm) {
        says.push(if test.speed > plain.speed_rpm {
            "another sliding speed, and with it temperature and any oil film, at the same pressure, and fewer hours for as many revolutions"
        } else {
            "another sliding speed, and with it temperature and any oil film, at the same pressure"
        });
    }
    if differs(test.misalignment, plain.misalignment_mm) {
        says.push("the contact moved along both flanks");
    }
    if other_temperature(test, plain).is_some() {
        says.push("another temperature of teeth and housing at the same load and speed, the viscosity as stated");
    }
    if test.reversed != plain.reversed {
        says.push("the other flanks, which are still new");
    }
    if differs(test.cycles, plain.cycles) && test.cycles > plain.cycles {
        says.push("later in life, when what runs in or sets in shows");
    }
    if says.is_empty() {
        says.push("the plainest test");
    }
    says.join("; ")
}

/// How much an expected χ² is.
pub(in crate::learn) fn strength(chi2: f64) -> &'static str {
    if chi2 >= APART {
        "enough to tell them apart"
    } else if chi2 >= CLEAR {
        "enough to favour one clearly"
    } else {
        "still little: other measurements are needed"
    }
}

/// The temperature of a test where it is not that of `plain`.
fn other_temperature(test: &NextTest, plain: &Operation) -> Option<f64> {
    let stated = plain.stated_temperature_c();
    test.bulk_temperature
        .filter(|celsius| stated.is_none_or(|plain| differs(*celsius, plain)))
}

fn differs(a: f64, b: f64) -> bool {
    (a - b).abs() > 1e-6 * b.abs().max(1e-6)
}

#[cfg(test)]
pub(in crate::learn) mod tests {
    use super::*;

    /// A study's operation.
    pub(in crate::learn) fn plain() -> Operation {
        Operation::at(100.0, 2000.0)
    }

    #[test]
    fn the_grid_starts_plain_and_changes_two_things_at_most() {
        let grid = grid(&plain(), &Rig::default());
        assert_eq!(grid[0], (0, plain()));
        // 27 − 8 with three changes, and a longer and a reversed test
        assert_eq!(grid.len(), 27 - 8 + 2);
        assert!(grid.windows(2).all(|w| w[0].0 <= w[1].0));
        assert!(grid.iter().any(|(_, o)| o.reversed));
    }

    #[test]
    fn other_temperatures_are_feasible_where_one_is_stated() {
        let warm = plain().at_temperature(60.0);
        let grid = grid(&warm, &Rig::default());
        assert_eq!(grid.len(), 27 - 8 + 2 + 2);
        let at = |celsius: f64| {
            let found = grid
                .iter()
                .find(|(_, o)| o.bulk_temperature_c == Some(celsius));
            let (count, operation) = found.unwrap();
            assert_eq!((*count, operation.flank_temperature_c), (1, Some(celsius)));
            shown(operation)
        };
        let (cold, hot) = (at(40.0), at(80.0));
        assert_eq!(cold.bulk_temperature, Some(40.0));
        assert_eq!(changes(&hot, &warm), "80 °C");
        assert!(purpose(&hot, &warm).starts_with("another temperature of teeth and housing"));
        // one that friction losses make is no condition that somebody sets
        let computed = Operation {
            flank_temperature_c: Some(71.0),
            ..warm
        };
        assert_eq!(shown(&computed).bulk_temperature, None);
        assert_eq!(super::grid(&computed, &Rig::default()).len(), 21);
    }

    /// A rig to 120 N m, from 1500 rpm, of fixed centre distance and one drive direction, a shift long.
    #[test]
    fn a_rig_runs_what_it_can_and_the_nearest_to_what_it_cannot() {
        let rig = Rig {
            torque_nmm: [20e3, 120e3],
            speed_rpm: [1500.0, 6000.0],
            misalignment_mm: 0.0,
            hours: 8.0,
            reversible: false,
            ..Rig::default()
        };
        let grid = grid(&plain(), &rig);
        for (_, o) in &grid {
            assert!((20e3..=120e3).contains(&o.torque_nmm) && o.speed_rpm >= 1500.0);
            assert!(o.misalignment_mm == 0.0 && !o.reversed);
            assert!(shown(o).hours() <= 8.0 + 1e-9, "{o:?}");
        }
        // a shift at 2000 rpm: 60 · 2000 · 8
        assert_eq!(grid[0].1.cycles, 960e3);
        // 100, 50 and 120 N m by 2000, 1500 and 6000 rpm; a longer test would take 25 h
        assert_eq!(grid.len(), 9);
        // what cannot be changed at all leaves the study's own test, at its own length
        let fixed = Rig {
            torque_nmm: [100e3; 2],
            speed_rpm: [2000.0; 2],
            hours: 9.0,
            ..rig
        };
        assert_eq!(super::grid(&plain(), &fixed), [(0, plain())]);
    }

    #[test]
    fn a_plainer_test_goes_before_one_that_is_hardly_better() {
        // 10 and 9 are near-equals, 7 is not; after 9 (plain) comes 10, then 7
        assert_eq!(ranked(&[(7.0, 0), (10.0, 2), (9.0, 1)]), [2, 1, 0]);
        // without near-equals the larger goes first
        assert_eq!(ranked(&[(1.0, 0), (10.0, 2), (5.0, 1)]), [1, 2, 0]);
        // as plain, but shorter on the rig
        let costs = [(10.0, (1, 80.0)), (9.0, (1, 8.0)), (9.5, (2, 1.0))];
        assert_eq!(ranked(&costs), [1, 0, 2]);
    }

    #[test]
    fn a_fast_test_takes_fewer_hours() {
        let slow = shown(&plain());
        let fast = NextTest {
            speed: 3.0 * slow.speed,
            ..slow.clone()
        };
        assert_eq!(duration(&slow), "8.33 h");
        assert_eq!(duration(&fast), "2.78 h");
    }

    #[test]
    fn words_name_what_differs() {
        let test = NextTest {
            torque: 50.0,
            ..shown(&plain())
        };
        assert_eq!(changes(&test, &plain()), "50 N·m");
        assert!(purpose(&test, &plain()).contains("pressure"));
        assert!(purpose(&shown(&plain()), &plain()).contains("plainest"));
    }
}
