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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::Local;
    use crate::effects::formula::Formula;
    use crate::learn::learned::shapes::tests::anywhere;

    /// The factor of a form with these values at a place.
    fn factor(name: &str, law: &Learned, values: &[f64], at: &Local) -> f64 {
        let form = PlainForm::of_name(name).unwrap();
        assert!(form.suits(law), "{name}");
        let parameters = form.parameters(law, 1e6);
        let names: Vec<&str> = parameters.iter().map(|p| p.name).collect();
        let formula = Formula::new(Hook::WearFactor, &form.formula(law, 1e6), &names).unwrap();
        formula.build(values).wear_factor(at)
    }

    fn law(driver: &str, from: f64, to: f64) -> Learned {
        let knots: Vec<f64> = (0..25)
            .map(|n| from + (to - from) * f64::from(n) / 24.0)
            .collect();
        Learned::new(Hook::WearFactor, driver, None, &knots).unwrap()
    }

    /// Three times k on its part, k itself on the other.
    #[test]
    fn a_part_is_the_one_that_is_named() {
        let of_time = law("cycles", 0.0, 1e6);
        let before = Local {
            cycles: 9e5,
            approach: true,
            ..anywhere()
        };
        let behind = Local {
            approach: false,
            ..before
        };
        let early = Local {
            cycles: 1e5,
            ..before
        };
        let step = [3.0, 5e5];
        for (name, expected) in [
            ("step", [3.0, 3.0, 1.0]),
            ("step_in_approach", [3.0, 1.0, 1.0]),
            ("step_in_recess", [1.0, 3.0, 1.0]),
        ] {
            let found = [before, behind, early].map(|at| factor(name, &of_time, &step, &at));
            for (found, expected) in found.into_iter().zip(expected) {
                assert!(
                    (found - expected).abs() < 1e-6,
                    "{name}: {found} {expected}"
                );
            }
        }
        // the picture shows it where and when it acts
        let of_place = law("s", -5.0, 5.0);
        let values = [3.0, -1.5, 2.0, 5e5];
        let shown = Shape::Band.at_knots(&of_place, &values);
        assert_eq!(shown, Shape::Band.at_knots(&of_place, &values[..3]));
        let rise = shown.iter().copied().fold(0.0, f64::max) - shown[0];
        // the edges reach a little into the band
        assert!((rise - 3f64.ln()).abs() < 1e-2, "{rise}");
        // a band about s = -1.5 mm from 500 000 cycles on
        let beside = Local {
            path: 2.0,
            ..before
        };
        for (at, expected) in [(before, 3.0), (beside, 1.0), (early, 1.0)] {
            let found = factor("band_from_a_moment", &of_place, &values, &at);
            assert!((found - expected).abs() < 1e-3, "{found} {expected}");
        }
    }

    /// A form is found by its name, and suits no variable that it says nothing of.
    #[test]
    fn names_are_read_as_they_are_written() {
        for form in PlainForm::all() {
            assert_eq!(PlainForm::of_name(&form.name()), Some(form));
        }
        let of_place = law("s", -5.0, 5.0);
        let suits = |name: &str| PlainForm::of_name(name).unwrap().suits(&of_place);
        assert!(suits("step") && suits("step_from_a_moment"));
        assert!(!suits("step_in_approach") && !suits("decay") && !suits("growth_from_a_moment"));
    }
}
