//! How well a held-out test's own wear coefficient is known: the test does not move the parameters, but their errors move its coefficient.
//!
//! ```text
//! (ln k, θ) ~ N(·, Σ) by the fit tests;   ln k_t = ln k + ε_t,  ε_t ~ N(0, σ_k²)
//! ln k_t given (ln k, θ) and the test's data:  variance s² = σ_k²/(1 + g_kk σ_k²),
//!                                              moved by  −s² g_kθ  per θ,  by  1/(1 + g_kk σ_k²)  per ln k
//! m = those moves:   var ln k_t = s² + m Σ mᵀ,   cov((ln k, θ), ln k_t) = Σ mᵀ
//! ```
//! with g = J̃ᵀJ̃ of the test's whitened derivatives. Nothing degenerates as σ_k → 0: ln k_t is ln k then.

use nalgebra::{DMatrix, RowDVector};

/// What is known of the parameters of a model, and of one held-out test's derivatives.
pub(super) struct HeldOut<'a> {
    /// Covariance of (ln k, θ), or of θ alone where k is fixed.
    pub(super) known: &'a DMatrix<f64>,
    /// Number of θ.
    pub(super) params: usize,
    /// J̃ᵀJ̃ by (θ, ln k of the tests).
    pub(super) gram: &'a DMatrix<f64>,
    /// σ_k.
    pub(super) scatter: f64,
}

impl HeldOut<'_> {
    /// Covariance of (θ, ln k_t) of the test whose ln k_t is number `test`.
    pub(super) fn covariance(&self, test: usize) -> DMatrix<f64> {
        let params = self.params;
        let own = params + test;
        let square = self.scatter * self.scatter;
        let follows = 1.0 / (1.0 + square * self.gram[(own, own)]);
        let variance = square * follows;
        // ln k comes first in what is known, if it is free
        let first = self.known.nrows() - params;
        let mut moves = RowDVector::from_element(first + params, follows);
        for p in 0..params {
            moves[first + p] = -variance * self.gram[(own, p)];
        }
        let with_own = self.known * moves.transpose();
        let mut joint = DMatrix::zeros(params + 1, params + 1);
        for p in 0..params {
            for q in 0..params {
                joint[(p, q)] = self.known[(first + p, first + q)];
            }
            joint[(p, params)] = with_own[first + p];
            joint[(params, p)] = with_own[first + p];
        }
        joint[(params, params)] = variance + (&moves * &with_own)[(0, 0)];
        joint
    }
}
