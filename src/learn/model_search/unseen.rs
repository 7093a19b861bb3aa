//! Candidates that the analytic model may not see at all, looked at by coarse finite elements from their first starts on.
//!
//! Candidates that act through slices of the face or classes of teeth cost many times a section, and most of them gain nothing. Rough wear steps
//! therefore estimate first whether a fit is worth its price. Where a candidate has two opposite starts, one of them is enough to rule it out: its
//! linearised gain with either sign must reach a share of what is attainable; first in the test that is missed most, then in all.

use nalgebra::DVector;
use rayon::prelude::*;

use super::context::Context;
use super::most_missed::MostMissed;
use super::screening::{SCREEN, linear_gain, plane_gain};
use crate::learn::candidates::candidate_model::{Anchored, model, offset, predictions};
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::discrepancy::smooth::SmoothDiscrepancy;
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::inference::quadratic::State;
use crate::learn::prediction::bench::Bench;
use crate::learn::prediction::fidelity::Fidelity;

/// Share of the attainable fall of χ² below which nothing explains what is there, and standard deviations of the attainable that count in an
/// explanation's favour: of a weak discrepancy noise alone moves the share by more than a tenth.
pub(super) const EXPLAINED: f64 = 0.85;
const SPREADS: f64 = 0.5;
/// Share of the attainable gain (of ln likelihood) below which the linearised gain of what acts across the face or on single teeth is too little
/// for a fit; and that of one start with either sign for a look at the others.
const ROUGH_SHARE: f64 = 0.2;
const EITHER_SIGN_SHARE: f64 = 0.1;
/// The same in the test that is missed most, of what of it is attainable there: an effect may show less in it than in others.
const IN_ONE_TEST: f64 = 0.05;

/// A bench with rough wear steps, and what its base model lacks to the one that decides.
struct Rough<'b> {
    bench: Bench<'b>,
    offset: Vec<Vec<f64>>,
    most_missed: Option<MostMissed>,
}

impl Context<'_> {
    /// Looks by coarse finite elements, from the first starts on, for what the analytic model may not see: where no candidate explains what
    /// is there, and across the face also where the leader is what that is mistaken for.
    pub(in crate::learn) fn with_unseen(
        &self,
        base: &BaseFit,
        refined: Vec<FittedCandidate>,
        smooth: &SmoothDiscrepancy,
    ) -> Vec<FittedCandidate> {
        let fallen = |j: &FittedCandidate| base.fitted.square - j.square;
        let most = refined.iter().map(fallen).fold(0.0, f64::max);
        if smooth.drop < smooth.spread() {
            return refined;
        }
        let explained = most + SPREADS * smooth.spread() > EXPLAINED * smooth.drop;
        let leader = (refined.iter()).max_by(|a, b| a.log_evidence.total_cmp(&b.log_evidence));
        let forms_are_one = self.likelihood.states_places_across_the_face();
        let looked_at = |judged: &FittedCandidate| {
            let candidate = &judged.candidate;
            if !candidate.acts_across_the_face() {
                return !explained && candidate.may_be_unseen();
            }
            let alike = leader.is_some_and(|l| candidate.is_look_alike_of(&l.candidate));
            let settled = explained && judged.fidelity != Fidelity::Screening;
            (!explained || alike) && !settled && (candidate.is_own_form() || !forms_are_one)
        };
        let wanted: Vec<bool> = refined.iter().map(looked_at).collect();
        let costly =
            (refined.iter().zip(&wanted)).any(|(j, wanted)| *wanted && j.candidate.is_costly());
        let rough = costly.then(|| self.rough(base)).flatten();
        let attainable = 0.5 * smooth.drop;
        let anew = |judged: &FittedCandidate| {
            let candidate = &judged.candidate;
            let predictor =
                Anchored::new(model(self.middle, candidate), base.fitted.offset.clone());
            let starts = match rough.as_ref().filter(|_| candidate.is_costly()) {
                Some(rough) => self.worthwhile(base, candidate, rough, attainable)?,
                None => self.starts(base, candidate, &predictor),
            };
            let found = self.look(candidate, &predictor, starts, &SCREEN)?;
            let found = self.refined(base, candidate.clone(), found);
            (found.log_evidence > judged.log_evidence).then_some(found)
        };
        let better: Vec<Option<FittedCandidate>> = (refined.par_iter().zip(&wanted))
            .map(|(judged, wanted)| {
                let better = wanted.then(|| anew(judged))?;
                self.stages.one_done();
                better
            })
            .collect();
        (refined.into_iter().zip(better))
            .map(|(judged, better)| better.unwrap_or(judged))
            .collect()
    }

    /// None where the base model cannot be worn with rough steps.
    fn rough(&self, base: &BaseFit) -> Option<Rough<'_>> {
        let bench = self.middle.rougher().ok()?;
        let candidate = &base.fitted.candidate;
        let on = |bench: &Bench<'_>| {
            let model = model(bench, candidate);
            predictions(
                &self.likelihood,
                &model,
                candidate,
                &base.fitted.found.state,
            )
            .ok()
        };
        let mut offset = offset(&self.likelihood, &on(self.middle)?, &on(&bench)?);
        for (offset, of_middle) in offset.iter_mut().zip(&base.fitted.offset) {
            offset.iter_mut().zip(of_middle).for_each(|(o, m)| *o += m);
        }
        Some(Rough {
            bench,
            offset,
            most_missed: MostMissed::of(self, base),
        })
    }

    /// The starts of a costly candidate if with rough wear steps their linearised gain is worth a fit; None if not.
    fn worthwhile(
        &self,
        base: &BaseFit,
        candidate: &Candidate,
        rough: &Rough<'_>,
        attainable: f64,
    ) -> Option<Vec<(f64, State)>> {
        let predictor = Anchored::new(model(&rough.bench, candidate), rough.offset.clone());
        if let Some(most) = &rough.most_missed {
            let seen = |values: &[f64]| most.seen(self, base, candidate, &predictor, values);
            let least = IN_ONE_TEST * most.share * attainable;
            // phases that differ between tests may be one in a single test: then it tells nothing
            let gain = self.gain_of_either_sign(candidate, seen, &most.residual);
            if gain.is_some_and(|gain| gain < least) {
                return None;
            }
        }
        let seen = |values: &[f64]| self.seen(base, candidate, &predictor, values);
        let gain = self.gain_of_either_sign(candidate, seen, &base.residual)?;
        if gain < EITHER_SIGN_SHARE * attainable {
            return None;
        }
        let starts = self.starts(base, candidate, &predictor);
        (starts.first()?.0 >= ROUGH_SHARE * attainable).then_some(starts)
    }

    /// The largest gain (of ln likelihood) of its starts in the linearised model, each with either sign and so one of two that mirror each other;
    /// of a wave with any phase. `seen`: the visible change by values of the added parameters; `left`: what it is to explain.
    fn gain_of_either_sign(
        &self,
        candidate: &Candidate,
        seen: impl Fn(&[f64]) -> Option<DVector<f64>>,
        left: &DVector<f64>,
    ) -> Option<f64> {
        if let Some([first, second]) = candidate.quarters.first() {
            let (first, second) = (seen(first)?, seen(second)?);
            return Some(plane_gain([&first, &second], left)?.0);
        }
        let gain = |values: &Vec<f64>| {
            let along = seen(values)?;
            let amplitudes = self.amplitudes(candidate);
            let (gain, _) = linear_gain(&along, left, amplitudes);
            let (other, _) = linear_gain(&-along, left, amplitudes);
            Some(gain.max(other))
        };
        // small amounts may do nothing where large ones do
        let mut looked_at: Vec<&Vec<f64>> = Vec::new();
        for values in &candidate.starts {
            let mirrored: Vec<f64> = values.iter().map(|value| -value).collect();
            if !looked_at.contains(&&mirrored) {
                looked_at.push(values);
            }
        }
        looked_at.into_iter().filter_map(gain).reduce(f64::max)
    }
}
