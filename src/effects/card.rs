//! A card tells all there is to know about one effect of the catalogue: to a person, to the study reader and to a fit.

use super::effect::{Effect, FaceAt, Hook};
use super::error::EffectError;
use super::formula::{Formula, FormulaError};
use super::prior::Prior;
use super::variables;

/// One effect of the catalogue.
#[derive(Debug)]
pub struct Card {
    /// Name in study files and results.
    pub name: &'static str,
    /// Through which hook it acts, unless its values say another ([`Card::hook_at`]).
    pub hook: Hook,
    /// `hook = expression`, in the parameters below and the named variables of a user's formula.
    pub formula: &'static str,
    /// Where the formula comes from, and what of it could not be checked.
    pub source: &'static str,
    /// How it shows in measurements; the part before the first semicolon stands in the overview.
    pub signature: &'static str,
    /// Effects of the catalogue that leave a like mark.
    pub confounded_with: &'static [&'static str],
    /// What tells it from those.
    pub separated_by: &'static str,
    /// What a full treatment would have and this one leaves out: where it acts by a shortcut.
    pub left_out: &'static str,
    /// Keys of the study's optional tables without which it cannot act.
    pub needs: &'static [&'static str],
    /// Parameters, in the order in which [`Card::build`] takes their values.
    pub params: &'static [Param],
    /// Accepted forms besides the default one: settings of parameters that a fit leaves alone.
    pub forms: &'static [Form],
    /// The effect with its parameters' values.
    pub build: fn(&[f64]) -> Box<dyn Effect>,
}

/// One parameter of an effect.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Param {
    /// Name in study files and results.
    pub name: &'static str,
    /// Unit, `-` if it has none.
    pub unit: &'static str,
    /// What it is.
    pub meaning: &'static str,
    /// Value where the study states none.
    pub default: f64,
    /// Smallest and largest value allowed.
    pub range: (f64, f64),
    /// Its prior.
    pub prior: Prior,
    /// The value at which the effect does nothing; it may lie outside the range. With every such parameter at its neutral
    /// value all hooks are neutral to the last bit.
    pub neutral: Option<f64>,
    /// Whether a fit adjusts it by default.
    pub fitted: bool,
    /// What a fit has to know of it beside its value.
    pub role: ParamRole,
}

/// What a parameter is to a fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParamRole {
    /// Nothing in particular.
    Plain,
    /// The phase of a wave, rad: a wave of any phase is a sum of two a quarter of a wave apart.
    WavePhase,
    /// A power of the local pressure, or one at which the effect sets in: the rate is sharp in what the analytic contact knows least.
    PressureSharpness,
    /// One part of a smooth function, of many: it has no valleys of its own that a fit had to look for.
    SmoothPart,
    /// What the effect's dependence on speed is known by: measurements that determine none of these show a pattern that another cause
    /// could make as well.
    IdentifyingSpeed,
    /// What it does concerns the measured tooth of a member alone.
    MeasuredTooth,
}

/// Another accepted form of an effect's law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Form {
    /// Name.
    pub name: &'static str,
    /// The parameters that differ from their defaults.
    pub settings: &'static [(&'static str, f64)],
    /// Parameters that a fit adjusts in this form although the card fixes them.
    pub frees: &'static [&'static str],
    /// Parameters that it does not use, which a fit leaves alone although the card says otherwise.
    pub idle: &'static [&'static str],
    /// Parameters of which both signs do the same in this form: a fit keeps to the side above the value without effect.
    pub even: &'static [&'static str],
    /// Values of those that it frees, which stand behind all that the own form fits, each a place from which this form is tried beside what the
    /// own one was fitted to; a wave among them is brought to the amplitude and phase that serve best. None: it is fitted for itself.
    pub grown: &'static [&'static [f64]],
    /// Whether it differs from the own form only where the members have other numbers of teeth.
    pub of_ratio: bool,
    /// What it does to the wear where that is not what the card says; empty: the card's.
    pub signature: &'static str,
}

impl Form {
    /// One that changes nothing, to be built upon.
    pub(super) const PLAIN: Form = Form {
        name: "",
        settings: &[],
        frees: &[],
        idle: &[],
        even: &[],
        grown: &[],
        of_ratio: false,
        signature: "",
    };
}

impl Param {
    /// A fitted parameter without a neutral value.
    pub(super) const fn new(
        name: &'static str,
        unit: &'static str,
        meaning: &'static str,
        default: f64,
        range: (f64, f64),
        prior: Prior,
    ) -> Self {
        Self {
            name,
            unit,
            meaning,
            default,
            range,
            prior,
            neutral: None,
            fitted: true,
            role: ParamRole::Plain,
        }
    }

    /// From 0, one way of a law, to 1, another; left alone by fits.
    pub(super) const fn either(name: &'static str, meaning: &'static str) -> Self {
        let prior = Prior::Uniform {
            low: 0.0,
            high: 1.0,
        };
        Self::new(name, "-", meaning, 0.0, (0.0, 1.0), prior).fixed()
    }

    /// Neutral at `value`.
    pub(super) const fn neutral(mut self, value: f64) -> Self {
        self.neutral = Some(value);
        self
    }

    /// Left alone by fits: a reference, or a choice of form.
    pub(super) const fn fixed(mut self) -> Self {
        self.fitted = false;
        self
    }

    /// What it is to a fit.
    pub(super) const fn role(mut self, role: ParamRole) -> Self {
        self.role = role;
        self
    }

    /// Whether a study may state `value`.
    pub fn accepts(&self, value: f64) -> bool {
        (self.range.0..=self.range.1).contains(&value) || self.neutral == Some(value)
    }
}

/// Variables that say how far a test has gone, the same for all points of a flank.
const TIMES: [&str; 4] = ["cycles", "contacts", "hours", "worn_volume"];

impl Card {
    /// Whether it changes k alone, and over the time alone: alike at every place and in every condition.
    pub fn changes_k_over_time_alone(&self) -> bool {
        let words = self
            .formula
            .split(|c: char| !c.is_alphanumeric() && c != '_');
        let mut used = words
            .filter(|word| variables::find(word).is_some())
            .peekable();
        self.hook == Hook::WearFactor
            && used.peek().is_some()
            && used.all(|variable| TIMES.contains(&variable))
    }

    /// Whether it acts through slices of the face.
    pub fn acts_across_the_face(&self) -> bool {
        let end = FaceAt {
            place: 1.0,
            width: 1.0,
            normal_force: 1.0,
        };
        (self.build)(&self.defaults()).lead(&end).is_some()
    }

    /// The default values.
    pub fn defaults(&self) -> Vec<f64> {
        self.params.iter().map(|param| param.default).collect()
    }

    /// Whether it is a wave along the flank with a phase of its own, of the profile or of the load: what follows anything smooth that differs along it.
    pub fn is_wave_along_flank(&self) -> bool {
        matches!(self.hook, Hook::Profile | Hook::LoadFactor) && self.has(ParamRole::WavePhase)
    }

    /// Whether one of its parameters has a role.
    pub fn has(&self, role: ParamRole) -> bool {
        self.params.iter().any(|param| param.role == role)
    }

    /// The defaults with every parameter that has a neutral value set to it.
    pub fn neutral(&self) -> Vec<f64> {
        self.params
            .iter()
            .map(|param| param.neutral.unwrap_or(param.default))
            .collect()
    }

    /// Through which hook it acts with these values.
    pub fn hook_at(&self, values: &[f64]) -> Hook {
        (self.build)(values).acts_through().unwrap_or(self.hook)
    }

    /// The defaults with `stated` ones replaced.
    ///
    /// # Errors
    /// [`EffectError`] if a name is unknown or a value not allowed.
    pub fn values(&self, stated: &[(&str, f64)]) -> Result<Vec<f64>, EffectError> {
        let mut values = self.defaults();
        for &(name, value) in stated {
            let place = self.place(name)?;
            let param = &self.params[place];
            if !param.accepts(value) {
                return Err(EffectError::OutOfRange {
                    effect: self.name.to_owned(),
                    parameter: param.name,
                    unit: param.unit,
                    value,
                    least: param.range.0,
                    most: param.range.1,
                });
            }
            values[place] = value;
        }
        Ok(values)
    }

    /// The place of a parameter among [`Card::params`].
    ///
    /// # Errors
    /// [`EffectError::UnknownParameter`] with the nearest name.
    pub fn place(&self, name: &str) -> Result<usize, EffectError> {
        self.params
            .iter()
            .position(|param| param.name == name)
            .ok_or_else(|| EffectError::UnknownParameter {
                effect: self.name.to_owned(),
                parameter: name.to_owned(),
                nearest: super::error::nearest(name, self.params.iter().map(|param| param.name))
                    .unwrap_or_default()
                    .to_owned(),
            })
    }

    /// The expression of the formula, right of the equals sign.
    pub fn expression(&self) -> &'static str {
        self.formula
            .split_once(" = ")
            .map_or(self.formula, |(_, expression)| expression)
    }

    /// The printed formula, compiled, and the places of the parameters it takes (those of other forms do not stand in it).
    ///
    /// # Errors
    /// [`FormulaError`] if the card's own formula is at fault.
    pub fn compiled(&self) -> Result<(Formula, Vec<usize>), FormulaError> {
        let words: Vec<&str> = self
            .expression()
            .split(|c: char| !c.is_ascii_alphanumeric() && c != '_')
            .collect();
        let places: Vec<usize> = (0..self.params.len())
            .filter(|&place| words.contains(&self.params[place].name))
            .collect();
        let names: Vec<&str> = places.iter().map(|&at| self.params[at].name).collect();
        let formula = Formula::of_card(self.hook, self.expression(), &names)?;
        Ok((formula, places))
    }
}
