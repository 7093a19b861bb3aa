//! Draws a data set: gears, tests, the hidden cause and its strength, noise.

use clap::ValueEnum;
use rayon::prelude::*;

use crate::bench::{self, Bench, Rival};
use crate::dice::Dice;
use crate::draw::{self, CATALOGUE, OUTSIDE};
use crate::involute::Mating;
use crate::laws::{Class, Law};
use crate::messy;
use crate::observe::{Quantity, Row};
use crate::rig::Rig;
use crate::trace::{Column, Trace};
use crate::uneven::{self, Uneven};
use crate::wear::{History, Run};

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Kind {
    None,
    Single,
    Foreign,
    Outside,
    Pair,
    /// A known cause in any form beside one that the catalogue lacks.
    Mixed,
    /// Three causes of the catalogue, in any form.
    Three,
    /// Leads that differ across the face.
    Face,
    /// Teeth of a member that differ.
    Teeth,
    /// Friction, inertia and work: causes that act through forces.
    Force,
}

impl Kind {
    pub fn name(self) -> &'static str {
        [
            "none", "single", "foreign", "outside", "pair", "mixed", "three", "face", "teeth",
            "force",
        ][self as usize]
    }

    pub fn named(name: &str) -> Option<Self> {
        Self::value_variants()
            .iter()
            .copied()
            .find(|k| k.name() == name)
    }
}

#[derive(Clone, Debug, Default)]
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
    /// As a real measuring room hands them over.
    pub messy: bool,
    /// Also find the catalogue's causes that explain most of the difference.
    pub rivals: bool,
    /// Where across the face traces are taken, for causes that act there.
    pub trace: Option<Trace>,
    /// Whether the file says which place or tooth was measured.
    pub stated: Option<bool>,
    /// Also measure transmission error, load share and mean lag.
    pub mesh: bool,
    /// Wanted detectability.
    pub d: Option<f64>,
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
    /// Where across the face traces were taken, if that was of concern.
    pub trace: Option<Trace>,
    pub column: Column,
}

fn three_digits(v: f64) -> f64 {
    format!("{v:.2e}").parse().unwrap_or(v)
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

/// What a set shall be like; the same in every attempt.
struct Intent {
    kind: Kind,
    noise: f64,
    paper: bool,
    /// Wanted detectability.
    target: f64,
    scatter: f64,
    datum: f64,
}

impl Intent {
    fn of(wish: &Wish, root: &Dice) -> Self {
        let mut plan = root.branch(0);
        let u = plan.unit();
        let drawn = match u {
            _ if u < 0.3 => Kind::None,
            _ if u < 0.45 => Kind::Single,
            _ if u < 0.7 => Kind::Foreign,
            _ if u < 0.85 => Kind::Outside,
            _ => Kind::Pair,
        };
        let kind = wish.kind.or(kind_of_law(wish)).unwrap_or(drawn);
        let noise = wish.noise.unwrap_or(*plan.pick(&[0.02, 0.05, 0.1]));
        let paper = wish.paper.unwrap_or(plan.unit() < 0.3);
        let target = plan.log_uniform(3.0, 50.0);
        Self {
            kind,
            noise,
            paper,
            target: wish.d.unwrap_or(target),
            scatter: match kind {
                Kind::None => *plan.pick(&[0.1, 0.2, 0.3]),
                _ => *plan.pick(&[0.0, 0.1, 0.2, 0.3]),
            },
            datum: *plan.pick(&[0.0, 0.3]),
        }
    }
}

fn kind_of_law(wish: &Wish) -> Option<Kind> {
    let (name, form) = wish.law.as_ref()?;
    let force = |c: &&(&str, &str)| c.0 == name && form.as_deref() == Some(c.1);
    Some(match draw::class_of(name, form.as_deref()) {
        _ if uneven::FACE.iter().any(|c| c.0 == name) => Kind::Face,
        _ if uneven::TEETH.iter().any(|c| c.0 == name) => Kind::Teeth,
        _ if draw::FORCE.iter().any(|c| force(&c)) => Kind::Force,
        Class::Single => Kind::Single,
        Class::Foreign => Kind::Foreign,
        Class::Outside => Kind::Outside,
    })
}

/// The wear coefficient with which the reference test's base history is so deep (um) at its end, mm^2/N.
fn coefficient(rig: &Rig, pair: &Mating, depth: f64) -> f64 {
    // A first guess from the start of contact.
    let a = &rig.tests[0];
    let w = 1e3 * a.conditions.torque / (rig.width * rig.pinion.rb);
    let sr = (pair.rho(1, pair.start) * pair.pinion.z as f64
        / pair.gear.z as f64
        / pair.rho(0, pair.start)
        - 1.0)
        .abs();
    let guess = 1e-3 * depth / (0.4 * w * sr * a.cycles);
    let (run, history) = rig.run(a, guess, &[], a.cycles * 3.0);
    let (mut lo, mut hi) = (0.0, 3.0);
    for _ in 0..40 {
        let mid = 0.5 * (lo + hi);
        if rig.deepest(a, &run, &history, mid * a.cycles) < depth {
            lo = mid
        } else {
            hi = mid
        }
    }
    three_digits(guess * lo)
}

/// One more test, without noise.
fn sealed(rig: &Rig, k: f64, laws: &[Law], noise: f64) -> Vec<Row> {
    let weigh = !laws.iter().any(Law::moves_material);
    let (run, history) = rig.run(&rig.sealed, k, laws, rig.sealed.cycles);
    let mut rows = rig.rows(&rig.sealed, rig.tests.len());
    rows.retain(|r| weigh || r.quantity != Quantity::Mass);
    let values = rig.observe(&run, &history, &rows, 1.0);
    bench::sigmas(&mut rows, &values, noise);
    for r in &mut rows {
        r.value = r.free;
        r.trace.clear();
    }
    rows
}

/// What a wish spoils of measured rows.
fn spoil(wish: &Wish, rows: &mut Vec<Row>, datums: &[(String, f64)], root: &Dice, dice: &mut Dice) {
    if wish.outlier {
        let name = &datums[dice.below(datums.len())].0;
        let tilt = dice.uniform(4.0, 9.0) * dice.sign();
        let list: Vec<usize> = (0..rows.len())
            .filter(|&i| rows[i].trace == *name)
            .collect();
        for (q, &i) in list.iter().enumerate() {
            let x = q as f64 / (list.len() - 1) as f64;
            rows[i].value += tilt * rows[i].sigma * (0.4 + x);
        }
    }
    if wish.missing > 0.0 {
        rows.retain(|r| r.position.is_none() || dice.unit() >= wish.missing);
    }
    for r in rows.iter_mut() {
        r.sigma /= wish.understate;
    }
    if wish.messy {
        messy::spoil(rows, &mut root.branch(53));
    }
}

fn try_make(wish: &Wish, root: &Dice, attempt: usize) -> Option<DataSet> {
    let intent = Intent::of(wish, root);
    let (kind, noise, scatter) = (intent.kind, intent.noise, intent.scatter);
    let mut choice = root.branch(1000 + attempt as u64);
    let named: Vec<(&'static str, &'static str)> = names(wish, kind, &mut choice);

    let mut d = root.branch(attempt as u64);
    // The pair 27/53 has no even number of teeth.
    let paper = intent.paper && !named.contains(&("pitch_error", "alternate"));
    let mut rig = Rig::draw(paper, matches!(kind, Kind::Outside | Kind::Mixed), &mut d);
    let mut look = root.branch(4);
    let (trace, stated) = (Trace::draw(&mut look), look.unit() < 0.5);
    let (trace, stated) = (wish.trace.unwrap_or(trace), wish.stated.unwrap_or(stated));
    let choice = Uneven::draw(&named, &rig, &mut look)?;
    // Asked for, places are stated of any cause, and of none.
    let across = wish.trace.is_some() || named.iter().any(|n| uneven::FACE.contains(n));
    if across {
        rig.places = trace.places(choice.side);
    }
    rig.mesh = wish.mesh;
    if named
        .iter()
        .any(|n| ["pressure_exponent", "micropitting", "plastic_deformation"].contains(&n.0))
    {
        rig.fine.cells_per_half_width = 10.0;
    }
    let depth = d.log_uniform(3.0, 15.0);
    let pair = Mating::new(&rig.pinion, &rig.gear, rig.centre);
    let k = coefficient(&rig, &pair, depth);
    if k <= 0.0 {
        return None;
    }
    let base: Vec<(Run, History)> = rig
        .tests
        .par_iter()
        .map(|p| rig.run(p, k, &[], p.cycles * bench::REACH))
        .collect();
    let deepest = base
        .iter()
        .zip(&rig.tests)
        .map(|(b, p)| rig.deepest(p, &b.0, &b.1, p.cycles))
        .fold(0.0, f64::max);
    if deepest > 22.0 {
        return None;
    }
    let e: Vec<f64> = rig.tests.iter().map(|_| scatter * d.normal()).collect();
    let k_tests: Vec<f64> = e.iter().map(|v| k * v.exp()).collect();
    let templates = rig
        .tests
        .iter()
        .enumerate()
        .map(|(t, p)| rig.rows(p, t))
        .collect();
    let bench = Bench {
        rig: &rig,
        noise,
        k_tests: k_tests.clone(),
        scatter: e,
        k0: k,
        base,
        templates,
    };
    let context = bench::context(&rig, &pair, &bench, choice);
    let (mut found, rows, dd, d_each) =
        bench::strength(&bench, &context, &named, intent.target, kind, &mut d)?;
    let top = rows
        .iter()
        .flatten()
        .filter(|r| r.is_depth())
        .map(|r| r.free)
        .fold(0.0, f64::max);
    if !(1.8..26.0).contains(&top) {
        return None;
    }
    let rivals = if wish.rivals && !found.is_empty() {
        bench.rivals(&context, &rows, &found, &mut root.branch(31))
    } else {
        Vec::new()
    };
    let sealed = sealed(&rig, k, &found, noise);
    let mut rows: Vec<Row> = rows.into_iter().flatten().collect();
    let mut dice = root.branch(77 + attempt as u64 * 131);
    let mut datums: Vec<(String, f64)> = Vec::new();
    measure(&mut rows, intent.datum, &mut datums, &mut dice);
    spoil(wish, &mut rows, &datums, root, &mut dice);
    found.iter_mut().for_each(|l| l.limit = 0.0);
    let wrong = d.uniform(0.5f64.ln(), 1.5f64.ln()).exp();
    drop(bench);
    let column = Column::of(&named, across, trace, stated);
    Some(DataSet {
        wish: wish.clone(),
        kind,
        noise,
        laws: found,
        k,
        k_study: three_digits(k * wrong),
        scatter,
        k_tests,
        datum: intent.datum,
        datums,
        rows,
        sealed,
        d: dd,
        d_each,
        attempts: attempt,
        rivals,
        trace: across.then_some(trace),
        column,
        rig,
    })
}

/// Values with noise, and a datum for each trace.
pub fn measure(rows: &mut [Row], datum: f64, datums: &mut Vec<(String, f64)>, dice: &mut Dice) {
    for r in rows {
        let mut offset = 0.0;
        if r.has_datum() {
            if datums.last().is_none_or(|l| l.0 != r.trace) {
                datums.push((
                    r.trace.clone(),
                    ((datum * dice.normal()) * 1e4).round() / 1e4,
                ));
            }
            offset = datums[datums.len() - 1].1;
        }
        r.value = r.free + offset + r.sigma * dice.normal();
    }
}

fn names(wish: &Wish, kind: Kind, d: &mut Dice) -> Vec<(&'static str, &'static str)> {
    let known = |class: Class, d: &mut Dice| {
        // Effects with equal chance, then their forms.
        let mut list: Vec<&'static str> = Vec::new();
        let sort = |n: &str, f: &str| {
            let first = CATALOGUE
                .iter()
                .find(|c| c.0 == n)
                .is_some_and(|c| c.1 == f);
            if first { Class::Single } else { Class::Foreign }
        };
        for c in CATALOGUE {
            if sort(c.0, c.1) == class && !list.contains(&c.0) {
                list.push(c.0);
            }
        }
        let name = *d.pick(&list);
        let forms: Vec<_> = CATALOGUE
            .iter()
            .filter(|c| c.0 == name && sort(c.0, c.1) == class)
            .collect();
        **d.pick(&forms)
    };
    if let Some((name, form)) = &wish.law {
        let all = draw::KNOWN
            .iter()
            .copied()
            .flatten()
            .copied()
            .chain(OUTSIDE.iter().map(|&n| (n, "own")));
        let fits: Vec<_> = all
            .filter(|c| c.0 == name && form.as_ref().is_none_or(|f| f == c.1))
            .collect();
        assert!(!fits.is_empty(), "no law named {name}");
        return vec![*d.pick(&fits)];
    }
    let equal = |lists: &[&'static [(&'static str, &'static str)]], d: &mut Dice| {
        let all: Vec<_> = lists.iter().copied().flatten().copied().collect();
        vec![*d.pick(&all)]
    };
    let any = |d: &mut Dice| {
        let class = if d.unit() < 0.5 {
            Class::Single
        } else {
            Class::Foreign
        };
        known(class, d)
    };
    match kind {
        Kind::None => Vec::new(),
        Kind::Single => vec![known(Class::Single, d)],
        Kind::Foreign => vec![known(Class::Foreign, d)],
        Kind::Outside => vec![(*d.pick(OUTSIDE), "own")],
        Kind::Face => equal(&[uneven::FACE], d),
        Kind::Teeth => equal(&[uneven::TEETH], d),
        Kind::Force => equal(&[draw::FORCE], d),
        Kind::Mixed => vec![any(d), (*d.pick(OUTSIDE), "own")],
        Kind::Pair | Kind::Three => {
            let count = if kind == Kind::Pair { 2 } else { 3 };
            let mut drawn: Vec<(&str, &str)> = Vec::new();
            while drawn.len() < count {
                let next = any(d);
                if drawn.iter().all(|known| known.0 != next.0) {
                    drawn.push(next);
                }
            }
            drawn
        }
    }
}
