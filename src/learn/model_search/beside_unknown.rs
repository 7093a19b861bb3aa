//! Effects beside something unknown: each of them fitted together with a smooth discrepancy.
//!
//! ```text
//! y = f(k_t, θ) + m + …      m: the Gaussian process of `discrepancy::gaussian_process`, integrated out
//! ```
//! An effect is a few parameters that act alike in all tests, conditions and members; the process has to be paid for in each of them. So an
//! effect that is there gains over the process alone although it leaves a remainder, and a remainder that is smooth is not sold as an effect
//! (Kennedy & O'Hagan, J. R. Stat. Soc. B 63, 2001, with the physics ranked inside).

use rayon::prelude::*;

use super::context::Context;
use super::screening::SCREEN;
use crate::learn::candidates::candidate_model::{Anchored, model};
use crate::learn::candidates::fitted_candidate::{BaseFit, FittedCandidate};
use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::discrepancy::gaussian_process;
use crate::learn::discrepancy::smooth::SmoothDiscrepancy;
use crate::learn::hypothesis::EffectSet;
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::prediction::fidelity::Fidelity;

/// Effects whose evidence is taken with every kind of discrepancy.
const JUDGED: usize = 6;
/// Log evidence by which a discrepancy alone must be behind a leader that leaves nothing, for the effects to be fitted beside it only from where they
/// stand: an effect would have to gain as much over the discrepancy to matter.
const FAR_BEHIND: f64 = 50.0;

/// Log evidence by which a fit without a discrepancy, once that is added, must be ahead of those beside one for the effect to be fitted from there.
const OTHER_VALLEY: f64 = 1.0;

/// Pairs that are fitted beside a discrepancy, of those that come first without one.
const PAIRS: usize = 2;
/// Pairs that are looked at for that, and the single effects that they are held against: the first beside the most probable discrepancy.
const PAIRS_LOOKED_AT: usize = 6;
const SINGLES_LOOKED_AT: usize = 12;

/// An effect, or a pair, fitted beside a smooth discrepancy.
pub(in crate::learn) struct BesideUnknown {
    /// The fit beside the discrepancy.
    pub(in crate::learn) fitted: FittedCandidate,
    /// ln Z(effect and discrepancy) − ln Z(discrepancy alone), with the discrepancy that is most probable without the effect.
    pub(in crate::learn) gain_with_one: f64,
    /// The same with every kind and size of discrepancy.
    pub(in crate::learn) gain_with_any: f64,
    /// ln Z(effect and discrepancy) − ln Z(effect), both at the fit without the discrepancy; the first at the fit beside it where that is clearly ahead.
    pub(in crate::learn) remainder_gain: f64,
    /// Fall of χ² by the effect without the discrepancy.
    pub(in crate::learn) chi2_drop: f64,
    /// What anything smooth could still bring once the effect is in.
    pub(in crate::learn) remaining: SmoothDiscrepancy,
}

/// A discrepancy alone, and effects beside one.
pub(in crate::learn) struct WithDiscrepancy {
    /// Log evidence of the base model with a discrepancy of any kind.
    pub(in crate::learn) alone: f64,
    /// The effects beside one, the leader first.
    pub(in crate::learn) effects: Vec<BesideUnknown>,
}

impl BesideUnknown {
    /// ln Z(effect and discrepancy) − ln Z(discrepancy alone): what both figures grant.
    pub(in crate::learn) fn gain_over_unknown(&self) -> f64 {
        self.gain_with_one.min(self.gain_with_any)
    }
}

impl Context<'_> {
    /// Fits the effects beside the most probable discrepancy, by the stages of the search without one, and compares those that lead with a
    /// discrepancy alone. `unknown`: log evidence of the base model with a discrepancy at the k that it has without one; `alone`: the effects fitted
    /// without a discrepancy, by falling evidence.
    pub(in crate::learn) fn beside_unknown(
        &self,
        base: &BaseFit,
        unknown: f64,
        singles: &[Candidate],
        alone: &[FittedCandidate],
    ) -> WithDiscrepancy {
        let plain = &self.likelihood;
        let few = decided_without(plain, unknown, alone);
        let singles = worth_fitting(plain, singles, alone);
        let discrepancy = gaussian_process::most_probable(
            plain,
            &base.fitted.found,
            &base.fitted.candidate.parameters,
        );
        let context = Context {
            likelihood: plain.beside(discrepancy),
            ..*self
        };
        let before = base.fitted.square;
        let Some(base) = context.base_beside(base) else {
            return WithDiscrepancy {
                alone: unknown,
                effects: Vec::new(),
            };
        };
        // alone it has the k that suits it, as beside effects
        let unknown = unknown.max(with_discrepancy(plain, &base.fitted));
        let mut fitted = if let Some(few) = few {
            let anew = |alone| context.fitted_from(&base, alone);
            few.into_par_iter().filter_map(anew).collect()
        } else {
            let screened = context.screen(&base, &singles);
            let mut all = match context.fidelity {
                Fidelity::Screening => screened,
                Fidelity::Middle | Fidelity::Full => {
                    context.refine(&base, screened, true, f64::INFINITY)
                }
            };
            all.extend(context.where_it_stood_better(plain, &base, &all, alone));
            all
        };
        fitted.sort_by(|a, b| b.log_evidence.total_cmp(&a.log_evidence));
        let pairs = context.pairs_ahead(plain, &base, &fitted, alone);
        let leader = alone.first().map(|leader| &leader.candidate.effects);
        let mut chosen: Vec<FittedCandidate> = Vec::new();
        for candidate in fitted {
            let effects = &candidate.candidate.effects;
            let known = |c: &FittedCandidate| c.candidate.effects == *effects;
            let of_pair = |pair: &FittedCandidate| pair.candidate.effects.contains(effects);
            // where a discrepancy does all that the leader does, the leader gains less beside it than effects that do nothing
            let is_wanted = pairs.iter().any(of_pair) || leader == Some(effects);
            if (chosen.len() >= JUDGED && !is_wanted) || chosen.iter().any(known) {
                continue;
            }
            // what the analytic model gains cannot be held against what elements do; it did not promise enough to be fitted by these
            let like_base = candidate.fidelity >= self.fidelity.min(Fidelity::Middle);
            if like_base {
                chosen.push(candidate);
            } else if is_wanted {
                chosen.extend(context.fitted_from(&base, &candidate));
            }
        }
        chosen.extend(pairs);
        let mut found: Vec<BesideUnknown> = (chosen.into_par_iter())
            .filter_map(|fitted| {
                // what the effects bring without the discrepancy: their forms of the largest evidence
                let without = alone
                    .iter()
                    .find(|c| c.candidate.effects == fitted.candidate.effects)?;
                let there = with_discrepancy(plain, &fitted);
                let at_own = remainder_gain(plain, without);
                let own = with_discrepancy(plain, without) - at_own;
                let remainder_gain = if there - own > at_own + OTHER_VALLEY {
                    there - own
                } else {
                    at_own
                };
                let remaining =
                    SmoothDiscrepancy::of(plain, &without.found.model).gaining(remainder_gain);
                Some(BesideUnknown {
                    gain_with_one: fitted.log_evidence - base.fitted.log_evidence,
                    gain_with_any: there - unknown,
                    remainder_gain,
                    chi2_drop: before - without.square,
                    remaining,
                    fitted,
                })
            })
            .collect();
        found.sort_by(|a, b| b.gain_over_unknown().total_cmp(&a.gain_over_unknown()));
        WithDiscrepancy {
            alone: unknown,
            effects: found,
        }
    }

    /// Effects fitted beside the discrepancy from where their fits without one ended, of those that come first without one: where a discrepancy, added to
    /// that fit, makes more of it than of all those `fitted` beside one, these have ended in another valley.
    fn where_it_stood_better(
        &self,
        plain: &Likelihood<'_>,
        base: &BaseFit,
        fitted: &[FittedCandidate],
        alone: &[FittedCandidate],
    ) -> Vec<FittedCandidate> {
        let leading = best_forms(alone, 1).into_iter().take(JUDGED);
        let stood_better = |own: &&FittedCandidate| {
            let there = with_discrepancy(plain, own);
            let mut others = (fitted.iter())
                .filter(|other| other.candidate.effects == own.candidate.effects)
                .map(|other| with_discrepancy(plain, other));
            others.all(|other| there > other + OTHER_VALLEY)
        };
        let leading: Vec<&FittedCandidate> = leading.collect();
        (leading.into_par_iter().filter(stood_better))
            .filter_map(|own| self.fitted_from(base, own))
            .collect()
    }

    /// The pairs of which, once a discrepancy is added, more comes than of every single effect fitted beside one: where an effect and the unknown act
    /// alike, a second effect that follows the unknown shows the first one more clearly than the discrepancy does. `singles`: by falling evidence.
    fn pairs_ahead(
        &self,
        plain: &Likelihood<'_>,
        base: &BaseFit,
        singles: &[FittedCandidate],
        alone: &[FittedCandidate],
    ) -> Vec<FittedCandidate> {
        let first = singles.par_iter().take(SINGLES_LOOKED_AT);
        let first = first.map(|own| with_discrepancy(plain, own));
        let best = first.reduce(|| f64::NEG_INFINITY, f64::max);
        let pairs = best_forms(alone, 2).into_iter().take(PAIRS_LOOKED_AT);
        let mut ahead: Vec<(f64, &FittedCandidate)> = (pairs.collect::<Vec<_>>().into_par_iter())
            .map(|pair| (with_discrepancy(plain, pair), pair))
            .filter(|(there, pair)| *there > best && remainder_gain(plain, pair) > 0.0)
            .collect();
        ahead.sort_by(|a, b| b.0.total_cmp(&a.0));
        ahead.truncate(PAIRS);
        (ahead.into_par_iter())
            .filter_map(|(_, pair)| self.fitted_from(base, pair))
            .collect()
    }

    /// Effects fitted beside the discrepancy of this context, by the model that changes are fitted by, from where their fit without one ended.
    fn fitted_from(&self, base: &BaseFit, alone: &FittedCandidate) -> Option<FittedCandidate> {
        let (bench, offset) = match self.fidelity {
            Fidelity::Screening => (self.hertz, &base.hertz_offset),
            Fidelity::Middle | Fidelity::Full => (self.middle, &base.fitted.offset),
        };
        let predictor = Anchored::new(model(bench, &alone.candidate), offset.clone());
        let (parameters, start) = (&alone.candidate.parameters, alone.found.state.clone());
        let found = self.likelihood.fit(&predictor, parameters, start, &SCREEN);
        self.stages.one_done();
        Some(FittedCandidate::new(
            &self.likelihood,
            alone.candidate.clone(),
            found.ok()?,
            offset.clone(),
            Some(base),
            self.fidelity.min(Fidelity::Middle),
        ))
    }

    /// The base model fitted beside the discrepancy of this context.
    fn base_beside(&self, base: &BaseFit) -> Option<BaseFit> {
        let fitted = &base.fitted;
        // by the model that the effects are fitted by, or its error would be taken for what they bring
        let (bench, offset) = match self.fidelity {
            Fidelity::Screening => (self.hertz, &base.hertz_offset),
            Fidelity::Middle | Fidelity::Full => (self.middle, &fitted.offset),
        };
        let predictor = Anchored::new(model(bench, &fitted.candidate), offset.clone());
        let parameters = &fitted.candidate.parameters;
        let start = fitted.found.state.clone();
        let found = self.likelihood.fit(&predictor, parameters, start, &SCREEN);
        let fitted = FittedCandidate::new(
            &self.likelihood,
            fitted.candidate.clone(),
            found.ok()?,
            fitted.offset.clone(),
            None,
            fitted.fidelity,
        );
        // k beside a discrepancy is another one, and what the analytic model is off by changes with it
        self.anchored(fitted, &predictor).ok()
    }
}

/// What is worth fitting beside a discrepancy where the leader leaves nothing that one would account for, and is far ahead of a discrepancy alone: its
/// own effects, and of those that come next the ones that a discrepancy, added to their fits without it, brings near, each in its best form. None in
/// other cases.
fn decided_without<'f>(
    plain: &Likelihood<'_>,
    unknown: f64,
    alone: &'f [FittedCandidate],
) -> Option<Vec<&'f FittedCandidate>> {
    let leader = alone.first()?;
    let bar = leader.log_evidence - FAR_BEHIND;
    if remainder_gain(plain, leader) > 0.0 || unknown > bar {
        return None;
    }
    let of_leader = |c: &FittedCandidate| leader.candidate.effects.contains(&c.candidate.effects);
    let near = |c: &FittedCandidate| with_discrepancy(plain, c) > bar;
    let wanted = (best_forms(alone, 1).into_iter().enumerate())
        .filter(|(place, c)| of_leader(c) || *place < JUDGED && near(c))
        .map(|(_, c)| c);
    Some(wanted.collect())
}

/// Each set of `size` effects in its best forms, in the order of `alone`, which is by falling evidence.
fn best_forms(alone: &[FittedCandidate], size: usize) -> Vec<&FittedCandidate> {
    let mut best: Vec<&FittedCandidate> = Vec::new();
    for fitted in alone {
        let effects = &fitted.candidate.effects;
        let known = |c: &&FittedCandidate| c.candidate.effects == *effects;
        if effects.len() == size && !best.iter().any(known) {
            best.push(fitted);
        }
    }
    best
}

/// All effects; where the leader leaves nothing that a discrepancy would account for, its own and those that come next: no other could stand
/// beside something unknown, for there is none.
fn worth_fitting(
    plain: &Likelihood<'_>,
    singles: &[Candidate],
    alone: &[FittedCandidate],
) -> Vec<Candidate> {
    let all = || singles.to_vec();
    let Some(leader) = alone.first() else {
        return all();
    };
    if remainder_gain(plain, leader) > 0.0 {
        return all();
    }
    let next = best_forms(alone, 1).into_iter().take(JUDGED);
    let next: Vec<&EffectSet> = next.map(|c| &c.candidate.effects).collect();
    let wanted = |candidate: &&Candidate| {
        leader.candidate.effects.contains(&candidate.effects) || next.contains(&&candidate.effects)
    };
    singles.iter().filter(wanted).cloned().collect()
}

/// ln Z(effect and discrepancy) − ln Z(effect) of an effect fitted without a discrepancy.
fn remainder_gain(plain: &Likelihood<'_>, alone: &FittedCandidate) -> f64 {
    let parameters = &alone.candidate.parameters;
    let own = plain.evidence(&alone.found, parameters, Some(&alone.change));
    with_discrepancy(plain, alone) - own.0
}

/// Log evidence of a fit with a discrepancy of any kind.
fn with_discrepancy(plain: &Likelihood<'_>, fitted: &FittedCandidate) -> f64 {
    let change = (!fitted.change.is_empty()).then_some(fitted.change.as_slice());
    let parameters = &fitted.candidate.parameters;
    gaussian_process::log_evidence(plain, &fitted.found, parameters, change)
}
