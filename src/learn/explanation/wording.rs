//! What all sentences are made of: the answer's parts, figures in words.

use super::findings::Findings;
use super::ranked::parameters;
use crate::learn::candidates::fitted_candidate::FittedCandidate;
use crate::learn::hypothesis::candidate::Candidate;
use crate::numeric::written::{self, fixed, rounded_down, significant, uncertain};
use crate::study::Role;

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

/// What χ² per point does with a fit; it may rise where the fit did not converge, or by other σ than the stated.
pub(super) fn change(from: f64, to: f64) -> String {
    if to < from {
        format!("falls from {from:.2} to {to:.2}")
    } else {
        format!("does not fall (from {from:.2} to {to:.2})")
    }
}

/// The forms of a candidate's effects that are not the cards' own, in brackets; nothing if all are.
pub(super) fn in_other_forms(candidate: &Candidate) -> String {
    let several = candidate.effects.len() > 1;
    let named = candidate.added_forms().filter_map(|(card, form)| {
        let name = form?.name;
        Some(match several {
            true => format!("{} in the form {name}", card.name),
            false => format!("in the form {name}"),
        })
    });
    let named: Vec<String> = named.collect();
    match named.is_empty() {
        true => String::new(),
        false => format!(" ({})", named.join(", ")),
    }
}

/// `98 %` of a whole, never all of it.
pub(super) fn percent(p: f64) -> String {
    with_decimals(p, usize::from(!(0.1..=0.9).contains(&p)))
}

/// A probability, with the decimals of the table of hypotheses, never a certainty.
pub(super) fn chance(p: f64) -> String {
    with_decimals(p, 1)
}

fn with_decimals(p: f64, decimals: usize) -> String {
    if p > 0.999 {
        "over 99.9 %".to_owned()
    } else if p > 0.0 && p < 0.001 {
        "under 0.1 %".to_owned()
    } else {
        format!("{} %", rounded_down(100.0 * p, decimals))
    }
}

/// What to do where candidates cannot be told apart.
pub(super) fn add_each(findings: &Findings<'_>) -> &'static str {
    let roles = &findings.context.likelihood.measured.roles;
    if roles.contains(&Role::Holdout) {
        "add each in turn and see which lowers the held-out error"
    } else {
        "hold a test out (role = \"holdout\"), add each in turn and see which lowers its error"
    }
}

/// By how much of the attainable the whole χ² falls, with both falls: a reader cannot form the share from χ² per point, which knows nothing of
/// correlated errors and falls by another one.
pub(super) fn of_attainable([fall, attainable]: [f64; 2]) -> String {
    let [fall, attainable] = [fall.max(0.0), attainable];
    if fall > attainable {
        return format!(
            "all of the attainable reduction of χ² (χ² of all rows together, with their covariance, falls by {}, where a smooth discrepancy could have brought \
             about {}; χ² per point, in each row's own sigma, falls by another share)",
            fixed(fall, 0),
            fixed(attainable, 0)
        );
    }
    format!(
        "{} of the attainable reduction of χ² ({} of about {} by which χ² of all rows together, with their covariance, could fall; χ² per point, in each \
         row's own sigma, falls by another share)",
        percent(fall / attainable.max(f64::MIN_POSITIVE)),
        fixed(fall, 0),
        fixed(attainable, 0)
    )
}

/// `amplitude 1.81 ± 0.04, decay_cycles 127 000 ± 3000 cycles`.
pub(super) fn values(j: &FittedCandidate) -> String {
    let all: Vec<String> = parameters(j)
        .iter()
        .map(|p| {
            let unit = if p.unit == "-" {
                String::new()
            } else {
                format!(" {}", written::unit(&p.unit))
            };
            match p.skewed_interval() {
                // no width that the fit does not support
                _ if !j.converged => {
                    format!(
                        "{} about {}{unit} (not converged)",
                        p.name,
                        significant(p.value, 3)
                    )
                }
                Some([low, high]) => format!(
                    "{} {}{unit} (95 %: {} to {})",
                    p.name,
                    significant(p.value, 3),
                    significant(low, 3),
                    significant(high, 3)
                ),
                None => format!("{} {}{unit}", p.name, uncertain(p.value, p.sigma)),
            }
        })
        .collect();
    all.join(", ")
}

/// The commands that add a candidate's effects in its forms, one after the other.
pub(super) fn added(candidate: &Candidate) -> String {
    let several = candidate.effects.len() > 1;
    let added = (candidate.added_forms().enumerate()).map(|(n, (card, form))| {
        let study = if n == 0 { "STUDY" } else { "NEW" };
        match form {
            None if several => format!("gearwear add {study} {} --form own", card.name),
            None => format!("gearwear add {study} {}", card.name),
            Some(form) => format!(
                "gearwear add {study} {} --form \"{}\"",
                card.name, form.name
            ),
        }
    });
    (added.collect::<Vec<_>>()).join(", then, with the study that it writes as NEW, ")
}

#[cfg(test)]
mod tests {
    use super::of_attainable;

    /// The share is the one of the figures beside it.
    #[test]
    fn a_share_of_the_attainable_stands_with_what_it_is_made_of() {
        let said = of_attainable([4261.27, 18368.8]);
        assert!(
            said.starts_with(
                "23 % of the attainable reduction of χ² (4261 of about 18\u{202f}369 "
            ),
            "{said}"
        );
        assert!(said.contains("falls by another share"), "{said}");
        let more = of_attainable([351.0, 319.0]);
        assert!(
            more.starts_with("all of the attainable reduction of χ² (χ² of all rows"),
            "{more}"
        );
        let none = of_attainable([-3.0, 50.0]);
        assert!(none.starts_with("0.0 % of the attainable"), "{none}");
    }
}
