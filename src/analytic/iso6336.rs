//! Tooth stiffness of steel gears by the formula of ISO 6336-1 (method B), to judge finite-element values by.
//!
//! ```text
//! q'  = 0.04723 + 0.15551/z1 + 0.25791/z2 − 0.00635 x1 − 0.11654 x1/z1 − 0.00193 x2 − 0.24188 x2/z2
//!       + 0.00529 x1² + 0.00182 x2²                                   mm µm/N
//! c'th = 1/q'                                                          single pair, theoretical
//! c'   = 0.8 c'th C_R C_B cos β                                        single pair
//! C_B  = [1 + 0.5 (1.2 − h_fP)] [1 − 0.02 (20 − α)]                    basic rack, α in degrees
//! c_γ  = c' (0.75 ε_α + 0.25)                                          mean over the mesh cycle
//! E/E_St,  E = 2 E1 E2/(E1 + E2)                                       factor on stiffness for other materials than steel
//! ```
//! All in N/(mm µm). The 0.8 corrects theory to measured teeth; hub and rim flexibility is left out (C_R = 1, solid discs).

/// Young's modulus E_St of the steel that the formula holds for, MPa (ISO 6336-1).
const STEEL: f64 = 206_000.0;

/// Factor E/E_St on all stiffnesses for members with Young's moduli E1 and E2 (MPa).
///
/// ```text
/// E/E_St = 2 E1 E2 / [(E1 + E2) E_St]                ISO 6336-1:2006, gear pairs of other materials
/// ```
/// It is exact for two members of equal shape in series; the standard's figures with it are 0.74 for steel on grey cast iron
/// and 0.59 for grey cast iron on itself.
pub fn material_factor(youngs_moduli: [f64; 2]) -> f64 {
    let [first, second] = youngs_moduli;
    2.0 / (1.0 / first + 1.0 / second) / STEEL
}

/// Number of teeth z_n of the spur gear that stands for a helical one in its normal section, helix angles in rad:
///
/// ```text
/// z_n = z/(cos² β_b cos β)                           ISO 6336-1; z for spur gears
/// ```
pub fn virtual_teeth(teeth: f64, helix: f64, base_helix: f64) -> f64 {
    teeth / (base_helix.cos().powi(2) * helix.cos())
}

/// A gear pair as the formula sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToothPair {
    /// Numbers of teeth (virtual ones, z_n, for helical gears).
    pub teeth: [f64; 2],
    /// Profile shift coefficients.
    pub profile_shift: [f64; 2],
    /// Dedendum of the basic rack h_fP, in modules (the mean of both gears).
    pub dedendum: f64,
    /// Normal pressure angle, deg.
    pub pressure_angle_deg: f64,
    /// Helix angle, deg.
    pub helix_angle_deg: f64,
    /// Gear blank factor C_R; 1 for solid discs.
    pub blank: f64,
}

impl ToothPair {
    /// A spur pair of solid discs without profile shift, rack with h_fP = 1.25 and 20°.
    pub fn spur(pinion: u32, gear: u32) -> Self {
        Self {
            teeth: [f64::from(pinion), f64::from(gear)],
            profile_shift: [0.0; 2],
            dedendum: 1.25,
            pressure_angle_deg: 20.0,
            helix_angle_deg: 0.0,
            blank: 1.0,
        }
    }

    /// Theoretical stiffness of one pair c'th, N/(mm µm).
    pub fn theoretical(&self) -> f64 {
        let ([z1, z2], [x1, x2]) = (self.teeth, self.profile_shift);
        let q = 0.04723 + 0.15551 / z1 + 0.25791 / z2
            - 0.00635 * x1
            - 0.11654 * x1 / z1
            - 0.00193 * x2
            - 0.24188 * x2 / z2
            + 0.00529 * x1 * x1
            + 0.00182 * x2 * x2;
        1.0 / q
    }

    /// Stiffness of one pair c', N/(mm µm).
    pub fn single(&self) -> f64 {
        let rack =
            (1.0 + 0.5 * (1.2 - self.dedendum)) * (1.0 - 0.02 * (20.0 - self.pressure_angle_deg));
        0.8 * self.theoretical() * self.blank * rack * self.helix_angle_deg.to_radians().cos()
    }

    /// Mean mesh stiffness c_γ, N/(mm µm), for a transverse contact ratio (1.2 or more, says the standard).
    pub fn mesh(&self, contact_ratio: f64) -> f64 {
        self.single() * (0.75 * contact_ratio + 0.25)
    }
}
