//! The comparison of the contact models: `models.json`, its sentences and its summary for the terminal.
mod sentences;
mod text;

use serde_json::{Value, json};

pub use sentences::{conclusions, of_mounting};
pub use text::summary;

use crate::numeric::written::{fixed, significant};
use crate::simulate::models::{
    Comparison, Difference, Flank, Kind, Ladder, Means, ModelResult, Mounted, Quantity, Span,
};
use crate::simulate::result::Member;

/// `models.json`. Lengths mm, angles degrees, pressures MPa, line loads N/mm; the unit stands in the key where another is
/// meant.
pub fn document(title: &str, comparison: &Comparison) -> Value {
    let c = &comparison.conditions;
    let kinds = [Kind::Paper, Kind::Hertz, Kind::Fem];
    let kinds = kinds.map(|kind| json!({"model": kind, "assumptions": kind.assumptions()}));
    json!({
        "title": title,
        "conclusion": conclusions(comparison),
        "conditions": {
            "torque": c.torque / 1000.0, "speed": c.speed, "coefficient": c.coefficient[0], "cycles": c.cycles,
            "face_width": comparison.face_width, "teeth": comparison.teeth,
        },
        "models": kinds,
        "published_gear_speed": published_gear_speed(comparison),
        "definitions": {
            "regions": "lower_double A to B, single_lower B to C, single_upper C to D, upper_double D to E of the path of contact",
            "mean": "mean of the model over the mean of the reference along the region's path, minus 1",
            "mean_absolute": "mean of the absolute difference over the reference's mean",
            "max": "largest difference at one place, with its sign, over the reference's mean",
            "causes": "change of the mean along the path as one assumption after the other is replaced; all of them add up to the difference of the two models",
        },
        "misalignments": comparison.mounted.iter().map(mounting).collect::<Vec<_>>(),
        "left_out": comparison.left_out,
    })
}

/// The speed of the gear that the published model takes, and why.
pub fn published_gear_speed(comparison: &Comparison) -> String {
    let [z1, z2] = comparison.teeth.map(f64::from);
    let true_speed = significant(comparison.conditions.speed * z1 / z2, 6);
    match comparison.printed_gear_speed {
        Some(printed) => format!(
            "{} rpm, as printed in the paper for this pair; the tooth numbers give {true_speed} rpm",
            significant(printed, 4)
        ),
        None => format!("{true_speed} rpm from the tooth numbers"),
    }
}

fn mounting(mounted: &Mounted) -> Value {
    let g = &mounted.geometry;
    let mut document = json!({
        "misalignment": mounted.misalignment,
        "conclusion": of_mounting(mounted),
        "geometry": {
            "centre_distance": g.centre_distance, "working_pressure_angle": g.working_pressure_angle_deg,
            "contact_ratio": g.contact_ratio, "path_of_contact": g.path_of_contact, "base_pitch": g.base_pitch,
            "backlash_um": g.backlash_um, "speed_ratio": g.speed_ratio, "path_limits": g.path_limits,
        },
        "regions": mounted.spans.iter().map(|s| json!({"region": s.region.name(), "from": s.from, "to": s.to})).collect::<Vec<_>>(),
        "single_contact_fem": mounted.single,
        "models": mounted.models.iter().map(model).collect::<Vec<_>>(),
        "differences": mounted.differences.iter().map(difference).collect::<Vec<_>>(),
        "causes": causes(mounted),
        "ladders": mounted.ladders.iter().map(|l| ladder(l, &mounted.spans)).collect::<Vec<_>>(),
        "paper_corrections_alone": mounted.alone.iter().map(|a| json!({
            "cause": a.cause, "correction": a.correction, "change": means(&a.change, &mounted.spans),
        })).collect::<Vec<_>>(),
    });
    document["absent"] = match &mounted.absent {
        Some(reason) => json!([{"model": Kind::Paper, "reason": reason}]),
        None => json!([]),
    };
    document
}

fn model(model: &ModelResult) -> Value {
    let flank = |member: Member, flank: &Flank| json!({"member": member.name(), "radius": flank.radius, "path": flank.path, "depth_um": flank.depth_um});
    let gear = model.gear.iter().map(|gear| flank(Member::Gear, gear));
    json!({
        "model": model.kind,
        "contact": model.contact,
        "contact_end": model.contact_end,
        "wear": std::iter::once(flank(Member::Pinion, &model.pinion)).chain(gear).collect::<Vec<_>>(),
    })
}

fn difference(difference: &Difference) -> Value {
    json!({
        "quantity": difference.quantity,
        "unit": difference.quantity.unit(),
        "model": difference.model,
        "reference": difference.reference,
        "regions": difference.regions.iter().map(|r| json!({
            "region": r.region.name(), "model": r.model, "reference": r.reference, "mean": r.mean,
            "mean_absolute": r.mean_absolute, "max": r.max, "max_path": r.max_path,
        })).collect::<Vec<_>>(),
    })
}

/// Every quantity between every two neighbouring models and between the first and the last, by cause.
fn causes(mounted: &Mounted) -> Value {
    let ways = [
        (Kind::Paper, Kind::Hertz),
        (Kind::Hertz, Kind::Fem),
        (Kind::Paper, Kind::Fem),
    ];
    let mut out = Vec::new();
    for (from, to) in ways
        .into_iter()
        .filter(|&(from, _)| mounted.model(from).is_some())
    {
        for quantity in Quantity::ALL {
            let (Some(start), Some(end)) =
                (mounted.means(quantity, from), mounted.means(quantity, to))
            else {
                continue;
            };
            let causes: Vec<Value> = mounted
                .causes(quantity, from, to)
                .iter()
                .map(|(cause, change)| json!({"cause": cause, "change": means(change, &mounted.spans)}))
                .collect();
            if !causes.is_empty() {
                out.push(json!({
                    "quantity": quantity, "unit": quantity.unit(), "from": from, "to": to,
                    "start": means(start, &mounted.spans), "causes": causes, "end": means(end, &mounted.spans),
                }));
            }
        }
    }
    Value::Array(out)
}

fn ladder(ladder: &Ladder, spans: &[Span]) -> Value {
    let all = |list: &[Means]| -> Vec<Value> {
        list.iter()
            .map(|m| {
                let mut value = means(m, spans);
                value["quantity"] = json!(m.quantity);
                value
            })
            .collect()
    };
    json!({
        "from": ladder.from,
        "to": ladder.to,
        "start": all(&ladder.start),
        "rungs": ladder.rungs.iter().map(|r| json!({
            "cause": r.cause, "replaced": r.replaced, "by": r.by, "changes": all(&r.changes),
        })).collect::<Vec<_>>(),
        "end": all(&ladder.end),
    })
}

fn means(means: &Means, spans: &[Span]) -> Value {
    let mut value = json!({"whole": means.whole});
    for (span, mean) in spans.iter().zip(&means.regions) {
        value[span.region.name()] = json!(mean);
    }
    value
}

/// A change with fixed decimals and its sign, 0 without one.
pub(super) fn signed(value: f64, decimals: usize) -> String {
    let text = fixed(value, decimals);
    let zero = text.chars().all(|c| c == '0' || c == '.');
    if zero || value < 0.0 {
        text
    } else {
        format!("+{text}")
    }
}

/// Decimals that suit a quantity of a mounting: those of depths show the largest one by three digits, so that its causes add up.
pub(super) fn decimals(mounted: &Mounted, quantity: Quantity) -> usize {
    match quantity {
        Quantity::PeakPressure => 1,
        Quantity::LoadShare => 3,
        Quantity::DepthPinion | Quantity::DepthGear => {
            let means =
                (mounted.ladders.iter()).flat_map(|ladder| ladder.start.iter().chain(&ladder.end));
            let depths = means.filter(|means| means.quantity == quantity);
            let largest = depths
                .flat_map(|means| &means.regions)
                .copied()
                .fold(0.0, f64::max);
            decimals_of_depths(largest)
        }
    }
}

fn decimals_of_depths(largest: f64) -> usize {
    let of_three_digits = if largest > 0.0 {
        2.0 - largest.log10().floor()
    } else {
        0.0
    };
    of_three_digits.clamp(3.0, 9.0) as usize
}

#[cfg(test)]
mod tests {
    use super::decimals_of_depths;

    /// A steel pinion against plastic wears by hundredths of a micrometre: thousandths showed nothing but zeros.
    #[test]
    fn small_depths_are_written_with_three_digits() {
        let of = [40.0, 4.2, 0.5, 0.0241, 0.0042, 0.0].map(decimals_of_depths);
        assert_eq!(of, [3, 3, 3, 4, 5, 3]);
    }
}
