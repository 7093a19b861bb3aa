//! S1: the face in slices, against closed forms and against the model of one section.
//!
//! ```text
//! rigid wedge on springs     X = F c/(2w):  K_Hβ = 1 + X for X ≤ 1, 2√X beyond             ISO 6336-1, linear bedding
//! rigid crown on springs     X = C c/w:     w(0)/w = 1 + X/3 for X ≤ 3/2, (3/2)^⅔ X^⅓ beyond
//! waves along a plate        D (∂⁴X − 2κ² ∂²X + κ⁴ X) = 0, clamped at one edge, q cos κz on the other      Kirchhoff
//! free ends: a beam b x h    bent     F a³/(3 E I) + F a/(5/6 G A)                          plane strain would have E/(1 − nu²)
//!                            twisted  T a/(G J), J = 0.22868 b h³ for b = 2 h               Timoshenko & Goodier (1970), section 109
//! ```

use nalgebra::DMatrix;

use crate::contact::unilateral::{Drive, JointProblem, Problem, Section, solve, solve_joint};
use crate::fem::structured::{Order, Patch};
use crate::fem::{FemError, FreeEnds, Prism};
use crate::material::Elastic;
use crate::numeric::Vec2;
use crate::verify::contact_and_wear::Effort;
use crate::verify::{CaseError, Measured};

/// The id of these cases.
pub const ID: &str = "S1";

/// Whence the targets come.
pub const SOURCE: &str = "closed forms: ISO 6336-1 on linear bedding, Kirchhoff's plate, beams that bend and twist; the model of one section";

/// Why the tolerances are what they are.
pub const REASON: &str = "1e-3 of a load is what the last of 2000 slices stands from the end of the face; 1 % is what a plate a hundredth of its reach thick shears, and what a clamp a fortieth \
     of its width from the load stiffens a beam by; \
     slices without ties are sections to rounding";

/// Springs of every slice, N/(mm µm), and the mean load, N/mm.
const STIFFNESS: f64 = 20.0;
const MEAN: f64 = 150.0;
const SLICES: usize = 2000;

/// All of them.
///
/// # Errors
/// [`CaseError`] if a contact or a plate is not solved.
pub fn all(_: Effort) -> Result<Vec<Measured>, CaseError> {
    let mut out = Vec::new();
    for wedge in [3.0, 10.0, 40.0, 150.0] {
        let x = wedge * STIFFNESS / (2.0 * MEAN);
        let target = if x <= 1.0 {
            1.0 + x
        } else {
            2.0 * f64::sqrt(x)
        };
        let loads = on_springs(&|share| wedge * share)?;
        // the outermost slice stands half a slice from the end
        let end = loads[0] + x / SLICES as f64;
        let name = format!("rigid wedge of {wedge} µm: K_Hbeta");
        out.push(Measured::relative(ID, name, end, target, 1e-3));
    }
    for crown in [5.0, 30.0] {
        let x: f64 = crown * STIFFNESS / MEAN;
        let target = if x <= 1.5 {
            1.0 + x / 3.0
        } else {
            1.5f64.powf(2.0 / 3.0) * x.cbrt()
        };
        let loads = on_springs(&|share| crown * (2.0 * share).powi(2))?;
        let name = format!("rigid crown of {crown} µm: load at mid-face over the mean");
        out.push(Measured::relative(
            ID,
            name,
            loads[SLICES / 2],
            target,
            1e-3,
        ));
    }
    out.push(sections()?);
    out.extend(plate()?);
    out.extend(beam()?);
    Ok(out)
}

/// Load over the mean of slices on springs, where `missing` µm are missing at the place −½ to ½ across the face.
fn on_springs(missing: &dyn Fn(f64) -> f64) -> Result<Vec<f64>, CaseError> {
    let place = |i: usize| (i as f64 + 0.5) / SLICES as f64 - 0.5;
    let gaps: Vec<Vec<f64>> = (0..SLICES).map(|i| vec![missing(place(i))]).collect();
    let solution = solve_joint(
        &JointProblem {
            sections: &[Section {
                w: &DMatrix::from_element(1, 1, 1.0 / STIFFNESS),
                arm: &[1.0],
                lever: &[1.0],
            }],
            at: &vec![0; gaps.len()],
            gaps: &gaps,
            weights: &vec![1.0 / SLICES as f64; SLICES],
            load: MEAN,
            symmetric: true,
        },
        &[],
    )?;
    Ok(solution.pressure.iter().map(|p| p[0] / MEAN).collect())
}

/// Unlike slices without ties, each against the problem of one section under the load that it carries.
fn sections() -> Result<Measured, CaseError> {
    let (n, count) = (12, 7);
    let w = DMatrix::from_fn(n, n, |i, j| {
        let apart = (i as f64 - j as f64).abs();
        1.0 / (1.0 + apart) + if i == j { 0.5 } else { 0.0 }
    });
    let gaps: Vec<Vec<f64>> = (0..count)
        .map(|i| {
            (0..n)
                .map(|k| 0.02 * (k as f64 - 5.0).powi(2) + 0.1 * i as f64)
                .collect()
        })
        .collect();
    let (arm, weights) = (vec![1.0; n], vec![1.0 / count as f64; count]);
    let joint = solve_joint(
        &JointProblem {
            sections: &[Section {
                w: &w,
                arm: &arm,
                lever: &arm,
            }],
            at: &vec![0; gaps.len()],
            gaps: &gaps,
            weights: &weights,
            load: 2.0,
            symmetric: true,
        },
        &[],
    )?;
    let mut worst: f64 = 0.0;
    for (gap, pressure) in gaps.iter().zip(&joint.pressure) {
        let alone = solve(
            &Problem {
                w: &w,
                gap,
                arm: &arm,
                lever: &arm,
                drive: Drive::Load(pressure.iter().sum()),
                symmetric: true,
            },
            &[],
        )?;
        let largest = alone.pressure.iter().fold(0.0, |m: f64, p| m.max(*p));
        for (a, b) in pressure.iter().zip(&alone.pressure) {
            worst = worst.max((a - b).abs() / largest);
        }
    }
    let name =
        "slices without ties against one section under each one's load: largest pressure error";
    Ok(Measured::bound(ID, name, worst, 1e-12))
}

/// Deflections of a plate's loaded edge, by waves, mm per N/mm.
fn plate() -> Result<Vec<Measured>, FemError> {
    let (reach, thickness) = (10.0, 0.1);
    let steel = Elastic {
        youngs_modulus: 2.1e5,
        poisson_ratio: 0.3,
    };
    let nu = steel.poisson_ratio;
    let rigidity = steel.youngs_modulus * f64::powi(thickness, 3) / (12.0 * (1.0 - nu * nu));
    let map = |s, t| Vec2::new(reach * s, thickness * (t - 0.5));
    let patch = Patch::new(40, 2, Order::Quadratic, map)?;
    let prism = Prism::new(&patch.mesh, steel, &patch.left)?;
    let edge = patch.right[2];
    let mut out = Vec::new();
    for share in [0.3f64, 1.0, 2.0, 4.0] {
        let k = share / reach;
        let wave = prism.wave(k)?;
        let found = wave.solve(&[(edge, Vec2::new(0.0, 1.0))], &[edge])[0].y;
        let target = deflection(reach, k, nu) / rigidity;
        let name = format!(
            "clamped plate under a wave, kappa h = {share}: deflection of its edge, mm per N/mm"
        );
        out.push(Measured::relative(ID, name, found, target, 0.01));
    }
    Ok(out)
}

/// The node of the middle line that is next to a place along a patch.
fn along(patch: &Patch, x: f64) -> u32 {
    let points = &patch.mesh.points;
    let apart = |node: usize| (points[node] - Vec2::new(x, 0.0)).norm();
    let nearest = (0..points.len()).min_by(|a, b| apart(*a).total_cmp(&apart(*b)));
    nearest.unwrap_or(0) as u32
}

/// A beam between free ends: its section along the reach as the mesh, its width as the length of the prism.
fn beam() -> Result<Vec<Measured>, FemError> {
    let (reach, width, height) = (40.0, 1.0, 0.5);
    let steel = Elastic {
        youngs_modulus: 2.1e5,
        poisson_ratio: 0.3,
    };
    let shear = steel.youngs_modulus / (2.0 * (1.0 + steel.poisson_ratio));
    let map = |s, t| Vec2::new(reach * s, height * (t - 0.5));
    let patch = Patch::new(80, 2, Order::Quadratic, map)?;
    let prism = Prism::new(&patch.mesh, steel, &patch.left)?;
    let down = Vec2::new(0.0, 1.0);
    let edge = patch.right[2];
    let waves: Vec<_> = (0..12)
        .map(|n| prism.wave(f64::from(n) * std::f64::consts::PI / width))
        .collect::<Result<_, _>>()?;
    // a twist goes all along the beam, and the longest wave only as far as it is wide
    let loads: Vec<(u32, Vec2)> = (1..=16)
        .map(|place| (along(&patch, reach * f64::from(place) / 16.0), down))
        .collect();
    let shapes = prism.end_shapes(width, &loads, &[0.3 / reach, 0.5 / height], &[])?;
    let ends = FreeEnds::new(&prism, shapes, vec![(edge, down)], width)?;
    let answers: Vec<_> = (waves.iter().enumerate())
        .map(|(n, wave)| ends.answer(wave, n))
        .collect();
    let modes = ends.modes(&answers)?;
    let deflection = |wave: usize| {
        let mirrored = waves[wave].solve(&[(edge, down)], &[edge])[0].y;
        mirrored + modes.of_wave(wave, 0)
    };
    let bent = 4.0 * (reach / height).powi(3) / steel.youngs_modulus;
    let sheared = reach / (5.0 / 6.0 * shear * height);
    // the torque of a load cos πz/b, and the cosine in what the twist displaces
    let (torque, share) = (2.0 * width * width, 4.0 * width);
    let polar = shear * 0.22868 * width * height.powi(3);
    let twisted = torque * share / std::f64::consts::PI.powi(4) * reach / polar;
    let figure = |name: &str, found, target| Measured::relative(ID, name, found, target, 0.01);
    Ok(vec![
        figure(
            "beam with free ends, even load at its tip: deflection, mm per N/mm",
            deflection(0),
            bent + sheared,
        ),
        figure(
            "beam with free ends, twisted at its tip: amplitude of the deflection, mm per N/mm",
            deflection(1),
            twisted,
        ),
    ])
}

/// Deflection times rigidity of a clamped plate's free edge at `x` under q cos κz with q = 1: B (x cosh κx − sinh κx/κ) + E x sinh κx.
fn deflection(x: f64, k: f64, nu: f64) -> f64 {
    let (c, s) = ((k * x).cosh(), (k * x).sinh());
    // each function and its first three derivatives at the edge
    let one = [
        x * c - s / k,
        k * x * s,
        k * s + k * k * x * c,
        2.0 * k * k * c + k.powi(3) * x * s,
    ];
    let two = [
        x * s,
        s + k * x * c,
        2.0 * k * c + k * k * x * s,
        3.0 * k * k * s + k.powi(3) * x * c,
    ];
    let moment = |f: &[f64; 4]| f[2] - nu * k * k * f[0];
    let shear = |f: &[f64; 4]| f[3] - (2.0 - nu) * k * k * f[1];
    let [b, e] = [moment(&two), -moment(&one)];
    -(b * one[0] + e * two[0]) / (b * shear(&one) + e * shear(&two))
}
