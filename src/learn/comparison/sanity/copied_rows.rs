//! Rows of one depth curve that stand in another one too: a block of cells copied by mistake while a sheet was put together.

use std::collections::BTreeMap;

use super::copied_curves::{depth_curves, may_be_alike};
use crate::measure::{Dataset, Observation};
use crate::study::Study;

/// Fewest neighbouring rows, each with another value, of which the same ones elsewhere are no chance.
const FEWEST: usize = 5;

/// Largest step between the values as they are written, parts of their σ: two independent values are the same with a chance below 6 % then, five
/// in a row with one below 1e-6.
const FINEST: f64 = 0.2;

/// A question about the longest such block.
///
/// Whole curves are [`super::copied_curves`]' to find; tests under the same conditions may be computed ones, without noise.
pub(super) fn copied_rows(study: &Study, data: &Dataset) -> Option<String> {
    let curves = depth_curves(data);
    let worn = curves.iter().filter(|own| own[0].cycles > 0.0);
    let curves: Vec<&Vec<&Observation>> = worn.filter(|own| is_fine(own)).collect();
    let mut longest: Option<Block<'_>> = None;
    for (n, one) in curves.iter().enumerate() {
        for other in &curves[n + 1..] {
            if one[0].member != other[0].member || may_be_alike(study, one[0], other[0]) {
                continue;
            }
            let block = same_rows(one, other).filter(|block| block.len() < one.len());
            let before = longest.as_ref().map_or(FEWEST - 1, Vec::len);
            longest = block.filter(|block| block.len() > before).or(longest);
        }
    }
    let block = longest?;
    let [from, to] = [block[0], block[block.len() - 1]];
    let whose = |n: usize| {
        let o = from[n];
        format!(
            "{} to line {} (the {} in test {} after {} cycles)",
            data.place(o),
            to[n].line,
            o.member.name(),
            data.tests[o.test],
            o.cycles
        )
    };
    Some(format!(
        "{} rows from {} hold the same values as those from {}, place by place: is a block of cells copied?",
        block.len(),
        whose(1),
        whose(0)
    ))
}

/// Neighbouring rows of one curve, each with the one of another curve that has the same place and value.
type Block<'d> = Vec<[&'d Observation; 2]>;

/// The longest block of two curves; none where values stand still in it.
fn same_rows<'d>(one: &[&'d Observation], other: &[&'d Observation]) -> Option<Block<'d>> {
    let at: BTreeMap<u64, &Observation> = (other.iter())
        .filter_map(|o| Some((o.position?.to_bits(), *o)))
        .collect();
    let mut longest = Block::new();
    let mut own = Block::new();
    for &o in one {
        let twin = o.position.and_then(|place| at.get(&place.to_bits()));
        match twin.filter(|twin| twin.value == o.value) {
            Some(twin) => own.push([o, *twin]),
            None => own.clear(),
        }
        if own.len() > longest.len() {
            longest.clone_from(&own);
        }
    }
    let mut values: Vec<u64> = longest.iter().map(|[o, _]| o.value.to_bits()).collect();
    values.sort_unstable();
    values.dedup();
    (values.len() >= FEWEST).then_some(longest)
}

/// Whether values, of a curve or several, are written so finely that equal ones are rare.
pub(super) fn is_fine(curve: &[&Observation]) -> bool {
    let mut values: Vec<f64> = curve.iter().map(|o| o.value).collect();
    values.sort_by(f64::total_cmp);
    let steps = values.windows(2).map(|pair| pair[1] - pair[0]);
    let finest = steps
        .filter(|step| *step > 0.0)
        .fold(f64::INFINITY, f64::min);
    let sigma = curve.iter().map(|o| o.sigma).sum::<f64>() / curve.len() as f64;
    curve.len() >= FEWEST && finest <= FINEST * sigma
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is said of two curves of twelve depths, those of the places `same` alike, the values written in steps of `step` µm at σ 0.1 µm.
    fn told(same: std::ops::Range<usize>, step: f64) -> Option<String> {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let mut text = "test,member,cycles,quantity,position,value,sigma,trace\n".to_owned();
        for cycles in [100_000, 200_000] {
            for i in 0..12 {
                let own = f64::from(cycles) * 1e-5 * (1.0 + (i as f64 * 1.7).sin().abs());
                let value = match same.contains(&i) {
                    true => 0.7 + (i as f64 * 0.9).cos() * 0.5,
                    false => own,
                };
                let value = (value / step).round() * step;
                let place = 26.5 + 0.1 * i as f64;
                text +=
                    &format!("A,pinion,{cycles},wear_depth,{place:.1},{value:.3},0.1,A{cycles}\n");
            }
        }
        copied_rows(
            &study,
            &Dataset::parse(&text, "m.csv", &study.known()).unwrap(),
        )
    }

    #[test]
    fn a_block_of_rows_of_another_curve_is_asked_about() {
        let asked = told(3..9, 0.001).unwrap();
        assert!(
            asked.starts_with(
                "6 rows from m.csv:17 to line 22 (the pinion in test A after 200000 cycles) hold the same values as those from m.csv:5 to line 10"
            ),
            "{asked}"
        );
        assert_eq!(told(3..7, 0.001), None);
        // an instrument that tells tenths has equal values by chance
        assert_eq!(told(3..9, 0.05), None);
    }
}
