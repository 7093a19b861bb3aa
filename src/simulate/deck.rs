//! One mesh position as an input deck of CalculiX, so that another program can solve it again.
//!
//! ```text
//! both gears as plane-strain triangles, placed as at the position; the profile deviations are the mesh's shape here
//! gear:    bore held
//! pinion:  bore turns as one,  u_x = −θ y,  u_y = θ x  at every bore node;  θ is the displacement 1 of a node of its own,
//!          and the torque per width the force 1 on it
//! step 1:  θ is held at gearwear's own answer, so that the flanks meet: before, nothing would hold the pinion
//! step 2:  θ is free under the torque; what it comes to is the other program's answer
//! contact: surface to surface, the fine flank of the gear's tooth −j on that of the pinion's tooth j, no friction,
//!          p = K · overlap  with  K = 100 p₀ / (a²/2R):  the overlap is 1 % of the depth that Hertz contact flattens
//! ```

use std::collections::BTreeMap;
use std::fmt::Write;

use crate::contact::fem::member_turns;
use crate::mesh::{Cells, FlankChain, Mesh, MeshError, relocate};
use crate::numeric::{Vec2, rotate};
use crate::simulate::gear_set::GearSet;
use crate::simulate::members::Members;
use crate::simulate::one_position::OnePosition;

/// Depth of the flattened strip over the largest overlap that the contact's stiffness allows.
const STIFFNESS: f64 = 100.0;

/// The deck of a solved position; lines of `title` become comments at its head.
///
/// # Errors
/// [`MeshError`] if the flanks' profile deviations turn an element over.
pub fn deck(
    title: &str,
    set: &GearSet,
    members: &Members,
    solved: &OnePosition,
) -> Result<String, MeshError> {
    let mut deck = Deck::default();
    for line in title.lines() {
        deck.line(format_args!("** {line}"));
    }
    let meshes = placed(members, solved)?;
    let nodes: usize = meshes.iter().map(|(mesh, _)| mesh.points.len()).sum();
    let reference = nodes + 1;
    let mut first = (0, 0);
    let mut starts = Vec::new();
    for ((mesh, points), name) in meshes.iter().zip(["PINION", "GEAR"]) {
        deck.body(name, mesh, points, first);
        starts.push(first);
        first = (first.0 + points.len(), first.1 + mesh.cells.len());
    }
    deck.line(format_args!(
        "*NODE, NSET=TURN\n{reference}, 0., 0., 0.\n** its displacement 1 is the turn of the pinion's bore, rad"
    ));
    deck.materials(set);
    deck.contact(set, solved, &meshes, &starts);
    let held: Vec<String> = meshes[1]
        .0
        .bore
        .iter()
        .map(|node| format!("{}, 1, 2", starts[1].0 + *node as usize + 1))
        .chain([format!("{reference}, 2, 3")])
        .collect();
    let held = held.join("\n");
    deck.line(format_args!("*BOUNDARY\n{held}\n*EQUATION"));
    deck.turning_bore(&meshes[0], reference);
    deck.steps(solved, reference, &held);
    Ok(deck.text)
}

/// The meshes of pinion and gear with their flanks' profile deviations, and their points as placed at the position, mm.
fn placed(members: &Members, solved: &OnePosition) -> Result<Vec<(Mesh, Vec<Vec2>)>, MeshError> {
    let pair = &solved.cycle.pair;
    let turns = member_turns(&solved.cycle, solved.position().theta);
    let centres = [Vec2::zeros(), Vec2::new(pair.centre_distance, 0.0)];
    let mut meshes = Vec::new();
    for (side, gear) in [&pair.pinion, &pair.gear].into_iter().enumerate() {
        let nominal = &members.members[side].mesh;
        let lost: Vec<Vec<f64>> = nominal
            .flanks
            .iter()
            .map(|chain| {
                let rho = chain.arc.iter().map(|&s| gear.rho_at_arc(s));
                rho.map(|rho| gear.relief(rho)).collect()
            })
            .collect();
        let untouched = lost.iter().flatten().all(|h| *h == 0.0);
        let mesh = if untouched {
            nominal.clone()
        } else {
            relocate(nominal, gear, &lost)?
        };
        let placed = |x: &Vec2| centres[side] + rotate(*x, turns[side]);
        let points: Vec<Vec2> = mesh.points.iter().map(placed).collect();
        meshes.push((mesh, points));
    }
    Ok(meshes)
}

#[derive(Default)]
struct Deck {
    text: String,
}

impl Deck {
    fn line(&mut self, line: std::fmt::Arguments<'_>) {
        // writing into a text cannot fail
        let _ = writeln!(self.text, "{line}");
    }

    /// The materials of both gears.
    fn materials(&mut self, set: &GearSet) {
        for (material, name) in set.materials.iter().zip(["PINION", "GEAR"]) {
            self.line(format_args!(
                "*MATERIAL, NAME=OF_{name}\n*ELASTIC\n{:.9e}, {:.9e}\n*SOLID SECTION, ELSET={name}, MATERIAL=OF_{name}\n1.",
                material.youngs_modulus, material.poisson_ratio
            ));
        }
    }

    /// The equations by which the bore of the pinion turns with the node `reference`.
    fn turning_bore(&mut self, (pinion, points): &(Mesh, Vec<Vec2>), reference: usize) {
        for &node in &pinion.bore {
            let x = points[node as usize];
            let number = node as usize + 1;
            self.line(format_args!(
                "2\n{number}, 1, 1., {reference}, 1, {:.12e}\n2\n{number}, 2, 1., {reference}, 1, {:.12e}",
                x.y, -x.x
            ));
        }
    }

    /// Both steps; `held`: what is held in the second one.
    fn steps(&mut self, solved: &OnePosition, reference: usize, held: &str) {
        self.line(format_args!(
            "** step 1: the pinion turned to where the flanks meet\n*STEP, INC=100\n*STATIC\n1., 1.\n*BOUNDARY\n{reference}, 1, 1, {:.12e}\n\
             *NODE PRINT, NSET=TURN\nU, RF\n*END STEP",
            solved.contact.approach
        ));
        self.line(format_args!(
            "** step 2: the pinion free to turn under the torque\n*STEP, INC=100\n*STATIC\n1., 1.\n*BOUNDARY, OP=NEW\n{held}\n*CLOAD\n\
             {reference}, 1, {:.12e}\n*NODE PRINT, NSET=TURN\nU\n*CONTACT PRINT\nCSTR\n*NODE FILE\nU\n*EL FILE\nS\n*END STEP",
            solved.torque
        ));
    }

    /// Nodes and elements of one gear, numbered on from `first` (nodes, elements).
    fn body(&mut self, name: &str, mesh: &Mesh, points: &[Vec2], first: (usize, usize)) {
        self.line(format_args!("*NODE, NSET=OF_{name}"));
        for (i, x) in points.iter().enumerate() {
            let number = first.0 + i + 1;
            self.line(format_args!("{number}, {:.12e}, {:.12e}, 0.", x.x, x.y));
        }
        let mut elements = |kind: &str, cells: &mut dyn Iterator<Item = &[u32]>| {
            self.line(format_args!("*ELEMENT, TYPE={kind}, ELSET={name}"));
            for (i, nodes) in cells.enumerate() {
                let numbers = nodes.iter().map(|n| first.0 + *n as usize + 1);
                let listed: Vec<String> = numbers.map(|n| n.to_string()).collect();
                self.line(format_args!("{}, {}", first.1 + i + 1, listed.join(", ")));
            }
        };
        match &mesh.cells {
            Cells::T3(t) => elements("CPE3", &mut t.iter().map(|n| &n[..])),
            Cells::T6(t) => elements("CPE6", &mut t.iter().map(|n| &n[..])),
        }
    }

    /// Surfaces of the flanks that face each other, and their contact.
    fn contact(
        &mut self,
        set: &GearSet,
        solved: &OnePosition,
        meshes: &[(Mesh, Vec<Vec2>)],
        starts: &[(usize, usize)],
    ) {
        let (peak, radius) = solved.peak();
        let modulus = set.modulus();
        // a = p₀ 2R/E*: half width of a Hertz contact with this peak pressure
        let width = 2.0 * peak * radius / modulus;
        let stiffness = STIFFNESS * peak / (0.5 * width * width / radius);
        let edges = [0, 1].map(|side| faces(&meshes[side].0));
        let mut pairs = Vec::new();
        for chain in &meshes[0].0.flanks {
            let mate = meshes[1].0.flanks.iter().find(|f| f.tooth == -chain.tooth);
            let Some(mate) = mate else { continue };
            for (side, flank, name) in [(0, chain, "PINION"), (1, mate, "GEAR")] {
                let order = match meshes[side].0.cells {
                    Cells::T3(_) => 1,
                    Cells::T6(_) => 2,
                };
                self.line(format_args!(
                    "*SURFACE, NAME={name}_{}, TYPE=ELEMENT",
                    pairs.len() + 1
                ));
                for (element, face) in flank_faces(flank, order, &edges[side]) {
                    self.line(format_args!("{}, S{face}", starts[side].1 + element + 1));
                }
            }
            pairs.push(chain.tooth);
        }
        self.line(format_args!(
            "*SURFACE INTERACTION, NAME=FLANKS\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n{stiffness:.6e}"
        ));
        for (i, tooth) in pairs.iter().enumerate() {
            let number = i + 1;
            self.line(format_args!(
                "** tooth pair {tooth}\n*CONTACT PAIR, INTERACTION=FLANKS, TYPE=SURFACE TO SURFACE\nGEAR_{number}, PINION_{number}"
            ));
        }
    }
}

type Faces = BTreeMap<(u32, u32), (usize, usize)>;

/// Element and face number (1: corners 1-2, 2: 2-3, 3: 3-1) of every edge, by its corners in the element's sense.
fn faces(mesh: &Mesh) -> Faces {
    let mut out = BTreeMap::new();
    for element in 0..mesh.cells.len() {
        let corners = mesh.cells.corners(element);
        for face in 0..3 {
            out.insert(
                (corners[face], corners[(face + 1) % 3]),
                (element, face + 1),
            );
        }
    }
    out
}

/// Element faces along a flank.
fn flank_faces<'a>(
    flank: &'a FlankChain,
    order: usize,
    faces: &'a Faces,
) -> impl Iterator<Item = (usize, usize)> + 'a {
    let corners = flank.nodes.iter().step_by(order);
    let next = flank.nodes.iter().skip(order).step_by(order);
    corners.zip(next).filter_map(move |(&a, &b)| {
        let found = faces.get(&(a, b)).or_else(|| faces.get(&(b, a)));
        found.copied()
    })
}
