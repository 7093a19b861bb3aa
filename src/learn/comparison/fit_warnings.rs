//! Warnings about a fit, in sentences: an end without convergence, values on bounds, parameters that show only together,
//! traces over several tests, rows that stand twice.

use std::collections::HashSet;

use nalgebra::DMatrix;

use crate::learn::fitted::Fit;
use crate::learn::parameters::Estimate;
use crate::measure::{Dataset, FacePlace, Observation};

/// Least eigenvalue of the correlation of parameters that are badly known; of two it is 1 − |correlation|.
const TOGETHER: f64 = 0.02;
/// Part in such a direction from which a parameter belongs to it.
const PART: f64 = 0.2;
/// Standard deviation over value from which a parameter is badly known.
const BADLY_KNOWN: f64 = 0.25;

/// All that there is to say.
pub(in crate::learn) fn fit_warnings(data: &Dataset, fit: &Fit) -> Vec<String> {
    let mut warnings = Vec::new();
    // one without a step was given up, which is said where it is
    if !fit.converged && fit.iterations > 0 {
        warnings.push(format!(
            "the fit did not converge in {} steps",
            fit.iterations
        ));
    }
    for parameter in fit.parameters.iter().filter(|p| p.at_bound) {
        warnings.push(format!(
            "{} lies on its bound, {}",
            parameter.name,
            rounded(parameter.value)
        ));
    }
    warnings.extend(together(&fit.parameters, &correlation(fit)));
    warnings.extend(wide_traces(data));
    warnings.extend(repeated(data));
    warnings.extend(data.outliers_in_words());
    warnings
}

/// A bound as people write it.
fn rounded(value: f64) -> String {
    if (1e-2..1e6).contains(&value.abs()) {
        format!("{}", (1e4 * value).round() / 1e4)
    } else {
        format!("{value:.3e}")
    }
}

/// The correlations of a fit's parameters, on their natural scales.
pub(in crate::learn) fn correlation(fit: &Fit) -> Vec<Vec<f64>> {
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

/// The parameters of which the data give a sum or a product and none alone: directions in which the correlation is close to singular.
fn together(parameters: &[Estimate], correlation: &[Vec<f64>]) -> Vec<String> {
    let badly_known = |p: &Estimate| p.sigma > BADLY_KNOWN * p.value.abs();
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

/// Traces that go over tests or members.
fn wide_traces(data: &Dataset) -> Option<String> {
    let wide = |number: &usize| {
        let mut points = data
            .observations
            .iter()
            .filter(|o| o.trace == Some(*number));
        let first = points.next();
        points.any(|o| first.is_some_and(|f| (f.test, f.member) != (o.test, o.member)))
    };
    let wide: Vec<usize> = (0..data.traces.len()).filter(wide).collect();
    let first = &data.traces[*wide.first()?];
    Some(format!(
        "{} of {} traces go over several tests or members, `{}` ({}:{}) the first: all points of a trace share one datum, so name traces apart \
         that were zeroed apart",
        wide.len(),
        data.traces.len(),
        first.name,
        data.name,
        first.line
    ))
}

/// Rows that say what an earlier row says, to the last digit. A balance may read the same mass twice, so only rows with a place count.
fn repeated(data: &Dataset) -> Option<String> {
    let mut seen = HashSet::new();
    let placed = data.observations.iter().filter(|o| o.position.is_some());
    let mut again = placed.filter(|o| !seen.insert(contents(o)));
    let first = again.next()?;
    let count = 1 + again.count();
    let rows = if count == 1 { "row says" } else { "rows say" };
    Some(format!(
        "{count} {rows} again what an earlier one says, the first at {}: each counts as a measurement of its own",
        data.place(first)
    ))
}

/// All that a row says but its line.
fn contents(o: &Observation) -> impl Eq + std::hash::Hash + use<> {
    (
        (o.test, o.member, o.quantity, o.trace),
        (
            o.cycles.to_bits(),
            o.position.map(f64::to_bits),
            o.face.map(FacePlace::key),
        ),
        (o.value.to_bits(), o.sigma.to_bits(), o.tooth.clone()),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{Quantity, Subject, Trace};

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
            together(&parameters, &matrix)
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

    #[test]
    fn traces_over_several_tests_are_told() {
        let trace = |name: &str, line| Trace {
            name: name.to_owned(),
            quantity: Quantity::WearDepth,
            line,
        };
        let row = |test, member, number| Observation {
            trace: Some(number),
            ..row(test, member, 2, Some(26.0), 1.0)
        };
        let told = |observations| {
            wide_traces(&Dataset {
                name: "m.csv".to_owned(),
                tests: vec!["A".to_owned(), "B".to_owned()],
                observations,
                traces: vec![trace("1", 2), trace("2", 5)],
                reading: String::new(),
                outliers: Vec::new(),
            })
        };
        let (pinion, gear) = (Subject::Pinion, Subject::Gear);
        assert_eq!(
            told(vec![row(0, pinion, 0), row(0, pinion, 0), row(0, gear, 1)]),
            None
        );
        let said = told(vec![row(0, pinion, 0), row(0, gear, 1), row(1, gear, 1)]).unwrap();
        assert!(
            said.starts_with(
                "1 of 2 traces go over several tests or members, `2` (m.csv:5) the first"
            ),
            "{said}"
        );
    }

    fn row(
        test: usize,
        member: Subject,
        line: usize,
        position: Option<f64>,
        value: f64,
    ) -> Observation {
        Observation {
            test,
            member,
            cycles: 1e5,
            quantity: Quantity::WearDepth,
            position,
            value,
            sigma: 0.1,
            trace: None,
            face: None,
            tooth: None,
            line,
        }
    }

    #[test]
    fn rows_that_stand_twice_are_counted() {
        let row = |line, position, value| row(0, Subject::Pinion, line, position, value);
        let told = |observations: Vec<Observation>| {
            repeated(&Dataset {
                name: "m.csv".to_owned(),
                tests: vec!["A".to_owned()],
                observations,
                traces: Vec::new(),
                reading: String::new(),
                outliers: Vec::new(),
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
