//! One tooth passage: where the flanks meet at a row of pinion rotations, with which gaps and elastic coupling.
//!
//! Every tooth pair has a frame on the line of action: e along the common tangent (outward on the pinion), n along the line
//! of action from pinion to gear. Both flanks are exact involutes there. Before the start and after the end of the path of
//! contact the mate's flank ends at its tip corner, which then lies inside the frame: the same formula gives its gap, and
//! cells beyond the corner do not exist. So contact at tip corners needs no formula of its own.

use crate::involute::Mating;
use crate::layout::PLACES;
use crate::ring::{FlankCompliance, NU, PLANE};

/// Pressure cells of one tooth pair at one position.
#[derive(Clone)]
pub struct Slot {
    /// Path coordinate of the pair, mm from the pitch point.
    pub s: f64,
    /// Which pair: base pitches from the one nearest the pitch point.
    pub j: i64,
    /// First cell of this pair in the position's list, and number.
    pub from: usize,
    pub count: usize,
}

#[derive(Clone)]
pub struct Cell {
    /// Nominal gap, mm.
    pub gap: f64,
    /// Flank station below, fraction to the next, per member.
    pub station: [(u32, f32); 2],
    /// Where sliding of this cell's pressure wears the flanks: first station and weights, per member.
    pub first: [u32; 2],
    pub range: [(u32, u32); 2],
}

pub struct Position {
    pub slots: Vec<Slot>,
    pub cells: Vec<Cell>,
    /// Displacement of cell i under unit pressure on cell j, row-major, mm/MPa.
    pub flexibility: Vec<f64>,
    /// The same under unit traction, outward on both flanks; empty where nobody asked for friction.
    pub shear: Vec<f64>,
}

/// A flank's stations, equidistant in arc length.
#[derive(Clone, Debug)]
pub struct Stations {
    pub low: f64,
    pub step: f64,
    pub count: usize,
}

impl Stations {
    pub fn arc(&self, k: usize) -> f64 {
        self.low + self.step * k as f64
    }
    fn place(&self, arc: f64) -> (u32, f32) {
        let x = ((arc - self.low) / self.step).clamp(0.0, (self.count - 1) as f64);
        let k = (x as usize).min(self.count - 2);
        (k as u32, (x - k as f64) as f32)
    }
    pub fn sample(&self, values: &[f64], arc: f64) -> f64 {
        let (k, f) = self.place(arc);
        let (k, f) = (k as usize, f64::from(f));
        values[k] * (1.0 - f) + values[k + 1] * f
    }
    pub fn width(&self, k: usize) -> f64 {
        if k == 0 || k + 1 == self.count {
            0.5 * self.step
        } else {
            self.step
        }
    }
}

pub struct Passage {
    pub pair: Mating,
    pub cell: f64,
    pub stations: [Stations; 2],
    pub positions: Vec<Position>,
    /// Deposit weights, `SPAN` per cell and member: depth per pressure, mm/MPa, for k = 1 and one contact.
    pub deposits: Vec<Vec<[f32; SPAN]>>,
    pub e_star: f64,
}

pub const SPAN: usize = 12;

#[derive(Clone, Copy, Debug)]
pub struct Fineness {
    /// Per base pitch, at least.
    pub positions: usize,
    pub cells_per_half_width: f64,
    pub extent: f64,
}

impl Default for Fineness {
    fn default() -> Self {
        Self {
            positions: 64,
            cells_per_half_width: 6.5,
            extent: 4.0,
        }
    }
}

impl Passage {
    /// `load`: the line load expected, N/mm; `shared`: stations of other passages of the same flanks, to be kept; `friction`: also what traction does.
    pub fn new(
        pair: Mating,
        soft: &[FlankCompliance; 2],
        youngs: f64,
        load: f64,
        fine: Fineness,
        shared: Option<&[Stations; 2]>,
        friction: bool,
    ) -> Self {
        let e_star = youngs / (2.0 * (1.0 - NU * NU));
        let curvature = pair.c1 * pair.c2 / (pair.c1 + pair.c2);
        let half_width = (4.0 * load * curvature / (std::f64::consts::PI * e_star)).sqrt();
        let dx = half_width / fine.cells_per_half_width;
        let reach = (fine.extent * fine.cells_per_half_width).ceil() as i64;
        // Contact must not travel further between two positions than it is wide, nor over many stations: waves that no
        // position sees would grow. Narrowest at the ends of the path, where a pair carries about two fifths.
        let mut positions = fine.positions as f64;
        for s in [pair.start, pair.end] {
            let (a, b) = (pair.rho(0, s), pair.rho(1, s));
            let narrow =
                (4.0 * 0.4 * load * a * b / (a + b) / (std::f64::consts::PI * e_star)).sqrt();
            let way = (a / pair.pinion.rb).max(b / pair.gear.rb) * pair.pb;
            positions = positions.max(way / (0.6 * narrow).min(2.6 * dx));
        }
        let positions_per_pitch = (positions.ceil() as usize).min(320);
        let stride = pair.pb / positions_per_pitch as f64;
        // Deflection of a pair, generously: 8 N/(mm um) for steel, scaled with E.
        let give = load / (8.0e3 * youngs / 2.1e5);
        let extension = 0.2 * pair.pb;
        let own = [0, 1].map(|m| {
            let t = pair.teeth(m);
            let deepest = if m == 0 {
                pair.rho(0, pair.start - extension)
            } else {
                pair.rho(1, pair.end + extension)
            };
            let low = t.arc(deepest.max(t.rho(t.form_radius())).max(0.02 * t.m));
            let high = t.arc(t.rho_tip());
            let n = ((high - low) / dx).ceil() as usize + 1;
            Stations {
                low,
                step: (high - low) / (n - 1) as f64,
                count: n,
            }
        });
        let stations = shared.cloned().unwrap_or(own);
        let tip = [0, 1].map(|m| pair.teeth(m).arc(pair.teeth(m).rho_tip()));
        // Arc coordinate of a member's flank at path s, offset x along e.
        let arc = |m: usize, s: f64, x: f64| {
            let rho = pair.rho(m, s);
            let sign = if m == 0 { 1.0 } else { -1.0 };
            pair.teeth(m).arc(rho.abs()) * rho.signum() + sign * x
        };
        // Offset of the frame's cells: at the corner when the path of contact has not begun or has ended.
        let origin = |s: f64| {
            if s < pair.start {
                arc(1, s, 0.0) - tip[1]
            } else if s > pair.end {
                tip[0] - arc(0, s, 0.0)
            } else {
                0.0
            }
        };
        let gap = |s: f64, x: f64| {
            let side = |m: usize| {
                let t = pair.teeth(m);
                let rho0 = pair.rho(m, s);
                let rho = t.rho_of_arc(arc(m, s, x));
                let phi = (rho - rho0) / t.rb;
                rho0 + t.rb * phi.sin() - rho * phi.cos()
            };
            side(0) + side(1)
        };
        let rate = 1.0 / pair.pinion.rb + 1.0 / pair.gear.rb;
        let mut positions = Vec::new();
        let mut deposits = Vec::new();
        for i in 0..positions_per_pitch {
            let theta = (i as f64 + 0.5) / positions_per_pitch as f64;
            let mut slots = Vec::new();
            let mut cells = Vec::new();
            let mut weights = Vec::new();
            let mut spots = Vec::new(); // (slot's tooth, x index, compliance weights)
            for j in PLACES {
                let s = (theta + j as f64) * pair.pb;
                if s < pair.start - extension || s > pair.end + extension {
                    continue;
                }
                if gap(s, origin(s)) > 4.0 * give {
                    continue;
                }
                let from = cells.len();
                for c in -reach..reach {
                    let offset = (c as f64 + 0.5) * dx;
                    let x = origin(s) + offset;
                    let arcs = [arc(0, s, x), arc(1, s, x)];
                    if (0..2).any(|m| arcs[m] > tip[m] + 1e-9 || arcs[m] <= stations[m].low) {
                        continue;
                    }
                    let mut first = [0u32; 2];
                    let mut range = [(0u32, 0u32); 2];
                    for m in 0..2 {
                        let st = &stations[m];
                        let mut touched = Vec::new();
                        for q in 0..8 {
                            let tau = (q as f64 - 3.5) / 4.0;
                            let sq = s + tau * stride;
                            let time = (1.0 - tau.abs()) / 4.0;
                            for sub in [-1.0, 0.0, 1.0] {
                                let at = arc(m, sq, origin(sq) + offset + sub * dx / 3.0);
                                let (k, f) = st.place(at);
                                let amount = time * sq.abs() * rate * stride * dx / 3.0;
                                touched.push((k as usize, amount * (1.0 - f64::from(f))));
                                touched.push((k as usize + 1, amount * f64::from(f)));
                            }
                        }
                        let low = touched.iter().map(|t| t.0).min().unwrap_or(0);
                        let low = low.min(st.count - SPAN);
                        let mut w = [0f32; SPAN];
                        for (k, a) in touched {
                            // What would reach beyond the span stays on its last station.
                            let k = k.min(low + SPAN - 1);
                            w[k - low] += (a / st.width(k)) as f32;
                        }
                        first[m] = low as u32;
                        weights.push(w);
                        let a = arc(m, s - 0.5 * stride, origin(s - 0.5 * stride) + offset);
                        let b = arc(m, s + 0.5 * stride, origin(s + 0.5 * stride) + offset);
                        let (a, b) = (a.min(b) - 0.5 * dx, a.max(b) + 0.5 * dx);
                        range[m] = (
                            (((a - st.low) / st.step).ceil().max(0.0)) as u32,
                            (((b - st.low) / st.step).floor().max(0.0) as u32)
                                .min(st.count as u32 - 1),
                        );
                    }
                    cells.push(Cell {
                        gap: gap(s, x),
                        station: [stations[0].place(arcs[0]), stations[1].place(arcs[1])],
                        first,
                        range,
                    });
                    spots.push((j, c, [0, 1].map(|m| soft[m].weights(arcs[m]))));
                }
                if cells.len() > from {
                    slots.push(Slot {
                        s,
                        j,
                        from,
                        count: cells.len() - from,
                    });
                }
            }
            let n = cells.len();
            let plane: Vec<f64> = (0..2 * reach + 2)
                .map(|d| {
                    let f = |v: f64| if v == 0.0 { 0.0 } else { v * v.abs().ln() - v };
                    let d = d as f64;
                    2.0 * PLANE * (f((d + 0.5) * dx) - f((d - 0.5) * dx)) / youngs
                })
                .collect();
            let mut flexibility = vec![0.0; n * n];
            let mut shear = vec![0.0; if friction { n * n } else { 0 }];
            for a in 0..n {
                for b in 0..=a {
                    let (ja, ca, wa) = &spots[a];
                    let (jb, cb, wb) = &spots[b];
                    // Displacement at a's tooth under b's load; ahead is +1 on the pinion, -1 on the gear.
                    let t = (ja - jb) as isize;
                    let mut v = soft[0].at(t, &wa[0], &wb[0]) + soft[1].at(-t, &wa[1], &wb[1]);
                    v *= dx / youngs;
                    if t == 0 {
                        v += plane[(ca - cb).unsigned_abs() as usize];
                    }
                    flexibility[a * n + b] = v;
                    flexibility[b * n + a] = v;
                }
            }
            if friction {
                for a in 0..n {
                    for b in 0..n {
                        let ((ja, _, wa), (jb, _, wb)) = (&spots[a], &spots[b]);
                        let t = (ja - jb) as isize;
                        let both =
                            soft[0].aside(t, &wa[0], &wb[0]) + soft[1].aside(-t, &wa[1], &wb[1]);
                        shear[a * n + b] = both * dx / youngs;
                    }
                }
            }
            positions.push(Position {
                slots,
                cells,
                flexibility,
                shear,
            });
            deposits.push(weights);
        }
        Self {
            pair,
            cell: dx,
            stations,
            positions,
            deposits,
            e_star,
        }
    }

    /// Hertz: relative curvature radius, peak pressure and half width of a pair at s under w (N/mm).
    pub fn hertz(&self, s: f64, w: f64) -> (f64, f64, f64) {
        let s = s.clamp(self.pair.start, self.pair.end);
        let (a, b) = (self.pair.rho(0, s), self.pair.rho(1, s));
        let r = a * b / (a + b);
        let p0 = (w.max(0.0) * self.e_star / (std::f64::consts::PI * r)).sqrt();
        let half = (4.0 * w.max(0.0) * r / (std::f64::consts::PI * self.e_star)).sqrt();
        (r, p0, half)
    }
}
