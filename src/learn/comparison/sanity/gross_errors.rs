//! Single rows so far from all others that nothing can be said of the rest before they are gone: what a machine writes for "no value", slipped points.

use std::collections::{BTreeMap, BTreeSet};

use crate::measure::{Dataset, Observation, Outlier};
use crate::numeric::written::significant;

/// How many times the largest of the other values of its quantity and member such a row is.
const TIMES: f64 = 10.0;
/// How many places are named.
const NAMED: usize = 5;

/// A question about the rows that stand apart and are many times all others.
pub(super) fn gross_errors(data: &Dataset) -> Option<String> {
    let of = |o: &Observation| (o.member, o.quantity);
    let curve = |o: &Observation| (o.test, o.member, o.quantity, o.cycles.to_bits(), o.trace);
    let apart: BTreeSet<usize> = data.outliers.iter().map(|outlier| outlier.row).collect();
    let mut largest: BTreeMap<_, f64> = BTreeMap::new();
    let mut of_curves: BTreeMap<_, f64> = BTreeMap::new();
    for (row, o) in data.observations.iter().enumerate() {
        if !apart.contains(&row) {
            let most = largest.entry(of(o)).or_default();
            *most = most.max(o.value.abs());
            let most = of_curves.entry(curve(o)).or_default();
            *most = most.max(o.value.abs());
        }
    }
    // those that a robust likelihood takes the weight from do no harm
    let counts = |outlier: &&Outlier| data.observations[outlier.row].sigma <= outlier.stated_sigma;
    let is_beyond = |o: &Observation, most: Option<&f64>| {
        most.is_some_and(|most| *most > 0.0 && o.value.abs() > TIMES * most)
    };
    let is_gross = |o: &&Observation| {
        is_beyond(o, largest.get(&of(o))) || is_beyond(o, of_curves.get(&curve(o)))
    };
    let all = data.outliers.iter().filter(counts);
    let all = all.map(|outlier| &data.observations[outlier.row]);
    let all: Vec<&Observation> = all.filter(is_gross).collect();
    let first = of(all.first()?);
    let gross: Vec<&Observation> = all.into_iter().filter(|o| of(o) == first).collect();
    let places: Vec<String> = (gross.iter().take(NAMED))
        .map(|o| {
            format!(
                "{} ({} {})",
                data.place(o),
                significant(o.value, 4),
                o.quantity.shown_unit()
            )
        })
        .collect();
    let beyond_all = gross.iter().all(|o| is_beyond(o, largest.get(&of(o))));
    let others = match beyond_all {
        true => format!(
            "all other values of {} of the {}",
            first.1.name(),
            first.0.name()
        ),
        false => format!(
            "all others of the same {} profile of the {}",
            first.1.name(),
            first.0.name()
        ),
    };
    let more = match gross.len() {
        n if n > NAMED => format!(" and {} more", n - NAMED),
        _ => String::new(),
    };
    Some(format!(
        "more than {TIMES} times {others}: {}{more}. If that is what the machine writes for no value, or a slip, leave these rows out or put them right; nothing can be \
         said of the others before",
        places.join(", ")
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Study;

    /// What is said of a curve of 21 depths up to 8 µm of which one has another value.
    fn told(value: f64) -> Option<String> {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let mut text = "test,member,cycles,quantity,position,value,sigma\n".to_owned();
        for i in 0..21 {
            let x = f64::from(i - 10) / 10.0;
            let noise = 0.1 * (2.4 * f64::from(i)).sin();
            let depth = if i == 8 {
                value
            } else {
                8.0 * (1.0 - x * x) + noise
            };
            text += &format!(
                "A,pinion,200000,wear_depth,{},{depth},0.1\n",
                26.5 + 0.1 * f64::from(i)
            );
        }
        let mut data = Dataset::parse(&text, "m.csv", &study.known()).unwrap();
        data.find_outliers(false);
        gross_errors(&data)
    }

    #[test]
    fn what_a_machine_writes_for_no_value_is_asked_about_first() {
        let asked = told(-999.0).unwrap();
        assert!(
            asked.contains("of wear_depth of the pinion: m.csv:10 (−999.0 µm)"),
            "{asked}"
        );
        assert!(told(99.0).is_some());
        assert_eq!(told(20.0), None);
        assert_eq!(told(0.0), None);
        assert_eq!(told(8.0), None);
    }
}
