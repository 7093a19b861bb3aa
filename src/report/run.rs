//! Whole result folders.
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use serde::Serialize;
use serde_json::json;

use super::drawings::{Picture, stress_pictures};
use super::error::OutputError;
use super::html::{self, Case, Page};
use super::{Staging, bitmap, comparison, csv, json as documents, ladder, models, vtk};
use crate::gear::Pair;
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

/// How far the files of the fields are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldsWritten {
    /// Files that stand.
    pub files: usize,
    /// Files that there will be.
    pub of: usize,
    /// Bytes of all together, by the size of those that stand.
    pub bytes: u64,
}

/// Writes the result of `run`.
///
/// # Errors
/// [`OutputError`]; then nothing stands under the folder's name.
pub fn write_run(run: &Run, folder: &Path) -> Result<Written, OutputError> {
    write_run_with(run, None, &[], folder, &|_| {})
}

/// Writes the result of `run`, its gears drawn from `pair`, with further files (name, content), such as what it was made from.
/// `watch` sees the files of the fields, which take longest, as they are written.
///
/// # Errors
/// [`OutputError`]; then nothing stands under the folder's name.
pub fn write_run_with(
    run: &Run,
    pair: Option<&Pair>,
    further: &[(&str, &[u8])],
    folder: &Path,
    watch: &(dyn Fn(FieldsWritten) + Sync),
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
    if let Some(turn) = csv::transmission_error_turn(run)? {
        staging.write("transmission_error_turn.csv", &turn)?;
    }
    // drawing takes a core, writing fields mostly waits
    let (written, drawn) = rayon::join(
        || {
            write_fields(run, &mut staging, watch)?;
            write_flanks(run, &mut staging)
        },
        || {
            let page = html::run(run, pair)?;
            let mut pictures = pictures(&page)?;
            pictures.extend(stress_pictures(run)?);
            Ok((pictures, page))
        },
    );
    written?;
    let (pictures, mut page): (Vec<Picture>, Page) = drawn?;
    write_pictures(&pictures, &mut staging)?;
    page.sections
        .push(html::files_of_run(run, staging.written()));
    staging.write("report.html", page.html()?.as_bytes())?;
    finish(staging)
}

/// Every plot and drawing of a page.
fn pictures(page: &Page) -> Result<Vec<Picture>, OutputError> {
    let picture = |name: &str, svg: String| {
        let png = bitmap::of_svg(name, &svg)?;
        Ok(Picture {
            name: name.to_owned(),
            svg,
            png,
        })
    };
    let plots: Vec<_> = page.plots().collect();
    let plots: Result<Vec<Picture>, OutputError> = plots
        .par_iter()
        .map(|plot| picture(&plot.name, plot.svg()?))
        .collect();
    let drawings: Vec<_> = page.drawings().filter(|d| !d.name.is_empty()).collect();
    let drawings: Result<Vec<Picture>, OutputError> = drawings
        .par_iter()
        .map(|drawing| picture(&drawing.name, drawing.svg()))
        .collect();
    let mut all = plots?;
    all.extend(drawings?);
    Ok(all)
}

fn write_pictures(pictures: &[Picture], staging: &mut Staging) -> Result<(), OutputError> {
    for Picture { name, svg, png } in pictures {
        staging.write(&format!("plots/{name}.svg"), svg.as_bytes())?;
        staging.write(&format!("plots/{name}.png"), png)?;
    }
    Ok(())
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
    let document = comparison::document(result)?;
    let further = [("residuals.csv", comparison::residuals(result)?)];
    let page = html::comparison(result);
    write_page_with(&page, "comparison.json", &document, &further, folder)
}

/// Writes `ladder.json`, its page and its plots.
pub fn write_ladder(result: &ladder::Result<'_>, folder: &Path) -> Result<Written, OutputError> {
    let document = ladder::document(result)?;
    write_page(&html::ladder(result), "ladder.json", &document, folder)
}

/// Writes `validation.json`, the summary of all families as page and as Markdown (`RESULTS.md`), and a page for each family under `cases`.
pub fn write_validation(cases: &[Case], folder: &Path) -> Result<Written, OutputError> {
    let mut staging = Staging::begin(folder)?;
    let summary = html::summary(cases);
    staging.write(
        "validation.json",
        &documents::text("validation.json", &json!({"cases": cases}))?,
    )?;
    staging.write("RESULTS.md", summary.markdown().as_bytes())?;
    staging.write("report.html", summary.html()?.as_bytes())?;
    for family in html::family_pages(cases) {
        let name = |extension: &str| format!("{}.{extension}", family.file);
        staging.write(&name("md"), family.page.markdown().as_bytes())?;
        staging.write(&name("html"), family.page.html()?.as_bytes())?;
    }
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
    write_pictures(&pictures(page)?, &mut staging)?;
    staging.write("report.html", page.html()?.as_bytes())?;
    finish(staging)
}

fn write_fields(
    run: &Run,
    staging: &mut Staging,
    watch: &(dyn Fn(FieldsWritten) + Sync),
) -> Result<(), OutputError> {
    if run.fields.is_empty() {
        return Ok(());
    }
    let files = vtk::names(&run.fields);
    let all: Vec<_> = files.iter().zip(&run.fields).collect();
    let (mut stand, mut bytes_standing) = (0, 0);
    // a few at a time: compressing takes a core, and not all need to be in memory at once
    for some in all.chunks(rayon::current_num_threads().max(1)) {
        let written: Result<Vec<(String, Vec<u8>)>, OutputError> = some
            .par_iter()
            .map(|(file, frame)| {
                let name = format!("fields/{}", file.name);
                let bytes = vtk::vtu(&name, frame)?;
                Ok((name, bytes))
            })
            .collect();
        for (name, bytes) in written? {
            staging.write(&name, &bytes)?;
            stand += 1;
            bytes_standing += bytes.len() as u64;
        }
        watch(FieldsWritten {
            files: stand,
            of: all.len(),
            bytes: bytes_standing * all.len() as u64 / stand as u64,
        });
    }
    staging.write(
        "fields/wear.pvd",
        &vtk::pvd(&vtk::wear_series(&run.fields, &files)),
    )?;
    for (name, series) in vtk::mesh_cycle_series(&run.fields, &files) {
        staging.write(&format!("fields/{name}"), &vtk::pvd(&series))?;
    }
    if let Some(script) = vtk::paraview(run) {
        staging.write("fields/open_in_paraview.py", script.as_bytes())?;
    }
    let loads = vtk::loads(files.iter().zip(&run.fields));
    staging.write(
        "fields/loads.json",
        &documents::text("fields/loads.json", &loads)?,
    )
}

/// The flanks over the face, by state.
fn write_flanks(run: &Run, staging: &mut Staging) -> Result<(), OutputError> {
    let mut series = Vec::new();
    for (cycles, name, bytes) in vtk::flank_surfaces(run) {
        staging.write(&format!("fields/{name}"), &bytes)?;
        series.push((cycles, name));
    }
    if series.is_empty() {
        return Ok(());
    }
    staging.write("fields/flanks.pvd", &vtk::pvd(&series))
}

fn finish(staging: Staging) -> Result<Written, OutputError> {
    let files = staging.written().to_vec();
    let folder = staging.commit()?;
    Ok(Written { folder, files })
}
