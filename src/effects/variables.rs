//! The named variables of formulas: those on the cards and those a user writes.

use super::effect::{Hook, OperationState};
use super::local::{Local, ProfileAt};
use crate::gear::Member;

/// One named variable.
#[derive(Debug)]
pub struct Variable {
    /// Name in formulas.
    pub name: &'static str,
    /// Unit, `-` if it has none.
    pub unit: &'static str,
    /// What it is.
    pub meaning: &'static str,
    /// Keys of the study's optional tables from which it follows.
    pub needs: &'static [&'static str],
    before_contact: bool,
    local: Option<fn(&Local) -> f64>,
    profile: Option<fn(&ProfileAt) -> f64>,
    operation: Option<fn(&OperationState) -> f64>,
}

impl Variable {
    /// Whether formulas of `hook` may use it. A load factor is asked before the contact is solved, so it knows no pressure.
    pub fn available(&self, hook: Hook) -> bool {
        match hook {
            Hook::WearFactor | Hook::AddedDepth => self.local.is_some(),
            Hook::LoadFactor | Hook::Friction => self.local.is_some() && self.before_contact,
            Hook::Profile => self.profile.is_some(),
            Hook::Operation => self.operation.is_some(),
            Hook::ToothOffset | Hook::Compliance => false,
        }
    }

    /// Its value at a flank point in a passage; 0 if it is none of those.
    pub fn at(&self, local: &Local) -> f64 {
        self.local.map_or(0.0, |read| read(local))
    }

    /// Its value on a flank as made; 0 if it is none of those.
    pub fn on(&self, profile: &ProfileAt) -> f64 {
        self.profile.map_or(0.0, |read| read(profile))
    }

    /// Its value in a whole run; 0 if it is none of those.
    pub fn of(&self, state: &OperationState) -> f64 {
        self.operation.map_or(0.0, |read| read(state))
    }

    const fn new(name: &'static str, unit: &'static str, meaning: &'static str) -> Self {
        Self {
            name,
            unit,
            meaning,
            needs: &[],
            before_contact: false,
            local: None,
            profile: None,
            operation: None,
        }
    }

    const fn local(mut self, read: fn(&Local) -> f64) -> Self {
        self.local = Some(read);
        self
    }

    const fn early(mut self, read: fn(&Local) -> f64) -> Self {
        self.before_contact = true;
        self.local(read)
    }

    const fn profile(mut self, read: fn(&ProfileAt) -> f64) -> Self {
        self.profile = Some(read);
        self
    }

    const fn operation(mut self, read: fn(&OperationState) -> f64) -> Self {
        self.operation = Some(read);
        self
    }

    const fn needs(mut self, needs: &'static [&'static str]) -> Self {
        self.needs = needs;
        self
    }
}

const OIL: &[&str] = &["lubricant.viscosity", "lubricant.roughness"];
const FILM: &[&str] = &[
    "lubricant.viscosity",
    "lubricant.pressure_viscosity",
    "lubricant.roughness",
];
const HEAT: &[&str] = &[
    "lubricant.friction_coefficient",
    "thermal.conductivity",
    "thermal.specific_heat",
];
const BULK: &[&str] = &["thermal.bulk_temperature"];

/// Every variable there is.
#[rustfmt::skip]
pub static VARIABLES: &[Variable] = &[
    Variable::new("p", "MPa", "contact pressure here and now").local(|at| at.pressure),
    Variable::new("p_max", "MPa", "largest pressure the point sees in the passage, averaged over about 30 µm").local(|at| at.peak_pressure),
    Variable::new("p_hertz", "MPa", "largest pressure of Hertz's ellipse under the load of this tooth pair on the unworn flanks").local(|at| at.hertz_pressure),
    Variable::new("v_slide", "m/s", "sliding speed, without sign").early(Local::sliding_speed),
    Variable::new("v_roll", "m/s", "mean rolling speed (u1 + u2)/2").early(Local::entraining_speed),
    Variable::new("cycles", "-", "pinion revolutions so far").early(|at| at.cycles),
    Variable::new("contacts", "-", "contacts of this member so far").local(|at| at.contacts),
    Variable::new("hours", "h", "hours run so far").early(|at| at.hours),
    Variable::new("contact_hours", "h", "time from one contact of this member to its next").local(|at| at.contact_hours),
    Variable::new("depth", "um", "depth worn at this point so far").local(|at| at.depth),
    Variable::new("slid_distance", "m", "distance that the mate has slid over this point so far, were all contacts like this one").local(Local::slid_distance),
    Variable::new("worn_volume", "mm3", "volume worn off both members since the last oil change").early(|at| at.worn_volume),
    Variable::new("radius", "mm", "radius on this member's flank (the pinion's in a load factor)").early(|at| at.radius).profile(|at| at.radius),
    Variable::new("s", "mm", "signed distance from the pitch point along the path of contact, positive towards the pinion's tip").early(|at| at.path).profile(|at| at.path),
    Variable::new("approach", "-", "1 in approach, 0 in recess").early(|at| f64::from(u8::from(at.approach))),
    Variable::new("pinion", "-", "1 on the pinion, 0 on the gear").local(|at| f64::from(u8::from(at.member == Member::Pinion))).profile(|at| f64::from(u8::from(at.member == Member::Pinion))),
    Variable::new("dedendum", "-", "1 where this flank slides against its rolling, 0 elsewhere").local(|at| f64::from(u8::from(at.dedendum()))),
    Variable::new("line_load", "N/mm", "load of this tooth pair per face width").local(|at| at.line_load),
    Variable::new("normal_load", "N/mm", "normal load of all pairs together per face width").early(|at| at.normal_load),
    Variable::new("half_width", "mm", "half width of the contact").local(|at| at.half_width),
    Variable::new("relative_radius", "mm", "relative radius of curvature").early(Local::relative_radius),
    Variable::new("rho1", "mm", "radius of curvature of the pinion's flank").early(|at| at.curvature[0]),
    Variable::new("base_radius", "mm", "base radius of the pinion").early(|at| at.base_radius),
    Variable::new("base_pitch", "mm", "base pitch").early(|at| at.base_pitch),
    Variable::new("torque", "N m", "torque on the pinion").early(|at| at.torque).operation(|at| at.torque),
    Variable::new("speed", "rpm", "speed of the pinion").early(|at| at.speed).operation(|at| at.speed),
    Variable::new("film_ratio", "-", "minimum film thickness over roughness").local(|at| at.film_ratio).needs(FILM),
    Variable::new("friction", "-", "local coefficient of friction").local(|at| at.friction).needs(OIL),
    Variable::new("flash_temperature", "K", "rise of the contact temperature over the bulk").local(|at| at.flash_temperature).needs(HEAT),
    Variable::new("bulk_temperature", "degC", "bulk temperature").early(|at| at.bulk_temperature).operation(|at| at.bulk_temperature).needs(BULK),
    Variable::new("from_tip", "mm", "distance from this member's tip along the path of contact").profile(|at| at.from_tip),
    Variable::new("along", "-", "place on the path of contact, 0 at its start, 1 at its end").profile(|at| at.along),
    Variable::new("normal_force", "N", "normal force of all pairs together").operation(|at| at.normal_force),
    Variable::new("working_pressure_angle", "rad", "operating pressure angle").operation(|at| at.working_pressure_angle),
    Variable::new("centre_distance", "mm", "centre distance before the change").operation(|at| at.centre_distance),
    Variable::new("power", "kW", "power of the pinion").operation(OperationState::power),
];

/// The variable of this name.
pub fn find(name: &str) -> Option<&'static Variable> {
    VARIABLES.iter().find(|variable| variable.name == name)
}
