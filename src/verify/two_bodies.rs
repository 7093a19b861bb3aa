//! Two elastic bodies (or one and a rigid one) in frictionless contact along a common normal, by the product's mortar
//! coupling and unilateral contact on condensed finite elements.
//!
//! ```text
//! r = g + D₁ u₁·n − D₀ u₀·n + W λ − φ L ≥ 0        W = Σ D (nᵀ C n) Dᵀ
//! ```
//! n points from body 0 into body 1; u are displacements by other loads; body 1 moves as a whole by −φ n. Loads of free
//! bodies balance the contact load, so the reaction of a statically determinate support vanishes.

use nalgebra::DMatrix;

use crate::contact::mortar::{Coupling, Facing, Trace, couple};
use crate::contact::unilateral::{Drive, Problem, Solution, solve};
use crate::fem::{Axis, Body, Compliance};
use crate::material::Elastic;
use crate::mesh::Mesh;
use crate::numeric::sparse::SparseRows;
use crate::numeric::{Vec2, rotate};
use crate::verify::CaseError;

/// One elastic body, condensed onto its surface.
#[derive(Debug)]
pub struct ElasticSide {
    body: Body,
    compliance: Compliance,
    surface: Vec<u32>,
    arc: Vec<f64>,
    order: usize,
    /// Rotation of the body's frame in the fixed frame, rad.
    turn: f64,
    loads: Vec<(u32, Vec2)>,
    prescribed: Vec<(u32, Axis, f64)>,
    /// Displacement of all nodes by loads other than contact, body frame, mm.
    other: Vec<Vec2>,
}

/// What [`ElasticSide::new`] needs to know of a surface.
#[derive(Debug, Clone, Copy)]
pub struct Surface<'a> {
    /// Nodes by ascending arc coordinate.
    pub nodes: &'a [u32],
    /// Arc coordinates, mm.
    pub arc: &'a [f64],
    /// 2 for quadratic edges, 1 for linear.
    pub order: usize,
}

impl ElasticSide {
    /// Condenses the body; `turn` (rad) is the rotation of its frame in the fixed frame.
    ///
    /// # Errors
    /// [`CaseError::Elasticity`] if the mesh or its supports are refused.
    pub fn new(
        mesh: &Mesh,
        material: Elastic,
        fixed: &[(u32, Axis)],
        surface: Surface,
        turn: f64,
    ) -> Result<Self, CaseError> {
        let body = Body::with_fixed_dofs(mesh, material, fixed, surface.nodes)?;
        let compliance = body.compliance();
        let other = vec![Vec2::zeros(); mesh.points.len()];
        Ok(Self {
            body,
            compliance,
            surface: surface.nodes.to_vec(),
            arc: surface.arc.to_vec(),
            order: surface.order,
            turn,
            loads: Vec::new(),
            prescribed: Vec::new(),
            other,
        })
    }

    /// Adds loads (N/mm) and displacements of supports (mm) that act besides the contact, in the body's frame.
    ///
    /// # Errors
    /// [`CaseError::Elasticity`] if they are refused.
    pub fn with_loads(
        mut self,
        loads: Vec<(u32, Vec2)>,
        prescribed: Vec<(u32, Axis, f64)>,
    ) -> Result<Self, CaseError> {
        self.other = self.body.solve_with(&loads, &prescribed)?.displacement;
        self.loads = loads;
        self.prescribed = prescribed;
        Ok(self)
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh {
        self.body.mesh()
    }

    /// The material.
    pub fn material(&self) -> Elastic {
        self.body.material()
    }

    fn trace(&self, side: usize) -> Trace<'_> {
        Trace {
            side,
            arc: &self.arc,
            order: self.order,
        }
    }

    /// nᵀ C n by surface node.
    fn along(&self, normal: Vec2) -> DMatrix<f64> {
        let n = self.surface.len();
        let mut out = DMatrix::zeros(n, n);
        for j in 0..n {
            let (x, y) = (
                self.compliance.column(2 * j),
                self.compliance.column(2 * j + 1),
            );
            for i in 0..n {
                out[(i, j)] = normal.x * (x[2 * i] * normal.x + y[2 * i] * normal.y)
                    + normal.y * (x[2 * i + 1] * normal.x + y[2 * i + 1] * normal.y);
            }
        }
        out
    }
}

/// Two bodies face to face.
#[derive(Debug)]
pub struct TwoBodies {
    /// The bodies: 0 behind the contact plane, 1 in front of it; `None` is rigid.
    pub sides: [Option<ElasticSide>; 2],
    /// Multiplier grid along the tangent, mm.
    pub xi: Vec<f64>,
    /// Weighted compliance, mm³/N.
    pub w: DMatrix<f64>,
    /// Weighted gap with the displacements by other loads, mm².
    pub gap: Vec<f64>,
    /// Integrals of the hats; traces of the elastic sides in order.
    pub coupling: Coupling,
    normal: Vec2,
}

impl TwoBodies {
    /// Couples the bodies along `normal` (fixed frame, from body 0 into body 1) on the grid `xi`.
    pub fn new(
        sides: [Option<ElasticSide>; 2],
        xi: Vec<f64>,
        normal: Vec2,
        facing: impl Fn(f64) -> Facing,
    ) -> Self {
        let elastic = || {
            sides
                .iter()
                .enumerate()
                .filter_map(|(i, s)| s.as_ref().map(|s| (i, s)))
        };
        let traces: Vec<Trace> = elastic().map(|(i, s)| s.trace(i)).collect();
        let coupling = couple(&xi, facing, &traces);
        let mut w = DMatrix::zeros(xi.len(), xi.len());
        let mut gap = coupling.gap.clone();
        for ((i, side), rows) in elastic().zip(&coupling.traces) {
            let n = rotate(normal, -side.turn);
            add_projected(&mut w, rows, &side.along(n));
            let sign = if i == 1 { 1.0 } else { -1.0 };
            let moved: Vec<f64> = side
                .surface
                .iter()
                .map(|&k| sign * side.other[k as usize].dot(&n))
                .collect();
            gap.iter_mut()
                .enumerate()
                .for_each(|(k, g)| *g += rows.dot(k, &moved));
        }
        w.fill_lower_triangle_with_upper_triangle();
        Self {
            sides,
            xi,
            w,
            gap,
            coupling,
            normal,
        }
    }

    /// Weighted compliance for tractions and displacements along another direction of the fixed frame, mm³/N.
    pub fn compliance_along(&self, direction: Vec2) -> DMatrix<f64> {
        let mut w = DMatrix::zeros(self.xi.len(), self.xi.len());
        for (side, rows) in self.sides.iter().flatten().zip(&self.coupling.traces) {
            add_projected(&mut w, rows, &side.along(rotate(direction, -side.turn)));
        }
        w.fill_lower_triangle_with_upper_triangle();
        w
    }

    /// Solves the contact.
    ///
    /// # Errors
    /// [`CaseError::Contact`] if there is no solution.
    pub fn solve(&self, drive: Drive) -> Result<Solution, CaseError> {
        let length = &self.coupling.length;
        let problem = Problem {
            w: &self.w,
            gap: &self.gap,
            arm: length,
            lever: length,
            drive,
            symmetric: true,
        };
        Ok(solve(&problem, &[])?)
    }

    /// Displacement of all nodes of an elastic body in its own frame, mm; body 1 without the approach φ.
    ///
    /// # Errors
    /// [`CaseError::Elasticity`] if the linear solution fails, [`CaseError::Rigid`] if the body is rigid.
    pub fn displacement(&self, side: usize, solution: &Solution) -> Result<Vec<Vec2>, CaseError> {
        let body = self.sides[side].as_ref().ok_or(CaseError::Rigid { side })?;
        let rows = &self.coupling.traces[self.sides[..side].iter().flatten().count()];
        let sign = if side == 1 { 1.0 } else { -1.0 };
        let n = rotate(self.normal, -body.turn) * sign;
        let mut force = vec![0.0; body.surface.len()];
        solution
            .pressure
            .iter()
            .enumerate()
            .for_each(|(k, &p)| rows.scatter(k, p, &mut force));
        let mut loads: Vec<(u32, Vec2)> = body
            .surface
            .iter()
            .zip(force)
            .map(|(&k, f)| (k, n * f))
            .collect();
        loads.extend_from_slice(&body.loads);
        Ok(body.body.solve_with(&loads, &body.prescribed)?.displacement)
    }

    /// ∫ p dξ, N/mm.
    pub fn resultant(&self, pressure: &[f64]) -> f64 {
        pressure
            .iter()
            .zip(&self.coupling.length)
            .map(|(p, l)| p * l)
            .sum()
    }
}

/// Both directions of each node.
pub(crate) fn both(nodes: &[u32]) -> Vec<(u32, Axis)> {
    nodes
        .iter()
        .flat_map(|&n| [(n, Axis::X), (n, Axis::Y)])
        .collect()
}

/// w += D A Dᵀ.
fn add_projected(w: &mut DMatrix<f64>, rows: &SparseRows, a: &DMatrix<f64>) {
    for l in 0..rows.len() {
        let mut spread = vec![0.0; a.nrows()];
        let (columns, values) = rows.row(l);
        for (&c, &v) in columns.iter().zip(values) {
            spread
                .iter_mut()
                .zip(a.column(c as usize).iter())
                .for_each(|(s, x)| *s += v * x);
        }
        for k in 0..rows.len() {
            w[(k, l)] += rows.dot(k, &spread);
        }
    }
}
