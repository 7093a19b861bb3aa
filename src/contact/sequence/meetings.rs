//! What meets at a mesh position: the contacts that passages are made of, and the flanks in each.

use std::collections::HashMap;

use super::sharing::add;
use super::{Seat, Sequence, place};
use crate::contact::slices::Flanks;

/// What meets at one mesh position.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Meetings {
    /// Teeth of every pair.
    situations: Vec<Vec<[Seat; 2]>>,
    /// Which of them a passage has where a pair is its own, by passage and pair.
    read: Vec<Vec<usize>>,
}

/// What a seat is to a contact: what it wears as, what it stands like, and whether it is a mean.
type Place = (usize, usize, bool);

/// Depths (mm) of all teeth that wear differently, and of mean mates.
#[derive(Debug, Clone)]
pub struct ToothDepths {
    of_teeth: [Vec<Vec<f64>>; 2],
    of_mean: [Vec<Vec<f64>>; 2],
}

impl Sequence {
    /// What meets where the pairs have these numbers.
    pub(super) fn meetings_of(&self, numbers: &[i64]) -> Meetings {
        let mut known: HashMap<Vec<[Place; 2]>, usize> = HashMap::new();
        let mut out = Meetings {
            situations: Vec::new(),
            read: Vec::new(),
        };
        for passage in &self.passages {
            let of_pair = |own: &i64| {
                // a pair with a larger number came into mesh before
                let seats: Vec<[Seat; 2]> = (numbers.iter())
                    .map(|other| [0, 1].map(|m| self.seat(passage, m, own - other)))
                    .collect();
                let key = (seats.iter())
                    .map(|seats| [0, 1].map(|m| self.same(m, seats[m])))
                    .collect();
                *known.entry(key).or_insert_with(|| {
                    out.situations.push(seats);
                    out.situations.len() - 1
                })
            };
            let read = numbers.iter().map(of_pair).collect();
            out.read.push(read);
        }
        out
    }

    fn same(&self, m: usize, seat: Seat) -> Place {
        match seat {
            Seat::Tooth(i) => (self.groups[m].worn_as[i], self.kind[m][i], false),
            Seat::Mean(r) if self.sharing.homes[m].len() > 1 => (r, r, true),
            // all teeth alike: none stands out of the mean
            Seat::Mean(_) => (0, 0, true),
        }
    }

    /// Number of different contacts at the position `q`.
    pub fn situations(&self, q: usize) -> usize {
        self.meetings[q].situations.len()
    }

    /// Which contact a passage has at the position `q` where the pair `index` is its own.
    pub fn read(&self, q: usize, passage: usize, index: usize) -> usize {
        self.meetings[q].read[passage][index]
    }

    /// The flanks that meet in the contact `situation` of the position `q`, the teeth standing where they do.
    pub fn flanks<'u>(&self, q: usize, situation: usize, depths: &'u ToothDepths) -> Flanks<'u> {
        self.flanks_with(q, situation, depths, &self.back)
    }

    /// The same with the teeth standing back by `back`, mm by member and tooth; or with derivatives of both.
    pub fn flanks_with<'u>(
        &self,
        q: usize,
        situation: usize,
        depths: &'u ToothDepths,
        back: &[Vec<f64>; 2],
    ) -> Flanks<'u> {
        self.seated(&self.meetings[q].situations[situation], depths, back)
    }

    /// The flanks of the pairs `numbers` so many base pitches after the first teeth of both members met in the pitch point, each tooth where it
    /// stands.
    pub fn flanks_after<'u>(
        &self,
        turned: usize,
        numbers: &[i64],
        depths: &'u ToothDepths,
    ) -> Flanks<'u> {
        // a pair with a larger number came into mesh before
        let seats = |number: &i64| {
            self.teeth
                .map(|count| Seat::Tooth(place(turned, -number, count)))
        };
        let seats: Vec<[Seat; 2]> = numbers.iter().map(seats).collect();
        self.seated(&seats, depths, &self.back)
    }

    fn seated<'u>(
        &self,
        seats: &[[Seat; 2]],
        depths: &'u ToothDepths,
        back: &[Vec<f64>; 2],
    ) -> Flanks<'u> {
        let mut flanks = Flanks::new(&[seats.len()], |_, pair| {
            [0, 1].map(|m| self.depth(m, seats[pair][m], depths))
        });
        for (own, seats) in flanks.back.iter_mut().zip(seats) {
            *own = (0..2).map(|m| self.back_of(m, seats[m], &back[m])).sum();
        }
        flanks
    }

    fn depth<'u>(&self, m: usize, seat: Seat, depths: &'u ToothDepths) -> &'u [f64] {
        match seat {
            Seat::Tooth(i) => &depths.of_teeth[m][self.groups[m].worn_as[i]],
            Seat::Mean(r) => &depths.of_mean[m][r],
        }
    }

    fn back_of(&self, m: usize, seat: Seat, back: &[f64]) -> f64 {
        match seat {
            _ if back.is_empty() => 0.0,
            Seat::Tooth(i) => back[i],
            Seat::Mean(r) => {
                let met = back[r..].iter().step_by(self.common);
                met.sum::<f64>() / (self.teeth[m] / self.common) as f64
            }
        }
    }

    /// Depths of all teeth and mean mates in the state `u`.
    pub fn depths(&self, u: &[f64]) -> ToothDepths {
        let of_class = [0, 1].map(|m| {
            let homes = self.sharing.homes[m].iter();
            let of = |home: &usize| &u[self.sharing.part(*home, m)];
            homes.map(of).collect::<Vec<&[f64]>>()
        });
        let of_mean = [0, 1].map(|m| {
            let of = |r: usize| sum(&self.mix(m, Seat::Mean(r)), &of_class[m]);
            (0..self.common).map(of).collect()
        });
        let of_teeth = [0, 1].map(|m| {
            let wears = self.groups[m].wears.iter();
            wears.map(|wear| sum(wear, &of_class[m])).collect()
        });
        ToothDepths { of_teeth, of_mean }
    }
}

fn sum(mix: &[(usize, f64)], of: &[&[f64]]) -> Vec<f64> {
    if let [(only, 1.0)] = mix {
        return of[*only].to_vec();
    }
    let mut sum = vec![0.0; of[0].len()];
    for &(i, weight) in mix {
        add(&mut sum, weight, of[i]);
    }
    sum
}
