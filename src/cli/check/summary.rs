//! What `check` says: what was read, what it holds, what looks wrong, what it can show.

use super::{Key, curves};
use crate::learn::Prospects;
use crate::measure::{Dataset, Observation, Quantity, checkpoints};
use crate::numeric::written::{count, plain, significant};
use crate::study::{Role, Study, Test};

/// What was found in the measurements.
pub(super) struct Found<'a> {
    /// What is to be looked at before anything else.
    pub(super) sanity: &'a [String],
    pub(super) warnings: &'a [String],
    pub(super) looks_right: bool,
    /// What a comparison could conclude.
    pub(super) prospects: &'a Prospects,
}

/// All of it; `end` comes last.
pub(super) fn summary(study: &Study, data: &Dataset, found: &Found<'_>, end: &str) -> String {
    let mut lines = Vec::new();
    if !study.title.is_empty() {
        lines.push(study.title.clone());
    }
    lines.push(gears(study));
    lines.push(file(data));
    lines.push(String::new());
    lines.extend(aligned(&table(study, data)));
    lines.push(String::new());
    for (number, test) in study.tests.iter().enumerate() {
        let is_bare = data.observations.iter().all(|o| o.test != number);
        lines.push(operation(study, test, is_bare));
    }
    lines.push(String::new());
    lines.extend(findings(data, found));
    lines.push(String::new());
    lines.join("\n") + end
}

fn gears(study: &Study) -> String {
    let gears = [&study.gears.pinion, &study.gears.gear];
    let flanks = gears.map(|g| format!("{:.3} to {:.3} mm", g.form_radius, g.tip_radius));
    let helix = gears[0].helix_angle;
    let normal = plain(gears[0].rack.normal(helix).module);
    let module = if helix == 0.0 {
        format!("module {normal} mm")
    } else {
        format!(
            "normal module {normal} mm, helix angle {}°",
            plain(helix.to_degrees())
        )
    };
    format!(
        "gears:   {} and {} teeth, {module}; flanks {} and {}",
        gears[0].spec.teeth, gears[1].spec.teeth, flanks[0], flanks[1]
    )
}

fn file(data: &Dataset) -> String {
    format!(
        "file:    {}, {} values{}",
        data.name,
        data.observations.len(),
        if data.reading.is_empty() {
            String::new()
        } else {
            format!(" ({})", data.reading)
        }
    )
}

/// A row for each test, member and quantity, below a header.
fn table(study: &Study, data: &Dataset) -> Vec<[String; 10]> {
    let header = [
        "test", "member", "quantity", "values", "times", "places", "from", "to", "sigma", "traces",
    ];
    let curves = curves(study, data).into_iter();
    std::iter::once(header.map(str::to_owned))
        .chain(curves.map(|(key, own)| row(study, key, &own)))
        .collect()
}

/// The row of the values that are `own` to a test, member and quantity.
fn row(study: &Study, (test, member, quantity): Key, own: &[&Observation]) -> [String; 10] {
    let distinct = |mut bits: Vec<u64>| {
        bits.sort_unstable();
        bits.dedup();
        bits.len().to_string()
    };
    let values = || own.iter().map(|o| o.value);
    let positions = own.iter().filter_map(|o| o.position);
    let traces = own.iter().filter_map(|o| o.trace);
    let sigma = own.iter().map(|o| o.sigma).sum::<f64>() / own.len() as f64;
    [
        study.tests[test].id.clone(),
        member.to_owned(),
        quantity.to_owned(),
        own.len().to_string(),
        checkpoints(own.iter().copied()).to_string(),
        distinct(positions.map(f64::to_bits).collect()),
        significant(values().fold(f64::INFINITY, f64::min), 3),
        significant(values().fold(f64::NEG_INFINITY, f64::max), 3),
        format!("{} {}", significant(sigma, 2), own[0].quantity.shown_unit()),
        distinct(traces.map(|t| t as u64).collect()),
    ]
}

/// The rows as lines: names to the left, figures to the right.
fn aligned(rows: &[[String; 10]]) -> Vec<String> {
    let width = |c: usize| {
        let widths = rows.iter().map(|row| row[c].chars().count());
        widths.max().unwrap_or(0)
    };
    let widths: [usize; 10] = std::array::from_fn(width);
    let line = |row: &[String; 10]| {
        let cells = row.iter().zip(&widths).enumerate();
        let padded: Vec<String> = cells
            .map(|(c, (cell, w))| {
                if c < 3 {
                    format!("{cell:<w$}")
                } else {
                    format!("{cell:>w$}")
                }
            })
            .collect();
        format!("  {}", padded.join("  ")).trim_end().to_owned()
    };
    rows.iter().map(line).collect()
}

/// How a test was run; `is_bare`: without a measurement.
fn operation(study: &Study, test: &Test, is_bare: bool) -> String {
    let held = if test.role == Role::Holdout {
        ", held out"
    } else {
        ""
    };
    let misaligned = match test.conditions.misalignment_mm {
        0.0 => String::new(),
        mm => format!(", misalignment {} mm", plain(mm)),
    };
    let tenths = |celsius: f64| plain(0.1 * (10.0 * celsius).round());
    let warm = match study.surroundings(&test.conditions).warmed_teeth_c() {
        Some([flank, root]) => format!(
            ", teeth at {} °C (flank) and {} °C (root) by VDI 2736",
            tenths(flank),
            tenths(root)
        ),
        None => (test.conditions.bulk_temperature_c)
            .filter(|_| study.temperatures_differ())
            .map_or(String::new(), |celsius| format!(", {} °C", tenths(celsius))),
    };
    format!(
        "test {}: {} N·m, {} rpm{warm}{misaligned}, {} cycles{held}{}",
        test.id,
        plain(1e-3 * test.conditions.torque_nmm),
        plain(test.conditions.speed_rpm),
        count(test.conditions.cycles),
        if is_bare { "; no measurement" } else { "" }
    )
}

/// What looks right or wrong, and what the measurements can show.
fn findings(data: &Dataset, found: &Found<'_>) -> Vec<String> {
    let right = found.looks_right.then(|| right(data));
    let prospects = found.prospects;
    let named = |name: &'static str, all: &[String]| -> Vec<String> {
        all.iter().map(|words| format!("{name}{words}")).collect()
    };
    right
        .into_iter()
        .chain(named("check first: ", found.sanity))
        .chain(named("warning:     ", found.warnings))
        .chain(named("can show:    ", &prospects.can))
        .chain(named("cannot show: ", &prospects.cannot))
        .collect()
}

/// What is said of data in which nothing looks wrong.
fn right(data: &Dataset) -> String {
    let but = match data.outliers.len() {
        0 => "",
        1 => ", but for the row that stands apart",
        _ => ", but for the rows that stand apart",
    };
    let depths = || (data.observations.iter()).filter(|o| o.quantity == Quantity::WearDepth);
    if depths().next().is_some() && depths().all(|o| o.trace.is_none()) {
        format!(
            "signs and units look right{but}; the zeros of profiles are taken as measured: name each profile in a column trace if its zero is not known"
        )
    } else {
        format!("signs, units and zeros look right{but}")
    }
}
