//! What a sweep tells: its document, its table as a file and as a person reads it.

use serde_json::json;

use super::design::Design;
use super::figures::Outputs;
use super::grid;
use super::points::{Point, Result};
use crate::numeric::written::{plain, significant};
use crate::simulate::result::Member;

/// The document of a sweep.
pub(super) fn document(
    title: &str,
    design: &Design,
    points: &[Point],
    results: &[Result],
) -> serde_json::Value {
    let rows = points.iter().zip(results).map(|(point, result)| {
        let varied: serde_json::Map<String, serde_json::Value> = (design.keys.iter())
            .zip(&point.values)
            .map(|(key, value)| (key.clone(), grid::json(value)))
            .collect();
        let mut row = json!({"key": point.key, "values": varied});
        match result {
            Ok(figures) => row["figures"] = json!(figures),
            Err(error) => row["error"] = json!(error),
        }
        row
    });
    let (vary, kind) = design.documents();
    let mut document = json!({
        "title": title,
        "vary": vary,
        "points": rows.collect::<Vec<_>>(),
    });
    if let Some(kind) = kind {
        document["design"] = kind;
    }
    document
}

/// The table of a sweep, `sweep.csv`.
pub(super) fn csv(
    design: &Design,
    outputs: &Outputs,
    points: &[Point],
    results: &[Result],
) -> String {
    let quoted = |text: &str| {
        if text.contains([',', '"', '\n']) {
            format!("\"{}\"", text.replace('"', "\"\"").replace('\n', " "))
        } else {
            text.to_owned()
        }
    };
    let reason = |text: &str| quoted(text.lines().next().unwrap_or_default());
    let heads = design.keys.iter().map(|key| quoted(key));
    let columns = &outputs.columns;
    let figures = columns.iter().map(|column| column.name.to_owned());
    let head: Vec<String> = heads.chain(figures).chain(["error".to_owned()]).collect();
    let mut out = head.join(",") + "\n";
    for (point, result) in points.iter().zip(results) {
        let mut row: Vec<String> = point.values.iter().map(|value| quoted(value)).collect();
        row.extend(columns.iter().map(|column| {
            let value = result
                .as_ref()
                .ok()
                .and_then(|figures| figures.value(column));
            value.map_or(String::new(), |value| value.to_string())
        }));
        row.push(result.as_ref().err().map_or(String::new(), |e| reason(e)));
        out += &(row.join(",") + "\n");
    }
    out
}

/// The wear profiles of all points, `wear_profiles.csv`; points are numbered from 1 as in `sweep.csv`.
pub(super) fn profiles(members: &[Member], results: &[Result]) -> String {
    let mut out =
        "# radius: mm, depth: um normal to the flank\npoint,member,radius,depth\n".to_owned();
    for (number, figures) in results.iter().enumerate() {
        let Ok(figures) = figures else { continue };
        for &member in members {
            let Some(profile) = figures.profile(member) else {
                continue;
            };
            for (radius, depth) in profile.radius.iter().zip(&profile.depth) {
                out += &format!("{},{},{radius},{depth}\n", number + 1, member.name());
            }
        }
    }
    out
}

/// Most points that a person reads.
const MOST_SHOWN: usize = 200;

/// The table as a person reads it.
pub(super) fn table(
    design: &Design,
    outputs: &Outputs,
    points: &[Point],
    results: &[Result],
) -> String {
    let columns = &outputs.columns;
    let heads = design.keys.iter().map(|key| with_unit(key));
    let mut lines: Vec<Vec<String>> = vec![
        heads
            .chain(columns.iter().map(|column| column.head.to_owned()))
            .collect(),
    ];
    for (point, result) in points.iter().zip(results).take(MOST_SHOWN) {
        let mut line: Vec<String> = point.values.iter().map(|value| readable(value)).collect();
        match result {
            Ok(figures) => line.extend(columns.iter().map(|column| {
                figures
                    .value(column)
                    .map_or("-".to_owned(), |value| significant(value, 4))
            })),
            Err(error) => line.push(reason(error)),
        }
        lines.push(line);
    }
    let cells = lines[0].len();
    let width = |column: usize| {
        // a failure's words may stand out of their column
        let whole = lines
            .iter()
            .filter(|line| line.len() == cells || column < design.keys.len());
        let widths = whole.filter_map(|line| line.get(column));
        widths.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..cells).map(width).collect();
    let more = points.len().saturating_sub(MOST_SHOWN);
    let rest = (more > 0).then(|| format!("  ... and {more} more points in sweep.csv\n"));
    lines
        .iter()
        .map(|line| {
            let cells = line.iter().zip(&widths);
            let padded: Vec<String> = cells.map(|(cell, w)| format!("{cell:>w$}")).collect();
            format!("  {}\n", padded.join("  "))
        })
        .chain(rest)
        .collect()
}

/// The end of a key with its unit: `torque, N m`.
pub(super) fn with_unit(key: &str) -> String {
    let name = key.rsplit('.').next().unwrap_or(key);
    match crate::study::unit_of(key) {
        None | Some("" | "-" | "1") => name.to_owned(),
        Some(unit) => format!("{name}, {}", unit.replacen("um", "µm", 1)),
    }
}

/// A value as people read it: 1.0·10⁻¹⁰ rather than nine zeros.
fn readable(value: &str) -> String {
    match value.parse::<f64>() {
        Ok(number) if number != 0.0 && !(1e-4..1e7).contains(&number.abs()) => plain(number),
        _ => value.to_owned(),
    }
}

/// Why there are no figures, without the values that stand beside it.
fn reason(error: &str) -> String {
    let first = error.lines().next().unwrap_or_default();
    match first
        .strip_prefix("--vary ")
        .or_else(|| first.strip_prefix("--points "))
        .and_then(|rest| rest.split_once(": "))
    {
        Some((_, why)) => format!("none: {why}"),
        None => format!("failed: {first}"),
    }
}
