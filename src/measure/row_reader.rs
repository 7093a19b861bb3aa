//! One row as a checked observation.

use std::collections::HashMap;

use super::Trace;
use super::cell::{Cell, Row};
use super::header::Columns;
use super::known::{Known, KnownTest};
use super::observation::{FacePlace, Observation};
use super::quantity::{Place, Quantity, Subject};
use crate::gear::Member;
use crate::numeric::written;
use crate::source_text::{Diagnostic, Fault, list};

/// The word of [`FacePlace::Mean`] in measurement files.
const MEAN: &str = "mean";

/// A limit as messages give it.
fn three_digits(limit: f64) -> f64 {
    format!("{limit:.2e}").parse().unwrap_or(limit)
}

type Result<T> = std::result::Result<T, Box<Diagnostic>>;

/// Turns rows into observations and collects their traces.
pub(super) struct Reader<'k> {
    columns: &'k Columns,
    known: &'k Known,
    traces: Vec<Trace>,
    numbers: HashMap<String, usize>,
}

impl<'k> Reader<'k> {
    /// For a file with these columns, about a study's tests and gears.
    pub(super) fn new(columns: &'k Columns, known: &'k Known) -> Self {
        Self {
            columns,
            known,
            traces: Vec::new(),
            numbers: HashMap::new(),
        }
    }

    /// The traces met so far.
    pub(super) fn into_traces(self) -> Vec<Trace> {
        self.traces
    }

    /// A row's observation.
    pub(super) fn observation(&mut self, row: &Row<'_>) -> Result<Observation> {
        self.even(row)?;
        let cell = |key: &'static str| row.cell(key, self.columns.of(key));
        let (test, conditions) = self.test(cell("test"))?;
        let member = cell("member").choice("member", &Subject::ALL, Subject::name)?;
        let quantity = cell("quantity").choice("quantity", &Quantity::ALL, Quantity::name)?;
        measurable(cell("member"), member, quantity)?;
        let cycles = cycles(cell("cycles"), conditions)?;
        let position = match quantity.place() {
            Place::Flank => {
                let member = member.member().expect("flank quantities are a member's");
                Some(self.radius(cell("position"), member)?)
            }
            Place::Rotation => Some(rotation(cell("position"))?),
            Place::Span => {
                let member = member.member().expect("a span is a member's");
                Some(self.teeth(cell("position"), member)?)
            }
            Place::Whole => no_position(cell("position"), quantity)?,
        };
        self.stated_units(row, quantity)?;
        let value = self.value(cell("value"), quantity)?;
        let sigma = sigma(cell("sigma"), quantity)?;
        let face = self.face(cell("face"))?;
        let tooth = Some(cell("tooth").text().to_owned()).filter(|label| !label.is_empty());
        let trace = self.trace(
            row.cell("trace", self.columns.of("trace")),
            quantity,
            row.line,
        )?;
        Ok(Observation {
            test,
            member,
            cycles,
            quantity,
            position,
            value,
            sigma,
            trace,
            face,
            tooth,
            line: row.line,
        })
    }

    /// As many fields as the header.
    fn even(&self, row: &Row<'_>) -> Result<()> {
        let (found, wanted) = (row.len(), self.columns.count);
        let lines = row.text[row.span.clone()].split('\n').count();
        if lines > 1 {
            return Err(Box::new(
                row.fault(
                    Fault::Syntax,
                    format!("a quoted text goes on over {lines} lines"),
                )
                .with_values("a line break in quotes", "a row on each line")
                .with_hint("a quotation mark that is never closed swallows the lines after it"),
            ));
        }
        if (wanted - self.columns.nameless..=wanted).contains(&found) {
            return self.nothing_nameless(row);
        }
        let hint = if found > wanted {
            "decimals are written with a point, texts with commas in quotes"
        } else {
            "empty fields at the end need their commas too"
        };
        Err(Box::new(
            row.fault(
                Fault::Syntax,
                format!("the row has {found} fields, the header {wanted}"),
            )
            .with_values(format!("{found} fields"), format!("{wanted} fields"))
            .with_hint(hint),
        ))
    }

    /// Nothing below a header without a name.
    fn nothing_nameless(&self, row: &Row<'_>) -> Result<()> {
        let named = self.columns.count - self.columns.nameless;
        let written = |column: &usize| !row.record.get(*column).unwrap_or_default().is_empty();
        let Some(column) = (named..row.len()).find(written) else {
            return Ok(());
        };
        let cell = row.cell("", Some(column));
        Err(cell
            .fault(
                Fault::Inconsistent,
                "this stands in a column without a name",
                "nothing",
            )
            .with_hint("name the column in the header: `comment` if it is for people only")
            .into())
    }

    /// The units that the header states are those of the row's numbers.
    fn stated_units(&self, row: &Row<'_>, quantity: Quantity) -> Result<()> {
        let of_position: &[&str] = match quantity.place() {
            Place::Flank => &["mm"],
            Place::Rotation => &["base pitches", "pitches", "1", "-"],
            Place::Span => &["teeth", "1", "-"],
            Place::Whole => &[],
        };
        let of_value = [quantity.unit(), quantity.plain_unit()];
        let counts = [
            "pinion revolutions",
            "revolutions",
            "rev",
            "cycles",
            "1",
            "-",
        ];
        for (column, allowed) in [
            ("position", of_position),
            ("value", &of_value),
            ("sigma", &of_value),
            ("cycles", &counts),
            ("face", &["mm"]),
        ] {
            self.stated_unit(row, quantity, column, allowed)?;
        }
        Ok(())
    }

    /// Without `allowed` any unit will do.
    fn stated_unit(
        &self,
        row: &Row<'_>,
        quantity: Quantity,
        column: &'static str,
        allowed: &[&str],
    ) -> Result<()> {
        match self.columns.unit_of(column) {
            Some(unit) if differs(unit, allowed) => {
                let name = quantity.name();
                let message = format!(
                    "the header says {column} in {}; rows of {name} have another unit",
                    written::unit(unit)
                );
                let cell = row.cell(column, self.columns.of(column));
                Err(cell
                    .fault(
                        Fault::Inconsistent,
                        message,
                        &format!("{column} of {name} in {}", written::unit(allowed[0])),
                    )
                    .with_hint(
                        "convert the numbers (`gearwear import` does it), or take the unit out of the header if rows of several quantities stand below it",
                    )
                    .into())
            }
            _ => Ok(()),
        }
    }

    fn test(&self, cell: Cell<'_, '_>) -> Result<(usize, &'k KnownTest)> {
        let tests = &self.known.tests;
        if let Some(at) = tests.iter().position(|test| test.id == cell.text()) {
            return Ok((at, &tests[at]));
        }
        let ids = || tests.iter().map(|test| test.id.as_str());
        let allowed = if tests.is_empty() {
            "none: the study has no [[test]]".to_owned()
        } else {
            format!("the id of a [[test]]: {}", list(ids()))
        };
        let message = "the study has no such test";
        let fault = cell.fault(Fault::BadValue, message, &allowed);
        let named = cell.text();
        let hint = match cell.nearest_of(ids()) {
            _ if named.is_empty() => String::new(),
            near if near.is_empty() => format!("add a [[test]] with id = \"{named}\" to the study"),
            near => format!(
                "{near}; if it is another test, add a [[test]] with id = \"{named}\" to the study"
            ),
        };
        Err(fault.with_hint(hint).into())
    }

    fn radius(&self, cell: Cell<'_, '_>, member: Member) -> Result<f64> {
        let [form, tip] = self.known.flank_of(member);
        let allowed = format!("a radius on the {member}'s flank, {form:.3} to {tip:.3} mm");
        let radius = cell.number(&allowed)?;
        if self.known.on_flank(member, radius) {
            return Ok(radius);
        }
        let message = format!("the radius is off the {member}'s flank");
        let fault = cell.fault(Fault::BadValue, message, &allowed);
        let other = member.other();
        let on_flank = |member, radius| self.known.on_flank(member, radius);
        let hints = [
            (
                on_flank(other, radius),
                format!("this radius lies on the {other}'s flank"),
            ),
            (
                on_flank(member, 0.5 * radius),
                "this looks like a diameter".to_owned(),
            ),
            (
                on_flank(member, 1e3 * radius),
                "this looks like metres".to_owned(),
            ),
            (
                (form - (tip - form)..=tip + (tip - form)).contains(&radius),
                format!(
                    "both ends of the flank follow from gears.{member}.profile_shift of the study, beside module, teeth and addendum: look whether it \
                     has the right sign, is that of this member and in modules; points of a trace beyond the flank are left out by gearwear import"
                ),
            ),
        ];
        let hints = hints.into_iter().filter(|(likely, _)| *likely);
        Err(hints
            .fold(fault, |fault, (_, hint)| fault.with_hint(hint))
            .into())
    }

    /// The number of teeth that a span goes over.
    fn teeth(&self, cell: Cell<'_, '_>, member: Member) -> Result<f64> {
        let known = self.known.spanned_by(member);
        let allowed = format!(
            "number of teeth over which the anvils touch the {member}'s flanks: {}",
            known
                .iter()
                .map(u32::to_string)
                .collect::<Vec<_>>()
                .join(", ")
        );
        let teeth = cell.number(&allowed)?;
        if known.iter().any(|&known| f64::from(known) == teeth) {
            return Ok(teeth);
        }
        let message = "no span of the new gear is measured over so many teeth";
        Err(cell.fault(Fault::BadValue, message, &allowed).into())
    }

    fn value(&self, cell: Cell<'_, '_>, quantity: Quantity) -> Result<f64> {
        let unit = quantity.shown_unit();
        let value = cell.number(&format!("a number, {unit}"))?;
        let limits = quantity.magnitude(self.known.depth_limit_um());
        if value.abs() <= limits.above {
            return Ok(value);
        }
        let (name, larger) = (quantity.name(), limits.larger);
        let (in_unit, of_unit) = match unit.as_str() {
            "1" => ("parts of 1".to_owned(), String::new()),
            unit => (unit.to_owned(), format!(" {unit}")),
        };
        let fault = cell.fault(
            Fault::BadValue,
            format!("this {name} is not possible in {in_unit}"),
            &format!("at most {}{of_unit}", three_digits(limits.above)),
        );
        Err(fault.with_hint(format!("this looks like {larger}")).into())
    }

    fn face(&self, cell: Cell<'_, '_>) -> Result<Option<FacePlace>> {
        if cell.is_empty() {
            return Ok(None);
        }
        if cell.text() == MEAN {
            return Ok(Some(FacePlace::Mean));
        }
        let half = 0.5 * self.known.face_width;
        let allowed = format!("mm from mid-face, {} to {half}, or `{MEAN}`", -half);
        let face = cell.number(&allowed)?;
        if face.abs() > half {
            return Err(cell
                .fault(Fault::BadValue, "face is off the face width", &allowed)
                .into());
        }
        Ok(Some(FacePlace::At(face)))
    }

    fn trace(
        &mut self,
        cell: Cell<'_, '_>,
        quantity: Quantity,
        line: usize,
    ) -> Result<Option<usize>> {
        if cell.is_empty() {
            return Ok(None);
        }
        if let Some(&number) = self.numbers.get(cell.text()) {
            let trace = &self.traces[number];
            if trace.quantity == quantity {
                return Ok(Some(number));
            }
            let (first, name) = (trace.line, trace.quantity.name());
            return Err(cell
                .fault(
                    Fault::Inconsistent,
                    format!("a trace of {name} (from line {first}) goes on with another quantity"),
                    "one quantity in a trace: its points share one datum",
                )
                .into());
        }
        self.traces.push(Trace {
            name: cell.text().to_owned(),
            quantity,
            line,
        });
        let number = self.numbers.len();
        self.numbers.insert(cell.text().to_owned(), number);
        Ok(Some(number))
    }
}

fn differs(unit: &str, allowed: &[&str]) -> bool {
    !allowed.is_empty() && !allowed.iter().any(|known| known.eq_ignore_ascii_case(unit))
}

fn measurable(cell: Cell<'_, '_>, member: Subject, quantity: Quantity) -> Result<()> {
    let subjects = quantity.subjects();
    if subjects.contains(&member) {
        return Ok(());
    }
    let name = quantity.name();
    Err(cell
        .fault(
            Fault::Inconsistent,
            format!("{name} is no quantity of the {}", member.name()),
            &list(subjects.iter().map(|s| s.name())),
        )
        .into())
}

fn cycles(cell: Cell<'_, '_>, test: &KnownTest) -> Result<f64> {
    let KnownTest { id, cycles: end } = test;
    let allowed = format!("pinion revolutions, 0 to {end}");
    let cycles = cell.number(&allowed)?;
    if cycles < 0.0 {
        return Err(cell
            .fault(Fault::BadValue, "cycles are negative", &allowed)
            .into());
    }
    if cycles > end * (1.0 + 1e-9) {
        let message = format!("the test {id} ends before these cycles");
        return Err(cell.fault(Fault::BadValue, message, &allowed).into());
    }
    Ok(cycles)
}

fn rotation(cell: Cell<'_, '_>) -> Result<f64> {
    let allowed = "pinion rotation from the pitch point in base pitches, 0 to 1";
    let rotation = cell.number(allowed)?;
    if !(0.0..=1.0).contains(&rotation) {
        return Err(cell
            .fault(
                Fault::BadValue,
                "the rotation is outside the base pitch",
                allowed,
            )
            .into());
    }
    Ok(rotation)
}

fn no_position(cell: Cell<'_, '_>, quantity: Quantity) -> Result<Option<f64>> {
    if cell.is_empty() {
        return Ok(None);
    }
    let name = quantity.name();
    Err(cell
        .fault(
            Fault::Inconsistent,
            format!("{name} is the whole member's and has no position"),
            "nothing",
        )
        .into())
}

/// Least standard deviation that is believed, in the unit of any quantity.
pub(super) const LEAST_SIGMA: f64 = 1e-9;

/// Not a number where the row states none.
fn sigma(cell: Cell<'_, '_>, quantity: Quantity) -> Result<f64> {
    if cell.is_empty() {
        return Ok(f64::NAN);
    }
    let allowed = format!(
        "one standard deviation, at least {LEAST_SIGMA:e}, {}",
        quantity.shown_unit()
    );
    let sigma = cell.number(&allowed)?;
    if sigma < LEAST_SIGMA {
        let reason = if sigma > 0.0 {
            "sigma is below what any instrument resolves"
        } else {
            "sigma is not above 0"
        };
        return Err(cell.fault(Fault::BadValue, reason, &allowed).into());
    }
    Ok(sigma)
}
