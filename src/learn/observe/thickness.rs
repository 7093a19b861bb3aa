//! Tooth thickness lost, as gauges feel it.

use super::Reading;
use crate::gear::{Member, ThicknessLoss, WornDepths};
use crate::measure::{Observation, Quantity};

impl Reading<'_, '_> {
    /// What the gauge of `observation` reads less on `member` than when it was new.
    pub(super) fn thickness(&self, observation: &Observation, member: Member) -> ThicknessLoss {
        let arcs = self.stations(member);
        let mut depths = vec![0.0; arcs.len()];
        for (slice, weight) in self.sections(member, observation) {
            let own = self.of_slice(&self.worn.u, slice, member);
            (depths.iter_mut().zip(own)).for_each(|(sum, depth)| *sum += weight * depth);
        }
        let worn = WornDepths {
            arcs,
            depths: &depths,
        };
        let gear = self.forward.cycle().pair.member(member);
        let position = observation.position.unwrap_or(0.0);
        match observation.quantity {
            Quantity::SpanLoss => gear.span_loss(position as u32, worn),
            _ => gear.chord_loss(position, worn),
        }
    }
}
