//! `gearwear sweep`: the same study at many points, every point a whole run, one table and one picture; whole or in parts for other machines.

mod compute;
mod design;
mod figures;
mod grid;
mod idle_keys;
mod kept;
mod parts;
mod picture;
mod points;
mod sensitivity;
mod tables;

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;

use super::args::StudyAndOutput;
use super::folder;
use super::progress::Progress;
use super::{CliError, Context, Outcome};
use crate::report::{Staging, atomic};
use crate::study::Study;
use design::{Design, Filling};
use figures::{Output, Outputs};
use grid::Axis;
use kept::Kept;
use parts::Shard;
use points::{Point, Result};
use sensitivity::Sensitivity;

/// Arguments of `sweep`.
#[derive(Debug, Args)]
#[command(
    after_help = "Values are a list, 0,0.5,1, or a range with its number of points, 50..200:4 (50..200:4:log for equal ratios).\nSeveral --vary give every combination; with --design lhs:N or sobol:N they give ranges, 50..200 or 1e-10..1e-9:log, and N points fill them.\n--design saltelli:N takes N rows of keys + 2 points and gives the share of each output's variance that each key causes, alone and with its interactions.\nA swept key may be any of the study's tables, or an effect's parameter (running_in.amplitude). Keys that shape the teeth (tip_relief_amount, profile_shift) or their material mesh both gears anew at every value; effects such as tip_relief do not.\nAn interrupted sweep goes on with --resume; points that are done are not computed again, also when values were added.\nParts: the same arguments with --shard, or --emit and --point, on any number of machines; each point is a file in the part's folder, and a part that is started again goes on. --merge makes the sweep of them, to the byte as one machine makes it; exit code 3 if points are missing.\n\nExamples:\n  gearwear sweep study.toml --vary operation.misalignment=0,0.25,0.5,1 --vary operation.torque=50..200:4\n  gearwear sweep study.toml --vary gears.pinion.profile_shift=-0.2..0.4:7 --resume\n  gearwear sweep study.toml --vary model.contact=fem,hertz --json\n  gearwear sweep study.toml --design sobol:256 --vary operation.torque=50..200 --vary wear.coefficient=1e-10..1e-9:log\n  gearwear sweep study.toml --design saltelli:128 --vary operation.torque=50..200 --vary operation.speed=500..3000 --outputs max_depth_gear_um,wear_profile_gear\n  gearwear sweep study.toml --points points.csv --shard 3/7 -o parts\n  gearwear sweep study.toml --points points.csv --merge parts -o whole"
)]
pub struct SweepArgs {
    #[command(flatten)]
    paths: StudyAndOutput,
    /// A key and its values; may be given several times
    #[arg(long, value_name = "KEY=VALUES", required_unless_present = "points", value_parser = grid::axis)]
    vary: Vec<Axis>,
    /// Fill the ranges of --vary by N points: Latin hypercube or scrambled Sobol sequence; or by N rows of keys + 2 points for Sobol's indices of sensitivity
    #[arg(long, value_name = "lhs:N|sobol:N|saltelli:N", value_parser = design::filling, conflicts_with = "points")]
    design: Option<Filling>,
    /// Seed of --design; the same seed gives the same points
    #[arg(long, value_name = "N", default_value_t = 1, requires = "design")]
    seed: u64,
    /// What to keep of each run, by name; wear_profile_pinion and wear_profile_gear are the depth along the whole flank [default: eight figures]
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', value_parser = figures::output)]
    outputs: Vec<Output>,
    /// The points of a table (CSV): keys in its first line, a point in every other
    #[arg(long, value_name = "CSV", conflicts_with = "vary")]
    points: Option<PathBuf>,
    /// Keep the points that an interrupted or finished sweep into the same folder has done
    #[arg(long)]
    resume: bool,
    /// Compute part i of n only; -o is the folder of the points' files, which parts may share [default: STUDYSTEM.out/sweep-points]
    #[arg(long, value_name = "i/n", value_parser = parts::shard, conflicts_with_all = ["emit", "point", "merge", "resume"])]
    shard: Option<Shard>,
    /// Compute nothing, write a line for --point for each point
    #[arg(long, value_name = "FILE", conflicts_with_all = ["point", "merge", "resume", "output"])]
    emit: Option<PathBuf>,
    /// Points in each line of --emit
    #[arg(long, value_name = "N", default_value = "1", requires = "emit")]
    per_line: NonZeroUsize,
    /// Compute the points of a line of --emit only; - takes it from HQ_ENTRY or standard input; -o as with --shard
    #[arg(long, value_name = "JSON|-", conflicts_with_all = ["merge", "resume"])]
    point: Option<String>,
    /// Compute nothing, make the sweep of what parts have left in these folders
    #[arg(long, value_name = "DIR", num_args = 1.., conflicts_with = "resume")]
    merge: Vec<PathBuf>,
}

/// Where parts put their points.
const PARTS: &str = "sweep-points";

/// Checks every point before any is computed, computes what is asked for and not kept, writes.
pub(super) fn execute(
    args: &SweepArgs,
    context: &Context,
) -> std::result::Result<Outcome, CliError> {
    let file = &args.paths.study;
    let study = Study::load(file)?;
    let design = match (&args.points, args.design) {
        (Some(table), _) => Design::table(table)?,
        (None, Some(filling)) => Design::filled(&args.vary, filling, args.seed)?,
        (None, None) => Design::grid(&args.vary)?,
    };
    let outputs = Outputs::of(&args.outputs);
    let points = points::prepare(&study, &design, &outputs)?;
    if let Some(emit) = &args.emit {
        return emitted(emit, &points, args.per_line);
    }
    let output = |command: &str| {
        let own = args.paths.output.clone();
        own.unwrap_or_else(|| folder::default_path(file, command))
    };
    if let Some(shard) = args.shard {
        let mine = |point| shard.holds(point);
        return part(&output(PARTS), &points, &outputs, &mine, context);
    }
    if let Some(line) = &args.point {
        let named = parts::named(line, &points)?;
        let mine = |point| named.contains(&point);
        return part(&output(PARTS), &points, &outputs, &mine, context);
    }
    let target = output("sweep");
    let _reserved = folder::reserve(&target, file, &study)?;
    if !args.merge.is_empty() {
        let (results, others) = parts::merged(&design, &points, &args.merge)?;
        let mut outcome = whole(&study, &design, &outputs, &points, &results, &target, 0)?;
        if others > 0 {
            outcome.text +=
                &format!("{others} files of the parts belong to no point of this sweep\n");
        }
        return Ok(outcome);
    }
    let kept = Kept::open(&target, args.resume)?;
    let progress = context.progress("sweep");
    let (results, reused) = compute::compute(&points, &outputs, &|_| true, &kept, &progress)?;
    let results: Vec<Result> = (results.into_iter())
        .map(|result| result.unwrap_or_else(|| Err("not computed".to_owned())))
        .collect();
    drop(progress);
    let outcome = whole(
        &study, &design, &outputs, &points, &results, &target, reused,
    )?;
    kept.discard();
    Ok(outcome)
}

/// Writes the lines of all points.
fn emitted(
    file: &Path,
    points: &[Point],
    each: NonZeroUsize,
) -> std::result::Result<Outcome, CliError> {
    let (text, count) = parts::lines(points, each);
    atomic::write_file(file, text.as_bytes())?;
    Ok(Outcome {
        json: json!({"written": [file], "lines": count, "points": points.len()}),
        text: format!(
            "wrote {}: {} points in {count} lines\nnext: the same arguments with --point LINE instead of --emit, then with --merge\n",
            file.display(),
            points.len()
        ),
        success: true,
    })
}

/// Computes the points for which `mine` holds into a folder of files.
fn part(
    folder: &Path,
    points: &[Point],
    outputs: &Outputs,
    mine: &dyn Fn(usize) -> bool,
    context: &Context,
) -> std::result::Result<Outcome, CliError> {
    let kept = Kept::part(folder)?;
    let progress = context.progress("sweep");
    let (results, reused) = compute::compute(points, outputs, mine, &kept, &progress)?;
    drop(progress);
    let own = || {
        results
            .iter()
            .zip(points)
            .filter(|(result, _)| result.is_some())
    };
    let failed = |(result, point): &(&Option<Result>, &Point)| {
        point.is_possible() && matches!(result, Some(Err(_)))
    };
    let (count, failures) = (own().count(), own().filter(failed).count());
    let mut text = format!("{count} of {} points are done", points.len());
    if reused > 0 {
        text += &format!(", {reused} were before");
    }
    if failures > 0 {
        text += &format!(", {failures} failed");
    }
    text += &format!("; their files stand in {}\n", folder.display());
    Ok(Outcome {
        json: json!({"folder": folder, "points": count, "of": points.len(), "reused": reused, "failed": failures}),
        text,
        success: failures == 0,
    })
}

/// Writes the sweep of all points.
fn whole(
    study: &Study,
    design: &Design,
    outputs: &Outputs,
    points: &[Point],
    results: &[Result],
    target: &Path,
    reused: usize,
) -> std::result::Result<Outcome, CliError> {
    let impossible = points.iter().filter(|point| !point.is_possible()).count();
    let failures = results.iter().filter(|result| result.is_err()).count() - impossible;
    let mut document = tables::document(&study.title, design, points, results);
    let sensitivity = Sensitivity::of(design, outputs, results);
    if let Some(sensitivity) = &sensitivity {
        document["sensitivity"] = sensitivity.document();
    }
    let mut staging = Staging::begin(target)?;
    let mut written = vec!["sweep.csv", "sweep.json"];
    let table = tables::csv(design, outputs, points, results);
    staging.write("sweep.csv", table.as_bytes())?;
    staging.write(
        "sweep.json",
        &crate::report::json::text("sweep.json", &document)?,
    )?;
    if let Some(svg) = picture::picture(&study.title, design, outputs, points, results)? {
        staging.write("sweep.svg", svg.as_bytes())?;
        written.push("sweep.svg");
    }
    if !outputs.profiles.is_empty() {
        let table = tables::profiles(&outputs.profiles, results);
        staging.write("wear_profiles.csv", table.as_bytes())?;
        written.push("wear_profiles.csv");
    }
    if let Some(sensitivity) = &sensitivity {
        staging.write("sensitivity.csv", sensitivity.csv().as_bytes())?;
        written.push("sensitivity.csv");
        if let Some(svg) = sensitivity.picture(&study.title, outputs)? {
            staging.write("sensitivity.svg", svg.as_bytes())?;
            written.push("sensitivity.svg");
        }
    }
    let folder = staging.commit()?;
    let mut text = tables::table(design, outputs, points, results);
    match &sensitivity {
        Some(sensitivity) => text += &sensitivity.text(),
        None => text += &idle_keys::text(design, points, results),
    }
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
        "Written to {}\n  {}\n",
        folder.display(),
        written.join(", ")
    );
    Ok(Outcome {
        json: document,
        text,
        success: failures == 0,
    })
}
