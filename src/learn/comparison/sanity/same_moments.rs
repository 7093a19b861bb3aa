//! Masses and depths of a member at the same moments of a test.
//!
//! ```text
//! r_i = ln (m_i/f_i) − ln s_i      of each weighing; f: the model's mass, s: measured over model of the traces taken at those cycles
//! R_i: the same with m_1 + … + m_i, or with Σ s_j l_j/l_i for s_i, l: the model's largest depth
//! range of r beyond ln 2 and of R below a third of it, median of R near 0, and somewhere no growth: what was lost since the measurement before
//! ```
//! Wear that speeds up or slows down against the model's cancels in r, whatever weight each quantity's sigmas give to early and late measurements.

use std::collections::BTreeSet;

use super::super::residual_statistics::FittedRow;
use super::{EXPLAINS, SAME_CYCLES, scale};
use crate::measure::{Observation, Quantity, Subject};
use crate::numeric::median;
use crate::study::Study;

/// Standard deviations from which a mass, and the scale of a trace, are no noise.
const MASS: f64 = 2.0;
const TRACE: f64 = 10.0;
/// Fewest moments that tell increments, and the part of the range of r that sums may leave.
const SEVERAL: usize = 3;
const LEFT: f64 = 1.0 / 3.0;
/// Factor by which what counts from the start grows from one measurement to the next, where it wears at all; or such a power of what it grows by the model.
const GROWS: f64 = 1.1;
const OF_MODEL: f64 = 0.25;
/// How far from the other quantity the sums may be, in ln.
const NEAR: f64 = 0.4;

/// A weighing and the traces taken at those cycles.
struct Moment {
    mass: f64,
    model_mass: f64,
    /// Measured over model of the traces, and the model's largest depth.
    scale: f64,
    largest: f64,
}

impl Moment {
    fn ratio(&self) -> f64 {
        (self.mass / self.model_mass).ln() - self.scale.ln()
    }
}

/// The middle one of a member's ln ratios of mass over depth; None where no mass was weighed when a trace was taken.
pub(super) fn ratio_at_same_moments(rows: &[FittedRow<'_>], member: Subject) -> Option<f64> {
    median(moments(rows, member).iter().map(Moment::ratio).collect())
}

/// Tests of which the masses, or the depths, of a member are at odds with the other quantity unless they are added up.
pub(super) fn increments(study: &Study, rows: &[FittedRow<'_>]) -> Vec<String> {
    let of = |test: usize| -> Option<(&str, Increments)> {
        let own = rows.iter().filter(|(o, _)| o.test == test);
        let own: Vec<FittedRow<'_>> = own.copied().collect();
        let members = [Subject::Pinion, Subject::Gear].into_iter();
        // sums need every one of the quantity that is added up
        let of_member = |member| {
            let moments = moments(&own, member);
            let found = Increments::among(&moments)?;
            let quantity = match found {
                Increments::Masses => Quantity::MassLoss,
                Increments::Depths => Quantity::WearDepth,
            };
            let measured = |o: &Observation| (o.member, o.quantity) == (member, quantity);
            let times: BTreeSet<u64> = (own.iter())
                .filter(|(o, _)| measured(o) && o.cycles > 0.0)
                .map(|(o, _)| o.cycles.to_bits())
                .collect();
            (moments.len() == times.len()).then_some(found)
        };
        let found = members.filter_map(of_member).next()?;
        Some((study.tests[test].id.as_str(), found))
    };
    let found: Vec<(&str, Increments)> = (0..study.tests.len()).filter_map(of).collect();
    let kinds = [
        (Increments::Masses, "masses", "depths", "weighing"),
        (Increments::Depths, "depths", "masses", "trace"),
    ];
    let line = |(kind, what, others, before): (Increments, &str, &str, &str)| {
        let tests: Vec<&str> = (found.iter().filter(|(_, k)| *k == kind))
            .map(|(id, _)| *id)
            .collect();
        (!tests.is_empty()).then(|| {
            format!(
                "the {what} of test{} {} agree with the {others} there only if they are added up: are they what was lost since the {before} before? They \
                 are wanted from the start of the test (gearwear import --per-interval adds them up)",
                if tests.len() > 1 { "s" } else { "" },
                tests.join(", ")
            )
        })
    };
    kinds.into_iter().filter_map(line).collect()
}

/// Which quantity counts from the measurement before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Increments {
    Masses,
    Depths,
}

impl Increments {
    /// Of the moments of one test and member.
    fn among(moments: &[Moment]) -> Option<Self> {
        if moments.len() < SEVERAL {
            return None;
        }
        let plain = range(moments.iter().map(Moment::ratio));
        let (mut mass, mut worn) = (0.0, 0.0);
        let sums = moments.iter().map(|moment| {
            mass += moment.mass;
            worn += moment.scale * moment.largest;
            let masses = (mass / moment.model_mass).ln() - moment.scale.ln();
            let depths = (moment.mass / moment.model_mass).ln() - (worn / moment.largest).ln();
            [masses, depths]
        });
        let sums: Vec<[f64; 2]> = sums.collect();
        let [masses, depths] = [0, 1].map(|i| {
            let sums = || sums.iter().map(|sum| sum[i]);
            let off = median(sums().collect()).map_or(f64::INFINITY, f64::abs);
            // what is lost at once, from all of a flank, stays in the sums
            if off < NEAR {
                range(sums())
            } else {
                f64::INFINITY
            }
        });
        let (kind, left) = if masses < depths {
            (Self::Masses, masses)
        } else {
            (Self::Depths, depths)
        };
        let measured = |moment: &Moment| match kind {
            Self::Masses => moment.mass,
            Self::Depths => moment.scale * moment.largest,
        };
        let is_no_sum = |two: &[Moment]| {
            let by_model = (two[1].largest / two[0].largest).powf(OF_MODEL);
            measured(&two[1]) < by_model.max(GROWS) * measured(&two[0])
        };
        let found = plain > 2f64.ln() && left < LEFT * plain;
        (found && moments.windows(2).any(is_no_sum)).then_some(kind)
    }
}

fn range(all: impl Iterator<Item = f64> + Clone) -> f64 {
    all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min)
}

/// A member's moments by rising cycles; of one test, if sums are to be made.
fn moments(rows: &[FittedRow<'_>], member: Subject) -> Vec<Moment> {
    let of = |quantity| {
        let all = rows.iter().copied();
        all.filter(move |(o, _)| (o.quantity, o.member) == (quantity, member))
    };
    let moment = |(mass, row): FittedRow<'_>| {
        let together = |(o, _): &FittedRow<'_>| {
            o.test == mass.test && (o.cycles - mass.cycles).abs() < SAME_CYCLES * mass.cycles
        };
        let traces: Vec<FittedRow<'_>> = of(Quantity::WearDepth).filter(together).collect();
        let depth = scale(&traces, Quantity::WearDepth, Some(member))
            .filter(|s| s.sigmas > TRACE && s.explains > EXPLAINS)?;
        let depths = traces.iter().map(|(_, row)| row.model);
        let is_sure = mass.value > MASS * mass.sigma && row.model > 0.0;
        is_sure.then(|| {
            let moment = Moment {
                mass: mass.value,
                model_mass: row.model,
                scale: depth.factor,
                largest: depths.fold(0.0, f64::max),
            };
            (mass.cycles, moment)
        })
    };
    let mut moments: Vec<(f64, Moment)> = of(Quantity::MassLoss).filter_map(moment).collect();
    moments.sort_by(|a, b| a.0.total_cmp(&b.0));
    moments.into_iter().map(|(_, moment)| moment).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Moments of a test whose model loses 10 mg and 2 µm with each, by measured masses and scales of depths.
    fn found(masses: [f64; 4], scales: [f64; 4]) -> Option<Increments> {
        let moment = |i: usize| Moment {
            mass: masses[i],
            model_mass: 10.0 * (i + 1) as f64,
            scale: scales[i],
            largest: 2.0 * (i + 1) as f64,
        };
        Increments::among(&[0, 1, 2, 3].map(moment))
    }

    #[test]
    fn what_was_lost_since_the_measurement_before_is_told_from_its_sum() {
        let right = [1.0; 4];
        let sums = [10.0, 20.0, 30.0, 40.0];
        assert_eq!(found(sums, right), None);
        // wear that slows down does so in both
        assert_eq!(
            found([12.0, 18.0, 22.0, 25.0], [1.2, 0.9, 0.73, 0.62]),
            None
        );
        assert_eq!(
            found([10.0, 9.0, 11.0, 10.0], right),
            Some(Increments::Masses)
        );
        assert_eq!(
            found(sums, [1.0, 0.5, 1.0 / 3.0, 0.25]),
            Some(Increments::Depths)
        );
        // the second depth is an eighth more than the first, where the model doubles
        assert_eq!(
            found(sums, [1.0, 0.56, 0.42, 0.36]),
            Some(Increments::Depths)
        );
        // roughness that is worn off the whole flank at once
        assert_eq!(found([30.0, 40.0, 50.0, 60.0], right), None);
        // halved ones are another question
        assert_eq!(found([5.0, 10.0, 15.0, 20.0], right), None);
    }
}
