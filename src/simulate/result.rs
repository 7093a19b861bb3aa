//! The result of one run as plain data: what the solver hands over and the report writes down.
//!
//! ```text
//! Run ── Conditions, Geometry, MeshSummary, Cost, Check          what was computed, and at what price
//!  ├─ states: State (one per stored wear state, by ascending cycles; the first is the unworn one)
//!  │    ├─ pinion, gear: Profile     depth along the loaded flank of an average tooth
//!  │    └─ cycle: PositionState      one base pitch of mesh positions, each with its touching PairState
//!  └─ fields: FieldFrame (what is drawn in ParaView: one wear state at one mesh position, both members)
//! ```
//!
//! Nothing here computes physics; the methods pick a value out of the data.

mod fields;
mod made;
mod state;

pub use fields::{FieldFrame, MemberField};
pub use made::{Friction, LossFriction, Made, MadeWheel};
pub use state::{FaceSlice, PairState, PositionState, Profile, Sliding, State, ToothClass};

/// Which wheel of the pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Member {
    /// The driving pinion.
    Pinion,
    /// The driven gear.
    Gear,
}

impl Member {
    /// Both members, the pinion first.
    pub const BOTH: [Member; 2] = [Member::Pinion, Member::Gear];

    /// The name used in files: `pinion` or `gear`.
    pub fn name(self) -> &'static str {
        match self {
            Member::Pinion => "pinion",
            Member::Gear => "gear",
        }
    }
}

/// Everything one run found.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Free text of the study.
    pub title: String,
    /// What was asked for.
    pub conditions: Conditions,
    /// Working geometry of the pair.
    pub geometry: Geometry,
    /// How the gears are made.
    pub made: Made,
    /// Pinion's and gear's mesh; none for a model without one.
    pub mesh: Option<[MeshSummary; 2]>,
    /// Stored wear states by ascending cycles; never empty, the first is where the run began.
    pub states: Vec<State>,
    /// Fields to be drawn, by ascending cycles, then position; empty for a model without a mesh.
    pub fields: Vec<FieldFrame>,
    /// Largest tensile stress in the loaded fillet of pinion and gear, worn as in the last state; none for a model without a mesh.
    pub root_stress: Option<[RootStress; 2]>,
    /// Relative gap between the worn area of the flanks and the area the wear law removed (Reye balance), both members.
    pub balance_error: f64,
    /// Further checks the run made on itself.
    pub checks: Vec<Check>,
    /// What the run cost.
    pub cost: Cost,
}

impl Run {
    /// The first stored state. A run without one has no meaning: `states` is never empty.
    pub fn first(&self) -> &State {
        &self.states[0]
    }

    /// The last stored state.
    pub fn last(&self) -> &State {
        &self.states[self.states.len() - 1]
    }

    /// Secant stiffness of a single tooth pair per width, N/(mm·µm), at the single-contact position nearest to the pitch point.
    ///
    /// ```text
    /// k = F' / δ,   δ = r_b1 θ      F' N/mm line load of the pair, θ rad lag seen at the pinion, δ approach
    /// ```
    /// Taken from the first state and only if that is unworn, since later angles contain worn material. None when no
    /// position has just one loaded pair (contact ratio of 2 and more), and for helical gears, whose slices are at different places at a time.
    pub fn single_pair_stiffness(&self) -> Option<f64> {
        let first = self.first();
        if first.cycles > 0.0 || self.geometry.helix.is_some() {
            return None;
        }
        let from_pitch_point = |p: &PositionState| (p.position - p.position.round()).abs();
        first
            .cycle
            .iter()
            .filter(|p| p.angle_urad > 0.0 && p.loaded().count() == 1)
            .min_by(|a, b| from_pitch_point(a).total_cmp(&from_pitch_point(b)))
            .map(|p| p.line_load() / (self.geometry.pinion.base_radius * p.angle_urad * 1e-3))
    }
}

/// What a run was asked to do.
#[derive(Debug, Clone, PartialEq)]
pub struct Conditions {
    /// Id of the test whose conditions these are; none for those of `[operation]`.
    pub test: Option<String>,
    /// Contact model: `fem`, `hertz` or `paper`.
    pub model: String,
    /// Physical effects added to the base model, each as its name with parameter values.
    pub effects: Vec<String>,
    /// Pinion torque, N mm.
    pub torque: f64,
    /// Pinion speed, rpm.
    pub speed_rpm: f64,
    /// Radial misalignment added to the centre distance, mm.
    pub misalignment: f64,
    /// Specific wear coefficient k of pinion and gear, mm²/N.
    pub wear_coefficient: [f64; 2],
    /// Pinion revolutions asked for.
    pub cycles: f64,
    /// Face width, mm.
    pub face_width: f64,
    /// Young's modulus of pinion and gear, MPa.
    pub youngs_modulus: [f64; 2],
    /// Poisson's ratio of pinion and gear.
    pub poisson_ratio: [f64; 2],
    /// Density of pinion and gear, kg/m³.
    pub density: [f64; 2],
    /// Which friction was used.
    pub friction: Friction,
    /// Temperatures of flank and root where friction losses make them (VDI 2736 part 2), °C.
    pub warmed_teeth_c: Option<[f64; 2]>,
}

/// Working geometry of the pair at the centre distance of the run.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    /// Module, of helical gears that of the normal section, mm.
    pub module: f64,
    /// Pressure angle at the reference circle, of helical gears that of the normal section, degrees.
    pub pressure_angle_deg: f64,
    /// What helical gears have besides; none: spur gears.
    pub helix: Option<Helix>,
    /// Centre distance in operation (misalignment included), mm.
    pub centre_distance: f64,
    /// Working pressure angle, degrees.
    pub working_pressure_angle_deg: f64,
    /// Transverse contact ratio.
    pub contact_ratio: f64,
    /// Length of the path of contact, mm.
    pub path_of_contact: f64,
    /// Base pitch, mm.
    pub base_pitch: f64,
    /// Circumferential backlash at the working pitch circles, µm.
    pub backlash_um: f64,
    /// Speed ratio, pinion over gear.
    pub speed_ratio: f64,
    /// Signed distances along the path of contact from the pitch point, mm: start A, lower end of single contact B,
    /// upper end of single contact D, end E (B lies above D for a contact ratio above 2).
    pub path_limits: [f64; 4],
    /// The pinion.
    pub pinion: WheelGeometry,
    /// The gear.
    pub gear: WheelGeometry,
}

/// What helical gears have besides. Lengths and angles elsewhere are those of the transverse section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Helix {
    /// Helix angle of the pinion at its reference circle, degrees, positive: right-handed.
    pub angle_deg: f64,
    /// Helix angle at the base circles, degrees.
    pub base_angle_deg: f64,
    /// Module of the transverse section, mm.
    pub transverse_module: f64,
    /// Pressure angle of the transverse section, degrees.
    pub transverse_pressure_angle_deg: f64,
    /// Overlap ratio ε_β.
    pub overlap_ratio: f64,
    /// How far along the face a slice may be off its place because it stands at a mesh position, mm.
    pub placed_within: f64,
}

impl Geometry {
    /// Total contact ratio ε_γ = ε_α + ε_β; of spur gears ε_α.
    pub fn total_contact_ratio(&self) -> f64 {
        self.contact_ratio + self.helix.map_or(0.0, |helix| helix.overlap_ratio)
    }
}

/// Radii of one wheel, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct WheelGeometry {
    /// Number of teeth.
    pub teeth: u32,
    /// Profile shift, in modules.
    pub profile_shift: f64,
    /// Base radius, mm.
    pub base_radius: f64,
    /// Working pitch radius, mm.
    pub pitch_radius: f64,
    /// Tip radius, mm.
    pub tip_radius: f64,
    /// Root radius, mm.
    pub root_radius: f64,
    /// Form radius, where the involute begins, mm.
    pub form_radius: f64,
    /// Smallest radius of the flank that the mate reaches on the nominal path of contact, mm.
    pub active_radius: f64,
    /// Bore radius, mm.
    pub bore_radius: f64,
}

/// One member's mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshSummary {
    /// Element type, `T6` or `T3`.
    pub element: String,
    /// Nodes.
    pub nodes: usize,
    /// Elements.
    pub elements: usize,
    /// Unknowns of the linear system.
    pub dof: usize,
    /// Smallest angle of any element, degrees.
    pub min_angle_deg: f64,
    /// Largest length of a flank edge within the contact zone, mm.
    pub flank_spacing: f64,
    /// Such edges on Hertz's half width at the pitch point of the new flanks.
    pub edges_per_half_width: f64,
}

/// The largest first principal stress in the fillet on the loaded side of a tooth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RootStress {
    /// First principal stress, MPa.
    pub stress: f64,
    /// Radius of the place, mm.
    pub radius: f64,
    /// Where the tooth is loaded then: path coordinate of its contact, mm from the pitch point.
    pub path: f64,
}

/// A check a run made on itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Check {
    /// What was checked, in words.
    pub name: String,
    /// The figure found.
    pub value: f64,
    /// The largest figure allowed.
    pub limit: f64,
    /// Unit of both; `-` for a ratio.
    pub unit: String,
}

impl Check {
    /// True if the value is a number no larger than the limit.
    pub fn passed(&self) -> bool {
        self.value <= self.limit
    }
}

/// What a run cost.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Cost {
    /// Wall clock time, s.
    pub seconds: f64,
    /// Numerical factorisations.
    pub factorisations: usize,
    /// Contact problems solved.
    pub contact_solves: usize,
    /// Accepted wear steps.
    pub wear_steps: usize,
    /// Largest memory in use, MB (10⁶ bytes); none where the system does not tell.
    pub peak_memory_mb: Option<f64>,
    /// Threads used.
    pub threads: usize,
    /// Wall clock time of each stage, s, in the order they ran.
    pub stages: Vec<(String, f64)>,
}
