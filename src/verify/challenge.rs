//! Computed wear against data that an independent program made: `validation/challenges`, used as it stands.
//!
//! Every test of a challenge and its sealed test is run by finite elements with the answer's true wear coefficient, and
//! the depth at each measured radius is compared with the noise-free value. Running-in needs no code of its own:
//!
//! ```text
//! k(n) = k (1 + A exp(−n/n₀)) on both members  =  the base model after  n + A n₀ (1 − exp(−n/n₀))  cycles
//! ```

mod data;

use crate::gear::Member;
use crate::measure::{Observation, Quantity};
use crate::numeric::interpolate;
use crate::simulate::forward::Forward;
use crate::simulate::members::Members;
use crate::simulate::numerics::Numerics;
use crate::simulate::wear_state::{WearState, worn_area};
use crate::study::{Study, Wear};
use crate::verify::Measured;

pub use data::{Challenge, ChallengeError};

/// Largest error allowed inside a trace, relative to the trace's largest depth; the data's own error is about 0.3 %.
pub const TOLERANCE: f64 = 0.01;

/// The same for the first and last point of a trace, where the data's own error is said to be 1 to 2 %.
///
/// The first points of test D on the gear lie on the steep side of the groove that the pinion's tip corner wears; see
/// `validation/challenges/README.md` for what was measured there.
pub const END_TOLERANCE: f64 = 0.015;

/// Largest root mean square error of all depths of a challenge, relative to their traces' largest depths.
pub const RMS_TOLERANCE: f64 = 0.005;

/// Largest relative error of a mass loss.
pub const MASS_TOLERANCE: f64 = 0.005;

/// Ids and names of the challenges.
pub const NAMES: [(&str, &str); 2] = [
    ("challenge/none_L2", "none_L2"),
    ("challenge/running_in_L1", "running_in_L1"),
];

/// Whence the targets come.
pub const SOURCE: &str =
    "independent program: plane-strain elements, dense contact, Archard wear of both members";

/// Why the tolerances are what they are.
pub const REASON: &str =
    "the data's own error, about 0.3 % of a trace's largest depth, more at its ends";

/// Runs one challenge with the answer's wear coefficient at the default resolution and says what is asked of it.
///
/// # Errors
/// [`ChallengeError`].
pub fn judge(name: &str) -> Result<Vec<Measured>, ChallengeError> {
    let mut challenges = Challenge::all()?;
    challenges.retain(|challenge| challenge.name == name);
    let comparisons = compare(&challenges, Numerics::default())?;
    Ok(comparisons.iter().flat_map(measured).collect())
}

/// Id of the rows of a challenge.
fn id_of(name: &str) -> &'static str {
    NAMES
        .iter()
        .find(|known| known.1 == name)
        .map_or("challenge", |known| known.0)
}

/// Errors of one trace: the depths of one member of one test at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct TraceError {
    /// Id of the test.
    pub test: String,
    /// The member.
    pub member: Member,
    /// Pinion revolutions.
    pub cycles: f64,
    /// Largest noise-free depth, µm.
    pub depth: f64,
    /// Radius (mm) and error relative to the largest depth, computed minus noise-free, by ascending radius.
    pub points: Vec<(f64, f64)>,
}

impl TraceError {
    /// The point with the largest error of all, ends included.
    pub fn worst(&self) -> (f64, f64) {
        worst(&self.points)
    }

    /// Largest error inside the trace and largest of its two end points.
    pub fn inside_and_ends(&self) -> [f64; 2] {
        let [first, inside @ .., last] = self.points.as_slice() else {
            return [0.0, self.worst().1.abs()];
        };
        [worst(inside).1.abs(), first.1.abs().max(last.1.abs())]
    }

    /// Root mean square error.
    pub fn rms(&self) -> f64 {
        rms(self.points.iter().map(|p| p.1))
    }
}

/// A challenge compared.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// The challenge.
    pub name: &'static str,
    /// All traces.
    pub traces: Vec<TraceError>,
    /// All mass losses.
    pub masses: Vec<MassError>,
}

/// Error of one mass loss.
#[derive(Debug, Clone, PartialEq)]
pub struct MassError {
    /// Id of the test.
    pub test: String,
    /// The member.
    pub member: Member,
    /// Pinion revolutions.
    pub cycles: f64,
    /// Computed over noise-free, minus 1.
    pub error: f64,
}

/// Compares challenges by finite elements, all on the same members if their gears are the same.
///
/// # Errors
/// [`ChallengeError`].
pub fn compare(
    challenges: &[Challenge],
    numerics: Numerics,
) -> Result<Vec<Comparison>, ChallengeError> {
    let mut out = Vec::new();
    let mut built: Option<(&Study, Members)> = None;
    for challenge in challenges {
        let study = &challenge.study;
        let same = built
            .as_ref()
            .is_some_and(|(of, _)| of.gears == study.gears && of.materials == study.materials);
        if !same {
            // fine enough for every challenge with these gears
            let alike = challenges
                .iter()
                .filter(|c| c.study.gears == study.gears && c.study.materials == study.materials);
            let (torques, misalignments): (Vec<f64>, Vec<f64>) = alike
                .flat_map(|c| &c.study.tests)
                .map(|t| (t.conditions.torque_nmm, t.conditions.misalignment_mm))
                .unzip();
            let set = study.gear_set();
            built = Some((study, set.members(&numerics, &torques, &misalignments)?));
        }
        let (_, members) = built.as_ref().expect("just built");
        let mut comparison = Comparison {
            name: challenge.name,
            traces: Vec::new(),
            masses: Vec::new(),
        };
        for test in 0..study.tests.len() {
            run_test(challenge, test, members, numerics, &mut comparison)?;
        }
        out.push(comparison);
    }
    Ok(out)
}

/// Runs one test and adds its errors.
fn run_test(
    challenge: &Challenge,
    number: usize,
    members: &Members,
    numerics: Numerics,
    out: &mut Comparison,
) -> Result<(), ChallengeError> {
    let Challenge { study, data, .. } = challenge;
    let test = &study.tests[number];
    let rows: Vec<(&Observation, f64)> = data
        .observations
        .iter()
        .zip(challenge.noise_free.iter().copied())
        .filter(|(row, _)| row.test == number)
        .collect();
    let mut times: Vec<f64> = rows.iter().map(|(row, _)| row.cycles).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    let stops: Vec<f64> = times
        .iter()
        .map(|n| challenge.base_cycles(*n))
        .collect::<Result<_, _>>()?;
    let set = study.gear_set();
    let conditions = test.conditions.simulated(&Wear {
        coefficient: challenge.coefficient,
        ..study.wear
    });
    let mut forward = Forward::new(&set, Some(members), conditions, numerics)?;
    let mut states = Vec::new();
    forward.wear(&mut None, &stops, &mut |_| true, &mut |state| {
        states.push(state);
    })?;
    for (&cycles, state) in times.iter().zip(&states) {
        for member in Member::BOTH {
            let worn = Worn::new(&forward, state, member);
            let own = rows
                .iter()
                .filter(|(row, _)| row.cycles == cycles && row.member.member() == Some(member));
            let mut pairs = Vec::new();
            for (row, expected) in own {
                match (row.quantity, row.position) {
                    (Quantity::WearDepth, Some(radius)) => {
                        pairs.push((radius, worn.depth(radius), *expected));
                    }
                    (Quantity::MassLoss, _) => out.masses.push(MassError {
                        test: test.id.clone(),
                        member,
                        cycles,
                        error: worn.mass(set.face_width, set.densities) / expected - 1.0,
                    }),
                    (other, _) => {
                        return Err(ChallengeError::NotCompared {
                            name: challenge.name,
                            what: other.name().to_owned(),
                        });
                    }
                }
            }
            let depth = pairs.iter().fold(0.0, |m: f64, p| m.max(p.2));
            out.traces.push(TraceError {
                test: test.id.clone(),
                member,
                cycles,
                depth,
                points: pairs
                    .iter()
                    .map(|(radius, found, expected)| (*radius, (found - expected) / depth))
                    .collect(),
            });
        }
    }
    Ok(())
}

/// One member's worn flank.
struct Worn<'a> {
    gear: &'a crate::gear::Gear,
    arc: &'a [f64],
    /// mm.
    depth: &'a [f64],
    side: usize,
}

impl<'a> Worn<'a> {
    fn new(forward: &'a Forward, state: &'a WearState, member: Member) -> Self {
        let side = usize::from(member == Member::Gear);
        let cycle = forward.cycle();
        Self {
            gear: cycle.pair.member(member),
            arc: &cycle.stations.arc[side],
            depth: &state.depth[side],
            side,
        }
    }

    /// Depth at a radius (mm), µm.
    fn depth(&self, radius: f64) -> f64 {
        let arc = self.gear.arc(self.gear.rho_at_radius(radius));
        1e3 * interpolate(self.arc, self.depth, arc)
    }

    /// Mass lost by all teeth over the face width (mm) at the members' densities (kg/m³), mg.
    fn mass(&self, face_width: f64, densities: [f64; 2]) -> f64 {
        let volume = worn_area(self.arc, self.depth) * face_width * f64::from(self.gear.spec.teeth);
        1e-3 * densities[self.side] * volume
    }
}

/// What is asked of a comparison: each test's and member's largest errors, and the whole's.
pub fn measured(comparison: &Comparison) -> Vec<Measured> {
    let Comparison {
        name,
        traces,
        masses,
    } = comparison;
    let id = id_of(name);
    let mut out = Vec::new();
    let mut groups: Vec<(&str, Member)> =
        traces.iter().map(|t| (t.test.as_str(), t.member)).collect();
    groups.dedup();
    groups.sort();
    groups.dedup();
    for (test, member) in groups {
        let own = || {
            traces
                .iter()
                .filter(|t| t.test == test && t.member == member)
        };
        for (part, what, tolerance) in [
            (0, "inside the traces", TOLERANCE),
            (1, "at the traces' ends", END_TOLERANCE),
        ] {
            let error = own().fold(0.0, |m: f64, t| m.max(t.inside_and_ends()[part]));
            out.push(Measured::bound(
                id,
                format!("test {test}, {member}: largest error {what}, part of the largest depth"),
                error,
                tolerance,
            ));
        }
    }
    let all = traces.iter().flat_map(|t| t.points.iter().map(|p| p.1));
    out.push(Measured::bound(
        id,
        "error of all depths, root mean square, part of the traces' largest depth",
        rms(all),
        RMS_TOLERANCE,
    ));
    out.push(Measured::bound(
        id,
        "largest relative error of a mass loss",
        masses.iter().fold(0.0, |m: f64, e| m.max(e.error.abs())),
        MASS_TOLERANCE,
    ));
    out
}

/// The point with the largest error.
fn worst(points: &[(f64, f64)]) -> (f64, f64) {
    points
        .iter()
        .copied()
        .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
        .unwrap_or_default()
}

fn rms(errors: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = errors.fold((0.0, 0), |(s, n), e| (s + e * e, n + 1));
    (sum / f64::from(count.max(1))).sqrt()
}
