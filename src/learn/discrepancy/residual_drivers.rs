//! What is left of the measurements against each physical quantity that it may follow from, before and after.
//!
//! ```text
//! r = (measured − model − datum)/σ                                      1: the noise; datum: the trace's most probable one
//! ```
//! Residuals are divided by their own σ and not whitened with the whole covariance, which would carry each row's residual over to
//! the rows behind it. Local quantities are the fitted base model's, for before and after alike: the contact at the moment
//! at which it presses the measured point most.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::binned::{BinMean, Explained, bin_mean, bins, explained, mean};
use crate::effects::Local;
use crate::learn::candidates::candidate_model::model;
use crate::learn::candidates::fitted_candidate::FittedCandidate;
use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::hypothesis::Hypothesis;
use crate::learn::prediction::bench::Bench;
use crate::measure::Observation;
use crate::study::Operation;

/// A quantity that residuals may follow from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DriverKind {
    /// Name in files.
    pub name: &'static str,
    /// Name for people, with its unit.
    pub label: &'static str,
    /// Unit.
    pub unit: &'static str,
}

/// Number of drivers.
pub const DRIVERS: usize = 12;

/// All of them, in the order of [`DriverRow::values`].
#[rustfmt::skip]
pub static DRIVER_KINDS: [DriverKind; DRIVERS] = [
    DriverKind { name: "position", label: "distance along the path of contact from the pitch point, mm", unit: "mm" },
    DriverKind { name: "sliding_speed", label: "sliding speed, m/s", unit: "m/s" },
    DriverKind { name: "contact_pressure", label: "largest contact pressure in a passage, MPa", unit: "MPa" },
    DriverKind { name: "film_ratio", label: "film ratio", unit: "-" },
    DriverKind { name: "flash_temperature", label: "flash temperature, K", unit: "K" },
    DriverKind { name: "depth_worn", label: "depth worn, µm", unit: "um" },
    DriverKind { name: "cycles", label: "pinion revolutions", unit: "-" },
    DriverKind { name: "torque", label: "torque on the pinion, N·m", unit: "N m" },
    DriverKind { name: "speed", label: "speed of the pinion, rpm", unit: "rpm" },
    DriverKind { name: "misalignment", label: "radial misalignment, mm", unit: "mm" },
    DriverKind { name: "member", label: "member", unit: "1 pinion, 2 gear, 3 both" },
    DriverKind { name: "bulk_temperature", label: "bulk temperature of the teeth, °C", unit: "degC" },
];

/// What is left, by driver.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ResidualDrivers {
    /// The effects of the model after; None where nothing is missing, and then there is no after.
    pub after: Option<Hypothesis>,
    /// By falling share before.
    pub drivers: Vec<ResidualDriver>,
    /// Drivers that have one value only in these data, or that the study does not state what is needed for.
    pub constant: Vec<String>,
    /// Every fitted row; not part of the document, but a table of its own.
    #[serde(skip)]
    pub rows: Vec<DriverRow>,
}

/// The residual against one driver.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ResidualDriver {
    /// One of [`DRIVER_KINDS`].
    pub name: String,
    /// Unit of its values.
    pub unit: String,
    /// Rows for which it has a value.
    pub points: usize,
    /// Of the fitted base model.
    pub before: Explained,
    /// With the effects of the model after.
    pub after: Option<Explained>,
    /// By ascending driver.
    pub bins: Vec<DriverBin>,
}

/// One bin of a driver.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct DriverBin {
    /// Smallest value of the driver in it.
    pub from: f64,
    /// Largest.
    pub to: f64,
    /// Mean.
    pub centre: f64,
    /// Rows.
    pub points: usize,
    /// Residual of the base model.
    pub before: BinMean,
    /// Of the model after.
    pub after: Option<BinMean>,
}

/// One fitted row with its drivers.
#[derive(Debug, Clone, PartialEq)]
pub struct DriverRow {
    /// Id of the test.
    pub test: String,
    /// `pinion`, `gear` or `pair`.
    pub member: &'static str,
    /// What is measured.
    pub quantity: &'static str,
    /// mm of radius or base pitches of rotation; None for a whole member.
    pub position: Option<f64>,
    /// Values of [`DRIVER_KINDS`]; None where there is none.
    pub values: [Option<f64>; DRIVERS],
    /// The measured value, in the quantity's unit.
    pub measured: f64,
    /// One standard deviation of it.
    pub sigma: f64,
    /// Residual of the base model, in sigmas.
    pub before: f64,
    /// Of the model after.
    pub after: Option<f64>,
}

/// What the base model leaves, and what the model after does.
pub(in crate::learn) fn of(
    likelihood: &Likelihood<'_>,
    bench: &Bench<'_>,
    base: &FittedCandidate,
    after: Option<&FittedCandidate>,
) -> ResidualDrivers {
    let locals = locals(likelihood, bench, base);
    let left = |j: &FittedCandidate| likelihood.standardised(&j.found.model);
    let (before, now) = (left(base), after.map(left));
    let rows = (0..likelihood.len())
        .map(|i| {
            let o = likelihood.observation(i);
            let conditions = &likelihood.measured.study().tests[o.test].conditions;
            DriverRow {
                test: likelihood.measured.data.tests[o.test].clone(),
                member: o.member.name(),
                quantity: o.quantity.name(),
                position: o.position,
                measured: o.value,
                sigma: o.sigma,
                values: values(o, conditions, locals[i].as_ref()),
                before: before[i],
                after: now.as_ref().map(|now| now[i]),
            }
        })
        .collect();
    against(after.map(|j| j.candidate.hypothesis()), rows)
}

/// What each row of the likelihood feels under the fitted base model; none of a test that cannot be computed.
fn locals(
    likelihood: &Likelihood<'_>,
    bench: &Bench<'_>,
    base: &FittedCandidate,
) -> Vec<Option<Local>> {
    let model = model(bench, &base.candidate);
    let (k, theta) = likelihood.arguments(&base.candidate.parameters, &base.found.state);
    let of_tests: Vec<Vec<Option<Local>>> = (likelihood.tests.par_iter().zip(&k))
        .map(|(&test, &k)| model.locals(test, k, &theta).unwrap_or_default())
        .collect();
    let mut locals = vec![None; likelihood.len()];
    for (rows, of_test) in likelihood.rows.iter().zip(of_tests) {
        for (&row, local) in rows.iter().zip(of_test) {
            locals[row] = local;
        }
    }
    locals
}

/// Drivers of an observation; what the study does not state is 0 in a local state.
fn values(
    o: &Observation,
    conditions: &Operation,
    local: Option<&Local>,
) -> [Option<f64>; DRIVERS] {
    let loaded = local.filter(|at| at.pressure > 0.0);
    let stated = |value: f64| Some(value).filter(|v| *v > 0.0);
    [
        local.map(|at| at.path),
        local.map(Local::sliding_speed),
        loaded.map(|at| at.pressure),
        loaded.and_then(|at| stated(at.film_ratio)),
        loaded.and_then(|at| stated(at.flash_temperature)),
        local.map(|at| at.depth),
        Some(o.cycles),
        Some(1e-3 * conditions.torque_nmm),
        Some(conditions.speed_rpm),
        Some(conditions.misalignment_mm),
        Some(1.0 + f64::from(o.member as u8)),
        conditions.bulk_temperature_c,
    ]
}

/// Residuals of rows against each of their drivers.
fn against(after: Option<Hypothesis>, rows: Vec<DriverRow>) -> ResidualDrivers {
    let (mut drivers, mut constant) = (Vec::new(), Vec::new());
    for (number, kind) in DRIVER_KINDS.iter().enumerate() {
        match driver(kind, number, &rows, after.is_some()) {
            Some(driver) => drivers.push(driver),
            None => constant.push(kind.name.to_owned()),
        }
    }
    drivers.sort_by(|a, b| b.before.share.total_cmp(&a.before.share));
    ResidualDrivers {
        after,
        drivers,
        constant,
        rows,
    }
}

/// One driver; None if all rows have the same value or none.
fn driver(
    kind: &DriverKind,
    number: usize,
    rows: &[DriverRow],
    after: bool,
) -> Option<ResidualDriver> {
    let mut known: Vec<(f64, &DriverRow)> = rows
        .iter()
        .filter_map(|row| Some((row.values[number]?, row)))
        .collect();
    known.sort_by(|a, b| a.0.total_cmp(&b.0));
    let at: Vec<f64> = known.iter().map(|k| k.0).collect();
    let ends = bins(&at);
    if ends.len() < 2 || known.len() <= ends.len() {
        return None;
    }
    let before: Vec<f64> = known.iter().map(|k| k.1.before).collect();
    let later: Option<Vec<f64>> = after.then(|| known.iter().filter_map(|k| k.1.after).collect());
    let first = |i: usize| if i == 0 { 0 } else { ends[i - 1] };
    Some(ResidualDriver {
        name: kind.name.to_owned(),
        unit: kind.unit.to_owned(),
        points: known.len(),
        before: explained(&before, &ends),
        after: later.as_ref().map(|later| explained(later, &ends)),
        bins: (0..ends.len())
            .map(|i| {
                let own = first(i)..ends[i];
                DriverBin {
                    from: at[own.start],
                    to: at[own.end - 1],
                    centre: mean(&at[own.clone()]),
                    points: own.len(),
                    before: bin_mean(&before[own.clone()]),
                    after: later.as_ref().map(|later| bin_mean(&later[own.clone()])),
                }
            })
            .collect(),
    })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::super::binned::{BINS, noise};
    use super::*;

    /// Rows along a path from −4 to 4 mm, at three torques in turn; `before` from both, nothing after.
    fn rows(count: usize, before: impl Fn(f64, f64, f64) -> f64) -> Vec<DriverRow> {
        let (e, f) = (noise(1, count), noise(2, count));
        (0..count)
            .map(|i| {
                let path = 8.0 * i as f64 / (count - 1) as f64 - 4.0;
                let torque = 100.0 + 50.0 * (i % 3) as f64;
                let mut values = [None; DRIVERS];
                values[0] = Some(path);
                values[1] = Some(path.abs());
                values[7] = Some(torque);
                values[8] = Some(2000.0);
                values[10] = Some(1.0 + (i % 2) as f64);
                DriverRow {
                    test: "A".to_owned(),
                    member: "pinion",
                    quantity: "wear_depth",
                    position: Some(27.0),
                    values,
                    measured: 0.0,
                    sigma: 1.0,
                    before: before(path, torque, e[i]),
                    after: Some(f[i]),
                }
            })
            .collect()
    }

    fn of<'d>(found: &'d ResidualDrivers, name: &str) -> &'d ResidualDriver {
        found.drivers.iter().find(|d| d.name == name).unwrap()
    }

    #[test]
    fn noise_follows_nothing() {
        let found = against(Some(Hypothesis::Unknown), rows(600, |_, _, e| e));
        for driver in &found.drivers {
            for part in [Some(driver.before), driver.after].into_iter().flatten() {
                assert!(part.share < 3.5 * part.share_by_chance, "{driver:?}");
                assert!(part.share < 0.03, "{driver:?}");
            }
        }
    }

    #[test]
    fn what_follows_the_position_is_seen_there_and_gone_after() {
        // a wave that averages to nothing over |path|: variance 2 of 3
        let found = against(
            Some(Hypothesis::Unknown),
            rows(1200, |path, _, e| 2.0 * (PI * path / 4.0).sin() + e),
        );
        assert_eq!(found.drivers[0].name, "position");
        let position = of(&found, "position");
        assert!(
            (position.before.share - 2.0 / 3.0).abs() < 0.05,
            "{:?}",
            position.before
        );
        assert!(
            (position.before.variance - 2.0).abs() < 0.2,
            "{:?}",
            position.before
        );
        assert!(position.after.unwrap().share < 0.02);
        assert!(of(&found, "sliding_speed").before.share < 0.02);
        assert!(of(&found, "torque").before.share < 0.02);
        assert_eq!(position.bins.len(), BINS);
        let total: usize = position.bins.iter().map(|bin| bin.points).sum();
        assert_eq!(total, 1200);
        for bin in &position.bins {
            // 100 rows of noise 1 and what the wave changes inside the bin
            assert!((0.07..0.14).contains(&bin.before.error), "{bin:?}");
            let expected = 2.0 * (PI * bin.centre / 4.0).sin();
            assert!((bin.before.mean - expected).abs() < 0.4, "{bin:?}");
        }
    }

    /// A test's own temperature is a driver like its torque.
    #[test]
    fn what_follows_the_temperature_of_the_tests_is_seen_there() {
        let warm = |mut row: DriverRow, i: usize| {
            let celsius = 40.0 + 10.0 * (i % 4) as f64;
            row.values[11] = Some(celsius);
            row.before += 0.1 * (celsius - 55.0);
            row
        };
        let rows = rows(400, |_, _, e| e).into_iter().zip(0..);
        let found = against(None, rows.map(|(row, i)| warm(row, i)).collect());
        assert_eq!(found.drivers[0].name, "bulk_temperature");
        assert_eq!(found.drivers[0].unit, "degC");
        assert_eq!(found.drivers[0].bins.len(), 4);
    }

    #[test]
    fn few_values_are_bins_of_their_own_and_one_is_none() {
        let found = against(None, rows(300, |_, torque, e| 0.04 * (torque - 150.0) + e));
        assert_eq!(found.drivers[0].name, "torque");
        let torque = of(&found, "torque");
        let values: Vec<f64> = torque.bins.iter().map(|bin| bin.centre).collect();
        assert_eq!(values, [100.0, 150.0, 200.0]);
        assert!(torque.after.is_none() && torque.bins[0].after.is_none());
        // two thirds of 2² over itself and 1
        assert!(
            (torque.before.share - 8.0 / 11.0).abs() < 0.04,
            "{:?}",
            torque.before
        );
        assert!(found.constant.iter().any(|name| name == "speed"));
        assert!(found.constant.iter().any(|name| name == "film_ratio"));
    }
}
