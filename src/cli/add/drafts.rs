//! The studies that `add` fits: the effect in each of its forms, with set values or free.

use std::path::Path;

use super::target::folder;
use super::{AddArgs, CliError};
use crate::effects::{Card, Form, find};
use crate::study::{
    Edit, EffectSpec, FreeParameter, Study, WEAR_COEFFICIENT, wear_coefficient_fault,
};

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
    pub(super) fn form(&self) -> &'static str {
        self.form.map_or(OWN, |form| form.name)
    }
}

/// The forms to fit: the one asked for; else the own one first, and the others that the study states enough for unless the effect's own
/// parameters are set.
pub(in crate::cli) fn forms(
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
                let removed = card.name == "lead_misalignment" && name == "unloaded end";
                let hint = if removed {
                    "; the unloaded end is a negative slope: a fit finds its sign, or --set slope=-6 states it"
                } else {
                    ""
                };
                CliError::Unusable(format!(
                    "{} has no form `{name}`, allowed: {}{hint}",
                    card.name,
                    names.join(", ")
                ))
            })?;
            Ok(vec![Some(form)])
        }
    }
}

/// All that was set, by full names.
pub(super) fn settings(args: &AddArgs, card: &Card) -> Result<Vec<(String, f64)>, CliError> {
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
pub(super) fn draft(
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
    let is_set = |name: &str| set.iter().any(|(set, _)| set == name);
    let mut edit = study.edit();
    state(&mut edit, &spec, &is_set)?;
    if let Some((_, coefficient)) = set.iter().find(|(name, _)| name == WEAR_COEFFICIENT) {
        edit.set(WEAR_COEFFICIENT, *coefficient);
    }
    edit.move_between(folder(&args.study), folder(target))?;
    let study = edit.finish(&target.display().to_string())?;
    let free = study.free().iter();
    Ok(Draft {
        form,
        free: free.filter(|free| !is_set(&free.name)).cloned().collect(),
        study,
    })
}

/// The study with an effect more in one of its forms, under `name`; all that is fitted of it is free.
pub(in crate::cli) fn with_form(
    study: &Study,
    card: &'static Card,
    form: Option<&'static Form>,
    name: &str,
) -> Result<Study, CliError> {
    let mut edit = study.edit();
    state(&mut edit, &EffectSpec::of_form(card, form, &[])?, &|_| {
        false
    })?;
    Ok(edit.finish(name)?)
}

/// Adds an effect with all that is stated or fitted of it; what is fitted becomes free unless it is set.
fn state(
    edit: &mut Edit<'_>,
    spec: &EffectSpec,
    is_set: &dyn Fn(&str) -> bool,
) -> Result<(), CliError> {
    let fitted = spec.fitted();
    let is_fitted = |name: &str| fitted.iter().any(|free| free.name == name);
    let values: Vec<(String, f64)> = (spec.parameters.iter())
        .filter(|parameter| parameter.stated || is_fitted(&parameter.name))
        .map(|parameter| (parameter.short().to_owned(), parameter.value))
        .collect();
    let free: Vec<String> = (fitted.iter().map(|free| free.name.clone()))
        .filter(|name| !is_set(name))
        .collect();
    edit.add_effect(&spec.name, &values)?;
    edit.free(&free);
    Ok(())
}

/// The effect's card; a user's own effect has none.
pub(super) fn card(name: &str) -> Result<&'static Card, CliError> {
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

/// `name=value` with a number.
pub(super) fn setting(text: &str) -> Result<(String, f64), String> {
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
