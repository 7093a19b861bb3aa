//! Elastic compliance of a whole gear from one meshed sector.
//!
//! A sector (one tooth, the body under it down to the rigid bore) is meshed with nine-node quadrilaterals in plane strain,
//! condensed onto its two radial cuts, and closed to a ring of z equal sectors by Fourier series along the ring. From the
//! mean displacement of pressure tents on the flank the half plane's own answer is taken away; what is left is smooth and
//! is interpolated, so that contact can be solved on any finer grid with the half plane's kernel.

use std::f64::consts::PI;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::banded::{Skyline, dot};
use crate::involute::Tooth;

pub const NU: f64 = 0.3;
/// Neighbours on either side whose coupling is kept.
pub const REACH: isize = 2;

/// Smooth part of the flank compliance for E = 1 MPa, mm per N/mm.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct FlankCompliance {
    /// Arc coordinates of the stations, rising outward.
    pub arcs: Vec<f64>,
    /// smooth[t + REACH][i * n + j]: displacement at station i of tooth t for a unit load at station j of tooth 0.
    pub smooth: Vec<Vec<f64>>,
    /// The same under a tangential unit load, outward; without the half plane's own step, which two bodies of one material take from each other.
    pub sideways: Vec<Vec<f64>>,
}

/// How fine: 1 = default; 2 halves every element.
pub fn compliance(tooth: &Tooth, fine: usize) -> FlankCompliance {
    let mesh = Sector::new(tooth, fine);
    mesh.solve(tooth)
}

struct Sector {
    xy: Vec<[f64; 2]>,
    quads: Vec<[usize; 9]>,
    /// Right flank: node triples (corner, middle, corner) with arcs of their ends, from the tip inward.
    flank: Vec<([usize; 3], f64, f64)>,
    stations: Vec<f64>,
    left: Vec<usize>,
    right: Vec<usize>,
    bore: Vec<bool>,
}

fn refine(marks: &[f64], fine: usize) -> Vec<f64> {
    // Element ends -> node coordinates (ends and middles), each element cut in `fine`.
    let mut out = vec![marks[0]];
    for w in marks.windows(2) {
        let n = 2 * fine;
        for k in 1..=n {
            out.push(w[0] + (w[1] - w[0]) * k as f64 / n as f64);
        }
    }
    out
}

impl Sector {
    fn new(tooth: &Tooth, fine: usize) -> Self {
        let m = tooth.m;
        let z = tooth.z as f64;
        // Rows along the right profile: arcs from the tip inward, then fillet parameters.
        let tip = tooth.arc(tooth.rho_tip());
        let form = tooth.arc(tooth.rho(tooth.form_radius()));
        let big = 0.045 * m;
        let mut depths = vec![0.0];
        let mut size = 0.006 * m;
        while size < big {
            depths.push(depths[depths.len() - 1] + size);
            size *= 1.5;
        }
        let graded = depths.len() - 1;
        let from = depths[graded];
        let pairs = (((tip - form - from) / (2.0 * big)).ceil() as usize).max(2);
        for k in 1..=2 * pairs {
            depths.push(from + (tip - form - from) * k as f64 / (2 * pairs) as f64);
        }
        let stations: Vec<f64> = (0..depths.len())
            .filter(|&k| k <= graded || (k - graded) % 2 == 0)
            .map(|k| tip - depths[k])
            .rev()
            .collect();
        let split = 0.45;
        let fillet_rows = 7;
        let flank_nodes = refine(&depths, fine);
        let mut profile: Vec<(f64, f64)> = flank_nodes
            .iter()
            .map(|d| {
                let rad = tooth.radius(tooth.rho_of_arc(tip - d));
                (rad, tooth.half_angle(rad))
            })
            .collect();
        let polar = |p: [f64; 2]| (p[0].hypot(p[1]), p[0].atan2(p[1]));
        let marks: Vec<f64> = (0..=fillet_rows)
            .map(|k| 1.0 + (split - 1.0) * (k as f64 / fillet_rows as f64).powf(0.9))
            .collect();
        profile.extend(
            refine(&marks, fine)
                .iter()
                .skip(1)
                .map(|&t| polar(tooth.fillet(t))),
        );
        // Columns across the tooth: fractions of the half angle, from +1 (right flank) to -1.
        let mut sizes = Vec::new();
        let mut h: f64 = 0.03;
        let mut sum = 0.0;
        while sum < 1.8 {
            sizes.push(h);
            sum += h;
            h = (h * 1.4).min(0.25);
        }
        let mut across = vec![1.0];
        let mut at = 0.0;
        for s in &sizes {
            at += s;
            across.push(1.0 - 2.0 * at / sum);
        }
        let across = refine(&across, fine);
        let cols = across.len();
        let mut xy = Vec::new();
        for &(rad, ang) in &profile {
            for &s in &across {
                xy.push(Tooth::polar(rad, s * ang));
            }
        }
        let rows = profile.len();
        let mut quads = Vec::new();
        let grid = |base: usize, cols: usize, i: usize, j: usize| base + i * cols + j;
        for i in (0..rows - 1).step_by(2) {
            for j in (0..cols - 1).step_by(2) {
                quads.push(nine(|a, b| grid(0, cols, i + a, j + b)));
            }
        }
        let mut flank = Vec::new();
        for e in 0..(flank_nodes.len() - 1) / 2 {
            let n = [0, 1, 2].map(|k| grid(0, cols, 2 * e + k, 0));
            flank.push((n, tip - flank_nodes[2 * e], tip - flank_nodes[2 * e + 2]));
        }
        // Body: top boundary from the right cut to the left one.
        let land: Vec<f64> = refine(&[PI / z, tooth.land_angle()], fine);
        let marks: Vec<f64> = (0..=5).map(|k| split * k as f64 / 5.0).collect();
        let mut top: Vec<(f64, f64)> = land.iter().map(|&a| (tooth.rf, a)).collect();
        top.extend(
            refine(&marks, fine)
                .iter()
                .skip(1)
                .map(|&t| polar(tooth.fillet(t))),
        );
        let side = top.len() - 1; // index of the chord's first node
        let (rad, ang) = profile[rows - 1];
        top.extend(across.iter().skip(1).map(|s| (rad, s * ang)));
        let mirrored: Vec<(f64, f64)> = top[..side].iter().rev().map(|&(r, a)| (r, -a)).collect();
        top.extend(mirrored);
        let bcols = top.len();
        let mut marks = vec![0.0];
        let mut h = 0.12 * m;
        let total = tooth.rf - tooth.bore;
        while marks[marks.len() - 1] + 1.2 * h < total {
            marks.push(marks[marks.len() - 1] + h);
            h = (h * 1.4).min(0.15 * tooth.rf);
        }
        marks.push(total);
        let depth = refine(&marks, fine);
        let chord = (rows - 1) * cols;
        let base = xy.len();
        // The chord's nodes exist; they keep their numbers. Others of body row 0 come first.
        let mut number = vec![vec![0usize; bcols]; depth.len()];
        let mut next = base;
        for (i, d) in depth.iter().enumerate() {
            for (j, &(rad, ang)) in top.iter().enumerate() {
                if i == 0 && (side..side + cols).contains(&j) {
                    number[i][j] = chord + j - side;
                } else {
                    number[i][j] = next;
                    next += 1;
                    let bottom = tooth.bore;
                    xy.push(Tooth::polar(rad + (bottom - rad) * d / total, ang));
                }
            }
        }
        for i in (0..depth.len() - 1).step_by(2) {
            for j in (0..bcols - 1).step_by(2) {
                quads.push(nine(|a, b| number[i + a][j + b]));
            }
        }
        let last = depth.len() - 1;
        let mut bore = vec![false; xy.len()];
        for &n in &number[last] {
            bore[n] = true;
        }
        let right = (0..last).map(|i| number[i][0]).collect();
        let left = (0..last).map(|i| number[i][bcols - 1]).collect();
        Self {
            xy,
            quads,
            flank,
            stations,
            left,
            right,
            bore,
        }
    }

    fn solve(&self, tooth: &Tooth) -> FlankCompliance {
        let n = self.xy.len();
        let cut = self.left.len();
        let nb = 4 * cut;
        // Unknown numbers: interior in order; cuts apart (left then right; radial, tangential).
        const FIXED: usize = usize::MAX;
        let mut place = vec![FIXED; n];
        let mut on_cut = vec![None; n];
        for (k, &node) in self.left.iter().enumerate() {
            on_cut[node] = Some((2 * k, -PI / tooth.z as f64));
        }
        for (k, &node) in self.right.iter().enumerate() {
            on_cut[node] = Some((2 * (cut + k), PI / tooth.z as f64));
        }
        let mut inner = 0;
        for node in 0..n {
            if !self.bore[node] && on_cut[node].is_none() {
                place[node] = inner;
                inner += 2;
            }
        }
        let mut first: Vec<usize> = (0..inner).collect();
        for q in &self.quads {
            let low = q.iter().map(|&v| place[v]).filter(|&p| p != FIXED).min();
            if let Some(low) = low {
                for &v in q {
                    if place[v] != FIXED {
                        for d in 0..2 {
                            let row = place[v] + d;
                            first[row] = first[row].min(low);
                        }
                    }
                }
            }
        }
        let mut a = Skyline::new(first);
        let mut to_cut = vec![vec![0.0; inner]; nb];
        let mut kbb = vec![0.0; nb * nb];
        for q in &self.quads {
            let ke = stiffness(&q.map(|v| self.xy[v]));
            // Rows of the element in the unknowns' own directions: list of (kind, index, weights on x, y).
            let unknowns: Vec<(bool, usize, [f64; 2], usize)> = (0..9)
                .flat_map(|l| {
                    let node = q[l];
                    let mut list = Vec::new();
                    if self.bore[node] {
                        return list;
                    }
                    if let Some((b, angle)) = on_cut[node] {
                        let (s, c) = angle.sin_cos();
                        list.push((true, b, [s, c], l));
                        list.push((true, b + 1, [c, -s], l));
                    } else {
                        list.push((false, place[node], [1.0, 0.0], l));
                        list.push((false, place[node] + 1, [0.0, 1.0], l));
                    }
                    list
                })
                .collect();
            for &(cut_i, i, wi, li) in &unknowns {
                for &(cut_j, j, wj, lj) in &unknowns {
                    let mut v = 0.0;
                    for a in 0..2 {
                        for b in 0..2 {
                            v += wi[a] * wj[b] * ke[(2 * li + a) * 18 + 2 * lj + b];
                        }
                    }
                    match (cut_i, cut_j) {
                        (false, false) if j <= i => a.add(i, j, v),
                        (false, true) => to_cut[j][i] += v,
                        (true, true) => kbb[i * nb + j] += v,
                        _ => {}
                    }
                }
            }
        }
        a.factor();
        let tents = |outward: bool| -> Vec<Vec<f64>> {
            let all = 0..self.stations.len();
            all.map(|k| self.tent(k, outward, &place, inner)).collect()
        };
        let (mut loads, mut pulls) = (tents(false), tents(true));
        (loads.par_iter_mut())
            .chain(pulls.par_iter_mut())
            .chain(to_cut.par_iter_mut())
            .for_each(|v| a.forward(v));
        let m = loads.len();
        let mut s = kbb;
        for i in 0..nb {
            for j in 0..=i {
                let v = dot(&to_cut[i], &to_cut[j]);
                s[i * nb + j] -= v;
                if i != j {
                    s[j * nb + i] -= v;
                }
            }
        }
        let seen_by_cuts = |loads: &[Vec<f64>]| -> Vec<Vec<f64>> {
            let at_cuts = |p: &Vec<f64>| to_cut.iter().map(|k| -dot(p, k)).collect();
            loads.iter().map(at_cuts).collect()
        };
        let b = seen_by_cuts(&loads);
        // Ring.
        let half = 2 * cut;
        let z = tooth.z;
        let span = (2 * REACH + 2) as usize; // cuts -REACH ..= REACH + 1
        let waves: Vec<Vec<f64>> = (0..=z / 2)
            .into_par_iter()
            .map(|k| {
                let theta = 2.0 * PI * k as f64 / z as f64;
                let (sn, cs) = theta.sin_cos();
                let mut lhs = vec![(0.0, 0.0); half * half];
                for i in 0..half {
                    for j in 0..half {
                        let ll = s[i * nb + j];
                        let rr = s[(half + i) * nb + half + j];
                        let lr = s[i * nb + half + j];
                        let rl = s[(half + i) * nb + j];
                        lhs[i * half + j] = (ll + rr + (lr + rl) * cs, (lr - rl) * sn);
                    }
                }
                let mut rhs = vec![(0.0, 0.0); half * m];
                for (c, row) in b.iter().enumerate() {
                    for i in 0..half {
                        rhs[i * m + c] = (row[i] + cs * row[half + i], -sn * row[half + i]);
                    }
                }
                complex_solve(&mut lhs, half, &mut rhs, m);
                // Contribution to cut t: Re(e^{i theta t} U) / z, twice unless its own conjugate.
                let weight = if k == 0 || 2 * k == z { 1.0 } else { 2.0 } / z as f64;
                let mut out = vec![0.0; span * half * m];
                for t in 0..span {
                    let (sn, cs) = (theta * (t as f64 - REACH as f64)).sin_cos();
                    for e in 0..half * m {
                        out[t * half * m + e] = weight * (cs * rhs[e].0 - sn * rhs[e].1);
                    }
                }
                out
            })
            .collect();
        let mut cuts = vec![0.0; span * half * m];
        for w in &waves {
            for (c, v) in cuts.iter_mut().zip(w) {
                *c += v;
            }
        }
        let plane = half_plane_means(&self.stations);
        let step = half_plane_steps(&self.stations);
        let aside = seen_by_cuts(&pulls);
        // Reciprocity: what a pull at i moves under a push at j is what the push moves under the pull.
        let sideways = (0..(2 * REACH + 1) as usize)
            .map(|t| {
                let away = (2 * REACH) as usize - t;
                let mut g = vec![0.0; m * m];
                for i in 0..m {
                    for j in 0..m {
                        let mut v = 0.0;
                        for e in 0..half {
                            v += aside[j][e] * cuts[(away * half + e) * m + i]
                                + aside[j][half + e] * cuts[((away + 1) * half + e) * m + i];
                        }
                        if t == REACH as usize {
                            v += dot(&loads[i], &pulls[j]) - step[i * m + j];
                        }
                        g[i * m + j] = v;
                    }
                }
                g
            })
            .collect();
        let smooth = (0..(2 * REACH + 1) as usize)
            .map(|t| {
                let mut g = vec![0.0; m * m];
                for i in 0..m {
                    for j in 0..m {
                        let mut v = 0.0;
                        for e in 0..half {
                            v += b[i][e] * cuts[(t * half + e) * m + j]
                                + b[i][half + e] * cuts[((t + 1) * half + e) * m + j];
                        }
                        if t == REACH as usize {
                            v += dot(&loads[i], &loads[j]) - plane[i * m + j];
                        }
                        g[i * m + j] = v;
                    }
                }
                g
            })
            .collect();
        let st = &self.stations;
        let arcs = (0..m)
            .map(|k| {
                if k == 0 {
                    (2.0 * st[0] + st[1]) / 3.0
                } else if k == m - 1 {
                    (2.0 * st[k] + st[k - 1]) / 3.0
                } else {
                    (st[k - 1] + st[k] + st[k + 1]) / 3.0
                }
            })
            .collect();
        FlankCompliance {
            arcs,
            smooth,
            sideways,
        }
    }

    /// Nodal forces of a tent of traction around station k of unit resultant, along the inward normal or outward along the flank.
    fn tent(&self, k: usize, outward: bool, place: &[usize], size: usize) -> Vec<f64> {
        let mut f = vec![0.0; size];
        let st = &self.stations;
        let area = tent_area(st, k);
        for (nodes, outer, inner) in &self.flank {
            let p = nodes.map(|v| self.xy[v]);
            for (xi, w) in GAUSS4 {
                let arc = 0.5 * (1.0 - xi) * outer + 0.5 * (1.0 + xi) * inner;
                let load = hat(st, k, arc) / area;
                if load == 0.0 {
                    continue;
                }
                let shape = [0.5 * xi * (xi - 1.0), 1.0 - xi * xi, 0.5 * xi * (xi + 1.0)];
                let slope = [xi - 0.5, -2.0 * xi, xi + 0.5];
                let mut t = [0.0; 2];
                for a in 0..3 {
                    for d in 0..2 {
                        t[d] += slope[a] * p[a][d];
                    }
                }
                for a in 0..3 {
                    // The edge runs from the tip inward: inward normal times length element is (t_y, -t_x), outward along the flank -t.
                    let along = if outward {
                        [-t[0], -t[1]]
                    } else {
                        [t[1], -t[0]]
                    };
                    f[place[nodes[a]]] += w * load * shape[a] * along[0];
                    f[place[nodes[a]] + 1] += w * load * shape[a] * along[1];
                }
            }
        }
        f
    }
}

fn nine(at: impl Fn(usize, usize) -> usize) -> [usize; 9] {
    let mut q = [0; 9];
    for i in 0..3 {
        for j in 0..3 {
            q[3 * i + j] = at(i, j);
        }
    }
    q
}

const GAUSS3: [(f64, f64); 3] = [
    (-0.774_596_669_241_483_4, 5.0 / 9.0),
    (0.0, 8.0 / 9.0),
    (0.774_596_669_241_483_4, 5.0 / 9.0),
];
const GAUSS4: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_8),
    (-0.339_981_043_584_856_3, 0.652_145_154_862_546_2),
    (0.339_981_043_584_856_3, 0.652_145_154_862_546_2),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_8),
];

/// Nine-node quadrilateral, plane strain, E = 1.
fn stiffness(p: &[[f64; 2]; 9]) -> Vec<f64> {
    let f = 1.0 / ((1.0 + NU) * (1.0 - 2.0 * NU));
    let (d1, d2, d3) = (f * (1.0 - NU), f * NU, 0.5 / (1.0 + NU));
    let mut k = vec![0.0; 18 * 18];
    let line = |x: f64| {
        (
            [0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)],
            [x - 0.5, -2.0 * x, x + 0.5],
        )
    };
    for (a, wa) in GAUSS3 {
        for (b, wb) in GAUSS3 {
            let (na, da) = line(a);
            let (nb, db) = line(b);
            let mut j = [[0.0; 2]; 2];
            let mut local = [[0.0; 2]; 9];
            for i in 0..3 {
                for l in 0..3 {
                    let n = 3 * i + l;
                    local[n] = [da[i] * nb[l], na[i] * db[l]];
                    for d in 0..2 {
                        j[0][d] += local[n][0] * p[n][d];
                        j[1][d] += local[n][1] * p[n][d];
                    }
                }
            }
            let det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
            assert!(det.abs() > 0.0, "degenerate element");
            let g: Vec<[f64; 2]> = local
                .iter()
                .map(|v| {
                    [
                        (j[1][1] * v[0] - j[0][1] * v[1]) / det,
                        (-j[1][0] * v[0] + j[0][0] * v[1]) / det,
                    ]
                })
                .collect();
            let w = wa * wb * det.abs();
            for m in 0..9 {
                for n in 0..9 {
                    let (x, y) = (g[m], g[n]);
                    k[2 * m * 18 + 2 * n] += w * (d1 * x[0] * y[0] + d3 * x[1] * y[1]);
                    k[2 * m * 18 + 2 * n + 1] += w * (d2 * x[0] * y[1] + d3 * x[1] * y[0]);
                    k[(2 * m + 1) * 18 + 2 * n] += w * (d2 * x[1] * y[0] + d3 * x[0] * y[1]);
                    k[(2 * m + 1) * 18 + 2 * n + 1] += w * (d1 * x[1] * y[1] + d3 * x[0] * y[0]);
                }
            }
        }
    }
    k
}

fn complex_solve(a: &mut [(f64, f64)], n: usize, b: &mut [(f64, f64)], m: usize) {
    let mul = |x: (f64, f64), y: (f64, f64)| (x.0 * y.0 - x.1 * y.1, x.0 * y.1 + x.1 * y.0);
    for c in 0..n {
        let size = |v: (f64, f64)| v.0.abs() + v.1.abs();
        let p = (c..n)
            .max_by(|&x, &y| size(a[x * n + c]).total_cmp(&size(a[y * n + c])))
            .unwrap_or(c);
        if p != c {
            for j in 0..n {
                a.swap(p * n + j, c * n + j);
            }
            for j in 0..m {
                b.swap(p * m + j, c * m + j);
            }
        }
        let d = a[c * n + c];
        let q = d.0 * d.0 + d.1 * d.1;
        let inv = (d.0 / q, -d.1 / q);
        for i in c + 1..n {
            let f = mul(a[i * n + c], inv);
            if f == (0.0, 0.0) {
                continue;
            }
            for j in c..n {
                let v = mul(f, a[c * n + j]);
                a[i * n + j].0 -= v.0;
                a[i * n + j].1 -= v.1;
            }
            for j in 0..m {
                let v = mul(f, b[c * m + j]);
                b[i * m + j].0 -= v.0;
                b[i * m + j].1 -= v.1;
            }
        }
    }
    for c in (0..n).rev() {
        let d = a[c * n + c];
        let q = d.0 * d.0 + d.1 * d.1;
        let inv = (d.0 / q, -d.1 / q);
        for j in 0..m {
            let mut v = b[c * m + j];
            for l in c + 1..n {
                let w = mul(a[c * n + l], b[l * m + j]);
                v = (v.0 - w.0, v.1 - w.1);
            }
            b[c * m + j] = mul(v, inv);
        }
    }
}

fn hat(st: &[f64], k: usize, x: f64) -> f64 {
    if x < st[k] {
        if k == 0 {
            return 0.0;
        }
        ((x - st[k - 1]) / (st[k] - st[k - 1])).max(0.0)
    } else {
        if k + 1 == st.len() {
            return if x > st[k] + 1e-12 { 0.0 } else { 1.0 };
        }
        ((st[k + 1] - x) / (st[k + 1] - st[k])).max(0.0)
    }
}

fn tent_area(st: &[f64], k: usize) -> f64 {
    let left = if k > 0 { st[k] - st[k - 1] } else { 0.0 };
    let right = if k + 1 < st.len() {
        st[k + 1] - st[k]
    } else {
        0.0
    };
    0.5 * (left + right)
}

/// -2(1-nu^2)/pi, times ln|x|/E: the half plane's normal displacement under a unit line load (datum at 1 mm).
pub const PLANE: f64 = -2.0 * (1.0 - NU * NU) / PI;

/// Mean normal displacement (inward) of tent i of the half plane under a unit pull (outward) spread over tent j, E = 1. A pull sinks the surface that it is
/// drawn over (ahead of it, here outward) and lifts what it leaves: (1 - 2 nu)(1 + nu)/2 on either side.
fn half_plane_steps(st: &[f64]) -> Vec<f64> {
    let m = st.len();
    let size = 0.5 * (1.0 - 2.0 * NU) * (1.0 + NU);
    // Share of a tent that lies below x.
    let below = |k: usize, x: f64| {
        let area = tent_area(st, k);
        let mut sum = 0.0;
        if k > 0 {
            let h = st[k] - st[k - 1];
            let t = ((x - st[k - 1]) / h).clamp(0.0, 1.0);
            sum += 0.5 * h * t * t;
        }
        if k + 1 < m {
            let h = st[k + 1] - st[k];
            let t = ((x - st[k]) / h).clamp(0.0, 1.0);
            sum += h * (t - 0.5 * t * t);
        }
        sum / area
    };
    let mut out = vec![0.0; m * m];
    for i in 0..m {
        for j in 0..m {
            let mut mean = 0.0;
            for k in 0..m - 1 {
                let (lo, hi) = (st[k], st[k + 1]);
                for (x, w) in GAUSS4 {
                    let s = 0.5 * (lo + hi) + 0.5 * (hi - lo) * x;
                    mean += 0.5 * (hi - lo) * w * hat(st, i, s) * (2.0 * below(j, s) - 1.0);
                }
            }
            out[i * m + j] = size * mean / tent_area(st, i);
        }
    }
    out
}

/// Mean half-plane displacement of tent i under tent j (E = 1).
fn half_plane_means(st: &[f64]) -> Vec<f64> {
    let m = st.len();
    let i0 = |v: f64| if v == 0.0 { 0.0 } else { v * v.abs().ln() - v };
    let i1 = |v: f64| {
        if v == 0.0 {
            0.0
        } else {
            0.5 * v * v * v.abs().ln() - 0.25 * v * v
        }
    };
    let potential = |k: usize, s: f64| {
        let mut sum = 0.0;
        let mut part = |a: f64, b: f64, fa: f64, fb: f64| {
            let slope = (fb - fa) / (b - a);
            let zero = i0(b - s) - i0(a - s);
            let one = i1(b - s) - i1(a - s);
            sum += (fa + slope * (s - a)) * zero + slope * one;
        };
        if k > 0 {
            part(st[k - 1], st[k], 0.0, 1.0);
        }
        if k + 1 < m {
            part(st[k], st[k + 1], 1.0, 0.0);
        }
        sum / tent_area(st, k)
    };
    let mut out = vec![0.0; m * m];
    for i in 0..m {
        for j in 0..m {
            let mut mean = 0.0;
            let mut part = |a: f64, b: f64| {
                let n = 6;
                for q in 0..n {
                    let (lo, hi) = (
                        a + (b - a) * q as f64 / n as f64,
                        a + (b - a) * (q + 1) as f64 / n as f64,
                    );
                    for (x, w) in GAUSS4 {
                        let s = 0.5 * (lo + hi) + 0.5 * (hi - lo) * x;
                        mean += 0.5 * (hi - lo) * w * hat(st, i, s) * potential(j, s);
                    }
                }
            };
            if i > 0 {
                part(st[i - 1], st[i]);
            }
            if i + 1 < m {
                part(st[i], st[i + 1]);
            }
            out[i * m + j] = PLANE * mean / tent_area(st, i);
        }
    }
    out
}

impl FlankCompliance {
    /// Four-point weights at an arc coordinate (clamped to the flank).
    pub fn weights(&self, arc: f64) -> (usize, [f64; 4]) {
        let x = &self.arcs;
        let n = x.len();
        let arc = arc.clamp(x[0], x[n - 1]);
        let k = x.partition_point(|&v| v < arc).clamp(2, n - 2) - 2;
        let mut w = [1.0; 4];
        for a in 0..4 {
            for b in 0..4 {
                if a != b {
                    w[a] *= (arc - x[k + b]) / (x[k + a] - x[k + b]);
                }
            }
        }
        (k, w)
    }

    /// Smooth part at tooth t, places given by their weights.
    pub fn at(&self, t: isize, i: &(usize, [f64; 4]), j: &(usize, [f64; 4])) -> f64 {
        self.interpolate(&self.smooth, t, i, j)
    }

    /// The same under a tangential load at j.
    pub fn aside(&self, t: isize, i: &(usize, [f64; 4]), j: &(usize, [f64; 4])) -> f64 {
        self.interpolate(&self.sideways, t, i, j)
    }

    fn interpolate(
        &self,
        of: &[Vec<f64>],
        t: isize,
        i: &(usize, [f64; 4]),
        j: &(usize, [f64; 4]),
    ) -> f64 {
        if t.abs() > REACH {
            return 0.0;
        }
        let g = &of[(t + REACH) as usize];
        let n = self.arcs.len();
        let mut v = 0.0;
        for a in 0..4 {
            let row = &g[(i.0 + a) * n + j.0..(i.0 + a) * n + j.0 + 4];
            v += i.1[a] * (row[0] * j.1[0] + row[1] * j.1[1] + row[2] * j.1[2] + row[3] * j.1[3]);
        }
        v
    }
}
