//! The prior of a parameter.

use std::f64::consts::PI;
use std::fmt;

/// A prior distribution of one parameter, in the parameter's unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Prior {
    /// ln x is normal: median, and the factor that is one standard deviation.
    LogNormal {
        /// Median.
        median: f64,
        /// Geometric standard deviation, above 1.
        spread: f64,
    },
    /// Normal.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation.
        sd: f64,
    },
    /// The positive half of a normal of mean 0.
    HalfNormal {
        /// Standard deviation of the whole normal.
        sd: f64,
    },
    /// Constant between two bounds.
    Uniform {
        /// Lower bound.
        low: f64,
        /// Upper bound.
        high: f64,
    },
}

impl Prior {
    /// Logarithm of the probability density at `x`; minus infinity where it is zero.
    ///
    /// ```text
    /// log-normal: exp(−z²/2)/(x ln g √(2π)), z = ln(x/median)/ln g        normal: exp(−z²/2)/(σ √(2π)), z = (x − µ)/σ
    /// half-normal: twice the normal for x ≥ 0                             uniform: 1/(high − low)
    /// ```
    pub fn log_density(&self, x: f64) -> f64 {
        let normal = |z: f64, sd: f64| -0.5 * z * z - (sd * (2.0 * PI).sqrt()).ln();
        match *self {
            Prior::LogNormal { median, spread } => {
                if x <= 0.0 {
                    return f64::NEG_INFINITY;
                }
                let sd = spread.ln();
                normal((x / median).ln() / sd, sd) - x.ln()
            }
            Prior::Normal { mean, sd } => normal((x - mean) / sd, sd),
            Prior::HalfNormal { sd } => {
                if x < 0.0 {
                    return f64::NEG_INFINITY;
                }
                2f64.ln() + normal(x / sd, sd)
            }
            Prior::Uniform { low, high } => {
                if (low..=high).contains(&x) {
                    -(high - low).ln()
                } else {
                    f64::NEG_INFINITY
                }
            }
        }
    }

    /// Median.
    pub fn median(&self) -> f64 {
        match *self {
            Prior::LogNormal { median, .. } => median,
            Prior::Normal { mean, .. } => mean,
            Prior::HalfNormal { sd } => 0.674_489_750_196_081_7 * sd,
            Prior::Uniform { low, high } => 0.5 * (low + high),
        }
    }
}

impl fmt::Display for Prior {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Prior::LogNormal { median, spread } => {
                write!(f, "log-normal, median {median:?}, factor {spread:?}")
            }
            Prior::Normal { mean, sd } => write!(f, "normal, mean {mean:?}, sd {sd:?}"),
            Prior::HalfNormal { sd } => write!(f, "half-normal, sd {sd:?}"),
            Prior::Uniform { low, high } => write!(f, "uniform, {low:?} to {high:?}"),
        }
    }
}
