//! `[rig]`: what the test rig can do, so that only tests are suggested that can be made on it.

use super::operation::Operation;
use super::quantity::{self as q, Quantity, Short};
use super::reader::Table;
use crate::source_text::{Diagnostic, Fault};

pub(super) const KEYS: &[&str] = &[
    "torque_min",
    "torque_max",
    "speed_min",
    "speed_max",
    "misalignment_max",
    "temperature_min",
    "temperature_max",
    "hours_max",
    "reversible",
];

/// The limits of a test rig; without `[rig]` there are none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rig {
    /// Torque on the pinion, N mm.
    pub torque_nmm: [f64; 2],
    /// Speed of the pinion, rpm.
    pub speed_rpm: [f64; 2],
    /// Largest radial misalignment, mm.
    pub misalignment_mm: f64,
    /// Bulk temperature of the teeth, °C.
    pub temperature_c: [f64; 2],
    /// Longest test, h.
    pub hours: f64,
    /// Whether it drives the other flanks too.
    pub reversible: bool,
}

impl Default for Rig {
    fn default() -> Self {
        let any = [f64::NEG_INFINITY, f64::INFINITY];
        Self {
            torque_nmm: any,
            speed_rpm: any,
            misalignment_mm: f64::INFINITY,
            temperature_c: any,
            hours: f64::INFINITY,
            reversible: true,
        }
    }
}

impl Rig {
    /// The conditions nearest to these that the rig can run: its drive direction is left as it is, a test that takes too long becomes shorter.
    pub fn nearest(&self, wanted: &Operation) -> Operation {
        let within = |value: f64, [least, most]: [f64; 2]| value.clamp(least, most);
        let mut own = *wanted;
        if let Some(celsius) = wanted.stated_temperature_c() {
            own = own.at_temperature(within(celsius, self.temperature_c));
        }
        own.torque_nmm = within(own.torque_nmm, self.torque_nmm);
        own.speed_rpm = within(own.speed_rpm, self.speed_rpm);
        own.misalignment_mm = own.misalignment_mm.min(self.misalignment_mm);
        own.cycles = own.cycles.min(60.0 * own.speed_rpm * self.hours);
        own
    }
}

type Result<T> = std::result::Result<T, Box<Diagnostic>>;

pub(super) fn read(root: &Table<'_>) -> Result<Rig> {
    let mut rig = Rig::default();
    let Some(table) = root.table("rig", KEYS)? else {
        return Ok(rig);
    };
    let torque = range(&table, ["torque_min", "torque_max"], &q::TORQUE)?;
    rig.torque_nmm = torque.map(|newton_metres| 1e3 * newton_metres);
    rig.speed_rpm = range(&table, ["speed_min", "speed_max"], &q::SPEED)?;
    rig.temperature_c = range(
        &table,
        ["temperature_min", "temperature_max"],
        &q::TEMPERATURE,
    )?;
    let misalignment = table.number("misalignment_max", &q::MISALIGNMENT)?;
    rig.misalignment_mm = misalignment.unwrap_or(rig.misalignment_mm);
    rig.hours = table
        .number("hours_max", &q::RIG_HOURS)?
        .unwrap_or(rig.hours);
    rig.reversible = table.flag("reversible")?.unwrap_or(rig.reversible);
    Ok(rig)
}

/// From the first key's value to the second's, unbounded where one is not stated.
fn range(table: &Table<'_>, keys: [&'static str; 2], quantity: &Quantity) -> Result<[f64; 2]> {
    let [least, most] = keys.map(|key| table.number(key, quantity));
    let [least, most] = [
        least?.unwrap_or(f64::NEG_INFINITY),
        most?.unwrap_or(f64::INFINITY),
    ];
    if least > most {
        let says = format!("lies below {}", keys[0]);
        let mut refusal = table.refuse(keys[1], &says, format!("{} and more", Short(least)));
        refusal.fault = Fault::Inconsistent;
        return Err(Box::new(refusal));
    }
    Ok([least, most])
}
