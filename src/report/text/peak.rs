//! The largest contact pressure on the flanks, in words: away from kinks of the flanks, and at them.

use super::{new_and_worn, region};
use crate::numeric::written::significant;
use crate::simulate::result::{Run, State};

/// What to say of a pressure at a kink.
pub(super) const KINK: &str =
    "where a linear tip relief begins or a flank bends otherwise: depends on the mesh";

/// Largest pressure of a state away from kinks, MPa; the largest of all where there is no other.
pub(in crate::report) fn elsewhere(state: &State) -> Option<f64> {
    let found = state.pressure_elsewhere().or(state.peak_pressure());
    found.map(|p| p.0)
}

/// Largest pressures at kinks in the first and in the last state, MPa, 0 where none bears; none if they are the largest in neither.
pub(in crate::report) fn at_kinks(run: &Run) -> Option<(f64, f64)> {
    let states = [run.first(), run.last()];
    let matters = states.iter().any(|state| state.peak_is_over_kink());
    let [new, worn] = states.map(|state| state.kink_pressure().map_or(0.0, |p| p.0));
    matters.then_some((new, worn))
}

/// The largest contact pressure on the flanks, new and worn, and that at kinks where it is larger.
pub(super) fn sentence(run: &Run) -> Option<String> {
    let (new, worn) = (elsewhere(run.first())?, elsewhere(run.last())?);
    let kinks = at_kinks(run);
    let of = if kinks.is_some() {
        " away from kinks"
    } else {
        ""
    };
    let mut words = if run.states.len() > 1 {
        format!(
            "The largest contact pressure on the flanks{of} went from {} to {} MPa.",
            significant(new, 4),
            significant(worn, 4)
        )
    } else {
        let place = run.first().pressure_elsewhere();
        let place = place.map_or(String::new(), |p| format!(" ({})", region(run, p.1)));
        format!(
            "The largest contact pressure on the flanks{of} is {} MPa{place}.",
            significant(new, 4)
        )
    };
    if let Some((new, worn)) = kinks {
        words += &format!(
            " At a kink it is {} ({KINK}).",
            new_and_worn(run, new, worn, "MPa")
        );
    }
    Some(words)
}
