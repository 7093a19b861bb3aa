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
//! A factor of 1 stays 1 to the last bit. Effects whose factor is the same for all of a contact are asked once for it.

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

/// At every unknown of a position on pinion and gear, the means of what `of` makes of the factor f and the place it is asked at.
pub fn factors<const N: usize>(
    acting: &Acting,
    cycle: &Cycle,
    worn: &Worn<'_>,
    position: &Position,
    contact: &PositionContact,
    of: impl Fn(f64, &Local) -> [f64; N],
) -> [[Vec<f64>; 2]; N] {
    let even = acting.effects.is_even();
    let mut factors = [(); N].map(|()| [(); 2].map(|()| vec![1.0; contact.pressure.len()]));
    for pair in &position.pairs {
        let own = pair.offset..pair.offset + pair.xi.len();
        let pressure = &contact.pressure[own.clone()];
        if pressure.iter().all(|p| *p <= 0.0) {
            continue;
        }
        let mut local = acting.at_pair(cycle, pair, PairLoad::of(pair, contact), worn.age);
        for member in Member::BOTH {
            let side = side(member);
            if even {
                acting.at_point(&mut local, cycle, member, pair.arc[side][0], 0.0, 0.0);
                let values = of(acting.effects.wear_factor(&local), &local);
                for (factors, value) in factors.iter_mut().zip(values) {
                    let touching = factors[side][own.clone()].iter_mut().zip(pressure);
                    for (factor, _) in touching.filter(|(_, p)| **p > 0.0) {
                        *factor = value;
                    }
                }
                continue;
            }
            let depth = |k: usize| pair.opening[side].dot(k, worn.depth[side]) / pair.length[k];
            let mut sums = Sums::<N>::new(pressure.len());
            let mut behind: Option<(usize, f64)> = None;
            for (k, ends) in pressure.windows(2).enumerate() {
                if ends.iter().all(|p| *p <= 0.0) {
                    continue;
                }
                let width = pair.xi[k + 1] - pair.xi[k];
                let known = behind.filter(|(at, _)| *at == k);
                let depths = [
                    known.map_or_else(|| depth(k), |(_, depth)| depth),
                    depth(k + 1),
                ];
                behind = Some((k + 1, depths[1]));
                let arc = &pair.arc[side];
                for u in GAUSS {
                    let between = |a: f64, b: f64| (1.0 - u) * a + u * b;
                    let p = between(ends[0], ends[1]);
                    let (arc, depth) = (between(arc[k], arc[k + 1]), between(depths[0], depths[1]));
                    acting.at_point(&mut local, cycle, member, arc, depth, p);
                    let values = of(acting.effects.wear_factor(&local), &local);
                    sums.add(k, u, 0.5 * width * p, values);
                }
            }
            for (i, factors) in factors.iter_mut().enumerate() {
                sums.write(i, pair, pressure, &mut factors[side][own.clone()]);
            }
        }
    }
    factors
}

/// ∫ f p N_k and ∫ p N_k of a pair's unknowns, for several f.
struct Sums<const N: usize> {
    with: [Vec<f64>; N],
    plain: Vec<f64>,
}

impl<const N: usize> Sums<N> {
    fn new(count: usize) -> Self {
        Self {
            with: [(); N].map(|()| vec![0.0; count]),
            plain: vec![0.0; count],
        }
    }

    /// Adds the point at share `u` of the way from unknown `k` to the next.
    fn add(&mut self, k: usize, u: f64, load: f64, factors: [f64; N]) {
        for (k, share) in [(k, 1.0 - u), (k + 1, u)] {
            let load = share * load;
            self.plain[k] += load;
            for (with, factor) in self.with.iter_mut().zip(factors) {
                with[k] += factor * load;
            }
        }
    }

    fn write(&self, i: usize, pair: &PairContact, pressure: &[f64], factors: &mut [f64]) {
        let own = &self.with[i];
        let (mut with, mut plain) = (0.0, 0.0);
        for (k, p) in pressure.iter().enumerate().filter(|(_, p)| **p > 0.0) {
            factors[k] = own[k] / self.plain[k];
            let load = p * pair.length[k];
            with += factors[k] * load;
            plain += load;
        }
        let sum = |values: &[f64]| values.iter().sum::<f64>();
        let scale = (sum(own) / sum(&self.plain)) / (with / plain);
        if scale.is_finite() {
            for (factor, _) in factors.iter_mut().zip(pressure).filter(|(_, p)| **p > 0.0) {
                *factor *= scale;
            }
        }
    }
}
