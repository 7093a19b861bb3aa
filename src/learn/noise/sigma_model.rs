//! Which standard deviation each row's own noise gets.

use crate::measure::neighbours::curves;
use crate::measure::{Observation, Quantity};

/// Which σ the rows get. What stands on no curve, as masses do, keeps the stated one: no neighbours tell of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SigmaModel {
    /// The stated σ along curves times a factor.
    Stated {
        /// 1: as stated.
        factor: f64,
    },
    /// Of depths the same along a curve.
    OfCurve {
        /// µm.
        floor: f64,
        /// What joins it, as a share of the curve's largest depth.
        share: f64,
    },
}

impl SigmaModel {
    /// As stated.
    pub const AS_STATED: Self = Self::Stated { factor: 1.0 };

    /// σ of every row, in its unit.
    pub(in crate::learn) fn of(self, rows: &[&Observation]) -> Vec<f64> {
        let factor = match self {
            Self::Stated { factor } => factor,
            _ => 1.0,
        };
        let mut sigma: Vec<f64> = rows.iter().map(|o| o.sigma).collect();
        for curve in curves(rows) {
            curve.iter().for_each(|&i| sigma[i] *= factor);
            let depths = rows[curve[0]].quantity == Quantity::WearDepth;
            let values = curve.iter().map(|&i| rows[i].value.abs());
            let own = self.of_curve(values.fold(0.0, f64::max));
            if let Some(own) = own.filter(|own| depths && *own > 0.0) {
                curve.iter().for_each(|&i| sigma[i] = own);
            }
        }
        sigma
    }

    /// σ of the depths of a curve by its largest; None where each row has its own.
    fn of_curve(self, largest: f64) -> Option<f64> {
        match self {
            Self::Stated { .. } => None,
            Self::OfCurve { floor, share } => Some(floor + share * largest),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Subject;

    /// Scatter along curves says nothing of weighings.
    #[test]
    fn a_factor_is_of_what_lies_on_curves() {
        let row = |quantity, position| Observation {
            test: 0,
            member: Subject::Pinion,
            cycles: 1e5,
            quantity,
            position,
            value: 1.0,
            sigma: 0.1,
            trace: None,
            face: None,
            tooth: None,
            line: 1,
        };
        let depths = [26.0, 26.5, 27.0].map(|at| row(Quantity::WearDepth, Some(at)));
        let mass = row(Quantity::MassLoss, None);
        let rows: Vec<&Observation> = depths.iter().chain([&mass]).collect();
        let sigma = SigmaModel::Stated { factor: 3.0 }.of(&rows);
        for (sigma, expected) in sigma.into_iter().zip([0.3, 0.3, 0.3, 0.1]) {
            assert!((sigma - expected).abs() < 1e-12, "{sigma} {expected}");
        }
    }
}
