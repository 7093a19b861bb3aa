//! Laws learned from measurements with a hidden formula, by the analytic contact model; the last test is held out.

use std::f64::consts::{PI, TAU};
use std::path::{Path, PathBuf};

use gearwear::learn::{GearModel, Measured, Predictor};
use gearwear::measure::Quantity;
use gearwear::simulate::forward::ContactKind;
use gearwear::study::{Law, LearnedLaw, Study};
use serde_json::Value;

/// Random numbers: splitmix64 (Steele, Lea and Flood 2014) and Box and Muller's transform.
struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        let (u, v) = (1.0 - self.uniform(), self.uniform());
        (-2.0 * u.ln()).sqrt() * (2.0 * PI * v).cos()
    }
}

/// A study and its measurements in `folder`: every third depth and every mass loss of the independent layout, k = 5e-10 mm²/N with 5 %
/// scatter, 2 % noise and 0.05 µm, datums of 0.3 µm.
fn study(folder: &Path, factor: &str, seed: u64) -> PathBuf {
    let text = super::BASE
        .replace("contact = \"fem\"", "contact = \"hertz\"")
        .replace("coefficient = 1.41e-10", "coefficient = 5e-10");
    let layout =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("validation/challenges/none_L2/study.toml");
    let hidden = format!(
        "{text}\n[[effect]]\nkind = \"formula\"\nname = \"hidden\"\nwear_factor = \"{factor}\"\n"
    );
    let truth = Study::parse(&hidden, &layout.display().to_string()).unwrap();
    let mut data = truth.dataset().unwrap();
    let mut number = 0;
    data.observations.retain(|o| {
        number += 1;
        o.quantity != Quantity::WearDepth || number % 3 == 0
    });
    let measured = Measured::new(&truth, data.clone());
    let workshop = measured.workshop(ContactKind::Hertz).unwrap();
    let bench = measured.bench(&workshop).unwrap();
    let effects = truth.effect_model();
    let model = GearModel::new(&bench, Box::new(move |_| effects.stated()));
    let mut random = Random(seed);
    let datums: Vec<f64> = data.traces.iter().map(|_| 0.3 * random.normal()).collect();
    for test in 0..data.tests.len() {
        let k = 5e-10 * (0.05 * random.normal()).exp();
        let mut values = model.predict(test, k, &[]).unwrap().into_iter();
        for o in data.observations.iter_mut().filter(|o| o.test == test) {
            o.value = values.next().unwrap();
        }
    }
    let curve =
        |o: &gearwear::measure::Observation| (o.test, o.member, o.quantity, o.cycles.to_bits());
    let exact = data.observations.clone();
    let mut csv = "test,member,cycles,quantity,position,value,sigma,trace\n".to_owned();
    for o in &data.observations {
        let own = exact.iter().filter(|e| curve(e) == curve(o));
        let largest = own.map(|e| e.value.abs()).fold(0.0, f64::max);
        let sigma = 0.02 * largest + 0.05;
        let value = o.value + sigma * random.normal() + o.trace.map_or(0.0, |t| datums[t]);
        csv.push_str(&format!(
            "{},{},{},{},{},{value},{sigma},{}\n",
            data.tests[o.test],
            o.member.name(),
            o.cycles,
            o.quantity.name(),
            o.position.map_or(String::new(), |p| p.to_string()),
            o.trace.map_or(String::new(), |t| t.to_string()),
        ));
    }
    std::fs::write(folder.join("measurements.csv"), csv).unwrap();
    let mut text = text;
    let last = text.rfind("role = \"fit\"").unwrap();
    text.replace_range(last..last + 12, "role = \"holdout\"");
    let path = folder.join("study.toml");
    std::fs::write(&path, text).unwrap();
    path
}

fn gearwear() -> assert_cmd::Command {
    assert_cmd::Command::cargo_bin("gearwear").unwrap()
}

/// What `add` says, and the law that it wrote.
fn learned(path: &Path, name: &str) -> (Value, LearnedLaw) {
    let stem = path.file_stem().unwrap().to_string_lossy();
    let new = path.with_file_name(format!("{stem}+{}.toml", name.replace(':', "-")));
    let output = gearwear()
        .args(["add", "--json", "--quiet", "--force"])
        .arg(path)
        .arg(name)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    let study = Study::load(&new).unwrap();
    assert_eq!(study.effects()[0].name, name);
    let Law::Learned(law) = &study.effects()[0].law else {
        panic!("{:?}", study.effects())
    };
    (serde_json::from_slice(&output.stdout).unwrap(), law.clone())
}

/// χ² per point of the held-out test without and with the law.
fn held_out(said: &Value) -> [f64; 2] {
    let chi2 = |share: &Value| share["chi2_per_point"].as_f64().unwrap();
    [
        chi2(&said["fit"]["without"]["holdout"]),
        chi2(&said["fit"]["holdout"]),
    ]
}

/// Correlation of a law's values with those of the hidden one at its knots from `from` to `to`.
fn likeness(law: &LearnedLaw, [from, to]: [f64; 2], hidden: impl Fn(f64) -> f64) -> f64 {
    let knots = law.law.knots().iter().zip(&law.values);
    let pairs: Vec<[f64; 2]> = knots
        .filter(|(x, _)| (from..=to).contains(*x))
        .map(|(x, v)| [*v, hidden(*x)])
        .collect();
    let mean = |i: usize| pairs.iter().map(|p| p[i]).sum::<f64>() / pairs.len() as f64;
    let [a, b] = [mean(0), mean(1)];
    let sum = |f: &dyn Fn(&[f64; 2]) -> f64| pairs.iter().map(f).sum::<f64>();
    let product = sum(&|p| (p[0] - a) * (p[1] - b));
    product / (sum(&|p| (p[0] - a).powi(2)) * sum(&|p| (p[1] - b).powi(2))).sqrt()
}

#[test]
fn an_unknown_rhythm_is_found_and_predicts_another_test() {
    let folder = tempfile::tempdir().unwrap();
    let path = study(folder.path(), "1 + 0.8*sin(2*pi*cycles/3.3e5)", 7);
    let (said, law) = learned(&path, "learned:cycles");
    let [without, with] = held_out(&said);
    assert!(with < 0.25 * without && with < 1.4, "{without} {with}");
    let fit = said["fit"]["fit"]["chi2_per_point"].as_f64().unwrap();
    assert!((0.85..1.2).contains(&fit), "{fit}");
    let alike = likeness(&law, [0.0, 8e5], |n| {
        (1.0 + 0.8 * (TAU * n / 3.3e5).sin()).ln()
    });
    assert!(alike > 0.85, "{alike} {:?}", law.values);
    // the study that was written says the same
    let output = gearwear()
        .args(["compare", "--json", "--quiet"])
        .arg(path.with_file_name("study+learned-cycles.toml"))
        .output()
        .unwrap();
    assert!(output.status.success());
    let again: Value = serde_json::from_slice(&output.stdout).unwrap();
    let again = again["holdout"]["chi2_per_point"].as_f64().unwrap();
    assert!((again / with - 1.0).abs() < 0.02, "{again} {with}");
}

#[test]
fn a_soft_band_on_one_flank_is_found_where_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = study(
        folder.path(),
        "1 + 1.5*pinion*exp(-((radius-27.2)/0.3)^2)",
        8,
    );
    let (said, law) = learned(&path, "learned:radius:pinion");
    let [without, with] = held_out(&said);
    assert!(with < 0.25 * without && with < 1.4, "{without} {with}");
    let alike = likeness(&law, [25.9, 28.8], |r| {
        (1.0 + 1.5 * (-((r - 27.2) / 0.3).powi(2)).exp()).ln()
    });
    assert!(alike > 0.9, "{alike} {:?}", law.values);
    // on the other flank there is nothing to find that would predict better
    let (said, _) = learned(
        &study(
            folder.path(),
            "1 + 1.5*pinion*exp(-((radius-27.2)/0.3)^2)",
            8,
        ),
        "learned:radius:gear",
    );
    let [without, wrong] = held_out(&said);
    assert!(wrong > 0.5 * without, "{without} {wrong}");
}

/// A smooth curve makes waves of a step, before it and behind: as a formula it is where it was, and predicts the held-out test as well or better.
#[test]
fn a_step_is_offered_as_a_step() {
    let folder = tempfile::tempdir().unwrap();
    let path = study(folder.path(), "1 + 0.3*(1 + tanh((cycles - 4e5)/1e3))", 11);
    let diagnosis = folder.path().join("diagnosed");
    let output = gearwear()
        .args(["diagnose", "--quiet", "-o"])
        .args([&diagnosis, &path])
        .output()
        .unwrap();
    assert!(output.status.success());
    let text = std::fs::read_to_string(diagnosis.join("diagnosis.json")).unwrap();
    let said: Value = serde_json::from_str(&text).unwrap();
    let learned = &said["learned"];
    assert_eq!(learned["name"], "learned:cycles", "{}", said["sentence"]);
    let plain = &learned["plain"];
    assert_eq!(plain["form"], "step", "{plain}");
    let gain = |law: &Value| law["evidence_gain"].as_f64().unwrap();
    assert!(gain(plain) > gain(learned), "{plain}");
    let next = said["next_step"].as_str().unwrap();
    assert!(next.contains("learned:cycles --form step"), "{next}");

    let new = folder.path().join("stepped.toml");
    let output = gearwear()
        .args(["add", "--json", "--quiet"])
        .arg(&path)
        .args(["learned:cycles", "--form", "step", "-o"])
        .arg(&new)
        .output()
        .unwrap();
    let said: Value = serde_json::from_slice(&output.stdout).unwrap();
    let [without, with] = held_out(&said);
    assert!(with < 0.4 * without && with < 1.2, "{without} {with}");
    let stepped = Study::load(&new).unwrap();
    let step = &stepped.effects()[0];
    assert_eq!(step.name, "step_of_cycles");
    let value = |name: &str| {
        let own = step.parameters.iter().find(|p| p.short() == name);
        own.unwrap().value
    };
    assert!((value("factor") - 1.6).abs() < 0.1, "{step:?}");
    assert!((value("at") - 4e5).abs() < 2e4, "{step:?}");
    assert_eq!(stepped.free().len(), 3);
    // a curve that has no such shape is told so
    let refused = gearwear()
        .args(["add", "--quiet", "--force"])
        .arg(&path)
        .args(["learned:cycles", "--form", "power"])
        .output()
        .unwrap();
    let says = String::from_utf8_lossy(&refused.stderr);
    assert!(
        says.contains("cannot have the form power, allowed: step, band"),
        "{says}"
    );
}

#[test]
fn what_cannot_be_learned_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let path = study(folder.path(), "1", 9);
    for (name, more, says) in [
        (
            "learned:cylces",
            vec![],
            "the nearest variable is `cycles`; allowed: p, p_max",
        ),
        (
            "learned:cycles:wheel",
            vec![],
            "`wheel` is no member, allowed: pinion, gear, both",
        ),
        ("learned:cycles:gear:2", vec![], "a part too many"),
        ("learned:radius", vec![], "no radius in common"),
        (
            "learned:bulk_temperature",
            vec![],
            "has one value only in these tests (60)",
        ),
        (
            "learned:cycles",
            vec!["--form", "profile"],
            "profile cannot follow `cycles`",
        ),
        (
            "learned:cycles",
            vec!["--form", "sharp"],
            "no form `sharp`, allowed: \"wear_factor\"",
        ),
        (
            "learned:cycles",
            vec!["--set", "z1=1"],
            "no parameters to set",
        ),
    ] {
        let output = gearwear()
            .args(["add", "--quiet"])
            .arg(&path)
            .arg(name)
            .args(more)
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{name}: {said}");
        assert!(said.contains(says), "{name}: no `{says}` in {said}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
}
