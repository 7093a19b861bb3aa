//! The comparison as a few lines for the terminal.
use std::path::Path;

use super::{conclusions, decimals, published_gear_speed, signed};
use crate::numeric::written::{count, fixed, significant};
use crate::simulate::models::{Comparison, Kind, Ladder, Means, Mounted, Quantity};

/// Mean wear of both flanks by part of the path of contact, what changes it, and where the files are.
pub fn summary(title: &str, comparison: &Comparison, folder: &Path) -> String {
    let c = &comparison.conditions;
    let mut lines = Vec::new();
    if !title.is_empty() {
        lines.push(title.to_owned());
    }
    lines.push(format!(
        "{} and {} teeth, {} N·m at {} rpm, {} pinion revolutions",
        comparison.teeth[0],
        comparison.teeth[1],
        significant(c.torque / 1000.0, 4),
        count(c.speed),
        count(c.cycles)
    ));
    lines.push(String::new());
    lines.extend(conclusions(comparison));
    for mounted in &comparison.mounted {
        lines.push(String::new());
        lines.push(format!(
            "misalignment {} mm, contact ratio {}",
            mounted.misalignment,
            significant(mounted.geometry.contact_ratio, 4)
        ));
        table(&mut lines, mounted, Quantity::DepthPinion);
        table(&mut lines, mounted, Quantity::DepthGear);
    }
    lines.push(String::new());
    if comparison
        .mounted
        .iter()
        .any(|m| m.model(Kind::Paper).is_some())
    {
        lines.push(format!(
            "Gear speed in the published model: {}.",
            published_gear_speed(comparison)
        ));
    }
    lines.push(String::new());
    lines.push(format!("page:    {}", folder.join("report.html").display()));
    lines.push(format!("figures: {}", folder.join("models.json").display()));
    lines.push(format!("plots:   {}", folder.join("plots").display()));
    lines.push(String::new());
    lines.join("\n")
}

const FIRST: usize = 30;
const COLUMN: usize = 13;

/// The ladders that have `quantity`: models with their means, rungs with what they change.
fn table(lines: &mut Vec<String>, mounted: &Mounted, quantity: Quantity) {
    let ladders: Vec<(&Ladder, usize)> = mounted
        .ladders
        .iter()
        .filter_map(|l| Some((l, l.start.iter().position(|m| m.quantity == quantity)?)))
        .collect();
    if ladders.is_empty() {
        return;
    }
    let is_zero = |ladder: &Ladder, column: usize| {
        ladder.start[column].whole == 0.0 && ladder.end[column].whole == 0.0
    };
    if (ladders.iter()).all(|(ladder, column)| is_zero(ladder, *column)) {
        lines.push(format!("  {}: none", quantity.label()));
        return;
    }
    let row = |first: String, cells: Vec<String>| {
        let cells: String = cells
            .iter()
            .map(|cell| format!("{cell:>COLUMN$}"))
            .collect();
        format!("{first:<FIRST$}{cells}")
    };
    let digits = decimals(mounted, quantity);
    let numbers = |means: &Means, written: fn(f64, usize) -> String| {
        let all = means.regions.iter().chain(std::iter::once(&means.whole));
        all.map(|v| written(*v, digits)).collect::<Vec<_>>()
    };
    let mut head: Vec<String> = mounted
        .spans
        .iter()
        .map(|s| s.region.name().to_owned())
        .collect();
    head.push("whole path".to_owned());
    lines.push(row(
        format!("  {}, {}", quantity.label(), quantity.unit()),
        head,
    ));
    for (place, (ladder, column)) in ladders.iter().enumerate() {
        if place == 0 {
            lines.push(row(
                format!("    {}", ladder.from.name()),
                numbers(&ladder.start[*column], fixed),
            ));
        }
        for rung in &ladder.rungs {
            lines.push(row(
                format!("      {}", rung.cause.label()),
                numbers(&rung.changes[*column], signed),
            ));
        }
        lines.push(row(
            format!("    {}", ladder.to.name()),
            numbers(&ladder.end[*column], fixed),
        ));
    }
}
