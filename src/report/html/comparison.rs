//! The page of `compare`: measured against model along both flanks, places by χ², parameters.
use super::page::{Page, Section};
use super::table::{Cell, Table};
use crate::learn::{Cell as Place, Comparison, Group, TestRecord, Validation};
use crate::numeric::written::{count, percent, plain, significant, uncertain, whole};
use crate::report::comparison::{self, Result, estimate, interval, with_unit};
use crate::report::models::signed;
use crate::report::plots;
use crate::study::Test;

/// Rows of the table of places; all of them stand in the JSON file.
const PLACES: usize = 16;
/// Rows of the table of outliers.
const OUTLIERS: usize = 12;

/// The page of a comparison.
pub fn comparison(result: &Result<'_>) -> Page {
    let mut sections = vec![figures(result), places(result)];
    let tests = result.study.tests.iter();
    for (test, plots) in tests.zip(plots::of_comparison(result)) {
        let record = result.comparison.tests.iter().find(|r| r.test == test.id);
        if let Some(record) = record {
            let with_temperature = result.study.temperatures_differ();
            sections.push(of_test(test, with_temperature, record).plots(plots));
        }
    }
    sections.push(groups(result.comparison));
    sections.push(validation(result.comparison));
    sections.extend(outliers(result.comparison));
    Page {
        title: if result.study.title.is_empty() {
            "Measured against model".to_owned()
        } else {
            result.study.title.clone()
        },
        kicker: format!(
            "Measured against model: {}",
            comparison::what(result.study, result.comparison)
        ),
        conclusion: comparison::conclusion(result.comparison),
        sections,
        ..Page::default()
    }
}

fn depth(value: Option<f64>) -> Cell {
    Cell::number(value.map_or("–".to_owned(), |v| significant(v, 3)))
}

fn figures(result: &Result<'_>) -> Section {
    let c = result.comparison;
    let mut fitted = Table::new(
        "What was free",
        ["parameter", "value", "95 % from", "to", ""],
    );
    for p in &c.parameters {
        let [low, high] = interval(p);
        fitted = fitted.row([
            Cell::Code(p.name.clone()),
            Cell::number(estimate(p)),
            Cell::number(low),
            Cell::number(high),
            if p.at_bound {
                Cell::Badge("theory", "on its bound".to_owned())
            } else {
                Cell::text("")
            },
        ]);
    }
    let mut tests = Table::new(
        "Tests",
        [
            "test",
            "role",
            "points",
            "χ² per point",
            "bias, µm",
            "rms, µm",
            "own k, mm²/N",
        ],
    );
    for t in &c.tests {
        tests = tests.row([
            Cell::text(t.test.clone()),
            Cell::text(role(&t.role)),
            Cell::number(whole(t.points)),
            Cell::number(significant(t.chi2_per_point, 3)),
            depth(t.bias_um),
            depth(t.rms_um),
            Cell::number(uncertain(t.coefficient, t.coefficient_sigma)),
        ]);
    }
    let mut section = Section::new("Figures").table(fitted).table(tests).note(format!(
        "χ² per point is the mean of ((model − measured)/sigma)² with each trace's most probable datum subtracted and each \
         test's most probable wear coefficient; 1 is the noise floor. Signs are model minus measured. Scatter of the wear \
         coefficient: {}. For held-out tests only their datums and their own coefficient are \
         estimated, and ± of that is without the errors of the other parameters. The fit took {} wear histories.",
        comparison::scatter(c),
        whole(c.evaluations)
    ));
    if let Some(members) = comparison::members(c) {
        section = section.note(format!("k of the members: {members}."));
    }
    section.key_figures = key_figures(c);
    for warning in &c.warnings {
        section = section.paragraph(format!("Warning: {warning}."));
    }
    section
}

fn key_figures(c: &Comparison) -> Vec<(String, String)> {
    let depth = |v: f64| format!("{} µm", significant(v, 3));
    let chi2 = |v: f64| significant(v, 3);
    let all = [
        ("χ² per point, fit tests", c.fit.chi2_per_point.map(chi2)),
        (
            "χ² per point, held-out tests",
            c.holdout.chi2_per_point.map(chi2),
        ),
        ("rms error of the depth", c.rms_um.map(depth)),
        ("rms of the noise", c.noise_rms_um.map(depth)),
        ("measured points", Some(whole(c.points))),
    ];
    let known = all
        .into_iter()
        .filter_map(|(name, value)| Some((name.to_owned(), value?)));
    known.collect()
}

fn role(role: &str) -> &str {
    if role == "holdout" { "held out" } else { role }
}

/// The cells of test, member, region and cycles that exceed the noise most: χ² less one for each point.
fn places(result: &Result<'_>) -> Section {
    let c = result.comparison;
    let excess = |cell: &Place| (cell.chi2_per_point - 1.0) * cell.points as f64;
    let total: f64 = c.places.iter().map(|cell| excess(cell).max(0.0)).sum();
    let mut worst: Vec<&Place> = c.places.iter().filter(|cell| excess(cell) > 0.0).collect();
    worst.sort_by(|a, b| excess(b).total_cmp(&excess(a)));
    let largest = worst.first().map_or(1.0, |cell| excess(cell));
    let mut table = Table::new(
        "",
        [
            "test",
            "member",
            "quantity",
            "region",
            "cycles",
            "points",
            "χ² per point",
            "share",
            "bias",
            "rms",
        ],
    );
    for cell in worst.iter().take(PLACES) {
        let [from, to] = cell.cycles;
        table = table.row([
            Cell::text(cell.test.clone()),
            Cell::text(cell.member.clone()),
            Cell::text(cell.quantity.replace('_', " ")),
            Cell::text(cell.region.replace('_', " ")),
            Cell::number(format!("{} to {}", count(from), count(to))),
            Cell::number(whole(cell.points)),
            Cell::number(significant(cell.chi2_per_point, 3)),
            Cell::Bar(excess(cell) / largest, percent(excess(cell) / total, 2)),
            Cell::number(with_unit(
                format!(
                    "{} ± {}",
                    signed(cell.bias, 2),
                    significant(cell.bias_sigma, 1)
                ),
                &cell.unit,
            )),
            Cell::number(with_unit(significant(cell.rms, 2), &cell.unit)),
        ]);
    }
    let section = Section::new("Where it is furthest off").table(table);
    section.plots(plots::errors_by_place(result)).note(format!(
        "The {} of {} places that exceed the noise most; share: of all that exceeds it. All places stand in \
         `comparison.json`, every row in `residuals.csv`.",
        worst.len().min(PLACES),
        c.places.len()
    ))
}

fn of_test(test: &Test, with_temperature: bool, record: &TestRecord) -> Section {
    let o = &test.conditions;
    let mut conditions = vec![
        format!("{} N·m", significant(1e-3 * o.torque_nmm, 4)),
        format!("{} rpm", count(o.speed_rpm)),
        format!("misalignment {} mm", o.misalignment_mm),
        format!("{} cycles", count(o.cycles)),
    ];
    if let Some(celsius) = o.bulk_temperature_c.filter(|_| with_temperature) {
        conditions.insert(2, format!("{} °C", plain(0.1 * (10.0 * celsius).round())));
    }
    if o.reversed {
        conditions.push("driven the other way".to_owned());
    }
    let heading = format!("Test {}", test.id);
    let heading = if record.role == "holdout" {
        format!("{heading}, held out")
    } else {
        heading
    };
    Section::new(&heading)
        .paragraph(format!(
            "{}: χ² per point {} over {} points.",
            conditions.join(", "),
            significant(record.chi2_per_point, 3),
            whole(record.points)
        ))
        .note(
            "Points: measured, each trace's most probable datum removed, with bars of one standard deviation. Lines: the \
             fitted model. Below: model minus measured. A to E: the path of contact; single contact from B to D, pitch point C.",
        )
}

fn groups(c: &Comparison) -> Section {
    let mut table = Table::new(
        "",
        ["what", "points", "χ² per point", "bias, µm", "rms, µm"],
    );
    let all: [&[Group]; 4] = [&c.by_quantity, &c.by_member, &c.by_region, &c.by_life];
    let groups = || all.into_iter().flatten();
    let largest = groups().map(|g| g.chi2_per_point).fold(1.0, f64::max);
    for group in groups() {
        table = table.row([
            Cell::text(group.name.replace('_', " ")),
            Cell::number(whole(group.points)),
            Cell::Bar(
                group.chi2_per_point / largest,
                significant(group.chi2_per_point, 3),
            ),
            depth(group.bias_um),
            depth(group.rms_um),
        ]);
    }
    let section = Section::new("By quantity, member, region and life").table(table);
    if c.holdout.points == 0 {
        return section;
    }
    section.note(
        "All tests, held-out ones included; a diagnosis, and warnings of one quantity's misfit, count the fit tests alone.",
    )
}

/// What the model's own error is seen by: its mean, else its curve, about the datums where these were fitted to it.
fn verdict(v: &Validation) -> Cell {
    match (v.resolved, v.curve_resolved, v.mean_is_fitted) {
        (true, ..) => Cell::Badge("fail", "seen in the mean".to_owned()),
        (false, true, _) => Cell::Badge("fail", "seen in the curve".to_owned()),
        (false, false, true) => Cell::Badge("pass", "curve within the noise".to_owned()),
        (false, false, false) => Cell::Badge("pass", "below the uncertainty".to_owned()),
    }
}

fn validation(c: &Comparison) -> Section {
    let mut table = Table::new(
        "",
        [
            "test",
            "member",
            "quantity",
            "E",
            "u num",
            "u input",
            "u data",
            "2 u val",
            "rms",
            "noise rms",
            "model error",
        ],
    );
    for v in &c.validation {
        let number = |value: f64| Cell::number(significant(value, 2));
        table = table.row([
            Cell::text(if v.role == "holdout" {
                format!("{}, held out", v.test)
            } else {
                v.test.clone()
            }),
            Cell::text(v.member.clone()),
            Cell::text(v.quantity.replace('_', " ")),
            Cell::number(with_unit(significant(v.error, 2), &v.unit)),
            number(v.u_num),
            number(v.u_input),
            number(v.u_data),
            number(2.0 * v.u_val),
            number(v.rms),
            number(v.noise_rms),
            verdict(v),
        ]);
    }
    let section = Section::new("Error against uncertainty")
        .paragraph(
            "Following ASME V&V 20-2009: E, the mean of model minus measured, against the validation uncertainty of \
             numerics, fitted inputs and data. Where |E| > 2 u val the model's own error is seen. For fit tests E shows \
             only what no parameter can mend.",
        )
        .table(table);
    if !c.validation.iter().any(|v| v.mean_is_fitted) {
        return section;
    }
    section.note(
        "Of traces a small E validates nothing: the datum of each is fitted to it, in held-out tests too, and takes the mean error with it; a held-out \
         test's own k does as much. What counts there is the rms about the datums against that of noise, numerics and open parameters; beyond what chance makes of \
         it the error is seen in the curve.",
    )
}

fn outliers(c: &Comparison) -> Option<Section> {
    if c.outliers.is_empty() {
        return None;
    }
    let mut table = Table::new(
        "",
        [
            "row",
            "test",
            "member",
            "quantity",
            "cycles",
            "position",
            "error, sigmas",
        ],
    );
    for o in c.outliers.iter().take(OUTLIERS) {
        table = table.row([
            Cell::Code(o.place.clone()),
            Cell::text(o.test.clone()),
            Cell::text(o.member.clone()),
            Cell::text(o.quantity.replace('_', " ")),
            Cell::number(count(o.cycles)),
            Cell::number(o.position.map_or(String::new(), |p| p.to_string())),
            Cell::number(signed(o.standardised, 1)),
        ]);
    }
    let text = format!(
        "{} of {} rows are further off than four of their sigmas (by chance: one in 16 000).",
        whole(c.outliers.len()),
        whole(c.points)
    );
    Some(Section::new("Outliers").paragraph(text).table(table))
}
