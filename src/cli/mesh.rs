//! `gearwear mesh`: the meshes of both members and their quality, without a run.

use std::fs;
use std::path::Path;

use clap::Args;
use serde_json::json;

use super::args::StudyAndOutput;
use super::folder;
use super::{CliError, Context, Outcome};
use crate::gear::Member;
use crate::mesh::{Mesh, MeshError, Quality, read_msh, read_vtu};
use crate::report::{Staging, vtk};
use crate::study::Study;

/// Arguments of `mesh`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gearwear mesh study.toml\n  gearwear mesh study.toml -o meshes --json"
)]
pub struct MeshArgs {
    #[command(flatten)]
    paths: StudyAndOutput,
}

/// Meshes both members (or reads the study's own meshes), writes them and reports their quality.
pub(super) fn execute(args: &MeshArgs, context: &Context) -> Result<Outcome, CliError> {
    let study = Study::load(&args.paths.study)?;
    let target = args
        .paths
        .output
        .clone()
        .unwrap_or_else(|| folder::default_path(&args.paths.study, "mesh"));
    let mut staging = Staging::begin(&target)?;
    let progress = context.progress("mesh");
    progress.stage("mesh both gears");
    let set = study.gear_set();
    let torques: Vec<f64> = study.all_conditions().map(|c| c.torque_nmm).collect();
    let misalignments: Vec<f64> = study.all_conditions().map(|c| c.misalignment_mm).collect();
    let mut own = [None, None];
    for (slot, (member, path)) in own.iter_mut().zip(study.own_meshes()) {
        if let Some(path) = path {
            *slot = Some(read_own(&study, member, path)?);
        }
    }
    let meshes = set.meshes(&study.resolution(), &torques, &misalignments, own)?;
    let mut text = String::new();
    let mut document = serde_json::Map::new();
    for (member, mesh) in Member::BOTH.into_iter().zip(&meshes) {
        let quality = Quality::of(mesh);
        let name = format!("{}.vtu", member.name());
        staging.write(&name, &vtk::xml(&name, mesh.to_vtk(member.name()))?)?;
        text.push_str(&format!(
            "{:6} {:>6} nodes, {:>6} elements, smallest angle {:.1}°, flanks of {} teeth fine: {name}\n",
            member.name(),
            quality.nodes,
            quality.elements,
            quality.min_angle_deg,
            mesh.flanks.len()
        ));
        document.insert(
            member.name().to_owned(),
            json!({
                "file": name, "nodes": quality.nodes, "elements": quality.elements, "dof": 2 * quality.nodes,
                "min_angle": quality.min_angle_deg, "max_aspect": quality.max_aspect,
                "min_scaled_jacobian": quality.min_scaled_jacobian,
                "teeth": mesh.flanks.iter().map(|f| f.tooth).collect::<Vec<_>>(),
            }),
        );
    }
    let document = serde_json::Value::Object(document);
    staging.write(
        "mesh.json",
        &crate::report::json::text("mesh.json", &document)?,
    )?;
    let folder = staging.commit()?;
    text.push_str(&format!("results: {}\n", folder.display()));
    Ok(Outcome {
        json: document,
        text,
        success: true,
    })
}

/// Reads a user's own mesh of one member.
pub(super) fn read_own(study: &Study, member: Member, path: &Path) -> Result<Mesh, CliError> {
    let gear = match member {
        Member::Pinion => &study.gears.pinion,
        Member::Gear => &study.gears.gear,
    };
    let unreadable = |error: std::io::Error| format!("cannot read {}: {error}", path.display());
    let faulty = |error: MeshError| error.to_string();
    let read = || -> Result<Mesh, String> {
        if path.extension().is_some_and(|e| e == "msh") {
            let text = fs::read_to_string(path).map_err(unreadable)?;
            read_msh(path, &text, gear).map_err(faulty)
        } else {
            let bytes = fs::read(path).map_err(unreadable)?;
            read_vtu(path, &bytes, gear).map_err(faulty)
        }
    };
    read().map_err(|message| refusal(study, member, &message))
}

/// The user's own mesh of a member cannot be used.
pub(super) fn refusal(study: &Study, member: Member, message: &str) -> CliError {
    CliError::Study(study.refuse(
        &format!("numerics.mesh_{}", member.name()),
        message,
        "a mesh with bore and flanks named as `gearwear mesh` writes them",
        "",
    ))
}
