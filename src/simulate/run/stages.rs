//! What a run spends its time on.

use std::time::Instant;

/// Names and times of stages as they end.
pub(super) struct Stages {
    last: Instant,
    pub(super) list: Vec<(String, f64)>,
}

impl Default for Stages {
    fn default() -> Self {
        Self {
            last: Instant::now(),
            list: Vec::new(),
        }
    }
}

impl Stages {
    /// The time since the last end belongs to the stage `name`.
    pub(super) fn end(&mut self, name: &str) {
        let seconds = self.last.elapsed().as_secs_f64();
        self.last = Instant::now();
        match self.list.iter_mut().find(|(known, _)| known == name) {
            Some((_, sum)) => *sum += seconds,
            None => self.list.push((name.to_owned(), seconds)),
        }
    }
}
