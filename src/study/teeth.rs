//! `[teeth]`: where the teeth of a member stand.

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use super::quantity as q;
use super::reader::Table;
use super::relative;
use crate::gear::{Hunting, Member, Teeth};
use crate::source_text::{Diagnostic, Fault};

pub(super) const KEYS: &[&str] = &["hunting", "pinion", "gear"];
pub(super) const MEMBER_KEYS: &[&str] = &[
    "pitch_file",
    "pitch_deviations",
    "eccentricity",
    "eccentricity_phase",
    "classes",
];

/// Which mates a tooth meets.
pub(super) const HUNTING: &[&str] = &["average", "full"];

/// The most classes of a member: the time that a history takes grows with their square.
pub(super) const MOST_CLASSES: usize = 64;

/// The keys that name measured pitch charts, pinion and gear.
pub(super) const PITCH_KEYS: [&str; 2] = ["teeth.pinion.pitch_file", "teeth.gear.pitch_file"];

type Result<T> = std::result::Result<T, Box<Diagnostic>>;

/// Where the teeth stand, and the files of measured pitch deviations of pinion and gear; `counts`: their numbers of teeth.
pub(super) fn read(
    root: &Table<'_>,
    folder: &Path,
    counts: [usize; 2],
) -> Result<(Teeth, [Option<PathBuf>; 2])> {
    let mut teeth = Teeth::default();
    let mut files = [None, None];
    let Some(table) = root.table("teeth", KEYS)? else {
        return Ok((teeth, files));
    };
    let choices = [(HUNTING[0], Hunting::Average), (HUNTING[1], Hunting::Full)];
    teeth.hunting = table.choice("hunting", &choices)?.unwrap_or_default();
    let meetings = Teeth::meetings(counts);
    if teeth.hunting == Hunting::Full && meetings > Teeth::MOST_MEETINGS {
        let says = format!("asks for {meetings} different meetings of two teeth");
        let allowed = format!("\"average\"; \"full\" up to {}", Teeth::MOST_MEETINGS);
        let mut refusal = table.refuse("hunting", &says, allowed);
        refusal.fault = Fault::Inconsistent;
        return Err(Box::new(refusal.with_hint(
            "by \"average\" a tooth meets the mean of its mates; the guide says how near that comes",
        )));
    }
    for (side, which) in Member::BOTH.into_iter().enumerate() {
        let Some(member) = table.table(which.name(), MEMBER_KEYS)? else {
            continue;
        };
        teeth.classes[side] = member.count("classes", 1..=MOST_CLASSES, "of each member")?;
        teeth.back[side] = stated(&member, counts[side])?;
        let file = member.name("pitch_file", "relative to the study file")?;
        if file.is_some() && member.has("pitch_deviations") {
            let mut refusal = member.refuse("pitch_file", "is a second pitch chart", "one of them");
            refusal.fault = Fault::Inconsistent;
            return Err(Box::new(refusal.with_hint(
                "pitch_deviations states the deviations in the study itself; leave one of both away",
            )));
        }
        files[side] = file.map(|file| relative::joined(folder, Path::new(file)));
    }
    Ok((teeth, files))
}

/// How far each of `count` teeth stands back as the study itself says, mm; empty where it says nothing.
fn stated(table: &Table<'_>, count: usize) -> Result<Vec<f64>> {
    let mut back = Vec::new();
    if let Some(chart) = table.numbers("pitch_deviations")? {
        if chart.len() != count {
            let says = format!("has {} deviations for {count} teeth", chart.len());
            let allowed = format!("{count} numbers in um, in the order of coming into mesh");
            let mut refusal = table.refuse("pitch_deviations", &says, allowed);
            refusal.fault = Fault::Inconsistent;
            return Err(Box::new(refusal));
        }
        if let Some(bad) = chart.iter().find(|um| !q::PITCH.allows(**um)) {
            let says = format!("holds {} um, which is out of range", q::Short(*bad));
            let refusal = table.refuse("pitch_deviations", &says, q::PITCH.to_string());
            return Err(Box::new(refusal.with_hint(q::PITCH.reason)));
        }
        back = chart.iter().map(|um| 1e-3 * um).collect();
    }
    let eccentricity = table.number("eccentricity", &q::ECCENTRICITY)?;
    let phase = table.number("eccentricity_phase", &q::ECCENTRICITY_PHASE)?;
    match eccentricity {
        Some(um) if um != 0.0 => {
            back.resize(count, 0.0);
            let phase = phase.unwrap_or(0.0).to_radians();
            for (i, back) in back.iter_mut().enumerate() {
                *back += 1e-3 * um * (TAU * i as f64 / count as f64 + phase).cos();
            }
        }
        None if phase.is_some_and(|deg| deg != 0.0) => {
            return Err(Box::new(table.missing("eccentricity", "with its phase")));
        }
        _ => {}
    }
    Ok(back)
}
