//! Cases D: Hertz pressures of gears, by formula and by finite elements, and equilibrium of the contact forces.

use crate::analytic::hertz_line::{half_width, peak_pressure};
use crate::numeric::{Vec2, cross};
use crate::verify::gear_pairs::{Bench, GearCase, Solved, Teeth};
use crate::verify::{CaseError, Measured};

/// D1 to D3 and the targets of D5: the closed form against published values (D1, D2: a public gear program's report).
///
/// # Errors
/// [`CaseError`] if a pair cannot be built.
pub fn formula() -> Result<Vec<Measured>, CaseError> {
    let mut out = Vec::new();
    let case = GearCase::fzg_c()?;
    let pair = case.pair()?;
    let [_, b, _, d, _] = pair.path_points();
    let load = case.load(case.torque);
    let modulus = case.set.modulus();
    let mut row = |id, what: &str, value: f64, target: f64, tolerance: f64| {
        out.push(Measured::relative(id, what, value, target, tolerance));
    };
    let force = load * case.set.face_width;
    row("D1", "FZG-C base-tangent force, N", force, 5912.1, 1e-3);
    let peak = |path: f64| peak_pressure(load, pair.relative_radius(path), modulus);
    row("D1", "FZG-C p0 at C, MPa", peak(0.0), 1347.3, 1e-3);
    let width = half_width(load, pair.relative_radius(0.0), modulus);
    row("D1", "FZG-C half width at C, mm", width, 0.19957, 1e-3);
    row("D2", "FZG-C p0 at B, MPa", peak(b), 1441.9, 1e-3);
    row("D2", "FZG-C p0 at D, MPa", peak(d), 1320.1, 1e-3);
    let case = GearCase::fzg_a()?;
    let pair = case.pair()?;
    let peak = peak_pressure(
        case.load(case.torque),
        pair.relative_radius(0.0),
        case.set.modulus(),
    );
    row("D3", "FZG-A stage 12 p0 at C, MPa", peak, 1842.7, 5e-3);
    Ok(out)
}

/// Peak pressures by finite elements at B, C, D against `targets` (MPa): with one pair alone at B and D, and again with all
/// teeth just inside the single contact, where the real neighbours (corner contact included) have left.
///
/// # Errors
/// [`CaseError`] if a contact cannot be solved.
pub fn peaks(
    bench: &Bench,
    id: &'static str,
    targets: [f64; 3],
    tolerance: f64,
) -> Result<Vec<Measured>, CaseError> {
    let name = bench.case.name;
    let torque = bench.case.torque;
    let load = bench.case.load(torque);
    let modulus = bench.case.set.modulus();
    let [_, b, c, d, _] = bench.pair.path_points();
    let mut out = Vec::new();
    let alone = bench.solve(&[b, c, d], torque, Teeth::One)?;
    for (q, (at, path)) in [("B", b), ("C", c), ("D", d)].into_iter().enumerate() {
        out.push(Measured::relative(
            id,
            format!("{name} FE peak pressure at {at}, one pair alone, MPa"),
            alone.peak(q, path),
            targets[q],
            tolerance,
        ));
    }
    for (at, from) in [("B", b), ("D", d)] {
        let paths: Vec<f64> = (0..=20)
            .map(|i| from * (1.0 - 0.05 * f64::from(i)))
            .collect();
        let solved = bench.solve(&paths, torque, Teeth::All)?;
        let Some(q) = (0..paths.len()).find(|&q| solved.carrying(q) == 1) else {
            continue;
        };
        let path = paths[q];
        let target = peak_pressure(load, bench.pair.relative_radius(path), modulus);
        out.push(Measured::relative(
            id,
            format!(
                "{name} FE peak pressure inside {at}, {:.3} mm from it, all teeth, MPa",
                (path - from).abs()
            ),
            solved.peak(q, path),
            target,
            tolerance,
        ));
    }
    Ok(out)
}

/// D6: torque of the contact forces on both members, from the pressures integrated point by point, and their sum.
///
/// # Errors
/// [`CaseError`] if a contact cannot be solved.
pub fn equilibrium(bench: &Bench) -> Result<Vec<Measured>, CaseError> {
    let torque = bench.case.torque / bench.case.set.face_width;
    let [a, b, ..] = bench.pair.path_points();
    let paths = [0.3 * a + 0.7 * b, 0.0];
    let solved = bench.solve(&paths, bench.case.torque, Teeth::All)?;
    let mut worst = [0.0_f64; 3];
    for q in 0..paths.len() {
        let (forces, moments) = resultants(bench, &solved, q);
        worst[0] = worst[0].max((-moments[0] / torque - 1.0).abs());
        worst[1] = worst[1].max((moments[1] / (torque * gear_lever(&solved, q)) - 1.0).abs());
        worst[2] = worst[2].max((forces[0] + forces[1]).norm() / forces[0].norm());
    }
    let name = bench.case.name;
    Ok(vec![
        Measured::bound(
            "D6",
            format!("{name} pinion torque of nodal forces, relative"),
            worst[0],
            1e-6,
        ),
        Measured::bound(
            "D6",
            format!("{name} gear torque of nodal forces, relative"),
            worst[1],
            1e-6,
        ),
        Measured::bound(
            "D6",
            format!("{name} sum of both members' forces, relative"),
            worst[2],
            1e-6,
        ),
    ])
}

/// Sum and moment about the own centre of the nodal forces on each member, fixed frame, N/mm and N·mm/mm.
fn resultants(bench: &Bench, solved: &Solved, q: usize) -> ([Vec2; 2], [f64; 2]) {
    let turns = crate::contact::fem::member_turns(&solved.cycle, solved.cycle.positions[q].theta);
    let (mut forces, mut moments) = ([Vec2::zeros(); 2], [0.0; 2]);
    for side in 0..2 {
        let mesh = &bench.members.members[side].mesh;
        for (node, f) in solved.nodal_forces(q, side, bench) {
            let x = crate::numeric::rotate(mesh.points[node as usize], turns[side]);
            let f = crate::numeric::rotate(f, turns[side]);
            forces[side] += f;
            moments[side] += cross(x, f);
        }
    }
    (forces, moments)
}

/// Torque on the gear per torque on the pinion: from the same pressures and the geometry of each contact frame.
fn gear_lever(solved: &Solved, q: usize) -> f64 {
    let centre = Vec2::new(solved.cycle.pair.centre_distance, 0.0);
    let (mut own, mut mate) = (0.0, 0.0);
    for pair in &solved.cycle.positions[q].pairs {
        let (o, n, t) = (pair.frame.origin, pair.frame.normal, pair.frame.tangent);
        for k in 0..pair.xi.len() {
            let p = solved.contacts[q].pressure[pair.offset + k];
            let at = o * pair.length[k] + t * pair.moment[k];
            own += p * cross(at, n);
            mate += p * cross(at - centre * pair.length[k], n);
        }
    }
    mate / own
}
