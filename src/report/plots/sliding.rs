//! Sliding along the path of contact.
use super::run::{PATH, letters};
use super::{Plot, Style};
use crate::simulate::result::{Member, Run};
use crate::tribology::sliding::Kinematics;

/// Points along the path of contact.
const POINTS: usize = 101;

/// Sliding speed, and the specific sliding of both flanks.
pub(super) fn of_run(run: &Run) -> [Plot; 2] {
    let g = &run.geometry;
    let kinematics = Kinematics {
        base_radius: [g.pinion.base_radius, g.gear.base_radius],
        operating_angle: g.working_pressure_angle_deg.to_radians(),
        pinion_speed: run.conditions.speed_rpm * std::f64::consts::TAU / 60.0,
    };
    let [a, .., e] = g.path_limits;
    let path = |i: usize| a + (e - a) * i as f64 / (POINTS - 1) as f64;
    let along = |value: &dyn Fn(f64) -> f64| -> Vec<(f64, f64)> {
        (0..POINTS).map(|i| (path(i), value(path(i)))).collect()
    };
    let speed = Plot::new(
        "sliding_speed",
        "Sliding speed of the flanks",
        PATH,
        "sliding speed, m/s",
    )
    .with_marks(letters(run))
    .curve(
        "pinion less gear",
        Style::Line(0),
        along(&|y| 1e-3 * kinematics.motion(y).sliding()),
    );
    let mut specific = Plot::new(
        "specific_sliding",
        "Specific sliding: sliding over each flank's own rolling speed",
        PATH,
        "specific sliding, -",
    )
    .with_marks(letters(run));
    for (kind, member) in Member::BOTH.into_iter().enumerate() {
        let sign = [1.0, -1.0][kind];
        let value = |y: f64| {
            let motion = kinematics.motion(y);
            sign * motion.sliding() / motion.rolling[kind]
        };
        specific = specific.curve(member.name(), Style::Kind(kind), along(&value));
    }
    [speed, specific]
}
