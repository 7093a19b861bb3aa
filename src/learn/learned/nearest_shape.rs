//! The shape of plain functions that is nearest to a learned curve, by least squares.

use super::shape_parameter::ShapeParameter;
use super::shapes::Shape;
use crate::effects::Learned;
use crate::numeric::golden_section::place_of_largest;

/// Least standard deviation of a value of the curve: a shape need not follow it more closely.
const LEAST_SIGMA: f64 = 0.02;
/// Rounds of the search along one parameter after the other, and its accuracy as a share of a step of the grid.
const ROUNDS: usize = 10;
const ACCURACY: f64 = 0.01;

/// A shape fitted to a curve.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::learn) struct NearShape {
    /// Which.
    pub(in crate::learn) shape: Shape,
    /// Values of its parameters, in the order of [`Shape::parameters`].
    pub(in crate::learn) values: Vec<f64>,
    /// Share of the curve's weighted sum of squares that it leaves.
    pub(in crate::learn) left: f64,
}

impl Shape {
    /// The shape's values nearest to a curve, weighted by its standard deviations: the best of a grid, then along one parameter after the other.
    pub(in crate::learn) fn nearest(
        self,
        law: &Learned,
        curve: &[f64],
        sigma: &[f64],
    ) -> NearShape {
        let weights: Vec<f64> = (sigma.iter())
            .map(|s| s.max(LEAST_SIGMA).powi(-2))
            .collect();
        let weighed = |values: &[f64]| -> f64 {
            let weighted = values.iter().zip(&weights).map(|(v, w)| w * v);
            weighted.sum::<f64>() / weights.iter().sum::<f64>()
        };
        let square = |values: &[f64]| -> f64 {
            let middle = match law.member() {
                None => weighed(values),
                Some(_) => 0.0,
            };
            let squares = values.iter().zip(&weights);
            squares.map(|(v, w)| w * (v - middle).powi(2)).sum()
        };
        let left = |values: &[f64]| -> f64 {
            let own = law.knots().iter().zip(curve);
            let rest: Vec<f64> = own
                .map(|(&x, v)| v - self.logarithm(law, x, values))
                .collect();
            square(&rest)
        };
        let parameters = self.parameters(law);
        let mut best = (f64::INFINITY, Vec::new());
        for start in grid(&parameters) {
            let left = left(&start);
            if left < best.0 {
                best = (left, start);
            }
        }
        let (_, mut values) = best;
        for _ in 0..ROUNDS {
            for (n, parameter) in parameters.iter().enumerate() {
                let at = parameter.scaled(values[n]);
                let step = parameter.step();
                let with = |y: f64| {
                    let mut values = values.clone();
                    values[n] = parameter.value(y);
                    values
                };
                let ends = [at - step, at + step];
                let found = with(place_of_largest(|y| -left(&with(y)), ends, ACCURACY * step));
                if left(&found) < left(&values) {
                    values = found;
                }
            }
        }
        NearShape {
            shape: self,
            left: left(&values) / square(curve).max(f64::MIN_POSITIVE),
            values,
        }
    }
}

/// All combinations of the values that are tried.
fn grid(parameters: &[ShapeParameter]) -> Vec<Vec<f64>> {
    let mut all = vec![Vec::new()];
    for parameter in parameters {
        let longer = |known: &Vec<f64>| -> Vec<Vec<f64>> {
            let with = |value| [&known[..], &[value]].concat();
            parameter.values().map(with).collect()
        };
        all = all.iter().flat_map(longer).collect();
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::learn::learned::shapes::tests::law;

    /// Each shape's own curve, with a mean that nobody knows, is found again.
    #[test]
    fn a_curve_of_a_shape_has_that_shape() {
        let law = law("cycles", None, 0.0, 6e5);
        let cases = [
            (Shape::Step, vec![1.53, 316_000.0]),
            (Shape::Band, vec![0.6, 250_000.0, 110_000.0]),
            (Shape::Hump, vec![2.0, 400_000.0, 60_000.0]),
            (Shape::Wave, vec![1.8, 100_000.0, 330_000.0]),
            (Shape::Decay, vec![4.0, 80_000.0]),
            (Shape::Growth, vec![2.5]),
        ];
        for (shape, values) in cases {
            let curve = shape.at_knots(&law, &values);
            let sigma = vec![0.05; curve.len()];
            let own = shape.nearest(&law, &curve, &sigma);
            assert!(own.left < 2e-3, "{own:?}");
            for ((found, wanted), parameter) in
                own.values.iter().zip(&values).zip(shape.parameters(&law))
            {
                let off = parameter.scaled(*found) - parameter.scaled(*wanted);
                assert!(off.abs() < 0.2 * parameter.step(), "{own:?} {values:?}");
            }
            for other in Shape::ALL.into_iter().filter(|other| other.suits(&law)) {
                let left = other.nearest(&law, &curve, &sigma).left;
                assert!(other == shape || left > own.left, "{other:?} for {shape:?}");
            }
        }
    }
}
