//! Values of an effect's parameters from which its fit may start.

use std::f64::consts::FRAC_PI_2;

use crate::effects::{ParamRole, Prior};
use crate::learn::hypothesis::parameters::Parameter;
use crate::numeric::halton::halton;
use crate::study::FreeParameter;

/// How many places of the priors are looked at besides.
pub(super) const SPREAD: usize = 8;
/// How many standard deviations large amounts are.
const LARGE: [f64; 2] = [4.0, 8.0];
/// How many lengths of waves are looked at, which have a valley each, and how weak, as a share of the prior's median: changes are to be linear.
const WAVES: usize = 12;
const WEAK_WAVE: f64 = 0.25;
/// The defaults, the priors' medians, the mirror image of each where both signs are possible, a weak effect, and large amounts: across the face
/// too, for the middle of a face feels nothing of a lead that does not lift its ends off.
pub(super) fn starts(fitted: &[FreeParameter], across_the_face: bool) -> Vec<Vec<f64>> {
    let defaults: Vec<f64> = fitted.iter().map(|f| f.value).collect();
    let medians: Vec<f64> = fitted.iter().map(median).collect();
    let mirrored = |values: &[f64]| -> Vec<f64> {
        fitted
            .iter()
            .zip(values)
            .map(|(f, &value)| mirror(f, value).clamp(f.lower, f.upper))
            .collect()
    };
    // Effects far from the defaults act far from linearly: each end of a wide prior is tried too.
    let ends = (0..fitted.len()).flat_map(|i| {
        let medians = medians.clone();
        let values = far(&fitted[i], across_the_face).into_iter();
        values.map(move |value| {
            let mut values = medians.clone();
            values[i] = value;
            values
        })
    });
    let weak = fitted.iter().map(|f| weak_ratio(f).unwrap_or(median(f)));
    let mut starts: Vec<Vec<f64>> = Vec::new();
    let plain = [
        defaults.clone(),
        mirrored(&defaults),
        medians.clone(),
        mirrored(&medians),
    ];
    for values in plain.into_iter().chain([weak.collect()]).chain(ends) {
        if !starts.contains(&values) {
            starts.push(values);
        }
    }
    starts
}

/// Places spread over the priors, for laws of several parameters that cost little to look at, and each with a weak effect.
pub(super) fn spread(
    parameters: &[Parameter],
    fitted: &[FreeParameter],
    count: usize,
) -> Vec<Vec<f64>> {
    let mut places = Vec::new();
    for i in 0..count {
        let shares = parameters.iter().zip(halton(i, parameters.len()));
        let place: Vec<f64> = shares.map(|(p, share)| p.quantile(share)).collect();
        let weak = place.iter().zip(fitted);
        let weak: Vec<f64> = weak.map(|(&x, f)| weak_ratio(f).unwrap_or(x)).collect();
        if weak != place {
            places.push(weak);
        }
        places.push(place);
    }
    places
}

/// Which of the parameters is the phase of a wave; of several waves that of the last one.
pub(super) fn phase(fitted: &[FreeParameter]) -> Option<usize> {
    fitted.iter().rposition(|f| f.role == ParamRole::WavePhase)
}

/// Weak waves a quarter of a wave apart, their other parameters spread over the priors.
pub(super) fn quarters(
    parameters: &[Parameter],
    fitted: &[FreeParameter],
    phase: usize,
) -> Vec<[Vec<f64>; 2]> {
    let wave = |i: usize, turn: f64| -> Vec<f64> {
        let mut shares = halton(i, parameters.len()).into_iter();
        let mut value = |at: usize| match fitted[at].neutral {
            _ if at == phase => turn,
            Some(none) => none + WEAK_WAVE * (median(&fitted[at]) - none),
            None => parameters[at].quantile(shares.next().unwrap_or(0.5)),
        };
        (0..parameters.len()).map(&mut value).collect()
    };
    let pair = |i| [wave(i, 0.0), wave(i, FRAC_PI_2)];
    (0..WAVES).map(pair).collect()
}

/// The prior's median; one standard deviation up where the median is no effect.
pub(super) fn median(free: &FreeParameter) -> f64 {
    match free.prior {
        Prior::Normal { mean, sd } if free.neutral.is_some() => mean + sd,
        prior => prior.median().clamp(free.lower, free.upper),
    }
}

/// For a ratio, a quarter of the way (of its logarithm) from no effect to the prior's median.
///
/// Laws are nearly linear in a ratio near 1, so fits find their way from there. From a coating ten times as hard as its base none
/// finds to one twice as hard: they look too unlike.
fn weak_ratio(free: &FreeParameter) -> Option<f64> {
    match (free.neutral, free.prior) {
        (Some(neutral), Prior::LogNormal { median, .. })
            if neutral > 0.0 && neutral.is_finite() =>
        {
            let ratio = neutral * (median / neutral).powf(0.25);
            Some(ratio.clamp(free.lower, free.upper))
        }
        _ => None,
    }
}

/// Values one standard deviation from the middle of a parameter's prior, and for a scale beyond which nothing happens much smaller ones
/// too: conditions may lie far below what is usual, and from too large a scale no search sees a slope.
fn far(free: &FreeParameter, across_the_face: bool) -> Vec<f64> {
    let values = match free.prior {
        Prior::Uniform { low, high } => [0.2, 0.8].map(|share| low + share * (high - low)).to_vec(),
        Prior::LogNormal { median, spread } => {
            let small: &[i32] = match free.neutral {
                Some(f64::INFINITY) => &[-3, -5],
                _ => &[],
            };
            let sigmas = [-1, 1].iter().chain(small);
            sigmas.map(|&sigmas| median * spread.powi(sigmas)).collect()
        }
        // of what acts in one way only, a small amount may do nothing at all
        Prior::Normal { sd, .. } if free.neutral == Some(free.lower) => {
            LARGE.map(|sds| free.lower + sds * sd).to_vec()
        }
        Prior::HalfNormal { sd } if across_the_face => LARGE.map(|sds| sds * sd).to_vec(),
        Prior::Normal { mean, sd } if across_the_face => {
            let large = LARGE.iter().flat_map(|sds| [sds * sd, -sds * sd]);
            large.map(|amount| mean + amount).collect()
        }
        Prior::Normal { .. } | Prior::HalfNormal { .. } => Vec::new(),
    };
    let inside = values
        .into_iter()
        .map(|value| value.clamp(free.lower, free.upper));
    inside.collect()
}

/// The other side of the value without effect, for a parameter that can lie on both.
fn mirror(free: &FreeParameter, value: f64) -> f64 {
    match (free.neutral, free.prior) {
        (Some(neutral), Prior::LogNormal { .. }) if neutral > free.lower && neutral.is_finite() => {
            neutral * neutral / value
        }
        (Some(neutral), Prior::Normal { .. } | Prior::Uniform { .. })
            if neutral > free.lower && neutral < free.upper =>
        {
            2.0 * neutral - value
        }
        _ => value,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::find;
    use crate::study::EffectSpec;

    /// Of a prior with a standard deviation of 8 µm: at mid-face a wedge of 6 µm does nothing, one of 60 µm halves the wear.
    #[test]
    fn large_leads_are_starts_of_either_sign_and_at_mid_face_of_one() {
        let card = find("lead_misalignment").unwrap();
        let starts_of = |form| {
            let fitted = EffectSpec::of_form(card, form, &[]).unwrap().fitted();
            starts(&fitted, true)
        };
        let own = starts_of(None);
        for slope in [6.0, -6.0, 32.0, -32.0, 64.0, -64.0] {
            assert!(own.contains(&vec![slope]), "{slope}: {own:?}");
        }
        let mid_face = card.forms.iter().find(|form| form.name == "mid-face");
        let mid_face = starts_of(mid_face);
        assert!(mid_face.contains(&vec![64.0]), "{mid_face:?}");
        assert!(mid_face.iter().all(|start| start[0] > 0.0), "{mid_face:?}");
    }
}
