//! Which effects some tests together show and tell apart.

use rayon::prelude::*;

use super::responses::TestResponses;
use crate::learn::experiment::candidate_tests::CLEAR;
use crate::learn::experiment::discrimination::Discrimination;

/// By what χ² some tests together tell every effect as the truth from no effect, and from every other one.
pub(super) struct DiscriminationTable {
    nothing: Vec<Option<Discrimination>>,
    rivals: Vec<Vec<Option<Discrimination>>>,
}

impl DiscriminationTable {
    pub(super) fn empty(count: usize) -> Self {
        Self {
            nothing: vec![None; count],
            rivals: vec![vec![None; count]; count],
        }
    }

    pub(super) fn new(responses: &TestResponses, kept: &[usize], measured: usize) -> Self {
        let white = &responses.by_quantities[measured];
        let of = |truth: usize, rival: usize| {
            let (a, b) = (&white[truth], &white[rival]);
            Some(Discrimination::new(
                &(&a.values - &b.values),
                &b.common,
                &b.own,
            ))
        };
        let against = |a: usize| {
            let others = kept.iter();
            others
                .map(|&b| if b == a { None } else { of(a, b) })
                .collect()
        };
        Self {
            nothing: kept.iter().map(|&a| of(a, 0)).collect(),
            rivals: kept.par_iter().map(|&a| against(a)).collect(),
        }
    }

    pub(super) fn and(&self, other: &Self) -> Self {
        let join = |a: &[Option<Discrimination>],
                    b: &[Option<Discrimination>]|
         -> Vec<Option<Discrimination>> {
            let both = a.iter().zip(b);
            both.map(|(a, b)| match (a, b) {
                (Some(a), Some(b)) => Some(a.and(b)),
                (one, other) => one.as_ref().or(other.as_ref()).cloned(),
            })
            .collect()
        };
        let rivals = self.rivals.iter().zip(&other.rivals);
        Self {
            nothing: join(&self.nothing, &other.nothing),
            rivals: rivals.map(|(a, b)| join(a, b)).collect(),
        }
    }

    pub(super) fn score(&self) -> Score {
        let chi2 = |discrimination: &Option<Discrimination>| {
            discrimination.as_ref().map_or(0.0, Discrimination::chi2)
        };
        let mut score = Score {
            shown: self.nothing.iter().map(chi2).collect(),
            nearest: Vec::new(),
            apart: Vec::new(),
        };
        for (a, rivals) in self.rivals.iter().enumerate() {
            let others = (0..rivals.len()).filter(|&b| b != a);
            let nearest = others
                .map(|b| (b, chi2(&rivals[b])))
                .min_by(|x, y| x.1.total_cmp(&y.1));
            score.nearest.push(nearest.map(|n| n.0));
            score.apart.push(nearest.map_or(score.shown[a], |n| n.1));
        }
        score
    }
}

/// χ² of every effect against nothing and against its nearest look-alike.
pub(super) struct Score {
    pub(super) shown: Vec<f64>,
    pub(super) nearest: Vec<Option<usize>>,
    pub(super) apart: Vec<f64>,
}

impl Score {
    pub(super) fn detectable(&self) -> usize {
        self.shown.iter().filter(|c| **c >= CLEAR).count()
    }

    pub(super) fn told_apart(&self, a: usize) -> bool {
        self.shown[a].min(self.apart[a]) >= CLEAR
    }

    /// Effects told apart, then those shown, then how near the others are: what a choice makes large.
    pub(super) fn value(&self) -> f64 {
        let near = |c: f64| (c / CLEAR).min(1.0);
        (0..self.shown.len())
            .map(|a| {
                let apart = self.shown[a].min(self.apart[a]);
                f64::from(u8::from(apart >= CLEAR)) + 0.3 * near(self.shown[a]) + 0.3 * near(apart)
            })
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DVector;

    use super::*;

    fn discrimination(v: f64) -> Option<Discrimination> {
        Some(Discrimination::new(&DVector::from_element(1, v), &[], &[]))
    }

    #[test]
    fn an_effect_counts_when_it_shows_and_no_other_looks_like_it() {
        let table = DiscriminationTable {
            nothing: vec![discrimination(3.0), discrimination(4.0)],
            rivals: vec![
                vec![None, discrimination(1.0)],
                vec![discrimination(5.0), None],
            ],
        };
        let score = table.score();
        assert_eq!(score.detectable(), 2);
        assert!(!score.told_apart(0) && score.told_apart(1));
        assert_eq!(score.nearest, [Some(1), Some(0)]);
        // a second test of the same kind adds its χ²
        let both = table.and(&table).score();
        assert!((both.apart[0] - 2.0).abs() < 1e-12);
        assert!(both.value() > score.value());
        // the empty set of tests says nothing and adds nothing
        let with = DiscriminationTable::empty(2).and(&table).score();
        assert_eq!(with.apart, score.apart);
    }
}
