//! From one model to another, one replaced assumption after the other.

use super::curves::{PLACES, State, mean, place};
use super::data::{
    Cause, Difference, Kind, Ladder, Means, ModelResult, Quantity, RegionDifference, Rung, Span,
};

/// An assumption replaced and what then comes out.
pub(super) struct Step {
    pub(super) cause: Cause,
    pub(super) replaced: &'static str,
    pub(super) by: &'static str,
    pub(super) state: State,
}

/// The ladder from `from`, whose last step is the model `to`.
pub(super) fn climb(from: &ModelResult, steps: &[Step], to: Kind, spans: &[Span]) -> Ladder {
    let start = State::of(from);
    let states = || std::iter::once(&start).chain(steps.iter().map(|s| &s.state));
    let quantities: Vec<Quantity> = Quantity::ALL
        .into_iter()
        .filter(|&q| states().all(|s| s.means(q, spans).is_some()))
        .collect();
    let means = |state: &State| -> Vec<Means> {
        quantities
            .iter()
            .filter_map(|&q| state.means(q, spans))
            .collect()
    };
    let levels: Vec<Vec<Means>> = states().map(means).collect();
    let rungs = steps
        .iter()
        .zip(levels.windows(2))
        .map(|(step, pair)| Rung {
            cause: step.cause,
            replaced: step.replaced,
            by: step.by,
            changes: pair[0]
                .iter()
                .zip(&pair[1])
                .map(|(before, after)| change(before, after))
                .collect(),
        })
        .collect();
    Ladder {
        from: from.kind,
        to,
        start: levels.first().cloned().unwrap_or_default(),
        end: levels.last().cloned().unwrap_or_default(),
        rungs,
    }
}

/// What `after` has more than `before`.
pub(super) fn change(before: &Means, after: &Means) -> Means {
    Means {
        quantity: before.quantity,
        regions: before
            .regions
            .iter()
            .zip(&after.regions)
            .map(|(b, a)| a - b)
            .collect(),
        whole: after.whole - before.whole,
    }
}

/// Each model against each later one, in every quantity that both have.
pub(super) fn differences(models: &[ModelResult], spans: &[Span]) -> Vec<Difference> {
    let mut out = Vec::new();
    for (i, model) in models.iter().enumerate() {
        for reference in &models[i + 1..] {
            for quantity in Quantity::ALL {
                out.extend(difference(quantity, model, reference, spans));
            }
        }
    }
    out
}

fn difference(
    quantity: Quantity,
    model: &ModelResult,
    reference: &ModelResult,
    spans: &[Span],
) -> Option<Difference> {
    let ours = State::of(model).sample(quantity, spans)?;
    let theirs = State::of(reference).sample(quantity, spans)?;
    let regions = spans
        .iter()
        .zip(ours.iter().zip(&theirs))
        .map(|(span, (ours, theirs))| {
            let (model, reference) = (mean(ours), mean(theirs));
            let apart = |i: usize| ours[i] - theirs[i];
            let worst = (0..PLACES).fold(0, |worst, i| {
                if apart(i).abs() > apart(worst).abs() {
                    i
                } else {
                    worst
                }
            });
            let relative = |value: f64| (reference != 0.0).then(|| value / reference);
            let absolute = (0..PLACES).map(|i| apart(i).abs()).sum::<f64>() / PLACES as f64;
            RegionDifference {
                region: span.region,
                model,
                reference,
                mean: relative(model - reference),
                mean_absolute: relative(absolute),
                max: relative(apart(worst)),
                max_path: place(span, worst),
            }
        })
        .collect();
    Some(Difference {
        quantity,
        model: model.kind,
        reference: reference.kind,
        regions,
    })
}
