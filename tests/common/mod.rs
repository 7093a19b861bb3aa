//! What tests of the whole program share: the gears of the paper's study as text, and the program started in a folder.
#![allow(
    dead_code,
    unused_imports,
    unused_macros,
    reason = "no test uses all of it"
)]

use std::path::Path;

use assert_cmd::Command;

/// `[gears]` to `[material]` of the paper's pair, one line per key, with more lines for `[gears]` if given.
macro_rules! gears {
    ($($more:literal)?) => {
        concat!(
            "[gears]\nmodule = 2.0\npressure_angle = 20.0\nface_width = 33.0\n",
            $($more,)?
            "[gears.pinion]\nteeth = 27\nbore_diameter = 25.0\n\
             [gears.gear]\nteeth = 53\nbore_diameter = 40.0\n\
             [material]\nyoungs_modulus = 2.1e5\npoisson_ratio = 0.3\ndensity = 7850.0\n",
        )
    };
}
pub(crate) use gears;

/// Runs the program in a folder: exit code, standard output, standard error.
pub(crate) fn gearwear(
    folder: impl AsRef<Path>,
    arguments: &[&str],
) -> (Option<i32>, String, String) {
    let output = Command::cargo_bin("gearwear")
        .unwrap()
        .current_dir(folder)
        .args(arguments)
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

/// The same with the arguments in one line, separated by blanks.
pub(crate) fn line(folder: impl AsRef<Path>, line: &str) -> (Option<i32>, String, String) {
    gearwear(folder, &line.split_whitespace().collect::<Vec<_>>())
}

/// As [`line`], and it has to succeed: standard output.
pub(crate) fn succeed(folder: impl AsRef<Path>, arguments: &str) -> String {
    let (code, out, err) = line(folder, arguments);
    assert_eq!(code, Some(0), "{arguments}: {err}");
    out
}
