//! What a common k and a small mean error are worth: tests that do not share one k are told with the one that stands out, and a mean that the datums
//! make small is not taken for a validation.

use super::*;

#[test]
fn tests_that_do_not_share_one_k_are_told() {
    let home = home();
    // with the running-in of the truth all share one k
    let base = fs::read_to_string(home.path().join("try/right.toml")).unwrap();
    let scattered = base
        .replace(
            "coefficient_scatter = 0.0",
            "coefficient_scatter = \"estimate\"",
        )
        .replace("role = \"holdout\"\n", "");
    fs::write(home.path().join("try/one.toml"), &scattered).unwrap();
    let told = succeed(&home, "compare try/one.toml");
    assert!(!told.contains("do not share one k"), "{told}");
    // test B worn by 2.6 times as much
    let table = fs::read_to_string(home.path().join("data/measurements.csv")).unwrap();
    let worn = table.lines().map(|line| {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        if cells[0] == "B" {
            times(&mut cells, 2.6);
        }
        cells.join(",")
    });
    fs::write(
        home.path().join("try/measurements.csv"),
        worn.collect::<Vec<_>>().join("\n"),
    )
    .unwrap();
    let told = succeed(&home, "compare try/one.toml");
    let line = told
        .lines()
        .find(|l| l.contains("the tests do not share one k"));
    let line = line.unwrap_or_else(|| panic!("{told}"));
    assert!(line.contains("test B stands out, at 2."), "{line}");
    let page = fs::read_to_string(home.path().join("try/one.out/compare/report.html")).unwrap();
    assert!(page.contains("the tests do not share one k"));
    let told = succeed(&home, "check try/one.toml");
    let line = "warning:     the tests do not share one k";
    assert!(told.contains(line), "{told}");
}

#[test]
fn a_mean_that_datums_make_small_is_no_validation() {
    let home = home();
    succeed(&home, "compare try/base.toml -o base");
    let folder = home.path().join("base");
    let written = document(&folder, "comparison.json");
    let all = written["validation"].as_array().unwrap();
    let held = |v: &&Value| v["role"] == "holdout" && v["quantity"] == "wear_depth";
    let held: Vec<&Value> = all.iter().filter(held).collect();
    assert!(!held.is_empty(), "{written}");
    for v in &held {
        assert_eq!(v["mean_is_fitted"], true, "{v}");
        let far = number(v, "/rms") > 1.5 * number(v, "/noise_rms");
        assert!(!far || v["curve_resolved"] == true, "{v}");
    }
    let hidden = |v: &&&Value| v["resolved"] == false && v["curve_resolved"] == true;
    assert!(held.iter().any(|v| hidden(&v)), "{held:#?}");
    let page = fs::read_to_string(folder.join("report.html")).unwrap();
    assert!(page.contains("seen in the curve"), "{page}");
    assert!(page.contains("Of traces a small E validates nothing"));
}

/// A member that the study does not wear, and that wore: no figure of the comparison means anything until its coefficient is stated.
#[test]
fn a_member_without_a_coefficient_that_wore_is_told() {
    let home = tempfile::tempdir().unwrap();
    let write = |name: &str, text: String| fs::write(home.path().join(name), text).unwrap();
    write("truth.toml", BASE.to_owned());
    succeed(&home, "synthesize truth.toml -o data --seed 5");
    let file = FILE.replace("measurements.csv", "data/measurements.csv");
    write(
        "base.toml",
        format!("{BASE}[wear.gear]\ncoefficient = 0.0\n{file}"),
    );
    let told = succeed(&home, "compare base.toml --json");
    let told: Value = serde_json::from_str(&told).unwrap();
    let said = told["sanity"].as_array().unwrap();
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(
        said[0].as_str().unwrap().starts_with("[wear.gear] coefficient is 0, so the gear does not wear here, but its wear_depth goes up to"),
        "{said:?}"
    );
}
