//! Depths of the two members that stand in each other's rows, in one test among others.
//!
//! ```text
//! A_y² = Σ (y − mean of its profile)² of a test's depths, A_f of the model's, L = 2 ln (A_f,p/A_f,g)
//! q = ln s_p/s_g; s = A_y/A_f where the model's shape does not stand in the measured depths
//! the others within 0.15 L of their middle, q below that by L, to a fifth: exchanged
//! ```
//! Or by their shapes: of a test the computed depths of the other member, at the same part of the profile, explain seven tenths of either's measured ones and the
//! own ones less than half, while in two others it is the other way round.
//! In the other member's rows the depths run the other way along the flank, so that the model's shape need not stand in them.
//! The pinion's flanks meet u times as often as the gear's and wear about as much deeper. In all tests alike it would be what members do that wear by
//! a k of their own.

use std::collections::BTreeMap;

use super::super::residual_statistics::FittedRow;
use super::{CLEAR_RATIO, EXPLAINS, rounded, scale};
use crate::measure::{Observation, Quantity, Subject};
use crate::numeric::median;
use crate::study::Study;

/// Fewest other tests.
const OTHERS: usize = 2;
/// How near each other those must be, and how near to exchanged the one, in parts of what an exchange makes.
const AGREE: f64 = 0.15;
const NEAR: f64 = 0.2;
/// Share of a member's depths that a shape must explain to stand in them, and up to which the other does not; fewest points of a profile.
const SHOWN: f64 = 0.7;
const HIDDEN: f64 = 0.5;
const POINTS: usize = 6;

/// A question about the tests of which the members' depths fit once exchanged; none where both wear about alike by the model.
pub(super) fn exchanged_depths(study: &Study, rows: &[FittedRow<'_>]) -> Option<String> {
    by_size(study, rows).or_else(|| by_shape(study, rows))
}

/// The same of those whose sizes are each other's.
fn by_size(study: &Study, rows: &[FittedRow<'_>]) -> Option<String> {
    let own = (0..study.tests.len()).filter_map(|test| Some((test, of_test(rows, test)?)));
    let own: Vec<(usize, f64)> = own.collect();
    let exchanged = own.iter().filter_map(|&(test, q)| {
        let others: Vec<f64> = (own.iter())
            .filter_map(|(t, q)| (*t != test).then_some(*q))
            .collect();
        let usual = median(others.clone())?;
        let ratio = model_ratio(rows, test)?;
        let shift = 2.0 * ratio.ln();
        let agree = others
            .iter()
            .all(|other| (other - usual).abs() < AGREE * shift);
        let is_near = (q - usual + shift).abs() < NEAR * shift;
        let is_clear = ratio > CLEAR_RATIO && others.len() >= OTHERS;
        (is_clear && agree && is_near).then(|| (study.tests[test].id.as_str(), ratio))
    });
    let exchanged: Vec<(&str, f64)> = exchanged.collect();
    let ratio = exchanged.first()?.1;
    let ids: Vec<&str> = exchanged.iter().map(|(id, _)| *id).collect();
    Some(format!(
        "are the depths of pinion and gear exchanged in test {}? Against the other tests, which agree, its pinion wears too little and its gear too much, both \
         by a factor of about {}: exchange the members of these rows",
        ids.join(", "),
        rounded(ratio)
    ))
}

/// A question about the tests of which either member's depths have the shape of the other's.
fn by_shape(study: &Study, rows: &[FittedRow<'_>]) -> Option<String> {
    let shapes = |test: usize| -> Option<[[f64; 2]; 2]> {
        let own = of_one_test(rows, test);
        let [pinion, gear] = [Subject::Pinion, Subject::Gear].map(|member| profiles(&own, member));
        Some([explained(&pinion, &gear)?, explained(&gear, &pinion)?])
    };
    let all = (0..study.tests.len()).filter_map(|test| Some((test, shapes(test)?)));
    let all: Vec<(usize, [[f64; 2]; 2])> = all.collect();
    let are = |of: &[[f64; 2]; 2], [shown, hidden]: [usize; 2]| {
        of.iter()
            .all(|member| member[shown] > SHOWN && member[hidden] < HIDDEN)
    };
    let exchanged = all.iter().filter(|(_, of)| are(of, [1, 0]));
    let ids: Vec<&str> = exchanged
        .map(|(test, _)| study.tests[*test].id.as_str())
        .collect();
    let right = all.iter().filter(|(_, of)| are(of, [0, 1])).count();
    (!ids.is_empty() && right >= OTHERS && ids.len() + right == all.len()).then(|| {
        format!(
            "are the depths of pinion and gear exchanged in test {}? Along the flank its pinion's run as the gear's should, and the gear's as the pinion's; in the other tests \
             they do not: exchange the members of these rows",
            ids.join(", ")
        )
    })
}

/// A profile: part of its length, measured and computed depth.
type Profile = Vec<[f64; 3]>;

/// Those of a member in the rows of one test, by their cycles.
fn profiles(rows: &[FittedRow<'_>], member: Subject) -> BTreeMap<u64, Profile> {
    let mut all: BTreeMap<u64, Profile> = BTreeMap::new();
    let is_own = |o: &Observation| (o.quantity, o.member) == (Quantity::WearDepth, member);
    for (o, row) in rows.iter().filter(|(o, _)| is_own(o)) {
        let place = o.position.unwrap_or(0.0);
        let own = all.entry(o.cycles.to_bits()).or_default();
        own.push([place, o.value, row.model]);
    }
    for own in all.values_mut() {
        own.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let [first, last] = [own[0][0], own[own.len() - 1][0]];
        for point in own.iter_mut() {
            point[0] = (point[0] - first) / (last - first);
        }
    }
    all.retain(|_, own| own.len() >= POINTS && own.iter().all(|point| point[0].is_finite()));
    all
}

/// Shares of a member's squares, about the mean of each profile, that its own computed depths explain and those of its mate; below 0 where they run against it.
fn explained(own: &BTreeMap<u64, Profile>, mate: &BTreeMap<u64, Profile>) -> Option<[f64; 2]> {
    let mut sums = [[0.0; 3]; 2];
    for (cycles, profile) in own {
        let of_mate = mate.get(cycles)?;
        let columns = profile
            .iter()
            .map(|&[part, measured, computed]| [measured, computed, computed_at(of_mate, part)]);
        let columns: Vec<[f64; 3]> = columns.collect();
        let mean = |of: usize| columns.iter().map(|x| x[of]).sum::<f64>() / columns.len() as f64;
        let [measured, computed, of_mate] = [0, 1, 2].map(mean);
        for x in &columns {
            let y = x[0] - measured;
            for (sum, f) in sums.iter_mut().zip([x[1] - computed, x[2] - of_mate]) {
                *sum = [sum[0] + f * f, sum[1] + f * y, sum[2] + y * y];
            }
        }
    }
    let shares = sums.map(|[ff, fy, yy]| fy.signum() * fy * fy / (ff * yy));
    shares
        .iter()
        .all(|share| share.is_finite())
        .then_some(shares)
}

/// The computed depth at a part of a profile, straight between its points.
fn computed_at(profile: &Profile, part: f64) -> f64 {
    let after = profile
        .partition_point(|point| point[0] < part)
        .clamp(1, profile.len() - 1);
    let [[x0, _, y0], [x1, _, y1]] = [profile[after - 1], profile[after]];
    match x1 > x0 {
        true => y0 + (y1 - y0) * (part - x0) / (x1 - x0),
        false => y1,
    }
}

/// How many times as far the pinion's depths range by the model as the gear's; None without both.
fn model_ratio(rows: &[FittedRow<'_>], test: usize) -> Option<f64> {
    let [pinion, gear] = [Subject::Pinion, Subject::Gear].map(|member| sizes(rows, test, member));
    Some(pinion?.1 / gear?.1).filter(|ratio| ratio.is_finite())
}

/// Root mean squares of a member's measured and computed depths about the mean of their profile.
fn sizes(rows: &[FittedRow<'_>], test: usize, member: Subject) -> Option<(f64, f64)> {
    let mut profiles: BTreeMap<_, Vec<[f64; 2]>> = BTreeMap::new();
    let is_own =
        |o: &Observation| (o.test, o.quantity, o.member) == (test, Quantity::WearDepth, member);
    for (o, row) in rows.iter().filter(|(o, _)| is_own(o)) {
        let own = profiles.entry((o.trace, o.cycles.to_bits())).or_default();
        own.push([o.value, row.model]);
    }
    let squares = |of: usize| -> f64 {
        let about_mean = |own: &Vec<[f64; 2]>| {
            let mean = own.iter().map(|x| x[of]).sum::<f64>() / own.len() as f64;
            own.iter().map(|x| (x[of] - mean).powi(2)).sum::<f64>()
        };
        profiles.values().map(about_mean).sum()
    };
    let count: usize = profiles.values().map(Vec::len).sum();
    (count > 0).then(|| {
        let [measured, computed] = [0, 1].map(|of| (squares(of) / count as f64).sqrt());
        (measured, computed)
    })
}

/// The rows of one test.
pub(super) fn of_one_test<'d>(rows: &[FittedRow<'d>], test: usize) -> Vec<FittedRow<'d>> {
    let own = rows.iter().filter(|(o, _)| o.test == test);
    own.copied().collect()
}

/// ln of how much more the pinion's depths are the model's than the gear's; None without both.
pub(super) fn of_test(rows: &[FittedRow<'_>], test: usize) -> Option<f64> {
    let own = of_one_test(rows, test);
    let of = |member| {
        let found = scale(&own, Quantity::WearDepth, Some(member))?;
        let factor = if found.explains > EXPLAINS && found.factor > 0.0 {
            found.factor
        } else {
            let (measured, computed) = sizes(rows, test, member)?;
            measured / computed
        };
        (factor > 0.0 && factor.is_finite()).then_some(factor)
    };
    Some((of(Subject::Pinion)? / of(Subject::Gear)?).ln())
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::measure::Dataset;

    /// What a question says of three tests whose computed depths on pinion and gear are so many times some, with so many times these measured.
    pub(in super::super) fn said_of(
        question: fn(&Study, &[FittedRow<'_>]) -> Option<String>,
        levels: [[f64; 2]; 3],
        factors: [[f64; 2]; 3],
    ) -> Option<String> {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let mut text = "test,member,cycles,quantity,position,value,sigma\n".to_owned();
        let mut models = Vec::new();
        let tests = ["A", "B", "C"].into_iter().zip(levels);
        for ((test, levels), factors) in tests.zip(factors) {
            let members = [("pinion", 27.0), ("gear", 53.0)].into_iter().zip(levels);
            for (((member, radius), level), factor) in members.zip(factors) {
                for (place, depth) in [3.0, 5.0, 8.0].into_iter().enumerate() {
                    let place = radius + 0.2 * place as f64;
                    let model = level * depth;
                    let value = factor * model;
                    text += &format!("{test},{member},200000,wear_depth,{place},{value},0.1\n");
                    models.push(model);
                }
            }
        }
        let data = Dataset::parse(&text, "m.csv", &study.known()).unwrap();
        let fits = super::super::fits_of(&models);
        let rows: Vec<FittedRow<'_>> = data.observations.iter().zip(&fits).collect();
        question(&study, &rows)
    }

    /// What is said where the pinion wears twice as deep as the gear by the model.
    fn said(factors: [[f64; 2]; 3]) -> Option<String> {
        said_of(exchanged_depths, [[2.0, 1.0]; 3], factors)
    }

    /// Depths 8, 5, 3 where the model has 3, 5, 8: its shape explains nothing of them, and their size tells all the same.
    #[test]
    fn depths_that_run_the_other_way_tell_by_their_size() {
        let rows = |values: [f64; 3]| {
            let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
            let study = Study::parse(study, "study.toml").unwrap();
            let mut text = "test,member,cycles,quantity,position,value,sigma,trace\n".to_owned();
            for (member, radius) in [("pinion", 27.0), ("gear", 53.0)] {
                for (place, value) in values.iter().enumerate() {
                    let place = radius + 0.2 * place as f64;
                    let value = if member == "pinion" {
                        *value
                    } else {
                        [3.0, 5.0, 8.0][((place - radius) / 0.2).round() as usize]
                    };
                    text += &format!("A,{member},200000,wear_depth,{place},{value},0.1,{member}\n");
                }
            }
            Dataset::parse(&text, "m.csv", &study.known()).unwrap()
        };
        let of = |values| {
            let data = rows(values);
            let fits = super::super::fits_of(&[3.0, 5.0, 8.0, 3.0, 5.0, 8.0]);
            let rows: Vec<FittedRow<'_>> = data.observations.iter().zip(&fits).collect();
            of_test(&rows, 0).unwrap()
        };
        assert!(of([3.0, 5.0, 8.0]).abs() < 1e-9);
        assert!((of([4.0, 2.5, 1.5]) - 0.5f64.ln()).abs() < 1e-9);
    }

    #[test]
    fn one_test_among_others_is_asked_about() {
        let exchanged = [0.5, 2.0];
        let asked = said([[1.0, 1.0], exchanged, [1.1, 1.05]]).unwrap();
        assert!(
            asked.starts_with("are the depths of pinion and gear exchanged in test B?")
                && asked.contains("a factor of about 2.0"),
            "{asked}"
        );
        // none; all; others that do not agree; by another factor
        assert_eq!(said([[1.0, 1.0], [1.2, 1.1], [1.1, 1.05]]), None);
        assert_eq!(said([exchanged; 3]), None);
        assert_eq!(said([[1.0, 1.0], exchanged, [1.0, 2.0]]), None);
        let root = 2f64.sqrt();
        assert_eq!(said([[1.0, 1.0], [root.recip(), root], [1.0, 1.0]]), None);
        // members that wear alike
        let alike = said_of(exchanged_depths, [[1.0; 2]; 3], [[1.0; 2]; 3]);
        assert_eq!(alike, None);
    }

    /// Profiles of eleven places: the pinion worn most at the root, the gear at the tip, both with a valley between.
    fn shaped(exchanged: usize) -> Option<String> {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let mut text = "test,member,cycles,quantity,position,value,sigma\n".to_owned();
        let mut models = Vec::new();
        let pinion = |part: f64| 4.0 * (part - 0.3).abs() + 3.0 * (1.0 - part).powi(3);
        let gear = |part: f64| 2.0 * (part - 0.7).abs() + 4.0 * part.powi(3);
        for (test, id) in ["A", "B", "C"].into_iter().enumerate() {
            for (member, radius) in [("pinion", 27.0), ("gear", 53.0)] {
                for place in 0..11 {
                    let part = f64::from(place) / 10.0;
                    let of = |is_pinion: bool| if is_pinion { pinion(part) } else { gear(part) };
                    let value = of((member == "pinion") != (test == exchanged));
                    text += &format!(
                        "{id},{member},200000,wear_depth,{},{value},0.1\n",
                        radius + part
                    );
                    models.push(of(member == "pinion"));
                }
            }
        }
        let data = Dataset::parse(&text, "m.csv", &study.known()).unwrap();
        let fits = super::super::fits_of(&models);
        let rows: Vec<FittedRow<'_>> = data.observations.iter().zip(&fits).collect();
        by_shape(&study, &rows)
    }

    #[test]
    fn depths_with_the_shape_of_the_other_member_are_asked_about() {
        for (test, id) in ["A", "B", "C"].into_iter().enumerate() {
            let asked = shaped(test).unwrap();
            assert!(
                asked.contains(&format!("exchanged in test {id}?")),
                "{asked}"
            );
        }
        assert_eq!(shaped(3), None);
    }
}
