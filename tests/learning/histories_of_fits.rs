//! Claim: a fit's predictions, read off kept histories between steps and from one history for all wear coefficients, are those of
//! a run that ends where the measurement was taken.
//!
//! Source: the same model worn step by step to each checkpoint with a step tolerance twenty times finer. Tolerance: 0.4 % of the trace's
//! largest depth at the fits' own step tolerance of 2e-3, on a coarse mesh.

use std::path::Path;

use gearwear::effects::{CATALOGUE, find};
use gearwear::learn::{GearModel, Measured, Predictor};
use gearwear::measure::{Dataset, Quantity};
use gearwear::simulate::forward::{ContactKind, Forward, Preparation};
use gearwear::simulate::numerics::Numerics;
use gearwear::study::{EffectModel, EffectSpec, Study};

fn study() -> Study {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("validation/challenges/running_in_L1");
    Study::load(&folder.join("study.toml")).unwrap()
}

fn model_of(card: Option<&str>) -> EffectModel {
    let spec = card.map(|name| EffectSpec::of_card(find(name).unwrap(), &[]).unwrap());
    EffectModel::new(spec.into_iter().collect())
}

#[test]
fn kept_histories_give_what_a_run_to_the_checkpoint_gives() {
    let study = study();
    let measured = Measured::new(&study, study.dataset().unwrap());
    let workshop = measured.workshop(ContactKind::Hertz).unwrap();
    let bench = measured.bench(&workshop).unwrap();
    let coefficient = 1.7 * study.wear.coefficient;
    for name in [
        None,
        Some("running_in"),
        Some("pressure_exponent"),
        Some("micropitting"),
    ] {
        let effects = model_of(name);
        let model = GearModel::new(&bench, Box::new(|_| effects.stated()))
            .stretching(effects.stretches_time());
        let read = model.predict(0, coefficient, &[]).unwrap();
        // the same by a fine run that ends at the last checkpoint
        let test = &bench.tests[0];
        let acting = gearwear::wear::acting::Acting {
            effects: effects.stated(),
            surroundings: test.surroundings,
            torque: 1e-3 * test.conditions.torque,
            speed: test.conditions.speed,
            reversed: false,
            face_width: bench.set().face_width,
        };
        let conditions = gearwear::simulate::forward::Conditions {
            coefficient: [coefficient; 2],
            ..test.conditions
        };
        let numerics = Numerics {
            step_tolerance: 2e-4,
            ..study.resolution()
        };
        let set = study.gear_set();
        let mut forward =
            Forward::with_effects(&set, None, conditions, numerics, Some(&acting)).unwrap();
        let checkpoints: Vec<f64> = {
            let mut all: Vec<f64> = test.observations.iter().map(|o| o.cycles).collect();
            all.sort_by(f64::total_cmp);
            all.dedup();
            all
        };
        let mut progress = None;
        for cycles in checkpoints {
            forward
                .wear_to(&mut progress, cycles, &mut |_, _| true)
                .unwrap();
            let state = forward.state(progress.as_ref().unwrap()).unwrap();
            let deepest = 1e3
                * state
                    .depth
                    .iter()
                    .flatten()
                    .fold(0.0, |m: f64, h| m.max(*h));
            for (row, observation) in test.observations.iter().enumerate() {
                if observation.cycles != cycles || observation.quantity != Quantity::WearDepth {
                    continue;
                }
                let member = observation.member.member().unwrap();
                let gear = forward.cycle().pair.member(member);
                let side = gearwear::wear::acting::side(member);
                let arc = gear.arc(gear.rho_at_radius(observation.position.unwrap()));
                let stations = &forward.cycle().stations.arc[side];
                let at = stations
                    .partition_point(|s| *s <= arc)
                    .clamp(1, stations.len() - 1);
                let t = (arc - stations[at - 1]) / (stations[at] - stations[at - 1]);
                let depth = &state.depth[side];
                let run = 1e3 * ((1.0 - t) * depth[at - 1] + t * depth[at]);
                assert!(
                    (read[row] - run).abs() < 4e-3 * deepest,
                    "{name:?} at {cycles}: {} against {run}",
                    read[row]
                );
            }
        }
    }
}

/// Deep wear widens contacts and brings teeth together that were apart. What was prepared for that while a history wore must be there
/// when another coefficient's state is read off it.
#[test]
fn contacts_of_deep_wear_are_read_off_a_kept_history() {
    let text = std::fs::read_to_string(
        Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("validation/challenges/running_in_L1/study.toml"),
    )
    .unwrap();
    let coarse = "[numerics]\nelements_per_half_width = 3\npositions = 40\n";
    let study = Study::parse(&format!("{text}\n{coarse}"), "study.toml").unwrap();
    let rows = "test,member,cycles,quantity,position,value,sigma\n\
                A,pair,1e6,transmission_error,0.1,0,1\n\
                A,pair,1e6,transmission_error,0.6,0,1\n\
                A,pinion,1e6,contact_pressure,27.0,500,10\n";
    let data = Dataset::parse(rows, "m.csv", &study.known()).unwrap();
    let measured = Measured::new(&study, data);
    let workshop = measured.workshop(ContactKind::Fem).unwrap();
    let bench = measured.bench(&workshop).unwrap();
    let none = model_of(None);
    let model = || GearModel::new(&bench, Box::new(|_| none.stated())).stretching(true);
    let kept = model();
    let [deep, half] = [1.5e-9, 1.0e-9];
    let largest = kept.predict(0, deep, &[]).unwrap();
    let read = kept.predict(0, half, &[]).unwrap();
    let fresh = model().predict(0, half, &[]).unwrap();
    assert_ne!(largest, read);
    for (a, b) in read.iter().zip(&fresh) {
        assert!(
            (a - b).abs() < 2e-3 * b.abs().max(50.0),
            "{read:?} against {fresh:?}"
        );
    }
}

/// Where flanks wear too far for their elements, the members cannot be condensed anew. What was reached until then is read all the same.
#[test]
fn a_state_is_read_though_the_members_could_not_be_condensed_on_it() {
    let study = study();
    let set = study.gear_set();
    let numerics = Numerics {
        elements_per_half_width: 2.5,
        positions: 20,
        ..study.resolution()
    };
    let measured = Measured::new(&study, study.dataset().unwrap());
    let conditions = measured.tests()[0].conditions;
    let members = set
        .members(&numerics, &[conditions.torque], &[0.0])
        .unwrap();
    let mut forward = Forward::new(&set, Some(&members), conditions, numerics).unwrap();
    let stations = &forward.cycle().stations.arc;
    let unworn = vec![0.0; stations[0].len() + stations[1].len()];
    let before = forward.contacts_at(&unworn).unwrap();
    // deeper than a tooth is thick
    let too_deep = Preparation {
        condensed_at: Some(vec![5.0; unworn.len()]),
        ..forward.preparation()
    };
    forward.prepare(&too_deep).unwrap_err();
    let after = forward.contacts_at(&unworn).unwrap();
    for (a, b) in before.iter().zip(&after) {
        assert!((a.approach / b.approach - 1.0).abs() < 1e-9);
    }
}

/// An effect that is said to leave time alone must give the same by its own history and by a stretched one.
#[test]
fn only_laws_without_a_clock_share_a_history() {
    let study = study();
    let measured = Measured::new(&study, study.dataset().unwrap());
    let workshop = measured.workshop(ContactKind::Hertz).unwrap();
    let bench = measured.bench(&workshop).unwrap();
    let mut stretching = 0;
    for card in CATALOGUE {
        let effects = model_of(Some(card.name));
        if !effects.stretches_time() {
            continue;
        }
        stretching += 1;
        let predict = |stretches: bool| {
            GearModel::new(&bench, Box::new(|_| effects.stated()))
                .stretching(stretches)
                .predict(1, 1.5 * study.wear.coefficient, &[])
                .unwrap()
        };
        let (own, shared) = (predict(false), predict(true));
        let largest = own.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        for (a, b) in own.iter().zip(&shared) {
            assert!(
                (a - b).abs() < 4e-3 * largest,
                "{}: {a} against {b}",
                card.name
            );
        }
    }
    assert!(stretching > 15, "{stretching}");
    for clocked in [
        "running_in",
        "lubricant_ageing",
        "corrosive_loss",
        "micropitting",
    ] {
        assert!(!model_of(Some(clocked)).stretches_time(), "{clocked}");
    }
}
