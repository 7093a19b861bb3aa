//! The test that the base model misses most, by itself: an effect that explains what is missing shows there, at the price of one test.

use nalgebra::{DMatrix, DVector};

use super::context::Context;
use crate::learn::candidates::candidate_model::{Anchored, prediction_of_test};
use crate::learn::candidates::fitted_candidate::{BaseFit, orthonormalise};
use crate::learn::hypothesis::candidate::Candidate;

/// What the base model misses in one test.
pub(super) struct MostMissed {
    /// The test, by its place in the likelihood.
    test: usize,
    /// Orthonormal columns: changes of the test by which its k and the base model's own parameters adjust.
    adjustable: DMatrix<f64>,
    /// Whitened residual of the test.
    pub(super) residual: DVector<f64>,
    /// Its part of what all tests are missed by beyond their noise.
    pub(super) share: f64,
}

impl MostMissed {
    /// None where no test is missed by more than its noise, or there is but one.
    pub(super) fn of(context: &Context<'_>, base: &BaseFit) -> Option<Self> {
        let likelihood = &context.likelihood;
        let (test, share) = most_missed(base.residual.as_slice(), &likelihood.rows)?;
        let rows = &likelihood.rows[test];
        let whitened = (likelihood.covariance).whiten_all(&base.fitted.found.jacobian);
        let parameters = whitened.ncols() - likelihood.tests.len();
        let adjusting: Vec<usize> = (0..parameters).chain([parameters + test]).collect();
        let mut adjustable = whitened.select_rows(rows).select_columns(&adjusting);
        orthonormalise(&mut adjustable);
        Some(Self {
            test,
            adjustable,
            residual: base.residual.select_rows(rows),
            share,
        })
    }

    /// The change of the test by a candidate with these values of the added parameters that nothing else can make; None if it has no answer there.
    pub(super) fn seen(
        &self,
        context: &Context<'_>,
        base: &BaseFit,
        candidate: &Candidate,
        predictor: &Anchored<'_>,
        values: &[f64],
    ) -> Option<DVector<f64>> {
        let likelihood = &context.likelihood;
        let state = base.added(candidate, values);
        let predicted =
            prediction_of_test(likelihood, predictor, candidate, &state, self.test).ok()?;
        let rows = &likelihood.rows[self.test];
        let mut change = vec![0.0; likelihood.len()];
        for (&row, value) in rows.iter().zip(predicted) {
            change[row] = value - base.fitted.found.model[row];
        }
        let whitened = DVector::from_vec(likelihood.covariance.whiten(&change));
        let of_test = whitened.select_rows(rows);
        let along = self.adjustable.tr_mul(&of_test);
        Some(of_test - &self.adjustable * along)
    }
}

/// The test whose whitened residuals are largest beyond noise, with its part of what all tests have beyond it; `rows`: of each test. None where no
/// test has any, or there is but one.
fn most_missed(residual: &[f64], rows: &[Vec<usize>]) -> Option<(usize, f64)> {
    let beyond = |rows: &Vec<usize>| {
        let beyond = rows.iter().map(|&row| residual[row].powi(2) - 1.0);
        beyond.sum::<f64>().max(0.0)
    };
    let missed: Vec<f64> = rows.iter().map(beyond).collect();
    let all: f64 = missed.iter().sum();
    let test = (0..missed.len()).max_by(|&a, &b| missed[a].total_cmp(&missed[b]))?;
    (missed.len() > 1 && all > 0.0).then(|| (test, missed[test] / all))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// χ² beyond noise: none of the first, 2·3 of the second, 1·(16 − 1) + (0 − 1) of the third.
    #[test]
    fn the_test_that_is_missed_most_is_by_what_exceeds_noise() {
        let rows = [vec![0, 1, 2], vec![3, 4], vec![5, 6]];
        let residual = [0.5, -0.9, 0.3, 2.0, -2.0, -4.0, 0.0, 9.0];
        assert_eq!(most_missed(&residual, &rows), Some((2, 14.0 / 20.0)));
        assert_eq!(most_missed(&residual, &rows[..2]), Some((1, 1.0)));
        assert_eq!(most_missed(&residual, &rows[1..2]), None);
        assert_eq!(most_missed(&[0.0; 7], &rows), None);
    }
}
