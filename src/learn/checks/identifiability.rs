//! Identifiability: whether the measurements determine the parameter that an effect is known by.
//!
//! Load that ripples along the flank is a dynamic load only if it depends on speed. Where that cannot be seen, any cause that stays at its
//! place on the flank could make the same pattern: two harmonics fitted a starved band (blind set `s504_0039`) as well as noise allowed,
//! with a resonance at 16 000 ± 19 000 rpm. At one speed the amplitude's prior alone puts the resonance somewhere, however narrowly.

use crate::effects::{Card, Param, ParamRole};
use crate::learn::candidates::fitted_candidate::FittedCandidate;
use crate::learn::candidates::likelihood::Likelihood;

/// Standard deviation of a parameter, as a share of its prior's, above which the data say nothing of it. A resonance acts by the square
/// of its inverse, which is then known to no better than its own size; a lower bound alone already takes the share from 1 to 0.6 where the ripple is
/// strong. In blind sets it was 0.85 and more where nothing was said, 0.3 and less else.
const KEPT: f64 = 0.4;
/// Largest over smallest speed of the tests from which a dependence on speed can be seen at all.
const SPEEDS: f64 = 1.1;

/// The card of a single effect, and the first parameter that it is known by, where the data determine none of those.
pub(in crate::learn) fn unidentified(
    likelihood: &Likelihood<'_>,
    fitted: &FittedCandidate,
) -> Option<(&'static Card, &'static str)> {
    let candidate = &fitted.candidate;
    let card = candidate.effects.single()?;
    let speed = |p: &&Param| p.role == ParamRole::IdentifyingSpeed;
    let places: Vec<(usize, &'static str)> = (candidate.inherited..candidate.parameters.len())
        .filter_map(|place| {
            let (_, own) = candidate.parameters[place].name.split_once('.')?;
            let mut identifying = card.params.iter().filter(speed);
            Some((place, identifying.find(|p| p.name == own)?.name))
        })
        .collect();
    let &(_, name) = places.first()?;
    let first = fitted.covariance.nrows() - candidate.parameters.len();
    let undetermined = |&(place, _): &(usize, &str)| {
        let variance = fitted.covariance[(first + place, first + place)].max(0.0);
        let prior = candidate.parameters[place].natural_prior();
        variance.sqrt() > KEPT * prior.scale()
    };
    let tests = &likelihood.measured.study().tests;
    let speeds = (likelihood.tests.iter()).map(|&test| tests[test].conditions.speed_rpm);
    let nothing = vary_too_little(speeds) || places.iter().all(undetermined);
    nothing.then_some((card, name))
}

fn vary_too_little(speeds: impl Iterator<Item = f64>) -> bool {
    let (least, most) = speeds.fold((f64::INFINITY, 0.0_f64), |(least, most), speed| {
        (least.min(speed), most.max(speed))
    });
    most < SPEEDS * least
}
