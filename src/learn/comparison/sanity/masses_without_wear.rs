//! Masses in which next to nothing is seen of the wear that the depths of the same member call for: in another unit, or of another part. So little is
//! noise, of which no scale can be told.

use super::super::residual_statistics::FittedRow;
use super::{EXPLAINS, rounded, scale};
use crate::measure::{Observation, Quantity, Subject};
use crate::numeric::written;
use crate::study::Study;

/// Part of what the depths call for below which masses show next to nothing of it.
const LITTLE: f64 = 0.1;
/// Standard deviations of a weighing that the depths must call for, in the root mean square.
const CLEAR: f64 = 10.0;

/// The line on them, with the weighing at which most is missing.
pub(super) fn masses_without_wear(study: &Study, rows: &[FittedRow<'_>]) -> Option<String> {
    let members = [Subject::Pinion, Subject::Gear];
    let found: Vec<(Subject, (&Observation, f64))> = (members.into_iter())
        .filter_map(|member| Some((member, without_wear(rows, member)?)))
        .collect();
    let (whose, their) = match &found[..] {
        [(member, _)] => (format!("{}'s masses show", member.name()), "its"),
        _ => ("masses of both members show".to_owned(), "their"),
    };
    let (_, (o, called_for)) = found.iter().max_by(|a, b| a.1.1.total_cmp(&b.1.1))?;
    Some(format!(
        "the {whose} next to nothing of the wear that {their} depths call for: test {}, {}, after {} cycles lost {} mg, by the depths about {} mg: are the \
         masses in mg, and those of the whole gears that wore in these tests?",
        study.tests[o.test].id,
        o.member.name(),
        written::count(o.cycles),
        written::significant(o.value, 2),
        rounded(*called_for)
    ))
}

/// The weighing of a member at which most is missing, with the loss (mg) that the depths call for, if all weighings together show next to nothing.
fn without_wear<'o>(rows: &[FittedRow<'o>], member: Subject) -> Option<(&'o Observation, f64)> {
    let depth = scale(rows, Quantity::WearDepth, Some(member))?;
    if depth.explains < EXPLAINS || depth.factor <= 0.0 {
        return None;
    }
    let own = rows
        .iter()
        .filter(|(o, _)| o.quantity == Quantity::MassLoss && o.member == member && o.cycles > 0.0);
    let weighings: Vec<(&Observation, f64)> =
        own.map(|(o, row)| (*o, depth.factor * row.model)).collect();
    let square = |&(o, called_for): &(&Observation, f64)| (called_for / o.sigma).powi(2);
    let clear = weighings.iter().map(square).sum::<f64>() > CLEAR.powi(2) * weighings.len() as f64;
    let [lost, called_for] = weighings
        .iter()
        .fold([0.0; 2], |[lost, all], (o, called_for)| {
            [lost + o.value, all + called_for]
        });
    let most = weighings.into_iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    (clear && lost.abs() < LITTLE * called_for).then_some(most)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Dataset;

    /// Depths of 10, 20 and 30 µm where the model has these, and masses of which it has 100, 200 and 300 mg, of which `share` was weighed, ± 1 mg.
    fn said(share: f64) -> Option<String> {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let mut text = "test,member,cycles,quantity,position,value,sigma\n".to_owned();
        let mut models = Vec::new();
        for i in 1..4 {
            let (cycles, i) = (100_000 * i, f64::from(i));
            for radius in [26.0, 26.5, 27.4, 28.2, 29.0] {
                text += &format!("A,pinion,{cycles},wear_depth,{radius},{},0.1\n", 10.0 * i);
                models.push(10.0 * i);
            }
            text += &format!("A,pinion,{cycles},mass_loss,,{},1\n", 100.0 * share * i);
            models.push(100.0 * i);
        }
        let data = Dataset::parse(&text, "m.csv", &study.known()).unwrap();
        let fits = super::super::fits_of(&models);
        let rows: Vec<FittedRow<'_>> = data.observations.iter().zip(&fits).collect();
        masses_without_wear(&study, &rows)
    }

    #[test]
    fn masses_of_a_thousandth_of_the_depths_are_asked_about() {
        let asked = said(1e-3).unwrap();
        assert!(
            asked.starts_with("the pinion's masses show next to nothing of the wear that its depths call for: test A, pinion"),
            "{asked}"
        );
        assert!(
            asked.contains("lost 0.30 mg, by the depths about 300 mg:"),
            "{asked}"
        );
        assert!(said(-0.01).is_some());
    }

    #[test]
    fn masses_near_those_of_the_depths_are_not() {
        assert_eq!(said(0.2), None);
        assert_eq!(said(1.0), None);
    }
}
