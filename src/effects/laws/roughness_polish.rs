//! Asperities are cut down to a limit wherever the flank is touched, also at the pitch point.
//!
//! ```text
//! h = h_r (1 − exp(−n_c/N_p)),   so Δh = (h_r/N_p) exp(−n_c/N_p) per contact where p_max > 0
//! ```

use crate::effects::{Card, Effect, Hook, Local, Param, Prior};

pub(super) const CARD: Card = Card {
    name: "roughness_polish",
    hook: Hook::AddedDepth,
    formula: "added_depth = height/settling_contacts*exp(-contacts/settling_contacts)*step(p_max)",
    source: "truncation of the roughness in running-in, in the exponential form of C.A. Queener, T.C. Smith, W.L. Mitchell, Wear 8 (1965) 391-400, per contact instead of per sliding distance (title checked, equation not re-read). Heights up to the peak roughness Rp.",
    signature: "a flat offset over the active flank that saturates; also at the pitch point; hardly depends on torque; the gear lags by the tooth ratio",
    confounded_with: &[
        "corrosive_loss",
        "running_in",
        "micropitting",
        "plastic_deformation",
    ],
    separated_by: "early checkpoints; the inactive flank as a datum; the roughness itself. A single final trace of unknown level hides it",
    left_out: "asperities one by one, and the film: a loss that dies out with the contacts",
    needs: &[],
    params: &[
        Param::new(
            "height",
            "um",
            "height lost in the end",
            1.0,
            (0.0, 20.0),
            Prior::LogNormal {
                median: 1.0,
                spread: 2.0,
            },
        )
        .neutral(0.0),
        Param::new(
            "settling_contacts",
            "contacts",
            "contacts of that member in which the rest falls to 1/e",
            1e4,
            (10.0, 1e8),
            Prior::LogNormal {
                median: 2e4,
                spread: 5.0,
            },
        ),
    ],
    forms: &[],
    build: |p| {
        Box::new(RoughnessPolish {
            height: p[0],
            settling_contacts: p[1],
        })
    },
};

struct RoughnessPolish {
    height: f64,
    settling_contacts: f64,
}

impl Effect for RoughnessPolish {
    fn added_depth(&self, at: &Local) -> f64 {
        if at.peak_pressure <= 0.0 {
            return 0.0;
        }
        self.height / self.settling_contacts * (-at.contacts / self.settling_contacts).exp()
    }
}
