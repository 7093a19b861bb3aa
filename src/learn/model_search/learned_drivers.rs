//! What nothing of the catalogue explains, as a law of one driver: every driver a candidate, the one with the greatest evidence the answer.
//!
//! Each is first fitted with one size and length of its process, the best few with all; by the analytic model, which tells drivers apart at
//! a hundredth of the price of finite elements. Those few, and the law of what the discrepancy from the deciding model follows, are then fitted by
//! that model: what a law promises must not be what mends the analytic model's own error, which may also hide the law that is asked for.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::context::Context;
use super::law_fits::{chi2, mean_square, screening_noise, without};
use super::plain_laws::{PlainLaw, plain_law};
use crate::effects::Hook;
use crate::learn::candidates::fitted_candidate::FittedCandidate;
use crate::learn::discrepancy::dependence::Driver;
use crate::learn::fitting::fitted::Fit;
use crate::learn::fitting::measured::Measured;
use crate::learn::learned::law::{LearnedFit, WantedLaw, deviations};
use crate::learn::learned::shapes::Shape;
use crate::learn::prediction::bench::Bench;
use crate::learn::prediction::fidelity::Fidelity;
use crate::study::Role;

/// Laws that are looked at. Pressure and what follows from it stand behind what measurements tell directly.
const DRIVERS: &[&str] = &[
    "cycles",
    "cycles:pinion",
    "cycles:gear",
    "s",
    "radius:pinion",
    "radius:gear",
    "depth",
    "slid_distance",
    "p",
    "v_slide",
    "film_ratio",
    "flash_temperature",
    "torque",
    "speed",
    "bulk_temperature",
];
/// Those of them that are places on the flank.
pub(in crate::learn) const PLACES: &[&str] = &["s", "radius:pinion", "radius:gear"];
/// Those of them that are times.
pub(in crate::learn) const TIMES: &[&str] = &["cycles", "cycles:pinion", "cycles:gear"];
/// How many of them are fitted with every size and length.
const CLOSELY: usize = 3;
/// The same of places or times alone.
const OF_ONE_KIND_CLOSELY: usize = 2;
/// Share of the discrepancy from which the law of what it follows is fitted by the deciding model, however the analytic one ranks it.
const FOLLOWED: f64 = 0.5;
/// Gain of ln evidence below which no law is told of: the prior odds against one of so many drivers, and a thousand beside.
const LEAST_GAIN: f64 = 10.0;

/// χ² per point from which a test is left with more than noise, and the factor by which it has risen then for a law to have made it worse.
const NOT_NOISE: f64 = 1.5;
const RISEN: f64 = 1.25;

/// A law learned from the measurements.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LearnedAnswer {
    /// `learned:cycles`, `learned:radius:pinion`: what `add` takes.
    pub name: String,
    /// `wear_factor`: values are natural logarithms of a factor on k.
    pub acts: String,
    /// The variable that it follows.
    pub driver: String,
    /// Its unit.
    pub unit: String,
    /// `both`, `pinion` or `gear`.
    pub member: String,
    /// Log evidence over the same model without it.
    pub evidence_gain: f64,
    /// Values of the driver.
    pub knots: Vec<f64>,
    /// Values of the law there.
    pub values: Vec<f64>,
    /// One standard deviation of each.
    pub sigma: Vec<f64>,
    /// Prior standard deviation of the values.
    pub size: f64,
    /// Over which distance of the driver they change.
    pub length: f64,
    /// χ² per point of the fit tests without the law and with it.
    pub fit_chi2_per_point: [f64; 2],
    /// Of the held-out tests; None where none is held out.
    pub holdout_chi2_per_point: Option<[f64; 2]>,
    /// By which model.
    pub decided_by: Fidelity,
    /// Whether its fit converged: if not, the values are those at which it stopped.
    #[serde(default = "yes")]
    pub converged: bool,
    /// The plain formula that comes nearest to it, fitted in its place by the same model; None where none of its shapes does.
    #[serde(default)]
    pub plain: Option<PlainLaw>,
    /// Fit tests that it leaves worse than they were, each with χ² per point without the law and with it: what acts there differs from test to test.
    #[serde(default)]
    pub worse_tests: Vec<(String, [f64; 2])>,
    /// The other drivers: those that the same model looked at, then those that only the analytic one did; the best of each first.
    pub others: Vec<OtherDriver>,
}

/// A driver that was looked at beside.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct OtherDriver {
    /// As [`LearnedAnswer::name`].
    pub name: String,
    /// Log evidence over the same model without it.
    pub evidence_gain: f64,
    /// By which model.
    #[serde(default = "analytic")]
    pub decided_by: Fidelity,
}

/// For documents written before the deciding model fitted laws.
fn analytic() -> Fidelity {
    Fidelity::Screening
}

/// For documents written before it was stated.
fn yes() -> bool {
    true
}

/// The laws that one model fitted, the greatest evidence first; those fitted closely before those that had a glance.
struct FittedLaws {
    without: Fit,
    laws: Vec<(WantedLaw, LearnedFit)>,
    by: Fidelity,
}

impl FittedLaws {
    fn new(without: Fit, mut laws: Vec<(WantedLaw, LearnedFit)>, by: Fidelity) -> Self {
        laws.sort_by(|a, b| b.1.log_evidence.total_cmp(&a.1.log_evidence));
        Self { without, laws, by }
    }

    /// The first law's curve as the plain formula of the shapes that are meant.
    fn plain(
        &self,
        bench: &Bench<'_>,
        context: &Context<'_>,
        known: &FittedCandidate,
        is_meant: impl Fn(Shape) -> bool,
    ) -> Option<PlainLaw> {
        let (_, best) = self.laws.first()?;
        plain_law(bench, context, known, (&self.without, best), is_meant)
    }

    fn gain(&self, law: &LearnedFit) -> f64 {
        law.log_evidence - self.without.log_evidence
    }

    /// All laws but the first `skipped` as what was looked at beside.
    fn others(&self, skipped: usize) -> impl Iterator<Item = OtherDriver> {
        self.laws
            .iter()
            .skip(skipped)
            .map(|(law, fit)| OtherDriver {
                name: law.name(),
                evidence_gain: self.gain(fit),
                decided_by: self.by,
            })
    }
}

/// The law beside what is `known` that the measurements ask for most, `follows` being what their discrepancy follows first; None where none is worth
/// its freedom.
pub(in crate::learn) fn learned_driver(
    context: &Context<'_>,
    known: &FittedCandidate,
    follows: Option<&Driver>,
) -> Option<LearnedAnswer> {
    let mut screened = screened(context, known, DRIVERS, CLOSELY)?;
    // a study whose own model is the analytic one is decided by it
    if context.fidelity == Fidelity::Screening {
        let mut own = answer(context, &screened, screened.others(1).collect())?;
        own.plain = screened.plain(context.middle, context, known, |_| true);
        return Some(own);
    }
    let closely = brought_forward(&mut screened.laws, |(law, _)| {
        follows.is_some_and(|driver| is_of(law.driver.name, driver))
    });
    let decided = decided(context.exact, context, known, &screened, closely)?;
    let others = decided.others(1).chain(screened.others(closely)).collect();
    let mut own = answer(context, &decided, others)?;
    own.plain = decided.plain(context.exact, context, known, |_| true);
    Some(own)
}

/// Whether a law's variable is what a discrepancy mostly follows.
fn is_of(variable: &str, driver: &Driver) -> bool {
    let is_place =
        driver.name == "position" && PLACES.iter().any(|place| place.starts_with(variable));
    driver.variance_share >= FOLLOWED && (is_place || driver.name == variable)
}

/// How many laws are fitted closely: if none of the first few `is_meant`, the first that is comes right behind them.
fn brought_forward<T>(laws: &mut [T], is_meant: impl Fn(&T) -> bool) -> usize {
    match laws.iter().position(is_meant) {
        Some(at) if at >= CLOSELY => {
            laws[CLOSELY..=at].rotate_right(1);
            CLOSELY + 1
        }
        _ => CLOSELY,
    }
}

/// Whether what is `fitted` gains as much over what is `known` as a law must to be told of.
pub(in crate::learn) fn is_ahead_of(fitted: &FittedCandidate, known: &FittedCandidate) -> bool {
    fitted.log_evidence - known.log_evidence >= LEAST_GAIN
}

/// The law of one of these `drivers` beside what is `known` that has the greatest evidence, and its gain over the same without it, as a curve or as a plain
/// formula that no effect of the catalogue has; None where it is not worth its freedom.
pub(in crate::learn) fn best_of(
    context: &Context<'_>,
    known: &FittedCandidate,
    drivers: &[&str],
) -> Option<(String, f64)> {
    best_of_worth(context, known, drivers, f64::NEG_INFINITY)
}

/// The same, None also where no law gains at `least` so much by the analytic model: finite elements are then not asked.
pub(in crate::learn) fn best_of_worth(
    context: &Context<'_>,
    known: &FittedCandidate,
    drivers: &[&str],
    least: f64,
) -> Option<(String, f64)> {
    best_with_evidence(context, known, drivers, least).map(|(name, gain, _)| (name, gain))
}

/// The same law by its ln evidence over a `rival` that has other effects, both fitted by the same means: what a candidate's own evidence excuses of an effect's
/// form, no law is excused.
pub(in crate::learn) fn best_over(
    context: &Context<'_>,
    known: &FittedCandidate,
    drivers: &[&str],
    (rival, least): (&FittedCandidate, f64),
) -> Option<(String, f64)> {
    let (name, gain, without_law) = best_with_evidence(context, known, drivers, least)?;
    let own = context.fidelity == Fidelity::Screening;
    let bench = if own { context.middle } else { context.exact };
    let rival = without(context, rival, bench, context.likelihood.noise)?;
    Some((name, without_law + gain - rival.log_evidence))
}

/// The law's name, its gain over the same without it, and ln evidence of that.
fn best_with_evidence(
    context: &Context<'_>,
    known: &FittedCandidate,
    drivers: &[&str],
    least: f64,
) -> Option<(String, f64, f64)> {
    let screened = screened(context, known, drivers, OF_ONE_KIND_CLOSELY)?;
    let (_, first) = screened.laws.first()?;
    if screened.gain(first) < least {
        return None;
    }
    let own = context.fidelity == Fidelity::Screening;
    let ranked = if own {
        screened
    } else {
        decided(
            context.exact,
            context,
            known,
            &screened,
            OF_ONE_KIND_CLOSELY,
        )?
    };
    let answer = answer(context, &ranked, Vec::new())?;
    let bench = if own { context.middle } else { context.exact };
    let plain = ranked.plain(bench, context, known, Shape::is_of_no_effect);
    let plain = plain.filter(|plain| plain.converged);
    let gain = plain.map_or(answer.evidence_gain, |plain| {
        plain.evidence_gain.max(answer.evidence_gain)
    });
    Some((answer.name, gain, ranked.without.log_evidence))
}

/// Of the best law of the place and the best of the time by the analytic model the one that has the greater evidence beside what is `known` by coarse
/// finite elements, as a curve or as a plain formula that no effect of the catalogue has: its name, that evidence, and its gain over the same without it.
pub(in crate::learn) fn place_or_time(
    context: &Context<'_>,
    known: &FittedCandidate,
) -> Option<(String, f64, f64)> {
    let of_kind = |drivers: &&[&str]| {
        let screened = screened(context, known, drivers, 1)?;
        let ranked = decided(context.middle, context, known, &screened, 1)?;
        let (law, best) = ranked.laws.first()?;
        let (name, gain) = (law.name(), ranked.gain(best));
        let form = ranked.plain(context.middle, context, known, Shape::is_of_no_effect);
        let form = form.filter(|form| form.converged && form.evidence_gain > gain);
        let (name, gain) = form.map_or((name.clone(), gain), |form| {
            (format!("{name} as {}", form.form), form.evidence_gain)
        });
        Some((name, ranked.without.log_evidence + gain, gain))
    };
    let best = [PLACES, TIMES].par_iter().filter_map(of_kind);
    best.max_by(|a, b| a.1.total_cmp(&b.1))
}

/// Each of these drivers by the analytic model, the best few with every size and length of the process.
fn screened(
    context: &Context<'_>,
    known: &FittedCandidate,
    drivers: &[&str],
    closely: usize,
) -> Option<FittedLaws> {
    let likelihood = &context.likelihood;
    let (measured, version) = (likelihood.measured, &known.candidate.version);
    let own = context.fidelity == Fidelity::Screening;
    let bench = if own { context.middle } else { context.hertz };
    let noise = screening_noise(context);
    let without = without(context, known, bench, noise)?;
    let study = measured.study();
    let wanted: Vec<WantedLaw> = (drivers.iter())
        .filter_map(|name| WantedLaw::of_name(&format!("learned:{name}"), Hook::WearFactor).ok())
        .filter(|law| law.driver.needs.iter().all(|key| study.states(key)))
        .filter(|law| !version.effects.has(&law.name()))
        .collect();
    let look = |law: &WantedLaw| {
        let found = measured.glance(bench, version, &without, law, noise).ok()?;
        Some((*law, found))
    };
    let glances = wanted.par_iter().filter_map(look).collect();
    let mut laws = FittedLaws::new(without.clone(), glances, Fidelity::Screening).laws;
    let count = laws.len().min(closely);
    let close = |(law, glance): &(WantedLaw, LearnedFit)| {
        let learned = measured.learn(bench, version, &without, law, noise, &|_| {});
        (*law, learned.unwrap_or_else(|_| glance.clone()))
    };
    let closer = laws[..count].par_iter().map(close).collect();
    let closer = FittedLaws::new(without, closer, Fidelity::Screening);
    // behind these stay those that had a glance only: theirs is the evidence at one size and length, not the mean over all
    laws.splice(..count, closer.laws);
    Some(FittedLaws { laws, ..closer })
}

/// The best few by a finer model; None where none of them can be fitted by it.
fn decided(
    bench: &Bench<'_>,
    context: &Context<'_>,
    known: &FittedCandidate,
    screened: &FittedLaws,
    closely: usize,
) -> Option<FittedLaws> {
    let noise = context.likelihood.noise;
    let (measured, version) = (context.likelihood.measured, &known.candidate.version);
    let without = without(context, known, bench, noise)?;
    let again = |(law, found): &(WantedLaw, LearnedFit)| {
        let found = measured.relearn(bench, version, &without, found, noise);
        Some((*law, found.ok()?))
    };
    let best = screened.laws.par_iter().take(closely);
    let laws = best.filter_map(again).collect();
    Some(FittedLaws::new(without, laws, Fidelity::Full))
}

/// The best law, if it is worth its freedom.
fn answer(
    context: &Context<'_>,
    ranked: &FittedLaws,
    others: Vec<OtherDriver>,
) -> Option<LearnedAnswer> {
    let (law, best) = ranked.laws.first()?;
    let measured = context.likelihood.measured;
    let both = |role| {
        Some([
            chi2(measured, &ranked.without, role)?,
            chi2(measured, &best.fit, role)?,
        ])
    };
    let fitted = both(Role::Fit)?;
    if !is_worth(ranked.gain(best), fitted) {
        return None;
    }
    Some(LearnedAnswer {
        name: law.name(),
        acts: law.hook.name().to_owned(),
        driver: law.driver.name.to_owned(),
        unit: law.driver.unit.to_owned(),
        member: law
            .member
            .map_or("both", crate::gear::Member::name)
            .to_owned(),
        evidence_gain: ranked.gain(best),
        knots: best.law.law.knots().to_vec(),
        values: best.law.values.clone(),
        sigma: deviations(&best.law, &best.fit),
        size: best.law.size,
        length: best.law.length,
        fit_chi2_per_point: fitted,
        holdout_chi2_per_point: both(Role::Holdout),
        decided_by: ranked.by,
        converged: best.fit.converged,
        plain: None,
        worse_tests: worse_tests(measured, &ranked.without, &best.fit),
        others,
    })
}

/// The fit tests that a law leaves worse than they were, by more than the noise of their points and of what is left at all.
fn worse_tests(measured: &Measured<'_>, without: &Fit, with: &Fit) -> Vec<(String, [f64; 2])> {
    let tests = measured.study().tests.iter().enumerate();
    let fitted = tests.filter(|(n, _)| measured.roles[*n] == Role::Fit);
    let both = fitted.filter_map(|(n, test)| {
        let of = |fit| mean_square(measured, fit, |of| of == n);
        Some((test.id.clone(), [of(without)?, of(with)?]))
    });
    both.filter(|(_, change)| is_worse(*change)).collect()
}

/// Whether χ² per point rises by so much, and is then more than noise.
fn is_worse([before, after]: [f64; 2]) -> bool {
    after > NOT_NOISE && after > RISEN * before
}

/// Whether a law is worth its freedom: by its gain of ln evidence, and since it lowers χ² per point of the fit tests. Evidence alone may rise while the
/// residuals grow, where their correlated model error takes up what the law leaves.
fn is_worth(gain: f64, [before, after]: [f64; 2]) -> bool {
    gain >= LEAST_GAIN && after < before
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What acts in one test alone, as a law of all tests, is taken from the others.
    #[test]
    fn a_test_that_a_law_leaves_worse_is_told() {
        assert!(is_worse([0.93, 2.44]));
        assert!(!is_worse([0.93, 1.2]) && !is_worse([5.0, 5.5]) && !is_worse([5.0, 1.0]));
    }

    /// A step of k after some cycles: by the analytic model three other drivers came before cycles, which held 88 % of the discrepancy from finite
    /// elements.
    #[test]
    fn what_the_discrepancy_follows_is_fitted_closely() {
        let driver = |name: &str, variance_share: f64| Driver {
            name: name.to_owned(),
            variance_share,
        };
        let cycles = driver("cycles", 0.88);
        let mut laws = ["p", "s", "radius", "film_ratio", "depth", "cycles"];
        let closely = brought_forward(&mut laws, |law| is_of(law, &cycles));
        assert_eq!(laws, ["p", "s", "radius", "cycles", "film_ratio", "depth"]);
        assert_eq!(closely, CLOSELY + 1);
        // there already, not the most of it, no law of it
        for other in [
            driver("position", 0.9),
            driver("depth", 0.3),
            driver("member", 0.9),
        ] {
            let before = laws;
            assert_eq!(
                brought_forward(&mut laws, |law| is_of(law, &other)),
                CLOSELY
            );
            assert_eq!(laws, before);
        }
    }

    /// A law that raises χ² is never offered, whatever its evidence; nor one that gains little.
    #[test]
    fn laws_that_leave_more_are_not_offered() {
        assert!(is_worth(111.0, [6.91, 3.0]));
        assert!(!is_worth(111.0, [6.91, 7.55]));
        assert!(!is_worth(0.5 * LEAST_GAIN, [6.91, 3.0]));
    }
}
