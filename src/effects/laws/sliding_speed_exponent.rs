//! Wear per sliding distance that depends on the sliding speed.
//!
//! ```text
//! f = (max(v, 0.02 m/s)/v_ref)^n
//! ```

use crate::effects::{Card, Effect, Hook, Local, Param, Prior};

pub(super) const CARD: Card = Card {
    name: "sliding_speed_exponent",
    hook: Hook::WearFactor,
    formula: "wear_factor = (max(v_slide, 0.02)/reference_speed)^exponent",
    source: "generalised Archard law with a power of the speed, after S.K. Rhee, Wear 16 (1970) 431-445 (W = K P^a v^b t^c; not re-read). The floor at 0.02 m/s is ours: at the pitch point the width of the contact still slides.",
    signature: "wear near the pitch point off against the ends of the flank; below 0 more, above 0 less; scales with the speed of the test",
    confounded_with: &["film_thickness", "oxidative", "flash_temperature"],
    separated_by: "the shape along the flank within one test",
    left_out: "a cause: an empirical power of the sliding speed",
    needs: &[],
    params: &[
        Param::new(
            "exponent",
            "-",
            "power n of the sliding speed; 0 is Archard's law",
            -0.3,
            (-2.0, 2.0),
            Prior::Normal { mean: 0.0, sd: 0.5 },
        )
        .neutral(0.0),
        Param::new(
            "reference_speed",
            "m/s",
            "sliding speed at which the factor is 1",
            1.0,
            (0.01, 100.0),
            Prior::LogNormal {
                median: 1.0,
                spread: 2.0,
            },
        )
        .fixed(),
    ],
    forms: &[],
    build: |p| {
        Box::new(SlidingSpeedExponent {
            exponent: p[0],
            reference_speed: p[1],
        })
    },
};

struct SlidingSpeedExponent {
    exponent: f64,
    reference_speed: f64,
}

impl Effect for SlidingSpeedExponent {
    fn is_even(&self) -> bool {
        true
    }

    fn wear_factor(&self, at: &Local) -> f64 {
        (at.floored_sliding() / self.reference_speed).powf(self.exponent)
    }
}
