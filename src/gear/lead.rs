//! Deviations of a flank across the face: lead slope, crowning, end relief, a measured lead.
//!
//! ```text
//! e(y) = f_Hβ y/b + C_c (2y/b)² + C_e max(0, (|y| − b/2 + L_e)/L_e) + measured(y)      y mm from mid-face, −b/2 to b/2
//! ```
//! ISO 21771: normal to the flank, so along the path of contact; positive where material is missing.

use crate::numeric::interpolate;

/// What one member's flanks lack across the face.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Lead {
    /// Over the whole face, mm: half of it is missing at +b/2, half stands proud at −b/2.
    pub slope: f64,
    /// Missing at both ends, mm, as a parabola.
    pub crowning: f64,
    /// Missing at both ends, mm, in a straight line from [`Lead::end_relief_length`] inwards.
    pub end_relief: f64,
    /// How far from the ends the end relief begins, mm.
    pub end_relief_length: f64,
    /// Measured: place from mid-face and missing material, mm, ascending; straight between the rows, as at the end beyond.
    pub measured: Vec<[f64; 2]>,
}

impl Lead {
    /// Whether nothing is missing anywhere.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Missing material at the place `y` (mm from mid-face) of a face `width` wide, mm.
    pub fn missing(&self, y: f64, width: f64) -> f64 {
        let share = y / width;
        let mut missing = self.slope * share + self.crowning * (2.0 * share).powi(2);
        if self.end_relief != 0.0 {
            let within = (y.abs() - 0.5 * width + self.end_relief_length) / self.end_relief_length;
            missing += self.end_relief * within.max(0.0);
        }
        if !self.measured.is_empty() {
            let (places, values): (Vec<f64>, Vec<f64>) =
                self.measured.iter().map(|row| (row[0], row[1])).unzip();
            missing += interpolate(&places, &values, y);
        }
        missing
    }
}

/// What ties the slices of a face besides their common turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Coupling {
    /// The teeth and the bodies that they are cut from.
    Teeth,
    /// Nothing.
    #[default]
    None,
}

/// The ends of a face whose slices are tied by the teeth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum FaceEnds {
    /// Free of load, as those of a gear are.
    #[default]
    Free,
    /// Held along the axis, as if the gear went on behind them.
    Held,
}

/// The face: in how many slices it is computed, and what both members' flanks lack across it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Face {
    /// Slices, 1 for one section; 0 where none are stated: one section, or several if an effect acts across the face.
    pub slices: usize,
    /// What ties them.
    pub coupling: Coupling,
    /// How it ends.
    pub ends: FaceEnds,
    /// Of pinion and gear.
    pub lead: [Lead; 2],
}

impl Face {
    /// What both members lack together at the place `y` of a face `width` wide, mm.
    pub fn missing(&self, y: f64, width: f64) -> f64 {
        self.lead.iter().map(|lead| lead.missing(y, width)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deviations_are_where_they_are_said_to_be() {
        let lead = Lead {
            slope: 0.015,
            crowning: 0.005,
            end_relief: 0.01,
            end_relief_length: 3.0,
            measured: vec![[-10.0, 0.002], [10.0, 0.004]],
        };
        let at = |y: f64| lead.missing(y, 30.0);
        assert!((at(0.0) - 0.003).abs() < 1e-15);
        assert!((at(15.0) - (0.0075 + 0.005 + 0.01 + 0.004)).abs() < 1e-15);
        assert!((at(-15.0) - (-0.0075 + 0.005 + 0.01 + 0.002)).abs() < 1e-15);
        assert!((at(13.5) - (0.00675 + 0.00405 + 0.005 + 0.004)).abs() < 1e-15);
        assert!(Lead::default().is_none() && !lead.is_none());
    }
}
