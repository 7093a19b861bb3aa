//! `gearwear diagnose`: which physical effect the model lacks.

use std::path::Path;

use clap::Args;
use serde_json::json;

use super::args::StudyAndOutput;
use super::{CliError, Context, Outcome};
use super::{each, folder, inputs};
use crate::learn::diagnose::{Fidelity, diagnose};
use crate::learn::{Measured, questions};
use crate::report;
use crate::study::{self, Study};

/// Arguments of `diagnose`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gearwear diagnose study.toml\n  gearwear diagnose study.toml --fidelity middle\n  gearwear diagnose study.toml -o results/diagnosis --json\n  gearwear diagnose --each archive --fidelity middle"
)]
pub struct DiagnoseArgs {
    #[command(flatten)]
    paths: StudyAndOutput,
    /// Decide by the analytic contact model alone: seconds instead of a minute, and a model error (some per cent: `gearwear models` says how much) that may look like an effect
    #[arg(long, conflicts_with = "fidelity")]
    fast: bool,
    /// By which model candidates are compared at last; --fast is --fidelity screening. A study with `contact = "hertz"` is always
    /// decided by its own model
    #[arg(long, value_enum, value_name = "MODEL")]
    fidelity: Option<Deciding>,
    /// STUDY is a folder: diagnose every study in it (NAME.toml, NAME/study.toml), one table of all
    #[arg(long)]
    each: bool,
}

/// What the table of many studies says of each.
const COLUMNS: [each::Column; 6] = [
    ("verdict", |d| d["verdict"].clone()),
    ("effect", |d| each::joined(&d["effect"])),
    ("leader", |d| d["ranking"][0]["effect"].clone()),
    ("probability", |d| d["ranking"][0]["probability"].clone()),
    ("parameters", |d| {
        each::parameters(&d["ranking"][0]["parameters"])
    }),
    ("fit_chi2_per_point", |d| {
        d["ranking"][0]["fit_chi2_per_point"].clone()
    }),
];

/// Models to decide by.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum Deciding {
    /// The analytic contact model alone
    Screening,
    /// Finite elements, coarse ones for what effects change: for many data sets. Laws that depend sharply on pressure may come out with rough values: repeat with full before acting
    Middle,
    /// Finite elements as the study resolves them
    Full,
}

/// Checks the input and the folder, diagnoses, writes.
pub(super) fn execute(args: &DiagnoseArgs, context: &Context) -> Result<Outcome, CliError> {
    let path = &args.paths.study;
    if args.each {
        let output = args.paths.output.as_deref();
        return each::each(
            path,
            output,
            "diagnose",
            &COLUMNS,
            context,
            |study, target| one(args, study, target, context),
        );
    }
    let target =
        (args.paths.output.clone()).unwrap_or_else(|| folder::default_path(path, "diagnose"));
    one(args, path, &target, context)
}

/// Diagnoses one study.
fn one(
    args: &DiagnoseArgs,
    path: &Path,
    target: &Path,
    context: &Context,
) -> Result<Outcome, CliError> {
    let study = Study::load(path)?;
    let data = study.dataset_to_fit()?;
    context.tell_reading(&data);
    let _reserved = folder::reserve(target, path, &study)?;
    let fidelity = match args.fidelity {
        _ if args.fast || study.contact == study::ContactKind::Hertz => Fidelity::Screening,
        Some(Deciding::Screening) => Fidelity::Screening,
        Some(Deciding::Middle) => Fidelity::Middle,
        Some(Deciding::Full) | None => Fidelity::Full,
    };
    let measured = Measured::new(&study, data);
    let progress = context.progress("diagnose");
    let diagnosis = diagnose(&measured, fidelity, &|done, what| progress.show(done, what))?;
    let questions = questions(&measured, diagnosis.leaves_only_noise);
    let diagnosis = match questions.is_empty() && measured.data.has_slips() {
        true => diagnosis.beside_slips(),
        false => diagnosis.asking_first(questions),
    };
    drop(progress);
    let mut document = json!(diagnosis);
    document[inputs::KEY] = json!(inputs::identity(&study)?);
    let study_name = path.display().to_string();
    document["next_step"] = json!(diagnosis.next_step.replace("STUDY", &study_name));
    let page = report::diagnosis::page(&study.title, &diagnosis, &study_name);
    let map = report::discrepancy::csv(&diagnosis.discrepancy)?;
    let left = &diagnosis.residual_drivers;
    let further = [
        ("discrepancy.csv", map),
        ("residual_drivers.csv", report::drivers::bins(left)?),
        ("residual_rows.csv", report::drivers::rows(left)?),
    ];
    let written = report::write_page_with(&page, "diagnosis.json", &document, &further, target)?;
    Ok(Outcome {
        json: document,
        text: report::diagnosis::summary(&study.title, &diagnosis, &study_name, &written.folder),
        success: true,
    })
}
