//! Floor 1: gear geometry: basic rack, tooth flanks, working pair, path of contact.
//!
//! Member frame: the gear's centre at the origin, tooth 0 centred on the +x axis, teeth numbered counter-clockwise.
//! The loaded flank is the counter-clockwise flank of each tooth (for both members; the gear's own frame is turned by
//! 180° against the fixed one). A point of the involute is named by its radius of curvature `rho`, mm: the distance to the
//! base circle along the tangent, so that r² = r_b² + rho² and the arc length along the involute is rho²/(2 r_b).
//!
//! ```text
//! BasicRack + ToothSpec -> Gear (one member) -> Pair (two members at a centre distance) -> cycle (who touches when)
//!                      Gear + depth along the arc -> WornFlank
//! ```
//!
//! A [`Gear`] or [`Pair`] that exists is possible: what cannot be cut or cannot mesh is refused with the values and the
//! limits. Of helical gears all of this is the transverse section; the helix angle says how sections stand turned along the face. Not in
//! here: internal teeth.

mod cycle;
mod error;
mod fillet;
mod helix;
mod involute;
mod lead;
mod outline;
mod pair;
mod rack;
mod teeth;
mod thickness;
mod tip;
mod tooth;
mod worn_flank;

pub use cycle::{Region, ToothContact, contacts_at};
pub use error::{GearError, PairError};
pub use fillet::Trochoid;
pub use involute::{inv, inverse_inv};
pub use lead::{Coupling, Face, FaceEnds, Lead};
pub use outline::{ProfileResolution, polygon_area};
pub use pair::{JAM_TOLERANCE, Pair};
pub use rack::BasicRack;
pub use teeth::{Hunting, Teeth, ToothClasses, common_factor};
pub use thickness::{ThicknessLoss, WornDepths};
pub use tip::TipRounding;
pub use tooth::{Gear, MIN_TEETH, ToothSpec};
pub use worn_flank::{Thinnest, WornFlank};

/// One of the two members of a pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Member {
    /// The driving member, by convention the small one.
    Pinion,
    /// The driven member.
    Gear,
}

impl Member {
    /// Both members, the pinion first.
    pub const BOTH: [Member; 2] = [Member::Pinion, Member::Gear];

    /// The mate.
    pub fn other(self) -> Member {
        match self {
            Member::Pinion => Member::Gear,
            Member::Gear => Member::Pinion,
        }
    }

    /// `"pinion"` or `"gear"`, as in the measurement and result files.
    pub fn name(self) -> &'static str {
        match self {
            Member::Pinion => "pinion",
            Member::Gear => "gear",
        }
    }
}

impl std::fmt::Display for Member {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}
