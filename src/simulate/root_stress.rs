//! Tensile stress in the loaded fillets of a run's teeth.

use std::f64::consts::PI;

use crate::contact::fem::member_tooth;
use crate::fem::largest_principal;
use crate::gear::Gear;
use crate::mesh::{Mesh, boundary_edges};
use crate::simulate::forward::{Forward, ForwardError};
use crate::simulate::result::RootStress;
use crate::simulate::wear_state::{WearState, line_load};

/// The largest first principal stress in the loaded fillet of pinion and gear over the mesh cycle; `None` for a model without a mesh.
///
/// Stresses are computed where a tooth bends most: at the position and pair with the largest line load times height of the contact
/// above the root. Nearly always that is the outer end of single contact.
///
/// # Errors
/// [`ForwardError`] if a solve misses its residual.
pub fn largest(
    forward: &Forward,
    state: &WearState,
) -> Result<Option<[RootStress; 2]>, ForwardError> {
    let mut found = [None; 2];
    for (side, found) in found.iter_mut().enumerate() {
        let Some((q, index)) = bends_most(forward, state, side) else {
            return Ok(None);
        };
        let Some(fields) = forward.fields(q, &state.contacts[q])? else {
            return Ok(None);
        };
        let Some(members) = forward.condensed() else {
            return Ok(None);
        };
        let pair = &forward.cycle().positions[q].pairs[index];
        let mesh = &members.members[side].mesh;
        let gears = &forward.cycle().pair;
        let gear = [&gears.pinion, &gears.gear][side];
        let nodes = fillet_nodes(gear, mesh, member_tooth(pair, side));
        *found = largest_principal(&fields[side].stress, &nodes).map(|(node, stress)| RootStress {
            stress,
            radius: mesh.points[node as usize].norm(),
            path: pair.path,
        });
    }
    Ok(match found {
        [Some(pinion), Some(gear)] => Some([pinion, gear]),
        _ => None,
    })
}

/// Position and pair at which the teeth of one member bend most; none if nothing is loaded.
fn bends_most(forward: &Forward, state: &WearState, side: usize) -> Option<(usize, usize)> {
    let cycle = forward.cycle();
    let gear = [&cycle.pair.pinion, &cycle.pair.gear][side];
    let bending = |(q, index): &(usize, usize)| {
        let pair = &cycle.positions[*q].pairs[*index];
        let height = gear.radius_at_arc(pair.facing.arc[side]) - gear.root_radius;
        line_load(pair, &state.contacts[*q]) * height
    };
    let all = cycle.positions.iter().enumerate();
    let all = all.flat_map(|(q, position)| (0..position.pairs.len()).map(move |index| (q, index)));
    let most = all.max_by(|a, b| bending(a).total_cmp(&bending(b)))?;
    (bending(&most) > 0.0).then_some(most)
}

/// Boundary nodes between root and form circle on the loaded side of `tooth`.
pub fn fillet_nodes(gear: &Gear, mesh: &Mesh, tooth: i32) -> Vec<u32> {
    let pitch = gear.pitch_angle();
    let mut nodes: Vec<u32> = boundary_edges(mesh)
        .iter()
        .flat_map(|e| [Some(e.start), e.mid, Some(e.end)])
        .flatten()
        .filter(|&node| {
            let x = mesh.points[node as usize];
            let turned = x.y.atan2(x.x) - f64::from(tooth) * pitch;
            let angle = turned - 2.0 * PI * (turned / (2.0 * PI)).round();
            let r = x.norm();
            let slack = 1e-6 * gear.rack.module;
            (gear.root_radius - slack..=gear.form_radius + slack).contains(&r)
                && (0.0..=0.5 * pitch + 1e-9).contains(&angle)
        })
        .collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}
