//! A comparison in words: the sentence at the top of its page, and the lines for the terminal.
use std::path::Path;

use crate::learn::{Comparison, ParameterRecord, TestRecord};
use crate::numeric::chi_squared::normal_deviate;
use crate::numeric::written::{self, ended, percent, significant, uncertain, whole};
use crate::study::{Study, WEAR_COEFFICIENT};

/// χ² per point above which the model is reported to lack something: three standard deviations √(2/n) above 1.
fn noise_floor(points: usize) -> f64 {
    1.0 + 3.0 * (2.0 / points.max(1) as f64).sqrt()
}

/// Whether the model misses the fit tests by more than their noise.
pub(super) fn lacks(comparison: &Comparison) -> bool {
    let fit = &comparison.fit;
    fit.chi2_per_point
        .is_some_and(|chi2| chi2 > noise_floor(fit.points))
}

/// How wrong the model is, and where it fails worst.
pub fn conclusion(comparison: &Comparison) -> String {
    let mut sentences: Vec<String> = (comparison.sanity.iter())
        .map(|suspect| format!("Check first: {}", ended(suspect)))
        .collect();
    let shares = [
        (&comparison.fit, "the tests it is fitted to"),
        (&comparison.holdout, "held-out tests"),
    ];
    let parts: Vec<String> = shares
        .iter()
        .filter_map(|(share, of)| {
            Some(format!("{} on {of}", significant(share.chi2_per_point?, 3)))
        })
        .collect();
    sentences.push(format!(
        "χ² per point is {} (1 is the noise floor).",
        parts.join(", ")
    ));
    if let (Some(rms), Some(noise)) = (comparison.rms_um, comparison.noise_rms_um) {
        sentences.push(format!(
            "Worn depths are off by {} µm (root mean square); the measurements' own noise is {} µm.",
            significant(rms, 3),
            significant(noise, 3)
        ));
    }
    sentences.push(comparison.worst.clone());
    sentences.join(" ")
}

/// What was compared: contact model, effects, tests, measurements.
pub(crate) fn what(study: &Study, comparison: &Comparison) -> String {
    let effects: Vec<&str> = study.effects().iter().map(|e| e.name.as_str()).collect();
    let count = |role: &str| {
        let measured = comparison.tests.iter().filter(|t| t.points > 0);
        measured.filter(|t| t.role == role).count()
    };
    let (fit, held) = (count("fit"), count("holdout"));
    format!(
        "{} contact, {}; {} measured points of {} fit {}{}",
        study.contact.name(),
        match effects.as_slice() {
            [] => "no effect".to_owned(),
            some => format!("with {}", some.join(", ")),
        },
        whole(comparison.points),
        fit,
        if fit == 1 { "test" } else { "tests" },
        match held {
            0 => String::new(),
            n => format!(" and {n} held out"),
        }
    )
}

/// A few lines for the terminal: the figures that matter, where the files are, what to do next.
pub fn summary(result: &super::Result<'_>, folder: &Path) -> String {
    let c = result.comparison;
    let mut lines = Vec::new();
    if !result.study.title.is_empty() {
        lines.push(result.study.title.clone());
    }
    lines.push(what(result.study, c));
    for suspect in &c.sanity {
        lines.push(format!("check first: {suspect}"));
    }
    lines.push(String::new());
    figures(&mut lines, c);
    parameters(&mut lines, c);
    tests(&mut lines, &c.tests);
    lines.push(String::new());
    lines.push(c.worst.clone());
    for warning in &c.warnings {
        lines.push(format!("warning: {warning}"));
    }
    if let Some(first) = c.outliers.first() {
        lines.push(format!(
            "far off: {} more than 4 sigma from the model, the furthest {} ({} sigma)",
            match c.outliers.len() {
                1 => "1 row lies".to_owned(),
                n => format!("{} rows lie", whole(n)),
            },
            first.place,
            significant(first.standardised, 3)
        ));
    }
    lines.push(String::new());
    for (what, file) in [
        ("page:     ", "report.html"),
        ("figures:  ", "comparison.json"),
        ("residuals:", "residuals.csv"),
    ] {
        lines.push(format!("{what} {}", folder.join(file).display()));
    }
    lines.push(format!("next:      {}", next_step(result)));
    lines.push(String::new());
    lines.join("\n")
}

fn figures(lines: &mut Vec<String>, c: &Comparison) {
    let parts: Vec<String> = [(&c.fit, "fit"), (&c.holdout, "held out")]
        .iter()
        .filter_map(|(share, name)| {
            Some(format!("{} {name}", significant(share.chi2_per_point?, 3)))
        })
        .collect();
    lines.push(format!(
        "  chi2 per point    {}   (1: the noise floor)",
        parts.join(", ")
    ));
    if let (Some(rms), Some(noise)) = (c.rms_um, c.noise_rms_um) {
        lines.push(format!(
            "  worn depth        {} µm rms off, noise {} µm",
            significant(rms, 3),
            significant(noise, 3)
        ));
    }
    lines.push(format!("  scatter of k      {}", scatter(c)));
    lines.extend(members(c).map(|members| format!("  k of the members  {members}")));
    if !c.coefficient_prior.is_empty() {
        lines.push(format!("  prior of k        {}", c.coefficient_prior));
    }
}

/// k of pinion and gear where they have coefficients of their own.
pub(crate) fn members(c: &Comparison) -> Option<String> {
    let [pinion, gear] = c.member_coefficients?.map(|k| significant(k, 3));
    Some(format!(
        "pinion {pinion}, gear {gear} mm²/N: in proportion to wear.coefficient, which is a common factor here"
    ))
}

/// The scatter of k between tests. From one test there is none: what a fit holds is its prior.
pub(crate) fn scatter(c: &Comparison) -> String {
    let [low, high] = c.coefficient_scatter_interval;
    match fitted_tests(c).count() {
        0 | 1 if high > low => {
            "not known from one test; what stands for it is an assumption".to_owned()
        }
        // the tests' own k and the parameters may then be on their way to each other
        _ if !c.converged => format!(
            "{} between tests where the fit stopped without converging: not to be relied on",
            percent(c.coefficient_scatter, 2)
        ),
        count => format!(
            "{} between tests (68 %: {} to {}){}",
            percent(c.coefficient_scatter, 2),
            percent(low, 2),
            percent(high, 2),
            match is_widened_by_few_tests(c) {
                true => format!(
                    "; the interval of the common k is wide because {count} tests alone tell that scatter, and k between others may differ by more"
                ),
                false => String::new(),
            }
        ),
    }
}

/// The tests that the model was fitted to.
fn fitted_tests(c: &Comparison) -> impl Iterator<Item = &TestRecord> {
    c.tests.iter().filter(|t| t.role == "fit" && t.points > 0)
}

/// Most tests that are few.
const FEW: usize = 5;
/// How many times what the tests' own k would give by themselves the standard deviation of the common k is, from which its width asks for a reason.
const WIDE: f64 = 1.5;

/// Whether the common k is known much less well than the mean of the tests' own, for few tests tell their scatter.
fn is_widened_by_few_tests(c: &Comparison) -> bool {
    let k = c.parameters.iter().find(|p| p.name == WEAR_COEFFICIENT);
    let count = fitted_tests(c).count();
    let [low, high] = c.coefficient_scatter_interval;
    // a stated scatter is known
    let Some(k) = k.filter(|_| high > low && (2..=FEW).contains(&count)) else {
        return false;
    };
    let own = |t: &TestRecord| (t.coefficient_sigma / t.coefficient).powi(2);
    let n = count as f64;
    let of_tests = fitted_tests(c).map(own).sum::<f64>() / n;
    let of_mean = ((c.coefficient_scatter.powi(2) + of_tests) / n).sqrt();
    k.sigma / k.value > WIDE * of_mean
}

fn parameters(lines: &mut Vec<String>, c: &Comparison) {
    let longest = c.parameters.iter().map(|p| p.name.len()).max();
    // under the figures above where the names are short enough
    let longest = longest.unwrap_or(0).max(16);
    for parameter in &c.parameters {
        lines.push(format!(
            "  {:<longest$}  {}{}",
            parameter.name,
            estimate(parameter),
            if parameter.at_bound {
                "   on its bound"
            } else {
                ""
            }
        ));
    }
}

/// Where an interval would stand that the fit does not support.
pub(crate) const NO_INTERVAL: &str = "no interval: the fit does not support one";

/// A fitted value with its standard deviation and unit, or without the deviation where the fit supports none.
pub(crate) fn estimate(parameter: &ParameterRecord) -> String {
    match parameter.interval_95 {
        Some(_) => with_unit(uncertain(parameter.value, parameter.sigma), &parameter.unit),
        None => format!(
            "{} (uncertainty not known)",
            with_unit(significant(parameter.value, 4), &parameter.unit)
        ),
    }
}

/// The ends of the 95 % interval, dashes where the fit supports none.
pub(crate) fn interval(parameter: &ParameterRecord) -> [String; 2] {
    match parameter.interval_95 {
        Some(ends) => ends.map(|end| significant(end, 3)),
        None => ["–", "–"].map(str::to_owned),
    }
}

/// A figure with its unit, if it has one.
pub(crate) fn with_unit(figure: String, unit: &str) -> String {
    match unit {
        "" | "-" | "1" => figure,
        "mm2/N" => format!("{figure} mm²/N"),
        unit => format!("{figure} {}", written::unit(unit)),
    }
}

fn tests(lines: &mut Vec<String>, tests: &[TestRecord]) {
    let longest = tests.iter().map(|t| t.test.chars().count()).max();
    let width = longest.unwrap_or(0).max(4);
    lines.push(String::new());
    lines.push(format!(
        "  {:<width$}  {:<8}{:>8}{:>10}{:>10}{:>9}   {}",
        "test", "role", "points", "chi2", "bias µm", "rms µm", "k, mm²/N"
    ));
    let depth = |value: Option<f64>| value.map_or("–".to_owned(), |v| significant(v, 2));
    for test in tests {
        lines.push(format!(
            "  {:<width$}  {:<8}{:>8}{:>10}{:>10}{:>9}   {}",
            test.test,
            test.role,
            whole(test.points),
            significant(test.chi2_per_point, 3),
            depth(test.bias_um),
            depth(test.rms_um),
            uncertain(test.coefficient, test.coefficient_sigma)
        ));
    }
}

/// What to do next.
pub(super) fn next_step(result: &super::Result<'_>) -> String {
    let name = result.name;
    if !result.comparison.sanity.is_empty() {
        format!(
            "look at what stands under `check first` and put right what is wrong there, then gearwear compare {name}"
        )
    } else if result.data.has_slips() {
        format!(
            "look at the rows that stand far apart from their neighbours (gearwear check {name} lists them) and put right what is wrong there, then \
             gearwear compare {name}"
        )
    } else if lacks(result.comparison) {
        format!(
            "gearwear diagnose {name} tells whether an effect is missing, and which; gearwear add {name} EFFECT if you know it (`gearwear effects` lists them)"
        )
    } else if let Some(factor) = overstated(result.comparison) {
        format!(
            "χ² per point is far below that of noise: sigma seems to be {factor:.1} times the scatter, and what is weak stays hidden behind it (state a \
             smaller one if you know it); gearwear diagnose {name} looks for what shows all the same"
        )
    } else if fitted_tests(result.comparison).count() > 1
        && result.comparison.coefficient_scatter > UNLIKE
    {
        format!(
            "χ² per point is that of noise within each test, but k scatters by {} between them: gearwear diagnose {name} looks for what it follows",
            percent(result.comparison.coefficient_scatter, 2)
        )
    } else if result.comparison.fails_somewhere() {
        format!(
            "χ² per point of all together is near that of noise, that of the place named above is not: look at its rows, then gearwear diagnose {name}"
        )
    } else {
        // a trend over many points can be certain below the noise of each
        format!(
            "χ² per point is that of noise; gearwear diagnose {name} looks for trends weaker than that"
        )
    }
}

/// Scatter of k between tests from which it may be a law that the model lacks.
const UNLIKE: f64 = 0.15;

/// How many standard deviations χ² of the fit tests has to lie below that of noise for sigma to be too large.
const FAR_BELOW: f64 = 4.0;

/// How many times too large sigma is where χ² of the fit tests, of as many degrees of freedom as parameters and the tests' own k leave, is far below that
/// of noise.
fn overstated(comparison: &Comparison) -> Option<f64> {
    let own = comparison.tests.iter().filter(|test| test.role == "fit");
    let free = comparison.parameters.len() + own.count();
    let freedom = comparison.fit.points.checked_sub(free).filter(|f| *f > 0)? as f64;
    let mean = comparison.fit.chi2_per_point? * comparison.fit.points as f64 / freedom;
    (normal_deviate(mean, freedom) < -FAR_BELOW).then(|| mean.sqrt().recip())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learn::Comparison;
    use serde_json::{from_value, json};

    /// A comparison of some fit tests with own k known to 0.3 %, and the relative standard deviation of the common k.
    fn compared(tests: usize, scatter: f64, sigma: f64) -> Comparison {
        let test = |i: usize| {
            json!({"test": i.to_string(), "role": "fit", "coefficient": 1.0, "coefficient_sigma": 0.003, "points": 10, "chi2_per_point": 1.0,
                "bias_um": null, "rms_um": null})
        };
        let share = json!({"points": 10, "chi2_per_point": 1.0});
        let none: [u8; 0] = [];
        from_value(json!({
            "points": 10, "chi2_per_point": 1.0, "rms_um": null, "noise_rms_um": null, "fit": share, "holdout": share,
            "parameters": [{"name": "wear.coefficient", "value": 1.0, "sigma": sigma, "at_bound": false, "interval_95": [0.9, 1.1], "unit": "mm2/N"}],
            "where": none, "worst": "", "warnings": none, "tests": (0..tests).map(test).collect::<Vec<_>>(),
            "coefficient_scatter": scatter, "coefficient_scatter_interval": [0.5 * scatter, 2.0 * scatter],
            "by_member": none, "by_region": none, "by_life": none, "by_quantity": none, "ratios": none, "validation": none, "outliers": none,
            "converged": true, "log_evidence": 0.0, "evaluations": 1
        }))
        .unwrap()
    }

    /// Of 25 points, five tests and one parameter: 19 degrees of freedom.
    #[test]
    fn a_sigma_that_is_far_too_large_is_noticed() {
        let with = |chi2: f64| {
            let mut comparison = compared(5, 0.1, 0.1);
            comparison.fit.points = 25;
            comparison.fit.chi2_per_point = Some(chi2);
            overstated(&comparison)
        };
        let factor = with(0.067).unwrap();
        assert!(
            (factor - (19.0f64 / 25.0 / 0.067).sqrt()).abs() < 1e-12,
            "{factor}"
        );
        assert_eq!(with(0.4), None);
        assert_eq!(with(1.0), None);
    }

    /// Of three tests whose k agree to 0.5 % the common k may still be off by the scatter that three tests do not rule out.
    #[test]
    fn a_wide_interval_of_k_has_its_reason() {
        let said = scatter(&compared(3, 0.0054, 0.0186));
        assert!(
            said.contains("wide because 3 tests alone tell that scatter"),
            "{said}"
        );
        assert!(!scatter(&compared(3, 0.1, 0.06)).contains("wide"));
        assert!(!scatter(&compared(12, 0.0054, 0.0186)).contains("wide"));
        assert!(scatter(&compared(1, 0.25, 0.25)).contains("not known from one test"));
    }
}
