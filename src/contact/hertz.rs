//! The analytic contact model: elastic load sharing between tooth pairs and Hertz line contact on each.
//!
//! ```text
//! w_i = c(y_i) · max(0, δ − e_i),   Σ w_i = w            c(y) = c_max cos(β₀ (ξ(y) − ε_α/2)),  ξ = (y − y_A)/p_b
//! β₀ = [½ (1.11 + ε_α/2)² − 1.17]^(−1/2)                  c_max = c'_th E/E_St of ISO 6336-1, N/(mm·µm)
//! ```
//! The stiffness curve is Pedrero, Pleguezuelos, Artés & Antona, Mech. Mach. Theory 45 (2010), as refined by Sánchez et
//! al. (2013); e_i are worn depth and profile deviations where the pair touches (`contact_point`). Assumed away: contact outside the path
//! of contact, the wear's influence on the pressure's shape, and the bodies beyond the teeth.
//!
//! Of helical gears the slices of the face are such springs side by side, each where its section is on the path: Σ over slices and pairs
//! of their widths' shares times w_i is w. (`face`)

mod face;
mod tangent;

use nalgebra::DMatrix;

use crate::analytic::hertz_line;
use crate::contact::alteration::Alteration;
use crate::contact::contact_point::ContactPoint;
use crate::contact::cycle::{Cycle, PairContact};
use crate::contact::model::{ContactError, ContactModel, PositionContact, SlicedContact};
use crate::contact::sequence::Sequence;
use crate::contact::slices::{Flanks, Slices};
use crate::contact::tangent::LinearContact;
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
    /// Where pairs touch, by position and pair.
    points: &'a [Vec<ContactPoint>],
    /// Teeth that differ.
    sequence: Option<&'a Sequence>,
    /// More than one slice of the face.
    slices: Option<&'a Slices>,
}

impl<'a> HertzContact<'a> {
    /// Contact of pairs that touch at `points`, under a pinion torque per face width (N·mm/mm) with the contact modulus E* (MPa) and the
    /// largest tooth pair stiffness `stiffness` (N/(mm·µm)).
    pub fn new(
        cycle: &'a Cycle,
        points: &'a [Vec<ContactPoint>],
        torque: f64,
        modulus: f64,
        stiffness: f64,
    ) -> Self {
        Self {
            cycle,
            load: torque / cycle.pair.pinion.base_radius,
            modulus,
            stiffness: 1e3 * stiffness,
            fall: (0.5 * (1.11 + 0.5 * cycle.pair.contact_ratio).powi(2) - 1.17).powf(-0.5),
            alteration: None,
            points,
            sequence: None,
            slices: None,
        }
    }

    /// The same with the face in slices; none: one section.
    pub fn across(mut self, slices: Option<&'a Slices>) -> Self {
        self.slices = slices;
        self
    }

    /// The same with teeth that differ; none: all are alike.
    pub fn in_turn(mut self, sequence: Option<&'a Sequence>) -> Self {
        self.sequence = sequence;
        self
    }

    /// The same with what effects change besides the contact points.
    pub fn with(mut self, alteration: &'a Alteration) -> Self {
        self.alteration = Some(alteration);
        self
    }

    fn stiffness_at(&self, pair: &PairContact) -> f64 {
        let geometry = &self.cycle.pair;
        let xi = (geometry.rho_c + pair.path - geometry.rho_a) / geometry.base_pitch;
        self.stiffness * (self.fall * (xi - 0.5 * geometry.contact_ratio)).cos()
    }

    /// The tooth pairs that meet on the line of action while the mesh passes position `q`.
    fn springs(&self, q: usize, flanks: &Flanks<'_>) -> Vec<Spring> {
        self.springs_of(q, flanks, (0, 0.0, 1.0))
    }

    /// Those of a slice at the section position `q`: its number, what is missing in it (mm) and its share of the face.
    fn springs_of(
        &self,
        q: usize,
        flanks: &Flanks<'_>,
        (slice, missing, share): (usize, f64, f64),
    ) -> Vec<Spring> {
        let position = &self.cycle.positions[q];
        let spring = |(index, pair): (usize, &PairContact)| {
            let present = self.present(pair)?;
            let mut stiffness = self.stiffness_at(pair);
            let gap = self.points[q][index].gap
                + self.worn(pair, flanks.of(slice)[index])
                + (flanks.back_of(slice)[index] + missing);
            let mut factor = 1.0;
            if let Some(alteration) = self.alteration {
                if alteration.flexibility != 0.0 {
                    stiffness /= 1.0 + alteration.flexibility * stiffness;
                }
                factor = alteration.factor(q, index);
            }
            Some(Spring {
                slice,
                index,
                stiffness,
                gap,
                factor: factor / share,
                present,
            })
        };
        let pairs = position.pairs.iter().enumerate();
        pairs.filter_map(spring).collect()
    }

    /// From when to when a pair is on the path of contact, of the time from −½ to ½ for which its position stands.
    fn present(&self, pair: &PairContact) -> Option<(f64, f64)> {
        let geometry = &self.cycle.pair;
        let step = geometry.base_pitch / self.cycle.spec.positions as f64;
        let until = |rho: f64| (rho - geometry.rho_c - pair.path) / step;
        let (from, to) = (
            until(geometry.rho_a).max(-0.5),
            until(geometry.rho_e).min(0.5),
        );
        (from < to).then_some((from, to))
    }

    /// Mean line loads and approach of `springs` over the time for which their position stands.
    ///
    /// Pairs come and go within it. Were they there for all of it or not at all, the wear next to the ends of the path would jump wherever
    /// another mounting moves an end past a position.
    fn loads(&self, springs: &[Spring]) -> Carried {
        if springs.iter().all(|s| s.present == (-0.5, 0.5)) {
            return self.loads_of(springs);
        }
        let ends = springs.iter().flat_map(|s| [s.present.0, s.present.1]);
        let mut times: Vec<f64> = ends.collect();
        times.sort_by(f64::total_cmp);
        let mut mean = Carried::none(springs.len());
        for (from, to) in times.iter().zip(&times[1..]).filter(|(a, b)| a < b) {
            let there = |s: &&Spring| s.present.0 <= *from && *to <= s.present.1;
            let now: Vec<Spring> = springs.iter().filter(there).copied().collect();
            let carried = self.loads_of(&now);
            for (mean, spring) in mean.loads.iter_mut().zip(springs) {
                let at = now.iter().position(|s| s.is(spring));
                *mean += (to - from) * at.map_or(0.0, |at| carried.loads[at]);
            }
            mean.approach += (to - from) * carried.approach;
            mean.torque_error = mean.torque_error.max(carried.torque_error);
        }
        mean
    }

    /// Line loads of `springs` (N/mm) and the approach (mm).
    fn loads_of(&self, springs: &[Spring]) -> Carried {
        let approach = share(springs, self.load);
        let loads: Vec<f64> = (springs.iter())
            .map(|s| s.stiffness * (approach - s.gap).max(0.0))
            .collect();
        let counted = springs.iter().zip(&loads).map(|(s, load)| load / s.factor);
        Carried {
            torque_error: (counted.sum::<f64>() / self.load - 1.0).abs(),
            loads,
            approach,
        }
    }

    /// Contact at the section position `q` of the tooth pairs `springs` under their line loads.
    fn contact(&self, q: usize, springs: &[(&Spring, f64)]) -> PositionContact {
        let position = &self.cycle.positions[q];
        let mut pressure = vec![0.0; position.gap.len()];
        let mut active = Vec::new();
        for &(spring, load) in springs.iter().filter(|(_, load)| *load > 0.0) {
            let pair = &position.pairs[spring.index];
            let ContactPoint { centre, radius, .. } = self.points[q][spring.index];
            let half_width = hertz_line::half_width(load, radius, self.modulus);
            let own = &mut pressure[pair.offset..pair.offset + pair.xi.len()];
            for (p, x) in own.iter_mut().zip(&pair.xi) {
                *p = (1.0 - ((x - centre) / half_width).powi(2)).max(0.0).sqrt();
            }
            if own.iter().all(|p| *p == 0.0) {
                // narrower than the grid: the nearest node carries it
                let off = |x: &f64| (x - centre).abs();
                let nearest = |x: &f64| pair.xi.iter().all(|other| off(x) <= off(other));
                own[pair.xi.iter().position(nearest).unwrap_or(0)] = 1.0;
            }
            let area: f64 = own.iter().zip(&pair.length).map(|(p, l)| p * l).sum();
            for (k, p) in own.iter_mut().enumerate().filter(|(_, p)| **p > 0.0) {
                *p *= load / area;
                active.push(pair.offset + k);
            }
        }
        PositionContact {
            pressure,
            approach: 0.0,
            active,
            iterations: 1,
            penetration: 0.0,
            torque_error: 0.0,
        }
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

    fn solve_flanks(
        &self,
        q: usize,
        flanks: &Flanks<'_>,
        _: &[usize],
    ) -> Result<PositionContact, ContactError> {
        let springs = self.springs(q, flanks);
        let Carried {
            loads,
            approach,
            torque_error,
        } = self.loads(&springs);
        let loaded: Vec<(&Spring, f64)> = springs.iter().zip(loads).collect();
        Ok(PositionContact {
            approach: approach / self.cycle.pair.pinion.base_radius,
            torque_error,
            ..self.contact(q, &loaded)
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
        q: usize,
        contact: &PositionContact,
        flanks: &Flanks<'_>,
    ) -> Result<Box<dyn LinearContact + 'm>, ContactError> {
        Ok(Box::new(tangent::HertzLinear::new(
            self,
            &[q],
            &[contact],
            flanks,
        )))
    }

    fn sequence(&self) -> Option<&Sequence> {
        self.sequence
    }

    fn sliced(&self) -> Option<&dyn SlicedContact> {
        self.slices.map(|_| self as &dyn SlicedContact)
    }
}

/// A tooth pair on the line of action.
#[derive(Debug, Clone, Copy)]
struct Spring {
    /// Number of its slice, and of its pair there.
    slice: usize,
    index: usize,
    /// N/mm per mm.
    stiffness: f64,
    /// mm.
    gap: f64,
    /// Its load counts 1/factor in the torque balance, the slice's share of the face included.
    factor: f64,
    /// From when to when it is there, of the time from −½ to ½ for which its position stands.
    present: (f64, f64),
}

impl Spring {
    /// Whether this is the tooth pair of `other`.
    fn is(&self, other: &Self) -> bool {
        (self.slice, self.index) == (other.slice, other.index)
    }
}

/// What tooth pairs carry together.
struct Carried {
    /// Line load of each, N/mm.
    loads: Vec<f64>,
    /// mm.
    approach: f64,
    /// Largest relative difference between the loads' sum and the load.
    torque_error: f64,
}

impl Carried {
    fn none(springs: usize) -> Self {
        Self {
            loads: vec![0.0; springs],
            approach: 0.0,
            torque_error: 0.0,
        }
    }
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
    use crate::contact::cycle::{CycleSpec, Stations};
    use crate::contact::frame::tests::reference;
    use crate::gear::Pair;

    /// Over a mesh cycle as many pairs are there in the mean as the contact ratio says, wherever its positions lie; each position carries
    /// the whole load.
    #[test]
    fn pairs_are_there_for_the_contact_ratio() {
        for (misalignment, positions, reach) in [
            (0.0, 17, 0.02),
            (0.011, 17, 0.008),
            (0.0137, 40, 0.008),
            (0.21, 50, 0.012),
            (0.5, 100, 0.008),
        ] {
            let Pair { pinion, gear, .. } = reference();
            let pair = Pair::new(pinion, gear, 80.0, misalignment).unwrap();
            let spec = CycleSpec {
                positions,
                spacing: 0.02,
                even: 0.2,
                window: 0.2,
                reach,
            };
            let cycle = Cycle::new(&pair, &Stations::new(&pair, 0.02), spec);
            let points = ContactPoint::all(&cycle, None);
            let hertz = HertzContact::new(&cycle, &points, 3000.0, 1.15e5, 14.0);
            let fresh = [0, 1].map(|i| vec![0.0; cycle.stations.arc[i].len()]);
            let depth = [fresh[0].as_slice(), fresh[1].as_slice()];
            let mut there = 0.0;
            for q in 0..spec.positions {
                let pairs = cycle.positions[q].pairs.len();
                let springs = hertz.springs(q, &Flanks::alike(pairs, depth));
                there += springs
                    .iter()
                    .map(|s| s.present.1 - s.present.0)
                    .sum::<f64>();
                let Carried { loads, .. } = hertz.loads(&springs);
                assert!((loads.iter().sum::<f64>() / hertz.load - 1.0).abs() < 1e-12);
            }
            let mean = there / spec.positions as f64;
            assert!((mean - pair.contact_ratio).abs() < 1e-9, "{mean}");
        }
    }

    #[test]
    fn springs_share_the_load() {
        let springs = || {
            vec![
                Spring {
                    slice: 0,
                    index: 0,
                    stiffness: 10.0,
                    gap: 0.0,
                    factor: 1.0,
                    present: (-0.5, 0.5),
                },
                Spring {
                    slice: 0,
                    index: 1,
                    stiffness: 30.0,
                    gap: 0.2,
                    factor: 1.0,
                    present: (-0.5, 0.5),
                },
            ]
        };
        // too small a load to close the second gap
        assert!((share(&springs(), 1.0) - 0.1).abs() < 1e-15);
        // 10 δ + 30 (δ − 0.2) = 10
        assert!((share(&springs(), 10.0) - 0.4).abs() < 1e-15);
    }
}
