//! The contact models side by side, and which assumption makes each difference.
//!
//! ```text
//! paper ─► hertz ─► fem        two ladders; each rung replaces one assumption and is a model of its own
//! ```
//!
//! | rung | replaced | by |
//! |---|---|---|
//! | angle update | wear changes the profile angle | it does not |
//! | gear speed | printed speed of the gear | speed from the tooth numbers |
//! | dwell | a point is rubbed on the way from the pitch point to it | while the contact passes it |
//! | grid | 50 points without the tip | 2001 points with the tip |
//! | contact width | contact in a point | Hertz pressure over its width |
//! | load share | equal parts of the load | springs of the teeth, then finite elements |
//! | tip contact | contact on the line of action only | tip corners touch outside it too |
//! | pressure shape | Hertz ellipse | pressure of the elastic flanks, their ends included |
//! | feedback | pressures of the unworn flanks | pressures follow the wear |
//! | friction | none | Coulomb, where the study asks for it |
//!
//! The sum of all rungs is the difference of the two models, by construction; what is not trivial is that both ends are the
//! models themselves: the first state of the first ladder is `paper::run`, the last of the second a whole wear history by
//! finite elements. The order of the rungs matters where two assumptions act on each other; the corrections of the
//! published model are therefore also given one at a time ([`Mounted::alone`]).

mod curves;
mod data;
mod elastic;
mod ladder;
mod prescribed;
mod published;

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

pub use data::{
    Alone, Cause, Comparison, ContactCurve, Difference, Flank, Kind, Ladder, LeftOut, Means,
    ModelResult, Mounted, Quantity, RegionDifference, Rung, SingleContact, Span,
};
pub use prescribed::Prescribed;

use crate::gear::Pair;
use crate::mesh::Mesh;
use crate::simulate::forward::{Conditions, ForwardError, GearSet};
use crate::simulate::gather;
use crate::simulate::members::Members;
use crate::simulate::numerics::Numerics;
use crate::simulate::paper_run;

/// What is to be compared.
#[derive(Debug)]
pub struct Task<'a> {
    /// The gears.
    pub set: &'a GearSet,
    /// Conditions; their misalignment is not used.
    pub conditions: Conditions,
    /// Resolution.
    pub numerics: Numerics,
    /// Radial misalignments, mm.
    pub misalignments: &'a [f64],
    /// The user's own meshes of pinion and gear, if there are any.
    pub own: [Option<Mesh>; 2],
}

/// Called with how much is done (0 to 1) and what comes next, from any thread.
pub type Watch<'a> = &'a (dyn Fn(f64, &'static str) + Sync);

/// Compares the models.
///
/// Misalignments at which the pair cannot run are left out with the reason, and so is the published model where its rules
/// do not reach.
///
/// # Errors
/// [`ForwardError`] if the pair runs but a member cannot be built or contact cannot be solved.
pub fn compare(task: Task, watch: Watch) -> Result<Comparison, ForwardError> {
    let Task {
        set, conditions, ..
    } = task;
    let mut pairs: Vec<(f64, Pair)> = Vec::new();
    let mut left_out = Vec::new();
    for &misalignment in task.misalignments {
        match set.mount(misalignment) {
            Ok(pair) => pairs.push((misalignment, pair)),
            Err(error) => left_out.push(LeftOut {
                misalignment,
                reason: error.to_string(),
            }),
        }
    }
    let mut mounted = Vec::new();
    if !pairs.is_empty() {
        watch(0.0, "mesh, factor and condense both gears");
        let runnable: Vec<f64> = pairs
            .iter()
            .map(|(misalignment, _)| *misalignment)
            .collect();
        let members = set.members_on(&task.numerics, &[conditions.torque], &runnable, task.own)?;
        let stages = Stages::new(watch, pairs.len());
        mounted = pairs
            .par_iter()
            .map(|(misalignment, pair)| {
                let conditions = Conditions {
                    misalignment: *misalignment,
                    ..conditions
                };
                at(set, &members, pair, conditions, task.numerics, &stages)
            })
            .collect::<Result<_, _>>()?;
    }
    let printed = published::gear_speed_as_printed(&paper_run::inputs(set, &conditions));
    Ok(Comparison {
        conditions,
        teeth: set.gears.each_ref().map(|gear| gear.spec.teeth),
        face_width: set.face_width,
        printed_gear_speed: printed,
        edges_per_half_width: task.numerics.elements_per_half_width,
        mounted,
        left_out,
    })
}

/// All models at one centre distance.
fn at(
    set: &GearSet,
    members: &Members,
    pair: &Pair,
    conditions: Conditions,
    numerics: Numerics,
    stages: &Stages,
) -> Result<Mounted, ForwardError> {
    let spans = curves::spans(pair);
    let (mut models, mut ladders, mut alone) = (Vec::new(), Vec::new(), Vec::new());
    let mut absent = None;
    stages.next("the published model");
    let published = published::run(set, &conditions, pair);
    stages.next("contact of the unworn flanks");
    let elastic = elastic::run(set, members, conditions, numerics, stages)?;
    let single = curves::single_contact(&elastic.fem.contact, pair, set.modulus());
    match published {
        Ok(published) => {
            alone = published.alone(&spans);
            let steps: Vec<_> = published
                .steps
                .into_iter()
                .chain(elastic.to_hertz)
                .collect();
            ladders.push(ladder::climb(&published.model, &steps, Kind::Hertz, &spans));
            models.push(published.model);
        }
        Err(reason) => absent = Some(reason.to_string()),
    }
    ladders.push(ladder::climb(
        &elastic.hertz,
        &elastic.to_fem,
        Kind::Fem,
        &spans,
    ));
    models.extend([elastic.hertz, elastic.fem]);
    Ok(Mounted {
        misalignment: conditions.misalignment,
        geometry: gather::geometry(pair, set.face_width, 0.0),
        single,
        differences: ladder::differences(&models, &spans),
        spans,
        models,
        absent,
        ladders,
        alone,
    })
}

/// Counts stages over all threads.
struct Stages<'a> {
    watch: Watch<'a>,
    begun: AtomicUsize,
    all: usize,
}

/// Stages of one misalignment.
const STAGES: usize = 4;

impl<'a> Stages<'a> {
    fn new(watch: Watch<'a>, mounted: usize) -> Self {
        Self {
            watch,
            begun: AtomicUsize::new(0),
            all: STAGES * mounted + 1,
        }
    }

    fn next(&self, name: &'static str) {
        let begun = self.begun.fetch_add(1, Ordering::Relaxed) + 1;
        (self.watch)(begun as f64 / (self.all + 1) as f64, name);
    }
}
