//! Wear of two bodies whose same points stay in touch under constant sliding: the plane model problem of wear codes.
//!
//! ```text
//! dh/ds = k p(x, s)      r = g + W λ + G h − φ L ≥ 0,   λ ≥ 0,   λ·r = 0,   L·λ = F'
//! ```
//! Depth h and pressure p are piecewise linear on one grid, so the law holds at every point of it and the worn area grows
//! as k F' s exactly. Gap and opening come from the product's mortar integrals, pressures from its unilateral contact.

use nalgebra::DMatrix;

use crate::contact::mortar::{Coupling, Facing, Trace, couple};
use crate::contact::unilateral::{Drive, Problem, Solution, UnilateralError, sensitivity, solve};
use crate::numeric::patchy::{PatchyMatrix, Rows};
use crate::verify::CaseError;
use crate::wear::integrator::{Jacobian, Stand, StepControl, WearSystem, advance};

/// The default step tolerance of a simulation, relative to the largest depth.
pub const DEFAULT_TOLERANCE: f64 = 2e-3;

/// A contact that slides and wears; n of the integrator is the sliding distance, mm.
#[derive(Debug, Clone)]
pub struct SlidingContact {
    /// Grid of pressure and depth, mm.
    pub x: Vec<f64>,
    /// Weighted compliance, mm³/N.
    pub w: DMatrix<f64>,
    /// Weighted gap, lengths and the opening by worn depth.
    pub coupling: Coupling,
    /// Load per width F', N/mm.
    pub load: f64,
    /// Wear coefficient k (of both bodies together), mm²/N.
    pub coefficient: f64,
    /// Most active-set iterations of any contact problem so far.
    pub most_iterations: usize,
    /// Contact problems solved so far.
    pub solves: usize,
    last: Option<(Vec<f64>, Solution)>,
}

impl SlidingContact {
    /// A contact with the unworn gap `gap(x)` (mm) on the grid `x`, under the line load `load` with wear coefficient `k`.
    ///
    /// `compliance` gives the weighted compliance from the integrals of the hats.
    pub fn new(
        x: Vec<f64>,
        gap: impl Fn(f64) -> f64,
        compliance: impl FnOnce(&[f64], &Coupling) -> DMatrix<f64>,
        load: f64,
        k: f64,
    ) -> Self {
        let trace = Trace {
            side: 0,
            arc: &x,
            order: 1,
        };
        let coupling = couple(
            &x,
            |z| Facing {
                arc: [z, z],
                gap: gap(z),
            },
            &[trace],
        );
        let w = compliance(&x, &coupling);
        Self {
            x,
            w,
            coupling,
            load,
            coefficient: k,
            most_iterations: 0,
            solves: 0,
            last: None,
        }
    }

    /// The contact for the worn depths `u` (mm).
    ///
    /// # Errors
    /// [`UnilateralError`] if it has no solution.
    pub fn contact(&mut self, u: &[f64]) -> Result<&Solution, UnilateralError> {
        if self.last.as_ref().is_none_or(|(at, _)| at != u) {
            let gap = self.worn_gap(u);
            let start = self.last.take().map_or(Vec::new(), |(_, s)| s.active);
            let solution = solve(&self.problem(&gap), &start)?;
            self.most_iterations = self.most_iterations.max(solution.iterations);
            self.solves += 1;
            self.last = Some((u.to_vec(), solution));
        }
        Ok(&self.last.as_ref().expect("just filled").1)
    }

    /// Worn area ∫ h dx, mm².
    pub fn worn_area(&self, u: &[f64]) -> f64 {
        u.iter()
            .zip(&self.coupling.length)
            .map(|(h, l)| h * l)
            .sum()
    }

    /// ∂(rate)/∂u on the active set (rows and columns as `active`) and the set itself.
    ///
    /// # Errors
    /// [`UnilateralError`] if the contact has no solution.
    pub fn relaxation(&mut self, u: &[f64]) -> Result<(Vec<usize>, DMatrix<f64>), UnilateralError> {
        let active = self.contact(u)?.active.clone();
        let s = sensitivity(&self.problem(&self.coupling.gap), &active)?;
        Ok((active, s * -self.coefficient))
    }

    fn worn_gap(&self, u: &[f64]) -> Vec<f64> {
        let opening = &self.coupling.traces[0];
        self.coupling
            .gap
            .iter()
            .enumerate()
            .map(|(k, g)| g + opening.dot(k, u))
            .collect()
    }

    fn problem<'a>(&'a self, gap: &'a [f64]) -> Problem<'a> {
        Problem {
            w: &self.w,
            gap,
            arm: &self.coupling.length,
            lever: &self.coupling.length,
            drive: Drive::Load(self.load),
            symmetric: true,
        }
    }
}

impl WearSystem for SlidingContact {
    type Error = UnilateralError;

    fn rate(&mut self, _: f64, u: &[f64]) -> Result<Vec<f64>, UnilateralError> {
        let k = self.coefficient;
        Ok(self.contact(u)?.pressure.iter().map(|p| k * p).collect())
    }

    fn jacobian(&mut self, _: f64, u: &[f64]) -> Result<Option<Jacobian>, UnilateralError> {
        let (active, s) = self.relaxation(u)?;
        let mut jacobian = PatchyMatrix::new(u.len());
        let mut column = vec![0.0; u.len()];
        let rows = Rows::new(active.iter().map(|&k| k..k + 1));
        for (j, &l) in active.iter().enumerate() {
            for (i, &k) in active.iter().enumerate() {
                column[k] = s[(i, j)];
            }
            let (columns, values) = self.coupling.traces[0].row(l);
            for (&c, &v) in columns.iter().zip(values) {
                jacobian.add(c as usize, &rows, v, &column);
            }
        }
        Ok(Some(Jacobian::Full(jacobian)))
    }
}

/// What a wear history shows at one sliding distance.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// Sliding distance, mm.
    pub s: f64,
    /// Worn depth at the grid, mm.
    pub depth: Vec<f64>,
    /// Pressure at the grid, MPa.
    pub pressure: Vec<f64>,
    /// Active nodes.
    pub active: Vec<usize>,
    /// Accepted steps so far.
    pub steps: usize,
}

/// Wears `system` from fresh surfaces, stopping at the distances `stops` (ascending, mm).
///
/// As in a simulation, depths below `floor` (mm) are held to `tolerance`·`floor`, and the first step wears a tenth of it.
///
/// # Errors
/// [`CaseError`] if contact or step control fails.
pub fn history(
    system: &mut SlidingContact,
    stops: &[f64],
    tolerance: f64,
    floor: f64,
) -> Result<Vec<Snapshot>, CaseError> {
    let fresh = vec![0.0; system.x.len()];
    let fastest = system
        .rate(0.0, &fresh)?
        .into_iter()
        .fold(f64::MIN_POSITIVE, f64::max);
    let first_step = 0.1 * floor / fastest;
    let control = StepControl {
        ceiling: f64::INFINITY,
        tolerance,
        floor,
        first_step,
        hesitates: false,
        least_growth: 1e-10 * floor,
    };
    let mut stand = Stand::new(fresh, control);
    let mut out = Vec::new();
    for &stop in stops {
        while stand.n < stop {
            advance(system, &mut stand, stop, control)?;
        }
        let contact = system.contact(&stand.u)?;
        out.push(Snapshot {
            s: stand.n,
            pressure: contact.pressure.clone(),
            active: contact.active.clone(),
            depth: stand.u.clone(),
            steps: stand.accepted,
        });
    }
    Ok(out)
}

/// `count + 1` equally spaced nodes from `low` to `high`, mm.
pub fn even_grid(low: f64, high: f64, count: usize) -> Vec<f64> {
    (0..=count)
        .map(|i| low + (high - low) * i as f64 / count as f64)
        .collect()
}

/// Piecewise linear value at `at` of nodal values `y` on `x`.
pub fn value_at(x: &[f64], y: &[f64], at: f64) -> f64 {
    let next = x.partition_point(|&v| v <= at).clamp(1, x.len() - 1);
    let t = (at - x[next - 1]) / (x[next] - x[next - 1]);
    y[next - 1] + t * (y[next] - y[next - 1])
}

/// Half the width over which the pressure is positive, to the middle of the end elements, mm.
pub fn half_width(x: &[f64], active: &[usize]) -> f64 {
    let (first, last) = (active[0], active[active.len() - 1]);
    let low = 0.5 * (x[first] + x[first.saturating_sub(1)]);
    let high = 0.5 * (x[last] + x[(last + 1).min(x.len() - 1)]);
    0.5 * (high - low)
}
