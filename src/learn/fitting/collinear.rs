//! Parameters of a fit that the data know only together: a sum or a product, and none alone (collinear columns).

use nalgebra::DMatrix;

use crate::learn::hypothesis::parameters::Estimate;

/// Least eigenvalue of the correlation of parameters that are badly known; of two it is 1 − |correlation|.
const TOGETHER: f64 = 0.02;
/// Part in such a direction from which a parameter belongs to it.
const PART: f64 = 0.2;
/// Standard deviation over value from which a parameter is badly known.
const BADLY_KNOWN: f64 = 0.25;

/// The parameters of which the data give a sum or a product and none alone: directions in which the correlation is close to singular.
pub(in crate::learn) fn act_together(
    parameters: &[Estimate],
    correlation: &[Vec<f64>],
) -> Vec<String> {
    // the values of a learned law hang together by its length, and nobody fixes one of them
    let is_knot = |p: &Estimate| p.name.starts_with("learned:");
    let badly_known = |p: &Estimate| !is_knot(p) && p.sigma > BADLY_KNOWN * p.value.abs();
    let badly: Vec<usize> = (0..parameters.len())
        .filter(|&i| badly_known(&parameters[i]))
        .collect();
    let count = badly.len();
    if count < 2 {
        return Vec::new();
    }
    let matrix = DMatrix::from_fn(count, count, |i, j| correlation[badly[i]][badly[j]]);
    let eigen = matrix.symmetric_eigen();
    let directions = eigen
        .eigenvalues
        .iter()
        .zip(eigen.eigenvectors.column_iter());
    directions
        .filter(|(value, _)| **value < TOGETHER)
        .filter_map(|(_, direction)| {
            let takes_part = |&i: &usize| direction[i].abs() > PART;
            let names: Vec<&str> = ((0..count).filter(takes_part))
                .map(|i| parameters[badly[i]].name.as_str())
                .collect();
            let (last, others) = names.split_last().filter(|(_, others)| !others.is_empty())?;
            Some(format!(
                "{} and {last} act almost only together here: no value alone means much; fix all but one, or leave them out",
                others.join(", ")
            ))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn estimate(name: &str, value: f64, sigma: f64) -> Estimate {
        Estimate {
            name: name.to_owned(),
            unit: "-".to_owned(),
            value,
            sigma,
            interval: [value - 1.96 * sigma, value + 1.96 * sigma],
            at_bound: false,
            logarithmic: false,
        }
    }

    #[test]
    fn parameters_that_are_badly_known_together_are_told() {
        let told = |sigma: f64, rows: &[&[f64]]| {
            let names = ["k", "f.a", "f.b"];
            let parameters: Vec<Estimate> = (rows.iter().zip(names))
                .map(|(_, name)| estimate(name, 2.0, 2.0 * sigma))
                .collect();
            let matrix: Vec<Vec<f64>> = rows.iter().map(|row| row.to_vec()).collect();
            act_together(&parameters, &matrix)
        };
        let two: [&[f64]; 2] = [&[1.0, -0.995], &[-0.995, 1.0]];
        let said = told(0.5, &two);
        assert_eq!(said.len(), 1);
        assert!(
            said[0].starts_with("k and f.a act almost only together here"),
            "{}",
            said[0]
        );
        // of three with a known product each two are little correlated
        let three: [&[f64]; 3] = [&[1.0, -0.5, -0.5], &[-0.5, 1.0, -0.5], &[-0.5, -0.5, 1.0]];
        let said = told(1.5, &three);
        assert!(
            said[0].starts_with("k, f.a and f.b act almost only together"),
            "{}",
            said[0]
        );
        // each well known, or hardly dependent
        let hardly: [&[f64]; 2] = [&[1.0, 0.9], &[0.9, 1.0]];
        assert!(told(0.01, &two).is_empty() && told(0.5, &hardly).is_empty());
    }
}
