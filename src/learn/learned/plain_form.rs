//! A plain shape of one variable, everywhere or in a part of the flank or of the time alone.
//!
//! ```text
//! factor on k = 1 + (factor − 1) g(x) h       h = 1,  1 in approach or in recess alone,  ½ (1 + tanh((n − n₀)/W)) from a moment on
//! ```
//! A cause that nobody knows often has a place and a beginning: oil fails on half a flank, a scuff starts. W: a fiftieth of the longest test.

use super::shapes::{EDGE, NearShape, Shape, ShapeParameter};
use crate::effects::{Hook, Learned};
use crate::learn::learned::knots::FROM_ZERO;
use crate::study::rounded;

/// Where or when a shape acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Within {
    /// Everywhere, always.
    Everywhere,
    /// Before the pitch point alone.
    Approach,
    /// Behind the pitch point alone.
    Recess,
    /// From a moment on.
    Moment,
}

/// Shares of the longest test at which a beginning is looked for.
const BEGINNINGS: [f64; 2] = [0.3, 0.6];
/// How much more a cause changes k where it acts than a law everywhere or always says of it.
const MORE: f64 = 1.7;

/// A shape and where it acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlainForm {
    /// Of the law's variable.
    pub shape: Shape,
    /// Where or when.
    pub within: Within,
}

impl PlainForm {
    /// A shape everywhere.
    pub(in crate::learn) fn everywhere(shape: Shape) -> Self {
        Self {
            shape,
            within: Within::Everywhere,
        }
    }

    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        let within = [
            Within::Everywhere,
            Within::Approach,
            Within::Recess,
            Within::Moment,
        ];
        within
            .into_iter()
            .flat_map(|within| Shape::ALL.map(|shape| Self { shape, within }))
    }

    /// Its name, as `--form` takes it.
    pub fn name(self) -> String {
        let part = match self.within {
            Within::Everywhere => "",
            Within::Approach => "_in_approach",
            Within::Recess => "_in_recess",
            Within::Moment => "_from_a_moment",
        };
        format!("{}{part}", self.shape.name())
    }

    /// The form of a name.
    pub fn of_name(name: &str) -> Option<Self> {
        Self::all().find(|form| form.name() == name)
    }

    /// Whether a law of a variable may have it: what follows the time acts on a part of the flank, what follows the place from a moment on.
    pub(in crate::learn) fn suits(self, law: &Learned) -> bool {
        let of_time = FROM_ZERO.contains(&law.driver().name);
        let is_part = self.shape.share(law).is_some();
        law.hook() == Hook::WearFactor
            && self.shape.suits(law)
            && match self.within {
                Within::Everywhere => true,
                Within::Approach | Within::Recess => of_time && is_part,
                Within::Moment => self.shape.is_at_a_place(law) && is_part,
            }
    }

    /// Its parameters on a law's range; `longest`: cycles of the longest test.
    pub(in crate::learn) fn parameters(self, law: &Learned, longest: f64) -> Vec<ShapeParameter> {
        let mut all = self.shape.parameters(law);
        if self.within == Within::Moment {
            all.push(ShapeParameter::moment(longest));
        }
        all
    }

    /// The factor as a formula of a study, in the law's variable and the names of the parameters.
    pub(in crate::learn) fn formula(self, law: &Learned, longest: f64) -> String {
        let part = match self.within {
            Within::Everywhere => None,
            Within::Approach => Some("approach".to_owned()),
            Within::Recess => Some("(1 - approach)".to_owned()),
            Within::Moment => Some(format!(
                "0.5*(1 + tanh((cycles - from)/{}))",
                rounded(EDGE * longest)
            )),
        };
        self.shape.formula(law, part.as_deref())
    }

    /// Where its fits begin, from the shape nearest to the curve.
    pub(in crate::learn) fn starts(self, near: &NearShape, longest: f64) -> Vec<Vec<f64>> {
        let more = || {
            let mut values = near.values.clone();
            values[0] = (1.0 + MORE * (values[0] - 1.0)).max(0.5 * values[0]);
            values
        };
        match self.within {
            Within::Everywhere => vec![near.values.clone()],
            Within::Approach | Within::Recess => vec![more()],
            Within::Moment => BEGINNINGS
                .map(|share| [more(), vec![rounded(share * longest)]].concat())
                .to_vec(),
        }
    }
}
