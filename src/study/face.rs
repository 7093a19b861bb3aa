//! `[face]`: in how many slices the face is computed, and what the flanks lack across it.

use std::path::{Path, PathBuf};

use super::gears::Gears;
use super::quantity as q;
use super::reader::Table;
use super::relative;
use crate::gear::{Coupling, Face, FaceEnds, Lead, Member};
use crate::source_text::{Diagnostic, Fault};

pub(super) const KEYS: &[&str] = &[
    "slices",
    "coupling",
    "ends",
    "helix_angle",
    "pinion",
    "gear",
];
pub(super) const MEMBER_KEYS: &[&str] = &[
    "lead_slope",
    "crowning",
    "end_relief_amount",
    "end_relief_length",
    "lead_file",
];

/// Slices for each base pitch of overlap: depths are then within half a per cent of those of four times as many (guide/face.md).
const SLICES_PER_BASE_PITCH: f64 = 10.0;

/// What couples slices, but for the common turn.
pub(super) const COUPLINGS: &[&str] = &["teeth", "none"];

/// How the face ends.
pub(super) const ENDS: &[&str] = &["free", "held"];

/// The most slices; a slice is then thinner than any measurement resolves.
pub(super) const MOST_SLICES: usize = 201;

/// The keys that name measured leads, pinion and gear.
pub(super) const LEAD_KEYS: [&str; 2] = ["face.pinion.lead_file", "face.gear.lead_file"];

type Result<T> = std::result::Result<T, Box<Diagnostic>>;

/// The helix angle of the pinion at its reference circle, rad.
pub(super) fn helix_angle(root: &Table<'_>) -> Result<f64> {
    let table = root.table("face", KEYS)?;
    let stated = table.map(|table| table.number("helix_angle", &q::HELIX_ANGLE));
    Ok(stated.transpose()?.flatten().unwrap_or(0.0).to_radians())
}

/// The face, and the files of measured leads of pinion and gear.
pub(super) fn read(
    root: &Table<'_>,
    folder: &Path,
    gears: &Gears,
) -> Result<(Face, [Option<PathBuf>; 2])> {
    let width = gears.face_width;
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
    let overlap = (width * gears.pinion.turned_per_mm()).abs();
    let usual = if face.slices > 1 {
        Coupling::Teeth
    } else {
        Coupling::None
    };
    face.coupling = table.choice("coupling", &couplings)?.unwrap_or(usual);
    let ends = [(ENDS[0], FaceEnds::Free), (ENDS[1], FaceEnds::Held)];
    face.ends = table.choice("ends", &ends)?.unwrap_or_default();
    if overlap > 0.0 && face.slices < 2 {
        let mut refusal = table.refuse("helix_angle", "needs slices", "face.slices of 2 or more");
        refusal.fault = Fault::Inconsistent;
        return Err(Box::new(refusal.with_hint(format!(
            "state slices = {} in [face]: sections stand turned along the face, here by {} base pitches from end to end",
            slices_for(overlap),
            q::Short(1e-2 * (1e2 * overlap).round()),
        ))));
    }
    for (side, which) in Member::BOTH.into_iter().enumerate() {
        let Some(member) = table.table(which.name(), MEMBER_KEYS)? else {
            continue;
        };
        (face.lead[side], files[side]) = lead(&member, folder, width)?;
        check_end_relief_is_seen(&member, &face, side, width)?;
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

/// How many slices resolve an overlap of so many base pitches: steps of a tenth of a base pitch or less, and no fewer than for straight leads.
fn slices_for(overlap: f64) -> usize {
    let count = (SLICES_PER_BASE_PITCH * overlap).ceil() as usize;
    count.clamp(11, MOST_SLICES)
}

/// Refuses an end relief that no slice sees: the outermost one stands for the face half its width from the end.
fn check_end_relief_is_seen(table: &Table<'_>, face: &Face, side: usize, width: f64) -> Result<()> {
    let lead = &face.lead[side];
    let half_slice = 0.5 * width / face.slices.max(1) as f64;
    if face.slices < 2 || lead.end_relief == 0.0 || lead.end_relief_length > half_slice {
        return Ok(());
    }
    let says = format!(
        "mm is less than half a slice ({} slices), so that no slice has any of it",
        face.slices
    );
    let allowed = format!(
        "above {} mm with {} slices",
        q::Short((1e4 * half_slice).round() * 1e-4),
        face.slices
    );
    let mut refusal = table.refuse("end_relief_length", &says, allowed);
    refusal.fault = Fault::Inconsistent;
    let slices = (width / lead.end_relief_length).ceil() as usize + 1;
    let hint = match slices <= MOST_SLICES {
        true => format!("slices = {slices} in [face] has a slice within the relief"),
        false => "a relief as short as that is the edge of a face".to_owned(),
    };
    Err(Box::new(refusal.with_hint(hint)))
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
            Some(0.0) => table.refuse(
                "end_relief_length",
                "leaves no length to the relief",
                allowed,
            ),
            Some(_) => {
                let says = format!("mm is too long for a face of {} mm", q::Short(width));
                table.refuse("end_relief_length", &says, allowed)
            }
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
