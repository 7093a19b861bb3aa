//! The values of the published model and of correct theory behind every row of the table.

use super::super::{
    Corrections, Error, Inputs, Outcome, backlash, depth_per_pass, double_contact_length, run,
};
use super::Kind;

/// One row's values.
pub(super) struct Computed {
    pub(super) kind: Kind,
    pub(super) ours: Option<f64>,
    pub(super) theory: f64,
}

/// Runs at the three misalignments: as published, and with the true sliding distance and speed ratio.
pub(super) struct Values {
    inputs: [Inputs; 3],
    published: [Outcome; 3],
    corrected: [Outcome; 3],
}

const MISALIGNMENTS: [f64; 3] = [0.0, 0.5, 1.0];
/// Backlash stated for the unmoved pair, mm.
const STATED_BACKLASH: f64 = 0.0455;

impl Values {
    pub(super) fn compute() -> Result<Self, Error> {
        let inputs = MISALIGNMENTS.map(Inputs::with_misalignment);
        let corrected = inputs.clone().map(|inputs| Inputs {
            corrections: Corrections {
                hertz_dwell: true,
                true_speed_ratio: true,
                ..Corrections::default()
            },
            ..inputs
        });
        let all = |inputs: &[Inputs; 3]| -> Result<[Outcome; 3], Error> {
            Ok([run(&inputs[0])?, run(&inputs[1])?, run(&inputs[2])?])
        };
        Ok(Self {
            published: all(&inputs)?,
            corrected: all(&corrected)?,
            inputs,
        })
    }

    /// The values of one row, `None` if the row is not known.
    pub(super) fn of(&self, id: &str) -> Option<Computed> {
        if id.starts_with('I') {
            return self.input(id);
        }
        let count = |ours: usize, theory: f64| {
            Some(Computed {
                kind: Kind::Count,
                ours: Some(ours as f64),
                theory,
            })
        };
        let quantity = |ours: Option<f64>, theory: f64| {
            Some(Computed {
                kind: Kind::Quantity,
                ours,
                theory,
            })
        };
        let both = |value: f64| quantity(Some(value), value);
        let [first, second, third] = self.published.each_ref().map(|o| &o.geometry);
        let geometry = match id {
            "B1" | "P1" | "C1" => first,
            "B2" | "P2" => second,
            "B3" | "P3" | "C2" => third,
            _ if id.starts_with("T2.2") => second,
            _ if id.starts_with("T2.3") => third,
            _ => first,
        };
        let um = 1e3;
        match id {
            "T2.1.a" | "T2.2.a" | "T2.3.a" => both(geometry.operating_angle.to_degrees()),
            "T2.1.p" | "T2.2.p" | "T2.3.p" => both(geometry.circular_pitch),
            "T2.1.l" | "T2.2.l" | "T2.3.l" => both(geometry.path_of_contact),
            "T2.1.c" | "T2.2.c" | "T2.3.c" => both(geometry.contact_ratio),
            "T2.1.s" => both(geometry.speed_ratio),
            // Nothing the paper prints leads to a speed ratio that changes with the centre distance.
            "T2.2.s" | "T2.3.s" => quantity(None, geometry.speed_ratio),
            "B1" | "B2" | "B3" => quantity(
                Some(geometry.backlash.candidate * um),
                backlash(&self.inputs[0], geometry, STATED_BACKLASH) * um,
            ),
            "P1" | "P2" | "P3" => count(
                geometry.pitch_point_number(),
                geometry.number(geometry.pitch),
            ),
            "C1" | "C2" => count(
                geometry.first_contact_number(),
                geometry.number(geometry.start),
            ),
            "P4" => quantity(
                Some(first.profile_angle(23).to_degrees()),
                first.operating_angle.to_degrees(),
            ),
            "W1" => quantity(self.wear(0, 23), self.pitch_wear(0)),
            "W2" => quantity(self.wear(1, 26), self.pitch_wear(1)),
            "W3" => quantity(self.wear(2, 28), self.pitch_wear(2)),
            "A1" => quantity(angle(&self.published[0], 6), angle(&self.corrected[0], 6)?),
            "A2" => quantity(
                angle(&self.published[2], 14),
                angle(&self.corrected[2], 14)?,
            ),
            "Q1" => quantity(
                Some(self.published[0].largest_pressure_drop().1),
                self.corrected[0].largest_pressure_drop().1,
            ),
            "R1" => quantity(
                Some(decrease(
                    tenth(first.contact_ratio),
                    tenth(second.contact_ratio),
                )),
                decrease(first.contact_ratio, second.contact_ratio),
            ),
            "R2" => quantity(
                Some(decrease(
                    tenth(first.contact_ratio),
                    tenth(third.contact_ratio),
                )),
                decrease(first.contact_ratio, third.contact_ratio),
            ),
            "R3" => quantity(
                Some(decrease(
                    tenth(first.contact_ratio),
                    tenth(third.contact_ratio),
                )),
                decrease(double_contact_length(first), double_contact_length(third)),
            ),
            _ => None,
        }
    }

    fn input(&self, id: &str) -> Option<Computed> {
        let table = &self.inputs[0];
        let [z1, z2] = table.teeth.map(f64::from);
        let value = match id {
            "I01" => z1,
            "I02" => z2,
            "I03" => table.module,
            "I04" => table.pressure_angle.to_degrees(),
            "I05" => table.face_width,
            "I06" => table.torque / 1e3,
            "I07" => table.speed[0],
            "I08" => table.speed[1],
            "I09" => table.k,
            "I10" => table.youngs_modulus[0],
            "I11" => table.poisson_ratio[0],
            "I12" => table.centre_distance,
            "I13" => self.inputs[1].misalignment,
            "I14" => self.inputs[2].misalignment,
            "I15" => table.points as f64,
            "I16" => table.cycles as f64,
            _ => return None,
        };
        Some(Computed {
            kind: Kind::Input,
            ours: Some(value),
            theory: if id == "I08" {
                table.speed[0] * z1 / z2
            } else {
                value
            },
        })
    }

    /// Cumulative wear of a point, µm, negative as printed (material removed).
    fn wear(&self, case: usize, number: usize) -> Option<f64> {
        self.published[case].point(number).map(|p| -p.depth * 1e3)
    }

    /// Wear at the exact pitch point, µm: equal speeds, no sliding.
    fn pitch_wear(&self, case: usize) -> f64 {
        let (inputs, geometry) = (&self.inputs[case], &self.published[case].geometry);
        let k_load = inputs.k * inputs.torque / (geometry.base_radius[0] * inputs.face_width);
        let tangent = geometry.operating_angle.tan();
        let own = geometry.base_radius[0] * tangent;
        let other = geometry.base_radius[1] * tangent / geometry.speed_ratio;
        let wear = -1e3 * inputs.cycles as f64 * depth_per_pass(k_load, own, other);
        // Rounding of the two speeds leaves about 1e-12 µm; adding zero turns −0 into 0.
        (wear * 1e9).round() / 1e9 + 0.0
    }
}

/// Increase of the profile angle of a point, deg.
fn angle(outcome: &Outcome, number: usize) -> Option<f64> {
    outcome.point(number).map(|p| p.angle_change.to_degrees())
}

/// Decrease from one value to another, %.
fn decrease(from: f64, to: f64) -> f64 {
    100.0 * (from - to) / from
}

/// Rounded to one decimal, as Table 2 prints contact ratios.
fn tenth(x: f64) -> f64 {
    (x * 10.0).round() / 10.0
}
