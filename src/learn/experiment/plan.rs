//! What to measure next: the whole table of feasible tests once there are measurements, a first campaign before.

use serde::{Deserialize, Serialize};

use super::candidate_tests::{NextTest, with_hours};
use crate::learn::hypothesis::candidate::NotJudged;

/// Log posterior behind the first from which a candidate leads no longer.
pub(super) const LEADING: f64 = 8.0;
/// Least and most leading candidates.
pub(super) const LEADERS: [usize; 2] = [2, 4];
/// Least weight of a rival: a diagnosis is a model too.
const LEAST_WEIGHT: f64 = 0.01;

/// A plan.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Plan {
    /// After measurements.
    NextTests(NextTests),
    /// Before any.
    Campaign(Campaign),
}

/// Feasible tests by how well they separate what the measurements leave.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct NextTests {
    /// The first line of the table in words.
    pub sentence: String,
    /// Where the leaders come from, in words.
    pub basis: String,
    /// Whether a finished diagnosis of the same inputs named them, not the analytic model.
    pub diagnosed: bool,
    /// The leading candidates, by falling probability.
    pub leaders: Vec<Leader>,
    /// Relative noise assumed of quantities that were not measured yet.
    pub noise: f64,
    /// Mean expected χ² of a repetition of the most telling test that is there already, all its measurements together.
    pub repetition_chi2: f64,
    /// The table, best first.
    pub tests: Vec<RankedTest>,
}

/// One leading candidate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Leader {
    /// Effect, or `nothing_missing`.
    pub effect: String,
    /// Its accepted form; empty for the card's own.
    pub form: String,
    /// Log posterior (up to a constant) behind the first one.
    pub behind: f64,
    /// Probability by the diagnosis; None by the analytic model.
    pub probability: Option<f64>,
}

impl Leader {
    /// What telling the first leader from it counts.
    pub(super) fn weight(&self) -> f64 {
        self.probability.map_or(1.0, |p| p.max(LEAST_WEIGHT))
    }
}

/// One feasible test with one quantity measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RankedTest {
    /// Conditions.
    #[serde(serialize_with = "with_hours")]
    pub test: NextTest,
    /// What is measured: `wear_depth`, `transmission_error` or `mass_loss`.
    pub quantity: String,
    /// Number of changes against the study's operation.
    pub changes: usize,
    /// Mean over the pairs of expected χ² after refitting, each counted up to 60, and by the probability of the leader's rival where a diagnosis
    /// gives it.
    pub expected_chi2: f64,
    /// The leader against each other candidate.
    pub separates: Vec<Separated>,
    /// Why.
    pub why: String,
}

/// Two candidates and how far a test separates them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Separated {
    /// The two.
    pub pair: [String; 2],
    /// Expected difference in χ² after refitting.
    pub chi2: f64,
}

/// The tests that show and tell apart most effects of the catalogue.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Campaign {
    /// The outcome in words.
    pub sentence: String,
    /// Relative noise assumed.
    pub noise: f64,
    /// The chosen tests in the order of their choice.
    pub tests: Vec<ChosenTest>,
    /// Every effect with all chosen tests.
    pub effects: Vec<EffectVisibility>,
    /// Effects told apart by the same tests with wear depths and mass losses, and with a transmission error too.
    pub told_apart_with: [(String, usize); 2],
    /// All feasible tests, each alone, by what it shows.
    pub alone: Vec<AloneTest>,
    /// Effects that need what the study does not state.
    pub not_judged: Vec<NotJudged>,
    /// Effects whose history failed at their median strength.
    pub failed: Vec<String>,
}

/// A chosen test.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ChosenTest {
    /// Conditions.
    #[serde(serialize_with = "with_hours")]
    pub test: NextTest,
    /// Effects that show with this and the tests before.
    pub detectable: usize,
    /// Effects that are told from their nearest look-alike with this and the tests before.
    pub told_apart: usize,
    /// Those that were not told apart before.
    pub newly: Vec<String>,
    /// What it adds to the tests before, in words.
    #[serde(default)]
    pub adds: String,
    /// Why.
    pub why: String,
}

/// How well an effect at its median strength shows.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct EffectVisibility {
    /// Its name.
    pub effect: String,
    /// Expected χ² against nothing missing, k refitted.
    pub detection_chi2: f64,
    /// The effect most like it.
    pub nearest: String,
    /// Expected χ² against that one, its parameters refitted.
    pub nearest_chi2: f64,
    /// Whether it shows (χ² of 6).
    pub detectable: bool,
    /// Whether it shows and is told from all others.
    pub told_apart: bool,
}

/// A feasible test by itself.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AloneTest {
    /// Conditions.
    #[serde(serialize_with = "with_hours")]
    pub test: NextTest,
    /// Number of changes against the study's operation.
    pub changes: usize,
    /// Effects that show.
    pub detectable: usize,
    /// Effects told from all others.
    pub told_apart: usize,
    /// Place among the chosen ones, from 1; None if it was not chosen.
    pub chosen: Option<usize>,
}
