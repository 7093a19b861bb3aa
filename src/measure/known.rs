//! What the reader of measurements has to know of the study.

use crate::gear::{Gear, Member};

/// Largest rounding of a stated radius, mm: half of the third decimal.
const ROUNDING: f64 = 5e-4;

/// The tests and gears that measurements may refer to.
#[derive(Debug, Clone, PartialEq)]
pub struct Known {
    /// The study's tests.
    pub tests: Vec<KnownTest>,
    /// Form radius and tip radius of pinion and gear, mm.
    pub flank: [[f64; 2]; 2],
    /// Over how many teeth a span of pinion and gear can be measured.
    pub spanned: [Vec<u32>; 2],
    /// Face width, mm.
    pub face_width: f64,
}

/// One test of the study.
#[derive(Debug, Clone, PartialEq)]
pub struct KnownTest {
    /// Its id.
    pub id: String,
    /// Its length, pinion revolutions.
    pub cycles: f64,
}

impl Known {
    /// Of the tests' ids and cycles, the gears (pinion first) and the face width (mm).
    pub fn new<'a>(
        tests: impl IntoIterator<Item = (&'a str, f64)>,
        gears: [&Gear; 2],
        face_width: f64,
    ) -> Self {
        let tests = tests.into_iter().map(|(id, cycles)| KnownTest {
            id: id.to_owned(),
            cycles,
        });
        Self {
            tests: tests.collect(),
            flank: gears.map(|gear| [gear.form_radius, gear.tip_radius]),
            spanned: gears.map(Gear::spanned_teeth),
            face_width,
        }
    }

    /// Over how many teeth a span of `member` touches its flanks.
    pub(super) fn spanned_by(&self, member: Member) -> &[u32] {
        &self.spanned[usize::from(member == Member::Gear)]
    }

    /// Form radius and tip radius of a member, mm.
    pub fn flank_of(&self, member: Member) -> [f64; 2] {
        self.flank[usize::from(member == Member::Gear)]
    }

    /// True if a radius (mm) lies on the member's flank, up to the rounding of its third decimal.
    pub(crate) fn on_flank(&self, member: Member, radius: f64) -> bool {
        let [form, tip] = self.flank_of(member);
        (form - ROUNDING..=tip + ROUNDING).contains(&radius)
    }

    /// A depth that no gear of this size loses by mild wear, µm: 1 mm, or a quarter of a tall tooth's flank.
    pub(super) fn depth_limit_um(&self) -> f64 {
        let tallest = self.flank.iter().map(|[form, tip]| tip - form);
        tallest.fold(1000.0, |limit: f64, height| limit.max(250.0 * height))
    }
}
