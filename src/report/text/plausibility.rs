//! What of a run's figures no gear lives through: the model computes them all the same.

use crate::numeric::written::significant;
use crate::simulate::result::{Member, Run};

/// Largest pressure that hardened steel carries in a contact without yielding at once, MPa: three times a yield strength of 1 GPa reaches full plasticity (Johnson,
/// Contact Mechanics, 1985, section 6.3), and what gears are known to run with stays below.
const MOST_PRESSURE: f64 = 3000.0;
/// Largest pressure over the contact modulus for which strains are small: 0.06 is a half width of 0.12 radii (b/R = 2 p/E*, Johnson Eq. 4.46).
const MOST_STRAIN: f64 = 0.06;
/// Depth of wear over the module from which a tooth has lost a third of its thickness (π/2 modules at the reference circle, both flanks alike).
const MOST_WEAR: f64 = 0.25;
/// Share of the whole load in one slice from which the slices are too wide for what carries.
const MOST_IN_ONE_SLICE: f64 = 0.75;
/// Young's moduli up to which a material is a plastic, and from which a metal, MPa.
const PLASTIC: f64 = 30e3;
const METAL: f64 = 60e3;

/// One sentence for each.
pub(super) fn implausible(run: &Run) -> Vec<String> {
    let mut sentences = Vec::new();
    let [e1, e2] = run.conditions.youngs_modulus;
    let [nu1, nu2] = run.conditions.poisson_ratio;
    let modulus = 1.0 / ((1.0 - nu1 * nu1) / e1 + (1.0 - nu2 * nu2) / e2);
    let most = MOST_PRESSURE.min(MOST_STRAIN * modulus);
    if let Some((peak, _)) = run
        .first()
        .pressure_elsewhere()
        .filter(|peak| peak.0 > most)
    {
        sentences.push(format!(
            "a contact pressure of {} MPa on new flanks is more than such teeth carry elastically (about {} MPa), and the model knows no yielding: look at torque and face width, and their units",
            significant(peak, 4),
            significant(most, 2)
        ));
    }
    let slices = run.first().slices.len();
    let carried = run.first().face_load_factor();
    if slices > 1 && carried > MOST_IN_ONE_SLICE * slices as f64 {
        sentences.push(format!(
            "one of the {slices} slices carries {} % of the load on new flanks: the contact is narrower than a slice, so that pressure and wear depend on how many slices there are; take more of them, and look at \
             lead_slope and crowning and their units",
            significant(100.0 * carried / slices as f64, 2)
        ));
    }
    let [k1, k2] = run.conditions.wear_coefficient;
    let is_worn = run.last().cycles > 0.0 && k1 == k2;
    let metal = match [e1, e2] {
        [plastic, metal] if plastic < PLASTIC && metal > METAL => Some("gear"),
        [metal, plastic] if plastic < PLASTIC && metal > METAL => Some("pinion"),
        _ => None,
    };
    if let Some(metal) = metal.filter(|_| is_worn) {
        sentences.push(format!(
            "a plastic runs against a metal and both wear by one coefficient, which in fact wears the plastic nearly alone: state that of the {metal} by itself, as coefficient under [wear.{metal}]"
        ));
    }
    for member in Member::BOTH {
        let depth = 1e-3 * run.last().profile(member).max_depth();
        if depth > MOST_WEAR * run.geometry.module {
            sentences.push(format!(
                "the {} is worn {} modules deep; teeth break long before: look at the wear coefficient and the number of cycles, and their units",
                member.name(),
                significant(depth / run.geometry.module, 2)
            ));
        }
    }
    sentences
}
