//! `[wear]`, `[model]`, `[fit]`, `[noise]`, `[measurements]`: what is computed and what may be adjusted.

use std::path::{Path, PathBuf};

use toml::de::DeValue;

use super::effect_model::EffectModel;
use super::free::{COEFFICIENT_PRIOR, FreeParameter, WEAR_COEFFICIENT};
use super::quantity as q;
use super::reader::Table;
use super::relative;
use crate::effects::Prior;
use crate::material::{WEAR_PAIRS, WearPair, wear_pair};
use crate::source_text::{Diagnostic, Fault, list, nearest};

pub(super) const WEAR_KEYS: &[&str] = &[
    "coefficient",
    "material",
    "cycles",
    "temperatures",
    "factors",
];
/// Of `[wear.pinion]` and `[wear.gear]`.
pub(super) const MEMBER_WEAR_KEYS: &[&str] = &["coefficient", "material"];
/// `[wear]` with the tables in it.
pub(super) const WEAR_TABLE_KEYS: &[&str] = &[
    "coefficient",
    "material",
    "cycles",
    "temperatures",
    "factors",
    "pinion",
    "gear",
];
pub(super) const MODEL_KEYS: &[&str] = &["contact"];
pub(super) const FIT_KEYS: &[&str] = &["free"];
pub(super) const NOISE_KEYS: &[&str] = &[
    "coefficient_scatter",
    "datum",
    "trace_tilt",
    "trace_shift",
    "new_profile",
    "outliers",
];
pub(super) const MEASUREMENTS_KEYS: &[&str] = &["file", "tests"];

/// `[wear]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wear {
    /// Specific wear coefficient k = K/H, mm²/N: of both members unless `[wear.pinion]` or `[wear.gear]` state their own. A fit adjusts it, and
    /// members' own go with it in proportion.
    pub coefficient: f64,
    /// Wear coefficient of pinion and gear over `coefficient`.
    pub members: [f64; 2],
    /// Length of the run, pinion revolutions.
    pub cycles: f64,
    /// The published pair of materials whose k is the prior, if one is named.
    pub material: Option<&'static WearPair>,
}

impl Wear {
    /// Prior of the coefficient.
    pub fn prior(&self) -> Prior {
        self.material
            .map_or(COEFFICIENT_PRIOR, |pair| Prior::LogNormal {
                median: pair.coefficient,
                spread: pair.spread,
            })
    }
}

/// `[model] contact`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContactKind {
    /// Finite elements.
    Fem,
    /// Analytic line contact with load sharing by tooth stiffness.
    Hertz,
    /// The published model, mistakes included.
    Paper,
}

impl ContactKind {
    /// The word in the study file.
    pub const fn name(self) -> &'static str {
        match self {
            ContactKind::Fem => "fem",
            ContactKind::Hertz => "hertz",
            ContactKind::Paper => "paper",
        }
    }
}

/// `[noise]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// Scatter of k between tests.
    pub coefficient_scatter: Scatter,
    /// Prior standard deviation of a trace's unknown constant datum, µm.
    pub datum_um: f64,
    /// Prior standard deviation of a trace's unknown tilt from end to end, µm.
    pub tilt_um: f64,
    /// Prior standard deviation of the unknown shift of a trace's radii, mm.
    pub shift_mm: f64,
    /// Standard deviation of the scatter of the new profile that all depths of a flank were taken from, µm.
    pub new_profile_um: f64,
    /// What becomes of rows that stand apart from their neighbours.
    pub outliers: Outliers,
}

/// What becomes of measured rows that stand apart from their neighbours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outliers {
    /// They are reported and count as they are.
    Report,
    /// They are reported and count with a σ as large as they stand apart.
    Robust,
}

/// Scatter of the wear coefficient between tests.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scatter {
    /// Estimated from the measurements.
    Estimate,
    /// Known: relative standard deviation, 0 = none.
    Relative(f64),
}

type Result<T> = std::result::Result<T, Box<Diagnostic>>;

pub(super) fn read_wear(root: &Table<'_>) -> Result<Wear> {
    let table = root.required_table("wear", WEAR_TABLE_KEYS)?;
    let material = material(&table)?;
    let coefficient = coefficient(&table, material)?;
    let mut members = [1.0; 2];
    for (factor, member) in members.iter_mut().zip(["pinion", "gear"]) {
        let Some(own) = table.table(member, MEMBER_WEAR_KEYS)? else {
            continue;
        };
        let own = self::coefficient(&own, self::material(&own)?)?;
        if coefficient <= 0.0 {
            return Err(Box::new(table.refuse(
                "coefficient",
                "is the scale of a member's own and cannot be 0",
                "above 0 mm2/N",
            )));
        }
        *factor = own / coefficient;
    }
    Ok(Wear {
        coefficient,
        members,
        cycles: table.required_number("cycles", &q::CYCLES)?,
        material,
    })
}

/// The coefficient that a table states, else that of its pair of materials.
fn coefficient(table: &Table<'_>, material: Option<&WearPair>) -> Result<f64> {
    match material {
        Some(pair) => {
            Ok((table.number("coefficient", &q::WEAR_COEFFICIENT)?).unwrap_or(pair.coefficient))
        }
        None => table.required_number("coefficient", &q::WEAR_COEFFICIENT),
    }
}

/// The pair of materials that a table names.
fn material(table: &Table<'_>) -> Result<Option<&'static WearPair>> {
    let Some(name) = table.text("material")? else {
        return Ok(None);
    };
    if let Some(pair) = wear_pair(name) {
        return Ok(Some(pair));
    }
    let names = || WEAR_PAIRS.iter().map(|pair| pair.name);
    let near = nearest(name, names()).unwrap_or_default();
    Err(Box::new(
        table
            .refuse("material", "is no pair of materials", list(names()))
            .with_hint(format!("the nearest is \"{near}\""))
            .with_hint("`gearwear materials` says where each is from"),
    ))
}

pub(super) fn read_model(root: &Table<'_>) -> Result<ContactKind> {
    let kinds =
        [ContactKind::Fem, ContactKind::Hertz, ContactKind::Paper].map(|kind| (kind.name(), kind));
    let table = root.table("model", MODEL_KEYS)?;
    let kind = table.map_or(Ok(None), |table| table.choice("contact", &kinds))?;
    Ok(kind.unwrap_or(ContactKind::Fem))
}

/// `[fit] free`, each name looked up among the study's parameters; `states` tells which optional keys the study has.
pub(super) fn read_fit(
    root: &Table<'_>,
    wear: &Wear,
    effects: &EffectModel,
    states: &dyn Fn(&str) -> bool,
) -> Result<Vec<FreeParameter>> {
    let coefficient = FreeParameter::wear_coefficient(wear);
    let names = root.table("fit", FIT_KEYS)?;
    let Some((table, names)) = names.map_or(Ok(None), |table| {
        table.texts("free").map(|names| names.map(|n| (table, n)))
    })?
    else {
        return Ok(vec![coefficient]);
    };
    let mut free: Vec<FreeParameter> = Vec::new();
    for (name, span) in names {
        let refusal = |says: &str| {
            let known = effects
                .parameters()
                .map(|parameter| parameter.name.as_str());
            let allowed: Vec<&str> = std::iter::once(WEAR_COEFFICIENT).chain(known).collect();
            let quoted = |name: &str| format!("\"{name}\"");
            let words: Vec<String> = allowed.iter().map(|name| quoted(name)).collect();
            let mut refusal = table.refuse("free", "", words.join(", "));
            refusal.message = format!("fit.free: \"{name}\" {says}");
            refusal.found = quoted(name);
            refusal.span = Some(span.clone());
            let near = nearest(name, allowed).unwrap_or_default();
            Box::new(refusal.with_hint(format!("the nearest is \"{near}\"")))
        };
        if free.iter().any(|parameter| parameter.name == name) {
            return Err(refusal("stands there twice"));
        }
        if let Some(law) = effects.learned(name) {
            let all = law.fitted();
            let prefix = format!("{name}.");
            if free
                .iter()
                .any(|parameter| parameter.name.starts_with(&prefix))
            {
                return Err(refusal("stands there twice"));
            }
            if all.is_empty() {
                return Err(refusal("is a learned depth, which no fit adjusts"));
            }
            free.extend(all);
            continue;
        }
        free.push(match effects.parameter(name) {
            Some(parameter) => {
                let parameter = parameter.free();
                // a value that switches a part of the effect off may be a fit's start no longer
                let needs = effects.needs_with(&parameter);
                if let Some(key) = needs.into_iter().find(|key| !states(key)) {
                    return Err(refusal(&format!(
                        "needs {key}, which the study does not state"
                    )));
                }
                parameter
            }
            None if name == WEAR_COEFFICIENT => coefficient.clone(),
            None => return Err(refusal("is no parameter of this study")),
        });
    }
    Ok(free)
}

pub(super) fn read_noise(root: &Table<'_>) -> Result<Noise> {
    let mut noise = Noise {
        coefficient_scatter: Scatter::Estimate,
        datum_um: 0.5,
        tilt_um: 0.0,
        shift_mm: 0.0,
        new_profile_um: 0.0,
        outliers: Outliers::Report,
    };
    let Some(table) = root.table("noise", NOISE_KEYS)? else {
        return Ok(noise);
    };
    let scatter = "coefficient_scatter";
    match table.get(scatter) {
        None => {}
        Some((DeValue::String(_), _)) => {
            let word = table.choice(scatter, &[("estimate", Scatter::Estimate)]);
            noise.coefficient_scatter = word
                .map_err(|mut refusal| {
                    refusal.allowed = format!("\"estimate\" or a number, {}", q::SCATTER);
                    refusal
                })?
                .unwrap_or(Scatter::Estimate);
        }
        Some(_) => {
            let number = table
                .required_number(scatter, &q::SCATTER)
                .map_err(|mut refusal| {
                    if refusal.fault == Fault::WrongType {
                        refusal.allowed = format!("\"estimate\" or {}", refusal.allowed);
                    }
                    refusal
                })?;
            noise.coefficient_scatter = Scatter::Relative(number);
        }
    }
    noise.datum_um = table.number("datum", &q::DATUM)?.unwrap_or(noise.datum_um);
    noise.tilt_um = table
        .number("trace_tilt", &q::TILT)?
        .unwrap_or(noise.tilt_um);
    noise.shift_mm = (table.number("trace_shift", &q::SHIFT)?).unwrap_or(noise.shift_mm);
    noise.new_profile_um =
        (table.number("new_profile", &q::NEW_PROFILE)?).unwrap_or(noise.new_profile_um);
    let outliers = [("report", Outliers::Report), ("robust", Outliers::Robust)];
    noise.outliers = (table.choice("outliers", &outliers)?).unwrap_or(noise.outliers);
    Ok(noise)
}

/// The measurement file's path, relative ones from the study's folder. It is not opened here.
pub(super) fn read_measurements(root: &Table<'_>, folder: &Path) -> Result<Option<PathBuf>> {
    let Some(table) = root.table("measurements", MEASUREMENTS_KEYS)? else {
        return Ok(None);
    };
    let what = "relative to the study file";
    match table.name("file", what)? {
        Some(file) => Ok(Some(folder.join(file))),
        // tests that are still to be measured
        None if table.has("tests") => Ok(None),
        None => Err(Box::new(
            table
                .missing("file", "a text, the measurements' file name")
                .with_hint(what),
        )),
    }
}

/// `[measurements] tests`: a table of tests.
pub(super) fn read_tests_file(root: &Table<'_>, folder: &Path) -> Result<Option<PathBuf>> {
    let Some(table) = root.table("measurements", MEASUREMENTS_KEYS)? else {
        return Ok(None);
    };
    let file = table.name("tests", "relative to the study file")?;
    Ok(file.map(|file| relative::joined(folder, Path::new(file))))
}
