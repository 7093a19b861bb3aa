//! Titles by which the values below are not what they would be read as: rates, shares, increments, both flanks together, units with a number.
//!
//! A header beside a column of such values is not known and so refused; a title above a table would be passed over.

use super::{ImportError, PerInterval, units};
use crate::measure::{Quantity, names};

/// Words and what they make of the values.
const OTHERS: [(&str, &[&str]); 2] = [
    (
        "rates",
        &[
            "rate",
            "rates",
            "verschleissrate",
            "abtragsrate",
            "abtragrate",
            "taux",
            "tasso",
            "tasa",
        ],
    ),
    (
        "shares",
        &[
            "normalised",
            "normalized",
            "normiert",
            "normierte",
            "normierter",
            "normalise",
            "normalizzata",
            "percent",
            "prozent",
        ],
    ),
];
/// Words for what was lost since the last measurement.
const INCREMENTS: [&str; 5] = [
    "increment",
    "increments",
    "incremental",
    "inkrement",
    "zuwachs",
];
/// Words for losses, beside those that name a quantity.
const LOSSES: [&str; 12] = [
    "depth", "tiefe", "wear", "loss", "losses", "verlust", "verluste", "perte", "pertes",
    "perdita", "perdite", "perdidas",
];
/// Losses of thickness, which both flanks make.
const THICKNESSES: [&str; 5] = [
    "thickness",
    "zahndickenabnahme",
    "zahndickenverlust",
    "epaisseur",
    "spessore",
];
const BOTH: [&str; 7] = [
    "both", "beide", "beider", "beiden", "deux", "entrambi", "ambos",
];
const FLANKS: [&str; 8] = [
    "flank", "flanks", "flanke", "flanken", "flanc", "flancs", "fianchi", "flancos",
];
/// Directions of depths that are not along the normal.
const TANGENTIAL: [&str; 7] = [
    "circumferential",
    "umfangsrichtung",
    "tangential",
    "tangentiale",
    "tangentiel",
    "circonferentiel",
    "circonferenziale",
];
/// `per`, with what makes rates, increments or single teeth of values.
const PER: [&str; 5] = ["per", "pro", "je", "par", "por"];
const TIMES: [&str; 14] = [
    "hour",
    "h",
    "stunde",
    "heure",
    "ora",
    "hora",
    "cycle",
    "cycles",
    "million",
    "mio",
    "umdrehung",
    "revolution",
    "rev",
    "lastwechsel",
];
const TEETH: [&str; 5] = ["tooth", "zahn", "dent", "dente", "diente"];
const LAST: [&str; 6] = [
    "last", "previous", "letzter", "letzten", "letztem", "derniere",
];
const SINCE: [&str; 4] = ["since", "seit", "depuis", "dalla"];
/// Words before a stop, with an article between, by which a title speaks of that stop alone: `du palier`, `in the interval`.
const WITHIN: [&str; 15] = [
    "im", "du", "dans", "pendant", "del", "della", "dell", "nel", "nella", "nell", "durante",
    "during", "within", "in", "wahrend",
];
const ARTICLES: [&str; 10] = [
    "the", "le", "la", "l", "lo", "el", "der", "dem", "des", "each",
];
/// Units that are not read.
const FOREIGN: [&str; 11] = [
    "%",
    "mil",
    "mils",
    "thou",
    "microinch",
    "microinches",
    "uin",
    "cm",
    "m",
    "oz",
    "lb",
];

/// Refuses a title row that speaks of the values of a quantity, or of nothing but a unit, and says that they are others; of intervals, unless the user
/// says so too.
pub(super) fn refuse(
    text: &str,
    row: usize,
    quantity: Quantity,
    per_interval: &PerInterval,
) -> Result<(), ImportError> {
    let words = names::words(text);
    let speaks = words.iter().any(|word| {
        names::quantity(word).is_some_and(|(named, _)| named == quantity)
            || LOSSES.contains(&word.as_str())
            || word.starts_with("verschleiss")
            || word.starts_with("abtrag")
            || THICKNESSES.contains(&word.as_str())
    });
    if !speaks {
        return Ok(());
    }
    if per_interval.losses.contains(&quantity) && are_increments(&words) {
        return Ok(());
    }
    let Some(what) = others(text, &words, quantity) else {
        return Ok(());
    };
    let added_up = if are_increments(&words) && PerInterval::LOSSES.contains(&quantity) {
        format!("say --per-interval {}, ", quantity.name())
    } else {
        String::new()
    };
    let wanted = match quantity {
        Quantity::MassLoss => "losses of a whole member",
        Quantity::WearDepth => "depths of one flank",
        _ => "totals",
    };
    Err(ImportError(format!(
        "row {}: `{text}`: {what}, and the table would be read as {wanted} since the start of the test: {added_up}write these, in {}, or take the words \
         out of the title if that is what they are",
        row + 1,
        quantity.unit()
    )))
}

/// Whether a word that is meant follows one for `per`: `per hour`.
fn per(words: &[String], is_meant: impl Fn(&str) -> bool) -> bool {
    let mut pairs = words.windows(2);
    pairs.any(|two| PER.contains(&two[0].as_str()) && is_meant(&two[1]))
}

/// Whether a title speaks of what was lost since the last measurement.
fn are_increments(words: &[String]) -> bool {
    let has = |known: &[&str]| words.iter().any(|word| known.contains(&word.as_str()));
    has(&INCREMENTS)
        || per(words, names::is_stop)
        || has(&SINCE) && has(&LAST)
        || is_within_a_stop(words)
}

/// Whether a title speaks of what was lost between two stops, `Verlust im Abschnitt`; a numbered one says when it was measured.
fn is_within_a_stop(words: &[String]) -> bool {
    let is = |at: Option<usize>, known: &[&str]| {
        at.is_some_and(|at| known.contains(&words[at].as_str()))
    };
    (0..words.len()).any(|at| {
        let before = at.checked_sub(1);
        let follows = match is(before, &ARTICLES) {
            true => is(at.checked_sub(2), &WITHIN),
            false => is(before, &WITHIN) && !is(before, &["in"]),
        };
        let is_numbered = words
            .get(at + 1)
            .is_some_and(|next| next.starts_with(|c: char| c.is_ascii_digit()));
        names::is_stop(&words[at]) && follows && !is_numbered
    })
}

/// What the values are by a title, if it is something else.
fn others(text: &str, words: &[String], quantity: Quantity) -> Option<String> {
    let has = |known: &[&str]| words.iter().any(|word| known.contains(&word.as_str()));
    if let Some((what, _)) = OTHERS.iter().find(|(_, known)| has(known)) {
        return Some(format!("the title speaks of {what}"));
    }
    if per(words, |word| TIMES.contains(&word)) {
        return Some("the title speaks of rates".to_owned());
    }
    if are_increments(words) {
        return Some("the title speaks of increments".to_owned());
    }
    if has(&BOTH) && has(&FLANKS) {
        return Some("the title speaks of both flanks together".to_owned());
    }
    if quantity == Quantity::MassLoss && per(words, |word| TEETH.contains(&word)) {
        return Some("the title speaks of single teeth".to_owned());
    }
    if quantity == Quantity::WearDepth && has(&THICKNESSES) {
        return Some("the title speaks of a thickness, which both flanks make".to_owned());
    }
    if quantity == Quantity::WearDepth && has(&TANGENTIAL) {
        return Some(
            "the title speaks of depths along the circumference, not along the flank's normal"
                .to_owned(),
        );
    }
    let share = quantity == Quantity::LoadShare;
    if let Some(unit) = units::bracketed(text).filter(|_| !share) {
        let plain = unit.replace(['\u{b5}', '\u{3bc}'], "u").to_lowercase();
        let is_rate = plain.contains('/') && !plain.starts_with(|c: char| c.is_ascii_digit());
        if is_rate || FOREIGN.contains(&plain.as_str()) {
            return Some(format!("values in {unit} are not read"));
        }
    }
    let unit = scaled_unit(text, quantity)?;
    Some(format!(
        "the title states a number with the unit ({unit}), and values in such steps are not read"
    ))
}

/// A number right before a unit of the values: `0.1 um`, `1/1000 mm`, `1E-3 mm`. Beside a unit alone in brackets it is a size: `Wear [um], module 4 mm`.
fn scaled_unit(text: &str, quantity: Quantity) -> Option<String> {
    let is_plain_unit = |part: &str| {
        let has_number = part.contains(|c: char| c.is_ascii_digit());
        !has_number && units::of_values(part, quantity).is_some()
    };
    let mut brackets = text.split(['[', '(']).skip(1);
    if brackets.any(|part| part.split([']', ')']).next().is_some_and(is_plain_unit)) {
        return None;
    }
    let parts = text.split(|c: char| c.is_whitespace() || "[](),;:".contains(c));
    let parts: Vec<&str> = parts.filter(|part| !part.is_empty()).collect();
    let is_number = |part: &str| {
        let part = part.replace(',', ".");
        let quotient = part.split_once('/');
        let is = |part: &str| part.parse::<f64>().is_ok();
        is(&part) || quotient.is_some_and(|(a, b)| is(a) && is(b))
    };
    let found = parts
        .windows(2)
        .find(|two| is_number(two[0]) && units::of_values(two[1], quantity).is_some())?;
    Some(found.join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_of_other_values_are_refused() {
        let depth = |text| refuse(text, 0, Quantity::WearDepth, &PerInterval::default());
        for (title, what) in [
            ("Depth [0.1 um]", "0.1 um"),
            ("Depth [10 \u{b5}m]", "10 "),
            ("Depth [1E-3 mm]", "1E-3 mm"),
            ("Wear depth in 1/1000 mm", "1/1000 mm"),
            ("Wear depth, module 4 mm", "4 mm"),
            ("Verschlei\u{df}rate [\u{b5}m/h]", "rates"),
            ("Wear [um/h]", "um/h"),
            ("Wear depth per million cycles [um]", "rates"),
            ("Wear depth [%]", "in %"),
            ("Normalised wear depth", "shares"),
            ("Wear depth [mil]", "in mil"),
            ("Wear depth [microinch]", "in microinch"),
            ("Zahndickenabnahme", "thickness"),
            ("Verschlei\u{df} in Umfangsrichtung [\u{b5}m]", "normal"),
            ("Tooth thickness loss [um], both flanks worn", "both flanks"),
            ("Verschlei\u{df} beider Flanken [\u{b5}m]", "both flanks"),
            ("wear since last inspection [um]", "increments"),
            ("Verschlei\u{df} je Intervall [\u{b5}m]", "increments"),
            ("Verschlei\u{df} im Abschnitt [\u{b5}m]", "increments"),
            ("Usure pendant le palier [\u{b5}m]", "increments"),
            ("wear in the interval [um]", "increments"),
        ] {
            let error = depth(title).unwrap_err().0;
            assert!(error.contains(what) && error.contains("row 1"), "{error}");
        }
        let mass = |text| refuse(text, 2, Quantity::MassLoss, &PerInterval::default());
        for title in [
            "Massenverlust je Intervall [mg]",
            "mass loss per tooth [mg]",
        ] {
            let error = mass(title).unwrap_err().0;
            assert!(
                error.starts_with("row 3") && !error.contains("flank"),
                "{error}"
            );
        }
    }

    #[test]
    fn titles_of_depths_are_not() {
        for title in [
            "Wear depth in mm",
            "Verschlei\u{df}tiefe [\u{b5}m], linke Flanke, Versuch 12",
            "Wear depth (pinion, left flank)",
            "Wear measured after each stop [um]",
            "Verschlei\u{df} im Abschnitt 3 [\u{b5}m]",
            "Wear in stage 2 [um]",
            "Wear test 12, 1500 rpm",
            "both flanks measured on 3 May",
            "Verschlei\u{df}messung, Umfang: 5 Versuche",
            "Wear depth at 140 Nm [um]",
            "mean of 3 teeth, wear in um",
            "Verschlei\u{df} [\u{b5}m], Modul 3,5 mm (b = 20 mm)",
        ] {
            assert_eq!(
                refuse(title, 0, Quantity::WearDepth, &PerInterval::default()),
                Ok(()),
                "{title}"
            );
        }
        let of = |text, quantity| refuse(text, 0, quantity, &PerInterval::default());
        assert_eq!(of("Load share [%]", Quantity::LoadShare), Ok(()));
        assert_eq!(of("mass loss [mg]", Quantity::MassLoss), Ok(()));
    }
}
