//! Curves that stand in the file twice, under two tests or at two checkpoints: a file imported twice, a sheet copied and not filled in.

use std::collections::BTreeMap;

use crate::measure::{Dataset, FacePlace, Observation, Quantity};
use crate::study::Study;

/// Fewest different values of a curve of which the same ones elsewhere are no chance.
const FEWEST: usize = 5;

/// A question about the first two curves with the same values, and how many more there are.
pub(super) fn copied_curves(study: &Study, data: &Dataset) -> Option<String> {
    let mut first: BTreeMap<Vec<u64>, &Observation> = BTreeMap::new();
    let mut copies: Vec<[&Observation; 2]> = Vec::new();
    for own in depth_curves(data) {
        let values: Vec<u64> = own.iter().map(|o| o.value.to_bits()).collect();
        let mut different = values.clone();
        different.sort_unstable();
        different.dedup();
        if different.len() < FEWEST {
            continue;
        }
        match first.get(&values) {
            Some(one) if !is_one_flank(one, own[0]) && may_be_alike(study, one, own[0]) => {}
            Some(one) => copies.push([one, own[0]]),
            None => {
                first.insert(values, own[0]);
            }
        }
    }
    let [one, other] = copies.first()?;
    let whose = |o: &Observation| {
        format!(
            "the {} in test {} after {} cycles (from {} on)",
            o.member.name(),
            data.tests[o.test],
            o.cycles,
            data.place(o)
        )
    };
    let more = match copies.len() {
        1 => String::new(),
        n => format!(", and so have {} more", n - 1),
    };
    Some(format!(
        "{} and {} have the same values, every one{more}: is a sheet copied, or a file imported twice?",
        whose(one),
        whose(other)
    ))
}

/// The depth curves of the file: one of each test, member, moment, trace and place.
pub(super) fn depth_curves(data: &Dataset) -> Vec<Vec<&Observation>> {
    let mut curves: BTreeMap<_, Vec<&Observation>> = BTreeMap::new();
    let depths = (data.observations.iter()).filter(|o| o.quantity == Quantity::WearDepth);
    for o in depths {
        let place = (o.face.map(FacePlace::key), o.tooth.as_deref());
        let key = (o.test, o.member, o.cycles.to_bits(), o.trace, place);
        curves.entry(key).or_default().push(o);
    }
    curves.into_values().collect()
}

/// Whether two rows are of one flank of a test, which no two measurements find to be the same to the last digit.
fn is_one_flank(a: &Observation, b: &Observation) -> bool {
    let of = |o: &Observation| (o.test, o.member, o.face.map(FacePlace::key));
    of(a) == of(b) && a.tooth == b.tooth
}

/// Whether two rows are of tests made alike, after the same cycles: these may be computed ones, without noise.
pub(super) fn may_be_alike(study: &Study, a: &Observation, b: &Observation) -> bool {
    let own = |o: &Observation| {
        let own = &study.tests[o.test].conditions;
        [own.torque_nmm, own.speed_rpm, own.misalignment_mm, o.cycles]
    };
    own(a) == own(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is said of the same six depths, but for the last, of two tests.
    fn told(last: f64, flat: bool) -> Option<String> {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let mut text = "test,member,cycles,quantity,position,value,sigma,trace\n".to_owned();
        for (test, last) in [("A", 5.0), ("B", last)] {
            for (i, depth) in [0.5, 1.25, 2.0, 3.5, 4.25, last].into_iter().enumerate() {
                let depth = if flat { 0.0 } else { depth };
                let place = 26.5 + 0.1 * i as f64;
                text += &format!("{test},pinion,100000,wear_depth,{place},{depth},0.1,{test}1\n");
            }
        }
        copied_curves(
            &study,
            &Dataset::parse(&text, "m.csv", &study.known()).unwrap(),
        )
    }

    #[test]
    fn a_curve_that_is_there_twice_is_asked_about() {
        let asked = told(5.0, false).unwrap();
        assert!(
            asked.starts_with("the pinion in test A after 100000 cycles (from m.csv:2 on) and the pinion in test B"),
            "{asked}"
        );
        assert_eq!(told(5.1, false), None);
        // of zeros it says nothing
        assert_eq!(told(5.0, true), None);
    }
}
