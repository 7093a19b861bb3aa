//! `gearwear export`: one mesh position as an input deck, for another finite-element program to solve again.

use std::path::Path;

use clap::Args;
use serde_json::{Value, json};

use super::args::StudyAndOutput;
use super::folder;
use super::{CliError, Context, Outcome};
use crate::effects::Hook;
use crate::report::Staging;
use crate::simulate::deck::deck;
use crate::simulate::forward::ForwardError;
use crate::simulate::members::MemberError;
use crate::simulate::one_position::OnePosition;
use crate::study::{Operation, Study};

/// Arguments of `export`.
#[derive(Debug, Args)]
#[command(
    after_help = "The deck holds both gears in plane strain, bores rigid, the pinion under the study's torque, frictionless contact between all flanks that can touch. expected.json beside it holds what gearwear finds for the same position.\n\nExamples:\n  gearwear export study.toml --position 0.25\n  gearwear export study.toml --position 0.25 -o deck && cd deck && ccx position_0.2500"
)]
pub struct ExportArgs {
    #[command(flatten)]
    paths: StudyAndOutput,
    /// Mesh position: rotation of the pinion from the pitch point, in base pitches, 0 to 1
    #[arg(long, value_name = "P", default_value = "0", value_parser = position)]
    position: f64,
    /// The conditions of the test with this id instead of the study's operation
    #[arg(long, value_name = "ID")]
    test: Option<String>,
}

fn position(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (0.0..=1.0).contains(&value) => Ok(value),
        _ => Err("a number from 0 to 1, in base pitches".to_owned()),
    }
}

/// Meshes, solves the position, writes the deck and what is expected of it.
pub(super) fn execute(args: &ExportArgs, context: &Context) -> Result<Outcome, CliError> {
    let study = Study::load(&args.paths.study)?;
    study.one_section("export")?;
    study.teeth_alike("export")?;
    let operation = study.conditions(args.test.as_deref())?;
    check(&study, operation)?;
    let target = args
        .paths
        .output
        .clone()
        .unwrap_or_else(|| folder::default_path(&args.paths.study, "export"));
    let mut staging = Staging::begin(&target)?;
    let progress = context.progress("export");
    progress.stage("mesh, factor and condense both gears");
    let set = study.gear_set_at(operation);
    let conditions = operation.simulated(&study.wear_at(operation));
    let numerics = study.resolution();
    let mut own = [None, None];
    for (slot, (member, path)) in own.iter_mut().zip(study.own_meshes()) {
        if let Some(path) = path {
            *slot = Some(super::mesh::read_own(&study, member, path)?);
        }
    }
    let members = set.members_on(
        &numerics,
        &[conditions.torque],
        &[conditions.misalignment],
        own,
    )?;
    progress.stage("contact");
    let solved = OnePosition::solve(&set, &members, &conditions, &numerics, args.position)?;
    let name = format!("position_{:.4}", args.position);
    let title = title(&study, args.position, &solved, &name);
    let text = deck(&title, &set, &members, &solved)
        .map_err(|error| ForwardError::from(MemberError::from(error)))?;
    let file = format!("{name}.inp");
    staging.write(&file, text.as_bytes())?;
    let nodes = members.members.iter().map(|m| m.mesh.points.len()).sum();
    let document = document(args.position, &file, nodes, &solved);
    let name_of_expected = "expected.json";
    staging.write(
        name_of_expected,
        &crate::report::json::text(name_of_expected, &document)?,
    )?;
    let folder = staging.commit()?;
    Ok(Outcome {
        json: document,
        text: summary(&solved, &name, &folder),
        success: true,
    })
}

/// Turn of the pinion under load, µrad.
fn turn(solved: &OnePosition) -> f64 {
    1e6 * solved.contact.approach
}

/// What the deck says of itself, with what is expected of it.
fn title(study: &Study, position: f64, solved: &OnePosition, name: &str) -> String {
    let (peak, _) = solved.peak();
    format!(
        "gearwear {}: {}\nmesh position {position:.4} base pitches from the pitch point, torque per width {} N mm/mm; units mm, N, MPa\n\
         expected: turn of the pinion {:.3} µrad, largest pressure {peak:.2} MPa\nwritten for CalculiX: ccx {name}",
        env!("CARGO_PKG_VERSION"),
        study.title.replace('\n', " "),
        solved.torque,
        turn(solved),
    )
}

/// `expected.json` for the deck `file` of so many nodes.
fn document(position: f64, file: &str, nodes: usize, solved: &OnePosition) -> Value {
    let pairs = solved.loads().into_iter().map(|load| {
        json!({
            "pair": load.pair, "path": load.path, "line_load": load.line_load,
            "peak_pressure": load.peak_pressure, "at_corner": load.at_corner,
        })
    });
    json!({
        "deck": file,
        "position": position,
        "torque_per_width": solved.torque,
        "angle_urad": turn(solved),
        "peak_pressure": solved.peak().0,
        "nodes": nodes,
        "pairs": pairs.collect::<Vec<Value>>(),
    })
}

fn summary(solved: &OnePosition, name: &str, folder: &Path) -> String {
    let mut summary = format!(
        "turn of the pinion  {:.2} µrad\npeak pressure       {:.1} MPa\n",
        turn(solved),
        solved.peak().0
    );
    for load in solved.loads() {
        let corner = if load.at_corner { ", tip corner" } else { "" };
        summary += &format!(
            "tooth pair {:>2}       {:.2} N/mm, {:.1} MPa at path {:.3} mm{corner}\n",
            load.pair, load.line_load, load.peak_pressure, load.path
        );
    }
    summary += &format!(
        "Written to {}\nNext: ccx {name}, in that folder; compare U1 of node set TURN and the contact stresses in {name}.dat\n",
        folder.display()
    );
    summary
}

/// The deck knows plain elastic contact only.
fn check(study: &Study, operation: &Operation) -> Result<(), CliError> {
    let acting = study.acting(operation);
    let changes = Hook::ALL
        .into_iter()
        .filter(|hook| !matches!(hook, Hook::WearFactor | Hook::AddedDepth));
    if acting.is_some_and(|acting| changes.into_iter().any(|hook| acting.acts(hook))) {
        return Err(CliError::Study(study.refuse(
            "effect",
            "an effect changes the contact itself, which the deck does not hold",
            "effects on wear alone",
            "take the effect out of a copy of the study",
        )));
    }
    if study.numerics.friction {
        return Err(CliError::Study(study.refuse(
            "numerics.friction",
            "the deck's contact has no friction",
            "false",
            "",
        )));
    }
    Ok(())
}
