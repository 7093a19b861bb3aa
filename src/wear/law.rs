//! The rate of wear on contacts that are solved: Archard's law, and what effects make of it.

use crate::contact::cycle::{Cycle, Position};
use crate::contact::deposit::tributary;
use crate::contact::model::PositionContact;
use crate::contact::slices::Flanks;
use crate::effects::{Effect, Hook, Local};
use crate::gear::Member;
use crate::wear::acting::{Acting, Age, PairLoad, side};
use crate::wear::archard::AreaRate;
use crate::wear::factors::{Worn, factors};
use crate::wear::passage::{Moment, Passage};

/// The law over one mesh cycle.
#[derive(Clone, Copy)]
pub(super) struct Law<'a> {
    pub(super) cycle: &'a Cycle,
    /// Wear coefficient of pinion and gear, mm²/N.
    pub(super) coefficient: [f64; 2],
    pub(super) acting: Option<&'a Acting>,
    /// Only where an effect adds depth.
    pub(super) passage: Option<&'a Passage>,
    /// Volume worn off both members, mm³, where it does not follow from the depths at hand.
    pub(super) worn_volume: Option<f64>,
}

/// Contacts solved for some depths.
#[derive(Clone)]
pub(super) struct Solved {
    /// Depths of the pinion's, then of the gear's stations, mm.
    pub(super) u: Vec<f64>,
    pub(super) contacts: Vec<PositionContact>,
    /// What the stations of pinion and gear see; empty where no effect asks.
    pub(super) moments: [Vec<Moment>; 2],
}

/// Where the largest pressure of a station is read, by flank and station: (position, unknown, weight).
pub(super) type Reads = [Vec<Vec<(u32, u32, f64)>>; 2];

/// Factor on k at every unknown of a position on pinion and gear; `None`: 1 everywhere.
pub(super) type Factors = Option<[Vec<f64>; 2]>;

/// What the slopes of added depths put into the Jacobian at one position: unknown, joint station, mm per cycle and MPa.
pub(super) type AddedReads = Vec<(usize, usize, f64)>;

impl Law<'_> {
    /// Pinion and gear part of a joint vector over the stations.
    pub(super) fn split<'u>(&self, u: &'u [f64]) -> [&'u [f64]; 2] {
        let (pinion, gear) = u.split_at(self.cycle.stations.arc[0].len());
        [pinion, gear]
    }

    /// The same of every slice of the face.
    pub(super) fn each<'u>(&self, u: &'u [f64]) -> Vec<[&'u [f64]; 2]> {
        let slices = u.chunks(self.cycle.stations.count());
        slices.map(|slice| self.split(slice)).collect()
    }

    /// The flanks of slices at the section positions `at` with these depths by slice.
    pub(super) fn flanks<'u>(&self, at: &[usize], depths: &[[&'u [f64]; 2]]) -> Flanks<'u> {
        let pairs = at.iter().map(|&q| self.cycle.positions[q].pairs.len());
        let pairs: Vec<usize> = pairs.collect();
        Flanks::new(&pairs, |slice, _| depths[slice])
    }

    /// Depth rate per pressure of pinion and gear: k per pinion cycle, for depths in the transverse section.
    pub(super) fn scale(&self) -> [f64; 2] {
        let inclined = self.cycle.pair.cos_base_helix();
        [
            self.coefficient[0] / inclined,
            self.coefficient[1] / self.cycle.pair.speed_ratio / inclined,
        ]
    }

    pub(super) fn view<'b>(&self, n: f64, u: &'b [f64]) -> Worn<'b> {
        let depth = self.split(u);
        let own = || (self.acting).map_or(0.0, |acting| acting.worn_volume(self.cycle, depth));
        let worn_volume = self.worn_volume.unwrap_or_else(own);
        Worn {
            depth,
            age: Age {
                cycles: n,
                worn_volume,
            },
        }
    }

    /// du/dn, mm per pinion cycle; with the factors of every position if they are known.
    pub(super) fn rate(&self, n: f64, solved: &Solved, known: Option<&[Factors]>) -> Vec<f64> {
        let view = self.view(n, &solved.u);
        let mut rate = vec![0.0; solved.u.len()];
        for (q, (position, contact)) in
            (self.cycle.positions.iter().zip(&solved.contacts)).enumerate()
        {
            match known {
                Some(known) => self.add_rate(&mut rate, position, contact, known[q].as_ref()),
                None => {
                    let factors = self.wear_factors(&view, position, contact);
                    self.add_rate(&mut rate, position, contact, factors.as_ref());
                }
            }
        }
        self.add_added(&mut rate, &view, solved);
        rate
    }

    /// One position's part of the rate.
    fn add_rate(
        &self,
        rate: &mut [f64],
        position: &Position,
        contact: &PositionContact,
        factors: Option<&[Vec<f64>; 2]>,
    ) {
        let scale = self.scale();
        let (pinion, gear) = rate.split_at_mut(self.cycle.stations.arc[0].len());
        for pair in &position.pairs {
            for (side, depth) in [&mut *pinion, &mut *gear].into_iter().enumerate() {
                for k in 0..pair.xi.len() {
                    let at = pair.offset + k;
                    let p = contact.pressure[at];
                    if p > 0.0 {
                        let kp = scale[side] * p;
                        let kp = factors.map_or(kp, |f| kp * f[side][at]);
                        pair.wear[side].scatter(k, kp, depth);
                    }
                }
            }
        }
    }

    fn add_added(&self, rate: &mut [f64], view: &Worn, solved: &Solved) {
        let (pinion, gear) = rate.split_at_mut(self.cycle.stations.arc[0].len());
        for added in self.added(view, solved) {
            [&mut *pinion, &mut *gear][added.side][added.station] +=
                added.removed + added.displaced;
        }
    }

    /// Worn area per pinion cycle, from the line loads.
    pub(super) fn area_rate(&self, n: f64, solved: &Solved) -> AreaRate {
        let view = self.view(n, &solved.u);
        let cycle = self.cycle;
        let mut work = [0.0; 2];
        for (position, contact) in cycle.positions.iter().zip(&solved.contacts) {
            let factors = self.wear_factors(&view, position, contact);
            for pair in &position.pairs {
                for (side, work) in work.iter_mut().enumerate() {
                    let load: f64 = (pair.length.iter().enumerate())
                        .map(|(k, length)| {
                            let at = pair.offset + k;
                            let plain = length * contact.pressure[at];
                            factors.as_ref().map_or(plain, |f| plain * f[side][at])
                        })
                        .sum();
                    *work += load * pair.slid;
                }
            }
        }
        let scale = self.scale();
        let mut law = [0, 1].map(|side| scale[side] * work[side]);
        let mut displaced = [0.0; 2];
        for added in self.added(&view, solved) {
            let width = tributary(&cycle.stations.arc[added.side], added.station);
            law[added.side] += (added.removed + added.displaced) * width;
            displaced[added.side] += added.displaced * width;
        }
        AreaRate { law, displaced }
    }

    /// Area per pinion cycle that effects only displace, pinion and gear, mm².
    pub(super) fn displaced_rate(&self, n: f64, solved: &Solved) -> [f64; 2] {
        let mut displaced = [0.0; 2];
        for added in self.added(&self.view(n, &solved.u), solved) {
            let width = tributary(&self.cycle.stations.arc[added.side], added.station);
            displaced[added.side] += added.displaced * width;
        }
        displaced
    }

    fn wear_factors(&self, view: &Worn, position: &Position, contact: &PositionContact) -> Factors {
        let [factors] = self.each_factor(view, position, contact, |f, _, _| [f])?;
        Some(factors)
    }

    /// The factors f, and the same of f + p df/dp: what a small change of pressure changes f p by.
    pub(super) fn factors_and_slopes(
        &self,
        view: &Worn,
        position: &Position,
        contact: &PositionContact,
    ) -> [Factors; 2] {
        let both = self.each_factor(view, position, contact, |f, acting, local| {
            [f, slope(f, acting, local)]
        });
        both.map_or([None, None], |both| both.map(Some))
    }

    fn each_factor<const N: usize>(
        &self,
        view: &Worn,
        position: &Position,
        contact: &PositionContact,
        of: impl Fn(f64, &Acting, &Local) -> [f64; N],
    ) -> Option<[[Vec<f64>; 2]; N]> {
        let acting = self.acting.filter(|a| a.acts(Hook::WearFactor))?;
        let of = |f: f64, local: &Local| of(f, acting, local);
        Some(factors(acting, self.cycle, view, position, contact, of))
    }

    /// What effects add at every station, mm per pinion cycle.
    fn added(&self, view: &Worn, solved: &Solved) -> Vec<Added> {
        self.each_added(view, solved, |depths, _, _| depths)
    }

    /// How that changes with the largest pressure there, mm per MPa.
    fn added_slopes(&self, view: &Worn, solved: &Solved) -> Vec<Added> {
        const STEP: f64 = 1e-4;
        self.each_added(view, solved, |depths, acting, local| {
            if local.pressure <= 0.0 {
                return [0.0; 2];
            }
            let mut more = *local;
            more.pressure *= 1.0 + STEP;
            more.peak_pressure *= 1.0 + STEP;
            let moved = acting.effects.added_depths(&more);
            [0, 1].map(|i| (moved[i] - depths[i]) / (STEP * local.pressure))
        })
    }

    fn each_added(
        &self,
        view: &Worn,
        solved: &Solved,
        of: impl Fn([f64; 2], &Acting, &Local) -> [f64; 2],
    ) -> Vec<Added> {
        let (Some(acting), Some(passage)) = (self.acting, self.passage) else {
            return Vec::new();
        };
        let cycle = self.cycle;
        let locals: Vec<_> = (0..passage.order.len())
            .map(|m| {
                let pair = passage.pair(cycle, m);
                let load = PairLoad::of(pair, &solved.contacts[passage.order[m].0]);
                acting.at_pair(cycle, pair, load, view.age)
            })
            .collect();
        let mut out = Vec::new();
        for member in Member::BOTH {
            let side = side(member);
            let per_cycle =
                1e-3 / [1.0, cycle.pair.speed_ratio][side] / cycle.pair.cos_base_helix();
            for (station, moment) in solved.moments[side].iter().enumerate() {
                let mut local = locals[moment.pair];
                local.peak_pressure = moment.pressure;
                let arc = cycle.stations.arc[side][station];
                let depth = view.depth[side][station];
                acting.at_point(&mut local, cycle, member, arc, depth, moment.pressure);
                let depths = acting.effects.added_depths(&local);
                let [removed, displaced] = of(depths, acting, &local);
                out.push(Added {
                    side,
                    station,
                    removed: per_cycle * removed,
                    displaced: per_cycle * displaced,
                });
            }
        }
        out
    }

    /// Where the largest pressures are read; nothing where no effect asks.
    pub(super) fn reads(&self, solved: &Solved) -> Reads {
        let Some(passage) = self.passage else {
            return Reads::default();
        };
        let read = |side| passage.reads(self.cycle, &solved.contacts, side, &solved.moments[side]);
        [read(0), read(1)]
    }

    /// What the slopes of added depths put into the Jacobian, by position.
    pub(super) fn added_reads(
        &self,
        view: &Worn,
        solved: &Solved,
        reads: &Reads,
    ) -> Vec<AddedReads> {
        let mut by_position = vec![Vec::new(); self.cycle.positions.len()];
        if self.passage.is_none() {
            return by_position;
        }
        let shift = [0, self.cycle.stations.arc[0].len()];
        for added in self.added_slopes(view, solved) {
            let at = shift[added.side] + added.station;
            let slope = added.removed + added.displaced;
            for &(q, k, weight) in &reads[added.side][added.station] {
                if weight != 0.0 {
                    by_position[q as usize].push((k as usize, at, weight * slope));
                }
            }
        }
        by_position
    }

    /// The rate, and products of its Jacobian −Dᵀ S G with vectors v, from `responses` S G v by vector and position, each on the active set.
    pub(super) fn rate_and_products(
        &self,
        n: f64,
        solved: &Solved,
        reads: &Reads,
        responses: &[Vec<Vec<f64>>],
    ) -> (Vec<f64>, Vec<Vec<f64>>) {
        if responses.is_empty() {
            return (self.rate(n, solved, None), Vec::new());
        }
        let view = self.view(n, &solved.u);
        let scale = self.scale();
        let added = self.added_reads(&view, solved, reads);
        let stations = self.cycle.stations.arc[0].len();
        let mut rate = vec![0.0; solved.u.len()];
        let mut products = vec![vec![0.0; solved.u.len()]; responses.len()];
        for (q, (position, contact)) in
            (self.cycle.positions.iter().zip(&solved.contacts)).enumerate()
        {
            let [factors, slopes] = self.factors_and_slopes(&view, position, contact);
            self.add_rate(&mut rate, position, contact, factors.as_ref());
            for (product, response) in products.iter_mut().zip(responses) {
                let (pinion, gear) = product.split_at_mut(stations);
                for (&k, y) in contact.active.iter().zip(&response[q]) {
                    let pair = &position.pairs[position.owner(k)];
                    for (side, out) in [&mut *pinion, &mut *gear].into_iter().enumerate() {
                        let slope = slopes.as_ref().map_or(1.0, |s| s[side][k]);
                        pair.wear[side].scatter(k - pair.offset, -scale[side] * slope * y, out);
                    }
                }
                for &(k, at, value) in &added[q] {
                    if let Ok(i) = contact.active.binary_search(&k) {
                        product[at] -= value * response[q][i];
                    }
                }
            }
        }
        self.add_added(&mut rate, &view, solved);
        (rate, products)
    }
}

/// f + p df/dp at a place with the factor f.
fn slope(f: f64, acting: &Acting, local: &Local) -> f64 {
    const STEP: f64 = 1e-4;
    let mut more = *local;
    more.pressure *= 1.0 + STEP;
    more.peak_pressure *= 1.0 + STEP;
    f + (acting.effects.wear_factor(&more) - f) / STEP
}

/// What effects add at one station, or its change with the largest pressure there.
struct Added {
    side: usize,
    station: usize,
    /// mm per pinion cycle, material lost.
    removed: f64,
    /// mm per pinion cycle, material moved aside.
    displaced: f64,
}
