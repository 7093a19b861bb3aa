//! A contact model with a prescribed load of each tooth pair: Hertz's ellipse on the line of action, given pressures off it.
//!
//! With it one assumption of another model can be replaced while the rest stays.

use nalgebra::DMatrix;

use crate::analytic::hertz_line;
use crate::contact::cycle::{Cycle, PairContact};
use crate::contact::frame::Touch;
use crate::contact::model::{ContactError, ContactModel, PositionContact};
use crate::contact::slices::Flanks;
use crate::contact::tangent::{Given, LinearContact};
use crate::simulate::wear_state::line_load;

/// Hertz contact under prescribed line loads; wear does not change it.
#[derive(Debug, Clone)]
pub struct Prescribed<'a> {
    cycle: &'a Cycle,
    modulus: f64,
    loads: Vec<Vec<f64>>,
    off_line: Option<&'a [PositionContact]>,
}

impl<'a> Prescribed<'a> {
    /// Pairs that carry `load` (N/mm), with the contact modulus E* (MPa).
    pub fn new(cycle: &'a Cycle, modulus: f64, load: impl Fn(&PairContact) -> f64) -> Self {
        let loads = cycle
            .positions
            .iter()
            .map(|q| q.pairs.iter().map(&load).collect())
            .collect();
        Self {
            cycle,
            modulus,
            loads,
            off_line: None,
        }
    }

    /// Equal parts of `load` (N/mm) for the pairs within the path of contact.
    pub fn equal(cycle: &'a Cycle, modulus: f64, load: f64) -> Self {
        let mut equal = Self::new(cycle, modulus, |pair| {
            f64::from(u8::from(pair.frame.touch == Touch::Flanks))
        });
        for parts in &mut equal.loads {
            let part = load / parts.iter().sum::<f64>().max(1.0);
            parts.iter_mut().for_each(|p| *p *= part);
        }
        equal
    }

    /// The loads that the pairs carry in `contacts` (one entry per position of `cycle`).
    pub fn following(cycle: &'a Cycle, modulus: f64, contacts: &[PositionContact]) -> Self {
        let loads = cycle
            .positions
            .iter()
            .zip(contacts)
            .map(|(q, contact)| {
                q.pairs
                    .iter()
                    .map(|pair| line_load(pair, contact))
                    .collect()
            })
            .collect();
        Self {
            cycle,
            modulus,
            loads,
            off_line: None,
        }
    }

    /// Takes the pressures of pairs that touch off the line of action from `contacts`: Hertz knows no corners.
    pub fn with_corners(self, contacts: &'a [PositionContact]) -> Self {
        Self {
            off_line: Some(contacts),
            ..self
        }
    }
}

impl ContactModel for Prescribed<'_> {
    fn cycle(&self) -> &Cycle {
        self.cycle
    }

    fn solve_flanks(
        &self,
        q: usize,
        _: &Flanks<'_>,
        _: &[usize],
    ) -> Result<PositionContact, ContactError> {
        let position = &self.cycle.positions[q];
        let mut pressure = vec![0.0; position.gap.len()];
        for (pair, &load) in position.pairs.iter().zip(&self.loads[q]) {
            let own = pair.offset..pair.offset + pair.xi.len();
            if pair.frame.touch != Touch::Flanks {
                if let Some(contacts) = self.off_line {
                    pressure[own.clone()].copy_from_slice(&contacts[q].pressure[own]);
                }
                continue;
            }
            if load <= 0.0 {
                continue;
            }
            let radius = self.cycle.pair.relative_radius(pair.path);
            let half_width = hertz_line::half_width(load, radius, self.modulus);
            let shape: Vec<f64> = pair
                .xi
                .iter()
                .map(|&x| hertz_line::pressure(x, 1.0, half_width))
                .collect();
            // the ellipse on the contact's grid, cut off where a flank ends, carries the load exactly
            let area: f64 = shape.iter().zip(&pair.length).map(|(s, l)| s * l).sum();
            for (p, s) in pressure[own].iter_mut().zip(shape) {
                *p = s * load / area;
            }
        }
        Ok(PositionContact {
            active: (0..pressure.len()).filter(|&k| pressure[k] > 0.0).collect(),
            pressure,
            approach: 0.0,
            iterations: 1,
            penetration: 0.0,
            torque_error: 0.0,
        })
    }

    fn sensitivity(
        &self,
        _: usize,
        _: &PositionContact,
    ) -> Result<Option<DMatrix<f64>>, ContactError> {
        Ok(None)
    }
    fn linearised<'m>(
        &'m self,
        _: usize,
        contact: &PositionContact,
        _: &Flanks<'_>,
    ) -> Result<Box<dyn LinearContact + 'm>, ContactError> {
        Ok(Box::new(Given(contact.pressure.len())))
    }
}
