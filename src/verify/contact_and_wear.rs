//! The list of contact and wear cases, each at two efforts.

use crate::verify::hertz_cylinders::{self, Grid};
use crate::verify::sliding::DEFAULT_TOLERANCE;
use crate::verify::{
    CaseError, Measured, flat_punch, invariance, nafems_cylinder, partial_slip, patch, wear_block,
    wear_half_plane, wear_punch, wear_steps, wear_tolerance, wear_winkler,
};

/// How much work a family may do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Effort {
    /// Coarse meshes that still meet the tolerances, for every commit.
    Quick,
    /// The refinement studies of the validation.
    Full,
}

/// Cases that belong together.
#[derive(Debug, Clone, Copy)]
pub struct Family {
    /// Cases of the benchmark list.
    pub ids: &'static [&'static str],
    /// What they show.
    pub title: &'static str,
    /// Runs them.
    pub run: fn(Effort) -> Result<Vec<Measured>, CaseError>,
}

/// Contact (B) and wear (F) cases.
pub const FAMILIES: &[Family] = &[
    Family {
        ids: &["B1"],
        title: "contact patch test on non-matching meshes",
        run: |_| patch::all(),
    },
    Family {
        ids: &["B2"],
        title: "Hertz contact of two half cylinders",
        run: hertz,
    },
    Family {
        ids: &["B3"],
        title: "NAFEMS cylinder on block",
        run: nafems,
    },
    Family {
        ids: &["B5"],
        title: "partial slip (Cattaneo, Mindlin)",
        run: |e| partial_slip::cattaneo_mindlin(pick(e, 16, 40)),
    },
    Family {
        ids: &["B6"],
        title: "rigid flat punch on a block",
        run: |e| flat_punch::fresh(pick(e, 64, 160)),
    },
    Family {
        ids: &["B7"],
        title: "invariances, separation and overlap",
        run: |e| invariance::all(pick(e, 12, 40)),
    },
    Family {
        ids: &["F2"],
        title: "uniform block",
        run: |_| wear_winkler::uniform_block(DEFAULT_TOLERANCE),
    },
    Family {
        ids: &["F3"],
        title: "Winkler foundation, full contact",
        run: |_| wear_winkler::full_winkler(DEFAULT_TOLERANCE),
    },
    Family {
        ids: &["F3"],
        title: "order of the integrator, limits of explicit steps",
        run: |_| wear_steps::orders(),
    },
    Family {
        ids: &["F4", "F5"],
        title: "cylinder on a Winkler foundation",
        run: |e| wear_winkler::parabola(pick(e, 20, 60), DEFAULT_TOLERANCE),
    },
    Family {
        ids: &["F6"],
        title: "elastic cylinder, half plane and elements",
        run: cylinder,
    },
    Family {
        ids: &["F7"],
        title: "wearing flat punch, half plane and elements",
        run: punch,
    },
    Family {
        ids: &["F8"],
        title: "stability limit of explicit updates",
        run: |e| wear_steps::explicit_limit(pick(e, 40, 100), DEFAULT_TOLERANCE),
    },
    Family {
        ids: &["F8"],
        title: "halving the step tolerance",
        run: |e| wear_tolerance::halving(pick(e, 20, 40)),
    },
];

fn pick(effort: Effort, quick: usize, full: usize) -> usize {
    match effort {
        Effort::Quick => quick,
        Effort::Full => full,
    }
}

fn hertz(effort: Effort) -> Result<Vec<Measured>, CaseError> {
    let (meshes, corners): (&[usize], &[usize]) = match effort {
        Effort::Quick => (&[6, 10, 16], &[16]),
        Effort::Full => (&[6, 10, 16, 32, 64], &[16, 32, 64]),
    };
    let mut out = hertz_cylinders::hertz(meshes, Grid::Nodes)?;
    out.extend(hertz_cylinders::hertz(corners, Grid::Corners)?);
    out.extend(hertz_cylinders::finite_body_effect(pick(effort, 16, 48))?);
    Ok(out)
}

fn nafems(effort: Effort) -> Result<Vec<Measured>, CaseError> {
    let mut out = nafems_cylinder::frictionless(12)?;
    if effort == Effort::Full {
        out.extend(nafems_cylinder::frictionless(48)?);
    }
    Ok(out)
}

fn cylinder(effort: Effort) -> Result<Vec<Measured>, CaseError> {
    let (last, plane, elements) = match effort {
        Effort::Quick => (3.0, 20, 12),
        Effort::Full => (10.0, 60, 24),
    };
    let mut out = wear_half_plane::cylinder(plane, last, DEFAULT_TOLERANCE)?;
    out.extend(wear_block::cylinder(elements, last, DEFAULT_TOLERANCE)?);
    Ok(out)
}

fn punch(effort: Effort) -> Result<Vec<Measured>, CaseError> {
    let mut out = wear_punch::eigenvalues(pick(effort, 400, 1600));
    out.extend(wear_punch::straight(
        pick(effort, 60, 160),
        DEFAULT_TOLERANCE,
    )?);
    out.extend(wear_punch::tilted(
        pick(effort, 60, 160),
        DEFAULT_TOLERANCE,
    )?);
    out.extend(flat_punch::worn(pick(effort, 64, 160), DEFAULT_TOLERANCE)?);
    Ok(out)
}
