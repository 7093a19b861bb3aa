//! Killed runs. Tolerance: none, a resumed run's files are those of the undisturbed one byte by byte; `summary.json` without its
//! `cost`, and `report.html`, which shows the cost, are the exceptions.
//!
//! Kills (SIGKILL on Unix) come after a number of wear steps, seen by the checkpoint being replaced, and a delay; both are drawn
//! from a fixed seed. That spreads them over the run on machines of any speed, which delays alone would not.
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant, SystemTime};

use gearwear::simulate::checkpoint::{Checkpoint, Fingerprint};

use super::home::{Folder, Home, study_with};

/// Many short wear steps.
const SHORT_STEPS: &[(&str, &str)] = &[("step_tolerance", "1e-5")];

/// So much wear that the members are condensed anew and the contact is looked for in wider strips.
const HEAVY_WEAR: &[(&str, &str)] = &[("cycles", "8e6"), ("stored_states", "4")];

/// A linear congruential generator (Knuth, MMIX); the high bits.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % limit
    }
}

fn start(home: &Home, arguments: &str) -> Child {
    Command::new(assert_cmd::cargo::cargo_bin!("gearwear"))
        .current_dir(home.path(""))
        .args(arguments.split_whitespace())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

fn running(child: &mut Child) -> bool {
    child.try_wait().unwrap().is_none()
}

/// Waits until `seen` holds or the program ends by itself.
fn wait_for(child: &mut Child, mut seen: impl FnMut() -> bool) {
    let begun = Instant::now();
    while running(child) && !seen() {
        std::thread::sleep(Duration::from_millis(1));
        assert!(begun.elapsed() < Duration::from_secs(120), "no progress");
    }
}

fn changed(path: &Path) -> Option<SystemTime> {
    fs::metadata(path).and_then(|m| m.modified()).ok()
}

/// A result folder under its final name is whole: every file that it lists is there.
fn assert_whole_or_absent(folder: &Path) {
    if !folder.exists() {
        return;
    }
    let list = fs::read_to_string(folder.join(".gearwear-result")).expect("no unfinished folder");
    assert!(list.lines().count() > 5);
    for name in list.lines().skip(1) {
        assert!(folder.join(name).is_file(), "{name} is missing");
    }
    serde_json::from_slice::<serde_json::Value>(&fs::read(folder.join("summary.json")).unwrap())
        .unwrap();
}

fn assert_same(resumed: &Folder, undisturbed: &Folder) {
    let (left, right) = (resumed.files(), undisturbed.files());
    assert_eq!(
        left.keys().collect::<Vec<_>>(),
        right.keys().collect::<Vec<_>>()
    );
    for (name, bytes) in &left {
        if name != "summary.json" && name != "report.html" {
            assert!(bytes == &right[name], "{name} differs");
        }
    }
    let [mut resumed, mut undisturbed] = [resumed.summary(), undisturbed.summary()];
    for summary in [&mut resumed, &mut undisturbed] {
        summary.as_object_mut().unwrap().remove("cost").unwrap();
    }
    assert_eq!(resumed, undisturbed);
}

/// Kills the run `kills` times, each time resuming it, then lets it end; returns how many kills found it at work.
fn kill_and_resume(home: &Home, kills: usize, most_steps: u64, seed: u64) -> usize {
    let (checkpoint, folder) = (home.path(".run.checkpoint"), home.path("run"));
    let mut random = Random(seed);
    let mut hit = 0;
    for _ in 0..kills {
        let mut child = start(home, "run study.toml -o run --resume --quiet");
        let steps = random.below(most_steps);
        let mut seen = (changed(&checkpoint), 0);
        wait_for(&mut child, || {
            let now = changed(&checkpoint);
            if now != seen.0 {
                seen = (now, seen.1 + 1);
            }
            seen.1 >= steps
        });
        std::thread::sleep(Duration::from_micros(random.below(30_000)));
        hit += usize::from(running(&mut child));
        child.kill().unwrap();
        child.wait().unwrap();
        assert_whole_or_absent(&folder);
    }
    home.succeed("run study.toml -o run --resume");
    hit
}

#[test]
fn a_run_killed_again_and_again_ends_in_the_same_files() {
    let home = Home::with(SHORT_STEPS);
    home.succeed("run study.toml -o undisturbed --quiet");
    let hit = kill_and_resume(&home, 6, 22, 1);
    assert!(hit >= 4, "only {hit} kills came before the end");
    assert_same(&home.result("run"), &home.result("undisturbed"));
    let left: Vec<String> = home
        .tree()
        .into_iter()
        .filter(|name| !name.contains('/'))
        .collect();
    assert_eq!(
        left,
        ["run", "study.toml", "undisturbed"],
        "nothing is left over"
    );
}

#[test]
fn a_killed_run_condenses_and_widens_where_the_undisturbed_one_does() {
    let home = Home::with(HEAVY_WEAR);
    home.succeed("run study.toml -o undisturbed --quiet");
    let summary = home.result("undisturbed").summary();
    assert!(
        summary["cost"]["factorisations"].as_u64().unwrap() > 4,
        "condensed anew at least twice"
    );
    let hit = kill_and_resume(&home, 7, 20, 2);
    assert!(hit >= 4, "only {hit} kills came before the end");
    assert_same(&home.result("run"), &home.result("undisturbed"));
}

#[test]
fn a_killed_run_of_teeth_that_differ_goes_on_with_each_of_them() {
    let home = Home::with(SHORT_STEPS);
    let teeth = "[teeth.pinion]\npitch_pattern = [-4.0, 0.0, 0.0]\nclasses = 4\n[teeth.gear]\npitch_pattern = [3.0, 0.0]\nclasses = 3\n";
    home.write("study.toml", &format!("{}{teeth}", study_with(SHORT_STEPS)));
    home.succeed("run study.toml -o undisturbed --quiet");
    let hit = kill_and_resume(&home, 5, 12, 3);
    assert!(hit >= 2, "only {hit} kills came before the end");
    assert_same(&home.result("run"), &home.result("undisturbed"));
}

#[test]
fn a_run_killed_while_it_writes_its_result_leaves_none_or_all() {
    let home = Home::with(&[("contact", "\"hertz\"")]);
    home.succeed("run study.toml -o undisturbed --quiet");
    let partial = home.path(".run.partial-1");
    for seed in 0..3 {
        let mut random = Random(seed);
        let mut child = start(&home, "run study.toml -o run --quiet");
        wait_for(&mut child, || partial.exists());
        std::thread::sleep(Duration::from_micros(random.below(8_000)));
        child.kill().unwrap();
        child.wait().unwrap();
        assert_whole_or_absent(&home.path("run"));
    }
    home.succeed("run study.toml -o run --resume");
    assert_same(&home.result("run"), &home.result("undisturbed"));
    assert!(!partial.exists() && !home.path(".run.partial-1.lock").exists());
}

/// Runs in the folder are cut short after some wear steps; the checkpoint stays.
fn interrupted(home: &Home) {
    let checkpoint = home.path(".run.checkpoint");
    let before = changed(&checkpoint);
    let mut child = start(home, "run study.toml -o run --quiet");
    let mut steps = (before, 0);
    wait_for(&mut child, || {
        let now = changed(&checkpoint);
        if now != steps.0 {
            steps = (now, steps.1 + 1);
        }
        steps.1 >= 3
    });
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(checkpoint.exists());
}

#[test]
fn resuming_a_finished_run_does_nothing_unless_its_input_has_changed() {
    let home = Home::with(&[("contact", "\"hertz\"")]);
    home.succeed("run study.toml -o run --resume");
    let before = changed(&home.path("run/summary.json"));
    let answer = home.succeed("run study.toml -o run --resume");
    assert!(answer.out.contains("finished already"), "{}", answer.out);
    let answer = home.succeed("run study.toml -o run --resume --json");
    let printed: serde_json::Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!(printed, home.result("run").summary());
    assert_eq!(changed(&home.path("run/summary.json")), before);
    // another torque: the finished result is not that study's, whatever its folder is called
    home.write(
        "study.toml",
        &study_with(&[("contact", "\"hertz\""), ("torque", "50.0")]),
    );
    home.succeed("run study.toml -o run --resume");
    assert_eq!(home.result("run").summary()["conditions"]["torque"], 50.0);
}

#[test]
fn a_cut_short_rerun_is_resumed_although_an_older_result_stands() {
    let home = Home::with(&[("contact", "\"hertz\"")]);
    home.succeed("run study.toml -o run");
    let older = home.result("run").files();
    home.write("study.toml", &study_with(SHORT_STEPS));
    interrupted(&home);
    assert!(home.result("run").files() == older);
    home.succeed("run study.toml -o run --resume");
    home.succeed("run study.toml -o undisturbed");
    assert_same(&home.result("run"), &home.result("undisturbed"));
}

#[test]
fn checkpoints_of_other_studies_are_refused_and_damaged_ones_passed_over() {
    let home = Home::with(SHORT_STEPS);
    home.succeed("run study.toml -o undisturbed");
    interrupted(&home);
    let checkpoint = home.path(".run.checkpoint");
    let good = fs::read(&checkpoint).unwrap();
    let tests = "[[test]]\nid = \"A\"\ntorque = 100.0\n";
    let own = study_with(SHORT_STEPS);
    for (study, arguments) in [
        (study_with(&[("step_tolerance", "2e-5")]), ""),
        (format!("{own}{tests}"), "--test A"),
    ] {
        home.write("study.toml", &study);
        let answer = home.gearwear(&format!("run study.toml -o run --resume {arguments}"));
        assert_eq!((answer.code, answer.out.as_str()), (Some(2), ""));
        for part in [
            "belongs to another study",
            ".run.checkpoint",
            "without --resume",
        ] {
            assert!(answer.err.contains(part), "{part}: {}", answer.err);
        }
        assert!(!home.path("run").exists());
        assert_eq!(fs::read(&checkpoint).unwrap(), good, "left alone");
    }
    home.write("study.toml", &own);
    let mut flipped = good.clone();
    flipped[good.len() / 2] ^= 4;
    for damaged in [&good[..good.len() / 2], &flipped, b""] {
        fs::write(&checkpoint, damaged).unwrap();
        home.succeed("run study.toml -o run --resume --quiet");
        assert_same(&home.result("run"), &home.result("undisturbed"));
        assert!(!checkpoint.exists());
        fs::remove_dir_all(home.path("run")).unwrap();
    }
}

/// The program's own check at the end: with a worn area in the checkpoint that the flanks do not have, no result is written.
#[test]
fn a_result_that_fails_its_own_check_is_not_written() {
    let home = Home::with(SHORT_STEPS);
    interrupted(&home);
    let path = home.path(".run.checkpoint");
    let bytes = fs::read(&path).unwrap();
    // eight bytes of format, then whose it is
    let run: Fingerprint = bytes[8..40].try_into().unwrap();
    let mut checkpoint = Checkpoint::from_bytes(&bytes, &run).unwrap();
    // the flanks end with 1 to 3 thousandths of a square millimetre worn off
    checkpoint.progress.as_mut().unwrap().balance.law[1] += 1e-4;
    fs::write(&path, checkpoint.to_bytes(&run)).unwrap();
    let answer = home.gearwear("run study.toml -o run --resume");
    assert_eq!((answer.code, answer.out.as_str()), (Some(1), ""));
    for part in [
        "the result fails its own check and is not written",
        "worn area, law against geometry is off by",
        "numerics.step_tolerance",
    ] {
        assert!(answer.err.contains(part), "{part}: {}", answer.err);
    }
    assert!(!home.path("run").exists());
    home.succeed("run study.toml -o run");
}
