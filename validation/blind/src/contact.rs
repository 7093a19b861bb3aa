//! Contact of all tooth pairs at one position: pressures >= 0, one common turn, given torque.
//!
//! The face may be cut in slices that share nothing but the turn, and friction may act: the flanks slip everywhere, so the
//! traction is the coefficient times the pressure, it adds to the moment about the pinion's centre and it bends the teeth.

use crate::banded::dot;
use crate::passage::Position;

#[derive(Clone, Default)]
pub struct Answer {
    /// Pressure per cell, MPa; slice after slice.
    pub pressure: Vec<f64>,
    /// Line load per slot, N/mm; slice after slice.
    pub loads: Vec<f64>,
    /// Turn of the pinion against the held gear, mm along the line of action.
    pub approach: f64,
}

/// Friction at one position.
pub struct Friction {
    /// Per slot: traction over pressure, positive outward on both flanks.
    pub traction: Vec<f64>,
    /// Per slot: moment of pressure and traction about the pinion's centre over that of the pressure.
    pub lever: Vec<f64>,
}

/// What is asked of one position.
pub struct Asked<'a> {
    pub at: &'a Position,
    /// Per slice, per cell: gap with wear and profile, mm.
    pub gaps: &'a [Vec<f64>],
    /// Size of a cell, mm.
    pub cell: f64,
    /// Extra compliance of each pair, mm^2/N.
    pub softness: f64,
    /// Torque over base radius and face width, N/mm.
    pub load: f64,
    pub friction: Option<&'a Friction>,
}

/// A slice's pressures as a straight function of the turn: p = turn * by_turn - by_gap, the last rows of the solution still to be put in.
struct Straight {
    list: Vec<usize>,
    by_turn: Vec<f64>,
    by_gap: Vec<f64>,
    /// Sum of both, each cell weighed by its moment.
    sum_turn: f64,
    sum_gap: f64,
    /// Cholesky's factor, row-major, where back substitution is left to do.
    factor: Vec<f64>,
}

impl Straight {
    fn pressures(&self, turn: f64) -> Vec<f64> {
        let both = self.by_turn.iter().zip(&self.by_gap);
        let mut x: Vec<f64> = both.map(|(a, b)| turn * a - b).collect();
        if self.factor.is_empty() {
            return x;
        }
        let m = x.len();
        for r in (0..m).rev() {
            x[r] /= self.factor[r * m + r];
            let v = x[r];
            let row = &self.factor[r * m..r * m + r];
            for (t, l) in x[..r].iter_mut().zip(row) {
                *t -= l * v;
            }
        }
        x
    }
}

/// `active` holds the last answer's contact cells, slice after slice, and is replaced.
pub fn solve(asked: &Asked, active: &mut Vec<bool>) -> Answer {
    let (at, gaps) = (asked.at, asked.gaps);
    let (n, slices) = (at.cells.len(), gaps.len());
    let share = 1.0 / slices as f64;
    if active.len() != n * slices || !active.contains(&true) {
        // Start with what a rigid approach of the Hertz order would touch.
        let least = gaps.iter().flatten().copied().fold(f64::MAX, f64::min);
        *active = gaps.iter().flatten().map(|g| *g < least + 1e-3).collect();
    }
    let mut slot_of = vec![0usize; n];
    for (k, s) in at.slots.iter().enumerate() {
        slot_of[s.from..s.from + s.count].fill(k);
    }
    let extra = asked.softness * asked.cell;
    let mut pressure = vec![0.0; n * slices];
    let mut rounds = 0;
    let approach = loop {
        rounds += 1;
        let parts: Vec<Straight> = (0..slices)
            .map(|q| {
                let list: Vec<usize> = (0..n).filter(|&i| active[q * n + i]).collect();
                match asked.friction {
                    None => symmetric(at, &gaps[q], &slot_of, extra, list),
                    Some(f) => slipping(at, &gaps[q], &slot_of, extra, list, f),
                }
            })
            .collect();
        let (mut ones, mut cross) = (0.0, 0.0);
        for p in &parts {
            ones += share * p.sum_turn;
            cross += share * p.sum_gap;
        }
        let approach = (asked.load / asked.cell + cross) / ones;
        pressure.fill(0.0);
        let mut slot_load = vec![0.0; at.slots.len() * slices];
        for (q, p) in parts.iter().enumerate() {
            for (&i, v) in p.list.iter().zip(p.pressures(approach)) {
                pressure[q * n + i] = v;
                slot_load[q * at.slots.len() + slot_of[i]] += v;
            }
        }
        let peak = pressure.iter().copied().fold(0.0, f64::max);
        let mut changed = false;
        let careful = rounds > 25;
        let mut worst: (f64, usize) = (0.0, usize::MAX);
        let mut next = active.clone();
        for q in 0..slices {
            for i in 0..n {
                let own = q * n + i;
                if active[own] {
                    if pressure[own] < -1e-9 * peak {
                        next[own] = false;
                        changed = true;
                        if -pressure[own] / peak > worst.0 {
                            worst = (-pressure[own] / peak, own);
                        }
                    }
                } else {
                    let row = &at.flexibility[i * n..(i + 1) * n];
                    let pair = slot_load[q * at.slots.len() + slot_of[i]];
                    let mut u = gaps[q][i] - approach + extra * pair;
                    for &j in &parts[q].list {
                        u += row[j] * pressure[q * n + j];
                    }
                    if let Some(f) = asked.friction {
                        let row = &at.shear[i * n..(i + 1) * n];
                        for &j in &parts[q].list {
                            u += row[j] * f.traction[slot_of[j]] * pressure[q * n + j];
                        }
                    }
                    if u < -1e-9 {
                        next[own] = true;
                        changed = true;
                        if -u / 1e-3 > worst.0 {
                            worst = (-u / 1e-3, own);
                        }
                    }
                }
            }
        }
        if !changed || rounds > 80 {
            break approach;
        }
        if careful {
            active[worst.1] = !active[worst.1];
        } else {
            *active = next;
        }
    };
    let loads = (0..slices)
        .flat_map(|q| {
            at.slots
                .iter()
                .map(move |s| q * n + s.from..q * n + s.from + s.count)
        })
        .map(|cells| pressure[cells].iter().map(|p| p.max(0.0)).sum::<f64>() * asked.cell)
        .collect();
    Answer {
        pressure,
        loads,
        approach,
    }
}

/// By Cholesky; every cell counts alike in the moment.
fn symmetric(
    at: &Position,
    gaps: &[f64],
    slot_of: &[usize],
    extra: f64,
    list: Vec<usize>,
) -> Straight {
    let (n, m) = (gaps.len(), list.len());
    let mut matrix = vec![0.0; m * m];
    let (mut y, mut z) = (vec![0.0; m], vec![0.0; m]);
    for (r, &i) in list.iter().enumerate() {
        let row = &at.flexibility[i * n..(i + 1) * n];
        let (done, rest) = matrix.split_at_mut(r * m);
        let out = &mut rest[..=r];
        for (c, &j) in list[..=r].iter().enumerate() {
            out[c] = row[j] + if slot_of[i] == slot_of[j] { extra } else { 0.0 };
        }
        for c in 0..r {
            let other = &done[c * m..=c * m + c];
            out[c] = (out[c] - dot(&out[..c], &other[..c])) / other[c];
        }
        out[r] = (out[r] - dot(&out[..r], &out[..r])).sqrt();
        // Forward substitution on the way.
        y[r] = (1.0 - dot(&out[..r], &y[..r])) / out[r];
        z[r] = (gaps[i] - dot(&out[..r], &z[..r])) / out[r];
    }
    // Sums of p by the half-solved vectors.
    let (sum_turn, sum_gap) = (dot(&y, &y), dot(&y, &z));
    Straight {
        list,
        by_turn: y,
        by_gap: z,
        sum_turn,
        sum_gap,
        factor: matrix,
    }
}

/// By elimination: traction makes the matrix lopsided. Its symmetric part outweighs the rest, so no rows change places.
fn slipping(
    at: &Position,
    gaps: &[f64],
    slot_of: &[usize],
    extra: f64,
    list: Vec<usize>,
    friction: &Friction,
) -> Straight {
    let (n, m) = (gaps.len(), list.len());
    let wide = m + 2;
    let mut a = vec![0.0; m * wide];
    for (r, &i) in list.iter().enumerate() {
        for (c, &j) in list.iter().enumerate() {
            let same = if slot_of[i] == slot_of[j] { extra } else { 0.0 };
            let by_traction = at.shear[i * n + j] * friction.traction[slot_of[j]];
            a[r * wide + c] = at.flexibility[i * n + j] + same + by_traction;
        }
        a[r * wide + m] = 1.0;
        a[r * wide + m + 1] = gaps[i];
    }
    for c in 0..m {
        let (above, below) = a.split_at_mut((c + 1) * wide);
        let pivot = &above[c * wide..];
        for row in below.chunks_exact_mut(wide) {
            let f = row[c] / pivot[c];
            for k in c + 1..wide {
                row[k] -= f * pivot[k];
            }
        }
    }
    let (mut x, mut g) = (vec![0.0; m], vec![0.0; m]);
    for r in (0..m).rev() {
        let row = &a[r * wide..(r + 1) * wide];
        x[r] = (row[m] - dot(&row[r + 1..m], &x[r + 1..])) / row[r];
        g[r] = (row[m + 1] - dot(&row[r + 1..m], &g[r + 1..])) / row[r];
    }
    let moment = |v: &[f64]| -> f64 {
        let each = list.iter().zip(v);
        each.map(|(&i, p)| friction.lever[slot_of[i]] * p).sum()
    };
    let (sum_turn, sum_gap) = (moment(&x), moment(&g));
    Straight {
        list,
        by_turn: x,
        by_gap: g,
        sum_turn,
        sum_gap,
        factor: Vec::new(),
    }
}
