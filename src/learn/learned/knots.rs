//! Where a learned law's values stand: over the range of its driver in the fit tests.

use crate::effects::Local;
use crate::learn::fitting::fitted::Fit;
use crate::learn::fitting::measured::Measured;
use crate::learn::hypothesis::version::ModelVersion;
use crate::learn::learned::law::{LearnError, WantedLaw};
use crate::learn::prediction::bench::Bench;
use crate::learn::prediction::gear_model::GearModel;
use crate::study::{Role, rounded};

/// Knots of a driver that takes many values.
const KNOTS: usize = 25;
/// A driver with no more values than this has a knot at each.
const FEW: usize = 8;
/// Share of a driver's values, at each end, that lie beyond the outermost knots.
const BEYOND: f64 = 0.005;
/// Drivers that grow from nothing in every test.
pub(super) const FROM_ZERO: &[&str] = &[
    "cycles",
    "contacts",
    "hours",
    "depth",
    "worn_volume",
    "slid_distance",
];

impl Measured<'_> {
    /// Where the law's values are to stand.
    pub(in crate::learn) fn knots(
        &self,
        bench: &Bench<'_>,
        version: &ModelVersion,
        without: &Fit,
        wanted: &WantedLaw,
    ) -> Result<Vec<f64>, LearnError> {
        if let Some([from, to]) = self.along_the_path(bench, wanted) {
            return Ok(even(from, to));
        }
        let mut values = self.driver_values(bench, version, without, wanted);
        values.sort_by(f64::total_cmp);
        let name = wanted.driver.name;
        let mut different = values.clone();
        different.dedup_by(|a, b| (*a - *b).abs() <= 1e-9 * b.abs());
        if FROM_ZERO.contains(&name)
            && let Some(&most) = values.last().filter(|most| **most > 0.0)
        {
            return Ok(even(0.0, most));
        }
        match different.len() {
            0 => Err(LearnError::Driver(format!(
                "{}: no measured point has a value of {name}; wear depths along a flank are needed",
                wanted.name()
            ))),
            1 => Err(LearnError::Driver(format!(
                "{}: {name} has one value only in these tests ({})",
                wanted.name(),
                rounded(different[0])
            ))),
            n if n <= FEW => Ok(different),
            _ => {
                let at = |share: f64| values[(share * (values.len() - 1) as f64).round() as usize];
                let (from, to) = (at(BEYOND), at(1.0 - BEYOND));
                let apart = values.windows(2).map(|w| w[1] - w[0]).fold(0.0, f64::max);
                if wanted.member.is_none() && name == "radius" && apart > 0.2 * (to - from) {
                    return Err(LearnError::Driver(format!(
                        "{}: pinion and gear have no radius in common; name one of them (learned:radius:pinion), or follow the path of \
                         contact (learned:s)",
                        wanted.name()
                    )));
                }
                Ok(even(from, to))
            }
        }
    }

    /// The range of a driver that only a flank as made has.
    fn along_the_path(&self, bench: &Bench<'_>, wanted: &WantedLaw) -> Option<[f64; 2]> {
        let pair = bench
            .set()
            .mount(bench.tests.first()?.conditions.misalignment)
            .ok()?;
        let [start, .., end] = pair.path_points();
        match wanted.driver.name {
            "along" => Some([0.0, 1.0]),
            "from_tip" => Some([0.0, end - start]),
            _ => None,
        }
    }

    /// Values of the driver at the measured places and times of the fit tests.
    fn driver_values(
        &self,
        bench: &Bench<'_>,
        version: &ModelVersion,
        without: &Fit,
        wanted: &WantedLaw,
    ) -> Vec<f64> {
        let fitted = |name: &str| {
            let parameter = without.parameters.iter().find(|p| p.name == name);
            parameter.map(|p| p.value)
        };
        let model = GearModel::new(bench, Box::new(|_| version.effects.build(&fitted)));
        let concerned = |local: &Local| {
            local.pressure > 0.0 && wanted.member.is_none_or(|only| only == local.member)
        };
        let mut values = Vec::new();
        for test in without.tests.iter().filter(|test| test.role == Role::Fit) {
            let locals = model
                .locals(test.test, test.coefficient, &[])
                .unwrap_or_default();
            let before = values.len();
            values.extend(
                locals
                    .into_iter()
                    .flatten()
                    .filter(concerned)
                    .map(|local| wanted.driver.at(&local)),
            );
            if values.len() == before {
                // mass and transmission error stand nowhere on a flank, but they have a time
                let observed = bench.tests[test.test].observations.iter();
                if wanted.driver.name == "cycles" {
                    values.extend(observed.map(|o| o.cycles));
                }
            }
        }
        values.retain(|value| value.is_finite());
        values
    }
}

/// Evenly spaced knots; round numbers as far as six digits go.
fn even(from: f64, to: f64) -> Vec<f64> {
    let step = (to - from) / (KNOTS - 1) as f64;
    (0..KNOTS)
        .map(|i| rounded(from + step * i as f64))
        .collect()
}
