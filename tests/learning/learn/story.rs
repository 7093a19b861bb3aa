//! From comparison to added effect: figures, places, words.

use super::*;
use gearwear::learn::{Comparison, Version, curves, ladder};
use gearwear::study::Study;

const STUDY: &str = r#"
[gears]
module = 2.0
pressure_angle = 20.0
face_width = 33.0
centre_distance = 80.0
[gears.pinion]
teeth = 27
bore_diameter = 25.0
[gears.gear]
teeth = 53
bore_diameter = 40.0
[material]
youngs_modulus = 210000.0
poisson_ratio = 0.3
density = 7850.0
[operation]
torque = 100.0
speed = 2000.0
[wear]
coefficient = 1e-10
cycles = 1e6
[[test]]
id = "A"
[[test]]
id = "B"
cycles = 8e5
[[test]]
id = "H"
role = "holdout"
misalignment = 0.3
cycles = 6e5
"#;

const ROLES: [Role; 3] = [Role::Fit, Role::Fit, Role::Holdout];

fn data(seed: u64, formula: fn(&Observation, f64, &[f64]) -> f64, p: &[f64]) -> Dataset {
    let empty = wear_data(&[("A", 1e6), ("B", 8e5), ("H", 6e5)], 15, true);
    measured(
        &empty,
        formula,
        &[1.2e-10, 1.3e-10, 1.1e-10],
        p,
        0.02,
        0.3,
        &mut Random(seed),
    )
}

fn problem<'a>(
    data: &'a Dataset,
    predictor: &'a dyn Predictor,
    parameters: Vec<Parameter>,
) -> Problem<'a> {
    Problem {
        data,
        roles: &ROLES,
        predictor,
        coefficient: Coefficient::Free(Parameter::coefficient(1e-10)),
        parameters,
        noise: noise(Scatter::Estimate),
    }
}

/// 450 points; each of 30 datums takes most of a degree of freedom. χ² per point is about 0.93 with a standard deviation of √(2/450) = 0.07.
#[test]
fn the_right_model_is_at_the_noise_floor() {
    let study = Study::parse(STUDY, "study.toml").unwrap();
    let data = data(1, steady, &[]);
    let predictor = Formula {
        data: data.clone(),
        formula: steady,
    };
    let fit = problem(&data, &predictor, Vec::new())
        .fit(&Effort::default())
        .unwrap();
    let comparison = Comparison::new(&study, &data, &fit);
    assert!(
        (0.75..1.1).contains(&comparison.chi2_per_point),
        "{}",
        comparison.chi2_per_point
    );
    assert!((comparison.rms_um.unwrap() / comparison.noise_rms_um.unwrap() - 0.97).abs() < 0.15);
    assert!(
        comparison
            .worst
            .starts_with("In no single region of a test does the model miss"),
        "{}",
        comparison.worst
    );
    assert!(
        comparison
            .validation
            .iter()
            .all(|v| v.error.abs() < 4.0 * v.u_val)
    );
    assert!(comparison.outliers.is_empty() && comparison.warnings.is_empty());
    assert_eq!(comparison.points, 450);
    assert_eq!(comparison.fit.points + comparison.holdout.points, 450);
    assert_eq!(
        comparison
            .places
            .iter()
            .map(|cell| cell.points)
            .sum::<usize>(),
        450
    );
    let lines = curves(&study, &data, &fit);
    assert_eq!(
        lines.iter().map(|curve| curve.points.len()).sum::<usize>(),
        450
    );
    for point in lines.iter().flat_map(|curve| &curve.points) {
        assert!((point.model - point.measured - point.residual).abs() < 1e-12);
    }
}

#[test]
fn the_json_has_the_agreed_keys() {
    let study = Study::parse(STUDY, "study.toml").unwrap();
    let data = data(2, running_in, &[2.5, 1.5e5]);
    let predictor = Formula {
        data: data.clone(),
        formula: steady,
    };
    let fit = problem(&data, &predictor, Vec::new())
        .fit(&Effort::default())
        .unwrap();
    let comparison = Comparison::new(&study, &data, &fit);
    let json: serde_json::Value = serde_json::to_value(&comparison).unwrap();
    for key in ["points", "chi2_per_point", "rms_um", "noise_rms_um"] {
        assert!(json[key].is_number(), "{key}");
    }
    for part in ["fit", "holdout"] {
        assert!(json[part]["points"].is_number() && json[part]["chi2_per_point"].is_number());
    }
    let parameter = &json["parameters"][0];
    assert_eq!(parameter["name"], "wear.coefficient");
    assert!(
        parameter["value"].is_number()
            && parameter["sigma"].is_number()
            && parameter["at_bound"] == false
    );
    let places = json["where"].as_array().unwrap();
    let mut last = f64::INFINITY;
    for place in places {
        for key in ["test", "member", "region"] {
            assert!(place[key].is_string());
        }
        assert!(
            [
                "lower_double",
                "single_lower",
                "single_upper",
                "upper_double"
            ]
            .contains(&place["region"].as_str().unwrap())
        );
        assert_eq!(place["cycles"].as_array().unwrap().len(), 2);
        assert!(place["points"].is_number() && place["bias_um"].is_number());
        let chi2 = place["chi2_per_point"].as_f64().unwrap();
        // what carries most above the noise comes first
        let excess = (chi2 - 1.0) * place["points"].as_f64().unwrap();
        assert!(excess <= last);
        last = excess;
    }
    let back: Comparison = serde_json::from_value(json).unwrap();
    assert_eq!(back.places.len(), comparison.places.len());
}

/// Regions by hand, for test A: r_b1 = 27 cos 20° = 25.3717, r_b2 = 49.8037, p_b = 2π cos 20° = 5.9043 mm.
///
/// ```text
/// E = √(29² − r_b1²) − 27 sin 20° = 4.811,  B = E − p_b = −1.093: radius √(r_b1² + (9.2345 − 1.093)²) = 26.646
/// A = 53 sin 20° − √(55² − r_b2²) = −5.209,  D = A + p_b = 0.695: radius 27.245
/// ```
/// Of the radii 26 + 3 i/14 mm on the pinion 4 lie below B, 1 up to the pitch point (27), 1 up to D, 9 above.
#[test]
fn points_are_counted_in_their_regions() {
    let study = Study::parse(STUDY, "study.toml").unwrap();
    let data = data(8, steady, &[]);
    let predictor = Formula {
        data: data.clone(),
        formula: steady,
    };
    let fit = problem(&data, &predictor, Vec::new())
        .fit(&Effort::default())
        .unwrap();
    let comparison = Comparison::new(&study, &data, &fit);
    for (region, points) in [
        ("lower_double", 4),
        ("single_lower", 1),
        ("single_upper", 1),
        ("upper_double", 9),
    ] {
        let cells: Vec<_> = comparison
            .places
            .iter()
            .filter(|c| {
                (c.test.as_str(), c.member.as_str(), c.region.as_str()) == ("A", "pinion", region)
            })
            .collect();
        assert_eq!(cells.len(), 5);
        assert!(cells.iter().all(|cell| cell.points == points), "{region}");
        assert!(cells.iter().any(|cell| cell.cycles == [2e5, 4e5]));
    }
}

#[test]
fn the_worst_place_is_told_in_words() {
    let study = Study::parse(STUDY, "study.toml").unwrap();
    let mut data = data(3, steady, &[]);
    // Both members of all tests lose 1 µm more where the gear's tip works, in the first fifth of the test.
    for o in &mut data.observations {
        let at = o.position.unwrap();
        let root =
            (o.member == Subject::Pinion && at < 26.4) || (o.member == Subject::Gear && at > 53.8);
        let first = o.cycles < 2.5e5 && o.cycles / study.tests[o.test].conditions.cycles < 0.3;
        if root && first {
            o.value += 1.0;
        }
    }
    let predictor = Formula {
        data: data.clone(),
        formula: steady,
    };
    let fit = problem(&data, &predictor, Vec::new())
        .fit(&Effort::default())
        .unwrap();
    let comparison = Comparison::new(&study, &data, &fit);
    for words in [
        "early in life (0 to ",
        "too low",
        "'s tip in",
        "falls",
        "shares it",
        "show the same",
    ] {
        assert!(
            comparison.worst.contains(words),
            "{words}: {}",
            comparison.worst
        );
    }
    let worst = &comparison.places[0];
    assert_eq!(
        (worst.region.as_str(), worst.cycles[0]),
        ("lower_double", 0.0)
    );
    assert!(worst.bias_um.unwrap() < -0.3);
}

#[test]
fn outliers_are_listed_with_their_line() {
    let study = Study::parse(STUDY, "study.toml").unwrap();
    let mut data = data(4, steady, &[]);
    data.observations[40].value += 10.0 * data.observations[40].sigma;
    let line = data.observations[40].line;
    let predictor = Formula {
        data: data.clone(),
        formula: steady,
    };
    let fit = problem(&data, &predictor, Vec::new())
        .fit(&Effort::default())
        .unwrap();
    let outliers = Comparison::new(&study, &data, &fit).outliers;
    assert_eq!(outliers[0].place, format!("measurements.csv:{line}"));
    assert!(outliers[0].standardised < -6.0);
}

/// Held-out tests judge and are judged: they change neither parameters nor evidence, and of them only k and datums are fitted.
#[test]
fn held_out_tests_take_no_part_in_the_fit() {
    let first = data(5, steady, &[]);
    let mut second = first.clone();
    for o in second.observations.iter_mut().filter(|o| o.test == 2) {
        o.value = o.value * 1.3 + 0.4;
    }
    let fit = |data: &Dataset| {
        let predictor = Formula {
            data: data.clone(),
            formula: steady,
        };
        problem(data, &predictor, Vec::new())
            .fit(&Effort::default())
            .unwrap()
    };
    let (a, b) = (fit(&first), fit(&second));
    assert_eq!(a.parameters, b.parameters);
    assert_eq!(a.log_evidence.to_bits(), b.log_evidence.to_bits());
    assert_eq!(a.rows[..300], b.rows[..300]);
    assert_eq!(b.tests[2].role, Role::Holdout);
    // A factor of 1.3 is within what k may scatter by here, the offset within the datums' prior.
    let moved = b.tests[2].deviation - a.tests[2].deviation;
    assert!((moved - 1.3f64.ln()).abs() < 0.03, "{moved}");
    let predictor = Formula {
        data: second.clone(),
        formula: steady,
    };
    let mut known = problem(&second, &predictor, Vec::new());
    known.noise = noise(Scatter::Relative(0.0));
    let known = known.fit(&Effort::default()).unwrap();
    assert_eq!(
        known.tests[2].coefficient.to_bits(),
        known.coefficient.to_bits()
    );
    // The noise has grown by 1.3, too.
    assert!(chi2(&b, &second, &ROLES, Role::Holdout) < 1.2 * 1.3 * 1.3);
    assert!(chi2(&known, &second, &ROLES, Role::Holdout) > 3.0);
}

/// Running-in is hidden, at little noise so that its form can be told from an excess that grows as the square root of cycles. Added, it brings both errors to the floor; a wrong effect betters the fit at most.
#[test]
fn the_right_effect_is_worth_adding_and_a_wrong_one_is_not() {
    let study = Study::parse(STUDY, "study.toml").unwrap();
    let empty = wear_data(&[("A", 1e6), ("B", 8e5), ("H", 6e5)], 15, true);
    let ks = [1.2e-10, 1.3e-10, 1.1e-10];
    let data = measured(
        &empty,
        running_in,
        &ks,
        &[2.5, 2.5e5],
        0.005,
        0.3,
        &mut Random(6),
    );
    let base = Formula {
        data: data.clone(),
        formula: steady,
    };
    let right = Formula {
        data: data.clone(),
        formula: running_in,
    };
    let other = Formula {
        data: data.clone(),
        formula: |o: &Observation, k: f64, p: &[f64]| {
            4.0 * (k / 1e-10) * ((o.cycles + p[0] * (p[1] * o.cycles).sqrt()) / 1e6) * shape(o)
        },
    };
    let wrong = Formula {
        data: data.clone(),
        formula: |o: &Observation, k: f64, p: &[f64]| steady(o, k, &[]) * shape(o).powf(p[0]),
    };
    let exponent = Parameter {
        name: "wrong.exponent".to_owned(),
        unit: "-".to_owned(),
        start: 0.1,
        lower: -3.0,
        upper: 3.0,
        prior: Prior::Normal { mean: 0.0, sd: 0.5 },
    };
    let effort = Effort::default();
    let fit = problem(&data, &base, Vec::new()).fit(&effort).unwrap();
    let added = problem(&data, &right, running_in_parameters())
        .fit(&effort)
        .unwrap();
    let of_other_form = problem(&data, &other, running_in_parameters())
        .fit(&effort)
        .unwrap();
    assert!(added.log_evidence > fit.log_evidence + 100.0 && added.converged);
    assert!(
        added.log_evidence > of_other_form.log_evidence + 3.0,
        "{} {}",
        added.log_evidence,
        of_other_form.log_evidence
    );
    for (estimate, truth) in added.parameters[1..].iter().zip([2.5, 2.5e5]) {
        assert!(
            (estimate.value - truth).abs() < 3.0 * estimate.sigma,
            "{estimate:?}"
        );
    }
    let mistaken = problem(&data, &wrong, vec![exponent]).fit(&effort).unwrap();
    let [before, mistaken, after] =
        [&fit, &mistaken, &added].map(|fit| Comparison::new(&study, &data, fit));
    assert!(before.chi2_per_point > 3.0, "{}", before.chi2_per_point);
    // Datums hide the level of the early excess, not its size.
    assert!(
        before.worst.contains("measured wear in test A is 1."),
        "{}",
        before.worst
    );
    let early = before
        .ratios
        .iter()
        .find(|r| r.test == "A" && r.cycles == 2e5)
        .unwrap();
    let k = fit.tests[0].coefficient / 1.2e-10;
    let truth = (2e5 + 2.5 * 2.5e5 * (1.0 - (-0.8f64).exp())) / 2e5 / k;
    assert!(
        (early.measured_over_computed - truth).abs() < 4.0 * early.sigma,
        "{early:?} {truth}"
    );
    let none: [String; 0] = [];
    let names = [["wrong".to_owned()], ["running_in".to_owned()]];
    let steps = ladder(&[
        Version {
            study: "base.toml",
            effects: &none,
            comparison: &before,
            before: None,
        },
        Version {
            study: "wrong.toml",
            effects: &names[0],
            comparison: &mistaken,
            before: Some(0),
        },
        Version {
            study: "right.toml",
            effects: &names[1],
            comparison: &after,
            before: Some(0),
        },
    ]);
    // 300 and 150 points: standard deviations of 0.08 and 0.115 about 0.93; four of them.
    let [useless, useful] = [&steps[1], &steps[2]].map(|step| step.improvement.unwrap());
    assert!(useless.holdout_factor.unwrap() < 1.05, "{useless:?}");
    assert!(useful.holdout_factor.unwrap() > 3.0 && useful.log_evidence.unwrap() > 100.0);
    assert!(steps[0].improvement.is_none());
    let json = serde_json::to_value(&steps).unwrap();
    for key in [
        "study",
        "effects",
        "fit_chi2_per_point",
        "holdout_chi2_per_point",
        "rms_um",
        "parameters",
    ] {
        assert!(!json[2][key].is_null(), "{key}");
    }
}

/// The right model's errors over twelve draws: the limit is 1.15, and one draw of 150 held-out points scatters by 0.12.
#[test]
fn the_right_effect_is_at_the_noise_floor_in_the_mean() {
    const DRAWS: u64 = 12;
    let study = Study::parse(STUDY, "study.toml").unwrap();
    let empty = wear_data(&[("A", 1e6), ("B", 8e5), ("H", 6e5)], 15, true);
    let mut mean = [0.0; 2];
    for seed in 1..=DRAWS {
        let data = measured(
            &empty,
            running_in,
            &[1.2e-10, 1.3e-10, 1.1e-10],
            &[2.5, 2.5e5],
            0.005,
            0.3,
            &mut Random(seed),
        );
        let right = Formula {
            data: data.clone(),
            formula: running_in,
        };
        let fit = problem(&data, &right, running_in_parameters())
            .fit(&Effort::default())
            .unwrap();
        let compared = Comparison::new(&study, &data, &fit);
        for (mean, share) in mean.iter_mut().zip([compared.fit, compared.holdout]) {
            *mean += share.chi2_per_point.unwrap() / DRAWS as f64;
        }
    }
    for chi2 in mean {
        assert!((0.85..1.15).contains(&chi2), "{mean:?}");
    }
}
