//! The curves that bound a gear tooth, and their division into edges of given sizes.

use crate::gear::{Gear, Trochoid};
use crate::numeric::{Vec2, rotate};

/// A smooth piece of boundary in the frame of tooth 0, by (nearly) arc length from its start, body on the left.
pub(super) struct Curve {
    /// Length, mm.
    pub(super) length: f64,
    /// Fewest edges it may be divided into.
    pub(super) least: usize,
    place: Box<dyn Fn(f64) -> Vec2>,
}

impl Curve {
    pub(super) fn new(length: f64, least: usize, place: impl Fn(f64) -> Vec2 + 'static) -> Curve {
        Curve {
            length,
            least,
            place: Box::new(place),
        }
    }

    /// The same curve turned about the gear's centre.
    pub(super) fn turned(self, angle: f64) -> Curve {
        let place = self.place;
        Curve {
            place: Box::new(move |s| rotate(place(s), angle)),
            ..self
        }
    }

    /// Point at distance `s` (0 to `length`) from the start, mm.
    pub(super) fn at(&self, s: f64) -> Vec2 {
        (self.place)(s)
    }

    /// Cuts for edges about `size(x)` long (x in this curve's frame): distances from 0 to `length`, both included.
    ///
    /// ```text
    /// cuts at equal steps of N(s) = ∫ ds / h(s)
    /// ```
    pub(super) fn divide(&self, size: &dyn Fn(Vec2) -> f64) -> Vec<f64> {
        let mut marks = vec![(0.0, 0.0)];
        let (mut s, mut total) = (0.0, 0.0);
        let mut h = size(self.at(0.0));
        while s < self.length {
            let next = (s + 0.25 * h).min(self.length);
            let h_next = size(self.at(next));
            total += (next - s) * 0.5 * (1.0 / h + 1.0 / h_next);
            (s, h) = (next, h_next);
            marks.push((s, total));
        }
        let n = (total.round() as usize).max(self.least);
        let mut cuts = vec![0.0];
        let mut at = 1;
        for k in 1..n {
            let wanted = total * k as f64 / n as f64;
            while marks[at].1 < wanted {
                at += 1;
            }
            let ((s0, n0), (s1, n1)) = (marks[at - 1], marks[at]);
            cuts.push(s0 + (s1 - s0) * (wanted - n0) / (n1 - n0));
        }
        cuts.push(self.length);
        cuts
    }
}

/// The loaded involute of tooth 0 from curvature radius `top` down to `bottom`; distances count from the top.
pub(super) fn involute_down(gear: &Gear, top: f64, bottom: f64) -> Curve {
    down(gear, top, bottom, Gear::involute_point)
}

/// The same along the loaded flank with its rounded tip; distances count along the involute there too.
pub(super) fn flank_down(gear: &Gear, top: f64, bottom: f64) -> Curve {
    down(gear, top, bottom, Gear::flank_point)
}

fn down(gear: &Gear, top: f64, bottom: f64, point: fn(&Gear, f64) -> Vec2) -> Curve {
    let g = gear.clone();
    let (s_top, length) = (g.arc(top), g.arc(top) - g.arc(bottom));
    Curve::new(length, 1, move |s| {
        if s <= 0.0 {
            point(&g, top)
        } else if s >= length {
            point(&g, bottom)
        } else {
            point(&g, g.rho_at_arc(s_top - s))
        }
    })
}

/// The other flank of tooth 0 from the form circle up to `top`.
pub(super) fn involute_up(gear: &Gear, top: f64) -> Curve {
    let down = involute_down(gear, top, gear.rho_form);
    let length = down.length;
    Curve::new(length, 1, move |s| mirror(down.at(length - s)))
}

/// The tip land of tooth 0 between the angles `from` and `to` on the tip circle.
pub(super) fn tip_land(gear: &Gear, from: f64, to: f64) -> Curve {
    let r = gear.tip_radius;
    Curve::new(r * (to - from), 1, move |s| polar(r, from + s / r))
}

/// The ledge below a worn flank of tooth 0: along the circle through the involute's point at curvature radius `rho`, from the
/// angle `back` behind it up to it.
pub(super) fn ledge(gear: &Gear, rho: f64, back: f64) -> Curve {
    let (to, r) = (gear.involute_point(rho), gear.radius_at_rho(rho));
    Curve::new(r * back, 1, move |s| rotate(to, s / r - back))
}

/// The rounding of the loaded tip corner, from the land to the flank's last point that can touch; `None` for a sharp corner.
pub(super) fn rounding_down(gear: &Gear) -> Option<Curve> {
    let arc = gear.tip_rounding_arc()?;
    let last = gear.flank_point(gear.rho_last);
    let (from, to) = (arc.end - arc.centre, last - arc.centre);
    let begin = from.y.atan2(from.x);
    let sweep = crate::numeric::cross(from, to).atan2(from.dot(&to));
    let length = arc.radius * sweep;
    let least = (sweep / 1.2).ceil() as usize;
    Some(Curve::new(length, least, move |s| {
        if s <= 0.0 {
            arc.end
        } else if s >= length {
            last
        } else {
            arc.centre + polar(arc.radius, begin + s / arc.radius)
        }
    }))
}

/// The bottom of the space after tooth 0: its fillet down, the root land, the next tooth's fillet up. Smooth throughout.
pub(super) fn root(gear: &Gear) -> Curve {
    const FINE: usize = 400;
    let g = gear.clone();
    let betas = g.trochoid.betas_by_arc(FINE + 1);
    let fillet: f64 = (0..FINE)
        .map(|i| (g.fillet_point(betas[i]) - g.fillet_point(betas[i + 1])).norm())
        .sum();
    let half_land = g.root_radius * g.root_land_half_angle().max(0.0);
    let half = fillet + half_land;
    let middle = 0.5 * g.pitch_angle();
    // Distance `u` from the middle of the space, on the side of tooth 0.
    let side = move |u: f64| {
        if u >= half {
            g.involute_point(g.rho_form)
        } else if u <= half_land {
            polar(g.root_radius, middle - u / g.root_radius)
        } else {
            let t = (u - half_land) / fillet * FINE as f64;
            let i = (t as usize).min(FINE - 1);
            let beta = betas[i] + (t - i as f64) * (betas[i + 1] - betas[i]);
            g.fillet_point(beta.clamp(g.trochoid.beta_end, Trochoid::BETA_ROOT))
        }
    };
    let pitch = 2.0 * middle;
    Curve::new(2.0 * half, 4, move |s| {
        if s <= half {
            side(half - s)
        } else {
            rotate(mirror(side(s - half)), pitch)
        }
    })
}

fn polar(r: f64, angle: f64) -> Vec2 {
    r * Vec2::new(angle.cos(), angle.sin())
}

fn mirror(p: Vec2) -> Vec2 {
    Vec2::new(p.x, -p.y)
}
