//! What a fit found: parameters, wear coefficients, datums and predictions, and how well they are known.

use nalgebra::DMatrix;

use crate::learn::hypothesis::parameters::Estimate;
use crate::learn::noise::Datum;
use crate::study::Role;

/// What a fit found.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The free parameters: the wear coefficient first, if it is free, then the effects'.
    pub parameters: Vec<Estimate>,
    /// Their covariance on natural scales, the scatter of k integrated out.
    pub covariance: DMatrix<f64>,
    /// The common wear coefficient, mm²/N.
    pub coefficient: f64,
    /// Most probable scatter of k between tests, relative.
    pub scatter: f64,
    /// Where 16 and 84 % of its posterior lie.
    pub scatter_interval: [f64; 2],
    /// Every test that has observations; held-out ones once they have been judged.
    pub tests: Vec<TestFit>,
    /// Every trace's most probable datum.
    pub datums: Vec<Datum>,
    /// Per observation of the data set.
    pub rows: Vec<RowFit>,
    /// Logarithm of the posterior density on natural scales, datums marginalised, without its normalising constant.
    pub log_posterior: f64,
    /// Logarithm of the marginal likelihood of the fit tests: parameters, k per test, datums and scatter integrated out.
    pub log_evidence: f64,
    /// How much of it the derivatives only promise: what a step to the top of their parabola would gain.
    pub promised: f64,
    /// Whether a further step would gain nothing.
    pub converged: bool,
    /// Steps.
    pub iterations: usize,
    /// Predictions of single tests.
    pub evaluations: usize,
}

impl Fit {
    /// Whether it converged with no parameter on a bound.
    pub fn is_settled(&self) -> bool {
        self.converged && self.parameters.iter().all(|p| !p.at_bound)
    }

    /// Logarithm of the marginal likelihood without what the derivatives only promise: by it fits from several starts are compared.
    pub fn attained_evidence(&self) -> f64 {
        self.log_evidence - self.promised
    }

    /// Whether it says something of a test: it was fitted to it, or has judged it as a held-out one. The rows of others are zeros.
    pub fn judges(&self, test: usize) -> bool {
        self.tests.iter().any(|known| known.test == test)
    }
}

/// One test in a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct TestFit {
    /// Its number in the data set.
    pub test: usize,
    /// Its role.
    pub role: Role,
    /// Its own wear coefficient, mm²/N.
    pub coefficient: f64,
    /// Standard deviation of that coefficient's logarithm.
    pub sigma: f64,
    /// ε: the logarithm of its coefficient over the common one.
    pub deviation: f64,
    /// Derivatives of the test's predictions, and the covariance of what they are taken by.
    pub uncertainty: PredictionUncertainty,
}

/// How a test's predictions change with what was fitted, and how well that is known.
#[derive(Debug, Clone, PartialEq)]
pub struct PredictionUncertainty {
    /// Observations of the data set, per row.
    pub rows: Vec<usize>,
    /// Derivatives with respect to (effect parameters on natural scales, ln k of the test).
    pub derivatives: DMatrix<f64>,
    /// Covariance of those.
    pub covariance: DMatrix<f64>,
}

impl PredictionUncertainty {
    /// Standard deviation of a weighted sum of the test's predictions; `weights` by observation.
    pub fn of_sum(&self, weight: impl Fn(usize) -> f64) -> f64 {
        let mut change = nalgebra::RowDVector::zeros(self.derivatives.ncols());
        for (i, &row) in self.rows.iter().enumerate() {
            change += self.derivatives.row(i) * weight(row);
        }
        (&change * &self.covariance * change.transpose())[(0, 0)]
            .max(0.0)
            .sqrt()
    }

    /// Mean variance of the test's predictions for some observations; 0 without any.
    pub fn mean_square(&self, is_asked: impl Fn(usize) -> bool) -> f64 {
        let asked = (self.rows.iter().enumerate()).filter(|(_, row)| is_asked(**row));
        let variance = |i: usize| {
            let change = self.derivatives.row(i);
            (change * &self.covariance * change.transpose())[(0, 0)].max(0.0)
        };
        let (n, sum) = asked.fold((0, 0.0), |(n, sum), (i, _)| (n + 1, sum + variance(i)));
        sum / f64::from(n.max(1))
    }
}

/// One observation in a fit, in the unit of its quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowFit {
    /// What the model says.
    pub model: f64,
    /// What the most probable datum, tilt and shift of its trace make here, 0 without one.
    pub datum: f64,
    /// Model minus (measured minus datum).
    pub residual: f64,
    /// The residual over the row's sigma.
    pub standardised: f64,
}
