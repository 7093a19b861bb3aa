//! The error falling over the versions of a model.
use super::{Plot, Style};
use crate::learn::LadderStep;
use crate::report::ladder::Result;

/// χ² per point and root mean square over the versions.
pub fn of_ladder(result: &Result<'_>) -> Vec<Plot> {
    let points = |of: fn(&LadderStep) -> Option<f64>| -> Vec<(f64, f64)> {
        let steps = result.steps.iter().enumerate();
        steps
            .filter_map(|(i, step)| Some((i as f64 + 1.0, of(step).filter(|v| *v > 0.0)?)))
            .collect()
    };
    let last = result.steps.len() as f64;
    let names: Vec<String> = (1..=result.steps.len()).map(|i| i.to_string()).collect();
    let chi2 = Plot::new(
        "ladder_chi2",
        "Error of each version: χ² per point",
        "version",
        "χ² per point",
    )
    .curve(
        "fit tests",
        Style::Kind(0),
        points(|s| s.fit_chi2_per_point),
    )
    .curve(
        "held-out tests",
        Style::Kind(1),
        points(|s| s.holdout_chi2_per_point),
    )
    .curve("noise floor", Style::Line(4), vec![(1.0, 1.0), (last, 1.0)])
    .logarithmic()
    .with_names(names.clone());
    let rms = Plot::new(
        "ladder_rms",
        "Error of each version: worn depth",
        "version",
        "root mean square, µm",
    )
    .curve("all tests", Style::Kind(0), points(|s| s.rms_um))
    .curve("noise", Style::Line(4), noise(result))
    .with_names(names)
    .starting_at_zero();
    [chi2, rms]
        .into_iter()
        .filter(|plot| plot.curves.len() > 1)
        .collect()
}

fn noise(result: &Result<'_>) -> Vec<(f64, f64)> {
    let all = result.comparisons.iter().enumerate();
    all.filter_map(|(i, c)| Some((i as f64 + 1.0, c.noise_rms_um?)))
        .collect()
}
