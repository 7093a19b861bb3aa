//! What a number of a study file may be: unit, bounds with their reason, and the unit mistakes that are recognised.

use crate::numeric::written;
use std::fmt;

/// A physical number of the study file.
#[derive(Debug, Clone, Copy)]
pub(super) struct Quantity {
    /// Unit as the contract writes it; `-` for a plain number.
    pub(super) unit: &'static str,
    /// Smallest value.
    pub(super) least: Bound,
    /// Largest value.
    pub(super) most: f64,
    /// Why these bounds; a hint in the message.
    pub(super) reason: &'static str,
    /// Values outside the bounds that betray another unit.
    pub(super) slips: &'static [Slip],
}

/// A lower bound.
#[derive(Debug, Clone, Copy)]
pub(super) enum Bound {
    /// The value itself is allowed.
    From(f64),
    /// Only larger values are allowed.
    Above(f64),
}

/// A range of wrong values and what they look like.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slip {
    from: f64,
    to: f64,
    says: &'static str,
}

impl Quantity {
    /// Whether the value is allowed. NaN and infinity never are.
    pub(super) fn allows(&self, value: f64) -> bool {
        let above = match self.least {
            Bound::From(least) => value >= least,
            Bound::Above(least) => value > least,
        };
        value.is_finite() && above && value <= self.most
    }

    /// The unit mistake a refused value betrays, if any.
    pub(super) fn slip(&self, value: f64) -> Option<&'static str> {
        self.slips
            .iter()
            .find(|slip| value >= slip.from && value <= slip.to)
            .map(|slip| slip.says)
    }
}

impl fmt::Display for Quantity {
    /// The allowed range with its unit: `0.05 to 100 mm`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.most == f64::MAX {
            return f.write_str("any finite number");
        }
        let most = Short(self.most);
        match self.least {
            Bound::From(least) => write!(f, "{} to {most}", Short(least))?,
            Bound::Above(least) => write!(f, "above {}, up to {most}", Short(least))?,
        }
        if self.unit == "-" {
            Ok(())
        } else {
            write!(f, " {}", written::unit(self.unit))
        }
    }
}

/// A number as a person writes it: at most four decimals, powers of ten only where they are shorter.
pub(super) struct Short(pub(super) f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let value = self.0;
        if value != 0.0 && (value.abs() >= 1e6 || value.abs() < 1e-3) {
            write!(f, "{value:e}")
        } else {
            // Adding zero turns -0 into 0.
            write!(f, "{}", (value * 1e4).round() / 1e4 + 0.0)
        }
    }
}

/// A range of numbers for a sentence.
pub(super) fn span_of_numbers(from: f64, to: f64, unit: &str) -> String {
    format!("{} to {} {}", Short(from), Short(to), written::unit(unit))
}

const fn quantity(unit: &'static str, least: Bound, most: f64, reason: &'static str) -> Quantity {
    Quantity {
        unit,
        least,
        most,
        reason,
        slips: &[],
    }
}

const fn slip(from: f64, to: f64, says: &'static str) -> Slip {
    Slip { from, to, says }
}

use Bound::{Above, From};

pub(super) const MODULE: Quantity = quantity(
    "mm",
    From(0.05),
    100.0,
    "modules of spur gears lie between watches and mills",
);
pub(super) const PRESSURE_ANGLE: Quantity = Quantity {
    slips: &[slip(
        0.1,
        0.8,
        "this looks like radians; 20 deg = 0.349 rad: write 20",
    )],
    ..quantity(
        "deg",
        From(10.0),
        35.0,
        "outside, involute teeth are undercut or pointed",
    )
};
pub(super) const FACE_WIDTH: Quantity = Quantity {
    slips: &[slip(1e-6, 0.1, "this looks like metres: write millimetres")],
    ..quantity("mm", From(0.1), 5000.0, "the face width carries the load")
};
pub(super) const CENTRE_DISTANCE: Quantity = Quantity {
    slips: &[slip(1e-6, 0.5, "this looks like metres: write millimetres")],
    ..quantity("mm", From(0.5), 1e5, "the distance of the two axes")
};
pub(super) const ADDENDUM: Quantity = quantity(
    "modules",
    Above(0.0),
    2.0,
    "in modules, not mm; ISO 53 profile A has 1",
);
pub(super) const DEDENDUM: Quantity = quantity(
    "modules",
    Above(0.0),
    2.5,
    "in modules, not mm; ISO 53 profile A has 1.25",
);
pub(super) const FILLET_RADIUS: Quantity = quantity(
    "modules",
    From(0.0),
    1.0,
    "in modules, not mm; ISO 53 profile A has 0.38",
);
pub(super) const PROFILE_SHIFT: Quantity =
    quantity("modules", From(-2.0), 2.0, "in modules, not mm");
pub(super) const THICKNESS_REDUCTION: Quantity = quantity(
    "mm",
    From(-50.0),
    50.0,
    "taken off the tooth's thickness at the reference circle; 0.02 to 0.2 is usual",
);
pub(super) const BORE_DIAMETER: Quantity = Quantity {
    slips: &[slip(1e-6, 0.1, "this looks like metres: write millimetres")],
    ..quantity("mm", From(0.1), 1e5, "the bore is where the member is held")
};
pub(super) const RELIEF_AMOUNT: Quantity = quantity(
    "um",
    From(0.0),
    1000.0,
    "material taken off at the tip; 5 to 50 µm is usual",
);
pub(super) const RELIEF_LENGTH: Quantity = quantity(
    "mm",
    From(0.0),
    1000.0,
    "measured along the path of contact, from the tip",
);
pub(super) const LEAD: Quantity = quantity(
    "um",
    From(-1000.0),
    1000.0,
    "material missing across the face; 5 to 30 µm is usual",
);
pub(super) const HELIX_ANGLE: Quantity = quantity(
    "deg",
    From(-45.0),
    45.0,
    "at the reference circle; 8 to 30 is usual",
);
pub(super) const END_RELIEF_LENGTH: Quantity = quantity(
    "mm",
    From(0.0),
    1000.0,
    "from each end of the face inwards, up to half of it",
);
pub(super) const PITCH: Quantity = quantity(
    "um",
    From(-1000.0),
    1000.0,
    "how far a tooth stands back; 3 to 15 µm are classes 5 to 8 of ISO 1328",
);
pub(super) const ECCENTRICITY: Quantity = quantity(
    "um",
    From(0.0),
    1000.0,
    "half of the run-out; 5 to 40 µm is usual",
);
pub(super) const ECCENTRICITY_PHASE: Quantity = quantity(
    "deg",
    From(-360.0),
    360.0,
    "0 where the pairs stand back most as tooth 1 passes the pitch point",
);
pub(super) const TIP_ROUNDING: Quantity = quantity(
    "mm",
    From(0.0),
    50.0,
    "radius at the tip corner; 0 is sharp",
);
pub(super) const YOUNGS_MODULUS: Quantity = Quantity {
    slips: &[
        slip(
            1.0,
            500.0,
            "this looks like GPa; 1 GPa = 1000 MPa: steel is 2.1e5 MPa",
        ),
        slip(
            1e8,
            1e13,
            "this looks like Pa; 1 MPa = 1e6 Pa: steel is 2.1e5 MPa",
        ),
    ],
    ..quantity(
        "MPa",
        From(500.0),
        1.5e6,
        "softer bodies than plastics do not stay in small strains, stiffer than diamond do not exist",
    )
};
pub(super) const POISSON_RATIO: Quantity = quantity(
    "-",
    Above(-1.0),
    0.4999,
    "at 0.5 a material is incompressible and plane strain has no finite stiffness",
);
pub(super) const DENSITY: Quantity = Quantity {
    slips: &[
        slip(
            0.5,
            25.0,
            "this looks like g/cm3; 1 g/cm3 = 1000 kg/m3: steel is 7850",
        ),
        slip(
            1e-7,
            1e-4,
            "this looks like kg/mm3; 1 kg/mm3 = 1e9 kg/m3: steel is 7850",
        ),
        slip(
            1e-10,
            9e-8,
            "this looks like t/mm3; 1 t/mm3 = 1e12 kg/m3: steel is 7850",
        ),
    ],
    ..quantity("kg/m3", From(100.0), 25_000.0, "from foams to osmium")
};
pub(super) const VISCOSITY: Quantity = Quantity {
    slips: &[slip(
        10.0,
        1e6,
        "this looks like mPa s (cP); 1 Pa s = 1000 mPa s: write it with its unit, such as \"15 mPa s\", or 0.015 for that",
    )],
    ..quantity(
        "Pa s",
        From(1e-5),
        10.0,
        "dynamic viscosity at the operating temperature",
    )
};
pub(super) const PRESSURE_VISCOSITY: Quantity = Quantity {
    slips: &[
        slip(
            1e-10,
            1e-6,
            "this looks like 1/Pa; 1/GPa = 1e-9/Pa: write 18 for 1.8e-8 1/Pa",
        ),
        slip(
            1e-3,
            0.0999,
            "this looks like 1/MPa; 1/GPa = 1e-3/MPa: write 18 for 0.018 1/MPa",
        ),
    ],
    ..quantity("1/GPa", From(0.1), 100.0, "oils lie between 5 and 40 1/GPa")
};
pub(super) const ROUGHNESS: Quantity = Quantity {
    slips: &[slip(1e-6, 1e-3, "this looks like mm: write micrometres")],
    ..quantity("um", From(1e-3), 100.0, "composite Rq of both flanks")
};
pub(super) const FRICTION: Quantity = quantity("-", From(0.0), 1.5, "a coefficient of friction");
pub(super) const TEMPERATURE: Quantity = Quantity {
    slips: &[slip(
        300.0,
        700.0,
        "this looks like kelvin; 0 degC = 273.15 K",
    )],
    ..quantity(
        "degC",
        From(-80.0),
        300.0,
        "bulk temperature of running gears",
    )
};
pub(super) const HOUSING: Quantity = quantity(
    "K/W",
    From(0.0),
    1e4,
    "resistance to heat over surface: 0 in the open, 6 for 0.06 K m2/W and 0.01 m2",
);
pub(super) const DUTY: Quantity = quantity("-", Above(0.0), 1.0, "part of the time, 1 is always");
pub(super) const CONDUCTIVITY: Quantity =
    quantity("W/(m K)", From(0.01), 3000.0, "steel has about 46");
pub(super) const SPECIFIC_HEAT: Quantity = Quantity {
    slips: &[slip(
        0.05,
        20.0,
        "this looks like kJ/(kg K); write J/(kg K): steel has about 470",
    )],
    ..quantity("J/(kg K)", From(50.0), 20_000.0, "steel has about 470")
};
pub(super) const TORQUE: Quantity = quantity(
    "N m",
    Above(0.0),
    1e8,
    "on the pinion; its sign is the drive direction: a test states `reversed = true`",
);
pub(super) const SPEED: Quantity = quantity(
    "rpm",
    Above(0.0),
    1e6,
    "of the pinion; a test states `reversed = true` for the other direction",
);
pub(super) const MISALIGNMENT: Quantity = Quantity {
    unit: "mm",
    least: From(-1e4),
    most: 1e4,
    reason: "added to the centre distance; a negative one moves the axes together",
    slips: &[],
};
pub(super) const RIG_HOURS: Quantity =
    quantity("h", Above(0.0), 1e6, "how long a test may take on the rig");
pub(super) const CYCLES: Quantity = quantity(
    "pinion revolutions",
    Above(0.0),
    1e12,
    "one cycle is one turn of the pinion",
);
pub(super) const WEAR_COEFFICIENT: Quantity = Quantity {
    slips: &[slip(
        1e-4,
        1e6,
        "this looks like a value without its power of ten: mild wear of steel is about 6e-10 mm2/N",
    )],
    ..quantity(
        "mm2/N",
        From(0.0),
        1e-4,
        "k = K/H; mild wear lies between 1e-12 and 1e-7 mm2/N, 0 switches wear off",
    )
};
pub(super) const SCATTER: Quantity =
    quantity("-", From(0.0), 10.0, "relative; 0 is none, 0.25 is usual");
pub(super) const DATUM: Quantity = quantity(
    "um",
    From(0.0),
    1000.0,
    "prior standard deviation of a trace's unknown constant",
);
pub(super) const TILT: Quantity = quantity(
    "um",
    From(0.0),
    1000.0,
    "prior standard deviation of a trace's unknown tilt from end to end",
);
pub(super) const SHIFT: Quantity = quantity(
    "mm",
    From(0.0),
    1.0,
    "prior standard deviation of the unknown shift of a trace's radii",
);
pub(super) const NEW_PROFILE: Quantity = quantity(
    "um",
    From(0.0),
    1000.0,
    "standard deviation of the scatter of the new profile that all depths of a flank were taken from",
);
pub(super) const STEP_TOLERANCE: Quantity =
    quantity("-", From(1e-7), 0.1, "relative error of one wear step");
/// A parameter of an effect, before the catalogue is asked: any finite number.
pub(super) const ANY: Quantity = quantity("-", From(f64::MIN), f64::MAX, "a finite number");
