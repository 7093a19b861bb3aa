//! Stage 4, data checks: what the measurements themselves keep from being concluded.

pub(in crate::learn) mod common_scatter;
mod fourth_differences;
pub(in crate::learn) mod goodness_of_fit;
pub(in crate::learn) mod identifiability;
pub(in crate::learn) mod noise_level;
pub(in crate::learn) mod one_part;
pub(in crate::learn) mod outlying_curves;
mod scatter_of_tests;
pub(in crate::learn) mod scatter_trend;
mod second_differences;
pub(in crate::learn) mod sufficiency;
