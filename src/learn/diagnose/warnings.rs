//! What keeps an answer from being trusted.

use super::ground::Ground;
use super::judge::{Base, Judge, Judged};
use super::noise_level;
use super::rank::Ranking;
use super::ranked::parameters;
use super::suspects;

/// Share of a parameter's prior outside of which a value is told.
const UNHEARD_OF: f64 = 1e-3;

/// What keeps an answer from being trusted.
pub(super) fn warnings(judge: &Judge<'_>, base: &Base, ranking: &Ranking) -> Vec<String> {
    let ground = &judge.ground;
    let mut warnings = Vec::new();
    if judge.approximate {
        warnings.push(
            "decided by the analytic contact model, whose curves differ by 1 to 2 % from finite elements and may hide or feign an effect: repeat with --fidelity middle before acting on this".to_owned(),
        );
    }
    let factor = ground.noise.sigma_factor;
    if factor > 1.0 {
        warnings.push(format!(
            "neighbouring points of a trace scatter {factor:.1} times as much as their stated sigma: it was taken that much larger here"
        ));
    }
    if let Some(smooth) = noise_level::too_smooth(ground, &base.judged.found.model) {
        warnings.push(format!(
            "neighbouring points of a trace scatter only {smooth:.2} times their stated sigma: if the traces were filtered their points are not independent and every probability here is too bold; if sigma is overstated, weak effects stay hidden"
        ));
    }
    let alone = measured_once(ground);
    if alone.len() == ground.tests.len() {
        warnings.push(
            "every test was measured at one number of cycles only: what changes over life (running-in, debris, ageing, polishing) cannot be told from a constant".to_owned(),
        );
    } else if !alone.is_empty() {
        warnings.push(format!(
            "measured at one number of cycles only: {}",
            alone.join(", ")
        ));
    }
    if ground.tests.len() == 1 {
        warnings.push(
            "there is one test only: what depends on torque, speed or misalignment cannot be told from what does not".to_owned(),
        );
    }
    let unknowns = unknowns(ground, base);
    if ground.len() <= unknowns {
        warnings.push(format!(
            "there are about {unknowns} unknowns and no more measured values ({}): no effect can show",
            ground.len()
        ));
    } else if few(ground, base) {
        warnings.push(format!(
            "{} measured values are few for about {unknowns} unknowns: only strong effects can show",
            ground.len()
        ));
    }
    let leading = ranking.effects().first().copied();
    let leader = leading.and_then(|(name, _)| ranking.best_of(name));
    let leader = leader.map(|place| &ranking.judged[place]);
    let suspects = suspects::suspects(ground, &base.judged.found.model);
    if suspects.is_empty() {
        let models = std::iter::once(&base.judged).chain(leader);
        warnings.extend(
            models
                .filter_map(|j| suspects::alone(judge, base, &j.found.model))
                .next(),
        );
    }
    warnings.extend(suspects);
    if !base.judged.converged {
        warnings
            .push("the fit of the base model did not converge: probabilities are rough".to_owned());
    }
    if let Some(leader) = leader {
        if !leader.converged {
            warnings.push(format!(
                "the fit with {} did not converge: its parameters are rough",
                leader.candidate.name()
            ));
        }
        for p in parameters(leader).iter().filter(|p| p.at_bound) {
            warnings.push(format!(
                "{} of {} lies on its bound, {:e}",
                p.name,
                leader.candidate.name(),
                p.value
            ));
        }
        if leading.is_some_and(|(_, probability)| probability > 0.5) {
            warnings.extend(unheard_of(leader));
        }
    }
    warnings
}

/// Parameters of the added effects that lie outside nearly all of what the catalogue holds for possible.
fn unheard_of(leader: &Judged) -> impl Iterator<Item = String> {
    let candidate = &leader.candidate;
    let added =
        (candidate.parameters.iter().zip(&leader.found.state.theta)).skip(candidate.inherited);
    added.filter_map(|(parameter, &natural)| {
        let value = parameter.value(natural);
        let [low, high] = [0.5 * UNHEARD_OF, 1.0 - 0.5 * UNHEARD_OF].map(|p| parameter.quantile(p));
        (value < low || value > high).then(|| {
            format!(
                "{} would be {value:.3e}, known are {low:.3e} to {high:.3e}: the name holds only if such a size makes sense here",
                parameter.name
            )
        })
    })
}

/// Ids of the tests that were measured at one number of cycles only.
pub(super) fn measured_once<'a>(ground: &'a Ground<'_>) -> Vec<&'a str> {
    let at_once = |test: &&usize| {
        let all = (0..ground.len()).map(|i| ground.observation(i));
        let mut cycles: Vec<u64> = (all.filter(|o| o.test == **test))
            .map(|o| o.cycles.to_bits())
            .collect();
        cycles.sort_unstable();
        cycles.dedup();
        cycles.len() < 2
    };
    let names = &ground.measured.data.tests;
    let once = ground.tests.iter().filter(at_once);
    once.map(|&test| names[test].as_str()).collect()
}

/// Whether there are too few values for any answer.
pub(super) fn few(ground: &Ground<'_>, base: &Base) -> bool {
    ground.len() < 4 * unknowns(ground, base)
}

/// k, k of each test, the base model's own parameters, and two of an effect.
fn unknowns(ground: &Ground<'_>, base: &Base) -> usize {
    3 + base.judged.candidate.parameters.len() + ground.tests.len()
}
