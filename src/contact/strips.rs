//! Which part of each tooth's flank a mesh cycle can bring into contact. A base pitch of positions takes every pair of teeth past a
//! part of its flanks only, so members need their compliance on little more than one flank's length, whatever the number of teeth.

use crate::contact::cycle::{CORNER_MARGIN, CycleSpec, rotations};
use crate::contact::frame::Frame;
use crate::gear::{Pair, contacts_at};

/// How much wider than it is at the time the strip may become in which contact is looked for: two widenings fit in.
const ROOM: f64 = 2.0;

/// The parts of the flanks that can touch.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Strips {
    parts: [Vec<Strip>; 2],
}

/// One tooth's part: first and last arc coordinate, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Strip {
    tooth: i32,
    arc: [f64; 2],
}

impl Strips {
    /// What the positions of a mesh cycle of this resolution can touch, and all rotations between them.
    pub fn new(pair: &Pair, spec: CycleSpec) -> Self {
        let mut out = Self::default();
        let half = 0.5 / spec.positions as f64;
        for theta in rotations(pair, spec) {
            for theta in [theta - half, theta, theta + half] {
                for contact in contacts_at(pair, theta, CORNER_MARGIN * pair.base_pitch) {
                    let Some(frame) = Frame::new(pair, contact.path) else {
                        continue;
                    };
                    let (low, high) = frame.extent(spec.window);
                    if frame.separation > spec.reach || high <= low {
                        continue;
                    }
                    let ends = [low, high].map(|xi| frame.facing(pair, xi).arc);
                    for side in 0..2 {
                        let tooth = [contact.pinion_tooth, -contact.pinion_tooth][side];
                        out.add(side, tooth, [ends[0][side], ends[1][side]]);
                    }
                }
            }
        }
        out
    }

    /// As [`Strips::new`], with room for contacts that wear makes wider.
    pub fn with_room(pair: &Pair, spec: CycleSpec) -> Self {
        let window = ROOM * spec.window;
        Self::new(pair, CycleSpec { window, ..spec })
    }

    /// Both together.
    #[must_use]
    pub fn and(mut self, other: &Self) -> Self {
        for (side, parts) in other.parts.iter().enumerate() {
            for part in parts {
                self.add(side, part.tooth, part.arc);
            }
        }
        self
    }

    fn add(&mut self, side: usize, tooth: i32, arc: [f64; 2]) {
        let (low, high) = (arc[0].min(arc[1]), arc[0].max(arc[1]));
        match self.parts[side].iter_mut().find(|s| s.tooth == tooth) {
            Some(known) => known.arc = [known.arc[0].min(low), known.arc[1].max(high)],
            None => self.parts[side].push(Strip {
                tooth,
                arc: [low, high],
            }),
        }
    }

    /// First and last arc coordinate (mm) of a tooth of member `side` (0 pinion, 1 gear) that can touch.
    pub fn of(&self, side: usize, tooth: i32) -> Option<[f64; 2]> {
        let part = self.parts[side].iter().find(|s| s.tooth == tooth);
        part.map(|s| s.arc)
    }

    /// All parts of member `side`: tooth, first and last arc coordinate, mm.
    pub fn parts(&self, side: usize) -> impl Iterator<Item = (i32, [f64; 2])> {
        self.parts[side].iter().map(|s| (s.tooth, s.arc))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::cycle::{Cycle, Stations};
    use crate::contact::frame::tests::reference;

    /// Every node of every contact grid lies within its tooth's strip, and the strips of a flank are together hardly longer than it.
    #[test]
    fn hold_every_contact_and_little_else() {
        let pair = reference();
        let spec = CycleSpec {
            positions: 20,
            spacing: 0.02,
            even: 0.4,
            window: 0.2,
            reach: 0.02,
        };
        let strips = Strips::new(&pair, spec);
        let cycle = Cycle::new(&pair, &Stations::new(&pair, spec.spacing), spec);
        let mut seen = 0;
        for position in &cycle.positions {
            for contact in &position.pairs {
                for (side, tooth) in [contact.tooth, -contact.tooth].into_iter().enumerate() {
                    let [low, high] = strips.of(side, tooth).unwrap();
                    for arc in &contact.arc[side] {
                        assert!((low - 1e-9..=high + 1e-9).contains(arc));
                        seen += 1;
                    }
                }
            }
        }
        assert!(seen > 1000);
        for (side, gear) in [&pair.pinion, &pair.gear].into_iter().enumerate() {
            let flank = gear.arc(gear.rho_tip) - gear.arc(gear.rho_form);
            let together: f64 = strips.parts(side).map(|(_, [low, high])| high - low).sum();
            assert!(together < 1.6 * flank, "{together} mm of {flank} mm");
        }
    }

    /// A narrow strip of a rigid pair against the involute: tooth j runs along the path of contact from (θ₀ + j) p_b to (θ₀ + 1 + j) p_b,
    /// and a flank's arc from the base circle to where its curvature radius is ρ = r_b tan α ± path is ρ²/(2 r_b).
    #[test]
    fn follow_the_involute() {
        let pair = reference();
        let window = 1e-3;
        let spec = CycleSpec {
            positions: 1000,
            spacing: window,
            even: window,
            window,
            reach: 1e-12,
        };
        let strips = Strips::new(&pair, spec);
        let angle = 20f64.to_radians();
        let base = [27.0, 53.0].map(|z: f64| z * angle.cos()); // module 2
        let pitch = std::f64::consts::TAU * base[0] / 27.0;
        // from where the mate's tip touches to where the own tip does
        let tip: [f64; 2] = [29.0, 55.0];
        let reach = |i: usize| (tip[i].powi(2) - base[i].powi(2)).sqrt() - base[i] * angle.tan();
        let (start, end) = (-reach(1), reach(0));
        let first = rotations(&pair, spec)[0] - 0.5 / spec.positions as f64;
        let mut seen = 0;
        for (side, sign) in [(0, 1.0), (1, -1.0)] {
            for (tooth, found) in strips.parts(side) {
                let from = (first + sign * f64::from(tooth)) * pitch;
                let path = [from.max(start), (from + pitch).min(end)];
                let mut arc = path.map(|y| (base[side] * angle.tan() + sign * y).powi(2));
                arc.sort_by(f64::total_cmp);
                for (found, squared) in found.into_iter().zip(arc) {
                    let expected = squared / (2.0 * base[side]);
                    // the window, and half a position at the ends of the path; an arc grows by ρ/r_b < 1 per path
                    let room = window + 0.5 * pitch / spec.positions as f64;
                    assert!(
                        (found - expected).abs() < room,
                        "tooth {tooth} of {side}: {found} mm, {expected} mm"
                    );
                    seen += 1;
                }
            }
        }
        assert_eq!(seen, 8);
    }
}
