//! Coefficient of friction of lubricated gear flanks.

/// What the local coefficient depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flank {
    /// Load per width w, N/mm.
    pub load: f64,
    /// Sum of both rolling speeds, mm/s.
    pub rolling_sum: f64,
    /// Relative radius of curvature, mm.
    pub radius: f64,
    /// Dynamic viscosity at the oil temperature, Pa s.
    pub viscosity_pa_s: f64,
    /// Arithmetic mean roughness Ra of the flanks, µm.
    pub roughness_ra_um: f64,
    /// Lubricant factor X_L; 1 for mineral oils.
    pub lubricant: f64,
}

/// Local coefficient of friction.
///
/// ```text
/// µ = 0.048 (w/(v_Σ ρ))^0.2 η^−0.05 Ra^0.25 X_L        w N/mm, v_Σ m/s, ρ mm, η mPa s, Ra µm
/// ```
/// The mean tooth friction formula of the FZG literature, as in ISO/TR 14179-2, taken at one point of the path instead of
/// the pitch point. An empirical fit for lubricated steel gears; grows without bound as the speed goes to zero.
pub fn local_coefficient(flank: &Flank) -> f64 {
    let metres_per_second = flank.rolling_sum.abs() * 1e-3;
    let viscosity_mpa_s = flank.viscosity_pa_s * 1e3;
    0.048
        * (flank.load / (metres_per_second * flank.radius)).powf(0.2)
        * viscosity_mpa_s.powf(-0.05)
        * flank.roughness_ra_um.powf(0.25)
        * flank.lubricant
}

/// Arm of the contact force about the pinion centre, mm, with Coulomb friction: `r_b1 + sgn(s) µ ρ1`.
///
/// s mm from the pitch point along the path of contact (negative in approach, pinion driving), ρ1 mm the pinion's radius of
/// curvature there. The torque divided by the arm is the normal force: higher in approach, lower in recess. At the pitch
/// point itself nothing slides and the arm is the base radius.
pub fn force_arm(base_radius: f64, path: f64, rho: f64, friction: f64) -> f64 {
    let direction = if path == 0.0 { 0.0 } else { path.signum() };
    base_radius + direction * friction * rho
}
