//! Depths of exactly 0 where noise would have led to some below: negative readings that a machine or a sheet has replaced by 0. They say where the zero
//! of a trace lies, and with them the size of its curve is lost.

use super::copied_curves::depth_curves;
use super::copied_rows::is_fine;
use crate::measure::{Dataset, Observation};

/// Fewest such rows.
const FEWEST: usize = 4;

/// A question about them; none where one depth is negative, or values are written no finer than their noise.
pub(super) fn cut_at_zero(data: &Dataset) -> Option<String> {
    let curves = depth_curves(data);
    let worn = curves.iter().filter(|own| own[0].cycles > 0.0);
    let rows: Vec<&Observation> = worn.flatten().copied().collect();
    let zeros: Vec<_> = rows.iter().filter(|o| o.value == 0.0).collect();
    if zeros.len() < FEWEST || !is_fine(&rows) || rows.iter().any(|o| o.value < 0.0) {
        return None;
    }
    Some(format!(
        "{} depths are exactly 0 and none is negative, the first at {}: are these negative readings that were replaced by 0? They tell where the zero of \
         their trace lies: put the readings back, or leave these rows out",
        zeros.len(),
        data.place(zeros[0])
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Study;

    /// What is asked of two curves around 0, of which readings below `least` are written as `least`, with so many decimals.
    fn asked(least: f64, decimals: usize) -> Option<String> {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let mut text = "test,member,cycles,quantity,position,value,sigma\n".to_owned();
        for cycles in [100_000, 200_000] {
            for i in 0..24 {
                let x = f64::from(i) / 23.0;
                let noise = 0.1 * (2.4 * f64::from(i)).sin();
                let value = (4.0 * x * x - 0.6 + noise).max(least);
                text += &format!(
                    "A,pinion,{cycles},wear_depth,{},{value:.decimals$},0.1\n",
                    26.0 + 3.0 * x
                );
            }
        }
        cut_at_zero(&Dataset::parse(&text, "m.csv", &study.known()).unwrap())
    }

    #[test]
    fn replaced_readings_are_asked_about() {
        let said = asked(0.0, 3).unwrap();
        assert!(
            said.contains("depths are exactly 0") && said.contains("m.csv:"),
            "{said}"
        );
    }

    #[test]
    fn readings_below_zero_and_coarse_ones_are_not() {
        assert_eq!(asked(f64::NEG_INFINITY, 3), None);
        // whole micrometres are 0 for half of one
        assert_eq!(asked(0.0, 0), None);
    }
}
