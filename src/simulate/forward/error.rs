//! Why a forward run ends early.

use crate::contact::model::ContactError;
use crate::gear::PairError;
use crate::simulate::gear_set::MOST_UNKNOWNS;
use crate::simulate::members::MemberError;
use crate::wear::archard::WearError;
use crate::wear::integrator::StepError;

/// Why a forward run ended early.
#[derive(Debug, thiserror::Error)]
pub enum ForwardError {
    /// The gears do not run at this centre distance.
    #[error(transparent)]
    Pair(#[from] PairError),
    /// They do not run where effects have moved their axes.
    #[error(
        "the study's effects move the axes {} µm {} each other than it states: {reason}",
        (1e3 * .moved.abs()).round(),
        if *.moved < 0.0 { "nearer to" } else { "farther from" }
    )]
    Moved {
        /// By how much farther apart they are, mm.
        moved: f64,
        /// Why the gears cannot run.
        reason: PairError,
    },
    /// A member could not be built.
    #[error(transparent)]
    Member(#[from] MemberError),
    /// Contact could not be solved.
    #[error(transparent)]
    Contact(#[from] ContactError),
    /// The flanks would need more elements than fit into memory.
    #[error(
        "{unknowns} unknowns on the flanks of one member, at most {MOST_UNKNOWNS} are possible: under the smallest torque the \
         elements' edges would be {edge_um:.2} µm long; a larger torque or a smaller numerics.elements_per_half_width needs fewer"
    )]
    TooFine {
        /// Unknowns on the fine flanks of the larger member.
        unknowns: usize,
        /// Length of an edge, µm.
        edge_um: f64,
    },
    /// A wear step failed.
    #[error("{0}")]
    Step(#[from] StepError<WearError>),
    /// Wear went deeper than it was followed.
    #[error("after {cycles:.3e} cycles the flanks are worn deeper than {:.0} µm", 1e3 * .deepest)]
    TooDeep {
        /// Pinion revolutions.
        cycles: f64,
        /// Depth up to which wear was followed, mm.
        deepest: f64,
    },
    /// Members or their compliance are missing since a preparation failed.
    #[error("the contact of these gears could not be prepared before")]
    Unprepared,
    /// A physical effect gave no usable number before wear began.
    #[error("{0}")]
    Effect(String),
}

impl From<WearError> for ForwardError {
    fn from(error: WearError) -> Self {
        match error {
            WearError::Contact(error) => Self::Contact(error),
            WearError::Effect(reason) => Self::Effect(reason),
        }
    }
}
