//! The gear pairs of the gear cases, and their contact at any mesh position.
//!
//! REF and S30 are plain pairs of module 2, FZG-C is the test gear of the FZG rig with its own rack (no tip shortening).

use crate::contact::cycle::{Cycle, PairContact, Position, Stations};
use crate::contact::fem::{CycleCompliance, FemContact, member_tooth, member_turns};
use crate::contact::model::{ContactModel, PositionContact};
use crate::gear::{BasicRack, Gear, Pair, ToothSpec};
use crate::material::Elastic;
use crate::numeric::{Vec2, rotate};
use crate::simulate::forward::GearSet;
use crate::simulate::members::Members;
use crate::simulate::numerics::Numerics;
use crate::simulate::wear_state::line_load;
use crate::verify::CaseError;

/// A gear pair with its nominal load.
#[derive(Debug, Clone)]
pub struct GearCase {
    /// Name in the reports.
    pub name: &'static str,
    /// The gears.
    pub set: GearSet,
    /// Pinion torque, N·mm.
    pub torque: f64,
}

/// What tells the pairs of the cases apart.
#[derive(Debug, Clone, Copy)]
struct Data {
    name: &'static str,
    module: f64,
    teeth: [u32; 2],
    shift: [f64; 2],
    bore: [f64; 2],
    youngs_modulus: f64,
    face_width: f64,
    torque: f64,
}

const REF: Data = Data {
    name: "REF",
    module: 2.0,
    teeth: [27, 53],
    shift: [0.0; 2],
    bore: [25.0, 40.0],
    youngs_modulus: 210_000.0,
    face_width: 33.0,
    torque: 100e3,
};

const FZG_C: Data = Data {
    name: "FZG-C",
    module: 4.5,
    teeth: [16, 24],
    shift: [0.1817, 0.1715],
    bore: [30.0; 2],
    youngs_modulus: 206_000.0,
    face_width: 14.0,
    torque: 200e3,
};

const FZG_A: Data = Data {
    name: "FZG-A",
    shift: [0.8532, -0.5],
    face_width: 20.0,
    torque: 534.5e3,
    ..FZG_C
};

const S30: Data = Data {
    name: "S30",
    teeth: [30; 2],
    bore: [16.0; 2],
    youngs_modulus: 206_000.0,
    face_width: 15.0,
    torque: 50e3,
    ..REF
};

impl Data {
    fn case(self) -> Result<GearCase, CaseError> {
        let rack = BasicRack {
            module: self.module,
            pressure_angle: 20f64.to_radians(),
            addendum: 1.0,
            dedendum: 1.25,
            fillet_radius: 0.38,
        };
        let gear = |side: usize| {
            let plain = ToothSpec::plain(self.teeth[side], self.bore[side]);
            Gear::new(
                rack,
                ToothSpec {
                    profile_shift: self.shift[side],
                    ..plain
                },
            )
            .map_err(CaseError::gears)
        };
        let gears = [gear(0)?, gear(1)?];
        let steel = Elastic {
            youngs_modulus: self.youngs_modulus,
            poisson_ratio: 0.3,
        };
        let centre_distance = Pair::zero_backlash_centre_distance(&gears[0], &gears[1]);
        Ok(GearCase {
            name: self.name,
            set: GearSet {
                gears,
                materials: [steel; 2],
                densities: [7850.0; 2],
                centre_distance,
                face_width: self.face_width,
                face: crate::gear::Face::default(),
                teeth: crate::gear::Teeth::default(),
            },
            torque: self.torque,
        })
    }
}

impl GearCase {
    /// Module 2, 27/53 teeth, bores 25 and 40 mm, 100 N·m on 33 mm, E 210 000 MPa.
    ///
    /// # Errors
    /// [`CaseError`] if the gears cannot be (a fault of the geometry code).
    pub fn reference() -> Result<Self, CaseError> {
        REF.case()
    }

    /// The same with another pinion bore diameter, mm.
    ///
    /// # Errors
    /// As [`GearCase::reference`].
    pub fn reference_with_bore(bore: f64) -> Result<Self, CaseError> {
        Data {
            bore: [bore, REF.bore[1]],
            ..REF
        }
        .case()
    }

    /// FZG type C, 16/24 teeth, bores 30 mm, 200 N·m on 14 mm, E 206 000 MPa.
    ///
    /// # Errors
    /// As [`GearCase::reference`].
    pub fn fzg_c() -> Result<Self, CaseError> {
        FZG_C.case()
    }

    /// FZG type A at load stage 12: 534.5 N·m on 20 mm.
    ///
    /// # Errors
    /// As [`GearCase::reference`].
    pub fn fzg_a() -> Result<Self, CaseError> {
        FZG_A.case()
    }

    /// Module 2, 30/30 teeth, bores 16 mm, 50 N·m on 15 mm, E 206 000 MPa.
    ///
    /// # Errors
    /// As [`GearCase::reference`].
    pub fn s30() -> Result<Self, CaseError> {
        S30.case()
    }

    /// The mounted pair.
    ///
    /// # Errors
    /// [`CaseError`] if the gears cannot run.
    pub fn pair(&self) -> Result<Pair, CaseError> {
        self.set.mount(0.0).map_err(CaseError::gears)
    }

    /// Normal load per face width at the pinion torque `torque` (N·mm), N/mm.
    pub fn load(&self, torque: f64) -> f64 {
        torque / self.set.face_width / self.set.gears[0].base_radius
    }
}

/// A case with its elastic members.
pub struct Bench {
    /// The pair and its load.
    pub case: GearCase,
    /// The mounted pair.
    pub pair: Pair,
    /// Elastic members.
    pub members: Members,
    /// Resolution.
    pub numerics: Numerics,
    /// Spacing of the contact grid over that of the flank edges.
    pub grid: f64,
}

/// Contact at chosen mesh positions.
pub struct Solved {
    /// The cycle with these positions only.
    pub cycle: Cycle,
    /// What the members look like from there.
    pub compliance: CycleCompliance,
    /// Contact of each.
    pub contacts: Vec<PositionContact>,
}

/// Which tooth pairs take part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Teeth {
    /// All that can touch.
    All,
    /// Only the pair at the path asked for, which so carries all load.
    One,
}

impl Bench {
    /// Meshes and condenses the members of `case`, fine enough for its own torque and with the teeth twice of it brings in.
    ///
    /// # Errors
    /// [`CaseError`] if a member cannot be built.
    pub fn new(case: GearCase, numerics: Numerics) -> Result<Self, CaseError> {
        let members = case
            .set
            .members(&numerics, &[case.torque, 2.0 * case.torque], &[0.0])
            .map_err(CaseError::gears)?;
        Ok(Self {
            pair: case.pair()?,
            case,
            members,
            numerics,
            grid: 1.0,
        })
    }

    /// Contact at each of `paths` (mm from the pitch point) under the pinion torque `torque` (N·mm).
    ///
    /// # Errors
    /// [`CaseError`] if a contact cannot be solved.
    pub fn solve(&self, paths: &[f64], torque: f64, teeth: Teeth) -> Result<Solved, CaseError> {
        self.solve_as(&self.pair, paths, torque, teeth)
    }

    /// As [`Bench::solve`] with a pair that differs in its tip relief (which the meshes leave out).
    ///
    /// # Errors
    /// [`CaseError`] if a contact cannot be solved.
    pub fn solve_as(
        &self,
        pair: &Pair,
        paths: &[f64],
        torque: f64,
        teeth: Teeth,
    ) -> Result<Solved, CaseError> {
        let per_width = torque / self.case.set.face_width;
        let spacing = self.grid * self.members.spacing();
        let spec = self
            .numerics
            .cycle(pair, self.case.set.modulus(), per_width, spacing);
        let stations = Stations::new(pair, spacing);
        let positions = paths
            .iter()
            .map(|&path| {
                let theta = Cycle::home(pair, spec, path / pair.base_pitch);
                let position = Position::new(pair, &stations, spec, theta);
                match teeth {
                    Teeth::All => position,
                    Teeth::One => alone(position, path),
                }
            })
            .collect();
        let cycle = Cycle {
            pair: pair.clone(),
            spec,
            stations,
            positions,
        };
        let compliance =
            CycleCompliance::new(&cycle, self.members.flanks(), 0.0).map_err(CaseError::gears)?;
        let fresh = [0, 1].map(|i| vec![0.0; cycle.stations.arc[i].len()]);
        let contacts = {
            let model = FemContact::new(&cycle, &compliance, per_width);
            (0..paths.len())
                .map(|q| model.solve(q, [&fresh[0], &fresh[1]], &[]))
                .collect::<Result<_, _>>()
                .map_err(CaseError::gears)?
        };
        Ok(Solved {
            cycle,
            compliance,
            contacts,
        })
    }
}

/// `position` with the tooth pair at `path` only.
fn alone(position: Position, path: f64) -> Position {
    let pair = &position.pairs[at_path(&position, path)];
    let own = pair.offset..pair.offset + pair.xi.len();
    Position {
        theta: position.theta,
        left_out: [f64::INFINITY; 2],
        gap: position.gap[own.clone()].to_vec(),
        arm: position.arm[own].to_vec(),
        pairs: vec![PairContact {
            offset: 0,
            ..pair.clone()
        }],
    }
}

fn at_path(position: &Position, path: f64) -> usize {
    let far = |p: &PairContact| (p.path - path).abs();
    (0..position.pairs.len())
        .min_by(|&a, &b| far(&position.pairs[a]).total_cmp(&far(&position.pairs[b])))
        .unwrap_or(0)
}

impl Solved {
    /// The tooth pair of position `q` nearest to `path`, mm.
    pub fn pair(&self, q: usize, path: f64) -> &PairContact {
        let position = &self.cycle.positions[q];
        &position.pairs[at_path(position, path)]
    }

    /// Line load of the pair at `path`, N/mm.
    pub fn load(&self, q: usize, path: f64) -> f64 {
        line_load(self.pair(q, path), &self.contacts[q])
    }

    /// Torque per face width of one tooth pair on the pinion, N·mm/mm.
    pub fn torque(&self, q: usize, pair: &PairContact) -> f64 {
        let own = pair.offset..pair.offset + pair.xi.len();
        self.contacts[q].pressure[own.clone()]
            .iter()
            .zip(&self.compliance.levers(q)[own])
            .map(|(p, l)| p * l)
            .sum()
    }

    /// Largest pressure of the pair at `path`, MPa.
    pub fn peak(&self, q: usize, path: f64) -> f64 {
        let pair = self.pair(q, path);
        self.contacts[q].pressure[pair.offset..pair.offset + pair.xi.len()]
            .iter()
            .fold(0.0, |m: f64, p| m.max(*p))
    }

    /// How many tooth pairs carry load.
    pub fn carrying(&self, q: usize) -> usize {
        self.cycle.positions[q]
            .pairs
            .iter()
            .filter(|p| line_load(p, &self.contacts[q]) > 0.0)
            .count()
    }

    /// Nodal contact forces per face width on member `side` (0 pinion, 1 gear) at position `q`, member frame, N/mm.
    pub fn nodal_forces(&self, q: usize, side: usize, bench: &Bench) -> Vec<(u32, Vec2)> {
        let position = &self.cycle.positions[q];
        let turn = member_turns(&self.cycle, position.theta)[side];
        let sign = if side == 0 { -1.0 } else { 1.0 };
        let mut out = Vec::new();
        let couplings = position.pairs.iter().zip(self.compliance.couplings(q));
        for (index, (pair, coupling)) in couplings.enumerate() {
            let tooth = member_tooth(pair, side);
            let flanks = &bench.members.members[side].mesh.flanks;
            let Some(chain) = flanks.iter().find(|f| f.tooth == tooth) else {
                continue;
            };
            let mut amount = vec![0.0; chain.nodes.len()];
            for k in 0..pair.xi.len() {
                let p = self.contacts[q].pressure[pair.offset + k];
                coupling.traces[side].scatter(k, p, &mut amount);
            }
            let traction = rotate(self.compliance.traction(&self.cycle, q, index), -turn) * sign;
            let loaded = chain.nodes.iter().zip(&amount).filter(|(_, a)| **a != 0.0);
            out.extend(loaded.map(|(&node, a)| (node, traction * *a)));
        }
        out
    }
}
