//! Quantities other than wear that are off the computed ones by a factor, and the unit that has it.

use super::super::residual_statistics::FittedRow;
use super::signs::EXPLAINS_OVER_A_ROTATION;
use super::{FACTOR, NEAR, rounded, scale};
use crate::measure::Quantity;
use crate::numeric::written;
use crate::study::Study;

/// Quantities that k hardly changes and that are off by a factor.
pub(super) fn other_units(study: &Study, rows: &[FittedRow<'_>]) -> Vec<String> {
    let face_width = study.gears.face_width;
    let radius = study.gears.gear.base_radius;
    let known: [(Quantity, &[(f64, &str)]); 4] = [
        (
            Quantity::TransmissionError,
            &[
                (1e-3, "mrad"),
                (1.0 / 4.848, "seconds of arc"),
                (1e-3 * radius, "µm along the line of action"),
            ],
        ),
        (Quantity::LoadShare, &[(100.0, "percent")]),
        (
            Quantity::ContactPressure,
            &[(1e-3, "GPa"), (145.0, "psi"), (10.0, "bar")],
        ),
        (
            Quantity::MeshStiffness,
            &[
                (face_width, "N/µm of the whole face width"),
                (1e3, "N/mm per mm"),
            ],
        ),
    ];
    let mut said = Vec::new();
    for (quantity, units) in known {
        let Some(found) = scale(rows, quantity, None) else {
            continue;
        };
        if found.explains < EXPLAINS_OVER_A_ROTATION
            || found.factor <= 0.0
            || found.factor.ln().abs() < FACTOR.ln()
        {
            continue;
        }
        let near = |&&(factor, _): &&(f64, &str)| (found.factor / factor - 1.0).abs() < NEAR;
        let looks = match units.iter().find(near) {
            Some((_, unit)) => format!("this looks like {unit}"),
            None => "look at its unit".to_owned(),
        };
        said.push(format!(
            "{} is {} times the computed one: {looks}, it is wanted in {}",
            quantity.name(),
            rounded(found.factor),
            match quantity.unit() {
                "1" => "parts of 1".to_owned(),
                unit => written::unit(unit),
            }
        ));
    }
    said
}
