//! Which friction a run used, in words.

use crate::numeric::written::plain;
use crate::simulate::result::{LossFriction, Run};

/// The key of the stated coefficient.
const KEY: &str = "`lubricant.friction_coefficient`";

/// In the contact, where it moves loads and wear.
pub(in crate::report) fn in_contact(run: &Run) -> String {
    let friction = &run.conditions.friction;
    let own = match friction.contact {
        0.0 if friction.not_used => {
            Some("none: `numerics.friction` does nothing in this contact model".to_owned())
        }
        0.0 => None,
        coefficient => Some(format!(
            "Coulomb, coefficient {} ({KEY}, switched on by `numerics.friction`)",
            plain(coefficient)
        )),
    };
    match (own, friction.by_effects) {
        (Some(own), true) => format!("{own}; besides, that of the added effects"),
        (Some(own), false) => own,
        (None, true) => "that of the added effects".to_owned(),
        (None, false) => "none: contact forces are normal to the flanks".to_owned(),
    }
}

/// For losses, which change neither loads nor wear.
pub(in crate::report) fn of_losses(run: &Run) -> String {
    let friction = &run.conditions.friction;
    match (friction.losses, friction.stated) {
        (LossFriction::FromOil, _) => {
            "local coefficient, of `lubricant.viscosity`, `lubricant.roughness`, load and speed"
                .to_owned()
        }
        (LossFriction::Stated, Some(stated)) => format!("coefficient {} ({KEY})", plain(stated)),
        _ => "none follows from the study".to_owned(),
    }
}

/// How warm friction losses make the teeth, where they do.
pub(in crate::report) fn warmed_teeth(run: &Run) -> Option<String> {
    let [flank, root] = run.conditions.warmed_teeth_c?;
    let [flank, root] = [flank, root].map(|celsius| plain(0.1 * (10.0 * celsius).round()));
    Some(format!(
        "flank {flank} °C, root {root} °C (VDI 2736, from the friction losses)"
    ))
}

/// For the flash temperature, where there is one.
pub(in crate::report) fn of_flash(run: &Run) -> Option<String> {
    run.last().largest_flash_temperature()?;
    let stated = run.conditions.friction.stated?;
    Some(format!("coefficient {} ({KEY})", plain(stated)))
}
