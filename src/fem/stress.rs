//! Stresses from displacements: at points of an element, and averaged at the nodes.
//!
//! ```text
//! σ_xx = (λ + 2 μ) u_x,x + λ u_y,y      σ_yy = λ u_x,x + (λ + 2 μ) u_y,y
//! σ_xy = μ (u_x,y + u_y,x)              σ_zz = nu (σ_xx + σ_yy)
//! ```
//! T6 stresses are taken at the three interior Gauss points, where they are most accurate (Barlow, Int. J. Numer. Methods
//! Eng. 10 (1976) 243), and carried linearly to the nodes; T3 stresses are constant. A node takes the mean over its triangles.

use super::FemError;
use super::assemble::lame_constants;
use super::triangle::{Element, elements};
use crate::material::Elastic;
use crate::mesh::Mesh;
use crate::numeric::Vec2;
use crate::numeric::quadrature::TRIANGLE_3;

/// Stress state in plane strain, MPa; tension positive.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Stress {
    /// Normal stress in x.
    pub xx: f64,
    /// Normal stress in y.
    pub yy: f64,
    /// Shear stress.
    pub xy: f64,
    /// Normal stress across the width.
    pub zz: f64,
}

impl Stress {
    /// Von Mises stress, MPa: the square root of ½ [(σ_xx − σ_yy)² + (σ_yy − σ_zz)² + (σ_zz − σ_xx)²] + 3 σ_xy².
    pub fn von_mises(&self) -> f64 {
        let Stress { xx, yy, xy, zz } = *self;
        let normal = (xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2);
        (0.5 * normal + 3.0 * xy * xy).sqrt()
    }

    /// Principal stresses in the plane, larger first, MPa: ½ (σ_xx + σ_yy) ± √(¼ (σ_xx − σ_yy)² + σ_xy²).
    pub fn principal(&self) -> (f64, f64) {
        let mean = 0.5 * (self.xx + self.yy);
        let radius = (0.5 * (self.xx - self.yy)).hypot(self.xy);
        (mean + radius, mean - radius)
    }

    fn combine(parts: &[(f64, Stress)]) -> Stress {
        parts
            .iter()
            .fold(Stress::default(), |sum, (factor, s)| Stress {
                xx: sum.xx + factor * s.xx,
                yy: sum.yy + factor * s.yy,
                xy: sum.xy + factor * s.xy,
                zz: sum.zz + factor * s.zz,
            })
    }
}

/// Stress of one triangle at a reference point.
pub fn stress_at(
    element: &Element,
    material: Elastic,
    displacement: &[Vec2],
    xi: f64,
    eta: f64,
) -> Stress {
    let (lambda, mu) = lame_constants(material);
    let at = element.at(xi, eta);
    let (mut exx, mut eyy, mut gxy) = (0.0, 0.0, 0.0);
    for (&node, g) in element.nodes().iter().zip(&at.gradient) {
        let u = displacement[node as usize];
        exx += g.x * u.x;
        eyy += g.y * u.y;
        gxy += g.y * u.x + g.x * u.y;
    }
    let (xx, yy) = (
        (lambda + 2.0 * mu) * exx + lambda * eyy,
        lambda * exx + (lambda + 2.0 * mu) * eyy,
    );
    Stress {
        xx,
        yy,
        xy: mu * gxy,
        zz: material.poisson_ratio * (xx + yy),
    }
}

/// Stress of one triangle at its nodes, extrapolated from the Gauss points; the first 3 or 6 are used.
pub fn element_stress(element: &Element, material: Elastic, displacement: &[Vec2]) -> [Stress; 6] {
    if element.len == 3 {
        return [stress_at(element, material, displacement, 1.0 / 3.0, 1.0 / 3.0); 6];
    }
    let gauss = TRIANGLE_3.map(|p| stress_at(element, material, displacement, p.xi, p.eta));
    // The linear function that is 1 at Gauss point k and 0 at the other two is 2 L_k − 1/3.
    let corner = |k: usize| {
        let weights = [0, 1, 2].map(|j| (if j == k { 5.0 / 3.0 } else { -1.0 / 3.0 }, gauss[j]));
        Stress::combine(&weights)
    };
    let corners = [corner(0), corner(1), corner(2)];
    let middle = |a: usize, b: usize| Stress::combine(&[(0.5, corners[a]), (0.5, corners[b])]);
    [
        corners[0],
        corners[1],
        corners[2],
        middle(0, 1),
        middle(1, 2),
        middle(2, 0),
    ]
}

/// Stress at every node, the mean of its triangles; nodes without a triangle get zero.
pub fn nodal_stress(
    mesh: &Mesh,
    material: Elastic,
    displacement: &[Vec2],
) -> Result<Vec<Stress>, FemError> {
    if displacement.len() != mesh.points.len() {
        return Err(FemError::FieldLength {
            found: displacement.len(),
            expected: mesh.points.len(),
        });
    }
    let mut sum = vec![Stress::default(); mesh.points.len()];
    let mut count = vec![0u32; mesh.points.len()];
    for element in elements(mesh) {
        let stress = element_stress(&element, material, displacement);
        for (&node, s) in element.nodes().iter().zip(&stress) {
            let node = node as usize;
            sum[node] = Stress::combine(&[(1.0, sum[node]), (1.0, *s)]);
            count[node] += 1;
        }
    }
    Ok(sum
        .iter()
        .zip(&count)
        .map(|(s, &n)| Stress::combine(&[(1.0 / f64::from(n.max(1)), *s)]))
        .collect())
}

/// The node of `nodes` with the largest first principal stress, and that stress, MPa; the first one on ties, `None` for
/// no nodes. Root stress is this over the fillet.
pub fn largest_principal(stress: &[Stress], nodes: &[u32]) -> Option<(u32, f64)> {
    let mut largest = None;
    for &node in nodes {
        let (first, _) = stress[node as usize].principal();
        if largest.is_none_or(|(_, value)| first > value) {
            largest = Some((node, first));
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn invariants_of_known_states() {
        let shear = Stress {
            xy: 50.0,
            ..Stress::default()
        };
        assert!((shear.von_mises() - 50.0 * 3.0_f64.sqrt()).abs() < 1e-12);
        assert_eq!(shear.principal(), (50.0, -50.0));
        let pressure = Stress {
            xx: -7.0,
            yy: -7.0,
            xy: 0.0,
            zz: -7.0,
        };
        assert_eq!(pressure.von_mises(), 0.0);
        assert_eq!(pressure.principal(), (-7.0, -7.0));
    }

    #[test]
    fn largest_principal_takes_the_first_of_equals() {
        let stress = [1.0, 3.0, 3.0].map(|xx| Stress {
            xx,
            ..Stress::default()
        });
        assert_eq!(largest_principal(&stress, &[0, 2, 1]), Some((2, 3.0)));
        assert_eq!(largest_principal(&stress, &[]), None);
    }
}
