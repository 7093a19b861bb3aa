//! An effect of the catalogue beside something that the catalogue does not hold: each is said.

use gearwear::learn::diagnose::{Named, Verdict};

use crate::diagnosed;

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
    let remainder = found.remainder.expect("something remains");
    assert!(remainder.chi2_per_point > 1.2, "{remainder:?}");
    assert!(
        remainder.share > 0.05 && remainder.share < 1.0,
        "{remainder:?}"
    );
    let driver = remainder.driver.expect("and depends on something");
    assert_eq!(driver.name, "position", "{driver:?}");
    assert!(found.sentence.contains("running_in"), "{}", found.sentence);
}

#[test]
fn waves_alone_are_no_effect_of_the_catalogue() {
    let found = diagnosed(WAVES, 0.05, 0.02, 32);
    assert_eq!(found.verdict, Verdict::Unknown, "{:?}", found.probabilities);
    assert!(found.remainder.is_none());
}
