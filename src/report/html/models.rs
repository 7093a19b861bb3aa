//! The page and the document of `models`: the contact models side by side, and what makes them differ.
use serde::Serialize;

use super::page::{Page, Section};
use super::table::{Cell, Table};
use crate::report::format::significant;
use crate::report::plots::{Plot, Style};
use crate::simulate::result::{PairState, Profile, Run};

/// Several models of the same pair under the same conditions.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Models {
    /// Free text of the study.
    pub title: String,
    /// What was run, in one line.
    pub conditions: String,
    /// What the comparison shows, in a sentence or two.
    pub conclusion: String,
    /// A, B, D, E on the path of contact, mm from the pitch point.
    pub path_limits: [f64; 4],
    /// The models, in the order they are to be shown.
    pub models: Vec<ModelColumn>,
    /// What differs, by how much, and why.
    pub differences: Vec<Difference>,
}

/// One model's curves along the path of contact, mm from the pitch point.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModelColumn {
    /// `fem`, `hertz` or `paper`.
    pub name: String,
    /// What it assumes.
    pub assumptions: String,
    /// Largest contact pressure of one pair, MPa, unworn.
    pub pressure: Vec<(f64, f64)>,
    /// Load share of one pair, unworn.
    pub load_share: Vec<(f64, f64)>,
    /// Worn depth of the pinion at the end, µm.
    pub pinion_depth: Vec<(f64, f64)>,
    /// Worn depth of the gear at the end, µm.
    pub gear_depth: Vec<(f64, f64)>,
}

/// One quantity in all models.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Difference {
    /// What is compared, unit included.
    pub quantity: String,
    /// Its value in each model, in the order of `Models::models`; none where a model has no such value.
    pub values: Vec<Option<f64>>,
    /// Which assumption makes the values differ.
    pub cause: String,
}

impl ModelColumn {
    /// The curves of a run: contact of its first state, wear of its last.
    pub fn of_run(run: &Run, assumptions: &str) -> Self {
        let along_path = |value: fn(&PairState) -> f64| {
            let loaded = run.first().pairs().filter(|pair| pair.line_load > 0.0);
            let mut points: Vec<(f64, f64)> = loaded.map(|pair| (pair.path, value(pair))).collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            points
        };
        let depth = |flank: &Profile| {
            flank
                .path
                .iter()
                .copied()
                .zip(flank.depth.iter().copied())
                .collect()
        };
        ModelColumn {
            name: run.conditions.model.clone(),
            assumptions: assumptions.to_owned(),
            pressure: along_path(|pair| pair.peak_pressure),
            load_share: along_path(|pair| pair.load_share),
            pinion_depth: depth(&run.last().pinion),
            gear_depth: depth(&run.last().gear),
        }
    }
}

/// The page.
pub fn models(all: &Models) -> Page {
    let mut assumptions = Table::new("", ["model", "assumes"]);
    for model in &all.models {
        assumptions = assumptions.row([
            Cell::Code(model.name.clone()),
            Cell::text(model.assumptions.clone()),
        ]);
    }
    let mut head = vec!["quantity"];
    head.extend(all.models.iter().map(|model| model.name.as_str()));
    head.push("cause of the difference");
    let mut differences = Table::new("", head);
    for difference in &all.differences {
        let mut row = vec![Cell::text(difference.quantity.clone())];
        row.extend(
            difference
                .values
                .iter()
                .map(|value| Cell::number(value.map_or("–".to_owned(), |v| significant(v, 4)))),
        );
        row.push(Cell::text(difference.cause.clone()));
        differences = differences.row(row);
    }
    Page {
        title: if all.title.is_empty() {
            "Contact models side by side".to_owned()
        } else {
            all.title.clone()
        },
        kicker: all.conditions.clone(),
        conclusion: all.conclusion.clone(),
        sections: vec![
            Section::new("What differs and why").table(differences),
            Section::new("Curves").plots(plots(all)),
            Section::new("What each model assumes").table(assumptions),
        ],
    }
}

/// Pressure, load share and wear of both members, one curve per model.
fn plots(all: &Models) -> Vec<Plot> {
    const PATH: &str = "distance along the path of contact from the pitch point, mm";
    type Column = fn(&ModelColumn) -> &Vec<(f64, f64)>;
    let kinds: [(&str, &str, &str, Column); 4] = [
        (
            "models_pressure",
            "Largest contact pressure of one pair, unworn",
            "peak pressure, MPa",
            |m| &m.pressure,
        ),
        (
            "models_load_share",
            "Share of the load that one pair carries, unworn",
            "load share, -",
            |m| &m.load_share,
        ),
        (
            "models_wear_pinion",
            "Worn depth of the pinion",
            "worn depth, µm",
            |m| &m.pinion_depth,
        ),
        (
            "models_wear_gear",
            "Worn depth of the gear",
            "worn depth, µm",
            |m| &m.gear_depth,
        ),
    ];
    let [a, b, d, e] = all.path_limits;
    let letters = [(a, "A"), (b, "B"), (0.0, "C"), (d, "D"), (e, "E")]
        .map(|(at, letter)| (at, letter.to_owned()));
    kinds
        .into_iter()
        .map(|(name, title, y_label, column)| {
            let empty = Plot::new(name, title, PATH, y_label)
                .with_marks(letters.clone())
                .starting_at_zero();
            all.models
                .iter()
                .enumerate()
                .fold(empty, |plot, (kind, model)| {
                    plot.curve(&model.name, Style::Kind(kind), column(model).clone())
                })
        })
        .filter(|plot| !plot.is_empty())
        .collect()
}
