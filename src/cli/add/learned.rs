//! `add STUDY learned:DRIVER`: a law as a curve, learned from the measurements.

use std::fmt::Write as _;

use serde_json::{Value, json};

use super::target::{folder, is_free, target, writable, write_whole};
use super::{AddArgs, CliError, Context, Outcome};
use crate::effects::Hook;
use crate::learn::{
    AddLearnedError, LearnError, LearnedAddition, PlainForm, Share, WantedLaw, add_learned,
};
use crate::numeric::written::{fixed, significant};
use crate::report::comparison::NO_INTERVAL;
use crate::study::{EffectSpec, Study, WEAR_COEFFICIENT, rounded};

/// What the name of a law to be learned begins with.
pub(super) const PREFIX: &str = "learned:";

/// Learns the law, writes the new study.
pub(super) fn execute(args: &AddArgs, context: &Context) -> Result<Outcome, CliError> {
    let (wanted, shape) = wanted(args)?;
    let study = Study::load(&args.study)?;
    let target = target(args, &study)?;
    is_free(&target, args)?;
    let io = |source| CliError::Io {
        doing: "write",
        path: target.clone(),
        source,
    };
    writable(&target).map_err(io)?;
    refuse_what_it_lacks(&study, &wanted)?;
    let data = study.dataset_to_fit()?;
    context.tell_reading(&data);
    let progress = context.progress("add");
    let found = add_learned(&study, &data, (&wanted, shape), &|doing| {
        crate::cli::fitting::show(&progress, doing);
    });
    drop(progress);
    let found = found.map_err(|error| match error {
        AddLearnedError::Compare(error) => error.into(),
        AddLearnedError::Learn(LearnError::Fit(error)) => CliError::Fit(error),
        AddLearnedError::Learn(error) => CliError::Unusable(error.to_string()),
    })?;
    let mut edit = study.edit();
    let own = match &found.plain {
        Some(formula) => format!("{}.", formula.name),
        None => format!("{}.", wanted.name()),
    };
    for parameter in &found.compared.fit.parameters {
        if !parameter.name.starts_with(&own) {
            edit.set(&parameter.name, rounded(parameter.value));
        }
    }
    match &found.plain {
        Some(formula) => {
            edit.add_formula(formula)?;
            let names = formula.parameters.iter().map(|p| p.name.clone());
            edit.free(&names.collect::<Vec<_>>());
        }
        None => {
            edit.add_learned(&found.law)?;
            edit.free(&[wanted.name()]);
        }
    }
    edit.move_between(folder(&args.study), folder(&target))?;
    let new = edit.finish(&target.display().to_string())?;
    write_whole(&target, new.text()).map_err(io)?;
    Ok(outcome(&found, &wanted, &target.display().to_string()))
}

/// What is asked for: the law, and the plain formula that is to stand for its curve.
fn wanted(args: &AddArgs) -> Result<(WantedLaw, Option<PlainForm>), CliError> {
    if let Some((name, _)) = args.set.first() {
        return Err(CliError::Unusable(format!(
            "--set {name}: a learned law has no parameters to set; write knots and values into the study by hand"
        )));
    }
    let hooks = [Hook::WearFactor, Hook::Profile];
    let shape = args.form.as_deref().and_then(PlainForm::of_name);
    let hook = match args.form.as_deref() {
        None => Hook::WearFactor,
        Some(_) if shape.is_some() => Hook::WearFactor,
        Some(form) => hooks
            .into_iter()
            .find(|hook| hook.name() == form)
            .ok_or_else(|| {
                CliError::Unusable(format!(
                    "a learned law has no form `{form}`, allowed: \"wear_factor\" (a factor on k as a curve), \"profile\" (µm of material removed before the \
                     start), and for a factor on k by a plain formula: {}",
                    PlainForm::all().map(PlainForm::name).collect::<Vec<_>>().join(", ")
                ))
            })?,
    };
    let law = WantedLaw::of_name(&args.effect, hook);
    let law = law.map_err(|error| CliError::Unusable(error.to_string()))?;
    Ok((law, shape))
}

/// A law is not learned twice, nor of what the study does not state.
fn refuse_what_it_lacks(study: &Study, wanted: &WantedLaw) -> Result<(), CliError> {
    let name = wanted.name();
    if study.effect_model().has(&name) {
        return Err(CliError::Unusable(format!(
            "the study has {name} already; `gearwear compare` adjusts it where [fit] free names it"
        )));
    }
    match wanted.driver.needs.iter().find(|key| !study.states(key)) {
        Some(key) => Err(CliError::Unusable(format!(
            "{name} needs {key}, which the study does not state"
        ))),
        None => Ok(()),
    }
}

/// What was learned, in words and in the command's document.
fn outcome(found: &LearnedAddition, wanted: &WantedLaw, shown: &str) -> Outcome {
    let mut text = format!("wrote {shown}\n");
    let _ = writeln!(
        text,
        "  {WEAR_COEFFICIENT} = {:?}",
        rounded(found.compared.fit.coefficient)
    );
    match &found.plain {
        Some(formula) => text += &formula_in_words(found, formula),
        None => {
            let _ = writeln!(text, "  {}: {}", wanted.name(), law_in_words(found, wanted));
        }
    }
    text += &fit_in_words(found);
    let _ = writeln!(text, "next: gearwear compare {shown}");
    Outcome {
        json: json!({
            "written": [shown],
            "parameters": [{"name": WEAR_COEFFICIENT, "value": found.compared.fit.coefficient}],
            "fit": document(found, wanted),
        }),
        text,
        success: true,
    }
}

/// A formula in the place of the curve, with its values; lines.
fn formula_in_words(found: &LearnedAddition, formula: &EffectSpec) -> String {
    let mut text = format!("  {}: {}\n", formula.name, formula.expression());
    for parameter in &found.compared.comparison.parameters {
        let own = formula.parameters.iter().any(|p| p.name == parameter.name);
        if own {
            let known = match parameter.interval_95 {
                Some([low, high]) => format!(
                    "95 % between {} and {}",
                    significant(low, 4),
                    significant(high, 4)
                ),
                None => NO_INTERVAL.to_owned(),
            };
            let value = significant(parameter.value, 4);
            let _ = writeln!(text, "  {} = {value}   {known}", parameter.name);
        }
    }
    text
}

/// What the law spans and where.
fn law_in_words(found: &LearnedAddition, wanted: &WantedLaw) -> String {
    let law = &found.law;
    let knots = law.law.knots();
    let (first, last) = (knots[0], knots[knots.len() - 1]);
    let least = law.values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = law.values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let [least, most, unit] = match wanted.hook {
        Hook::WearFactor => [
            format!("{:.3}", least.exp()),
            format!("{:.3}", most.exp()),
            "times k".to_owned(),
        ],
        _ => [fixed(least, 2), fixed(most, 2), "µm".to_owned()],
    };
    format!(
        "{least} to {most} {unit}, at {} knots from {first} to {last}; size {}, length {}",
        knots.len(),
        law.size,
        law.length
    )
}

/// How well the fit describes the tests, and what to know of it; lines.
fn fit_in_words(found: &LearnedAddition) -> String {
    let (before, after) = (&found.without.comparison, &found.compared.comparison);
    let chi2 = |share: &Share| share.chi2_per_point.map(|chi2| format!("{chi2:.3}"));
    let mut text = String::new();
    for (what, before, after) in [
        ("fit", &before.fit, &after.fit),
        ("held-out", &before.holdout, &after.holdout),
    ] {
        if let (Some(before), Some(after)) = (chi2(before), chi2(after)) {
            let _ = writeln!(
                text,
                "  chi2 per point of the {what} tests: {after} (without it {before})"
            );
        }
    }
    if !after.converged {
        text.push_str("  the fit did not converge: these are the values where it stopped\n");
    }
    for warning in &after.warnings {
        let _ = writeln!(text, "  warning: {warning}");
    }
    text
}

/// The fit in the command's document.
fn document(found: &LearnedAddition, wanted: &WantedLaw) -> Value {
    let law = &found.law;
    let (before, after) = (&found.without.comparison, &found.compared.comparison);
    let tried: Vec<_> = (found.tried.iter())
        .map(|t| json!({"size": t.size, "length": t.length, "log_evidence": t.log_evidence}))
        .collect();
    json!({
        "formula": found.plain.as_ref().map(|formula| json!({"name": formula.name, "wear_factor": formula.expression()})),
        "learned": {
            "name": wanted.name(),
            "acts": wanted.hook.name(),
            "driver": wanted.driver.name,
            "member": wanted.member.map_or("both", crate::gear::Member::name),
            "knots": law.law.knots(),
            "values": law.values,
            "sigma": found.sigma,
            "size": law.size,
            "length": law.length,
            "tried": tried,
        },
        "log_evidence_gain": found.compared.fit.log_evidence - found.without.fit.log_evidence,
        "without": {"fit": before.fit, "holdout": before.holdout},
        "parameters": after.parameters,
        "fit": after.fit,
        "holdout": after.holdout,
        "converged": after.converged,
        "warnings": after.warnings,
    })
}
