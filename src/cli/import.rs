//! `gearwear import`: a table from a spreadsheet as rows of a measurement file, the mapping shown before anything is written.

mod args;
mod flanks;
mod summary;

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use serde_json::json;

pub(super) use args::ImportArgs;
use args::{Across, On, PositionKind, ShareOf};
use flanks::Flanks;

use super::init::Example;
use super::{CliError, Context, Outcome};
use crate::measure::import::{self, Decimal, Entry, Long, Sheet, Titles, UnitFrom, Wanted, Wide};
use crate::measure::{Dataset, Subject};
use crate::report::write_file;
use crate::study::{Fault, Study, StudyError};

/// Either kind of table, as it was understood.
enum Understood {
    Long(Long),
    Wide(Wide),
}

impl Understood {
    fn entries(&self) -> &[Entry] {
        match self {
            Understood::Long(long) => &long.entries,
            Understood::Wide(wide) => &wide.entries,
        }
    }

    fn titles(&self) -> &Titles {
        match self {
            Understood::Long(long) => &long.titles,
            Understood::Wide(wide) => &wide.titles,
        }
    }

    fn flank(&self) -> Option<&str> {
        match self {
            Understood::Long(long) => long.flank.as_deref(),
            Understood::Wide(wide) => wide.flank.as_deref(),
        }
    }

    /// What was read as what, by which a table is like another.
    fn columns(&self) -> Vec<(String, String)> {
        let (mut columns, turned) = match self {
            Understood::Long(long) => (long.columns.clone(), long.turned),
            Understood::Wide(wide) => (vec![wide.corner.clone()], wide.turned),
        };
        columns.push(("sign".to_owned(), turned.to_string()));
        columns
    }
}

/// The table that was shown in full, to which others are alike.
struct Shown {
    columns: Vec<(String, String)>,
    titles: Titles,
}

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
    let mut file = there(args)?;
    let mut text = String::new();
    let mut documents = Vec::new();
    let mut shown: Option<Shown> = None;
    let mut flanks = Flanks::default();
    let mut count = 0;
    for table in &args.tables {
        let sheets = import::sheets(table).map_err(|error| unusable(error.to_string()))?;
        let chosen = chosen(&sheets, table, args)?;
        let wanted = Wanted {
            sigma_of_others: args.all_sheets && chosen.len() > 1,
            ..wanted.clone()
        };
        for sheet in chosen {
            let name = named(table, sheet);
            let understood =
                understood(sheet, &wanted).map_err(|error| unusable(format!("{name}: {error}")))?;
            flanks.agree(&name, &understood)?;
            let (header, rows) = import::lines(understood.entries());
            let source = source(args, file.is_some(), &name);
            let whole = with_rows(args, &name, file.as_deref(), &header, &rows)?;
            let columns = understood.columns();
            let titles = understood.titles();
            if let Some(first) = shown.as_ref().filter(|first| first.columns == columns) {
                text +=
                    &summary::like_the_first(&name, understood.entries(), titles, &first.titles);
            } else {
                text += &match &understood {
                    Understood::Long(long) => summary::long(args, &name, long),
                    Understood::Wide(wide) => summary::wide(args, &name, wide),
                };
                text += &summary::rows(&header, &rows);
                shown = Some(Shown {
                    columns,
                    titles: titles.clone(),
                });
            }
            // what cannot be read back is not written
            if let Err(error) = Dataset::parse(&whole, &source, &study.known()) {
                // the place within the table's own rows, where these alone are wrong
                let own = format!("{header}\n{}\n", rows.join("\n"));
                let own = Dataset::parse(&own, &source, &study.known()).err();
                let error = own.filter(|_| !args.append).unwrap_or(error);
                return Err(cannot_be_read(error, (&name, &understood), &text));
            }
            count += rows.len();
            documents.push(document(&understood));
            file = Some(whole);
        }
    }
    if documents.is_empty() {
        return Err(unusable(
            "no sheet of these tables holds anything".to_owned(),
        ));
    }
    let whole = file.unwrap_or_default();
    let mut document = match <[serde_json::Value; 1]>::try_from(documents) {
        Ok([one]) => one,
        Err(several) => json!({ "tables": several, "rows": count }),
    };
    match &args.output {
        None => {
            text += "nothing is written yet: -o measurements.csv writes it\n";
            document["written"] = json!([]);
        }
        Some(path) => {
            let all = Dataset::parse(&whole, &path.display().to_string(), &study.known())?;
            write_file(path, whole.as_bytes())?;
            let _ = writeln!(
                text,
                "wrote {}: {} rows\n{}next: gearwear check {}",
                path.display(),
                all.observations.len(),
                read_from(&study, &args.study, path),
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

/// What is to be changed in a study, of that file, that does not read the file that was written; a line.
fn read_from(study: &Study, file: &Path, written: &Path) -> String {
    let is_same = |own: &Path| match (own.canonicalize(), written.canonicalize()) {
        (Ok(own), Ok(written)) => own == written,
        _ => own == written,
    };
    let reads = match &study.measurements {
        Some(own) if is_same(own) => return String::new(),
        Some(own) => format!("the study reads {}", own.display()),
        None => "the study reads no measurements yet".to_owned(),
    };
    let whole = written.canonicalize();
    let whole = whole.as_deref().unwrap_or(written);
    let file = file.canonicalize().ok();
    let folder = file.as_deref().and_then(Path::parent);
    let from_study = folder.and_then(|folder| whole.strip_prefix(folder).ok());
    format!(
        "{reads}: put file = \"{}\" under its [measurements]\n",
        from_study.unwrap_or(whole).display()
    )
}

/// Why the rows of a table cannot be read back; where it lacks uncertainties, after what was `shown` of it.
fn cannot_be_read(
    error: StudyError,
    (name, understood): (&str, &Understood),
    shown: &str,
) -> CliError {
    let fault = error.diagnostic();
    let lacks_sigma = fault.fault == Fault::MissingKey && fault.key == "sigma";
    let own = understood
        .entries()
        .iter()
        .find(|entry| entry.sigma.is_none());
    match own.filter(|_| lacks_sigma) {
        Some(entry) => CliError::Shown {
            shown: summary::without_sigma(shown),
            why: format!(
                "{name}: the table has no uncertainty of its {}, and its values are too few to estimate it from their scatter (several points along \
                 a trace, seven times of a test or repeated measurements would do). State one standard deviation with --sigma, in {}, or a share of \
                 each value with --relative-sigma, or add a column `sigma`; it may be left out only behind rows that show the \
                 scatter (-o FILE --append)",
                entry.quantity.name(),
                entry.quantity.unit()
            ),
        },
        None => {
            let error = reading(understood)
                .into_iter()
                .fold(error, |error, said| error.with_hint(&said));
            error.into()
        }
    }
}

/// A sheet as either kind of table.
fn understood(sheet: &Sheet, wanted: &Wanted<'_>) -> Result<Understood, import::ImportError> {
    match import::long(sheet, wanted)? {
        Some(long) => Ok(Understood::Long(long)),
        None => import::wide(sheet, wanted).map(Understood::Wide),
    }
}

/// What messages about the rows call them: they stand in no file yet.
fn source(args: &ImportArgs, has_others: bool, table: &str) -> String {
    match &args.output {
        Some(path) if args.append && has_others => {
            format!("{} with the rows of {table}", path.display())
        }
        _ => format!("the rows of {table}"),
    }
}

/// How the numbers were read, for messages about the rows.
fn reading(understood: &Understood) -> Vec<String> {
    let wide = match understood {
        Understood::Wide(wide) => wide,
        Understood::Long(long) => {
            let times = long
                .columns
                .iter()
                .filter(|(_, what)| what.starts_with("running time"));
            return times
                .map(|(written, what)| format!("the cycles are those of `{written}`: {what}"))
                .collect();
        }
    };
    let mut said = Vec::new();
    if wide.of_gear {
        said.push("the headers count revolutions of the gear; these are the pinion's, by the numbers of teeth".to_owned());
    }
    let (unit, from) = &wide.unit;
    if *unit != wide.quantity.unit() {
        let by = match from {
            UnitFrom::Header => "the header says so",
            UnitFrom::Title => "the title says so",
            _ => "--unit",
        };
        said.push(format!("the values were read in {unit} ({by})"));
    }
    said
}

/// The document of `--json`, without what was written.
fn document(understood: &Understood) -> serde_json::Value {
    let titles = |titles: &import::Titles| {
        let rows = titles.passed_over.iter().map(|(_, text)| text.clone());
        rows.collect::<Vec<String>>()
    };
    match understood {
        Understood::Long(long) => json!({
            "columns": long.columns,
            "passed_over": long.passed_over,
            "titles_passed_over": titles(&long.titles),
            "left_out": long.left_out,
            "sign_turned": long.turned,
            "empty": long.empty,
            "rows": long.entries.len(),
        }),
        Understood::Wide(wide) => json!({
            "columns": match (wide.across, wide.position) {
                (import::Across::Checkpoints, _) => "checkpoints",
                (import::Across::Positions, Some(_)) => "positions",
                (import::Across::Positions, None) => "members",
            },
            "position": wide.position.map(|(kind, _)| kind.name()),
            "checkpoints": wide.checkpoints,
            "from_to": wide.position.map(|(_, from_to)| from_to),
            "passed_over": wide.passed_over,
            "titles_passed_over": titles(&wide.titles),
            "left_out": wide.left_out,
            "sign_turned": wide.turned,
            "empty": wide.empty,
            "rows": wide.entries.len(),
        }),
    }
}

/// The sheets that are meant, those without a cell left out.
fn chosen<'s>(
    sheets: &'s [Sheet],
    table: &Path,
    args: &ImportArgs,
) -> Result<Vec<&'s Sheet>, CliError> {
    let names = || {
        let names: Vec<&str> = sheets.iter().map(|sheet| sheet.name.as_str()).collect();
        names.join(", ")
    };
    match (&args.sheet, sheets) {
        (None, [one]) => Ok(vec![one]),
        (None, all) if args.all_sheets => {
            let is_filled = |sheet: &&Sheet| sheet.rows.iter().flatten().any(|c| !c.is_empty());
            Ok(all.iter().filter(is_filled).collect())
        }
        (Some(name), _) => match sheets.iter().find(|sheet| sheet.name == *name) {
            Some(sheet) => Ok(vec![sheet]),
            None => Err(CliError::Unusable(format!(
                "{} has no sheet {name}; its sheets: {}",
                table.display(),
                names()
            ))),
        },
        (None, _) => Err(CliError::Unusable(format!(
            "{} has several sheets, name one with --sheet: {}; or take all, one after the other, by --all-sheets",
            table.display(),
            names()
        ))),
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
            "--sigma {sigma}: one standard deviation of the values in the quantity's own unit (um of depth, mg of mass), above 0. How well does a \
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

/// The text of the file with these rows.
fn with_rows(
    args: &ImportArgs,
    table: &str,
    before: Option<&str>,
    header: &str,
    rows: &[String],
) -> Result<String, CliError> {
    let Some(before) = before else {
        return Ok(format!("{header}\n{}\n", rows.join("\n")));
    };
    import::appended(before, header, rows).map_err(|error| {
        CliError::Unusable(match &args.output {
            Some(path) if args.append => format!("{}: {error}", path.display()),
            _ => format!("{table}: {error}"),
        })
    })
}
