//! Whether one quantity carries the misfit that a few of its rows make: then its stated σ is to be looked at before any physics.

use crate::learn::fitting::fitted::Fit;
use crate::measure::{Dataset, Observation, Place, Quantity};
use crate::study::{Role, Study};

/// Rows of a quantity from which it is looked at.
const LEAST: usize = 6;
/// χ² per point of its rows, and over that of the others, and its share of all misfit, from which it is said.
const LARGE: f64 = 9.0;
const OVER_OTHERS: f64 = 5.0;
const SHARE: f64 = 0.3;

/// The quantity that carries the misfit of a fit to its tests, in words; None if none does.
pub fn misfit_of_one_quantity(study: &Study, data: &Dataset, fit: &Fit) -> Option<String> {
    let rows = data.observations.iter().zip(&fit.rows);
    let rows = rows.filter(|(o, _)| study.tests[o.test].role == Role::Fit);
    carried_by(rows.map(|(o, row)| (o, row.standardised)), "")
}

/// The quantity that carries the misfit of the fit tests' rows, each with its standardised residual, in words; None if none does. `with`: what
/// stands in the model beside the study's own, in words.
pub(in crate::learn) fn carried_by<'d>(
    rows: impl Iterator<Item = (&'d Observation, f64)>,
    with: &str,
) -> Option<String> {
    let rows: Vec<(Quantity, f64)> = rows.map(|(o, z)| (o.quantity, z * z)).collect();
    let sum = |of: &dyn Fn(Quantity) -> bool| {
        let own = rows.iter().filter(|(quantity, _)| of(*quantity));
        own.fold((0, 0.0), |(count, square), row| (count + 1, square + row.1))
    };
    // along curves the scatter of neighbours tells whether sigma is too small (`checks::noise_level`)
    let whole = |quantity: &Quantity| quantity.place() == Place::Whole;
    Quantity::ALL.into_iter().filter(whole).find_map(|quantity| {
        let (count, square) = sum(&|q| q == quantity);
        let (others, rest) = sum(&|q| q != quantity);
        if count < LEAST || others < LEAST {
            return None;
        }
        let (own, other) = (square / count as f64, rest / others as f64);
        let share = square / (square + rest);
        (own > LARGE && own > OVER_OTHERS * other && share > SHARE).then(|| {
            format!(
                "{:.0} % of the misfit of the fit tests{with} is that of {count} rows of {} (χ² {own:.0} per point, the others {other:.1}): either their sigma is too small, or \
                 what is missing shows most in them. Look at that sigma first, of small values above all: a share of each value leaves them almost none",
                100.0 * share,
                quantity.name()
            )
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Subject;

    #[test]
    fn a_few_rows_that_carry_the_misfit_are_named() {
        let row = |quantity| Observation {
            test: 0,
            member: Subject::Pinion,
            cycles: 1e5,
            quantity,
            position: None,
            value: 1.0,
            sigma: 0.1,
            trace: None,
            face: None,
            tooth: None,
            line: 1,
        };
        let (mass, depth) = (row(Quantity::MassLoss), row(Quantity::WearDepth));
        let said = |mass_off: f64, depth_off: f64| {
            let masses = (0..8).map(|_| (&mass, mass_off));
            carried_by(
                masses.chain((0..400).map(|_| (&depth, depth_off))),
                " with tip_relief",
            )
        };
        assert!(
            said(9.0, 1.2).is_some_and(
                |s| s.contains("of the misfit of the fit tests with tip_relief is that of 8 rows of mass_loss (χ² 81 per point, the others 1.4)")
            )
        );
        // both are off alike, or hardly
        assert_eq!(said(9.0, 5.0), None);
        assert_eq!(said(2.5, 1.0), None);
        // transmission errors see what wears whole flanks more sharply than depths: that says nothing of their sigma
        let error = row(Quantity::TransmissionError);
        let errors = (0..72).map(|_| (&error, 6.0));
        let said = carried_by(errors.chain((0..400).map(|_| (&depth, 2.0))), "");
        assert_eq!(said, None);
    }
}
