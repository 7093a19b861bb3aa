//! Derivatives of the analytic contact: of its load sharing, then of Hertz's ellipse on the nodes of each pair.
//!
//! ```text
//! p_k = w s_k/A,  s_k = √(1 − t_k²),  t_k = (ξ_k − ξ₀)/b,  A = Σ s_l L_l       db/b = ½ (dw/w + dR/R)
//! ds_k = (t_k dξ₀ + t_k² db)/(b s_k)
//! ```

use super::{HertzContact, Spring};
use crate::analytic::hertz_line;
use crate::contact::contact_point::ContactPoint;
use crate::contact::model::PositionContact;
use crate::contact::slices::Flanks;
use crate::contact::tangent::{
    AlterationChange, Change, ContactTangent, LinearContact, LinearSlices,
};
use crate::numeric::interpolate;

/// The analytic contact of one position, or of all slices at one turn.
pub(super) struct HertzLinear<'m> {
    model: &'m HertzContact<'m>,
    /// Section position of each slice, and its number of unknowns.
    at: Vec<usize>,
    nodes: Vec<usize>,
    springs: Vec<Spring>,
    /// Nodes of each spring's pair: first unknown, and derivatives of their pressures.
    ellipses: Vec<Option<Ellipse>>,
}

/// Pressures of a loaded pair, per change of what they follow from.
struct Ellipse {
    first: usize,
    per_load: Vec<f64>,
    per_centre: Vec<f64>,
    /// Per relative change of the relative radius.
    per_radius: Vec<f64>,
}

impl<'m> HertzLinear<'m> {
    pub(super) fn new(
        model: &'m HertzContact<'m>,
        at: &[usize],
        contacts: &[&PositionContact],
        flanks: &Flanks<'_>,
    ) -> Self {
        let springs = model.springs_at(at, flanks);
        let loads = model.loads(&springs).loads;
        let ellipses = (springs.iter().zip(&loads))
            .map(|(spring, load)| {
                let (q, contact) = (at[spring.slice], contacts[spring.slice]);
                (*load > 0.0).then(|| Ellipse::new(model, q, spring.index, *load, contact))
            })
            .collect();
        Self {
            model,
            at: at.to_vec(),
            nodes: contacts.iter().map(|c| c.pressure.len()).collect(),
            springs,
            ellipses,
        }
    }

    /// How the springs change: gap, stiffness, factor.
    fn slopes(&self, change: &Change<'_>) -> Vec<Slope> {
        let lead = change.altered.and_then(|a| a.alteration.lead.as_ref());
        let slope = |spring: &Spring| {
            let (slice, q) = (spring.slice, self.at[spring.slice]);
            let position = &self.model.cycle.positions[q];
            let pair = &position.pairs[spring.index];
            let mut slope = Slope {
                gap: change.flanks.back_of(slice)[spring.index]
                    + lead.map_or(0.0, |lead| lead[slice])
                    + (0..2)
                        .map(|side| {
                            let stations = &self.model.cycle.stations.arc[side];
                            let depth = change.flanks.of(slice)[spring.index][side];
                            interpolate(stations, depth, pair.facing.arc[side])
                        })
                        .sum::<f64>(),
                stiffness: 0.0,
                factor: 0.0,
            };
            if let Some(altered) = change.altered {
                let alteration = &altered.alteration;
                // 1/c = 1/c₀ + q
                slope.stiffness = -spring.stiffness * spring.stiffness * alteration.flexibility;
                let share = self.model.slices.map_or(1.0, |slices| slices.weight[slice]);
                slope.factor = alteration.factor_slope(q, spring.index) / share;
                slope.gap +=
                    (altered.points.as_ref()).map_or(0.0, |points| points[q][spring.index].gap);
            }
            slope
        };
        self.springs.iter().map(slope).collect()
    }

    /// As [`HertzContact::loads`].
    fn loads(&self, slopes: &[Slope]) -> (Vec<f64>, f64) {
        let all: Vec<usize> = (0..self.springs.len()).collect();
        let present = |i: &usize| self.springs[*i].present;
        if all.iter().all(|i| present(i) == (-0.5, 0.5)) {
            return self.loads_of(&all, slopes);
        }
        let mut times: Vec<f64> = (all.iter().map(present))
            .flat_map(|(from, to)| [from, to])
            .collect();
        times.sort_by(f64::total_cmp);
        let mut mean = (vec![0.0; all.len()], 0.0);
        for (from, to) in times.iter().zip(&times[1..]).filter(|(a, b)| a < b) {
            let there = |i: &usize| present(i).0 <= *from && *to <= present(i).1;
            let now: Vec<usize> = all.iter().copied().filter(there).collect();
            let (loads, delta) = self.loads_of(&now, slopes);
            for (&i, load) in now.iter().zip(loads) {
                mean.0[i] += (to - from) * load;
            }
            mean.1 += (to - from) * delta;
        }
        mean
    }

    /// As [`HertzContact::loads_of`], of the springs `now`.
    fn loads_of(&self, now: &[usize], slopes: &[Slope]) -> (Vec<f64>, f64) {
        let springs: Vec<Spring> = now.iter().map(|&i| self.springs[i]).collect();
        let slopes: Vec<Slope> = now.iter().map(|&i| slopes[i]).collect();
        share_slope(&springs, &slopes, self.model.load)
    }
}

/// How a spring changes.
#[derive(Clone, Copy)]
struct Slope {
    gap: f64,
    stiffness: f64,
    factor: f64,
}

/// Derivatives of the springs' loads and of the approach at which they carry `load` together.
fn share_slope(springs: &[Spring], slopes: &[Slope], load: f64) -> (Vec<f64>, f64) {
    let delta = super::share(springs, load);
    let closed = |spring: &Spring| (delta - spring.gap).max(0.0);
    // Σ c_i (δ − g_i)/f_i = load over those that touch
    let (mut counted, mut moved) = (0.0, 0.0);
    for (spring, slope) in springs.iter().zip(slopes).filter(|(s, _)| closed(s) > 0.0) {
        let per_factor = spring.stiffness / spring.factor;
        let change = (slope.stiffness - per_factor * slope.factor) / spring.factor;
        counted += per_factor;
        moved += per_factor * slope.gap - change * closed(spring);
    }
    let turn = if counted > 0.0 { moved / counted } else { 0.0 };
    let loads = springs.iter().zip(slopes).map(|(spring, slope)| {
        if closed(spring) > 0.0 {
            slope.stiffness * closed(spring) + spring.stiffness * (turn - slope.gap)
        } else {
            0.0
        }
    });
    (loads.collect(), turn)
}

impl Ellipse {
    fn new(
        model: &HertzContact<'_>,
        q: usize,
        index: usize,
        load: f64,
        contact: &PositionContact,
    ) -> Self {
        let pair = &model.cycle.positions[q].pairs[index];
        let ContactPoint { centre, radius, .. } = model.points[q][index];
        let half_width = hertz_line::half_width(load, radius, model.modulus);
        let place = |x: &f64| (x - centre) / half_width;
        let heights: Vec<f64> = (pair.xi.iter())
            .map(|x| (1.0 - place(x).powi(2)).max(0.0).sqrt())
            .collect();
        let area: f64 = heights.iter().zip(&pair.length).map(|(s, l)| s * l).sum();
        let pressure = &contact.pressure[pair.offset..pair.offset + pair.xi.len()];
        // narrower than the grid: one node carries it all
        let slopes = |f: &dyn Fn(f64) -> f64| -> Vec<f64> {
            let raw: Vec<f64> = (heights.iter().zip(&pair.xi))
                .map(|(s, x)| {
                    if *s > 0.0 {
                        f(place(x)) / (half_width * s)
                    } else {
                        0.0
                    }
                })
                .collect();
            let lost: f64 = raw.iter().zip(&pair.length).map(|(s, l)| s * l).sum();
            let rescaled = (raw.iter().zip(pressure)).map(|(ds, p)| {
                if area > 0.0 {
                    (load * ds - p * lost) / area
                } else {
                    0.0
                }
            });
            rescaled.collect()
        };
        let per_width = slopes(&|t| t * t);
        Self {
            first: pair.offset,
            per_load: (pressure.iter().zip(&per_width))
                .map(|(p, wider)| p / load + 0.5 * half_width * wider / load)
                .collect(),
            per_centre: slopes(&|t| t),
            per_radius: per_width.iter().map(|w| 0.5 * half_width * w).collect(),
        }
    }
}

impl LinearSlices for HertzLinear<'_> {
    fn tangents(&self, change: &Change<'_>) -> Vec<ContactTangent> {
        let (loads, delta) = self.loads(&self.slopes(change));
        let still = |nodes: &usize| ContactTangent {
            pressure: vec![0.0; *nodes],
            approach: delta / self.model.cycle.pair.pinion.base_radius,
        };
        let mut out: Vec<ContactTangent> = self.nodes.iter().map(still).collect();
        let points = change.altered.and_then(|altered| altered.points.as_ref());
        for ((spring, ellipse), load) in self.springs.iter().zip(&self.ellipses).zip(loads) {
            let Some(ellipse) = ellipse else { continue };
            let pressure = &mut out[spring.slice].pressure;
            let own = &mut pressure[ellipse.first..ellipse.first + ellipse.per_load.len()];
            for (p, per) in own.iter_mut().zip(&ellipse.per_load) {
                *p = per * load;
            }
            if let Some(points) = points {
                let q = self.at[spring.slice];
                let point = points[q][spring.index];
                let radius = point.radius / self.model.points[q][spring.index].radius;
                let per = ellipse.per_centre.iter().zip(&ellipse.per_radius);
                for (p, (per_centre, per_radius)) in own.iter_mut().zip(per) {
                    *p += per_centre * point.centre + per_radius * radius;
                }
            }
        }
        out
    }

    fn responses(&self, _: &Flanks<'_>) -> Vec<Vec<f64>> {
        vec![Vec::new(); self.nodes.len()]
    }

    fn response_tangents(&self, _: &[Vec<f64>], _: &AlterationChange) -> Option<Vec<Vec<f64>>> {
        None
    }
}

impl LinearContact for HertzLinear<'_> {
    fn tangent(&self, change: &Change<'_>) -> ContactTangent {
        self.tangents(change).swap_remove(0)
    }

    fn response(&self, _: &Flanks<'_>) -> Vec<f64> {
        Vec::new()
    }

    fn response_tangent(&self, _: &[f64], _: &AlterationChange) -> Option<Vec<f64>> {
        None
    }
}
