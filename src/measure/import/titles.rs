//! Rows above a table's header: what they say of its values.

use super::{ImportError, PerInterval, Sheet, other_values, units};
use crate::measure::{Quantity, names};

/// What the rows above a header say.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Titles {
    /// Unit of the values.
    pub unit: Option<String>,
    /// Whether lost material is negative in the table.
    pub lost_is_negative: Option<bool>,
    /// Rows that say nothing that is used, with their numbers counted from 1.
    pub passed_over: Vec<(usize, String)>,
}

const NEGATIVE: [&str; 9] = [
    "negative", "negativ", "negativo", "negativa", "negativi", "negatif", "negatifs", "minus",
    "meno",
];
const POSITIVE: [&str; 7] = [
    "positive", "positiv", "positivo", "positiva", "positivi", "positif", "plus",
];
const LOST: [&str; 18] = [
    "lost",
    "loss",
    "removed",
    "worn",
    "wear",
    "abtrag",
    "verlust",
    "materialverlust",
    "abgetragen",
    "verschleiss",
    "asportato",
    "perso",
    "usura",
    "perdita",
    "perdu",
    "enleve",
    "usure",
    "perdido",
];
/// Words for what is not there: values too, so they speak of wear beside a word for the material only.
const MISSING: [&str; 8] = [
    "missing",
    "fehlt",
    "fehlend",
    "fehlendes",
    "mancante",
    "manque",
    "manquant",
    "falta",
];
const MATERIAL: [&str; 6] = [
    "material",
    "materiale",
    "matiere",
    "metal",
    "metall",
    "werkstoff",
];
/// Words between these two at most, `manque de matière`, and one more.
const BESIDE: usize = 2;
/// Words that say that nothing but the unit of the values follows: `Unit: mm`, `All values in mm`.
const UNIT: [&str; 10] = [
    "unit",
    "units",
    "einheit",
    "einheiten",
    "unita",
    "unite",
    "unites",
    "unidad",
    "values",
    "werte",
];
/// Most words of a quantity's name.
const NAME: usize = 3;
const NOT: [&str; 6] = ["not", "no", "nicht", "kein", "non", "pas"];

impl Titles {
    /// What is said of the rows, counted from 0, that state what the study does; they are then not passed over.
    pub(super) fn agreeing(&mut self, compared: &[usize]) -> Vec<String> {
        let own = |(row, _): &mut (usize, String)| compared.contains(&(*row - 1));
        let agreeing = self.passed_over.extract_if(.., own);
        agreeing
            .map(|(row, words)| format!("row {row}, `{words}`: as in the study"))
            .collect()
    }

    /// Of the rows above `head`.
    pub(super) fn of(
        sheet: &Sheet,
        head: usize,
        quantity: Quantity,
        per_interval: &PerInterval,
    ) -> Result<Self, ImportError> {
        let mut titles = Self::default();
        for (row, cells) in sheet.rows.iter().enumerate().take(head) {
            let cells: Vec<&str> = cells
                .iter()
                .map(String::as_str)
                .filter(|c| !c.is_empty())
                .collect();
            let text = cells.join(" ");
            if text.is_empty() {
                continue;
            }
            other_values::refuse(&text, row, quantity, per_interval)?;
            let (unit, sign) = (unit(&text, quantity), lost_is_negative(&text));
            if unit.is_none() && sign.is_none() {
                titles.passed_over.push((row + 1, text.clone()));
            }
            if unit.is_some() && titles.unit.is_some() && titles.unit != unit
                || sign.is_some()
                    && titles.lost_is_negative.is_some()
                    && titles.lost_is_negative != sign
            {
                return Err(ImportError(format!(
                    "row {}: `{text}` says otherwise than a row above it; take the wrong one out",
                    row + 1
                )));
            }
            titles.unit = unit.or(titles.unit);
            titles.lost_is_negative = sign.or(titles.lost_is_negative);
        }
        Ok(titles)
    }

    /// Whether the words of a row say something of values, or that they are not what would be read: a title that names its test may do so too.
    pub(super) fn speak_of_values(row: &[String]) -> bool {
        let cells = row.iter().map(String::as_str);
        let cells: Vec<&str> = cells.filter(|cell| !cell.is_empty()).collect();
        let text = cells.join(" ");
        let of = |quantity: Quantity| {
            unit(&text, quantity).is_some()
                || other_values::refuse(&text, 0, quantity, &PerInterval::default()).is_err()
        };
        lost_is_negative(&text).is_some() || Quantity::ALL.into_iter().any(of)
    }

    /// Without the rows that are used otherwise among those passed over; `is_used` is asked with the words of each.
    pub(super) fn without(mut self, is_used: impl Fn(&str) -> bool) -> Self {
        self.passed_over.retain(|(_, words)| !is_used(words));
        self
    }

    /// Whether the sign is to be turned.
    ///
    /// # Errors
    /// Where the user states that lost material is negative, and a title that it is positive.
    pub(super) fn turns_sign(&self, stated: bool) -> Result<bool, ImportError> {
        match (stated, self.lost_is_negative) {
            (true, Some(false)) => Err(ImportError(
                "a title row says that lost material is positive, --turn-sign that it is negative: leave out one of them".to_owned(),
            )),
            (stated, said) => Ok(stated || said == Some(true)),
        }
    }
}

/// The unit of the values that a title states beside their name; none if it speaks of positions too, or of several units.
fn unit(text: &str, quantity: Quantity) -> Option<String> {
    let words = names::words(text);
    let of_values = |name: &str| names::quantity(name).is_some_and(|(named, _)| named == quantity);
    // `transmission error`, `errore di trasmissione`
    let is_named = (1..=NAME).any(|n| words.windows(n).any(|words| of_values(&words.join(" "))));
    let of_places = |word: &String| {
        names::column(word) == Some("position")
            || ["roll", "angle", "length"].contains(&word.as_str())
    };
    let is_unit = |word: &String| UNIT.contains(&word.as_str());
    let is_deviation = quantity == Quantity::WearDepth && names::speaks_of_deviation(text);
    let names_values = is_named || words.iter().any(is_unit) || is_deviation;
    if !names_values || words.iter().any(of_places) {
        return None;
    }
    let stated = text.split(|c: char| c.is_whitespace() || "[](),;:".contains(c));
    // in brackets `in` is no word of English
    let in_brackets = units::bracketed(text).map(|unit| format!("[{unit}]"));
    let mut stated: Vec<&str> = (in_brackets.iter().map(String::as_str).chain(stated))
        .filter_map(|word| units::of_values(word, quantity))
        .collect();
    stated.dedup();
    match stated[..] {
        [one] => Some(one.to_owned()),
        _ => None,
    }
}

/// What a title says of the sign of lost material.
fn lost_is_negative(text: &str) -> Option<bool> {
    let said = text.split([',', ';', '.', '(', ')']).filter_map(|part| {
        let words = names::words(part);
        let says = |known: &[&str]| words.iter().any(|word| known.contains(&word.as_str()));
        let negative = says(&NEGATIVE);
        let places = |known: &[&str]| -> Vec<usize> {
            let found = words.iter().enumerate();
            let found = found.filter(|(_, word)| known.contains(&word.as_str()));
            found.map(|(at, _)| at).collect()
        };
        let material = places(&MATERIAL);
        let is_missing = (places(&MISSING).iter())
            .any(|at| material.iter().any(|of| at.abs_diff(*of) <= BESIDE));
        ((says(&LOST) || is_missing) && !says(&NOT) && negative != says(&POSITIVE))
            .then_some(negative)
    });
    let said: Vec<bool> = said.collect();
    let first = *said.first()?;
    said.iter().all(|&other| other == first).then_some(first)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_say_unit_and_sign() {
        let unit = |text| unit(text, Quantity::WearDepth);
        assert_eq!(unit("Wear depth in mm").as_deref(), Some("mm"));
        assert_eq!(
            unit("Verschleiß [\u{b5}m], Versuch A").as_deref(),
            Some("um")
        );
        assert_eq!(unit("Wear in um, roll length in mm"), None);
        assert_eq!(unit("Wear depth (in)").as_deref(), Some("in"));
        assert_eq!(unit("Wear depth in inches, pinion").as_deref(), Some("in"));
        assert_eq!(unit("Wear in test A"), None);
        assert_eq!(unit("Unit: mm").as_deref(), Some("mm"));
        assert_eq!(unit("Alle Werte in mm").as_deref(), Some("mm"));
        assert_eq!(unit("Units: mm, \u{b5}m"), None);
        assert_eq!(unit("Unit of mass: mg"), None);
        assert_eq!(unit("scale 50 mm"), None);
        let of_rotation = |text| super::unit(text, Quantity::TransmissionError);
        for title in [
            "Transmission error [mrad]",
            "Errore di trasmissione in mrad",
        ] {
            assert_eq!(of_rotation(title).as_deref(), Some("mrad"), "{title}");
        }
        for (text, says) in [
            ("Wear depth, negative = material lost", Some(true)),
            ("positive = material lost", Some(false)),
            ("il materiale asportato è negativo", Some(true)),
            ("negative: pile-up, positive: wear", Some(false)),
            ("lost material is not negative", None),
            ("negative = wear, positive = wear", None),
            ("Wear of Monday", None),
            ("Missing values are negative", None),
            ("fehlende Werte: falta = negativo", None),
            ("negativ = Material fehlt", Some(true)),
            ("manque de matière : positif", Some(false)),
        ] {
            assert_eq!(lost_is_negative(text), says, "{text}");
        }
    }
}
