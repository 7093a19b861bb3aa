//! What is doubtful about a fit, in sentences: an end without convergence, values on bounds, parameters that show only together,
//! rows that stand twice.

use std::collections::HashSet;

use super::fitted::Fit;
use super::parameters::Estimate;
use crate::measure::{Dataset, Observation};

/// Correlation beyond which two parameters that are badly known are one in truth.
const TOGETHER: f64 = 0.98;
/// Standard deviation over value from which a parameter is badly known.
const BADLY_KNOWN: f64 = 0.25;

/// All that there is to say.
pub(super) fn doubts(data: &Dataset, fit: &Fit) -> Vec<String> {
    let mut doubts = Vec::new();
    if !fit.converged {
        doubts.push(format!(
            "the fit did not converge in {} steps",
            fit.iterations
        ));
    }
    for parameter in fit.parameters.iter().filter(|p| p.at_bound) {
        doubts.push(format!(
            "{} lies on its bound, {:.3e}",
            parameter.name, parameter.value
        ));
    }
    doubts.extend(together(&fit.parameters, &correlation(fit)));
    doubts.extend(repeated(data));
    doubts
}

/// The correlations of a fit's parameters, on their natural scales.
pub(super) fn correlation(fit: &Fit) -> Vec<Vec<f64>> {
    let c = &fit.covariance;
    let size = |i: usize| c[(i, i)].max(f64::MIN_POSITIVE).sqrt();
    let all = 0..fit.parameters.len();
    let row = |i| {
        all.clone()
            .map(|j| c[(i, j)] / (size(i) * size(j)))
            .collect()
    };
    all.clone().map(row).collect()
}

/// The pairs of parameters of which the data give a sum or a product and neither alone.
fn together<'a>(
    parameters: &'a [Estimate],
    correlation: &'a [Vec<f64>],
) -> impl Iterator<Item = String> + 'a {
    let badly_known = |p: &Estimate| p.sigma > BADLY_KNOWN * p.value.abs();
    let pairs = (0..parameters.len()).flat_map(|i| (0..i).map(move |j| (j, i)));
    pairs
        .filter(move |&(i, j)| {
            correlation[i][j].abs() > TOGETHER
                && badly_known(&parameters[i])
                && badly_known(&parameters[j])
        })
        .map(|(i, j)| {
            format!(
                "{} and {} act almost only together here (correlation {:.3}): neither value alone means much; fix one, or leave it out",
                parameters[i].name, parameters[j].name, correlation[i][j]
            )
        })
}

/// Rows that say what an earlier row says, to the last digit. A balance may read the same mass twice, so only rows with a place count.
fn repeated(data: &Dataset) -> Option<String> {
    let mut seen = HashSet::new();
    let placed = data.observations.iter().filter(|o| o.position.is_some());
    let mut again = placed.filter(|o| !seen.insert(said(o)));
    let first = again.next()?;
    let count = 1 + again.count();
    let rows = if count == 1 { "row says" } else { "rows say" };
    Some(format!(
        "{count} {rows} again what an earlier one says, the first at {}: each counts as a measurement of its own",
        data.place(first)
    ))
}

/// All that a row says but its line.
fn said(o: &Observation) -> impl Eq + std::hash::Hash + use<> {
    let bits = |x: Option<f64>| x.map(f64::to_bits);
    (
        (o.test, o.member, o.quantity, o.trace),
        (o.cycles.to_bits(), bits(o.position), bits(o.face)),
        (o.value.to_bits(), o.sigma.to_bits(), o.tooth.clone()),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{Quantity, Subject};

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
        let told = |sigma, r: f64| {
            let parameters = [estimate("k", 1.0, sigma), estimate("f.a", 2.0, 2.0 * sigma)];
            let matrix = [vec![1.0, r], vec![r, 1.0]];
            together(&parameters, &matrix).collect::<Vec<_>>()
        };
        assert_eq!(told(0.5, -0.995).len(), 1);
        assert!(
            told(0.5, -0.995)[0]
                .starts_with("k and f.a act almost only together here (correlation -0.995)")
        );
        // each well known, or hardly dependent
        assert!(told(0.01, -0.995).is_empty() && told(0.5, 0.9).is_empty());
    }

    #[test]
    fn rows_that_stand_twice_are_counted() {
        let row = |line, position, value| Observation {
            test: 0,
            member: Subject::Pinion,
            cycles: 1e5,
            quantity: Quantity::WearDepth,
            position,
            value,
            sigma: 0.1,
            trace: None,
            face: None,
            tooth: None,
            line,
        };
        let told = |observations: Vec<Observation>| {
            repeated(&Dataset {
                name: "m.csv".to_owned(),
                tests: vec!["A".to_owned()],
                observations,
                traces: Vec::new(),
            })
        };
        let (a, b) = (row(2, Some(26.0), 1.0), row(3, Some(26.0), 1.1));
        assert_eq!(told(vec![a.clone(), b.clone()]), None);
        let again = Observation {
            line: 7,
            ..a.clone()
        };
        let said = told(vec![a, b, again]).unwrap();
        assert!(
            said.starts_with("1 row says again what an earlier one says, the first at m.csv:7"),
            "{said}"
        );
        // a balance reads the same mass twice
        assert_eq!(told(vec![row(2, None, 1.0), row(3, None, 1.0)]), None);
    }
}
