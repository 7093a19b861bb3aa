//! `gearwear check`: everything that a comparison would read, what was understood of it, and what it could conclude.

use std::collections::BTreeMap;

use clap::Args;
use serde_json::json;

use super::args::StudyAndOutput;
use super::{CliError, Context, Outcome, fitting, folder};
use crate::learn::{
    ModelVersion, Prospects, contact_of, data_warnings, misfit_of_one_quantity, prospects,
    stated_sigma,
};
use crate::measure::{Dataset, Observation, Place, Quantity};
use crate::report::format::{count, plain, significant};
use crate::report::{self, comparison};
use crate::study::{Role, Study};

/// Arguments of `check`.
#[derive(Debug, Args)]
#[command(
    after_help = "Reads the study and its measurements, fits the model (by its analytic contact; by finite elements where something was\nmeasured over a rotation or depths have no trace; seconds) to look for wrong signs, units and zeros, and draws measurements against it. Exit code 2 where something cannot be read.\n\nExamples:\n  gearwear check study.toml\n  gearwear check study.toml -o looked-at"
)]
pub struct CheckArgs {
    #[command(flatten)]
    paths: StudyAndOutput,
}

/// Reads all, looks at it by the analytic model, says what was understood.
pub(super) fn execute(args: &CheckArgs, context: &Context) -> Result<Outcome, CliError> {
    let path = &args.paths.study;
    let study = Study::load(path)?;
    contact_of(&study)?;
    let data = study.dataset_to_fit()?;
    let default = || folder::default_path(path, "check");
    let target = args.paths.output.clone().unwrap_or_else(default);
    let _reserved = folder::reserve(&target, path, &study)?;
    // spur teeth in slices are for elements only
    let mut judged = if study.face.slices > 1 && study.gears.pinion.helix_angle == 0.0 {
        study.clone()
    } else {
        analytic(&study)?
    };
    let fit =
        |study: &Study| fitting::fitted(study, &data, &ModelVersion::of(study), context, "check");
    let mut compared = fit(&judged)?;
    // elements would follow a wrong unit into teeth worn away
    if judged.contact != study.contact
        && asks_for_elements(&data)
        && compared.comparison.sanity.is_empty()
    {
        judged = study.clone();
        compared = fit(&judged)?;
    }
    let name = path.display().to_string();
    let result = comparison::Result {
        study: &judged,
        name: &name,
        data: &data,
        fit: &compared.fit,
        comparison: &compared.comparison,
    };
    let written = report::write_comparison(&result, &target)?;
    let prospects = prospects(&study, &data);
    let mut warnings = data_warnings(&data);
    // nobody stated those that are estimated
    if !data.estimates_sigmas() {
        warnings.extend(stated_sigma(&study, &data, &compared.fit));
    }
    let carried = misfit_of_one_quantity(&study, &data, &compared.fit);
    let sanity = &compared.comparison.sanity;
    // nothing looks right where one quantity carries the misfit, whatever the reason
    let looks_right = sanity.is_empty() && carried.is_none();
    warnings.extend(carried);
    Ok(Outcome {
        json: json!({
            "reading": data.reading,
            "points": data.observations.len(),
            "curves": curves(&study, &data).len(),
            "sanity": sanity,
            "warnings": warnings,
            "can_show": prospects.can,
            "cannot_show": prospects.cannot,
        }),
        text: summary(
            &study,
            &data,
            (sanity, &warnings, looks_right),
            &prospects,
            &format!(
                "drawn:   {}\nnext:    {}gearwear compare {name}\n",
                written.folder.join("report.html").display(),
                if sanity.is_empty() {
                    ""
                } else {
                    "put right what stands under `check first`, then "
                }
            ),
        ),
        success: true,
    })
}

/// The study by the analytic model: most of what is looked for is far larger than what the models differ by.
fn analytic(study: &Study) -> Result<Study, CliError> {
    let mut edit = study.edit();
    edit.put("model.contact", "\"hertz\"");
    Ok(edit.finish(&study.source().name)?)
}

/// Whether something stands over a rotation, whose curve hangs on the deflection of the teeth, or depths have no trace, whose zeros may be off by
/// less than the models differ.
fn asks_for_elements(data: &Dataset) -> bool {
    let fine = |o: &Observation| {
        let has_no_datum = o.quantity == Quantity::WearDepth && o.trace.is_none();
        o.quantity.place() == Place::Rotation || has_no_datum
    };
    data.observations.iter().any(fine)
}

/// What is said of data in which nothing looks wrong.
fn right(data: &Dataset) -> &'static str {
    let depths = || (data.observations.iter()).filter(|o| o.quantity == Quantity::WearDepth);
    if depths().next().is_some() && depths().all(|o| o.trace.is_none()) {
        "signs and units look right; the zeros of profiles are taken as measured: name each profile in a column trace if its zero is not known"
    } else {
        "signs, units and zeros look right"
    }
}

/// What belongs to one line: test, member and quantity.
type Key = (usize, &'static str, &'static str);

fn curves<'d>(study: &Study, data: &'d Dataset) -> BTreeMap<Key, Vec<&'d Observation>> {
    let mut curves: BTreeMap<Key, Vec<&Observation>> = BTreeMap::new();
    for o in data
        .observations
        .iter()
        .filter(|o| o.test < study.tests.len())
    {
        let key = (o.test, o.member.name(), o.quantity.name());
        curves.entry(key).or_default().push(o);
    }
    curves
}

fn summary(
    study: &Study,
    data: &Dataset,
    (sanity, warnings, looks_right): (&[String], &[String], bool),
    prospects: &Prospects,
    end: &str,
) -> String {
    let mut lines = Vec::new();
    if !study.title.is_empty() {
        lines.push(study.title.clone());
    }
    let gears = [&study.gears.pinion, &study.gears.gear];
    let flanks = gears.map(|g| format!("{:.3} to {:.3} mm", g.form_radius, g.tip_radius));
    let helix = gears[0].helix_angle;
    let normal = plain(gears[0].rack.normal(helix).module);
    let module = if helix == 0.0 {
        format!("module {normal} mm")
    } else {
        format!(
            "normal module {normal} mm, helix angle {}°",
            plain(helix.to_degrees())
        )
    };
    lines.push(format!(
        "gears:   {} and {} teeth, {module}; flanks {} and {}",
        gears[0].spec.teeth, gears[1].spec.teeth, flanks[0], flanks[1]
    ));
    lines.push(format!(
        "file:    {}, {} values{}",
        data.name,
        data.observations.len(),
        if data.reading.is_empty() {
            String::new()
        } else {
            format!(" ({})", data.reading)
        }
    ));
    lines.push(String::new());
    let mut rows = vec![
        [
            "test", "member", "quantity", "values", "times", "places", "from", "to", "sigma",
            "traces",
        ]
        .map(str::to_owned),
    ];
    for ((test, member, quantity), own) in curves(study, data) {
        let distinct = |mut bits: Vec<u64>| {
            bits.sort_unstable();
            bits.dedup();
            bits.len().to_string()
        };
        let values = || own.iter().map(|o| o.value);
        let sigmas = own.iter().map(|o| o.sigma).sum::<f64>() / own.len() as f64;
        let traces: Vec<u64> = own
            .iter()
            .filter_map(|o| o.trace)
            .map(|t| t as u64)
            .collect();
        rows.push([
            study.tests[test].id.clone(),
            member.to_owned(),
            quantity.to_owned(),
            own.len().to_string(),
            distinct(own.iter().map(|o| o.cycles.to_bits()).collect()),
            distinct(
                own.iter()
                    .filter_map(|o| o.position)
                    .map(f64::to_bits)
                    .collect(),
            ),
            significant(values().fold(f64::INFINITY, f64::min), 3),
            significant(values().fold(f64::NEG_INFINITY, f64::max), 3),
            format!("{} {}", significant(sigmas, 2), own[0].quantity.unit()),
            distinct(traces),
        ]);
    }
    let widths: Vec<usize> = (0..rows[0].len())
        .map(|c| {
            rows.iter()
                .map(|row| row[c].chars().count())
                .max()
                .unwrap_or(0)
        })
        .collect();
    for row in &rows {
        let cells = row.iter().zip(&widths).enumerate();
        let padded: Vec<String> = cells
            .map(|(c, (cell, w))| {
                if c < 3 {
                    format!("{cell:<w$}")
                } else {
                    format!("{cell:>w$}")
                }
            })
            .collect();
        lines.push(format!("  {}", padded.join("  ")).trim_end().to_owned());
    }
    lines.push(String::new());
    for (number, test) in study.tests.iter().enumerate() {
        let held = if test.role == Role::Holdout {
            ", held out"
        } else {
            ""
        };
        let bare = data.observations.iter().all(|o| o.test != number);
        let misaligned = match test.conditions.misalignment_mm {
            0.0 => String::new(),
            mm => format!(", misalignment {} mm", plain(mm)),
        };
        lines.push(format!(
            "test {}: {} N·m, {} rpm{misaligned}, {} cycles{held}{}",
            test.id,
            plain(1e-3 * test.conditions.torque_nmm),
            plain(test.conditions.speed_rpm),
            count(test.conditions.cycles),
            if bare { "; no measurement" } else { "" }
        ));
    }
    lines.push(String::new());
    if looks_right {
        lines.push(right(data).to_owned());
    }
    for suspect in sanity {
        lines.push(format!("check first: {suspect}"));
    }
    for warning in warnings {
        lines.push(format!("warning:     {warning}"));
    }
    for can in &prospects.can {
        lines.push(format!("can show:    {can}"));
    }
    for cannot in &prospects.cannot {
        lines.push(format!("cannot show: {cannot}"));
    }
    lines.push(String::new());
    lines.join("\n") + end
}
