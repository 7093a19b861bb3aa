//! Analytic contact of all slices of the face: springs side by side, one approach between them.

use std::sync::Arc;

use super::tangent::HertzLinear;
use super::{Carried, HertzContact, Spring};
use crate::contact::model::{ContactError, PositionContact, SlicedContact};
use crate::contact::slices::{Flanks, Slices};
use crate::contact::tangent::LinearSlices;
use crate::contact::unilateral::SliceSensitivity;

impl HertzContact<'_> {
    /// The tooth pairs of all slices at the section positions `at`.
    pub(super) fn springs_at(&self, at: &[usize], flanks: &Flanks<'_>) -> Vec<Spring> {
        let Some(slices) = self.slices else {
            return self.springs(at[0], flanks);
        };
        let of_slice = |(i, q): (usize, &usize)| {
            self.springs_of(*q, flanks, (i, slices.offset[i], slices.weight[i]))
        };
        at.iter().enumerate().flat_map(of_slice).collect()
    }
}

impl SlicedContact for HertzContact<'_> {
    fn slices(&self) -> &Slices {
        self.slices.expect("asked only where there are slices")
    }

    fn solve_all(
        &self,
        turn: usize,
        flanks: &Flanks<'_>,
        _: &[Vec<usize>],
    ) -> Result<Vec<PositionContact>, ContactError> {
        let at = self.slices().all_at(turn, self.cycle.positions.len());
        let springs = self.springs_at(&at, flanks);
        let Carried {
            loads,
            approach,
            torque_error,
        } = self.loads(&springs);
        let of_slice = |(i, q): (usize, &usize)| {
            let all = springs.iter().zip(loads.iter().copied());
            let own: Vec<(&Spring, f64)> = all.filter(|(spring, _)| spring.slice == i).collect();
            PositionContact {
                approach: approach / self.cycle.pair.pinion.base_radius,
                torque_error,
                ..self.contact(*q, &own)
            }
        };
        Ok(at.iter().enumerate().map(of_slice).collect())
    }

    fn sensitivities(
        &self,
        _: usize,
        _: &[&PositionContact],
    ) -> Result<Option<Vec<Arc<SliceSensitivity>>>, ContactError> {
        Ok(None)
    }

    fn linearised_all<'m>(
        &'m self,
        turn: usize,
        contacts: &[&PositionContact],
        flanks: &Flanks<'_>,
    ) -> Result<Box<dyn LinearSlices + 'm>, ContactError> {
        let at = self.slices().all_at(turn, self.cycle.positions.len());
        Ok(Box::new(HertzLinear::new(self, &at, contacts, flanks)))
    }
}
