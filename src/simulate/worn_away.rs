//! Runs that would wear more than there is tooth.

use std::f64::consts::PI;

use crate::gear::Pair;
use crate::simulate::history::Progress;
use crate::simulate::result::Member;
use crate::simulate::run::Plan;

/// More wear than there is tooth.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "{cycles:e} cycles would wear {worn:.3} mm² off each tooth of the {}, which has {tooth:.3} mm² from form to tip circle: that is \
     {:.3} mm deep on average; about {:.2e} cycles wear a tenth of the tooth, a smaller wear coefficient allows more",
    .member.name(), worn / height, 0.1 * tooth / worn * cycles
)]
pub struct WornAway {
    /// Whose tooth.
    pub member: Member,
    /// Cycles asked for.
    pub cycles: f64,
    /// Area worn by then, mm².
    pub worn: f64,
    /// Area of the tooth, mm²: half a pitch wide, from form to tip circle.
    pub tooth: f64,
    /// Height of the flank, mm.
    pub height: f64,
}

impl WornAway {
    /// Whether `plan` ends so, from what its first steps took.
    ///
    /// Each revolution takes the same area off a flank, whatever its shape (k ∮ F' |v| dt, the load being that of the torque). Effects
    /// may change it, so they are left out.
    pub(super) fn by_the_end(plan: &Plan, pair: &Pair, progress: &Progress) -> Option<Self> {
        if plan.acting.is_some() || progress.stand.n <= 0.0 {
            return None;
        }
        let cycles = plan.conditions.cycles;
        let of_member = |(member, law): (Member, f64)| {
            let gear = match member {
                Member::Pinion => &pair.pinion,
                Member::Gear => &pair.gear,
            };
            let height = gear.tip_radius - gear.form_radius;
            let tooth = 0.5 * PI * gear.rack.module * height;
            let worn = law * cycles / progress.stand.n;
            (worn > tooth).then_some(Self {
                member,
                cycles,
                worn,
                tooth,
                height,
            })
        };
        (Member::BOTH.into_iter().zip(progress.balance.law)).find_map(of_member)
    }
}
