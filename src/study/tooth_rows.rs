//! Whether the teeth that rows name are teeth of the gears.

use std::collections::BTreeSet;

use super::effect_model::EffectModel;
use super::{Study, StudyError};
use crate::effects::Effect;
use crate::gear::{Member, ToothClasses};
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

    /// What to say where rows name several teeth of a member and the model, with `effects`, has all of them alike.
    pub fn warning_on_teeth(&self, data: &Dataset, effects: &EffectModel) -> Option<String> {
        let moves_none = effects.stated().tooth_classes() == ToothClasses::Alike(1);
        if !self.teeth.are_alike() || !moves_none {
            return None;
        }
        let named = |member| -> BTreeSet<i64> {
            let own = data.observations.iter();
            let own = own.filter(|row| row.member.member() == Some(member));
            own.filter_map(|row| row.tooth.as_deref()?.trim().parse().ok())
                .collect()
        };
        let (member, count) = (Member::BOTH.into_iter())
            .map(|member| (member, named(member).len()))
            .find(|(_, count)| *count > 1)?;
        Some(format!(
            "rows name {count} teeth of the {}, and in the model all teeth are alike: what differs between them counts as misfit; a pitch chart in [teeth], \
             pitch_error or run_out would differ too",
            member.name()
        ))
    }
}
