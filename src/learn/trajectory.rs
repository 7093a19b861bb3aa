//! A wear history that can be read at any time: its steps, with a smooth curve through them.
//!
//! Between steps depths follow the cubic with the slopes of the parabola through each step and its neighbours; its error is of the
//! order of a step's own. No step is shortened for a reading, so the steps do not depend on what is read or when.
//!
//! A law in which the wear coefficient only multiplies the rate and no clock enters has one history for all coefficients:
//!
//! ```text
//! du/dn = k F(u)   ⇒   u(n; k) = U(k n)
//! ```

use crate::simulate::forward::{Forward, ForwardError};
use crate::simulate::history::Progress;

/// Depths after some cycles.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Node {
    /// Pinion revolutions.
    pub(super) cycles: f64,
    /// Depths at the stations of pinion and gear, mm.
    pub(super) u: Vec<f64>,
    /// Area that effects only displaced, mm².
    pub(super) displaced: [f64; 2],
}

/// The steps of a history so far.
#[derive(Clone, Default)]
pub(super) struct Trajectory {
    nodes: Vec<Node>,
    progress: Option<Progress>,
}

impl Trajectory {
    /// Whether `cycles` lie between two steps with a further one behind.
    pub(super) fn reaches(&self, cycles: f64) -> bool {
        enough(&self.nodes, cycles)
    }

    /// Wears on until `cycles` lie between two steps with a further one behind.
    ///
    /// # Errors
    /// [`ForwardError`] if a step before `cycles` fails.
    pub(super) fn reach(&mut self, forward: &mut Forward, cycles: f64) -> Result<(), ForwardError> {
        if self.nodes.is_empty() {
            forward.wear_to(&mut self.progress, 0.0, &mut |_, _| true)?;
            self.nodes.extend(self.progress.as_ref().map(node));
        } else if let Some(progress) = &mut self.progress {
            // another preparation of the contact may number its unknowns otherwise
            progress.forget_sets();
        }
        let nodes = &mut self.nodes;
        let outcome = forward.wear_to(&mut self.progress, f64::MAX, &mut |_, progress| {
            nodes.push(node(progress));
            !enough(nodes, cycles)
        });
        match outcome {
            // the step beyond is a help only
            Err(_) if nodes.len() >= 3 && nodes.iter().any(|n| n.cycles >= cycles) => Ok(()),
            outcome => outcome.map(|_| ()),
        }
    }

    /// The state after `cycles`, which [`Trajectory::reach`] has reached.
    pub(super) fn at(&self, cycles: f64) -> Node {
        let last = self.nodes.len() - 1;
        let next = self.nodes.partition_point(|node| node.cycles < cycles);
        let next = next.clamp(1, last);
        let (from, to) = (&self.nodes[next - 1], &self.nodes[next]);
        let width = to.cycles - from.cycles;
        let t = (cycles - from.cycles) / width;
        // Hermite's cubic
        let (a, b) = (t * (1.0 - t) * (1.0 - t) * width, t * t * (t - 1.0) * width);
        let h = t * t * (3.0 - 2.0 * t);
        let [left, right] = [next - 1, next].map(|i| self.slope_weights(i));
        let slope = |weights: &[(usize, f64); 3], i: usize| -> f64 {
            weights.iter().map(|&(at, w)| w * self.nodes[at].u[i]).sum()
        };
        Node {
            cycles,
            u: (0..from.u.len())
                .map(|i| {
                    (1.0 - h) * from.u[i] + h * to.u[i] + a * slope(&left, i) + b * slope(&right, i)
                })
                .collect(),
            displaced: [0, 1]
                .map(|side| from.displaced[side] + t * (to.displaced[side] - from.displaced[side])),
        }
    }

    /// Weights of the slope at node `i` of the parabola through it and its neighbours.
    fn slope_weights(&self, i: usize) -> [(usize, f64); 3] {
        let first = i.saturating_sub(1).min(self.nodes.len() - 3);
        let n = [0, 1, 2].map(|j| self.nodes[first + j].cycles);
        let x = self.nodes[i].cycles;
        // derivative of Lagrange's polynomials
        [0, 1, 2].map(|j| {
            let [p, q] = [(j + 1) % 3, (j + 2) % 3];
            let weight = (2.0 * x - n[p] - n[q]) / ((n[j] - n[p]) * (n[j] - n[q]));
            (first + j, weight)
        })
    }
}

fn enough(nodes: &[Node], cycles: f64) -> bool {
    let behind = nodes.iter().filter(|node| node.cycles >= cycles).count();
    nodes.len() >= 3 && behind >= 2
}

fn node(progress: &Progress) -> Node {
    Node {
        cycles: progress.stand.n,
        u: progress.stand.u.clone(),
        displaced: progress.displaced(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_a_parabola_exactly_and_a_smooth_curve_to_the_fourth_order() {
        let read = |count: usize, curve: fn(f64) -> f64, at: f64| {
            let nodes = (0..=count).map(|i| {
                let cycles = i as f64 / count as f64;
                Node {
                    cycles,
                    u: vec![curve(cycles)],
                    displaced: [0.0; 2],
                }
            });
            let trajectory = Trajectory {
                nodes: nodes.collect(),
                progress: None,
            };
            trajectory.at(at).u[0]
        };
        for at in [0.0, 0.07, 0.5, 0.93, 1.0] {
            assert!(
                (read(5, |x| 1.0 + 2.0 * x - 3.0 * x * x, at) - (1.0 + 2.0 * at - 3.0 * at * at))
                    .abs()
                    < 1e-13
            );
        }
        let error = |count| (read(count, f64::exp, 0.5125) - f64::exp(0.5125)).abs();
        let order = (error(10) / error(20)).log2();
        assert!(order > 2.7, "order {order}");
    }
}
