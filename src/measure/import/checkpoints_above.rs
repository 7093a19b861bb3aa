//! Two rows of headers, a checkpoint over its value and the standard deviation of it:
//!
//! ```text
//!             |  200000 LW        |  600000 LW             or      Lastwechsel |  200000           |  600000
//! Radius [mm] |  Wert | Streuung  |  Wert | Streuung               Radius [mm] |  Wert | Streuung  |  Wert | Streuung
//! ```

use super::checkpoints_across::count_and_rest;
use super::columns::{Column, What};
use super::numbers::{pointed, without_blanks};
use super::units::{bracketed, name_and_unit};
use super::{Sheet, row_sigmas, wide};
use crate::measure::names;

/// The same with one row, each checkpoint the header of its values, and the number of the row that it stood in, counted from 1; none for other sheets.
pub fn checkpoints_above(sheet: &Sheet) -> Option<(Sheet, usize)> {
    (1..sheet.rows.len()).find_map(|head| {
        let counted = counted(&sheet.rows[head - 1]);
        let above = counted.as_ref().unwrap_or(&sheet.rows[head - 1]);
        let starts = starts(above, &sheet.rows[head])?;
        Some((in_one_row(sheet, head, above, &starts), head))
    })
}

/// A row whose first cell says that the numbers behind it count revolutions, with that word in each of them; none for other rows.
fn counted(above: &[String]) -> Option<Vec<String>> {
    let (word, numbers) = above.split_first()?;
    let (name, unit) = name_and_unit(word);
    let is_plain = |cell: &&String| cell.is_empty() || pointed(cell).parse::<f64>().is_ok();
    if names::revolutions(&name).is_none()
        || unit.is_some()
        || !numbers.iter().all(|n| is_plain(&n))
    {
        return None;
    }
    let with_word = |cell: &String| match cell.as_str() {
        "" => String::new(),
        number => format!("{number} {word}"),
    };
    let own = numbers.iter().map(with_word);
    Some(std::iter::once(String::new()).chain(own).collect())
}

/// The columns of a header that hold the values of the checkpoints above them; none where anything else stands below these.
fn starts(above: &[String], header: &[String]) -> Option<Vec<usize>> {
    let cell = |at: usize| header.get(at).map_or("", String::as_str);
    let is_sigma = |at: usize| row_sigmas::is_one(cell(at));
    // a spreadsheet saved as text may repeat what was in a merged cell
    let repeats = |at: usize| is_sigma(at) && above[at] == above[at - 1];
    let starts: Vec<usize> = (1..above.len())
        .filter(|at| !above[*at].is_empty() && !repeats(*at))
        .collect();
    let ends = (starts.iter().copied().skip(1)).chain([header.len()]);
    let mut with_sigma = starts.iter().map(|start| is_sigma(start + 1));
    let first = with_sigma.next()?;
    let is_block = |(&start, end): (&usize, usize)| {
        let others = start + 1 + usize::from(first)..end;
        is_checkpoint(&above[start])
            && is_value(cell(start))
            && others.into_iter().all(|at| is_beside(cell(at)))
    };
    (with_sigma.all(|other| other == first) && starts.iter().zip(ends).all(is_block))
        .then_some(starts)
}

/// Whether a header counts revolutions and says nothing else.
fn is_checkpoint(header: &str) -> bool {
    let (name, _) = name_and_unit(header);
    let name = without_blanks(&name).unwrap_or(name);
    count_and_rest(&name).is_some_and(|(count, rest)| {
        let says_what = !names::words(&name.replacen(&count, " ", 1)).is_empty();
        rest.is_empty() && says_what
    })
}

/// Whether a header may be that of values: it names them, says that they are means, or is not known.
fn is_value(header: &str) -> bool {
    let column = Column::of(0, header);
    let may_be = matches!(
        column.what,
        What::Values(_) | What::Own("value") | What::Unknown
    );
    may_be && !header.contains(|c: char| c.is_ascii_digit()) && !header.is_empty()
}

/// Whether a column behind a checkpoint's is none of it: empty, for people, or the places of a table beside.
fn is_beside(header: &str) -> bool {
    header.is_empty()
        || wide::is_aside(header)
        || names::column(&name_and_unit(header).0) == Some("position")
}

fn in_one_row(sheet: &Sheet, head: usize, above: &[String], starts: &[usize]) -> Sheet {
    let mut sheet = sheet.clone();
    let first = sheet.rows[head][starts[0]].clone();
    for &at in starts {
        let header = &mut sheet.rows[head][at];
        *header = match name_and_unit(header).1 {
            Some(unit) if bracketed(&above[at]).is_none() => format!("{} [{unit}]", above[at]),
            _ => above[at].clone(),
        };
    }
    // what the values are is said above them
    let title = match above.first().filter(|cell| !cell.is_empty()) {
        Some(title) => title.clone(),
        None if matches!(Column::of(0, &first).what, What::Values(_)) => first,
        None => String::new(),
    };
    sheet.rows[head - 1] = vec![title];
    sheet
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_checkpoint_over_its_value_and_sigma_becomes_one_header() {
        let flank = Sheet::of_rows(&[
            "Verschlei\u{df}tiefe Ritzel [\u{b5}m]",
            "|200.000 LW||600.000 LW|",
            "Radius [mm]|Wert|Streuung|Wert|Streuung",
            "29,0|2,31|0,10|5,02|0,12",
        ]);
        let (one, row) = checkpoints_above(&flank).unwrap();
        assert_eq!(row, 2);
        assert_eq!(
            one.rows[2],
            [
                "Radius [mm]",
                "200.000 LW",
                "Streuung",
                "600.000 LW",
                "Streuung"
            ]
        );
        assert_eq!(one.rows[1], [""]);
        let masses = Sheet::of_rows(&[
            "||after 2e5 cycles|after 2e5 cycles|after 6e5 cycles|after 6e5 cycles",
            "Test|Member|loss [mg]|sd [mg]|loss [mg]|sd [mg]|Note",
            "T1|pinion|12.4|0.5|30.1|0.6|",
        ]);
        let (one, _) = checkpoints_above(&masses).unwrap();
        assert_eq!(one.rows[0], ["loss [mg]"]);
        assert_eq!(
            one.rows[1],
            [
                "Test",
                "Member",
                "after 2e5 cycles [mg]",
                "sd [mg]",
                "after 6e5 cycles [mg]",
                "sd [mg]",
                "Note"
            ]
        );
        let counted = Sheet::of_rows(&[
            "Lastwechsel|200.000||600.000|",
            "Radius [mm]|Wert|s [\u{b5}m]|Wert|s [\u{b5}m]",
            "29,0|2,31|0,10|5,02|0,12",
        ]);
        let (one, _) = checkpoints_above(&counted).unwrap();
        assert_eq!(one.rows[1][3], "600.000 Lastwechsel");
        assert_eq!(one.rows[0], [""]);
        // members below the checkpoints; plain numbers above; a table with one row of headers
        for [above, header] in [
            ["|200 LW||600 LW", "Test|Pinion|Gear|Pinion|Gear"],
            ["|200||600|", "Radius|Wert|Streuung|Wert|Streuung"],
            ["|200 LW||600 LW|", "Radius|Wert|Streuung|Wert|Wert"],
            ["Versuch 1", "Radius|200 LW|600 LW"],
        ] {
            let sheet = Sheet::of_rows(&[above, header, "1|2|3|4|5"]);
            assert!(checkpoints_above(&sheet).is_none(), "{header}");
        }
    }
}
