//! Claim: the catalogue of physical effects is whole (every file listed, every card complete and true to its code), every effect
//! follows its source, does nothing at its neutral values to the last bit, and stays finite; a user's formula is read as on
//! paper, and what cannot be read is refused with its place.
//!
//! Source: each card's; expected numbers were computed by hand from the formulas as the sources write them (in another language,
//! rounded at the last digit shown); closed forms: the passage integral of p^m over a Hertz pressure, the integral of a decay,
//! densities that integrate to 1; the characteristic points of the 27/53 reference pair, tabulated by other hands.
//! Tolerance: none for neutral values; 1e-12 relative for hand calculations with that many digits, half the last printed digit
//! otherwise; 1e-9 where the printed formula is evaluated in another order of operations; 1e-15 for running-in as a formula.

mod cards;
mod command;
mod laws;
mod own;
mod places;
mod tribology;

use gearwear::effects::{Effect, find};

/// The effect with `stated` values and defaults for the rest.
fn effect(name: &str, stated: &[(&str, f64)]) -> Box<dyn Effect> {
    let card = find(name).unwrap();
    (card.build)(&card.values(stated).unwrap())
}

fn close(ours: f64, expected: f64, tolerance: f64) {
    assert!(
        (ours - expected).abs() <= tolerance,
        "{ours:e} against {expected:e} within {tolerance:e}"
    );
}

/// Equal to twelve digits.
fn same(ours: f64, expected: f64) {
    close(ours, expected, 1e-12 * expected.abs());
}
