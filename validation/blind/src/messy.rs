//! What a real measuring room does to traces: each is tilted and its radii shifted, some points are dirt, σ is misjudged, checkpoints are
//! left out. The twin of a clean set: causes, noise and datums stay as they are.

use std::collections::{BTreeMap, BTreeSet};

use crate::dice::Dice;
use crate::observe::Row;

/// Standard deviations of the tilt from end to end, um, and of the shift of the radii, mm.
pub const TILT: f64 = 0.3;
pub const SHIFT: f64 = 0.02;
/// Part of the depths that are dirt, and by how many sigma.
const DIRT: f64 = 0.02;
const DIRTY: f64 = 8.0;
/// Factors on the written sigma.
const JUDGED: [f64; 2] = [0.7, 1.5];
/// Part of the traces that were not measured.
const LEFT_OUT: f64 = 0.05;

pub fn spoil(rows: &mut Vec<Row>, dice: &mut Dice) {
    let mut traces: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (i, row) in rows.iter().enumerate() {
        if row.is_depth() {
            traces.entry(row.trace.clone()).or_default().push(i);
        }
    }
    let judged = dice.log_uniform(JUDGED[0], JUDGED[1]);
    let mut left_out = BTreeSet::new();
    for (name, own) in &traces {
        let (tilt, shift) = (TILT * dice.normal(), SHIFT * dice.normal());
        if dice.unit() < LEFT_OUT {
            left_out.insert(name.clone());
        }
        let mut curve: Vec<(f64, f64)> = (own.iter())
            .map(|&i| (rows[i].position.unwrap_or(0.0), rows[i].free))
            .collect();
        curve.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (low, high) = (curve[0].0, curve[curve.len() - 1].0);
        for &i in own {
            let radius = rows[i].position.unwrap_or(0.0);
            let moved = between(&curve, radius - shift) - between(&curve, radius);
            rows[i].value += moved + tilt * ((radius - low) / (high - low) - 0.5);
            if dice.unit() < DIRT {
                rows[i].value += dice.sign() * DIRTY * rows[i].sigma;
            }
        }
    }
    rows.iter_mut().for_each(|row| row.sigma *= judged);
    rows.retain(|row| !left_out.contains(&row.trace));
}

/// The straight line through the points on both sides, flat beyond the ends.
fn between(curve: &[(f64, f64)], at: f64) -> f64 {
    let after = curve.partition_point(|p| p.0 < at);
    if after == 0 {
        return curve[0].1;
    }
    if after == curve.len() {
        return curve[after - 1].1;
    }
    let (a, b) = (curve[after - 1], curve[after]);
    a.1 + (b.1 - a.1) * (at - a.0) / (b.0 - a.0)
}
