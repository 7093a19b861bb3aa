use std::fs;

use serde_json::json;

use super::*;

const STUDY: &str = include_str!("../examples/paper.toml");
const DATA: &str = include_str!("../examples/paper.csv");

/// A folder with a study and its measurements.
fn home() -> tempfile::TempDir {
    let home = tempfile::tempdir().unwrap();
    fs::write(home.path().join("study.toml"), STUDY).unwrap();
    fs::write(home.path().join("measurements.csv"), DATA).unwrap();
    home
}

fn args(home: &tempfile::TempDir, set: &[(&str, f64)]) -> AddArgs {
    AddArgs {
        study: home.path().join("study.toml"),
        effect: "running_in".into(),
        more: Vec::new(),
        output: None,
        set: set
            .iter()
            .map(|(name, value)| ((*name).to_owned(), *value))
            .collect(),
        form: None,
        force: false,
    }
}

#[test]
fn the_fit_is_asked_for_what_is_free_and_its_values_are_written() {
    let home = home();
    let outcome = add(&args(&home, &[("amplitude", 2.0)]), |_, drafts, data| {
        let [draft] = drafts else {
            panic!("with a parameter set the form is: {drafts:?}")
        };
        let (study, free) = (&draft.study, &draft.free);
        assert!(study.effect_model().has("running_in") && !data.observations.is_empty());
        let names: Vec<&str> = free.iter().map(|p| p.name.as_str()).collect();
        assert_eq!(names, ["wear.coefficient", "running_in.decay_cycles"]);
        Ok(Fitted {
            draft: 0,
            values: vec![
                ("wear.coefficient".into(), 1.234_567_89e-10),
                ("running_in.decay_cycles".into(), 123_456.789),
            ],
            json: json!({"points": 3}),
            text: "fitted\n".into(),
        })
    })
    .unwrap();
    let target = home.path().join("study+running_in.toml");
    assert_eq!(
        outcome.json["written"],
        json!([target.display().to_string()])
    );
    assert_eq!(outcome.json["fit"]["points"], 3);
    assert!(
        outcome.text.contains("fitted\nnext: gearwear compare"),
        "{}",
        outcome.text
    );
    let new = Study::load(&target).unwrap();
    assert_eq!(new.wear.coefficient, 1.23457e-10);
    let value = |name| new.effect_model().parameter(name).unwrap().value;
    assert_eq!(value("running_in.amplitude"), 2.0);
    assert_eq!(value("running_in.decay_cycles"), 123_457.0);
    let free: Vec<&str> = new.free().iter().map(|p| p.name.as_str()).collect();
    assert_eq!(free, ["wear.coefficient", "running_in.decay_cycles"]);
    assert_eq!(
        fs::read_to_string(home.path().join("study.toml")).unwrap(),
        STUDY
    );
    let files = fs::read_dir(home.path()).unwrap().count();
    assert_eq!(files, 3, "no partial file is left");
}

#[test]
fn without_measurements_there_is_nothing_to_fit() {
    let home = home();
    fs::remove_file(home.path().join("measurements.csv")).unwrap();
    let error = add(&args(&home, &[]), |_, _, _| unreachable!()).unwrap_err();
    assert_eq!(error.exit_code(), 2);
    assert!(!home.path().join("study+running_in.toml").exists());
}

#[test]
fn a_wear_coefficient_out_of_range_is_told_as_a_setting() {
    let home = home();
    for value in [-1.0, 1.0, f64::NAN] {
        let error = add(
            &args(&home, &[("wear.coefficient", value)]),
            |_, _, _| unreachable!(),
        )
        .unwrap_err();
        assert_eq!(error.exit_code(), 2);
        let says =
            format!("--set wear.coefficient={value} is out of range, allowed: 0 to 1e-4 mm2/N (");
        assert!(error.to_string().starts_with(&says), "{error}");
    }
}

#[test]
fn a_failed_fit_writes_nothing() {
    let home = home();
    let failed = add(&args(&home, &[]), |_, _, _| {
        Err(CliError::Unusable("the fit failed".to_owned()))
    });
    assert!(failed.is_err());
    assert_eq!(fs::read_dir(home.path()).unwrap().count(), 2);
}

#[test]
fn the_study_itself_is_never_overwritten() {
    let home = home();
    let mut args = args(&home, &[("amplitude", 2.0), ("decay_cycles", 1e5)]);
    args.output = Some(home.path().join(".").join("study.toml"));
    args.force = true;
    let error = add(&args, |_, _, _| unreachable!()).unwrap_err();
    assert_eq!(error.exit_code(), 2);
    assert!(error.to_string().contains("stays as it is"), "{error}");
    let study = fs::read_to_string(home.path().join("study.toml")).unwrap();
    assert_eq!(study, STUDY);
}

/// What a diagnosis decided, as its document holds it.
fn decided(verdict: &str, leader: &str, probability: f64) -> Decided {
    let document = json!({
        "verdict": verdict,
        "ranking": [{"effect": leader, "form": "", "probability": probability, "parameters": []}],
        "probabilities": {leader: probability},
    });
    serde_json::from_value(document).unwrap()
}

#[test]
fn a_diagnosis_that_names_something_else_or_more_is_recalled() {
    let other = decided("effect", "pressure_exponent", 0.99);
    let line = named_otherwise("running_in", &other);
    assert!(line.contains("names pressure_exponent (99.0 %)"), "{line}");
    assert_eq!(named_beside("running_in", &other), "");
    let pair = decided("effects", "dynamic_load+running_in", 0.95);
    let line = named_beside("running_in", &pair);
    assert!(line.contains("until dynamic_load is in"), "{line}");
    assert_eq!(named_otherwise("running_in", &pair), "");
    // the effect alone, or not among them: nothing to recall
    let alone = decided("effect", "running_in", 0.99);
    assert_eq!(named_beside("running_in", &alone), "");
    assert_eq!(named_beside("tip_relief", &pair), "");
}

/// The fit of the effect alone is given up, but the diagnosis has it beside something else.
#[test]
fn what_a_diagnosis_has_the_effect_beside_is_recalled() {
    let told = |of: &[(&str, f64)], effect: &str| {
        let probabilities = of.iter().map(|(name, p)| ((*name).to_owned(), *p));
        let decided = Decided {
            probabilities: probabilities.collect(),
            ..decided("partial", of[0].0, of[0].1)
        };
        found_beside(effect, &decided)
    };
    let all = [
        ("running_in+unknown", 0.745),
        ("running_in", 0.01),
        ("tip_relief", 0.2),
        ("coating+tip_relief", 0.04),
    ];
    assert_eq!(
        told(&all, "running_in").as_deref(),
        Some(
            "something else is missing besides: the diagnosis has it beside something unknown (74.5 %)"
        )
    );
    assert!(
        told(&all, "tip_relief")
            .unwrap()
            .ends_with("has it all the same, by itself (20.0 %)")
    );
    assert_eq!(told(&all, "coating"), None);
    assert_eq!(told(&all, "ageing"), None);
}
