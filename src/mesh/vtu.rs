//! Meshes as VTK unstructured grids (.vtu): writing our own, reading a user's.
//!
//! Point data: integer array `flank`, 0 off the flanks, k > 0 on the loaded flank of the k-th candidate tooth; integer array
//! `bore`, 1 on the bore, else 0. Cell types 5 (three nodes) or 22 (six nodes), not mixed.

use std::panic::{self, AssertUnwindSafe};
use std::path::Path;

use vtkio::model::{
    Attribute, Attributes, ByteOrder, CellType, Cells as VtkCells, DataSet, Piece,
    UnstructuredGridPiece, Version, VertexNumbers, Vtk,
};

use super::user::RawMesh;
use super::{Cells, Mesh, MeshError};
use crate::gear::Gear;
use crate::numeric::Vec2;

impl Mesh {
    /// The mesh as a VTK model with the arrays [`read_vtu`] wants; fields may be added to its point and cell data.
    pub fn to_vtk(&self, title: &str) -> Vtk {
        let points: Vec<f64> = self.points.iter().flat_map(|p| [p.x, p.y, 0.0]).collect();
        let (connectivity, nodes, kind): (Vec<u64>, u64, CellType) = match &self.cells {
            Cells::T3(t) => (
                t.iter().flatten().map(|k| u64::from(*k)).collect(),
                3,
                CellType::Triangle,
            ),
            Cells::T6(t) => (
                t.iter().flatten().map(|k| u64::from(*k)).collect(),
                6,
                CellType::QuadraticTriangle,
            ),
        };
        let count = self.cells.len();
        let mut flank = vec![0i32; self.points.len()];
        for (i, chain) in self.flanks.iter().enumerate() {
            chain
                .nodes
                .iter()
                .for_each(|k| flank[*k as usize] = i as i32 + 1);
        }
        let mut bore = vec![0i32; self.points.len()];
        self.bore.iter().for_each(|k| bore[*k as usize] = 1);
        Vtk {
            version: Version::new_xml(1, 0),
            title: title.to_owned(),
            byte_order: ByteOrder::LittleEndian,
            file_path: None,
            data: DataSet::inline(UnstructuredGridPiece {
                points: points.into(),
                cells: VtkCells {
                    // End positions only: a leading zero makes readers shift all cells.
                    cell_verts: VertexNumbers::XML {
                        connectivity,
                        offsets: (1..=count as u64).map(|i| i * nodes).collect(),
                    },
                    types: vec![kind; count],
                },
                data: Attributes {
                    point: vec![
                        Attribute::scalars("flank", 1).with_data(flank),
                        Attribute::scalars("bore", 1).with_data(bore),
                    ],
                    cell: Vec::new(),
                },
            }),
        }
    }
}

/// Reads a mesh of `gear` from the bytes of a .vtu file (ASCII or inline base64). `path` only names it in errors.
///
/// # Errors
/// [`MeshError::File`] with what is wrong and what is allowed.
pub fn read_vtu(path: &Path, bytes: &[u8], gear: &Gear) -> Result<Mesh, MeshError> {
    raw(bytes)
        .and_then(|raw| raw.check(gear))
        .map_err(|problem| MeshError::File {
            path: path.to_owned(),
            problem,
        })
}

/// The longest tag of a file, bytes: VTK's own have a dozen attributes. The parser's time grows with the square of a tag's attributes
/// (RUSTSEC-2026-0194).
const LONGEST_TAG: usize = 4096;

/// Refuses a file with a tag so long that parsing it could take minutes. Appended data, in which anything may stand, has no tags.
fn check_tags(bytes: &[u8]) -> Result<(), String> {
    let appended = b"<AppendedData";
    let end = bytes.windows(appended.len()).position(|w| w == appended);
    let text = &bytes[..end.unwrap_or(bytes.len())];
    let mut begun = None;
    for (place, byte) in text.iter().enumerate() {
        match (byte, begun) {
            // comments may be long
            (b'<', None) if text.get(place + 1) != Some(&b'!') => begun = Some(place),
            (b'>', Some(_)) => begun = None,
            (_, Some(from)) if place - from > LONGEST_TAG => {
                let line = 1 + text[..from].iter().filter(|b| **b == b'\n').count();
                return Err(format!(
                    "line {line} has a tag of more than {LONGEST_TAG} characters, which no VTK file needs"
                ));
            }
            _ => {}
        }
    }
    Ok(())
}

fn raw(bytes: &[u8]) -> Result<RawMesh, String> {
    check_tags(bytes)?;
    let vtk = without_panic(|| Vtk::parse_xml(bytes))
        .ok_or("not a VTK XML file with inline data: its arrays have other sizes than their headers say")?
        .map_err(|e| format!("not a VTK XML file with inline data: {e}"))?;
    let DataSet::UnstructuredGrid { pieces, .. } = vtk.data else {
        return Err("not an unstructured grid".into());
    };
    let piece = match <[Piece<_>; 1]>::try_from(pieces) {
        Ok([Piece::Inline(piece)]) => *piece,
        _ => {
            return Err(
                "more than one piece, or a piece in another file; one inline piece is allowed"
                    .into(),
            );
        }
    };
    let xyz = piece
        .points
        .cast_into::<f64>()
        .ok_or("point coordinates are not numbers")?;
    let points: Vec<Vec2> = xyz.chunks_exact(3).map(|p| Vec2::new(p[0], p[1])).collect();
    if let Some(p) = xyz.chunks_exact(3).find(|p| p[2].abs() > 1e-9) {
        return Err(format!(
            "a point has z = {}; the mesh must lie in the plane z = 0",
            p[2]
        ));
    }
    let cells = cells(&piece.cells, points.len())?;
    let flank = numbers(&piece.data.point, "flank", points.len())?;
    let bore = numbers(&piece.data.point, "bore", points.len())?;
    let marked = |list: &[i64], value: i64| -> Vec<u32> {
        (0u32..)
            .zip(list)
            .filter(|(_, v)| **v == value)
            .map(|(k, _)| k)
            .collect()
    };
    let mut found = flank.clone();
    found.sort_unstable();
    found.dedup();
    if let Some(v) = found.iter().find(|v| **v < 0) {
        return Err(format!(
            "point data `flank` holds {v}; allowed 0 (not on a flank) and 1, 2, ..."
        ));
    }
    let flanks = found
        .iter()
        .filter(|v| **v > 0)
        .map(|v| (*v, marked(&flank, *v)))
        .collect();
    Ok(RawMesh {
        points,
        cells,
        bore: marked(&bore, 1),
        flanks,
    })
}

/// What `read` finds, or none if it panics: vtkio trusts the sizes that a file states of its arrays.
fn without_panic<T>(read: impl FnOnce() -> T) -> Option<T> {
    let usual = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let found = panic::catch_unwind(AssertUnwindSafe(read));
    panic::set_hook(usual);
    found.ok()
}

fn cells(cells: &VtkCells, points: usize) -> Result<Cells, String> {
    let (connectivity, _) = cells.cell_verts.clone().into_xml();
    if let Some(k) = connectivity.iter().find(|k| **k >= points as u64) {
        return Err(format!(
            "a cell names node {k}; there are {points} nodes, counted from 0"
        ));
    }
    let nodes: Vec<u32> = connectivity.iter().map(|k| *k as u32).collect();
    let all = |kind: CellType, n: usize| {
        cells.types.iter().all(|t| *t == kind) && nodes.len() == n * cells.types.len()
    };
    if all(CellType::Triangle, 3) {
        Ok(Cells::T3(nodes.as_chunks().0.to_vec()))
    } else if all(CellType::QuadraticTriangle, 6) {
        Ok(Cells::T6(nodes.as_chunks().0.to_vec()))
    } else {
        Err("cells other than triangles, or a mixture; allowed type 5 (3 nodes) or type 22 (6 nodes) throughout".into())
    }
}

fn numbers(attributes: &[Attribute], name: &str, points: usize) -> Result<Vec<i64>, String> {
    let found = attributes.iter().find_map(|a| match a {
        Attribute::DataArray(a) if a.name == name => Some(&a.data),
        _ => None,
    });
    let data = found.ok_or_else(|| format!("point data `{name}` is missing"))?;
    let values = data.cast_into::<f64>().unwrap_or_default();
    if values.len() != points {
        return Err(format!(
            "point data `{name}` holds {} numbers for {points} nodes",
            values.len()
        ));
    }
    match values.iter().find(|v| v.fract() != 0.0) {
        Some(v) => Err(format!(
            "point data `{name}` holds {v}; whole numbers are allowed"
        )),
        None => Ok(values.iter().map(|v| *v as i64).collect()),
    }
}

#[cfg(test)]
mod tests {
    use super::raw;

    /// One triangle whose points take `size` bytes by the header of their array (72 in truth), with more attributes of the file, and what stands behind the grid.
    fn triangle(points: &str, attributes: &str, behind: &str) -> String {
        format!(
            r#"<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt32"{attributes}>
<UnstructuredGrid><Piece NumberOfPoints="3" NumberOfCells="1">
<PointData><DataArray type="Int64" Name="flank" format="ascii">0 0 0</DataArray><DataArray type="Int64" Name="bore" format="ascii">1 1 1</DataArray></PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" {points}</Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray><DataArray type="Int64" Name="offsets" format="ascii">3</DataArray><DataArray type="UInt8" Name="types" format="ascii">5</DataArray></Cells>
</Piece></UnstructuredGrid>{behind}</VTKFile>"#
        )
    }

    /// Points (0, 0), (1, 0), (0, 1) as base64, behind the first six characters of their header.
    const POINTS: &str = "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAPA/AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA8D8AAAAAAAAAAA==";

    /// A hundred thousand attributes: the parser compares each with each.
    #[test]
    fn a_tag_that_would_take_minutes_is_refused() {
        let points = r#"format="ascii">0 0 0 1 0 0 0 1 0</DataArray>"#;
        let many: String = (0..100_000).map(|i| format!(" a{i}=\"\"")).collect();
        let begun = std::time::Instant::now();
        let refused = raw(triangle(points, &many, "").as_bytes());
        let refused = refused.err().unwrap_or_default();
        assert!(refused.contains("line 1 has a tag"), "{refused}");
        assert!(begun.elapsed().as_secs_f64() < 1.0);
        let remark = format!("<!--{}-->", "long ".repeat(2000));
        assert!(raw(triangle(points, "", &remark).as_bytes()).is_ok());
    }

    #[test]
    fn arrays_of_another_size_than_stated_make_no_panic() {
        let inline = |header: &str| {
            let points = format!(r#"format="binary">{header}{POINTS}</DataArray>"#);
            triangle(&points, "", "")
        };
        let right = raw(inline("SAAAAA").as_bytes());
        assert_eq!(right.map(|mesh| mesh.points.len()), Ok(3));
        let compressor = r#" compressor="vtkZLibDataCompressor""#;
        let compressed =
            r#"format="binary">AQAAAEgAAAAAAAAA+gMAAA==eJxjYMAHPtjjlUaSBwA9VgJf</DataArray>"#;
        let behind = r#"format="appended" offset="5000"/>"#;
        let appended = format!(r#"<AppendedData encoding="base64">_SAAAAA{POINTS}</AppendedData>"#);
        // 72000 and 8 bytes: the points themselves say how many there are
        for other in [inline("QBkBAA"), inline("CAAAAA")] {
            let read = raw(other.as_bytes()).map(|mesh| mesh.points.len());
            assert!(read.is_err() || read == Ok(3), "{read:?}");
        }
        let elsewhere = [
            triangle(compressed, compressor, ""),
            triangle(behind, "", &appended),
        ];
        for (i, wrong) in elsewhere.iter().enumerate() {
            let error = raw(wrong.as_bytes()).err();
            let begins = "not a VTK XML file with inline data";
            assert!(
                error.as_ref().is_some_and(|e| e.starts_with(begins)),
                "{i}: {error:?}"
            );
        }
    }
}
