//! Temperature of plastic teeth from friction losses, VDI 2736 part 2 (2014).
//!
//! ```text
//! ϑ = ϑ₀ + P µ H_V (k_ϑ/(b z (v m)^¾) + R/A) ED^0.64        P W, b mm, v m/s, m mm, R/A K/W; k_ϑ for the root or the flank
//! H_V = π (1/z₁ + 1/z₂)(1 − ε₁ − ε₂ + ε₁² + ε₂²)            spur gears; ε₁, ε₂ contact ratios of recess and approach
//! ```
//! The guideline itself was not read: the formula and its coefficients are those of two open programs that state it alike, GEARpie
//! (C. Fernandes, University of Porto, `CLASSES/VDI2736.py`) and one that was held against a report of the FVA workbench. They differ in z: its own
//! for each member (as here) or the pinion's for both.

use std::f64::consts::PI;

/// What a plastic runs against, which says how well heat leaves its teeth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HeatPartner {
    /// Plastic on steel.
    Steel,
    /// Plastic on plastic.
    Plastic,
}

impl HeatPartner {
    /// k_ϑ of the flank and of the root, K (m/s)^¾ mm^1.75/W.
    pub fn coefficients(self) -> [f64; 2] {
        match self {
            HeatPartner::Steel => [6300.0, 895.0],
            HeatPartner::Plastic => [9000.0, 2148.0],
        }
    }
}

/// What warms the teeth of one member.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ToothHeat {
    /// Power lost to friction, P µ H_V, W.
    pub loss: f64,
    /// Face width, mm.
    pub face_width: f64,
    /// Number of teeth of the member.
    pub teeth: u32,
    /// Pitch line velocity, m/s.
    pub velocity: f64,
    /// Module, of helical gears that of the normal section, mm.
    pub module: f64,
    /// Resistance of the housing to heat over its surface, R/A, K/W; 0 in the open.
    pub housing: f64,
    /// Part of the time that it runs, 0 to 1.
    pub duty: f64,
}

impl ToothHeat {
    /// Rise of the temperature above the surroundings, K, for `coefficient` k_ϑ.
    pub fn rise(&self, coefficient: f64) -> f64 {
        let teeth = coefficient
            / (self.face_width * f64::from(self.teeth) * (self.velocity * self.module).powf(0.75));
        self.loss * (teeth + self.housing) * self.duty.powf(0.64)
    }
}

/// Gear loss factor H_V of a spur pair (Wimmer) from its numbers of teeth and the contact ratios of recess and approach; that of a helical pair is
/// 1/cos β_b times it.
pub fn loss_factor(teeth: [u32; 2], [recess, approach]: [f64; 2]) -> f64 {
    let [first, second] = teeth.map(f64::from);
    PI * (1.0 / first + 1.0 / second)
        * (1.0 - recess - approach + recess * recess + approach * approach)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// GEARpie's report on its gears "MAO" (REPORT/MAO.txt): POM on POM, module 2, 30 and 30 teeth, 15 mm (the face width that follows from its
    /// stresses: 32.17 and 45.74 MPa), 10 N m at 1000 rpm, µ 0.28, 23 °C,
    /// in the open: H_V 0.1494, flank 243.5 °C, root 75.6 °C. Its power loss is integrated numerically (43.75 W, 0.1 % less): tolerance 0.2 % of the rise.
    #[test]
    fn the_report_of_an_open_program_is_reproduced() {
        let contact_ratio = {
            let (base, tip) = (30.0 * 20f64.to_radians().cos(), 32.0_f64);
            let path = (tip * tip - base * base).sqrt() - 30.0 * 20f64.to_radians().sin();
            path / (PI * 2.0 * 20f64.to_radians().cos())
        };
        let factor = loss_factor([30, 30], [contact_ratio; 2]);
        assert!((factor - 0.1494).abs() < 5e-5, "{factor}");
        let heat = ToothHeat {
            loss: 1047.2 * 0.28 * factor,
            face_width: 15.0,
            teeth: 30,
            velocity: PI,
            module: 2.0,
            housing: 0.0,
            duty: 1.0,
        };
        let rises = HeatPartner::Plastic.coefficients().map(|k| heat.rise(k));
        for (rise, reported) in rises.into_iter().zip([243.5 - 23.0, 75.6 - 23.0]) {
            assert!((rise / reported - 1.0).abs() < 2e-3, "{rise}, {reported}");
        }
    }

    /// The report of the FVA workbench on a pair of 51 and 52 teeth, as the tests of an open program quote it: ε 0.600 and 0.554, H_V 0.0626; 1848.706 W, µ 0.04, 80 °C,
    /// a closed housing (0.06 K m²/W, 0.01 m²) and no share of the teeth (k_ϑ 0): 107.767 °C. Tolerance: the contact ratios' three decimals.
    #[test]
    fn the_workbench_report_is_reproduced() {
        let factor = loss_factor([51, 52], [0.600, 0.554]);
        assert!((factor - 0.0626).abs() < 5e-5, "{factor}");
        let heat = ToothHeat {
            loss: 1848.706 * 0.04 * factor,
            face_width: 15.0,
            teeth: 51,
            velocity: 6.067,
            module: 1.0,
            housing: 0.060 / 0.010,
            duty: 1.0,
        };
        let temperature = 80.0 + heat.rise(0.0);
        assert!((temperature - 107.767).abs() < 0.03, "{temperature}");
    }
}
