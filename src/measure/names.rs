//! Names that people give to columns of tables and to what stands in them, in English, German, Italian, French and Spanish, and what
//! they are in a measurement file. [`folded`] says what does not count in a name; the words themselves stand in `vocabulary`, those for what
//! is measured in `measured`, those for counts, times and speeds in `counting`.

mod conditions;
mod counting;
mod measured;
mod uncertainties;
mod vocabulary;

use super::quantity::{Quantity, Subject};

pub(super) use conditions::{
    hours, hours_of_unit, is_module, is_number_of_teeth, is_time, newton_metres, speed, torque,
};
use counting::{AROUND_POWER, CYCLES, MULTIPLES, POWERS};
use measured::{
    CHORDS, DEVIATIONS, LOSSES, MASSES, PROFILE_DEVIATIONS, PROFILES, QUANTITIES, SPANS,
};
pub(super) use uncertainties::{is_confidence_interval, is_expanded_uncertainty, sigmas};
use vocabulary::{
    AFTER, BASE_PITCHES, BEFORE, COLUMNS, CUMULATIVE, FILLERS, FLANKS, FOR_PEOPLE, HINTS, MEANS,
    MEMBERS, REPEATS, STOPS, SUMMARIES, TOTAL_COUNTS, TOTALS,
};

/// Which of two measurements of a part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum When {
    /// Of the new part.
    Before,
    /// Of the worn part.
    After,
}

/// A name without what does not count in it: case, accents, blanks, signs between its letters.
pub(super) fn folded(text: &str) -> String {
    let mut plain = String::new();
    for c in text.chars().flat_map(char::to_lowercase) {
        match c {
            '\u{df}' => plain.push_str("ss"),
            'à' | 'á' | 'â' | 'ä' => plain.push('a'),
            'è' | 'é' | 'ê' | 'ë' => plain.push('e'),
            'ì' | 'í' | 'î' => plain.push('i'),
            'ò' | 'ó' | 'ô' | 'ö' => plain.push('o'),
            'ù' | 'ú' | 'û' | 'ü' => plain.push('u'),
            'ñ' => plain.push('n'),
            '⌀' => plain.push('ø'),
            c if c.is_alphanumeric() => plain.push(c),
            _ => {}
        }
    }
    plain
}

/// The words of a text, each [`folded`].
pub(super) fn words(text: &str) -> Vec<String> {
    let words = text.split(|c: char| !c.is_alphanumeric() && c != '⌀');
    words.map(folded).filter(|word| !word.is_empty()).collect()
}

/// The words of a name that say something in one: `number of cycles` is `cycles`.
fn telling(name: &str) -> Vec<String> {
    let mut words = words(name);
    if words.len() > 1 {
        words.retain(|word| !FILLERS.contains(&word.as_str()));
    }
    if words.len() > 1 {
        words.retain(|word| !CUMULATIVE.contains(&word.as_str()));
    }
    words
}

/// The same of a count, or of a running time: `total cycles` is `cycles`.
fn counted(name: &str) -> Vec<String> {
    let mut words = telling(name);
    if words.len() > 1 {
        words.retain(|word| !TOTAL_COUNTS.contains(&word.as_str()));
    }
    words
}

/// The column of a measurement file that a name means.
pub(super) fn column(name: &str) -> Option<&'static str> {
    named(&COLUMNS, &telling(name).concat())
}

/// The column that a name means or hints at, for messages.
pub(super) fn near_column(name: &str) -> Option<&'static str> {
    let value = || quantity(name).map(|_| "value");
    column(name)
        .or_else(value)
        .or_else(|| named(&HINTS, &folded(name)))
}

fn named(names: &[(&'static str, &[&str])], name: &str) -> Option<&'static str> {
    let found = (names.iter()).find(|(own, others)| *own == name || others.contains(&name));
    found.map(|(own, _)| *own)
}

/// Whether a column is named as one for people.
pub(super) fn is_for_people(name: &str) -> bool {
    FOR_PEOPLE.contains(&folded(name).as_str())
}

/// Whether the header of a column among others for checkpoints or places says that it holds no measurements: notes, or a mean or an extreme of the others.
pub(super) fn is_aside(name: &str) -> bool {
    let name = name.split(['[', '(']).next().unwrap_or_default();
    is_for_people(name) || SUMMARIES.contains(&folded(name).as_str())
}

/// Whether a header says that its places are fractions of a base pitch: `Position [base pitches]`.
pub(super) fn is_in_base_pitches(header: &str) -> bool {
    let words = words(header).concat();
    BASE_PITCHES.iter().any(|known| words.contains(known))
}

/// Whether a word means the mean of several values.
pub(super) fn is_mean(word: &str) -> bool {
    MEANS.contains(&folded(word).as_str())
}

/// Whether a word says that a row sums others up.
pub(super) fn is_total(word: &str) -> bool {
    let word = folded(word);
    TOTALS.iter().chain(&SUMMARIES).any(|known| *known == word)
}

/// Whether a header is that of a mean, an extreme or the like of other columns; a standard deviation may be stated of each value.
pub(super) fn is_statistic(name: &str) -> bool {
    let name = name.split(['[', '(']).next().unwrap_or_default();
    SUMMARIES.contains(&folded(name).as_str()) && column(name) != Some("sigma")
}

/// The member that a word means.
pub(super) fn member(word: &str) -> Option<Subject> {
    let word = folded(word);
    let found = (MEMBERS.iter()).find(|(_, words)| words.contains(&word.as_str()));
    found.map(|(member, _)| *member)
}

/// The member that a number means where members are numbered.
pub(super) fn numbered_member(text: &str) -> Option<Subject> {
    match text {
        "1" => Some(Subject::Pinion),
        "2" => Some(Subject::Gear),
        _ => None,
    }
}

/// The one member that words of a text name; none if they name none or several.
pub(super) fn one_member(text: &str) -> Option<Subject> {
    let mut named = words(text).into_iter().filter_map(|word| member(&word));
    let first = named.next()?;
    named.all(|other| other == first).then_some(first)
}

/// Whose revolutions a name counts, `None` inside if it does not say; none if it counts no revolutions.
pub(super) fn revolutions(name: &str) -> Option<Option<Subject>> {
    let (of, counts): (Vec<String>, Vec<String>) = (counted(name).into_iter())
        .flat_map(member_apart)
        .partition(|word| member(word).is_some());
    let count = counts.concat();
    (count == "cycles" || CYCLES.contains(&count.as_str())).then(|| one_member(&of.join(" ")))
}

/// Whether a name is `N`, `N_pinion` or `n pinion`: a count of its revolutions. A small `n` alone may number the rows, and `N. ruota` the gears.
pub(super) fn is_one_letter_count(name: &str) -> bool {
    let words = words(name);
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        ["n"] => name.trim() == "N",
        ["n", of] | [of, "n"] => member(of) == Some(Subject::Pinion),
        _ => false,
    }
}

/// Whether a text speaks of revolutions of the gear.
pub(super) fn counts_gear_revolutions(text: &str) -> bool {
    // `U` are revolutions behind a number alone
    let has_number = text.contains(|c: char| c.is_ascii_digit());
    let counts = |word: &String| {
        let is_short = word == "u" && has_number;
        is_short || word == "cycles" || CYCLES.contains(&word.as_str())
    };
    let words: Vec<String> = words(text).into_iter().flat_map(member_apart).collect();
    words.iter().any(counts) && one_member(&words.join(" ")) == Some(Subject::Gear)
}

/// A word, or the member and the count that it is made of: `radumdrehungen`.
fn member_apart(word: String) -> Vec<String> {
    let of = |count: &&str| word.strip_suffix(*count).filter(|of| member(of).is_some());
    let found = CYCLES.iter().find_map(|count| Some((of(count)?, *count)));
    match found {
        Some((of, count)) => vec![of.to_owned(), count.to_owned()],
        None => vec![word],
    }
}

/// Whether a name means the flank of a tooth.
pub(super) fn is_flank(name: &str) -> bool {
    FLANKS.contains(&telling(name).concat().as_str())
}

/// Whether a word stands for a multiple of a count, such as `Mio`.
pub(super) fn is_multiple(word: &str) -> bool {
    MULTIPLES.contains(&folded(word).as_str())
}

/// Whether a text says that what it counts is to be multiplied by a power of ten: `cycles x 1e6`, `Lastspiele [10^6]`.
pub(super) fn is_times_a_power(text: &str) -> bool {
    let text: String = text.to_lowercase().split_whitespace().collect();
    let says = |power: &str| {
        AROUND_POWER.iter().any(|(before, behind)| {
            let word = format!("{before}{power}{behind}");
            let ends =
                |at: usize| !text[at + word.len()..].starts_with(|c: char| c.is_ascii_digit());
            text.match_indices(&word).any(|(at, _)| ends(at))
        })
    };
    POWERS.iter().any(|power| says(power))
}

/// Whether a word says nothing in a name.
pub(super) fn is_filler(word: &str) -> bool {
    FILLERS.contains(&folded(word).as_str())
}

/// Whether a name means a mass, and says nothing of a loss.
pub(super) fn is_mass(name: &str) -> bool {
    MASSES.contains(&telling(name).concat().as_str())
}

/// Whether a name means the deviation from the new profile.
pub(super) fn is_deviation(name: &str) -> bool {
    DEVIATIONS.contains(&telling(name).concat().as_str())
}

/// Whether a text has a word for the deviation of the profile, near one for the profile or with nothing but a unit, and none for what was worn before it.
pub(super) fn speaks_of_deviation(text: &str) -> bool {
    let words = words(text);
    let is_worn =
        |word: &String| quantity(word).is_some_and(|(named, _)| named == Quantity::WearDepth);
    let says_nothing = |word: &String| {
        is_filler(word)
            || member(word).is_some()
            || ["um", "\u{b5}m", "\u{3bc}m", "mm"].contains(&word.as_str())
    };
    let deviates = words.iter().enumerate().position(|(at, word)| {
        let before = at
            .checked_sub(1)
            .map_or("", |before| words[before].as_str());
        let behind = words.get(at + 1).map_or("", String::as_str);
        // a standard deviation is none: `écart type`, `desviación estándar`
        let is_standard = ["standard", "std", "mean"].contains(&before)
            || ["type", "estandar", "standard"].contains(&behind);
        // `scostamento del profilo`, `deviation of the profile`
        let around = &words[at.saturating_sub(2)..words.len().min(at + 4)];
        let of_profile = around.iter().any(|near| PROFILES.contains(&near.as_str()));
        let is_alone = || {
            let mut others = words.iter().filter(|other| *other != word);
            others.all(says_nothing)
        };
        let is_compound = PROFILE_DEVIATIONS.contains(&word.as_str());
        is_compound
            || DEVIATIONS.contains(&word.as_str()) && !is_standard && (of_profile || is_alone())
    });
    // `Profilabweichung nach Verschleiß` is a deviation, `Verschleiß (Abweichung vom Neuprofil)` is what was worn
    let worn = words.iter().position(is_worn);
    deviates.is_some_and(|deviates| worn.is_none_or(|worn| deviates < worn))
}

/// Which weighing of a part a name means.
pub(super) fn weighed(name: &str) -> Option<When> {
    // a loss is no weighing
    named_when(name, &MASSES)
}

/// Of which of two measurements a name means the deviation from the new profile.
pub(super) fn profiled(name: &str) -> Option<When> {
    named_when(name, &DEVIATIONS)
}

/// Of which of two measurements a name means the span over several teeth.
pub(super) fn spanned(name: &str) -> Option<When> {
    named_when(name, &SPANS)
}

/// Of which of two measurements a name means the chord of a tooth.
pub(super) fn chord(name: &str) -> Option<When> {
    named_when(name, &CHORDS)
}

/// Which of two measurements a name means that says nothing else: `before`.
pub(super) fn time_alone(name: &str) -> Option<When> {
    named_when(name, &[""])
}

/// Whether a name may mean the number of a repeated measurement; other numbers stand under such names too.
pub(super) fn may_number_repeats(name: &str) -> bool {
    REPEATS.contains(&telling(name).concat().as_str())
}

/// Whether a name means the stops of a test.
pub(super) fn is_stop(name: &str) -> bool {
    STOPS.contains(&telling(name).concat().as_str())
}

/// When what a name means was measured, if it is one of `known`.
fn named_when(name: &str, known: &[&str]) -> Option<When> {
    let words = words(name);
    let any = |known: &[&str]| words.iter().any(|word| known.contains(&word.as_str()));
    let when = match (any(&BEFORE), any(&AFTER)) {
        (true, false) => When::Before,
        (false, true) => When::After,
        _ => return None,
    };
    let is_time = |word: &str| BEFORE.contains(&word) || AFTER.contains(&word);
    let rest: Vec<&str> = words
        .iter()
        .map(String::as_str)
        .filter(|word| !is_time(word))
        .collect();
    let rest = telling(&rest.join(" ")).concat();
    known.contains(&rest.as_str()).then_some(when)
}

/// The quantity that a name means, and whether its unit may say otherwise.
pub(super) fn quantity(name: &str) -> Option<(Quantity, bool)> {
    let name = telling(name).concat();
    let own = (Quantity::ALL.into_iter()).find(|quantity| folded(quantity.name()) == name);
    let other = || {
        let found = (QUANTITIES.iter()).find(|(_, names)| names.contains(&name.as_str()));
        found.map(|(quantity, _)| *quantity)
    };
    let quantity = own.or_else(other)?;
    Some((quantity, LOSSES.contains(&name.as_str())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deviations_are_told_from_depths_and_from_standard_ones() {
        for text in [
            "Profilabweichung Ritzel, Versuch A",
            "profile deviation [um]",
            "Abweichung [\u{b5}m]",
            "Flankenabweichung links",
            "scostamento del profilo",
            "deviation of the flank, pinion",
            "Profilabweichung nach Verschlei\u{df} [\u{b5}m], Ritzel",
            "Profile deviation of the pinion after wear [um]",
            "Deviazione del profilo dopo usura",
        ] {
            assert!(speaks_of_deviation(text), "{text}");
        }
        for text in [
            "standard deviation",
            "\u{e9}cart type",
            "Verschlei\u{df} (Abweichung vom Neuprofil)",
            "radius",
            "Torque deviation below 2 percent",
            "Abweichung der Temperatur",
        ] {
            assert!(!speaks_of_deviation(text), "{text}");
        }
    }

    #[test]
    fn names_of_five_languages_are_known() {
        for (names, means) in [
            (
                &[
                    "Test ID",
                    "Run",
                    "Prova n.",
                    "Versuch Nr.",
                    "essai",
                    "Ensayo",
                ][..],
                "test",
            ),
            (&["Gear wheel", "RUOTA", "Rad", "roue", "rueda"], "member"),
            (
                &[
                    "Revs",
                    "number of cycles",
                    "cicli",
                    "Umdrehungen",
                    "nombre de tours",
                ],
                "cycles",
            ),
            (
                &[
                    "r",
                    "Roll length",
                    "Raggio",
                    "rayon",
                    "roll_angle",
                    "Ø",
                    "⌀",
                    "Messkreis-Ø",
                ],
                "position",
            ),
            (
                &["u", "std dev", "SIGMA", "écart-type", "Unsicherheit"],
                "sigma",
            ),
            (&["profile_id", "curve", "traccia"], "trace"),
        ] {
            for name in names {
                assert_eq!(column(name), Some(means), "{name}");
            }
        }
        for name in [
            "Lastwechsel kumuliert",
            "Lastwechsel gesamt",
            "total cycles",
            "Ciclos acumulados",
            "cycles cumul\u{e9}s",
        ] {
            assert_eq!(revolutions(name), Some(None), "{name}");
        }
        assert_eq!(revolutions("total"), None);
        let total = quantity("Massenverlust kumuliert").map(|q| q.0);
        assert_eq!(total, Some(Quantity::MassLoss));
        assert_eq!(quantity("total mass"), None);
        assert_eq!(column("time"), None);
        assert_eq!(near_column("time"), Some("cycles"));
        assert_eq!(near_column("depth"), Some("value"));
        for (name, means) in [
            ("Verschleißtiefe", Quantity::WearDepth),
            ("wear depth", Quantity::WearDepth),
            ("perdita di massa", Quantity::MassLoss),
            ("mass_loss", Quantity::MassLoss),
        ] {
            assert_eq!(quantity(name).map(|q| q.0), Some(means), "{name}");
        }
        for (word, means) in [
            ("Piñon", Subject::Pinion),
            ("big", Subject::Gear),
            ("corona", Subject::Gear),
        ] {
            assert_eq!(member(word), Some(means), "{word}");
        }
    }

    #[test]
    fn torques_say_on_whom_they_act() {
        for (name, unit, on) in [
            ("Drehmoment", Some("Nm"), Some(None)),
            ("torque", Some("N m"), Some(None)),
            ("Moment", Some("N\u{b7}mm"), Some(None)),
            ("coppia", Some("Nm"), Some(None)),
            ("gear torque", Some("Nm"), Some(Some(Subject::Gear))),
            ("Drehmoment am Ritzel", Some("Nm"), None),
            ("Drehmoment Ritzel", Some("Nm"), Some(Some(Subject::Pinion))),
            ("torque", None, None),
            ("Reibmoment", Some("Nm"), None),
            ("coppia", None, None),
            ("depth", Some("nm"), None),
        ] {
            assert_eq!(torque(name, unit), on, "{name}");
        }
    }

    #[test]
    fn revolutions_say_whose_they_are() {
        for (name, whose) in [
            ("revolutions of the pinion", Some(Some(Subject::Pinion))),
            ("gear revs", Some(Some(Subject::Gear))),
            ("Umdrehungen Rad", Some(Some(Subject::Gear))),
            ("Radumdrehungen", Some(Some(Subject::Gear))),
            ("Ritzelumdrehungen", Some(Some(Subject::Pinion))),
            ("load cycles", Some(None)),
            ("wear of the gear", None),
            ("Rad", None),
        ] {
            assert_eq!(revolutions(name), whose, "{name}");
        }
        assert!(counts_gear_revolutions("111000 gear rev"));
        assert!(counts_gear_revolutions("23415 Radumdrehungen"));
        assert!(counts_gear_revolutions("111000 Umdr. Rad"));
        assert!(counts_gear_revolutions("111000 U Rad"));
        assert!(!counts_gear_revolutions("111000 rev"));
        assert!(!counts_gear_revolutions("U Rad"));
    }
}
