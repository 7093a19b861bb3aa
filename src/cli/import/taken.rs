//! The tables that were read: the file with their rows, and what is shown of them.

use std::fmt::Write as _;
use std::path::Path;

use serde_json::{Value, json};

use super::args::ImportArgs;
use super::flanks::Flanks;
use super::summary;
use super::understood::Understood;
use crate::cli::{CliError, Outcome};
use crate::learn::cycles_in_another_unit;
use crate::measure::Dataset;
use crate::measure::import::{self, Sheet, There, Titles, Wanted};
use crate::report::write_file;
use crate::study::{Fault, Study, StudyError};

/// The table that was shown in full, to which others are alike.
struct Shown {
    columns: Vec<(String, String)>,
    titles: Titles,
}

/// What the tables read so far have given.
#[derive(Default)]
pub(super) struct Taken {
    /// The text of the measurement file with their rows.
    file: Option<String>,
    /// What is shown of them.
    text: String,
    /// What the command's document says of each.
    documents: Vec<Value>,
    shown: Option<Shown>,
    flanks: Flanks,
    /// Rows of all of them.
    count: usize,
}

impl Taken {
    /// Nothing yet, behind the text of a file that is continued.
    pub(super) fn after(file: Option<String>) -> Self {
        Self {
            file,
            ..Self::default()
        }
    }

    /// Says which of the sheets are not among those `chosen`, but for empty ones.
    pub(super) fn pass_over(&mut self, sheets: &[Sheet], chosen: &[&Sheet]) {
        for sheet in sheets {
            let is_chosen = chosen.iter().any(|one| one.name == sheet.name);
            let is_filled = sheet.rows.iter().flatten().any(|cell| !cell.is_empty());
            let why = match sheet.holds_numbers() {
                true => "as asked",
                false => "none of its rows holds two numbers",
            };
            if !is_chosen && is_filled {
                self.text += &format!("sheet {} passed over: {why}\n", sheet.name);
            }
        }
    }

    /// Takes in a sheet, `name` in messages.
    pub(super) fn take(
        &mut self,
        args: &ImportArgs,
        study: &Study,
        name: &str,
        sheet: &Sheet,
        wanted: &Wanted<'_>,
    ) -> Result<(), CliError> {
        let there = self.file.as_deref().map(There::of).unwrap_or_default();
        let wanted = &Wanted {
            there,
            ..wanted.clone()
        };
        let understood = Understood::of(sheet, wanted)
            .map_err(|error| CliError::Unusable(format!("{name}: {error}")))?;
        self.flanks.agree(name, &understood)?;
        let (header, rows) = import::lines(understood.entries());
        let source = source(args, self.file.is_some(), name);
        let whole = with_rows(args, name, self.file.as_deref(), &header, &rows)?;
        let mut warnings = wanted.there.swapped(understood.entries());
        warnings.extend(import::doubtful(understood.entries()));
        self.show(args, name, &understood, (&header, &rows));
        // what cannot be read back is not written
        let own = format!("{header}\n{}\n", rows.join("\n"));
        let alone = || Dataset::parse(&own, &source, &study.known());
        // a unit that does not fit shows in the table alone, not behind rows of others
        let read = Dataset::parse(&whole, &source, &study.known()).and_then(|all| {
            let of_unit = alone().err().filter(is_of_a_value);
            of_unit.map_or(Ok(all), Err)
        });
        if let Ok(data) = &read {
            warnings.extend(cycles_in_another_unit(study, data));
        }
        self.text += &summary::of_others(understood.joined(), &warnings);
        if let Err(error) = read {
            // the place within the table's own rows, where these alone are wrong
            let own = alone().err().filter(|_| !args.append);
            let error = own.unwrap_or(error);
            return Err(cannot_be_read(error, (name, &understood), &self.text));
        }
        self.count += rows.len();
        let mut document = understood.document();
        if !warnings.is_empty() {
            document["warnings"] = json!(warnings);
        }
        self.documents.push(document);
        self.file = Some(whole);
        Ok(())
    }

    /// Shows how a table was read: in full, or in how it differs from the one that was shown so.
    fn show(
        &mut self,
        args: &ImportArgs,
        name: &str,
        understood: &Understood,
        (header, rows): (&str, &[String]),
    ) {
        let columns = understood.columns();
        let titles = understood.titles();
        let alike = self.shown.as_ref().filter(|first| first.columns == columns);
        if let Some(first) = alike {
            self.text +=
                &summary::like_the_first(name, understood.entries(), titles, &first.titles);
            self.text += &summary::left_out(understood.left_out());
            return;
        }
        self.text += &match understood {
            Understood::Long(long) => summary::long(args, name, long),
            Understood::Wide(wide) => summary::wide(args, name, wide),
        };
        self.text += &summary::rows(header, rows);
        self.shown = Some(Shown {
            columns,
            titles: titles.clone(),
        });
    }

    /// Writes the file, if asked, and says so.
    pub(super) fn outcome(self, args: &ImportArgs, study: &Study) -> Result<Outcome, CliError> {
        if self.documents.is_empty() {
            return Err(CliError::Unusable(
                "no sheet of these tables holds anything".to_owned(),
            ));
        }
        let whole = self.file.unwrap_or_default();
        let mut text = self.text;
        let mut document = match <[Value; 1]>::try_from(self.documents) {
            Ok([one]) => one,
            Err(several) => json!({ "tables": several, "rows": self.count }),
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
                    read_from(study, &args.study, path),
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

/// Whether an error is one of the values, of each or of all.
fn is_of_a_value(error: &StudyError) -> bool {
    let fault = error.diagnostic();
    fault.fault == Fault::BadValue && fault.key == "value"
}

/// Why the rows of a table cannot be read back; where it lacks uncertainties, after what was `shown` of it.
fn cannot_be_read(
    error: StudyError,
    (name, understood): (&str, &Understood),
    shown: &str,
) -> CliError {
    let fault = error.diagnostic();
    let lacks_sigma = fault.fault == Fault::MissingKey && fault.key == "sigma";
    let mut entries = understood.entries().iter();
    let own = entries.find(|entry| entry.sigma.is_none());
    match own.filter(|_| lacks_sigma) {
        Some(entry) => CliError::Shown {
            shown: summary::without_sigma(shown),
            why: format!(
                "{name}: the table has no uncertainty of its {}, and its values are too few to estimate it from their scatter (several points along \
                 a trace, seven times of a test or repeated measurements would do). State one standard deviation with --sigma, in {}, or a share of \
                 each value with --relative-sigma, or add a column `sigma`; it may be left out only behind rows that show the \
                 scatter (-o FILE --append)",
                entry.quantity.name(),
                entry.quantity.shown_unit()
            ),
        },
        None => {
            let of_value = is_of_a_value(&error);
            if let Some(hint) = understood.unit_otherwise().filter(|_| of_value) {
                return error.without_hints().with_hint(&hint).into();
            }
            let unit = understood.unit_unstated().filter(|_| of_value);
            let hints = understood.reading().into_iter().chain(unit);
            hints
                .fold(error, |error, said| error.with_hint(&said))
                .into()
        }
    }
}
