//! What the published model is given (Table 1), and the switches that undo one assumption at a time.

use super::Error;

/// Inputs of the published model; [`Inputs::default`] is the paper's Table 1.
///
/// Arrays hold the pinion first, the gear second.
#[derive(Debug, Clone, PartialEq)]
pub struct Inputs {
    /// Numbers of teeth.
    pub teeth: [u32; 2],
    /// Module, mm.
    pub module: f64,
    /// Pressure angle at the reference circle, rad.
    pub pressure_angle: f64,
    /// Tip radii, mm. Not printed in the paper: standard addendum of one module on both gears.
    pub tip_radius: [f64; 2],
    /// Face width, mm.
    pub face_width: f64,
    /// Torque on the pinion, N mm.
    pub torque: f64,
    /// Speeds, rpm. The gear's printed 1000 rpm is nominal (2000·27/53 = 1018.87), and the printed wear needs it literally.
    pub speed: [f64; 2],
    /// Specific wear coefficient k, mm²/N.
    pub k: f64,
    /// Young's moduli, MPa.
    pub youngs_modulus: [f64; 2],
    /// Poisson's ratios.
    pub poisson_ratio: [f64; 2],
    /// Centre distance without misalignment, mm.
    pub centre_distance: f64,
    /// Radial misalignment, added to the centre distance, mm.
    pub misalignment: f64,
    /// Pinion revolutions; one explicit step each.
    pub cycles: u64,
    /// Points on the pinion flank.
    pub points: usize,
    /// Assumptions replaced by the physical ones.
    pub corrections: Corrections,
    /// One step read differently from the reconstruction; `None` for the form that reproduces the printed numbers.
    pub reading: Option<Reading>,
}

impl Default for Inputs {
    fn default() -> Self {
        Self {
            teeth: [27, 53],
            module: 2.0,
            pressure_angle: 20f64.to_radians(),
            tip_radius: [29.0, 55.0],
            face_width: 33.0,
            torque: 100.0e3,
            speed: [2000.0, 1000.0],
            k: 6e-10,
            youngs_modulus: [2.1e5; 2],
            poisson_ratio: [0.3; 2],
            centre_distance: 80.0,
            misalignment: 0.0,
            cycles: 50_000,
            points: 50,
            corrections: Corrections::default(),
            reading: None,
        }
    }
}

impl Inputs {
    /// Table 1 with another radial misalignment, mm.
    pub fn with_misalignment(misalignment: f64) -> Self {
        Self {
            misalignment,
            ..Self::default()
        }
    }

    /// Angular speed of the gear over that of the pinion, as the model uses it.
    ///
    /// ```text
    /// 1000/2000 from Table 1, or z1/z2 with the true speed ratio
    /// ```
    pub fn gear_to_pinion_speed(&self) -> f64 {
        if self.corrections.true_speed_ratio || self.reading == Some(Reading::TrueSpeedRatio) {
            f64::from(self.teeth[0]) / f64::from(self.teeth[1])
        } else {
            self.speed[1] / self.speed[0]
        }
    }

    /// Contact modulus, MPa (Eq. A8): `1/E = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂`.
    pub fn contact_modulus(&self) -> f64 {
        let compliance = |i: usize| (1.0 - self.poisson_ratio[i].powi(2)) / self.youngs_modulus[i];
        1.0 / (compliance(0) + compliance(1))
    }

    pub(super) fn check(&self) -> Result<(), Error> {
        let positive = [
            ("teeth of the pinion", f64::from(self.teeth[0])),
            ("teeth of the gear", f64::from(self.teeth[1])),
            ("module", self.module),
            ("pressure angle", self.pressure_angle),
            ("tip radius of the pinion", self.tip_radius[0]),
            ("tip radius of the gear", self.tip_radius[1]),
            ("face width", self.face_width),
            ("torque", self.torque),
            ("speed of the pinion", self.speed[0]),
            ("speed of the gear", self.speed[1]),
            ("wear coefficient", self.k),
            ("Young's modulus of the pinion", self.youngs_modulus[0]),
            ("Young's modulus of the gear", self.youngs_modulus[1]),
            ("contact modulus", self.contact_modulus()),
            (
                "centre distance",
                self.centre_distance + self.misalignment.min(0.0),
            ),
        ];
        for (name, value) in positive {
            if !(value > 0.0 && value.is_finite()) {
                return Err(Error::NotPositive { name, value });
            }
        }
        if self.points < 2 {
            return Err(Error::TooFewPoints {
                points: self.points,
            });
        }
        Ok(())
    }
}

/// Assumptions of the published model to be replaced by the physical ones; all off is the paper.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Corrections {
    /// Sliding distance of a point per pass from the passing Hertz contact, `h = k F' |1 − v2/v1|`, instead of Eq. A4.
    pub hertz_dwell: bool,
    /// One interval fewer than points, so that the last point is the tip.
    pub tip_point: bool,
    /// Load share 1/3 rising to 2/3, then 1, then 2/3 falling to 1/3, instead of 1/2, 1, 1/2.
    pub linear_load_share: bool,
    /// Gear speed z1/z2 of the pinion's instead of the printed 1000/2000.
    pub true_speed_ratio: bool,
    /// Wear does not change the profile angle (Eq. 6 left out).
    pub no_angle_feedback: bool,
}

impl Corrections {
    /// Every assumption corrected.
    pub const ALL: Self = Self {
        hertz_dwell: true,
        tip_point: true,
        linear_load_share: true,
        true_speed_ratio: true,
        no_angle_feedback: true,
    };

    /// The corrections one at a time, each with a short description of what it replaces.
    pub fn each() -> [(&'static str, Self); 5] {
        let none = Self::default();
        [
            (
                "each point slides while the contact passes over it",
                Self {
                    hertz_dwell: true,
                    ..none
                },
            ),
            (
                "grid that includes the tip",
                Self {
                    tip_point: true,
                    ..none
                },
            ),
            (
                "load share 1/3 to 2/3 instead of 1/2",
                Self {
                    linear_load_share: true,
                    ..none
                },
            ),
            (
                "gear speed from the tooth numbers",
                Self {
                    true_speed_ratio: true,
                    ..none
                },
            ),
            (
                "no change of the profile angle by wear",
                Self {
                    no_angle_feedback: true,
                    ..none
                },
            ),
        ]
    }
}

/// Another reading of one step of the paper, each contradicted by at least one of its printed numbers.
///
/// Used one at a time, to show what each printed number pins down.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reading {
    /// 49 intervals between 50 points.
    FortyNineIntervals,
    /// Gear speed 27/53 of the pinion's.
    TrueSpeedRatio,
    /// Operating pressure angle cut to two decimals of a degree, as printed in Table 2.
    PrintedAngle,
    /// Tangential load T/r at the reference circle instead of the normal load T/r_b.
    LoadAtReferenceCircle,
    /// Whole load, not divided by the face width.
    LoadNotPerWidth,
    /// Mean instead of largest pressure in the wear law.
    MeanPressure,
    /// Eq. A5 as printed: `aH = √(4 F E / (π R))`, E and R exchanged and the load not per width.
    HalfWidthAsPrinted,
    /// Eq. A6 as printed: the same sign of y for both members.
    RadiiAsPrinted,
    /// All the load on one pair everywhere.
    FullLoad,
    /// A third of the load wherever two pairs touch.
    OneThird,
    /// `y = r sin φ − r_w sin α'`, the same while unworn, different once φ has moved at fixed r.
    SineOfAngle,
    /// Eq. A4 with the point's own profile angle and the pinion speed at the reference circle.
    InstantaneousAngle,
    /// Time `2 aH / (ω ρ)` of the contact over the point, in place of Eq. A4, with the model's sliding speed.
    ContactDwell,
    /// Eq. 8, the logarithmic form of the thickness update: `d inv φ = inv φ · dh / th`.
    LogarithmicUpdate,
    /// Wear taken from both flanks of the tooth.
    BothFlanks,
}
