//! Floor 0: text files that a user wrote, and the message when one of them is not right. Knows nothing of studies,
//! measurements and gears.

mod diagnostic;
mod error;
mod file;
mod source;

pub use diagnostic::{Diagnostic, Fault, begins, is_misspelt, list, nearest};
pub use error::TextError;
pub use file::{Wanted, read};
pub use source::Source;
