//! One member: its stiffness, factored once, ready for loads and for condensation.

use faer::Par;

use super::assemble::{FIXED, StiffnessPattern, element_stiffness, internal_forces};
use super::cholesky::{BadPivot, Factor};
use super::compliance::Compliance;
use super::dirichlet::{Axis, check_support, fixed_flags, number_equations};
use super::ordering::elimination_order;
use super::triangle::{element_count, nodes_of};
use super::{FemError, RESIDUAL_LIMIT};
use crate::material::Elastic;
use crate::mesh::Mesh;
use crate::numeric::Vec2;

/// A supported elastic body with its factored stiffness.
#[derive(Debug)]
pub struct Body {
    mesh: Mesh,
    material: Elastic,
    fixed: Vec<[bool; 2]>,
    interface: Vec<u32>,
    equation: Vec<[u32; 2]>,
    pattern: StiffnessPattern,
    stiffness: Vec<f64>,
    factor: Factor,
}

/// Displacements and how well they satisfy the equations.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// Displacement of every node, mm.
    pub displacement: Vec<Vec2>,
    /// ‖K u − f‖ / ‖f‖ over the free unknowns; 0 without load.
    pub residual: f64,
}

impl Body {
    /// Analyses and factors the stiffness of `mesh` with the nodes `fixed` held in both directions.
    ///
    /// `interface` names the nodes whose compliance is wanted; they are eliminated last, in the order given.
    pub fn new(
        mesh: &Mesh,
        material: Elastic,
        fixed: &[u32],
        interface: &[u32],
    ) -> Result<Body, FemError> {
        let fixed: Vec<_> = fixed
            .iter()
            .flat_map(|&node| [(node, Axis::X), (node, Axis::Y)])
            .collect();
        Body::with_fixed_dofs(mesh, material, &fixed, interface)
    }

    /// As [`Body::new`], with single directions held (symmetry lines).
    pub fn with_fixed_dofs(
        mesh: &Mesh,
        material: Elastic,
        fixed: &[(u32, Axis)],
        interface: &[u32],
    ) -> Result<Body, FemError> {
        check_input(mesh, material)?;
        let fixed = fixed_flags(mesh.points.len(), fixed)?;
        check_interface(interface, mesh.points.len())?;
        check_support(mesh, &fixed)?;
        let keep: Vec<bool> = fixed.iter().map(|flags| *flags != [true; 2]).collect();
        let order = elimination_order(&mesh.cells, &keep, interface)?;
        let (equation, unknowns) = number_equations(&order, &fixed);
        let pattern = StiffnessPattern::new(&mesh.cells, &equation, unknowns);
        let factor = Factor::analyse(&pattern)?;
        let mut body = Body {
            mesh: mesh.clone(),
            material,
            fixed,
            interface: interface.to_vec(),
            equation,
            pattern,
            stiffness: Vec::new(),
            factor,
        };
        body.refill()?;
        Ok(body)
    }

    /// Factors again for the same triangles with moved nodes; order, pattern and symbolic factor are reused.
    ///
    /// After an error the body keeps no usable factor: repeat with a sound mesh before solving.
    pub fn refactor(&mut self, mesh: &Mesh) -> Result<(), FemError> {
        if mesh.cells != self.mesh.cells || mesh.points.len() != self.mesh.points.len() {
            return Err(FemError::TopologyChanged);
        }
        check_input(mesh, self.material)?;
        check_support(mesh, &self.fixed)?;
        self.mesh.points.clone_from(&mesh.points);
        self.refill()
    }

    /// Displacements of all nodes under nodal loads, N per mm of width; loads on one node add up, loads on fixed
    /// directions go into the support.
    pub fn solve(&self, loads: &[(u32, Vec2)]) -> Result<Vec<Vec2>, FemError> {
        Ok(self.solve_with(loads, &[])?.displacement)
    }

    /// As [`Body::solve`], with given displacements (mm) in fixed directions, and the residual reported.
    pub fn solve_with(
        &self,
        loads: &[(u32, Vec2)],
        prescribed: &[(u32, Axis, f64)],
    ) -> Result<Solution, FemError> {
        let mut displacement = self.prescribed_field(prescribed)?;
        let mut force = vec![0.0; self.dof_count()];
        self.add(&mut force, loads)?;
        if !prescribed.is_empty() {
            let reaction = internal_forces(&self.mesh, self.material, &displacement)?;
            for (numbers, r) in self.equation.iter().zip(&reaction) {
                subtract(&mut force, numbers, r);
            }
        }
        let (x, residual) = self.solve_free(&force)?;
        for (numbers, u) in self.equation.iter().zip(&mut displacement) {
            for axis in 0..2 {
                if numbers[axis] != FIXED {
                    u[axis] = x[numbers[axis] as usize];
                }
            }
        }
        Ok(Solution {
            displacement,
            residual,
        })
    }

    /// Condenses the body onto its interface, on the calling thread.
    pub fn compliance(&self) -> Compliance {
        self.compliance_on(Par::Seq)
    }

    /// As [`Body::compliance`]; the dense inverse may use several threads. The last digits may depend on their number.
    pub fn compliance_on(&self, parallelism: Par) -> Compliance {
        let mut place = Vec::with_capacity(2 * self.interface.len());
        for (k, &node) in self.interface.iter().enumerate() {
            for axis in 0..2 {
                if self.equation[node as usize][axis] != FIXED {
                    place.push(2 * k + axis);
                }
            }
        }
        let block = self.factor.trailing_block(place.len());
        Compliance::from_factor(self.interface.clone(), &place, &block, parallelism)
    }

    /// Number of free unknowns.
    pub fn dof_count(&self) -> usize {
        self.pattern.column_start.len() - 1
    }

    /// Number of stored values of the Cholesky factor: a measure of fill.
    pub fn factor_len(&self) -> usize {
        self.factor.len()
    }

    /// Additions and multiplications that one numerical factorisation takes.
    pub fn factor_operations(&self) -> f64 {
        self.factor.operations()
    }

    /// The mesh as last factored.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The material.
    pub fn material(&self) -> Elastic {
        self.material
    }

    /// Interface nodes in the order of the compliance.
    pub fn interface(&self) -> &[u32] {
        &self.interface
    }

    fn refill(&mut self) -> Result<(), FemError> {
        let material = self.material;
        self.pattern
            .fill(&self.mesh, &mut self.stiffness, |element, number| {
                element_stiffness(element, material, number)
            })?;
        self.factor
            .factor(&self.pattern, &self.stiffness)
            .map_err(|BadPivot { column, ratio }| {
                let holds = |numbers: &[u32; 2]| numbers.contains(&(column as u32));
                let node = self.equation.iter().position(holds).unwrap_or(0) as u32;
                FemError::NotPositiveDefinite { node, ratio }
            })
    }

    fn solve_free(&self, force: &[f64]) -> Result<(Vec<f64>, f64), FemError> {
        let scale = norm(force);
        if scale == 0.0 {
            return Ok((vec![0.0; force.len()], 0.0));
        }
        let mut x = force.to_vec();
        self.factor.solve(&mut x);
        let mut rest = self.residual(&x, force);
        if norm(&rest) > 0.01 * RESIDUAL_LIMIT * scale {
            self.factor.solve(&mut rest);
            x.iter_mut().zip(&rest).for_each(|(x, r)| *x += r);
            rest = self.residual(&x, force);
        }
        let residual = norm(&rest) / scale;
        if residual <= RESIDUAL_LIMIT {
            return Ok((x, residual));
        }
        let limit = RESIDUAL_LIMIT.max(8.0 * f64::EPSILON * self.cancellation(&x) / scale);
        if residual.is_nan() || residual > limit {
            return Err(FemError::Residual { residual, limit });
        }
        Ok((x, residual))
    }

    fn residual(&self, x: &[f64], force: &[f64]) -> Vec<f64> {
        let product = self.pattern.multiply(&self.stiffness, x);
        force.iter().zip(&product).map(|(f, p)| f - p).collect()
    }

    /// ‖ |K| |x| ‖: rounding of K x alone leaves a residual of some epsilon times this, however good x is. It passes the
    /// limit only for very soft or nearly incompressible bodies.
    fn cancellation(&self, x: &[f64]) -> f64 {
        let stiffness: Vec<f64> = self.stiffness.iter().map(|k| k.abs()).collect();
        let x: Vec<f64> = x.iter().map(|x| x.abs()).collect();
        norm(&self.pattern.multiply(&stiffness, &x))
    }

    fn add(&self, force: &mut [f64], loads: &[(u32, Vec2)]) -> Result<(), FemError> {
        for &(node, load) in loads {
            if !(load.x.is_finite() && load.y.is_finite()) {
                return Err(FemError::NotFinite {
                    what: "the load",
                    node,
                    value: load,
                });
            }
            let count = self.equation.len();
            let numbers = self
                .equation
                .get(node as usize)
                .ok_or(FemError::UnknownNode {
                    what: "a load",
                    node,
                    count,
                })?;
            subtract(force, numbers, &-load);
        }
        Ok(())
    }

    fn prescribed_field(&self, prescribed: &[(u32, Axis, f64)]) -> Result<Vec<Vec2>, FemError> {
        let mut field = vec![Vec2::zeros(); self.equation.len()];
        for &(node, axis, value) in prescribed {
            let count = field.len();
            let unknown = FemError::UnknownNode {
                what: "a prescribed displacement",
                node,
                count,
            };
            let u = field.get_mut(node as usize).ok_or(unknown)?;
            u[axis.index()] = value;
            if !value.is_finite() {
                return Err(FemError::NotFinite {
                    what: "the prescribed displacement",
                    node,
                    value: *u,
                });
            }
            if !self.fixed[node as usize][axis.index()] {
                return Err(FemError::PrescribedFree { node, axis });
            }
        }
        Ok(field)
    }
}

fn subtract(force: &mut [f64], numbers: &[u32; 2], value: &Vec2) {
    for axis in 0..2 {
        if numbers[axis] != FIXED {
            force[numbers[axis] as usize] -= value[axis];
        }
    }
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum::<f64>().sqrt()
}

fn check_input(mesh: &Mesh, material: Elastic) -> Result<(), FemError> {
    let Elastic {
        youngs_modulus,
        poisson_ratio,
    } = material;
    let sound = youngs_modulus > 0.0
        && youngs_modulus.is_finite()
        && poisson_ratio > -1.0
        && poisson_ratio < 0.5;
    if !sound {
        return Err(FemError::Material {
            youngs_modulus,
            poisson_ratio,
        });
    }
    let elements = element_count(&mesh.cells);
    if elements == 0 {
        return Err(FemError::Empty);
    }
    for (node, point) in mesh.points.iter().enumerate() {
        if !(point.x.is_finite() && point.y.is_finite()) {
            return Err(FemError::NotFinite {
                what: "the position",
                node: node as u32,
                value: *point,
            });
        }
    }
    let count = mesh.points.len();
    for index in 0..elements {
        let (len, nodes) = nodes_of(&mesh.cells, index);
        if let Some(&node) = nodes[..len].iter().find(|&&node| node as usize >= count) {
            return Err(FemError::UnknownNode {
                what: "a triangle",
                node,
                count,
            });
        }
    }
    Ok(())
}

fn check_interface(interface: &[u32], count: usize) -> Result<(), FemError> {
    let mut seen = vec![false; count];
    for &node in interface {
        let unknown = FemError::UnknownNode {
            what: "the interface",
            node,
            count,
        };
        let seen = seen.get_mut(node as usize).ok_or(unknown)?;
        if std::mem::replace(seen, true) {
            return Err(FemError::RepeatedInterfaceNode { node });
        }
    }
    Ok(())
}
