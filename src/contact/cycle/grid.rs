//! The contact grid of one tooth pair.

use super::CycleSpec;

/// Growth of the grid's spacing from one node to the next outside its even part, and the most it grows to.
const GROWTH: f64 = 1.15;
const COARSEST: f64 = 8.0;

/// Nodes in [low, high]: whole multiples of the spacing, farther apart outside the even part; where the strip ends at a tip or
/// root the last node sits on the end itself.
pub(super) fn grid(low: f64, high: f64, spec: CycleSpec) -> Option<Vec<f64>> {
    let h = spec.spacing;
    if high - low < 2.0 * h {
        return None;
    }
    let farthest = low.abs().max(high.abs());
    let mut side = vec![0.0];
    let mut step = h;
    while side[side.len() - 1] <= farthest {
        let next = side.len() as f64 * h;
        if next <= spec.even {
            side.push(next);
        } else {
            step = (GROWTH * step).min(COARSEST * h);
            side.push(side[side.len() - 1] + step);
        }
    }
    let below = side[1..].iter().rev().map(|x| -x);
    let mut xi: Vec<f64> = below
        .chain(side.iter().copied())
        .filter(|x| (low..=high).contains(x))
        .collect();
    if xi.len() < 2 {
        return None;
    }
    if low > -spec.window {
        if xi[0] - low > 0.5 * (xi[1] - xi[0]) {
            xi.insert(0, low)
        } else {
            xi[0] = low
        }
    }
    if high < spec.window {
        let end = xi.len() - 1;
        if high - xi[end] > 0.5 * (xi[end] - xi[end - 1]) {
            xi.push(high)
        } else {
            xi[end] = high
        }
    }
    (xi.len() > 2).then_some(xi)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_is_even_where_it_should_be_and_ends_where_flanks_do() {
        let spec = CycleSpec {
            positions: 10,
            spacing: 0.1,
            even: 1.0,
            window: 5.0,
            reach: 0.0,
        };
        let xi = grid(-5.0, 2.03, spec).unwrap();
        let zero = xi.iter().position(|x| *x == 0.0).unwrap();
        for k in -10i32..=10 {
            let at = (zero as i32 + k) as usize;
            assert_eq!(xi[at], f64::from(k) * 0.1);
        }
        assert_eq!(xi[xi.len() - 1], 2.03);
        assert!(xi[0] >= -5.0 && xi[0] < -5.0 + 0.8);
        let steps: Vec<f64> = xi.windows(2).map(|w| w[1] - w[0]).collect();
        assert!(
            steps.iter().all(|s| (0.05..=0.8 + 1e-9).contains(s)),
            "{steps:?}"
        );
        for two in steps[1..steps.len() - 1].windows(2) {
            assert!((two[0] / two[1]).max(two[1] / two[0]) < 1.15 + 1e-9);
        }
        assert!(xi.len() < 50, "{}", xi.len());
    }
}
