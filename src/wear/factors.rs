//! What effects make of the wear coefficient over one contact.
//!
//! The pressure p is piecewise linear between the unknowns. With f at the unknowns alone, ∫ f p over a contact of 2 to 4 of their
//! spacings per half width comes out up to a fifth too large where f rises with p: few large pressures stand for all. So f is asked at
//! Gauss points between them, and each unknown's factor is the mean around it, weighted by pressure and by the unknown's hat N_k, times
//! what makes the worn area that of the whole contact:
//!
//! ```text
//! F_k = c ∫ f p N_k dξ / ∫ p N_k dξ,     c: Σ F_k p_k L_k / Σ p_k L_k = ∫ f p dξ / ∫ p dξ
//! ```
//! A factor of 1 stays 1 to the last bit.

use crate::contact::cycle::{Cycle, PairContact, Position};
use crate::contact::model::PositionContact;
use crate::effects::{Effect, Local};
use crate::gear::Member;
use crate::wear::acting::{Acting, Age, PairLoad, side};

/// Two-point Gauss rule on (0, 1), each with half the weight.
const GAUSS: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

/// The state that factors belong to.
pub struct Worn<'b> {
    /// Depths of pinion and gear, mm.
    pub depth: [&'b [f64]; 2],
    /// How long it has run.
    pub age: Age,
}

/// At every unknown of a position on pinion and gear, the mean of what `of` makes of the factor f and the place it is asked at.
pub fn factors(
    acting: &Acting,
    cycle: &Cycle,
    worn: &Worn<'_>,
    position: &Position,
    contact: &PositionContact,
    of: impl Fn(f64, &Local) -> f64,
) -> [Vec<f64>; 2] {
    let mut factors = [(); 2].map(|()| vec![1.0; contact.pressure.len()]);
    for pair in &position.pairs {
        let mut local = acting.at_pair(cycle, pair, PairLoad::of(pair, contact), worn.age);
        let own = pair.offset..pair.offset + pair.xi.len();
        let pressure = &contact.pressure[own.clone()];
        for member in Member::BOTH {
            let side = side(member);
            let depth = |k: usize| pair.opening[side].dot(k, worn.depth[side]) / pair.length[k];
            let mut sums = Sums::new(pressure.len());
            for (k, ends) in pressure.windows(2).enumerate() {
                if ends.iter().all(|p| *p <= 0.0) {
                    continue;
                }
                let width = pair.xi[k + 1] - pair.xi[k];
                let (arc, depths) = (&pair.arc[side], [depth(k), depth(k + 1)]);
                for u in GAUSS {
                    let between = |a: f64, b: f64| (1.0 - u) * a + u * b;
                    let p = between(ends[0], ends[1]);
                    let (arc, depth) = (between(arc[k], arc[k + 1]), between(depths[0], depths[1]));
                    acting.at_point(&mut local, cycle, member, arc, depth, p);
                    let value = of(acting.effects.wear_factor(&local), &local);
                    sums.add(k, u, 0.5 * width * p, value);
                }
            }
            sums.write(pair, pressure, &mut factors[side][own.clone()]);
        }
    }
    factors
}

/// ∫ f p N_k and ∫ p N_k of a pair's unknowns.
struct Sums {
    with: Vec<f64>,
    plain: Vec<f64>,
}

impl Sums {
    fn new(count: usize) -> Self {
        Self {
            with: vec![0.0; count],
            plain: vec![0.0; count],
        }
    }

    /// Adds the point at share `u` of the way from unknown `k` to the next.
    fn add(&mut self, k: usize, u: f64, load: f64, factor: f64) {
        for (k, share) in [(k, 1.0 - u), (k + 1, u)] {
            let load = share * load;
            self.plain[k] += load;
            self.with[k] += factor * load;
        }
    }

    fn write(&self, pair: &PairContact, pressure: &[f64], factors: &mut [f64]) {
        let (mut with, mut plain) = (0.0, 0.0);
        for (k, p) in pressure.iter().enumerate().filter(|(_, p)| **p > 0.0) {
            factors[k] = self.with[k] / self.plain[k];
            let load = p * pair.length[k];
            with += factors[k] * load;
            plain += load;
        }
        let sum = |values: &[f64]| values.iter().sum::<f64>();
        let scale = (sum(&self.with) / sum(&self.plain)) / (with / plain);
        if scale.is_finite() {
            for (factor, _) in factors.iter_mut().zip(pressure).filter(|(_, p)| **p > 0.0) {
                *factor *= scale;
            }
        }
    }
}
