//! A first campaign: the tests, chosen one after the other, that show and tell apart most effects of the catalogue.
//!
//! ```text
//! effect a at its prior's median is the truth; rival b is refitted: k, k per test, datums, its parameters and its strength
//! shown: D against no effect at all;  told apart: the least D against any rival;  both count from 6
//! ```
//! Linear in what is refitted. An effect in another form than the catalogue's is told apart less well than this says.

mod additions;
mod responses;
mod score;

use rayon::prelude::*;

use self::additions::{adds, not_shown};
use self::responses::{MEASURED, TestResponses};
use self::score::{DiscriminationTable, Score};
use super::candidate_tests::{CLEAR, changes, feasible, purpose, ranked, shown};
use super::plan::{AloneTest, Campaign, ChosenTest, EffectVisibility, Plan};
use crate::learn::hypothesis::candidate::Candidate;
use crate::learn::model_search::context::DiagnoseError;
use crate::learn::model_search::stages::Watch;
use crate::learn::prediction::bench::Workshop;
use crate::learn::prediction::fidelity::Fidelity;
use crate::learn::prediction::predictor::PredictError;
use crate::numeric::written::significant;
use crate::simulate::forward::ContactKind;
use crate::study::{Operation, Study};

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
    let feasible = FeasibleTests::new(study, &candidates, noise, watch)?;
    watch(0.9, "choosing".to_owned());
    let choice = feasible.choose(&study.operation, count);
    Ok(Plan::Campaign(Campaign {
        sentence: sentence(study, &choice.tests, &feasible.names(&feasible.kept))
            + &not_shown(&feasible.effects(&choice.joint.score())),
        told_apart_with: [1, 2].map(|measured| feasible.told_apart_with(&choice, measured)),
        noise,
        effects: feasible.effects(&choice.joint.score()),
        alone: feasible.alone(&choice),
        tests: choice.tests,
        not_judged,
        failed: feasible.names(&feasible.failed),
    }))
}

/// All tests that may be made, and what the effects of the catalogue do in each.
struct FeasibleTests {
    /// The base model's and every effect's name.
    candidates: Vec<String>,
    /// Effects that run wherever the base model runs, and the others: only the first are compared.
    kept: Vec<usize>,
    failed: Vec<usize>,
    /// Conditions with their number of changes against the study's.
    tests: Vec<(usize, Operation)>,
    /// None where the gears do not run.
    responses: Vec<Option<TestResponses>>,
    /// By wear depths alone.
    tables: Vec<Option<DiscriminationTable>>,
}

/// The chosen tests.
struct Choice {
    /// Their places among the feasible ones, in the order of their choice.
    places: Vec<usize>,
    tests: Vec<ChosenTest>,
    /// What they show together.
    joint: DiscriminationTable,
}

impl FeasibleTests {
    fn new(
        study: &Study,
        candidates: &[Candidate],
        noise: f64,
        watch: Watch<'_>,
    ) -> Result<Self, DiagnoseError> {
        let numerics = Fidelity::Screening.resolution(study.resolution());
        let shop = Workshop::new(study.gear_set(), numerics, ContactKind::Hertz, &[])?;
        let tests = feasible(study, &study.operation);
        watch(0.0, format!("running {} feasible tests", tests.len()));
        let responses: Vec<Option<TestResponses>> = tests
            .par_iter()
            .map(|(_, operation)| TestResponses::of(study, &shop, operation, candidates, noise))
            .collect::<Result<_, PredictError>>()?;
        let runs = |c: &usize| responses.iter().flatten().all(|r| r.runs[*c]);
        let (kept, failed): (Vec<usize>, Vec<usize>) = (1..candidates.len()).partition(runs);
        let table = |r: &TestResponses| DiscriminationTable::new(r, &kept, 0);
        let tables = responses.iter().map(|r| r.as_ref().map(table)).collect();
        let names = candidates.iter().map(|c| c.hypothesis().to_string());
        Ok(Self {
            candidates: names.collect(),
            kept,
            failed,
            tests,
            responses,
            tables,
        })
    }

    fn names(&self, candidates: &[usize]) -> Vec<String> {
        let names = candidates.iter().map(|&c| self.candidates[c].clone());
        names.collect()
    }

    /// Of the compared effects, which a set of tests tells from every other one.
    fn told_apart(&self, score: &Score) -> Vec<usize> {
        (0..self.kept.len())
            .filter(|&a| score.told_apart(a))
            .collect()
    }

    /// One test after the other, as long as one adds something.
    fn choose(&self, plain: &Operation, count: usize) -> Choice {
        let mut choice = Choice {
            places: Vec::new(),
            tests: Vec::new(),
            joint: DiscriminationTable::empty(self.kept.len()),
        };
        let mut before = Vec::new();
        while choice.places.len() < count {
            let Some((place, joint)) = self.best_addition(&choice) else {
                break;
            };
            let score = joint.score();
            let [earlier, now] = [&choice.joint.score(), &score].map(|score| self.effects(score));
            let told_apart = self.told_apart(&score);
            let newly: Vec<usize> = (told_apart.iter())
                .filter(|a| !before.contains(*a))
                .map(|&a| self.kept[a])
                .collect();
            let test = shown(&self.tests[place].1);
            choice.tests.push(ChosenTest {
                detectable: score.detectable(),
                told_apart: told_apart.len(),
                why: purpose(&test, plain),
                newly: self.names(&newly),
                adds: adds(&earlier, &now),
                test,
            });
            choice.places.push(place);
            choice.joint = joint;
            before = told_apart;
        }
        choice
    }

    /// The test that adds most to a choice, of near-equal ones the plainest, and what it shows with the others; None if none adds anything.
    fn best_addition(&self, choice: &Choice) -> Option<(usize, DiscriminationTable)> {
        let value = choice.joint.score().value();
        let gain = |(place, table): (usize, &Option<DiscriminationTable>)| match table {
            Some(table) if !choice.places.contains(&place) => {
                let gain = choice.joint.and(table).score().value() - value;
                (gain, self.tests[place].0)
            }
            _ => (f64::NEG_INFINITY, usize::MAX),
        };
        let gains: Vec<(f64, usize)> = self.tables.iter().enumerate().map(gain).collect();
        let best = *ranked(&gains).first()?;
        let table = self.tables[best].as_ref()?;
        (gains[best].0 > 0.0).then(|| (best, choice.joint.and(table)))
    }

    fn effects(&self, score: &Score) -> Vec<EffectVisibility> {
        let name = |a: usize| self.candidates[self.kept[a]].clone();
        (0..self.kept.len())
            .map(|a| EffectVisibility {
                effect: name(a),
                detection_chi2: score.shown[a],
                nearest: score.nearest[a].map_or(String::new(), name),
                nearest_chi2: score.apart[a],
                detectable: score.shown[a] >= CLEAR,
                told_apart: score.told_apart(a),
            })
            .collect()
    }

    /// A set of measured quantities, and how many effects the chosen tests tell apart by them.
    fn told_apart_with(&self, choice: &Choice, measured: usize) -> (String, usize) {
        let joint = (choice.places.iter())
            .filter_map(|&place| self.responses[place].as_ref())
            .map(|responses| DiscriminationTable::new(responses, &self.kept, measured))
            .fold(
                DiscriminationTable::empty(self.kept.len()),
                |joint, table| joint.and(&table),
            );
        let names: Vec<&str> = MEASURED[measured].iter().map(|q| q.name()).collect();
        (names.join(" + "), self.told_apart(&joint.score()).len())
    }

    /// Every test by itself, the most telling first.
    fn alone(&self, choice: &Choice) -> Vec<AloneTest> {
        let mut alone = Vec::new();
        for (place, (changes, operation)) in self.tests.iter().enumerate() {
            let Some(table) = &self.tables[place] else {
                continue;
            };
            let score = table.score();
            let chosen = choice.places.iter().position(|&c| c == place);
            alone.push(AloneTest {
                test: shown(operation),
                changes: *changes,
                detectable: score.detectable(),
                told_apart: self.told_apart(&score).len(),
                chosen: chosen.map(|order| order + 1),
            });
        }
        alone.sort_by(|a, b| {
            (b.told_apart, b.detectable, a.changes).cmp(&(a.told_apart, a.detectable, b.changes))
        });
        alone
    }
}

fn sentence(study: &Study, made: &[ChosenTest], effects: &[String]) -> String {
    let Some(last) = made.last() else {
        return "No feasible test shows any effect of the catalogue.".to_owned();
    };
    let tests: Vec<String> = made
        .iter()
        .map(|m| changes(&m.test, &study.operation))
        .collect();
    let hours = made.iter().map(|m| m.test.hours()).sum::<f64>();
    format!(
        "{} tests ({}; {} h on the rig) show {} of {} effects at their median strength and tell {} from every look-alike.",
        made.len(),
        tests.join(" | "),
        significant(hours, 3),
        last.detectable,
        effects.len(),
        last.told_apart
    ) + &without_the_last(made)
}

/// That the last tests bring no effect more, where that is so, with a space before it.
fn without_the_last(made: &[ChosenTest]) -> String {
    let (mut shown, mut brings) = (0, 0);
    for (n, test) in made.iter().enumerate() {
        if test.detectable > shown || !test.newly.is_empty() {
            brings = n + 1;
        }
        shown = shown.max(test.detectable);
    }
    match made.len() - brings {
        0 => String::new(),
        1 => " The last test brings no effect more: leave it out where hours count.".to_owned(),
        more => {
            format!(
                " The last {more} tests bring no effect more: leave them out where hours count."
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::candidate_tests::tests::plain;
    use super::*;

    #[test]
    fn tests_that_bring_nothing_are_called_so() {
        let test = |detectable: usize, newly: &[&str]| ChosenTest {
            test: shown(&plain()),
            detectable,
            told_apart: 0,
            newly: newly.iter().map(|name| (*name).to_owned()).collect(),
            adds: String::new(),
            why: String::new(),
        };
        let last = |made: &[ChosenTest]| without_the_last(made);
        let (first, none) = (test(5, &[]), test(5, &[]));
        assert_eq!(last(&[first.clone(), test(5, &["coating"])]), "");
        assert_eq!(last(&[first.clone(), test(6, &[])]), "");
        let one = last(&[first.clone(), test(6, &[]), test(6, &[])]);
        assert!(
            one.starts_with(" The last test brings no effect more"),
            "{one}"
        );
        let two = last(&[first, none.clone(), none]);
        assert!(two.starts_with(" The last 2 tests bring"), "{two}");
    }
}
