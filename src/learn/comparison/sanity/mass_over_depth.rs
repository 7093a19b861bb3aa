//! Masses that are not what the depths of the same test make up, by a factor that a slip of the pen has.
//!
//! ```text
//! r = ln s_mass − ln s_depth of each test and member      s: measured over model, so that k and laws of time cancel in r
//! r_t − median r near ln f in some tests, 0 in the others      f: 2, 10, 1000, a number of teeth, or over these
//! r_a − median = −(r_b − median), gone once a and b are exchanged
//! ```
//! To blame is whichever of s_mass and s_depth stands out against the other tests'. A factor of 2 in all tests is asked about by itself; any other one that
//! both members have in all tests alike is that of the face width, or of the density.

mod all_tests;
mod odd_test;

use super::super::residual_statistics::FittedRow;
use super::same_moments::ratio_at_same_moments;
use super::{EXPLAINS, scale};
use crate::measure::{Quantity, Subject};
use crate::numeric::median;
use crate::numeric::written::significant;
use crate::study::Study;

/// Standard deviations from which a scale of depths or masses is sure.
const SURE: f64 = 10.0;
/// The same of a mass itself, where what the depths make of it is sure.
const MORE_THAN_NOISE: f64 = 1.0;
/// How far the ratio of a test without a slip may be from the usual one, in ln: laws pull at it.
const NEAR: f64 = 0.15;
/// How far a ratio may be from 2, in ln.
const NEAR_TWO: f64 = 0.2;
/// The same where the factor is so large that no law makes it.
const NEAR_A_UNIT: f64 = 0.3;
/// Least of two opposite deviations, in ln, that may be an exchange.
const EXCHANGED: f64 = 0.25;
/// Share of one member's depths that the model must explain for a factor of two in a test of it alone.
const SHAPE: f64 = 0.85;
/// Fewest tests that tell what is usual; of fewer the model does.
const SEVERAL: usize = 3;

/// A member in a test where both were measured; all in ln.
struct Part {
    test: usize,
    member: Subject,
    depth: f64,
    /// Share of the depths' squares that the model explains.
    explains: f64,
    mass: f64,
    /// Mass over depth, at the same moments where there are such.
    ratio: f64,
    /// What the model loses by the last weighing, for exchanges.
    loss: f64,
}

/// A factor by which masses are off those of the depths.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Slip {
    Times(f64),
    OneTooth,
}

const SLIPS: [Slip; 7] = [
    Slip::OneTooth,
    Slip::Times(2.0),
    Slip::Times(0.5),
    Slip::Times(10.0),
    Slip::Times(0.1),
    Slip::Times(1e3),
    Slip::Times(1e-3),
];

impl Slip {
    fn log(self, study: &Study, member: Subject) -> f64 {
        match (self, member) {
            (Self::Times(factor), _) => factor.ln(),
            (Self::OneTooth, Subject::Gear) => -f64::from(study.gears.gear.spec.teeth).ln(),
            (Self::OneTooth, _) => -f64::from(study.gears.pinion.spec.teeth).ln(),
        }
    }

    fn is_near(self, off: f64, study: &Study, member: Subject) -> bool {
        let log = self.log(study, member);
        let near = if log.abs() > 1.0 {
            NEAR_A_UNIT
        } else {
            NEAR_TWO
        };
        (off - log).abs() < near
    }
}

/// What there is to ask of masses and depths that do not belong together.
pub(super) fn mass_over_depth(study: &Study, rows: &[FittedRow<'_>]) -> Option<String> {
    let parts = parts(study, rows);
    let usual = |member: Subject| {
        let own = parts.iter().filter(|p| p.member == member);
        let own: Vec<f64> = own.map(|p| p.ratio).collect();
        let several = own.len() >= SEVERAL;
        median(own).filter(|_| several).unwrap_or(0.0)
    };
    let usual = [Subject::Pinion, Subject::Gear].map(usual);
    let off = |p: &Part| p.ratio - usual[usize::from(p.member == Subject::Gear)];
    exchanged(study, &parts, &off)
        .or_else(|| of_some(study, &parts, &off))
        .or_else(|| odd_test::question(study, &parts, &off))
        .or_else(|| all_tests::question(study, &parts))
}

/// Each test and member where both were measured beyond doubt.
fn parts(study: &Study, rows: &[FittedRow<'_>]) -> Vec<Part> {
    let mut parts = Vec::new();
    for test in 0..study.tests.len() {
        let of_test = rows.iter().filter(|(o, _)| o.test == test);
        let own: Vec<FittedRow<'_>> = of_test.copied().collect();
        for member in [Subject::Pinion, Subject::Gear] {
            let sure = |s: &super::Scale| s.sigmas > SURE && s.explains > EXPLAINS;
            let depth = scale(&own, Quantity::WearDepth, Some(member)).filter(sure);
            let weighed = |(o, row): &&FittedRow<'_>| {
                (o.quantity, o.member) == (Quantity::MassLoss, member) && row.model > 0.0
            };
            let masses: Vec<&FittedRow<'_>> = own.iter().filter(weighed).collect();
            let sum = |f: &dyn Fn(&FittedRow<'_>) -> f64| -> f64 {
                masses.iter().map(|row| f(row) / row.0.sigma.powi(2)).sum()
            };
            let ff = sum(&|(_, row)| row.model * row.model);
            let fy = sum(&|(o, row)| row.model * o.value);
            let loss = masses.iter().map(|(_, row)| row.model).fold(0.0, f64::max);
            let is_sure = |depth: &super::Scale| {
                fy > SURE * ff.sqrt()
                    || fy > MORE_THAN_NOISE * ff.sqrt() && depth.factor * ff.sqrt() > SURE
            };
            if let Some(depth) = depth.filter(is_sure) {
                let explains = depth.explains;
                let (depth, mass) = (depth.factor.ln(), (fy / ff).ln());
                parts.push(Part {
                    test,
                    member,
                    depth,
                    explains,
                    mass,
                    ratio: ratio_at_same_moments(&own, member).unwrap_or(mass - depth),
                    loss: loss.ln(),
                });
            }
        }
    }
    parts
}

/// Two tests of which each has what the other should have.
fn exchanged(study: &Study, parts: &[Part], off: &dyn Fn(&Part) -> f64) -> Option<String> {
    let mut far: Vec<usize> = (parts.iter().filter(|p| off(p).abs() > NEAR))
        .map(|p| p.test)
        .collect();
    far.dedup();
    let [one, other] = far[..] else { return None };
    let of = |test: usize| parts.iter().filter(move |p| p.test == test);
    let fits = |(a, b): (&Part, &Part)| {
        // once exchanged, the mass of the other test over this one's model
        let [first, second] = [
            off(a) + b.mass + b.loss - a.mass - a.loss,
            off(b) + a.mass + a.loss - b.mass - b.loss,
        ];
        a.member == b.member
            && off(a) * off(b) < 0.0
            && off(a).abs().min(off(b).abs()) > EXCHANGED
            && first.abs().max(second.abs()) < NEAR
    };
    if of(one).count() != of(other).count() || !of(one).zip(of(other)).all(fits) {
        return None;
    }
    let (masses, _) = to_blame(parts, &|p| far.contains(&p.test));
    let [first, second] = [one, other].map(|test| study.tests[test].id.as_str());
    let [more, less] = [one, other].map(|test| times(of(test).map(off)));
    Some(format!(
        "are the {} of tests {first} and {second} exchanged? The masses of {first} are {more} times what its depths make up, those of {second} {less} \
         times; exchanged, they fit",
        if masses { "masses" } else { "depths" },
    ))
}

/// Tests whose masses are off by one factor, where the others' are not.
fn of_some(study: &Study, parts: &[Part], off: &dyn Fn(&Part) -> f64) -> Option<String> {
    let mut far: Vec<usize> = (parts.iter().filter(|p| off(p).abs() > NEAR))
        .map(|p| p.test)
        .collect();
    far.dedup();
    let of_far = || parts.iter().filter(|p| off(p).abs() > NEAR);
    let is_near = |slip: &&Slip| of_far().all(|p| slip.is_near(off(p), study, p.member));
    let apart = |slip: &Slip| -> f64 {
        let each = of_far().map(|p| (off(p) - slip.log(study, p.member)).abs());
        each.sum()
    };
    let near = SLIPS.iter().filter(is_near);
    let slip = near.min_by(|a, b| apart(a).total_cmp(&apart(b)));
    let slip = slip.filter(|_| !far.is_empty())?;
    // a model that is off by so much is no mistake yet where no other test and no other member says so
    let members = |member| of_far().any(|p| p.member == member);
    let both = members(Subject::Pinion) && members(Subject::Gear);
    let is_small = slip.log(study, Subject::Pinion).abs() < 1.0;
    if is_small && far.len() == study.tests.len() && !both {
        return None;
    }
    // laws that wear one member in another shape shift its depths against its masses
    if is_small && !both && of_far().any(|p| p.explains < SHAPE) {
        return None;
    }
    let (masses, sure) = to_blame(parts, &|p| off(p).abs() > NEAR);
    let ids: Vec<&str> = far
        .iter()
        .map(|test| study.tests[*test].id.as_str())
        .collect();
    let s = if ids.len() > 1 { "s" } else { "" };
    let place = match of_far().next().filter(|_| !both) {
        Some(one) => format!("the {} in test{s} {}", one.member.name(), ids.join(", ")),
        None => format!("test{s} {}", ids.join(", ")),
    };
    let log = slip.log(study, Subject::Pinion);
    let [of_masses, of_depths] = match slip {
        Slip::OneTooth => {
            let teeth = [&study.gears.pinion, &study.gears.gear].map(|g| g.spec.teeth);
            let weighed = [(Subject::Pinion, "pinion"), (Subject::Gear, "gear")].into_iter();
            let shares = (weighed.zip(teeth))
                .filter(|((member, _), _)| members(*member))
                .map(|((_, name), teeth)| format!("1/{teeth} ({name})"));
            return Some(format!(
                "the masses of {place} are near {} of what the depths there make up: are they those of one tooth? The loss of all teeth is wanted",
                shares.collect::<Vec<_>>().join(" and ")
            ));
        }
        Slip::Times(1e3) => [
            "µg, or mg that were taken for g; wanted in mg",
            "mm, wanted in µm",
        ],
        Slip::Times(1e-3) => ["g, wanted in mg", "nm, wanted in µm"],
        Slip::Times(2.0) => [
            "those of both flanks",
            "halved, as of a change of thickness",
        ],
        Slip::Times(0.5) => [
            "halved",
            "those of both flanks together, as a change of thickness is",
        ],
        Slip::Times(_) => ["off by a decimal place", "off by a decimal place"],
    };
    let factors = times(of_far().map(off));
    let (whose, of_what, by, hint, or) = if masses {
        ("masses", "depths", factors, of_masses, of_depths)
    } else {
        let inverse = times(of_far().map(|p| -off(p)));
        ("depths", "masses", inverse, of_depths, of_masses)
    };
    let doubt = match sure {
        true => format!(", and the {of_what} agree with the other tests'"),
        false => String::new(),
    };
    let or = match sure || log.abs() < 1.0 {
        true => String::new(),
        false => format!(" (or the {of_what} {or}?)"),
    };
    Some(format!(
        "the {whose} of {place} are {by} times what the {of_what} there make up{doubt}: are the {whose} {hint}?{or}"
    ))
}

/// Whether the masses of those that are `far` off stand out against the others' rather than the depths; and whether the other quantity does not.
fn to_blame(parts: &[Part], far: &dyn Fn(&Part) -> bool) -> (bool, bool) {
    let stands_out = |of: &dyn Fn(&Part) -> f64| {
        let others = parts.iter().filter(|p| !far(p));
        let middle = median(others.map(of).collect())?;
        let own = parts.iter().filter(|p| far(p));
        median(own.map(|p| (of(p) - middle).abs()).collect())
    };
    match [stands_out(&|p| p.mass), stands_out(&|p| p.depth)] {
        [Some(mass), Some(depth)] => (mass > depth, 2.0 * mass.min(depth) < mass.max(depth)),
        _ => (true, false),
    }
}

/// The middle one of some factors, given in ln.
fn times(logs: impl Iterator<Item = f64>) -> String {
    significant(median(logs.collect()).unwrap_or(0.0).exp(), 2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Dataset;

    const LOSS: [f64; 3] = [20.0, 30.0, 40.0];

    /// What is said of three tests that lost 20, 30 and 40 mg by the model on either member and wore in proportion, of which
    /// masses (pinion, gear) and depths are these times the model's.
    fn said(masses: [[f64; 2]; 3], depths: [f64; 3]) -> Option<String> {
        said_of(masses, |test, _, _| depths[test])
    }

    /// The same with depths that are so many times the model's in a test, on a member (0: the pinion), at a place.
    fn said_of(
        masses: [[f64; 2]; 3],
        depths: impl Fn(usize, usize, usize) -> f64,
    ) -> Option<String> {
        let text = include_str!("../../../../validation/challenges/none_L2/study.toml");
        let mut study = Study::parse(text, "study.toml").unwrap();
        let first = study.tests[0].clone();
        study.tests = (["A", "B", "C"].iter())
            .map(|id| crate::study::Test {
                id: (*id).to_owned(),
                ..first.clone()
            })
            .collect();
        let mut text = "test,member,cycles,quantity,position,value,sigma\n".to_owned();
        let mut models = Vec::new();
        for (test, loss) in LOSS.into_iter().enumerate() {
            let id = ["A", "B", "C"][test];
            for (member, (name, radius)) in [("pinion", 27.0), ("gear", 53.0)].iter().enumerate() {
                let mass = loss * masses[test][member];
                text += &format!("{id},{name},200000,mass_loss,,{mass},{}\n", 0.01 * mass);
                models.push(loss);
                for (place, model) in [3.0, 5.0, 8.0, 6.0].into_iter().enumerate() {
                    let factor = depths(test, member, place);
                    let (place, model) = (radius + 0.2 * place as f64, model * loss / 20.0);
                    let depth = factor * model;
                    let sigma = 0.01 * depth;
                    text += &format!("{id},{name},200000,wear_depth,{place},{depth},{sigma}\n");
                    models.push(model);
                }
            }
        }
        let data = Dataset::parse(&text, "m.csv", &study.known()).unwrap();
        let fits = super::super::fits_of(&models);
        let rows: Vec<FittedRow<'_>> = data.observations.iter().zip(&fits).collect();
        mass_over_depth(&study, &rows)
    }

    const RIGHT: [f64; 2] = [1.0, 1.0];

    fn told(masses: [[f64; 2]; 3], depths: [f64; 3], words: &[&str]) {
        let said = said(masses, depths).unwrap();
        for word in words {
            assert!(said.contains(word), "{word}: {said}");
        }
    }

    #[test]
    fn what_stands_out_against_the_other_tests_is_to_blame() {
        told(
            [RIGHT; 3],
            [1.0, 1e-3, 1.0],
            &[
                "the depths of test B are 0.0010 times",
                "the masses agree with the other tests'",
                "mm, wanted in µm",
            ],
        );
        told(
            [RIGHT, [1e-3, 1e-3], RIGHT],
            [1.0; 3],
            &["the masses of test B are 0.0010 times", "g, wanted in mg"],
        );
        told(
            [RIGHT; 3],
            [1.0, 0.5, 1.0],
            &["the depths of test B are 0.50 times", "halved"],
        );
        told(
            [RIGHT, RIGHT, [1.0 / 27.0, 1.0 / 53.0]],
            [1.0; 3],
            &[
                "the masses of test C are near 1/27 (pinion) and 1/53 (gear)",
                "one tooth",
            ],
        );
        told(
            [RIGHT, [0.5, 1.0], RIGHT],
            [1.0; 3],
            &[
                "the masses of the pinion in test B are 0.50 times",
                "halved",
            ],
        );
        told(
            [[1.0, 0.5], [1.0, 0.52], [1.05, 0.5]],
            [1.0; 3],
            &[
                "the gear's depths are 2.0 times what its masses make up",
                "both flanks together",
            ],
        );
        told(
            [[2.0, 2.0]; 3],
            [1.0; 3],
            &["all masses are 2.0 times", "both flanks"],
        );
    }

    #[test]
    fn exchanged_tests_are_asked_about() {
        told(
            [[2.0, 2.0], RIGHT, [0.5, 0.5]],
            [1.0; 3],
            &["are the masses of tests A and C exchanged? The masses of A are 2.0 times"],
        );
        told(
            [RIGHT; 3],
            [2.0, 1.0, 0.5],
            &["are the depths of tests A and C exchanged?"],
        );
    }

    /// Half as much in a test, on one member: everywhere, or another shape that comes to the same.
    #[test]
    fn one_member_that_wears_in_another_shape_is_not_asked_about() {
        let of = |mass: f64, shape: [f64; 4]| {
            let masses = [RIGHT, [1.0, mass], RIGHT];
            said_of(masses, |test, member, place| match (test, member) {
                (1, 1) => shape[place],
                _ => 1.0,
            })
        };
        let half = of(1.0, [0.5; 4]).unwrap();
        assert!(
            half.starts_with("the depths of the gear in test B are 0.50 times"),
            "{half}"
        );
        assert_eq!(of(1.0, [0.43, 0.43, 2.07, 2.07]), None);
        // no shape makes a thousand of it
        assert!(
            of(1e-3, [0.86, 0.86, 4.14, 4.14]).is_some_and(|said| said.contains("wanted in mg"))
        );
    }

    #[test]
    fn one_factor_of_both_members_in_all_tests_is_the_study_s() {
        told(
            [[1.25, 1.25], [1.26, 1.24], [1.25, 1.26]],
            [1.0; 3],
            &[
                "1.25 times",
                "face_width",
                "With 41.2 mm in place of 33.0 mm",
            ],
        );
        // k of each test is its own
        told(
            [[0.8, 0.8], [1.6, 1.6], [0.4, 0.4]],
            [1.0, 2.0, 0.5],
            &["0.800 times"],
        );
    }

    #[test]
    fn what_laws_do_is_not() {
        // k of a test's own; a common ratio that no slip has; a single test, or one member of it, by a factor that none has
        assert_eq!(said([RIGHT, [2.0, 2.0], RIGHT], [1.0, 2.0, 1.0]), None);
        assert_eq!(said([[1.4, 1.3]; 3], [1.0; 3]), None);
        assert_eq!(said([RIGHT, [1.3, 1.3], RIGHT], [1.0; 3]), None);
        assert_eq!(said([RIGHT, [1.5, 1.0], RIGHT], [1.0; 3]), None);
        assert_eq!(said([[1.0, 0.7], [1.0, 0.6], [1.0, 0.65]], [1.0; 3]), None);
    }
}
