//! Whether one quantity carries the misfit that a few of its rows make: then its stated σ is to be looked at before any physics.

use std::collections::BTreeMap;

use crate::learn::fitting::fitted::Fit;
use crate::measure::{Dataset, FacePlace, Observation, Quantity};
use crate::study::{Role, Study};

/// Rows of a quantity from which it is looked at.
const LEAST: usize = 6;
/// χ² per point of its rows, and over that of the others, and its share of all χ² beyond noise's own, from which it is said.
const LARGE: f64 = 6.5;
const OVER_OTHERS: f64 = 5.0;
const SHARE: f64 = 0.3;
/// Share of it that the scatter of neighbours must make up, where there are curves, for their sigma to be asked about.
const OF_SCATTER: f64 = 0.25;
/// Share of its χ² that one row, or two of many, may make: of one that is far off by itself the sigma of all others knows nothing.
const OF_SINGLE_ROWS: f64 = 0.8;
const MANY: usize = 50;

/// The quantity that carries the misfit of a fit to its tests, in words; None if none does.
pub fn misfit_of_one_quantity(study: &Study, data: &Dataset, fit: &Fit) -> Option<String> {
    let rows = data.observations.iter().zip(&fit.rows);
    let rows = rows.filter(|(o, _)| study.tests[o.test].role == Role::Fit);
    carried_by(rows.map(|(o, row)| (o, row.standardised)), "", "")
}

/// The quantity that carries the misfit of the fit tests' rows, each with its standardised residual, in words; None if none does. `with`: what
/// stands in the model beside the study's own, in words; `or`: another reason that there may be, in words.
pub(in crate::learn) fn carried_by<'d>(
    rows: impl Iterator<Item = (&'d Observation, f64)>,
    with: &str,
    or: &str,
) -> Option<String> {
    let observations: Vec<(&Observation, f64)> = rows.collect();
    let rows: Vec<(Quantity, f64)> = (observations.iter())
        .map(|(o, z)| (o.quantity, z * z))
        .collect();
    let sum = |of: &dyn Fn(Quantity) -> bool| {
        let own = rows.iter().filter(|(quantity, _)| of(*quantity));
        own.fold((0, 0.0), |(count, square), row| (count + 1, square + row.1))
    };
    let scatter = |quantity| neighbour_scatter(&observations, quantity);
    Quantity::ALL.into_iter().find_map(|quantity| {
        let (count, square) = sum(&|q| q == quantity);
        let (others, rest) = sum(&|q| q != quantity);
        if count < LEAST || others < LEAST {
            return None;
        }
        let own = rows.iter().filter(|(q, _)| *q == quantity);
        let mut squares: Vec<f64> = own.map(|row| row.1).collect();
        squares.sort_by(|a, b| b.total_cmp(a));
        let single = if count < MANY { 1 } else { 2 };
        if squares[..single].iter().sum::<f64>() > OF_SINGLE_ROWS * square {
            return None;
        }
        let (own, other) = (square / count as f64, rest / others as f64);
        let beyond = |square: f64, count: usize| (square - count as f64).max(0.0);
        let share = beyond(square, count) / (beyond(square, count) + beyond(rest, others));
        let carried = own > LARGE && own > OVER_OTHERS * other && share > SHARE;
        // along curves neighbours tell: what their scatter is not, a larger sigma would but hide
        let by_sigma = |scatter: f64| scatter > OF_SCATTER * own;
        (carried && scatter(quantity).is_none_or(by_sigma)).then(|| {
            format!(
                "{:.0} % of the misfit beyond noise of the fit tests{with} is that of {count} rows of {} (χ² {own:.0} per point, the others {other:.1}): either \
                 these values are wrong, or their sigma is too small, or the missing effect shows most in them{or}. Look at the values and their sigma first; a sigma stated as a \
                 share of the value is too small where the value is small",
                100.0 * share,
                quantity.name()
            )
        })
    })
}

/// χ² per point that the scatter of neighbours along the curves of a quantity makes: Σ (z_{i−1} − 2 z_i + z_{i+1})²/6 over their number, 1 where sigma is right;
/// None where there are few.
fn neighbour_scatter(rows: &[(&Observation, f64)], quantity: Quantity) -> Option<f64> {
    let mut curves: BTreeMap<_, Vec<(f64, f64)>> = BTreeMap::new();
    for (o, z) in rows.iter().filter(|(o, _)| o.quantity == quantity) {
        let Some(place) = o.position else { continue };
        let face = o.face.map(FacePlace::key);
        let key = (
            o.test,
            o.member,
            o.cycles.to_bits(),
            o.trace,
            face,
            &o.tooth,
        );
        curves.entry(key).or_default().push((place, *z));
    }
    let (mut count, mut square) = (0, 0.0);
    for curve in curves.values_mut() {
        curve.sort_by(|a, b| a.0.total_cmp(&b.0));
        for three in curve.windows(3) {
            count += 1;
            square += (three[0].1 - 2.0 * three[1].1 + three[2].1).powi(2) / 6.0;
        }
    }
    (count >= LEAST).then(|| square / f64::from(count as u32))
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
                "",
            )
        };
        assert!(
            said(9.0, 1.2).is_some_and(
                |s| s.contains("of the misfit beyond noise of the fit tests with tip_relief is that of 8 rows of mass_loss (χ² 81 per point, the others 1.4)")
            )
        );
        // a third of the right sigma, of a few rows among very many
        assert!(said(3.0, 1.0).is_some());
        // both are off alike, or hardly
        assert_eq!(said(9.0, 5.0), None);
        assert_eq!(said(2.5, 1.0), None);
        // one row makes it all
        let typo = (0..8).map(|i| (&mass, if i == 3 { 60.0 } else { 1.0 }));
        let depths = (0..400).map(|_| (&depth, 1.2));
        assert_eq!(carried_by(typo.chain(depths), "", ""), None);
        // or two of many
        let masses = || (0..8).map(|_| (&mass, 1.2));
        let off = |typos: usize| (0..400).map(move |i| if i < typos { 300.0 } else { 1.0 });
        let depths = |typos| off(typos).map(|z| (&depth, z));
        assert_eq!(carried_by(masses().chain(depths(2)), "", ""), None);
        assert!(carried_by(masses().chain(depths(20)), "", "").is_some());
        // transmission errors see what wears whole flanks more sharply than depths: that says nothing of their sigma
        let errors: Vec<Observation> = (0..72)
            .map(|i| Observation {
                position: Some(0.01 * f64::from(i)),
                ..row(Quantity::TransmissionError)
            })
            .collect();
        let said = |off: &dyn Fn(usize) -> f64| {
            let errors = errors.iter().enumerate().map(|(i, error)| (error, off(i)));
            carried_by(errors.chain((0..400).map(|_| (&depth, 2.0))), "", "")
        };
        assert_eq!(said(&|i| 6.0 + 0.02 * i as f64), None);
        // neighbours that scatter so do call for another sigma
        let scattered = said(&|i| if i % 2 == 0 { 6.0 } else { -6.0 });
        assert!(scattered.is_some_and(|s| s.contains("72 rows of transmission_error")));
    }
}
