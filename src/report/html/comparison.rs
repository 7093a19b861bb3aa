//! The page of `compare`: measured against model along both flanks, places by χ², parameters.
use super::page::Page;
use crate::report::comparison::{self, Result};

/// The page of a comparison.
pub fn comparison(result: &Result<'_>) -> Page {
    Page {
        title: if result.study.title.is_empty() {
            "Measured against model".to_owned()
        } else {
            result.study.title.clone()
        },
        kicker: String::new(),
        conclusion: comparison::conclusion(result.comparison),
        sections: Vec::new(),
    }
}
