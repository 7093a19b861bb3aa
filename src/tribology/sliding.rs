//! Rolling and sliding along the path of contact of a pair of involute gears.
//!
//! ```text
//! ρ1 = r_b1 tan α_w + s,   ρ2 = r_b2 tan α_w − s        s mm from the pitch point, positive towards the pinion tip
//! u1 = ω1 ρ1,   u2 = ω2 ρ2,   ω2/ω1 = r_b1/r_b2         rolling speeds, mm/s
//! v  = u1 − u2                                          sliding speed, negative in approach
//! SR1 = v/u1,   SR2 = −v/u2                             specific sliding of each flank
//! ```
//! The distances ρ are those of the contact from the base tangent points, so ρ1 + ρ2 = a sin α_w at every s.

/// A working pair: base radii mm, operating pressure angle rad, pinion speed rad/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kinematics {
    /// Base radii, pinion and gear, mm.
    pub base_radius: [f64; 2],
    /// Operating pressure angle, rad.
    pub operating_angle: f64,
    /// Angular speed of the pinion, rad/s.
    pub pinion_speed: f64,
}

impl Kinematics {
    /// Radii of curvature of both flanks at the path coordinate s, mm.
    pub fn curvature_radii(&self, path: f64) -> [f64; 2] {
        let tangent = self.operating_angle.tan();
        [
            self.base_radius[0] * tangent + path,
            self.base_radius[1] * tangent - path,
        ]
    }

    /// Speeds of both surfaces at the path coordinate s.
    pub fn motion(&self, path: f64) -> Motion {
        let rho = self.curvature_radii(path);
        let gear_speed = self.pinion_speed * self.base_radius[0] / self.base_radius[1];
        Motion {
            rolling: [self.pinion_speed * rho[0], gear_speed * rho[1]],
        }
    }
}

/// Rolling speeds of two surfaces through their contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// u1 and u2, mm/s.
    pub rolling: [f64; 2],
}

impl Motion {
    /// Sliding speed u1 − u2, mm/s.
    pub fn sliding(&self) -> f64 {
        self.rolling[0] - self.rolling[1]
    }

    /// Entraining speed, the mean of both rolling speeds, mm/s.
    pub fn entraining(&self) -> f64 {
        0.5 * self.sum()
    }

    /// Sum of both rolling speeds, mm/s.
    pub fn sum(&self) -> f64 {
        self.rolling[0] + self.rolling[1]
    }

    /// Specific sliding of both flanks, (u1 − u2)/u1 and (u2 − u1)/u2; infinite at a base tangent point.
    pub fn specific(&self) -> [f64; 2] {
        let v = self.sliding();
        [v / self.rolling[0], -v / self.rolling[1]]
    }
}
