//! Teeth cut by the ISO 53 A rack, and how two of them mesh. Lengths mm, angles rad.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

/// inv(alpha) = tan(alpha) - alpha.
pub fn inv(alpha: f64) -> f64 {
    alpha.tan() - alpha
}

fn inv_angle(value: f64) -> f64 {
    // Newton from a cubic start, inv'(a) = tan^2 a.
    let mut a = (3.0 * value).cbrt().min(1.2);
    for _ in 0..60 {
        let step = (inv(a) - value) / a.tan().powi(2);
        a -= step;
        if step.abs() < 1e-15 {
            break;
        }
    }
    a
}

/// Addendum, dedendum and tip rounding of the rack, in modules.
const HA: f64 = 1.0;
const HF: f64 = 1.25;
const ROUND: f64 = 0.38;

#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Tooth {
    pub z: usize,
    pub x: f64,
    pub m: f64,
    pub alpha: f64,
    pub r: f64,
    pub rb: f64,
    pub ra: f64,
    pub rf: f64,
    pub bore: f64,
}

impl Tooth {
    pub fn new(m: f64, z: usize, x: f64, bore_radius: f64) -> Self {
        let alpha = 20f64.to_radians();
        let r = 0.5 * m * z as f64;
        Self {
            z,
            x,
            m,
            alpha,
            r,
            rb: r * alpha.cos(),
            ra: r + m * (HA + x),
            rf: r - m * (HF - x),
            bore: bore_radius,
        }
    }

    /// Half the angle that the tooth spans at radius `rad` (involute part).
    pub fn half_angle(&self, rad: f64) -> f64 {
        let a = (self.rb / rad).min(1.0).acos();
        PI / (2.0 * self.z as f64)
            + 2.0 * self.x * self.alpha.tan() / self.z as f64
            + inv(self.alpha)
            - inv(a)
    }

    /// Curvature radius of the involute at radius `rad`, and back.
    pub fn rho(&self, rad: f64) -> f64 {
        (rad * rad - self.rb * self.rb).max(0.0).sqrt()
    }
    pub fn radius(&self, rho: f64) -> f64 {
        rho.hypot(self.rb)
    }
    pub fn rho_tip(&self) -> f64 {
        self.rho(self.ra)
    }
    /// Arc length along the involute from the base circle.
    pub fn arc(&self, rho: f64) -> f64 {
        rho * rho / (2.0 * self.rb)
    }
    pub fn rho_of_arc(&self, arc: f64) -> f64 {
        (2.0 * self.rb * arc.max(0.0)).sqrt()
    }

    /// Point at polar (radius, angle clockwise from the tooth's axis +y).
    pub fn polar(rad: f64, angle: f64) -> [f64; 2] {
        [rad * angle.sin(), rad * angle.cos()]
    }

    fn rack_corner(&self) -> (f64, f64, f64) {
        let round = ROUND * self.m;
        let depth = HF * self.m - round;
        let side = PI * self.m / 4.0 - depth * self.alpha.tan() - round / self.alpha.cos();
        (depth - self.x * self.m, side, round)
    }

    /// Point of the right fillet, cut by the rack's tip circle: t = 0 at the root land, 1 at the involute.
    pub fn fillet(&self, t: f64) -> [f64; 2] {
        let (d, side, round) = self.rack_corner();
        let u = t * d / self.alpha.tan();
        let norm = u.hypot(d);
        let p = [u + round * u / norm, self.r - d - round * d / norm];
        // Turn with the gear, counter-clockwise by (u - side)/r, then from the space's axis to the tooth's.
        let turned = (u - side) / self.r;
        let from_space = p[0].atan2(p[1]) - turned; // clockwise angle from the space's axis
        let angle = PI / self.z as f64 - from_space;
        Self::polar(p[0].hypot(p[1]), angle)
    }

    /// Radius where the fillet meets the involute.
    pub fn form_radius(&self) -> f64 {
        let p = self.fillet(1.0);
        p[0].hypot(p[1])
    }

    /// Angle (clockwise from the tooth's axis) where fillet and root land meet.
    pub fn land_angle(&self) -> f64 {
        let p = self.fillet(0.0);
        p[0].atan2(p[1])
    }
}

/// Two teeth at a centre distance.
#[derive(Clone, Debug)]
pub struct Mating {
    pub pinion: Tooth,
    pub gear: Tooth,
    pub pb: f64,
    /// Curvature radii at the pitch point.
    pub c1: f64,
    pub c2: f64,
    /// Ends of the path of contact, from the pitch point.
    pub start: f64,
    pub end: f64,
}

impl Mating {
    pub fn nominal_centre(pinion: &Tooth, gear: &Tooth) -> f64 {
        let z = (pinion.z + gear.z) as f64;
        let alpha = pinion.alpha;
        let aw = inv_angle(inv(alpha) + 2.0 * alpha.tan() * (pinion.x + gear.x) / z);
        (pinion.rb + gear.rb) / aw.cos()
    }

    pub fn new(pinion: &Tooth, gear: &Tooth, centre: f64) -> Self {
        let alpha_w = ((pinion.rb + gear.rb) / centre).acos();
        let c1 = pinion.rb * alpha_w.tan();
        let c2 = gear.rb * alpha_w.tan();
        Self {
            pb: PI * pinion.m * pinion.alpha.cos(),
            start: c2 - gear.rho_tip(),
            end: pinion.rho_tip() - c1,
            pinion: pinion.clone(),
            gear: gear.clone(),
            c1,
            c2,
        }
    }

    pub fn contact_ratio(&self) -> f64 {
        (self.end - self.start) / self.pb
    }

    pub fn teeth(&self, member: usize) -> &Tooth {
        if member == 0 {
            &self.pinion
        } else {
            &self.gear
        }
    }

    /// Curvature radius of `member` that meets at path coordinate s.
    pub fn rho(&self, member: usize, s: f64) -> f64 {
        if member == 0 {
            self.c1 + s
        } else {
            self.c2 - s
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Benchmarks, section C: REF 27/53 and FZG-C.
    #[test]
    fn known_pairs() {
        let p = Tooth::new(2.0, 27, 0.0, 12.5);
        let g = Tooth::new(2.0, 53, 0.0, 20.0);
        let a = Mating::nominal_centre(&p, &g);
        assert!((a - 80.0).abs() < 1e-9);
        let pair = Mating::new(&p, &g, a);
        assert!((pair.contact_ratio() - 1.69714).abs() < 1e-5);
        assert!((p.form_radius() - 25.5968).abs() < 1e-4);
        assert!((g.form_radius() - 51.2952).abs() < 1e-4);
        assert!((2.0 * p.ra * p.half_angle(p.ra) - 1.4551).abs() < 2e-3);
        let p = Tooth::new(4.5, 16, 0.1817, 15.0);
        let g = Tooth::new(4.5, 24, 0.1715, 15.0);
        let a = Mating::nominal_centre(&p, &g);
        assert!((a - 91.5001).abs() < 1e-4);
        assert!((Mating::new(&p, &g, a).contact_ratio() - 1.46243).abs() < 1e-5);
        assert!((p.form_radius() - 33.8643).abs() < 1e-4);
        // The fillet meets the involute.
        let end = p.fillet(1.0);
        assert!((end[0].atan2(end[1]) - p.half_angle(p.form_radius())).abs() < 1e-9);
    }
}
