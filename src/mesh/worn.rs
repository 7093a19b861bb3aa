//! The outline of a worn gear, for meshing anew when the moved mesh has become poor.

use super::Outline;
use super::gear_outline::FineFlank;
use crate::gear::Gear;
use crate::numeric::{Vec2, rotate};

/// Moves the fine flanks of an outline inwards by `depth(tooth, arc)`, mm, normal to the nominal involute.
pub(super) fn wear_outline(
    outline: &mut Outline,
    flanks: &[FineFlank],
    gear: &Gear,
    depth: &dyn Fn(i32, f64) -> f64,
) {
    let outer = &mut outline.loops[0];
    let count = outer.points.len();
    for flank in flanks {
        let turn = f64::from(flank.tooth) * gear.pitch_angle();
        let lost = |s: f64| {
            -depth(flank.tooth, s) * rotate(gear.involute_normal(gear.rho_at_arc(s)), turn)
        };
        let tip = outer.points[flank.start % count];
        for (i, s) in flank.arcs.iter().enumerate() {
            outer.points[(flank.start + i) % count] += lost(*s);
            outer.mids[(flank.start + i) % count] += match flank.arcs.get(i + 1) {
                Some(next) => lost(0.5 * (s + next)),
                // below a worn lowest point the boundary has a ledge, of a straight edge
                None => 0.5 * lost(*s),
            };
        }
        // Backwards along rounding and land, to where the boundary leaves the tip circle.
        let (mut behind, mut length, mut at) = (Vec::new(), 0.0, flank.start);
        let mut here = tip;
        while at > 0 && (on_tip_circle(gear, outer.points[at - 1]) || !on_tip_circle(gear, here)) {
            at -= 1;
            let step = (outer.points[at] - here).norm();
            here = outer.points[at];
            behind.push((outer.mids[at], length + 0.5 * step));
            length += step;
            behind.push((here, length));
        }
        let places = follow_tip(gear, tip, lost(flank.arcs[0]), &behind);
        for (i, place) in places.into_iter().enumerate() {
            let edge = flank.start - 1 - i / 2;
            let target = if i % 2 == 0 {
                &mut outer.mids
            } else {
                &mut outer.points
            };
            target[edge] = place;
        }
    }
}

/// New places of the boundary points `behind` a tip corner (each with its distance from it along the boundary) when the
/// corner at `tip` moves by `shift`: the shift falls linearly to zero at the last point.
///
/// Points of the tip circle stay on it, except that a worn corner lies a little below it: the land drops to the corner
/// over about the length of the shift.
pub(super) fn follow_tip(gear: &Gear, tip: Vec2, shift: Vec2, behind: &[(Vec2, f64)]) -> Vec<Vec2> {
    let length = behind.last().map_or(0.0, |b| b.1);
    let drop = tip.norm() - (tip + shift).norm();
    let follow = |&(p, s): &(Vec2, f64)| {
        if shift == Vec2::zeros() {
            return p;
        }
        let to = p + (1.0 - s / length) * shift;
        if !on_tip_circle(gear, p) {
            return to;
        }
        let radius = p.norm() - drop * (1.0 - s / shift.norm()).max(0.0);
        to * (radius / to.norm())
    };
    behind.iter().map(follow).collect()
}

/// Whether a boundary point lies on the tip circle.
pub(super) fn on_tip_circle(gear: &Gear, p: Vec2) -> bool {
    (p.norm() - gear.tip_radius).abs() < 1e-6 * gear.tip_radius
}
