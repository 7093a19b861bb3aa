//! A user's own effect by formula.

use gearwear::effects::formula::{Formula, FormulaError};
use gearwear::effects::{Hook, Local, ProfileAt, find};
use gearwear::gear::Member;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use super::places::{anywhere, ordinary, profile};
use super::{close, same};

fn factor(text: &str) -> f64 {
    let formula = Formula::new(Hook::WearFactor, text, &[]).unwrap_or_else(|e| panic!("{e}"));
    let effect = formula.build(&[]);
    let value = effect.wear_factor(&ordinary());
    assert_eq!(effect.fault(), None);
    value
}

/// A number of either sign: `text` shifted by 1000, so that it passes as a factor.
fn number(text: &str) -> f64 {
    factor(&format!("1000 + ({text})")) - 1000.0
}

#[test]
fn operators_bind_as_on_paper() {
    for (text, value) in [
        ("-2^2", -4.0),
        ("2^3^2", 512.0),
        ("2^-1", 0.5),
        ("-2^-2", -0.25),
        ("(-2)^2", 4.0),
        ("2^(3)^2", 512.0),
        ("(2^3)^2", 64.0),
        ("--2", 2.0),
        ("2--2", 4.0),
        ("2*-3", -6.0),
        ("-3^2*2", -18.0),
        ("6/3*2", 4.0),
        ("6/(3*2)", 1.0),
        ("8/4/2", 1.0),
        ("8-4-2", 2.0),
        ("2+3*4", 14.0),
        ("2*3^2", 18.0),
        ("-abs(-2)^2", -4.0),
        ("4^0.5^2", 2f64.sqrt()),
        ("1e-3*2.5E+2 + .5", 0.75),
        ("max(1, -2) - min(3,4)", -2.0),
        ("step(1) + step(0) + step(-1)", 1.0),
        ("sqrt(16)*ln(exp(2)) + log10(100)", 10.0),
        ("cos(pi) + sin(pi/2) + tanh(0) + tan(0)", 0.0),
        ("  1\t+\n1 ", 2.0),
        ("+2", 2.0),
    ] {
        close(number(text), value, 1e-12);
    }
}

#[test]
fn variables_are_the_local_state() {
    let at = ordinary();
    for (text, value) in [
        ("p", at.pressure),
        ("p_max", at.peak_pressure),
        ("v_slide", at.sliding_speed()),
        ("v_roll", at.entraining_speed()),
        ("cycles", at.cycles),
        ("depth", at.depth),
        ("radius", at.radius),
        ("-s", 1.5),
        ("approach", 1.0),
        ("film_ratio", at.film_ratio),
        ("flash_temperature", at.flash_temperature),
        ("line_load", at.line_load),
        ("torque", at.torque),
        ("speed", at.speed),
        ("pinion", 1.0),
        ("dedendum", 1.0),
    ] {
        assert_eq!(factor(text), value, "{text}");
    }
}

/// The example of the manual: a band of softer material.
#[test]
fn a_soft_band() {
    let text = "1 + a*exp(-((radius-r0)/w)^2)";
    let band = Formula::new(Hook::WearFactor, text, &["a", "r0", "w"]).unwrap();
    assert!(band.needs().is_empty());
    let effect = band.build(&[2.0, 26.4, 0.2]);
    assert_eq!(effect.wear_factor(&ordinary()), 3.0);
    same(
        effect.wear_factor(&Local {
            radius: 26.6,
            ..ordinary()
        }),
        1.0 + 2.0 * (-1f64).exp(),
    );
    // other hooks are left alone
    assert_eq!(effect.added_depth(&ordinary()), 0.0);
    assert_eq!(effect.load_factor(&ordinary()), 1.0);
    assert_eq!(effect.profile(&profile()), 0.0);
}

#[test]
fn each_hook_takes_a_formula() {
    let depth = Formula::new(Hook::AddedDepth, "c*(p_max/1000)^4*(contacts < 0)", &["c"]);
    assert!(
        depth
            .unwrap_err()
            .to_string()
            .contains("`<` has no meaning here")
    );
    let depth = Formula::new(Hook::AddedDepth, "c*1e-6*(p_max/1000)^4", &["c"]).unwrap();
    same(
        depth.build(&[3.0]).added_depth(&ordinary()),
        3e-6 * 0.85f64.powi(4),
    );
    let load = Formula::new(Hook::LoadFactor, "1 + 0.1*cos(2*pi*s/base_pitch)", &[]).unwrap();
    same(
        load.build(&[]).load_factor(&Local {
            path: 5.904,
            ..ordinary()
        }),
        1.1,
    );
    let relief = Formula::new(Hook::Profile, "pinion*c*max(0, radius - 28)^2", &["c"]).unwrap();
    let effect = relief.build(&[8.0]);
    same(effect.profile(&profile()), 2.0);
    assert_eq!(
        effect.profile(&ProfileAt {
            member: Member::Gear,
            ..profile()
        }),
        0.0
    );
    // a profile may stand proud
    let proud = Formula::new(Hook::Profile, "-c*along", &["c"])
        .unwrap()
        .build(&[5.0]);
    assert_eq!(proud.profile(&profile()), -4.0);
    assert_eq!(proud.fault(), None);
    let film = Formula::new(Hook::WearFactor, "1/(1 + film_ratio + friction)", &[]).unwrap();
    assert_eq!(
        film.needs(),
        [
            "lubricant.pressure_viscosity",
            "lubricant.roughness",
            "lubricant.viscosity"
        ]
    );
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, rng_seed: RngSeed::Fixed(20), failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn running_in_by_formula_is_the_built_in(at in anywhere(), amplitude in 0.0..50.0f64, power in 2.0..9.0f64) {
        let decay = 10f64.powf(power);
        let text = "1 + amplitude*exp(-cycles/decay_cycles)";
        let own = Formula::new(Hook::WearFactor, text, &["amplitude", "decay_cycles"]).unwrap().build(&[amplitude, decay]);
        let card = find("running_in").unwrap();
        let built_in = (card.build)(&card.values(&[("amplitude", amplitude), ("decay_cycles", decay)]).unwrap());
        let (a, b) = (own.wear_factor(&at), built_in.wear_factor(&at));
        prop_assert!((a - b).abs() <= 1e-15 * b, "{} {}", a, b);
    }

    /// Whatever is typed is read or refused; nothing panics.
    #[test]
    fn any_text_is_read_or_refused(text in "[-+*/^(),. 0-9a-zµ_]{0,40}") {
        if let Ok(formula) = Formula::new(Hook::WearFactor, &text, &[]) {
            formula.build(&[]).wear_factor(&ordinary());
        }
    }

    /// Sums, products, quotients and powers of whole numbers against an evaluation that never leaves its own tree.
    #[test]
    fn random_trees_keep_their_meaning(tree in tree()) {
        let (text, value) = tree;
        prop_assume!(value.abs() < 1e6);
        let ours = number(&text);
        prop_assert!((ours - value).abs() <= 1e-9 * (1.0 + value.abs()), "{} is {}, read as {}", text, value, ours);
    }
}

/// A text with as few parentheses as the rules of paper need, and its value.
fn tree() -> impl Strategy<Value = (String, f64)> {
    // text, value, how tightly its outermost operator binds: 0 sum, 1 product, 2 sign, 3 power, 4 atom
    let leaf = (1..5i32).prop_map(|n| (n.to_string(), f64::from(n), 4));
    let inside = |node: &(String, f64, i32), least: i32| {
        if node.2 >= least {
            node.0.clone()
        } else {
            format!("({})", node.0)
        }
    };
    leaf.prop_recursive(5, 24, 2, move |node| {
        (node.clone(), node, 0..6).prop_map(move |(a, b, kind)| match kind {
            0 => (format!("{}+{}", inside(&a, 0), inside(&b, 1)), a.1 + b.1, 0),
            1 => (
                format!("{} - {}", inside(&a, 0), inside(&b, 1)),
                a.1 - b.1,
                0,
            ),
            2 => (format!("{}*{}", inside(&a, 1), inside(&b, 2)), a.1 * b.1, 1),
            3 if b.1.abs() > 1e-3 => (format!("{}/{}", inside(&a, 1), inside(&b, 2)), a.1 / b.1, 1),
            4 => (format!("-{}", inside(&a, 2)), -a.1, 2),
            _ if (1e-3..30.0).contains(&a.1) && b.1.abs() < 4.0 => (
                format!("{}^{}", inside(&a, 4), inside(&b, 2)),
                a.1.powf(b.1),
                3,
            ),
            _ => (format!("{}+{}", inside(&a, 0), inside(&b, 1)), a.1 + b.1, 0),
        })
    })
    .prop_map(|(text, value, _)| (text, value))
}

fn refusal(hook: Hook, text: &str, parameters: &[&str]) -> String {
    Formula::new(hook, text, parameters)
        .unwrap_err()
        .to_string()
}

#[test]
fn faults_are_shown_in_their_place() {
    assert_eq!(
        refusal(Hook::WearFactor, "1 + a*exp(-radios/1000)", &["a"]),
        "`radios` is neither a parameter nor a variable; the nearest is `radius` (at character 12)\n  \
         1 + a*exp(-radios/1000)\n             ^^^^^^"
    );
    for (text, column, length, message) in [
        ("1 + ", 4, 1, "missing at the end"),
        ("1 + * 2", 4, 1, "missing before this"),
        ("2 p", 2, 1, "an operator is missing"),
        ("2(p)", 1, 1, "cannot stand here"),
        ("(1 + 2", 0, 1, "never closed"),
        ("exp(1 + 2", 3, 1, "never closed"),
        ("1 + 2)", 5, 1, "never opened"),
        ("exp", 0, 3, "is a function"),
        ("max(1)", 0, 3, "takes 2 arguments, not 1"),
        ("exp(1, 2)", 0, 3, "takes 1 argument, not 2"),
        ("sinh(1)", 0, 4, "there is no function `sinh`"),
        ("2**3", 1, 2, "a power is written with ^"),
        ("1.2.3", 0, 5, "this is no number"),
        ("1e999", 0, 5, "this is no number"),
        ("p % 2", 2, 1, "`%` has no meaning"),
        ("µ*2", 0, 1, "`µ` has no meaning"),
        ("", 0, 1, "missing at the end"),
        ("from_tip", 0, 8, "wear_factor cannot use `from_tip`"),
        ("import(p)", 0, 6, "there is no function `import`"),
    ] {
        match Formula::new(Hook::WearFactor, text, &[]) {
            Err(FormulaError::Expression(error)) => {
                assert_eq!(
                    (error.column, error.length),
                    (column, length),
                    "{text}: {error}"
                );
                assert!(error.message.contains(message), "{text}: {error}");
            }
            other => panic!("{text}: {other:?}"),
        }
    }
    // a load factor knows no pressure yet
    assert!(refusal(Hook::LoadFactor, "1 + p/1000", &[]).contains("before the contact is solved"));
    assert!(refusal(Hook::Profile, "cycles", &[]).contains("profile cannot use `cycles`"));
    let deep = format!("{}1{}", "(".repeat(500), ")".repeat(500));
    assert!(refusal(Hook::WearFactor, &deep, &[]).contains("nesting deeper"));
    assert!(refusal(Hook::WearFactor, &"1+".repeat(4000), &[]).contains("longer than"));
}

#[test]
fn parameters_have_names_of_their_own_and_are_used() {
    for (name, reason) in [
        ("p", "one of the variables"),
        ("exp", "a function"),
        ("pi", "a function or constant"),
        ("2a", "letters, digits"),
        ("", "letters, digits"),
        ("a-b", "letters, digits"),
    ] {
        assert!(
            refusal(Hook::WearFactor, "1", &[name]).contains(reason),
            "{name}"
        );
    }
    assert!(refusal(Hook::WearFactor, "a", &["a", "a"]).contains("twice"));
    assert_eq!(
        refusal(Hook::WearFactor, "1 + a", &["a", "b"]),
        "the expression does not use the parameter `b`"
    );
    assert!(refusal(Hook::Operation, "1", &[]).contains("cannot give added_centre_distance"));
    // `e` is no constant, so it may be a parameter
    let formula = Formula::new(Hook::WearFactor, "e*2", &["e"]).unwrap();
    assert_eq!(formula.build(&[3.0]).wear_factor(&ordinary()), 6.0);
}

#[test]
fn what_is_not_finite_or_has_the_wrong_sign_is_a_fault() {
    for (hook, text) in [
        (Hook::WearFactor, "1/(cycles - 250000)"),
        (Hook::WearFactor, "ln(s)"),
        (Hook::WearFactor, "s"),
        (Hook::WearFactor, "exp(cycles)"),
        (Hook::AddedDepth, "-depth"),
        (Hook::LoadFactor, "0*s"),
        (Hook::Profile, "1/(radius - 28.5)"),
    ] {
        let effect = Formula::new(hook, text, &[]).unwrap().build(&[]);
        assert_eq!(effect.fault(), None);
        let value = match hook {
            Hook::WearFactor => effect.wear_factor(&ordinary()),
            Hook::AddedDepth => effect.added_depth(&ordinary()),
            Hook::LoadFactor => effect.load_factor(&ordinary()),
            _ => effect.profile(&profile()),
        };
        assert_eq!(value, hook.neutral(), "{text}");
        let fault = effect.fault().unwrap();
        assert!(
            fault.starts_with(&format!("{} = {text} gives ", hook.name())),
            "{fault}"
        );
    }
    let effect = Formula::new(Hook::WearFactor, "1/(cycles - 250000)", &[])
        .unwrap()
        .build(&[]);
    effect.wear_factor(&ordinary());
    assert_eq!(
        effect.fault().unwrap(),
        "wear_factor = 1/(cycles - 250000) gives inf at cycles = 250000; allowed: a number from 0 on"
    );
}
