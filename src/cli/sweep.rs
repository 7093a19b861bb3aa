//! `gearwear sweep`: the same study over a grid of values, every point a whole run, one table and one picture.

mod figures;
mod grid;
mod kept;
mod points;

use clap::Args;
use serde_json::json;

use super::args::StudyAndOutput;
use super::folder;
use super::progress::Progress;
use super::{CliError, Context, Outcome};
use crate::report::Staging;
use crate::report::format::{plain, significant};
use crate::report::plots::sweep_picture;
use crate::study::Study;
use figures::COLUMNS;
use grid::Axis;
use kept::Kept;
use points::{Point, Result};

/// Arguments of `sweep`.
#[derive(Debug, Args)]
#[command(
    after_help = "Values are a list, 0,0.5,1, or a range with its number of points, 50..200:4 (50..200:4:log for equal ratios).\nSeveral --vary give every combination. A swept key may be any of the study's tables, or an effect's parameter\n(running_in.amplitude). Keys that shape the teeth (tip_relief_amount, profile_shift)\nor their material mesh both gears anew at every value; effects such as tip_relief do not.\nAn interrupted sweep goes on with --resume; points that are done are not computed again,\nalso when values were added.\n\nExamples:\n  gearwear sweep study.toml --vary operation.misalignment=0,0.25,0.5,1 --vary operation.torque=50..200:4\n  gearwear sweep study.toml --vary gears.pinion.profile_shift=-0.2..0.4:7 --resume\n  gearwear sweep study.toml --vary model.contact=fem,hertz --json"
)]
pub struct SweepArgs {
    #[command(flatten)]
    paths: StudyAndOutput,
    /// A key and its values; may be given several times
    #[arg(long, value_name = "KEY=VALUES", required = true, value_parser = grid::axis)]
    vary: Vec<Axis>,
    /// Keep the points that an interrupted or finished sweep into the same folder has done
    #[arg(long)]
    resume: bool,
}

/// Checks every point before any is computed, computes what is not kept, writes.
pub(super) fn execute(
    args: &SweepArgs,
    context: &Context,
) -> std::result::Result<Outcome, CliError> {
    let study = Study::load(&args.paths.study)?;
    let points = points::prepare(&study, &args.vary)?;
    let target = args
        .paths
        .output
        .clone()
        .unwrap_or_else(|| folder::default_path(&args.paths.study, "sweep"));
    folder::check(&target, &args.paths.study, &study)?;
    let kept = Kept::open(&target, args.resume)?;
    let progress = context.progress("sweep");
    let (results, reused) = points::compute(&points, &kept, &progress)?;
    let impossible = points.iter().filter(|point| !point.is_possible()).count();
    let failures = results.iter().filter(|result| result.is_err()).count() - impossible;
    let document = document(&study.title, &args.vary, &points, &results);
    let mut staging = Staging::begin(&target)?;
    staging.write("sweep.csv", csv(&args.vary, &points, &results).as_bytes())?;
    staging.write(
        "sweep.json",
        &crate::report::json::text("sweep.json", &document)?,
    )?;
    let drawn = drawn(&args.vary, &points, &results);
    if let Some(svg) = sweep_picture(&study.title, &with_unit(&args.vary[0].key), &drawn)? {
        staging.write("sweep.svg", svg.as_bytes())?;
    }
    let folder = staging.commit()?;
    kept.discard();
    let mut text = table(&args.vary, &points, &results);
    if reused > 0 {
        text += &format!("{reused} of {} points were done already\n", points.len());
    }
    if impossible > 0 {
        text += &format!(
            "{impossible} of {} points are no pair that runs; the column error says why\n",
            points.len()
        );
    }
    if failures > 0 {
        text += &format!("{failures} of {} points failed\n", points.len());
    }
    text += &format!(
        "Written to {}\n  sweep.csv, sweep.json, sweep.svg\n",
        folder.display()
    );
    Ok(Outcome {
        json: document,
        text,
        success: failures == 0,
    })
}

fn document(title: &str, axes: &[Axis], points: &[Point], results: &[Result]) -> serde_json::Value {
    let rows = points.iter().zip(results).map(|(point, result)| {
        let varied: serde_json::Map<String, serde_json::Value> = axes
            .iter()
            .zip(&point.values)
            .map(|(axis, value)| (axis.key.clone(), grid::json(value)))
            .collect();
        let mut row = json!({"key": point.key, "values": varied});
        match result {
            Ok(figures) => row["figures"] = json!(figures),
            Err(error) => row["error"] = json!(error),
        }
        row
    });
    json!({
        "title": title,
        "vary": axes.iter().map(|axis| json!({
            "key": axis.key, "values": axis.values.iter().map(|v| grid::json(v)).collect::<Vec<_>>(),
        })).collect::<Vec<_>>(),
        "points": rows.collect::<Vec<_>>(),
    })
}

fn csv(axes: &[Axis], points: &[Point], results: &[Result]) -> String {
    let quoted = |text: &str| {
        if text.contains([',', '"', '\n']) {
            format!("\"{}\"", text.replace('"', "\"\"").replace('\n', " "))
        } else {
            text.to_owned()
        }
    };
    let reason = |text: &str| quoted(text.lines().next().unwrap_or_default());
    let heads = axes.iter().map(|axis| quoted(&axis.key));
    let figures = COLUMNS.iter().map(|column| column.name.to_owned());
    let head: Vec<String> = heads.chain(figures).chain(["error".to_owned()]).collect();
    let mut out = head.join(",") + "\n";
    for (point, result) in points.iter().zip(results) {
        let mut row: Vec<String> = point.values.iter().map(|value| quoted(value)).collect();
        row.extend(COLUMNS.iter().map(|column| {
            let value = result.as_ref().ok().and_then(column.of);
            value.map_or(String::new(), |value| value.to_string())
        }));
        row.push(result.as_ref().err().map_or(String::new(), |e| reason(e)));
        out += &(row.join(",") + "\n");
    }
    out
}

fn table(axes: &[Axis], points: &[Point], results: &[Result]) -> String {
    let heads = axes.iter().map(|axis| with_unit(&axis.key));
    let mut lines: Vec<Vec<String>> = vec![
        heads
            .chain(COLUMNS.iter().map(|column| column.head.to_owned()))
            .collect(),
    ];
    for (point, result) in points.iter().zip(results) {
        let mut line: Vec<String> = point.values.iter().map(|value| readable(value)).collect();
        match result {
            Ok(figures) => line.extend(COLUMNS.iter().map(|column| {
                (column.of)(figures).map_or("-".to_owned(), |value| significant(value, 4))
            })),
            Err(error) => line.push(reason(error)),
        }
        lines.push(line);
    }
    let columns = lines[0].len();
    let width = |column: usize| {
        // a failure's words may stand out of their column
        let cells = lines
            .iter()
            .filter(|line| line.len() == columns || column < axes.len());
        let widths = cells.filter_map(|line| line.get(column));
        widths.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    lines
        .iter()
        .map(|line| {
            let cells = line.iter().zip(&widths);
            let padded: Vec<String> = cells.map(|(cell, w)| format!("{cell:>w$}")).collect();
            format!("  {}\n", padded.join("  "))
        })
        .collect()
}

/// The end of a key with its unit: `torque, N m`.
fn with_unit(key: &str) -> String {
    let name = key.rsplit('.').next().unwrap_or(key);
    match crate::study::unit_of(key) {
        None | Some("" | "-" | "1") => name.to_owned(),
        Some(unit) => format!("{name}, {unit}"),
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
        .and_then(|rest| rest.split_once(": "))
    {
        Some((_, why)) => format!("none: {why}"),
        None => format!("failed: {first}"),
    }
}

/// Curves over the first axis: for every combination of the others, the points that are numbers.
fn drawn(
    axes: &[Axis],
    points: &[Point],
    results: &[Result],
) -> Vec<(String, Vec<(f64, Figures4)>)> {
    let mut curves: Vec<(String, Vec<(f64, Figures4)>)> = Vec::new();
    for (point, result) in points.iter().zip(results) {
        let Ok(figures) = result else { continue };
        let first = &point.values[0];
        let place = axes[0].values.iter().position(|value| value == first);
        let x = grid::leading_number(first)
            .filter(|_| axes[0].numbers())
            .unwrap_or(place.unwrap_or(0) as f64 + 1.0);
        let others = axes.iter().zip(&point.values).skip(1);
        let label: Vec<String> = others
            .map(|(axis, value)| {
                let key = axis.key.rsplit('.').next().unwrap_or(&axis.key);
                format!("{key} {value}")
            })
            .collect();
        let label = label.join(", ");
        let shown = [
            figures.peak_pressure,
            figures.te_peak_to_peak_urad,
            Some(figures.max_depth_pinion_um),
            Some(figures.max_depth_gear_um),
        ];
        match curves.iter_mut().find(|(known, _)| *known == label) {
            Some((_, curve)) => curve.push((x, shown)),
            None => curves.push((label, vec![(x, shown)])),
        }
    }
    for (_, curve) in &mut curves {
        curve.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    curves
}

/// What the picture's four panels show.
type Figures4 = [Option<f64>; 4];
