//! Surface deflection of an elastic half plane under piecewise linear pressure, weighted by the same hats.
//!
//! ```text
//! w(x) = −2/(π E*) ∫ p(t) ln|x − t| dt + const        W_kl = −2/(π E*) ∬ N_k(x) N_l(t) ln|x − t| dt dx
//! ```
//! Johnson, Contact Mechanics (1985), Eq. (2.25) for the kernel. The constant of the plane problem depends on how the body
//! is held far away; it adds c·L_k L_l to W_kl, which a given load turns into a constant displacement, so pressures under
//! a given load do not depend on it.
//!
//! The double integral is exact: two derivatives of each hat are point values (and a slope where a hat is cut off at the
//! end of the grid), and ln|z| is the fourth derivative of z⁴/24 (ln|z| − 25/12). For hats far apart that form loses
//! digits; there the integrand is smooth and Gauss's rule takes over.

use std::f64::consts::FRAC_2_PI;

use nalgebra::DMatrix;

use super::half_plane::strip_influence;

/// Weighted compliance of the hats on the nodes `x` (ascending, mm) for the contact modulus `modulus` (E*, MPa), mm³/N.
///
/// Hats at both ends of the grid are halves: the pressure may jump to zero there, as under a flat punch. `reference` (mm)
/// is the length in ln|z/reference|: it fixes the free constant and must exceed the extent of the grid for W to be
/// positive definite.
pub fn weighted_compliance(x: &[f64], modulus: f64, reference: f64) -> DMatrix<f64> {
    let scale = -2.0 / (std::f64::consts::PI * modulus);
    let hats: Vec<Hat> = (0..x.len()).map(|k| Hat::new(x, k)).collect();
    let shift = reference.ln();
    let mut w = DMatrix::zeros(x.len(), x.len());
    for l in 0..x.len() {
        for k in 0..=l {
            let kernel =
                hats[k].log_integral(&hats[l]) - shift * hats[k].length() * hats[l].length();
            w[(k, l)] = scale * kernel;
            w[(l, k)] = w[(k, l)];
        }
    }
    w
}

/// Eigenvalues ν_n of −∫ ln|x − t| φ dt = ν φ + const with ∫ φ = 0 on (−1, 1), the largest `count`, descending.
///
/// Panels of constant pressure as in [`PunchWear`](super::punch_wear::PunchWear), `panels` of them (even), but only the
/// largest by subspace iteration on each parity, so thousands of panels are cheap. Odd and even modes alternate.
/// They are the relaxation numbers of the pressure under a wearing flat punch: mode n decays as exp(−π k E* s/(2 a ν_n)).
pub fn punch_eigenvalues(panels: usize, count: usize) -> Vec<f64> {
    let half = panels / 2;
    let h = 2.0 / panels as f64;
    // a contact modulus of 2/π leaves the bare kernel −ln
    let influence: Vec<f64> = (0..panels)
        .map(|d| strip_influence(d as f64 * h, h, FRAC_2_PI))
        .collect();
    let mut all: Vec<f64> = [-1.0, 1.0]
        .into_iter()
        .flat_map(|parity| {
            // unknowns of the right half; the left half mirrors them with the parity
            let matrix = DMatrix::from_fn(half, half, |i, j| {
                influence[i.abs_diff(j)] + parity * influence[i + j + 1]
            });
            largest_eigenvalues(&matrix, count.div_ceil(2), parity > 0.0)
        })
        .collect();
    all.sort_by(|a, b| b.total_cmp(a));
    all.truncate(count);
    all
}

/// Largest eigenvalues of a symmetric matrix by subspace iteration; `balanced` restricts it to vectors of zero sum.
fn largest_eigenvalues(matrix: &DMatrix<f64>, count: usize, balanced: bool) -> Vec<f64> {
    let n = matrix.nrows();
    let size = count + 6;
    let project = |v: &mut DMatrix<f64>| {
        if balanced {
            for mut column in v.column_iter_mut() {
                let mean = column.mean();
                column.add_scalar_mut(-mean);
            }
        }
    };
    let mut basis = DMatrix::from_fn(n, size, |i, j| {
        ((j + 1) as f64 * std::f64::consts::PI * (i as f64 + 0.5) / n as f64 / 2.0).sin()
    });
    let mut values: Vec<f64> = Vec::new();
    for _ in 0..200 {
        project(&mut basis);
        let q = basis.qr().q();
        let mut image = matrix * &q;
        project(&mut image);
        let rayleigh = (q.transpose() * &image).symmetric_eigen();
        let mut next: Vec<f64> = rayleigh.eigenvalues.iter().copied().collect();
        next.sort_by(|a, b| b.total_cmp(a));
        next.truncate(count);
        let settled = values.len() == count
            && values
                .iter()
                .zip(&next)
                .all(|(a, b)| (a - b).abs() < 1e-12 * b.abs());
        values = next;
        if settled {
            break;
        }
        basis = image;
    }
    values
}

/// One hat: its second derivative as point values and, at the ends of the grid, a point slope.
struct Hat {
    /// (place, weight, order of the derivative of the delta: 0 or 1).
    parts: [(f64, f64, u8); 4],
    count: usize,
    low: f64,
    peak: f64,
    high: f64,
}

impl Hat {
    fn new(x: &[f64], k: usize) -> Self {
        let last = x.len() - 1;
        let (low, peak, high) = (x[k.saturating_sub(1)], x[k], x[(k + 1).min(last)]);
        let mut hat = Self {
            parts: [(0.0, 0.0, 0); 4],
            count: 0,
            low,
            peak,
            high,
        };
        if low < peak {
            let slope = 1.0 / (peak - low);
            hat.push(low, slope, 0);
            hat.push(peak, -slope, 0);
        } else {
            // the jump from 0 to 1 at the left end
            hat.push(peak, 1.0, 1);
        }
        if peak < high {
            let slope = 1.0 / (high - peak);
            hat.push(peak, -slope, 0);
            hat.push(high, slope, 0);
        } else {
            hat.push(peak, -1.0, 1);
        }
        hat
    }

    fn push(&mut self, place: f64, weight: f64, order: u8) {
        self.parts[self.count] = (place, weight, order);
        self.count += 1;
    }

    fn length(&self) -> f64 {
        0.5 * (self.high - self.low)
    }

    /// ∬ N(x) M(t) ln|x − t| dt dx.
    fn log_integral(&self, other: &Self) -> f64 {
        let distance = (other.low - self.high).max(self.low - other.high);
        if distance > FAR * self.length().max(other.length()) {
            return self.smooth_log_integral(other);
        }
        let mut sum = 0.0;
        for &(x, a, i) in &self.parts[..self.count] {
            for &(t, b, j) in &other.parts[..other.count] {
                // ∫ δ' f = −f'(place); the derivative by t changes the sign once more
                let sign = if i == 1 { -1.0 } else { 1.0 };
                sum += sign * a * b * fourth_antiderivative(x - t, i + j);
            }
        }
        sum
    }

    fn smooth_log_integral(&self, other: &Self) -> f64 {
        let mut sum = 0.0;
        for (x, a) in self.gauss() {
            for (t, b) in other.gauss() {
                sum += a * b * (x - t).abs().ln();
            }
        }
        sum
    }

    /// Points and weights (hat included) of Gauss's rule with four points on each flank of the hat.
    fn gauss(&self) -> impl Iterator<Item = (f64, f64)> {
        let (low, peak, high) = (self.low, self.peak, self.high);
        GAUSS.into_iter().flat_map(move |(u, w)| {
            [
                (low + u * (peak - low), w * u * (peak - low)),
                (high - u * (high - peak), w * u * (high - peak)),
            ]
        })
    }
}

/// Hats farther apart than this many half lengths are integrated by Gauss's rule.
const FAR: f64 = 8.0;

/// Four-point Gauss rule on (0, 1).
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// F with F'''' = ln|z|, or its first or second derivative.
fn fourth_antiderivative(z: f64, derivative: u8) -> f64 {
    if z == 0.0 {
        return 0.0;
    }
    let ln = z.abs().ln();
    match derivative {
        0 => z.powi(4) / 24.0 * (ln - 25.0 / 12.0),
        1 => z.powi(3) / 6.0 * (ln - 11.0 / 6.0),
        _ => z * z / 2.0 * (ln - 1.5),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn agrees_with_brute_force_quadrature() {
        // claim: both branches equal a midpoint double sum; tolerance from that sum's own error near the singularity
        let x = [0.0, 0.1, 0.25, 0.3, 0.45, 3.0, 3.2];
        let w = weighted_compliance(&x, 2.0 / PI, 1.0);
        let m = 3000;
        let hat = |k: usize, z: f64| {
            let left = if k > 0 {
                (z - x[k - 1]) / (x[k] - x[k - 1])
            } else {
                f64::INFINITY
            };
            let right = if k + 1 < x.len() {
                (x[k + 1] - z) / (x[k + 1] - x[k])
            } else {
                f64::INFINITY
            };
            left.min(right).clamp(0.0, 1.0)
        };
        for (k, l) in [(0, 0), (0, 1), (1, 1), (1, 3), (6, 6), (0, 6), (2, 6)] {
            let span = |k: usize| (x[k.saturating_sub(1)], x[(k + 1).min(x.len() - 1)]);
            let ((a, b), (c, d)) = (span(k), span(l));
            let (hx, ht) = ((b - a) / f64::from(m), (d - c) / f64::from(m + 1));
            let mut sum = 0.0;
            for i in 0..m {
                let z = a + hx * (f64::from(i) + 0.5);
                let outer = hat(k, z);
                let inner: f64 = (0..=m)
                    .map(|j| c + ht * (f64::from(j) + 0.5))
                    .map(|t| hat(l, t) * (z - t).abs().max(1e-300).ln())
                    .sum();
                sum -= outer * inner * hx * ht;
            }
            assert!(
                (w[(k, l)] - sum).abs() < 1e-3 * sum.abs().max(1e-3),
                "{k} {l}: {} against {sum}",
                w[(k, l)]
            );
        }
    }

    #[test]
    fn hertz_pressure_deflects_to_a_parabola() {
        // w(0) − w(x) = x²/2R inside the contact; Johnson (1985), section 4.2(c)
        let (modulus, radius, load) = (109.89, 4.0, 10.0);
        let a = super::super::hertz_line::half_width(load, radius, modulus);
        let p0 = 2.0 * load / (PI * a);
        let x: Vec<f64> = (-200..=200).map(|i| a * f64::from(i) / 200.0).collect();
        let p: Vec<f64> = x
            .iter()
            .map(|x| p0 * (1.0 - (x / a).powi(2)).max(0.0).sqrt())
            .collect();
        let w = weighted_compliance(&x, modulus, 4.0 * a) * nalgebra::DVector::from_vec(p);
        let h = a / 200.0;
        for k in [120usize, 250, 320] {
            let drop = (w[200] - w[k]) / h;
            let expected = x[k] * x[k] / (2.0 * radius);
            assert!(
                (drop / expected - 1.0).abs() < 2e-3,
                "{drop} against {expected} at {}",
                x[k]
            );
        }
    }

    #[test]
    fn punch_modes_relax_as_known() {
        // odd mode of a rigid tilt and the first even mode; coarse panels, so 0.1 %
        let nu = punch_eigenvalues(200, 4);
        for (n, expected) in [1.56600, 0.90973, 0.61296, 0.47394].into_iter().enumerate() {
            assert!(
                (nu[n] / expected - 1.0).abs() < 4e-3,
                "{} against {expected}",
                nu[n]
            );
        }
    }
}
