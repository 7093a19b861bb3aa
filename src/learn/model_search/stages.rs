//! How far a search has come, told fit by fit within its stages.

use std::sync::{Mutex, PoisonError};

/// What is told while a diagnosis runs: the share done, 0 to 1, and what is going on.
pub type Watch<'w> = &'w (dyn Fn(f64, String) + Sync);

/// Share of its stage that as many fits as were foreseen make up. Nobody knows before how many there will be: more come ever nearer to its end.
const FORESEEN: f64 = 0.8;

/// The stages of a search, one after the other. What is told of them changes no result.
pub(in crate::learn) struct Stages<'w> {
    watch: Watch<'w>,
    now: Mutex<Stage>,
}

/// The stage that is on.
#[derive(Default)]
struct Stage {
    /// Shares of the whole search at which it begins and ends.
    range: [f64; 2],
    doing: String,
    foreseen: usize,
    done: usize,
}

impl<'w> Stages<'w> {
    pub(in crate::learn) fn new(watch: Watch<'w>) -> Self {
        let now = Mutex::default();
        Self { watch, now }
    }

    /// A stage begins: the share of the search at which it does and the one at which it ends, what it does, and about how many fits that takes.
    pub(in crate::learn) fn begin(&self, range: [f64; 2], doing: String, foreseen: usize) {
        let mut now = self.now.lock().unwrap_or_else(PoisonError::into_inner);
        *now = Stage {
            range,
            doing,
            foreseen,
            done: 0,
        };
        now.tell(self.watch);
    }

    /// One more fit of it is done, in whichever thread.
    pub(in crate::learn) fn one_done(&self) {
        let mut now = self.now.lock().unwrap_or_else(PoisonError::into_inner);
        now.done += 1;
        // with the lock, so that no later share is told before an earlier one
        now.tell(self.watch);
    }
}

impl Stage {
    fn tell(&self, watch: Watch<'_>) {
        let [from, to] = self.range;
        let share = share(self.done as f64 / self.foreseen.max(1) as f64);
        watch(from + (to - from) * share, self.doing.clone());
    }
}

/// The share of a stage that is done after so many times the fits that were foreseen.
fn share(fits: f64) -> f64 {
    if fits <= 1.0 {
        FORESEEN * fits
    } else {
        1.0 - (1.0 - FORESEEN) / fits
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A long stage does not stand still: every fit of it is told, and more than were foreseen do not reach its end.
    #[test]
    fn every_fit_moves_its_stage_on() {
        let told = Mutex::new(Vec::new());
        let watch = |done: f64, _: String| told.lock().unwrap().push(done);
        let stages = Stages::new(&watch);
        stages.begin([0.5, 0.7], "pairs".to_owned(), 4);
        (0..40).for_each(|_| stages.one_done());
        stages.begin([0.7, 1.0], "more".to_owned(), 0);
        let told = told.into_inner().unwrap();
        assert_eq!(told.len(), 42);
        assert!(told.windows(2).all(|w| w[0] < w[1]), "{told:?}");
        assert!((told[4] - 0.66).abs() < 1e-12 && told[40] < 0.7 && told[41] == 0.7);
    }
}
