//! What goes wrong outside the program while it writes: a full disk, a folder that cannot be written to or is removed on the way, another
//! program at the same folder. For `run`, `sweep`, `diagnose` and `climb`: one error, exit code 1, and earlier files are as they were.
#![cfg(unix)]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use gearwear::report::atomic;

/// Each command with what it needs beside the study.
const COMMANDS: [&[&str]; 4] = [
    &["run"],
    &["sweep", "--vary", "operation.torque=80,100"],
    &["diagnose"],
    &["climb", "--most", "1"],
];

/// A coarse study by analytic contact and made-up measurements of its own, in a folder of their own.
struct Home(tempfile::TempDir);

impl Home {
    fn new() -> Self {
        let home = Home(tempfile::tempdir().unwrap());
        let study = format!(
            "{}[operation]\ntorque = 100.0\nspeed = 2000.0\n[wear]\ncoefficient = 6e-10\ncycles = 5e4\n\
             [model]\ncontact = \"hertz\"\n[numerics]\npositions = 30\nstored_states = 2\nfields = 1\n",
            crate::common::gears!()
        );
        fs::write(home.path("plain.toml"), study).unwrap();
        crate::common::succeed(
            home.path(""),
            "synthesize plain.toml -o data --noise 0.05 --seed 1 --quiet",
        );
        home
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// A result of an earlier run, which a command may replace.
    fn earlier(&self, name: &str) -> PathBuf {
        let target = self.path(name);
        fs::create_dir_all(&target).unwrap();
        fs::write(target.join(atomic::MARKER), "earlier\n").unwrap();
        fs::write(target.join("figures.csv"), "1,2,3\n").unwrap();
        target
    }

    /// The program with one of [`COMMANDS`] into `target`, its output kept.
    fn command(&self, arguments: &[&str], target: &Path) -> Command {
        let mut command = Command::new(assert_cmd::cargo::cargo_bin!("gearwear"));
        self.complete(&mut command, arguments, target);
        command
    }

    fn complete(&self, command: &mut Command, arguments: &[&str], target: &Path) {
        command
            .current_dir(self.path(""))
            .arg(arguments[0])
            .arg("data/study.toml")
            .args(&arguments[1..])
            .args(["--quiet", "-o"])
            .arg(target)
            .stdout(Stdio::null())
            .stderr(Stdio::piped());
    }
}

/// Every file below a folder with its bytes.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut all = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap().flatten() {
        let path = entry.path();
        if path.is_dir() {
            all.extend(files(&path));
        } else {
            let bytes = fs::read(&path).unwrap();
            all.insert(path, bytes);
        }
    }
    all
}

/// One error that holds `words`, exit code 1.
fn refused(what: &str, output: &Output, words: &str) {
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{what}: {said}");
    assert_eq!(said.matches("error:").count(), 1, "{what}: {said}");
    assert!(said.contains(words), "{what}: {said}");
}

/// Files may not grow beyond 4 KiB, as on a disk that is full by then: the system's limit for a process, with its signal ignored so that
/// writing fails as it does there.
#[test]
fn a_full_disk_leaves_the_earlier_result() {
    let home = Home::new();
    for arguments in COMMANDS {
        let what = arguments[0];
        let target = home.earlier(&format!("{what}/out"));
        let before = files(&target);
        let mut command = Command::new("sh");
        command.args(["-c", "trap '' XFSZ; ulimit -f 8; exec \"$0\" \"$@\""]);
        command.arg(assert_cmd::cargo::cargo_bin!("gearwear"));
        home.complete(&mut command, arguments, &target);
        refused(what, &command.output().unwrap(), "cannot write");
        assert_eq!(files(&target), before, "{what}");
        // what was computed may stay for --resume, nothing else
        let left = fs::read_dir(home.path(what)).unwrap().flatten();
        let left: Vec<String> = left
            .map(|entry| entry.file_name().to_string_lossy().into_owned())
            .filter(|name| !["out", ".out.points", ".out.checkpoint"].contains(&name.as_str()))
            .collect();
        assert_eq!(left, [""; 0], "{what}");
    }
}

/// As root every folder can be written to: there only the system's own, which take no file, are tried.
#[test]
#[expect(clippy::print_stderr, reason = "says what was not tested")]
fn a_folder_that_takes_no_file_is_told_before_anything_is_computed() {
    use std::os::unix::fs::PermissionsExt;
    let home = Home::new();
    let locked = home.path("locked");
    fs::create_dir(&locked).unwrap();
    fs::set_permissions(&locked, fs::Permissions::from_mode(0o555)).unwrap();
    let mut folders = vec![locked.clone()];
    if fs::write(locked.join("probe"), "").is_ok() {
        eprintln!("the folder without permission to write is left out: this user may write there");
        folders.clear();
    }
    if cfg!(target_os = "linux") {
        folders.push(PathBuf::from("/proc/self"));
    }
    for folder in folders {
        for arguments in COMMANDS {
            let output = home.command(arguments, &folder.join("out")).output();
            refused(arguments[0], &output.unwrap(), "cannot lock");
        }
    }
}

#[test]
fn another_program_s_folder_is_left_alone() {
    let home = Home::new();
    for arguments in COMMANDS {
        let what = arguments[0];
        let target = home.earlier(&format!("{what}/out"));
        let before = files(&home.path(what));
        let held = atomic::reserve(&target).unwrap();
        let output = home.command(arguments, &target).output().unwrap();
        refused(what, &output, "is being written by another run of gearwear");
        drop(held);
        assert_eq!(files(&home.path(what)), before, "{what}");
    }
}

/// Removed on the way, with its parents: the whole result, or an error and nothing.
#[test]
fn a_folder_removed_on_the_way_comes_back_whole_or_not_at_all() {
    let home = Home::new();
    for arguments in COMMANDS {
        let what = arguments[0];
        let target = home.earlier(&format!("{what}/deep/out"));
        let mut child = home.command(arguments, &target).spawn().unwrap();
        let lock = home.path(&format!("{what}/deep/.out.lock"));
        let start = Instant::now();
        while !lock.exists() && child.try_wait().unwrap().is_none() {
            assert!(start.elapsed() < Duration::from_secs(120), "{what}");
            std::thread::sleep(Duration::from_millis(1));
        }
        // a running program may put a file in meanwhile
        for _ in 0..100 {
            if fs::remove_dir_all(home.path(&format!("{what}/deep"))).is_ok() {
                break;
            }
        }
        let output = child.wait_with_output().unwrap();
        if output.status.success() {
            let marker = fs::read_to_string(target.join(atomic::MARKER)).unwrap();
            let mut names = marker.lines().skip(1);
            assert!(names.all(|name| target.join(name).is_file()), "{what}");
            assert!(!target.join("figures.csv").exists(), "{what}");
        } else {
            refused(what, &output, "cannot");
            assert!(!target.exists(), "{what}");
        }
    }
}
