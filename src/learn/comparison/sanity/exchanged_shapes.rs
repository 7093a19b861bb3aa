//! Depths of the two members that stand in each other's rows, by their shapes: where both wear about alike their sizes do not tell.
//!
//! ```text
//! share of Σ (y − mean of its profile)² of a member's depths in one test that is explained
//!     by its own computed depths: below a half;   by its mate's at the same part of the profile: above seven tenths
//! of both members; and the other way round in all other tests, two at least
//! ```

use std::collections::BTreeMap;

use super::super::residual_statistics::FittedRow;
use super::exchanged_depths::{OTHERS, of_one_test};
use crate::measure::{Observation, Quantity, Subject};
use crate::study::Study;

/// Share of a member's depths that a shape must explain to stand in them, and up to which the other does not; fewest points of a profile.
const SHOWN: f64 = 0.7;
const HIDDEN: f64 = 0.5;
const POINTS: usize = 6;

/// A question about the tests of which either member's depths have the shape of the other's.
pub(super) fn exchanged_shapes(study: &Study, rows: &[FittedRow<'_>]) -> Option<String> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Dataset;

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
        exchanged_shapes(&study, &rows)
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
