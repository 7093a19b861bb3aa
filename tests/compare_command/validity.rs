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
