//! Units of tables: what headers say, and factors to the units of a measurement file.

use super::ImportError;
use crate::measure::{Quantity, names};

/// Units of a quantity's values with their factors to its own, the first one.
fn units(quantity: Quantity) -> &'static [(&'static str, f64)] {
    match quantity {
        Quantity::WearDepth | Quantity::SpanLoss | Quantity::ChordalLoss => {
            &[("um", 1.0), ("mm", 1e3), ("nm", 1e-3), ("in", 25.4e3)]
        }
        Quantity::TransmissionError | Quantity::MeanLag => {
            &[("urad", 1.0), ("mrad", 1e3), ("arcsec", 4.848_136_811)]
        }
        Quantity::ContactPressure => &[("MPa", 1.0), ("GPa", 1e3), ("N/mm2", 1.0)],
        Quantity::LoadShare => &[("1", 1.0), ("%", 0.01)],
        Quantity::MeshStiffness => &[("N/(mm um)", 1.0), ("N/mm/um", 1.0)],
        Quantity::MassLoss => &[("mg", 1.0), ("g", 1e3), ("ug", 1e-3), ("kg", 1e6)],
    }
}

/// Words for inches.
const INCHES: [&str; 3] = ["inch", "inches", "zoll"];

/// Units of positions with their factors to mm and degrees.
const LENGTHS: [(&str, f64); 5] = [
    ("mm", 1.0),
    ("um", 1e-3),
    ("cm", 10.0),
    ("m", 1e3),
    ("in", 25.4),
];
const ANGLES: [(&str, f64); 4] = [
    ("deg", 1.0),
    ("\u{b0}", 1.0),
    ("rad", 180.0 / std::f64::consts::PI),
    ("mrad", 0.18 / std::f64::consts::PI),
];

/// The factor from `unit` to the quantity's own.
///
/// # Errors
/// [`ImportError`] for a unit that the quantity does not have.
pub fn factor(unit: &str, quantity: Quantity) -> Result<f64, ImportError> {
    let known = units(quantity);
    find(known, unit).ok_or_else(|| {
        let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
        ImportError(format!(
            "unit {unit}: units of {} are {}",
            quantity.name(),
            names.join(", ")
        ))
    })
}

/// The factor of a position's unit that `header` states to mm, or to degrees of an `angle`; 1 if it states none.
pub(super) fn of_position(header: &str, angle: bool) -> Result<f64, ImportError> {
    let known: &[(&str, f64)] = if angle { &ANGLES } else { &LENGTHS };
    let Some(unit) = name_and_unit(header).1 else {
        return Ok(1.0);
    };
    find(known, &unit).ok_or_else(|| {
        let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
        let hint = match names::is_in_base_pitches(header) {
            true => "; what was measured over a rotation is told by --quantity (transmission_error, load_share, ...) or a title",
            false => "",
        };
        ImportError(format!(
            "`{header}`: positions in {unit} are not read; their unit is one of {}{hint}",
            names.join(", ")
        ))
    })
}

/// The unit of the values that a header beside them states: in brackets, or as a word of its own.
pub(super) fn of_values(header: &str, quantity: Quantity) -> Option<&'static str> {
    let known = units(quantity).iter().filter(|(name, _)| *name != "1");
    // `in` is a word of English too
    let words = header.split(|c: char| c.is_whitespace() || "[](),;:".contains(c));
    let words = words.filter(|word| *word != "in").map(plain);
    let stated = bracketed(header).map(plain).into_iter().chain(words);
    // nor is a torque a length
    let mut stated = stated.filter(|word| word != "Nm");
    stated.find_map(|word| {
        known
            .clone()
            .find(|(name, _)| name.eq_ignore_ascii_case(&word))
            .map(|(name, _)| *name)
    })
}

/// Units that may stand behind a name without brackets: `r_mm`, `depth um`. Left out are those that are words too (`in`, `rad`, `m`).
const BARE: [&str; 15] = [
    "mm", "um", "nm", "cm", "mg", "g", "ug", "kg", "deg", "mrad", "urad", "arcsec", "mpa", "gpa",
    "n/mm/um",
];

/// The name of a column, and the unit that its header states in brackets or behind an underscore or a blank.
pub(super) fn name_and_unit(header: &str) -> (String, Option<String>) {
    let mut name = String::new();
    let mut depth = 0;
    for c in header.chars() {
        match c {
            '[' | '(' => depth += 1,
            ']' | ')' => depth -= 1,
            c if depth == 0 => name.push(c),
            _ => {}
        }
        if depth == 0 && [']', ')'].contains(&c) {
            name.push(' ');
        }
    }
    let name = name.trim().to_owned();
    if let Some(unit) = bracketed(header) {
        return (name, Some(plain(unit)));
    }
    let Some((before, last)) =
        name.rsplit_once(|c: char| c.is_whitespace() || c == '_' || c == ',')
    else {
        return (name, None);
    };
    let unit = plain(last);
    if !BARE.contains(&unit.to_lowercase().as_str()) {
        return (name, None);
    }
    // `depth in mm`
    let before = before.trim_end_matches([' ', ',', '_']);
    let words = before.rsplit_once(' ');
    let before = words
        .filter(|(_, word)| ["in", "en"].contains(word))
        .map_or(before, |w| w.0);
    (before.to_owned(), Some(unit))
}

fn find(known: &[(&str, f64)], unit: &str) -> Option<f64> {
    let unit = plain(unit);
    let found = (known.iter()).find(|(name, _)| name.eq_ignore_ascii_case(&unit));
    found.map(|(_, factor)| *factor)
}

/// Whether a text is a unit of some quantity or place.
pub(super) fn is_unit(text: &str) -> bool {
    let of_values = Quantity::ALL.into_iter().flat_map(units);
    let mut known = of_values.chain(&LENGTHS).chain(&ANGLES);
    let text = plain(text);
    text != "1" && known.any(|(name, _)| name.eq_ignore_ascii_case(&text))
}

/// Whether both are the same unit.
pub(super) fn are_same(one: &str, other: &str) -> bool {
    plain(one).eq_ignore_ascii_case(&plain(other))
}

/// With the letter u for micro, and `in` for inches however they are written.
fn plain(unit: &str) -> String {
    let unit = unit.trim();
    if INCHES.contains(&unit.to_lowercase().as_str()) {
        return "in".to_owned();
    }
    unit.replace(['\u{b5}', '\u{3bc}'], "u")
        .replace("mm\u{b2}", "mm2")
}

/// What stands in the last brackets.
pub(super) fn bracketed(header: &str) -> Option<&str> {
    let open = header.rfind(['[', '('])?;
    let rest = &header[open + 1..];
    let unit = &rest[..rest.find([']', ')'])?];
    Some(unit.trim()).filter(|unit| !unit.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_tell_units() {
        let depth = |header| of_values(header, Quantity::WearDepth);
        assert_eq!(depth("Verschlei\u{df} [mm] nach 250000"), Some("mm"));
        assert_eq!(depth("250000 (\u{b5}m)"), Some("um"));
        assert_eq!(depth("250000 in total"), None);
        assert_eq!(depth("250000 [in]"), Some("in"));
        assert_eq!(depth("Verschlei\u{df} in Zoll"), Some("in"));
        assert_eq!(depth("250000 cycles"), None);
        assert_eq!(of_values("1e5 [%]", Quantity::LoadShare), Some("%"));
        assert_eq!(of_values("1", Quantity::LoadShare), None);
        assert_eq!(of_position("radius [in]", false), Ok(25.4));
        assert_eq!(of_position("radius", false), Ok(1.0));
        assert!(of_position("radius [furlong]", false).is_err());
        assert_eq!(of_position("RADIUS [MM]", false), Ok(1.0));
        let parts = |header| {
            let (name, unit) = name_and_unit(header);
            format!("{name}|{}", unit.unwrap_or_default())
        };
        assert_eq!(parts("sd_um"), "sd|um");
        assert_eq!(parts("u (k=1) [mg]"), "u|mg");
        assert_eq!(parts("wear depth in \u{b5}m"), "wear depth|um");
        assert_eq!(parts("Umdrehungen Rad"), "Umdrehungen Rad|");
        let degrees = of_position("roll angle (rad)", true).unwrap();
        assert!((degrees - 57.295_779_513).abs() < 1e-8);
    }
}
