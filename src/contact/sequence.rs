//! Teeth that differ: which tooth meets which, what stands beside a pair in mesh, and whose wear is computed for itself.
//!
//! Teeth of a member that stand alike among neighbours and mates that stand alike are one class; their wear is that of one of them.
//! What is followed is the *passage* of a tooth through mesh. At each mesh position its own pair may be any of those in contact, so the
//! contact is solved with that pair being the passage's, its neighbours those that come before and after it, each with its own wear:
//!
//! ```text
//! tooth i + d of the pinion meets tooth k + d of the gear      d = 0 the passage's own pair, 1 the next to come into mesh
//! dh_c/dn = Σ_m  w_m ∫ k p |v| over passage m                   over the passages of class c, with the share w_m of each
//! ```
//! Teeth i and k meet where i − k is a multiple of the common factor of both numbers of teeth. By [`Hunting::Average`] a tooth of a class
//! passes a mate that is the mean of all that it meets: their mean place and their mean wear. What depends on the wear of two teeth in a
//! straight line is right so; what is left out is the part of the load sharing that is crooked over the differences between mates. Teeth of a member that
//! differ by their mates alone have no passages of their own: each wears by those of its mates, and nothing is left out.
//!
//! Where teeth stand along a wave over the turn, those of a few places around the member are classes, and the others wear as a wave through these
//! ([`Groups`]).

mod groups;
mod meetings;
mod sharing;

use std::sync::Arc;

pub use groups::Groups;
use groups::close;
use meetings::Meetings;
pub use meetings::ToothDepths;
pub use sharing::Sharing;
use sharing::add;

use crate::contact::cycle::Cycle;
use crate::gear::{Hunting, ToothClasses, common_factor};

/// Neighbours on either side that tell teeth apart: a pair shares the load with those next to it, and these with the next ones.
const NEIGHBOURS: i64 = 2;

/// What tells the teeth of both members apart.
#[derive(Debug, Clone, PartialEq)]
pub struct Kinds {
    /// By member and tooth, in the order in which they come into mesh: teeth with equal numbers stand alike.
    pub of: [Vec<Vec<f64>>; 2],
    /// Teeth whose wear is computed, by member.
    pub classes: [ToothClasses; 2],
    /// Which mates a tooth meets.
    pub hunting: Hunting,
}

/// A weighted sum: what, and with which weight.
pub type Mix = Vec<(usize, f64)>;

/// A tooth of one member that takes part in a contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Seat {
    Tooth(usize),
    /// The mean of all with this remainder by the common factor.
    Mean(usize),
}

/// The passage of a tooth, or of two that meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Passage {
    /// Of pinion and gear; none: the mean mate.
    tooth: [Option<usize>; 2],
}

/// Classes of teeth, and the passages that their wear follows from.
#[derive(Debug, Clone, PartialEq)]
pub struct Sequence {
    teeth: [usize; 2],
    common: usize,
    /// Classes of teeth, by member.
    groups: [Groups; 2],
    /// Number of what stands alike, of every tooth.
    kind: [Vec<usize>; 2],
    passages: Vec<Passage>,
    sharing: Arc<Sharing>,
    /// Share of each passage in a member's mean, by member.
    weights: [Vec<f64>; 2],
    /// How far every tooth stands back, mm along the path of contact.
    back: [Vec<f64>; 2],
    meetings: Vec<Meetings>,
}

impl Sequence {
    /// Of teeth of these kinds; none where those of each member are all alike.
    pub fn new(kinds: &Kinds) -> Option<Self> {
        let teeth = [0, 1].map(|m| kinds.of[m].len());
        let common = common_factor(teeth);
        let means = [0, 1].map(|m| {
            (0..common)
                .map(|r| mean_of(&kinds.of[m], r, common))
                .collect()
        });
        let means: [Vec<Vec<f64>>; 2] = means;
        // with its neighbours and the mean of those that meet them
        let of_tooth = |m: usize, i: usize| -> Vec<f64> {
            let around = (-NEIGHBOURS..=NEIGHBOURS).flat_map(|d| {
                let own = &kinds.of[m][place(i, d, teeth[m])];
                let r = place(i, d, common);
                let met = means[0][r].iter().chain(&means[1][r]);
                own.iter().chain(met).copied()
            });
            around.collect()
        };
        let of_member =
            |m: usize| -> Vec<Vec<f64>> { (0..teeth[m]).map(|i| of_tooth(m, i)).collect() };
        let around = [0, 1].map(of_member);
        let groups = [0, 1].map(|m| match kinds.hunting {
            Hunting::Average => Groups::of_classes(&around[m], kinds.classes[m]),
            Hunting::Full => Groups::apart(teeth[m]),
        });
        let alike = |m: usize| around[m].iter().all(|a| close(a, &around[m][0]));
        (!alike(0) || !alike(1)).then(|| Self::of_classes(kinds, groups))
    }

    /// With these classes of the teeth of both members.
    pub fn of_classes(kinds: &Kinds, groups: [Groups; 2]) -> Self {
        let teeth = [0, 1].map(|m| kinds.of[m].len());
        let common = common_factor(teeth);
        let classes = [0, 1].map(|m| groups[m].centres.len());
        let several = classes.map(|count| count > 1);
        let mut passages: Vec<Passage> = Vec::new();
        match kinds.hunting {
            Hunting::Full => {
                for i in 0..teeth[0] {
                    let meets = (0..teeth[1]).filter(|k| i % common == k % common);
                    passages.extend(meets.map(|k| Passage {
                        tooth: [Some(i), Some(k)],
                    }));
                }
            }
            Hunting::Average => {
                for m in 0..2 {
                    let follows = if several[m] {
                        several[1 - m] && follows_mates(kinds, &groups, m, common)
                    } else {
                        several[1 - m] || m == 1
                    };
                    if follows {
                        continue;
                    }
                    for centre in &groups[m].centres {
                        let mut tooth = [None; 2];
                        tooth[m] = Some(*centre);
                        passages.push(Passage { tooth });
                    }
                }
            }
        }
        let mut out = Self {
            teeth,
            common,
            kind: [0, 1].map(|m| Groups::alike(&kinds.of[m], usize::MAX).worn_as),
            groups,
            sharing: Arc::default(),
            weights: [Vec::new(), Vec::new()],
            back: teeth.map(|count| vec![0.0; count]),
            meetings: Vec::new(),
            passages,
        };
        let mixes = [0, 1].map(|m| {
            let mix = |passage: &Passage| out.mix(m, out.seat(passage, m, 0));
            out.passages.iter().map(mix).collect::<Vec<Mix>>()
        });
        let home = |m: usize, class: usize| {
            let alone = |mix: &Mix| matches!(mix.as_slice(), [(own, _)] if *own == class);
            let home = mixes[m].iter().position(alone);
            home.expect("every class has a passage of its own")
        };
        let homes = [0, 1].map(|m| (0..classes[m]).map(|c| home(m, c)).collect());
        let feeds = [0, 1].map(|m| out.feeds_of(m, classes[m]));
        for m in 0..2 {
            out.weights[m] = vec![0.0; out.passages.len()];
            for (feeds, share) in feeds[m].iter().zip(out.groups[m].shares()) {
                for &(passage, weight) in feeds {
                    out.weights[m][passage] += share * weight;
                }
            }
        }
        out.sharing = Arc::new(Sharing {
            feeds,
            mixes,
            homes,
            stations: [0; 2],
        });
        out
    }

    /// The same with the teeth standing back by `back` (mm by member and tooth), over the mesh cycle `cycle`.
    pub fn over(mut self, cycle: &Cycle, back: [Vec<f64>; 2]) -> Self {
        self.back = back;
        self.sharing = Arc::new(Sharing {
            stations: cycle.stations.arc.each_ref().map(Vec::len),
            ..(*self.sharing).clone()
        });
        let meetings = cycle.positions.iter().map(|position| {
            let numbers: Vec<i64> = position.pairs.iter().map(|p| i64::from(p.tooth)).collect();
            self.meetings_of(&numbers)
        });
        self.meetings = meetings.collect();
        self
    }

    fn seat(&self, passage: &Passage, m: usize, d: i64) -> Seat {
        match (passage.tooth[m], passage.tooth[1 - m]) {
            (Some(i), _) => Seat::Tooth(place(i, d, self.teeth[m])),
            (None, mate) => Seat::Mean(place(mate.unwrap_or(0), d, self.common)),
        }
    }

    fn mix(&self, m: usize, seat: Seat) -> Mix {
        match seat {
            Seat::Tooth(i) => self.groups[m].wear(i).clone(),
            Seat::Mean(r) => self.groups[m].mean_wear((r..self.teeth[m]).step_by(self.common)),
        }
    }

    fn feeds_of(&self, m: usize, classes: usize) -> Vec<Mix> {
        let own = |passage: &Passage| passage.tooth[m].and_then(|i| self.groups[m].class(i));
        let of_class = |c: usize| {
            let passages = self.passages.iter().enumerate();
            let passing: Vec<usize> = (passages.clone())
                .filter(|(_, p)| own(p) == Some(c))
                .map(|(i, _)| i)
                .collect();
            if passing.is_empty() {
                // teeth that are worn by the other member's, in the passages of these
                let shares = match classes {
                    1 => self.groups[1 - m].shares(),
                    _ => self.shares_of_mates(m, c),
                };
                let mate = |p: &Passage| p.tooth[1 - m].and_then(|k| self.groups[1 - m].class(k));
                let weighted = passages.filter_map(|(i, p)| Some((i, shares[mate(p)?])));
                return weighted.filter(|(_, share)| *share != 0.0).collect();
            }
            let each = 1.0 / passing.len() as f64;
            passing.into_iter().map(|i| (i, each)).collect()
        };
        (0..classes).map(of_class).collect()
    }

    /// Share of each class of the other member in the teeth that those of a class of member `m` meet.
    fn shares_of_mates(&self, m: usize, class: usize) -> Vec<f64> {
        let own = (0..self.teeth[m]).filter(|k| self.groups[m].class(*k) == Some(class));
        let mates = own.flat_map(|k| (k % self.common..self.teeth[1 - m]).step_by(self.common));
        let mut shares = vec![0.0; self.groups[1 - m].centres.len()];
        for (of, share) in self.groups[1 - m].mean_wear(mates) {
            shares[of] = share;
        }
        shares
    }

    /// Number of passages: a state holds the depths of both members for each.
    pub fn count(&self) -> usize {
        self.passages.len()
    }

    /// Number of classes of pinion and gear.
    pub fn classes(&self) -> [usize; 2] {
        self.sharing.homes.each_ref().map(Vec::len)
    }

    /// How passages share teeth.
    pub fn sharing(&self) -> &Arc<Sharing> {
        &self.sharing
    }

    /// Teeth of a member that wear alike, together.
    pub fn worn_alike(&self, m: usize) -> Vec<Vec<usize>> {
        self.groups[m].worn_alike()
    }

    /// Passages that hold the depths of a tooth, with their weights.
    pub fn homes(&self, m: usize, tooth: usize) -> Mix {
        let of_class = |&(class, weight): &(usize, f64)| (self.sharing.homes[m][class], weight);
        self.groups[m].wear(tooth).iter().map(of_class).collect()
    }

    /// Share of each passage in the mean tooth of a member.
    pub fn weights(&self, m: usize) -> &[f64] {
        &self.weights[m]
    }

    /// The mean teeth of both members in the state `u`.
    pub fn mean_of(&self, u: &[f64]) -> Vec<f64> {
        let classes = self.sharing.gather(u);
        let mut mean = vec![0.0; self.sharing.stations.iter().sum()];
        for m in 0..2 {
            let first = m * self.sharing.stations[0];
            let own = &mut mean[first..first + self.sharing.stations[m]];
            for (class, share) in self.groups[m].shares().into_iter().enumerate() {
                add(own, share, &classes[self.sharing.class_part(m, class)]);
            }
        }
        mean
    }

    /// Base pitches of one turn of the member with more teeth.
    pub fn base_pitches_of_a_turn(&self) -> usize {
        self.teeth[0].max(self.teeth[1])
    }

    /// Share of each passage in the mean of all contacts.
    pub fn contact_weights(&self) -> Vec<f64> {
        let own = |m: usize| self.passages.iter().any(|p| p.tooth[m].is_some());
        let members: Vec<usize> = (0..2).filter(|m| own(*m)).collect();
        let mean = |i: usize| {
            let sum: f64 = members.iter().map(|m| self.weights[*m][i]).sum();
            sum / members.len() as f64
        };
        (0..self.count()).map(mean).collect()
    }
}

/// Whether the teeth of member `m` differ by their mates alone, so that their wear is that of the passages of these: the mean of several mates is then
/// taken of their wear and not of their places.
fn follows_mates(kinds: &Kinds, groups: &[Groups; 2], m: usize, common: usize) -> bool {
    let alike = kinds.of[m].iter().all(|own| close(own, &kinds.of[m][0]));
    let met_alone = |class: usize| {
        groups[1 - m].centres.iter().any(|mate| {
            let met = (mate % common..kinds.of[m].len()).step_by(common);
            matches!(groups[m].mean_wear(met)[..], [(of, _)] if of == class)
        })
    };
    alike && (0..groups[m].centres.len()).all(met_alone)
}

/// The tooth `d` after `i` of `count`.
fn place(i: usize, d: i64, count: usize) -> usize {
    (i as i64 + d).rem_euclid(count as i64) as usize
}

/// The mean of the lists whose number has the remainder `r` by `common`.
fn mean_of(all: &[Vec<f64>], r: usize, common: usize) -> Vec<f64> {
    let met: Vec<&Vec<f64>> = all.iter().skip(r).step_by(common).collect();
    let mut mean = vec![0.0; met[0].len()];
    for one in &met {
        add(&mut mean, 1.0 / met.len() as f64, one);
    }
    mean
}
