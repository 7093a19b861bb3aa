//! The generator's base model against what others computed.

use std::sync::Arc;
use std::time::Instant;

use crate::hidden::Conditions;
use crate::involute::{Mating, Tooth};
use crate::passage::{Fineness, Passage};
use crate::ring::{self, FlankCompliance};
use crate::wear::Run;

pub fn print(what: &str) {
    if what != "none" {
        shares(1);
    }
    if what != "shares" {
        none(&Fineness::default(), 5e-4);
    }
}

fn shares(fine: usize) {
    let t = Instant::now();
    for (name, m, z, x, bores, e, torque, width) in [
        ("REF", 2.0, [27, 53], [0.0, 0.0], [12.5, 20.0], 2.1e5, 100.0, 33.0),
        ("FZG-C", 4.5, [16, 24], [0.1817, 0.1715], [15.0, 15.0], 2.06e5, 200.0, 14.0),
        ("S30", 2.0, [30, 30], [0.0, 0.0], [8.0, 8.0], 2.06e5, 50.0, 15.0),
    ] {
        let p = Tooth::new(m, z[0], x[0], bores[0]);
        let g = Tooth::new(m, z[1], x[1], bores[1]);
        let soft = [ring::compliance(&p, fine), ring::compliance(&g, fine)];
        println!("{name}: compliance {:.2?}", t.elapsed());
        let pair = Mating::new(&p, &g, Mating::nominal_centre(&p, &g));
        let w = 1e3 * torque / (width * p.rb);
        let stiff = |s: f64, w: f64| single(&pair, &soft, e, s, w);
        let b = pair.end - pair.pb;
        println!("  k at B {:.3} C {:.3} D {:.3}", stiff(b, w), stiff(0.0, w), stiff(pair.start + pair.pb, w));
        for f in [0.05, 0.5, 0.95] {
            let s = pair.start + f * (b - pair.start);
            let (share, k) = double(&pair, &soft, e, s, w);
            println!("  {f}: share {share:.3} k {k:.3}");
        }
    }
}

/// Hertz approach of a line contact in closed form on the smooth parts: mean displacement under the pressure.
fn pair_compliance(pair: &Mating, soft: &[FlankCompliance; 2], e: f64, s: [f64; 2], t: isize) -> f64 {
    (0..2)
        .map(|m| {
            let teeth = pair.teeth(m);
            let w = s.map(|s| soft[m].weights(teeth.arc(pair.rho(m, s))));
            let t = if m == 0 { t } else { -t };
            soft[m].at(t, &w[0], &w[1]) / e
        })
        .sum()
}

fn hertz_local(pair: &Mating, e: f64, s: f64, w: f64) -> f64 {
    // Centre approach of Hertz with the half plane's datum at 1 mm: -2 PLANE w/E (ln(2/b) + 1/2).
    let (a, b) = (pair.rho(0, s), pair.rho(1, s));
    let r = a * b / (a + b);
    let es = e / (2.0 * (1.0 - ring::NU * ring::NU));
    let half = (4.0 * w * r / (std::f64::consts::PI * es)).sqrt();
    -2.0 * ring::PLANE / e * w * ((2.0 / half).ln() + 0.5)
}

pub fn single(pair: &Mating, soft: &[FlankCompliance; 2], e: f64, s: f64, w: f64) -> f64 {
    let d = w * pair_compliance(pair, soft, e, [s, s], 0) + hertz_local(pair, e, s, w);
    w / d * 1e-3
}

pub fn double(pair: &Mating, soft: &[FlankCompliance; 2], e: f64, s: f64, w: f64) -> (f64, f64) {
    let q = s + pair.pb;
    let c = |a: f64, b: f64, t: isize| pair_compliance(pair, soft, e, [a, b], t);
    let approach = |x: f64| {
        let (wa, wb) = (x * w, (1.0 - x) * w);
        let a = wa * c(s, s, 0) + wb * c(s, q, -1) + hertz_local(pair, e, s, wa);
        let b = wb * c(q, q, 0) + wa * c(q, s, 1) + hertz_local(pair, e, q, wb);
        (a, b)
    };
    let (mut lo, mut hi) = (0.01, 0.99);
    for _ in 0..60 {
        let mid = 0.5 * (lo + hi);
        let (a, b) = approach(mid);
        if a < b { lo = mid } else { hi = mid }
    }
    (lo, w / approach(lo).0 * 1e-3)
}

/// All tests of `../challenges/none_L2` with the true coefficient.
pub fn none(fine: &Fineness, tolerance: f64) {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../challenges/none_L2");
    let truth: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(format!("{folder}/truth.json")).unwrap()).unwrap();
    let k = truth["k_true"].as_f64().unwrap();
    let values: Vec<f64> = truth["noise_free"].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
    let text = std::fs::read_to_string(format!("{folder}/measurements.csv")).unwrap();
    let mut rows: Vec<(String, usize, f64, String, Option<f64>, f64)> = Vec::new();
    for (line, v) in text.lines().filter(|l| !l.starts_with('#')).skip(1).zip(values) {
        let f: Vec<&str> = line.split(',').collect();
        rows.push((f[0].into(), usize::from(f[1] == "gear"), f[2].parse().unwrap(), f[3].into(), f[4].parse().ok(), v));
    }
    let text = std::fs::read_to_string(format!("{folder}/sealed.csv")).unwrap();
    for line in text.lines().filter(|l| !l.starts_with('#')).skip(1) {
        let f: Vec<&str> = line.split(',').collect();
        rows.push((f[0].into(), usize::from(f[1] == "gear"), f[2].parse().unwrap(), f[3].into(), f[4].parse().ok(), f[5].parse().unwrap()));
    }
    let p = Tooth::new(2.0, 27, 0.0, 12.5);
    let g = Tooth::new(2.0, 53, 0.0, 20.0);
    let soft = [ring::compliance(&p, 1), ring::compliance(&g, 1)];
    let all = Instant::now();
    let (mut sum, mut count) = (0.0, 0);
    for (id, torque, speed, mis, cycles) in [
        ("A", 100.0, 2000.0, 0.0, 1e6),
        ("B", 170.0, 2000.0, 0.0, 8e5),
        ("C", 100.0, 600.0, 0.0, 6e5),
        ("D", 170.0, 2000.0, 0.5, 8e5),
        ("S", 140.0, 1200.0, 0.3, 1.2e6),
    ] {
        let t = Instant::now();
        let pair = Mating::new(&p, &g, 80.0 + mis);
        let load = 1e3 * torque / 33.0 / p.rb;
        let passage = Arc::new(Passage::new(pair, &soft, 2.1e5, load, *fine));
        let set = t.elapsed();
        let run = Run {
            passage: passage.clone(),
            conditions: Conditions {
                torque, speed, misalignment: mis, bulk: 60.0, viscosity: 0.015, pressure_viscosity: 18.0,
                roughness: 0.5, friction: 0.06, index: 0,
            },
            width: 33.0,
            k,
            hidden: Arc::new(Vec::new()),
            tolerance,
        };
        let h = run.run(cycles);
        println!("{id}: set up {set:.2?}, run {:.2?}, steps {}, evaluations {}", t.elapsed() - set, h.cycles.len() - 1, h.evaluations);
        let mut traces: Vec<(usize, f64)> = Vec::new();
        for r in rows.iter().filter(|r| r.0 == id) {
            if !traces.contains(&(r.1, r.2)) {
                traces.push((r.1, r.2));
            }
        }
        for (m, n) in traces {
            let state = h.at(n);
            let n0 = passage.stations[0].count;
            let part = if m == 0 { &state[..n0] } else { &state[n0..] };
            let depth: Vec<&(String, usize, f64, String, Option<f64>, f64)> =
                rows.iter().filter(|r| r.0 == id && r.1 == m && r.2 == n && r.3 == "wear_depth").collect();
            let top = depth.iter().map(|r| r.5).fold(0.0, f64::max);
            let teeth = passage.pair.teeth(m);
            let err: Vec<f64> = depth
                .iter()
                .map(|r| {
                    let rad = r.4.unwrap();
                    let model = 1e3 * passage.stations[m].sample(part, teeth.arc(teeth.rho(rad)));
                    100.0 * (model - r.5) / top
                })
                .collect();
            let len = err.len();
            sum += err.iter().map(|e| e * e).sum::<f64>();
            count += len;
            let inside = err[1..len - 1].iter().fold(0.0f64, |a, b| a.max(b.abs()));
            let rms = (err.iter().map(|e| e * e).sum::<f64>() / len as f64).sqrt();
            let mass = rows.iter().find(|r| r.0 == id && r.1 == m && r.2 == n && r.3 == "mass_loss").map_or(0.0, |r| r.5);
            println!("  {} {n:8}: max {top:6.3} um, inside {inside:5.2} %, rms {rms:5.2} %, ends {:5.2} {:5.2} %, mass {:5.2} %",
                ["pinion", "gear"][m], err[0], err[len - 1], 100.0 * (run.mass(&state, m) / mass - 1.0));
        }
    }
    println!("rms of all {:.3} %, {:.2?}", (sum / f64::from(count as u32)).sqrt(), all.elapsed());
}
