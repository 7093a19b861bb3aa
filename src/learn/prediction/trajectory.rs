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

use crate::simulate::forward::{Forward, ForwardError, Variation};
use crate::simulate::history::{HistoryTangents, Progress};

/// Depths after some cycles.
#[derive(Debug, Clone, PartialEq, Default)]
pub(in crate::learn) struct Node {
    /// Pinion revolutions.
    pub(in crate::learn) cycles: f64,
    /// Depths at the stations of pinion and gear, mm.
    pub(in crate::learn) u: Vec<f64>,
    /// Area that effects only displaced, mm².
    pub(in crate::learn) displaced: [f64; 2],
    /// Derivatives of both by parameter; none if none were asked for.
    pub(in crate::learn) tangents: HistoryTangents,
}

/// The steps of a history so far.
#[derive(Clone, Default)]
pub(in crate::learn) struct Trajectory {
    nodes: Vec<Node>,
    progress: Option<Progress>,
    tangents: HistoryTangents,
}

impl Trajectory {
    /// Whether `cycles` lie between two steps with a further one behind.
    pub(in crate::learn) fn reaches(&self, cycles: f64) -> bool {
        enough(&self.nodes, cycles)
    }

    /// By how many parameters it is differentiated.
    pub(in crate::learn) fn parameters(&self) -> usize {
        self.tangents.depth.len()
    }

    /// The largest depth so far, mm.
    pub(in crate::learn) fn deepest(&self) -> f64 {
        let depths = self.progress.iter().flat_map(|p| p.max_depth);
        depths.fold(0.0, f64::max)
    }

    /// Wears on until `cycles` lie between two steps with a further one behind, with the derivatives by `variations`: the same ones
    /// every time; not deeper than `deepest` (mm).
    ///
    /// # Errors
    /// [`ForwardError`] if a step before `cycles` fails or goes deeper.
    pub(in crate::learn) fn reach(
        &mut self,
        forward: &mut Forward,
        cycles: f64,
        variations: &[Variation],
        deepest: f64,
    ) -> Result<(), ForwardError> {
        let Self {
            nodes,
            progress,
            tangents,
        } = self;
        if nodes.is_empty() {
            let with = (variations, &mut *tangents);
            forward.wear_with_tangents(progress, 0.0, with, &mut |_, _, _| true)?;
            nodes.extend(progress.as_ref().map(|progress| node(progress, tangents)));
        } else if let Some(progress) = progress {
            // another preparation of the contact may number its unknowns otherwise
            progress.forget_sets();
        }
        let with = (variations, &mut *tangents);
        let mut too_deep = None;
        let outcome =
            forward.wear_with_tangents(progress, f64::MAX, with, &mut |_, progress, tangents| {
                nodes.push(node(progress, tangents));
                if progress.max_depth.iter().any(|depth| *depth > deepest) {
                    too_deep = Some(progress.stand.n);
                }
                too_deep.is_none() && !enough(nodes, cycles)
            });
        match outcome {
            Ok(_) if !enough(nodes, cycles) => Err(ForwardError::TooDeep {
                cycles: too_deep.unwrap_or_default(),
                deepest,
            }),
            // the step beyond is a help only
            Err(_) if nodes.len() >= 3 && nodes.iter().any(|n| n.cycles >= cycles) => Ok(()),
            outcome => outcome.map(|_| ()),
        }
    }

    /// The history of `forward` along the steps of this one.
    ///
    /// # Errors
    /// [`ForwardError`] if a step fails.
    pub(in crate::learn) fn along(&self, forward: &mut Forward) -> Result<Self, ForwardError> {
        let steps: Vec<f64> = self.nodes[1..].iter().map(|node| node.cycles).collect();
        let mut nodes = Vec::new();
        let mut progress = None;
        forward.wear_along(&mut progress, &steps, &mut |progress| {
            nodes.push(node(progress, &HistoryTangents::default()));
        })?;
        Ok(Self {
            nodes,
            progress,
            tangents: HistoryTangents::default(),
        })
    }

    /// The state after `cycles`, which [`Trajectory::reach`] has reached.
    pub(in crate::learn) fn at(&self, cycles: f64) -> Node {
        let (next, t, width) = self.place(cycles);
        // Hermite's cubic
        let (a, b) = (t * (1.0 - t) * (1.0 - t) * width, t * t * (t - 1.0) * width);
        let h = t * t * (3.0 - 2.0 * t);
        let depth = self.weights(next, [1.0 - h, h], [a, b]);
        let between = [(next - 1, 1.0 - t), (next, t)];
        let pairs = |of: &dyn Fn(&Node) -> [f64; 2]| -> [f64; 2] {
            [0, 1].map(|side| {
                between
                    .iter()
                    .map(|&(i, w)| w * of(&self.nodes[i])[side])
                    .sum()
            })
        };
        let parameters = self.nodes[next].tangents.depth.len();
        let tangents = HistoryTangents::read(
            (0..parameters)
                .map(|j| self.sum(&depth, &|node| &node.tangents.depth[j]))
                .collect(),
            (0..parameters)
                .map(|j| pairs(&|node| node.tangents.displaced[j]))
                .collect(),
        );
        Node {
            cycles,
            u: self.sum(&depth, &|node| &node.u),
            displaced: pairs(&|node| node.displaced),
            tangents,
        }
    }

    /// By how much the depths of [`Trajectory::at`] grow per cycle there, mm.
    pub(in crate::learn) fn growth(&self, cycles: f64) -> Vec<f64> {
        let (next, t, width) = self.place(cycles);
        let h = 6.0 * t * (1.0 - t) / width;
        let ends = [1.0 - 4.0 * t + 3.0 * t * t, 3.0 * t * t - 2.0 * t];
        self.sum(&self.weights(next, [-h, h], ends), &|node| &node.u)
    }

    /// The node behind `cycles`, the share of the way there from the one before, and that way's length.
    fn place(&self, cycles: f64) -> (usize, f64, f64) {
        let last = self.nodes.len() - 1;
        let next = self.nodes.partition_point(|node| node.cycles < cycles);
        let next = next.clamp(1, last);
        let from = self.nodes[next - 1].cycles;
        let width = self.nodes[next].cycles - from;
        (next, (cycles - from) / width, width)
    }

    /// Weights of the nodes in a sum of the values and of the slopes at node `next` and the one before it.
    fn weights(&self, next: usize, values: [f64; 2], slopes: [f64; 2]) -> Vec<(usize, f64)> {
        let mut weights = vec![(next - 1, values[0]), (next, values[1])];
        for (i, slope) in [next - 1, next].into_iter().zip(slopes) {
            weights.extend(
                self.slope_weights(i)
                    .map(|(at, weight)| (at, slope * weight)),
            );
        }
        weights
    }

    fn sum<'n>(&'n self, weights: &[(usize, f64)], of: &dyn Fn(&'n Node) -> &'n [f64]) -> Vec<f64> {
        let mut sum = vec![0.0; of(&self.nodes[0]).len()];
        for &(i, weight) in weights {
            for (sum, value) in sum.iter_mut().zip(of(&self.nodes[i])) {
                *sum += weight * value;
            }
        }
        sum
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

fn node(progress: &Progress, tangents: &HistoryTangents) -> Node {
    Node {
        cycles: progress.stand.n,
        u: progress.stand.u.clone(),
        displaced: progress.displaced(),
        tangents: tangents.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_a_parabola_exactly_and_a_smooth_curve_to_the_fourth_order() {
        let trajectory = |count: usize, curve: fn(f64) -> f64| {
            let nodes = (0..=count).map(|i| {
                let cycles = i as f64 / count as f64;
                Node {
                    cycles,
                    u: vec![curve(cycles)],
                    ..Node::default()
                }
            });
            Trajectory {
                nodes: nodes.collect(),
                ..Trajectory::default()
            }
        };
        let read = |count, curve, at| trajectory(count, curve).at(at).u[0];
        for at in [0.0, 0.07, 0.5, 0.93, 1.0] {
            assert!(
                (read(5, |x| 1.0 + 2.0 * x - 3.0 * x * x, at) - (1.0 + 2.0 * at - 3.0 * at * at))
                    .abs()
                    < 1e-13
            );
        }
        for at in [0.0, 0.07, 0.5, 0.93, 1.0] {
            let growth = trajectory(5, |x| 1.0 + 2.0 * x - 3.0 * x * x).growth(at)[0];
            assert!((growth - (2.0 - 6.0 * at)).abs() < 1e-12, "{growth}");
        }
        let error = |count| (read(count, f64::exp, 0.5125) - f64::exp(0.5125)).abs();
        let order = (error(10) / error(20)).log2();
        assert!(order > 2.7, "order {order}");
    }
}
