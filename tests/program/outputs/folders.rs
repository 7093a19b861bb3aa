//! Claim: results appear whole or not at all, and nothing that is not ours is touched.
use std::fs;
use std::path::Path;

use std::sync::Mutex;

use gearwear::report::{
    FieldsWritten, OutputError, Staging, atomic, write_file, write_run, write_run_with,
};

use super::synthetic;

#[test]
fn a_failure_midway_leaves_nothing_under_the_final_name() {
    let dir = tempfile::tempdir().unwrap();
    let target = dir.path().join("study.out/run");
    let mut broken = synthetic::run();
    broken.fields[4].gear.von_mises[7] = f64::NAN;
    let error = write_run(&broken, &target).unwrap_err();
    assert!(matches!(error, OutputError::NotFinite { .. }), "{error}");
    assert!(
        error
            .to_string()
            .contains("wear_002_position_002.vtu: gear von_mises is NaN"),
        "{error}"
    );
    assert_eq!(
        fs::read_dir(dir.path().join("study.out")).unwrap().count(),
        0
    );

    // Over a finished result: that one stays as it was.
    write_run(&synthetic::run(), &target).unwrap();
    let before = fs::read(target.join("summary.json")).unwrap();
    broken.title = "another".to_owned();
    write_run(&broken, &target).unwrap_err();
    assert_eq!(fs::read(target.join("summary.json")).unwrap(), before);
    assert_eq!(
        fs::read_dir(dir.path().join("study.out")).unwrap().count(),
        1
    );
}

#[test]
fn the_files_of_the_fields_are_announced_with_their_size() {
    let dir = tempfile::tempdir().unwrap();
    let seen: Mutex<Vec<FieldsWritten>> = Mutex::default();
    let watch = |fields| seen.lock().unwrap().push(fields);
    let run = synthetic::run();
    let target = dir.path().join("run");
    write_run_with(&run, None, &[], &target, &watch).unwrap();
    let sizes: Vec<u64> = fs::read_dir(target.join("fields"))
        .unwrap()
        .map(Result::unwrap)
        .filter(|file| file.path().extension().is_some_and(|e| e == "vtu"))
        .map(|file| file.metadata().unwrap().len())
        .collect();
    let seen = seen.into_inner().unwrap();
    assert!(seen.windows(2).all(|two| two[0].files < two[1].files));
    assert!(seen.iter().all(|fields| fields.of == sizes.len()));
    let (first, last) = (seen[0], seen.last().unwrap());
    let all: u64 = sizes.iter().sum();
    assert_eq!((last.files, last.bytes), (sizes.len(), all));
    // the first files speak for the others
    assert!((first.bytes as f64 / all as f64 - 1.0).abs() < 0.1);
}

#[test]
fn a_finished_folder_is_replaced_whole_and_a_foreign_one_refused() {
    let dir = tempfile::tempdir().unwrap();
    let target = dir.path().join("run");
    let mut first = Staging::begin(&target).unwrap();
    first.write("old/only.txt", b"old").unwrap();
    assert!(!target.exists());
    first.commit().unwrap();
    assert!(atomic::is_result(&target) && atomic::check(&target).is_ok());
    let mut second = Staging::begin(&target).unwrap();
    second.write("new.txt", b"new").unwrap();
    assert!(target.join("old/only.txt").exists());
    second.commit().unwrap();
    assert!(target.join("new.txt").exists() && !target.join("old").exists());
    assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1);

    let foreign = dir.path().join("thesis");
    fs::create_dir(&foreign).unwrap();
    Staging::begin(&foreign).map(drop).unwrap();
    fs::write(foreign.join("chapter1.tex"), b"precious").unwrap();
    let error = Staging::begin(&foreign).unwrap_err();
    assert!(
        matches!(&error, OutputError::Foreign { found, .. } if found == "chapter1.tex"),
        "{error}"
    );
    let error = Staging::begin(&foreign.join("chapter1.tex")).unwrap_err();
    assert!(matches!(error, OutputError::NotAFolder { .. }), "{error}");
    let error = Staging::begin(&foreign.join("chapter1.tex/run")).unwrap_err();
    assert!(matches!(error, OutputError::Io { .. }), "{error}");
    assert!(matches!(
        Staging::begin(Path::new("/")).unwrap_err(),
        OutputError::Nameless { .. }
    ));
    let mut third = Staging::begin(&target).unwrap();
    for name in ["../evil", "/evil", ""] {
        assert!(matches!(
            third.write(name, b"").unwrap_err(),
            OutputError::OutsideFolder { .. }
        ));
    }
    // A folder that turned foreign while the run was on its way is not overwritten.
    let late = dir.path().join("late");
    let staging = Staging::begin(&late).unwrap();
    fs::create_dir(&late).unwrap();
    fs::write(late.join("mine.txt"), b"mine").unwrap();
    assert!(matches!(
        staging.commit().unwrap_err(),
        OutputError::Foreign { .. }
    ));
    assert_eq!(fs::read(late.join("mine.txt")).unwrap(), b"mine");
}

#[test]
fn single_files_are_replaced_or_left_alone() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("deep/study.toml");
    write_file(&file, b"one").unwrap();
    write_file(&file, b"two").unwrap();
    assert_eq!(fs::read(&file).unwrap(), b"two");
    let error = write_file(dir.path().join("deep").as_path(), b"three").unwrap_err();
    assert!(matches!(error, OutputError::Io { .. }), "{error}");
    assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1);
    assert_eq!(fs::read_dir(dir.path().join("deep")).unwrap().count(), 1);
}
