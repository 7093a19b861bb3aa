//! Whether there is enough to conclude anything from.

use crate::learn::candidates::fitted_candidate::BaseFit;
use crate::learn::candidates::likelihood::Likelihood;

/// Ids of the tests that were measured at one number of cycles only.
pub(in crate::learn) fn measured_once<'a>(likelihood: &'a Likelihood<'_>) -> Vec<&'a str> {
    let at_once = |test: &&usize| {
        let all = (0..likelihood.len()).map(|i| likelihood.observation(i));
        let mut cycles: Vec<u64> = (all.filter(|o| o.test == **test))
            .map(|o| o.cycles.to_bits())
            .collect();
        cycles.sort_unstable();
        cycles.dedup();
        cycles.len() < 2
    };
    let names = &likelihood.measured.data.tests;
    let once = likelihood.tests.iter().filter(at_once);
    once.map(|&test| names[test].as_str()).collect()
}

/// Whether there are so few values that only strong effects can show.
pub(in crate::learn) fn few(likelihood: &Likelihood<'_>, base: &BaseFit) -> bool {
    likelihood.len() < 4 * unknowns(likelihood, base)
}

/// Whether there are too few values for any answer.
pub(in crate::learn) fn too_few(likelihood: &Likelihood<'_>, base: &BaseFit) -> bool {
    likelihood.len() < 2 * unknowns(likelihood, base)
}

/// k, k of each test, the base model's own parameters, and two of an effect.
pub(in crate::learn) fn unknowns(likelihood: &Likelihood<'_>, base: &BaseFit) -> usize {
    3 + base.fitted.candidate.parameters.len() + likelihood.tests.len()
}
