//! Wear of a flat punch on an elastic half plane under constant load: the pressure evens out mode by mode.
//!
//! ```text
//! L p = −∫ ln|x − t| p(t) dt,   x and t in half widths a
//! (2/(π E*)) d(L p)/ds + k p = the same everywhere
//! modes  L φn = νn φn, ∫ φn = 0:   amplitude ~ exp(−µn s),  µn = π k E*/(2 a νn)
//! p(x, S) = p̄ + Σ φn (φn, p(0)) exp(−π S/(2 νn)),   S = k E* s/a,  p̄ = F'/(2a)
//! ```
//! From the contact condition "elastic displacement + worn depth = rigid approach" and dw = k p ds. The operator is cut into
//! equal panels of constant pressure (Galerkin), so eigenvalues converge from one side with the square of the panel width.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI};

use nalgebra::{DMatrix, DVector};

use super::half_plane;

/// First eigenvalues ν of the operator, odd and even in turn (ν1 is the tilt), as computed once with up to 1600 panels by an
/// independent boundary-element program.
pub const EIGENVALUES: [f64; 4] = [1.566_00, 0.909_73, 0.612_96, 0.473_94];

/// Pressure over mean pressure at x/a = 0, 0.5 and 0.9 against S = k E* s/a, from the same independent program (2/π is exact).
pub const HISTORY: [(f64, [f64; 3]); 6] = [
    (0.0, [FRAC_2_PI, 0.7351, 1.4605]),
    (0.1, [0.6895, 0.8073, 1.6754]),
    (0.2, [0.7293, 0.8565, 1.5901]),
    (0.5, [0.8204, 0.9455, 1.2791]),
    (1.0, [0.9141, 0.9929, 1.0931]),
    (2.0, [0.9831, 1.0008, 1.0145]),
];

/// Decay rate µn of a mode per mm of sliding: k mm²/N, E* MPa, half width mm.
pub fn decay_rate(eigenvalue: f64, k: f64, contact_modulus: f64, half_width: f64) -> f64 {
    PI * k * contact_modulus / (2.0 * half_width * eigenvalue)
}

/// The modes on a given number of panels.
#[derive(Debug, Clone)]
pub struct PunchWear {
    eigenvalues: Vec<f64>,
    modes: DMatrix<f64>,
    width: f64,
}

impl PunchWear {
    /// Solves the eigenproblem; the cost grows with the cube of `panels` (300 take a fraction of a second).
    pub fn new(panels: usize) -> Self {
        let width = 2.0 / panels as f64;
        // A contact modulus of 2/π turns the half plane's displacement into L.
        let unit = FRAC_2_PI;
        let row: Vec<f64> = (0..panels)
            .map(|j| half_plane::strip_influence(j as f64 * width, width, unit))
            .collect();
        let full = DMatrix::from_fn(panels, panels, |i, j| row[i.abs_diff(j)]);
        // Project onto pressures without resultant: subtract row and column means.
        let means: Vec<f64> = full.row_iter().map(|r| r.mean()).collect();
        let mean = means.iter().sum::<f64>() / panels as f64;
        let projected = DMatrix::from_fn(panels, panels, |i, j| {
            full[(i, j)] - means[i] - means[j] + mean
        });
        let eigen = projected.symmetric_eigen();
        let mut order: Vec<usize> = (0..panels).collect();
        order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
        // The last is the constant, with eigenvalue zero.
        order.pop();
        Self {
            eigenvalues: order.iter().map(|&i| eigen.eigenvalues[i]).collect(),
            modes: eigen.eigenvectors.select_columns(&order),
            width,
        }
    }

    /// Eigenvalues ν, largest first.
    pub fn eigenvalues(&self) -> &[f64] {
        &self.eigenvalues
    }

    /// Middles of the panels, x/a.
    pub fn positions(&self) -> Vec<f64> {
        (0..self.modes.nrows())
            .map(|i| -1.0 + (i as f64 + 0.5) * self.width)
            .collect()
    }

    /// Pressure over mean pressure on each panel at S = k E* s/a, from any initial pressure over mean pressure.
    pub fn history(&self, initial: &[f64], sliding: f64) -> Vec<f64> {
        let start = DVector::from_column_slice(initial);
        let mean = start.mean();
        let mut amplitude = self.modes.tr_mul(&start);
        for (a, nu) in amplitude.iter_mut().zip(&self.eigenvalues) {
            *a *= (-FRAC_PI_2 * sliding / nu).exp();
        }
        (&self.modes * amplitude).iter().map(|p| p + mean).collect()
    }

    /// Initial pressure over mean pressure of the flat punch, mean of each panel.
    pub fn flat_punch(&self) -> Vec<f64> {
        // Load 2 over a half width of 1 makes the mean pressure 1.
        self.positions()
            .iter()
            .map(|x| {
                let (from, to) = (x - self.width / 2.0, x + self.width / 2.0);
                half_plane::flat_punch_mean_pressure(from, to, 2.0, 1.0)
            })
            .collect()
    }
}
