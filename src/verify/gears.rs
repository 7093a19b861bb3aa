//! The list of gear cases: geometry, contact, stiffness, load sharing, root stress and wear of whole gears.

use crate::simulate::numerics::Numerics;
use crate::verify::contact_and_wear::{Effort, Family};
use crate::verify::gear_pairs::{Bench, GearCase};
use crate::verify::{
    CaseError, Measured, gear_contact, gear_geometry, gear_root, gear_sharing, gear_stiffness,
    gear_wear,
};

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
        run: |e| stiffness(&benches(numerics(e))?),
    },
    Family {
        ids: &["D1", "D2", "D3"],
        title: "Hertz pressures of gears by formula",
        run: |_| gear_contact::formula(),
    },
    Family {
        ids: &["D1", "D5", "D6"],
        title: "contact pressures and equilibrium of gears",
        run: |e| contact(&benches(numerics(e))?),
    },
    Family {
        ids: &["E3"],
        title: "load share and transmission error",
        run: |e| sharing(&benches(numerics(e))?, pick(e, 24, 150)),
    },
    Family {
        ids: &["E3"],
        title: "transmission error without load",
        run: light_load,
    },
    Family {
        ids: &["E4"],
        title: "root stress",
        run: |e| root(&benches(numerics(e))?),
    },
    Family {
        ids: &["F9"],
        title: "wear per pass",
        run: passes,
    },
    Family {
        ids: &["F1", "F9", "recondensation"],
        title: "wear history of a gear pair",
        run: history,
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

fn pick(effort: Effort, quick: usize, full: usize) -> usize {
    match effort {
        Effort::Quick => quick,
        Effort::Full => full,
    }
}

fn over(
    benches: &[Bench],
    measure: impl Fn(&Bench) -> Result<Vec<Measured>, CaseError>,
) -> Result<Vec<Measured>, CaseError> {
    let mut out = Vec::new();
    for bench in benches {
        out.extend(measure(bench)?);
    }
    Ok(out)
}

/// E2 of all pairs; the refinements with the first.
///
/// # Errors
/// [`CaseError`] if a contact cannot be solved.
pub fn stiffness(benches: &[Bench]) -> Result<Vec<Measured>, CaseError> {
    let mut out = over(benches, gear_stiffness::single_pair)?;
    out.extend(over(benches, gear_stiffness::light_load)?);
    out.extend(over(&benches[..1], gear_stiffness::bore_and_elements)?);
    Ok(out)
}

/// D5 with REF, D1 with FZG-C, D6 with all.
///
/// # Errors
/// [`CaseError`] if a contact cannot be solved.
pub fn contact(benches: &[Bench]) -> Result<Vec<Measured>, CaseError> {
    let mut out = over(benches, gear_contact::equilibrium)?;
    for bench in benches {
        out.extend(match bench.case.name {
            "REF" => gear_contact::peaks(bench, "D5", [875.8, 846.8, 832.7], 0.015)?,
            "FZG-C" => gear_contact::peaks(bench, "D1", [1441.9, 1347.3, 1320.1], 0.03)?,
            _ => Vec::new(),
        });
    }
    Ok(out)
}

/// E3 of all pairs; light and double load and tip relief with the first.
///
/// # Errors
/// [`CaseError`] if a contact cannot be solved.
pub fn sharing(benches: &[Bench], positions: usize) -> Result<Vec<Measured>, CaseError> {
    let mut out = over(benches, |bench| gear_sharing::shares(bench, positions))?;
    out.extend(over(&benches[..1], |bench| {
        gear_sharing::behaviour(bench, positions)
    })?);
    Ok(out)
}

/// E3 at a millionth of the load, on a contact grid fine enough for its thousandth of a half width.
///
/// # Errors
/// [`CaseError`] if a member cannot be built or a contact not be solved.
pub fn light_load(effort: Effort) -> Result<Vec<Measured>, CaseError> {
    let mut bench = Bench::new(GearCase::reference()?, numerics(effort))?;
    bench.grid = 0.1;
    gear_sharing::light_load(&bench, 50)
}

/// E4 of all pairs.
///
/// # Errors
/// [`CaseError`] if the stresses cannot be solved.
pub fn root(benches: &[Bench]) -> Result<Vec<Measured>, CaseError> {
    over(benches, gear_root::single_pair)
}

/// F9 of REF and of FZG-C at 372.6 N·m.
///
/// # Errors
/// [`CaseError`] if a contact cannot be solved.
pub fn passes(effort: Effort) -> Result<Vec<Measured>, CaseError> {
    let mut out = gear_wear::formula()?;
    let mut heavy = GearCase::fzg_c()?;
    heavy.torque = 372.6e3;
    for case in [GearCase::reference()?, heavy] {
        let numerics = numerics(effort);
        out.extend(gear_wear::one_pass(&case, None, numerics)?);
        let bench = Bench::new(case, numerics)?;
        out.extend(gear_wear::one_pass(
            &bench.case,
            Some(&bench.members),
            numerics,
        )?);
    }
    Ok(out)
}

/// F1, F9 and recondensation along one run of REF.
///
/// # Errors
/// [`CaseError`] if the run stops early.
pub fn history(effort: Effort) -> Result<Vec<Measured>, CaseError> {
    let numerics = match effort {
        Effort::Quick => Numerics {
            elements_per_half_width: 4.0,
            positions: 50,
            ..Numerics::default()
        },
        Effort::Full => Numerics::default(),
    };
    let bench = Bench::new(GearCase::reference()?, numerics)?;
    gear_wear::history(&bench.case, &bench.members, numerics)
}
