//! How a solved contact follows small changes: of the depths, and of what effects alter about it.
//!
//! On a fixed set of touching points the contact is linear in the gaps, so its derivatives are back-substitutions, and exact. Points
//! that enter or leave make kinks, not jumps: between them the derivatives hold.

use crate::contact::alteration::Alteration;
use crate::contact::contact_point::ContactPoint;
use crate::contact::slices::Flanks;

/// Derivative of the contact of one position.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactTangent {
    /// Of the pressure at each multiplier node, MPa per unit of the parameter.
    pub pressure: Vec<f64>,
    /// Of the rotation that closes the flanks, rad per unit.
    pub approach: f64,
}

/// What a parameter changes about the contact, each per unit of the parameter.
#[derive(Debug, Clone, Copy)]
pub struct Change<'a> {
    /// Depths, and how far pairs stand back.
    pub flanks: &'a Flanks<'a>,
    /// What effects alter besides.
    pub altered: Option<&'a AlterationChange>,
}

/// Derivative of an [`Alteration`] and of what follows from it.
#[derive(Debug, Clone, PartialEq)]
pub struct AlterationChange {
    /// Of each number.
    pub alteration: Alteration,
    /// Of the weighted gaps that the profile opens, by position; by finite elements.
    pub opened: Option<Vec<Vec<f64>>>,
    /// Of the places where pairs touch, by position and pair; analytically.
    pub points: Option<Vec<Vec<ContactPoint>>>,
}

/// The contact of one position, linearised about its solution.
pub trait LinearContact {
    /// Derivative of pressures and approach.
    fn tangent(&self, change: &Change<'_>) -> ContactTangent;

    /// S G v on the active set, S as in [`crate::contact::model::ContactModel::sensitivity`] and G v the weighted gaps that `flanks` open;
    /// empty where there is no such S.
    fn response(&self, flanks: &Flanks<'_>) -> Vec<f64>;

    /// How a `response` changes with what effects alter: S itself depends on flexibility and lever. None: not at all.
    fn response_tangent(&self, response: &[f64], change: &AlterationChange) -> Option<Vec<f64>>;
}

/// The contacts of one position's slices, linearised about their solution.
pub trait LinearSlices {
    /// Derivative of pressures and approach, by slice.
    fn tangents(&self, change: &Change<'_>) -> Vec<ContactTangent>;

    /// As [`LinearContact::response`], by slice: the approach is free to follow.
    fn responses(&self, flanks: &Flanks<'_>) -> Vec<Vec<f64>>;

    /// As [`LinearContact::response_tangent`], by slice.
    fn response_tangents(
        &self,
        responses: &[Vec<f64>],
        change: &AlterationChange,
    ) -> Option<Vec<Vec<f64>>>;
}

impl Alteration {
    /// (`after` − self)/`step`, number by number.
    pub fn slope_to(&self, after: &Self, step: f64) -> Self {
        let slope = |a: f64, b: f64| (b - a) / step;
        let slopes = |a: &[f64], b: &[f64]| -> Vec<f64> {
            a.iter().zip(b).map(|(a, b)| slope(*a, *b)).collect()
        };
        let profile = self.profile.as_ref().zip(after.profile.as_ref());
        let factors = self.load_factor.as_ref().zip(after.load_factor.as_ref());
        let friction = self.friction.as_ref().zip(after.friction.as_ref());
        let by_pair = |a: &[Vec<f64>], b: &[Vec<f64>]| -> Vec<Vec<f64>> {
            a.iter().zip(b).map(|(a, b)| slopes(a, b)).collect()
        };
        let back = self.tooth_back.as_ref().zip(after.tooth_back.as_ref());
        Self {
            profile: profile.map(|(a, b)| [0, 1].map(|side| slopes(&a[side], &b[side]))),
            load_factor: factors.map(|(a, b)| by_pair(a, b)),
            friction: friction.map(|(a, b)| by_pair(a, b)),
            flexibility: slope(self.flexibility, after.flexibility),
            tooth_back: back.map(|(a, b)| [0, 1].map(|side| slopes(&a[side], &b[side]))),
            lead: (self.lead.as_ref().zip(after.lead.as_ref())).map(|(a, b)| slopes(a, b)),
        }
    }

    /// Whether every number is 0, as a derivative that changes nothing.
    pub fn is_zero(&self) -> bool {
        let zero = |x: &f64| *x == 0.0;
        self.profile.iter().flatten().flatten().all(zero)
            && self.load_factor.iter().flatten().flatten().all(zero)
            && self.friction.iter().flatten().flatten().all(zero)
            && self.flexibility == 0.0
            && self.tooth_back.iter().flatten().flatten().all(zero)
            && self.lead.iter().flatten().all(zero)
    }

    /// As [`Alteration::factor`], 0 where nothing is said: for a derivative.
    pub fn factor_slope(&self, q: usize, index: usize) -> f64 {
        self.load_factor
            .as_ref()
            .map_or(0.0, |factors| factors[q][index])
    }
}

/// Pressures that are given and follow nothing, on so many unknowns.
pub struct Given(pub usize);

impl LinearContact for Given {
    fn tangent(&self, _: &Change<'_>) -> ContactTangent {
        ContactTangent {
            pressure: vec![0.0; self.0],
            approach: 0.0,
        }
    }

    fn response(&self, _: &Flanks<'_>) -> Vec<f64> {
        Vec::new()
    }

    fn response_tangent(&self, _: &[f64], _: &AlterationChange) -> Option<Vec<f64>> {
        None
    }
}
