//! The largest value of a function of one number.

/// The place of the largest value of a function with one maximum between `low` and `high`, by the golden section down to an interval of this length.
pub fn place_of_largest(f: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2], length: f64) -> f64 {
    let share = 0.5 * (5f64.sqrt() - 1.0);
    let (mut a, mut b) = (high - share * (high - low), low + share * (high - low));
    let (mut fa, mut fb) = (f(a), f(b));
    while high - low > length {
        if fa < fb {
            (low, a, fa) = (a, b, fb);
            b = low + share * (high - low);
            fb = f(b);
        } else {
            (high, b, fb) = (b, a, fa);
            a = high - share * (high - low);
            fa = f(a);
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::place_of_largest;

    #[test]
    fn the_top_of_a_parabola_is_found_inside_and_at_an_end() {
        let top = |at: f64| place_of_largest(|x| -(x - at).powi(2), [-2.0, 3.0], 1e-6);
        assert!((top(0.7) - 0.7).abs() < 1e-5);
        assert!((top(9.0) - 3.0).abs() < 1e-5);
    }
}
