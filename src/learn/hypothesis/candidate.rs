//! What could be missing: every effect of the catalogue in each accepted form, alone or several together.

use std::f64::consts::FRAC_PI_2;

use super::starting_values::{SPREAD, median, phase, quarters, spread, starts};
use super::version::{ModelVersion, parameter};
use super::{EffectSet, Hypothesis};
use crate::effects::{CATALOGUE, Card, Form, Hook, ParamRole};
use crate::learn::hypothesis::parameters::Parameter;
use crate::measure::Dataset;
use crate::study::{EffectSpec, FreeParameter, Study, WEAR_COEFFICIENT};

/// The base model with nothing, one or several effects more.
#[derive(Debug, Clone)]
pub(in crate::learn) struct Candidate {
    /// The added effects; none for the base model.
    pub(in crate::learn) effects: EffectSet,
    /// The forms of those; None the card's own.
    pub(in crate::learn) forms: Vec<Option<&'static Form>>,
    /// Number of accepted forms among which the prior is shared.
    pub(in crate::learn) siblings: usize,
    /// The model.
    pub(in crate::learn) version: ModelVersion,
    /// Its free parameters without the wear coefficient, those of the base model first.
    pub(in crate::learn) parameters: Vec<Parameter>,
    /// How many of them the base model has.
    pub(in crate::learn) inherited: usize,
    /// Values of the added parameters from which a fit may start.
    pub(in crate::learn) starts: Vec<Vec<f64>>,
    /// Weak waves in pairs a quarter of a wave apart, between which every phase lies.
    pub(in crate::learn) quarters: Vec<[Vec<f64>; 2]>,
    /// Where these join other waves, the values with those alone.
    pub(in crate::learn) without_wave: Option<Vec<f64>>,
    /// Of the added parameters: lower bound, upper bound, and value without effect where that is finite.
    strengths: Vec<(f64, f64, Option<f64>)>,
}

/// An effect that cannot be judged.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct NotJudged {
    /// Its name.
    pub effect: String,
    /// What the study would have to state: keys, or a key with its value.
    pub needs: Vec<String>,
}

/// Starts are scaled to the amplitude that gains most in the linearised model, but to no less than this.
pub(in crate::learn) const LEAST_AMPLITUDE: f64 = 0.02;

impl Candidate {
    /// The study's own model.
    pub(in crate::learn) fn base(study: &Study) -> Self {
        let version = ModelVersion::of(study);
        let parameters = parameters(&version.free);
        Self {
            effects: EffectSet::new([]),
            forms: Vec::new(),
            siblings: 1,
            inherited: parameters.len(),
            parameters,
            version,
            starts: vec![Vec::new()],
            quarters: Vec::new(),
            without_wave: None,
            strengths: Vec::new(),
        }
    }

    /// As [`Candidate::singles`], given where `data` was measured: where rows state several places across the face and the model is at one of them, effects across the
    /// face are not judged.
    pub(in crate::learn) fn singles_for(
        study: &Study,
        data: &Dataset,
    ) -> (Vec<Self>, Vec<NotJudged>) {
        let (judged, mut not_judged) = Self::singles(study);
        let Some(needed) = study.needed_across_the_face(data) else {
            return (judged, not_judged);
        };
        let (across, judged): (Vec<Self>, Vec<Self>) =
            judged.into_iter().partition(Self::acts_across_the_face);
        let mut names: Vec<String> = across.iter().map(|c| c.effects.to_string()).collect();
        names.dedup();
        not_judged.extend(names.into_iter().map(|effect| NotJudged {
            effect,
            needs: vec![needed.to_owned()],
        }));
        (judged, not_judged)
    }

    /// All single effects that the study does not hold yet and states what they need, and those that lack something.
    pub(in crate::learn) fn singles(study: &Study) -> (Vec<Self>, Vec<NotJudged>) {
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
                judged.extend(forms(card, &base, study));
            } else {
                let effect = card.name.to_owned();
                not_judged.push(NotJudged { effect, needs });
            }
        }
        (judged, not_judged)
    }

    /// Whether its free parameters are those of another.
    pub(in crate::learn) fn has_parameters_of(&self, other: &Self) -> bool {
        let names = self.parameters.iter().map(|p| &p.name);
        names.eq(other.parameters.iter().map(|p| &p.name))
    }

    /// Both effects in their forms; the parameters of `self` first.
    pub(in crate::learn) fn with(&self, other: &Self) -> Self {
        let added = &other.version.effects.specs()[other.version.effects.specs().len() - 1];
        let version = self.version.with(added.clone());
        let effects = EffectSet::new(self.added_forms().chain(other.added_forms()).map(|f| f.0));
        let form = |card: &&'static Card| {
            let mut all = self.added_forms().chain(other.added_forms());
            all.find(|(known, _)| known.name == card.name)
                .and_then(|f| f.1)
        };
        Self {
            forms: effects.cards().iter().map(form).collect(),
            effects,
            siblings: self.siblings * other.siblings,
            parameters: parameters(&version.free),
            inherited: self.inherited,
            version,
            starts: Vec::new(),
            quarters: Vec::new(),
            without_wave: None,
            strengths: Vec::new(),
        }
    }

    /// The forms that grow out of this one, a single effect's own, with the values that its parameters were fitted to.
    pub(in crate::learn) fn grown(
        &self,
        study: &Study,
        base: &Candidate,
        values: &[f64],
    ) -> Vec<Self> {
        let Some(card) = self.effects.single().filter(|_| self.is_own_form()) else {
            return Vec::new();
        };
        let forms = card.forms.iter().filter(|form| !form.grown.is_empty());
        forms
            .filter_map(|form| {
                let (mut candidate, fitted) = of_form(card, Some(form), base, study)?;
                let places = form.grown.iter().map(|place| [values, place].concat());
                match phase(&fitted).filter(|&at| at >= values.len()) {
                    Some(phase) => candidate.add_wave(places.collect(), phase, values.len()),
                    None => candidate.starts = places.collect(),
                }
                Some(candidate)
            })
            .collect()
    }

    /// Starts of a form that adds a wave, whose `phase` it is, to `own` fitted values: for each of the places two waves a quarter of a wave apart.
    fn add_wave(&mut self, places: Vec<Vec<f64>>, phase: usize, own: usize) {
        for (_, _, neutral) in &mut self.strengths[..own] {
            *neutral = None;
        }
        self.without_wave = places.first().map(|place| self.scaled(place, 0.0));
        let turned = |place: Vec<f64>| {
            let mut quarter = place.clone();
            quarter[phase] += FRAC_PI_2;
            [place, quarter]
        };
        self.quarters = places.into_iter().map(turned).collect();
    }

    /// Values of a start with `amplitude` times the effect, as far as that is linear in the parameters that have a value without
    /// effect.
    pub(in crate::learn) fn scaled(&self, values: &[f64], amplitude: f64) -> Vec<f64> {
        let all = values.iter().zip(&self.strengths);
        all.map(|(&x, &(lower, upper, neutral))| {
            neutral.map_or(x, |none| {
                (none + amplitude * (x - none)).clamp(lower, upper)
            })
        })
        .collect()
    }

    /// The wave that is `along` times one and `across` times the one a quarter of a wave on.
    pub(in crate::learn) fn turned(&self, values: &[f64], [along, across]: [f64; 2]) -> Vec<f64> {
        let mut turned = self.scaled(values, along.hypot(across).max(LEAST_AMPLITUDE));
        let own = &self.version.free;
        let added = own.len() - values.len();
        if let Some(phase) = phase(&own[added..]) {
            turned[phase] = across.atan2(along);
        }
        turned
    }

    /// All values of the added parameters at which its change is looked at for a start.
    pub(in crate::learn) fn looked_at(&self) -> impl Iterator<Item = &Vec<f64>> {
        let quarters = self.quarters.iter().flatten();
        self.starts.iter().chain(quarters).chain(&self.without_wave)
    }

    /// Whether its rate is sharp in the local pressure, which the analytic model knows least.
    pub(in crate::learn) fn sharp(&self) -> bool {
        let sharp = |card: &&Card| card.has(ParamRole::PressureSharpness);
        self.effects.cards().iter().any(sharp)
    }

    /// Whether it changes how the teeth touch, and not only how what touches wears.
    pub(in crate::learn) fn changes_contact(&self) -> bool {
        let cards = self.effects.cards();
        cards.iter().any(|card| card.hook.changes_contact())
    }

    /// Whether both are single effects of which one card or the other says that they are mistaken for one another.
    pub(in crate::learn) fn is_look_alike_of(&self, other: &Self) -> bool {
        let names = |a: &Card, b: &Card| a.confounded_with.contains(&b.name);
        match (self.effects.single(), other.effects.single()) {
            (Some(a), Some(b)) => a.name != b.name && (names(a, b) || names(b, a)),
            _ => false,
        }
    }

    /// Whether the analytic model may not see it at all: it does not know how fast wear takes weak waves of the profile away, nor the
    /// corners with which a tooth's neighbours touch where it stands back, nor anything across the face.
    pub(in crate::learn) fn may_be_unseen(&self) -> bool {
        self.is_free_shape() && self.without_wave.is_none()
            || self.acts_on_single_teeth()
            || self.acts_across_the_face()
    }

    /// Whether it is a sum of waves along the flank, which follows whatever is smooth there.
    pub(in crate::learn) fn is_free_shape(&self) -> bool {
        let mut cards = self.effects.cards().iter();
        !self.quarters.is_empty() && cards.all(|card| card.hook == Hook::Profile)
    }

    /// Whether it moves single teeth from their places alone.
    pub(in crate::learn) fn acts_on_single_teeth(&self) -> bool {
        let added = self.added();
        !added.is_empty() && added.iter().all(EffectSpec::acts_on_teeth)
    }

    /// Whether it acts through slices of the face alone.
    pub(in crate::learn) fn acts_across_the_face(&self) -> bool {
        let cards = self.effects.cards();
        !cards.is_empty() && cards.iter().all(|card| card.acts_across_the_face())
    }

    /// Whether it moves the gears to another centre distance.
    pub(in crate::learn) fn moves_the_centres(&self) -> bool {
        let mut added = self.added().iter();
        added.any(|effect| effect.hook() == Hook::Operation)
    }

    /// The added effects in their forms: behind those of the base model.
    fn added(&self) -> &[EffectSpec] {
        let all = self.version.effects.specs();
        &all[all.len() - self.effects.cards().len()..]
    }

    /// Whether it costs many times a section: slices of the face or classes of teeth.
    pub(in crate::learn) fn is_costly(&self) -> bool {
        self.acts_across_the_face() || self.acts_on_single_teeth()
    }

    /// Whether every added effect has its card's own form.
    pub(in crate::learn) fn is_own_form(&self) -> bool {
        self.forms.iter().all(Option::is_none)
    }

    /// Whether both add the same effects in the same forms.
    pub(in crate::learn) fn is_same_as(&self, other: &Self) -> bool {
        let name = |(card, form): (&Card, Option<&Form>)| (card.name, form.map(|form| form.name));
        self.added_forms()
            .map(name)
            .eq(other.added_forms().map(name))
    }

    /// Values of its parameters: the base model's own as they are, the added ones' prior medians.
    pub(in crate::learn) fn medians(&self) -> Vec<f64> {
        let free = self.version.free.iter();
        let free: Vec<&FreeParameter> = free.filter(|f| f.name != WEAR_COEFFICIENT).collect();
        let (own, added) = free.split_at(self.inherited);
        let added = added.iter().map(|f| median(f));
        own.iter().map(|f| f.value).chain(added).collect()
    }

    /// The values of the added parameters at which their effect does nothing, where there are such.
    pub(in crate::learn) fn neutrals(&self) -> impl Iterator<Item = Option<f64>> {
        let free = self.version.free.iter();
        let free = free.filter(|f| f.name != WEAR_COEFFICIENT);
        free.skip(self.inherited).map(|f| f.neutral)
    }

    /// What it says to be missing.
    pub(in crate::learn) fn hypothesis(&self) -> Hypothesis {
        if self.effects.is_empty() {
            Hypothesis::NothingMissing
        } else {
            Hypothesis::Effects(self.effects.clone())
        }
    }

    /// Its effects with their forms, None the card's own.
    pub(in crate::learn) fn added_forms(
        &self,
    ) -> impl Iterator<Item = (&'static Card, Option<&'static Form>)> {
        let cards = self.effects.cards().iter().copied();
        cards.zip(self.forms.iter().copied())
    }
}

/// The card's effect in its own form and every other accepted one that is fitted for itself.
fn forms(card: &'static Card, base: &Candidate, study: &Study) -> Vec<Candidate> {
    let others = card.forms.iter().filter(|form| form.grown.is_empty());
    let all = std::iter::once(None).chain(others.map(Some));
    all.filter_map(|form| {
        let (mut candidate, fitted) = of_form(card, form, base, study)?;
        candidate.starts = starts(&fitted, candidate.acts_across_the_face());
        let own = &candidate.parameters[base.inherited..];
        if let Some(phase) = phase(&fitted) {
            candidate.quarters = quarters(own, &fitted, phase);
        } else if fitted.len() > 1 && matches!(card.hook, Hook::WearFactor | Hook::Profile) {
            candidate.starts.extend(spread(own, &fitted, SPREAD));
        }
        Some(candidate)
    })
    .collect()
}

/// The card's effect in one of its forms, None the own one, without starts; and its fitted parameters. None: the study does not state
/// all that the form needs.
fn of_form(
    card: &'static Card,
    form: Option<&'static Form>,
    base: &Candidate,
    study: &Study,
) -> Option<(Candidate, Vec<FreeParameter>)> {
    // A form's settings lie in the ranges of its card: tests walk the catalogue.
    let [pinion, gear] = [&study.gears.pinion, &study.gears.gear].map(|gear| gear.spec.teeth);
    let accepted = |form: Option<&'static Form>| {
        if pinion == gear && form.is_some_and(|form| form.of_ratio) {
            return None;
        }
        let spec = EffectSpec::of_form(card, form, &[]).ok()?;
        study.suits(&spec).then_some(spec)
    };
    let spec = accepted(form)?;
    let all = std::iter::once(None).chain(card.forms.iter().map(Some));
    let siblings = all.filter_map(accepted).count();
    let fitted = spec.fitted();
    let version = base.version.with(spec);
    let candidate = Candidate {
        effects: EffectSet::new([card]),
        forms: vec![form],
        siblings,
        parameters: parameters(&version.free),
        inherited: base.inherited,
        version,
        starts: Vec::new(),
        quarters: Vec::new(),
        without_wave: None,
        strengths: (fitted.iter())
            .map(|f| (f.lower, f.upper, f.neutral.filter(|none| none.is_finite())))
            .collect(),
    };
    Some((candidate, fitted))
}

fn parameters(free: &[FreeParameter]) -> Vec<Parameter> {
    free.iter()
        .filter(|free| free.name != WEAR_COEFFICIENT)
        .map(parameter)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{ProfileAt, find};
    use crate::gear::Member;

    /// A form that needs what the study does not state takes no part of its effect's prior.
    #[test]
    fn forms_that_a_study_cannot_have_take_no_prior() {
        let text = include_str!("../../../validation/paper/study.toml");
        let study = Study::parse(text, "study.toml").unwrap();
        let own = EffectSet::new([find("micropitting").unwrap()]);
        let siblings = |study: &Study| {
            let (singles, _) = Candidate::singles(study);
            let own = singles.into_iter().find(|c| c.effects == own);
            own.unwrap().siblings
        };
        let all = 1 + find("micropitting").unwrap().forms.len();
        assert!(!study.states("lubricant.viscosity"));
        assert_eq!(siblings(&study), all - 1);
        let oil = "\n[lubricant]\nviscosity = 0.015\npressure_viscosity = 18.0\nroughness = 0.5\n";
        let oiled = Study::parse(&format!("{text}{oil}"), "study.toml").unwrap();
        assert_eq!(siblings(&oiled), all);
    }

    /// Contacts of the gear are those of the pinion where both have as many teeth.
    #[test]
    fn a_form_that_the_ratio_alone_makes_is_none_of_equal_gears() {
        let text = include_str!("../../../validation/paper/study.toml");
        let card = find("running_in").unwrap();
        let forms = |text: &str| {
            let study = Study::parse(text, "study.toml").unwrap();
            let (singles, _) = Candidate::singles(&study);
            let own = singles
                .iter()
                .filter(|c| c.effects == EffectSet::new([card]));
            own.map(|c| c.siblings).collect::<Vec<_>>()
        };
        let all = 1 + card.forms.len();
        assert_eq!(forms(text), vec![all; all]);
        let equal = text
            .replace("teeth = 27\n", "teeth = 40\n")
            .replace("teeth = 53\n", "teeth = 40\n");
        assert_eq!(forms(&equal), vec![all - 1; all - 1]);
    }

    /// u cos θ − v sin θ is the wave that `turned` makes of cos θ and cos(θ + π/2).
    #[test]
    fn a_turned_wave_is_the_sum_of_its_two_quarters() {
        let text = include_str!("../../../validation/paper/study.toml");
        let study = Study::parse(text, "study.toml").unwrap();
        let (singles, _) = Candidate::singles(&study);
        let card = find("profile_form").unwrap();
        let candidate = singles
            .iter()
            .find(|c| c.effects == EffectSet::new([card]))
            .unwrap();
        assert!(candidate.may_be_unseen());
        let profile = |own: &[f64], along: f64| {
            let mut values = card.defaults();
            values[..own.len()].copy_from_slice(own);
            let at = ProfileAt {
                member: Member::Pinion,
                along,
                radius: 27.0,
                path: 0.0,
                from_tip: 1.0,
            };
            (card.build)(&values).profile(&at)
        };
        for [first, second] in &candidate.quarters {
            for shares in [[2.0, -3.0], [-1.5, 0.5], [0.0, 4.0]] {
                let turned = candidate.turned(first, shares);
                for along in [0.0, 0.13, 0.4, 0.77, 1.0] {
                    let sum =
                        shares[0] * profile(first, along) + shares[1] * profile(second, along);
                    let off = profile(&turned, along) - sum;
                    assert!(off.abs() < 1e-12, "{turned:?} {along} {off}");
                }
            }
        }
    }
}
