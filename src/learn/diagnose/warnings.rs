//! What keeps an answer from being trusted.

use super::ground::Ground;
use super::judge::Base;
use super::rank::Ranking;
use super::ranked::parameters;

/// What keeps an answer from being trusted.
pub(super) fn warnings(ground: &Ground<'_>, base: &Base, ranking: &Ranking) -> Vec<String> {
    let mut warnings = Vec::new();
    let factor = ground.noise.sigma_factor;
    if factor > 1.0 {
        warnings.push(format!(
            "neighbouring points of a trace scatter {factor:.1} times as much as their stated sigma: it was taken that much larger here"
        ));
    }
    let data = &ground.measured.data;
    let mut alone = Vec::new();
    for &test in &ground.tests {
        let mut cycles: Vec<u64> = (0..ground.len())
            .map(|i| ground.observation(i))
            .filter(|o| o.test == test)
            .map(|o| o.cycles.to_bits())
            .collect();
        cycles.sort_unstable();
        cycles.dedup();
        if cycles.len() < 2 {
            alone.push(data.tests[test].as_str());
        }
    }
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
    let free = 1 + base.judged.candidate.parameters.len() + ground.tests.len();
    if ground.len() < 4 * (free + 2) {
        warnings.push(format!(
            "{} measured values are few for about {} unknowns: only strong effects can show",
            ground.len(),
            free + 2
        ));
    }
    if !base.judged.converged {
        warnings
            .push("the fit of the base model did not converge: probabilities are rough".to_owned());
    }
    if let Some(leader) = ranking.effects().first().and_then(|e| ranking.best_of(e.0)) {
        let leader = &ranking.judged[leader];
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
    }
    warnings
}
