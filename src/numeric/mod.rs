//! Floor 0: mathematics without a gear word in it.

pub mod average;
pub mod chi_squared;
pub mod golden_section;
pub mod halton;
pub mod latin_hypercube;
pub mod logarithm;
pub mod patchy;
pub mod positive_definite;
pub mod quadrature;
pub mod smooth_functions;
pub mod sobol_indices;
pub mod sparse;
pub mod truncated_normal;
pub mod written;

/// A point or vector in the plane, mm unless said otherwise.
pub type Vec2 = nalgebra::Vector2<f64>;

/// The z component of the cross product of two plane vectors.
pub fn cross(a: Vec2, b: Vec2) -> f64 {
    a.x * b.y - a.y * b.x
}

/// `v` turned counter-clockwise by `angle`, rad.
pub fn rotate(v: Vec2, angle: f64) -> Vec2 {
    let (s, c) = angle.sin_cos();
    Vec2::new(c * v.x - s * v.y, s * v.x + c * v.y)
}

/// Chebyshev's polynomial of the first kind, T_n(x) = cos(n arccos x), −1 ≤ x ≤ 1.
pub fn chebyshev(degree: usize, x: f64) -> f64 {
    (degree as f64 * x.acos()).cos()
}

/// Median of |x| of a standard normal number: a median of magnitudes over it is a standard deviation.
pub const MEDIAN_OF_NORMAL: f64 = 0.674_490;

/// The middle one of some numbers, of an even count the upper of the two; None of none.
pub fn median(mut values: Vec<f64>) -> Option<f64> {
    let middle = values.len() / 2;
    if values.is_empty() {
        return None;
    }
    let (_, median, _) = values.select_nth_unstable_by(middle, f64::total_cmp);
    Some(*median)
}

/// How many of the ascending `x` are not above `at`. Most grids are nearly even: where it would lie on an even one is looked at first.
pub fn passed(x: &[f64], at: f64) -> usize {
    if let [first, .., last] = x {
        let share = (at - first) / (last - first) * (x.len() - 1) as f64;
        let guess = share.clamp(0.0, (x.len() - 2) as f64) as usize;
        if x[guess] <= at && at < x[guess + 1] {
            return guess + 1;
        }
    }
    x.partition_point(|&v| v <= at)
}

/// Piecewise linear interpolation of `y` over ascending `x`, constant beyond the ends.
pub fn interpolate(x: &[f64], y: &[f64], at: f64) -> f64 {
    let next = passed(x, at);
    if next == 0 {
        return y[0];
    }
    if next == x.len() {
        return y[next - 1];
    }
    let t = (at - x[next - 1]) / (x[next] - x[next - 1]);
    y[next - 1] + t * (y[next] - y[next - 1])
}
