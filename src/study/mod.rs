//! Floor 7: the study file. `study.toml` becomes a [`Study`] that is valid by construction, or one [`StudyError`] that
//! shows the place, what was found, what is allowed and a way out. The only reader of TOML.
//!
//! ```text
//! text -> toml tables with spans -> Table (types, ranges, keys) -> sections -> Study
//! ```
//!
//! Inside a `Study` lengths are mm, torques N mm, angles rad; a field whose name ends in a unit keeps that of the file.

mod data;
mod edit;
mod effect;
mod effect_model;
mod face;
mod face_rows;
mod file;
mod formula;
mod free;
mod gears;
mod key_docs;
mod learned;
mod marks;
mod materials;
mod named_files;
mod numerics;
mod operation;
mod profile;
mod quantity;
mod reader;
mod relative;
mod rig;
mod settings;
mod setup;
mod size_limits;
mod teeth;
mod temperature;
mod tests_table;
mod tooth_rows;
mod units;
mod values;

use std::cell::RefCell;
use std::ops::Range;
use std::path::{Path, PathBuf};

use toml::de::DeTable;

use crate::gear::{Face, Teeth};
use crate::source_text;

pub use crate::source_text::{Diagnostic, Fault, Source, TextError as StudyError, nearest};
pub use edit::{Edit, rounded};
pub use effect_model::{EffectModel, EffectSpec, Law, Parameter};
pub use free::{
    COEFFICIENT_BOUNDS, COEFFICIENT_PRIOR, FreeParameter, WEAR_COEFFICIENT, wear_coefficient_fault,
};
pub use gears::Gears;
pub use key_docs::{KEY_DOCS, KeyDoc, Without, schema, unit_of};
pub use learned::LearnedLaw;
pub use materials::{Lubricant, Material, Materials, Thermal};
pub use numerics::{Numerics, Order};
pub use operation::{Operation, Role, Test};
pub use rig::Rig;
pub use settings::{ContactKind, Noise, Outliers, Scatter, Wear};
pub use temperature::Temperatures;

use reader::{Spans, Table, shown};
use tests_table::TestsTable;

/// Keys before the first table and the tables' names.
const ROOT_KEYS: &[&str] = &[
    "title",
    "gears",
    "material",
    "lubricant",
    "thermal",
    "operation",
    "wear",
    "model",
    "fit",
    "noise",
    "effect",
    "test",
    "measurements",
    "face",
    "teeth",
    "rig",
    "numerics",
];

/// Every table with its keys, in the order of the contract.
pub const KEYS: &[(&str, &[&str])] = &[
    ("", &["title"]),
    ("gears", gears::KEYS),
    ("gears.pinion", gears::MEMBER_KEYS),
    ("material", materials::MATERIAL_KEYS),
    ("lubricant", materials::LUBRICANT_KEYS),
    ("thermal", materials::THERMAL_KEYS),
    ("operation", operation::OPERATION_KEYS),
    ("wear", settings::WEAR_KEYS),
    ("wear.pinion", settings::MEMBER_WEAR_KEYS),
    ("model", settings::MODEL_KEYS),
    ("fit", settings::FIT_KEYS),
    ("noise", settings::NOISE_KEYS),
    ("test", operation::TEST_KEYS),
    ("measurements", settings::MEASUREMENTS_KEYS),
    ("face", face::KEYS),
    ("face.pinion", face::MEMBER_KEYS),
    ("teeth", teeth::KEYS),
    ("teeth.pinion", teeth::MEMBER_KEYS),
    ("rig", rig::KEYS),
    ("numerics", numerics::KEYS),
];

/// A valid study.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// The study's own words; empty if it has none.
    pub title: String,
    /// Gear set.
    pub gears: Gears,
    /// Materials of both members.
    pub materials: Materials,
    /// `[lubricant]`.
    pub lubricant: Option<Lubricant>,
    /// `[thermal]`.
    pub thermal: Option<Thermal>,
    /// `[operation]`, with the cycles of `[wear]`.
    pub operation: Operation,
    /// `[wear]`.
    pub wear: Wear,
    /// What depends on the teeth's temperature.
    pub temperatures: Temperatures,
    /// `[model] contact`.
    pub contact: ContactKind,
    /// `[noise]`.
    pub noise: Noise,
    /// `[[test]]`, then the rows of the table of tests.
    pub tests: Vec<Test>,
    /// The measurement file, if one is named.
    pub measurements: Option<PathBuf>,
    /// The table of tests, if one is named; what it holds is in `tests`.
    pub tests_file: Option<PathBuf>,
    /// `[numerics]`.
    pub numerics: Numerics,
    /// `[face]`.
    pub face: Face,
    /// `[teeth]`.
    pub teeth: Teeth,
    /// `[rig]`.
    pub rig: Rig,
    /// Files of the measured profiles of pinion and gear; what they hold is in `gears`.
    pub profiles: [Option<PathBuf>; 2],
    /// Files of the measured leads of pinion and gear; what they hold is in `face`.
    pub leads: [Option<PathBuf>; 2],
    /// Files of the measured pitch deviations of pinion and gear; what they hold is in `teeth`.
    pub pitches: [Option<PathBuf>; 2],
    free: Vec<FreeParameter>,
    effects: EffectModel,
    source: Source,
    spans: Spans,
    tests_table: Option<TestsTable>,
}

type Result<T> = std::result::Result<T, Box<Diagnostic>>;

impl Study {
    /// Reads and checks a study file.
    ///
    /// # Errors
    /// A [`StudyError`] for the first fault: unreadable, not UTF-8, syntax, keys, values, impossible gears.
    pub fn load(path: &Path) -> std::result::Result<Study, StudyError> {
        let study = Study::read(
            source_text::read(path, &file::WANTED)?,
            path.parent().unwrap_or(Path::new("")),
        )?;
        let meshes = [
            ("numerics.mesh_pinion", &study.numerics.mesh_pinion),
            ("numerics.mesh_gear", &study.numerics.mesh_gear),
        ];
        for (key, mesh) in meshes {
            if let Some(mesh) = mesh.as_deref().filter(|mesh| !mesh.is_file()) {
                return Err(study.refuse(
                    key,
                    &format!("there is no file {}", mesh.display()),
                    "the path of a mesh file, relative to the study file",
                    "",
                ));
            }
        }
        Ok(study)
    }

    /// Checks a study's text; `name` stands in messages, and relative paths start from its folder.
    ///
    /// # Errors
    /// As [`Study::load`].
    pub fn parse(text: &str, name: &str) -> std::result::Result<Study, StudyError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text).to_owned();
        Study::read(
            Source {
                name: name.to_owned(),
                text,
            },
            Path::new(name).parent().unwrap_or(Path::new("")),
        )
    }

    /// The conditions of `[operation]`, or of the test with that id.
    ///
    /// # Errors
    /// A [`StudyError`] that names the tests if there is none with that id.
    pub fn conditions(&self, test: Option<&str>) -> std::result::Result<&Operation, StudyError> {
        let Some(id) = test else {
            return Ok(&self.operation);
        };
        if let Some(test) = self.tests.iter().find(|test| test.id == id) {
            return Ok(&test.conditions);
        }
        let ids = self.tests.iter().map(|test| test.id.as_str());
        let hint = match nearest(id, ids.clone()) {
            Some(near) => format!("the nearest is \"{near}\""),
            None => "the study has no [[test]]; leave the test away to use [operation]".to_owned(),
        };
        let allowed: Vec<String> = ids.map(|id| format!("\"{id}\"")).collect();
        let diagnostic = Diagnostic::new(
            Fault::BadValue,
            "test.id",
            format!("the study has no test.id \"{id}\""),
        )
        .with_values(
            format!("\"{id}\""),
            if allowed.is_empty() {
                "none".to_owned()
            } else {
                allowed.join(", ")
            },
        )
        .with_hint(hint);
        Err(match self.spans.get("test") {
            Some(span) => self.error_at(diagnostic, span.clone()),
            None => StudyError::new(diagnostic, self.source.clone()),
        })
    }

    /// `[[effect]]`, in the order of the file.
    pub fn effects(&self) -> &[EffectSpec] {
        self.effects.specs()
    }

    /// The effects, ready to be built.
    pub fn effect_model(&self) -> &EffectModel {
        &self.effects
    }

    /// `[fit] free`: what a fit may adjust, in the order of the file; the wear coefficient alone if the study does not say.
    pub fn free(&self) -> &[FreeParameter] {
        &self.free
    }

    /// The text of the study file.
    pub fn text(&self) -> &str {
        &self.source.text
    }

    /// The conditions of the operation and of every test.
    pub fn all_conditions(&self) -> impl Iterator<Item = &Operation> {
        std::iter::once(&self.operation).chain(self.tests.iter().map(|test| &test.conditions))
    }

    /// A fault that shows later, at the place of `key` (its path in the file: `numerics.mesh_gear`, `test[0].torque`), or of
    /// the nearest table above it that the file has. Empty texts are left out.
    pub fn refuse(&self, key: &str, message: &str, allowed: &str, hint: &str) -> StudyError {
        let stated = self.spans.get(key);
        let found = stated.map_or("no such key here".to_owned(), |span| {
            let (source, span) = self.place(span.clone());
            source.text[span].lines().next().unwrap_or("").to_owned()
        });
        let shown_key = shown(key);
        let diagnostic = Diagnostic::new(
            Fault::Inconsistent,
            shown_key.as_str(),
            format!("{shown_key}: {message}"),
        )
        .with_values(found, allowed)
        .with_hint(hint);
        let above =
            std::iter::successors(Some(key), |path| path.rfind('.').map(|dot| &path[..dot]));
        let span = above
            .filter_map(|path| self.spans.get(path))
            .next()
            .cloned();
        let end = self.source.text.trim_end().len();
        self.error_at(diagnostic, span.unwrap_or(end..end))
    }

    /// In which text a span stands: the study's, or that of its table of tests.
    fn place(&self, span: Range<usize>) -> (Source, Range<usize>) {
        match &self.tests_table {
            Some(table) => table.place(span, &self.source),
            None => (self.source.clone(), span),
        }
    }

    fn error_at(&self, diagnostic: Diagnostic, span: Range<usize>) -> StudyError {
        let (source, span) = self.place(span);
        StudyError::new(diagnostic.with_span(span), source)
    }

    /// Refuses a face in slices for what works on one section.
    ///
    /// # Errors
    /// A [`StudyError`] at `face.slices` if there are more than one.
    pub fn one_section(&self, what: &str) -> std::result::Result<(), StudyError> {
        if self.face.slices < 2 {
            return Ok(());
        }
        let (allowed, hint) = if self.gears.pinion.helix_angle == 0.0 {
            ("1", "leave [face] away for it")
        } else {
            (
                "1, of spur gears",
                "it is not for helical gears: without [face] they would be a spur pair of another size",
            )
        };
        Err(self.refuse(
            "face.slices",
            &format!("{what} works on one section of the face"),
            allowed,
            hint,
        ))
    }

    /// Refuses teeth that differ for what has all teeth alike.
    ///
    /// # Errors
    /// A [`StudyError`] at `teeth` if they do.
    pub fn teeth_alike(&self, what: &str) -> std::result::Result<(), StudyError> {
        if self.teeth.are_alike() && !self.teeth.run_out() {
            return Ok(());
        }
        Err(self.refuse(
            "teeth",
            &format!("{what} has all teeth of a member alike"),
            "no deviations of teeth",
            "leave [teeth] away for it",
        ))
    }

    /// The study's text and the name under which it was read.
    pub fn source(&self) -> &Source {
        &self.source
    }

    fn read(source: Source, folder: &Path) -> std::result::Result<Study, StudyError> {
        let (study, spans) = match Study::sections(&source, folder) {
            Ok(read) => read,
            Err(diagnostic) => return Err(StudyError::new(*diagnostic, source)),
        };
        let Some(path) = &study.tests_file else {
            return Study {
                source,
                spans,
                ..study
            }
            .with_files();
        };
        let table = TestsTable::load(path)?;
        match Study::sections(&table.behind(&source), folder) {
            Ok((study, spans)) => Study {
                source,
                spans,
                tests_table: Some(table),
                ..study
            }
            .with_files(),
            Err(mut diagnostic) => {
                let span = diagnostic.span.take().unwrap_or(0..0);
                let (source, span) = table.place(span, &source);
                Err(StudyError::new(diagnostic.with_span(span), source))
            }
        }
    }

    fn sections(source: &Source, folder: &Path) -> Result<(Study, Spans)> {
        let spans = RefCell::new(Spans::new());
        let document =
            DeTable::parse(&source.text).map_err(|error| file::syntax(source, &error))?;
        size_limits::check(document.get_ref(), "")?;
        let root = Table::root(source, document.get_ref(), ROOT_KEYS, KEYS, &spans)?;
        let title = root.text("title")?.unwrap_or_default().to_owned();
        let gears = gears::read(&root, face::helix_angle(&root)?)?;
        let materials = materials::read(&root)?;
        let lubricant = materials::read_lubricant(&root)?;
        let thermal = materials::read_thermal(&root)?;
        let wear = settings::read_wear(&root)?;
        let temperatures = temperature::read(&root)?;
        let limits = operation::Limits {
            root: &root,
            gears: &gears,
            materials: &materials,
            temperatures: &temperatures,
            warm: temperature::WarmTeeth::read(&root, &materials, lubricant, thermal)?,
        };
        let operation = operation::read(&limits, wear.cycles, lubricant, thermal)?;
        let tests = operation::read_tests(&limits, operation)?;
        let effects = effect::read(&root, lubricant, thermal)?;
        let (face, leads) = face::read(&root, folder, &gears)?;
        let counts = [&gears.pinion, &gears.gear].map(|gear| gear.spec.teeth as usize);
        let (teeth, pitches) = teeth::read(&root, folder, counts)?;
        let study = Study {
            title,
            materials,
            lubricant,
            thermal,
            operation,
            wear,
            temperatures,
            contact: settings::read_model(&root)?,
            free: settings::read_fit(&root, &wear, &effects, &|key| {
                effect::is_stated(key, lubricant, thermal)
            })?,
            noise: settings::read_noise(&root)?,
            effects,
            tests,
            measurements: settings::read_measurements(&root, folder)?,
            tests_file: settings::read_tests_file(&root, folder)?,
            numerics: numerics::read(&root, folder, lubricant)?,
            profiles: gears::profile_files(&root, folder)?,
            face,
            leads,
            teeth,
            rig: rig::read(&root)?,
            pitches,
            gears,
            source: Source {
                name: String::new(),
                text: String::new(),
            },
            spans: Spans::new(),
            tests_table: None,
        };
        drop(document);
        Ok((study, spans.into_inner()))
    }
}

/// A study that states every optional material and oil key, for unit tests.
#[cfg(test)]
pub(crate) const MATERIAL_AND_HEAT: &str =
    include_str!("../../validation/challenges/none_L2/study.toml");
