//! The drawn meshes are worn: read from the `.vtu` files, whose points are doubles and whose other arrays are single precision.
//!
//! A flank worn by h is turned back by h over the base radius; it loses ∫ h ds.
//!
//! Tolerances: 1e-8 mm for a node's place and 2.4e-7 of the depth, the single precision of displacement and depth; 0.5 % for the area,
//! of edges that are parabolas through depths given at stations.
use std::collections::BTreeMap;
use std::sync::LazyLock;

use super::home::{Home, number, study_with};
use crate::vtu::Grid;

/// Quadratic triangles, so that mid-side nodes are there to be moved too; finer than the other runs for the tip land's sake.
static FINER: LazyLock<Home> = LazyLock::new(|| {
    let home = Home::with(&[
        ("order", "2"),
        ("elements_per_half_width", "4"),
        ("stored_states", "1"),
    ]);
    home.succeed("run study.toml -o run --quiet");
    home
});

/// Wear so deep that the moved mesh cannot follow: the members are meshed anew on the way.
static DEEP: LazyLock<Home> = LazyLock::new(|| {
    let home = Home::with(&[
        ("order", "2"),
        ("coefficient", "6e-9"),
        ("cycles", "1e6"),
        ("stored_states", "1"),
    ]);
    home.succeed("run study.toml -o run --quiet");
    home
});

fn grid(home: &Home, name: &str) -> Grid {
    Grid::read(&std::fs::read(home.result("run").0.join("fields").join(name)).unwrap())
}

struct Member {
    centre: [f64; 2],
    base_radius: f64,
    nodes: Vec<usize>,
}

struct Drawn {
    /// Worn position in the fixed frame.
    points: Vec<[f64; 2]>,
    /// Worn minus unworn position.
    moved: Vec<[f64; 2]>,
    /// µm.
    depth: Vec<f64>,
    triangles: Vec<[usize; 6]>,
    members: [Member; 2],
}

fn drawn(home: &Home, name: &str) -> Drawn {
    let grid = grid(home, name);
    let plane = |flat: Vec<f64>| flat.chunks(3).map(|c| [c[0], c[1]]).collect::<Vec<_>>();
    let connectivity = grid.array("Cells/connectivity");
    let member = grid.array("PointData/member");
    let of = |number: f64, centre: f64, teeth: f64| Member {
        centre: [centre, 0.0],
        base_radius: teeth * 20f64.to_radians().cos(),
        nodes: (0..member.len()).filter(|&i| member[i] == number).collect(),
    };
    Drawn {
        points: plane(grid.array("Points/points")),
        moved: plane(grid.array("PointData/wear_vector")),
        depth: grid.array("PointData/wear_depth"),
        triangles: connectivity
            .chunks(6)
            .map(|c| std::array::from_fn(|i| c[i] as usize))
            .collect(),
        members: [of(0.0, 0.0, 27.0), of(1.0, 80.0, 53.0)],
    }
}

#[test]
fn flank_nodes_are_turned_back_by_the_worn_depth() {
    for (home, name, worn) in [
        (&FINER, "wear_000_position_000.vtu", false),
        (&FINER, "wear_001_position_000.vtu", true),
        (&DEEP, "wear_001_position_000.vtu", true),
    ] {
        let drawn = drawn(home, name);
        for member in &drawn.members {
            let mut flank_nodes = 0;
            for &i in member.nodes.iter().filter(|&&i| drawn.depth[i] > 0.0) {
                let unworn =
                    [0, 1].map(|a| drawn.points[i][a] - drawn.moved[i][a] - member.centre[a]);
                let (sin, cos) = (-1e-3 * drawn.depth[i] / member.base_radius).sin_cos();
                let worn = [
                    cos * unworn[0] - sin * unworn[1],
                    sin * unworn[0] + cos * unworn[1],
                ];
                for axis in 0..2 {
                    let miss = drawn.moved[i][axis] - (worn[axis] - unworn[axis]);
                    let rounding = 1e-8 + 2.4e-10 * drawn.depth[i];
                    assert!(miss.abs() < rounding, "{name}, node {i}: off by {miss} mm");
                }
                flank_nodes += 1;
            }
            assert_eq!(flank_nodes > 100, worn, "{name}: {flank_nodes} nodes");
        }
        if !worn {
            assert!(drawn.moved.iter().flatten().all(|m| *m == 0.0));
        }
    }
}

/// Area of the triangles of a member: Green's theorem over their edges, each a parabola through three nodes (chord and
/// Archimedes' segment of 2/3 chord × sagitta).
fn area(drawn: &Drawn, points: &[[f64; 2]], member: &Member) -> f64 {
    let first = member.nodes[0];
    let last = member.nodes[member.nodes.len() - 1];
    let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let from = |a: [f64; 2], b: [f64; 2]| [b[0] - a[0], b[1] - a[1]];
    drawn
        .triangles
        .iter()
        .filter(|t| (first..=last).contains(&t[0]))
        .flat_map(|t| [[t[0], t[3], t[1]], [t[1], t[4], t[2]], [t[2], t[5], t[0]]])
        .map(|edge| {
            let [a, mid, b] = edge.map(|i| points[i]);
            0.5 * cross(a, b) + 2.0 / 3.0 * cross(from(a, mid), from(a, b))
        })
        .sum()
}

#[test]
fn the_area_that_the_meshes_lose_is_the_worn_area() {
    let drawn = drawn(&FINER, "wear_001_position_000.vtu");
    let unworn: Vec<[f64; 2]> = (0..drawn.points.len())
        .map(|i| [0, 1].map(|a| drawn.points[i][a] - drawn.moved[i][a]))
        .collect();
    let summary = FINER.result("run").summary();
    for (member, (name, teeth)) in drawn.members.iter().zip([("pinion", 27.0), ("gear", 53.0)]) {
        // the flanks that are meshed finely are the worn ones: count them by the tooth their nodes belong to
        let mut flanks = BTreeMap::new();
        for &i in member.nodes.iter().filter(|&&i| drawn.depth[i] > 0.0) {
            let [x, y] = [0, 1].map(|a| unworn[i][a] - member.centre[a]);
            let angle = y.atan2(x) - (member.base_radius / x.hypot(y)).acos();
            // along one flank the tangent point turns by less than its pitch angle
            let roll = ((x.hypot(y) / member.base_radius).powi(2) - 1.0).sqrt();
            let tooth = ((angle + roll) / (std::f64::consts::TAU / teeth) * 100.0).round() as i64;
            *flanks
                .entry(tooth.rem_euclid(100 * teeth as i64))
                .or_insert(0) += 1;
        }
        let count = flanks.len() as f64;
        let lost = area(&drawn, &unworn, member) - area(&drawn, &drawn.points, member);
        let expected = count * number(&summary, &format!("/wear/{name}/worn_area_mm2"));
        assert!(
            (lost / expected - 1.0).abs() < 5e-3,
            "{name}: {lost} mm² of {count} flanks, worn area {expected}"
        );
    }
}

/// Five times the load bends tip corners into contact in every picture: their pressure counts over the tip land's edge too.
///
/// Source: the line load of the contact solution. Tolerance: 1e-6, rounding of both integrals.
#[test]
fn the_pressure_over_the_outline_is_the_load_at_corners_too() {
    let home = Home::with(&[("order", "2"), ("torque", "500.0"), ("fields", "3")]);
    loads_are_drawn(&home);
}

/// Rounded tips touch along their rounding: flanks end there, and what they bear is drawn whole and nowhere negative.
#[test]
fn rounded_tips_bear_their_load_along_the_rounding() {
    let study = study_with(&[("order", "2"), ("torque", "300.0"), ("fields", "3")]);
    for radius in ["0.05", "0.3"] {
        let home = Home::with(&[]);
        let rounded = |member: &str| {
            (
                member.to_owned(),
                format!("{member}tip_rounding = {radius}\n"),
            )
        };
        let [(p, pinion), (g, gear)] = ["[gears.pinion]\n", "[gears.gear]\n"].map(rounded);
        let rounded = study.replace(&p, &pinion).replace(&g, &gear);
        assert_eq!(rounded.matches("tip_rounding").count(), 2);
        home.write("study.toml", &rounded);
        loads_are_drawn(&home);
    }
}

/// Runs the study: in every picture the pressure over each member's outline is the load, and nowhere negative.
fn loads_are_drawn(home: &Home) {
    home.succeed("run study.toml -o run --quiet");
    let loads = std::fs::read(home.result("run").0.join("fields/loads.json")).unwrap();
    let loads: serde_json::Value = serde_json::from_slice(&loads).unwrap();
    let files = loads["files"].as_array().unwrap();
    assert_eq!(files.len(), 5);
    for file in files {
        let name = file["file"].as_str().unwrap();
        let pressure = grid(home, name).array("PointData/contact_pressure");
        assert!(pressure.iter().all(|p| *p >= 0.0), "{name}");
        let drawn = drawn(home, name);
        let mut outline = BTreeMap::new();
        for t in &drawn.triangles {
            for [a, mid, b] in [[t[0], t[3], t[1]], [t[1], t[4], t[2]], [t[2], t[5], t[0]]] {
                *outline.entry((a.min(b), mid, a.max(b))).or_insert(0) += 1;
            }
        }
        let mut load = [0.0; 2];
        for ((a, mid, b), _) in outline.into_iter().filter(|(_, cells)| *cells == 1) {
            let at = [a, mid, b].map(|i| (drawn.points[i], pressure[i]));
            let of_gear = usize::from(drawn.members[1].nodes[0] <= a);
            load[of_gear] += pressure_over(at);
        }
        for found in load {
            let wanted = file["line_load"].as_f64().unwrap();
            assert!(
                (found / wanted - 1.0).abs() < 1e-6,
                "{name}: {found} N/mm, {wanted} applied"
            );
        }
    }
}

/// ∫ p ds over a parabola through three points with their pressures, by three Gauss points.
fn pressure_over(edge: [([f64; 2], f64); 3]) -> f64 {
    let point = |t: f64| {
        let shape = [
            (1.0 - t) * (1.0 - 2.0 * t),
            4.0 * t * (1.0 - t),
            t * (2.0 * t - 1.0),
        ];
        let slope = [4.0 * t - 3.0, 4.0 - 8.0 * t, 4.0 * t - 1.0];
        let sum = |of: &dyn Fn(usize) -> f64| (0..3).map(of).sum::<f64>();
        let along = [0, 1].map(|a| sum(&|i| slope[i] * edge[i].0[a]));
        sum(&|i| shape[i] * edge[i].1) * along[0].hypot(along[1])
    };
    let far = 0.15f64.sqrt();
    (5.0 * (point(0.5 - far) + point(0.5 + far)) + 8.0 * point(0.5)) / 18.0
}

/// Of 150 µm, a sixth of what is left of the tooth's thickness at the tip, with the torque and the balance of worn area as they
/// should be; tolerance: 0.5 % for the area, as for mild wear.
#[test]
fn wear_of_many_element_sides_is_followed_by_new_meshes() {
    let summary = DEEP.result("run").summary();
    for (member, least) in [("pinion", 130.0), ("gear", 70.0)] {
        let depth = number(&summary, &format!("/wear/{member}/max_depth_um"));
        assert!(depth > least, "{member}: {depth} µm");
    }
    assert!(number(&summary, "/wear/balance_error") < 5e-3);
    let nodes = |name: &str| drawn(&DEEP, name).points.len();
    assert_ne!(
        nodes("wear_000_position_000.vtu"),
        nodes("wear_001_position_000.vtu"),
        "no gear was meshed anew"
    );
}
