//! What a run spends its time on, stage by stage, on the reference pair (module 2, 27/53 teeth, 100 N·m on 33 mm) with quadratic
//! triangles: `cargo bench`, or one stage with `cargo bench -- contact`.
//!
//! ```text
//! mesh        both gears meshed                                        fineness = flank edges per Hertz half width
//! factor      one gear factored and condensed onto its flanks          (5 is the default of a study)
//! cycle       geometry of the mesh cycle; compliance projected on it
//! contact     all positions of one mesh cycle solved, from nothing and from the contact sets of flanks half as worn;
//!             and each position alone, from the sets of the step before: the median over them all
//! wear        one accepted wear step on flanks worn for 20 000 cycles
//! fields      displacement and stress of both members at one position
//! whole       50 000 cycles with everything above, and the same by the analytic model
//! ```
//! Left out on purpose: reading studies, writing files and pages (milliseconds beside these). Compare ratios measured on one
//! machine, never times of two.

use std::sync::LazyLock;

use divan::{Bencher, black_box};
use gearwear::contact::cycle::{Cycle, Stations};
use gearwear::contact::fem::CycleCompliance;
use gearwear::contact::model::{ContactModel, PositionContact};
use gearwear::gear::{BasicRack, Gear, ToothSpec};
use gearwear::material::Elastic;
use gearwear::simulate::checkpoint::Checkpoint;
use gearwear::simulate::forward::{Conditions, ContactKind, Forward, GearSet};
use gearwear::simulate::gather;
use gearwear::simulate::history::{Balancing, Progress, WearLaw, wear_until};
use gearwear::simulate::members::{Member, Members};
use gearwear::simulate::numerics::Numerics;
use gearwear::simulate::run::{Event, Observer, Plan, run};

const FINENESS: [usize; 2] = [3, 5];

fn main() {
    // as the program itself: parallel over bodies and positions, not inside a matrix
    faer::set_global_parallelism(faer::Par::Seq);
    divan::main();
}

static SET: LazyLock<GearSet> = LazyLock::new(|| {
    let rack = BasicRack {
        module: 2.0,
        pressure_angle: 20f64.to_radians(),
        addendum: 1.0,
        dedendum: 1.25,
        fillet_radius: 0.38,
    };
    let gear = |teeth, bore| Gear::new(rack, ToothSpec::plain(teeth, bore)).expect("a plain gear");
    let steel = Elastic {
        youngs_modulus: 2.1e5,
        poisson_ratio: 0.3,
    };
    GearSet {
        gears: [gear(27, 25.0), gear(53, 40.0)],
        materials: [steel; 2],
        densities: [7850.0; 2],
        centre_distance: 80.0,
        face_width: 33.0,
        face: gearwear::gear::Face::default(),
        teeth: gearwear::gear::Teeth::default(),
    }
});

const CONDITIONS: Conditions = Conditions {
    torque: 100e3,
    speed: 2000.0,
    misalignment: 0.0,
    cycles: 50_000.0,
    coefficient: [6e-10; 2],
};

fn numerics(fineness: usize) -> Numerics {
    Numerics {
        elements_per_half_width: fineness as f64,
        ..Numerics::default()
    }
}

fn members(fineness: usize) -> Members {
    SET.members(&numerics(fineness), &[CONDITIONS.torque], &[0.0])
        .expect("the reference pair can be meshed")
}

fn forward<'a>(members: &'a Members, fineness: usize) -> Forward<'a> {
    Forward::new(&SET, Some(members), CONDITIONS, numerics(fineness)).expect("the gears run")
}

/// A wear history until `cycles`.
fn worn(forward: &mut Forward, cycles: f64) -> Progress {
    let mut progress = None;
    forward
        .wear_to(&mut progress, cycles, &mut |_, _| true)
        .expect("mild wear converges");
    progress.expect("a state was reached")
}

#[divan::bench(args = FINENESS, max_time = 4)]
fn mesh(bencher: Bencher, fineness: usize) {
    let numerics = numerics(fineness);
    bencher.bench(|| SET.meshes(&numerics, &[CONDITIONS.torque], &[0.0], [None, None]));
}

#[divan::bench(args = FINENESS, max_time = 4)]
fn factor(bencher: Bencher, fineness: usize) {
    let [_, gear] = SET
        .meshes(
            &numerics(fineness),
            &[CONDITIONS.torque],
            &[0.0],
            [None, None],
        )
        .expect("the reference pair can be meshed");
    bencher
        .with_inputs(|| gear.clone())
        .bench_values(|mesh| Member::from_mesh(mesh, SET.materials[1]).map(|m| m.body.dof_count()));
}

mod cycle {
    use super::*;

    #[divan::bench(args = FINENESS, max_time = 4)]
    fn geometry(bencher: Bencher, fineness: usize) {
        let numerics = numerics(fineness);
        let pair = SET.mount(0.0).expect("the gears run");
        let torque = CONDITIONS.torque / SET.face_width;
        let spacing = numerics.flank_spacing(&pair, SET.modulus(), torque);
        let spec = numerics.cycle(&pair, SET.modulus(), torque, spacing);
        let stations = Stations::new(&pair, spacing);
        bencher.bench(|| Cycle::new(&pair, &stations, spec));
    }

    #[divan::bench(args = FINENESS, max_time = 4)]
    fn compliance(bencher: Bencher, fineness: usize) {
        let members = members(fineness);
        let forward = forward(&members, fineness);
        bencher.bench(|| CycleCompliance::new(forward.cycle(), members.flanks(), 0.0));
    }
}

mod contact {
    use super::*;

    fn all(
        model: &dyn ContactModel,
        depth: [&[f64]; 2],
        start: impl Fn(usize) -> Vec<usize>,
    ) -> Vec<PositionContact> {
        (0..model.cycle().positions.len())
            .map(|q| {
                model
                    .solve(q, depth, &start(q))
                    .expect("mild contact is solved")
            })
            .collect()
    }

    fn solve(bencher: Bencher, fineness: usize, warm: bool) {
        let members = members(fineness);
        let mut forward = forward(&members, fineness);
        let progress = worn(&mut forward, 20_000.0);
        let (pinion, gear) = progress
            .stand
            .u
            .split_at(forward.cycle().stations.arc[0].len());
        forward
            .with_model(|model| {
                let half = |flank: &[f64]| flank.iter().map(|h| 0.5 * h).collect::<Vec<f64>>();
                let earlier = all(model, [&half(pinion), &half(gear)], |_| Vec::new());
                let start = |q: usize| {
                    if warm {
                        earlier[q].active.clone()
                    } else {
                        Vec::new()
                    }
                };
                bencher.bench_local(|| all(model, [pinion, gear], start));
            })
            .expect("the contact is prepared");
    }

    #[divan::bench(args = FINENESS, max_time = 4)]
    fn cold(bencher: Bencher, fineness: usize) {
        solve(bencher, fineness, false);
    }

    /// One sample a position, over and over, each from the contact set that it had one wear step earlier.
    #[divan::bench(args = FINENESS, max_time = 4, sample_size = 1, sample_count = 20_000)]
    fn warm_one_position(bencher: Bencher, fineness: usize) {
        let members = members(fineness);
        let mut forward = forward(&members, fineness);
        let before = worn(&mut forward, 20_000.0);
        let law = WearLaw {
            coefficient: CONDITIONS.coefficient,
            acting: None,
            tolerance: numerics(fineness).step_tolerance,
            floor: gearwear::simulate::numerics::STEP_FLOOR,
            balance: Balancing::History,
        };
        forward
            .with_model(|model| {
                let mut after = Some(before.clone());
                wear_until(model, law, &mut after, 1e9, &mut |_| false)
                    .expect("a step is accepted");
                let after = after.expect("a step was taken");
                let flanks = |progress: &Progress| {
                    let (pinion, gear) = progress
                        .stand
                        .u
                        .split_at(model.cycle().stations.arc[0].len());
                    [pinion.to_vec(), gear.to_vec()]
                };
                let ([pinion, gear], [next_pinion, next_gear]) = (flanks(&before), flanks(&after));
                let earlier = all(model, [&pinion, &gear], |_| Vec::new());
                let mut q = 0;
                bencher
                    .with_inputs(|| {
                        q = (q + 1) % earlier.len();
                        q
                    })
                    .bench_local_values(|q| {
                        model.solve(q, [&next_pinion, &next_gear], &earlier[q].active)
                    });
            })
            .expect("the contact is prepared");
    }

    #[divan::bench(args = FINENESS, max_time = 4)]
    fn warm(bencher: Bencher, fineness: usize) {
        solve(bencher, fineness, true);
    }
}

#[divan::bench(args = FINENESS, max_time = 4)]
fn wear(bencher: Bencher, fineness: usize) {
    let members = members(fineness);
    let mut forward = forward(&members, fineness);
    let start = worn(&mut forward, 20_000.0);
    let law = WearLaw {
        coefficient: CONDITIONS.coefficient,
        acting: None,
        tolerance: numerics(fineness).step_tolerance,
        floor: gearwear::simulate::numerics::STEP_FLOOR,
        balance: Balancing::History,
    };
    forward
        .with_model(|model| {
            bencher
                .with_inputs(|| Some(start.clone()))
                .bench_local_values(|mut progress| {
                    let outcome = wear_until(model, law, &mut progress, 1e9, &mut |_| false);
                    (outcome.expect("a step is accepted"), progress)
                });
        })
        .expect("the contact is prepared");
}

#[divan::bench(args = FINENESS, max_time = 4)]
fn fields(bencher: Bencher, fineness: usize) {
    let members = members(fineness);
    let mut forward = forward(&members, fineness);
    let progress = worn(&mut forward, 20_000.0);
    let state = forward.state(&progress).expect("mild contact is solved");
    let drawn = gather::drawn(&forward, &state)
        .expect("a mild state is drawn")
        .expect("there are meshes");
    bencher.bench(|| gather::frame(&forward, &state, &drawn, 1.0, black_box(0)));
}

mod whole {
    use super::*;

    struct Silent;

    impl Observer for Silent {
        fn event(&mut self, _: Event) -> bool {
            true
        }
        fn keep(&mut self, _: &Checkpoint) -> Result<(), String> {
            Ok(())
        }
    }

    fn whole(bencher: Bencher, fineness: usize, kind: ContactKind) {
        let plan = Plan {
            acting: None,
            effects: &[],
            title: "",
            test: None,
            set: &SET,
            conditions: CONDITIONS,
            numerics: numerics(fineness),
            kind,
            stored_states: 5,
            drawn_positions: 4,
            surroundings: Default::default(),
            root_stress: true,
        };
        bencher.bench(|| {
            run(&plan, None, None, &mut Silent)
                .expect("the reference pair runs")
                .states
                .len()
        });
    }

    #[divan::bench(args = FINENESS, sample_count = 3, sample_size = 1)]
    fn fem(bencher: Bencher, fineness: usize) {
        whole(bencher, fineness, ContactKind::Fem);
    }

    #[divan::bench(args = FINENESS, max_time = 4)]
    fn hertz(bencher: Bencher, fineness: usize) {
        whole(bencher, fineness, ContactKind::Hertz);
    }
}
