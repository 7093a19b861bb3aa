//! Derivatives of finite-element contact: the active set's compliance factored once, one back-substitution for each change.

use nalgebra::DVector;

use super::FemContact;
use crate::contact::alteration::{Alteration, set_back};
use crate::contact::model::{ContactError, PositionContact};
use crate::contact::slices::Flanks;
use crate::contact::tangent::{AlterationChange, Change, ContactTangent, LinearContact};
use crate::contact::unilateral::Linearised;

/// The contact of one position on its active set.
pub(super) struct FemLinear<'m> {
    model: &'m FemContact<'m>,
    q: usize,
    active: Vec<usize>,
    pressure: Vec<f64>,
    linear: Linearised,
}

impl<'m> FemLinear<'m> {
    pub(super) fn new(
        model: &'m FemContact<'m>,
        q: usize,
        contact: &PositionContact,
    ) -> Result<Self, ContactError> {
        let position = &model.cycle.positions[q];
        let linear = Linearised::new(&model.problem(q, &position.gap), &contact.active).map_err(
            |source| ContactError::Unilateral {
                theta: position.theta,
                source,
            },
        )?;
        let carried = contact.active.iter().map(|&k| contact.pressure[k]);
        Ok(Self {
            model,
            q,
            pressure: carried.collect(),
            active: contact.active.clone(),
            linear,
        })
    }

    /// How the weighted gaps of the position open.
    fn opening(&self, change: &Change<'_>) -> Vec<f64> {
        let position = &self.model.cycle.positions[self.q];
        let mut gap = vec![0.0; position.gap.len()];
        position.open_each(change.flanks.of(0), &mut gap);
        for (pair, back) in position.pairs.iter().zip(&change.flanks.back) {
            if *back != 0.0 {
                set_back(&mut gap, pair, *back);
            }
        }
        let opened = change.altered.and_then(|altered| altered.opened.as_ref());
        if let Some(opened) = opened {
            for (gap, opened) in gap.iter_mut().zip(&opened[self.q]) {
                *gap += opened;
            }
        }
        gap
    }
}

impl FemContact<'_> {
    /// −dW λ and −db·λ of what is altered, for values λ on the set `active`.
    pub(super) fn altered_on(
        &self,
        q: usize,
        active: &[usize],
        values: &[f64],
        change: &Alteration,
    ) -> (DVector<f64>, f64) {
        let position = &self.cycle.positions[q];
        let levers = self.compliance.levers(q);
        let mut right = DVector::zeros(active.len());
        let mut load = 0.0;
        for (index, pair) in position.pairs.iter().enumerate() {
            let own = pair.offset..pair.offset + pair.xi.len();
            let first = active.partition_point(|k| *k < own.start);
            let last = active.partition_point(|k| *k < own.end);
            let slope = change.factor_slope(q, index);
            if slope != 0.0 {
                let factor = self.alteration.map_or(1.0, |a| a.factor(q, index));
                let carried: f64 = (first..last).map(|i| levers[active[i]] * values[i]).sum();
                load += carried * slope / factor;
            }
            let per_friction = change.friction(q, index);
            let rubbed = self.compliance.per_friction(q);
            if let Some(per) = rubbed.filter(|_| per_friction != 0.0) {
                let factor = self.alteration.map_or(1.0, |a| a.factor(q, index));
                for (&column, value) in (active.iter().zip(values)).take(last).skip(first) {
                    let by = per_friction * value;
                    load -= by * per.lever[column] / factor;
                    for (right, &k) in right.iter_mut().zip(active) {
                        *right -= by * per.weighted[(k, column)];
                    }
                }
            }
            if change.flexibility != 0.0 {
                let length = |i: usize| pair.length[active[i] - pair.offset];
                let line_load: f64 = (first..last).map(|i| length(i) * values[i]).sum();
                for i in first..last {
                    right[i] -= change.flexibility * line_load * length(i);
                }
            }
        }
        (right, load)
    }
}

impl LinearContact for FemLinear<'_> {
    fn tangent(&self, change: &Change<'_>) -> ContactTangent {
        let gap = self.opening(change);
        let (mut right, mut load) = (DVector::zeros(self.active.len()), 0.0);
        if let Some(altered) = change.altered {
            (right, load) =
                (self.model).altered_on(self.q, &self.active, &self.pressure, &altered.alteration);
        }
        for (right, &k) in right.iter_mut().zip(&self.active) {
            *right -= gap[k];
        }
        let (pressure, approach) = self.linear.solve(right, load);
        let mut out = ContactTangent {
            pressure: vec![0.0; gap.len()],
            approach,
        };
        for (&k, p) in self.active.iter().zip(pressure.iter()) {
            out.pressure[k] = *p;
        }
        out
    }

    fn response(&self, flanks: &Flanks<'_>) -> Vec<f64> {
        let gap = self.opening(&Change {
            flanks,
            altered: None,
        });
        let right = self.active.iter().map(|&k| gap[k]);
        let right = DVector::from_iterator(self.active.len(), right);
        self.linear.solve(right, 0.0).0.as_slice().to_vec()
    }

    fn response_tangent(&self, response: &[f64], change: &AlterationChange) -> Option<Vec<f64>> {
        let alteration = &change.alteration;
        if alteration.keeps_stiffness() {
            return None;
        }
        let (right, load) = (self.model).altered_on(self.q, &self.active, response, alteration);
        Some(self.linear.solve(right, load).0.as_slice().to_vec())
    }
}
