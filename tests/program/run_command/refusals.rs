//! Tolerance: none. What may stand in a study file is tested in `study_input.rs`; here only that `run` obeys.
use std::fs;

use super::home::Home;

#[test]
fn unusable_input_is_refused_and_nothing_is_written() {
    let wrong = [
        ("torque", "nan", "torque"),
        ("torque", "-100.0", "torque"),
        // its contact would be half a micrometre wide, and the flanks' compliance larger than the memory
        ("torque", "1e-3", "unknowns"),
        // a shaft of a tenth of a millimetre turns by a radian, and so much load bends teeth beyond any small deformation
        ("bore_diameter", "0.1", "operation.torque: "),
        ("torque", "10000", "operation.torque: "),
        ("module", "inf", "module"),
        ("misalignment", "5.0", "misalignment"),
        ("coefficient", "\"6e-10\"", "coefficient"),
        ("positions", "3", "positions"),
        ("step_tolerance", "0.0", "step_tolerance"),
        ("friction", "2", "friction"),
    ];
    for (key, value, said) in wrong {
        let home = Home::with(&[(key, value)]);
        let answer = home.gearwear("run study.toml -o a/b/run");
        assert_eq!(
            (answer.code, answer.out.as_str()),
            (Some(2), ""),
            "{key} = {value}: {}",
            answer.err
        );
        assert!(
            answer.err.contains(said) && answer.err.contains("study.toml:"),
            "{}",
            answer.err
        );
        assert_eq!(home.tree(), ["study.toml"]);
    }
}

#[test]
fn a_foreign_folder_is_refused_before_the_run() {
    let home = Home::with(&[]);
    fs::create_dir(home.path("mine")).unwrap();
    home.write("mine/thesis.txt", "precious");
    let before = home.tree();
    for resume in ["", "--resume"] {
        let answer = home.gearwear(&format!("run study.toml -o mine {resume}"));
        assert_eq!((answer.code, answer.out.as_str()), (Some(2), ""));
        assert!(answer.err.contains("thesis.txt"), "{}", answer.err);
    }
    assert_eq!(home.tree(), before);
}

/// A folder without the right to write; for a superuser, who may everything, one that the system itself keeps closed.
#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_takes_no_files_is_an_error_that_names_it() {
    use std::os::unix::fs::PermissionsExt;
    let home = Home::with(&[("contact", "\"hertz\"")]);
    let closed = home.path("closed");
    fs::create_dir(&closed).unwrap();
    fs::set_permissions(&closed, fs::Permissions::from_mode(0o555)).unwrap();
    let mut places = vec![("/proc/gearwear/run".to_owned(), "/proc/gearwear")];
    if fs::write(closed.join("probe"), "").is_err() {
        places.push(("closed/run".to_owned(), "closed"));
    }
    for (place, named) in places {
        for contact in ["\"hertz\"", "\"paper\""] {
            home.write(
                "study.toml",
                &super::home::study_with(&[("contact", contact)]),
            );
            let answer = home.gearwear(&format!("run study.toml -o {place}"));
            assert_eq!(
                (answer.code, answer.out.as_str()),
                (Some(1), ""),
                "{}",
                answer.err
            );
            assert!(
                answer.err.starts_with("error: cannot ") && answer.err.contains(named),
                "{}",
                answer.err
            );
        }
    }
    fs::set_permissions(&closed, fs::Permissions::from_mode(0o755)).unwrap();
}

/// A finished result stays whole while, and although, the next run into its folder fails.
#[test]
fn a_failed_run_leaves_the_earlier_result() {
    let home = Home::with(&[("contact", "\"hertz\"")]);
    home.succeed("run study.toml -o run");
    let before = home.result("run").files();
    home.write(
        "study.toml",
        &super::home::study_with(&[("coefficient", "1e-4"), ("stored_states", "1")]),
    );
    let answer = home.gearwear("run study.toml -o run");
    assert_eq!(answer.code, Some(1), "{}", answer.out);
    assert!(home.result("run").files() == before);
}
