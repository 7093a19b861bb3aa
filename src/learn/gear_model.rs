//! The gear pair as a fit sees it: a wear history of each test, read at the measured places.

use crate::effects::Combined;
use crate::learn::bench::Bench;
use crate::learn::observe::Reading;
use crate::learn::predictor::{PredictError, Predictor};
use crate::simulate::forward::ForwardError;
use crate::wear::acting::Acting;

/// Builds the effects of a model from the values of its free parameters.
pub type EffectsOf<'a> = Box<dyn Fn(&[f64]) -> Combined + Send + Sync + 'a>;

/// A model of the gears on a bench: base model and effects, with some of the effects' parameters free.
pub struct GearModel<'a> {
    bench: &'a Bench<'a>,
    effects: EffectsOf<'a>,
}

impl<'a> GearModel<'a> {
    /// The model with `effects`, from parameter values in the order that callers of [`Predictor::predict`] use.
    pub fn new(bench: &'a Bench<'a>, effects: EffectsOf<'a>) -> Self {
        Self { bench, effects }
    }

    fn run(
        &self,
        test: usize,
        coefficient: f64,
        parameters: &[f64],
    ) -> Result<Vec<f64>, ForwardError> {
        let measured = &self.bench.tests[test];
        let effects = (self.effects)(parameters);
        let acting = (!effects.is_empty()).then(|| Acting {
            effects,
            surroundings: measured.surroundings,
            torque: 1e-3 * measured.conditions.torque,
            speed: measured.conditions.speed,
            reversed: measured.reversed,
            face_width: self.bench.set().face_width,
        });
        let mut forward = self.bench.templates[test].again([coefficient; 2], acting.as_ref())?;
        let mut values = vec![0.0; measured.observations.len()];
        let mut order: Vec<usize> = (0..values.len()).collect();
        order.sort_by(|&a, &b| {
            let cycles = |i: usize| measured.observations[i].cycles;
            cycles(a).total_cmp(&cycles(b)).then(a.cmp(&b))
        });
        let mut progress = None;
        let alike = |a: &usize, b: &usize| {
            measured.observations[*a].cycles == measured.observations[*b].cycles
        };
        for rows in order.chunk_by(alike) {
            let cycles = measured.observations[rows[0]].cycles;
            forward.wear_to(&mut progress, cycles, &mut |_, _| true)?;
            let Some(progress) = &progress else { continue };
            let reading = Reading::new(&forward, progress, self.bench.set());
            for &row in rows {
                values[row] = reading.of(&measured.observations[row])?;
            }
        }
        Ok(values)
    }
}

impl Predictor for GearModel<'_> {
    fn predict(
        &self,
        test: usize,
        coefficient: f64,
        parameters: &[f64],
    ) -> Result<Vec<f64>, PredictError> {
        self.run(test, coefficient, parameters)
            .map_err(|error| PredictError {
                test: self.bench.tests[test].id.clone(),
                reason: error.to_string(),
            })
    }
}
