//! What is left against each physical driver, before and after: tables and pictures.

use super::comparison::quoted;
use super::csv::Table as Csv;
use super::discrepancy;
use super::error::OutputError;
use super::html::{Cell, Section, Table};
use super::plots::{Plot, Style};
use crate::learn::diagnose::{
    BinMean, DRIVER_KINDS, Diagnosis, Driver, DriverBin, DriverKind, Explained, Hypothesis,
    ResidualDriver, ResidualDrivers,
};
use crate::measure::{Place, Quantity};
use crate::numeric::written::{percent, significant, whole};

const BINS: &str = "residual_drivers.csv";
const ROWS: &str = "residual_rows.csv";
/// The driver that is no number.
const MEMBER: &str = "member";
/// The driver whose column stands last.
const TEMPERATURE: &str = "bulk_temperature";
/// Where the distance along the path of contact stands in the values of a row.
const PATH: usize = 0;

/// `residual_drivers.csv`: the mean residual in each bin of each driver.
///
/// Columns `driver,unit,from,to,centre,points,before,before_error,after,after_error`: (measured − model − datum)/σ of the base
/// model and of the leading one, with the standard errors of the means; empty where nothing is missing.
///
/// # Errors
/// [`OutputError`] for a number that is not finite.
pub fn bins(left: &ResidualDrivers) -> Result<Vec<u8>, OutputError> {
    let mut table = Csv::new(
        BINS,
        "driver,unit,from,to,centre,points,before,before_error,after,after_error",
    );
    for driver in &left.drivers {
        for bin in &driver.bins {
            table.text(&driver.name);
            table.text(&quoted(&driver.unit));
            table.number("from", bin.from)?;
            table.number("to", bin.to)?;
            table.number("centre", bin.centre)?;
            table.text(&bin.points.to_string());
            for mean in [Some(bin.before), bin.after] {
                for value in [mean.map(|m| m.mean), mean.map(|m| m.error)] {
                    optional(&mut table, "residual", value)?;
                }
            }
            table.end_row();
        }
    }
    Ok(table.into_bytes())
}

/// `residual_rows.csv`: every fitted row with what it felt and what either model leaves of it.
///
/// Columns `test,member,quantity,where`, the drivers (units in `residual_drivers.csv`; `member` once), `before,after`; then, with
/// units in their names, where it was measured (`radius_mm` or `rotation_base_pitches`) and the driver `position` again (`path_mm`); last
/// `bulk_temperature`.
///
/// # Errors
/// [`OutputError`] for a number that is not finite.
pub fn rows(left: &ResidualDrivers) -> Result<Vec<u8>, OutputError> {
    let apart = [MEMBER, TEMPERATURE];
    let kinds = || {
        let all = DRIVER_KINDS.iter().enumerate();
        all.filter(|(_, kind)| !apart.contains(&kind.name))
    };
    let temperature = DRIVER_KINDS
        .iter()
        .position(|kind| kind.name == TEMPERATURE);
    let names: Vec<&str> = kinds().map(|(_, kind)| kind.name).collect();
    let head = format!(
        "test,member,quantity,where,{},before,after,radius_mm,rotation_base_pitches,path_mm,{TEMPERATURE}",
        names.join(",")
    );
    let mut table = Csv::new(ROWS, &head);
    for row in &left.rows {
        table.text(&quoted(&row.test));
        table.text(row.member);
        table.text(row.quantity);
        optional(&mut table, "where", row.position)?;
        for (number, kind) in kinds() {
            optional(&mut table, kind.name, row.values[number])?;
        }
        table.number("before", row.before)?;
        optional(&mut table, "after", row.after)?;
        let place = Quantity::ALL
            .into_iter()
            .find(|quantity| quantity.name() == row.quantity)
            .map(Quantity::place);
        let at = |wanted: Place| row.position.filter(|_| place == Some(wanted));
        optional(&mut table, "radius_mm", at(Place::Flank))?;
        optional(&mut table, "rotation_base_pitches", at(Place::Rotation))?;
        optional(&mut table, "path_mm", row.values[PATH])?;
        let celsius = temperature.and_then(|number| row.values[number]);
        optional(&mut table, TEMPERATURE, celsius)?;
        table.end_row();
    }
    Ok(table.into_bytes())
}

fn optional(table: &mut Csv, name: &'static str, value: Option<f64>) -> Result<(), OutputError> {
    match value {
        Some(value) => table.number(name, value)?,
        None => table.text(""),
    }
    Ok(())
}

/// What the pictures of the discrepancy show.
const MAP: &str = "The pictures show the smooth part of measured minus model for wear depths, in standard deviations of a measured value. All of it stands in `discrepancy.csv`.";

/// The sections of the page: one table of shares by driver, the smooth discrepancy, and the residual against each driver. None where
/// nothing varies.
pub fn sections(diagnosis: &Diagnosis) -> Vec<Section> {
    let left = &diagnosis.residual_drivers;
    let mut sections = Vec::new();
    if !(diagnosis.drivers.is_empty() && left.drivers.is_empty()) {
        let after = left.after.as_ref().map_or(String::new(), |effects| {
            format!("; after: fitted anew with {}", effects.in_words())
        });
        let section = Section::new("What the discrepancy depends on")
            .paragraph(if diagnosis.drivers.is_empty() { NO_PATTERN } else { PATTERN })
            .paragraph(MEANS)
            .table(shares(&diagnosis.drivers, left))
            .note(format!(
                "Before: the fitted base model{after}. On noise alone a mean's share is 0 give or take \
                 what stands under by chance; beside it the same part in units of the noise's variance, because a share of little is little. \
                 Drivers that go together, such as position and sliding speed, share what they explain.",
            ));
        let maps = discrepancy::plots(&diagnosis.discrepancy);
        sections.push(if diagnosis.drivers.is_empty() {
            section
        } else {
            section.paragraph(MAP).plots(maps)
        });
    }
    sections.extend(residuals(left));
    sections
}

const NO_PATTERN: &str =
    "Nothing smooth stands out of the noise, so there is no pattern to be shared among drivers.";
const PATTERN: &str = "Pattern: how much of a smooth discrepancy between the base model and the measurements follows a driver alone, as a shift or as a \
    factor on the computed wear, which may be large at one place and small or of the other sign at another.";
const MEANS: &str = "Mean: how much of the variance of (measured − model − datum)/σ the means of the driver's bins explain. A driver can have much of the \
    pattern and nothing of the mean: k and datum of each test are fitted, so what follows torque or speed turns the curves and shifts none.";

/// One row for each driver: its share of the pattern, and of the mean residual before and after.
fn shares(patterns: &[Driver], left: &ResidualDrivers) -> Table {
    let mut head = vec![
        "driver",
        "pattern",
        "mean, before",
        "of the noise's variance",
    ];
    let after = left.after.is_some();
    if after {
        head.extend(["mean, after", "of the noise's variance"]);
    }
    head.extend(["by chance", "rows"]);
    let columns = head.len();
    let mut table = Table::new("Shares by driver", head);
    let same = |pattern: &Driver, residual: &ResidualDriver| {
        pattern.name == residual.name || pattern.name == "depth" && residual.name == "depth_worn"
    };
    let pattern = |share: f64| Cell::Bar(share, format!("{:.0} %", 100.0 * share));
    let alone = patterns
        .iter()
        .filter(|p| !left.drivers.iter().any(|d| same(p, d)));
    for driver in alone {
        let mut row = vec![
            Cell::text(driver.name.clone()),
            pattern(driver.variance_share),
        ];
        row.resize_with(columns, || Cell::number("–"));
        table = table.row(row);
    }
    let share_of = |d: &ResidualDriver| {
        patterns
            .iter()
            .find(|p| same(p, d))
            .map(|p| p.variance_share)
    };
    let mut ordered: Vec<&ResidualDriver> = left.drivers.iter().collect();
    ordered.sort_by(|a, b| {
        share_of(b)
            .unwrap_or(0.0)
            .total_cmp(&share_of(a).unwrap_or(0.0))
    });
    for driver in ordered {
        let mut row = vec![
            Cell::text(kind(driver).label),
            share_of(driver).map_or(Cell::number("–"), pattern),
        ];
        for part in [Some(driver.before), driver.after].into_iter().flatten() {
            row.push(Cell::Bar(part.share, share(part)));
            row.push(Cell::number(significant(part.variance, 2)));
        }
        row.push(Cell::number(format!(
            "± {}",
            percent(driver.before.share_by_chance, 1)
        )));
        row.push(Cell::number(whole(driver.points)));
        table = table.row(row);
    }
    table
}

/// The pictures of the residual; none if nothing varies.
fn residuals(left: &ResidualDrivers) -> Option<Section> {
    if left.drivers.is_empty() {
        return None;
    }
    let models = match left.after.as_ref().map(Hypothesis::in_words) {
        Some(after) => format!(
            "Before: the fitted base model. After: fitted anew with {after}. An effect that is the right one leaves nothing that \
             follows its drivers."
        ),
        None => "Nothing is missing that these data show, so there is no model after.".to_owned(),
    };
    let mut section = Section::new("The residual against each physical driver")
        .paragraph(models)
        .plots(plots(left))
        .note(
            "Points: means of bins of about equal size; bars: their standard errors. Drivers on the flank are those of the fitted base \
             model at the measured point, when a contact presses it most. All of it stands in `residual_drivers.csv`, every row with its \
             drivers in `residual_rows.csv`.",
        );
    if !left.constant.is_empty() {
        let names: Vec<String> = left.constant.iter().map(|n| n.replace('_', " ")).collect();
        section = section.note(format!(
            "Not shown, because these data have one value of it only or the study does not state what it follows from: {}.",
            names.join(", ")
        ));
    }
    Some(section)
}

/// One picture for each driver: mean residuals before and after.
pub fn plots(left: &ResidualDrivers) -> Vec<Plot> {
    let after = left.after.as_ref().map(Hypothesis::in_words);
    let picture = |driver: &ResidualDriver| {
        let label = kind(driver).label;
        let name = label.split(',').next().unwrap_or(label);
        let mut plot = Plot::new(
            &format!("residual_{}", driver.name),
            &format!("Residual against {name}"),
            label,
            "mean of (measured − model) / σ",
        );
        plot.residuals = true;
        let curve = |of: &dyn Fn(&DriverBin) -> Option<BinMean>| -> (Vec<(f64, f64)>, Vec<f64>) {
            let known = driver.bins.iter().filter_map(|bin| Some((bin, of(bin)?)));
            known
                .map(|(bin, mean)| ((bin.centre, mean.mean), mean.error))
                .unzip()
        };
        let (points, errors) = curve(&|bin| Some(bin.before));
        plot = plot.with_errors("before: base model", Style::Kind(1), points, errors);
        if let Some(after) = &after {
            let (points, errors) = curve(&|bin| bin.after);
            plot = plot.with_errors(
                &format!("after: with {after}"),
                Style::Kind(0),
                points,
                errors,
            );
        }
        if driver.name == MEMBER {
            let last = driver.bins.iter().map(|bin| bin.to as usize).max();
            let names = ["pinion", "gear", "both"].into_iter().map(str::to_owned);
            plot = plot.with_names(names.take(last.unwrap_or(2)).collect());
        }
        plot
    };
    left.drivers.iter().map(picture).collect()
}

fn kind(driver: &ResidualDriver) -> &'static DriverKind {
    let known = DRIVER_KINDS.iter().find(|kind| kind.name == driver.name);
    known.unwrap_or(&DRIVER_KINDS[0])
}

fn share(part: Explained) -> String {
    if part.share < 0.001 {
        "none".to_owned()
    } else {
        percent(part.share, 2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::find;
    use crate::learn::diagnose::{DRIVERS, DriverRow, EffectSet};

    fn left(after: bool) -> ResidualDrivers {
        let mean = |mean: f64| BinMean { mean, error: 0.1 };
        let bin = |centre: f64, before: f64| DriverBin {
            from: centre - 0.5,
            to: centre,
            centre,
            points: 20,
            before: mean(before),
            after: after.then(|| mean(0.02)),
        };
        let part = |share: f64| Explained {
            share,
            share_by_chance: 0.02,
            variance: 3.0 * share,
        };
        let driver = |name: &str, unit: &str, bins: Vec<DriverBin>| ResidualDriver {
            name: name.to_owned(),
            unit: unit.to_owned(),
            points: 40,
            before: part(0.4),
            after: after.then(|| part(0.0)),
            bins,
        };
        let mut values = [None; DRIVERS];
        values[6] = Some(1e5);
        ResidualDrivers {
            after: after.then(|| {
                let cards = ["running_in", "coating"].map(|name| find(name).unwrap());
                Hypothesis::Effects(EffectSet::new(cards))
            }),
            drivers: vec![
                driver("cycles", "-", vec![bin(1e5, 2.0), bin(1e6, -1.0)]),
                driver(
                    "member",
                    "1 pinion, 2 gear, 3 both",
                    vec![bin(1.0, 0.5), bin(2.0, -0.5)],
                ),
            ],
            constant: vec!["film_ratio".to_owned()],
            rows: vec![DriverRow {
                measured: 2.0,
                sigma: 0.1,
                test: "A, first".to_owned(),
                member: "pair",
                quantity: "mass_loss",
                position: None,
                values,
                before: 2.5,
                after: after.then_some(-0.5),
            }],
        }
    }

    fn lines(bytes: Vec<u8>) -> Vec<String> {
        let text = String::from_utf8(bytes).unwrap();
        text.lines().map(str::to_owned).collect()
    }

    #[test]
    fn both_tables_hold_before_and_after() {
        let table = lines(bins(&left(true)).unwrap());
        assert_eq!(table.len(), 5);
        assert_eq!(table[1], "cycles,-,99999.5,100000,100000,20,2,0.1,0.02,0.1");
        assert!(table[3].starts_with("member,\"1 pinion, 2 gear, 3 both\",0.5,1,1,20,0.5,"));
        let table = lines(bins(&left(false)).unwrap());
        assert_eq!(table[1], "cycles,-,99999.5,100000,100000,20,2,0.1,,");
        let mut measured = left(true);
        let mut on_a_flank = measured.rows[0].clone();
        (on_a_flank.quantity, on_a_flank.position) = ("wear_depth", Some(26.5));
        on_a_flank.values[0] = Some(-1.5);
        let mut turned = on_a_flank.clone();
        (turned.quantity, turned.position) = ("transmission_error", Some(0.25));
        measured.rows.extend([on_a_flank, turned]);
        let table = lines(rows(&measured).unwrap());
        assert_eq!(
            table[0],
            "test,member,quantity,where,position,sliding_speed,contact_pressure,film_ratio,flash_temperature,depth_worn,cycles,\
             torque,speed,misalignment,before,after,radius_mm,rotation_base_pitches,path_mm,bulk_temperature"
        );
        assert_eq!(
            table[1],
            "\"A, first\",pair,mass_loss,,,,,,,,100000,,,,2.5,-0.5,,,,"
        );
        assert!(table[2].contains(",wear_depth,26.5,-1.5,"));
        assert!(table[2].ends_with(",2.5,-0.5,26.5,,-1.5,"));
        assert!(table[3].ends_with(",2.5,-0.5,,0.25,-1.5,"));
        assert_eq!(DRIVER_KINDS[PATH].name, "position");
    }

    #[test]
    fn a_picture_has_a_colour_for_before_and_one_for_after() {
        let plots = plots(&left(true));
        assert_eq!(plots.len(), 2);
        for plot in &plots {
            let labels: Vec<&str> = plot.curves.iter().map(|c| c.label.as_str()).collect();
            assert_eq!(
                labels,
                ["before: base model", "after: with running_in and coating"]
            );
            assert_ne!(plot.curves[0].style, plot.curves[1].style);
            assert!(plot.curves.iter().all(|c| c.errors.len() == c.points.len()));
            assert!(plot.svg().is_ok());
        }
        assert_eq!(plots[1].names, ["pinion", "gear"]);
        assert_eq!(super::plots(&left(false))[0].curves.len(), 1);
    }

    /// One table holds both kinds of share, each driver once.
    #[test]
    fn every_driver_has_one_row_with_both_kinds_of_share() {
        let patterns = [("speed", 0.54), ("cycles", 0.3)].map(|(name, variance_share)| Driver {
            name: name.to_owned(),
            variance_share,
        });
        for after in [true, false] {
            let table = shares(&patterns, &left(after));
            // speed, cycles, member
            assert_eq!(table.rows.len(), 3);
            assert!(table.rows.iter().all(|row| row.len() == table.head.len()));
        }
    }

    #[test]
    fn the_section_says_what_is_constant_and_what_after_is() {
        let section = residuals(&left(true)).unwrap();
        assert!(section.text[0].contains("running_in and coating"));
        assert!(section.notes.iter().any(|note| note.contains("film ratio")));
        let alone = residuals(&left(false)).unwrap();
        assert!(alone.text[0].starts_with("Nothing is missing"));
    }
}
