//! The trait of a physical effect: hooks through which it changes a run, each neutral unless an effect says otherwise.

use super::local::{Local, ProfileAt};
use crate::gear::{Member, ToothClasses};

/// Where an effect acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Hook {
    /// [`Effect::wear_factor`]
    WearFactor,
    /// [`Effect::added_depth`]
    AddedDepth,
    /// [`Effect::load_factor`]
    LoadFactor,
    /// [`Effect::profile`]
    Profile,
    /// [`Effect::tooth_offset`]
    ToothOffset,
    /// [`Effect::operation`]
    Operation,
    /// [`Effect::compliance`]
    Compliance,
    /// [`Effect::friction`]
    Friction,
}

impl Hook {
    /// All hooks.
    pub const ALL: [Hook; 8] = [
        Hook::WearFactor,
        Hook::AddedDepth,
        Hook::LoadFactor,
        Hook::Profile,
        Hook::ToothOffset,
        Hook::Operation,
        Hook::Compliance,
        Hook::Friction,
    ];

    /// The left-hand side of a card's formula; for the first four also the key of a formula effect in the study.
    pub fn name(self) -> &'static str {
        match self {
            Hook::WearFactor => "wear_factor",
            Hook::AddedDepth => "added_depth",
            Hook::LoadFactor => "load_factor",
            Hook::Profile => "profile",
            Hook::ToothOffset => "tooth_offset",
            Hook::Operation => "added_centre_distance",
            Hook::Compliance => "compliance",
            Hook::Friction => "added_friction",
        }
    }

    /// What the hook's value is, with its unit.
    pub fn meaning(self) -> &'static str {
        match self {
            Hook::WearFactor => "factor on the wear coefficient",
            Hook::AddedDepth => "µm of depth per contact of that member",
            Hook::LoadFactor => "factor on the load of a tooth pair",
            Hook::Profile => "µm of material removed before the start",
            Hook::ToothOffset => "µm that a tooth stands back from its place",
            Hook::Operation => "mm added to the centre distance",
            Hook::Compliance => "mm·µm/N added to the flexibility of each tooth pair",
            Hook::Friction => "coefficient of friction between the flanks, added to the study's",
        }
    }

    /// Whether it changes how the teeth touch, and not only how what touches wears.
    pub fn changes_contact(self) -> bool {
        !matches!(self, Hook::WearFactor | Hook::AddedDepth)
    }

    /// What the hook gives where nothing acts.
    pub fn neutral(self) -> f64 {
        match self {
            Hook::WearFactor | Hook::LoadFactor => 1.0,
            _ => 0.0,
        }
    }
}

/// A physical effect with its parameters bound: a pure function of what its hooks are given.
pub trait Effect: Send + Sync {
    /// Factor on the wear coefficient at one flank point and instant; finite, not negative.
    fn wear_factor(&self, _at: &Local) -> f64 {
        1.0
    }

    /// Whether the wear factor is one number for a tooth pair's whole contact on one member: it then asks for no point's radius, depth or
    /// pressure, and is asked once for all of them.
    fn is_even(&self) -> bool {
        false
    }

    /// Depth lost besides sliding wear, µm per contact of that member; finite, not negative.
    ///
    /// Asked once per contact for every flank point, with the values at the instant when the contact's centre passes it;
    /// where nothing touches, `pressure` and `peak_pressure` are 0.
    fn added_depth(&self, _at: &Local) -> f64 {
        0.0
    }

    /// Factor f on the load of a tooth pair, above 0: its lever in the pinion's torque balance is `r_b1/f`.
    ///
    /// ```text
    /// Σ F_i r_b1/f_i = T1        a factor common to all pairs of a mesh position multiplies every load
    /// ```
    /// Asked before the contact is solved: pressures, half width and line load of `at` are 0.
    fn load_factor(&self, _at: &Local) -> f64 {
        1.0
    }

    /// Coefficient of Coulomb friction between the flanks of a tooth pair, added to that of the study; 0 or more.
    ///
    /// The pair slips as a whole: by finite elements the traction turns by it from the normal, which moves the lever of the
    /// torque and bends the teeth; analytically the lever alone moves. Asked before the contact is solved, as the load factor.
    fn friction(&self, _at: &Local) -> f64 {
        0.0
    }

    /// Material removed from a flank before the start, µm along the normal; negative where the flank stands proud.
    fn profile(&self, _at: &ProfileAt) -> f64 {
        0.0
    }

    /// How far a tooth stands back from its place, µm along the path of contact; negative where it stands proud.
    ///
    /// Where teeth differ each class of them wears for itself ([`crate::contact::sequence`]).
    fn tooth_offset(&self, _tooth: Tooth) -> f64 {
        0.0
    }

    /// What tells the tooth from others, whatever the size of the deviations: teeth with equal numbers have equal offsets.
    fn tooth_kind(&self, _tooth: Tooth) -> Vec<f64> {
        Vec::new()
    }

    /// Of which teeth of a member the wear is to be computed.
    fn tooth_classes(&self) -> ToothClasses {
        ToothClasses::Alike(usize::MAX)
    }

    /// Material missing across the face, µm along the path of contact on both flanks together. None: the effect knows nothing of the face.
    ///
    /// Where contacts are solved an effect that does acts through slices of the face ([`crate::contact::slices`]), and its load factor is
    /// not asked.
    fn lead(&self, _at: &FaceAt) -> Option<f64> {
        None
    }

    /// Where across the face a trace was taken that does not say; none: at mid-face.
    fn usual_trace(&self) -> Option<UsualTrace> {
        None
    }

    /// What load, speed and temperature do to the mounting.
    fn operation(&self, _state: &OperationState) -> OperationChange {
        OperationChange::default()
    }

    /// Flexibility added to each tooth pair, mm µm/N (deflection in µm per line load in N/mm).
    fn compliance(&self) -> f64 {
        0.0
    }

    /// Through which hook it acts with its values, where that is not the one that its card names.
    fn acts_through(&self) -> Option<Hook> {
        None
    }

    /// Whose measured tooth alone it concerns, if it does: the member's other teeth meet the mate otherwise, so that the mate, masses and what is
    /// read of the mesh are as without it, to first order.
    fn of_measured_tooth(&self) -> Option<Member> {
        None
    }

    /// Whether `added_depth` only displaces material, so that the member loses depth and no mass.
    fn keeps_mass(&self) -> bool {
        false
    }

    /// Why values since the effect was built are not to be trusted, if so. Built-in effects have no such reason; a user's
    /// formula that gave no finite number has, and the run must then end with it.
    fn fault(&self) -> Option<String> {
        None
    }

    /// The parameter whose value does not fit the others, if one does not: a study may not state it.
    fn impossible(&self) -> Option<Impossible> {
        None
    }
}

/// A value of a parameter that contradicts the others.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Impossible {
    /// Name of the parameter.
    pub parameter: &'static str,
    /// What is wrong, after "offset = 60".
    pub why: &'static str,
    /// What would be right, with the unit.
    pub allowed: String,
    /// What may be meant.
    pub hint: &'static str,
}

/// A place across the face, and the load that bends what carries it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaceAt {
    /// From the middle of the face, in half face widths, −1 to 1.
    pub place: f64,
    /// Face width, mm.
    pub width: f64,
    /// Normal force of all pairs together, N.
    pub normal_force: f64,
}

/// Where across the face traces are taken that do not say: at one place, as a mean over the face, or a blend of both.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct UsualTrace {
    /// From the middle of the face, in half face widths.
    pub place: f64,
    /// Share of the mean over the face in what is measured, 0 to 1.
    pub mean: f64,
}

/// A tooth of a member.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tooth {
    /// Whose.
    pub member: Member,
    /// Its number in the order in which teeth come into mesh: 0 is the measured one, or that labelled 1.
    pub number: usize,
    /// How many there are.
    pub of: usize,
}

impl Tooth {
    /// Its number counted from the measured one, the nearer way round: from −(z−1)/2 to z/2.
    pub fn from_measured(self) -> i64 {
        let number = self.number as i64;
        if 2 * self.number > self.of {
            number - self.of as i64
        } else {
            number
        }
    }
}

/// Conditions of a whole run or test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OperationState {
    /// Pinion torque, N·m.
    pub torque: f64,
    /// Pinion speed, rpm.
    pub speed: f64,
    /// Normal force of all pairs together, N.
    pub normal_force: f64,
    /// Operating pressure angle, rad.
    pub working_pressure_angle: f64,
    /// Centre distance before the change, mm.
    pub centre_distance: f64,
    /// Bulk temperature, °C; 20 where the study states none.
    pub bulk_temperature: f64,
}

impl OperationState {
    /// Power of the pinion, kW.
    pub fn power(&self) -> f64 {
        self.torque * self.speed * std::f64::consts::TAU / 60.0 * 1e-3
    }
}

/// What an effect changes about the mounting.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct OperationChange {
    /// Added to the centre distance, mm.
    pub centre_distance: f64,
}
