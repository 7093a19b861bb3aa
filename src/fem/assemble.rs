//! Element stiffness, and its assembly into the lower triangle of a sparse matrix whose pattern is built once.
//!
//! ```text
//! K_ab = ∫ [ λ ∇N_a ∇N_bᵀ + μ ∇N_b ∇N_aᵀ + μ (∇N_a · ∇N_b) I ] dA        N/mm per mm of width, 2 x 2 for nodes a, b
//! λ = E nu / ((1 + nu)(1 − 2 nu)),  μ = E / (2 (1 + nu))
//! ```
//! Plane strain: no strain across the width. Zienkiewicz, Taylor & Zhu (2005), Eq. (4.20) with the constants of section 4.5.

use super::FemError;
use super::triangle::{Element, element_count, nodes_of};
use crate::material::Elastic;
use crate::mesh::{Cells, Mesh};
use crate::numeric::Vec2;

/// Stiffness of one element; row and column 2 a + d for node a, direction d (0 x, 1 y).
pub type ElementStiffness = [[f64; 12]; 12];

/// Lamé's constants λ and μ, MPa.
pub fn lame_constants(material: Elastic) -> (f64, f64) {
    let (e, nu) = (material.youngs_modulus, material.poisson_ratio);
    (
        e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)),
        e / (2.0 * (1.0 + nu)),
    )
}

/// The constants with which a plane-strain model has the in-plane stresses and displacements of a plane-stress one.
///
/// ```text
/// E' = E (1 + 2 nu) / (1 + nu)²,   nu' = nu / (1 + nu)
/// ```
/// Timoshenko & Goodier (1970), section 20. σ_zz of the result has no meaning for the plane-stress body.
pub fn plane_stress_equivalent(material: Elastic) -> Elastic {
    let (e, nu) = (material.youngs_modulus, material.poisson_ratio);
    Elastic {
        youngs_modulus: e * (1.0 + 2.0 * nu) / (1.0 + nu).powi(2),
        poisson_ratio: nu / (1.0 + nu),
    }
}

/// Stiffness of a triangle per mm of width. `number` only labels an error.
pub fn element_stiffness(
    element: &Element,
    material: Elastic,
    number: usize,
) -> Result<ElementStiffness, FemError> {
    let (lambda, mu) = lame_constants(material);
    let mut k = [[0.0; 12]; 12];
    let n = element.len;
    for point in element.stiffness_rule() {
        let at = element.upright_at(point, number)?;
        let weight = point.weight * at.jacobian;
        for a in 0..n {
            let ga = weight * at.gradient[a];
            for b in 0..=a {
                let gb = at.gradient[b];
                let dot = mu * (ga.x * gb.x + ga.y * gb.y);
                k[2 * a][2 * b] += (lambda + mu) * ga.x * gb.x + dot;
                k[2 * a][2 * b + 1] += lambda * ga.x * gb.y + mu * ga.y * gb.x;
                k[2 * a + 1][2 * b] += lambda * ga.y * gb.x + mu * ga.x * gb.y;
                k[2 * a + 1][2 * b + 1] += (lambda + mu) * ga.y * gb.y + dot;
            }
        }
    }
    mirror(&mut k, 2 * n);
    Ok(k)
}

/// Copies the lower triangle of the leading `size` rows to the upper one.
fn mirror(k: &mut ElementStiffness, size: usize) {
    for row in 1..size {
        let (above, below) = k.split_at_mut(row);
        for (target, value) in above.iter_mut().zip(&below[0]) {
            target[row] = *value;
        }
    }
}

/// Nodal forces K u of a displacement field, N per mm of width, summed over the elements in order.
pub fn internal_forces(
    mesh: &Mesh,
    material: Elastic,
    displacement: &[Vec2],
) -> Result<Vec<Vec2>, FemError> {
    if displacement.len() != mesh.points.len() {
        return Err(FemError::FieldLength {
            found: displacement.len(),
            expected: mesh.points.len(),
        });
    }
    let mut force = vec![Vec2::zeros(); mesh.points.len()];
    for index in 0..element_count(&mesh.cells) {
        let element = Element::of(mesh, index);
        if element
            .nodes()
            .iter()
            .all(|&node| displacement[node as usize] == Vec2::zeros())
        {
            continue;
        }
        let k = element_stiffness(&element, material, index)?;
        for (a, &node_a) in element.nodes().iter().enumerate() {
            for (b, &node_b) in element.nodes().iter().enumerate() {
                let u = displacement[node_b as usize];
                let (x, y) = (2 * a, 2 * a + 1);
                force[node_a as usize] += Vec2::new(
                    k[x][2 * b] * u.x + k[x][2 * b + 1] * u.y,
                    k[y][2 * b] * u.x + k[y][2 * b + 1] * u.y,
                );
            }
        }
    }
    Ok(force)
}

/// Elastic energy ½ uᵀ K u per mm of width, N.
pub fn strain_energy(
    mesh: &Mesh,
    material: Elastic,
    displacement: &[Vec2],
) -> Result<f64, FemError> {
    let force = internal_forces(mesh, material, displacement)?;
    Ok(0.5
        * force
            .iter()
            .zip(displacement)
            .map(|(f, u)| f.dot(u))
            .sum::<f64>())
}

/// No equation: the unknown is fixed.
pub(super) const FIXED: u32 = u32::MAX;

/// Lower triangle of the stiffness of the free unknowns, by columns, with the place of every element entry in it.
#[derive(Debug, Clone)]
pub(super) struct StiffnessPattern {
    pub(super) column_start: Vec<u32>,
    pub(super) row: Vec<u32>,
    /// For each element and each of its lower-triangle entries (row by row) the index into the values, or `FIXED`.
    scatter: Vec<u32>,
}

impl StiffnessPattern {
    /// `equation[node]` numbers the unknowns of each node, or says `FIXED`.
    pub(super) fn new<const D: usize>(
        cells: &Cells,
        equation: &[[u32; D]],
        unknowns: usize,
    ) -> StiffnessPattern {
        let count = element_count(cells);
        let mut column_start = vec![0u32; unknowns + 1];
        let mut rows: Vec<Vec<u32>> = vec![Vec::new(); unknowns];
        for index in 0..count {
            let dofs = element_dofs(cells, index, equation);
            for &i in &dofs {
                for &j in &dofs {
                    if i != FIXED && j != FIXED && i >= j {
                        rows[j as usize].push(i);
                    }
                }
            }
        }
        for (j, list) in rows.iter_mut().enumerate() {
            list.sort_unstable();
            list.dedup();
            column_start[j + 1] = column_start[j] + list.len() as u32;
        }
        let row: Vec<u32> = rows.concat();
        let mut scatter = Vec::with_capacity(count * 78);
        for index in 0..count {
            let dofs = element_dofs(cells, index, equation);
            for (p, &i) in dofs.iter().enumerate() {
                for &j in &dofs[..=p] {
                    if i == FIXED || j == FIXED {
                        scatter.push(FIXED);
                        continue;
                    }
                    let (column, target) = (i.min(j) as usize, i.max(j));
                    let range = column_start[column] as usize..column_start[column + 1] as usize;
                    let place = row[range.clone()].partition_point(|&r| r < target);
                    scatter.push((range.start + place) as u32);
                }
            }
        }
        StiffnessPattern {
            column_start,
            row,
            scatter,
        }
    }

    /// Fills `values` with the `stiffness` of the elements of the mesh (and their numbers), in their order.
    pub(super) fn fill<const S: usize>(
        &self,
        mesh: &Mesh,
        values: &mut Vec<f64>,
        stiffness: impl Fn(&Element, usize) -> Result<[[f64; S]; S], FemError>,
    ) -> Result<(), FemError> {
        values.clear();
        values.resize(self.row.len(), 0.0);
        let mut place = self.scatter.iter();
        for index in 0..element_count(&mesh.cells) {
            let element = Element::of(mesh, index);
            let k = stiffness(&element, index)?;
            // as many unknowns at each of an element's nodes as at each of six
            for (i, row) in k.iter().enumerate().take(S / 6 * element.len) {
                for (&value, &target) in row[..=i].iter().zip(place.by_ref()) {
                    if target != FIXED {
                        values[target as usize] += value;
                    }
                }
            }
        }
        Ok(())
    }

    /// y = K x of the symmetric matrix.
    pub(super) fn multiply(&self, values: &[f64], x: &[f64]) -> Vec<f64> {
        let mut y = vec![0.0; x.len()];
        for (j, range) in self.column_start.windows(2).enumerate() {
            let range = range[0] as usize..range[1] as usize;
            for (&i, &value) in self.row[range.clone()].iter().zip(&values[range]) {
                let i = i as usize;
                y[i] += value * x[j];
                if i != j {
                    y[j] += value * x[i];
                }
            }
        }
        y
    }
}

/// The equation numbers of an element.
fn element_dofs<const D: usize>(cells: &Cells, index: usize, equation: &[[u32; D]]) -> Vec<u32> {
    let (len, nodes) = nodes_of(cells, index);
    let of_nodes = nodes[..len].iter();
    of_nodes.flat_map(|&node| equation[node as usize]).collect()
}
