//! The effects of a study, ready to be built with any values of their parameters.

use std::fmt;
use std::ops::Range;

use super::free::FreeParameter;
use super::learned::LearnedLaw;
use crate::effects::formula::Formula;
use crate::effects::{self, Card, Combined, EffectError, Form, Hook, Param, Prior};

/// The effects of a model in their order. Formulas are read once; [`EffectModel::build`] only binds numbers, so a fit may call
/// it as often as it likes.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct EffectModel {
    specs: Vec<EffectSpec>,
}

/// One effect of a study: a card of the catalogue or the user's formula, with all its parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct EffectSpec {
    /// Name in the catalogue, `formula` or `learned`.
    pub kind: String,
    /// The name before the point in parameters' names: the kind, a formula's own name, or `learned:DRIVER` (with `:MEMBER`).
    pub name: String,
    /// What it computes.
    pub law: Law,
    /// All parameters in the order in which the law takes their values.
    pub parameters: Vec<Parameter>,
    /// Where the entry stands, bytes of the study's text; empty for an effect that stands in no study.
    pub span: Range<usize>,
    /// Short names of parameters that a fit adjusts although their card fixes them.
    pub freed: &'static [&'static str],
    /// Short names of parameters that a fit leaves alone although their card says otherwise.
    pub idle: &'static [&'static str],
    /// Short names of parameters that a fit keeps above their value without effect, as below it they do the same.
    pub even: &'static [&'static str],
}

/// What an effect computes.
#[derive(Debug, Clone)]
pub enum Law {
    /// One of the catalogue.
    Card(&'static Card),
    /// The user's own.
    Formula {
        /// As read.
        formula: Formula,
        /// As written.
        expression: String,
    },
    /// A curve through knots.
    Learned(LearnedLaw),
}

/// One parameter of an effect in a study.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// `kind.parameter`, or `name.parameter` of a formula.
    pub name: String,
    /// The study's value, else the card's default.
    pub value: f64,
    /// Bounds that the study states.
    pub bounds: [Option<f64>; 2],
    /// What the catalogue says of it; nothing for a formula's.
    pub card: Option<&'static Param>,
    /// Whether the study states it.
    pub stated: bool,
}

/// Variables that tell the time.
const CLOCKS: &[&str] = &[
    "cycles",
    "contacts",
    "hours",
    "contact_hours",
    "slid_distance",
];

/// Variables that oil and heat fill in.
const SURROUNDINGS: &[&str] = &[
    "film_ratio",
    "friction",
    "flash_temperature",
    "bulk_temperature",
];

impl EffectModel {
    /// Of effects in the order in which they act.
    pub fn new(specs: Vec<EffectSpec>) -> Self {
        Self { specs }
    }

    /// The effects.
    pub fn specs(&self) -> &[EffectSpec] {
        &self.specs
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.specs.is_empty()
    }

    /// Whether an effect of this name is there.
    pub fn has(&self, name: &str) -> bool {
        self.specs.iter().any(|spec| spec.name == name)
    }

    /// The same effects and one more.
    pub fn with(&self, spec: EffectSpec) -> Self {
        let mut specs = self.specs.clone();
        specs.push(spec);
        Self { specs }
    }

    /// The effects bound to their values: what `values` gives for a parameter's name (`running_in.amplitude`), else the
    /// study's. The values are not checked against the ranges.
    pub fn build(&self, values: &dyn Fn(&str) -> Option<f64>) -> Combined {
        let mut combined = Combined::default();
        for spec in &self.specs {
            let numbers: Vec<f64> = spec
                .parameters
                .iter()
                .map(|parameter| values(&parameter.name).unwrap_or(parameter.value))
                .collect();
            match &spec.law {
                Law::Card(card) => combined.push(card.hook, (card.build)(&numbers)),
                Law::Formula { formula, .. } => {
                    combined.push(formula.hook(), formula.build(&numbers));
                }
                Law::Learned(learned) => {
                    let values = learned.values_at(&numbers);
                    combined.push(learned.law.hook(), learned.law.build(values));
                }
            }
        }
        if !self.specs.iter().any(|spec| speaks_of(spec, SURROUNDINGS)) {
            combined.ignore_surroundings();
        }
        combined
    }

    /// The effects bound to the study's values.
    pub fn stated(&self) -> Combined {
        self.build(&|_| None)
    }

    /// Whether the wear coefficient only stretches time: every effect multiplies the wear or the load and none has a clock.
    pub fn stretches_time(&self) -> bool {
        self.specs
            .iter()
            .all(|spec| spec.hook() != Hook::AddedDepth && !speaks_of(spec, CLOCKS))
    }

    /// The learned law of this name (`learned:cycles`).
    pub fn learned(&self, name: &str) -> Option<&EffectSpec> {
        let learned = |spec: &&EffectSpec| matches!(spec.law, Law::Learned(_));
        self.specs
            .iter()
            .filter(learned)
            .find(|spec| spec.name == name)
    }

    /// The parameter of this name (`running_in.amplitude`).
    pub fn parameter(&self, name: &str) -> Option<&Parameter> {
        self.parameters().find(|parameter| parameter.name == name)
    }

    /// What the effect of a free parameter needs of the study once a fit moves that parameter.
    pub(super) fn needs_with(&self, free: &FreeParameter) -> Vec<&'static str> {
        let concerned = |spec: &&EffectSpec| spec.parameters.iter().any(|p| p.name == free.name);
        let Some(spec) = self.specs.iter().find(concerned) else {
            return Vec::new();
        };
        let mut moved = spec.clone();
        for parameter in &mut moved.parameters {
            if parameter.name == free.name {
                parameter.value = free.value;
            }
        }
        moved.needs()
    }

    /// All parameters.
    pub fn parameters(&self) -> impl Iterator<Item = &Parameter> {
        self.specs.iter().flat_map(|spec| &spec.parameters)
    }
}

/// `running_in(amplitude = 3, decay_cycles = 200000)`, with the parameters that the study states.
impl fmt::Display for EffectSpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Law::Learned(learned) = &self.law {
            return write!(f, "{}({} knots)", self.name, learned.values.len());
        }
        let stated = self.parameters.iter().filter(|p| p.stated);
        let values: Vec<String> = stated
            .map(|p| format!("{} = {}", p.short(), p.value))
            .collect();
        write!(f, "{}({})", self.name, values.join(", "))
    }
}

/// Whether the law of `spec` has one of these variables in it.
fn speaks_of(spec: &EffectSpec, variables: &[&str]) -> bool {
    let expression = match &spec.law {
        Law::Card(card) => card.expression(),
        Law::Formula { expression, .. } => expression.as_str(),
        Law::Learned(learned) => learned.law.driver().name,
    };
    let mut words = expression.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
    words.any(|word| variables.contains(&word))
}

impl EffectSpec {
    /// An effect of the catalogue that stands in no study, with some values stated.
    ///
    /// # Errors
    /// [`EffectError`] if a name is unknown or a value not allowed.
    pub fn of_card(card: &'static Card, stated: &[(&str, f64)]) -> Result<Self, EffectError> {
        let values = card.values(stated)?;
        let parameters = card
            .params
            .iter()
            .zip(values)
            .map(|(param, value)| Parameter {
                name: format!("{}.{}", card.name, param.name),
                value,
                bounds: [None; 2],
                card: Some(param),
                stated: stated.iter().any(|(name, _)| *name == param.name),
            });
        Ok(Self {
            kind: card.name.to_owned(),
            name: card.name.to_owned(),
            law: Law::Card(card),
            parameters: parameters.collect(),
            span: 0..0,
            freed: &[],
            idle: &[],
            even: &[],
        })
    }

    /// The same in one of its forms, None the own one; stated values go before the form's.
    ///
    /// # Errors
    /// As [`EffectSpec::of_card`].
    pub fn of_form(
        card: &'static Card,
        form: Option<&'static Form>,
        stated: &[(&str, f64)],
    ) -> Result<Self, EffectError> {
        let Some(form) = form else {
            return Self::of_card(card, stated);
        };
        let is_stated = |name: &str| stated.iter().any(|(stated, _)| *stated == name);
        let settings = form.settings.iter().filter(|(name, _)| !is_stated(name));
        let all: Vec<(&str, f64)> = stated.iter().chain(settings).copied().collect();
        Ok(Self {
            freed: form.frees,
            idle: form.idle,
            even: form.even,
            ..Self::of_card(card, &all)?
        })
    }

    /// The parameters that a fit adjusts unless told otherwise: those the card says, all of a formula.
    pub fn fitted(&self) -> Vec<FreeParameter> {
        self.parameters
            .iter()
            .filter(|parameter| {
                (parameter.card).is_none_or(|card| {
                    let fitted = card.fitted || self.freed.contains(&card.name);
                    fitted && !self.idle.contains(&card.name)
                })
            })
            .map(|parameter| {
                let free = parameter.free();
                let even = (parameter.card).is_some_and(|card| self.even.contains(&card.name));
                match free.neutral.filter(|_| even) {
                    Some(neutral) => FreeParameter {
                        lower: neutral,
                        value: free.value.max(neutral),
                        ..free
                    },
                    None => free,
                }
            })
            .collect()
    }

    /// Whether a parameter that a fit adjusts has another value than the catalogue gives it; true of laws that are not from the catalogue.
    pub fn is_set(&self) -> bool {
        let Law::Card(card) = &self.law else {
            return true;
        };
        let fitted = |name: &str| self.fitted().iter().any(|free| free.name == name);
        let Ok(plain) = Self::of_card(card, &[]) else {
            return true;
        };
        let mut both = self.parameters.iter().zip(&plain.parameters);
        both.any(|(own, plain)| own.value != plain.value && fitted(&own.name))
    }

    /// Whether it lets teeth of a member differ.
    pub fn acts_on_teeth(&self) -> bool {
        self.hook() == effects::Hook::ToothOffset
    }

    /// Where it acts with its values.
    pub fn hook(&self) -> effects::Hook {
        match &self.law {
            Law::Card(card) => {
                let values: Vec<f64> = self.parameters.iter().map(|p| p.value).collect();
                card.hook_at(&values)
            }
            Law::Formula { formula, .. } => formula.hook(),
            Law::Learned(learned) => learned.law.hook(),
        }
    }

    /// Whether it acts through slices of the face.
    pub fn acts_across_the_face(&self) -> bool {
        matches!(&self.law, Law::Card(card) if card.acts_across_the_face())
    }

    /// Keys of the study's optional tables without which it cannot act with these values.
    pub fn needs(&self) -> Vec<&'static str> {
        match &self.law {
            Law::Formula { formula, .. } => formula.needs(),
            Law::Learned(learned) => learned.law.driver().needs.to_vec(),
            Law::Card(card) => {
                let mut needs = card.needs.to_vec();
                // the film matters below a finite limit only
                let limit = self
                    .parameters
                    .iter()
                    .find(|p| p.name.ends_with(".lambda_c"));
                if limit.is_some_and(|limit| limit.value.is_finite())
                    && let Some(film) = effects::variables::find("film_ratio")
                {
                    needs.extend(film.needs);
                }
                needs
            }
        }
    }
}

impl Parameter {
    /// As a fit sees it.
    pub fn free(&self) -> FreeParameter {
        match self.card {
            Some(param) => FreeParameter::of_card(self, param),
            None => FreeParameter::of_formula(self),
        }
    }

    /// The name after the point.
    pub fn short(&self) -> &str {
        self.name.rsplit('.').next().unwrap_or(&self.name)
    }

    /// Its unit, `-` if it has none or nobody knows.
    pub fn unit(&self) -> &'static str {
        self.card.map_or("-", |param| param.unit)
    }

    /// Its prior.
    pub fn prior(&self) -> Prior {
        self.free().prior
    }
}

impl PartialEq for Law {
    /// Formulas are compared as written.
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Law::Card(a), Law::Card(b)) => a.name == b.name,
            (
                Law::Formula {
                    formula: a,
                    expression: text,
                },
                Law::Formula {
                    formula: b,
                    expression: other,
                },
            ) => a.hook() == b.hook() && text == other,
            (Law::Learned(a), Law::Learned(b)) => a == b,
            _ => false,
        }
    }
}
