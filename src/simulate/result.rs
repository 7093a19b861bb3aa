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
use crate::mesh::Cells;

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
    /// position has just one loaded pair (contact ratio of 2 and more).
    pub fn single_pair_stiffness(&self) -> Option<f64> {
        let first = self.first();
        if first.cycles > 0.0 {
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
}

/// Working geometry of the pair at the centre distance of the run.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    /// Module, mm.
    pub module: f64,
    /// Pressure angle at the reference circle, degrees.
    pub pressure_angle_deg: f64,
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

/// One stored wear state.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Pinion revolutions so far.
    pub cycles: f64,
    /// Worn flank of the pinion.
    pub pinion: Profile,
    /// Worn flank of the gear.
    pub gear: Profile,
    /// Mesh positions over one base pitch, ascending.
    pub cycle: Vec<PositionState>,
    /// Slices across the face, ascending; empty where one section stands for all of it. Flanks and mesh cycle are then the mean over the
    /// face, pressures and widths of contact those of the slice where they are largest.
    pub slices: Vec<FaceSlice>,
}

/// One slice of the face in one state.
#[derive(Debug, Clone, PartialEq)]
pub struct FaceSlice {
    /// Middle of the slice from mid-face, mm.
    pub face: f64,
    /// Load per width over the mean of the face, the mean over the mesh cycle.
    pub load: f64,
    /// Largest contact pressure on the flanks over the mesh cycle, corners left out, MPa.
    pub peak_pressure: f64,
    /// Depth of pinion and gear at the radii of their profiles, µm.
    pub depth: [Vec<f64>; 2],
    /// The largest pressure that these points see in a passage, MPa.
    pub pressure: [Vec<f64>; 2],
}

impl State {
    /// The flank of `member`.
    pub fn profile(&self, member: Member) -> &Profile {
        match member {
            Member::Pinion => &self.pinion,
            Member::Gear => &self.gear,
        }
    }

    /// The largest depth of `member` on any slice of the face, µm, and the middle of that slice, mm from mid-face; None for one section.
    pub fn deepest_on_the_face(&self, member: Member) -> Option<(f64, f64)> {
        let side = usize::from(member == Member::Gear);
        let deepest = |slice: &FaceSlice| slice.depth[side].iter().copied().fold(0.0, f64::max);
        (self.slices.iter().map(|slice| (deepest(slice), slice.face)))
            .max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Load per width of the slice that carries most over the mean of the face (K_Hβ), the mean over the mesh cycle; 1 for one section.
    pub fn face_load_factor(&self) -> f64 {
        (self.slices.iter().map(|slice| slice.load))
            .reduce(f64::max)
            .unwrap_or(1.0)
    }

    /// The largest contact pressure on the flanks over the mesh cycle, MPa, and the path coordinate of the pair that bears it,
    /// mm; pairs that touch with a tip corner are left to [`State::corner_pressure`].
    pub fn peak_pressure(&self) -> Option<(f64, f64)> {
        self.largest_pressure(false)
    }

    /// The largest pressure over the mesh cycle where a tip corner or the end of a flank touches, MPa, and the path coordinate
    /// of that pair, mm; none if none does.
    ///
    /// The pressure under a sharp corner of an elastic body has no bound: by finite elements this is the mean over 0.02 modules, which says how hard a
    /// corner digs in whatever the mesh.
    pub fn corner_pressure(&self) -> Option<(f64, f64)> {
        self.largest_pressure(true)
    }

    fn largest_pressure(&self, at_corner: bool) -> Option<(f64, f64)> {
        self.pairs()
            .filter(|pair| pair.line_load > 0.0 && pair.at_corner == at_corner)
            .map(|pair| (pair.peak_pressure, pair.path))
            .max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Largest minus smallest angle of the mesh cycle, µrad (transmission error, peak to peak, at the pinion).
    pub fn te_peak_to_peak_urad(&self) -> Option<f64> {
        let angles = || self.cycle.iter().map(|p| p.angle_urad);
        let high = angles().max_by(f64::total_cmp)?;
        let low = angles().min_by(f64::total_cmp)?;
        Some(high - low)
    }

    /// The smallest film ratio over the mesh cycle and the path coordinate of that pair, mm.
    pub fn least_film_ratio(&self) -> Option<(f64, f64)> {
        let ratios = self
            .pairs()
            .filter_map(|p| Some((p.sliding.film_ratio?, p.path)));
        ratios.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The largest rise of the contact temperature over the mesh cycle, K, and the path coordinate of that pair, mm.
    pub fn largest_flash_temperature(&self) -> Option<(f64, f64)> {
        let rises = self
            .pairs()
            .filter_map(|p| Some((p.sliding.flash_temperature?, p.path)));
        rises.max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Mean power that friction between the teeth takes over the mesh cycle, W; none where no friction follows from the study.
    pub fn friction_power(&self) -> Option<f64> {
        let powers = self.pairs().filter_map(|p| p.sliding.power);
        let sum = powers.fold(None, |sum: Option<f64>, power| {
            Some(sum.unwrap_or(0.0) + power)
        })?;
        Some(sum / self.cycle.len() as f64)
    }

    /// All pairs of all positions.
    pub fn pairs(&self) -> impl Iterator<Item = &PairState> {
        self.cycle.iter().flat_map(|position| &position.pairs)
    }
}

/// Worn depth along the loaded flank of an average tooth; the three columns have equal length, radius ascending.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Profile {
    /// Radius, mm.
    pub radius: Vec<f64>,
    /// Signed distance along the path of contact from the pitch point, mm.
    pub path: Vec<f64>,
    /// Depth normal to the flank, µm, positive for material lost.
    pub depth: Vec<f64>,
    /// Worn area of one tooth in the transverse plane, mm².
    pub worn_area_mm2: f64,
    /// Mass lost by the loaded flanks of all teeth over the whole face width, mg.
    pub mass_loss_mg: f64,
}

impl Profile {
    /// Index of the deepest point; none for an empty profile.
    pub fn deepest(&self) -> Option<usize> {
        (0..self.depth.len()).max_by(|&i, &j| self.depth[i].total_cmp(&self.depth[j]))
    }

    /// Largest depth, µm (0 for an empty profile).
    pub fn max_depth(&self) -> f64 {
        self.deepest().map_or(0.0, |i| self.depth[i])
    }
}

/// One mesh position of one state.
#[derive(Debug, Clone, PartialEq)]
pub struct PositionState {
    /// Pinion rotation from the pitch point, in base pitches.
    pub position: f64,
    /// Lag of the gear under load seen at the pinion, µrad, positive, worn material included.
    pub angle_urad: f64,
    /// Candidate tooth pairs.
    pub pairs: Vec<PairState>,
}

impl PositionState {
    /// Pairs that carry load.
    pub fn loaded(&self) -> impl Iterator<Item = &PairState> {
        self.pairs.iter().filter(|pair| pair.line_load > 0.0)
    }

    /// Sum of the pairs' line loads, N/mm.
    pub fn line_load(&self) -> f64 {
        self.pairs.iter().map(|pair| pair.line_load).sum()
    }
}

/// One tooth pair at one mesh position.
#[derive(Debug, Clone, PartialEq)]
pub struct PairState {
    /// Number of the pair; 0 meets at the pitch point at position 0.
    pub pair: i32,
    /// Centre of its contact along the path of contact from the pitch point, mm.
    pub path: f64,
    /// Share of the torque this pair carries, 0 to 1.
    pub load_share: f64,
    /// Normal load per face width (integral of the pressure), N/mm.
    pub line_load: f64,
    /// Largest pressure, MPa; by finite elements the largest mean over 0.02 modules where a contact is near the end of a flank.
    pub peak_pressure: f64,
    /// Half the width of the touching zone, mm.
    pub half_width: f64,
    /// True where the pair touches outside the nominal line of action (tip corner of a loaded tooth).
    pub off_line_of_action: bool,
    /// True where the pressure does not fade out on both flanks: it reaches the tip corner (or the form circle) of a flank, or
    /// the pair touches outside the line of action.
    pub at_corner: bool,
    /// What slides, heats and is lost there.
    pub sliding: Sliding,
}

/// Sliding of one tooth pair and what follows from it; none where the study does not state what it takes, or nothing is loaded.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sliding {
    /// Sliding speed, m/s.
    pub speed: f64,
    /// Smallest film thickness over the composite roughness; none at a tip corner.
    pub film_ratio: Option<f64>,
    /// Rise of the contact temperature over the bulk, K; none at a tip corner.
    pub flash_temperature: Option<f64>,
    /// Coefficient of friction.
    pub friction: Option<f64>,
    /// Power that friction takes over the face width, W.
    pub power: Option<f64>,
}

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
