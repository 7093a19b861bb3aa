//! A law learned from measurements: a factor on k, or a profile, as a smooth function of one driver, fitted through the wear history.
//!
//! ```text
//! ln factor at the knots = Φ z,  z_i ~ N(0, 1)                Φ: leading parts of a Gaussian process of size s and length ℓ
//! Z(s, ℓ) = ∫ likelihood × priors over (z, k, other parameters)      Laplace, as of any model
//! Z = mean of Z(s, ℓ) over a grid of sizes and lengths
//! ```
//! The grid is walked from its middle to where the evidence is greatest; what is not tried counts nothing. Each fit goes on from the one before.

use super::bench::Bench;
use super::fit::FitError;
use super::fitted::Fit;
use super::gear_model::GearModel;
use super::hypothesis::version::ModelVersion;
use super::measured::Measured;
use super::noise::NoiseModel;
use super::search::Effort;
use crate::effects::variables::Variable;
use crate::effects::{Hook, Learned, LearnedError, Local};
use crate::gear::Member;
use crate::study::{LearnedLaw, Role, WEAR_COEFFICIENT, rounded};

/// Knots of a driver that takes many values.
const KNOTS: usize = 25;
/// A driver with no more values than this has a knot at each.
const FEW: usize = 8;
/// Lengths that are tried, as shares of the knots' span, and where the walk begins.
const LENGTHS: [f64; 5] = [0.5, 0.3, 0.2, 0.12, 0.08];
const FIRST_LENGTH: usize = 2;
/// Sizes that are tried, as shares of the usual one, and where the walk begins.
const SIZES: [f64; 3] = [0.25, 0.7, 2.0];
const FIRST_SIZE: usize = 1;
/// Share of a driver's values, at each end, that lie beyond the outermost knots.
const BEYOND: f64 = 0.005;
/// Drivers that grow from nothing in every test.
const FROM_ZERO: &[&str] = &[
    "cycles",
    "contacts",
    "hours",
    "depth",
    "worn_volume",
    "slid_distance",
];
/// How a law is fitted while its size and length are looked for.
const LOOK: Effort = Effort {
    iterations: 12,
    tolerance: 0.1,
    floor: 0.3,
    carry: 0.3,
    settle: 0,
    share: 3e-4,
    gain: 0.1,
};

/// A law to be learned.
#[derive(Debug, Clone, Copy)]
pub struct WantedLaw {
    /// A factor on the wear, or a profile.
    pub hook: Hook,
    /// What it follows.
    pub driver: &'static Variable,
    /// On whom it acts; None: both.
    pub member: Option<Member>,
}

/// Why no law was learned.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum LearnError {
    /// The name is none of a law.
    #[error("{0}")]
    Name(String),
    /// The measurements say nothing about it.
    #[error("{0}")]
    Driver(String),
    /// There is no fit.
    #[error(transparent)]
    Fit(#[from] FitError),
}

impl WantedLaw {
    /// From its name in results: `learned:cycles`, `learned:radius:pinion`.
    ///
    /// # Errors
    /// [`LearnError::Name`], with what is allowed.
    pub fn of_name(name: &str, hook: Hook) -> Result<Self, LearnError> {
        let refuse = |why: String| LearnError::Name(format!("`{name}`: {why}"));
        if !matches!(hook, Hook::WearFactor | Hook::Profile) {
            return Err(refuse(format!(
                "a learned {} is not fitted, only wear_factor and profile are",
                hook.name()
            )));
        }
        let mut parts = name.split(':').skip(1);
        let (driver, member) = (parts.next().unwrap_or_default(), parts.next());
        let member = match member {
            None | Some("both") => None,
            Some("pinion") => Some(Member::Pinion),
            Some("gear") => Some(Member::Gear),
            Some(other) => {
                return Err(refuse(format!(
                    "`{other}` is no member, allowed: pinion, gear, both"
                )));
            }
        };
        if parts.next().is_some() {
            return Err(refuse(
                "it has a part too many, allowed: learned:DRIVER or learned:DRIVER:MEMBER"
                    .to_owned(),
            ));
        }
        let driver = Learned::driver_of(hook, driver).map_err(|error| {
            let known: Vec<&str> = Learned::drivers(hook).collect();
            match error {
                LearnedError::Driver { .. } => {
                    refuse(format!("{error}; allowed: {}", known.join(", ")))
                }
                other => refuse(other.to_string()),
            }
        })?;
        Ok(Self {
            hook,
            driver,
            member,
        })
    }

    /// Its name in results.
    pub fn name(&self) -> String {
        let member = self
            .member
            .map_or(String::new(), |m| format!(":{}", m.name()));
        format!("learned:{}{member}", self.driver.name)
    }
}

/// One size and length of the process, fitted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TriedProcess {
    /// Prior standard deviation of the values.
    pub size: f64,
    /// In the driver's unit.
    pub length: f64,
    /// Logarithm of the marginal likelihood.
    pub log_evidence: f64,
}

/// What was learned.
#[derive(Debug, Clone)]
pub struct LearnedFit {
    /// The law with its fitted values and the most probable size and length.
    pub law: LearnedLaw,
    /// The fit.
    pub fit: Fit,
    /// Logarithm of the marginal likelihood, the mean over sizes and lengths.
    pub log_evidence: f64,
    /// What was tried.
    pub tried: Vec<TriedProcess>,
}

impl Measured<'_> {
    /// Fits a law beside what `without`, a fit of `version` on this bench, has.
    ///
    /// # Errors
    /// [`LearnError`]
    pub fn learn(
        &self,
        bench: &Bench<'_>,
        version: &ModelVersion,
        without: &Fit,
        wanted: &WantedLaw,
        noise: NoiseModel,
        watch: &(dyn Fn(usize) + Sync),
    ) -> Result<LearnedFit, LearnError> {
        let knots = self.knots(bench, version, without, wanted)?;
        let law = Learned::new(wanted.hook, wanted.driver.name, wanted.member, &knots)
            .map_err(|error| LearnError::Driver(error.to_string()))?;
        let mut walk = Walk {
            measured: self,
            bench,
            version: starting_at(version, without),
            noise,
            watch,
            span: knots[knots.len() - 1] - knots[0],
            law,
            tried: Vec::new(),
        };
        walk.along()
    }

    /// Where the law's values are to stand.
    fn knots(
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
            values.extend(
                locals
                    .into_iter()
                    .flatten()
                    .filter(concerned)
                    .map(|local| wanted.driver.at(&local)),
            );
            if values.is_empty() {
                // mass and transmission error stand nowhere on a flank, but they have a time
                let observed = bench.tests[test.test].observations.iter();
                match wanted.driver.name {
                    "cycles" => values.extend(observed.map(|o| o.cycles)),
                    _ => {}
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

/// A version whose free parameters start where `fit` ended.
fn starting_at(version: &ModelVersion, fit: &Fit) -> ModelVersion {
    let mut version = version.clone();
    for free in &mut version.free {
        if let Some(found) = fit.parameters.iter().find(|p| p.name == free.name) {
            free.value = found.value.clamp(free.lower, free.upper);
        }
    }
    version
}

/// A walk over the grid of sizes and lengths.
struct Walk<'w, 'm> {
    measured: &'w Measured<'m>,
    bench: &'w Bench<'w>,
    version: ModelVersion,
    noise: NoiseModel,
    watch: &'w (dyn Fn(usize) + Sync),
    law: Learned,
    span: f64,
    tried: Vec<([usize; 2], LearnedFit)>,
}

impl Walk<'_, '_> {
    /// From the middle to the greatest evidence: longer or shorter, then larger or smaller, until no neighbour is better.
    fn along(&mut self) -> Result<LearnedFit, LearnError> {
        let zero = vec![0.0; self.law.knots().len()];
        let mut at = [FIRST_LENGTH, FIRST_SIZE];
        let mut best = self.at(at, &zero)?;
        'walk: loop {
            for (axis, count) in [(0, LENGTHS.len()), (1, SIZES.len())] {
                for next in [at[axis].checked_sub(1), Some(at[axis] + 1)] {
                    let Some(next) = next.filter(|next| *next < count) else {
                        continue;
                    };
                    let mut place = at;
                    place[axis] = next;
                    if self.tried.iter().any(|(known, _)| *known == place) {
                        continue;
                    }
                    let from = best.law.values.clone();
                    // a process that cannot be fitted is no reason against the others
                    let Ok(found) = self.at(place, &from) else {
                        continue;
                    };
                    if found.log_evidence > best.log_evidence {
                        (at, best) = (place, found);
                        continue 'walk;
                    }
                }
            }
            break;
        }
        let gains = self
            .tried
            .iter()
            .map(|(_, fit)| fit.log_evidence - best.log_evidence);
        let count = (LENGTHS.len() * SIZES.len()) as f64;
        best.log_evidence += (gains.map(f64::exp).sum::<f64>() / count).ln();
        best.tried = self
            .tried
            .iter()
            .flat_map(|(_, fit)| fit.tried.clone())
            .collect();
        Ok(best)
    }

    /// The fit at one place of the grid, from these values at the knots.
    fn at(&mut self, place: [usize; 2], from: &[f64]) -> Result<LearnedFit, LearnError> {
        let size = SIZES[place[1]] * LearnedLaw::usual_size(self.law.hook());
        let length = rounded(LENGTHS[place[0]] * self.span);
        let law = LearnedLaw::within(self.law.clone(), from, size, length);
        let version = self.version.with(law.clone().spec());
        let start: Vec<f64> = (version.free.iter())
            .filter(|free| free.name != WEAR_COEFFICIENT)
            .map(|free| free.value)
            .collect();
        let fit = self.measured.fit(
            self.bench,
            &version,
            self.noise,
            &[start],
            &LOOK,
            self.watch,
        )?;
        let found = LearnedFit {
            law: fitted_law(&law, &fit),
            log_evidence: fit.log_evidence,
            tried: vec![TriedProcess {
                size,
                length,
                log_evidence: fit.log_evidence,
            }],
            fit,
        };
        self.tried.push((place, found.clone()));
        Ok(found)
    }
}

/// A law with the values that a fit of its coefficients found.
pub(super) fn fitted_law(law: &LearnedLaw, fit: &Fit) -> LearnedLaw {
    let z = coefficients(law, fit);
    let found: Vec<f64> = z.iter().map(|&n| fit.parameters[n].value).collect();
    LearnedLaw::new(law.law.clone(), law.values_at(&found), law.size, law.length)
}

/// Standard deviations of a law's values at its knots after a fit of its coefficients.
pub(super) fn deviations(law: &LearnedLaw, fit: &Fit) -> Vec<f64> {
    let z = coefficients(law, fit);
    law.deviations(&fit.covariance.select_rows(&z).select_columns(&z))
}

/// Where a law's coefficients stand among a fit's parameters.
fn coefficients(law: &LearnedLaw, fit: &Fit) -> Vec<usize> {
    let prefix = format!("{}.", law.law.name());
    (0..fit.parameters.len())
        .filter(|&n| fit.parameters[n].name.starts_with(&prefix))
        .collect()
}
