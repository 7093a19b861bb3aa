//! The page of `models`: the contact models side by side, and which assumption makes each difference.
use super::page::{Page, Section};
use super::table::{Cell, Table};
use crate::numeric::written::{count, fixed, significant};
use crate::report::models::{conclusions, decimals, of_mounting, published_gear_speed, signed};
use crate::report::plots;
use crate::simulate::models::{Comparison, Kind, Means, Mounted, Quantity, RegionDifference};

/// The page of a comparison; `title` is the study's own.
pub fn models(title: &str, comparison: &Comparison) -> Page {
    let c = &comparison.conditions;
    let mut sections: Vec<Section> = comparison.mounted.iter().map(mounting).collect();
    sections.extend(one_at_a_time(comparison));
    sections.push(rungs(comparison));
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
        conclusion: unbroken(&conclusions(comparison).join(" ")),
        sections,
        ..Page::default()
    }
}

fn mounting(mounted: &Mounted) -> Section {
    let heading = format!("Misalignment {} mm", mounted.misalignment);
    let mut section = Section::new(&heading);
    for sentence in of_mounting(mounted) {
        section = section.paragraph(unbroken(&sentence));
    }
    for quantity in [
        Quantity::DepthPinion,
        Quantity::DepthGear,
        Quantity::PeakPressure,
    ] {
        section.tables.extend(ladder(mounted, quantity));
    }
    for quantity in Quantity::ALL {
        section.tables.extend(differences(mounted, quantity));
    }
    section.plots(plots::of_models(mounted)).note(
        "In the tables of means, the rows between two models show how much each replaced assumption changes the mean. In the \
         tables of differences, the first figure is the difference of the means and the one after the stroke the largest \
         difference at any one point, both in percent of the mean of the model named second.",
    )
}

/// Keeps numbers and their units on one line.
fn unbroken(text: &str) -> String {
    [" µm", " mm", " %", " MPa"]
        .iter()
        .fold(text.to_owned(), |text, unit| {
            text.replace(unit, &unit.replace(' ', "\u{a0}"))
        })
}

/// The parts of the path of contact as heads of columns: from letter to letter.
fn heads(mounted: &Mounted) -> Vec<String> {
    let [a, b, d, e] = mounted.geometry.path_limits;
    let letter = |y: f64| {
        let all = [(a, "A"), (e, "E"), (0.0, "C"), (b, "B"), (d, "D")];
        let nearest = all
            .iter()
            .min_by(|p, q| (p.0 - y).abs().total_cmp(&(q.0 - y).abs()));
        nearest.map_or("", |(_, letter)| letter)
    };
    let spans = mounted.spans.iter();
    spans
        .map(|s| format!("{}–{}", letter(s.from), letter(s.to)))
        .collect()
}

/// The models with their means by region, and between them what each replaced assumption changes.
fn ladder(mounted: &Mounted, quantity: Quantity) -> Option<Table> {
    let caption = format!("Mean {}, {}", quantity.label(), quantity.unit());
    let heads = heads(mounted);
    let mut head = vec!["model or cause"];
    head.extend(heads.iter().map(String::as_str));
    head.push("A–E");
    let mut table = Table::new(&caption, head);
    let digits = decimals(mounted, quantity);
    let numbers = |means: &Means, written: fn(f64, usize) -> String| {
        let all = means.regions.iter().chain(std::iter::once(&means.whole));
        all.map(|v| Cell::number(written(*v, digits)))
            .collect::<Vec<_>>()
    };
    let model = |kind: Kind, means: &Means| {
        let first = Cell::Code(kind.name().to_owned());
        std::iter::once(first).chain(numbers(means, fixed))
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
            let first = Cell::text(rung.cause.label());
            table = table.row(std::iter::once(first).chain(numbers(change, signed)));
        }
        table = table.row(model(ladder.to, &ladder.end[column]));
    }
    (!table.rows.is_empty()).then_some(table)
}

/// Relative differences of one quantity by region: of the means, and at the worst place.
fn differences(mounted: &Mounted, quantity: Quantity) -> Option<Table> {
    let heads = heads(mounted);
    let mut head = vec!["model against reference"];
    head.extend(heads.iter().map(String::as_str));
    let mut table = Table::new(&format!("Differences in {}, %", quantity.label()), head);
    let relative = |value: Option<f64>| {
        value.map_or("–".to_owned(), |v| {
            signed(100.0 * v, usize::from(v.abs() < 1.0))
        })
    };
    let cell =
        |r: &RegionDifference| Cell::number(format!("{} / {}", relative(r.mean), relative(r.max)));
    let all = mounted
        .differences
        .iter()
        .filter(|d| d.quantity == quantity);
    for difference in all {
        let first = Cell::text(format!(
            "{} against {}",
            difference.model.name(),
            difference.reference.name()
        ));
        table = table.row(std::iter::once(first).chain(difference.regions.iter().map(cell)));
    }
    (!table.rows.is_empty()).then_some(table)
}

/// Each correction of the published model by itself, one column per misalignment.
fn one_at_a_time(comparison: &Comparison) -> Option<Section> {
    let columns: Vec<(&Mounted, f64)> = comparison
        .mounted
        .iter()
        .filter(|m| !m.alone.is_empty())
        .filter_map(|m| Some((m, m.means(Quantity::DepthPinion, Kind::Paper)?.whole)))
        .collect();
    let (first, _) = columns.first()?;
    let heads: Vec<String> = columns
        .iter()
        .map(|(m, _)| format!("{}\u{a0}mm", m.misalignment))
        .collect();
    let mut head = vec!["cause", "correction"];
    head.extend(heads.iter().map(String::as_str));
    let mut table = Table::new(
        "Change in the pinion's mean worn depth when only this step is corrected, in µm and in % of the published model's depth, by misalignment",
        head,
    );
    for (row, alone) in first.alone.iter().enumerate() {
        let numbers = columns.iter().map(|(mounted, all)| {
            let change = mounted.alone[row].change.whole;
            let percent = signed(100.0 * change / all, 1);
            Cell::number(format!("{} ({percent}\u{a0}%)", signed(change, 3)))
        });
        let words = [
            Cell::text(alone.cause.label()),
            Cell::text(alone.correction),
        ];
        table = table.row(words.into_iter().chain(numbers));
    }
    let gear_speed = format!(
        "Gear speed in the published model: {}.",
        published_gear_speed(comparison)
    );
    Some(
        Section::new("The published model, corrected one step at a time")
            .paragraph(gear_speed)
            .table(table),
    )
}

/// What every rung takes out and puts in.
fn rungs(comparison: &Comparison) -> Section {
    let most = comparison
        .mounted
        .iter()
        .max_by_key(|m| m.ladders.iter().map(|l| l.rungs.len()).sum::<usize>());
    let mut table = Table::new("", ["between", "cause", "assumption", "replaced by"]);
    for ladder in most.iter().flat_map(|m| &m.ladders) {
        for rung in &ladder.rungs {
            table = table.row([
                Cell::text(format!("{} and {}", ladder.from.name(), ladder.to.name())),
                Cell::text(rung.cause.label()),
                Cell::text(rung.replaced),
                Cell::text(rung.by),
            ]);
        }
    }
    Section::new("What each cause replaces")
        .paragraph(
            "From one model to the next, assumptions are replaced one at a time, from top to bottom; each row between the models in the \
             tables above is the change that one replacement makes. The changes add up to the difference between the two \
             models; where assumptions affect each other, their shares depend on this order.",
        )
        .table(table)
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
        "All models are run without the study's effects. A to E is the path of contact and C the pitch point: lower_double \
         is A to B, single_lower B to C, single_upper C to D, upper_double D to E; means are taken along the path. Under a sharp \
         tip corner the pressure grows without limit as the mesh is refined; load share and wear do not.",
    );
    for out in &comparison.left_out {
        section = section.note(format!(
            "A misalignment of {} mm is left out: {}.",
            out.misalignment, out.reason
        ));
    }
    section
}
