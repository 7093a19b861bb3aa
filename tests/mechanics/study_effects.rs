//! Claim: an `[[effect]]` of a study is what the catalogue says, with the study's values and bounds, and can be built any number
//! of times with other values; a wrong one is refused at its place, inside an expression too; `[fit] free` becomes
//! parameters with bounds and priors; oil, heat and measurements of a study and its tests arrive as stated.
//!
//! Source: the effects' own formulas by hand; B_M = √(k ρ c) and E* = E/(2 (1 − ν²)) for like materials by hand; the row count of
//! the open data by hand. Tolerance: none for texts and factors, 1e-12 relative for square roots and powers.

use gearwear::effects::{Effect, Hook, Local, Prior, find};
use gearwear::gear::Member;
use gearwear::study::{EffectSpec, Fault, Role, Study};
use proptest::prelude::*;

const BASE: &str = include_str!("../../validation/challenges/none_L2/study.toml");

/// `BASE` with more after it.
fn study(more: &str) -> Study {
    Study::parse(&format!("{BASE}\n{more}"), "s/study.toml").unwrap_or_else(|e| panic!("{e}"))
}

fn local() -> Local {
    Local {
        member: Member::Pinion,
        radius: 26.4,
        path: -2.0,
        approach: true,
        curvature: [7.0, 20.0],
        rolling: [1.5, 2.0],
        pressure: 800.0,
        peak_pressure: 900.0,
        hertz_pressure: 880.0,
        line_load: 100.0,
        half_width: 0.05,
        normal_load: 120.0,
        depth: 1.0,
        cycles: 1e5,
        contacts: 1e5,
        hours: 1.0,
        contact_hours: 1e-5,
        worn_volume: 1.0,
        torque: 100.0,
        speed: 2000.0,
        base_radius: 25.4,
        base_pitch: 5.9,
        film_ratio: 0.5,
        friction: 0.06,
        flash_temperature: 20.0,
        bulk_temperature: 60.0,
    }
}

#[test]
fn effects_are_built_with_the_studys_values_or_others() {
    let study = study(
        "[[effect]]\nkind = \"running_in\"\namplitude = 2.0\ndecay_cycles = { value = 1e5, lower = 1e3, upper = 1e6 }\n\
         [[effect]]\nkind = \"formula\"\nname = \"soft\"\nwear_factor = \"1 + a*pinion\"\n\
         [effect.parameters]\na = { value = 0.5, lower = 0, upper = 4 }\n",
    );
    let model = study.effect_model();
    assert_eq!(study.effects().len(), 2);
    let built = model.stated();
    let by_hand = (1.0 + 2.0 * (-1f64).exp()) * 1.5;
    assert_eq!(built.wear_factor(&local()), by_hand);
    assert!(built.acts(Hook::WearFactor) && !built.acts(Hook::Profile));
    let other = model.build(&|name| match name {
        "running_in.amplitude" => Some(4.0),
        "soft.a" => Some(1.0),
        _ => None,
    });
    let by_hand = (1.0 + 4.0 * (-1f64).exp()) * 2.0;
    assert_eq!(other.wear_factor(&local()), by_hand);
    assert_eq!(
        model.parameter("running_in.decay_cycles").unwrap().bounds,
        [Some(1e3), Some(1e6)]
    );
    assert!(!model.parameter("running_in.shape").unwrap().stated);
    assert!(model.has("soft") && !model.has("formula"));
}

#[test]
fn a_candidate_joins_the_effects_of_the_study() {
    let study = study("[[effect]]\nkind = \"running_in\"\namplitude = 0.0\n");
    let card = find("micropitting").unwrap();
    let candidate = EffectSpec::of_card(card, &[("rate", 5.0)]).unwrap();
    let names: Vec<String> = candidate.fitted().into_iter().map(|p| p.name).collect();
    assert_eq!(names, ["micropitting.rate", "micropitting.exponent"]);
    let built = study.effect_model().with(candidate).stated();
    assert_eq!(built.len(), 2);
    let by_hand = 5e-6 * 0.9f64.powf(4.0);
    assert!((built.added_depth(&local()) / by_hand - 1.0).abs() < 1e-12);
    assert_eq!(built.wear_factor(&local()), 1.0, "neutral running-in");
}

#[test]
fn infinity_switches_a_part_of_an_effect_off() {
    let study = study("[[effect]]\nkind = \"film_thickness\"\nlambda0 = inf\n");
    assert_eq!(study.effect_model().stated().wear_factor(&local()), 1.0);
}

#[test]
fn the_free_parameters_have_bounds_and_priors() {
    let study = Study::parse(
        &format!(
            "{BASE}\n[fit]\nfree = [\"soft.a\", \"running_in.amplitude\", \"wear.coefficient\", \"running_in.decay_cycles\"]\n\
             [[effect]]\nkind = \"running_in\"\ndecay_cycles = {{ value = 2e5, lower = 1e4 }}\n\
             [[effect]]\nkind = \"formula\"\nname = \"soft\"\nwear_factor = \"1 + a\"\nparameters = {{ a = {{ value = 1, lower = 0, upper = 10 }} }}\n"
        ),
        "study.toml",
    )
    .unwrap_or_else(|e| panic!("{e}"));
    let [a, amplitude, k, decay] = study.free() else {
        panic!("{:?}", study.free())
    };
    assert_eq!(
        (a.name.as_str(), a.value, a.lower, a.upper),
        ("soft.a", 1.0, 0.0, 10.0)
    );
    assert_eq!(
        (a.prior, a.log_scale),
        (
            Prior::Uniform {
                low: 0.0,
                high: 10.0
            },
            false
        )
    );
    assert_eq!(
        (amplitude.value, amplitude.upper, amplitude.neutral),
        (3.0, 50.0, Some(0.0))
    );
    assert!(amplitude.log_scale && amplitude.lower > 0.0 && amplitude.lower < 0.05);
    assert_eq!((k.name.as_str(), k.value), ("wear.coefficient", 1.41e-10));
    assert_eq!((decay.value, decay.lower, decay.upper), (2e5, 1e4, 1e9));
}

#[test]
fn oil_and_heat_are_those_of_the_test() {
    let text = "[[test]]\nid = \"hot\"\nrole = \"holdout\"\nreversed = true\nbulk_temperature = 90\nviscosity = 0.008\n";
    let study = study(text);
    let own = study.surroundings(&study.operation);
    assert_eq!(
        (own.viscosity_pa_s, own.bulk_temperature_c),
        (Some(0.015), Some(60.0))
    );
    assert_eq!(
        (own.pressure_viscosity_per_gpa, own.roughness_um),
        (Some(18.0), Some(0.5))
    );
    assert_eq!(own.friction_coefficient, Some(0.06));
    let modulus = 2.1e5 / (2.0 * (1.0 - 0.09));
    assert!((own.contact_modulus / modulus - 1.0).abs() < 1e-12);
    let heat = (46.0_f64 * 7850.0 * 470.0).sqrt();
    assert!((own.contact_coefficient.unwrap() / heat - 1.0).abs() < 1e-12);
    let hot = study.tests.last().unwrap();
    assert_eq!((hot.role, hot.conditions.reversed), (Role::Holdout, true));
    let around = study.surroundings(&hot.conditions);
    assert_eq!(
        (around.viscosity_pa_s, around.bulk_temperature_c),
        (Some(0.008), Some(90.0))
    );
    assert!(study.states("lubricant.roughness") && !study.states("lubricant.colour"));
}

#[test]
fn the_measurements_stand_beside_the_study() {
    let folder = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/validation/challenges/none_L2/study.toml"
    );
    let study = Study::load(std::path::Path::new(folder)).unwrap();
    let data = study.dataset().unwrap();
    assert_eq!((data.observations.len(), data.tests.len()), (2280, 4));
    let bare = BASE.split("[measurements]").next().unwrap();
    let none = Study::parse(bare, "study.toml")
        .unwrap()
        .dataset()
        .unwrap_err();
    assert_eq!(none.diagnostic().fault, Fault::MissingKey);
    assert!(none.to_string().contains("names no measurements"), "{none}");
    let untested = format!(
        "{}[measurements]\nfile = \"x.csv\"\n",
        bare.split("[[test]]").next().unwrap()
    );
    let none = Study::parse(&untested, "study.toml")
        .unwrap()
        .dataset()
        .unwrap_err();
    assert_eq!(none.diagnostic().key, "test");
}

#[test]
fn measurements_of_held_out_tests_alone_are_refused() {
    let home = tempfile::tempdir().unwrap();
    let file = home.path().join("study.toml");
    let held = BASE.replace(
        "id = \"A\"\nrole = \"fit\"",
        "id = \"A\"\nrole = \"holdout\"",
    );
    assert_ne!(held, BASE);
    std::fs::write(&file, held).unwrap();
    let rows =
        "test,member,cycles,quantity,position,value,sigma\nA,pinion,1e5,wear_depth,26.5,1.0,0.1\n";
    std::fs::write(home.path().join("measurements.csv"), rows).unwrap();
    let study = Study::load(&file).unwrap();
    assert_eq!(study.dataset().unwrap().observations.len(), 1);
    let error = study.dataset_to_fit().unwrap_err();
    let message = error.to_string();
    let line = BASE.lines().position(|l| l.starts_with("file =")).unwrap() + 1;
    assert_eq!(error.position().unwrap().0, line, "{message}");
    for part in [
        "no test with role \"fit\" has a measurement",
        "rows of a test with role \"fit\": B, C, D",
    ] {
        assert!(message.contains(part), "no `{part}` in:\n{message}");
    }
}

struct Refusal {
    fault: Fault,
    key: &'static str,
    /// The marked text, and where it begins: lines after the base text, column.
    mark: (&'static str, usize, usize),
    allowed: &'static str,
    says: &'static str,
}

fn refused(more: &str, expected: &Refusal) {
    let text = format!("{BASE}\n{more}");
    let error = Study::parse(&text, "study.toml").expect_err("must be refused");
    let message = error.to_string();
    let diagnostic = error.diagnostic();
    assert_eq!(diagnostic.fault, expected.fault, "{message}");
    assert_eq!(diagnostic.key, expected.key, "{message}");
    let (marked, line, column) = expected.mark;
    assert_eq!(&text[diagnostic.span.clone().unwrap()], marked, "{message}");
    let before = BASE.matches('\n').count() + 1;
    assert_eq!(error.position(), Some((before + line, column)), "{message}");
    assert!(diagnostic.allowed.contains(expected.allowed), "{message}");
    assert!(
        message.contains(expected.says),
        "no `{}` in:\n{message}",
        expected.says
    );
}

macro_rules! refusals {
    ($($name:ident: $text:expr => $fault:ident $key:literal marks $mark:literal at $line:literal:$at:literal, $allowed:literal, $says:literal;)+) => {
        $(#[test]
        fn $name() {
            refused(&$text, &Refusal {
                fault: Fault::$fault, key: $key, mark: ($mark, $line, $at), allowed: $allowed, says: $says,
            });
        })+
    };
}

fn effect(keys: &str) -> String {
    format!("[[effect]]\nkind = \"running_in\"\n{keys}\n")
}

fn formula(keys: &str) -> String {
    format!("[[effect]]\nkind = \"formula\"\nname = \"f\"\n{keys}\n")
}

refusals! {
    unknown_effect: "[[effect]]\nkind = \"runing_in\"\n"
        => BadValue "effect.kind" marks "\"runing_in\"" at 2:8, "an effect of the catalogue", "the nearest is \"running_in\"";
    misspelt_formula: "[[effect]]\nkind = \"fomula\"\n"
        => BadValue "effect.kind" marks "\"fomula\"" at 2:8, "an effect of the catalogue", "the nearest is \"formula\"";
    unknown_parameter: effect("amplitud = 1.0")
        => UnknownKey "effect.amplitud" marks "amplitud" at 3:1, "amplitude, decay_cycles", "the nearest is `amplitude`";
    value_out_of_range: effect("amplitude = -1.0")
        => BadValue "effect.amplitude" marks "-1.0" at 3:13, "0 to 50", "excess of the initial wear coefficient";
    value_in_a_table_out_of_range: effect("amplitude = { value = 60.0 }")
        => BadValue "effect.amplitude.value" marks "60.0" at 3:23, "0 to 50", "out of range";
    nan: effect("amplitude = nan")
        => BadValue "effect.amplitude" marks "nan" at 3:13, "", "not a finite number";
    beyond_doubles: effect("shape = 1e999")
        => BadValue "effect.shape" marks "1e999" at 3:9, "", "too large";
    infinite_amplitude: effect("amplitude = inf")
        => BadValue "effect.amplitude" marks "inf" at 3:13, "0 to 50", "out of range";
    text_for_a_number: effect("amplitude = \"3\"")
        => WrongType "effect.amplitude" marks "\"3\"" at 3:13, "a number", "without quotes";
    bound_out_of_range: effect("amplitude = { value = 1.0, lower = -1.0 }")
        => BadValue "effect.amplitude.lower" marks "-1.0" at 3:36, "0 to 50", "outside the parameter's range";
    bounds_upside_down: effect("amplitude = { value = 1.0, lower = 2.0, upper = 1.0 }")
        => BadValue "effect.amplitude.upper" marks "1.0" at 3:49, "above 2", "not above lower";
    value_outside_its_bounds: effect("amplitude = { value = 3.0, upper = 2.0 }")
        => BadValue "effect.amplitude.value" marks "3.0" at 3:23, "up to 2", "outside its own bounds";
    unknown_bound: effect("amplitude = { value = 1.0, uper = 2.0 }")
        => UnknownKey "effect.amplitude.uper" marks "uper" at 3:28, "value, lower, upper", "`upper`";
    twice: format!("{}{}", effect(""), effect("amplitude = 2.0"))
        => BadValue "effect.kind" marks "\"running_in\"" at 5:8, "each effect once", "twice";
    formula_twice: format!("{}{}", formula("profile = \"1\""), formula("profile = \"2\""))
        => BadValue "effect.name" marks "\"f\"" at 7:8, "each effect once", "different names";
    formula_called_like_an_effect: "[[effect]]\nkind = \"formula\"\nname = \"running_in\"\nprofile = \"1\"\n"
        => BadValue "effect.name" marks "\"running_in\"" at 3:8, "the catalogue's effects", "cannot be";
    formula_called_wear: "[[effect]]\nkind = \"formula\"\nname = \"wear\"\nprofile = \"1\"\n"
        => BadValue "effect.name" marks "\"wear\"" at 3:8, "other than \"wear\"", "cannot be";
    formula_unknown_name: formula("wear_factor = \"1 + presure\"")
        => BadValue "effect.wear_factor" marks "presure" at 4:20, "", "neither a parameter nor a variable";
    formula_open_parenthesis: formula("wear_factor = '(1 + p'")
        => BadValue "effect.wear_factor" marks "(" at 4:16, "", "never closed";
    formula_ends_early: formula("wear_factor = \"1 +\"")
        => BadValue "effect.wear_factor" marks "\"" at 4:19, "", "is missing at the end";
    formula_over_lines: formula("wear_factor = \"\"\"\n1 +\n  presure\"\"\"")
        => BadValue "effect.wear_factor" marks "presure" at 6:3, "", "neither a parameter";
    formula_variable_without_pressure: formula("load_factor = \"1 + p\"")
        => BadValue "effect.load_factor" marks "p" at 4:20, "", "before the contact is solved";
    formula_unused_parameter: formula("profile = \"1\"\n[effect.parameters]\na = 1.0")
        => BadValue "effect.parameters.a" marks "a" at 6:1, "", "does not use";
    formula_parameter_named_as_a_variable: formula("profile = \"radius\"\n[effect.parameters]\nradius = 1.0")
        => BadValue "effect.parameters.radius" marks "radius" at 6:1, "", "one of the variables";
    formula_infinite_parameter: formula("profile = \"a\"\nparameters = { a = inf }")
        => BadValue "effect.parameters.a" marks "inf" at 5:20, "a finite number", "not finite";
    formula_below_zero_everywhere: formula("wear_factor = \"-1\"")
        => BadValue "effect.wear_factor" marks "-1" at 4:16, "", "effect.wear_factor = -1 gives -1; allowed: a number from 0 on";
    formula_without_a_value: formula("load_factor = 'a/0'\nparameters = { a = 1 }")
        => BadValue "effect.load_factor" marks "a/0" at 4:16, "", "gives inf at a = 1; allowed: a number above 0";
    formula_unknown_function: formula("wear_factor = \"1 + exq(p)\"")
        => BadValue "effect.wear_factor" marks "exq" at 4:20, "", "no function `exq`; the nearest is `exp`";
    free_of_another_effect: format!("{}[fit]\nfree = [\"running_in.amplitud\"]\n", effect(""))
        => BadValue "fit.free" marks "\"running_in.amplitud\"" at 5:9, "\"running_in.amplitude\"", "the nearest is \"running_in.amplitude\"";
}

/// Effects that need what the study does not state.
#[test]
fn a_missing_need_is_named() {
    let dry = BASE.replace("roughness = 0.5\n", "");
    let cases = [
        (
            "[[effect]]\nkind = \"film_thickness\"\n",
            "film_thickness needs lubricant.roughness",
        ),
        (
            "[[effect]]\nkind = \"micropitting\"\nlambda_c = 0.6\n",
            "micropitting needs lubricant.roughness",
        ),
        (
            "[[effect]]\nkind = \"formula\"\nname = \"f\"\nwear_factor = \"1 + film_ratio\"\n",
            "f needs lubricant.roughness",
        ),
    ];
    for (text, says) in cases {
        let error = Study::parse(&format!("{dry}\n{text}"), "study.toml").unwrap_err();
        assert_eq!(error.diagnostic().key, "lubricant.roughness");
        assert!(error.to_string().contains(says), "{error}");
        assert!(error.to_string().contains("in [lubricant]"), "{error}");
    }
    let fine = "[[effect]]\nkind = \"micropitting\"\nlambda_c = inf\n";
    let freed = format!("{dry}\n{fine}[fit]\nfree = [\"micropitting.lambda_c\"]\n");
    let error = Study::parse(&freed, "study.toml").unwrap_err().to_string();
    assert!(
        error.contains("\"micropitting.lambda_c\" needs lubricant.roughness"),
        "{error}"
    );
    Study::parse(&format!("{dry}\n{fine}"), "study.toml").unwrap();
}

proptest! {
    /// Whatever stands in an expression: it is accepted, or refused at a place inside it.
    #[test]
    fn any_expression_is_accepted_or_refused_inside(
        text in "[ -&(-~µ]{1,20}|[a-z(*+^.,0-9) -]{1,20}",
        form in 0..3,
    ) {
        let written = match form {
            0 => format!("'{text}'"),
            1 => format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\"")),
            _ => format!("\"{}\"", text.chars().map(|c| format!("\\u{:04X}", u32::from(c))).collect::<String>()),
        };
        let file = format!("{BASE}\n[[effect]]\nkind = \"formula\"\nname = \"f\"\nwear_factor = {written}\n");
        if let Err(error) = Study::parse(&file, "study.toml") {
            let span = error.diagnostic().span.clone().unwrap();
            // the same text may stand before, as the id of a test
            let begin = file.len() - 1 - written.len();
            prop_assert!(span.start > begin && span.end <= begin + written.len(), "{}", error);
            prop_assert_eq!(error.diagnostic().key.as_str(), "effect.wear_factor");
        }
    }
}
