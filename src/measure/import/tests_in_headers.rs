//! Wide tables whose headers name the test of each column: `run A 140000 cycles`, `run B 100000 cycles`.

use super::arrange::stated_above;
use super::columns::half_understood;
use super::wanted::Wanted;
use super::wide::{Wide, header, is_aside, of_one_test};
use super::{
    ImportError, Sheet, Titles, cell_name, conditions_above, multiples, new_parts, second_header,
};

type Result<T> = std::result::Result<T, ImportError>;

/// The mapping of a wide table.
///
/// # Errors
/// [`ImportError`] where cells are no numbers, or where it cannot be told what is what.
pub fn wide(sheet: &Sheet, wanted: &Wanted<'_>) -> Result<Wide> {
    let (sheet, between) = second_header::merged(sheet)?;
    let (sheet, new_parts) = new_parts::as_zero(&sheet);
    let (sheet, multiplied) = multiples::in_each_header(&sheet)?;
    half_understood::refuse(&sheet, wanted)?;
    if wanted.per_interval.cycles {
        return Err(ImportError(
            "--per-interval cycles is for tables with a row for each value: the columns or rows of this one are checkpoints, which count since the \
             start of the test"
                .to_owned(),
        ));
    }
    let above = stated_above(&sheet, wanted)?;
    let whole = sheet;
    let mut sheet = whole.clone();
    for &(row, _) in &above.obeyed {
        if !Titles::speak_of_values(&sheet.rows[row]) {
            sheet.rows[row].clear();
        }
    }
    let mut obeyed: Vec<String> = above.obeyed.into_iter().map(|(_, words)| words).collect();
    obeyed.extend(between);
    obeyed.extend(multiplied);
    obeyed.extend(new_parts);
    let wanted = &Wanted {
        test: wanted.test.or(above.test),
        member: wanted.member.or(above.member),
        tooth: above.tooth,
        ..wanted.clone()
    };
    let test = wanted.one_test(&whole).ok().map(|(test, _)| test);
    let of = (test.as_deref(), wanted.member);
    let compared = conditions_above::agree(&whole, above.head, of, wanted)?;
    let sheet = &sheet;
    let mut found = match tests_of_columns(sheet, wanted)? {
        Some((head, columns)) => of_several_tests(sheet, (head, &columns), wanted)?,
        None => of_one_test(sheet, wanted)?,
    };
    obeyed.extend(found.titles.agreeing(&compared));
    obeyed.append(&mut found.arranged);
    found.arranged = obeyed;
    Ok(found)
}

/// The mapping of a table whose headers name tests.
fn of_several_tests(
    sheet: &Sheet,
    (head, columns): (usize, &[OfTest<'_>]),
    wanted: &Wanted<'_>,
) -> Result<Wide> {
    let mut parts = Vec::new();
    for id in &wanted.tests {
        if columns.iter().any(|(_, test, _)| test == id) {
            let own = of_test(sheet, head, columns, id);
            let wanted = Wanted {
                test: Some(id),
                ..wanted.clone()
            };
            parts.push(of_one_test(&own, &wanted)?);
        }
    }
    let together = parts
        .into_iter()
        .map(Ok)
        .reduce(|all, next| joined(all?, next?));
    let mut together = together.expect("a column of some test")?;
    together.test.1 = Some("the headers say so");
    Ok(together)
}

/// A column with the test that its header names and the header without that name.
type OfTest<'w> = (usize, &'w str, String);

/// The header's row and its columns, if they name tests.
fn tests_of_columns<'w>(
    sheet: &Sheet,
    wanted: &'w Wanted<'_>,
) -> Result<Option<(usize, Vec<OfTest<'w>>)>> {
    let Ok(head) = header(sheet) else {
        return Ok(None);
    };
    let cells = sheet.rows[head].iter().enumerate().skip(1);
    let cells: Vec<(usize, &String)> = cells
        .filter(|(_, text)| !text.is_empty() && !is_aside(text))
        .collect();
    let named: Vec<OfTest<'w>> = (cells.iter())
        .filter_map(|&(column, text)| {
            let (id, rest) = wanted.test_in_header(text)?;
            Some((column, id, rest))
        })
        .collect();
    let Some((_, first, _)) = named.first() else {
        return Ok(None);
    };
    let is_named = |column: usize| named.iter().any(|(other, ..)| *other == column);
    if let Some((column, text)) = cells.iter().find(|(column, _)| !is_named(*column)) {
        return Err(ImportError(format!(
            "{}: the header `{text}` names no test of the study, others do (test {first}); its tests: {}. Add a [[test]] to the study with the id that \
             the header names, or take the column out",
            cell_name(head, *column),
            wanted.tests.join(", ")
        )));
    }
    if let Some(stated) = wanted.test
        && let Some((column, other, _)) = named.iter().find(|(_, id, _)| *id != stated)
    {
        return Err(ImportError(format!(
            "{}: the header `{}` says test {other}, --test says {stated}: leave --test out, each column goes to the test that its header names",
            cell_name(head, *column),
            sheet.rows[head][*column]
        )));
    }
    Ok(Some((head, named)))
}

/// The sheet with the columns of one test alone, their headers without its name.
fn of_test(sheet: &Sheet, head: usize, columns: &[OfTest<'_>], id: &str) -> Sheet {
    let mut own = sheet.clone();
    // the sheet may be named after another one
    own.name = if own.name.is_empty() {
        String::new()
    } else {
        id.to_owned()
    };
    for (column, test, rest) in columns {
        if *test == id {
            own.rows[head][*column].clone_from(rest);
            continue;
        }
        let cells = own.rows[head..].iter_mut();
        for cell in cells.filter_map(|row| row.get_mut(*column)) {
            cell.clear();
        }
    }
    own
}

/// What two parts of a table say, as one.
fn joined(mut all: Wide, next: Wide) -> Result<Wide> {
    if all.unit != next.unit || all.of_gear != next.of_gear {
        return Err(ImportError(format!(
            "the headers of tests {} and {} state other units, {} and {}, or other revolutions: import them one by one",
            all.test.0, next.test.0, all.unit.0, next.unit.0
        )));
    }
    all.test.0 = format!("{}, {}", all.test.0, next.test.0);
    all.checkpoints.extend(next.checkpoints);
    all.checkpoints.sort_by(f64::total_cmp);
    all.checkpoints.dedup();
    all.joined.extend(next.joined);
    // what stands below the table is told of once
    let new = (next.left_out.into_iter()).filter(|line| !all.left_out.contains(line));
    let new: Vec<String> = new.collect();
    all.left_out.extend(new);
    all.empty += next.empty;
    all.entries.extend(next.entries);
    Ok(all)
}
