//! What every flank point sees while contacts pass over it: the largest pressure, and when.
//!
//! All tooth pairs of a mesh cycle, put in a row by their place on the path of contact, are one tooth pair's passage. Its
//! pressure is carried along the flank between positions, as the wear is (`contact::deposit`):
//!
//! ```text
//! p(s, t) = (1 − t) p_m(s − c(t) + c_m) + t p_{m+1}(s − c(t) + c_{m+1}),   c(t) = (1 − t) c_m + t c_{m+1}
//! ```

use crate::contact::cycle::{Cycle, PairContact};
use crate::contact::model::PositionContact;

/// Instants looked at between two positions.
const INSTANTS: usize = 4;

/// The moment at which a flank point sees its largest pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Largest pressure, MPa; 0 if nothing touches the point.
    pub pressure: f64,
    /// Number of the tooth pair in the passage: the nearer one of the two around the moment.
    pub pair: usize,
    /// Where the pressure is read: unknowns as (position, unknown of the position, weight).
    pub read: [(u32, u32, f64); 4],
}

/// The order in which a tooth pair runs through the positions of a mesh cycle: (position, pair).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Passage {
    /// By ascending path.
    pub order: Vec<(usize, usize)>,
}

impl Passage {
    /// The passage of `cycle`.
    pub fn new(cycle: &Cycle) -> Self {
        let mut order: Vec<(usize, usize)> = (cycle.positions.iter().enumerate())
            .flat_map(|(q, position)| (0..position.pairs.len()).map(move |i| (q, i)))
            .collect();
        let path = |&(q, i): &(usize, usize)| cycle.positions[q].pairs[i].path;
        order.sort_by(|a, b| path(a).total_cmp(&path(b)));
        Self { order }
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
            read: [(0, 0, 0.0); 4],
        };
        let mut moments = vec![nothing; stations.len()];
        let views: Vec<View> = (self.order.iter())
            .map(|&(q, i)| View::new(q, &cycle.positions[q].pairs[i], &contacts[q], side))
            .collect();
        for (m, window) in views.windows(2).enumerate() {
            let [from, to] = window else { continue };
            if from.is_empty() && to.is_empty() {
                continue;
            }
            for instant in 0..INSTANTS {
                let t = instant as f64 / INSTANTS as f64;
                let centre = (1.0 - t) * from.centre + t * to.centre;
                let reach = [from, to].map(|v| v.loaded).into_iter().flatten();
                let (low, high) =
                    reach.fold((f64::MAX, f64::MIN), |(a, b), (l, h)| (a.min(l), b.max(h)));
                let first = stations.partition_point(|&s| s < centre + low);
                let last = stations.partition_point(|&s| s <= centre + high);
                for i in first..last {
                    let offset = stations[i] - centre;
                    let parts = [(from, 1.0 - t), (to, t)];
                    let mut read = [(0, 0, 0.0); 4];
                    let mut pressure = 0.0;
                    for (part, (view, weight)) in parts.into_iter().enumerate() {
                        for (slot, (k, share)) in view.at(offset).into_iter().enumerate() {
                            pressure += weight * share * view.pressure[k];
                            read[2 * part + slot] =
                                (view.position, view.first + k as u32, weight * share);
                        }
                    }
                    if pressure > moments[i].pressure {
                        moments[i] = Moment {
                            pressure,
                            pair: if t < 0.5 { m } else { m + 1 },
                            read,
                        };
                    }
                }
            }
        }
        for (moment, arc) in moments.iter_mut().zip(stations) {
            if moment.pressure == 0.0 {
                moment.pair = self.nearest(cycle, side, *arc);
            }
        }
        moments
    }

    /// The pair of the passage whose middle passes nearest to the point at `arc`, mm.
    fn nearest(&self, cycle: &Cycle, side: usize, arc: f64) -> usize {
        let distance = |m: &usize| {
            let pair = self.pair(cycle, *m);
            (middle(pair, side) - arc).abs()
        };
        let nearer = |a: &usize, b: &usize| distance(a).total_cmp(&distance(b));
        (0..self.order.len()).min_by(nearer).unwrap_or(0)
    }
}

/// Arc of one flank at ξ = 0, mm.
fn middle(pair: &PairContact, side: usize) -> f64 {
    crate::numeric::interpolate(&pair.xi, &pair.arc[side], 0.0)
}

/// The pressure of one tooth pair over arc from its middle.
struct View<'a> {
    position: u32,
    first: u32,
    centre: f64,
    arc: &'a [f64],
    pressure: &'a [f64],
    /// Arc from the middle between which there is pressure, mm.
    loaded: Option<(f64, f64)>,
}

impl<'a> View<'a> {
    fn new(q: usize, pair: &'a PairContact, contact: &'a PositionContact, side: usize) -> Self {
        let pressure = &contact.pressure[pair.offset..pair.offset + pair.xi.len()];
        let arc = &pair.arc[side];
        let centre = middle(pair, side);
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
            pressure,
            loaded,
        }
    }

    fn is_empty(&self) -> bool {
        self.loaded.is_none()
    }

    /// The two nodes around the point `offset` (mm of arc) from the middle, with their weights; weight 0 outside.
    fn at(&self, offset: f64) -> [(usize, f64); 2] {
        let s = self.centre + offset;
        let last = self.arc.len() - 1;
        // the gear's arc falls where ξ grows
        let rising = self.arc[last] >= self.arc[0];
        let after = if rising {
            self.arc.partition_point(|&x| x <= s)
        } else {
            self.arc.partition_point(|&x| x >= s)
        };
        if after == 0 || after > last {
            return [(0, 0.0), (0, 0.0)];
        }
        let t = (s - self.arc[after - 1]) / (self.arc[after] - self.arc[after - 1]);
        [(after - 1, 1.0 - t), (after, t)]
    }
}
