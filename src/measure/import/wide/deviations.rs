//! Wide tables of deviations from the profile: what was worn is what a place has less than when it was new.
//!
//! ```text
//! depth(place, cycles) = deviation(place, 0) − deviation(place, cycles)      a deviation is positive where there is more material
//! ```
//! Where the table says that lost material is positive it is the other way round.

use super::Result;
use crate::measure::import::entry::Entry;
use crate::measure::import::numbers::rounded;
use crate::measure::import::wanted::Wanted;
use crate::measure::import::{ImportError, Sheet, cell_name};
use crate::measure::{Quantity, names};

/// Where a table names its values deviations.
pub(super) struct Deviations {
    row: usize,
    words: String,
}

/// The first row down to the header that names deviations, where nothing says that the values are what was worn.
pub(super) fn named(sheet: &Sheet, head: usize, quantity: Quantity) -> Option<Deviations> {
    if quantity != Quantity::WearDepth {
        return None;
    }
    let rows = || sheet.rows.iter().enumerate().take(head + 1);
    let is_worn = |word: &String| {
        names::quantity(word).is_some_and(|(named, _)| named == Quantity::WearDepth)
    };
    let says_worn = |(_, cells): (usize, &Vec<String>)| {
        let words = cells.iter().flat_map(|cell| names::words(cell));
        words.collect::<Vec<_>>().iter().any(is_worn)
    };
    if rows().any(says_worn) {
        return None;
    }
    rows().find_map(|(row, cells)| {
        let filled: Vec<&str> = (cells.iter())
            .map(String::as_str)
            .filter(|cell| !cell.is_empty())
            .collect();
        let words = filled.join(" ");
        names::speaks_of_deviation(&words).then_some(Deviations { row, words })
    })
}

impl Deviations {
    /// Whether a title is the one that names them.
    pub(super) fn is_of(&self, words: &str) -> bool {
        self.words == words
    }

    /// Makes depths of the values, the new profile's out, and says how. `turned`: the sign of the entries has been turned, so that lost material
    /// is positive in them; `states_sign`: the table or the user says which sign lost material has.
    ///
    /// # Errors
    /// [`ImportError`] where a place has no value at 0, or where there are none at 0 and no sign is stated of values that are negative.
    pub(super) fn as_depths(
        &self,
        entries: &mut Vec<Entry>,
        (states_sign, turned): (bool, bool),
        wanted: &Wanted<'_>,
    ) -> Result<String> {
        let new: Vec<Entry> = (entries.iter())
            .filter(|entry| entry.cycles == 0.0)
            .cloned()
            .collect();
        if new.is_empty() {
            return self.without_new(entries, states_sign, turned);
        }
        (wanted.per_interval).refuse_differences(&[Quantity::WearDepth])?;
        entries.retain(|entry| entry.cycles > 0.0);
        for entry in entries.iter_mut() {
            let of_place = |n: &&Entry| (n.member, n.position) == (entry.member, entry.position);
            let Some(before) = new.iter().find(of_place) else {
                return Err(ImportError(format!(
                    "{}: row {} names deviations (`{}`), and this place has none at 0 to take from: add it, or take the place out",
                    cell_name(entry.cell.0, entry.cell.1),
                    self.row + 1,
                    self.words
                )));
            };
            let lost = before.value - entry.value;
            entry.value = rounded(if states_sign { -lost } else { lost });
        }
        Ok(format!(
            "row {}, `{}`: wear depth, the change of the deviation since 0, {}; those at 0 are not written themselves",
            self.row + 1,
            self.words,
            match (states_sign, turned) {
                (false, _) | (true, true) => "for it is positive where there is more material",
                (true, false) => "lost material positive as the table says",
            }
        ))
    }

    /// Where the new profile is not in the table the deviations are the depths.
    fn without_new(&self, entries: &[Entry], states_sign: bool, turned: bool) -> Result<String> {
        let negative = entries.iter().filter(|entry| entry.value < 0.0).count();
        if !states_sign && 2 * negative > entries.len() {
            return Err(ImportError(format!(
                "row {}: `{}` names deviations, of which {negative} of {} are negative: say --turn-sign if that is where material is missing; and if the \
                 new profile was measured too, add its deviations in a column (or row) at 0, and the depths are taken from them",
                self.row + 1,
                self.words,
                entries.len()
            )));
        }
        Ok(format!(
            "row {}, `{}`: deviations without the new profile's (at 0) are taken for depths, {} where material is missing",
            self.row + 1,
            self.words,
            if turned {
                "negative in the table"
            } else {
                "positive"
            }
        ))
    }
}
