//! Runs of a test at the centre distances that effects lead to. Each distance takes a mesh cycle and a compliance of its own, which cost more than
//! many a wear history. They depend on the distance alone, not on what leads there: all fits on the same gears share them.

use std::sync::{Mutex, PoisonError};

use crate::simulate::forward::{Forward, ForwardError, Mounting};
use crate::wear::acting::Acting;

/// Mountings kept of each test, those used last: each holds a mesh cycle and its compliance, and two threads fit different candidates at a time.
const KEPT: usize = 8;

/// The mountings of one test that were used last.
#[derive(Default)]
pub(super) struct Mountings {
    /// With the bits of how much farther apart than the test's own (mm) the axes are, the one used last at the end.
    kept: Mutex<Vec<(u64, Mounting)>>,
}

impl Mountings {
    /// A fresh run of the test that `template` has prepared, with these coefficients and with effects that move its axes.
    ///
    /// # Errors
    /// As [`Forward::again`].
    pub(super) fn run<'f>(
        &self,
        template: &'f Forward<'_>,
        coefficients: [f64; 2],
        acting: &'f Acting,
    ) -> Result<Forward<'f>, ForwardError> {
        let moved = template.axes_moved_by(acting).to_bits();
        if let Some(mounting) = self.used(moved) {
            return template.again_at(&mounting, coefficients, Some(acting));
        }
        // no lock is held meanwhile: whoever else wants the same one makes the same
        let forward = template.again(coefficients, Some(acting))?;
        self.keep(moved, forward.mounting());
        Ok(forward)
    }

    fn used(&self, moved: u64) -> Option<Mounting> {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let at = kept.iter().position(|(own, _)| *own == moved)?;
        kept[at..].rotate_left(1);
        kept.last().map(|(_, mounting)| mounting.clone())
    }

    fn keep(&self, moved: u64, mounting: Mounting) {
        let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        if kept.iter().any(|(own, _)| *own == moved) {
            return;
        }
        if kept.len() == KEPT {
            kept.remove(0);
        }
        kept.push((moved, mounting));
    }
}
