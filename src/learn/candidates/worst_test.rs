//! The test that the base model misses most: it alone tells the starts of a candidate that lead nowhere, at the price of one test.

use nalgebra::{DMatrix, DVector};

use crate::learn::candidates::likelihood::Likelihood;

/// The fit test whose residual of the base model is largest beside what its own k can take up.
pub(in crate::learn) struct WorstTest {
    /// Its place among the tests of the likelihood.
    place: usize,
    /// The direction of its ln k in the whitened rows, of length 1; 0 where k does nothing.
    coefficient: DVector<f64>,
    /// The whitened residual of its rows beside that, 0 in all others.
    pub(in crate::learn) residual: DVector<f64>,
}

impl WorstTest {
    /// For a base model with the values `model` and the whitened derivatives of its rows with respect to (θ, ln k_t).
    pub(in crate::learn) fn new(
        likelihood: &Likelihood<'_>,
        model: &[f64],
        whitened: &DMatrix<f64>,
    ) -> Self {
        let tests = likelihood.tests.len();
        let residual = likelihood.residual(model);
        let of_test = |place: usize| {
            let derivative = whitened.column(whitened.ncols() - tests + place);
            let length = derivative.norm();
            let coefficient = if length > 0.0 {
                derivative / length
            } else {
                derivative.into_owned()
            };
            let mut test = Self {
                place,
                coefficient,
                residual: DVector::zeros(0),
            };
            let own: Vec<f64> = likelihood.rows[place]
                .iter()
                .map(|&r| residual[r])
                .collect();
            test.residual = test.whitened(likelihood, &own);
            test
        };
        (0..tests)
            .map(of_test)
            .max_by(|a, b| a.residual.norm().total_cmp(&b.residual.norm()))
            .expect("a likelihood has tests")
    }

    /// Its place among the tests of the likelihood.
    pub(in crate::learn) fn place(&self) -> usize {
        self.place
    }

    /// What of a change from `before` (values of all rows) to `values` (of its own rows) its k cannot make, wear brought to the measured size first.
    pub(in crate::learn) fn visible(
        &self,
        likelihood: &Likelihood<'_>,
        before: &[f64],
        values: &[f64],
    ) -> DVector<f64> {
        let rows = &likelihood.rows[self.place];
        let scaled = likelihood.rescaled(&self.spread(likelihood, values));
        let change: Vec<f64> = rows.iter().map(|&r| scaled[r] - before[r]).collect();
        self.whitened(likelihood, &change)
    }

    /// The factor that brings its wear to the size of what was measured.
    pub(in crate::learn) fn wear_scale(&self, likelihood: &Likelihood<'_>, values: &[f64]) -> f64 {
        likelihood.wear_scale(&self.spread(likelihood, values))
    }

    /// Its values among those of all rows, of which the others are 0.
    fn spread(&self, likelihood: &Likelihood<'_>, values: &[f64]) -> Vec<f64> {
        let mut all = vec![0.0; likelihood.len()];
        for (&row, value) in likelihood.rows[self.place].iter().zip(values) {
            all[row] = *value;
        }
        all
    }

    fn whitened(&self, likelihood: &Likelihood<'_>, values: &[f64]) -> DVector<f64> {
        let all = self.spread(likelihood, values);
        let white = DVector::from_vec(likelihood.covariance.whiten(&all));
        let along = self.coefficient.dot(&white);
        white - &self.coefficient * along
    }
}
