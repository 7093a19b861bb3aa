//! Traces whose fitted datum is far beyond what the study allows for one.

use crate::learn::fitting::fitted::Fit;
use crate::learn::noise::Datum;
use crate::measure::{Dataset, Quantity};
use crate::numeric::written::significant;
use crate::study::Study;

/// Datum over its prior standard deviation from which that is told.
const FAR: f64 = 4.0;

/// A sentence with the trace whose datum is furthest beyond its prior; None where none is far. Of wear depths: other datums have broad priors.
pub(super) fn far_datums(study: &Study, data: &Dataset, fit: &Fit) -> Option<String> {
    let traces = &data.traces;
    let of_wear = |datum: &&Datum| traces[datum.trace].quantity == Quantity::WearDepth;
    let wear = fit.datums.iter().filter(of_wear);
    let named = wear.map(|datum| (traces[datum.trace].name.as_str(), datum.value));
    in_words(&named.collect::<Vec<_>>(), study.noise.datum_um)
}

/// Of traces with their datums, µm.
fn in_words(datums: &[(&str, f64)], prior: f64) -> Option<String> {
    let far = (datums.iter()).filter(|(_, value)| prior > 0.0 && value.abs() > FAR * prior);
    let largest = far.clone().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let (name, value) = largest?;
    let sign = if *value < 0.0 { "−" } else { "" };
    let others = match far.count() {
        1 => String::new(),
        2 => " (and one more trace)".to_owned(),
        more => format!(" (and {} more traces)", more - 1),
    };
    Some(format!(
        "the datum of trace {name} is {sign}{} µm, {} times what [noise] datum allows{others}: its zero may be wrong, or a datum takes up wear of the \
         whole trace that the model misses",
        significant(value.abs(), 3),
        significant(value.abs() / prior, 2)
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_datum_furthest_beyond_its_prior_is_told() {
        let said = in_words(&[("a", 0.3), ("b", -2.7), ("c", 2.2)], 0.5).unwrap();
        assert!(
            said.starts_with("the datum of trace b is −2.70 µm, 5.4 times what [noise] datum allows (and one more trace):"),
            "{said}"
        );
        assert_eq!(in_words(&[("a", 1.9)], 0.5), None);
        assert_eq!(in_words(&[("a", 1.9)], 0.0), None);
    }
}
