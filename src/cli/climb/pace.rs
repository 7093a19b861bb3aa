//! How far a climb has come, and how long it may still take: no one knows how many steps pay, so the time left is a range, by the steps made.

use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use crate::cli::progress::in_words;

/// The steps made so far.
pub(super) struct Pace {
    made: Mutex<Made>,
    /// Most effects to add.
    most: usize,
}

struct Made {
    began: Instant,
    /// Whole steps, each with its diagnosis, and what they took, s.
    steps: usize,
    seconds: f32,
}

impl Pace {
    pub(super) fn new(most: usize) -> Self {
        let began = Instant::now();
        let made = Mutex::new(Made {
            began,
            steps: 0,
            seconds: 0.0,
        });
        Self { made, most }
    }

    /// A step is made; `whole`: with a diagnosis of its own.
    pub(super) fn step(&self, whole: bool) {
        let mut made = self.made.lock().unwrap_or_else(PoisonError::into_inner);
        if whole {
            made.steps += 1;
            made.seconds += made.began.elapsed().as_secs_f32();
        }
        made.began = Instant::now();
    }

    /// Where the climb stands on the step above so many `rungs`, of which the share `done` is done.
    pub(super) fn at(&self, rungs: usize, done: f64) -> String {
        let made = self.made.lock().unwrap_or_else(PoisonError::into_inner);
        let per_step = (made.steps > 0).then(|| made.seconds / made.steps as f32);
        told(rungs, self.most, done, per_step)
    }
}

/// The step, and where a step has been timed the time left: this step if it is the last one, or all that may follow.
fn told(rungs: usize, most: usize, done: f64, per_step: Option<f32>) -> String {
    // the last diagnosis stands above all steps, and adds nothing
    let (step, last) = (rungs + 1, most + 1);
    let step_of = match step > most {
        true if most == 1 => "last diagnosis, after 1 step".to_owned(),
        true => format!("last diagnosis, after {most} steps"),
        false => format!("step {step} of at most {most}"),
    };
    let Some(seconds) = per_step else {
        return step_of;
    };
    let this = (1.0 - done.clamp(0.0, 1.0) as f32) * seconds;
    let all = this + seconds * last.saturating_sub(step) as f32;
    let [least, most] = [this, all].map(in_words);
    if least == most {
        format!("{step_of}, about {least} left")
    } else {
        format!("{step_of}, {least} to {most} left by the steps made")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_time_is_told_before_a_step_is_made_and_then_a_range() {
        assert_eq!(told(0, 5, 0.3, None), "step 1 of at most 5");
        assert_eq!(
            told(1, 5, 0.5, Some(600.0)),
            "step 2 of at most 5, 5 min to 45 min left by the steps made"
        );
        assert_eq!(
            told(5, 5, 0.5, Some(60.0)),
            "last diagnosis, after 5 steps, about 30 s left"
        );
        assert_eq!(told(1, 1, 0.5, None), "last diagnosis, after 1 step");
    }

    #[test]
    fn a_step_without_a_diagnosis_is_no_measure() {
        let pace = Pace::new(3);
        pace.step(false);
        assert_eq!(pace.at(1, 0.0), "step 2 of at most 3");
        pace.step(true);
        assert!(
            pace.at(2, 0.0).ends_with("left by the steps made")
                || pace.at(2, 0.0).contains("about")
        );
    }
}
