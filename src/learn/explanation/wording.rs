//! What all sentences are made of: the answer's parts, figures in words.

use super::findings::Findings;
use super::ranked::parameters;
use crate::learn::candidates::fitted_candidate::FittedCandidate;
use crate::learn::hypothesis::candidate::Candidate;

/// The verdict in words.
pub(super) struct Explanation {
    pub(super) sentence: String,
    /// Why, and what cannot be concluded.
    pub(super) reasons: Vec<String>,
    pub(super) next_step: String,
}

/// χ² per point of the base model.
pub(super) fn before(findings: &Findings<'_>) -> f64 {
    chi2(findings, &findings.base.fitted)
}

pub(super) fn chi2(findings: &Findings<'_>, fitted: &FittedCandidate) -> f64 {
    let likelihood = &findings.context.likelihood;
    likelihood.chi2_per_point(&fitted.found.model)
}

/// `98 %`, never a certainty.
pub(super) fn percent(p: f64) -> String {
    if p > 0.999 {
        "over 99.9 %".to_owned()
    } else if p > 0.0 && p < 0.001 {
        "under 0.1 %".to_owned()
    } else {
        let digits = usize::from(!(0.1..=0.9).contains(&p));
        format!("{:.digits$} %", 100.0 * p)
    }
}

/// `amplitude 1.81 ± 0.04, decay_cycles 127 000 ± 3000 cycles`.
pub(super) fn values(j: &FittedCandidate) -> String {
    let all: Vec<String> = parameters(j)
        .iter()
        .map(|p| {
            let unit = if p.unit == "-" {
                String::new()
            } else {
                format!(" {}", p.unit)
            };
            match p.skewed_interval() {
                Some([low, high]) => format!(
                    "{} {}{unit} (95 %: {} to {})",
                    p.name,
                    three_digits(p.value),
                    three_digits(low),
                    three_digits(high)
                ),
                None => format!("{} {}{unit}", p.name, uncertain(p.value, p.sigma)),
            }
        })
        .collect();
    all.join(", ")
}

/// A value to three digits.
fn three_digits(value: f64) -> String {
    if !(1e-2..1e6).contains(&value.abs()) {
        return format!("{value:.2e}");
    }
    let digits = (2.0 - value.abs().log10().floor()).clamp(0.0, 4.0) as usize;
    grouped(value, digits)
}

/// The commands that add a candidate's effects in its forms, one after the other.
pub(super) fn added(candidate: &Candidate) -> String {
    let several = candidate.effects.len() > 1;
    let added = candidate.added_forms().map(|(card, form)| match form {
        None if several => format!("gearwear add STUDY {} --form own", card.name),
        None => format!("gearwear add STUDY {}", card.name),
        Some(form) => format!("gearwear add STUDY {} --form \"{}\"", card.name, form.name),
    });
    (added.collect::<Vec<_>>()).join(", then the same with the new study: ")
}

/// A value and its standard deviation with as many digits as the latter has two of.
fn uncertain(value: f64, sigma: f64) -> String {
    let size = value.abs().max(sigma);
    let exponent = if size != 0.0 && !(1e-2..1e6).contains(&size) {
        size.log10().floor() as i32
    } else {
        0
    };
    let scale = 10f64.powi(exponent);
    let (value, sigma) = (value / scale, sigma / scale);
    let digits = if sigma > 0.0 {
        (1.0 - sigma.log10().floor()).clamp(0.0, 6.0) as usize
    } else {
        3
    };
    let both = format!("{} ± {}", grouped(value, digits), grouped(sigma, digits));
    match exponent {
        0 => both,
        _ => format!("({both})·10{}", superscript(exponent)),
    }
}

/// A number with narrow gaps between thousands from five digits on.
fn grouped(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    let end = text.find('.').unwrap_or(text.len());
    let start = usize::from(text.starts_with('-'));
    if end - start < 5 {
        return text;
    }
    let gap = |i: usize| i > start && i < end && (end - i).is_multiple_of(3);
    let all = text.char_indices();
    all.flat_map(|(i, c)| gap(i).then_some('\u{202f}').into_iter().chain([c]))
        .collect()
}

/// An exponent as people write it.
fn superscript(exponent: i32) -> String {
    let digit = |c: char| match c {
        '-' => '\u{207b}',
        '1' => '\u{b9}',
        '2' => '\u{b2}',
        '3' => '\u{b3}',
        c => char::from_u32(0x2070 + c.to_digit(10).unwrap_or_default()).unwrap_or(c),
    };
    exponent.to_string().chars().map(digit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_share_the_digits_and_the_power_of_their_error() {
        assert_eq!(uncertain(1.8194, 0.0353), "1.819 ± 0.035");
        assert_eq!(uncertain(123_859.0, 4665.6), "123\u{202f}859 ± 4666");
        assert_eq!(uncertain(1.239e7, 4.7e5), "(1.239 ± 0.047)·10\u{2077}");
        assert_eq!(
            uncertain(3.1e-10, 2e-12),
            "(3.100 ± 0.020)·10\u{207b}\u{b9}\u{2070}"
        );
        assert_eq!(uncertain(0.0271, 0.0017), "0.0271 ± 0.0017");
        assert_eq!(uncertain(8.95, 0.0), "8.950 ± 0.000");
    }
}
