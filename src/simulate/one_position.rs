//! Contact of the unworn flanks at one mesh position of one's choice, the flanks' profile deviations included.

use crate::contact::cycle::{Cycle, Position, Stations};
use crate::contact::fem::{CycleCompliance, FemContact};
use crate::contact::frame::Touch;
use crate::contact::model::{ContactModel, PositionContact};
use crate::simulate::forward::{Conditions, ForwardError, GearSet};
use crate::simulate::members::Members;
use crate::simulate::numerics::Numerics;
use crate::simulate::wear_state::line_load;

/// One solved mesh position.
pub struct OnePosition {
    /// A mesh cycle of this position only.
    pub cycle: Cycle,
    /// Its contact.
    pub contact: PositionContact,
    /// Pinion torque per face width, N·mm/mm.
    pub torque: f64,
}

/// One tooth pair of a solved position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairLoad {
    /// Number of the pair, counted from the rotation between 0 and 1 base pitch.
    pub pair: i32,
    /// Path of contact from the pitch point, mm.
    pub path: f64,
    /// Load per face width, N/mm.
    pub line_load: f64,
    /// Largest pressure, MPa.
    pub peak_pressure: f64,
    /// True where a tip corner touches outside the path of contact.
    pub at_corner: bool,
}

impl OnePosition {
    /// Solves the contact at the pinion rotation `rotation` (base pitches from the pitch point, any).
    ///
    /// # Errors
    /// [`ForwardError`] if the gears cannot run so or the contact cannot be solved.
    pub fn solve(
        set: &GearSet,
        members: &Members,
        conditions: &Conditions,
        numerics: &Numerics,
        rotation: f64,
    ) -> Result<Self, ForwardError> {
        let pair = set.mount(conditions.misalignment)?;
        let torque = conditions.torque / set.face_width;
        let spec = numerics.cycle(&pair, set.modulus(), torque, members.spacing());
        let stations = Stations::new(&pair, members.spacing());
        let theta = Cycle::home(&pair, spec, rotation);
        let position = Position::new(&pair, &stations, spec, theta);
        let fresh = [0, 1].map(|side| vec![0.0; stations.arc[side].len()]);
        let cycle = Cycle {
            pair,
            spec,
            stations,
            positions: vec![position],
        };
        let compliance = CycleCompliance::new(&cycle, members.flanks(), 0.0)?;
        let contact =
            FemContact::new(&cycle, &compliance, torque).solve(0, [&fresh[0], &fresh[1]], &[])?;
        Ok(Self {
            cycle,
            contact,
            torque,
        })
    }

    /// The position.
    pub fn position(&self) -> &Position {
        &self.cycle.positions[0]
    }

    /// The tooth pairs that carry load, by ascending path.
    pub fn loads(&self) -> Vec<PairLoad> {
        let position = self.position();
        let of = |pair: &crate::contact::cycle::PairContact| PairLoad {
            pair: position.pair_number(pair),
            path: pair.path,
            line_load: line_load(pair, &self.contact),
            peak_pressure: self.contact.pressure[pair.offset..pair.offset + pair.xi.len()]
                .iter()
                .fold(0.0, |m: f64, p| m.max(*p)),
            at_corner: pair.frame.touch != Touch::Flanks,
        };
        let all = position.pairs.iter().map(of);
        all.filter(|load| load.line_load > 0.0).collect()
    }

    /// The largest pressure on the flanks, tip corners left out, MPa, and the radius of relative curvature there, mm.
    pub fn peak(&self) -> (f64, f64) {
        let flanks = self.loads().into_iter().filter(|load| !load.at_corner);
        let highest = flanks.max_by(|a, b| a.peak_pressure.total_cmp(&b.peak_pressure));
        highest.map_or((0.0, f64::INFINITY), |load| {
            let radius = self.cycle.pair.relative_radius(load.path);
            (load.peak_pressure, radius)
        })
    }
}
