//! What an instrument reads off the model: each quantity of the measurement file, in its unit.

mod derivatives;
mod meshing;
mod thickness;

use crate::effects::{Effect, Hook, Local};
use crate::gear::Member;
use crate::learn::prediction::trajectory::Node;
use crate::measure::{FacePlace, Observation, Place, Quantity, Subject};
use crate::numeric::interpolate;
use crate::simulate::forward::{Forward, ForwardError, GearSet, Variation};
use crate::simulate::wear_state::worn_area;
use crate::wear::acting::{Acting, Age, PairLoad, side};
use crate::wear::passage::Moment;
use meshing::Meshing;

/// The tooth that an observation on a member with this many names, from 0 on.
fn named_tooth(observation: &Observation, count: usize) -> Option<usize> {
    let label = observation.tooth.as_deref();
    let named = label.and_then(|label| label.trim().parse::<usize>().ok());
    named.filter(|n| (1..=count).contains(n)).map(|n| n - 1)
}

/// The member of whose measured tooth an observation is, where effects alone let teeth differ: of what stands on a flank or is felt by a gauge, unless it
/// names another tooth. None for what is the mean over all teeth.
pub(in crate::learn) fn measured_tooth(observation: &Observation, set: &GearSet) -> Option<Member> {
    let of_a_tooth = match observation.quantity {
        Quantity::WearDepth
        | Quantity::ContactPressure
        | Quantity::SpanLoss
        | Quantity::ChordalLoss => true,
        Quantity::MassLoss
        | Quantity::TransmissionError
        | Quantity::LoadShare
        | Quantity::MeshStiffness
        | Quantity::MeanLag => false,
    };
    let member = observation.member.member().filter(|_| of_a_tooth)?;
    let count = set.gears[side(member)].spec.teeth as usize;
    let first = named_tooth(observation, count).unwrap_or(0) == 0;
    first.then_some(member)
}

/// A worn state that can be read. Contacts are solved only when a quantity asks for them.
pub(in crate::learn) struct Reading<'r, 'f> {
    forward: &'r mut Forward<'f>,
    worn: &'r Node,
    set: &'r GearSet,
    /// What the state's derivatives are with respect to.
    variations: &'r [Variation],
    meshing: Option<Meshing>,
    /// Mean approach of the unworn flanks, rad, and its derivatives by parameter.
    fresh: Option<(f64, Vec<f64>)>,
}

impl<'r, 'f> Reading<'r, 'f> {
    /// Reads a worn state, with the derivatives that it has by `variations`.
    pub(in crate::learn) fn new(
        forward: &'r mut Forward<'f>,
        worn: &'r Node,
        set: &'r GearSet,
        variations: &'r [Variation],
    ) -> Self {
        Self {
            forward,
            worn,
            set,
            variations,
            meshing: None,
            fresh: None,
        }
    }

    /// The value that `observation` should have, in the unit of its quantity.
    ///
    /// # Errors
    /// [`ForwardError`] if a contact cannot be solved.
    pub(in crate::learn) fn of(&mut self, observation: &Observation) -> Result<f64, ForwardError> {
        let at = observation.position.unwrap_or(0.0);
        let pinion_for_pair = observation.member.member().unwrap_or(Member::Pinion);
        match observation.quantity {
            Quantity::WearDepth => Ok(self.depth(pinion_for_pair, at, observation)),
            Quantity::MassLoss => Ok(match observation.member {
                Subject::Pair => Member::BOTH.into_iter().map(|m| self.mass(m)).sum(),
                _ => self.mass(pinion_for_pair),
            }),
            Quantity::TransmissionError => self.transmission_error(at),
            Quantity::LoadShare => self.load_share(pinion_for_pair, at),
            Quantity::ContactPressure => self.pressure(pinion_for_pair, at, observation),
            Quantity::MeshStiffness => self.stiffness(at),
            Quantity::SpanLoss | Quantity::ChordalLoss => {
                Ok(1e3 * self.inclined() * self.thickness(observation, pinion_for_pair).loss)
            }
            Quantity::MeanLag => {
                let fresh = self.fresh()?.0;
                Ok(1e6 * (self.meshing()?.0.mean - fresh))
            }
        }
    }

    /// What an observed flank point feels: the contact at the moment at which it presses the point most, and the depth worn by
    /// then. None for what stands nowhere on a flank.
    ///
    /// # Errors
    /// [`ForwardError`] if a contact cannot be solved.
    pub(in crate::learn) fn local(
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
        let depth = 1e-3 * self.depth(member, radius, observation) / self.inclined();
        let pressure = self.pressure(member, radius, observation)?;
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

    /// Depths of `member` in slice `slice` of all depths `u`.
    fn of_slice<'u>(&self, u: &'u [f64], slice: usize, member: Member) -> &'u [f64] {
        let stations = &self.forward.cycle().stations;
        let own = &u[slice * stations.count()..(slice + 1) * stations.count()];
        let (pinion, gear) = own.split_at(stations.arc[0].len());
        match member {
            Member::Pinion => pinion,
            Member::Gear => gear,
        }
    }

    /// The slices of which what is measured at `face` is a sum, with their weights, `value` being what each has; where the row does not say, it is
    /// where the effects say that traces are taken, else at mid-face.
    fn slices_at(
        &self,
        face: Option<FacePlace>,
        value: impl Fn(usize) -> f64,
    ) -> Vec<(usize, f64)> {
        let Some(slices) = self.forward.slices() else {
            return vec![(0, 1.0)];
        };
        let mean = slices.weight.iter().copied().enumerate();
        match face {
            Some(FacePlace::At(face)) => slices.read_at(face, value),
            Some(FacePlace::Mean) => mean.collect(),
            None => {
                let effects = self.forward.acting().map(|acting| &acting.effects);
                let usual = effects.and_then(|e| e.usual_trace()).unwrap_or_default();
                let at = slices.read_at(0.5 * self.set.face_width * usual.place, value);
                let at = at.into_iter().map(|(i, w)| (i, (1.0 - usual.mean) * w));
                let mean = mean.map(|(i, w)| (i, usual.mean * w));
                at.chain(mean).filter(|(_, w)| *w != 0.0).collect()
            }
        }
    }

    /// The same of depths at `arc` (mm) of the flank of `member`.
    fn sections_worn_at(
        &self,
        member: Member,
        arc: f64,
        observation: &Observation,
    ) -> Vec<(usize, f64)> {
        self.sections(member, observation, |slice| {
            self.depth_of_slice(slice, member, arc)
        })
    }

    /// The same of the largest pressures at `arc` (mm) of the flank of `member`.
    fn sections_pressed_at(
        &mut self,
        member: Member,
        arc: f64,
        observation: &Observation,
    ) -> Result<Vec<(usize, f64)>, ForwardError> {
        let by_slice = self.pressures(member, arc)?;
        Ok(self.sections(member, observation, |slice| by_slice[slice]))
    }

    /// What an observation on `member` is read from: slices of the face, `value` being what each has, or passages of teeth that differ, with their
    /// weights.
    ///
    /// A whole number from 1 on in the column `tooth` names a tooth; another label says nothing. Rows without are those of the measured
    /// tooth (number 1) where effects alone let teeth differ, else of the mean tooth: an effect that joins a study with a pitch chart must not
    /// give its rows another meaning.
    fn sections(
        &self,
        member: Member,
        observation: &Observation,
        value: impl Fn(usize) -> f64,
    ) -> Vec<(usize, f64)> {
        let Some(sequence) = self.forward.sequence() else {
            return self.slices_at(observation.face, value);
        };
        let count = self.forward.cycle().pair.member(member).spec.teeth as usize;
        let tooth = named_tooth(observation, count);
        let acting = self.forward.acting();
        let by_effects = acting.is_some_and(|acting| acting.acts(Hook::ToothOffset));
        let measured = (by_effects && !self.forward.states_teeth()).then_some(0);
        match tooth.or(measured) {
            Some(tooth) => sequence.homes(side(member), tooth),
            None => self.all_sections(member),
        }
    }

    /// All slices of the face, or the passages of all teeth of `member`, with their shares.
    fn all_sections(&self, member: Member) -> Vec<(usize, f64)> {
        let weights = match (self.forward.sequence(), self.forward.slices()) {
            (Some(sequence), _) => sequence.weights(side(member)),
            (None, Some(slices)) => &slices.weight,
            (None, None) => &[1.0],
        };
        let all = weights.iter().copied().enumerate();
        all.filter(|(_, weight)| *weight != 0.0).collect()
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

    /// Of a depth in the transverse section what is normal to the flank: cos β_b. Gauges measure normal to it too.
    fn inclined(&self) -> f64 {
        self.forward.cycle().pair.cos_base_helix()
    }

    /// µm normal to the flank, the weighted sum of slices or passages.
    fn depth(&self, member: Member, radius: f64, observation: &Observation) -> f64 {
        let arc = self.arc(member, radius);
        let slices = self.sections_worn_at(member, arc, observation);
        let weighted =
            |&(slice, weight): &(usize, f64)| weight * self.depth_of_slice(slice, member, arc);
        1e3 * self.inclined() * slices.iter().map(weighted).sum::<f64>()
    }

    /// mm.
    fn depth_of_slice(&self, slice: usize, member: Member, arc: f64) -> f64 {
        let depths = self.of_slice(&self.worn.u, slice, member);
        interpolate(self.stations(member), depths, arc)
    }

    /// mg of the whole member.
    fn mass(&self, member: Member) -> f64 {
        let side = side(member);
        let mean = self.forward.mean_depths(&self.worn.u);
        let depths = self.of_slice(&mean, 0, member);
        let lost = worn_area(self.stations(member), depths) - self.worn.displaced[side];
        self.mass_of(member, lost)
    }

    /// mg of the whole member for the area (mm²) lost on each of its flanks.
    fn mass_of(&self, member: Member, lost: f64) -> f64 {
        let teeth = self.forward.cycle().pair.member(member).spec.teeth;
        // mm³ · kg/m³ = µg
        1e-3 * lost * self.set.face_width * f64::from(teeth) * self.set.densities[side(member)]
    }

    /// What follows from the contacts, and the run as it was prepared for them.
    fn meshing(&mut self) -> Result<(&Meshing, &Forward<'f>), ForwardError> {
        let meshing = match self.meshing.take() {
            Some(known) => known,
            None => Meshing::new(self.forward, self.worn, self.variations)?,
        };
        Ok((self.meshing.insert(meshing), self.forward))
    }

    /// The mean approach of the unworn flanks under the same load, rad, and its derivatives.
    fn fresh(&mut self) -> Result<&(f64, Vec<f64>), ForwardError> {
        let fresh = match self.fresh.take() {
            Some(known) => known,
            None => {
                let mut unworn = self.worn.clone();
                unworn.u.fill(0.0);
                unworn.tangents.depth.iter_mut().for_each(|d| d.fill(0.0));
                let meshing = Meshing::new(self.forward, &unworn, self.variations)?;
                let tangents = meshing.tangents.iter().map(|t| t.mean).collect();
                (meshing.mean, tangents)
            }
        };
        Ok(self.fresh.insert(fresh))
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
    fn pressure(
        &mut self,
        member: Member,
        radius: f64,
        observation: &Observation,
    ) -> Result<f64, ForwardError> {
        let arc = self.arc(member, radius);
        let by_slice = self.pressures(member, arc)?;
        let slices = self.sections(member, observation, |slice| by_slice[slice]);
        let weighted = |&(slice, weight): &(usize, f64)| weight * by_slice[slice];
        Ok(slices.iter().map(weighted).sum())
    }

    /// The largest pressure at `arc` (mm) of the flank of `member` in each slice, MPa.
    fn pressures(&mut self, member: Member, arc: f64) -> Result<Vec<f64>, ForwardError> {
        let meshing = self.meshing()?.0;
        let of = |moments: &[Vec<Moment>; 2]| -> Vec<f64> {
            moments[side(member)].iter().map(|m| m.pressure).collect()
        };
        let largest: Vec<Vec<f64>> = meshing.by_slice.iter().map(of).collect();
        let stations = self.stations(member);
        let at = |largest: &Vec<f64>| interpolate(stations, largest, arc);
        Ok(largest.iter().map(at).collect())
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
