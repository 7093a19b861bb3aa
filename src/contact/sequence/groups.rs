//! Teeth whose wear is computed, and what the others wear as: one of these that stands alike, or a wave through them.

use std::f64::consts::PI;

use super::Mix;
use crate::gear::ToothClasses;

/// Numbers that differ by no more than rounding does.
pub(super) fn close(a: &[f64], b: &[f64]) -> bool {
    (a.iter().zip(b)).all(|(a, b)| (a - b).abs() <= 1e-9 * (1.0 + a.abs().max(b.abs())))
}

/// Classes of teeth, and what every tooth wears as.
#[derive(Debug, Clone, PartialEq)]
pub struct Groups {
    /// The tooth of each class whose wear is computed.
    pub(super) centres: Vec<usize>,
    /// Of each tooth the number of what it wears as.
    pub(super) worn_as: Vec<usize>,
    /// What teeth wear as: classes with their weights.
    pub(super) wears: Vec<Mix>,
}

impl Groups {
    /// `count` teeth, each by itself.
    pub fn apart(count: usize) -> Self {
        Self::together((0..count).collect(), (0..count).collect())
    }

    /// Teeth that `all` tells apart, in these classes.
    pub(super) fn of_classes(all: &[Vec<f64>], classes: ToothClasses) -> Self {
        match classes {
            ToothClasses::Alike(most) => Self::alike(all, most),
            ToothClasses::Wave(count) => {
                let each = Self::alike(all, usize::MAX);
                // waves take an odd number of places
                let count = count.div_ceil(2) * 2 - 1;
                if each.centres.len() <= count {
                    each
                } else {
                    Self::wave(all.len(), period(all), count)
                }
            }
        }
    }

    /// Teeth of a class together.
    fn together(centres: Vec<usize>, class: Vec<usize>) -> Self {
        Self {
            wears: (0..centres.len()).map(|class| vec![(class, 1.0)]).collect(),
            worn_as: class,
            centres,
        }
    }

    /// Equal lists together and, where these would be more than `most` groups, those nearest to one of so many that lie as far apart as
    /// can be, the first one among them (farthest-point clustering; Gonzalez, Theor. Comput. Sci. 38, 1985).
    pub(super) fn alike(all: &[Vec<f64>], most: usize) -> Self {
        let mut different: Vec<usize> = Vec::new();
        let mut of = Vec::with_capacity(all.len());
        for (i, own) in all.iter().enumerate() {
            let known = different.iter().position(|other| close(own, &all[*other]));
            of.push(known.unwrap_or(different.len()));
            if known.is_none() {
                different.push(i);
            }
        }
        if different.len() <= most {
            return Self::together(different, of);
        }
        let distance = |a: usize, b: usize| -> f64 {
            let squares = all[a].iter().zip(&all[b]).map(|(a, b)| (a - b).powi(2));
            squares.sum()
        };
        let nearest = |centres: &[usize], i: usize| {
            let each = centres.iter().map(|c| distance(*c, i)).enumerate();
            each.fold((0, f64::INFINITY), |m, d| if d.1 < m.1 { d } else { m })
        };
        let mut centres = vec![0];
        while centres.len() < most {
            let apart = different.iter().map(|i| (*i, nearest(&centres, *i).1));
            let farthest = apart.fold((0, 0.0), |m, d| if d.1 > m.1 { d } else { m });
            centres.push(farthest.0);
        }
        let of = (0..all.len()).map(|i| nearest(&centres, i).0).collect();
        Self::together(centres, of)
    }

    /// `teeth` around a member that begin again after a `period`; of each period an odd number of teeth (`count`) computed, about evenly spaced from the
    /// first one on, and all others on the trigonometric polynomial through these:
    ///
    /// ```text
    /// h(α) = Σ_c h_c Π_{d≠c} sin((α − α_d)/2)/sin((α_c − α_d)/2)        harmonics 0 to (count − 1)/2; α = 2π i/period
    /// ```
    /// Gauss's interpolation formula (Zygmund, Trigonometric Series, X.2). With the nearest class in its place neighbours never level each other's wear.
    fn wave(teeth: usize, period: usize, count: usize) -> Self {
        let place = |c: usize| (c * period + count / 2) / count;
        let centres: Vec<usize> = (0..count).map(place).collect();
        let half_sine = |i: usize, c: usize| (PI * (i as f64 - c as f64) / period as f64).sin();
        let wear = |i: usize| -> Mix {
            if let Some(class) = centres.iter().position(|c| *c == i) {
                return vec![(class, 1.0)];
            }
            let weight = |class: usize| {
                let own = centres[class];
                let others = centres.iter().filter(|c| **c != own);
                others
                    .map(|&c| half_sine(i, c) / half_sine(own, c))
                    .product()
            };
            (0..count).map(|class| (class, weight(class))).collect()
        };
        Self {
            worn_as: (0..teeth).map(|i| i % period).collect(),
            wears: (0..period).map(wear).collect(),
            centres,
        }
    }

    /// What a tooth wears as.
    pub(super) fn wear(&self, tooth: usize) -> &Mix {
        &self.wears[self.worn_as[tooth]]
    }

    /// What the mean of some teeth wears as.
    pub(super) fn mean_wear(&self, teeth: impl Iterator<Item = usize>) -> Mix {
        let (mut mix, mut count) = (Mix::new(), 0.0);
        for tooth in teeth {
            count += 1.0;
            for &(class, weight) in self.wear(tooth) {
                match mix.iter_mut().find(|(c, _)| *c == class) {
                    Some((_, sum)) => *sum += weight,
                    None => mix.push((class, weight)),
                }
            }
        }
        mix.iter_mut().for_each(|(_, sum)| *sum /= count);
        mix
    }

    /// The class of a tooth whose wear is that of one class.
    pub(super) fn class(&self, tooth: usize) -> Option<usize> {
        match self.wear(tooth)[..] {
            [(class, _)] => Some(class),
            _ => None,
        }
    }

    /// Share of each class in the mean of all teeth.
    pub(super) fn shares(&self) -> Vec<f64> {
        let mut shares = vec![0.0; self.centres.len()];
        for (class, share) in self.mean_wear(0..self.worn_as.len()) {
            shares[class] = share;
        }
        shares
    }

    /// Teeth that wear alike, together.
    pub(super) fn worn_alike(&self) -> Vec<Vec<usize>> {
        let mut alike = vec![Vec::new(); self.wears.len()];
        for (tooth, worn_as) in self.worn_as.iter().enumerate() {
            alike[*worn_as].push(tooth);
        }
        alike
    }
}

/// Number of teeth after which all begins again.
fn period(all: &[Vec<f64>]) -> usize {
    let begins_again = |p: &usize| {
        let later = (0..all.len()).map(|i| &all[(i + p) % all.len()]);
        all.iter().zip(later).all(|(a, b)| close(a, b))
    };
    let mut divisors = (1..all.len()).filter(|p| all.len().is_multiple_of(*p));
    divisors.find(begins_again).unwrap_or(all.len())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// 27 teeth that differ along two harmonics of a turn: five of them tell all others, to rounding; the weights add up to 1.
    #[test]
    fn teeth_between_classes_lie_on_the_wave_through_them() {
        let value = |i: usize| {
            let turn = TAU * i as f64 / 27.0;
            3.0 + 2.0 * (turn + 0.4).cos() - 0.7 * (2.0 * turn - 1.1).sin()
        };
        let kinds: Vec<Vec<f64>> = (0..27).map(|i| vec![value(i)]).collect();
        for count in [5, 6] {
            let groups = Groups::of_classes(&kinds, ToothClasses::Wave(count));
            assert_eq!(groups.centres, [0, 5, 11, 16, 22]);
            for i in 0..27 {
                let wear = &groups.wears[groups.worn_as[i]];
                let sum = |of: &dyn Fn(usize) -> f64| -> f64 {
                    wear.iter()
                        .map(|(class, w)| w * of(groups.centres[*class]))
                        .sum()
                };
                assert!((sum(&|_| 1.0) - 1.0).abs() < 1e-12, "{i}");
                assert!((sum(&value) - value(i)).abs() < 1e-12, "{i}");
            }
        }
    }

    /// A mate of three times as many teeth, each of which always meets the same of nine: the wave comes three times in its turn.
    #[test]
    fn a_wave_may_come_several_times_in_a_turn() {
        let turn = |i: usize| TAU * (i % 9) as f64 / 9.0;
        let kinds: Vec<Vec<f64>> = (0..27)
            .map(|i| vec![turn(i).cos(), turn(i).sin()])
            .collect();
        let groups = Groups::of_classes(&kinds, ToothClasses::Wave(3));
        assert_eq!(groups.centres, [0, 3, 6]);
        for (i, kind) in kinds.iter().enumerate() {
            let wear = &groups.wears[groups.worn_as[i]];
            let sum: f64 = wear
                .iter()
                .map(|(c, w)| w * kinds[groups.centres[*c]][0])
                .sum();
            assert!((sum - kind[0]).abs() < 1e-12, "{i}");
        }
    }

    #[test]
    fn few_kinds_of_teeth_are_classes_even_along_a_wave() {
        let kinds: Vec<Vec<f64>> = (0..12).map(|i| vec![f64::from(i % 2)]).collect();
        let groups = Groups::of_classes(&kinds, ToothClasses::Wave(5));
        assert_eq!(groups, Groups::alike(&kinds, 2));
        assert_eq!(groups.centres, [0, 1]);
    }
}
