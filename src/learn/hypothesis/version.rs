//! A model as a fit takes it: its effects, and what is free in them.

use crate::learn::hypothesis::parameters::Parameter;
use crate::study::{EffectModel, EffectSpec, FreeParameter, Study, WEAR_COEFFICIENT};

/// One version of a model: its effects, and what of it a fit may adjust.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelVersion {
    /// The effects.
    pub effects: EffectModel,
    /// Free parameters, the wear coefficient among them or not.
    pub free: Vec<FreeParameter>,
}

impl ModelVersion {
    /// The study's own.
    pub fn of(study: &Study) -> Self {
        Self {
            effects: study.effect_model().clone(),
            free: study.free().to_vec(),
        }
    }

    /// The same with one more effect, whose fitted parameters are free, and with the wear coefficient free.
    pub fn with(&self, effect: EffectSpec) -> Self {
        let mut free = self.free.clone();
        free.extend(effect.fitted());
        Self {
            effects: self.effects.with(effect),
            free,
        }
    }

    /// The same with the free parameters of an effect beginning at other values, by the parameters' names, and with them the wear coefficient;
    /// others stay as they are.
    pub fn beginning_at<'v>(
        mut self,
        effect: &str,
        values: impl IntoIterator<Item = (&'v str, f64)>,
    ) -> Self {
        for (name, value) in values {
            let own = |free: &&mut FreeParameter| {
                free.name.strip_prefix(effect) == Some(&format!(".{name}")[..])
                    || (name == WEAR_COEFFICIENT && free.name == name)
            };
            if let Some(free) = self.free.iter_mut().find(own) {
                free.value = value.clamp(free.lower, free.upper);
            }
        }
        self
    }

    /// Whether a fit would begin at values that somebody has chosen or fitted, not at those of the catalogue.
    pub(in crate::learn) fn is_chosen(&self) -> bool {
        let specs = self.effects.specs();
        let own = |spec: &EffectSpec| spec.fitted().into_iter();
        let stated = specs.iter().flat_map(own).map(|free| free.value);
        let begins = self.free_of_effects().map(|free| free.value);
        specs.iter().any(EffectSpec::is_set) || !stated.eq(begins)
    }

    /// The free parameters but k.
    pub(in crate::learn) fn free_of_effects(&self) -> impl Iterator<Item = &FreeParameter> {
        let free = self.free.iter();
        free.filter(|free| free.name != WEAR_COEFFICIENT)
    }

    /// Those of the effect that joined last.
    pub(in crate::learn) fn of_last(&self) -> impl Iterator<Item = &FreeParameter> {
        let last = self.free_of_effects().last().map(effect);
        (self.free_of_effects()).filter(move |free| Some(effect(free)) == last)
    }

    /// The version's own values of its free parameters but k.
    pub(in crate::learn) fn own_values(&self) -> Vec<f64> {
        self.free_of_effects().map(|free| free.value).collect()
    }

    /// The priors' medians of the same.
    pub(in crate::learn) fn medians(&self) -> Vec<f64> {
        self.free_of_effects()
            .map(|free| free.prior.median().clamp(free.lower, free.upper))
            .collect()
    }
}

fn effect(free: &FreeParameter) -> &str {
    free.name.split('.').next().unwrap_or_default()
}

/// A free parameter of a study as a fit takes it.
pub(in crate::learn) fn parameter(free: &FreeParameter) -> Parameter {
    Parameter {
        name: free.name.clone(),
        unit: free.unit.to_owned(),
        start: free.value,
        lower: free.lower,
        upper: free.upper,
        prior: free.prior,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::find;

    /// Only the effect's own parameters begin elsewhere, and never beyond their bounds.
    #[test]
    fn a_version_begins_at_other_values_of_its_effect() {
        let none = ModelVersion {
            effects: EffectModel::default(),
            free: Vec::new(),
        };
        let spec = |name: &str| EffectSpec::of_card(find(name).unwrap(), &[]).unwrap();
        let version = none.with(spec("running_in")).with(spec("coating"));
        let found = [("amplitude", 1e9), ("decay_cycles", 2e5), ("ratio", 0.3)];
        let moved = version.clone().beginning_at("running_in", found);
        for (before, after) in version.free.iter().zip(&moved.free) {
            let wanted = match after.name.as_str() {
                "running_in.amplitude" => after.upper,
                "running_in.decay_cycles" => 2e5,
                _ => before.value,
            };
            assert_eq!(after.value, wanted, "{}", after.name);
            assert_eq!(before.prior, after.prior);
        }
    }
}
