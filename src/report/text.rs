//! What a run found, in words: the conclusion of its report and the summary in the terminal.

mod friction;
mod peak;
mod plausibility;
mod summary;

pub(super) use self::friction::{
    in_contact as friction_in_contact, of_flash as friction_of_flash,
    of_losses as friction_of_losses, warmed_teeth,
};
pub(super) use self::peak::{at_kinks, elsewhere};
use self::plausibility::implausible;
pub use self::summary::summary;
use crate::gear::{Coupling, JAM_TOLERANCE};
use crate::numeric::written::{count, plain, significant};
use crate::simulate::result::{Member, Run, State};

/// What to say of the load across helical gears; figures of validation/face3d.
pub(super) fn across_helical_gears(run: &Run) -> Option<&'static str> {
    run.geometry.helix.as_ref()?;
    Some(if slices_are_tied(run) { TIED } else { UNTIED })
}

/// Whether slices are tied by the teeth; the analytic contact model has none that could.
pub(super) fn slices_are_tied(run: &Run) -> bool {
    run.mesh.is_some() && run.made.face.coupling == Coupling::Teeth
}

const UNTIED: &str = "slices of helical gears that are not tied to their neighbours carry too little where contact lines end: the largest load across the face came out \
     11 to 27 % low at single positions of a pair solved in three dimensions (guide/face.md)";
const TIED: &str = "where contact lines end, slices tied by the teeth carry more than a pair solved in three dimensions does: the largest load across the face came out \
     3 to 5 % high at single positions (guide/face.md)";

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
    let mut sentences: Vec<String> = failed_checks(run).into_iter().collect();
    if run.last().cycles > 0.0 {
        sentences.extend(wear(run));
    }
    sentences.extend(peak::sentence(run));
    sentences.extend(corner_pressure(run).map(|(new, worn)| {
        format!(
            "Where a tip corner touches, its mean over 0.02 modules is {}; under the sharp corner itself it has no bound.",
            new_and_worn(run, new, worn, "MPa")
        )
    }));
    sentences.extend(transmission_error(run));
    let warnings = implausible(run).into_iter();
    sentences.extend(warnings.map(|words| format!("Warning: {words}.")));
    sentences.extend(see_checks(run));
    sentences.join(" ")
}

/// How deep both flanks are worn; where the face has slices, in the mean and where they are worn most.
fn wear(run: &Run) -> Vec<String> {
    let last = run.last();
    let [pinion, gear] = Member::BOTH.map(|member| {
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
    let mut sentences = vec![format!(
        "After {} pinion revolutions wear has lowered {pinion} and {gear}.",
        count(last.cycles),
    )];
    sentences.extend(Member::BOTH.into_iter().filter_map(|member| {
        let flank = last.profile(member);
        let below = flank.deepest_below_corner(run.geometry.module)?;
        Some(format!(
            "Of the {} that is the sharp tip corner, which wears the deeper the finer its mesh; below it the flank is worn by up to {} µm.",
            member.name(),
            significant(flank.depth[below], 3)
        ))
    }));
    let across = |member: Member| {
        let words = deepest_on_the_face(last, member)?;
        Some(format!("the {} by {words}", member.name()))
    };
    if let (Some(pinion), Some(gear)) = (across(Member::Pinion), across(Member::Gear)) {
        sentences.push(format!(
            "These are means over the face: across it wear has lowered {pinion} and {gear}."
        ));
    }
    let worst = |member: Member| {
        let worst = last.worst_tooth(member)?;
        let depth = significant(worst.deepest(), 3);
        Some(format!(
            "{} tooth {} by up to {depth} µm",
            member.name(),
            worst.teeth[0]
        ))
    };
    let worst: Vec<String> = Member::BOTH.into_iter().filter_map(worst).collect();
    if !worst.is_empty() {
        sentences.push(format!(
            "These are mean teeth; the most worn single ones: {}.",
            worst.join(", ")
        ));
    }
    sentences
}

/// The transmission error, new and worn.
fn transmission_error(run: &Run) -> Option<String> {
    let [new, worn] = [run.first(), run.last()].map(State::te_peak_to_peak_urad);
    let (new, worn) = (new?, worn?);
    Some(if run.states.len() > 1 {
        format!(
            "The transmission error, peak to peak at the pinion, went from {} to {} µrad.",
            significant(new, 4),
            significant(worn, 4)
        )
    } else {
        format!(
            "The transmission error is {} µrad peak to peak at the pinion.",
            significant(new, 4)
        )
    })
}

/// How many of the run's own checks failed.
fn see_checks(run: &Run) -> Option<String> {
    let failed = run.checks.iter().filter(|check| !check.passed()).count();
    let verb = if failed == 1 {
        "check of the run on itself failed"
    } else {
        "checks of the run on itself failed"
    };
    (failed > 0).then(|| format!("{failed} {verb}: see Checks before using these figures."))
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
