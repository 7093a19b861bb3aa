//! Claim: the VTK files hold both members as they stand, and load and area can be recomputed from them.
//!
//! Tolerance: 1e-12 for doubles; 1e-5 MPa and 1e-9 mm where an array is stored in single precision (6e-8 of 100 MPa and of
//! 1.5e-3 mm).
use std::fs;
use std::path::Path;
use std::process::Command;

use gearwear::mesh::Cells;
use gearwear::report::{OutputError, vtk};
use serde_json::Value;

use super::{read, synthetic, written};
use crate::vtu::Grid;

/// VTK's numbers of the kinds of cells.
const TRIANGLE: f64 = 5.0;
const QUADRATIC_TRIANGLE: f64 = 22.0;

#[test]
fn field_files_hold_both_members_in_the_fixed_frame() {
    let frame = synthetic::frame(15_000.0, 0.0);
    let grid = Grid::read(&vtk::vtu("frame.vtu", &frame).unwrap());
    let nodes = frame.pinion.worn.len() + frame.gear.worn.len();
    let cells = 4 * synthetic::COLUMNS * synthetic::ROWS;
    let points = grid.array("Points/points");
    let types = grid.array("Cells/types");
    assert_eq!((points.len(), types.len()), (3 * nodes, cells));
    assert!(types.iter().all(|kind| *kind == QUADRATIC_TRIANGLE));
    let connectivity = grid.array("Cells/connectivity");
    let offsets = grid.array("Cells/offsets");
    assert_eq!(
        (offsets[0], *offsets.last().unwrap()),
        (6.0, 6.0 * cells as f64)
    );
    assert!(
        connectivity[connectivity.len() / 2..]
            .iter()
            .all(|&node| node as usize >= nodes / 2)
    );
    assert_eq!(
        grid.array("PointData/member").iter().sum::<f64>(),
        nodes as f64 / 2.0
    );

    // Both contact sides lie on one line through (27, 0): node i of the pinion meets node across − 1 − i of the gear.
    let across = 2 * synthetic::COLUMNS + 1;
    for i in 0..across {
        let [a, b] = [3 * i, 3 * (nodes / 2 + across - 1 - i)];
        for axis in 0..3 {
            assert!((points[a + axis] - points[b + axis]).abs() < 1e-12);
        }
    }
    // Forces cancel and turn the pinion with the stated moment.
    let force = grid.array("PointData/contact_force");
    let sum =
        |axis: usize, from: usize, to: usize| (from..to).map(|n| force[3 * n + axis]).sum::<f64>();
    let half = nodes / 2;
    let size = sum(0, 0, half).hypot(sum(1, 0, half));
    assert!((size / synthetic::line_load() - 1.0).abs() < 1e-12);
    assert!((sum(0, 0, nodes).abs() + sum(1, 0, nodes).abs()) < 1e-12 * size);
    let moment: f64 = (0..half)
        .map(|n| points[3 * n] * force[3 * n + 1] - points[3 * n + 1] * force[3 * n])
        .sum();
    assert!((moment.abs() / frame.torque_per_width - 1.0).abs() < 1e-12);

    // A uniaxial stress along the member's x axis, seen in the fixed frame: σ c², σ s², σ c s (Mohr); zz stays.
    let stress = grid.array("PointData/stress");
    let (s, c) = frame.pinion.rotation.sin_cos();
    let expected = [100.0 * c * c, 100.0 * s * s, 30.0, 100.0 * c * s, 0.0, 0.0];
    for (found, wanted) in stress[..6].iter().zip(expected) {
        assert!((found - wanted).abs() < 1e-5, "{found} {wanted}");
    }
    // Worn material: 1.5 µm off the contact side, against the outward normal (70° for the pinion).
    let (vector, depth) = (
        grid.array("PointData/wear_vector"),
        grid.array("PointData/wear_depth"),
    );
    assert_eq!(depth[0], 1.5);
    let outward = 70f64.to_radians();
    assert!(
        (vector[0] + 1.5e-3 * outward.cos()).abs() < 1e-9
            && (vector[1] + 1.5e-3 * outward.sin()).abs() < 1e-9
    );
}

#[test]
fn linear_triangles_are_written_as_such() {
    use gearwear::mesh::Cells;
    let mut frame = synthetic::frame(0.0, 0.0);
    for field in [&mut frame.pinion, &mut frame.gear] {
        if let Cells::T6(cells) = &field.cells {
            field.cells = Cells::T3(cells.iter().map(|c| [c[0], c[1], c[2]]).collect());
        }
    }
    let grid = Grid::read(&vtk::vtu("frame.vtu", &frame).unwrap());
    let types = grid.array("Cells/types");
    assert!(types.iter().all(|kind| *kind == TRIANGLE));
}

#[test]
fn series_name_files_that_exist_in_order() {
    let (dir, _) = written();
    let series = |name: &str| {
        let text = read(&dir, &format!("fields/{name}"));
        text.lines()
            .filter_map(|line| {
                let part = |key: &str| {
                    Some(
                        line.split_once(&format!("{key}=\""))?
                            .1
                            .split('"')
                            .next()?
                            .to_owned(),
                    )
                };
                Some((part("timestep")?.parse::<f64>().ok()?, part("file")?))
            })
            .collect::<Vec<_>>()
    };
    let wear = series("wear.pvd");
    assert_eq!(
        wear.iter().map(|entry| entry.0).collect::<Vec<_>>(),
        [0.0, 15_000.0, 50_000.0]
    );
    let cycle = series("mesh_cycle_002.pvd");
    assert_eq!(
        cycle.iter().map(|entry| entry.0).collect::<Vec<_>>(),
        [-0.25, 0.0, 0.25]
    );
    // Of the last state the frame at the position of the first one.
    assert_eq!(wear[2].1, cycle[1].1);
    for (_, file) in wear.iter().chain(&cycle) {
        assert!(
            !file.contains('/') && dir.path().join("study.out/run/fields").join(file).is_file(),
            "{file}"
        );
    }
    let loads: Value = serde_json::from_str(&read(&dir, "fields/loads.json")).unwrap();
    let area = loads["files"][0]["pinion"]["area"].as_f64().unwrap();
    assert!((area / synthetic::area() - 1.0).abs() < 1e-12, "{area}");
}

/// VTK's own reader and meshio, where they are installed; the script says so and succeeds where not.
#[test]
fn two_other_readers_agree() {
    let (dir, _) = written();
    let fields = dir.path().join("study.out/run/fields");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("validation/read_vtk.py");
    let check = || Command::new("python3").arg(&script).arg(&fields).output();
    let Ok(good) = check() else { return };
    let said = String::from_utf8_lossy(&good.stdout).into_owned();
    assert!(
        good.status.success(),
        "{said}{}",
        String::from_utf8_lossy(&good.stderr)
    );
    if said.contains("skipped") {
        return;
    }
    // The check can fail: a load that is off by one part in 10⁵ is noticed.
    let path = fields.join("loads.json");
    let mut loads: Value = serde_json::from_slice(&fs::read(&path).unwrap()).unwrap();
    let load = loads["files"][0]["line_load"].as_f64().unwrap();
    loads["files"][0]["line_load"] = Value::from(load * (1.0 + 1e-5));
    fs::write(&path, loads.to_string()).unwrap();
    assert!(!check().unwrap().status.success());
}

/// A cell of a node that does not exist would be a file that no program opens.
#[test]
fn cells_of_missing_nodes_are_refused() {
    let mut frame = synthetic::frame(0.0, 0.0);
    let nodes = frame.gear.worn.len();
    let Cells::T6(cells) = &mut frame.gear.cells else {
        panic!("made of quadratic triangles");
    };
    cells[0][3] = nodes as u32;
    let error = vtk::vtu("fields/a.vtu", &frame).unwrap_err();
    assert!(
        matches!(&error, OutputError::Vtk { file, message } if file == "fields/a.vtu" && message.contains(&nodes.to_string())),
        "{error}"
    );
}
