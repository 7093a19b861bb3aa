//! Physical effects in a run: the state that they see at each place of the mesh cycle, and what they change.

use std::f64::consts::TAU;

use crate::analytic::hertz_line;
use crate::contact::alteration::Alteration;
use crate::contact::cycle::{Cycle, PairContact, Position};
use crate::contact::deposit::tributary;
use crate::contact::model::PositionContact;
use crate::contact::slices::Slices;
use crate::effects::{
    Combined, Effect, FaceAt, Hook, Local, OperationState, ProfileAt, REFERENCE_TEMPERATURE,
    Surroundings, Tooth,
};
use crate::gear::{Member, Pair};

/// Effects under the conditions of one run.
pub struct Acting {
    /// The effects.
    pub effects: Combined,
    /// Oil and heat.
    pub surroundings: Surroundings,
    /// Pinion torque, N·m.
    pub torque: f64,
    /// Pinion speed, rpm.
    pub speed: f64,
    /// Whether the drive direction is the other one: what was approach is recess.
    pub reversed: bool,
    /// Face width, mm.
    pub face_width: f64,
}

/// What the wear of a run has come to: the part of an effect's surroundings that grows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Age {
    /// Pinion revolutions.
    pub cycles: f64,
    /// Volume worn off both members, mm³.
    pub worn_volume: f64,
}

/// Least relative radius that a Hertz pressure is taken for, modules: a sharp corner has none.
const LEAST_RADIUS: f64 = 5e-4;

/// Load of one tooth pair as effects see it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PairLoad {
    /// N/mm.
    pub line_load: f64,
    /// mm.
    pub half_width: f64,
    /// MPa.
    pub peak_pressure: f64,
}

impl PairLoad {
    /// Load, largest pressure and the half width of the ellipse with both: a = 2 w/(π p0).
    pub fn of(pair: &PairContact, contact: &PositionContact) -> Self {
        let own = &contact.pressure[pair.offset..pair.offset + pair.xi.len()];
        let line_load = own.iter().zip(&pair.length).map(|(p, l)| p * l).sum();
        let peak_pressure = own.iter().fold(0.0, |m: f64, p| m.max(*p));
        let half_width = if peak_pressure > 0.0 {
            2.0 * line_load / (std::f64::consts::PI * peak_pressure)
        } else {
            0.0
        };
        Self {
            line_load,
            half_width,
            peak_pressure,
        }
    }
}

/// Rolling speeds of pinion and gear flank at a tooth pair, m/s, the pinion at `speed` rpm.
pub fn rolling(gears: &Pair, pair: &PairContact, speed: f64) -> [f64; 2] {
    let omega = speed * TAU / 60.0;
    // along the path at r_b1 ω1; the mean of both rolling speeds and their difference, the sliding
    let sliding = 1e-3 * pair.slip * gears.pinion.base_radius * omega;
    let mean = 0.5e-3 * omega * (pair.frame.rho[0] + pair.frame.rho[1] / gears.speed_ratio);
    [mean + 0.5 * sliding, mean - 0.5 * sliding]
}

impl Acting {
    /// Whether any effect acts through `hook`.
    pub fn acts(&self, hook: Hook) -> bool {
        self.effects.acts(hook)
    }

    /// Normal force of all pairs together, N.
    fn normal_force(&self, pair: &Pair) -> f64 {
        1e3 * self.torque / pair.pinion.base_radius
    }

    /// Whether the effects leave something missing across the face of `pair`.
    pub fn acts_across_the_face(&self, pair: &Pair) -> bool {
        let force = self.normal_force(pair);
        self.effects.has_lead(self.face_width, force)
    }

    /// Whether what they leave missing there is no straight wedge.
    pub fn bends_across_the_face(&self, pair: &Pair) -> bool {
        let force = self.normal_force(pair);
        self.effects.has_bent_lead(self.face_width, force)
    }

    /// What the effects add to the centre distance of `pair`, mm.
    pub fn added_centre_distance(&self, pair: &Pair) -> f64 {
        let state = OperationState {
            torque: self.torque,
            speed: self.speed,
            normal_force: self.normal_force(pair),
            working_pressure_angle: pair.working_pressure_angle,
            centre_distance: pair.centre_distance,
            bulk_temperature: self
                .surroundings
                .bulk_temperature_c
                .unwrap_or(REFERENCE_TEMPERATURE),
        };
        self.effects.operation(&state).centre_distance
    }

    /// What the effects change about the contact over `cycle`; `slices`: those of the face, if it has more than one.
    pub fn alteration(&self, cycle: &Cycle, slices: Option<&Slices>) -> Alteration {
        let across = slices.filter(|_| self.acts_across_the_face(&cycle.pair));
        let acts = |hook| self.acts(hook).then_some(());
        Alteration {
            profile: acts(Hook::Profile).map(|()| Member::BOTH.map(|m| self.profile(cycle, m))),
            load_factor: acts(Hook::LoadFactor)
                .map(|()| self.load_factors(cycle, across.is_some())),
            friction: acts(Hook::Friction).map(|()| self.friction(cycle)),
            // µm per N/mm
            flexibility: 1e-3 * self.effects.compliance(),
            tooth_back: acts(Hook::ToothOffset).map(|()| {
                Member::BOTH.map(|m| {
                    let teeth = teeth(&cycle.pair, m);
                    teeth.map(|t| 1e-3 * self.effects.tooth_offset(t)).collect()
                })
            }),
            lead: across.map(|slices| {
                let lead = |y: &f64| {
                    let at = FaceAt {
                        place: 2.0 * y / self.face_width,
                        width: self.face_width,
                        normal_force: self.normal_force(&cycle.pair),
                    };
                    1e-3 * self.effects.lead(&at).unwrap_or(0.0)
                };
                slices.place.iter().map(lead).collect()
            }),
        }
    }

    /// What tells the teeth of pinion and gear apart to the effects, by tooth.
    pub fn tooth_kinds(&self, pair: &Pair) -> [Vec<Vec<f64>>; 2] {
        Member::BOTH.map(|m| teeth(pair, m).map(|t| self.effects.tooth_kind(t)).collect())
    }

    /// Material missing before the start at the stations of one flank, mm.
    fn profile(&self, cycle: &Cycle, member: Member) -> Vec<f64> {
        let pair = &cycle.pair;
        let gear = pair.member(member);
        let [start, .., end] = pair.path_points();
        let tip = match member {
            Member::Pinion => end,
            Member::Gear => start,
        };
        let at = |arc: &f64| {
            let rho = gear.rho_at_arc(*arc);
            let path = pair.path_at_rho(member, rho);
            1e-3 * self.effects.profile(&ProfileAt {
                member,
                radius: gear.radius_at_rho(rho),
                path,
                from_tip: (tip - path).abs(),
                along: (path - start) / (end - start),
            })
        };
        cycle.stations.arc[side(member)].iter().map(at).collect()
    }

    fn load_factors(&self, cycle: &Cycle, across: bool) -> Vec<Vec<f64>> {
        self.before_contact(cycle, |local| {
            if across {
                self.effects.load_factor_of_sections(local)
            } else {
                self.effects.load_factor(local)
            }
        })
    }

    /// With the drive reversed all sliding is. Of helical teeth the force on an inclined flank is 1/cos β_b times that in the transverse
    /// section, and friction takes its share of that.
    fn friction(&self, cycle: &Cycle) -> Vec<Vec<f64>> {
        let sense = if self.reversed { -1.0 } else { 1.0 } / cycle.pair.cos_base_helix();
        self.before_contact(cycle, |local| sense * self.effects.friction(local))
    }

    /// `value` of every tooth pair, by position: what is known of it before the contact is solved.
    fn before_contact(&self, cycle: &Cycle, value: impl Fn(&Local) -> f64) -> Vec<Vec<f64>> {
        let fresh = Age {
            cycles: 0.0,
            worn_volume: 0.0,
        };
        let of_pair =
            |pair: &PairContact| value(&self.at_pair(cycle, pair, PairLoad::default(), fresh));
        let of_position =
            |position: &Position| position.pairs.iter().map(of_pair).collect::<Vec<_>>();
        cycle.positions.iter().map(of_position).collect()
    }

    /// What holds for all of a tooth pair's contact; the place on a flank is then set by [`Acting::at_point`].
    pub fn at_pair(&self, cycle: &Cycle, pair: &PairContact, load: PairLoad, age: Age) -> Local {
        let gears = &cycle.pair;
        let hours = if self.speed > 0.0 {
            1.0 / (60.0 * self.speed)
        } else {
            0.0
        };
        let mut local = Local {
            member: Member::Pinion,
            radius: 0.0,
            path: pair.path,
            approach: (pair.path < 0.0) != self.reversed,
            // of the section normal to the contact line
            curvature: (pair.frame.rho).map(|rho| rho / gears.cos_base_helix()),
            rolling: rolling(gears, pair, self.speed),
            pressure: 0.0,
            peak_pressure: load.peak_pressure,
            hertz_pressure: 0.0,
            line_load: load.line_load,
            half_width: load.half_width,
            normal_load: 1e3 * self.torque / (gears.pinion.base_radius * self.face_width),
            depth: 0.0,
            cycles: age.cycles,
            contacts: age.cycles,
            hours: age.cycles * hours,
            contact_hours: hours,
            worn_volume: age.worn_volume,
            torque: self.torque,
            speed: self.speed,
            base_radius: gears.pinion.base_radius,
            base_pitch: gears.base_pitch,
            film_ratio: 0.0,
            friction: 0.0,
            flash_temperature: 0.0,
            bulk_temperature: REFERENCE_TEMPERATURE,
        };
        local.hertz_pressure = hertz_line::peak_pressure(
            load.line_load,
            local
                .relative_radius()
                .max(LEAST_RADIUS * gears.pinion.rack.module),
            self.surroundings.contact_modulus,
        );
        if self.effects.feels_surroundings() {
            self.surroundings.complete(&mut local);
        }
        local
    }

    /// `local` moved to the point at arc `arc` (mm) of `member`, worn by `depth` (mm in the transverse section), under `pressure` (MPa).
    pub fn at_point(
        &self,
        local: &mut Local,
        cycle: &Cycle,
        member: Member,
        arc: f64,
        depth: f64,
        pressure: f64,
    ) {
        let gear = cycle.pair.member(member);
        let per_contact = match member {
            Member::Pinion => 1.0,
            Member::Gear => cycle.pair.speed_ratio,
        };
        local.member = member;
        local.radius = gear.radius_at_arc(arc);
        local.depth = 1e3 * depth * cycle.pair.cos_base_helix();
        local.pressure = pressure;
        local.contacts = local.cycles / per_contact;
        local.contact_hours = if self.speed > 0.0 {
            per_contact / (60.0 * self.speed)
        } else {
            0.0
        };
    }

    /// Volume worn off all teeth of both members at the depths `u` (mm at the stations of pinion and gear), mm³.
    pub fn worn_volume(&self, cycle: &Cycle, u: [&[f64]; 2]) -> f64 {
        let of = |member: Member| self.worn_off(cycle, member, u[side(member)]);
        Member::BOTH.into_iter().map(of).sum()
    }

    /// Volume worn off all teeth of a member at the depths `u` (mm at its stations), mm³.
    pub fn worn_off(&self, cycle: &Cycle, member: Member, u: &[f64]) -> f64 {
        let stations = &cycle.stations.arc[side(member)];
        let depths = u.iter().enumerate();
        let area: f64 = depths.map(|(i, h)| h * tributary(stations, i)).sum();
        let teeth = cycle.pair.member(member).spec.teeth;
        area * self.face_width * f64::from(teeth)
    }
}

/// The teeth of a member in the order in which they come into mesh.
fn teeth(pair: &Pair, member: Member) -> impl Iterator<Item = Tooth> {
    let of = pair.member(member).spec.teeth as usize;
    (0..of).map(move |number| Tooth { member, number, of })
}

/// 0 for the pinion, 1 for the gear.
pub fn side(member: Member) -> usize {
    usize::from(member == Member::Gear)
}
