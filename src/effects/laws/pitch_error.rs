//! Teeth stand off their places: one of them, or every second one.
//!
//! ```text
//! e_i = f_pt for the tooth i = n, or for every second tooth from it on, 0 for the others       µm along the path of contact
//! ```
//! Positive: the tooth stands back. Teeth that stand proud take more of the load and wear in, those beside them less; each class of
//! teeth wears for itself ([`crate::contact::sequence`]).

use crate::effects::{Card, Effect, Form, Hook, Param, Prior, Tooth};
use crate::gear::{Member, ToothClasses};

pub(super) const CARD: Card = Card {
    name: "pitch_error",
    hook: Hook::ToothOffset,
    // of the measured tooth
    formula: "tooth_offset = deviation",
    source: "single pitch deviation f_pt of ISO 1328-1; 3 to 15 µm are classes 5 to 8.",
    signature: "the measured tooth wears more or less in both double contact zones; until the deviation has worn in; teeth of one member differ; once per turn, or every second mesh, in the transmission error",
    confounded_with: &["run_out", "profile_slope", "extra_flexibility", "tip_relief"],
    separated_by: "measuring four teeth or more",
    left_out: "differences between the mates that a tooth meets: it meets their mean. Not beside slices of the face",
    needs: &[],
    params: &[
        Param::new(
            "deviation",
            "um",
            "how far the odd teeth stand back; negative: they stand proud",
            5.0,
            (-200.0, 200.0),
            Prior::Normal { mean: 0.0, sd: 8.0 },
        )
        .neutral(0.0),
        Param::either("on_gear", "0: teeth of the pinion are odd; 1: of the gear"),
        Param::either("alternate", "0: one tooth is odd; 1: every second one"),
        Param::new(
            "tooth",
            "-",
            "the odd tooth, or one of them, counted from the measured one (which is tooth 1 where rows have labels) in the order of coming into mesh",
            0.0,
            (-1000.0, 1000.0),
            Prior::Normal { mean: 0.0, sd: 1.0 },
        )
        .fixed(),
    ],
    forms: &[
        Form {
            name: "tooth before the measured one",
            settings: &[("tooth", -1.0)],
            ..Form::PLAIN
        },
        Form {
            name: "tooth after the measured one",
            settings: &[("tooth", 1.0)],
            ..Form::PLAIN
        },
        Form {
            name: "every second tooth",
            settings: &[("alternate", 1.0)],
            ..Form::PLAIN
        },
        Form {
            name: "on the gear",
            settings: &[("on_gear", 1.0)],
            ..Form::PLAIN
        },
        Form {
            name: "on the gear, tooth before the measured one",
            settings: &[("on_gear", 1.0), ("tooth", -1.0)],
            ..Form::PLAIN
        },
        Form {
            name: "on the gear, tooth after the measured one",
            settings: &[("on_gear", 1.0), ("tooth", 1.0)],
            ..Form::PLAIN
        },
        Form {
            name: "on the gear, every second tooth",
            settings: &[("on_gear", 1.0), ("alternate", 1.0)],
            ..Form::PLAIN
        },
    ],
    build: |p| {
        Box::new(PitchError {
            deviation: p[0],
            member: if p[1] < 0.5 {
                Member::Pinion
            } else {
                Member::Gear
            },
            alternate: p[2] >= 0.5,
            tooth: p[3].round() as i64,
        })
    },
};

struct PitchError {
    deviation: f64,
    member: Member,
    alternate: bool,
    tooth: i64,
}

impl PitchError {
    fn is_odd(&self, tooth: Tooth) -> bool {
        let beyond = tooth.from_measured() - self.tooth;
        let odd = match self.alternate {
            true => beyond % 2 == 0,
            false => beyond.rem_euclid(tooth.of as i64) == 0,
        };
        odd && tooth.member == self.member
    }
}

impl Effect for PitchError {
    fn tooth_offset(&self, tooth: Tooth) -> f64 {
        if self.is_odd(tooth) {
            self.deviation
        } else {
            0.0
        }
    }

    fn tooth_kind(&self, tooth: Tooth) -> Vec<f64> {
        vec![f64::from(u8::from(self.is_odd(tooth)))]
    }

    /// An odd number of teeth has two alike side by side somewhere; they are counted to the others.
    fn tooth_classes(&self) -> ToothClasses {
        ToothClasses::Alike(if self.alternate { 2 } else { usize::MAX })
    }
}
