//! A plain shape of one variable, everywhere or in a part of the flank or of the time alone.
//!
//! ```text
//! factor on k = 1 + (factor − 1) g(x) h       h = 1,  1 in approach or in recess alone,  ½ (1 + tanh((n − n₀)/W)) from a moment on
//! at            = at + (to − at) n/N          of a shape with one edge that spreads: its place
//! width         = width n/N                   of a band that spreads
//! ```
//! A cause that nobody knows often has a place and a beginning: oil fails on half a flank, a scuff starts, and grows. N: cycles of the longest test,
//! W: a fiftieth of them.

use super::nearest_shape::NearShape;
use super::shape_parameter::ShapeParameter;
use super::shapes::{EDGE, Shape, ends};
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
    /// On more and more of the flank, evenly over the cycles.
    Spreading,
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
            Within::Spreading,
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
            Within::Spreading => "_spreading",
        };
        format!("{}{part}", self.shape.name())
    }

    /// The form of a name.
    pub fn of_name(name: &str) -> Option<Self> {
        Self::all().find(|form| form.name() == name)
    }

    /// Whether a law of a variable may have it: what follows the time acts on a part of the flank, what follows the place from a
    /// moment on, or on more and more of it.
    pub(in crate::learn) fn suits(self, law: &Learned) -> bool {
        let of_time = FROM_ZERO.contains(&law.driver().name);
        let is_part = self.shape.share(law, None).is_some();
        law.hook() == Hook::WearFactor
            && self.shape.suits(law)
            && match self.within {
                Within::Everywhere => true,
                Within::Approach | Within::Recess => of_time && is_part,
                Within::Moment => self.shape.is_at_a_place(law) && is_part,
                Within::Spreading => {
                    self.shape.is_at_a_place(law) && (self.shape == Shape::Band || self.has_edge())
                }
            }
    }

    /// Whether it has one edge, at a place or a moment.
    fn has_edge(self) -> bool {
        matches!(self.shape, Shape::Step | Shape::Until)
    }

    /// Its parameters on a law's range; `longest`: cycles of the longest test.
    pub(in crate::learn) fn parameters(self, law: &Learned, longest: f64) -> Vec<ShapeParameter> {
        let mut all = self.shape.parameters(law);
        match self.within {
            Within::Moment => all.push(ShapeParameter::moment(longest)),
            // what spreads may begin or end beside what is in contact
            Within::Spreading if self.has_edge() => {
                all[1] = all[1].beyond();
                all.push(all[1].named("to"));
            }
            _ => {}
        }
        all
    }

    /// The factor as a formula of a study, in the law's variable and the names of the parameters.
    pub(in crate::learn) fn formula(self, law: &Learned, longest: f64) -> String {
        let part = match self.within {
            Within::Everywhere | Within::Spreading => None,
            Within::Approach => Some("approach".to_owned()),
            Within::Recess => Some("(1 - approach)".to_owned()),
            Within::Moment => Some(format!(
                "0.5*(1 + tanh((cycles - from)/{}))",
                rounded(EDGE * longest)
            )),
        };
        let longest = rounded(longest);
        let extent = match (self.within, self.shape) {
            (Within::Spreading, Shape::Step | Shape::Until) => {
                Some(format!("(at + (to - at)*cycles/{longest})"))
            }
            (Within::Spreading, _) => Some(format!("(width*cycles/{longest})")),
            _ => None,
        };
        self.shape
            .formula(law, [part.as_deref(), extent.as_deref()])
    }

    /// ln factor at the knots of a law, where it acts and at the end of the longest test.
    pub(in crate::learn) fn at_knots(self, law: &Learned, values: &[f64]) -> Vec<f64> {
        match (self.within, values) {
            (Within::Spreading, &[factor, _, to]) if self.has_edge() => {
                self.shape.at_knots(law, &[factor, to])
            }
            _ => self.shape.at_knots(law, values),
        }
    }

    /// Where its fits begin, from the shape nearest to the curve.
    pub(in crate::learn) fn starts(
        self,
        law: &Learned,
        near: &NearShape,
        longest: f64,
    ) -> Vec<Vec<f64>> {
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
            // on the mean the edge stands where it does halfway
            Within::Spreading if self.has_edge() => {
                let [first, last] = ends(law);
                let from = |end: f64| {
                    let [factor, at] = [more()[0], near.values[1]];
                    vec![factor, end, (2.0 * at - end).clamp(first, last)]
                };
                vec![from(first), from(last)]
            }
            Within::Spreading => {
                let mut values = more();
                let widest = self.shape.parameters(law)[2].upper;
                values[2] = (MORE * values[2]).min(widest);
                vec![values]
            }
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

    /// An edge that moves evenly from 4 mm before the pitch point to 2 mm behind it, and a band that is 4 mm wide in the end.
    #[test]
    fn what_spreads_reaches_its_ends() {
        let of_place = law("s", -5.0, 5.0);
        let at = |cycles: f64, path: f64| Local {
            cycles,
            path,
            ..anywhere()
        };
        let step = [3.0, -4.0, 2.0];
        let edge = [(0.0, -4.0), (5e5, -1.0), (1e6, 2.0)];
        for (cycles, edge) in edge {
            for (path, expected) in [(edge - 0.9, 1.0), (edge, 2.0), (edge + 0.9, 3.0)] {
                let found = factor("step_spreading", &of_place, &step, &at(cycles, path));
                assert!(
                    (found - expected).abs() < 1e-3,
                    "{cycles} {path}: {found} {expected}"
                );
            }
        }
        let band = [3.0, 1.0, 4.0];
        for (cycles, path, expected) in [
            (0.0, 1.0, 1.0),
            (1e6, 1.0, 3.0),
            (1e6, 2.1, 3.0),
            (5e5, 2.9, 1.0),
            (1e6, 3.9, 1.0),
        ] {
            let found = factor("band_spreading", &of_place, &band, &at(cycles, path));
            assert!(
                (found - expected).abs() < 1e-2,
                "{cycles} {path}: {found} {expected}"
            );
        }
        // the picture shows where it stands in the end
        let form = PlainForm::of_name("step_spreading").unwrap();
        let shown = form.at_knots(&of_place, &step);
        assert_eq!(shown, Shape::Step.at_knots(&of_place, &[3.0, 2.0]));
    }

    /// A form is found by its name, and suits no variable that it says nothing of.
    #[test]
    fn names_are_read_as_they_are_written() {
        for form in PlainForm::all() {
            assert_eq!(PlainForm::of_name(&form.name()), Some(form));
        }
        let of_place = law("s", -5.0, 5.0);
        let suits = |name: &str| PlainForm::of_name(name).unwrap().suits(&of_place);
        assert!(suits("step") && suits("step_from_a_moment") && suits("step_spreading"));
        assert!(suits("band_spreading") && !suits("hump_spreading"));
        assert!(!suits("step_in_approach") && !suits("decay") && !suits("growth_from_a_moment"));
    }
}
