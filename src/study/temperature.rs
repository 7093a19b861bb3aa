//! What the teeth's temperature changes: Young's moduli and k by tables, and that temperature itself where a test does not state it.

use std::f64::consts::PI;

use super::gears::Gears;
use super::materials::{Lubricant, MATERIAL_TABLE_KEYS, Materials, Thermal};
use super::operation::Operation;
use super::quantity as q;
use super::reader::Table;
use super::settings::WEAR_TABLE_KEYS;
use crate::gear::{Member, Pair};
use crate::material::Elastic;
use crate::numeric::interpolate;
use crate::source_text::{Diagnostic, Fault};
use crate::tribology::tooth_temperature::{HeatPartner, ToothHeat, loss_factor};

/// Young's modulus below which a gear counts as plastic, MPa.
const PLASTIC: f64 = 2e4;

/// Largest factor on k.
const LARGEST_FACTOR: f64 = 1e4;

/// A figure by temperature.
#[derive(Debug, Clone, PartialEq)]
struct ByTemperature {
    /// Ascending, °C.
    temperatures: Vec<f64>,
    values: Vec<f64>,
    /// The key of the values in the study.
    key: String,
}

/// What depends on the teeth's temperature.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Temperatures {
    /// Young's moduli of pinion and gear, MPa.
    moduli: [Option<ByTemperature>; 2],
    /// Natural logarithm of k over the study's coefficient.
    wear: Option<ByTemperature>,
}

type Result<T> = std::result::Result<T, Box<Diagnostic>>;

impl Temperatures {
    /// Elastic constants of both members as the study states them, with the moduli at the temperature of `conditions`.
    pub(super) fn elastic(&self, stated: [Elastic; 2], conditions: &Operation) -> [Elastic; 2] {
        let at = conditions.bulk_temperature_c;
        let of = |elastic: Elastic, curve: &Option<ByTemperature>| match (curve, at) {
            (Some(curve), Some(at)) => Elastic {
                youngs_modulus: curve.at(at),
                ..elastic
            },
            _ => elastic,
        };
        [
            of(stated[0], &self.moduli[0]),
            of(stated[1], &self.moduli[1]),
        ]
    }

    /// k at the temperature of `conditions` over the study's coefficient.
    pub(super) fn wear_factor(&self, conditions: &Operation) -> f64 {
        match (&self.wear, conditions.flank_temperature_c) {
            (Some(curve), Some(at)) => curve.at(at).exp(),
            _ => 1.0,
        }
    }

    /// Whether the tables say something of a bulk temperature.
    pub(super) fn hold(&self, celsius: f64) -> bool {
        let mut curves = self.moduli.iter().flatten().chain(&self.wear);
        curves.all(|curve| {
            let last = curve.temperatures.len() - 1;
            (curve.temperatures[0]..=curve.temperatures[last]).contains(&celsius)
        })
    }

    /// Refuses conditions without a temperature that the tables hold.
    pub(super) fn check(&self, table: &Table<'_>, conditions: &Operation) -> Result<()> {
        let moduli = self.moduli.iter().flatten();
        let asked = moduli
            .map(|curve| (curve, conditions.bulk_temperature_c))
            .chain(
                self.wear
                    .iter()
                    .map(|c| (c, conditions.flank_temperature_c)),
            );
        for (curve, at) in asked {
            let (least, most) = (
                curve.temperatures[0],
                curve.temperatures[curve.temperatures.len() - 1],
            );
            let allowed = format!("{least} to {most} degC, where {} holds", curve.key);
            match at {
                Some(at) if (least..=most).contains(&at) => {}
                Some(at) => {
                    let mut refusal = table.refuse("bulk_temperature", "", allowed);
                    refusal.message = format!(
                        "the teeth have {at:.1} degC, for which {} says nothing",
                        curve.key
                    );
                    refusal.found = format!("{at:.1} degC");
                    refusal.fault = Fault::Inconsistent;
                    return Err(Box::new(refusal.with_hint(
                        "a table is not continued beyond its ends: add a temperature to it",
                    )));
                }
                None => {
                    return Err(Box::new(table.missing("bulk_temperature", &allowed).with_hint(
                        "stated in [thermal] it holds for the operation and all tests that state none",
                    )));
                }
            }
        }
        Ok(())
    }
}

impl ByTemperature {
    fn at(&self, temperature: f64) -> f64 {
        interpolate(&self.temperatures, &self.values, temperature)
    }

    /// `temperatures` of a table with its values under `key`, of which `allows` says what they may be.
    fn read(
        table: &Table<'_>,
        key: &str,
        allowed: &str,
        allows: impl Fn(f64) -> bool,
    ) -> Result<Option<Self>> {
        let pair = (table.numbers("temperatures")?, table.numbers(key)?);
        let (temperatures, values) = match pair {
            (Some(temperatures), Some(values)) => (temperatures, values),
            (None, None) => return Ok(None),
            (Some(_), None) => {
                return Err(Box::new(table.missing(
                    key,
                    &format!("one number for each of the temperatures: {allowed}"),
                )));
            }
            (None, Some(_)) => {
                return Err(Box::new(table.missing(
                    "temperatures",
                    "degC, ascending, one for each of the numbers",
                )));
            }
        };
        let faulty =
            |key: &str, says: &str, allowed: &str| Err(Box::new(table.refuse(key, says, allowed)));
        if temperatures.len() < 2
            || temperatures.windows(2).any(|pair| pair[1] <= pair[0])
            || !temperatures.iter().all(|t| q::TEMPERATURE.allows(*t))
        {
            return faulty(
                "temperatures",
                "is no table",
                &format!("at least 2 temperatures, ascending, {}", q::TEMPERATURE),
            );
        }
        if values.len() != temperatures.len() {
            let says = format!(
                "has {} numbers for {} temperatures",
                values.len(),
                temperatures.len()
            );
            return faulty(key, &says, "one number for each temperature");
        }
        if !values.iter().all(|value| allows(*value)) {
            return faulty(key, "holds a number that is not possible", allowed);
        }
        Ok(Some(Self {
            temperatures,
            values,
            key: table.path_of(key),
        }))
    }
}

/// The tables of `[material]` and `[wear]`.
pub(super) fn read(root: &Table<'_>) -> Result<Temperatures> {
    let table = root.required_table("material", MATERIAL_TABLE_KEYS)?;
    let modulus = |table: &Table<'_>| {
        let allowed = q::YOUNGS_MODULUS.to_string();
        ByTemperature::read(table, "moduli", &allowed, |value| {
            q::YOUNGS_MODULUS.allows(value)
        })
    };
    let moduli = if table.has("pinion") || table.has("gear") {
        [
            modulus(&table.required_table("pinion", super::materials::MATERIAL_KEYS)?)?,
            modulus(&table.required_table("gear", super::materials::MATERIAL_KEYS)?)?,
        ]
    } else {
        let both = modulus(&table)?;
        [both.clone(), both]
    };
    let wear = root.required_table("wear", WEAR_TABLE_KEYS)?;
    let allowed = format!("above 0, up to {LARGEST_FACTOR}");
    let factors = ByTemperature::read(&wear, "factors", &allowed, |value| {
        value > 0.0 && value <= LARGEST_FACTOR
    })?;
    let logarithms = |mut curve: ByTemperature| {
        curve
            .values
            .iter_mut()
            .for_each(|value| *value = value.ln());
        curve
    };
    Ok(Temperatures {
        moduli,
        wear: factors.map(logarithms),
    })
}

/// Teeth whose temperature follows from their friction losses (VDI 2736 part 2).
#[derive(Debug, Clone, Copy)]
pub(super) struct WarmTeeth {
    friction: f64,
    thermal: Thermal,
    partner: HeatPartner,
    /// Whether each member is plastic.
    plastic: [bool; 2],
}

impl WarmTeeth {
    /// What `[thermal] tooth_temperature` asks for, if it stands there.
    pub(super) fn read(
        root: &Table<'_>,
        materials: &Materials,
        lubricant: Option<Lubricant>,
        thermal: Option<Thermal>,
    ) -> Result<Option<Self>> {
        let Some(thermal) = thermal.filter(|thermal| thermal.warm) else {
            return Ok(None);
        };
        let Some(table) = root.table("thermal", super::materials::THERMAL_KEYS)? else {
            return Ok(None);
        };
        let Some(friction) = lubricant.and_then(|l| l.friction_coefficient) else {
            return Err(Box::new(
                root.missing("lubricant.friction_coefficient", &q::FRICTION.to_string())
                    .with_hint(
                        "tooth_temperature = \"vdi2736\" takes the heat from the friction losses",
                    ),
            ));
        };
        if thermal.bulk_temperature_c.is_some() {
            let mut refusal = table.refuse(
                "bulk_temperature",
                "stands beside tooth_temperature",
                "one of the two",
            );
            refusal.fault = Fault::Inconsistent;
            return Err(Box::new(refusal.with_hint(
                "a [[test]] may state its own measured bulk_temperature",
            )));
        }
        let plastic =
            Member::BOTH.map(|member| materials.of(member).elastic.youngs_modulus < PLASTIC);
        let partner = match plastic {
            [true, true] => HeatPartner::Plastic,
            [false, false] => {
                let mut refusal = table.refuse(
                    "tooth_temperature",
                    "is for plastic teeth",
                    "a member whose Young's modulus is below 20000 MPa",
                );
                refusal.fault = Fault::Inconsistent;
                return Err(Box::new(refusal));
            }
            _ => HeatPartner::Steel,
        };
        Ok(Some(Self {
            friction,
            thermal,
            partner,
            plastic,
        }))
    }

    /// Temperatures of the flank and of the root under some conditions, °C: of the plastic member, the hotter one if both are.
    pub(super) fn of(&self, gears: &Gears, pair: &Pair, conditions: &Operation) -> [f64; 2] {
        let turns = conditions.speed_rpm / 60.0;
        let [a, .., e] = pair.path_points();
        let base_pitch = pair.pinion.rack.base_pitch();
        let teeth = [&pair.pinion, &pair.gear].map(|gear| gear.spec.teeth);
        let factor = loss_factor(teeth, [e / base_pitch, -a / base_pitch]) / pair.cos_base_helix();
        let pitch_radius = pair.pinion.base_radius.hypot(pair.rho_c);
        let power = 1e-3 * conditions.torque_nmm * 2.0 * PI * turns;
        let hottest = |coefficient: f64| {
            let of = |(teeth, plastic): (&u32, &bool)| {
                plastic.then(|| {
                    let heat = ToothHeat {
                        loss: power * self.friction * factor,
                        face_width: gears.face_width,
                        teeth: *teeth,
                        velocity: 1e-3 * pitch_radius * 2.0 * PI * turns,
                        module: pair.pinion.rack.normal(pair.pinion.helix_angle).module,
                        housing: self.thermal.housing_k_w,
                        duty: self.thermal.duty,
                    };
                    heat.rise(coefficient)
                })
            };
            let rises = teeth.iter().zip(&self.plastic).filter_map(of);
            self.thermal.ambient_c + rises.fold(0.0, f64::max)
        };
        self.partner.coefficients().map(hottest)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Study;
    use crate::source_text::Fault;

    const PLASTIC: &str = include_str!("../cli/examples/plastic-steel.toml");

    fn with(changes: &[(&str, &str)]) -> Result<Study, crate::source_text::TextError> {
        let mut text = PLASTIC.to_owned();
        for (old, new) in changes {
            assert!(text.contains(old), "{old}");
            text = text.replacen(old, new, 1);
        }
        Study::parse(&text, "study.toml")
    }

    const MODULI: (&str, &str) = (
        "youngs_modulus = 2800.0",
        "temperatures = [20, 60, 100]\nmoduli = [2800, 1800, 800]\nyoungs_modulus = 2800.0",
    );
    const FACTORS: (&str, &str) = (
        "coefficient = 2e-9 ",
        "temperatures = [20, 60]\nfactors = [1, 4]\ncoefficient = 2e-9 ",
    );
    const WARM: (&str, &str) = (
        "bulk_temperature = 40.0 ",
        "tooth_temperature = \"vdi2736\"\nambient_temperature = 23.0 ",
    );

    #[test]
    fn moduli_and_k_are_those_of_the_temperature() {
        let hot = ("id = \"B\"", "id = \"B\"\nbulk_temperature = 60.0");
        let study = with(&[MODULI, FACTORS, hot]).unwrap();
        // [thermal] has 40 °C: half way, the middle of the logarithms
        let [a, b] = [0, 1].map(|i| study.tests[i].conditions);
        assert_eq!(
            study.elastic_at(&a).map(|e| e.youngs_modulus),
            [2.1e5, 2300.0]
        );
        assert_eq!(
            study.elastic_at(&b).map(|e| e.youngs_modulus),
            [2.1e5, 1800.0]
        );
        assert!((study.wear_at(&a).members[1] - 2.0).abs() < 1e-12);
        assert!((study.wear_at(&b).members[0] - 4.0).abs() < 1e-12);
        assert_eq!(study.gear_set().materials, study.elastic_at(&a));
        let plain = with(&[]).unwrap();
        assert_eq!(plain.wear_at(&plain.operation), plain.wear);
    }

    #[test]
    fn tables_end_where_they_end() {
        let hot = ("id = \"B\"", "id = \"B\"\nbulk_temperature = 61.0");
        let cold = ("bulk_temperature = 40.0", "conductivity = 0.3 #");
        let again = ("conductivity = 0.31 ", "specific_heat = 1400 #");
        let last = ("specific_heat = 1470.0", "#");
        let short = ("moduli = [2800, 1800, 800]", "moduli = [2800, 1800]");
        let wild = ("[20, 60, 100]", "[20, 100, 60]");
        for (changes, fault, says) in [
            (
                &[FACTORS, hot][..],
                Fault::Inconsistent,
                "61.0 degC, for which wear.factors says nothing",
            ),
            (
                &[FACTORS, cold, again, last],
                Fault::MissingKey,
                "20 to 60 degC",
            ),
            (
                &[MODULI, short],
                Fault::BadValue,
                "2 numbers for 3 temperatures",
            ),
            (&[MODULI, wild], Fault::BadValue, "ascending"),
        ] {
            let error = with(changes).unwrap_err();
            assert!(error.to_string().contains(says), "{error}");
            assert_eq!(error.diagnostic().fault, fault, "{error}");
        }
    }

    /// The gears of GEARpie's report "MAO": 30 and 30 teeth, module 2, 15 mm, POM on POM, 10 N m at 1000 rpm, friction 0.28, 23 °C: flank 243.5 °C,
    /// root 75.6 °C. Tolerance 0.2 % of the rise: its losses are integrated.
    #[test]
    fn a_study_warms_its_teeth_as_the_guideline_does() {
        let study = with(&[
            ("module = 1.0 ", "module = 2.0 "),
            ("teeth = 20", "teeth = 30"),
            ("teeth = 40", "teeth = 30"),
            ("centre_distance = 30.0", "centre_distance = 60.0"),
            ("face_width = 8.0", "face_width = 15.0"),
            ("youngs_modulus = 2.1e5", "youngs_modulus = 3000"),
            ("friction_coefficient = 0.2", "friction_coefficient = 0.28"),
            ("torque = 0.5", "torque = 10.0"),
            WARM,
        ])
        .unwrap();
        let flank = study.operation.flank_temperature_c.unwrap();
        let root = study.operation.bulk_temperature_c.unwrap();
        assert!(((flank - 23.0) / 220.5 - 1.0).abs() < 2e-3, "{flank}");
        assert!(((root - 23.0) / 52.6 - 1.0).abs() < 2e-3, "{root}");
        // a test has its own, from its own torque, and a measured one goes before
        let measured = ("id = \"B\"", "id = \"B\"\nbulk_temperature = 60.0");
        let study = with(&[WARM, measured]).unwrap();
        let [a, b] = [0, 1].map(|i| study.tests[i].conditions);
        assert!(a.flank_temperature_c > a.bulk_temperature_c);
        assert_eq!(
            [b.flank_temperature_c, b.bulk_temperature_c],
            [Some(60.0); 2]
        );
    }

    #[test]
    fn teeth_are_warmed_only_where_it_makes_sense() {
        let beside = (
            "bulk_temperature = 40.0 ",
            "bulk_temperature = 40.0\ntooth_temperature = \"vdi2736\" ",
        );
        let smooth = ("friction_coefficient = 0.2", "roughness = 0.2");
        let steel = ("youngs_modulus = 2800.0", "youngs_modulus = 2.1e5");
        for (changes, says) in [
            (&[beside][..], "stands beside tooth_temperature"),
            (&[WARM, smooth], "friction_coefficient"),
            (&[WARM, steel], "is for plastic teeth"),
        ] {
            let error = with(changes).unwrap_err().to_string();
            assert!(error.contains(says), "{error}");
        }
    }
}
