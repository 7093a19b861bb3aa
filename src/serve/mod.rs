//! Floor 9: a model for programs elsewhere, by the UM-Bridge protocol 1.0 over HTTP and JSON.
//!
//! ```text
//! bytes of a request -> http (limits, threads) -> protocol (names, sizes, faults) -> models (a Posterior) -> numbers
//! ```
//! Nothing here prints, and nothing is reached but what comes in at the listener that a caller has opened.

pub mod http;
pub mod models;
pub mod protocol;

pub use http::{Limits, serve};
pub use models::Models;
pub use protocol::{Answer, answer};
