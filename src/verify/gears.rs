//! The list of gear cases: geometry, contact, stiffness, load sharing, root stress and wear of whole gears.

use crate::simulate::numerics::Numerics;
use crate::verify::contact_and_wear::{Effort, Family};
use crate::verify::gear_pairs::{Bench, GearCase};
use crate::verify::{CaseError, Measured, gear_geometry, gear_stiffness};

/// Gear cases (C, D, E, F9).
pub const FAMILIES: &[Family] = &[
    Family {
        ids: &["C"],
        title: "gear geometry",
        run: |_| gear_geometry::all(),
    },
    Family {
        ids: &["E1"],
        title: "tooth stiffness by ISO 6336-1",
        run: |_| gear_stiffness::formula(),
    },
    Family {
        ids: &["E2"],
        title: "tooth pair stiffness",
        run: stiffness,
    },
];

/// Resolution of the cases.
pub fn numerics(effort: Effort) -> Numerics {
    Numerics {
        elements_per_half_width: match effort {
            Effort::Quick => 4.0,
            Effort::Full => 8.0,
        },
        ..Numerics::default()
    }
}

/// REF, FZG-C and S30 with their members.
///
/// # Errors
/// [`CaseError`] if one cannot be built.
pub fn benches(numerics: Numerics) -> Result<Vec<Bench>, CaseError> {
    [GearCase::reference()?, GearCase::fzg_c()?, GearCase::s30()?]
        .into_iter()
        .map(|case| Bench::new(case, numerics))
        .collect()
}

fn stiffness(effort: Effort) -> Result<Vec<Measured>, CaseError> {
    let benches = benches(numerics(effort))?;
    let mut out = Vec::new();
    for bench in &benches {
        out.extend(gear_stiffness::single_pair(bench)?);
    }
    out.extend(gear_stiffness::bore_and_elements(&benches[0])?);
    Ok(out)
}
