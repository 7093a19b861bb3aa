//! What physical effects change about the contact itself: plain numbers on the grid of a mesh cycle.

use crate::contact::cycle::{Cycle, PairContact, Position};
use crate::tribology::friction::force_arm;

/// Changes of the contact over a mesh cycle; the default changes nothing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Alteration {
    /// Material missing before the start at the stations of pinion and gear, mm.
    pub profile: Option<[Vec<f64>; 2]>,
    /// Factor on the load of each tooth pair, by position and pair: its lever in the torque balance is divided by it.
    pub load_factor: Option<Vec<Vec<f64>>>,
    /// Coefficient of friction that each tooth pair has besides the study's, by position and pair; negative where the pair slides the
    /// other way than the pinion's drive has it.
    pub friction: Option<Vec<Vec<f64>>>,
    /// Deflection added to each tooth pair per line load, mm per N/mm.
    pub flexibility: f64,
    /// How far the teeth of pinion and gear stand back along the path of contact, mm by tooth in the order in which they come into mesh.
    pub tooth_back: Option<[Vec<f64>; 2]>,
    /// Material missing in each slice of the face, mm along the path of contact.
    pub lead: Option<Vec<f64>>,
}

impl Alteration {
    /// Whether nothing is changed.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Whether levers and compliance stay as they are.
    pub fn keeps_stiffness(&self) -> bool {
        self.load_factor.is_none() && self.friction.is_none() && self.flexibility == 0.0
    }

    /// Load factor of pair number `index` of position `q`.
    pub fn factor(&self, q: usize, index: usize) -> f64 {
        self.load_factor
            .as_ref()
            .map_or(1.0, |factors| factors[q][index])
    }

    /// Coefficient of friction that pair number `index` of position `q` has besides the study's; a derivative likewise.
    pub fn friction(&self, q: usize, index: usize) -> f64 {
        self.friction.as_ref().map_or(0.0, |all| all[q][index])
    }

    /// The same where friction moves nothing but the lever of each pair's load, as the analytic contact has it.
    ///
    /// ```text
    /// f → f r_b1/(r_b1 ± µ ρ1)        the lever is kept above a twentieth of the base radius
    /// ```
    pub fn with_friction_in_levers(mut self, cycle: &Cycle) -> Self {
        let Some(friction) = self.friction.take() else {
            return self;
        };
        let base_radius = cycle.pair.pinion.base_radius;
        let factors = cycle.positions.iter().enumerate().map(|(q, position)| {
            let pairs = position.pairs.iter().enumerate();
            let factor = |(index, pair): (usize, &PairContact)| {
                let rho = pair.frame.rho[0];
                let arm = force_arm(base_radius, pair.path, rho, friction[q][index]);
                self.factor(q, index) * base_radius / arm.max(base_radius / 20.0)
            };
            pairs.map(factor).collect()
        });
        self.load_factor = Some(factors.collect());
        self
    }

    /// Weighted gaps that the profile opens, position by position.
    pub fn gaps(&self, cycle: &Cycle) -> Option<Vec<Vec<f64>>> {
        let [pinion, gear] = self.profile.as_ref()?;
        let opened = |position: &Position| {
            let mut gap = vec![0.0; position.gap.len()];
            position.open([pinion, gear], &mut gap);
            gap
        };
        Some(cycle.positions.iter().map(opened).collect())
    }
}

/// `gap` with pair `pair` set back by `offset` (mm).
pub(super) fn set_back(gap: &mut [f64], pair: &PairContact, offset: f64) {
    for (k, length) in pair.length.iter().enumerate() {
        gap[pair.offset + k] += offset * length;
    }
}
