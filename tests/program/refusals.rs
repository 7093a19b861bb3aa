//! Claim: what the library cannot use, it refuses with the error that says why, and with the nearest name where a name is at fault.
//!
//! Source: the conditions stated beside each error. Tolerance: none.

use gearwear::contact::model::ContactError;
use gearwear::contact::unilateral::{Drive, Problem, UnilateralError, solve};
use gearwear::effects::formula::{Formula, FormulaError, MOST_NAMES};
use gearwear::effects::{EffectError, Hook, Learned, LearnedError, find};
use gearwear::simulate::forward::{Forward, ForwardError};
use gearwear::study::Study;
use gearwear::verify::calculix::{self, CalculixError};
use gearwear::wear::archard::WearError;
use gearwear::wear::integrator::StepError;
use nalgebra::DMatrix;

fn formula(hook: Hook, text: &str, parameters: &[&str]) -> FormulaError {
    Formula::new(hook, text, parameters).expect_err(text)
}

#[test]
fn formulas_give_four_hooks_only() {
    for hook in Hook::ALL {
        let allowed = matches!(
            hook,
            Hook::WearFactor | Hook::AddedDepth | Hook::LoadFactor | Hook::Profile
        );
        let found = Formula::new(hook, "a", &["a"]);
        assert_eq!(found.is_ok(), allowed, "{}", hook.name());
        if let Err(error) = found {
            assert!(
                matches!(error, FormulaError::Hook { hook: name } if name == hook.name()),
                "{error}"
            );
        }
    }
}

#[test]
fn parameters_have_names_of_their_own() {
    let refused = [
        (vec!["2a"], "names are letters"),
        (vec![""], "names are letters"),
        (vec!["a-b"], "names are letters"),
        (vec!["radius"], "one of the variables"),
        (vec!["exp"], "function or constant"),
        (vec!["pi"], "function or constant"),
        (vec!["a", "a"], "twice"),
    ];
    for (parameters, why) in refused {
        let error = formula(Hook::WearFactor, "1", &parameters);
        let FormulaError::Name { name, reason } = &error else {
            panic!("{parameters:?}: {error}");
        };
        assert_eq!(Some(name.as_str()), parameters.last().copied());
        assert!(reason.contains(why), "{error}");
    }
}

#[test]
fn formulas_use_all_their_parameters_and_no_more_than_can_be_handed_over() {
    let error = formula(Hook::WearFactor, "1 + a", &["a", "b"]);
    assert!(matches!(&error, FormulaError::Unused { name } if name == "b"));

    let names: Vec<String> = (0..=MOST_NAMES).map(|n| format!("p{n}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let error = formula(Hook::WearFactor, &names.join(" + "), &names);
    assert!(matches!(error, FormulaError::TooMany { count } if count == MOST_NAMES + 1));
    let fewer = &names[..MOST_NAMES];
    assert!(Formula::new(Hook::WearFactor, &fewer.join(" + "), fewer).is_ok());
}

#[test]
fn learned_laws_follow_a_variable_of_their_hook_on_rising_knots() {
    let law = |hook, driver, knots: &[f64]| Learned::new(hook, driver, None, knots);
    assert!(law(Hook::WearFactor, "radius", &[26.0, 28.0]).is_ok());

    for hook in Hook::ALL {
        if !Learned::HOOKS.contains(&hook) {
            let error = law(hook, "radius", &[26.0, 28.0]).unwrap_err();
            assert!(matches!(error, LearnedError::Hook { hook: name } if name == hook.name()));
        }
    }

    let error = law(Hook::WearFactor, "radus", &[26.0, 28.0]).unwrap_err();
    let LearnedError::Driver {
        driver, nearest, ..
    } = error
    else {
        panic!("{error}");
    };
    assert_eq!((driver.as_str(), nearest), ("radus", "radius"));

    let refused: [(&[f64], &str); 6] = [
        (&[], "0 knots"),
        (&[1.0], "1 knots"),
        (&[1.0, 1.0], "knot 2 is 1"),
        (&[1.0, 3.0, 2.0], "knot 3 is 2"),
        (&[1.0, f64::NAN], "knot 2 is not finite"),
        (&[1.0, f64::INFINITY], "knot 2 is not finite"),
    ];
    for (knots, why) in refused {
        let error = law(Hook::WearFactor, "radius", knots).unwrap_err();
        assert!(
            matches!(&error, LearnedError::Knots(reason) if reason.contains(why)),
            "{knots:?}: {error}"
        );
    }
}

#[test]
fn unknown_effects_and_parameters_get_the_nearest_name() {
    let error = find("runing_in").expect_err("no such effect");
    let EffectError::UnknownEffect { name, nearest } = error else {
        panic!("{error}");
    };
    assert_eq!(
        (name.as_str(), nearest.as_str()),
        ("runing_in", "running_in")
    );

    let card = find("running_in").expect("it is in the catalogue");
    for (place, param) in card.params.iter().enumerate() {
        assert_eq!(card.place(param.name), Ok(place));
        let wrong = format!("{}s", param.name);
        let Err(EffectError::UnknownParameter {
            effect,
            parameter,
            nearest,
        }) = card.place(&wrong)
        else {
            panic!("{wrong} was found");
        };
        assert_eq!(
            (effect.as_str(), parameter, nearest.as_str()),
            ("running_in", wrong, param.name)
        );
    }
}

fn contact(w: &DMatrix<f64>, gap: &[f64], drive: Drive) -> UnilateralError {
    let arm = vec![1.0; gap.len()];
    solve(
        &Problem {
            w,
            gap,
            arm: &arm,
            lever: &arm,
            drive,
            symmetric: true,
        },
        &[],
    )
    .expect_err("a contact without a solution")
}

#[test]
fn contact_without_a_solution_is_refused() {
    let springs = DMatrix::identity(2, 2);
    for load in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = contact(&springs, &[0.0, 0.1], Drive::Load(load));
        assert!(
            matches!(error, UnilateralError::BadLoad { .. }),
            "{load}: {error}"
        );
    }
    for drive in [Drive::Load(1.0), Drive::Approach(1.0)] {
        let error = contact(&springs, &[0.0, f64::NAN], drive);
        assert!(matches!(error, UnilateralError::BadLoad { .. }), "{error}");
        let error = contact(&DMatrix::zeros(0, 0), &[], drive);
        assert!(
            matches!(error, UnilateralError::Separated { .. }),
            "{error}"
        );
    }

    let error = contact(&springs, &[0.2, 0.3], Drive::Approach(0.1));
    assert_eq!(
        error,
        UnilateralError::Separated {
            gap: 0.2,
            approach: 0.1
        }
    );

    // two places that push each other farther than themselves: no elastic body
    let error = contact(
        &DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 1.0]),
        &[0.0, 0.0],
        Drive::Approach(1.0),
    );
    assert_eq!(error, UnilateralError::Singular { active: 2 });
}

#[test]
fn a_deck_that_calculix_cannot_read_gives_no_answer() {
    match calculix::solve("*NODE\n1, 0., 0., 0.\n*STEP\n*STATIC\n*END STEP\n") {
        Err(CalculixError::Absent) => assert!(!calculix::installed()),
        Err(CalculixError::NoSolution { .. }) => assert!(calculix::installed()),
        other => panic!("{other:?}"),
    }
}

/// The paper's pair on a coarse mesh, some of its words replaced.
fn study(changes: &[(&str, &str)], numerics: &str) -> Study {
    let mut text = include_str!("../../validation/paper/study.toml").to_owned();
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    Study::parse(&format!("{text}\n[numerics]\n{numerics}\n"), "study.toml").expect("a study")
}

/// The contact of unworn gears by finite elements.
fn unworn(study: &Study) -> Result<(), ForwardError> {
    let set = study.gear_set();
    let numerics = study.resolution();
    let conditions = study.operation.simulated(&study.wear);
    let members = set.members(&numerics, &[conditions.torque], &[conditions.misalignment])?;
    let mut forward = Forward::new(&set, Some(&members), conditions, numerics)?;
    forward.wear_to(&mut None, 1.0, &mut |_, _| true)?;
    Ok(())
}

const COARSE: &str = "elements_per_half_width = 2\npositions = 20";

#[test]
fn flanks_that_need_too_many_elements_are_refused_before_they_are_meshed() {
    // a thousandth of the torque: edges that are 30 times shorter
    let fine = study(
        &[("torque = 100.0 ", "torque = 0.1 ")],
        "elements_per_half_width = 64",
    );
    let error = unworn(&fine).expect_err("more unknowns than memory");
    assert!(matches!(error, ForwardError::TooFine { .. }), "{error}");
}

#[test]
fn gears_too_soft_for_the_load_are_refused() {
    let steel = study(&[], COARSE);
    assert!(unworn(&steel).is_ok());
    let foam = study(
        &[("youngs_modulus = 2.1e5", "youngs_modulus = 2.1e3")],
        COARSE,
    );
    let error = unworn(&foam).expect_err("flanks that give way by more than half a millimetre");
    let ForwardError::Step(StepError::System {
        n,
        source: WearError::Contact(ContactError::TooSoft { closing, limit, .. }),
    }) = error
    else {
        panic!("{error}");
    };
    assert_eq!((n, limit), (0.0, 0.5));
    assert!(closing > limit);
}
