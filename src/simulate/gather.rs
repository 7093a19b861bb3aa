//! Turns the solver's states into the plain data of a [`Run`](crate::simulate::result::Run).

use crate::contact::frame::Touch;
use crate::contact::model::PositionContact;
use crate::gear::{Gear, Member, Pair};
use crate::mesh::BoundaryEdge;
use crate::numeric::{Vec2, interpolate};
use crate::simulate::blanks::DrawnMesh;
use crate::simulate::fields::{MemberFields, Surfaces};
use crate::simulate::forward::{ContactKind, Forward, ForwardError};
use crate::simulate::kinks::Kinks;
use crate::simulate::members::MemberError;
use crate::simulate::oil_and_heat;
use crate::simulate::result::{
    self, Conditions, FaceSlice, FieldFrame, Geometry, Helix, MemberField, PairState,
    PositionState, Profile, State, ToothClass, WheelGeometry,
};
use crate::simulate::run::Plan;
use crate::simulate::stated;
use crate::simulate::touching_strip::TouchingStrip;
use crate::simulate::turn::alike_over_a_turn;
use crate::simulate::wear_state::{SliceState, WearState, line_load, worn_area};
use crate::wear::passage::Passage;

/// What was asked for.
pub fn conditions(plan: &Plan) -> Conditions {
    let set = plan.set;
    Conditions {
        test: plan.test.map(str::to_owned),
        model: match plan.kind {
            ContactKind::Fem => "fem",
            ContactKind::Hertz => "hertz",
        }
        .to_owned(),
        effects: plan.effects.to_vec(),
        torque: plan.conditions.torque,
        speed_rpm: plan.conditions.speed,
        misalignment: plan.conditions.misalignment,
        wear_coefficient: plan.conditions.coefficient,
        cycles: plan.conditions.cycles,
        face_width: set.face_width,
        youngs_modulus: set.materials.map(|m| m.youngs_modulus),
        poisson_ratio: set.materials.map(|m| m.poisson_ratio),
        density: set.densities,
        friction: stated::friction(plan),
        warmed_teeth_c: plan.surroundings.warmed_teeth_c(),
    }
}

/// Working geometry of a face `face_width` wide, whose slices stand within `placed_within` of their places, mm.
pub fn geometry(pair: &Pair, face_width: f64, placed_within: f64) -> Geometry {
    let [a, b, _, d, e] = pair.path_points();
    let helix = pair.pinion.helix_angle;
    let normal = pair.pinion.rack.normal(helix);
    let wheel = |member: Member, start: f64| {
        let gear: &Gear = pair.member(member);
        WheelGeometry {
            teeth: gear.spec.teeth,
            profile_shift: gear.spec.profile_shift / helix.cos(),
            base_radius: gear.base_radius,
            pitch_radius: match member {
                Member::Pinion => pair.pitch_radius_pinion,
                Member::Gear => pair.pitch_radius_gear,
            },
            tip_radius: gear.tip_radius,
            root_radius: gear.root_radius,
            form_radius: gear.form_radius,
            active_radius: gear.radius_at_rho(pair.rho(member, start)),
            bore_radius: gear.bore_radius(),
        }
    };
    Geometry {
        module: normal.module,
        pressure_angle_deg: normal.pressure_angle.to_degrees(),
        helix: (helix != 0.0).then(|| Helix {
            // as it was stated: radians and back leave a rounding behind
            angle_deg: (1e9 * helix.to_degrees()).round() / 1e9,
            base_angle_deg: pair.base_helix.to_degrees(),
            transverse_module: pair.pinion.rack.module,
            transverse_pressure_angle_deg: pair.pinion.rack.pressure_angle.to_degrees(),
            overlap_ratio: pair.overlap_ratio(face_width),
            placed_within,
        }),
        centre_distance: pair.centre_distance,
        working_pressure_angle_deg: pair.working_pressure_angle.to_degrees(),
        contact_ratio: pair.contact_ratio,
        path_of_contact: pair.path_length,
        base_pitch: pair.base_pitch,
        // a pair at its zero-backlash distance leaves rounding of the order of 1e-14 modules
        backlash_um: if pair.backlash.abs() < 1e-12 * pair.pinion.rack.module {
            0.0
        } else {
            1e3 * pair.backlash
        },
        speed_ratio: pair.speed_ratio,
        path_limits: [a, b, d, e],
        pinion: wheel(Member::Pinion, a),
        gear: wheel(Member::Gear, e),
    }
}

/// One stored state.
pub fn state(plan: &Plan, forward: &Forward, state: &WearState) -> State {
    let cycle = forward.cycle();
    let profile = |member: Member| {
        let side = usize::from(member == Member::Gear);
        let gear = cycle.pair.member(member);
        let arcs = &cycle.stations.arc[side];
        let rho: Vec<f64> = arcs.iter().map(|&s| gear.rho_at_arc(s)).collect();
        let area = worn_area(arcs, &state.depth[side]);
        let volume =
            (area - state.displaced[side]) * plan.set.face_width * f64::from(gear.spec.teeth);
        Profile {
            radius: rho.iter().map(|&r| gear.radius_at_rho(r)).collect(),
            path: rho
                .iter()
                .map(|&r| cycle.pair.path_at_rho(member, r))
                .collect(),
            depth: in_um(forward, &state.depth[side]),
            worn_area_mm2: area,
            // mm³ · kg/m³ = µg
            mass_loss_mg: 1e-3 * volume * plan.set.densities[side],
        }
    };
    let kinks = Kinks::of(plan.kind, forward);
    State {
        cycles: state.cycles,
        pinion: profile(Member::Pinion),
        gear: profile(Member::Gear),
        cycle: by_rotation(plan, forward, &kinks, state),
        slices: (state.slices.iter())
            .map(|slice| face_slice(plan, forward, &kinks, slice))
            .collect(),
        turn: over_a_turn(plan, forward, state),
        teeth: (state.teeth.iter())
            .map(|class| ToothClass {
                member: result::Member::BOTH[class.side],
                teeth: class.teeth.iter().map(|i| i + 1).collect(),
                depth: in_um(forward, &class.depth),
            })
            .collect(),
    }
}

/// Depths normal to the flank, µm, of those in the transverse section, mm.
fn in_um(forward: &Forward, depth: &[f64]) -> Vec<f64> {
    let inclined = 1e3 * forward.cycle().pair.cos_base_helix();
    depth.iter().map(|h| inclined * h).collect()
}

/// Rotation (base pitches) and lag (µrad) over one turn, where teeth differ or a member runs out.
fn over_a_turn(plan: &Plan, forward: &Forward, state: &WearState) -> Vec<[f64; 2]> {
    let (cycle, teeth) = (forward.cycle(), &plan.set.teeth);
    let counts = Member::BOTH.map(|m| cycle.pair.member(m).spec.teeth as usize);
    let mut turn = state.turn.clone();
    if turn.is_empty() && teeth.run_out() {
        let pitches = counts[0].max(counts[1]);
        turn = alike_over_a_turn(&cycle.positions, &state.contacts, pitches);
    }
    let base_radius = cycle.pair.pinion.base_radius;
    for [rotation, lag] in &mut turn {
        *lag = 1e6 * (*lag + teeth.back_after(*rotation, counts) / base_radius);
    }
    turn
}

/// The section that stresses are computed in: the slice that carries most over the mesh cycle, with its share of the mean load.
pub fn most_loaded(forward: &Forward, state: &WearState) -> Option<(WearState, f64)> {
    let loads = (state.slices.iter()).map(|slice| slice_load(forward, slice));
    let (most, load) = loads.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some((state.section(most), load))
}

/// Load per width of a slice over the mean of the face, the mean over the mesh cycle.
fn slice_load(forward: &Forward, slice: &SliceState) -> f64 {
    let carried = |(q, contact): (usize, &PositionContact)| -> f64 {
        let pairs = 0..forward.cycle().positions[q].pairs.len();
        pairs.map(|index| forward.moment(q, index, contact)).sum()
    };
    let all: f64 = slice.contacts.iter().enumerate().map(carried).sum();
    all / (slice.contacts.len() as f64 * forward.torque())
}

fn face_slice(plan: &Plan, forward: &Forward, kinks: &Kinks, slice: &SliceState) -> FaceSlice {
    let positions = slice.contacts.iter().enumerate();
    let pairs = positions.flat_map(|(q, contact)| position(plan, forward, kinks, q, contact).pairs);
    let on_flanks: Vec<PairState> = pairs.filter(|pair| !pair.at_corner).collect();
    let largest = |of: &dyn Fn(&&PairState) -> bool| {
        let pairs = on_flanks.iter().filter(of);
        pairs.fold(0.0, |most: f64, pair| most.max(pair.peak_pressure))
    };
    let cycle = forward.cycle();
    let passage = Passage::new(cycle);
    let pressure = [0, 1].map(|side| {
        let moments = passage.moments(cycle, &slice.contacts, side);
        moments.into_iter().map(|moment| moment.pressure).collect()
    });
    FaceSlice {
        pressure,
        face: slice.face,
        load: slice_load(forward, slice),
        peak_pressure: largest(&|_| true),
        peak_pressure_elsewhere: largest(&|pair| !pair.over_kink),
        depth: (slice.depth.each_ref()).map(|depth| in_um(forward, depth)),
    }
}

/// The mesh cycle by ascending rotation.
fn by_rotation(
    plan: &Plan,
    forward: &Forward,
    kinks: &Kinks,
    state: &WearState,
) -> Vec<PositionState> {
    let mut cycle: Vec<PositionState> = state
        .contacts
        .iter()
        .enumerate()
        .map(|(q, contact)| {
            let mut mean = position(plan, forward, kinks, q, contact);
            let of_slices = state.slices.iter();
            let of_slices = of_slices.map(|slice| (Some(slice.face), &slice.contacts));
            let of_passages = state.passages.iter().map(|contacts| (None, contacts));
            let mut most = vec![0.0; mean.pairs.len()];
            for (face, contacts) in of_slices.chain(of_passages) {
                let own = position(plan, forward, kinks, q, &contacts[q]);
                for ((mean, own), most) in mean.pairs.iter_mut().zip(own.pairs).zip(&mut most) {
                    if own.peak_pressure > *most {
                        *most = own.peak_pressure;
                        (mean.over_kink, mean.face) = (own.over_kink, face);
                    }
                    mean.peak_pressure = mean.peak_pressure.max(own.peak_pressure);
                    mean.half_width = mean.half_width.max(own.half_width);
                    mean.at_corner |= own.at_corner;
                }
            }
            mean
        })
        .collect();
    cycle.sort_by(|a, b| a.position.total_cmp(&b.position));
    cycle
}

fn position(
    plan: &Plan,
    forward: &Forward,
    kinks: &Kinks,
    q: usize,
    contact: &PositionContact,
) -> PositionState {
    let position = &forward.cycle().positions[q];
    let torque = forward.torque();
    let pairs = position
        .pairs
        .iter()
        .enumerate()
        .map(|(index, pair)| {
            let pressure = &contact.pressure[pair.offset..pair.offset + pair.xi.len()];
            let strip = TouchingStrip::of(plan.kind, forward.cycle(), pair, pressure);
            let sliding =
                oil_and_heat::of_pair(plan, &forward.cycle().pair, pair, contact, strip.at_corner);
            PairState {
                pair: position.pair_number(pair),
                path: pair.path,
                load_share: forward.moment(q, index, contact) / torque,
                line_load: line_load(pair, contact),
                peak_pressure: strip.peak_pressure,
                half_width: strip.half_width,
                off_line_of_action: pair.frame.touch != Touch::Flanks,
                at_corner: strip.at_corner,
                over_kink: kinks.under(pair, pressure),
                face: None,
                sliding,
            }
        })
        .collect();
    PositionState {
        position: position.phase(),
        angle_urad: 1e6 * contact.approach,
        pairs,
    }
}

/// Both members as drawn in a wear state, at all mesh positions alike.
pub struct Drawn {
    meshes: [DrawnMesh; 2],
    outlines: [Vec<BoundaryEdge>; 2],
}

/// The members as drawn in `state`; `None` for the analytic model.
///
/// # Errors
/// [`ForwardError`] if a mesh cannot follow the wear.
pub fn drawn(forward: &Forward, state: &WearState) -> Result<Option<Drawn>, ForwardError> {
    let (Some(blanks), Some(condensed)) = (forward.blanks(), forward.condensed()) else {
        return Ok(None);
    };
    let cycle = forward.cycle();
    let depth = [&state.depth[0][..], &state.depth[1]];
    let meshes = blanks.drawn_meshes(condensed, &cycle.pair, &cycle.stations, depth);
    let meshes = meshes.map_err(MemberError::from)?;
    let outlines = forward.outlines();
    Ok(outlines.map(|outlines| Drawn { meshes, outlines }))
}

/// Fields of `state` on the members as `drawn` in it, at position `q`, of a section with `load` times the mean load; `None` for the analytic model.
///
/// # Errors
/// [`ForwardError`] if a solve misses its residual.
pub fn frame(
    forward: &Forward,
    state: &WearState,
    drawn: &Drawn,
    load: f64,
    q: usize,
) -> Result<Option<FieldFrame>, ForwardError> {
    let cycle = forward.cycle();
    let contact = &state.contacts[q];
    let surfaces = Surfaces {
        points: [0, 1].map(|side: usize| &drawn.meshes[side].mesh.points[..]),
        outlines: &drawn.outlines,
    };
    let Some([pinion, gear]) = forward.fields_on(q, contact, surfaces)? else {
        return Ok(None);
    };
    let inclined = 1e3 * cycle.pair.cos_base_helix();
    let member = |side: usize, fields: MemberFields| {
        let DrawnMesh { mesh, unworn } = &drawn.meshes[side];
        let mut depth = vec![0.0; mesh.points.len()];
        for chain in &mesh.flanks {
            for (&node, &s) in chain.nodes.iter().zip(&chain.arc) {
                depth[node as usize] =
                    inclined * interpolate(&cycle.stations.arc[side], &state.depth[side], s);
            }
        }
        let plain = |v: &[Vec2]| v.iter().map(|p| [p.x, p.y]).collect::<Vec<[f64; 2]>>();
        MemberField {
            centre: [
                if side == 0 {
                    0.0
                } else {
                    cycle.pair.centre_distance
                },
                0.0,
            ],
            rotation: fields.turn,
            reference: plain(unworn),
            worn: plain(&mesh.points),
            cells: mesh.cells.clone(),
            displacement: plain(&fields.displacement),
            von_mises: fields.stress.iter().map(|s| s.von_mises()).collect(),
            stress: fields
                .stress
                .iter()
                .map(|s| [s.xx, s.yy, s.xy, s.zz])
                .collect(),
            contact_pressure: fields.pressure,
            contact_force: plain(&fields.force),
            wear_depth: depth,
        }
    };
    Ok(Some(FieldFrame {
        cycles: state.cycles,
        position: cycle.positions[q].phase(),
        line_load: cycle.positions[q]
            .pairs
            .iter()
            .map(|p| line_load(p, contact))
            .sum(),
        torque_per_width: load * forward.torque(),
        pinion: member(0, pinion),
        gear: member(1, gear),
    }))
}
