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

/// Contact must not travel further between two positions than it is wide, nor over many stations: waves that no
/// position sees would grow. Narrowest at the ends of the path, where a pair carries about two fifths.
fn positions_per_pitch(pair: &Mating, e_star: f64, load: f64, dx: f64, least: usize) -> usize {
    let mut positions = least as f64;
    for s in [pair.start, pair.end] {
        let (a, b) = (pair.rho(0, s), pair.rho(1, s));
        let narrow = (4.0 * 0.4 * load * a * b / (a + b) / (std::f64::consts::PI * e_star)).sqrt();
        let way = (a / pair.pinion.rb).max(b / pair.gear.rb) * pair.pb;
        positions = positions.max(way / (0.6 * narrow).min(2.6 * dx));
    }
    (positions.ceil() as usize).min(320)
}

/// The frames of the pairs of a passage and the steps in which it is taken.
struct Frame<'a> {
    pair: &'a Mating,
    /// Size of a cell, mm.
    dx: f64,
    /// Way along the path between two positions, mm.
    stride: f64,
    /// Contact is followed so far beyond the ends of the path, mm.
    extension: f64,
    /// Arc of each member's tip corner.
    tip: [f64; 2],
}

impl<'a> Frame<'a> {
    fn new(pair: &'a Mating, dx: f64, positions: usize) -> Self {
        Self {
            pair,
            dx,
            stride: pair.pb / positions as f64,
            extension: 0.2 * pair.pb,
            tip: [0, 1].map(|m| pair.teeth(m).arc(pair.teeth(m).rho_tip())),
        }
    }

    fn stations(&self) -> [Stations; 2] {
        [0, 1].map(|m| {
            let t = self.pair.teeth(m);
            let deepest = if m == 0 {
                self.pair.rho(0, self.pair.start - self.extension)
            } else {
                self.pair.rho(1, self.pair.end + self.extension)
            };
            let low = t.arc(deepest.max(t.rho(t.form_radius())).max(0.02 * t.m));
            let high = t.arc(t.rho_tip());
            let n = ((high - low) / self.dx).ceil() as usize + 1;
            Stations {
                low,
                step: (high - low) / (n - 1) as f64,
                count: n,
            }
        })
    }

    /// Arc coordinate of a member's flank at path s, offset x along e.
    fn arc(&self, m: usize, s: f64, x: f64) -> f64 {
        let rho = self.pair.rho(m, s);
        let sign = if m == 0 { 1.0 } else { -1.0 };
        self.pair.teeth(m).arc(rho.abs()) * rho.signum() + sign * x
    }

    /// Offset of the frame's cells: at the corner when the path of contact has not begun or has ended.
    fn origin(&self, s: f64) -> f64 {
        if s < self.pair.start {
            self.arc(1, s, 0.0) - self.tip[1]
        } else if s > self.pair.end {
            self.tip[0] - self.arc(0, s, 0.0)
        } else {
            0.0
        }
    }

    fn gap(&self, s: f64, x: f64) -> f64 {
        let side = |m: usize| {
            let t = self.pair.teeth(m);
            let rho0 = self.pair.rho(m, s);
            let rho = t.rho_of_arc(self.arc(m, s, x));
            let phi = (rho - rho0) / t.rb;
            rho0 + t.rb * phi.sin() - rho * phi.cos()
        };
        side(0) + side(1)
    }

    /// Where a cell's pressure wears a flank while contact travels to the next position: first station and depths per pressure.
    fn deposit(&self, m: usize, st: &Stations, s: f64, offset: f64) -> (u32, [f32; SPAN]) {
        let (dx, stride) = (self.dx, self.stride);
        let rate = 1.0 / self.pair.pinion.rb + 1.0 / self.pair.gear.rb;
        let mut touched = Vec::new();
        for q in 0..8 {
            let tau = (q as f64 - 3.5) / 4.0;
            let sq = s + tau * stride;
            let time = (1.0 - tau.abs()) / 4.0;
            for sub in [-1.0, 0.0, 1.0] {
                let at = self.arc(m, sq, self.origin(sq) + offset + sub * dx / 3.0);
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
        (low as u32, w)
    }

    /// Stations that a cell passes over from half a stride before to half a stride after.
    fn range(&self, m: usize, st: &Stations, s: f64, offset: f64) -> (u32, u32) {
        let half = 0.5 * self.stride;
        let a = self.arc(m, s - half, self.origin(s - half) + offset);
        let b = self.arc(m, s + half, self.origin(s + half) + offset);
        let (a, b) = (a.min(b) - 0.5 * self.dx, a.max(b) + 0.5 * self.dx);
        (
            (((a - st.low) / st.step).ceil().max(0.0)) as u32,
            (((b - st.low) / st.step).floor().max(0.0) as u32).min(st.count as u32 - 1),
        )
    }
}

/// What the elastic coupling of a cell depends on: its pair, its place in the frame, its place on both flanks.
type Spot = (i64, i64, [(usize, [f64; 4]); 2]);

/// Elastic coupling of the cells of a position.
struct Coupling<'a> {
    soft: &'a [FlankCompliance; 2],
    youngs: f64,
    dx: f64,
    /// Half plane's displacement under a cell, by cells between.
    plane: Vec<f64>,
}

impl<'a> Coupling<'a> {
    fn new(soft: &'a [FlankCompliance; 2], youngs: f64, dx: f64, reach: i64) -> Self {
        let plane = (0..2 * reach + 2)
            .map(|d| {
                let f = |v: f64| if v == 0.0 { 0.0 } else { v * v.abs().ln() - v };
                let d = d as f64;
                2.0 * PLANE * (f((d + 0.5) * dx) - f((d - 0.5) * dx)) / youngs
            })
            .collect();
        Self {
            soft,
            youngs,
            dx,
            plane,
        }
    }

    /// Under pressure.
    fn flexibility(&self, spots: &[Spot]) -> Vec<f64> {
        let n = spots.len();
        let mut out = vec![0.0; n * n];
        for a in 0..n {
            for b in 0..=a {
                let ((ja, ca, wa), (jb, cb, wb)) = (&spots[a], &spots[b]);
                // Displacement at a's tooth under b's load; ahead is +1 on the pinion, -1 on the gear.
                let t = (ja - jb) as isize;
                let mut v =
                    self.soft[0].at(t, &wa[0], &wb[0]) + self.soft[1].at(-t, &wa[1], &wb[1]);
                v *= self.dx / self.youngs;
                if t == 0 {
                    v += self.plane[(ca - cb).unsigned_abs() as usize];
                }
                out[a * n + b] = v;
                out[b * n + a] = v;
            }
        }
        out
    }

    /// Under traction.
    fn shear(&self, spots: &[Spot]) -> Vec<f64> {
        let pairs = spots.iter().flat_map(|a| spots.iter().map(move |b| (a, b)));
        pairs
            .map(|((ja, _, wa), (jb, _, wb))| {
                let t = (ja - jb) as isize;
                let pinion = self.soft[0].aside(t, &wa[0], &wb[0]);
                let gear = self.soft[1].aside(-t, &wa[1], &wb[1]);
                (pinion + gear) * self.dx / self.youngs
            })
            .collect()
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
        let count = positions_per_pitch(&pair, e_star, load, dx, fine.positions);
        let frame = Frame::new(&pair, dx, count);
        let stations = shared.cloned().unwrap_or_else(|| frame.stations());
        let coupling = Coupling::new(soft, youngs, dx, reach);
        // Deflection of a pair, generously: 8 N/(mm um) for steel, scaled with E.
        let give = load / (8.0e3 * youngs / 2.1e5);
        let mut positions = Vec::new();
        let mut deposits = Vec::new();
        for i in 0..count {
            let theta = (i as f64 + 0.5) / count as f64;
            let (mut slots, mut cells) = (Vec::new(), Vec::new());
            let (mut weights, mut spots) = (Vec::new(), Vec::new());
            for j in PLACES {
                let s = (theta + j as f64) * pair.pb;
                let beyond = s < pair.start - frame.extension || s > pair.end + frame.extension;
                if beyond || frame.gap(s, frame.origin(s)) > 4.0 * give {
                    continue;
                }
                let from = cells.len();
                for c in -reach..reach {
                    let offset = (c as f64 + 0.5) * dx;
                    let x = frame.origin(s) + offset;
                    let arcs = [0, 1].map(|m| frame.arc(m, s, x));
                    if (0..2).any(|m| arcs[m] > frame.tip[m] + 1e-9 || arcs[m] <= stations[m].low) {
                        continue;
                    }
                    let both = [0, 1].map(|m| frame.deposit(m, &stations[m], s, offset));
                    weights.extend(both.map(|b| b.1));
                    cells.push(Cell {
                        gap: frame.gap(s, x),
                        station: [0, 1].map(|m| stations[m].place(arcs[m])),
                        first: both.map(|b| b.0),
                        range: [0, 1].map(|m| frame.range(m, &stations[m], s, offset)),
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
            positions.push(Position {
                slots,
                cells,
                flexibility: coupling.flexibility(&spots),
                shear: if friction {
                    coupling.shear(&spots)
                } else {
                    Vec::new()
                },
            });
            deposits.push(weights);
        }
        Self {
            cell: dx,
            stations,
            positions,
            deposits,
            e_star,
            pair,
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
