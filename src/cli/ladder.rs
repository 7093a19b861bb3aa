//! `gearwear ladder`: versions of a model side by side, each fitted to its measurements.

use std::path::{Path, PathBuf};

use clap::Args;
use serde::Deserialize;

use super::{CliError, Context, Outcome, fitting, folder, inputs};
use crate::learn::diagnose::Fidelity;
use crate::learn::{self, Item, Version, compare_all, contact_of, precursors};
use crate::measure::Dataset;
use crate::report::{self, ladder};
use crate::study::Study;

/// Arguments of `ladder`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gearwear ladder study.toml study+running_in.toml\n  gearwear ladder study*.toml -o results/ladder\n  gearwear ladder study.toml study+tip_relief.toml --json --quiet | jq '.[].holdout_chi2_per_point'"
)]
pub struct LadderArgs {
    /// Study files (TOML), one for each version of the model, in the order of the ladder
    #[arg(value_name = "STUDY", required = true)]
    studies: Vec<PathBuf>,
    /// Result folder; a finished one is replaced, any other that is not empty is refused [default: STUDYSTEM.out/ladder beside the first study]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

/// What a ladder says of a finished diagnosis: by which model it decided.
#[derive(Debug, Deserialize)]
struct Diagnosed {
    ranking: Vec<Ranked>,
}

/// A line of its ranking.
#[derive(Debug, Deserialize)]
struct Ranked {
    decided_by: Fidelity,
}

/// By which model the finished diagnosis of a study decided on what leads; None without one.
fn diagnosed(path: &Path, study: &Study) -> Result<Option<Fidelity>, CliError> {
    let found: Option<Diagnosed> = inputs::finished(path, study, false)?;
    let leader = found.and_then(|diagnosis| diagnosis.ranking.into_iter().next());
    Ok(leader.map(|leader| leader.decided_by))
}

/// Checks all input and the folder, fits one version after the other, writes.
pub(super) fn execute(args: &LadderArgs, context: &Context) -> Result<Outcome, CliError> {
    let mut loaded: Vec<(Study, Dataset)> = Vec::new();
    for path in &args.studies {
        let study = Study::load(path)?;
        contact_of(&study)?;
        let data = study.dataset_to_fit()?;
        // versions of one model mostly have the same measurements
        let is_same =
            |(_, told): &(Study, Dataset)| told.name == data.name && told.reading == data.reading;
        if !loaded.iter().any(is_same) {
            context.tell_reading(&data);
        }
        if loaded
            .first()
            .is_some_and(|first| first.0.gears != study.gears)
        {
            return Err(CliError::Unusable(format!(
                "{} has other gears than {}; a ladder compares versions of one model of the same gears",
                path.display(),
                args.studies[0].display()
            )));
        }
        loaded.push((study, data));
    }
    let default = || folder::default_path(&args.studies[0], "ladder");
    let target = args.output.clone().unwrap_or_else(default);
    let _reserved = folder::reserve(&target, &args.studies[0], &loaded[0].0)?;
    for (file, (study, _)) in args.studies.iter().zip(&loaded).skip(1) {
        folder::apart(&target, file, study)?;
    }
    let items: Vec<Item<'_>> = loaded.iter().map(|(study, data)| (study, data)).collect();
    let progress = context.progress("ladder");
    let compared = compare_all(&items, &|number, doing| {
        fitting::show_one_of(&progress, doing, number, items.len());
    })?;
    drop(progress);
    let names: Vec<String> = args
        .studies
        .iter()
        .map(|p| p.display().to_string())
        .collect();
    let effects: Vec<Vec<String>> = items
        .iter()
        .map(|(study, _)| study.effects().iter().map(|e| e.name.clone()).collect())
        .collect();
    let versions: Vec<Version<'_>> = (precursors(&effects).into_iter().enumerate())
        .map(|(i, before)| Version {
            study: &names[i],
            effects: &effects[i],
            comparison: &compared[i].comparison,
            before: before.filter(|&before| learn::differences(items[before], items[i]).is_empty()),
        })
        .collect();
    let mut by = None;
    for ((path, name), (study, _)) in args.studies.iter().zip(&names).zip(&loaded) {
        by = diagnosed(path, study)?.map(|fidelity| (name.as_str(), fidelity));
        if by.is_some() {
            break;
        }
    }
    let result = ladder::Result {
        diagnosed: by,
        title: &loaded[0].0.title,
        steps: learn::ladder(&versions),
        comparisons: compared.iter().map(|c| &c.comparison).collect(),
        notes: items
            .iter()
            .map(|item| learn::differences(items[0], *item))
            .collect(),
    };
    let written = report::write_ladder(&result, &target)?;
    Ok(Outcome {
        json: ladder::document(&result)?,
        text: ladder::summary(&result, &written.folder),
        success: true,
    })
}
