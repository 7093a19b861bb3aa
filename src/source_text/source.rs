//! A text file as it was read.

use std::ops::Range;

/// A text file as it was read, with the name under which the user knows it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// File name or path as given by the user; stands in every message.
    pub name: String,
    /// The text, without a byte order mark.
    pub text: String,
}

impl Source {
    /// Line and column (in characters) of a byte offset, both counted from 1.
    pub fn position(&self, offset: usize) -> (usize, usize) {
        let before = &self.text[..self.boundary(offset)];
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        (
            before.matches('\n').count() + 1,
            before[line_start..].chars().count() + 1,
        )
    }

    /// The span moved onto character boundaries inside the text; an empty one is widened to a visible character.
    pub fn visible(&self, span: Range<usize>) -> Range<usize> {
        let start = self.boundary(span.start);
        let end = self.boundary(span.end.max(start));
        if end > start {
            return start..end;
        }
        match self.text[start..].chars().next() {
            Some(next) if next != '\n' && next != '\r' => start..start + next.len_utf8(),
            _ => start..start,
        }
    }

    fn boundary(&self, offset: usize) -> usize {
        let mut at = offset.min(self.text.len());
        while !self.text.is_char_boundary(at) {
            at -= 1;
        }
        at
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_characters_and_lines() {
        let source = Source {
            name: "s".into(),
            text: "aé\r\nb = 1\n".into(),
        };
        assert_eq!(source.position(0), (1, 1));
        assert_eq!(source.position(3), (1, 3));
        assert_eq!(source.position(9), (2, 5));
        assert_eq!(source.position(999), (3, 1));
        assert_eq!(source.position(2), (1, 2), "inside é: moved to its start");
    }
}
