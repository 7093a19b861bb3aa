//! The shape of a worn flank: how far it has gone back, along its arc.
//!
//! A depth h at the arc s of the unworn involute means that the flank's point there has been turned back about the gear's
//! centre by h/r_b:
//!
//! ```text
//! x(s) = R(−h(s)/r_b) x₀(s)          (x₀: unworn involute, R: rotation about the gear's centre, r_b: base radius)
//! ```
//! All involutes of one base circle have the same normals and lie at equal distances along them, so h is the distance to the
//! unworn flank along its normal (to second order where the depth varies). In this form the shape holds at any depth:
//!
//! - a flank worn evenly is the involute turned back: exact, and the tip corner stays on the tip circle;
//! - radii are kept, so the profile is a graph over the radius and cannot cross itself, whatever ledge a mate's corner digs;
//! - the area lost is exactly ∫ h ds, because ds = r dr / r_b and a turn by φ(r) sweeps ∫ φ r dr;
//! - a turn of the gear by φ moves its flank by φ r_b along every normal: turning worn teeth together closes an even depth
//!   exactly, so gaps taken before the turn hold after it.

use super::tooth::Gear;
use crate::numeric::{Vec2, interpolate, rotate};

/// The worn loaded flank of tooth 0 of a gear, by its depth.
#[derive(Debug, Clone)]
pub struct WornFlank<'a> {
    gear: &'a Gear,
    /// Ascending arc coordinates, mm.
    arc: Vec<f64>,
    /// Depth there, mm; linear between.
    depth: Vec<f64>,
}

/// A place where a worn tooth has become too thin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thinnest {
    /// Radius, mm.
    pub radius: f64,
    /// Depth there, mm.
    pub depth: f64,
    /// What is left of the tooth's thickness there, mm.
    pub left: f64,
}

impl<'a> WornFlank<'a> {
    /// The flank as cut.
    pub fn unworn(gear: &'a Gear) -> Self {
        Self::new(gear, vec![0.0], vec![0.0])
    }

    /// The flank with the `depth` (mm) lost at the ascending arc coordinates `arc` (mm); linear between, constant beyond.
    ///
    /// # Panics
    /// If the two are of different lengths or empty.
    pub fn new(gear: &'a Gear, arc: Vec<f64>, depth: Vec<f64>) -> Self {
        assert!(!arc.is_empty() && arc.len() == depth.len());
        Self { gear, arc, depth }
    }

    /// Whether nothing is lost.
    pub fn is_unworn(&self) -> bool {
        self.depth.iter().all(|h| *h == 0.0)
    }

    /// Depth at arc `s`, mm.
    pub fn depth(&self, s: f64) -> f64 {
        interpolate(&self.arc, &self.depth, s)
    }

    /// The flank's point that lay at arc `s` before wear, mm, member frame.
    pub fn point(&self, s: f64) -> Vec2 {
        let unworn = self.gear.flank_point(self.gear.rho_at_arc(s));
        self.gear.turned_back(unworn, self.depth(s))
    }

    /// Where along the flank the tooth is thinnest at its own radius, between the other flank (unworn) and this one.
    pub fn thinnest(&self) -> Thinnest {
        const LOOKS: usize = 200;
        let (from, to) = (
            self.gear.arc(self.gear.rho_form),
            self.gear.arc(self.gear.rho_last),
        );
        let at = |s: f64| {
            let (radius, depth) = (self.gear.radius_at_arc(s), self.depth(s));
            Thinnest {
                radius,
                depth,
                left: self.gear.thickness(radius) - depth * radius / self.gear.base_radius,
            }
        };
        let stations = self.arc.iter().copied().filter(|s| (from..=to).contains(s));
        (1..=LOOKS)
            .map(|i| from + (to - from) * i as f64 / LOOKS as f64)
            .chain(stations)
            .map(at)
            .fold(at(from), |a, b| if b.left < a.left { b } else { a })
    }

    /// The same without what stands proud between two steeper slopes than `slope` (depth per arc), the air beyond the tip
    /// being one: too slender to carry load, too acute for elements.
    pub fn without_spikes(mut self, slope: f64) -> Self {
        let reach = |i: usize, j: usize| slope * (self.arc[i] - self.arc[j]).abs();
        let (mut below, mut above) = (self.depth.clone(), self.depth.clone());
        let last = above.len() - 1;
        for i in 1..below.len() {
            below[i] = below[i].max(below[i - 1] - reach(i, i - 1));
        }
        // beyond the tip there is air
        above[last] = below[last];
        for i in (0..last).rev() {
            above[i] = above[i].max(above[i + 1] - reach(i, i + 1));
        }
        self.depth = below.iter().zip(&above).map(|(a, b)| a.min(*b)).collect();
        self
    }
}

impl Gear {
    /// The point `x` (mm, member frame) of a loaded flank after it has gone back by `depth` (mm) along its normal.
    pub fn turned_back(&self, x: Vec2, depth: f64) -> Vec2 {
        rotate(x, -depth / self.base_radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gear::{BasicRack, ToothSpec};

    #[test]
    fn spikes_go_and_ledges_stay() {
        let gear = Gear::new(BasicRack::iso53_a(2.0), ToothSpec::plain(27, 25.0)).unwrap();
        let arc: Vec<f64> = (0..8).map(f64::from).collect();
        // a ledge up to station 3, a spike at 5, a sharp rest of the corner at the tip
        let depth = vec![0.0, 0.0, 0.0, 4.0, 4.0, 1.0, 4.0, 0.5];
        let flank = WornFlank::new(&gear, arc.clone(), depth).without_spikes(0.5);
        let kept: Vec<f64> = arc.iter().map(|s| flank.depth(*s)).collect();
        assert_eq!(kept, [0.0, 0.0, 0.0, 4.0, 4.0, 3.5, 4.0, 3.5]);
    }
}
