//! The library for Python: what `gearwear/__init__.py` builds on. Numbers come and go as the bytes of doubles in native order.

mod simulate;

use std::ffi::OsString;
use std::path::Path;

use gearwear::study::{Study, StudyError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Python's exception for a study, with its place.
fn raised(py: Python<'_>, error: &StudyError) -> PyErr {
    let raise = || -> PyResult<PyErr> {
        let class = py.import("gearwear._errors")?.getattr("StudyError")?;
        let diagnostic = error.diagnostic();
        let (line, column) = error.position().unzip();
        let known = PyDict::new(py);
        known.set_item("file", error.file())?;
        known.set_item("line", line)?;
        known.set_item("column", column)?;
        known.set_item("key", &diagnostic.key)?;
        known.set_item("found", &diagnostic.found)?;
        known.set_item("allowed", &diagnostic.allowed)?;
        Ok(PyErr::from_value(
            class.call((error.to_string(),), Some(&known))?,
        ))
    };
    raise().unwrap_or_else(|other| other)
}

/// Python's exception for anything else, with the program's exit code.
fn failed(py: Python<'_>, message: &str, code: u8) -> PyErr {
    let raise = || -> PyResult<PyErr> {
        let class = py.import("gearwear._errors")?.getattr("GearwearError")?;
        Ok(PyErr::from_value(class.call1((message, code))?))
    };
    raise().unwrap_or_else(|other| other)
}

/// Runs the program; the first argument is its name.
#[pyfunction]
fn main(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| gearwear::cli::run(arguments))
}

/// Checks a study's text; `name` is its file.
#[pyfunction]
fn check(py: Python<'_>, text: &str, name: &str) -> PyResult<()> {
    Study::parse(text, name).map_err(|error| raised(py, &error))?;
    Ok(())
}

/// The study's text with one key changed to a value as TOML writes it.
#[pyfunction]
fn put(py: Python<'_>, text: &str, name: &str, key: &str, value: &str) -> PyResult<String> {
    let raise = |error: StudyError| raised(py, &error);
    let study = Study::parse(text, name).map_err(raise)?;
    let mut edit = study.edit();
    if study.effect_model().parameter(key).is_some() || key == "wear.coefficient" {
        let number = value
            .parse::<f64>()
            .map_err(|_| failed(py, &format!("{key} takes a number, not {value}"), 2))?;
        edit.set(key, number);
    } else if !edit.put(key, value) {
        let why = format!(
            "{key} cannot be set: it has no table, or one that is written in another form; change the text"
        );
        return Err(failed(py, &why, 2));
    }
    Ok(edit.finish(name).map_err(raise)?.text().to_owned())
}

/// The study's text with relative paths for another folder.
#[pyfunction]
fn moved(py: Python<'_>, text: &str, name: &str, to: &str) -> PyResult<String> {
    let raise = |error: StudyError| raised(py, &error);
    let study = Study::parse(text, name).map_err(raise)?;
    let from = Path::new(name).parent().unwrap_or(Path::new(""));
    let mut edit = study.edit();
    edit.move_between(from, Path::new(to)).map_err(raise)?;
    let file = Path::new(to).join("study.toml");
    Ok(edit
        .finish(&file.display().to_string())
        .map_err(raise)?
        .text()
        .to_owned())
}

#[pymodule]
fn _gearwear(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_function(wrap_pyfunction!(main, module)?)?;
    module.add_function(wrap_pyfunction!(check, module)?)?;
    module.add_function(wrap_pyfunction!(put, module)?)?;
    module.add_function(wrap_pyfunction!(moved, module)?)?;
    module.add_function(wrap_pyfunction!(simulate::simulate, module)?)
}
