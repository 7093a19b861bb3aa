//! Gears, loads and tests of a data set, and its runs.

use std::collections::HashMap;
use std::sync::{Arc, Mutex};

use rayon::prelude::*;

use crate::dice::Dice;
use crate::hidden::{Conditions, Hidden};
use crate::involute::{Mating, Tooth};
use crate::laws::Law;
use crate::layout::Place;
use crate::passage::{Fineness, Passage, Stations};
use crate::ring::{self, FlankCompliance};
use crate::uneven;
use crate::wear::{History, Run};

#[derive(Clone, Debug)]
pub struct Plan {
    pub id: String,
    pub conditions: Conditions,
    pub cycles: f64,
    pub checkpoints: Vec<f64>,
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
    /// Where on the flanks traces are taken.
    pub places: Vec<Place>,
    /// Also measure transmission error, load share and mean lag.
    pub mesh: bool,
    /// Finer for laws that are sharp in the local pressure.
    pub fine: Fineness,
    pub tolerance: f64,
    passages: Mutex<HashMap<(i64, i64, bool), Arc<Passage>>>,
}

fn paper_teeth() -> (Tooth, Tooth) {
    (
        Tooth::new(2.0, 27, 0.0, 12.5),
        Tooth::new(2.0, 53, 0.0, 20.0),
    )
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
        let (b1, b2) = (
            bore(z1, x1, d.uniform(0.4, 0.6)),
            bore(z2, x2, d.uniform(0.3, 0.6)),
        );
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
        if pair.contact_ratio() > 1.32
            && pair.contact_ratio() < 1.85
            && thick(&p)
            && thick(&g)
            && clear
            && tips
        {
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
        let width = if paper {
            33.0
        } else {
            (pinion.m * d.uniform(6.0, 16.0)).round().max(6.0)
        };
        let youngs = 2.1e5;
        let soft = compliances(&pinion, &gear, paper);
        let pair = Mating::new(&pinion, &gear, centre);
        // Load from the Hertz pressure at the pitch point.
        let p0 = if paper {
            d.uniform(750.0, 950.0)
        } else {
            d.uniform(750.0, 1100.0)
        };
        let e_star = youngs / (2.0 * (1.0 - ring::NU * ring::NU));
        let r = pair.c1 * pair.c2 / (pair.c1 + pair.c2);
        let w = p0 * p0 * std::f64::consts::PI * r / e_star;
        let tidy = |v: f64| {
            let unit = 10f64.powf(v.log10().floor() - 1.0);
            (v / unit).round() * unit
        };
        let torque = tidy(w * width * pinion.rb * 1e-3);
        let speed = tidy(if paper {
            *d.pick(&[1000.0, 1500.0, 2000.0, 2500.0])
        } else {
            d.log_uniform(400.0, 3500.0)
        });
        let cycles = tidy(d.log_uniform(3e5, 3e6));
        let shift = if paper {
            d.uniform(0.3, 0.8)
        } else {
            pinion.m * d.uniform(0.08, 0.25)
        };
        let mut shift = (shift * 100.0).round() / 100.0;
        while Mating::new(&pinion, &gear, centre + shift).contact_ratio() < 1.2 {
            shift = (shift * 50.0).round() / 100.0;
        }
        let viscosity = if paper {
            0.015
        } else {
            (d.log_uniform(0.008, 0.08) * 1e3).round() / 1e3
        };
        let roughness = if paper {
            0.5
        } else {
            (d.log_uniform(0.25, 1.0) * 100.0).round() / 100.0
        };
        let tidy_checks = |d: &mut Dice| {
            let lists: [&[f64]; 4] = [
                &[0.1, 0.25, 0.5, 0.75, 1.0],
                &[0.05, 0.2, 0.5, 1.0],
                &[0.15, 0.4, 0.7, 1.0],
                &[0.1, 0.4, 1.0],
            ];
            let some = d.pick(&lists).to_vec();
            if many { lists[0].to_vec() } else { some }
        };
        let fractions = tidy_checks(d);
        let conditions = |t: f64, n: f64, mis: f64| Conditions {
            torque: tidy(torque * t),
            speed: tidy(speed * n),
            misalignment: mis,
            bulk: 60.0,
            viscosity,
            pressure_viscosity: 18.0,
            roughness,
            friction: 0.06,
        };
        let count = 3 + d.below(3);
        // Reference first; then load, speed and misalignment always come before repeats.
        let up = d.uniform(1.35, 1.9);
        let slow = d.uniform(0.2, 0.4);
        let mut list = vec![
            (1.0, 1.0, 0.0, 1.0),
            (up, 1.0, 0.0, d.uniform(0.6, 0.9)),
            (1.0, slow, 0.0, d.uniform(0.5, 1.0)),
        ];
        if count > 3 {
            list.push((up, 1.0, shift, d.uniform(0.6, 1.0)));
        }
        if count > 4 {
            list.push((
                d.uniform(0.45, 0.7),
                d.uniform(1.2, 2.0),
                0.0,
                d.uniform(0.8, 1.3),
            ));
        }
        let tests = list
            .iter()
            .enumerate()
            .map(|(i, &(t, n, mis, c))| {
                let cycles = tidy(cycles * c);
                Plan {
                    id: char::from(b'A' + i as u8).to_string(),
                    conditions: conditions(t, n, mis),
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
            places: vec![Place::Usual],
            mesh: false,
            fine: Fineness::default(),
            tolerance: 4e-4,
            passages: Mutex::new(HashMap::new()),
        }
    }

    /// The same rig on another grid.
    pub fn on_grid(&self, fine: Fineness, tolerance: f64) -> Self {
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
            places: self.places.clone(),
            mesh: self.mesh,
            fine,
            tolerance,
            passages: Mutex::new(HashMap::new()),
        }
    }

    fn passage(&self, centre: f64, load: f64, friction: bool) -> Arc<Passage> {
        let key = (
            (centre * 1e6).round() as i64,
            (load * 1e6).round() as i64,
            friction,
        );
        let mut map = self
            .passages
            .lock()
            .unwrap_or_else(std::sync::PoisonError::into_inner);
        map.entry(key)
            .or_insert_with(|| Arc::new(self.new_passage(centre, load, None, friction)))
            .clone()
    }

    fn new_passage(
        &self,
        centre: f64,
        load: f64,
        shared: Option<&[Stations; 2]>,
        friction: bool,
    ) -> Passage {
        let pair = Mating::new(&self.pinion, &self.gear, centre);
        Passage::new(
            pair,
            &self.soft,
            self.youngs,
            load,
            self.fine,
            shared,
            friction,
        )
    }

    pub fn set_up(&self, plan: &Plan, k: f64, laws: &[Law]) -> Run {
        let load = 1e3 * plan.conditions.torque / (self.width * self.pinion.rb);
        let shift: f64 = laws.iter().map(|l| l.shift(&plan.conditions, load)).sum();
        let centre = self.centre + plan.conditions.misalignment + shift;
        let friction = laws.iter().any(|l| l.has_friction());
        let first = self.passage(centre, load, friction);
        let places = (first.positions.iter()).flat_map(|at| at.slots.iter().map(|s| s.j));
        let near = places.clone().min().unwrap_or(0)..=places.max().unwrap_or(0);
        let moved = laws.iter().map(uneven::centres).find(|c| c.len() > 1);
        let passages = match moved {
            None => vec![first],
            Some(moved) => moved
                .par_iter()
                .map(|a| {
                    Arc::new(self.new_passage(centre + a, load, Some(&first.stations), friction))
                })
                .collect(),
        };
        let hidden: Vec<Box<dyn Hidden>> = laws
            .iter()
            .map(|l| Box::new(l.clone()) as Box<dyn Hidden>)
            .collect();
        Run {
            passages,
            layout: uneven::layout(laws, [self.pinion.z, self.gear.z], near),
            conditions: plan.conditions.clone(),
            width: self.width,
            k,
            hidden: Arc::new(hidden),
            tolerance: self.tolerance,
        }
    }

    pub fn run(&self, plan: &Plan, k: f64, laws: &[Law], cycles: f64) -> (Run, History) {
        let run = self.set_up(plan, k, laws);
        let start = std::time::Instant::now();
        let history = run.run(cycles);
        if std::env::var("BLIND_COST").is_ok() {
            eprintln!(
                "{} {:?} steps {} evaluations {} stations {:?} cells {} {:.2?}",
                plan.id,
                laws.iter().map(|l| l.name).collect::<Vec<_>>(),
                history.cycles.len(),
                history.evaluations,
                run.passage()
                    .stations
                    .iter()
                    .map(|s| s.count)
                    .collect::<Vec<_>>(),
                run.passage().positions[0].cells.len(),
                start.elapsed()
            );
        }
        (run, history)
    }
}

fn compliances(p: &Tooth, g: &Tooth, paper: bool) -> Arc<[FlankCompliance; 2]> {
    static PAPER: Mutex<Option<Arc<[FlankCompliance; 2]>>> = Mutex::new(None);
    let make = || Arc::new([ring::compliance(p, 1), ring::compliance(g, 1)]);
    if !paper {
        return make();
    }
    let mut kept = PAPER
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner);
    kept.get_or_insert_with(make).clone()
}
