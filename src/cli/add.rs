//! `gearwear add`: one more effect in a study.
//!
//! ```text
//! study + effect -> drafts (the effect in each form, with set or default values, free where not set) -> fit what is free
//!       -> the draft that fits best -> new study file
//! ```

use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::{Value, json};

use super::{CliError, Context, Outcome};
use crate::effects::{Card, Form, find};
use crate::learn::{AddedForm, Addition, ModelVersion, Share};
use crate::measure::Dataset;
use crate::study::{
    EffectSpec, FreeParameter, Study, WEAR_COEFFICIENT, rounded, wear_coefficient_fault,
};

/// Arguments of `add`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gearwear add study.toml running_in\n  gearwear add study.toml tip_relief -o relieved.toml --set length=2.5\n  gearwear add study.toml running_in --set amplitude=3 --set decay_cycles=2e5 --set wear.coefficient=5e-10\n  gearwear add study.toml running_in --form hyperbolic"
)]
pub struct AddArgs {
    /// Study file (TOML); it stays as it is
    #[arg(value_name = "STUDY")]
    study: PathBuf,
    /// Name of the effect; `gearwear effects` lists them
    #[arg(value_name = "EFFECT")]
    effect: String,
    /// More settings behind one --set
    #[arg(value_name = "NAME=VALUE", value_parser = setting, requires = "set", hide = true)]
    more: Vec<(String, f64)>,
    /// New study file [default: STEM+EFFECT.toml beside STUDY]
    #[arg(short, long, value_name = "NEWSTUDY")]
    output: Option<PathBuf>,
    /// Give a parameter of the effect, or wear.coefficient, this value instead of fitting it; may be repeated
    #[arg(long, value_name = "NAME=VALUE", value_parser = setting)]
    set: Vec<(String, f64)>,
    /// Fit this form of the effect, `own` or one that `gearwear effects EFFECT` lists [default: its own, and the others too if that
    /// leaves more than noise and no parameter of the effect is set]
    #[arg(long, value_name = "FORM")]
    form: Option<String>,
    /// Overwrite the new study file
    #[arg(long)]
    force: bool,
}

/// Name of the form that the card's own values make.
const OWN: &str = "own";

/// The study with the effect in it, in one form.
#[derive(Debug)]
pub(super) struct Draft {
    /// The form; None for the effect's own.
    pub(super) form: Option<&'static Form>,
    /// The study with every fitted parameter stated, free unless set.
    pub(super) study: Study,
    /// What is to be adjusted.
    pub(super) free: Vec<FreeParameter>,
}

impl Draft {
    fn form(&self) -> &'static str {
        self.form.map_or(OWN, |form| form.name)
    }
}

/// What a fit found: a value for each parameter that it was asked for, and what else it has to say.
#[derive(Debug)]
pub(super) struct Fitted {
    /// Which of the drafts.
    pub(super) draft: usize,
    /// Names and values.
    pub(super) values: Vec<(String, f64)>,
    /// Joins the command's document under `fit`.
    pub(super) json: Value,
    /// Joins the command's text; lines, the last one ended.
    pub(super) text: String,
}

/// Adds the effect, fits what is free, writes the new study.
pub(super) fn execute(args: &AddArgs, context: &Context) -> Result<Outcome, CliError> {
    add(args, |drafts, data| fit(drafts, data, context))
}

/// Fits the free parameters of the drafts to their measurements.
fn fit(drafts: &[Draft], data: &Dataset, context: &Context) -> Result<Fitted, CliError> {
    let forms: Vec<AddedForm> = drafts
        .iter()
        .map(|draft| AddedForm {
            version: ModelVersion {
                effects: draft.study.effect_model().clone(),
                free: draft.free.clone(),
            },
            grown: draft.form.map_or(&[], |form| form.grown),
        })
        .collect();
    let progress = context.progress("add");
    let addition = crate::learn::add(&drafts[0].study, data, &forms, &|doing, form| {
        super::fitting::show_form(&progress, doing, drafts[form].form());
    })?;
    Ok(told(drafts, &addition))
}

/// A fit in words and in the command's document.
fn told(drafts: &[Draft], addition: &Addition) -> Fitted {
    let (fit, comparison) = (&addition.compared.fit, &addition.compared.comparison);
    let chosen = drafts[addition.form].form();
    let mut text = String::new();
    for p in &fit.parameters {
        let [low, high] = p.interval;
        let at_bound = if p.at_bound { ", at a bound" } else { "" };
        // an interval belongs to a most probable state
        let known = if fit.converged {
            format!("95 % between {low:.4e} and {high:.4e}")
        } else {
            format!("{:.4e} where the fit stopped, no interval", p.value)
        };
        let _ = writeln!(text, "    {}: {known}{at_bound}", p.name);
    }
    let chi2 = |share: &Share| share.chi2_per_point.map(|chi2| format!("{chi2:.3}"));
    if let Some(chi2) = chi2(&comparison.fit) {
        let _ = writeln!(text, "  chi2 per point of the fit tests: {chi2}");
    }
    if let Some(chi2) = chi2(&comparison.holdout) {
        let _ = writeln!(text, "  chi2 per point of the held-out tests: {chi2}");
    }
    let tried: Vec<Value> = (drafts.iter().zip(&addition.tried))
        .filter_map(|(draft, tried)| {
            let tried = (*tried)?;
            Some(json!({
                "form": draft.form(),
                "log_evidence": tried.log_evidence,
                "chi2_per_point": tried.chi2_per_point,
            }))
        })
        .collect();
    if tried.len() > 1 {
        let each = drafts
            .iter()
            .zip(&addition.tried)
            .filter_map(|(draft, tried)| {
                let chi2 = (*tried)?.chi2_per_point?;
                Some(format!("{} {chi2:.3}", draft.form()))
            });
        let each: Vec<String> = each.collect();
        let _ = writeln!(
            text,
            "  form of the law: {chosen} (chi2 per point by form: {})",
            each.join(", ")
        );
    }
    for warning in &comparison.warnings {
        let _ = writeln!(text, "  warning: {warning}");
    }
    Fitted {
        draft: addition.form,
        values: (fit.parameters.iter())
            .map(|p| (p.name.clone(), p.value))
            .collect(),
        json: json!({
            "form": chosen,
            "forms": tried,
            "parameters": comparison.parameters,
            "fit": comparison.fit,
            "holdout": comparison.holdout,
            "converged": comparison.converged,
            "warnings": comparison.warnings,
        }),
        text,
    }
}

/// The command with its fit, which is asked only if a parameter has no set value.
fn add(
    args: &AddArgs,
    fit: impl FnOnce(&[Draft], &Dataset) -> Result<Fitted, CliError>,
) -> Result<Outcome, CliError> {
    let card = card(&args.effect)?;
    let study = Study::load(&args.study)?;
    let target = target(args, &study)?;
    writable(&target).map_err(|source| CliError::Io {
        doing: "write",
        path: target.clone(),
        source,
    })?;
    let set = settings(args, card)?;
    let own_is_set = set.iter().any(|(name, _)| name != WEAR_COEFFICIENT);
    let mut drafts = Vec::new();
    for form in forms(card, args.form.as_deref(), own_is_set, &study)? {
        drafts.push(draft(args, card, form, &study, &target, &set)?);
    }
    let mut report = Report {
        values: set,
        fit: None,
        text: String::new(),
    };
    let new = if drafts[0].free.is_empty() {
        drafts.swap_remove(0).study
    } else {
        // read where the user's own study names it: what is wrong there has a place that exists
        let data = study.dataset_to_fit()?;
        let fitted = fit(&drafts, &data)?;
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

/// The forms to fit: the one asked for; else the own one first, and the others that the study states enough for unless the effect's own
/// parameters are set.
fn forms(
    card: &'static Card,
    asked: Option<&str>,
    set: bool,
    study: &Study,
) -> Result<Vec<Option<&'static Form>>, CliError> {
    let suits = |form: &'static Form| {
        let spec = EffectSpec::of_form(card, Some(form), &[]);
        spec.is_ok_and(|spec| study.suits(&spec))
    };
    let others = card.forms.iter().filter(|form| suits(form)).map(Some);
    match asked {
        None if set => Ok(vec![None]),
        None => Ok(std::iter::once(None).chain(others).collect()),
        Some(OWN) => Ok(vec![None]),
        Some(name) => {
            let form = card.forms.iter().find(|form| form.name == name);
            let form = form.ok_or_else(|| {
                let names: Vec<String> = std::iter::once(OWN)
                    .chain(card.forms.iter().map(|form| form.name))
                    .map(|name| format!("\"{name}\""))
                    .collect();
                CliError::Unusable(format!(
                    "{} has no form `{name}`, allowed: {}",
                    card.name,
                    names.join(", ")
                ))
            })?;
            Ok(vec![Some(form)])
        }
    }
}

/// What the command tells.
struct Report {
    values: Vec<(String, f64)>,
    fit: Option<Value>,
    text: String,
}

impl Report {
    fn outcome(self, target: &Path) -> Outcome {
        let shown = target.display().to_string();
        let mut text = format!("wrote {shown}\n");
        for (name, value) in &self.values {
            let _ = writeln!(text, "  {name} = {value:?}");
        }
        text.push_str(&self.text);
        let _ = writeln!(text, "next: gearwear compare {shown}");
        let values: Vec<Value> = self
            .values
            .iter()
            .map(|(name, value)| json!({"name": name, "value": value}))
            .collect();
        let mut document = json!({"written": [shown], "parameters": values});
        if let Some(fit) = self.fit {
            document["fit"] = fit;
        }
        Outcome {
            json: document,
            text,
            success: true,
        }
    }
}

/// All that was set, by full names.
fn settings(args: &AddArgs, card: &Card) -> Result<Vec<(String, f64)>, CliError> {
    let prefix = format!("{}.", card.name);
    let mut set: Vec<(String, f64)> = Vec::new();
    for (name, value) in args.set.iter().chain(&args.more) {
        let short = name.strip_prefix(&prefix).unwrap_or(name);
        let full = if name == WEAR_COEFFICIENT {
            name.clone()
        } else {
            format!("{prefix}{short}")
        };
        if set.iter().any(|(above, _)| *above == full) {
            return Err(CliError::Unusable(format!(
                "--set {name} stands there twice"
            )));
        }
        if let Some(fault) = wear_coefficient_fault(*value).filter(|_| full == WEAR_COEFFICIENT) {
            return Err(CliError::Unusable(format!(
                "--set {name}={value} is {fault}"
            )));
        }
        if full == WEAR_COEFFICIENT && *value == 0.0 {
            return Err(CliError::Unusable(format!(
                "--set {name}=0 switches wear off: nothing is left to fit"
            )));
        }
        set.push((full, *value));
    }
    Ok(set)
}

/// The study with the effect in it in one form, every fitted parameter stated and free unless set.
fn draft(
    args: &AddArgs,
    card: &'static Card,
    form: Option<&'static Form>,
    study: &Study,
    target: &Path,
    set: &[(String, f64)],
) -> Result<Draft, CliError> {
    let prefix = format!("{}.", card.name);
    let own = (set.iter()).filter_map(|(name, value)| Some((name.strip_prefix(&prefix)?, *value)));
    let own: Vec<(&str, f64)> = own.collect();
    let fixed = |form: &Form, name: &str| {
        let of_form = form.settings.iter().find(|(fixed, _)| *fixed == name);
        of_form
            .filter(|_| !form.frees.contains(&name))
            .map(|(_, value)| *value)
    };
    for &(name, value) in &own {
        if let Some((form, fixed)) = form.and_then(|form| Some((form, fixed(form, name)?)))
            && fixed != value
        {
            return Err(CliError::Unusable(format!(
                "--set {name}={value} contradicts --form \"{}\", which has {name} = {fixed}",
                form.name
            )));
        }
    }
    let spec = EffectSpec::of_form(card, form, &own)?;
    let fitted = spec.fitted();
    let is_fitted = |name: &str| fitted.iter().any(|free| free.name == name);
    let values: Vec<(String, f64)> = spec
        .parameters
        .iter()
        .filter(|parameter| parameter.stated || is_fitted(&parameter.name))
        .map(|parameter| (parameter.short().to_owned(), parameter.value))
        .collect();
    let free: Vec<String> = (fitted.iter().map(|free| free.name.clone()))
        .filter(|name| !set.iter().any(|(set, _)| set == name))
        .collect();
    let mut edit = study.edit();
    edit.add_effect(card.name, &values)?;
    edit.free(&free);
    if let Some((_, coefficient)) = set.iter().find(|(name, _)| name == WEAR_COEFFICIENT) {
        edit.set(WEAR_COEFFICIENT, *coefficient);
    }
    edit.move_between(folder(&args.study), folder(target))?;
    let study = edit.finish(&target.display().to_string())?;
    let free = study.free().iter();
    Ok(Draft {
        form,
        free: free
            .filter(|free| !set.iter().any(|(name, _)| *name == free.name))
            .cloned()
            .collect(),
        study,
    })
}

fn folder(file: &Path) -> &Path {
    file.parent().unwrap_or(Path::new(""))
}

/// The effect's card; a user's own effect has none.
fn card(name: &str) -> Result<&'static Card, CliError> {
    if name == "formula" || Path::new(name).is_file() {
        return Err(CliError::Unusable(format!(
            "add takes an effect of the catalogue, not `{name}`; a formula of your own is written into the study by hand:\n\n  \
             [[effect]]\n  kind = \"formula\"\n  name = \"soft_band\"\n  wear_factor = \"1 + a*exp(-((radius-r0)/w)^2)\"\n  \
             [effect.parameters]\n  a = {{ value = 1.0, lower = 0.0, upper = 10.0 }}\n  r0 = 26.4\n  w = 0.2\n\n  \
             and [fit] free = [\"wear.coefficient\", \"soft_band.a\"] lets compare adjust it"
        )));
    }
    Ok(find(name)?)
}

/// Where the new study goes; refuses to overwrite unasked.
fn target(args: &AddArgs, study: &Study) -> Result<PathBuf, CliError> {
    let target = args.output.clone().unwrap_or_else(|| {
        let mut name = args.study.file_stem().unwrap_or_default().to_owned();
        name.push(format!("+{}.toml", args.effect));
        args.study.with_file_name(name)
    });
    if target.is_dir() {
        return Err(CliError::Unusable(format!(
            "{} is a folder; add needs the name of the new study file",
            target.display()
        )));
    }
    let same = |a: &Path, b: &Path| {
        a.canonicalize()
            .is_ok_and(|a| b.canonicalize().is_ok_and(|b| a == b))
    };
    if same(&target, &args.study) {
        return Err(CliError::Unusable(format!(
            "{} is the study itself, which stays as it is; name another file for the new one",
            target.display()
        )));
    }
    if let Some(input) = study
        .inputs()
        .into_iter()
        .find(|input| same(&target, input))
    {
        return Err(CliError::Unusable(format!(
            "{} is a file that the study names; name another file for the new one",
            input.display()
        )));
    }
    if target.exists() && !args.force {
        return Err(CliError::Exists { path: target });
    }
    Ok(target)
}

/// The file under which a target is written before it gets its name.
fn partial(target: &Path) -> PathBuf {
    let name = target.file_name().unwrap_or_default().to_string_lossy();
    target.with_file_name(format!(".{name}.partial-{}", std::process::id()))
}

/// Whether the target's folder, if it is there, takes a file: a fit takes a while, and its answer must have a place.
fn writable(target: &Path) -> io::Result<()> {
    let folder = folder(target);
    if !folder.as_os_str().is_empty() && !folder.is_dir() {
        return Ok(());
    }
    let partial = partial(target);
    File::create(&partial)?;
    fs::remove_file(&partial)
}

/// Writes a file whole or not at all: under another name beside it, flushed, then renamed. Its folder is made if it is not there.
fn write_whole(target: &Path, text: &str) -> io::Result<()> {
    let folder = folder(target);
    if !folder.as_os_str().is_empty() {
        fs::create_dir_all(folder)?;
    }
    let partial = partial(target);
    let written = File::create(&partial).and_then(|mut file| {
        file.write_all(text.as_bytes())?;
        file.sync_all()?;
        fs::rename(&partial, target)
    });
    if written.is_err() {
        // what remains of a failed attempt is nobody's
        let _ = fs::remove_file(&partial);
    }
    written
}

/// `name=value` with a number.
fn setting(text: &str) -> Result<(String, f64), String> {
    let (name, value) = text
        .split_once('=')
        .ok_or("name=value is needed, for example amplitude=3")?;
    let number: f64 = value
        .trim()
        .parse()
        .map_err(|_| format!("`{value}` is no number"))?;
    if number.is_nan() {
        return Err(format!("`{value}` is no number"));
    }
    Ok((name.trim().to_owned(), number))
}

#[cfg(test)]
mod tests;
