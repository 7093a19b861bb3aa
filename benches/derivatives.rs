//! What a wear history costs that carries its derivatives, by how many parameters it has them: `cargo bench --bench derivatives`. The ratio to the
//! history without any (0) is the figure; on one thread (`RAYON_NUM_THREADS=1`) it is that of processor time.
//!
//! The paper's pair over 300 000 cycles at the tolerance of fits. Derivatives are those of one law's parameters, taken in turn.

use std::sync::LazyLock;

use divan::Bencher;
use gearwear::effects::{Card, Combined, Surroundings, find};
use gearwear::simulate::forward::{Conditions, Forward, GearSet, Variation};
use gearwear::simulate::history::HistoryTangents;
use gearwear::simulate::members::Members;
use gearwear::simulate::numerics::Numerics;
use gearwear::study::Study;
use gearwear::wear::acting::Acting;

const LAWS: [&str; 3] = ["running_in", "film_thickness", "tip_relief"];
const PARAMETERS: [usize; 3] = [0, 1, 5];
/// How far a law's parameter is moved to ask it for its derivative, relative.
const STEP: f64 = 1e-7;

const CONDITIONS: Conditions = Conditions {
    torque: 1e5,
    speed: 2000.0,
    misalignment: 0.0,
    cycles: 3e5,
    coefficient: [6e-10; 2],
};

static SET: LazyLock<GearSet> = LazyLock::new(|| {
    let study = include_str!("../validation/paper/study.toml");
    let study = Study::parse(study, "study.toml").expect("the paper's study");
    study.gear_set()
});

fn main() {
    faer::set_global_parallelism(faer::Par::Seq);
    divan::main();
}

fn numerics() -> Numerics {
    Numerics {
        step_tolerance: 4e-3,
        condense_after: 0.1,
        room: 1.4,
        ..Numerics::default()
    }
}

fn acting(card: &Card, values: &[f64]) -> Acting {
    let mut effects = Combined::default();
    effects.push(card.hook, (card.build)(values));
    Acting {
        effects,
        surroundings: Surroundings {
            contact_modulus: 115_385.0,
            viscosity_pa_s: Some(0.015),
            pressure_viscosity_per_gpa: Some(18.0),
            roughness_um: Some(0.5),
            friction_coefficient: Some(0.06),
            contact_coefficient: Some(13_000.0),
            bulk_temperature_c: Some(60.0),
            flank_temperature_c: Some(60.0),
        },
        torque: 100.0,
        speed: 2000.0,
        reversed: false,
        face_width: 33.0,
    }
}

fn history(bencher: Bencher, members: Option<&Members>, law: &str, parameters: usize) {
    let card = find(law).expect("an effect of the catalogue");
    let values = card.defaults();
    let base = acting(card, &values);
    let variation = |i: usize| {
        let mut values = values.clone();
        let step = STEP * values[i % 2];
        values[i % 2] += step;
        Variation {
            coefficient: [0.0; 2],
            effects: Some(acting(card, &values)),
            step,
        }
    };
    let variations: Vec<Variation> = (0..parameters).map(variation).collect();
    let template = Forward::new(&SET, members, CONDITIONS, numerics()).expect("the gears run");
    bencher.bench_local(|| {
        let mut forward = (template.again(CONDITIONS.coefficient, Some(&base)))
            .expect("the effect leaves the gears in mesh");
        let (mut progress, mut tangents) = (None, HistoryTangents::default());
        let with = (variations.as_slice(), &mut tangents);
        forward
            .wear_with_tangents(&mut progress, CONDITIONS.cycles, with, &mut |_, _, _| true)
            .expect("mild wear converges");
        (progress, tangents)
    });
}

#[divan::bench(args = LAWS, consts = PARAMETERS, sample_count = 5, sample_size = 1)]
fn fem<const N: usize>(bencher: Bencher, law: &str) {
    let members = SET
        .members(&numerics(), &[CONDITIONS.torque], &[0.0])
        .expect("the reference pair can be meshed");
    history(bencher, Some(&members), law, N);
}

#[divan::bench(args = LAWS, consts = PARAMETERS, sample_count = 20, sample_size = 1)]
fn hertz<const N: usize>(bencher: Bencher, law: &str) {
    history(bencher, None, law, N);
}
