//! Where a run is measured, and what is seen there.

use std::collections::HashMap;

use crate::involute::Mating;
use crate::layout::{self, Place, Sort};
use crate::rig::{Plan, Rig};
use crate::wear::{History, Run};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// um, at a radius (mm)
    Depth,
    /// mg
    Mass,
    /// Gear angle minus its ideal, urad, its mean over the base pitch removed; at a rotation (base pitches)
    Error,
    /// Part of the load on the measured tooth, at a radius (mm)
    Share,
    /// Change of the mean lag seen at the pinion since the new state, urad
    Lag,
}

impl Quantity {
    pub fn name(self) -> &'static str {
        match self {
            Self::Depth => "wear_depth",
            Self::Mass => "mass_loss",
            Self::Error => "transmission_error",
            Self::Share => "load_share",
            Self::Lag => "mean_lag",
        }
    }
}

#[derive(Clone, Debug)]
pub struct Row {
    pub test: usize,
    /// 2: the pair.
    pub member: usize,
    pub cycles: f64,
    pub quantity: Quantity,
    pub place: Place,
    /// Radius, mm, or rotation in base pitches; none for what has no position.
    pub position: Option<f64>,
    /// Rows of one trace follow each other; a name without an `@` stands in the file and means a datum of its own.
    pub trace: String,
    pub sigma: f64,
    pub free: f64,
    pub value: f64,
}

impl Row {
    /// A point of a depth profile.
    pub fn is_depth(&self) -> bool {
        self.quantity == Quantity::Depth
    }

    pub fn has_datum(&self) -> bool {
        self.is_depth()
    }
}

/// Rotations at which the transmission error is read.
const ROTATIONS: usize = 24;
/// Radii at which the load share is read.
const SHARES: usize = 16;

impl Rig {
    /// Where a test is measured: (member, radii), on the active profile with margins at both ends.
    pub fn radii(&self, plan: &Plan) -> [Vec<f64>; 2] {
        self.some_radii(plan, self.points)
    }

    fn some_radii(&self, plan: &Plan, points: usize) -> [Vec<f64>; 2] {
        let pair = Mating::new(
            &self.pinion,
            &self.gear,
            self.centre + plan.conditions.misalignment,
        );
        [0, 1].map(|m| {
            let t = pair.teeth(m);
            let low = pair.rho(m, if m == 0 { pair.start } else { pair.end });
            let low = t.radius(t.rho_of_arc(t.arc(low) + 0.12 * t.m));
            let high = t.ra - 0.15 * t.m;
            (0..points)
                .map(|i| {
                    let r = low + (high - low) * i as f64 / (points - 1) as f64;
                    (r * 1e3).round() / 1e3
                })
                .collect()
        })
    }

    /// Deepest wear where the test is measured, um.
    pub fn deepest(&self, plan: &Plan, run: &Run, history: &History, cycles: f64) -> f64 {
        let state = history.at(cycles);
        let p = run.passage();
        let mut deepest = 0.0f64;
        for (m, radii) in self.radii(plan).iter().enumerate() {
            let t = p.pair.teeth(m);
            let part = run.flank(&state, m, 0);
            for &r in radii {
                deepest = deepest.max(1e3 * p.stations[m].sample(part, t.arc(t.rho(r))));
            }
        }
        deepest
    }

    /// Rows of a test without values, in the order of the file.
    pub fn rows(&self, plan: &Plan, test: usize) -> Vec<Row> {
        let radii = self.radii(plan);
        let mut rows = Vec::new();
        for (c, &cycles) in plan.checkpoints.iter().enumerate() {
            let row = |member, quantity, place, position, trace: String| Row {
                test,
                member,
                cycles,
                quantity,
                place,
                position,
                trace,
                sigma: 0.0,
                free: 0.0,
                value: 0.0,
            };
            for m in 0..2 {
                for (q, &place) in self.places.iter().enumerate() {
                    let mut name = format!("{}-{}-{}", plan.id, ["p", "g"][m], c + 1);
                    if self.places.len() > 1 {
                        name += ["a", "b", "c"][q];
                    }
                    let points = radii[m].iter();
                    rows.extend(
                        points.map(|&r| row(m, Quantity::Depth, place, Some(r), name.clone())),
                    );
                }
                rows.push(row(m, Quantity::Mass, Place::Mean, None, String::new()));
            }
            if self.mesh {
                let name = format!("{}@error-{}", plan.id, c + 1);
                let at = (0..ROTATIONS).map(|i| (i as f64 / ROTATIONS as f64 * 1e4).round() / 1e4);
                rows.extend(
                    at.map(|x| row(2, Quantity::Error, Place::Mean, Some(x), name.clone())),
                );
                for (m, radii) in self.some_radii(plan, SHARES).iter().enumerate() {
                    let name = format!("{}@share{m}-{}", plan.id, c + 1);
                    let points = radii.iter();
                    rows.extend(
                        points
                            .map(|&r| row(m, Quantity::Share, Place::Mean, Some(r), name.clone())),
                    );
                }
                rows.push(row(2, Quantity::Lag, Place::Mean, None, String::new()));
            }
        }
        rows
    }

    /// Values of the rows with the history's cycles scaled by `scale`.
    pub fn observe(&self, run: &Run, history: &History, rows: &[Row], scale: f64) -> Vec<f64> {
        let p = run.passage();
        let mut at = f64::NAN;
        let mut state = Vec::new();
        let mut mesh: Option<Mesh> = None;
        let new = rows.iter().any(|r| r.quantity == Quantity::Lag);
        let new = new.then(|| Mesh::of(run, &history.depth[0]));
        rows.iter()
            .map(|r| {
                if r.cycles != at {
                    at = r.cycles;
                    state = history.at(at * scale);
                    mesh = None;
                }
                let on_mesh =
                    [Quantity::Error, Quantity::Share, Quantity::Lag].contains(&r.quantity);
                if on_mesh && mesh.is_none() {
                    mesh = Some(Mesh::of(run, &state));
                }
                let position = r.position.unwrap_or_default();
                match (r.quantity, &mesh) {
                    (Quantity::Error, Some(mesh)) => mesh.error(position),
                    (Quantity::Share, Some(mesh)) => mesh.share(run, r.member, position),
                    (Quantity::Lag, Some(mesh)) => mesh.lag - new.as_ref().map_or(0.0, |n| n.lag),
                    (Quantity::Mass, _) => run.mass(&state, r.member),
                    _ => {
                        let t = p.pair.teeth(r.member);
                        let arc = t.arc(t.rho(position));
                        let of = |flank| {
                            p.stations[r.member].sample(run.flank(&state, r.member, flank), arc)
                        };
                        let parts = run.layout.at(r.member, r.place);
                        1e3 * parts.iter().map(|&(flank, w)| w * of(flank)).sum::<f64>()
                    }
                }
            })
            .collect()
    }
}

/// The mesh over one base pitch, of one state.
pub struct Mesh {
    /// Lag of the gear seen at the gear, urad, per position.
    lags: Vec<f64>,
    /// Mean lag seen at the pinion, urad.
    pub lag: f64,
    /// Path coordinate and part of the load, ascending; per member, of its measured tooth.
    shares: [Vec<(f64, f64)>; 2],
}

impl Mesh {
    pub fn of(run: &Run, depth: &[f64]) -> Self {
        let surface: Vec<f64> = (depth.iter().zip(run.profile()))
            .map(|(a, b)| a + b)
            .collect();
        let pair = &run.passage().pair;
        let mut lags = vec![0.0; run.passage().positions.len()];
        let mut shares: [HashMap<i64, (f64, f64, f64)>; 2] = Default::default();
        for (number, scene) in run.layout.scenes.iter().enumerate() {
            let p = &run.passages[scene.passage];
            for (i, at) in p.positions.iter().enumerate() {
                let answer = run.contact(number, i, &surface, &mut Vec::new());
                if scene.passage == 0 {
                    lags[i] += scene.time * answer.approach * 1e6 / pair.gear.rb;
                }
                let all: f64 = answer.loads.iter().sum();
                for (k, slot) in at.slots.iter().enumerate() {
                    let own: f64 = (0..scene.slices.len())
                        .map(|q| answer.loads[q * at.slots.len() + k])
                        .sum();
                    for m in 0..2 {
                        let flank = scene.slices[0].flank[m][layout::place(slot.j)];
                        if matches!(run.layout.kind, Sort::Teeth(tooth) if tooth[m] != flank) {
                            continue;
                        }
                        let entry = shares[m]
                            .entry((slot.s * 1e6).round() as i64)
                            .or_insert((slot.s, 0.0, 0.0));
                        entry.1 += scene.time * own / all;
                        entry.2 += scene.time;
                    }
                }
            }
        }
        let lag = lags.iter().sum::<f64>() / lags.len() as f64 * pair.gear.rb / pair.pinion.rb;
        let shares = shares.map(|s| {
            let mut list: Vec<(f64, f64)> = s
                .into_values()
                .map(|(s, sum, time)| (s, sum / time))
                .collect();
            list.sort_by(|a, b| a.0.total_cmp(&b.0));
            list
        });
        Self { lags, lag, shares }
    }

    /// Transmission error at a rotation from the pitch point, base pitches: straight between positions.
    pub fn error(&self, rotation: f64) -> f64 {
        let n = self.lags.len();
        let x = rotation * n as f64 - 0.5;
        let k = x.floor();
        let at = |k: f64| self.lags[(k as i64).rem_euclid(n as i64) as usize];
        let mean = self.lags.iter().sum::<f64>() / n as f64;
        mean - (at(k) + (x - k) * (at(k + 1.0) - at(k)))
    }

    pub fn share(&self, run: &Run, member: usize, radius: f64) -> f64 {
        let pair = &run.passage().pair;
        let rho = pair.teeth(member).rho(radius);
        let s = if member == 0 {
            rho - pair.c1
        } else {
            pair.c2 - rho
        };
        let list = &self.shares[member];
        let k = list.partition_point(|x| x.0 < s).clamp(1, list.len() - 1);
        let (a, b) = (list[k - 1], list[k]);
        (a.1 + (b.1 - a.1) * (s - a.0) / (b.0 - a.0)).clamp(0.0, 1.0)
    }
}
