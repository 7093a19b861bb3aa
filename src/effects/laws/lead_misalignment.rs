//! The axes are not parallel: load is higher at one end of the face.
//!
//! Where contacts are solved the wedge stands between slices of the face that turn together, and wear closes it:
//!
//! ```text
//! e(η) = −F_βy η/2        µm missing along the path of contact; η = 2y/b from −1 to 1; F_βy > 0: η = 1 is the loaded end, < 0: η = −1 is
//! ```
//! The analytic model has one section; there the load is that of a rigid wedge on new flanks:
//!
//! ```text
//! X = F_βy c_γ/(2w)        F_βy µm over the face, c_γ N/(mm µm), w N/mm mean normal load
//! w(η)/w = 1 + η X − max(0, √|X| − 1)²      η = 2y/b from −1 to 1; |X| > 1: only part of the face carries
//! the loaded end: K_Hβ = 1 + |X| for |X| ≤ 1, 2√|X| beyond
//! ```
//! Which end is loaded, only traces off mid-face show: of means and of mid-face both signs of the slope are one.
//! That wear closes the gap is not in this law. The factor is kept above 0.05. The mean over the face is 1: of a trace that is a mean
//! the analytic model sees nothing.

use crate::effects::{Card, Effect, FaceAt, Form, Hook, Local, Param, Prior, UsualTrace};

pub(super) const CARD: Card = Card {
    name: "lead_misalignment",
    hook: Hook::LoadFactor,
    // of one section; by finite elements the wedge itself acts
    formula: "load_factor = face_mean + (1 - face_mean)*max(0.05, 1 + face_position*slope*mesh_stiffness/(2*max(normal_load, 0.001)) - max(0, sqrt(abs(slope)*mesh_stiffness/(2*max(normal_load, 0.001))) - 1)^2)",
    source: "linear bedding; at the loaded end it is K_Hbeta of ISO 6336-1 and DIN 3990-1, 1 + c F/(2 w) up to 2 and sqrt(2 c F/w) beyond, as two public codes quote them.",
    signature: "uneven wear across the face, most at low torque, that evens out with time; in one plane of analytic contact only a load factor; two face sections show it at once",
    confounded_with: &["pressure_exponent", "film_thickness", "roughness_polish", "shaft_deflection", "lead_crowning"],
    separated_by: "traces at two or more places of the face; two torques from shaft_deflection; nothing else if the wear coefficient scatters",
    left_out: "what a tooth carries over from slice to slice of the face, unless the study ties them; in the analytic model the gap that wear closes: one section with a factor on its load",
    needs: &[],
    params: &[
        Param::new("slope", "um", "gap between the ends of the face, unloaded; positive: the end at +face/2 is the loaded one", 6.0, (-200.0, 200.0), Prior::Normal { mean: 0.0, sd: 8.0 }).neutral(0.0),
        Param::new("mesh_stiffness", "N/(mm um)", "mesh stiffness, of the analytic model: by finite elements it follows from the teeth", 20.0, (0.1, 100.0), Prior::LogNormal { median: 20.0, spread: 1.2 }).fixed(),
        Param::new("face_position", "-", "place of traces whose row states no `face`, from the middle of the face, in half face widths", 1.0, (-1.0, 1.0), Prior::Uniform { low: -1.0, high: 1.0 }).fixed(),
        Param::either("face_mean", "1: traces whose row states no `face` are means over the face; 0: they are taken at `face_position`"),
    ],
    forms: &[Form {
        name: "mid-face",
        settings: &[("face_position", 0.0)],
        even: &["slope"],
        ..Form::PLAIN
    }, Form {
        name: "mean over the face",
        settings: &[("face_mean", 1.0)],
        even: &["slope"],
        ..Form::PLAIN
    }],
    build: |p| Box::new(LeadMisalignment { slope: p[0], mesh_stiffness: p[1], face_position: p[2], face_mean: p[3] }),
};

/// Least mean normal load, N/mm.
const LEAST_LOAD: f64 = 1e-3;

struct LeadMisalignment {
    slope: f64,
    mesh_stiffness: f64,
    face_position: f64,
    face_mean: f64,
}

impl Effect for LeadMisalignment {
    fn load_factor(&self, at: &Local) -> f64 {
        let x = self.slope * self.mesh_stiffness / (2.0 * at.normal_load.max(LEAST_LOAD));
        let open = (x.abs().sqrt() - 1.0).max(0.0);
        let share = 1.0 + self.face_position * x - open * open;
        self.face_mean + (1.0 - self.face_mean) * share.max(0.05)
    }

    fn lead(&self, at: &FaceAt) -> Option<f64> {
        Some(-0.5 * self.slope * at.place)
    }

    fn usual_trace(&self) -> Option<UsualTrace> {
        Some(UsualTrace {
            place: self.face_position,
            mean: self.face_mean,
        })
    }
}
