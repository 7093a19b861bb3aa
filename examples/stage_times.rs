//! Processor time of the stages of a run, one after another on one thread, with what they work on. `validation/times/times.py` puts it against the machine's limits.
//!
//! `cargo run --release --example stage_times [EDGES_PER_HALF_WIDTH [ORDER]]` (default 5 2): the published pair, one JSON document. Linux only: it reads the
//! thread's processor time from /proc.

use std::error::Error;
use std::fs::read_to_string;
use std::hint::black_box;
use std::sync::Mutex;

use gearwear::contact::cycle::{Cycle, Stations};
use gearwear::contact::fem::CycleCompliance;
use gearwear::fem::{Body, element_stiffness, elements, nodal_stress};
use gearwear::numeric::Vec2;
use gearwear::simulate::forward::Forward;
use gearwear::simulate::gather;
use gearwear::simulate::history::{Balancing, WearLaw, wear_until};
use gearwear::study::Study;
use serde_json::{Map, Value, json};

type Failure = Box<dyn Error + Send + Sync>;

/// A stage is repeated until so much processor time is spent on it; the system counts in steps of some milliseconds.
const SPENT: f64 = 1.0;

const WORN: f64 = 20_000.0;

#[expect(clippy::print_stdout, reason = "what it found")]
fn main() -> Result<(), Failure> {
    faer::set_global_parallelism(faer::Par::Seq);
    let mut words = std::env::args().skip(1);
    let edges = words.next().map_or(Ok(5.0), |text| text.parse())?;
    let order = words.next().map_or(Ok(2), |text| text.parse())?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    println!("{}", pool.install(|| stages(edges, order))?);
    Ok(())
}

/// Processor time of this thread, seconds.
fn spent() -> f64 {
    let text = read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds = text.split_whitespace().next().and_then(|n| n.parse().ok());
    1e-9 * nanoseconds.unwrap_or(f64::NAN)
}

/// Mean processor time of `work` on what `prepare` makes.
fn mean_of<T, U>(mut prepare: impl FnMut() -> T, mut work: impl FnMut(T) -> U) -> f64 {
    let (mut sum, mut times) = (0.0, 0);
    while times == 0 || sum < SPENT {
        let input = prepare();
        let begun = spent();
        black_box(work(input));
        sum += spent() - begun;
        times += 1;
    }
    sum / f64::from(times)
}

fn mean<U>(mut work: impl FnMut() -> U) -> f64 {
    mean_of(|| (), |()| work())
}

fn stages(edges: f64, order: usize) -> Result<Value, Failure> {
    let study = concat!(env!("CARGO_MANIFEST_DIR"), "/validation/paper/study.toml");
    let study = Study::load(study.as_ref())?;
    let set = study.gear_set();
    let mut numerics = study.resolution();
    numerics.elements_per_half_width = edges;
    numerics.order = order;
    let conditions = study.operation.simulated(&study.wear);
    let torques = [conditions.torque];

    let mut seconds = Map::new();
    let mut note = |name: &str, value: f64| {
        seconds.insert(name.to_owned(), json!(value));
    };

    note(
        "mesh",
        mean(|| set.meshes(&numerics, &torques, &[0.0], [None, None])),
    );
    let members = set.members(&numerics, &torques, &[0.0])?;
    let mut bodies = Vec::new();
    for member in &members.members {
        let body = &member.body;
        bodies.push(Body::new(
            body.mesh(),
            body.material(),
            &body.mesh().bore,
            body.interface(),
        )?);
    }
    let all = mean(|| {
        bodies
            .iter()
            .map(|b| Body::new(b.mesh(), b.material(), &b.mesh().bore, b.interface()))
            .collect::<Vec<_>>()
    });
    let stiffness = mean(|| {
        let mut trace = 0.0;
        for body in &bodies {
            for (number, element) in elements(body.mesh()).enumerate() {
                let matrix = element_stiffness(&element, body.material(), number);
                trace += matrix.map_or(0.0, |k| k[0][0]);
            }
        }
        trace
    });
    let meshes: Vec<_> = bodies.iter().map(|b| b.mesh().clone()).collect();
    let again = mean(|| {
        for (body, mesh) in bodies.iter_mut().zip(&meshes) {
            black_box(body.refactor(mesh)).ok();
        }
    });
    note("elimination order and pattern", all - again);
    note("element stiffness", stiffness);
    note("assembly and factorisation", again - stiffness);
    note(
        "compliance of the flanks",
        mean(|| bodies.iter().map(Body::compliance).collect::<Vec<_>>()),
    );

    let pair = set.mount(0.0)?;
    let torque = conditions.torque / set.face_width;
    let spacing = numerics.flank_spacing(&pair, set.modulus(), torque);
    let spec = numerics.cycle(&pair, set.modulus(), torque, spacing);
    let stations = Stations::new(&pair, spacing);
    note(
        "mesh cycle, geometry",
        mean(|| Cycle::new(&pair, &stations, spec)),
    );
    let mut forward = Forward::new(&set, Some(&members), conditions, numerics)?;
    note(
        "mesh cycle, compliance",
        mean(|| CycleCompliance::new(forward.cycle(), members.flanks(), 0.0)),
    );

    let mut worn = None;
    forward.wear_to(&mut worn, WORN, &mut |_, _| true)?;
    let worn = worn.ok_or("nothing was worn")?;
    let law = WearLaw {
        coefficient: conditions.coefficient,
        acting: None,
        tolerance: numerics.step_tolerance,
        floor: gearwear::simulate::numerics::STEP_FLOOR,
        balance: Balancing::History,
    };
    let count = forward.cycle().positions.len();
    let found = Mutex::new([f64::NAN; 2]);
    forward.with_model(|model| {
        let first = model.cycle().stations.arc[0].len();
        let (pinion, gear) = worn.stand.u.split_at(first);
        let cold = mean(|| {
            (0..count)
                .map(|q| model.solve(q, [pinion, gear], &[]).map_err(drop))
                .collect::<Vec<_>>()
        });
        let step = mean_of(
            || Some(worn.clone()),
            |mut progress| wear_until(model, law, &mut progress, 1e9, &mut |_| false).map_err(drop),
        );
        if let Ok(mut found) = found.lock() {
            *found = [cold, step];
        }
    })?;
    let [cold, step] = found.into_inner()?;
    note("contact at all positions, from nothing", cold);
    note("one wear step", step);
    let state = forward.state(&worn)?;
    note(
        "worn meshes of a state",
        mean(|| gather::drawn(&forward, &state)),
    );
    let drawn = gather::drawn(&forward, &state)?.ok_or("no meshes")?;
    note(
        "fields at one position",
        mean(|| gather::frame(&forward, &state, &drawn, 1.0, 0)),
    );
    let unit: Vec<_> = (bodies.iter())
        .map(|body| [(body.interface()[0], Vec2::new(1.0, 0.0))])
        .collect();
    note(
        "displacement under a load",
        mean(|| {
            (bodies.iter().zip(&unit))
                .map(|(body, load)| body.solve(load))
                .collect::<Vec<_>>()
        }),
    );
    let mut displaced = Vec::new();
    for (body, load) in bodies.iter().zip(&unit) {
        displaced.push(body.solve(load)?);
    }
    note(
        "stress at the nodes",
        mean(|| {
            (bodies.iter().zip(&displaced))
                .map(|(body, u)| nodal_stress(body.mesh(), body.material(), u))
                .collect::<Vec<_>>()
        }),
    );

    let sizes: Vec<Value> = bodies
        .iter()
        .map(|body| {
            json!({
                "unknowns": body.dof_count(), "elements": elements(body.mesh()).count(), "factor_values": body.factor_len(),
                "factor_operations": body.factor_operations(), "flank_unknowns": 2 * body.interface().len(),
            })
        })
        .collect();
    Ok(
        json!({"edges_per_half_width": edges, "positions": count, "bodies": sizes, "seconds": seconds}),
    )
}
