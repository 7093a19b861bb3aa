//! The header of a long table: which column is what.

pub(super) mod half_understood;

use super::arrange::side;
use super::coverage::{coverage, without_level};
use super::multiples;
use super::wanted::Wanted;
use super::{Sheet, cell_name, cell_sigmas, units};
use crate::measure::names::When;
use crate::measure::{Quantity, Subject, names};

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
    /// The speed of rotation in revolutions per minute, of the member that the name says.
    Speed {
        /// Of which it is; none if the name does not say.
        of: Option<Subject>,
    },
    /// A torque, of the member that the name says.
    Torque {
        /// Of which it is; none if the name does not say.
        of: Option<Subject>,
    },
    /// The flank of the tooth.
    Flank,
    /// The number of a repeated measurement, by what stands in it.
    Repeat,
    /// An expanded uncertainty of which nothing says how many standard deviations it is.
    Expanded,
    /// Several standard deviations or an interval, which are not read as they stand: what they are and how they would be.
    NotOneSigma(&'static str),
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
        let plain = plain
            .or_else(|| multiples::in_brackets(written))
            .unwrap_or_else(|| written.to_owned());
        let without_level = without_level(&plain).filter(|rest| {
            let (name, _) = units::name_and_unit(rest);
            is_uncertainty(&name)
        });
        let at_a_level = without_level.is_some();
        let (name, unit) = units::name_and_unit(&without_level.unwrap_or(plain));
        let speed = names::speed(&name, unit.as_deref());
        let revolutions = match speed {
            Some(_) => None,
            None => names::revolutions(&name),
        };
        let hours = names::hours(&name, unit.as_deref());
        let what = if written.is_empty() {
            What::Nameless
        } else if names::is_for_people(&name) {
            What::ForPeople
        } else if cell_sigmas::is_sign(&name) || is_letter_of_sigma(&name, unit.as_deref()) {
            What::Own("sigma")
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
        } else if let Some(of) = speed {
            What::Speed { of }
        } else if let Some(of) = names::torque(&name, unit.as_deref()) {
            What::Torque { of }
        } else if names::is_flank(&name) {
            What::Flank
        } else if at_a_level || names::is_expanded_uncertainty(&name) {
            coverage.map_or(What::Expanded, |_| What::Own("sigma"))
        } else if let Some(what) = several_sigmas(&name, written) {
            what
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

    /// N m of a unit of it, if it is a torque.
    pub(super) fn newton_metres(&self) -> f64 {
        let unit = self.unit.as_deref();
        unit.and_then(names::newton_metres).unwrap_or(1.0)
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

/// Whether a name is the letter of one standard deviation: `σ`, and `s` in a unit that no length of the flank or time is written in. A capital one is a sum.
fn is_letter_of_sigma(name: &str, unit: Option<&str>) -> bool {
    let of_values = |unit: &str| ["um", "mg", "g"].iter().any(|of| units::are_same(of, unit));
    name.trim() == "\u{3c3}" || name.trim() == "s" && unit.is_some_and(of_values)
}

/// What a name means that says how many standard deviations it is (`2 sigma`), or that it is a confidence interval (`95% CI`); none for others.
fn several_sigmas(name: &str, written: &str) -> Option<What> {
    Some(match names::sigmas(name) {
        Some(1) => What::Own("sigma"),
        Some(2) => What::NotOneSigma("two standard deviations: call it `U (k=2)` and it is read"),
        Some(3) => What::NotOneSigma("three standard deviations: call it `U (k=3)` and it is read"),
        Some(_) => What::NotOneSigma(
            "several standard deviations: call it `U (k=2)`, with their number in place of the 2, and it is read",
        ),
        None if names::is_confidence_interval(written) => What::NotOneSigma(
            "a confidence interval: if it is the half width for 95 %, call it `U (k=2)` and it is read; halve a whole one before",
        ),
        None => return None,
    })
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
    let holds =
        |column: &Column, is_it: &dyn Fn(&str) -> bool| holds_only(sheet, head, column.at, is_it);
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

/// Whether a column has something below its header in row `head`, and all of it passes.
pub(super) fn holds_only(
    sheet: &Sheet,
    head: usize,
    at: usize,
    is_it: impl Fn(&str) -> bool,
) -> bool {
    let below = sheet.rows[head + 1..].iter();
    let mut cells = below
        .filter_map(|row| row.get(at))
        .filter(|cell| !cell.is_empty())
        .peekable();
    cells.peek().is_some() && cells.all(|cell| is_it(cell))
}

fn has(columns: &[Column], name: &str) -> bool {
    columns.iter().any(|column| column.is(name))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn several_standard_deviations_are_told_from_one() {
        let says = |written: &str| match Column::of(0, written).what {
            What::NotOneSigma(says) => says,
            What::Own(own) => own,
            _ => "",
        };
        for (written, begins) in [
            ("2 sigma [um]", "two"),
            ("2s", "two"),
            ("2\u{3c3} [\u{b5}m]", "two"),
            ("\u{b1}3 sigma", "three"),
            ("4 SD", "several"),
            ("1 sigma [um]", "sigma"),
            ("95% CI", "a confidence interval"),
            ("CI95 [um]", "a confidence interval"),
            ("95 % Vertrauensbereich", "a confidence interval"),
            ("confidence interval (95 %)", "a confidence interval"),
            ("95% CI lower", ""),
            ("2 mm", ""),
            ("12", ""),
        ] {
            let says = says(written);
            assert!(
                says.starts_with(begins) && says.is_empty() == begins.is_empty(),
                "{written}: {says}"
            );
        }
    }

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
        for sigma in ["\u{3c3}", "\u{3c3} [\u{b5}m]", "s [\u{b5}m]", "s (mg)"] {
            assert_eq!(Column::of(0, sigma).what, What::Own("sigma"), "{sigma}");
        }
        for other in ["\u{3a3}", "s", "s [mm]", "s [h]"] {
            assert_ne!(Column::of(0, other).what, What::Own("sigma"), "{other}");
        }
        assert!(Column::of(0, "Umdrehungen Rad").of_gear);
        assert!(!Column::of(0, "revolutions of the pinion").of_gear);
    }
}
