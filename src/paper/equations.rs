//! The wear equations of the paper for one point, each in the form that reproduces the printed numbers.
//!
//! ```text
//! load       F' = T/(r_b1 w), half of it outside the single-pair zone          (not stated in the paper)
//! A6         ρ_p = r_b1 tan α' + y,   ρ_g = r_b2 tan α' − y                    (printed with + twice)
//! A7         1/R = 1/ρ_p + 1/ρ_g
//! A5         a_H = √(4 F' R/(π E))                                             (printed with E and R exchanged)
//! A1         p = 2 F'/(π a_H)                                                  (the largest pressure, x = 0)
//! A3         v = (ω_p + ω_g) y
//! A4         t = y sec α'/u_p, u_p = ω_p r_w, hence t = y/(ω_p r_b1)
//! 11         h = k p v t = k p (1 + ω_g/ω_p) y²/r_b1
//! 6          inv φ_new = inv φ + h/(2 r)                                       (thickness read as angle: not physical)
//! ```
//!
//! A4 is the time the contact takes from the pitch point to y, not the time a surface point spends in the contact; wear
//! then grows as y², where it should grow as |y|/ρ.

use std::f64::consts::PI;

use super::geometry::inv;
use super::{Geometry, Inputs, Reading, theory};

/// What a point feels in one cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Passage {
    pub(super) y: f64,
    pub(super) half_width: f64,
    pub(super) pressure: f64,
    pub(super) depth: f64,
}

/// Quantities that stay as they are for one point over all cycles.
#[derive(Debug, Clone)]
pub(super) struct Station<'a> {
    pub(super) inputs: &'a Inputs,
    base: [f64; 2],
    tan_operating: f64,
    pitch_sine: f64,
    speed: f64,
    modulus: f64,
    pub(super) radius: f64,
    pub(super) load: f64,
    thickness: f64,
}

impl<'a> Station<'a> {
    /// The point at `radius` (mm) of the unworn pinion.
    pub(super) fn new(inputs: &'a Inputs, geometry: &Geometry, radius: f64) -> Self {
        let angle = if inputs.reading == Some(Reading::PrintedAngle) {
            (geometry.operating_angle.to_degrees() * 100.0 + 1e-6).floor() / 100.0
        } else {
            geometry.operating_angle.to_degrees()
        }
        .to_radians();
        let rb = geometry.base_radius[0];
        let profile = (rb / radius).min(1.0).acos();
        let tooth = PI / (2.0 * f64::from(inputs.teeth[0]));
        Self {
            inputs,
            base: geometry.base_radius,
            tan_operating: angle.tan(),
            pitch_sine: geometry.pitch_radius * geometry.operating_angle.sin(),
            speed: inputs.gear_to_pinion_speed(),
            modulus: inputs.contact_modulus(),
            radius,
            load: load_per_width(inputs, geometry, radius),
            thickness: 2.0 * radius * (tooth + inv(inputs.pressure_angle) - inv(profile)),
        }
    }

    /// Distance from the pitch point along the line of action, mm, for `t = tan φ` of the profile angle.
    pub(super) fn distance(&self, t: f64) -> f64 {
        if self.inputs.reading == Some(Reading::SineOfAngle) {
            self.radius * t / (1.0 + t * t).sqrt() - self.pitch_sine
        } else {
            self.base[0] * (t - self.tan_operating)
        }
    }

    /// Contact and wear of one cycle at `t = tan φ`; `None` once y has left the line of action.
    pub(super) fn passage(&self, t: f64) -> Option<Passage> {
        let y = self.distance(t);
        if self.load == 0.0 {
            return Some(Passage {
                y,
                half_width: 0.0,
                pressure: 0.0,
                depth: 0.0,
            });
        }
        let reading = self.inputs.reading;
        let rho_p = self.base[0] * self.tan_operating + y;
        let rho_g = match reading {
            Some(Reading::RadiiAsPrinted) => self.base[1] * self.tan_operating + y,
            _ => self.base[1] * self.tan_operating - y,
        };
        if !(rho_p > 0.0 && rho_g > 0.0) {
            return None;
        }
        let relative = 1.0 / (1.0 / rho_p + 1.0 / rho_g);
        let half_width = match reading {
            Some(Reading::HalfWidthAsPrinted) => 4.0 * self.load * self.modulus / (PI * relative),
            _ => 4.0 * self.load * relative / (PI * self.modulus),
        }
        .sqrt();
        let pressure = 2.0 * self.load / (PI * half_width);
        let depth = if self.inputs.corrections.hertz_dwell {
            let k_load = self.inputs.k * self.load;
            theory::depth_per_pass(k_load, rho_p, self.speed * rho_g)
        } else {
            let acting = match reading {
                Some(Reading::MeanPressure) => pressure * PI / 4.0,
                _ => pressure,
            };
            // Times the pinion's angular speed, which cancels.
            let time = match reading {
                Some(Reading::InstantaneousAngle) => {
                    y * (1.0 + t * t).sqrt() / reference_radius(self.inputs)
                }
                Some(Reading::ContactDwell) => 2.0 * half_width / rho_p * y.signum(),
                _ => y / self.base[0],
            };
            self.inputs.k * acting * (1.0 + self.speed) * y * time
        };
        Some(Passage {
            y,
            half_width,
            pressure,
            depth,
        })
    }

    /// Eq. 6: `tan φ` after `depth` (mm) has been worn off a point with `t = tan φ`.
    pub(super) fn worn(&self, t: f64, depth: f64) -> f64 {
        if self.inputs.corrections.no_angle_feedback {
            return t;
        }
        let rise = match self.inputs.reading {
            Some(Reading::LogarithmicUpdate) => (t - t.atan()) * depth / self.thickness,
            Some(Reading::BothFlanks) => depth / self.radius,
            _ => depth / (2.0 * self.radius),
        };
        t + tangent_step(t, rise)
    }
}

fn reference_radius(inputs: &Inputs) -> f64 {
    inputs.module * f64::from(inputs.teeth[0]) / 2.0
}

/// Load per width of the point at `radius`, N/mm: none outside the unworn path of contact, all of it where one pair touches.
fn load_per_width(inputs: &Inputs, geometry: &Geometry, radius: f64) -> f64 {
    let rb = geometry.base_radius[0];
    let rho = (radius * radius - rb * rb).max(0.0).sqrt();
    if rho < geometry.start || radius > geometry.radius(geometry.end) * (1.0 + 1e-12) {
        return 0.0;
    }
    let arm = match inputs.reading {
        Some(Reading::LoadAtReferenceCircle) => reference_radius(inputs),
        _ => rb,
    };
    let width = match inputs.reading {
        Some(Reading::LoadNotPerWidth | Reading::HalfWidthAsPrinted) => 1.0,
        _ => inputs.face_width,
    };
    let all = inputs.torque / (arm * width);
    if rho >= geometry.lowest_single && rho <= geometry.highest_single {
        return all;
    }
    if inputs.corrections.linear_load_share {
        let double = geometry.lowest_single - geometry.start;
        let inside = if rho < geometry.lowest_single {
            rho - geometry.start
        } else {
            geometry.end - rho
        };
        return all * (1.0 + inside.max(0.0) / double) / 3.0;
    }
    match inputs.reading {
        Some(Reading::FullLoad) => all,
        Some(Reading::OneThird) => all / 3.0,
        _ => all / 2.0,
    }
}

/// How much `tan φ` grows from `t` when `inv φ = tan φ − φ` grows by `rise`, by Newton's method.
///
/// ```text
/// d − atan u = rise,  u = d/(1 + t (t + d))        the difference of two arctangents is one
/// d − u = d t (t + d)/(1 + t (t + d))              written so that nothing cancels
/// ```
/// Without this form a step of 1e-8 would carry the rounding of inv φ itself, 50 000 times over.
fn tangent_step(t: f64, rise: f64) -> f64 {
    let mut d = rise * (1.0 + t * t) / (t * t);
    for _ in 0..50 {
        let product = t * (t + d);
        let u = d / (1.0 + product);
        let beyond = if u.abs() < 1e-3 {
            u * u * u * (1.0 / 3.0 - u * u / 5.0)
        } else {
            u - u.atan()
        };
        let slope = (t + d) * (t + d) / (1.0 + (t + d) * (t + d));
        let step = (rise - u * product - beyond) / slope;
        d += step;
        if step.abs() <= 1e-15 * d.abs() {
            break;
        }
    }
    d
}

#[cfg(test)]
mod tests {
    use super::{inv, tangent_step};

    #[test]
    fn the_step_is_that_of_the_involute_function() {
        for phi in [0.05_f64, 0.2, 0.5] {
            for rise in [1e-9, 1e-5, 1e-3, 0.05] {
                let after = (phi.tan() + tangent_step(phi.tan(), rise)).atan();
                let error = inv(after) - inv(phi) - rise;
                assert!(error.abs() < 1e-16 + 1e-14 * rise, "{phi} {rise} {error:e}");
            }
        }
    }
}
