//! Which cell of a wide table is what, and the rows of a measurement file that they give.

use super::numbers::{
    Decimal, header_number, is_for_people, number, number_words, plain_cycles, pointed, rounded,
    with_points, without_thousands,
};
use super::{ImportError, Sheet, cell_name, units};
use crate::gear::{Gear, Member};
use crate::measure::{Place, Quantity, Subject};

/// What the columns of a wide table are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Across {
    /// One column for each checkpoint; the first column holds positions.
    Checkpoints,
    /// One column for each position; the first column holds checkpoints.
    Positions,
}

/// How a place on a flank is told.
///
/// ```text
/// ρ = √(r² − r_b²) = r_b φ      r radius, r_b base radius, ρ roll length, φ roll angle
/// ```
/// ISO 21771, involute of a circle: the roll length is the generatrix from the base circle's tangent point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PositionKind {
    /// Radius, mm.
    Radius,
    /// Diameter, mm.
    Diameter,
    /// Roll angle from the base circle, degrees.
    RollAngle,
    /// Roll length from the base circle, mm.
    RollLength,
    /// Pinion rotation from the pitch point, base pitches: of what stands on no flank.
    Rotation,
}

impl PositionKind {
    /// Its name with its unit.
    pub fn name(self) -> &'static str {
        match self {
            PositionKind::Radius => "radius, mm",
            PositionKind::Diameter => "diameter, mm",
            PositionKind::RollAngle => "roll angle, deg",
            PositionKind::RollLength => "roll length, mm",
            PositionKind::Rotation => "rotation, base pitches",
        }
    }

    /// What a header's words say; a radius if they say nothing else.
    fn of_header(text: &str) -> Self {
        let text = text.to_lowercase();
        let says = |words: &[&str]| words.iter().any(|word| text.contains(word));
        if says(&["angle", "winkel", "[deg]", "(deg)", "[°]", "(°)"]) {
            PositionKind::RollAngle
        } else if says(&["roll", "wälz"]) {
            PositionKind::RollLength
        } else if says(&["diam", "durchmesser", "ø"]) {
            PositionKind::Diameter
        } else {
            PositionKind::Radius
        }
    }

    /// The radius, or the rotation as it is.
    fn position(self, value: f64, gear: Option<&Gear>) -> f64 {
        let base = gear.map_or(0.0, |gear| gear.base_radius);
        match self {
            PositionKind::Radius | PositionKind::Rotation => value,
            PositionKind::Diameter => 0.5 * value,
            PositionKind::RollAngle => base.hypot(base * value.to_radians()),
            PositionKind::RollLength => base.hypot(value),
        }
    }
}

/// What the user states of a table.
#[derive(Debug, Clone)]
pub struct Wanted<'a> {
    /// Id of the test.
    pub test: &'a str,
    /// What was measured on.
    pub member: Subject,
    /// The gear, if it is one.
    pub gear: Option<&'a Gear>,
    /// What was measured.
    pub quantity: Quantity,
    /// How places are told; the header says it otherwise.
    pub position: Option<PositionKind>,
    /// What the columns are; the numbers say it otherwise.
    pub across: Option<Across>,
    /// Unit of the values; what the headers say otherwise, or the quantity's own.
    pub unit: Option<&'a str>,
    /// Whether lost material is negative in the table.
    pub turn_sign: bool,
    /// How decimals are written; the numbers say it otherwise.
    pub decimal: Option<Decimal>,
    /// One standard deviation, in the quantity's unit; left empty where it is not known.
    pub sigma: Option<f64>,
    /// Another, independent one as a share of the value.
    pub relative_sigma: f64,
    /// Whether each checkpoint is a trace with a zero of its own.
    pub traces: bool,
}

/// What was understood of a table, and its rows.
#[derive(Debug, Clone, PartialEq)]
pub struct Mapping {
    /// What the columns are.
    pub across: Across,
    /// How places are told.
    pub position: PositionKind,
    /// Cell of the first header, with its words.
    pub corner: (String, String),
    /// The checkpoints, pinion revolutions.
    pub checkpoints: Vec<f64>,
    /// Least and largest position as the table has them.
    pub from_to: [f64; 2],
    /// Unit of the values in the table, and whether a header states it.
    pub unit: (String, bool),
    /// Cells without a value.
    pub empty: usize,
    /// Rows of a measurement file, without header.
    pub rows: Vec<String>,
}

type Result<T> = std::result::Result<T, ImportError>;

/// The mapping of a wide table.
///
/// # Errors
/// [`ImportError`] where cells are no numbers, or where it cannot be told what is what.
pub fn map(sheet: &Sheet, wanted: &Wanted<'_>) -> Result<Mapping> {
    let mut sheet = with_points(sheet, wanted.decimal)?;
    let head = header(&sheet)?;
    without_thousands(&mut sheet.rows[head]);
    leave_out_what_is_for_people(&mut sheet, head);
    let sheet = &sheet;
    let across: Vec<(usize, f64)> = sheet.rows[head]
        .iter()
        .enumerate()
        .skip(1)
        .filter(|(_, text)| !text.is_empty())
        .map(|(column, text)| Ok((column, header_number(text, head, column)?)))
        .collect::<Result<_>>()?;
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
    let corner = sheet.rows[head][0].clone();
    let position = match (wanted.position, wanted.quantity.place()) {
        (_, Place::Rotation) => PositionKind::Rotation,
        (Some(kind), _) => kind,
        (None, _) => PositionKind::of_header(&corner),
    };
    let angle = position == PositionKind::RollAngle;
    let scale = match position {
        PositionKind::Rotation => 1.0,
        _ => units::of_position(&corner, angle)?,
    };
    let (column_numbers, row_numbers): (Vec<f64>, Vec<f64>) = (
        across.iter().map(|a| a.1).collect(),
        down.iter().map(|d| d.1).collect(),
    );
    let orientation = match wanted.across {
        Some(across) => across,
        None => orientation(&column_numbers, &row_numbers, (position, scale), wanted)?,
    };
    let (places, checkpoints) = match orientation {
        Across::Checkpoints => (&row_numbers, &column_numbers),
        Across::Positions => (&column_numbers, &row_numbers),
    };
    let cell = |row: usize, column: usize| sheet.rows[row].get(column).map_or("", String::as_str);
    match orientation {
        Across::Checkpoints => (across.iter())
            .try_for_each(|&(column, _)| plain_cycles(cell(head, column), head, column))?,
        Across::Positions => {
            (down.iter()).try_for_each(|&(row, _)| plain_cycles(cell(row, 0), row, 0))?
        }
    }
    // beside positions the headers' unit is that of the positions
    let headers = across.iter().map(|&(column, _)| cell(head, column));
    let unit = match orientation {
        Across::Checkpoints => unit(headers, wanted)?,
        Across::Positions => (
            wanted.unit.unwrap_or(wanted.quantity.unit()).to_owned(),
            false,
        ),
    };
    let own = wanted.unit.is_none() && !unit.1;
    let factor = if own {
        1.0
    } else {
        units::factor(&unit.0, wanted.quantity)?
    };
    let factor = if wanted.turn_sign { -factor } else { factor };
    let mut rows = Vec::new();
    let mut empty = 0;
    for &(column, head_number) in &across {
        for &(row, first) in &down {
            let text = sheet.rows[row].get(column).map_or("", String::as_str);
            if text.is_empty() {
                empty += 1;
                continue;
            }
            let value = factor * number(text, row, column)?;
            let (cycles, place) = match orientation {
                Across::Checkpoints => (head_number, first),
                Across::Positions => (first, head_number),
            };
            rows.push((cycles, place, value));
        }
    }
    rows.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let rows = rows
        .iter()
        .map(|&(cycles, place, value)| {
            let trace = if wanted.traces {
                let what = match wanted.quantity {
                    Quantity::WearDepth => String::new(),
                    other => format!("{}-", other.name()),
                };
                format!("{}-{}-{what}{cycles}", wanted.test, wanted.member.name())
            } else {
                String::new()
            };
            let sigma = match (wanted.sigma, wanted.relative_sigma) {
                (None, _) => String::new(),
                (Some(sigma), 0.0) => sigma.to_string(),
                (Some(sigma), share) => rounded(sigma.hypot(share * value)).to_string(),
            };
            format!(
                "{},{},{cycles},{},{},{},{},{}",
                quoted(wanted.test),
                wanted.member.name(),
                wanted.quantity.name(),
                rounded(position.position(scale * place, wanted.gear)),
                rounded(value),
                sigma,
                quoted(&trace)
            )
        })
        .collect();
    let least = places.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = places.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let mut checkpoints = checkpoints.clone();
    checkpoints.sort_by(f64::total_cmp);
    Ok(Mapping {
        across: orientation,
        position,
        corner: (cell_name(head, 0), corner),
        checkpoints,
        from_to: [least, largest],
        unit,
        empty,
        rows,
    })
}

/// The unit of the values: as stated, as headers say, or the quantity's own; and whether a header says it.
fn unit<'h>(headers: impl Iterator<Item = &'h str>, wanted: &Wanted<'_>) -> Result<(String, bool)> {
    let mut said: Vec<&str> = headers
        .filter_map(|header| units::of_values(header, wanted.quantity))
        .collect();
    said.dedup();
    match (said[..].first(), wanted.unit) {
        (_, _) if said.len() > 1 => Err(ImportError(format!(
            "the headers state several units: {}",
            said.join(", ")
        ))),
        (Some(said), Some(stated))
            if units::factor(said, wanted.quantity) != units::factor(stated, wanted.quantity) =>
        {
            Err(ImportError(format!(
                "the headers say {said}, --unit says {stated}"
            )))
        }
        (Some(said), None) => Ok(((*said).to_owned(), true)),
        (_, Some(stated)) => Ok((stated.to_owned(), false)),
        (None, None) => Ok((wanted.quantity.unit().to_owned(), false)),
    }
}

/// Empties the columns whose header says that they are for people.
fn leave_out_what_is_for_people(sheet: &mut Sheet, head: usize) {
    for column in 1..sheet.rows[head].len() {
        if is_for_people(&sheet.rows[head][column]) {
            let cells = sheet.rows[head..].iter_mut();
            for cell in cells.filter_map(|row| row.get_mut(column)) {
                cell.clear();
            }
        }
    }
}

/// The first row with something in the first column and a number in the header of another: titles stand above it.
fn header(sheet: &Sheet) -> Result<usize> {
    let numbers = |row: &[String]| {
        let cells = row.iter().skip(1);
        let cells = cells.filter(|text| !text.is_empty() && !is_for_people(text));
        let (all, good) = cells.fold((0, 0), |(all, good), text| {
            (all + 1, good + usize::from(!number_words(text).is_empty()))
        });
        all > 0 && all == good
    };
    let is_header = |row: &[String]| {
        let first = row.first().map_or("", String::as_str);
        pointed(first).parse::<f64>().is_err() && numbers(row)
    };
    sheet.rows.iter().position(|row| is_header(row)).ok_or_else(|| {
        ImportError(
            "no header row: the first cell names what stands below it (such as `radius [mm]`), the others begin with a number each \
             (cycles, or a radius)"
                .to_owned(),
        )
    })
}

/// What the columns are, by where the numbers can stand on the flank.
fn orientation(
    columns: &[f64],
    rows: &[f64],
    (position, scale): (PositionKind, f64),
    wanted: &Wanted<'_>,
) -> Result<Across> {
    let on_flank = |numbers: &[f64]| match wanted.gear {
        Some(gear) => numbers.iter().all(|&n| {
            let radius = position.position(scale * n, Some(gear));
            (gear.form_radius - 0.01..=gear.tip_radius + 0.01).contains(&radius)
        }),
        None => numbers.iter().all(|n| (0.0..=1.0).contains(n)),
    };
    let what = match wanted.gear {
        Some(gear) => format!(
            "radii of the flank ({:.3} to {:.3} mm), given as {}",
            gear.form_radius,
            gear.tip_radius,
            position.name()
        ),
        None => "rotations (0 to 1 base pitch)".to_owned(),
    };
    match (on_flank(rows), on_flank(columns)) {
        (true, false) => Ok(Across::Checkpoints),
        (false, true) => Ok(Across::Positions),
        (true, true) => Err(ImportError(format!(
            "both the first column and the header could be {what}: say --columns checkpoints or --columns positions"
        ))),
        (false, false) => Err(ImportError(format!(
            "neither the first column ({} to {}) nor the header ({} to {}) are {what}: look at --member and --position",
            rows.iter().copied().fold(f64::INFINITY, f64::min),
            rows.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            columns.iter().copied().fold(f64::INFINITY, f64::min),
            columns.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        ))),
    }
}

pub(super) fn quoted(text: &str) -> String {
    if text.contains([',', '"']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

impl Wanted<'_> {
    /// The gear of a member in a pair, pinion first.
    pub fn gear_of(member: Subject, gears: [&Gear; 2]) -> Option<&Gear> {
        let [pinion, gear] = gears;
        member.member().map(|member| match member {
            Member::Pinion => pinion,
            Member::Gear => gear,
        })
    }
}
