//! Pressure-angle error and profile crowning.
//!
//! ```text
//! e = f_Hα (x − ½) + C (2x − 1)²        x from 0 at the start to 1 at the end of the path of contact, on the pinion
//! ```
//! Only the sum of both flanks' deviations enters the contact, so it stands on the pinion alone.

use crate::effects::{Card, Effect, Form, Hook, Param, Prior, ProfileAt};
use crate::gear::Member;

pub(super) const CARD: Card = Card {
    name: "profile_slope",
    hook: Hook::Profile,
    formula: "profile = pinion*(slope*(along - 0.5) + crowning*(2*along - 1)^2)",
    source: "profile slope deviation f_Halpha and crowning as defined in ISO 1328-1 and ISO 21771; 3 to 15 µm are classes 5 to 8.",
    signature: "one end of the path carries more until it has worn off; then the base shape returns; crowning relieves both ends",
    confounded_with: &["tip_relief", "profile_form", "pitch_error"],
    separated_by: "the profile as made. A tilt of the measuring machine does not wear off",
    left_out: "nothing of the contact: the deviation is part of the gap and wears away; both flanks' as one",
    needs: &[],
    params: &[
        Param::new("slope", "um", "deviation from the start to the end of the path, positive with material missing at the end", 5.0, (-100.0, 100.0), Prior::Normal { mean: 0.0, sd: 8.0 }).neutral(0.0),
        Param::new("crowning", "um", "material missing at both ends against the middle", 0.0, (-50.0, 50.0), Prior::Normal { mean: 0.0, sd: 4.0 }).neutral(0.0).fixed(),
    ],
    forms: &[Form { name: "crowned", settings: &[("crowning", 4.0)], frees: &["crowning"], ..Form::PLAIN }],
    build: |p| Box::new(ProfileSlope { slope: p[0], crowning: p[1] }),
};

struct ProfileSlope {
    slope: f64,
    crowning: f64,
}

impl Effect for ProfileSlope {
    fn profile(&self, at: &ProfileAt) -> f64 {
        if at.member == Member::Gear {
            return 0.0;
        }
        let from_middle = 2.0 * at.along - 1.0;
        // adding zero turns −0 into 0
        self.slope * (at.along - 0.5) + self.crowning * from_middle * from_middle + 0.0
    }
}
