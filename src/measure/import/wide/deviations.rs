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

/// How the sign is stated, or that there is none to state.
const SAY_SIGN: &str = "write `negative = material missing` (or positive) into the title, say --turn-sign where it is negative, or --quantity wear_depth if the values are \
                        depths, positive where material is missing";

/// Where a table names its values deviations.
pub(super) struct Deviations {
    row: usize,
    words: String,
}

/// The first row down to the header that names deviations and says nothing of wear; none where the user says what the values are.
pub(super) fn named(
    sheet: &Sheet,
    head: usize,
    quantity: Quantity,
    wanted: &Wanted<'_>,
) -> Option<Deviations> {
    if quantity != Quantity::WearDepth || wanted.quantity.is_some() {
        return None;
    }
    let mut rows = sheet.rows.iter().enumerate().take(head + 1);
    rows.find_map(|(row, cells)| {
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
    /// [`ImportError`] where a place has no value at 0, where nothing but values at 0 stands there, and where no sign is stated though there are none
    /// at 0, or though these are all 0 and the depths would be negative.
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
            return self.without_new(entries, (states_sign, turned));
        }
        (wanted.per_interval).refuse_differences(&[Quantity::WearDepth])?;
        entries.retain(|entry| entry.cycles > 0.0);
        if entries.is_empty() {
            return Err(self.refused("and has them at 0 alone, of the new profile: what was worn is the change since then, so add those after running"));
        }
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
        let negative = entries.iter().filter(|entry| entry.value < 0.0).count();
        let says_nothing = new.iter().all(|entry| entry.value == 0.0);
        if says_nothing && !states_sign && 2 * negative > entries.len() {
            return Err(self.refused(&format!(
                "all 0 at 0, and {negative} of {} depths would be negative: {SAY_SIGN}",
                entries.len()
            )));
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

    fn refused(&self, why: &str) -> ImportError {
        let row = self.row + 1;
        ImportError(format!(
            "row {row}: `{}` names deviations, {why}",
            self.words
        ))
    }

    /// Where the new profile is not in the table the deviations are the depths.
    fn without_new(
        &self,
        entries: &[Entry],
        (states_sign, turned): (bool, bool),
    ) -> Result<String> {
        if !states_sign {
            let negative = entries.iter().filter(|entry| entry.value < 0.0).count();
            return Err(self.refused(&format!(
                "of which {negative} of {} are negative, and none is of the new profile: {SAY_SIGN}; if the new profile was measured too, add its \
                 deviations in a column (or row) at 0, and the depths are taken from them",
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
