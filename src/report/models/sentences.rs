//! What a comparison shows, in sentences.
use super::signed;
use crate::numeric::written::{capitalised, fixed, percent, significant};
use crate::simulate::models::{Cause, Comparison, Kind, Means, Mounted, Quantity};
use crate::simulate::numerics::FEW_EDGES;

/// The last digit of a relative difference that is shown.
const SHOWN: f64 = 1e-3;

/// What holds over all misalignments.
pub fn conclusions(comparison: &Comparison) -> Vec<String> {
    let all = &comparison.mounted;
    let mut sentences = Vec::new();
    let mut told = Vec::new();
    for (quantity, member) in [
        (Quantity::DepthPinion, "pinion"),
        (Quantity::DepthGear, "gear"),
    ] {
        let off: Vec<f64> = all
            .iter()
            .filter_map(|m| ratio(m, quantity, Kind::Hertz))
            .map(|r| r - 1.0)
            .collect();
        let is_shown = |off: &f64| off.abs() >= 0.5 * SHOWN;
        if !off.is_empty() && !off.iter().any(is_shown) {
            sentences.push(format!(
                "On the {member}, the mean worn depths of the Hertz and finite-element models agree within {}.",
                percent(SHOWN, 1)
            ));
        } else if let Some(off) = off_by(off.into_iter()) {
            let ways = all
                .iter()
                .map(|m| m.causes(quantity, Kind::Hertz, Kind::Fem));
            sentences.push(format!(
                "On the {member}, the Hertz model's mean worn depth is {off} that of the finite-element model{}.",
                blame(ways, &mut told)
            ));
        }
    }
    let single = all
        .iter()
        .filter_map(|m| m.single)
        .map(|s| s.largest_difference.abs());
    if let Some(largest) = single.max_by(f64::total_cmp) {
        sentences.push(format!(
            "Where a single pair of teeth carries the load, the peak pressures of the finite-element and Hertz models agree within {}.",
            percent(largest, 2)
        ));
    }
    if comparison.edges_per_half_width < FEW_EDGES {
        sentences.push(format!(
            "With {} flank edges on Hertz's half width the finite-element pressures are rough: what the pressures differ by is partly the mesh's ([numerics] \
             elements_per_half_width = 5 is usual).",
            significant(comparison.edges_per_half_width, 2)
        ));
    }
    let published: Vec<&Mounted> = all
        .iter()
        .filter(|m| m.model(Kind::Paper).is_some())
        .collect();
    let times = published
        .iter()
        .filter_map(|m| ratio(m, Quantity::DepthPinion, Kind::Paper));
    if let Some(range) = range(times, |v| significant(v, 3)) {
        let ways = published
            .iter()
            .map(|m| m.causes(Quantity::DepthPinion, Kind::Paper, Kind::Fem));
        sentences.push(format!(
            "The published model's mean worn depth of the pinion is {range} times that of the finite-element model{}.",
            blame(ways, &mut told)
        ));
    }
    sentences.extend(told.into_iter().filter_map(|cause| {
        let name = capitalised(cause.label());
        Some(format!("{name} means {}.", cause.meaning()?))
    }));
    for out in &comparison.left_out {
        sentences.push(format!(
            "A misalignment of {} mm is left out: {}.",
            out.misalignment, out.reason
        ));
    }
    if let Some(reason) = all.iter().find_map(|m| m.absent.as_ref()) {
        sentences.push(format!(
            "The published model is left out where its rules do not reach: {reason}."
        ));
    }
    sentences
}

/// What holds at one misalignment.
pub fn of_mounting(mounted: &Mounted) -> Vec<String> {
    let mut sentences = Vec::new();
    if let Some(single) = mounted.single {
        let [_, b, d, _] = mounted.geometry.path_limits;
        sentences.push(format!(
            "A single pair of teeth carries the load from {} to {} mm along the path of contact (nominally {} to {} mm); there, the \
             finite-element peak pressure is within {} of the Hertz value ({} on average).",
            significant(single.from, 3),
            significant(single.to, 3),
            significant(b, 3),
            significant(d, 3),
            percent(single.largest_difference.abs(), 2),
            percent(single.mean_difference, 2)
        ));
    }
    sentences.extend(of_way(
        mounted,
        Quantity::DepthPinion,
        Kind::Paper,
        "the pinion",
    ));
    sentences.extend(of_way(
        mounted,
        Quantity::DepthPinion,
        Kind::Hertz,
        "the pinion",
    ));
    sentences.extend(of_way(
        mounted,
        Quantity::DepthGear,
        Kind::Hertz,
        "the gear",
    ));
    sentences.extend(
        mounted
            .absent
            .as_ref()
            .map(|reason| format!("The published model cannot be run here: {reason}.")),
    );
    sentences
}

/// How much deeper `from` wears than finite elements, and what makes it so.
fn of_way(mounted: &Mounted, quantity: Quantity, from: Kind, member: &str) -> Option<String> {
    let (start, end) = (
        mounted.means(quantity, from)?,
        mounted.means(quantity, Kind::Fem)?,
    );
    let mut causes = mounted.causes(quantity, from, Kind::Fem);
    if causes.is_empty() || mounted.model(from).is_none() {
        return None;
    }
    let turned = from == Kind::Paper;
    causes.sort_by(|a, b| b.1.whole.abs().total_cmp(&a.1.whole.abs()));
    let total = end.whole - start.whole;
    let parts: Vec<String> = causes
        .iter()
        .take(4)
        .filter(|(_, change)| change.whole.abs() >= 0.005 * start.whole.abs().min(end.whole.abs()))
        .map(|(cause, change)| {
            if turned {
                format!(
                    "{} {} %",
                    cause.label(),
                    signed(100.0 * change.whole / total, 1)
                )
            } else {
                format!("{} {} µm", cause.label(), signed(change.whole, 3))
            }
        })
        .collect();
    let what = format!(
        "The {} model's mean worn depth of {member} is {} µm, that of the finite-element model {} µm",
        if turned { "published" } else { "Hertz" },
        significant(start.whole, 3),
        significant(end.whole, 3)
    );
    Some(match parts.is_empty() {
        true => format!("{what}."),
        false => format!(
            "{what}. Main contributions to the difference: {}.",
            parts.join(", ")
        ),
    })
}

fn ratio(mounted: &Mounted, quantity: Quantity, kind: Kind) -> Option<f64> {
    let (ours, theirs) = (
        mounted.means(quantity, kind)?.whole,
        mounted.means(quantity, Kind::Fem)?.whole,
    );
    (theirs != 0.0).then_some(ours / theirs)
}

/// Smallest to largest, or the one value.
fn range(values: impl Iterator<Item = f64>, written: impl Fn(f64) -> String) -> Option<String> {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| {
        (l.min(v), h.max(v))
    });
    let (low, high) = (low.is_finite().then(|| written(low))?, written(high));
    Some(if low == high {
        low
    } else {
        format!("{low} to {high}")
    })
}

/// How far values are off a reference, as relative differences: `2.0 to 3.7 % below`.
fn off_by(values: impl Iterator<Item = f64>) -> Option<String> {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| {
        (l.min(v), h.max(v))
    });
    let written = |v: f64| fixed(100.0 * v.abs(), 1);
    let side = |v: f64| if v < 0.0 { "below" } else { "above" };
    low.is_finite().then(|| {
        let [a, b] = [low, high].map(written);
        if a == b && (low < 0.0) == (high < 0.0) {
            format!("{a} % {}", side(low))
        } else if (low < 0.0) == (high < 0.0) {
            let (least, most) = if low < 0.0 { (b, a) } else { (a, b) };
            format!("{least} to {most} % {}", side(low))
        } else {
            format!("between {a} % below and {b} % above")
        }
    })
}

/// The causes that add most to the difference of the means over the misalignments, each noted as `told`; those that act against it are none.
fn blame(ways: impl Iterator<Item = Vec<(Cause, Means)>>, told: &mut Vec<Cause>) -> String {
    let mut sums: Vec<(Cause, f64)> = Vec::new();
    for way in ways {
        let total: f64 = way.iter().map(|(_, change)| change.whole).sum();
        for (cause, change) in way {
            let toward = change.whole * total.signum();
            match sums.iter_mut().find(|(c, _)| *c == cause) {
                Some((_, sum)) => *sum += toward,
                None => sums.push((cause, toward)),
            }
        }
    }
    sums.retain(|(_, sum)| *sum > 0.0);
    sums.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut name = |cause: Cause| {
        if !told.contains(&cause) {
            told.push(cause);
        }
        cause.label()
    };
    match sums.as_slice() {
        [] => String::new(),
        [(first, _)] => format!(", because of {}", name(*first)),
        [(first, most), (second, next), ..] if *next > 0.25 * most => {
            format!(", mainly because of {} and {}", name(*first), name(*second))
        }
        [(first, _), ..] => format!(", mainly because of {}", name(*first)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tip contact and load share make the difference here; the feedback acts against it, though by more than the load share.
    #[test]
    fn what_acts_against_a_difference_is_not_its_cause() {
        let way = |changes: [(Cause, f64); 3]| {
            changes.map(|(cause, whole)| {
                let means = Means {
                    quantity: Quantity::DepthGear,
                    regions: Vec::new(),
                    whole,
                };
                (cause, means)
            })
        };
        let down = [
            (Cause::TipContact, -2.0),
            (Cause::Feedback, 0.9),
            (Cause::LoadShare, -0.7),
        ];
        let up = down.map(|(cause, change)| (cause, -change));
        for changes in [down, up] {
            let mut told = Vec::new();
            let said = blame(std::iter::once(way(changes).to_vec()), &mut told);
            assert_eq!(told, [Cause::TipContact, Cause::LoadShare], "{said}");
        }
    }

    #[test]
    fn differences_say_on_which_side_they_are() {
        for (values, says) in [
            (&[-0.037][..], "3.7 % below"),
            (&[0.02], "2.0 % above"),
            (&[-0.037, -0.021], "2.1 to 3.7 % below"),
            (&[0.021, 0.037], "2.1 to 3.7 % above"),
            (&[-0.037, 0.021], "between 3.7 % below and 2.1 % above"),
        ] {
            assert_eq!(off_by(values.iter().copied()).as_deref(), Some(says));
        }
        assert_eq!(off_by(std::iter::empty()), None);
    }
}
