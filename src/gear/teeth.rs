//! Where the teeth of a member stand: pitch deviations tooth by tooth, and an axis that lies off.
//!
//! ```text
//! teeth i of the pinion and k of the gear stand back by e_1i + e_2k          pitch deviations, pair by pair
//! all pairs in mesh stand back by Σ f cos(2π t/z + φ)                        eccentricity f of each member, t base pitches of turn
//! ```
//! An axis off by f moves the whole member: involutes stay involutes and all pairs in mesh open alike, so the load is shared as before
//! and the lag alone swings, once per turn. What it does to the distance of the axes is not followed.

use std::f64::consts::TAU;

/// How far the teeth of both members stand back from their places, and how finely they are told apart.
///
/// Teeth are numbered from 0 in the order in which they come into mesh; tooth 0 of the pinion meets tooth 0 of the gear.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Teeth {
    /// mm along the path of contact by member and tooth, positive: the tooth stands back; empty where all stand in their places.
    pub back: [Vec<f64>; 2],
    /// How far the axis of each member lies off, mm, and its phase, rad: 0 where the pairs stand back most as tooth 0 passes the pitch point.
    pub eccentricity: [[f64; 2]; 2],
    /// The most classes of teeth whose wear is computed for itself, by member; none: [`Teeth::USUAL_CLASSES`].
    pub classes: [Option<usize>; 2],
    /// Which tooth meets which.
    pub hunting: Hunting,
}

/// Which mates a tooth meets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Hunting {
    /// A mate that is the mean of all that it meets.
    #[default]
    Average,
    /// Each of them, one after the other.
    Full,
}

/// Teeth of a member whose wear is computed, for all others to wear by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ToothClasses {
    /// Of those that stand alike one; where there are more kinds than this, those nearest are taken together.
    Alike(usize),
    /// So many around the member: the wear of the others follows a wave through these, over the turn or a part of it after which all begins again.
    Wave(usize),
}

impl Teeth {
    /// The most classes of a member unless the study says otherwise.
    pub const USUAL_CLASSES: usize = 64;

    /// The most meetings of two teeth that [`Hunting::Full`] takes.
    pub const MOST_MEETINGS: usize = 256;

    /// Whether all teeth of both members stand alike.
    pub fn are_alike(&self) -> bool {
        let alike = |back: &Vec<f64>| back.windows(2).all(|two| two[0] == two[1]);
        self.back.iter().all(alike)
    }

    /// Whether the axis of a member lies off.
    pub fn run_out(&self) -> bool {
        self.eccentricity.iter().any(|[amount, _]| *amount != 0.0)
    }

    /// How far all pairs in mesh stand back, mm along the path of contact, so many base pitches after teeth 0 met in the pitch point; `teeth`:
    /// the numbers of teeth.
    pub fn back_after(&self, turned: f64, teeth: [usize; 2]) -> f64 {
        let of = |([amount, phase], count): (&[f64; 2], usize)| {
            amount * (TAU * turned / count as f64 + phase).cos()
        };
        self.eccentricity.iter().zip(teeth).map(of).sum()
    }

    /// How many meetings of two teeth there are until all begins again: the least common multiple of the numbers of teeth.
    pub fn meetings(teeth: [usize; 2]) -> usize {
        teeth[0] / common_factor(teeth) * teeth[1]
    }
}

/// The greatest common factor of the numbers of teeth: 1 where every tooth meets every other.
pub fn common_factor([a, b]: [usize; 2]) -> usize {
    if b == 0 { a } else { common_factor([b, a % b]) }
}
