//! The four models that a study offers, as functions of blocks of numbers.
//!
//! | model | arguments | answer |
//! |---|---|---|
//! | `standardised` | free parameters; 0: the study's value, 1: one standard deviation of the prior away | all measured rows |
//! | `forward` | free parameters in their units | all measured rows |
//! | `log_likelihood` | free parameters in their units; scatter of k, if it is not excluded | ln of the likelihood of the fit tests |
//! | `log_posterior` | the same | ln likelihood + ln prior |
//!
//! A value beyond a parameter's bounds is taken at the bound by the first two. The density there is 0, and the lowest number stands for its
//! logarithm: JSON has no minus infinity.

use nalgebra::DMatrix;

use crate::learn::{Density, Place, Posterior, PredictError, Scale, Simulator};

/// What one of the models computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Rows of standardised parameters.
    Standardised,
    /// Rows of parameters in their units.
    Forward,
    /// Likelihood.
    LogLikelihood,
    /// Likelihood and prior.
    LogPosterior,
}

impl Kind {
    /// All, in the order in which a server names them.
    pub const ALL: [Self; 4] = [
        Self::Standardised,
        Self::Forward,
        Self::LogLikelihood,
        Self::LogPosterior,
    ];

    /// Its name in the protocol.
    pub fn name(self) -> &'static str {
        match self {
            Self::Standardised => "standardised",
            Self::Forward => "forward",
            Self::LogLikelihood => "log_likelihood",
            Self::LogPosterior => "log_posterior",
        }
    }

    /// Whether it is a density.
    pub fn is_density(self) -> bool {
        matches!(self, Self::LogLikelihood | Self::LogPosterior)
    }
}

/// What of a request is no argument of the model.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Config {
    /// Whether a density takes standardised parameters.
    pub standardised: bool,
    /// Arguments of another place whose wear steps are taken.
    pub along: Option<Vec<Vec<f64>>>,
}

/// The models of a study.
pub struct Models<'a> {
    simulator: &'a Simulator<'a>,
    posterior: Posterior<'a>,
    scatter: usize,
}

impl<'a> Models<'a> {
    /// Of a model with free parameters, and its measurements.
    pub fn new(simulator: &'a Simulator<'a>) -> Self {
        let posterior = Posterior::new(simulator);
        Self {
            scatter: posterior.scatter_names().len(),
            posterior,
            simulator,
        }
    }

    /// Names of the arguments of the densities, block by block; rows take the first block alone.
    pub fn names(&self) -> Vec<Vec<String>> {
        let own = self.simulator.parameters().iter();
        let mut names = vec![own.map(|p| p.name.clone()).collect()];
        if self.scatter > 0 {
            names.push(self.posterior.scatter_names());
        }
        names
    }

    /// Sizes of the blocks of a model's arguments.
    pub fn input_sizes(&self, kind: Kind) -> Vec<usize> {
        let mut sizes = vec![self.simulator.parameters().len()];
        if kind.is_density() && self.scatter > 0 {
            sizes.push(self.scatter);
        }
        sizes
    }

    /// Size of a model's answer.
    pub fn output_size(&self, kind: Kind) -> usize {
        if kind.is_density() {
            1
        } else {
            self.simulator.len()
        }
    }

    /// The answer to arguments of the right sizes.
    ///
    /// # Errors
    /// [`PredictError`] if the model has none there.
    pub fn evaluate(
        &self,
        kind: Kind,
        input: &[Vec<f64>],
        config: &Config,
    ) -> Result<Vec<f64>, PredictError> {
        if !kind.is_density() {
            let at = self.place(kind, input).0;
            let along = config.along.as_ref();
            let along = along.map(|input| self.place(kind, input).0);
            return self.simulator.rows(&at, along.as_ref());
        }
        let prior = self.prior(input, config);
        if prior.log == f64::NEG_INFINITY {
            return Ok(vec![f64::MIN]);
        }
        let along = config.along.as_deref().map(blocks);
        let likelihood = self
            .posterior
            .log_likelihood(blocks(input), scale(config), along)?;
        let log = match kind {
            Kind::LogPosterior => likelihood + prior.log,
            _ => likelihood,
        };
        Ok(vec![log.max(f64::MIN)])
    }

    /// Derivatives of the answer (rows) by one block of the arguments (columns), per unit of them.
    ///
    /// # Errors
    /// As [`Models::evaluate`].
    pub fn jacobian(
        &self,
        kind: Kind,
        input: &[Vec<f64>],
        block: usize,
        config: &Config,
    ) -> Result<DMatrix<f64>, PredictError> {
        if !kind.is_density() {
            let (at, slopes) = self.place(kind, input);
            let (_, mut derivatives) = self.simulator.rows_with_derivatives(&at)?;
            for (mut column, slope) in derivatives.column_iter_mut().zip(slopes) {
                // beyond its bounds a parameter moves nothing, whatever its derivative at the bound
                if slope == 0.0 {
                    column.fill(0.0);
                } else {
                    column *= slope;
                }
            }
            return Ok(derivatives);
        }
        let prior = self.prior(input, config);
        if prior.log == f64::NEG_INFINITY {
            return Ok(DMatrix::zeros(1, input[block].len()));
        }
        let likelihood = self.posterior.likelihood(blocks(input), scale(config))?;
        let of = |density: &Density| match block {
            0 => density.by_parameters.clone(),
            _ => density.by_scatter.clone(),
        };
        let mut row = DMatrix::from_row_slice(1, input[block].len(), &of(&likelihood));
        if kind == Kind::LogPosterior {
            row += DMatrix::from_row_slice(1, input[block].len(), &of(&prior));
        }
        Ok(row)
    }

    fn prior(&self, input: &[Vec<f64>], config: &Config) -> Density {
        self.posterior.prior(blocks(input), scale(config))
    }

    /// The parameters in their units, and their derivatives by the arguments.
    fn place(&self, kind: Kind, input: &[Vec<f64>]) -> (Place, Vec<f64>) {
        let scale = match kind {
            Kind::Standardised => Scale::Standardised,
            _ => Scale::Physical,
        };
        let each = self.simulator.parameters().iter().zip(&input[0]);
        let (theta, slopes): (Vec<f64>, Vec<f64>) =
            each.map(|(p, &x)| p.physical(x, scale)).unzip();
        (Place::common(&theta), slopes)
    }
}

fn scale(config: &Config) -> Scale {
    if config.standardised {
        Scale::Standardised
    } else {
        Scale::Physical
    }
}

/// Parameters and arguments of the scatter.
fn blocks(input: &[Vec<f64>]) -> (&[f64], &[f64]) {
    (&input[0], input.get(1).map_or(&[], Vec::as_slice))
}
