//! The two stages of a step, which counts if its error allows.

use super::{GAMMA, Jacobian, Stand, Step, StepControl, WearSystem, implicit};
use crate::wear::shifted::Shifted;

/// A step that may be too long.
pub(super) struct Attempt {
    /// Its length (unit of n).
    tau: f64,
    /// Depths at the second stage.
    middle: Vec<f64>,
    k1: Vec<f64>,
    k2: Vec<f64>,
    shifted: Option<Shifted>,
}

impl Attempt {
    /// Both stages of a step of length `tau` from `stand`, whose rate and Jacobian are known.
    pub(super) fn new<S: WearSystem>(
        system: &mut S,
        stand: &Stand,
        (rate, jacobian): (&[f64], Option<&Jacobian>),
        tau: f64,
    ) -> Result<Self, S::Error> {
        let shifted = jacobian.map(|j| Shifted::new(j, GAMMA * tau));
        let k1 = implicit(shifted.as_ref(), rate.to_vec());
        let middle: Vec<f64> = stand.u.iter().zip(&k1).map(|(u, k)| u + tau * k).collect();
        let second = system.rate(stand.n + tau, &middle)?;
        let k2 = implicit(
            shifted.as_ref(),
            second.iter().zip(&k1).map(|(f, k)| f - 2.0 * k).collect(),
        );
        Ok(Self {
            tau,
            middle,
            k1,
            k2,
            shifted,
        })
    }

    /// Its error over the tolerance.
    pub(super) fn error(&self, stand: &Stand, control: StepControl) -> f64 {
        let scale = stand
            .u
            .iter()
            .chain(&self.middle)
            .fold(control.floor, |m, u| m.max(u.abs()))
            .min(control.ceiling);
        // root mean square: a sharp corner's few stations must not rule the whole flank
        let squares: f64 = (self.k1.iter().zip(&self.k2))
            .map(|(a, b)| (0.5 * self.tau * (a + b)).powi(2))
            .sum();
        (squares / self.k1.len() as f64).sqrt() / (control.tolerance * scale)
    }

    /// Growth of the fastest unknown (unit of u).
    pub(super) fn growth(&self) -> f64 {
        let stages = self.k1.iter().zip(&self.k2);
        stages.fold(0.0, |m: f64, (a, b)| m.max(self.tau * (a.abs() + b.abs())))
    }

    /// Moves the depths of `stand` to its end.
    pub(super) fn taken(self, stand: &mut Stand) -> Step {
        let before = stand.u.clone();
        for ((u, a), b) in stand.u.iter_mut().zip(&self.k1).zip(&self.k2) {
            *u += self.tau * (1.5 * a + 0.5 * b);
        }
        Step {
            n: stand.n,
            tau: self.tau,
            u: [before, self.middle],
            k1: self.k1,
            k2: self.k2,
            shifted: self.shifted,
        }
    }
}
