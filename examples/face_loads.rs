//! Line loads of new flanks across the face: those of every slice and tooth at single rotations, which results only hold as means over the face.
//!
//! `cargo run --release --example face_loads -- STUDY ROTATION ...`, with rotations of the pinion in base pitches from where tooth 0 touches at the pitch point in
//! mid-face. Prints JSON: the lag in µrad, and by tooth of the pinion N per mm of face width in each slice, between the two mesh positions that a rotation lies between.

use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;

use gearwear::simulate::forward::Forward;
use gearwear::simulate::wear_state::{WearState, line_load};
use gearwear::study::Study;
use serde_json::{Value, json};

#[expect(clippy::print_stdout, reason = "an example shows what it found")]
fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let study = Study::load(Path::new(&arguments.next().ok_or("no study")?))?;
    let rotations: Vec<f64> = arguments
        .map(|rotation| rotation.parse())
        .collect::<Result<_, _>>()?;
    let (set, numerics) = (study.gear_set(), study.resolution());
    let conditions = study.operation.simulated(&study.wear);
    let members = set.members(&numerics, &[conditions.torque], &[0.0])?;
    let mut forward = Forward::new(&set, Some(&members), conditions, numerics)?;
    let mut new = None;
    let store = &mut |state| new = Some(state);
    forward.wear(&mut None, &[0.0], &mut |_| true, store)?;
    let new = new.ok_or("nothing was computed")?;
    let all: Option<Vec<Value>> = rotations.iter().map(|r| at(&forward, &new, *r)).collect();
    println!("{}", json!(all.ok_or("no slices")?));
    Ok(())
}

/// The loads at one rotation; none where the face has no slices.
fn at(forward: &Forward<'_>, state: &WearState, rotation: f64) -> Option<Value> {
    let (cycle, slices) = (forward.cycle(), forward.slices()?);
    let positions = cycle.positions.len();
    let beyond = |turn: usize| {
        let theta = cycle.positions[turn].theta;
        (theta - rotation + 0.5).rem_euclid(1.0) - 0.5
    };
    let next = (0..positions).min_by(|a, b| {
        let [a, b] = [a, b].map(|turn| beyond(*turn).rem_euclid(1.0));
        a.total_cmp(&b)
    })?;
    let before = (next + positions - 1) % positions;
    let on = (beyond(next) * positions as f64).clamp(0.0, 1.0);
    let mut lag = 0.0;
    let mut loads: BTreeMap<i32, Vec<f64>> = BTreeMap::new();
    for (turn, share) in [(next, 1.0 - on), (before, on)] {
        let pitches = (cycle.positions[turn].theta - rotation - beyond(turn)).round() as i32;
        lag += 1e6 * share * state.contacts[turn].approach;
        for (i, slice) in state.slices.iter().enumerate() {
            let section = slices.at(i, turn, positions);
            for pair in &cycle.positions[section].pairs {
                let tooth = pair.tooth - slices.passed(i, turn, positions) + pitches;
                let own = (loads.entry(tooth)).or_insert_with(|| vec![0.0; slices.count()]);
                own[i] += share * line_load(pair, &slice.contacts[section]);
            }
        }
    }
    loads.retain(|_, of_tooth| of_tooth.iter().any(|load| *load > 0.0));
    Some(json!({ "lag_urad": lag, "load_N_per_mm": loads }))
}
