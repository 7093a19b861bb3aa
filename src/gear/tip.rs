//! The tip: linear relief and the rounding of the corner.

use super::error::GearError;
use super::fillet::bisect;
use super::tooth::Gear;
use crate::numeric::Vec2;

/// How far a tip rounding turns away from the involute up to where it can touch, rad: what lies beyond stands back by more than a third of the
/// rounding's radius.
const LAST_TURN: f64 = 0.9;

/// A circular arc between the loaded involute of tooth 0 and the tip circle, tangent to both, member frame, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipRounding {
    /// Centre of the arc.
    pub centre: Vec2,
    /// Radius of the arc.
    pub radius: f64,
    /// Where it leaves the involute (at `rho_end`).
    pub start: Vec2,
    /// Where it reaches the tip circle.
    pub end: Vec2,
}

impl TipRounding {
    /// `n` >= 2 points from `start` to `end` at equal steps, both included, mm.
    pub fn points(&self, n: usize) -> Vec<Vec2> {
        let (from, to) = (self.start - self.centre, self.end - self.centre);
        let begin = from.y.atan2(from.x);
        let sweep = crate::numeric::cross(from, to).atan2(from.dot(&to));
        let n = n.max(2);
        (0..n)
            .map(|i| match i {
                0 => self.start,
                i if i == n - 1 => self.end,
                i => {
                    let (s, c) = (begin + sweep * i as f64 / (n - 1) as f64).sin_cos();
                    self.centre + self.radius * Vec2::new(c, s)
                }
            })
            .collect()
    }
}

impl Gear {
    /// Material missing normal to the flank at curvature radius `rho`, mm: tip rounding, the stated tip relief and the measured profile.
    /// The nominal involute leaves all of them out.
    pub fn relief(&self, rho: f64) -> f64 {
        self.rounded_off(rho) + self.tip_relief(rho) + self.measured(rho)
    }

    /// Material that the tip rounding takes off normal to the involute at curvature radius `rho` up to `rho_last`, mm; beyond, what it takes off there.
    ///
    /// ```text
    /// involute point P with normal n, arc of radius t about c:   w = P − c,   |w − s n| = t
    /// s = w·n − sqrt((w·n)² − |w|² + t²)
    /// ```
    pub fn rounded_off(&self, rho: f64) -> f64 {
        if rho <= self.rho_end || self.spec.tip_rounding <= 0.0 {
            return 0.0;
        }
        let rho = rho.min(self.rho_last);
        let across = self.involute_point(rho) - self.rounding_centre();
        let along = across.dot(&self.involute_normal(rho));
        along - self.turned_share(rho) * self.spec.tip_rounding
    }

    /// The point of the loaded flank of tooth 0 at curvature radius `rho`, before wear and relief but on the rounding of the tip, mm.
    pub fn flank_point(&self, rho: f64) -> Vec2 {
        let point = self.involute_point(rho);
        if rho <= self.rho_end || self.spec.tip_rounding <= 0.0 {
            return point;
        }
        point - self.rounded_off(rho) * self.involute_normal(rho)
    }

    fn rounding_centre(&self) -> Vec2 {
        self.involute_point(self.rho_end)
            - self.spec.tip_rounding * self.involute_normal(self.rho_end)
    }

    /// Cosine of the angle by which the rounding has turned away from the involute at `rho`; negative beyond the arc.
    fn turned_share(&self, rho: f64) -> f64 {
        let across = self.involute_point(rho) - self.rounding_centre();
        let along = across.dot(&self.involute_normal(rho));
        let radius = self.spec.tip_rounding;
        let square = (along * along - across.norm_squared()) / (radius * radius) + 1.0;
        square.abs().sqrt().copysign(square)
    }

    /// Takes a measured profile: rows of ascending radius and missing material, mm, in place of one it had.
    pub fn set_profile(&mut self, rows: &[[f64; 2]]) {
        self.profile = rows
            .iter()
            .map(|[radius, missing]| [self.rho_at_radius(*radius), *missing])
            .collect();
    }

    /// The measured profile at `rho`: linear between the rows, constant beyond the ends; 0 without one.
    fn measured(&self, rho: f64) -> f64 {
        let rows = &self.profile;
        let next = rows.partition_point(|row| row[0] <= rho);
        match (next.checked_sub(1).map(|i| rows[i]), rows.get(next)) {
            (Some(a), Some(b)) => a[1] + (b[1] - a[1]) * (rho - a[0]) / (b[0] - a[0]),
            (Some(end), None) => end[1],
            (None, Some(end)) => end[1],
            (None, None) => 0.0,
        }
    }

    /// Material removed normal to the flank by the stated tip relief at curvature radius `rho`, mm.
    ///
    /// ```text
    /// C(rho) = C_a (rho − rho_tip + L) / L     above rho_tip − L, 0 below
    /// ```
    /// Measured from the sharp tip corner, also if the corner is rounded.
    fn tip_relief(&self, rho: f64) -> f64 {
        let (amount, length) = (self.spec.tip_relief_amount, self.spec.tip_relief_length);
        if amount <= 0.0 {
            return 0.0;
        }
        amount * ((rho - (self.rho_tip - length)) / length).max(0.0)
    }

    /// The rounding of the loaded tip corner of tooth 0, if one is stated.
    ///
    /// ```text
    /// centre on the involute's inner parallel at distance t and on the circle r_a − t:
    /// rho_end = t + sqrt((r_a − t)² − r_b²)
    /// ```
    pub fn tip_rounding_arc(&self) -> Option<TipRounding> {
        let radius = self.spec.tip_rounding;
        if radius <= 0.0 {
            return None;
        }
        let start = self.involute_point(self.rho_end);
        let centre = self.rounding_centre();
        Some(TipRounding {
            centre,
            radius,
            start,
            end: centre * (self.tip_radius / centre.norm()),
        })
    }

    /// Half the angle of the tip land that corner or rounding leave, rad.
    pub fn tip_land_half_angle(&self) -> f64 {
        self.land_half_angle(self.spec.tip_rounding)
    }

    /// Checks relief and rounding and finds the end of the usable involute.
    pub(super) fn finish_tip(&mut self) -> Result<(), GearError> {
        let max_amount = 0.1 * self.rack.module;
        let (amount, length) = (self.spec.tip_relief_amount, self.spec.tip_relief_length);
        if amount > max_amount {
            return Err(GearError::TipReliefAmount {
                amount,
                max: max_amount,
            });
        }
        let max_length = self.rho_tip - self.rho_form;
        if amount > 0.0 && (length <= 0.0 || length > max_length) {
            return Err(GearError::TipReliefLength {
                length,
                max: max_length,
            });
        }
        let radius = self.spec.tip_rounding;
        if self.room_for_rounding(radius) < 0.0 {
            let max = bisect(0.0, self.tip_radius - self.base_radius, |t| {
                self.room_for_rounding(t)
            });
            return Err(GearError::TipRounding { radius, max });
        }
        self.rho_end = self.rounding_start(radius);
        self.rho_last = self.rho_tip;
        if radius > 0.0 && self.turned_share(self.rho_tip) < LAST_TURN.cos() {
            let left = |rho: f64| self.turned_share(rho) - LAST_TURN.cos();
            self.rho_last = bisect(self.rho_end, self.rho_tip, left);
        }
        Ok(())
    }

    /// Curvature radius at which a rounding of radius `t` leaves the involute, mm; `rho_tip` for 0.
    fn rounding_start(&self, t: f64) -> f64 {
        if t > 0.0 {
            t + self.rho_at_radius(self.tip_radius - t)
        } else {
            self.rho_tip
        }
    }

    /// Polar angle of the end of a rounding of radius `t` on the tip circle, rad.
    fn land_half_angle(&self, t: f64) -> f64 {
        let rho = self.rounding_start(t);
        self.tangent_angle(rho) + (rho - t).atan2(self.base_radius)
    }

    /// Negative if a rounding of radius `t` does not fit; its zero is the largest rounding, mm.
    fn room_for_rounding(&self, t: f64) -> f64 {
        let land = self.tip_radius * self.land_half_angle(t);
        let involute = self.rounding_start(t) - self.rho_form;
        let above_base = self.tip_radius - t - self.base_radius;
        land.min(involute).min(above_base)
    }
}
