//! `gearwear check`: everything that a comparison would read, what was understood of it, and what it could conclude.

mod summary;

use std::collections::BTreeMap;

use clap::Args;
use serde_json::json;

use self::summary::{Found, summary};
use super::args::StudyAndOutput;
use super::{CliError, Context, Outcome, fitting, folder};
use crate::learn::{
    ModelVersion, contact_of, data_warnings, differing_tests, misfit_of_one_quantity, prospects,
    scatter_of_new_profile, stated_sigma,
};
use crate::measure::{Dataset, Observation, Place, Quantity};
use crate::report::{self, comparison};
use crate::study::Study;

/// Arguments of `check`.
#[derive(Debug, Args)]
#[command(
    after_help = "Reads the study and its measurements, fits the model (by its analytic contact; by finite elements where something was measured over a rotation or depths have no trace; seconds) to look for wrong signs, units and zeros, and draws measurements against it. Exit code 2 where something cannot be read.\n\nExamples:\n  gearwear check study.toml\n  gearwear check study.toml -o looked-at"
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
    let sanity = &compared.comparison.sanity;
    // nobody stated those that are estimated, and about a fit to wrong values all scatters
    if !data.estimates_sigmas() && sanity.is_empty() {
        warnings.extend(stated_sigma(&study, &data, &compared.fit));
    }
    let shared = scatter_of_new_profile(&study, &data, &compared.fit);
    // what is wrong as a whole shows most somewhere
    let carried = match sanity.is_empty() {
        true => misfit_of_one_quantity(&study, &data, &compared.fit),
        false => None,
    };
    warnings.extend(shared);
    // nothing looks right where one quantity carries the misfit, whatever the reason
    let looks_right = sanity.is_empty() && carried.is_none();
    warnings.extend(carried);
    // of wrong values k says nothing
    if sanity.is_empty() {
        warnings.extend(differing_tests(&study, &data, &compared.fit));
    }
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
            &Found {
                sanity,
                warnings: &warnings,
                looks_right,
                prospects: &prospects,
            },
            &format!(
                "drawn:   {}\n{}next:    {}gearwear compare {name}\n",
                written.folder.join("report.html").display(),
                match judged.contact == study.contact {
                    true => "",
                    false =>
                        "model:   analytic contact; gearwear compare fits by finite elements: it sees smaller slips, and what is off here by a little may be right there\n",
                },
                match (sanity.is_empty(), data.has_slips()) {
                    (false, _) =>
                        "look at what stands under `check first` and put right what is wrong there, then ",
                    (true, true) =>
                        "look at the rows that stand far apart from their neighbours and put right what is wrong there, then ",
                    (true, false) => "",
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
