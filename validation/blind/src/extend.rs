//! More tests of a set that is there: its gears, its causes and its k, under other conditions.

use std::error::Error;
use std::fs;
use std::path::Path;
use std::str::FromStr;

use clap::ValueEnum;
use serde_json::Value;

use crate::bench;
use crate::dice::Dice;
use crate::files;
use crate::hidden::Conditions;
use crate::laws::Law;
use crate::make::{self, DataSet, Kind, Wish};
use crate::observe::Quantity;
use crate::rig::Plan;
use crate::trace::Trace;

/// Conditions of a test that is to be made.
#[derive(Debug, Clone)]
pub struct Test {
    torque: f64,
    speed: f64,
    misalignment: f64,
    cycles: f64,
}

impl FromStr for Test {
    type Err = String;

    /// From `torque,speed,misalignment,cycles`: Nm, rpm, mm.
    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text
            .split(',')
            .map(|n| n.trim().parse::<f64>().map_err(|e| e.to_string()));
        let numbers: Vec<f64> = numbers.collect::<Result<_, String>>()?;
        let [torque, speed, misalignment, cycles] = numbers[..] else {
            return Err("torque,speed,misalignment,cycles".to_owned());
        };
        Ok(Self {
            torque,
            speed,
            misalignment,
            cycles,
        })
    }
}

/// The set in `folder` with more tests.
///
/// # Errors
/// No answer in the folder, or the set made again is another one.
pub fn extend(folder: &Path, tests: &[Test]) -> Result<DataSet, Box<dyn Error>> {
    let mut set = make::make(&wish(folder)?);
    if fs::read_to_string(folder.join("measurements.csv"))? != files::table(&set, &set.rows) {
        return Err(format!("{}: this program makes another set of it", folder.display()).into());
    }
    for (i, test) in tests.iter().enumerate() {
        measure(&mut set, test, i as u64);
    }
    Ok(set)
}

fn wish(folder: &Path) -> Result<Wish, Box<dyn Error>> {
    let truth: Value = serde_json::from_str(&fs::read_to_string(folder.join("truth.json"))?)?;
    let number = |key: &str| truth[key].as_u64().ok_or(format!("no {key} in truth.json"));
    let class = truth["class"].as_str().unwrap_or_default();
    Ok(Wish {
        seed: number("seed")?,
        index: number("index")?,
        kind: Some(Kind::named(class).ok_or(format!("class {class}"))?),
        noise: None,
        paper: None,
        law: None,
        outlier: false,
        missing: 0.0,
        understate: 1.0,
        messy: false,
        rivals: false,
        trace: truth["trace"]
            .as_str()
            .and_then(|t| Trace::from_str(t, false).ok()),
        stated: truth["stated"].as_bool(),
        mesh: truth["mesh"].as_bool().unwrap_or(false),
        d: truth["wanted_d"].as_f64(),
    })
}

fn measure(set: &mut DataSet, test: &Test, which: u64) {
    let (number, first) = (set.rig.tests.len(), &set.rig.tests[0]);
    let plan = Plan {
        id: char::from(b'A' + number as u8).to_string(),
        conditions: Conditions {
            torque: test.torque,
            speed: test.speed,
            misalignment: test.misalignment,
            ..first.conditions.clone()
        },
        cycles: test.cycles,
        checkpoints: first
            .checkpoints
            .iter()
            .map(|c| (c / first.cycles * test.cycles).round())
            .collect(),
    };
    let mut dice = Dice::new(set.wish.seed)
        .branch(set.wish.index)
        .branch(4242 + which);
    let k = set.k * (set.scatter * dice.normal()).exp();
    let (run, history) = set.rig.run(&plan, k, &set.laws, plan.cycles);
    let weigh = !set.laws.iter().any(Law::moves_material);
    let mut rows = set.rig.rows(&plan, number);
    rows.retain(|r| weigh || r.quantity != Quantity::Mass);
    let values = set.rig.observe(&run, &history, &rows, 1.0);
    bench::sigmas(&mut rows, &values, set.noise);
    make::measure(&mut rows, set.datum, &mut set.datums, &mut dice);
    set.k_tests.push(k);
    set.rows.append(&mut rows);
    set.rig.tests.push(plan);
    for r in &mut set.sealed {
        r.test = set.rig.tests.len();
    }
}
