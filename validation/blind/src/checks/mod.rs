//! The generator's base model against what others computed.

#[cfg(test)]
mod face;
#[cfg(test)]
mod forces;
#[cfg(test)]
mod teeth;

use std::sync::Arc;
use std::time::Instant;

use crate::hidden::{Conditions, Hidden};
use crate::involute::{Mating, Tooth};
use crate::laws::{Class, Law};
use crate::layout::Layout;
use crate::make::{self, Kind, Wish};
use crate::passage::{Fineness, Passage};
use crate::ring::{self, FlankCompliance};
use crate::wear::Run;

pub fn print(what: &str) {
    if what == "all" || what == "shares" {
        shares(1);
    }
    let open = |name: &str| format!("{}/../challenges/{name}", env!("CARGO_MANIFEST_DIR"));
    match what {
        "shares" => {}
        "grid" => grid(),
        "none" => drop(none(&open("none_L2"), &Fineness::default(), 4e-4)),
        "all" => {
            none(&open("none_L2"), &Fineness::default(), 4e-4);
            none(&open("running_in_L1"), &Fineness::default(), 4e-4);
        }
        folder => {
            let mut fine = Fineness::default();
            let number = |n: &str| std::env::var(n).ok().and_then(|v| v.parse::<f64>().ok());
            if let Some(v) = number("BLIND_CELLS") {
                fine.cells_per_half_width = v;
            }
            if let Some(v) = number("BLIND_POSITIONS") {
                fine.positions = v as usize;
            }
            let _ = none(folder, &fine, number("BLIND_TOLERANCE").unwrap_or(4e-4));
        }
    }
}

fn shares(fine: usize) {
    let t = Instant::now();
    for (name, m, z, x, bores, e, torque, width) in [
        (
            "REF",
            2.0,
            [27, 53],
            [0.0, 0.0],
            [12.5, 20.0],
            2.1e5,
            100.0,
            33.0,
        ),
        (
            "FZG-C",
            4.5,
            [16, 24],
            [0.1817, 0.1715],
            [15.0, 15.0],
            2.06e5,
            200.0,
            14.0,
        ),
        (
            "S30",
            2.0,
            [30, 30],
            [0.0, 0.0],
            [8.0, 8.0],
            2.06e5,
            50.0,
            15.0,
        ),
    ] {
        let p = Tooth::new(m, z[0], x[0], bores[0]);
        let g = Tooth::new(m, z[1], x[1], bores[1]);
        let soft = [ring::compliance(&p, fine), ring::compliance(&g, fine)];
        println!("{name}: compliance {:.2?}", t.elapsed());
        let pair = Mating::new(&p, &g, Mating::nominal_centre(&p, &g));
        let w = 1e3 * torque / (width * p.rb);
        let stiff = |s: f64, w: f64| single(&pair, &soft, e, s, w);
        let b = pair.end - pair.pb;
        println!(
            "  k at B {:.3} C {:.3} D {:.3}",
            stiff(b, w),
            stiff(0.0, w),
            stiff(pair.start + pair.pb, w)
        );
        for f in [0.05, 0.5, 0.95] {
            let s = pair.start + f * (b - pair.start);
            let (share, k) = double(&pair, &soft, e, s, w);
            println!("  {f}: share {share:.3} k {k:.3}");
        }
    }
}

/// Hertz approach of a line contact in closed form on the smooth parts: mean displacement under the pressure.
fn pair_compliance(
    pair: &Mating,
    soft: &[FlankCompliance; 2],
    e: f64,
    s: [f64; 2],
    t: isize,
) -> f64 {
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

/// Change of the noise-free rows on a finer grid, for some drawn sets of every class.
fn grid() {
    let kinds = [
        Kind::None,
        Kind::Single,
        Kind::Foreign,
        Kind::Outside,
        Kind::Pair,
    ];
    let (mut all, mut worst_of_all) = (Vec::new(), 0.0f64);
    for index in 0..20 {
        let wish = Wish {
            seed: 9,
            index,
            kind: Some(kinds[index as usize % 5]),
            noise: Some(0.02),
            ..Wish::default()
        };
        let set = make::make(&wish);
        let fine = set.rig.on_grid(
            Fineness {
                positions: 128,
                cells_per_half_width: 13.0,
                extent: 4.0,
            },
            1e-4,
        );
        let (mut worst, mut sum, mut count) = (0.0f64, 0.0, 0);
        for (t, plan) in set.rig.tests.iter().enumerate().take(2) {
            let rows: Vec<_> = set
                .rows
                .iter()
                .filter(|r| r.test == t && r.is_depth())
                .cloned()
                .collect();
            let (run, history) = fine.run(plan, set.k_tests[t], &set.laws, plan.cycles);
            let values = fine.observe(&run, &history, &rows, 1.0);
            for (r, v) in rows.iter().zip(&values) {
                let top = rows
                    .iter()
                    .filter(|o| o.trace == r.trace)
                    .map(|o| o.free.abs())
                    .fold(0.0, f64::max);
                let e = 100.0 * (r.free - v) / top;
                worst = worst.max(e.abs());
                sum += e * e;
                count += 1;
            }
        }
        let names: Vec<_> = set
            .laws
            .iter()
            .map(|l| format!("{}:{}", l.name, l.form))
            .collect();
        let rms = (sum / f64::from(count)).sqrt();
        println!(
            "{index} {} [{}]: rms {rms:.3} %, largest {worst:.2} %",
            set.kind.name(),
            names.join(" + ")
        );
        all.push(rms);
        worst_of_all = worst_of_all.max(worst);
    }
    all.sort_by(f64::total_cmp);
    println!(
        "rms: median {:.3} %, largest {:.3} %; largest of all {worst_of_all:.2} %",
        all[all.len() / 2],
        all[all.len() - 1]
    );
}

/// The cause of an open data set in our terms.
fn open_law(e: &serde_json::Value) -> Law {
    let p = |n: &str| e["parameters"][n].as_f64().unwrap();
    let (name, form, parameters) = match e["kind"].as_str().unwrap() {
        "running_in" => (
            "running_in",
            "exponential",
            vec![("amplitude", p("A")), ("decay_cycles", p("n0"))],
        ),
        "pressure_exponent" => (
            "pressure_exponent",
            "local",
            vec![
                ("excess_exponent", p("m") - 1.0),
                ("reference_pressure", p("p_ref")),
            ],
        ),
        "film_thickness" => (
            "film_thickness",
            "rational",
            vec![
                ("strength", 1.0),
                ("exponent", p("q")),
                ("reference_film", p("lambda0")),
            ],
        ),
        "micropitting" => (
            "micropitting",
            "power",
            vec![
                ("rate", p("c")),
                ("exponent", p("q")),
                ("reference_pressure", p("p_ref")),
            ],
        ),
        "tip_relief" => (
            "tip_relief",
            "linear",
            vec![("amount", p("amount")), ("length", p("length"))],
        ),
        other => panic!("no law for {other}"),
    };
    Law {
        name,
        form,
        class: Class::Single,
        parameters,
        drivers: &[],
        limit: 0.0,
    }
}

/// All tests of an open data set with the true coefficient and cause.
pub fn none(folder: &str, fine: &Fineness, tolerance: f64) -> (f64, f64) {
    let mut worst = 0.0f64;
    let truth: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(format!("{folder}/truth.json")).unwrap())
            .unwrap();
    let k = truth["k_true"].as_f64().unwrap();
    let values: Vec<f64> = truth["noise_free"]
        .as_array()
        .unwrap()
        .iter()
        .map(|v| v.as_f64().unwrap())
        .collect();
    let text = std::fs::read_to_string(format!("{folder}/measurements.csv")).unwrap();
    let mut rows: Vec<(String, usize, f64, String, Option<f64>, f64)> = Vec::new();
    for (line, v) in text
        .lines()
        .filter(|l| !l.starts_with('#'))
        .skip(1)
        .zip(values)
    {
        let f: Vec<&str> = line.split(',').collect();
        rows.push((
            f[0].into(),
            usize::from(f[1] == "gear"),
            f[2].parse().unwrap(),
            f[3].into(),
            f[4].parse().ok(),
            v,
        ));
    }
    let text = std::fs::read_to_string(format!("{folder}/sealed.csv")).unwrap();
    for line in text.lines().filter(|l| !l.starts_with('#')).skip(1) {
        let f: Vec<&str> = line.split(',').collect();
        rows.push((
            f[0].into(),
            usize::from(f[1] == "gear"),
            f[2].parse().unwrap(),
            f[3].into(),
            f[4].parse().ok(),
            f[5].parse().unwrap(),
        ));
    }
    let p = Tooth::new(2.0, 27, 0.0, 12.5);
    let g = Tooth::new(2.0, 53, 0.0, 20.0);
    let soft = [ring::compliance(&p, 1), ring::compliance(&g, 1)];
    let all = Instant::now();
    let (mut sum, mut count) = (0.0, 0);
    let toml: Vec<String> = ["study.toml", "sealed.toml"]
        .iter()
        .map(|f| std::fs::read_to_string(format!("{folder}/{f}")).unwrap())
        .collect();
    let toml: toml::Value = toml.join("\n").parse::<toml::Table>().unwrap().into();
    let laws: Vec<Law> = truth["effects"]
        .as_array()
        .unwrap()
        .iter()
        .map(open_law)
        .collect();
    for test in toml["test"].as_array().unwrap() {
        let get = |k: &str| test[k].as_float().unwrap();
        let id = test["id"].as_str().unwrap();
        let (torque, speed, mis, cycles) = (
            get("torque"),
            get("speed"),
            get("misalignment"),
            get("cycles"),
        );
        let t = Instant::now();
        let pair = Mating::new(&p, &g, 80.0 + mis);
        let load = 1e3 * torque / 33.0 / p.rb;
        let passage = Arc::new(Passage::new(pair, &soft, 2.1e5, load, *fine, None, false));
        let set = t.elapsed();
        let run = Run {
            passages: vec![passage.clone()],
            layout: Layout::even(),
            conditions: Conditions {
                torque,
                speed,
                misalignment: mis,
                bulk: 60.0,
                viscosity: 0.015,
                pressure_viscosity: 18.0,
                roughness: 0.5,
                friction: 0.06,
            },
            width: 33.0,
            k,
            hidden: Arc::new(
                laws.iter()
                    .map(|l| Box::new(l.clone()) as Box<dyn Hidden>)
                    .collect(),
            ),
            tolerance,
        };
        let h = run.run(cycles);
        println!(
            "{id}: set up {set:.2?}, run {:.2?}, steps {}, evaluations {}",
            t.elapsed() - set,
            h.cycles.len() - 1,
            h.evaluations
        );
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
            let depth: Vec<_> = rows
                .iter()
                .filter(|r| r.0 == id && r.1 == m && r.2 == n && r.3 == "wear_depth")
                .collect();
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
            worst = worst.max(inside);
            let rms = (err.iter().map(|e| e * e).sum::<f64>() / len as f64).sqrt();
            let mass = rows
                .iter()
                .find(|r| r.0 == id && r.1 == m && r.2 == n && r.3 == "mass_loss")
                .map_or(0.0, |r| r.5);
            if std::env::var("BLIND_SHOW").is_ok() {
                println!(
                    "    {}",
                    err.iter()
                        .map(|e| format!("{e:.2}"))
                        .collect::<Vec<_>>()
                        .join(" ")
                );
            }
            println!(
                "  {} {n:8}: max {top:6.3} um, inside {inside:5.2} %, rms {rms:5.2} %, ends {:5.2} {:5.2} %, mass {:5.2} %",
                ["pinion", "gear"][m],
                err[0],
                err[len - 1],
                100.0 * (run.mass(&state, m) / mass - 1.0)
            );
        }
    }
    let rms = (sum / f64::from(count as u32)).sqrt();
    println!(
        "rms of all {rms:.3} %, largest inside {worst:.2} %, {:.2?}",
        all.elapsed()
    );
    (worst, rms)
}

#[cfg(test)]
mod tests {
    use std::sync::OnceLock;

    use super::*;
    use crate::involute::inv;

    pub static REFERENCE: OnceLock<[FlankCompliance; 2]> = OnceLock::new();

    fn teeth() -> [Tooth; 2] {
        [
            Tooth::new(2.0, 27, 0.0, 12.5),
            Tooth::new(2.0, 53, 0.0, 20.0),
        ]
    }

    pub fn compliances() -> [FlankCompliance; 2] {
        teeth().map(|t| ring::compliance(&t, 1))
    }

    /// The pair 27/53.
    pub fn reference(fine: Fineness, torque: f64) -> (Run, Mating) {
        let [p, g] = teeth();
        let soft = REFERENCE.get_or_init(compliances);
        let pair = Mating::new(&p, &g, 80.0);
        let load = 1e3 * torque / 33.0 / p.rb;
        let conditions = Conditions {
            torque,
            speed: 2000.0,
            misalignment: 0.0,
            bulk: 60.0,
            viscosity: 0.015,
            pressure_viscosity: 18.0,
            roughness: 0.5,
            friction: 0.06,
        };
        let passage = Arc::new(Passage::new(
            pair.clone(),
            soft,
            2.1e5,
            load,
            fine,
            None,
            false,
        ));
        (
            Run {
                passages: vec![passage],
                layout: Layout::even(),
                conditions,
                width: 33.0,
                k: 2e-10,
                hidden: Arc::new(Vec::new()),
                tolerance: 4e-4,
            },
            pair,
        )
    }

    /// In single contact the unworn pressure is Hertz's: peak and the integral of p^m (closed form) 1.5 %.
    #[test]
    fn hertz() {
        let (run, _) = reference(
            Fineness {
                positions: 200,
                cells_per_half_width: 10.0,
                ..Fineness::default()
            },
            100.0,
        );
        let size: usize = run.passage().stations.iter().map(|s| s.count).sum();
        let (mut seen, m) = (0, 2.46);
        // (sqrt(pi)/2) Gamma(m/2+1)/Gamma(m/2+3/2) by integration of (1-x^2)^(m/2) over 0..1.
        let n = 20_000;
        let shape = (0..n)
            .map(|i| {
                let x = (f64::from(i) + 0.5) / f64::from(n);
                (1.0 - x * x).powf(m / 2.0)
            })
            .sum::<f64>()
            / f64::from(n);
        for (i, at) in run.passage().positions.iter().enumerate() {
            let a = run.contact(0, i, &vec![0.0; size], &mut Vec::new());
            for (slot, &w) in at.slots.iter().zip(&a.loads) {
                if (w / run.line_load() - 1.0).abs() > 1e-9 {
                    continue;
                }
                let (_, p0, half) = run.passage().hertz(slot.s, w);
                let cells = &a.pressure[slot.from..slot.from + slot.count];
                let peak = cells.iter().copied().fold(0.0, f64::max);
                assert!((peak / p0 - 1.0).abs() < 0.015, "{} {peak} {p0}", slot.s);
                let sum: f64 =
                    cells.iter().map(|p| p.max(0.0).powf(m)).sum::<f64>() * run.passage().cell;
                let exact = 2.0 * half * p0.powf(m) * shape;
                assert!(
                    (sum / exact - 1.0).abs() < 0.015,
                    "{} {}",
                    slot.s,
                    sum / exact
                );
                seen += 1;
            }
        }
        assert!(seen > 10);
    }

    /// Shares and stiffness of E2 and E3 (finite elements of others): 0.2 % and 0.003.
    #[test]
    fn stiffness_and_shares() {
        let p = Tooth::new(2.0, 27, 0.0, 12.5);
        let g = Tooth::new(2.0, 53, 0.0, 20.0);
        let soft = [ring::compliance(&p, 1), ring::compliance(&g, 1)];
        let pair = Mating::new(&p, &g, 80.0);
        let w = 119.436;
        for (s, k) in [
            (pair.end - pair.pb, 13.464),
            (0.0, 13.662),
            (pair.start + pair.pb, 13.599),
        ] {
            assert!((single(&pair, &soft, 2.1e5, s, w) / k - 1.0).abs() < 2e-3);
        }
        let length = pair.end - pair.pb - pair.start;
        for (f, share, k) in [
            (0.05, 0.405, 18.973),
            (0.5, 0.491, 19.495),
            (0.95, 0.582, 19.009),
        ] {
            let (x, both) = double(&pair, &soft, 2.1e5, pair.start + f * length, w);
            assert!((x - share).abs() < 3e-3 && (both / k - 1.0).abs() < 2e-3);
        }
        assert!((inv(20f64.to_radians()) - 0.014_904_384).abs() < 1e-9);
    }

    /// Contact of all cells gives the shares that the 2 x 2 compliance gives, where no corner touches.
    #[test]
    fn cells_share_alike() {
        let (run, pair) = reference(Fineness::default(), 100.0);
        let p = Tooth::new(2.0, 27, 0.0, 12.5);
        let g = Tooth::new(2.0, 53, 0.0, 20.0);
        let soft = [ring::compliance(&p, 1), ring::compliance(&g, 1)];
        let size: usize = run.passage().stations.iter().map(|s| s.count).sum();
        let mut seen = 0;
        for (i, at) in run.passage().positions.iter().enumerate() {
            let a = run.contact(0, i, &vec![0.0; size], &mut Vec::new());
            let loaded: Vec<(f64, f64)> = at
                .slots
                .iter()
                .map(|s| s.s)
                .zip(a.loads.iter().copied())
                .filter(|l| l.1 > 0.0)
                .collect();
            if loaded.len() == 2 && loaded[0].0 > pair.start + 0.15 && loaded[1].0 < pair.end - 0.15
            {
                let (x, _) = double(&pair, &soft, 2.1e5, loaded[0].0, run.line_load());
                assert!(
                    (loaded[0].1 / run.line_load() - x).abs() < 3e-3,
                    "{} {x}",
                    loaded[0].1 / run.line_load()
                );
                seen += 1;
            }
        }
        assert!(seen > 20);
    }

    /// A tenth of the tolerance changes no measured depth by more than 0.1 % of the largest; both members lose the area that Reye asks.
    #[test]
    fn steps_converge() {
        let (run, pair) = reference(Fineness::default(), 100.0);
        let end = 2e6;
        let coarse = run.run(end);
        let fine = Run {
            tolerance: 5e-5,
            passages: run.passages.clone(),
            layout: run.layout.clone(),
            conditions: run.conditions.clone(),
            hidden: run.hidden.clone(),
            ..run
        };
        let fine_history = fine.run(end);
        for part in [0.1, 0.35, 1.0] {
            let (a, b) = (coarse.at(part * end), fine_history.at(part * end));
            let n0 = fine.passage().stations[0].count;
            for m in 0..2 {
                let (t, st) = (pair.teeth(m), &fine.passage().stations[m]);
                let low =
                    t.arc(pair.rho(m, if m == 0 { pair.start } else { pair.end })) + 0.12 * t.m;
                let high = t.arc(t.rho(t.ra - 0.15 * t.m));
                let inside: Vec<usize> = (0..st.count)
                    .filter(|&k| (low..high).contains(&st.arc(k)))
                    .map(|k| k + m * n0)
                    .collect();
                let top = inside.iter().map(|&k| b[k]).fold(0.0, f64::max);
                let worst = inside
                    .iter()
                    .map(|&k| (a[k] - b[k]).abs())
                    .fold(0.0, f64::max);
                assert!(worst < 1e-3 * top, "{part} {m}: {worst} of {top}");
            }
        }
        // Reye: area per cycle = k * integral of load times sliding; unworn shares sum to 1, so both members
        // together wear no more than k w * (whole sliding path of contact).
        let area = fine.worn_area(&fine_history.at(end));
        assert!(
            (area[0] / (area[1] * pair.gear.z as f64 / pair.pinion.z as f64) - 1.0).abs() < 1e-3
        );
    }

    /// The open data with nothing hidden (made by others): 1 % of a trace's largest depth inside, 0.25 % root mean square.
    #[test]
    fn open_data() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../challenges/none_L2");
        let (worst, rms) = none(folder, &Fineness::default(), 4e-4);
        assert!(worst < 1.0 && rms < 0.25, "{worst} {rms}");
    }
}
