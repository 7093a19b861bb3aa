//! Claim: measurements that are at fault themselves, or too few, are said to be so, and lead to no confident name; curves of unworn
//! flanks do no harm.

use gearwear::learn::diagnose::{Diagnosis, Verdict};
use gearwear::measure::{Dataset, Quantity};

use super::{Random, diagnosed_of, noisy, says, study, synthetic};

/// Rows of wear depth by curve (test, member, cycles).
fn curves(data: &Dataset) -> Vec<Vec<usize>> {
    let mut curves = std::collections::BTreeMap::new();
    for (row, o) in data.observations.iter().enumerate() {
        if o.quantity == Quantity::WearDepth {
            let curve: &mut Vec<usize> = curves
                .entry((o.test, o.member, o.cycles.to_bits()))
                .or_default();
            curve.push(row);
        }
    }
    curves.into_values().collect()
}

/// Whether one of the warnings holds all of these words.
fn warns(found: &Diagnosis, words: &[&str]) -> bool {
    let mut warnings = found.warnings.iter();
    warnings.any(|warning| words.iter().all(|word| warning.contains(word)))
}

#[test]
fn one_spoiled_curve_is_named_and_no_effect() {
    let mut data = synthetic("", 0.05, 0.03, 21);
    let spoiled = curves(&data)[3].clone();
    for (place, &row) in spoiled.iter().enumerate() {
        let o = &mut data.observations[row];
        // a tilt, from -12 to 12 sigma
        o.value += o.sigma * (24.0 * place as f64 / spoiled.len() as f64 - 12.0);
    }
    let found = diagnosed_of(data);
    let words = ["one curve carries", "look at that measurement"];
    assert!(warns(&found, &words), "{:?}", found.warnings);
    for (name, p) in &found.probabilities {
        let sure = *p > 0.95 && name != "unknown" && name != "nothing_missing";
        assert!(!sure, "{name} {p}\n{}", says(&found));
    }
}

/// Positions of one test that are off by the third of a millimetre, as of a test whose misalignment is not the stated one.
#[test]
fn one_test_at_other_conditions_is_named() {
    let mut data = synthetic("", 0.05, 0.03, 26);
    let off = 1;
    for o in data.observations.iter_mut().filter(|o| o.test == off) {
        o.position = o.position.map(|position| position + 0.33);
    }
    let found = diagnosed_of(data.clone());
    let test = format!("misfit is that of test {}", data.tests[off]);
    let words = [test.as_str(), "positions of its rows"];
    assert!(
        warns(&found, &words),
        "{:?}\n{}",
        found.warnings,
        says(&found)
    );
}

/// Noise of 0.05 µm and 3 % of each curve's largest depth, stated as 0.03 µm and 3 % of each value: where little is worn it is understated many
/// times, at the deepest points hardly, and no factor on sigma mends that.
#[test]
fn a_sigma_of_the_wrong_shape_is_no_cause() {
    let mut data = synthetic("", 0.05, 0.03, 25);
    for o in &mut data.observations {
        if o.quantity == Quantity::WearDepth {
            o.sigma = 0.03f64.hypot(0.03 * o.value);
        }
    }
    let found = diagnosed_of(data);
    let words = ["stated sigma of the depths", "% of the largest depth"];
    assert!(warns(&found, &words), "{:?}", found.warnings);
    assert_eq!(found.verdict, Verdict::NothingMissing, "{}", says(&found));
}

/// All depths of a flank were taken from one new profile, which scatters by 0.8 µm.
#[test]
fn the_scatter_of_a_new_profile_is_no_cause() {
    let truth = study("");
    let mut data = noisy(&truth, truth.dataset().unwrap(), 0.05, [0.03, 0.05], 28);
    let mut random = Random(29);
    let mut new = std::collections::BTreeMap::new();
    for o in &mut data.observations {
        if o.quantity == Quantity::WearDepth {
            let place = (o.test, o.member, o.position.map(f64::to_bits));
            o.value += *new.entry(place).or_insert_with(|| 0.8 * random.normal());
        }
    }
    let found = diagnosed_of(data);
    let words = ["one new profile", "`[noise] new_profile`"];
    assert!(warns(&found, &words), "{:?}", found.warnings);
    assert!(
        !warns(&found, &["stated sigma of the depths"]),
        "{:?}",
        found.warnings
    );
    assert_eq!(found.verdict, Verdict::NothingMissing, "{}", says(&found));
}

#[test]
fn zeros_that_change_between_curves_without_traces_are_suspected() {
    let mut data = synthetic("", 0.05, 0.03, 22);
    for (number, curve) in curves(&data).into_iter().enumerate() {
        for row in curve {
            let o = &mut data.observations[row];
            o.trace = None;
            // 10 sigma up and down in turn
            o.value += o.sigma * if number % 2 == 0 { 10.0 } else { -10.0 };
        }
    }
    let found = diagnosed_of(data);
    let words = ["a constant for each curve", "column trace"];
    assert!(warns(&found, &words), "{:?}", found.warnings);
}

#[test]
fn traces_that_are_tilted_each_by_itself_are_seen_to_be() {
    let mut data = synthetic("", 0.05, 0.03, 24);
    let mut seed = 1_u32;
    for curve in curves(&data) {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        // up to 1 µm over the flank, one way or the other
        let tilt = f64::from(seed) / f64::from(u32::MAX) - 0.5;
        for (place, &row) in curve.iter().enumerate() {
            let along = place as f64 / curve.len() as f64 - 0.5;
            data.observations[row].value += 2.0 * tilt * along;
        }
    }
    let found = diagnosed_of(data);
    assert_eq!(found.verdict, Verdict::Unknown, "{}", says(&found));
    assert_eq!(
        found.driver.as_ref().unwrap().name,
        "trace",
        "{:?}",
        found.drivers
    );
    let told = |reason: &String| reason.contains("measuring machine");
    assert!(found.reasons.iter().any(told), "{}", says(&found));
}

#[test]
fn a_handful_of_values_is_said_to_be_too_few() {
    let mut data = synthetic("", 0.05, 0.03, 23);
    let mut kept = 0;
    data.observations.retain(|o| {
        kept += usize::from(o.quantity == Quantity::WearDepth);
        o.quantity == Quantity::WearDepth && kept % 200 == 1
    });
    let found = diagnosed_of(data);
    assert!(
        found.sentence.starts_with("Too few measured values ("),
        "{}",
        says(&found)
    );
    assert!(found.driver.is_none() && found.effect.is_none());
}

#[test]
fn filtered_traces_are_warned_of() {
    let mut data = synthetic("", 0.05, 0.03, 24);
    let exact = data.clone();
    for curve in curves(&data) {
        for (place, &row) in curve.iter().enumerate() {
            // the mean of seven neighbours, as a profile filter leaves them
            let near = &curve[place.saturating_sub(3)..curve.len().min(place + 4)];
            let sum: f64 = near.iter().map(|&r| exact.observations[r].value).sum();
            data.observations[row].value = sum / near.len() as f64;
        }
    }
    let found = diagnosed_of(data);
    let words = ["too bold", "filtered"];
    assert!(warns(&found, &words), "{:?}", found.warnings);
    let plain = diagnosed_of(exact);
    assert!(!warns(&plain, &["too bold"]), "{:?}", plain.warnings);
}

#[test]
fn traces_from_before_the_first_cycle_are_welcome() {
    let mut data = synthetic("", 0.05, 0.03, 25);
    let first = curves(&data)[0].clone();
    for row in first {
        let o = &mut data.observations[row];
        o.cycles = 0.0;
        o.value = 0.0;
    }
    let found = diagnosed_of(data);
    assert!(found.probabilities.values().all(|p| p.is_finite()));
    assert!(found.effect.is_none(), "{}", says(&found));
}

/// A tilt that is small beside the noise of all curves together, with a true effect beside it.
#[test]
fn a_slightly_tilted_curve_is_named_too() {
    let hidden = "[[effect]]\nkind = \"running_in\"\namplitude = 2.0\ndecay_cycles = 1.2e5\n";
    for (hidden, seed) in [("", 31), (hidden, 32)] {
        let mut data = synthetic(hidden, 0.05, 0.03, seed);
        let spoiled = curves(&data)[5].clone();
        let o = data.observations[spoiled[0]].clone();
        for (place, &row) in spoiled.iter().enumerate() {
            let o = &mut data.observations[row];
            // from -4 to 4 sigma
            o.value += o.sigma * (8.0 * place as f64 / spoiled.len() as f64 - 4.0);
        }
        let test = format!("test {}, {}", data.tests[o.test], o.member.name());
        let cycles = format!("after {:.4e} cycles", o.cycles);
        let found = diagnosed_of(data);
        let words = ["one curve", &test, &cycles];
        assert!(
            warns(&found, &words),
            "{:?}\n{}",
            found.warnings,
            says(&found)
        );
    }
}
