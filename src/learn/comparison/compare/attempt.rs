//! A fit from one start or from several, and given up early where it is hopeless.

use crate::learn::comparison::missed::BaselineMisfit;
use crate::learn::fitting::fit::{FitError, Problem};
use crate::learn::fitting::fitted::Fit;
use crate::learn::fitting::measured::Measured;
use crate::learn::fitting::starts::Start;
use crate::learn::hypothesis::version::ModelVersion;
use crate::learn::inference::search::Effort;

/// A fit that is far from the measurements, and by no more than this share of χ² farther than a cheaper model promises of the best of several starts,
/// is not looked for from elsewhere.
const ATTAINED: f64 = 0.05;

/// Steps after which it is looked at whether a fit is hopeless.
const LOOK_STEPS: usize = 6;

/// A version of the model to be fitted, and from where.
pub(super) struct Attempt<'a> {
    pub(super) measured: &'a Measured<'a>,
    pub(super) problem: &'a Problem<'a>,
    pub(super) version: &'a ModelVersion,
    pub(super) start: &'a Start,
    /// What the model without its last effect misses, if a hopeless fit may be given up.
    pub(super) missed: Option<&'a BaselineMisfit<'a>>,
    pub(super) effort: &'a Effort,
    /// Whether the last effect multiplies the work.
    pub(super) dear: bool,
}

/// The fit from the first start.
pub(super) enum FirstFit {
    /// It explains only this share of what the model without its last effect misses beyond noise.
    Hopeless {
        fit: Fit,
        share: f64,
    },
    Hopeful(Fit),
}

impl Attempt<'_> {
    /// From its start; `anchored` where a cheaper model's end is known on this bench.
    pub(super) fn first(&self, anchored: bool) -> Result<FirstFit, FitError> {
        let Some(missed) = self.missed else {
            let fit = self.from(self.start.values.clone(), self.effort)?;
            return Ok(FirstFit::Hopeful(fit));
        };
        let little = self.dear
            && anchored
            && !missed.promises(self.measured, self.version, self.start.promised);
        let fit = self.look(missed, little)?;
        if let Some(share) = missed.hopeless(self.measured, &fit) {
            // not worth the price of the held-out tests
            let fit = if self.dear {
                fit
            } else {
                self.problem.judged(fit, self.effort)?
            };
            return Ok(FirstFit::Hopeless { fit, share });
        }
        let fit = if fit.converged {
            fit
        } else {
            self.go_on(&fit)?
        };
        Ok(FirstFit::Hopeful(fit))
    }

    /// A look at a fit against what the model without its last effect `missed`: where a cheaper model promises `little` at that model's end, else some
    /// steps from the start, and if these are hopeless though more is promised, from the priors' medians too.
    fn look(&self, missed: &BaselineMisfit<'_>, little: bool) -> Result<Fit, FitError> {
        let is_hopeless = |fit: &Fit| missed.hopeless(self.measured, fit).is_some();
        if little
            && let Some(cheaper) = &self.start.fit
            && let Ok(fit) = self.problem.go_on(cheaper, &Effort::STAY)
            && is_hopeless(&fit)
        {
            return Ok(fit);
        }
        let first = self.from(self.start.values.clone(), &self.look_effort())?;
        if is_hopeless(&first) && missed.promises(self.measured, self.version, self.start.promised)
        {
            let second = self.from(self.version.medians(), &self.look_effort()).ok();
            let better =
                second.filter(|second| second.attained_evidence() > first.attained_evidence());
            return Ok(better.unwrap_or(first));
        }
        Ok(first)
    }

    /// The first fit or, where that has not settled or leaves more than noise, the best by evidence of it and of those from the priors' medians and from
    /// values that somebody has chosen: a cheaper model may have led the first one into a valley of its own.
    pub(super) fn best_of_starts(&self, first: Fit) -> Fit {
        let done = first.is_settled() && self.measured.misfit(&first).is_noise();
        if done || self.version.effects.is_empty() || self.attains_promise(&first) {
            return first;
        }
        let chosen = Some(self.version.own_values()).filter(|_| self.version.is_chosen());
        let medians = self.version.medians();
        let mut best = first;
        if !best.is_settled() || self.start.values != medians {
            best = self.better_from(&medians, best);
        }
        if let Some(chosen) = chosen.filter(|own| *own != medians && *own != self.start.values) {
            best = self.better_from(&chosen, best);
        }
        best
    }

    /// The fit from `start` if it attains more evidence than the `best` yet; where that one has settled, or is far from the measurements, only
    /// if it does so after a look.
    fn better_from(&self, start: &[f64], best: Fit) -> Fit {
        let attained = best.attained_evidence();
        let next = if best.is_settled() || self.is_far(&best) {
            (self.from(start.to_vec(), &self.look_effort()).ok())
                .filter(|next| next.attained_evidence() > attained)
                .and_then(|next| self.go_on(&next).ok())
        } else {
            self.from(start.to_vec(), self.effort).ok()
        };
        next.filter(|next| next.attained_evidence() > attained + self.effort.tolerance)
            .unwrap_or(best)
    }

    /// Whether a fit that may be given up leaves far more than noise.
    pub(super) fn is_far(&self, fit: &Fit) -> bool {
        self.missed.is_some() && self.measured.misfit(fit).is_far()
    }

    /// Whether a far fit leaves about what the cheaper model promised.
    fn attains_promise(&self, fit: &Fit) -> bool {
        let near = |promised| self.measured.misfit(fit).square < (1.0 + ATTAINED) * promised;
        self.is_far(fit) && self.start.promised.is_some_and(near)
    }

    /// A look followed to its end.
    fn go_on(&self, look: &Fit) -> Result<Fit, FitError> {
        let end = self.problem.go_on(look, self.effort)?;
        Ok(Fit {
            iterations: look.iterations + end.iterations,
            evaluations: look.evaluations + end.evaluations,
            ..end
        })
    }

    fn from(&self, start: Vec<f64>, effort: &Effort) -> Result<Fit, FitError> {
        self.problem.fit_from(&[start], effort)
    }

    fn look_effort(&self) -> Effort {
        Effort {
            iterations: LOOK_STEPS,
            ..*self.effort
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learn::fitting::fit::Coefficient;
    use crate::learn::hypothesis::parameters::Parameter;
    use crate::learn::noise::NoiseModel;
    use crate::learn::prediction::predictor::{PredictError, Predictor};
    use crate::measure::Dataset;
    use crate::study::{Role, Study};

    /// A band of wear along the flank: 10 (1 + a exp(−((x − c)/w)²)) µm at radii from 25.6 to 28.8 mm.
    struct Band;

    const PLACES: usize = 80;

    fn place(i: usize) -> f64 {
        25.6 + 0.04 * i as f64
    }

    impl Predictor for Band {
        fn predict(&self, _: usize, _: f64, theta: &[f64]) -> Result<Vec<f64>, PredictError> {
            let at =
                |i: usize| 1.0 + theta[0] * (-((place(i) - theta[1]) / theta[2]).powi(2)).exp();
            Ok((0..PLACES).map(|i| 10.0 * at(i)).collect())
        }
    }

    /// A cheaper model that sees no band begins where the data have none; neither that place nor the priors' medians lead to the narrow band, the
    /// values that the study states do.
    #[test]
    fn stated_values_are_tried_where_a_cheaper_model_leads_astray() {
        let text = include_str!("../../../../validation/challenges/none_L2/study.toml").to_owned()
            + "[fit]\nfree = [\"band.more\", \"band.where\", \"band.width\"]\n\
               [[effect]]\nkind = \"formula\"\nname = \"band\"\nwear_factor = \"1 + more*exp(-((radius-where)/width)^2)\"\n\
               [effect.parameters]\nmore = { value = 0.5, lower = 0.0, upper = 5.0 }\n\
               where = { value = 26.05, lower = 25.0, upper = 31.0 }\nwidth = { value = 0.2, lower = 0.03, upper = 1.0 }\n";
        let study = Study::parse(&text, "study.toml").unwrap();
        let mut table = "test,member,cycles,quantity,position,value,sigma\n".to_owned();
        let truth = [0.9, 26.0, 0.12];
        for (i, depth) in (Band.predict(0, 0.0, &truth).unwrap()).iter().enumerate() {
            table += &format!("A,pinion,1e5,wear_depth,{},{depth},0.5\n", place(i));
        }
        let data = Dataset::parse(&table, "m.csv", &study.known()).unwrap();
        let measured = Measured::new(&study, data.clone());
        let version = ModelVersion::of(&study);
        let parameters = (version.free_of_effects())
            .map(|free| Parameter::uniform(&free.name, "-", free.value, free.lower, free.upper));
        let roles = vec![Role::Fit; data.tests.len()];
        let problem = Problem {
            data: &data,
            roles: &roles,
            predictor: &Band,
            coefficient: Coefficient::Fixed(1e-10),
            parameters: parameters.collect(),
            noise: NoiseModel::of(&study.noise),
        };
        let attempt = Attempt {
            measured: &measured,
            problem: &problem,
            version: &version,
            start: &Start::at(vec![0.0, 28.0, 0.5]),
            missed: None,
            effort: &Effort::for_simulations(),
            dear: false,
        };
        let FirstFit::Hopeful(astray) = attempt.first(false).unwrap() else {
            panic!("no fit is given up without a model to hold it against")
        };
        assert!(astray.parameters[0].value < 0.1, "{:?}", astray.parameters);
        let best = attempt.best_of_starts(astray);
        for (found, truth) in best.parameters.iter().zip(truth) {
            assert!((found.value - truth).abs() < 0.02, "{:?}", best.parameters);
        }
    }
}
