//! The generator's base model against what others computed.

use std::sync::Arc;
use std::time::Instant;

use crate::contact;
use crate::hidden::Conditions;
use crate::involute::{Mating, Tooth};
use crate::passage::{Fineness, Passage};
use crate::ring::{self, FlankCompliance};
use crate::wear::Run;

pub fn main() {
    let t = Instant::now();
    let fine: usize = std::env::args().nth(1).and_then(|s| s.parse().ok()).unwrap_or(1);
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
