//! What candidates are judged on: the base model's fit, and the evidence of a candidate's. The fits themselves: `screening`, `deciding`.

use nalgebra::{DMatrix, DVector};

use super::anchored::{model, offset, predictions};
use super::candidate::Candidate;
use super::deciding::DECIDE;
use super::fidelity::Fidelity;
use super::ground::{Ground, whiten};
use super::strength;
use crate::learn::bench::Bench;
use crate::learn::predictor::PredictError;
use crate::learn::quadratic::State;
use crate::learn::search::Found;

/// Most log evidence that a fit may gain, over half its fall of χ²; and what any may gain beyond.
const EXCUSED: f64 = 1.2;
const EXCUSED_AT_LEAST: f64 = 5.0;

/// What is judged on, and the benches: the analytic one to screen, coarse finite elements for changes, the exact one that decides.
pub(super) struct Judge<'a> {
    pub(super) ground: Ground<'a>,
    pub(super) hertz: &'a Bench<'a>,
    pub(super) middle: &'a Bench<'a>,
    pub(super) exact: &'a Bench<'a>,
    /// By which candidates are compared at last.
    pub(super) fidelity: Fidelity,
    /// Whether that is the analytic model in place of the study's finite elements.
    pub(super) approximate: bool,
}

/// A fitted candidate.
pub(super) struct Judged {
    pub(super) candidate: Candidate,
    pub(super) found: Found,
    /// Finite elements minus the cheaper model at the fit, per test of the data set; empty without finite elements.
    pub(super) offset: Vec<Vec<f64>>,
    /// Log evidence, the effect's form taken as uncertain.
    pub(super) log_evidence: f64,
    /// Covariance of (ln k, θ).
    pub(super) covariance: DMatrix<f64>,
    /// What the added effects change of the fitted base model, per row.
    pub(super) change: Vec<f64>,
    /// χ² with the whole covariance.
    pub(super) square: f64,
    /// By what it was fitted.
    pub(super) fidelity: Fidelity,
    pub(super) converged: bool,
}

/// The base model's fit with what the screening projects out.
pub(super) struct Base {
    pub(super) judged: Judged,
    /// Orthonormal columns: whitened changes by which k and the base model's own parameters adjust.
    pub(super) adjustable: DMatrix<f64>,
    /// Whitened residual.
    pub(super) residual: DVector<f64>,
    /// Exact minus analytic model at the fit, per test of the data set.
    pub(super) hertz_offset: Vec<Vec<f64>>,
}

impl<'a> Judge<'a> {
    /// Fits the base model.
    pub(super) fn base(&self, candidate: Candidate) -> Result<Base, PredictError> {
        let start = self.ground.state(
            &candidate.parameters,
            &candidate
                .parameters
                .iter()
                .map(|p| p.start)
                .collect::<Vec<f64>>(),
        );
        let predictor = model(self.middle, &candidate);
        let found = self
            .ground
            .fit(&predictor, &candidate.parameters, start, &DECIDE)?;
        let start = found.state;
        let judged = self.decide(&candidate, start, None, f64::INFINITY)?;
        let mut adjustable = whiten(&self.ground.covariance, &judged.found.jacobian);
        orthonormalise(&mut adjustable);
        let residual = self.ground.residual(&judged.found.model);
        let hertz_offset = {
            let (candidate, state) = (&judged.candidate, &judged.found.state);
            let of = |bench| predictions(&self.ground, &model(bench, candidate), candidate, state);
            offset(&self.ground, &of(self.exact)?, &of(self.hertz)?)
        };
        Ok(Base {
            hertz_offset,
            residual: DVector::from_vec(self.ground.covariance.whiten(&residual)),
            adjustable,
            judged,
        })
    }

    /// The part of a whitened change that k and the base model's own parameters cannot make, by row values.
    pub(super) fn visible(&self, base: &Base, change: &[f64]) -> DVector<f64> {
        let v = DVector::from_vec(self.ground.covariance.whiten(change));
        let along = base.adjustable.tr_mul(&v);
        v - &base.adjustable * along
    }

    /// The state of the base fit with an added effect's values.
    pub(super) fn added(&self, base: &Base, candidate: &Candidate, values: &[f64]) -> State {
        let known = &base.judged.found.state;
        let own = &candidate.parameters[candidate.inherited..];
        let added = own.iter().zip(values).map(|(p, &x)| p.natural_start(x));
        State {
            theta: known.theta.iter().copied().chain(added).collect(),
            ..known.clone()
        }
    }

    pub(super) fn judged(
        &self,
        candidate: Candidate,
        found: Found,
        offset: Vec<Vec<f64>>,
        base: Option<&Base>,
        fidelity: Fidelity,
    ) -> Judged {
        let change: Vec<f64> = match base {
            Some(base) => (found.model.iter().zip(&base.judged.found.model))
                .map(|(f, b)| f - b)
                .collect(),
            None => Vec::new(),
        };
        let own = (!change.is_empty()).then_some(change.as_slice());
        let (mut log_evidence, covariance) =
            self.ground.evidence(&found, &candidate.parameters, own);
        let square = self.ground.square(&found.model);
        // the tolerance of a large change may excuse some of what a fit leaves, but not stand for what it does not explain
        if let Some(before) = base.map(|base| &base.judged) {
            let explained = 0.5 * (before.square - square);
            let most = if explained > 0.0 {
                EXCUSED * explained + EXCUSED_AT_LEAST
            } else {
                explained
            };
            let gain = (log_evidence - before.log_evidence).min(most);
            let more = strength::regained(&candidate, &found.state, gain, 2.0 * explained);
            log_evidence = before.log_evidence + gain + more;
        }
        Judged {
            square,
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

/// Largest fall of χ²/2 by an amplitude between 0 and 4 of a change, and that amplitude.
pub(super) fn linear_gain(seen: &DVector<f64>, residual: &DVector<f64>) -> (f64, f64) {
    let length = seen.norm_squared();
    if length < 1e-12 {
        return (0.0, 0.0);
    }
    let along = seen.dot(residual);
    let amplitude = (along / length).clamp(0.0, 4.0);
    let gain = amplitude * along - 0.5 * amplitude * amplitude * length;
    (gain, amplitude)
}

/// Gram and Schmidt's columns of length 1, twice for rounding; dependent ones become 0.
fn orthonormalise(columns: &mut DMatrix<f64>) {
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
