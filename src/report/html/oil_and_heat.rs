//! The section of a run's page on film, flash temperature and losses.

use super::page::Section;
use crate::numeric::written::{percent, significant};
use crate::report::{plots, text};
use crate::simulate::result::Run;

/// What is missing in the study for each of the figures, with the keys that give it.
const MISSING: [(&str, &str); 3] = [
    (
        "the film ratio",
        "`viscosity`, `pressure_viscosity` and `roughness` in `[lubricant]`",
    ),
    (
        "the flash temperature",
        "`friction_coefficient` in `[lubricant]`, `conductivity` and `specific_heat` in `[thermal]`",
    ),
    (
        "friction losses",
        "`viscosity` and `roughness`, or `friction_coefficient`, in `[lubricant]`",
    ),
];

/// Film ratio, flash temperature and friction losses along the path of contact, or what the study would have to state for them.
pub(super) fn oil_and_heat(run: &Run) -> Section {
    let plots = plots::oil_and_heat_of_run(run);
    let mut section = Section::new("Film, heat and losses");
    if !plots.is_empty() {
        section = section.with_slider().plots(plots);
    }
    let (first, last) = (run.first(), run.last());
    let figures = [
        (
            "least film ratio",
            first.least_film_ratio().zip(last.least_film_ratio()),
            "",
        ),
        (
            "largest flash temperature",
            (first.largest_flash_temperature()).zip(last.largest_flash_temperature()),
            " K",
        ),
    ];
    for (name, figure, unit) in figures {
        if let Some((new, worn)) = figure {
            let [new, worn] = [new, worn].map(|(value, _)| significant(value, 3));
            let value = format!("{new} → {worn}{unit}");
            section
                .key_figures
                .push((format!("{name}, new → worn"), value));
        }
    }
    if let Some((new, worn)) = first.friction_power().zip(last.friction_power()) {
        let c = &run.conditions;
        let driving = 1e-3 * c.torque * c.speed_rpm * std::f64::consts::TAU / 60.0;
        let value = format!(
            "{} → {} W of {} W ({})",
            significant(new, 3),
            significant(worn, 3),
            significant(driving, 3),
            percent(worn / driving, 2)
        );
        section
            .key_figures
            .push(("friction between the teeth, new → worn".to_owned(), value));
    }
    let stated = [
        last.least_film_ratio().is_some(),
        last.largest_flash_temperature().is_some(),
        last.friction_power().is_some(),
    ];
    let missing = MISSING.iter().zip(stated).filter(|(_, stated)| !stated);
    let missing: Vec<String> = missing
        .map(|((what, keys), _)| format!("{what}: {keys}"))
        .collect();
    if run.conditions.model == "paper" {
        return section.note("The published model has no film, heat or losses.");
    }
    if !missing.is_empty() {
        section = section.paragraph(format!("Not stated in the study: {}.", missing.join("; ")));
    }
    let flash =
        text::friction_of_flash(run).map_or(String::new(), |words| format!(", friction {words}"));
    section.note(format!(
        "Film: Dowson and Higginson. Flash temperature: Blok's{flash}. Losses: sliding between the teeth alone \
         (no churning, no bearings), friction {}. Friction in the contact itself: {}.",
        text::friction_of_losses(run),
        text::friction_in_contact(run)
    ))
}
