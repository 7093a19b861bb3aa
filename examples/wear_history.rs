//! A wear history by finite elements from a study file: depth of both flanks over the cycles.
//!
//! `cargo run --release --example wear_history [STUDY.toml]` (default: the published pair, about three seconds)

use std::error::Error;
use std::path::PathBuf;

use gearwear::simulate::forward::Forward;
use gearwear::study::Study;

#[expect(clippy::print_stdout, reason = "an example shows what it found")]
fn main() -> Result<(), Box<dyn Error>> {
    let default = concat!(env!("CARGO_MANIFEST_DIR"), "/validation/paper/study.toml");
    let path = std::env::args_os()
        .nth(1)
        .map_or(PathBuf::from(default), PathBuf::from);
    let study = Study::load(&path)?;

    // The gears as they are, how finely they are resolved, and the conditions they run at.
    let set = study.gear_set();
    let numerics = study.resolution();
    let conditions = study.operation.simulated(&study.wear);

    // Mesh, factor and condense each gear once; every contact after that is a small dense problem.
    let members = set.members(&numerics, &[conditions.torque], &[conditions.misalignment])?;
    let acting = study.acting(&study.operation);
    let mut forward =
        Forward::with_effects(&set, Some(&members), conditions, numerics, acting.as_ref())?;

    // Wear from new to each of five stops; between them the integrator takes what steps it needs.
    let stops: Vec<f64> = (1..=5)
        .map(|i| conditions.cycles * f64::from(i) / 5.0)
        .collect();
    let mut states = Vec::new();
    let mut progress = None;
    forward.wear(&mut progress, &stops, &mut |_| true, &mut |state| {
        states.push(state);
    })?;

    println!("    cycles   pinion, µm     gear, µm   (deepest places)");
    for state in &states {
        let [pinion, gear] =
            [0, 1].map(|m| 1e3 * state.depth[m].iter().copied().fold(0.0, f64::max));
        println!("{:10.0} {pinion:12.3} {gear:12.3}", state.cycles);
    }
    Ok(())
}
