//! `gearwear add`: one more effect in a study.
//!
//! ```text
//! study + effect -> drafts (the effect in each form, with set or default values, free where not set) -> fit what is free
//!       -> the draft that fits best -> new study file
//! ```

pub(super) mod drafts;
mod learned;
mod outcome;
mod target;
#[cfg(test)]
mod tests;

use std::path::PathBuf;

use clap::Args;

use self::drafts::{Draft, card, draft, forms, setting, settings};
use self::outcome::{Fitted, Report, fitted};
use self::target::{is_free, target, writable, write_whole};
use super::{CliError, Context, Outcome, inputs};
use crate::learn::diagnose::{Decided, Verdict};
use crate::learn::{AddedForm, ModelVersion};
use crate::measure::Dataset;
use crate::numeric::written;
use crate::study::{Study, WEAR_COEFFICIENT, rounded};

/// Arguments of `add`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gearwear add study.toml running_in\n  gearwear add study.toml tip_relief -o relieved.toml --set length=2.5\n  gearwear add study.toml running_in --set amplitude=3 --set decay_cycles=2e5 --set wear.coefficient=5e-10\n  gearwear add study.toml running_in --form hyperbolic\n  gearwear add study.toml learned:cycles\n  gearwear add study.toml learned:cycles --form step\n  gearwear add study.toml learned:radius:pinion --form profile"
)]
pub struct AddArgs {
    /// Study file (TOML); it stays as it is
    #[arg(index = 1, value_name = "STUDY")]
    study: PathBuf,
    /// Name of the effect; `gearwear effects` lists them. Or a law to be learned as a curve, learned:DRIVER or learned:DRIVER:MEMBER, of any
    /// variable of formulas
    // by number, since the completions replace it and would put it last
    #[arg(index = 2, value_name = "EFFECT")]
    effect: String,
    /// More settings behind one --set
    #[arg(index = 3, value_name = "NAME=VALUE", value_parser = setting, requires = "set", hide = true)]
    more: Vec<(String, f64)>,
    /// New study file [default: STEM+EFFECT.toml beside STUDY]
    #[arg(short, long, value_name = "NEWSTUDY")]
    output: Option<PathBuf>,
    /// Give a parameter of the effect, or wear.coefficient, this value instead of fitting it; may be repeated
    #[arg(long, value_name = "NAME=VALUE", value_parser = setting)]
    set: Vec<(String, f64)>,
    /// Fit this form of the effect, `own` or one that `gearwear effects EFFECT` lists; of a learned law `wear_factor` or `profile`, or the plain formula that stands for its curve:
    /// `step`, `until`, `band`, `hump`, `wave`, `decay`, `growth`, `power`, of times with `_in_approach` or `_in_recess` behind it,
    /// of places with `_from_a_moment`, or with `_spreading` [default: its own and the one that a
    /// finished diagnosis names, and the others too if its own leaves more than noise; its own alone where a parameter of the effect is set]
    #[arg(long, value_name = "FORM")]
    form: Option<String>,
    /// Overwrite the new study file
    #[arg(long)]
    force: bool,
}

/// Adds the effect, fits what is free, writes the new study.
pub(super) fn execute(args: &AddArgs, context: &Context) -> Result<Outcome, CliError> {
    if args.effect.starts_with(learned::PREFIX) {
        return learned::execute(args, context);
    }
    add(args, |study, drafts, data| {
        let decided = inputs::decided(&args.study, study)?;
        fit(&args.effect, drafts, decided.as_ref(), data, context)
    })
}

/// Fits the free parameters of the drafts to their measurements, from what a diagnosis of these has found where there is one.
fn fit(
    effect: &str,
    drafts: &[Draft],
    decided: Option<&Decided>,
    data: &Dataset,
    context: &Context,
) -> Result<Fitted, CliError> {
    context.tell_reading(data);
    let added = |draft: &Draft| {
        let version = ModelVersion {
            effects: draft.study.effect_model().clone(),
            free: draft.free.clone(),
        };
        let form = draft.form.map_or("", |form| form.name);
        let found = decided.map(|decided| decided.values_of(effect, form));
        let found = found.unwrap_or_default();
        AddedForm {
            named: !found.is_empty(),
            version: version.beginning_at(effect, found),
            grown: draft.form.map_or(&[], |form| form.grown),
        }
    };
    let forms: Vec<AddedForm> = drafts.iter().map(added).collect();
    let progress = context.progress("add");
    let addition = crate::learn::add(&drafts[0].study, data, &forms, &|doing, form| {
        super::fitting::show_form(&progress, doing, drafts[form].form());
    })?;
    let besides = decided.and_then(|decided| found_beside(effect, decided));
    let mut fitted = fitted(drafts, &addition, besides.as_deref());
    if let Some(decided) = decided {
        fitted.text += &named_otherwise(effect, decided);
        fitted.text += &named_beside(effect, decided);
    }
    Ok(fitted)
}

/// Probability of all that holds an effect from which a diagnosis does not speak against it.
const POSSIBLE: f64 = 0.05;

/// Whether a hypothesis has the effect, alone or with others.
fn holds(hypothesis: &str, effect: &str) -> bool {
    hypothesis.split('+').any(|name| name == effect)
}

/// Whether a finished diagnosis does not speak against the effect.
fn is_possible(effect: &str, decided: &Decided) -> bool {
    let held = (decided.probabilities.iter()).filter(|(name, _)| holds(name, effect));
    held.map(|(_, p)| p).sum::<f64>() >= POSSIBLE
}

/// In which company a finished diagnosis of the same inputs has an effect that it does not speak against.
fn found_beside(effect: &str, decided: &Decided) -> Option<String> {
    let held = (decided.probabilities.iter()).filter(|(name, _)| holds(name, effect));
    let (name, probability) = held
        .max_by(|a, b| a.1.total_cmp(b.1))
        .filter(|_| is_possible(effect, decided))?;
    let others: Vec<&str> = (name.split('+').filter(|other| *other != effect))
        .map(|other| match other {
            "unknown" => "something unknown",
            known => known,
        })
        .collect();
    let figure = format!("({})", written::probability(*probability));
    Some(match &others[..] {
        [] => {
            format!("the diagnosis of these measurements has it all the same, by itself {figure}")
        }
        _ => format!(
            "something else is missing besides: the diagnosis has it beside {} {figure}",
            others.join(" and ")
        ),
    })
}

/// What a finished diagnosis of the same inputs names, if it leaves the effect next to no probability; a line.
fn named_otherwise(effect: &str, decided: &Decided) -> String {
    let possible = is_possible(effect, decided);
    let named = matches!(
        decided.verdict,
        Verdict::Effect | Verdict::Effects | Verdict::Partial
    );
    let other = (decided.ranking.first())
        .filter(|first| named && !possible && !holds(&first.effect, effect));
    other.map_or(String::new(), |other| {
        format!(
            "  the diagnosis of these measurements names {} ({}), not this\n",
            other.effect,
            written::probability(other.probability)
        )
    })
}

/// What else a finished diagnosis of the same inputs finds missing where it names the effect among several; a line.
fn named_beside(effect: &str, decided: &Decided) -> String {
    let first = decided.ranking.first();
    let first = first.filter(|_| decided.verdict == Verdict::Effects);
    let names: Vec<&str> = first.map_or(Vec::new(), |first| first.effect.split('+').collect());
    let others: Vec<&str> = (names.iter().copied())
        .filter(|name| *name != effect)
        .collect();
    if others.is_empty() || others.len() == names.len() {
        return String::new();
    }
    format!(
        "  the diagnosis names {} together: these values are provisional until {} is in the study too\n",
        names.join(" and "),
        others.join(" and ")
    )
}

/// The command with its fit, which is asked only if a parameter has no set value.
fn add(
    args: &AddArgs,
    fit: impl FnOnce(&Study, &[Draft], &Dataset) -> Result<Fitted, CliError>,
) -> Result<Outcome, CliError> {
    let card = card(&args.effect)?;
    let study = Study::load(&args.study)?;
    let set = settings(args, card)?;
    let target = target(args, &study)?;
    let own_is_set = set.iter().any(|(name, _)| name != WEAR_COEFFICIENT);
    let mut drafts = Vec::new();
    for form in forms(card, args.form.as_deref(), own_is_set, &study)? {
        drafts.push(draft(args, card, form, &study, &target, &set)?);
    }
    is_free(&target, args)?;
    writable(&target).map_err(|source| CliError::Io {
        doing: "write",
        path: target.clone(),
        source,
    })?;
    let mut report = Report {
        set: set.len(),
        values: set,
        fit: None,
        text: String::new(),
    };
    let new = if drafts[0].free.is_empty() {
        drafts.swap_remove(0).study
    } else {
        // read where the user's own study names it: what is wrong there has a place that exists
        let data = study.dataset_to_fit()?;
        let own =
            |draft: &Draft| study.check_places_across_the_face(&data, draft.study.effect_model());
        // forms that the new study's own measurements would be refused with are none
        let first = own(&drafts[0]);
        drafts.retain(|draft| own(draft).is_ok());
        if drafts.is_empty() {
            first?;
        }
        let fitted = fit(&study, &drafts, &data)?;
        let mut edit = drafts[fitted.draft].study.edit();
        for (name, value) in fitted.values {
            let value = rounded(value);
            edit.set(&name, value);
            report.values.push((name, value));
        }
        report.fit = Some(fitted.json);
        report.text = fitted.text;
        edit.finish(&target.display().to_string())?
    };
    write_whole(&target, new.text()).map_err(|source| CliError::Io {
        doing: "write",
        path: target.clone(),
        source,
    })?;
    Ok(report.outcome(&target))
}
