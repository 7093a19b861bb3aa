//! The new members of a run, and whose they are.

use std::sync::Arc;

use crate::simulate::blanks::Blanks;
use crate::simulate::members::Members;

/// The new members of a run.
#[derive(Clone)]
pub enum Fresh<'a> {
    /// None: the analytic model.
    None,
    /// Lent by someone who has other uses for them.
    Lent(&'a Members),
    /// The run's own; let go of once they are worn.
    Own(Arc<Members>),
    /// Let go of: only their meshes are left.
    Blanks(Arc<Blanks>),
}

impl Fresh<'_> {
    /// The members, factored and condensed.
    pub fn condensed(&self) -> Option<&Members> {
        match self {
            Fresh::Lent(members) => Some(members),
            Fresh::Own(members) => Some(members),
            Fresh::None | Fresh::Blanks(_) => None,
        }
    }

    /// Their meshes.
    pub fn blanks(&self) -> Option<&Arc<Blanks>> {
        match self {
            Fresh::Blanks(blanks) => Some(blanks),
            other => other.condensed().map(|members| &members.blanks),
        }
    }
}
