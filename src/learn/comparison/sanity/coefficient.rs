//! Wear coefficients that say more of a unit than of wear.

/// Specific wear coefficients that a gear may have, mm²/N (a thousandth of the figure in mm³/(N m)): steel under a full film lies at the
/// lower end, unlubricated adhesive wear of metals at 1e-7 to 1e-6.
const COEFFICIENTS: [f64; 2] = [1e-13, 1e-5];
/// Factor between the fitted k and the stated one from which a unit is likelier than a poor guess.
pub(super) const FAR_FROM_STATED: f64 = 300.0;

/// A wear coefficient that nothing has.
pub(super) fn coefficient(k: f64) -> Option<String> {
    let [low, high] = COEFFICIENTS;
    let (word, hint) = if k <= 0.0 || (low..=high).contains(&k) {
        return None;
    } else if k < low {
        (
            "below",
            "values too small by their unit (mm for µm, g for mg), or cycles too many (contacts, or revolutions of the gear, times a thousand)",
        )
    } else {
        (
            "above",
            "values too large by their unit (nm for µm), cycles too few (thousands of revolutions), or a torque in N mm or kN m",
        )
    };
    Some(format!(
        "k = {k:.1e} mm²/N is {word} what gears are known to have ({low:.0e} to {high:.0e}): look for {hint}"
    ))
}

/// A wear coefficient that gears may have, but hundreds of times from what the study states: between g and mg lies a thousand.
pub(super) fn far_from_stated(k: f64, stated: f64) -> Option<String> {
    if k <= 0.0 || stated <= 0.0 || (k / stated).ln().abs() < FAR_FROM_STATED.ln() {
        return None;
    }
    let (word, by, hint) = match k / stated {
        ratio if ratio > 1.0 => ("above", ratio, "nm for µm"),
        ratio => ("below", ratio.recip(), "mm for µm, g for mg"),
    };
    Some(format!(
        "k = {k:.1e} mm²/N comes out {by:.0} times {word} the wear.coefficient that the study states, {stated:.1e}: unless that is a mere guess, look \
         at its own unit (a figure in mm³/(N m) is 1000 times that in mm²/N, one in m²/N a millionth), and at the units of the measured values ({hint}), of \
         cycles (pinion revolutions) and of the torque"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_coefficient_is_held_against_the_stated_one() {
        assert_eq!(far_from_stated(1.6e-8, 1.6e-10), None);
        let masses_in_grams = far_from_stated(3.2e-13, 1.6e-10).unwrap();
        assert!(
            masses_in_grams.contains("500 times below"),
            "{masses_in_grams}"
        );
        assert!(
            far_from_stated(1.6e-7, 1.6e-10)
                .unwrap()
                .contains("1000 times above")
        );
    }

    #[test]
    fn a_coefficient_is_doubted_outside_what_is_known() {
        for k in [2e-13, 6e-10, 9e-6] {
            assert_eq!(coefficient(k), None, "{k}");
        }
        let said = |k| coefficient(k).unwrap_or_default();
        assert!(said(4e-15).starts_with("k = 4.0e-15 mm²/N is below"));
        assert!(said(2e-5).starts_with("k = 2.0e-5 mm²/N is above"));
    }
}
