//! One test whose masses and depths are at odds by a factor that no slip of the pen has.

use super::{Part, SEVERAL, times, to_blame};
use crate::study::Study;

/// How far, in ln, a test stands out whose masses and depths no known slip parts, and how near the usual ratio all others are then.
const ODD: f64 = 0.22;
const AGREE: f64 = 0.1;

/// The one test whose depths and masses are at odds by another factor than a slip makes, on both members alike, where they agree in all others.
pub(super) fn question(
    study: &Study,
    parts: &[Part],
    off: &dyn Fn(&Part) -> f64,
) -> Option<String> {
    let mut tests: Vec<usize> = parts.iter().map(|p| p.test).collect();
    tests.dedup();
    let of = |test: usize| parts.iter().filter(move |p| p.test == test);
    let is_far = |test: &&usize| {
        let own: Vec<f64> = of(**test).map(off).collect();
        let alike = own.iter().all(|o| o * own[0] > 0.0 && o.abs() > ODD);
        own.len() > 1 && alike
    };
    let odd = *tests.iter().find(is_far)?;
    let agree = |test: &usize| of(*test).all(|p| off(p).abs() < AGREE);
    if tests.len() <= SEVERAL || !tests.iter().all(|test| *test == odd || agree(test)) {
        return None;
    }
    let id = &study.tests[odd].id;
    let (masses, _) = to_blame(parts, &|p| p.test == odd);
    let log = |p: &Part| if masses { off(p) } else { -off(p) };
    let [whose, of_what] = match masses {
        true => ["masses", "depths"],
        false => ["depths", "masses"],
    };
    Some(format!(
        "the {whose} of test {id} are {} times what the {of_what} there make up, on both members, while in all other tests they agree: are its {whose} those of this \
         test, of these checkpoints, and counted from its start?",
        times(of(odd).map(log))
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Subject;

    /// Depths of the second of four tests that are half way between two checkpoints, beside masses of the second.
    #[test]
    fn a_test_at_odds_by_any_factor_is_asked_about_among_four() {
        let text = include_str!("../../../../../validation/challenges/none_L2/study.toml");
        let mut study = Study::parse(text, "study.toml").unwrap();
        let first = study.tests[0].clone();
        study.tests = vec![first; 4];
        let part = |test: usize, member: Subject, depth: f64| Part {
            test,
            member,
            depth,
            explains: 1.0,
            mass: 0.0,
            ratio: -depth,
            loss: 3.0,
        };
        let asked = |depths: [[f64; 2]; 4]| {
            let parts = depths
                .iter()
                .enumerate()
                .flat_map(|(test, [pinion, gear])| {
                    [
                        part(test, Subject::Pinion, *pinion),
                        part(test, Subject::Gear, *gear),
                    ]
                });
            let parts: Vec<Part> = parts.collect();
            question(&study, &parts, &|p: &Part| p.ratio)
        };
        let agree = [0.02, -0.03];
        let said = asked([agree, [-0.3, -0.29], agree, agree]).unwrap();
        assert!(
            said.contains("are 0.75 times what the masses there make up"),
            "{said}"
        );
        // one member alone; both the other way; another test that is off too; all alike
        assert_eq!(asked([agree, [-0.3, 0.0], agree, agree]), None);
        assert_eq!(asked([agree, [-0.3, 0.3], agree, agree]), None);
        assert_eq!(asked([agree, [-0.3, -0.28], [0.15, 0.15], agree]), None);
        assert_eq!(asked([agree; 4]), None);
    }
}
