//! A learned law as an `[[effect]]` of the study file.

use toml::de::DeValue;

use super::{KEYS, LearnedLaw};
use crate::effects::{Hook, LARGEST_LOGARITHM, Learned, LearnedError};
use crate::gear::Member;
use crate::source_text::{Diagnostic, list};
use crate::study::effect::Result;
use crate::study::effect_model::EffectSpec;
use crate::study::quantity as q;
use crate::study::reader::Table;
use crate::study::values::plain_number;

/// An `[[effect]]` of this kind.
pub(in crate::study) fn read(table: &Table<'_>) -> Result<EffectSpec> {
    table.check_known(KEYS)?;
    table.name(
        "name",
        "a title of your own; results name a learned law by its driver",
    )?;
    let hook = hook(table)?;
    let Some(driver) = table.name("driver", "the variable that the law follows")? else {
        return Err(Box::new(
            table.missing("driver", &list(Learned::drivers(hook))),
        ));
    };
    let member = member(table)?;
    let [knots, values] = [
        required(table, "knots", "numbers in the driver's unit, ascending")?,
        required(table, "values", "one number for each knot")?,
    ];
    let law = Learned::new(hook, driver, member, &knots)
        .map_err(|error| Box::new(refusal(table, hook, &error)))?;
    check_values(table, &law, &values)?;
    let size = positive(table, "size", LearnedLaw::usual_size(law.hook()))?;
    let length = positive(table, "length", LearnedLaw::usual_length(law.knots()))?;
    Ok(EffectSpec {
        span: table.header(),
        ..LearnedLaw::new(law, values, size, length).spec()
    })
}

fn hook(table: &Table<'_>) -> Result<Hook> {
    let hooks = Learned::HOOKS.map(|hook| (hook.name(), hook));
    match table.choice("acts", &hooks)? {
        Some(hook) => Ok(hook),
        None => Err(Box::new(
            table.missing("acts", &list(hooks.map(|(name, _)| name))),
        )),
    }
}

/// The member that it acts on; both where none is named.
fn member(table: &Table<'_>) -> Result<Option<Member>> {
    let members = [
        ("both", None),
        ("pinion", Some(Member::Pinion)),
        ("gear", Some(Member::Gear)),
    ];
    Ok(table.choice("member", &members)?.flatten())
}

/// Why there is no such law that acts through `hook`, at the key that is to blame.
fn refusal(table: &Table<'_>, hook: Hook, error: &LearnedError) -> Diagnostic {
    match error {
        LearnedError::Driver { nearest, .. } => table
            .refuse(
                "driver",
                &format!("is nothing that {} can follow", hook.name()),
                list(Learned::drivers(hook)),
            )
            .with_hint(format!("the nearest is \"{nearest}\"")),
        LearnedError::Knots(message) => {
            let mut refusal = table.refuse(
                "knots",
                "",
                "at least 2 numbers, each above the one before it",
            );
            refusal.message = format!("{}: {message}", refusal.key);
            refusal
        }
        LearnedError::Hook { .. } => table.refuse("acts", "is none of a learned law", ""),
    }
}

/// Refuses values that are not one for each knot, or that the law's hook does not take.
fn check_values(table: &Table<'_>, law: &Learned, values: &[f64]) -> Result<()> {
    let knots = law.knots();
    if values.len() != knots.len() {
        let mut refusal = table.refuse("values", "", "one value for each knot");
        refusal.message = format!(
            "{} has {} values for {} knots",
            refusal.key,
            values.len(),
            knots.len()
        );
        return Err(Box::new(refusal));
    }
    let (range, allowed, why) = match law.hook() {
        Hook::WearFactor => (
            -LARGEST_LOGARITHM..=LARGEST_LOGARITHM,
            format!(
                "{} to {}",
                q::Short(-LARGEST_LOGARITHM),
                q::Short(LARGEST_LOGARITHM)
            ),
            "values are natural logarithms of the factor: 0 leaves the wear as it is",
        ),
        Hook::AddedDepth => (
            0.0..=f64::MAX,
            "0 or more".to_owned(),
            "µm per contact of that member",
        ),
        _ => (
            f64::MIN..=f64::MAX,
            "any finite number".to_owned(),
            "µm of material removed before the start",
        ),
    };
    if let Some(n) = values.iter().position(|v| !range.contains(v)) {
        let mut refusal = table.refuse("values", "", allowed).with_hint(why);
        refusal.message = format!("{}: value {} is {}", refusal.key, n + 1, values[n]);
        return Err(Box::new(refusal));
    }
    Ok(())
}

/// A number above 0; `usual` where none is stated.
fn positive(table: &Table<'_>, key: &str, usual: f64) -> Result<f64> {
    match table.number(key, &q::ANY)? {
        Some(number) if number > 0.0 && number.is_finite() => Ok(number),
        Some(_) => Err(Box::new(table.refuse(key, "is not above 0", "above 0"))),
        None => Ok(usual),
    }
}
/// A list of numbers that must be there.
fn required(table: &Table<'_>, key: &str, wanted: &str) -> Result<Vec<f64>> {
    let Some((value, span)) = table.get(key) else {
        return Err(Box::new(table.missing(key, wanted)));
    };
    let wanted = format!("a list of {wanted}");
    let DeValue::Array(items) = value else {
        return Err(table.wrong_type(key, value, span, &wanted).into());
    };
    let read = |item: &toml::Spanned<DeValue<'_>>| match plain_number(item.get_ref()) {
        Some(number) if number.is_finite() => Ok(number),
        _ => Err(Box::from(table.wrong_type(
            key,
            item.get_ref(),
            item.span(),
            &wanted,
        ))),
    };
    items.iter().map(read).collect()
}
