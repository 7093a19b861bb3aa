//! The analytic and the published model through the same command.
//!
//! Tolerances: half the last digit that a number of the paper is printed with; 1e-5 mm for the radius of its point 23, known
//! by a pressure angle of four decimals (5e-5° times r tan α); 1e-9 for equilibrium.
use super::home::{Home, number};

#[test]
fn hertz_runs_without_a_mesh() {
    let home = Home::with(&[("contact", "\"hertz\"")]);
    home.succeed("run study.toml -o run");
    let result = home.result("run");
    let summary = result.summary();
    assert_eq!(summary["conditions"]["model"], "hertz");
    assert_eq!(number(&summary, "/mesh/nodes"), 0.0);
    assert!(!result.0.join("fields").exists());
    let contact = result.table("contact.csv");
    // single contact at the pitch point, unworn: p = sqrt(F' E* / (π R)), Johnson (1985), Eq. (4.45)
    let new = contact.only("cycles", "0").single();
    let nearest = (0..new.len())
        .min_by(|&i, &j| {
            let path = new.numbers("path");
            path[i].abs().total_cmp(&path[j].abs())
        })
        .unwrap();
    let path = new.numbers("path")[nearest];
    let rho1 = 27.0 * 20f64.to_radians().sin() + path;
    let rho2 = 53.0 * 20f64.to_radians().sin() - path;
    let modulus = 2.1e5 / (2.0 * (1.0 - 0.09));
    let load = 100e3 / 33.0 / (27.0 * 20f64.to_radians().cos());
    let expected = (load * modulus * (rho1 + rho2) / (std::f64::consts::PI * rho1 * rho2)).sqrt();
    let found = new.numbers("peak_pressure")[nearest];
    // of the ellipse itself, however few nodes stand under it
    assert!(
        (found / expected - 1.0).abs() < 1e-6,
        "{found} MPa, {expected}"
    );
    for position in contact.distinct("position") {
        let rows = contact.only("cycles", "50000").only("position", position);
        let sum: f64 = rows.numbers("load_share").iter().sum();
        assert!((sum - 1.0).abs() < 1e-9, "{position}: {sum}");
    }
    let te = result.table("transmission_error.csv");
    assert!(te.numbers("angle").iter().all(|a| *a > 0.0));
}

#[test]
fn what_no_gear_lives_through_is_computed_with_a_warning() {
    let warned = |values: &[(&str, &str)]| {
        let values = [&[("contact", "\"hertz\"")], values].concat();
        let home = Home::with(&values);
        let out = home.succeed("run study.toml -o run").out;
        let page = home.result("run").text("report.html");
        let warnings: Vec<String> = (out.lines())
            .filter_map(|line| Some(line.trim().strip_prefix("warning: ")?.to_owned()))
            .collect();
        assert!(
            warnings
                .iter()
                .all(|w| page.contains(&format!("Warning: {w}.")))
        );
        warnings
    };
    assert!(warned(&[]).is_empty());
    let heavy = warned(&[("torque", "5000.0")]);
    assert!(
        heavy.len() == 1 && heavy[0].contains("MPa on new flanks"),
        "{heavy:?}"
    );
    let long = warned(&[("cycles", "2500000"), ("coefficient", "2e-8")]);
    assert!(
        long.first()
            .is_some_and(|w| w.contains("the pinion is worn")),
        "{long:?}"
    );
}

/// The paper prints 1.32e-2 µm at its point 23 after 50 000 cycles; a reconstruction from its equations gives 0.0131649 µm.
#[test]
fn the_published_model_gives_the_published_wear() {
    let home = Home::with(&[("contact", "\"paper\"")]);
    home.succeed("run study.toml -o run");
    let result = home.result("run");
    assert_eq!(result.summary()["conditions"]["model"], "paper");
    let wear = result.table("wear.csv");
    assert_eq!(wear.distinct("cycles"), ["0", "25000", "50000"]);
    assert_eq!(
        wear.distinct("member"),
        ["pinion"],
        "the paper wears the pinion only"
    );
    let worn = wear.only("cycles", "50000");
    assert_eq!(worn.len(), 50, "the paper's fifty points");
    let depth = worn.numbers("depth")[22];
    assert!((depth - 0.013_164_9).abs() < 5e-8, "{depth} µm");
    assert!((depth - 1.32e-2).abs() < 5e-5, "as printed");
    // the reconstruction's profile pressure angle at point 23, 19.8133°, on the base circle of 27 teeth
    let radius = 27.0 * 20f64.to_radians().cos() / 19.8133f64.to_radians().cos();
    let found = worn.numbers("radius")[22];
    assert!((found - radius).abs() < 1e-5, "{found} mm, {radius}");
    let contact = result.table("contact.csv");
    assert!(contact.len() > 0 && contact.numbers("peak_pressure").iter().all(|p| *p > 0.0));
}
