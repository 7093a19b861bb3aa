//! `gearwear import`: a table from a spreadsheet as rows of a measurement file, the mapping shown before anything is written.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use serde_json::json;

use super::{CliError, Context, Outcome};
use crate::measure::import::{self, Decimal, Mapping, Sheet, Wanted};
use crate::measure::{Dataset, Place, Quantity, Subject};
use crate::study::Study;

/// Arguments of `import`.
#[derive(Debug, Args)]
#[command(
    after_help = "A table has a column for each checkpoint and positions in its first column, or the other way round. A sheet with the\ncolumns of a measurement file (test,member,...) is taken as it stands. Nothing is written without -o.\n\nExamples:\n  gearwear import pinion.xlsx --study study.toml --test A --member pinion --sigma 0.2\n  gearwear import rig.xlsx --sheet gear --study study.toml --test A --member gear --sigma 0.2 -o measurements.csv --append\n  gearwear import depth.csv --study study.toml --test A --member pinion --unit mm --turn-sign --position roll-angle --sigma 0.2"
)]
pub struct ImportArgs {
    /// Table: .xlsx, or text with commas, semicolons or tabulators
    #[arg(value_name = "TABLE")]
    table: PathBuf,
    /// Study that the measurements belong to: its tests and gears
    #[arg(long, value_name = "STUDY")]
    study: PathBuf,
    /// Sheet of the spreadsheet [default: its only one]
    #[arg(long, value_name = "NAME")]
    sheet: Option<String>,
    /// Id of the test [default: the study's only one]
    #[arg(long, value_name = "ID")]
    test: Option<String>,
    /// What was measured on
    #[arg(long, value_enum, value_name = "MEMBER", default_value_t = On::Pinion)]
    member: On,
    /// What was measured: wear_depth, transmission_error, load_share, contact_pressure or mesh_stiffness
    #[arg(long, value_name = "QUANTITY", default_value = "wear_depth")]
    quantity: String,
    /// How places on the flank are told [default: what the header says, a radius otherwise]
    #[arg(long, value_enum, value_name = "KIND")]
    position: Option<PositionKind>,
    /// What the columns are [default: what the numbers say]
    #[arg(long, value_enum, value_name = "WHAT")]
    columns: Option<Across>,
    /// Unit of the values [default: the quantity's own]
    #[arg(long, value_name = "UNIT")]
    unit: Option<String>,
    /// Mark of the decimals of a text [default: what the numbers say]
    #[arg(long, value_enum, value_name = "MARK")]
    decimal: Option<Mark>,
    /// Lost material is negative in the table
    #[arg(long)]
    turn_sign: bool,
    /// One standard deviation of every value, in the quantity's own unit (um of depth) [default: left empty, and estimated from the scatter of
    /// neighbouring points wherever the file is read]
    #[arg(long, value_name = "SIGMA", allow_negative_numbers = true)]
    sigma: Option<f64>,
    /// A further standard deviation as a share of each value (0.03: three percent), for scatter that grows with the wear
    #[arg(
        long,
        value_name = "SHARE",
        default_value_t = 0.0,
        requires = "sigma",
        allow_negative_numbers = true
    )]
    relative_sigma: f64,
    /// The instrument's zero is the same for all checkpoints: no trace of its own for each
    #[arg(long)]
    no_traces: bool,
    /// Number of a repeated measurement at the same checkpoints: its traces have zeros of their own
    #[arg(long, value_name = "N", conflicts_with = "no_traces")]
    repeat: Option<u32>,
    /// Measurement file to write
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Write the rows behind those of FILE
    #[arg(long, requires = "output")]
    append: bool,
    /// Overwrite FILE
    #[arg(long, requires = "output", conflicts_with = "append")]
    force: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum On {
    Pinion,
    Gear,
    Pair,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum PositionKind {
    /// Radius, mm
    Radius,
    /// Diameter, mm
    Diameter,
    /// Roll angle from the base circle, degrees
    RollAngle,
    /// Roll length from the base circle, mm
    RollLength,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Across {
    /// Checkpoints, in pinion revolutions
    Checkpoints,
    /// Positions
    Positions,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Mark {
    /// 1.5
    Point,
    /// 1,5
    Comma,
}

impl From<Mark> for Decimal {
    fn from(mark: Mark) -> Self {
        match mark {
            Mark::Point => Decimal::Point,
            Mark::Comma => Decimal::Comma,
        }
    }
}

/// Columns of the file that is written.
const HEADER: &str = "test,member,cycles,quantity,position,value,sigma,trace";

/// Rows that are shown of the mapping.
const SHOWN: usize = 3;

/// Reads the table, shows how, writes if asked.
pub(super) fn execute(args: &ImportArgs, _: &Context) -> Result<Outcome, CliError> {
    let study = Study::load(&args.study)?;
    let unusable = |why: String| CliError::Unusable(why);
    if study.tests.is_empty() {
        return Err(unusable(format!(
            "{} has no [[test]] to which measurements could belong",
            args.study.display()
        )));
    }
    let sheets = import::sheets(&args.table).map_err(|error| unusable(error.to_string()))?;
    let sheet = chosen(&sheets, args)?;
    let table = import::as_measurements(sheet, args.decimal.map(Decimal::from));
    let (rows, mut text, document) = match table.map_err(|error| unusable(error.to_string()))? {
        Some(table) => {
            let idle = [
                (args.turn_sign, "--turn-sign"),
                (args.unit.is_some(), "--unit"),
                (args.sigma.is_some(), "--sigma"),
                (args.position.is_some(), "--position"),
                (args.columns.is_some(), "--columns"),
                (args.repeat.is_some(), "--repeat"),
            ];
            if let Some((_, option)) = idle.iter().find(|(given, _)| *given) {
                return Err(unusable(format!(
                    "{option} is for tables with a column for each checkpoint or place; {} has the columns of a measurement file, which say it themselves",
                    named(args, sheet)
                )));
            }
            let mut lines = table.lines();
            let header = lines.next().unwrap_or_default().to_owned();
            let rows: Vec<String> = lines.map(str::to_owned).collect();
            let text = format!(
                "{}: {} rows in the columns of a measurement file\n",
                named(args, sheet),
                rows.len()
            );
            let document = json!({ "rows": rows.len() });
            ((header, rows), text, document)
        }
        None => {
            let (mapping, text, document) = wide(args, &study, sheet)?;
            ((HEADER.to_owned(), mapping.rows), text, document)
        }
    };
    let (header, rows) = rows;
    let whole = whole(args, &header, &rows)?;
    let name = args.output.as_ref().unwrap_or(&args.table);
    // what cannot be read back is not written
    let data = Dataset::parse(&whole, &name.display().to_string(), &study.known())?;
    let mut document = document;
    match &args.output {
        None => {
            text += "nothing is written yet: -o measurements.csv writes it\n";
            document["written"] = json!([]);
        }
        Some(path) => {
            fs::write(path, &whole).map_err(|source| CliError::Io {
                doing: "write",
                path: path.clone(),
                source,
            })?;
            let _ = writeln!(
                text,
                "wrote {}: {} rows\nnext: gearwear check {}",
                path.display(),
                data.observations.len(),
                args.study.display()
            );
            document["written"] = json!([path.display().to_string()]);
        }
    }
    Ok(Outcome {
        json: document,
        text,
        success: true,
    })
}

/// The sheet that is meant.
fn chosen<'s>(sheets: &'s [Sheet], args: &ImportArgs) -> Result<&'s Sheet, CliError> {
    let names = || {
        let names: Vec<&str> = sheets.iter().map(|sheet| sheet.name.as_str()).collect();
        names.join(", ")
    };
    match (&args.sheet, sheets) {
        (None, [one]) => Ok(one),
        (Some(name), _) => sheets
            .iter()
            .find(|sheet| sheet.name == *name)
            .ok_or_else(|| {
                CliError::Unusable(format!(
                    "{} has no sheet {name}; its sheets: {}",
                    args.table.display(),
                    names()
                ))
            }),
        (None, _) => Err(CliError::Unusable(format!(
            "{} has several sheets, name one with --sheet: {}",
            args.table.display(),
            names()
        ))),
    }
}

/// The table and its sheet.
fn named(args: &ImportArgs, sheet: &Sheet) -> String {
    match sheet.name.as_str() {
        "" => args.table.display().to_string(),
        name => format!("{}, sheet {name}", args.table.display()),
    }
}

/// A wide table: its mapping, the words about it and its document.
fn wide(
    args: &ImportArgs,
    study: &Study,
    sheet: &Sheet,
) -> Result<(Mapping, String, serde_json::Value), CliError> {
    let unusable = |why: String| CliError::Unusable(why);
    let test = match (&args.test, study.tests.as_slice()) {
        (Some(id), tests) if tests.iter().any(|test| test.id == *id) => id.as_str(),
        (None, [one]) => one.id.as_str(),
        (stated, tests) => {
            let ids: Vec<&str> = tests.iter().map(|test| test.id.as_str()).collect();
            let what = match stated {
                Some(id) => format!("the study has no test {id}"),
                None => "name the test with --test".to_owned(),
            };
            return Err(unusable(format!("{what}; its tests: {}", ids.join(", "))));
        }
    };
    let quantity = Quantity::ALL
        .into_iter()
        .find(|quantity| quantity.name() == args.quantity
                && matches!(quantity.place(), Place::Flank | Place::Rotation))
        .ok_or_else(|| {
            let names = Quantity::ALL.map(Quantity::name);
            unusable(format!(
                "--quantity {}: {}; what has no place on a flank or rotation is written into the measurement file by hand",
                args.quantity,
                names.join(", ")
            ))
        })?;
    let member = match args.member {
        _ if quantity.subjects() == [Subject::Pair] => Subject::Pair,
        On::Pinion => Subject::Pinion,
        On::Gear => Subject::Gear,
        On::Pair => Subject::Pair,
    };
    if !quantity.subjects().contains(&member) {
        return Err(unusable(format!(
            "{} is measured on one member: --member pinion or --member gear",
            quantity.name()
        )));
    }
    if let Some(sigma) = args
        .sigma
        .filter(|sigma| !(*sigma > 0.0 && sigma.is_finite()))
    {
        return Err(unusable(format!(
            "--sigma {sigma}: one standard deviation of the values in {}, above 0. How well does a repeated measurement agree? Without --sigma \
             it is estimated from the scatter of neighbouring points",
            quantity.unit()
        )));
    }
    if !(0.0..1.0).contains(&args.relative_sigma) {
        return Err(unusable(format!(
            "--relative-sigma {}: a share of the value, 0 to below 1",
            args.relative_sigma
        )));
    }
    if let Some(unit) = &args.unit {
        import::factor(unit, quantity).map_err(|error| unusable(format!("--unit: {error}")))?;
    }
    let wanted = Wanted {
        test,
        member,
        gear: Wanted::gear_of(member, [&study.gears.pinion, &study.gears.gear]),
        quantity,
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
        relative_sigma: args.relative_sigma,
        traces: !args.no_traces,
    };
    let mut mapping = import::map(sheet, &wanted)
        .map_err(|error| unusable(format!("{}: {error}", named(args, sheet))))?;
    if let (Some(repeat), true) = (args.repeat, wanted.traces) {
        // the trace is the last field
        for row in &mut mapping.rows {
            let quoted = row.ends_with('"').then(|| row.pop());
            *row += &format!("-r{repeat}");
            row.extend(quoted.flatten());
        }
    }
    let text = told(args, sheet, &wanted, &mapping);
    let document = json!({
        "columns": match mapping.across {
            import::Across::Checkpoints => "checkpoints",
            import::Across::Positions => "positions",
        },
        "position": mapping.position.name(),
        "checkpoints": mapping.checkpoints,
        "from_to": mapping.from_to,
        "empty": mapping.empty,
        "rows": mapping.rows.len(),
    });
    Ok((mapping, text, document))
}

/// The mapping in words.
fn told(args: &ImportArgs, sheet: &Sheet, wanted: &Wanted<'_>, mapping: &Mapping) -> String {
    let [from, to] = mapping.from_to;
    let (corner, words) = &mapping.corner;
    let places = format!("{}, {from} to {to}", mapping.position.name());
    let times: Vec<String> = mapping.checkpoints.iter().map(f64::to_string).collect();
    let times = format!("pinion revolutions, {}", times.join(" "));
    let (down, across) = match mapping.across {
        import::Across::Checkpoints => (places, times),
        import::Across::Positions => (times, places),
    };
    let unit = match &mapping.unit {
        (unit, true) => format!("{unit} (the header says so)"),
        (unit, false) => unit.clone(),
    };
    let sign = if args.turn_sign {
        ", their sign turned"
    } else {
        ""
    };
    let mut text = format!(
        "table    {}\n\
         header   row of {corner}{}\n\
         down     {down}\n\
         across   {across}\n\
         values   {} of the {} in test {}, in {unit}{sign}\n\
         sigma    {}\n\
         traces   {}\n",
        named(args, sheet),
        if words.is_empty() {
            String::new()
        } else {
            format!(" `{words}`")
        },
        wanted.quantity.name(),
        wanted.member.name(),
        wanted.test,
        sigma_in_words(wanted),
        if wanted.traces {
            "one for each checkpoint: the instrument's zero is not known (--no-traces: it is the same for all)"
        } else {
            "none: the instrument's zero is the same for all checkpoints"
        }
    );
    if mapping.empty > 0 {
        let _ = writeln!(
            text,
            "empty    {} cells without a value passed over",
            mapping.empty
        );
    }
    let _ = writeln!(
        text,
        "rows     {}, the first:\n  {HEADER}",
        mapping.rows.len()
    );
    for row in mapping.rows.iter().take(SHOWN) {
        let _ = writeln!(text, "  {row}");
    }
    text
}

fn sigma_in_words(wanted: &Wanted<'_>) -> String {
    let Some(sigma) = wanted.sigma else {
        return "left empty: estimated from the scatter of neighbouring points wherever the file is read (--sigma states it)".to_owned();
    };
    let share = match wanted.relative_sigma {
        0.0 => String::new(),
        share => format!(", and {} % of the value", 100.0 * share),
    };
    format!("{sigma} {} for each{share}", wanted.quantity.unit())
}

/// Rows by all that they say but sigma, which may be stated otherwise when a table is taken a second time.
fn readings(header: &str, rows: &str) -> Vec<Vec<String>> {
    let sigma = header.split(',').position(|name| name == "sigma");
    let mut reader = csv::ReaderBuilder::new();
    let reader = reader.has_headers(false).flexible(true).comment(Some(b'#'));
    let mut reader = reader.from_reader(rows.as_bytes());
    let records = reader.records().filter_map(std::result::Result::ok);
    let without = |record: csv::StringRecord| {
        let fields = record.iter().enumerate();
        fields
            .filter(|(at, _)| Some(*at) != sigma)
            .map(|(_, field)| field.to_owned())
            .collect()
    };
    records.map(without).collect()
}

/// The text of the file with these rows.
fn whole(args: &ImportArgs, header: &str, rows: &[String]) -> Result<String, CliError> {
    let mut text = format!("{header}\n");
    if let Some(path) = &args.output
        && path.exists()
    {
        if !args.append && !args.force {
            return Err(CliError::Unusable(format!(
                "{} is there already; --append writes behind its rows, --force overwrites it",
                path.display()
            )));
        }
        if args.append {
            let before = fs::read_to_string(path).map_err(|source| CliError::Io {
                doing: "read",
                path: path.clone(),
                source,
            })?;
            let own = before
                .lines()
                .find(|line| !line.is_empty() && !line.starts_with('#'));
            if own != Some(header) {
                return Err(CliError::Unusable(format!(
                    "{} has other columns than {header}; write into a file of its own",
                    path.display()
                )));
            }
            let known: BTreeSet<Vec<String>> = readings(header, &before).into_iter().collect();
            let new = readings(header, &rows.join("\n"));
            if let Some(at) = new.iter().position(|row| known.contains(row)) {
                return Err(CliError::Unusable(format!(
                    "{} has the reading {} already: was this table appended before? --repeat 2 is for a second measurement at the same \
                     checkpoints",
                    path.display(),
                    rows[at]
                )));
            }
            text = before;
            if !text.ends_with('\n') {
                text.push('\n');
            }
        }
    }
    for row in rows {
        text += row;
        text.push('\n');
    }
    Ok(text)
}
