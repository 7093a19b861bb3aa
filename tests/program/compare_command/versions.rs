//! `add`, `compare` and `ladder` of the same versions: where their figures differ it is said why, and what is said of one file is said once.

use super::*;

/// A running-in beside a law that `add running_in` leaves: more than noise is left, but no far misfit.
fn half_explained() -> TempDir {
    let home = tempfile::tempdir().unwrap();
    let write = |name: &str, text: String| fs::write(home.path().join(name), text).unwrap();
    let law = "[[effect]]\nkind = \"pressure_exponent\"\nexponent = 1.3\n";
    write("truth.toml", format!("{BASE}{RUNNING_IN}{law}"));
    succeed(&home, "synthesize truth.toml -o data --seed 5");
    let file = FILE.replace("measurements.csv", "data/measurements.csv");
    write(
        "base.toml",
        format!("{}{file}", BASE.replace("2e-10", "5e-10")),
    );
    home
}

#[test]
fn intervals_of_add_and_ladder_differ_and_it_is_said_why() {
    let home = half_explained();
    let added = succeed(&home, "add base.toml running_in --form own -o more.toml");
    assert!(
        added.contains(
            "compare and ladder fit the new study on, to the end and with finer wear steps where these matter: quote their values and intervals"
        ),
        "{added}"
    );
    // what the sentence says: the ladder goes on from there, and ends no worse
    let of_add = added.lines().find_map(|line| {
        let rest = line
            .trim()
            .strip_prefix("chi2 per point of the fit tests: ")?;
        rest.split(' ').next()?.parse::<f64>().ok()
    });
    let of_add = of_add.unwrap_or_else(|| panic!("{added}"));
    let steps: Value =
        serde_json::from_str(&succeed(&home, "ladder base.toml more.toml --json")).unwrap();
    let of_ladder = number(&steps, "/1/fit_chi2_per_point");
    assert!(
        of_ladder < of_add + 0.005 && of_ladder > 0.9 * of_add,
        "{of_ladder} {of_add}"
    );
    assert!(of_ladder > 1.2, "{of_ladder}");
    // and by what noise the two figures of add are
    assert!(
        added.contains(
            "compare may take finer wear steps (it does so without the effect), and diagnose allows for an error of the model itself"
        ),
        "{added}"
    );
    // where no more than noise is left there is nothing to say
    let (home, folder) = (super::home(), "try");
    let right = succeed(
        &home,
        &format!("add {folder}/base.toml running_in -o {folder}/added.toml"),
    );
    assert!(!right.contains("fit the new study on"), "{right}");
}

#[test]
fn sigmas_of_one_file_are_told_once() {
    let home = home();
    let file = home.path().join("try/measurements.csv");
    let table = fs::read_to_string(&file).unwrap();
    let without = table.lines().map(|line| {
        let mut cells: Vec<&str> = line.split(',').collect();
        if cells.len() > SIGMA && cells[QUANTITY] == "wear_depth" {
            cells[SIGMA] = "";
        }
        cells.join(",")
    });
    fs::write(&file, without.collect::<Vec<_>>().join("\n")).unwrap();
    let (code, _, told) = crate::common::line(&home, "ladder try/base.toml try/right.toml");
    assert_eq!(code, Some(0), "{told}");
    assert_eq!(told.matches("note: ").count(), 1, "{told}");
    assert!(told.contains("estimated"), "{told}");
}

/// A wear coefficient that would leave no teeth is no place to begin: k is measured with one that leaves them, and that of transmission errors alone is not the
/// one that it was measured with.
#[test]
fn a_coefficient_that_leaves_no_teeth_is_sized_first() {
    let home = tempfile::tempdir().unwrap();
    let write = |name: &str, text: String| fs::write(home.path().join(name), text).unwrap();
    write("truth.toml", BASE.to_owned());
    succeed(&home, "synthesize truth.toml -o data --seed 5");
    let data = fs::read_to_string(home.path().join("data/measurements.csv")).unwrap();
    let of = |quantity: &str| {
        let rows = data.lines();
        let rows = rows.filter(|row| row.starts_with("test,") || row.contains(quantity));
        rows.map(|row| format!("{row}\n")).collect::<String>()
    };
    let absurd = format!("{}{FILE}", BASE.replace("2e-10", "1e-6"));
    for quantity in ["wear_depth", "transmission_error"] {
        write("measurements.csv", of(quantity));
        write("base.toml", absurd.clone());
        let told = succeed(&home, "compare base.toml --json");
        let told: Value = serde_json::from_str(&told).unwrap();
        let k = number(&told, "/parameters/0/value");
        assert!((k / 2e-10 - 1.0).abs() < 0.1, "{quantity}: {k}");
        let told = succeed(
            &home,
            "add base.toml pressure_exponent --form own -o more.toml --force --json",
        );
        let told: Value = serde_json::from_str(&told).unwrap();
        let k = number(&told, "/fit/parameters/0/value");
        assert!((k / 2e-10 - 1.0).abs() < 0.3, "{quantity} with it: {k}");
    }
}
