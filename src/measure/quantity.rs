//! What is measured, on what, and where.

use crate::gear::Member;
use crate::numeric::written;

/// What a row was measured on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Subject {
    /// The pinion.
    Pinion,
    /// The gear.
    Gear,
    /// Both together.
    Pair,
}

impl Subject {
    /// All of them.
    pub const ALL: [Subject; 3] = [Subject::Pinion, Subject::Gear, Subject::Pair];

    /// Its name in the file.
    pub fn name(self) -> &'static str {
        match self {
            Subject::Pinion => "pinion",
            Subject::Gear => "gear",
            Subject::Pair => "pair",
        }
    }

    /// The other member; both together stay both.
    pub fn other(self) -> Self {
        match self {
            Subject::Pinion => Subject::Gear,
            Subject::Gear => Subject::Pinion,
            Subject::Pair => Subject::Pair,
        }
    }

    /// The one member it is, if it is one.
    pub fn member(self) -> Option<Member> {
        match self {
            Subject::Pinion => Some(Member::Pinion),
            Subject::Gear => Some(Member::Gear),
            Subject::Pair => None,
        }
    }
}

impl From<Member> for Subject {
    fn from(member: Member) -> Self {
        match member {
            Member::Pinion => Self::Pinion,
            Member::Gear => Self::Gear,
        }
    }
}

/// A measured quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Quantity {
    /// Material lost normal to the flank, µm.
    WearDepth,
    /// Gear angle minus its ideal angle, the mean over the base pitch removed, µrad; a lagging gear is negative.
    TransmissionError,
    /// Mass lost by the whole member, mg.
    MassLoss,
    /// Share of the load on one tooth pair.
    LoadShare,
    /// Largest pressure that a point sees in a passage, MPa.
    ContactPressure,
    /// Load per width over approach, N/(mm·µm).
    MeshStiffness,
    /// Change since the start of the mean lag over a base pitch, seen at the pinion, µrad: what wear alone has opened, at the test's load.
    MeanLag,
    /// What the base tangent length over so many teeth has lost, µm: flat anvils, of which one rests on a worn flank.
    SpanLoss,
    /// What the chord of a tooth at a circle has lost, µm: one of its flanks is worn.
    ChordalLoss,
}

/// What the `position` of a quantity means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// A radius on the member's flank, mm.
    Flank,
    /// Pinion rotation from the pitch point, in base pitches, 0 to 1.
    Rotation,
    /// The number of teeth that a span goes over.
    Span,
    /// The whole member or the pair: no position.
    Whole,
}

/// What a unit slip looks like: magnitudes above `above` (all of them), or all of them below `below`.
pub(super) struct Magnitude {
    /// No value may be larger.
    pub(super) above: f64,
    /// The unit that larger values hint at.
    pub(super) larger: &'static str,
    /// Not all values and 50 times all sigmas may be smaller (0: no such limit).
    pub(super) below: f64,
    /// The unit that smaller values hint at.
    pub(super) smaller: &'static str,
}

impl Quantity {
    /// All of them.
    pub const ALL: [Quantity; 9] = [
        Quantity::WearDepth,
        Quantity::TransmissionError,
        Quantity::MassLoss,
        Quantity::LoadShare,
        Quantity::ContactPressure,
        Quantity::MeshStiffness,
        Quantity::MeanLag,
        Quantity::SpanLoss,
        Quantity::ChordalLoss,
    ];

    /// Its name in the file.
    pub fn name(self) -> &'static str {
        match self {
            Quantity::WearDepth => "wear_depth",
            Quantity::TransmissionError => "transmission_error",
            Quantity::MassLoss => "mass_loss",
            Quantity::LoadShare => "load_share",
            Quantity::ContactPressure => "contact_pressure",
            Quantity::MeshStiffness => "mesh_stiffness",
            Quantity::MeanLag => "mean_lag",
            Quantity::SpanLoss => "span_loss",
            Quantity::ChordalLoss => "chordal_loss",
        }
    }

    /// Its unit as people read it.
    pub fn shown_unit(self) -> String {
        written::unit(self.unit())
    }

    /// Its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Quantity::WearDepth | Quantity::SpanLoss | Quantity::ChordalLoss => "um",
            Quantity::TransmissionError | Quantity::MeanLag => "urad",
            Quantity::MassLoss => "mg",
            Quantity::LoadShare => "1",
            Quantity::ContactPressure => "MPa",
            Quantity::MeshStiffness => "N/(mm um)",
        }
    }

    /// The unit without brackets, as a header may state it.
    pub(super) fn plain_unit(self) -> &'static str {
        match self {
            Quantity::LoadShare => "-",
            Quantity::MeshStiffness => "N/mm/um",
            other => other.unit(),
        }
    }

    /// Whether it is nearly proportional to the wear.
    pub fn is_wear(self) -> bool {
        matches!(
            self,
            Quantity::WearDepth
                | Quantity::MassLoss
                | Quantity::MeanLag
                | Quantity::SpanLoss
                | Quantity::ChordalLoss
        )
    }

    /// Whether a row's place across the face says where it was measured: what is of the whole face has no such place.
    pub fn is_at_a_place_across_the_face(self) -> bool {
        matches!(
            self,
            Quantity::WearDepth
                | Quantity::ContactPressure
                | Quantity::SpanLoss
                | Quantity::ChordalLoss
        )
    }

    /// What its position means.
    pub fn place(self) -> Place {
        match self {
            Quantity::WearDepth
            | Quantity::LoadShare
            | Quantity::ContactPressure
            | Quantity::ChordalLoss => Place::Flank,
            Quantity::SpanLoss => Place::Span,
            Quantity::TransmissionError | Quantity::MeshStiffness => Place::Rotation,
            Quantity::MassLoss | Quantity::MeanLag => Place::Whole,
        }
    }

    /// On what it can be measured.
    pub fn subjects(self) -> &'static [Subject] {
        match self.place() {
            _ if self == Quantity::MeanLag => &[Subject::Pair],
            Place::Flank | Place::Span | Place::Whole => &[Subject::Pinion, Subject::Gear],
            Place::Rotation => &[Subject::Pair],
        }
    }

    /// Magnitudes that betray another unit; `depth_limit` is that of the wear depth, µm.
    pub(super) fn magnitude(self, depth_limit: f64) -> Magnitude {
        let limits = |above, larger, below, smaller| Magnitude {
            above,
            larger,
            below,
            smaller,
        };
        match self {
            Quantity::WearDepth | Quantity::SpanLoss => limits(depth_limit, "nm", 0.05, "mm"),
            Quantity::ChordalLoss => limits(2.0 * depth_limit, "nm", 0.05, "mm"),
            Quantity::TransmissionError => limits(1e5, "nrad", 0.05, "rad"),
            Quantity::MassLoss => limits(f64::INFINITY, "", 0.0, ""),
            Quantity::LoadShare => limits(2.0, "percent", 0.0, ""),
            Quantity::ContactPressure => limits(3e4, "Pa or kPa", 5.0, "GPa"),
            Quantity::MeshStiffness => limits(1e3, "N/mm per mm", 0.0, ""),
            Quantity::MeanLag => limits(1e6, "nrad", 0.0, ""),
        }
    }
}
