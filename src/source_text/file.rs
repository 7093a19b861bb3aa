//! From the disk to text.

use std::io::{self, Read as _};
use std::path::Path;

use super::{Diagnostic, Fault, Source, TextError};

/// What a file is to its reader; stands in messages about one that cannot be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Wanted {
    /// What it is called: `study file`.
    pub what: &'static str,
    /// Ending of such files' names, without the dot.
    pub ending: &'static str,
    /// Name of the format.
    pub format: &'static str,
    /// Words of its first line that is no comment, by which one is told from other files with that ending.
    pub header: &'static [&'static str],
    /// How to get one.
    pub hint: &'static str,
}

/// Bytes of a file within which its header ends, behind comments.
const LONGEST_START: u64 = 4096;

/// The file as text without a byte order mark.
///
/// # Errors
/// A [`TextError`] if it is missing, a folder, unreadable or not UTF-8.
pub fn read(path: &Path, wanted: &Wanted) -> Result<Source, TextError> {
    let name = path.display().to_string();
    let bytes = std::fs::read(path).map_err(|error| unreadable(path, &name, &error, wanted))?;
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
        Err(error) => Err(not_utf8(name, &bytes[start..], error.valid_up_to(), wanted)),
    }
}

fn unreadable(path: &Path, name: &str, error: &io::Error, wanted: &Wanted) -> TextError {
    let Wanted {
        what,
        format,
        hint: get_one,
        ..
    } = wanted;
    let (found, hint) = match error.kind() {
        io::ErrorKind::NotFound => (
            "no such file",
            format!("{what}s here: {}", neighbours(path, wanted)),
        ),
        _ if path.is_dir() => (
            "a folder",
            format!(
                "name the {what} in it: {}",
                neighbours(&path.join("x"), wanted)
            ),
        ),
        _ => ("a file that cannot be read", error.to_string()),
    };
    let diagnostic = Diagnostic::new(
        Fault::Unreadable,
        "",
        format!("cannot read the {what} {name}"),
    )
    .with_values(found, format!("a readable text file in {format}"))
    .with_hint(hint)
    .with_hint(*get_one);
    TextError::new(
        diagnostic,
        Source {
            name: name.to_owned(),
            text: String::new(),
        },
    )
}

/// The names of up to five such files beside `path`.
fn neighbours(path: &Path, wanted: &Wanted) -> String {
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    let dotted = format!(".{}", wanted.ending);
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let names = entries.map(|entry| entry.file_name().to_string_lossy().into_owned());
    let is_one = |name: &String| name.ends_with(&dotted) && has_header(&folder.join(name), wanted);
    let mut names: Vec<String> = names.filter(is_one).collect();
    names.sort_unstable();
    names.truncate(5);
    if names.is_empty() {
        "none".to_owned()
    } else {
        names.join(", ")
    }
}

/// Whether a file begins with the words of the wanted one's header, or that has none.
fn has_header(path: &Path, wanted: &Wanted) -> bool {
    if wanted.header.is_empty() {
        return true;
    }
    let mut bytes = Vec::new();
    let read =
        std::fs::File::open(path).and_then(|file| file.take(LONGEST_START).read_to_end(&mut bytes));
    if read.is_err() {
        return false;
    }
    let text = String::from_utf8_lossy(&bytes).to_lowercase();
    let first = text.lines().find(|line| !line.starts_with('#'));
    first.is_some_and(|first| wanted.header.iter().all(|word| first.contains(word)))
}

fn not_utf8(name: String, bytes: &[u8], at: usize, wanted: &Wanted) -> TextError {
    let wide = bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff");
    let hint = if wide {
        "this looks like UTF-16: save the file as UTF-8"
    } else {
        "save the file as UTF-8"
    };
    // The readable part stands as it is, so that the place found in the bytes is also the place in the text.
    let mut text = String::from_utf8_lossy(&bytes[..at]).into_owned();
    text.push_str(&String::from_utf8_lossy(&bytes[at..]));
    let diagnostic = Diagnostic::new(
        Fault::NotUtf8,
        "",
        format!("the {} is not UTF-8 text", wanted.what),
    )
    .with_values(format!("the byte 0x{:02X}", bytes[at]), "UTF-8 text")
    .with_hint(hint)
    .with_span(at..at + 1);
    TextError::new(diagnostic, Source { name, text })
}
