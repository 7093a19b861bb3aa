//! What the other profiles of a member say of each row of a coarse curve.
//!
//! A curve of ten radii has too few neighbours to tell a wrong value from a steep flank. Profiles of one member are alike but for their height and
//! their zero, though: each other profile is laid on the curve by a straight line through the median of all slopes (Theil 1950, Sen 1968), in which
//! three points in ten may be wrong.

use crate::measure::{FacePlace, Observation};
use crate::numeric::{MEDIAN_OF_NORMAL, median};

/// Points of a curve: fewer are too few for a line and its scatter, denser curves show what is wrong by their neighbours.
const POINTS: std::ops::RangeInclusive<usize> = 6..=24;
/// How many other curves are asked, those of the same test first.
const ASKED: usize = 8;
/// Fewest of them: one other cannot tell which of the two is wrong.
const FEWEST: usize = 2;
/// Share of them that has to agree.
const AGREE: f64 = 0.6;
/// Least scatter about a line over the range of the curve that is believed: of few points the median may be near 0. Places as near over the length of
/// the curve are the same.
const LEAST: f64 = 0.01;
/// Scatters about the lines by which a value is off at least before it counts as a slip.
const OFF: f64 = 8.0;
/// How far from what the others expect a value may lie once the slip is undone, over itself, beside so many scatters.
const NEAR: f64 = 0.3;
const ALIKE: f64 = 2.5;
/// Ranges of a curve by which a value is off that no curve has, whatever it was meant to be.
const OUTSIDE: f64 = 4.0;
/// What is left of a difference once it is explained, at most.
const LEFT: f64 = 0.25;

/// What one other profile says of a row: the value expected, the scatter about its line, and how far all values on the line range.
#[derive(Debug, Clone, Copy)]
struct Expected {
    value: f64,
    scatter: f64,
    range: f64,
}

/// A slip of the pen or the keyboard.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Slip {
    /// The value with the decimal point put right, where that makes it one of the curve.
    pub meant: Option<f64>,
    /// The value that the other profiles lead one to expect, and the scatters about their lines by which the row is off.
    pub expected: f64,
    pub apart: f64,
}

/// By row what the other profiles of its member say of it.
#[derive(Debug)]
pub(super) struct OtherProfiles {
    said: Vec<Vec<Expected>>,
}

impl OtherProfiles {
    /// `curves`: rows of each curve by ascending position.
    pub(super) fn new(rows: &[&Observation], curves: &[Vec<usize>]) -> Self {
        let coarse = |curve: &&Vec<usize>| POINTS.contains(&curve.len());
        let all: Vec<&Vec<usize>> = curves.iter().filter(coarse).collect();
        let kind = |curve: &[usize]| {
            let o = rows[curve[0]];
            let face = o.face.map(FacePlace::key);
            (o.member, o.quantity, face, o.tooth.as_deref())
        };
        let test = |curve: &[usize]| rows[curve[0]].test;
        let mut said = vec![Vec::new(); rows.len()];
        for (number, curve) in all.iter().enumerate() {
            let alike = |other: &usize| *other != number && kind(all[*other]) == kind(curve);
            let mut others: Vec<usize> = (0..all.len()).filter(alike).collect();
            others.sort_by_key(|&other| (test(all[other]) != test(curve), other.abs_diff(number)));
            for &other in others.iter().take(ASKED) {
                let Some(by) = laid_on(rows, curve, all[other]) else {
                    continue;
                };
                let known = curve.iter().zip(by);
                known.for_each(|(&row, by)| said[row].extend(by));
            }
        }
        Self { said }
    }

    /// Whether enough of the other profiles say something of a row.
    fn agree(&self, row: usize, what: impl Fn(&Expected) -> bool) -> bool {
        let said = &self.said[row];
        let agree = said.iter().filter(|by| what(by)).count();
        said.len() >= FEWEST && agree as f64 >= AGREE * said.len() as f64
    }

    /// Whether the other profiles lead up to a value that the row's neighbours do not expect: a feature of the flank.
    pub(super) fn lead_to(&self, row: usize, value: f64, by_neighbours: f64) -> bool {
        let most = LEFT * (value - by_neighbours).abs();
        self.agree(row, |by| (value - by.value).abs() < most)
    }

    /// The slip of the decimal point by up to three places, either way, that the other profiles agree on; or any by which a value stands far outside all
    /// that the curve ranges over.
    pub(super) fn slip(&self, row: usize, value: f64) -> Option<Slip> {
        let undone = |meant: f64| {
            self.agree(row, |by| {
                let (off, left) = ((value - by.value).abs(), (meant - by.value).abs());
                let near = NEAR * meant.abs() + ALIKE * by.scatter;
                off > OFF * by.scatter && left < LEFT * off && left < near
            })
        };
        let meant = [10.0, 0.1, 100.0, 0.01, 1000.0, 0.001].map(|times| times * value);
        let meant = meant.into_iter().find(|meant| undone(*meant));
        let is_gross = |by: &Expected| {
            let off = (value - by.value).abs();
            off > OFF * by.scatter && off > OUTSIDE * by.range
        };
        if meant.is_none() && !self.agree(row, is_gross) {
            return None;
        }
        let said = &self.said[row];
        let apart = said.iter().map(|by| (value - by.value).abs() / by.scatter);
        Some(Slip {
            meant,
            expected: median(said.iter().map(|by| by.value).collect())?,
            apart: median(apart.collect())?,
        })
    }
}

/// What another curve, laid on a curve by a straight line, says of each of its rows; None where too few points stand at the same places, or where the
/// other has no height to lay on.
fn laid_on(
    rows: &[&Observation],
    curve: &[usize],
    other: &[usize],
) -> Option<Vec<Option<Expected>>> {
    let place = |row: usize| rows[row].position.unwrap_or(0.0);
    let length = place(*curve.last()?) - place(curve[0]);
    let at_same_place = |row: usize| {
        let away = |other: &usize| (place(*other) - place(row)).abs();
        let nearest = (other.iter().copied()).min_by(|a, b| away(a).total_cmp(&away(b)))?;
        // a table that has 0 for every negative reading has no height there
        let is_read = away(&nearest) < LEAST * length && rows[nearest].value != 0.0;
        is_read.then(|| rows[nearest].value)
    };
    let theirs: Vec<Option<f64>> = curve.iter().map(|&row| at_same_place(row)).collect();
    let both: Vec<[f64; 2]> = (curve.iter().zip(&theirs))
        .filter_map(|(&row, theirs)| Some([(*theirs)?, rows[row].value]))
        .filter(|[_, own]| *own != 0.0)
        .collect();
    if both.len() < *POINTS.start() {
        return None;
    }
    let slopes = (both.iter().enumerate()).flat_map(|(i, a)| {
        let beyond = both[i + 1..].iter();
        let beyond = beyond.filter(move |b| a[0] != b[0]);
        beyond.map(move |b| (a[1] - b[1]) / (a[0] - b[0]))
    });
    let slope = median(slopes.collect())?;
    let zero = median(both.iter().map(|[x, y]| y - slope * x).collect())?;
    let off = both.iter().map(|[x, y]| (y - zero - slope * x).abs());
    let values = both.iter().map(|[x, _]| zero + slope * x);
    let low = values.clone().fold(f64::INFINITY, f64::min);
    let high = values.fold(f64::NEG_INFINITY, f64::max);
    let scatter = (median(off.collect())? / MEDIAN_OF_NORMAL).max(LEAST * (high - low));
    let expected = |x: f64| Expected {
        value: zero + slope * x,
        scatter,
        range: high - low,
    };
    (scatter > 0.0).then(|| (theirs.iter()).map(|theirs| theirs.map(expected)).collect())
}
