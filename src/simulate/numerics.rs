//! How finely a simulation is resolved; the defaults are the ones whose error is shown in the validation.

use crate::analytic::hertz_line;
use crate::contact::cycle::CycleSpec;
use crate::gear::Pair;

/// Resolution of a simulation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Numerics {
    /// 2 for quadratic triangles, 1 for linear.
    pub order: usize,
    /// Flank element edges per Hertz half width at the pitch point under the smallest torque.
    pub elements_per_half_width: f64,
    /// Whether that number gives way where it asks for more than [`USUAL_UNKNOWNS`]: nobody has stated it.
    pub gives_way: bool,
    /// Mesh positions per base pitch.
    pub positions: usize,
    /// Error allowed in a wear step, relative to the largest depth.
    pub step_tolerance: f64,
    /// Depth below which that error is absolute, modules.
    pub step_floor: f64,
    /// Coulomb friction (full slip) in the contact.
    pub friction: f64,
    /// Wear since the last condensation after which the members are condensed again, modules.
    pub condense_after: f64,
    /// Factor on the strip in which contact is looked for from the start; it grows by itself when wear calls for it, which
    /// changes the contact's unknowns.
    pub room: f64,
}

/// Wear since the last condensation after which the members are condensed again, modules.
///
/// With module 2 (14 µm, 14.4 with the step that passes it), condensing again changes load shares by 3.4e-4 and peak pressures by 0.2 % within 4.2 mm of the pitch point and
/// by 0.44 % next to worn tips; condensing every 4 µm would change the depth after the same cycles by 0.011 % inside the
/// flank (the validation's case `recondensation`). The bound is 0.5 % of the pressure.
pub const CONDENSE_AFTER: f64 = 0.007;

/// Edges per half width below which peak pressures are more than some per cent off.
pub const FEW_EDGES: f64 = 3.0;

/// Depth below which the error of a wear step is absolute, modules.
pub const STEP_FLOOR: f64 = 5e-5;

/// Unknowns on the flanks of one member up to which a half width gets the edges it should: beyond, the wear steps' full matrices
/// would take most of a run's time.
pub const USUAL_UNKNOWNS: usize = 3_000;

/// Edges per half width that a contact gets all the same. With one, peak pressures of new flanks say little; depths do not
/// suffer, because wear soon makes contacts wider.
pub const LEAST_EDGES: f64 = 1.0;

impl Default for Numerics {
    fn default() -> Self {
        Self {
            order: 2,
            elements_per_half_width: 5.0,
            gives_way: false,
            positions: 100,
            step_tolerance: 2e-3,
            step_floor: STEP_FLOOR,
            friction: 0.0,
            condense_after: CONDENSE_AFTER,
            room: 1.0,
        }
    }
}

/// Half width of the searched strip, in Hertz half widths of the largest load: room for contacts that wear has flattened.
const WINDOW: f64 = 2.2;

/// The same of the analytic model, whose contacts keep Hertz's width: room for four times the load, by factors on it.
const ANALYTIC_WINDOW: f64 = 2.0;

/// How far the contact grid stays even, in half widths of the strip that is searched from the start. Two widenings fit in.
const EVEN: f64 = 2.0;

/// Room for corners that wear brings into contact beyond those the load does, modules.
const WORN_REACH: f64 = 0.004;

/// Stiffness of a tooth pair over 2 E* that the reach allows for; solid steel gears show 0.05 to 0.06.
const LEAST_STIFFNESS: f64 = 0.045;

impl Numerics {
    /// Length of a flank element's edge for the least pinion torque per width (N·mm/mm) it has to resolve, mm.
    pub fn flank_spacing(&self, pair: &Pair, modulus: f64, least_torque: f64) -> f64 {
        Self::half_width(pair, modulus, least_torque) / self.elements_per_half_width
    }

    /// Hertz's half width at the pitch point for a pinion torque per width (N·mm/mm), mm.
    pub fn half_width(pair: &Pair, modulus: f64, torque: f64) -> f64 {
        half_width_at(pair, 0.0, modulus, torque)
    }

    /// Resolution of the mesh cycle up to the pinion torque per width `torque` (N·mm/mm) with flank edges `spacing` (mm).
    pub fn cycle(&self, pair: &Pair, modulus: f64, torque: f64, spacing: f64) -> CycleSpec {
        let widest = widest(pair, modulus, torque);
        let window = self.room * (WINDOW * widest).max(12.0 * spacing);
        CycleSpec {
            positions: self.positions,
            spacing,
            even: EVEN * window,
            window,
            reach: torque / pair.pinion.base_radius / (LEAST_STIFFNESS * 2.0 * modulus)
                + WORN_REACH * pair.pinion.rack.module,
        }
    }

    /// The same for the analytic model: a node without pressure on either side of its contacts is all it needs.
    pub fn analytic_cycle(
        &self,
        pair: &Pair,
        modulus: f64,
        torque: f64,
        spacing: f64,
    ) -> CycleSpec {
        let window = ANALYTIC_WINDOW * widest(pair, modulus, torque) + spacing;
        CycleSpec {
            even: EVEN * window,
            window,
            ..self.cycle(pair, modulus, torque, spacing)
        }
    }
}

/// Largest Hertz half width on the path of contact where one tooth pair carries all, mm.
fn widest(pair: &Pair, modulus: f64, torque: f64) -> f64 {
    let (start, end) = (pair.rho_a - pair.rho_c, pair.rho_e - pair.rho_c);
    let at = |i: i32| start + (end - start) * f64::from(i) / 20.0;
    (0..=20)
        .map(|i| half_width_at(pair, at(i), modulus, torque))
        .fold(0.0, f64::max)
}

fn half_width_at(pair: &Pair, path: f64, modulus: f64, torque: f64) -> f64 {
    hertz_line::half_width(
        torque / pair.pinion.base_radius,
        pair.relative_radius(path),
        modulus,
    )
}
