//! The runs of a sweep's points: meshes and compliances shared by the points that differ in operation, wear, effects or oil alone.
//!
//! Meshes are made for the loads of all points, also where only some are computed: so a point's figures are the same to the bit
//! wherever and with whichever others it is computed.

use std::collections::BTreeMap;
use std::fs;

use rayon::prelude::*;

use super::figures::{Figures, Outputs};
use super::kept::Kept;
use super::points::{Point, Result, load};
use super::{CliError, Progress};
use crate::simulate::checkpoint::Checkpoint;
use crate::simulate::forward::{ContactKind, ForwardError, GearSet};
use crate::simulate::members::Members;
use crate::simulate::paper_run;
use crate::simulate::run::{Event, Observer, Plan, RunError, run};
use crate::study::{self, Study};

/// The figures of the points for which `mine` holds, in the points' order, and how many of them were kept from before; None for the others.
///
/// # Errors
/// [`CliError`] if a finished point cannot be kept or a mesh of the user's not be read. A point that fails is no error.
pub(super) fn compute(
    points: &[Point],
    outputs: &Outputs,
    mine: &dyn Fn(usize) -> bool,
    kept: &Kept,
    progress: &Progress,
) -> std::result::Result<(Vec<Option<Result>>, usize), CliError> {
    let own: Vec<bool> = (0..points.len()).map(mine).collect();
    let mut results: Vec<Option<Result>> = (points.iter().zip(&own))
        .map(|(point, own)| kept.get(&point.key).filter(|_| *own).cloned().map(Ok))
        .collect();
    let reused = results.iter().flatten().count();
    let count = own.iter().filter(|own| **own).count();
    for (i, point) in points.iter().enumerate() {
        if let Err(why) = &point.study {
            results[i] = own[i].then(|| Err(why.clone()));
        }
    }
    let mut computing = Computing {
        points,
        outputs,
        kept,
        progress,
        count,
        done: reused,
        limit: Limit::default(),
        results,
    };
    for group in groups(points) {
        computing.group(&group, &own)?;
    }
    Ok((computing.results, reused))
}

/// The points that have a study, those with the same bodies together; in the order of the first of each.
fn groups(points: &[Point]) -> Vec<Vec<usize>> {
    let mut groups: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (i, point) in points.iter().enumerate() {
        if point.study.is_ok() {
            groups.entry(&point.bodies).or_default().push(i);
        }
    }
    let mut order: Vec<Vec<usize>> = groups.into_values().collect();
    order.sort_unstable();
    order
}

/// The points of a sweep, as far as they are computed.
struct Computing<'a> {
    points: &'a [Point],
    outputs: &'a Outputs,
    kept: &'a Kept,
    progress: &'a Progress,
    /// Points to be computed here, those kept from before among them.
    count: usize,
    /// How many of them are done.
    done: usize,
    limit: Limit,
    /// By point.
    results: Vec<Option<Result>>,
}

impl Computing<'_> {
    /// Computes the points of a `group` with the same bodies that are this one's `own` and not done yet.
    fn group(&mut self, group: &[usize], own: &[bool]) -> std::result::Result<(), CliError> {
        let open: Vec<usize> = group
            .iter()
            .copied()
            .filter(|&i| own[i] && self.results[i].is_none())
            .collect();
        let Some(&first) = open.first() else {
            return Ok(());
        };
        self.progress.stage("mesh, factor and condense both gears");
        let Ok(set) = self.points[first].study.as_ref().map(Study::gear_set) else {
            return Ok(());
        };
        let members = match members(&set, self.points, group) {
            Ok(members) => members,
            Err(Unbuilt::Input(error)) => return Err(error),
            Err(Unbuilt::Failed(error)) => {
                for i in open {
                    let key = &self.points[i].key;
                    self.kept.keep_failure(key, &error.to_string())?;
                    self.results[i] = Some(Err(error.to_string()));
                    self.done += 1;
                }
                return Ok(());
            }
        };
        let mut rest = &open[..];
        while !rest.is_empty() {
            let (now, later) = rest.split_at(self.limit.points().min(rest.len()));
            rest = later;
            self.at_once(now, members.as_ref())?;
        }
        Ok(())
    }

    /// Computes some points at once.
    fn at_once(
        &mut self,
        now: &[usize],
        members: Option<&Members>,
    ) -> std::result::Result<(), CliError> {
        let (points, outputs, count) = (self.points, self.outputs, self.count);
        self.progress.show(
            self.done as f64 / count as f64,
            format!("point {} of {count}", self.done + 1),
        );
        let computed: Vec<(usize, Result)> = now
            .par_iter()
            .map(|&i| {
                let study = points[i].study.as_ref();
                let result = study.map_err(Clone::clone);
                // a model without bodies has points of different gears in one group
                let result =
                    result.and_then(|study| one(study, &study.gear_set(), members, outputs));
                (i, result)
            })
            .collect();
        self.limit.learn();
        for (i, result) in computed {
            match &result {
                Ok(figures) => self.kept.keep(&points[i].key, figures)?,
                Err(why) => self.kept.keep_failure(&points[i].key, why)?,
            }
            self.results[i] = Some(result);
            self.done += 1;
        }
        self.progress
            .show(self.done as f64 / count as f64, String::new());
        Ok(())
    }
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
fn one(study: &Study, set: &GearSet, members: Option<&Members>, outputs: &Outputs) -> Result {
    let acting = study.acting(&study.operation);
    let plan = Plan {
        title: &study.title,
        test: None,
        set,
        conditions: study.operation.simulated(&study.wear_at(&study.operation)),
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
    result.map(|run| Figures::of(&run, outputs)).map_err(text)
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
