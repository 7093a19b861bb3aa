//! What is wrong with measurements as a whole before any physics: signs, units, zeros. A line each, with what to do.
//!
//! ```text
//! y ≈ s·f per quantity and member        f the fitted model, each trace's datum removed, least squares weighted by 1/σ²
//! s < 0: the sign is the other one;  s_depth/s_mass far from 1: two units;  k outside [1e-13, 1e-5] mm²/N: a unit or a count
//! ```
//! s does not depend on the k that the fit came to: wear is proportional to k, so a quotient of two s is that of the quantities.

mod coefficient;
mod common_tilt;
mod constants;
mod copied_curves;
mod copied_rows;
mod cut_at_zero;
mod cycle_units;
mod decimal_slips;
mod depths_and_masses;
mod exchanged_curves;
mod exchanged_depths;
mod exchanged_masses;
mod exchanged_shapes;
mod exchanged_tests;
mod falling;
mod falling_shapes;
mod flank_curves;
mod gear_revolutions;
mod gross_errors;
mod increments;
mod mass_balance;
mod mass_over_depth;
mod masses_of_one_tooth;
mod masses_without_wear;
mod materials;
mod moved_places;
mod moved_rotation;
mod negated;
mod no_wear;
mod odd_beside_mate;
mod odd_curves;
mod odd_weighings;
mod one_series;
mod other_units;
mod reversed;
mod same_moments;
mod sigmas;
mod signs;
mod since_the_last;
mod single_tests;
mod standing_apart;
mod unworn_members;

use std::collections::BTreeMap;

pub use self::cycle_units::cycles_in_another_unit;
use super::residual_statistics::{FittedRow, fitted};
use crate::learn::fitting::fitted::{Fit, RowFit};
use crate::measure::{Dataset, Observation, Quantity, Subject};
use crate::study::Study;

/// Share of what is measured that `s·f` must explain for a sign or a unit to be told.
const EXPLAINS: f64 = 0.5;
/// Factor between two quantities from which it is no law that the model lacks.
const FACTOR: f64 = 2.5;
/// How far from a known factor it is told by name.
const NEAR: f64 = 0.25;
/// Ratio of the numbers of teeth from which a test that is off by it is told from one that scatters, and from which it is where nothing else is wrong.
const CLEAR_RATIO: f64 = 1.5;
const LOW_RATIO: f64 = 1.2;
/// Deviation up to which two counts of cycles are the same.
const SAME_CYCLES: f64 = 0.005;

/// What the measurements show by themselves, without any model, the worst first.
pub(super) fn sanity_of_data(study: &Study, data: &Dataset) -> Vec<String> {
    let of_zeros = cut_at_zero::cut_at_zero(data).into_iter();
    of_zeros.chain(by_themselves(study, data)).collect()
}

/// The same but for depths of exactly 0, which in a computed table are right and hide nothing else.
fn by_themselves(study: &Study, data: &Dataset) -> Vec<String> {
    // all else would follow from it
    if let Some(other) = cycles_in_another_unit(study, data) {
        return vec![other];
    }
    if let Some(gross) = gross_errors::gross_errors(data) {
        return vec![gross];
    }
    if let Some(copied) = copied_curves::copied_curves(study, data) {
        return vec![copied];
    }
    if let Some(copied) = copied_rows::copied_rows(study, data) {
        return vec![copied];
    }
    if let Some(increments) = increments::increments(study, data) {
        return vec![increments];
    }
    if let Some(unit) = sigmas::values_of_another_unit(data) {
        return vec![unit];
    }
    if let Some(own) = gear_revolutions::gear_revolutions(study, data) {
        return vec![own];
    }
    let slips = decimal_slips::decimal_slips(study, data);
    if !slips.is_empty() {
        return slips;
    }
    if let Some(odd) = odd_weighings::odd_weighing(study, data) {
        return vec![odd];
    }
    let mut said = falling_shapes::falling_shapes(study, data);
    said.extend(single_tests::short_of_their_cycles(study, data));
    said
}

/// All that there is to say, the worst first.
pub(in crate::learn) fn sanity(study: &Study, data: &Dataset, fit: &Fit) -> Vec<String> {
    let of_zeros = cut_at_zero::cut_at_zero(data).into_iter();
    of_zeros.chain(beside_zeros(study, data, fit)).collect()
}

/// The same but for depths of exactly 0.
fn beside_zeros(study: &Study, data: &Dataset, fit: &Fit) -> Vec<String> {
    let by_themselves = by_themselves(study, data);
    if !by_themselves.is_empty() {
        return by_themselves;
    }
    let of_one_k = of_one_k(data, fit);
    let judged = |(o, _): &FittedRow<'_>| fit.judges(o.test);
    let rows: Vec<FittedRow<'_>> = (data.observations.iter().zip(&of_one_k))
        .filter(judged)
        .collect();
    let unworn = unworn_members::unworn_members(study, &rows);
    if !unworn.is_empty() {
        return unworn;
    }
    if let Some(nothing) = no_wear::no_wear(study, &rows) {
        return vec![nothing];
    }
    // half a pitch off it may look turned
    if let Some(moved) = moved_rotation::moved_rotation(study, &rows) {
        return vec![moved];
    }
    let mut said = signs::signs(study, &rows);
    let mut values_asked = false;
    if said.is_empty() {
        said.extend(one_series::one_series(study, &rows));
        values_asked = !said.is_empty();
    }
    // the wear of a test with such a curve is another one, of which tests and torques would be blamed
    if said.is_empty() {
        said.extend(reversed::one_member_reversed(study, &rows));
    }
    if said.is_empty() {
        let k = fit.coefficient;
        // exchanged masses are at odds with the depths of both members
        said.extend(exchanged_masses::exchanged_masses(study, &rows));
        if said.is_empty() {
            let by_shape = || exchanged_shapes::exchanged_shapes(study, &rows);
            said.extend(exchanged_depths::exchanged_depths(study, &rows).or_else(by_shape));
            said.extend(exchanged_curves::exchanged_curves(study, &rows));
        }
        if said.is_empty() {
            said.extend(same_moments::increments(study, &rows));
        }
        if said.is_empty() {
            said.extend(since_the_last::since_the_last(study, &rows));
        }
        if said.is_empty() {
            said.extend(odd_curves::odd_curve(study, &rows));
        }
        if said.is_empty() {
            let of_tests = single_tests::depths_and_masses_of_tests(study, &rows, k);
            let of_all = || {
                let found = depths_and_masses::depths_and_masses(study, &rows, k);
                found.into_iter().collect()
            };
            said.extend(of_tests.unwrap_or_else(of_all));
            values_asked = !said.is_empty();
        }
        if said.is_empty() {
            said.extend(masses_without_wear::masses_without_wear(study, &rows));
            values_asked = !said.is_empty();
        }
        if said.is_empty() {
            said.extend(masses_of_one_tooth::masses_of_one_tooth(study, &rows, k));
        }
        if said.is_empty() {
            said.extend(mass_over_depth::mass_over_depth(study, &rows));
            values_asked = !said.is_empty();
        }
        if said.is_empty() {
            said.extend(mass_balance::masses_and_depths(study, data));
        }
        said.extend(other_units::other_units(study, &rows));
        said.extend(coefficient::coefficient(fit.coefficient));
        if said.is_empty() {
            said.extend(coefficient::far_from_stated(
                fit.coefficient,
                study.wear.coefficient,
            ));
        }
        // the surer a question, the earlier
        if said.is_empty() {
            said.extend(single_tests::rotation_of_some_tests(study, &rows));
        }
        if said.is_empty() {
            said.extend(exchanged_tests::exchanged_tests(study, data, fit));
        }
        if said.is_empty() {
            said.extend(single_tests::of_the_other_member(
                study,
                data,
                fit,
                CLEAR_RATIO,
            ));
            // a test's own k follows what its transmission error asks for
            if !said.is_empty()
                && let Some(turned) = single_tests::turned_rotation(study, &rows)
            {
                said = vec![turned];
            }
        }
        if said.is_empty() {
            said.extend(single_tests::coefficients(study, data, fit));
        }
        said.extend(constants::constants(&fitted(data, fit)));
        said.extend(single_tests::worn_before_the_first_cycle(
            study,
            &fitted(data, fit),
        ));
    }
    if said.is_empty() {
        // a negative curve falls too
        said.extend(negated::negated(study, &rows));
        if said.is_empty() {
            said.extend(falling::falling(study, data, &rows));
            said.extend(reversed::reversed(study, &rows));
        }
        if said.is_empty() {
            said.extend(moved_places::moved_places(study, &rows));
        }
        if said.is_empty() {
            said.extend(common_tilt::common_tilt(study, &rows));
        }
        // other slips may bring k there too
        if said.is_empty() {
            said.extend(single_tests::of_the_other_member(
                study, data, fit, LOW_RATIO,
            ));
        }
    }
    said.extend(sigmas::of_another_unit(data, values_asked));
    said.extend(materials::materials(study));
    said
}

/// The fitted rows as if all tests had worn by the common k: where the data make no sense, tests' own lie orders of magnitude apart.
fn of_one_k(data: &Dataset, fit: &Fit) -> Vec<RowFit> {
    let wears = |o: &Observation| matches!(o.quantity, Quantity::WearDepth | Quantity::MassLoss);
    let over_own = |o: &Observation| {
        let test = fit.tests.iter().find(|test| test.test == o.test);
        test.filter(|test| wears(o) && test.coefficient > 0.0)
            .map_or(1.0, |test| fit.coefficient / test.coefficient)
    };
    let rows = data.observations.iter().zip(&fit.rows);
    rows.map(|(o, row)| RowFit {
        model: row.model * over_own(o),
        ..*row
    })
    .collect()
}

/// s of some rows, in its standard deviations too, and the share of their weighted squares that it explains.
#[derive(Debug, Clone, Copy)]
struct Scale {
    factor: f64,
    sigmas: f64,
    explains: f64,
}

/// s of the rows of one quantity, of one member or of all.
fn scale(rows: &[FittedRow<'_>], quantity: Quantity, member: Option<Subject>) -> Option<Scale> {
    let own: Vec<&FittedRow<'_>> = rows
        .iter()
        .filter(|(o, _)| o.quantity == quantity && member.is_none_or(|m| o.member == m))
        .collect();
    // the constant that a trace may have, and the mean that a transmission error has not
    let mut means: BTreeMap<_, [f64; 3]> = BTreeMap::new();
    let key = |o: &Observation| match (o.trace, quantity) {
        (None, Quantity::TransmissionError) => Some((o.test, o.cycles.to_bits(), None)),
        (trace, _) => trace.map(|trace| (0, 0, Some(trace))),
    };
    for (o, row) in &own {
        let Some(key) = key(o) else { continue };
        let sums = means.entry(key).or_default();
        for (sum, x) in sums.iter_mut().zip([1.0, row.model, o.value]) {
            *sum += o.sigma.powi(-2) * x;
        }
    }
    let (mut ff, mut fy, mut yy) = (0.0, 0.0, 0.0);
    for (o, row) in &own {
        let [w, f, y] = key(o).map_or([1.0, 0.0, 0.0], |key| means[&key]);
        let (f, y) = ((row.model - f / w) / o.sigma, (o.value - y / w) / o.sigma);
        (ff, fy, yy) = (ff + f * f, fy + f * y, yy + y * y);
    }
    (own.len() > 2 && ff > 0.0 && yy > own.len() as f64).then(|| Scale {
        factor: fy / ff,
        sigmas: fy / ff.sqrt(),
        explains: fy * fy / (ff * yy),
    })
}

/// Two digits, whole from 10 on.
fn rounded(value: f64) -> String {
    if value >= 10.0 {
        format!("{value:.0}")
    } else {
        format!("{value:.1}")
    }
}

/// Fits with these model values, for the tests of single questions.
#[cfg(test)]
pub(super) fn fits_of(models: &[f64]) -> Vec<RowFit> {
    let of = |&model: &f64| RowFit {
        model,
        datum: 0.0,
        residual: 0.0,
        standardised: 0.0,
    };
    models.iter().map(of).collect()
}
