//! Closed outlines of a tooth and of the whole gear as polygons.

use super::tooth::Gear;
use crate::numeric::{Vec2, cross, rotate};

/// Numbers of straight pieces of each part of one side of a tooth's outline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ProfileResolution {
    /// Half the root land.
    pub root: usize,
    /// The fillet.
    pub fillet: usize,
    /// The involute, at equal steps of arc length.
    pub involute: usize,
    /// The tip rounding, if there is one.
    pub rounding: usize,
    /// Half the tip land.
    pub tip: usize,
}

impl ProfileResolution {
    /// The same number everywhere.
    pub fn uniform(pieces: usize) -> ProfileResolution {
        ProfileResolution {
            root: pieces,
            fillet: pieces,
            involute: pieces,
            rounding: pieces,
            tip: pieces,
        }
    }
}

impl Gear {
    /// Outline of tooth 0 from the middle of the space clockwise of it (polar angle −π/z) to the middle of the space
    /// counter-clockwise of it (+π/z), both included, member frame, mm; nominal involute (no relief). Counter-clockwise
    /// round the gear, exactly symmetric about the x axis, with a point in the middle of the tip land.
    pub fn tooth_profile(&self, resolution: ProfileResolution) -> Vec<Vec2> {
        let loaded = self.loaded_side(resolution);
        let mut points: Vec<Vec2> = loaded.iter().map(|p| Vec2::new(p.x, -p.y)).collect();
        points.push(Vec2::new(self.tip_radius, 0.0));
        points.extend(loaded.iter().rev());
        points
    }

    /// Outline of the whole gear, counter-clockwise, closed (the last point is not the first), member frame, mm.
    pub fn outline(&self, resolution: ProfileResolution) -> Vec<Vec2> {
        let tooth = self.tooth_profile(resolution);
        (0..self.spec.teeth)
            .flat_map(|i| {
                let angle = f64::from(i) * self.pitch_angle();
                tooth[..tooth.len() - 1]
                    .iter()
                    .map(move |&p| rotate(p, angle))
                    .collect::<Vec<_>>()
            })
            .collect()
    }

    /// From the middle of the root land up to the tip land, without the middle of the tip.
    fn loaded_side(&self, resolution: ProfileResolution) -> Vec<Vec2> {
        let mut points = Vec::new();
        let half_pitch = 0.5 * self.pitch_angle();
        let land = self.root_land_half_angle();
        if land * self.root_radius > 1e-9 * self.rack.module {
            let n = resolution.root.max(1);
            points.extend(
                (0..n)
                    .map(|i| on_circle(self.root_radius, half_pitch - land * i as f64 / n as f64)),
            );
        }
        points.extend(self.fillet_points(resolution.fillet.max(1) + 1));
        let (from, to) = (self.arc(self.rho_form), self.arc(self.rho_end));
        let n = resolution.involute.max(1);
        points.extend((1..=n).map(|i| {
            let rho = if i == n {
                self.rho_end
            } else {
                self.rho_at_arc(from + (to - from) * i as f64 / n as f64)
            };
            self.involute_point(rho)
        }));
        if let Some(arc) = self.tip_rounding_arc() {
            points.extend(
                arc.points(resolution.rounding.max(1) + 1)
                    .into_iter()
                    .skip(1),
            );
        }
        let land = self.tip_land_half_angle();
        let n = resolution.tip.max(1);
        points.extend((1..n).map(|i| on_circle(self.tip_radius, land * (n - i) as f64 / n as f64)));
        points
    }
}

/// Signed area of a closed polygon, mm² (positive counter-clockwise).
pub fn polygon_area(points: &[Vec2]) -> f64 {
    let n = points.len();
    0.5 * (0..n)
        .map(|i| cross(points[i], points[(i + 1) % n]))
        .sum::<f64>()
}

fn on_circle(radius: f64, angle: f64) -> Vec2 {
    let (s, c) = angle.sin_cos();
    Vec2::new(radius * c, radius * s)
}
