//! `gearwear materials`: published wear coefficients of material pairs.

use std::fmt::Write;

use clap::Args;
use serde_json::{Value, json};

use super::text::wrap;
use super::{CliError, Outcome};
use crate::material::{WEAR_PAIRS, WearPair, wear_pair};
use crate::source_text::nearest;

/// Arguments of `materials`.
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  gearwear materials\n  gearwear materials pom-pa66\n  gearwear materials --json"
)]
pub struct MaterialsArgs {
    /// Pair to tell about [default: list all]
    #[arg(value_name = "PAIR")]
    pair: Option<String>,
}

/// mm²/N in 1e-6 mm³/(N m).
const PER_METRE: f64 = 1e9;

/// Lists the pairs, or shows all about one.
pub(super) fn execute(args: &MaterialsArgs) -> Result<Outcome, CliError> {
    let (pairs, text) = match &args.pair {
        Some(name) => {
            let pair = wear_pair(name).ok_or_else(|| {
                let names = WEAR_PAIRS.iter().map(|pair| pair.name);
                let near = nearest(name, names).unwrap_or_default();
                CliError::Unusable(format!(
                    "there is no pair of materials `{name}`; the nearest is `{near}`"
                ))
            })?;
            (vec![pair], details(pair))
        }
        None => (WEAR_PAIRS.iter().collect(), overview()),
    };
    Ok(Outcome {
        json: pairs.into_iter().map(document).collect(),
        text,
        success: true,
    })
}

fn document(pair: &WearPair) -> Value {
    json!({
        "name": pair.name,
        "worn": pair.worn,
        "against": pair.against,
        "coefficient": pair.coefficient,
        "range": pair.range,
        "unit": "mm2/N",
        "spread": pair.spread,
        "scatter": pair.scatter,
        "conditions": pair.conditions,
        "source": pair.source,
        "place": pair.place,
        "read": pair.read,
    })
}

fn overview() -> String {
    let widest = WEAR_PAIRS.iter().map(|pair| pair.name.len()).max();
    let indent = widest.unwrap_or_default() + 2;
    let mut text = format!("{:indent$}{:>9}  worn / against\n", "pair", "k, mm2/N");
    for pair in WEAR_PAIRS {
        let _ = writeln!(
            text,
            "{:indent$}{:>9.2e}  {} / {}",
            pair.name, pair.coefficient, pair.worn, pair.against
        );
    }
    let _ = writeln!(
        text,
        "\n{} pairs; `gearwear materials PAIR` gives conditions, scatter and source of one",
        WEAR_PAIRS.len()
    );
    text
}

fn details(pair: &WearPair) -> String {
    let mut text = format!("{}: {} against {}\n\n", pair.name, pair.worn, pair.against);
    let _ = writeln!(
        text,
        "  k = {:.3e} mm2/N, {:.3} times 1e-6 mm3/(N m)",
        pair.coefficient,
        PER_METRE * pair.coefficient
    );
    let [least, most] = pair.range;
    if most > least {
        let _ = writeln!(text, "  from {least:.2e} to {most:.2e} mm2/N");
    }
    let _ = writeln!(
        text,
        "  prior in fits: one standard deviation is a factor of {}",
        pair.spread
    );
    for (title, words) in [
        ("scatter", pair.scatter),
        ("conditions", pair.conditions),
        ("source", pair.source),
        ("place", pair.place),
        ("what was read", pair.read),
    ] {
        let _ = writeln!(text, "\n{title}");
        wrap(&mut text, "  ", "  ", words);
    }
    let _ = writeln!(
        text,
        "\nin a study, for both members or for one\n  [wear]\n  material = \"{0}\"\n  [wear.gear]\n  material = \"{0}\"",
        pair.name
    );
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_pair_is_told_with_its_source_and_an_unknown_one_with_the_nearest() {
        let of = |pair: Option<&str>| {
            execute(&MaterialsArgs {
                pair: pair.map(str::to_owned),
            })
        };
        let all = of(None).unwrap();
        assert_eq!(all.json.as_array().unwrap().len(), WEAR_PAIRS.len());
        assert!(WEAR_PAIRS.iter().all(|pair| all.text.contains(pair.name)));
        let one = of(Some("pa66-pom")).unwrap();
        for part in [
            "2.650e-9 mm2/N, 2.650 times 1e-6",
            "rtpcompany.com",
            "factor of 3",
        ] {
            assert!(one.text.contains(part), "{}", one.text);
        }
        let wrong = of(Some("pa66_pom")).unwrap_err().to_string();
        assert!(wrong.contains("the nearest is `pa66-pom`"), "{wrong}");
    }
}
