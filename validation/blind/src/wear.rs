//! Archard wear of both flanks, fed back to the contact, in time.
//!
//! Short waves of a worn flank wear off in some hundred cycles while depth grows over a million: a stabilised explicit
//! Runge-Kutta-Chebyshev scheme of second order takes that stiffness without any Jacobian.

use std::sync::Arc;

use crate::contact::{self, Answer, Asked, Friction};
use crate::hidden::{Conditions, Hidden, Seen, Spot};
use crate::layout::{self, Layout};
use crate::passage::{Passage, Position};

pub struct Run {
    /// The passages of the layout's scenes, all with the first one's stations.
    pub passages: Vec<Arc<Passage>>,
    pub layout: Layout,
    pub conditions: Conditions,
    pub width: f64,
    /// mm^2/N
    pub k: f64,
    pub hidden: Arc<Vec<Box<dyn Hidden>>>,
    pub tolerance: f64,
}

/// Depths (mm, the stations of the pinion's flanks, then of the gear's) over cycles, with slopes.
#[derive(Clone, Default)]
pub struct History {
    pub cycles: Vec<f64>,
    pub depth: Vec<Vec<f64>>,
    pub slope: Vec<Vec<f64>>,
    pub evaluations: usize,
}

impl History {
    /// Depths at n cycles, cubic between stored states.
    pub fn at(&self, n: f64) -> Vec<f64> {
        let last = self.cycles.len() - 1;
        let i = self.cycles.partition_point(|&c| c < n).clamp(1, last);
        let (a, b) = (self.cycles[i - 1], self.cycles[i]);
        let h = b - a;
        let t = (n - a) / h;
        let (t2, t3) = (t * t, t * t * t);
        let w = [
            2.0 * t3 - 3.0 * t2 + 1.0,
            (t3 - 2.0 * t2 + t) * h,
            -2.0 * t3 + 3.0 * t2,
            (t3 - t2) * h,
        ];
        (0..self.depth[0].len())
            .map(|k| {
                w[0] * self.depth[i - 1][k]
                    + w[1] * self.slope[i - 1][k]
                    + w[2] * self.depth[i][k]
                    + w[3] * self.slope[i][k]
            })
            .collect()
    }
}

/// Working memory: contact cells of the last solution at every position.
#[derive(Clone, Default)]
pub struct Memory {
    /// Per scene, per position.
    active: Vec<Vec<Vec<bool>>>,
}

impl Run {
    pub fn line_load(&self) -> f64 {
        1e3 * self.conditions.torque / (self.width * self.passage().pair.pinion.rb)
    }

    /// The passage whose stations all of them have.
    pub fn passage(&self) -> &Passage {
        &self.passages[0]
    }

    /// Where a flank's stations start.
    pub fn offset(&self, member: usize, flank: usize) -> usize {
        let counts = [0, 1].map(|m| self.passage().stations[m].count);
        if member == 0 {
            flank * counts[0]
        } else {
            self.layout.share[0].len() * counts[0] + flank * counts[1]
        }
    }

    /// A flank's part of all depths.
    pub fn flank<'a>(&self, depth: &'a [f64], member: usize, flank: usize) -> &'a [f64] {
        let from = self.offset(member, flank);
        &depth[from..from + self.passage().stations[member].count]
    }

    /// Stations of all flanks.
    pub fn size(&self) -> usize {
        self.offset(1, self.layout.share[1].len())
    }

    pub fn profile(&self) -> Vec<f64> {
        let p = self.passage();
        let mut out = Vec::new();
        for m in 0..2 {
            let mut one = Vec::new();
            for k in 0..p.stations[m].count {
                let rho = p.pair.teeth(m).rho_of_arc(p.stations[m].arc(k));
                let um: f64 = self.hidden.iter().map(|e| e.profile(m, &p.pair, rho)).sum();
                one.push(um * 1e-3);
            }
            for _ in &self.layout.share[m] {
                out.extend(&one);
            }
        }
        out
    }

    /// Contact of a scene at position i with worn surfaces (depth plus profile, mm).
    pub fn contact(
        &self,
        scene: usize,
        i: usize,
        surface: &[f64],
        active: &mut Vec<bool>,
    ) -> Answer {
        let scene = &self.layout.scenes[scene];
        let p = &self.passages[scene.passage];
        let at = &p.positions[i];
        let gaps: Vec<Vec<f64>> = scene
            .slices
            .iter()
            .map(|slice| {
                let mut gaps = Vec::with_capacity(at.cells.len());
                for slot in &at.slots {
                    let q = layout::place(slot.j);
                    let from = [0, 1].map(|m| self.offset(m, slice.flank[m][q]));
                    for c in &at.cells[slot.from..slot.from + slot.count] {
                        let mut g = c.gap + slice.back[q];
                        for ((k, f), from) in c.station.into_iter().zip(from) {
                            let k = k as usize + from;
                            g += surface[k] + f64::from(f) * (surface[k + 1] - surface[k]);
                        }
                        gaps.push(g);
                    }
                }
                gaps
            })
            .collect();
        let theta = (i as f64 + 0.5) / p.positions.len() as f64;
        let mut load = self.line_load();
        let mut soft = 0.0;
        for e in self.hidden.iter() {
            load *= e.load(theta, &self.conditions, &p.pair);
            soft += 1e-3 * e.softness();
        }
        let friction = self.friction(p, at);
        let asked = Asked {
            at,
            gaps: &gaps,
            cell: p.cell,
            softness: soft,
            load,
            friction: friction.as_ref(),
        };
        contact::solve(&asked, active)
    }

    /// Statics about the pinion's centre: its base radius is the lever of the pressure, the distance from the line of action's foot to the contact that of the
    /// traction. In approach the faster gear draws the pinion's flank inward and on; in recess the pinion's flank is held back, outward.
    fn friction(&self, p: &Passage, at: &Position) -> Option<Friction> {
        let coefficient = |s: f64| self.hidden.iter().map(|e| e.friction(s)).sum::<f64>();
        if !self.hidden.iter().any(|e| e.has_friction()) {
            return None;
        }
        let traction: Vec<f64> = (at.slots.iter())
            .map(|slot| slot.s.signum() * coefficient(slot.s))
            .collect();
        let lever = (at.slots.iter().zip(&traction))
            .map(|(slot, t)| 1.0 + t * p.pair.rho(0, slot.s) / p.pair.pinion.rb)
            .collect();
        Some(Friction { traction, lever })
    }

    /// Wear per pinion cycle at every station, mm.
    pub fn rate(
        &self,
        cycles: f64,
        depth: &[f64],
        profile: &[f64],
        memory: &mut Memory,
    ) -> Vec<f64> {
        let surface: Vec<f64> = depth.iter().zip(profile).map(|(a, b)| a + b).collect();
        let spots = self.hidden.iter().any(|e| e.has_spot());
        let total = depth.len();
        let mut out = vec![0.0; total];
        let mut peak = vec![0.0f64; if spots { total } else { 0 }];
        memory.active.resize(self.layout.scenes.len(), Vec::new());
        for scene in 0..self.layout.scenes.len() {
            let active = &mut memory.active[scene];
            self.wear_in(scene, &surface, active, &mut out, &mut peak);
        }
        if spots {
            self.at_places(cycles, depth, &peak, &mut out);
        }
        out
    }

    /// Adds the wear of one scene per pinion cycle; and the largest pressures, if `peak` has room for them.
    fn wear_in(
        &self,
        scene: usize,
        surface: &[f64],
        active: &mut Vec<Vec<bool>>,
        out: &mut [f64],
        peak: &mut [f64],
    ) {
        let way = &self.layout.scenes[scene];
        let p = &self.passages[way.passage];
        let plain = !self.hidden.iter().any(|e| e.has_factor());
        let omega = self.conditions.speed * std::f64::consts::PI / 30.0;
        let ratio = p.pair.pinion.z as f64 / p.pair.gear.z as f64;
        let per = [self.k, self.k * ratio];
        let part = 1.0 / way.slices.len() as f64;
        active.resize(p.positions.len(), Vec::new());
        for (i, at) in p.positions.iter().enumerate() {
            let answer = self.contact(scene, i, surface, &mut active[i]);
            let slots = way.slices.iter().enumerate().flat_map(|(q, slice)| {
                let loads = &answer.loads[q * at.slots.len()..];
                (at.slots.iter().zip(loads)).map(move |(slot, &w)| (q, slice, slot, w))
            });
            for (q, slice, slot, w) in slots {
                if w <= 0.0 {
                    continue;
                }
                let j = layout::place(slot.j);
                let flank = [0, 1].map(|m| slice.flank[m][j]);
                let from = [0, 1].map(|m| self.offset(m, flank[m]));
                // How often a tooth (or slice) of this flank stands here while the pinion turns once.
                let often = [0, 1].map(|m| way.time * part / self.layout.share[m][flank[m]]);
                let (r, p0, half) = p.hertz(slot.s, w);
                let rho = [p.pair.rho(0, slot.s), p.pair.rho(1, slot.s)];
                let u = [omega * rho[0] * 1e-3, omega * ratio * rho[1] * 1e-3];
                for c in slot.from..slot.from + slot.count {
                    let pressure = answer.pressure[q * at.cells.len() + c];
                    if pressure <= 0.0 {
                        continue;
                    }
                    let cell = &at.cells[c];
                    for m in 0..2 {
                        let mut value = pressure * per[m] * often[m];
                        if !plain {
                            let seen = Seen {
                                s: slot.s,
                                load: w,
                                curvature: r,
                                p0,
                                half,
                                pressure,
                                u,
                                conditions: &self.conditions,
                                e_star: p.e_star,
                            };
                            for e in self.hidden.iter() {
                                value *= e.factor(&seen);
                            }
                        }
                        let base = from[m] + cell.first[m] as usize;
                        let weights = &p.deposits[i][2 * c + m];
                        for (o, wgt) in out[base..base + weights.len()].iter_mut().zip(weights) {
                            *o += value * f64::from(*wgt);
                        }
                        if !peak.is_empty() {
                            let (a, b) = cell.range[m];
                            for v in &mut peak[from[m] + a as usize..=from[m] + b.max(a) as usize] {
                                *v = v.max(pressure);
                            }
                        }
                    }
                }
            }
        }
    }

    /// What acts on places of the flanks: factors, and depth added.
    fn at_places(&self, cycles: f64, depth: &[f64], peak: &[f64], out: &mut [f64]) {
        let p = self.passage();
        let ratio = p.pair.pinion.z as f64 / p.pair.gear.z as f64;
        let worn = self.worn_area(depth);
        for m in 0..2 {
            let st = &p.stations[m];
            let t = p.pair.teeth(m);
            for from in (0..self.layout.share[m].len()).map(|f| self.offset(m, f)) {
                let smooth = |k: usize| {
                    let at = |d: isize| {
                        let q = (k as isize + d).clamp(0, st.count as isize - 1) as usize;
                        peak[from + q]
                    };
                    0.25 * at(-1) + 0.5 * at(0) + 0.25 * at(1)
                };
                for k in 0..st.count {
                    let rho = t.rho_of_arc(st.arc(k));
                    let s = if m == 0 {
                        rho - p.pair.c1
                    } else {
                        p.pair.c2 - rho
                    };
                    let spot = Spot {
                        member: m,
                        s,
                        start: p.pair.start,
                        depth: depth[from + k] * 1e3,
                        peak: smooth(k),
                        cycles,
                        contacts_per_cycle: if m == 0 { 1.0 } else { ratio },
                        worn: worn[0] + worn[1] / ratio,
                        conditions: &self.conditions,
                    };
                    for e in self.hidden.iter() {
                        out[from + k] *= e.local(&spot);
                    }
                    for e in self.hidden.iter() {
                        out[from + k] += 1e-3 * e.added(&spot);
                    }
                }
            }
        }
    }

    /// Worn area of the average tooth of each member, mm^2.
    pub fn worn_area(&self, depth: &[f64]) -> [f64; 2] {
        [0, 1].map(|m| {
            let st = &self.passage().stations[m];
            let flanks = self.layout.share[m].iter().enumerate();
            flanks
                .map(|(f, share)| {
                    let own = self.flank(depth, m, f);
                    share * (0..st.count).map(|k| own[k] * st.width(k)).sum::<f64>()
                })
                .sum()
        })
    }

    /// Mass lost by a member, mg (steel).
    pub fn mass(&self, depth: &[f64], member: usize) -> f64 {
        let z = self.passage().pair.teeth(member).z as f64;
        self.worn_area(depth)[member] * self.width * z * 7.85
    }

    /// Of the step's error: one where flanks are measured, a tenth where tip corners dig.
    fn weights(&self) -> Vec<f64> {
        let p = self.passage();
        let mut out = Vec::new();
        for m in 0..2 {
            let t = p.pair.teeth(m);
            let low = t.arc(
                p.pair
                    .rho(m, if m == 0 { p.pair.start } else { p.pair.end }),
            ) + 0.1 * t.m;
            let high = t.arc(t.rho(t.ra - 0.12 * t.m));
            for _ in &self.layout.share[m] {
                for k in 0..p.stations[m].count {
                    let inside = (low..high).contains(&p.stations[m].arc(k));
                    out.push(if inside { 1.0 } else { 0.1 });
                }
            }
        }
        out
    }

    pub fn run(&self, last: f64) -> History {
        let profile = self.profile();
        let size = self.size();
        let mut memory = Memory::default();
        let mut calls = 0;
        let mut f = |n: f64, y: &[f64], calls: &mut usize| {
            *calls += 1;
            self.rate(n, y, &profile, &mut memory)
        };
        let mut y = vec![0.0; size];
        let mut n = 0.0;
        let mut fy = f(n, &y, &mut calls);
        let mut history = History {
            cycles: vec![0.0],
            depth: vec![y.clone()],
            slope: vec![fy.clone()],
            evaluations: 0,
        };
        let rms = |v: &[f64]| (v.iter().map(|x| x * x).sum::<f64>() / v.len() as f64).sqrt();
        let top = |v: &[f64]| v.iter().fold(0.0f64, |a, b| a.max(b.abs()));
        // First step: a twentieth of a micrometre, or 1/200 of the run.
        let mut step = (5e-5 / top(&fy).max(1e-30))
            .min(last / 200.0)
            .max(last * 1e-5);
        let weight = self.weights();
        let mut wave: Vec<f64> = (0..size)
            .map(|k| if k % 2 == 0 { 1.0 } else { -1.0 } + 0.3 * (k as f64 * 0.37).sin())
            .collect();
        let mut radius = 0.0;
        let mut since = usize::MAX;
        while n < last * (1.0 - 1e-12) {
            if since > 10 {
                for _ in 0..if radius == 0.0 { 8 } else { 3 } {
                    let scale = 2e-5 / rms(&wave).max(1e-300);
                    let moved: Vec<f64> = y.iter().zip(&wave).map(|(a, b)| a + scale * b).collect();
                    let fm = f(n, &moved, &mut calls);
                    let change: Vec<f64> = fm.iter().zip(&fy).map(|(a, b)| a - b).collect();
                    radius = rms(&change) / 2e-5;
                    wave = change;
                }
                radius *= 1.25;
                since = 0;
            }
            step = step.min(last - n);
            let mut stages = 1 + (1.54 * step * radius + 1.0).sqrt() as usize;
            stages = stages.max(2);
            if stages > 60 {
                stages = 60;
                step = ((59.0f64 * 59.0) - 1.0) / 1.54 / radius;
            }
            let next = chebyshev(&mut |n, y| f(n, y, &mut calls), n, &y, &fy, step, stages);
            let fnext = f(n + step, &next, &mut calls);
            let error: Vec<f64> = (0..size)
                .map(|k| 0.8 * (y[k] - next[k]) + 0.4 * step * (fy[k] + fnext[k]))
                .collect();
            let allowed = self.tolerance * (top(&next) + 1e-4);
            let error: Vec<f64> = error.iter().zip(&weight).map(|(a, b)| a * b).collect();
            let e = rms(&error) / allowed;
            if e <= 1.0 {
                n += step;
                y = next;
                fy = fnext;
                history.cycles.push(n);
                history.depth.push(y.clone());
                history.slope.push(fy.clone());
                since += 1;
            } else {
                since = usize::MAX;
            }
            step *= (0.8 / e.max(1e-6).cbrt()).clamp(0.2, 3.0);
        }
        history.evaluations = calls;
        history
    }
}

/// One step of the second-order Runge-Kutta-Chebyshev scheme (Sommeijer, Shampine, Verwer 1998).
fn chebyshev(
    f: &mut dyn FnMut(f64, &[f64]) -> Vec<f64>,
    n: f64,
    y: &[f64],
    fy: &[f64],
    h: f64,
    s: usize,
) -> Vec<f64> {
    let w0 = 1.0 + 2.0 / 13.0 / (s * s) as f64;
    let (mut t, mut d, mut dd) = (vec![1.0, w0], vec![0.0, 1.0], vec![0.0, 0.0]);
    for j in 2..=s {
        t.push(2.0 * w0 * t[j - 1] - t[j - 2]);
        d.push(2.0 * t[j - 1] + 2.0 * w0 * d[j - 1] - d[j - 2]);
        dd.push(4.0 * d[j - 1] + 2.0 * w0 * dd[j - 1] - dd[j - 2]);
    }
    let w1 = d[s] / dd[s];
    let mut b: Vec<f64> = (0..=s)
        .map(|j| if j < 2 { 0.0 } else { dd[j] / (d[j] * d[j]) })
        .collect();
    b[0] = b[2];
    b[1] = b[2];
    let c = |j: usize| {
        if j == 1 {
            d[s] * dd[2] / (dd[s] * d[2]) / d[2]
        } else {
            d[s] * dd[j] / (dd[s] * d[j])
        }
    };
    let mut before = y.to_vec();
    let mut last: Vec<f64> = y
        .iter()
        .zip(fy)
        .map(|(a, b1)| a + b[1] * w1 * h * b1)
        .collect();
    for j in 2..=s {
        let mu = 2.0 * b[j] * w0 / b[j - 1];
        let nu = -b[j] / b[j - 2];
        let mut_ = 2.0 * b[j] * w1 / b[j - 1];
        let gam = -(1.0 - b[j - 1] * t[j - 1]) * mut_;
        let fl = f(n + c(j - 1) * h, &last);
        let new: Vec<f64> = (0..y.len())
            .map(|k| {
                (1.0 - mu - nu) * y[k]
                    + mu * last[k]
                    + nu * before[k]
                    + mut_ * h * fl[k]
                    + gam * h * fy[k]
            })
            .collect();
        before = last;
        last = new;
    }
    last
}
