//! One stored wear state: worn flanks, slices of the face, and the mesh cycle with its touching pairs.

use super::Member;

/// One stored wear state.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Pinion revolutions so far.
    pub cycles: f64,
    /// Worn flank of the pinion.
    pub pinion: Profile,
    /// Worn flank of the gear.
    pub gear: Profile,
    /// Mesh positions over one base pitch, ascending.
    pub cycle: Vec<PositionState>,
    /// Slices across the face, ascending; empty where one section stands for all of it. Flanks and mesh cycle are then the mean over the
    /// face, pressures and widths of contact those of the slice where they are largest.
    pub slices: Vec<FaceSlice>,
    /// Classes of teeth, the pinion's first; empty where all teeth of each member are alike. Flanks and mesh cycle are then those of the
    /// mean tooth, pressures and widths of contact the largest of all.
    pub teeth: Vec<ToothClass>,
    /// Rotation of the pinion (base pitches since the first teeth met in the pitch point) and lag of the gear seen at the pinion (µrad) over
    /// one turn of the member with more teeth; empty where all teeth are alike and no member runs out.
    pub turn: Vec<[f64; 2]>,
}

/// Teeth of a member that wear alike, in one state.
#[derive(Debug, Clone, PartialEq)]
pub struct ToothClass {
    /// Whose.
    pub member: Member,
    /// Their numbers, from 1 in the order in which they come into mesh.
    pub teeth: Vec<usize>,
    /// Depth at the radii of the member's profile, µm.
    pub depth: Vec<f64>,
}

impl ToothClass {
    /// Largest depth, µm.
    pub fn deepest(&self) -> f64 {
        self.depth.iter().fold(0.0, |m: f64, h| m.max(*h))
    }
}

/// One slice of the face in one state.
#[derive(Debug, Clone, PartialEq)]
pub struct FaceSlice {
    /// Middle of the slice from mid-face, mm.
    pub face: f64,
    /// Load per width over the mean of the face, the mean over the mesh cycle.
    pub load: f64,
    /// Largest contact pressure on the flanks over the mesh cycle, corners left out, MPa.
    pub peak_pressure: f64,
    /// The same away from kinks of the flanks as made, whose pressure depends on the mesh, MPa.
    pub peak_pressure_elsewhere: f64,
    /// Depth of pinion and gear at the radii of their profiles, µm.
    pub depth: [Vec<f64>; 2],
    /// The largest pressure that these points see in a passage, MPa.
    pub pressure: [Vec<f64>; 2],
}

impl State {
    /// The flank of `member`.
    pub fn profile(&self, member: Member) -> &Profile {
        match member {
            Member::Pinion => &self.pinion,
            Member::Gear => &self.gear,
        }
    }

    /// The largest depth of `member` on any slice of the face, µm, and the middle of that slice, mm from mid-face; None for one section.
    pub fn deepest_on_the_face(&self, member: Member) -> Option<(f64, f64)> {
        let side = usize::from(member == Member::Gear);
        let deepest = |slice: &FaceSlice| slice.depth[side].iter().copied().fold(0.0, f64::max);
        (self.slices.iter().map(|slice| (deepest(slice), slice.face)))
            .max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Load per width of the slice that carries most over the mean of the face (K_Hβ), the mean over the mesh cycle; 1 for one section.
    pub fn face_load_factor(&self) -> f64 {
        (self.slices.iter().map(|slice| slice.load))
            .reduce(f64::max)
            .unwrap_or(1.0)
    }

    /// The largest contact pressure on the flanks over the mesh cycle, MPa, and the path coordinate of the pair that bears it,
    /// mm; pairs that touch with a tip corner are left to [`State::corner_pressure`].
    pub fn peak_pressure(&self) -> Option<(f64, f64)> {
        self.largest_pressure(|pair| !pair.at_corner)
    }

    /// Whether [`State::peak_pressure`] stands over a kink of a flank as made, such as the start of a linear tip relief, and so depends on the mesh.
    pub fn peak_is_over_kink(&self) -> bool {
        let (all, elsewhere) = (self.peak_pressure(), self.pressure_elsewhere());
        all.map(|p| p.0) > elsewhere.map(|p| p.0)
    }

    /// As [`State::peak_pressure`], of the pairs that do not stand over a kink.
    pub fn pressure_elsewhere(&self) -> Option<(f64, f64)> {
        self.largest_pressure(|pair| !pair.at_corner && !pair.over_kink)
    }

    /// As [`State::peak_pressure`], of the pairs that stand over a kink.
    pub fn kink_pressure(&self) -> Option<(f64, f64)> {
        self.largest_pressure(|pair| !pair.at_corner && pair.over_kink)
    }

    /// The largest pressure over the mesh cycle where a tip corner or the end of a flank touches, MPa, and the path coordinate
    /// of that pair, mm; none if none does.
    ///
    /// The pressure under a sharp corner of an elastic body has no bound: by finite elements this is the mean over 0.02 modules, which says how hard a
    /// corner digs in whatever the mesh.
    pub fn corner_pressure(&self) -> Option<(f64, f64)> {
        self.largest_pressure(|pair| pair.at_corner)
    }

    fn largest_pressure(&self, of: impl Fn(&PairState) -> bool) -> Option<(f64, f64)> {
        self.pairs()
            .filter(|pair| pair.line_load > 0.0 && of(pair))
            .map(|pair| (pair.peak_pressure, pair.path))
            .max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Largest minus smallest angle of the mesh cycle, µrad (transmission error, peak to peak, at the pinion).
    pub fn te_peak_to_peak_urad(&self) -> Option<f64> {
        let angles = || self.cycle.iter().map(|p| p.angle_urad);
        let high = angles().max_by(f64::total_cmp)?;
        let low = angles().min_by(f64::total_cmp)?;
        Some(high - low)
    }

    /// Largest minus smallest angle over one turn, µrad, where teeth differ or a member runs out.
    pub fn te_over_a_turn_urad(&self) -> Option<f64> {
        let angles = || self.turn.iter().map(|[_, angle]| *angle);
        let high = angles().max_by(f64::total_cmp)?;
        let low = angles().min_by(f64::total_cmp)?;
        Some(high - low)
    }

    /// The class of the deepest worn tooth of a member, where its teeth differ.
    pub fn worst_tooth(&self, member: Member) -> Option<&ToothClass> {
        let own = || self.teeth.iter().filter(|class| class.member == member);
        let worst = own().max_by(|a, b| a.deepest().total_cmp(&b.deepest()));
        worst.filter(|_| own().count() > 1)
    }

    /// The smallest film ratio over the mesh cycle and the path coordinate of that pair, mm.
    pub fn least_film_ratio(&self) -> Option<(f64, f64)> {
        let ratios = self
            .pairs()
            .filter_map(|p| Some((p.sliding.film_ratio?, p.path)));
        ratios.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The largest rise of the contact temperature over the mesh cycle, K, and the path coordinate of that pair, mm.
    pub fn largest_flash_temperature(&self) -> Option<(f64, f64)> {
        let rises = self
            .pairs()
            .filter_map(|p| Some((p.sliding.flash_temperature?, p.path)));
        rises.max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Mean power that friction between the teeth takes over the mesh cycle, W; none where no friction follows from the study.
    pub fn friction_power(&self) -> Option<f64> {
        let powers = self.pairs().filter_map(|p| p.sliding.power);
        let sum = powers.fold(None, |sum: Option<f64>, power| {
            Some(sum.unwrap_or(0.0) + power)
        })?;
        Some(sum / self.cycle.len() as f64)
    }

    /// All pairs of all positions.
    pub fn pairs(&self) -> impl Iterator<Item = &PairState> {
        self.cycle.iter().flat_map(|position| &position.pairs)
    }
}

/// Height of the tip corner, modules, over which its wear depends on the mesh.
const CORNER: f64 = 0.05;
/// Factor by which a corner is worn deeper than the rest of the flank for both to be given.
const DEEPER: f64 = 1.2;

/// Worn depth along the loaded flank of an average tooth; the three columns have equal length, radius ascending.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Profile {
    /// Radius, mm.
    pub radius: Vec<f64>,
    /// Signed distance along the path of contact from the pitch point, mm.
    pub path: Vec<f64>,
    /// Depth normal to the flank, µm, positive for material lost.
    pub depth: Vec<f64>,
    /// Worn area of one tooth in the transverse plane, mm².
    pub worn_area_mm2: f64,
    /// Mass lost by the loaded flanks of all teeth over the whole face width, mg.
    pub mass_loss_mg: f64,
}

impl Profile {
    /// Index of the deepest point; none for an empty profile.
    pub fn deepest(&self) -> Option<usize> {
        (0..self.depth.len()).max_by(|&i, &j| self.depth[i].total_cmp(&self.depth[j]))
    }

    /// Largest depth, µm (0 for an empty profile).
    pub fn max_depth(&self) -> f64 {
        self.deepest().map_or(0.0, |i| self.depth[i])
    }

    /// Index of the deepest point below the tip corner, of teeth of `module` mm, where the corner itself is worn deeper: a sharp corner wears the
    /// deeper the finer the mesh is there. None for other flanks.
    pub fn deepest_below_corner(&self, module: f64) -> Option<usize> {
        let tip = self.radius.last()?;
        let is_below = |i: &usize| self.radius[*i] < tip - CORNER * module;
        let below = (0..self.depth.len()).filter(is_below);
        let deepest = below.max_by(|&i, &j| self.depth[i].total_cmp(&self.depth[j]))?;
        (self.max_depth() > DEEPER * self.depth[deepest]).then_some(deepest)
    }
}

/// One mesh position of one state.
#[derive(Debug, Clone, PartialEq)]
pub struct PositionState {
    /// Pinion rotation from the pitch point, in base pitches.
    pub position: f64,
    /// Lag of the gear under load seen at the pinion, µrad, positive, worn material included.
    pub angle_urad: f64,
    /// Candidate tooth pairs.
    pub pairs: Vec<PairState>,
}

impl PositionState {
    /// Pairs that carry load.
    pub fn loaded(&self) -> impl Iterator<Item = &PairState> {
        self.pairs.iter().filter(|pair| pair.line_load > 0.0)
    }

    /// Sum of the pairs' line loads, N/mm.
    pub fn line_load(&self) -> f64 {
        self.pairs.iter().map(|pair| pair.line_load).sum()
    }
}

/// One tooth pair at one mesh position.
#[derive(Debug, Clone, PartialEq)]
pub struct PairState {
    /// Number of the pair; 0 meets at the pitch point at position 0.
    pub pair: i32,
    /// Centre of its contact along the path of contact from the pitch point, mm.
    pub path: f64,
    /// Share of the torque this pair carries, 0 to 1.
    pub load_share: f64,
    /// Normal load per face width (integral of the pressure), N/mm.
    pub line_load: f64,
    /// Largest pressure, MPa; by finite elements the largest mean over 0.02 modules where a contact is near the end of a flank.
    pub peak_pressure: f64,
    /// Half the width of the touching zone, mm.
    pub half_width: f64,
    /// True where the pair touches outside the nominal line of action (tip corner of a loaded tooth).
    pub off_line_of_action: bool,
    /// True where the pressure does not fade out on both flanks: it reaches the tip corner (or the form circle) of a flank, or
    /// the pair touches outside the line of action.
    pub at_corner: bool,
    /// True where a kink of a flank as made lies under the pressure, such as the start of a linear tip relief: until wear has rounded it off its largest value depends on
    /// the mesh.
    pub over_kink: bool,
    /// Middle of the slice of the face that the largest pressure is of, mm from mid-face; none where the face has one or nothing is loaded.
    pub face: Option<f64>,
    /// What slides, heats and is lost there.
    pub sliding: Sliding,
}

/// Sliding of one tooth pair and what follows from it; none where the study does not state what it takes, or nothing is loaded.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sliding {
    /// Sliding speed, m/s.
    pub speed: f64,
    /// Smallest film thickness over the composite roughness; none at a tip corner.
    pub film_ratio: Option<f64>,
    /// Rise of the contact temperature over the bulk, K; none at a tip corner.
    pub flash_temperature: Option<f64>,
    /// Coefficient of friction.
    pub friction: Option<f64>,
    /// Power that friction takes over the face width, W.
    pub power: Option<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A steel pinion against plastic, module 2, as computed with 5 and 12 edges on Hertz's half width: 0.25 and 0.36 µm at the corner, 0.042 and
    /// 0.044 µm where path of contact begins.
    #[test]
    fn a_corner_that_wears_by_the_mesh_is_told_from_the_flank() {
        let worn = |depth: [f64; 4]| Profile {
            radius: vec![29.97, 33.0, 33.434, 33.5],
            depth: depth.to_vec(),
            ..Profile::default()
        };
        for (depth, deepest) in [
            ([0.042, 0.017, 0.028, 0.251], Some(0)),
            ([0.044, 0.017, 0.058, 0.360], Some(0)),
            ([0.044, 0.017, 0.02, 0.05], None),
            ([0.044, 0.017, 0.0, 0.0], None),
        ] {
            assert_eq!(worn(depth).deepest_below_corner(2.0), deepest);
        }
        assert_eq!(Profile::default().deepest_below_corner(2.0), None);
    }
}
