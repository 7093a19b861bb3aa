//! Film, flash temperature and friction losses of the tooth pairs of a run, for its tables and pictures.
//!
//! The wear of the base model does not depend on them; effects compute theirs the same way ([`crate::effects::Surroundings`]).

use crate::contact::cycle::PairContact;
use crate::contact::model::PositionContact;
use crate::effects::LineContact;
use crate::gear::Pair;
use crate::simulate::result::Sliding;
use crate::simulate::run::Plan;
use crate::wear::acting::{PairLoad, rolling};

/// What slides, heats and is lost at `pair`.
///
/// ```text
/// P = μ w b |u1 − u2|/cos β_b      W: μ friction, w N/mm line load, b mm face width, u m/s
/// ```
/// Film and temperature are those of the section normal to the contact line, its relative radius 1/cos β_b times the transverse one.
/// At a tip corner (`at_corner`) film and temperature have no meaning and are left out; its friction is that of the flanks at the nearest
/// end of the path of contact.
pub(super) fn of_pair(
    plan: &Plan,
    gears: &Pair,
    pair: &PairContact,
    contact: &PositionContact,
    at_corner: bool,
) -> Sliding {
    let rolling = rolling(gears, pair, plan.conditions.speed);
    let speed = (rolling[0] - rolling[1]).abs();
    let load = PairLoad::of(pair, contact);
    if load.line_load <= 0.0 {
        return Sliding {
            speed,
            ..Sliding::default()
        };
    }
    let [start, .., end] = gears.path_points();
    let found = plan.surroundings.at(&LineContact {
        line_load: load.line_load,
        relative_radius: gears.relative_radius(pair.path.clamp(start, end))
            / gears.cos_base_helix(),
        rolling,
        half_width: load.half_width,
    });
    let away_from_corners = |figure: Option<f64>| figure.filter(|_| !at_corner);
    let force = load.line_load * plan.set.face_width / gears.cos_base_helix();
    Sliding {
        speed,
        film_ratio: away_from_corners(found.film_ratio),
        flash_temperature: away_from_corners(found.flash_temperature),
        friction: found.friction,
        power: found.friction.map(|friction| friction * force * speed),
    }
}
