//! Claim: what a run found stands in its files, whole, with the columns and keys that outside programs rely on; and a run that
//! fails leaves nothing under the final name.
//!
//! Source: the file formats of this program (README), the VTK XML format (types 5 and 22, six-component tensors XX YY ZZ XY YZ
//! XZ), closed forms for load (4/3 p b of a parabola) and area (Archimedes' parabola segment) of a made-up pair of blocks.
//! Tolerance: exact for text (shortest digits read back to the same double), 1e-12 for what is recomputed in doubles,
//! 1e-6 relative where an array is stored in single precision (24 bits: 6e-8).
#[path = "outputs/synthetic.rs"]
mod synthetic;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use gearwear::report::html::{self, Case, Difference, ModelColumn, Models, Verdict};
use gearwear::report::plots::{Plot, Style};
use gearwear::report::{
    OutputError, Staging, atomic, text, vtk, write_file, write_models, write_run, write_validation,
};
use gearwear::simulate::result::Run;
use serde_json::Value;
use vtkio::model::{
    Attribute, CellType, DataSet, Piece, UnstructuredGridPiece, VertexNumbers, Vtk,
};

fn written() -> (tempfile::TempDir, Run) {
    let dir = tempfile::tempdir().unwrap();
    let run = synthetic::run();
    write_run(&run, &dir.path().join("study.out/run")).unwrap();
    (dir, run)
}

fn read(dir: &tempfile::TempDir, name: &str) -> String {
    fs::read_to_string(dir.path().join("study.out/run").join(name)).unwrap()
}

#[test]
fn tables_read_back_to_the_same_doubles() {
    let (dir, run) = written();
    let text = read(&dir, "wear.csv");
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("cycles,member,radius,path,depth"));
    let mut expected = Vec::new();
    for state in &run.states {
        for (name, flank) in [("pinion", &state.pinion), ("gear", &state.gear)] {
            for i in 0..flank.radius.len() {
                expected.push((
                    state.cycles,
                    name,
                    flank.radius[i],
                    flank.path[i],
                    flank.depth[i],
                ));
            }
        }
    }
    let found: Vec<_> = lines
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            let number = |i: usize| cells[i].parse::<f64>().unwrap();
            assert_eq!(cells.len(), 5);
            (
                number(0),
                if cells[1] == "pinion" {
                    "pinion"
                } else {
                    "gear"
                },
                number(2),
                number(3),
                number(4),
            )
        })
        .collect();
    assert_eq!(found, expected);

    let text = read(&dir, "contact.csv");
    let header = text.lines().next().unwrap();
    assert!(
        header
            .starts_with("cycles,position,pair,path,load_share,line_load,peak_pressure,half_width")
    );
    let pairs: usize = run.states.iter().map(|state| state.pairs().count()).sum();
    assert_eq!(text.lines().count(), 1 + pairs);
    let last: Vec<f64> = text
        .lines()
        .last()
        .unwrap()
        .split(',')
        .map(|cell| cell.parse().unwrap())
        .collect();
    let pair = run.last().pairs().last().unwrap();
    assert_eq!(
        last[3..8],
        [
            pair.path,
            pair.load_share,
            pair.line_load,
            pair.peak_pressure,
            pair.half_width
        ]
    );

    let text = read(&dir, "transmission_error.csv");
    assert_eq!(text.lines().next(), Some("cycles,position,angle"));
    let last: Vec<f64> = text
        .lines()
        .last()
        .unwrap()
        .split(',')
        .map(|cell| cell.parse().unwrap())
        .collect();
    let position = run.last().cycle.last().unwrap();
    assert_eq!(last, [50_000.0, position.position, position.angle_urad]);
}

#[test]
fn summary_has_the_promised_keys_and_figures() {
    let (dir, run) = written();
    let text = read(&dir, "summary.json");
    let summary: Value = serde_json::from_str(&text).unwrap();
    let promised = [
        (
            "/geometry",
            "working_pressure_angle contact_ratio path_of_contact base_pitch backlash_um speed_ratio",
        ),
        ("/mesh", "nodes elements dof min_angle flank_spacing"),
        (
            "/contact",
            "peak_pressure te_peak_to_peak_urad single_pair_stiffness",
        ),
        ("/wear", "balance_error"),
        (
            "/wear/pinion",
            "max_depth_um max_depth_radius worn_area_mm2 mass_loss_mg",
        ),
        (
            "/wear/gear",
            "max_depth_um max_depth_radius worn_area_mm2 mass_loss_mg",
        ),
        (
            "/cost",
            "seconds factorisations contact_solves wear_steps peak_memory_mb threads",
        ),
    ];
    for (place, keys) in promised {
        for key in keys.split(' ') {
            let value = summary.pointer(&format!("{place}/{key}"));
            assert!(
                value.is_some_and(Value::is_number),
                "{place}/{key} is {value:?}"
            );
        }
    }
    assert_eq!(summary["mesh"]["nodes"], 24_310 + 31_877);
    // REF pair at C, independent finite elements: 119.436 N/mm over 344.56 µrad × 25.3717 mm = 13.662 N/(mm·µm).
    let k = summary["contact"]["single_pair_stiffness"]
        .as_f64()
        .unwrap();
    assert!((k - 13.662).abs() < 1e-3, "{k}");
    let angles = || run.first().cycle.iter().map(|p| p.angle_urad);
    let span = angles().fold(f64::MIN, f64::max) - angles().fold(f64::MAX, f64::min);
    // Compared as digits: this reader may be off by one in the last place.
    assert!(text.contains(&format!("\"te_peak_to_peak_urad\": {span}")), "{span}");
    let deepest = run.last().pinion.depth.iter().copied().fold(0.0, f64::max);
    assert!(text.contains(&format!("\"max_depth_um\": {deepest}")), "{deepest}");
}

#[test]
fn a_model_without_a_mesh_is_written_too() {
    let dir = tempfile::tempdir().unwrap();
    let mut run = synthetic::run();
    (run.mesh, run.fields) = (None, Vec::new());
    run.states.truncate(1);
    let done = write_run(&run, &dir.path().join("run")).unwrap();
    assert!(!done.folder.join("fields").exists());
    let summary: Value =
        serde_json::from_slice(&fs::read(done.folder.join("summary.json")).unwrap()).unwrap();
    assert_eq!(summary["mesh"]["nodes"], 0);
    assert!(done.files.iter().any(|name| name == "plots/load_share.svg"));
}

fn piece(bytes: &[u8]) -> UnstructuredGridPiece {
    let vtk = Vtk::parse_xml(bytes).unwrap();
    assert_eq!(vtk.byte_order, vtkio::model::ByteOrder::LittleEndian);
    let DataSet::UnstructuredGrid { pieces, .. } = vtk.data else {
        panic!("not an unstructured grid")
    };
    let Some(Piece::Inline(piece)) = pieces.into_iter().next() else {
        panic!("no inline piece")
    };
    *piece
}

fn array(piece: &UnstructuredGridPiece, name: &str) -> Vec<f64> {
    let found = piece
        .data
        .point
        .iter()
        .find_map(|attribute| match attribute {
            Attribute::DataArray(array) if array.name == name => {
                array.data.clone().cast_into::<f64>()
            }
            _ => None,
        });
    found.unwrap_or_else(|| panic!("no point array {name}"))
}

#[test]
fn field_files_hold_both_members_in_the_fixed_frame() {
    let frame = synthetic::frame(15_000.0, 0.0);
    let grid = piece(&vtk::vtu("frame.vtu", &frame).unwrap());
    let nodes = frame.pinion.worn.len() + frame.gear.worn.len();
    let cells = 4 * synthetic::COLUMNS * synthetic::ROWS;
    let points = grid.points.clone().cast_into::<f64>().unwrap();
    assert_eq!((points.len(), grid.cells.types.len()), (3 * nodes, cells));
    assert!(
        grid.cells
            .types
            .iter()
            .all(|kind| *kind == CellType::QuadraticTriangle)
    );
    let VertexNumbers::XML {
        connectivity,
        offsets,
    } = &grid.cells.cell_verts
    else {
        panic!("legacy cells")
    };
    assert_eq!(
        (offsets[0], *offsets.last().unwrap()),
        (6, 6 * cells as u64)
    );
    assert!(
        connectivity[connectivity.len() / 2..]
            .iter()
            .all(|&node| node as usize >= nodes / 2)
    );
    assert_eq!(
        array(&grid, "member").iter().sum::<f64>(),
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
    let force = array(&grid, "contact_force");
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
    let stress = array(&grid, "stress");
    let (s, c) = frame.pinion.rotation.sin_cos();
    let expected = [100.0 * c * c, 100.0 * s * s, 30.0, 100.0 * c * s, 0.0, 0.0];
    for (found, wanted) in stress[..6].iter().zip(expected) {
        assert!((found - wanted).abs() < 1e-5, "{found} {wanted}");
    }
    // Worn material: 1.5 µm off the contact side, against the outward normal (70° for the pinion).
    let (vector, depth) = (array(&grid, "wear_vector"), array(&grid, "wear_depth"));
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
    let grid = piece(&vtk::vtu("frame.vtu", &frame).unwrap());
    assert!(
        grid.cells
            .types
            .iter()
            .all(|kind| *kind == CellType::Triangle)
    );
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

#[test]
fn a_failure_midway_leaves_nothing_under_the_final_name() {
    let dir = tempfile::tempdir().unwrap();
    let target = dir.path().join("study.out/run");
    let mut broken = synthetic::run();
    broken.fields[4].gear.von_mises[7] = f64::NAN;
    let error = write_run(&broken, &target).unwrap_err();
    assert!(matches!(error, OutputError::NotFinite { .. }), "{error}");
    assert!(
        error
            .to_string()
            .contains("wear_002_position_002.vtu: gear von_mises is NaN"),
        "{error}"
    );
    assert_eq!(
        fs::read_dir(dir.path().join("study.out")).unwrap().count(),
        0
    );

    // Over a finished result: that one stays as it was.
    write_run(&synthetic::run(), &target).unwrap();
    let before = fs::read(target.join("summary.json")).unwrap();
    broken.title = "another".to_owned();
    write_run(&broken, &target).unwrap_err();
    assert_eq!(fs::read(target.join("summary.json")).unwrap(), before);
    assert_eq!(
        fs::read_dir(dir.path().join("study.out")).unwrap().count(),
        1
    );
}

#[test]
fn a_finished_folder_is_replaced_whole_and_a_foreign_one_refused() {
    let dir = tempfile::tempdir().unwrap();
    let target = dir.path().join("run");
    let mut first = Staging::begin(&target).unwrap();
    first.write("old/only.txt", b"old").unwrap();
    assert!(!target.exists());
    first.commit().unwrap();
    assert!(atomic::is_result(&target) && atomic::check(&target).is_ok());
    let mut second = Staging::begin(&target).unwrap();
    second.write("new.txt", b"new").unwrap();
    assert!(target.join("old/only.txt").exists());
    second.commit().unwrap();
    assert!(target.join("new.txt").exists() && !target.join("old").exists());
    assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1);

    let foreign = dir.path().join("thesis");
    fs::create_dir(&foreign).unwrap();
    Staging::begin(&foreign).map(drop).unwrap();
    fs::write(foreign.join("chapter1.tex"), b"precious").unwrap();
    let error = Staging::begin(&foreign).unwrap_err();
    assert!(
        matches!(&error, OutputError::Foreign { found, .. } if found == "chapter1.tex"),
        "{error}"
    );
    let error = Staging::begin(&foreign.join("chapter1.tex")).unwrap_err();
    assert!(matches!(error, OutputError::NotAFolder { .. }), "{error}");
    let error = Staging::begin(&foreign.join("chapter1.tex/run")).unwrap_err();
    assert!(matches!(error, OutputError::Io { .. }), "{error}");
    assert!(matches!(
        Staging::begin(Path::new("/")).unwrap_err(),
        OutputError::Nameless { .. }
    ));
    let mut third = Staging::begin(&target).unwrap();
    for name in ["../evil", "/evil", ""] {
        assert!(matches!(
            third.write(name, b"").unwrap_err(),
            OutputError::OutsideFolder { .. }
        ));
    }
    // A folder that turned foreign while the run was on its way is not overwritten.
    let late = dir.path().join("late");
    let staging = Staging::begin(&late).unwrap();
    fs::create_dir(&late).unwrap();
    fs::write(late.join("mine.txt"), b"mine").unwrap();
    assert!(matches!(
        staging.commit().unwrap_err(),
        OutputError::Foreign { .. }
    ));
    assert_eq!(fs::read(late.join("mine.txt")).unwrap(), b"mine");
}

#[test]
fn single_files_are_replaced_or_left_alone() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("deep/study.toml");
    write_file(&file, b"one").unwrap();
    write_file(&file, b"two").unwrap();
    assert_eq!(fs::read(&file).unwrap(), b"two");
    let error = write_file(dir.path().join("deep").as_path(), b"three").unwrap_err();
    assert!(matches!(error, OutputError::Io { .. }), "{error}");
    assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1);
    assert_eq!(fs::read_dir(dir.path().join("deep")).unwrap().count(), 1);
}

/// Every address in a page: values of href, src and url(...).
fn addresses(page: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for (opening, end) in [
        ("href=\"", '"'),
        ("src=\"", '"'),
        ("url(", ')'),
        ("@import", ';'),
    ] {
        found.extend(
            page.split(opening)
                .skip(1)
                .map(|rest| rest.split(end).next().unwrap_or_default().to_owned()),
        );
    }
    found
}

#[test]
fn the_report_is_self_contained_and_complete() {
    let (dir, run) = written();
    let page = read(&dir, "report.html");
    for address in addresses(&page) {
        let inside =
            address.starts_with('#') || dir.path().join("study.out/run").join(&address).is_file();
        assert!(inside, "{address}");
    }
    let without_namespace = page.replace("http://www.w3.org/2000/svg", "");
    assert!(
        !without_namespace.contains("http") && !page.contains("<script") && !page.contains("<link")
    );
    assert!(
        page.contains("Made-up pair &lt;27/53&gt; &amp; &quot;quotes&quot;")
            && !page.contains("<27/53>")
    );
    assert_eq!(page.matches("<figure>").count(), 6);
    for heading in [
        "Results",
        "Inputs",
        "Geometry",
        "Mesh and cost",
        "Checks",
        "Stored states",
        "Files",
    ] {
        assert!(page.contains(&format!("\">{heading}</h2>")), "{heading}");
    }
    assert!(page.contains("prefers-color-scheme: dark") && page.contains("@media print"));
    // The conclusion carries the figures: the depth that the profile holds, to three digits.
    let deepest = run.last().pinion.max_depth();
    let conclusion = page
        .split("class=\"conclusion\">")
        .nth(1)
        .unwrap()
        .split("</p>")
        .next()
        .unwrap();
    assert!(
        conclusion.contains(&format!("{deepest:.2} µm")),
        "{conclusion}"
    );
    for tag in [
        "table", "tr", "td", "section", "figure", "svg", "p", "div", "text",
    ] {
        let opened =
            page.matches(&format!("<{tag}>")).count() + page.matches(&format!("<{tag} ")).count();
        assert_eq!(opened, page.matches(&format!("</{tag}>")).count(), "{tag}");
    }
    // A failed check is said at the top.
    let mut failed = run;
    failed.checks[0].value = 1.0;
    let page = html::run(&failed, &[]).unwrap();
    let conclusion = page
        .split("class=\"conclusion\">")
        .nth(1)
        .unwrap()
        .split("</p>")
        .next()
        .unwrap();
    assert!(conclusion.contains("1 check") && page.contains("badge fail"));
}

#[test]
fn plots_draw_the_numbers() {
    // A straight line stays one: three points on it, two thirds apart.
    let plot = Plot::new("line", "A <line>", "x, mm", "y, µm").starting_at_zero();
    let svg = plot
        .curve(
            "here",
            Style::Kind(0),
            vec![(0.0, 0.0), (1.0, 10.0), (3.0, 30.0)],
        )
        .svg()
        .unwrap();
    let line = svg
        .split("<polyline")
        .filter(|part| part.contains("#0072B2"))
        .find_map(|part| {
            let points = part.split("points=\"").nth(1)?.split('"').next()?;
            let points: Vec<(f64, f64)> = points
                .split_whitespace()
                .map(|p| {
                    p.split_once(',')
                        .map(|(x, y)| (x.parse().unwrap(), y.parse().unwrap()))
                        .unwrap()
                })
                .collect();
            (points.len() == 3).then_some(points)
        });
    let line = line.unwrap_or_else(|| panic!("no curve in {svg}"));
    let [(x0, y0), (x1, y1), (x2, y2)] = [line[0], line[1], line[2]];
    assert!(
        ((x2 - x0) - 3.0 * (x1 - x0)).abs() <= 3.0 && ((y2 - y0) - 3.0 * (y1 - y0)).abs() <= 3.0,
        "{line:?}"
    );
    assert!(x2 > x0 + 400.0 && y2 < y0 - 200.0, "{line:?}");
    for text in ["x, mm", "y, µm", "here", "A &lt;line&gt;", "role=\"img\""] {
        assert!(svg.contains(text), "{text}");
    }
    // Same data, same bytes.
    let run = synthetic::run();
    let draw = || {
        gearwear::report::plots::of_run(&run)
            .iter()
            .map(|plot| plot.svg().unwrap())
            .collect::<Vec<_>>()
    };
    assert_eq!(draw(), draw());
    // Nothing to draw and constant data do no harm.
    let flat = Plot::new("flat", "", "", "").curve(
        "c",
        Style::Points(1),
        vec![(1.0, 5.0), (f64::NAN, 1.0)],
    );
    assert!(flat.svg().is_ok() && Plot::new("none", "", "", "").svg().is_ok());
}

#[test]
fn models_stand_side_by_side() {
    let dir = tempfile::tempdir().unwrap();
    let run = synthetic::run();
    let column = |name: &str| ModelColumn {
        name: name.to_owned(),
        ..ModelColumn::of_run(&run, "assumes | little")
    };
    let models = Models {
        title: "Three models".to_owned(),
        conditions: text::asked_for(&run),
        conclusion: "They differ at the ends of contact.".to_owned(),
        path_limits: run.geometry.path_limits,
        models: vec![column("fem"), column("hertz"), column("paper")],
        differences: vec![Difference {
            quantity: "peak pressure, MPa".to_owned(),
            values: vec![Some(858.1), Some(875.8), None],
            cause: "load sharing".to_owned(),
        }],
    };
    let done = write_models(&models, &dir.path().join("models")).unwrap();
    let json: Value =
        serde_json::from_slice(&fs::read(done.folder.join("models.json")).unwrap()).unwrap();
    assert_eq!(json["models"][2]["name"], "paper");
    assert_eq!(json["differences"][0]["values"][2], Value::Null);
    let page = fs::read_to_string(done.folder.join("report.html")).unwrap();
    assert!(page.contains("875.8") && page.matches("<figure>").count() == 4);
}

#[test]
fn validation_is_written_for_people_and_programs() {
    let case = |id: &str, group: &str, verdict: Verdict| Case {
        id: id.to_owned(),
        group: group.to_owned(),
        what: "peak pressure, MPa".to_owned(),
        target: Some(3585.37),
        source: "NAFEMS, \"Cylinder\" | roller".to_owned(),
        value: (verdict != Verdict::Skipped).then_some(3590.0),
        error: (verdict != Verdict::Skipped).then_some(0.0013),
        tolerance: 0.02,
        measure: "relative".to_owned(),
        verdict,
        note: if verdict == Verdict::Pass {
            String::new()
        } else {
            format!("see {id}")
        },
    };
    let cases = [
        case("B3", "Contact", Verdict::Pass),
        case("C1", "Geometry", Verdict::Fail),
        case("B4", "Contact", Verdict::Skipped),
        case("P9", "Paper", Verdict::ContradictsTheory),
    ];
    let dir = tempfile::tempdir().unwrap();
    let done = write_validation(&cases, &dir.path().join("validate")).unwrap();
    let json: Value =
        serde_json::from_slice(&fs::read(done.folder.join("validation.json")).unwrap()).unwrap();
    let verdicts: Vec<_> = json["cases"]
        .as_array()
        .unwrap()
        .iter()
        .map(|case| case["verdict"].clone())
        .collect();
    assert_eq!(verdicts, ["pass", "fail", "skipped", "contradicts_theory"]);
    for key in [
        "id",
        "target",
        "source",
        "value",
        "error",
        "tolerance",
        "verdict",
    ] {
        assert!(json["cases"][0].get(key).is_some(), "{key}");
    }
    let markdown = fs::read_to_string(done.folder.join("RESULTS.md")).unwrap();
    assert!(markdown.contains("1 of 4 cases pass, 1 fail"), "{markdown}");
    let rows: Vec<&str> = markdown
        .lines()
        .filter(|line| line.contains("`B3`") || line.contains("`B4`"))
        .collect();
    assert!(
        rows.len() >= 2 && rows[0].contains("\\| roller") && rows[0].contains("**pass**"),
        "{rows:?}"
    );
    let page = fs::read_to_string(done.folder.join("report.html")).unwrap();
    assert!(
        page.contains("badge pass") && page.contains("badge fail") && page.contains("badge theory")
    );
}

#[test]
fn the_terminal_summary_tells_figures_files_and_next_step() {
    let (dir, run) = written();
    let said = text::summary(&run, &dir.path().join("study.out/run"));
    let deepest = format!("{:.3} µm", run.last().pinion.max_depth());
    for part in [
        deepest.as_str(),
        "report.html",
        "ParaView",
        "Next:",
        "100 N·m",
        "50\u{202f}000 pinion revolutions",
    ] {
        assert!(said.contains(part), "{part} not in\n{said}");
    }
    assert!(said.lines().count() < 20 && said.lines().all(|line| line.chars().count() < 160));
}
