//! Which flanks of a pair wear differently, and in which company they meet: slices across the face, or teeth that are not alike.
//!
//! A *scene* is one way in which the teeth in mesh can be set; it takes a share of the time. Within a scene the face has one or more
//! *slices*, and each place of the mesh (tooth pairs one base pitch apart) says which flank of each member stands there and how far the
//! pair stands back.

use std::collections::BTreeMap;

/// Places of the mesh that are looked at, around the pair at the pitch point.
pub const PLACES: std::ops::RangeInclusive<i64> = -3..=3;
const COUNT: usize = 7;

/// Where a place's entries stand in a slice.
pub fn place(j: i64) -> usize {
    (j - PLACES.start()) as usize
}

/// Classes of a pair and what it stands back, pm.
type Met = (usize, usize, i64);

#[derive(Clone, Debug, PartialEq)]
pub struct Slice {
    /// Per member and place: the flank.
    pub flank: [[usize; COUNT]; 2],
    /// Per place: material missing on both flanks together, mm.
    pub back: [f64; COUNT],
}

#[derive(Clone, Debug)]
pub struct Scene {
    /// Share of the time.
    pub time: f64,
    /// Which of the run's passages.
    pub passage: usize,
    pub slices: Vec<Slice>,
}

#[derive(Clone, Debug)]
pub struct Layout {
    /// Per member and flank: its share of the member's flank area.
    pub share: [Vec<f64>; 2],
    pub scenes: Vec<Scene>,
    pub kind: Sort,
}

/// What the flanks of a layout are.
#[derive(Clone, Debug, PartialEq)]
pub enum Sort {
    /// All alike.
    Even,
    /// Slices of the face, from one end to the other.
    Face,
    /// Teeth; per member which flank is that of the tooth that is measured.
    Teeth([usize; 2]),
}

/// Where on a member something is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// At mid-face of the measured tooth.
    Usual,
    /// From mid-face, in half face widths.
    Face(f64),
    /// Mean over the face.
    Mean,
}

impl Layout {
    pub fn even() -> Self {
        Self {
            share: [vec![1.0], vec![1.0]],
            scenes: vec![Scene {
                time: 1.0,
                passage: 0,
                slices: vec![Slice {
                    flank: [[0; COUNT]; 2],
                    back: [0.0; COUNT],
                }],
            }],
            kind: Sort::Even,
        }
    }

    /// Equal slices; `missing(eta)`: um at eta half face widths from mid-face, on both flanks together.
    pub fn face(slices: usize, missing: &dyn Fn(f64) -> f64) -> Self {
        let share = vec![1.0 / slices as f64; slices];
        let slice = |q: usize| Slice {
            flank: [[q; COUNT]; 2],
            back: [1e-3 * missing(middle(q, slices)); COUNT],
        };
        Self {
            share: [share.clone(), share],
            scenes: vec![Scene {
                time: 1.0,
                passage: 0,
                slices: (0..slices).map(slice).collect(),
            }],
            kind: Sort::Face,
        }
    }

    /// Teeth in classes: `class[m][i]` of tooth i, whose flank lacks `back[m][i]` mm. Tooth 0 of each member is the measured one. The teeth of both
    /// members follow each other for the whole cycle of lcm(z1, z2) meshes; meshes of the same classes are one scene. Teeth of one class share one
    /// flank: the average over what they meet. `near`: places that can touch.
    pub fn teeth(
        class: [&[usize]; 2],
        back: [&[f64]; 2],
        near: std::ops::RangeInclusive<i64>,
    ) -> Self {
        let z = [class[0].len(), class[1].len()];
        let cycle = z[0] / gcd(z[0], z[1]) * z[1];
        let mut scenes: BTreeMap<Vec<Met>, (usize, Slice)> = BTreeMap::new();
        for step in 0..cycle {
            let mut slice = Slice {
                flank: [[0; COUNT]; 2],
                back: [0.0; COUNT],
            };
            let mut key = Vec::new();
            for j in near.clone() {
                // A pair farther along the path came earlier.
                let tooth = |m: usize| (step as i64 - j).rem_euclid(z[m] as i64) as usize;
                let (a, b) = (tooth(0), tooth(1));
                slice.flank[0][place(j)] = class[0][a];
                slice.flank[1][place(j)] = class[1][b];
                slice.back[place(j)] = back[0][a] + back[1][b];
                key.push((
                    class[0][a],
                    class[1][b],
                    (1e9 * (back[0][a] + back[1][b])).round() as i64,
                ));
            }
            scenes.entry(key).or_insert((0, slice)).0 += 1;
        }
        let share = [0, 1].map(|m| {
            let count = class[m].iter().max().map_or(0, |c| c + 1);
            let of = |c: usize| class[m].iter().filter(|&&k| k == c).count();
            (0..count).map(|c| of(c) as f64 / z[m] as f64).collect()
        });
        let scene = |(count, slice): (usize, Slice)| Scene {
            time: count as f64 / cycle as f64,
            passage: 0,
            slices: vec![slice],
        };
        Self {
            share,
            scenes: scenes.into_values().map(scene).collect(),
            kind: Sort::Teeth([class[0][0], class[1][0]]),
        }
    }

    /// `phases` teeth of `member` around its turn, each in a passage of its own (at another distance of the axes); the mate's teeth meet them all.
    /// Tooth 0 is the measured one.
    pub fn phases(member: usize, phases: usize) -> Self {
        let mut share = [vec![1.0], vec![1.0]];
        share[member] = vec![1.0 / phases as f64; phases];
        let scene = |k: usize| {
            let mut flank = [[0; COUNT]; 2];
            flank[member] = [k; COUNT];
            Scene {
                time: 1.0 / phases as f64,
                passage: k,
                slices: vec![Slice {
                    flank,
                    back: [0.0; COUNT],
                }],
            }
        };
        Self {
            share,
            scenes: (0..phases).map(scene).collect(),
            kind: Sort::Teeth([0, 0]),
        }
    }

    /// Flanks that make up what is measured at a place, and their weights.
    pub fn at(&self, member: usize, place: Place) -> Vec<(usize, f64)> {
        let slices = self.share[member].len();
        match (&self.kind, place) {
            (Sort::Even, _) => vec![(0, 1.0)],
            (Sort::Teeth(tooth), _) => vec![(tooth[member], 1.0)],
            (Sort::Face, Place::Mean) => self.share[member].iter().copied().enumerate().collect(),
            (Sort::Face, Place::Usual) => self.at(member, Place::Face(0.0)),
            (Sort::Face, Place::Face(eta)) => {
                // Straight between the middles of two slices, and on to the ends of the face.
                let x = 0.5 * ((eta + 1.0) * slices as f64 - 1.0);
                let k = (x.max(0.0) as usize).min(slices - 2);
                let f = x - k as f64;
                vec![(k, 1.0 - f), (k + 1, f)]
            }
        }
    }
}

/// Middle of slice q, from mid-face in half face widths.
pub fn middle(q: usize, slices: usize) -> f64 {
    (2 * q + 1) as f64 / slices as f64 - 1.0
}

pub fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// Classes of z teeth of which tooth 0 differs: it and `reach` neighbours on either side each their own, the others one more.
pub fn around_one(z: usize, reach: usize) -> Vec<usize> {
    let class = |i: usize| {
        if i <= reach {
            i
        } else if z - i <= reach {
            reach + z - i
        } else {
            2 * reach + 1
        }
    };
    (0..z).map(class).collect()
}
