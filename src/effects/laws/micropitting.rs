//! Micropitting: fatigue of the asperities takes material whatever the sliding.
//!
//! ```text
//! Δh = c (min(p_max, 2000 MPa)/p_ref)^q max(0, 1 − λ/λ_c) g     µm per 1e6 contacts of that member
//! g  = 1 + γ where the flank slides against its rolling (dedendum), 1 elsewhere
//! ```

use crate::effects::{Card, Effect, Form, Hook, Local, Param, ParamRole, Prior};

/// Pressure beyond which the damage no longer grows, MPa: steel yields.
const CAP: f64 = 2000.0;

pub(super) const CARD: Card = Card {
    name: "micropitting",
    hook: Hook::AddedDepth,
    formula: "added_depth = rate*1e-6*(min(p_max, 2000)/reference_pressure)^exponent*max(0, 1 - film_ratio/lambda_c)*(1 + asymmetry*dedendum)*(1 - step(onset - contacts))",
    source: "that micropitting goes with pressure and a low specific film thickness: ISO/TS 6336-22:2018 (scope and method read of, not its text); profile deviations of 7.5 to 20 µm in the FZG micropitting test, FVA information sheet 54. The power law and the linear film term are a parametric form, not a formula of either.",
    signature: "loss at and just below the pitch line; dedendum of both members; a high power of the load; base wear gives none there",
    confounded_with: &["roughness_polish", "plastic_deformation", "corrosive_loss", "pressure_exponent"],
    separated_by: "the depth at the pitch line over cycles; the unloaded flank; pictures of the flank",
    left_out: "cracks and their growth: a mean rate of loss by pressure and film ratio",
    needs: &[],
    params: &[
        Param::new("rate", "um per 1e6 contacts", "depth at the reference pressure without a film", 3.0, (0.0, 1000.0), Prior::LogNormal { median: 5.0, spread: 3.0 }).neutral(0.0),
        Param::new("exponent", "-", "power of the peak pressure", 4.0, (0.5, 15.0), Prior::Uniform { low: 2.0, high: 8.0 }).role(ParamRole::PressureSharpness),
        Param::new("reference_pressure", "MPa", "peak pressure at which the depth is the rate", 1000.0, (100.0, 1e4), Prior::LogNormal { median: 1000.0, spread: 1.5 }).fixed(),
        Param::new("onset", "contacts", "contacts of that member before it begins", 0.0, (0.0, 1e9), Prior::HalfNormal { sd: 1e6 }).fixed(),
        Param::new("lambda_c", "-", "film ratio above which there is none; inf: the film does not matter (finite needs [lubricant])", f64::INFINITY, (0.05, f64::INFINITY), Prior::LogNormal { median: 0.6, spread: 1.6 }).fixed(),
        Param::new("asymmetry", "-", "excess in the dedendum", 0.0, (0.0, 5.0), Prior::HalfNormal { sd: 0.5 }).fixed(),
    ],
    forms: &[
        Form {
            name: "more in the dedendum",
            frees: &["asymmetry"],
            grown: &[&[0.5]],
            ..Form::PLAIN
        },
        Form {
            name: "under a thin film",
            settings: &[("lambda_c", 0.6)],
            frees: &["lambda_c", "asymmetry"],
            grown: &[&[0.5, 0.3], &[1.0, 0.3], &[2.0, 0.3]],
            ..Form::PLAIN
        },
    ],
    build: |p| Box::new(Micropitting { rate: p[0], exponent: p[1], reference_pressure: p[2], onset: p[3], lambda_c: p[4], asymmetry: p[5] }),
};

struct Micropitting {
    rate: f64,
    exponent: f64,
    reference_pressure: f64,
    lambda_c: f64,
    asymmetry: f64,
    onset: f64,
}

impl Effect for Micropitting {
    fn added_depth(&self, at: &Local) -> f64 {
        if at.contacts < self.onset {
            return 0.0;
        }
        let pressure = (at.peak_pressure.min(CAP) / self.reference_pressure).powf(self.exponent);
        let film = (1.0 - at.film_ratio / self.lambda_c).max(0.0);
        let side = if at.dedendum() {
            1.0 + self.asymmetry
        } else {
            1.0
        };
        self.rate * 1e-6 * pressure * film * side
    }
}
