//! One measured value.

use super::quantity::{Quantity, Subject};

/// Where across the face something was measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FacePlace {
    /// At this distance from mid-face, mm.
    At(f64),
    /// The mean over the face: of a tactile profile along many lines, of replicas, of weighed volume.
    Mean,
}

impl FacePlace {
    /// A number of its own for each place, for keys.
    pub fn key(self) -> u64 {
        match self {
            // 0 and -0 are one place
            FacePlace::At(face) => (face + 0.0).to_bits(),
            // the bits of no finite number
            FacePlace::Mean => u64::MAX,
        }
    }
}

/// One measured value.
#[derive(Debug, Clone, PartialEq)]
pub struct Observation {
    /// Which of the study's tests, by its place in them.
    pub test: usize,
    /// What it was measured on.
    pub member: Subject,
    /// When: pinion revolutions.
    pub cycles: f64,
    /// What was measured.
    pub quantity: Quantity,
    /// Where: mm of radius, base pitches of rotation or teeth spanned, as [`Quantity::place`] says; none for the whole member.
    pub position: Option<f64>,
    /// The value, in [`Quantity::unit`].
    pub value: f64,
    /// One standard deviation of its independent noise, in the same unit, above 0.
    pub sigma: f64,
    /// Which trace it belongs to, by its place in the data set's.
    pub trace: Option<usize>,
    /// Where across the face; none where the row does not say.
    pub face: Option<FacePlace>,
    /// Label of the tooth.
    pub tooth: Option<String>,
    /// Line in the file, counted from 1.
    pub line: usize,
}
