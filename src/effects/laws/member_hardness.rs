//! Members of unequal hardness wear unequally.
//!
//! ```text
//! k1 = k exp(δ/2),   k2 = k exp(−δ/2)        δ = ln(k1/k2), about ln(H2/H1)
//! ```

use crate::effects::{Card, Effect, Hook, Local, Param, Prior};
use crate::gear::Member;

pub(super) const CARD: Card = Card {
    name: "member_hardness",
    hook: Hook::WearFactor,
    formula: "wear_factor = exp((pinion - 0.5)*log_ratio)",
    source: "Archard's law with k = K/H for each member (J.F. Archard, J. Appl. Phys. 24 (1953) 981-988), split evenly in the logarithm so that k stays the mean.",
    signature: "the ratio of pinion to gear wear is off, both shapes are right",
    confounded_with: &[],
    separated_by: "measuring both members; exchanging the materials. A mistaken tooth ratio or biased weighing looks the same",
    left_out: "nothing: it is one ratio of two coefficients",
    needs: &[],
    params: &[Param::new(
        "log_ratio",
        "-",
        "logarithm of the pinion's over the gear's wear coefficient",
        0.4,
        (-5.0, 5.0),
        Prior::Normal { mean: 0.0, sd: 0.5 },
    )
    .neutral(0.0)],
    forms: &[],
    build: |p| {
        Box::new(MemberHardness {
            factors: [(0.5 * p[0]).exp(), (-0.5 * p[0]).exp()],
        })
    },
};

struct MemberHardness {
    factors: [f64; 2],
}

impl Effect for MemberHardness {
    fn is_even(&self) -> bool {
        true
    }

    fn wear_factor(&self, at: &Local) -> f64 {
        self.factors[usize::from(at.member == Member::Gear)]
    }
}
