//! Columns that are named after members alone, with a unit or without: `Run | Hours | Pinion (g) | Wheel (g)`.

use super::{has, put_column};
use crate::measure::import::columns::{Column, columns};
use crate::measure::import::{ImportError, Sheet, Wanted, units};
use crate::measure::{Place, Quantity, Subject, names};

/// A column that is named after a member.
struct Alone {
    at: usize,
    member: Subject,
    name: String,
    unit: Option<String>,
}

/// The table with the quantity that the user states in the names of these columns; none where there are no such columns, or where they are
/// read otherwise.
///
/// # Errors
/// [`ImportError`] where their units are those of a mass, and nothing says whether it was lost.
pub(super) fn named(
    sheet: &Sheet,
    head: usize,
    wanted: &Wanted<'_>,
) -> Result<Option<Sheet>, ImportError> {
    let header = columns(&sheet.rows[head]);
    let alone: Vec<Alone> = header.iter().filter_map(Alone::of).collect();
    let has_cycles = has(&header, "cycles") || wanted.cycles.is_some();
    if alone.is_empty() || has(&header, "value") || !has_cycles {
        return Ok(None);
    }
    match wanted.quantity {
        Some(quantity) if quantity.place() == Place::Whole => {
            Ok(as_values(sheet, head, &header, &alone, quantity))
        }
        None if alone.iter().any(Alone::is_mass) => Err(no_quantity(&header, head, &alone)),
        _ => Ok(None),
    }
}

/// With the quantity in the names of the columns, which are those of the sides of a table then.
fn as_values(
    sheet: &Sheet,
    head: usize,
    header: &[Column],
    alone: &[Alone],
    quantity: Quantity,
) -> Option<Sheet> {
    // cycles and members and nothing else are a wide table
    let has_hours = header.iter().any(|column| column.hours.is_some());
    if !has(header, "test") && !has_hours {
        return None;
    }
    let mut sheet = sheet.clone();
    // it may be what was lost, or what is left
    let quantity = match quantity {
        Quantity::MassLoss => "mass",
        other => other.name(),
    };
    let with_unit = |column: &Alone, name: String| match &column.unit {
        Some(unit) => format!("{name} [{unit}]"),
        None => name,
    };
    match alone {
        [one] if one.unit.is_some() && !has(header, "member") => {
            sheet.rows[head][one.at] = with_unit(one, quantity.to_owned());
            put_column(&mut sheet, head, "member", one.member.name());
        }
        [_] => return None,
        all => {
            for column in all {
                let name = format!("{} {quantity}", column.name);
                sheet.rows[head][column.at] = with_unit(column, name);
            }
        }
    }
    Some(sheet)
}

/// What is said of masses that may be what was lost, or what is left.
fn no_quantity(header: &[Column], head: usize, alone: &[Alone]) -> ImportError {
    let masses = alone.iter().filter(|column| column.is_mass());
    let cells = masses.filter_map(|mass| {
        let column = header.iter().find(|column| column.at == mass.at)?;
        Some(column.cell(head))
    });
    let cells: Vec<String> = cells.collect();
    let units = alone.iter().find_map(|column| column.unit.as_deref());
    ImportError(format!(
        "{}: the columns of the members are in {}, so they hold masses: say --quantity mass_loss if these are what was lost since the start of \
         the test; two weighings are understood as well, in columns such as `mass pinion before [g]` and `mass pinion after [g]`",
        cells.join(" and "),
        units.unwrap_or_default()
    ))
}

impl Alone {
    fn of(column: &Column) -> Option<Self> {
        let (name, unit) = units::name_and_unit(&column.written);
        let member = names::member(&name).filter(|member| *member != Subject::Pair)?;
        Some(Self {
            at: column.at,
            member,
            name,
            unit,
        })
    }

    fn is_mass(&self) -> bool {
        let unit = self.unit.as_deref();
        unit.is_some_and(|unit| units::factor(unit, Quantity::MassLoss).is_ok())
    }
}
