//! `gearwear effects`: the catalogue of physical effects.

use std::fmt::Write;

use clap::Args;
use serde_json::{Value, json};

use super::text::wrap;
use super::{CliError, Outcome};
use crate::effects::formula::FUNCTIONS;
use crate::effects::{CATALOGUE, Card, Param, find};
use crate::numeric::written;

/// Arguments of `effects`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gearwear effects\n  gearwear effects running_in\n  gearwear effects --json"
)]
pub struct EffectsArgs {
    /// Effect to tell about [default: list all]
    #[arg(value_name = "EFFECT")]
    effect: Option<String>,
}

/// Lists the catalogue, or one of its cards.
pub(super) fn execute(args: &EffectsArgs) -> Result<Outcome, CliError> {
    let (cards, text) = match &args.effect {
        Some(name) => {
            let card = find(name)?;
            (vec![card], details(card))
        }
        None => (CATALOGUE.to_vec(), overview()),
    };
    Ok(Outcome {
        json: cards.into_iter().map(document).collect(),
        text,
        success: true,
    })
}

fn document(card: &Card) -> Value {
    let parameters: Vec<Value> = card
        .params
        .iter()
        .map(|param| {
            json!({
                "name": param.name,
                "unit": param.unit,
                "meaning": param.meaning,
                "default": number(param.default),
                "lower": number(param.range.0),
                "upper": number(param.range.1),
                "prior": param.prior.to_string(),
                "neutral": param.neutral.map(number),
                "fitted": param.fitted,
            })
        })
        .collect();
    let forms: Vec<Value> = card
        .forms
        .iter()
        .map(|form| {
            let settings: serde_json::Map<String, Value> = form
                .settings
                .iter()
                .map(|(name, value)| ((*name).to_owned(), number(*value)))
                .collect();
            json!({"name": form.name, "settings": settings, "fits": form.frees})
        })
        .collect();
    json!({
        "name": card.name,
        "formula": card.formula,
        "source": card.source,
        "parameters": parameters,
        "gives": card.hook.meaning(),
        "signature": card.signature,
        "confounded_with": card.confounded_with,
        "separated_by": card.separated_by,
        "left_out": card.left_out,
        "needs": card.needs,
        "forms": forms,
    })
}

/// JSON has no infinity: the word stands for it, as in a study file.
fn number(value: f64) -> Value {
    if value.is_infinite() {
        json!(if value > 0.0 { "inf" } else { "-inf" })
    } else {
        json!(value)
    }
}

fn overview() -> String {
    let mut text = String::new();
    let widest = CATALOGUE.iter().map(|card| card.name.len()).max();
    let indent = widest.unwrap_or_default() + 2;
    for card in CATALOGUE {
        let signature = card.signature.split(';').next().unwrap_or_default();
        let _ = writeln!(text, "{:indent$}{signature}", card.name);
    }
    let _ = writeln!(
        text,
        "\n{} effects; `gearwear effects EFFECT` shows all about one",
        CATALOGUE.len()
    );
    text
}

fn details(card: &Card) -> String {
    let mut text = format!("{}: {}\n\n", card.name, card.hook.meaning());
    wrap(&mut text, "  ", "    ", card.formula);
    text.push_str("\nsymbols\n");
    symbols(&mut text, card);
    text.push_str("\nparameters\n");
    for param in card.params {
        parameter(&mut text, param);
    }
    for form in card.forms {
        let settings = form.settings.iter();
        let settings = settings.map(|(name, value)| format!("{name} = {value}"));
        let freed = form.frees.iter().map(|name| format!("{name} fitted"));
        let all: Vec<String> = settings.chain(freed).collect();
        let line = format!("also accepted, {}: {}", form.name, all.join(", "));
        wrap(&mut text, "  ", "    ", &line);
    }
    if !card.needs.is_empty() {
        let line = format!("needs from the study: {}", card.needs.join(", "));
        wrap(&mut text, "\n", "  ", &line);
    }
    let confounded = match card.confounded_with {
        [] => "no effect of the catalogue".to_owned(),
        names => names.join(", "),
    };
    for (title, words) in [
        ("signature", card.signature),
        ("confounded with", &confounded),
        ("separated by", card.separated_by),
        ("left out", card.left_out),
        ("source", card.source),
    ] {
        let _ = writeln!(text, "\n{title}");
        wrap(&mut text, "  ", "  ", words);
    }
    text.push_str("\nin a study\n");
    let _ = writeln!(text, "  [[effect]]\n  kind = \"{}\"", card.name);
    for param in card.params.iter().filter(|param| param.fitted) {
        let _ = writeln!(text, "  {} = {:?}", param.name, param.default);
    }
    text
}

/// The variables and functions of the formula.
fn symbols(text: &mut String, card: &Card) {
    if let Ok((formula, _)) = card.compiled() {
        for variable in formula.variables() {
            let line = format!(
                "{} ({}): {}",
                variable.name,
                written::unit(variable.unit),
                variable.meaning
            );
            wrap(text, "  ", "      ", &line);
        }
    }
    for (name, _, meaning) in FUNCTIONS {
        if card.expression().contains(&format!("{name}(")) && !["min", "max"].contains(name) {
            let _ = writeln!(text, "  {name}(x): {meaning}");
        }
    }
    let _ = writeln!(text, "  and the parameters below");
}

fn parameter(text: &mut String, param: &Param) {
    let line = format!(
        "{} ({}): {}",
        param.name,
        written::unit(param.unit),
        param.meaning
    );
    wrap(text, "  ", "      ", &line);
    let mut line = format!(
        "{} ({} to {}); prior {}",
        param.default, param.range.0, param.range.1, param.prior
    );
    if let Some(neutral) = param.neutral {
        let _ = write!(line, "; does nothing at {neutral}");
    }
    if !param.fitted {
        line.push_str("; not fitted by default");
    }
    wrap(text, "      ", "      ", &line);
}
