//! Wear by dissipated energy: the coefficient follows the local friction.
//!
//! ```text
//! dh = K_e µ(s) p v dt,   so k is multiplied by (µ/µ_ref)^n with n = 1        µ(s) the local coefficient of friction
//! ```

use crate::effects::{Card, Effect, Hook, Local, Param, Prior};

pub(super) const CARD: Card = Card {
    name: "energy_wear",
    hook: Hook::WearFactor,
    formula: "wear_factor = (max(friction, 0.0001)/reference_friction)^exponent",
    source: "wear proportional to the work of friction: S. Fouvry and others (fretting; not re-read). Friction: the mean tooth friction formula as in ISO/TR 14179-2, taken locally; Ra from the composite Rq as for Gaussian heights.",
    signature: "less wear where speed and radius are large, a mild change of shape; nothing at the pitch point",
    confounded_with: &["film_thickness", "approach_recess", "flash_temperature"],
    separated_by: "measured torque loss; speeds far apart",
    left_out: "heat: the work of friction acts through the coefficient alone",
    needs: &["lubricant.viscosity", "lubricant.roughness"],
    params: &[
        Param::new(
            "exponent",
            "-",
            "power of the friction coefficient; 1 is the energy law, 0 Archard's",
            1.0,
            (-3.0, 6.0),
            Prior::Normal { mean: 1.0, sd: 0.5 },
        )
        .neutral(0.0),
        Param::new(
            "reference_friction",
            "-",
            "coefficient of friction at which the factor is 1",
            0.06,
            (1e-3, 1.0),
            Prior::LogNormal {
                median: 0.06,
                spread: 1.5,
            },
        )
        .fixed(),
    ],
    forms: &[],
    build: |p| {
        Box::new(EnergyWear {
            exponent: p[0],
            reference_friction: p[1],
        })
    },
};

/// Friction below which the factor no longer changes.
const LEAST_FRICTION: f64 = 1e-4;

struct EnergyWear {
    exponent: f64,
    reference_friction: f64,
}

impl Effect for EnergyWear {
    fn is_even(&self) -> bool {
        true
    }

    fn wear_factor(&self, at: &Local) -> f64 {
        (at.friction.max(LEAST_FRICTION) / self.reference_friction).powf(self.exponent)
    }
}
