//! A first campaign: the tests, chosen one after the other, that show and tell apart most effects of the catalogue.
//!
//! ```text
//! effect a at its prior's median is the truth; rival b is refitted: k, k per test, datums, its parameters and its strength
//! shown: D against no effect at all;  told apart: the least D against any rival;  both count from 6
//! ```
//! Linear in what is refitted. An effect in another form than the catalogue's is told apart less well than this says.

use nalgebra::DVector;
use rayon::prelude::*;

use super::candidate_tests::{CLEAR, changes, grid, purpose, ranked, shown};
use super::discrimination::{
    Discrimination, LEAST_SCATTER, PlannedResponse, Whitening, noise_ahead,
};
use super::measurement_design::MeasurementDesign;
use super::plan::{AloneTest, Campaign, ChosenTest, EffectVisibility, Plan};
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::inference::quadratic::State;
use crate::learn::model_search::context::{DiagnoseError, Watch};
use crate::learn::noise::SigmaModel;
use crate::learn::prediction::bench::Workshop;
use crate::learn::prediction::fidelity::Fidelity;
use crate::learn::prediction::predictor::PredictError;
use crate::measure::Quantity;
use crate::simulate::forward::ContactKind;
use crate::study::{Operation, Scatter, Study};

/// One standard deviation of ln k before any measurement: a factor of ten.
const K_SPREAD: f64 = std::f64::consts::LN_10;

/// What is measured: wear depths; with mass losses; with a transmission error too.
const MEASURED: [&[Quantity]; 3] = [
    &[Quantity::WearDepth],
    &[Quantity::WearDepth, Quantity::MassLoss],
    &[
        Quantity::WearDepth,
        Quantity::MassLoss,
        Quantity::TransmissionError,
    ],
];

/// The first campaign of a study without measurements, of `count` tests at most.
///
/// # Errors
/// [`DiagnoseError`] if the base model has no answer.
pub fn plan_first(
    study: &Study,
    noise: f64,
    count: usize,
    watch: Watch<'_>,
) -> Result<Plan, DiagnoseError> {
    let base = Candidate::base(study);
    let (singles, not_judged) = Candidate::singles(study);
    let candidates: Vec<Candidate> = std::iter::once(base)
        .chain(singles.into_iter().filter(Candidate::is_own_form))
        .collect();
    let numerics = Fidelity::Screening.resolution(study.resolution());
    let shop = Workshop::new(study.gear_set(), numerics, ContactKind::Hertz, &[])?;
    let tests = grid(&study.operation);
    watch(0.0, format!("running {} feasible tests", tests.len()));
    let seen: Vec<Option<TestResponses>> = tests
        .par_iter()
        .map(|(_, operation)| TestResponses::of(study, &shop, operation, &candidates, noise))
        .collect::<Result<_, PredictError>>()?;
    watch(0.9, "choosing".to_owned());
    // Only effects that run in every test that the base model runs in are compared.
    let runs = |c: &usize| seen.iter().flatten().all(|s| s.runs[*c]);
    let (kept, failed): (Vec<usize>, Vec<usize>) = (1..candidates.len()).partition(runs);
    let names: Vec<String> = candidates
        .iter()
        .map(|c| c.hypothesis().to_string())
        .collect();
    let tables: Vec<Option<DiscriminationTable>> = seen
        .iter()
        .map(|s| s.as_ref().map(|s| DiscriminationTable::new(s, &kept, 0)))
        .collect();
    let empty = DiscriminationTable::empty(kept.len());
    let told_apart = |score: &Score| -> Vec<usize> {
        (0..kept.len()).filter(|&a| score.told_apart(a)).collect()
    };
    let mut chosen: Vec<usize> = Vec::new();
    let mut made: Vec<ChosenTest> = Vec::new();
    let (mut joint, mut before) = (empty, Vec::new());
    while chosen.len() < count {
        let scores: Vec<(f64, usize)> = tables
            .iter()
            .enumerate()
            .map(|(i, table)| match table {
                Some(table) if !chosen.contains(&i) => {
                    (joint.and(table).score().value(), tests[i].0)
                }
                _ => (f64::NEG_INFINITY, usize::MAX),
            })
            .collect();
        let value = joint.score().value();
        // Near-equal in what is gained.
        let gains: Vec<(f64, usize)> = scores.iter().map(|s| (s.0 - value, s.1)).collect();
        let best = ranked(&gains).first().copied();
        let Some((best, table)) = best
            .filter(|&i| gains[i].0 > 0.0)
            .and_then(|i| tables[i].as_ref().map(|table| (i, table)))
        else {
            break;
        };
        joint = joint.and(table);
        chosen.push(best);
        let score = joint.score();
        let now = told_apart(&score);
        let newly: Vec<String> = now
            .iter()
            .filter(|a| !before.contains(*a))
            .map(|&a| names[kept[a]].clone())
            .collect();
        let test = shown(&tests[best].1);
        made.push(ChosenTest {
            detectable: score.detectable(),
            told_apart: now.len(),
            why: purpose(&test, &study.operation),
            newly,
            test,
        });
        before = now;
    }
    let score = joint.score();
    let effects: Vec<EffectVisibility> = (0..kept.len())
        .map(|a| EffectVisibility {
            effect: names[kept[a]].clone(),
            detection_chi2: score.shown[a],
            nearest: score.nearest[a].map_or(String::new(), |b| names[kept[b]].clone()),
            nearest_chi2: score.apart[a],
            detectable: score.shown[a] >= CLEAR,
            told_apart: score.told_apart(a),
        })
        .collect();
    let with = |measured: usize| {
        let tables = chosen.iter().filter_map(|&i| seen[i].as_ref());
        let joint = tables.fold(DiscriminationTable::empty(kept.len()), |joint, seen| {
            joint.and(&DiscriminationTable::new(seen, &kept, measured))
        });
        let names: Vec<&str> = MEASURED[measured].iter().map(|q| q.name()).collect();
        (names.join(" + "), told_apart(&joint.score()).len())
    };
    let mut alone: Vec<AloneTest> = Vec::new();
    for (i, (changes, operation)) in tests.iter().enumerate() {
        let Some(table) = &tables[i] else { continue };
        let score = table.score();
        alone.push(AloneTest {
            test: shown(operation),
            changes: *changes,
            detectable: score.detectable(),
            told_apart: told_apart(&score).len(),
            chosen: chosen.iter().position(|&c| c == i).map(|place| place + 1),
        });
    }
    alone.sort_by(|a, b| {
        (b.told_apart, b.detectable, a.changes).cmp(&(a.told_apart, a.detectable, b.changes))
    });
    Ok(Plan::Campaign(Campaign {
        sentence: sentence(study, &made, kept.len()),
        told_apart_with: [with(1), with(2)],
        noise,
        tests: made,
        effects,
        alone,
        not_judged,
        failed: failed.into_iter().map(|i| names[i].clone()).collect(),
    }))
}

/// What all candidates say of one test, in units of its noise, for each set of quantities.
struct TestResponses {
    /// Whether a candidate has an answer there.
    runs: Vec<bool>,
    by_quantities: Vec<Vec<White>>,
}

/// One candidate's in units of the noise.
struct White {
    values: DVector<f64>,
    /// By k, by each parameter, and by the strength: common to tests.
    common: Vec<DVector<f64>>,
    /// By k of the test.
    own: Vec<DVector<f64>>,
}

impl TestResponses {
    /// None if the gears do not run there.
    fn of(
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
        let said: Vec<Result<PlannedResponse, PredictError>> = candidates
            .par_iter()
            .map(|candidate| PlannedResponse::of(&bench, candidate, &median(study, candidate)))
            .collect();
        let runs: Vec<bool> = said.iter().map(Result::is_ok).collect();
        let base = match &said[0] {
            Ok(base) => base.values.clone(),
            Err(error) => return Err(error.clone()),
        };
        let data = design.with(&base);
        let noise = noise_ahead(study, SigmaModel::AS_STATED);
        let scatter = match study.noise.coefficient_scatter {
            Scatter::Relative(scatter) => scatter,
            Scatter::Estimate => LEAST_SCATTER,
        };
        let of = |quantities: &[Quantity]| -> Vec<White> {
            let rows = quantities.iter().flat_map(|q| design.rows(*q)).collect();
            let scale = Whitening::new(&data, rows, &noise);
            let base = scale.white(&base);
            (said.iter().zip(candidates))
                .map(|(said, candidate)| {
                    let Ok(said) = said else {
                        return White {
                            values: DVector::zeros(base.len()),
                            common: Vec::new(),
                            own: Vec::new(),
                        };
                    };
                    let values = scale.white(&said.values);
                    let by_k = scale.white(&said.by_k);
                    let mut common = vec![&by_k * K_SPREAD];
                    let own = said.prior(candidate);
                    common.extend(own.iter().map(|column| scale.white(column)));
                    common.push(&values - &base);
                    White {
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

/// What some tests together say: of every effect as the truth against no effect, and against every other one.
struct DiscriminationTable {
    nothing: Vec<Option<Discrimination>>,
    rivals: Vec<Vec<Option<Discrimination>>>,
}

impl DiscriminationTable {
    fn empty(count: usize) -> Self {
        Self {
            nothing: vec![None; count],
            rivals: vec![vec![None; count]; count],
        }
    }

    fn new(seen: &TestResponses, kept: &[usize], measured: usize) -> Self {
        let white = &seen.by_quantities[measured];
        let of = |truth: usize, rival: usize| {
            let (a, b) = (&white[truth], &white[rival]);
            Some(Discrimination::new(
                &(&a.values - &b.values),
                &b.common,
                &b.own,
            ))
        };
        let against = |a: usize| {
            let others = kept.iter();
            others
                .map(|&b| if b == a { None } else { of(a, b) })
                .collect()
        };
        Self {
            nothing: kept.iter().map(|&a| of(a, 0)).collect(),
            rivals: kept.par_iter().map(|&a| against(a)).collect(),
        }
    }

    fn and(&self, other: &Self) -> Self {
        let join = |a: &[Option<Discrimination>],
                    b: &[Option<Discrimination>]|
         -> Vec<Option<Discrimination>> {
            let both = a.iter().zip(b);
            both.map(|(a, b)| match (a, b) {
                (Some(a), Some(b)) => Some(a.and(b)),
                (one, other) => one.as_ref().or(other.as_ref()).cloned(),
            })
            .collect()
        };
        let rivals = self.rivals.iter().zip(&other.rivals);
        Self {
            nothing: join(&self.nothing, &other.nothing),
            rivals: rivals.map(|(a, b)| join(a, b)).collect(),
        }
    }

    fn score(&self) -> Score {
        let chi2 = |discrimination: &Option<Discrimination>| {
            discrimination.as_ref().map_or(0.0, Discrimination::chi2)
        };
        let mut score = Score {
            shown: self.nothing.iter().map(chi2).collect(),
            nearest: Vec::new(),
            apart: Vec::new(),
        };
        for (a, rivals) in self.rivals.iter().enumerate() {
            let others = (0..rivals.len()).filter(|&b| b != a);
            let nearest = others
                .map(|b| (b, chi2(&rivals[b])))
                .min_by(|x, y| x.1.total_cmp(&y.1));
            score.nearest.push(nearest.map(|n| n.0));
            score.apart.push(nearest.map_or(score.shown[a], |n| n.1));
        }
        score
    }
}

/// χ² of every effect against nothing and against its nearest look-alike.
struct Score {
    shown: Vec<f64>,
    nearest: Vec<Option<usize>>,
    apart: Vec<f64>,
}

impl Score {
    fn detectable(&self) -> usize {
        self.shown.iter().filter(|c| **c >= CLEAR).count()
    }

    fn told_apart(&self, a: usize) -> bool {
        self.shown[a].min(self.apart[a]) >= CLEAR
    }

    /// Effects told apart, then those shown, then how near the others are: what a choice makes large.
    fn value(&self) -> f64 {
        let near = |c: f64| (c / CLEAR).min(1.0);
        (0..self.shown.len())
            .map(|a| {
                let apart = self.shown[a].min(self.apart[a]);
                f64::from(u8::from(apart >= CLEAR)) + 0.3 * near(self.shown[a]) + 0.3 * near(apart)
            })
            .sum()
    }
}

fn sentence(study: &Study, made: &[ChosenTest], effects: usize) -> String {
    let Some(last) = made.last() else {
        return "No feasible test shows any effect of the catalogue.".to_owned();
    };
    let tests: Vec<String> = made
        .iter()
        .map(|m| changes(&m.test, &study.operation))
        .collect();
    format!(
        "{} tests ({}) show {} of {effects} effects at their median strength and tell {} from every look-alike.",
        made.len(),
        tests.join(" | "),
        last.detectable,
        last.told_apart
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn discrimination(v: f64) -> Option<Discrimination> {
        Some(Discrimination::new(&DVector::from_element(1, v), &[], &[]))
    }

    #[test]
    fn an_effect_counts_when_it_shows_and_no_other_looks_like_it() {
        let table = DiscriminationTable {
            nothing: vec![discrimination(3.0), discrimination(4.0)],
            rivals: vec![
                vec![None, discrimination(1.0)],
                vec![discrimination(5.0), None],
            ],
        };
        let score = table.score();
        assert_eq!(score.detectable(), 2);
        assert!(!score.told_apart(0) && score.told_apart(1));
        assert_eq!(score.nearest, [Some(1), Some(0)]);
        // a second test of the same kind adds its χ²
        let both = table.and(&table).score();
        assert!((both.apart[0] - 2.0).abs() < 1e-12);
        assert!(both.value() > score.value());
        // the empty set of tests says nothing and adds nothing
        let with = DiscriminationTable::empty(2).and(&table).score();
        assert_eq!(with.apart, score.apart);
    }
}
