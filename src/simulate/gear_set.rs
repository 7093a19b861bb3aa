//! The gears before they are mounted, and the members that a set of conditions calls for.

use crate::contact::cycle::Cycle;
use crate::contact::strips::Strips;
use crate::gear::{Face, Gear, Pair, PairError, Teeth};
use crate::material::{Elastic, contact_modulus};
use crate::mesh::Mesh;
use crate::simulate::blanks::Blanks;
use crate::simulate::forward::ForwardError;
use crate::simulate::members::{MemberError, Members};
use crate::simulate::numerics::{LEAST_EDGES, Numerics, USUAL_UNKNOWNS};

/// The gears as they are, before they are mounted.
#[derive(Debug, Clone)]
pub struct GearSet {
    /// Pinion and gear.
    pub gears: [Gear; 2],
    /// Elastic constants of both.
    pub materials: [Elastic; 2],
    /// Densities of both, kg/m³.
    pub densities: [f64; 2],
    /// Nominal centre distance, mm.
    pub centre_distance: f64,
    /// Face width, mm.
    pub face_width: f64,
    /// Slices of the face, and what the flanks lack across it.
    pub face: Face,
    /// Where the teeth stand.
    pub teeth: Teeth,
}

/// Most unknowns on the flanks of one member: their compliance is a full matrix, of 0.5 GB then, and making it takes three more.
pub(super) const MOST_UNKNOWNS: usize = 8_000;

impl GearSet {
    /// The pair mounted with a radial misalignment (mm).
    ///
    /// # Errors
    /// [`PairError`] if the gears cannot run so.
    pub fn mount(&self, misalignment: f64) -> Result<Pair, PairError> {
        self.mounted(misalignment, Pair::new)
    }

    /// The pair where an effect has moved its axes to a radial misalignment (mm): of either sign, since gears without a stated
    /// thickness reduction are taken to have the backlash that they need.
    ///
    /// # Errors
    /// [`PairError`] if the gears cannot run so.
    pub fn mount_moved(&self, misalignment: f64) -> Result<Pair, PairError> {
        let stated = |gear: &Gear| gear.spec.thickness_reduction != 0.0;
        if self.gears.iter().any(stated) {
            self.mount(misalignment)
        } else {
            self.mounted(misalignment, Pair::with_any_backlash)
        }
    }

    fn mounted(
        &self,
        misalignment: f64,
        pair: fn(Gear, Gear, f64, f64) -> Result<Pair, PairError>,
    ) -> Result<Pair, PairError> {
        let [pinion, gear] = self.gears.clone();
        pair(pinion, gear, self.centre_distance, misalignment)
    }

    /// Contact modulus E*, MPa.
    pub fn modulus(&self) -> f64 {
        contact_modulus(self.materials[0], self.materials[1])
    }

    /// Elastic members fine enough for every pinion torque (N·mm) and radial misalignment (mm) given.
    ///
    /// # Errors
    /// [`ForwardError`] if a pair cannot run or a member cannot be built.
    pub fn members(
        &self,
        numerics: &Numerics,
        torques: &[f64],
        misalignments: &[f64],
    ) -> Result<Members, ForwardError> {
        self.members_on(numerics, torques, misalignments, [None, None])
    }

    /// As [`GearSet::members`], on the user's `own` meshes where there are any.
    ///
    /// # Errors
    /// [`ForwardError`] if a pair cannot run or a member cannot be built.
    pub fn members_on(
        &self,
        numerics: &Numerics,
        torques: &[f64],
        misalignments: &[f64],
        own: [Option<Mesh>; 2],
    ) -> Result<Members, ForwardError> {
        let fineness = self.fineness(numerics, torques, misalignments)?;
        Ok(Members::build(
            &self.gears,
            self.materials,
            &fineness.teeth,
            fineness.spacing,
            numerics.order,
            own,
            fineness.strips,
        )?)
    }

    /// The meshes of both members alone.
    ///
    /// # Errors
    /// [`ForwardError`] if a pair cannot run or a member cannot be meshed.
    pub fn meshes(
        &self,
        numerics: &Numerics,
        torques: &[f64],
        misalignments: &[f64],
        own: [Option<Mesh>; 2],
    ) -> Result<[Mesh; 2], ForwardError> {
        let fineness = self.fineness(numerics, torques, misalignments)?;
        let blanks = Blanks::new(
            &self.gears,
            self.materials,
            &fineness.teeth,
            fineness.spacing,
            numerics.order,
            own,
            fineness.strips,
        );
        Ok(blanks.map_err(MemberError::from)?.meshes)
    }

    fn fineness(
        &self,
        numerics: &Numerics,
        torques: &[f64],
        misalignments: &[f64],
    ) -> Result<Fineness, ForwardError> {
        let least = torques.iter().fold(f64::INFINITY, |m, t| m.min(*t)) / self.face_width;
        let pairs = misalignments
            .iter()
            .map(|m| self.mount_moved(*m))
            .collect::<Result<Vec<Pair>, PairError>>()?;
        let finest = pairs
            .iter()
            .map(|p| numerics.flank_spacing(p, self.modulus(), least))
            .fold(f64::INFINITY, f64::min);
        let fineness = self.with_edges(numerics, torques, &pairs, finest);
        if numerics.gives_way && fineness.unknowns > USUAL_UNKNOWNS {
            let coarsest = finest * numerics.elements_per_half_width / LEAST_EDGES;
            let fewer = finest * fineness.unknowns as f64 / USUAL_UNKNOWNS as f64;
            let coarser = self.with_edges(numerics, torques, &pairs, fewer.min(coarsest));
            return coarser.checked();
        }
        fineness.checked()
    }

    /// Which teeth have to be fine, with flank edges of a length `spacing`, mm.
    fn with_edges(
        &self,
        numerics: &Numerics,
        torques: &[f64],
        pairs: &[Pair],
        spacing: f64,
    ) -> Fineness {
        let (mut teeth, mut strips) = (Vec::new(), Strips::default());
        for (pair, torque) in pairs
            .iter()
            .flat_map(|pair| torques.iter().map(move |t| (pair, t / self.face_width)))
        {
            let spec = numerics.cycle(pair, self.modulus(), torque, spacing);
            teeth.extend(Cycle::teeth(pair, spec));
            strips = strips.and(&Strips::with_room(pair, spec));
        }
        teeth.sort_unstable();
        teeth.dedup();
        let of_strip = |[low, high]: [f64; 2]| {
            let edges = ((high - low) / spacing).ceil() as usize;
            2 * (numerics.order * edges + 1)
        };
        let of_member =
            |side: usize| -> usize { strips.parts(side).map(|(_, arc)| of_strip(arc)).sum() };
        let unknowns = of_member(0).max(of_member(1));
        Fineness {
            teeth,
            strips,
            spacing,
            unknowns,
        }
    }
}

/// Which of the pinion's teeth are meshed finely and where they touch, how finely (mm), and the unknowns that one member's flanks then have.
struct Fineness {
    teeth: Vec<i32>,
    strips: Strips,
    spacing: f64,
    unknowns: usize,
}

impl Fineness {
    fn checked(self) -> Result<Self, ForwardError> {
        if self.unknowns > MOST_UNKNOWNS {
            return Err(ForwardError::TooFine {
                unknowns: self.unknowns,
                edge_um: 1e3 * self.spacing,
            });
        }
        Ok(self)
    }
}
