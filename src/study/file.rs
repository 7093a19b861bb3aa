//! From the disk to text, and from a syntax fault to a message.

use std::io;
use std::path::Path;

use super::diagnostic::{Diagnostic, Fault, Source, StudyError};

/// The file as text without a byte order mark.
pub(super) fn read(path: &Path) -> Result<Source, StudyError> {
    let name = path.display().to_string();
    let bytes = std::fs::read(path).map_err(|error| unreadable(path, &name, &error))?;
    let start = if bytes.starts_with(b"\xef\xbb\xbf") {
        3
    } else {
        0
    };
    match std::str::from_utf8(&bytes[start..]) {
        Ok(text) => Ok(Source {
            name,
            text: text.to_owned(),
        }),
        Err(error) => Err(not_utf8(name, &bytes[start..], error.valid_up_to())),
    }
}

const ANY_VALUE: &str = "a number, a text in quotes, true or false";

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
    };
    Box::new(diagnostic.with_span(span))
}

fn unreadable(path: &Path, name: &str, error: &io::Error) -> StudyError {
    let (found, hint) = match error.kind() {
        io::ErrorKind::NotFound => (
            "no such file",
            format!("study files here: {}", neighbours(path)),
        ),
        _ if path.is_dir() => (
            "a folder",
            format!("name the study file in it: {}", neighbours(&path.join("x"))),
        ),
        _ => ("a file that cannot be read", error.to_string()),
    };
    let diagnostic = Diagnostic::new(
        Fault::Unreadable,
        "",
        format!("cannot read the study file {name}"),
    )
    .with_values(found, "a readable text file in TOML")
    .with_hint(hint)
    .with_hint("`gearwear init` writes one to start from");
    StudyError::new(
        diagnostic,
        Source {
            name: name.to_owned(),
            text: String::new(),
        },
    )
}

/// The names of up to five `.toml` files beside `path`.
fn neighbours(path: &Path) -> String {
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
    let mut names: Vec<String> = names.filter(|name| name.ends_with(".toml")).collect();
    names.sort_unstable();
    names.truncate(5);
    if names.is_empty() {
        "none".to_owned()
    } else {
        names.join(", ")
    }
}

fn not_utf8(name: String, bytes: &[u8], at: usize) -> StudyError {
    let wide = bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff");
    let hint = if wide {
        "this looks like UTF-16: save the file as UTF-8"
    } else {
        "save the file as UTF-8"
    };
    // The readable part stands as it is, so that the place found in the bytes is also the place in the text.
    let mut text = String::from_utf8_lossy(&bytes[..at]).into_owned();
    text.push_str(&String::from_utf8_lossy(&bytes[at..]));
    let diagnostic = Diagnostic::new(Fault::NotUtf8, "", "the study file is not UTF-8 text")
        .with_values(format!("the byte 0x{:02X}", bytes[at]), "UTF-8 text")
        .with_hint(hint)
        .with_span(at..at + 1);
    StudyError::new(diagnostic, Source { name, text })
}
