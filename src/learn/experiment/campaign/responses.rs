//! What every candidate predicts of one test, in units of its noise.

use nalgebra::DVector;
use rayon::prelude::*;

use crate::learn::experiment::discrimination::{
    LEAST_SCATTER, PlannedResponse, Whitening, noise_ahead,
};
use crate::learn::experiment::measurement_design::MeasurementDesign;
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::inference::quadratic::State;
use crate::learn::noise::SigmaModel;
use crate::learn::prediction::bench::Workshop;
use crate::learn::prediction::predictor::PredictError;
use crate::measure::Quantity;
use crate::study::{Operation, Scatter, Study};

/// One standard deviation of ln k before any measurement: a factor of ten.
const K_SPREAD: f64 = std::f64::consts::LN_10;

/// What is measured: wear depths; with mass losses; with a transmission error too.
pub(super) const MEASURED: [&[Quantity]; 3] = [
    &[Quantity::WearDepth],
    &[Quantity::WearDepth, Quantity::MassLoss],
    &[
        Quantity::WearDepth,
        Quantity::MassLoss,
        Quantity::TransmissionError,
    ],
];

/// What all candidates predict of one test, in units of its noise, for each set of quantities.
pub(super) struct TestResponses {
    /// Whether a candidate has an answer there.
    pub(super) runs: Vec<bool>,
    pub(super) by_quantities: Vec<Vec<WhitenedResponse>>,
}

/// One candidate's in units of the noise.
pub(super) struct WhitenedResponse {
    pub(super) values: DVector<f64>,
    /// By k, by each parameter, and by the strength: common to tests.
    pub(super) common: Vec<DVector<f64>>,
    /// By k of the test.
    pub(super) own: Vec<DVector<f64>>,
}

impl TestResponses {
    /// None if the gears do not run there.
    pub(super) fn of(
        study: &Study,
        shop: &Workshop,
        operation: &Operation,
        candidates: &[Candidate],
        noise: f64,
    ) -> Result<Option<Self>, PredictError> {
        let Some(design) = MeasurementDesign::standard(study, operation, noise) else {
            return Ok(None);
        };
        let Ok(bench) = shop.bench(vec![design.test(study, operation)]) else {
            return Ok(None);
        };
        let planned: Vec<Result<PlannedResponse, PredictError>> = candidates
            .par_iter()
            .map(|candidate| PlannedResponse::of(&bench, candidate, &median(study, candidate)))
            .collect();
        let runs: Vec<bool> = planned.iter().map(Result::is_ok).collect();
        let base = match &planned[0] {
            Ok(base) => base.values.clone(),
            Err(error) => return Err(error.clone()),
        };
        let data = design.with(&base);
        let noise = noise_ahead(study, SigmaModel::AS_STATED);
        let scatter = match study.noise.coefficient_scatter {
            Scatter::Relative(scatter) => scatter,
            Scatter::Estimate => LEAST_SCATTER,
        };
        let of = |quantities: &[Quantity]| -> Vec<WhitenedResponse> {
            let rows = quantities.iter().flat_map(|q| design.rows(*q)).collect();
            let scale = Whitening::new(&data, rows, &noise);
            let base = scale.white(&base);
            (planned.iter().zip(candidates))
                .map(|(planned, candidate)| {
                    let Ok(planned) = planned else {
                        return WhitenedResponse {
                            values: DVector::zeros(base.len()),
                            common: Vec::new(),
                            own: Vec::new(),
                        };
                    };
                    let values = scale.white(&planned.values);
                    let by_k = scale.white(&planned.by_k);
                    let mut common = vec![&by_k * K_SPREAD];
                    let own = planned.prior(candidate);
                    common.extend(own.iter().map(|column| scale.white(column)));
                    common.push(&values - &base);
                    WhitenedResponse {
                        own: vec![by_k * scatter],
                        values,
                        common,
                    }
                })
                .collect()
        };
        Ok(Some(Self {
            runs,
            by_quantities: MEASURED.iter().map(|quantities| of(quantities)).collect(),
        }))
    }
}

/// The study's k and an effect's median strength.
fn median(study: &Study, candidate: &Candidate) -> State {
    let values = candidate.medians();
    let own = candidate.parameters.iter().zip(&values);
    State {
        log_k: study.wear.coefficient.ln(),
        theta: own.map(|(p, &x)| p.natural_start(x)).collect(),
        epsilon: vec![0.0],
    }
}
