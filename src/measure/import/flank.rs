//! Which of a table's places lie on a gear's flank, in the table's own terms. Machines trace a profile from below the form circle to beyond the tip,
//! where no flank is that could wear.

use super::place::{PositionKind, on_flank};
use super::wanted::Wanted;
use super::{ImportError, units};
use crate::gear::Gear;
use crate::measure::{Quantity, Subject};

/// Least part of a curve's places that lie on the flank it is of.
pub(super) const MOST: f64 = 0.8;
/// A rounding of the radii of a flank in a table, mm.
const CLOSE: f64 = 0.01;
/// Part of the flank's height by which a trace may begin below it or end above.
const BEYOND: f64 = 0.5;

/// A gear's flank with the way in which a table tells places on it.
#[derive(Debug, Clone)]
pub(super) struct Flank<'g> {
    gear: &'g Gear,
    member: Subject,
    kind: PositionKind,
    scale: f64,
    unit: String,
}

/// Where a place lies that is not on the flank.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Side {
    Below,
    Above,
}

/// Whether a number below a header can be a place on the flank of either gear.
pub(super) fn can_be_on_a_flank(
    number: f64,
    header: &str,
    quantity: Quantity,
    wanted: &Wanted<'_>,
) -> bool {
    let kind = PositionKind::of(quantity, wanted.position, header);
    let members = [Subject::Pinion, Subject::Gear].into_iter();
    kind.has_unit()
        && members.zip(wanted.gears).any(|(member, gear)| {
            Flank::new(gear, member, kind, header)
                .is_ok_and(|flank| flank.is_close(flank.radius(number)))
        })
}

impl<'g> Flank<'g> {
    /// Of a member's gear; the header of the places says their unit.
    pub(super) fn new(
        gear: &'g Gear,
        member: Subject,
        kind: PositionKind,
        header: &str,
    ) -> Result<Self, ImportError> {
        let own = kind.name().split(", ").nth(1).unwrap_or_default();
        let stated = units::name_and_unit(header).1;
        Ok(Self {
            gear,
            member,
            kind,
            scale: units::of_position(header, kind == PositionKind::RollAngle)?,
            unit: stated.unwrap_or_else(|| own.to_owned()),
        })
    }

    /// The radius of a place of the table, mm.
    pub(super) fn radius(&self, place: f64) -> f64 {
        self.kind.position(self.scale * place, Some(self.gear))
    }

    /// Whether a radius (mm) lies on it to within what two programs may differ by in computing it.
    pub(super) fn is_close(&self, radius: f64) -> bool {
        (self.gear.form_radius - CLOSE..=self.gear.tip_radius + CLOSE).contains(&radius)
    }

    /// What its places are called, under the header `corner`.
    pub(super) fn places(&self, corner: &str) -> String {
        let stated = units::name_and_unit(corner).1;
        let read_as = match stated {
            Some(unit) => format!("{} in {unit}", self.kind.word()),
            None => self.kind.name().to_owned(),
        };
        format!("places on the {}, read as {read_as}", self.whose())
    }

    /// `gear's flank (radius 51.295 to 55.000 mm)`
    pub(super) fn whose(&self) -> String {
        format!("{}'s flank ({})", self.member.name(), self.reach())
    }

    /// From where to where it reaches: `diameter 49.182 to 58.000 mm`.
    pub(super) fn reach(&self) -> String {
        let told = |radius: f64| self.kind.told(radius, self.gear) / self.scale;
        format!(
            "{} {:.3} to {:.3} {}",
            self.kind.word(),
            told(self.gear.form_radius),
            told(self.gear.tip_radius),
            self.unit
        )
    }

    /// Where a radius (mm) lies; none on the flank.
    pub(super) fn side(&self, radius: f64) -> Option<Side> {
        let is_below = radius < self.gear.form_radius;
        (!on_flank(self.gear, radius)).then_some(if is_below { Side::Below } else { Side::Above })
    }

    /// Whether a trace of the flank may reach so far.
    pub(super) fn is_near(&self, radius: f64) -> bool {
        let [form, tip] = [self.gear.form_radius, self.gear.tip_radius];
        let beyond = BEYOND * (tip - form);
        (form - beyond..=tip + beyond).contains(&radius)
    }

    /// What is said of places, as the table has them, that were left out.
    pub(super) fn left_out(
        &self,
        side: Side,
        (count, what): (usize, &str),
        places: &[f64],
    ) -> String {
        let least = places.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = places.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (side, end) = match side {
            Side::Below => ("below", "form circle"),
            Side::Above => ("above", "tip"),
        };
        let places = match least == largest {
            true => format!("at {least}"),
            false => format!("from {least} to {largest}"),
        };
        let plural = if count == 1 { "" } else { "s" };
        format!(
            "{count} {what}{plural} {side} the {end} of the {} ({places}): its flank covers {}, and there is no wear to compare outside of it",
            self.member.name(),
            self.reach()
        )
    }

    /// What is wrong with a place, as the table has it, that is not on the flank.
    pub(super) fn refused(&self, place: f64) -> String {
        format!(
            "the {} {place} {} is off the {}'s flank ({})",
            self.kind.word(),
            self.unit,
            self.member.name(),
            self.reach()
        )
    }
}
