//! What a test of a first campaign adds to those before it, and which effects all of them leave unseen, in words.

use crate::learn::experiment::candidate_tests::{CLEAR, made_up_chi2};
use crate::learn::experiment::plan::EffectVisibility;

/// Most effects that are named one by one.
const NAMED: usize = 4;

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
    let gains =
        |(before, now): &(&EffectVisibility, &EffectVisibility)| capped(now) > capped(before);
    let nearest = both().filter(gains);
    let nearest = nearest.max_by(|a, b| capped(a.1).total_cmp(&capped(b.1)));
    let Some((before, now)) = nearest else {
        return "adds certainty, but no effect more".to_owned();
    };
    let figure = |chi2: f64| made_up_chi2(chi2, 2);
    let (what, figures) = if !now.detectable {
        let [from, to] = [before, now].map(|e| figure(e.detection_chi2));
        (String::new(), format!("from {from} to {to}"))
    } else if before.nearest == now.nearest {
        let [from, to] = [before, now].map(|e| figure(e.nearest_chi2));
        (
            format!(" against {}", now.nearest),
            format!("from {from} to {to}"),
        )
    } else {
        // another look-alike: what stood against the former one is no beginning
        let to = figure(now.nearest_chi2);
        (format!(" against {}", now.nearest), format!("to {to}"))
    };
    format!(
        "no effect more; brings {}{what} nearest to the χ² of {CLEAR} that counts, {figures}",
        now.effect
    )
}

/// A sentence with the effects that no test shows, a space before it; nothing where all show.
pub(super) fn not_shown(effects: &[EffectVisibility]) -> String {
    let unseen = effects.iter().filter(|effect| !effect.detectable);
    let unseen: Vec<String> = unseen
        .map(|e| format!("{} (χ² {})", e.effect, made_up_chi2(e.detection_chi2, 2)))
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

    /// The nearest is not the one that gains most, and a χ² against another look-alike is not where it began.
    #[test]
    fn the_effect_that_comes_nearest_is_named() {
        let before = [effect("a", 9.0, 4.5), effect("b", 1.0, 0.5)];
        let mut now = [effect("a", 20.0, 5.0), effect("b", 5.5, 0.5)];
        let told = adds(&before, &now);
        assert!(
            told.contains("brings a against other nearest") && told.ends_with("from 4.5 to 5.0"),
            "{told}"
        );
        now[0].nearest = "third".to_owned();
        let told = adds(&before, &now);
        assert!(
            told.ends_with("brings a against third nearest to the χ² of 6 that counts, to 5.0"),
            "{told}"
        );
    }

    #[test]
    fn what_is_not_shown_is_named() {
        let all = [effect("a", 5.57e11, 9.0), effect("b", 1.25, 0.5)];
        assert_eq!(not_shown(&all), " Not shown: b (χ² 1.2).");
        assert_eq!(not_shown(&all[..1]), "");
        assert_eq!(made_up_chi2(5.57e11, 2), "> 1000");
    }
}
