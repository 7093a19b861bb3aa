//! Flash temperature: how much friction heats the contact above the bulk of the teeth.
//!
//! ```text
//! ΔT  = 1.11 µ w |√u1 − √u2| / (B_M √(2 a_H))        B_M = √(k ρ c), like materials
//! T_c = T_bulk + ΔT
//! ```
//! H. Blok (1937), the form of ISO/TS 6336-20; fast-moving surfaces (the contact passes before heat can spread sideways) and
//! the heat spread as the Hertz pressure.

/// A sliding line contact as a heat source.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeatSource {
    /// Load per width w, N/mm.
    pub load: f64,
    /// Coefficient of friction µ.
    pub friction: f64,
    /// Rolling speeds u1, u2 of both surfaces, mm/s.
    pub rolling: [f64; 2],
    /// Half width of the contact a_H, mm.
    pub half_width: f64,
}

/// Largest rise of the surface temperature in the contact, K; `contact_coefficient` is B_M in N/(m s^½ K).
pub fn flash_rise(source: &HeatSource, contact_coefficient: f64) -> f64 {
    if source.half_width <= 0.0 {
        return 0.0;
    }
    let metres = 1e-3;
    let speeds = source.rolling.map(|u| (u.max(0.0) * metres).sqrt());
    let load = source.load / metres;
    1.11 * source.friction * load * (speeds[0] - speeds[1]).abs()
        / (contact_coefficient * (2.0 * source.half_width * metres).sqrt())
}

/// Thermal contact coefficient B_M = √(k ρ c), N/(m s^½ K): conductivity W/(m K), density kg/m³, specific heat J/(kg K).
pub fn contact_coefficient(conductivity: f64, density: f64, specific_heat: f64) -> f64 {
    (conductivity * density * specific_heat).sqrt()
}
