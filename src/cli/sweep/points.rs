//! The points of a sweep: one study each, checked before anything runs; meshes and compliances shared by the points that differ
//! in operation, wear, effects or oil alone.

use std::collections::BTreeMap;
use std::fs;

use rayon::prelude::*;

use super::figures::Figures;
use super::grid::{self, Axis};
use super::kept::Kept;
use super::{CliError, Progress};
use crate::report::OutputError;
use crate::simulate::checkpoint::{Checkpoint, fingerprint};
use crate::simulate::forward::{ContactKind, ForwardError, GearSet};
use crate::simulate::members::Members;
use crate::simulate::paper_run;
use crate::simulate::run::{Event, Observer, Plan, RunError, run};
use crate::source_text::Fault;
use crate::study::{self, KEYS, Study, nearest};

/// Most points of a sweep.
const MOST: usize = 100_000;

/// Tables whose keys change no run at the study's own operation.
const IDLE: [&str; 5] = ["", "fit", "noise", "test", "measurements"];

/// Tables inside others, no keys.
const MEMBERS: [&str; 2] = ["pinion", "gear"];

/// One point.
pub(super) struct Point {
    /// Its values, axis by axis.
    pub values: Vec<String>,
    /// What its figures depend on, as a hash.
    pub key: String,
    /// Its study, or why its values make none: gears that jam, a misalignment that pulls them apart.
    study: std::result::Result<Study, String>,
    /// Points with equal bodies share meshes and compliance.
    bodies: String,
}

impl Point {
    /// Whether its values make a pair that can run.
    pub(super) fn is_possible(&self) -> bool {
        self.study.is_ok()
    }
}

/// Figures of a point, or why there are none.
pub(super) type Result = std::result::Result<Figures, String>;

/// Every combination of the axes' values, the last axis fastest, each as a valid study or the reason why it is none.
///
/// # Errors
/// [`CliError`] for a key that does not exist, for values that it never takes, and if no combination makes a valid study.
pub(super) fn prepare(study: &Study, axes: &[Axis]) -> std::result::Result<Vec<Point>, CliError> {
    for (i, axis) in axes.iter().enumerate() {
        check_key(study, &axis.key)?;
        if axes[..i].iter().any(|other| other.key == axis.key) {
            let message = format!("--vary {}: the key is varied twice", axis.key);
            return Err(CliError::Unusable(message));
        }
    }
    let count = axes.iter().map(|axis| axis.values.len()).product::<usize>();
    if count > MOST {
        let message = format!("--vary: {count} combinations, at most {MOST} are possible");
        return Err(CliError::Unusable(message));
    }
    let mut points = Vec::with_capacity(count);
    for number in 0..count {
        let mut rest = number;
        let mut values = vec![String::new(); axes.len()];
        for (value, axis) in values.iter_mut().zip(axes).rev() {
            *value = axis.values[rest % axis.values.len()].clone();
            rest /= axis.values.len();
        }
        points.push(point(study, axes, values)?);
    }
    if points.iter().all(|point| !point.is_possible()) {
        let why = points.iter().find_map(|point| point.study.as_ref().err());
        return Err(CliError::Unusable(why.cloned().unwrap_or_default()));
    }
    // the mesh depends on all loads that it has to resolve, so these belong to each point's key
    let mut loads: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for point in &points {
        let Ok(study) = &point.study else { continue };
        let (torque, misalignment) = load(study);
        let all = loads.entry(point.bodies.clone()).or_default();
        all.push(format!("{torque:?} {misalignment:?}"));
    }
    for all in loads.values_mut() {
        all.sort_unstable();
        all.dedup();
    }
    for point in &mut points {
        let Ok(study) = &point.study else { continue };
        let parts = [
            study.text().as_bytes(),
            point.bodies.as_bytes(),
            &loads[&point.bodies].join(",").into_bytes(),
        ];
        let hash = fingerprint(&parts);
        point.key = hash[..16].iter().map(|b| format!("{b:02x}")).collect();
    }
    Ok(points)
}

fn check_key(study: &Study, key: &str) -> std::result::Result<(), CliError> {
    if key == "wear.coefficient" && study.wear.members != [1.0; 2] {
        return Err(CliError::Unusable(format!(
            "--vary {key}: members state their own; vary wear.pinion.coefficient or wear.gear.coefficient"
        )));
    }
    let mut of_tables = Vec::new();
    for (table, keys) in KEYS.iter().filter(|(table, _)| !IDLE.contains(table)) {
        // what is said of one member can be said of the other
        let homes: &[&str] = match *table {
            "gears.pinion" => &["gears.pinion", "gears.gear"],
            "wear.pinion" => &["wear.pinion", "wear.gear"],
            "material" => &["material", "material.pinion", "material.gear"],
            table => &[table],
        };
        let plain = keys.iter().filter(|key| !MEMBERS.contains(key));
        of_tables
            .extend(plain.flat_map(|key| homes.iter().map(move |home| format!("{home}.{key}"))));
    }
    let of_effects: Vec<&str> = study
        .effect_model()
        .parameters()
        .map(|parameter| parameter.name.as_str())
        .collect();
    let all = || {
        let names = of_tables.iter().map(String::as_str);
        names.chain(of_effects.iter().copied())
    };
    if all().any(|name| name == key) {
        return Ok(());
    }
    if let Some((kind, _)) = key.split_once('.')
        && crate::effects::CATALOGUE
            .iter()
            .any(|card| card.name == kind)
        && !of_effects
            .iter()
            .any(|name| name.starts_with(&format!("{kind}.")))
    {
        return Err(CliError::Unusable(format!(
            "--vary {key}: the study has no effect {kind}; put [[effect]] with kind = \"{kind}\" into it, or take the study that `gearwear add` \
             writes"
        )));
    }
    let last = key.rsplit('.').next().unwrap_or(key);
    let same_end = all().find(|name| !key.contains('.') && name.rsplit('.').next() == Some(last));
    let near = match same_end.or_else(|| nearest(key, all())) {
        Some(near) => format!("; the nearest valid key is `{near}`"),
        None => format!(
            "; valid are the keys of the tables [{}] and the parameters of the study's effects, such as operation.torque",
            KEYS.iter()
                .map(|(table, _)| *table)
                .filter(|table| !IDLE.contains(table) && *table != "effect")
                .collect::<Vec<_>>()
                .join("], [")
        ),
    };
    Err(CliError::Unusable(format!(
        "--vary {key}: no such key to vary{near}"
    )))
}

fn point(
    study: &Study,
    axes: &[Axis],
    values: Vec<String>,
) -> std::result::Result<Point, CliError> {
    let shown: Vec<String> = axes
        .iter()
        .zip(&values)
        .map(|(axis, value)| format!("{}={value}", axis.key))
        .collect();
    let said = |why: &dyn std::fmt::Display| {
        let why = why.to_string();
        let why = why.strip_prefix("error: ").unwrap_or(&why);
        format!("--vary {}: {why}", shown.join(" "))
    };
    let failed = |why: &dyn std::fmt::Display| CliError::Unusable(said(why));
    let mut edit = study.edit();
    for (axis, value) in axes.iter().zip(&values) {
        let of_effect = study.effect_model().parameter(&axis.key).is_some();
        if of_effect {
            let number = value.parse::<f64>().ok().filter(|v| v.is_finite());
            let number = number.ok_or_else(|| failed(&"the value of a parameter is a number"))?;
            edit.set(&axis.key, number);
        } else if !edit.put(&axis.key, &grid::toml(value)) {
            let why = "the study states its table in a form that cannot be changed; write it with a header";
            return Err(failed(&why));
        }
    }
    // values that are right one by one and impossible together belong into the table
    let (study, bodies) = match edit.finish(&study.source().name) {
        Ok(study) => {
            let bodies = bodies(&study)?;
            (Ok(study), bodies)
        }
        Err(error) if error.diagnostic().fault == Fault::Inconsistent => {
            (Err(said(&error)), String::new())
        }
        Err(error) => return Err(failed(&error)),
    };
    Ok(Point {
        values,
        key: String::new(),
        study,
        bodies,
    })
}

/// All that meshes and compliance depend on but the loads; models without them have none.
fn bodies(study: &Study) -> std::result::Result<String, CliError> {
    if study.contact != study::ContactKind::Fem {
        return Ok(String::new());
    }
    let mut out = format!("{:?} {:?}", study.gear_set(), study.resolution());
    for (member, path) in study.own_meshes() {
        if let Some(path) = path {
            let bytes = fs::read(path).map_err(|error| {
                let message = format!("cannot read {}: {error}", path.display());
                super::super::mesh::refusal(study, member, &message)
            })?;
            out += &format!(" {:?}", fingerprint(&[&bytes]));
        }
    }
    Ok(out)
}

/// Torque, N·mm, and radial misalignment, mm.
fn load(study: &Study) -> (f64, f64) {
    (study.operation.torque_nmm, study.operation.misalignment_mm)
}

/// The figures of all points, in their order, and how many of them were kept from before.
///
/// # Errors
/// [`CliError`] if a finished point cannot be kept or a mesh of the user's not be read. A point that fails is no error.
pub(super) fn compute(
    points: &[Point],
    kept: &Kept,
    progress: &Progress,
) -> std::result::Result<(Vec<Result>, usize), CliError> {
    let mut results: Vec<Option<Result>> = points
        .iter()
        .map(|point| kept.get(&point.key).cloned().map(Ok))
        .collect();
    let reused = results.iter().flatten().count();
    let mut groups: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (i, point) in points.iter().enumerate() {
        if let Err(why) = &point.study {
            results[i] = Some(Err(why.clone()));
            continue;
        }
        groups.entry(&point.bodies).or_default().push(i);
    }
    let mut order: Vec<Vec<usize>> = groups.into_values().collect();
    order.sort_unstable();
    let mut done = reused;
    let mut limit = Limit::default();
    for group in order {
        let open: Vec<usize> = group
            .iter()
            .copied()
            .filter(|&i| results[i].is_none())
            .collect();
        let Some(&first) = open.first() else { continue };
        progress.stage("mesh, factor and condense both gears");
        let Ok(set) = points[first].study.as_ref().map(Study::gear_set) else {
            continue;
        };
        let members = match members(&set, points, &group) {
            Ok(members) => members,
            Err(Unbuilt::Input(error)) => return Err(error),
            Err(Unbuilt::Failed(error)) => {
                for i in open {
                    results[i] = Some(Err(error.to_string()));
                }
                continue;
            }
        };
        let mut rest = &open[..];
        while !rest.is_empty() {
            let (now, later) = rest.split_at(limit.points().min(rest.len()));
            rest = later;
            progress.show(
                done as f64 / points.len() as f64,
                format!("point {} of {}", done + 1, points.len()),
            );
            let computed: Vec<(usize, Result)> = now
                .par_iter()
                .map(|&i| {
                    let study = points[i].study.as_ref();
                    let result = study.map_err(Clone::clone);
                    let result = result.and_then(|study| one(study, &set, members.as_ref()));
                    (i, result)
                })
                .collect();
            limit.learn();
            for (i, result) in computed {
                if let Ok(figures) = &result {
                    kept.keep(&points[i].key, figures)
                        .map_err(|error: OutputError| CliError::from(error))?;
                }
                results[i] = Some(result);
                done += 1;
            }
            progress.show(done as f64 / points.len() as f64, String::new());
        }
    }
    let all = results
        .into_iter()
        .map(|result| result.unwrap_or_else(|| Err("not computed".to_owned())));
    Ok((all.collect(), reused))
}

enum Unbuilt {
    Input(CliError),
    Failed(ForwardError),
}

/// Members fine enough for every load of the group; none for models without them.
fn members(
    set: &GearSet,
    points: &[Point],
    group: &[usize],
) -> std::result::Result<Option<Members>, Unbuilt> {
    let studies: Vec<&Study> = (group.iter())
        .filter_map(|&i| points[i].study.as_ref().ok())
        .collect();
    let Some(study) = studies.first() else {
        return Ok(None);
    };
    if study.contact != study::ContactKind::Fem {
        return Ok(None);
    }
    let (torques, misalignments): (Vec<f64>, Vec<f64>) =
        studies.iter().map(|study| load(study)).unzip();
    let mut own = [None, None];
    for (slot, (member, path)) in own.iter_mut().zip(study.own_meshes()) {
        if let Some(path) = path {
            let mesh = super::super::mesh::read_own(study, member, path);
            *slot = Some(mesh.map_err(Unbuilt::Input)?);
        }
    }
    set.members_on(&study.resolution(), &torques, &misalignments, own)
        .map(Some)
        .map_err(Unbuilt::Failed)
}

/// One point's run.
fn one(study: &Study, set: &GearSet, members: Option<&Members>) -> Result {
    let acting = study.acting(&study.operation);
    let plan = Plan {
        title: &study.title,
        test: None,
        set,
        conditions: study.operation.simulated(&study.wear),
        numerics: study.resolution(),
        kind: match study.contact {
            study::ContactKind::Fem => ContactKind::Fem,
            study::ContactKind::Hertz | study::ContactKind::Paper => ContactKind::Hertz,
        },
        acting: acting.as_ref(),
        effects: &[],
        stored_states: study.numerics.stored_states,
        drawn_positions: 0,
        surroundings: study.surroundings(&study.operation),
        root_stress: false,
    };
    let result = if study.contact == study::ContactKind::Paper {
        paper_run::run(&plan)
    } else {
        run(&plan, members, None, &mut Silent)
    };
    let text = |error: RunError| error.to_string();
    result.map(|run| Figures::of(&run)).map_err(text)
}

/// Nobody watches a single point.
struct Silent;

impl Observer for Silent {
    fn event(&mut self, _: Event) -> bool {
        true
    }

    fn keep(&mut self, _: &Checkpoint) -> std::result::Result<(), String> {
        Ok(())
    }
}

/// How many points run side by side: one at first, then as many as there are threads and as memory allows.
#[derive(Default)]
struct Limit {
    /// Memory that the first point took, kB.
    point: Option<u64>,
    before: Option<u64>,
}

impl Limit {
    fn points(&mut self) -> usize {
        let threads = rayon::current_num_threads();
        if self.before.is_none() {
            self.before = memory("/proc/self/status", "VmHWM:");
            // where the system does not tell, nothing is learnt
            return if self.before.is_some() { 1 } else { threads };
        }
        match (self.point, memory("/proc/meminfo", "MemAvailable:")) {
            (Some(point), Some(free)) => {
                let room = free / 2 / point.max(1);
                threads
                    .min(usize::try_from(room).unwrap_or(usize::MAX))
                    .max(1)
            }
            _ => threads,
        }
    }

    fn learn(&mut self) {
        if self.point.is_none() {
            let now = memory("/proc/self/status", "VmHWM:");
            self.point = now
                .zip(self.before)
                .map(|(now, before)| now.saturating_sub(before));
        }
    }
}

/// A figure of one of Linux' files, kB.
fn memory(file: &str, name: &str) -> Option<u64> {
    let text = fs::read_to_string(file).ok()?;
    let line = text.lines().find(|line| line.starts_with(name))?;
    line.split_whitespace().nth(1)?.parse().ok()
}
