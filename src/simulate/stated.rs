//! What a plan states of the gears and of friction, as plain data.

use crate::effects::Hook;
use crate::gear::Gear;
use crate::simulate::forward::ContactKind;
use crate::simulate::result::{Friction, LossFriction, Made, MadeWheel};
use crate::simulate::run::Plan;

/// How the gears are made.
pub(super) fn made(plan: &Plan) -> Made {
    let set = plan.set;
    let helix = set.gears[0].helix_angle;
    let rack = set.gears[0].rack.normal(helix);
    let wheel = |gear: &Gear| MadeWheel {
        thickness_reduction: gear.spec.thickness_reduction * helix.cos(),
        tip_relief_um: 1e3 * gear.spec.tip_relief_amount,
        tip_relief_length: gear.spec.tip_relief_length,
        tip_rounding: gear.spec.tip_rounding,
        measured_profile: !gear.profile.is_empty(),
    };
    Made {
        centre_distance: set.centre_distance,
        addendum: rack.addendum,
        dedendum: rack.dedendum,
        fillet_radius: rack.fillet_radius,
        wheels: set.gears.each_ref().map(wheel),
        face: set.face.clone(),
        teeth: set.teeth.clone(),
    }
}

/// Which friction is used for what.
pub(super) fn friction(plan: &Plan) -> Friction {
    let oil = &plan.surroundings;
    let asked = plan.numerics.friction;
    let is_solved = plan.kind == ContactKind::Fem;
    Friction {
        contact: if is_solved { asked } else { 0.0 },
        not_used: !is_solved && asked != 0.0,
        by_effects: plan
            .acting
            .is_some_and(|acting| acting.acts(Hook::Friction)),
        stated: oil.friction_coefficient,
        losses: match (
            oil.viscosity_pa_s.zip(oil.roughness_um),
            oil.friction_coefficient,
        ) {
            (Some(_), _) => LossFriction::FromOil,
            (None, Some(_)) => LossFriction::Stated,
            (None, None) => LossFriction::Unknown,
        },
    }
}
