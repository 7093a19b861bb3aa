//! Fields of both members for drawing.

use super::Member;
use crate::mesh::Cells;

/// Both members at one wear state and mesh position, for drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldFrame {
    /// Pinion revolutions so far.
    pub cycles: f64,
    /// Pinion rotation from the pitch point, in base pitches.
    pub position: f64,
    /// Sum of the pairs' line loads at this position as the contact solution has it, N/mm.
    pub line_load: f64,
    /// Torque per face width on the pinion, N mm/mm.
    pub torque_per_width: f64,
    /// The pinion.
    pub pinion: MemberField,
    /// The gear.
    pub gear: MemberField,
}

impl FieldFrame {
    /// The field of `member`.
    pub fn member(&self, member: Member) -> &MemberField {
        match member {
            Member::Pinion => &self.pinion,
            Member::Gear => &self.gear,
        }
    }
}

/// One member's fields. All per-node columns have one entry per node; vectors and tensors stand in the member's own frame.
///
/// A point x of the member frame lies at `centre + R(rotation) x` of the fixed frame, R the counter-clockwise turn.
#[derive(Debug, Clone, PartialEq)]
pub struct MemberField {
    /// Centre of the member in the fixed frame, mm.
    pub centre: [f64; 2],
    /// Turn of the member frame against the fixed one, rad, counter-clockwise, before loading.
    pub rotation: f64,
    /// Unworn node positions, mm.
    pub reference: Vec<[f64; 2]>,
    /// Node positions with the worn material removed, not loaded, mm.
    pub worn: Vec<[f64; 2]>,
    /// Triangles.
    pub cells: Cells,
    /// Displacement under load from `worn`, mm; contains the turn of the pinion's bore.
    pub displacement: Vec<[f64; 2]>,
    /// Stress xx, yy, xy, zz, MPa.
    pub stress: Vec<[f64; 4]>,
    /// Von Mises stress, MPa.
    pub von_mises: Vec<f64>,
    /// Contact pressure, MPa; 0 off the contact. Interpolated along the flank edges by the elements' own shape functions
    /// (quadratic for T6) its integral is the line load.
    pub contact_pressure: Vec<f64>,
    /// Consistent nodal force of the contact on this member, N per mm of width; the sum is the whole contact force.
    pub contact_force: Vec<[f64; 2]>,
    /// Worn depth normal to the flank, µm; 0 off the loaded flanks.
    pub wear_depth: Vec<f64>,
}
