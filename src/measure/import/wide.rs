//! Which cell of a wide table is what, and the rows of a measurement file that they give.

mod grid;
mod reading;
mod running_times;
mod whose;

use self::grid::{Grid, Places};
use self::reading::Reading;
use super::arrange::{self, flank_above};
use super::entry::{Entry, name_repeats, refuse_twice, state_face, state_sigma};
use super::flank::can_be_on_a_flank;
use super::multiples::{self, Multiple};
use super::numbers::{
    header_number, is_date, number, number_words, pointed, with_points, without_thousands,
};
use super::place::{PositionKind, on_flank};
use super::row_sigmas;
use super::sigmas::Sigmas;
use super::titles::Titles;
use super::wanted::{UnitFrom, Wanted};
use super::{
    ImportError, Sheet, cell_name, columns, counts, decimal_commas, deviations, footers,
    header_points, means, nameless, no_values, units,
};
use crate::measure::{Place, Quantity, Subject, names};

/// What the columns of a wide table are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Across {
    /// One column for each checkpoint; the first column holds positions.
    Checkpoints,
    /// One column for each position; the first column holds checkpoints.
    Positions,
}

/// What was understood of a wide table, and its rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Wide {
    /// Ids of the tests, and what states them beside the user.
    pub test: (String, Option<&'static str>),
    /// What was measured on.
    pub members: Vec<Subject>,
    /// What was measured.
    pub quantity: Quantity,
    /// What the columns are.
    pub across: Across,
    /// How places are told, with the least and the largest as the table has them; none for quantities without places.
    pub position: Option<(PositionKind, [f64; 2])>,
    /// Cell of the first header, with its words.
    pub corner: (String, String),
    /// The checkpoints, pinion revolutions.
    pub checkpoints: Vec<f64>,
    /// Whether they were revolutions of the gear.
    pub of_gear: bool,
    /// Unit of the values in the table, and what states it.
    pub unit: (String, UnitFrom),
    /// What the rows above the header say.
    pub titles: Titles,
    /// Whether the signs are turned.
    pub turned: bool,
    /// The flank that a row above the header says.
    pub flank: Option<String>,
    /// What was made of the values, in words.
    pub arranged: Vec<String>,
    /// What is said of checkpoints that are those of rows that are there already.
    pub joined: Vec<String>,
    /// Headers of the columns that are passed over.
    pub passed_over: Vec<String>,
    /// The rows or columns that are left out because the flank does not reach there, in words.
    pub left_out: Vec<String>,
    /// Cells without a value.
    pub empty: usize,
    /// Whether a column states the standard deviations of each row.
    pub has_sigma: bool,
    /// Rows of a measurement file.
    pub entries: Vec<Entry>,
}

type Result<T> = std::result::Result<T, ImportError>;

/// The mapping of a wide table of one test.
pub(super) fn of_one_test(sheet: &Sheet, wanted: &Wanted<'_>) -> Result<Wide> {
    let titled = || super::whole::titled(sheet);
    let quantity = wanted.quantity.or_else(titled);
    let quantity = quantity.unwrap_or(Quantity::WearDepth);
    if quantity.place() == Place::Whole {
        return super::whole::whole(sheet, quantity, wanted);
    }
    let head = header(sheet)?;
    decimal_commas::refuse(sheet, head)?;
    let test = wanted.one_test(sheet)?;
    let mut sheet = sheet.clone();
    without_thousands(&mut sheet, wanted.decimal, head);
    let corner = sheet.rows[head].first().cloned().unwrap_or_default();
    let is_place =
        |_, column, number| column == 0 && can_be_on_a_flank(number, &corner, quantity, wanted);
    let mut sheet = with_points(&sheet, wanted.decimal, |row, _| row > head, is_place)?;
    let means = means::only(&mut sheet, head)?;
    let multiple = Multiple::taken(&sheet, head).map(|(without, multiple)| {
        sheet = without;
        multiple
    });
    let sigmas = Sigmas::taken(&mut sheet, head, wanted)?;
    let passed_over = leave_out_what_is_for_people(&mut sheet, head);
    let below = footers::leave_out(&mut sheet, head);
    nameless::refuse_numbers(&sheet, head, 1)?;
    name_first_column(&mut sheet, head);
    let times = running_times::as_revolutions(&sheet, head, wanted, &test.0)?;
    let times = times.map(|(converted, said)| {
        sheet = converted;
        said
    });
    let sheet = &sheet;
    let mut grid = Grid::of(sheet, head)?;
    let corner = grid.corner();
    let whose = whose::of(sheet, head, &grid, quantity, wanted)?;
    let member = whose.member;
    let places = Places::of((quantity, member), wanted, corner)?;
    let across = grid.orientation(&places, wanted.across)?;
    let are_counts = across == Across::Checkpoints && multiple.is_none();
    let without_points = header_points::left_out(sheet, wanted.decimal, head, wanted.end(&test.0));
    if let Some(sheet) = without_points.as_ref().filter(|_| are_counts) {
        grid = Grid::of(sheet, head)?;
    }
    let mut left_out = grid.leave_out(across, &places)?;
    grid.refuse_unclear(across, quantity, multiple.is_some())?;
    if times.is_none() {
        counts::refuse_others_above(sheet, head)?;
    }
    // beside positions the headers' unit is that of the positions
    let headers = match across {
        Across::Checkpoints => grid.headers(),
        Across::Positions => Vec::new(),
    };
    let said = unit_of(&headers, quantity)?;
    let deviation = deviations::named(sheet, head, quantity, wanted);
    let is_used = |words: &str| {
        let is_of_deviations = deviation.as_ref().is_some_and(|named| named.is_of(words));
        let is_of_member = whose.title.as_deref() == Some(words);
        is_of_deviations
            || is_of_member
            || names::is_flank(words.split([' ', ':']).next().unwrap_or_default())
    };
    let titles = Titles::of(sheet, head, quantity, &wanted.per_interval)?.without(is_used);
    let unit = wanted.unit_of_values(quantity, said, titles.unit.as_deref())?;
    let turned = titles.turns_sign(wanted.turn_sign)?;
    let of_gear = counts_gear_revolutions(corner, &headers)?
        || multiple.as_ref().is_some_and(Multiple::is_of_gear);
    let factor = units::factor(&unit.0, quantity)?;
    let reading = Reading {
        wanted,
        test: &test.0,
        quantity,
        across,
        places: &places,
        factor: if turned { -factor } else { factor },
        of_gear,
        multiple: multiple.as_ref(),
    };
    let (mut entries, empty) = reading.entries(&grid)?;
    left_out.extend(below);
    left_out.extend(no_values::leave_out(&mut entries, sheet).0);
    if !whose.is_said {
        refuse_either_flank(&entries, places.kind, wanted, sheet, head)?;
    }
    let joined = wanted.there.join(&mut entries, true);
    let multiplied = multiple.iter().map(Multiple::said);
    let mut arranged: Vec<String> = means.into_iter().chain(multiplied).chain(times).collect();
    arranged.extend(whose.said);
    if let Some(sigmas) = &sigmas {
        arranged.push(sigmas.state(&mut entries, (quantity, &unit.0), wanted)?);
    }
    if let Some(named) = &deviation {
        let states_sign = turned || titles.lost_is_negative.is_some();
        arranged.push(named.as_depths(&mut entries, (states_sign, turned), wanted)?);
    }
    arranged.extend(in_order(&mut entries, sigmas.is_some(), wanted)?);
    let [column_numbers, row_numbers] = grid.numbers();
    let (on_flank, checkpoints) = match across {
        Across::Checkpoints => (row_numbers, column_numbers),
        Across::Positions => (column_numbers, row_numbers),
    };
    let mut checkpoints: Vec<f64> = (checkpoints.into_iter())
        .map(|cycles| reading.revolutions(cycles))
        .collect::<Result<_>>()?;
    checkpoints.sort_by(f64::total_cmp);
    Ok(Wide {
        members: vec![member],
        quantity,
        across,
        position: Some((places.kind, from_to(&on_flank))),
        corner: (cell_name(head, 0), corner.to_owned()),
        checkpoints,
        of_gear,
        unit,
        titles,
        turned,
        flank: flank_above(sheet, head)?,
        arranged,
        joined,
        passed_over,
        left_out,
        empty,
        has_sigma: sigmas.is_some(),
        entries,
        test,
    })
}

/// Refuses places that lie on the flank of either member, where nothing says whose they are.
fn refuse_either_flank(
    entries: &[Entry],
    kind: PositionKind,
    wanted: &Wanted<'_>,
    sheet: &Sheet,
    head: usize,
) -> Result<()> {
    let [pinion, gear] = wanted.gears;
    let on_other = |entry: &Entry| {
        let radius =
            (entry.position).map(|radius| kind.position(kind.told(radius, pinion), Some(gear)));
        radius.is_some_and(|radius| on_flank(gear, radius))
    };
    let is_on_flank = |entry: &Entry| entry.quantity.place() == Place::Flank;
    if entries.is_empty()
        || !entries
            .iter()
            .all(|entry| is_on_flank(entry) && on_other(entry))
    {
        return Ok(());
    }
    let titles = sheet.rows[..head].iter().flatten();
    let named = titles
        .map(|cell| cell.trim())
        .find(|words| names::one_member(words).is_some());
    let named = named.map_or(String::new(), |words| {
        format!(" (a row above says `{words}`)")
    });
    Err(ImportError(format!(
        "{}: these places ({}) lie on the pinion's flank and on the gear's{named}: say whose they are, --member pinion or --member gear",
        cell_name(head, 0),
        kind.word()
    )))
}

/// Sorts entries by time and place and names their traces; `has_sigma`: a column states their standard deviations.
pub(super) fn in_order(
    entries: &mut [Entry],
    has_sigma: bool,
    wanted: &Wanted<'_>,
) -> Result<Vec<String>> {
    let place = |entry: &Entry| entry.position.unwrap_or(0.0);
    entries.sort_by(|a, b| {
        let by_time = a.cycles.total_cmp(&b.cycles);
        by_time
            .then(place(a).total_cmp(&place(b)))
            .then(a.member.cmp(&b.member))
    });
    refuse_twice(entries)?;
    for entry in entries
        .iter_mut()
        .filter(|entry| wanted.traces && entry.position.is_some())
    {
        entry.trace = entry.own_trace(wanted);
    }
    state_face(entries, wanted)?;
    name_repeats(entries);
    if !has_sigma {
        state_sigma(entries, wanted)?;
    }
    wanted.per_interval.add_up(entries, true)
}

/// The columns with the number in the header of each.
pub(super) fn across_numbers(sheet: &Sheet, head: usize) -> Result<Vec<(usize, f64)>> {
    let cells = sheet.rows[head].iter().enumerate().skip(1);
    cells
        .filter(|(_, text)| !text.is_empty())
        .map(|(column, text)| Ok((column, header_number(text, head, column)?)))
        .collect()
}

/// Refuses the header of a checkpoint that has other numbers than that of revolutions.
pub(super) fn checkpoint(text: &str, quantity: Quantity, row: usize, column: usize) -> Result<()> {
    match number_words(text)[..] {
        [number] => counts::refuse_others(text, number, Some(quantity), row, column),
        _ => Ok(()),
    }
}

/// The rows with the number in the first cell of each.
pub(super) fn down_numbers(sheet: &Sheet, head: usize) -> Result<Vec<(usize, f64)>> {
    let mut down: Vec<(usize, f64)> = Vec::new();
    for (row, cells) in sheet.rows.iter().enumerate().skip(head + 1) {
        let first = cells.first().map_or("", String::as_str);
        if cells.iter().all(String::is_empty) {
            continue;
        }
        if first.is_empty() {
            return Err(ImportError(format!(
                "{}: nothing stands here beside values; the first column says where or when each row was measured",
                cell_name(row, 0)
            )));
        }
        down.push((row, number(first, row, 0)?));
    }
    if down.is_empty() {
        return Err(ImportError(format!(
            "no row of numbers below the header in row {}",
            head + 1
        )));
    }
    Ok(down)
}

fn from_to(numbers: &[f64]) -> [f64; 2] {
    [
        numbers.iter().copied().fold(f64::INFINITY, f64::min),
        numbers.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    ]
}

/// Refuses the same checkpoint or position in two columns or rows.
pub(super) fn refuse_twice_in_a_line(
    numbers: &[(usize, f64)],
    name: impl Fn(usize) -> String,
) -> Result<()> {
    for (n, (second, number)) in numbers.iter().enumerate() {
        if let Some((first, _)) = numbers[..n].iter().find(|(_, other)| other == number) {
            return Err(ImportError(format!(
                "{} and {} both say {number}: take one out; a repeated measurement is a table of its own, imported with --repeat 2",
                name(*first),
                name(*second)
            )));
        }
    }
    Ok(())
}

/// Whether the checkpoints are revolutions of the gear: the corner says so, or all headers do.
pub(super) fn counts_gear_revolutions(corner: &str, headers: &[&str]) -> Result<bool> {
    if names::counts_gear_revolutions(corner) {
        return Ok(true);
    }
    let of_gear = |header: &&&str| names::counts_gear_revolutions(header);
    let other = headers.iter().find(|header| !of_gear(header));
    match (headers.iter().find(of_gear), other) {
        (None, _) => Ok(false),
        (Some(_), None) => Ok(true),
        (Some(gear), Some(other)) => Err(ImportError(format!(
            "the header `{gear}` counts revolutions of the gear, `{other}` does not say so: write which all of them count"
        ))),
    }
}

/// The unit of the values that headers state.
pub(super) fn unit_of<'h>(headers: &[&'h str], quantity: Quantity) -> Result<Option<&'h str>>
where
    'static: 'h,
{
    let mut said: Vec<&'static str> = headers
        .iter()
        .filter_map(|header| units::of_values(header, quantity))
        .collect();
    said.dedup();
    match said[..] {
        [] => Ok(None),
        [one] => Ok(Some(one)),
        _ => Err(ImportError(format!(
            "the headers state several units: {}",
            said.join(", ")
        ))),
    }
}

/// Whether the header of a column says that it holds no values of a checkpoint or place: notes, statistics, standard deviations.
pub(super) fn is_aside(header: &str) -> bool {
    names::is_aside(header) || row_sigmas::is_one(header)
}

/// Empties the columns whose header says that they are for people or sum others up, and names them.
pub(super) fn leave_out_what_is_for_people(sheet: &mut Sheet, head: usize) -> Vec<String> {
    let mut left_out = Vec::new();
    for column in 1..sheet.rows[head].len() {
        if is_aside(&sheet.rows[head][column]) {
            left_out.push(sheet.rows[head][column].clone());
            let cells = sheet.rows[head..].iter_mut();
            for cell in cells.filter_map(|row| row.get_mut(column)) {
                cell.clear();
            }
        }
    }
    left_out
}

/// The first row with something in the first column, a number in the header of each other, and a row below it that begins with a number; without any such,
/// the first without that row: titles stand above it, `Gear tester; P 26` among them.
pub(super) fn header(sheet: &Sheet) -> Result<usize> {
    let numbers = |row: &[String]| {
        let cells = row.iter().skip(1);
        let cells = cells.filter(|text| !text.is_empty() && !is_aside(text));
        let (all, good) = cells.fold((0, 0), |(all, good), text| {
            // that of `Lastwechsel [1E6]` is no checkpoint
            let is_number = !is_date(text)
                && !number_words(text).is_empty()
                && multiples::factor(text).is_none();
            (all + 1, good + usize::from(is_number))
        });
        all > 0 && all == good
    };
    let is_header = |row: &[String]| {
        let first = row.first().map_or("", String::as_str);
        pointed(first).parse::<f64>().is_err() && numbers(row)
    };
    let begins_with_number = |row: &Vec<String>| {
        row.first()
            .is_some_and(|first| pointed(first).parse::<f64>().is_ok())
    };
    let is_filled = |row: &&Vec<String>| row.iter().any(|text| !text.is_empty());
    let has_values_below = |row: usize| {
        let mut below = sheet.rows[row + 1..].iter().filter(is_filled);
        below.next().is_some_and(begins_with_number)
    };
    let mut headers = (0..sheet.rows.len()).filter(|row| is_header(&sheet.rows[*row]));
    let first = headers.clone().next();
    (headers.find(|row| has_values_below(*row)))
        .or(first)
        .ok_or_else(|| no_header(sheet))
}

/// What is said of a table whose header is not found.
pub(super) fn no_header(sheet: &Sheet) -> ImportError {
    let long = columns::half_understood::best_header(sheet).map_or_else(
        || {
            "a table with a row for each value has columns test, member, cycles, position (`radius [mm]`) and values (`depth [um]`, `mass loss \
             [mg]`), named in its header"
                .to_owned()
        },
        |said| format!("read as a table with a row for each value, {said}"),
    );
    let hint = match arrange::hint(sheet) {
        Some(hint) if !long.contains("--per-interval") => format!("; {hint}"),
        _ => String::new(),
    };
    ImportError(format!(
        "no header row: in a table with a column for each checkpoint or place the first cell names what stands below it (such as `radius \
         [mm]`), the others begin with a number each (cycles, or a radius); {long}{hint}"
    ))
}

/// Names the first column of a table, of which the header says nothing, by the words in the row above it if these name places or cycles.
fn name_first_column(sheet: &mut Sheet, head: usize) {
    if !sheet.rows[head][0].is_empty() {
        return;
    }
    let is_filled = |row: &usize| sheet.rows[*row].iter().any(|cell| !cell.is_empty());
    let Some(above) = (0..head).rev().find(is_filled) else {
        return;
    };
    let words = sheet.rows[above][0].clone();
    let [column] = &columns::columns(std::slice::from_ref(&words))[..] else {
        return;
    };
    if ["position", "cycles"]
        .map(Some)
        .contains(&column.what.own())
    {
        sheet.rows[above][0].clear();
        sheet.rows[head][0] = words;
    }
}
