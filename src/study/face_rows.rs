//! What rows say of their place across the face, against what the study's model knows of the face.
//!
//! One section is the same at every place of the face. With an effect across the face it is the section at one place only: the one where
//! the effect says that traces are taken (`face_position`, `face_mean`). A row that states another place would be compared with wear
//! that is not there.

use std::collections::BTreeSet;

use super::effect_model::EffectModel;
use super::{ContactKind, Study, StudyError};
use crate::effects::{Effect, UsualTrace};
use crate::measure::{Dataset, FacePlace, Observation};

/// Half face widths by which a row may be off the effect's place: rounding of either.
const ROUNDING: f64 = 0.01;

impl Study {
    /// Whether one section stands for the face whatever acts across it.
    fn is_of_one_section(&self) -> bool {
        let spur = self.gears.pinion.helix_angle == 0.0;
        (self.contact != ContactKind::Fem && spur) || self.face.slices == 1
    }

    /// Whether a row stands where one section with an effect across the face is.
    fn is_there(&self, row: &Observation, usual: UsualTrace) -> bool {
        let half = 0.5 * self.gears.face_width;
        match row.face {
            None => true,
            Some(FacePlace::Mean) => usual.mean == 1.0,
            Some(FacePlace::At(face)) => {
                usual.mean == 0.0 && (face / half - usual.place).abs() < ROUNDING
            }
        }
    }

    /// The first row that states a place across the face where the model with `effects` has nothing to say.
    fn elsewhere<'d>(&self, data: &'d Dataset, effects: &EffectModel) -> Option<&'d Observation> {
        let usual = effects.stated().usual_trace()?;
        let mut rows = placed(data).filter(|_| self.is_of_one_section());
        rows.find(|row| !self.is_there(row, usual))
    }

    /// Refuses rows at places across the face that the study's one section, with `effects` across the face, is not at.
    ///
    /// # Errors
    /// A [`StudyError`] at the key that makes the model one section.
    pub fn check_places_across_the_face(
        &self,
        data: &Dataset,
        effects: &EffectModel,
    ) -> Result<(), StudyError> {
        let Some(row) = self.elsewhere(data, effects) else {
            return Ok(());
        };
        let (key, allowed) = if self.contact == ContactKind::Fem {
            ("face.slices", "2 or more, or no such key (7 then)")
        } else {
            (
                "model.contact",
                "\"fem\", which computes the face in slices",
            )
        };
        Err(self.refuse(
            key,
            &format!(
                "{} states where across the face it was measured; one section with an effect across the face is at one place only, that of `face_position` (or the mean, `face_mean` = 1)",
                data.place(row)
            ),
            allowed,
            "or state the rows' one place as `face_position` of the effect, from -1 to 1 in half face widths",
        ))
    }

    /// What a model with `effects` does not take from the rows' places across the face, in sentences.
    pub fn warnings_on_places_across_the_face(
        &self,
        data: &Dataset,
        effects: &EffectModel,
    ) -> Vec<String> {
        let mut warnings: Vec<String> = data.places_not_used().into_iter().collect();
        let places: BTreeSet<u64> = placed(data)
            .filter_map(|row| row.face)
            .map(FacePlace::key)
            .collect();
        let across = effects.stated().usual_trace().is_some();
        if let Some(row) = self.elsewhere(data, effects) {
            warnings.push(format!(
                "the model is one section, and its effects across the face act on all rows as at `face_position`, also on {} and others that state another place: state contact = \"fem\" and no slices = 1",
                data.place(row)
            ));
        } else if places.len() > 1 && !across && self.face.slices < 2 {
            warnings.push(format!(
                "rows state {} places across the face, and the model is the same at all of them: what differs between places counts as misfit; lead deviations in [face] (with slices) or an effect across the face would differ too",
                places.len()
            ));
        }
        warnings
    }

    /// What a diagnosis needs for effects across the face where rows state several places and one section stands for all of them; None where nothing
    /// keeps it from judging such effects.
    pub fn needed_across_the_face(&self, data: &Dataset) -> Option<&'static str> {
        let places: BTreeSet<u64> = placed(data)
            .filter_map(|row| row.face)
            .map(FacePlace::key)
            .collect();
        (self.is_of_one_section() && places.len() > 1).then_some(match self.contact {
            ContactKind::Fem => "face.slices of 2 or more, or unstated",
            _ => "model.contact = \"fem\"",
        })
    }
}

/// The rows that are measured at a place across the face and state it.
fn placed(data: &Dataset) -> impl Iterator<Item = &Observation> {
    let rows = data.observations.iter();
    rows.filter(|row| row.face.is_some() && row.quantity.is_at_a_place_across_the_face())
}
