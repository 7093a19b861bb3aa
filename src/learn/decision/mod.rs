//! Stage 6, decision: what the evidence of all fits says together, by one rule.

mod evidence;
pub(in crate::learn) mod judged_candidates;
mod posterior;
mod rule;
mod verdict;

pub use evidence::{
    CandidateEvidence, Evidence, LawAloneEvidence, LawBesideEvidence, LawInsteadEvidence,
    RemainderEvidence,
};
pub use rule::DecisionRule;
pub(in crate::learn) use rule::SURE;
pub use verdict::{Decision, Verdict, decide};
