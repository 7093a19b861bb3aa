//! What a hidden cause may do to the run.

use crate::involute::Mating;

#[derive(Clone, Debug)]
pub struct Conditions {
    pub torque: f64,
    pub speed: f64,
    pub misalignment: f64,
    pub bulk: f64,
    pub viscosity: f64,
    pub pressure_viscosity: f64,
    pub roughness: f64,
    pub friction: f64,
}

/// A contact cell of a tooth pair in passing.
pub struct Seen<'a> {
    /// Path from the pitch point, mm; negative in approach.
    pub s: f64,
    pub load: f64,
    pub curvature: f64,
    pub p0: f64,
    pub half: f64,
    pub pressure: f64,
    /// Rolling speeds, m/s.
    pub u: [f64; 2],
    pub conditions: &'a Conditions,
    pub e_star: f64,
}

/// A place on a flank.
pub struct Spot<'a> {
    pub member: usize,
    pub s: f64,
    /// Where the path of contact starts.
    pub start: f64,
    /// um
    pub depth: f64,
    /// Largest pressure of the passage, MPa; 0 = not touched.
    pub peak: f64,
    pub cycles: f64,
    pub contacts_per_cycle: f64,
    /// Area worn from a pinion tooth and the gear teeth it met, mm^2.
    pub worn: f64,
    pub conditions: &'a Conditions,
}

pub trait Hidden: Send + Sync {
    fn has_factor(&self) -> bool {
        false
    }
    fn has_spot(&self) -> bool {
        false
    }
    /// On the wear of a cell.
    fn factor(&self, _: &Seen) -> f64 {
        1.0
    }
    /// On the wear of a place.
    fn local(&self, _: &Spot) -> f64 {
        1.0
    }
    /// Depth added per pinion cycle, um.
    fn added(&self, _: &Spot) -> f64 {
        0.0
    }
    /// Material missing at the start, um.
    fn profile(&self, _member: usize, _: &Mating, _rho: f64) -> f64 {
        0.0
    }
    /// On the load at pinion rotation theta (base pitches).
    fn load(&self, _theta: f64, _: &Conditions, _: &Mating) -> f64 {
        1.0
    }
    /// Extra compliance of each pair, um mm/N.
    fn softness(&self) -> f64 {
        0.0
    }
    /// Change of the centre distance, mm.
    fn shift(&self, _: &Conditions, _load: f64) -> f64 {
        0.0
    }
    /// Coefficient of friction at path s.
    fn friction(&self, _s: f64) -> f64 {
        0.0
    }
    fn has_friction(&self) -> bool {
        false
    }
}
