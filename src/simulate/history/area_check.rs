//! Whether a step has worn off the area that the line loads say, and how long the next one is to be.

use super::steps::Trial;
use super::{Balancing, LEAST_GROWTH, Progress, WearLaw};
use crate::contact::cycle::Cycle;

/// A shorter step was taken in vain if it is farther off than this share of the longer one: errors of a step fall at least in proportion to
/// it.
const IN_VAIN: f64 = 0.85;

/// So many shorter steps are taken in vain; a corner that comes into contact within the step is left behind by then.
const MOST_IN_VAIN: usize = 4;

/// Attempts at a step.
#[derive(Debug, Clone, Copy)]
struct Attempts {
    /// How far off the last one was.
    off: f64,
    in_vain: usize,
    /// Length of the first one, cycles.
    longest: f64,
}

impl Attempts {
    /// These and one of this length (cycles) that is so far off.
    fn and_one(refused: Option<Self>, off: f64, step: f64) -> Self {
        let helps = refused.is_none_or(|before| off <= IN_VAIN * before.off);
        Self {
            off,
            in_vain: refused.map_or(0, |before| before.in_vain + usize::from(!helps)),
            longest: refused.map_or(step, |before| before.longest),
        }
    }
}

/// What becomes of a step.
pub(super) enum Verdict {
    /// It counts.
    Counts {
        /// Length of the next one, cycles.
        next: f64,
    },
    /// It is taken again.
    Again {
        /// Its length then, cycles.
        shorter: f64,
    },
}

/// Holds the worn area of each step against what the line loads wear off.
pub(super) struct AreaCheck {
    balancing: Balancing,
    /// Whether a step may be refused.
    refuses: bool,
    /// Worn area of each flank at a mean depth of one module, mm².
    unit: [f64; 2],
    /// Growth of the deepest place below which no step is refused, mm.
    least_growth: f64,
    /// Attempts at the step in hand that were refused.
    refused: Option<Attempts>,
}

impl AreaCheck {
    pub(super) fn new(law: &WearLaw<'_>, cycle: &Cycle) -> Self {
        let module = cycle.pair.pinion.rack.module;
        Self {
            balancing: law.balance,
            // along given steps no error is too large
            refuses: law.tolerance.is_finite(),
            unit: (cycle.stations.arc.each_ref()).map(|arc| module * (arc[arc.len() - 1] - arc[0])),
            least_growth: LEAST_GROWTH * module,
            refused: None,
        }
    }

    /// Judges `trial`, a step from `before`.
    pub(super) fn judge(&mut self, before: &Progress, trial: &Trial) -> Verdict {
        let proposed = trial.stand.step;
        if self.balancing == Balancing::Off {
            return Verdict::Counts { next: proposed };
        }
        let drift = self.balancing == Balancing::History;
        let off = trial.balance.off(&before.balance, self.unit, drift);
        let attempts = Attempts::and_one(self.refused, off, trial.length);
        let is_off = off > 1.0 && self.has_grown(before, trial);
        if self.refuses && is_off && attempts.in_vain < MOST_IN_VAIN {
            self.refused = Some(attempts);
            return Verdict::Again {
                shorter: trial.length * (0.85 / off.sqrt()).clamp(0.2, 0.7),
            };
        }
        let next = if attempts.in_vain == MOST_IN_VAIN {
            // no matter of the step's length
            proposed.max(attempts.longest)
        } else if off > 0.5 {
            // the depth's own error would have it longer, and taken again
            proposed.min(trial.length)
        } else {
            proposed
        };
        Verdict::Counts { next }
    }

    /// Forgets what was refused: the step in hand is done.
    pub(super) fn next_step(&mut self) {
        self.refused = None;
    }

    /// Whether any place has grown by more than nothing.
    fn has_grown(&self, before: &Progress, trial: &Trial) -> bool {
        (trial.stand.u.iter().zip(&before.stand.u))
            .any(|(now, then)| now - then > self.least_growth)
    }
}
