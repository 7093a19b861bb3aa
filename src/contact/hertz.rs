//! The analytic contact model: elastic load sharing between tooth pairs and Hertz line contact on each.
//!
//! ```text
//! w_i = c(y_i) · max(0, δ − e_i),   Σ w_i = w            c(y) = c_max cos(β₀ (ξ(y) − ε_α/2)),  ξ = (y − y_A)/p_b
//! β₀ = [½ (1.11 + ε_α/2)² − 1.17]^(−1/2)                  c_max = c'_th E/E_St of ISO 6336-1, N/(mm·µm)
//! ```
//! The stiffness curve is Pedrero, Pleguezuelos, Artés & Antona, Mech. Mach. Theory 45 (2010), as refined by Sánchez et
//! al. (2013); e_i are worn depth and profile deviations where the pair touches. Assumed away: contact outside the path
//! of contact, the wear's influence on the pressure's shape, and the bodies beyond the teeth.

use nalgebra::DMatrix;

use crate::analytic::hertz_line;
use crate::contact::cycle::{Cycle, PairContact};
use crate::contact::frame::Touch;
use crate::contact::model::{ContactError, ContactModel, PositionContact};
use crate::numeric::interpolate;

/// Analytic contact over one mesh cycle.
#[derive(Debug, Clone)]
pub struct HertzContact<'a> {
    cycle: &'a Cycle,
    /// Normal load per face width, N/mm.
    load: f64,
    /// Contact modulus E*, MPa.
    modulus: f64,
    /// Largest stiffness of a tooth pair, N/mm per mm of approach and face width.
    stiffness: f64,
}

impl<'a> HertzContact<'a> {
    /// Contact under a pinion torque per face width (N·mm/mm) with the contact modulus E* (MPa) and the largest tooth
    /// pair stiffness `stiffness` (N/(mm·µm)).
    pub fn new(cycle: &'a Cycle, torque: f64, modulus: f64, stiffness: f64) -> Self {
        Self {
            cycle,
            load: torque / cycle.pair.pinion.base_radius,
            modulus,
            stiffness: 1e3 * stiffness,
        }
    }

    fn stiffness_at(&self, pair: &PairContact) -> f64 {
        let geometry = &self.cycle.pair;
        let ratio = geometry.contact_ratio;
        let beta = (0.5 * (1.11 + 0.5 * ratio).powi(2) - 1.17).powf(-0.5);
        let xi = (geometry.rho_c + pair.path - geometry.rho_a) / geometry.base_pitch;
        self.stiffness * (beta * (xi - 0.5 * ratio)).cos()
    }

    /// What separates the flanks of a pair where they should touch, mm.
    fn deviation(&self, pair: &PairContact, depth: [&[f64]; 2]) -> f64 {
        let facing = pair.frame.facing(&self.cycle.pair, 0.0);
        let worn: f64 = (0..2)
            .map(|side| {
                interpolate(
                    &self.cycle.stations.arc[side],
                    depth[side],
                    facing.arc[side],
                )
            })
            .sum();
        facing.gap + worn
    }
}

impl ContactModel for HertzContact<'_> {
    fn cycle(&self) -> &Cycle {
        self.cycle
    }

    fn solve(
        &self,
        q: usize,
        depth: [&[f64]; 2],
        _: &[usize],
    ) -> Result<PositionContact, ContactError> {
        let position = &self.cycle.positions[q];
        let mut springs: Vec<Spring> = Vec::new();
        for (index, pair) in position.pairs.iter().enumerate() {
            if pair.frame.touch == Touch::Flanks {
                springs.push(Spring {
                    index,
                    stiffness: self.stiffness_at(pair),
                    gap: self.deviation(pair, depth),
                });
            }
        }
        let delta = share(&mut springs, self.load);
        let mut pressure = vec![0.0; position.gap.len()];
        let mut active = Vec::new();
        for spring in springs.iter().filter(|s| delta > s.gap) {
            let pair = &position.pairs[spring.index];
            let load = spring.stiffness * (delta - spring.gap);
            let half_width = hertz_line::half_width(
                load,
                self.cycle.pair.relative_radius(pair.path),
                self.modulus,
            );
            let mut shape: Vec<f64> = pair
                .xi
                .iter()
                .map(|x| (1.0 - (x / half_width).powi(2)).max(0.0).sqrt())
                .collect();
            if shape.iter().all(|s| *s == 0.0) {
                // narrower than the grid: the nearest node carries it
                let nearest = |x: &f64| pair.xi.iter().all(|other| x.abs() <= other.abs());
                shape[pair.xi.iter().position(nearest).unwrap_or(0)] = 1.0;
            }
            let area: f64 = shape.iter().zip(&pair.length).map(|(s, l)| s * l).sum();
            for (k, s) in shape.iter().enumerate().filter(|(_, s)| **s > 0.0) {
                pressure[pair.offset + k] = s * load / area;
                active.push(pair.offset + k);
            }
        }
        let approach = delta / self.cycle.pair.pinion.base_radius;
        Ok(PositionContact {
            pressure,
            approach,
            active,
            iterations: 1,
            penetration: 0.0,
        })
    }

    fn sensitivity(
        &self,
        _: usize,
        _: &PositionContact,
    ) -> Result<Option<DMatrix<f64>>, ContactError> {
        Ok(None)
    }
}

struct Spring {
    index: usize,
    stiffness: f64,
    gap: f64,
}

/// The approach δ at which springs with gaps carry `load` together.
fn share(springs: &mut [Spring], load: f64) -> f64 {
    springs.sort_by(|a, b| a.gap.total_cmp(&b.gap));
    let (mut stiffness, mut offset, mut delta) = (0.0, 0.0, 0.0);
    for spring in springs.iter() {
        if stiffness > 0.0 && delta <= spring.gap {
            break;
        }
        stiffness += spring.stiffness;
        offset += spring.stiffness * spring.gap;
        delta = (load + offset) / stiffness;
    }
    delta
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn springs_share_the_load() {
        let springs = || {
            vec![
                Spring {
                    index: 0,
                    stiffness: 10.0,
                    gap: 0.0,
                },
                Spring {
                    index: 1,
                    stiffness: 30.0,
                    gap: 0.2,
                },
            ]
        };
        // too small a load to close the second gap
        assert!((share(&mut springs(), 1.0) - 0.1).abs() < 1e-15);
        // 10 δ + 30 (δ − 0.2) = 10
        assert!((share(&mut springs(), 10.0) - 0.4).abs() < 1e-15);
    }
}
