//! A candidate as fitted with its evidence, and what it is compared with: the base model's fit.

use nalgebra::{DMatrix, DVector};

use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::candidates::strength_prior;
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::inference::quadratic::State;
use crate::learn::inference::search::SearchEnd;
use crate::learn::prediction::fidelity::Fidelity;

/// Most log evidence that a fit may gain, over half its fall of χ²; and what any may gain beyond that explains as much as this itself.
const EXCUSED: f64 = 1.2;
const EXCUSED_AT_LEAST: f64 = 5.0;
/// ln evidence, and half of χ², that a form may be behind another one and do as well.
pub(in crate::learn) const AS_WELL: f64 = 3.0;
/// Scatter of k below which less is none.
const LEAST_SCATTER: f64 = 0.01;

/// A fitted candidate.
#[derive(Clone)]
pub(in crate::learn) struct FittedCandidate {
    pub(in crate::learn) candidate: Candidate,
    pub(in crate::learn) found: SearchEnd,
    /// Finite elements minus the cheaper model at the fit, per test of the data set; empty without finite elements.
    pub(in crate::learn) offset: Vec<Vec<f64>>,
    /// Log evidence, the effect's form taken as uncertain.
    pub(in crate::learn) log_evidence: f64,
    /// Covariance of (ln k, θ).
    pub(in crate::learn) covariance: DMatrix<f64>,
    /// What the added effects change of the fitted base model, per row.
    pub(in crate::learn) change: Vec<f64>,
    /// χ² with the whole covariance.
    pub(in crate::learn) square: f64,
    /// How much more probable the tests' own deviations of k are under their scatter than with the base model, ln of the density.
    pub(in crate::learn) scatter_gain: f64,
    /// By what it was fitted.
    pub(in crate::learn) fidelity: Fidelity,
    pub(in crate::learn) converged: bool,
}

/// The base model's fit with what the screening projects out.
///
/// Where k scatters between tests, each test's own deviation is measured too, by its prior: behind the whitened rows stands one more for each test,
/// 0 = ε_t/σ_k ± 1. So what an effect does to a test as a whole is seen against the scatter.
pub(in crate::learn) struct BaseFit {
    pub(in crate::learn) fitted: FittedCandidate,
    /// Orthonormal columns: changes by which k, each test's deviation from it and the base model's own parameters adjust.
    adjustable: DMatrix<f64>,
    /// Whitened residual, and −ε_t/σ_k.
    pub(in crate::learn) residual: DVector<f64>,
    /// What it was fitted by minus the analytic model at the fit, per test of the data set.
    pub(in crate::learn) hertz_offset: Vec<Vec<f64>>,
    /// Log evidence of the same fit with the analytic model's derivatives, which the candidates of the screening are fitted by.
    screened_evidence: f64,
}

impl FittedCandidate {
    /// Whether it explains the data as well as `other`, another form of the same effects: by the fit too, as evidence allows for an error of the form.
    pub(in crate::learn) fn does_as_well_as(&self, other: &Self) -> bool {
        other.log_evidence - self.log_evidence < AS_WELL
            && self.square - other.square < 2.0 * AS_WELL
    }

    /// Its evidence; over that of `base`, unless it is the base model itself.
    pub(in crate::learn) fn new(
        likelihood: &Likelihood<'_>,
        candidate: Candidate,
        found: SearchEnd,
        offset: Vec<Vec<f64>>,
        base: Option<&BaseFit>,
        fidelity: Fidelity,
    ) -> Self {
        let change: Vec<f64> = match base {
            Some(base) => (found.model.iter().zip(&base.fitted.found.model))
                .map(|(f, b)| f - b)
                .collect(),
            None => Vec::new(),
        };
        let own = (!change.is_empty()).then_some(change.as_slice());
        let (mut log_evidence, covariance) =
            likelihood.evidence(&found, &candidate.parameters, own);
        let square = likelihood.square(&found.model);
        let before = base.map(|base| &base.fitted);
        let scatter_gain = before.map_or(0.0, |before| {
            scatter_log_density(&found) - scatter_log_density(&before.found)
        });
        // the tolerance of a large change may excuse some of what a fit leaves, but not stand for what it does not explain
        if let Some(before) = before {
            let explained = 0.5 * (before.square - square) + scatter_gain;
            let by_same_means = base.map_or(before.log_evidence, |base| base.evidence_by(fidelity));
            let gain = (log_evidence - by_same_means).min(most_gain(explained));
            let more = strength_prior::regained(&candidate, &found.state, gain, 2.0 * explained);
            log_evidence = before.log_evidence + gain + more;
        }
        Self {
            square,
            scatter_gain,
            converged: found.converged,
            candidate,
            offset,
            log_evidence,
            covariance,
            change,
            found,
            fidelity,
        }
    }
}

impl BaseFit {
    /// `hertz_offset`: what it was fitted by minus the analytic model at the fit, per test of the data set; `screened_evidence`: log evidence with the analytic
    /// model's derivatives on it.
    pub(in crate::learn) fn new(
        likelihood: &Likelihood<'_>,
        fitted: FittedCandidate,
        hertz_offset: Vec<Vec<f64>>,
        screened_evidence: f64,
    ) -> Self {
        let whitened = (likelihood.covariance).whiten_all(&fitted.found.jacobian);
        let mut base = Self {
            hertz_offset,
            screened_evidence,
            residual: DVector::zeros(0),
            adjustable: adjustable(likelihood, &whitened, fitted.found.scatter),
            fitted,
        };
        base.residual = base.left(
            likelihood,
            &base.fitted.found.model,
            &base.fitted.found.state,
        );
        base
    }

    /// Its log evidence by the derivatives that a candidate of some fidelity is fitted with.
    ///
    /// The analytic model's values are brought to those of finite elements by what is added to them, which no k scales: where it wears less, its
    /// derivatives are smaller, each test's k is known less well, and the integral over it is larger, whether an effect does something or not.
    fn evidence_by(&self, fidelity: Fidelity) -> f64 {
        match fidelity {
            Fidelity::Screening => self.screened_evidence,
            Fidelity::Middle | Fidelity::Full => self.fitted.log_evidence,
        }
    }

    /// What a model in a state leaves: the whitened residual, and −ε_t/σ_k with the base model's σ_k.
    pub(in crate::learn) fn left(
        &self,
        likelihood: &Likelihood<'_>,
        model: &[f64],
        state: &State,
    ) -> DVector<f64> {
        let mut left = likelihood.covariance.whiten(&likelihood.residual(model));
        let scatter = self.fitted.found.scatter;
        if scatter > 0.0 {
            left.extend(state.epsilon.iter().map(|epsilon| -epsilon / scatter));
        }
        DVector::from_vec(left)
    }

    /// The part of a whitened change that k and the base model's own parameters cannot make, by row values.
    pub(in crate::learn) fn visible(
        &self,
        likelihood: &Likelihood<'_>,
        change: &[f64],
    ) -> DVector<f64> {
        let mut v = likelihood.covariance.whiten(change);
        v.resize(self.adjustable.nrows(), 0.0);
        let v = DVector::from_vec(v);
        let along = self.adjustable.tr_mul(&v);
        v - &self.adjustable * along
    }

    /// Orthonormal columns of the changes that a candidate's own parameters, k and the tests' own k make where it was fitted; rows as of
    /// [`BaseFit::left`].
    pub(in crate::learn) fn follows(
        &self,
        likelihood: &Likelihood<'_>,
        fitted: &FittedCandidate,
    ) -> DMatrix<f64> {
        let whitened = likelihood.covariance.whiten_all(&fitted.found.jacobian);
        adjustable(likelihood, &whitened, self.fitted.found.scatter)
    }

    /// The state of the fit with an added effect's values.
    pub(in crate::learn) fn added(&self, candidate: &Candidate, values: &[f64]) -> State {
        let known = &self.fitted.found.state;
        let own = &candidate.parameters[candidate.inherited..];
        let added = own.iter().zip(values).map(|(p, &x)| p.natural_start(x));
        State {
            theta: known.theta.iter().copied().chain(added).collect(),
            ..known.clone()
        }
    }
}

/// The most log evidence that a fit may gain that explains so much of ln likelihood: none where it explains nothing.
fn most_gain(explained: f64) -> f64 {
    if explained > 0.0 {
        EXCUSED * explained + EXCUSED_AT_LEAST.min(explained * explained / EXCUSED_AT_LEAST)
    } else {
        explained
    }
}

/// Orthonormal columns of what adjusts, from the whitened derivatives with respect to (θ, ln k_t): θ, the common ln k, and with a scatter each ln k_t
/// at the price of its prior.
fn adjustable(likelihood: &Likelihood<'_>, whitened: &DMatrix<f64>, scatter: f64) -> DMatrix<f64> {
    let (rows, tests) = (likelihood.len(), likelihood.tests.len());
    let params = whitened.ncols() - tests;
    let own = if scatter > 0.0 { tests } else { 0 };
    let mut columns = DMatrix::zeros(rows + own, params + 1 + own);
    let of_tests = whitened.columns(params, tests);
    columns
        .view_mut((0, 0), (rows, params))
        .copy_from(&whitened.columns(0, params));
    columns
        .view_mut((0, params), (rows, 1))
        .copy_from(&of_tests.column_sum());
    columns
        .view_mut((0, params + 1), (rows, own))
        .copy_from(&of_tests.columns(0, own));
    for test in 0..own {
        columns[(rows + test, params + 1 + test)] = scatter.recip();
    }
    orthonormalise(&mut columns);
    columns
}

/// ln of the density of the tests' deviations under their scatter, but for constants.
fn scatter_log_density(found: &SearchEnd) -> f64 {
    let epsilon = &found.state.epsilon;
    let scatter = found.scatter.max(LEAST_SCATTER);
    let squares: f64 = epsilon.iter().map(|e| (e / scatter).powi(2)).sum();
    -0.5 * squares - epsilon.len() as f64 * scatter.ln()
}

/// Gram and Schmidt's columns of length 1, twice for rounding; dependent ones become 0.
pub(in crate::learn) fn orthonormalise(columns: &mut DMatrix<f64>) {
    for i in 0..columns.ncols() {
        let before = columns.column(i).norm();
        for _ in 0..2 {
            for j in 0..i {
                let share = columns.column(i).dot(&columns.column(j));
                let other = columns.column(j).into_owned();
                columns.column_mut(i).axpy(-share, &other, 1.0);
            }
        }
        let length = columns.column(i).norm();
        let scale = if length > 1e-9 * before {
            length.recip()
        } else {
            0.0
        };
        columns.column_mut(i).scale_mut(scale);
    }
}

#[cfg(test)]
mod tests {
    use super::most_gain;

    /// What explains nothing gains nothing, and next to nothing next to it; what explains much is excused for as much as ever.
    #[test]
    fn what_explains_nothing_gains_nothing() {
        assert!(most_gain(0.0) == 0.0 && most_gain(-0.3) == -0.3);
        assert!(most_gain(1e-9) < 1e-8 && most_gain(0.3) < 0.4);
        assert!((most_gain(5.0) - 11.0).abs() < 1e-12 && (most_gain(50.0) - 65.0).abs() < 1e-12);
        let rises =
            (0..100).map(|i| most_gain(0.1 * f64::from(i + 1)) - most_gain(0.1 * f64::from(i)));
        assert!(rises.into_iter().all(|rise| rise > 0.0));
    }
}
