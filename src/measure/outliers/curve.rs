//! One measured curve, and how far its points stand apart from what their neighbours lead one to expect.

use std::ops::Range;

use super::{ALIKE, APART};
use crate::measure::neighbours::{SIDE, around};

/// A point of a curve with the standard deviations that it stands apart, with their sign, the value expected, and whether the curve bends there.
pub(super) struct Standing {
    pub(super) at: usize,
    pub(super) apart: f64,
    pub(super) expected: f64,
    pub(super) is_a_corner: bool,
}

/// What is known of one curve.
pub(super) struct Curve {
    pub(super) rows: Vec<usize>,
    pub(super) points: Vec<[f64; 3]>,
    pub(super) passed_over: Vec<bool>,
    /// Scatter of the points about their neighbours over the stated one.
    pub(super) scale: f64,
}

impl Curve {
    /// Standard deviations that a point stands apart, and the value expected.
    pub(super) fn apart(&self, at: usize) -> Option<(f64, f64)> {
        let found = around(&self.points, at, &self.passed_over)?;
        let apart = (self.points[at][1] - found.expected) / (found.sigma * self.scale);
        Some((apart, found.expected))
    }

    /// Its largest value, of those that are not passed over, in its σ.
    pub(super) fn depth(&self) -> f64 {
        let asked = (self.points.iter().zip(&self.passed_over)).filter(|(_, out)| !**out);
        let largest = asked.map(|([_, value, sigma], _)| value.abs() / sigma);
        largest.fold(0.0, f64::max) / self.scale
    }

    pub(super) fn standing(&self, at: usize) -> Option<Standing> {
        let (apart, expected) = self.apart(at)?;
        Some(Standing {
            at,
            apart,
            expected,
            is_a_corner: self.is_a_corner(at),
        })
    }

    /// How far all points stand apart, without sign.
    pub(super) fn all_apart(&self) -> Vec<f64> {
        let asked = (0..self.points.len()).filter(|at| !self.passed_over[*at]);
        let each = asked.filter_map(|at| self.apart(at));
        each.map(|(apart, _)| apart.abs()).collect()
    }

    /// The other point, or the two side by side, near the one that stands farthest apart, without which nothing nearby stands apart, far from what the
    /// others lead one to expect; None where that point alone is enough, or none other and no two are.
    pub(super) fn others_instead_of(&mut self, at: usize, kept: &[bool]) -> Option<Vec<Standing>> {
        let near = at.saturating_sub(SIDE)..(at + SIDE + 1).min(self.points.len());
        if self.most_apart_without(&[at], &near, kept) <= APART {
            return None;
        }
        let asked: Vec<usize> = near.clone().filter(|&i| !self.passed_over[i]).collect();
        // a burr at the end of a curve pulls those beside it, which stand farther apart than it does
        let mut singles: Vec<(f64, usize)> = Vec::new();
        for &one in asked.iter().filter(|one| **one != at) {
            let left = self.most_apart_without(&[one], &near, kept);
            let is_far = (self.apart(one)).is_some_and(|(z, _)| z.abs() > APART);
            if is_far && left <= APART {
                singles.push((left, one));
            }
        }
        if let Some((_, one)) = singles.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)) {
            return Some(vec![self.standing(one)?]);
        }
        let mut pairs: Vec<(f64, [usize; 2])> = Vec::new();
        for pair in asked
            .windows(2)
            .filter_map(|two| <[usize; 2]>::try_from(two).ok())
        {
            let left = self.most_apart_without(&pair, &near, kept);
            let both = self.without(&pair, |curve| {
                let far = |i: &usize| curve.apart(*i).is_some_and(|(z, _)| z.abs() > APART);
                pair.iter().all(far)
            });
            if both && left <= APART {
                pairs.push((left, pair));
            }
        }
        let (_, pair) = pairs.into_iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
        self.without(&pair, |curve| {
            pair.iter().map(|&at| curve.standing(at)).collect()
        })
    }

    /// The farthest that a point of a range stands apart once some are passed over, without sign.
    fn most_apart_without(&mut self, some: &[usize], near: &Range<usize>, kept: &[bool]) -> f64 {
        self.without(some, |curve| {
            let asked = near.clone().filter(|&i| !curve.passed_over[i] && !kept[i]);
            let apart = asked.filter_map(|i| curve.apart(i));
            apart.map(|(z, _)| z.abs()).fold(0.0, f64::max)
        })
    }

    /// What something is while some points are passed over.
    fn without<T>(&mut self, some: &[usize], what: impl FnOnce(&Self) -> T) -> T {
        some.iter().for_each(|&i| self.passed_over[i] = true);
        let found = what(self);
        some.iter().for_each(|&i| self.passed_over[i] = false);
        found
    }

    /// Whether a point's value lies between those of its neighbours, one on each side or two at an end, or outside by no more than noise: then the
    /// curve bends there, as at the edge of what is worn, and what its neighbours lead one to expect is not to be expected.
    fn is_a_corner(&self, at: usize) -> bool {
        let asked = |i: &usize| !self.passed_over[*i];
        let before: Vec<usize> = (0..at).rev().filter(asked).take(2).collect();
        let after: Vec<usize> = (at + 1..self.points.len()).filter(asked).take(2).collect();
        let near = match (&before[..], &after[..]) {
            ([left, ..], [right, ..]) => vec![*left, *right],
            (one, []) | ([], one) => one.to_vec(),
        };
        let values = near.iter().map(|&i| self.points[i][1]);
        let (low, high) = (
            values.clone().fold(f64::INFINITY, f64::min),
            values.fold(f64::NEG_INFINITY, f64::max),
        );
        let [_, value, sigma] = self.points[at];
        let outside = (low - value).max(value - high).max(0.0);
        let noise = ALIKE * sigma * self.scale;
        outside < noise || self.is_led_up_to(at, (&before, &after)) || self.goes_on(at, noise)
    }

    /// Whether a point at an end of the curve, but for noise, lies among what goes on from its three nearest: level, straight or bending as they do. A
    /// relief of a tip bends more than a parabola over several points follows.
    fn goes_on(&self, at: usize, noise: f64) -> bool {
        let asked = |i: &usize| !self.passed_over[*i];
        let before: Vec<usize> = (0..at).rev().filter(asked).take(3).collect();
        let after: Vec<usize> = (at + 1..self.points.len()).filter(asked).take(3).collect();
        let near = match (&before[..], &after[..]) {
            (&[a, b, c], []) | ([], &[a, b, c]) => [a, b, c],
            _ => return false,
        };
        let [place, value, _] = self.points[at];
        let [[x1, y1], [x2, y2], [x3, y3]] = near.map(|i| [self.points[i][0], self.points[i][1]]);
        let slope = (y1 - y2) / (x1 - x2);
        let bend = (slope - (y2 - y3) / (x2 - x3)) / (x1 - x3);
        let straight = y1 + slope * (place - x1);
        let bending = straight + bend * (place - x1) * (place - x2);
        let low = y1.min(straight).min(bending);
        let high = y1.max(straight).max(bending);
        (low - noise..=high + noise).contains(&value)
    }

    /// Whether the points on either side lead up to a point's value, half of the way or more from what a smooth curve has there: the dip of the wear at
    /// the pitch point, where flanks roll and do not slide.
    fn is_led_up_to(&self, at: usize, (before, after): (&[usize], &[usize])) -> bool {
        let Some((apart, expected)) = self.apart(at) else {
            return false;
        };
        let [place, value, _] = self.points[at];
        let leads = |side: &[usize]| {
            let &[near, far] = side else { return false };
            let ([x, y, _], [x_far, y_far, _]) = (self.points[near], self.points[far]);
            let led = y + (y - y_far) / (x - x_far) * (place - x);
            (led - expected) * apart.signum() > 0.5 * (value - expected).abs()
        };
        leads(before) && leads(after)
    }

    /// Standard deviations at the point nearest to a place, if the curve has one within half the distance of its points.
    pub(super) fn near(&self, place: f64) -> Option<f64> {
        let distance = |at: &usize| (self.points[*at][0] - place).abs();
        let nearest = (0..self.points.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        let [first, last] = [self.points.first()?[0], self.points.last()?[0]];
        let reach = 0.75 * (last - first) / (self.points.len() - 1) as f64;
        (distance(&nearest) <= reach).then(|| self.apart(nearest).map(|found| found.0))?
    }
}
