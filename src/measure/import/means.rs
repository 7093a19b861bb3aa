//! A mean and extremes of each checkpoint of a wide table, `80000 min; 80000 max; 80000 mean`: the means are what was measured.

use std::collections::BTreeMap;

use super::numbers::number_words;
use super::{ImportError, Sheet, cell_name, units};
use crate::measure::names;

/// A header of a number and a word for a statistic.
struct Statistic {
    at: usize,
    is_mean: bool,
}

/// Keeps the columns of means, with headers that say the number alone, and empties those of the extremes beside them; says so where there are any.
///
/// # Errors
/// [`ImportError`] where a number has several statistics and not one mean among them.
pub(super) fn only(sheet: &mut Sheet, head: usize) -> Result<Option<String>, ImportError> {
    let mut of_numbers: BTreeMap<String, Vec<Statistic>> = BTreeMap::new();
    for (at, header) in sheet.rows[head].iter().enumerate().skip(1) {
        if let Some((number, statistic)) = statistic(at, header) {
            of_numbers.entry(number).or_default().push(statistic);
        }
    }
    of_numbers.retain(|_, statistics| statistics.len() > 1);
    let Some(first) = of_numbers.values().flatten().map(|one| one.at).min() else {
        return Ok(None);
    };
    let first = format!("{}: `{}`", cell_name(head, first), sheet.rows[head][first]);
    for (number, statistics) in &of_numbers {
        let means = statistics.iter().filter(|statistic| statistic.is_mean);
        if means.count() != 1 {
            return Err(ImportError(format!(
                "{first} and others are statistics of {number}, with not one mean among them: leave one column for each checkpoint, the one that is to be compared"
            )));
        }
        for statistic in statistics {
            if statistic.is_mean {
                let unit = units::bracketed(&sheet.rows[head][statistic.at]);
                let unit = unit.map_or(String::new(), |unit| format!(" [{unit}]"));
                sheet.rows[head][statistic.at] = format!("{number}{unit}");
            } else {
                let cells = sheet.rows[head..].iter_mut();
                for cell in cells.filter_map(|row| row.get_mut(statistic.at)) {
                    cell.clear();
                }
            }
        }
    }
    Ok(Some(format!(
        "{first} and others are statistics: the means are read"
    )))
}

/// The number and the statistic of a header that holds nothing else but a unit in brackets.
fn statistic(at: usize, header: &str) -> Option<(String, Statistic)> {
    let (name, _) = units::name_and_unit(header);
    let [number] = number_words(&name)[..] else {
        return None;
    };
    let word = name.replacen(number, "", 1);
    let word = word.trim_matches(|c: char| !c.is_alphabetic());
    names::is_statistic(word).then(|| {
        let is_mean = names::is_mean(word);
        (number.to_owned(), Statistic { at, is_mean })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet(header: &str) -> Sheet {
        Sheet::of_rows(&[header, "26|1|3|2|4"])
    }

    #[test]
    fn means_are_kept_and_extremes_left_out() {
        let mut three = sheet("r|80000 min|80000 max|80000 Mittel [\u{b5}m]|200000");
        assert!(only(&mut three, 0).unwrap().is_some());
        assert_eq!(three.rows[0], ["r", "", "", "80000 [\u{b5}m]", "200000"]);
        assert_eq!(three.rows[1], ["26", "", "", "2", "4"]);
        assert!(only(&mut sheet("r|80000 min|80000 max|200000"), 0).is_err());
        // minutes; a statistic of the whole row
        for other in ["r|80 min|160 min|240 min", "r|80000|200000|max|mean"] {
            assert_eq!(only(&mut sheet(other), 0), Ok(None), "{other}");
        }
    }
}
