//! Claim: in a browser every report opens without an error, its charts hold data and are painted, values are told under the
//! pointer, a drag zooms and a double click goes back, the slider moves the wear curves and the worn profile and brings them back, and nothing is wider than a phone's or a
//! desktop's window.
//!
//! Source: Chromium as it is installed (`CHROMIUM` names another program); the page tests itself when its address ends with
//! `#selftest`. Where there is no such browser nothing is claimed. Tolerance: none; blank is what has no painted pixel.
//! With `REPORT_SCREENSHOTS` set to a folder the pictures taken at 400 and 1600 pixels stay there.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

use serde_json::Value;
use tempfile::TempDir;

use crate::common::{gears, succeed};

const STUDY: &str = concat!(
    "title = \"Seen in a browser\"\n",
    gears!("centre_distance = 80.0\n"),
    "\
[operation]
torque = 100.0
speed = 2000.0
[wear]
coefficient = 2e-10
cycles = 1e6
"
);
const FEM: &str = "[model]\ncontact = \"fem\"\n[numerics]\nelements_per_half_width = 2\npositions = 16\nstep_tolerance = 2e-2\n";
const HERTZ: &str = "[model]\ncontact = \"hertz\"\n[numerics]\npositions = 40\n";
const TESTS: &str = "[[test]]\nid = \"A\"\n[[test]]\nid = \"B\"\ntorque = 170.0\ncycles = 6e5\n[[test]]\nid = \"H\"\nrole = \
                     \"holdout\"\ntorque = 130.0\ncycles = 4e5\n";
const EFFECT: &str = "[[effect]]\nkind = \"running_in\"\namplitude = 2.0\ndecay_cycles = 1.5e5\n";
const FREE: &str =
    "[fit]\nfree = [\"wear.coefficient\", \"running_in.amplitude\", \"running_in.decay_cycles\"]\n";
const FILE: &str = "[measurements]\nfile = \"measurements.csv\"\n";

static BROWSER: LazyLock<Option<PathBuf>> = LazyLock::new(|| {
    if let Some(named) = std::env::var_os("CHROMIUM") {
        return Some(named.into());
    }
    let names = ["chromium", "chromium-browser", "google-chrome", "chrome"];
    let folders: Vec<PathBuf> = std::env::split_paths(&std::env::var_os("PATH")?).collect();
    let places = names
        .iter()
        .flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
    places.into_iter().find(|place| place.is_file())
});

/// Runs the browser on `page`; what it prints, and what it complains of.
fn browse(home: &TempDir, page: &Path, width: usize, options: &[String]) -> (String, Vec<String>) {
    let browser = BROWSER.as_ref().unwrap();
    let output = Command::new(browser)
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--hide-scrollbars",
        ])
        .args(["--enable-logging=stderr", "--virtual-time-budget=6000"])
        .arg(format!("--window-size={width},1400"))
        .arg(format!(
            "--user-data-dir={}",
            home.path().join("profile").display()
        ))
        .args(options)
        .arg(format!("file://{}#selftest", page.display()))
        .output()
        .unwrap();
    let complaints = String::from_utf8_lossy(&output.stderr)
        .lines()
        .filter(|line| line.contains("CONSOLE"))
        .map(str::to_owned)
        .collect();
    (
        String::from_utf8_lossy(&output.stdout).into_owned(),
        complaints,
    )
}

/// What the page found out about itself in a window of this width.
fn tested(home: &TempDir, page: &Path, width: usize) -> Value {
    let (dom, complaints) = browse(home, page, width, &["--dump-dom".to_owned()]);
    assert!(complaints.is_empty(), "{complaints:?}");
    let text = dom
        .split("id=\"selftest-result\">")
        .nth(1)
        .and_then(|rest| rest.split("</pre>").next())
        .unwrap_or_else(|| panic!("{} did not test itself", page.display()));
    let text = text
        .replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&amp;", "&");
    serde_json::from_str(&text).unwrap()
}

/// Opens a report at both widths, looks at its charts, takes pictures; the wide window's findings.
fn opened(home: &TempDir, folder: &str, charts: usize) -> Value {
    let page = home.path().join(folder).join("report.html");
    let mut last = Value::Null;
    for width in [400, 1600] {
        let found = tested(home, &page, width);
        let what = format!("{folder} at {width}: {found}");
        assert_eq!(found["faults"].as_array().unwrap().len(), 0, "{what}");
        assert!(found["overflow"].as_f64().unwrap() <= 0.0, "{what}");
        let shown: Vec<&Value> = found["charts"]
            .as_array()
            .unwrap()
            .iter()
            .filter(|chart| chart.get("points").is_some())
            .collect();
        assert_eq!(shown.len(), charts, "{what}");
        for chart in shown {
            let all = |key: &str, good: fn(&Value) -> bool| {
                chart[key].as_array().is_some_and(|v| v.iter().all(good))
            };
            assert!(all("points", |n| n.as_u64() > Some(0)), "{chart}");
            assert!(all("inked", |n| n.as_u64() > Some(500)), "{chart}");
            assert!(all("hovered", |said| said != ""), "{chart}");
            let near = |value: &Value, wanted: f64| (value.as_f64().unwrap() - wanted).abs() < 0.02;
            for zoomed in chart["zoomed"].as_array().unwrap() {
                // a drag over half of the axis shows that half, a double click the whole again
                assert!(
                    zoomed.is_null() || (near(&zoomed[0], 0.5) && near(&zoomed[1], 1.0)),
                    "{chart}"
                );
            }
        }
        photographed(home, &page, folder, width);
        last = found;
    }
    last
}

fn photographed(home: &TempDir, page: &Path, folder: &str, width: usize) {
    let kept = std::env::var_os("REPORT_SCREENSHOTS").map(PathBuf::from);
    let place = kept.unwrap_or_else(|| home.path().to_owned());
    let picture = place.join(format!("{}-{width}.png", folder.replace(['/', '.'], "-")));
    browse(
        home,
        page,
        width,
        &[format!("--screenshot={}", picture.display())],
    );
    let bytes = fs::read(&picture).unwrap();
    // PNG: signature, then the header's width and height
    assert_eq!(bytes[..4], *b"\x89PNG");
    assert_eq!(
        bytes[16..20],
        (width as u32).to_be_bytes(),
        "{}",
        picture.display()
    );
}

/// Plots of a report, by its files.
fn pictures(home: &TempDir, folder: &str) -> usize {
    let files = fs::read_dir(home.path().join(folder).join("plots")).unwrap();
    let paths = files.map(|file| file.unwrap().path());
    paths
        .filter(|path| path.extension().is_some_and(|end| end == "svg"))
        .count()
}

fn moved(found: &Value, name: &str) -> bool {
    let charts = found["charts"].as_array().unwrap();
    let chart = charts.iter().find(|chart| chart["name"] == name);
    chart.unwrap_or_else(|| panic!("{name}"))["moved"] == true
}

#[expect(clippy::print_stderr, reason = "a skipped test must say so")]
#[test]
fn reports_work_in_a_browser() {
    if BROWSER.is_none() {
        eprintln!("skipped: no Chromium found (set CHROMIUM to its program)");
        return;
    }
    let home = tempfile::tempdir().unwrap();
    let write = |name: &str, text: String| fs::write(home.path().join(name), text).unwrap();
    write("study.toml", format!("{STUDY}{FEM}"));
    succeed(&home, "run study.toml -q");
    let found = opened(&home, "study.out/run", 9);
    for name in [
        "wear_pinion",
        "wear_gear",
        "load_share",
        "peak_pressure",
        "transmission_error",
        "tooth",
    ] {
        assert!(moved(&found, name), "{name}");
    }
    for chart in found["charts"].as_array().unwrap() {
        assert!(
            chart.get("returned").is_none_or(|back| back == true),
            "{chart}"
        );
    }
    let pointed = found["pointed"][0].as_str().unwrap();
    assert!(pointed.ends_with("MPa"), "{pointed}");
    let captions = found["captions"].as_array().unwrap();
    assert!(captions.len() >= 4, "{captions:?}");
    for (i, said) in captions.iter().enumerate() {
        assert_eq!(said[1], 1, "one picture is seen: {captions:?}");
        let said = said[0].as_str().unwrap();
        assert!(said.starts_with("Mesh and von Mises stress"), "{said}");
        assert_eq!(said.ends_with("close-up of the contact"), i % 2 == 1);
    }

    succeed(&home, "models study.toml -q");
    opened(
        &home,
        "study.out/models",
        pictures(&home, "study.out/models"),
    );

    write("truth.toml", format!("{STUDY}{HERTZ}{TESTS}{EFFECT}"));
    succeed(&home, "synthesize truth.toml -o data --seed 5 -q");
    let data = home.path().join("data/measurements.csv");
    fs::copy(data, home.path().join("measurements.csv")).unwrap();
    write("base.toml", format!("{STUDY}{HERTZ}{TESTS}{FILE}"));
    write(
        "right.toml",
        format!("{STUDY}{HERTZ}{TESTS}{EFFECT}{FREE}{FILE}"),
    );
    succeed(&home, "compare base.toml -q");
    opened(
        &home,
        "base.out/compare",
        pictures(&home, "base.out/compare"),
    );
    succeed(&home, "ladder base.toml right.toml -q");
    opened(&home, "base.out/ladder", 2);
    succeed(&home, "diagnose base.toml --fast -q");
    let folder = "base.out/diagnose";
    let drawn = pictures(&home, folder);
    assert!(
        drawn > 6,
        "{drawn} pictures of the discrepancy and its drivers"
    );
    opened(&home, folder, drawn);
    let page = fs::read_to_string(home.path().join(folder).join("report.html")).unwrap();
    assert!(page.contains("class=\"bar\"") && page.contains("running_in"));
}
