//! Stage 8, explanation: the answer as a document, in figures and in sentences.

mod diagnosis;
pub(in crate::learn) mod findings;
mod held_out;
mod laws_instead;
mod learned;
mod named;
mod nothing_missing;
mod outlook;
mod ranked;
mod remainder;
mod rivals;
mod scatter;
mod sentences;
mod undecided;
mod unknown;
mod warnings;
mod wording;

pub use diagnosis::{CHECK_FIRST, Diagnosis, Named, Screened};
pub(crate) use learned::plain_in_words;
pub use ranked::{ParameterValue, Ranked};
pub use remainder::Remainder;
