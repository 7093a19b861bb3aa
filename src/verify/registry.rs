//! The one list of everything `validate` can run: families of cases with their ids, what they show and whence the targets.

use crate::fem::FemError;
use crate::paper::reference::ReferenceError;
use crate::verify::contact_and_wear::{self, Effort};
use crate::verify::convergence::{self, ConvergenceError};
use crate::verify::{
    CaseError, Measured, SKIPPED, Skipped, calculix, challenge, elasticity, face_slices, gears,
    helical, paper_rows, runner::Row, teeth_in_turn, worn_corner,
};

/// Cases that belong together, as the runner takes them.
#[derive(Debug, Clone)]
pub struct Entry {
    /// Cases of the benchmark list, or names of our own.
    pub ids: Vec<String>,
    /// Heading under which the family is listed.
    pub group: &'static str,
    /// What it shows.
    pub title: &'static str,
    /// Where the targets come from.
    pub source: &'static str,
    /// Why the tolerances are what they are; empty where they are those of the source.
    pub reason: &'static str,
    /// How it is run.
    pub work: Work,
}

/// How a family is run.
#[derive(Debug, Clone, Copy)]
pub enum Work {
    /// A family with two efforts.
    Family(Run),
    /// A family of the elastic solver.
    Elastic(fn() -> Result<Vec<Measured>, FemError>),
    /// Whole wear histories.
    Histories(fn() -> Result<Vec<Measured>, ConvergenceError>),
    /// Wear that an independent program computed, by the challenge's name.
    Challenge(&'static str),
    /// A family that another program on this machine is needed for; it measures nothing where that is absent, and is then skipped
    /// for the reason given.
    External(fn(Effort) -> Result<Vec<Measured>, CaseError>, &'static str),
    /// Rows that judge themselves.
    Rows(fn() -> Result<Vec<Row>, ReferenceError>),
}

/// Headings, in the order shown.
pub const GROUPS: [&str; 8] = [
    "Elements and linear solver",
    "Contact",
    "Gear geometry",
    "Gear contact",
    "Wear",
    "Wear of an independent program",
    "Numerical error",
    "Published paper",
];

type Run = fn(Effort) -> Result<Vec<Measured>, CaseError>;

/// Faces in slices, teeth that differ, helical gears: id, title, source, reason for the tolerances, cases.
const BEYOND_ONE_SECTION: [(&str, &str, &str, &str, Run); 3] = [
    (
        face_slices::ID,
        "the face in slices",
        face_slices::SOURCE,
        face_slices::REASON,
        face_slices::all,
    ),
    (
        teeth_in_turn::ID,
        "teeth that differ",
        teeth_in_turn::SOURCE,
        teeth_in_turn::REASON,
        teeth_in_turn::all,
    ),
    (
        helical::ID,
        "helical gears",
        helical::SOURCE,
        helical::REASON,
        helical::all,
    ),
];

/// Every family, group by group.
pub fn entries() -> Vec<Entry> {
    let mut all: Vec<Entry> = ELASTIC.iter().map(elastic).collect();
    let families = contact_and_wear::FAMILIES.iter().chain(gears::FAMILIES);
    all.extend(families.map(|f| family(f.ids, f.title, Work::Family(f.run))));
    all.extend(challenge::NAMES.map(|(id, name)| Entry {
        ids: vec![id.to_owned()],
        group: "Wear of an independent program",
        title: "wear of both flanks over five tests",
        source: challenge::SOURCE,
        reason: challenge::REASON,
        work: Work::Challenge(name),
    }));
    all.extend(
        BEYOND_ONE_SECTION.map(|(id, title, source, reason, run)| Entry {
            ids: vec![id.to_owned()],
            group: "Gear contact",
            title,
            source,
            reason,
            work: Work::Family(run),
        }),
    );
    all.push(Entry {
        ids: vec![calculix::ID.to_owned()],
        group: "Gear contact",
        title: "mesh positions solved again by CalculiX",
        source: calculix::SOURCE,
        reason: calculix::REASON,
        work: Work::External(calculix::all, calculix::ABSENT),
    });
    all.push(Entry {
        ids: convergence::IDS.map(str::to_owned).to_vec(),
        group: "Numerical error",
        title: "numerical error of the worn depth",
        source: "the same history with one resolution doubled",
        reason: convergence::REASON,
        work: Work::Histories(convergence::all),
    });
    all.push(Entry {
        ids: vec![worn_corner::ID.to_owned()],
        group: "Numerical error",
        title: "pressure where a worn tip corner runs in",
        source: "the same history, four times as fine",
        reason: worn_corner::REASON,
        work: Work::Histories(worn_corner::all),
    });
    all.push(Entry {
        ids: vec![paper_rows::ID.to_owned()],
        group: "Published paper",
        title: "every printed number of the published model",
        source: paper_rows::SOURCE,
        reason: "half of the last printed digit; a digit where the print was cut instead of rounded",
        work: Work::Rows(paper_rows::all),
    });
    all.sort_by_key(|entry| GROUPS.iter().position(|group| *group == entry.group));
    all
}

/// Every case that is not run, and why.
pub fn skipped() -> Vec<Skipped> {
    SKIPPED.iter().chain(&[TORQUES]).copied().collect()
}

const TORQUES: Skipped = Skipped {
    id: "D4",
    what: "pinion torques of the FZG load stages",
    reason: "inputs for validation runs, nothing to compare; stage 12 enters D3, stage 10 enters F9",
};

/// Heading for a case of the benchmark list.
pub fn group_of(id: &str) -> &'static str {
    match id.as_bytes().first() {
        Some(b'A') => GROUPS[0],
        Some(b'B') => GROUPS[1],
        Some(b'C') => GROUPS[2],
        Some(b'D' | b'E') => GROUPS[3],
        _ => GROUPS[4],
    }
}

fn family(ids: &[&'static str], title: &'static str, work: Work) -> Entry {
    let first = ids.first().copied().unwrap_or_default();
    let (source, reason) = origin(first);
    let mut ids: Vec<String> = ids.iter().map(|id| (*id).to_owned()).collect();
    for (common, families) in COMMON {
        if families.contains(&first) {
            ids.push(format!("{common}.{first}"));
        }
    }
    Entry {
        ids,
        group: group_of(first),
        title,
        source,
        reason,
        work,
    }
}

fn elastic(case: &Elastic) -> Entry {
    let (id, title, run) = *case;
    family(&[id], title, Work::Elastic(run))
}

type Elastic = (
    &'static str,
    &'static str,
    fn() -> Result<Vec<Measured>, FemError>,
);

const ELASTIC: [Elastic; 9] = [
    ("A1", "patch test of every element", elasticity::a1_patch),
    ("A2", "rigid motion", elasticity::a2_rigid_motion),
    ("A3", "manufactured solution", elasticity::a3_manufactured),
    ("A4", "thick ring under pressure", elasticity::a4_thick_ring),
    (
        "A5",
        "nearly incompressible ring",
        elasticity::a5_nearly_incompressible,
    ),
    ("A6", "elliptic membrane", elasticity::a6_elliptic_membrane),
    ("A7", "cantilever", elasticity::a7_cantilever),
    ("A8", "Cook's membrane", elasticity::a8_cook),
    (
        "A9",
        "residual of the linear solver",
        elasticity::a9_residual,
    ),
];

/// Cases that other families report beside their own: iterations and penetration of contacts, balance of the worn area.
const COMMON: [(&str, &[&str]); 2] = [
    ("B8", &["B1", "B2", "B3", "B5", "B6"]),
    ("F1", &["F2", "F3", "F4", "F6"]),
];

/// Source of the targets of a benchmark, and the reason of its tolerances where they are not the source's own.
pub(super) fn origin(id: &str) -> (&'static str, &'static str) {
    match id {
        "A1" => ("exact: linear field", "rounding"),
        "A2" => ("exact: rigid motion costs no force", "rounding"),
        "A3" => (
            "exact: theory of the elements' order",
            "0.1 below the full order",
        ),
        "A4" => ("closed form: Lamé", "discretisation of the mesh used"),
        "A5" => (
            "closed form: Lamé, ν 0.4999",
            "2 %: far below what locking costs",
        ),
        "A6" => ("published: NAFEMS LE1", "discretisation of the mesh used"),
        "A7" => (
            "closed form: Timoshenko and Goodier",
            "discretisation of the mesh used",
        ),
        "A8" => (
            "published: Cook's membrane, 23.96",
            "corner singularity of the problem",
        ),
        "A9" => ("property: equilibrium of the solution", "rounding"),
        "B1" => (
            "exact: uniform pressure (El-Abbasi and Bathe)",
            "rounding, since mortar integration is exact",
        ),
        "B2" => ("closed form: Hertz", "discretisation of the mesh used"),
        "B3" => (
            "published: NAFEMS contact benchmark 1; closed form: Hertz",
            "",
        ),
        "B5" => (
            "closed form: Cattaneo and Mindlin",
            "discretisation of the mesh used",
        ),
        "B6" => (
            "closed form: rigid flat punch",
            "finite block, singular pressure at the edges",
        ),
        "B7" => ("property: invariances of the contact problem", ""),
        "B8" => (
            "property: convergence of the contact iteration",
            "25 iterations; penetration 1e-6 of the approach",
        ),
        "F1" => (
            "exact: Archard's law",
            "rounding for the sum, 0.5 % for the area left by the flank's moved nodes",
        ),
        "F2" => ("exact: Archard's law", "rounding"),
        "F3" => ("closed form: Winkler foundation", "error of the wear steps"),
        "F4" | "F5" => (
            "closed form: parabola on a Winkler foundation",
            "error of the wear steps",
        ),
        "F6" => (
            "independent program: boundary elements",
            "the reference's own spread and the mesh",
        ),
        "F7" => (
            "closed form modes; independent program: boundary elements",
            "the reference's own spread and the mesh",
        ),
        "F8" => ("closed form: stability limit on a half plane", ""),
        "C" => (
            "closed form: involute geometry; published: GEARpie report of FZG-C",
            "last digit of the targets",
        ),
        "D1" | "D2" | "D3" | "D5" => (
            "closed form: Hertz at the contact's radii; published: GEARpie report",
            "0.1 to 0.5 % for the formula, 3 % for elements",
        ),
        "D4" => ("published: FZG test standard", ""),
        "D6" => ("property: global equilibrium", "rounding"),
        "E1" => (
            "published: ISO 6336-1, ISO/TR 6336-30",
            "last digit of the targets",
        ),
        "E2" | "E3" => (
            "independent program: plane-strain elements with Hertz pressure on the flank",
            "the two programs' assumptions about the pressure differ",
        ),
        "E4" => (
            "independent program: plane-strain elements; published: DIN 3990 value",
            "stress gradient in the fillet, 5 %",
        ),
        "F9" => (
            "closed form: single-point observation (Andersson and Eriksson)",
            "share and pressure shape of real contact, 3 %",
        ),
        "recondensation" => (
            "the same history with the members condensed anew more often",
            "",
        ),
        _ => ("", ""),
    }
}
