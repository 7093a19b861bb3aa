//! The standard deviations that a wide table states: of single values, or of all values of a row.

use super::cell_sigmas::CellSigmas;
use super::entry::Entry;
use super::row_sigmas::RowSigmas;
use super::wanted::Wanted;
use super::{ImportError, Sheet};
use crate::measure::Quantity;

/// Such standard deviations, out of their table.
pub(super) enum Sigmas {
    OfCells(CellSigmas),
    OfRows(RowSigmas),
}

impl Sigmas {
    /// Those of a sheet, which keeps the values alone; none where it states none.
    ///
    /// # Errors
    /// [`ImportError`] where two columns name them, or the user states a standard deviation too.
    pub(super) fn taken(
        sheet: &mut Sheet,
        head: usize,
        wanted: &Wanted<'_>,
    ) -> Result<Option<Self>, ImportError> {
        if let Some(of_cells) = CellSigmas::taken(sheet, head, wanted)? {
            return Ok(Some(Self::OfCells(of_cells)));
        }
        Ok(RowSigmas::taken(sheet, head, wanted)?.map(Self::OfRows))
    }

    /// Gives them to the entries, where the values are in `unit`, and says so.
    pub(super) fn state(
        &self,
        entries: &mut [Entry],
        (quantity, unit): (Quantity, &str),
        wanted: &Wanted<'_>,
    ) -> Result<String, ImportError> {
        match self {
            Self::OfCells(sigmas) => sigmas.state(entries, (quantity, unit), wanted),
            Self::OfRows(sigmas) => sigmas.state(entries, (quantity, unit), wanted),
        }
    }
}
