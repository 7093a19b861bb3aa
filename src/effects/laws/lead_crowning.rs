//! The flanks are crowned across the face: material is missing at both ends, and the middle carries more. Not the crowning of the profile, which is
//! `profile_form`.
//!
//! Where contacts are solved the crown stands between slices of the face, and wear takes it off:
//!
//! ```text
//! e(η) = C η²             µm missing along the path of contact; η = 2y/b from −1 to 1
//! ```
//! The analytic model has one section; there the load is that of a rigid crown on new flanks, on linear bedding:
//!
//! ```text
//! X = C c_γ/w             c_γ N/(mm µm), w N/mm mean normal load
//! w(η)/w = 1 + X (1/3 − η²)                              X ≤ 3/2: all of the face carries
//! w(η)/w = X max(0, a² − η²),  a³ = 3/(2X)               beyond: |η| < a carries
//! ```
//! Its mean over the face is 1. The factor is kept above 0.05.

use crate::effects::{Card, Effect, FaceAt, Form, Hook, Local, Param, Prior, UsualTrace};

pub(super) const CARD: Card = Card {
    name: "lead_crowning",
    hook: Hook::LoadFactor,
    // of one section; by finite elements the crown itself acts
    formula: "load_factor = face_mean + (1 - face_mean)*max(0.05, 1 + amount*mesh_stiffness/max(normal_load, 0.001)*(1/3 - face_position^2) + step(amount*mesh_stiffness/max(normal_load, 0.001) - 1.5)*(1.5^(2/3)*(amount*mesh_stiffness/max(normal_load, 0.001))^(1/3) - 1 - amount*mesh_stiffness/max(normal_load, 0.001)/3))",
    source: "linear bedding under a parabola (own derivation from the balance of forces); the shape is crowning, C_b, as ISO 21771 defines it.",
    signature: "more wear at mid-face than at its ends, most at low torque; it evens out with time; in one plane of analytic contact only a load factor",
    confounded_with: &["lead_misalignment", "shaft_deflection", "pressure_exponent", "film_thickness", "roughness_polish"],
    separated_by: "traces at mid-face and near an end: a wedge changes the two ends alike and the other way",
    left_out: "in the analytic model the gap that wear closes: one section with a factor on its load",
    needs: &[],
    params: &[
        Param::new("amount", "um", "material missing at both ends of the face, of both flanks together", 6.0, (0.0, 200.0), Prior::HalfNormal { sd: 8.0 }).neutral(0.0),
        Param::new("mesh_stiffness", "N/(mm um)", "mesh stiffness, of the analytic model: by finite elements it follows from the teeth", 20.0, (0.1, 100.0), Prior::LogNormal { median: 20.0, spread: 1.2 }).fixed(),
        Param::new("face_position", "-", "place of traces whose row states no `face`, from the middle of the face, in half face widths", 0.0, (-1.0, 1.0), Prior::Uniform { low: -1.0, high: 1.0 }).fixed(),
        Param::either("face_mean", "1: traces whose row states no `face` are means over the face; 0: they are taken at `face_position`"),
    ],
    forms: &[
        Form {
            name: "mean over the face",
            settings: &[("face_mean", 1.0)],
            ..Form::PLAIN
        },
        // the two ends are alike
        Form {
            name: "near an end",
            settings: &[("face_position", 0.8)],
            signature: "less wear at the ends of the face than k elsewhere says, most at low torque; it evens out with time",
            ..Form::PLAIN
        },
    ],
    build: |p| Box::new(LeadCrowning { amount: p[0], mesh_stiffness: p[1], face_position: p[2], face_mean: p[3] }),
};

/// Least mean normal load, N/mm.
const LEAST_LOAD: f64 = 1e-3;

struct LeadCrowning {
    amount: f64,
    mesh_stiffness: f64,
    face_position: f64,
    face_mean: f64,
}

impl Effect for LeadCrowning {
    fn load_factor(&self, at: &Local) -> f64 {
        let x = self.amount * self.mesh_stiffness / at.normal_load.max(LEAST_LOAD);
        let square = self.face_position.powi(2);
        // a² X where only part of the face carries
        let most = if x > 1.5 {
            1.5f64.powf(2.0 / 3.0) * x.cbrt()
        } else {
            1.0 + x / 3.0
        };
        let share = most - x * square;
        self.face_mean + (1.0 - self.face_mean) * share.max(0.05)
    }

    fn lead(&self, at: &FaceAt) -> Option<f64> {
        Some(self.amount * at.place * at.place)
    }

    fn usual_trace(&self) -> Option<UsualTrace> {
        Some(UsualTrace {
            place: self.face_position,
            mean: self.face_mean,
        })
    }
}
