//! Means of piecewise linear functions.

/// Nodes and their weights in an average.
pub type Average = Vec<(usize, f64)>;

/// Weights of values at `nodes` (ascending or descending) in the average over [from, to] of the straight lines through
/// them; outside the nodes there is nothing.
pub fn average(nodes: &[f64], from: f64, to: f64) -> Average {
    let mut weights: Average = Vec::new();
    let rising = nodes.first() < nodes.last();
    let before = |s: &f64| if rising { *s < from } else { *s > to };
    for k in nodes.partition_point(before).max(1)..nodes.len() {
        let (a, b) = (nodes[k - 1], nodes[k]);
        if if rising { a >= to } else { a <= from } {
            break;
        }
        let (low, high) = (a.min(b).max(from), a.max(b).min(to));
        if low >= high {
            continue;
        }
        // a straight line's mean is its value in the middle
        let share = (high - low) / (to - from);
        let t = (0.5 * (low + high) - a) / (b - a);
        for (node, weight) in [(k - 1, share * (1.0 - t)), (k, share * t)] {
            match weights.last_mut().filter(|last| last.0 == node) {
                Some(last) => last.1 += weight,
                None => weights.push((node, weight)),
            }
        }
    }
    weights
}

/// Weights of values at the nodes `nodes` (ascending or descending) in the average around `at` that fades out linearly over `reach` on both sides, of the
/// straight lines through them; outside the nodes there is nothing.
///
/// No wave changes its sign in it: one of length λ keeps (sin x/x)² of its height, x = π reach/λ. In [`average`] those between a half and once its
/// length come out upside down.
pub fn fading_average(nodes: &[f64], at: f64, reach: f64) -> Average {
    let mut weights: Average = Vec::new();
    let rising = nodes.first() < nodes.last();
    let before = |s: &f64| {
        if rising {
            *s < at - reach
        } else {
            *s > at + reach
        }
    };
    for k in nodes.partition_point(before).max(1)..nodes.len() {
        let (a, b) = (nodes[k - 1], nodes[k]);
        if if rising {
            a >= at + reach
        } else {
            a <= at - reach
        } {
            break;
        }
        let (low, high) = (a.min(b), a.max(b));
        let mut share = [0.0; 2];
        for (from, to) in [(at - reach, at), (at, at + reach)] {
            let (from, to) = (low.max(from), high.min(to));
            if from >= to {
                continue;
            }
            // two straight lines multiplied: two points are exact
            for point in TWO_POINTS {
                let s = from + point * (to - from);
                let fade = (1.0 - (s - at).abs() / reach) / reach * 0.5 * (to - from);
                let t = (s - a) / (b - a);
                share[0] += fade * (1.0 - t);
                share[1] += fade * t;
            }
        }
        for (node, weight) in [(k - 1, share[0]), (k, share[1])] {
            match weights.last_mut().filter(|last| last.0 == node) {
                Some(last) => last.1 += weight,
                None => weights.push((node, weight)),
            }
        }
    }
    weights
}

/// Gauss's points of equal weight on (0, 1).
const TWO_POINTS: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

#[cfg(test)]
mod tests {
    use super::{average, fading_average};

    /// The mean of 2 + 3 s over [0.9, 1.8] is its value in the middle, on nodes that ascend or descend; over half of nothing, half.
    #[test]
    fn averages_of_straight_lines_are_exact() {
        let mut arc = vec![0.0, 0.4, 1.0, 1.1, 1.7, 2.5];
        for _ in 0..2 {
            let mean: f64 = average(&arc, 0.9, 1.8)
                .iter()
                .map(|&(k, weight)| weight * (2.0 + 3.0 * arc[k]))
                .sum();
            assert!((mean - (2.0 + 3.0 * 1.35)).abs() < 1e-14, "{mean}");
            let half: f64 = average(&arc, 2.0, 3.0).iter().map(|w| w.1).sum();
            assert!((half - 0.5).abs() < 1e-14, "{half}");
            arc.reverse();
        }
    }

    /// Of straight lines the value in the middle; of a wave (sin x/x)² of its height, never less than nothing.
    #[test]
    fn fading_averages_keep_straight_lines_and_turn_no_wave_over() {
        let mut nodes: Vec<f64> = (0..=4000).map(|i| 0.001 * f64::from(i)).collect();
        for _ in 0..2 {
            let mean = |at: f64, reach: f64, of: &dyn Fn(f64) -> f64| -> f64 {
                let weights = fading_average(&nodes, at, reach);
                weights.iter().map(|&(k, w)| w * of(nodes[k])).sum()
            };
            let line = mean(1.234_5, 0.3, &|s| 2.0 + 3.0 * s);
            assert!((line - (2.0 + 3.0 * 1.234_5)).abs() < 1e-12, "{line}");
            for length in [0.15, 0.2, 0.25, 0.37, 0.8] {
                let x = std::f64::consts::PI * 0.3 / length;
                let wave = mean(2.0, 0.3, &|s| {
                    (std::f64::consts::TAU * (s - 2.0) / length).cos()
                });
                assert!((wave - (x.sin() / x).powi(2)).abs() < 1e-4, "{wave}");
            }
            nodes.reverse();
        }
    }
}
