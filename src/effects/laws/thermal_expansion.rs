//! Housing and gears expand unequally: the centre distance changes with temperature.
//!
//! ```text
//! Δa = a ε ((1 − w)(T_bulk − T_ref) + κ P)        ε 1/K housing minus gears, P kW transmitted, κ K/kW
//! ```
//! w = 0: the centre distance is stated for the temperature T_ref. w = 1: for the stated bulk temperature.
//! Either sign; the growth of the flanks themselves cancels to first order. A study without [thermal] has T_bulk = 20 °C.

use crate::effects::{Card, Effect, Form, Hook, OperationChange, OperationState, Param, Prior};

pub(super) const CARD: Card = Card {
    name: "thermal_expansion",
    hook: Hook::Operation,
    formula: "added_centre_distance = centre_distance*expansion*((1 - warm)*(bulk_temperature - reference_temperature) + heating*power)",
    source: "linear expansion: aluminium 23e-6 against steel 11.5e-6 1/K, so an aluminium housing 40 K warm opens 80 mm by 37 µm. Heating in proportion to the power is the simplest balance of loss and cooling; 1 to 3 % of the power lost and 1 to 20 W/K given off by a small housing (engineering judgement) make 0.5 to 30 K/kW.",
    signature: "a radial misalignment that changes with power or oil temperature; of either sign",
    confounded_with: &["radial_misalignment", "bearing_compliance"],
    separated_by: "hot and cold at the same torque; three times the speed",
    left_out: "unequal warmth within the gears and the growth of the flanks: the centre distance alone changes",
    needs: &[],
    params: &[
        Param::new(
            "expansion",
            "1/K",
            "expansion of the housing minus that of the gears",
            1.15e-5,
            (-1e-4, 1e-4),
            Prior::Normal {
                mean: 0.0,
                sd: 1.5e-5,
            },
        )
        .neutral(0.0),
        Param::new(
            "heating",
            "K/kW",
            "warming per power transmitted, besides the stated bulk temperature",
            1.0,
            (0.0, 100.0),
            Prior::LogNormal {
                median: 3.0,
                spread: 3.0,
            },
        ),
        Param::new(
            "reference_temperature",
            "degC",
            "temperature at which the centre distance is the stated one",
            20.0,
            (-50.0, 200.0),
            Prior::Normal {
                mean: 20.0,
                sd: 3.0,
            },
        )
        .fixed(),
        Param::either(
            "warm",
            "0 if the centre distance is stated for the reference temperature, 1 if for the stated bulk temperature",
        ),
    ],
    forms: &[Form {
        name: "with the power alone",
        settings: &[("warm", 1.0)],
        ..Form::PLAIN
    }],
    build: |p| {
        Box::new(ThermalExpansion {
            expansion: p[0],
            heating: p[1],
            reference_temperature: p[2],
            warm: p[3],
        })
    },
};

struct ThermalExpansion {
    expansion: f64,
    heating: f64,
    reference_temperature: f64,
    warm: f64,
}

impl Effect for ThermalExpansion {
    fn operation(&self, state: &OperationState) -> OperationChange {
        let stated = state.bulk_temperature - self.reference_temperature;
        let rise = (1.0 - self.warm) * stated + self.heating * state.power();
        // adding zero turns −0 into 0
        OperationChange {
            centre_distance: state.centre_distance * self.expansion * rise + 0.0,
        }
    }
}
