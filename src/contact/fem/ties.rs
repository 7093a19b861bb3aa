//! How slices of a face are tied by the teeth and bodies that they are cut from.
//!
//! A load that varies across the face bends a tooth less than an even one. For a prismatic gear this is known exactly, wave by wave
//! ([`crate::fem::Prism`]), and a wave hardly changes how the contact's own neighbourhood gives way, since it is long against the contact. So only
//! what a tooth pair gives way by as a whole is changed, on the contact point of each pair:
//!
//! ```text
//! f_j = Σ_n F_n c_n(j),  c_n(j) = cos(nπ(j + ½)/N)          line loads of N slices as waves κ_n = nπ/b across the face b
//! v_i = Σ_n≥1 [C(κ_n) − C(0)] F_n c_n(i)                    what slice i gives way by besides its own plane strain
//! ```
//! C is the normal displacement at one flank point per line load at another, of both members, of the same and of neighbouring teeth: the peaks under point loads
//! are the same for all waves and drop out. Even loads stay plane strain to the last bit. Waves end in mirrors; what free ends let
//! the flanks give way by more (`flank_ends`) is added.
//!
//! The cosines are orthogonal with the even load among them, so that this holds for any flank points, one to a slice:
//!
//! ```text
//! E_ij = 2/N Σ_n≥1 [C(κ_n) − C(0)](ρ_i, ρ_j) c_n(i) c_n(j)  = K_|i−j| + K_i+j+1,   K_m = 1/N Σ_n≥1 [C(κ_n) − C(0)] cos(nπ m/N)
//! ```
//! K_m is felt m slices from a load, and i + j + 1 is how far it is by way of the mirror. Slices of helical gears stand at other places of the mesh
//! each, and a tooth that is between two slices' section positions a base pitch apart is one tooth. They are taken as cut from a prism of their section: a tooth turns little over
//! the length on which waves are felt. As the section's own compliance, that of the inclined tooth is C/cos β_b along the path of contact.

use nalgebra::DMatrix;
use rayon::prelude::*;

use super::compliance::member_tooth;
use super::flank_ends::{FacePlace, FlankEnds};
use super::flank_waves::{FlankChange, WaveError, changes};
use crate::contact::cycle::{Cycle, PairContact, Position};
use crate::contact::slices::Slices;
use crate::gear::Gear;
use crate::material::Elastic;

/// Changes of the flanks' compliance with the waves across a face.
#[derive(Debug)]
pub struct ToothWaves {
    /// Slices, as many as waves and the even load.
    slices: usize,
    /// By wave from the first on, pinion then gear.
    waves: Vec<[FlankChange; 2]>,
    /// Of pinion and gear, where the ends of the face are free.
    ends: Option<[FlankEnds; 2]>,
}

impl ToothWaves {
    /// Of two gears with a face `width` (mm) in so many `slices`, its ends free or mirrors.
    ///
    /// # Errors
    /// [`WaveError`].
    pub fn new(
        gears: [&Gear; 2],
        materials: [Elastic; 2],
        width: f64,
        slices: usize,
        free_ends: bool,
    ) -> Result<Self, WaveError> {
        // the pinion of a right-handed pair is pushed towards the end that comes into mesh first
        let pitch = gears[0].rack.base_pitch();
        let inclined = (gears[0].turned_per_mm() * pitch).atan().sin();
        let of_member = |side: usize| {
            let ends = free_ends.then_some([inclined, -inclined][side]);
            changes(gears[side], materials[side], width, slices, ends)
        };
        let (pinion, gear) = rayon::join(|| of_member(0), || of_member(1));
        let ((pinion, pinion_ends), (gear, gear_ends)) = (pinion?, gear?);
        let waves = pinion.into_iter().zip(gear).map(|(p, g)| [p, g]).collect();
        Ok(Self {
            slices,
            waves,
            ends: pinion_ends.zip(gear_ends).map(|(p, g)| [p, g]),
        })
    }

    /// What free ends let a place on one tooth of a member give way by per line load on another of its teeth.
    fn by_ends(&self, side: usize, tooth: i32, to: FacePlace, from: FacePlace) -> f64 {
        let ends = self.ends.as_ref();
        ends.map_or(0.0, |ends| ends[side].between(tooth, to, from))
    }

    /// For each turn: how far (mm) a tooth pair (row) gives way per line load (N/mm) of another (column), all pairs of the first of the `slices`, then those of the
    /// second, and so on.
    pub fn ties(&self, cycle: &Cycle, slices: &Slices) -> Vec<DMatrix<f64>> {
        if slices.ahead.iter().all(|ahead| *ahead == 0) {
            let inclined = cycle.pair.cos_base_helix();
            let of_position = |position: &Position| self.of_position(position) / inclined;
            return cycle.positions.par_iter().map(of_position).collect();
        }
        let by_distance = self.by_distance();
        let turns = (0..cycle.positions.len()).into_par_iter();
        turns
            .map(|turn| self.of_turn(cycle, slices, turn, &by_distance))
            .collect()
    }

    /// K_m for m from 0 to the number of slices, pinion then gear.
    fn by_distance(&self) -> Vec<[FlankChange; 2]> {
        let n = self.slices as f64;
        let felt = |m: usize, side: usize| {
            let rho = self.waves[0][side].rho.clone();
            let nothing = |change: &DMatrix<f64>| DMatrix::zeros(change.nrows(), change.ncols());
            let mut change: Vec<_> = self.waves[0][side].change.iter().map(nothing).collect();
            for (wave, changes) in self.waves.iter().enumerate() {
                let phase = std::f64::consts::PI * (wave + 1) as f64 * m as f64 / n;
                for (sum, own) in change.iter_mut().zip(&changes[side].change) {
                    *sum += own * (phase.cos() / n);
                }
            }
            FlankChange { rho, change }
        };
        let distances = (0..=self.slices).into_par_iter();
        distances.map(|m| [felt(m, 0), felt(m, 1)]).collect()
    }

    fn of_turn(
        &self,
        cycle: &Cycle,
        slices: &Slices,
        turn: usize,
        by_distance: &[[FlankChange; 2]],
    ) -> DMatrix<f64> {
        let positions = cycle.positions.len();
        let place = |i: usize, pair: &PairContact| {
            let passed = slices.passed(i, turn, positions);
            [0, 1].map(|side| Place {
                slice: i,
                // what the pinion's tooth is on to, the gear's is back from
                tooth: member_tooth(pair, side) - [passed, -passed][side],
                weights: by_distance[0][side].weights(pair.frame.rho[side]),
            })
        };
        let place = &place;
        let places: Vec<[Place; 2]> = (0..self.slices)
            .flat_map(|i| {
                let position = &cycle.positions[slices.at(i, turn, positions)];
                position.pairs.iter().map(move |pair| place(i, pair))
            })
            .collect();
        let inclined = cycle.pair.cos_base_helix();
        let felt = |to: &Place, from: &Place, side: usize| {
            let apart = to.slice.abs_diff(from.slice);
            let mirrored = to.slice + from.slice + 1;
            let mirrored = mirrored.min(2 * self.slices - mirrored);
            let at = |m: usize| {
                let tooth = to.tooth - from.tooth;
                by_distance[m][side].between(tooth, to.weights, from.weights)
            };
            let places = [to, from].map(|place| FacePlace {
                slice: place.slice,
                weights: place.weights,
            });
            at(apart)
                + at(mirrored)
                + self.by_ends(side, to.tooth - from.tooth, places[0], places[1])
        };
        let ties = DMatrix::from_fn(places.len(), places.len(), |row, column| {
            let (to, from) = (&places[row], &places[column]);
            (felt(&to[0], &from[0], 0) + felt(&to[1], &from[1], 1)) / inclined
        });
        0.5 * (&ties + ties.transpose())
    }

    fn of_position(&self, position: &Position) -> DMatrix<f64> {
        let (pairs, n) = (position.pairs.len(), self.slices);
        let mut ties = DMatrix::zeros(n * pairs, n * pairs);
        for (wave, changes) in self.waves.iter().enumerate() {
            let cosine = |slice: usize| {
                let phase = (wave + 1) as f64 * (slice as f64 + 0.5) / n as f64;
                (std::f64::consts::PI * phase).cos()
            };
            let change = DMatrix::from_fn(pairs, pairs, |s, t| {
                let [to, from] = [s, t].map(|index| &position.pairs[index]);
                let of_side = |side: usize| {
                    let teeth = [to, from].map(|pair| member_tooth(pair, side));
                    let rho = [to, from].map(|pair| pair.frame.rho[side]);
                    changes[side].at(teeth[0] - teeth[1], rho)
                };
                of_side(0) + of_side(1)
            });
            for i in 0..n {
                for j in 0..n {
                    let share = 2.0 / n as f64 * cosine(i) * cosine(j);
                    let mut block = ties.view_mut((i * pairs, j * pairs), (pairs, pairs));
                    block += &change * share;
                }
            }
        }
        if let Some(ends) = &self.ends {
            for (side, ends) in ends.iter().enumerate() {
                let weights: Vec<_> = (position.pairs.iter())
                    .map(|pair| self.waves[0][side].weights(pair.frame.rho[side]))
                    .collect();
                let teeth: Vec<i32> = (position.pairs.iter())
                    .map(|pair| member_tooth(pair, side))
                    .collect();
                let place = |row: usize| FacePlace {
                    slice: row / pairs,
                    weights: weights[row % pairs],
                };
                ties += DMatrix::from_fn(n * pairs, n * pairs, |a, b| {
                    let tooth = teeth[a % pairs] - teeth[b % pairs];
                    ends.between(tooth, place(a), place(b))
                });
            }
        }
        // rounding and interpolation between points leave no more than that
        0.5 * (&ties + ties.transpose())
    }
}

/// Where a tooth pair of a slice touches one member.
struct Place {
    slice: usize,
    /// The member's tooth, counted at the turn of mid-face.
    tooth: i32,
    /// Of the flank's points.
    weights: [(usize, f64); 2],
}

#[cfg(test)]
mod tests {
    use super::super::flank_waves::{NEIGHBOURS, compliances};
    use super::*;
    use crate::contact::cycle::{CycleSpec, Stations};
    use crate::contact::frame::tests::reference;

    const N: usize = 5;
    const POSITIONS: usize = 8;

    fn cycle() -> Cycle {
        let pair = reference();
        let stations = Stations::new(&pair, 0.05);
        let spec = CycleSpec {
            positions: POSITIONS,
            spacing: 0.05,
            even: 0.2,
            window: 0.3,
            reach: 0.02,
        };
        Cycle::new(&pair, &stations, spec)
    }

    /// The slices stand turned by so many base pitches from one end to the other.
    fn turned(overlap: f64) -> Slices {
        Slices::even(N, 1.0).turned(overlap, POSITIONS)
    }

    /// Slice and pair of every row at one turn.
    fn rows<'c>(
        cycle: &'c Cycle,
        slices: &'c Slices,
        turn: usize,
    ) -> Vec<(usize, &'c PairContact)> {
        let of_slice = |i: usize| {
            let position = &cycle.positions[slices.at(i, turn, POSITIONS)];
            position.pairs.iter().map(move |pair| (i, pair))
        };
        (0..N).flat_map(of_slice).collect()
    }

    /// A body that gives way by c under an even load and not at all under a wave moves as one: the slices give way by c of their mean load, so the ties are
    /// −c (δ_ij − 1/N) from each member (the cosines are orthogonal, and with the even load complete); inclined teeth give way by c/cos β_b.
    #[test]
    fn where_no_wave_bends_the_teeth_all_slices_move_by_their_mean_load() {
        let mut cycle = cycle();
        cycle.pair.base_helix = 0.25;
        let inclined = 0.25f64.cos();
        let stiff = |c: f64| FlankChange {
            rho: vec![0.0, 100.0],
            change: vec![DMatrix::from_element(2, 2, -c); 5],
        };
        let c = [3e-6, 2e-6];
        let waves = ToothWaves {
            slices: N,
            waves: (1..N).map(|_| c.map(stiff)).collect(),
            ends: None,
        };
        for slices in [turned(0.0), turned(1.3), turned(-2.0)] {
            let all = waves.ties(&cycle, &slices);
            assert!(cycle.positions.iter().any(|p| p.pairs.len() > 1));
            for (turn, ties) in all.iter().enumerate() {
                let rows = rows(&cycle, &slices, turn);
                assert_eq!(ties.nrows(), rows.len());
                for (a, (i, s)) in rows.iter().enumerate() {
                    for (b, (j, t)) in rows.iter().enumerate() {
                        let numbers = [(i, s), (j, t)]
                            .map(|(i, pair)| pair.tooth - slices.passed(*i, turn, POSITIONS));
                        let within = (numbers[0] - numbers[1]).abs() <= NEIGHBOURS;
                        let own = f64::from(u8::from(i == j));
                        let expected = -(c[0] + c[1]) / inclined * (own - 1.0 / N as f64);
                        let expected = if within { expected } else { 0.0 };
                        assert!((ties[(a, b)] - expected).abs() < 1e-18);
                    }
                }
            }
        }
    }

    /// Along the face a tooth's path of contact goes on by the same length from slice to slice, whatever base pitch its section position is in.
    #[test]
    fn a_tooth_is_the_same_in_all_slices() {
        let cycle = cycle();
        for overlap in [0.7, 1.3, -2.0] {
            let slices = turned(overlap);
            for turn in 0..POSITIONS {
                for (i, pair) in rows(&cycle, &slices, turn) {
                    let tooth = pair.tooth - slices.passed(i, turn, POSITIONS);
                    let at_mid_face = cycle.positions[turn].theta + f64::from(tooth);
                    let on = pair.path / cycle.pair.base_pitch - at_mid_face;
                    let ahead = slices.ahead[i] as f64 / POSITIONS as f64;
                    assert!((on - ahead).abs() < 1e-12, "{on} for {ahead}");
                }
            }
        }
    }

    /// Slices that hardly stand turned are tied as those of spur gears, which have their ties by another way; mirrored slices have mirrored ties.
    #[test]
    fn without_a_helix_ties_are_those_of_spur_gears() {
        let cycle = cycle();
        let c = |side: usize, a: usize, b: usize, wave: usize| {
            let apart = 1.0 + (a as f64 - b as f64).powi(2) * (1.0 + side as f64);
            -1e-6 * (1.0 - 0.5 / wave as f64) / apart
        };
        let change = |side: usize, wave: usize| FlankChange {
            rho: vec![0.0, 5.0, 9.0, 14.0, 40.0],
            change: (-2..=2)
                .map(|tooth: i32| {
                    let felt = 0.3f64.powi(tooth.abs());
                    DMatrix::from_fn(5, 5, |a, b| felt * c(side, a, b, wave))
                })
                .collect(),
        };
        let waves = ToothWaves {
            slices: N,
            waves: (1..N)
                .map(|wave| [0, 1].map(|side| change(side, wave)))
                .collect(),
            ends: None,
        };
        let upright = turned(0.0);
        let spur = waves.ties(&cycle, &upright);
        let by_distance = waves.by_distance();
        for (turn, spur) in spur.iter().enumerate() {
            let ties = waves.of_turn(&cycle, &upright, turn, &by_distance);
            assert!((spur - ties).amax() < 1e-12 * spur.amax());
        }
        let (right, left) = (turned(1.3), turned(-1.3));
        for (turn, ties) in waves.ties(&cycle, &right).iter().enumerate() {
            let (own, other) = (rows(&cycle, &right, turn), rows(&cycle, &left, turn));
            let mirrored: Vec<usize> = (own.iter())
                .map(|(i, pair)| {
                    let same = |(j, other): &(usize, &PairContact)| {
                        *j == N - 1 - *i && other.path == pair.path
                    };
                    other.iter().position(same).unwrap()
                })
                .collect();
            let left = &waves.ties(&cycle, &left)[turn];
            for a in 0..own.len() {
                for b in 0..own.len() {
                    let off = ties[(a, b)] - left[(mirrored[a], mirrored[b])];
                    assert!(off.abs() < 1e-12 * ties.amax());
                }
            }
        }
    }

    /// Free ends only ever give way, alike at either end, and by more under an even load near the ends of a wide face than in its middle.
    #[test]
    fn free_ends_give_way_more_than_mirrors() {
        let pair = reference();
        let steel = Elastic {
            youngs_modulus: 2.1e5,
            poisson_ratio: 0.3,
        };
        let gears = [&pair.pinion, &pair.gear];
        let waves = |free| ToothWaves::new(gears, [steel; 2], 20.0, N, free).unwrap();
        let (free, held) = (waves(true), waves(false));
        let (cycle, upright) = (cycle(), turned(0.0));
        let by_distance = free.by_distance();
        let ties = free.ties(&cycle, &upright);
        for (turn, (ties, mirrored)) in ties.iter().zip(held.ties(&cycle, &upright)).enumerate() {
            let other_way = free.of_turn(&cycle, &upright, turn, &by_distance);
            assert!((ties - other_way).amax() < 1e-12 * ties.amax());
            let more = ties - mirrored;
            let [least, most] = [more.symmetric_eigenvalues().min(), more.amax()];
            assert!(most > 0.0 && least > -1e-3 * most, "{least} {most}");
            let pairs = more.nrows() / N;
            for a in 0..more.nrows() {
                for b in 0..more.nrows() {
                    let across = |row: usize| (N - 1 - row / pairs) * pairs + row % pairs;
                    let off = more[(a, b)] - more[(across(a), across(b))];
                    assert!(off.abs() < 1e-6 * most, "{off} of {most}");
                }
            }
            assert!(more[(0, 0)] > 2.0 * more[(N / 2 * pairs, N / 2 * pairs)]);
        }
    }

    /// With what slices give way by themselves the ties are the compliance of the whole prism, wave by wave, and that takes work to load.
    #[test]
    fn ties_and_sections_together_are_the_prism() {
        let pair = reference();
        let steel = Elastic {
            youngs_modulus: 2.1e5,
            poisson_ratio: 0.3,
        };
        let width = 20.0;
        let gears = [&pair.pinion, &pair.gear];
        let all = gears.map(|gear| compliances(gear, steel, width, N, None).unwrap());
        let of = |side: usize, wave: usize| FlankChange {
            rho: all[side].rho.clone(),
            change: all[side].by_wave[wave].clone(),
        };
        let waves = ToothWaves::new(gears, [steel; 2], width, N, false).unwrap();
        let (cycle, slices) = (cycle(), turned(1.3));
        for (turn, ties) in waves.ties(&cycle, &slices).iter().enumerate() {
            let rows = rows(&cycle, &slices, turn);
            let at = |wave: usize, a: usize, b: usize| {
                let of_side = |side: usize| {
                    let tooth = |row: usize| {
                        let (i, pair) = rows[row];
                        let own = member_tooth(pair, side);
                        let passed = slices.passed(i, turn, POSITIONS);
                        if side == 0 {
                            own - passed
                        } else {
                            own + passed
                        }
                    };
                    let rho = [a, b].map(|row| rows[row].1.frame.rho[side]);
                    of(side, wave).at(tooth(a) - tooth(b), rho)
                };
                of_side(0) + of_side(1)
            };
            let prism = |a: usize, b: usize| -> f64 {
                let cosine = |wave: usize, row: usize| {
                    let phase = wave as f64 * (rows[row].0 as f64 + 0.5) / N as f64;
                    (std::f64::consts::PI * phase).cos()
                };
                let share = |wave: usize| f64::from(1 + u8::from(wave > 0)) / N as f64;
                (0..N)
                    .map(|n| share(n) * cosine(n, a) * cosine(n, b) * at(n, a, b))
                    .sum()
            };
            let own = |a: usize, b: usize| match rows[a].0 == rows[b].0 {
                true => at(0, a, b),
                false => 0.0,
            };
            let size = rows.len();
            let inclined = cycle.pair.cos_base_helix();
            assert_eq!(inclined, 1.0);
            assert_eq!(*ties, ties.transpose());
            let whole = DMatrix::from_fn(size, size, |a, b| ties[(a, b)] + own(a, b));
            let expected = DMatrix::from_fn(size, size, prism);
            let off = (&whole - &expected).amax() / expected.amax();
            assert!(off < 2e-3, "{off}");
            let least = whole.symmetric_eigenvalues().min();
            assert!(least > 0.0, "{least}");
            // ties take away, and never give
            assert!(ties.symmetric_eigenvalues().max() < 1e-3 * whole.amax());
        }
    }
}
