//! `[numerics]`: how finely it is computed. An extension: every key is optional and a study without it is complete.

use std::path::{Path, PathBuf};

use super::materials::Lubricant;
use super::quantity as q;
use super::reader::Table;
use super::relative;
use crate::source_text::{Diagnostic, Fault};

pub(super) const KEYS: &[&str] = &[
    "order",
    "elements_per_half_width",
    "positions",
    "step_tolerance",
    "fields",
    "friction",
    "mesh_pinion",
    "mesh_gear",
    "stored_states",
];

/// Resolution and options of the computation.
#[derive(Debug, Clone, PartialEq)]
pub struct Numerics {
    /// Shape functions of the triangles.
    pub order: Order,
    /// Flank elements on the smallest Hertz half width.
    pub elements_per_half_width: usize,
    /// Whether the study states that number; one run may take fewer where it would ask for too many unknowns if not.
    pub edges_stated: bool,
    /// Mesh positions on one base pitch.
    pub positions: usize,
    /// Relative error allowed in one wear step.
    pub step_tolerance: f64,
    /// Mesh positions whose stress fields are written.
    pub fields: usize,
    /// Whether the contact has Coulomb friction (with `lubricant.friction_coefficient`).
    pub friction: bool,
    /// A user's own mesh of the pinion.
    pub mesh_pinion: Option<PathBuf>,
    /// A user's own mesh of the gear.
    pub mesh_gear: Option<PathBuf>,
    /// Worn states that are kept and written.
    pub stored_states: usize,
}

/// Order of the triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// Three nodes.
    Linear,
    /// Six nodes.
    Quadratic,
}

impl Default for Numerics {
    fn default() -> Self {
        Self {
            order: Order::Quadratic,
            elements_per_half_width: 5,
            edges_stated: false,
            positions: 100,
            step_tolerance: 2e-3,
            fields: 4,
            friction: false,
            mesh_pinion: None,
            mesh_gear: None,
            stored_states: 5,
        }
    }
}

type Result<T> = std::result::Result<T, Box<Diagnostic>>;

pub(super) fn read(
    root: &Table<'_>,
    folder: &Path,
    lubricant: Option<Lubricant>,
) -> Result<Numerics> {
    let default = Numerics::default();
    let Some(table) = root.table("numerics", KEYS)? else {
        return Ok(default);
    };
    let order = match table.count("order", 1..=2, "1: linear triangles, 2: quadratic ones")? {
        Some(1) => Order::Linear,
        _ => Order::Quadratic,
    };
    let mesh = |key| {
        table
            .name(key, "relative to the study file")
            .map(|file| file.map(|file| relative::joined(folder, Path::new(file))))
    };
    let edges = table.count(
        "elements_per_half_width",
        1..=64,
        "flank elements on the smallest Hertz half width; 5 is the default",
    )?;
    let numerics = Numerics {
        order,
        elements_per_half_width: edges.unwrap_or(default.elements_per_half_width),
        edges_stated: edges.is_some(),
        positions: table
            .count(
                "positions",
                8..=5000,
                "mesh positions on one base pitch; the cost grows with it",
            )?
            .unwrap_or(default.positions),
        step_tolerance: table
            .number("step_tolerance", &q::STEP_TOLERANCE)?
            .unwrap_or(default.step_tolerance),
        fields: table
            .count("fields", 0..=500, "each writes a file per member")?
            .unwrap_or(default.fields),
        friction: table.flag("friction")?.unwrap_or(default.friction),
        mesh_pinion: mesh("mesh_pinion")?,
        mesh_gear: mesh("mesh_gear")?,
        stored_states: table
            .count(
                "stored_states",
                1..=10_000,
                "worn states that are kept and written",
            )?
            .unwrap_or(default.stored_states),
    };
    if numerics.friction
        && lubricant
            .and_then(|lubricant| lubricant.friction_coefficient)
            .is_none()
    {
        let mut refusal = table.refuse(
            "friction",
            "needs a coefficient",
            "false, or true with lubricant.friction_coefficient",
        );
        refusal.fault = Fault::Inconsistent;
        return Err(Box::new(
            refusal.with_hint("state friction_coefficient in [lubricant]"),
        ));
    }
    Ok(numerics)
}
