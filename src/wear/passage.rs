//! What every flank point sees while contacts pass over it: the largest pressure, and when.
//!
//! All tooth pairs of a mesh cycle, put in a row by their place on the path of contact, are one tooth pair's passage. Its
//! pressure is carried along the flank between positions, as the wear is (`contact::deposit`):
//!
//! ```text
//! p(s, t) = (1 − t) p_m(s − c(t) + c_m) + t p_{m+1}(s − c(t) + c_{m+1}),   c(t) = (1 − t) c_m + t c_{m+1}
//! ```
//! A law that takes the largest of it to a high power has no limit on finer grids: the largest pressure sees the crests of waves
//! and not their troughs, and waves shorter than the sliding during a passage grow. What such a law sees is therefore the
//! pressure averaged around the point, by weights that fade out linearly: an even average turns waves between a half and once its length upside down,
//! troughs are then worn as crests, and they grow where sliding does not level them, from the pitch point on.

use std::borrow::Cow;

use crate::contact::cycle::{Cycle, PairContact};
use crate::contact::model::PositionContact;
use crate::numeric::average::{Average, fading_average};
use crate::numeric::interpolate;

/// Instants looked at between two positions.
const INSTANTS: usize = 4;

/// The moment at which a flank point sees its largest pressure.
#[derive(Debug, Clone, PartialEq)]
pub struct Moment {
    /// Largest pressure, MPa; 0 if nothing touches the point.
    pub pressure: f64,
    /// Number of the tooth pair in the passage: the nearer one of the two around the moment.
    pub pair: usize,
    /// When that is: a number of the passage, and the share of the way from there to the next. None if nothing touches the point.
    instant: Option<(usize, f64)>,
}

/// The order in which a tooth pair runs through the positions of a mesh cycle: (position, pair).
#[derive(Debug, Clone, PartialEq)]
pub struct Passage {
    /// By ascending path.
    pub order: Vec<(usize, usize)>,
    /// In that order, for pinion and gear: arc at ξ = 0, mm.
    middles: [Vec<f64>; 2],
    /// In that order, for pinion and gear: weights of the pair's unknowns in the average at each of them. Empty: no average.
    averages: Vec<[Vec<Average>; 2]>,
}

impl Passage {
    /// The passage of `cycle`, with the pressure at points.
    pub fn new(cycle: &Cycle) -> Self {
        let mut order: Vec<(usize, usize)> = (cycle.positions.iter().enumerate())
            .flat_map(|(q, position)| (0..position.pairs.len()).map(move |i| (q, i)))
            .collect();
        let path = |&(q, i): &(usize, usize)| cycle.positions[q].pairs[i].path;
        order.sort_by(|a, b| path(a).total_cmp(&path(b)));
        let middles = [0, 1].map(|side| {
            let pairs = order.iter().map(|&(q, i)| &cycle.positions[q].pairs[i]);
            pairs
                .map(|pair| interpolate(&pair.xi, &pair.arc[side], 0.0))
                .collect()
        });
        Self {
            order,
            middles,
            averages: Vec::new(),
        }
    }

    /// The passage of `cycle`, with the pressure averaged around each point, fading out linearly over `reach` (mm of arc) on both sides.
    pub fn averaged(cycle: &Cycle, reach: f64) -> Self {
        let mut passage = Self::new(cycle);
        let weights = |arc: &[f64]| -> Vec<Average> {
            let around = |k: usize| fading_average(arc, arc[k], reach);
            (0..arc.len()).map(around).collect()
        };
        let of_pair = |&(q, i): &(usize, usize)| {
            let arc = &cycle.positions[q].pairs[i].arc;
            [weights(&arc[0]), weights(&arc[1])]
        };
        passage.averages = passage.order.iter().map(of_pair).collect();
        passage
    }

    /// The pair number `m` of the passage.
    pub fn pair<'a>(&self, cycle: &'a Cycle, m: usize) -> &'a PairContact {
        let (q, i) = self.order[m];
        &cycle.positions[q].pairs[i]
    }

    /// The moment of largest pressure of every station of one flank (0 pinion, 1 gear).
    pub fn moments(&self, cycle: &Cycle, contacts: &[PositionContact], side: usize) -> Vec<Moment> {
        let stations = &cycle.stations.arc[side];
        let nothing = Moment {
            pressure: 0.0,
            pair: 0,
            instant: None,
        };
        let mut moments = vec![nothing; stations.len()];
        let views: Vec<View> = (0..self.order.len())
            .map(|m| self.view(cycle, contacts, side, m))
            .collect();
        let instants: Vec<Instant> = (0..views.len().saturating_sub(1))
            .flat_map(|m| (0..INSTANTS).map(move |n| (m, n as f64 / INSTANTS as f64)))
            .filter_map(|(m, t)| Instant::between(&views[m..m + 2], m, t))
            .collect();
        // what a point sees when the middle of the contact passes it is nearly the largest: most other instants need no look
        let mut at_least = vec![0.0_f64; stations.len()];
        for instant in &instants {
            let near = 0.5 * instant.advance;
            for i in instant.stations(stations, [-near, near]) {
                at_least[i] = at_least[i].max(instant.pressure(stations[i]));
            }
        }
        for instant in &instants {
            for i in instant.stations(stations, instant.loaded) {
                if instant.peak < at_least[i] || instant.peak <= moments[i].pressure {
                    continue;
                }
                let pressure = instant.pressure(stations[i]);
                if pressure > moments[i].pressure {
                    let Instant { m, t, .. } = *instant;
                    moments[i] = Moment {
                        pressure,
                        pair: if t < 0.5 { m } else { m + 1 },
                        instant: Some((m, t)),
                    };
                }
            }
        }
        for (moment, arc) in moments.iter_mut().zip(stations) {
            if moment.pressure == 0.0 {
                moment.pair = self.nearest(side, *arc);
            }
        }
        moments
    }

    /// Where the pressure of each of the `moments` of one flank is read: unknowns as (position, unknown of the position, weight).
    pub fn reads(
        &self,
        cycle: &Cycle,
        contacts: &[PositionContact],
        side: usize,
        moments: &[Moment],
    ) -> Vec<Vec<(u32, u32, f64)>> {
        let views: Vec<View> = (0..self.order.len())
            .map(|m| self.view(cycle, contacts, side, m))
            .collect();
        let read = |(moment, arc): (&Moment, &f64)| {
            let Some((m, t)) = moment.instant else {
                return Vec::new();
            };
            let (from, to) = (&views[m], &views[m + 1]);
            let offset = arc - ((1.0 - t) * from.centre + t * to.centre);
            [(from, 1.0 - t), (to, t)]
                .into_iter()
                .flat_map(|(view, weight)| {
                    let both = view.at(offset).into_iter();
                    both.flat_map(move |(k, share)| view.unknowns(k, weight * share))
                })
                .collect()
        };
        let stations = &cycle.stations.arc[side];
        moments.iter().zip(stations).map(read).collect()
    }

    fn view<'a>(
        &'a self,
        cycle: &'a Cycle,
        contacts: &'a [PositionContact],
        side: usize,
        m: usize,
    ) -> View<'a> {
        let position = self.order[m].0;
        View::new(
            position,
            self.pair(cycle, m),
            &contacts[position],
            side,
            self.middles[side][m],
            self.averages.get(m).map(|both| both[side].as_slice()),
        )
    }

    /// The pair of the passage whose middle passes nearest to the point at `arc`, mm.
    fn nearest(&self, side: usize, arc: f64) -> usize {
        let distance = |m: &usize| (self.middles[side][*m] - arc).abs();
        let nearer = |a: &usize, b: &usize| distance(a).total_cmp(&distance(b));
        (0..self.order.len()).min_by(nearer).unwrap_or(0)
    }
}

/// An instant of the passage, a share `t` of the way from number `m` of it to the next.
struct Instant<'v> {
    m: usize,
    t: f64,
    views: [&'v View<'v>; 2],
    /// Arc of the contact's middle, mm.
    centre: f64,
    /// How far that moves until the next instant, mm.
    advance: f64,
    /// Arc from the middle between which there is pressure, mm.
    loaded: [f64; 2],
    /// No pressure is larger, MPa.
    peak: f64,
}

impl<'v> Instant<'v> {
    /// None if nothing touches then.
    fn between(views: &'v [View<'v>], m: usize, t: f64) -> Option<Self> {
        let [from, to] = views else { return None };
        let ends = [from, to].map(|view| view.loaded).into_iter().flatten();
        let loaded = ends.reduce(|(a, b), (low, high)| (a.min(low), b.max(high)))?;
        Some(Self {
            m,
            t,
            views: [from, to],
            centre: (1.0 - t) * from.centre + t * to.centre,
            advance: (to.centre - from.centre).abs() / INSTANTS as f64,
            loaded: loaded.into(),
            peak: (1.0 - t) * from.peak + t * to.peak,
        })
    }

    /// Those of the `stations` that lie so far from the middle.
    fn stations(&self, stations: &[f64], [low, high]: [f64; 2]) -> std::ops::Range<usize> {
        let first = stations.partition_point(|&s| s < self.centre + low);
        first..stations.partition_point(|&s| s <= self.centre + high)
    }

    /// The pressure at the point at `arc`, MPa.
    fn pressure(&self, arc: f64) -> f64 {
        let offset = arc - self.centre;
        let [from, to] = self.views;
        (1.0 - self.t) * from.pressure(offset) + self.t * to.pressure(offset)
    }
}

/// The pressure of one tooth pair over arc from its middle.
struct View<'a> {
    position: u32,
    first: u32,
    centre: f64,
    arc: &'a [f64],
    pressure: Cow<'a, [f64]>,
    /// The largest of it, MPa.
    peak: f64,
    averages: Option<&'a [Average]>,
    /// Arc from the middle between which there is pressure, mm.
    loaded: Option<(f64, f64)>,
}

impl<'a> View<'a> {
    fn new(
        q: usize,
        pair: &'a PairContact,
        contact: &'a PositionContact,
        side: usize,
        centre: f64,
        averages: Option<&'a [Average]>,
    ) -> Self {
        let own = &contact.pressure[pair.offset..pair.offset + pair.xi.len()];
        let touches = own.iter().any(|p| *p > 0.0);
        let averaged = averages.filter(|_| touches);
        let pressure: Cow<'a, [f64]> = averaged.map_or(Cow::Borrowed(own), |averages| {
            let mean = |average: &Average| average.iter().map(|&(k, weight)| weight * own[k]).sum();
            averages.iter().map(mean).collect()
        });
        let arc = &pair.arc[side];
        let loaded = |k: &usize| pressure[*k] > 0.0;
        let ends = (0..pressure.len())
            .find(loaded)
            .zip((0..pressure.len()).rev().find(loaded));
        let loaded = ends.map(|(first, last)| {
            let [a, b] = [first.saturating_sub(1), (last + 1).min(arc.len() - 1)];
            let [a, b] = [arc[a] - centre, arc[b] - centre];
            (a.min(b), a.max(b))
        });
        Self {
            position: q as u32,
            first: pair.offset as u32,
            centre,
            arc,
            peak: pressure.iter().fold(0.0, |m, p| m.max(*p)),
            pressure,
            averages,
            loaded,
        }
    }

    /// The unknowns behind the value at node `k`, with their weights times `weight`.
    fn unknowns(&self, k: usize, weight: f64) -> Vec<(u32, u32, f64)> {
        let unknown =
            |(k, share): (usize, f64)| (self.position, self.first + k as u32, weight * share);
        match self.averages {
            Some(averages) => averages[k].iter().copied().map(unknown).collect(),
            None => vec![unknown((k, 1.0))],
        }
    }

    /// The pressure at the point `offset` (mm of arc) from the middle, MPa.
    fn pressure(&self, offset: f64) -> f64 {
        let [(a, left), (b, right)] = self.at(offset);
        left * self.pressure[a] + right * self.pressure[b]
    }

    /// The two nodes around the point `offset` (mm of arc) from the middle, with their weights; weight 0 outside.
    fn at(&self, offset: f64) -> [(usize, f64); 2] {
        let s = self.centre + offset;
        let last = self.arc.len() - 1;
        // the gear's arc falls where ξ grows
        let rising = self.arc[last] >= self.arc[0];
        let passed = |x: f64| if rising { x <= s } else { x >= s };
        // nodes lie about evenly, so the place is looked for near where it would then be
        let share = (s - self.arc[0]) / (self.arc[last] - self.arc[0]);
        let mut after = (share * last as f64 + 1.0).clamp(0.0, (last + 1) as f64) as usize;
        while after <= last && passed(self.arc[after]) {
            after += 1;
        }
        while after > 0 && !passed(self.arc[after - 1]) {
            after -= 1;
        }
        if after == 0 || after > last {
            return [(0, 0.0), (0, 0.0)];
        }
        let t = (s - self.arc[after - 1]) / (self.arc[after] - self.arc[after - 1]);
        [(after - 1, 1.0 - t), (after, t)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::contact_point::ContactPoint;
    use crate::contact::cycle::{CycleSpec, Stations};
    use crate::contact::frame::tests::reference;
    use crate::contact::hertz::HertzContact;
    use crate::contact::model::ContactModel;

    /// Of all instants, none left out, the first with the largest pressure, to the bit: on new flanks and on some that waves have worn.
    #[test]
    fn the_largest_pressure_is_that_of_all_instants() {
        let pair = reference();
        let spec = CycleSpec {
            positions: 23,
            spacing: 0.02,
            even: 0.2,
            window: 0.2,
            reach: 0.02,
        };
        let cycle = Cycle::new(&pair, &Stations::new(&pair, 0.02), spec);
        let points = ContactPoint::all(&cycle, None);
        let hertz = HertzContact::new(&cycle, &points, 3000.0, 1.15e5, 14.0);
        for waves in [0.0, 0.01] {
            let worn = |arc: &Vec<f64>| -> Vec<f64> {
                arc.iter()
                    .map(|s| waves * (1.0 + (5.0 * s).sin()))
                    .collect()
            };
            let depth = [0, 1].map(|side| worn(&cycle.stations.arc[side]));
            let depth = [depth[0].as_slice(), depth[1].as_slice()];
            let contacts: Vec<PositionContact> = (0..spec.positions)
                .map(|q| hertz.solve(q, depth, &[]).unwrap())
                .collect();
            for passage in [Passage::new(&cycle), Passage::averaged(&cycle, 0.1)] {
                for side in [0, 1] {
                    let views: Vec<View> = (0..passage.order.len())
                        .map(|m| passage.view(&cycle, &contacts, side, m))
                        .collect();
                    let moments = passage.moments(&cycle, &contacts, side);
                    assert!(moments.iter().any(|moment| moment.pressure > 500.0));
                    for (moment, arc) in moments.iter().zip(&cycle.stations.arc[side]) {
                        let mut largest = (0.0, None);
                        for m in 0..views.len() - 1 {
                            for n in 0..INSTANTS {
                                let t = n as f64 / INSTANTS as f64;
                                let (from, to) = (&views[m], &views[m + 1]);
                                let offset = arc - ((1.0 - t) * from.centre + t * to.centre);
                                let pressure =
                                    (1.0 - t) * from.pressure(offset) + t * to.pressure(offset);
                                if pressure > largest.0 {
                                    largest = (pressure, Some((m, t)));
                                }
                            }
                        }
                        assert_eq!((moment.pressure, moment.instant), largest, "at {arc}");
                    }
                }
            }
        }
    }
}
