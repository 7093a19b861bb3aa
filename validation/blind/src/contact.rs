//! Frictionless contact of all tooth pairs at one position: pressures >= 0, one approach, given load.

use crate::banded::dot;
use crate::passage::Position;

#[derive(Clone, Default)]
pub struct Answer {
    /// Pressure per cell, MPa.
    pub pressure: Vec<f64>,
    /// Line load per slot, N/mm.
    pub loads: Vec<f64>,
}

/// `gaps`: per cell with wear and profile; `softness`: extra compliance of each pair, mm^2/N; `load` N/mm in all.
/// `active` holds the last answer's contact cells and is replaced.
pub fn solve(
    at: &Position,
    gaps: &[f64],
    cell: f64,
    softness: f64,
    load: f64,
    active: &mut Vec<bool>,
) -> Answer {
    let n = gaps.len();
    if active.len() != n || !active.contains(&true) {
        *active = vec![false; n];
        // Start with what a rigid approach of the Hertz order would touch.
        let least = gaps.iter().copied().fold(f64::MAX, f64::min);
        for (a, g) in active.iter_mut().zip(gaps) {
            *a = *g < least + 1e-3;
        }
    }
    let mut slot_of = vec![0u32; n];
    for (k, s) in at.slots.iter().enumerate() {
        for v in &mut slot_of[s.from..s.from + s.count] {
            *v = k as u32;
        }
    }
    let extra = softness * cell;
    let mut matrix: Vec<f64> = Vec::new();
    let mut pressure = vec![0.0; n];
    let mut rounds = 0;
    loop {
        rounds += 1;
        let list: Vec<usize> = (0..n).filter(|&i| active[i]).collect();
        let m = list.len();
        matrix.clear();
        matrix.resize(m * m, 0.0);
        let mut y = vec![0.0; m];
        let mut z = vec![0.0; m];
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
        // Sum of p = approach * sum(A^-1 1) - sum(A^-1 g), by the half-solved vectors.
        let ones = dot(&y, &y);
        let cross = dot(&y, &z);
        let approach = (load / cell + cross) / ones;
        let mut x: Vec<f64> = y.iter().zip(&z).map(|(a, b)| approach * a - b).collect();
        for r in (0..m).rev() {
            x[r] /= matrix[r * m + r];
            let v = x[r];
            let row = &matrix[r * m..r * m + r];
            for (t, l) in x[..r].iter_mut().zip(row) {
                *t -= l * v;
            }
        }
        pressure.iter_mut().for_each(|p| *p = 0.0);
        for (&i, &p) in list.iter().zip(&x) {
            pressure[i] = p;
        }
        let mut slot_load = vec![0.0; at.slots.len()];
        for (&i, &p) in list.iter().zip(&x) {
            slot_load[slot_of[i] as usize] += p;
        }
        let mut changed = false;
        let careful = rounds > 25;
        let mut worst: (f64, usize) = (0.0, usize::MAX);
        let peak = x.iter().copied().fold(0.0, f64::max);
        let mut next = active.clone();
        for i in 0..n {
            if active[i] {
                if pressure[i] < -1e-9 * peak {
                    next[i] = false;
                    changed = true;
                    if -pressure[i] / peak > worst.0 {
                        worst = (-pressure[i] / peak, i);
                    }
                }
            } else {
                let row = &at.flexibility[i * n..(i + 1) * n];
                let mut u = gaps[i] - approach + extra * slot_load[slot_of[i] as usize];
                for (&j, &p) in list.iter().zip(&x) {
                    u += row[j] * p;
                }
                if u < -1e-9 {
                    next[i] = true;
                    changed = true;
                    if -u / 1e-3 > worst.0 {
                        worst = (-u / 1e-3, i);
                    }
                }
            }
        }
        if !changed || rounds > 80 {
            break;
        }
        if careful {
            active[worst.1] = !active[worst.1];
        } else {
            *active = next;
        }
    }
    let loads = at
        .slots
        .iter()
        .map(|s| {
            pressure[s.from..s.from + s.count]
                .iter()
                .map(|p| p.max(0.0))
                .sum::<f64>()
                * cell
        })
        .collect();
    Answer { pressure, loads }
}
