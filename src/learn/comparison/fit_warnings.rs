//! Warnings about a fit, in sentences: an end without convergence, values on bounds, parameters that show only together,
//! traces over several tests, rows that stand twice.

use std::collections::HashSet;

use super::shifted_places::shifted_places;
use crate::learn::fitting::collinear::act_together;
use crate::learn::fitting::fitted::Fit;
use crate::learn::hypothesis::parameters::short;
use crate::measure::{Dataset, FacePlace, Observation};

/// All that there is to say.
pub(in crate::learn) fn fit_warnings(data: &Dataset, fit: &Fit) -> Vec<String> {
    let mut warnings = Vec::new();
    // one without a step was given up, which is said where it is
    if !fit.converged && fit.iterations > 0 {
        warnings.push(match fit.iterations {
            1 => "the fit did not converge in a step".to_owned(),
            steps => format!("the fit did not converge in {steps} steps"),
        });
    }
    for parameter in fit.parameters.iter().filter(|p| p.at_bound) {
        warnings.push(format!(
            "{} lies on its bound, {}",
            parameter.name,
            short(parameter.value)
        ));
    }
    warnings.extend(act_together(&fit.parameters, &correlation(fit)));
    warnings.extend(of_measurements(data, data.outliers_counted()));
    warnings
}

/// What there is to say of the measurements alone, all rows that stand apart among it.
pub fn data_warnings(data: &Dataset) -> Vec<String> {
    let mut warnings = of_measurements(data, data.outliers_in_words());
    warnings.extend(shifted_places(data));
    warnings
}

fn of_measurements(data: &Dataset, outliers: Option<String>) -> Vec<String> {
    let mut warnings: Vec<String> = wide_traces(data).into_iter().collect();
    warnings.extend(repeated(data));
    warnings.extend(outliers);
    warnings
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

/// Rows that say what an earlier row says, to the last digit, whatever their sigma. A balance may read the same mass twice, so only rows with a
/// place count.
fn repeated(data: &Dataset) -> Option<String> {
    let mut seen = HashSet::new();
    let placed = data.observations.iter().filter(|o| o.position.is_some());
    let mut again = placed.filter(|o| !seen.insert(contents(o)));
    let first = again.next()?;
    let count = 1 + again.count();
    let rows = if count == 1 {
        "row repeats"
    } else {
        "rows repeat"
    };
    Some(format!(
        "{count} {rows} an earlier one, the first at {}: each counts as a measurement of its own",
        data.place(first)
    ))
}

/// All that a row says but its line and sigma.
fn contents(o: &Observation) -> impl Eq + std::hash::Hash + use<> {
    (
        (o.test, o.member, o.quantity, o.trace),
        (
            o.cycles.to_bits(),
            o.position.map(f64::to_bits),
            o.face.map(FacePlace::key),
        ),
        (o.value.to_bits(), o.tooth.clone()),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{Quantity, Subject, Trace};

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
                estimated_sigmas: 0,
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
                estimated_sigmas: 0,
            })
        };
        let (a, b) = (row(2, Some(26.0), 1.0), row(3, Some(26.0), 1.1));
        assert_eq!(told(vec![a.clone(), b.clone()]), None);
        let again = Observation {
            line: 7,
            sigma: 0.3,
            ..a.clone()
        };
        let said = told(vec![a, b, again]).unwrap();
        assert!(
            said.starts_with("1 row repeats an earlier one, the first at m.csv:7"),
            "{said}"
        );
        // a balance reads the same mass twice
        assert_eq!(told(vec![row(2, None, 1.0), row(3, None, 1.0)]), None);
    }
}
