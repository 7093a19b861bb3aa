//! The involute function and its inverse.

/// The involute function, rad.
///
/// ```text
/// inv α = tan α − α
/// ```
///
/// ```
/// # use gearwear::gear::inv;
/// assert!((inv(20_f64.to_radians()) - 0.014_904_384).abs() < 5e-10);
/// ```
pub fn inv(alpha: f64) -> f64 {
    alpha.tan() - alpha
}

/// The angle α in (0, π/2), rad, whose involute function is `value` >= 0; negative values give 0.
///
/// Newton's method from above: tan α − α is convex, and both (3 v)^(1/3) (since tan α − α >= α³/3) and atan(v + π/2)
/// (since tan α = v + α) are upper bounds, so the iterates fall monotonically to the root.
pub fn inverse_inv(value: f64) -> f64 {
    if value.is_nan() || value <= 0.0 {
        return 0.0;
    }
    let mut alpha = (3.0 * value)
        .cbrt()
        .min((value + std::f64::consts::FRAC_PI_2).atan());
    for _ in 0..60 {
        let t = alpha.tan();
        let next = alpha - (t - alpha - value) / (t * t);
        if !next.is_finite() || next >= alpha || next <= 0.0 {
            break;
        }
        alpha = next;
    }
    alpha
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_inverts() {
        for i in 1..=160 {
            let alpha = f64::from(i) * 0.5_f64.to_radians();
            let back = inverse_inv(inv(alpha));
            assert!(
                (back - alpha).abs() < 1e-12 / alpha.powi(2).min(1.0),
                "{alpha} {back}"
            );
        }
        assert_eq!(inverse_inv(-1.0), 0.0);
        assert_eq!(inverse_inv(f64::NAN), 0.0);
    }
}
