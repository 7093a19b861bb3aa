//! Long tables: a row for each value, with columns that say of which test, member, time and place it is.

mod checkpoints;
mod flanks;
mod line;
mod off_flank;
mod stops;
mod traces;
mod weights;

use super::arrange::{Arranged, arranged};
use super::columns::half_understood::said;
use super::columns::{Column, What, columns, known_by_content, with_sides};
use super::entry::{Entry, state_face, state_sigma};
use super::numbers::with_points;
use super::place::PositionKind;
use super::titles::Titles;
use super::wanted::{UnitFrom, Wanted};
use super::{ImportError, Sheet, cell_name, counts, decimal_commas, multiples, nameless, units};
use crate::measure::{Place, Quantity, names};
use crate::numeric::written;
use line::Line;

pub(super) use checkpoints::SAME;
pub(super) use weights::from_start;

/// What was understood of a long table, and its rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Long {
    /// Row of the header, counted from 1.
    pub row: usize,
    /// What was made of the table before it was read, in words.
    pub arranged: Vec<String>,
    /// What is said of checkpoints that are those of rows that are there already.
    pub joined: Vec<String>,
    /// The columns that are read, as written, each with what it is.
    pub columns: Vec<(String, String)>,
    /// The columns that are passed over, each with the reason.
    pub passed_over: Vec<(String, &'static str)>,
    /// The rows that are left out because the flank does not reach there, in words.
    pub left_out: Vec<String>,
    /// What the rows above the header say.
    pub titles: Titles,
    /// Whether the signs of losses are turned.
    pub turned: bool,
    /// The flank on which the values were measured, if the table says it.
    pub flank: Option<String>,
    /// Where the names of traces come from.
    pub traces: &'static str,
    /// Rows without a value.
    pub empty: usize,
    /// Whether a column states the standard deviations.
    pub has_sigma: bool,
    /// Rows of a measurement file.
    pub entries: Vec<Entry>,
}

type Result<T> = std::result::Result<T, ImportError>;

/// The columns of a long table that are read.
struct Read<'t> {
    head: usize,
    test: Option<&'t Column>,
    member: Option<&'t Column>,
    cycles: &'t Column,
    quantity: Option<&'t Column>,
    position: Option<&'t Column>,
    value: &'t Column,
    sigma: Option<&'t Column>,
    trace: Option<&'t Column>,
    face: Option<&'t Column>,
    tooth: Option<&'t Column>,
}

/// The mapping of a long table; none for other tables.
///
/// # Errors
/// [`ImportError`] where a column is missing or stands twice, or a cell says nothing that can be read.
pub fn long(sheet: &Sheet, wanted: &Wanted<'_>) -> Result<Option<Long>> {
    if let Some(cell) = &sheet.without_result {
        return Err(ImportError(format!(
            "{cell}: a formula without a stored result: open the table in the spreadsheet program and save it, then its results stand in the file"
        )));
    }
    let Some(Arranged {
        head,
        sheets,
        said,
        differences,
        stops,
    }) = arranged(sheet, wanted)?
    else {
        return Ok(None);
    };
    if wanted.across.is_some() {
        return Err(ImportError(format!(
            "--columns is for tables with a column for each checkpoint or place; row {} is the header of a table with a row for each value",
            head + 1
        )));
    }
    decimal_commas::refuse(sheet, head)?;
    let tables: Vec<Long> = sheets
        .iter()
        .zip(&stops)
        .map(|(own, stops)| of_columns((own, sheet, head), (differences, stops), wanted))
        .collect::<Result<_>>()?;
    let joined = tables.into_iter().reduce(Long::joined);
    Ok(joined.map(|long| Long {
        arranged: [said, long.arranged].concat(),
        ..long
    }))
}

/// The mapping of a table with a column for everything, made of a `whole` sheet.
fn of_columns(
    (sheet, whole, head): (&Sheet, &Sheet, usize),
    (differences, stops): (bool, &[Vec<usize>]),
    wanted: &Wanted<'_>,
) -> Result<Long> {
    nameless::refuse_numbers(sheet, head, 0)?;
    let mut columns = columns(&sheet.rows[head]);
    known_by_content(&mut columns, sheet, head, wanted);
    let columns = columns;
    let read = Read::of(&columns, head, wanted)?;
    let numbers = [read.position, Some(read.value), read.sigma, read.face];
    let sheet = &with_points(sheet, wanted.decimal, |row, column| {
        row > head && numbers.iter().flatten().any(|read| read.at == column)
    })?;
    let single = match (read.quantity, read.value.what) {
        (Some(_), _) => None,
        (None, what) => Some(single_quantity(&read, what, wanted)?),
    };
    counts::refuse_multiples_above(sheet, head)?;
    let titles = Titles::of(sheet, head, single.unwrap_or(Quantity::WearDepth))?;
    // what a deviation lost is positive whatever is said of the deviation's own sign, which has to be that of more material
    let stated = wanted.turn_sign || differences;
    let turned = titles.turns_sign(stated)? && !differences;
    let header = match sheet.rows[head] == whole.rows[head] {
        true => &columns,
        false => &with_sides(&whole.rows[head]),
    };
    read.nothing_missing(header, sheet, single, wanted)?;
    let line = |row: usize| Line {
        read: &read,
        sheet,
        row,
        wanted,
    };
    let mut empty = 0;
    let mut without_value = Vec::new();
    let mut entries = Vec::new();
    for (row, cells) in sheet.rows.iter().enumerate().skip(head + 1) {
        if cells.iter().all(String::is_empty) {
            continue;
        }
        if cells.get(read.value.at).is_none_or(String::is_empty) {
            empty += 1;
            without_value.push(row);
            continue;
        }
        entries.push(line(row).entry(single, &titles, turned)?);
    }
    if entries.is_empty() {
        return Err(ImportError(format!(
            "no row with a value below the header in row {}",
            head + 1
        )));
    }
    if !wanted.per_interval.losses.is_empty() {
        read.no_interval_missing(sheet, &without_value, &entries)?;
    }
    let mut arranged: Vec<String> =
        stops::refuse_times_of_each(&entries, sheet, (&read, &columns), stops)?
            .into_iter()
            .filter(|_| !wanted.per_interval.cycles)
            .collect();
    if read.quantity.is_none()
        && let Some(of_masses) = weights::as_losses(&mut entries, &read, wanted)?
    {
        (wanted.per_interval).refuse_differences(&[Quantity::MassLoss])?;
        arranged.push(of_masses);
    }
    let left_out = off_flank::leave_out(&mut entries, line)?;
    let joined = wanted.there.join(&mut entries, false);
    arranged.extend(checkpoints::join(&mut entries));
    let flank = flanks::only(sheet, head, &columns, &entries)?;
    let traces = traces::name(&mut entries, &read, wanted)?;
    if let (Some(column), Some(_)) = (read.face, wanted.face) {
        return Err(ImportError(format!(
            "--face: the table has a column of places across the face, {}; leave one of them out",
            column.cell(head)
        )));
    }
    state_face(&mut entries, wanted)?;
    if read.sigma.is_none() {
        state_sigma(&mut entries, wanted)?;
    }
    arranged.extend(wanted.per_interval.add_up(&mut entries, false)?);
    Ok(Long {
        row: head + 1,
        arranged,
        joined,
        left_out,
        columns: read.in_words(&columns, single, &titles, wanted)?,
        passed_over: passed_over(
            sheet,
            head,
            &columns,
            read.value,
            wanted.per_interval.cycles,
        ),
        titles,
        turned,
        flank,
        traces,
        empty,
        has_sigma: read.sigma.is_some(),
        entries,
    })
}

impl Long {
    /// With the rows of the other member.
    fn joined(mut self, other: Long) -> Long {
        let new = |known: &[(String, String)], own: &(String, String)| !known.contains(own);
        for column in other.columns {
            if new(&self.columns, &column) {
                self.columns.push(column);
            }
        }
        self.passed_over
            .retain(|column| other.passed_over.contains(column));
        for words in other.arranged {
            if !self.arranged.contains(&words) {
                self.arranged.push(words);
            }
        }
        self.joined.extend(other.joined);
        self.left_out.extend(other.left_out);
        self.empty += other.empty;
        self.has_sigma |= other.has_sigma;
        self.entries.extend(other.entries);
        self
    }
}

impl<'t> Read<'t> {
    fn of(columns: &'t [Column], head: usize, wanted: &Wanted<'_>) -> Result<Self> {
        let one = |name: &str| {
            let mut found = columns
                .iter()
                .filter(|column| column.what.own() == Some(name));
            match (found.next(), found.next()) {
                (Some(first), Some(second)) => Err(ImportError(format!(
                    "{} and {} both look like the column `{name}`: rename one (`comment` is passed over)",
                    first.cell(head),
                    second.cell(head)
                ))),
                (first, _) => Ok(first),
            }
        };
        // of several columns of values the one that is asked for
        let asked = |column: &&Column| {
            wanted
                .quantity
                .is_some_and(|q| column.what == What::Values(q))
        };
        let value = match columns.iter().find(asked) {
            Some(column) => column,
            None => one("value")
                .map_err(|error| {
                    ImportError(format!(
                        "{error}; or say with --quantity which one is meant"
                    ))
                })?
                .expect("a long table has values"),
        };
        Ok(Self {
            head,
            test: one("test")?,
            member: one("member")?,
            cycles: one("cycles")?.expect("a long table has cycles"),
            quantity: one("quantity")?,
            position: one("position")?,
            value,
            sigma: one("sigma")?,
            trace: one("trace")?,
            face: one("face")?,
            tooth: one("tooth")?,
        })
    }

    /// Refuses a table of which it is not known of what test, member or place its values are.
    fn nothing_missing(
        &self,
        columns: &[Column],
        sheet: &Sheet,
        single: Option<Quantity>,
        wanted: &Wanted<'_>,
    ) -> Result<()> {
        let mut missing = Vec::new();
        if self.test.is_none() && wanted.test.is_none() && wanted.one_test(sheet).is_err() {
            missing.push("test");
        }
        let quantity = single.unwrap_or(Quantity::WearDepth);
        if self.member.is_none() && wanted.stated_member(sheet, quantity)?.is_none() {
            missing.push("member");
        }
        if self.position.is_none()
            && single.is_some_and(|quantity| quantity.place() != Place::Whole)
        {
            missing.push("position");
        }
        if missing.is_empty() {
            return Ok(());
        }
        Err(ImportError(said(self.head, columns, &missing)))
    }

    /// Refuses rows without a value above others of the same part: a loss that nobody measured cannot be added up.
    fn no_interval_missing(
        &self,
        sheet: &Sheet,
        without_value: &[usize],
        entries: &[Entry],
    ) -> Result<()> {
        let of = [
            self.test,
            self.member,
            self.quantity,
            self.position,
            self.face,
            self.tooth,
        ];
        let part = |row: usize| of.map(|column| sheet.rows[row].get(column?.at));
        for &row in without_value {
            let is_later = |entry: &&Entry| entry.cell.0 > row && part(entry.cell.0) == part(row);
            if let Some(later) = entries.iter().find(is_later) {
                return Err(ImportError(format!(
                    "{}: nothing stands here below `{}`: without the loss of this interval the total of row {} is not known",
                    cell_name(row, self.value.at),
                    self.value.written,
                    later.cell.0 + 1
                )));
            }
        }
        Ok(())
    }

    /// The columns as written, each with what it is.
    fn in_words(
        &self,
        columns: &[Column],
        single: Option<Quantity>,
        titles: &Titles,
        wanted: &Wanted<'_>,
    ) -> Result<Vec<(String, String)>> {
        let mut words = Vec::new();
        for column in columns {
            let what = match column.what.own() {
                Some("value") if column.at != self.value.at => continue,
                Some("value") => match single {
                    Some(quantity) => {
                        let title = titles.unit.as_deref();
                        let (unit, from) =
                            wanted.unit_of_values(quantity, column.unit.as_deref(), title)?;
                        let from = match from {
                            UnitFrom::Title => " (the title says so)",
                            UnitFrom::Quantity => " (no unit is stated)",
                            _ => "",
                        };
                        format!("{} in {}{from}", quantity.name(), written::unit(&unit))
                    }
                    None => "value".to_owned(),
                },
                Some("position") => {
                    let quantity = single.unwrap_or(Quantity::WearDepth);
                    let kind = PositionKind::of(quantity, wanted.position, &column.written);
                    match (kind.has_unit(), &column.unit) {
                        (true, Some(unit)) => format!("{}, {unit}", kind.word()),
                        _ => kind.name().to_owned(),
                    }
                }
                Some("cycles") if column.hours.is_some() => {
                    "running time, turned into pinion revolutions by the speed of each test"
                        .to_owned()
                }
                Some("cycles") if column.of_gear => {
                    let factor = multiples::factor(&column.written);
                    let each = factor.map_or(String::new(), |n| format!(", {n} each"));
                    format!("revolutions of the gear, turned into those of the pinion{each}")
                }
                Some("cycles") => match multiples::factor(&column.written) {
                    Some(factor) => format!("cycles, {factor} pinion revolutions each"),
                    None => "cycles, pinion revolutions".to_owned(),
                },
                Some("sigma") => of_sigma(column),
                Some("member") if column.numbered => {
                    "member, 1 the pinion and 2 the gear".to_owned()
                }
                Some(own) if column.by_content => format!("{own}, by what stands in it"),
                Some(own) => own.to_owned(),
                None => continue,
            };
            words.push((column.written.clone(), what));
        }
        Ok(words)
    }
}

/// What a column of standard deviations is.
fn of_sigma(column: &Column) -> String {
    let unit = column.unit.as_deref();
    let unit = unit.map_or_else(String::new, |unit| format!(" in {}", written::unit(unit)));
    match column.coverage.filter(|k| *k != 1.0) {
        Some(k) => format!("an expanded uncertainty{unit}, sigma is it over k = {k}"),
        None => format!("sigma{unit}"),
    }
}

/// The quantity of a table without a column of quantities.
fn single_quantity(read: &Read<'_>, what: What, wanted: &Wanted<'_>) -> Result<Quantity> {
    let column = read.value.cell(read.head);
    match (what, wanted.quantity) {
        (What::Values(named), Some(stated)) if named != stated => Err(ImportError(format!(
            "{column} holds {}, --quantity says {}: leave --quantity out, or rename the column",
            named.name(),
            stated.name()
        ))),
        (What::Values(Quantity::MassLoss), None) if names::is_mass(&read.value.name()) => {
            Err(ImportError(format!(
                "{column} may be the mass that is left: say --quantity mass_loss if it is what was lost since the start of the test, or call it `mass \
                 loss [mg]`; two weighings are understood as well, in columns `mass before [g]` and `mass after [g]`, and with --quantity \
                 mass_loss a log of masses that begins at 0"
            )))
        }
        (What::Values(quantity), _) | (_, Some(quantity)) => Ok(quantity),
        (_, None) => {
            let unit = read.value.unit.as_deref().or(wanted.unit);
            let mut fit = [Quantity::WearDepth, Quantity::MassLoss]
                .into_iter()
                .filter(|quantity| unit.is_some_and(|unit| units::factor(unit, *quantity).is_ok()));
            fit.next().ok_or_else(|| {
                ImportError(format!(
                    "{column} does not say what was measured: name it with --quantity (wear_depth, mass_loss, ...), or call the column \
                     `depth [um]` or `mass loss [mg]`"
                ))
            })
        }
    }
}

/// The columns that are not read, those without a name if something stands below.
fn passed_over(
    sheet: &Sheet,
    head: usize,
    columns: &[Column],
    value: &Column,
    numbers_intervals: bool,
) -> Vec<(String, &'static str)> {
    let uses_speeds = columns
        .iter()
        .any(|column| column.what.own() == Some("cycles") && column.hours.is_some());
    let mut passed_over: Vec<(String, &'static str)> = (columns.iter())
        .filter_map(|column| {
            let why = match column.what {
                What::ForPeople if column.hours.is_some() => {
                    "a running time beside the revolutions, which are read"
                }
                What::ForPeople => "a comment column",
                What::Unknown if names::is_stop(&column.name()) && numbers_intervals => {
                    "the number of the interval, by which the lengths are added up"
                }
                What::Unknown if names::is_stop(&column.name()) => "the number of the stop",
                What::Unknown => "not known",
                What::Weighing(_) => "a weighing",
                What::Profile(_) => "another profile",
                What::Span(_) | What::Chord(_) => "a measurement of the tooth thickness",
                What::Flank => "one flank of each member stands in it, taken for the loaded one",
                What::Speed { .. } if !uses_speeds => "a speed, which is the study's",
                What::Expanded => {
                    "an expanded uncertainty that does not say its k: call it `U (k=2)` and it is read"
                }
                What::Values(_) if column.at != value.at => "another quantity",
                _ => return None,
            };
            Some((column.written.clone(), why))
        })
        .collect();
    let widest = sheet.rows[head..].iter().map(Vec::len).max().unwrap_or(0);
    for at in 0..widest {
        let named = columns
            .get(at)
            .is_some_and(|column| column.what != What::Nameless);
        let filled = sheet.rows[head..]
            .iter()
            .any(|row| row.get(at).is_some_and(|cell| !cell.is_empty()));
        if !named && filled {
            passed_over.push((cell_name(head, at), "no name stands in its header"));
        }
    }
    passed_over
}
