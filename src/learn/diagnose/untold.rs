//! Effects in whose favour the measurements say nothing of what they are known by.
//!
//! Load that ripples along the flank is a dynamic load only if it depends on speed. Where that cannot be seen, any cause that stays at its
//! place on the flank could make the same pattern: two harmonics fitted a starved band (blind set `s504_0039`) as well as noise allowed,
//! with a resonance at 16 000 ± 19 000 rpm.

use super::judge::Judged;
use crate::effects::{Card, find};

/// Standard deviation of a parameter, as a share of its prior's, above which the data say nothing of it. A resonance acts by the square
/// of its inverse, which is then known to no better than its own size; a lower bound alone already takes the share from 1 to 0.6 where the ripple is
/// strong. In blind sets it was 0.85 and more where nothing was said, 0.3 and less else.
const KEPT: f64 = 0.4;

/// The card of a single effect, and the parameter that it is known by and of which the data say nothing.
pub(super) fn untold(judged: &Judged) -> Option<(&'static Card, &'static str)> {
    let candidate = &judged.candidate;
    let [name] = candidate.names[..] else {
        return None;
    };
    let card = find(name).ok()?;
    let first = judged.covariance.nrows() - candidate.parameters.len();
    let own = (candidate.parameters.iter().enumerate()).skip(candidate.inherited);
    own.filter(|(i, parameter)| {
        let variance = judged.covariance[(first + i, first + i)].max(0.0);
        variance.sqrt() > KEPT * parameter.natural_prior().scale()
    })
    .find_map(|(_, parameter)| {
        let (_, short) = parameter.name.split_once('.')?;
        let told = card.params.iter().find(|p| p.tells && p.name == short)?;
        Some((card, told.name))
    })
}
