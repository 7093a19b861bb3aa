//! The derivatives of what an instrument reads, by parameter.

use super::Reading;
use super::meshing::MeshingTangent;
use crate::gear::Member;
use crate::measure::{Observation, Quantity, Subject};
use crate::numeric::interpolate;
use crate::simulate::forward::ForwardError;
use crate::simulate::wear_state::worn_area;
use crate::wear::acting::side;

impl Reading<'_, '_> {
    /// The derivatives of what `observation` should be, by parameter.
    ///
    /// # Errors
    /// [`ForwardError`] if a contact cannot be solved.
    pub(in crate::learn) fn tangents_of(
        &mut self,
        observation: &Observation,
    ) -> Result<Vec<f64>, ForwardError> {
        let at = observation.position.unwrap_or(0.0);
        let pinion_for_pair = observation.member.member().unwrap_or(Member::Pinion);
        match observation.quantity {
            Quantity::WearDepth => Ok(self.depth_tangents(pinion_for_pair, at, observation)),
            Quantity::MassLoss => Ok(match observation.member {
                Subject::Pair => {
                    let [pinion, gear] = Member::BOTH.map(|member| self.mass_tangents(member));
                    pinion.iter().zip(&gear).map(|(p, g)| p + g).collect()
                }
                _ => self.mass_tangents(pinion_for_pair),
            }),
            Quantity::TransmissionError => self.transmission_error_tangents(at),
            Quantity::MeshStiffness => self.stiffness_tangents(at),
            Quantity::ContactPressure => self.pressure_tangents(pinion_for_pair, at, observation),
            Quantity::LoadShare => self.load_share_tangents(pinion_for_pair, at),
            Quantity::SpanLoss | Quantity::ChordalLoss => {
                Ok(self.thickness_tangents(pinion_for_pair, observation))
            }
            Quantity::MeanLag => {
                let fresh = self.fresh()?.1.clone();
                let tangents = self.meshing()?.0.tangents.iter();
                Ok((tangents.zip(fresh))
                    .map(|(t, f)| 1e6 * (t.mean - f))
                    .collect())
            }
        }
    }

    fn depth_tangents(&self, member: Member, radius: f64, observation: &Observation) -> Vec<f64> {
        let arc = self.arc(member, radius);
        let slices = self.sections_worn_at(member, arc, observation);
        self.each_depth(member, &slices, |stations, depths, _| {
            1e3 * self.inclined() * interpolate(stations, depths, arc)
        })
    }

    fn mass_tangents(&self, member: Member) -> Vec<f64> {
        let all = self.all_sections(member);
        self.each_depth(member, &all, |stations, depths, displaced| {
            self.mass_of(member, worn_area(stations, depths) - displaced)
        })
    }

    fn thickness_tangents(&self, member: Member, observation: &Observation) -> Vec<f64> {
        let felt = self.thickness(observation, member);
        let slices = self.sections_worn_at(member, felt.arc, observation);
        self.each_depth(member, &slices, |stations, depths, _| {
            1e3 * self.inclined() * felt.gain * interpolate(stations, depths, felt.arc)
        })
    }

    fn transmission_error_tangents(&mut self, phase: f64) -> Result<Vec<f64>, ForwardError> {
        let ratio = self.forward.cycle().pair.speed_ratio;
        let (meshing, _) = self.meshing()?;
        let of = |tangent: &MeshingTangent| {
            let approach = interpolate(&meshing.turns.0, &tangent.approach, phase.rem_euclid(1.0));
            -1e6 * (approach - tangent.mean) / ratio
        };
        Ok(meshing.tangents.iter().map(of).collect())
    }

    fn stiffness_tangents(&mut self, phase: f64) -> Result<Vec<f64>, ForwardError> {
        let stiffness = self.stiffness(phase)?;
        let (approach, _) = self.approach(phase)?;
        let (meshing, _) = self.meshing()?;
        let of = |tangent: &MeshingTangent| {
            let change = interpolate(&meshing.turns.0, &tangent.approach, phase.rem_euclid(1.0));
            -stiffness * change / approach
        };
        Ok(meshing.tangents.iter().map(of).collect())
    }

    fn pressure_tangents(
        &mut self,
        member: Member,
        radius: f64,
        observation: &Observation,
    ) -> Result<Vec<f64>, ForwardError> {
        let arc = self.arc(member, radius);
        let stations = self.stations(member).to_vec();
        let slices = self.sections_pressed_at(member, arc, observation)?;
        let (meshing, _) = self.meshing()?;
        let of = |tangent: &MeshingTangent| {
            let at = |&(i, weight): &(usize, f64)| {
                let largest = &tangent.largest[i][side(member)];
                weight * interpolate(&stations, largest, arc)
            };
            slices.iter().map(at).sum()
        };
        Ok(meshing.tangents.iter().map(of).collect())
    }

    fn load_share_tangents(
        &mut self,
        member: Member,
        radius: f64,
    ) -> Result<Vec<f64>, ForwardError> {
        let variations = self.variations;
        let (meshing, forward) = self.meshing()?;
        let cycle = forward.cycle();
        let gear = cycle.pair.member(member);
        let path = cycle.pair.path_at_rho(member, gear.rho_at_radius(radius));
        let order = &meshing.passage.order;
        let path_of = |&(q, index): &(usize, usize)| cycle.positions[q].pairs[index].path;
        let paths: Vec<f64> = order.iter().map(path_of).collect();
        let directions = forward.directions(variations);
        let of = |(tangent, direction): (&MeshingTangent, _)| {
            let share = |&(q, index): &(usize, usize)| {
                let (contact, change) = (&meshing.contacts[q], &tangent.contacts[q]);
                forward.moment_tangent(q, index, contact, change, direction) / forward.torque()
            };
            let shares: Vec<f64> = order.iter().map(share).collect();
            interpolate(&paths, &shares, path)
        };
        Ok(meshing.tangents.iter().zip(&directions).map(of).collect())
    }

    /// What `of` makes of the stations of one flank, of the derivative of its depths (the weighted sum of the `slices`) and of that of its
    /// displaced area, by parameter.
    fn each_depth(
        &self,
        member: Member,
        slices: &[(usize, f64)],
        of: impl Fn(&[f64], &[f64], f64) -> f64,
    ) -> Vec<f64> {
        let stations = self.stations(member);
        let tangents = &self.worn.tangents;
        let each = tangents.depth.iter().zip(&tangents.displaced);
        each.map(|(depth, displaced)| {
            let mut sum = vec![0.0; stations.len()];
            for &(slice, weight) in slices {
                let own = self.of_slice(depth, slice, member);
                sum.iter_mut()
                    .zip(own)
                    .for_each(|(sum, d)| *sum += weight * d);
            }
            of(stations, &sum, displaced[side(member)])
        })
        .collect()
    }
}
