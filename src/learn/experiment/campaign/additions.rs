//! What a test of a first campaign adds to those before it, and which effects all of them leave unseen, in words.

use crate::learn::experiment::candidate_tests::CLEAR;
use crate::learn::experiment::plan::EffectVisibility;
use crate::numeric::written::significant;

/// Most effects that are named one by one.
const NAMED: usize = 4;
/// χ² above which it is not told how large it is.
const LARGE: f64 = 1000.0;

/// What a test adds: the effects that are newly told apart, else those that newly show, else the one that comes nearest to it.
pub(super) fn adds(before: &[EffectVisibility], now: &[EffectVisibility]) -> String {
    let both = || before.iter().zip(now);
    let newly = |is: fn(&EffectVisibility) -> bool| -> Vec<&str> {
        let new = both().filter(|(before, now)| is(now) && !is(before));
        new.map(|(_, now)| now.effect.as_str()).collect()
    };
    let (apart, shown) = (newly(|e| e.told_apart), newly(|e| e.detectable));
    if !apart.is_empty() {
        return format!("newly tells {} from every look-alike", listed(&apart));
    }
    if !shown.is_empty() {
        return format!("newly shows {}", listed(&shown));
    }
    let gained =
        |(before, now): &(&EffectVisibility, &EffectVisibility)| capped(now) - capped(before);
    let best = both().max_by(|a, b| gained(a).total_cmp(&gained(b)));
    best.filter(|pair| gained(pair) > 0.0).map_or_else(
        || "adds certainty, but no effect more".to_owned(),
        |(before, now)| {
            let (what, chi2): (String, fn(&EffectVisibility) -> f64) = if now.detectable {
                (format!(" against {}", now.nearest), |e| e.nearest_chi2)
            } else {
                (String::new(), |e| e.detection_chi2)
            };
            format!(
                "no effect more; brings {}{what} nearest to the χ² of {CLEAR} that counts, from {} to {}",
                now.effect,
                figure(chi2(before)),
                figure(chi2(now))
            )
        },
    )
}

/// A sentence with the effects that no test shows, a space before it; nothing where all show.
pub(super) fn not_shown(effects: &[EffectVisibility]) -> String {
    let unseen = effects.iter().filter(|effect| !effect.detectable);
    let unseen: Vec<String> = unseen
        .map(|e| format!("{} (χ² {})", e.effect, figure(e.detection_chi2)))
        .collect();
    match unseen.is_empty() {
        true => String::new(),
        false => format!(" Not shown: {}.", unseen.join(", ")),
    }
}

/// How near an effect is to being told apart, no nearer than what counts.
fn capped(effect: &EffectVisibility) -> f64 {
    effect.detection_chi2.min(CLEAR) + effect.nearest_chi2.min(effect.detection_chi2).min(CLEAR)
}

fn figure(chi2: f64) -> String {
    if chi2 > LARGE {
        format!("more than {LARGE}")
    } else {
        significant(chi2, 2)
    }
}

fn listed(names: &[&str]) -> String {
    match names.len() {
        ..=NAMED => names.join(", "),
        more => format!(
            "{} and {} more",
            names[..NAMED - 1].join(", "),
            more + 1 - NAMED
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn effect(name: &str, detection_chi2: f64, nearest_chi2: f64) -> EffectVisibility {
        EffectVisibility {
            effect: name.to_owned(),
            detection_chi2,
            nearest: "other".to_owned(),
            nearest_chi2,
            detectable: detection_chi2 >= CLEAR,
            told_apart: detection_chi2.min(nearest_chi2) >= CLEAR,
        }
    }

    #[test]
    fn every_test_has_a_reason() {
        let before = [effect("a", 9.0, 2.0), effect("b", 1.0, 0.5)];
        let reason = |now: [EffectVisibility; 2]| adds(&before, &now);
        assert_eq!(
            reason([effect("a", 20.0, 8.0), effect("b", 7.0, 1.0)]),
            "newly tells a from every look-alike"
        );
        assert_eq!(
            reason([effect("a", 20.0, 2.0), effect("b", 7.0, 0.5)]),
            "newly shows b"
        );
        assert_eq!(
            reason([effect("a", 20.0, 4.8), effect("b", 1.0, 0.5)]),
            "no effect more; brings a against other nearest to the χ² of 6 that counts, from 2.0 to 4.8"
        );
    }

    #[test]
    fn what_is_not_shown_is_named() {
        let all = [effect("a", 5.57e11, 9.0), effect("b", 1.25, 0.5)];
        assert_eq!(not_shown(&all), " Not shown: b (χ² 1.2).");
        assert_eq!(not_shown(&all[..1]), "");
        assert_eq!(figure(5.57e11), "more than 1000");
    }
}
