//! How a contact moves along both flanks.

use crate::contact::frame::{Frame, Touch};
use crate::gear::Pair;

/// How a contact moves along both flanks and slides, per path of contact.
pub(super) struct Motion {
    /// Of the contact along the flanks of pinion and gear; 0 where a corner stays on its own.
    pub(super) speed: [f64; 2],
    /// Signed sliding distance, and its change per path.
    pub(super) slip: f64,
    pub(super) slip_slope: f64,
}

impl Motion {
    /// Of the contact at `path` (mm from the pitch point) in its frame.
    pub(super) fn at(pair: &Pair, path: f64, frame: &Frame) -> Self {
        let scale = (1.0 + 1.0 / pair.speed_ratio) / pair.pinion.base_radius;
        let slip = scale * frame.sliding_arm(pair);
        if frame.touch == Touch::Flanks {
            let speed = [
                frame.rho[0] / pair.pinion.base_radius,
                -frame.rho[1] / pair.gear.base_radius,
            ];
            return Self {
                speed,
                slip,
                slip_slope: scale,
            };
        }
        // a corner stays on its own flank; the motion of its foot by a difference taken away from the path's end
        let side = usize::from(frame.touch == Touch::PinionTip);
        let outward = 1e-4 * pair.base_pitch * if side == 0 { -1.0 } else { 1.0 };
        let gear = [&pair.pinion, &pair.gear][side];
        let (mut speed, mut slip_slope) = ([0.0; 2], scale);
        if let Some(next) = Frame::new(pair, path + outward) {
            speed[side] = (gear.arc(next.rho[side]) - gear.arc(frame.rho[side])) / outward;
            slip_slope = scale * (next.sliding_arm(pair) - frame.sliding_arm(pair)) / outward;
        }
        Self {
            speed,
            slip,
            slip_slope,
        }
    }
}
