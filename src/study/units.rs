//! Numbers with units, as texts: `"20 deg"`, `"2.1 GPa"`, `"100 N m"`. One table of units; no prefix algebra, so that what is
//! allowed can be listed in a message.

use std::fmt;

use super::quantity::Quantity;

/// What a unit measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Length,
    Angle,
    Modules,
    Torque,
    Speed,
    Pressure,
    Density,
    Viscosity,
    PressureViscosity,
    Temperature,
    Conductivity,
    SpecificHeat,
    Wear,
    Revolutions,
}

use Kind::{
    Angle, Conductivity, Density, Length, Modules, Pressure, PressureViscosity, Revolutions,
    SpecificHeat, Speed, Temperature, Torque, Viscosity, Wear,
};

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Length => "a length",
            Angle => "an angle",
            Modules => "a number of modules",
            Torque => "a torque",
            Speed => "a speed of rotation",
            Pressure => "a stress",
            Density => "a density",
            Viscosity => "a dynamic viscosity",
            PressureViscosity => "a pressure coefficient of viscosity",
            Temperature => "a temperature",
            Conductivity => "a conductivity",
            SpecificHeat => "a specific heat",
            Wear => "a wear coefficient",
            Revolutions => "a number of revolutions",
        })
    }
}

/// A unit: one of it is `over / under` of its kind's base, after which `shift` is added.
#[derive(Debug)]
struct Unit {
    name: &'static str,
    kind: Kind,
    over: f64,
    under: f64,
    shift: f64,
}

const fn unit(name: &'static str, kind: Kind, over: f64, under: f64) -> Unit {
    Unit {
        name,
        kind,
        over,
        under,
        shift: 0.0,
    }
}

use std::f64::consts::PI;

/// Every unit; whole numbers over whole numbers, so that powers of ten convert without rounding of their own.
const UNITS: &[Unit] = &[
    unit("nm", Length, 1.0, 1e9),
    unit("um", Length, 1.0, 1e6),
    unit("mm", Length, 1.0, 1e3),
    unit("cm", Length, 1.0, 1e2),
    unit("m", Length, 1.0, 1.0),
    unit("in", Length, 254.0, 1e4),
    unit("deg", Angle, 1.0, 1.0),
    unit("rad", Angle, 180.0, PI),
    unit("mrad", Angle, 0.18, PI),
    unit("arcmin", Angle, 1.0, 60.0),
    unit("modules", Modules, 1.0, 1.0),
    unit("N m", Torque, 1.0, 1.0),
    unit("kN m", Torque, 1e3, 1.0),
    unit("N mm", Torque, 1.0, 1e3),
    unit("rpm", Speed, 1.0, 1.0),
    unit("1/min", Speed, 1.0, 1.0),
    unit("1/s", Speed, 60.0, 1.0),
    unit("rad/s", Speed, 30.0, PI),
    unit("Pa", Pressure, 1.0, 1.0),
    unit("kPa", Pressure, 1e3, 1.0),
    unit("MPa", Pressure, 1e6, 1.0),
    unit("GPa", Pressure, 1e9, 1.0),
    unit("N/mm2", Pressure, 1e6, 1.0),
    unit("kg/m3", Density, 1.0, 1.0),
    unit("g/cm3", Density, 1e3, 1.0),
    unit("kg/dm3", Density, 1e3, 1.0),
    unit("Pa s", Viscosity, 1.0, 1.0),
    unit("mPa s", Viscosity, 1.0, 1e3),
    unit("cP", Viscosity, 1.0, 1e3),
    unit("1/Pa", PressureViscosity, 1.0, 1.0),
    unit("1/MPa", PressureViscosity, 1.0, 1e6),
    unit("1/GPa", PressureViscosity, 1.0, 1e9),
    unit("degC", Temperature, 1.0, 1.0),
    Unit {
        shift: -273.15,
        ..unit("K", Temperature, 1.0, 1.0)
    },
    unit("W/(m K)", Conductivity, 1.0, 1.0),
    unit("J/(kg K)", SpecificHeat, 1.0, 1.0),
    unit("kJ/(kg K)", SpecificHeat, 1e3, 1.0),
    unit("mm2/N", Wear, 1.0, 1.0),
    unit("m2/N", Wear, 1e6, 1.0),
    unit("1/MPa", Wear, 1.0, 1.0),
    unit("1/Pa", Wear, 1e6, 1.0),
    unit("mm3/(N m)", Wear, 1.0, 1e3),
    unit("mm3/(N mm)", Wear, 1.0, 1.0),
    unit("pinion revolutions", Revolutions, 1.0, 1.0),
    unit("revolutions", Revolutions, 1.0, 1.0),
    unit("cycles", Revolutions, 1.0, 1.0),
];

/// Why a text is no value of a quantity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum UnitFault {
    /// It is no number with a unit: no number in front, or nothing behind it.
    NoUnit,
    /// The unit is not known.
    Unknown {
        /// The unit as written.
        written: String,
        /// The nearest that the quantity takes.
        near: String,
    },
    /// The number goes on where a unit should stand: a decimal comma or a mark between thousands.
    Marks {
        /// The mark.
        mark: char,
    },
    /// The unit is known and not taken.
    Foreign {
        /// What is the matter: "is a kinematic viscosity".
        says: &'static str,
        /// What to do.
        hint: &'static str,
    },
    /// The unit measures something else.
    Other {
        /// The unit as written.
        written: String,
        /// What it is, and what is wanted: "mm, a length, where an angle is asked for".
        says: String,
    },
}

/// The value of `text` in the unit of `quantity`.
pub(super) fn value(text: &str, quantity: &Quantity) -> Result<f64, UnitFault> {
    let (number, written) = split(text).ok_or(UnitFault::NoUnit)?;
    let named = spelled(written);
    let mut begin = written.chars();
    if let (Some(mark @ (',' | '.')), Some('0'..='9')) = (begin.next(), begin.next()) {
        return Err(UnitFault::Marks { mark });
    }
    let own = UNITS.iter().find(|unit| unit.name == quantity.unit);
    let fits = |unit: &&Unit| unit.name == named && own.is_some_and(|own| own.kind == unit.kind);
    if let (Some(from), Some(to)) = (UNITS.iter().find(fits), own) {
        return Ok(converted(number, from, to));
    }
    if let Some(fault) = own.and_then(|own| foreign(&named, own.kind)) {
        return Err(fault);
    }
    let written = written.to_owned();
    match UNITS.iter().find(|unit| unit.name == named) {
        Some(other) => Err(UnitFault::Other {
            says: match own {
                Some(own) => format!(
                    "has the unit {written}, {}, where {} is asked for",
                    other.kind, own.kind
                ),
                None => {
                    format!("has the unit {written}, but is a plain number without one")
                }
            },
            written,
        }),
        None => Err(UnitFault::Unknown {
            near: crate::source_text::nearest(&named, known(quantity))
                .unwrap_or_default()
                .to_owned(),
            written,
        }),
    }
}

/// The units that a quantity takes; none for a plain number.
pub(super) fn known(quantity: &Quantity) -> impl Iterator<Item = &'static str> + Clone {
    let own = UNITS.iter().find(|unit| unit.name == quantity.unit);
    let kind = own.map(|own| own.kind);
    UNITS
        .iter()
        .filter(move |unit| Some(unit.kind) == kind)
        .map(|unit| unit.name)
}

/// What is said of a unit that people use and that does not lead to a quantity of this kind by a factor.
fn foreign(named: &str, kind: Kind) -> Option<UnitFault> {
    let (says, hint) = match (kind, named) {
        (Viscosity, "cSt" | "St" | "mm2/s" | "cm2/s" | "m2/s") => (
            "is a kinematic viscosity, where a dynamic one is asked for",
            "dynamic viscosity = kinematic viscosity × density: 20 cSt of an oil of 870 kg/m3 are 17.4 mPa s, \
             both at the operating temperature",
        ),
        (Temperature, "degF" | "F" | "Fahrenheit") => (
            "is in degrees Fahrenheit",
            "write it in °C or K; °C = (°F - 32)/1.8",
        ),
        _ => return None,
    };
    Some(UnitFault::Foreign { says, hint })
}

fn converted(number: f64, from: &Unit, to: &Unit) -> f64 {
    let (over, under) = (from.over * to.under, from.under * to.over);
    let scaled = if over == under {
        number
    } else if over > under {
        number * (over / under)
    } else {
        number / (under / over)
    };
    if from.shift == to.shift {
        scaled
    } else {
        scaled + (from.shift - to.shift)
    }
}

/// The number in front and the unit behind it; `None` if one of them is missing.
fn split(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let mut ends: Vec<usize> = text.char_indices().map(|(i, _)| i).skip(1).collect();
    ends.reverse();
    // the longest number: the e of 1e3 belongs to it
    let (number, end) = ends.into_iter().find_map(|end| {
        let front = text[..end].trim_end();
        let plain = front.ends_with(|c: char| c.is_ascii_digit() || c == '.');
        let number = front.replace('_', "").parse::<f64>().ok()?;
        plain.then_some((number, end))
    })?;
    let unit = text[end..].trim();
    (!unit.is_empty()).then_some((number, unit))
}

/// The unit as the table spells it.
fn spelled(unit: &str) -> String {
    let mut plain = String::new();
    for c in unit.chars() {
        match c {
            'µ' | 'μ' => plain.push('u'),
            '·' | '⋅' | '*' => plain.push(' '),
            '²' => plain.push('2'),
            '³' => plain.push('3'),
            '°' => plain.push_str("deg"),
            '^' => {}
            c => plain.push(c),
        }
    }
    let plain = plain.split_whitespace().collect::<Vec<_>>().join(" ");
    match plain.as_str() {
        "Nm" | "N.m" => "N m",
        "Nmm" | "N.mm" => "N mm",
        "kNm" => "kN m",
        "micron" | "microns" => "um",
        "degree" | "degrees" => "deg",
        "C" | "deg C" => "degC",
        "Pas" | "Pa.s" => "Pa s",
        "mPas" | "mPa.s" => "mPa s",
        "W/m/K" | "W/mK" | "W/(mK)" => "W/(m K)",
        "J/kg/K" | "J/kgK" | "J/(kgK)" => "J/(kg K)",
        "kJ/kg/K" | "kJ/(kgK)" => "kJ/(kg K)",
        "mm3/(Nmm)" | "mm3/Nmm" | "mm3/N mm" | "mm3/N/mm" => "mm3/(N mm)",
        "m3/(N m)" | "m3/(Nm)" | "m3/Nm" | "m3/N m" => "m2/N",
        "mm3/(Nm)" | "mm3/Nm" | "mm3/N m" => "mm3/(N m)",
        "rev/min" | "U/min" | "min-1" => "1/min",
        "Hz" | "rev/s" | "s-1" => "1/s",
        "module" => "modules",
        "rev" | "revolution" => "revolutions",
        "cycle" => "cycles",
        other => return other.to_owned(),
    }
    .to_owned()
}

#[cfg(test)]
mod tests {
    use super::super::quantity as q;
    use super::*;

    #[test]
    fn every_quantity_that_has_a_unit_is_in_the_table() {
        for quantity in [
            q::MODULE,
            q::PRESSURE_ANGLE,
            q::ADDENDUM,
            q::RELIEF_AMOUNT,
            q::YOUNGS_MODULUS,
            q::DENSITY,
            q::VISCOSITY,
            q::PRESSURE_VISCOSITY,
            q::TEMPERATURE,
            q::CONDUCTIVITY,
            q::SPECIFIC_HEAT,
            q::TORQUE,
            q::SPEED,
            q::CYCLES,
            q::WEAR_COEFFICIENT,
        ] {
            let text = format!("3 {}", quantity.unit);
            assert_eq!(value(&text, &quantity), Ok(3.0), "{text}");
        }
        assert_eq!(known(&q::POISSON_RATIO).count(), 0);
    }

    /// Factors by definition: SI prefixes, 180° = π rad, 1 min = 60 s, 0 °C = 273.15 K, 1 in = 25.4 mm, 1 cP = 1 mPa s.
    #[test]
    fn units_convert_by_their_definition() {
        let same: [(&str, Quantity, f64); 23] = [
            ("2 mm", q::MODULE, 2.0),
            ("0.002m", q::MODULE, 2.0),
            ("1 in", q::MODULE, 25.4),
            ("5 µm", q::RELIEF_AMOUNT, 5.0),
            ("0.005 mm", q::RELIEF_AMOUNT, 5.0),
            ("20°", q::PRESSURE_ANGLE, 20.0),
            ("2.1 GPa", q::YOUNGS_MODULUS, 2100.0),
            ("210e3 MPa", q::YOUNGS_MODULUS, 210e3),
            ("210_000 N/mm²", q::YOUNGS_MODULUS, 210e3),
            ("7.85 g/cm3", q::DENSITY, 7850.0),
            ("100 N·m", q::TORQUE, 100.0),
            ("100Nm", q::TORQUE, 100.0),
            ("1e5 N mm", q::TORQUE, 100.0),
            ("50 1/s", q::SPEED, 3000.0),
            ("15 mPa s", q::VISCOSITY, 0.015),
            ("18e-9 1/Pa", q::PRESSURE_VISCOSITY, 18.0),
            ("373.15 K", q::TEMPERATURE, 100.0),
            ("60 °C", q::TEMPERATURE, 60.0),
            ("6e-16 m2/N", q::WEAR_COEFFICIENT, 6e-10),
            ("6e-7 mm3/(N m)", q::WEAR_COEFFICIENT, 6e-10),
            ("6e-10 mm³/(N·mm)", q::WEAR_COEFFICIENT, 6e-10),
            ("6e-10 mm3/Nmm", q::WEAR_COEFFICIENT, 6e-10),
            ("6e-16 m³/(N·m)", q::WEAR_COEFFICIENT, 6e-10),
        ];
        for (text, quantity, expected) in same {
            let found = value(text, &quantity).unwrap();
            assert!(
                (found - expected).abs() <= 4.0 * f64::EPSILON * expected.abs(),
                "{text}: {found}"
            );
        }
        let right = value("1.5707963267948966 rad", &q::PRESSURE_ANGLE).unwrap();
        assert!((right - 90.0).abs() < 1e-12);
        let turning = value("6.283185307179586 rad/s", &q::SPEED).unwrap();
        assert!((turning - 60.0).abs() < 1e-12);
    }

    #[test]
    fn other_kinds_and_unknown_units_are_told_apart() {
        let other = value("2 mm", &q::PRESSURE_ANGLE).unwrap_err();
        assert!(
            matches!(other, UnitFault::Other { says, .. } if says.contains("a length, where an angle"))
        );
        let unknown = value("2 Mpa", &q::YOUNGS_MODULUS).unwrap_err();
        assert!(matches!(unknown, UnitFault::Unknown { near, .. } if near == "MPa"));
        for text in ["2", "mm", "", "two mm", "nan mm", "inf mm", "2e mm mm"] {
            let found = value(text, &q::MODULE);
            assert!(found.is_err(), "{text}: {found:?}");
        }
    }
}
