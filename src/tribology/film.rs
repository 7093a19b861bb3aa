//! Thickness of the oil film of a line contact, and its ratio to the roughness.
//!
//! ```text
//! U = η0 u_m/(E'' R),   G = α_p E'',   W = w/(E'' R),   E'' = 2 E*
//! h_min = 2.65 R U^0.70 G^0.54 W^−0.13             minimum, Dowson and Higginson
//! h_c   = 1.95 R (U G)^(8/11) W^(−1/11)            central, Grubin's form as used for comparison
//! λ     = h_min/Rq
//! ```
//! D. Dowson, G. R. Higginson, Elasto-hydrodynamic Lubrication (1966); D. Dowson (1968) for line contacts. Isothermal, fully
//! flooded, Newtonian oil; [`inlet_heating_factor`] reduces both where the inlet warms up.

/// A lubricated line contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Film {
    /// Load per width w, N/mm.
    pub load: f64,
    /// Relative radius of curvature R, mm.
    pub radius: f64,
    /// Contact modulus E*, MPa (`1/E* = (1 − ν1²)/E1 + (1 − ν2²)/E2`; E'' is twice this).
    pub contact_modulus: f64,
    /// Entraining speed u_m, the mean of both rolling speeds, mm/s.
    pub entraining_speed: f64,
    /// Dynamic viscosity at the contact's inlet temperature η0, Pa s.
    pub viscosity_pa_s: f64,
    /// Pressure-viscosity coefficient α_p, 1/GPa.
    pub pressure_viscosity_per_gpa: f64,
}

impl Film {
    /// Minimum film thickness, mm.
    pub fn minimum(&self) -> f64 {
        let [u, g, w] = self.groups();
        2.65 * self.radius * u.powf(0.70) * g.powf(0.54) * w.powf(-0.13)
    }

    /// Central film thickness, mm.
    pub fn central(&self) -> f64 {
        let [u, g, w] = self.groups();
        1.95 * self.radius * (u * g).powf(8.0 / 11.0) * w.powf(-1.0 / 11.0)
    }

    /// Speed, material and load group U, G, W.
    pub fn groups(&self) -> [f64; 3] {
        let e = 2.0 * self.contact_modulus;
        let viscosity_mpa_s = self.viscosity_pa_s * 1e-6;
        let per_mpa = self.pressure_viscosity_per_gpa * 1e-3;
        [
            viscosity_mpa_s * self.entraining_speed.abs() / (e * self.radius),
            per_mpa * e,
            self.load / (e * self.radius),
        ]
    }
}

/// Film ratio λ of a film thickness in mm and a composite roughness Rq in µm.
pub fn film_ratio(thickness: f64, roughness_um: f64) -> f64 {
    thickness * 1e3 / roughness_um
}

/// Factor on the film thickness for heating of the inlet by shear.
///
/// ```text
/// φ_T = 1/(1 + 0.1 (1 + 14.8 S^0.83) L^0.64),   S = |v_s|/u_r,   L = β_η η0 u_r²/k_oil
/// ```
/// `slide_to_roll` is S, `thermal_loading` is L ([`thermal_loading`]); u_r is the sum of both rolling speeds.
pub fn inlet_heating_factor(slide_to_roll: f64, thermal_loading: f64) -> f64 {
    1.0 / (1.0 + 0.1 * (1.0 + 14.8 * slide_to_roll.abs().powf(0.83)) * thermal_loading.powf(0.64))
}

/// Thermal loading L of the inlet: temperature coefficient of viscosity β_η in 1/K, η0 in Pa s, the sum of both rolling
/// speeds in mm/s, conductivity of the oil in W/(m K).
pub fn thermal_loading(
    viscosity_slope_per_k: f64,
    viscosity_pa_s: f64,
    rolling_sum: f64,
    oil_conductivity: f64,
) -> f64 {
    let metres_per_second = rolling_sum * 1e-3;
    viscosity_slope_per_k * viscosity_pa_s * metres_per_second * metres_per_second
        / oil_conductivity
}
