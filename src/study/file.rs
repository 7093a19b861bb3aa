//! What the messages about a study file as a whole say: what it is, and what the TOML reader found.

use crate::source_text::{Diagnostic, Fault, Source, Wanted};

/// The study file.
pub(super) const WANTED: Wanted = Wanted {
    what: "study file",
    ending: "toml",
    format: "TOML",
    header: &[],
    hint: "`gearwear init` writes one to start from",
};

const ANY_VALUE: &str = "a number, a text in quotes, true or false";

/// Whether a comma between two digits stands at a place of the text.
fn has_decimal_comma(text: &str, at: usize) -> bool {
    let (before, after) = text.split_at_checked(at).unwrap_or((text, ""));
    let after = after.strip_prefix(',');
    before.ends_with(|c: char| c.is_ascii_digit())
        && after.is_some_and(|after| after.starts_with(|c: char| c.is_ascii_digit()))
}

/// What the TOML reader found, with the name of a key that stands twice.
pub(super) fn syntax(source: &Source, error: &toml::de::Error) -> Box<Diagnostic> {
    let span = error.span().unwrap_or(0..0);
    let visible = source.visible(span.clone());
    let written = source.text[visible]
        .lines()
        .next()
        .unwrap_or_default()
        .to_owned();
    let at_end = span.start >= source.text.trim_end().len();
    let found = if at_end || written.is_empty() {
        "the end of the line or file".to_owned()
    } else {
        format!("`{written}`")
    };
    let (what, expected) = match error.message().split_once(", expected ") {
        // The reader guesses a type from the first letter; what may stand there is any value.
        Some(("string values must be quoted" | "invalid boolean", _)) => {
            ("this is no value", ANY_VALUE)
        }
        Some(parts) => parts,
        None => (error.message(), "valid TOML"),
    };
    let line = source.text[..source.visible(span.clone()).start]
        .lines()
        .last()
        .unwrap_or_default();
    let key = line.split_once('=').map_or("", |(key, _)| key.trim());
    let what = if key.is_empty() {
        what.to_owned()
    } else {
        format!("{what}, at the key `{key}`")
    };
    let diagnostic = if error.message() == "duplicate key" {
        Diagnostic::new(
            Fault::Syntax,
            written.as_str(),
            format!("the key `{written}` stands twice in one table"),
        )
        .with_values(found, "each key once in a table")
        .with_hint("remove one of them; several tests are several [[test]] tables")
    } else {
        Diagnostic::new(Fault::Syntax, key, format!("not valid TOML: {what}"))
            .with_values(found, expected)
            .with_hint(if has_decimal_comma(&source.text, span.start) {
                "decimals take a point here: 4.0; commas separate the values of a list"
            } else {
                ""
            })
    };
    Box::new(diagnostic.with_span(span))
}
