//! The Jacobian of the wear rate over the whole mesh cycle, ∂(dh/dn)/∂h: of one section, and of slices that share their approach.

use faer::Mat;
use nalgebra::DMatrix;
use rayon::prelude::*;

use super::local::Local;
use super::{ArchardSystem, WearError};
use crate::contact::model::{ContactModel, PositionContact, SlicedContact};
use crate::numeric::patchy::PatchyMatrix;
use crate::wear::integrator::Jacobian;
use crate::wear::law::{Factors, Solved};

/// A Jacobian of all slices, and the factors on the coefficient that it was made with, by slice and position.
type OfSlices = (Jacobian, Vec<Vec<Factors>>);

impl<M: ContactModel + ?Sized> ArchardSystem<'_, M> {
    /// The Jacobian of one section, where the contacts for `u` are known, and the factors on the coefficient by position; none if the contact
    /// model has no sensitivities.
    pub(super) fn jacobian_of_section(
        &self,
        n: f64,
        u: &[f64],
    ) -> Result<Option<(Jacobian, Vec<Factors>)>, WearError> {
        let (law, solved) = (self.law(), &self.known(u).slices[0]);
        let (cycle, contacts) = (law.cycle, &solved.contacts);
        let blocks: Vec<Option<DMatrix<f64>>> = contacts
            .par_iter()
            .enumerate()
            .map(|(q, contact)| self.model.sensitivity(q, contact))
            .collect::<Result<_, _>>()?;
        let Some(blocks) = blocks.into_iter().collect::<Option<Vec<_>>>() else {
            return Ok(None);
        };
        let view = law.view(n, u);
        let mut jacobian = PatchyMatrix::new(u.len());
        let mut all_factors = Vec::with_capacity(contacts.len());
        let reads = law.added_reads(&view, solved, &law.reads(solved));
        for (q, ((contact, block), reads)) in contacts.iter().zip(blocks).zip(reads).enumerate() {
            let (local, factors) = Local::new(&law, &view, &cycle.positions[q], contact, reads);
            all_factors.push(factors);
            local.add(&block, &mut jacobian);
        }
        Ok(Some((Jacobian::Full(jacobian), all_factors)))
    }

    /// The Jacobian of all slices, where the contacts for `u` are known: each by itself at a given approach, and what the common approach of each
    /// position adds. With the factors on the coefficient, by slice and position; none if the contact model has no sensitivities.
    pub(super) fn jacobian_of_slices(
        &self,
        model: &dyn SlicedContact,
        n: f64,
        u: &[f64],
    ) -> Result<Option<OfSlices>, WearError> {
        let (law, joint) = (self.law_at(u), self.known(u));
        let cycle = law.cycle;
        let positions = cycle.positions.len();
        let size = cycle.stations.count();
        let sensitivities = (0..positions)
            .into_par_iter()
            .map(|turn| {
                let at = model.slices().all_at(turn, positions);
                let own = joint.slices.iter().zip(at);
                let contacts: Vec<&PositionContact> = own.map(|(s, q)| &s.contacts[q]).collect();
                model.sensitivities(turn, &contacts)
            })
            .collect::<Result<Option<Vec<_>>, _>>()?;
        let Some(sensitivities) = sensitivities else {
            return Ok(None);
        };
        let weights = &model.slices().weight;
        let of_slice = |(i, solved): (usize, &Solved)| {
            let view = law.view(n, &solved.u);
            let reads = law.added_reads(&view, solved, &law.reads(solved));
            let mut block = PatchyMatrix::new(size);
            let mut drive = Mat::zeros(size, positions);
            let mut follow = Mat::zeros(size, positions);
            let mut all_factors = Vec::with_capacity(positions);
            for (q, (contact, reads)) in solved.contacts.iter().zip(reads).enumerate() {
                let (local, factors) = Local::new(&law, &view, &cycle.positions[q], contact, reads);
                all_factors.push(factors);
                let turn = model.slices().turn_of(i, q, positions);
                let sensitivity = &sensitivities[turn][i];
                local.add(&sensitivity.fixed, &mut block);
                local.drives(&sensitivity.drive, drive.col_as_slice_mut(turn));
                local.follows(
                    &sensitivity.follow,
                    weights[i],
                    follow.col_as_slice_mut(turn),
                );
            }
            (block, drive, follow, all_factors)
        };
        let parts: Vec<_> = (joint.slices.par_iter().enumerate())
            .map(of_slice)
            .collect();
        let (mut blocks, mut drive, mut follow) = (Vec::new(), Vec::new(), Vec::new());
        let mut factors = Vec::new();
        for part in parts {
            blocks.push(part.0);
            drive.push(part.1);
            follow.push(part.2);
            factors.push(part.3);
        }
        let jacobian = Jacobian::Blocks {
            blocks,
            drive,
            follow,
        };
        Ok(Some((jacobian, factors)))
    }
}
