//! Several effects at once: factors multiply, depths and lengths add, in the order in which they were put in.

use super::effect::{Effect, FaceAt, Hook, OperationChange, OperationState, Tooth, UsualTrace};
use super::local::{Local, ProfileAt};
use crate::gear::{Member, ToothClasses};

/// The effects of one model.
#[derive(Default)]
pub struct Combined {
    entries: Vec<(Hook, Box<dyn Effect>)>,
    ignores_surroundings: bool,
}

/// Share of the largest lead up to which one off the straight line between its ends is rounding.
const STRAIGHT: f64 = 1e-9;

impl Combined {
    /// Adds an effect that acts through `hook`, unless it says itself that with its values it acts through another.
    pub fn push(&mut self, hook: Hook, effect: Box<dyn Effect>) {
        let hook = effect.acts_through().unwrap_or(hook);
        self.entries.push((hook, effect));
    }

    /// The members of which an effect concerns the measured tooth alone.
    pub fn measured_teeth(&self) -> Vec<Member> {
        let concerns = |member: &Member| {
            let mut each = self.entries.iter();
            each.any(|(_, effect)| effect.of_measured_tooth() == Some(*member))
        };
        Member::BOTH.into_iter().filter(concerns).collect()
    }

    /// The effects that the measured tooth of a member feels; None: without all that concerns measured teeth alone.
    pub fn felt_by(mut self, measured: Option<Member>) -> Self {
        self.entries.retain(|(_, effect)| {
            let alone = effect.of_measured_tooth();
            alone.is_none() || alone == measured
        });
        self
    }

    /// Says that none of the effects asks for film, friction or temperature, which then need not be worked out.
    pub fn ignore_surroundings(&mut self) {
        self.ignores_surroundings = true;
    }

    /// Whether an effect may ask for film, friction or temperature.
    pub fn feels_surroundings(&self) -> bool {
        !self.ignores_surroundings
    }

    /// Whether any effect acts through `hook`; if not, the hook need not be asked.
    pub fn acts(&self, hook: Hook) -> bool {
        self.of(hook).next().is_some()
    }

    /// Number of effects.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Depth added, µm per contact, by effects that remove material and by those that only displace it.
    pub fn added_depths(&self, at: &Local) -> [f64; 2] {
        let mut depths = [0.0; 2];
        for effect in self.of(Hook::AddedDepth) {
            depths[usize::from(effect.keeps_mass())] += effect.added_depth(at);
        }
        depths
    }

    /// Whether material is missing somewhere across a face `width` mm wide under a normal force (N).
    pub fn has_lead(&self, width: f64, normal_force: f64) -> bool {
        [-1.0, -0.5, 0.0, 0.5, 1.0].into_iter().any(|place| {
            let at = FaceAt {
                place,
                width,
                normal_force,
            };
            self.lead(&at).is_some_and(|lead| lead != 0.0)
        })
    }

    /// Whether what is missing at mid-face is not half of what is missing at both ends together.
    pub fn has_bent_lead(&self, width: f64, normal_force: f64) -> bool {
        let lead = |place| {
            let at = FaceAt {
                place,
                width,
                normal_force,
            };
            self.lead(&at).unwrap_or(0.0)
        };
        let (ends, middle) = ([lead(-1.0), lead(1.0)], lead(0.0));
        let largest = ends
            .iter()
            .fold(middle.abs(), |m: f64, end| m.max(end.abs()));
        (0.5 * (ends[0] + ends[1]) - middle).abs() > STRAIGHT * largest
    }

    /// The load factor of the effects that know nothing of the face.
    pub fn load_factor_of_sections(&self, at: &Local) -> f64 {
        let anywhere = FaceAt {
            place: 0.0,
            width: 1.0,
            normal_force: 0.0,
        };
        let knows_no_face = |effect: &&dyn Effect| effect.lead(&anywhere).is_none();
        let of_sections = self.of(Hook::LoadFactor).filter(knows_no_face);
        of_sections.fold(1.0, |f, effect| f * effect.load_factor(at))
    }

    /// Whether an effect displaces material without removing it.
    pub fn displaces(&self) -> bool {
        self.of(Hook::AddedDepth).any(Effect::keeps_mass)
    }

    fn of(&self, hook: Hook) -> impl Iterator<Item = &dyn Effect> {
        self.entries
            .iter()
            .filter(move |(acts, _)| *acts == hook)
            .map(|(_, effect)| effect.as_ref())
    }
}

impl Effect for Combined {
    fn wear_factor(&self, at: &Local) -> f64 {
        self.of(Hook::WearFactor)
            .fold(1.0, |f, effect| f * effect.wear_factor(at))
    }

    fn is_even(&self) -> bool {
        self.of(Hook::WearFactor).all(Effect::is_even)
    }

    fn added_depth(&self, at: &Local) -> f64 {
        let [removed, displaced] = self.added_depths(at);
        removed + displaced
    }

    fn load_factor(&self, at: &Local) -> f64 {
        self.of(Hook::LoadFactor)
            .fold(1.0, |f, effect| f * effect.load_factor(at))
    }

    fn friction(&self, at: &Local) -> f64 {
        self.of(Hook::Friction)
            .fold(0.0, |sum, effect| sum + effect.friction(at))
    }

    fn profile(&self, at: &ProfileAt) -> f64 {
        self.of(Hook::Profile)
            .fold(0.0, |sum, effect| sum + effect.profile(at))
    }

    fn tooth_offset(&self, tooth: Tooth) -> f64 {
        self.of(Hook::ToothOffset)
            .fold(0.0, |sum, effect| sum + effect.tooth_offset(tooth))
    }

    fn tooth_kind(&self, tooth: Tooth) -> Vec<f64> {
        let kinds = self.of(Hook::ToothOffset);
        kinds.flat_map(|effect| effect.tooth_kind(tooth)).collect()
    }

    /// Several patterns of teeth that stand alike have as many kinds as pairs of theirs; with a wave all teeth differ.
    fn tooth_classes(&self) -> ToothClasses {
        let each = self.of(Hook::ToothOffset).map(Effect::tooth_classes);
        let both = |a: ToothClasses, b: ToothClasses| match (a, b) {
            (ToothClasses::Alike(a), ToothClasses::Alike(b)) => {
                ToothClasses::Alike(a.saturating_mul(b))
            }
            (ToothClasses::Wave(a), ToothClasses::Wave(b)) => ToothClasses::Wave(a.max(b)),
            _ => ToothClasses::Alike(usize::MAX),
        };
        each.reduce(both).unwrap_or(ToothClasses::Alike(1))
    }

    fn lead(&self, at: &FaceAt) -> Option<f64> {
        let leads = self
            .entries
            .iter()
            .filter_map(|(_, effect)| effect.lead(at));
        leads.reduce(|sum, lead| sum + lead)
    }

    /// Traces are taken at one place: where effects differ, at the one farthest from mid-face, in whatever order they stand.
    fn usual_trace(&self) -> Option<UsualTrace> {
        let traces = self.entries.iter().filter_map(|(_, e)| e.usual_trace());
        traces.max_by(|a, b| {
            (a.mean.total_cmp(&b.mean))
                .then(a.place.abs().total_cmp(&b.place.abs()))
                .then(a.place.total_cmp(&b.place))
        })
    }

    /// Every effect sees the state as it is without the others.
    fn operation(&self, state: &OperationState) -> OperationChange {
        self.of(Hook::Operation)
            .fold(OperationChange::default(), |sum, effect| OperationChange {
                centre_distance: sum.centre_distance + effect.operation(state).centre_distance,
            })
    }

    fn compliance(&self) -> f64 {
        self.of(Hook::Compliance)
            .fold(0.0, |sum, effect| sum + effect.compliance())
    }

    fn fault(&self) -> Option<String> {
        self.entries.iter().find_map(|(_, effect)| effect.fault())
    }
}
