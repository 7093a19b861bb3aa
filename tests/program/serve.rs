//! Claim: `gearwear serve` speaks UM-Bridge 1.0, its numbers are the model's, its gradients are those of its numbers, and neither wrong nor
//! many requests end it.
//!
//! Sources: the protocol's public conformity test, of which every request is made here over plain TCP; central differences of the server's own
//! answers along the same wear steps (tolerance 1e-4 of the largest derivative); `gearwear synthesize` for the rows at the study's own values
//! (five of the standard deviations that are left without noise). Priors: their formulas.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, ChildStderr, Command, Stdio};
use std::time::Duration;

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::common::{gears, succeed};

/// Two tests with the analytic contact: running-in has a clock, so that steps are chosen anew at every value.
const STUDY: &str = concat!(
    "title = \"served\"\n",
    gears!("centre_distance = 80.0\n"),
    "\
[operation]
torque = 100.0
speed = 2000.0
[wear]
coefficient = 3e-10
cycles = 400000
[model]
contact = \"hertz\"
[fit]
free = [\"wear.coefficient\", \"running_in.amplitude\", \"running_in.decay_cycles\"]
[numerics]
elements_per_half_width = 2
positions = 24
[[effect]]
kind = \"running_in\"
amplitude = 3.0
decay_cycles = 1e5
[[test]]
id = \"A\"
[[test]]
id = \"B\"
torque = 150.0
"
);

/// A server of a study with measurements of its own model.
struct Server {
    child: Child,
    address: String,
    // the pipe stays open
    _err: BufReader<ChildStderr>,
    home: TempDir,
}

impl Server {
    fn start(study: &str) -> Self {
        let home = tempfile::tempdir().unwrap();
        std::fs::write(home.path().join("study.toml"), study).unwrap();
        succeed(&home, "synthesize study.toml -o made --noise 0.02");
        let mut child = Command::new(assert_cmd::cargo::cargo_bin!("gearwear"))
            .current_dir(&home)
            .args(["serve", "made/study.toml", "--port", "0"])
            .stderr(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut err = BufReader::new(child.stderr.take().unwrap());
        let mut line = String::new();
        err.read_line(&mut line).unwrap();
        let address = line
            .split("http://")
            .nth(1)
            .unwrap_or_else(|| panic!("{line}"));
        let address = address.split_whitespace().next().unwrap().to_owned();
        Self {
            child,
            address,
            _err: err,
            home,
        }
    }

    /// The bytes of a request, and all that comes back until the connection ends; nothing more is `sent` behind them.
    fn raw(&self, bytes: &[u8], sent: bool) -> String {
        let mut stream = TcpStream::connect(&self.address).unwrap();
        stream
            .set_read_timeout(Some(Duration::from_secs(60)))
            .unwrap();
        // a server that refuses may close before all is sent
        let _ = stream.write_all(bytes);
        if sent {
            let _ = stream.shutdown(std::net::Shutdown::Write);
        }
        let mut answer = Vec::new();
        let _ = stream.read_to_end(&mut answer);
        String::from_utf8_lossy(&answer).into_owned()
    }

    fn request(&self, method: &str, path: &str, body: &str) -> (u16, Value) {
        // no content type: the conformity test sends none that says JSON
        let text = format!(
            "{method} {path} HTTP/1.1\r\nHost: x\r\nConnection: close\r\nContent-Length: {}\r\n\r\n{body}",
            body.len()
        );
        let answer = self.raw(text.as_bytes(), false);
        let status = answer.split(' ').nth(1).unwrap_or_default();
        let status = status.parse().unwrap_or_else(|_| panic!("{answer:?}"));
        let body = answer.split("\r\n\r\n").nth(1).unwrap_or_default();
        (status, serde_json::from_str(body).unwrap_or(Value::Null))
    }

    fn post(&self, path: &str, body: &Value) -> (u16, Value) {
        self.request("POST", path, &body.to_string())
    }

    fn output(&self, path: &str, body: &Value) -> Value {
        let (status, answer) = self.post(path, body);
        assert_eq!(status, 200, "{path} {body}: {answer}");
        answer["output"].clone()
    }

    fn evaluate(&self, model: &str, input: &Value, config: &Value) -> Vec<f64> {
        let body = json!({"name": model, "input": input, "config": config});
        numbers(&self.output("/Evaluate", &body)[0])
    }

    fn error(&self, path: &str, body: &Value) -> (u16, String, String) {
        let (status, answer) = self.post(path, body);
        let of = |key: &str| answer["error"][key].as_str().unwrap_or_default().to_owned();
        let keys: Vec<&String> = answer.as_object().unwrap().keys().collect();
        assert_eq!(keys, ["error"], "{answer}");
        (status, of("type"), of("message"))
    }

    fn sizes(&self, path: &str, key: &str, model: &str) -> Vec<usize> {
        let (status, answer) = self.post(path, &json!({"name": model}));
        assert_eq!(status, 200);
        serde_json::from_value(answer[key].clone()).unwrap()
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn numbers(value: &Value) -> Vec<f64> {
    serde_json::from_value(value.clone()).unwrap_or_else(|_| panic!("{value}"))
}

const MODELS: [&str; 4] = ["standardised", "forward", "log_likelihood", "log_posterior"];

/// What the public conformity test asks, of every model.
#[test]
fn it_conforms() {
    let server = Server::start(STUDY);
    let (status, info) = server.request("GET", "/Info", "");
    assert_eq!(status, 200);
    assert_eq!(info["protocolVersion"], json!(1.0));
    assert_eq!(info["models"], json!(MODELS));
    assert!(
        server
            .raw(
                b"HEAD / HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n",
                false
            )
            .starts_with("HTTP/1.1 ")
    );
    for model in MODELS {
        let (status, about) = server.post("/ModelInfo", &json!({"name": model}));
        assert_eq!(status, 200);
        let support = json!({"Evaluate": true, "Gradient": true, "ApplyJacobian": true, "ApplyHessian": false});
        assert_eq!(about, json!({"support": support}));
        let inputs = server.sizes("/InputSizes", "inputSizes", model);
        let outputs = server.sizes("/OutputSizes", "outputSizes", model);
        let filled = |more: usize| -> Value {
            let blocks = inputs.iter().map(|&n| vec![0.0; n + more]);
            json!(blocks.collect::<Vec<_>>())
        };
        let values = server.evaluate(model, &filled(0), &json!({}));
        assert_eq!(vec![values.len()], outputs, "{model}");
        let wrong = json!({"name": model, "input": filled(1), "config": {}});
        let (status, kind, _) = server.error("/Evaluate", &wrong);
        assert_eq!((status, kind.as_str()), (400, "InvalidInput"));
        let with = |input: Value, out: usize, inwrt: usize| {
            json!({"name": model, "input": input, "config": {}, "outWrt": out, "inWrt": inwrt,
                   "sens": vec![0.0; outputs[0]], "vec": vec![0.0; inputs[0]]})
        };
        let gradient = numbers(&server.output("/Gradient", &with(filled(0), 0, 0)));
        assert_eq!(gradient.len(), inputs[0]);
        let moved = numbers(&server.output("/ApplyJacobian", &with(filled(0), 0, 0)));
        assert_eq!(moved.len(), outputs[0]);
        for wrong in [
            with(filled(1), 0, 0),
            with(filled(0), 0, inputs.len()),
            with(filled(0), 1, 0),
        ] {
            let (status, kind, _) = server.error("/Gradient", &wrong);
            assert_eq!((status, kind.as_str()), (400, "InvalidInput"), "{wrong}");
        }
        for body in [json!({"name": model}), with(filled(0), 0, 0)] {
            let (status, kind, _) = server.error("/ApplyHessian", &body);
            assert_eq!((status, kind.as_str()), (400, "UnsupportedFeature"));
        }
    }
    for path in ["/Evaluate", "/ModelInfo", "/InputSizes", "/Gradient"] {
        let (status, kind, message) = server.error(path, &json!({"name": "wrong_model_name"}));
        assert_eq!((status, kind.as_str()), (400, "ModelNotFound"));
        assert!(message.contains("log_posterior"), "{message}");
    }
}

#[test]
fn gradients_are_those_of_the_answers() {
    let server = Server::start(STUDY);
    let decay = 1e5;
    // a place where nothing is at a bound and the data pull
    let physical = [2.7e-10, 2.2, 1.3 * decay];
    let scatter = vec![0.1, 0.4, -0.3];
    for (model, standardised) in [
        ("standardised", true),
        ("forward", false),
        ("log_likelihood", false),
        ("log_posterior", false),
        ("log_likelihood", true),
        ("log_posterior", true),
    ] {
        let config = if standardised && model.starts_with("log") {
            json!({"standardised": true})
        } else {
            json!({})
        };
        let first = if standardised {
            vec![-0.03, -0.2, 0.15]
        } else {
            physical.to_vec()
        };
        let inputs = server.sizes("/InputSizes", "inputSizes", model);
        let input: Vec<Vec<f64>> = [first, scatter.clone()][..inputs.len()].to_vec();
        let count = server.sizes("/OutputSizes", "outputSizes", model)[0];
        let mut along = config.clone();
        along["along"] = json!(input);
        // all rows with weights of both signs
        let sens: Vec<f64> = (0..count).map(|i| (1.0 + i as f64).sin()).collect();
        for block in 0..inputs.len() {
            let body = json!({"name": model, "input": input, "config": config, "outWrt": 0, "inWrt": block, "sens": sens});
            let gradient = numbers(&server.output("/Gradient", &body));
            let mut jacobian = vec![0.0; inputs[block]];
            for (i, slope) in jacobian.iter_mut().enumerate() {
                let size = if standardised || block == 1 {
                    1e-5
                } else {
                    1e-5 * physical[i]
                };
                let at = |sign: f64| -> f64 {
                    let mut moved = input.clone();
                    moved[block][i] += sign * size;
                    let rows = server.evaluate(model, &json!(moved), &along);
                    rows.iter()
                        .zip(&sens)
                        .map(|(value, weight)| value * weight)
                        .sum()
                };
                *slope = (at(1.0) - at(-1.0)) / (2.0 * size);
                let mut vector = vec![0.0; inputs[block]];
                vector[i] = 1.0;
                let body = json!({"name": model, "input": input, "config": config, "outWrt": 0, "inWrt": block, "vec": vector});
                let column = numbers(&server.output("/ApplyJacobian", &body));
                let summed: f64 = column.iter().zip(&sens).map(|(d, w)| d * w).sum();
                let off = (summed - gradient[i]).abs();
                assert!(
                    off <= 1e-9 * gradient[i].abs(),
                    "{model} {block} {i}: J and its transpose"
                );
            }
            // each derivative on the scale of its own parameter
            let scale = |i: usize| {
                if standardised || block == 1 {
                    1.0
                } else {
                    physical[i]
                }
            };
            let largest = (0..jacobian.len()).map(|i| (gradient[i] * scale(i)).abs());
            let largest = largest.fold(0.0, f64::max);
            for i in 0..jacobian.len() {
                let off = (jacobian[i] - gradient[i]).abs() * scale(i);
                assert!(
                    off < 1e-4 * largest,
                    "{model} {config} block {block}: {gradient:?} against {jacobian:?}"
                );
            }
        }
    }
}

#[test]
fn its_numbers_are_the_models() {
    let server = Server::start(STUDY);
    // rows at the study's own values, without noise
    succeed(&server.home, "synthesize study.toml -o exact --noise 0");
    let table = std::fs::read_to_string(server.home.path().join("exact/measurements.csv")).unwrap();
    let rows = table.lines().filter(|line| !line.starts_with('#')).skip(1);
    let text: Vec<Vec<&str>> = rows.map(|line| line.split(',').collect()).collect();
    let zero = server.evaluate("standardised", &json!([[0.0, 0.0, 0.0]]), &json!({}));
    let own = json!([[3e-10, 3.0, 1e5]]);
    assert_eq!(zero, server.evaluate("forward", &own, &json!({})));
    // along its own steps the same but for the rounding of their lengths
    let along = server.evaluate("forward", &own, &json!({"along": own}));
    let off = (zero.iter().zip(&along)).map(|(a, b)| (a - b).abs());
    let largest = zero.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    assert!(off.fold(0.0, f64::max) < 1e-12 * largest);
    assert_eq!(zero.len(), text.len());
    // twice the coefficient is not twice the wear with a clock, but more; bounds hold
    let more = server.evaluate("forward", &json!([[6e-10, 3.0, 1e5]]), &json!({}));
    let mut compared = 0;
    for ((row, value), more) in text.iter().zip(&zero).zip(&more) {
        if row[3] == "mass_loss" {
            // the noise of an instrument that measures nothing is left in the table
            let [stated, sigma] = [5, 6].map(|column| row[column].parse::<f64>().unwrap());
            assert!((value - stated).abs() < 5.0 * sigma, "{row:?} {value}");
            assert!(sigma < 0.1 * stated, "{row:?}");
            assert!(more > value);
            compared += 1;
        }
    }
    assert!(compared >= 8, "{compared}");
    // posterior = likelihood + prior; the prior of the scatter: half-normal 0.25 and normals; k: log-normal 3.2e-10, factor 18
    let input = |k: f64| json!([[k, 3.0, 1e5], [0.2, 1.0, -0.5]]);
    let prior = |k: f64| {
        let posterior = server.evaluate("log_posterior", &input(k), &json!({}))[0];
        posterior - server.evaluate("log_likelihood", &input(k), &json!({}))[0]
    };
    let density = |k: f64| -0.5 * ((k / 3.2e-10).ln() / 18f64.ln()).powi(2) - k.ln();
    let found = prior(4e-10) - prior(2e-10);
    let exact = density(4e-10) - density(2e-10);
    assert!((found - exact).abs() < 1e-6, "{found} {exact}");
    // beyond the bounds the density is 0
    let outside = json!([[-1.0, 3.0, 1e5], [0.2, 1.0, -0.5]]);
    assert_eq!(
        server.evaluate("log_posterior", &outside, &json!({})),
        [f64::MIN]
    );
    let negative = json!([[3e-10, 3.0, 1e5], [-0.2, 1.0, -0.5]]);
    assert_eq!(
        server.evaluate("log_likelihood", &negative, &json!({})),
        [f64::MIN]
    );
}

#[test]
fn wrong_and_many_requests_leave_it_alive_and_right() {
    let mut server = Server::start(STUDY);
    let input = json!([[0.3, -0.2, 0.1]]);
    let right = server.evaluate("standardised", &input, &json!({}));
    let bodies = [
        "",
        "{",
        "[]",
        "null",
        "nan",
        "{\"name\": 3}",
        "{\"name\": \"forward\"}",
        "{\"name\": \"forward\", \"input\": 3}",
        "{\"name\": \"forward\", \"input\": [[NaN, 1, 1]]}",
        "{\"name\": \"forward\", \"input\": [[1e999, 1, 1]]}",
        "{\"name\": \"forward\", \"input\": [[\"1\", 1, 1]]}",
        "{\"name\": \"forward\", \"input\": [[1, 1, 1], [1]]}",
        "{\"name\": \"forward\", \"input\": [[1, 1, 1]], \"config\": 3}",
        "{\"name\": \"forward\", \"input\": [[1, 1, 1]], \"config\": {\"along\": [[1]]}}",
        "{\"name\": \"log_posterior\", \"input\": [[1, 1, 1], [0, 0, 0]], \"config\": {\"standardised\": 1}}",
        "\u{0}\u{1}",
    ];
    let paths = ["/Evaluate", "/Gradient", "/ApplyJacobian"];
    for (i, body) in bodies.iter().cycle().take(600).enumerate() {
        let (status, answer) = server.request("POST", paths[i % 3], body);
        assert_eq!(status, 400, "{body}: {answer}");
        assert!(
            answer["error"]["message"]
                .as_str()
                .is_some_and(|m| !m.is_empty()),
            "{answer}"
        );
    }
    let heads: [&[u8]; 8] = [
        b"\r\n\r\n",
        b"GET\r\n\r\n",
        b"POST /Evaluate HTTP/1.1\r\nContent-Length: -3\r\n\r\n",
        b"POST /Evaluate HTTP/9.9\r\n\r\n",
        b"POST /Evaluate HTTP/1.1\r\nHost: x\r\nContent-Length: 100\r\n\r\n{",
        b"\xff\xfe\xfd",
        b"GET /../../etc/passwd HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n",
        b"DELETE /Info HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n",
    ];
    for bytes in heads.iter().cycle().take(400) {
        let answer = server.raw(bytes, true);
        assert!(!answer.starts_with("HTTP/1.1 2"), "{bytes:?}: {answer}");
    }
    let large = format!("{{\"name\": \"{}\"}}", "x".repeat(2 << 20));
    let refused = server.raw(
        format!("POST /Evaluate HTTP/1.1\r\nHost: x\r\nConnection: close\r\nContent-Length: {}\r\n\r\n{large}", large.len()).as_bytes(),
        false,
    );
    assert!(
        refused.is_empty() || refused.starts_with("HTTP/1.1 413"),
        "{refused}"
    );
    // a silent client holds nobody up
    let silent = TcpStream::connect(&server.address).unwrap();
    std::thread::scope(|scope| {
        let asked: Vec<_> = (0..50)
            .map(|_| scope.spawn(|| server.evaluate("standardised", &input, &json!({}))))
            .collect();
        for one in asked {
            assert_eq!(
                one.join().unwrap(),
                right,
                "bits depend on what else is asked"
            );
        }
    });
    drop(silent);
    // asked to end it ends, and says so
    let id = server.child.id().to_string();
    assert!(
        Command::new("kill")
            .args(["-TERM", &id])
            .status()
            .unwrap()
            .success()
    );
    let status = server.child.wait().unwrap();
    assert_eq!(status.code(), Some(0));
    assert!(TcpStream::connect(&server.address).is_err());
}

#[test]
fn what_cannot_be_served_is_said() {
    let home = tempfile::tempdir().unwrap();
    std::fs::write(home.path().join("study.toml"), STUDY).unwrap();
    let (code, _, err) = crate::common::line(&home, "serve study.toml --port 0");
    assert_eq!(code, Some(2), "{err}");
    assert!(err.contains("[measurements]"), "{err}");
    succeed(&home, "synthesize study.toml -o made");
    let text = std::fs::read_to_string(home.path().join("made/study.toml")).unwrap();
    let start = text.find("free = [").unwrap();
    let end = start + text[start..].find(']').unwrap() + 1;
    let nothing = format!("{}free = []{}", &text[..start], &text[end..]);
    std::fs::write(home.path().join("made/nothing.toml"), nothing).unwrap();
    let (code, _, err) = crate::common::line(&home, "serve made/nothing.toml --port 0");
    assert_eq!(code, Some(2), "{err}");
    let taken = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    let (code, _, err) =
        crate::common::gearwear(&home, &["serve", "made/study.toml", "--port", &port]);
    assert_eq!(code, Some(2), "{err}");
    assert!(err.contains("--port"), "{err}");
    let output = assert_cmd::Command::cargo_bin("gearwear")
        .unwrap()
        .current_dir(&home)
        .env("PORT", "eighty")
        .args(["serve", "made/study.toml"])
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("PORT"));
}

/// A history that cannot be computed is the model's failure, not the request's, and the server goes on.
#[test]
fn what_cannot_be_computed_is_an_invalid_output() {
    // no number from 250 000 cycles on where a is 4
    let formula = "kind = \"formula\"\nname = \"f\"\nwear_factor = \"sqrt(1 - a*cycles/1e6)\"\n\
                   parameters = { a = { value = 0.5, lower = 0, upper = 4 } }\n";
    let running_in = "kind = \"running_in\"\namplitude = 3.0\ndecay_cycles = 1e5\n";
    assert!(STUDY.contains(running_in));
    let free = "\"running_in.amplitude\", \"running_in.decay_cycles\"";
    let study = STUDY.replace(running_in, formula).replace(free, "\"f.a\"");
    let server = Server::start(&study);
    let of = |a: f64| json!({"name": "forward", "input": [[3e-10, a]], "config": {}});
    let (status, answer) = server.post("/Evaluate", &of(4.0));
    let name = &answer["error"]["type"];
    assert_eq!((status, name), (500, &json!("InvalidOutput")));
    assert!(
        answer["error"]["message"]
            .as_str()
            .is_some_and(|said| !said.is_empty())
    );
    assert_eq!(server.post("/Evaluate", &of(0.5)).0, 200);
}
