//! A rig with its base histories: noise-free data under causes, how well a cause can be seen, what else explains it.

use rayon::prelude::*;

use crate::detect::{self, Block, DATUM};
use crate::dice::Dice;
use crate::draw::{self, CATALOGUE, Context};
use crate::involute::Mating;
use crate::laws::{self, Law};
use crate::make::Kind;
use crate::observe::{Quantity, Row};
use crate::passage::Fineness;
use crate::rig::Rig;
use crate::uneven::Uneven;
use crate::wear::{History, Run};

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

/// For comparing causes among themselves.
const COARSE: Fineness = Fineness {
    positions: 36,
    cells_per_half_width: 4.0,
    extent: 4.0,
};

/// How far base histories reach, over the planned cycles at the true k.
pub const REACH: f64 = 2.6;

pub struct Bench<'a> {
    pub rig: &'a Rig,
    pub noise: f64,
    pub k_tests: Vec<f64>,
    pub scatter: Vec<f64>,
    pub base: Vec<(Run, History)>,
    pub k0: f64,
    pub templates: Vec<Vec<Row>>,
}

impl Bench<'_> {
    /// Noise-free rows of all tests under the laws.
    pub fn truth(&self, laws: &[Law], weigh: bool, k_scale: f64) -> Vec<Vec<Row>> {
        self.rig
            .tests
            .par_iter()
            .enumerate()
            .map(|(t, plan)| {
                let (run, history) =
                    self.rig
                        .run(plan, self.k_tests[t] * k_scale, laws, plan.cycles);
                let mut rows: Vec<Row> = self.templates[t]
                    .iter()
                    .filter(|r| weigh || r.quantity != Quantity::Mass)
                    .cloned()
                    .collect();
                let values = self.rig.observe(&run, &history, &rows, 1.0);
                sigmas(&mut rows, &values, self.noise);
                rows
            })
            .collect()
    }

    /// sqrt of the drop in chi^2 when the cause is known.
    pub fn detectability(&self, truth: &[Vec<Row>]) -> f64 {
        let (chi2, _) = self.refit(truth);
        (chi2 - detect::penalty(&self.scatter)).max(0.0).sqrt()
    }

    /// chi^2 of the refitted base model and its k per test.
    pub fn refit(&self, truth: &[Vec<Row>]) -> (f64, Vec<f64>) {
        let blocks: Vec<Vec<Block>> = truth.iter().map(|r| blocks(r)).collect();
        let values: Vec<Vec<f64>> = truth
            .iter()
            .map(|r| r.iter().map(|x| x.free).collect())
            .collect();
        let k = self
            .k_tests
            .iter()
            .zip(&self.scatter)
            .map(|(k, e)| k / e.exp())
            .sum::<f64>()
            / self.k_tests.len() as f64;
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
    pub fn rivals(
        &self,
        context: &Context,
        truth: &[Vec<Row>],
        own: &[Law],
        d: &mut Dice,
    ) -> Vec<Rival> {
        let (_, k) = self.refit(truth);
        let coarse = self.rig.on_grid(COARSE, 2e-3);
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
                .map(|t| {
                    detect::whiten(
                        &blocks[t],
                        &a[t]
                            .iter()
                            .zip(&b[t])
                            .map(|(x, y)| (x - y) / by)
                            .collect::<Vec<_>>(),
                    )
                })
                .collect()
        };
        let fitted: Vec<Vec<f64>> = (0..k.len())
            .map(|t| {
                let (run, history) = &self.base[t];
                self.rig.observe(run, history, &truth[t], k[t] / self.k0)
            })
            .collect();
        let values: Vec<Vec<f64>> = truth
            .iter()
            .map(|r| r.iter().map(|x| x.free).collect())
            .collect();
        let r = white(&values, &fitted, 1.0);
        let base = run(&[], 1.0);
        let by_k = white(&run(&[], 1.1), &base, 1.1f64.ln());
        let (all, _) = detect::left_over_white(&r, &by_k, &[]);
        let mut best: Vec<Rival> = Vec::new();
        for &(name, form) in CATALOGUE {
            if own.iter().any(|l| l.name == name) {
                continue;
            }
            for _ in 0..2 {
                let law = draw::draw(name, form, context, d);
                let either = [
                    "member_hardness",
                    "profile_slope",
                    "approach_recess",
                    "sliding_speed_exponent",
                    "pressure_exponent",
                    "radial_misalignment",
                    "bearing_compliance",
                    "thermal_expansion",
                ]
                .contains(&name);
                let change = white(&run(std::slice::from_ref(&law), 1.0), &base, 1.0);
                let (left, amplitude) = detect::left_over_white(&r, &by_k, &[&change]);
                let left = if amplitude[0] < 0.0 && !either {
                    all
                } else {
                    left
                };
                let rival = Rival {
                    name,
                    form,
                    share: 1.0 - left / all.max(1e-9),
                    left,
                };
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

pub fn sigmas(rows: &mut [Row], values: &[f64], noise: f64) {
    for i in 0..rows.len() {
        let top = |same: &dyn Fn(&Row) -> bool| {
            let list = (0..rows.len()).filter(|&j| same(&rows[j]));
            list.map(|j| values[j].abs()).fold(0.0, f64::max)
        };
        let (own, quantity) = (&rows[i], rows[i].quantity);
        let on_trace = |r: &Row| r.trace == own.trace && r.position.is_some();
        let of_member = |r: &Row| r.quantity == quantity && r.member == own.member;
        let sigma: f64 = match quantity {
            Quantity::Depth => noise * top(&on_trace) + 0.05,
            Quantity::Mass => noise * top(&of_member) + 0.02,
            Quantity::Error => noise * top(&on_trace) + 0.2,
            Quantity::Share => 0.5 * noise + 0.002,
            Quantity::Lag => noise * top(&of_member) + 0.2,
        };
        rows[i].sigma = (sigma * 1e4).round() / 1e4;
        rows[i].free = values[i];
    }
}

fn blocks(rows: &[Row]) -> Vec<Block> {
    let mut out = Vec::new();
    let mut i = 0;
    while i < rows.len() {
        let mut list = vec![i];
        if rows[i].position.is_some() {
            while i + 1 < rows.len()
                && rows[i + 1].position.is_some()
                && rows[i + 1].trace == rows[i].trace
            {
                i += 1;
                list.push(i);
            }
        }
        let at: Vec<f64> = list.iter().filter_map(|&j| rows[j].position).collect();
        let values: Vec<f64> = list.iter().map(|&j| rows[j].free).collect();
        let sigma: Vec<f64> = list.iter().map(|&j| rows[j].sigma).collect();
        let datum = if rows[i].has_datum() { DATUM } else { 0.0 };
        out.push(Block::new(list, &at, &values, &sigma, datum));
        i += 1;
    }
    out
}

pub fn context(rig: &Rig, pair: &Mating, bench: &Bench, uneven: Uneven) -> Context {
    let a = &rig.tests[0];
    let (run, history) = &bench.base[0];
    let state = history.at(a.cycles);
    let worn = run.worn_area(&state);
    let ratio = pair.pinion.z as f64 / pair.gear.z as f64;
    let w = run.line_load();
    let omega = a.conditions.speed * std::f64::consts::PI / 30.0;
    let speeds = |s: f64| {
        [
            omega * pair.rho(0, s) * 1e-3,
            omega * ratio * pair.rho(1, s) * 1e-3,
        ]
    };
    let (r, _, _) = run.passage().hertz(0.0, w);
    let (_, p0, _) = run.passage().hertz(pair.end - pair.pb, w);
    let (_, _, half) = run.passage().hertz(pair.start, 0.4 * w);
    Context {
        pair: pair.clone(),
        module: rig.pinion.m,
        torque: a.conditions.torque,
        speed: a.conditions.speed,
        cycles: a.cycles,
        depth: rig.deepest(a, run, history, a.cycles),
        p0,
        film: laws::film(w, r, speeds(0.0), run.passage().e_star, &a.conditions),
        flash: laws::flash(0.4 * w, speeds(pair.start), half, a.conditions.friction).max(0.5),
        worn: worn[0] + worn[1] / ratio,
        uneven,
    }
}

pub type Found = (Vec<Law>, Vec<Vec<Row>>, f64, Vec<f64>);

/// Scales the causes to the wanted detectability.
pub fn strength(
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
        let mut law = draw::draw(name, form, context, d);
        let weigh = !law.moves_material();
        // Several causes: each is strong enough by itself.
        let aim = if matches!(kind, Kind::Pair | Kind::Mixed | Kind::Three) {
            target.max(12.0)
        } else {
            target
        };
        // (strength, what is seen) below and above the aim.
        let mut low: Option<(f64, f64)> = None;
        let mut high: Option<(f64, f64)> = None;
        let mut ok = false;
        for _ in 0..8 {
            let a = law.strength().abs();
            let seen = bench
                .detectability(&bench.truth(std::slice::from_ref(&law), weigh, 1.0))
                .max(1e-3);
            if (seen / aim).ln().abs() < 0.1 {
                ok = true;
                break;
            }
            if seen < aim {
                low = Some((a, seen))
            } else {
                high = Some((a, seen))
            }
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
    if laws.len() > 1 {
        each = (0..laws.len())
            .map(|x| given(bench, &laws, x, &rows, weigh))
            .collect();
        let least = if kind == Kind::Pair { 3.0 } else { 6.0 };
        if each.iter().any(|&v| v < least) {
            return None;
        }
    }
    Some((laws, rows, seen, each))
}

/// Detectability of cause x when the others are known: k and their strengths refitted, linearised.
fn given(bench: &Bench, laws: &[Law], x: usize, all: &[Vec<Row>], weigh: bool) -> f64 {
    let mut others = laws.to_vec();
    others.remove(x);
    let free = |rows: Vec<Vec<Row>>| -> Vec<Vec<f64>> {
        rows.iter()
            .map(|r| r.iter().map(|v| v.free).collect())
            .collect()
    };
    let difference = |a: &[Vec<f64>], b: &[Vec<f64>], by: f64| -> Vec<Vec<f64>> {
        a.iter()
            .zip(b)
            .map(|(a, b)| a.iter().zip(b).map(|(p, q)| (p - q) / by).collect())
            .collect()
    };
    let without = free(bench.truth(&others, weigh, 1.0));
    let by_k = difference(
        &free(bench.truth(&others, weigh, 1.1)),
        &without,
        1.1f64.ln(),
    );
    let by_strengths: Vec<Vec<Vec<f64>>> = (0..others.len())
        .map(|o| {
            let mut stronger = others.clone();
            stronger[o] = others[o].with_strength(others[o].strength() * 1.1);
            difference(&free(bench.truth(&stronger, weigh, 1.0)), &without, 0.1)
        })
        .collect();
    let blocks: Vec<Vec<Block>> = all.iter().map(|r| blocks(r)).collect();
    let r = difference(&free(all.to_vec()), &without, 1.0);
    detect::left_over(&r, &blocks, &by_k, &by_strengths).sqrt()
}
