//! What cannot be solved is an error that says where, never a result. The library's steps are driven with a contact model made
//! to fail; the program with wear that no mesh can follow.
//!
//! Tolerance: none.
use std::sync::Mutex;

use gearwear::contact::cycle::{Cycle, CycleSpec, Stations};
use gearwear::contact::fem::{CycleCompliance, FemContact};
use gearwear::contact::model::{ContactError, ContactModel, PositionContact};
use gearwear::contact::slices::Flanks;
use gearwear::contact::tangent::LinearContact;
use gearwear::simulate::forward::Forward;
use gearwear::simulate::history::{Balancing, WearLaw, wear_until};
use gearwear::simulate::run::Plan;
use gearwear::study::Study;
use gearwear::wear::archard::WearError;
use gearwear::wear::integrator::StepError;
use nalgebra::DMatrix;

use super::home::{Home, study_with};

#[test]
fn wear_that_no_mesh_can_follow_ends_with_the_cycles_reached() {
    let home = Home::with(&[("coefficient", "2e-6")]);
    let answer = home.gearwear("run study.toml -o run");
    assert_eq!((answer.code, answer.out.as_str()), (Some(1), ""));
    for part in [
        "error: ",
        " of 50000 cycles; the steps up to there are kept for --resume)",
    ] {
        assert!(answer.err.contains(part), "{part}: {}", answer.err);
    }
    assert_eq!(home.tree(), [".run.checkpoint", "study.toml"]);
    // what was kept leads to the same end
    let again = home.gearwear("run study.toml -o run --resume");
    let error = |err: &str| err[err.find("error: ").unwrap()..].to_owned();
    assert_eq!(
        (again.code, error(&again.err)),
        (Some(1), error(&answer.err))
    );
    assert_eq!(home.tree(), [".run.checkpoint", "study.toml"]);
}

/// Corners that were left out as too far apart come into reach of a load that turns the teeth farther.
#[test]
fn a_corner_that_was_not_looked_at_is_no_result() {
    let study = Study::parse(&study_with(&[]), "study.toml").unwrap();
    let set = study.gear_set();
    let numerics = study.resolution();
    let torque = study.operation.simulated(&study.wear).torque;
    let members = set.members(&numerics, &[torque], &[0.0]).unwrap();
    let pair = set.mount(0.0).unwrap();
    let per_width = torque / set.face_width;
    let spec = CycleSpec {
        reach: 1e-6,
        ..numerics.cycle(&pair, set.modulus(), per_width, members.spacing())
    };
    let stations = Stations::new(&pair, members.spacing());
    let cycle = Cycle::new(&pair, &stations, spec);
    let compliance = CycleCompliance::new(&cycle, members.flanks(), 0.0).unwrap();
    let model = FemContact::new(&cycle, &compliance, per_width);
    let fresh = [0, 1].map(|side| vec![0.0; stations.arc[side].len()]);
    let errors = (0..cycle.positions.len())
        .filter_map(|q| model.solve(q, [&fresh[0], &fresh[1]], &[]).err());
    let errors: Vec<ContactError> = errors.collect();
    assert!(!errors.is_empty());
    for error in errors {
        assert!(
            matches!(error, ContactError::OutOfReach { separation, .. } if separation > 1e-6),
            "{error}"
        );
    }
}

/// The centre distance in the reason is none that the study states, so what made it is said.
#[test]
fn gears_that_effects_take_out_of_mesh_are_an_error_that_says_so() {
    let home = Home::with(&[]);
    let effect = "\n[[effect]]\nkind = \"radial_misalignment\"\namount = 1.9\n";
    home.write("study.toml", &(study_with(&[]) + effect));
    let answer = home.gearwear("run study.toml -o run");
    assert_eq!(answer.code, Some(1), "{}", answer.err);
    let said = "the study's effects move the axes 1900 µm farther from each other than it states: contact ratio is ";
    assert!(answer.err.contains(said), "{}", answer.err);
    assert_eq!(home.tree(), ["study.toml"]);
}

#[test]
fn a_tolerance_that_cannot_be_held_is_an_error() {
    // a model whose pressures jump with every look at them, and less error allowed than the jump leaves in the least step
    let strict = WearLaw {
        tolerance: 1e-15,
        ..LAW
    };
    let set = study().gear_set();
    let (conditions, numerics) = (
        study().operation.simulated(&study().wear),
        study().resolution(),
    );
    let forward = Forward::new(&set, None, conditions, numerics).unwrap();
    let error = forward
        .with_model(|model| {
            let jumpy = Doctored {
                model,
                calls: Mutex::new(0),
                fault: |calls, contact| {
                    let factor = if calls % 2 == 0 { 1.0 } else { 4.0 };
                    contact.pressure.iter_mut().for_each(|p| *p *= factor);
                    Ok(())
                },
            };
            let mut progress = None;
            wear_until(&jumpy, strict, &mut progress, 1e5, &mut |_| true).unwrap_err()
        })
        .unwrap();
    let StepError::TooSmall { n, step, error } = error else {
        panic!("{error}")
    };
    assert!(
        n < 1e5 && step < 1.0 && (error > 1.0 || error.is_nan()),
        "{n}, {step}, {error}"
    );
}

#[test]
fn contact_that_fails_at_one_position_stops_the_wear_there() {
    let set = study().gear_set();
    let (conditions, numerics) = (
        study().operation.simulated(&study().wear),
        study().resolution(),
    );
    let forward = Forward::new(&set, None, conditions, numerics).unwrap();
    let positions = forward.cycle().positions.len();
    forward.with_model(|model| {
        // sound for three looks at all positions, then one of them fails
        let doctored = Doctored {
            model,
            calls: Mutex::new(0),
            fault: |calls, _| {
                if calls > 3 * 30 {
                    Err(ContactError::WindowTooNarrow {
                        theta: 0.25,
                        window: 0.0,
                    })
                } else {
                    Ok(())
                }
            },
        };
        assert_eq!(positions, 30);
        let mut progress = None;
        let mut steps = Vec::new();
        let error = wear_until(&doctored, LAW, &mut progress, 1e5, &mut |progress| {
            steps.push(progress.clone());
            true
        })
        .unwrap_err();
        let StepError::System { n, source } = error else {
            panic!("{error}")
        };
        assert!(
            source.to_string().contains("mesh position 0.25"),
            "{source}"
        );
        assert!(matches!(source, WearError::Contact(ContactError::WindowTooNarrow { theta, .. }) if theta == 0.25));
        assert!(n < 1e5);
        let kept = progress.expect("the start is kept");
        assert_eq!(kept.stand.n, steps.last().map_or(0.0, |p| p.stand.n));
        if let Some(last) = steps.last() {
            assert_eq!(&kept, last, "the last accepted step, whole");
        }
    }).unwrap();
}

/// Not a number from a contact model must not pass as a wear rate.
#[test]
fn pressures_that_are_no_numbers_are_an_error() {
    let set = study().gear_set();
    let (conditions, numerics) = (
        study().operation.simulated(&study().wear),
        study().resolution(),
    );
    let forward = Forward::new(&set, None, conditions, numerics).unwrap();
    forward
        .with_model(|model| {
            let doctored = Doctored {
                model,
                calls: Mutex::new(0),
                fault: |calls, contact| {
                    if calls > 2 * 30
                        && let Some(&k) = contact.active.first()
                    {
                        contact.pressure[k] = f64::INFINITY;
                    }
                    Ok(())
                },
            };
            let mut progress = None;
            let outcome = wear_until(&doctored, LAW, &mut progress, 1e5, &mut |_| true);
            assert!(
                matches!(outcome, Err(StepError::TooSmall { .. })),
                "{outcome:?}"
            );
            let kept = progress.expect("the start is kept");
            assert!(kept.stand.u.iter().all(|h| h.is_finite()));
        })
        .unwrap();
}

/// An observer that cannot keep a checkpoint ends the run, with its own words.
#[test]
fn a_checkpoint_that_cannot_be_kept_ends_the_run() {
    use gearwear::simulate::checkpoint::Checkpoint;
    use gearwear::simulate::run::{Event, Observer, RunError, run};
    struct Full;
    impl Observer for Full {
        fn event(&mut self, _: Event) -> bool {
            true
        }
        fn keep(&mut self, checkpoint: &Checkpoint) -> Result<(), String> {
            match checkpoint.stored.len() {
                0 | 1 => Ok(()),
                _ => Err("no space left on device".to_owned()),
            }
        }
    }
    struct Impatient(usize);
    impl Observer for Impatient {
        fn event(&mut self, event: Event) -> bool {
            if matches!(event, Event::Step { .. }) {
                self.0 += 1;
            }
            self.0 < 4
        }
        fn keep(&mut self, _: &Checkpoint) -> Result<(), String> {
            Ok(())
        }
    }
    let study = study();
    let set = study.gear_set();
    let plan = Plan {
        acting: None,
        effects: &[],
        title: "",
        test: None,
        set: &set,
        conditions: study.operation.simulated(&study.wear),
        numerics: study.resolution(),
        kind: gearwear::simulate::forward::ContactKind::Hertz,
        stored_states: 2,
        drawn_positions: 0,
        surroundings: study.surroundings(&study.operation),
        root_stress: true,
    };
    let error = run(&plan, None, None, &mut Full).unwrap_err();
    assert!(
        matches!(&error, RunError::Keep(said) if said == "no space left on device"),
        "{error}"
    );
    let error = run(&plan, None, None, &mut Impatient(0)).unwrap_err();
    assert!(
        matches!(error, RunError::Stopped { cycles } if cycles > 0.0 && cycles < 50_000.0),
        "{error}"
    );
}

const LAW: WearLaw<'static> = WearLaw {
    coefficient: [6e-10; 2],
    acting: None,
    tolerance: 2e-3,
    floor: gearwear::simulate::numerics::STEP_FLOOR,
    balance: Balancing::History,
};

fn study() -> Study {
    Study::parse(&study_with(&[("contact", "\"hertz\"")]), "study.toml").unwrap()
}

/// A sound contact model behind one that fails.
struct Doctored<'a> {
    model: &'a dyn ContactModel,
    calls: Mutex<usize>,
    /// Given the number of contact problems solved so far and the last one's solution.
    fault: fn(usize, &mut PositionContact) -> Result<(), ContactError>,
}

impl ContactModel for Doctored<'_> {
    fn cycle(&self) -> &Cycle {
        self.model.cycle()
    }

    fn solve_flanks(
        &self,
        q: usize,
        flanks: &Flanks<'_>,
        start: &[usize],
    ) -> Result<PositionContact, ContactError> {
        let mut contact = self.model.solve_flanks(q, flanks, start)?;
        let mut calls = self.calls.lock().unwrap();
        *calls += 1;
        (self.fault)(*calls, &mut contact)?;
        Ok(contact)
    }

    fn sensitivity(
        &self,
        q: usize,
        contact: &PositionContact,
    ) -> Result<Option<DMatrix<f64>>, ContactError> {
        self.model.sensitivity(q, contact)
    }

    fn linearised<'m>(
        &'m self,
        q: usize,
        contact: &PositionContact,
        flanks: &Flanks<'_>,
    ) -> Result<Box<dyn LinearContact + 'm>, ContactError> {
        self.model.linearised(q, contact, flanks)
    }
}

/// Each revolution takes the same area off a flank, so more wear than there is tooth is known after the first steps.
#[test]
fn more_wear_than_tooth_is_told_at_once() {
    let home = Home::with(&[("cycles", "6e9")]);
    let answer = home.gearwear("run study.toml -o out");
    assert_eq!(answer.code, Some(1), "{}", answer.err);
    for part in [
        "6e9 cycles would wear",
        "off each tooth of the pinion",
        "mm deep on average",
        "cycles wear a tenth of the tooth",
    ] {
        assert!(answer.err.contains(part), "no `{part}` in {}", answer.err);
    }
    // what it says can be run: about 1e7 cycles here
    let words: Vec<&str> = answer.err.split_whitespace().collect();
    let about = words.iter().position(|word| *word == "about").unwrap();
    let cycles: f64 = words[about + 1].parse().unwrap();
    assert!((1e6..1e8).contains(&cycles), "{cycles}");
    assert!(!home.path("out").exists());
    assert!(
        home.tree().iter().all(|name| name == "study.toml"),
        "{:?}",
        home.tree()
    );
}
