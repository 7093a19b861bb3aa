//! Claim: VTK's own reader opens the fields of a run and draws them: the picture is not blank.
//!
//! Source: VTK by way of Python, not our code. Skipped with a message where `python3` or its `vtk` is absent. Tolerance: the picture's
//! size and a file no blank picture would fill.

use std::path::Path;
use std::process::Command;

use assert_cmd::cargo::CommandCargoExt;

const STUDY: &str = include_str!("../validation/paper/study.toml");

#[test]
#[expect(clippy::print_stderr, reason = "says why nothing was tested")]
fn vtk_draws_the_fields() {
    let vtk = Command::new("python3").args(["-c", "import vtk"]).output();
    if !vtk.is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: python3 with vtk is not installed");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let study = folder.path().join("study.toml");
    // coarse and short: what is drawn matters here, not its accuracy
    let numerics = "elements_per_half_width = 2\npositions = 24\nfields = 1\nstored_states = 1\n";
    let text = match STUDY.contains("[numerics]") {
        true => STUDY.replace("[numerics]", &format!("[numerics]\n{numerics}")),
        false => format!("{STUDY}\n[numerics]\n{numerics}"),
    };
    std::fs::write(&study, text).unwrap();
    let run = Command::cargo_bin("gearwear")
        .unwrap()
        .args(["run", "--quiet", "-o"])
        .args([folder.path().join("out"), study])
        .output()
        .unwrap();
    assert!(
        run.status.success(),
        "{}",
        String::from_utf8_lossy(&run.stderr)
    );

    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("validation/render_fields.py");
    let picture = folder.path().join("picture.png");
    let drawn = Command::new("python3")
        .arg(script)
        .args([&folder.path().join("out/fields"), &picture])
        .args(["--size", "400", "300"])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&drawn.stdout);
    assert!(
        drawn.status.success() && said.contains("von Mises"),
        "{said}{}",
        String::from_utf8_lossy(&drawn.stderr)
    );
    let bytes = std::fs::read(&picture).unwrap();
    assert_eq!(bytes[..8], *b"\x89PNG\r\n\x1a\n");
    let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
    assert_eq!((number(16), number(20)), (400, 300));
    assert!(bytes.len() > 5_000, "{} bytes: blank?", bytes.len());
}
