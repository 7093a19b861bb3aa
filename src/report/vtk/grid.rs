//! One `.vtu` file.
use vtkio::model::Vtk;

use super::xml::Grid;
use crate::mesh::Cells;
use crate::report::csv::{finite, same_length};
use crate::report::error::OutputError;
use crate::simulate::result::{FieldFrame, Member, MemberField};

/// The bytes of one `.vtu` file; `name` is for messages only.
pub fn vtu(name: &str, frame: &FieldFrame) -> Result<Vec<u8>, OutputError> {
    let mut arrays = Arrays::default();
    for member in Member::BOTH {
        let field = frame.member(member);
        check(name, member, field)?;
        arrays.append(member, field);
    }
    Ok(arrays.into_file())
}

/// Any VTK data as the bytes of an XML file called `name`.
pub fn xml(name: &str, vtk: Vtk) -> Result<Vec<u8>, OutputError> {
    let mut bytes = Vec::new();
    vtk.write_xml(&mut bytes)
        .map_err(|error| OutputError::Vtk {
            file: name.to_owned(),
            message: error.to_string(),
        })?;
    Ok(bytes)
}

/// VTK's numbers of the kinds of cells.
const TRIANGLE: u8 = 5;
const QUADRATIC_TRIANGLE: u8 = 22;

#[derive(Default)]
struct Arrays {
    points: Vec<f64>,
    connectivity: Vec<i32>,
    offsets: Vec<i32>,
    types: Vec<u8>,
    cell_member: Vec<u8>,
    member: Vec<u8>,
    displacement: Vec<f32>,
    stress: Vec<f32>,
    von_mises: Vec<f32>,
    contact_pressure: Vec<f64>,
    contact_force: Vec<f64>,
    wear_depth: Vec<f32>,
    wear_vector: Vec<f32>,
    member_position: Vec<f32>,
}

impl Arrays {
    fn append(&mut self, member: Member, field: &MemberField) {
        let first = (self.points.len() / 3) as i32;
        let number = u8::from(member == Member::Gear);
        let turn = Turn::by(field.rotation);
        for node in 0..field.worn.len() {
            let [x, y] = turn.vector(field.worn[node]);
            self.points
                .extend([field.centre[0] + x, field.centre[1] + y, 0.0]);
            self.member.push(number);
            self.displacement
                .extend(single(turn.vector(field.displacement[node])));
            let [xx, yy, xy, zz] = turn.tensor(field.stress[node]);
            self.stress
                .extend([xx, yy, zz, xy, 0.0, 0.0].map(|s| s as f32));
            self.von_mises.push(field.von_mises[node] as f32);
            self.contact_pressure.push(field.contact_pressure[node]);
            let [fx, fy] = turn.vector(field.contact_force[node]);
            self.contact_force.extend([fx, fy, 0.0]);
            self.wear_depth.push(field.wear_depth[node] as f32);
            let [worn, reference] = [field.worn[node], field.reference[node]];
            self.wear_vector.extend(single(
                turn.vector([worn[0] - reference[0], worn[1] - reference[1]]),
            ));
            self.member_position.extend(single(reference));
        }
        match &field.cells {
            Cells::T3(cells) => self.append_cells(cells, TRIANGLE, first, number),
            Cells::T6(cells) => self.append_cells(cells, QUADRATIC_TRIANGLE, first, number),
        }
    }

    /// `offsets` holds the end of each cell, without a leading zero.
    fn append_cells<const N: usize>(
        &mut self,
        cells: &[[u32; N]],
        kind: u8,
        first: i32,
        member: u8,
    ) {
        for cell in cells {
            self.connectivity
                .extend(cell.iter().map(|&node| first + node as i32));
            self.offsets.push(self.connectivity.len() as i32);
            self.types.push(kind);
            self.cell_member.push(member);
        }
    }

    fn into_file(self) -> Vec<u8> {
        let mut grid = Grid::new(self.points.len() / 3, self.types.len());
        grid.section("PointData", |grid| {
            grid.array("displacement", 3, &self.displacement);
            grid.array("stress", 6, &self.stress);
            grid.array("von_mises", 1, &self.von_mises);
            grid.array("contact_pressure", 1, &self.contact_pressure);
            grid.array("contact_force", 3, &self.contact_force);
            grid.array("wear_depth", 1, &self.wear_depth);
            grid.array("wear_vector", 3, &self.wear_vector);
            grid.array("member_position", 3, &self.member_position);
            grid.array("member", 1, &self.member);
        });
        grid.section("CellData", |grid| {
            grid.array("member", 1, &self.cell_member)
        });
        grid.section("Points", |grid| grid.array("points", 3, &self.points));
        grid.section("Cells", |grid| {
            grid.array("connectivity", 1, &self.connectivity);
            grid.array("offsets", 1, &self.offsets);
            grid.array("types", 1, &self.types);
        });
        grid.finish()
    }
}

/// A counter-clockwise turn of the plane.
struct Turn {
    cos: f64,
    sin: f64,
}

impl Turn {
    fn by(angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        Turn { cos, sin }
    }

    fn vector(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.cos * x - self.sin * y, self.sin * x + self.cos * y]
    }

    /// R σ Rᵀ for xx, yy, xy; zz stays.
    fn tensor(&self, [xx, yy, xy, zz]: [f64; 4]) -> [f64; 4] {
        let (c, s) = (self.cos, self.sin);
        let shear = 2.0 * c * s * xy;
        [
            c * c * xx + s * s * yy - shear,
            s * s * xx + c * c * yy + shear,
            c * s * (xx - yy) + (c * c - s * s) * xy,
            zz,
        ]
    }
}

fn single([x, y]: [f64; 2]) -> [f32; 3] {
    [x as f32, y as f32, 0.0]
}

/// Lengths agree, every cell names nodes that exist, every number is finite.
fn check(file: &str, member: Member, field: &MemberField) -> Result<(), OutputError> {
    let nodes = field.worn.len();
    let label = |what: &str| format!("{} {what}", member.name());
    for (what, found) in [
        ("reference", field.reference.len()),
        ("displacement", field.displacement.len()),
        ("stress", field.stress.len()),
        ("von_mises", field.von_mises.len()),
        ("contact_pressure", field.contact_pressure.len()),
        ("contact_force", field.contact_force.len()),
        ("wear_depth", field.wear_depth.len()),
    ] {
        same_length(file, &label(what), found, nodes)?;
    }
    let largest = match &field.cells {
        Cells::T3(cells) => cells.iter().flatten().max(),
        Cells::T6(cells) => cells.iter().flatten().max(),
    };
    if let Some(&node) = largest.filter(|&&node| node as usize >= nodes) {
        let message = format!("{} names node {node}, there are {nodes}", label("cells"));
        return Err(OutputError::Vtk {
            file: file.to_owned(),
            message,
        });
    }
    let all = |what: &str, values: &mut dyn Iterator<Item = f64>| -> Result<(), OutputError> {
        for value in values {
            finite(file, &label(what), value)?;
        }
        Ok(())
    };
    all(
        "rotation and centre",
        &mut field.centre.into_iter().chain([field.rotation]),
    )?;
    all("reference", &mut field.reference.iter().flatten().copied())?;
    all("worn", &mut field.worn.iter().flatten().copied())?;
    all(
        "displacement",
        &mut field.displacement.iter().flatten().copied(),
    )?;
    all("stress", &mut field.stress.iter().flatten().copied())?;
    all("von_mises", &mut field.von_mises.iter().copied())?;
    all(
        "contact_pressure",
        &mut field.contact_pressure.iter().copied(),
    )?;
    all(
        "contact_force",
        &mut field.contact_force.iter().flatten().copied(),
    )?;
    all("wear_depth", &mut field.wear_depth.iter().copied())
}
