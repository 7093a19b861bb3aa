//! `gearwear validate`: the verification and validation cases.

use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;

use super::progress::Progress;
use super::{CliError, Context, Outcome};
use crate::numeric::written::significant;
use crate::report::html::{self, Case};
use crate::report::{self, atomic};
use crate::verify::contact_and_wear::Effort;
use crate::verify::questions::question;
use crate::verify::registry;
use crate::verify::runner::{self, Row, Verdict};

/// Arguments of `validate`.
#[derive(Debug, Args)]
#[command(
    after_help = "A case is named by its id or the beginning of it: B2 runs all of B2, F every wear case.\n\nExamples:\n  gearwear validate\n  gearwear validate -o results/validation\n  gearwear validate A1 B3 --json"
)]
pub struct ValidateArgs {
    /// Cases to run [default: all]
    #[arg(value_name = "CASE", value_parser = case_name)]
    cases: Vec<String>,
    /// Folder for validation.json and the tables [default: nothing is written]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

/// Prepares the folder, if one is wanted, and leaves the work to [`run_cases`].
pub(super) fn execute(args: &ValidateArgs, context: &Context) -> Result<Outcome, CliError> {
    if let Some(folder) = &args.output {
        atomic::check(folder)?;
    }
    run_cases(
        &args.cases,
        args.output.as_deref(),
        &context.progress("cases"),
    )
}

/// Runs the named cases, all if none is named, and writes `validation.json` into `folder` if there is one; the outcome's JSON
/// is that document, and it is no success if a case fails.
fn run_cases(
    cases: &[String],
    folder: Option<&Path>,
    progress: &Progress,
) -> Result<Outcome, CliError> {
    let rows = runner::run(
        &registry::entries(),
        cases,
        Effort::Full,
        &mut |done, title| progress.show(done, title.to_owned()),
    );
    let mut outcome = outcome(&rows);
    if let Some(folder) = folder {
        let cases: Vec<Case> = rows.iter().map(case).collect();
        let written = report::write_validation(&cases, folder)?;
        outcome.text += &format!("Written to {}\n", written.folder.display());
    }
    Ok(outcome)
}

/// Accepts what selects a case.
fn case_name(name: &str) -> Result<String, String> {
    if runner::is_known(name) {
        return Ok(name.to_owned());
    }
    Err(format!(
        "no such case; cases are {}",
        runner::known_ids().join(", ")
    ))
}

fn outcome(rows: &[Row]) -> Outcome {
    Outcome {
        json: json!({"cases": rows.iter().map(case).collect::<Vec<_>>()}),
        text: text(rows),
        success: runner::passed(rows),
    }
}

fn verdict(row: &Row) -> html::Verdict {
    match row.verdict {
        Verdict::Pass => html::Verdict::Pass,
        Verdict::Fail => html::Verdict::Fail,
        Verdict::Skipped => html::Verdict::Skipped,
        Verdict::ContradictsTheory => html::Verdict::ContradictsTheory,
    }
}

/// The family of a case: its id up to the first dot.
fn family(id: &str) -> &str {
    id.split('.').next().unwrap_or(id)
}

fn case(row: &Row) -> Case {
    Case {
        id: row.id.clone(),
        group: row.group.to_owned(),
        family: family(&row.id).to_owned(),
        question: question(family(&row.id)).to_owned(),
        quantity: row.quantity.clone(),
        target: row.target,
        source: row.source.clone(),
        value: row.value,
        error: row.error,
        tolerance: row.tolerance,
        measure: if row.relative { "relative" } else { "absolute" }.to_owned(),
        verdict: verdict(row),
        reason: row.reason.clone(),
        seconds: (row.seconds * 1e3).round() / 1e3,
        note: remark(row).unwrap_or_default(),
    }
}

/// What a reader should know beside the figures. The reason of a tolerance is none of it: it is the same for a whole
/// family and excuses no miss.
fn remark(row: &Row) -> Option<String> {
    let about_the_case = match row.verdict {
        Verdict::Pass => row.group == "Published paper",
        Verdict::Fail => row.value.is_none() || row.group == "Published paper",
        Verdict::Skipped | Verdict::ContradictsTheory => true,
    };
    (about_the_case && !row.reason.is_empty()).then(|| row.reason.clone())
}

/// The table for the terminal: a heading per group, one line per case, the totals.
fn text(rows: &[Row]) -> String {
    let shown = |value: Option<f64>| value.map_or("-".to_owned(), |v| significant(v, 6));
    let measured = |row: &Row, value: Option<f64>| match value {
        None => "-".to_owned(),
        Some(value) if row.relative => format!("{} %", significant(100.0 * value, 2)),
        Some(value) => significant(value, 2),
    };
    let head = ["case", "verdict", "found", "target", "error", "allowed"].map(str::to_owned);
    let lines: Vec<[String; 6]> = rows
        .iter()
        .map(|row| {
            [
                row.id.clone(),
                verdict(row).word().to_owned(),
                shown(row.value),
                shown(row.target),
                measured(row, row.error),
                measured(row, row.tolerance),
            ]
        })
        .collect();
    let width = |i: usize| {
        let cells = lines
            .iter()
            .chain([&head])
            .map(|line| line[i].chars().count());
        cells.max().unwrap_or(0)
    };
    let widths: [usize; 6] = std::array::from_fn(width);
    let line = |cells: &[String; 6], what: &str| {
        let mut line = String::from("  ");
        for (i, (cell, width)) in cells.iter().zip(widths).enumerate() {
            line += &match i {
                0 | 1 => format!("{cell:<width$}  "),
                _ => format!("{cell:>width$}  "),
            };
        }
        line + what + "\n"
    };
    let mut out = String::new();
    let mut group = "";
    for (row, cells) in rows.iter().zip(&lines) {
        if row.group != group {
            if !group.is_empty() {
                out.push('\n');
            }
            group = row.group;
            out += &format!("{group}\n{}", line(&head, "quantity"));
        }
        out += &line(cells, &row.quantity);
        if let Some(remark) = remark(row).filter(|_| row.verdict != Verdict::Pass) {
            out += &format!("      {remark}\n");
        }
    }
    out + &totals(rows)
}

fn totals(rows: &[Row]) -> String {
    let number = |verdict| rows.iter().filter(|row| row.verdict == verdict).count();
    format!(
        "\n{} cases: {} pass, {} fail, {} skipped, {} contradict theory\n",
        rows.len(),
        number(Verdict::Pass),
        number(Verdict::Fail),
        number(Verdict::Skipped),
        number(Verdict::ContradictsTheory)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::Measured;
    use crate::verify::registry::{Entry, Work};

    #[test]
    fn a_failing_case_makes_the_command_fail() {
        let mut entry = Entry {
            ids: vec!["A1".to_owned()],
            group: registry::GROUPS[0],
            title: "doctored",
            source: "none",
            reason: "",
            work: Work::Family(|_| {
                Ok(vec![Measured::relative("A1", "two for one", 2.0, 1.0, 0.1)])
            }),
        };
        let run = |entry: &Entry| {
            let only = ["A1".to_owned()];
            outcome(&runner::run(
                std::slice::from_ref(entry),
                &only,
                Effort::Quick,
                &mut |_, _| {},
            ))
        };
        let failing = run(&entry);
        assert!(!failing.success);
        assert_eq!(failing.json["cases"][0]["verdict"], "fail");
        assert!(failing.text.contains("1 fail"), "{}", failing.text);
        entry.work = Work::Family(|_| Ok(vec![Measured::relative("A1", "one", 1.0, 1.0, 0.1)]));
        assert!(run(&entry).success);
    }
}
