//! Names of uncertainties that are not one standard deviation.

use super::{folded, telling};

/// Names of several standard deviations.
const EXPANDED: [&str; 7] = [
    "u95",
    "expandeduncertainty",
    "erweiterteunsicherheit",
    "erweitertemessunsicherheit",
    "incertezzaestesa",
    "incertitudeelargie",
    "incertidumbreexpandida",
];

/// What stands behind the number of several standard deviations.
const SIGMAS: [&str; 9] = [
    "sigma",
    "sigmas",
    "\u{3c3}",
    "s",
    "sd",
    "std",
    "stdev",
    "standarddeviations",
    "standardabweichungen",
];

/// Names of confidence intervals.
const CONFIDENCE_INTERVALS: [&str; 10] = [
    "ci",
    "confidenceinterval",
    "confidence",
    "konfidenzintervall",
    "konfidenzbereich",
    "vertrauensbereich",
    "vertrauensintervall",
    "intervalloconfidenza",
    "intervalleconfiance",
    "intervaloconfianza",
];

/// Whether a name means several standard deviations, without saying how many. By the GUM a capital `U` alone does, a small one is one
/// standard deviation.
pub(in crate::measure) fn is_expanded_uncertainty(name: &str) -> bool {
    name.trim() == "U" || EXPANDED.contains(&telling(name).concat().as_str())
}

/// How many standard deviations a name means that says so in front: `2 sigma`, `3s`.
pub(in crate::measure) fn sigmas(name: &str) -> Option<u32> {
    let name = folded(name);
    let digits = name.trim_start_matches(|c: char| c.is_ascii_digit());
    let is_sigma = SIGMAS.contains(&digits);
    is_sigma.then(|| name[..name.len() - digits.len()].parse().ok())?
}

/// Whether a header means a confidence interval, with or without its level.
pub(in crate::measure) fn is_confidence_interval(header: &str) -> bool {
    let (name, _) = header.split_once('[').unwrap_or((header, ""));
    let name = telling(name).concat();
    let level = |c: char| c.is_ascii_digit();
    CONFIDENCE_INTERVALS.contains(&name.trim_matches(level))
}
