//! `[face]`: in how many slices the face is computed, and what the flanks lack across it.

use std::path::{Path, PathBuf};

use super::quantity as q;
use super::reader::Table;
use super::relative;
use crate::gear::{Coupling, Face, Lead, Member};
use crate::source_text::{Diagnostic, Fault};

pub(super) const KEYS: &[&str] = &["slices", "coupling", "helix_angle", "pinion", "gear"];
pub(super) const MEMBER_KEYS: &[&str] = &[
    "lead_slope",
    "crowning",
    "end_relief_amount",
    "end_relief_length",
    "lead_file",
];

/// What couples slices, but for the common turn.
pub(super) const COUPLINGS: &[&str] = &["teeth", "none"];

/// The most slices; a slice is then thinner than any measurement resolves.
pub(super) const MOST_SLICES: usize = 201;

/// The keys that name measured leads, pinion and gear.
pub(super) const LEAD_KEYS: [&str; 2] = ["face.pinion.lead_file", "face.gear.lead_file"];

type Result<T> = std::result::Result<T, Box<Diagnostic>>;

/// The face, and the files of measured leads of pinion and gear.
pub(super) fn read(
    root: &Table<'_>,
    folder: &Path,
    width: f64,
) -> Result<(Face, [Option<PathBuf>; 2])> {
    let mut face = Face::default();
    let mut files = [None, None];
    let Some(table) = root.table("face", KEYS)? else {
        return Ok((face, files));
    };
    let why = "sections across the face; 11 are enough for straight and crowned leads";
    face.slices = table.count("slices", 1..=MOST_SLICES, why)?.unwrap_or(0);
    let couplings = [
        (COUPLINGS[0], Coupling::Teeth),
        (COUPLINGS[1], Coupling::None),
    ];
    face.coupling = table.choice("coupling", &couplings)?.unwrap_or_default();
    table
        .number("helix_angle", &q::HELIX_ANGLE)
        .map_err(|refusal| {
            refusal.with_hint("gears are spur gears: helical teeth are not modelled")
        })?;
    for (side, which) in Member::BOTH.into_iter().enumerate() {
        let Some(member) = table.table(which.name(), MEMBER_KEYS)? else {
            continue;
        };
        (face.lead[side], files[side]) = lead(&member, folder, width)?;
        let states = !face.lead[side].is_none() || files[side].is_some();
        let key = MEMBER_KEYS.iter().find(|key| states && member.has(key));
        if let (0 | 1, Some(key)) = (face.slices, key) {
            let mut refusal = member.refuse(key, "needs slices", "face.slices of 2 or more");
            refusal.fault = Fault::Inconsistent;
            let hint = "state slices = 11 in [face]; one section knows nothing of the face";
            return Err(Box::new(refusal.with_hint(hint)));
        }
    }
    Ok((face, files))
}

fn lead(table: &Table<'_>, folder: &Path, width: f64) -> Result<(Lead, Option<PathBuf>)> {
    let um = |key| Ok::<f64, Box<Diagnostic>>(1e-3 * table.number(key, &q::LEAD)?.unwrap_or(0.0));
    let end_relief = um("end_relief_amount")?;
    let stated = table.number("end_relief_length", &q::END_RELIEF_LENGTH)?;
    let length = stated.unwrap_or(0.0);
    if (end_relief != 0.0 && length == 0.0) || length > 0.5 * width {
        let allowed = format!(
            "above 0, up to {} mm: half of the face",
            q::Short(0.5 * width)
        );
        let mut fault = match stated {
            Some(_) => table.refuse("end_relief_length", "", allowed),
            None => table.missing("end_relief_length", &allowed),
        };
        fault.fault = Fault::Inconsistent;
        return Err(Box::new(fault));
    }
    let lead = Lead {
        slope: um("lead_slope")?,
        crowning: um("crowning")?,
        end_relief,
        end_relief_length: length,
        measured: Vec::new(),
    };
    let file = table.name("lead_file", "relative to the study file")?;
    let file = file.map(|file| relative::joined(folder, Path::new(file)));
    Ok((lead, file))
}
