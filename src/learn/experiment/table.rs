//! The table of feasible tests after measurements: how well each separates what a diagnosis leaves.

use nalgebra::DVector;
use rayon::prelude::*;

use super::after_diagnosis;
use super::candidate_tests::{ENOUGH, feasible, shown};
use super::decided::Decided;
use super::discrimination::{Discrimination, PlannedResponse, Whitening, noise_ahead};
use super::made_tests::made;
use super::measurement_design::MeasurementDesign;
use super::next::{Place, plain};
use super::order::in_order;
use super::plan::{LEADERS, LEADING, Leader, NextTests, Plan, RankedTest, Separated};
use super::wording::{self, Repetition};
use crate::learn::candidates::fitted_candidate::FittedCandidate;
use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::checks::scatter_trend::trend_of_scatter;
use crate::learn::checks::sufficiency::too_few;
use crate::learn::decision::{DecisionRule, Verdict};
use crate::learn::fitting::measured::Measured;
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::model_search::context::Context;
use crate::learn::model_search::context::DiagnoseError;
use crate::learn::model_search::stages::{Stages, Watch};
use crate::learn::noise::{NoiseModel, SigmaModel};
use crate::learn::prediction::bench::Workshop;
use crate::learn::prediction::fidelity::Fidelity;
use crate::measure::Quantity;
use crate::simulate::forward::ContactKind;
use crate::study::{Operation, Role};

/// Quantities of the table.
const QUANTITIES: [Quantity; 3] = [
    Quantity::WearDepth,
    Quantity::TransmissionError,
    Quantity::MassLoss,
];

/// The table of feasible tests for a study's measurements: for the leading candidates of a finished diagnosis of them, without one for
/// those that lead by the analytic model.
///
/// # Errors
/// [`DiagnoseError`]
pub fn plan_after(
    measured: &Measured<'_>,
    decided: Option<&Decided>,
    noise: f64,
    watch: Watch<'_>,
) -> Result<Plan, DiagnoseError> {
    let study = measured.study();
    let fitted = NoiseModel {
        model_error: Some(Fidelity::Screening.model_error()),
        ..NoiseModel::of(&study.noise)
    };
    let likelihood = Likelihood::new(measured, fitted, Role::Fit);
    if likelihood.tests.is_empty() {
        return Err(DiagnoseError::NoObservations);
    }
    let numerics = Fidelity::Screening.resolution(study.resolution());
    let set = study.gear_set();
    let shop = Workshop::new(set, numerics, ContactKind::Hertz, measured.tests())?;
    let hertz = measured.bench(&shop)?;
    let stages = Stages::new(watch);
    let mut context = Context {
        likelihood,
        hertz: &hertz,
        middle: &hertz,
        exact: &hertz,
        stages: &stages,
        fidelity: Fidelity::Screening,
        approximate: true,
    };
    stages.begin([0.0, 0.2], "fitting the base model".to_owned(), 4);
    let base = context.base_by_scatter()?;
    let diagnosed = decided.map(|decided| {
        let doing = "fitting what the diagnosis left".to_owned();
        stages.begin([0.2, 0.6], doing, LEADERS[1]);
        decided.fitted(&context, &base)
    });
    let diagnosed = diagnosed.filter(|leaders| leaders.len() >= LEADERS[0]);
    let from_diagnosis = diagnosed.is_some();
    let leaders = diagnosed.unwrap_or_else(|| {
        let (singles, _) = Candidate::singles_for(study, &measured.data);
        let doing = format!("screening {} effects", singles.len());
        stages.begin([0.2, 0.6], doing, 2 * singles.len());
        leaders(&base.fitted, &context.screen(&base, &singles))
    });
    stages.begin([0.6, 1.0], "trying feasible tests".to_owned(), 1);
    let plainest = plain(&context);
    let tests = feasible(study, &plainest);
    let found: Vec<Vec<QuantityDiscrimination>> = tests
        .par_iter()
        .map(|(_, operation)| {
            discriminations(&context, &shop, operation, &leaders, Some(noise)).unwrap_or_default()
        })
        .collect();
    let repetition = repetition(&context, &shop, &leaders);
    let mut rows: Vec<RankedTest> = Vec::new();
    for ((changes, operation), told) in tests.iter().zip(&found) {
        rows.extend(
            told.iter()
                .map(|told| row(&context, *changes, operation, told, &leaders)),
        );
    }
    let tests = in_order(rows, &made(&study.tests, &measured.data));
    let trend = trend_of_scatter(&context.likelihood, &base.fitted.found.state);
    let too_few = too_few(&context.likelihood, &base);
    Ok(Plan::NextTests(NextTests {
        sentence: tests.first().map_or_else(
            || "No feasible test that is new could be computed.".to_owned(),
            |best| {
                let told = match after_diagnosis::measure_more(decided, best) {
                    Some(more) => more.to_owned(),
                    None => {
                        wording::sentence(best, &plainest, repetition.as_ref())
                            + &wording::made_already(best, &study.tests)
                            + &after_diagnosis::proposed(decided, best, &plainest)
                            + after_diagnosis::held_out(decided, &study.tests)
                    }
                };
                after_diagnosis::with_trend(trend.as_deref())
                    + &after_diagnosis::left_open(decided, best, from_diagnosis, too_few)
                    + &told
            },
        ),
        basis: basis(decided, from_diagnosis),
        diagnosed: from_diagnosis,
        leaders: leaders.into_iter().map(|(_, leader)| leader).collect(),
        noise,
        repetition_chi2: repetition.map_or(0.0, |best| best.chi2),
        tests,
    }))
}

/// The repetition of a test made already that says most of the leaders, with all that was measured in the test with most rows.
fn repetition(
    context: &Context<'_>,
    shop: &Workshop,
    leaders: &[(FittedCandidate, Leader)],
) -> Option<Repetition> {
    let measured = &context.likelihood.measured;
    let score = |&test: &usize| {
        let operation = &measured.study().tests[test].conditions;
        let found = discriminations(context, shop, operation, leaders, None)?;
        Some(Repetition {
            test: measured.data.tests[test].clone(),
            chi2: found.first()?.score(),
        })
    };
    let all: Vec<Option<Repetition>> = context.likelihood.tests.par_iter().map(score).collect();
    // of equals the first
    let better = |a: Repetition, b: Repetition| if b.chi2 > a.chi2 { b } else { a };
    all.into_iter().flatten().reduce(better)
}

/// Where the leaders come from, in words.
fn basis(decided: Option<&Decided>, from_diagnosis: bool) -> String {
    match decided {
        Some(decided) if from_diagnosis => {
            let unknown = match decided.verdict {
                Verdict::Unknown => {
                    "; it finds a cause outside the catalogue most likely, which these tests cannot show"
                }
                Verdict::Partial => {
                    "; these tests do not tell what is unknown beside them"
                }
                _ => "",
            };
            format!("the leaders of the finished diagnosis{unknown}")
        }
        Some(_) => "the leaders by the analytic model alone: it can fit at most one of those that the finished diagnosis names".to_owned(),
        None => "the leaders by the analytic model alone, which may be others than those of a diagnosis, or nothing may be missing: gearwear diagnose STUDY decides, and plan then starts from its answer".to_owned(),
    }
}

/// The leading candidates by the analytic model, one form of each effect.
fn leaders(base: &FittedCandidate, screened: &[FittedCandidate]) -> Vec<(FittedCandidate, Leader)> {
    let mut names: Vec<_> = screened.iter().map(|j| &j.candidate.effects).collect();
    names.sort();
    names.dedup();
    let rule = DecisionRule::of_analytic_model();
    let share = rule.prior_singles / names.len().max(1) as f64;
    let log = |j: &FittedCandidate| j.log_evidence + (share / j.candidate.siblings as f64).ln();
    let mut all: Vec<(FittedCandidate, f64)> = (screened.iter().cloned())
        .map(|fitted| {
            let log = log(&fitted);
            (fitted, log)
        })
        .collect();
    all.push((base.clone(), base.log_evidence + rule.prior_nothing.ln()));
    all.sort_by(|a, b| b.1.total_cmp(&a.1));
    let first = all.first().map_or(0.0, |best| best.1);
    let mut leaders: Vec<(FittedCandidate, Leader)> = Vec::new();
    for (judged, log) in all {
        let near = first - log < LEADING;
        let new = leaders
            .iter()
            .all(|l| l.0.candidate.effects != judged.candidate.effects);
        if new && (leaders.len() < LEADERS[0] || (leaders.len() < LEADERS[1] && near)) {
            let forms = judged.candidate.forms.iter().flatten();
            let forms: Vec<&str> = forms.map(|form| form.name).collect();
            let leader = Leader {
                effect: judged.candidate.hypothesis().to_string(),
                form: forms.join(", "),
                behind: first - log,
                probability: None,
            };
            leaders.push((judged, leader));
        }
    }
    leaders
}

/// What one quantity in one test says of the leader against each other candidate.
#[derive(Default)]
struct QuantityDiscrimination {
    quantity: Option<Quantity>,
    chi2: Vec<f64>,
    /// What each of these counts.
    weights: Vec<f64>,
    /// Where the leader's wear differs most from the second one's.
    place: Option<Place>,
}

impl QuantityDiscrimination {
    fn score(&self) -> f64 {
        let pairs = self.chi2.iter().zip(&self.weights);
        let capped: f64 = pairs.map(|(chi2, weight)| weight * chi2.min(ENOUGH)).sum();
        capped / self.weights.iter().sum::<f64>().max(f64::MIN_POSITIVE)
    }
}

/// What a test says by each of the quantities, with the relative `noise` of those that were not measured yet; without it, by all that was
/// measured together.
fn discriminations(
    context: &Context<'_>,
    shop: &Workshop,
    operation: &Operation,
    leaders: &[(FittedCandidate, Leader)],
    noise: Option<f64>,
) -> Option<Vec<QuantityDiscrimination>> {
    let study = context.likelihood.measured.study();
    let mut design = MeasurementDesign::measured(context, operation.cycles)?;
    if let Some(noise) = noise {
        design = design.completed(MeasurementDesign::standard(study, operation, noise)?);
    }
    let bench = shop.bench(vec![design.test(study, operation)]).ok()?;
    let said: Vec<PlannedResponse> = leaders
        .iter()
        .map(|(j, _)| PlannedResponse::of(&bench, &j.candidate, &j.found.state).ok())
        .collect::<Option<_>>()?;
    let columns: Vec<Vec<Vec<f64>>> = said
        .iter()
        .zip(leaders)
        .map(|(said, (judged, _))| {
            let mut columns = said.posterior(judged);
            columns.push(said.scatter(judged));
            columns
        })
        .collect();
    let data = design.with(&said[0].values);
    let likelihood = &context.likelihood;
    let is_measured = |quantity: Quantity| {
        (0..likelihood.len()).any(|row| likelihood.observation(row).quantity == quantity)
    };
    let of_rows = |(quantity, rows): (Option<Quantity>, Vec<usize>)| {
        // what was measured scatters as it did; of the rest the noise is assumed
        let sigma = if quantity.is_none_or(is_measured) {
            likelihood.noise.sigma
        } else {
            SigmaModel::AS_STATED
        };
        let scale = Whitening::new(&data, rows, &noise_ahead(study, sigma));
        let whitened = |columns: &[Vec<f64>]| -> Vec<DVector<f64>> {
            columns.iter().map(|c| scale.white(c)).collect()
        };
        let values: Vec<DVector<f64>> = said.iter().map(|s| scale.white(&s.values)).collect();
        let first = whitened(&columns[0]);
        let chi2 = (1..said.len())
            .map(|other| {
                let own = [first.clone(), whitened(&columns[other])].concat();
                Discrimination::new(&(&values[0] - &values[other]), &[], &own).chi2()
            })
            .collect();
        QuantityDiscrimination {
            quantity,
            chi2,
            weights: leaders[1..].iter().map(|(_, l)| l.weight()).collect(),
            place: (said.get(1))
                .and_then(|second| Place::of(&data, &said[0].values, &second.values)),
        }
    };
    let rows: Vec<(Option<Quantity>, Vec<usize>)> = match noise {
        None => vec![(None, (0..design.observations.len()).collect())],
        Some(_) => (QUANTITIES.into_iter())
            .map(|quantity| (Some(quantity), design.rows(quantity)))
            .collect(),
    };
    let there = rows.into_iter().filter(|(_, rows)| !rows.is_empty());
    Some(there.map(of_rows).collect())
}

fn row(
    context: &Context<'_>,
    changes: usize,
    operation: &Operation,
    told: &QuantityDiscrimination,
    leaders: &[(FittedCandidate, Leader)],
) -> RankedTest {
    let test = shown(operation);
    let names: Vec<String> = leaders
        .iter()
        .map(|(j, _)| j.candidate.hypothesis().to_string())
        .collect();
    let separates: Vec<Separated> = (names[1..].iter().zip(&told.chi2))
        .map(|(other, chi2)| Separated {
            pair: [names[0].clone(), other.clone()],
            chi2: *chi2,
        })
        .collect();
    let depth = told
        .place
        .as_ref()
        .filter(|_| told.quantity == Some(Quantity::WearDepth))
        .map_or(String::new(), |p| {
            format!(
                " Before refitting, {} and {} differ by up to {:.2} µm, on the {} after {:.2e} cycles.",
                names[0], names[1], p.largest, p.member, p.cycles
            )
        });
    RankedTest {
        why: format!(
            "{}{}{depth}",
            wording::purpose_of(&test, &plain(context)),
            wording::pairs(&separates)
        ),
        quantity: told.quantity.map_or("", Quantity::name).to_owned(),
        changes,
        expected_chi2: told.score(),
        separates,
        test,
    }
}

#[cfg(test)]
mod tests {
    use super::QuantityDiscrimination;

    /// A rival counts by its probability, and χ² up to 60.
    #[test]
    fn what_is_likelier_counts_more() {
        let score = |chi2: [f64; 2], weights: [f64; 2]| {
            let told = QuantityDiscrimination {
                chi2: chi2.into(),
                weights: weights.into(),
                ..QuantityDiscrimination::default()
            };
            told.score()
        };
        assert!((score([10.0, 50.0], [0.27, 0.03]) - 14.0).abs() < 1e-12);
        assert!((score([10.0, 500.0], [1.0, 1.0]) - 35.0).abs() < 1e-12);
    }
}
