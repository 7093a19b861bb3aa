//! The summary of a run in the terminal.

use std::path::Path;

use super::friction::warmed_teeth;
use super::peak::{KINK, at_kinks, elsewhere};
use super::plausibility::implausible;
use super::{
    across_helical_gears, asked_for, corner_pressure, deepest_on_the_face, failed_checks, jammed,
    new_and_worn,
};
use crate::numeric::written::{duration, percent, significant, whole};
use crate::simulate::numerics::FEW_EDGES;
use crate::simulate::result::{Member, Run, State};

/// A few lines for the terminal: the figures that matter, where the files are, what to do next.
pub fn summary(run: &Run, study: &Path, folder: &Path) -> String {
    let mut lines = head(run);
    for member in Member::BOTH {
        lines.extend(wear(run, member));
    }
    lines.extend(new_and_worn_figures(run));
    lines.extend(worst_teeth(run.last()));
    lines.extend(warmed_teeth(run).map(|words| row("tooth temperature", &words)));
    lines.push(row("area balance", &percent(run.balance_error, 2)));
    lines.extend(
        implausible(run)
            .iter()
            .map(|words| format!("  warning: {words}")),
    );
    lines.extend(notes(run).map(|words| format!("  note: {words}")));
    lines.push(row("cost", &cost(run)));
    lines.push(String::new());
    lines.extend(files(run, folder));
    lines.extend(next(run, study));
    lines.push(String::new());
    lines.join("\n")
}

/// A line with the name of a figure before it.
fn row(name: &str, words: &str) -> String {
    format!("  {name:<20}{words}")
}

/// Title, what was run, and whether it can be relied on.
fn head(run: &Run) -> Vec<String> {
    let mut lines = Vec::new();
    if !run.title.is_empty() {
        lines.push(run.title.clone());
    }
    lines.push(asked_for(run));
    lines.push(String::new());
    if let Some(failed) = failed_checks(run) {
        lines.push(failed);
        lines.push(String::new());
    }
    lines
}

/// How deep `member` is worn and what it lost.
fn wear(run: &Run, member: Member) -> impl Iterator<Item = String> {
    let last = run.last();
    let flank = last.profile(member);
    let place = match flank.deepest().filter(|_| flank.max_depth() > 0.0) {
        Some(i) => format!(" at radius {} mm", significant(flank.radius[i], 5)),
        None => String::new(),
    };
    let worn = format!(
        "{} µm{place}, {} mg lost",
        significant(flank.max_depth(), 4),
        significant(flank.mass_loss_mg, 4)
    );
    let across = deepest_on_the_face(last, member);
    let below_corner = flank.deepest_below_corner(run.geometry.module).map(|i| {
        let [depth, radius] =
            [(flank.depth[i], 4), (flank.radius[i], 5)].map(|(v, n)| significant(v, n));
        let words = format!(
            "{depth} µm at radius {radius} mm; a sharp corner wears the deeper the finer its mesh"
        );
        row("  below the corner", &words)
    });
    std::iter::once(row(&format!("{} wear", member.name()), &worn))
        .chain(below_corner)
        .chain(across.map(|words| row("  across the face", &words)))
}

/// An angle of the gear as the pinion sees it; measured transmission errors are the gear's own.
fn at_the_pinion(line: String) -> String {
    line + " (at the pinion)"
}

/// What wear has changed of the contact: each figure of the new and of the worn flanks.
fn new_and_worn_figures(run: &Run) -> Vec<String> {
    let (first, last) = (run.first(), run.last());
    let change = |name: &str, unit: &str, of: &dyn Fn(&State) -> Option<f64>| {
        let (first, last) = (of(first)?, of(last)?);
        Some(row(name, &new_and_worn(run, first, last, unit)))
    };
    let corner = corner_pressure(run).map(|(new, worn)| {
        let pressures = new_and_worn(run, new, worn, "MPa");
        row(
            "  at a tip corner",
            &format!("{pressures} (mean over 0.02 modules)"),
        )
    });
    let kinks = at_kinks(run).map(|(new, worn)| {
        let pressures = new_and_worn(run, new, worn, "MPa");
        row("  at a kink", &format!("{pressures} ({KINK})"))
    });
    let face_load_factor = |state: &State| {
        let has_slices = !last.slices.is_empty();
        has_slices.then(|| state.face_load_factor())
    };
    [
        change("peak pressure", "MPa", &elsewhere),
        kinks,
        corner,
        change("transmission error", "µrad p-p", &|state| {
            state.te_peak_to_peak_urad()
        })
        .map(at_the_pinion),
        change("  over one turn", "µrad p-p", &|state| {
            state.te_over_a_turn_urad()
        })
        .map(at_the_pinion),
        change("face load factor", "", &face_load_factor),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The most worn tooth of each member whose teeth differ.
fn worst_teeth(last: &State) -> impl Iterator<Item = String> {
    Member::BOTH.into_iter().filter_map(|member| {
        let worst = last.worst_tooth(member)?;
        let words = format!(
            "{} µm, tooth {}; the depth above is the mean tooth's",
            significant(worst.deepest(), 4),
            worst.teeth[0]
        );
        Some(row(&format!("worst {} tooth", member.name()), &words))
    })
}

/// What limits the figures.
fn notes(run: &Run) -> impl Iterator<Item = String> {
    let mesh = run.mesh.as_ref().map(|[pinion, _]| pinion);
    let few_edges = mesh.filter(|mesh| mesh.edges_per_half_width < FEW_EDGES);
    let few_edges = few_edges.map(|mesh| {
        format!(
            "{} flank edges on Hertz's half width are few: depths are right, peak pressures rough, on new flanks and worn ones; \
             [numerics] elements_per_half_width = 5 is usual",
            significant(mesh.edges_per_half_width, 2)
        )
    });
    let linear = mesh.filter(|mesh| mesh.element == "T3");
    [
        jammed(run),
        few_edges,
        linear.map(|_| LINEAR.to_owned()),
        few_slices(run),
        across_helical_gears(run).map(str::to_owned),
    ]
    .into_iter()
    .flatten()
}

fn cost(run: &Run) -> String {
    let cost = &run.cost;
    format!(
        "{} on {}, {} wear steps, {} contact solves",
        duration(cost.seconds),
        match cost.threads {
            1 => "1 thread".to_owned(),
            n => format!("{n} threads"),
        },
        whole(cost.wear_steps),
        whole(cost.contact_solves)
    )
}

/// Where the results are, and what opens them.
fn files(run: &Run, folder: &Path) -> Vec<String> {
    let mut lines = vec![
        format!("Written to {}", folder.display()),
        "  report.html          open in a browser".to_owned(),
    ];
    if !run.fields.is_empty() {
        lines.push("  fields/wear.pvd      open in ParaView".to_owned());
        if !run.last().slices.is_empty() {
            lines.push(
                "  fields/flanks.pvd    the same, depth and pressure over both flanks".to_owned(),
            );
        }
    }
    lines
}

/// What to do next, where there is something.
fn next(run: &Run, study: &Path) -> Option<String> {
    let last = run.last();
    if failed_checks(run).is_some() {
        return Some("Next: read Checks in report.html before using the figures".to_owned());
    }
    let teeth_are_alike = last.teeth.is_empty() && last.te_over_a_turn_urad().is_none();
    let can_be_compared = last.cycles > 0.0 && last.slices.is_empty() && teeth_are_alike;
    if !can_be_compared {
        return None;
    }
    let what = if run.conditions.model == "fem" {
        "how the analytic models differ, and why"
    } else {
        "what solving the contact by finite elements changes, and why"
    };
    Some(format!(
        "Next: gearwear models {} shows {what}{}",
        study.display(),
        match run.conditions.test {
            Some(_) => ", at the study's own operation",
            None => "",
        }
    ))
}

/// What to say of linear elements; figures of `gearwear init` with `order = 1` and 2, one `gearwear run` each.
const LINEAR: &str = "linear elements (numerics.order = 1): peak pressures of new flanks came out 13 % high on the pair of a published study, 6 % once worn; \
     depths and the transmission error are within 3 %";

/// Slices of helical gears for each base pitch of overlap below which depths and the swing of the lag are some per cent off (guide/face.md).
const FEW_SLICES: f64 = 5.0;

/// What to say of helical gears whose slices stand far apart along the path of contact.
fn few_slices(run: &Run) -> Option<String> {
    let overlap = run.geometry.helix.as_ref()?.overlap_ratio;
    let slices = run.states.last()?.slices.len() as f64;
    (slices < FEW_SLICES * overlap).then(|| {
        format!(
            "{slices} slices for an overlap ratio of {}: neighbours stand {} base pitches apart, and the steps between them show in the transmission \
             error; {} or more in [face] smooth them",
            significant(overlap, 3),
            significant(overlap / slices, 2),
            whole((2.0 * FEW_SLICES * overlap).ceil() as usize)
        )
    })
}
