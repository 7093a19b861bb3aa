//! `gearwear import`: a table from a spreadsheet as rows of a measurement file, the mapping shown before anything is written.

mod args;
mod flanks;
mod summary;
mod taken;
mod understood;

use std::fs;
use std::path::Path;

pub(super) use args::ImportArgs;
use args::{Across, On, PerInterval, PositionKind, ShareOf};
use taken::Taken;

use super::init::Example;
use super::{CliError, Context, Outcome};
use crate::measure::Subject;
use crate::measure::import::{self, Decimal, Sheet, Wanted};
use crate::study::Study;

/// Reads the tables, shows how, writes if asked.
pub(super) fn execute(args: &ImportArgs, _: &Context) -> Result<Outcome, CliError> {
    let study = Study::load(&args.study)?;
    let unusable = |why: String| CliError::Unusable(why);
    if study.tests.is_empty() {
        return Err(unusable(format!(
            "{} has no [[test]] to which measurements could belong",
            args.study.display()
        )));
    }
    let wanted = wanted(args, &study)?;
    let mut taken = Taken::after(there(args)?);
    for table in &args.tables {
        let sheets = import::sheets(table).map_err(|error| unusable(error.to_string()))?;
        let chosen = chosen(&sheets, table, args)?;
        let wanted = Wanted {
            sigma_of_others: chosen.len() > 1,
            ..wanted.clone()
        };
        if args.all_sheets {
            taken.pass_over(&sheets, &chosen);
        }
        let mut take =
            |(name, sheet): &(String, Sheet)| taken.take(args, &study, name, sheet, &wanted);
        let sheets = chosen.len();
        let parts: Vec<(String, Sheet)> = (chosen.into_iter())
            .flat_map(|sheet| parts(table, sheet, &wanted))
            .collect();
        for (n, part) in parts.iter().enumerate() {
            if let Err(error) = take(part) {
                let mut refused: Vec<&str> = (parts[n + 1..].iter())
                    .filter(|(_, other)| other.name != part.1.name)
                    .filter(|part| take(part).is_err())
                    .map(|(_, sheet)| sheet.name.as_str())
                    .collect();
                // those of one sheet follow one another
                refused.dedup();
                return Err(beside_others(error, sheets, &refused));
            }
        }
    }
    taken.outcome(args, &study)
}

/// Why a sheet of several was refused, with those behind it that are refused too.
fn beside_others(error: CliError, sheets: usize, refused: &[&str]) -> CliError {
    match error {
        CliError::Unusable(why) if sheets > 1 => {
            let others = match refused {
                [] => "all others can be read".to_owned(),
                names => format!("of the others, {} cannot be read either", names.join(", ")),
            };
            CliError::Unusable(format!(
                "{why}\nNothing is written; {others}. --all-sheets --skip-sheet NAME leaves one out, --sheet NAME takes single ones"
            ))
        }
        other => other,
    }
}

/// The sheets that are meant; of all, those without a table left out.
fn chosen<'s>(
    sheets: &'s [Sheet],
    table: &Path,
    args: &ImportArgs,
) -> Result<Vec<&'s Sheet>, CliError> {
    let names = || {
        let names: Vec<&str> = sheets.iter().map(|sheet| sheet.name.as_str()).collect();
        names.join(", ")
    };
    let stated = |name: &String| match sheets.iter().find(|sheet| sheet.name == *name) {
        Some(sheet) => Ok(sheet),
        None => Err(CliError::Unusable(format!(
            "{} has no sheet {name}; its sheets: {}",
            table.display(),
            names()
        ))),
    };
    for name in &args.skip_sheet {
        stated(name)?;
    }
    match (&args.sheet[..], sheets) {
        ([], [one]) => Ok(vec![one]),
        ([], all) if args.all_sheets => {
            let is_skipped = |sheet: &Sheet| args.skip_sheet.contains(&sheet.name);
            let all: Vec<&Sheet> = all.iter().filter(|sheet| !is_skipped(sheet)).collect();
            let tables = all.iter().copied().filter(|sheet| sheet.holds_numbers());
            let tables: Vec<&Sheet> = tables.collect();
            // where none does, each says what is wrong with it
            let is_filled = |sheet: &&Sheet| sheet.rows.iter().flatten().any(|c| !c.is_empty());
            Ok(if tables.is_empty() {
                all.into_iter().filter(is_filled).collect()
            } else {
                tables
            })
        }
        ([], _) => Err(CliError::Unusable(format!(
            "{} has several sheets, name one with --sheet: {}; or take all, one after the other, by --all-sheets",
            table.display(),
            names()
        ))),
        (chosen, _) => chosen.iter().map(stated).collect(),
    }
}

/// The tables of a sheet, each with its name.
fn parts(table: &Path, sheet: &Sheet, wanted: &Wanted<'_>) -> Vec<(String, Sheet)> {
    let mut name = named(table, sheet);
    let in_one_row = import::checkpoints_above(sheet);
    let sheet = match &in_one_row {
        Some((in_one_row, row)) => {
            name += &format!(" (checkpoints above the header, in row {row})");
            in_one_row
        }
        None => sheet,
    };
    let parts = import::side_by_side(sheet).or_else(|| import::labelled_blocks(sheet, wanted));
    match parts {
        Some(parts) => (parts.into_iter())
            .map(|(columns, part)| (format!("{name}, {columns}"), part))
            .collect(),
        None => {
            let table = import::weighings_across(sheet)
                .or_else(|| import::checkpoints_across(sheet, wanted.quantity));
            if table.is_some() {
                name += " (read as a row for each value; cells are counted so)";
            }
            vec![(name, table.unwrap_or_else(|| sheet.clone()))]
        }
    }
}

/// The table and its sheet.
fn named(table: &Path, sheet: &Sheet) -> String {
    match sheet.name.as_str() {
        "" => table.display().to_string(),
        name => format!("{}, sheet {name}", table.display()),
    }
}

/// What the user states of the table.
fn wanted<'a>(args: &'a ImportArgs, study: &'a Study) -> Result<Wanted<'a>, CliError> {
    let unusable = |why: String| CliError::Unusable(why);
    if let Some(sigma) = args
        .sigma
        .filter(|sigma| !(*sigma > 0.0 && sigma.is_finite()))
    {
        return Err(unusable(format!(
            "--sigma {sigma}: one standard deviation of the values in the quantity's own unit (µm of depth, mg of mass), above 0. How well does a \
             repeated measurement agree? A share alone is --relative-sigma without --sigma; without both it is estimated from the scatter of \
             neighbouring points"
        )));
    }
    let half = 0.5 * study.gears.face_width;
    if let Some(face) = args.face.filter(|face| !(-half..=half).contains(face)) {
        return Err(unusable(format!(
            "--face {face}: the face of the study is {} mm wide, so a place on it is {} to {half} mm from its middle",
            study.gears.face_width, -half
        )));
    }
    if !(0.0..1.0).contains(&args.relative_sigma) {
        return Err(unusable(format!(
            "--relative-sigma {}: a share of the value, 0 to below 1",
            args.relative_sigma
        )));
    }
    Ok(Wanted {
        tests: study.tests.iter().map(|test| test.id.as_str()).collect(),
        runs: (study.tests.iter())
            .map(|test| [test.conditions.speed_rpm, test.conditions.cycles])
            .collect(),
        torques: (study.tests.iter())
            .map(|test| 1e-3 * test.conditions.torque_nmm)
            .collect(),
        gears: [&study.gears.pinion, &study.gears.gear],
        test: args.test.as_deref(),
        member: args.member.map(|member| match member {
            On::Pinion => Subject::Pinion,
            On::Gear => Subject::Gear,
            On::Pair => Subject::Pair,
        }),
        quantity: args.quantity,
        tooth: None,
        cycles: args.cycles,
        position: args.position.map(|kind| match kind {
            PositionKind::Radius => import::PositionKind::Radius,
            PositionKind::Diameter => import::PositionKind::Diameter,
            PositionKind::RollAngle => import::PositionKind::RollAngle,
            PositionKind::RollLength => import::PositionKind::RollLength,
        }),
        across: args.columns.map(|across| match across {
            Across::Checkpoints => import::Across::Checkpoints,
            Across::Positions => import::Across::Positions,
        }),
        unit: args.unit.as_deref(),
        turn_sign: args.turn_sign,
        decimal: args.decimal.map(Decimal::from),
        sigma: args.sigma,
        sigma_of_others: false,
        relative_sigma: args.relative_sigma,
        relative_to: match args.relative_to {
            ShareOf::Value => import::ShareOf::Value,
            ShareOf::Largest => import::ShareOf::Largest,
        },
        face: args.face,
        traces: !args.no_traces,
        repeat: args.repeat,
        there: import::There::default(),
        per_interval: import::PerInterval {
            cycles: args.per_interval.contains(&PerInterval::Cycles),
            losses: import::PerInterval::LOSSES
                .into_iter()
                .filter(|loss| {
                    args.per_interval
                        .iter()
                        .any(|what| what.loss() == Some(*loss))
                })
                .collect(),
        },
    })
}

/// The text of the file that is to be continued; none where a new one is written.
fn there(args: &ImportArgs) -> Result<Option<String>, CliError> {
    let Some(path) = args.output.as_ref().filter(|path| path.exists()) else {
        return Ok(None);
    };
    if args.force {
        return Ok(None);
    }
    let before = fs::read_to_string(path).map_err(|source| CliError::Io {
        doing: "read",
        path: path.clone(),
        source,
    })?;
    if Example::holds(&before) {
        return Err(CliError::Unusable(format!(
            "{} holds the made-up measurements that `gearwear init` wrote, beside which your own do not belong; --force overwrites it",
            path.display()
        )));
    }
    if args.append {
        return Ok(Some(before));
    }
    Err(CliError::Unusable(format!(
        "{} is there already; --append writes behind its rows, --force overwrites it",
        path.display()
    )))
}
