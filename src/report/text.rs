//! What a run found, in words: the conclusion of its report and the summary in the terminal.
use std::path::Path;

use super::format::{count, duration, percent, plain, significant, whole};
use crate::gear::JAM_TOLERANCE;
use crate::simulate::result::{Member, Run, State};

/// A few lines for the terminal: the figures that matter, where the files are, what to do next.
pub fn summary(run: &Run, study: &Path, folder: &Path) -> String {
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
    let (first, last) = (run.first(), run.last());
    for member in Member::BOTH {
        let flank = last.profile(member);
        let place = match flank.deepest().filter(|_| flank.max_depth() > 0.0) {
            Some(i) => format!(" at radius {} mm", significant(flank.radius[i], 5)),
            None => String::new(),
        };
        lines.push(format!(
            "  {:<20}{} µm{place}, {} mg lost",
            format!("{} wear", member.name()),
            significant(flank.max_depth(), 4),
            significant(flank.mass_loss_mg, 4)
        ));
        lines.extend(
            deepest_on_the_face(last, member)
                .map(|words| format!("  {:<20}{words}", "  across the face")),
        );
    }
    let change = |name: &str, unit: &str, first: Option<f64>, last: Option<f64>| {
        let (first, last) = (first?, last?);
        Some(format!(
            "  {name:<20}{}",
            new_and_worn(run, first, last, unit)
        ))
    };
    let pressure = |state: &State| state.peak_pressure().map(|p| p.0);
    lines.extend(change(
        "peak pressure",
        "MPa",
        pressure(first),
        pressure(last),
    ));
    lines.extend(corner_pressure(run).map(|(new, worn)| {
        format!(
            "  {:<20}{} (mean over 0.02 modules)",
            "  at a tip corner",
            new_and_worn(run, new, worn, "MPa")
        )
    }));
    let te = (first.te_peak_to_peak_urad(), last.te_peak_to_peak_urad());
    lines.extend(change("transmission error", "µrad p-p", te.0, te.1));
    let turn = (first.te_over_a_turn_urad(), last.te_over_a_turn_urad());
    lines.extend(change("  over one turn", "µrad p-p", turn.0, turn.1));
    if !last.slices.is_empty() {
        let factors = (first.face_load_factor(), last.face_load_factor());
        lines.extend(change(
            "face load factor",
            "",
            Some(factors.0),
            Some(factors.1),
        ));
    }
    for member in Member::BOTH {
        if let Some(worst) = last.worst_tooth(member) {
            lines.push(format!(
                "  {:<20}{} µm, tooth {}; the depth above is the mean tooth's",
                format!("worst {} tooth", member.name()),
                significant(worst.deepest(), 4),
                worst.teeth[0]
            ));
        }
    }
    lines.push(format!(
        "  {:<20}{}",
        "area balance",
        percent(run.balance_error, 2)
    ));
    lines.extend(jammed(run).map(|words| format!("  note: {words}")));
    if let Some([mesh, _]) = &run.mesh
        && mesh.edges_per_half_width < FEW_EDGES
    {
        lines.push(format!(
            "  note: {} flank edges on Hertz's half width: contacts of the new flanks are too narrow to be resolved better; depths are \
             right, peak pressures at 0 cycles are rough",
            significant(mesh.edges_per_half_width, 2)
        ));
    }
    if let Some([mesh, _]) = &run.mesh
        && mesh.element == "T3"
    {
        lines.push(format!("  note: {LINEAR}"));
    }
    lines.extend(few_slices(run).map(|words| format!("  note: {words}")));
    if run.geometry.helix.is_some() {
        lines.push(format!("  note: {HELICAL_SLICES}"));
    }
    let cost = &run.cost;
    lines.push(format!(
        "  {:<20}{} on {}, {} wear steps, {} contact solves",
        "cost",
        duration(cost.seconds),
        match cost.threads {
            1 => "1 thread".to_owned(),
            n => format!("{n} threads"),
        },
        whole(cost.wear_steps),
        whole(cost.contact_solves)
    ));
    lines.push(String::new());
    lines.push(format!("Written to {}", folder.display()));
    lines.push("  report.html          open in a browser".to_owned());
    if !run.fields.is_empty() {
        lines.push("  fields/wear.pvd      open in ParaView".to_owned());
        if !last.slices.is_empty() {
            lines.push(
                "  fields/flanks.pvd    the same, depth and pressure over both flanks".to_owned(),
            );
        }
    }
    if failed_checks(run).is_some() {
        lines.push("Next: read Checks in report.html before using the figures".to_owned());
    } else if last.cycles > 0.0 && last.slices.is_empty() {
        let what = if run.conditions.model == "fem" {
            "how the analytic models differ, and why"
        } else {
            "what solving the contact by finite elements changes, and why"
        };
        lines.push(format!(
            "Next: gearwear models {} shows {what}{}",
            study.display(),
            match run.conditions.test {
                Some(_) => ", at the study's own operation",
                None => "",
            }
        ));
    }
    lines.push(String::new());
    lines.join("\n")
}

/// Edges per half width below which peak pressures of new flanks are more than some per cent off.
const FEW_EDGES: f64 = 3.0;

/// What to say of linear elements; figures of `gearwear init` with `order = 1` and 2, one `gearwear run` each.
const LINEAR: &str = "linear elements (numerics.order = 1): peak pressures of new flanks came out 13 % high on the pair of a published study, 6 % once worn; \
     depths and the transmission error are within 3 %";

/// Slices of helical gears for each base pitch of overlap below which depths and the swing of the lag are some per cent off (guide/face.md).
const FEW_SLICES: f64 = 5.0;

/// What to say of the load across helical gears; figures of validation/face3d.
pub(super) const HELICAL_SLICES: &str = "slices of helical gears are not tied to their neighbours and carry too little where contact lines end: the largest load across the face came out \
     11 to 27 % low at single positions of a pair solved in three dimensions (guide/face.md)";

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

/// What to say of gears whose axes effects have moved closer than teeth of full thickness allow.
pub(super) fn jammed(run: &Run) -> Option<String> {
    let overlap = -run.geometry.backlash_um;
    (overlap > 1e3 * JAM_TOLERANCE * run.geometry.module).then(|| {
        format!(
            "the effects bring the axes so close that teeth of full thickness would overlap by {} µm; they are taken to be thinner",
            significant(overlap, 3)
        )
    })
}

/// What was run, in one line.
pub fn asked_for(run: &Run) -> String {
    let c = &run.conditions;
    let g = &run.geometry;
    let module = match &g.helix {
        Some(helix) => format!(
            "normal module {} mm, helix angle {}°, {} mm wide",
            plain(g.module),
            plain(helix.angle_deg),
            plain(c.face_width)
        ),
        None => format!("module {} mm", plain(g.module)),
    };
    let mut line = format!(
        "{} and {} teeth, {module}, {} N·m at {} rpm, {} pinion revolutions, {} model",
        g.pinion.teeth,
        g.gear.teeth,
        plain(c.torque / 1000.0),
        plain(c.speed_rpm),
        count(c.cycles),
        c.model
    );
    if c.misalignment != 0.0 {
        line.push_str(&format!(", misalignment {} mm", plain(c.misalignment)));
    }
    if !c.effects.is_empty() {
        line.push_str(&format!(", with {}", c.effects.join(", ")));
    }
    if let Some(test) = &c.test {
        line.push_str(&format!(" (test {test})"));
    }
    line
}

/// That the run's own checks failed, which comes before all that it found.
fn failed_checks(run: &Run) -> Option<String> {
    let failed = run.checks.iter().filter(|check| !check.passed());
    let failed: Vec<String> = failed
        .map(|check| {
            let value = format!(
                "{} is {} {}",
                check.name,
                significant(check.value, 3),
                check.unit
            );
            format!(
                "{}, allowed {}",
                value.trim_end(),
                significant(check.limit, 3)
            )
        })
        .collect();
    (!failed.is_empty()).then(|| {
        format!(
            "This run fails its own check, so its figures are not to be relied on: {}.",
            failed.join("; ")
        )
    })
}

/// What came out, in two or three sentences.
pub fn conclusion(run: &Run) -> String {
    let (first, last) = (run.first(), run.last());
    let mut sentences: Vec<String> = failed_checks(run).into_iter().collect();
    if last.cycles > 0.0 {
        let wear = Member::BOTH.map(|member| {
            let flank = last.profile(member);
            let place = match flank.deepest().filter(|_| flank.max_depth() > 0.0) {
                Some(i) => format!(" ({})", region(run, flank.path[i])),
                None => String::new(),
            };
            format!(
                "the {} by up to {} µm{place}",
                member.name(),
                significant(flank.max_depth(), 3)
            )
        });
        sentences.push(format!(
            "After {} pinion revolutions wear has lowered {} and {}.",
            count(last.cycles),
            wear[0],
            wear[1]
        ));
        let across = |member: Member| {
            let words = deepest_on_the_face(last, member)?;
            Some(format!("the {} by {words}", member.name()))
        };
        if let (Some(pinion), Some(gear)) = (across(Member::Pinion), across(Member::Gear)) {
            sentences.push(format!(
                "These are means over the face: across it wear has lowered {pinion} and {gear}."
            ));
        }
    }
    if let (Some(new), Some(worn)) = (first.peak_pressure(), last.peak_pressure()) {
        if run.states.len() > 1 {
            sentences.push(format!(
                "The largest contact pressure on the flanks went from {} to {} MPa.",
                significant(new.0, 4),
                significant(worn.0, 4)
            ));
        } else {
            let place = region(run, new.1);
            sentences.push(format!(
                "The largest contact pressure on the flanks is {} MPa ({place}).",
                significant(new.0, 4)
            ));
        }
    }
    if let Some((new, worn)) = corner_pressure(run) {
        sentences.push(format!(
            "Where a tip corner touches, its mean over 0.02 modules is {}; under the sharp corner itself it has no bound.",
            new_and_worn(run, new, worn, "MPa")
        ));
    }
    if let (Some(new), Some(worn)) = (first.te_peak_to_peak_urad(), last.te_peak_to_peak_urad()) {
        if run.states.len() > 1 {
            sentences.push(format!(
                "The transmission error, peak to peak at the pinion, went from {} to {} µrad.",
                significant(new, 4),
                significant(worn, 4)
            ));
        } else {
            sentences.push(format!(
                "The transmission error is {} µrad peak to peak at the pinion.",
                significant(new, 4)
            ));
        }
    }
    let failed = run.checks.iter().filter(|check| !check.passed()).count();
    if failed > 0 {
        let verb = if failed == 1 {
            "check of the run on itself failed"
        } else {
            "checks of the run on itself failed"
        };
        sentences.push(format!(
            "{failed} {verb}: see Checks before using these figures."
        ));
    }
    sentences.join(" ")
}

/// Largest pressures at a tip corner in the first and in the last state, 0 where none touches; none if none does in either.
fn corner_pressure(run: &Run) -> Option<(f64, f64)> {
    let [new, worn] =
        [run.first(), run.last()].map(|state| state.corner_pressure().map_or(0.0, |p| p.0));
    (new > 0.0 || worn > 0.0).then_some((new, worn))
}

/// How deep `member` is worn where it is worn most across the face, in words; None for one section.
fn deepest_on_the_face(state: &State, member: Member) -> Option<String> {
    let (depth, face) = state.deepest_on_the_face(member)?;
    let (depth, face) = (significant(depth, 4), plain((100.0 * face).round() / 100.0));
    Some(format!("up to {depth} µm at {face} mm from mid-face"))
}

/// A figure of the first and of the last state, or the one figure of a run without wear; no `unit` for a plain number.
fn new_and_worn(run: &Run, new: f64, worn: f64, unit: &str) -> String {
    let [new, worn] = [new, worn].map(|figure| significant(figure, 4));
    let unit = if unit.is_empty() {
        String::new()
    } else {
        format!(" {unit}")
    };
    if run.states.len() > 1 {
        format!("{new}{unit} new, {worn}{unit} worn")
    } else {
        format!("{new}{unit}")
    }
}

/// Where on the path of contact a point lies, in words.
fn region(run: &Run, path: f64) -> &'static str {
    let [a, b, d, e] = run.geometry.path_limits;
    let near = 0.03 * (e - a);
    if (path - a).abs() <= near {
        "near the start of contact"
    } else if (path - e).abs() <= near {
        "near the end of contact"
    } else if path.abs() <= near {
        "at the pitch point"
    } else if path < a || path > e {
        "outside the nominal path of contact"
    } else if path < b.min(d) {
        "in the lower double contact"
    } else if path > d.max(b) {
        "in the upper double contact"
    } else if b > d {
        "where three pairs may touch"
    } else {
        "in single contact"
    }
}
