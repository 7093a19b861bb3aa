//! One pass over fresh flanks: the solved loads, the wear that they make and what a single point is worn by.

use std::f64::consts::PI;

use crate::analytic::archard_pass::pitch_point_depth;
use crate::analytic::hertz_line::{half_width, pressure};
use crate::contact::model::ContactModel;
use crate::gear::{Member, Pair};
use crate::numeric::interpolate;
use crate::simulate::wear_state::line_load;
use crate::verify::{CaseError, Measured};
use crate::wear::archard::ArchardSystem;
use crate::wear::integrator::WearSystem;

/// One wear rate of fresh flanks, and the loads that made it.
pub(super) struct FreshRate {
    /// Depth per pinion cycle and k at the stations of both flanks, N/mm.
    pub(super) rate: [Vec<f64>; 2],
    /// Path coordinates, ascending, and line loads there.
    path: Vec<f64>,
    load: Vec<f64>,
    /// ∮ F' |v| dt per pinion cycle and flank of the pinion, N (trapezoidal, from the loads alone).
    pub(super) sliding_work: f64,
}

impl FreshRate {
    pub(super) fn new(model: &dyn ContactModel) -> Result<Self, CaseError> {
        let cycle = model.cycle();
        let mut system = ArchardSystem::new(model, [1.0; 2]);
        let fresh = vec![0.0; cycle.stations.count()];
        let rate = system.rate(0.0, &fresh).map_err(CaseError::gears)?;
        let contacts = system.contacts(&fresh).map_err(CaseError::gears)?;
        let mut loads: Vec<[f64; 3]> = cycle
            .positions
            .iter()
            .zip(contacts)
            .flat_map(|(position, contact)| {
                position
                    .pairs
                    .iter()
                    .map(|p| [p.path, line_load(p, contact), p.slip.abs()])
            })
            .collect();
        loads.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let sliding_work = loads
            .windows(2)
            .map(|w| 0.5 * (w[1][0] - w[0][0]) * (w[0][1] * w[0][2] + w[1][1] * w[1][2]))
            .sum();
        let (pinion, gear) = rate.split_at(cycle.stations.arc[0].len());
        Ok(Self {
            rate: [pinion.to_vec(), gear.to_vec()],
            path: loads.iter().map(|l| l[0]).collect(),
            load: loads.iter().map(|l| l[1]).collect(),
            sliding_work,
        })
    }

    /// Depth per k that the point at arc `s` of `member` takes while contacts of the solved loads with Hertz's profile
    /// pass it, N/mm.
    ///
    /// ```text
    /// h/k = ∫ F'(y) |v(y)| w(s − s(y)) dy,   w(x) = 2/(π b) √(1 − x²/b²)
    /// ```
    fn passage(&self, pair: &Pair, member: Member, s: f64, modulus: f64) -> f64 {
        let gear = pair.member(member);
        let [a, .., e] = pair.path_points();
        let steps = 8000;
        let dy = (e - a) / f64::from(steps);
        let slide = (1.0 + 1.0 / pair.speed_ratio) / pair.pinion.base_radius;
        (0..steps)
            .map(|i| {
                let y = a + (f64::from(i) + 0.5) * dy;
                let load = interpolate(&self.path, &self.load, y);
                let b = half_width(load, pair.relative_radius(y), modulus);
                let x = gear.arc(pair.rho(member, y)) - s;
                if x.abs() >= b {
                    return 0.0;
                }
                load * slide * y.abs() * pressure(x, 2.0 / (PI * b), b) * dy
            })
            .sum()
    }
}

/// The wear of one pass, against the single-point observation.
pub(super) struct Pass<'a> {
    pub(super) fresh: &'a FreshRate,
    pub(super) pair: &'a Pair,
    /// Whole load along the common normal, N/mm.
    pub(super) load: f64,
    /// Contact modulus, MPa.
    pub(super) modulus: f64,
}

impl Pass<'_> {
    /// How often a tooth of `member` passes in a turn of the pinion.
    pub(super) fn per_cycle(&self, member: Member) -> f64 {
        match member {
            Member::Pinion => 1.0,
            Member::Gear => 1.0 / self.pair.speed_ratio,
        }
    }

    /// Hertz's width of the contact under the whole load at `path`, mm.
    fn width(&self, path: f64) -> f64 {
        2.0 * half_width(self.load, self.pair.relative_radius(path), self.modulus)
    }

    /// Largest deviations over the stations at `arc` of `member`'s flank where the load is steady, and where it changes within the width of the
    /// contact.
    pub(super) fn deviations(&self, member: Member, arc: &[f64], name: &str) -> [Measured; 2] {
        let (pair, fresh) = (self.pair, self.fresh);
        let [a, b, _, d, e] = pair.path_points();
        let gear = pair.member(member);
        let passes = self.per_cycle(member);
        let rates = &fresh.rate[usize::from(member == Member::Gear)];
        let (mut steady, mut changing) = ((0.0_f64, 0.0), (0.0_f64, 0.0));
        for (&s, &rate) in arc.iter().zip(rates) {
            let path = pair.path_at_rho(member, gear.rho_at_arc(s));
            // Hertz widths lie along the flank, where the contact is slower than along its path
            let away = |y: f64| {
                (gear.arc(pair.rho(member, y)) - s).abs()
                    > 2.0 * self.width(y).max(self.width(path))
            };
            if path < a || path > e || ![a, 0.0, e].into_iter().all(away) {
                continue;
            }
            let (worst, target) = if [b, d].into_iter().all(away) {
                let load = interpolate(&fresh.path, &fresh.load, path);
                (&mut steady, load * pair.sliding_ratio(member, path).abs())
            } else {
                let passage = fresh.passage(pair, member, s, self.modulus);
                (&mut changing, passage)
            };
            let error = (rate / (passes * target) - 1.0).abs();
            if error > worst.0 {
                *worst = (error, path);
            }
        }
        [
            ("two Hertz widths from A, B, C, D, E", steady),
            (
                "around B and D, load averaged over the width's passage",
                changing,
            ),
        ]
        .map(|(place, (error, path))| {
            Measured::bound(
                "F9",
                format!(
                    "{name} {member} wear per pass, {place}: largest deviation (at {path:+.2} mm)"
                ),
                error,
                0.03,
            )
        })
    }

    /// Depth of the pinion per k at the pitch point, whose stations are at `arc`.
    pub(super) fn at_pitch_point(&self, arc: &[f64], name: &str) -> Measured {
        let pair = self.pair;
        let bump = interpolate(arc, &self.fresh.rate[0], pair.pinion.arc(pair.rho_c));
        let ratio = 1.0 / pair.speed_ratio;
        let (base, rho) = (pair.pinion.base_radius, pair.rho_c);
        let target = pitch_point_depth(1.0, self.load, ratio, base, rho, 0.5 * self.width(0.0));
        Measured::relative(
            "F9",
            format!("{name} pinion h/k at C, N/mm"),
            bump,
            target,
            0.1,
        )
    }
}
