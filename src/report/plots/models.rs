//! Plots of the contact models side by side, at one misalignment.
use super::{Plot, Style};
use crate::simulate::models::{ContactCurve, Flank, Kind, ModelResult, Mounted};

/// Pressure, load share and wear along the path of contact, one curve per model.
pub fn of_models(mounted: &Mounted) -> Vec<Plot> {
    let elastic = &[Kind::Hertz, Kind::Fem];
    let mut plots = vec![
        contact(
            mounted,
            (
                "pressure",
                "Peak pressure away from the tip corners, unworn flanks",
                "peak pressure, MPa",
            ),
            false,
            |curve| &curve.peak_pressure,
        ),
        contact(
            mounted,
            (
                "load_share",
                "Share of the torque carried by one pair, unworn flanks",
                "load share, -",
            ),
            true,
            |curve| &curve.load_share,
        ),
        wear(
            mounted,
            (
                "wear_pinion",
                "Worn depth of the pinion, finite-element and Hertz models",
            ),
            elastic,
            |model| Some(&model.pinion),
        ),
        wear(
            mounted,
            (
                "wear_gear",
                "Worn depth of the gear, finite-element and Hertz models",
            ),
            elastic,
            |model| model.gear.as_ref(),
        ),
        contact(
            mounted,
            (
                "pressure_corners",
                "Peak pressure including the sharp tip corners, unworn flanks",
                "peak pressure, MPa",
            ),
            true,
            |curve| &curve.peak_pressure,
        ),
    ];
    if mounted.model(Kind::Paper).is_some() {
        plots.push(wear(
            mounted,
            ("wear_pinion_paper", "Worn depth of the pinion, all models"),
            &[Kind::Paper, Kind::Hertz, Kind::Fem],
            |model| Some(&model.pinion),
        ));
    }
    plots.retain(|plot| !plot.is_empty());
    plots
}

/// An empty plot along the path of contact; `name` is completed by the misalignment.
fn empty(mounted: &Mounted, name: &str, title: &str, y_label: &str) -> Plot {
    let [a, b, d, e] = mounted.geometry.path_limits;
    let letters = [(a, "A"), (b, "B"), (0.0, "C"), (d, "D"), (e, "E")];
    Plot::new(
        &format!("{name}_misalignment_{}", mounted.misalignment),
        &format!("{title}, misalignment {}\u{a0}mm", mounted.misalignment),
        "distance along the path of contact from the pitch point, mm",
        y_label,
    )
    .with_marks(letters.map(|(at, letter)| (at, letter.to_owned())))
    .starting_at_zero()
}

/// Part of the path of contact at either end in which tip corners raise the pressure.
const NEAR_CORNER: f64 = 0.03;

/// A column of the unworn contact; with `corners` also where tip corners touch, on and off the line of action.
fn contact(
    mounted: &Mounted,
    (name, title, y_label): (&str, &str, &str),
    corners: bool,
    column: fn(&ContactCurve) -> &Vec<f64>,
) -> Plot {
    let plot = empty(mounted, name, title, y_label);
    mounted.models.iter().fold(plot, |plot, model| {
        let curve = &model.contact;
        let [a, .., e] = mounted.geometry.path_limits;
        let margin = NEAR_CORNER * (e - a);
        let inner = a + margin..=e - margin;
        let shown = (0..curve.path.len()).filter(|&i| corners || inner.contains(&curve.path[i]));
        let points = shown.map(|i| (curve.path[i], column(curve)[i])).collect();
        plot.curve(model.kind.name(), style(model.kind), points)
    })
}

/// Worn depths of some models.
fn wear(
    mounted: &Mounted,
    (name, title): (&str, &str),
    kinds: &[Kind],
    flank: fn(&ModelResult) -> Option<&Flank>,
) -> Plot {
    let plot = empty(mounted, name, title, "worn depth, µm");
    let shown = mounted.models.iter().filter(|m| kinds.contains(&m.kind));
    shown.fold(plot, |plot, model| {
        let points = |f: &Flank| {
            f.path
                .iter()
                .copied()
                .zip(f.depth_um.iter().copied())
                .collect()
        };
        let points = flank(model).map(points).unwrap_or_default();
        plot.curve(model.kind.name(), style(model.kind), points)
    })
}

/// The same colour for a model in all plots.
fn style(kind: Kind) -> Style {
    Style::Kind(match kind {
        Kind::Fem => 0,
        Kind::Hertz => 1,
        Kind::Paper => 2,
    })
}
