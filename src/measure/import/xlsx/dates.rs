//! Cells of a workbook that a spreadsheet shows as dates: numbers of days, which are no measurements.
//!
//! ```text
//! cell s -> cellXfs/xf numFmtId -> a date's own number, or a numFmt with a format code of d, m, y, h
//! ```
//! ECMA-376-1, 18.8.30 (numFmt), 18.17.4 (serial dates).

use roxmltree::{Document, Node};

use super::elements;

/// Days from the spreadsheets' day 0 to 1 January 1970.
const TO_1970: f64 = 25_569.0;
/// Days by which workbooks count from 1904.
const FROM_1904: f64 = 1462.0;
/// Days up to the year 9999.
const LAST: f64 = 2_958_465.0;

/// Which styles of a workbook show dates.
#[derive(Default)]
pub(super) struct Dates {
    styles: Vec<bool>,
    /// Days to add to its numbers.
    shift: f64,
}

impl Dates {
    /// Of the styles and the workbook.
    pub(super) fn of(styles: &Document<'_>, workbook: &Document<'_>) -> Self {
        let id = |node: Node<'_, '_>| node.attribute("numFmtId")?.parse::<u32>().ok();
        let codes: Vec<(u32, String)> = elements(styles.root(), "numFmt")
            .filter_map(|node| Some((id(node)?, node.attribute("formatCode")?.to_owned())))
            .collect();
        let is_date = |style: u32| match codes.iter().find(|(own, _)| *own == style) {
            Some((_, code)) => shows_date(code),
            None => matches!(style, 14..=22 | 27..=36 | 45..=47 | 50..=58),
        };
        let cells = elements(styles.root(), "cellXfs").flat_map(|all| elements(all, "xf"));
        let counts_from_1904 = elements(workbook.root(), "workbookPr")
            .any(|node| matches!(node.attribute("date1904"), Some("1" | "true")));
        Self {
            styles: cells.map(|xf| id(xf).is_some_and(is_date)).collect(),
            shift: if counts_from_1904 { FROM_1904 } else { 0.0 },
        }
    }

    /// The date, or the time of a day, that a cell with a number shows; none if it shows the number.
    pub(super) fn shown(&self, cell: Node<'_, '_>, number: f64) -> Option<String> {
        let style: usize = cell.attribute("s")?.parse().ok()?;
        let is_date = self.styles.get(style).copied().unwrap_or_default();
        let days = number + self.shift;
        if !is_date || !(0.0..=LAST).contains(&days) {
            return None;
        }
        let minutes = (1440.0 * days.fract()).round() as u32;
        let time = format!("{:02}:{:02}", minutes / 60, minutes % 60);
        if number < 1.0 {
            return Some(time);
        }
        let date = civil((days.floor() - TO_1970) as i64);
        Some(match minutes {
            0 => date,
            _ => format!("{date} {time}"),
        })
    }
}

/// Whether a format code has a letter of a date or a time outside quotes, escapes and brackets (but those of elapsed times: `[h]:mm`).
fn shows_date(code: &str) -> bool {
    let mut rest = code.chars();
    while let Some(c) = rest.next() {
        match c.to_ascii_lowercase() {
            'd' | 'm' | 'y' | 'h' => return true,
            '"' => {
                rest.by_ref().find(|&c| c == '"');
            }
            '\\' | '_' | '*' => {
                rest.next();
            }
            '[' => {
                let inside: String = rest.by_ref().take_while(|&c| c != ']').collect();
                let inside = inside.to_lowercase();
                if ["h", "hh", "m", "mm", "s", "ss"].contains(&inside.as_str()) {
                    return true;
                }
            }
            // placeholders of digits, and the end of what is for positive numbers
            '0' | '#' | '?' | ';' => return false,
            _ => {}
        }
    }
    false
}

/// The date so many days after 1 January 1970, by years of 1 March to the end of February.
fn civil(days: i64) -> String {
    let days = days + 719_468;
    let (era, of_era) = (days.div_euclid(146_097), days.rem_euclid(146_097));
    let year = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    let month = (5 * of_year + 2) / 153;
    let day = of_year - (153 * month + 2) / 5 + 1;
    let month = if month < 10 { month + 3 } else { month - 9 };
    let year = 400 * era + year + i64::from(month < 3);
    format!("{year:04}-{month:02}-{day:02}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_of_dates_are_told_from_those_of_numbers() {
        for code in [
            "yyyy-mm-dd h:mm:ss",
            "dd.mm.yy",
            "[$-407]d. mmmm yyyy",
            "[h]:mm",
            "[mm]",
            "h:mm AM/PM",
        ] {
            assert!(shows_date(code), "{code}");
        }
        for code in [
            "General",
            "0.00",
            "0.0\" mm\"",
            "\"day \"0",
            "[Red]0.0",
            "#,##0.00_m",
            "0.00E+00",
            "0 \\m\\g",
        ] {
            assert!(!shows_date(code), "{code}");
        }
    }

    #[test]
    fn days_are_counted_as_calendars_do() {
        for (days, date) in [
            (0, "1970-01-01"),
            (19_816, "2024-04-03"),
            (11_016, "2000-02-29"),
        ] {
            assert_eq!(civil(days), date);
        }
    }
}
