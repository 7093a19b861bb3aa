//! One `.vtu` file.
use vtkio::model::{
    Attribute, Attributes, ByteOrder, CellType, Cells as VtkCells, DataArray, DataSet, Piece,
    UnstructuredGridPiece, Version, VertexNumbers, Vtk,
};

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
    let vtk = Vtk {
        version: Version::Auto,
        title: String::new(),
        byte_order: ByteOrder::LittleEndian,
        data: DataSet::UnstructuredGrid {
            meta: None,
            pieces: vec![Piece::Inline(Box::new(arrays.into_piece()))],
        },
        file_path: None,
    };
    let mut bytes = Vec::new();
    vtk.write_xml(&mut bytes)
        .map_err(|error| OutputError::Vtk {
            file: name.to_owned(),
            message: error.to_string(),
        })?;
    Ok(bytes)
}

#[derive(Default)]
struct Arrays {
    points: Vec<f64>,
    connectivity: Vec<u64>,
    offsets: Vec<u64>,
    types: Vec<CellType>,
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
        let first = (self.points.len() / 3) as u64;
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
            Cells::T3(cells) => self.append_cells(cells, CellType::Triangle, first, number),
            Cells::T6(cells) => {
                self.append_cells(cells, CellType::QuadraticTriangle, first, number)
            }
        }
    }

    /// `offsets` holds the end of each cell, without a leading zero.
    fn append_cells<const N: usize>(
        &mut self,
        cells: &[[u32; N]],
        kind: CellType,
        first: u64,
        member: u8,
    ) {
        for cell in cells {
            self.connectivity
                .extend(cell.iter().map(|&node| first + u64::from(node)));
            self.offsets.push(self.connectivity.len() as u64);
            self.types.push(kind);
            self.cell_member.push(member);
        }
    }

    fn into_piece(self) -> UnstructuredGridPiece {
        let scalar = |name: &str| DataArray::scalars(name, 1);
        let point = vec![
            Attribute::DataArray(DataArray::vectors("displacement").with_data(self.displacement)),
            Attribute::DataArray(DataArray::new("stress", 6).with_data(self.stress)),
            Attribute::DataArray(scalar("von_mises").with_data(self.von_mises)),
            Attribute::DataArray(scalar("contact_pressure").with_data(self.contact_pressure)),
            Attribute::DataArray(DataArray::new("contact_force", 3).with_data(self.contact_force)),
            Attribute::DataArray(scalar("wear_depth").with_data(self.wear_depth)),
            Attribute::DataArray(DataArray::new("wear_vector", 3).with_data(self.wear_vector)),
            Attribute::DataArray(
                DataArray::new("member_position", 3).with_data(self.member_position),
            ),
            Attribute::DataArray(scalar("member").with_data(self.member)),
        ];
        let cell = vec![Attribute::DataArray(
            scalar("member").with_data(self.cell_member),
        )];
        UnstructuredGridPiece {
            points: self.points.into(),
            cells: VtkCells {
                cell_verts: VertexNumbers::XML {
                    connectivity: self.connectivity,
                    offsets: self.offsets,
                },
                types: self.types,
            },
            data: Attributes { point, cell },
        }
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
