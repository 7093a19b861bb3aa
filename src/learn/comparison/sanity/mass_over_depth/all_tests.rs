//! One factor between masses and depths that all tests have: twice or half, of both members or of one, and that of a number of the study.

use super::{NEAR, Part, SEVERAL, SHAPE, times};
use crate::measure::Subject;
use crate::numeric::median;
use crate::numeric::written::significant;
use crate::study::Study;

/// How far both members' factors in all tests may be apart, in ln, to be one, and from which it is no law's.
const ONE_FACTOR: f64 = 0.05;
const NO_LAW: f64 = 0.15;

/// What there is to ask of a factor that all tests have.
pub(super) fn question(study: &Study, parts: &[Part]) -> Option<String> {
    of_all(parts)
        .or_else(|| of_one_member(parts))
        .or_else(|| of_the_study(study, parts))
}

/// Masses of every test twice, or half, what the depths make up.
fn of_all(parts: &[Part]) -> Option<String> {
    let two = 2f64.ln();
    let first = parts.first()?;
    let sign = first.ratio.signum();
    let is_two = |p: &Part| (sign * p.ratio - two).abs() < NEAR;
    let both = parts.iter().any(|p| p.member != first.member);
    (both && parts.iter().all(is_two)).then(|| {
        let by = times(parts.iter().map(|p| p.ratio));
        let hint = if sign > 0.0 {
            "are these the losses of both flanks, or the depths halved, as of a change of thickness?"
        } else {
            "are the masses halved, or the depths those of both flanks together, as a change of thickness is?"
        };
        format!("all masses are {by} times what the depths make up: {hint}")
    })
}

/// One member's depths of every test twice, or half, what its masses make up, where the other member's are right.
fn of_one_member(parts: &[Part]) -> Option<String> {
    let of = |member: Subject| -> Vec<f64> {
        let own = parts.iter().filter(|p| p.member == member);
        own.map(|p| -p.ratio).collect()
    };
    let near = |all: &[f64], log: f64| {
        all.len() > 1 && all.iter().all(|depths| (depths - log).abs() < NEAR)
    };
    let [pinion, gear] = [Subject::Pinion, Subject::Gear].map(of);
    let members = [("pinion", &pinion, &gear), ("gear", &gear, &pinion)];
    let twice = 2f64.ln();
    let found = members.into_iter().find_map(|(name, own, other)| {
        let log = [twice, -twice].into_iter().find(|log| near(own, *log))?;
        near(other, 0.0).then_some((name, own, log))
    });
    let (name, own, log) = found?;
    let hint = if log > 0.0 {
        "those of both flanks together, as a change of thickness or of diameter is"
    } else {
        "halved"
    };
    Some(format!(
        "the {name}'s depths are {} times what its masses make up, and the other member's agree with theirs: are they {hint}?",
        times(own.iter().copied())
    ))
}

/// Masses of both members that are one factor off what the depths make up in all tests: no law does that, a number of the study does.
fn of_the_study(study: &Study, parts: &[Part]) -> Option<String> {
    let both = [Subject::Pinion, Subject::Gear].map(|member| {
        let own = parts.iter().filter(|p| p.member == member);
        own.count() >= SEVERAL
    });
    let middle = median(parts.iter().map(|p| p.ratio).collect())?;
    let ratios = || parts.iter().map(|p| p.ratio);
    let spread = ratios().fold(f64::MIN, f64::max) - ratios().fold(f64::MAX, f64::min);
    let is_one = spread < ONE_FACTOR && parts.iter().all(|p| p.explains > SHAPE);
    if both.contains(&false) || middle.abs() < NO_LAW || !is_one {
        return None;
    }
    let width = study.gears.face_width;
    Some(format!(
        "the masses of both members are {} times what their depths make up, in all tests alike: is the study's face_width right? With {} mm in place of {} \
         mm they would agree; else look at the densities, and whether the traces stand for the whole face",
        significant(middle.exp(), 3),
        significant(width * middle.exp(), 3),
        significant(width, 3)
    ))
}
