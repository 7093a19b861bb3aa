//! Everything in gearwear that reads what others wrote, each as a function of bytes. A reader may refuse, never panic, hang or grow without limit.
//!
//! Used by the fuzzer here and by `tests/program/readers.rs`, which reads every kept finding and mutants of valid files again.

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use gearwear::effects::Hook;
use gearwear::effects::formula::Formula;
use gearwear::measure::{Dataset, Known};
use gearwear::mesh::{read_msh, read_vtu};
use gearwear::simulate::checkpoint::{Checkpoint, fingerprint, seal};
use gearwear::study::Study;
use tempfile::TempDir;

/// A reader under its name.
type Reader = (&'static str, fn(&[u8]));

/// All readers.
const READERS: [Reader; 10] = [
    ("study", study),
    ("measurements", measurements),
    ("tests_table", tests_table),
    ("profile", profile),
    ("lead", lead),
    ("import", import),
    ("formula", formula),
    ("msh", msh),
    ("vtu", vtu),
    ("checkpoint", checkpoint),
];

/// The names of all readers.
pub(crate) fn names() -> Vec<&'static str> {
    READERS.iter().map(|(name, _)| *name).collect()
}

/// The reader with that name.
pub(crate) fn find(name: &str) -> Option<fn(&[u8])> {
    READERS
        .iter()
        .find(|(known, _)| *known == name)
        .map(|(_, read)| *read)
}

/// The paper's pair, which the files that a study names are read for.
const STUDY: &str = include_str!("../../paper/study.toml");

fn pair() -> &'static Study {
    static PAIR: OnceLock<Study> = OnceLock::new();
    PAIR.get_or_init(|| Study::parse(STUDY, "study.toml").expect("a valid study"))
}

fn study(data: &[u8]) {
    if let Ok(text) = std::str::from_utf8(data) {
        let _ = Study::parse(text, "study.toml").map_err(|error| error.to_string());
    }
}

fn measurements(data: &[u8]) {
    let gears = &pair().gears;
    let known = Known::new(
        [("A", 1e6), ("B", 2e6)],
        [&gears.pinion, &gears.gear],
        gears.face_width,
    );
    if let Ok(text) = std::str::from_utf8(data) {
        let _ = Dataset::parse(text, "measurements.csv", &known).map_err(|error| error.to_string());
    }
}

/// Reads a study that names a file with these bytes.
fn beside_study(file: &str, keys: &str, data: &[u8]) {
    in_folder(file, data, |path| {
        let text = format!("{keys}\n{STUDY}");
        let study = path.with_file_name("study.toml");
        let _ = Study::parse(&text, &study.to_string_lossy()).map_err(|error| error.to_string());
    });
}

fn tests_table(data: &[u8]) {
    beside_study("tests.csv", "measurements.tests = \"tests.csv\"", data);
}

fn profile(data: &[u8]) {
    in_folder("flank.csv", data, |path| {
        let text = STUDY.replace("teeth = 27", "teeth = 27\nprofile_file = \"flank.csv\"");
        let study = path.with_file_name("study.toml");
        let _ = Study::parse(&text, &study.to_string_lossy()).map_err(|error| error.to_string());
    });
}

fn lead(data: &[u8]) {
    let keys = "face.slices = 3\nface.pinion.lead_file = \"lead.csv\"";
    beside_study("lead.csv", keys, data);
}

fn import(data: &[u8]) {
    for name in ["table.csv", "table.xlsx"] {
        in_folder(name, data, |path| {
            let _ = gearwear::measure::import::sheets(path);
        });
    }
}

fn formula(data: &[u8]) {
    if let Ok(text) = std::str::from_utf8(data) {
        for parameters in [[].as_slice(), &["a"]] {
            let _ = Formula::new(Hook::WearFactor, text, parameters).map_err(|e| e.to_string());
        }
    }
}

fn msh(data: &[u8]) {
    if let Ok(text) = std::str::from_utf8(data) {
        let _ = read_msh(Path::new("user.msh"), text, &pair().gears.pinion);
    }
}

fn vtu(data: &[u8]) {
    let _ = read_vtu(Path::new("user.vtu"), data, &pair().gears.pinion);
}

fn checkpoint(data: &[u8]) {
    let run = fingerprint(&[b"run"]);
    let _ = Checkpoint::from_bytes(data, &run);
    // past the checksum, where damage would otherwise end
    let _ = Checkpoint::from_bytes(&seal(data, &run), &run);
}

/// Calls `read` with the path of a file with these bytes, in a folder of this thread's own that lives in memory where the system has such a place.
fn in_folder(name: &str, data: &[u8], read: impl FnOnce(&PathBuf)) {
    thread_local! {
        static FOLDER: RefCell<Option<TempDir>> = const { RefCell::new(None) };
    }
    FOLDER.with_borrow_mut(|folder| {
        let folder = folder.get_or_insert_with(|| {
            TempDir::new_in("/dev/shm")
                .or_else(|_| TempDir::new())
                .expect("a folder for files")
        });
        let path = folder.path().join(name);
        std::fs::write(&path, data).expect("room for a file");
        read(&path);
    });
}
