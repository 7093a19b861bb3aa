//! Wear histories: from fresh flanks to the requested cycles, with the balance of worn area at every step.

use crate::contact::model::ContactModel;
use crate::simulate::balance::Balance;
use crate::simulate::wear_state::{split, worn_area};
use crate::wear::acting::Acting;
use crate::wear::archard::{ArchardSystem, AreaRate, WearError};
use crate::wear::integrator::{Stand, Step, StepControl, StepError, WearSystem, advance};
use crate::wear::tangent::{Differentiated, Direction};

/// What an observer gets after each accepted wear step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepReport<'a> {
    /// Where the integration stands.
    pub stand: &'a Stand,
    /// Worn area so far.
    pub balance: Balance,
    /// Largest depth on pinion and gear, mm.
    pub max_depth: [f64; 2],
    /// Contact problems solved so far.
    pub solves: usize,
}

/// A wear history in progress: everything a resumed run needs besides the model.
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Progress {
    /// The integrator's state.
    pub stand: Stand,
    /// Worn areas so far.
    pub balance: Balance,
    /// Rate of worn area by the law at the last step's end, mm² per cycle.
    rate: AreaRate,
    /// Area that effects displaced so far, mm².
    displaced: [f64; 2],
    /// Contact problems solved so far.
    pub solves: usize,
    /// Largest depth on pinion and gear, mm.
    pub max_depth: [f64; 2],
    /// Contact sets of the last solution, so that a resumed run walks the same way.
    warm: Vec<Vec<usize>>,
}

impl Progress {
    /// What an observer gets of it.
    pub fn report(&self) -> StepReport<'_> {
        StepReport {
            stand: &self.stand,
            balance: self.balance,
            max_depth: self.max_depth,
            solves: self.solves,
        }
    }

    /// Area that effects displaced without loss of mass, per tooth of pinion and gear, mm².
    pub fn displaced(&self) -> [f64; 2] {
        self.displaced
    }

    /// Forgets the contact sets: their numbering has changed.
    pub fn forget_sets(&mut self) {
        self.warm.clear();
    }
}

/// Archard wear coefficients, effects and step control of a history.
#[derive(Clone, Copy)]
pub struct WearLaw<'a> {
    /// Wear coefficient of pinion and gear, mm²/N.
    pub coefficient: [f64; 2],
    /// Physical effects on the law.
    pub acting: Option<&'a Acting>,
    /// Allowed step error relative to the largest depth.
    pub tolerance: f64,
    /// How the worn area is held against the line loads.
    pub balance: Balancing,
}

/// How the worn area is held against what the line loads wear off.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Balancing {
    /// It is not integrated from the line loads: [`Balance::law`] and [`Progress::displaced`] stay 0.
    Off,
    /// A step that is off is taken again, shorter.
    Steps,
    /// The same, and steps that would add to a difference that stands already are to be better the larger it is. Of a contact that is not
    /// solved (Hertz) a part of the difference is its own, at any length of step.
    History,
}

/// A shorter step was taken in vain if it is farther off than this share of the longer one: errors of a step fall at least in proportion to
/// it.
const IN_VAIN: f64 = 0.85;

/// So many shorter steps are taken in vain; a corner that comes into contact within the step is left behind by then.
const MOST_IN_VAIN: usize = 4;

/// Attempts at a step that were refused for their worn area.
#[derive(Debug, Clone, Copy)]
struct Refused {
    /// How far off the last one was.
    off: f64,
    in_vain: usize,
    /// Length of the first one, cycles.
    longest: f64,
}

/// Depth below which the step tolerance is absolute, modules.
const DEPTH_FLOOR: f64 = 5e-5;

/// Depth above which the step tolerance is absolute where areas are balanced over the history, modules: what the teeth give and how
/// contacts pass over worn flanks does not grow with the depth, and in proportion to it steps of a flank worn by a fifth of its tooth left
/// areas by law and geometry 1.5 % apart. (In a fit's analytic histories, which try any coefficient, it made hundreds of thousands of steps.)
const DEPTH_CEILING: f64 = 0.05;

/// The deepest place grows by more than this in every step, modules.
const LEAST_GROWTH: f64 = 1e-11;

impl WearLaw<'_> {
    fn control(&self, module: f64, rate: &[f64]) -> StepControl {
        // the first step wears a tenth of the floor where the flank wears fastest
        let fastest = rate.iter().fold(f64::MIN_POSITIVE, |m, r| m.max(*r));
        StepControl {
            tolerance: self.tolerance,
            floor: DEPTH_FLOOR * module,
            ceiling: match self.balance {
                Balancing::History => DEPTH_CEILING * module,
                Balancing::Off | Balancing::Steps => f64::INFINITY,
            },
            first_step: 0.1 * DEPTH_FLOOR * module / fastest,
            // corners that come into contact refuse a step much longer than those before, again and again; the steps of single runs, whose
            // areas are balanced too, stay as they were validated
            hesitates: self.balance == Balancing::Off,
            least_growth: LEAST_GROWTH * module,
        }
    }
}

/// Derivatives of a history where it stands, by parameter.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct HistoryTangents {
    /// Of the depths at the stations of pinion and gear, mm per unit.
    pub depth: Vec<Vec<f64>>,
    /// Of [`Progress::displaced`], mm² per unit.
    pub displaced: Vec<[f64; 2]>,
    /// Of its rate at the last step's end.
    displaced_rate: Vec<[f64; 2]>,
}

impl HistoryTangents {
    /// Of a state read between steps.
    pub fn read(depth: Vec<Vec<f64>>, displaced: Vec<[f64; 2]>) -> Self {
        Self {
            depth,
            displaced,
            displaced_rate: Vec::new(),
        }
    }

    /// Of fresh flanks with so many stations, by so many parameters.
    fn fresh(parameters: usize, stations: usize) -> Self {
        Self {
            depth: vec![vec![0.0; stations]; parameters],
            displaced: vec![[0.0; 2]; parameters],
            displaced_rate: vec![[0.0; 2]; parameters],
        }
    }

    /// Takes the derivatives over a step that ended with the depths `u` at `n` cycles; `displaces`: whether an effect displaces material.
    fn follow<M: ContactModel + ?Sized>(
        &mut self,
        system: &mut Differentiated<'_, '_, M>,
        step: &Step,
        (n, u): (f64, &[f64]),
        displaces: bool,
    ) -> Result<(), WearError> {
        step.follow(system, &mut self.depth)?;
        if displaces {
            let rates = system.displaced_tangents(n, u, &self.depth)?;
            let before = std::mem::replace(&mut self.displaced_rate, rates);
            let rates = before.iter().zip(&self.displaced_rate);
            for (displaced, (before, after)) in self.displaced.iter_mut().zip(rates) {
                for side in 0..2 {
                    displaced[side] += 0.5 * step.length() * (before[side] + after[side]);
                }
            }
        }
        Ok(())
    }
}

/// Integrates wear under `model` from `progress` (or fresh flanks) to `end` cycles; `observe` sees every step and may stop
/// the run by returning false.
///
/// # Errors
/// [`StepError`] with the cycles reached; `progress` then holds the last accepted step.
pub fn wear_until<M: ContactModel + ?Sized>(
    model: &M,
    law: WearLaw<'_>,
    progress: &mut Option<Progress>,
    end: f64,
    observe: &mut dyn FnMut(&Progress) -> bool,
) -> Result<bool, StepError<WearError>> {
    let mut none = HistoryTangents::default();
    wear_with_tangents(model, law, progress, end, (&[], &mut none), &mut |p, _| {
        observe(p)
    })
}

/// As [`wear_until`], with the derivatives along each of the directions (empty: those of fresh flanks), which `observe` sees too.
///
/// # Errors
/// As [`wear_until`].
pub fn wear_with_tangents<M: ContactModel + ?Sized>(
    model: &M,
    law: WearLaw<'_>,
    progress: &mut Option<Progress>,
    end: f64,
    (directions, tangents): (&[Direction<'_>], &mut HistoryTangents),
    observe: &mut dyn FnMut(&Progress, &HistoryTangents) -> bool,
) -> Result<bool, StepError<WearError>> {
    let cycle = model.cycle();
    let module = cycle.pair.pinion.rack.module;
    let mut system = ArchardSystem::new(model, law.coefficient).with(law.acting);
    let area_rate = |system: &mut ArchardSystem<'_, M>, n, u: &[f64]| {
        if law.balance != Balancing::Off {
            system.area_rate(n, u)
        } else {
            Ok(AreaRate::default())
        }
    };
    let fail = |source| StepError::System { n: 0.0, source };
    let control = match progress {
        Some(_) => law.control(module, &[]),
        None => {
            let fresh = vec![0.0; system.slices() * cycle.stations.count()];
            let control = law.control(module, &system.rate(0.0, &fresh).map_err(fail)?);
            let rate = area_rate(&mut system, 0.0, &fresh).map_err(fail)?;
            *progress = Some(Progress {
                stand: Stand::new(fresh, control),
                balance: Balance::default(),
                rate,
                displaced: [0.0; 2],
                solves: 0,
                max_depth: [0.0; 2],
                warm: Vec::new(),
            });
            control
        }
    };
    let progress = progress.as_mut().expect("filled above");
    let displaces = law.acting.is_some_and(|a| a.effects.displaces());
    if tangents.depth.is_empty() {
        *tangents = HistoryTangents::fresh(directions.len(), progress.stand.u.len());
        if displaces && !directions.is_empty() {
            let mut differentiated = Differentiated {
                system: &mut system,
                directions,
            };
            let (n, u) = (progress.stand.n, &progress.stand.u);
            tangents.displaced_rate = differentiated
                .displaced_tangents(n, u, &tangents.depth)
                .map_err(|source| StepError::System { n, source })?;
        }
    }
    let solves_before = progress.solves;
    system.start_from(&progress.warm);
    let mut refused: Option<Refused> = None;
    while progress.stand.n < end {
        // with the balance, a step counts only once the contact at its end is known too
        let mut stand = progress.stand.clone();
        let taken = advance(&mut system, &mut stand, end, control)?;
        let rate = area_rate(&mut system, stand.n, &stand.u)
            .map_err(|source| StepError::System { n: stand.n, source })?;
        let flanks = split(cycle, &stand.u);
        let step = stand.n - progress.stand.n;
        let mut balance = progress.balance;
        for (side, arc) in cycle.stations.arc.iter().enumerate() {
            balance.law[side] += 0.5 * step * (progress.rate.law[side] + rate.law[side]);
            balance.geometry[side] = system.mean(side, |slice| worn_area(arc, flanks[slice][side]));
        }
        // worn areas of a mean depth of one module
        let unit =
            (cycle.stations.arc.each_ref()).map(|arc| module * (arc[arc.len() - 1] - arc[0]));
        if law.balance != Balancing::Off {
            let drift = law.balance == Balancing::History;
            let off = balance.off(&progress.balance, unit, drift);
            let grown = (stand.u.iter().zip(&progress.stand.u))
                .any(|(now, then)| now - then > LEAST_GROWTH * module);
            let helps = refused.is_none_or(|before| off <= IN_VAIN * before.off);
            let in_vain = refused.map_or(0, |before| before.in_vain + usize::from(!helps));
            let longest = refused.map_or(step, |before| before.longest);
            // along given steps no error is too large
            let refuses = law.tolerance.is_finite();
            if refuses && off > 1.0 && grown && in_vain < MOST_IN_VAIN {
                progress.stand.step = step * (0.85 / off.sqrt()).clamp(0.2, 0.7);
                progress.stand.rejected += 1;
                refused = Some(Refused {
                    off,
                    in_vain,
                    longest,
                });
                continue;
            }
            if in_vain == MOST_IN_VAIN {
                // no matter of the step's length
                stand.step = stand.step.max(longest);
            } else if off > 0.5 {
                // the depth's own error would have it longer, and taken again
                stand.step = stand.step.min(step);
            }
        }
        let (solves, warm) = (system.solves, system.warm().to_vec());
        if !directions.is_empty() {
            let mut differentiated = Differentiated {
                system: &mut system,
                directions,
            };
            tangents
                .follow(&mut differentiated, &taken, (stand.n, &stand.u), displaces)
                .map_err(|source| StepError::System { n: stand.n, source })?;
        }
        // from here on nothing fails: a step counts whole or not at all
        refused = None;
        progress.balance = balance;
        for side in 0..2 {
            progress.displaced[side] +=
                0.5 * step * (progress.rate.displaced[side] + rate.displaced[side]);
        }
        progress.rate = rate;
        progress.solves = solves_before + solves;
        progress.warm = warm;
        progress.max_depth = [0, 1].map(|side| {
            let depths = flanks.iter().flat_map(|flanks| flanks[side]);
            depths.fold(0.0, |m: f64, h| m.max(*h))
        });
        progress.stand = stand;
        if !observe(progress, tangents) {
            return Ok(false);
        }
    }
    Ok(true)
}
