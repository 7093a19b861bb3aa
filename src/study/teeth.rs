//! `[teeth]`: where the teeth of a member stand.

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
    "pitch_pattern",
    "eccentricity",
    "eccentricity_phase",
    "classes",
];

/// Which mates a tooth meets.
pub(super) const HUNTING: &[&str] = &["average", "full"];

/// What a class is, where a number of them is refused.
const CLASSES: &str = "a class is a group of teeth that wear alike; without the key there are as many as kinds of teeth";

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
        teeth.classes[side] = member.count("classes", 1..=MOST_CLASSES, CLASSES)?;
        teeth.back[side] = stated(&member, counts[side])?;
        teeth.eccentricity[side] = eccentricity(&member)?;
        let file = member.name("pitch_file", "relative to the study file")?;
        let charts = ["pitch_deviations", "pitch_pattern", "pitch_file"];
        let mut charts = charts.into_iter().filter(|key| member.has(key));
        if let (Some(first), Some(second)) = (charts.next(), charts.next()) {
            let mut refusal = member.refuse(second, "is a second pitch chart", "one of them");
            refusal.fault = Fault::Inconsistent;
            return Err(Box::new(refusal.with_hint(format!(
                "{first} says where the teeth stand already; leave one of both away"
            ))));
        }
        files[side] = file.map(|file| relative::joined(folder, Path::new(file)));
    }
    Ok((teeth, files))
}

/// How far each of `count` teeth stands back as the study itself says, mm; empty where it says nothing.
fn stated(table: &Table<'_>, count: usize) -> Result<Vec<f64>> {
    let mut back = Vec::new();
    if let Some(chart) = deviations(table, "pitch_deviations")? {
        if chart.len() != count {
            let says = format!("has {} deviations for {count} teeth", chart.len());
            let allowed = format!("{count} numbers in µm, in the order of coming into mesh");
            let mut refusal = table.refuse("pitch_deviations", &says, allowed);
            refusal.fault = Fault::Inconsistent;
            return Err(Box::new(refusal));
        }
        back = chart;
    }
    if let Some(pattern) = deviations(table, "pitch_pattern")? {
        if !(2..=count).contains(&pattern.len()) {
            let says = format!("has {} deviations", pattern.len());
            let allowed = format!("2 to {count} numbers in µm, repeated around the teeth");
            let mut refusal = table.refuse("pitch_pattern", &says, allowed);
            refusal.fault = Fault::Inconsistent;
            return Err(Box::new(refusal));
        }
        back = pattern.into_iter().cycle().take(count).collect();
    }
    Ok(back)
}

/// The deviations that a key states, mm.
fn deviations(table: &Table<'_>, key: &'static str) -> Result<Option<Vec<f64>>> {
    let Some(chart) = table.numbers(key)? else {
        return Ok(None);
    };
    if let Some(bad) = chart.iter().find(|um| !q::PITCH.allows(**um)) {
        let says = format!("holds {} µm, which is out of range", q::Short(*bad));
        let refusal = table.refuse(key, &says, q::PITCH.to_string());
        return Err(Box::new(refusal.with_hint(q::PITCH.reason)));
    }
    Ok(Some(chart.iter().map(|um| 1e-3 * um).collect()))
}

/// How far the axis lies off, mm, and its phase, rad.
fn eccentricity(table: &Table<'_>) -> Result<[f64; 2]> {
    let amount = table.number("eccentricity", &q::ECCENTRICITY)?;
    let phase = table.number("eccentricity_phase", &q::ECCENTRICITY_PHASE)?;
    if amount.is_none() && phase.is_some_and(|deg| deg != 0.0) {
        let refusal = table.missing("eccentricity", &q::ECCENTRICITY.to_string());
        return Err(Box::new(refusal.with_hint(
            "eccentricity_phase is the phase of an eccentricity; state both or none",
        )));
    }
    Ok([
        1e-3 * amount.unwrap_or(0.0),
        phase.unwrap_or(0.0).to_radians(),
    ])
}
