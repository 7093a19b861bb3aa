//! Many histories at once: the measured rows at many values of some parameters.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

use gearwear::learn::{Measured, ModelVersion, Place, PredictError, Simulator, contact_of};
use gearwear::study::{FreeParameter, Study, StudyError};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use rayon::prelude::*;

use crate::{failed, raised};

/// How often Python is asked whether somebody interrupts.
const LOOK: Duration = Duration::from_millis(50);

/// The rows of a history, and their derivatives row by row if they were asked for.
type Rows = (Vec<f64>, Vec<f64>);
/// One history, or why it failed.
type History = Result<Rows, String>;

/// Why there are no histories at all.
enum Unable {
    Study(StudyError),
    Run(String),
    Stopped,
}

/// The measured rows at every row of `theta` (doubles, a row for each history, a column for each name): values, derivatives or None, reasons
/// of failures or None by history, and where the rows stand.
#[pyfunction]
pub(crate) fn simulate<'py>(
    py: Python<'py>,
    text: &str,
    name: &str,
    names: Vec<String>,
    theta: &[u8],
    jacobian: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    if names.is_empty() || !theta.len().is_multiple_of(8 * names.len()) {
        return Err(PyValueError::new_err("theta has a column for each name"));
    }
    let numbers: Vec<f64> = theta
        .chunks_exact(8)
        .map(|bytes| f64::from_ne_bytes(bytes.try_into().unwrap_or([0; 8])))
        .collect();
    let points: Vec<&[f64]> = numbers.chunks_exact(names.len()).collect();
    let (stop, done) = (AtomicBool::new(false), AtomicUsize::new(0));
    let outcome = std::thread::scope(|scope| {
        let work = scope.spawn(|| histories(text, name, &names, &points, jacobian, &stop, &done));
        let mut interrupted = None;
        let mut told = 0;
        while !work.is_finished() {
            py.detach(|| std::thread::sleep(LOOK));
            let now = done.load(Ordering::Relaxed);
            let looked = py.check_signals().and_then(|()| match &progress {
                Some(tell) if now > told => tell.call1(py, (now, points.len())).map(drop),
                _ => Ok(()),
            });
            told = now;
            if let Err(error) = looked {
                stop.store(true, Ordering::Relaxed);
                interrupted = Some(error);
                break;
            }
        }
        let joined = py.detach(|| work.join());
        match (interrupted, joined) {
            (Some(error), _) => Err(error),
            (None, Ok(found)) => Ok(found),
            (None, Err(_)) => Err(failed(py, "the simulation failed", 1)),
        }
    })?;
    let (places, found) = outcome.map_err(|error| match error {
        Unable::Study(error) => raised(py, &error),
        Unable::Run(message) => failed(py, &message, 1),
        Unable::Stopped => failed(py, "interrupted", 1),
    })?;
    let rows = places.value.len();
    let bytes = |of: &dyn Fn(&Rows) -> Vec<f64>, each: usize| {
        let mut all = Vec::with_capacity(8 * each * found.len());
        for history in &found {
            let values = history.as_ref().map_or_else(|_| vec![f64::NAN; each], of);
            values.iter().for_each(|v| all.extend(v.to_ne_bytes()));
        }
        PyBytes::new(py, &all)
    };
    let answer = PyDict::new(py);
    answer.set_item("values", bytes(&|history| history.0.clone(), rows))?;
    if jacobian {
        let all = bytes(&|history| history.1.clone(), rows * names.len());
        answer.set_item("jacobian", all)?;
    }
    let reasons: Vec<Option<&String>> = found.iter().map(|h| h.as_ref().err()).collect();
    answer.set_item("reasons", reasons)?;
    let table = PyDict::new(py);
    table.set_item("test", places.test)?;
    table.set_item("member", places.member)?;
    table.set_item("cycles", places.cycles)?;
    table.set_item("quantity", places.quantity)?;
    table.set_item("position", places.position)?;
    table.set_item("value", places.value)?;
    table.set_item("sigma", places.sigma)?;
    answer.set_item("rows", table)?;
    Ok(answer)
}

/// Where the rows stand, column by column of the measurement file.
#[derive(Default)]
struct Places {
    test: Vec<String>,
    member: Vec<String>,
    cycles: Vec<f64>,
    quantity: Vec<String>,
    position: Vec<Option<f64>>,
    value: Vec<f64>,
    sigma: Vec<f64>,
}

fn histories(
    text: &str,
    name: &str,
    names: &[String],
    points: &[&[f64]],
    jacobian: bool,
    stop: &AtomicBool,
    done: &AtomicUsize,
) -> Result<(Places, Vec<History>), Unable> {
    let study = Study::parse(text, name).map_err(Unable::Study)?;
    // what is asked for is free
    let mut edit = study.edit();
    edit.free(names);
    let study = edit.finish(name).map_err(Unable::Study)?;
    let kind = contact_of(&study).map_err(Unable::Study)?;
    let data = study.dataset_to_fit().map_err(Unable::Study)?;
    let known = |name: &String| study.free().iter().find(|free| free.name == *name).cloned();
    let free: Option<Vec<FreeParameter>> = names.iter().map(known).collect();
    let free = free.ok_or_else(|| {
        let all: Vec<&str> = study.free().iter().map(|free| free.name.as_str()).collect();
        Unable::Run(format!(
            "names: {} are the single parameters",
            all.join(", ")
        ))
    })?;
    let version = ModelVersion {
        effects: study.effect_model().clone(),
        free,
    };
    let failed = |error: gearwear::simulate::forward::ForwardError| Unable::Run(error.to_string());
    let measured = Measured::new(&study, data);
    let workshop = measured.workshop(kind).map_err(failed)?;
    let bench = measured.finest_bench(&workshop).map_err(failed)?;
    let simulator = Simulator::new(&measured, &bench, &version);
    let found: Option<Vec<History>> = points
        .par_iter()
        .map(|theta| {
            if stop.load(Ordering::Relaxed) {
                return None;
            }
            let history = one(&simulator, theta, jacobian);
            done.fetch_add(1, Ordering::Relaxed);
            Some(history)
        })
        .collect();
    let found = found.ok_or(Unable::Stopped)?;
    let mut places = Places::default();
    for o in &measured.data.observations {
        places.test.push(measured.data.tests[o.test].clone());
        places.member.push(o.member.name().to_owned());
        places.cycles.push(o.cycles);
        places.quantity.push(o.quantity.name().to_owned());
        places.position.push(o.position);
        places.value.push(o.value);
        places.sigma.push(o.sigma);
    }
    Ok((places, found))
}

fn one(simulator: &Simulator<'_>, theta: &[f64], jacobian: bool) -> History {
    for (parameter, value) in simulator.parameters().iter().zip(theta) {
        if !(parameter.lower..=parameter.upper).contains(value) {
            return Err(format!(
                "{} = {value} is out of range, allowed: {} to {}",
                parameter.name, parameter.lower, parameter.upper
            ));
        }
    }
    let at = Place::common(theta);
    let told = |error: PredictError| error.to_string();
    if jacobian {
        let (rows, derivatives) = simulator.rows_with_derivatives(&at).map_err(told)?;
        // row by row
        Ok((rows, derivatives.transpose().as_slice().to_vec()))
    } else {
        Ok((simulator.rows(&at, None).map_err(told)?, Vec::new()))
    }
}
