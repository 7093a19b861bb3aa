//! Friction takes part in the torque balance.
//!
//! ```text
//! T1 = Σ F_i (r_b1 ± µ ρ1_i)        − in approach, + in recess: loads are higher before the pitch point than after it
//! f  = r_b1/(r_b1 ± µ ρ1)
//! ```
//! The lever is kept above a twentieth of the base radius. At the pitch point itself nothing slides and f = 1.

use crate::effects::{Card, Effect, Hook, Local, Param, Prior};
use crate::tribology::friction::force_arm;

pub(super) const CARD: Card = Card {
    name: "friction_load",
    hook: Hook::LoadFactor,
    formula: "load_factor = base_radius/max(base_radius + (1 - 2*approach)*step(abs(s))*coefficient*rho1, base_radius/20)",
    source: "moments of normal and friction force about the pinion's centre; Coulomb friction with the direction of sliding. Statics, checked by hand in the tests.",
    signature: "a small step of the load at the pitch point; of 2 mu rho1/r_b1, in the transmission error too; very weak in wear",
    confounded_with: &["approach_recess"],
    separated_by: "measured torque loss; reversed drive",
    needs: &[],
    params: &[Param::new(
        "coefficient",
        "-",
        "coefficient of friction",
        0.06,
        (0.0, 1.0),
        Prior::LogNormal {
            median: 0.06,
            spread: 1.8,
        },
    )
    .neutral(0.0)],
    forms: &[],
    build: |p| Box::new(FrictionLoad { coefficient: p[0] }),
};

struct FrictionLoad {
    coefficient: f64,
}

impl Effect for FrictionLoad {
    fn load_factor(&self, at: &Local) -> f64 {
        let recess = if at.approach {
            -at.path.abs()
        } else {
            at.path.abs()
        };
        let arm = force_arm(at.base_radius, recess, at.curvature[0], self.coefficient);
        at.base_radius / arm.max(at.base_radius / 20.0)
    }
}
