//! Why a sum of waves along the profile, a load in waves or a pair is not taken for what acts by its place on the flank, and an effect that grows for any change over time.

use super::findings::Findings;
use crate::effects::{Hook, variables};
use crate::learn::decision::{
    CandidateEvidence, Evidence, LawBesideEvidence, LawInsteadEvidence, RemainderEvidence, Verdict,
};
use crate::learn::hypothesis::Hypothesis;

/// ln evidence by which a law must be ahead to be spoken of.
const AHEAD: f64 = 1.0;

/// The same as a share of the law's gain below which an effect does nearly as well.
const NEARLY: f64 = 0.1;

/// Why a pair is not, in which nothing is a deviation of the profile.
const BOTH: &str = "one cause that stays at its place does what the two do together";
/// Why a load in waves is not.
const LOAD: &str = "a load in waves changes with the speed, what acts there does not";
/// Why waves are not named, whose deviation of the profile would wear away.
const WAVES: &str = "a deviation of the profile wears away, what acts there does not";
/// Why an effect is not that comes nearest beside another one.
const PLACE: &str = "k differs along the flank, but in another way";
/// Why an effect that changes k over time alone is not.
const SLOW_CHANGE: &str = "k changes over time, but in another way";

/// What speaks for a free factor on k instead of an effect; none where that is named, and where no such factor is ahead.
pub(super) fn instead(findings: &Findings<'_>) -> Vec<String> {
    let verdict = findings.posterior.decision.verdict;
    if !matches!(
        verdict,
        Verdict::Partial | Verdict::Unknown | Verdict::Ambiguous
    ) {
        return Vec::new();
    }
    let evidence = &findings.posterior.evidence;
    let of = |laws: &[LawInsteadEvidence], why: fn(&LawInsteadEvidence) -> &'static str| {
        instead_of_effect(laws, why, &evidence.candidates)
    };
    (of(&evidence.place_laws, why_of_place).into_iter())
        .chain(of(&evidence.time_laws, |_| SLOW_CHANGE))
        .chain(alone(evidence, verdict))
        .collect()
}

/// Why a law of the place stands instead of the effects that it replaces.
fn why_of_place(law: &LawInsteadEvidence) -> &'static str {
    match law.instead_of.single() {
        None => BOTH,
        Some(card) if !card.is_wave_along_flank() => PLACE,
        Some(card) if card.hook == Hook::LoadFactor => LOAD,
        Some(_) => WAVES,
    }
}

/// What speaks for a law alone instead of the best of effects beside something unknown; nothing where that is named.
fn alone(evidence: &Evidence, verdict: Verdict) -> Option<String> {
    let law = evidence.law_alone.as_ref()?;
    let gain = |r: &&RemainderEvidence| r.gain_over_unknown;
    let all = evidence.beside_unknown.iter();
    let best = all.max_by(|a, b| gain(a).total_cmp(&gain(b)))?;
    let ahead = evidence.law_ahead()?;
    let verb = match best.effects.single() {
        Some(_) => "comes",
        None => "come",
    };
    (ahead > AHEAD && verdict == Verdict::Unknown).then(|| {
        format!(
            "{} beside something unknown {verb} nearest of the catalogue, but a factor on k by the {} alone ({}) has {ahead:.0} more of ln evidence, by coarse \
             elements: so no effect is named.",
            best.effects.in_words(),
            meaning(&law.law),
            law.law.replace('_', " ")
        )
    })
}

/// The same of laws of one kind, and why.
fn instead_of_effect(
    laws: &[LawInsteadEvidence],
    why: fn(&LawInsteadEvidence) -> &'static str,
    candidates: &[CandidateEvidence],
) -> Option<String> {
    // of equals the first, which is instead of the leader
    let law = (laws.iter().rev()).max_by(|a, b| a.evidence_gain.total_cmp(&b.evidence_gain))?;
    let mut with_effect: Vec<&CandidateEvidence> = (candidates.iter())
        .filter(|c| c.effects.contains(&law.instead_of))
        .collect();
    with_effect.sort_by(|a, b| b.evidence_gain.total_cmp(&a.evidence_gain));
    let best = with_effect.first()?;
    let ahead = law.evidence_gain - best.evidence_gain;
    (ahead > AHEAD).then(|| sentence(law, best, (ahead, why(law))))
}

fn sentence(
    law: &LawInsteadEvidence,
    best: &CandidateEvidence,
    (ahead, why): (f64, &str),
) -> String {
    let replaced = law.instead_of.in_words();
    let meaning = meaning(&law.law);
    let beside = match law.beside.is_empty() {
        true => String::new(),
        false => format!(" beside {}", law.beside.in_words()),
    };
    let verb = match law.instead_of.single() {
        Some(_) => "is",
        None => "are",
    };
    let how = match ahead < NEARLY * law.evidence_gain {
        true => "is nearly as good",
        false => "comes nearest",
    };
    format!(
        "A fit with {} {how}, but a free factor on k by the {meaning} ({}){beside} has {ahead:.0} more of ln evidence: {why}. So \
         {replaced} {verb} not named.",
        best.effects.in_words(),
        law.law
    )
}

/// What the variable of a law is.
fn meaning(law: &str) -> &str {
    let driver = law.split([':', ' ']).nth(1).unwrap_or_default();
    let meaning = variables::find(driver).map_or(driver, |v| v.meaning);
    short(meaning)
}

/// A variable's meaning without what is told elsewhere: which way it counts, what it is in other laws.
pub(super) fn short(meaning: &str) -> &str {
    let end = meaning.find([',', '(']).unwrap_or(meaning.len());
    meaning[..end].trim_end()
}

/// Why an effect stands beside something unknown, where laws beside effects told that; none where they did not.
pub(super) fn beside(findings: &Findings<'_>) -> Option<String> {
    rather_than_unknown(findings).or_else(|| rather_than_others(findings))
}

/// Why one effect rather than others.
fn rather_than_others(findings: &Findings<'_>) -> Option<String> {
    let posterior = findings.posterior;
    let first = posterior.decision.group.first()?;
    let best = posterior.evidence.telling_law()?;
    let laws = posterior.evidence.laws_beside.iter();
    let others: Vec<&LawBesideEvidence> = laws.filter(|law| law.effects != best.effects).collect();
    let next = others
        .iter()
        .map(|law| law.evidence_gain)
        .reduce(f64::max)?;
    let ahead = best.evidence_gain - next;
    (ahead > AHEAD && *first == Hypothesis::EffectsAndUnknown(best.effects.clone()))
        .then(|| sentence_beside(best, &others, ahead))
}

/// What establishes an effect that a discrepancy of the results hides: a law beside it; none where the discrepancy alone does not hide it.
fn rather_than_unknown(findings: &Findings<'_>) -> Option<String> {
    let posterior = findings.posterior;
    let (evidence, rule) = (&posterior.evidence, &posterior.rule);
    let Some(Hypothesis::EffectsAndUnknown(effects)) = posterior.decision.group.first() else {
        return None;
    };
    let law = (evidence.laws_beside.iter()).find(|law| law.effects == *effects)?;
    let alone = evidence.unknown_alone(rule.discrepancy_tolerance, 0.0);
    let ahead = law.gain_over_base? - alone;
    let own = (evidence.beside_unknown.iter()).find(|r| r.effects == *effects)?;
    (own.gain_over_unknown < ahead && ahead > AHEAD).then(|| {
        format!(
            "{0} and a free factor on k by the {1} ({2}) have {ahead:.0} more of ln evidence, by coarse elements, than anything unknown alone: so {0} is there, \
             though a smooth discrepancy of the results would take most of what it does.",
            effects.in_words(),
            meaning(&law.law),
            law.law.replace('_', " "),
        )
    })
}

fn sentence_beside(best: &LawBesideEvidence, others: &[&LawBesideEvidence], ahead: f64) -> String {
    let names: Vec<String> = others.iter().map(|law| law.effects.in_words()).collect();
    format!(
        "Beside {0} a free factor on k by the {1} ({2}) has {ahead:.0} more of ln evidence, by coarse elements, than any such factor beside {3}: so \
         {0} comes first.",
        best.effects.in_words(),
        meaning(&best.law),
        best.law.replace('_', " "),
        names.join(" or "),
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
        let law = LawInsteadEvidence {
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
        let said = sentence(&law, &best, (19.0, WAVES));
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
