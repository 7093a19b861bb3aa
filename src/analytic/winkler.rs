//! Wear on an elastic foundation (Winkler): pressure is K times local compression, so the wear problem has exact solutions.
//!
//! ```text
//! p = K (δ − g(x) − w),   dw/ds = k p,   ∫ p dx = F' constant
//! ```
//! K MPa/mm foundation modulus, k mm²/N, s mm sliding distance; forces per mm of width.

/// Pressure of a full contact of fixed width at a sliding distance s, MPa, whatever the initial shape.
///
/// ```text
/// p(x, s) − p̄ = [p(x, 0) − p̄] exp(−k K s),   p̄ = F'/(2a)
/// ```
pub fn full_contact_pressure(
    initial: f64,
    mean: f64,
    k: f64,
    foundation: f64,
    sliding: f64,
) -> f64 {
    mean + (initial - mean) * (-k * foundation * sliding).exp()
}

/// Largest step of explicit Euler that does not diverge, mm: `2/(k K)`; above half of it the solution oscillates.
pub fn stable_sliding(k: f64, foundation: f64) -> f64 {
    2.0 / (k * foundation)
}

/// A parabola (cylinder of radius R) on the foundation, growing in contact width as it wears.
///
/// ```text
/// a³ = a0³ (1 + τ),  τ = k K s,  a0³ = 3 F' R/(2K)        (no pressure and no wear at the edge)
/// δ  = a²/(2R)
/// dp(0)/dτ + p(0) = (2/3) p0 (1 + τ)^(−1/3),  p0 = K a0²/(2R)
/// w(0) = δ − p(0)/K
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parabola {
    /// Foundation modulus K, MPa/mm.
    pub foundation: f64,
    /// Radius R, mm.
    pub radius: f64,
    /// Load F', N/mm.
    pub load: f64,
    /// Specific wear coefficient k, mm²/N.
    pub k: f64,
}

impl Parabola {
    /// τ = k K s for a sliding distance in mm.
    pub fn dimensionless_sliding(&self, sliding: f64) -> f64 {
        self.k * self.foundation * sliding
    }

    /// Half width at a sliding distance, mm.
    pub fn half_width(&self, sliding: f64) -> f64 {
        let unworn = 1.5 * self.load * self.radius / self.foundation;
        (unworn * (1.0 + self.dimensionless_sliding(sliding))).cbrt()
    }

    /// Approach δ of the bodies, mm.
    pub fn approach(&self, sliding: f64) -> f64 {
        self.half_width(sliding).powi(2) / (2.0 * self.radius)
    }

    /// Pressure in the middle, MPa.
    pub fn centre_pressure(&self, sliding: f64) -> f64 {
        let unworn = self.foundation * self.approach(0.0);
        unworn * centre_pressure_ratio(self.dimensionless_sliding(sliding))
    }

    /// Depth worn in the middle, mm.
    pub fn centre_depth(&self, sliding: f64) -> f64 {
        self.approach(sliding) - self.centre_pressure(sliding) / self.foundation
    }
}

/// p(0)/p0 at τ.
///
/// ```text
/// q(τ) = e^−τ + (2/3) ∫0^τ e^−(τ−t) (1 + t)^(−1/3) dt
/// ```
/// The integral is taken by Gauss quadrature of order 10 on panels no longer than 1/4: exact to rounding.
pub fn centre_pressure_ratio(tau: f64) -> f64 {
    // What lies more than 45 before τ is below rounding.
    let start = (tau - 45.0).max(0.0);
    let panels = ((tau - start) / 0.25).ceil().max(1.0) as usize;
    let h = (tau - start) / panels as f64;
    // Gauss-Legendre, five points on (−1, 1): nodes and weights.
    let root = (10.0_f64 / 7.0).sqrt();
    let (inner, outer) = (
        (5.0 - 2.0 * root).sqrt() / 3.0,
        (5.0 + 2.0 * root).sqrt() / 3.0,
    );
    let (near, far) = (
        (322.0 + 13.0 * 70f64.sqrt()) / 900.0,
        (322.0 - 13.0 * 70f64.sqrt()) / 900.0,
    );
    let rule = [
        (0.0, 128.0 / 225.0),
        (inner, near),
        (-inner, near),
        (outer, far),
        (-outer, far),
    ];
    let mut integral = 0.0;
    for i in 0..panels {
        let middle = start + (i as f64 + 0.5) * h;
        for (x, weight) in rule {
            let t = middle + 0.5 * h * x;
            integral += 0.5 * h * weight * (t - tau).exp() * (1.0 + t).powf(-1.0 / 3.0);
        }
    }
    (-tau).exp() + 2.0 / 3.0 * integral
}

/// Half width that any smooth cylinder on a flat tends to when wear far exceeds elastic approach, mm.
///
/// ```text
/// pressure becomes uniform, F'/(2a):   a³ = (3/2) k F' R s,   δ = a²/(2R)
/// ```
/// Within 5 % once a exceeds three times its unworn value.
pub fn worn_half_width(k: f64, load: f64, radius: f64, sliding: f64) -> f64 {
    (1.5 * k * load * radius * sliding).cbrt()
}
