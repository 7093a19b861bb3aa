//! Text for the terminal.

use std::fmt::Write;

/// Width of the text, characters.
const WIDTH: usize = 100;

/// Appends `words` in lines of at most [`WIDTH`] characters.
pub(super) fn wrap(text: &mut String, first: &str, other: &str, words: &str) {
    let mut line = first.to_owned();
    let mut empty = true;
    for word in words.split(' ') {
        if !empty && line.chars().count() + 1 + word.chars().count() > WIDTH {
            let _ = writeln!(text, "{line}");
            line = other.to_owned();
            empty = true;
        }
        if !empty {
            line.push(' ');
        }
        line.push_str(word);
        empty = false;
    }
    let _ = writeln!(text, "{line}");
}
