//! Tooth thickness lost, as gauges feel it.

use super::Reading;
use crate::gear::{Member, ThicknessLoss, WornDepths};
use crate::measure::{Observation, Quantity};

impl Reading<'_, '_> {
    /// What the gauge of `observation` reads less on `member` than when it was new.
    pub(super) fn thickness(&self, observation: &Observation, member: Member) -> ThicknessLoss {
        let arcs = self.stations(member);
        let at = |station: usize| {
            let own = |slice| self.of_slice(&self.worn.u, slice, member)[station];
            let slices = self.sections(member, observation, own);
            let weighted = |&(slice, weight): &(usize, f64)| weight * own(slice);
            slices.iter().map(weighted).sum()
        };
        let depths: Vec<f64> = (0..arcs.len()).map(at).collect();
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
