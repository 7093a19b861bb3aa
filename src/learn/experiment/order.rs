//! In which order feasible tests are told, and which are not told at all.

use super::candidate_tests::{NextTest, ranked};
use super::made_tests::MadeTest;
use super::plan::RankedTest;
use crate::measure::Quantity;

/// Expected χ² from which a test settles what it is made for: with a standard deviation of 2√χ², it comes out below what favours one clearly (6) in
/// one of 500 such tests.
pub const SETTLES: f64 = 45.0;
/// Relative difference of χ² up to which two tests show the same.
const SAME: f64 = 1e-6;

/// The rows in the order in which they are told.
///
/// What was measured already (or nearly) is no new test. Of those that settle it the cheapest stands first: without an instrument
/// that may not be there, then fewer hours on the rig, then fewer changes, then what takes less measuring. Then the others by what they separate, of near-equals those of fewer hours, then of fewer
/// changes. What does not feel speed or temperature is told at one: of near-equals at the one that costs least.
pub(super) fn in_order(rows: Vec<RankedTest>, made: &[MadeTest]) -> Vec<RankedTest> {
    let is_made = |row: &RankedTest| {
        (made.iter()).any(|made| made.has(&row.quantity) && made.is_repeated_by(&row.test))
    };
    let (again, mut new): (Vec<RankedTest>, Vec<RankedTest>) = rows.into_iter().partition(is_made);
    // a made test at a temperature that its measurements do not feel is that test once more
    let is_again = |row: &RankedTest| {
        let same_speed = |other: &&RankedTest| other.test.speed == row.test.speed;
        again
            .iter()
            .filter(same_speed)
            .any(|other| shows_the_same(other, row))
    };
    new.retain(|row| !is_again(row));
    let (mut enough, rest): (Vec<_>, Vec<_>) = new.into_iter().partition(settles);
    enough.sort_by(|a, b| {
        let instrument = needs_another_instrument(a, made).cmp(&needs_another_instrument(b, made));
        let hours = a.test.hours().total_cmp(&b.test.hours());
        let first = instrument.then(hours);
        first.then_with(|| (a.changes, effort(a)).cmp(&(b.changes, effort(b))))
    });
    let cost = |row: &RankedTest| (row.test.hours(), row.changes);
    let scores: Vec<_> = (rest.iter().map(|r| (r.expected_chi2, cost(r)))).collect();
    let rest = ranked(&scores).into_iter().map(|i| rest[i].clone());
    let mut told: Vec<RankedTest> = Vec::new();
    for row in enough.into_iter().chain(rest) {
        if !told.iter().any(|other| shows_the_same(other, &row)) {
            told.push(row);
        }
    }
    told
}

/// Whether a test tells the leader from each of its rivals.
pub(super) fn settles(row: &RankedTest) -> bool {
    row.expected_chi2 >= SETTLES && row.separates.iter().all(|pair| pair.chi2 >= SETTLES)
}

/// Whether the quantity takes more than a balance and was in no test so far.
fn needs_another_instrument(row: &RankedTest, made: &[MadeTest]) -> bool {
    let is_new = !made.is_empty() && !made.iter().any(|made| made.has(&row.quantity));
    is_new && row.quantity != Quantity::MassLoss.name()
}

/// What a quantity takes to measure: a balance, a run on the rig, traces along flanks.
fn effort(row: &RankedTest) -> usize {
    let all = [
        Quantity::MassLoss,
        Quantity::TransmissionError,
        Quantity::WearDepth,
    ];
    let place = all
        .iter()
        .position(|quantity| quantity.name() == row.quantity);
    place.unwrap_or(all.len())
}

/// Whether two tests show the same at two speeds or temperatures: what is measured does not feel these.
fn shows_the_same(a: &RankedTest, b: &RankedTest) -> bool {
    let without = |test: &RankedTest| NextTest {
        speed: 0.0,
        bulk_temperature: None,
        ..test.test.clone()
    };
    let mut chi2 = a.separates.iter().zip(&b.separates);
    a.quantity == b.quantity
        && without(a) == without(b)
        && chi2.all(|(a, b)| (a.chi2 - b.chi2).abs() <= SAME * a.chi2.abs())
}

#[cfg(test)]
mod tests {
    use super::super::candidate_tests::shown;
    use super::super::candidate_tests::tests::plain;
    use super::*;

    fn row(torque: f64, cycles: f64, quantity: &str, changes: usize, chi2: f64) -> RankedTest {
        RankedTest {
            test: NextTest {
                torque,
                cycles,
                ..shown(&plain())
            },
            quantity: quantity.to_owned(),
            changes,
            expected_chi2: chi2,
            separates: Vec::new(),
            why: String::new(),
        }
    }

    /// Of tests that all separate more than enough the first is the cheapest.
    #[test]
    fn the_cheapest_that_settles_it_stands_first() {
        let rows = vec![
            row(100.0, 3e6, "mass_loss", 1, 60.0),
            row(50.0, 1e6, "wear_depth", 1, 60.0),
            row(200.0, 1e6, "mass_loss", 1, 60.0),
            row(100.0, 1e6, "transmission_error", 0, 40.0),
        ];
        let told = in_order(rows, &[]);
        let order: Vec<f64> = told.iter().map(|r| r.test.torque).collect();
        assert_eq!(order, [200.0, 50.0, 100.0, 100.0]);
        assert_eq!(told[3].quantity, "transmission_error");
    }

    /// A test bench for transmission errors may not be there; a balance is.
    #[test]
    fn what_was_measured_before_stands_before_what_needs_another_instrument() {
        let made = MadeTest {
            test: row(100.0, 1e6, "wear_depth", 0, 0.0).test,
            quantities: vec![Quantity::WearDepth],
        };
        let rows = vec![
            row(100.0, 1e5, "transmission_error", 0, 60.0),
            row(200.0, 3e6, "wear_depth", 1, 60.0),
            row(200.0, 4e6, "mass_loss", 1, 60.0),
        ];
        let told = in_order(rows, &[made]);
        let order: Vec<&str> = told.iter().map(|r| r.quantity.as_str()).collect();
        assert_eq!(order, ["wear_depth", "mass_loss", "transmission_error"]);
    }

    /// What a rig costs is its hours: as many revolutions at a higher speed are cheaper.
    #[test]
    fn of_tests_that_say_as_much_the_one_of_fewer_hours_stands_first() {
        let at = |speed: f64, changes: usize, chi2: f64| {
            let mut row = row(100.0, 1e6, "wear_depth", changes, chi2);
            row.test.speed = speed;
            // what is measured feels the speed
            row.separates = vec![crate::learn::experiment::plan::Separated {
                pair: ["a".to_owned(), "b".to_owned()],
                chi2: chi2 + 1e-3 * speed,
            }];
            row
        };
        let order = |rows: Vec<RankedTest>| -> Vec<f64> {
            let told = in_order(rows, &[]);
            told.iter().map(|r| r.test.speed).collect()
        };
        // more than enough
        let rows = vec![at(600.0, 1, 60.0), at(2000.0, 1, 60.0), at(6000.0, 2, 60.0)];
        assert_eq!(order(rows), [6000.0, 2000.0, 600.0]);
        // nearly as much, and clearly less
        let rows = vec![at(600.0, 1, 20.0), at(6000.0, 1, 17.0), at(9000.0, 1, 10.0)];
        assert_eq!(order(rows), [6000.0, 600.0, 9000.0]);
    }

    /// A test that settles it in a quarter of the hours stands before one that settles it by more.
    #[test]
    fn more_than_what_settles_it_is_not_worth_hours() {
        let rows = || {
            vec![
                row(100.0, 4e6, "wear_depth", 1, 60.0),
                row(100.0, 1e6, "wear_depth", 1, 46.0),
                row(100.0, 5e5, "wear_depth", 1, 20.0),
            ]
        };
        let order = |rows| -> Vec<f64> {
            let told = in_order(rows, &[]);
            told.iter().map(|r| r.expected_chi2).collect()
        };
        assert_eq!(order(rows()), [46.0, 60.0, 20.0]);
        // one rival stays
        let mut other = rows();
        other[1].separates = [60.0, 32.0]
            .map(|chi2| crate::learn::experiment::plan::Separated {
                pair: ["a".to_owned(), "b".to_owned()],
                chi2,
            })
            .to_vec();
        assert_eq!(order(other), [60.0, 46.0, 20.0]);
    }

    /// Another temperature is another test only where what is measured feels it.
    #[test]
    fn a_temperature_that_nothing_feels_is_no_new_test() {
        let warm = |celsius: f64, chi2: f64| {
            let mut row = row(100.0, 1e6, "wear_depth", 1, chi2);
            row.test.bulk_temperature = Some(celsius);
            row.separates = vec![crate::learn::experiment::plan::Separated {
                pair: ["a".to_owned(), "b".to_owned()],
                chi2,
            }];
            row
        };
        let made = || MadeTest {
            test: warm(60.0, 0.0).test,
            quantities: vec![Quantity::WearDepth],
        };
        let felt = vec![warm(60.0, 20.0), warm(40.0, 20.0), warm(80.0, 31.0)];
        let told = in_order(felt, &[made()]);
        let at: Vec<Option<f64>> = told.iter().map(|r| r.test.bulk_temperature).collect();
        assert_eq!(at, [Some(80.0)]);
    }

    /// What was measured at (nearly) these conditions is not proposed again, what was not measured there is.
    #[test]
    fn a_test_that_was_made_is_no_new_one() {
        let made = MadeTest {
            test: NextTest {
                torque: 102.0,
                ..shown(&plain())
            },
            quantities: vec![Quantity::WearDepth],
        };
        let rows = vec![
            row(100.0, 1e6, "wear_depth", 0, 60.0),
            row(100.0, 1e6, "mass_loss", 0, 50.0),
            row(50.0, 1e6, "wear_depth", 1, 45.0),
        ];
        let told = in_order(rows, &[made]);
        let order: Vec<(f64, &str)> = (told.iter())
            .map(|r| (r.test.torque, r.quantity.as_str()))
            .collect();
        assert_eq!(order, [(100.0, "mass_loss"), (50.0, "wear_depth")]);
    }
}
