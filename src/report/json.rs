//! Machine-readable results: `summary.json`, and any other document a command writes.
mod indented;

use serde::Serialize;
use serde_json::{Map, Serializer, Value, json};

use self::indented::Indented;
use super::csv::finite;
use super::error::OutputError;
use crate::simulate::result::{
    Conditions, LossFriction, Member, MeshSummary, Run, State, ToothClass,
};

/// `summary.json`. Lengths mm, angles degrees, pressures MPa, stiffness N/(mm·µm); the unit stands in the key where another is meant.
///
/// `contact` describes the first stored state, `contact_end` the last; `peak_pressure` is the largest on the flanks, `peak_pressure_elsewhere` that
/// away from kinks of the flanks as made (the start of a linear tip relief), whose pressure depends on the mesh, and `corner_pressure` the largest where a tip corner or the end of a flank touches (by finite elements the mean over 0.02 modules). A
/// figure that does not exist for a run (a mesh for a model without one, a single pair where two always touch) is null.
pub fn summary(run: &Run) -> Result<Value, OutputError> {
    let g = &run.geometry;
    let c = &run.conditions;
    let mut wear = Map::new();
    for member in Member::BOTH {
        wear.insert(member.name().to_owned(), member_wear(run, member));
    }
    wear.insert("balance_error".to_owned(), json!(run.balance_error));
    wear.insert("cycles".to_owned(), json!(run.last().cycles));
    let mut contact = contact_of(run.first());
    contact["single_pair_stiffness"] = json!(run.single_pair_stiffness());
    let cost = &run.cost;
    let mut document = json!({
        "title": run.title,
        "conditions": {
            "test": c.test, "model": c.model, "effects": c.effects, "torque": c.torque / 1000.0, "speed": c.speed_rpm,
            "misalignment": c.misalignment, "coefficient": c.wear_coefficient[0], "cycles": c.cycles, "face_width": c.face_width,
        },
        "geometry": {
            "working_pressure_angle": g.working_pressure_angle_deg, "contact_ratio": g.contact_ratio,
            "path_of_contact": g.path_of_contact, "base_pitch": g.base_pitch, "backlash_um": g.backlash_um,
            "speed_ratio": g.speed_ratio, "centre_distance": g.centre_distance, "path_limits": g.path_limits,
        },
        "mesh": mesh(run.mesh.as_ref()),
        "contact": contact,
        "contact_end": contact_of(run.last()),
        "wear": wear,
        "checks": run.checks.iter().map(|k| json!({
            "name": k.name, "value": k.value, "limit": k.limit, "unit": k.unit, "passed": k.passed(),
        })).collect::<Vec<_>>(),
        "cost": {
            "seconds": cost.seconds, "factorisations": cost.factorisations, "contact_solves": cost.contact_solves,
            "wear_steps": cost.wear_steps, "peak_memory_mb": cost.peak_memory_mb, "threads": cost.threads,
            "stages": cost.stages.iter().map(|(name, seconds)| json!({"name": name, "seconds": seconds})).collect::<Vec<_>>(),
        },
    });
    if let Some(helix) = &g.helix {
        document["geometry"]["helix"] = json!({
            "helix_angle": helix.angle_deg, "base_helix_angle": helix.base_angle_deg,
            "transverse_module": helix.transverse_module, "transverse_pressure_angle": helix.transverse_pressure_angle_deg,
            "overlap_ratio": helix.overlap_ratio, "total_contact_ratio": g.total_contact_ratio(),
            "slices_within": helix.placed_within,
        });
    }
    if let Some(both) = &run.root_stress {
        for (member, root) in Member::BOTH.into_iter().zip(both) {
            document["root_stress"][member.name()] =
                json!({"stress_mpa": root.stress, "radius_mm": root.radius, "path_mm": root.path});
        }
    }
    if !run.last().slices.is_empty() {
        let [first, last] = [run.first(), run.last()].map(across_the_face);
        document["face"] = json!({"first": first, "last": last});
    }
    if !run.last().teeth.is_empty() {
        document["teeth"] = by_tooth(run.last());
    }
    if let Some(last) = run.last().te_over_a_turn_urad() {
        let first = run.first().te_over_a_turn_urad();
        document["transmission_error_over_a_turn_urad"] = json!({"first": first, "last": last});
    }
    document["conditions"]["friction"] = friction(c);
    if c.wear_coefficient[1] != c.wear_coefficient[0] {
        document["conditions"]["coefficient_gear"] = json!(c.wear_coefficient[1]);
    }
    if let Some([flank, root]) = c.warmed_teeth_c {
        document["conditions"]["tooth_temperature_c"] = json!({"flank": flank, "root": root});
    }
    check_numbers(run)?;
    Ok(document)
}

/// Which friction was used: in the contact (a coefficient, 0 for none), and from which keys that of the losses follows.
fn friction(c: &Conditions) -> Value {
    let f = &c.friction;
    let losses = match f.losses {
        LossFriction::Unknown => Value::Null,
        LossFriction::Stated => json!("lubricant.friction_coefficient"),
        LossFriction::FromOil => json!("lubricant.viscosity, lubricant.roughness"),
    };
    json!({"contact": f.contact, "by_effects": f.by_effects, "losses_from": losses, "stated": f.stated})
}

/// Load, pressure and wear of every slice.
fn across_the_face(state: &State) -> Value {
    let slices = state.slices.iter();
    let rows: Vec<Value> = slices
        .map(|slice| {
            let deepest =
                (slice.depth.each_ref()).map(|depth| depth.iter().fold(0.0, |m: f64, h| m.max(*h)));
            json!({"face": slice.face, "load": slice.load, "peak_pressure": slice.peak_pressure,
                   "peak_pressure_elsewhere": slice.peak_pressure_elsewhere,
                   "max_depth_um": {"pinion": deepest[0], "gear": deepest[1]}})
        })
        .collect();
    json!({"cycles": state.cycles, "load_factor": state.face_load_factor(), "slices": rows})
}

/// Wear of the teeth that differ.
fn by_tooth(state: &State) -> Value {
    let of = |class: &ToothClass| json!({"member": class.member.name(), "teeth": class.teeth, "max_depth_um": class.deepest()});
    let classes: Vec<Value> = state.teeth.iter().map(of).collect();
    json!({"cycles": state.cycles, "classes": classes})
}

/// A document as text, indented, with a newline at its end.
pub fn text(file: &str, document: &impl Serialize) -> Result<Vec<u8>, OutputError> {
    let mut bytes = Vec::new();
    let mut writer = Serializer::with_formatter(&mut bytes, Indented::default());
    (document.serialize(&mut writer)).map_err(|source| OutputError::Json {
        file: file.to_owned(),
        source,
    })?;
    bytes.push(b'\n');
    Ok(bytes)
}

fn member_wear(run: &Run, member: Member) -> Value {
    let flank = run.last().profile(member);
    let below_corner = flank.deepest_below_corner(run.geometry.module);
    json!({
        "max_depth_um": flank.max_depth(),
        "max_depth_radius": flank.deepest().map(|i| flank.radius[i]),
        "max_depth_below_corner_um": below_corner.map(|i| flank.depth[i]),
        "max_depth_below_corner_radius": below_corner.map(|i| flank.radius[i]),
        "worn_area_mm2": flank.worn_area_mm2,
        "mass_loss_mg": flank.mass_loss_mg,
    })
}

fn contact_of(state: &State) -> Value {
    let (peak, corner) = (state.peak_pressure(), state.corner_pressure());
    let elsewhere = state.pressure_elsewhere();
    json!({
        "cycles": state.cycles,
        "peak_pressure": peak.map(|p| p.0),
        "peak_pressure_path": peak.map(|p| p.1),
        "peak_pressure_over_kink": state.peak_is_over_kink(),
        "peak_pressure_elsewhere": elsewhere.map(|p| p.0),
        "peak_pressure_elsewhere_path": elsewhere.map(|p| p.1),
        "corner_pressure": corner.map(|p| p.0),
        "corner_pressure_path": corner.map(|p| p.1),
        "te_peak_to_peak_urad": state.te_peak_to_peak_urad(),
        "least_film_ratio": state.least_film_ratio().map(|f| f.0),
        "largest_flash_temperature_k": state.largest_flash_temperature().map(|f| f.0),
        "friction_power_w": state.friction_power(),
    })
}

/// Sums over both members; the worse of the two for angle and spacing.
fn mesh(both: Option<&[MeshSummary; 2]>) -> Value {
    let Some([pinion, gear]) = both else {
        return json!({"nodes": 0, "elements": 0, "dof": 0, "min_angle": null, "flank_spacing": null,
                      "edges_per_half_width": null});
    };
    let member = |m: &MeshSummary| {
        json!({"element": m.element, "nodes": m.nodes, "elements": m.elements, "dof": m.dof,
               "min_angle": m.min_angle_deg, "flank_spacing": m.flank_spacing})
    };
    json!({
        "nodes": pinion.nodes + gear.nodes,
        "elements": pinion.elements + gear.elements,
        "dof": pinion.dof + gear.dof,
        "min_angle": pinion.min_angle_deg.min(gear.min_angle_deg),
        "flank_spacing": pinion.flank_spacing.max(gear.flank_spacing),
        "edges_per_half_width": pinion.edges_per_half_width.min(gear.edges_per_half_width),
        "pinion": member(pinion),
        "gear": member(gear),
    })
}

/// JSON has no NaN, it would turn into null without a word: refuse it instead.
fn check_numbers(run: &Run) -> Result<(), OutputError> {
    let g = &run.geometry;
    let file = "summary.json";
    let mut figures = vec![
        (
            "geometry.working_pressure_angle".to_owned(),
            g.working_pressure_angle_deg,
        ),
        ("geometry.contact_ratio".to_owned(), g.contact_ratio),
        ("geometry.path_of_contact".to_owned(), g.path_of_contact),
        ("geometry.base_pitch".to_owned(), g.base_pitch),
        ("geometry.backlash_um".to_owned(), g.backlash_um),
        ("geometry.speed_ratio".to_owned(), g.speed_ratio),
        ("geometry.centre_distance".to_owned(), g.centre_distance),
        ("wear.balance_error".to_owned(), run.balance_error),
        ("cost.seconds".to_owned(), run.cost.seconds),
    ];
    figures.extend(
        g.path_limits
            .iter()
            .map(|&limit| ("geometry.path_limits".to_owned(), limit)),
    );
    for member in Member::BOTH {
        let flank = run.last().profile(member);
        for (key, value) in [
            ("max_depth_um", flank.max_depth()),
            ("worn_area_mm2", flank.worn_area_mm2),
            ("mass_loss_mg", flank.mass_loss_mg),
        ] {
            figures.push((format!("wear.{}.{key}", member.name()), value));
        }
    }
    for (member, root) in Member::BOTH
        .into_iter()
        .zip(run.root_stress.iter().flatten())
    {
        figures.push((format!("root_stress.{}", member.name()), root.stress));
    }
    for state in [run.first(), run.last()] {
        let at = state.cycles;
        let figures_of_oil = [
            ("least_film_ratio", state.least_film_ratio().map(|f| f.0)),
            (
                "largest_flash_temperature_k",
                state.largest_flash_temperature().map(|f| f.0),
            ),
            ("friction_power_w", state.friction_power()),
        ];
        let known = figures_of_oil
            .into_iter()
            .filter_map(|(name, figure)| Some((format!("contact.{name} at {at} cycles"), figure?)));
        figures.extend(known);
        figures.extend(
            state
                .peak_pressure()
                .map(|p| (format!("contact.peak_pressure at {at} cycles"), p.0)),
        );
        figures.extend(
            state
                .corner_pressure()
                .map(|p| (format!("contact.corner_pressure at {at} cycles"), p.0)),
        );
        figures.extend(
            state
                .te_peak_to_peak_urad()
                .map(|te| (format!("contact.te_peak_to_peak_urad at {at} cycles"), te)),
        );
    }
    figures.extend(
        run.single_pair_stiffness()
            .map(|k| ("contact.single_pair_stiffness".to_owned(), k)),
    );
    figures.extend(
        run.checks
            .iter()
            .map(|check| (format!("checks: {}", check.name), check.value)),
    );
    for (what, value) in figures {
        finite(file, &what, value)?;
    }
    Ok(())
}
