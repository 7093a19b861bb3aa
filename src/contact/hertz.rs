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
use crate::contact::alteration::Alteration;
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
    /// How it falls along the path of contact: β₀, rad per base pitch.
    fall: f64,
    alteration: Option<&'a Alteration>,
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
            fall: (0.5 * (1.11 + 0.5 * cycle.pair.contact_ratio).powi(2) - 1.17).powf(-0.5),
            alteration: None,
        }
    }

    /// The same with what effects change.
    pub fn with(mut self, alteration: &'a Alteration) -> Self {
        self.alteration = Some(alteration);
        self
    }

    fn stiffness_at(&self, pair: &PairContact) -> f64 {
        let geometry = &self.cycle.pair;
        let xi = (geometry.rho_c + pair.path - geometry.rho_a) / geometry.base_pitch;
        self.stiffness * (self.fall * (xi - 0.5 * geometry.contact_ratio)).cos()
    }

    /// The tooth pairs of position `q` that meet on the line of action.
    fn springs(&self, q: usize, depth: [&[f64]; 2]) -> Vec<Spring> {
        let position = &self.cycle.positions[q];
        let on_line = |(_, pair): &(usize, &PairContact)| pair.frame.touch == Touch::Flanks;
        let spring = |(index, pair): (usize, &PairContact)| {
            let mut stiffness = self.stiffness_at(pair);
            let mut gap = self.deviation(pair, depth);
            let mut factor = 1.0;
            if let Some(alteration) = self.alteration {
                if alteration.flexibility != 0.0 {
                    stiffness /= 1.0 + alteration.flexibility * stiffness;
                }
                if let Some([pinion, gear]) = &alteration.profile {
                    gap += self.worn(pair, [pinion, gear]);
                }
                factor = alteration.factor(q, index);
            }
            Spring {
                index,
                stiffness,
                gap,
                factor,
            }
        };
        let pairs = position.pairs.iter().enumerate();
        pairs.filter(on_line).map(spring).collect()
    }

    /// Line loads of `springs` (N/mm) and the approach (mm); where teeth differ, each pair's with its own tooth measured,
    /// and the mean approach.
    fn loads(&self, springs: &[Spring]) -> (Vec<f64>, f64) {
        let carried = |springs: &[Spring]| {
            let delta = share(springs, self.load);
            let loads: Vec<f64> = (springs.iter())
                .map(|s| s.stiffness * (delta - s.gap).max(0.0))
                .collect();
            (loads, delta)
        };
        let Some(alteration) = self.alteration.filter(|a| a.tooth_offset.is_some()) else {
            return carried(springs);
        };
        let mut joint = (vec![0.0; springs.len()], 0.0);
        for (own, measured) in joint.0.iter_mut().zip(springs) {
            let set_back: Vec<Spring> = (springs.iter())
                .map(|s| Spring {
                    gap: s.gap + alteration.offset(measured.index, s.index),
                    ..*s
                })
                .collect();
            let (loads, delta) = carried(&set_back);
            let at = springs.iter().position(|s| s.index == measured.index);
            *own = at.map_or(0.0, |at| loads[at]);
            joint.1 += delta / springs.len() as f64;
        }
        joint
    }

    /// What separates the flanks of a pair where they should touch, mm.
    fn deviation(&self, pair: &PairContact, depth: [&[f64]; 2]) -> f64 {
        pair.facing.gap + self.worn(pair, depth)
    }

    /// Missing material (mm at the stations of both flanks) where the flanks of a pair should touch, mm.
    fn worn(&self, pair: &PairContact, depth: [&[f64]; 2]) -> f64 {
        (0..2)
            .map(|side| {
                interpolate(
                    &self.cycle.stations.arc[side],
                    depth[side],
                    pair.facing.arc[side],
                )
            })
            .sum()
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
        let springs = self.springs(q, depth);
        let mut pressure = vec![0.0; position.gap.len()];
        let mut active = Vec::new();
        let (loads, delta) = self.loads(&springs);
        for (spring, load) in springs.iter().zip(loads).filter(|(_, load)| *load > 0.0) {
            let pair = &position.pairs[spring.index];
            let half_width = hertz_line::half_width(
                load,
                self.cycle.pair.relative_radius(pair.path),
                self.modulus,
            );
            let own = &mut pressure[pair.offset..pair.offset + pair.xi.len()];
            for (p, x) in own.iter_mut().zip(&pair.xi) {
                *p = (1.0 - (x / half_width).powi(2)).max(0.0).sqrt();
            }
            if own.iter().all(|p| *p == 0.0) {
                // narrower than the grid: the nearest node carries it
                let nearest = |x: &f64| pair.xi.iter().all(|other| x.abs() <= other.abs());
                own[pair.xi.iter().position(nearest).unwrap_or(0)] = 1.0;
            }
            let area: f64 = own.iter().zip(&pair.length).map(|(p, l)| p * l).sum();
            for (k, p) in own.iter_mut().enumerate().filter(|(_, p)| **p > 0.0) {
                *p *= load / area;
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

/// A tooth pair on the line of action.
#[derive(Debug, Clone, Copy)]
struct Spring {
    index: usize,
    /// N/mm per mm.
    stiffness: f64,
    /// mm.
    gap: f64,
    /// Its load counts 1/factor in the torque balance.
    factor: f64,
}

/// The approach δ at which springs with gaps carry `load` together: Σ c_i (δ − g_i)/f_i = load over those that touch.
fn share(springs: &[Spring], load: f64) -> f64 {
    let mut springs = springs.to_vec();
    springs.sort_by(|a, b| a.gap.total_cmp(&b.gap));
    let (mut stiffness, mut offset, mut delta) = (0.0, 0.0, 0.0);
    for spring in &springs {
        if stiffness > 0.0 && delta <= spring.gap {
            break;
        }
        let counted = spring.stiffness / spring.factor;
        stiffness += counted;
        offset += counted * spring.gap;
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
                    factor: 1.0,
                },
                Spring {
                    index: 1,
                    stiffness: 30.0,
                    gap: 0.2,
                    factor: 1.0,
                },
            ]
        };
        // too small a load to close the second gap
        assert!((share(&springs(), 1.0) - 0.1).abs() < 1e-15);
        // 10 δ + 30 (δ − 0.2) = 10
        assert!((share(&springs(), 10.0) - 0.4).abs() < 1e-15);
    }
}
