//! Wear particles stay in the oil and abrade.
//!
//! ```text
//! f = 1 + B (V/V_ref)/(1 + V/V_s)        V mm³ worn off both members since the last oil change; V_s → ∞: linear
//! ```

use crate::effects::{Card, Effect, Form, Hook, Local, Param, Prior};

/// Spread of what is thought beforehand of anything per worn volume: tests of small gears wear off a hundredth of what those of large
/// ones do.
const VOLUMES: f64 = 8.0;

pub(super) const CARD: Card = Card {
    name: "debris_abrasion",
    hook: Hook::WearFactor,
    formula: "wear_factor = 1 + amplitude*worn_volume/reference_volume/(1 + worn_volume/saturation_volume)",
    source: "wear by loose particles: E. Rabinowicz, L.A. Dunn, P.G. Russell, Wear 4 (1961) 345-355; growth with the concentration of particles: J.J. Fitzsimmons, H.D. Clevenger, Contaminated lubricants and tapered roller bearing wear, ASLE Trans. 20 (1977) 97-107 (abstract read). Proportional to the concentration is the simplest such law; saturation represents settling or a filter.",
    signature: "depth over cycles bends upwards on both members alike; in an unchanged shape; falls back after an oil change",
    confounded_with: &["lubricant_ageing", "surface_layer", "running_in"],
    separated_by: "an oil change or a filter: a break in the slope; a particle count",
    left_out: "where the particles go: their number follows the volume worn, alike at every place of both flanks",
    needs: &[],
    params: &[
        Param::new(
            "amplitude",
            "-",
            "relative growth of wear by the reference volume",
            1.0,
            (0.0, 1e4),
            Prior::LogNormal {
                median: 1.0,
                spread: VOLUMES,
            },
        )
        .neutral(0.0),
        Param::new(
            "reference_volume",
            "mm3",
            "worn volume to which the amplitude refers",
            100.0,
            (1e-3, 1e6),
            Prior::LogNormal {
                median: 100.0,
                spread: 3.0,
            },
        )
        .fixed(),
        Param::new(
            "saturation_volume",
            "mm3",
            "worn volume at which half the limit is reached; inf is linear",
            f64::INFINITY,
            (1e-3, f64::INFINITY),
            Prior::LogNormal {
                median: 100.0,
                spread: VOLUMES,
            },
        )
        .fixed(),
    ],
    forms: &[Form {
        name: "saturating",
        settings: &[("saturation_volume", 30.0)],
        frees: &["saturation_volume"],
        ..Form::PLAIN
    }],
    build: |p| {
        Box::new(DebrisAbrasion {
            amplitude: p[0],
            reference_volume: p[1],
            saturation_volume: p[2],
        })
    },
};

struct DebrisAbrasion {
    amplitude: f64,
    reference_volume: f64,
    saturation_volume: f64,
}

impl Effect for DebrisAbrasion {
    fn is_even(&self) -> bool {
        true
    }

    fn wear_factor(&self, at: &Local) -> f64 {
        1.0 + self.amplitude * at.worn_volume
            / self.reference_volume
            / (1.0 + at.worn_volume / self.saturation_volume)
    }
}
