//! Claim: tilts and shifts of a trace that the study allows for do not pass for wear, and rows that stand apart from their neighbours are
//! found, reported and, if the study says so, count little.
//!
//! Source: the covariance of stated random numbers (closed form); spoilt values put in by this file.
//! Tolerance: counts of spoilt rows exactly; sampling error of the mean of χ² over its points.

use gearwear::measure::{Dataset, Quantity};
use gearwear::study::Study;

const LAYOUT: &str = "validation/challenges/none_L2";

fn study(noise: &str) -> Study {
    let path = format!("{}/{LAYOUT}/study.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap();
    let text = text.replace("contact = \"fem\"", "contact = \"hertz\"");
    let text = match text.find("[noise]") {
        Some(_) => text.replace("[noise]", &format!("[noise]\n{noise}")),
        None => format!("{text}\n[noise]\n{noise}\n"),
    };
    Study::parse(&text, &path).unwrap()
}

/// A row of the data that every so many-th wear depth is.
fn spoilt(data: &Dataset) -> Vec<usize> {
    let depths = (0..data.observations.len())
        .filter(|&row| data.observations[row].quantity == Quantity::WearDepth);
    depths.skip(20).step_by(97).collect()
}

/// The data with those rows `sigmas` of their own off, one up, the next down.
fn with_outliers(noise: &str, sigmas: f64) -> (Dataset, Vec<usize>) {
    let study = study(noise);
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(format!(
        "{}/{LAYOUT}/measurements.csv",
        env!("CARGO_MANIFEST_DIR")
    ))
    .unwrap();
    let data = study.dataset().unwrap();
    let rows = spoilt(&data);
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let head: Vec<String> = lines[data.observations[0].line - 2]
        .split(',')
        .map(|name| name.trim().to_owned())
        .collect();
    let column = head.iter().position(|name| name == "value").unwrap();
    for (number, &row) in rows.iter().enumerate() {
        let o = &data.observations[row];
        let sign = if number % 2 == 0 { 1.0 } else { -1.0 };
        let mut cells: Vec<String> = lines[o.line - 1].split(',').map(str::to_owned).collect();
        cells[column] = format!("{}", o.value + sign * sigmas * o.sigma);
        lines[o.line - 1] = cells.join(",");
    }
    let path = folder.path().join("study.toml");
    std::fs::write(folder.path().join("measurements.csv"), lines.join("\n")).unwrap();
    std::fs::write(&path, study_text(noise)).unwrap();
    let read = Study::load(&path).unwrap();
    (read.dataset().unwrap(), rows)
}

fn study_text(noise: &str) -> String {
    let path = format!("{}/{LAYOUT}/study.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).unwrap();
    match text.find("[noise]") {
        Some(_) => text.replace("[noise]", &format!("[noise]\n{noise}")),
        None => format!("{text}\n[noise]\n{noise}\n"),
    }
}

#[test]
fn no_row_of_clean_measurements_stands_apart() {
    let data = study("").dataset().unwrap();
    assert!(data.outliers.is_empty(), "{:?}", data.outliers_in_words());
}

#[test]
fn rows_that_stand_apart_are_found_and_count_little_if_wanted() {
    let (reported, spoilt) = with_outliers("", 8.0);
    let found: Vec<usize> = reported.outliers.iter().map(|o| o.row).collect();
    let missed = spoilt.iter().filter(|row| !found.contains(row)).count();
    let wrong = found.iter().filter(|row| !spoilt.contains(row)).count();
    assert!(wrong == 0, "{wrong} wrong of {}", found.len());
    assert!(
        20 * missed <= spoilt.len(),
        "{missed} of {} missed",
        spoilt.len()
    );
    let said = reported.outliers_in_words().unwrap();
    assert!(said.contains("measurements.csv:"), "{said}");
    assert!(said.contains("robust"), "{said}");
    let (robust, _) = with_outliers("outliers = \"robust\"", 8.0);
    for outlier in &robust.outliers {
        let o = &robust.observations[outlier.row];
        let stated = reported.observations[outlier.row].sigma;
        assert!(outlier.stated_sigma == stated);
        assert!((o.sigma.hypot(0.0) - stated.hypot(o.value - outlier.expected)).abs() < 1e-12);
    }
}

/// A digit or a decimal place too much is a slip, noise of 8 σ is none, nor is what counts little.
#[test]
fn slips_in_writing_are_told_from_rows_that_stand_apart() {
    let has_slips = |noise, sigmas| with_outliers(noise, sigmas).0.has_slips();
    assert!(!has_slips("", 8.0));
    assert!(has_slips("", 60.0));
    assert!(!has_slips("outliers = \"robust\"", 60.0));
}

/// Measurements of the exact base model, each trace of wear tilted and shifted by the machine: with the priors stated χ² is that of noise,
/// without them far above.
#[test]
fn tilts_and_shifts_that_are_allowed_for_are_no_discrepancy() {
    let [with, without] = chi2_with_and_without("trace_tilt = 1.0\ntrace_shift = 0.02");
    assert!((0.85..1.1).contains(&with), "{with}");
    assert!(without > 1.5 * with, "{without} {with}");
}

/// The same of the scatter of a new profile that all checkpoints were taken from.
#[test]
fn the_scatter_of_a_new_profile_that_is_allowed_for_is_no_discrepancy() {
    let [with, without] = chi2_with_and_without("new_profile = 0.3");
    assert!((0.85..1.1).contains(&with), "{with}");
    assert!(without > 1.5 * with, "{without} {with}");
}

/// χ² per point of the exact base model against measurements made with what `stated` says of the noise, and without it in the study.
fn chi2_with_and_without(stated: &str) -> [f64; 2] {
    let folder = tempfile::tempdir().unwrap();
    let text = study_text(stated).replace("contact = \"fem\"", "contact = \"hertz\"");
    let lines = text.lines().filter(|line| !line.starts_with("file = "));
    let text = lines.collect::<Vec<_>>().join("\n");
    let text = text.replace("[measurements]", "");
    std::fs::write(folder.path().join("true.toml"), text).unwrap();
    let run = |arguments: &[&str]| {
        let mut program = assert_cmd::Command::cargo_bin("gearwear").unwrap();
        program
            .current_dir(folder.path())
            .args(arguments)
            .arg("--quiet");
        program.assert().success();
    };
    run(&["synthesize", "true.toml", "-o", "made", "--seed", "7"]);
    let chi2 = |name: &str| -> f64 {
        let study = format!("made/{name}.toml");
        run(&["compare", &study, "-o", name]);
        let path = folder.path().join(name).join("comparison.json");
        let found: serde_json::Value =
            serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        found["chi2_per_point"].as_f64().unwrap()
    };
    let with = chi2("study");
    let made = folder.path().join("made");
    let text = std::fs::read_to_string(made.join("study.toml")).unwrap();
    assert!(text.contains(stated), "{text}");
    std::fs::write(made.join("without.toml"), text.replace(stated, "")).unwrap();
    [with, chi2("without")]
}

/// Values without noise whose curves have corners, each elsewhere, far below the stated σ: nothing stands apart.
#[test]
fn corners_of_values_without_noise_are_no_outliers() {
    let mut data = study("").dataset().unwrap();
    for o in &mut data.observations {
        if let (Quantity::WearDepth, Some(radius)) = (o.quantity, o.position) {
            let corner = 26.3 + (1e-5 * o.cycles + o.test as f64).sin();
            let corner = if radius > 40.0 { corner + 26.5 } else { corner };
            o.value = 0.02 * (radius - corner).abs();
            o.sigma = 0.1;
        }
    }
    let found = gearwear::measure::outliers::outliers(&data.observations);
    assert!(found.is_empty(), "{found:?}");
}

/// A flank is worn from an edge on, at another place in each curve: the last unworn row and the first worn one lie between their neighbours, whatever a
/// smooth curve through these would be there.
#[test]
fn the_edge_of_what_is_worn_is_no_outlier() {
    let mut data = study("").dataset().unwrap();
    for o in &mut data.observations {
        if let (Quantity::WearDepth, Some(radius)) = (o.quantity, o.position) {
            let edge = 26.3 + 0.7 * (1e-5 * o.cycles + o.test as f64).sin();
            let edge = if radius > 40.0 { edge + 26.5 } else { edge };
            o.value = if radius < edge { 0.0 } else { 3.0 };
            o.sigma = 0.1;
        }
    }
    let found = gearwear::measure::outliers::outliers(&data.observations);
    assert!(found.is_empty(), "{found:?}");
}
