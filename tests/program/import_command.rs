//! Claim: `import` turns tables with a column for each checkpoint or for each position, from spreadsheets and texts, into rows of a
//! measurement file, shows how before it writes and writes nothing unasked; `check` says what it understood of a study and its
//! measurements, what is wrong with them as a whole and what a comparison could conclude.
//!
//! Source: `data/tables.xlsx`, written by openpyxl 3.1; radii of roll angles and lengths by r² = r_b² + ρ², ρ = r_b φ (ISO 21771) with
//! r_b = 27 mm cos 20°, computed apart from this program (Python's math). Tolerance: the nine digits that are written.

use std::fs;
use std::path::Path;
use std::time::Duration;

use assert_cmd::Command;
use tempfile::TempDir;

mod checked;
mod checkpoints;
mod deviations;
mod doubtful;
mod layouts;
mod long_tables;
mod losses;
mod multiples;
mod not_the_study;
mod nothing_measured;
mod other_values;
mod several_tables;
mod titles;
mod two_headers;
mod uncertainties;
mod wide_tables;

use crate::common::{gears, line, succeed};

const STUDY: &str = concat!(
    gears!("centre_distance = 80.0\n"),
    r#"[operation]
torque = 100.0
speed = 2000.0
[wear]
coefficient = 2e-10
cycles = 1e6
[model]
contact = "hertz"
[numerics]
positions = 40
[[test]]
id = "A"
[[test]]
id = "B"
torque = 170.0
role = "holdout"
[measurements]
file = "m.csv"
"#
);

fn home() -> TempDir {
    let home = tempfile::tempdir().unwrap();
    fs::write(home.path().join("study.toml"), STUDY).unwrap();
    let tables = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/tables.xlsx");
    fs::copy(tables, home.path().join("tables.xlsx")).unwrap();
    home
}

fn read(home: &TempDir, name: &str) -> String {
    fs::read_to_string(home.path().join(name)).unwrap()
}

const PINION: &str = "import tables.xlsx --sheet pinion --study study.toml --test A --unit mm --turn-sign --sigma 0.2";

/// Writes a table and imports it.
fn import(home: &TempDir, text: &str, options: &str) -> (Option<i32>, String, String) {
    fs::write(home.path().join("table.csv"), text).unwrap();
    line(
        home,
        &format!("import table.csv --study study.toml {options}"),
    )
}

/// As [`import`], and it has to succeed: what is shown, and the rows of the file without its header.
fn rows(home: &TempDir, text: &str, options: &str) -> (String, String) {
    let (code, shown, error) = import(home, text, &format!("{options} -o out.csv --force"));
    assert_eq!(code, Some(0), "{text}: {error}");
    let written = read(home, "out.csv");
    let (header, rows) = written.split_once('\n').unwrap();
    assert!(header.starts_with("test,member,cycles,quantity,position,value,sigma,trace"));
    (shown, rows.to_owned())
}

/// As [`import`], and it has to be refused: the message.
fn refused(home: &TempDir, text: &str, options: &str) -> String {
    let (code, _, message) = import(home, text, options);
    assert_eq!(code, Some(2), "{text} {options}: {message}");
    message
}
