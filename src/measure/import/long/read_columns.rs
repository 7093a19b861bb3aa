//! The columns of a long table that are read, what each is in words, and what must not be missing among them.

use super::Result;
use crate::measure::import::columns::half_understood::said;
use crate::measure::import::columns::{Column, What};
use crate::measure::import::entry::Entry;
use crate::measure::import::place::PositionKind;
use crate::measure::import::titles::Titles;
use crate::measure::import::wanted::{UnitFrom, Wanted};
use crate::measure::import::{ImportError, Sheet, cell_name, multiples, units};
use crate::measure::{Place, Quantity, names};
use crate::numeric::written;

/// The columns of a long table that are read.
pub(super) struct Read<'t> {
    pub(super) head: usize,
    pub(super) test: Option<&'t Column>,
    pub(super) member: Option<&'t Column>,
    pub(super) cycles: &'t Column,
    pub(super) quantity: Option<&'t Column>,
    pub(super) position: Option<&'t Column>,
    pub(super) value: &'t Column,
    pub(super) sigma: Option<&'t Column>,
    pub(super) trace: Option<&'t Column>,
    pub(super) face: Option<&'t Column>,
    pub(super) tooth: Option<&'t Column>,
    pub(super) repeat: Option<&'t Column>,
}

impl<'t> Read<'t> {
    pub(super) fn of(columns: &'t [Column], head: usize, wanted: &Wanted<'_>) -> Result<Self> {
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
            repeat: columns.iter().find(|column| column.what == What::Repeat),
        })
    }

    /// Refuses a table of which it is not known of what test, member or place its values are.
    pub(super) fn nothing_missing(
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
    pub(super) fn no_interval_missing(
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
    pub(super) fn in_words(
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
                None if column.what == What::Repeat => {
                    "the number of a repeat, as by --repeat: each has traces of its own".to_owned()
                }
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
pub(super) fn single_quantity(
    read: &Read<'_>,
    what: What,
    wanted: &Wanted<'_>,
) -> Result<Quantity> {
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
