//! Keys that change no figure of a sweep: nothing in the study depends on them.

use std::collections::BTreeMap;

use super::design::Design;
use super::figures::Outputs;
use super::points::{Point, Result};
use crate::effects::CATALOGUE;

/// A line for each varied key of which all points that differ in it alone have the same figures.
pub(super) fn text(
    design: &Design,
    outputs: &Outputs,
    points: &[Point],
    results: &[Result],
) -> String {
    let values: Vec<&[String]> = points.iter().map(|point| &point.values[..]).collect();
    let figures: Vec<Option<Vec<Option<f64>>>> = (results.iter())
        .map(|result| {
            let figures = result.as_ref().ok()?;
            let columns = outputs.columns.iter();
            Some(columns.map(|column| figures.value(column)).collect())
        })
        .collect();
    let keys = design.keys.iter().enumerate();
    keys.filter(|(i, _)| is_idle(*i, &values, &figures))
        .map(|(_, key)| line(key))
        .collect()
}

/// Whether all points that differ in key number `key` alone have the same figures; no where no two do.
fn is_idle(key: usize, values: &[&[String]], figures: &[Option<Vec<Option<f64>>>]) -> bool {
    let mut alike: BTreeMap<Vec<&String>, &Vec<Option<f64>>> = BTreeMap::new();
    let mut compared = false;
    for (values, figures) in values.iter().zip(figures) {
        let Some(figures) = figures else { continue };
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

/// What to say of such a key, with the effects that would depend on it.
fn line(key: &str) -> String {
    let using = CATALOGUE.iter().filter(|card| card.needs.contains(&key));
    let using: Vec<&str> = using.map(|card| card.name).collect();
    let effects = match &using[..] {
        [] => String::new(),
        using => format!(
            "; it acts through {} (gearwear effects {})",
            using.join(", "),
            using[0]
        ),
    };
    format!("{key} changes none of these figures: nothing in this study depends on it{effects}\n")
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
        let figures = |all: [f64; 4]| all.map(|one| Some(vec![Some(one), None])).to_vec();
        let plain = figures([3.0, 3.0, 5.0, 5.0]);
        assert!(!is_idle(0, &values, &plain) && is_idle(1, &values, &plain));
        let together = figures([3.0, 3.0, 5.0, 5.5]);
        assert!(!is_idle(1, &values, &together));
        // points of which none differs in one key alone tell nothing
        assert!(!is_idle(0, &values[..1], &plain[..1]));
        let failed = vec![Some(vec![Some(3.0)]), None, None, Some(vec![Some(3.0)])];
        assert!(!is_idle(1, &values, &failed));
        assert!(line("lubricant.viscosity").contains("through film_thickness"));
    }
}
