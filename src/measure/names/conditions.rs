//! Names of the conditions of a test: running times, speeds, torques.

use super::counting::{
    HOURS, MODULES, NEWTON_METRES, NUMBERS_OF_TEETH, PER_MINUTE, SPEEDS, TIMES, TORQUES,
};
use super::{counted, folded, is_filler, member, one_member, revolutions, telling, words};
use crate::measure::quantity::Subject;

/// Hours of a unit of the running time that a name and its unit mean; none if they mean no time.
pub(in crate::measure) fn hours(name: &str, unit: Option<&str>) -> Option<f64> {
    let name = counted(name).concat();
    let of = |unit: &str| HOURS.iter().find(|(known, _)| *known == unit);
    let found = match unit {
        Some(unit) if TIMES.contains(&name.as_str()) => of(&folded(unit)),
        // shorter ones have other meanings too, but for the Italian word
        None => of(&name).filter(|_| name.len() > 3 || name == "ore"),
        Some(_) => None,
    };
    found.map(|(_, hours)| *hours)
}

/// Whether a name means a running time: its unit stands elsewhere.
pub(in crate::measure) fn is_time(name: &str) -> bool {
    TIMES.contains(&telling(name).concat().as_str())
}

/// Hours of a unit of time.
pub(in crate::measure) fn hours_of_unit(unit: &str) -> Option<f64> {
    let unit = folded(unit);
    let found = HOURS.iter().find(|(known, _)| *known == unit);
    found.map(|(_, hours)| *hours)
}

/// Whose speed of rotation in revolutions per minute a name and its unit mean, `None` inside if they do not say; none if they mean none.
pub(in crate::measure) fn speed(name: &str, unit: Option<&str>) -> Option<Option<Subject>> {
    let (of, mut rest): (Vec<String>, Vec<String>) = words(name)
        .into_iter()
        .partition(|word| member(word).is_some());
    let says_unit = rest.iter().any(|word| is_per_minute(word));
    rest.retain(|word| !is_per_minute(word) && (word == "n" || !is_filler(word)));
    let has_unit = match unit {
        Some(unit) => is_per_minute(unit),
        None => says_unit && rest.len() < 2,
    };
    let rest = rest.concat();
    let is_named = SPEEDS.contains(&rest.as_str());
    let is_it = match unit {
        // `Giri [rpm]`
        Some(_) => {
            let is_counted = revolutions(&rest).is_some();
            has_unit && (is_named || is_counted || rest == "n" || rest.is_empty())
        }
        None => is_named || has_unit && (rest == "n" || rest.is_empty()),
    };
    is_it.then(|| one_member(&of.join(" ")))
}

/// Whether a unit is that of revolutions per minute.
fn is_per_minute(unit: &str) -> bool {
    let unit: String = unit.to_lowercase().split_whitespace().collect();
    PER_MINUTE.contains(&unit.as_str())
}

/// On which member the torque acts that a name and its unit mean, `None` inside if they do not say; none if they mean none.
pub(in crate::measure) fn torque(name: &str, unit: Option<&str>) -> Option<Option<Subject>> {
    newton_metres(unit?)?;
    let is_one = |word: &String| member(word).is_some_and(|of| of != Subject::Pair);
    let (of, rest): (Vec<String>, Vec<String>) = telling(name).into_iter().partition(is_one);
    let is_named = TORQUES.contains(&rest.concat().as_str());
    is_named.then(|| one_member(&of.join(" ")))
}

/// Whether a name means the module of gears.
pub(in crate::measure) fn is_module(name: &str) -> bool {
    MODULES.contains(&telling(name).concat().as_str())
}

/// Whether a name means how many teeth a gear has.
pub(in crate::measure) fn is_number_of_teeth(name: &str) -> bool {
    let words = words(name).into_iter();
    let words: Vec<String> = words.filter(|word| member(word).is_none()).collect();
    NUMBERS_OF_TEETH.contains(&words.concat().as_str())
}

/// N m of a unit of torque.
pub(in crate::measure) fn newton_metres(unit: &str) -> Option<f64> {
    let unit = folded(unit);
    let found = NEWTON_METRES.iter().find(|(known, _)| *known == unit);
    found.map(|(_, factor)| *factor)
}
