//! What the held-out tests say of effects that the fitted ones cannot tell apart.

use super::ranked::Ranked;
use crate::learn::decision::{Decision, Verdict};
use crate::learn::hypothesis::Hypothesis;
use crate::numeric::written::fixed;

/// Difference of the whole χ² of the held-out tests from which it is worth a word: three standard deviations of one value.
const CLEARLY: f64 = 9.0;

/// Which of the rivals does better on tests that none was fitted to, of so many rows; none where they differ by no more than chance, or
/// another verdict than an ambiguous one was reached.
pub(super) fn better_on_held_out(
    decision: &Decision,
    ranking: &[Ranked],
    rows: usize,
) -> Option<String> {
    if decision.verdict != Verdict::Ambiguous {
        return None;
    }
    let is_rival = |entry: &&Ranked| {
        matches!(entry.effect, Hypothesis::Effects(_)) && decision.group.contains(&entry.effect)
    };
    let judged = ranking.iter().filter(is_rival);
    let mut judged: Vec<(f64, &Ranked)> = judged
        .filter_map(|entry| Some((entry.holdout_chi2_per_point?, entry)))
        .collect();
    judged.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (&(least, best), others) = judged.split_first()?;
    let behind = others
        .iter()
        .filter(|(chi2, _)| rows as f64 * (chi2 - least) > CLEARLY)
        .map(|(chi2, other)| format!("{} with {}", fixed(*chi2, 2), other.effect.in_words()));
    let behind: Vec<String> = behind.collect();
    (!behind.is_empty()).then(|| {
        format!(
            "On the held-out tests, which these probabilities do not count, {} does better: χ² per point {}, against {}.",
            best.effect.in_words(),
            fixed(least, 2),
            behind.join(" and ")
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::find;
    use crate::learn::hypothesis::EffectSet;
    use crate::learn::prediction::fidelity::Fidelity;

    #[test]
    fn only_clear_differences_between_rivals_are_told() {
        let of = |name: &str| Hypothesis::Effects(EffectSet::new([find(name).unwrap()]));
        let names = ["extra_flexibility", "lead_crowning", "lead_misalignment"];
        let entry = |name: &str, chi2: Option<f64>| Ranked {
            effect: of(name),
            form: String::new(),
            probability: 0.3,
            evidence_gain: 0.0,
            parameters: Vec::new(),
            wear_coefficient: 1e-10,
            fit_chi2_per_point: 1.0,
            holdout_chi2_per_point: chi2,
            angle_to_leader: None,
            decided_by: Fidelity::Full,
            converged: true,
        };
        let mut decision = Decision {
            verdict: Verdict::Ambiguous,
            log_probabilities: std::collections::BTreeMap::new(),
            effects: Vec::new(),
            group: names.iter().map(|name| of(name)).collect(),
        };
        let ranking = [
            entry(names[0], Some(1.10)),
            entry(names[1], Some(1.03)),
            entry(names[2], Some(1.41)),
            // no rival, and one that was not tried on them
            entry("coating", Some(3.0)),
            entry(names[2], None),
        ];
        let told = |decision: &Decision, rows| better_on_held_out(decision, &ranking, rows);
        assert_eq!(
            told(&decision, 40).unwrap(),
            "On the held-out tests, which these probabilities do not count, lead_crowning does better: χ² per point 1.03, against 1.41 with lead_misalignment."
        );
        // 20 rows differ by 7.6
        assert_eq!(told(&decision, 20), None);
        decision.verdict = Verdict::Effect;
        assert_eq!(told(&decision, 40), None);
    }
}
