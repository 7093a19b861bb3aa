//! The catalogue as a whole: nothing missing, nothing said that the code does not do.

use std::fs;
use std::path::Path;

use gearwear::effects::formula::{FUNCTIONS, Formula};
use gearwear::effects::variables::{self, VARIABLES};
use gearwear::effects::{
    CATALOGUE, Card, Combined, Effect, EffectError, Hook, Local, OperationChange, OperationState,
    Prior, ProfileAt, Tooth, find,
};
use gearwear::gear::Member;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use super::places::{any_operation, any_profile, anywhere, operation, ordinary, profile};
use super::{close, effect, same};

fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(20),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

#[test]
fn every_file_is_listed_and_every_name_has_a_file() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/effects/laws");
    let mut files: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .filter(|name| name != "mod")
        .collect();
    files.sort();
    let mut listed: Vec<&str> = CATALOGUE.iter().map(|card| card.name).collect();
    listed.sort_unstable();
    assert_eq!(files, listed);
}

#[test]
fn names_that_outside_files_use() {
    let expected: [(&str, &[(&str, f64)]); 5] = [
        ("running_in", &[("amplitude", 3.0), ("decay_cycles", 2e5)]),
        (
            "pressure_exponent",
            &[("exponent", 1.5), ("reference_pressure", 1000.0)],
        ),
        ("film_thickness", &[("lambda0", 0.4), ("exponent", 3.4)]),
        (
            "micropitting",
            &[
                ("rate", 5.0),
                ("exponent", 6.0),
                ("reference_pressure", 1000.0),
                ("lambda_c", f64::INFINITY),
                ("asymmetry", 0.0),
            ],
        ),
        ("tip_relief", &[("amount", 9.0), ("length", 3.0)]),
    ];
    for (name, parameters) in expected {
        find(name).unwrap().values(parameters).unwrap();
    }
    let default = |name: &str, parameter: &str| {
        let card = find(name).unwrap();
        card.params[card.place(parameter).unwrap()].default
    };
    assert_eq!(default("pressure_exponent", "reference_pressure"), 1000.0);
    assert_eq!(default("micropitting", "reference_pressure"), 1000.0);
    assert_eq!(default("micropitting", "lambda_c"), f64::INFINITY);
    assert_eq!(default("micropitting", "asymmetry"), 0.0);
    for name in [
        "p",
        "p_max",
        "v_slide",
        "v_roll",
        "cycles",
        "depth",
        "radius",
        "s",
        "approach",
        "film_ratio",
        "flash_temperature",
        "line_load",
        "torque",
        "speed",
        "pinion",
    ] {
        assert!(
            variables::find(name).is_some_and(|v| v.available(Hook::WearFactor)),
            "{name}"
        );
    }
}

#[test]
fn cards_are_complete() {
    for card in CATALOGUE {
        let name = card.name;
        for text in [
            card.source,
            card.signature,
            card.separated_by,
            card.left_out,
            card.formula,
        ] {
            assert!(text.len() > 10 && !text.contains('\n'), "{name}: {text:?}");
        }
        let first = card.signature.split(';').next().unwrap();
        assert!(first.chars().count() <= 76, "{name}: {first}");
        assert!(
            card.formula
                .starts_with(&format!("{} = ", card.hook.name())),
            "{name}"
        );
        assert!(card.params.iter().any(|p| p.neutral.is_some()), "{name}");
        assert!(card.params.iter().any(|p| p.fitted), "{name}");
        for other in card.confounded_with {
            assert!(find(other).is_ok() && *other != name, "{name}: {other}");
        }
        for (place, param) in card.params.iter().enumerate() {
            let at = format!("{name}.{}", param.name);
            assert!(!param.unit.is_empty() && param.meaning.len() > 5, "{at}");
            let (least, most) = param.range;
            assert!(least < most, "{at}");
            assert!((least..=most).contains(&param.default), "{at}");
            assert!((least..=most).contains(&param.prior.median()), "{at}");
            assert!(param.accepts(param.default), "{at}");
            assert_eq!(card.place(param.name), Ok(place), "{at}");
            assert!(
                variables::find(param.name).is_none(),
                "{at} is also a variable"
            );
            assert!(!FUNCTIONS.iter().any(|(f, ..)| *f == param.name), "{at}");
            if param.fitted {
                let spread = match param.prior {
                    Prior::LogNormal { median, spread } => [median / spread, median * spread],
                    Prior::Normal { mean, sd } => [mean - sd, mean + sd],
                    Prior::HalfNormal { sd } => [0.0, sd],
                    Prior::Uniform { low, high } => [low, high],
                };
                assert!(
                    least <= spread[0] && spread[1] <= most,
                    "{at}: the prior leaves the range"
                );
            }
        }
        for form in card.forms {
            card.values(form.settings).unwrap();
            for name in form.frees.iter().chain(form.idle) {
                let known = card.params.iter().find(|param| param.name == *name);
                let freed = form.frees.contains(name);
                assert_eq!(known.map(|param| param.fitted), Some(!freed), "{name}");
            }
            // places are joined to what the own form fits: the freed parameters stand behind all of these
            if let Some(place) = form.grown.first() {
                assert!(form.grown.iter().all(|other| other.len() == place.len()));
                let last: Vec<&str> = card.params.iter().map(|p| p.name).collect();
                assert_eq!(last[last.len() - place.len()..], *form.frees);
                assert!(form.idle.is_empty());
            }
        }
    }
}

/// What each formula uses stands in `needs`; two effects use a film or a temperature only when the user asks for it.
#[test]
fn needs_follow_from_the_formulas() {
    let known = [
        "lubricant.viscosity",
        "lubricant.pressure_viscosity",
        "lubricant.roughness",
        "lubricant.friction_coefficient",
        "thermal.bulk_temperature",
        "thermal.conductivity",
        "thermal.specific_heat",
    ];
    for card in CATALOGUE {
        let mut stated = card.needs.to_vec();
        stated.sort_unstable();
        assert!(
            stated.iter().all(|need| known.contains(need)),
            "{}",
            card.name
        );
        let used = card.compiled().unwrap().0.needs();
        if ["micropitting", "thermal_expansion"].contains(&card.name) {
            assert!(stated.is_empty() && !used.is_empty());
        } else {
            assert_eq!(stated, used, "{}", card.name);
        }
    }
}

#[test]
fn unknown_names_and_values_are_refused_with_the_way_out() {
    assert_eq!(
        find("runing_in").unwrap_err().to_string(),
        "there is no effect `runing_in`; the nearest is `running_in`"
    );
    let card = find("running_in").unwrap();
    assert_eq!(
        card.values(&[("amplitud", 1.0)]).unwrap_err().to_string(),
        "running_in has no parameter `amplitud`; the nearest is `amplitude`"
    );
    assert!(matches!(
        card.values(&[("amplitude", -1.0)]),
        Err(EffectError::OutOfRange {
            parameter: "amplitude",
            ..
        })
    ));
    assert!(card.values(&[("amplitude", f64::NAN)]).is_err());
    // a neutral value is allowed though it lies outside the range
    let film = find("film_thickness").unwrap();
    assert!(film.params[0].range.1.is_finite());
    assert!(film.values(&[("lambda0", f64::INFINITY)]).is_ok());
}

/// All hooks' values, as bits.
fn bits(effect: &dyn Effect, at: &Local, on: &ProfileAt, of: &OperationState) -> Vec<u64> {
    let mut values = vec![
        effect.wear_factor(at),
        effect.added_depth(at),
        effect.load_factor(at),
        effect.profile(on),
        effect.operation(of).centre_distance,
        effect.compliance(),
        effect.friction(at),
    ];
    let teeth = (0..7).flat_map(|number| {
        Member::BOTH.map(|member| Tooth {
            member,
            number,
            of: 7,
        })
    });
    values.extend(teeth.map(|tooth| effect.tooth_offset(tooth)));
    values.into_iter().map(f64::to_bits).collect()
}

fn hook_value(
    effect: &dyn Effect,
    hook: Hook,
    at: &Local,
    on: &ProfileAt,
    of: &OperationState,
) -> f64 {
    match hook {
        Hook::WearFactor => effect.wear_factor(at),
        Hook::AddedDepth => effect.added_depth(at),
        Hook::LoadFactor => effect.load_factor(at),
        Hook::Profile => effect.profile(on),
        Hook::ToothOffset => effect.tooth_offset(Tooth {
            member: Member::Pinion,
            number: 0,
            of: 27,
        }),
        Hook::Operation => effect.operation(of).centre_distance,
        Hook::Compliance => effect.compliance(),
        Hook::Friction => effect.friction(at),
    }
}

/// Of any card.
const MOST_PARAMETERS: usize = 12;

struct Nothing;
impl Effect for Nothing {}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn neutral_values_change_no_bit(at in anywhere(), on in any_profile(), of in any_operation()) {
        let base = bits(&Nothing, &at, &on, &of);
        prop_assert_eq!(&base[..7], &[1f64, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0].map(f64::to_bits)[..]);
        for card in CATALOGUE {
            let neutral = (card.build)(&card.neutral());
            prop_assert_eq!(bits(neutral.as_ref(), &at, &on, &of), base.clone(), "{}", card.name);
        }
    }

    #[test]
    fn only_the_stated_hook_acts(at in anywhere(), on in any_profile(), of in any_operation()) {
        for card in CATALOGUE {
            let acting = (card.build)(&card.defaults());
            for hook in Hook::ALL {
                if hook != card.hook {
                    let value = hook_value(acting.as_ref(), hook, &at, &on, &of);
                    prop_assert_eq!(value, hook.neutral(), "{} {:?}", card.name, hook);
                }
            }
            prop_assert_eq!(acting.fault(), None);
        }
    }

    /// Any parameters within their ranges, any place.
    #[test]
    fn hooks_are_finite(
        at in anywhere(), on in any_profile(), of in any_operation(),
        shares in proptest::collection::vec(prop_oneof![2 => 0.0..=1.0f64, 1 => Just(0.0), 1 => Just(1.0)], MOST_PARAMETERS),
    ) {
        for card in CATALOGUE {
            prop_assert!(card.params.len() <= MOST_PARAMETERS);
            let values: Vec<f64> = card.params.iter().zip(&shares).map(|(param, share)| {
                let (least, most) = param.range;
                if most.is_infinite() {
                    return if *share == 1.0 { most } else { least.max(1e-3) * 1e6f64.powf(*share) };
                }
                least + share * (most - least)
            }).collect();
            let effect = (card.build)(&values);
            let value = hook_value(effect.as_ref(), card.hook, &at, &on, &of);
            prop_assert!(value.is_finite(), "{} {:?} gives {}", card.name, values, value);
            match card.hook {
                Hook::WearFactor | Hook::AddedDepth | Hook::Friction => prop_assert!(value >= 0.0, "{} {:?} gives {}", card.name, values, value),
                Hook::LoadFactor => prop_assert!(value > 0.0, "{} {:?} gives {}", card.name, values, value),
                _ => {}
            }
        }
    }

    /// The formula on the card, evaluated as a user's formula would be, against the code.
    #[test]
    fn printed_formulas_are_the_code(
        at in anywhere(), on in any_profile(), of in any_operation(), share in 0.0..1.0f64,
    ) {
        for card in CATALOGUE {
            let mut values = card.defaults();
            let (formula, places) = card.compiled().unwrap();
            for &place in &places {
                let (least, most) = card.params[place].range;
                if most.is_finite() {
                    values[place] += share * 0.2 * (most - values[place]).min(values[place] - least);
                }
            }
            let taken: Vec<f64> = places.iter().map(|&place| values[place]).collect();
            let printed = match card.hook {
                // no formula of a user's acts there: evaluated as one of the flank is
                Hook::ToothOffset | Hook::Compliance => {
                    let names: Vec<&str> = places.iter().map(|&at| card.params[at].name).collect();
                    let of_flank = Formula::new(Hook::Profile, card.expression(), &names).unwrap();
                    hook_value(of_flank.build(&taken).as_ref(), Hook::Profile, &at, &on, &of)
                }
                hook => hook_value(formula.build(&taken).as_ref(), hook, &at, &on, &of),
            };
            let coded = hook_value((card.build)(&values).as_ref(), card.hook, &at, &on, &of);
            let scale = coded.abs().max(hook_scale(card));
            prop_assert!((printed - coded).abs() <= 1e-9 * scale, "{}: {} printed, {} coded", card.name, printed, coded);
        }
    }
}

/// Sums whose terms cancel are known to this times the rounding only.
fn hook_scale(card: &Card) -> f64 {
    match card.hook {
        Hook::WearFactor | Hook::LoadFactor => 1.0,
        Hook::Profile | Hook::ToothOffset => 10.0,
        Hook::Operation => 0.1,
        Hook::AddedDepth | Hook::Compliance => 1e-9,
        Hook::Friction => 0.01,
    }
}

#[test]
fn every_effect_does_something_at_its_defaults() {
    let mut at = ordinary();
    at.contacts = 1000.0;
    for card in CATALOGUE {
        let effect = (card.build)(&card.defaults());
        let value = hook_value(effect.as_ref(), card.hook, &at, &profile(), &operation());
        assert!((value - card.hook.neutral()).abs() > 1e-10, "{}", card.name);
    }
}

#[test]
fn priors_are_densities() {
    let integral = |prior: Prior, low: f64, high: f64| {
        let n = 200_000;
        let step = (high - low) / f64::from(n);
        (0..n)
            .map(|i| prior.log_density(low + (f64::from(i) + 0.5) * step).exp() * step)
            .sum::<f64>()
    };
    let log_normal = Prior::LogNormal {
        median: 3.0,
        spread: 2.5,
    };
    close(integral(log_normal, 0.0, 3.0), 0.5, 1e-6);
    // one standard deviation up: Φ(1)
    close(integral(log_normal, 0.0, 7.5), 0.841_344_746, 1e-6);
    let normal = Prior::Normal { mean: 1.0, sd: 0.5 };
    close(integral(normal, -5.0, 1.5), 0.841_344_746, 1e-6);
    let half = Prior::HalfNormal { sd: 2.0 };
    close(integral(half, 0.0, half.median()), 0.5, 1e-6);
    close(integral(half, 0.0, 30.0), 1.0, 1e-6);
    assert_eq!(half.log_density(-1e-9), f64::NEG_INFINITY);
    let uniform = Prior::Uniform {
        low: 0.5,
        high: 3.0,
    };
    close(integral(uniform, 0.0, 4.0), 1.0, 1e-4);
    assert_eq!(log_normal.log_density(0.0), f64::NEG_INFINITY);
}

#[test]
fn variables_have_one_name_each() {
    for (place, variable) in VARIABLES.iter().enumerate() {
        assert!(
            VARIABLES[..place]
                .iter()
                .all(|other| other.name != variable.name)
        );
        assert!(!variable.unit.is_empty() && !variable.meaning.is_empty());
        assert!(
            Hook::ALL.iter().any(|hook| variable.available(*hook)),
            "{}",
            variable.name
        );
    }
}

#[test]
fn together_factors_multiply_and_depths_add() {
    let mut all = Combined::default();
    assert!(all.is_empty() && !all.acts(Hook::WearFactor));
    for name in [
        "running_in",
        "member_hardness",
        "corrosive_loss",
        "plastic_deformation",
        "tip_relief",
        "radial_misalignment",
        "bearing_compliance",
    ] {
        let card = find(name).unwrap();
        all.push(card.hook, (card.build)(&card.defaults()));
    }
    assert_eq!(all.len(), 7);
    assert!(all.acts(Hook::WearFactor) && !all.acts(Hook::LoadFactor));
    let mut at = ordinary();
    at.contacts = 1000.0;
    same(
        all.wear_factor(&at),
        effect("running_in", &[]).wear_factor(&at)
            * effect("member_hardness", &[]).wear_factor(&at),
    );
    let [removed, displaced] = all.added_depths(&at);
    assert_eq!(removed, effect("corrosive_loss", &[]).added_depth(&at));
    assert_eq!(
        displaced,
        effect("plastic_deformation", &[]).added_depth(&at)
    );
    assert_eq!(all.added_depth(&at), removed + displaced);
    assert_eq!(
        all.profile(&profile()),
        effect("tip_relief", &[]).profile(&profile())
    );
    let OperationChange { centre_distance } = all.operation(&operation());
    same(
        centre_distance,
        0.1 + effect("bearing_compliance", &[])
            .operation(&operation())
            .centre_distance,
    );
    assert_eq!(all.load_factor(&at), 1.0);
    assert_eq!(all.fault(), None);
    let broken = Formula::new(Hook::WearFactor, "1/(cycles - 250000)", &[]).unwrap();
    all.push(Hook::WearFactor, broken.build(&[]));
    all.wear_factor(&at);
    assert!(all.fault().is_some());
}

/// By the printed formulas: what counts cycles, hours or the worn volume and looks at no place, load or speed.
#[test]
fn three_effects_change_k_over_time_alone() {
    let names = CATALOGUE
        .iter()
        .filter(|card| card.changes_k_over_time_alone())
        .map(|card| card.name);
    let mut names: Vec<&str> = names.collect();
    names.sort_unstable();
    assert_eq!(names, ["debris_abrasion", "lubricant_ageing", "running_in"]);
}
