//! The shaft bends under the tooth load, and its slope is a wedge across the face that grows with the load.
//!
//! ```text
//! φ = F a (L² − 4a²)/(6 E I L)      between two bearings L apart, a from their middle
//! φ = F a (2L + 3|a|)/(6 E I)       overhung by a beyond a bearing, the other one L farther on
//! I = π d⁴/64,  F normal force      both: Euler and Bernoulli's beam, simply supported, under one force
//! e(η) = −φ b η/2                   missing along the path of contact; η = 2y/b from −1 to 1; a > 0: η = 1 is the loaded end, < 0: η = −1 is
//! ```
//! The bending lies in the plane of action, as the force does. The analytic model has one section; there the load is that of a rigid wedge
//! as in `lead_misalignment`, with X = φ b c_γ/(2w): the same at every torque. The face width b there is F/w, that of the gears.

use std::f64::consts::PI;

use crate::effects::{
    Card, Effect, FaceAt, Form, Hook, Impossible, Local, Param, Prior, UsualTrace,
};

pub(super) const CARD: Card = Card {
    name: "shaft_deflection",
    hook: Hook::LoadFactor,
    // of one section; by finite elements the wedge itself acts
    formula: "load_factor = face_mean + (1 - face_mean)*max(0.05, 1 + face_position*500*((1 - overhung)*max(-span/2, min(offset, span/2))*(span^2 - 4*max(-span/2, min(offset, span/2))^2)/span + overhung*offset*(2*span + 3*abs(offset)))*64/(6*206000*pi*diameter^4)*min(5000, 1000*torque/(base_radius*max(normal_load, 0.001)))^2*mesh_stiffness - max(0, sqrt(abs(500*((1 - overhung)*max(-span/2, min(offset, span/2))*(span^2 - 4*max(-span/2, min(offset, span/2))^2)/span + overhung*offset*(2*span + 3*abs(offset)))*64/(6*206000*pi*diameter^4)*min(5000, 1000*torque/(base_radius*max(normal_load, 0.001)))^2*mesh_stiffness)) - 1)^2)",
    source: "closed forms of the simply supported beam with one force, between its supports and overhung (Roark's Formulas for Stress and Strain, beams); the wedge on linear bedding as ISO 6336-1 has it.",
    signature: "uneven wear across the face, hardly depending on the torque; it evens out with time; in one plane of analytic contact only a load factor, the same in every test",
    confounded_with: &["lead_misalignment", "lead_crowning", "pressure_exponent"],
    separated_by: "two torques: a wedge of the flanks matters most at low torque, one of the shaft at all alike; traces at two places of the face",
    left_out: "the curvature of the shaft over the face, its torsion and its shear; bearings are rigid; in the analytic model the gap that wear closes",
    needs: &[],
    params: &[
        Param::new("offset", "mm", "how far the gear is from mid-span, up to half the span, or overhangs the bearing; positive: the end at +face/2 is the loaded one", 10.0, (-500.0, 500.0), Prior::Normal { mean: 0.0, sd: 15.0 }).neutral(0.0),
        Param::new("span", "mm", "from bearing to bearing", 100.0, (1.0, 5000.0), Prior::LogNormal { median: 100.0, spread: 2.0 }).fixed(),
        Param::new("diameter", "mm", "of the steel shaft", 25.0, (0.5, 2000.0), Prior::LogNormal { median: 25.0, spread: 2.0 }).fixed(),
        Param::new("mesh_stiffness", "N/(mm um)", "mesh stiffness, of the analytic model: by finite elements it follows from the teeth", 20.0, (0.1, 100.0), Prior::LogNormal { median: 20.0, spread: 1.2 }).fixed(),
        Param::new("face_position", "-", "place of traces whose row states no `face`, from the middle of the face, in half face widths", 1.0, (-1.0, 1.0), Prior::Uniform { low: -1.0, high: 1.0 }).fixed(),
        Param::either("face_mean", "1: traces whose row states no `face` are means over the face; 0: they are taken at `face_position`"),
        Param::either("overhung", "1: the gear overhangs a bearing; 0: it is between two"),
    ],
    forms: &[Form {
        name: "mid-face",
        settings: &[("face_position", 0.0)],
        even: &["offset"],
        ..Form::PLAIN
    }, Form {
        name: "mean over the face",
        settings: &[("face_mean", 1.0)],
        even: &["offset"],
        ..Form::PLAIN
    }],
    build: |p| Box::new(ShaftDeflection {
        offset: p[0],
        span: p[1],
        bending_stiffness: STEEL * PI * p[2].powi(4) / 64.0,
        mesh_stiffness: p[3],
        trace: UsualTrace { place: p[4], mean: p[5] },
        overhung: p[6],
    }),
};

/// Least mean normal load, N/mm.
const LEAST_LOAD: f64 = 1e-3;
/// Widest face that a study may state, mm.
const WIDEST: f64 = 5000.0;
/// Young's modulus of the shaft, MPa.
const STEEL: f64 = 206_000.0;

struct ShaftDeflection {
    offset: f64,
    span: f64,
    /// E I, N mm².
    bending_stiffness: f64,
    mesh_stiffness: f64,
    trace: UsualTrace,
    overhung: f64,
}

impl ShaftDeflection {
    /// Slope of the shaft at the gear per normal force, 1/N.
    fn slope(&self) -> f64 {
        let (a, l) = (self.offset, self.span);
        // a fit may try what a study may not state: beyond the bearing the slope stays what it is there, zero
        let within = a.clamp(-0.5 * l, 0.5 * l);
        let between = within * (l * l - 4.0 * within * within) / l;
        let overhung = a * (2.0 * l + 3.0 * a.abs());
        let shape = (1.0 - self.overhung) * between + self.overhung * overhung;
        shape / (6.0 * self.bending_stiffness)
    }
}

impl Effect for ShaftDeflection {
    fn load_factor(&self, at: &Local) -> f64 {
        // the load is in the slope and in the bedding, and drops out
        let face_width = 1e3 * at.torque / (at.base_radius * at.normal_load.max(LEAST_LOAD));
        let face_width = face_width.min(WIDEST);
        let wedge = 1e3 * self.slope() * face_width * face_width;
        let x = 0.5 * wedge * self.mesh_stiffness;
        let open = (x.abs().sqrt() - 1.0).max(0.0);
        let share = (1.0 + self.trace.place * x - open * open).max(0.05);
        self.trace.mean + (1.0 - self.trace.mean) * share
    }

    fn lead(&self, at: &FaceAt) -> Option<f64> {
        let wedge = 1e3 * self.slope() * at.normal_force * at.width;
        Some(-0.5 * wedge * at.place)
    }

    fn usual_trace(&self) -> Option<UsualTrace> {
        Some(self.trace)
    }

    fn impossible(&self) -> Option<Impossible> {
        let half = 0.5 * self.span;
        (self.overhung == 0.0 && self.offset.abs() > half).then(|| Impossible {
            parameter: "offset",
            why: "lies beyond the bearing, where a gear between two bearings cannot stand",
            allowed: format!("{} to {half} mm: half of the span to either side", -half),
            hint: "a gear outside of the bearings is overhung = 1, its offset counted from the nearer bearing",
        })
    }
}
