//! A prismatic body under loads that vary along its axis as a cosine: for each wave a plane problem with three unknowns a node.
//!
//! ```text
//! u_x, u_y = U, V(x, y) cos κz,   u_z = W(x, y) sin κz              κ wave number, 1/mm
//! K_ab = ∫ [ λ a ā_bᵀ + µ ( ... ) ] dA                              the strains' amplitudes, by components:
//!   cos κz:  U,x   V,y   κ W   U,y + V,x          sin κz:  W,x − κ U   W,y − κ V
//! ```
//! Exact along the axis: the strains' products integrate to half the length, as the loads' do, so amplitudes are solved for per mm of width. With
//! κ = 0 it is plane strain. The semi-analytic (finite strip) method: Zienkiewicz, Taylor & Zhu, The Finite Element Method for Solid and
//! Structural Mechanics (6th ed., 2005), chapter 16; Cheung, Finite Strip Method in Structural Analysis (1976). Gagnon, Gosselin & Cloutier (1996) used strips
//! for the deflection of gear teeth. Ends at which cosines and sines fit are mirrors: they do not move along the axis and carry no shear.

use super::FemError;
use super::assemble::{FIXED, StiffnessPattern, lame_constants};
use super::cholesky::{BadPivot, Factor};
use super::ordering::elimination_order;
use super::triangle::Element;
use crate::material::Elastic;
use crate::mesh::Mesh;
use crate::numeric::Vec2;
use crate::numeric::quadrature::TRIANGLE_7;

/// Unknowns of an element.
const UNKNOWNS: usize = 18;

/// A prismatic body, held at some nodes all along.
pub struct Prism<'m> {
    pub(super) mesh: &'m Mesh,
    pub(super) material: Elastic,
    equation: Vec<[u32; 3]>,
    pattern: StiffnessPattern,
}

/// A [`Prism`] factored for one wave number.
pub struct Wave<'p> {
    prism: &'p Prism<'p>,
    factor: Factor,
}

impl<'m> Prism<'m> {
    /// The prism over `mesh`, the nodes `fixed` held in all directions.
    ///
    /// # Errors
    /// [`FemError`] if the mesh is too large.
    pub fn new(mesh: &'m Mesh, material: Elastic, fixed: &[u32]) -> Result<Self, FemError> {
        let mut free = vec![true; mesh.points.len()];
        fixed.iter().for_each(|&node| free[node as usize] = false);
        let order = elimination_order(&mesh.cells, &free, &[])?;
        let mut equation = vec![[FIXED; 3]; mesh.points.len()];
        for (place, &node) in order.iter().enumerate() {
            let first = 3 * place as u32;
            equation[node as usize] = [first, first + 1, first + 2];
        }
        let pattern = StiffnessPattern::new(&mesh.cells, &equation, 3 * order.len());
        Ok(Self {
            mesh,
            material,
            equation,
            pattern,
        })
    }

    /// Nodes of the section.
    pub fn nodes(&self) -> usize {
        self.mesh.points.len()
    }

    /// Whether a node is held.
    pub(super) fn is_held(&self, node: usize) -> bool {
        self.equation[node][0] == FIXED
    }

    /// Factors the stiffness for `wave_number`, 1/mm.
    ///
    /// # Errors
    /// [`FemError`] if an element is turned over or the body is not held.
    pub fn wave(&self, wave_number: f64) -> Result<Wave<'_>, FemError> {
        let mut stiffness = Vec::new();
        self.pattern
            .fill(self.mesh, &mut stiffness, |element, number| {
                element_stiffness(element, self.material, wave_number, number)
            })?;
        let mut factor = Factor::analyse(&self.pattern)?;
        factor
            .factor(&self.pattern, &stiffness)
            .map_err(|BadPivot { column, ratio }| {
                let holds = |numbers: &[u32; 3]| numbers.contains(&(column as u32));
                let node = self.equation.iter().position(holds).unwrap_or(0) as u32;
                FemError::NotPositiveDefinite { node, ratio }
            })?;
        Ok(Wave {
            prism: self,
            factor,
        })
    }
}

impl Wave<'_> {
    /// Amplitudes of the displacement in the plane, mm, at `nodes` under nodal loads, amplitudes in N per mm of width.
    pub fn solve(&self, loads: &[(u32, Vec2)], nodes: &[u32]) -> Vec<Vec2> {
        let equation = &self.prism.equation;
        let mut values = vec![0.0; self.prism.pattern.column_start.len() - 1];
        for (node, load) in loads {
            for (axis, &number) in equation[*node as usize][..2].iter().enumerate() {
                if number != FIXED {
                    values[number as usize] += load[axis];
                }
            }
        }
        self.factor.solve(&mut values);
        let moved = |&node: &u32| {
            let [x, y, _] = self.amplitudes(&values, node as usize);
            Vec2::new(x, y)
        };
        nodes.iter().map(moved).collect()
    }

    /// Amplitudes of all three displacements, mm, at all nodes under nodal loads in all three directions, amplitudes in N per mm of width.
    pub fn field(&self, loads: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let equation = &self.prism.equation;
        let mut values = vec![0.0; self.prism.pattern.column_start.len() - 1];
        for (load, numbers) in loads.iter().zip(equation) {
            for (load, &number) in load.iter().zip(numbers) {
                if number != FIXED {
                    values[number as usize] += load;
                }
            }
        }
        self.factor.solve(&mut values);
        (0..equation.len())
            .map(|node| self.amplitudes(&values, node))
            .collect()
    }

    /// Of one node in a solution.
    fn amplitudes(&self, values: &[f64], node: usize) -> [f64; 3] {
        self.prism.equation[node].map(|number| match number {
            FIXED => 0.0,
            number => values[number as usize],
        })
    }
}

/// Stiffness of a triangle per mm of width; row and column 3 a + d for node a, direction d. `number` only labels an error.
fn element_stiffness(
    element: &Element,
    material: Elastic,
    wave_number: f64,
    number: usize,
) -> Result<[[f64; UNKNOWNS]; UNKNOWNS], FemError> {
    let (lambda, mu) = lame_constants(material);
    let mut k = [[0.0; UNKNOWNS]; UNKNOWNS];
    let n = element.len;
    // products of the shape functions themselves are of the fourth degree
    for point in &TRIANGLE_7 {
        let at = element.upright_at(point, number)?;
        let weight = point.weight * at.jacobian;
        for a in 0..n {
            let (ga, na) = (at.gradient[a], wave_number * at.value[a]);
            for b in 0..n {
                let (gb, nb) = (at.gradient[b], wave_number * at.value[b]);
                let dot = mu * (ga.x * gb.x + ga.y * gb.y);
                let in_plane = dot + mu * na * nb;
                let entries = [
                    [
                        (lambda + mu) * ga.x * gb.x + in_plane,
                        lambda * ga.x * gb.y + mu * ga.y * gb.x,
                        lambda * ga.x * nb - mu * na * gb.x,
                    ],
                    [
                        lambda * ga.y * gb.x + mu * ga.x * gb.y,
                        (lambda + mu) * ga.y * gb.y + in_plane,
                        lambda * ga.y * nb - mu * na * gb.y,
                    ],
                    [
                        lambda * na * gb.x - mu * ga.x * nb,
                        lambda * na * gb.y - mu * ga.y * nb,
                        dot + (lambda + 2.0 * mu) * na * nb,
                    ],
                ];
                for (d, row) in entries.iter().enumerate() {
                    for (e, entry) in row.iter().enumerate() {
                        k[3 * a + d][3 * b + e] += weight * entry;
                    }
                }
            }
        }
    }
    Ok(k)
}
