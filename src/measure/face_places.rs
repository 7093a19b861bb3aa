//! Places across the face that rows state.

use super::{Dataset, FacePlace};

impl Dataset {
    /// In a sentence, if rows of quantities that are of the whole face (mass, transmission error, stiffness) state a place on it.
    pub fn places_not_used(&self) -> Option<String> {
        let mut idle = (self.observations.iter())
            .filter(|row| matches!(row.face, Some(FacePlace::At(_))))
            .filter(|row| !row.quantity.is_at_a_place_across_the_face());
        let first = idle.next()?;
        let count = 1 + idle.count();
        let rows = if count == 1 { "row" } else { "rows" };
        Some(format!(
            "{count} {rows} of what is of the whole face state a place across it, the first at {} ({}): it is not used",
            self.place(first),
            first.quantity.name(),
        ))
    }
}
