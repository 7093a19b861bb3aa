//! `gearwear plan`: what to measure next, or first.

use clap::Args;
use serde_json::json;

use super::args::StudyAndOutput;
use super::{CliError, Context, Outcome};
use super::{folder, inputs};
use crate::learn::Measured;
use crate::learn::diagnose::{plan_after, plan_first};
use crate::report;
use crate::study::Study;

/// Arguments of `plan`.
#[derive(Debug, Args)]
#[command(
    after_help = "With measurements: all feasible tests, by how well each separates the leaders of the diagnosis in STUDYSTEM.out/diagnose if that is of the same study and measurements, without it the leaders by the analytic model.\nWithout: the tests that show and tell apart most effects of the catalogue.\nOnly tests are suggested that the rig can run: [rig] in the study states its limits (torque_max = 120, hours_max = 40, ...).\nTests are judged by the analytic contact model.\n\nExamples:\n  gearwear plan study.toml\n  gearwear plan study.toml --tests 3 --noise 0.05\n  gearwear plan study.toml -o results/plan --json --quiet | jq '.tests[0]'"
)]
pub struct PlanArgs {
    #[command(flatten)]
    paths: StudyAndOutput,
    /// Noise of what was not measured yet, relative to the largest value of each trace
    #[arg(long, value_name = "REL", default_value_t = 0.02, value_parser = noise, allow_negative_numbers = true)]
    noise: f64,
    /// Most tests of a first campaign
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u8).range(1..=12))]
    tests: u8,
}

/// What to do where the measurements are still to be made.
const NOT_YET_MEASURED: &str = "before anything is measured, take [measurements] out of the study: `gearwear plan` then chooses the first tests";

/// Checks the input and the folder, plans, writes.
pub(super) fn execute(args: &PlanArgs, context: &Context) -> Result<Outcome, CliError> {
    let study = Study::load(&args.paths.study)?;
    study.check_wears()?;
    let data = match &study.measurements {
        Some(file) => Some(study.dataset().map_err(|error| match file.exists() {
            true => error,
            false => error.with_hint(NOT_YET_MEASURED),
        })?),
        None => None,
    };
    if let Some(data) = &data {
        context.tell_reading(data);
    }
    let default = || folder::default_path(&args.paths.study, "plan");
    let target = args.paths.output.clone().unwrap_or_else(default);
    let _reserved = folder::reserve(&target, &args.paths.study, &study)?;
    let progress = context.progress("plan");
    let watch = |done, what| progress.show(done, what);
    let plan = match data {
        Some(data) => {
            let decided = inputs::decided(&args.paths.study, &study)?;
            let measured = Measured::new(&study, data);
            plan_after(&measured, decided.as_ref(), args.noise, &watch)?
        }
        None => plan_first(&study, args.noise, usize::from(args.tests), &watch)?,
    };
    drop(progress);
    let document = json!(plan);
    let study_name = args.paths.study.display().to_string();
    let page = report::plan::page(&study.title, &plan, &study_name);
    let further = [("plan.csv", report::plan::csv(&plan).into_bytes())];
    let written = report::write_page_with(&page, "plan.json", &document, &further, &target)?;
    Ok(Outcome {
        json: document,
        text: report::plan::summary(&study.title, &plan, &study_name, &written.folder),
        success: true,
    })
}

/// A relative noise; without any, everything would show.
fn noise(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(value) if value > 0.0 && value <= 1.0 => Ok(value),
        _ => Err("noise is a share of the largest value, above 0 up to 1".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_a_share_above_nothing() {
        assert_eq!(noise("0.02"), Ok(0.02));
        for bad in ["0", "-1", "2", "NaN", "much"] {
            assert!(noise(bad).is_err(), "{bad}");
        }
    }
}
