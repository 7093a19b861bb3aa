//! Tables of deviations from the profile: what was worn is what a place has less than when it was new.
//!
//! ```text
//! depth(place, cycles) = deviation(place, 0) − deviation(place, cycles)      a deviation is positive where there is more material
//! ```
//! Where the table says that lost material is positive it is the other way round.

use super::columns::Column;
use super::entry::Entry;
use super::numbers::rounded;
use super::wanted::Wanted;
use super::{ImportError, Sheet, cell_name};
use crate::measure::{Quantity, names};

type Result<T> = std::result::Result<T, ImportError>;

/// How the sign is stated, or that there is none to state.
const SAY_SIGN: &str = "write `negative = material missing` (or positive) into the title, say --turn-sign where it is negative, or --quantity wear_depth if the values are \
                        depths, positive where material is missing";

/// Where a table names its values deviations.
pub(super) struct Deviations {
    /// Row or cell of the words.
    place: String,
    words: String,
}

/// The first row of a wide table down to the header that names deviations and says nothing of wear; none where the user says what the values are.
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
        names::speaks_of_deviation(&words).then(|| Deviations {
            place: format!("row {}", row + 1),
            words,
        })
    })
}

/// The column of values of a long table whose header is in row `head`, if it names deviations; none where the user says what the values are.
pub(super) fn of_column(column: &Column, head: usize, wanted: &Wanted<'_>) -> Option<Deviations> {
    let names_them =
        names::is_deviation(&column.name()) || names::speaks_of_deviation(&column.written);
    (wanted.quantity.is_none() && names_them).then(|| Deviations {
        place: cell_name(head, column.at),
        words: column.written.clone(),
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
            let Some(before) = mean_of_place(&new, entry) else {
                return Err(ImportError(format!(
                    "{}: {} names deviations (`{}`), and this place has none at 0 to take from: add it, or take the place out",
                    cell_name(entry.cell.0, entry.cell.1),
                    self.place,
                    self.words
                )));
            };
            let lost = before - entry.value;
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
            "{}, `{}`: wear depth, the change of the deviation since 0, {}; those at 0 are not written themselves, and their scatter is in all depths of \
             a flank alike: no sigma tells it, `[noise] new_profile` of the study does",
            self.place,
            self.words,
            match (states_sign, turned) {
                (false, _) | (true, true) => "for it is positive where there is more material",
                (true, false) => "lost material positive as the table says",
            }
        ))
    }

    fn refused(&self, why: &str) -> ImportError {
        ImportError(format!(
            "{}: `{}` names deviations, {why}",
            self.place, self.words
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
            "{}, `{}`: deviations without the new profile's (at 0) are taken for depths, {} where material is missing",
            self.place,
            self.words,
            if turned {
                "negative in the table"
            } else {
                "positive"
            }
        ))
    }
}

/// What was measured of the new profile where a later value stands, the mean of repeats; none if nothing was.
fn mean_of_place(new: &[Entry], later: &Entry) -> Option<f64> {
    let place = |entry: &Entry| {
        let label = [&entry.test, &entry.face, &entry.tooth].map(String::clone);
        (label, entry.member, entry.position)
    };
    let there = place(later);
    let own = new.iter().filter(|entry| place(entry) == there);
    let (count, sum) = own.fold((0_u32, 0.0), |(count, sum), entry| {
        (count + 1, sum + entry.value)
    });
    (count > 0).then(|| sum / f64::from(count))
}
