//! Curves along the path of contact, their parts and their means.

use super::data::{ContactCurve, Flank, Means, ModelResult, Quantity, SingleContact, Span};
use crate::analytic::hertz_line;
use crate::contact::cycle::Cycle;
use crate::contact::frame::Touch;
use crate::contact::model::PositionContact;
use crate::gear::{Member, Pair, Region};
use crate::numeric::interpolate;
use crate::simulate::wear_state::line_load;

/// Places per part at which curves are compared: the midpoints of as many equal steps.
pub(super) const PLACES: usize = 200;

/// What a model, or a step between two, says of the unworn contact and of the worn flanks.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct State {
    pub(super) contact: ContactCurve,
    pub(super) depth: [Option<Flank>; 2],
}

impl State {
    pub(super) fn of(model: &ModelResult) -> Self {
        Self {
            contact: model.contact.clone(),
            depth: [Some(model.pinion.clone()), model.gear.clone()],
        }
    }

    /// Abscissae and ordinates of `quantity` on the line of action; `None` where the state has no such thing.
    fn curve(&self, quantity: Quantity) -> Option<(Vec<f64>, Vec<f64>)> {
        let contact = |values: &[f64]| {
            let on_line = |i: &usize| !self.contact.off_line_of_action[*i];
            let kept: Vec<usize> = (0..values.len()).filter(on_line).collect();
            Some((
                kept.iter().map(|&i| self.contact.path[i]).collect(),
                kept.iter().map(|&i| values[i]).collect(),
            ))
        };
        let depth = |side: usize| {
            let flank = self.depth[side].as_ref()?;
            Some((flank.path.clone(), flank.depth_um.clone()))
        };
        match quantity {
            Quantity::PeakPressure => contact(&self.contact.peak_pressure),
            Quantity::LoadShare => contact(&self.contact.load_share),
            Quantity::DepthPinion => depth(0),
            Quantity::DepthGear => depth(1),
        }
    }

    /// Values of `quantity` at the places of each part.
    pub(super) fn sample(&self, quantity: Quantity, spans: &[Span]) -> Option<Vec<Vec<f64>>> {
        let (path, values) = self.curve(quantity)?;
        let at = |span: &Span| {
            (0..PLACES)
                .map(|i| within(span, &path, &values, place(span, i)))
                .collect()
        };
        (!path.is_empty()).then(|| spans.iter().map(at).collect())
    }

    /// The load share at `y` (mm along the path of contact).
    pub(super) fn load_share(&self, spans: &[Span], y: f64) -> f64 {
        let span = spans.iter().find(|s| (s.from..=s.to).contains(&y));
        match (span, self.curve(Quantity::LoadShare)) {
            (Some(span), Some((path, share))) if !path.is_empty() => within(span, &path, &share, y),
            _ => 0.0,
        }
    }

    /// Means of `quantity` along the path of contact.
    pub(super) fn means(&self, quantity: Quantity, spans: &[Span]) -> Option<Means> {
        let regions: Vec<f64> = self
            .sample(quantity, spans)?
            .iter()
            .map(|v| mean(v))
            .collect();
        let length: f64 = spans.iter().map(|s| s.to - s.from).sum();
        let weighted: f64 = spans
            .iter()
            .zip(&regions)
            .map(|(s, m)| (s.to - s.from) * m)
            .sum();
        Some(Means {
            quantity,
            regions,
            whole: weighted / length,
        })
    }
}

/// Piecewise linear interpolation by the points of one part only: load jumps where a part ends.
fn within(span: &Span, path: &[f64], values: &[f64], y: f64) -> f64 {
    let first = path.partition_point(|&y| y < span.from);
    let last = path.partition_point(|&y| y <= span.to);
    let own = if first < last {
        first..last
    } else {
        0..path.len()
    };
    interpolate(&path[own.clone()], &values[own], y)
}

pub(super) fn place(span: &Span, i: usize) -> f64 {
    span.from + (span.to - span.from) * (i as f64 + 0.5) / PLACES as f64
}

pub(super) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The parts of the path of contact that are not empty.
pub(super) fn spans(pair: &Pair) -> Vec<Span> {
    let [a, b, c, d, e] = pair.path_points();
    // with a contact ratio of 2 and more no pair ever stands alone: the pitch point parts the two double regions
    let (b, d) = if b > d {
        (c.clamp(a, e), c.clamp(a, e))
    } else {
        (b, d)
    };
    let pitch = c.clamp(b, d);
    [
        (Region::LowerDouble, a, b),
        (Region::SingleLower, b, pitch),
        (Region::SingleUpper, pitch, d),
        (Region::UpperDouble, d, e),
    ]
    .into_iter()
    .filter(|(_, from, to)| to - from > 1e-6 * pair.base_pitch)
    .map(|(region, from, to)| Span { region, from, to })
    .collect()
}

/// Share of the torque from which a pair counts as the only one: a corner that just touches carries less than the rest.
const ALONE: f64 = 0.9999;

/// Where one pair alone carries the load in `contact`, and how its pressures compare with Hertz's for the contact modulus
/// E* (MPa).
pub(super) fn single_contact(
    contact: &ContactCurve,
    pair: &Pair,
    modulus: f64,
) -> Option<SingleContact> {
    let alone: Vec<usize> = (0..contact.path.len())
        .filter(|&i| contact.load_share[i] > ALONE)
        .collect();
    let off = |&i: &usize| {
        let radius = pair.relative_radius(contact.path[i]);
        let hertz = hertz_line::peak_pressure(contact.line_load[i], radius, modulus);
        contact.peak_pressure[i] / hertz - 1.0
    };
    let off: Vec<f64> = alone.iter().map(off).collect();
    Some(SingleContact {
        from: contact.path[*alone.first()?],
        to: contact.path[*alone.last()?],
        largest_difference: off
            .iter()
            .fold(0.0, |m: f64, x| if x.abs() > m.abs() { *x } else { m }),
        mean_difference: mean(&off.iter().map(|x| x.abs()).collect::<Vec<_>>()),
    })
}

/// How contacts of a cycle become a curve.
pub(super) struct Reading<'a> {
    pub(super) cycle: &'a Cycle,
    /// Torque per face width of a tooth pair, given by position and number, N·mm/mm.
    pub(super) moment: &'a dyn Fn(usize, usize, &PositionContact) -> f64,
    /// Torque per face width, N·mm/mm.
    pub(super) torque: f64,
    /// Contact modulus if contacts on the line of action are Hertz's: their peak then follows from the load.
    pub(super) hertz: Option<f64>,
}

impl Reading<'_> {
    /// All pairs on the line of action and the loaded ones off it.
    pub(super) fn curve(&self, contacts: &[PositionContact]) -> ContactCurve {
        let geometry = &self.cycle.pair;
        let mut points = Vec::new();
        for (q, (position, contact)) in self.cycle.positions.iter().zip(contacts).enumerate() {
            for (index, pair) in position.pairs.iter().enumerate() {
                let load = line_load(pair, contact);
                let on_line = pair.frame.touch == Touch::Flanks;
                if !on_line && load <= 0.0 {
                    continue;
                }
                let own = pair.offset..pair.offset + pair.xi.len();
                let pressure = &contact.pressure[own.clone()];
                let moment = (self.moment)(q, index, contact);
                let peak = match self.hertz.filter(|_| on_line) {
                    Some(_) if load <= 0.0 => 0.0,
                    Some(modulus) => hertz_line::peak_pressure(
                        load,
                        geometry.relative_radius(pair.path),
                        modulus,
                    ),
                    None => pressure.iter().fold(0.0, |m: f64, p| m.max(*p)),
                };
                let radius = |side: usize| {
                    geometry
                        .member(Member::BOTH[side])
                        .radius_at_rho(pair.frame.rho[side])
                };
                let columns = [
                    pair.path,
                    radius(0),
                    radius(1),
                    moment / self.torque,
                    load,
                    peak,
                ];
                points.push((columns, !on_line));
            }
        }
        points.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
        let column = |i: usize| points.iter().map(|p| p.0[i]).collect();
        ContactCurve {
            path: column(0),
            radius_pinion: column(1),
            radius_gear: column(2),
            load_share: column(3),
            line_load: column(4),
            peak_pressure: column(5),
            off_line_of_action: points.iter().map(|p| p.1).collect(),
        }
    }
}

/// Depths (mm) at the stations of both members as curves along the path of contact.
pub(super) fn flanks(cycle: &Cycle, depth: [&[f64]; 2]) -> [Flank; 2] {
    [0, 1].map(|side| {
        let member = Member::BOTH[side];
        let gear = cycle.pair.member(member);
        let mut points: Vec<[f64; 3]> = cycle.stations.arc[side]
            .iter()
            .zip(depth[side])
            .map(|(&arc, h)| {
                let rho = gear.rho_at_arc(arc);
                [
                    gear.radius_at_rho(rho),
                    cycle.pair.path_at_rho(member, rho),
                    1e3 * h,
                ]
            })
            .collect();
        points.sort_by(|a, b| a[1].total_cmp(&b[1]));
        let column = |i: usize| points.iter().map(|p| p[i]).collect();
        Flank {
            radius: column(0),
            path: column(1),
            depth_um: column(2),
        }
    })
}
