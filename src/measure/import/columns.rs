//! The header of a long table: which column is what.

use super::arrange::side;
use super::coverage::{coverage, without_level};
use super::numbers::pointed;
use super::wanted::Wanted;
use super::{ImportError, Sheet, cell_name, units};
use crate::measure::names::When;
use crate::measure::{Place, Quantity, Subject, names};

/// What a column is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum What {
    /// One of a measurement file's, by its name there.
    Own(&'static str),
    /// Values of a quantity.
    Values(Quantity),
    /// Masses of one of two weighings.
    Weighing(When),
    /// Deviations from the new profile, of one of two measurements.
    Profile(When),
    /// Spans over several teeth, of one of two measurements.
    Span(When),
    /// Chords of a tooth, of one of two measurements.
    Chord(When),
    /// The speed of rotation in revolutions per minute, of the gear if so.
    Speed {
        /// Whether it is the gear's.
        of_gear: bool,
    },
    /// The flank of the tooth.
    Flank,
    /// An expanded uncertainty of which nothing says how many standard deviations it is.
    Expanded,
    /// For people.
    ForPeople,
    /// Not known.
    Unknown,
    /// Without a name.
    Nameless,
}

impl What {
    /// The column of a measurement file, if it is one.
    pub(super) fn own(self) -> Option<&'static str> {
        match self {
            What::Own(name) => Some(name),
            What::Values(_) => Some("value"),
            _ => None,
        }
    }
}

/// A column.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Column {
    /// Where it stands, counted from 0.
    pub(super) at: usize,
    /// Its header as it is written.
    pub(super) written: String,
    /// What it is.
    pub(super) what: What,
    /// The unit that its header states.
    pub(super) unit: Option<String>,
    /// Whether it counts revolutions of the gear.
    pub(super) of_gear: bool,
    /// Hours of a unit of it, if it is a running time in place of cycles.
    pub(super) hours: Option<f64>,
    /// Whether what stands in it tells what it is, not its name.
    pub(super) by_content: bool,
    /// How many standard deviations its values are, if it holds expanded uncertainties.
    pub(super) coverage: Option<f64>,
    /// Whether it calls the pinion 1 and the gear 2.
    pub(super) numbered: bool,
}

impl Column {
    /// Of a header.
    pub(super) fn of(at: usize, written: &str) -> Self {
        let stated = coverage(written).filter(|(_, rest)| {
            let (name, _) = units::name_and_unit(rest);
            is_uncertainty(&name)
        });
        let (coverage, plain) = stated.unzip();
        let plain = plain.unwrap_or_else(|| written.to_owned());
        let without_level = without_level(&plain).filter(|rest| {
            let (name, _) = units::name_and_unit(rest);
            is_uncertainty(&name)
        });
        let at_a_level = without_level.is_some();
        let (name, unit) = units::name_and_unit(&without_level.unwrap_or(plain));
        let revolutions = names::revolutions(&name);
        let hours = names::hours(&name, unit.as_deref());
        let what = if written.is_empty() {
            What::Nameless
        } else if names::is_for_people(&name) {
            What::ForPeople
        } else if revolutions.is_some() || hours.is_some() {
            What::Own("cycles")
        } else if let Some(when) = weighed(&name, unit.as_deref()) {
            What::Weighing(when)
        } else if let Some(when) = names::profiled(&name) {
            What::Profile(when)
        } else if let Some(when) = names::spanned(&name) {
            What::Span(when)
        } else if let Some(when) = names::chord(&name) {
            What::Chord(when)
        } else if let Some(whose) = names::speed(&name, unit.as_deref()) {
            What::Speed {
                of_gear: whose == Some(Subject::Gear),
            }
        } else if names::is_flank(&name) {
            What::Flank
        } else if at_a_level || names::is_expanded_uncertainty(&name) {
            coverage.map_or(What::Expanded, |_| What::Own("sigma"))
        } else {
            match (names::column(&name), names::quantity(&name)) {
                // `gear [mg]` is no column of members
                (Some("member"), _) if unit.is_some() => What::Unknown,
                (Some(own), _) => What::Own(own),
                (None, Some((quantity, either))) => {
                    What::Values(by_unit(quantity, either, unit.as_deref()))
                }
                (None, None) => What::Unknown,
            }
        };
        let whose = revolutions
            .flatten()
            .or_else(|| names::one_member(unit.as_deref()?));
        Self {
            at,
            written: written.to_owned(),
            what,
            of_gear: what == What::Own("cycles") && whose == Some(Subject::Gear),
            unit,
            hours,
            by_content: false,
            coverage,
            numbered: false,
        }
    }

    /// Its name without its unit.
    pub(super) fn name(&self) -> String {
        units::name_and_unit(&self.written).0
    }

    fn is(&self, name: &str) -> bool {
        self.what.own() == Some(name)
    }

    /// The name of its header's cell.
    pub(super) fn cell(&self, head: usize) -> String {
        format!("{}: `{}`", cell_name(head, self.at), self.written)
    }
}

/// Which weighing a name and its unit mean: `mass before`, or `before [g]`.
fn weighed(name: &str, unit: Option<&str>) -> Option<When> {
    let is_mass = unit.is_some_and(|unit| units::factor(unit, Quantity::MassLoss).is_ok());
    names::weighed(name).or_else(|| names::time_alone(name).filter(|_| is_mass))
}

/// Whether a name means one standard deviation or several.
fn is_uncertainty(name: &str) -> bool {
    names::column(name) == Some("sigma") || names::is_expanded_uncertainty(name)
}

/// `loss [um]` is a depth, `wear [mg]` a mass.
fn by_unit(quantity: Quantity, either: bool, unit: Option<&str>) -> Quantity {
    let Some(unit) = unit.filter(|unit| either && units::factor(unit, quantity).is_err()) else {
        return quantity;
    };
    let other = [Quantity::WearDepth, Quantity::MassLoss].into_iter();
    let mut other = other.filter(|other| units::factor(unit, *other).is_ok());
    other.next().unwrap_or(quantity)
}

/// The columns of a header, those without name at its end left out.
pub(super) fn columns(row: &[String]) -> Vec<Column> {
    let named = row
        .iter()
        .rposition(|cell| !cell.is_empty())
        .map_or(0, |at| at + 1);
    let cells = row[..named].iter().enumerate();
    let mut columns: Vec<Column> = cells.map(|(at, cell)| Column::of(at, cell)).collect();
    // a deviation is a depth where nothing else is, and no other one is to be taken from it
    let is_before = |column: &Column| column.what == What::Profile(When::Before);
    if !has(&columns, "value") && !columns.iter().any(is_before) {
        let deviates = |column: &&mut Column| {
            let (name, _) = units::name_and_unit(&column.written);
            matches!(column.what, What::Unknown | What::Profile(_)) && names::is_deviation(&name)
        };
        for column in columns.iter_mut().filter(deviates) {
            column.what = What::Values(Quantity::WearDepth);
        }
    }
    count_by_one_letter(&mut columns);
    span_by_one_letter(&mut columns);
    // a running time beside cycles says nothing more
    if (columns.iter()).any(|column| column.is("cycles") && column.hours.is_none()) {
        for column in columns.iter_mut().filter(|column| column.hours.is_some()) {
            column.what = What::ForPeople;
        }
    }
    columns
}

/// Takes `N` for the count of cycles where nothing else is: with a unit it may be a speed.
fn count_by_one_letter(columns: &mut [Column]) {
    if has(columns, "cycles") {
        return;
    }
    for column in columns {
        let (name, unit) = units::name_and_unit(&column.written);
        let is_count = names::is_one_letter_count(&name) && unit.is_none();
        if column.what == What::Unknown && is_count {
            column.what = What::Own("cycles");
        }
    }
}

/// Takes `k` for the number of teeth that a span goes over.
fn span_by_one_letter(columns: &mut [Column]) {
    let is_span = |column: &Column| {
        matches!(
            column.what,
            What::Span(_) | What::Values(Quantity::SpanLoss)
        )
    };
    if has(columns, "position") || !columns.iter().any(is_span) {
        return;
    }
    for column in columns {
        if column.what == What::Unknown && column.written.trim() == "k" {
            column.what = What::Own("position");
        }
    }
}

/// Takes a column that its name does not tell for the tests or the members if nothing else stands in it and no other column has them: passed over,
/// all its values would go to one of them. A column of members may number them, if no other one names them.
pub(super) fn known_by_content(
    columns: &mut [Column],
    sheet: &Sheet,
    head: usize,
    wanted: &Wanted<'_>,
) {
    // numbers may count anything
    let is_test = |text: &str| wanted.test_of(text).is_some() && text.parse::<f64>().is_err();
    let is_member = |text: &str| names::member(text).is_some();
    let is_it = |name: &str, text: &str| match name {
        "test" => is_test(text),
        _ => is_member(text),
    };
    let holds = |column: &Column, is_it: &dyn Fn(&str) -> bool| {
        let below = sheet.rows[head + 1..].iter();
        let mut cells = below
            .filter_map(|row| row.get(column.at))
            .filter(|cell| !cell.is_empty())
            .peekable();
        cells.peek().is_some() && cells.all(|cell| is_it(cell))
    };
    for name in ["test", "member"] {
        if has(columns, name) {
            continue;
        }
        let is_one = |column: &&mut Column| {
            column.what == What::Unknown && holds(column, &|text| is_it(name, text))
        };
        if let Some(column) = columns.iter_mut().find(is_one) {
            column.what = What::Own(name);
            column.by_content = true;
        }
    }
    let names_members = |column: &Column| column.what == What::Unknown && holds(column, &is_member);
    if !columns.iter().any(names_members) {
        for column in columns.iter_mut().filter(|column| column.is("member")) {
            column.numbered = holds(column, &|text| names::numbered_member(text).is_some());
        }
    }
}

fn has(columns: &[Column], name: &str) -> bool {
    columns.iter().any(|column| column.is(name))
}

/// What was understood of the row that looks most like a long table's header, and what is missing there; none if no row does.
pub(super) fn understood(sheet: &Sheet) -> Option<String> {
    let known = |columns: &[Column]| columns.iter().filter_map(in_words).count();
    let rows = sheet
        .rows
        .iter()
        .enumerate()
        .map(|(row, cells)| (row, with_sides(cells)));
    // the first of those with the most
    let (row, columns) = rows.rev().max_by_key(|(_, columns)| known(columns))?;
    (known(&columns) > 0).then(|| said(row, &columns, &missing(&columns)))
}

/// The columns of a header, those that are named after a member too as what they are of it.
pub(super) fn with_sides(cells: &[String]) -> Vec<Column> {
    let mut columns = columns(cells);
    for column in columns.iter_mut().filter(|c| c.what == What::Unknown) {
        if let Some((_, rest)) = side(&column.written) {
            column.what = Column::of(column.at, &rest).what;
        }
    }
    columns
}

/// Whether a header has two measurements of something, one of the new part and one of the worn.
fn has_pair(columns: &[Column]) -> bool {
    let is_there = |what: What| columns.iter().any(|column| column.what == what);
    let is_pair = |of: fn(When) -> What| {
        let mut times = [When::Before, When::After].into_iter();
        times.all(|when| is_there(of(when)))
    };
    let kinds = [What::Weighing, What::Profile, What::Span, What::Chord];
    kinds.into_iter().any(is_pair)
}

/// What a long table needs and a header lacks.
fn missing(columns: &[Column]) -> Vec<&'static str> {
    let is_whole = |column: &Column| match column.what {
        What::Weighing(_) => true,
        What::Values(quantity) => quantity.place() == Place::Whole,
        _ => false,
    };
    let has_pair = has_pair(columns);
    let of_members = |column: &Column| names::one_member(&column.written).is_some();
    let needed = ["test", "member", "cycles", "position", "value"].into_iter();
    let missing = needed.filter(|name| match *name {
        "position" if columns.iter().any(is_whole) => false,
        "member" if columns.iter().any(of_members) => false,
        "value" if has_pair => false,
        name => !has(columns, name),
    });
    missing.collect()
}

/// Refuses a table with a column of tests, or with two measurements of something, that lacks what it needs to be a long one: none of its rows is the
/// header of a wide one.
pub(super) fn refuse_half_understood(
    sheet: &Sheet,
    wanted: &Wanted<'_>,
) -> Result<(), ImportError> {
    let is_number = |cell: &String| pointed(cell).parse::<f64>().is_ok();
    for (row, cells) in sheet.rows.iter().enumerate() {
        let is_entry = |cell: &String| is_number(cell) || wanted.test_of(cell).is_some();
        if cells.iter().any(is_entry) {
            continue;
        }
        let mut columns = with_sides(cells);
        known_by_content(&mut columns, sheet, row, wanted);
        let is_known = columns.iter().filter_map(in_words).count() > 1;
        let has_tests = columns.iter().find(|c| c.is("test")).is_some_and(|test| {
            let below = sheet.rows[row + 1..].iter();
            let mut names = below
                .filter_map(|cells| cells.get(test.at))
                .filter(|name| !name.is_empty());
            match is_known {
                true => names.next().is_some(),
                false => columns.len() > 2 && names.any(|name| wanted.test_of(name).is_some()),
            }
        });
        if !has_tests && !has_pair(&columns) {
            continue;
        }
        let mut missing = missing(&columns);
        let member = wanted.stated_member(sheet, Quantity::WearDepth);
        missing.retain(|name| match *name {
            "test" => wanted.one_test(sheet).is_err(),
            "member" => !matches!(member, Ok(Some(_))),
            _ => true,
        });
        return Err(ImportError(format!(
            "it looks like a table with a row for each value, of which not enough is understood: {}",
            said(row, &columns, &missing)
        )));
    }
    Ok(())
}

/// What a column is, for messages; none if it is not known.
fn in_words(column: &Column) -> Option<String> {
    let time = |when: When| match when {
        When::Before => "before the test",
        When::After => "after the test",
    };
    Some(match column.what {
        What::Values(quantity) => format!("value ({})", quantity.name()),
        What::Weighing(when) => format!("the mass {}", time(when)),
        What::Profile(when) => format!("the profile {}", time(when)),
        What::Span(when) => format!("the span {}", time(when)),
        What::Chord(when) => format!("the chord {}", time(when)),
        What::Speed { .. } => "a speed".to_owned(),
        What::Flank => "the flank".to_owned(),
        What::Own("cycles") if column.hours.is_some() => "cycles (a running time)".to_owned(),
        What::Own(own) => own.to_owned(),
        What::Expanded | What::ForPeople | What::Unknown | What::Nameless => return None,
    })
}

/// The header, what was understood of it, what is missing, and how to name it.
pub(super) fn said(head: usize, columns: &[Column], missing: &[&str]) -> String {
    let written: Vec<&str> = columns
        .iter()
        .map(|column| column.written.as_str())
        .collect();
    let parts = |of: &dyn Fn(&Column) -> Option<String>| {
        let parts: Vec<String> = columns.iter().filter_map(of).collect();
        if parts.is_empty() {
            "nothing".to_owned()
        } else {
            parts.join(", ")
        }
    };
    let understood =
        parts(&|column| Some(format!("`{}` as {}", column.written, in_words(column)?)));
    let not = parts(&|column| {
        let is_known = ![What::Unknown, What::Expanded].contains(&column.what);
        (!is_known).then(|| format!("`{}`", column.written))
    });
    format!(
        "the header in row {} is `{}`; understood: {understood}; not understood: {not}; missing: {}. A long table needs columns `test`, \
         `member`, `cycles` (of the pinion), for depths a position (`radius [mm]`, `roll angle [deg]`; for spans `teeth spanned`) and \
         values (`depth [um]`, `mass loss [mg]`), optional `sigma` and `trace`; --test and --member stand for such a column{}{}",
        head + 1,
        written.join("; "),
        missing.join(", "),
        on_time(columns, missing),
        on_values(columns, missing),
    )
}

/// What is said of a column that may be the times of intervals, where cycles are missing.
fn on_time(columns: &[Column], missing: &[&str]) -> String {
    let is_time = |column: &&Column| {
        let unit = column.unit.as_deref();
        column.what == What::Unknown && unit.is_some_and(|u| names::hours_of_unit(u).is_some())
    };
    match columns.iter().find(is_time) {
        Some(column) if missing.contains(&"cycles") => format!(
            ". If `{}` is the running time since the start of the test, call it `time [h]`; add up the times of single intervals first",
            column.written
        ),
        _ => String::new(),
    }
}

/// What is said of one of two measurements, where the other one is missing.
fn on_values(columns: &[Column], missing: &[&str]) -> String {
    if !missing.contains(&"value") {
        return String::new();
    }
    let other = columns.iter().find_map(|column| match column.what {
        What::Weighing(When::Before) => Some("`mass after [g]`"),
        What::Weighing(When::After) => Some("`mass before [g]`"),
        What::Profile(When::Before) => Some("`deviation after [um]`"),
        What::Profile(When::After) => Some("`deviation before [um]`"),
        _ => None,
    });
    other.map_or_else(String::new, |other| {
        format!(". A loss is the difference of two measurements: {other} is the other one")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_are_understood() {
        let row: Vec<String> = [
            "Run",
            "Wheel",
            "Revs",
            "r_mm",
            "loss_um",
            "sd_um",
            "note",
            "lab",
            "gear [mg]",
        ]
        .map(str::to_owned)
        .to_vec();
        let what: Vec<What> = columns(&row)
            .into_iter()
            .map(|column| column.what)
            .collect();
        assert_eq!(
            what,
            [
                What::Own("test"),
                What::Own("member"),
                What::Own("cycles"),
                What::Own("position"),
                What::Values(Quantity::WearDepth),
                What::Own("sigma"),
                What::ForPeople,
                What::Unknown,
                What::Unknown
            ]
        );
        let gear = Column::of(0, "cycles (gear)");
        assert!(gear.of_gear && gear.what == What::Own("cycles"));
        assert!(Column::of(0, "Umdrehungen Rad").of_gear);
        assert!(!Column::of(0, "revolutions of the pinion").of_gear);
    }
}
