//! Wear that falls with the cycles: checkpoints exchanged, a digit lost, one written in another unit.
//!
//! ```text
//! y ≈ s f of each depth curve     f the fitted model, the curve's datum removed, least squares weighted by 1/σ²
//! s N of a later checkpoint far below that of an earlier one: what the model wears grows with N
//! ```
//! Only of curves that have the model's shape: where the pattern changes over life, s may fall although every point wears. Masses are compared
//! as they are.

use std::collections::BTreeMap;

use super::super::residual_statistics::FittedRow;
use crate::measure::{Dataset, FacePlace, Quantity, Subject};
use crate::study::Study;

/// Standard deviations from which a fall is no noise.
const SURE: f64 = 6.0;
/// How far it must go where the model's shape stands for that of the curves.
const FALLS_TO: f64 = 0.8;
/// The same of masses, which no shape of the model stands behind, and how far they must fall then.
const SURE_OF_MASS: f64 = 4.5;
const MASS_FALLS_SURELY_TO: f64 = 0.9;
/// Share to which a mass falls, and share of the largest one that it has been, from which it is asked about where sigmas are estimated: a wrong mass
/// has made its own sigma large.
const MASS_FALLS_TO: f64 = 0.75;
const OF_LARGEST_MASS: f64 = 0.15;
/// What is left where nothing is worn: no checkpoint of the same flank.
const VANISHES_TO: f64 = 0.1;
/// Fewest points of a curve, and the share of its squares that `s f` must explain.
const FEWEST: usize = 4;
const OF_ITS_SHAPE: f64 = 0.8;
/// Series that fall which are asked about one by one.
const SAID_EACH: usize = 3;
/// Ratio of the largest values of two checkpoints, each over its cycles, that a unit a thousand times larger in one of them makes: wear is not even over life.
const A_THOUSAND: [f64; 2] = [400.0, 2500.0];

/// How much was worn at a checkpoint, in any unit, and its standard deviation.
pub(super) struct Worn {
    pub(super) cycles: f64,
    pub(super) amount: f64,
    pub(super) sigma: f64,
    /// Largest value as it was written.
    pub(super) largest: f64,
}

/// Two checkpoints between which wear falls.
pub(super) struct Fall {
    from: f64,
    to: f64,
    /// The one of them that looks a thousand times too small, or too large, if one does.
    unit: Option<OtherUnit>,
    /// Whether hardly anything is left.
    vanishes: bool,
}

/// Which of two checkpoints is in another unit.
#[derive(Clone, Copy)]
enum OtherUnit {
    /// The later one, in one a thousand times larger.
    LaterInLarger,
    /// The earlier one, in one a thousand times smaller.
    EarlierInSmaller,
}

/// Tests whose wear falls from one checkpoint to the next.
pub(super) fn falling(study: &Study, data: &Dataset, rows: &[FittedRow<'_>]) -> Vec<String> {
    let mut said = Vec::new();
    for quantity in [Quantity::WearDepth, Quantity::MassLoss] {
        for ((test, member), series) in series(rows, quantity) {
            let estimated = quantity == Quantity::MassLoss && data.estimates_sigmas();
            let falls = |worn: &Vec<Worn>| {
                let plainly = || falling_mass(worn).filter(|_| estimated);
                let surely = match quantity {
                    Quantity::MassLoss => fall_of(worn, SURE_OF_MASS, MASS_FALLS_SURELY_TO),
                    _ => fall(worn, FALLS_TO),
                };
                surely.or_else(plainly)
            };
            let Some(fall) = series.iter().find_map(falls) else {
                continue;
            };
            let of = format!(
                "in test {} {} of the {}",
                study.tests[test].id,
                quantity.name(),
                member.name()
            );
            said.push(fall.in_words(&of, quantity));
        }
    }
    shortened(said)
}

/// The same where many series fall: the first of them, and how many more there are.
pub(super) fn shortened(mut said: Vec<String>) -> Vec<String> {
    let more = said.len().saturating_sub(SAID_EACH);
    if more > 1 {
        said.truncate(SAID_EACH);
        if let Some(last) = said.last_mut() {
            *last += &format!(" So it is in {more} more series.");
        }
    }
    said
}

impl Fall {
    /// A question about it, `of` the values of one test and member.
    pub(super) fn in_words(&self, of: &str, quantity: Quantity) -> String {
        let (from, to) = (self.from, self.to);
        let [larger, smaller] = match quantity {
            Quantity::MassLoss => ["g", "µg"],
            _ => ["mm", "nm"],
        };
        match self.unit {
            None if self.vanishes && quantity == Quantity::WearDepth => format!(
                "{of} has all but gone after {to} cycles beside what it is after {from}: was another flank, another tooth or a new part measured then?"
            ),
            None => format!(
                "{of} is less after {to} cycles than after {from}: wear does not fall. Are the cycles of two checkpoints exchanged, is a decimal point wrong in the cycles or values of one, does one belong to another test, or is this what was lost since the measurement before (gearwear import --per-interval)?"
            ),
            Some(OtherUnit::LaterInLarger) => format!(
                "{of} is about a thousand times less after {to} cycles than after {from}: was that checkpoint written in {larger}?"
            ),
            Some(OtherUnit::EarlierInSmaller) => format!(
                "{of} is about a thousand times more after {from} cycles than after {to}: was that checkpoint written in {smaller}?"
            ),
        }
    }
}

/// The first two checkpoints between which wear falls below this share of what it was.
pub(super) fn fall(worn: &[Worn], share: f64) -> Option<Fall> {
    fall_of(worn, SURE, share)
}

/// The same, by so many standard deviations.
fn fall_of(worn: &[Worn], sure: f64, share: f64) -> Option<Fall> {
    worn.windows(2).enumerate().find_map(|(place, pair)| {
        let [before, after] = [&pair[0], &pair[1]];
        let far = before.amount - after.amount > sure * before.sigma.hypot(after.sigma);
        // traces of one checkpoint are no fall
        let far = far && before.cycles < after.cycles;
        (far && after.amount < share * before.amount).then(|| Fall {
            from: before.cycles,
            to: after.cycles,
            unit: other_unit(worn, place),
            vanishes: vanishes(worn, place),
        })
    })
}

/// Whether hardly anything is left behind the checkpoint at `place`, by that one and by a third: of two alone the other may be too large.
fn vanishes(worn: &[Worn], place: usize) -> bool {
    let is_far_above = |other: &Worn| worn[place + 1].amount < VANISHES_TO * other.amount;
    let others = worn[..place].iter().chain(&worn[place + 2..]);
    is_far_above(&worn[place]) && others.into_iter().any(is_far_above)
}

/// The first two checkpoints between which a mass falls by far, whatever its sigma.
fn falling_mass(worn: &[Worn]) -> Option<Fall> {
    let largest = worn.iter().map(|worn| worn.largest).fold(0.0, f64::max);
    let sure: Vec<Worn> = (worn.iter())
        .filter(|worn| worn.amount > OF_LARGEST_MASS * largest)
        .map(|worn| Worn {
            sigma: 0.0,
            ..*worn
        })
        .collect();
    fall(&sure, MASS_FALLS_TO)
}

/// Which of the checkpoints at `place` and behind it is a thousand times off, by the pace of the two and of a third beside them.
fn other_unit(worn: &[Worn], place: usize) -> Option<OtherUnit> {
    let pace = |worn: &Worn| worn.largest / worn.cycles;
    let is_thousand = |times: f64| (A_THOUSAND[0]..A_THOUSAND[1]).contains(&times);
    let (before, after) = (pace(&worn[place]), pace(&worn[place + 1]));
    if !is_thousand(before / after) {
        return None;
    }
    // a third one tells which of the two it is that is off
    let third = (worn.get(place + 2)).or_else(|| worn.get(place.checked_sub(1)?));
    match third.map(pace) {
        Some(third) if is_thousand(third / after) => Some(OtherUnit::LaterInLarger),
        Some(third) if is_thousand(before / third) => Some(OtherUnit::EarlierInSmaller),
        _ => None,
    }
}

type Series = BTreeMap<(usize, Subject), Vec<Vec<Worn>>>;

/// What was worn at the checkpoints of each test and member, by rising cycles; a series for each place across the face and tooth.
fn series(rows: &[FittedRow<'_>], quantity: Quantity) -> Series {
    let mut curves: BTreeMap<_, Vec<&FittedRow<'_>>> = BTreeMap::new();
    for row in rows
        .iter()
        .filter(|(o, _)| o.quantity == quantity && o.cycles > 0.0)
    {
        let o = row.0;
        let cut = (o.face.map(FacePlace::key), o.tooth.as_deref());
        // positive numbers stand in the order of their bits
        let key = (o.test, o.member, cut, o.cycles.to_bits(), o.trace);
        curves.entry(key).or_default().push(row);
    }
    let mut all: BTreeMap<_, Vec<Worn>> = BTreeMap::new();
    for ((test, member, cut, ..), own) in curves {
        let worn = match quantity {
            Quantity::MassLoss => mass(&own),
            _ => depth(&own),
        };
        if let Some(worn) = worn {
            all.entry((test, member, cut)).or_default().push(worn);
        }
    }
    let mut series = Series::new();
    for ((test, member, _), worn) in all {
        series.entry((test, member)).or_default().push(worn);
    }
    series
}

fn mass(own: &[&FittedRow<'_>]) -> Option<Worn> {
    let (o, _) = own.first()?;
    Some(Worn {
        cycles: o.cycles,
        amount: o.value,
        sigma: o.sigma,
        largest: o.value.abs(),
    })
}

fn depth(own: &[&FittedRow<'_>]) -> Option<Worn> {
    let sum = |f: &dyn Fn(f64, f64) -> f64| -> f64 {
        let term = |(o, row): &&FittedRow<'_>| o.sigma.powi(-2) * f(row.model, o.value);
        own.iter().map(term).sum()
    };
    let weight = sum(&|_, _| 1.0);
    let [f, y] = [sum(&|f, _| f) / weight, sum(&|_, y| y) / weight];
    let ff = sum(&|model, _| (model - f).powi(2));
    let yy = sum(&|_, value| (value - y).powi(2));
    let fy = sum(&|model, value| (model - f) * (value - y));
    let cycles = own.first()?.0.cycles;
    let of_its_shape = fy * fy > OF_ITS_SHAPE * ff * yy;
    (own.len() >= FEWEST && ff > 0.0 && of_its_shape).then(|| Worn {
        cycles,
        amount: cycles * fy / ff,
        sigma: cycles / ff.sqrt(),
        largest: own.iter().map(|(o, _)| o.value.abs()).fold(0.0, f64::max),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 858 mg among masses up to 179 mg.
    #[test]
    fn masses_that_fall_by_far_are_found_without_a_sigma() {
        let masses = |all: &[f64]| {
            let worn = all.iter().enumerate().map(|(i, &amount)| Worn {
                cycles: 1e5 * (i + 1) as f64,
                amount,
                sigma: 276.0,
                largest: amount,
            });
            falling_mass(&worn.collect::<Vec<_>>()).map(|fall| [fall.from, fall.to])
        };
        assert_eq!(masses(&[131.0, 858.0, 160.0, 179.0]), Some([2e5, 3e5]));
        assert_eq!(masses(&[50.0, 131.0, 89.0, 179.0]), Some([2e5, 3e5]));
        assert_eq!(masses(&[50.0, 89.0, 131.0, 120.0]), None);
        // small ones scatter
        assert_eq!(masses(&[9.0, 4.0, 131.0, 179.0]), None);
    }

    /// The weighing after 675 000 cycles is another test's: 4.7 standard deviations below the one before it.
    #[test]
    fn masses_that_fall_surely_are_found() {
        let falls = |masses: [[f64; 2]; 3]| {
            let worn = masses.iter().enumerate().map(|(i, &[amount, sigma])| Worn {
                cycles: 2.25e5 * (i + 2) as f64,
                amount,
                sigma,
                largest: amount,
            });
            let worn: Vec<Worn> = worn.collect();
            fall_of(&worn, SURE_OF_MASS, MASS_FALLS_SURELY_TO).map(|fall| [fall.from, fall.to])
        };
        let [before, after] = [[56.95, 1.73], [96.6, 2.51]];
        assert_eq!(falls([before, [46.26, 1.49], after]), Some([4.5e5, 6.75e5]));
        assert_eq!(falls([before, [50.0, 1.49], after]), None);
        assert_eq!(falls([before, [54.0, 0.01], after]), None);
    }

    #[test]
    fn many_series_that_fall_are_counted() {
        let said = |n: usize| shortened((0..n).map(|i| format!("{i}?")).collect());
        assert_eq!(said(4), ["0?", "1?", "2?", "3?"]);
        assert_eq!(said(9), ["0?", "1?", "2? So it is in 6 more series."]);
        assert_eq!(said(0), [""; 0]);
    }

    #[test]
    fn a_checkpoint_in_another_unit_is_told_from_exchanged_ones() {
        let said = |amounts: [f64; 4]| {
            let worn = amounts.iter().enumerate().map(|(i, &amount)| Worn {
                cycles: 1e5 * (i + 1) as f64,
                amount,
                sigma: 0.001 * amount,
                largest: amount,
            });
            let worn: Vec<Worn> = worn.collect();
            fall(&worn, FALLS_TO)
                .map(|fall| fall.in_words("in test A wear_depth of the gear", Quantity::WearDepth))
        };
        let is = |amounts, part: &str| said(amounts).unwrap().contains(part);
        assert!(is(
            [2.0, 0.0041, 6.0, 8.0],
            "after 200000 cycles than after 100000: was that checkpoint written in mm?"
        ));
        assert!(is(
            [2.0, 4.0, 5.9, 0.0081],
            "after 400000 cycles than after 300000: was that checkpoint written in mm?"
        ));
        assert!(is(
            [2.0, 4100.0, 6.0, 8.0],
            "after 200000 cycles than after 300000: was that checkpoint written in nm?"
        ));
        assert!(is([2.0, 6.0, 4.0, 8.0], "exchanged"));
        // the second is a hundred times too large, the third is of an unworn flank
        assert!(is([2.0, 400.0, 6.0, 8.0], "decimal point"));
        assert!(is(
            [2.0, 4.0, 0.02, 8.0],
            "all but gone after 300000 cycles"
        ));
        assert_eq!(said([2.0, 4.0, 6.0, 8.0]), None);
    }
}
