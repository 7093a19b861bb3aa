//! `[operation]` and `[[test]]`: the conditions of a run.

use std::f64::consts::PI;

use toml::de::DeValue;

use super::gears::{Gears, check_pair};
use super::materials::{Lubricant, Materials, Thermal};
use super::quantity::{self as q, Short};
use super::reader::Table;
use super::temperature::{Temperatures, WarmTeeth};
use crate::gear::Pair;
use crate::material::contact_modulus;
use crate::source_text::{Diagnostic, Fault};

pub(super) const OPERATION_KEYS: &[&str] = &["torque", "speed", "misalignment"];
pub(super) const TEST_KEYS: &[&str] = &[
    "id",
    "role",
    "torque",
    "speed",
    "misalignment",
    "cycles",
    "bulk_temperature",
    "viscosity",
    "reversed",
];

/// Half width of the contact over the relative radius up to which a half plane and small strains describe it. Steel reaches
/// it near 8.7 GPa, three times what gears carry.
const LARGEST_RELATIVE_WIDTH: f64 = 0.15;

/// The conditions of one run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Operation {
    /// Torque on the pinion, N mm.
    pub torque_nmm: f64,
    /// Speed of the pinion, rpm.
    pub speed_rpm: f64,
    /// Radial misalignment, mm: added to the nominal centre distance.
    pub misalignment_mm: f64,
    /// Length of the run, pinion revolutions.
    pub cycles: f64,
    /// Bulk temperature, °C: the test's, else that of `[thermal]`.
    pub bulk_temperature_c: Option<f64>,
    /// Temperature of the flanks at which k is taken, °C: that of friction losses where it is computed, else the bulk temperature.
    pub flank_temperature_c: Option<f64>,
    /// Dynamic viscosity, Pa s: the test's, else that of `[lubricant]`.
    pub viscosity_pa_s: Option<f64>,
    /// Whether the drive direction is the other one.
    pub reversed: bool,
}

impl Operation {
    /// A million revolutions at the nominal centre distance, for tests of the program: torque in N m, speed in rpm.
    #[cfg(test)]
    pub(crate) fn at(torque: f64, speed: f64) -> Self {
        Self {
            torque_nmm: 1e3 * torque,
            speed_rpm: speed,
            misalignment_mm: 0.0,
            cycles: 1e6,
            bulk_temperature_c: None,
            flank_temperature_c: None,
            viscosity_pa_s: None,
            reversed: false,
        }
    }

    /// The bulk temperature as somebody stated it, °C; None where friction losses make it, which leave the flanks warmer.
    pub fn stated_temperature_c(&self) -> Option<f64> {
        self.bulk_temperature_c
            .filter(|_| self.flank_temperature_c == self.bulk_temperature_c)
    }

    /// The same at another stated bulk temperature.
    pub fn at_temperature(&self, celsius: f64) -> Self {
        Self {
            bulk_temperature_c: Some(celsius),
            flank_temperature_c: Some(celsius),
            ..*self
        }
    }
}

/// A measured test.
#[derive(Debug, Clone, PartialEq)]
pub struct Test {
    /// Its name in the measurement file.
    pub id: String,
    /// What it may be used for.
    pub role: Role,
    /// Its conditions, those of `[operation]` where it states none.
    pub conditions: Operation,
}

/// What a test may be used for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// To fit, rank and judge.
    Fit,
    /// To judge only.
    Holdout,
}

type Result<T> = std::result::Result<T, Box<Diagnostic>>;

/// What conditions are checked against.
pub(super) struct Limits<'a> {
    pub(super) root: &'a Table<'a>,
    pub(super) gears: &'a Gears,
    pub(super) materials: &'a Materials,
    pub(super) temperatures: &'a Temperatures,
    pub(super) warm: Option<WarmTeeth>,
}

impl Limits<'_> {
    /// Warms the teeth where their temperature is computed; refuses conditions at which they do not run or are crushed, or whose
    /// temperature no table holds.
    fn settle(&self, table: &Table<'_>, conditions: &mut Operation) -> Result<()> {
        let pair = check_pair(self.root, self.gears, table, conditions.misalignment_mm)?;
        let most = self.largest_torque_nmm(&pair);
        if conditions.torque_nmm <= most {
            conditions.flank_temperature_c = conditions.bulk_temperature_c;
            if let (Some(warm), None) = (self.warm, conditions.bulk_temperature_c) {
                let [flank, root] = warm.of(self.gears, &pair, conditions);
                conditions.flank_temperature_c = Some(flank);
                conditions.bulk_temperature_c = Some(root);
            }
            return self.temperatures.check(table, conditions);
        }
        let has_unit = matches!(table.get("torque"), Some((DeValue::String(_), _)));
        let (says, slip) = if has_unit {
            ("crushes the teeth", "")
        } else {
            (
                "N m crushes the teeth",
                "is it in N mm? 1 N m = 1000 N mm: write 100 for 100000 N mm",
            )
        };
        let mut diagnostic = table
            .refuse("torque", says, format!("above 0, up to {} N m for this pair", Short((most * 1e-3).floor())))
            .with_hint(format!(
                "above, the contact would be wider than {LARGEST_RELATIVE_WIDTH} of its radius of curvature: no small strains"
            ))
            .with_hint(slip)
            .with_hint(format!(
                "or is the face too narrow? face_width in [gears] is {} mm, this torque needs {} mm",
                Short(self.gears.face_width),
                Short((self.gears.face_width * conditions.torque_nmm / most).ceil())
            ));
        diagnostic.fault = Fault::Inconsistent;
        Err(Box::new(diagnostic))
    }

    /// Torque at which one tooth pair at the pitch point reaches [`LARGEST_RELATIVE_WIDTH`].
    ///
    /// ```text
    /// a² = 4 w R/(π E*)   =>   w = (π/4) E* R (a/R)²,   T = w b r_b1      Johnson, Contact Mechanics (1985), Eq. (4.43)
    /// ```
    fn largest_torque_nmm(&self, pair: &Pair) -> f64 {
        let (first, second) = (pair.rho_c, pair.line_length - pair.rho_c);
        let radius = first * second / (first + second);
        let modulus = contact_modulus(self.materials.pinion.elastic, self.materials.gear.elastic);
        let line_load = 0.25 * PI * modulus * radius * LARGEST_RELATIVE_WIDTH.powi(2);
        line_load * self.gears.face_width * pair.pinion.base_radius
    }
}

/// `[operation]`, with `cycles` of `[wear]`.
pub(super) fn read(
    limits: &Limits<'_>,
    cycles: f64,
    lubricant: Option<Lubricant>,
    thermal: Option<Thermal>,
) -> Result<Operation> {
    let table = limits.root.required_table("operation", OPERATION_KEYS)?;
    let mut operation = Operation {
        torque_nmm: table.required_number("torque", &q::TORQUE)? * 1e3,
        speed_rpm: table.required_number("speed", &q::SPEED)?,
        misalignment_mm: table
            .number("misalignment", &q::MISALIGNMENT)?
            .unwrap_or(0.0),
        cycles,
        bulk_temperature_c: thermal.and_then(|thermal| thermal.bulk_temperature_c),
        flank_temperature_c: None,
        viscosity_pa_s: lubricant.and_then(|lubricant| lubricant.viscosity_pa_s),
        reversed: false,
    };
    limits.settle(&table, &mut operation)?;
    Ok(operation)
}

/// `[[test]]` in the order of the file.
pub(super) fn read_tests(limits: &Limits<'_>, operation: Operation) -> Result<Vec<Test>> {
    let mut tests: Vec<Test> = Vec::new();
    for table in limits.root.tables("test", Some(TEST_KEYS))? {
        let what = "the name by which the measurements call the test";
        let Some(id) = table.name("id", what)? else {
            return Err(Box::new(
                table
                    .missing("id", "a text, different in each test")
                    .with_hint(what),
            ));
        };
        if tests.iter().any(|test| test.id == id) {
            return Err(Box::new(table.refuse(
                "id",
                "is taken by a test above",
                "a text, different in each test",
            )));
        }
        let mut conditions = Operation {
            torque_nmm: table
                .number("torque", &q::TORQUE)?
                .map_or(operation.torque_nmm, |torque| torque * 1e3),
            speed_rpm: table
                .number("speed", &q::SPEED)?
                .unwrap_or(operation.speed_rpm),
            misalignment_mm: table
                .number("misalignment", &q::MISALIGNMENT)?
                .unwrap_or(operation.misalignment_mm),
            cycles: table
                .number("cycles", &q::CYCLES)?
                .unwrap_or(operation.cycles),
            bulk_temperature_c: table
                .number("bulk_temperature", &q::TEMPERATURE)?
                .or(operation
                    .bulk_temperature_c
                    .filter(|_| limits.warm.is_none())),
            flank_temperature_c: None,
            viscosity_pa_s: table
                .number("viscosity", &q::VISCOSITY)?
                .or(operation.viscosity_pa_s),
            reversed: table.flag("reversed")?.unwrap_or(false),
        };
        limits.settle(&table, &mut conditions)?;
        let role = table
            .choice("role", &[("fit", Role::Fit), ("holdout", Role::Holdout)])?
            .unwrap_or(Role::Fit);
        tests.push(Test {
            id: id.to_owned(),
            role,
            conditions,
        });
    }
    Ok(tests)
}
