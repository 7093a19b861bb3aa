//! A law learned from measurements: a factor on k, or a profile, as a smooth function of one driver, fitted through the wear history.
//!
//! ```text
//! ln factor at the knots = Φ z,  z_i ~ N(0, 1)                Φ: leading parts of a Gaussian process of size s and length ℓ
//! Z(s, ℓ) = ∫ likelihood × priors over (z, k, other parameters)      Laplace, as of any model
//! Z = mean of Z(s, ℓ) over a grid of sizes and lengths
//! ```
//! The grid is walked from its middle to where the evidence is greatest; what is not tried counts nothing. Each fit goes on from the one before.

use crate::effects::variables::Variable;
use crate::effects::{Hook, Learned, LearnedError};
use crate::gear::Member;
use crate::learn::fitting::fit::FitError;
use crate::learn::fitting::fitted::Fit;
use crate::learn::fitting::measured::Measured;
use crate::learn::hypothesis::version::ModelVersion;
use crate::learn::inference::search::Effort;
use crate::learn::noise::NoiseModel;
use crate::learn::prediction::bench::Bench;
use crate::study::{LearnedLaw, WEAR_COEFFICIENT, rounded};

/// Lengths that are tried, as shares of the knots' span, and where the walk begins.
const LENGTHS: [f64; 5] = [0.5, 0.3, 0.2, 0.12, 0.08];
const FIRST_LENGTH: usize = 2;
/// Sizes that are tried, as shares of the usual one, and where the walk begins.
const SIZES: [f64; 3] = [0.25, 0.7, 2.0];
const FIRST_SIZE: usize = 1;
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
    /// It cannot have the shape that is asked for.
    #[error("{0}")]
    Shape(String),
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
        self.walk(bench, version, without, wanted, noise, watch)?
            .along()
    }

    /// The same with one size and length of the process, to see what a driver is worth.
    ///
    /// # Errors
    /// [`LearnError`]
    pub(in crate::learn) fn glance(
        &self,
        bench: &Bench<'_>,
        version: &ModelVersion,
        without: &Fit,
        wanted: &WantedLaw,
        noise: NoiseModel,
    ) -> Result<LearnedFit, LearnError> {
        let mut walk = self.walk(bench, version, without, wanted, noise, &|_| {})?;
        let zero = vec![0.0; walk.law.knots().len()];
        walk.at([FIRST_LENGTH, FIRST_SIZE], &zero)
    }

    /// A law that another bench found, fitted on this one from its values with the size and length that it has; its evidence is the mean over
    /// the same sizes and lengths as there.
    ///
    /// # Errors
    /// [`LearnError`]
    pub(in crate::learn) fn relearn(
        &self,
        bench: &Bench<'_>,
        version: &ModelVersion,
        without: &Fit,
        found: &LearnedFit,
        noise: NoiseModel,
    ) -> Result<LearnedFit, LearnError> {
        let version = starting_at(version, without);
        let mut again = self.fit_from_values(bench, &version, found.law.clone(), noise, &|_| {})?;
        let tried = found.tried.iter().map(|tried| tried.log_evidence);
        again.log_evidence += found.log_evidence - tried.fold(f64::NEG_INFINITY, f64::max);
        Ok(again)
    }

    /// The fit of a law with its size and length, from its values.
    fn fit_from_values(
        &self,
        bench: &Bench<'_>,
        version: &ModelVersion,
        law: LearnedLaw,
        noise: NoiseModel,
        watch: &(dyn Fn(usize) + Sync),
    ) -> Result<LearnedFit, LearnError> {
        let version = version.with(law.clone().spec());
        let start: Vec<f64> = (version.free.iter())
            .filter(|free| free.name != WEAR_COEFFICIENT)
            .map(|free| free.value)
            .collect();
        let fit = self.fit(bench, &version, noise, &[start], &LOOK, watch)?;
        Ok(LearnedFit {
            law: fitted_law(&law, &fit),
            log_evidence: fit.log_evidence,
            tried: vec![TriedProcess {
                size: law.size,
                length: law.length,
                log_evidence: fit.log_evidence,
            }],
            fit,
        })
    }

    fn walk<'w>(
        &'w self,
        bench: &'w Bench<'w>,
        version: &ModelVersion,
        without: &Fit,
        wanted: &WantedLaw,
        noise: NoiseModel,
        watch: &'w (dyn Fn(usize) + Sync),
    ) -> Result<Walk<'w>, LearnError> {
        let knots = self.knots(bench, version, without, wanted)?;
        let law = Learned::new(wanted.hook, wanted.driver.name, wanted.member, &knots)
            .map_err(|error| LearnError::Driver(error.to_string()))?;
        Ok(Walk {
            measured: self,
            bench,
            version: starting_at(version, without),
            noise,
            watch,
            span: knots[knots.len() - 1] - knots[0],
            law,
            tried: Vec::new(),
        })
    }
}

/// A version whose free parameters start where `fit` ended.
pub(super) fn starting_at(version: &ModelVersion, fit: &Fit) -> ModelVersion {
    let mut version = version.clone();
    for free in &mut version.free {
        if let Some(found) = fit.parameters.iter().find(|p| p.name == free.name) {
            free.value = found.value.clamp(free.lower, free.upper);
        }
    }
    version
}

/// A walk over the grid of sizes and lengths.
struct Walk<'w> {
    measured: &'w Measured<'w>,
    bench: &'w Bench<'w>,
    version: ModelVersion,
    noise: NoiseModel,
    watch: &'w (dyn Fn(usize) + Sync),
    law: Learned,
    span: f64,
    tried: Vec<([usize; 2], LearnedFit)>,
}

impl Walk<'_> {
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
        let found = self.measured.fit_from_values(
            self.bench,
            &self.version,
            law,
            self.noise,
            self.watch,
        )?;
        self.tried.push((place, found.clone()));
        Ok(found)
    }
}

/// A law with the values that a fit of its coefficients found.
pub(in crate::learn) fn fitted_law(law: &LearnedLaw, fit: &Fit) -> LearnedLaw {
    let z = coefficients(law, fit);
    let found: Vec<f64> = z.iter().map(|&n| fit.parameters[n].value).collect();
    LearnedLaw::new(law.law.clone(), law.values_at(&found), law.size, law.length)
}

/// Standard deviations of a law's values at its knots after a fit of its coefficients.
pub(in crate::learn) fn deviations(law: &LearnedLaw, fit: &Fit) -> Vec<f64> {
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
