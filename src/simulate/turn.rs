//! The transmission error over a whole turn, where teeth differ or a member runs out.

use rayon::prelude::*;

use crate::contact::cycle::Position;
use crate::contact::model::{ContactError, ContactModel, PositionContact};
use crate::contact::sequence::Sequence;

/// Mesh positions of a base pitch that are looked at, at most.
const MOST_POSITIONS: usize = 25;

/// Rotation of the pinion (base pitches since its tooth 1 met tooth 1 of the gear in the pitch point) and the approach (rad) over one turn
/// of the member with more teeth: every tooth where it stands, worn by `u` as its class; `near`: the contacts of one passage, which
/// solutions start from.
///
/// # Errors
/// [`ContactError`] of the first position that fails.
pub(super) fn over_a_turn<M: ContactModel + ?Sized>(
    model: &M,
    sequence: &Sequence,
    u: &[f64],
    near: &[PositionContact],
) -> Result<Vec<[f64; 2]>, ContactError> {
    let positions = &model.cycle().positions;
    let depths = sequence.depths(u);
    let order = looked_at(positions);
    let all: Vec<(usize, usize)> = (0..sequence.base_pitches_of_a_turn())
        .flat_map(|turned| order.iter().map(move |q| (turned, *q)))
        .collect();
    let at = |&(turned, q): &(usize, usize)| {
        let position = &positions[q];
        let pairs = position.pairs.iter();
        let numbers: Vec<i64> = pairs.map(|p| i64::from(position.pair_number(p))).collect();
        let flanks = sequence.flanks_after(turned, &numbers, &depths);
        let contact = model.solve_flanks(q, &flanks, &near[q].active)?;
        Ok([turned as f64 + position.phase(), contact.approach])
    };
    all.par_iter().map(at).collect()
}

/// The same where teeth are alike, for `pitches` base pitches of which the contacts are these.
pub(super) fn alike_over_a_turn(
    positions: &[Position],
    contacts: &[PositionContact],
    pitches: usize,
) -> Vec<[f64; 2]> {
    let order = looked_at(positions);
    let after = |turned: usize| {
        let each = order.iter();
        each.map(move |q| [turned as f64 + positions[*q].phase(), contacts[*q].approach])
    };
    (0..pitches).flat_map(after).collect()
}

/// Positions by ascending rotation, no more than [`MOST_POSITIONS`].
fn looked_at(positions: &[Position]) -> Vec<usize> {
    let step = positions.len().div_ceil(MOST_POSITIONS);
    let mut order: Vec<usize> = (0..positions.len()).collect();
    order.sort_by(|a, b| positions[*a].phase().total_cmp(&positions[*b].phase()));
    order.into_iter().step_by(step).collect()
}
