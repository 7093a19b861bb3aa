//! Floor 1: the published mild-wear model of a spur pinion, as printed, mistakes included.
//!
//! P. Kumar, H. Hirani, A. K. Agrawal, "Modeling and Simulation of Mild Wear of Spur Gear Considering Radial
//! Misalignment" (2018). This module is a witness: it takes nothing from `gear` or `wear`, so that an error there cannot
//! hide here. It reproduces the printed wear depths, the pressure drop and one of the two angle changes inside their
//! rounding; it must not be used to predict a real gear, because several of its assumptions are wrong:
//!
//! | assumption of the model | physical one | switch |
//! |---|---|---|
//! | a point is rubbed for the time the contact takes from the pitch point to it | for the time the Hertz contact takes to pass it | [`Corrections::hertz_dwell`] |
//! | 50 points on 50 intervals, the tip is never one of them | 49 intervals, tip included | [`Corrections::tip_point`] |
//! | half the load wherever two pairs touch | share rises 1/3 to 2/3 linearly | [`Corrections::linear_load_share`] |
//! | gear speed 1000 rpm | 27/53 of the pinion's 2000 rpm | [`Corrections::true_speed_ratio`] |
//! | a thinner tooth has a larger pressure angle | uniform thinning leaves the involute an involute | [`Corrections::no_angle_feedback`] |
//!
//! Equation numbers (1, 3, 5, 6, 11, A1 to A8) are the paper's. Where its print cannot be what was computed, the form used
//! here is the one that reproduces the printed numbers, and the literal form is kept as a [`Reading`], so that every choice
//! can be undone one at a time and seen to miss them.
//!
//! Not in the model: elasticity of the teeth, wear of the gear, any coupling between neighbouring points, friction, film.

mod csv;
mod equations;
mod geometry;
mod inputs;
pub mod reference;
mod run;
mod theory;

pub use geometry::{Geometry, Grid, PrintedBacklash};
pub use inputs::{Corrections, Inputs, Reading};
pub use run::{Outcome, Point, PointState, State, run, run_with_states};
pub use theory::{backlash, depth_per_pass, double_contact_length};

/// Why the published model cannot be evaluated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    /// An input that must be positive and finite is not.
    #[error("{name} = {value} must be a positive number")]
    NotPositive {
        /// Which input.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// The centres are nearer than the base circles allow.
    #[error(
        "the base circles overlap at a centre distance of {centre_distance} mm: more than {least:.4} mm is needed"
    )]
    TooClose {
        /// Centre distance with misalignment, mm.
        centre_distance: f64,
        /// Sum of the base radii, mm.
        least: f64,
    },
    /// The load-sharing rule (half or all of the load) knows one or two pairs in contact only.
    #[error("contact ratio {contact_ratio:.3}: the published model needs 1 to 2")]
    ContactRatio {
        /// Path of contact over base pitch.
        contact_ratio: f64,
    },
    /// The gear tip reaches below the pinion's base circle, where there is no involute.
    #[error("contact would start {below:.4} mm below the pinion's base circle")]
    BelowBaseCircle {
        /// Missing length along the line of action, mm.
        below: f64,
    },
    /// Fewer than two points.
    #[error("{points} points on the flank: at least 2 are needed")]
    TooFewPoints {
        /// Points asked for.
        points: usize,
    },
    /// The angle update carried a point past the gear's base tangent point: the explicit model broke down.
    #[error(
        "point {point} leaves the line of action after {cycle} cycles: the model's angle update has diverged"
    )]
    Diverged {
        /// Point number, from 1.
        point: usize,
        /// Cycle.
        cycle: u64,
    },
}
