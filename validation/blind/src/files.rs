//! A data set on disk: what a user would have, and beside it the answer.

use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::Path;

use serde_json::{Value, json};

use crate::make::DataSet;
use crate::messy;
use crate::observe::{Quantity, Row};
use crate::rig::Plan;
use crate::trace::{Column, Trace};

pub fn name(set: &DataSet) -> String {
    name_of(set.wish.seed, set.wish.index)
}

pub fn name_of(seed: u64, index: u64) -> String {
    format!("s{seed}_{index:04}")
}

pub fn write(set: &DataSet, folder: &Path) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    fs::write(folder.join("study.toml"), study(set))?;
    fs::write(folder.join("measurements.csv"), table(set, &set.rows))?;
    let role = "role = \"holdout\"\n";
    fs::write(folder.join("sealed.toml"), test(&set.rig.sealed, role))?;
    fs::write(folder.join("sealed.csv"), table(set, &set.sealed))?;
    // Last: a folder with an answer is complete.
    let text = serde_json::to_string(&truth(set))?;
    fs::write(folder.join("truth.json"), text)
}

fn test(p: &Plan, role: &str) -> String {
    let c = &p.conditions;
    format!(
        "[[test]]\nid = \"{}\"\n{role}torque = {:?}\nspeed = {:?}\nmisalignment = {:?}\ncycles = {:?}\n",
        p.id, c.torque, c.speed, c.misalignment, p.cycles
    )
}

fn study(set: &DataSet) -> String {
    let rig = &set.rig;
    let c = &rig.tests[0].conditions;
    let mut s = String::new();
    let mut put = |text: String| s.push_str(&text);
    put(format!(
        "title = \"measured gear pair\"\n\n[gears]\nmodule = {:?}\npressure_angle = 20.0\nface_width = {:?}\ncentre_distance = {:?}\naddendum = 1.0\ndedendum = 1.25\nfillet_radius = 0.38\n",
        rig.pinion.m, rig.width, rig.centre
    ));
    for (name, t) in [("pinion", &rig.pinion), ("gear", &rig.gear)] {
        put(format!(
            "\n[gears.{name}]\nteeth = {}\nprofile_shift = {:?}\nthickness_reduction = 0.0\nbore_diameter = {:?}\ntip_relief_amount = 0.0\ntip_relief_length = 0.0\n",
            t.z,
            t.x,
            2.0 * t.bore
        ));
    }
    put(format!(
        "\n[material]\nyoungs_modulus = {:?}\npoisson_ratio = 0.3\ndensity = 7850.0\n\n[lubricant]\nviscosity = {:?}\npressure_viscosity = {:?}\nroughness = {:?}\nfriction_coefficient = {:?}\n",
        rig.youngs, c.viscosity, c.pressure_viscosity, c.roughness, c.friction
    ));
    put(format!(
        "\n[thermal]\nbulk_temperature = {:?}\nconductivity = 46.0\nspecific_heat = 470.0\n\n[operation]\ntorque = {:?}\nspeed = {:?}\nmisalignment = 0.0\n\n[wear]\ncoefficient = {:e}\ncycles = {:?}\n\n[model]\ncontact = \"fem\"\n\n",
        c.bulk, c.torque, c.speed, set.k_study, rig.tests[0].cycles
    ));
    for p in &rig.tests {
        put(test(p, "role = \"fit\"\n"));
        put("\n".into());
    }
    if set.wish.messy {
        put(format!(
            "[noise]\ntrace_tilt = {:?}\ntrace_shift = {:?}\noutliers = \"robust\"\n\n",
            messy::TILT,
            messy::SHIFT
        ));
    }
    put("[measurements]\nfile = \"measurements.csv\"\n".into());
    s
}

pub fn table(set: &DataSet, rows: &[Row]) -> String {
    let mut s = String::from("test,member,cycles,quantity,position,value,sigma,trace");
    s.extend(set.column.name().map(|name| format!(",{name}")));
    s.push('\n');
    for r in rows {
        let id = set.rig.tests.get(r.test).map_or("S", |p| p.id.as_str());
        let member = ["pinion", "gear", "pair"][r.member];
        let position = match r.quantity {
            Quantity::Depth | Quantity::Share => r.position.map(|x| format!("{x:.3}")),
            _ => r.position.map(|x| format!("{x:.4}")),
        };
        // Names of traces without a datum are the program's own.
        let trace = if r.trace.contains('@') { "" } else { &r.trace };
        // Writing to a string cannot fail.
        let _ = write!(
            s,
            "{id},{member},{:.0},{},{},{:.4},{:.4},{trace}",
            r.cycles,
            r.quantity.name(),
            position.unwrap_or_default(),
            r.value,
            r.sigma,
        );
        s.extend(set.column.cell(r, set.rig.width).map(|c| format!(",{c}")));
        s.push('\n');
    }
    s
}

fn truth(set: &DataSet) -> Value {
    let effects: Vec<Value> = set
        .laws
        .iter()
        .map(|l| {
            let p: serde_json::Map<String, Value> =
                l.parameters.iter().map(|(n, v)| ((*n).to_string(), json!(v))).collect();
            json!({"kind": l.name, "form": l.form, "class": format!("{:?}", l.class).to_lowercase(), "parameters": p, "drivers": l.drivers})
        })
        .collect();
    let round = |v: f64| (v * 1e4).round() / 1e4;
    let top = |m: usize, id: usize| {
        set.rows
            .iter()
            .filter(|r| r.test == id && r.member == m && r.is_depth())
            .map(|r| r.free)
            .fold(0.0, f64::max)
    };
    let deepest: serde_json::Map<String, Value> = set
        .rig
        .tests
        .iter()
        .enumerate()
        .map(|(i, p)| (p.id.clone(), json!([round(top(0, i)), round(top(1, i))])))
        .collect();
    let ks: serde_json::Map<String, Value> = set
        .rig
        .tests
        .iter()
        .zip(&set.k_tests)
        .map(|(p, k)| (p.id.clone(), json!(k)))
        .collect();
    let datums: serde_json::Map<String, Value> = set
        .datums
        .iter()
        .map(|(n, v)| (n.clone(), json!(v)))
        .collect();
    json!({
        "name": name(set),
        "seed": set.wish.seed,
        "index": set.wish.index,
        "class": set.kind.name(),
        "effects": effects,
        "kinds": set.laws.iter().map(|l| l.name).collect::<Vec<_>>(),
        "noise": set.noise,
        "gear": if set.rig.paper { "paper" } else { "random" },
        "d": set.d,
        "d_each": set.d_each,
        "k_true": set.k,
        "k_study": set.k_study,
        "k_tests": ks,
        "coefficient_scatter": set.scatter,
        "datum_sd_um": set.datum,
        "datums_um": datums,
        "trace": set.trace.map(Trace::name),
        "stated": set.column != Column::None,
        "mesh": set.rig.mesh,
        "wanted_d": set.wish.d,
        "messy": set.wish.messy,
        "outlier": set.wish.outlier,
        "missing": set.wish.missing,
        "sigma_understated_by": set.wish.understate,
        "max_depth_um": deepest,
        "attempts": set.attempts,
        "rivals": set.rivals.iter().map(|r| json!({"name": r.name, "form": r.form, "share": round(r.share), "left_chi2": round(r.left)})).collect::<Vec<_>>(),
        "noise_free": set.rows.iter().map(|r| round(r.free)).collect::<Vec<_>>(),
    })
}
