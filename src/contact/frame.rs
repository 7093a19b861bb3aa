//! Where a tooth pair meets at a mesh position, and in which frame its contact is described.
//!
//! Inside the path of contact the frame sits on the line of action. Outside it the sharp tip corner of one tooth is the
//! nearest to the other's flank; the frame then sits at the foot of the corner on that flank, with the flank's normal. A rounded corner
//! begins where the involute ends, and both flanks' distance follows it from there.

use crate::contact::mortar::Facing;
use crate::gear::Pair;
use crate::numeric::{Vec2, rotate};

/// Which parts of a tooth pair face each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Touch {
    /// Flank against flank on the line of action.
    Flanks,
    /// The pinion's tip corner against the gear's flank (after the end of the path of contact).
    PinionTip,
    /// The gear's tip corner against the pinion's flank (before its start).
    GearTip,
}

/// Newton's method on an involute ends with a step below this, modules: what is left is its square over twice the curvature radius.
const NEWTON_STEP: f64 = 5e-6;

/// Newton's method starts no nearer to the base circle than this share of the squared curvature radius at the frame's own point.
const NEAREST_BASE: f64 = 1e-2;

/// Contact frame of one tooth pair at one mesh position, in the fixed frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// What touches.
    pub touch: Touch,
    /// Origin of the tangent coordinate ξ, mm.
    pub origin: Vec2,
    /// Unit normal from the pinion into the gear.
    pub normal: Vec2,
    /// Unit tangent, ξ grows towards the pinion's tip.
    pub tangent: Vec2,
    /// Distance between the bodies at the origin along the normal, mm (0 on the line of action).
    pub separation: f64,
    /// Curvature radius of the involutes at ξ = 0, mm.
    pub rho: [f64; 2],
    flanks: [PlacedInvolute; 2],
    module: f64,
    /// Curvature radius at the first and last usable point of each flank, mm.
    range: [[f64; 2]; 2],
}

impl Frame {
    /// The frame of the tooth pair whose nominal contact lies at `path` (mm from the pitch point along the path of contact).
    ///
    /// `None` if the corner has no foot on the other flank, that is far outside the path of contact.
    pub fn new(pair: &Pair, path: f64) -> Option<Self> {
        let flanks = PlacedInvolute::pair(pair, path);
        let members = [&pair.pinion, &pair.gear];
        let range = members.map(|g| [g.rho_form, g.rho_last]);
        // with a rounded tip the end of the involute stands for the corner
        let corner = members.map(|g| g.rho_end);
        let rho1 = pair.rho_c + path;
        let frame = |touch, origin, normal: Vec2, separation, rho| Self {
            touch,
            origin,
            normal,
            tangent: Vec2::new(normal.y, -normal.x),
            separation,
            rho,
            flanks,
            module: pair.pinion.rack.module,
            range,
        };
        if rho1 < pair.rho_a {
            let (foot, separation) = flanks[0].project(flanks[1].point(corner[1]))?;
            let normal = flanks[0].normal(foot);
            Some(frame(
                Touch::GearTip,
                flanks[0].point(foot),
                normal,
                separation,
                [foot, corner[1]],
            ))
        } else if rho1 > pair.rho_e {
            let (foot, separation) = flanks[1].project(flanks[0].point(corner[0]))?;
            let normal = -flanks[1].normal(foot);
            Some(frame(
                Touch::PinionTip,
                flanks[1].point(foot),
                normal,
                separation,
                [corner[0], foot],
            ))
        } else {
            Some(frame(
                Touch::Flanks,
                pair.contact_point(path),
                pair.normal(),
                0.0,
                [rho1, pair.rho_gear(path)],
            ))
        }
    }

    /// The interval of ξ within ±`window` in which both flanks exist, mm.
    pub fn extent(&self, window: f64) -> (f64, f64) {
        let along =
            |side: usize, rho: f64| (self.flanks[side].point(rho) - self.origin).dot(&self.tangent);
        let low = (-window)
            .max(along(0, self.range[0][0]))
            .max(along(1, self.range[1][1]));
        let high = window
            .min(along(0, self.range[0][1]))
            .min(along(1, self.range[1][0]));
        (low, high)
    }

    /// The points of the two flanks that face each other at ξ: curvature radii and distance along the normal, mm.
    pub fn facing_rho(&self, xi: f64) -> ([f64; 2], f64) {
        let mut rho = self.rho;
        let mut height = [0.0; 2];
        for side in 0..2 {
            let curve = &self.flanks[side];
            // an arc of length ξ from the frame's own point: the flank turns so little that it is nearly there
            let turn = [2.0, -2.0][side] * curve.base_radius * xi;
            // (but on the base circle itself the involute has no tangent to go on along)
            let square = rho[side] * rho[side];
            rho[side] = (square + turn).max(NEAREST_BASE * square).sqrt();
            // Newton's method on the tangent coordinate; an involute is smooth and monotone here
            let mut offset = Vec2::zeros();
            for _ in 0..20 {
                let (point, slope) = curve.point_and_slope(rho[side]);
                offset = point - self.origin;
                let miss = offset.dot(&self.tangent) - xi;
                let step = miss / slope.dot(&self.tangent);
                rho[side] -= step;
                if step.abs() < NEWTON_STEP * self.module {
                    offset -= slope * step;
                    break;
                }
            }
            height[side] = offset.dot(&self.normal);
        }
        (rho, height[1] - height[0])
    }

    /// What faces what at ξ, profile deviations (tip relief, tip rounding) included.
    pub fn facing(&self, pair: &Pair, xi: f64) -> Facing {
        let (rho, gap) = self.facing_rho(xi);
        let members = [&pair.pinion, &pair.gear];
        let removed: f64 = (0..2).map(|i| members[i].relief(rho[i])).sum();
        Facing {
            arc: [members[0].arc(rho[0]), members[1].arc(rho[1])],
            gap: gap + removed,
        }
    }

    /// Signed distance of the origin from the pitch point along the normal, mm: the sliding velocity is
    /// (ω₁ + ω₂) times it.
    pub fn sliding_arm(&self, pair: &Pair) -> f64 {
        (self.origin - Vec2::new(pair.pitch_radius_pinion, 0.0)).dot(&self.normal)
    }
}

/// The loaded flank of one tooth as an involute placed in the fixed frame.
#[derive(Debug, Clone, Copy, PartialEq)]
struct PlacedInvolute {
    centre: Vec2,
    base_radius: f64,
    /// Angle of the involute's origin on the base circle, rad.
    origin_angle: f64,
}

impl PlacedInvolute {
    fn pair(pair: &Pair, path: f64) -> [Self; 2] {
        let place = |gear: &crate::gear::Gear, centre, turn| Self {
            centre,
            base_radius: gear.base_radius,
            origin_angle: turn + gear.half_angle(gear.base_radius),
        };
        [
            place(&pair.pinion, Vec2::zeros(), pair.pinion_angle(path)),
            place(
                &pair.gear,
                Vec2::new(pair.centre_distance, 0.0),
                pair.gear_angle(path),
            ),
        ]
    }

    /// Radial and circumferential unit vectors at the tangent point that belongs to `rho`.
    fn axes(&self, rho: f64) -> (Vec2, Vec2) {
        let radial = rotate(Vec2::x(), self.origin_angle - rho / self.base_radius);
        (radial, Vec2::new(-radial.y, radial.x))
    }

    fn point(&self, rho: f64) -> Vec2 {
        let (radial, around) = self.axes(rho);
        self.centre + radial * self.base_radius + around * rho
    }

    /// The point and its derivative by rho: (rho/r_b) times the radial direction of the tangent point.
    fn point_and_slope(&self, rho: f64) -> (Vec2, Vec2) {
        let (radial, around) = self.axes(rho);
        (
            self.centre + radial * self.base_radius + around * rho,
            radial * (rho / self.base_radius),
        )
    }

    /// Outward unit normal: along the tangent to the base circle.
    fn normal(&self, rho: f64) -> Vec2 {
        self.axes(rho).1
    }

    /// Foot of the perpendicular from `x` and the signed distance along the outward normal.
    ///
    /// Normals of an involute are tangents of its base circle, so the foot lies on the tangent through `x`.
    fn project(&self, x: Vec2) -> Option<(f64, f64)> {
        let d = x - self.centre;
        let length = (d.norm_squared() - self.base_radius * self.base_radius).sqrt();
        let tangent_angle = d.y.atan2(d.x) - (length / self.base_radius).atan();
        let turn = self.origin_angle - tangent_angle;
        let rho = self.base_radius
            * (turn - std::f64::consts::TAU * (turn / std::f64::consts::TAU).round());
        (length.is_finite() && rho > 0.0).then_some((rho, length - rho))
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::gear::{BasicRack, Gear, ToothSpec};

    pub(crate) fn reference() -> Pair {
        let rack = BasicRack {
            module: 2.0,
            pressure_angle: 20f64.to_radians(),
            addendum: 1.0,
            dedendum: 1.25,
            fillet_radius: 0.38,
        };
        let gear = |z, bore| Gear::new(rack, ToothSpec::plain(z, bore)).unwrap();
        Pair::new(gear(27, 25.0), gear(53, 40.0), 80.0, 0.0).unwrap()
    }

    #[test]
    fn the_gap_is_that_of_the_osculating_circles() {
        let pair = reference();
        for path in [-5.0, -2.0, 0.0, 1.0, 4.5] {
            let frame = Frame::new(&pair, path).unwrap();
            let (_, gap) = frame.facing_rho(0.0);
            assert!(gap.abs() < 1e-12);
            for xi in [0.02, -0.02] {
                let (rho, gap) = frame.facing_rho(xi);
                let expected = xi * xi / (2.0 * pair.relative_radius(path));
                // an involute's curvature radius changes by r_b/rho per arc, so the third order term is about xi r_b/rho²
                let third = xi.abs() * pair.pinion.base_radius / rho[0].powi(2);
                assert!(
                    (gap / expected - 1.0).abs() < third,
                    "{gap} against {expected}"
                );
            }
        }
    }

    /// Down to the base circle, where an involute's curvature radius vanishes: the points found lie at ξ, on their involutes.
    #[test]
    fn facing_points_lie_at_xi_down_to_the_base_circle() {
        let pair = reference();
        for path in [-5.0, 0.0, 4.5] {
            let frame = Frame::new(&pair, path).unwrap();
            // how far along the tangent the pinion's involute begins
            let base = (frame.flanks[0].point(0.0) - frame.origin).dot(&frame.tangent);
            for share in [-0.3, 0.2, 0.7, 0.95, 0.99] {
                let xi = share * base;
                let (rho, _) = frame.facing_rho(xi);
                for (side, rho) in rho.into_iter().enumerate() {
                    assert!(rho.is_finite() && rho > 0.0, "{rho} at {xi}");
                    let at = frame.flanks[side].point(rho) - frame.origin;
                    let off = at.dot(&frame.tangent) - xi;
                    assert!(off.abs() < 1e-9, "{off} mm at {xi} mm, side {side}");
                }
            }
        }
    }

    #[test]
    fn corners_separate_smoothly_outside_the_path_of_contact() {
        let pair = reference();
        for (edge, outward) in [
            (pair.rho_a - pair.rho_c, -1.0),
            (pair.rho_e - pair.rho_c, 1.0),
        ] {
            let at = |d: f64| Frame::new(&pair, edge + outward * d).unwrap();
            assert_eq!(at(-0.01).touch, Touch::Flanks);
            assert_ne!(at(0.01).touch, Touch::Flanks);
            // quadratic growth of the separation, continuous normal
            let ratio = at(0.02).separation / at(0.01).separation;
            assert!((ratio - 4.0).abs() < 0.2, "{ratio}");
            assert!((at(1e-6).normal - pair.normal()).norm() < 1e-6);
            // the corner's own distance is the gap at xi = 0
            let (_, gap) = at(0.3).facing_rho(0.0);
            assert!((gap - at(0.3).separation).abs() < 1e-12);
        }
    }
}
