//! Derivatives of finite-element contact: the active set's compliance factored once, one back-substitution for each change.

use std::ops::Range;

use nalgebra::DVector;

use super::FemContact;
use crate::contact::alteration::{Alteration, set_back};
use crate::contact::model::{ContactError, PositionContact};
use crate::contact::tangent::{AlterationChange, Change, ContactTangent, LinearContact};
use crate::contact::unilateral::Linearised;

/// The contact of one position on its active set.
pub(super) struct FemLinear<'m> {
    model: &'m FemContact<'m>,
    q: usize,
    /// On the active set of the joint contact: what the wear's Jacobian sees.
    joint: OnSet,
    /// Where teeth differ, the contact problem of each pair with its own tooth measured; else none.
    each: Vec<Measured>,
}

/// One contact problem on its active set.
struct OnSet {
    active: Vec<usize>,
    pressure: Vec<f64>,
    linear: Linearised,
}

/// That of one measured tooth, and which unknowns are read from it.
struct Measured {
    index: usize,
    own: Range<usize>,
    on: OnSet,
}

impl<'m> FemLinear<'m> {
    pub(super) fn new(
        model: &'m FemContact<'m>,
        q: usize,
        contact: &PositionContact,
        depth: [&[f64]; 2],
    ) -> Result<Self, ContactError> {
        let joint = OnSet::new(model, q, contact)?;
        let mut each = Vec::new();
        if let Some(alteration) = model.alteration.filter(|a| a.tooth_offset.is_some()) {
            let gap = model.gap(q, depth);
            let (corners, start) = (model.lost_corners(depth), &contact.active);
            for index in 0..model.cycle.positions[q].pairs.len() {
                let (own, solved) =
                    model.one_tooth_measured(q, &gap, start, corners, alteration, index)?;
                let on = OnSet::new(model, q, &solved)?;
                each.push(Measured { index, own, on });
            }
        }
        Ok(Self {
            model,
            q,
            joint,
            each,
        })
    }

    /// How the weighted gaps of the position open.
    fn opening(&self, change: &Change<'_>) -> Vec<f64> {
        let position = &self.model.cycle.positions[self.q];
        let mut gap = vec![0.0; position.gap.len()];
        position.open(change.depth, &mut gap);
        let opened = change.altered.and_then(|altered| altered.opened.as_ref());
        if let Some(opened) = opened {
            for (gap, opened) in gap.iter_mut().zip(&opened[self.q]) {
                *gap += opened;
            }
        }
        gap
    }

    fn on_set(&self, on: &OnSet, gap: &[f64], change: &Change<'_>) -> (DVector<f64>, f64) {
        let (mut right, mut load) = (DVector::zeros(on.active.len()), 0.0);
        if let Some(altered) = change.altered {
            (right, load) =
                (self.model).altered_on(self.q, &on.active, &on.pressure, &altered.alteration);
        }
        for (right, &k) in right.iter_mut().zip(&on.active) {
            *right -= gap[k];
        }
        on.linear.solve(right, load)
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

impl OnSet {
    fn new(
        model: &FemContact<'_>,
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
        Ok(Self {
            pressure: contact
                .active
                .iter()
                .map(|&k| contact.pressure[k])
                .collect(),
            active: contact.active.clone(),
            linear,
        })
    }
}

impl LinearContact for FemLinear<'_> {
    fn tangent(&self, change: &Change<'_>) -> ContactTangent {
        let gap = self.opening(change);
        let mut out = ContactTangent {
            pressure: vec![0.0; gap.len()],
            approach: 0.0,
        };
        if self.each.is_empty() {
            let (pressure, approach) = self.on_set(&self.joint, &gap, change);
            for (&k, p) in self.joint.active.iter().zip(pressure.iter()) {
                out.pressure[k] = *p;
            }
            out.approach = approach;
            return out;
        }
        let pairs = &self.model.cycle.positions[self.q].pairs;
        for measured in &self.each {
            let mut gap = gap.clone();
            if let Some(altered) = change.altered {
                for (index, pair) in pairs.iter().enumerate() {
                    let offset = altered.alteration.offset(measured.index, index);
                    set_back(&mut gap, pair, offset);
                }
            }
            let (pressure, approach) = self.on_set(&measured.on, &gap, change);
            for (&k, p) in measured.on.active.iter().zip(pressure.iter()) {
                if measured.own.contains(&k) {
                    out.pressure[k] = *p;
                }
            }
            out.approach += approach / self.each.len() as f64;
        }
        out
    }

    fn response(&self, depth: [&[f64]; 2]) -> Vec<f64> {
        let gap = self.opening(&Change {
            depth,
            altered: None,
        });
        let right = DVector::from_iterator(
            self.joint.active.len(),
            self.joint.active.iter().map(|&k| gap[k]),
        );
        self.joint.linear.solve(right, 0.0).0.as_slice().to_vec()
    }

    fn response_tangent(&self, response: &[f64], change: &AlterationChange) -> Option<Vec<f64>> {
        let alteration = &change.alteration;
        if alteration.keeps_stiffness() {
            return None;
        }
        let active = &self.joint.active;
        let (right, load) = (self.model).altered_on(self.q, active, response, alteration);
        Some(self.joint.linear.solve(right, load).0.as_slice().to_vec())
    }
}
