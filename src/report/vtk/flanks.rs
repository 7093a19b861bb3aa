//! The loaded flanks of one tooth pair as surfaces over the face, where it has slices.
//!
//! ```text
//! points   unworn flank points in the fixed frame, radius by radius at the middle of each slice (z: mm from mid-face); the teeth touch at the pitch point
//! arrays   wear_depth µm, wear_vector mm (into the tooth: warp by it), contact_pressure MPa (the largest in a passage), member
//! ```

use super::xml::Grid;
use crate::simulate::result::{Member, Run, State};

/// VTK's number of a quadrilateral.
const QUAD: u8 = 9;

/// One file for each stored state: cycles, name and bytes; none for a run of one section.
pub fn flank_surfaces(run: &Run) -> Vec<(f64, String, Vec<u8>)> {
    let sliced = run.states.iter().filter(|state| state.slices.len() > 1);
    let file = |(i, state): (usize, &State)| {
        let name = format!("flanks_{i:03}.vtu");
        (state.cycles, name, surfaces(run, state))
    };
    sliced.enumerate().map(file).collect()
}

#[derive(Default)]
struct Surface {
    points: Vec<f64>,
    depth: Vec<f64>,
    vector: Vec<f64>,
    pressure: Vec<f64>,
    member: Vec<u8>,
    quads: Vec<i32>,
}

fn surfaces(run: &Run, state: &State) -> Vec<u8> {
    let mut all = Surface::default();
    for (side, member) in Member::BOTH.into_iter().enumerate() {
        all.append(run, state, (side, member));
    }
    let cells = all.quads.len() / 4;
    let mut grid = Grid::new(all.member.len(), cells);
    grid.section("PointData", |grid| {
        grid.array("wear_depth", 1, &all.depth);
        grid.array("wear_vector", 3, &all.vector);
        grid.array("contact_pressure", 1, &all.pressure);
        grid.array("member", 1, &all.member);
    });
    grid.section("Points", |grid| grid.array("points", 3, &all.points));
    grid.section("Cells", |grid| {
        let offsets: Vec<i32> = (1..=cells as i32).map(|cell| 4 * cell).collect();
        grid.array("connectivity", 1, &all.quads);
        grid.array("offsets", 1, &offsets);
        grid.array("types", 1, &vec![QUAD; cells]);
    });
    grid.finish()
}

impl Surface {
    fn append(&mut self, run: &Run, state: &State, (side, member): (usize, Member)) {
        let (wheel, centre, sign) = match member {
            Member::Pinion => (&run.geometry.pinion, 0.0, 1.0),
            Member::Gear => (&run.geometry.gear, run.geometry.centre_distance, -1.0),
        };
        let base = wheel.base_radius;
        // polar angle and pressure angle of the involute, from the base circle on; at the pitch radius it lies on the line of centres
        let pressure_angle = |radius: f64| (base / radius).min(1.0).acos();
        let involute = |angle: f64| angle.tan() - angle;
        let at_pitch = involute(pressure_angle(wheel.pitch_radius));
        let first = self.member.len() as i32;
        let radii = &state.profile(member).radius;
        for (k, &radius) in radii.iter().enumerate() {
            let angle = pressure_angle(radius);
            let (sin, cos) = (at_pitch - involute(angle)).sin_cos();
            let into = [
                -(angle.sin() * cos - angle.cos() * sin),
                -(angle.sin() * sin + angle.cos() * cos),
            ];
            for slice in &state.slices {
                let depth = slice.depth[side][k];
                let place = [
                    centre + sign * radius * cos,
                    sign * radius * sin,
                    slice.face,
                ];
                self.points.extend(place);
                self.depth.push(depth);
                let vector = into.map(|n| sign * 1e-3 * depth * n);
                self.vector.extend([vector[0], vector[1], 0.0]);
                self.pressure.push(slice.pressure[side][k]);
                self.member.push(side as u8);
            }
        }
        let count = state.slices.len() as i32;
        for k in 0..radii.len() as i32 - 1 {
            for i in 0..count - 1 {
                let corner = first + k * count + i;
                let next = corner + count;
                self.quads.extend([corner, corner + 1, next + 1, next]);
            }
        }
    }
}
