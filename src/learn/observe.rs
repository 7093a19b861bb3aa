//! What an instrument reads off the model: each quantity of the measurement file, in its unit.

use crate::contact::model::PositionContact;
use crate::effects::Local;
use crate::gear::Member;
use crate::learn::trajectory::Node;
use crate::measure::{Observation, Place, Quantity, Subject};
use crate::numeric::interpolate;
use crate::simulate::forward::{Forward, ForwardError, GearSet};
use crate::simulate::history::worn_area;
use crate::wear::acting::{Acting, Age, PairLoad, side};
use crate::wear::passage::{Moment, Passage};

/// A worn state that can be read. Contacts are solved only when a quantity asks for them.
pub(super) struct Reading<'r, 'f> {
    forward: &'r mut Forward<'f>,
    worn: &'r Node,
    set: &'r GearSet,
    meshing: Option<Meshing>,
}

/// What follows from the contacts of a worn state.
struct Meshing {
    contacts: Vec<PositionContact>,
    /// Order of a passage, and the largest pressures on both flanks.
    passage: Passage,
    moments: [Vec<Moment>; 2],
    /// Rotation (base pitches, ascending from 0 to 1) and approach (rad), closed around.
    turns: (Vec<f64>, Vec<f64>),
    /// Mean approach over the base pitch, rad.
    mean: f64,
}

impl Meshing {
    /// Of a run worn by `u` (mm at the stations of pinion and gear).
    fn new(forward: &mut Forward<'_>, u: &[f64]) -> Result<Self, ForwardError> {
        let contacts = forward.contacts_at(u)?;
        let cycle = forward.cycle();
        let passage = Passage::new(cycle);
        let moments = [0, 1].map(|side| passage.moments(cycle, &contacts, side));
        let mut turns: Vec<(f64, f64)> = (cycle.positions.iter().zip(&contacts))
            .map(|(position, contact)| (position.phase(), contact.approach))
            .collect();
        turns.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mean = turns.iter().map(|t| t.1).sum::<f64>() / turns.len() as f64;
        let (first, last) = (turns[0], turns[turns.len() - 1]);
        turns.insert(0, (last.0 - 1.0, last.1));
        turns.push((first.0 + 1.0, first.1));
        Ok(Self {
            contacts,
            passage,
            moments,
            turns: turns.into_iter().unzip(),
            mean,
        })
    }
}

impl<'r, 'f> Reading<'r, 'f> {
    /// Reads a worn state.
    pub(super) fn new(forward: &'r mut Forward<'f>, worn: &'r Node, set: &'r GearSet) -> Self {
        Self {
            forward,
            worn,
            set,
            meshing: None,
        }
    }

    /// The value that `observation` should have, in the unit of its quantity.
    ///
    /// # Errors
    /// [`ForwardError`] if a contact cannot be solved.
    pub(super) fn of(&mut self, observation: &Observation) -> Result<f64, ForwardError> {
        let at = observation.position.unwrap_or(0.0);
        let pinion_for_pair = observation.member.member().unwrap_or(Member::Pinion);
        match observation.quantity {
            Quantity::WearDepth => Ok(self.depth(pinion_for_pair, at)),
            Quantity::MassLoss => Ok(match observation.member {
                Subject::Pair => Member::BOTH.into_iter().map(|m| self.mass(m)).sum(),
                _ => self.mass(pinion_for_pair),
            }),
            Quantity::TransmissionError => self.transmission_error(at),
            Quantity::LoadShare => self.load_share(pinion_for_pair, at),
            Quantity::ContactPressure => self.pressure(pinion_for_pair, at),
            Quantity::MeshStiffness => self.stiffness(at),
        }
    }

    /// What an observed flank point feels: the contact at the moment at which it presses the point most, and the depth worn by
    /// then. None for what stands nowhere on a flank.
    ///
    /// # Errors
    /// [`ForwardError`] if a contact cannot be solved.
    pub(super) fn local(
        &mut self,
        acting: &Acting,
        observation: &Observation,
    ) -> Result<Option<Local>, ForwardError> {
        let on_flank = observation.quantity.place() == Place::Flank;
        let (Some(member), Some(radius)) = (
            observation.member.member(),
            observation.position.filter(|_| on_flank),
        ) else {
            return Ok(None);
        };
        let (arc, stations) = (self.arc(member, radius), self.stations(member));
        let after = stations.partition_point(|s| *s < arc);
        let after = after.clamp(1, stations.len() - 1);
        let nearer = usize::from(stations[after] - arc < arc - stations[after - 1]);
        let depth = 1e-3 * self.depth(member, radius);
        let pressure = self.pressure(member, radius)?;
        let (meshing, forward) = self.meshing()?;
        let cycle = forward.cycle();
        let moment = &meshing.moments[side(member)][after - 1 + nearer];
        let pair = meshing.passage.pair(cycle, moment.pair);
        let (position, _) = meshing.passage.order[moment.pair];
        let load = PairLoad::of(pair, &meshing.contacts[position]);
        let age = Age {
            cycles: observation.cycles,
            worn_volume: 0.0,
        };
        let mut local = acting.at_pair(cycle, pair, load, age);
        acting.at_point(&mut local, cycle, member, arc, depth, pressure);
        let rho = cycle.pair.member(member).rho_at_arc(arc);
        local.path = cycle.pair.path_at_rho(member, rho);
        Ok(Some(local))
    }

    fn depths(&self, member: Member) -> &[f64] {
        let arcs = &self.forward.cycle().stations.arc;
        let (pinion, gear) = self.worn.u.split_at(arcs[0].len());
        match member {
            Member::Pinion => pinion,
            Member::Gear => gear,
        }
    }

    fn stations(&self, member: Member) -> &[f64] {
        &self.forward.cycle().stations.arc[side(member)]
    }

    /// Arc of the point at `radius` (mm) on the flank of `member`, mm.
    fn arc(&self, member: Member, radius: f64) -> f64 {
        let gear = self.forward.cycle().pair.member(member);
        gear.arc(
            (radius * radius - gear.base_radius * gear.base_radius)
                .max(0.0)
                .sqrt(),
        )
    }

    /// µm.
    fn depth(&self, member: Member, radius: f64) -> f64 {
        let arc = self.arc(member, radius);
        1e3 * interpolate(self.stations(member), self.depths(member), arc)
    }

    /// mg of the whole member.
    fn mass(&self, member: Member) -> f64 {
        let side = side(member);
        let lost =
            worn_area(self.stations(member), self.depths(member)) - self.worn.displaced[side];
        let teeth = self.forward.cycle().pair.member(member).spec.teeth;
        // mm³ · kg/m³ = µg
        1e-3 * lost * self.set.face_width * f64::from(teeth) * self.set.densities[side]
    }

    /// What follows from the contacts, and the run as it was prepared for them.
    fn meshing(&mut self) -> Result<(&Meshing, &Forward<'f>), ForwardError> {
        let meshing = match self.meshing.take() {
            Some(known) => known,
            None => Meshing::new(self.forward, &self.worn.u)?,
        };
        Ok((self.meshing.insert(meshing), self.forward))
    }

    /// Rotation of the pinion that closes the flanks at the rotation `phase` (base pitches), rad; and its mean.
    fn approach(&mut self, phase: f64) -> Result<(f64, f64), ForwardError> {
        let (meshing, _) = self.meshing()?;
        let (turn, approach) = &meshing.turns;
        Ok((
            interpolate(turn, approach, phase.rem_euclid(1.0)),
            meshing.mean,
        ))
    }

    /// µrad at the gear, a lagging gear negative, mean removed.
    fn transmission_error(&mut self, phase: f64) -> Result<f64, ForwardError> {
        let (approach, mean) = self.approach(phase)?;
        Ok(-1e6 * (approach - mean) / self.forward.cycle().pair.speed_ratio)
    }

    /// N/(mm µm): load per width over approach along the line of action.
    fn stiffness(&mut self, phase: f64) -> Result<f64, ForwardError> {
        let (approach, _) = self.approach(phase)?;
        let base = self.forward.cycle().pair.pinion.base_radius;
        Ok(self.forward.torque() / base / (1e3 * approach * base))
    }

    /// MPa, the largest the point sees in a passage.
    fn pressure(&mut self, member: Member, radius: f64) -> Result<f64, ForwardError> {
        let arc = self.arc(member, radius);
        let moments = &self.meshing()?.0.moments[side(member)];
        let largest: Vec<f64> = moments.iter().map(|m| m.pressure).collect();
        Ok(interpolate(self.stations(member), &largest, arc))
    }

    /// Share of the torque that the tooth pair carries while its contact passes the point.
    fn load_share(&mut self, member: Member, radius: f64) -> Result<f64, ForwardError> {
        let (meshing, forward) = self.meshing()?;
        let cycle = forward.cycle();
        let gear = cycle.pair.member(member);
        let rho = gear.rho_at_radius(radius);
        let (paths, shares): (Vec<f64>, Vec<f64>) = (meshing.passage.order.iter())
            .map(|&(q, index)| {
                let moment = forward.moment(q, index, &meshing.contacts[q]);
                let path = cycle.positions[q].pairs[index].path;
                (path, moment / forward.torque())
            })
            .unzip();
        Ok(interpolate(
            &paths,
            &shares,
            cycle.pair.path_at_rho(member, rho),
        ))
    }
}
