//! Why an effect cannot be used as stated.

/// A name or value that the catalogue does not know or allow.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum EffectError {
    /// No effect of this name.
    #[error("there is no effect `{name}`; the nearest is `{nearest}`")]
    UnknownEffect {
        /// The name.
        name: String,
        /// The catalogue's nearest.
        nearest: String,
    },
    /// No parameter of this name.
    #[error("{effect} has no parameter `{parameter}`; the nearest is `{nearest}`")]
    UnknownParameter {
        /// The effect.
        effect: String,
        /// The name.
        parameter: String,
        /// Its nearest parameter.
        nearest: String,
    },
    /// A value outside the range.
    #[error("{effect}.{parameter} = {value}{} is outside {least} to {most}", spaced(.unit))]
    OutOfRange {
        /// The effect.
        effect: String,
        /// The parameter.
        parameter: &'static str,
        /// Its unit.
        unit: &'static str,
        /// The value.
        value: f64,
        /// Smallest allowed.
        least: f64,
        /// Largest allowed.
        most: f64,
    },
}

/// The candidate most like `word`; the first one of equals.
pub(super) fn nearest<'a>(
    word: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    let mut best: Option<(f64, &str)> = None;
    for candidate in candidates {
        let likeness = strsim::jaro_winkler(word, candidate);
        if best.is_none_or(|(most, _)| likeness > most) {
            best = Some((likeness, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// A unit after its number; nothing for a pure one.
fn spaced(unit: &str) -> String {
    match unit {
        "-" => String::new(),
        unit => format!(" {unit}"),
    }
}
