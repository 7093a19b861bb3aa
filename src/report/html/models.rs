//! The page of `models`: the contact models side by side, and which assumption makes each difference.
use super::page::{Page, Section};
use super::table::{Cell, Table};
use crate::report::format::{count, percent, significant};
use crate::report::models::{
    conclusions, decimals, fixed, of_mounting, published_gear_speed, signed,
};
use crate::report::plots::{Plot, Style};
use crate::simulate::models::{
    Comparison, ContactCurve, Flank, Kind, Means, Mounted, Quantity, RegionDifference,
};

/// The page of a comparison; `title` is the study's own.
pub fn models(title: &str, comparison: &Comparison) -> Page {
    let c = &comparison.conditions;
    let mut sections: Vec<Section> = comparison.mounted.iter().map(mounting).collect();
    sections.extend(one_at_a_time(comparison));
    sections.push(assumptions(comparison));
    Page {
        title: if title.is_empty() {
            "Contact models side by side".to_owned()
        } else {
            title.to_owned()
        },
        kicker: format!(
            "Contact models side by side: {} and {} teeth, {} N·m at {} rpm, wear after {} pinion revolutions",
            comparison.teeth[0],
            comparison.teeth[1],
            significant(c.torque / 1000.0, 4),
            count(c.speed),
            count(c.cycles)
        ),
        conclusion: conclusions(comparison).join(" "),
        sections,
    }
}

fn mounting(mounted: &Mounted) -> Section {
    let heading = format!("Misalignment {} mm", mounted.misalignment);
    let mut section = Section::new(&heading);
    for said in of_mounting(mounted) {
        section = section.paragraph(said);
    }
    for quantity in [
        Quantity::DepthPinion,
        Quantity::DepthGear,
        Quantity::PeakPressure,
    ] {
        section.tables.extend(ladder(mounted, quantity));
    }
    section.table(differences(mounted)).plots(plots(mounted))
}

/// The models with their means by region, and between them what each replaced assumption changes.
fn ladder(mounted: &Mounted, quantity: Quantity) -> Option<Table> {
    let caption = format!(
        "Mean {} along the path of contact, {}: the models, and between them the change as one assumption after the other \
         is replaced",
        quantity.label(),
        quantity.unit()
    );
    let mut head = vec!["model or cause", "assumption replaced"];
    head.extend(mounted.spans.iter().map(|s| s.region.name()));
    head.push("whole path");
    let mut table = Table::new(&caption, head);
    let digits = decimals(quantity);
    let numbers = |means: &Means, said: fn(f64, usize) -> String| {
        let all = means.regions.iter().chain(std::iter::once(&means.whole));
        all.map(|v| Cell::number(said(*v, digits)))
            .collect::<Vec<_>>()
    };
    let model = |kind: Kind, means: &Means| {
        let first = [Cell::Code(kind.name().to_owned()), Cell::text("")];
        first.into_iter().chain(numbers(means, fixed))
    };
    for ladder in &mounted.ladders {
        let Some(column) = ladder.start.iter().position(|m| m.quantity == quantity) else {
            continue;
        };
        if table.rows.is_empty() {
            table = table.row(model(ladder.from, &ladder.start[column]));
        }
        for rung in &ladder.rungs {
            let change = &rung.changes[column];
            let nothing = change.regions.iter().all(|v| *v == 0.0);
            if nothing {
                continue;
            }
            let first = [
                Cell::text(rung.cause.label()),
                Cell::text(format!("{} → {}", rung.replaced, rung.by)),
            ];
            table = table.row(first.into_iter().chain(numbers(change, signed)));
        }
        table = table.row(model(ladder.to, &ladder.end[column]));
    }
    (!table.rows.is_empty()).then_some(table)
}

/// Relative differences by region: of the means, and at the worst place.
fn differences(mounted: &Mounted) -> Table {
    let mut head = vec!["quantity", "compared"];
    head.extend(mounted.spans.iter().map(|s| s.region.name()));
    let mut table = Table::new(
        "Difference of the means over the reference's mean; in brackets the mean of the absolute differences and the largest \
         difference at one place, both over the reference's mean",
        head,
    );
    let relative = |value: Option<f64>| value.map_or("–".to_owned(), |v| signed(100.0 * v, 1));
    let absolute = |value: Option<f64>| value.map_or("–".to_owned(), |v| fixed(100.0 * v, 1));
    let cell = |r: &RegionDifference| {
        Cell::number(format!(
            "{} % ({}; {})",
            relative(r.mean),
            absolute(r.mean_absolute),
            relative(r.max)
        ))
    };
    for quantity in Quantity::ALL {
        for difference in mounted
            .differences
            .iter()
            .filter(|d| d.quantity == quantity)
        {
            let first = [
                Cell::text(quantity.label()),
                Cell::text(format!(
                    "{} against {}",
                    difference.model.name(),
                    difference.reference.name()
                )),
            ];
            table = table.row(first.into_iter().chain(difference.regions.iter().map(cell)));
        }
    }
    table
}

/// Each correction of the published model by itself.
fn one_at_a_time(comparison: &Comparison) -> Option<Section> {
    let mut table = Table::new(
        "Change of the pinion's mean worn depth when this alone is corrected in the published model",
        [
            "misalignment",
            "cause",
            "correction",
            "whole path, µm",
            "of the model's depth",
        ],
    );
    for mounted in &comparison.mounted {
        for alone in &mounted.alone {
            let Some(all) = mounted.means(Quantity::DepthPinion, Kind::Paper) else {
                continue;
            };
            table = table.row([
                Cell::text(format!("{} mm", mounted.misalignment)),
                Cell::text(alone.cause.label()),
                Cell::text(alone.correction),
                Cell::number(signed(alone.change.whole, 3)),
                Cell::number(percent(alone.change.whole / all.whole, 2)),
            ]);
        }
    }
    let section = Section::new("The published model, corrected one step at a time");
    let gear_speed = format!(
        "Gear speed in the published model: {}.",
        published_gear_speed(comparison)
    );
    (!table.rows.is_empty()).then(|| section.paragraph(gear_speed).table(table))
}

fn assumptions(comparison: &Comparison) -> Section {
    let mut table = Table::new("", ["model", "assumes"]);
    for kind in [Kind::Paper, Kind::Hertz, Kind::Fem] {
        table = table.row([
            Cell::Code(kind.name().to_owned()),
            Cell::text(kind.assumptions()),
        ]);
    }
    let mut section = Section::new("What each model assumes").table(table).note(
        "All models are run without the study's effects. Regions: lower_double from A to B, single_lower from B to the pitch \
         point C, single_upper from C to D, upper_double from D to E of the path of contact. The rungs between two models add \
         up to their difference; where two assumptions act on each other their order matters.",
    );
    for out in &comparison.left_out {
        section = section.note(format!(
            "A misalignment of {} mm is left out: {}.",
            out.misalignment, out.reason
        ));
    }
    section
}

/// Pressure, load share and wear, one curve per model.
fn plots(mounted: &Mounted) -> Vec<Plot> {
    const PATH: &str = "distance along the path of contact from the pitch point, mm";
    let [a, b, d, e] = mounted.geometry.path_limits;
    let letters = [(a, "A"), (b, "B"), (0.0, "C"), (d, "D"), (e, "E")]
        .map(|(at, letter)| (at, letter.to_owned()));
    let empty = |name: &str, title: &str, y_label: &str| {
        let name = format!("{name}_misalignment_{}", mounted.misalignment);
        let title = format!("{title}, misalignment {} mm", mounted.misalignment);
        Plot::new(&name, &title, PATH, y_label)
            .with_marks(letters.clone())
            .starting_at_zero()
    };
    let contact = |plot: Plot, column: fn(&ContactCurve) -> &Vec<f64>| {
        mounted.models.iter().fold(plot, |plot, model| {
            let points = model.contact.path.iter().zip(column(&model.contact));
            let points = points.map(|(x, y)| (*x, *y)).collect();
            plot.curve(model.kind.name(), style(model.kind), points)
        })
    };
    let wear = |plot: Plot, kinds: &[Kind], gear: bool| {
        let shown = mounted.models.iter().filter(|m| kinds.contains(&m.kind));
        shown.fold(plot, |plot, model| {
            let flank = if gear {
                model.gear.as_ref()
            } else {
                Some(&model.pinion)
            };
            let points = |flank: &Flank| {
                flank
                    .path
                    .iter()
                    .copied()
                    .zip(flank.depth_um.iter().copied())
                    .collect()
            };
            plot.curve(
                model.kind.name(),
                style(model.kind),
                flank.map(points).unwrap_or_default(),
            )
        })
    };
    let depth = "worn depth, µm";
    let mut plots = vec![
        contact(
            empty(
                "pressure",
                "Largest contact pressure of one pair, unworn",
                "peak pressure, MPa",
            ),
            |c| &c.peak_pressure,
        ),
        contact(
            empty(
                "load_share",
                "Share of the torque that one pair carries, unworn",
                "load share, -",
            ),
            |c| &c.load_share,
        ),
        wear(
            empty(
                "wear_pinion",
                "Worn depth of the pinion, finite elements and Hertz",
                depth,
            ),
            &[Kind::Hertz, Kind::Fem],
            false,
        ),
        wear(
            empty(
                "wear_gear",
                "Worn depth of the gear, finite elements and Hertz",
                depth,
            ),
            &[Kind::Hertz, Kind::Fem],
            true,
        ),
    ];
    if mounted.model(Kind::Paper).is_some() {
        plots.push(wear(
            empty(
                "wear_pinion_paper",
                "Worn depth of the pinion, all models",
                depth,
            ),
            &[Kind::Paper, Kind::Hertz, Kind::Fem],
            false,
        ));
    }
    plots.retain(|plot| !plot.is_empty());
    plots
}

/// The same colour for a model in all plots.
fn style(kind: Kind) -> Style {
    Style::Kind(match kind {
        Kind::Fem => 0,
        Kind::Hertz => 1,
        Kind::Paper => 2,
    })
}
