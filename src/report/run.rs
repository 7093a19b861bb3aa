//! Whole result folders.
use std::path::{Path, PathBuf};

use serde::Serialize;
use serde_json::json;

use super::error::OutputError;
use super::html::{self, Case, Page};
use super::{Staging, comparison, csv, json as documents, ladder, models, plots, vtk};
use crate::simulate::models::Comparison;
use crate::simulate::result::Run;

/// A finished result folder.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    /// The folder, absolute.
    pub folder: PathBuf,
    /// Files in it, relative, in the order written.
    pub files: Vec<String>,
}

/// Writes the result of `run`.
pub fn write_run(run: &Run, folder: &Path) -> Result<Written, OutputError> {
    write_run_with(run, &[], folder)
}

/// Writes the result of `run` with further files (name, content), such as what it was made from.
pub fn write_run_with(
    run: &Run,
    further: &[(&str, &[u8])],
    folder: &Path,
) -> Result<Written, OutputError> {
    let mut staging = Staging::begin(folder)?;
    for (name, content) in further {
        staging.write(name, content)?;
    }
    staging.write(
        "summary.json",
        &documents::text("summary.json", &documents::summary(run)?)?,
    )?;
    staging.write("wear.csv", &csv::wear(run)?)?;
    staging.write("contact.csv", &csv::contact(run)?)?;
    staging.write("transmission_error.csv", &csv::transmission_error(run)?)?;
    for plot in plots::of_run(run) {
        staging.write(&format!("plots/{}.svg", plot.name), plot.svg()?.as_bytes())?;
    }
    write_fields(run, &mut staging)?;
    let page = html::run(run, staging.written())?;
    staging.write("report.html", page.as_bytes())?;
    finish(staging)
}

/// Writes `models.json`, its page and its plots; `title` is the study's own.
pub fn write_models(
    title: &str,
    comparison: &Comparison,
    folder: &Path,
) -> Result<Written, OutputError> {
    let document = models::document(title, comparison);
    write_page(
        &html::models(title, comparison),
        "models.json",
        &document,
        folder,
    )
}

/// Writes `comparison.json`, `residuals.csv`, its page and its plots.
pub fn write_comparison(
    result: &comparison::Result<'_>,
    folder: &Path,
) -> Result<Written, OutputError> {
    let document = comparison::document(result.comparison)?;
    let further = [("residuals.csv", comparison::residuals(result)?)];
    let page = html::comparison(result);
    write_page_with(&page, "comparison.json", &document, &further, folder)
}

/// Writes `ladder.json`, its page and its plots.
pub fn write_ladder(result: &ladder::Result<'_>, folder: &Path) -> Result<Written, OutputError> {
    let document = ladder::document(result)?;
    write_page(&html::ladder(result), "ladder.json", &document, folder)
}

/// Writes `validation.json`, its page, and the same as Markdown (`RESULTS.md`).
pub fn write_validation(cases: &[Case], folder: &Path) -> Result<Written, OutputError> {
    let mut staging = Staging::begin(folder)?;
    let page = html::validation(cases);
    staging.write(
        "validation.json",
        &documents::text("validation.json", &json!({"cases": cases}))?,
    )?;
    staging.write("RESULTS.md", page.markdown().as_bytes())?;
    staging.write("report.html", page.html()?.as_bytes())?;
    finish(staging)
}

/// Writes any document with a page of its own: `name`, `report.html` and the page's plots.
pub fn write_page(
    page: &Page,
    name: &str,
    document: &impl Serialize,
    folder: &Path,
) -> Result<Written, OutputError> {
    write_page_with(page, name, document, &[], folder)
}

/// The same with further files (name, content).
pub fn write_page_with(
    page: &Page,
    name: &str,
    document: &impl Serialize,
    further: &[(&str, Vec<u8>)],
    folder: &Path,
) -> Result<Written, OutputError> {
    let mut staging = Staging::begin(folder)?;
    staging.write(name, &documents::text(name, document)?)?;
    for (name, content) in further {
        staging.write(name, content)?;
    }
    for plot in page.sections.iter().flat_map(|section| &section.plots) {
        staging.write(&format!("plots/{}.svg", plot.name), plot.svg()?.as_bytes())?;
    }
    staging.write("report.html", page.html()?.as_bytes())?;
    finish(staging)
}

fn write_fields(run: &Run, staging: &mut Staging) -> Result<(), OutputError> {
    if run.fields.is_empty() {
        return Ok(());
    }
    let files = vtk::names(&run.fields);
    for (file, frame) in files.iter().zip(&run.fields) {
        let name = format!("fields/{}", file.name);
        staging.write(&name, &vtk::vtu(&name, frame)?)?;
    }
    staging.write(
        "fields/wear.pvd",
        &vtk::pvd(&vtk::wear_series(&run.fields, &files)),
    )?;
    for (name, series) in vtk::mesh_cycle_series(&run.fields, &files) {
        staging.write(&format!("fields/{name}"), &vtk::pvd(&series))?;
    }
    let loads = vtk::loads(files.iter().zip(&run.fields));
    staging.write(
        "fields/loads.json",
        &documents::text("fields/loads.json", &loads)?,
    )
}

fn finish(staging: Staging) -> Result<Written, OutputError> {
    let files = staging.written().to_vec();
    let folder = staging.commit()?;
    Ok(Written { folder, files })
}
