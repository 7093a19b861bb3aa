//! Masses of the two members that stand in each other's rows.
//!
//! ```text
//! y = ln m_p/m_g of what was lost after the same cycles, f the same by the model, d of the depths (s_p/s_g, where both were measured)
//! |y − d − f| > ln 1.5 and |y + d + f| < ln 1.2: exchanged, they fit; beside such a test also where |y + d + f| is less by 0.1
//! ```
//! A member that wears by a k of its own does so in its depths too; where none were measured it is asked rather than said.

use super::super::residual_statistics::FittedRow;
use super::{SAME_CYCLES, rounded, scale};
use crate::measure::{Quantity, Subject};
use crate::study::Study;

/// Standard deviations from which a mass is no noise.
const SURE: f64 = 5.0;
/// Factor by which masses as they stand must be off, and within which they must fit once exchanged.
const OFF: f64 = 1.5;
const FITS: f64 = 1.2;
/// Factor within which masses are those of one tooth.
const ONE_TOOTH: f64 = 1.5;
/// By how much, in ln, masses must be nearer once exchanged where those of another test are for sure.
const NEARER: f64 = 0.1;
/// Fewest pairs of masses in all.
const FEWEST: usize = 2;

/// Both members' masses after the same cycles of a test.
struct Weighed {
    cycles: f64,
    measured: [f64; 2],
    model: [f64; 2],
}

impl Weighed {
    /// How far the ratio of both masses is from the expected one, in ln, as it stands and once exchanged.
    fn off(&self, depths: f64) -> [f64; 2] {
        let [measured, model] = [self.measured, self.model].map(|[p, g]| (p / g).ln());
        let expected = model + depths;
        [(measured - expected).abs(), (measured + expected).abs()]
    }

    fn is_exchanged(&self, depths: f64) -> bool {
        let [standing, exchanged] = self.off(depths);
        standing > OFF.ln() && exchanged < FITS.ln()
    }

    /// Whether both masses are near the share of one tooth in what the depths, which are so many times the model's, make up.
    fn is_of_one_tooth(&self, teeth: [f64; 2], depths: [f64; 2]) -> bool {
        (0..2).all(|i| {
            let share = self.measured[i] / (self.model[i] * depths[i]);
            (share * teeth[i]).ln().abs() < ONE_TOOTH.ln()
        })
    }

    fn is_nearer_exchanged(&self, depths: f64) -> bool {
        let [standing, exchanged] = self.off(depths);
        exchanged < standing - NEARER
    }
}

/// A question about the tests of which all masses fit far better with the members exchanged.
pub(super) fn exchanged_masses(study: &Study, rows: &[FittedRow<'_>]) -> Option<String> {
    let depths = |member| {
        let found = scale(rows, Quantity::WearDepth, Some(member))?;
        (found.factor > 0.0).then_some(found.factor)
    };
    let of_depths = depths(Subject::Pinion).zip(depths(Subject::Gear));
    let of_depths = of_depths.map_or(0.0, |(pinion, gear)| (pinion / gear).ln());
    let mut exchanged: Vec<(usize, Vec<Weighed>)> = (0..study.tests.len())
        .map(|test| (test, weighed(rows, test)))
        .filter(|(_, pairs)| !pairs.is_empty())
        .collect();
    let is_sure = |pairs: &[Weighed]| pairs.iter().all(|p| p.is_exchanged(of_depths));
    let teeth = [&study.gears.pinion, &study.gears.gear].map(|gear| f64::from(gear.spec.teeth));
    // masses of one tooth each have another ratio too, and are as small as that
    let scales = depths(Subject::Pinion).zip(depths(Subject::Gear));
    let of_one_tooth = |pair: &Weighed| {
        scales.is_some_and(|(pinion, gear)| pair.is_of_one_tooth(teeth, [pinion, gear]))
    };
    if exchanged
        .iter()
        .all(|(_, pairs)| pairs.iter().all(of_one_tooth))
    {
        return None;
    }
    let sure = exchanged.iter().filter(|(_, pairs)| is_sure(pairs));
    if sure.map(|(_, pairs)| pairs.len()).sum::<usize>() < FEWEST {
        return None;
    }
    exchanged.retain(|(_, pairs)| pairs.iter().all(|p| p.is_nearer_exchanged(of_depths)));
    let (first, pairs) = exchanged.first()?;
    let Weighed {
        cycles,
        measured: [pinion, gear],
        model: [of_pinion, of_gear],
    } = pairs.first()?;
    let tests: Vec<&str> = (exchanged.iter())
        .map(|(test, _)| study.tests[*test].id.as_str())
        .collect();
    Some(format!(
        "are the masses of pinion and gear exchanged in test{} {}? In {} the pinion lost {} times the gear's mass after {cycles} cycles, by the model \
         {} times; exchange the members of these rows, or look whether [wear.pinion] and [wear.gear] are",
        if tests.len() > 1 { "s" } else { "" },
        tests.join(", "),
        study.tests[*first].id,
        digits(pinion / gear),
        digits(of_pinion / of_gear),
    ))
}

/// The masses of a test that were weighed on both members and are no noise.
fn weighed(rows: &[FittedRow<'_>], test: usize) -> Vec<Weighed> {
    let of = |member: Subject| {
        let own = rows.iter().filter(move |(o, row)| {
            (o.test, o.member, o.quantity) == (test, member, Quantity::MassLoss)
                && o.value > SURE * o.sigma
                && row.model > 0.0
        });
        own.map(|(o, row)| (o.cycles, o.value, row.model))
    };
    let pair = |(cycles, pinion, of_pinion): (f64, f64, f64)| {
        let same = |gear: &(f64, f64, f64)| (gear.0 / cycles - 1.0).abs() < SAME_CYCLES;
        let (_, gear, of_gear) = of(Subject::Gear).find(same)?;
        Some(Weighed {
            cycles,
            measured: [pinion, gear],
            model: [of_pinion, of_gear],
        })
    };
    of(Subject::Pinion).filter_map(pair).collect()
}

/// Two digits of a factor, below 1 too.
fn digits(factor: f64) -> String {
    if factor < 1.0 {
        format!("{factor:.2}")
    } else {
        rounded(factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Dataset;

    /// What is said of masses of pinion and gear at two checkpoints, where the model has 6 and 2 mg, then 12 and 4; `depths` of both over
    /// the model's.
    fn said(masses: [[f64; 2]; 2], depths: Option<[f64; 2]>) -> Option<String> {
        let study = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let study = Study::parse(study, "study.toml").unwrap();
        let mut text = "test,member,cycles,quantity,position,value,sigma\n".to_owned();
        let mut models = Vec::new();
        for ((cycles, masses), model) in [100_000, 200_000]
            .into_iter()
            .zip(masses)
            .zip([[6.0, 2.0], [12.0, 4.0]])
        {
            for ((member, mass), model) in ["pinion", "gear"].iter().zip(masses).zip(model) {
                text += &format!("A,{member},{cycles},mass_loss,,{mass},0.1\n");
                models.push(model);
            }
        }
        for (member, radius, factor) in depths
            .into_iter()
            .flat_map(|[pinion, gear]| [("pinion", 27.0, pinion), ("gear", 53.0, gear)])
        {
            for (place, model) in [3.0, 5.0, 8.0].into_iter().enumerate() {
                let place = radius + 0.2 * place as f64;
                text += &format!(
                    "A,{member},200000,wear_depth,{place},{},0.1\n",
                    factor * model
                );
                models.push(model);
            }
        }
        let data = Dataset::parse(&text, "m.csv", &study.known()).unwrap();
        let fits = super::super::fits_of(&models);
        let rows: Vec<FittedRow<'_>> = data.observations.iter().zip(&fits).collect();
        exchanged_masses(&study, &rows)
    }

    #[test]
    fn exchanged_masses_are_asked_about() {
        let asked = said([[2.1, 5.9], [4.0, 12.1]], None).unwrap();
        assert!(
            asked.starts_with("are the masses of pinion and gear exchanged in test A?"),
            "{asked}"
        );
        assert!(
            asked.contains("lost 0.36 times") && asked.contains("by the model 3.0 times"),
            "{asked}"
        );
        // the depths of both are those of the model
        assert!(said([[2.1, 5.9], [4.0, 12.1]], Some([1.0, 1.0])).is_some());
        // by its depths the pinion wears twice as fast as by the model
        assert!(said([[2.0, 12.0], [4.0, 24.0]], Some([2.0, 1.0])).is_some());
        assert_eq!(said([[12.0, 2.0], [24.0, 4.0]], Some([2.0, 1.0])), None);
    }

    #[test]
    fn masses_of_one_tooth_are_not() {
        // 27 and 53 teeth, so that the ratio of the shares is near the other way round
        let of_one_tooth = [[5.29, 3.77], [10.58, 7.55]];
        assert!(said(of_one_tooth, Some([0.238, 1.0])).is_some());
        assert_eq!(said(of_one_tooth, Some([23.8, 100.0])), None);
    }

    #[test]
    fn members_that_wear_otherwise_are_not() {
        // as they are; at one checkpoint only; neither way; by a k of their own, which the depths show
        assert_eq!(said([[6.1, 2.0], [11.9, 4.1]], None), None);
        assert_eq!(said([[2.1, 5.9], [11.9, 4.1]], None), None);
        assert_eq!(said([[4.0, 4.1], [8.0, 8.1]], None), None);
        assert_eq!(
            said([[2.0, 6.0], [4.0, 12.0]], Some([1.0 / 3.0, 3.0])),
            None
        );
    }
}
