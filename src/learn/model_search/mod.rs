//! Stage 5, model search: which of the catalogue's effects, alone and in pairs, come nearest to the measurements.
//!
//! ```text
//! screening (analytic) -> nested forms -> medium fidelity (coarse finite elements) -> other valleys -> high fidelity -> pairs, pair exchange
//! ```

mod base_fit;
pub(in crate::learn) mod beside_unknown;
mod changes_alone;
pub(in crate::learn) mod context;
pub(in crate::learn) mod high_fidelity;
mod law_fits;
pub(in crate::learn) mod law_instead;
pub(in crate::learn) mod laws_beside;
pub(in crate::learn) mod learned_drivers;
pub(in crate::learn) mod matching_pursuit;
mod medium_fidelity;
mod most_missed;
mod moved_centres;
pub(in crate::learn) mod nested_forms;
mod other_valleys;
mod pair_exchange;
pub(in crate::learn) mod pair_fit;
pub(in crate::learn) mod pair_laws;
pub(in crate::learn) mod pairs;
pub(in crate::learn) mod place_laws;
pub(in crate::learn) mod plain_laws;
mod screening;
pub(in crate::learn) mod second_effects;
pub(in crate::learn) mod stages;
pub(in crate::learn) mod time_laws;
mod unseen;
