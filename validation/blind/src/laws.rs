//! The hidden causes, each with its strength first among its parameters: strength 0 is the base model.

use std::f64::consts::PI;

use crate::hidden::{Conditions, Hidden, Seen, Spot};
use crate::involute::Mating;

/// Whether the diagnosis may know the cause, and in this form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// In the catalogue, in its form.
    Single,
    /// In the catalogue, in another form.
    Foreign,
    /// Not in the catalogue.
    Outside,
}

#[derive(Clone, Debug)]
pub struct Law {
    /// Name in the catalogue (or our own, outside it).
    pub name: &'static str,
    pub form: &'static str,
    pub class: Class,
    pub parameters: Vec<(&'static str, f64)>,
    /// What the difference depends on most.
    pub drivers: &'static [&'static str],
    /// Largest |strength| that makes sense.
    pub limit: f64,
}

impl Law {
    pub fn strength(&self) -> f64 {
        self.parameters[0].1
    }
    pub fn with_strength(&self, v: f64) -> Self {
        let mut l = self.clone();
        l.parameters[0].1 = v;
        l
    }
    fn p(&self, k: usize) -> f64 {
        self.parameters[k].1
    }
    /// Material moves, it is not lost: weighing would not see it.
    pub fn moves_material(&self) -> bool {
        self.name == "plastic_deformation"
    }
}

fn logistic(x: f64) -> f64 {
    1.0 / (1.0 + (-x).exp())
}

fn slip(seen: &Seen) -> f64 {
    (seen.u[0] - seen.u[1]).abs()
}

/// Blok's flash temperature, K.
pub fn flash(load: f64, u: [f64; 2], half: f64, friction: f64) -> f64 {
    let contact = 13_000.0 * (2.0 * half * 1e-3).sqrt();
    1.11 * friction * load * 1e3 * (u[0].abs().sqrt() - u[1].abs().sqrt()).abs() / contact
}

/// Dowson and Higginson's minimum film over the roughness.
pub fn film(load: f64, curvature: f64, u: [f64; 2], e_star: f64, c: &Conditions) -> f64 {
    let e2 = 2.0 * e_star * 1e6;
    let r = curvature * 1e-3;
    let speed = c.viscosity * 0.5 * (u[0] + u[1]) / (e2 * r);
    let material = c.pressure_viscosity * 1e-9 * e2;
    let w = load.max(1e-6) * 1e3 / (e2 * r);
    2.65 * r * speed.powf(0.7) * material.powf(0.54) * w.powf(-0.13) * 1e6 / c.roughness
}

/// Coefficient of friction of ISO/TR 14179-2, its mean over the tooth taken at each contact: 0.048 (w/(v rho))^0.2 eta^-0.05 Ra^0.25 (N/mm, m/s, mm,
/// mPa s, um; v the sum of the rolling speeds). Ra is 0.8 of Rq for Gaussian heights, of one flank 1/sqrt(2).
pub fn mean_tooth_friction(load: f64, curvature: f64, u: [f64; 2], c: &Conditions) -> f64 {
    let rough = 0.8 * c.roughness / 2f64.sqrt();
    let speed = (u[0] + u[1]).max(0.02);
    let contact = (load / (speed * curvature)).powf(0.2);
    0.048 * contact * (1e3 * c.viscosity).powf(-0.05) * rough.powf(0.25)
}

/// Benedict and Kelley (1961) for smooth flanks: 0.0127 log10(29660 w/(eta v_sum v_slide^2)), N/mm, mPa s, m/s.
pub fn rolling_and_sliding(load: f64, u: [f64; 2], c: &Conditions) -> f64 {
    let sliding = (u[0] - u[1]).abs().max(0.05);
    let x = 29_660.0 * load / (1e3 * c.viscosity * (u[0] + u[1]) * sliding * sliding);
    0.0127 * x.max(2.0).log10()
}

fn member_path(pair: &Mating, member: usize, rho: f64) -> f64 {
    if member == 0 {
        rho - pair.c1
    } else {
        pair.c2 - rho
    }
}

impl Hidden for Law {
    fn has_factor(&self) -> bool {
        matches!(
            self.name,
            "pressure_exponent"
                | "film_thickness"
                | "approach_recess"
                | "flash_temperature"
                | "sliding_speed_exponent"
                | "severe_transition"
                | "oxidative"
                | "starvation_band"
                | "load_moved_band"
                | "energy_wear"
        )
    }

    fn has_friction(&self) -> bool {
        self.name == "friction_load"
    }

    fn friction(&self, s: f64) -> f64 {
        match (self.name, self.form) {
            ("friction_load", "recess") if s > 0.0 => self.p(0) * self.p(1),
            ("friction_load", _) => self.p(0),
            _ => 0.0,
        }
    }

    fn has_spot(&self) -> bool {
        matches!(
            self.name,
            "running_in"
                | "micropitting"
                | "debris_abrasion"
                | "lubricant_ageing"
                | "roughness_polish"
                | "corrosive_loss"
                | "member_hardness"
                | "surface_layer"
                | "coating"
                | "plastic_deformation"
                | "growing_scuff"
                | "on_off_blocks"
                | "gear_hardness_waves"
                | "members_swap"
                | "half_flank_oil_failure"
                | "humidity_cycle"
                | "gear_tip_plating"
        )
    }

    fn factor(&self, x: &Seen) -> f64 {
        let a = self.p(0);
        match (self.name, self.form) {
            ("pressure_exponent", "local") => (x.pressure / self.p(1)).powf(a),
            ("pressure_exponent", "hertz") => (x.p0 / self.p(1)).powf(a),
            ("pressure_exponent", _) => 1.0 + a * ((x.pressure - self.p(1)) / self.p(2)).max(0.0),
            ("film_thickness", form) => {
                let l = film(x.load, x.curvature, x.u, x.e_star, x.conditions);
                match form {
                    "rational" => 1.0 / (1.0 + a * (l / self.p(2)).powf(self.p(1))),
                    "step" => 1.0 - a * logistic(2.0 * (l - self.p(1)) / self.p(2)),
                    _ => (-a * l / self.p(1)).exp(),
                }
            }
            ("approach_recess", "step") => 1.0 + if x.s < 0.0 { a } else { 0.0 },
            ("approach_recess", _) => 1.0 + 0.5 * a * (1.0 - (x.s / self.p(1)).tanh()),
            ("flash_temperature", "exponential") => {
                let t = flash(x.load, x.u, x.half, x.conditions.friction);
                (a * (t + x.conditions.bulk - self.p(1))).exp()
            }
            ("flash_temperature", _) => {
                let t = flash(x.load, x.u, x.half, x.conditions.friction);
                1.0 / (1.0 - (a * t).min(0.9))
            }
            ("sliding_speed_exponent", "power") => (slip(x).max(0.02) / self.p(1)).powf(a),
            ("sliding_speed_exponent", _) => 1.0 + a * slip(x) / (slip(x) + self.p(1)),
            ("severe_transition", "logistic") => 1.0 + a * logistic((x.p0 - self.p(1)) / self.p(2)),
            ("severe_transition", _) => {
                1.0 + a * ((x.p0 - self.p(1)) / self.p(2) + 0.5).clamp(0.0, 1.0)
            }
            ("oxidative", _) => 1.0 - a + a * self.p(1) / slip(x).max(0.02),
            ("energy_wear", form) => {
                let mu = match form {
                    "mean_tooth_friction" => {
                        mean_tooth_friction(x.load, x.curvature, x.u, x.conditions)
                    }
                    _ => rolling_and_sliding(x.load, x.u, x.conditions),
                };
                (mu / self.p(1)).powf(a)
            }
            ("starvation_band", _) => 1.0 + a * (-((x.s - self.p(1)) / self.p(2)).powi(2)).exp(),
            ("load_moved_band", _) => {
                let at = self.p(1) * x.conditions.torque / self.p(3);
                1.0 + a * (-((x.s - at) / self.p(2)).powi(2)).exp()
            }
            _ => 1.0,
        }
    }

    fn local(&self, x: &Spot) -> f64 {
        let a = self.p(0);
        let n = x.cycles;
        let hours = n / (60.0 * x.conditions.speed);
        match (self.name, self.form) {
            ("running_in", "exponential") => 1.0 + a * (-n / self.p(1)).exp(),
            ("running_in", "contacts") => 1.0 + a * (-n * x.contacts_per_cycle / self.p(1)).exp(),
            ("running_in", "hyperbolic") => 1.0 + a * (1.0 + n / self.p(1)).powf(-self.p(2)),
            ("running_in", _) => (1.0 - a) * ((n + self.p(1)) / self.p(2)).powf(-a),
            ("debris_abrasion", "linear") => 1.0 + a * x.worn / self.p(1),
            ("debris_abrasion", _) => 1.0 + a * (1.0 - (-x.worn / self.p(1)).exp()),
            ("lubricant_ageing", "linear") => 1.0 + a * hours / self.p(1),
            ("lubricant_ageing", _) => 1.0 + a * (1.0 - (-hours / self.p(1)).exp()),
            ("member_hardness", "ratio") => (a * (0.5 - x.member as f64)).exp(),
            ("member_hardness", _) => (-a * x.member as f64).exp(),
            ("surface_layer", "exponential") => {
                1.0 + a * (1.0 - (-x.depth.max(0.0) / self.p(1)).exp())
            }
            ("surface_layer", _) => 1.0 + a * logistic((x.depth - self.p(1)) / self.p(2)),
            ("coating", "step") => {
                let through = logistic((x.depth - self.p(1)) / (0.04 * self.p(1)));
                through + (1.0 - through) / (1.0 + a)
            }
            ("coating", _) => {
                let through = (x.depth / self.p(1) - 0.5).clamp(0.0, 1.0);
                through + (1.0 - through) / (1.0 + a)
            }
            ("growing_scuff", _) if x.member == 0 => {
                let length = self.p(1) * (n / self.p(2)).sqrt();
                1.0 + a * logistic((x.start + length - x.s) / (0.06 * self.p(1)))
            }
            ("on_off_blocks", _) => {
                // A soft square wave: wear is lower in every second block.
                let phase = 2.0 * PI * (n / (2.0 * self.p(1)) + self.p(2));
                1.0 - a * logistic(12.0 * phase.sin())
            }
            ("gear_hardness_waves", _) if x.member == 1 => {
                1.0 + a * (2.0 * PI * x.s / self.p(1) + self.p(2)).cos()
            }
            ("members_swap", _) => {
                // The pinion wears faster early, the gear late.
                let side = ((self.p(1) - n) / (0.5 * self.p(1))).tanh();
                (a * side * (0.5 - x.member as f64)).exp()
            }
            ("half_flank_oil_failure", _) => {
                let late = logistic((n - self.p(1)) / (0.02 * self.p(1)));
                if x.s * self.p(2) > 0.0 {
                    1.0 + a * late
                } else {
                    1.0
                }
            }
            ("humidity_cycle", _) => 1.0 + a * (2.0 * PI * n / self.p(1) + self.p(2)).sin(),
            ("gear_tip_plating", _) if x.member == 1 => {
                1.0 - a * logistic((x.start + self.p(1) - x.s) / (0.08 * self.p(1)))
            }
            _ => 1.0,
        }
    }

    fn added(&self, x: &Spot) -> f64 {
        let a = self.p(0);
        let n = x.cycles;
        let touched = if x.peak > 0.0 { 1.0 } else { 0.0 };
        let per_hour = 1.0 / (60.0 * x.conditions.speed);
        match (self.name, self.form) {
            ("micropitting", form) => {
                let p = x.peak.min(2000.0) / self.p(2);
                let base = a * 1e-6 * x.contacts_per_cycle * p.powf(self.p(1));
                match form {
                    "saturating" => base * (-n / self.p(3)).exp(),
                    "dedendum" => {
                        let below = (x.member == 0) == (x.s < 0.0);
                        base * if below { 1.0 + self.p(3) } else { 1.0 }
                    }
                    _ => base,
                }
            }
            ("roughness_polish", form) => {
                let (c, per) = (n * x.contacts_per_cycle, x.contacts_per_cycle);
                let np = self.p(1);
                let slope = match form {
                    "exponential" => (-c / np).exp() / np,
                    _ => np / (c + np).powi(2),
                };
                touched * a * per * slope
            }
            ("corrosive_loss", "linear") => a * per_hour,
            ("corrosive_loss", _) => {
                // d/dn of a sqrt(t), its first minute smoothed.
                let t = n * per_hour + 0.02;
                0.5 * a * per_hour / t.sqrt()
            }
            ("plastic_deformation", form) => {
                let load = (x.peak - self.p(1)) / self.p(2);
                let part = if form == "clip" {
                    load.clamp(0.0, 1.0)
                } else {
                    logistic(4.0 * (load - 0.5)) * touched
                };
                a * part * (-n / self.p(3)).exp() / self.p(3)
            }
            _ => 0.0,
        }
    }

    fn profile(&self, member: usize, pair: &Mating, rho: f64) -> f64 {
        let a = self.p(0);
        let s = member_path(pair, member, rho);
        let path = pair.end - pair.start;
        match (self.name, self.form) {
            ("tip_relief", form) => {
                let from_tip = if member == 0 {
                    pair.end - s
                } else {
                    s - pair.start
                };
                let x = (1.0 - from_tip / self.p(1)).max(0.0);
                a * if form == "linear" { x } else { x * x }
            }
            ("profile_slope", form) if member == 0 => {
                let x = (s - pair.start) / path;
                let curve = if form == "linear" { 0.0 } else { self.p(1) };
                // Missing material from zero up, whichever end is low.
                if a > 0.0 {
                    a * (x + curve * x * (x - 1.0) * 2.0)
                } else {
                    -a * ((1.0 - x) + curve * x * (x - 1.0) * 2.0)
                }
            }
            ("profile_form", form) if member == 0 => {
                let x = (s - pair.start) / path;
                let mut v = 1.0 + (2.0 * PI * self.p(1) * x + self.p(2)).cos();
                if form == "two_waves" {
                    v += self.p(3) * (2.0 * PI * 2.3 * self.p(1) * x + self.p(4)).cos();
                }
                a * v
            }
            ("gear_groove", _) if member == 1 => a * (-((s - self.p(1)) / self.p(2)).powi(2)).exp(),
            _ => 0.0,
        }
    }

    fn load(&self, theta: f64, c: &Conditions, _: &Mating) -> f64 {
        if self.name != "dynamic_load" {
            return 1.0;
        }
        if self.form == "mean_and_ripple" {
            // Inertia forces of deviations grow with the square of the speed, far below any resonance.
            let rise = self.p(0) * (c.speed / self.p(3)).powi(2);
            return 1.0 + rise * (1.0 + self.p(1) * (2.0 * PI * theta + self.p(2)).cos());
        }
        let gain = |r: f64| 1.0 / ((1.0 - r * r).powi(2) + (2.0 * self.p(2) * r).powi(2)).sqrt();
        // At speed 0 only the amplitude would be left: count what the speed adds.
        let r = c.speed / self.p(1);
        let first = self.p(0) * gain(r) * r * r;
        let mut v = first * (2.0 * PI * theta + self.p(3)).cos();
        if self.form == "two_harmonics" {
            let r2 = 2.0 * r;
            v += self.p(4) * self.p(0) * gain(r2) * r * r * (4.0 * PI * theta + self.p(3)).cos();
        }
        1.0 + v.clamp(-0.8, 2.0)
    }

    fn softness(&self) -> f64 {
        if self.name == "extra_flexibility" {
            self.p(0)
        } else {
            0.0
        }
    }

    fn shift(&self, c: &Conditions, _: f64) -> f64 {
        let a = self.p(0);
        match (self.name, self.form) {
            ("radial_misalignment", _) => a,
            ("bearing_compliance", "linear") => a * c.torque / self.p(1),
            ("bearing_compliance", _) => a * (1.0 - (-c.torque / self.p(1)).exp()),
            ("thermal_expansion", _) => a * c.torque * c.speed / self.p(1),
            _ => 0.0,
        }
    }
}
