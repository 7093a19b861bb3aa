//! Free parameters: where a fit starts, how far it may go, their priors and what is known after a fit.

use std::f64::consts::PI;

use crate::effects::{Param, Prior};
use crate::numeric::truncated_normal::{log_mass, quantile};
use crate::study::{COEFFICIENT_BOUNDS, COEFFICIENT_PRIOR};

/// Name of the wear coefficient in `[fit] free` and in results.
pub const COEFFICIENT: &str = "wear.coefficient";
/// Step of the forward differences, in prior standard deviations of the natural scale: large enough to stand out of the rounding of
/// predictions that are themselves computed with adaptive steps, small enough not to step over a narrow hill of a flat prior.
const DIFFERENCE: f64 = 0.02;
/// Distance to a bound, in the parameter's posterior standard deviations, that counts as lying on it.
const AT_BOUND: f64 = 1e-3;

/// A free parameter.
///
/// Its natural scale is the logarithm if the prior is log-normal, else the value itself: every prior is there a normal
/// or uniform density, cut by the bounds and normalised between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// `effect.parameter`, or [`COEFFICIENT`].
    pub name: String,
    /// Unit, `-` if it has none.
    pub unit: String,
    /// Where a fit starts.
    pub start: f64,
    /// Smallest value allowed.
    pub lower: f64,
    /// Largest value allowed.
    pub upper: f64,
    /// Its prior.
    pub prior: Prior,
}

/// What a fit found for a parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// As [`Parameter::name`].
    pub name: String,
    /// Unit.
    pub unit: String,
    /// The most probable value on the natural scale.
    pub value: f64,
    /// One standard deviation: on a logarithmic scale the value times the standard deviation of its logarithm.
    pub sigma: f64,
    /// The central 95 % of the posterior, normal on the natural scale and cut by the bounds.
    pub interval: [f64; 2],
    /// Whether it lies on a bound.
    pub at_bound: bool,
    /// Whether `sigma` and the covariance belong to the logarithm's scale.
    pub logarithmic: bool,
}

impl Parameter {
    /// The wear coefficient, mm²/N, from a first guess, with the bounds and the prior of a study's.
    pub fn coefficient(start: f64) -> Self {
        Self {
            name: COEFFICIENT.to_owned(),
            unit: "mm2/N".to_owned(),
            start,
            lower: COEFFICIENT_BOUNDS[0],
            upper: COEFFICIENT_BOUNDS[1],
            prior: COEFFICIENT_PRIOR,
        }
    }

    /// A parameter of the effect that results call `effect`, with its card's range and prior, starting at its default.
    pub fn of_card(effect: &str, param: &Param) -> Self {
        Self {
            name: format!("{effect}.{}", param.name),
            unit: param.unit.to_owned(),
            start: param.default,
            lower: param.range.0,
            upper: param.range.1,
            prior: param.prior,
        }
    }

    /// A parameter without a prior of its own: uniform between finite bounds.
    pub fn uniform(name: &str, unit: &str, start: f64, lower: f64, upper: f64) -> Self {
        Self {
            name: name.to_owned(),
            unit: unit.to_owned(),
            start,
            lower,
            upper,
            prior: Prior::Uniform {
                low: lower,
                high: upper,
            },
        }
    }

    /// Starting at `value` instead.
    #[must_use]
    pub fn starting_at(mut self, value: f64) -> Self {
        self.start = value;
        self
    }

    /// With the user's narrower bounds; those of None stay.
    #[must_use]
    pub fn within(mut self, lower: Option<f64>, upper: Option<f64>) -> Self {
        self.lower = lower.unwrap_or(self.lower);
        self.upper = upper.unwrap_or(self.upper);
        self
    }

    /// Whether its natural scale is the logarithm.
    pub fn is_logarithmic(&self) -> bool {
        matches!(self.prior, Prior::LogNormal { .. })
    }

    /// Whether it is an angle that may take any value of a turn: both its bounds are then the same place, and none is an end.
    fn is_angle(&self) -> bool {
        self.unit == "rad" && (self.upper - self.lower - 2.0 * PI).abs() < 1e-9
    }

    /// On the natural scale.
    pub(in crate::learn) fn natural(&self, value: f64) -> f64 {
        if self.is_logarithmic() {
            value.max(0.0).ln()
        } else {
            value
        }
    }

    /// From the natural scale.
    pub(in crate::learn) fn value(&self, natural: f64) -> f64 {
        let value = if self.is_logarithmic() {
            natural.exp()
        } else {
            natural
        };
        value.clamp(self.lower, self.upper)
    }

    /// `value` on the natural scale, brought between the bounds; the prior's median if the scale has no such value.
    pub(in crate::learn) fn natural_start(&self, value: f64) -> f64 {
        let prior = self.natural_prior();
        let natural = self.natural(value);
        let natural = if natural.is_finite() {
            natural
        } else {
            self.natural(self.prior.median())
        };
        natural.clamp(prior.lower, prior.upper)
    }

    /// The prior on the natural scale.
    pub(in crate::learn) fn natural_prior(&self) -> NaturalPrior {
        let (lower, upper) = (self.natural(self.lower), self.natural(self.upper));
        match self.prior {
            Prior::LogNormal { median, spread } => {
                NaturalPrior::normal(median.ln(), spread.ln(), lower, upper)
            }
            Prior::Normal { mean, sd } => NaturalPrior::normal(mean, sd, lower, upper),
            Prior::HalfNormal { sd } => NaturalPrior::normal(0.0, sd, lower.max(0.0), upper),
            Prior::Uniform { low, high } => NaturalPrior {
                turns: self.is_angle(),
                ..NaturalPrior::uniform(lower.max(low), upper.min(high))
            },
        }
    }

    /// The value below which a share `p` of the prior lies.
    pub(in crate::learn) fn quantile(&self, p: f64) -> f64 {
        let prior = self.natural_prior();
        let natural = if prior.precision > 0.0 {
            quantile(p, prior.mean, prior.scale(), prior.lower, prior.upper)
        } else {
            prior.lower + p * (prior.upper - prior.lower)
        };
        self.value(natural)
    }

    /// The step of a forward difference on the natural scale at `natural`, away from a near bound.
    pub(in crate::learn) fn difference(&self, natural: f64) -> f64 {
        let prior = self.natural_prior();
        let step = (DIFFERENCE * prior.scale()).min(0.25 * (prior.upper - prior.lower));
        if natural + step <= prior.upper {
            step
        } else {
            -step
        }
    }

    /// The change by which a forward difference over `step` is divided: exact for a model linear in the value.
    pub(in crate::learn) fn divisor(&self, step: f64) -> f64 {
        if self.is_logarithmic() {
            step.exp_m1()
        } else {
            step
        }
    }

    /// What is known of it when its posterior is normal about `centre` with `sd`, cut by the bounds, with its mode at
    /// `mode`, all on the natural scale.
    pub(in crate::learn) fn estimate(&self, mode: f64, centre: f64, sd: f64) -> Estimate {
        let prior = self.natural_prior();
        let value = self.value(mode);
        // an angle goes on where its range ends
        let [lower, upper] = match self.is_angle() {
            true => [f64::NEG_INFINITY, f64::INFINITY],
            false => [prior.lower, prior.upper],
        };
        let at = |p| self.value(quantile(p, centre, sd, lower, upper));
        // A parameter that the data say nothing about is known by its bounds.
        let sd = sd.min((prior.upper - prior.lower) / 12f64.sqrt());
        let near = AT_BOUND * sd;
        Estimate {
            name: self.name.clone(),
            unit: self.unit.clone(),
            value,
            sigma: if self.is_logarithmic() {
                value * sd
            } else {
                sd
            },
            // with the mode in it, which lies outside where it is on a bound or where the centre is what derivatives promise
            interval: [at(0.025).min(value), at(0.975).max(value)],
            at_bound: !self.is_angle()
                && (mode - prior.lower <= near || prior.upper - mode <= near),
            logarithmic: self.is_logarithmic(),
        }
    }
}

/// A parameter's value as people write it, to four decimals or four digits.
pub(in crate::learn) fn short(value: f64) -> String {
    if (1e-2..1e6).contains(&value.abs()) {
        format!("{}", (1e4 * value).round() / 1e4)
    } else {
        format!("{value:.3e}")
    }
}

/// A normal or uniform density on the natural scale, cut by bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::learn) struct NaturalPrior {
    pub(in crate::learn) mean: f64,
    /// 1/sd², 0 for a uniform density.
    pub(in crate::learn) precision: f64,
    pub(in crate::learn) lower: f64,
    pub(in crate::learn) upper: f64,
    /// Logarithm of the factor that makes the density's integral between the bounds 1.
    log_norm: f64,
    /// Whether both bounds are one place: an angle that may take any value of a turn.
    turns: bool,
}

impl NaturalPrior {
    fn normal(mean: f64, sd: f64, lower: f64, upper: f64) -> Self {
        let mass = log_mass((lower - mean) / sd, (upper - mean) / sd);
        Self {
            mean,
            precision: 1.0 / (sd * sd),
            lower,
            upper,
            log_norm: -(sd * (2.0 * PI).sqrt()).ln() - mass,
            turns: false,
        }
    }

    fn uniform(lower: f64, upper: f64) -> Self {
        Self {
            mean: 0.5 * (lower + upper),
            precision: 0.0,
            lower,
            upper,
            log_norm: -(upper - lower).ln(),
            turns: false,
        }
    }

    /// How far a step from `at` may go down and up: to the bounds, an angle half a turn either way.
    pub(in crate::learn) fn room(&self, at: f64) -> [f64; 2] {
        if self.turns {
            let half = 0.5 * (self.upper - self.lower);
            [-half, half]
        } else {
            [(self.lower - at).min(0.0), (self.upper - at).max(0.0)]
        }
    }

    /// Where a step from `at` ends: within the bounds, an angle on the other side of them.
    pub(in crate::learn) fn moved(&self, at: f64, step: f64) -> f64 {
        let next = at + step;
        if self.turns && !(self.lower..=self.upper).contains(&next) {
            self.lower + (next - self.lower).rem_euclid(self.upper - self.lower)
        } else {
            next.clamp(self.lower, self.upper)
        }
    }

    /// The step from one value to another, of an angle the shorter way round.
    pub(in crate::learn) fn step(&self, from: f64, to: f64) -> f64 {
        let step = to - from;
        if self.turns {
            let turn = self.upper - self.lower;
            step - turn * (step / turn).round()
        } else {
            step
        }
    }

    /// Logarithm of the density.
    pub(in crate::learn) fn log_density(&self, natural: f64) -> f64 {
        self.log_norm - 0.5 * self.precision * (natural - self.mean).powi(2)
    }

    /// A length typical of it: its standard deviation before the cut.
    pub(in crate::learn) fn scale(&self) -> f64 {
        if self.precision > 0.0 {
            self.precision.sqrt().recip()
        } else {
            (self.upper - self.lower) / 12f64.sqrt()
        }
    }

    /// Its curvature for a quadratic model; a uniform one gets a trace of it, so that a parameter without any influence on
    /// the data leaves a regular matrix. Cut by the bounds, that trace changes the integral by less than 1e-7.
    pub(in crate::learn) fn curvature(&self) -> f64 {
        if self.precision > 0.0 {
            self.precision
        } else {
            1e-6 / (self.upper - self.lower).powi(2)
        }
    }
}
