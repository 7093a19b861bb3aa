//! Whether measurements scatter as their stated σ say: more, much less, or elsewhere.
//!
//! ```text
//! d_i: second differences of measured minus model along a trace ([`second_differences`](super::second_differences))
//! σ/stated = √(median(d²/var d)/0.4549)
//! L = −N ln(mean |d|/√var d) − Σ ln √var d                                   ln likelihood of N differences as Laplace's law has it
//! ```
//! 0.4549 is the median of χ² with one degree of freedom. Evidence knows only the stated σ: if that
//! is too small by two, noise counts four times in χ², and something seems to be missing. If it is too small at some points and too
//! large at others, no factor mends that: then a σ of another shape, a constant and a share of each curve's largest depth, is
//! taken where the differences speak for it by L. Laplace's law, since outliers shall not decide; neighbouring differences share two points
//! of three, and the sizes of normal ones are correlated by 4/9, so that L/2 is what independent ones would have.

use super::common_scatter::{shared_of, without_shared};
use super::fourth_differences::{MEDIAN, standardised_squares};
use super::scatter_of_tests::unlike_test;
use super::second_differences::{Difference, differences};
use crate::learn::candidates::likelihood::Likelihood;
use crate::learn::fitting::fitted::Fit;
use crate::learn::noise::SigmaModel;
use crate::measure::neighbours::curves;
use crate::measure::{Dataset, Observation, Quantity};
use crate::numeric::median;
use crate::study::{Role, Study};

/// Differences needed for an estimate.
const LEAST: usize = 100;
/// Scatter over stated σ below which the stated σ stands: three standard errors of some hundred differences.
const TOLERATED: f64 = 1.2;
/// The same of traces with so few points each that what the model lacks may bend between three of them: by a relief of the tips on 15 points exact σ
/// seemed 1.5 times too small by second and 1.3 times by fourth differences.
const TOLERATED_OF_COARSE: f64 = 1.5;
const COARSE: usize = 20;
/// The same of so few that nearly each is a bend: on seven points of two relieved flanks exact σ seemed 1.8 times too small by the analytic model.
const TOLERATED_OF_VERY_COARSE: f64 = 2.5;
const VERY_COARSE: usize = 12;

/// Scatter over stated σ below which neighbours are too smooth to be independent, or σ is overstated.
const SMOOTH: f64 = 0.67;

/// Log likelihood of independent differences by which σ of another shape must be more likely than the stated: odds of 20,000 to 1.
const ANOTHER_SHAPE: f64 = 10.0;

/// Steps in which the floor's part of a middle curve's σ is tried.
const PARTS: u8 = 10;

/// The σ that the scatter along traces calls for: as stated, unless that is clearly too small or of the wrong shape. Where a new profile is counted
/// to scatter, of what is each profile's own. Estimated ones hold a part of the new profile's scatter too, each curve another, so that no factor takes it out.
pub(in crate::learn) fn sigma_model(likelihood: &Likelihood<'_>, model: &[f64]) -> SigmaModel {
    of_residual(&likelihood.observations(), &own_residual(likelihood, model))
}

/// Measured minus model, without what the scatter of a new profile makes of it where that is counted.
fn own_residual(likelihood: &Likelihood<'_>, model: &[f64]) -> Vec<f64> {
    let residual = likelihood.residual(model);
    match likelihood.noise.new_profile_um {
        um if um > 0.0 => without_shared(&likelihood.observations(), &residual, um),
        _ => residual,
    }
}

fn of_residual(rows: &[&Observation], residual: &[f64]) -> SigmaModel {
    let differences = differences(rows, residual);
    // points that were filtered, or made without noise, say nothing of σ
    let scatter = scale(&differences, &SigmaModel::AS_STATED.of(rows));
    let Some(scatter) = scatter.filter(|found| *found >= SMOOTH) else {
        return SigmaModel::AS_STATED;
    };
    another_shape(rows, &differences).unwrap_or(SigmaModel::Stated {
        factor: if scatter > TOLERATED { scatter } else { 1.0 },
    })
}

/// The same of what is to be said of measurements, where a misfit that bends between coarse points is no scatter. (A diagnosis takes its σ from what
/// is left by the base model as a whole: so large a one keeps coarse traces from deciding by what no candidate resolves.)
fn of_scatter_alone(rows: &[&Observation], residual: &[f64]) -> SigmaModel {
    match of_residual(rows, residual) {
        SigmaModel::Stated { factor } if factor > 1.0 => {
            let scatter = fourth(rows, residual).map_or(factor, |fourth| fourth.min(factor));
            let tolerated = match median_points(rows) {
                points if points < VERY_COARSE => TOLERATED_OF_VERY_COARSE,
                points if points < COARSE => TOLERATED_OF_COARSE,
                _ => TOLERATED,
            };
            SigmaModel::Stated {
                factor: if scatter > tolerated { scatter } else { 1.0 },
            }
        }
        other => other,
    }
}

/// Scatter over stated σ by fourth differences; None of too few.
fn fourth(rows: &[&Observation], residual: &[f64]) -> Option<f64> {
    let squares = standardised_squares(rows, residual, &SigmaModel::AS_STATED.of(rows));
    (squares.len() >= LEAST)
        .then(|| median(squares))?
        .map(|middle| (middle / MEDIAN).sqrt())
}

/// Points of a middle curve.
fn median_points(rows: &[&Observation]) -> usize {
    let mut points: Vec<usize> = curves(rows).iter().map(Vec::len).collect();
    points.sort_unstable();
    points.get(points.len() / 2).copied().unwrap_or(0)
}

/// How neighbouring points scatter about a fit where that is not as their stated σ say, in words.
pub fn stated_sigma(study: &Study, data: &Dataset, fit: &Fit) -> Option<String> {
    let rows: Vec<&Observation> = data.observations.iter().collect();
    let residual = (rows.iter().zip(&fit.rows)).map(|(o, row)| row.standardised * o.sigma);
    let residual: Vec<f64> = residual.collect();
    // rows that stand apart are told by themselves, and say nothing of the sigma of the others
    let apart = |row: usize| data.outliers.iter().any(|outlier| outlier.row == row);
    let fitted = |row: &usize| study.tests[rows[*row].test].role == Role::Fit && !apart(*row);
    let fitted: Vec<usize> = (0..rows.len()).filter(fitted).collect();
    let own: Vec<&Observation> = fitted.iter().map(|&row| rows[row]).collect();
    let of_own: Vec<f64> = fitted.iter().map(|&row| residual[row]).collect();
    // what checkpoints share is told by itself too
    let of_own = match shared_of(&own, &of_own) {
        Some(um) => without_shared(&own, &of_own, um),
        None => of_own,
    };
    if let Some(test) = unlike_test(study, &own, &of_own) {
        return Some(test);
    }
    let scatter = scale(&differences(&own, &of_own), &SigmaModel::AS_STATED.of(&own));
    match scatter.filter(|found| *found < SMOOTH) {
        Some(smooth) => Some(smooth_in_words(smooth)),
        None => scatter_in_words(of_scatter_alone(&own, &of_own)),
    }
}

/// A scatter far below the stated σ in words.
pub(in crate::learn) fn smooth_in_words(scatter: f64) -> String {
    format!(
        "neighbouring points of a trace scatter only {scatter:.2} times their stated sigma: if sigma is overstated weak effects stay hidden (leave the \
         column sigma empty, and it is estimated); if the traces were filtered their points are not independent and every probability is too bold"
    )
}

/// The same of the σ that the scatter calls for.
pub(in crate::learn) fn scatter_in_words(sigma: SigmaModel) -> Option<String> {
    let depths = |found: String| {
        format!(
            "the stated sigma of the depths does not fit how neighbouring points scatter, which is by {found}: leave the column sigma empty, and it \
             is estimated for every command (sharp bends that the model does not have, where load steps from pair to pair, look like scatter; if that is \
             what they are, the stated sigma is right)"
        )
    };
    match sigma {
        SigmaModel::Stated { factor: 1.0 } => None,
        SigmaModel::Stated { factor } => Some(format!(
            "neighbouring points of a trace scatter {factor:.1} times as much as their stated sigma"
        )),
        SigmaModel::OfCurve { floor, share } => {
            let of_largest = format!("{:.1} % of the largest depth of their curve", 100.0 * share);
            Some(depths(match (floor, share) {
                (0.0, _) => of_largest,
                (_, 0.0) => format!("{floor:.3} µm at all depths"),
                _ => format!("{floor:.3} µm plus {of_largest}"),
            }))
        }
    }
}

/// What is said of a diagnosis that goes by the scatter in place of the σ of the rows, which are stated or `estimated`; None where it does not.
pub(in crate::learn) fn replaced(likelihood: &Likelihood<'_>) -> Option<String> {
    let estimated = likelihood.measured.data.estimates_sigmas();
    let points = median_points(&likelihood.observations());
    replaced_in_words(likelihood.noise.sigma, estimated, points)
}

/// The same with `points` along a middle curve.
fn replaced_in_words(sigma: SigmaModel, estimated: bool, points: usize) -> Option<String> {
    scatter_in_words(sigma).map(|words| {
        if let (SigmaModel::Stated { factor }, false, true) = (sigma, estimated, points < COARSE) {
            return format!(
                "of the {points} points along a trace a misfit that bends between them looks like scatter: sigma was taken {factor:.1} times as large as stated here, so that \
                 neither decides; χ² is still in stated sigmas"
            );
        }
        if estimated {
            "sigma, estimated curve by curve, was replaced by what all curves together show; χ² is still in the estimated sigmas".to_owned()
        } else {
            format!("{words}. It was taken so here; χ² is still in stated sigmas")
        }
    })
}

/// Scatter over stated σ where that is far too little for independent points.
pub(in crate::learn) fn too_smooth(likelihood: &Likelihood<'_>, model: &[f64]) -> Option<f64> {
    scatter(likelihood, model).filter(|found| *found < SMOOTH)
}

/// Scatter along traces over stated σ; None if there is too little to tell.
pub(in crate::learn) fn scatter(likelihood: &Likelihood<'_>, model: &[f64]) -> Option<f64> {
    let (rows, residual) = (likelihood.observations(), own_residual(likelihood, model));
    let stated = SigmaModel::AS_STATED.of(&rows);
    scale(&differences(&rows, &residual), &stated)
}

/// Scatter over these σ; None of too few differences.
fn scale(differences: &[Difference], sigma: &[f64]) -> Option<f64> {
    if differences.len() < LEAST {
        return None;
    }
    let square = |d: &Difference| (d.value / d.sigma(sigma)).powi(2);
    let middle = median(differences.iter().map(square).collect())?;
    Some((middle / MEDIAN).sqrt())
}

/// L of independent differences, for σ known up to a factor.
fn log_likelihood(differences: &[Difference], sigma: &[f64]) -> f64 {
    let count = differences.len() as f64;
    let (mut mean, mut logs) = (0.0, 0.0);
    for d in differences {
        let own = d.sigma(sigma);
        mean += d.value.abs() / (own * count);
        logs += own.ln();
    }
    0.5 * (-count * mean.ln() - logs)
}

/// A σ of depths of which the shape is far likelier than that of the stated.
fn another_shape(rows: &[&Observation], all: &[Difference]) -> Option<SigmaModel> {
    let depths: Vec<Difference> = (all.iter())
        .filter(|d| rows[d.rows[0]].quantity == Quantity::WearDepth)
        .copied()
        .collect();
    let stated = log_likelihood(&depths, &SigmaModel::AS_STATED.of(rows));
    let mut largest: Vec<f64> = (curves(rows).iter())
        .filter(|curve| rows[curve[0]].quantity == Quantity::WearDepth)
        .map(|curve| {
            curve
                .iter()
                .map(|&i| rows[i].value.abs())
                .fold(0.0, f64::max)
        })
        .collect();
    largest.sort_by(f64::total_cmp);
    let middle = *largest.get(largest.len() / 2)?;
    let of = |part: u8| {
        let part = f64::from(part) / f64::from(PARTS);
        let model = |scale: f64| SigmaModel::OfCurve {
            floor: scale * part * middle,
            share: scale * (1.0 - part),
        };
        let unit = model(1.0).of(rows);
        Some((
            log_likelihood(&depths, &unit),
            model(scale(&depths, &unit)?),
        ))
    };
    let found = (0..=PARTS).filter_map(of);
    let (likelihood, best) = found.max_by(|a, b| a.0.total_cmp(&b.0))?;
    (likelihood - stated > ANOTHER_SHAPE).then_some(best)
}

#[cfg(test)]
mod tests {
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::{Rng, SeedableRng};

    use super::*;
    use crate::measure::Subject;

    #[test]
    fn sigmas_that_nobody_stated_are_not_called_stated() {
        let sigma = SigmaModel::OfCurve {
            floor: 0.045,
            share: 0.021,
        };
        let stated = replaced_in_words(sigma, false, 50).unwrap();
        assert!(
            stated.contains("stated sigma") && stated.contains("0.045 µm plus 2.1 %"),
            "{stated}"
        );
        let estimated = replaced_in_words(sigma, true, 50).unwrap();
        assert!(!estimated.contains("leave the column"), "{estimated}");
        assert!(replaced_in_words(SigmaModel::AS_STATED, true, 50).is_none());
        // with few points it may be the misfit
        let coarse = replaced_in_words(SigmaModel::Stated { factor: 1.5 }, false, 7).unwrap();
        assert!(coarse.contains("taken 1.5 times as large"), "{coarse}");
    }

    /// Traces of 50 points, unevenly spaced, trace by trace twice as deep, with a smooth misfit of 30 sigmas of 0.1 and normal noise: of each
    /// row as `noise` has it of the trace's largest depth and its own, stated as `stated` has it.
    fn traces(
        count: i32,
        noise: &dyn Fn(f64, f64) -> f64,
        stated: &dyn Fn(f64, f64) -> f64,
    ) -> (Vec<Observation>, Vec<f64>) {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let mut uniform = || 1.0 - (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        let mut normal = || (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        let (mut rows, mut residual) = (Vec::new(), Vec::new());
        for trace in 0..count {
            let largest = 2f64.powi(trace);
            for i in 0..50 {
                let s = (f64::from(i) + 0.3 * f64::from(i % 2)) / 50.0;
                let value = largest * (1.0 - 0.9 * s);
                residual.push(3.0 * (4.0 * s).sin() + noise(largest, value) * normal());
                rows.push(Observation {
                    test: 0,
                    member: Subject::Pinion,
                    cycles: f64::from(trace),
                    quantity: Quantity::WearDepth,
                    position: Some(s),
                    value,
                    sigma: stated(largest, value),
                    trace: None,
                    line: 0,
                    face: None,
                    tooth: None,
                });
            }
        }
        (rows, residual)
    }

    fn found(of: &(Vec<Observation>, Vec<f64>)) -> (Option<f64>, Option<SigmaModel>) {
        let rows: Vec<&Observation> = of.0.iter().collect();
        let differences = differences(&rows, &of.1);
        let stated = SigmaModel::AS_STATED.of(&rows);
        let shape = another_shape(&rows, &differences);
        (scale(&differences, &stated), shape)
    }

    #[test]
    fn noise_counts_and_a_smooth_misfit_does_not() {
        // 384 differences: a standard error of some 5 %
        for level in [0.3, 1.0, 2.0] {
            let (scatter, shape) = found(&traces(8, &|_, _| 0.1 * level, &|_, _| 0.1));
            let scatter = scatter.unwrap();
            assert!((scatter / level - 1.0).abs() < 0.15, "{scatter} of {level}");
            assert_eq!(shape, None);
        }
    }

    #[test]
    fn few_points_say_nothing() {
        let few = traces(2, &|_, _| 0.3, &|_, _| 0.1);
        assert_eq!(found(&few), (None, None));
    }

    /// A σ of the right shape stands whatever its level is, and one of the wrong shape is found out: level and own depth for the largest.
    #[test]
    fn a_sigma_of_the_wrong_shape_is_found_out() {
        let of_largest = |largest: f64, _: f64| 0.03 * largest;
        let of_own = |_: f64, value: f64| 0.1f64.hypot(0.03 * value);
        let same = |_: f64, _: f64| 0.2;
        let right: [&dyn Fn(f64, f64) -> f64; 3] = [&of_largest, &of_own, &same];
        for noise in right {
            let half = |largest: f64, value: f64| 0.5 * noise(largest, value);
            assert_eq!(found(&traces(8, noise, &half)).1, None);
        }
        // smoother than any noise of the stated size: filtered, and no ground to take σ for smaller
        let (rows, residual) = traces(8, &|largest, _| 0.003 * largest, &of_own);
        let rows: Vec<&Observation> = rows.iter().collect();
        assert_eq!(of_residual(&rows, &residual), SigmaModel::AS_STATED);
        let shape = found(&traces(8, &of_largest, &of_own)).1;
        let Some(SigmaModel::OfCurve { floor, share }) = shape else {
            panic!("{shape:?}");
        };
        // the middle of the largest depths is 16
        let middle = floor / 16.0 + share;
        assert!(
            (middle / 0.03 - 1.0).abs() < 0.15 && share > 0.8 * middle,
            "{shape:?}"
        );
        let shape = found(&traces(8, &same, &of_largest)).1;
        let Some(SigmaModel::OfCurve { floor, share }) = shape else {
            panic!("{shape:?}");
        };
        let middle = floor + 16.0 * share;
        assert!(
            (middle / 0.2 - 1.0).abs() < 0.15 && floor > 0.8 * middle,
            "{shape:?}"
        );
    }

    /// A tooth relief of 15 points a trace bends between three of them; of 50 points it does not.
    #[test]
    fn a_misfit_that_bends_between_coarse_points_is_no_scatter() {
        let of = |points: usize, noise: f64| {
            let (mut rows, residual) = traces(20, &|_, _| noise, &|_, _| 0.1);
            let (mut kept, mut own) = (Vec::new(), Vec::new());
            for (i, row) in rows.drain(..).enumerate() {
                if i % 50 % (50 / points) == 0 {
                    let s = row.position.unwrap();
                    own.push(residual[i] + 2.0 * (s - 0.5).max(0.0).powi(2) * 4.0);
                    kept.push(row);
                }
            }
            let rows: Vec<&Observation> = kept.iter().collect();
            of_scatter_alone(&rows, &own)
        };
        assert_eq!(of(10, 0.1), SigmaModel::AS_STATED);
        // half too small looks like bends there, and not on more points
        assert_eq!(of(10, 0.15), SigmaModel::AS_STATED);
        assert!(matches!(of(25, 0.15), SigmaModel::Stated { factor } if factor > 1.2));
        // σ that are too small by three are found among few points too
        assert!(matches!(of(10, 0.3), SigmaModel::Stated { factor } if factor > 2.0));
    }
}
