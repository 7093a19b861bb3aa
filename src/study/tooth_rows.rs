//! Whether the teeth that rows name are teeth of the gears.

use super::{Study, StudyError};
use crate::gear::Member;
use crate::measure::{Dataset, Observation};

impl Study {
    /// Refuses rows that name a tooth by a number that its member does not have, where the study states that teeth differ. Elsewhere a label
    /// says nothing and may be anything.
    ///
    /// # Errors
    /// A [`StudyError`] at `teeth`.
    pub fn check_teeth_of_rows(&self, data: &Dataset) -> Result<(), StudyError> {
        if self.teeth.are_alike() {
            return Ok(());
        }
        let beyond = |row: &Observation| -> Option<(i64, u32)> {
            let named = row.tooth.as_deref()?.trim().parse::<i64>().ok()?;
            let teeth = match row.member.member()? {
                Member::Pinion => self.gears.pinion.spec.teeth,
                Member::Gear => self.gears.gear.spec.teeth,
            };
            (!(1..=i64::from(teeth)).contains(&named)).then_some((named, teeth))
        };
        let found = (data.observations.iter()).find_map(|row| Some((row, beyond(row)?)));
        let Some((row, (named, teeth))) = found else {
            return Ok(());
        };
        Err(self.refuse(
            "teeth",
            &format!(
                "{} names tooth {named} of the {}, which has {teeth}",
                data.place(row),
                row.member.name()
            ),
            &format!("1 to {teeth} in the column tooth"),
            "teeth are numbered from 1 in the order in which they come into mesh; a label that is no whole number names none",
        ))
    }
}
