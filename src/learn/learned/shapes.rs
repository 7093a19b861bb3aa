//! Plain functions of one variable that a learned curve may stand for: a smooth process makes waves of a step, and is right only where nature is smooth.
//!
//! ```text
//! factor on k = 1 + (factor − 1) g(x),  0 ≤ g ≤ 1      step, until, band, hump, wave, decay
//!             = factor^((x − x₀)/L)                    steady growth from one end of the range to the other
//!             = (x / x_m)^exponent                     power law
//! ```
//! x₀, L: where the curve's range begins, and its length; x_m: the geometric mean of its ends. Edges are W = L/50 wide, about what a contact is wide.

use std::f64::consts::TAU;

use super::shape_parameter::ShapeParameter;
use crate::effects::Learned;
use crate::gear::Member;
use crate::learn::learned::knots::FROM_ZERO;
use crate::study::rounded;

/// Width of edges as a share of the range.
pub(super) const EDGE: f64 = 0.02;
/// Factors on k that a shape may have.
const FACTORS: [f64; 2] = [0.01, 100.0];
/// Exponents of a power law.
const EXPONENTS: [f64; 2] = [-6.0, 6.0];
/// A curve with no more knots has too few values for an edge or a wave.
const FEW: usize = 8;

/// A plain function of one variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// One value before a place, another one behind it.
    Step,
    /// Of one member: another value before a place, k itself behind it.
    Until,
    /// Another value between two places.
    Band,
    /// The same with rounded flanks, a bell.
    Hump,
    /// Up and down.
    Wave,
    /// From one value at nothing to 1.
    Decay,
    /// Evenly in the logarithm.
    Growth,
    /// A power of the variable.
    Power,
}

impl Shape {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Step,
        Self::Until,
        Self::Band,
        Self::Hump,
        Self::Wave,
        Self::Decay,
        Self::Growth,
        Self::Power,
    ];

    /// Its name, as `--form` takes it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Step => "step",
            Self::Until => "until",
            Self::Band => "band",
            Self::Hump => "hump",
            Self::Wave => "wave",
            Self::Decay => "decay",
            Self::Growth => "growth",
            Self::Power => "power",
        }
    }

    /// The shape of a name.
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|shape| shape.name() == name)
    }

    /// Whether no effect of the catalogue changes k so: decays, steady growth and powers are laws of effects.
    pub(in crate::learn) fn is_of_no_effect(self) -> bool {
        matches!(
            self,
            Self::Step | Self::Until | Self::Band | Self::Hump | Self::Wave
        )
    }

    /// Whether the law's variable is a place on the flank.
    pub(super) fn is_at_a_place(self, law: &Learned) -> bool {
        matches!(law.driver().name, "s" | "radius" | "along" | "from_tip")
    }

    /// Whether a law of a variable may have it.
    pub fn suits(self, law: &Learned) -> bool {
        let driver = law.driver().name;
        let from_zero = FROM_ZERO.contains(&driver);
        let is_place = self.is_at_a_place(law);
        let many = law.knots().len() > FEW;
        match self {
            Self::Step => many,
            // of both members it is a step with another k
            Self::Until => many && law.member().is_some(),
            Self::Band | Self::Hump | Self::Wave => many && (from_zero || is_place),
            Self::Decay => from_zero,
            Self::Growth => true,
            Self::Power => !from_zero && !is_place && law.knots()[0] >= 0.0,
        }
    }

    /// Its parameters on a law's range.
    pub(in crate::learn) fn parameters(self, law: &Learned) -> Vec<ShapeParameter> {
        let [first, last] = ends(law);
        let span = last - first;
        let parameter =
            |name, [lower, upper]: [f64; 2], in_units, tried, logarithmic| ShapeParameter {
                name,
                lower: rounded(lower),
                upper: rounded(upper),
                in_units,
                tried,
                logarithmic,
            };
        let place = |name, tried| parameter(name, [first, last], true, tried, false);
        let length = |name, shares: [f64; 2], tried| {
            parameter(name, shares.map(|s| s * span), true, tried, true)
        };
        let factor = parameter("factor", FACTORS, false, 24, true);
        match self {
            Self::Step | Self::Until => vec![factor, place("at", 25)],
            Self::Band => vec![factor, place("centre", 17), length("width", [0.05, 0.9], 8)],
            Self::Hump => vec![factor, place("centre", 17), length("width", [0.03, 0.5], 8)],
            Self::Wave => vec![
                factor,
                place("crest", 25),
                length("period", [0.15, 2.0], 14),
            ],
            Self::Decay => vec![factor, length("scale", [0.02, 3.0], 16)],
            Self::Growth => vec![factor],
            Self::Power => vec![parameter("exponent", EXPONENTS, false, 25, false)],
        }
    }

    /// ln factor at a value of the variable; values behind those of the shape, such as when it begins, are passed over.
    pub(super) fn logarithm(self, law: &Learned, x: f64, values: &[f64]) -> f64 {
        let [first, last] = ends(law);
        let edge = EDGE * (last - first);
        let share = match (self, values) {
            (Self::Step, [_, at, ..]) => 0.5 * (1.0 + ((x - at) / edge).tanh()),
            (Self::Until, [_, at, ..]) => 0.5 * (1.0 - ((x - at) / edge).tanh()),
            (Self::Band, [_, centre, width, ..]) => {
                let side = |sign: f64| ((x - centre + sign * 0.5 * width) / edge).tanh();
                0.5 * (side(1.0) - side(-1.0))
            }
            (Self::Hump, [_, centre, width, ..]) => (-0.5 * ((x - centre) / width).powi(2)).exp(),
            (Self::Wave, [_, crest, period, ..]) => {
                0.5 * (1.0 + (TAU * (x - crest) / period).cos())
            }
            (Self::Decay, [_, scale, ..]) => (-x / scale).exp(),
            (Self::Growth, [factor]) => return factor.ln() * (x - first) / (last - first),
            (Self::Power, [exponent]) => {
                let middle = middle(law);
                return exponent * (x.max(edge) / middle).ln();
            }
            _ => return 0.0,
        };
        (1.0 + (values[0] - 1.0) * share).ln()
    }

    /// ln factor at the knots of a law; those of both members have no mean, which is the wear coefficient's.
    pub(in crate::learn) fn at_knots(self, law: &Learned, values: &[f64]) -> Vec<f64> {
        let knots = law.knots().iter();
        let mut all: Vec<f64> = knots.map(|&x| self.logarithm(law, x, values)).collect();
        if law.member().is_none() {
            let mean = all.iter().sum::<f64>() / all.len() as f64;
            all.iter_mut().for_each(|value| *value -= mean);
        }
        all
    }

    /// g as a formula of the law's variable; None of shapes that are no part of a factor. `extent`: a formula in place of a step's place or a band's width.
    pub(super) fn share(self, law: &Learned, extent: Option<&str>) -> Option<String> {
        let [first, last] = ends(law);
        let (x, edge) = (law.driver().name, rounded(EDGE * (last - first)));
        Some(match self {
            Self::Step | Self::Until => {
                let at = extent.unwrap_or("at");
                let sign = if self == Self::Step { '+' } else { '-' };
                format!("0.5*(1 {sign} tanh(({x} - {at})/{edge}))")
            }
            Self::Band => {
                let width = extent.unwrap_or("width");
                format!(
                    "0.5*(tanh(({x} - centre + 0.5*{width})/{edge}) - tanh(({x} - centre - 0.5*{width})/{edge}))"
                )
            }
            Self::Hump => format!("exp(-0.5*(({x} - centre)/width)^2)"),
            Self::Wave => format!("0.5*(1 + cos(2*pi*({x} - crest)/period))"),
            Self::Decay => format!("exp(-{x}/scale)"),
            Self::Growth | Self::Power => return None,
        })
    }

    /// The factor as a formula of a study, in the law's variable and the names of the parameters; `part`: a formula that is 1 where it acts; `extent`: as in
    /// [`Self::share`].
    pub(in crate::learn) fn formula(
        self,
        law: &Learned,
        [part, extent]: [Option<&str>; 2],
    ) -> String {
        let [first, last] = ends(law);
        let [first, span] = [first, last - first].map(rounded);
        let (x, edge) = (law.driver().name, rounded(EDGE * (last - first)));
        let factor = match (self.share(law, extent), part) {
            (Some(share), Some(part)) => format!("1 + (factor - 1)*{share}*{part}"),
            (Some(share), None) => format!("1 + (factor - 1)*{share}"),
            (None, _) if self == Self::Growth => format!("factor^(({x} - {first})/{span})"),
            (None, _) => format!("(max({x}, {edge})/{})^exponent", rounded(middle(law))),
        };
        match law.member() {
            None => factor,
            Some(Member::Pinion) => format!("1 + pinion*({factor} - 1)"),
            Some(Member::Gear) => format!("1 + (1 - pinion)*({factor} - 1)"),
        }
    }
}

/// The outermost knots.
pub(super) fn ends(law: &Learned) -> [f64; 2] {
    let knots = law.knots();
    [knots[0], knots[knots.len() - 1]]
}

/// The geometric mean of the ends, the lower one taken for an edge's width at least.
fn middle(law: &Learned) -> f64 {
    let [first, last] = ends(law);
    (first.max(EDGE * (last - first)) * last).sqrt()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::effects::formula::Formula;
    use crate::effects::{Hook, Local};

    pub(in crate::learn::learned) fn law(
        driver: &str,
        member: Option<Member>,
        from: f64,
        to: f64,
    ) -> Learned {
        let knots: Vec<f64> = (0..25)
            .map(|n| from + (to - from) * f64::from(n) / 24.0)
            .collect();
        Learned::new(Hook::WearFactor, driver, member, &knots).unwrap()
    }

    pub(in crate::learn::learned) fn anywhere() -> Local {
        Local {
            member: Member::Pinion,
            radius: 26.4,
            path: -1.5,
            approach: true,
            curvature: [7.7, 19.7],
            rolling: [1.61, 2.10],
            pressure: 640.0,
            peak_pressure: 850.0,
            hertz_pressure: 820.0,
            line_load: 110.0,
            half_width: 0.085,
            normal_load: 119.44,
            depth: 4.0,
            cycles: 2.5e5,
            contacts: 2.5e5,
            hours: 30.0,
            contact_hours: 1.0 / (60.0 * 2000.0),
            worn_volume: 50.0,
            torque: 100.0,
            speed: 2000.0,
            base_radius: 25.3717,
            base_pitch: 5.904,
            film_ratio: 0.3,
            friction: 0.045,
            flash_temperature: 12.5,
            bulk_temperature: 80.0,
        }
    }

    /// What the formula says and what is compared with the curve is the same law.
    #[test]
    fn formulas_say_what_the_shapes_do() {
        let laws = [
            law("cycles", None, 0.0, 6e5),
            law("torque", None, 100.0, 300.0),
            law("cycles", Some(Member::Pinion), 0.0, 6e5),
            law("cycles", Some(Member::Gear), 0.0, 6e5),
        ];
        let mut compared = 0;
        for law in &laws {
            for shape in Shape::ALL.into_iter().filter(|shape| shape.suits(law)) {
                let parameters = shape.parameters(law);
                let names: Vec<&str> = parameters.iter().map(|p| p.name).collect();
                let values: Vec<f64> = (parameters.iter())
                    .map(|p| p.value(0.3 * p.scaled(p.lower) + 0.7 * p.scaled(p.upper)))
                    .collect();
                let formula =
                    Formula::new(Hook::WearFactor, &shape.formula(law, [None; 2]), &names).unwrap();
                let effect = formula.build(&values);
                for x in law.knots() {
                    let at = Local {
                        cycles: *x,
                        torque: *x,
                        member: law.member().unwrap_or(Member::Pinion),
                        ..anywhere()
                    };
                    let expected = shape.logarithm(law, *x, &values).exp();
                    let found = effect.wear_factor(&at);
                    let close = (found - expected).abs() < 1e-4 * expected;
                    assert!(close, "{shape:?} at {x}: {found} {expected}");
                    let other = Local {
                        member: at.member.other(),
                        ..at
                    };
                    if law.member().is_some() {
                        assert_eq!(effect.wear_factor(&other), 1.0);
                    }
                    compared += 1;
                }
            }
        }
        assert_eq!(compared, 25 * (6 + 3 + 7 + 7));
    }
}
