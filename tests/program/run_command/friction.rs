//! Coulomb friction. Tolerance: 1e-9 for the balance of torques (solved to about 1e-15).
use super::home::{FEM, Home, number};

#[test]
fn friction_changes_the_loads_and_keeps_the_torque() {
    let home = Home::with(&[("friction", "true"), ("order", "1")]);
    home.succeed("run study.toml -o run");
    let (with, without) = (home.result("run"), FEM.result("run"));
    let summary = with.summary();
    let torque = summary["checks"]
        .as_array()
        .unwrap()
        .iter()
        .find(|check| check["name"].as_str().unwrap().contains("torque"))
        .expect("the run checks its torque");
    assert!(torque["value"].as_f64().unwrap() < 1e-9 && torque["passed"] == true);
    for check in summary["checks"].as_array().unwrap() {
        assert_eq!(check["passed"], true, "{check}");
    }
    // before the pitch point the gear's teeth are pushed outwards along the flank, after it inwards: the friction force's
    // moment about the pinion's centre is μ F' ρ₁, so a single pair carries T/(r_b ± μ ρ₁)
    let contact = |folder: &super::home::Folder| folder.table("contact.csv").only("cycles", "0");
    let (with_friction, plain) = (contact(&with), contact(&without));
    let mut seen = [0; 2];
    for (table, mu) in [(&with_friction, 0.06), (&plain, 0.0)] {
        let single = table.single();
        for (path, load) in single
            .numbers("path")
            .into_iter()
            .zip(single.numbers("line_load"))
        {
            let base = 27.0 * 20f64.to_radians().cos();
            let rho = 27.0 * 20f64.to_radians().sin() + path;
            // approach: the pinion's friction helps the gear's motion less than the normal force does, and the reverse after
            let sign = if path < 0.0 { -1.0 } else { 1.0 };
            let expected = 100e3 / 33.0 / (base + sign * mu * rho);
            assert!(
                (load / expected - 1.0).abs() < 2e-3,
                "μ = {mu}, path {path}: {load} N/mm, {expected}"
            );
            seen[usize::from(mu > 0.0)] += 1;
        }
    }
    assert!(seen[0] > 0 && seen[1] > 0, "{seen:?}");
    assert_eq!(number(&summary, "/conditions/friction/contact"), 0.06);
    assert_eq!(
        number(&without.summary(), "/conditions/friction/contact"),
        0.0
    );
    let in_contact = |folder: &super::home::Folder| {
        let page = folder.text("report.html");
        let row = page.split("friction in the contact").nth(1).unwrap();
        row.split("</tr>").next().unwrap().to_owned()
    };
    let said = in_contact(&with);
    assert!(
        said.contains("Coulomb, coefficient 0.06 (lubricant.friction_coefficient"),
        "{said}"
    );
    let said = in_contact(&without);
    assert!(said.contains("none: contact forces are normal"), "{said}");
    let te =
        |folder: &super::home::Folder| number(&folder.summary(), "/contact/te_peak_to_peak_urad");
    assert!((te(&with) / te(&without) - 1.0).abs() > 1e-3);
}

/// The catalogue's effect with one coefficient is the contact's own friction: the same loads, pressures and wear. Tolerance: rounding, since
/// the compliance is summed in another order.
#[test]
fn the_effect_is_the_friction_of_the_contact() {
    let values = [("order", "1"), ("friction", "true")];
    let own = Home::with(&values);
    let by_effect = Home::with(&values[..1]);
    let mut study = std::fs::read_to_string(by_effect.path("study.toml")).unwrap();
    study.push_str("[[effect]]\nkind = \"friction_load\"\ncoefficient = 0.06\n");
    by_effect.write("study.toml", &study);
    for home in [&own, &by_effect] {
        home.succeed("run study.toml -o run");
    }
    let (own, by_effect) = (own.result("run"), by_effect.result("run"));
    assert!(
        by_effect
            .text("report.html")
            .contains("that of the added effects")
    );
    for (file, column) in [
        ("contact.csv", "line_load"),
        ("contact.csv", "peak_pressure"),
        ("wear.csv", "depth"),
    ] {
        let (a, b) = (own.table(file), by_effect.table(file));
        let (a, b) = (a.numbers(column), b.numbers(column));
        assert_eq!(a.len(), b.len());
        let largest = a.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        for (a, b) in a.iter().zip(&b) {
            assert!((a - b).abs() < 1e-7 * largest, "{file}: {a}, {b}");
        }
    }
}
