//! Case E4: largest first principal stress in the loaded side's fillet while one tooth pair carries all load.
//!
//! Targets: an independent program, quadratic triangles of 0.06 modules in the fillet.

use crate::fem::{largest_principal, nodal_stress};
use crate::simulate::root_stress::fillet_nodes;
use crate::verify::gear_pairs::{Bench, Solved, Teeth};
use crate::verify::{CaseError, Measured};

/// Stress, MPa, and where it is, mm from the gear's centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RootStress {
    /// First principal stress, MPa.
    pub stress: f64,
    /// Radius of the node, mm.
    pub radius: f64,
}

/// Path, name, and stress of pinion and gear with their radii (0: not stated).
type Target = (f64, &'static str, [f64; 2], [f64; 2]);

/// Root stresses of `bench` against its targets within 5 %.
///
/// # Errors
/// [`CaseError`] if a contact or the stresses cannot be solved.
pub fn single_pair(bench: &Bench) -> Result<Vec<Measured>, CaseError> {
    let name = bench.case.name;
    let [_, b, c, d, _] = bench.pair.path_points();
    let targets: Vec<Target> = match name {
        "REF" => vec![
            (b, "B", [133.8, 141.6], [24.74, 50.75]),
            (c, "C", [141.5, 129.3], [24.80, 50.73]),
            (d, "D", [148.8, 122.8], [24.80, 50.71]),
        ],
        "FZG-C" => vec![
            (c, "C", [230.8, 217.9], [31.66, 49.66]),
            (d, "D", [258.9, 199.5], [31.78, 49.62]),
        ],
        _ => vec![
            (c, "C", [137.4, 137.4], [27.74, 27.74]),
            (d, "D", [148.2, 129.6], [0.0; 2]),
        ],
    };
    let paths: Vec<f64> = targets.iter().map(|t| t.0).collect();
    let solved = bench.solve(&paths, bench.case.torque, Teeth::One)?;
    let mut out = Vec::new();
    for (q, (path, at, stress, radius)) in targets.into_iter().enumerate() {
        for side in 0..2 {
            let Some(found) = root_stress(bench, &solved, q, path, side)? else {
                continue;
            };
            let stated = if radius[side] > 0.0 {
                format!(" ({:.2} there)", radius[side])
            } else {
                String::new()
            };
            out.push(Measured::relative(
                "E4",
                format!(
                    "{name} root stress of the {}, load at {at}, MPa; at radius {:.2} mm{stated}",
                    ["pinion", "gear"][side],
                    found.radius
                ),
                found.stress,
                stress[side],
                0.05,
            ));
        }
    }
    Ok(out)
}

/// Largest principal stress in the loaded fillet of the tooth that touches at `path`; `None` if the mesh has no node there.
///
/// # Errors
/// [`CaseError`] if the member's equations cannot be solved.
pub fn root_stress(
    bench: &Bench,
    solved: &Solved,
    q: usize,
    path: f64,
    side: usize,
) -> Result<Option<RootStress>, CaseError> {
    let member = &bench.members.members[side];
    let displacement = member.body.solve(&solved.nodal_forces(q, side, bench))?;
    let stress = nodal_stress(&member.mesh, member.material, &displacement)?;
    let tooth = crate::contact::fem::member_tooth(solved.pair(q, path), side);
    let nodes = fillet_nodes(&bench.case.set.gears[side], &member.mesh, tooth);
    Ok(
        largest_principal(&stress, &nodes).map(|(node, stress)| RootStress {
            stress,
            radius: member.mesh.points[node as usize].norm(),
        }),
    )
}
