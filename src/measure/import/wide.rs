//! Which cell of a wide table is what, and the rows of a measurement file that they give.

use super::{ImportError, Sheet, cell_name};
use crate::gear::{Gear, Member};
use crate::measure::dialect::in_thousands;
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
    /// Factor from the table's unit to the quantity's, with a sign.
    pub factor: f64,
    /// One standard deviation, in the quantity's unit.
    pub sigma: f64,
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
    let head = header(sheet)?;
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
                "{}: nothing stands here beside values; the first column tells where or when each row was measured",
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
    let (column_numbers, row_numbers): (Vec<f64>, Vec<f64>) = (
        across.iter().map(|a| a.1).collect(),
        down.iter().map(|d| d.1).collect(),
    );
    let orientation = match wanted.across {
        Some(across) => across,
        None => orientation(&column_numbers, &row_numbers, position, wanted)?,
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
    let mut rows = Vec::new();
    let mut empty = 0;
    for &(column, head_number) in &across {
        for &(row, first) in &down {
            let text = sheet.rows[row].get(column).map_or("", String::as_str);
            if text.is_empty() {
                empty += 1;
                continue;
            }
            let value = wanted.factor * number(text, row, column)?;
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
            format!(
                "{},{},{cycles},{},{},{},{},{}",
                quoted(wanted.test),
                wanted.member.name(),
                wanted.quantity.name(),
                rounded(position.position(place, wanted.gear)),
                rounded(value),
                wanted.sigma,
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
        empty,
        rows,
    })
}

/// The first row with something in the first column and a number in the header of another: titles stand above it.
fn header(sheet: &Sheet) -> Result<usize> {
    let numbers = |row: &[String]| {
        let cells = row.iter().skip(1).filter(|text| !text.is_empty());
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
    position: PositionKind,
    wanted: &Wanted<'_>,
) -> Result<Across> {
    let on_flank = |numbers: &[f64]| match wanted.gear {
        Some(gear) => numbers.iter().all(|&n| {
            let radius = position.position(n, Some(gear));
            (gear.form_radius - 0.01..=gear.tip_radius + 0.01).contains(&radius)
        }),
        None => numbers.iter().all(|n| (0.0..=1.0).contains(n)),
    };
    let what = match wanted.gear {
        Some(gear) => format!(
            "radii of the flank ({:.3} to {:.3} mm), told as {}",
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

/// The one number of a header such as `250000 cycles` or `r = 26,5 mm`.
fn header_number(text: &str, row: usize, column: usize) -> Result<f64> {
    let refuse = |why: &str| {
        let cell = cell_name(row, column);
        Err(ImportError(format!("{cell}: {why} in the header `{text}`")))
    };
    let words = number_words(text);
    let [one] = words[..] else {
        return refuse(if words.is_empty() {
            "no number"
        } else {
            "several numbers (write one, without marks between thousands)"
        });
    };
    let at = text.find(one).unwrap_or_default();
    let letter = |c: Option<char>| c.is_some_and(char::is_alphabetic);
    let (before, after) = (&text[..at], &text[at + one.len()..]);
    if letter(before.chars().next_back()) || letter(after.chars().next()) || scaled(after) {
        return refuse(
            "a number with a letter, a multiple or a time (write plain pinion revolutions or places)",
        );
    }
    match pointed(one).parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => refuse("no plain number (marks between thousands are left out)"),
    }
}

/// Whether what follows a number makes another one of it: `Mio`, `thousand`, `h`.
fn scaled(after: &str) -> bool {
    const WORDS: [&str; 14] = [
        "k", "m", "mio", "million", "millions", "thousand", "tsd", "h", "hour", "hours", "std",
        "min", "s", "days",
    ];
    let mut words = after.split(|c: char| !c.is_alphabetic());
    let first = words.find(|word| !word.is_empty()).unwrap_or_default();
    WORDS.contains(&first.to_lowercase().as_str())
}

/// Refuses a count of cycles that may be marked between its thousands: `250.000` is 250 or a quarter of a million.
fn plain_cycles(text: &str, row: usize, column: usize) -> Result<()> {
    match number_words(text)
        .into_iter()
        .find(|word| in_thousands(word))
    {
        None => Ok(()),
        Some(word) => Err(ImportError(format!(
            "{}: are the cycles `{word}` marked between thousands? Write them without marks",
            cell_name(row, column)
        ))),
    }
}

/// The words of a text that hold digits.
fn number_words(text: &str) -> Vec<&str> {
    let part = |c: char| c.is_ascii_digit() || "+-.,eE".contains(c);
    text.split(|c: char| !part(c))
        .map(|word| word.trim_matches(['e', 'E', '.', ',']))
        .filter(|word| word.contains(|c: char| c.is_ascii_digit()))
        .collect()
}

fn number(text: &str, row: usize, column: usize) -> Result<f64> {
    let found = pointed(text).parse::<f64>().ok().filter(|v| v.is_finite());
    found.ok_or_else(|| {
        ImportError(format!(
            "{}: `{text}` is not a number",
            cell_name(row, column)
        ))
    })
}

/// With a point for a decimal comma.
fn pointed(text: &str) -> String {
    if text.matches(',').count() == 1 && !text.contains('.') {
        text.replace(',', ".")
    } else {
        text.to_owned()
    }
}

/// Nine digits: conversions leave no trail of rounding.
fn rounded(value: f64) -> f64 {
    format!("{value:.8e}").parse().unwrap_or(value)
}

/// A sheet in the columns of a measurement file, as its text; none if it has other columns.
pub fn as_measurements(sheet: &Sheet) -> Option<String> {
    let is_header = |row: &&Vec<String>| {
        let has = |name: &str| row.iter().any(|cell| cell.to_lowercase() == name);
        ["test", "member", "quantity"].into_iter().all(has)
    };
    let head = sheet.rows.iter().position(|row| is_header(&row))?;
    let columns = sheet.rows[head].len();
    let rows = sheet.rows[head..]
        .iter()
        .filter(|row| !row.iter().all(String::is_empty));
    let line = |row: &Vec<String>| {
        let cells = (0..columns).map(|i| quoted(row.get(i).map_or("", String::as_str)));
        cells.collect::<Vec<_>>().join(",") + "\n"
    };
    Some(rows.map(line).collect())
}

fn quoted(text: &str) -> String {
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
