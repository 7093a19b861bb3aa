//! The interface that the wear floor sees: pressures on the contact grid of each mesh position.

use std::sync::Arc;

use nalgebra::DMatrix;

use crate::contact::cycle::Cycle;
use crate::contact::sequence::Sequence;
use crate::contact::slices::{Flanks, Slices};
use crate::contact::tangent::{LinearContact, LinearSlices};
use crate::contact::unilateral::{SliceSensitivity, UnilateralError};

/// Contact of all tooth pairs at one mesh position.
#[derive(Debug, Clone, PartialEq)]
pub struct PositionContact {
    /// Pressure at each multiplier node of the position, MPa.
    pub pressure: Vec<f64>,
    /// Rotation of the pinion that closes the flanks, rad: the loaded transmission error seen at the pinion.
    pub approach: f64,
    /// Unknowns in contact, ascending.
    pub active: Vec<usize>,
    /// Iterations of the contact solution.
    pub iterations: usize,
    /// Largest penetration relative to the approach.
    pub penetration: f64,
    /// Largest relative difference between the torque that the pressures carry and the load; of a passage of a tooth that differs, of the
    /// solutions that its own pair's pressures are taken from.
    pub torque_error: f64,
}

/// A contact model over one mesh cycle.
pub trait ContactModel: Sync {
    /// The mesh cycle it works on.
    fn cycle(&self) -> &Cycle;

    /// Contact at position `q` of the flanks of one section, started from the set `start`.
    ///
    /// # Errors
    /// [`ContactError`]; an iterate that did not converge is never returned.
    fn solve_flanks(
        &self,
        q: usize,
        flanks: &Flanks<'_>,
        start: &[usize],
    ) -> Result<PositionContact, ContactError>;

    /// The same where all teeth are alike, with the worn depths (mm) at the stations of pinion and gear.
    ///
    /// # Errors
    /// As [`ContactModel::solve_flanks`].
    fn solve(
        &self,
        q: usize,
        depth: [&[f64]; 2],
        start: &[usize],
    ) -> Result<PositionContact, ContactError> {
        let pairs = self.cycle().positions[q].pairs.len();
        self.solve_flanks(q, &Flanks::alike(pairs, depth), start)
    }

    /// S with dp = −S dg on the active set (MPa per mm²), or `None` if pressures follow the local shape so weakly that
    /// wear is not stiff.
    ///
    /// # Errors
    /// [`ContactError`] if the active set's compliance cannot be inverted.
    fn sensitivity(
        &self,
        q: usize,
        contact: &PositionContact,
    ) -> Result<Option<DMatrix<f64>>, ContactError>;

    /// The contact that was solved for `flanks`, linearised.
    ///
    /// # Errors
    /// [`ContactError`] if the active set's compliance cannot be inverted.
    fn linearised<'m>(
        &'m self,
        q: usize,
        contact: &PositionContact,
        flanks: &Flanks<'_>,
    ) -> Result<Box<dyn LinearContact + 'm>, ContactError>;

    /// Which tooth meets which, where teeth differ.
    fn sequence(&self) -> Option<&Sequence> {
        None
    }

    /// The model of all slices, where the face has more than one; what is said of one section then holds of none.
    fn sliced(&self) -> Option<&dyn SlicedContact> {
        None
    }
}

/// Contact of several slices of the face that close by one approach. Each slice is at a section position of its own, [`Slices::at`]: its
/// flanks and contact are those of that position of the mesh cycle.
pub trait SlicedContact: Sync {
    /// The slices.
    fn slices(&self) -> &Slices;

    /// Contact of every slice at the turn `turn`, started from the sets `start` by slice.
    ///
    /// # Errors
    /// [`ContactError`]; an iterate that did not converge is never returned.
    fn solve_all(
        &self,
        turn: usize,
        flanks: &Flanks<'_>,
        start: &[Vec<usize>],
    ) -> Result<Vec<PositionContact>, ContactError>;

    /// How the pressures of each slice follow its gaps and the common approach, or `None` as in [`ContactModel::sensitivity`].
    ///
    /// # Errors
    /// [`ContactError`] if an active set's compliance cannot be inverted.
    fn sensitivities(
        &self,
        turn: usize,
        contacts: &[&PositionContact],
    ) -> Result<Option<Vec<Arc<SliceSensitivity>>>, ContactError>;

    /// The contacts that were solved for `flanks`, linearised.
    ///
    /// # Errors
    /// As [`SlicedContact::sensitivities`].
    fn linearised_all<'m>(
        &'m self,
        turn: usize,
        contacts: &[&PositionContact],
        flanks: &Flanks<'_>,
    ) -> Result<Box<dyn LinearSlices + 'm>, ContactError>;
}

/// Why contact could not be solved.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ContactError {
    /// The contact problem of one position failed.
    #[error("contact at mesh position {theta:.4}: {source}")]
    Unilateral {
        /// Pinion rotation, base pitches.
        theta: f64,
        /// What went wrong.
        #[source]
        source: UnilateralError,
    },
    /// Contact reaches the end of the strip it was looked for in.
    #[error("contact at mesh position {theta:.4} is wider than ±{window} mm")]
    WindowTooNarrow {
        /// Pinion rotation, base pitches.
        theta: f64,
        /// Half width of the strip, mm.
        window: f64,
    },
    /// A tooth pair that was not looked at would touch.
    #[error(
        "at mesh position {theta:.4} a tooth pair {separation:.4} mm apart comes into contact, beyond the teeth prepared for this load; such loads and such wear are outside the model"
    )]
    OutOfReach {
        /// Pinion rotation, base pitches.
        theta: f64,
        /// Its distance before loading, mm.
        separation: f64,
    },
    /// The flanks give way too far: the gears are too soft for the load.
    #[error(
        "at mesh position {theta:.4} the flanks give way by {closing:.4} mm under load; beyond {limit:.4} mm (a quarter of a module) that is not small any more"
    )]
    TooSoft {
        /// Pinion rotation, base pitches.
        theta: f64,
        /// Turn of the pinion under load times its base radius, without what wear has left open, mm.
        closing: f64,
        /// Largest that is computed with, mm.
        limit: f64,
    },
    /// A tooth that can touch is not finely meshed.
    #[error("tooth {tooth} of the {} can touch but has no fine flank in the mesh", ["pinion", "gear"][*side])]
    NoFlank {
        /// 0 pinion, 1 gear.
        side: usize,
        /// Tooth number.
        tooth: i32,
    },
}
