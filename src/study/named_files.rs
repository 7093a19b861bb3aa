//! Files that a study names: measured profiles, leads and pitch charts, and what the study is with them.

use std::path::Path;

use super::effect_model::EffectSpec;
use crate::gear::Coupling;

use super::{ContactKind, Study, StudyError, face, profile, teeth};

/// The keys that name measured profiles, pinion and gear.
pub(super) const PROFILE_KEYS: [&str; 2] = ["gears.pinion.profile_file", "gears.gear.profile_file"];

impl Study {
    /// The files that the study names.
    pub fn inputs(&self) -> Vec<&Path> {
        let meshes = [&self.numerics.mesh_pinion, &self.numerics.mesh_gear];
        let all = meshes
            .into_iter()
            .chain(&self.profiles)
            .chain(&self.leads)
            .chain(&self.pitches)
            .chain([&self.measurements, &self.tests_file]);
        all.filter_map(Option::as_deref).collect()
    }

    /// The study with what the files hold that it names.
    pub(super) fn with_files(self) -> Result<Study, StudyError> {
        self.with_profiles()?
            .with_leads()?
            .with_pitches()?
            .with_slices()
    }

    /// The study with the measured profiles on its flanks.
    fn with_profiles(mut self) -> Result<Study, StudyError> {
        for (side, key) in PROFILE_KEYS.into_iter().enumerate() {
            let Some(path) = &self.profiles[side] else {
                continue;
            };
            self.needs_file(key, path, "profile")?;
            let gear = [&mut self.gears.pinion, &mut self.gears.gear]
                .into_iter()
                .nth(side);
            if let Some(gear) = gear {
                gear.set_profile(&profile::load(path, gear)?);
            }
        }
        Ok(self)
    }

    /// The study, if its contact model knows slices, and either these or teeth that differ.
    fn with_slices(self) -> Result<Study, StudyError> {
        let sliced = match self.contact {
            ContactKind::Fem => true,
            // of spur gears an effect across the face is a factor on the load of one section there
            ContactKind::Hertz => self.gears.pinion.helix_angle != 0.0,
            ContactKind::Paper => false,
        };
        if !sliced {
            self.one_section(&format!("contact = \"{}\"", self.contact.name()))?;
        }
        if self.contact != ContactKind::Fem {
            self.refuse_ties()?;
        }
        if self.contact == ContactKind::Paper {
            self.teeth_alike("contact = \"paper\"")?;
        }
        if !self.teeth.are_alike() {
            self.differ_in_one_section()?;
        }
        let of_teeth = |spec: &&EffectSpec| spec.acts_on_teeth();
        if let Some(spec) = self.effects.specs().iter().find(of_teeth) {
            self.one_section(&format!("the effect {}", spec.name))?;
        }
        Ok(self)
    }

    /// Refuses stated ties where the contact model knows no bodies that tie slices; ties that nobody stated are passed over there.
    fn refuse_ties(&self) -> Result<(), StudyError> {
        let key = "face.coupling";
        if self.face.slices > 1
            && self.face.coupling == Coupling::Teeth
            && self.spans.contains_key(key)
        {
            let name = self.contact.name();
            return Err(self.refuse(
                key,
                &format!("ties slices of elastic bodies, and contact = \"{name}\" has none"),
                "\"none\"",
                "leave the key away, or compute by finite elements (contact = \"fem\")",
            ));
        }
        Ok(())
    }

    /// Refuses teeth that differ in a face of slices: at the key that sets them apart where the slices cannot be left away.
    fn differ_in_one_section(&self) -> Result<(), StudyError> {
        let key = self.sets_teeth_apart();
        if self.face.slices < 2 || self.gears.pinion.helix_angle == 0.0 {
            return self.one_section(&format!("{key}: a study with teeth that differ"));
        }
        Err(self.refuse(
            &key,
            "teeth that differ are not computed for helical gears",
            "spur gears, or helical gears without this key",
            "with helix_angle in [face] all teeth of a member are alike: leave the key away",
        ))
    }

    /// The key by which teeth differ.
    fn sets_teeth_apart(&self) -> String {
        let of = |member: &str| {
            let keys = ["pitch_file", "pitch_deviations", "pitch_pattern"];
            keys.map(|key| format!("teeth.{member}.{key}"))
        };
        let mut keys = ["pinion", "gear"].into_iter().flat_map(of);
        let stated = keys.find(|key| self.spans.contains_key(key));
        stated.unwrap_or_else(|| "teeth".to_owned())
    }

    /// Refuses a key that names a file of this kind where there is none.
    fn needs_file(&self, key: &str, path: &Path, kind: &str) -> Result<(), StudyError> {
        if path.is_file() {
            return Ok(());
        }
        Err(self.refuse(
            key,
            &format!("there is no file {}", path.display()),
            &format!("the path of a {kind} file, relative to the study file"),
            "",
        ))
    }

    /// The study with the measured pitch deviations of its teeth.
    fn with_pitches(mut self) -> Result<Study, StudyError> {
        for (side, key) in teeth::PITCH_KEYS.into_iter().enumerate() {
            let Some(path) = &self.pitches[side] else {
                continue;
            };
            self.needs_file(key, path, "pitch")?;
            let gear = [&self.gears.pinion, &self.gears.gear][side];
            let chart = profile::load_pitch(path, gear)?;
            let back = &mut self.teeth.back[side];
            back.resize(chart.len(), 0.0);
            back.iter_mut().zip(chart).for_each(|(b, c)| *b += c);
        }
        Ok(self)
    }

    /// The study with the measured leads of its flanks.
    fn with_leads(mut self) -> Result<Study, StudyError> {
        for (side, key) in face::LEAD_KEYS.into_iter().enumerate() {
            let Some(path) = &self.leads[side] else {
                continue;
            };
            self.needs_file(key, path, "lead")?;
            let rows = profile::load_lead(path, self.gears.face_width, &self.gears.pinion)?;
            self.face.lead[side].measured = rows;
        }
        Ok(self)
    }
}
