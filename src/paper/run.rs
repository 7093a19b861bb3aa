//! The algorithm of the published model: one explicit step per cycle, every point on its own.

use rayon::prelude::*;

use super::equations::{Passage, Station};
use super::{Error, Geometry, Inputs};

/// One point of the pinion flank before and after all cycles; mm, N, MPa, rad.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Point number, from 1 at the base circle.
    pub number: usize,
    /// Radius on the unworn flank.
    pub radius: f64,
    /// Distance y from the pitch point along the line of action, unworn; negative in the dedendum.
    pub y: f64,
    /// Load per face width, N/mm; zero where the flank is not in contact.
    pub load_per_width: f64,
    /// Largest contact pressure in cycle 1.
    pub pressure_before: f64,
    /// Largest contact pressure after the last cycle.
    pub pressure_after: f64,
    /// Half width of the contact in cycle 1.
    pub half_width_before: f64,
    /// Half width of the contact after the last cycle.
    pub half_width_after: f64,
    /// Depth worn off in cycle 1.
    pub first_cycle_depth: f64,
    /// Depth worn off in all cycles.
    pub depth: f64,
    /// Profile angle of the unworn flank.
    pub angle: f64,
    /// Increase of the profile angle over all cycles (an artefact of Eq. 6).
    pub angle_change: f64,
}

/// The flank at one moment of the wear history.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Cycles done.
    pub cycles: u64,
    /// The points, in order of their number.
    pub points: Vec<PointState>,
}

/// One point at one moment; mm, MPa, rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointState {
    /// Distance from the pitch point along the line of action, of the worn flank as the model sees it.
    pub y: f64,
    /// Profile angle.
    pub angle: f64,
    /// Half width of the contact.
    pub half_width: f64,
    /// Largest contact pressure.
    pub pressure: f64,
    /// Depth worn off so far.
    pub depth: f64,
    /// Depth the next cycle takes.
    pub depth_per_cycle: f64,
}

/// What the published model yields.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Working geometry and grid.
    pub geometry: Geometry,
    /// The points, number 1 first.
    pub points: Vec<Point>,
    /// The flank at the requested cycles, and always at the beginning and the end.
    pub states: Vec<State>,
}

impl Outcome {
    /// The point with this number (from 1), if there is one.
    pub fn point(&self, number: usize) -> Option<&Point> {
        number.checked_sub(1).and_then(|i| self.points.get(i))
    }

    /// The point whose pressure falls most, and by how much, MPa.
    pub fn largest_pressure_drop(&self) -> (usize, f64) {
        let drop = |p: &Point| p.pressure_before - p.pressure_after;
        self.points.iter().fold((0, 0.0), |best, p| {
            if drop(p) > best.1 {
                (p.number, drop(p))
            } else {
                best
            }
        })
    }
}

/// Runs the published model over all cycles.
pub fn run(inputs: &Inputs) -> Result<Outcome, Error> {
    run_with_states(inputs, &[])
}

/// Runs the published model and keeps the flank at these cycles too (those beyond `inputs.cycles` are left out).
pub fn run_with_states(inputs: &Inputs, states: &[u64]) -> Result<Outcome, Error> {
    let geometry = Geometry::new(inputs)?;
    let mut kept: Vec<u64> = [0, inputs.cycles]
        .iter()
        .chain(states)
        .copied()
        .filter(|&n| n <= inputs.cycles)
        .collect();
    kept.sort_unstable();
    kept.dedup();
    // Points do not see each other, so the result is the same for any number of threads.
    let histories: Vec<Result<Vec<PointState>, Error>> = (1..=geometry.grid.points)
        .into_par_iter()
        .map(|number| {
            let station = Station::new(inputs, &geometry, geometry.grid.radius(number));
            history(&station, geometry.profile_angle(number), &kept).map_err(|cycle| {
                Error::Diverged {
                    point: number,
                    cycle,
                }
            })
        })
        .collect();
    let histories = histories.into_iter().collect::<Result<Vec<_>, _>>()?;
    let points = histories
        .iter()
        .enumerate()
        .map(|(i, history)| summary(inputs, &geometry, i + 1, history))
        .collect();
    let states = kept
        .iter()
        .enumerate()
        .map(|(s, &cycles)| State {
            cycles,
            points: histories.iter().map(|history| history[s]).collect(),
        })
        .collect();
    Ok(Outcome {
        geometry,
        points,
        states,
    })
}

fn summary(inputs: &Inputs, geometry: &Geometry, number: usize, history: &[PointState]) -> Point {
    let (first, last) = (history[0], history[history.len() - 1]);
    let radius = geometry.grid.radius(number);
    Point {
        number,
        radius,
        y: first.y,
        load_per_width: Station::new(inputs, geometry, radius).load,
        pressure_before: first.pressure,
        pressure_after: last.pressure,
        half_width_before: first.half_width,
        half_width_after: last.half_width,
        first_cycle_depth: first.depth_per_cycle,
        depth: last.depth,
        angle: first.angle,
        angle_change: last.angle - first.angle,
    }
}

/// States of one point at the `kept` cycles (ascending); the cycle at which it leaves the line of action otherwise.
fn history(station: &Station, angle: f64, kept: &[u64]) -> Result<Vec<PointState>, u64> {
    let mut tangent = angle.tan();
    let mut depth = 0.0;
    let mut cycle = 0;
    let mut states = Vec::with_capacity(kept.len());
    for &target in kept {
        if station.load == 0.0 {
            cycle = target;
        }
        while cycle < target {
            let passage = station.passage(tangent).ok_or(cycle)?;
            depth += passage.depth;
            tangent = station.worn(tangent, passage.depth);
            cycle += 1;
        }
        let Passage {
            y,
            half_width,
            pressure,
            depth: next,
        } = station.passage(tangent).ok_or(cycle)?;
        states.push(PointState {
            y,
            angle: tangent.atan(),
            half_width,
            pressure,
            depth,
            depth_per_cycle: next,
        });
    }
    Ok(states)
}
