//! Why a sum of waves along the profile is not taken for what acts by its place on the flank.

use super::findings::Findings;
use crate::effects::variables;
use crate::learn::decision::{CandidateEvidence, PlaceLawEvidence, Verdict};

/// ln evidence by which a law must be ahead to be spoken of.
const AHEAD: f64 = 1.0;

/// What speaks for a factor on k by the place instead of a sum of waves; none where the waves are named, and where no such factor is ahead.
pub(super) fn instead_of_waves(findings: &Findings<'_>) -> Option<String> {
    let verdict = findings.posterior.decision.verdict;
    if !matches!(
        verdict,
        Verdict::Partial | Verdict::Unknown | Verdict::Ambiguous
    ) {
        return None;
    }
    let evidence = &findings.posterior.evidence;
    let laws = evidence.place_laws.iter();
    let law = laws.max_by(|a, b| a.evidence_gain.total_cmp(&b.evidence_gain))?;
    let mut with_waves: Vec<&CandidateEvidence> = (evidence.candidates.iter())
        .filter(|c| c.effects.contains(&law.instead_of))
        .collect();
    with_waves.sort_by(|a, b| b.evidence_gain.total_cmp(&a.evidence_gain));
    let best = with_waves.first()?;
    let ahead = law.evidence_gain - best.evidence_gain;
    (ahead > AHEAD).then(|| sentence(law, best, ahead))
}

fn sentence(law: &PlaceLawEvidence, best: &CandidateEvidence, ahead: f64) -> String {
    let waves = law.instead_of.in_words();
    let driver = law.law.split(':').nth(1).unwrap_or_default();
    let meaning = variables::find(driver).map_or(driver, |v| v.meaning);
    // which way it counts is told elsewhere
    let meaning = meaning.split(',').next().unwrap_or(meaning);
    let beside = match law.beside.is_empty() {
        true => String::new(),
        false => format!(" beside {}", law.beside.in_words()),
    };
    format!(
        "A fit with {} is nearly as good, but a free factor on k by the {meaning} ({}){beside} has {ahead:.0} more of ln evidence: a deviation of the profile \
         wears away, what acts there does not. So {waves} is not named.",
        best.effects.in_words(),
        law.law
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::find;
    use crate::learn::hypothesis::EffectSet;

    #[test]
    fn the_law_its_driver_and_what_it_stands_beside_are_named() {
        let set = |names: &[&str]| EffectSet::new(names.iter().map(|name| find(name).unwrap()));
        let law = PlaceLawEvidence {
            beside: set(&["debris_abrasion"]),
            instead_of: set(&["profile_form"]),
            law: "learned:s".to_owned(),
            evidence_gain: 248.0,
        };
        let best = CandidateEvidence {
            effects: set(&["debris_abrasion", "profile_form"]),
            accepted_forms: 2,
            identified: true,
            evidence_gain: 229.0,
            chi2_drop: 505.0,
            scatter_gain: 0.0,
        };
        let said = sentence(&law, &best, 19.0);
        assert!(
            said.starts_with("A fit with debris_abrasion and profile_form is nearly as good"),
            "{said}"
        );
        assert!(
            said.contains("(learned:s) beside debris_abrasion has 19 more"),
            "{said}"
        );
    }
}
