//! Keys that change no figure of a sweep: nothing that it asks for depends on them.

use std::collections::BTreeMap;

use super::design::Design;
use super::figures::Figures;
use super::points::{Point, Result};
use crate::effects::CATALOGUE;

/// A line for each varied key of which all points that differ in it alone have the same figures.
pub(super) fn text(design: &Design, points: &[Point], results: &[Result]) -> String {
    let values: Vec<&[String]> = points.iter().map(|point| &point.values[..]).collect();
    let figures: Vec<Option<&Figures>> = results.iter().map(|r| r.as_ref().ok()).collect();
    let keys = design.keys.iter().enumerate();
    keys.filter(|(i, _)| is_idle(*i, &values, &figures))
        .map(|(_, key)| line(key))
        .collect()
}

/// Whether all points that differ in key number `key` alone have the same figures; no where no two do.
fn is_idle<T: PartialEq>(key: usize, values: &[&[String]], figures: &[Option<&T>]) -> bool {
    let mut alike: BTreeMap<Vec<&String>, &T> = BTreeMap::new();
    let mut compared = false;
    for (values, figures) in values.iter().zip(figures) {
        let Some(figures) = *figures else { continue };
        let others = (values.iter().enumerate())
            .filter(|(i, _)| *i != key)
            .map(|(_, value)| value)
            .collect();
        match alike.insert(others, figures) {
            Some(same) if same != figures => return false,
            Some(_) => compared = true,
            None => {}
        }
    }
    compared
}

/// What to say of such a key, with the effects that use it.
fn line(key: &str) -> String {
    let using = CATALOGUE.iter().filter(|card| card.needs.contains(&key));
    let using: Vec<&str> = using.map(|card| card.name).collect();
    let effects = match &using[..] {
        [] => String::new(),
        [one] => format!("; the effect {one} uses it"),
        several => format!("; the effects {} use it", several.join(", ")),
    };
    format!("{key} changes none of these figures{effects}\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a grid of two keys the first changes the figures and the second does not.
    #[test]
    fn only_a_key_without_any_change_is_idle() {
        let rows = [["1", "7"], ["1", "8"], ["2", "7"], ["2", "8"]];
        let rows: Vec<Vec<String>> = rows.map(|row| row.map(str::to_owned).to_vec()).to_vec();
        let values: Vec<&[String]> = rows.iter().map(|row| &row[..]).collect();
        let idle = |key: usize, figures: [Option<&f64>; 4]| is_idle(key, &values, &figures);
        let grid = [Some(&3.0), Some(&3.0), Some(&5.0), Some(&5.0)];
        assert!(!idle(0, grid) && idle(1, grid));
        assert!(!idle(1, [Some(&3.0), Some(&3.0), Some(&5.0), Some(&5.5)]));
        // points of which none differs in one key alone tell nothing
        assert!(!is_idle(0, &values[..1], &grid[..1]));
        assert!(!idle(1, [Some(&3.0), None, None, Some(&3.0)]));
        assert!(line("lubricant.viscosity").contains("the effects film_thickness, "));
    }
}
