//! An effect of the catalogue beside something that the catalogue does not hold: each is said.

use gearwear::learn::diagnose::{Diagnosis, Hypothesis, Named, Verdict};
use gearwear::report;

use super::diagnosed;

/// Waves of hardness along the flank, of either gear's own radii.
const WAVES: &str = "[[effect]]\nkind = \"formula\"\nname = \"waves\"\nwear_factor = \"1 + a*sin(2*3.14159265*radius/0.9)\"\n\
     [effect.parameters]\na = { value = 0.35, lower = 0.0, upper = 1.0 }\n";

const RUNNING_IN: &str = "[[effect]]\nkind = \"running_in\"\namplitude = 2.0\ndecay_cycles = 2e5\n";

#[test]
fn running_in_beside_waves_of_hardness_is_established_and_the_waves_remain() {
    let found = diagnosed(&format!("{RUNNING_IN}\n{WAVES}"), 0.05, 0.02, 31);
    assert_eq!(found.verdict, Verdict::Partial, "{:?}", found.probabilities);
    assert_eq!(
        found.effect,
        Some(Named::One("running_in".to_owned())),
        "{:?}",
        found.probabilities
    );
    assert!(found.probabilities["running_in+unknown"] > 0.85);
    let remainder = found.remainder.as_ref().expect("something remains");
    assert!(remainder.chi2_per_point > 1.2, "{remainder:?}");
    assert!(
        remainder.share > 0.05 && remainder.share < 1.0,
        "{remainder:?}"
    );
    let driver = (remainder.driver.as_ref()).expect("and depends on something");
    assert_eq!(driver.name, "position", "{driver:?}");
    assert!(found.sentence.contains("running_in"), "{}", found.sentence);
    the_page_goes_by_what_is_established(&found);
}

/// Curves, residuals and angles are those of the established effect, and the figure that the probability of the rows beside something unknown
/// follows stands in the table.
fn the_page_goes_by_what_is_established(found: &Diagnosis) {
    let after = found
        .residual_drivers
        .after
        .as_ref()
        .map(Hypothesis::to_string);
    assert_eq!(after.as_deref(), Some("running_in"));
    let first = &found.ranking[0];
    assert_eq!(first.effect.to_string(), "running_in+unknown");
    assert!(first.angle_to_leader.unwrap() < 1e-3, "{first:?}");
    let share = found.explained_share.unwrap();
    let own = found
        .screened
        .iter()
        .filter(|s| s.effects == ["running_in"]);
    let drop = own.map(|s| s.chi2_drop / found.attainable_drop);
    assert!((share - drop.fold(0.0, f64::max)).abs() < 0.05, "{share}");
    let page = report::diagnosis::page("", found, "study.toml");
    let ranking = (page.sections.iter())
        .find(|section| section.heading == "Ranking")
        .unwrap();
    let html = ranking.tables[0].html();
    let gain = found.beside_unknown[0].gain_over_unknown;
    assert!(
        html.contains("over unknown") && html.contains(&format!(">{gain:.1}<")),
        "{html}"
    );
    assert!(ranking.notes[0].contains("follows this figure"));
}

#[test]
fn waves_alone_are_no_effect_of_the_catalogue() {
    let found = diagnosed(WAVES, 0.05, 0.02, 32);
    assert_eq!(found.verdict, Verdict::Unknown, "{:?}", found.probabilities);
    assert!(found.remainder.is_none());
}

/// A factor on the approach beside a k that rises and falls with the weather: a discrepancy of the results follows most of both, and leaves running-in, which is
/// not there, nearly as much as the effect that is. Beside that one a free factor on k by the cycles does more.
#[test]
fn an_effect_beside_the_weather_is_told_by_laws_beside_it() {
    let approach = "[[effect]]\nkind = \"approach_recess\"\nasymmetry = 0.07\n";
    let weather = "[[effect]]\nkind = \"formula\"\nname = \"weather\"\nwear_factor = \"1 + 0.5*sin(2*pi*cycles/6e5 + 2)\"\n";
    let found = diagnosed(&format!("{approach}\n{weather}"), 0.05, 0.02, 33);
    let gains = |name: &str| {
        let all = &found.beside_unknown;
        let own = all.iter().find(|b| b.effects.to_string() == name);
        own.map(|b| [b.gain_with_one, b.gain_with_any].map(Option::unwrap))
            .unwrap()
    };
    let [there, not_there] = ["approach_recess", "running_in"];
    // the two figures of what an effect gains beside a discrepancy contradict each other
    let [[one, any], [other_one, other_any]] = [there, not_there].map(gains);
    assert!(
        one > other_one && any < other_any,
        "{:?}",
        found.beside_unknown
    );
    let by_laws = &found.laws_beside;
    let of = |name: &str| {
        let own = by_laws.iter().find(|l| l.effects.to_string() == name);
        own.unwrap_or_else(|| panic!("{name}: {by_laws:?}"))
    };
    // what is there is a wave
    assert_eq!(of(there).law, "learned:cycles as wave");
    assert!(of(there).evidence_gain > of(not_there).evidence_gain + 10.0);
    let page = report::diagnosis::page("", &found, "study.toml");
    let ranking = (page.sections.iter())
        .find(|section| section.heading == "Ranking")
        .unwrap();
    let said = "beside approach_recess (learned:cycles as wave)";
    assert!(ranking.notes[0].contains(said), "{:?}", ranking.notes);
    let beside = |name: &str| found.probabilities[&format!("{name}+unknown")];
    assert!(
        beside(there) > 100.0 * beside(not_there),
        "{:?}",
        found.probabilities
    );
}
