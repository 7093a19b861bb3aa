//! What could be missing: every effect of the catalogue in each accepted form, alone or several together.

use crate::effects::{CATALOGUE, Card, Hook, Prior};
use crate::learn::measured::{ModelVersion, parameter};
use crate::learn::parameters::Parameter;
use crate::numeric::halton::halton;
use crate::study::{EffectSpec, FreeParameter, Study, WEAR_COEFFICIENT};

/// The base model with nothing, one or several effects more.
#[derive(Debug, Clone)]
pub(super) struct Candidate {
    /// The added effects in the catalogue's order; none for the base model.
    pub(super) names: Vec<&'static str>,
    /// The forms of those.
    pub(super) forms: Vec<&'static str>,
    /// Number of accepted forms among which the prior is shared.
    pub(super) siblings: usize,
    /// The model.
    pub(super) version: ModelVersion,
    /// Its free parameters without the wear coefficient, those of the base model first.
    pub(super) parameters: Vec<Parameter>,
    /// How many of them the base model has.
    pub(super) inherited: usize,
    /// Values of the added parameters from which a fit may start.
    pub(super) starts: Vec<Vec<f64>>,
}

/// An effect that cannot be judged.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct NotJudged {
    /// Its name.
    pub effect: String,
    /// Keys of the study that it needs.
    pub needs: Vec<String>,
}

/// Effects whose rate grows with a power of the local pressure or sets in at one.
const SHARP: [&str; 4] = [
    "pressure_exponent",
    "severe_transition",
    "micropitting",
    "plastic_deformation",
];

/// How many places of the priors are looked at besides.
const SPREAD: usize = 8;

/// Name of the form with a card's own settings.
const OWN: &str = "";

impl Candidate {
    /// The study's own model.
    pub(super) fn base(study: &Study) -> Self {
        let version = ModelVersion::of(study);
        let parameters = parameters(&version.free);
        Self {
            names: Vec::new(),
            forms: Vec::new(),
            siblings: 1,
            inherited: parameters.len(),
            parameters,
            version,
            starts: vec![Vec::new()],
        }
    }

    /// All single effects that the study does not hold yet and can judge, and those that it cannot.
    pub(super) fn singles(study: &Study) -> (Vec<Self>, Vec<NotJudged>) {
        let base = Self::base(study);
        let mut judged = Vec::new();
        let mut not_judged = Vec::new();
        for &card in CATALOGUE {
            if base.version.effects.has(card.name) {
                continue;
            }
            let missing = card.needs.iter().filter(|key| !study.states(key));
            let needs: Vec<String> = missing.map(|key| (*key).to_owned()).collect();
            if needs.is_empty() {
                judged.extend(forms(card, &base));
            } else {
                let effect = card.name.to_owned();
                not_judged.push(NotJudged { effect, needs });
            }
        }
        (judged, not_judged)
    }

    /// Both effects in their forms; the parameters of `self` first.
    pub(super) fn with(&self, other: &Self) -> Self {
        let added = &other.version.effects.specs()[other.version.effects.specs().len() - 1];
        let version = self.version.with(added.clone());
        let mut all: Vec<(&'static str, &'static str)> = (self.names.iter().copied())
            .zip(self.forms.iter().copied())
            .chain((other.names.iter().copied()).zip(other.forms.iter().copied()))
            .collect();
        all.sort_by_key(|(name, _)| place(name));
        let (names, forms) = all.into_iter().unzip();
        Self {
            names,
            forms,
            siblings: self.siblings * other.siblings,
            parameters: parameters(&version.free),
            inherited: self.inherited,
            version,
            starts: Vec::new(),
        }
    }

    /// Whether its rate is sharp in the local pressure, which the analytic model knows least.
    pub(super) fn sharp(&self) -> bool {
        self.names.iter().any(|name| SHARP.contains(name))
    }

    /// Whether every added effect has its card's own form.
    pub(super) fn is_own_form(&self) -> bool {
        self.forms.iter().all(|form| *form == OWN)
    }

    /// Values of its parameters: the base model's own as they are, the added ones' prior medians.
    pub(super) fn medians(&self) -> Vec<f64> {
        let free = self.version.free.iter();
        let free: Vec<&FreeParameter> = free.filter(|f| f.name != WEAR_COEFFICIENT).collect();
        let (own, added) = free.split_at(self.inherited);
        let added = added.iter().map(|f| median(f));
        own.iter().map(|f| f.value).chain(added).collect()
    }

    /// `a+b`, or `nothing_missing`.
    pub(super) fn name(&self) -> String {
        if self.names.is_empty() {
            super::NOTHING.to_owned()
        } else {
            self.names.join("+")
        }
    }
}

/// Place in the catalogue.
fn place(name: &str) -> usize {
    let place = CATALOGUE.iter().position(|card| card.name == name);
    place.unwrap_or(CATALOGUE.len())
}

/// The card's effect in its own form and every other accepted one.
fn forms(card: &'static Card, base: &Candidate) -> Vec<Candidate> {
    let own = std::iter::once((OWN, [].as_slice(), [].as_slice()));
    let others = (card.forms.iter()).map(|form| (form.name, form.settings, form.frees));
    let all: Vec<Candidate> = own
        .chain(others)
        .filter_map(|(form, settings, frees)| {
            // A form's settings lie in the ranges of its card: tests walk the catalogue.
            let spec = EffectSpec {
                freed: frees,
                ..EffectSpec::of_card(card, settings).ok()?
            };
            let fitted = spec.fitted();
            let version = base.version.with(spec);
            let parameters = parameters(&version.free);
            let mut starts = starts(&fitted);
            if fitted.len() > 1 && card.hook == Hook::WearFactor {
                starts.extend(spread(&parameters[base.inherited..]));
            }
            Some(Candidate {
                names: vec![card.name],
                forms: vec![form],
                siblings: 1 + card.forms.len(),
                parameters,
                inherited: base.inherited,
                version,
                starts,
            })
        })
        .collect();
    all
}

/// The defaults, the priors' medians, the mirror image of each where both signs are possible, and a weak effect.
fn starts(fitted: &[FreeParameter]) -> Vec<Vec<f64>> {
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
        far(&fitted[i]).into_iter().map(move |value| {
            let mut values = medians.clone();
            values[i] = value;
            values
        })
    });
    let weak: Vec<f64> = fitted.iter().map(weak).collect();
    let mut starts: Vec<Vec<f64>> = Vec::new();
    let plain = [
        defaults.clone(),
        mirrored(&defaults),
        medians.clone(),
        mirrored(&medians),
    ];
    for values in plain.into_iter().chain([weak]).chain(ends) {
        if !starts.contains(&values) {
            starts.push(values);
        }
    }
    starts
}

/// Places spread over the priors, for laws of several parameters that cost little to look at.
fn spread(parameters: &[Parameter]) -> impl Iterator<Item = Vec<f64>> {
    (0..SPREAD).map(|i| {
        let shares = parameters.iter().zip(halton(i, parameters.len()));
        shares.map(|(p, share)| p.quantile(share)).collect()
    })
}

/// The prior's median; one standard deviation up where the median is no effect.
fn median(free: &FreeParameter) -> f64 {
    match free.prior {
        Prior::Normal { mean, sd } if free.neutral.is_some() => mean + sd,
        prior => prior.median().clamp(free.lower, free.upper),
    }
}

/// Half way (of its logarithm) from the prior's median to no effect, for a ratio; the median of others.
///
/// A coating ten times as hard as its base and one twice as hard look so unlike that no fit finds from one to the other.
fn weak(free: &FreeParameter) -> f64 {
    match (free.neutral, free.prior) {
        (Some(neutral), Prior::LogNormal { median, .. })
            if neutral > 0.0 && neutral.is_finite() =>
        {
            (neutral * median).sqrt().clamp(free.lower, free.upper)
        }
        _ => median(free),
    }
}

/// Values one standard deviation from the middle of a parameter's prior.
fn far(free: &FreeParameter) -> Vec<f64> {
    let values = match free.prior {
        Prior::Uniform { low, high } => [0.2, 0.8].map(|share| low + share * (high - low)),
        Prior::LogNormal { median, spread } => [median / spread, median * spread],
        Prior::Normal { .. } | Prior::HalfNormal { .. } => return Vec::new(),
    };
    values
        .map(|value| value.clamp(free.lower, free.upper))
        .to_vec()
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

fn parameters(free: &[FreeParameter]) -> Vec<Parameter> {
    free.iter()
        .filter(|free| free.name != WEAR_COEFFICIENT)
        .map(parameter)
        .collect()
}
