//! A learned law: any function of one driver, given by its values at knots.
//!
//! ```text
//! wear_factor = exp(v(x))       added_depth = max(v(x), 0)       profile = v(x)
//! ```
//! v is piecewise linear between the knots and constant beyond them. Linear, because the value between two knots then lies between
//! theirs, whatever the others are: a step stays a step, which a spline would make ring; and v is linear in the values, as a fit likes
//! it. What that costs for a smooth law falls with the square of the knots' spacing.

use std::sync::Arc;

use super::effect::{Effect, Hook};
use super::error::nearest;
use super::local::{Local, ProfileAt};
use super::variables::{self, VARIABLES, Variable};
use crate::gear::Member;
use crate::numeric::interpolate;

/// Largest |ln factor| of a learned law: beyond it a factor is as good as none or as any.
pub const LARGEST_LOGARITHM: f64 = 20.0;

/// Variables that are one number for a tooth pair's whole contact on one member.
const EVEN: &[&str] = &[
    "cycles",
    "contacts",
    "hours",
    "contact_hours",
    "worn_volume",
    "v_slide",
    "v_roll",
    "s",
    "approach",
    "pinion",
    "dedendum",
    "line_load",
    "normal_load",
    "half_width",
    "p_hertz",
    "relative_radius",
    "rho1",
    "torque",
    "speed",
    "film_ratio",
    "friction",
    "flash_temperature",
    "bulk_temperature",
    "slid_distance",
];

/// A law without its values.
#[derive(Debug, Clone)]
pub struct Learned {
    hook: Hook,
    driver: &'static Variable,
    member: Option<Member>,
    knots: Arc<[f64]>,
}

/// Why a learned law is none.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum LearnedError {
    /// It acts through another hook.
    #[error("a learned law cannot give {hook}, only wear_factor, added_depth or profile")]
    Hook {
        /// The hook's name.
        hook: &'static str,
    },
    /// No variable, or not one that its hook knows.
    #[error("{hook} cannot follow `{driver}`; the nearest variable is `{nearest}`")]
    Driver {
        /// The hook's name.
        hook: &'static str,
        /// What was asked for.
        driver: String,
        /// The allowed name most like it.
        nearest: &'static str,
    },
    /// Fewer than two knots, one that is not finite, or one that is not above the one before it.
    #[error("{0}")]
    Knots(String),
}

impl Learned {
    /// Hooks that a learned law can act through.
    pub const HOOKS: [Hook; 3] = [Hook::WearFactor, Hook::AddedDepth, Hook::Profile];

    /// A law of `driver` at `knots`, in the driver's unit, ascending; of both members where none is named.
    ///
    /// # Errors
    /// [`LearnedError`]
    pub fn new(
        hook: Hook,
        driver: &str,
        member: Option<Member>,
        knots: &[f64],
    ) -> Result<Self, LearnedError> {
        let driver = Self::driver_of(hook, driver)?;
        if knots.len() < 2 {
            return Err(LearnedError::Knots(format!(
                "{} knots, at least 2 are needed",
                knots.len()
            )));
        }
        if let Some(n) = (1..knots.len()).find(|&n| knots[n] <= knots[n - 1]) {
            return Err(LearnedError::Knots(format!(
                "knot {} is {}, which is not above {}, the one before it",
                n + 1,
                knots[n],
                knots[n - 1]
            )));
        }
        if let Some(n) = knots.iter().position(|knot| !knot.is_finite()) {
            return Err(LearnedError::Knots(format!("knot {} is not finite", n + 1)));
        }
        Ok(Self {
            hook,
            driver,
            member,
            knots: knots.into(),
        })
    }

    /// The variable of this name, if laws that act through `hook` can follow it.
    ///
    /// # Errors
    /// [`LearnedError`]
    pub fn driver_of(hook: Hook, name: &str) -> Result<&'static Variable, LearnedError> {
        if !Self::HOOKS.contains(&hook) {
            return Err(LearnedError::Hook { hook: hook.name() });
        }
        let known = variables::find(name).filter(|variable| variable.available(hook));
        known.ok_or_else(|| LearnedError::Driver {
            hook: hook.name(),
            driver: name.to_owned(),
            nearest: nearest(name, Self::drivers(hook)).unwrap_or_default(),
        })
    }

    /// Names of the variables that laws acting through `hook` can follow.
    pub fn drivers(hook: Hook) -> impl Iterator<Item = &'static str> {
        let all = VARIABLES.iter();
        all.filter(move |variable| variable.available(hook))
            .map(|variable| variable.name)
    }

    /// Name in results: `learned:cycles`, `learned:radius:pinion`.
    pub fn name(&self) -> String {
        match self.member {
            None => format!("learned:{}", self.driver.name),
            Some(member) => format!("learned:{}:{}", self.driver.name, member.name()),
        }
    }

    /// Through what it acts.
    pub fn hook(&self) -> Hook {
        self.hook
    }

    /// What it follows.
    pub fn driver(&self) -> &'static Variable {
        self.driver
    }

    /// The only member it acts on, if it is not both.
    pub fn member(&self) -> Option<Member> {
        self.member
    }

    /// Where its values are given, in the driver's unit.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// The effect with these values at the knots: logarithms of a factor, or µm.
    ///
    /// # Panics
    /// If there are not as many values as knots.
    pub fn build(&self, values: Vec<f64>) -> Box<dyn Effect> {
        assert_eq!(values.len(), self.knots.len(), "one value for each knot");
        let ends = |wanted: bool| wanted && EVEN.contains(&self.driver.name);
        Box::new(Bound {
            even: ends(self.hook == Hook::WearFactor),
            law: self.clone(),
            values,
        })
    }
}

impl PartialEq for Learned {
    fn eq(&self, other: &Self) -> bool {
        self.hook == other.hook
            && self.driver.name == other.driver.name
            && self.member == other.member
            && self.knots == other.knots
    }
}

/// A law with its values.
struct Bound {
    law: Learned,
    values: Vec<f64>,
    even: bool,
}

impl Bound {
    fn at(&self, x: f64) -> f64 {
        interpolate(&self.law.knots, &self.values, x)
    }

    fn concerns(&self, hook: Hook, member: Member) -> bool {
        self.law.hook == hook && self.law.member.is_none_or(|only| only == member)
    }
}

impl Effect for Bound {
    fn wear_factor(&self, at: &Local) -> f64 {
        if self.concerns(Hook::WearFactor, at.member) {
            let logarithm = self.at(self.law.driver.at(at));
            logarithm.clamp(-LARGEST_LOGARITHM, LARGEST_LOGARITHM).exp()
        } else {
            1.0
        }
    }

    fn is_even(&self) -> bool {
        self.even
    }

    fn added_depth(&self, at: &Local) -> f64 {
        if self.concerns(Hook::AddedDepth, at.member) {
            self.at(self.law.driver.at(at)).max(0.0)
        } else {
            0.0
        }
    }

    fn profile(&self, at: &ProfileAt) -> f64 {
        if self.concerns(Hook::Profile, at.member) {
            self.at(self.law.driver.on(at))
        } else {
            0.0
        }
    }
}
