//! Gauss rules on the interval and on the triangle.

/// A point of a triangle rule: reference coordinates `(xi, eta)` of the triangle (0,0) (1,0) (0,1), and a weight; the
/// weights of a rule sum to the area, 1/2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrianglePoint {
    /// First reference coordinate.
    pub xi: f64,
    /// Second reference coordinate.
    pub eta: f64,
    /// Weight.
    pub weight: f64,
}

/// Nodes and weights of the `n`-point Gauss–Legendre rule on -1 ≤ x ≤ 1, ascending; exact for polynomials up to degree 2n − 1.
///
/// The nodes are the roots of the Legendre polynomial P_n, found by Newton's method; the weights are
///
/// ```text
/// w_i = 2 / ((1 − x_i²) P_n'(x_i)²)
/// ```
/// Abramowitz & Stegun (1964), 25.4.29.
pub fn gauss_legendre(n: usize) -> Vec<(f64, f64)> {
    let mut rule = vec![(0.0, 0.0); n];
    for i in 0..n.div_ceil(2) {
        let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        for _ in 0..20 {
            let (value, slope) = legendre(n, x);
            let step = value / slope;
            x -= step;
            if step.abs() < 1e-16 {
                break;
            }
        }
        if 2 * i + 1 == n {
            x = 0.0;
        }
        let slope = legendre(n, x).1;
        let weight = 2.0 / ((1.0 - x * x) * slope * slope);
        rule[i] = (-x, weight);
        rule[n - 1 - i] = (x, weight);
    }
    rule
}

/// Centroid rule, exact for degree 1.
pub const TRIANGLE_1: [TrianglePoint; 1] = [point(1.0 / 3.0, 1.0 / 3.0, 0.5)];

/// Three interior points, exact for degree 2. Strang & Fix (1973), Table 4.1.
pub const TRIANGLE_3: [TrianglePoint; 3] = [
    point(1.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0),
    point(2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0),
    point(1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0),
];

/// Seven points, exact for degree 5: Radon's rule, with a = (6 ∓ √15)/21 and weights (155 ∓ √15)/2400.
pub const TRIANGLE_7: [TrianglePoint; 7] = {
    const ROOT_15: f64 = 3.872_983_346_207_417;
    const A: f64 = (6.0 - ROOT_15) / 21.0;
    const B: f64 = (6.0 + ROOT_15) / 21.0;
    const WA: f64 = (155.0 - ROOT_15) / 2400.0;
    const WB: f64 = (155.0 + ROOT_15) / 2400.0;
    [
        point(1.0 / 3.0, 1.0 / 3.0, 9.0 / 80.0),
        point(A, A, WA),
        point(1.0 - 2.0 * A, A, WA),
        point(A, 1.0 - 2.0 * A, WA),
        point(B, B, WB),
        point(1.0 - 2.0 * B, B, WB),
        point(B, 1.0 - 2.0 * B, WB),
    ]
};

/// Product of two `n`-point Gauss rules collapsed onto the triangle, exact for degree 2n − 2.
///
/// ```text
/// xi = s (1 − t),  eta = t,  weight = w_s w_t (1 − t)          s, t in 0..1
/// ```
pub fn triangle_product(n: usize) -> Vec<TrianglePoint> {
    let line = gauss_legendre(n);
    let mut rule = Vec::with_capacity(n * n);
    for &(s, ws) in &line {
        for &(t, wt) in &line {
            let (s, t) = (0.5 * (1.0 + s), 0.5 * (1.0 + t));
            rule.push(point(s * (1.0 - t), t, 0.25 * ws * wt * (1.0 - t)));
        }
    }
    rule
}

const fn point(xi: f64, eta: f64, weight: f64) -> TrianglePoint {
    TrianglePoint { xi, eta, weight }
}

/// P_n(x) and its derivative, by the three-term recurrence.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut value) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (previous, value) = (
            value,
            ((2.0 * k - 1.0) * x * value - (k - 1.0) * previous) / k,
        );
    }
    (value, n as f64 * (x * value - previous) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gauss_integrates_monomials_to_degree_2n_minus_1_and_no_further() {
        for n in 1..=12usize {
            let rule = gauss_legendre(n);
            let integral = |degree: i32| rule.iter().map(|&(x, w)| w * x.powi(degree)).sum::<f64>();
            for degree in 0..2 * n as i32 {
                let exact = if degree % 2 == 0 {
                    2.0 / f64::from(degree + 1)
                } else {
                    0.0
                };
                assert!(
                    (integral(degree) - exact).abs() < 1e-14,
                    "n {n} degree {degree}"
                );
            }
            let degree = 2 * n as i32;
            assert!(
                (integral(degree) - 2.0 / f64::from(degree + 1)).abs() > 1e-9,
                "n {n}"
            );
        }
    }

    /// ∫ xi^p eta^q over the triangle is p! q! / (p + q + 2)!.
    fn triangle_error(rule: &[TrianglePoint], p: i32, q: i32) -> f64 {
        let factorial = |k: i32| (1..=k).map(f64::from).product::<f64>();
        let exact = factorial(p) * factorial(q) / factorial(p + q + 2);
        let sum: f64 = rule
            .iter()
            .map(|r| r.weight * r.xi.powi(p) * r.eta.powi(q))
            .sum();
        (sum - exact).abs()
    }

    #[test]
    fn triangle_rules_have_their_degree() {
        let product = triangle_product(4);
        let rules: [(&[TrianglePoint], i32); 4] = [
            (&TRIANGLE_1, 1),
            (&TRIANGLE_3, 2),
            (&TRIANGLE_7, 5),
            (&product, 6),
        ];
        for (rule, degree) in rules {
            for p in 0..=degree {
                for q in 0..=degree - p {
                    assert!(
                        triangle_error(rule, p, q) < 1e-15,
                        "degree {degree}: {p} {q}"
                    );
                }
            }
            let missed = (0..=degree + 1)
                .map(|p| triangle_error(rule, p, degree + 1 - p))
                .fold(0.0, f64::max);
            assert!(
                missed > 1e-7,
                "degree {degree} rule is better than it says: {missed:e}"
            );
        }
    }
}
