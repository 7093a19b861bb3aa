//! One member: its circles, its involute and its fillet.

use std::f64::consts::{FRAC_PI_2, PI};

use super::BasicRack;
use super::error::GearError;
use super::fillet::{Trochoid, bisect};
use super::helix::base_helix;
use super::involute::inv;
use crate::numeric::Vec2;

/// Fewest teeth of a gear.
pub const MIN_TEETH: u32 = 5;

/// Smallest thickness of tip land and tooth foot, modules: below it a tooth counts as pointed or cut through.
const MIN_THICKNESS: f64 = 0.05;

/// What distinguishes one member from others cut by the same rack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToothSpec {
    /// Number of teeth.
    pub teeth: u32,
    /// Profile shift, modules.
    pub profile_shift: f64,
    /// Reduction of the tooth thickness at the reference circle, mm, half on each flank: the tool is wider by this amount,
    /// so tip and root circle stay.
    pub thickness_reduction: f64,
    /// Bore diameter, mm.
    pub bore_diameter: f64,
    /// Linear tip relief at the tip circle, normal to the flank, mm.
    pub tip_relief_amount: f64,
    /// Length of the tip relief from the tip circle, mm along the path of contact (steps of curvature radius).
    pub tip_relief_length: f64,
    /// Radius of the rounding between involute and tip circle, mm; 0 = sharp corner.
    pub tip_rounding: f64,
}

impl ToothSpec {
    /// A plain tooth: no shift, thinning, relief or rounding; bore in mm.
    pub fn plain(teeth: u32, bore_diameter: f64) -> ToothSpec {
        ToothSpec {
            teeth,
            profile_shift: 0.0,
            thickness_reduction: 0.0,
            bore_diameter,
            tip_relief_amount: 0.0,
            tip_relief_length: 0.0,
            tip_rounding: 0.0,
        }
    }
}

/// One gear, possible by construction: the transverse section of a helical one. Lengths mm, angles rad; frame as in the module's head.
#[derive(Debug, Clone, PartialEq)]
pub struct Gear {
    /// The generating rack, in the transverse section.
    pub rack: BasicRack,
    /// Helix angle at the reference circle, rad, 0 for a spur gear; of both members of a pair that of the pinion, positive where it is
    /// right-handed.
    pub helix_angle: f64,
    /// The tooth's data.
    pub spec: ToothSpec,
    /// Radius of the base circle: m z cos α / 2.
    pub base_radius: f64,
    /// Radius of the reference circle: m z / 2.
    pub reference_radius: f64,
    /// Radius of the tip circle: m (z/2 + x + h_aP), no tip shortening.
    pub tip_radius: f64,
    /// Radius of the root circle: m (z/2 + x − h_fP).
    pub root_radius: f64,
    /// Radius at which fillet and involute meet.
    pub form_radius: f64,
    /// Whether the fillet cuts into the involute instead of touching it.
    pub undercut: bool,
    /// Curvature radius of the involute at the form radius.
    pub rho_form: f64,
    /// Curvature radius of the involute at the tip circle (sharp corner).
    pub rho_tip: f64,
    /// Curvature radius at the end of the usable involute: `rho_tip`, or the start of the tip rounding.
    pub rho_end: f64,
    /// Curvature radius of the involute at the foot of the last point that can touch: `rho_tip`, or where a tip rounding has turned so far that what
    /// lies beyond stands back by a third of its radius.
    pub rho_last: f64,
    /// Half the angular thickness that the tooth would have at the base circle: s/(2 r) + inv α.
    pub base_half_angle: f64,
    /// The fillet in the frame of the tooth space.
    pub trochoid: Trochoid,
    /// Measured profile: ascending curvature radii and the material missing there against the involute, mm; empty = none.
    pub profile: Vec<[f64; 2]>,
}

impl Gear {
    /// The gear that `rack` cuts.
    ///
    /// # Errors
    /// A [`GearError`] with the value found and what is allowed if such a gear cannot exist.
    pub fn new(rack: BasicRack, spec: ToothSpec) -> Result<Gear, GearError> {
        rack.check()?;
        check_numbers(&spec)?;
        let m = rack.module;
        let max_fillet = rack.full_round_radius(spec.thickness_reduction);
        if rack.fillet_radius < 0.0 || rack.fillet_radius > max_fillet {
            return Err(GearError::FilletRadius {
                radius: rack.fillet_radius,
                max: max_fillet.max(0.0),
            });
        }
        let reference_radius = 0.5 * m * f64::from(spec.teeth);
        let root_radius = reference_radius + (spec.profile_shift - rack.dedendum) * m;
        if root_radius <= 0.0 {
            return Err(GearError::NegativeRoot { root_radius });
        }
        let (sin, cos) = rack.pressure_angle.sin_cos();
        let base_radius = reference_radius * cos;
        let tip_radius = reference_radius + (spec.profile_shift + rack.addendum) * m;
        if tip_radius <= base_radius.max(root_radius) {
            return Err(GearError::NoInvolute {
                form_radius: base_radius.max(root_radius),
                tip_radius,
            });
        }
        let thickness =
            m * (FRAC_PI_2 + 2.0 * spec.profile_shift * sin / cos) - spec.thickness_reduction;
        let rounding = rack.fillet_radius * m;
        let mut gear = Gear {
            rack,
            helix_angle: 0.0,
            spec,
            base_radius,
            reference_radius,
            tip_radius,
            root_radius,
            form_radius: 0.0,
            undercut: false,
            rho_form: 0.0,
            rho_tip: 0.0,
            rho_end: 0.0,
            rho_last: 0.0,
            base_half_angle: 0.5 * thickness / reference_radius + inv(rack.pressure_angle),
            trochoid: Trochoid {
                rolling_radius: reference_radius,
                centre_u: 0.25 * PI * m + 0.5 * spec.thickness_reduction
                    - (rack.dedendum * m - rounding) * sin / cos
                    - rounding / cos,
                centre_v: root_radius + rounding,
                rounding,
                beta_end: rack.pressure_angle,
            },
            profile: Vec::new(),
        };
        gear.rho_tip = gear.rho_at_radius(tip_radius);
        let tip_thickness = 2.0 * tip_radius * gear.half_angle(tip_radius);
        if tip_thickness < MIN_THICKNESS * m {
            return Err(GearError::PointedTooth {
                tip_thickness,
                min: MIN_THICKNESS * m,
            });
        }
        gear.join_fillet()?;
        let max_bore = 2.0 * (root_radius - 0.5 * m);
        // up to it, whatever rounding makes of the limit
        if spec.bore_diameter > max_bore + 1e-9 * m {
            return Err(GearError::Bore {
                diameter: spec.bore_diameter,
                max: max_bore,
            });
        }
        gear.finish_tip()?;
        Ok(gear)
    }

    /// By how many base pitches sections stand turned per mm along the face: tan β_b/p_b, 0 for a spur gear.
    pub fn turned_per_mm(&self) -> f64 {
        base_helix(self.helix_angle, self.rack.pressure_angle).tan() / self.rack.base_pitch()
    }

    /// The same as the transverse section of a helical gear.
    pub fn helical(mut self, helix_angle: f64) -> Self {
        self.helix_angle = helix_angle;
        self
    }

    /// Half the angular tooth thickness at radius `r` (mm, between base and tip circle) of the nominal involute, rad. The
    /// loaded flank of tooth 0 lies at this polar angle, the other one at its negative.
    ///
    /// ```text
    /// ψ(r) = s/(2 r_0) + inv α − inv α_r ,   cos α_r = r_b / r ,   s = m (π/2 + 2 x tan α) − thickness reduction
    /// ```
    pub fn half_angle(&self, r: f64) -> f64 {
        let xi = self.rho_at_radius(r) / self.base_radius;
        self.base_half_angle - xi + xi.atan()
    }

    /// Half the angular tooth thickness at any radius from root to tip circle, rad: fillet below, involute above the form
    /// circle (without relief and tip rounding).
    pub fn solid_half_angle(&self, r: f64) -> f64 {
        if r >= self.form_radius {
            self.half_angle(r)
        } else {
            0.5 * self.pitch_angle() - self.trochoid.angle(self.trochoid.beta_at_radius(r))
        }
    }

    /// Whether the point at radius `r` below the form circle, mm, and polar angle `polar`, rad, stands off the fillet of tooth 0, or stands in it by
    /// `depth` along the arc at most, mm.
    pub(super) fn is_off_fillet(&self, r: f64, polar: f64, depth: f64) -> bool {
        let half_pitch = 0.5 * self.pitch_angle();
        self.trochoid
            .decide_at_radius(r, |angle| r * (polar - (half_pitch - angle)) >= -depth)
    }

    /// Point of the loaded flank of tooth 0 with curvature radius `rho`, mm, on the nominal involute, member frame.
    pub fn involute_point(&self, rho: f64) -> Vec2 {
        let (s, c) = self.tangent_angle(rho).sin_cos();
        Vec2::new(
            self.base_radius * c - rho * s,
            self.base_radius * s + rho * c,
        )
    }

    /// Outward unit normal of the loaded flank of tooth 0 at curvature radius `rho`, mm, member frame.
    pub fn involute_normal(&self, rho: f64) -> Vec2 {
        let (s, c) = self.tangent_angle(rho).sin_cos();
        Vec2::new(-s, c)
    }

    /// Polar angle of the point where the normal at `rho` touches the base circle, rad, member frame, tooth 0.
    pub fn tangent_angle(&self, rho: f64) -> f64 {
        self.base_half_angle - rho / self.base_radius
    }

    /// Arc length along the involute from the base circle, mm: rho²/(2 r_b).
    pub fn arc(&self, rho: f64) -> f64 {
        0.5 * rho * rho / self.base_radius
    }

    /// Curvature radius at arc length `s` from the base circle, mm; 0 for s <= 0.
    pub fn rho_at_arc(&self, s: f64) -> f64 {
        (2.0 * self.base_radius * s.max(0.0)).sqrt()
    }

    /// Radius of the flank point at arc `s` from the involute's origin, mm.
    pub fn radius_at_arc(&self, s: f64) -> f64 {
        (self.base_radius * (self.base_radius + 2.0 * s.max(0.0))).sqrt()
    }

    /// Curvature radius at radius `r`, mm; 0 on and inside the base circle.
    pub fn rho_at_radius(&self, r: f64) -> f64 {
        ((r - self.base_radius) * (r + self.base_radius))
            .max(0.0)
            .sqrt()
    }

    /// Radius at curvature radius `rho`, mm.
    pub fn radius_at_rho(&self, rho: f64) -> f64 {
        self.base_radius.hypot(rho)
    }

    /// `n` >= 2 points of the loaded side's fillet of tooth 0, member frame, mm, from the root circle to the form point at
    /// equal steps of arc length. The other side follows by mirroring y. The root land, if there is one, goes on from the
    /// first point along the root circle to the middle of the space, at the polar angle π/z.
    pub fn fillet_points(&self, n: usize) -> Vec<Vec2> {
        let betas = self.trochoid.betas_by_arc(n);
        let mut points: Vec<Vec2> = betas.iter().map(|&beta| self.fillet_point(beta)).collect();
        if let Some(last) = points.last_mut() {
            // The same bits as the involute's first point, so that outlines close.
            *last = self.involute_point(self.rho_form);
        }
        points
    }

    /// Point of the loaded side's fillet of tooth 0 with the tool's normal angle `beta`, rad, member frame, mm.
    pub fn fillet_point(&self, beta: f64) -> Vec2 {
        self.space_to_member(self.trochoid.point(beta))
    }

    /// Outward unit normal of the fillet there.
    pub fn fillet_normal(&self, beta: f64) -> Vec2 {
        self.space_to_member(self.trochoid.normal(beta))
    }

    /// Half the angle of the root land between two fillets, rad; 0 for a fully rounded tool.
    pub fn root_land_half_angle(&self) -> f64 {
        self.trochoid.roll_angle(Trochoid::BETA_ROOT)
    }

    /// Angle from tooth to tooth, rad: 2π/z.
    pub fn pitch_angle(&self) -> f64 {
        2.0 * PI / f64::from(self.spec.teeth)
    }

    /// Bore radius, mm.
    pub fn bore_radius(&self) -> f64 {
        0.5 * self.spec.bore_diameter
    }

    /// Tooth thickness along the arc of the circle of radius `r` (mm, on the involute), mm.
    pub fn thickness(&self, r: f64) -> f64 {
        2.0 * r * self.half_angle(r)
    }

    /// From the frame of the tooth space above tooth 0 (mirrored: there tooth 0 is at negative y) to the member frame.
    fn space_to_member(&self, p: Vec2) -> Vec2 {
        crate::numeric::rotate(Vec2::new(p.x, -p.y), 0.5 * self.pitch_angle())
    }

    /// Finds where the involute begins: at the tool's straight flank, or at the intersection if the tool undercuts.
    fn join_fillet(&mut self) -> Result<(), GearError> {
        let sin = self.rack.pressure_angle.sin();
        let m = self.rack.module;
        let touch = self.reference_radius * sin
            + (self.spec.profile_shift * m - self.rack.straight_depth()) / sin;
        self.undercut = touch < 0.0;
        if self.undercut {
            let at_base = self.trochoid.beta_at_radius(self.base_radius);
            let half_pitch = 0.5 * self.pitch_angle();
            let excess = |beta: f64| {
                self.trochoid.angle(beta)
                    - (half_pitch - self.half_angle(self.trochoid.radius(beta)))
            };
            let beta = bisect(at_base, self.rack.pressure_angle, excess);
            self.trochoid.beta_end = beta;
            self.rho_form = self.rho_at_radius(self.trochoid.radius(beta));
        } else {
            self.rho_form = touch;
        }
        self.form_radius = self.radius_at_rho(self.rho_form);
        if self.rho_form >= self.rho_tip {
            return Err(GearError::NoInvolute {
                form_radius: self.form_radius,
                tip_radius: self.tip_radius,
            });
        }
        if self.undercut {
            let foot = |beta: f64| {
                2.0 * self.trochoid.radius(beta)
                    * (0.5 * self.pitch_angle() - self.trochoid.angle(beta))
            };
            let thickness = (0..=200)
                .map(|i| {
                    foot(FRAC_PI_2 + (self.trochoid.beta_end - FRAC_PI_2) * f64::from(i) / 200.0)
                })
                .fold(f64::INFINITY, f64::min);
            if thickness < MIN_THICKNESS * m {
                return Err(GearError::ThinFoot {
                    thickness,
                    min: MIN_THICKNESS * m,
                });
            }
        }
        Ok(())
    }
}

fn check_numbers(spec: &ToothSpec) -> Result<(), GearError> {
    for (quantity, value) in [
        ("profile shift", spec.profile_shift),
        ("thickness reduction", spec.thickness_reduction),
        ("bore diameter", spec.bore_diameter),
        ("tip relief amount", spec.tip_relief_amount),
        ("tip relief length", spec.tip_relief_length),
        ("tip rounding", spec.tip_rounding),
    ] {
        if !value.is_finite() {
            return Err(GearError::NotFinite { quantity, value });
        }
    }
    if spec.teeth < MIN_TEETH {
        return Err(GearError::TooFewTeeth {
            teeth: spec.teeth,
            min: MIN_TEETH,
        });
    }
    if spec.bore_diameter <= 0.0 {
        return Err(GearError::NotPositive {
            quantity: "bore diameter",
            value: spec.bore_diameter,
        });
    }
    for (quantity, value) in [
        ("tip relief amount", spec.tip_relief_amount),
        ("tip relief length", spec.tip_relief_length),
        ("tip rounding", spec.tip_rounding),
    ] {
        if value < 0.0 {
            return Err(GearError::Negative { quantity, value });
        }
    }
    Ok(())
}
