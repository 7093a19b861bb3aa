//! Measured values with their derivatives.
//!
//! Derivatives come with the histories ([`crate::wear::tangent`]), with two exceptions: that by a coefficient which only stretches time is read off
//! the history's growth, and what moves the axes goes by central differences over the centre distance, on the same steps.

use nalgebra::DMatrix;

use super::{GearModel, Run, by_row};
use crate::effects::Hook;
use crate::learn::prediction::predictor::{Linearised, Move, PredictError};
use crate::learn::prediction::trajectory::{Node, Trajectory};
use crate::simulate::forward::{ForwardError, Variation};
use crate::wear::acting::Acting;

/// How far apart the axes are moved to either side for a derivative by their distance, mm.
const MOVED_AXES: f64 = 2e-3;
/// How far the law is asked along a derivative by ln k.
const STEP_K: f64 = 1e-7;
/// From this share of the largest depth on, by which depths change along a move, a history has no usable derivatives. Moves are 1e-7 of a
/// prior's standard deviation; ten depths in one of these are no trend. Sharp laws in an uneven pressure make such histories: each
/// step turns on which place is pressed most, and what a parameter does to that grows from step to step.
const UNSTEADY: f64 = 1e-6;

impl GearModel<'_> {
    /// Adds the derivative by the logarithm of a coefficient that only stretches time.
    pub(super) fn stretched(&self, history: &Trajectory, state: &mut Node) {
        let growth = history.growth(state.cycles).into_iter();
        let depth = growth.map(|growth| growth * state.cycles).collect();
        state.tangents.depth.push(depth);
        state.tangents.displaced.push([0.0; 2]);
    }

    /// Every observation with its derivatives along `moves` and by ln k; None if these follow no trend.
    pub(super) fn linearised(
        &self,
        test: usize,
        coefficient: f64,
        parameters: &[f64],
        moves: &[Move],
    ) -> Result<Option<Linearised>, ForwardError> {
        let runs = self.runs(test, coefficient, parameters);
        let all: usize = runs.iter().map(|run| run.rows.len()).sum();
        let mut linearised = Linearised {
            values: vec![0.0; all],
            derivatives: DMatrix::zeros(all, moves.len() + 1),
        };
        for run in &runs {
            let Some(own) = self.linearised_run(run, parameters, moves)? else {
                return Ok(None);
            };
            if runs.len() == 1 {
                return Ok(Some(own));
            }
            for (i, &row) in run.rows.iter().enumerate() {
                linearised.values[row] = own.values[i];
                let derivatives = own.derivatives.row(i);
                linearised.derivatives.row_mut(row).copy_from(&derivatives);
            }
        }
        Ok(Some(linearised))
    }

    /// The observations of a run with their derivatives; None if these follow no trend.
    fn linearised_run(
        &self,
        run: &Run,
        parameters: &[f64],
        moves: &[Move],
    ) -> Result<Option<Linearised>, ForwardError> {
        let test = run.test;
        let columns = moves.len() + 1;
        let last = self.last(run);
        let acting = run.acting.as_ref();
        let shifted = |a_move: &Move| {
            let effects = (self.effects)(&a_move.parameters).felt_by(run.tooth);
            self.bench.acting(test, effects)
        };
        let moved: Vec<Acting> = moves.iter().map(shifted).collect();
        let axes = self.axes(run, moves, &moved);
        let unfelt = self.unfelt(run, parameters, moves);
        // what moves the axes changes nothing else
        let by_tangent = |i: usize| axes[i] == 0.0 && !unfelt[i];
        let tangent: Vec<usize> = (0..moves.len()).filter(|&i| by_tangent(i)).collect();
        let on_teeth = acting.into_iter().chain(&moved);
        let on_teeth = on_teeth.into_iter().any(|a| a.acts(Hook::ToothOffset));
        let mut variations: Vec<Variation> = (moves.iter().zip(moved).enumerate())
            .filter(|(i, _)| by_tangent(*i))
            .map(|(_, (a_move, acting))| Variation {
                coefficient: [0.0; 2],
                effects: Some(acting),
                step: a_move.step,
            })
            .collect();
        variations.push(Variation {
            coefficient: [1.0; 2],
            effects: None,
            step: STEP_K,
        });
        let carried = variations.len() - usize::from(self.stretches);
        let mut forward = self.bench.forward(test, run.worn_with, acting)?;
        // teeth that are all alike have no derivatives by what would tell them apart
        if on_teeth && forward.sequence().is_none() {
            return Ok(None);
        }
        let history = self.history(&mut forward, run.key(), last, &variations[..carried])?;
        if unsteady(&history.at(last), &variations[..carried]) {
            return Ok(None);
        }
        let rows = self.read_off(run, &mut forward, &history, &variations, &|reading, o| {
            Ok((reading.of(o)?, reading.tangents_of(o)?))
        })?;
        let mut derivatives = DMatrix::zeros(rows.len(), columns);
        let places = tangent.into_iter().chain([moves.len()]);
        for (j, column) in places.enumerate() {
            for (row, (_, tangents)) in rows.iter().enumerate() {
                derivatives[(row, column)] = tangents[j];
            }
        }
        let values: Vec<f64> = rows.into_iter().map(|(value, _)| value).collect();
        if axes.iter().any(|slope| *slope != 0.0) {
            let by_distance = self.by_distance(run, &history, &values)?;
            for (column, slope) in axes.iter().enumerate().filter(|(_, slope)| **slope != 0.0) {
                for (row, by_distance) in by_distance.iter().enumerate() {
                    derivatives[(row, column)] += slope * by_distance;
                }
            }
        }
        Ok(Some(Linearised {
            values,
            derivatives,
        }))
    }

    /// How far each move takes the axes apart, mm per unit; 0 for those that do not.
    fn axes(&self, run: &Run, moves: &[Move], moved: &[Acting]) -> Vec<f64> {
        let acting = run.acting.as_ref().filter(|a| a.acts(Hook::Operation));
        let own = self.bench.tests[run.test].conditions.misalignment;
        let (Some(acting), Ok(pair)) = (acting, self.bench.set().mount(own)) else {
            return vec![0.0; moves.len()];
        };
        let before = acting.added_centre_distance(&pair);
        let slope = |(a_move, moved): (&Move, &Acting)| {
            (moved.added_centre_distance(&pair) - before) / a_move.step
        };
        moves.iter().zip(moved).map(slope).collect()
    }

    /// Which moves change nothing that the tooth of a run feels: those of what concerns the measured teeth of others alone.
    fn unfelt(&self, run: &Run, parameters: &[f64], moves: &[Move]) -> Vec<bool> {
        let others = (self.effects)(parameters).measured_teeth();
        let others = others.iter().any(|member| Some(*member) != run.tooth);
        let of_teeth = &self.of_measured_teeth;
        let changes = |a_move: &Move, place: usize| a_move.parameters[place] != parameters[place];
        let unfelt = |a_move: &Move| {
            let changed = (0..parameters.len()).filter(|&place| changes(a_move, place));
            others && changed.into_iter().all(|place| of_teeth.contains(&place))
        };
        moves.iter().map(unfelt).collect()
    }

    /// Derivatives of every observation of a run by the centre distance, per mm: central differences of two runs on the steps of `history`, or to
    /// one side of its `values` where the gears cannot run on the other.
    fn by_distance(
        &self,
        run: &Run,
        history: &Trajectory,
        values: &[f64],
    ) -> Result<Vec<f64>, ForwardError> {
        let template = &self.bench.templates[run.test];
        let at = |farther: f64| -> Result<Vec<f64>, ForwardError> {
            let (_, members) = self.bench.tests[run.test].wear;
            let coefficient = members.map(|factor| factor * run.worn_with);
            let mut forward = template.again_moved(coefficient, run.acting.as_ref(), farther)?;
            let moved = history.along(&mut forward)?;
            self.read_off(run, &mut forward, &moved, &[], &|reading, o| reading.of(o))
        };
        let (low, high) = rayon::join(|| at(-MOVED_AXES), || at(MOVED_AXES));
        let slope = |low: &[f64], high: &[f64], apart: f64| -> Vec<f64> {
            let both = low.iter().zip(high);
            both.map(|(low, high)| (high - low) / apart).collect()
        };
        match (low, high) {
            (Ok(low), Ok(high)) => Ok(slope(&low, &high, 2.0 * MOVED_AXES)),
            (Ok(low), Err(_)) => Ok(slope(&low, values, MOVED_AXES)),
            (Err(_), Ok(high)) => Ok(slope(values, &high, MOVED_AXES)),
            (Err(error), Err(_)) => Err(error),
        }
    }

    /// As [`Predictor::predict`] at `to`, along the wear steps of the history at `from`: both a wear coefficient and parameters. Neighbours along
    /// the same steps differ smoothly.
    ///
    /// # Errors
    /// As [`Predictor::predict`].
    pub(in crate::learn) fn predict_along(
        &self,
        test: usize,
        from: (f64, &[f64]),
        to: (f64, &[f64]),
    ) -> Result<Vec<f64>, PredictError> {
        let before = self.runs(test, from.0, from.1);
        let after = self.runs(test, to.0, to.1);
        let along = |run: &Run| -> Result<Vec<f64>, ForwardError> {
            // of the same rows, unless what tells the teeth apart begins on the way
            let Some(before) = before.iter().find(|before| before.rows == run.rows) else {
                return self.read_run(run, &|reading, o| reading.of(o));
            };
            let (last, acting) = (self.last(before), before.acting.as_ref());
            let mut forward = self.bench.forward(test, before.worn_with, acting)?;
            let history = self.history(&mut forward, before.key(), last, &[])?;
            let acting = run.acting.as_ref();
            let mut forward = self.bench.forward(test, run.worn_with, acting)?;
            let mut moved = history.along(&mut forward)?;
            // in stretched time the last row may lie beyond the other's steps
            let last = self.last(run);
            if !moved.reaches(last) {
                moved.reach(&mut forward, last, &[], f64::INFINITY)?;
            }
            self.read_off(run, &mut forward, &moved, &[], &|reading, o| reading.of(o))
        };
        by_row(&after, along).map_err(|error| self.failed(test, &error))
    }
}

/// Whether the depths of a state hang on a parameter by more than any trend.
fn unsteady(state: &Node, variations: &[Variation]) -> bool {
    let largest = |values: &[f64]| values.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let deepest = largest(&state.u);
    let mut each = state.tangents.depth.iter().zip(variations);
    each.any(|(slopes, variation)| largest(slopes) * variation.step.abs() > UNSTEADY * deepest)
}
