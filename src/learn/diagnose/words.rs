//! Sentences that a gear engineer can check.

use super::judge::{Base, Judge, Judged};
use super::rank::{Ranking, TEMPER};
use super::ranked::parameters;
use super::untold::untold;
use super::verdict::{Diagnosis, Verdict};
use super::warnings::{few, measured_once};
use super::{NOTHING, UNKNOWN};
use crate::effects::find;

/// Probability of nothing missing below which that is undecided. Of the blind sets of the second and third series with 0.8 or more,
/// 65 of 72 hide nothing and the others an effect of d < 6; of those with 0.5 to 0.8, 31 of 48, and one an effect of d ≥ 6.
const SURE: f64 = 0.8;

/// Writes the sentence, the reasons and the next step into a diagnosis.
pub(super) fn explain(d: &mut Diagnosis, judge: &Judge<'_>, base: &Base, ranking: &Ranking) {
    let chi2 = judge.ground.chi2_per_point(&base.judged.found.model);
    let effects = ranking.effects();
    let leader = effects
        .first()
        .and_then(|e| ranking.best_of(e.0))
        .map(|i| &ranking.judged[i]);
    let probability = |name: &str| d.probabilities.get(name).copied().unwrap_or(0.0);
    let (nothing, unknown) = (probability(NOTHING), probability(UNKNOWN));
    let after = |j: &Judged| judge.ground.chi2_per_point(&j.found.model);
    match d.verdict {
        Verdict::NothingMissing => {
            let shown = if nothing < SURE {
                "Undecided: most likely nothing is missing, but a weak effect may be"
            } else {
                "Nothing is missing that these data show"
            };
            d.sentence = format!(
                "{shown}: the base model stands at χ² {chi2:.2} per point (1 is the noise), probability of nothing missing {}.",
                percent(nothing)
            );
            if let Some(j) = leader.filter(|_| nothing < 0.95) {
                let name = j.candidate.name();
                d.reasons.push(format!(
                    "Next would be {name} ({}), which lowers χ² per point to {:.3}: too little against the chance of so many candidates.",
                    percent(probability(&name)),
                    after(j)
                ));
            }
            let ground = &judge.ground;
            d.next_step = if few(ground, base) {
                d.sentence = format!(
                    "Too few measured values ({}) to tell whether anything is missing: the base model stands at χ² {chi2:.2} per point (1 is the noise).",
                    ground.len()
                );
                "measure more before concluding anything: gearwear plan STUDY proposes tests"
            } else if measured_once(ground).len() == ground.tests.len() {
                "no effect need be added for what these data show; what changes over life they cannot show: measure at several numbers of cycles"
            } else if nothing < SURE {
                "add no effect yet: more of the same measurements, or those that gearwear plan STUDY proposes, would decide"
            } else {
                "no effect need be added; a weak effect could still hide below the noise"
            }
            .to_owned();
        }
        Verdict::Unknown => {
            d.sentence = format!(
                "Something is missing that the catalogue does not hold (probability {}): the base model stands at χ² {chi2:.2} per point.",
                percent(unknown)
            );
            if let (Some(j), Some(share)) = (leader, d.explained_share) {
                d.reasons.push(format!(
                    "The best of the catalogue, {}, explains {} of what anything smooth could explain.",
                    j.candidate.name(),
                    percent(share.max(0.0))
                ));
            }
            d.next_step = if judge.approximate {
                "repeat with --fidelity middle: what is left may be the analytic model's own error"
            } else {
                "look at the measurements named in the warnings, if any; else write the suspected law as an [[effect]] with kind = \"formula\" and diagnose again"
            }
            .to_owned();
        }
        Verdict::Effect | Verdict::Effects => {
            let Some(j) = leader else { return };
            let name = j.candidate.names.join(" and ");
            d.sentence = format!(
                "{} missing: {name} (probability {}). With it χ² per point falls from {chi2:.2} to {:.2}; {}.",
                if j.candidate.names.len() > 1 {
                    "These effects are"
                } else {
                    "One effect is"
                },
                percent(probability(&j.candidate.name())),
                after(j),
                values(j)
            );
            d.reasons.extend(signatures(j));
            let study = "STUDY";
            let several = j.candidate.names.len() > 1;
            d.next_step = (j.candidate.names.iter().zip(&j.candidate.forms))
                .map(|(name, form)| match *form {
                    "" if several => format!("gearwear add {study} {name} --form own"),
                    "" => format!("gearwear add {study} {name}"),
                    form => format!("gearwear add {study} {name} --form \"{form}\""),
                })
                .collect::<Vec<_>>()
                .join(", then the same with the new study: ");
        }
        Verdict::Ambiguous => {
            let mut group = d.indistinguishable.first().cloned().unwrap_or_default();
            group.sort_by(|a, b| probability(b).total_cmp(&probability(a)));
            let list: Vec<String> = group
                .iter()
                .map(|name| format!("{name} ({})", percent(probability(name))))
                .collect();
            d.sentence = format!(
                "The data cannot tell apart: {}. The base model stands at χ² {chi2:.2} per point.",
                list.join(", ")
            );
            let doubted = group.iter().any(|name| name == UNKNOWN);
            let leading = leader.filter(|_| doubted);
            let unsaid = leading.and_then(|j| untold(&judge.ground, j));
            if let Some((card, parameter)) = unsaid {
                d.reasons.push(format!(
                    "These data say nothing of {parameter}, which {} is known by: any other cause that makes the same pattern would look alike. What would show it: {}.",
                    card.name, card.separated_by
                ));
            } else if let (true, Some(j), Some(share)) = (doubted, leader, d.explained_share) {
                d.reasons.push(format!(
                    "{} explains {} of what there is to explain: too much to pass over, too little to rule out something that the catalogue does not hold, or a spoiled measurement.",
                    j.candidate.name(),
                    percent(share.max(0.0))
                ));
            }
            d.next_step = match (&d.next_experiment, unsaid) {
                (Some(_), _) => "make the proposed test before adding one of them".to_owned(),
                (None, Some((card, _))) => {
                    format!("what shows whether it is {}: {}", card.name, card.separated_by)
                }
                (None, None) => "no single test made like these tells them apart: gearwear plan STUDY ranks others; or add each in turn and see which lowers the held-out error".to_owned(),
            };
        }
    }
    if let Some(driver) = &d.driver {
        d.reasons.push(format!(
            "The discrepancy depends most on {}: {} of its variance.",
            driver.name,
            percent(driver.variance_share)
        ));
        if driver.name == "trace" {
            d.reasons.push("Traces are shifted or tilted each by itself, as wear of the same teeth is not: look at centring, base radius, datum and temperature of the measuring machine, and whether they are of the same tooth.".to_owned());
        }
    }
    if let Some(j) = leader.filter(|_| matches!(d.verdict, Verdict::Effect | Verdict::Effects)) {
        let runner = effects
            .get(1)
            .and_then(|e| ranking.best_of(e.0))
            .map(|i| &ranking.judged[i]);
        if let Some(other) = runner {
            d.reasons.push(format!(
                "Why not {}: fitted as well as it can be it leaves χ² {:.2} per point, {}.",
                other.candidate.name(),
                after(other),
                against((j.log_evidence - other.log_evidence) / TEMPER)
            ));
            let separated = other.candidate.names.first().and_then(|n| find(n).ok());
            if let Some(card) = separated.filter(|_| j.log_evidence - other.log_evidence < 5.0) {
                d.reasons.push(format!(
                    "What tells {} from its look-alikes: {}.",
                    card.name, card.separated_by
                ));
            }
        }
    }
    for missing in &d.not_judged {
        d.reasons.push(format!(
            "Not judged: {}, which needs {} in the study.",
            missing.effect,
            missing.needs.join(", ")
        ));
    }
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

fn against(log: f64) -> String {
    if log > 14.0 {
        "more than a million times less probable".to_owned()
    } else {
        format!(
            "about {:.0} times less probable by the data",
            log.max(0.0).exp()
        )
    }
}

/// `amplitude 1.81 ± 0.04, decay_cycles (1.27 ± 0.03)e5 cycles`.
fn values(j: &Judged) -> String {
    let all: Vec<String> = parameters(j)
        .iter()
        .map(|p| {
            let unit = if p.unit == "-" {
                String::new()
            } else {
                format!(" {}", p.unit)
            };
            format!("{} {}{unit}", p.name, uncertain(p.value, p.sigma))
        })
        .collect();
    all.join(", ")
}

/// A value and its standard deviation with as many digits as the latter has two of.
fn uncertain(value: f64, sigma: f64) -> String {
    let size = value.abs().max(sigma);
    let exponent = if size != 0.0 && !(1e-2..1e4).contains(&size) {
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
    let both = format!("{value:.digits$} ± {sigma:.digits$}");
    match exponent {
        0 => both,
        _ => format!("({both})e{exponent}"),
    }
}

fn signatures(j: &Judged) -> Vec<String> {
    let cards = j.candidate.names.iter().filter_map(|name| find(name).ok());
    cards
        .map(|card| format!("How {} shows: {}.", card.name, card.signature))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::uncertain;

    #[test]
    fn values_share_the_digits_and_the_power_of_their_error() {
        assert_eq!(uncertain(1.8194, 0.0353), "1.819 ± 0.035");
        assert_eq!(uncertain(123_859.0, 4665.6), "(1.239 ± 0.047)e5");
        assert_eq!(uncertain(0.0271, 0.0017), "0.0271 ± 0.0017");
        assert_eq!(uncertain(8.95, 0.0), "8.950 ± 0.000");
    }
}
