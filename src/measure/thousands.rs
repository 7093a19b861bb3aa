//! Marks between the thousands of numbers: which are certain, and what the other cells of a column tell of those that are not.
//!
//! ```text
//! 1.000.000            a million, whatever else is written: no number has two decimal points
//! 250.000              a quarter of a million or 250: its column tells (`1.000.000`, `1000.000`), or the decimals of the other columns
//! ```

/// The marks that decimals and thousands are written with.
const MARKS: [char; 2] = ['.', ','];

/// Whether a number looks like one with marks between its thousands: `250.000`.
pub(crate) fn in_thousands(text: &str) -> bool {
    let mut groups = text.split(MARKS);
    let digits = |group: &str| group.bytes().all(|b| b.is_ascii_digit());
    let first = groups.next().unwrap_or_default();
    let mut rest = groups.peekable();
    rest.peek().is_some()
        && digits(first)
        && (1..=3).contains(&first.len())
        && !first.starts_with('0')
        && rest.all(|group| group.len() == 3 && digits(group))
}

/// Whether a number's one mark stands before decimals whatever else is written: `0,15`, `2.5`. Three digits behind it, as in `0,250`, leave a doubt.
pub(crate) fn has_certain_decimals(number: &str) -> bool {
    let decimals = number.rsplit_once(MARKS).map_or(0, |(_, part)| part.len());
    lone(number).is_some() && decimals != 3
}

/// A number without the marks between its thousands where they can be nothing else: two or more of one kind.
pub(crate) fn without_certain(text: &str) -> Option<String> {
    certain(text).map(|mark| text.replace(MARKS[mark], ""))
}

/// A number without marks that may stand between its thousands.
fn without_marks(text: &str) -> String {
    text.replace(MARKS, "")
}

/// What a number may be whose last mark stands between thousands or before decimals.
pub(crate) fn both_readings(text: &str) -> String {
    let (whole, part) = text.rsplit_once(MARKS).unwrap_or((text, "0"));
    format!(
        "is that {}, or {}.{part} with decimals?",
        without_marks(text),
        without_marks(whole)
    )
}

/// Which of [`MARKS`] certainly stands between the thousands of a number.
fn certain(text: &str) -> Option<usize> {
    let is_one = in_thousands(unsigned(text));
    (0..MARKS.len()).find(|&mark| {
        is_one && text.matches(MARKS[mark]).count() > 1 && !text.contains(MARKS[1 - mark])
    })
}

/// The mark of a number that has only one.
fn lone(text: &str) -> Option<usize> {
    let one = text.matches(MARKS).count() == 1;
    (0..MARKS.len()).find(|&mark| one && text.contains(MARKS[mark]))
}

fn unsigned(text: &str) -> &str {
    text.trim_start_matches(['+', '-'])
}

/// What the numbers of a column of counts, and the decimals of other columns, tell of a single mark in it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct CountMarks {
    /// Of each mark: whether it stands between thousands somewhere in the column.
    thousands: [bool; 2],
    /// The same of decimals there.
    decimals: [bool; 2],
    /// The same of decimals in other columns.
    elsewhere: [bool; 2],
}

impl CountMarks {
    /// Learns from a number of the column.
    pub(crate) fn see(&mut self, number: &str) {
        if let Some(mark) = certain(number) {
            self.thousands[mark] = true;
        } else if let Some(mark) = lone(number).filter(|_| !in_thousands(unsigned(number))) {
            self.decimals[mark] = true;
        }
    }

    /// Learns from a number of another column.
    pub(crate) fn see_elsewhere(&mut self, number: &str) {
        if let Some(mark) = lone(number).filter(|_| !in_thousands(unsigned(number))) {
            self.elsewhere[mark] = true;
        }
    }

    /// Whether the single mark of a number of the column stands between thousands; none if nothing tells, or if there is no such mark.
    fn separates(self, number: &str) -> Option<bool> {
        let mark = lone(number).filter(|_| in_thousands(unsigned(number)))?;
        let other = 1 - mark;
        let thousands = self.thousands[mark] || self.decimals[other] || self.elsewhere[other];
        let decimals = self.decimals[mark] || self.thousands[other];
        (thousands != decimals).then_some(thousands)
    }

    /// A number of the column without marks that are known to stand between thousands.
    pub(crate) fn plain(self, number: &str) -> Option<String> {
        let known = self.separates(number) == Some(true);
        without_certain(number).or_else(|| known.then(|| without_marks(number)))
    }

    /// Whether nothing tells what the marks of a number of the column are.
    pub(crate) fn is_unclear(self, number: &str) -> bool {
        in_thousands(unsigned(number))
            && certain(number).is_none()
            && self.separates(number).is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thousands_are_told_from_decimals() {
        for text in ["250.000", "1.000.000", "250,000"] {
            assert!(in_thousands(text), "{text}");
        }
        for text in ["250000", "250000.000", "0.000", "2.5", "2.5e5", ""] {
            assert!(!in_thousands(text), "{text}");
        }
    }

    #[test]
    fn two_marks_of_a_kind_are_certain() {
        assert_eq!(without_certain("1.000.000").as_deref(), Some("1000000"));
        assert_eq!(without_certain("-12,345,678").as_deref(), Some("-12345678"));
        for text in ["1.000", "1.000,000", "1.00.000", "0.000.000", "1.000.00"] {
            assert_eq!(without_certain(text), None, "{text}");
        }
    }

    #[test]
    fn a_single_mark_is_read_by_what_stands_beside_it() {
        let of = |column: &[&str], elsewhere: &[&str]| {
            let mut marks = CountMarks::default();
            column.iter().for_each(|text| marks.see(text));
            elsewhere.iter().for_each(|text| marks.see_elsewhere(text));
            (marks.plain("13.333"), marks.is_unclear("13.333"))
        };
        let thousands = (Some("13333".to_owned()), false);
        let decimals = (None, false);
        let unclear = (None, true);
        assert_eq!(of(&["13.333", "1.000.000"], &["26.5"]), thousands);
        assert_eq!(of(&["13.333"], &["26,5"]), thousands);
        assert_eq!(of(&["13.333", "2,5"], &[]), thousands);
        assert_eq!(of(&["13.333", "1000.000"], &[]), decimals);
        assert_eq!(of(&["13.333", "1,000,000"], &["26.5"]), decimals);
        assert_eq!(of(&["13.333", "40000"], &["26.5", "1.234"]), unclear);
        assert_eq!(of(&["13.333", "1.000.000", "2.5"], &[]), unclear);
        assert!(!CountMarks::default().is_unclear("40000"));
    }
}
