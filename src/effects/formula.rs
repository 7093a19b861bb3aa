//! A user's own effect: an expression in named variables for one of four hooks. It can compute, nothing else.

use std::sync::{Arc, OnceLock};

use super::effect::{Effect, Hook};
use super::error::nearest;
use super::expression::Expression;
pub use super::expression::{ExpressionError, FUNCTIONS};
use super::local::{Local, ProfileAt};
use super::variables::{self, VARIABLES, Variable};

/// Most names an expression may use.
pub const MOST_NAMES: usize = 64;

/// A formula that has been read, without values for its parameters.
#[derive(Debug, Clone)]
pub struct Formula {
    inner: Arc<Inner>,
}

#[derive(Debug)]
struct Inner {
    hook: Hook,
    text: String,
    expression: Expression,
    slots: Vec<Slot>,
    parameters: usize,
}

/// Where the value of a name comes from.
#[derive(Debug, Clone, Copy)]
enum Slot {
    Parameter(usize),
    Variable(&'static Variable),
}

/// Why a formula cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FormulaError {
    /// The expression is at fault.
    #[error("{0}")]
    Expression(#[from] ExpressionError),
    /// The hook takes no expression.
    #[error("a formula cannot give {hook}, only wear_factor, added_depth, load_factor or profile")]
    Hook {
        /// The hook's name.
        hook: &'static str,
    },
    /// A parameter has a name that is taken, or no name.
    #[error("a parameter cannot be called `{name}`: {reason}")]
    Name {
        /// The name.
        name: String,
        /// Why not.
        reason: &'static str,
    },
    /// A parameter that the expression does not use.
    #[error("the expression does not use the parameter `{name}`")]
    Unused {
        /// The parameter.
        name: String,
    },
    /// More names than can be handed over.
    #[error("the expression uses {count} names, at most {MOST_NAMES} are possible")]
    TooMany {
        /// How many.
        count: usize,
    },
}

impl Formula {
    /// Reads `text` as the value of `hook`, with its own `parameters` besides the named variables.
    ///
    /// # Errors
    /// [`FormulaError`], with the place in the expression where there is one.
    pub fn new(hook: Hook, text: &str, parameters: &[&str]) -> Result<Self, FormulaError> {
        if !matches!(
            hook,
            Hook::WearFactor | Hook::AddedDepth | Hook::LoadFactor | Hook::Profile
        ) {
            return Err(FormulaError::Hook { hook: hook.name() });
        }
        Self::of_card(hook, text, parameters)
    }

    /// As [`Formula::new`], also for the hooks of operation and friction, whose formulas stand on cards only.
    pub(super) fn of_card(
        hook: Hook,
        text: &str,
        parameters: &[&str],
    ) -> Result<Self, FormulaError> {
        for (place, name) in parameters.iter().enumerate() {
            check_name(name, &parameters[..place])?;
        }
        let expression = Expression::parse(text, &|name| known(name, hook, parameters))?;
        let names = expression.names();
        if names.len() > MOST_NAMES {
            return Err(FormulaError::TooMany { count: names.len() });
        }
        if let Some(name) = parameters
            .iter()
            .find(|name| !names.iter().any(|used| used == *name))
        {
            return Err(FormulaError::Unused {
                name: (*name).to_owned(),
            });
        }
        let slots = names
            .iter()
            .filter_map(
                |name| match parameters.iter().position(|parameter| parameter == name) {
                    Some(place) => Some(Slot::Parameter(place)),
                    None => variables::find(name).map(Slot::Variable),
                },
            )
            .collect();
        Ok(Self {
            inner: Arc::new(Inner {
                hook,
                text: text.to_owned(),
                expression,
                slots,
                parameters: parameters.len(),
            }),
        })
    }

    /// What it gives.
    pub fn hook(&self) -> Hook {
        self.inner.hook
    }

    /// The variables it uses.
    pub fn variables(&self) -> impl Iterator<Item = &'static Variable> {
        self.inner.slots.iter().filter_map(|slot| match slot {
            Slot::Variable(variable) => Some(*variable),
            Slot::Parameter(_) => None,
        })
    }

    /// Keys of the study's optional tables without which its variables are not known, each once.
    pub fn needs(&self) -> Vec<&'static str> {
        let mut needs: Vec<&str> = self
            .variables()
            .flat_map(|variable| variable.needs)
            .copied()
            .collect();
        needs.sort_unstable();
        needs.dedup();
        needs
    }

    /// The effect with values for the parameters, in the order in which they were named.
    ///
    /// # Panics
    /// If the number of values is not that of the parameters.
    pub fn build(&self, values: &[f64]) -> Box<dyn Effect> {
        Box::new(self.bound(values))
    }

    /// What is wrong with the formula at these values everywhere, if it uses no variable; None if it uses one, or if all is well.
    ///
    /// # Panics
    /// As [`Formula::build`].
    pub fn constant_fault(&self, values: &[f64]) -> Option<String> {
        if self.variables().next().is_some() {
            return None;
        }
        let bound = self.bound(values);
        bound.value(self.inner.hook, |_| 0.0);
        bound.fault()
    }

    fn bound(&self, values: &[f64]) -> Bound {
        assert_eq!(
            values.len(),
            self.inner.parameters,
            "one value for each parameter"
        );
        Bound {
            inner: Arc::clone(&self.inner),
            values: values.to_vec(),
            fault: OnceLock::new(),
        }
    }
}

fn check_name(name: &str, before: &[&str]) -> Result<(), FormulaError> {
    let taken = FUNCTIONS.iter().any(|(function, ..)| *function == name) || name == "pi";
    let first = name.chars().next().unwrap_or('0');
    let reason =
        if !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') || first.is_ascii_digit() {
            "names are letters, digits and _, a letter or _ first"
        } else if variables::find(name).is_some() {
            "that is one of the variables"
        } else if taken {
            "that is a function or constant"
        } else if before.contains(&name) {
            "it stands there twice"
        } else {
            return Ok(());
        };
    Err(FormulaError::Name {
        name: name.to_owned(),
        reason,
    })
}

fn known(name: &str, hook: Hook, parameters: &[&str]) -> Result<(), String> {
    let variable = variables::find(name);
    if parameters.contains(&name) || variable.is_some_and(|v| v.available(hook)) {
        return Ok(());
    }
    let hook_name = hook.name();
    if variable.is_some() {
        let why = match hook {
            Hook::LoadFactor | Hook::Friction => {
                "it is asked before the contact is solved, for both flanks at once"
            }
            _ => "it is asked once, where no such thing exists",
        };
        return Err(format!("{hook_name} cannot use `{name}`: {why}"));
    }
    let available = VARIABLES
        .iter()
        .filter(|v| v.available(hook))
        .map(|v| v.name);
    let near = nearest(name, parameters.iter().copied().chain(available)).unwrap_or_default();
    Err(format!(
        "`{name}` is neither a parameter nor a variable; the nearest is `{near}`"
    ))
}

/// A formula with its parameters' values.
struct Bound {
    inner: Arc<Inner>,
    values: Vec<f64>,
    fault: OnceLock<String>,
}

impl Bound {
    /// The expression's value, or the hook's neutral one and a fault if it is not allowed there.
    fn value(&self, hook: Hook, read: impl Fn(&Variable) -> f64) -> f64 {
        if hook != self.inner.hook {
            return hook.neutral();
        }
        let mut values = [0.0; MOST_NAMES];
        let count = self.inner.slots.len();
        for (value, slot) in values.iter_mut().zip(&self.inner.slots) {
            *value = match slot {
                Slot::Parameter(place) => self.values[*place],
                Slot::Variable(variable) => read(variable),
            };
        }
        let value = self.inner.expression.evaluate(&values[..count]);
        let allowed = value.is_finite()
            && match hook {
                Hook::WearFactor | Hook::AddedDepth | Hook::Friction => value >= 0.0,
                Hook::LoadFactor => value > 0.0,
                _ => true,
            };
        if allowed {
            return value;
        }
        self.fault.get_or_init(|| {
            let names = self.inner.expression.names().iter();
            let at: Vec<String> = names
                .zip(&values)
                .map(|(name, value)| format!("{name} = {value}"))
                .collect();
            let allowed = match hook {
                Hook::WearFactor | Hook::AddedDepth | Hook::Friction => {
                    "allowed: a number from 0 on"
                }
                Hook::LoadFactor => "allowed: a number above 0",
                _ => "allowed: a finite number",
            };
            let place = if at.is_empty() {
                String::new()
            } else {
                format!(" at {}", at.join(", "))
            };
            let (hook, text) = (hook.name(), &self.inner.text);
            format!("{hook} = {text} gives {value}{place}; {allowed}")
        });
        hook.neutral()
    }
}

impl Effect for Bound {
    fn wear_factor(&self, at: &Local) -> f64 {
        self.value(Hook::WearFactor, |variable| variable.at(at))
    }

    fn added_depth(&self, at: &Local) -> f64 {
        self.value(Hook::AddedDepth, |variable| variable.at(at))
    }

    fn load_factor(&self, at: &Local) -> f64 {
        self.value(Hook::LoadFactor, |variable| variable.at(at))
    }

    fn friction(&self, at: &Local) -> f64 {
        self.value(Hook::Friction, |variable| variable.at(at))
    }

    fn profile(&self, at: &ProfileAt) -> f64 {
        self.value(Hook::Profile, |variable| variable.on(at))
    }

    fn operation(&self, state: &super::OperationState) -> super::OperationChange {
        super::OperationChange {
            centre_distance: self.value(Hook::Operation, |variable| variable.of(state)),
        }
    }

    fn fault(&self) -> Option<String> {
        self.fault.get().cloned()
    }
}
