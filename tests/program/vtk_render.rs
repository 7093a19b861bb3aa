//! Claim: VTK's own reader opens the fields of a run and draws them: the picture is not blank. ParaView opens them by the script beside
//! them, with the contact in its middle.
//!
//! Source: VTK by way of Python and ParaView, not our code. Skipped with a message where `python3` or its `vtk`, or `pvpython` and
//! `xvfb-run`, are absent. Tolerance: the picture's size and a file no blank picture would fill; colours of high stress in the middle.

use std::path::Path;
use std::process::Command;

use assert_cmd::cargo::CommandCargoExt;

const STUDY: &str = include_str!("../../validation/paper/study.toml");

#[test]
#[expect(clippy::print_stderr, reason = "says why nothing was tested")]
fn vtk_draws_the_fields() {
    let vtk = Command::new("python3").args(["-c", "import vtk"]).output();
    if !vtk.is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: python3 with vtk is not installed");
        return;
    }
    let folder = drawn();
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

/// A folder with the run of a coarse study in `out`.
fn drawn() -> tempfile::TempDir {
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
    folder
}

#[test]
#[expect(clippy::print_stderr, reason = "says why nothing was tested")]
fn paraview_shows_the_contact() {
    let folder = drawn();
    let script = folder.path().join("out/fields/open_in_paraview.py");
    let text = std::fs::read_to_string(&script).unwrap();
    // Python looks for modules beside the script first: no file there may have the name of one that it imports
    for line in text
        .lines()
        .filter(|l| l.starts_with("import ") || l.starts_with("from "))
    {
        let module = line.split([' ', '.']).nth(1).unwrap();
        let shadow = script.with_file_name(format!("{module}.py"));
        assert!(!shadow.exists(), "{} hides {module}", shadow.display());
    }
    let there = |program: &str| {
        let found = Command::new("sh")
            .args(["-c", &format!("command -v {program}")])
            .output();
        found.is_ok_and(|output| output.status.success())
    };
    if !there("pvpython") || !there("xvfb-run") {
        eprintln!("skipped: pvpython and xvfb-run are not installed");
        return;
    }
    let picture = folder.path().join("picture.png");
    // both outputs through one pipe: the X server ends early where it finds two
    let command = "xvfb-run -a pvpython --force-offscreen-rendering \"$0\" \"$1\" 2>&1 | cat";
    let drawn = Command::new("sh")
        .args(["-c", command])
        .args([&script, &picture])
        .output()
        .unwrap();
    assert!(
        picture.is_file(),
        "{}",
        String::from_utf8_lossy(&drawn.stdout)
    );
    let file = std::io::BufReader::new(std::fs::File::open(&picture).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut bytes).unwrap();
    assert_eq!((info.width, info.height), (1200, 800));
    let channels = info.line_size / 1200;
    // the upper half of the colours within a tenth of the picture around its middle
    let bright = (360..440)
        .flat_map(|y| (540..660).map(move |x| (x, y)))
        .filter(|(x, y)| {
            let at = y * info.line_size + x * channels;
            let [green, blue] = [bytes[at + 1], bytes[at + 2]];
            green > 150 && blue < 130
        });
    assert!(bright.count() > 20, "no contact in the middle");
}
