//! UM-Bridge 1.0: what a request asks, whether it can be asked so, and the answer as JSON.
//!
//! Sources: the protocol's pages and its public conformity test. What that test does is met: a body counts as JSON whatever its content type,
//! `config` may be missing, a model's name is looked at before anything else, and what no model offers is refused before the body is read.

use serde_json::{Value, json};

use super::models::{Config, Kind, Models};
use crate::learn::PredictError;

/// Status and JSON text.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// Status code of HTTP.
    pub status: u16,
    /// One JSON document.
    pub body: String,
}

/// Why there is no answer, by the protocol's names.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
enum Fault {
    #[error("{0}")]
    ModelNotFound(String),
    #[error("{0}")]
    UnsupportedFeature(String),
    #[error("{0}")]
    InvalidInput(String),
    #[error("{0}")]
    InvalidOutput(String),
}

impl Answer {
    /// An error by its name in the protocol.
    pub fn error(status: u16, name: &str, message: &str) -> Self {
        let body = json!({"error": {"type": name, "message": message}});
        Self {
            status,
            body: body.to_string(),
        }
    }
}

impl From<Fault> for Answer {
    fn from(fault: Fault) -> Self {
        let (status, name) = match fault {
            Fault::ModelNotFound(_) => (400, "ModelNotFound"),
            Fault::UnsupportedFeature(_) => (400, "UnsupportedFeature"),
            Fault::InvalidInput(_) => (400, "InvalidInput"),
            Fault::InvalidOutput(_) => (500, "InvalidOutput"),
        };
        Self::error(status, name, &fault.to_string())
    }
}

impl From<PredictError> for Fault {
    fn from(error: PredictError) -> Self {
        Fault::InvalidOutput(error.to_string())
    }
}

/// Answers a request: its method, path and body.
pub fn answer(models: &Models<'_>, method: &str, path: &str, body: &[u8]) -> Answer {
    let path = path.split('?').next().unwrap_or_default();
    let known = match path {
        "/Info" => ["GET", "HEAD"].as_slice(),
        "/ModelInfo" | "/InputSizes" | "/OutputSizes" | "/Evaluate" | "/Gradient"
        | "/ApplyJacobian" | "/ApplyHessian" => &["POST"],
        _ => {
            let message = format!(
                "{path} is not there; ask GET /Info, or POST /ModelInfo, /InputSizes, /OutputSizes, /Evaluate, /Gradient, /ApplyJacobian"
            );
            return Answer::error(404, "InvalidInput", &message);
        }
    };
    if !known.contains(&method) {
        let message = format!("{path} takes {}, not {method}", known[0]);
        return Answer::error(405, "InvalidInput", &message);
    }
    let found = match path {
        "/Info" => Ok(json!({
            "protocolVersion": 1.0,
            "models": Kind::ALL.map(Kind::name),
        })),
        "/ApplyHessian" => Err(Fault::UnsupportedFeature(
            "no model has second derivatives; ModelInfo says what they offer".to_owned(),
        )),
        _ => asked(models, path, body),
    };
    match found {
        Ok(document) => Answer {
            status: 200,
            body: document.to_string(),
        },
        Err(fault) => fault.into(),
    }
}

fn asked(models: &Models<'_>, path: &str, body: &[u8]) -> Result<Value, Fault> {
    let request: Value = serde_json::from_slice(body).map_err(|error| {
        Fault::InvalidInput(format!(
            "the body is no JSON: {error} (numbers are finite: JSON has no NaN and no Infinity)"
        ))
    })?;
    let kind = kind(&request)?;
    match path {
        "/ModelInfo" => Ok(json!({"support": {
            "Evaluate": true, "Gradient": true, "ApplyJacobian": true, "ApplyHessian": false,
        }})),
        "/InputSizes" => Ok(json!({"inputSizes": models.input_sizes(kind)})),
        "/OutputSizes" => Ok(json!({"outputSizes": [models.output_size(kind)]})),
        _ => computed(models, kind, path, &request),
    }
}

/// What takes the model.
fn computed(models: &Models<'_>, kind: Kind, path: &str, request: &Value) -> Result<Value, Fault> {
    let sizes = models.input_sizes(kind);
    let input = arguments(request, "input", &sizes, &models.names())?;
    let config = config(request, &sizes, &models.names(), kind)?;
    if path == "/Evaluate" {
        let output = models.evaluate(kind, &input, &config)?;
        return Ok(json!({"output": [finite(output)?]}));
    }
    if config.along.is_some() {
        return Err(Fault::InvalidInput(
            "config.along is for Evaluate: derivatives are those along a history's own steps"
                .to_owned(),
        ));
    }
    let block = place(request, "inWrt", sizes.len())?;
    place(request, "outWrt", 1)?;
    let gradient = path == "/Gradient";
    let (key, size) = if gradient {
        ("sens", models.output_size(kind))
    } else {
        ("vec", sizes[block])
    };
    let vector = numbers(request.get(key).unwrap_or(&Value::Null), key, size)?;
    let jacobian = models.jacobian(kind, &input, block, &config)?;
    let vector = nalgebra::DVector::from_vec(vector);
    let output = if gradient {
        jacobian.tr_mul(&vector)
    } else {
        jacobian * vector
    };
    Ok(json!({"output": finite(output.as_slice().to_vec())?}))
}

fn kind(request: &Value) -> Result<Kind, Fault> {
    let names = Kind::ALL.map(Kind::name).join(", ");
    let Some(name) = request.get("name").and_then(Value::as_str) else {
        return Err(Fault::ModelNotFound(format!(
            "the request names no model; \"name\" is one of {names}"
        )));
    };
    let known = Kind::ALL.into_iter().find(|kind| kind.name() == name);
    known.ok_or_else(|| {
        Fault::ModelNotFound(format!("there is no model {name:?}; there are {names}"))
    })
}

fn place(request: &Value, key: &str, count: usize) -> Result<usize, Fault> {
    let found = request.get(key).and_then(Value::as_u64);
    let found = found.and_then(|place| usize::try_from(place).ok());
    found.filter(|place| *place < count).ok_or_else(|| {
        let found = request.get(key).unwrap_or(&Value::Null);
        Fault::InvalidInput(format!(
            "{key} is {found}; it is a number from 0 to {}",
            count - 1
        ))
    })
}

/// Blocks of numbers of these sizes.
fn arguments(
    request: &Value,
    key: &str,
    sizes: &[usize],
    names: &[Vec<String>],
) -> Result<Vec<Vec<f64>>, Fault> {
    let wanted = || {
        let each = sizes.iter().zip(names);
        let blocks: Vec<String> = each
            .map(|(size, names)| format!("{size} ({})", names.join(", ")))
            .collect();
        blocks.join(" and ")
    };
    let blocks = request.get(key).and_then(Value::as_array);
    let blocks = blocks.filter(|blocks| blocks.len() == sizes.len());
    let Some(blocks) = blocks else {
        return Err(Fault::InvalidInput(format!(
            "{key} is a list of {} list{} of numbers: {}",
            sizes.len(),
            if sizes.len() == 1 { "" } else { "s" },
            wanted()
        )));
    };
    let each = blocks.iter().zip(sizes).enumerate();
    each.map(|(i, (block, &size))| numbers(block, &format!("{key}[{i}]"), size))
        .collect::<Result<_, _>>()
        .map_err(|fault| match fault {
            Fault::InvalidInput(message) => {
                Fault::InvalidInput(format!("{message}; {key} holds {}", wanted()))
            }
            other => other,
        })
}

fn numbers(list: &Value, name: &str, size: usize) -> Result<Vec<f64>, Fault> {
    let Some(list) = list.as_array() else {
        return Err(Fault::InvalidInput(format!(
            "{name} is no list of {size} numbers"
        )));
    };
    if list.len() != size {
        return Err(Fault::InvalidInput(format!(
            "{name} has {} numbers, not {size}",
            list.len()
        )));
    }
    let each = list.iter().enumerate();
    each.map(|(i, value)| {
        let number = value.as_f64().filter(|number| number.is_finite());
        number
            .ok_or_else(|| Fault::InvalidInput(format!("{name}[{i}] is {value}, no finite number")))
    })
    .collect()
}

fn config(
    request: &Value,
    sizes: &[usize],
    names: &[Vec<String>],
    kind: Kind,
) -> Result<Config, Fault> {
    let mut config = Config::default();
    let object = match request.get("config") {
        None | Some(Value::Null) => return Ok(config),
        Some(Value::Object(object)) => object,
        Some(other) => {
            return Err(Fault::InvalidInput(format!("config is {other}, no object")));
        }
    };
    for (key, value) in object {
        match (key.as_str(), value) {
            ("standardised", Value::Bool(on)) if kind.is_density() => config.standardised = *on,
            ("along", value) if !value.is_null() => {
                let wrapped = json!({"along": value});
                config.along = Some(arguments(&wrapped, "along", sizes, names)?);
            }
            ("along", _) => {}
            ("standardised", _) => {
                return Err(Fault::InvalidInput(
                    "config.standardised is true or false, for log_likelihood and log_posterior; \
                     the model standardised is it always, forward never"
                        .to_owned(),
                ));
            }
            // others are for other servers that the same client asks
            _ => {}
        }
    }
    Ok(config)
}

/// Numbers that JSON can hold.
fn finite(values: Vec<f64>) -> Result<Vec<f64>, Fault> {
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(values),
        Some(row) => Err(Fault::InvalidOutput(format!(
            "value {row} (from 0) of the answer is not finite"
        ))),
    }
}
