//! Draws a data set: gears, tests, the hidden cause and its strength, noise.

use std::collections::HashMap;
use std::sync::{Arc, Mutex};

use rayon::prelude::*;

use crate::detect::{self, Block};
use crate::dice::Dice;
use crate::hidden::{Conditions, Hidden};
use crate::involute::{Mating, Tooth};
use crate::laws::{self, CATALOGUE, Class, Context, Law, OUTSIDE};
use crate::passage::{Fineness, Passage};
use crate::ring::{self, FlankCompliance};
use crate::wear::{History, Run};

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Kind {
    None,
    Single,
    Foreign,
    Outside,
    Pair,
}

impl Kind {
    pub fn name(self) -> &'static str {
        ["none", "single", "foreign", "outside", "pair"][self as usize]
    }
}

#[derive(Clone, Debug)]
pub struct Wish {
    pub seed: u64,
    pub index: u64,
    pub kind: Option<Kind>,
    pub noise: Option<f64>,
    pub paper: Option<bool>,
    pub law: Option<(String, Option<String>)>,
    pub outlier: bool,
    pub missing: f64,
    pub understate: f64,
    /// Also find the catalogue's causes that explain most of the difference.
    pub rivals: bool,
}

/// A cause of another name that explains part of the difference.
#[derive(Clone, Debug)]
pub struct Rival {
    pub name: &'static str,
    pub form: &'static str,
    /// Part of the base model's chi^2 that it removes.
    pub share: f64,
    /// chi^2 that it leaves.
    pub left: f64,
}

#[derive(Clone, Debug)]
pub struct Plan {
    pub id: String,
    pub conditions: Conditions,
    pub cycles: f64,
    pub checkpoints: Vec<f64>,
}

#[derive(Clone, Debug)]
pub struct Row {
    pub test: usize,
    pub member: usize,
    pub cycles: f64,
    /// Radius, mm; none for a weighed mass.
    pub radius: Option<f64>,
    pub trace: String,
    pub sigma: f64,
    pub free: f64,
    pub value: f64,
}

/// Gears, machine and tests, before any cause.
pub struct Rig {
    pub pinion: Tooth,
    pub gear: Tooth,
    pub centre: f64,
    pub width: f64,
    pub youngs: f64,
    pub paper: bool,
    pub soft: Arc<[FlankCompliance; 2]>,
    pub tests: Vec<Plan>,
    pub sealed: Plan,
    pub points: usize,
    /// Finer for laws that are sharp in the local pressure.
    pub fine: Fineness,
    pub tolerance: f64,
    passages: Mutex<HashMap<(i64, i64), Arc<Passage>>>,
}

pub struct DataSet {
    pub wish: Wish,
    pub kind: Kind,
    pub noise: f64,
    pub rig: Rig,
    pub laws: Vec<Law>,
    pub k: f64,
    pub k_study: f64,
    pub scatter: f64,
    pub k_tests: Vec<f64>,
    pub datum: f64,
    pub datums: Vec<(String, f64)>,
    pub rows: Vec<Row>,
    pub sealed: Vec<Row>,
    pub d: f64,
    pub d_each: Vec<f64>,
    pub attempts: usize,
    pub rivals: Vec<Rival>,
}

fn three_digits(v: f64) -> f64 {
    format!("{v:.2e}").parse().unwrap_or(v)
}

fn paper_teeth() -> (Tooth, Tooth) {
    (Tooth::new(2.0, 27, 0.0, 12.5), Tooth::new(2.0, 53, 0.0, 20.0))
}

fn draw_teeth(d: &mut Dice) -> (Tooth, Tooth, f64) {
    loop {
        let m = *d.pick(&[1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0]);
        let z1 = 17 + d.below(24);
        let z2 = ((z1 as f64 * d.uniform(1.0, 3.5)) as usize).clamp(17, 80);
        let round = |v: f64| (v * 100.0).round() / 100.0;
        let low = |z: usize| ((17.0 - z as f64) / 17.0 + 0.06).max(-0.25);
        let x1 = round(d.uniform(low(z1).max(-0.1), 0.45));
        let x2 = round(d.uniform(low(z2).max(-0.3), 0.35));
        let bore = |z: usize, x: f64, f: f64| {
            let t = Tooth::new(m, z, x, 1.0);
            (t.rf * f * 2.0).floor() / 2.0
        };
        let (b1, b2) = (bore(z1, x1, d.uniform(0.4, 0.6)), bore(z2, x2, d.uniform(0.3, 0.6)));
        let p = Tooth::new(m, z1, x1, b1);
        let g = Tooth::new(m, z2, x2, b2);
        let a = Mating::nominal_centre(&p, &g);
        let a = (a * 1e4).round() / 1e4;
        let pair = Mating::new(&p, &g, a);
        let thick = |t: &Tooth| 2.0 * t.ra * t.half_angle(t.ra) > 0.35 * m;
        // The active profile ends above the fillet.
        let clear = pair.rho(0, pair.start) > p.rho(p.form_radius()) + 0.04 * m
            && pair.rho(1, pair.end) > g.rho(g.form_radius()) + 0.04 * m;
        let tips = a - p.ra - g.rf > 0.1 * m && a - g.ra - p.rf > 0.1 * m;
        if pair.contact_ratio() > 1.32 && pair.contact_ratio() < 1.85 && thick(&p) && thick(&g) && clear && tips {
            return (p, g, a);
        }
    }
}

impl Rig {
    /// `many`: five checkpoints, for causes that come and go in time.
    pub fn draw(paper: bool, many: bool, d: &mut Dice) -> Self {
        let (pinion, gear, centre) = if paper {
            let (p, g) = paper_teeth();
            (p, g, 80.0)
        } else {
            draw_teeth(d)
        };
        let width = if paper { 33.0 } else { (pinion.m * d.uniform(6.0, 16.0)).round().max(6.0) };
        let youngs = 2.1e5;
        let soft = compliances(&pinion, &gear, paper);
        let pair = Mating::new(&pinion, &gear, centre);
        // Load from the Hertz pressure at the pitch point.
        let p0 = if paper { d.uniform(750.0, 950.0) } else { d.uniform(600.0, 1050.0) };
        let e_star = youngs / (2.0 * (1.0 - ring::NU * ring::NU));
        let r = pair.c1 * pair.c2 / (pair.c1 + pair.c2);
        let w = p0 * p0 * std::f64::consts::PI * r / e_star;
        let tidy = |v: f64| {
            let unit = 10f64.powf(v.log10().floor() - 1.0);
            (v / unit).round() * unit
        };
        let torque = tidy(w * width * pinion.rb * 1e-3);
        let speed = tidy(if paper { *d.pick(&[1000.0, 1500.0, 2000.0, 2500.0]) } else { d.log_uniform(400.0, 3500.0) });
        let cycles = tidy(d.log_uniform(3e5, 3e6));
        let shift = if paper { d.uniform(0.3, 0.8) } else { pinion.m * d.uniform(0.08, 0.25) };
        let mut shift = (shift * 100.0).round() / 100.0;
        while Mating::new(&pinion, &gear, centre + shift).contact_ratio() < 1.2 {
            shift = (shift * 50.0).round() / 100.0;
        }
        let viscosity = if paper { 0.015 } else { (d.log_uniform(0.008, 0.08) * 1e3).round() / 1e3 };
        let roughness = if paper { 0.5 } else { (d.log_uniform(0.25, 1.0) * 100.0).round() / 100.0 };
        let tidy_checks = |d: &mut Dice| {
            let lists: [&[f64]; 4] = [&[0.1, 0.25, 0.5, 0.75, 1.0], &[0.05, 0.2, 0.5, 1.0], &[0.15, 0.4, 0.7, 1.0], &[0.1, 0.4, 1.0]];
            let some = d.pick(&lists).to_vec();
            if many { lists[0].to_vec() } else { some }
        };
        let fractions = tidy_checks(d);
        let conditions = |t: f64, n: f64, mis: f64, index: usize| Conditions {
            torque: tidy(torque * t),
            speed: tidy(speed * n),
            misalignment: mis,
            bulk: 60.0,
            viscosity,
            pressure_viscosity: 18.0,
            roughness,
            friction: 0.06,
            index,
        };
        let count = 3 + d.below(3);
        // Reference first; then load, speed and misalignment always come before repeats.
        let up = d.uniform(1.35, 1.9);
        let slow = d.uniform(0.2, 0.4);
        let mut list = vec![(1.0, 1.0, 0.0, 1.0), (up, 1.0, 0.0, d.uniform(0.6, 0.9)), (1.0, slow, 0.0, d.uniform(0.5, 1.0))];
        if count > 3 {
            list.push((up, 1.0, shift, d.uniform(0.6, 1.0)));
        }
        if count > 4 {
            list.push((d.uniform(0.45, 0.7), d.uniform(1.2, 2.0), 0.0, d.uniform(0.8, 1.3)));
        }
        let tests = list
            .iter()
            .enumerate()
            .map(|(i, &(t, n, mis, c))| {
                let cycles = tidy(cycles * c);
                Plan {
                    id: char::from(b'A' + i as u8).to_string(),
                    conditions: conditions(t, n, mis, i),
                    cycles,
                    checkpoints: fractions.iter().map(|f| (f * cycles).round()).collect(),
                }
            })
            .collect();
        let end = tidy(cycles * d.uniform(0.8, 1.2));
        let sealed = Plan {
            id: "S".into(),
            conditions: conditions(
                d.uniform(1.15, 1.3),
                d.uniform(0.45, 0.7),
                *d.pick(&[0.0, (shift * 50.0).round() / 100.0]),
                count,
            ),
            cycles: end,
            checkpoints: fractions.iter().map(|f| (f * end).round()).collect(),
        };
        Self {
            pinion,
            gear,
            centre,
            width,
            youngs,
            paper,
            soft,
            tests,
            sealed,
            points: 40 + d.below(17),
            fine: Fineness::default(),
            tolerance: 4e-4,
            passages: Mutex::new(HashMap::new()),
        }
    }

    /// The same rig on a coarse grid, for comparing causes among themselves.
    fn coarse(&self) -> Self {
        Self {
            pinion: self.pinion.clone(),
            gear: self.gear.clone(),
            centre: self.centre,
            width: self.width,
            youngs: self.youngs,
            paper: self.paper,
            soft: self.soft.clone(),
            tests: self.tests.clone(),
            sealed: self.sealed.clone(),
            points: self.points,
            fine: Fineness { positions: 36, cells_per_half_width: 4.0, extent: 4.0 },
            tolerance: 2e-3,
            passages: Mutex::new(HashMap::new()),
        }
    }

    fn passage(&self, centre: f64, load: f64) -> Arc<Passage> {
        let key = ((centre * 1e6).round() as i64, (load * 1e6).round() as i64);
        let mut map = self.passages.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        map.entry(key)
            .or_insert_with(|| {
                let pair = Mating::new(&self.pinion, &self.gear, centre);
                Arc::new(Passage::new(pair, &self.soft, self.youngs, load, self.fine))
            })
            .clone()
    }

    fn run(&self, plan: &Plan, k: f64, laws: &[Law], cycles: f64) -> (Run, History) {
        let load = 1e3 * plan.conditions.torque / (self.width * self.pinion.rb);
        let shift: f64 = laws.iter().map(|l| l.shift(&plan.conditions, load)).sum();
        let centre = self.centre + plan.conditions.misalignment + shift;
        let hidden: Vec<Box<dyn Hidden>> = laws.iter().map(|l| Box::new(l.clone()) as Box<dyn Hidden>).collect();
        let run = Run {
            passage: self.passage(centre, load),
            conditions: plan.conditions.clone(),
            width: self.width,
            k,
            hidden: Arc::new(hidden),
            tolerance: self.tolerance,
        };
        let start = std::time::Instant::now();
        let history = run.run(cycles);
        if std::env::var("BLIND_COST").is_ok() {
            eprintln!(
                "{} {:?} steps {} evaluations {} stations {:?} cells {} {:.2?}",
                plan.id, laws.iter().map(|l| l.name).collect::<Vec<_>>(), history.cycles.len(), history.evaluations,
                run.passage.stations.iter().map(|s| s.count).collect::<Vec<_>>(),
                run.passage.positions[0].cells.len(), start.elapsed()
            );
        }
        (run, history)
    }

    /// Where a test is measured: (member, radii), on the active profile with margins at both ends.
    fn radii(&self, plan: &Plan) -> [Vec<f64>; 2] {
        let pair = Mating::new(&self.pinion, &self.gear, self.centre + plan.conditions.misalignment);
        [0, 1].map(|m| {
            let t = pair.teeth(m);
            let low = pair.rho(m, if m == 0 { pair.start } else { pair.end });
            let low = t.radius(t.rho_of_arc(t.arc(low) + 0.12 * t.m));
            let high = t.ra - 0.15 * t.m;
            (0..self.points)
                .map(|i| {
                    let r = low + (high - low) * i as f64 / (self.points - 1) as f64;
                    (r * 1e3).round() / 1e3
                })
                .collect()
        })
    }

    /// Deepest wear where the test is measured, um.
    fn deepest(&self, plan: &Plan, run: &Run, history: &History, cycles: f64) -> f64 {
        let state = history.at(cycles);
        let p = &run.passage;
        let n0 = p.stations[0].count;
        let mut deepest = 0.0f64;
        for (m, radii) in self.radii(plan).iter().enumerate() {
            let t = p.pair.teeth(m);
            let part = if m == 0 { &state[..n0] } else { &state[n0..] };
            for &r in radii {
                deepest = deepest.max(1e3 * p.stations[m].sample(part, t.arc(t.rho(r))));
            }
        }
        deepest
    }

    /// Rows of a test without values, in the order of the file.
    fn rows(&self, plan: &Plan, test: usize) -> Vec<Row> {
        let radii = self.radii(plan);
        let mut rows = Vec::new();
        for (c, &cycles) in plan.checkpoints.iter().enumerate() {
            for m in 0..2 {
                let row = |radius, trace: String| Row {
                    test,
                    member: m,
                    cycles,
                    radius,
                    trace,
                    sigma: 0.0,
                    free: 0.0,
                    value: 0.0,
                };
                let name = format!("{}-{}-{}", plan.id, ["p", "g"][m], c + 1);
                rows.extend(radii[m].iter().map(|&r| row(Some(r), name.clone())));
                rows.push(row(None, String::new()));
            }
        }
        rows
    }

    /// Values of the rows with the history's cycles scaled by `scale`.
    fn observe(&self, run: &Run, history: &History, rows: &[Row], scale: f64) -> Vec<f64> {
        let p = &run.passage;
        let n0 = p.stations[0].count;
        let mut at = f64::NAN;
        let mut state = Vec::new();
        rows.iter()
            .map(|r| {
                if r.cycles != at {
                    at = r.cycles;
                    state = history.at(at * scale);
                }
                match r.radius {
                    Some(radius) => {
                        let t = p.pair.teeth(r.member);
                        let part = if r.member == 0 { &state[..n0] } else { &state[n0..] };
                        1e3 * p.stations[r.member].sample(part, t.arc(t.rho(radius)))
                    }
                    None => run.mass(&state, r.member),
                }
            })
            .collect()
    }
}

/// How far base histories reach, over the planned cycles at the true k.
const REACH: f64 = 2.6;

fn compliances(p: &Tooth, g: &Tooth, paper: bool) -> Arc<[FlankCompliance; 2]> {
    static PAPER: Mutex<Option<Arc<[FlankCompliance; 2]>>> = Mutex::new(None);
    let make = || Arc::new([ring::compliance(p, 1), ring::compliance(g, 1)]);
    if !paper {
        return make();
    }
    let mut kept = PAPER.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    kept.get_or_insert_with(make).clone()
}

fn sigmas(rows: &mut [Row], values: &[f64], noise: f64) {
    for i in 0..rows.len() {
        let same = |j: &usize| rows[*j].trace == rows[i].trace && rows[*j].radius.is_some();
        rows[i].sigma = if rows[i].radius.is_some() {
            let top = (0..rows.len()).filter(same).map(|j| values[j].abs()).fold(0.0, f64::max);
            noise * top + 0.05
        } else {
            let last = (0..rows.len())
                .filter(|&j| rows[j].radius.is_none() && rows[j].member == rows[i].member)
                .map(|j| values[j])
                .fold(0.0, f64::max);
            noise * last + 0.02
        };
        rows[i].sigma = (rows[i].sigma * 1e4).round() / 1e4;
        rows[i].free = values[i];
    }
}

fn blocks(rows: &[Row]) -> Vec<Block> {
    let mut out = Vec::new();
    let mut i = 0;
    while i < rows.len() {
        let mut list = vec![i];
        if rows[i].radius.is_some() {
            while i + 1 < rows.len() && rows[i + 1].radius.is_some() && rows[i + 1].trace == rows[i].trace {
                i += 1;
                list.push(i);
            }
        }
        let at: Vec<f64> = list.iter().filter_map(|&j| rows[j].radius).collect();
        let values: Vec<f64> = list.iter().map(|&j| rows[j].free).collect();
        let sigma: Vec<f64> = list.iter().map(|&j| rows[j].sigma).collect();
        out.push(Block::new(list, &at, &values, &sigma));
        i += 1;
    }
    out
}

struct Bench<'a> {
    rig: &'a Rig,
    noise: f64,
    k_tests: Vec<f64>,
    scatter: Vec<f64>,
    base: Vec<(Run, History)>,
    k0: f64,
    templates: Vec<Vec<Row>>,
}

impl Bench<'_> {
    /// Noise-free rows of all tests under the laws.
    fn truth(&self, laws: &[Law], weigh: bool, k_scale: f64) -> Vec<Vec<Row>> {
        self.rig
            .tests
            .par_iter()
            .enumerate()
            .map(|(t, plan)| {
                let (run, history) = self.rig.run(plan, self.k_tests[t] * k_scale, laws, plan.cycles);
                let mut rows: Vec<Row> =
                    self.templates[t].iter().filter(|r| weigh || r.radius.is_some()).cloned().collect();
                let values = self.rig.observe(&run, &history, &rows, 1.0);
                sigmas(&mut rows, &values, self.noise);
                rows
            })
            .collect()
    }

    /// sqrt of the drop in chi^2 when the cause is known.
    fn detectability(&self, truth: &[Vec<Row>]) -> f64 {
        let (chi2, _) = self.refit(truth);
        (chi2 - detect::penalty(&self.scatter)).max(0.0).sqrt()
    }

    /// chi^2 of the refitted base model and its k per test.
    fn refit(&self, truth: &[Vec<Row>]) -> (f64, Vec<f64>) {
        let blocks: Vec<Vec<Block>> = truth.iter().map(|r| blocks(r)).collect();
        let values: Vec<Vec<f64>> = truth.iter().map(|r| r.iter().map(|x| x.free).collect()).collect();
        let k = self.k_tests.iter().zip(&self.scatter).map(|(k, e)| k / e.exp()).sum::<f64>() / self.k_tests.len() as f64;
        let model = |t: usize, x: f64| {
            let (run, history) = &self.base[t];
            let end = history.cycles[history.cycles.len() - 1];
            let scale = (k * x.exp() / self.k0).min(0.9999 * end / self.rig.tests[t].cycles);
            let values = self.rig.observe(run, history, &truth[t], scale);
            // The base run has k0; its mass and depth depend on k times cycles only.
            values
        };
        let (chi2, x) = detect::refit(&values, &blocks, &model, (REACH * 0.98f64).ln());
        (chi2, x.iter().map(|x| k * x.exp()).collect())
    }

    /// Causes of other names, each alone, by how much of the difference they explain (linearised at the refitted base).
    fn rivals(&self, context: &Context, truth: &[Vec<Row>], own: &[Law], d: &mut Dice) -> Vec<Rival> {
        let (_, k) = self.refit(truth);
        let coarse = self.rig.coarse();
        let run = |laws: &[Law], factor: f64| -> Vec<Vec<f64>> {
            (0..k.len())
                .into_par_iter()
                .map(|t| {
                    let plan = &coarse.tests[t];
                    let (run, history) = coarse.run(plan, k[t] * factor, laws, plan.cycles);
                    coarse.observe(&run, &history, &truth[t], 1.0)
                })
                .collect()
        };
        let blocks: Vec<Vec<Block>> = truth.iter().map(|r| blocks(r)).collect();
        let white = |a: &[Vec<f64>], b: &[Vec<f64>], by: f64| -> Vec<Vec<f64>> {
            (0..a.len())
                .map(|t| detect::whiten(&blocks[t], &a[t].iter().zip(&b[t]).map(|(x, y)| (x - y) / by).collect::<Vec<_>>()))
                .collect()
        };
        let fitted: Vec<Vec<f64>> = (0..k.len())
            .map(|t| {
                let (run, history) = &self.base[t];
                self.rig.observe(run, history, &truth[t], k[t] / self.k0)
            })
            .collect();
        let values: Vec<Vec<f64>> = truth.iter().map(|r| r.iter().map(|x| x.free).collect()).collect();
        let r = white(&values, &fitted, 1.0);
        let base = run(&[], 1.0);
        let by_k = white(&run(&[], 1.1), &base, 1.1f64.ln());
        let none: Vec<Vec<f64>> = r.iter().map(|v| vec![0.0; v.len()]).collect();
        let (all, _) = detect::left_over_white(&r, &by_k, &none);
        let mut best: Vec<Rival> = Vec::new();
        for &(name, form) in CATALOGUE {
            if own.iter().any(|l| l.name == name) {
                continue;
            }
            for _ in 0..2 {
                let law = laws::draw(name, form, context, d);
                let either = ["member_hardness", "profile_slope", "approach_recess", "sliding_speed_exponent", "pressure_exponent",
                    "radial_misalignment", "bearing_compliance", "thermal_expansion"].contains(&name);
                let change = white(&run(std::slice::from_ref(&law), 1.0), &base, 1.0);
                let (left, amplitude) = detect::left_over_white(&r, &by_k, &change);
                let left = if amplitude < 0.0 && !either { all } else { left };
                let rival = Rival { name, form, share: 1.0 - left / all.max(1e-9), left };
                match best.iter_mut().find(|b| b.name == name) {
                    Some(b) if b.share < rival.share => *b = rival,
                    Some(_) => {}
                    None => best.push(rival),
                }
            }
        }
        best.sort_by(|a, b| b.share.total_cmp(&a.share));
        best.truncate(5);
        best
    }
}

/// Tries draws until the data are of the wanted sort.
pub fn make(wish: &Wish) -> DataSet {
    let root = Dice::new(wish.seed).branch(wish.index);
    let mut attempt = 0;
    loop {
        attempt += 1;
        if let Some(set) = try_make(wish, &root, attempt) {
            return set;
        }
        assert!(attempt < 60, "no usable draw for {wish:?}");
    }
}

fn try_make(wish: &Wish, root: &Dice, attempt: usize) -> Option<DataSet> {
    // The plan of the set does not change between attempts, the gears and causes do.
    let mut plan = root.branch(0);
    let u = plan.unit();
    let of_law = wish.law.as_ref().map(|(name, form)| match laws::class_of(name, form.as_deref()) {
        Class::Single => Kind::Single,
        Class::Foreign => Kind::Foreign,
        Class::Outside => Kind::Outside,
    });
    let kind = wish.kind.or(of_law).unwrap_or(if u < 0.3 {
        Kind::None
    } else if u < 0.45 {
        Kind::Single
    } else if u < 0.7 {
        Kind::Foreign
    } else if u < 0.85 {
        Kind::Outside
    } else {
        Kind::Pair
    });
    let noise = wish.noise.unwrap_or(*plan.pick(&[0.02, 0.05, 0.1]));
    let paper = wish.paper.unwrap_or(plan.unit() < 0.3);
    let target = plan.log_uniform(3.0, 50.0);
    let scatter = match kind {
        Kind::None => *plan.pick(&[0.1, 0.2, 0.3]),
        _ => *plan.pick(&[0.0, 0.1, 0.2, 0.3]),
    };
    let datum = *plan.pick(&[0.0, 0.3]);
    let mut choice = root.branch(1000 + attempt as u64);
    let named: Vec<(&'static str, &'static str)> = names(wish, kind, &mut choice);

    let mut d = root.branch(attempt as u64);
    let mut rig = Rig::draw(paper, kind == Kind::Outside, &mut d);
    if named.iter().any(|n| ["pressure_exponent", "micropitting", "plastic_deformation"].contains(&n.0)) {
        rig.fine.cells_per_half_width = 10.0;
    }
    let depth = d.log_uniform(3.0, 15.0);
    // A first guess of k from the start of contact, corrected with the base histories.
    let pair = Mating::new(&rig.pinion, &rig.gear, rig.centre);
    let a = &rig.tests[0];
    let w = 1e3 * a.conditions.torque / (rig.width * rig.pinion.rb);
    let sr = (pair.rho(1, pair.start) * pair.pinion.z as f64 / pair.gear.z as f64 / pair.rho(0, pair.start) - 1.0).abs();
    let mut k0 = 1e-3 * depth / (0.4 * w * sr * a.cycles);
    let (first_run, first) = rig.run(a, k0, &[], a.cycles * 3.0);
    let (mut lo, mut hi) = (0.0, 3.0);
    for _ in 0..40 {
        let mid = 0.5 * (lo + hi);
        if rig.deepest(a, &first_run, &first, mid * a.cycles) < depth { lo = mid } else { hi = mid }
    }
    k0 *= lo;
    let k = three_digits(k0);
    if k <= 0.0 {
        return None;
    }
    let base: Vec<(Run, History)> = rig.tests.par_iter().map(|p| rig.run(p, k, &[], p.cycles * REACH)).collect();
    let deepest = base.iter().zip(&rig.tests).map(|(b, p)| rig.deepest(p, &b.0, &b.1, p.cycles)).fold(0.0, f64::max);
    if deepest > 22.0 {
        return None;
    }
    let e: Vec<f64> = rig.tests.iter().map(|_| scatter * d.normal()).collect();
    let k_tests: Vec<f64> = e.iter().map(|v| k * v.exp()).collect();
    let templates = rig.tests.iter().enumerate().map(|(t, p)| rig.rows(p, t)).collect();
    let bench = Bench {
        rig: &rig,
        noise,
        k_tests: k_tests.clone(),
        scatter: e,
        k0: k,
        base,
        templates,
    };
    let context = context(&rig, &pair, &bench);
    let (mut found, rows, dd, d_each) = strength(&bench, &context, &named, target, kind, &mut d)?;
    let top = rows.iter().flatten().filter(|r| r.radius.is_some()).map(|r| r.free).fold(0.0, f64::max);
    if !(1.8..26.0).contains(&top) {
        return None;
    }
    let rivals = if wish.rivals && !found.is_empty() {
        bench.rivals(&context, &rows, &found, &mut root.branch(31))
    } else {
        Vec::new()
    };
    let weigh = !found.iter().any(Law::moves_material);
    let (run, history) = rig.run(&rig.sealed, k, &found, rig.sealed.cycles);
    let mut sealed: Vec<Row> = rig.rows(&rig.sealed, rig.tests.len()).into_iter().filter(|r| weigh || r.radius.is_some()).collect();
    let values = rig.observe(&run, &history, &sealed, 1.0);
    sigmas(&mut sealed, &values, noise);
    for r in &mut sealed {
        r.value = r.free;
        r.trace.clear();
    }
    let mut rows: Vec<Row> = rows.into_iter().flatten().collect();
    let mut dice = root.branch(77 + attempt as u64 * 131);
    let mut datums: Vec<(String, f64)> = Vec::new();
    for r in &mut rows {
        let mut offset = 0.0;
        if r.radius.is_some() {
            if datums.last().is_none_or(|l| l.0 != r.trace) {
                datums.push((r.trace.clone(), ((datum * dice.normal()) * 1e4).round() / 1e4));
            }
            offset = datums[datums.len() - 1].1;
        }
        r.value = r.free + offset + r.sigma * dice.normal();
    }
    if wish.outlier {
        let name = datums[dice.below(datums.len())].0.clone();
        let tilt = dice.uniform(4.0, 9.0) * dice.sign();
        let list: Vec<usize> = (0..rows.len()).filter(|&i| rows[i].trace == name).collect();
        for (q, &i) in list.iter().enumerate() {
            let x = q as f64 / (list.len() - 1) as f64;
            rows[i].value += tilt * rows[i].sigma * (0.4 + x);
        }
    }
    if wish.missing > 0.0 {
        rows.retain(|r| r.radius.is_none() || dice.unit() >= wish.missing);
    }
    for r in &mut rows {
        r.sigma /= wish.understate;
    }
    found.iter_mut().for_each(|l| l.limit = 0.0);
    let wrong = d.uniform(0.5f64.ln(), 1.5f64.ln()).exp();
    drop(bench);
    Some(DataSet {
        wish: wish.clone(),
        kind,
        noise,
        laws: found,
        k,
        k_study: three_digits(k * wrong),
        scatter,
        k_tests,
        datum,
        datums,
        rows,
        sealed,
        d: dd,
        d_each,
        attempts: attempt,
        rivals,
        rig,
    })
}

fn names(wish: &Wish, kind: Kind, d: &mut Dice) -> Vec<(&'static str, &'static str)> {
    let known = |class: Class, d: &mut Dice| {
        // Effects with equal chance, then their forms.
        let mut list: Vec<&'static str> = Vec::new();
        let sort = |n: &str, f: &str| {
            let first = CATALOGUE.iter().find(|c| c.0 == n).is_some_and(|c| c.1 == f);
            if first { Class::Single } else { Class::Foreign }
        };
        for c in CATALOGUE {
            if sort(c.0, c.1) == class && !list.contains(&c.0) {
                list.push(c.0);
            }
        }
        let name = *d.pick(&list);
        let forms: Vec<_> = CATALOGUE.iter().filter(|c| c.0 == name && sort(c.0, c.1) == class).collect();
        **d.pick(&forms)
    };
    if let Some((name, form)) = &wish.law {
        let all = CATALOGUE.iter().copied().chain(OUTSIDE.iter().map(|&n| (n, "own")));
        let fits: Vec<_> = all.filter(|c| c.0 == name && form.as_ref().is_none_or(|f| f == c.1)).collect();
        assert!(!fits.is_empty(), "no law named {name}");
        return vec![*d.pick(&fits)];
    }
    match kind {
        Kind::None => Vec::new(),
        Kind::Single => vec![known(Class::Single, d)],
        Kind::Foreign => vec![known(Class::Foreign, d)],
        Kind::Outside => vec![(*d.pick(OUTSIDE), "own")],
        Kind::Pair => loop {
            let any = |d: &mut Dice| known(if d.unit() < 0.5 { Class::Single } else { Class::Foreign }, d);
            let (a, b) = (any(d), any(d));
            if a.0 != b.0 {
                return vec![a, b];
            }
        },
    }
}

fn context(rig: &Rig, pair: &Mating, bench: &Bench) -> Context {
    let a = &rig.tests[0];
    let (run, history) = &bench.base[0];
    let state = history.at(a.cycles);
    let worn = run.worn_area(&state);
    let ratio = pair.pinion.z as f64 / pair.gear.z as f64;
    let w = run.line_load();
    let omega = a.conditions.speed * std::f64::consts::PI / 30.0;
    let speeds = |s: f64| [omega * pair.rho(0, s) * 1e-3, omega * ratio * pair.rho(1, s) * 1e-3];
    let (r, _, _) = run.passage.hertz(0.0, w);
    let (_, p0, _) = run.passage.hertz(pair.end - pair.pb, w);
    let (_, _, half) = run.passage.hertz(pair.start, 0.4 * w);
    Context {
        pair: pair.clone(),
        module: rig.pinion.m,
        torque: a.conditions.torque,
        speed: a.conditions.speed,
        cycles: a.cycles,
        depth: rig.deepest(a, run, history, a.cycles),
        p0,
        load: w,
        film: laws::film(w, r, speeds(0.0), run.passage.e_star, &a.conditions),
        flash: laws::flash(0.4 * w, speeds(pair.start), half, a.conditions.friction).max(0.5),
        worn: worn[0] + worn[1] / ratio,
    }
}

type Found = (Vec<Law>, Vec<Vec<Row>>, f64, Vec<f64>);

/// Scales the causes to the wanted detectability.
fn strength(
    bench: &Bench,
    context: &Context,
    named: &[(&'static str, &'static str)],
    target: f64,
    kind: Kind,
    d: &mut Dice,
) -> Option<Found> {
    if named.is_empty() {
        let rows = bench.truth(&[], true, 1.0);
        let seen = bench.detectability(&rows);
        return Some((Vec::new(), rows, seen, Vec::new()));
    }
    let mut laws = Vec::new();
    for &(name, form) in named {
        let mut law = laws::draw(name, form, context, d);
        let weigh = !law.moves_material();
        // Pairs: each cause is strong enough by itself.
        let aim = if kind == Kind::Pair { target.max(12.0) } else { target };
        let (mut low, mut high): (Option<(f64, f64)>, Option<(f64, f64)>) = (None, None);
        let mut ok = false;
        for _ in 0..8 {
            let a = law.strength().abs();
            let seen = bench.detectability(&bench.truth(std::slice::from_ref(&law), weigh, 1.0)).max(1e-3);
            if (seen / aim).ln().abs() < 0.1 {
                ok = true;
                break;
            }
            if seen < aim { low = Some((a, seen)) } else { high = Some((a, seen)) }
            let next = match (low, high) {
                (Some((a0, d0)), Some((a1, d1))) => {
                    // Between in log-log, kept off the ends.
                    let f = ((aim.ln() - d0.ln()) / (d1.ln() - d0.ln())).clamp(0.1, 0.9);
                    (a0.ln() + f * (a1.ln() - a0.ln())).exp()
                }
                _ => a * (aim / seen).clamp(0.1, 5.0),
            };
            let capped = next.min(law.limit);
            if capped >= law.limit && a >= law.limit * 0.999 {
                // As strong as it makes sense; take it if it can be seen at all.
                ok = seen >= 3.0;
                break;
            }
            law = law.with_strength(capped * law.strength().signum());
        }
        if !ok {
            return None;
        }
        laws.push(law);
    }
    let weigh = !laws.iter().any(Law::moves_material);
    let rows = bench.truth(&laws, weigh, 1.0);
    let seen = bench.detectability(&rows);
    let mut each = vec![seen];
    if laws.len() == 2 {
        each = (0..2).map(|x| given(bench, &laws, x, &rows, weigh)).collect();
        if each.iter().any(|&v| v < 3.0) {
            return None;
        }
    }
    Some((laws, rows, seen, each))
}

/// Detectability of cause x when the other one is known: k and the other's strength refitted, linearised.
fn given(bench: &Bench, laws: &[Law], x: usize, both: &[Vec<Row>], weigh: bool) -> f64 {
    let other = &laws[1 - x];
    let free = |rows: Vec<Vec<Row>>| -> Vec<Vec<f64>> { rows.iter().map(|r| r.iter().map(|v| v.free).collect()).collect() };
    let difference = |a: &[Vec<f64>], b: &[Vec<f64>], by: f64| -> Vec<Vec<f64>> {
        a.iter().zip(b).map(|(a, b)| a.iter().zip(b).map(|(p, q)| (p - q) / by).collect()).collect()
    };
    let one = std::slice::from_ref(other);
    let alone = free(bench.truth(one, weigh, 1.0));
    let by_k = difference(&free(bench.truth(one, weigh, 1.1)), &alone, 1.1f64.ln());
    let stronger = other.with_strength(other.strength() * 1.1);
    let by_a = difference(&free(bench.truth(&[stronger], weigh, 1.0)), &alone, 0.1);
    let blocks: Vec<Vec<Block>> = both.iter().map(|r| blocks(r)).collect();
    let r = difference(&free(both.to_vec()), &alone, 1.0);
    detect::left_over(&r, &blocks, &by_k, &by_a).0.sqrt()
}
