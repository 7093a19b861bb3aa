//! What part of a loaded pair is seen, and its stress and mesh in pixels.
use super::raster::Raster;
use crate::mesh::Cells;
use crate::numeric::{Vec2, rotate};
use crate::simulate::result::{FieldFrame, MemberField, Run};

/// Share of the loaded region's pixels that may lie above the scale: stresses under tip corners have no bound.
const ABOVE: f64 = 0.0005;
/// Strongest mesh line, of 255.
const LINE: f64 = 150.0;
/// Length from which an edge has its full strength, pixels.
const CLEAR: f64 = 14.0;
/// Width of a close-up over the length of the contact.
const AROUND: f64 = 4.0;
/// Least and largest width of a close-up, modules.
const CLOSE: [f64; 2] = [0.15, 1.0];
/// Contact forces this near to each other are one contact, modules.
const ONE_CONTACT: f64 = 0.3;

/// The seen part of the fixed frame: upper left corner, mm; pixels per mm; pixels.
#[derive(Debug, Clone, Copy)]
pub(super) struct View {
    pub(super) corner: Vec2,
    pub(super) scale: f64,
    pub(super) size: [usize; 2],
}

impl View {
    /// The path of contact and a tooth's height around it.
    pub(super) fn whole(run: &Run, size: [usize; 2]) -> Self {
        let g = &run.geometry;
        let [a, .., e] = g.path_limits;
        let pitch = Vec2::new(g.pinion.pitch_radius, 0.0);
        Self::about(pitch, (e - a) + 3.6 * g.module, size)
    }

    /// The contact that carries most at a frame; the pitch point where nothing touches.
    pub(super) fn close(run: &Run, frame: &FieldFrame, size: [usize; 2]) -> Self {
        let g = &run.geometry;
        let module = g.module;
        let places = places(&frame.pinion);
        let forces: Vec<(Vec2, f64)> = (places.iter().zip(&frame.pinion.contact_force))
            .map(|(place, force)| (*place, Vec2::from(*force).norm()))
            .filter(|(_, force)| *force > 0.0)
            .collect();
        let near = |at: Vec2| {
            let one = move |f: &&(Vec2, f64)| (f.0 - at).norm() < ONE_CONTACT * module;
            forces.iter().filter(one)
        };
        let carried = |at: Vec2| near(at).map(|f| f.1).sum::<f64>();
        let most = forces
            .iter()
            .max_by(|a, b| carried(a.0).total_cmp(&carried(b.0)));
        let Some(most) = most else {
            return Self::about(Vec2::new(g.pinion.pitch_radius, 0.0), module, size);
        };
        let weighted = near(most.0).fold(Vec2::zeros(), |sum, f| sum + f.0 * f.1);
        let centre = weighted / carried(most.0);
        let reach = near(centre)
            .map(|f| (f.0 - centre).norm())
            .fold(0.0, f64::max);
        let width = (2.0 * AROUND * reach).clamp(CLOSE[0] * module, CLOSE[1] * module);
        Self::about(centre, width, size)
    }

    fn about(centre: Vec2, width: f64, size: [usize; 2]) -> Self {
        let scale = size[0] as f64 / width;
        let half = Vec2::new(0.5 * size[0] as f64, -0.5 * size[1] as f64) / scale;
        View {
            corner: centre - half,
            scale,
            size,
        }
    }

    /// Pixels of a place.
    pub(super) fn at(&self, p: Vec2) -> [f64; 2] {
        [
            self.scale * (p.x - self.corner.x),
            self.scale * (self.corner.y - p.y),
        ]
    }

    /// Levels 1 to 255 of the stress, 0 where there is no gear.
    pub(super) fn stress(&self, frame: &FieldFrame, highest: f64) -> Raster {
        let mut field = Raster::new(self.size[0], self.size[1]);
        let level = |v: f64| 1 + (254.0 * (v / highest).clamp(0.0, 1.0)).round() as u8;
        for member in [&frame.pinion, &frame.gear] {
            let nodes = self.nodes(member);
            self.each(member, &nodes, |element| {
                let parts: &[[usize; 3]] = match element.len() {
                    3 => &[[0, 1, 2]],
                    _ => &[[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]],
                };
                for part in parts {
                    field.triangle(part.map(|i| nodes[element[i] as usize]), level);
                }
            });
        }
        field
    }

    /// The elements' edges, fainter where they are short.
    pub(super) fn lines(&self, frame: &FieldFrame) -> Raster {
        let mut lines = Raster::new(self.size[0], self.size[1]);
        for member in [&frame.pinion, &frame.gear] {
            let nodes = self.nodes(member);
            self.each(member, &nodes, |element| {
                for side in 0..3 {
                    let ends = [element[side], element[(side + 1) % 3]];
                    let [from, to] = ends.map(|i| nodes[i as usize]).map(|[x, y, _]| [x, y]);
                    let length = (to[0] - from[0]).hypot(to[1] - from[1]);
                    let strength = LINE * (length / CLEAR).min(1.0);
                    if strength > 32.0 {
                        lines.line(from, to, strength);
                    }
                }
            });
        }
        lines
    }

    /// The end of the scale: only a few pixels lie above it; two digits.
    pub(super) fn highest(&self, frame: &FieldFrame) -> f64 {
        let largest = [&frame.pinion, &frame.gear]
            .into_iter()
            .flat_map(|member| member.von_mises.iter().copied())
            .fold(0.0, f64::max);
        // levels of a two hundred and fifty-fourth each of the largest value: fine enough for two digits after a second look
        let mut top = largest.max(1e-9);
        for _ in 0..2 {
            let field = self.stress(frame, top);
            let mut levels = [0usize; 256];
            for &pixel in &field.pixels {
                levels[usize::from(pixel)] += 1;
            }
            let filled: usize = levels[1..].iter().sum();
            let mut above = 0;
            let mut level = 255;
            while level > 1 && (above + levels[level]) as f64 <= ABOVE * filled as f64 {
                above += levels[level];
                level -= 1;
            }
            top *= level as f64 / 255.0;
        }
        let step = 10f64.powf(top.log10().floor() - 1.0);
        (top / step).ceil() * step
    }

    /// Pixels and stress of every node, under load.
    fn nodes(&self, member: &MemberField) -> Vec<[f64; 3]> {
        let places = places(member).into_iter().zip(&member.von_mises);
        places
            .map(|(place, stress)| {
                let [x, y] = self.at(place);
                [x, y, *stress]
            })
            .collect()
    }

    /// Calls `draw` with every element that may be seen.
    fn each(&self, member: &MemberField, nodes: &[[f64; 3]], mut draw: impl FnMut(&[u32])) {
        let seen = |corners: &[u32]| {
            (0..2).all(|axis| {
                let at = |i: &u32| nodes[*i as usize][axis];
                let size = self.size[axis] as f64;
                corners.iter().any(|i| at(i) > 0.0) && corners.iter().any(|i| at(i) < size)
            })
        };
        match &member.cells {
            Cells::T3(cells) => cells.iter().filter(|c| seen(&c[..])).for_each(|c| draw(c)),
            Cells::T6(cells) => cells.iter().filter(|c| seen(&c[..3])).for_each(|c| draw(c)),
        }
    }
}

/// Every node in the fixed frame, under load, mm.
fn places(member: &MemberField) -> Vec<Vec2> {
    let centre = Vec2::from(member.centre);
    (member.worn.iter().zip(&member.displacement))
        .map(|(x, u)| centre + rotate(Vec2::from(*x) + Vec2::from(*u), member.rotation))
        .collect()
}
