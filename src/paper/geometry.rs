//! Geometry of the published model: ordinary involute geometry at a changed centre distance, and the grid of points.

use std::f64::consts::PI;

use super::{Error, Inputs, Reading};

/// The involute function, `inv x = tan x − x`.
pub(super) fn inv(x: f64) -> f64 {
    x.tan() - x
}

/// Working geometry at the misaligned centre distance; lengths mm, angles rad.
///
/// Positions on the line of action are given as the pinion's radius of curvature ρ, the distance from its base tangent point:
/// `r = √(r_b1² + ρ²)`.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    /// Base radii r_b, pinion and gear.
    pub base_radius: [f64; 2],
    /// Centre distance a' with misalignment.
    pub centre_distance: f64,
    /// Operating pressure angle α': `cos α' = (r_b1 + r_b2)/a'` (Eq. 1).
    pub operating_angle: f64,
    /// Operating pitch radius of the pinion, r_b1/cos α'.
    pub pitch_radius: f64,
    /// Circular pitch on the operating pitch circle, `π m cos α / cos α'` (Eq. 3 for a standard pair: π m a'/CD).
    pub circular_pitch: f64,
    /// Base pitch π m cos α.
    pub base_pitch: f64,
    /// Length of the path of contact.
    pub path_of_contact: f64,
    /// Path of contact over base pitch.
    pub contact_ratio: f64,
    /// ω1/ω2 = z2/z1, whatever the centre distance (law of gearing). The printed 1.961 and 1.959 have no derivation.
    pub speed_ratio: f64,
    /// What the paper's backlash formula may have computed.
    pub backlash: PrintedBacklash,
    /// ρ at the start of contact.
    pub start: f64,
    /// ρ at the lowest point of single tooth contact (LPSTC).
    pub lowest_single: f64,
    /// ρ at the pitch point.
    pub pitch: f64,
    /// ρ at the highest point of single tooth contact (HPSTC).
    pub highest_single: f64,
    /// ρ at the end of contact, the pinion tip.
    pub end: f64,
    /// The model's points.
    pub grid: Grid,
}

/// The printed backlash and its best candidate; the law itself is [`super::backlash`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrintedBacklash {
    /// `(a'/CD)·(45 µm + 2 m (inv α' − inv α))`, mm: one constant (45 µm) is fitted, the factor (z1 + z2)/2 is lost.
    pub candidate: f64,
    /// Eq. 5 literally, read in mm: `(a'/CD)·2 (inv α' − inv α)`; it has no unit of length.
    pub literal: f64,
}

/// Points with equal steps of the radius, from the base circle outwards; numbers start at 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Radius of point 1, the base radius, mm.
    pub first: f64,
    /// Step, mm.
    pub step: f64,
    /// Number of points.
    pub points: usize,
}

impl Grid {
    /// Radius of a point, mm.
    pub fn radius(&self, number: usize) -> f64 {
        self.first + self.step * (number as f64 - 1.0)
    }

    /// Fractional point number of a radius in mm.
    pub fn number(&self, radius: f64) -> f64 {
        1.0 + (radius - self.first) / self.step
    }
}

impl Geometry {
    /// Working geometry of the inputs.
    pub fn new(inputs: &Inputs) -> Result<Self, Error> {
        inputs.check()?;
        let [z1, z2] = inputs.teeth.map(f64::from);
        let (m, alpha) = (inputs.module, inputs.pressure_angle);
        let rb = [z1, z2].map(|z| m * z / 2.0 * alpha.cos());
        let ra = inputs.tip_radius;
        let a = inputs.centre_distance + inputs.misalignment;
        let cosine = (rb[0] + rb[1]) / a;
        if cosine >= 1.0 {
            return Err(Error::TooClose {
                centre_distance: a,
                least: rb[0] + rb[1],
            });
        }
        let alpha_w = cosine.acos();
        let base_pitch = PI * m * alpha.cos();
        let reach = |i: usize| (ra[i] * ra[i] - rb[i] * rb[i]).max(0.0).sqrt();
        let start = a * alpha_w.sin() - reach(1);
        let end = reach(0);
        let path = end - start;
        let contact_ratio = path / base_pitch;
        if !(1.0..=2.0).contains(&contact_ratio) {
            return Err(Error::ContactRatio { contact_ratio });
        }
        if start <= 0.0 {
            return Err(Error::BelowBaseCircle { below: -start });
        }
        let standard = m * (z1 + z2) / 2.0;
        let widening = inv(alpha_w) - inv(alpha);
        let intervals = if inputs.corrections.tip_point
            || inputs.reading == Some(Reading::FortyNineIntervals)
        {
            inputs.points - 1
        } else {
            inputs.points
        };
        Ok(Self {
            base_radius: rb,
            centre_distance: a,
            operating_angle: alpha_w,
            pitch_radius: rb[0] / cosine,
            circular_pitch: base_pitch / cosine,
            base_pitch,
            path_of_contact: path,
            contact_ratio,
            speed_ratio: z2 / z1,
            backlash: PrintedBacklash {
                candidate: a / standard * (0.045 + 2.0 * m * widening),
                literal: a / standard * 2.0 * widening,
            },
            start,
            lowest_single: end - base_pitch,
            pitch: rb[0] * alpha_w.tan(),
            highest_single: start + base_pitch,
            end,
            grid: Grid {
                first: rb[0],
                step: (ra[0] - rb[0]) / intervals as f64,
                points: inputs.points,
            },
        })
    }

    /// Pinion radius of a point of the line of action at ρ, mm.
    pub fn radius(&self, rho: f64) -> f64 {
        self.base_radius[0].hypot(rho)
    }

    /// Fractional point number of a position ρ, mm.
    pub fn number(&self, rho: f64) -> f64 {
        self.grid.number(self.radius(rho))
    }

    /// The published pitch point number: the point nearest to the operating pitch circle.
    pub fn pitch_point_number(&self) -> usize {
        self.number(self.pitch).round() as usize
    }

    /// The published first contact number: the first point at or beyond the start of contact.
    pub fn first_contact_number(&self) -> usize {
        self.number(self.start).ceil() as usize
    }

    /// Profile angle of the unworn flank at a point, rad: `cos φ = r_b1/r`.
    pub fn profile_angle(&self, number: usize) -> f64 {
        let r = self.grid.radius(number);
        (r * r - self.base_radius[0].powi(2))
            .max(0.0)
            .sqrt()
            .atan2(self.base_radius[0])
    }
}
