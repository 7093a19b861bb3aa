//! Where the face has slices, `contact.csv` says which of them a pair's largest pressure is of.
use super::home::{FEM, Home};

#[test]
fn the_largest_pressure_has_its_place_across_the_face() {
    let home = Home::with(&[("cycles", "1000"), ("positions", "12")]);
    let mut study = std::fs::read_to_string(home.path("study.toml")).unwrap();
    study += "[face]\nslices = 5\ncoupling = \"none\"\n[face.pinion]\nlead_slope = 20.0\n";
    home.write("study.toml", &study);
    home.succeed("run study.toml -o run");
    let contact = home.result("run").table("contact.csv");
    assert_eq!(contact.header.last().map(String::as_str), Some("face"));
    // material is missing at +b/2, so the other half of the face carries the load
    let slices = home.result("run").table("wear.csv");
    let places = slices.distinct("face");
    assert_eq!(places.len(), 5);
    let new = contact.only("cycles", "0");
    let loaded = new.only_where("line_load", |load| load > 0.0);
    assert!(loaded.len() > 0);
    for face in loaded.texts("face") {
        assert!(places.contains(&face) && face.starts_with('-'), "{face}");
    }
    let idle = new.only("line_load", "0");
    assert!(idle.texts("face").iter().all(|face| face.is_empty()));
}

#[test]
fn one_section_has_no_such_column() {
    let contact = FEM.result("run").table("contact.csv");
    assert_eq!(
        contact.header.last().map(String::as_str),
        Some("friction_power_w")
    );
}
