//! The models with elastic teeth, and the rungs from equal load shares to the finite elements.

use super::Stages;
use super::curves::{Reading, State, flanks, spans};
use super::data::{Cause, ContactCurve, Kind, ModelResult};
use super::ladder::Step;
use super::prescribed::Prescribed;
use crate::contact::cycle::Cycle;
use crate::contact::fem::FemContact;
use crate::contact::frame::Touch;
use crate::contact::model::{ContactModel, PositionContact};
use crate::simulate::forward::{Conditions, Forward, ForwardError, GearSet};
use crate::simulate::members::Members;
use crate::simulate::numerics::Numerics;
use crate::simulate::wear_state::WearState;
use crate::wear::archard::ArchardSystem;
use crate::wear::integrator::WearSystem;

/// The two elastic models and what lies before, between and in them.
pub(super) struct Elastic {
    pub(super) hertz: ModelResult,
    pub(super) fem: ModelResult,
    /// From equal shares in a contact of no width to the Hertz model.
    pub(super) to_hertz: Vec<Step>,
    /// From the Hertz model to the finite elements.
    pub(super) to_fem: Vec<Step>,
}

/// The load shares of models without tip contact jump where a pair comes in, and a position stands for its
/// neighbourhood: they get as many times the mesh positions of the finite elements, whose shares are smooth.
const FINER: usize = 4;

/// Runs both models at `conditions`.
pub(super) fn run(
    set: &GearSet,
    members: &Members,
    conditions: Conditions,
    numerics: Numerics,
    stages: &Stages,
) -> Result<Elastic, ForwardError> {
    let smooth = Numerics {
        friction: 0.0,
        ..numerics
    };
    let mut forward = Forward::new(set, Some(members), conditions, smooth)?;
    // a history of no cycles: it finds out how far contact has to be looked for
    forward.wear_to(&mut None, 0.0, &mut |_, _| true)?;
    let unworn = Unworn::by_elements(&forward, conditions, set.modulus())?;

    stages.next("wear of the Hertz model");
    let by_hertz = ByHertz::new(set, conditions, smooth, members.spacing(), &unworn.held)?;

    stages.next("wear by finite elements");
    let mut fem = worn(&mut forward, Kind::Fem, conditions, None)?;
    let to_hertz = steps_to_hertz(&by_hertz);
    let mut to_fem = steps_to_fem(&by_hertz, unworn, &fem);
    let hertz = by_hertz.worn;
    if numerics.friction > 0.0 {
        let mut rough = Forward::new(set, Some(members), conditions, numerics)?;
        fem = worn(&mut rough, Kind::Fem, conditions, None)?;
        to_fem.push(Step {
            cause: Cause::Friction,
            replaced: "no friction",
            by: "the study's Coulomb friction in the contact",
            state: State::of(&fem),
        });
    }
    Ok(Elastic {
        hertz,
        fem,
        to_hertz,
        to_fem,
    })
}

/// The unworn flanks by finite elements, with more and more of the contact let in.
struct Unworn {
    /// All contact held to the line of action.
    held: State,
    /// Hertz's pressures with the load shares of the elements, tip corners outside the line of action among them.
    corners: State,
    /// Pressures of the elements.
    pressures: State,
}

impl Unworn {
    /// `modulus`: contact modulus of the pair, MPa.
    fn by_elements(
        forward: &Forward,
        conditions: Conditions,
        modulus: f64,
    ) -> Result<Self, ForwardError> {
        let (pressures, contacts) =
            forward.with_model(|fem| steady(fem, forward, conditions, None))??;
        let following = Prescribed::following(forward.cycle(), modulus, &contacts);
        let (corners, _) = steady(
            &following.with_corners(&contacts),
            forward,
            conditions,
            Some(modulus),
        )?;
        Ok(Self {
            held: on_line(forward, conditions)?,
            corners,
            pressures,
        })
    }
}

/// The Hertz model and its variants with other load shares.
struct ByHertz {
    /// Unworn flanks, equal shares of the pairs in contact.
    equal: State,
    /// Unworn flanks, shares by the springs of the teeth.
    springs: State,
    /// Unworn flanks, shares by finite elements.
    shares: State,
    /// The whole wear history.
    worn: ModelResult,
}

impl ByHertz {
    /// On stations `spacing` mm apart; `held`: the elements' contact whose load shares are taken over.
    fn new(
        set: &GearSet,
        conditions: Conditions,
        numerics: Numerics,
        spacing: f64,
        held: &State,
    ) -> Result<Self, ForwardError> {
        let modulus = set.modulus();
        let mut jumping = jumping(set, conditions, numerics, spacing)?;
        let cycle = jumping.cycle();
        let load = jumping.torque() / cycle.pair.pinion.base_radius;
        let steadily = |model: &dyn ContactModel| -> Result<State, ForwardError> {
            Ok(steady(model, &jumping, conditions, Some(modulus))?.0)
        };
        let equal = steadily(&Prescribed::equal(cycle, modulus, load))?;
        let springs = jumping.with_model(steadily)??;
        let spans = spans(&cycle.pair);
        let shares = steadily(&Prescribed::new(cycle, modulus, |pair| {
            load * held.load_share(&spans, pair.path)
        }))?;
        Ok(Self {
            equal,
            springs,
            shares,
            worn: worn(&mut jumping, Kind::Hertz, conditions, Some(modulus))?,
        })
    }
}

/// From equal shares in a contact of no width to the Hertz model.
fn steps_to_hertz(hertz: &ByHertz) -> Vec<Step> {
    vec![
        Step {
            cause: Cause::ContactWidth,
            replaced: "wear at the nominal contact point only",
            by: "Hertzian pressure over the width of the contact",
            state: hertz.equal.clone(),
        },
        Step {
            cause: Cause::LoadShare,
            replaced: "load shared equally between the pairs in contact",
            by: "load shared as by springs, one for each pair of teeth",
            state: hertz.springs.clone(),
        },
        Step {
            cause: Cause::Feedback,
            replaced: "load shares of the unworn flanks",
            by: "load shares updated as the flanks wear",
            state: State::of(&hertz.worn),
        },
    ]
}

/// From the Hertz model to the finite elements without friction.
fn steps_to_fem(hertz: &ByHertz, unworn: Unworn, fem: &ModelResult) -> Vec<Step> {
    vec![
        Step {
            cause: Cause::Feedback,
            replaced: "load shares of the Hertz model, updated as the flanks wear",
            by: "load shares of the unworn flanks",
            state: hertz.springs.clone(),
        },
        Step {
            cause: Cause::LoadShare,
            replaced: "load shared as by springs, one for each pair of teeth",
            by: "finite-element load shares, contact confined to the line of action",
            state: hertz.shares.clone(),
        },
        Step {
            cause: Cause::TipContact,
            replaced: "contact on the line of action only",
            by: "finite-element load shares, tip corners also touching off the line of action",
            state: unworn.corners,
        },
        Step {
            cause: Cause::PressureShape,
            replaced: "Hertzian pressure",
            by: "finite-element pressures, including those at the ends of the flanks",
            state: unworn.pressures,
        },
        Step {
            cause: Cause::Feedback,
            replaced: "pressures of the unworn flanks",
            by: "finite-element pressures, updated as the flanks wear",
            state: State::of(fem),
        },
    ]
}

/// The unworn flanks by finite elements with all contact held to the line of action.
fn on_line(forward: &Forward, conditions: Conditions) -> Result<State, ForwardError> {
    let held = held_to_line(forward.cycle());
    let state = match forward.compliance() {
        Some(compliance) => {
            let model = FemContact::new(&held, compliance, forward.torque());
            steady(&model, forward, conditions, None)?
        }
        None => forward.with_model(|model| steady(model, forward, conditions, None))??,
    };
    Ok(state.0)
}

/// The state of a model whose wear goes on for all cycles at the rate of the unworn flanks, and its contacts.
fn steady(
    model: &(impl ContactModel + ?Sized),
    forward: &Forward,
    conditions: Conditions,
    hertz: Option<f64>,
) -> Result<(State, Vec<PositionContact>), ForwardError> {
    let cycle = model.cycle();
    let fresh = vec![0.0; cycle.stations.count()];
    let mut system = ArchardSystem::new(model, conditions.coefficient);
    let depth: Vec<f64> = system
        .rate(0.0, &fresh)?
        .iter()
        .map(|r| r * conditions.cycles)
        .collect();
    let contacts = system.contacts(&fresh)?.to_vec();
    let (pinion, gear) = depth.split_at(cycle.stations.arc[0].len());
    let state = State {
        contact: curve(forward, cycle, &contacts, hertz),
        depth: flanks(cycle, [pinion, gear]).map(Some),
    };
    Ok((state, contacts))
}

/// How far pairs off the line of action are moved apart, mm: farther than any load closes.
const APART: f64 = 1.0;

/// The mesh cycle with all pairs off the line of action out of reach.
fn held_to_line(cycle: &Cycle) -> Cycle {
    let mut held = cycle.clone();
    for position in &mut held.positions {
        position.left_out = [f64::INFINITY; 2];
        for pair in position
            .pairs
            .iter()
            .filter(|p| p.frame.touch != Touch::Flanks)
        {
            for (gap, length) in position.gap[pair.offset..].iter_mut().zip(&pair.length) {
                *gap += APART * length;
            }
        }
    }
    held
}

/// The Hertz model at more mesh positions, on stations as fine as those of the finite elements.
fn jumping<'a>(
    set: &'a GearSet,
    conditions: Conditions,
    numerics: Numerics,
    spacing: f64,
) -> Result<Forward<'a>, ForwardError> {
    let pair = set.mount(conditions.misalignment)?;
    let coarse = numerics.flank_spacing(&pair, set.modulus(), conditions.torque / set.face_width);
    let numerics = Numerics {
        elements_per_half_width: numerics.elements_per_half_width * coarse / spacing,
        positions: FINER * numerics.positions,
        ..numerics
    };
    Forward::new(set, None, conditions, numerics)
}

/// The whole wear history of a model.
fn worn(
    forward: &mut Forward,
    kind: Kind,
    conditions: Conditions,
    hertz: Option<f64>,
) -> Result<ModelResult, ForwardError> {
    let mut progress = None;
    let mut wear_to = |forward: &mut Forward, cycles: f64| -> Result<WearState, ForwardError> {
        forward.wear_to(&mut progress, cycles, &mut |_, _| true)?;
        match &progress {
            Some(progress) => forward.state(progress),
            None => unreachable!("a history that did not fail has a progress"),
        }
    };
    let first = wear_to(forward, 0.0)?;
    let contact = curve(forward, forward.cycle(), &first.contacts, hertz);
    let end = wear_to(forward, conditions.cycles)?;
    let [pinion, gear] = flanks(forward.cycle(), [&end.depth[0], &end.depth[1]]);
    Ok(ModelResult {
        kind,
        contact,
        contact_end: curve(forward, forward.cycle(), &end.contacts, hertz),
        pinion,
        gear: Some(gear),
    })
}

/// Contacts of `cycle`, a variant of the forward model's own, as a curve.
fn curve(
    forward: &Forward,
    cycle: &Cycle,
    contacts: &[PositionContact],
    hertz: Option<f64>,
) -> ContactCurve {
    let reading = Reading {
        cycle,
        moment: &|q, index, contact| forward.moment(q, index, contact),
        torque: forward.torque(),
        hertz,
    };
    reading.curve(contacts)
}
